/// scree theory flamant, layer: a line load.
#include "cli/command.h"
#include "cli/terminal.h"
#include "cli/theory.h"

#include <string.h>

scree_status scree_verb_theory_layer(const scree_command *command)
{
    static const char *const planes[] = {"strain", "stress", NULL};
    const bool based = strcmp(command->verb->name, "theory layer") == 0;
    const char *base = scree_command_value(command, "base");
    scree_theory_layer_of of = {.base = !based ? "none"
                                        : base ? base
                                               : "bonded",
                                .force = 1,
                                .thickness = 1,
                                .poisson_ratio = 0.3};
    scree_theory *theory = NULL;
    scree_error error = {0};
    size_t plane = 0;
    scree_status status = scree_command_real(command, "force", &of.force, &error);
    if (!status) status = scree_command_real(command, based ? "thickness" : "depth", &of.thickness, &error);
    if (!status) status = scree_command_real(command, "nu", &of.poisson_ratio, &error);
    if (!status) status = scree_command_choice(command, "plane", planes, &plane, &error);
    of.plane_stress = plane == 1;
    if (!status) status = scree_theory_layer(&of, &theory, &error);
    return scree_theory_show(command, theory, status, &error);
}
