#include "comm/known.h"

#include "comm/comm.h"
#include "comm/directory.h"
#include "state/body.h"

#include <stdlib.h>

void scree_known_bodies_destroy(scree_known_bodies *known)
{
    scree_release(&known->body);
    known->count = 0;
}

static void count_name(void *context, uint32_t id)
{
    (void)id;
    ++*(size_t *)context;
}

static void note_name(void *context, uint32_t id)
{
    scree_known_bodies *known = context;
    known->body[known->count++].id = id;
}

/// The ids, each once.
static scree_status list_names(const scree_state *state, scree_known_bodies *known, scree_error *error)
{
    size_t names = 0, kept = 0;
    scree_state_each_named(state, count_name, &names);
    scree_status status = scree_allocate(&known->body, names + 1, sizeof *known->body, error);
    if (status) return status;
    scree_state_each_named(state, note_name, known);
    if (names > 1) qsort(known->body, names, sizeof *known->body, scree_known_body_compare);
    for (size_t k = 0; k < names; k++)
        if (k == 0 || known->body[k].id != known->body[kept - 1].id) known->body[kept++] = known->body[k];
    known->count = kept;
    return SCREE_OK;
}

/// What the directory says of them.
static scree_status ask(const scree_directory *directory, scree_known_bodies *known, scree_error *error)
{
    uint32_t *id;
    int32_t *said = NULL;
    scree_status status = scree_allocate(&id, known->count + 1, sizeof *id, error);
    if (!status) status = scree_allocate(&said, known->count + 1, sizeof *said, error);
    for (size_t k = 0; k < known->count && !status; k++) {
        id[k] = known->body[k].id;
        said[k] = -1;
    }
    if (!status) status = scree_directory_ask(directory, id, known->count, said, error);
    for (size_t k = 0; k < known->count && !status; k++) known->body[k].material = said[k];
    scree_release(&id);
    scree_release(&said);
    return status;
}

/// A directory of the materials of all bodies.
static scree_status open_directory(scree_directory *directory, const scree_state *state, scree_error *error)
{
    int32_t *material;
    scree_status status = scree_allocate(&material, state->count + 1, sizeof *material, error);
    for (size_t row = 0; row < state->count && !status; row++) material[row] = scree_body_material(state, row);
    if (!status) status = scree_directory_open(directory, state, material, error);
    scree_release(&material);
    return status;
}

scree_status scree_known_bodies_ask(const scree_state *state, scree_known_bodies *known, scree_error *error)
{
    scree_directory directory = {0};
    *known = (scree_known_bodies){0};
    scree_status status = scree_comm_agree(open_directory(&directory, state, error), error);
    if (!status) status = scree_comm_agree(list_names(state, known, error), error);
    if (!status) status = scree_comm_agree(ask(&directory, known, error), error);
    scree_directory_close(&directory);
    if (status) scree_known_bodies_destroy(known);
    return status;
}
