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

// Loops over all bodies and ghosts are made once for each dimension, a constant there.
#define VIRIAL_INLINE static inline __attribute__((always_inline))

/// Force sums of a row.
VIRIAL_INLINE void sum_of(int dimension, const scree_sum_row *sum, int64_t force[3])
{
    force[0] = sum->fx;
    force[1] = sum->fy;
    force[2] = dimension == 3 ? sum->fz : 0;
}

VIRIAL_INLINE void add_faces(int dimension, const scree_sum_row *sum, const scree_ghost_list *list, int64_t faces[9])
{
    uint64_t total[9] = {0};
    for (size_t k = 0; k < list->count; k++) {
        int64_t force[3];
        sum_of(dimension, &sum[k], force);
        for (int i = 0; i < dimension; i++)
            for (int j = 0; j < dimension; j++)
                total[3 * i + j] += (uint64_t)force[i] * (uint64_t)(int64_t)list->ghost[k].shift[j];
    }
    for (int k = 0; k < 9; k++) faces[k] = (int64_t)total[k];
}

/// Sum of force (x) shift [quanta] over the ghosts that are here, modulo 2^64.
static void sum_faces(const scree_state *state, const scree_ghost_list *list, int64_t faces[9])
{
    if (state->dimension == 3)
        add_faces(3, state->sum + state->count, list, faces);
    else
        add_faces(2, state->sum + state->count, list, faces);
}

typedef struct virial_task {
    const scree_state *state;
    double bound;                           ///< m, power of two above the magnitude of every coordinate
    double largest[SCREE_THREAD_POOL_MOST]; ///< m
    scree_wide_sum sum[SCREE_THREAD_POOL_MOST];
} virial_task;

static void bound_share(void *argument, int index, int count)
{
    virial_task *task = argument;
    const scree_row *row = task->state->row;
    const bool in_3d = task->state->dimension == 3;
    double largest = 0;
    size_t end = scree_thread_pool_begin(task->state->count, index + 1, count);
    for (size_t k = scree_thread_pool_begin(task->state->count, index, count); k < end; k++) {
        largest = fabs(row[k].x) > largest ? fabs(row[k].x) : largest;
        largest = fabs(row[k].y) > largest ? fabs(row[k].y) : largest;
        if (in_3d) largest = fabs(row[k].z) > largest ? fabs(row[k].z) : largest;
    }
    task->largest[index] = largest;
}

VIRIAL_INLINE void sum_rows(int dimension, const virial_task *task, size_t begin, size_t end, scree_wide_sum *sum)
{
    const double inverse = 1 / task->bound;
    const scree_state *state = task->state;
    for (size_t row = begin; row < end; row++) {
        const scree_row *body = &state->row[row];
        const double position[3] = {body->x, body->y, dimension == 3 ? body->z : 0};
        int64_t force[3];
        sum_of(dimension, &state->sum[row], force);
        for (int i = 0; i < dimension; i++)
            for (int j = 0; j < dimension; j++)
                sum->value[3 * i + j] += llrint((double)force[i] * (position[j] * inverse));
    }
}

static void sum_share(void *argument, int index, int count)
{
    virial_task *task = argument;
    scree_wide_sum sum = {{0}};
    size_t begin = scree_thread_pool_begin(task->state->count, index, count);
    size_t end = scree_thread_pool_begin(task->state->count, index + 1, count);
    if (task->state->dimension == 3)
        sum_rows(3, task, begin, end, &sum);
    else
        sum_rows(2, task, begin, end, &sum);
    task->sum[index] = sum;
}

/// Magnitude of the largest coordinate of a body that is here [m].
static double largest_coordinate(virial_task *task, scree_work *work)
{
    const int shares = scree_work_shares(work);
    double largest = 0;
    scree_thread_pool_run(&work->pool, shares, bound_share, task);
    for (int k = 0; k < shares; k++) largest = fmax(largest, task->largest[k]);
    return largest;
}

/// sum over bodies that are here of F (x) x [quanta of the force times task->bound].
static void sum_bodies(virial_task *task, scree_work *work, scree_wide_sum *sum)
{
    const int shares = scree_work_shares(work);
    scree_thread_pool_run(&work->pool, shares, sum_share, task);
    *sum = (scree_wide_sum){{0}};
    for (int p = 0; p < shares; p++)
        for (int k = 0; k < 9; k++) sum->value[k] += task->sum[p].value[k];
}

static double power_above(double largest)
{
    int exponent;
    (void)frexp(largest, &exponent);
    return ldexp(1.0, exponent);
}

/// The quantum of the sum over bodies follows from the largest coordinate of all processes. So that sum and coordinate
/// go in one message the sum is made with that of the last step, and once more where it turns out to be another.
static void list_virial(const scree_state *state, scree_work *work, scree_virial *virial, scree_reduction *together)
{
    virial_task task; // large, and filled by the shares
    task.state = state;
    virial->largest = largest_coordinate(&task, work);
    virial->bound = task.bound = state->part ? work->virial_bound : power_above(virial->largest);
    sum_bodies(&task, work, &virial->bodies);
    scree_reduction_maximum(together, &virial->largest, 1);
    scree_reduction_add(together, virial->faces, 9);
    scree_reduction_add_wide(together, virial->bodies.value, 9);
}

void scree_ghosts_add_back(scree_state *state, scree_work *work, scree_virial *virial, scree_reduction *together)
{
    virial->whole = scree_periodic_is_whole(state);
    if (!scree_cell(state)->directions && !state->part) return;
    if (virial->whole) sum_faces(state, &work->ghosts, virial->faces);
    scree_comm_add_back(state, work);
    if (virial->whole) list_virial(state, work, virial, together);
}

/// sum over bodies of F (x) x [J].
static void total_of_bodies(const scree_state *state, scree_work *work, scree_virial *virial, double product[9])
{
    virial_task task;
    task.state = state;
    task.bound = power_above(virial->largest);
    if (state->part) work->virial_bound = task.bound;
    const double quantum = state->force_quantum * task.bound;
    if (task.bound == virial->bound) {
        scree_wide_total(&virial->bodies, 1, quantum, product);
        return;
    }
    sum_bodies(&task, work, &virial->bodies);
    scree_comm_wide_total(state, &virial->bodies, 1, quantum, product);
}

void scree_ghosts_settle_virial(const scree_state *state, scree_work *work, scree_virial *virial)
{
    scree_periodic_cell *cell = scree_cell(state);
    if (!virial->whole) return;
    total_of_bodies(state, work, virial, cell->virial);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                cell->virial[3 * i + j] +=
                    (double)virial->faces[3 * i + k] * state->force_quantum * cell->lattice[3 * j + k];
}
