/// What launchers tell their processes is in the environment: Open MPI in OMPI_COMM_WORLD_*, MPICH and others in PMI_*.
/// SLURM_NTASKS says nothing: a batch script of four tasks that calls `scree` without srun has it, too.
#include "cli/launch.h"

#include "cli/terminal.h"

#include <fcntl.h>
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

/// All that the launcher has started compute together.
static bool is_joined(long size)
{
    int count;
    scree_error error;
    if (!scree_processes_join(&count, &error)) return count == size;
    (void)scree_terminal_error(NULL, &error);
    return false;
}

static bool refuse(const scree_verb *verb, const launcher *by, long size)
{
    if (variable(by->rank, 0) > 0) {
        // A process that ends with an error makes mpirun end the others: number 0 has to have spoken before.
        (void)sleep(1);
        return false;
    }
    fprintf(stderr,
            "scree %s: started %ld times by a launcher of MPI (%s = %ld), but %s computes in one process: each of the "
            "%ld would run the whole case. Start it once, with --threads N for N cores; for many runs use `scree "
            "sweep`. To start separate runs by mpirun all the same, unset %s.\n",
            verb->name, size, by->size, size, verb->together ? "this program, built without MPI," : "it", size,
            by->size);
    return false;
}

bool scree_launch_allows(const scree_verb *verb)
{
    for (size_t k = 0; k < sizeof launchers / sizeof *launchers; k++) {
        const long size = variable(launchers[k].size, 1);
        if (size > 1) return (verb->together && is_joined(size)) || refuse(verb, &launchers[k], size);
    }
    return true;
}

int scree_launch_hush(void)
{
    if (scree_processes_number() == 0) return -1;
    (void)fflush(stderr);
    const int kept = dup(STDERR_FILENO), nowhere = open("/dev/null", O_WRONLY);
    if (nowhere >= 0) (void)dup2(nowhere, STDERR_FILENO);
    if (nowhere >= 0) (void)close(nowhere);
    return kept;
}

void scree_launch_speak(int kept)
{
    if (kept < 0) return;
    (void)fflush(stderr);
    (void)dup2(kept, STDERR_FILENO);
    (void)close(kept);
}
