/// Row-major 3 x 3 matrices and vectors of three. In 2D the third row and column are those of the unit matrix, so that
/// determinants and inverses are those of the plane.
#ifndef SCREE_BASE_MATRIX_H
#define SCREE_BASE_MATRIX_H

#include <math.h>

static inline void scree_matrix_unit(double m[9])
{
    for (int k = 0; k < 9; k++) m[k] = k % 4 == 0;
}

/// c = a b; c may be neither.
static inline void scree_matrix_multiply(const double a[9], const double b[9], double c[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) c[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
}

/// w = m v; w is not v.
static inline void scree_matrix_apply(const double m[9], const double v[3], double w[3])
{
    for (int i = 0; i < 3; i++) w[i] = m[3 * i] * v[0] + m[3 * i + 1] * v[1] + m[3 * i + 2] * v[2];
}

/// The first `dimension` components of it, where the others of v are zero: those of a plane need no more. For loops
/// over bodies, in which the dimension is a constant.
static inline __attribute__((always_inline)) void scree_matrix_apply_in(int dimension, const double m[9],
                                                                        const double v[3], double w[3])
{
    for (int i = 0; i < dimension; i++) {
        w[i] = m[3 * i] * v[0] + m[3 * i + 1] * v[1];
        if (dimension == 3) w[i] += m[3 * i + 2] * v[2];
    }
}

/// b = unit + factor a; b may be a.
static inline void scree_matrix_unit_plus(double factor, const double a[9], double b[9])
{
    for (int k = 0; k < 9; k++) b[k] = (k % 4 == 0) + factor * a[k];
}

static inline double scree_matrix_determinant(const double m[9])
{
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
}

/// By cofactors; meaningless for a singular matrix. inverse is not m.
static inline void scree_matrix_invert(const double m[9], double inverse[9])
{
    double factor = 1 / scree_matrix_determinant(m);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            inverse[3 * i + j] = factor * (m[3 * a + c] * m[3 * b + d] - m[3 * a + d] * m[3 * b + c]);
        }
}

/// sum of a_ij b_ij
static inline double scree_matrix_contract(const double a[9], const double b[9])
{
    double sum = 0;
    for (int k = 0; k < 9; k++) sum += a[k] * b[k];
    return sum;
}

/// Root of the sum of squares: a bound of how much the matrix stretches any vector.
static inline double scree_matrix_norm(const double m[9])
{
    return sqrt(scree_matrix_contract(m, m));
}

#endif
