/// Messages within one process: what is packed is unpacked at once, a block of ghosts that stays in the cache at a
/// time.
#include "comm/comm.h"

#include "state/periodic.h"

#include <assert.h>

enum { BLOCK_BYTES = 4096 };

/// Ghosts of a block.
static size_t block_of(const scree_state *state, scree_message_kind kind)
{
    size_t bytes = scree_message_bytes(state, kind);
    assert(bytes <= BLOCK_BYTES);
    return bytes > 0 ? BLOCK_BYTES / bytes : SIZE_MAX;
}

typedef struct send_task {
    scree_state *state;
    const scree_ghost_list *list;
    scree_message_kind kind;
    scree_message_shift shift;
} send_task;

static void send_share(void *argument, int index, int count)
{
    const send_task *task = argument;
    unsigned char message[BLOCK_BYTES];
    const size_t block = block_of(task->state, task->kind),
                 end = scree_thread_pool_begin(task->list->count, index + 1, count);
    for (size_t k = scree_thread_pool_begin(task->list->count, index, count); k < end;) {
        size_t many = end - k < block ? end - k : block;
        scree_message_pack(task->state, task->kind, &task->list->ghost[k], many, &task->shift, message);
        scree_message_unpack(task->state, task->kind, task->state->count + k, many, message);
        k += many;
    }
}

static void send(scree_state *state, scree_work *work, scree_message_kind kind)
{
    send_task task = {.state = state, .list = &work->ghosts, .kind = kind};
    memcpy(task.shift.lattice, scree_cell(state)->lattice, sizeof task.shift.lattice);
    scree_periodic_lattice_velocity(state, task.shift.velocity);
    scree_thread_pool_run(&work->pool, scree_work_shares(work), send_share, &task);
}

scree_status scree_comm_begin(scree_state *state, scree_work *work, scree_error *error)
{
    scree_status status = scree_state_reserve_rows(state, scree_row_count(state, work), error);
    if (status) {
        work->ghosts.count = 0;
        return status;
    }
    send(state, work, SCREE_MESSAGE_MAKE);
    send(state, work, SCREE_MESSAGE_STEP);
    return SCREE_OK;
}

void scree_comm_exchange(scree_state *state, scree_work *work)
{
    send(state, work, SCREE_MESSAGE_STEP);
}

void scree_comm_add_back(scree_state *state, scree_work *work)
{
    const scree_ghost_list *list = &work->ghosts;
    const size_t block = block_of(state, SCREE_MESSAGE_BACK);
    unsigned char message[BLOCK_BYTES];
    for (size_t k = 0; k < list->count;) {
        size_t many = list->count - k < block ? list->count - k : block;
        scree_message_collect(state, state->count + k, many, message);
        scree_message_add(state, &list->ghost[k], many, message);
        k += many;
    }
}

// What one process has found is all that there is.

bool scree_comm_sum_next(const scree_state *state, scree_integer_sum *sum, int count)
{
    (void)state;
    return scree_integer_sum_next(sum, count);
}

double scree_comm_sum_of(const scree_state *state, const double *term, size_t count)
{
    (void)state;
    return scree_integer_sum_of(term, count);
}

void scree_comm_wide_total(const scree_state *state, const scree_wide_sum *part, int count, double quantum,
                           double total[9])
{
    (void)state;
    scree_wide_total(part, count, quantum, total);
}

void scree_comm_maximum(const scree_state *state, double *values, size_t count)
{
    (void)state;
    (void)values;
    (void)count;
}

void scree_comm_add(const scree_state *state, int64_t *values, size_t count)
{
    (void)state;
    (void)values;
    (void)count;
}
