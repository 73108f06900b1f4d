/// A program that is built without MPI would compute the whole case in each of its processes, so it is refused here
/// and not in each member.
#include "sweep/several.h"

#include "base/program.h"
#include "sweep/member.h"

#include <scree/run.h>

#include <stdio.h>

static const char launcher[] = "mpirun";

static scree_status check_program(bool starts, scree_error *error)
{
    char path[4096];
    if (!scree_processes_can_join())
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "members cannot have several processes: this program is built without MPI (preset mpi, "
                               "docs/clusters.md); --threads N gives each N cores of one machine");
    if (starts && !scree_program_find(launcher, path, sizeof path))
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "members of several processes are started by %s, which is not in PATH", launcher);
    return SCREE_OK;
}

scree_status scree_several_check(const scree_sweep *sweep, const scree_sweep_options *options, bool starts,
                                 scree_error *error)
{
    if (options->ranks <= 1) return SCREE_OK;
    scree_case *c = NULL;
    scree_status status = check_program(starts, error);
    if (!status && sweep->bisects)
        status = scree_error_set(error, SCREE_ERROR_INPUT,
                                 "members of the sweep %s search for a limit, each in one process at a time",
                                 sweep->config.name);
    if (!status) status = scree_member_resolve(sweep, 0, &c, error);
    if (!status) status = scree_case_can_spread(c, error);
    scree_case_free(c);
    return status;
}

size_t scree_several_put(scree_several *several, const scree_sweep_options *options, const char **arguments)
{
    if (options->ranks <= 1) return 0;
    // Without it the start of the process fails, and says so.
    if (!scree_program_find(launcher, several->launcher, sizeof several->launcher))
        (void)snprintf(several->launcher, sizeof several->launcher, "%s", launcher);
    (void)snprintf(several->ranks, sizeof several->ranks, "%d", options->ranks);
    arguments[0] = several->launcher;
    arguments[1] = "-n";
    arguments[2] = several->ranks;
    return 3;
}
