/// Limits of explicit schemes by eigenvalues.
///
/// Schemes. Positions at n + 1 from the forces at n (kick, drift); forces at n from positions at n, velocities at n -
/// 1/2 and the strain of the particles that the scheme has at n:
///     M (x+ - 2 x + x-) / dt^2 = G^T f,      f = -D G x - D' G (x - x-) / dt + p
///     rigid p = 0;  explicit p = B f(n-1) (M 3.17);  relaxed p = (1 - theta) p(n-1) + theta B f(n-1);
///     implicit p = B f(n)
/// A mode that changes its sign in every step has p = -share B f (share: scree_strain_scheme). What it obeys is
///     f = share D_B H f + (dt^2/4 D + dt/2 D') A f,     A = G M^-1 G^T                                       (1)
/// and the critical step is the least at which the map on the right has the eigenvalue 1. (Dashpots that do not strain
/// the particles: H acts on f without the part dt/2 D' A f.) Without dashpots, in forms with a potential, every other
/// eigenvalue of the scheme lies inside the unit circle below this step: docs/theory/ddem.md proves it.
///
/// Spectral radius: the largest eigenvalue of W = D_B^(1/2) H D_B^(1/2), symmetric in both tangential forms.
///
/// Rigid: largest eigenvalue of M^(-1/2) (dt^2/4 K + dt/2 C) M^(-1/2), in the space of motions. Symmetric ones: the
/// step at which the Rayleigh quotient of the last mode is 1 is never below the critical one and converges to it
/// quadratically from above (3 to 5 eigenvalues; one without dashpots). Else (dashpots beside deformation; published
/// form with k_t > 0) regula falsi on the eigenvalue of the largest real part.
///
/// Scale. (1) is solved for g with f = S g, S = (dt^2/4 D + dt/2 D')^(1/2), which makes it symmetric where it can be.
/// Cost: 100 to 300 products an eigenvalue, some 0.1 to 0.5 s for 5000 discs.
#include "specimen/stability.h"

#include "base/integer_sum.h"
#include "base/memory.h"
#include "specimen/eigen.h"

#include <string.h>

/// Of eigenvalues; steps go as their roots.
#define ACCURACY 1e-8
/// Of general maps, whose steps are found between two.
#define ACCURACY_BETWEEN 1e-7
/// Of those on the way to a step.
#define COARSE 1e-4
/// Relative change of a step at which its iteration ends: the next one of a quadratic iteration would be its square;
/// regula falsi comes as near as it says.
#define SETTLED 1e-6
/// Part of an eigenvalue below which its mode does not move.
#define STILL 1e-9
/// In the step at which the search begins: nothing moves that is not critical by then.
#define FARTHEST 1e6
enum { MOST_ITERATIONS = 40 };

typedef struct operator_context {
    const scree_specimen *s;
    scree_strain_scheme scheme;
    double step;        ///< s
    double *contact[2]; ///< scratch, contact forces
    double *motion[2];  ///< scratch
} operator_context;

static void destroy(operator_context *o)
{
    for (int k = 0; k < 2; k++) {
        scree_release(&o->contact[k]);
        scree_release(&o->motion[k]);
    }
}

static scree_status create(operator_context *o, const scree_specimen *s, scree_strain_scheme scheme, scree_error *error)
{
    *o = (operator_context){.s = s, .scheme = scheme};
    scree_status status = SCREE_OK;
    for (int k = 0; k < 2 && !status; k++) {
        status = scree_allocate(&o->contact[k], scree_specimen_contact_forces(s), sizeof(double), error);
        if (!status) status = scree_allocate(&o->motion[k], scree_specimen_motions(s), sizeof(double), error);
    }
    return status;
}

// ---- the iteration of forces -------------------------------------------------------------------------------------

/// y = D_B^(1/2) x
static void answer_root(const scree_specimen *s, const double *x, double *y)
{
    const size_t width = (size_t)s->dimension;
    for (size_t c = 0; c < s->contact_count; c++) {
        const scree_springs k = scree_specimen_answer(s, &s->contact[c]);
        scree_specimen_along(s->dimension, &s->contact[c], sqrt(k.normal), sqrt(k.tangential), x + c * width,
                             y + c * width);
    }
}

/// y = H x, over the scratch of the specimen.
static void deform(const scree_specimen *s, const double *x, double *y)
{
    scree_specimen_moments(s, x, s->strain);
    scree_specimen_strain(s, s->strain, s->strain);
    scree_specimen_surfaces(s, s->strain, y);
}

/// y = W x
static void apply_iteration(void *context, const double *x, double *y)
{
    operator_context *o = context;
    answer_root(o->s, x, o->contact[0]);
    deform(o->s, o->contact[0], y);
    answer_root(o->s, y, y);
}

scree_status scree_spectral_radius(const scree_specimen *s, double *radius, double *force, scree_error *error)
{
    operator_context o;
    scree_eigenvalue largest = {0};
    *radius = 0;
    if (!scree_specimen_is_deformable(s)) {
        if (force) memset(force, 0, scree_specimen_contact_forces(s) * sizeof *force);
        return SCREE_OK;
    }
    scree_status status = create(&o, s, scree_strain_rigid(), error);
    const scree_linear_map map = {apply_iteration, &o, scree_specimen_contact_forces(s), true};
    if (!status) status = scree_eigen_largest(&map, ACCURACY, &largest, force, error);
    if (!status && force) answer_root(s, force, force);
    *radius = largest.value;
    destroy(&o);
    return status;
}

double scree_relaxation(double radius)
{
    return floor(0x1p10 / (1 + radius)) * 0x1p-10;
}

// ---- rigid particles ---------------------------------------------------------------------------------------------

/// y = M^(-1/2) x, zero where a component is held.
static void divide_by_root_of_mass(const scree_specimen *s, const double *x, double *y)
{
    size_t at = 0;
    for (size_t body = 0; body < s->body_count; body++)
        for (int k = 0; k < s->components; k++, at++)
            y[at] = x[at] / sqrt(k < s->dimension ? s->mass[body] : s->inertia[body]);
    scree_specimen_fix(s, y);
}

/// y = M^(-1/2) (dt^2/4 K + dt/2 C) M^(-1/2) x
static void apply_rigid(void *context, const double *x, double *y)
{
    operator_context *o = context;
    const double elastic = 0.25 * o->step * o->step, viscous = 0.5 * o->step;
    const size_t size = scree_specimen_motions(o->s);
    divide_by_root_of_mass(o->s, x, o->motion[0]);
    scree_specimen_stiffness(o->s, o->motion[0], y);
    scree_specimen_damping(o->s, o->motion[0], o->motion[1]);
    for (size_t k = 0; k < size; k++) y[k] = elastic * y[k] + viscous * o->motion[1][k];
    divide_by_root_of_mass(o->s, y, y);
}

/// a . b
static double product(double *scratch, const double *a, const double *b, size_t size)
{
    for (size_t k = 0; k < size; k++) scratch[k] = a[k] * b[k];
    return scree_integer_sum_of(scratch, size);
}

/// The step at which the motion x is critical: k dt^2 / 4 + c dt / 2 = m. Over both scratch motions.
static double step_of_motion(operator_context *o, const double *x)
{
    const size_t size = scree_specimen_motions(o->s);
    double *y = o->motion[0], *terms = o->motion[1];
    scree_specimen_stiffness(o->s, x, y);
    const double stiffness = product(terms, x, y, size);
    scree_specimen_damping(o->s, x, y);
    const double damping = product(terms, x, y, size);
    scree_specimen_mass(o->s, x, y);
    const double mass = product(terms, x, y, size);
    return 4 * mass / (damping + sqrt(damping * damping + 4 * stiffness * mass));
}

/// Whether a step is the last one of its iteration; else sees to it that the last ones are accurate.
static bool has_settled(double step, double last, double *accuracy)
{
    const double change = fabs(step - last);
    const bool settled = change <= SETTLED * step && *accuracy == ACCURACY;
    if (change <= 0.01 * step) *accuracy = ACCURACY;
    return settled;
}

/// From above, see the head of this file. x: the mode.
static scree_status find_rigid(operator_context *o, double *step, double *x, scree_error *error)
{
    const scree_linear_map map = {apply_rigid, o, scree_specimen_motions(o->s), true};
    const bool damped = scree_specimen_is_damped(o->s);
    double last = INFINITY, accuracy = damped ? COARSE : ACCURACY;
    // Any step shows the fastest mode of springs; the first guess takes one at which springs and dashpots count alike.
    o->step = scree_step_of_extremes(o->s);
    if (!isfinite(o->step)) o->step = 1;
    for (int k = 0; k < MOST_ITERATIONS; k++) {
        scree_eigenvalue largest;
        scree_status status = scree_eigen_largest(&map, accuracy, &largest, x, error);
        if (status) return status;
        *step = INFINITY;
        if (!(largest.value > 0)) return SCREE_OK;
        divide_by_root_of_mass(o->s, x, x);
        *step = step_of_motion(o, x);
        if (!damped || has_settled(*step, last, &accuracy)) return SCREE_OK;
        last = o->step = *step;
    }
    return scree_error_set(error, SCREE_ERROR_GUARD, "the critical step was not found in %d iterations",
                           MOST_ITERATIONS);
}

// ---- deformable particles ----------------------------------------------------------------------------------------

/// dt^2/4 D + dt/2 D' of a contact.
static scree_springs dynamic(const operator_context *o, const scree_specimen_contact *c)
{
    const double elastic = 0.25 * o->step * o->step, viscous = 0.5 * o->step;
    return (scree_springs){elastic * c->stiffness.normal + viscous * c->damping.normal,
                           elastic * c->stiffness.tangential + viscous * c->damping.tangential};
}

static double over_root(double numerator, double square)
{
    return square > 0 ? numerator / sqrt(square) : 0;
}

/// Part of forces that dashpots make: f -= dt/2 D' a.
static void take_dashpots(const operator_context *o, const double *a, double *f)
{
    const size_t width = (size_t)o->s->dimension;
    for (size_t c = 0; c < o->s->contact_count; c++) {
        const scree_specimen_contact *contact = &o->s->contact[c];
        double part[3];
        scree_specimen_along(o->s->dimension, contact, 0.5 * o->step * contact->damping.normal,
                             0.5 * o->step * contact->damping.tangential, a + c * width, part);
        for (size_t k = 0; k < width; k++) f[c * width + k] -= part[k];
    }
}

/// a = A f, over the scratch motions.
static void mobilise(operator_context *o, const double *f, double *a)
{
    scree_specimen_gather(o->s, f, o->motion[0]);
    scree_specimen_accelerate(o->s, o->motion[0], o->motion[1]);
    scree_specimen_relative(o->s, o->motion[1], a);
}

/// The map of (1) for g, f = S g: y = share S^-1 D_B H f + S A f.
static void apply_deformable(void *context, const double *x, double *y)
{
    operator_context *o = context;
    const scree_specimen *s = o->s;
    const size_t width = (size_t)s->dimension;
    double *f = o->contact[0], *a = o->contact[1];
    for (size_t c = 0; c < s->contact_count; c++) {
        const scree_springs d = dynamic(o, &s->contact[c]);
        scree_specimen_along(s->dimension, &s->contact[c], sqrt(d.normal), sqrt(d.tangential), x + c * width,
                             f + c * width);
    }
    mobilise(o, f, a);
    if (!s->dashpots_strain) take_dashpots(o, a, f);
    deform(s, f, y);
    for (size_t c = 0; c < s->contact_count; c++) {
        const scree_specimen_contact *contact = &s->contact[c];
        const scree_springs d = dynamic(o, contact), k = scree_specimen_answer(s, contact);
        double *z = y + c * width, moved[3];
        scree_specimen_along(s->dimension, contact, o->scheme.share * over_root(k.normal, d.normal),
                             o->scheme.share * over_root(k.tangential, d.tangential), z, z);
        scree_specimen_along(s->dimension, contact, sqrt(d.normal), sqrt(d.tangential), a + c * width, moved);
        for (size_t i = 0; i < width; i++) z[i] += moved[i];
    }
}

static bool has_symmetric_scheme(const scree_specimen *s)
{
    return scree_specimen_has_potential(s) && !scree_specimen_is_damped(s);
}

/// f . A f = g . S A S g of forces g: the part of their Rayleigh quotient that motion has.
static double moved_by(operator_context *o, const double *g)
{
    const scree_specimen *s = o->s;
    const size_t width = (size_t)s->dimension;
    for (size_t c = 0; c < s->contact_count; c++) {
        const scree_springs d = dynamic(o, &s->contact[c]);
        scree_specimen_along(s->dimension, &s->contact[c], sqrt(d.normal), sqrt(d.tangential), g + c * width,
                             o->contact[0] + c * width);
    }
    mobilise(o, o->contact[0], o->contact[1]);
    return product(s->force, o->contact[0], o->contact[1], scree_specimen_contact_forces(s));
}

/// The step at which the Rayleigh quotient of g, of length 1, is 1, from that at the present step: without dashpots the
/// second part goes with its square.
static double step_of_forces(operator_context *o, const double *g, double quotient)
{
    const double moved = moved_by(o, g), deformed = quotient - moved;
    if (deformed >= 1) return 0;
    // A mode in which nothing moves, such as slip without springs: those that do show at a larger step.
    return moved > STILL ? o->step * sqrt((1 - deformed) / moved) : 2 * o->step;
}

/// Where nothing is free to move no step is critical.
static bool is_beyond_all(double step, double first)
{
    return step > FARTHEST * first;
}

static scree_status find_symmetric(operator_context *o, double *g, scree_error *error)
{
    const scree_linear_map map = {apply_deformable, o, scree_specimen_contact_forces(o->s), true};
    const double first = o->step;
    double accuracy = COARSE;
    for (int k = 0; k < MOST_ITERATIONS; k++) {
        scree_eigenvalue largest;
        scree_status status = scree_eigen_largest(&map, accuracy, &largest, g, error);
        if (status) return status;
        const double last = o->step;
        o->step = step_of_forces(o, g, largest.value);
        if (is_beyond_all(o->step, first)) o->step = INFINITY;
        if (o->step == 0 || isinf(o->step) || has_settled(o->step, last, &accuracy)) return SCREE_OK;
    }
    return scree_error_set(error, SCREE_ERROR_GUARD, "the critical step was not found in %d iterations",
                           MOST_ITERATIONS);
}

/// Largest real part of an eigenvalue at a step, less 1: its root is the critical step.
static scree_status excess(operator_context *o, double step, double accuracy, double *value, double *g,
                           scree_error *error)
{
    const scree_linear_map map = {apply_deformable, o, scree_specimen_contact_forces(o->s), false};
    scree_eigenvalue largest;
    o->step = step;
    scree_status status = scree_eigen_largest(&map, accuracy, &largest, g, error);
    *value = largest.value - 1;
    return status;
}

/// Where the eigenvalue would have passed 1 if it went as the square of the step, and a little beyond: the more, the
/// more often it has not.
static double step_across(double step, double value, int attempt)
{
    const double guess = step / sqrt(1 + value), beyond = 1.02 * ldexp(1, attempt);
    return fmin(fmax(value > 0 ? guess / beyond : guess * beyond, 0.1 * step), 10 * step);
}

/// Steps below and above the root, and the excess there.
static scree_status bracket(operator_context *o, double step[2], double value[2], double *g, scree_error *error)
{
    const double first = o->step;
    double at = first;
    bool found[2] = {false, false};
    scree_status status = SCREE_OK;
    for (int k = 0; k < MOST_ITERATIONS && !status && !(found[0] && found[1]); k++) {
        double there;
        status = excess(o, at, COARSE, &there, g, error);
        const int end = there > 0;
        found[end] = true;
        step[end] = at;
        value[end] = there;
        at = step_across(at, there, k);
    }
    if (status || (found[0] && found[1])) return status;
    if (!found[1] && is_beyond_all(at, first)) {
        step[0] = step[1] = o->step = INFINITY;
        return SCREE_OK;
    }
    return scree_error_set(error, SCREE_ERROR_GUARD, "no critical step was found down to %.3g s", at);
}

/// Regula falsi as the Illinois algorithm has it: an end that stays twice counts half.
static scree_status find_between(operator_context *o, double *g, scree_error *error)
{
    double step[2], value[2];
    int last = -1;
    scree_status status = bracket(o, step, value, g, error);
    for (int k = 0; k < MOST_ITERATIONS && !status && step[1] - step[0] > SETTLED * step[1]; k++) {
        const double at = (step[0] * value[1] - step[1] * value[0]) / (value[1] - value[0]);
        double there;
        status = excess(o, at, ACCURACY_BETWEEN, &there, g, error);
        const int end = there > 0;
        if (end == last) value[1 - end] *= 0.5;
        step[end] = at;
        value[end] = there;
        last = end;
        if (fabs(there) <= SETTLED) break;
    }
    return status;
}

/// g holds the mode. With a share of the spectral radius at or above 1 no step is stable.
static scree_status find_deformable(operator_context *o, double *step, double *g, scree_error *error)
{
    *step = 0;
    if (o->scheme.share * o->scheme.radius >= 1) return SCREE_OK;
    scree_status status = has_symmetric_scheme(o->s) ? find_symmetric(o, g, error) : find_between(o, g, error);
    *step = o->step;
    return status;
}

/// Motion of forces g: M^-1 G^T S g.
static void motion_of_forces(operator_context *o, const double *g, double *mode)
{
    const scree_specimen *s = o->s;
    const size_t width = (size_t)s->dimension;
    for (size_t c = 0; c < s->contact_count; c++) {
        const scree_springs d = dynamic(o, &s->contact[c]);
        scree_specimen_along(s->dimension, &s->contact[c], sqrt(d.normal), sqrt(d.tangential), g + c * width,
                             o->contact[0] + c * width);
    }
    scree_specimen_gather(s, o->contact[0], o->motion[0]);
    scree_specimen_accelerate(s, o->motion[0], mode);
}

scree_status scree_critical_step(const scree_specimen *s, scree_strain_scheme scheme, double *step, double *mode,
                                 scree_error *error)
{
    operator_context o;
    double *motion = NULL, *forces = NULL;
    const bool deforms = scheme.share != 0 && scree_specimen_is_deformable(s);
    *step = INFINITY;
    scree_status status = create(&o, s, scheme, error);
    if (!status) status = scree_allocate(&motion, scree_specimen_motions(s), sizeof *motion, error);
    // Where the search begins does not matter; without springs it is the step that dashpots bear.
    o.step = scree_step_of_extremes(s);
    if (!status && (!deforms || isinf(o.step))) status = find_rigid(&o, step, motion, error);
    if (!status && deforms && !(isinf(o.step) && isinf(*step))) {
        if (isinf(o.step)) o.step = *step;
        status = scree_allocate(&forces, scree_specimen_contact_forces(s), sizeof *forces, error);
        if (!status) status = find_deformable(&o, step, forces, error);
        if (!status && *step > 0 && !isinf(*step)) motion_of_forces(&o, forces, motion);
    }
    if (!status && mode) memcpy(mode, motion, scree_specimen_motions(s) * sizeof *mode);
    scree_release(&motion);
    scree_release(&forces);
    destroy(&o);
    return status;
}

// ---- at a given step ---------------------------------------------------------------------------------------------

/// Largest eigenvalue at the step and share of `o`.
static scree_status use_at(operator_context *o, bool deforms, double accuracy, double *use, scree_error *error)
{
    const scree_linear_map rigid = {apply_rigid, o, scree_specimen_motions(o->s), true};
    const scree_linear_map deformable = {apply_deformable, o, scree_specimen_contact_forces(o->s),
                                         has_symmetric_scheme(o->s)};
    scree_eigenvalue largest = {0};
    scree_status status = scree_eigen_largest(deforms ? &deformable : &rigid, accuracy, &largest, NULL, error);
    *use = largest.value;
    return status;
}

scree_status scree_stability_use(const scree_specimen *s, scree_strain_scheme scheme, double step, double *use,
                                 scree_error *error)
{
    operator_context o;
    const bool deforms = scheme.share != 0 && scree_specimen_is_deformable(s);
    scree_status status = create(&o, s, scheme, error);
    o.step = step;
    if (!status) status = use_at(&o, deforms, ACCURACY_BETWEEN, use, error);
    destroy(&o);
    return status;
}

/// Where the map is symmetric: the use is convex in the share, and Newton's iteration with the part that the strains
/// have in the quotient of the last mode comes to the root from above.
static scree_status soften_symmetric(operator_context *o, double share, double *factor, scree_error *error)
{
    const scree_linear_map map = {apply_deformable, o, scree_specimen_contact_forces(o->s), true};
    double *g, accuracy = COARSE;
    scree_status status = scree_allocate(&g, map.size, sizeof *g, error);
    bool settled = false;
    for (int k = 0; k < MOST_ITERATIONS && !status && !settled; k++) {
        scree_eigenvalue largest;
        o->scheme.share = share * *factor;
        status = scree_eigen_largest(&map, accuracy, &largest, g, error);
        if (status) break;
        const double last = *factor, moved = moved_by(o, g);
        *factor *= (1 - moved) / (largest.value - moved);
        settled = has_settled(*factor, last, &accuracy);
    }
    scree_release(&g);
    return status;
}

/// Else by regula falsi as in find_between, between no strains and those that alone reach the limit.
static scree_status soften_between(operator_context *o, double share, double below, double *factor, scree_error *error)
{
    double end[2] = {0, *factor}, value[2] = {below, 0};
    scree_status status = SCREE_OK;
    int last = -1;
    for (int k = 0; k < MOST_ITERATIONS && !status && !(value[1] > 0); k++) {
        end[1] *= 1.02;
        o->scheme.share = share * end[1];
        status = use_at(o, true, COARSE, &value[1], error);
        value[1] -= 1;
    }
    for (int k = 0; k < MOST_ITERATIONS && !status; k++) {
        *factor = (end[0] * value[1] - end[1] * value[0]) / (value[1] - value[0]);
        double there;
        o->scheme.share = share * *factor;
        status = use_at(o, true, ACCURACY_BETWEEN, &there, error);
        const int side = --there > 0;
        if (side == last) value[1 - side] *= 0.5;
        end[side] = *factor;
        value[side] = there;
        last = side;
        if (fabs(there) <= SETTLED || end[1] - end[0] <= SETTLED * end[1]) break;
    }
    return status;
}

scree_status scree_stability_softness(const scree_specimen *s, scree_strain_scheme scheme, double step, double *factor,
                                      scree_error *error)
{
    operator_context o;
    double below = 0;
    *factor = INFINITY;
    if (!(scheme.share > 0 && scheme.radius > 0)) return SCREE_OK;
    scree_status status = create(&o, s, scheme, error);
    o.step = step;
    if (!status) status = use_at(&o, false, ACCURACY_BETWEEN, &below, error);
    *factor = below < 1 ? 1 / (scheme.share * scheme.radius) : 0;
    if (!status && below < 1)
        status = has_symmetric_scheme(s) ? soften_symmetric(&o, scheme.share, factor, error)
                                         : soften_between(&o, scheme.share, below - 1, factor, error);
    destroy(&o);
    return status;
}

// ---- steps of single bodies --------------------------------------------------------------------------------------

double scree_step_of_extremes(const scree_specimen *s)
{
    double mass = INFINITY, stiffness = 0;
    for (size_t body = 0; body < s->body_count; body++) mass = fmin(mass, s->mass[body]);
    for (size_t c = 0; c < s->contact_count; c++)
        stiffness = fmax(stiffness, fmax(s->contact[c].stiffness.normal, s->contact[c].stiffness.tangential));
    return stiffness > 0 ? sqrt(mass / stiffness) : INFINITY;
}

static void add_stiffness(const scree_specimen_contact *c, double *matrix)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            matrix[3 * i + j] += (i == j) * c->stiffness.tangential +
                                 (c->stiffness.normal - c->stiffness.tangential) * c->normal[i] * c->normal[j];
}

scree_status scree_step_of_bodies(const scree_specimen *s, double *step, scree_error *error)
{
    double *matrix, values[3];
    *step = INFINITY;
    scree_status status = scree_allocate(&matrix, 9 * s->body_count, sizeof *matrix, error);
    for (size_t c = 0; c < s->contact_count && !status; c++) {
        const scree_specimen_contact *contact = &s->contact[c];
        add_stiffness(contact, matrix + (size_t)9 * contact->first);
        if (contact->second != SCREE_SPECIMEN_WALL) add_stiffness(contact, matrix + (size_t)9 * contact->second);
    }
    for (size_t body = 0; body < s->body_count && !status; body++) {
        // In 2D nothing moves along z.
        for (int k = 0; k < 3 && s->dimension == 2; k++)
            matrix[9 * body + 6 + (size_t)k] = matrix[9 * body + 3 * (size_t)k + 2] = 0;
        status = scree_eigen_dense(3, matrix + 9 * body, values, error);
        if (!status && values[2] > 0) *step = fmin(*step, 2 * sqrt(s->mass[body] / values[2]));
    }
    scree_release(&matrix);
    return status;
}

double scree_stiffness_ratio(const scree_specimen *s)
{
    double stiffness = 0, modulus = 0, count = 0;
    for (size_t c = 0; c < s->contact_count; c++) stiffness += s->contact[c].stiffness.normal;
    for (size_t body = 0; body < s->body_count; body++) {
        if (!(s->compliance[body].shear > 0)) continue;
        modulus += scree_compliance_modulus(s->condition, s->compliance[body]);
        count++;
    }
    return stiffness / (double)s->contact_count * count / modulus;
}
