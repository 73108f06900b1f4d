/// What a sweep will cost: the case of each point is set going for a moment (scree_case_summarise), and counts as often
/// as it has realisations. Of searches (bisect.h) it is the cost of one run of each. What members share (share.h)
/// counts in each of them. Cost: some tenths of a second a point.
#include "base/handle.h"
#include "sweep/sweep.h"

#include <math.h>

scree_status scree_sweep_estimate_cost(const scree_sweep *sweep, bool figures, scree_sweep_cost *cost,
                                       scree_error *error)
{
    scree_handle_check(sweep, "a sweep");
    const size_t members = scree_sweep_member_count(sweep), points = sweep->point_count;
    const bool drawn = figures && scree_sweep_asks_for(sweep, "output.figures");
    *cost = (scree_sweep_cost){.members = members, .searches = sweep->config.bisect.key[0] != 0};
    for (size_t point = 0; point < points; point++) {
        scree_case *c;
        scree_case_summary summary;
        scree_status status = scree_member_resolve(sweep, point, &c, error); // the first realisation of each point
        if (!status) status = scree_case_summarise(c, &summary, error);
        scree_case_free(c);
        if (status == SCREE_ERROR_INPUT && cost->searches) { // a value between its ends may serve
            cost->unknown += members / points;
            continue;
        }
        if (status) return status;
        const double seconds = summary.stepping + summary.output + (drawn ? summary.figures : 0);
        cost->memory = fmax(cost->memory, summary.memory);
        if (isnan(seconds)) {
            cost->unknown += members / points;
            continue;
        }
        cost->longest = fmax(cost->longest, seconds);
        cost->seconds += seconds * (double)(members / points);
    }
    return SCREE_OK;
}
