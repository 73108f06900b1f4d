/// What all boundaries share: walls that come and go.
#include "boundary/boundary.h"
#include "comm/comm.h"
#include "state/plates.h"

#include "base/integer_sum.h"
#include "boundary/pressure.h"
#include "boundary/rigid_motion.h"
#include "integrate/integrate.h"
#include "measure/imposed_gradient.h"
#include "state/body.h"
#include "state/periodic.h"

#include <math.h>

bool scree_boundary_has_plates(const scree_boundary *boundary)
{
    return (boundary->walls & SCREE_AXIAL_WALLS) == SCREE_AXIAL_WALLS;
}

static double held_by_wall(const scree_state *state, const scree_contact_table *table, int wall)
{
    scree_integer_sum energy = {0};
    while (scree_comm_sum_next(state, &energy, 1))
        for (size_t c = 0; c < table->count; c++) {
            const scree_contact *contact = &table->contact[c];
            if (contact->wall && (int)contact->second == wall)
                scree_integer_sum_add(&energy, contact->elastic_normal + contact->elastic_tangential);
        }
    return scree_integer_sum_total(&energy);
}

/// Work that the forces of walls that have gone, of step n, do in the kick that still has them: half of their power at
/// v(n+1/2) times the step, the half behind n (measure/energy.c). Their other half is known.
static double last_half_work(const scree_model *model, const scree_state *state, const scree_contact_table *table)
{
    scree_integer_sum work = {0};
    while (scree_comm_sum_next(state, &work, 1))
        for (size_t c = 0; c < table->count; c++) {
            const scree_contact *contact = &table->contact[c];
            const size_t row = contact->first;
            if (!contact->wall || contact->second >= SCREE_WALL_COUNT) continue;
            scree_vector velocity, spin, force, torque, push, moment;
            scree_body_half_velocity(model, state, row, velocity, spin);
            scree_body_force(model, state, row, force, torque);
            for (int i = 0; i < 3; i++) {
                velocity[i] += state->step_size * force[i] / scree_body_mass(state, row);
                spin[i] += state->step_size * torque[i] / scree_body_inertia(state, row);
                push[i] = contact->normal_force * contact->normal[i] + contact->tangential_force * contact->tangent[i];
            }
            scree_cross(push, contact->branch, moment); // the point lies at - branch
            scree_integer_sum_add(&work, scree_dot(push, velocity) + scree_dot(moment, spin));
        }
    return 0.5 * state->step_size * scree_integer_sum_total(&work);
}

/// Makes the walls stand that `walls` says. True when any of them changed.
static bool change_walls(scree_state *state, uint32_t walls, const scree_contact_table *table)
{
    bool changed = false;
    for (int w = 0; w < 2 * state->dimension; w++) {
        scree_wall *wall = &scree_plates(state)[w];
        bool stands = walls >> w & 1;
        if (stands == (wall->active != 0)) continue;
        if (!stands) state->ledger.plates -= held_by_wall(state, table, w);
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
    *changed = change_walls(state, boundary->walls & scree_periodic_plates(state), table);
    // Nothing would ever take the rigid motion from a sample that its plates leave alone.
    if (*changed && boundary->free) {
        state->ledger.plates -= scree_rigid_motion_stop(model, state);
        state->ledger.plates += last_half_work(model, state, table);
    }
    scree_imposed(state)->count = 0; // what another boundary imposed is over
    scree_status status = SCREE_OK;
    if (*changed && !boundary->open) status = scree_boundary_mark_loaded(model, state, error);
    if (!status && boundary->begin) status = boundary->begin(model, state, error);
    *changed = *changed || state->count != count;
    return status;
}
