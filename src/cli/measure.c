/// scree measure RUN...: continuum averages of finished runs, and of files of grains.
#include "cli/case_argument.h"
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
                                     .contacts = scree_command_value(command, "contacts"),
                                     .contact_columns = scree_command_value(command, "contact-columns"),
                                     .length_unit = scree_command_value(command, "length-unit"),
                                     .time_unit = scree_command_value(command, "time-unit"),
                                     .force_unit = scree_command_value(command, "force-unit"),
                                     .message = print_line};
    long threads = 1;
    scree_error error = {0};
    scree_case *c = NULL;
    const char *name = scree_command_value(command, "case");
    if (!name && scree_command_has(command, "set"))
        return scree_command_refuse(&error, "--set", "--case CASE with it", "it changes a value of that case"),
               scree_terminal_error("measure", &error);
    scree_status status = name ? scree_case_argument_read(command, name, &c) : SCREE_OK;
    if (status) return status; // it has been said
    options.sample_case = c;
    status = scree_command_number(command, "points", 1, 10001, &options.points, &error);
    if (!status) status = scree_command_number(command, "threads", 1, 64, &threads, &error);
    options.threads = (int)threads;
    if (!status) status = scree_measure(command->argument, command->argument_count, &options, &error);
    scree_case_free(c);
    return status ? scree_terminal_error("measure", &error) : SCREE_OK;
}
