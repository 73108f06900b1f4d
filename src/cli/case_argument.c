/// The CASE of a command line.
#include "cli/case_argument.h"

#include "cli/terminal.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/// Says which built-in case is nearest to `name`, or else which there are.
static void refuse(const scree_command *command, const char *name, const char *message)
{
    size_t count = scree_template_count();
    const char **names = calloc(count + 1, sizeof *names);
    scree_error error;
    char accepted[sizeof error.accepted] = "";
    for (size_t i = 0; names && i < count; i++) names[i] = scree_template_name(i);
    const char *nearest = names ? scree_nearest(name, names, count) : NULL;
    for (size_t i = 0; !nearest && names && i < count; i++) {
        size_t used = strlen(accepted);
        (void)snprintf(accepted + used, sizeof accepted - used, "%s%s", i > 0 ? ", " : "", names[i]);
    }
    scree_command_refuse(&error, name, nearest ? nearest : accepted, "%s", message);
    (void)scree_terminal_error(command->verb->name, &error);
    free(names);
}

const char *scree_case_argument_builtin(const scree_command *command, const char *name)
{
    const char *text = scree_template_text(name);
    if (!text) refuse(command, name, "there is no built-in case of this name");
    return text;
}

static void print_problems(const scree_command *command, const char *name, const scree_problems *problems)
{
    static const scree_error memory = {.status = SCREE_ERROR_IO, .message = "out of memory"};
    size_t count = scree_problems_count(problems);
    if (count == 0) (void)scree_terminal_error(command->verb->name, &memory); // not even for saying so
    for (size_t i = 0; i < count; i++) (void)scree_terminal_error(command->verb->name, scree_problems_get(problems, i));
    if (count > 1) fprintf(stderr, "%zu problems in %s\n", count, name);
}

scree_status scree_case_argument_read(const scree_command *command, const char *name, scree_case **out)
{
    *out = NULL;
    const char *builtin = NULL;
    struct stat about;
    const bool there = stat(name, &about) == 0;
    // A folder of that name, of a run or a sweep of it, hides no built-in case.
    if (!there || S_ISDIR(about.st_mode)) {
        builtin = scree_template_text(name);
        // A name with a dot or a slash was meant as a file: reading it says why that fails.
        if (!builtin && !there && !strpbrk(name, "./")) {
            refuse(command, name, "there is no file and no built-in case of this name");
            return SCREE_ERROR_INPUT;
        }
    }
    const char **overrides = calloc(command->option_count + 1, sizeof *overrides);
    if (!overrides) {
        scree_error error = {.status = SCREE_ERROR_IO, .message = "out of memory"};
        return scree_terminal_error(command->verb->name, &error);
    }
    scree_case_options options = {.overrides = overrides,
                                  .override_count = scree_command_values(command, "set", overrides),
                                  .quick = scree_command_has(command, "quick")};
    scree_problems *problems = NULL;
    scree_status status = builtin ? scree_case_parse(builtin, strlen(builtin), name, &options, out, &problems)
                                  : scree_case_read(name, &options, out, &problems);
    if (status) print_problems(command, name, problems);
    scree_problems_free(problems);
    free(overrides);
    return status;
}
