/// Pairs one after the other: the physics of the kernels, evaluated in one lane. With a constant variant it is the hot
/// loop of geometries that have no lanes (contact/outlines_batch.c), with that of the job the scalar reference
/// (contact/reference.c).
#ifndef SCREE_CONTACT_ONE_BY_ONE_H
#define SCREE_CONTACT_ONE_BY_ONE_H

#include "contact/advance.h"

SCREE_INLINE void evaluate_pair(contact_job *job, variant v, size_t p)
{
    const int dimension = v.dimension;
    const size_t first = job->first[p], second = job->second[p];
    memory_rows rows = memory_rows_at(job->history, job->last_force, job->rolling, p);
    bodies one = contact_body_at(job, first), other = contact_body_at(job, second);
    bool touching = law_holds(v) ||
                    (geometry_is_coarse(v) ? geometry_touches(v, &one, &other) != 0 : pair_touches(v, &one, &other));
    if (!touching && memory_is_clear(&rows)) return;
    one.hint = job->hint ? &job->hint[p] : NULL;
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

#endif
