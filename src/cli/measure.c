/// scree measure RUN...: continuum averages of finished runs.
#include "cli/command.h"
#include "cli/terminal.h"

#include <string.h>

static void print_line(void *user, const char *line)
{
    (void)user;
    if (strncmp(line, "warning:", 8) == 0)
        fprintf(stderr, "scree measure: %s\n", line);
    else
        printf("%s\n", line);
}

scree_status scree_verb_measure(const scree_command *command)
{
    scree_measure_options options = {.fields = scree_command_value(command, "fields"),
                                     .cuts = scree_command_value(command, "cuts"),
                                     .element = scree_command_value(command, "element"),
                                     .grid = scree_command_value(command, "grid"),
                                     .kernel = scree_command_value(command, "kernel"),
                                     .at = scree_command_value(command, "at"),
                                     .from = scree_command_value(command, "from"),
                                     .fit = scree_command_value(command, "fit"),
                                     .sizes = scree_command_value(command, "sizes"),
                                     .two_slopes = scree_command_has(command, "two-slopes"),
                                     .mirror = scree_command_has(command, "mirror"),
                                     .axis = scree_command_value(command, "axis"),
                                     .output = scree_command_value(command, "output"),
                                     .no_figures = scree_command_has(command, "no-figures"),
                                     .message = print_line};
    long threads = 1;
    scree_error error = {0};
    scree_status status = scree_command_number(command, "points", 1, 10001, &options.points, &error);
    if (!status) status = scree_command_number(command, "threads", 1, 64, &threads, &error);
    options.threads = (int)threads;
    if (!status) status = scree_measure(command->argument, command->argument_count, &options, &error);
    return status ? scree_terminal_error("measure", &error) : SCREE_OK;
}
