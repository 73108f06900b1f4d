/// scree list
#include "cli/command.h"

#include <string.h>

scree_status scree_verb_list(const scree_command *command)
{
    (void)command;
    size_t count = scree_template_count(), width = 0;
    for (size_t i = 0; i < count; i++) {
        size_t length = strlen(scree_template_name(i));
        width = length > width ? length : width;
    }
    for (size_t i = 0; i < count; i++)
        printf("%-*s  %s\n", (int)width, scree_template_name(i), scree_template_meaning(i));
    return SCREE_OK;
}
