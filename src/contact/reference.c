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
    for (int k = 0; k < SCREE_WALL_COUNT; k++) {
        into->wall_force[k] += more->wall_force[k];
        into->wall_shear[k] += more->wall_shear[k];
    }
}

/// Evaluates the law, advances the history row and books energies, overlap and range.
static contact_quanta evaluate(contact_job *job, const scree_pair_constants *constants, const motion *m, bool touching,
                               scree_history *history)
{
    scree_law law = job->model->law;
    law_constants c = constants_get(constants);
    law_memory before = memory_get(history), after;
    contact_quanta q =
        contact_evaluate(law, job->ledger, &c, &job->settings, &job->scale, m, -(lanes_bits)touching, &before, &after);
    if (!job->ledger) after.value[1] = after.value[2] = after.value[3] = 0;
    if (law_remembers(law, job->ledger)) memcpy(history->value, after.value, sizeof after.value);
    contact_totals *totals = &job->totals;
    totals->damping += q.damping;
    totals->friction += q.friction;
    totals->stiffness += q.stiffness;
    totals->in_range &= q.in_range != 0;
    if (touching) totals->largest_overlap = lanes_at_least(totals->largest_overlap, m->indentation);
    return q;
}

static void evaluate_pair(contact_job *job, size_t p)
{
    const scree_row *first = &job->row[job->first[p]], *second = &job->row[job->second[p]];
    scree_history *history = &job->history[p];
    bool touching = pair_touches(first, second);
    if (!touching && history_is_clear(history)) return;
    bodies one = body_get(first), other = body_get(second);
    motion m = motion_of_pair(&one, &other, job->settings.step);
    if (law_foresees(job->model->law)) {
        foresight ahead1 = foresight_get(&job->foreseen[job->first[p]]);
        foresight ahead2 = foresight_get(&job->foreseen[job->second[p]]);
        motion_foresee(&m, &one, &ahead1, &other, &ahead2);
    }
    const scree_pair_constants *constants = &job->model->pairs[(int)first->material][(int)second->material];
    contact_quanta q = evaluate(job, constants, &m, touching, history);
    sum_row_add(&job->sum[job->first[p]], q.fx, q.fy, q.torque_first, q.count);
    sum_row_add(&job->sum[job->second[p]], -q.fx, -q.fy, q.torque_second, q.count);
}

void contact_pairs_reference(contact_job *job)
{
    job->totals = contact_totals_none();
    for (size_t p = job->touching_begin; p < job->touching_end; p++) evaluate_pair(job, p);
    for (size_t p = job->near_begin; p < job->near_end; p++) evaluate_pair(job, p);
}

void contact_walls(contact_job *job, scree_sum_row *sum, const scree_wall *wall, const scree_wall_pair_list *pairs,
                   size_t row_begin, size_t row_end)
{
    for (size_t p = 0; p < pairs->count; p++) {
        size_t row = pairs->body[p];
        if (row < row_begin || row >= row_end) continue;
        const scree_row *body = &job->row[row];
        uint32_t w = pairs->wall[p];
        bool touching = wall_touches(body, &wall[w]);
        if (!touching && history_is_clear(&pairs->history[p])) continue;
        bodies one = body_get(body);
        motion m = motion_of_wall(&one, &wall[w], job->settings.step);
        if (law_foresees(job->model->law)) {
            foresight ahead = foresight_get(&job->foreseen[row]);
            motion_foresee(&m, &one, &ahead, NULL, NULL);
        }
        const scree_pair_constants *constants = &job->model->walls[(int)body->material];
        contact_quanta q = evaluate(job, constants, &m, touching, &pairs->history[p]);
        sum_row_add(&sum[row], q.fx, q.fy, q.torque_first, q.count);
        job->totals.wall_force[w] += q.normal;
        job->totals.wall_shear[w] -= q.tangential;
    }
}
