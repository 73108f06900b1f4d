/// Stage `prepare`: places the particles. Takes no steps.
#include "prepare/prepare.h"
#include "run/simulation.h"

#include "search/neighbours.h"

static scree_status begin(scree_simulation *s, scree_error *error)
{
    scree_state prepared;
    scree_status status = scree_prepare(&s->model, scree_stage_config(s), &prepared, error);
    if (status) return status;
    prepared.stage = s->state.stage;
    prepared.spent = s->state.spent;
    scree_state_destroy(&s->state);
    s->state = prepared;
    scree_neighbours_invalidate(&s->work);
    (void)snprintf(s->reason, sizeof s->reason, "%zu particles placed", s->state.count);
    return SCREE_OK;
}

const scree_stage scree_stage_prepare = {.name = "prepare", .instant = true, .begin = begin};
