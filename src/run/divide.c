/// What one of several processes takes: its part of the steps, and all that is not divided.
///
/// Ghosts. A part with n bodies is told of a layer at its faces and along its edges, g = a n^((d-1)/d) + b n^((d-2)/d),
/// a and b fitted to counts of pressed periodic packings of 20,000 spheres and discs on 8 to 64 processes
/// (bench/ranks.sh, docs/performance.md). Half of a layer: of a pair of two processes one evaluates it. At most all
/// bodies of others.
///
/// Time. Steps are divided; a ghost costs as much as a body, and the fullest part counts, which may have
/// SCREE_BALANCE_EXPECTED times the mean. Preparation is not divided, nor is what process 0 does with the whole sample:
/// a list of its pairs where it looks at it, samples, files and figures. Messages are left out: they depend on the
/// network.
///
/// Memory. Process 0 has the whole sample where it prepares it and where somebody looks at it; another one has its
/// part, the fullest one here, and ghosts.
///
/// Limits: other size ratios, open piles and thin layers have other ghosts; few processes have less (a part of two has
/// neighbours on two sides).
#include "base/handle.h"
#include "case/case.h"
#include "comm/comm.h"
#include "comm/parts.h"
#include "run/estimate.h"
#include "run/ranks.h"

#include <math.h>

_Static_assert((int)SCREE_MOST_PROCESSES == (int)SCREE_PROCESSES, "the public limit is that of the transport");

/// Of two and three dimensions.
typedef struct layer {
    double surface, edge; ///< a, b
    double bytes;         ///< a ghost and step: what it follows in, and gives back
} layer;
static const layer layers[2] = {{2.65, 0.446, 72}, {5.6, 3.62, 128}};

static double ghosts_of(int dimension, double bodies, double all)
{
    const layer *l = &layers[dimension == 3];
    const double ghosts = l->surface * pow(bodies, 1 - 1.0 / dimension) + l->edge * pow(bodies, 1 - 2.0 / dimension);
    return fmin(ghosts, all - bodies);
}

scree_status scree_case_can_spread(const scree_case *c, scree_error *error)
{
    scree_handle_check(c, "a case");
    scree_simulation s;
    scree_status status = scree_simulation_open(c, 1, &s, error);
    if (!status) status = scree_ranks_can_spread(&s, error);
    scree_simulation_close(&s);
    return status;
}

static scree_status check(const scree_case *c, int processes, scree_error *error)
{
    if (processes >= 1 && processes <= SCREE_PROCESSES)
        return processes == 1 ? SCREE_OK : scree_case_can_spread(c, error);
    return scree_error_set(error, SCREE_ERROR_INPUT, "%d processes (accepted: from 1 to %d)", processes,
                           SCREE_PROCESSES);
}

scree_status scree_case_divide(const scree_case *c, const scree_case_summary *summary, int processes,
                               scree_case_rank *rank, scree_error *error)
{
    scree_handle_check(c, "a case");
    scree_model model;
    scree_status status = scree_case_model(c, &model, error);
    if (!status) status = check(c, processes, error);
    if (status) return status;
    const double all = (double)summary->particles, bodies = all / processes;
    const double ghosts = ghosts_of(model.dimension, bodies, all);
    const double steps = summary->stepping - summary->preparation;
    const double fullest = processes > 1 ? SCREE_BALANCE_EXPECTED : 1;
    *rank = (scree_case_rank){.bodies = bodies,
                              .ghosts = ghosts,
                              .sent = ghosts * layers[model.dimension == 3].bytes,
                              .memory = {summary->memory, summary->memory},
                              .preparation = summary->preparation,
                              .stepping = steps / all * (fullest * bodies + ghosts)};
    if (processes > 1) {
        rank->lists = summary->lists;
        for (int k = 0; k < 2; k++)
            rank->memory[k] = scree_rank_memory_expect(&model, fullest * bodies, ghosts, k == 0);
    }
    rank->output = summary->output + summary->figures;
    rank->seconds = rank->preparation + rank->stepping + rank->lists + rank->output;
    return SCREE_OK;
}
