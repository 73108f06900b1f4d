/// scree plot DIR [--list | --all | --only NAME,... | --y COLUMN,... [--x COLUMN] [--stage STAGE,...] |
///                 --scene FIELD [--at WHEN] [--section] | --movie FIELD [--section]]
#include "cli/command.h"
#include "cli/terminal.h"

#include <stdio.h>
#include <string.h>

static void print_path(void *user, const char *path)
{
    (void)user;
    if (strncmp(path, "warning:", 8) == 0)
        fprintf(stderr, "scree plot: %s\n", path);
    else
        printf("%s\n", path);
}

static void widen(void *user, const char *name, const char *meaning, bool usual)
{
    (void)meaning;
    (void)usual;
    size_t *width = user, length = strlen(name);
    if (length > *width) *width = length;
}

static void print_figure(void *user, const char *name, const char *meaning, bool usual)
{
    const size_t *width = user;
    printf("%-*s %c %s\n", (int)*width, name, usual ? '*' : ' ', meaning);
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

/// Options that ask for something else than `mode` does; NULL: none was given.
static const char *find_stray(const scree_command *command, const char *const *allowed)
{
    for (size_t k = 0; k < command->option_count; k++) {
        const char *name = command->option[k].option->name;
        size_t place = 0;
        while (allowed[place] && strcmp(allowed[place], name) != 0) place++;
        if (!allowed[place]) return name;
    }
    return NULL;
}

static scree_status draw_columns(const scree_command *command, scree_error *error)
{
    const scree_plot_columns columns = {.x = scree_command_value(command, "x"),
                                        .y = scree_command_value(command, "y"),
                                        .stage = scree_command_value(command, "stage")};
    return scree_plot_chart(command->argument[0], &columns, print_path, NULL, error);
}

static scree_status draw_field(const scree_command *command, scree_error *error)
{
    const scree_plot_scene scene = {.field = scree_command_value(command, "scene"),
                                    .at = scree_command_value(command, "at"),
                                    .section = scree_command_has(command, "section")};
    return scree_plot_field(command->argument[0], &scene, print_path, NULL, error);
}

static scree_status draw_movie(const scree_command *command, scree_error *error)
{
    const scree_plot_scene scene = {.field = scree_command_value(command, "movie"),
                                    .section = scree_command_has(command, "section")};
    return scree_plot_movie(command->argument[0], &scene, print_path, NULL, error);
}

static scree_status draw_named(const scree_command *command, scree_error *error)
{
    return scree_plot_only(command->argument[0], scree_command_value(command, "only"), print_path, NULL, error);
}

static scree_status draw_all(const scree_command *command, scree_error *error)
{
    return scree_plot_only(command->argument[0], SCREE_ALL_FIGURES, print_path, NULL, error);
}

static scree_status list_figures(const scree_command *command, scree_error *error)
{
    return print_list(command->argument[0], error);
}

/// What the verb does, by the option that asks for it, and the options that go with that one.
static const struct {
    const char *with[4]; ///< the first asks
    scree_status (*draw)(const scree_command *command, scree_error *error);
} modes[] = {
    {{"list"}, list_figures},
    {{"y", "x", "stage"}, draw_columns},
    {{"scene", "at", "section"}, draw_field},
    {{"movie", "section"}, draw_movie},
    {{"all"}, draw_all},
    {{"only"}, draw_named},
};

scree_status scree_verb_plot(const scree_command *command)
{
    scree_error error = {0};
    char option[64], message[100];
    size_t mode = 0;
    while (mode + 1 < sizeof modes / sizeof *modes && !scree_command_has(command, modes[mode].with[0])) mode++;
    const char *stray = find_stray(command, modes[mode].with);
    scree_status status;
    if (stray) {
        const bool asked = scree_command_has(command, modes[mode].with[0]);
        (void)snprintf(option, sizeof option, "--%s", stray);
        (void)snprintf(message, sizeof message, "%s --%s", asked ? "does not go with" : "needs",
                       asked                                                    ? modes[mode].with[0]
                       : strcmp(stray, "x") == 0 || strcmp(stray, "stage") == 0 ? "y"
                                                                                : "scene");
        status = scree_command_refuse(&error, option, "", "%s", message);
    } else
        status = modes[mode].draw(command, &error);
    return status ? scree_terminal_error("plot", &error) : SCREE_OK;
}
