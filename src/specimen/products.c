/// Products of a specimen with motions and forces (specimen.h has the equations).
#include "specimen/specimen.h"

#include "base/vectors.h"

#include <string.h>

// ---- motions and forces ------------------------------------------------------------------------------------------

/// Bits 0 to 2 of what is held are those of x, y, z; in 2D the angle is bit 5.
static bool is_held(const scree_specimen *s, size_t body, int component)
{
    const int bit = s->dimension == 2 && component == 2 ? 5 : component;
    return s->held[body] >> bit & 1;
}

void scree_specimen_fix(const scree_specimen *s, double *x)
{
    for (size_t body = 0; body < s->body_count; body++) {
        if (!s->held[body]) continue;
        for (int k = 0; k < s->components; k++)
            if (is_held(s, body, k)) x[body * (size_t)s->components + (size_t)k] = 0;
    }
}

/// q += sign u + arm w x n, the share of one side; sign 1 of the first, whose arm counts negative, as that of the
/// second does.
static inline void add_side(int dimension, const double *n, double sign, double arm, const double *x, double *q)
{
    if (dimension == 2) {
        q[0] += sign * x[0] + arm * x[2] * n[1];
        q[1] += sign * x[1] - arm * x[2] * n[0];
        return;
    }
    double turned[3];
    scree_cross(x + 3, n, turned);
    for (int k = 0; k < 3; k++) q[k] += sign * x[k] - arm * turned[k];
}

void scree_specimen_relative(const scree_specimen *s, const double *x, double *q)
{
    const size_t size = (size_t)s->components, width = (size_t)s->dimension;
    memset(q, 0, scree_specimen_contact_forces(s) * sizeof *q);
    for (size_t c = 0; c < s->contact_count; c++) {
        const scree_specimen_contact *contact = &s->contact[c];
        add_side(s->dimension, contact->normal, 1, contact->arm_first, x + contact->first * size, q + c * width);
        if (contact->second == SCREE_SPECIMEN_WALL) continue;
        add_side(s->dimension, contact->normal, -1, contact->arm_second, x + contact->second * size, q + c * width);
    }
}

/// Force and torque on one side: sign f, and the torque that its share of q has: both arms turn the same way.
static inline void push_side(int dimension, const double *n, double sign, double arm, const double *f, double *on)
{
    if (dimension == 2) {
        on[0] += sign * f[0];
        on[1] += sign * f[1];
        on[2] -= arm * (n[0] * f[1] - n[1] * f[0]);
        return;
    }
    double couple[3];
    scree_cross(n, f, couple);
    for (int k = 0; k < 3; k++) {
        on[k] += sign * f[k];
        on[3 + k] -= arm * couple[k];
    }
}

void scree_specimen_gather(const scree_specimen *s, const double *f, double *on)
{
    const size_t size = (size_t)s->components, width = (size_t)s->dimension;
    memset(on, 0, scree_specimen_motions(s) * sizeof *on);
    for (size_t c = 0; c < s->contact_count; c++) {
        const scree_specimen_contact *contact = &s->contact[c];
        push_side(s->dimension, contact->normal, 1, contact->arm_first, f + c * width, on + contact->first * size);
        if (contact->second == SCREE_SPECIMEN_WALL) continue;
        push_side(s->dimension, contact->normal, -1, contact->arm_second, f + c * width, on + contact->second * size);
    }
}

// ---- springs and dashpots ----------------------------------------------------------------------------------------

/// x without what is held.
static const double *free_motion(const scree_specimen *s, const double *x)
{
    memcpy(s->motion, x, scree_specimen_motions(s) * sizeof *x);
    scree_specimen_fix(s, s->motion);
    return s->motion;
}

/// y = G^T (springs) G x
static void resist(const scree_specimen *s, bool dashpots, const double *x, double *y)
{
    const size_t width = (size_t)s->dimension;
    scree_specimen_relative(s, free_motion(s, x), s->force);
    for (size_t c = 0; c < s->contact_count; c++) {
        const scree_specimen_contact *contact = &s->contact[c];
        const scree_springs *springs = dashpots ? &contact->damping : &contact->stiffness;
        double *q = s->force + c * width;
        scree_specimen_along(s->dimension, contact, springs->normal, springs->tangential, q, q);
    }
    scree_specimen_gather(s, s->force, y);
    scree_specimen_fix(s, y);
}

void scree_specimen_stiffness(const scree_specimen *s, const double *x, double *y)
{
    resist(s, false, x, y);
}

void scree_specimen_damping(const scree_specimen *s, const double *x, double *y)
{
    resist(s, true, x, y);
}

void scree_specimen_mass(const scree_specimen *s, const double *x, double *y)
{
    size_t at = 0;
    for (size_t body = 0; body < s->body_count; body++)
        for (int k = 0; k < s->components; k++, at++)
            y[at] = is_held(s, body, k) ? 0 : x[at] * (k < s->dimension ? s->mass[body] : s->inertia[body]);
}

void scree_specimen_accelerate(const scree_specimen *s, const double *x, double *y)
{
    size_t at = 0;
    for (size_t body = 0; body < s->body_count; body++)
        for (int k = 0; k < s->components; k++, at++)
            y[at] = is_held(s, body, k) ? 0 : x[at] / (k < s->dimension ? s->mass[body] : s->inertia[body]);
}

void scree_specimen_forces(const scree_specimen *s, const double *x, double *f)
{
    const size_t width = (size_t)s->dimension;
    scree_specimen_relative(s, free_motion(s, x), f);
    for (size_t c = 0; c < s->contact_count; c++) {
        const scree_springs *k = &s->contact[c].stiffness;
        scree_specimen_along(s->dimension, &s->contact[c], -k->normal, -k->tangential, f + c * width, f + c * width);
    }
}

// ---- deformation of particles ------------------------------------------------------------------------------------

/// m += R sym(n f), off-diagonal components times sqrt 2, so that the product of two tensors is that of the numbers.
static inline void add_moment(int dimension, const double *n, double reach, const double *f, double *m)
{
    for (int k = 0; k < dimension; k++) m[k] += reach * n[k] * f[k];
    if (dimension == 2) {
        m[2] += reach * M_SQRT1_2 * (n[0] * f[1] + n[1] * f[0]);
        return;
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        m[3 + k] += reach * M_SQRT1_2 * (n[i] * f[j] + n[j] * f[i]);
    }
}

void scree_specimen_moments(const scree_specimen *s, const double *f, double *moment)
{
    const size_t size = (size_t)s->strain_components, width = (size_t)s->dimension;
    memset(moment, 0, s->body_count * size * sizeof *moment);
    for (size_t c = 0; c < s->contact_count; c++) {
        const scree_specimen_contact *contact = &s->contact[c];
        add_moment(s->dimension, contact->normal, contact->reach_first, f + c * width, moment + contact->first * size);
        if (contact->second == SCREE_SPECIMEN_WALL) continue;
        add_moment(s->dimension, contact->normal, contact->reach_second, f + c * width,
                   moment + contact->second * size);
    }
}

void scree_specimen_strain(const scree_specimen *s, const double *moment, double *strain)
{
    const size_t size = (size_t)s->strain_components;
    for (size_t body = 0; body < s->body_count; body++) {
        const double *m = moment + body * size, each = 1 / s->volume[body];
        double *e = strain + body * size, trace = 0;
        for (int k = 0; k < s->dimension; k++) trace += m[k];
        for (size_t k = 0; k < size; k++) {
            const double all_round = k < (size_t)s->dimension ? s->compliance[body].trace * trace : 0;
            e[k] = each * (s->compliance[body].shear * m[k] + all_round);
        }
    }
}

/// z += R (strain n)
static inline void add_surface(int dimension, const double *n, double reach, const double *e, double *z)
{
    for (int k = 0; k < dimension; k++) z[k] += reach * e[k] * n[k];
    if (dimension == 2) {
        z[0] += reach * M_SQRT1_2 * e[2] * n[1];
        z[1] += reach * M_SQRT1_2 * e[2] * n[0];
        return;
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        z[i] += reach * M_SQRT1_2 * e[3 + k] * n[j];
        z[j] += reach * M_SQRT1_2 * e[3 + k] * n[i];
    }
}

void scree_specimen_surfaces(const scree_specimen *s, const double *strain, double *surface)
{
    const size_t size = (size_t)s->strain_components, width = (size_t)s->dimension;
    memset(surface, 0, scree_specimen_contact_forces(s) * sizeof *surface);
    for (size_t c = 0; c < s->contact_count; c++) {
        const scree_specimen_contact *t = &s->contact[c];
        add_surface(s->dimension, t->normal, t->reach_first, strain + t->first * size, surface + c * width);
        if (t->second == SCREE_SPECIMEN_WALL) continue;
        add_surface(s->dimension, t->normal, t->reach_second, strain + t->second * size, surface + c * width);
    }
}

void scree_specimen_force_iteration(const scree_specimen *s, const double *f, double *g)
{
    const size_t width = (size_t)s->dimension;
    scree_specimen_moments(s, f, s->strain);
    scree_specimen_strain(s, s->strain, s->strain);
    scree_specimen_surfaces(s, s->strain, g);
    for (size_t c = 0; c < s->contact_count; c++) {
        const scree_springs k = scree_specimen_answer(s, &s->contact[c]);
        scree_specimen_along(s->dimension, &s->contact[c], -k.normal, -k.tangential, g + c * width, g + c * width);
    }
}
