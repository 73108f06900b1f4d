/// Messages within one process: what is packed is unpacked at once, a block of ghosts that stays in the cache at a
/// time. Those of bodies of other processes follow behind (away.c).
#include "comm/comm.h"

#include "comm/parts.h"

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
    const size_t block = block_of(task->state, task->kind), here = task->list->count - task->list->away,
                 end = scree_thread_pool_begin(here, index + 1, count);
    for (size_t k = scree_thread_pool_begin(here, index, count); k < end;) {
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
    if (work->ghosts.count > work->ghosts.away)
        scree_thread_pool_run(&work->pool, scree_work_shares(work), send_share, &task);
    if (state->part) scree_parts_send(state, work, kind, &task.shift);
}

scree_status scree_comm_begin(scree_state *state, scree_work *work, scree_error *error)
{
    scree_status status = scree_state_reserve_rows(state, scree_row_count(state, work), error);
    if (!status && state->part) status = scree_parts_reserve_messages(state, work, error);
    if (status) {
        work->ghosts.count = work->ghosts.away = 0;
        return status;
    }
    send(state, work, SCREE_MESSAGE_MAKE);
    send(state, work, SCREE_MESSAGE_STEP);
    return SCREE_OK;
}

scree_status scree_comm_exchange(scree_state *state, scree_work *work, scree_error *error)
{
    // What bodies have may have become more since the list was made.
    const scree_status status = state->part ? scree_parts_reserve_messages(state, work, error) : SCREE_OK;
    if (!status) send(state, work, SCREE_MESSAGE_STEP);
    return status;
}

void scree_comm_add_back(scree_state *state, scree_work *work)
{
    const scree_ghost_list *list = &work->ghosts;
    const size_t block = block_of(state, SCREE_MESSAGE_BACK);
    unsigned char message[BLOCK_BYTES];
    const size_t here = list->count - list->away;
    for (size_t k = 0; k < here;) {
        size_t many = here - k < block ? here - k : block;
        scree_message_collect(state, state->count + k, many, message);
        scree_message_add(state, &list->ghost[k], many, message);
        k += many;
    }
    if (state->part) scree_parts_add_back(state, work);
}
