/// Sums of ghosts, and the virial of the contact forces.
///
/// The virial, sum over contacts of f (x) (x_first - x_second) with f the force on the first and the positions that the
/// contact sees, is the sum over all rows, ghosts included, of F (x) x, F the sum on the row. With x = x_parent + H s
/// of a ghost this is
///     sum over bodies of F (x) x + (sum over ghosts of F (x) s) H^T,      F of a body now with those of its ghosts.
/// The second sum is one of integers; the terms of the first are rounded to integers, in quanta of the force times a
/// power of two above every coordinate, and added in 128 bits. Both so depend on nothing but the state: not on the
/// order of rows, on threads, or on which of the two bodies of a contact is the ghost. Rounding: 2^-51 of the largest
/// force times the size of the cell, a body. Cost: d^2 multiplications a body.
#include "contact/ghost_forces.h"

#include "base/wide_sum.h"
#include "comm/comm.h"
#include "state/periodic.h"

#include <math.h>

/// Force sums of a row.
static void sum_of(const scree_state *state, size_t row, int64_t force[3])
{
    const scree_sum_row *sum = &state->sum[row];
    force[0] = sum->fx;
    force[1] = sum->fy;
    force[2] = state->dimension == 3 ? sum->fz : 0;
}

/// Sum of force (x) shift [quanta] over the ghosts, modulo 2^64.
static void sum_faces(const scree_state *state, const scree_ghost_list *list, int64_t faces[9])
{
    for (size_t k = 0; k < list->count; k++) {
        int64_t force[3];
        sum_of(state, state->count + k, force);
        for (int i = 0; i < state->dimension; i++)
            for (int j = 0; j < state->dimension; j++)
                faces[3 * i + j] =
                    (int64_t)((uint64_t)faces[3 * i + j] + (uint64_t)(force[i] * list->ghost[k].shift[j]));
    }
}

typedef struct virial_task {
    const scree_state *state;
    double bound;                    ///< m, power of two above the magnitude of every coordinate
    double largest[SCREE_TEAM_MOST]; ///< m
    scree_wide_sum sum[SCREE_TEAM_MOST];
} virial_task;

static void bound_share(void *argument, int index, int count)
{
    virial_task *task = argument;
    double largest = 0;
    size_t end = scree_thread_pool_begin(task->state->count, index + 1, count);
    for (size_t row = scree_thread_pool_begin(task->state->count, index, count); row < end; row++) {
        scree_vector position;
        scree_body_position(task->state, row, position);
        for (int k = 0; k < 3; k++) largest = fabs(position[k]) > largest ? fabs(position[k]) : largest;
    }
    task->largest[index] = largest;
}

static void sum_share(void *argument, int index, int count)
{
    virial_task *task = argument;
    const scree_state *state = task->state;
    const double inverse = 1 / task->bound;
    scree_wide_sum sum = {{0}};
    size_t end = scree_thread_pool_begin(state->count, index + 1, count);
    for (size_t row = scree_thread_pool_begin(state->count, index, count); row < end; row++) {
        scree_vector position;
        int64_t force[3];
        scree_body_position(state, row, position);
        sum_of(state, row, force);
        for (int i = 0; i < state->dimension; i++)
            for (int j = 0; j < state->dimension; j++)
                sum.value[3 * i + j] += (int64_t)rint((double)force[i] * (position[j] * inverse));
    }
    task->sum[index] = sum;
}

/// sum over bodies of F (x) x [J].
static void sum_bodies(const scree_state *state, scree_work *work, double product[9])
{
    virial_task task; // large, and filled by the shares
    const int shares = scree_work_shares(work);
    double largest = 0;
    int exponent;
    task.state = state;
    scree_thread_pool_run(&work->pool, shares, bound_share, &task);
    for (int k = 0; k < shares; k++) largest = fmax(largest, task.largest[k]);
    (void)frexp(largest, &exponent);
    task.bound = ldexp(1.0, exponent);
    scree_thread_pool_run(&work->pool, shares, sum_share, &task);
    scree_wide_total(task.sum, shares, state->force_quantum * task.bound, product);
}

void scree_ghosts_add_back(scree_state *state, scree_work *work)
{
    scree_periodic_cell *cell = scree_cell(state);
    int64_t faces[9] = {0};
    if (!cell->directions) return;
    bool whole = scree_periodic_is_whole(state);
    if (whole) sum_faces(state, &work->ghosts, faces);
    scree_comm_add_back(state, work);
    if (!whole) return;
    sum_bodies(state, work, cell->virial);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                cell->virial[3 * i + j] += (double)faces[3 * i + k] * state->force_quantum * cell->lattice[3 * j + k];
}
