/// scree new NAME [-o FILE]
#include "cli/case_argument.h"
#include "cli/terminal.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

scree_status scree_verb_new(const scree_command *command)
{
    const char *path = scree_command_value(command, "output");
    const char *text = scree_case_argument_builtin(command, command->argument[0]);
    if (!text) return SCREE_ERROR_INPUT;
    if (!path) {
        fputs(text, stdout);
        return SCREE_OK;
    }
    scree_error error;
    FILE *file = fopen(path, scree_command_has(command, "force") ? "we" : "wxe");
    if (!file && errno == EEXIST) {
        scree_command_refuse(&error, path, "--force", "this file exists; it is not replaced");
        return scree_terminal_error("new", &error);
    }
    bool good = file && fputs(text, file) >= 0;
    if (file) good = fclose(file) == 0 && good;
    if (good) return SCREE_OK;
    scree_command_refuse(&error, path, "", "cannot write: %s", strerror(errno));
    error.status = SCREE_ERROR_IO;
    return scree_terminal_error("new", &error);
}
