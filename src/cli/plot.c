/// scree plot DIR
#include "cli/command.h"
#include "cli/terminal.h"

static void print_path(void *user, const char *path)
{
    (void)user;
    printf("%s\n", path);
}

scree_status scree_verb_plot(const scree_command *command)
{
    scree_error error = {0};
    return scree_plot(command->argument[0], print_path, NULL, &error) ? scree_terminal_error("plot", &error) : SCREE_OK;
}
