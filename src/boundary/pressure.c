/// Pressure applied directly to the Delaunay boundary (P 2.5; Bagi 1996), at the present positions every step. Here the
/// loop of 2D; hull.c has the hull of 3D.
///
/// A segment of the outline (measure/outline.h) from a to b, sample on the left, carries the force p t rot(b - a) with
/// rot(x, y) = (-y, x): p times length times thickness t along the inward normal. An edge gives half of it to each of
/// its two bodies, a segment between a corner and its plate all of it to the corner.
///
/// Conservation. With the integers H(x) = round(p t / 2 x / quantum) of the ends, the halves are differences
/// rot(H(b) - H(a)); over a closed outline they telescope. So, to the last bit, the forces on a closed loop add up to
/// zero, and with plates the two sides press against each other with equal forces p t (distance of the plates).
///
/// Work. Trapezoidal as for all forces (measure/energy.c): each force is accumulated half with v(n-1/2), which the rows
/// hold for both schemes between `first` and `second`, and half with v(n+1/2), which they hold after the next `first`.
///
/// Bodies that deform are strained by the pressure as by a contact: its force on a body comes in at the arm -R F/|F|,
/// which makes the moments -F F/|F| R; they are said before the strains of a step are found, and the work over what
/// the strains do to surfaces is trapezoidal, too, with moments that the state keeps body by body.
///
/// Bodies are handed to the triangulation in the order of their ids: neither the order of rows nor the number of
/// threads shows. Cost: O(length of the loop) a step; a refresh 5 ms for 4000 bodies, 0.5 s for a million
/// (search/outer_loop.c).
#include "boundary/pressure.h"
#include "measure/delaunay_boundary.h"
#include "state/periodic.h"

#include "base/fixed.h"
#include "base/integer_sum.h"
#include "base/wrapping.h"
#include "boundary/hull.h"
#include "boundary/loaded_edges.h"
#include "boundary/loaded_triangles.h"
#include "boundary/surface_work.h"
#include "comm/comm.h"
#include "contact/stretch.h"
#include "measure/facets.h"
#include "measure/measure.h"
#include "measure/outline.h"
#include "search/delaunay.h"
#include "shape/outlines.h"
#include "state/deformation.h"
#include "state/fields.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

/// The loop of the present positions, as ids.
static scree_status find_loop(const scree_model *model, const scree_state *state, uint32_t **ids, size_t *count,
                              scree_error *error)
{
    double *points = NULL, *radius = NULL;
    scree_outlines outlines = {0};
    scree_peel_rule rule;
    uint32_t *past = NULL;
    scree_grain_place *grain = NULL;
    size_t grains = 0;
    scree_status status = scree_grain_places(state, &grain, &grains, error);
    if (!status) status = scree_facet_rule(model, state, grain, grains, &rule, &past, error);
    if (!status) status = scree_outlines_find(state, &outlines, error);
    if (!status) status = scree_allocate(&points, 2 * grains, sizeof *points, error);
    if (!status) status = scree_allocate(&radius, grains, sizeof *radius, error);
    if (!status) {
        for (size_t k = 0; k < grains; k++) {
            points[2 * k] = grain[k].position[0];
            points[2 * k + 1] = grain[k].position[1];
            radius[k] = grain[k].radius;
        }
        rule.outline = outlines.core;
        status = scree_outer_loop(points, radius, grains, 2 * model->mean_radius, &rule, ids, count, error);
    }
    for (size_t k = 0; k < *count && !status; k++) (*ids)[k] = (uint32_t)grain[(*ids)[k]].id;
    scree_release(&grain);
    scree_release(&past);
    scree_outlines_destroy(&outlines);
    scree_release(&points);
    scree_release(&radius);
    return status;
}

/// Puts the new loop in the place of the old one, whose strain increment is closed first.
static void replace_loop(const scree_model *model, scree_state *state, const uint32_t *ids, size_t count)
{
    scree_loop *loop = scree_loop_of(state);
    double enclosed = scree_strain_close(state);
    loop->count = count;
    loop->updated = state->step;
    memcpy(loop->id, ids, count * sizeof *ids);
    scree_boundary_tell(state, loop->id, loop->body, count);
    for (size_t k = 0; k < count; k++) {
        double x[2];
        scree_loop_position(state, k, x);
        loop->x[k] = x[0];
        loop->y[k] = x[1];
        loop->fx[k] = loop->fy[k] = 0;
    }
    scree_strain_redetected(state, enclosed);
    scree_loop_mark_loaded(model, state);
}

scree_status scree_boundary_mark_loaded(const scree_model *model, scree_state *state, scree_error *error)
{
    if (state->dimension == 3) return scree_hull_mark_loaded(model, state, scree_hull_of(state), error);
    if (scree_loop_of(state)->count > 0) scree_loop_mark_loaded(model, state);
    return SCREE_OK;
}

/// The boundary of the last update serves for some steps more.
static bool is_fresh(const scree_model *model, const scree_state *state)
{
    bool in_3d = state->dimension == 3;
    size_t count = in_3d ? scree_hull_of(state)->node_count : scree_loop_of(state)->count;
    uint64_t updated = in_3d ? scree_hull_of(state)->updated : scree_loop_of(state)->updated;
    if (scree_delaunay_boundary_of(state)->stale) return false;
    return count > 0 && state->step - updated < model->upkeep.every;
}

scree_status scree_boundary_refresh(const scree_model *model, scree_state *state, scree_error *error)
{
    if (scree_cell(state)->directions || is_fresh(model, state)) return SCREE_OK;
    if (state->dimension == 3) return scree_hull_renew(model, state, error);
    uint32_t *ids = NULL;
    size_t count = 0;
    scree_status status = find_loop(model, state, &ids, &count, error);
    if (!status) status = scree_group_reserve(state, &scree_module_delaunay_boundary, &scree_loop_group, count, error);
    if (!status) replace_loop(model, state, ids, count);
    if (!status) scree_delaunay_boundary_of(state)->stale = 0;
    scree_release(&ids);
    return status;
}

/// A point of the outline in quanta of the force.
typedef struct outline_point {
    double x[2]; ///< m
    int64_t quanta[2];
} outline_point;

typedef struct pressure_forces {
    scree_state *state;
    scree_loop *loop;
    double origin[2];  ///< m, so that the integers stay small
    double quantum;    ///< N
    double scale;      ///< quanta a metre: p t / 2 / quantum
    bool adds;         ///< to the sums, too: the quantum is that of the state
    outline_point end; ///< of the last segment: the next one mostly begins there
} pressure_forces;

static outline_point point_of(const pressure_forces *forces, const double x[2])
{
    outline_point point = {.x = {x[0], x[1]}};
    for (int i = 0; i < 2; i++) point.quanta[i] = scree_fixed_round((x[i] - forces->origin[i]) * forces->scale);
    return point;
}

/// Half of the force of a segment, f quanta or `newtons`, on one of its bodies.
static inline void add_force(const pressure_forces *forces, size_t k, const int64_t f[2], const double newtons[2])
{
    scree_state *state = forces->state;
    const uint32_t row = scree_state_row_of(state, forces->loop->id[k]);
    if (forces->adds && row != SCREE_NO_ROW) {
        scree_wrapping_add(&state->sum[row].fx, f[0]);
        scree_wrapping_add(&state->sum[row].fy, f[1]);
    }
    forces->loop->fx[k] += newtons[0];
    forces->loop->fy[k] += newtons[1];
}

static void press_segment(void *user, const scree_outline_segment *segment)
{
    pressure_forces *forces = user;
    if (segment->kind == SCREE_OUTLINE_BARE) return;
    outline_point from = forces->end;
    if (from.x[0] != segment->from[0] || from.x[1] != segment->from[1]) from = point_of(forces, segment->from);
    forces->end = point_of(forces, segment->to);
    const int64_t f[2] = {-(forces->end.quanta[1] - from.quanta[1]), forces->end.quanta[0] - from.quanta[0]};
    const double quantum = forces->quantum, newtons[2] = {(double)f[0] * quantum, (double)f[1] * quantum};
    add_force(forces, segment->first, f, newtons);
    add_force(forces, segment->second, f, newtons);
}

/// The terms are found once for both passes of the sum: rows of bodies along a loop lie all over the memory.
static double loop_power(const scree_state *state)
{
    const scree_loop *loop = scree_loop_of(state);
    for (size_t k = 0; k < loop->count; k++) {
        scree_vector velocity;
        scree_boundary_velocity(state, loop->id[k], &loop->body[k], velocity);
        loop->term[k] = loop->fx[k] * velocity[0] + loop->fy[k] * velocity[1];
    }
    return scree_integer_sum_of(loop->term, loop->count);
}

/// 1/2 F . v dt with the velocities that the rows hold now.
static void add_half_work(scree_state *state)
{
    double power = state->dimension == 3 ? scree_hull_power(state) : loop_power(state);
    double work = 0.5 * state->step_size * power;
    state->ledger.pressure += work;
    state->ledger.turnover += fabs(work);
}

/// Keeps the forces at the present positions with the loop or the hull.
static void press(const scree_model *model, scree_state *state, double quantum, bool adds)
{
    scree_loop *loop = scree_loop_of(state);
    if (state->dimension == 3) {
        scree_hull_press(state, quantum, adds);
        return;
    }
    if (loop->count == 0) return;
    memset(loop->fx, 0, loop->count * sizeof *loop->fx);
    memset(loop->fy, 0, loop->count * sizeof *loop->fy);
    double pressure = scree_direct_pressure(state);
    if (!(pressure > 0)) return;
    pressure_forces forces = {.state = state,
                              .loop = loop,
                              .quantum = quantum,
                              .scale = 0.5 * pressure * model->thickness / quantum,
                              .adds = adds};
    scree_loop_position(state, 0, forces.origin);
    forces.end = point_of(&forces, forces.origin);
    scree_outline_walk(state, press_segment, &forces);
}

void scree_pressure_forces(const scree_model *model, scree_state *state)
{
    press(model, state, state->force_quantum, true);
    add_half_work(state);
}

void scree_pressure_work(scree_state *state)
{
    add_half_work(state);
}

/// Largest square of a length.
static void longest_segment(void *user, const scree_outline_segment *segment)
{
    double *longest = user, dx = segment->to[0] - segment->from[0], dy = segment->to[1] - segment->from[1];
    if (segment->kind != SCREE_OUTLINE_BARE && dx * dx + dy * dy > *longest) *longest = dx * dx + dy * dy;
}

double scree_pressure_bound(const scree_model *model, const scree_state *state)
{
    double longest = 0;
    if (state->dimension == 3) return scree_hull_pressure_bound(model, state);
    if (!(scree_pressure_now(state) > 0)) return 0;
    scree_outline_walk(state, longest_segment, &longest);
    // At most two segments meet in a body.
    return 2 * scree_pressure_now(state) * model->thickness * sqrt(longest);
}

// ---- state -------------------------------------------------------------------------------------------------------

static const scree_field fields[] = {
    SCREE_FIELD_ONE(pressure, scree_pressure, now, "scalars/pressure", SCREE_FIELD_DOUBLE, 1, "Pa",
                    "confining pressure applied now"),
    SCREE_FIELD_BODY(pressure, scree_pressure, surface, double[6], "pressure/surface", SCREE_FIELD_DOUBLE, 6, "N",
                     "moments over the radius of the forces of the pressure on the surface of a body that deforms: "
                     "xx, yy, xy; xx, yy, zz, yz, xz, xy",
                     .optional = true),
};
static const scree_field *const surface_field = &fields[1];

// ---- bodies that deform ------------------------------------------------------------------------------------------

static scree_pressure *own_state(const scree_state *state)
{
    return state->own[SCREE_SLOT_pressure];
}

/// Row and force [N] of place k of the loop or the hull, SCREE_NO_ROW where another process has the body; false behind
/// the last.
static bool force_at(const scree_state *state, size_t k, uint32_t *row, double force[3])
{
    const scree_loop *loop = scree_loop_of(state);
    const scree_hull *hull = scree_hull_of(state);
    const bool in_3d = state->dimension == 3;
    if (k >= (in_3d ? hull->node_count : loop->count)) return false;
    *row = scree_state_row_of(state, in_3d ? hull->id[k] : loop->id[k]);
    for (int i = 0; i < 3; i++) force[i] = in_3d ? hull->force[k][i] : i == 0 ? loop->fx[k] : i == 1 ? loop->fy[k] : 0;
    return true;
}

/// The pressure comes in where its force on a body enters it: at the arm -R F/|F|.
static bool find_arm(const scree_state *state, size_t row, const double force[3], double arm[3])
{
    const double size = scree_length(force), radius = scree_body_bounding_radius(state, row);
    for (int i = 0; i < 3 && size > 0; i++) arm[i] = -radius * force[i] / size;
    return size > 0;
}

/// Before the strains of n + 1 are found: what the pressure at its positions puts on surfaces. The forces of n, which
/// the loop has kept, have done their work by then.
static scree_status attack(const scree_context *c, scree_error *error)
{
    scree_state *state = c->state;
    const double bound = scree_pressure_bound(c->model, state);
    double force[3], arm[3];
    uint32_t row;
    if (!state->stretch || c->boundary->open || !(bound > 0)) return SCREE_OK;
    scree_status status = own_state(state)->surface ? SCREE_OK : scree_state_begin_field(state, surface_field, error);
    if (status) return status;
    // That of the state is not known yet.
    press(c->model, state, ldexp(bound, -50), false);
    scree_deformation_await_attack(state);
    for (size_t k = 0; force_at(state, k, &row, force); k++)
        if (row != SCREE_NO_ROW && find_arm(state, row, force, arm)) scree_deformation_attack(state, row, arm, force);
    return SCREE_OK;
}

static void add_half_surface_work(scree_state *state)
{
    const double work = scree_surface_half_work(state, (const double(*)[6])own_state(state)->surface);
    state->ledger.pressure += work;
    state->ledger.turnover += fabs(work);
}

/// The moments of the forces that the loop has now.
static void keep_surface(scree_state *state)
{
    const int d = state->dimension;
    const scree_tensor_place *place = scree_tensor_places(d);
    double force[3];
    uint32_t row;
    memset(own_state(state)->surface, 0, state->count * sizeof *own_state(state)->surface);
    for (size_t k = 0; force_at(state, k, &row, force); k++) {
        const double size = scree_length(force);
        for (int n = 0; n < scree_tensor_size(d) && size > 0 && row != SCREE_NO_ROW; n++)
            own_state(state)->surface[row][n] -= force[place[n].i] * force[place[n].j] / size;
    }
}

// ---- module ------------------------------------------------------------------------------------------------------

static scree_status follow(const scree_context *c, scree_error *error)
{
    (void)error;
    scree_pressure_work(c->state);
    return SCREE_OK;
}

static scree_status load(const scree_context *c, scree_error *error)
{
    scree_state *state = c->state;
    const bool strains = own_state(state)->surface && state->stretch;
    (void)error;
    if (strains) add_half_surface_work(state);
    scree_pressure_forces(c->model, state);
    if (!strains) return SCREE_OK;
    keep_surface(state);
    add_half_surface_work(state);
    return SCREE_OK;
}

static double bound(const scree_context *c)
{
    return scree_pressure_bound(c->model, c->state);
}

static const scree_pass passes[] = {
    {SCREE_PHASE_FOLLOW, .run = follow}, {SCREE_PHASE_SEARCH, .run = attack}, {SCREE_PHASE_LOADS, .run = load}};

const scree_module scree_module_pressure = {
    .name = "pressure",
    .meaning = "the confining pressure, on the Delaunay boundary where nothing else carries it",
    .state_size = sizeof(scree_pressure),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .passes = passes,
    .pass_count = sizeof passes / sizeof *passes,
    .bound = bound,
    .spreads = true,
};
