/// The implicit strain: that of the forces which it makes itself, at the same time.
///
/// With the stretch w = R strain of each body, F(w) the symmetric moments of all forces on it over R [N] (the laws
/// evaluated at n + 1 with w, and loads on surfaces), and C = V/R^2 D its stiffness [N/m],
///     C w = F(w).
/// Outer loop, Newton's: F from the laws themselves, which advance no memory here (contact/trial.h); a step
/// x from the springs that act at w,
///     (C + sum over springs N k N^T) x = F(w) - C w,     N f = sym(n f)
/// symmetric and positive definite in both tangential forms, as published because moments of normal forces answer
/// normal expansions alone. Conjugate gradients, preconditioned by C. Bonded springs need one step. Where contacts open
/// and close F is the gradient of a convex function piece by piece: a step that makes the error larger is halved.
/// Friction that slides with the normal force is left out of the springs: some steps more. No convergence stops the
/// run.
///
/// Free of order. Moments are sums in integers of the force quantum, or of one below 2^-50 of the largest force of the
/// springs; dot products are integer sums; the begin is w(n) and its last change, which the state holds. So threads,
/// age of the list and restarts do not show. Error: tolerance times the largest stretch, and what integers round.
///
/// Energy: nothing lags, so the bodies store what they take up, but for the tolerance. Cost: an evaluation of the
/// forces for each step of Newton's and one more, some 10 to 30 products of a third of that.
#include "contact/implicit.h"

#include "base/integer_sum.h"
#include "case/check.h"
#include "comm/comm.h"
#include "contact/bounds.h"
#include "contact/contact.h"
#include "contact/single.h"
#include "contact/surfaces.h"
#include "contact/trial.h"
#include "model/law.h"
#include "search/neighbours.h"
#include "state/deformation.h"
#include "state/periodic.h"
#include "state/persistent.h"

#include <float.h>

enum { MOST_STEPS = 60, MOST_HALVINGS = 8, MOST_PRODUCTS = 1000 };
/// Of conjugate gradients, relative to that of the outer loop.
static const double INNER = 0.1;
/// Force quanta that rounding may leave in the moments of a body.
static const double NOISE = 64;

typedef double tensor[6];

/// A contact that answers a change of stretch.
typedef struct spring {
    uint32_t first, second; ///< rows of bodies; SCREE_NO_ROW: a wall
    double normal[3];
    double stiffness[2]; ///< N/m, along the normal and across
    double force[3];     ///< N, of a product
} spring;

typedef struct solve {
    const scree_context *c;
    const scree_compliance *compliance; ///< by material
    int d, size;
    size_t count, spring_count, spring_capacity;
    spring *spring;
    tensor *residual, *step, *direction, *product, *scaled; ///< one a body
    int64_t (*sum)[6];
    double *term;
} solve;

static void release(solve *s)
{
    scree_release(&s->spring);
    scree_release(&s->residual);
    scree_release(&s->step);
    scree_release(&s->direction);
    scree_release(&s->product);
    scree_release(&s->scaled);
    scree_release(&s->sum);
    scree_release(&s->term);
}

static scree_status reserve(solve *s, scree_error *error)
{
    const size_t count = s->count;
    scree_status status = scree_allocate(&s->residual, count, sizeof *s->residual, error);
    if (!status) status = scree_allocate(&s->step, count, sizeof *s->step, error);
    if (!status) status = scree_allocate(&s->direction, count, sizeof *s->direction, error);
    if (!status) status = scree_allocate(&s->product, count, sizeof *s->product, error);
    if (!status) status = scree_allocate(&s->scaled, count, sizeof *s->scaled, error);
    if (!status) status = scree_allocate(&s->sum, count, sizeof *s->sum, error);
    if (!status) status = scree_allocate(&s->term, count, sizeof *s->term, error);
    return status;
}

// ---- tensors of the bodies ---------------------------------------------------------------------------------------

static double magnitude(const solve *s, const tensor a)
{
    return sqrt(scree_tensor_product(s->d, a, a));
}

/// z = C^-1 r
static void yield(const solve *s, size_t row, const tensor r, tensor z)
{
    const scree_state *state = s->c->state;
    const scree_compliance *by = &s->compliance[scree_body_material(state, row)];
    const double volume = scree_stretch_volume(s->d, s->c->model->thickness, state->row[row].radius);
    double trace = 0;
    for (int k = 0; k < s->d; k++) trace += r[k];
    for (int k = 0; k < s->size; k++) z[k] = (by->shear * r[k] + (k < s->d ? by->trace * trace : 0)) / volume;
}

/// r = C z
static void resist(const solve *s, size_t row, const tensor z, tensor r)
{
    const scree_state *state = s->c->state;
    const scree_compliance *by = &s->compliance[scree_body_material(state, row)];
    const double volume = scree_stretch_volume(s->d, s->c->model->thickness, state->row[row].radius);
    const double back = by->trace / (by->shear + s->d * by->trace);
    double trace = 0;
    for (int k = 0; k < s->d; k++) trace += z[k];
    for (int k = 0; k < s->size; k++) r[k] = volume * (z[k] - (k < s->d ? back * trace : 0)) / by->shear;
}

static double dot(const solve *s, tensor *a, tensor *b)
{
    for (size_t row = 0; row < s->count; row++) s->term[row] = scree_tensor_product(s->d, a[row], b[row]);
    return scree_comm_sum_of(s->c->state, s->term, s->count);
}

// ---- springs -----------------------------------------------------------------------------------------------------

/// way = w n
static void way_of(int d, const double *w, const double n[3], double way[3])
{
    if (d == 2) {
        way[0] = w[0] * n[0] + w[2] * n[1];
        way[1] = w[2] * n[0] + w[1] * n[1];
        way[2] = 0;
        return;
    }
    way[0] = w[0] * n[0] + w[5] * n[1] + w[4] * n[2];
    way[1] = w[5] * n[0] + w[1] * n[1] + w[3] * n[2];
    way[2] = w[4] * n[0] + w[3] * n[1] + w[2] * n[2];
}

static double expansion(int d, const double *row, const double n[3])
{
    double w[6], way[3];
    scree_tensor_get(d, row, w);
    way_of(d, w, n, way);
    return n[0] * way[0] + n[1] * way[1] + n[2] * way[2];
}

/// Puts a spring behind the others; their room is there.
static void add_spring(solve *s, uint32_t first, uint32_t second, const double n[3], const scree_law_use *use,
                       const scree_pair_constants *constants, double radius, double mass)
{
    const scree_contact_tangent t = scree_law_get(use->law)->tangent(use, constants, radius, mass, 0);
    const bool corrected = use->number[SCREE_LAW_CORRECTED] > 0;
    s->spring[s->spring_count++] = (spring){.first = first,
                                            .second = second,
                                            .normal = {n[0], n[1], n[2]},
                                            .stiffness = {t.normal_stiffness, corrected ? t.tangential_stiffness : 0}};
}

/// A pair that acts at the present stretches.
static void find_pair(solve *s, size_t p)
{
    const scree_state *state = s->c->state;
    const scree_model *model = s->c->model;
    const scree_work *work = s->c->work;
    const uint32_t a = work->pairs.first[p], b = work->pairs.second[p];
    const scree_row *one = &state->row[a], *other = &state->row[b];
    const scree_member_row *own = contact_own_of(work, p);
    double n[3] = {one->x - other->x, one->y - other->y, s->d == 3 ? one->z - other->z : 0};
    const double distance = scree_normalise(n);
    double overlap = one->radius + other->radius - distance + expansion(s->d, scree_stretch_row(state, a), n) +
                     expansion(s->d, scree_stretch_row(state, b), n);
    if (own) overlap -= own->value[SCREE_MEMBER_REST];
    if (!(overlap > 0) && !(own && own->value[SCREE_MEMBER_TENSION] >= 0)) return;
    const int first = scree_body_material(state, a), second = scree_body_material(state, b);
    add_spring(s, scree_parent_row(state, work, a), scree_parent_row(state, work, b), n,
               own ? &model->persistent.law : scree_model_law_between(model, first, second),
               own ? &model->persistent.pairs[first][second] : &model->pairs[first][second],
               one->radius * other->radius / (one->radius + other->radius),
               one->mass * other->mass / (one->mass + other->mass));
}

static void find_plate(solve *s, size_t p)
{
    const scree_state *state = s->c->state;
    const uint32_t row = s->c->work->wall_pairs.body[p];
    const scree_wall *wall = &scree_plates(state)[s->c->work->wall_pairs.wall[p]];
    const int material = scree_body_material(state, row);
    if (!contact_plate_is_there(state, s->c->work, p)) return;
    add_spring(s, row, SCREE_NO_ROW, wall->normal, scree_model_law_on_plate(s->c->model, material),
               &s->c->model->walls[material], state->row[row].radius, state->row[row].mass);
}

/// Elements of the walls of the case, of the body of pair `begin`.
static void find_elements(solve *s, size_t begin, size_t end)
{
    const scree_state *state = s->c->state;
    const scree_work *work = s->c->work;
    const uint32_t row = work->primitive_pairs.body[begin];
    const int material = scree_body_material(state, row);
    primitive_touches touches;
    const contact_body body = contact_body_get(state, row);
    const bodies one = contact_body_lane(s->d, &body);
    contact_primitives_touching(work->wall_set, s->d, &one, &work->primitive_pairs, begin, end, &touches);
    for (int k = 0; k < touches.count; k++) {
        const scree_surface *surface = &work->wall_set->surface[touches.touch[k].surface];
        const scree_pair_constants constants = contact_surface_constants(s->c->model, surface, material);
        add_spring(s, row, SCREE_NO_ROW, touches.touch[k].closest.normal,
                   contact_surface_law(s->c->model, surface, material), &constants, state->row[row].radius,
                   state->row[row].mass);
    }
}

static scree_status find_springs(solve *s, scree_error *error)
{
    const scree_work *work = s->c->work;
    const scree_wall_pair_list *elements = &work->primitive_pairs;
    const size_t most = work->pairs.count + work->wall_pairs.count + elements->count;
    s->spring_count = 0;
    if (most > s->spring_capacity) {
        scree_release(&s->spring);
        s->spring_capacity = 0;
        scree_status status = scree_allocate(&s->spring, most, sizeof *s->spring, error);
        if (status) return status;
        s->spring_capacity = most;
    }
    for (size_t p = 0; p < work->pairs.count; p++) find_pair(s, p);
    for (size_t p = 0; p < work->wall_pairs.count; p++) find_plate(s, p);
    for (size_t begin = 0, end; begin < elements->count; begin = end) {
        end = contact_group_end(elements, begin);
        find_elements(s, begin, end);
    }
    return SCREE_OK;
}

/// Forces with which the springs answer x; returns the largest component.
static double answer(solve *s, tensor *x)
{
    double largest = 0;
    for (size_t k = 0; k < s->spring_count; k++) {
        spring *t = &s->spring[k];
        const double *n = t->normal;
        double way[3], more[3] = {0, 0, 0};
        way_of(s->d, x[t->first], n, way);
        if (t->second != SCREE_NO_ROW) way_of(s->d, x[t->second], n, more);
        for (int i = 0; i < 3; i++) way[i] += more[i];
        const double along = n[0] * way[0] + n[1] * way[1] + n[2] * way[2];
        for (int i = 0; i < 3; i++) {
            t->force[i] = t->stiffness[1] * way[i] + (t->stiffness[0] - t->stiffness[1]) * along * n[i];
            largest = fmax(largest, fabs(t->force[i]));
        }
    }
    return largest;
}

/// y = (C + sum N k N^T) x
static void apply(solve *s, tensor *x, tensor *y)
{
    const scree_tensor_place *place = scree_tensor_places(s->d);
    const double quantum = scree_fixed_quantum(2 * answer(s, x)), inverse = 1 / quantum;
    memset(s->sum, 0, s->count * sizeof *s->sum);
    for (size_t k = 0; k < s->spring_count; k++) {
        const spring *t = &s->spring[k];
        for (int i = 0; i < s->size; i++) {
            const int a = place[i].i, b = place[i].j;
            const int64_t moment =
                scree_fixed_from(0.5 * (t->normal[a] * t->force[b] + t->normal[b] * t->force[a]), inverse);
            s->sum[t->first][i] += moment;
            if (t->second != SCREE_NO_ROW) s->sum[t->second][i] += moment;
        }
    }
    for (size_t row = 0; row < s->count; row++) {
        resist(s, row, x[row], y[row]);
        for (int i = 0; i < s->size; i++) y[row][i] += scree_fixed_to(s->sum[row][i], quantum);
    }
}

/// z = C^-1 r; returns the largest one.
static double precondition(const solve *s, tensor *r, tensor *z)
{
    double largest = 0;
    for (size_t row = 0; row < s->count; row++) {
        yield(s, row, r[row], z[row]);
        const double size = magnitude(s, z[row]);
        largest = size <= largest ? largest : size;
    }
    return largest;
}

/// From the residual to the step; what is left of it is at most `limit` [m]. False: it did not come so far.
static bool find_step(solve *s, double limit)
{
    memset(s->step, 0, s->count * sizeof *s->step);
    double left = precondition(s, s->residual, s->scaled), square = dot(s, s->residual, s->scaled);
    memcpy(s->direction, s->scaled, s->count * sizeof *s->scaled);
    for (int k = 0; k < MOST_PRODUCTS && left > limit; k++) {
        apply(s, s->direction, s->product);
        const double along = square / dot(s, s->direction, s->product);
        for (size_t row = 0; row < s->count; row++)
            for (int i = 0; i < s->size; i++) {
                s->step[row][i] += along * s->direction[row][i];
                s->residual[row][i] -= along * s->product[row][i];
            }
        left = precondition(s, s->residual, s->scaled);
        const double before = square;
        square = dot(s, s->residual, s->scaled);
        for (size_t row = 0; row < s->count; row++)
            for (int i = 0; i < s->size; i++)
                s->direction[row][i] = s->scaled[row][i] + square / before * s->direction[row][i];
    }
    return left <= limit;
}

// ---- the outer loop ----------------------------------------------------------------------------------------------

/// Puts a stretch into the row of a body, with its change since n and its reach.
static void put(int d, const scree_departed *departed, const tensor w, double *row)
{
    const int half = (int)scree_stretch_size(d) / 2;
    for (int k = 0; k < scree_tensor_size(d); k++) {
        const int place = scree_tensor_places(d)[k].row;
        row[place] = w[k];
        row[half + place] = w[k] - departed->stretch[k];
    }
    row[SCREE_STRETCH_REACH] = fmax(scree_tensor_largest(d, w), 0);
}

void scree_implicit_depart(const scree_context *c)
{
    scree_state *state = c->state;
    const int d = state->dimension;
    for (size_t row = 0; row < state->count; row++) {
        scree_departed *departed = &scree_deformation_of(state)->departed[row];
        double *now = scree_stretch_row(state, row);
        tensor w, change;
        scree_tensor_get(d, now, departed->stretch);
        scree_tensor_get(d, now + scree_stretch_size(d) / 2, change);
        scree_stretch_forces(d, state->moment + row * scree_moment_size(d), departed->force);
        for (int k = 0; k < scree_tensor_size(d); k++) {
            departed->force[k] *= state->force_quantum;
            departed->step[k] = 0;
            w[k] = departed->stretch[k] + change[k];
        }
        put(d, departed, w, now);
    }
}

/// Largest reach, change and stretch of all bodies [m].
typedef struct extremes {
    double reach, growth, stretch;
} extremes;

static extremes look(const solve *s)
{
    const scree_state *state = s->c->state;
    double most[3] = {0, 0, 0};
    for (size_t row = 0; row < s->count; row++) {
        const double *now = scree_stretch_row(state, row);
        tensor w, change;
        scree_tensor_get(s->d, now, w);
        scree_tensor_get(s->d, now + scree_stretch_size(s->d) / 2, change);
        const double size[3] = {now[SCREE_STRETCH_REACH], magnitude(s, change), magnitude(s, w)};
        for (int k = 0; k < 3; k++) most[k] = size[k] <= most[k] ? most[k] : size[k];
    }
    scree_comm_maximum(state, most, 3);
    return (extremes){most[0], most[1], most[2]};
}

/// Makes the list and the ghosts fit the present stretches, evaluates the forces, and finds the residual, by its error
/// of a stretch [m].
static scree_status evaluate(solve *s, extremes *now, double *error_of_stretch, scree_error *error)
{
    const scree_context *c = s->c;
    scree_state *state = c->state;
    scree_deformation *all = scree_deformation_of(state);
    *now = look(s);
    if (now->reach > all->largest_reach) c->work->budget -= now->reach - all->largest_reach;
    all->largest_reach = now->reach;
    all->growth = now->growth;
    scree_status status = scree_neighbours_refresh(c->model, state, c->work, error);
    if (!status) status = scree_contact_try(c->model, state, c->work, error);
    if (status) return status;
    for (size_t row = 0; row < s->count; row++) {
        tensor w, back;
        scree_stretch_forces(s->d, state->moment + row * scree_moment_size(s->d), s->residual[row]);
        scree_tensor_get(s->d, scree_stretch_row(state, row), w);
        resist(s, row, w, back);
        for (int k = 0; k < s->size; k++)
            s->residual[row][k] = state->force_quantum * s->residual[row][k] + all->attack[row].force[k] - back[k];
    }
    *error_of_stretch = precondition(s, s->residual, s->scaled);
    scree_comm_maximum(state, error_of_stretch, 1);
    return SCREE_OK;
}

/// Goes by the step, or takes `share` of the last one back.
static void move(solve *s, double share)
{
    scree_state *state = s->c->state;
    for (size_t row = 0; row < s->count; row++) {
        scree_departed *departed = &scree_deformation_of(state)->departed[row];
        double *now = scree_stretch_row(state, row);
        tensor w;
        scree_tensor_get(s->d, now, w);
        for (int k = 0; k < s->size; k++) {
            if (share == 0) departed->step[k] = s->step[row][k];
            w[k] += share == 0 ? departed->step[k] : -share * departed->step[k];
            if (share > 0) departed->step[k] *= 1 - share;
        }
        put(s->d, departed, w, now);
    }
}

/// What integers may leave of a stretch [m], and the rounding of overlaps, which are differences of radii and
/// distances.
static double noise_of(const solve *s)
{
    double softest = 0, largest = 0;
    for (size_t row = 0; row < s->count; row++) {
        const tensor unit = {1, 1, s->d == 3 ? 1 : 0};
        tensor z;
        yield(s, row, unit, z);
        largest = fmax(largest, s->c->state->row[row].radius);
        softest = fmax(softest, magnitude(s, z));
        softest = fmax(softest, s->compliance[scree_body_material(s->c->state, row)].shear /
                                    scree_stretch_volume(s->d, s->c->model->thickness, s->c->state->row[row].radius));
    }
    return fmax(NOISE * s->c->state->force_quantum * softest, DBL_EPSILON * largest);
}

static scree_status iterate(solve *s, double tolerance, scree_stretch_change *change, scree_error *error)
{
    double last = INFINITY, off;
    int halvings = 0;
    for (int k = 0; k < MOST_STEPS; k++) {
        extremes now;
        scree_status status = evaluate(s, &now, &off, error);
        if (status) return status;
        const double limit = fmax(tolerance * fmax(now.stretch, now.growth), noise_of(s));
        *change = (scree_stretch_change){.reach = now.reach, .growth = now.growth};
        if (off <= limit) return SCREE_OK;
        if (off > last && halvings < MOST_HALVINGS) {
            halvings++;
            move(s, 0.5);
            continue;
        }
        last = off;
        halvings = 0;
        status = find_springs(s, error);
        if (status) return status;
        if (!find_step(s, fmax(INNER * limit, 1e-14 * now.stretch))) break;
        move(s, 0);
    }
    return scree_error_set(error, SCREE_ERROR_GUARD,
                           "step %llu: the implicit strains were not found in %d steps, what is left is %.2g m: try a "
                           "smaller time step, a larger contact.deformation_tolerance, or deformation: relaxed; "
                           "dashpots of contacts that open and close jump: take contact.dashpots: loose",
                           (unsigned long long)s->c->state->step, MOST_STEPS, off);
}

scree_status scree_implicit_solve(const scree_context *c, const scree_compliance *compliance, double tolerance,
                                  scree_stretch_change *change, scree_error *error)
{
    scree_state *state = c->state;
    solve s = {.c = c,
               .compliance = compliance,
               .d = state->dimension,
               .size = scree_tensor_size(state->dimension),
               .count = state->count};
    scree_status status = reserve(&s, error);
    if (!status) status = iterate(&s, tolerance, change, error);
    for (size_t row = 0; row < s.count && !status; row++) {
        tensor changed;
        scree_tensor_get(s.d, scree_stretch_row(state, row) + scree_stretch_size(s.d) / 2, changed);
        scree_deformation_of(state)->term[row] =
            0.5 * scree_tensor_product(s.d, scree_deformation_of(state)->departed[row].force, changed);
    }
    release(&s);
    return status;
}
