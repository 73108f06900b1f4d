/// Static solutions by conjugate gradients, or BiCGSTAB where the operator is not symmetric.
///
/// Unknowns are the motions x and the strains e of the particles together, so that nothing is solved within anything:
///     f = -(D (G x + offset) - D_B L^T e)
///     bodies     G^T f + load = 0
///     particles  V compliance^-1 e + L f = 0
/// With D_B = D, or without tangential springs, these are the conditions for the least of the energy
/// 1/2 q.D q + 1/2 sum V e:compliance^-1:e, q = G x + offset - L^T e: symmetric, and not negative for any stiffness of
/// the contacts, past the limit of explicit schemes as well. As published with k_t > 0 the second block of the first
/// row has k_n alone, and BiCGSTAB (van der Vorst 1992) takes it.
///
/// Motions that stretch nothing (floating bodies, spins without k_t, the specimen as a whole in a periodic cell) are
/// left at zero: the right side has no part in them. Whether forces have one in rigid motions of the whole is looked
/// at first. Scaled by the diagonal. Dot products are free of order (base/integer_sum.h).
///
/// Accuracy: residual below 1e-11 of the load, in the scaled norm. Cost: one product, three (BiCGSTAB: six) dot
/// products an iteration; 300 to 1000 iterations for 5000 discs.
#include "specimen/static.h"

#include "base/integer_sum.h"
#include "base/memory.h"
#include "base/vectors.h"
#include "specimen/eigen.h"

#include <string.h>

#define RESIDUAL 1e-11
/// Share of the energy, and of a load, below which a motion of the whole counts as free, and a load as balanced.
#define FREE 1e-9
enum { MOST_ITERATIONS = 100000, VECTORS = 9 };

typedef struct static_system {
    const scree_specimen *s;
    size_t motions, strains, size;
    bool deformable, symmetric;
    double *diagonal;        ///< its inverse; 0: left at zero
    double *vector[VECTORS]; ///< of the iteration
    double *contact[2];      ///< scratch
    double *terms;           ///< of a dot product
} static_system;

static void destroy(static_system *y)
{
    scree_release(&y->diagonal);
    scree_release(&y->terms);
    for (int k = 0; k < VECTORS; k++) scree_release(&y->vector[k]);
    for (int k = 0; k < 2; k++) scree_release(&y->contact[k]);
}

static scree_status create(static_system *y, const scree_specimen *s, scree_error *error)
{
    *y = (static_system){.s = s, .motions = scree_specimen_motions(s), .deformable = scree_specimen_is_deformable(s)};
    y->strains = y->deformable ? s->body_count * (size_t)s->strain_components : 0;
    y->size = y->motions + y->strains;
    y->symmetric = scree_specimen_has_potential(s);
    scree_status status = scree_allocate(&y->diagonal, y->size, sizeof(double), error);
    if (!status) status = scree_allocate(&y->terms, y->size, sizeof(double), error);
    for (int k = 0; k < VECTORS && !status; k++) status = scree_allocate(&y->vector[k], y->size, sizeof(double), error);
    for (int k = 0; k < 2 && !status; k++)
        status = scree_allocate(&y->contact[k], scree_specimen_contact_forces(s), sizeof(double), error);
    return status;
}

// ---- the operator ------------------------------------------------------------------------------------------------

/// Contact forces with the sign of D q: t = D q - D_B surfaces; q and t may be the same.
static void tension(const scree_specimen *s, const double *q, const double *surfaces, double *t)
{
    const size_t width = (size_t)s->dimension;
    for (size_t c = 0; c < s->contact_count; c++) {
        const scree_specimen_contact *contact = &s->contact[c];
        const scree_springs k = contact->stiffness, answer = scree_specimen_answer(s, contact);
        double back[3] = {0};
        if (surfaces)
            scree_specimen_along(s->dimension, contact, answer.normal, answer.tangential, surfaces + c * width, back);
        scree_specimen_along(s->dimension, contact, k.normal, k.tangential, q + c * width, t + c * width);
        for (size_t i = 0; i < width; i++) t[c * width + i] -= back[i];
    }
}

/// y += V compliance^-1 e
static void add_particles(const scree_specimen *s, const double *e, double *y)
{
    const size_t size = (size_t)s->strain_components;
    for (size_t body = 0; body < s->body_count; body++) {
        const scree_compliance c = s->compliance[body];
        if (!(c.shear > 0)) continue;
        const double all_round = c.trace / (c.shear + s->dimension * c.trace), each = s->volume[body] / c.shear;
        double trace = 0;
        for (int k = 0; k < s->dimension; k++) trace += e[body * size + (size_t)k];
        for (size_t k = 0; k < size; k++)
            y[body * size + k] += each * (e[body * size + k] - (k < (size_t)s->dimension ? all_round * trace : 0));
    }
}

/// Rigid particles among deformable ones do not strain.
static void stiffen(const scree_specimen *s, double *e)
{
    const size_t size = (size_t)s->strain_components;
    for (size_t body = 0; body < s->body_count; body++)
        if (!(s->compliance[body].shear > 0)) memset(e + body * size, 0, size * sizeof *e);
}

/// The two rows of what a tension t of the contacts and the strains e make: motions get G^T t, particles -L t and their
/// own stress.
static void balance(const static_system *y, const double *t, const double *e, double *out)
{
    scree_specimen_gather(y->s, t, out);
    scree_specimen_fix(y->s, out);
    if (!y->deformable) return;
    double *moments = out + y->motions;
    scree_specimen_moments(y->s, t, moments);
    for (size_t k = 0; k < y->strains; k++) moments[k] = -moments[k];
    if (e) add_particles(y->s, e, moments);
    stiffen(y->s, moments);
}

/// out = A in; held components and strains of rigid particles are zero in `in`.
static void apply(const static_system *y, const double *in, double *out)
{
    scree_specimen_relative(y->s, in, y->contact[0]);
    if (y->deformable) scree_specimen_surfaces(y->s, in + y->motions, y->contact[1]);
    tension(y->s, y->contact[0], y->deformable ? y->contact[1] : NULL, y->contact[0]);
    balance(y, y->contact[0], in + y->motions, out);
}

// ---- its diagonal ------------------------------------------------------------------------------------------------

/// Share of one side of a contact in the diagonal of the motions.
static void add_motion_diagonal(const scree_specimen *s, const scree_specimen_contact *c, uint32_t body, double arm,
                                double *diagonal)
{
    double *d = diagonal + body * (size_t)s->components;
    const double normal = c->stiffness.normal, tangential = c->stiffness.tangential;
    for (int k = 0; k < s->dimension; k++) d[k] += tangential + (normal - tangential) * c->normal[k] * c->normal[k];
    if (s->dimension == 2) d[2] += arm * arm * tangential;
    for (int k = 0; k < 3 && s->dimension == 3; k++)
        d[3 + k] += arm * arm * tangential * (1 - c->normal[k] * c->normal[k]);
}

/// The same of the strains: a unit strain moves the surface by z, which D_B answers.
static void add_strain_diagonal(const scree_specimen *s, const scree_specimen_contact *c, uint32_t body, double reach,
                                double *diagonal)
{
    const scree_springs k = scree_specimen_answer(s, c);
    const int d = s->dimension;
    for (int m = 0; m < s->strain_components; m++) {
        double z[3] = {0}, answer[3];
        const int i = d == 2 ? 0 : (m - d + 1) % 3, j = d == 2 ? 1 : (m - d + 2) % 3;
        if (m < d) {
            z[m] = reach * c->normal[m];
        } else {
            z[i] = reach * M_SQRT1_2 * c->normal[j];
            z[j] = reach * M_SQRT1_2 * c->normal[i];
        }
        scree_specimen_along(d, c, k.normal, k.tangential, z, answer);
        for (int n = 0; n < d; n++) diagonal[body * (size_t)s->strain_components + (size_t)m] += z[n] * answer[n];
    }
}

static void add_side_diagonal(const static_system *y, const scree_specimen_contact *c, uint32_t body, double arm,
                              double reach)
{
    add_motion_diagonal(y->s, c, body, arm, y->diagonal);
    if (y->deformable) add_strain_diagonal(y->s, c, body, reach, y->diagonal + y->motions);
}

static void invert_diagonal(static_system *y)
{
    const scree_specimen *s = y->s;
    memset(y->diagonal, 0, y->size * sizeof *y->diagonal);
    for (size_t k = 0; k < s->contact_count; k++) {
        const scree_specimen_contact *c = &s->contact[k];
        add_side_diagonal(y, c, c->first, c->arm_first, c->reach_first);
        if (c->second != SCREE_SPECIMEN_WALL) add_side_diagonal(y, c, c->second, c->arm_second, c->reach_second);
    }
    for (size_t k = 0; k < y->strains; k++) {
        const size_t body = k / (size_t)s->strain_components;
        const scree_compliance c = s->compliance[body];
        const bool normal = (int)(k % (size_t)s->strain_components) < s->dimension;
        const double own = normal ? 1 - c.trace / (c.shear + s->dimension * c.trace) : 1;
        if (c.shear > 0) y->diagonal[y->motions + k] += own * s->volume[body] / c.shear;
    }
    scree_specimen_fix(s, y->diagonal);
    if (y->deformable) stiffen(s, y->diagonal + y->motions);
    for (size_t k = 0; k < y->size; k++) y->diagonal[k] = y->diagonal[k] > 0 ? 1 / y->diagonal[k] : 0;
}

// ---- iterations --------------------------------------------------------------------------------------------------

static double dot(const static_system *y, const double *a, const double *b)
{
    for (size_t k = 0; k < y->size; k++) y->terms[k] = a[k] * b[k];
    return scree_integer_sum_of(y->terms, y->size);
}

/// r . (diagonal^-1) r
static double scaled_square(const static_system *y, const double *r)
{
    for (size_t k = 0; k < y->size; k++) y->terms[k] = r[k] * r[k] * y->diagonal[k];
    return scree_integer_sum_of(y->terms, y->size);
}

static void scale(const static_system *y, const double *r, double *z)
{
    for (size_t k = 0; k < y->size; k++) z[k] = y->diagonal[k] * r[k];
}

/// a += factor b
static void add(const static_system *y, double *a, double factor, const double *b)
{
    for (size_t k = 0; k < y->size; k++) a[k] += factor * b[k];
}

/// r is the right side first, the residual then; x comes out.
static bool conjugate_gradients(static_system *y, double *x, double *r, double target, size_t *iterations)
{
    double *z = y->vector[2], *p = y->vector[3], *image = y->vector[4];
    scale(y, r, z);
    memcpy(p, z, y->size * sizeof *p);
    double square = dot(y, r, z);
    for (*iterations = 0; square > target; ++*iterations) {
        if (*iterations == MOST_ITERATIONS) return false;
        apply(y, p, image);
        const double energy = dot(y, p, image);
        if (!(energy > 0)) return false;
        add(y, x, square / energy, p);
        add(y, r, -square / energy, image);
        scale(y, r, z);
        const double next = dot(y, r, z);
        for (size_t k = 0; k < y->size; k++) p[k] = z[k] + next / square * p[k];
        square = next;
    }
    return true;
}

static bool stabilised_gradients(static_system *y, double *x, double *r, double target, size_t *iterations)
{
    double *shadow = y->vector[2], *p = y->vector[3], *v = y->vector[4], *scaled = y->vector[5], *t = y->vector[6];
    scale(y, r, shadow);
    memset(p, 0, y->size * sizeof *p);
    memset(v, 0, y->size * sizeof *v);
    double rho = 1, alpha = 1, omega = 1, square = scaled_square(y, r);
    for (*iterations = 0; square > target; ++*iterations) {
        if (*iterations == MOST_ITERATIONS) return false;
        const double next = dot(y, shadow, r), beta = next / rho * (alpha / omega);
        rho = next;
        for (size_t k = 0; k < y->size; k++) p[k] = r[k] + beta * (p[k] - omega * v[k]);
        scale(y, p, scaled);
        apply(y, scaled, v);
        alpha = rho / dot(y, shadow, v);
        add(y, x, alpha, scaled);
        add(y, r, -alpha, v);
        scale(y, r, scaled);
        apply(y, scaled, t);
        // In the scaled norm, as the residual.
        double *weighted = y->vector[7];
        scale(y, t, weighted);
        omega = dot(y, weighted, r) / dot(y, weighted, t);
        if (!isfinite(alpha) || !isfinite(omega) || rho == 0) return scaled_square(y, r) <= target;
        add(y, x, omega, scaled);
        add(y, r, -omega, t);
        square = scaled_square(y, r);
    }
    return true;
}

// ---- motions of the whole ----------------------------------------------------------------------------------------

/// Motion number `mode` of the specimen as a whole: translations, then rotations about the middle, by one over `size`.
static void rigid_motion(const scree_specimen *s, int mode, const double middle[3], double size, double *x)
{
    memset(x, 0, scree_specimen_motions(s) * sizeof *x);
    for (size_t body = 0; body < s->body_count; body++) {
        double *u = x + body * (size_t)s->components, spin[3] = {0}, arm[3], turned[3];
        if (mode < s->dimension) {
            u[mode] = 1;
            continue;
        }
        spin[s->dimension == 2 ? 2 : mode - 3] = 1 / size;
        scree_subtract(s->position[body], middle, arm);
        scree_cross(spin, arm, turned);
        for (int k = 0; k < s->dimension; k++) u[k] = turned[k];
        if (s->dimension == 2) u[2] = spin[2];
        for (int k = 0; k < 3 && s->dimension == 3; k++) u[3 + k] = spin[k];
    }
}

/// Middle of the bodies, and the largest distance of one from it, one radius at least.
static double extent_of(const scree_specimen *s, double middle[3])
{
    double size = 0;
    memset(middle, 0, 3 * sizeof *middle);
    for (size_t body = 0; body < s->body_count; body++)
        for (int k = 0; k < 3; k++) middle[k] += s->position[body][k] / (double)s->body_count;
    for (size_t body = 0; body < s->body_count; body++) {
        double arm[3];
        scree_subtract(s->position[body], middle, arm);
        size = fmax(size, fmax(scree_length(arm), s->radius[body]));
    }
    return size;
}

/// Forces of springs against motion `x` of the whole, of walls and of what is held, as if by the stiffest spring.
static void hold_against(static_system *y, const double *x, double stiffest, double *against)
{
    double *moved = y->vector[4];
    memcpy(moved, x, y->motions * sizeof *moved);
    scree_specimen_fix(y->s, moved);
    scree_specimen_stiffness(y->s, moved, against);
    for (size_t k = 0; k < y->motions; k++) against[k] += stiffest * (x[k] - moved[k]);
}

static double motion_dot(const static_system *y, const double *a, const double *b)
{
    for (size_t k = 0; k < y->motions; k++) y->terms[k] = a[k] * b[k];
    return scree_integer_sum_of(y->terms, y->motions);
}

/// Refuses forces that do work in a motion of the whole that nothing resists. modes: how many there are.
static scree_status check_load(static_system *y, const double *force, int modes, scree_error *error)
{
    double matrix[36], values[6], work[6], middle[3], stiffest = 0;
    double *x = y->vector[2], *other = y->vector[3], *against = y->vector[5];
    const double size = extent_of(y->s, middle);
    for (size_t c = 0; c < y->s->contact_count; c++) stiffest = fmax(stiffest, y->s->contact[c].stiffness.normal);
    for (int i = 0; i < modes; i++) {
        rigid_motion(y->s, i, middle, size, x);
        hold_against(y, x, stiffest, against);
        work[i] = motion_dot(y, x, force);
        for (int j = 0; j < modes; j++) {
            rigid_motion(y->s, j, middle, size, other);
            matrix[modes * i + j] = motion_dot(y, other, against);
        }
    }
    scree_status status = scree_eigen_dense((size_t)modes, matrix, values, error);
    const double whole = sqrt(motion_dot(y, force, force));
    for (int i = 0; i < modes && !status; i++) {
        double done = 0;
        for (int j = 0; j < modes; j++) done += matrix[modes * i + j] * work[j];
        if (values[i] > FREE * stiffest || fabs(done) <= FREE * whole) continue;
        status = scree_error_set(error, SCREE_ERROR_INPUT,
                                 "the loads move the specimen as a whole, which nothing holds against them: hold some "
                                 "of its particles, or let the loads balance");
    }
    return status;
}

// ---- the solution ------------------------------------------------------------------------------------------------

/// Right side: loads, and what the offsets do.
static void set_right_side(static_system *y, const scree_static_load *load, double *r)
{
    memset(r, 0, y->size * sizeof *r);
    if (load->offset) {
        tension(y->s, load->offset, NULL, y->contact[0]);
        balance(y, y->contact[0], NULL, r);
        for (size_t k = 0; k < y->size; k++) r[k] = -r[k];
    }
    if (load->force)
        for (size_t k = 0; k < y->motions; k++) r[k] += load->force[k];
    scree_specimen_fix(y->s, r);
    // What nothing resists has no part in the solution.
    for (size_t k = 0; k < y->size; k++) r[k] = y->diagonal[k] > 0 ? r[k] : 0;
}

/// f = -(D (G x + offset) - D_B L^T e)
static void find_forces(static_system *y, const double *x, const double *offset, double *force)
{
    const size_t size = scree_specimen_contact_forces(y->s);
    scree_specimen_relative(y->s, x, y->contact[0]);
    for (size_t k = 0; k < size && offset; k++) y->contact[0][k] += offset[k];
    if (y->deformable) scree_specimen_surfaces(y->s, x + y->motions, y->contact[1]);
    tension(y->s, y->contact[0], y->deformable ? y->contact[1] : NULL, force);
    for (size_t k = 0; k < size; k++) force[k] = -force[k];
}

/// Square of the scaled residual at which the iteration ends. In a lattice the right side is nothing but rounding: the
/// energy of the offsets counts, too.
static double target_of(static_system *y, const scree_static_load *load, const double *r)
{
    const size_t size = scree_specimen_contact_forces(y->s);
    double energy = 0;
    if (load->offset) {
        double *terms = y->contact[0];
        tension(y->s, load->offset, NULL, terms);
        for (size_t k = 0; k < size; k++) terms[k] *= load->offset[k];
        energy = scree_integer_sum_of(terms, size);
    }
    return RESIDUAL * RESIDUAL * (energy + scaled_square(y, r));
}

static scree_status solve(static_system *y, const scree_static_load *load, double *motion, double *force,
                          size_t *iterations, scree_error *error)
{
    double *x = y->vector[0], *r = y->vector[1];
    const int modes = y->s->periodic ? y->s->dimension : y->s->components;
    scree_status status = load->force ? check_load(y, load->force, modes, error) : SCREE_OK;
    if (status) return status;
    invert_diagonal(y);
    set_right_side(y, load, r);
    memset(x, 0, y->size * sizeof *x);
    const double target = target_of(y, load, r);
    bool solved = y->symmetric ? conjugate_gradients(y, x, r, target, iterations)
                               : stabilised_gradients(y, x, r, target, iterations);
    if (!solved)
        return scree_error_set(error, SCREE_ERROR_GUARD,
                               "no static solution was found in %zu iterations: the specimen may have motions that "
                               "nothing resists",
                               *iterations);
    memcpy(motion, x, y->motions * sizeof *motion);
    find_forces(y, x, load->offset, force);
    return SCREE_OK;
}

scree_status scree_static_solve(const scree_specimen *s, const scree_static_load *load, double *motion, double *force,
                                size_t *iterations, scree_error *error)
{
    static_system y;
    size_t count = 0;
    scree_status status = create(&y, s, error);
    if (!status) status = solve(&y, load, motion, force, &count, error);
    if (iterations) *iterations = count;
    destroy(&y);
    return status;
}
