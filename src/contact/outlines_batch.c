/// The kernel of outlines under laws of areas. Of most pairs it is known since a few steps where their outlines cross,
/// or that they lie apart (shape/polygon_hint.h): that is asked in lanes. Others are looked at one by one. Those that
/// touch, or did so in the last step, wait until there is one for each lane, and go through the geometry
/// (outlines_lanes.h) and the law together (contact/group.h). Cost: docs/performance.md.
#define SCREE_MORE_GEOMETRIES(row) row(outlines)
#include "contact/memory_rows.h"
#include "contact/pairs.h"
#include "shape/polygon_hint.h"

/// Pairs that wait for a whole group.
typedef struct waiting {
    size_t pair[2 * SCREE_LANES];
    int count;
} waiting;

// ---- what is known -------------------------------------------------------------------------------------------------

/// Bits of pairs: of those whose outlines cross twice, and of those that lie apart.
typedef struct known {
    unsigned twice, apart;
} known;

/// A number of each lane.
SCREE_INLINE lanes load_numbers(const double *const from[SCREE_LANES])
{
    row4 row[SCREE_LANES];
    LANE_LOOP row[k] = (row4){*from[k], 0, 0, 0};
    return columns_of_rows(row).c0;
}

/// Where both bodies belong to this process, and are no images of others: only their angles are known.
SCREE_INLINE unsigned own_pairs(const size_t row[2][SCREE_LANES], size_t count)
{
    unsigned bits = 0;
    LANE_LOOP bits |= (unsigned)(row[0][k] < count && row[1][k] < count) << k;
    return bits;
}

/// Asks the hints of as many pairs as there are lanes.
SCREE_INLINE known ask_hints(const contact_job *job, const size_t pair[SCREE_LANES])
{
    size_t row[2][SCREE_LANES], offset[2][SCREE_LANES];
    const double *angle[2][SCREE_LANES];
    const float *pose[SCREE_LANES], *room[SCREE_LANES];
    LANE_LOOP
    {
        row[0][k] = job->first[pair[k]];
        row[1][k] = job->second[pair[k]];
        pose[k] = &job->hint[pair[k]].pose[0];
        room[k] = &job->hint[pair[k]].pose[1];
    }
    const unsigned own = own_pairs((const size_t(*)[SCREE_LANES])row, job->state->count);
    for (int b = 0; b < 2; b++) {
        LANE_LOOP offset[b][k] = row[b][k] * 32;
        LANE_LOOP angle[b][k] = &job->state->angle[own >> k & 1 ? row[b][k] : 0];
    }
    const columns then = columns_load_single(pose);                                            // x, y, both angles
    const columns first = load_rows(job, offset[0], 0), second = load_rows(job, offset[1], 0); // x, y, ., radius
    const lanes turned = lanes_abs(load_numbers(angle[0]) - then.c2) + lanes_abs(load_numbers(angle[1]) - then.c3);
    const lanes shifted = lanes_abs(second.c0 - first.c0 - then.c0) + lanes_abs(second.c1 - first.c1 - then.c1);
    const lanes lever = first.c3 + second.c3 + lanes_at_least(first.c3, second.c3); // scree_polygon_lever
    const lanes moved = shifted + lever * turned, left = columns_load_single(room).c3;
    return (known){.twice = own & lanes_ones(lanes_at_or_below(moved, left)),
                   .apart = own & lanes_ones(lanes_at_or_below(moved, -left))};
}

// ---- what is looked at ---------------------------------------------------------------------------------------------

/// Looks at a pair, and renews its hint; false: it shares nothing, and did not in the last step.
static __attribute__((noinline)) bool look(const contact_job *job, size_t p)
{
    const scree_polygons *polygons = scree_polygons_of(job->state);
    const uint32_t row[2] = {job->first[p], job->second[p]};
    const scree_row *one = &job->row[row[0]], *other = &job->row[row[1]];
    scree_polygon_pose pose = {.apart = {other->x - one->x, other->y - one->y}};
    const scree_polygon polygon[2] = {scree_polygon_of_row(job->state, polygons, row[0]),
                                      scree_polygon_of_row(job->state, polygons, row[1])};
    for (int b = 0; b < 2; b++) {
        pose.polygon[b] = &polygon[b];
        pose.fixed = pose.fixed || row[b] >= job->state->count;
        pose.angle[b] = row[b] < job->state->count ? job->state->angle[row[b]] : 0;
    }
    if (scree_pair_hint_renew(&pose, &job->hint[p])) return true;
    const memory_rows rows = memory_rows_at(job->history, job->last_force, job->rolling, p);
    return !memory_is_clear(&rows);
}

/// Puts those of `count` pairs from p on to the waiting ones that may touch, or did so in the last step.
SCREE_INLINE void gather(const contact_job *job, size_t p, size_t count, waiting *w)
{
    size_t pair[SCREE_LANES];
    LANE_LOOP pair[k] = p + ((size_t)k < count ? (size_t)k : 0);
    const unsigned all = (1U << count) - 1;
    const known now = ask_hints(job, pair);
    for (unsigned rest = all & ~now.apart; rest; rest &= rest - 1) {
        const int k = __builtin_ctz(rest);
        if (now.twice >> k & 1 || look(job, p + (size_t)k)) w->pair[w->count++] = p + (size_t)k;
    }
}

// ---- what they share -----------------------------------------------------------------------------------------------

/// What has been found of a pair, into lane k: where it crosses, if that is all that is to be known.
SCREE_INLINE void find_one(const contact_job *job, const scree_polygons *polygons, size_t p, int k, outlines_found *f)
{
    const uint32_t row[2] = {job->first[p], job->second[p]};
    const scree_pair_hint *hint = &job->hint[p];
    f->twice[k] = -(uint64_t)(hint->room > 0);
    if (hint->room > 0) {
        for (int b = 0; b < 2; b++) {
            const scree_form *form = &job->state->form[row[b]];
            outlines_share_body(&f->share, k, b, form->radius, form->turning);
            f->corner[b][k] = polygons->of[row[b]].first;
            f->count[b][k] = polygons->of[row[b]].count;
            for (int e = 0; e < 2; e++) f->edge[e][b][k] = (uint64_t)hint->edge[2 * e + b];
        }
        return;
    }
    const scree_row *one = &job->row[row[0]], *other = &job->row[row[1]];
    const double apart[2] = {other->x - one->x, other->y - one->y};
    outlines_found_nothing(f, k);
    outlines_find(job->state, polygons, row, apart, k, &f->share);
}

/// Evaluates the first of the waiting pairs. Lanes that are left repeat the first pair, which shares nothing there.
SCREE_INLINE void evaluate_waiting(const contact_job *job, variant v, waiting *w, totals *t)
{
    const scree_polygons *polygons = scree_polygons_of(job->state);
    const int count = w->count < SCREE_LANES ? w->count : SCREE_LANES;
    outlines_found found;
    group g = {.found = &found};
    lanes_bits number;
    found.posed = (const double(*)[2])polygons->posed;
    LANE_LOOP number[k] = (uint64_t)k;
    g.present = (lanes_bits)(number < (uint64_t)count);
    for (int k = 0; k < SCREE_LANES; k++) {
        g.pair[k] = w->pair[k < count ? k : 0];
        if (k < count)
            find_one(job, polygons, g.pair[k], k, &found);
        else
            outlines_found_nothing(&found, k);
    }
    w->count -= count;
    LANE_LOOP w->pair[k] = w->pair[SCREE_LANES + k];
    evaluate_group(job, v, &g, t);
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
    for (int part = 0; part < 2; part++)
        for (size_t p = begin[part]; p < end[part]; p += SCREE_LANES) {
            gather(job, p, end[part] - p < SCREE_LANES ? end[part] - p : SCREE_LANES, &w);
            if (w.count >= SCREE_LANES) evaluate_waiting(job, v, &w, &t);
        }
    if (w.count > 0) evaluate_waiting(job, v, &w, &t);
    totals_reduce(&t, &given->totals);
}

#define OUTLINES(law_, moments_)                                                                                       \
    run_outlines(job, (variant){2, SCREE_SLOT_##law_, 0, true, moments_, GEOMETRY_outlines})

#define PAIRS_OF_LAW(law_)                                                                                             \
    if (law_##_traits[0].areas && v.law == SCREE_SLOT_##law_ && v.geometry == GEOMETRY_outlines) {                     \
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
}
