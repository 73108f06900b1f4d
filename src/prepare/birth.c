/// What a body gets when it is born.
///
/// Energy. The discrete kinetic energy T = m v(n-1/2) . v(n+1/2) / 2 + ... (measure/energy.c) of a body that touches
/// nothing, m (v(n)^2 - h^2 g^2 / 4) / 2 with the step h that begins, is work from outside. Its potential m g . x comes
/// into the zero of the potential (`ledger.gravity`), so that the work of gravity stays what gravity has done on bodies
/// that were there. Where gravity changes in the step that begins, load/gravity.c has taken its half at x(n) of all
/// bodies before this one came: here is that of this one.
///
/// A body is born with the velocity v(n) that is asked for: the scheme keeps v(n-1/2) + lead h a with a = g and the
/// last step h, which follows from the kick: the mean of the last step and the one that begins.
#include "prepare/birth.h"

#include "integrate/integrate.h"
#include "load/gravity.h"
#include "state/births.h"

#include <math.h>
#include <string.h>

static int species_of(const scree_model *model, int species, uint64_t number)
{
    return species >= 0 ? species : scree_model_drawn_species(model, number);
}

double scree_birth_reach(const scree_model *model, int species, uint64_t number)
{
    return scree_model_bound_of_species(model, species_of(model, species, number), number);
}

double scree_birth_largest_reach(const scree_model *model)
{
    return fmax(model->radius_max, model->bounding_max);
}

/// The row of a body of this species and number; one that is not round gets its outline within that radius.
static scree_status fill(const scree_model *model, scree_state *state, size_t row, int species, uint64_t number,
                         const scree_birth *birth, scree_error *error)
{
    const scree_species *kind = &model->species[species];
    const int material = model->species[species].material;
    const double radius = scree_model_bound_of_species(model, species, number);
    scree_row *body = &state->row[row];
    *body = (scree_row){.x = birth->position[0],
                        .y = birth->position[1],
                        .radius = radius,
                        .mass = scree_model_mass(model, material, radius)};
    state->species[row] = (uint8_t)species;
    if (state->dimension == 3) {
        body->z = birth->position[2];
        state->turn[row].material = material;
    } else {
        body->material = material;
        state->angle[row] = birth->angle;
    }
    scree_body_make_round(state, row);
    if (!kind->shape || kind->shape->round) return SCREE_OK;
    return kind->shape->dress(model, kind->outline, number, state, row, error);
}

/// Velocities as the scheme keeps them.
static void set_moving(const scree_model *model, scree_state *state, size_t row, const scree_birth *birth)
{
    const double last = 2 * state->kick_size - state->step_size;
    const double shift = (scree_integrator_get(model->scheme)->velocity_lead - 0.5) * last;
    scree_row *body = &state->row[row];
    scree_vector velocity;
    scree_along(birth->velocity, shift, model->gravity, velocity);
    body->vx = velocity[0];
    body->vy = velocity[1];
    if (state->dimension == 2) {
        body->spin = birth->spin[2];
        return;
    }
    body->vz = velocity[2];
    state->turn[row].wx = birth->spin[0];
    state->turn[row].wy = birth->spin[1];
    state->turn[row].wz = birth->spin[2];
}

/// What the forces of the others are bounded by.
static void note_speed(scree_state *state, size_t row)
{
    scree_vector velocity, spin;
    scree_body_motion(state, row, velocity, spin);
    double speed = scree_length(velocity) + scree_body_bounding_radius(state, row) * scree_length(spin);
    state->largest_speed = fmax(state->largest_speed, speed);
}

/// T [J] in the step that begins.
static double kinetic_of(const scree_model *model, const scree_state *state, size_t row, const scree_birth *birth)
{
    const bool own = scree_integrator_get(model->scheme)->velocity != NULL;
    const double half = own ? 0 : 0.5 * state->step_size;
    return 0.5 * (scree_body_mass(state, row) * (scree_dot(birth->velocity, birth->velocity) -
                                                 half * half * scree_dot(model->gravity, model->gravity)) +
                  scree_body_inertia(state, row) * scree_dot(birth->spin, birth->spin));
}

static void account_for(const scree_model *model, scree_state *state, const scree_work *work, size_t row,
                        const scree_birth *birth)
{
    scree_vector position, next;
    const double kinetic = kinetic_of(model, state, row, birth);
    scree_body_position(state, row, position);
    scree_gravity_find(model, state, work->ticks, next);
    for (int k = 0; k < 3; k++) next[k] = model->gravity[k] + 0.5 * (next[k] - model->gravity[k]);
    state->ledger.gravity += scree_body_mass(state, row) * scree_dot(next, position);
    state->ledger.outside += kinetic;
    state->ledger.turnover += fabs(kinetic);
}

scree_status scree_birth_append(const scree_model *model, scree_state *state, const scree_work *work,
                                const scree_birth *birth, uint32_t *row, scree_error *error)
{
    const uint64_t number = state->next_id;
    scree_status status = scree_births_make_room(state, error);
    if (!status) status = scree_state_append(state, SCREE_MARK_GRAIN, 1, error);
    if (status) return status;
    *row = scree_state_row_of(state, number);
    status = fill(model, state, *row, species_of(model, birth->species, number), number, birth, error);
    if (status) return status;
    set_moving(model, state, *row, birth);
    scree_body_refer(state, *row);
    memcpy(state->sampled_velocity[*row], birth->velocity, sizeof(scree_vector));
    scree_births_of(state)->time[*row] = scree_state_time(state);
    note_speed(state, *row);
    account_for(model, state, work, *row, birth);
    return SCREE_OK;
}

double scree_birth_time(const scree_state *state, size_t row)
{
    const scree_births *births = scree_births_of(state);
    return births->time ? births->time[row] : 0;
}
