/// scree get DIR [NAME...]
#include "cli/command.h"
#include "cli/terminal.h"

#include <string.h>

enum { VALUE_SIZE = 4096 };

static void widen(void *user, const char *name, const char *value)
{
    (void)value;
    size_t *width = user, length = strlen(name);
    if (length > *width) *width = length;
}

static void print_pair(void *user, const char *name, const char *value)
{
    const size_t *width = user;
    printf("%-*s %s\n", (int)*width, name, value);
}

static scree_status print_all(const char *directory, scree_error *error)
{
    size_t width = 0;
    scree_status status = scree_result_visit(directory, widen, &width, error);
    return status ? status : scree_result_visit(directory, print_pair, &width, error);
}

scree_status scree_verb_get(const scree_command *command)
{
    const char *directory = command->argument[0];
    const char **names = command->argument + 1;
    size_t count = command->argument_count - 1;
    char value[VALUE_SIZE];
    scree_error error = {0};
    scree_status failure = SCREE_OK;
    if (count == 0 && print_all(directory, &error)) return scree_terminal_error("get", &error);
    // All wrong names at once, and nothing printed when there is one.
    for (size_t i = 0; i < count && failure != SCREE_ERROR_IO; i++)
        if (scree_result_get(directory, names[i], value, sizeof value, &error))
            failure = scree_terminal_error("get", &error);
    for (size_t i = 0; i < count && !failure; i++) {
        if (scree_result_get(directory, names[i], value, sizeof value, &error))
            return scree_terminal_error("get", &error);
        printf("%s%s%s\n", count > 1 ? names[i] : "", count > 1 ? " " : "", value);
    }
    return failure;
}
