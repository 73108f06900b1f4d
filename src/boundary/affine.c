/// Affine boundary: every body of the Delaunay boundary moves with the wanted velocity gradient, v = L (x - centre),
/// the centre being the mean of their places; spins stay free, and the pressure changes nothing. The stiffest of all
/// boundaries, with which the others are compared: uniform displacement against uniform traction.
///
/// The velocity is imposed by the force m (v - v(n-1/2)) / kick - (all other forces), after which the kick leads to it
/// up to the rounding of a quantum. Bodies that come onto the boundary when it is found anew are caught in one step, so
/// the conditions are meant for small strains. Cost: O(boundary) a step.
#include "base/fixed.h"
#include "base/integer_sum.h"
#include "boundary/boundary.h"
#include "boundary/imposed_gradient.h"
#include "comm/parts.h"
#include "measure/facets.h"
#include "measure/imposed_gradient.h"
#include "module/key_rows.h"

#include <math.h>
#include <string.h>

static void find_centre(const scree_state *state, scree_vector centre)
{
    size_t count = scree_boundary_count(state);
    scree_integer_sum sum[3] = {0};
    scree_vector position;
    while (scree_integer_sum_next(sum, 3))
        for (size_t k = 0; k < count; k++) {
            scree_boundary_position(state, k, position);
            for (int i = 0; i < 3; i++) scree_integer_sum_add(&sum[i], position[i]);
        }
    for (int i = 0; i < 3; i++) centre[i] = scree_integer_sum_total(&sum[i]) / (double)count;
}

/// Velocity that a body of the boundary shall have.
static void wanted_velocity(const scree_state *state, size_t node, const scree_vector centre, scree_vector velocity)
{
    scree_vector position;
    scree_boundary_position(state, node, position);
    for (int i = 0; i < 3; i++) {
        velocity[i] = 0;
        for (int j = 0; j < 3; j++) velocity[i] += scree_imposed(state)->target[3 * i + j] * (position[j] - centre[j]);
    }
}

/// What a force has to balance is known to the process that has the body, which tells the others.
static void move_bodies(scree_state *state, const scree_vector centre, double kick)
{
    scree_imposed_gradient *imposed = scree_imposed(state);
    const uint32_t *id = state->dimension == 3 ? scree_hull_of(state)->id : scree_loop_of(state)->id;
    for (size_t k = 0; k < imposed->count; k++) {
        size_t row = scree_boundary_row(state, k);
        if (row == SCREE_NO_ROW) continue;
        const scree_sum_row *sum = &state->sum[row];
        const int64_t others[3] = {sum->fx, sum->fy, state->dimension == 3 ? sum->fz : 0};
        scree_vector wanted, velocity, spin;
        int64_t quanta[3];
        wanted_velocity(state, k, centre, wanted);
        scree_body_motion(state, row, velocity, spin);
        for (int i = 0; i < 3; i++) {
            double force = state->row[row].mass * (wanted[i] - velocity[i]) / kick;
            quanta[i] = llrint(force / state->force_quantum) - others[i];
        }
        scree_imposed_add(state, k, quanta);
    }
    scree_parts_tell(state, id, imposed->count, (double *)imposed->force, 3);
}

static scree_status add_forces(const scree_context *c, scree_error *error)
{
    const scree_model *model = c->model;
    scree_state *state = c->state;
    scree_imposed_gradient *imposed = scree_imposed(state);
    (void)error;
    if (imposed->count == 0) return SCREE_OK;
    double rate[9];
    scree_vector centre;
    scree_boundary_areas(model, state, imposed->force);
    (void)scree_imposed_measure(state, imposed->force, rate);
    scree_imposed_record(state, rate);
    memset(imposed->force, 0, imposed->count * sizeof *imposed->force);
    find_centre(state, centre);
    move_bodies(state, centre, c->work->next_kick);
    scree_imposed_add_work(state);
    return SCREE_OK;
}

static double bound(const scree_context *c)
{
    const scree_state *state = c->state;
    scree_vector centre, wanted, velocity, spin;
    double largest = 0;
    find_centre(state, centre);
    for (size_t k = 0; k < scree_boundary_count(state); k++) {
        size_t row = scree_boundary_row(state, k);
        if (row == SCREE_NO_ROW) continue;
        wanted_velocity(state, k, centre, wanted);
        scree_body_motion(state, row, velocity, spin);
        double change = scree_length(wanted) + scree_length(velocity);
        largest = fmax(largest, state->row[row].mass * change / state->step_size);
    }
    return largest;
}

static const scree_pass passes[] = SCREE_IMPOSED_PASSES(add_forces);

static const scree_boundary face = {
    .needs_gradient = "affine needs all components of a velocity gradient: use a deform stage",
    .needs_all = "affine moves every body of the boundary: all components must be given",
    .passes = passes,
    .pass_count = COUNT(passes),
    .bound = bound,
    .bound_differs = true,
    SCREE_IMPOSED,
};

const scree_module scree_module_affine = {
    .name = "affine",
    .meaning = "no plates: every body of the boundary moves with the velocity gradient",
    .choice_of = CHOICE_OF(IS("stages.boundary")),
    .boundary = &face,
    .spreads = true,
};
