/// Specimens from plain arrays, and dense matrices that belong to them, made from the equations and not by products.
#ifndef SCREE_TESTS_SPECIMEN_FIXTURE_H
#define SCREE_TESTS_SPECIMEN_FIXTURE_H

#include "testing.h"

#include "base/random.h"
#include "specimen/specimen.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct discs {
    size_t count;
    double (*place)[3];
    double *radius;
    double lattice[3]; ///< m, sides of a rectangular cell; 0: does not repeat
} discs;

static inline discs discs_create(size_t most)
{
    return (discs){.place = calloc(most, sizeof(double[3])), .radius = calloc(most, sizeof(double))};
}

static inline void discs_destroy(discs *d)
{
    free(d->place);
    free(d->radius);
}

static inline void discs_add(discs *d, double x, double y, double z, double radius)
{
    d->place[d->count][0] = x;
    d->place[d->count][1] = y;
    d->place[d->count][2] = z;
    d->radius[d->count++] = radius;
}

/// Rows of discs of radius 1 mm that touch; every other row is shifted by half and has `more` discs more.
static inline discs discs_hexagonal(size_t rows, size_t columns, size_t more)
{
    discs d = discs_create(rows * (columns + more));
    for (size_t row = 0; row < rows; row++)
        for (size_t k = 0; k < columns + row % 2 * more; k++)
            discs_add(&d, 2e-3 * (double)k + (row % 2 ? (more ? -1e-3 : 1e-3) : 0), 1e-3 * sqrt(3) * (double)row, 0,
                      1e-3);
    return d;
}

static inline discs discs_square(size_t rows, size_t columns)
{
    discs d = discs_create(rows * columns);
    for (size_t row = 0; row < rows; row++)
        for (size_t k = 0; k < columns; k++) discs_add(&d, 2e-3 * (double)k, 2e-3 * (double)row, 0, 1e-3);
    return d;
}

/// A lattice with holes, sizes from 0.8 to 1 mm, centres moved by up to 0.1 mm.
static inline discs discs_irregular(int dimension, size_t side)
{
    const size_t layers = dimension == 3 ? side : 1;
    discs d = discs_create(side * side * layers);
    uint64_t k = 0;
    for (size_t i = 0; i < side * side * layers; i++) {
        double r[4];
        for (int j = 0; j < 4; j++) r[j] = scree_random_uniform(3, SCREE_RANDOM_TEST, k++);
        const double row = (double)(i / side % side), shift = dimension == 2 ? fmod(row, 2) : 0;
        discs_add(&d, 2e-3 * ((double)(i % side) + 0.5 * shift) + 2e-4 * (r[0] - 0.5),
                  (dimension == 2 ? 1e-3 * sqrt(3) : 2e-3) * row + 2e-4 * (r[1] - 0.5),
                  dimension == 3 ? 2e-3 * (double)(i / side / side) + 2e-4 * (r[2] - 0.5) : 0, 0.8e-3 + 0.2e-3 * r[3]);
    }
    return d;
}

/// Calls `visit` for all pairs, of images too, closer than the sum of radii times 1 + gap.
typedef void discs_visit(void *user, uint32_t first, uint32_t second, const double branch[3]);
static inline size_t discs_pairs(const discs *d, double gap, discs_visit *visit, void *user)
{
    size_t found = 0;
    for (uint32_t i = 0; i < d->count; i++)
        for (uint32_t j = i; j < d->count; j++)
            for (int image = 0; image < 27; image++) {
                const int shift[3] = {image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1};
                double branch[3], square = 0;
                bool twice = false, beyond = false;
                for (int k = 0; k < 3; k++) {
                    beyond = beyond || (shift[k] && d->lattice[k] == 0);
                    branch[k] = d->place[i][k] - d->place[j][k] - shift[k] * d->lattice[k];
                    square += branch[k] * branch[k];
                }
                // A body and its own image: one of the two.
                if (i == j) twice = image <= 13;
                if (beyond || twice || sqrt(square) > (d->radius[i] + d->radius[j]) * (1 + gap)) continue;
                if (visit) visit(user, i, j, branch);
                found++;
            }
    return found;
}

typedef struct discs_bond {
    scree_specimen *specimen;
    size_t count;
    scree_springs stiffness, damping;
    double scatter; ///< share by which springs differ
} discs_bond;

static inline void discs_join(void *user, uint32_t first, uint32_t second, const double branch[3])
{
    discs_bond *b = user;
    const double factor = 1 + b->scatter * scree_random_uniform(5, SCREE_RANDOM_TEST, b->count);
    scree_specimen_set_contact(b->specimen, b->count++, first, second, branch,
                               (scree_springs){factor * b->stiffness.normal, factor * b->stiffness.tangential},
                               b->damping);
}

/// Bodies of 2000 kg/m3, discs 1 m thick, and all contacts closer than `gap` times the sum of radii.
static inline scree_specimen specimen_of(const discs *d, int dimension, double gap, discs_bond bond)
{
    scree_specimen s;
    scree_error error;
    check(scree_specimen_create(dimension, d->count, discs_pairs(d, gap, NULL, NULL), &s, &error), &error);
    for (size_t k = 0; k < d->count; k++) {
        scree_specimen_set_body(&s, k, d->radius[k], 2000, 1);
        memcpy(s.position[k], d->place[k], sizeof s.position[k]);
    }
    bond.specimen = &s;
    discs_pairs(d, gap, discs_join, &bond);
    double volume = 1;
    for (int k = 0; k < dimension; k++) volume *= d->lattice[k];
    s.extent = volume > 0 ? volume : (double)NAN;
    s.periodic = volume > 0 ? (dimension == 3 ? 7 : 3) : 0;
    return s;
}

static inline void specimen_set_compliance(scree_specimen *s, scree_compliance compliance)
{
    for (size_t k = 0; k < s->body_count; k++) s->compliance[k] = compliance;
}

// ---- dense matrices, by columns ----------------------------------------------------------------------------------

typedef struct dense {
    size_t rows, columns;
    double *value;
} dense;

static inline dense dense_create(size_t rows, size_t columns)
{
    return (dense){rows, columns, calloc(rows * columns + 1, sizeof(double))};
}

static inline double *dense_at(const dense *m, size_t row, size_t column)
{
    return &m->value[column * m->rows + row];
}

/// The matrix of products.
typedef void dense_product(const scree_specimen *s, const double *x, double *y);
static inline dense dense_of(const scree_specimen *s, dense_product *product, size_t rows, size_t columns)
{
    dense m = dense_create(rows, columns);
    double *unit = calloc(columns + 1, sizeof *unit);
    for (size_t k = 0; k < columns; k++) {
        unit[k] = 1;
        product(s, unit, m.value + k * rows);
        unit[k] = 0;
    }
    free(unit);
    return m;
}

static inline dense dense_multiply(const dense *a, const dense *b)
{
    dense c = dense_create(a->rows, b->columns);
    for (size_t j = 0; j < b->columns; j++)
        for (size_t k = 0; k < a->columns; k++) {
            const double factor = *dense_at(b, k, j);
            for (size_t i = 0; i < a->rows && factor != 0; i++) *dense_at(&c, i, j) += *dense_at(a, i, k) * factor;
        }
    return c;
}

static inline dense dense_transpose(const dense *a)
{
    dense b = dense_create(a->columns, a->rows);
    for (size_t i = 0; i < a->rows; i++)
        for (size_t j = 0; j < a->columns; j++) *dense_at(&b, j, i) = *dense_at(a, i, j);
    return b;
}

/// All eigenvalues of a square matrix, which is destroyed.
static inline void dense_eigenvalues(dense *m, double *real, double *imaginary)
{
    double none[1];
    const lapack_int n = (lapack_int)m->rows;
    assert_int_equal(LAPACKE_dgeev(LAPACK_COL_MAJOR, 'N', 'N', n, m->value, n, real, imaginary, none, 1, none, 1), 0);
}

/// Largest magnitude of the eigenvalues.
static inline double dense_radius(const dense *m)
{
    dense copy = dense_create(m->rows, m->columns);
    memcpy(copy.value, m->value, m->rows * m->columns * sizeof *m->value);
    double *real = calloc(m->rows, sizeof *real), *imaginary = calloc(m->rows, sizeof *imaginary), most = 0;
    dense_eigenvalues(&copy, real, imaginary);
    for (size_t k = 0; k < m->rows; k++) most = fmax(most, hypot(real[k], imaginary[k]));
    free(real);
    free(imaginary);
    free(copy.value);
    return most;
}

/// B of M 3.8 for normal springs, from the source's steps: the stress of each particle under a unit force at one
/// contact (2.41), its strain (2.46), the change of each overlap (2.53).
static inline dense dense_force_iteration(const scree_specimen *s)
{
    const size_t n = s->contact_count;
    const int d = s->dimension;
    dense b = dense_create(n, n);
    for (size_t from = 0; from < n; from++)
        for (int side = 0; side < 2; side++) {
            const scree_specimen_contact *c = &s->contact[from];
            const uint32_t body = side ? c->second : c->first;
            if (body == SCREE_SPECIMEN_WALL) continue;
            // Surface point from the centre, and force on this body: both turn round on the other side.
            const double arm = side ? c->reach_second : -c->reach_first, push = side ? -1 : 1;
            double stress[9] = {0}, strain[9];
            for (int i = 0; i < d; i++)
                for (int j = 0; j < d; j++)
                    stress[d * i + j] = arm * c->normal[i] * push * c->normal[j] / s->volume[body];
            scree_compliance_strain(&s->compliance[body], d, stress, strain);
            for (size_t to = 0; to < n; to++)
                for (int end = 0; end < 2; end++) {
                    const scree_specimen_contact *t = &s->contact[to];
                    if ((end ? t->second : t->first) != body) continue;
                    double along = 0;
                    for (int i = 0; i < d; i++)
                        for (int j = 0; j < d; j++) along += t->normal[i] * strain[d * i + j] * t->normal[j];
                    *dense_at(&b, to, from) += t->stiffness.normal * (end ? t->reach_second : t->reach_first) * along;
                }
        }
    return b;
}

#endif
