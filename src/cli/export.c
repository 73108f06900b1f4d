/// scree export DIR [--stage STAGE] [-o FILE] [--contacts FILE]: snapshots as a dump of LAMMPS. --archive FOLDER: a run
/// in little.
#include "cli/command.h"
#include "cli/terminal.h"

#include <limits.h>
#include <stdio.h>

scree_status scree_verb_export(const scree_command *command)
{
    scree_error error = {0};
    char standard[PATH_MAX];
    size_t frames;
    const char *directory = command->argument[0], *path = scree_command_value(command, "output");
    const char *archive = scree_command_value(command, "archive");
    if (archive) {
        const char *other = path ? "--output" : scree_command_value(command, "contacts") ? "--contacts" : NULL;
        if (other && scree_command_refuse(&error, "--archive", "", "it takes no %s: it is a folder of its own", other))
            return scree_terminal_error("export", &error);
        if (scree_export_archive(directory, scree_command_value(command, "stage"), archive, &error))
            return scree_terminal_error("export", &error);
        printf("%s: a run in little\n", archive);
        return SCREE_OK;
    }
    (void)snprintf(standard, sizeof standard, "%.*s/snapshots.lammpstrj", PATH_MAX - 32, directory);
    if (!path) path = standard;
    if (scree_export_lammps(directory, scree_command_value(command, "stage"), path, &frames, &error))
        return scree_terminal_error("export", &error);
    printf("%s: %zu frame%s\n", path, frames, frames == 1 ? "" : "s");
    if (!(path = scree_command_value(command, "contacts"))) return SCREE_OK;
    if (scree_export_contacts(directory, scree_command_value(command, "stage"), path, &frames, &error))
        return scree_terminal_error("export", &error);
    printf("%s: contacts of %zu frame%s\n", path, frames, frames == 1 ? "" : "s");
    return SCREE_OK;
}
