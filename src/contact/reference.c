/// Pairs and walls one contact at a time. The physics is the one of the kernels, evaluated in one lane; everything
/// around it (loops, loads, sums) is written plainly, so that a comparison tests the machinery of the kernels.
#include "contact/reference.h"

#include "contact/advance.h"
#include "state/plates.h"

#define WALL_PAIRS_AHEAD 8

contact_totals contact_totals_none(void)
{
    return (contact_totals){.in_range = true};
}

void contact_totals_add(contact_totals *into, const contact_totals *more)
{
    into->damping += more->damping;
    into->friction += more->friction;
    into->stiffness += more->stiffness;
    into->largest_overlap = lanes_at_least(into->largest_overlap, more->largest_overlap);
    into->largest_deformation = lanes_at_least(into->largest_deformation, more->largest_deformation);
    into->largest_gap = lanes_at_least(into->largest_gap, more->largest_gap);
    into->settle |= more->settle;
    into->in_range &= more->in_range;
    for (int w = 0; w < SCREE_WALL_COUNT; w++) {
        into->wall_force[w] += more->wall_force[w];
        for (int k = 0; k < 3; k++) into->wall_shear[w][k] += more->wall_shear[w][k];
    }
    for (int w = 0; w < SCREE_SURFACES; w++)
        for (int k = 0; k < 3; k++) {
            into->surface_force[w][k] += more->surface_force[w][k];
            into->surface_torque[w][k] += more->surface_torque[w][k];
        }
}

SCREE_INLINE void evaluate_pair(contact_job *job, variant v, size_t p)
{
    const int dimension = v.dimension;
    const size_t first = job->first[p], second = job->second[p];
    memory_rows rows = memory_rows_at(job->history, job->last_force, job->rolling, p);
    bodies one = contact_body_at(job, first), other = contact_body_at(job, second);
    bool touching = law_holds(v) ||
                    (geometry_is_coarse(v) ? geometry_touches(v, &one, &other) != 0 : pair_touches(v, &one, &other));
    if (!touching && memory_is_clear(&rows)) return;
    kinematics m = geometry_kinematics(v, &one, &other, job->settings.step);
    kinematics_lead(v, &m, &one, &other);
    if (geometry_is_coarse(v) && !(touching = touching && expanded_touch(&m)) && memory_is_clear(&rows)) return;
    const bool deforms = law_deforms(v);
    if (deforms) {
        const stretch both = stretch_get(dimension, one.stretch, other.stretch);
        kinematics_expand(dimension, &m, &both, job->settings.step);
    }
    if (law_predicts(v)) {
        prediction ahead = prediction_get(dimension, &job->predicted[first]);
        prediction ahead_second = prediction_get(dimension, &job->predicted[second]);
        kinematics_predict(dimension, &m, &one, &ahead, &other, &ahead_second);
    }
    const scree_pair_constants *constants = &job->pairs[(int)one.material][(int)other.material];
    const scree_member_row *own = law_holds(v) ? &job->own[p] : NULL;
    contact_quanta q = contact_advance(job, v, constants, own, &m, touching, &rows);
    contact_add_to_sums(job, first, q.force, q.torque_first, q.count);
    contact_add_to_sums(job, second, quanta_opposite(q.force), q.torque_second, q.count);
    contact_add_moments(job, deforms, first, contact_branch_of(v, &m, true), q.straining);
    contact_add_moments(job, deforms, second, contact_branch_of(v, &m, false), q.straining);
}

SCREE_INLINE void evaluate_range(contact_job *job, variant v)
{
    const contact_range *range = &job->range;
    for (size_t p = range->touching_begin; p < range->touching_end; p++) evaluate_pair(job, v, p);
    for (size_t p = range->near_begin; p < range->near_end; p++) evaluate_pair(job, v, p);
}

/// The geometry with gains.
#define GAINS_OF(name) +(name##_traits.gains ? GEOMETRY_##name : 0)
#define GAINS          (0 SCREE_GEOMETRIES_ONE_BY_ONE(GAINS_OF))

/// The hot loop of that geometry, with law and geometry as constants; outlines have one of their own
/// (outlines_batch.c).
#define PAIRS_OF_LAW(law_)                                                                                             \
    if (!law_##_traits[0].areas && v.law == SCREE_SLOT_##law_ && v.geometry == GAINS) {                                \
        evaluate_range(job, (variant){2, SCREE_SLOT_##law_, v.option, true, v.moments, GAINS});                        \
        return;                                                                                                        \
    }

void contact_pairs_reference(contact_job *job)
{
    const variant v = job->variant;
    job->totals = contact_totals_none();
    SCREE_LAWS(PAIRS_OF_LAW)
    evaluate_range(job, v);
}

/// The bodies at a wall lie apart in memory.
static inline void prefetch_wall_pair(const contact_job *job, const scree_wall_pair_list *pairs, size_t p)
{
    if (p >= pairs->count) return;
    size_t row = pairs->body[p];
    __builtin_prefetch(&job->row[row]);
    __builtin_prefetch(&job->sum[row], 1);
    if (!job->turn) return;
    __builtin_prefetch(&job->turn[row]);
    __builtin_prefetch(&job->torque[row], 1);
}

/// Wall contacts are part of every evaluation: their code knows the dimension and the law.
SCREE_INLINE void evaluate_walls(contact_job *job, variant v, const scree_wall *wall, const scree_wall_pair_list *pairs,
                                 size_t row_begin, size_t row_end)
{
    const uint8_t *laws = pairs->law;
    const uint8_t law = (uint8_t)job->law;
    for (size_t p = 0; p < pairs->count; p++) {
        size_t row = pairs->body[p];
        prefetch_wall_pair(job, pairs, p + WALL_PAIRS_AHEAD);
        if (row < row_begin || row >= row_end || (laws && laws[p] != law)) continue;
        uint32_t w = pairs->wall[p];
        memory_rows rows = memory_rows_at(pairs->history, pairs->last_force, pairs->rolling, p);
        bodies one = contact_body_at(job, row);
        bool touching = wall_touches(v, &one, &wall[w]);
        if (!touching && memory_is_clear(&rows)) continue;
        kinematics m = kinematics_of_wall(v, &one, &wall[w], job->settings.step);
        if (law_deforms(v)) {
            const stretch own = stretch_get(v.dimension, one.stretch, NULL);
            kinematics_expand(v.dimension, &m, &own, job->settings.step);
        }
        if (law_predicts(v)) {
            prediction ahead = prediction_get(v.dimension, &job->predicted[row]);
            kinematics_predict(v.dimension, &m, &one, &ahead, NULL, NULL);
        }
        contact_quanta q = contact_advance(job, v, &job->model->walls[(int)one.material], NULL, &m, touching, &rows);
        contact_add_to_sums(job, row, q.force, q.torque_first, q.count);
        if (v.moments) contact_add_moments(job, law_deforms(v), row, contact_branch_of(v, &m, true), q.straining);
        job->totals.wall_force[w] += q.normal;
        job->totals.wall_shear[w][0] -= q.tangential.x;
        job->totals.wall_shear[w][1] -= q.tangential.y;
        job->totals.wall_shear[w][2] -= q.tangential.z;
    }
}

#define WALLS_OF_LAW(law_, geometry_)                                                                                  \
    if (v.law == SCREE_SLOT_##law_ && v.dimension == 3)                                                                \
        evaluate_walls(job, (variant){3, SCREE_SLOT_##law_, v.option, true, v.moments, geometry_}, wall, pairs,        \
                       row_begin, row_end);                                                                            \
    if (v.law == SCREE_SLOT_##law_ && v.dimension == 2)                                                                \
        evaluate_walls(job, (variant){2, SCREE_SLOT_##law_, v.option, true, v.moments, geometry_}, wall, pairs,        \
                       row_begin, row_end);

/// Of geometries of one by one, apart from that in lanes, whose walls are as fast as if there were no others.
#define WALLS_ONE_BY_ONE(law_) WALLS_OF_LAW(law_, v.geometry)
__attribute__((noinline)) static void walls_one_by_one(contact_job *job, const scree_wall *wall,
                                                       const scree_wall_pair_list *pairs, size_t row_begin,
                                                       size_t row_end)
{
    const variant v = job->variant;
    SCREE_LAWS(WALLS_ONE_BY_ONE)
}

#define WALLS_IN_LANES(law_) WALLS_OF_LAW(law_, GEOMETRIES_IN_LANES == 1 ? 0 : v.geometry)
void contact_walls(contact_job *job, const scree_wall *wall, const scree_wall_pair_list *pairs, size_t row_begin,
                   size_t row_end)
{
    const variant v = job->variant;
    if (geometry_is_one_by_one(v)) {
        walls_one_by_one(job, wall, pairs, row_begin, row_end);
        return;
    }
    SCREE_LAWS(WALLS_IN_LANES)
}
