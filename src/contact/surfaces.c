/// Scalar, one body after the other. Cost: linear in the pairs of bodies and primitives.
#include "contact/surfaces.h"
#include "state/case_walls.h"
#include "state/sleep.h"

#include "base/fixed.h"
#include "base/vectors.h"
#include "contact/advance.h"
#include "contact/one_body.h"

/// A memory passes between normals closer than this, where the wall has no larger angle `smooth`.
#define PASSING 0.05 /* rad */
/// Levers of forces on planes, which have no extent, are shorter than this many radii.
#define PLANE_REACH 1048576.0

// ---- which primitives ----------------------------------------------------------------------------------------------

static void place_of(int dimension, const bodies *body, scree_vector position)
{
    position[0] = body->position.x;
    position[1] = body->position.y;
    position[2] = dimension == 3 ? body->position.z : 0;
}

/// Puts a touch in its place by distance; the last one of a full list falls out.
static void insert(primitive_touches *touches, const primitive_touch *touch)
{
    bool full = touches->count == CONTACT_TOUCHES;
    if (full && touches->touch[CONTACT_TOUCHES - 1].closest.distance <= touch->closest.distance) return;
    int at = full ? CONTACT_TOUCHES - 1 : touches->count++;
    for (; at > 0 && touches->touch[at - 1].closest.distance > touch->closest.distance; at--)
        touches->touch[at] = touches->touch[at - 1];
    touches->touch[at] = *touch;
}

static double cosine(const scree_vector a, const scree_vector b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Drops what is the same contact as a closer one.
static void merge(const scree_wall_set *wall_set, primitive_touches *touches)
{
    int kept = 0;
    for (int k = 0; k < touches->count; k++) {
        primitive_touch touch = touches->touch[k];
        bool same = false;
        for (int i = 0; i < kept; i++)
            same = same || (touches->touch[i].surface == touch.surface &&
                            cosine(touches->touch[i].closest.normal, touch.closest.normal) >
                                wall_set->surface[touch.surface].smooth);
        if (!same) touches->touch[kept++] = touch;
    }
    touches->count = kept;
}

/// Whether the geometry takes the outline of this wall in place of its closest point.
static bool has_outline(variant v, const scree_surface *surface)
{
    return surface->corner_count > 0 && geometry_takes_solids(v);
}

/// Normal, overlap and levers; and, of geometries with levers, how they move in `step`. seen: as it moves in the frame
/// of the wall.
static kinematics lie_beside(const scree_surface *surface, variant v, const bodies *seen,
                             const scree_closest_point *closest, double step)
{
    if (!has_outline(v, surface)) return geometry_beside(v, seen, closest->normal, closest->distance, step);
    const scree_polygon outline = scree_surface_outline(surface);
    const double apart[2] = {surface->centre[0] - seen->position.x, surface->centre[1] - seen->position.y};
    return geometry_against(v, seen, &outline, apart, step);
}

/// Whether the body reaches its closest point, or a neck of this reach [m] may.
static bool is_near(const scree_wall_set *wall_set, size_t primitive, variant v, const bodies *body,
                    const scree_closest_point *closest, double reach)
{
    const double radius = wall_reach(v.dimension, body->radius, closest->normal, body->stretch) + reach;
    return has_outline(v, contact_surface_of(wall_set, primitive))
               ? !(closest->distance >= radius)
               : scree_closest_point_touches(wall_set, primitive, closest, radius);
}

/// Whether kinematics tell that it touches, where they alone do.
static bool meets(const scree_wall_set *wall_set, size_t primitive, variant v, const bodies *body,
                  const scree_closest_point *closest)
{
    if (!geometry_is_coarse(v)) return true;
    const kinematics m = lie_beside(contact_surface_of(wall_set, primitive), v, body, closest, 0);
    return expanded_touch(&m) != 0;
}

/// Those of the pairs [begin, end) of one body that are near, or that touch.
static void gather(const scree_wall_set *wall_set, int dimension, const bodies *body, const scree_wall_pair_list *pairs,
                   size_t begin, size_t end, bool near, primitive_touches *touches)
{
    const variant v = {.dimension = dimension, .geometry = pairs->geometry};
    scree_vector position;
    place_of(dimension, body, position);
    touches->count = 0;
    for (size_t p = begin; p < end; p++) {
        const size_t primitive = pairs->wall[p];
        primitive_touch touch = {.pair = p, .surface = scree_primitive_surface(wall_set, primitive)};
        scree_primitive_closest_point(wall_set, primitive, position, &touch.closest);
        const memory_rows rows = memory_rows_at(pairs->history, pairs->last_force, pairs->rolling, p);
        const double reach = pairs->reach > 0 && !memory_is_clear(&rows) ? pairs->reach : 0;
        if (!is_near(wall_set, primitive, v, body, &touch.closest, reach)) continue;
        if (near || meets(wall_set, primitive, v, body, &touch.closest)) insert(touches, &touch);
    }
    merge(wall_set, touches);
}

void contact_primitives_touching(const scree_wall_set *wall_set, int dimension, const bodies *body,
                                 const scree_wall_pair_list *pairs, size_t begin, size_t end,
                                 primitive_touches *touches)
{
    gather(wall_set, dimension, body, pairs, begin, end, false, touches);
}

void contact_primitives_mark(const scree_state *state, const scree_work *work, uint8_t *touching)
{
    const scree_wall_pair_list *pairs = &work->primitive_pairs;
    primitive_touches touches;
    for (size_t begin = 0, end; begin < pairs->count; begin = end) {
        end = contact_group_end(pairs, begin);
        for (size_t p = begin; p < end; p++) touching[p] = 0;
        const contact_body body = contact_body_get(state, pairs->body[begin]);
        const bodies one = contact_body_lane(state->dimension, &body);
        contact_primitives_touching(work->wall_set, state->dimension, &one, pairs, begin, end, &touches);
        for (int k = 0; k < touches.count; k++) touching[touches.touch[k].pair] = 1;
    }
}

// ---- one contact -------------------------------------------------------------------------------------------------

scree_pair_constants contact_surface_constants(const scree_model *model, const scree_surface *surface, int material)
{
    return model->surfaces[surface->config - model->walls_of_case][material];
}

const scree_law_use *contact_surface_law(const scree_model *model, const scree_surface *surface, int material)
{
    return scree_model_law_on_wall(model, surface->config - model->walls_of_case, material);
}

/// Velocity and spin of a body in the frame of a wall that moves with v and turns with w: there it goes in a step from
/// R(w dt) y(n-1) to y(n), y from the centre of the wall, and its spin w(n-1/2) has turned by w dt / 2 since then. Up
/// to second order in dt, in the directions of n:
///   (u - v - w x y) (1 + dt w x) + dt/2 w x (w x y),     (1 + dt/2 w x) spin - w
static void see_from_wall(int dimension, const scree_surface *surface, const bodies *body, double step,
                          vector *velocity, vector *spin)
{
    const double *v = surface->velocity, *w = surface->config->spin;
    double turning[3], twice[3], change[3], y[3] = {body->position.x, body->position.y, body->position.z};
    scree_subtract(y, surface->hub, y);
    scree_cross(w, y, turning);
    scree_cross(w, turning, twice);
    const double u[3] = {body->velocity.x - v[0] - turning[0], body->velocity.y - v[1] - turning[1],
                         body->velocity.z - v[2] - turning[2]};
    scree_cross(w, u, change);
    *velocity = (vector){u[0] + step * (change[0] + 0.5 * twice[0]), u[1] + step * (change[1] + 0.5 * twice[1]),
                         u[2] + step * (change[2] + 0.5 * twice[2])};
    *spin = (vector){.x = body->spin.x - w[2]};
    if (dimension == 2) return;
    const double own[3] = {body->spin.x, body->spin.y, body->spin.z}, half = 0.5 * step;
    scree_cross(w, own, change);
    *spin =
        (vector){own[0] + half * change[0] - w[0], own[1] + half * change[1] - w[1], own[2] + half * change[2] - w[2]};
}

/// How the normal of a primitive turns in a step while a body goes by with `velocity`, both in the frame of the wall.
/// Nothing where it jumps.
static vector tilt_of(const scree_wall_set *wall_set, size_t primitive, int dimension, const bodies *body,
                      const scree_closest_point *closest, vector velocity, double step)
{
    scree_closest_point before;
    const vector from = vector_minus(3, body->position, vector_times(3, velocity, step));
    scree_primitive_closest_point(wall_set, primitive, (const double[3]){from.x, from.y, from.z}, &before);
    const double *n = closest->normal, *old = before.normal;
    if (!(cosine(n, old) > cos(PASSING))) return vector_none();
    const vector turned = {n[0] - old[0], n[1] - old[1], n[2] - old[2]};
    return vector_across(dimension, turned, (vector){n[0], n[1], n[2]});
}

kinematics kinematics_of_surface(const scree_wall_set *wall_set, size_t primitive, variant v, const bodies *body,
                                 const scree_closest_point *closest, bool moving, double step)
{
    const scree_surface *surface = contact_surface_of(wall_set, primitive);
    const int dimension = v.dimension;
    vector velocity = body->velocity, spin = body->spin;
    if (moving) see_from_wall(dimension, surface, body, step, &velocity, &spin);
    bodies seen = *body;
    seen.velocity = velocity;
    seen.spin = spin;
    kinematics m = lie_beside(surface, v, &seen, closest, step);
    if (!scree_surface_is_flat(surface) && !has_outline(v, surface))
        m.tilted = tilt_of(wall_set, primitive, dimension, body, closest, velocity, step);
    kinematics_past(v, &m, &seen, step);
    if (dimension == 3 && moving) {
        // What the contact remembers turns with the wall, too.
        const double *w = surface->config->spin;
        m.turn += step * cosine(w, closest->normal);
        m.turned = vector_times(3, m.normal, m.turn);
    }
    return m;
}

/// Turns a tangential displacement into the tangent plane, with its length: the normal of a wall turns by more than
/// kinematics.h knows of.
static void turn_displacement(const scree_vector normal, double tangential_displacement[3])
{
    double along = cosine(tangential_displacement, normal),
           square = cosine(tangential_displacement, tangential_displacement), left = square - along * along;
    if (!(left > 0)) return;
    double factor = sqrt(square / left);
    for (int k = 0; k < 3; k++) tangential_displacement[k] = factor * (tangential_displacement[k] - along * normal[k]);
}

static void turn_displacements(const scree_vector normal, const memory_rows *rows)
{
    turn_displacement(normal, rows->history->value);
    if (rows->rolling) turn_displacement(normal, rows->rolling->value);
}

// ---- evaluation --------------------------------------------------------------------------------------------------

/// The evaluation of one body: its pairs with primitives and those of them that touch.
typedef struct group {
    const scree_wall_set *wall_set;
    const scree_wall_pair_list *pairs;
    size_t begin, end;
    bool alone; ///< one pair, so that no other is the same contact: whether it touches is left to its kinematics
    scree_vector position;
    primitive_touches touches;
} group;

static memory_rows memory_at(const group *g, size_t p)
{
    return memory_rows_at(g->pairs->history, g->pairs->last_force, g->pairs->rolling, p);
}

static const primitive_touch *touch_of(const group *g, size_t p)
{
    for (int k = 0; k < g->touches.count; k++)
        if (g->touches.touch[k].pair == p) return &g->touches.touch[k];
    return NULL;
}

/// The pair that the body has just left, of the same wall, whose normal is nearest to that of `touch`; SIZE_MAX: none.
static size_t find_former(const group *g, const primitive_touch *touch)
{
    double nearest = fmin(g->wall_set->surface[touch->surface].smooth, cos(PASSING));
    size_t former = SIZE_MAX;
    for (size_t p = g->begin; p < g->end; p++) {
        memory_rows rows = memory_at(g, p);
        if (memory_is_clear(&rows) || touch_of(g, p)) continue;
        if (scree_primitive_surface(g->wall_set, g->pairs->wall[p]) != touch->surface) continue;
        scree_closest_point closest;
        scree_primitive_closest_point(g->wall_set, g->pairs->wall[p], g->position, &closest);
        double alike = cosine(closest.normal, touch->closest.normal);
        if (!(alike > nearest)) continue;
        nearest = alike;
        former = p;
    }
    return former;
}

/// Hands the memory of primitives that the body has left to those that it touches anew.
static void pass_memory(group *g)
{
    for (int k = 0; k < g->touches.count; k++) {
        size_t to = g->touches.touch[k].pair;
        memory_rows rows = memory_at(g, to);
        if (!memory_is_clear(&rows)) continue;
        size_t from = find_former(g, &g->touches.touch[k]);
        if (from == SIZE_MAX) continue;
        memory_rows old = memory_at(g, from);
        *rows.history = *old.history;
        *old.history = (scree_history){{0}};
        if (rows.last_force) {
            *rows.last_force = *old.last_force;
            *old.last_force = (scree_last_force){{0}};
        }
        if (rows.rolling) {
            *rows.rolling = *old.rolling;
            *old.rolling = (scree_rolling){{0}, {0}};
        }
    }
}

void contact_surface_torque(const scree_state *state, const scree_vector hub, const bodies *body,
                            const contact_quanta *q, scree_vector torque)
{
    const bool in_3d = state->dimension == 3;
    const double f[3] = {scree_fixed_to((int64_t)q->force.x, state->force_quantum),
                         scree_fixed_to((int64_t)q->force.y, state->force_quantum),
                         in_3d ? scree_fixed_to((int64_t)q->force.z, state->force_quantum) : 0};
    const double lever[3] = {body->position.x - hub[0], body->position.y - hub[1],
                             in_3d ? body->position.z - hub[2] : 0};
    const int64_t couple[3] = {in_3d ? (int64_t)q->torque_first.x : 0, in_3d ? (int64_t)q->torque_first.y : 0,
                               (int64_t)(in_3d ? q->torque_first.z : q->torque_first.x)};
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        torque[k] = lever[i] * f[j] - lever[j] * f[i] + scree_fixed_to(couple[k], state->torque_quantum);
    }
}

/// Force and torque about the centre of the wall: the opposite of what the body gets, F at its centre and its torque.
static void add_to_surface(contact_job *job, int surface, const scree_vector hub, const bodies *body,
                           const contact_quanta *q, const scree_state *state)
{
    const uint64_t force[3] = {q->force.x, q->force.y, job->variant.dimension == 3 ? q->force.z : 0};
    scree_vector torque;
    contact_surface_torque(state, hub, body, q, torque);
    for (int k = 0; k < 3; k++) {
        job->totals.surface_force[surface][k] -= force[k];
        job->totals.surface_torque[surface][k] -=
            (uint64_t)scree_fixed_from(torque[k], job->scale.inverse_surface_torque);
    }
}

/// Whether a body sleeps beside a wall that stands: nothing of their contact changes.
static bool sleeps_on(const scree_state *state, size_t row, const scree_surface *surface)
{
    return scree_body_sleeps(state, row) && surface->stands;
}

SCREE_INLINE void evaluate_group(contact_job *job, variant v, const scree_state *state, group *g)
{
    const size_t row = g->pairs->body[g->begin];
    bodies one = contact_body_at(job, row);
    for (size_t p = g->begin; p < g->end; p++) {
        const primitive_touch *touch = touch_of(g, p);
        memory_rows rows = memory_at(g, p);
        if (scree_wall_pair_law(g->pairs, p) != job->law) continue;
        if (!touch && memory_is_clear(&rows)) continue;
        const scree_surface *surface = contact_surface_of(g->wall_set, g->pairs->wall[p]);
        if (sleeps_on(state, row, surface)) continue;
        scree_closest_point left;
        if (!touch) scree_primitive_closest_point(g->wall_set, g->pairs->wall[p], g->position, &left);
        const scree_closest_point *closest = touch ? &touch->closest : &left;
        if (v.dimension == 3 && law_traits(v)->displacement) turn_displacements(closest->normal, &rows);
        kinematics m = kinematics_of_surface(g->wall_set, g->pairs->wall[p], v, &one, closest,
                                             scree_case_walls(state)->moving != 0, job->settings.step);
        const bool touching = touch && !(g->alone && geometry_is_coarse(v) && !expanded_touch(&m));
        if (!touching && memory_is_clear(&rows)) continue;
        if (law_deforms(v)) {
            const stretch own = stretch_get(v.dimension, contact_stretch_at(job, row), NULL);
            kinematics_expand(v.dimension, &m, &own, job->settings.step);
        }
        if (law_predicts(v)) {
            prediction ahead = prediction_get(v.dimension, &job->predicted[row]);
            kinematics_predict(v.dimension, &m, &one, &ahead, NULL, NULL);
        }
        scree_pair_constants constants = contact_surface_constants(job->model, surface, (int)one.material);
        contact_quanta q = contact_advance(job, v, &constants, NULL, &m, touching, &rows);
        contact_add_to_sums(job, row, q.force, q.torque_first, q.count);
        if (v.moments) contact_add_moments(job, law_deforms(v), row, contact_branch_of(v, &m, true), q.straining);
        add_to_surface(job, (int)(surface - g->wall_set->surface), surface->hub, &one, &q, state);
    }
}

/// Whether nothing of it changes: the body sleeps, and the walls stand.
static bool rests(const scree_state *state, const group *g, size_t row)
{
    for (size_t p = g->begin; p < g->end; p++)
        if (!sleeps_on(state, row, contact_surface_of(g->wall_set, g->pairs->wall[p]))) return false;
    return true;
}

static bool holds_memory(const group *g)
{
    for (size_t p = g->begin; p < g->end; p++) {
        memory_rows rows = memory_at(g, p);
        if (!memory_is_clear(&rows)) return true;
    }
    return false;
}

/// In space, where it pays, the law is known.
#define GROUP_OF_LAW(law_)                                                                                             \
    if (v.dimension == 3 && v.law == SCREE_SLOT_##law_)                                                                \
        evaluate_group(job, (variant){3, SCREE_SLOT_##law_, v.option, true, v.moments, v.geometry}, state, &g);

/// In the plane geometries of one by one stand apart from that in lanes, which is as fast as if there were no others.
__attribute__((noinline)) static void evaluate_one_by_one(contact_job *job, const scree_state *state, group *g)
{
    const variant v = job->variant;
    evaluate_group(job, (variant){2, v.law, v.option, true, v.moments, v.geometry}, state, g);
}

static void evaluate_2d(contact_job *job, const scree_state *state, group *g)
{
    const variant v = job->variant;
    const int geometry = GEOMETRIES_IN_LANES == 1 ? 0 : v.geometry;
    if (geometry_is_one_by_one(v)) {
        evaluate_one_by_one(job, state, g);
        return;
    }
    evaluate_group(job, (variant){2, v.law, v.option, true, v.moments, geometry}, state, g);
}

void contact_surfaces(contact_job *job, const scree_state *state, const scree_work *work, size_t begin, size_t end)
{
    const variant v = job->variant;
    group g = {.wall_set = work->wall_set, .pairs = &work->primitive_pairs};
    for (g.begin = 0; g.begin < g.pairs->count; g.begin = g.end) {
        g.end = contact_group_end(g.pairs, g.begin);
        size_t row = g.pairs->body[g.begin];
        if (row < begin || row >= end || rests(state, &g, row)) continue;
        const bodies one = contact_body_at(job, row);
        g.alone = g.end - g.begin == 1;
        gather(g.wall_set, v.dimension, &one, g.pairs, g.begin, g.end, g.alone, &g.touches);
        if (g.touches.count == 0 && !holds_memory(&g)) continue;
        place_of(v.dimension, &one, g.position);
        if (job->law == 0) pass_memory(&g); // of all laws: that of a body on a wall does not change
        SCREE_LAWS(GROUP_OF_LAW)
        if (v.dimension == 2) evaluate_2d(job, state, &g);
    }
}

// ---- the walls ---------------------------------------------------------------------------------------------------

double contact_surface_torque_quantum(const scree_model *model, const scree_state *state,
                                      const scree_wall_set *wall_set)
{
    double radius = scree_model_largest_radius(model), reach = 0;
    int exponent = 0;
    for (int k = 0; wall_set && k < wall_set->count; k++) {
        const scree_surface *surface = &wall_set->surface[k];
        reach = fmax(reach, surface->reach > 0 ? surface->reach : PLANE_REACH * radius);
    }
    if (wall_set) (void)frexp(2 * (reach + 2 * radius), &exponent);
    return ldexp(state->force_quantum, exponent);
}

double contact_surfaces_settle(scree_state *state, const scree_work *work, const contact_totals *totals,
                               const contact_scale *scale)
{
    double whole = 0;
    for (int w = 0; work->wall_set && w < work->wall_set->count; w++) {
        const scree_surface *surface = &work->wall_set->surface[w];
        const double *velocity = surface->velocity, *spin = surface->config->spin;
        scree_surface_load *load = &scree_case_walls(state)->load[w];
        double power = 0;
        for (int k = 0; k < 3; k++) {
            double force = scree_fixed_to((int64_t)totals->surface_force[w][k], state->force_quantum);
            double torque = (double)(int64_t)totals->surface_torque[w][k] / scale->inverse_surface_torque;
            power -= (force + load->force[k]) * velocity[k] + (torque + load->torque[k]) * spin[k];
            load->force[k] = force;
            load->torque[k] = torque;
        }
        double done = scree_case_walls(state)->moving ? 0.5 * state->step_size * power : 0;
        load->work += done;
        whole += done;
    }
    return whole;
}
