/// The kernel of outlines under laws of areas. What two of them share is found pair by pair, with the corners of each
/// in lanes (shape/polygon_crossings_lanes.h); those that touch, or did so in the last step, wait until there is one
/// for each lane, and go through the law together (contact/group.h). Cost: docs/performance.md.
#define SCREE_MORE_GEOMETRIES(row) row(outlines)
#include "contact/memory_rows.h"
#include "contact/pairs.h"
#include "contact/reference.h"

/// Pairs that wait for a whole group, and what they share.
typedef struct waiting {
    group g;
    int count;
    outlines_share share;
} waiting;

static bool circles_meet(const scree_row *one, const scree_row *other, const double apart[2])
{
    const double reach = one->radius + other->radius;
    return !(reach * reach <= apart[0] * apart[0] + apart[1] * apart[1]);
}

/// Looks at the pairs from p on until there is one for each lane, or up to `end`; returns the next p.
static __attribute__((noinline)) size_t gather(const contact_job *job, size_t p, size_t end, waiting *w)
{
    const scree_polygons *polygons = scree_polygons_of(job->state);
    for (; p < end && w->count < SCREE_LANES; p++) {
        const uint32_t row[2] = {job->first[p], job->second[p]};
        const scree_row *one = &job->row[row[0]], *other = &job->row[row[1]];
        const double apart[2] = {other->x - one->x, other->y - one->y};
        const memory_rows rows = memory_rows_at(job->history, job->last_force, job->rolling, p);
        const bool clear = memory_is_clear(&rows);
        int8_t *hint = job->hint ? &job->hint[p] : NULL;
        if (clear && !circles_meet(one, other, apart)) continue;
        if (!outlines_find(job->state, polygons, row, apart, hint, w->count, &w->share) && clear) continue;
        w->g.pair[w->count++] = p;
    }
    return p;
}

/// Lanes that are left repeat the first pair, which shares nothing there.
SCREE_INLINE void evaluate_waiting(const contact_job *job, variant v, waiting *w, totals *t)
{
    lanes_bits number;
    LANE_LOOP number[k] = (uint64_t)k;
    w->g.present = (lanes_bits)(number < (uint64_t)w->count);
    w->g.share = &w->share;
    for (int k = w->count; k < SCREE_LANES; k++) {
        w->g.pair[k] = w->g.pair[0];
        outlines_share_nothing(&w->share, k);
    }
    w->count = 0;
    evaluate_group(job, v, &w->g, t);
}

/// The job is copied, so that the compiler knows that sums and histories do not overlap it.
SCREE_INLINE void run_outlines(contact_job *given, variant v)
{
    const contact_job copy = *given, *job = &copy;
    const contact_range *range = &job->range;
    const size_t begin[2] = {range->touching_begin, range->near_begin};
    const size_t end[2] = {range->touching_end, range->near_end};
    totals t = {.in_range = ~(lanes_bits){0}};
    waiting w = {.count = 0};
    for (int k = 0; k < 2; k++)
        for (size_t p = begin[k]; p < end[k];) {
            p = gather(job, p, end[k], &w);
            if (w.count == SCREE_LANES) evaluate_waiting(job, v, &w, &t);
        }
    if (w.count > 0) evaluate_waiting(job, v, &w, &t);
    totals_reduce(&t, &given->totals);
}

#define OUTLINES(law_, moments_)                                                                                       \
    run_outlines(job, (variant){2, SCREE_SLOT_##law_, 0, true, true, moments_, GEOMETRY_outlines})

#define PAIRS_OF_LAW(law_)                                                                                             \
    if (law_##_traits[0].areas && v.law == SCREE_SLOT_##law_ && v.geometry == GEOMETRY_outlines && v.ledger) {         \
        if (v.moments)                                                                                                 \
            OUTLINES(law_, true);                                                                                      \
        else                                                                                                           \
            OUTLINES(law_, false);                                                                                     \
        return;                                                                                                        \
    }

void SCREE_KERNEL_NAME(scree_outlines)(contact_job *job)
{
    const variant v = job->variant;
    SCREE_LAWS(PAIRS_OF_LAW)
    contact_pairs_reference(job); // without a ledger
}
