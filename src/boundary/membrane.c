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
/// Accumulates. Pressure in ledger.pressure; springs and ends, which are the boundary's own, as work in
/// ledger.boundary. The energy that the springs store is the negative of their part of it, up to the third order in the
/// step. Cost: O(bodies of the membrane) a step.
#include "boundary/membrane.h"
#include "measure/delaunay_boundary.h"
#include "state/plates.h"

#include "base/fixed.h"
#include "base/integer_sum.h"
#include "base/wrapping.h"
#include "boundary/axial_plates.h"
#include "boundary/plates.h"
#include "boundary/sheet.h"
#include "comm/parts.h"
#include "module/key_rows.h"
#include "state/pressure.h"

#include <float.h>
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
    bool in_3d = state->dimension == 3;
    found->other = in_3d ? scree_sheet_neighbour(membrane->around, membrane->count, k, s) : k + 1;
    bool rim = in_3d && s == 0 && scree_membrane_plate(state, k) >= 0;
    found->stiffness = (rim ? 0.5 : 1) * scree_membrane_numbers_of(model)->stiffness;
    scree_vector from;
    scree_membrane_position(state, k, from);
    scree_membrane_position(state, found->other, found->direction);
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
    scree_membrane_add(state, k, force, scree_membrane_of(state)->force);
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
    scree_vector velocity;
    scree_membrane_velocity(state, k, velocity);
    return velocity[axis] - wall->velocity * wall->normal[axis];
}

/// Gives every end the velocity of its plate along the plate's normal. What a force has to balance is known to the
/// process that has the end, which tells the others.
static void hold_ends(const scree_model *model, scree_state *state, double kick)
{
    int axis = state->dimension - 1;
    for (size_t k = 0; k < scree_membrane_of(state)->count; k++) {
        int plate = scree_membrane_plate(state, k);
        if (plate < 0) continue;
        const uint32_t row = scree_membrane_row(state, k);
        if (row == SCREE_NO_ROW) continue;
        double change = -axial_velocity_error(state, k, &scree_plates(state)[plate]);
        double force = state->row[row].mass * (change / kick - model->gravity[axis]);
        int64_t others = axis == 2 ? state->sum[row].fz : state->sum[row].fy, holding[3] = {0};
        holding[axis] = llrint(fmin(fmax(force / state->force_quantum, -0x1p62), 0x1p62)) - others;
        add_force(state, k, holding);
    }
    const scree_membrane *membrane = scree_membrane_of(state);
    scree_parts_tell(state, membrane->id, membrane->count, (double *)membrane->force, 3);
}

static double half_work(const scree_state *state, scree_vector *force)
{
    scree_integer_sum power = {0};
    scree_vector velocity;
    while (scree_integer_sum_next(&power, 1))
        for (size_t k = 0; k < scree_membrane_of(state)->count; k++) {
            scree_membrane_velocity(state, k, velocity);
            scree_integer_sum_add(&power, scree_dot(force[k], velocity));
        }
    return 0.5 * state->step_size * scree_integer_sum_total(&power);
}

static void add_half_work(scree_state *state)
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
    add_half_work(state);
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
        scree_vector position;
        for (size_t k = 0; k < scree_membrane_of(state)->count; k++) {
            scree_membrane_position(state, k, position);
            low = fmin(low, position[i]);
            high = fmax(high, position[i]);
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
    bool in_3d = state->dimension == 3;
    spring found;
    for (size_t k = 0; k < scree_membrane_of(state)->count; k++) {
        for (int s = 0; s < springs_of_body(state); s++) {
            if (!find_spring(model, state, k, s, &found)) continue;
            force = fmax(force, found.force);
            length = fmax(length, scree_membrane_of(state)->rest[k][s] + found.force / found.stiffness);
        }
        const int plate = scree_membrane_plate(state, k);
        const uint32_t row = scree_membrane_row(state, k);
        if (plate < 0 || row == SCREE_NO_ROW) continue;
        const scree_wall *wall = &scree_plates(state)[plate];
        double change = fabs(axial_velocity_error(state, k, wall)) + fabs(wall->velocity);
        holding = fmax(holding, state->row[row].mass * change / state->step_size);
    }
    double pressure =
        scree_pressure_now(state) * loaded_area(model, state, length + 2 * scree_membrane_of(state)->radius);
    return fmax(holding, (in_3d ? 6 : 2) * force + pressure);
}

/// Once a step the bodies are told to all processes, as those of the Delaunay boundary are.
static scree_status follow(const scree_context *c, scree_error *error)
{
    const scree_membrane *membrane = scree_membrane_of(c->state);
    (void)error;
    scree_boundary_tell(c->state, membrane->id, membrane->body, membrane->count);
    add_half_work(c->state);
    return SCREE_OK;
}

static scree_status load(const scree_context *c, scree_error *error)
{
    (void)error;
    add_forces(c->model, c->state, c->work);
    return SCREE_OK;
}

static const scree_pass passes[] = {
    {SCREE_PHASE_FOLLOW, .run = follow}, {SCREE_PHASE_SEARCH, .run = refresh}, {SCREE_PHASE_LOADS, .run = load}};

// ---- what is stored ----------------------------------------------------------------------------------------------

typedef scree_membrane own;

const scree_group scree_membrane_bodies = {.row = "body of the membrane",
                                           .symbol = "k",
                                           .count_offset = offsetof(own, count),
                                           .capacity_offset = offsetof(own, capacity)};

#define ONE(...) SCREE_FIELD_ONE(membrane, own, __VA_ARGS__)
#define BODY(member, name, unit, meaning, ...)                                                                         \
    SCREE_FIELD_GROUP(membrane, own, scree_membrane_bodies, member, scree_vector, "membrane/" name,                    \
                      SCREE_FIELD_DOUBLE, 3, unit, meaning, __VA_ARGS__)
static const scree_field fields[] = {
    BODY(rest, "rest", "m",
         "unstressed lengths of the springs to the next body of the chain, in 3D of the ring and to two of the ring "
         "above; "
         "0: none",
         SCREE_RANGE(0, DBL_MAX)),
    BODY(press, "pressure_force", "N", "force of the pressure on this body of the membrane"),
    BODY(force, "chain_force", "N", "force of the springs on this body of the membrane, and of the plate on an end"),
    SCREE_FIELD_GROUP(membrane, own, scree_membrane_bodies, id, uint32_t, "membrane/id", SCREE_FIELD_UINT32, 1, "1",
                      "its bodies, by id", .role = SCREE_FIELD_DERIVED),
    SCREE_FIELD_GROUP(membrane, own, scree_membrane_bodies, body, scree_boundary_body, "membrane/body",
                      SCREE_FIELD_DOUBLE, 7, "1", "the bodies as other processes see them",
                      .role = SCREE_FIELD_DERIVED),
    ONE(first_id, "scalars/membrane_first_id", SCREE_FIELD_UINT64, 1, "1",
        "id of the first body of the membrane; the others follow it", SCREE_RANGE_TO(SCREE_LIMIT_IDS)),
    ONE(right, "scalars/membrane_right", SCREE_FIELD_UINT64, 1, "1", "2D: bodies of the membrane's right side"),
    ONE(around, "scalars/membrane_around", SCREE_FIELD_UINT64, 1, "1", "3D: bodies of a ring of the membrane"),
    ONE(radius, "scalars/membrane_radius", SCREE_FIELD_DOUBLE, 1, "m", "radius of the membrane's bodies",
        SCREE_RANGE(0, DBL_MAX)),
    ONE(ramp_time, "scalars/membrane_ramp_time", SCREE_FIELD_DOUBLE, 1, "s",
        "time in which the membrane takes the pressure over", SCREE_RANGE(0, DBL_MAX)),
};

static scree_status refuse(const char *name, size_t value, const char *accepted, size_t wanted, scree_error *error)
{
    return scree_error_set(error, SCREE_ERROR_IO, "dataset '%s': %zu (accepted: %s %zu)", name, value, accepted,
                           wanted);
}

/// All of its bodies are here, with its mark, and no others have it.
static scree_status check_bodies(const scree_state *state, scree_error *error)
{
    const scree_membrane *m = scree_membrane_of(state);
    size_t bodies = state->marked[SCREE_MARK_MEMBRANE];
    if (state->part) return SCREE_OK; // others have them, too
    if (m->count != bodies)
        return refuse("membrane/rest", m->count, "as many rows as there are bodies with its mark,", bodies, error);
    for (size_t k = 0; k < m->count; k++) {
        size_t row = scree_state_row_of(state, m->first_id + k);
        if (row == SCREE_NO_ROW || state->mark[row] != SCREE_MARK_MEMBRANE)
            return refuse("scalars/membrane_first_id", m->first_id, "the first of bodies of the membrane, as many as",
                          m->count, error);
    }
    return SCREE_OK;
}

/// The membrane has the bodies with its mark, in chains or rings.
static scree_status check(const scree_state *state, const scree_model *model, scree_error *error)
{
    const scree_stage_state *stage = &state->stage;
    bool began = stage->index < model->stage_count && stage->counter >= 0;
    bool present =
        began && scree_model_boundary_of(model, stage->index) == scree_modules[SCREE_SLOT_membrane]->boundary;
    const scree_membrane *m = scree_membrane_of(state);
    scree_status status = check_bodies(state, error);
    if (status) return status;
    if (present && m->count == 0) return refuse("membrane/rest", 0, "more rows than", 0, error);
    if (m->count == 0) return SCREE_OK;
    if (state->dimension == 2 && (m->right < 2 || m->right + 2 > m->count))
        return refuse("scalars/membrane_right", m->right, "2 to 2 less than", m->count, error);
    if (state->dimension == 3 && (m->around < 3 || m->count % m->around))
        return refuse("scalars/membrane_around", m->around, "3 or more, a divisor of", m->count, error);
    return SCREE_OK;
}

static scree_status derive(scree_state *state, scree_error *error)
{
    (void)error;
    const scree_membrane *m = scree_membrane_of(state);
    for (size_t k = 0; k < m->count; k++) m->id[k] = (uint32_t)(m->first_id + k);
    scree_boundary_tell(state, m->id, m->body, m->count);
    return SCREE_OK;
}

/// Springs hold its bodies together.
static const char *keeps(const scree_state *state, uint32_t id)
{
    const scree_membrane *m = scree_membrane_of(state);
    return id >= m->first_id && id < m->first_id + m->count ? "it is of the membrane" : NULL;
}

// ---- the module --------------------------------------------------------------------------------------------------

typedef scree_membrane_config config;
static const scree_key keys[] = {
    NUMBER(config, membrane_stiffness, "N/m", .standard = "10 N/mm", FROM("0 N/m"), TO("1e12 N/m"),
           .meaning = "Membrane: axial stiffness between two neighbours; 3D: of the sheet, tension per length over "
                      "strain. It bears no compression."),
    NUMBER(config, membrane_radius, "m", .standard = "auto", FROM("1 nm"), TO("100 m"),
           .meaning =
               "Membrane: radius of its bodies; auto: 1.25 times the mean radius of the particles; 3D: 0.75 times "
               "it, at least the smallest."),
};

static const scree_boundary face = {
    .walls = SCREE_AXIAL_WALLS,
    .equal_steps = true,
    .needs_rigid = "particles that deform cannot touch a membrane: choose another boundary",
    .needs_ends = "a membrane goes around a sample that does not repeat itself: give boundary: plates",
    .kept = "a membrane cannot be taken away: the stages after it must keep it",
    .resolve = scree_membrane_resolve,
    .begin = begin,
    .passes = passes,
    .pass_count = COUNT(passes),
    .bound = bound,
    .bound_differs = true,
    SCREE_AXIAL_PLATES,
};

static const scree_result columns[] = {
    {"elastic_membrane", "J", "stored in the springs of a membrane"},
    {"membrane_volume", "m3",
     "volume between the plates inside a membrane, through the centres of its bodies; not a number without one"},
};

/// Its bodies are told to all processes, which find the same.
static scree_status sample(const scree_context *c, size_t index, double *value, scree_error *error)
{
    (void)index, (void)error;
    value[0] = scree_membrane_energy(c->model, c->state);
    value[1] = scree_membrane_of(c->state)->count > 0 ? scree_membrane_volume(c->model, c->state) : NAN;
    return SCREE_OK;
}

const scree_module scree_module_membrane = {
    .name = "membrane",
    .meaning = "bodies with springs around the sides of the sample",
    .choice_of = CHOICE_OF(
        IS("stages.boundary", .meaning = "plates below and above; at the sides a chain of frictionless discs (3D: a "
                                         "sheet of spheres) carries the pressure"),
        IS("boundary.lateral", .meaning = "pressure on a membrane around the assembly")),
    .keys = (const scree_keys[]){KEYS_OF("boundary", keys, config)},
    .keys_count = 1,
    .numbers_size = sizeof(scree_membrane_numbers),
    .boundary = &face,
    .state_size = sizeof(own),
    .fields = fields,
    .field_count = COUNT(fields),
    .check = check,
    .keeps = keeps,
    .derive = derive,
    .spreads = true,
    .columns = SCREE_RESULTS_IN_PARTS(columns, sample),
};
