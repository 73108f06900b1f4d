/// Membrane (P 3.2; Iwashita and Oda 2000): around the sides of a sample frictionless bodies between the bottom and the
/// top plate, larger than the mean grain so that no grain escapes between them. In 2D a chain of discs on either side,
/// in 3D a triangulated tube of spheres (sheet.h). The law of all contacts holds them and the grains apart; their own
/// contacts are left out, springs hold them together.
///
/// Springs. Two neighbours at the distance l with the unstressed length l0 pull with k (l - l0) when l > l0; a slack
/// spring bears nothing, as rubber wrinkles: no bending, no compression. Equal integers of opposite sign: momentum is
/// exact. In 2D k is `boundary.membrane_stiffness` itself. In 3D that is the stiffness Y of a sheet: tension per length
/// over strain in uniaxial tension, Young's modulus times thickness of the rubber. Each triangle gives its three edges
/// half a spring, so that an edge between two triangles has k and one of the rim k / 2; a regular triangular net of
/// springs k has Lame's constants lambda = mu = sqrt(3) k / 4 (Seung and Nelson 1988), hence Poisson's ratio 1/3,
///     Y = 4 mu (lambda + mu) / (lambda + 2 mu) = 2 k / sqrt(3),      k = sqrt(3) Y / 2,
/// and the bulk modulus sqrt(3) k / 2. That holds for small strains and tension everywhere.
///
/// Pressure: membrane_press.c.
///
/// Ends. Each moves with its plate along the axis and is free across it: a force along the normal of the plate gives it
/// the plate's velocity after the kick. It acts from the plate, but does not count as a force on the sample.
///
/// Hand-over. The pressure passes from the grains of the Delaunay boundary to the membrane smoothly within RAMP_WAVES
/// wave times (scree_direct_pressure), so that a sample confined directly can be wrapped at any time.
///
/// Books. Pressure in ledger.pressure; springs and ends, which are the boundary's own, as work in ledger.boundary. The
/// energy that the springs store is the negative of their part of it, up to the third order in the step.
/// Cost: O(bodies of the membrane) a step.
#include "boundary/membrane.h"
#include "measure/delaunay_boundary.h"
#include "state/plates.h"

#include "base/fixed.h"
#include "base/integer_sum.h"
#include "boundary/axial_plates.h"
#include "boundary/plates.h"
#include "boundary/sheet.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

#define RAMP_WAVES 4.0

static scree_status begin(const scree_model *model, scree_state *state, scree_error *error)
{
    if (scree_membrane_of(state)->count > 0) return SCREE_OK;
    // Without a pressure there is nothing to hand over.
    double wave = scree_pressure_now(state) > 0 ? scree_sample_wave_time(model, state, scree_pressure_now(state)) : 0;
    scree_membrane_of(state)->ramp_time = RAMP_WAVES * wave;
    scree_delaunay_boundary_of(state)->taken_over = wave > 0 ? 0 : 1;
    return scree_membrane_place(model, state, error);
}

static scree_status refresh(const scree_context *c, scree_error *error)
{
    const scree_model *model = c->model;
    scree_state *state = c->state;
    scree_membrane *membrane = scree_membrane_of(state);
    double *share = &scree_delaunay_boundary_of(state)->taken_over;
    if (*share < 1) *share = fmin(1, *share + state->step_size / membrane->ramp_time);
    // As often as the Delaunay boundary is found anew.
    if (state->dimension == 2 || scree_hull_of(state)->updated != state->step) return SCREE_OK;
    double hole = scree_sheet_hole(state);
    if (hole < model->radius_min) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_GUARD,
                           "the membrane has stretched so far that a sphere of radius %.3g m can slip through, and the "
                           "smallest has %.3g m: give a larger boundary.membrane_radius or membrane_stiffness",
                           hole, model->radius_min);
}

typedef struct spring {
    size_t other; ///< body at the other end
    double force; ///< N, tension; 0 when slack
    double stiffness;
    scree_vector direction; ///< to the other end
} spring;

/// Spring `s` of body `k`; false: there is none.
static bool find_spring(const scree_model *model, const scree_state *state, size_t k, int s, spring *found)
{
    const scree_membrane *membrane = scree_membrane_of(state);
    double rest = membrane->rest[k][s];
    if (!(rest > 0)) return false;
    bool solid = state->dimension == 3;
    found->other = solid ? scree_sheet_neighbour(membrane->around, membrane->count, k, s) : k + 1;
    bool rim = solid && s == 0 && scree_membrane_plate(state, k) >= 0;
    found->stiffness = rim ? 0.5 * model->membrane_stiffness : model->membrane_stiffness;
    scree_vector from;
    scree_body_place(state, scree_membrane_row(state, k), from);
    scree_body_place(state, scree_membrane_row(state, found->other), found->direction);
    for (int i = 0; i < 3; i++) found->direction[i] -= from[i];
    double length = scree_length(found->direction);
    for (int i = 0; i < 3; i++) found->direction[i] /= length;
    found->force = length > rest ? found->stiffness * (length - rest) : 0;
    return true;
}

static int springs_of_body(const scree_state *state)
{
    return state->dimension == 3 ? SCREE_SHEET_SPRINGS : 1;
}

double scree_membrane_energy(const scree_model *model, const scree_state *state)
{
    scree_integer_sum energy = {0};
    spring found;
    while (scree_integer_sum_next(&energy, 1))
        for (size_t k = 0; k < scree_membrane_of(state)->count; k++)
            for (int s = 0; s < springs_of_body(state); s++)
                if (find_spring(model, state, k, s, &found) && found.force > 0)
                    scree_integer_sum_add(&energy, 0.5 * found.force * found.force / found.stiffness);
    return scree_integer_sum_total(&energy);
}

static void add_force(scree_state *state, size_t k, const int64_t force[3])
{
    scree_sum_row *sum = &state->sum[scree_membrane_row(state, k)];
    sum->fx += force[0];
    sum->fy += force[1];
    if (state->dimension == 3) sum->fz += force[2];
    for (int i = 0; i < 3; i++) scree_membrane_of(state)->force[k][i] += (double)force[i] * state->force_quantum;
}

static void add_springs(const scree_model *model, scree_state *state)
{
    spring found;
    for (size_t k = 0; k < scree_membrane_of(state)->count; k++)
        for (int s = 0; s < springs_of_body(state); s++) {
            if (!find_spring(model, state, k, s, &found) || !(found.force > 0)) continue;
            int64_t pull[3], back[3];
            for (int i = 0; i < 3; i++) {
                pull[i] = scree_fixed_round(found.force / state->force_quantum * found.direction[i]);
                back[i] = -pull[i];
            }
            add_force(state, k, pull);
            add_force(state, found.other, back);
        }
}

/// Velocity of a body of the membrane along the axis of the sample less that of its plate [m/s].
static double axial_velocity_error(const scree_state *state, size_t k, const scree_wall *wall)
{
    int axis = state->dimension - 1;
    scree_vector velocity, spin;
    scree_body_motion(state, scree_membrane_row(state, k), velocity, spin);
    return velocity[axis] - wall->velocity * wall->normal[axis];
}

/// Gives every end the velocity of its plate along the plate's normal.
static void hold_ends(const scree_model *model, scree_state *state, double kick)
{
    int axis = state->dimension - 1;
    for (size_t k = 0; k < scree_membrane_of(state)->count; k++) {
        int plate = scree_membrane_plate(state, k);
        if (plate < 0) continue;
        size_t row = scree_membrane_row(state, k);
        double change = -axial_velocity_error(state, k, &scree_plates(state)[plate]);
        double force = state->row[row].mass * (change / kick - model->gravity[axis]);
        int64_t others = axis == 2 ? state->sum[row].fz : state->sum[row].fy, holding[3] = {0};
        holding[axis] = llrint(fmin(fmax(force / state->force_quantum, -0x1p62), 0x1p62)) - others;
        add_force(state, k, holding);
    }
}

static double half_work(const scree_state *state, scree_vector *force)
{
    scree_integer_sum power = {0};
    scree_vector velocity, spin;
    while (scree_integer_sum_next(&power, 1))
        for (size_t k = 0; k < scree_membrane_of(state)->count; k++) {
            scree_body_motion(state, scree_membrane_row(state, k), velocity, spin);
            scree_integer_sum_add(&power, scree_dot(force[k], velocity));
        }
    return 0.5 * state->step_size * scree_integer_sum_total(&power);
}

static void book_half_work(scree_state *state)
{
    double pressure = half_work(state, scree_membrane_of(state)->press),
           springs = half_work(state, scree_membrane_of(state)->force);
    state->ledger.pressure += pressure;
    state->ledger.boundary += springs;
    state->ledger.turnover += fabs(pressure) + fabs(springs);
}

static void add_forces(const scree_model *model, scree_state *state, scree_work *work)
{
    scree_membrane *membrane = scree_membrane_of(state);
    memset(membrane->press, 0, membrane->count * sizeof *membrane->press);
    memset(membrane->force, 0, membrane->count * sizeof *membrane->force);
    scree_membrane_press(model, state, scree_pressure_now(state) - scree_direct_pressure(state));
    add_springs(model, state);
    hold_ends(model, state, work->next_kick);
    book_half_work(state);
}

/// Area [m2] on which the pressure loads one body, at most. 3D: two thirds of the six triangles around a body with
/// edges of this length are less than its square; the integers of the edges, up to p / 6 x the square of the extent,
/// stay below 2^8 times that.
static double loaded_area(const scree_model *model, const scree_state *state, double length)
{
    if (state->dimension == 2) return 2 * model->thickness * length;
    double square = 0;
    for (int i = 0; i < 3; i++) {
        double low = INFINITY, high = -INFINITY;
        scree_vector place;
        for (size_t k = 0; k < scree_membrane_of(state)->count; k++) {
            scree_body_place(state, scree_membrane_row(state, k), place);
            low = fmin(low, place[i]);
            high = fmax(high, place[i]);
        }
        square += (high - low) * (high - low);
    }
    return fmax(2 * length * length, square / 256);
}

static double bound(const scree_context *c)
{
    const scree_model *model = c->model;
    const scree_state *state = c->state;
    double force = 0, length = 0, holding = 0;
    bool solid = state->dimension == 3;
    spring found;
    for (size_t k = 0; k < scree_membrane_of(state)->count; k++) {
        for (int s = 0; s < springs_of_body(state); s++) {
            if (!find_spring(model, state, k, s, &found)) continue;
            force = fmax(force, found.force);
            length = fmax(length, scree_membrane_of(state)->rest[k][s] + found.force / found.stiffness);
        }
        int plate = scree_membrane_plate(state, k);
        if (plate < 0) continue;
        const scree_wall *wall = &scree_plates(state)[plate];
        double change = fabs(axial_velocity_error(state, k, wall)) + fabs(wall->velocity);
        holding = fmax(holding, state->row[scree_membrane_row(state, k)].mass * change / state->step_size);
    }
    double pressure =
        scree_pressure_now(state) * loaded_area(model, state, length + 2 * scree_membrane_of(state)->radius);
    return fmax(holding, (solid ? 6 : 2) * force + pressure);
}

static scree_status follow(const scree_context *c, scree_error *error)
{
    (void)error;
    book_half_work(c->state);
    return SCREE_OK;
}

static scree_status load(const scree_context *c, scree_error *error)
{
    (void)error;
    add_forces(c->model, c->state, c->work);
    return SCREE_OK;
}

static const scree_pass passes[] = {
    {SCREE_PHASE_FOLLOW, follow}, {SCREE_PHASE_SEARCH, refresh}, {SCREE_PHASE_LOADS, load}};

const scree_boundary scree_boundary_membrane = {.name = "membrane",
                                                .walls = 1U << SCREE_WALL_BOTTOM | 1U << SCREE_WALL_TOP,
                                                .begin = begin,
                                                .passes = passes,
                                                .pass_count = sizeof passes / sizeof *passes,
                                                .bound = bound,
                                                SCREE_AXIAL_PLATES};
