/// Pairs and walls one contact at a time. The physics is the one of the kernels, evaluated in one lane; everything
/// around it (loops, loads, sums) is written plainly, so that a comparison tests the machinery of the kernels.
#include "contact/reference.h"

#include "contact/scalar.h"

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
    into->in_range &= more->in_range;
    for (int w = 0; w < SCREE_WALL_COUNT; w++) {
        into->wall_force[w] += more->wall_force[w];
        for (int k = 0; k < 3; k++) into->wall_shear[w][k] += more->wall_shear[w][k];
    }
}

/// Evaluates the law, advances the memory and books energies, overlap and range.
static contact_quanta evaluate(contact_job *job, const scree_pair_constants *constants, const motion *m, bool touching,
                               const memory_rows *rows)
{
    variant v = job->variant;
    law_constants c = constants_get(constants);
    law_memory before = memory_get(v, rows), after;
    contact_quanta q = contact_evaluate(v, &c, &job->settings, &job->scale, m, -(lanes_bits)touching, &before, &after);
    memory_set(v, rows, &after);
    contact_totals *totals = &job->totals;
    totals->damping += q.damping;
    totals->friction += q.friction;
    totals->stiffness += q.stiffness;
    totals->in_range &= q.in_range != 0;
    if (touching) totals->largest_overlap = lanes_at_least(totals->largest_overlap, m->indentation);
    return q;
}

static bodies body_at(const contact_job *job, size_t row)
{
    return body_get(job->variant.dimension, &job->row[row], job->turn ? &job->turn[row] : NULL);
}

/// Adds to the sums of a row, modulo 2^64.
static void add_to_sums(const contact_job *job, size_t row, quanta force, quanta torque, uint64_t count)
{
    if (job->variant.dimension == 2) {
        sum_row_add(&job->sum[row], force.x, force.y, torque.x, count);
        return;
    }
    sum_row_add(&job->sum[row], force.x, force.y, force.z, count);
    torque_row_add(&job->torque[row], torque.x, torque.y, torque.z);
}

static void evaluate_pair(contact_job *job, size_t p)
{
    const int dimension = job->variant.dimension;
    const size_t first = job->first[p], second = job->second[p];
    memory_rows rows = memory_rows_at(job->history, job->booking, job->rolling, p);
    bool touching = pair_touches(dimension, &job->row[first], &job->row[second]);
    if (!touching && memory_is_clear(&rows)) return;
    bodies one = body_at(job, first), other = body_at(job, second);
    motion m = motion_of_pair(dimension, &one, &other, job->settings.step);
    const scree_pair_constants *constants = &job->model->pairs[(int)one.material][(int)other.material];
    contact_quanta q = evaluate(job, constants, &m, touching, &rows);
    add_to_sums(job, first, q.force, q.torque_first, q.count);
    add_to_sums(job, second, quanta_opposite(q.force), q.torque_second, q.count);
}

void contact_pairs_reference(contact_job *job)
{
    job->totals = contact_totals_none();
    for (size_t p = job->touching_begin; p < job->touching_end; p++) evaluate_pair(job, p);
    for (size_t p = job->near_begin; p < job->near_end; p++) evaluate_pair(job, p);
}

void contact_walls(contact_job *job, const scree_wall *wall, const scree_wall_pair_list *pairs, size_t row_begin,
                   size_t row_end)
{
    const int dimension = job->variant.dimension;
    for (size_t p = 0; p < pairs->count; p++) {
        size_t row = pairs->body[p];
        if (row < row_begin || row >= row_end) continue;
        uint32_t w = pairs->wall[p];
        memory_rows rows = memory_rows_at(pairs->history, pairs->booking, pairs->rolling, p);
        bool touching = wall_touches(dimension, &job->row[row], &wall[w]);
        if (!touching && memory_is_clear(&rows)) continue;
        bodies one = body_at(job, row);
        motion m = motion_of_wall(dimension, &one, &wall[w], job->settings.step);
        contact_quanta q = evaluate(job, &job->model->walls[(int)one.material], &m, touching, &rows);
        add_to_sums(job, row, q.force, q.torque_first, q.count);
        job->totals.wall_force[w] += q.normal;
        job->totals.wall_shear[w][0] -= q.tangential.x;
        job->totals.wall_shear[w][1] -= q.tangential.y;
        job->totals.wall_shear[w][2] -= q.tangential.z;
    }
}
