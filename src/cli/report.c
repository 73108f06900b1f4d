/// scree report DIR...
#include "cli/command.h"
#include "cli/report.h"
#include "cli/terminal.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

scree_status scree_report_to_file(const char *const *directories, size_t count, const char *path, scree_error *error)
{
    char *text = NULL;
    size_t length;
    FILE *memory = open_memstream(&text, &length);
    if (!memory) {
        *error = (scree_error){.status = SCREE_ERROR_IO, .message = "out of memory"};
        return SCREE_ERROR_IO;
    }
    scree_status status = scree_report_write(directories, count, memory, error);
    bool whole = fclose(memory) == 0;
    // Nothing is replaced before the page is there.
    FILE *file = status || !whole ? NULL : path ? fopen(path, "we") : stdout;
    if (!status) {
        bool written = file && fwrite(text, 1, length, file) == length;
        if (file && path) written &= fclose(file) == 0;
        if (!written) {
            *error = (scree_error){.status = status = SCREE_ERROR_IO};
            (void)snprintf(error->message, sizeof error->message, "cannot write '%s': %s",
                           path ? path : "standard output", strerror(errno));
        }
    }
    free(text);
    return status;
}

scree_status scree_verb_report(const scree_command *command)
{
    scree_error error = {0};
    scree_status status = scree_report_to_file(command->argument, command->argument_count,
                                               scree_command_value(command, "output"), &error);
    return status ? scree_terminal_error("report", &error) : SCREE_OK;
}
