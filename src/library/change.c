/// Changes of bodies between two steps, from outside.
///
/// Method. The forces that the next kick will use belong to the positions that there are. So after a change neighbours
/// are searched and all forces evaluated anew by the passes of the step itself, with a step of size zero: springs are
/// not stretched, no work is done, nothing moves. They see the velocities that they saw in the step, those of n - 1/2;
/// where the scheme keeps others, these are taken back and forth by a dt / 2. What was asked for is the velocity at n.
///
/// Ledger. The residual of the balance (measure/energy.c) is what the energy has changed by without work that is known;
/// by how much it differs before and after is the work of the change. It is added to `outside`, and so closes the
/// balance as far as it was closed before.
///
/// Limits. Boundaries that impose motions, membranes and periodic cells that deform divide by the step or keep
/// velocities of the last one: refused. The strain of a Delaunay boundary takes a change of its bodies for strain.
/// Background damping counts the work of the half step that comes with the velocities before the change. Cost: one step
/// and two contact tables.
#include "library/handle.h"

#include "base/matrix.h"
#include "measure/measure.h"
#include "run/guard.h"
#include "run/step.h"
#include "search/neighbours.h"
#include "state/periodic.h"
#include "state/sleep.h"

#include <stdlib.h>
#include <string.h>

// ---- what is accepted --------------------------------------------------------------------------------------------

static scree_status refuse(scree_error *error, const char *why)
{
    return scree_error_set(error, SCREE_ERROR_INPUT, "bodies cannot be changed %s", why);
}

static scree_status check_moment(const scree_simulation *s, scree_error *error)
{
    scree_status status = handle_need_bodies(s, error);
    if (status) return status;
    if (s->stopped.status) return refuse(error, "in a simulation that was stopped");
    if (!s->stage) return refuse(error, "after the end of the case");
    if (s->boundary->bound) return refuse(error, "while the boundary imposes their motion");
    const double *gradient = scree_cell(&s->state)->gradient;
    for (int k = 0; k < 9; k++)
        if (scree_periodic_is_whole(&s->state) && gradient[k] != 0)
            return refuse(error, "while the periodic cell deforms");
    return SCREE_OK;
}

/// A position is finite and, where the sample is periodic, in the cell.
static bool is_inside(const scree_simulation *s, const double *position)
{
    const scree_periodic_cell *cell = scree_cell(&s->state);
    double inverse[9], fraction[3], place[3] = {0};
    for (int k = 0; k < s->model.dimension; k++) {
        place[k] = position[k];
        if (!isfinite(place[k])) return false;
    }
    if (!cell->directions) return true;
    scree_matrix_invert(cell->lattice, inverse);
    scree_matrix_apply(inverse, place, fraction);
    for (int k = 0; k < s->model.dimension; k++)
        if (scree_periodic_repeats(cell, k) && !(fraction[k] >= 0 && fraction[k] < 1)) return false;
    return true;
}

static bool are_finite(const double *values, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (!isfinite(values[k])) return false;
    return true;
}

static scree_status refuse_body(scree_error *error, uint32_t id, const char *what)
{
    return scree_error_set(error, SCREE_ERROR_INPUT, "body %u: %s", id, what);
}

static scree_status check_body(const scree_simulation *s, const scree_body_values *values, size_t k, scree_error *error)
{
    const uint32_t id = values->id[k];
    const size_t dimension = (size_t)s->model.dimension, turns = dimension == 3 ? 3 : 1;
    if (scree_state_row_of(&s->state, id) == SCREE_NO_ROW) return refuse_body(error, id, "there is none");
    if (values->position && !is_inside(s, values->position + dimension * k))
        return refuse_body(error, id, "its position is not finite, or outside of the periodic cell");
    if (values->velocity && !are_finite(values->velocity + dimension * k, dimension))
        return refuse_body(error, id, "its velocity is not finite");
    if (values->spin && !are_finite(values->spin + turns * k, turns))
        return refuse_body(error, id, "its spin is not finite");
    if (values->radius && !(values->radius[k] > 0 && values->radius[k] <= scree_model_largest_radius(&s->model)))
        return refuse_body(error, id, "its radius is not positive, or above the largest one of the case");
    if (values->radius && s->state.form)
        return refuse_body(error, id, "its size is that of its outline: bodies that are not round keep it");
    return SCREE_OK;
}

static scree_status check(const scree_simulation *s, const scree_body_values *values, scree_error *error)
{
    unsigned char *seen;
    scree_status status = check_moment(s, error);
    for (size_t k = 0; k < values->count && !status; k++) status = check_body(s, values, k, error);
    if (!status) status = scree_allocate(&seen, s->state.id_count, 1, error);
    if (status) return status;
    for (size_t k = 0; k < values->count && !status; k++)
        if (seen[values->id[k]]++) status = refuse_body(error, values->id[k], "is named twice");
    scree_release(&seen);
    return status;
}

// ---- the change --------------------------------------------------------------------------------------------------

static void place(scree_row *row, const double *position, int dimension)
{
    row->x = position[0];
    row->y = position[1];
    if (dimension == 3) row->z = position[2];
}

static void move(scree_state *state, size_t row, const double *velocity, const double *spin)
{
    scree_row *body = &state->row[row];
    bool in_3d = state->dimension == 3;
    if (velocity) {
        body->vx = velocity[0];
        body->vy = velocity[1];
        if (in_3d) body->vz = velocity[2];
    }
    if (spin && in_3d) {
        state->turn[row].wx = spin[0];
        state->turn[row].wy = spin[1];
        state->turn[row].wz = spin[2];
    } else if (spin) {
        body->spin = spin[0];
    }
}

/// The largest speed of a surface, which bounds of forces are made of.
static void note_speed(scree_state *state, size_t row)
{
    scree_vector velocity, spin;
    scree_body_motion(state, row, velocity, spin);
    double speed = scree_length(velocity) + state->row[row].radius * scree_length(spin);
    state->largest_speed = fmax(state->largest_speed, speed);
}

static void put(scree_simulation *s, const scree_body_values *values)
{
    scree_state *state = &s->state;
    const size_t dimension = (size_t)state->dimension, turns = dimension == 3 ? 3 : 1;
    for (size_t k = 0; k < values->count; k++) {
        size_t row = state->row_of_id[values->id[k]];
        if (values->position) place(&state->row[row], values->position + dimension * k, state->dimension);
        if (values->radius) {
            state->row[row].radius = values->radius[k];
            state->row[row].mass = scree_model_mass(&s->model, scree_body_material(state, row), values->radius[k]);
        }
        move(state, row, values->velocity ? values->velocity + dimension * k : NULL,
             values->spin ? values->spin + turns * k : NULL);
        if (s->integrator->begin_anew && (values->velocity || values->spin || values->radius))
            s->integrator->begin_anew(state, row);
        note_speed(state, row);
    }
}

/// Velocity and acceleration of a body before the change.
typedef struct former {
    scree_vector velocity, spin, acceleration, turning;
} former;

static void accelerations(const scree_simulation *s, size_t row, scree_vector acceleration, scree_vector turning)
{
    const scree_state *state = &s->state;
    scree_body_force(&s->stage_model, state, row, acceleration, turning);
    for (int k = 0; k < 3; k++) {
        acceleration[k] /= state->row[row].mass;
        turning[k] /= scree_body_inertia(state, row);
    }
}

static void move_to(scree_state *state, size_t row, const scree_vector velocity, const scree_vector spin)
{
    move(state, row, velocity, state->dimension == 3 ? spin : spin + 2);
}

/// From the velocities that the scheme keeps to those of n - 1/2, with which forces are evaluated. by_id: one an id.
static void step_back(scree_simulation *s, former *by_id)
{
    scree_state *state = &s->state;
    double back = -s->integrator->velocity_lead * state->step_size;
    for (size_t row = 0; row < state->count; row++) {
        former *f = &by_id[state->id[row]];
        scree_vector velocity, spin;
        scree_body_motion(state, row, f->velocity, f->spin);
        accelerations(s, row, f->acceleration, f->turning);
        scree_along(f->velocity, back, f->acceleration, velocity);
        scree_along(f->spin, back, f->turning, spin);
        move_to(state, row, velocity, spin);
    }
}

/// The way back, with the new forces; where they are the old ones, to the very bits.
static void step_forth(scree_simulation *s, const former *by_id)
{
    scree_state *state = &s->state;
    double forth = s->integrator->velocity_lead * state->step_size;
    for (size_t row = 0; row < state->count; row++) {
        const former *f = &by_id[state->id[row]];
        scree_vector velocity, spin, acceleration, turning;
        accelerations(s, row, acceleration, turning);
        for (int k = 0; k < 3; k++) {
            velocity[k] = f->velocity[k] + forth * (acceleration[k] - f->acceleration[k]);
            spin[k] = f->spin[k] + forth * (turning[k] - f->turning[k]);
        }
        move_to(state, row, velocity, spin);
    }
}

/// Velocities that were asked for belong to n.
static void give(scree_simulation *s, const scree_body_values *values)
{
    scree_state *state = &s->state;
    const size_t dimension = (size_t)state->dimension, turns = dimension == 3 ? 3 : 1;
    double shift = (s->integrator->velocity_lead - 0.5) * state->step_size;
    for (size_t k = 0; k < values->count; k++) {
        size_t row = state->row_of_id[values->id[k]];
        scree_vector velocity = {0}, spin = {0}, acceleration, turning;
        accelerations(s, row, acceleration, turning);
        if (values->velocity) memcpy(velocity, values->velocity + dimension * k, dimension * sizeof *velocity);
        if (values->spin) memcpy(spin + 3 - turns, values->spin + turns * k, turns * sizeof *spin);
        scree_along(velocity, shift, acceleration, velocity);
        scree_along(spin, shift, turning, spin);
        const double *turn = state->dimension == 3 ? spin : spin + 2;
        move(state, row, values->velocity ? velocity : NULL, values->spin ? turn : NULL);
    }
}

/// Forces of the present positions, without a step.
static scree_status evaluate(scree_simulation *s, scree_error *error)
{
    const double size = s->state.step_size;
    scree_status status = SCREE_OK;
    scree_neighbours_invalidate(&s->work);
    s->work.clear_rows = 0;
    s->state.largest_overlap = 0; // the bounds of forces count with the limit of the guard instead
    s->state.step_size = 0;
    for (scree_phase phase = SCREE_PHASE_SEARCH; phase < SCREE_PHASE_SECOND_HALF && !status; phase++)
        status = scree_step_phase(s, phase, error);
    s->state.step_size = size;
    return status;
}

static scree_status measure(scree_simulation *s, scree_energy *energy, scree_error *error)
{
    scree_status status = scree_contact_table_build(&s->stage_model, &s->state, &s->work, &s->table, error);
    if (!status) scree_energy_measure(&s->stage_model, &s->state, &s->table, energy);
    return status;
}

/// Before the first step there is no size of a last one: the next one's, as the step itself would choose.
static void choose_size(scree_simulation *s)
{
    if (s->state.step_size > 0) return;
    s->state.step_size = scree_simulation_step_size(s);
    scree_energy_change_step(&s->stage_model, &s->state, 0, s->state.step_size);
}

/// From the check of the values on nothing is refused: what fails stops the simulation.
static scree_status change(scree_simulation *s, const scree_body_values *values, former *by_id, scree_error *error)
{
    const scree_context context = scree_step_context(s);
    scree_energy before, after;
    choose_size(s);
    // One that sleeps would not move, and what it exerts on others that do is kept.
    if (scree_some_sleep(&s->state, values->id, values->count)) scree_sleep_wake_all(&context);
    scree_status status = measure(s, &before, error);
    if (status) return status;
    step_back(s, by_id);
    put(s, values);
    if ((status = evaluate(s, error))) return status;
    step_forth(s, by_id);
    give(s, values);
    if ((status = measure(s, &after, error))) return status;
    double work = after.residual - before.residual;
    s->state.ledger.outside += work;
    s->state.ledger.turnover += fabs(work);
    return scree_guard_step(s, error);
}

scree_status scree_simulation_set(scree_simulation *s, const scree_body_values *values, scree_error *error)
{
    former *by_id = NULL;
    scree_status status = check(s, values, error);
    if (!status) status = scree_allocate(&by_id, s->state.id_count, sizeof *by_id, error);
    if (status) return status;
    status = s->stopped.status = change(s, values, by_id, &s->stopped);
    if (status && error) *error = s->stopped;
    scree_release(&by_id);
    return status;
}
