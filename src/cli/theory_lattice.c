/// scree theory lattice: closed forms of lattices.
#include "cli/command.h"
#include "cli/terminal.h"
#include "cli/theory.h"

#include <math.h>

static scree_status read_lattice(const scree_command *command, scree_theory_lattice_of *of, scree_error *error)
{
    static const char *const planes[] = {"strain", "stress", NULL}, *const forms[] = {"as_published", "corrected",
                                                                                      NULL};
    const struct {
        const char *name;
        double *value;
    } number[] = {{"kn", &of->normal_stiffness},
                  {"kt", &of->stiffness_ratio},
                  {"young-modulus", &of->young_modulus},
                  {"poisson-ratio", &of->poisson_ratio},
                  {"radius", &of->radius},
                  {"length", &of->length},
                  {"density", &of->density}};
    const char *kind = scree_command_value(command, "kind");
    size_t plane = 0, form = 0;
    scree_status status = SCREE_OK;
    if (kind) of->kind = kind;
    for (size_t k = 0; k < sizeof number / sizeof *number && !status; k++)
        status = scree_command_real(command, number[k].name, number[k].value, error);
    if (!status) status = scree_command_choice(command, "plane", planes, &plane, error);
    if (!status) status = scree_command_choice(command, "tangential", forms, &form, error);
    of->plane_stress = plane == 1;
    of->corrected = form == 1;
    return status;
}

scree_status scree_verb_theory_lattice(const scree_command *command)
{
    scree_theory_lattice_of of = {
        .kind = "hexagonal", .radius = 1, .length = 1, .density = 1, .normal_stiffness = 1, .young_modulus = INFINITY};
    scree_theory *theory = NULL;
    scree_error error = {0};
    scree_status status = read_lattice(command, &of, &error);
    if (!status) status = scree_theory_lattice(&of, &theory, &error);
    return scree_theory_show(command, theory, status, &error);
}
