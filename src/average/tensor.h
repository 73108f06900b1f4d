/// Tensors of averages: row-major 3 x 3, in 2D all but xx, xy, yx, yy are zero.
#ifndef SCREE_AVERAGE_TENSOR_H
#define SCREE_AVERAGE_TENSOR_H

#include "base/vectors.h"

/// sum += factor a (x) b: row the component of a, column that of b.
static inline void scree_tensor_add(double sum[9], double factor, const double a[3], const double b[3])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) sum[3 * i + j] += factor * a[i] * b[j];
}

/// sum += factor t
static inline void scree_tensor_add_scaled(double sum[9], double factor, const double t[9])
{
    for (int k = 0; k < 9; k++) sum[k] += factor * t[k];
}

/// Principal values of the symmetric part, descending, and their directions as rows; in 2D the third is zero. Jacobi's
/// rotations: to round-off.
void scree_tensor_principal(const double tensor[9], int dimension, double value[3], double direction[9]);

/// What is told of a symmetric tensor whatever the axes.
typedef struct scree_tensor_form {
    double trace;    ///< sum of the principal values
    double deviator; ///< the largest less the smallest of them
    double angle; ///< rad, of the direction of the largest one: with the x axis, counter-clockwise, -pi/2 to pi/2; in
                  ///< 3D its elevation above the plane x, y. NAN where the two largest are the same to round-off
} scree_tensor_form;
scree_tensor_form scree_tensor_form_of(const double tensor[9], int dimension);

/// Inverse of the upper left part of a symmetric positive matrix, dimension x dimension; false: it is singular.
int scree_tensor_invert(const double tensor[9], int dimension, double inverse[9]);

#endif
