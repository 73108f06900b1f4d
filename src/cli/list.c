/// scree list
#include "cli/command.h"

#include <string.h>

scree_status scree_verb_list(const scree_command *command)
{
    bool sweeps = scree_command_has(command, "sweeps");
    const char *(*name)(size_t) = sweeps ? scree_sweep_builtin_name : scree_template_name;
    const char *(*meaning)(size_t) = sweeps ? scree_sweep_builtin_meaning : scree_template_meaning;
    size_t count = sweeps ? scree_sweep_builtin_count() : scree_template_count(), width = 0;
    for (size_t i = 0; i < count; i++) {
        size_t length = strlen(name(i));
        width = length > width ? length : width;
    }
    for (size_t i = 0; i < count; i++) printf("%-*s  %s\n", (int)width, name(i), meaning(i));
    return SCREE_OK;
}
