/// scree plot DIR [--list | --only NAME,...]
#include "cli/command.h"
#include "cli/terminal.h"

#include <string.h>

static void print_path(void *user, const char *path)
{
    (void)user;
    printf("%s\n", path);
}

static void widen(void *user, const char *name, const char *meaning)
{
    (void)meaning;
    size_t *width = user, length = strlen(name);
    if (length > *width) *width = length;
}

static void print_figure(void *user, const char *name, const char *meaning)
{
    const size_t *width = user;
    printf("%-*s  %s\n", (int)*width, name, meaning);
}

static scree_status print_list(const char *directory, scree_error *error)
{
    size_t width = 0;
    scree_error same = {0};
    scree_status status = scree_figure_visit(directory, widen, &width, error);
    // What can be read is listed in any case.
    if (width > 0 && scree_figure_visit(directory, print_figure, &width, &same) && !status) {
        *error = same;
        status = same.status;
    }
    return status;
}

scree_status scree_verb_plot(const scree_command *command)
{
    const char *directory = command->argument[0], *names = scree_command_value(command, "only");
    scree_error error = {0};
    scree_status status;
    if (scree_command_has(command, "list") && names)
        status = scree_command_refuse(&error, "--only", "", "does not go with --list");
    else if (scree_command_has(command, "list"))
        status = print_list(directory, &error);
    else
        status = scree_plot_only(directory, names, print_path, NULL, &error);
    return status ? scree_terminal_error("plot", &error) : SCREE_OK;
}
