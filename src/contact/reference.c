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

static void evaluate_pair(contact_job *job, size_t p)
{
    const int dimension = job->variant.dimension;
    const size_t first = job->first[p], second = job->second[p];
    memory_rows rows = memory_rows_at(job->history, job->last_force, job->rolling, p);
    bodies one = contact_body_at(job, first), other = contact_body_at(job, second);
    bool touching = law_holds(job->variant) || pair_touches(job->variant, &one, &other);
    if (!touching && memory_is_clear(&rows)) return;
    kinematics m = geometry_kinematics(job->variant, &one, &other, job->settings.step);
    if (law_deforms(job->variant)) kinematics_expand(dimension, &m, &one, &other, job->settings.step);
    if (law_predicts(job->variant)) {
        prediction ahead = prediction_get(dimension, &job->predicted[first]);
        prediction ahead_second = prediction_get(dimension, &job->predicted[second]);
        kinematics_predict(dimension, &m, &one, &ahead, &other, &ahead_second);
    }
    const scree_pair_constants *constants = &job->pairs[(int)one.material][(int)other.material];
    const scree_member_row *own = law_holds(job->variant) ? &job->own[p] : NULL;
    contact_quanta q = contact_advance(job, job->variant, constants, own, &m, touching, &rows);
    contact_add_to_sums(job, first, q.force, q.torque_first, q.count);
    contact_add_to_sums(job, second, quanta_opposite(q.force), q.torque_second, q.count);
    contact_add_moments(job, first, contact_branch_of(job->variant, law_deforms(job->variant), &m, &one, true),
                        q.straining);
    contact_add_moments(job, second, contact_branch_of(job->variant, law_deforms(job->variant), &m, &other, false),
                        q.straining);
}

void contact_pairs_reference(contact_job *job)
{
    const contact_range *range = &job->range;
    job->totals = contact_totals_none();
    for (size_t p = range->touching_begin; p < range->touching_end; p++) evaluate_pair(job, p);
    for (size_t p = range->near_begin; p < range->near_end; p++) evaluate_pair(job, p);
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
        if (law_deforms(v)) kinematics_expand(v.dimension, &m, &one, NULL, job->settings.step);
        if (law_predicts(v)) {
            prediction ahead = prediction_get(v.dimension, &job->predicted[row]);
            kinematics_predict(v.dimension, &m, &one, &ahead, NULL, NULL);
        }
        contact_quanta q = contact_advance(job, v, &job->model->walls[(int)one.material], NULL, &m, touching, &rows);
        contact_add_to_sums(job, row, q.force, q.torque_first, q.count);
        if (v.moments) contact_add_moments(job, row, contact_branch_of(v, law_deforms(v), &m, &one, true), q.straining);
        job->totals.wall_force[w] += q.normal;
        job->totals.wall_shear[w][0] -= q.tangential.x;
        job->totals.wall_shear[w][1] -= q.tangential.y;
        job->totals.wall_shear[w][2] -= q.tangential.z;
    }
}

#define WALLS_OF_LAW(law_)                                                                                             \
    if (v.law == SCREE_SLOT_##law_ && v.dimension == 3)                                                                \
        evaluate_walls(job, (variant){3, SCREE_SLOT_##law_, v.option, true, v.ledger, v.moments, v.geometry}, wall,    \
                       pairs, row_begin, row_end);                                                                     \
    if (v.law == SCREE_SLOT_##law_ && v.dimension == 2)                                                                \
        evaluate_walls(job, (variant){2, SCREE_SLOT_##law_, v.option, true, v.ledger, v.moments, v.geometry}, wall,    \
                       pairs, row_begin, row_end);

void contact_walls(contact_job *job, const scree_wall *wall, const scree_wall_pair_list *pairs, size_t row_begin,
                   size_t row_end)
{
    const variant v = job->variant;
    SCREE_LAWS(WALLS_OF_LAW)
}
