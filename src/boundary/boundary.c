/// Table of boundaries, and what all of them share: walls that come and go.
#include "boundary/boundary.h"
#include "state/plates.h"

#include "base/integer_sum.h"
#include "boundary/axial_plates.h"
#include "boundary/pressure.h"
#include "measure/imposed_gradient.h"

#include <math.h>

enum {
    AXIAL = 1U << SCREE_WALL_BOTTOM | 1U << SCREE_WALL_TOP,
    LATERAL = 1U << SCREE_WALL_LEFT | 1U << SCREE_WALL_RIGHT | 1U << SCREE_WALL_FRONT | 1U << SCREE_WALL_BACK
};

const scree_boundary scree_boundary_pressure = {.name = "pressure", .walls = AXIAL, SCREE_AXIAL_PLATES};
const scree_boundary scree_boundary_none = {.name = "none", .open = true};
const scree_boundary scree_boundary_plates = {.name = "plates", .walls = AXIAL | LATERAL, SCREE_AXIAL_PLATES};
const scree_boundary scree_boundary_walls = {.name = "walls", .open = true};

// A channel is periodic but for its plates.
const scree_boundary scree_boundary_channel = {.name = "channel", .walls = AXIAL, SCREE_AXIAL_PLATES};

const scree_boundary *scree_boundary_get(scree_boundary_kind kind)
{
    static const scree_boundary *const table[] = {
        [SCREE_BOUNDARY_AUTO] = &scree_boundary_pressure,     [SCREE_BOUNDARY_PRESSURE] = &scree_boundary_pressure,
        [SCREE_BOUNDARY_PLATES] = &scree_boundary_plates,     [SCREE_BOUNDARY_MEMBRANE] = &scree_boundary_membrane,
        [SCREE_BOUNDARY_MINIMAL] = &scree_boundary_minimal,   [SCREE_BOUNDARY_AFFINE] = &scree_boundary_affine,
        [SCREE_BOUNDARY_PERIODIC] = &scree_boundary_periodic, [SCREE_BOUNDARY_CHANNEL] = &scree_boundary_channel,
        [SCREE_BOUNDARY_WALLS] = &scree_boundary_walls,       [SCREE_BOUNDARY_NONE] = &scree_boundary_none,
    };
    return table[kind];
}

bool scree_boundary_has_plates(const scree_boundary *boundary)
{
    return (boundary->walls & AXIAL) == AXIAL;
}

static double held_by_wall(const scree_contact_table *table, int wall)
{
    scree_integer_sum energy = {0};
    while (scree_integer_sum_next(&energy, 1))
        for (size_t c = 0; c < table->count; c++) {
            const scree_contact *contact = &table->contact[c];
            if (contact->wall && (int)contact->second == wall)
                scree_integer_sum_add(&energy, contact->elastic_normal + contact->elastic_tangential);
        }
    return scree_integer_sum_total(&energy);
}

/// Makes the walls stand that `walls` says. True when any of them changed.
static bool change_walls(scree_state *state, uint32_t walls, const scree_contact_table *table)
{
    bool changed = false;
    for (int w = 0; w < 2 * state->dimension; w++) {
        scree_wall *wall = &scree_plates(state)[w];
        bool stands = walls >> w & 1;
        if (stands == (wall->active != 0)) continue;
        if (!stands) state->ledger.plates -= held_by_wall(table, w);
        wall->active = stands;
        wall->velocity = wall->force = 0;
        for (int i = 0; i < 3; i++) wall->tangential_velocity[i] = wall->shear[i] = 0;
        changed = true;
    }
    return changed;
}

scree_status scree_boundary_begin(const scree_boundary *boundary, const scree_model *model, scree_state *state,
                                  const scree_contact_table *table, bool *changed, scree_error *error)
{
    size_t count = state->count;
    *changed = change_walls(state, boundary->walls, table);
    scree_imposed(state)->count = 0; // what another boundary imposed is over
    scree_status status = SCREE_OK;
    if (*changed && !boundary->open) status = scree_boundary_mark_loaded(model, state, error);
    if (!status && boundary->begin) status = boundary->begin(model, state, error);
    *changed = *changed || state->count != count;
    return status;
}
