#include "cli/specimen_argument.h"

#include "cli/case_argument.h"
#include "cli/terminal.h"

#include <math.h>
#include <sys/stat.h>

bool scree_argument_is_run(const char *folder)
{
    char path[4096];
    struct stat information;
    int length = snprintf(path, sizeof path, "%s/case.yaml", folder);
    return length > 0 && (size_t)length < sizeof path && stat(path, &information) == 0;
}

void scree_specimen_argument_free(scree_specimen_argument *argument)
{
    scree_simulation_free(argument->simulation);
    scree_case_free(argument->c);
    *argument = (scree_specimen_argument){0};
}

static scree_status read_elasticity(const scree_command *command, scree_specimen_argument *out, scree_error *error)
{
    out->given = (scree_particle_elasticity){NAN, 0};
    scree_status status = scree_command_real(command, "young-modulus", &out->given.young_modulus, error);
    if (!status) status = scree_command_real(command, "poisson-ratio", &out->given.poisson_ratio, error);
    if (status) return status;
    if (!isnan(out->given.young_modulus)) out->elasticity = &out->given;
    if (out->elasticity || !scree_command_has(command, "poisson-ratio")) return SCREE_OK;
    return scree_command_refuse(error, "--poisson-ratio", "--young-modulus beside it",
                                "a Poisson's ratio alone does not make particles elastic");
}

scree_status scree_specimen_argument_read(const scree_command *command, scree_specimen_argument *out)
{
    const char *name = command->argument[0], *at = scree_command_value(command, "at");
    scree_error error = {0};
    *out = (scree_specimen_argument){0};
    scree_status status = read_elasticity(command, out, &error);
    if (!status && scree_argument_is_run(name)) {
        status =
            at ? scree_command_refuse(&error, "--at", "a case in its place", "the folder of a run is read as it stands")
               : scree_simulation_open_run(name, &out->c, &out->simulation, &error);
    } else if (!status) {
        if ((status = scree_case_argument_read(command, name, &out->c))) return status;
        status = scree_simulation_create(out->c, 0, &out->simulation, &error);
        if (!status) status = scree_simulation_begin_stage(out->simulation, at, &error);
    }
    if (!status) return SCREE_OK;
    status = scree_terminal_error(command->verb->name, &error);
    scree_specimen_argument_free(out);
    return status;
}
