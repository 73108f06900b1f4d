/// scree theory ife, bcc, fpa, osl, wedge: piles.
#include "cli/command.h"
#include "cli/terminal.h"
#include "cli/theory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// One angle, or two behind each other with a comma.
static scree_status read_slopes(const scree_command *command, double slope[2], scree_error *error)
{
    const char *text = scree_command_value(command, "phi");
    char *end;
    if (!text) return scree_command_refuse(error, "--phi", "an angle in degrees", "the angle of repose is needed");
    slope[0] = slope[1] = strtod(text, &end);
    bool good = end != text;
    if (good && *end == ',') {
        const char *second = end + 1;
        slope[1] = strtod(second, &end);
        good = end != second;
    }
    if (good && !*end && isfinite(slope[0]) && isfinite(slope[1])) return SCREE_OK;
    return scree_command_refuse(error, "--phi", "degrees, or left,right", "'%s' is no angle", text);
}

/// An angle, or the word `free`, which is NAN.
static scree_status read_axis(const scree_command *command, double *axis, scree_error *error)
{
    const char *text = scree_command_value(command, "axis");
    if (!text || strcmp(text, "free") != 0) return scree_command_real(command, "axis", axis, error);
    *axis = NAN;
    return SCREE_OK;
}

static scree_status read_pile(const scree_command *command, scree_theory_pile_of *of, scree_error *error)
{
    static const char *const states[] = {"active", "passive", NULL};
    const struct {
        const char *name;
        double *value;
    } number[] = {{"height", &of->height}, {"density", &of->density}, {"gravity", &of->gravity},
                  {"eta", &of->eta},       {"mu", &of->mu},           {"ratio", &of->ratio},
                  {"tau", &of->tau},       {"core", &of->core},       {"friction", &of->friction}};
    size_t state = 0;
    scree_status status = read_slopes(command, of->slope, error);
    for (size_t k = 0; k < sizeof number / sizeof *number && !status; k++)
        status = scree_command_real(command, number[k].name, number[k].value, error);
    if (!status) status = read_axis(command, &of->axis, error);
    if (!status) status = scree_command_choice(command, "state", states, &state, error);
    of->passive = state == 1;
    return status;
}

scree_status scree_verb_theory_pile(const scree_command *command)
{
    scree_theory_pile_of of = {.kind = strchr(command->verb->name, ' ') + 1,
                               .height = 1,
                               .density = 1,
                               .gravity = 1,
                               .eta = NAN,
                               .mu = NAN,
                               .ratio = NAN,
                               .tau = NAN,
                               .core = NAN,
                               .friction = NAN};
    scree_theory *theory = NULL;
    scree_error error = {0};
    scree_status status = read_pile(command, &of, &error);
    if (!status) status = scree_theory_pile(&of, &theory, &error);
    return scree_theory_show(command, theory, status, &error);
}
