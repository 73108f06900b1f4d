/// What launchers tell their processes is in the environment: Open MPI in OMPI_COMM_WORLD_*, MPICH and others in PMI_*.
/// SLURM_NTASKS says nothing: a batch script of four tasks that calls `scree` without srun has it, too.
#include "cli/launch.h"

#include "cli/terminal.h"

#include <stdlib.h>
#include <unistd.h>

typedef struct launcher {
    const char *size, *rank; ///< variables: processes in all, number of this one
} launcher;

static const launcher launchers[] = {
    {"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
    {"PMI_SIZE", "PMI_RANK"},
};

/// A variable of the environment that is a whole number; else, and where there is none, `otherwise`.
static long variable(const char *name, long otherwise)
{
    const char *text = getenv(name);
    char *end = NULL;
    long value = text ? strtol(text, &end, 10) : otherwise;
    return text && (end == text || *end) ? otherwise : value;
}

bool scree_launch_is_single(const char *verb)
{
    for (size_t k = 0; k < sizeof launchers / sizeof *launchers; k++) {
        const long size = variable(launchers[k].size, 1);
        if (size <= 1) continue;
        if (variable(launchers[k].rank, 0) > 0) {
            // A process that ends with an error makes mpirun end the others: number 0 has to have spoken before.
            (void)sleep(1);
            return false;
        }
        fprintf(stderr,
                "scree %s: started %ld times by a launcher of MPI (%s = %ld), but this program computes in one "
                "process: each of the %ld would run the whole case. Start it once, with --threads N for N cores; for "
                "many runs use `scree sweep`. To start separate runs by mpirun all the same, unset %s.\n",
                verb, size, launchers[k].size, size, size, launchers[k].size);
        return false;
    }
    return true;
}
