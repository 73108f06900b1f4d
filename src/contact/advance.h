/// One contact of a job, in one lane: the law, the memory, the sums. What the scalar reference, the plates and the
/// walls of the case share.
#ifndef SCREE_CONTACT_ADVANCE_H
#define SCREE_CONTACT_ADVANCE_H

#include "contact/scalar.h"

/// Evaluates the law, advances the memory and accumulates energies, overlap and range.
/// own: constants of the pair's own; NULL: it has none.
SCREE_INLINE contact_quanta contact_advance(contact_job *job, variant v, const scree_pair_constants *constants,
                                            const scree_member_row *own, const kinematics *m, bool touching,
                                            const memory_rows *rows)
{
    law_constants c = constants_get(constants, own);
    law_memory before = memory_get(v, rows), after;
    contact_quanta q = contact_evaluate(v, &c, &job->settings, &job->scale, m, -(lanes_bits)touching, &before, &after);
    memory_set(v, rows, &after);
    contact_totals *totals = &job->totals;
    totals->damping += q.damping;
    totals->friction += q.friction;
    totals->stiffness += q.stiffness;
    totals->in_range &= q.in_range != 0;
    if (own) {
        totals->settle |= q.settle != 0;
        totals->largest_deformation = lanes_at_least(totals->largest_deformation, q.deformation);
        totals->largest_gap = lanes_at_least(totals->largest_gap, m->expansion - m->overlap);
    } else if (touching) {
        totals->largest_overlap = lanes_at_least(totals->largest_overlap, m->overlap);
    }
    return q;
}

/// Row of the stretch of a body; NULL: it is rigid.
static inline const double *contact_stretch_at(const contact_job *job, size_t row)
{
    return job->stretch ? job->stretch + row * scree_stretch_size(job->variant.dimension) : NULL;
}

SCREE_INLINE bodies contact_body_at(const contact_job *job, size_t row)
{
    bodies body = body_get(job->variant.dimension, &job->row[row], job->turn ? &job->turn[row] : NULL);
    body.stretch = contact_stretch_at(job, row);
    body.lead = job->lead ? &job->lead[row] : NULL;
    body.state = job->state;
    body.row = row;
    return body;
}

/// Adds to the moments of a row, where they are asked for.
static inline void contact_add_moments(const contact_job *job, bool deforms, size_t row, contact_branch branch,
                                       vector force)
{
    if (!job->moment) return;
    const int dimension = job->variant.dimension;
    uint64_t moment[9];
    const lanes factor = contact_moment_factor(deforms, &job->scale, branch.arm);
    contact_moments(dimension, branch.along, factor, force, moment);
    int64_t *sum = job->moment + row * scree_moment_size(dimension);
    for (int k = 0; k < dimension * dimension; k++) sum[k] = (int64_t)((uint64_t)sum[k] + moment[k]);
}

/// Adds to the sums of a row, modulo 2^64.
static inline void contact_add_to_sums(const contact_job *job, size_t row, quanta force, quanta torque, uint64_t count)
{
    if (job->variant.dimension == 2) {
        sum_row_add(&job->sum[row], force.x, force.y, torque.x, count);
        return;
    }
    sum_row_add(&job->sum[row], force.x, force.y, force.z, count);
    torque_row_add(&job->torque[row], torque.x, torque.y, torque.z);
}

#endif
