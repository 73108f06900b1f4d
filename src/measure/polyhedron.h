/// Volume and displacement gradient of a closed polyhedron, added up triangle by triangle (no memory): the counterpart
/// of polygon.h in three dimensions.
///
/// Method (Bagi 1996; P 3.1-3.3): the average displacement gradient of the region inside is
///     G_ij = (1/V) sum_triangles (u_i^a + u_i^b + u_i^c)/3 A_j,
/// A the outward area vector. While the corners move from x to x + u, A is a quadratic function of the way, and its
/// mean over it is A = (A_0 + 4 A_1/2 + A_1) / 6 (Simpson, exact). With that A and V at the MID configuration x + u/2
/// follows exactly, for any polyhedron and any displacement, trace G = (V_new - V_old) / V_mid, since dV = sum u . A;
/// for an affine map F, G = log F to third order in F - 1; and a rigid rotation R gives the antisymmetric part alone,
/// (R - R^T) and 2 (R - 1)(R + 1)^-1 in its two parts: no spurious strain.
#ifndef SCREE_MEASURE_POLYHEDRON_H
#define SCREE_MEASURE_POLYHEDRON_H

#include "base/integer_sum.h"

/// Starts from zeros. The triangles may come in any order; all of them twice:
/// while (scree_polyhedron_next(&sum)) for (...) scree_polyhedron_add(&sum, ...).
typedef struct scree_polyhedron_sum {
    scree_integer_sum volume;      ///< m3
    scree_integer_sum gradient[9]; ///< m3: row-major, d u_row / d x_column
} scree_polyhedron_sum;

/// Begins the next pass over the triangles; false behind the second (base/integer_sum.h).
static inline bool scree_polyhedron_next(scree_polyhedron_sum *sum)
{
    (void)scree_integer_sum_next(&sum->volume, 1);
    return scree_integer_sum_next(sum->gradient, 9);
}

/// Adds the triangle with corners x [m], counter-clockwise seen from outside, that are displaced by u [m].
void scree_polyhedron_add(scree_polyhedron_sum *sum, double x[3][3], double u[3][3]);

/// Divides by the volume; zeros when the volume is zero.
void scree_polyhedron_finish(const scree_polyhedron_sum *sum, double gradient[9]);

#endif
