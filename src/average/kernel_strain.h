/// Smooth displacements and their gradients between two instants: at each point the affine motion u(X) = U + G (X - r)
/// that minimises
///     sum_p m_p phi(r - x_p) (u_p - u(X_p))^2
/// over the grains p whose centres x_p (at the end) lie within the support of the kernel phi (average/kernel.h); X_p is
/// where they were, r the point: moving least squares, so affine motions of any size are found exactly. The gradient of
/// the mean displacement sum m u phi / sum m phi (I. Goldhirsch 2010) is not: its grains lie unevenly about the point.
/// NAN where fewer grains are near than a gradient needs, or all lie on a line. Units: SI. Cost: grains x points within
/// w.
#ifndef SCREE_AVERAGE_KERNEL_STRAIN_H
#define SCREE_AVERAGE_KERNEL_STRAIN_H

#include "average/kernel.h"

/// displacement: dimension a point [m]; gradient: 9 a point, row the displacement. Both are filled. Errors: memory.
scree_status scree_average_kernel_strain_find(const scree_average_sample *sample, double width,
                                              const scree_average_points *points, double *displacement,
                                              double (*gradient)[9], scree_error *error) SCREE_MUST_USE;

#endif
