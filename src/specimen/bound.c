/// A bound of how much of its limits of stability a specimen uses, from single bodies.
///
/// Both parts of a contact's displacement are squared apart, (a + b)^2 <= 2 a^2 + 2 b^2, so no mode of the specimen has
/// a larger eigenvalue than the largest one that a body has alone, among standing ones, with its contacts counted twice
/// (those with a wall once):
///     motions    2 sum G^T (dt^2/4 D + dt/2 D') G over the mass of the body           M 2.18 with the factor 2
///     strains    2 sum S^(1/2) L D_B L^T S^(1/2) / V, times the share of the scheme    stability.h
/// Unbounded lattices reach both (docs/theory/ddem.md). The sum of the two bounds the eigenvalue of (1) in stability.c
/// where its map is symmetric: particles are rigid, or the form has a potential and no dashpot acts. Else there is no
/// bound. Cost: an eigenvalue of 3 x 3 (6 x 6 in space) twice a body, some ms for 5000 discs.
#include "specimen/stability.h"

#include "base/memory.h"
#include "base/vectors.h"
#include "specimen/eigen.h"

enum { MOST = 6 }; ///< components of a body

/// What a contact does to one of its bodies.
typedef struct side {
    const scree_specimen_contact *contact;
    double sign, arm, reach, twice;
} side;

static side side_of(const scree_specimen_contact *c, bool first)
{
    const bool alone = c->second == SCREE_SPECIMEN_WALL;
    return (side){c, first ? 1 : -1, first ? c->arm_first : c->arm_second, first ? c->reach_first : c->reach_second,
                  alone ? 1 : 2};
}

/// z = G e of the component `k` of a body.
static void move(const scree_specimen *s, const side *at, int k, double z[3])
{
    const double *n = at->contact->normal;
    for (int i = 0; i < 3; i++) z[i] = 0;
    if (k < s->dimension) {
        z[k] = at->sign;
        return;
    }
    // -a w x n, w about z in the plane.
    double w[3] = {0, 0, 0}, turned[3];
    w[s->dimension == 3 ? k - 3 : 2] = 1;
    scree_cross(w, n, turned);
    for (int i = 0; i < 3; i++) z[i] = -at->arm * turned[i];
}

/// Adds to the matrix of a body, size x size, what a contact adds to it along these directions.
static void add(int dimension, const side *at, scree_springs k, int size, double direction[MOST][3], double *matrix)
{
    for (int i = 0; i < size; i++) {
        double answer[3];
        scree_specimen_along(3, at->contact, at->twice * k.normal, at->twice * k.tangential, direction[i], answer);
        for (int j = 0; j < size; j++)
            for (int c = 0; c < dimension; c++) matrix[size * i + j] += answer[c] * direction[j][c];
    }
}

static void add_motion(const scree_specimen *s, const side *at, double step, double *matrix)
{
    const scree_springs k = at->contact->stiffness, c = at->contact->damping;
    const double elastic = 0.25 * step * step, viscous = 0.5 * step;
    double direction[MOST][3];
    for (int i = 0; i < s->components; i++) move(s, at, i, direction[i]);
    add(s->dimension, at,
        (scree_springs){elastic * k.normal + viscous * c.normal, elastic * k.tangential + viscous * c.tangential},
        s->components, direction, matrix);
}

/// L^T of the strain components: the way R e n of the surface under each, those off the diagonal over sqrt 2.
static void add_strain(const scree_specimen *s, const side *at, double *matrix)
{
    const double *n = at->contact->normal;
    double direction[MOST][3] = {{0}};
    for (int k = 0; k < s->dimension; k++) direction[k][k] = at->reach * n[k];
    for (int k = s->dimension; k < s->strain_components; k++) {
        const int i = s->dimension == 2 ? 0 : (k + 1) % 3, j = s->dimension == 2 ? 1 : (k + 2) % 3;
        direction[k][i] = at->reach * M_SQRT1_2 * n[j];
        direction[k][j] = at->reach * M_SQRT1_2 * n[i];
    }
    add(s->dimension, at, scree_specimen_answer(s, at->contact), s->strain_components, direction, matrix);
}

/// matrix = scale (S matrix S), S = M^(-1/2) of a body, zero where a component is held.
static void weigh_motion(const scree_specimen *s, size_t body, double *matrix)
{
    const int size = s->components;
    double root[MOST];
    for (int k = 0; k < size; k++) {
        const int bit = k < s->dimension ? k : s->dimension == 3 ? k : 5;
        root[k] = s->held[body] >> bit & 1 ? 0 : 1 / sqrt(k < s->dimension ? s->mass[body] : s->inertia[body]);
    }
    for (int i = 0; i < size; i++)
        for (int j = 0; j < size; j++) matrix[size * i + j] *= root[i] * root[j];
}

/// The same with the root of compliance over volume: shear + trace t t, t the unit tensor.
static void weigh_strain(const scree_specimen *s, size_t body, double *matrix)
{
    const int size = s->strain_components, d = s->dimension;
    const scree_compliance by = s->compliance[body];
    const double shear = sqrt(by.shear / s->volume[body]);
    const double trace = (sqrt((by.shear + d * by.trace) / s->volume[body]) - shear) / d;
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < size; i++) {
            // Rows, then columns: entry k of line i.
            const int first = pass ? size * i : i, stride = pass ? 1 : size;
            double sum = 0;
            for (int k = 0; k < d; k++) sum += matrix[first + stride * k];
            for (int k = 0; k < size; k++) {
                double *entry = &matrix[first + stride * k];
                *entry = shear * *entry + (k < d ? trace * sum : 0);
            }
        }
}

/// Largest eigenvalue over the bodies. matrices: size x size a body.
static scree_status largest_of(const scree_specimen *s, int size, double *matrices,
                               void (*weigh)(const scree_specimen *, size_t, double *), double *largest,
                               scree_error *error)
{
    double values[MOST];
    scree_status status = SCREE_OK;
    *largest = 0;
    for (size_t body = 0; body < s->body_count && !status; body++) {
        double *matrix = matrices + body * (size_t)(size * size);
        weigh(s, body, matrix);
        status = scree_eigen_dense((size_t)size, matrix, values, error);
        *largest = fmax(*largest, values[size - 1]);
    }
    return status;
}

static scree_status bound_of_motions(const scree_specimen *s, double step, double *bound, scree_error *error)
{
    const size_t size = (size_t)(s->components * s->components);
    double *matrices;
    scree_status status = scree_allocate(&matrices, s->body_count * size, sizeof *matrices, error);
    if (status) return status;
    for (size_t c = 0; c < s->contact_count; c++)
        for (int k = 0; k < (s->contact[c].second == SCREE_SPECIMEN_WALL ? 1 : 2); k++) {
            const side at = side_of(&s->contact[c], k == 0);
            add_motion(s, &at, step, matrices + size * (k ? s->contact[c].second : s->contact[c].first));
        }
    status = largest_of(s, s->components, matrices, weigh_motion, bound, error);
    scree_release(&matrices);
    return status;
}

scree_status scree_radius_bound(const scree_specimen *s, double *bound, scree_error *error)
{
    const size_t size = (size_t)(s->strain_components * s->strain_components);
    double *matrices;
    *bound = 0;
    if (!scree_specimen_is_deformable(s)) return SCREE_OK;
    scree_status status = scree_allocate(&matrices, s->body_count * size, sizeof *matrices, error);
    if (status) return status;
    for (size_t c = 0; c < s->contact_count; c++)
        for (int k = 0; k < (s->contact[c].second == SCREE_SPECIMEN_WALL ? 1 : 2); k++) {
            const side at = side_of(&s->contact[c], k == 0);
            add_strain(s, &at, matrices + size * (k ? s->contact[c].second : s->contact[c].first));
        }
    status = largest_of(s, s->strain_components, matrices, weigh_strain, bound, error);
    scree_release(&matrices);
    return status;
}

scree_status scree_stability_bound(const scree_specimen *s, double share, double step, double *bound,
                                   scree_error *error)
{
    const bool deforms = share != 0 && scree_specimen_is_deformable(s);
    double strains = 0;
    *bound = INFINITY;
    if (deforms && (!scree_specimen_has_potential(s) || scree_specimen_is_damped(s))) return SCREE_OK;
    scree_status status = bound_of_motions(s, step, bound, error);
    if (!status && deforms) status = scree_radius_bound(s, &strains, error);
    // Strains that are solved for only soften.
    *bound += fmax(share, 0) * strains;
    return status;
}
