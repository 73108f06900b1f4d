/// Values of a theory on the terminal and in a folder.
#include "cli/theory.h"
#include "cli/terminal.h"

scree_status scree_theory_show(const scree_command *command, scree_theory *theory, scree_status status,
                               scree_error *error)
{
    const char *folder = scree_command_value(command, "output");
    const scree_theory_value *value;
    const size_t count = theory && !status ? scree_theory_values(theory, &value) : 0;
    for (size_t k = 0; k < count; k++)
        printf("%-26s %-13.7g %-5s %s\n", value[k].name, value[k].value, value[k].unit, value[k].meaning);
    if (!status && folder) status = scree_theory_write(theory, folder, error);
    if (status) status = scree_terminal_error(command->verb->name, error);
    scree_theory_free(theory);
    return status;
}
