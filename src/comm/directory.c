#include "comm/directory.h"

#include "comm/comm.h"
#include "comm/ranges.h"

enum { NOBODY = -1 };

/// The process that keeps an id; none keeps one that was never given.
static int32_t keeper_of(const scree_directory *directory, uint32_t id)
{
    return id < directory->ids ? (int32_t)(id / scree_range_rows(directory->ids)) : NOBODY;
}

/// *wrong: found here, ids that two bodies have, or that were never given.
static scree_status fill(scree_directory *directory, const scree_state *state, const int32_t *process, int64_t *wrong,
                         scree_error *error)
{
    typedef struct entry {
        uint32_t id;
        int32_t process;
    } entry;
    scree_route route = {0};
    entry *own = NULL, *in = NULL;
    int32_t *to = NULL;
    size_t arriving = 0;
    scree_status status = scree_allocate(&own, state->count + 1, sizeof *own, error);
    if (!status) status = scree_allocate(&to, state->count + 1, sizeof *to, error);
    for (size_t row = 0; row < state->count && !status; row++) {
        own[row] = (entry){state->id[row], process[row]};
        to[row] = keeper_of(directory, state->id[row]);
        *wrong += to[row] == NOBODY;
    }
    if (!status) status = scree_route_to(&route, to, state->count, &arriving, error);
    if (!status) status = scree_allocate(&in, arriving + 1, sizeof *in, error);
    if (!status) status = scree_route_pass(&route, own, in, sizeof *in, error);
    for (size_t k = 0; k < arriving && !status; k++) {
        int32_t *kept = &directory->process[in[k].id - directory->begin];
        *wrong += *kept != NOBODY;
        *kept = in[k].process;
    }
    void *const arrays[] = {&own, &in, &to};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) scree_release(arrays[k]);
    scree_route_close(&route);
    return status;
}

scree_status scree_directory_open(scree_directory *directory, const scree_state *state, const int32_t *process,
                                  scree_error *error)
{
    const int here = scree_comm_rank();
    int64_t wrong = 0;
    *directory = (scree_directory){.ids = state->next_id, .begin = scree_range_begin(state->next_id, here)};
    directory->count = scree_range_begin(state->next_id, here + 1) - directory->begin;
    scree_status status = scree_allocate(&directory->process, directory->count + 1, sizeof *directory->process, error);
    for (size_t k = 0; k < directory->count && !status; k++) directory->process[k] = NOBODY;
    if (!status) status = fill(directory, state, process, &wrong, error);
    scree_comm_add(state, &wrong, 1);
    if (status || wrong == 0) return status;
    return scree_error_set(error, SCREE_ERROR_IO,
                           "dataset 'id': an id is that of two bodies, or was never given (%lld of them)",
                           (long long)wrong);
}

void scree_directory_close(scree_directory *directory)
{
    scree_release(&directory->process);
}

scree_status scree_directory_ask(const scree_directory *directory, const uint32_t *id, size_t count, int32_t *process,
                                 scree_error *error)
{
    scree_route route = {0};
    uint32_t *in = NULL;
    int32_t *to = NULL, *said = NULL;
    size_t arriving = 0;
    scree_status status = scree_allocate(&to, count + 1, sizeof *to, error);
    for (size_t k = 0; k < count && !status; k++) to[k] = process[k] < 0 ? keeper_of(directory, id[k]) : NOBODY;
    if (!status) status = scree_route_to(&route, to, count, &arriving, error);
    if (!status) status = scree_allocate(&in, arriving + 1, sizeof *in, error);
    if (!status) status = scree_allocate(&said, arriving + 1, sizeof *said, error);
    if (!status) status = scree_route_pass(&route, id, in, sizeof *in, error);
    for (size_t k = 0; k < arriving && !status; k++) said[k] = directory->process[in[k] - directory->begin];
    if (!status) status = scree_route_answer(&route, said, process, sizeof *said, error);
    void *const arrays[] = {&to, &in, &said};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) scree_release(arrays[k]);
    scree_route_close(&route);
    return status;
}
