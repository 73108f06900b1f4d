/// Area and displacement gradient of a closed polygon, added up edge by edge (no memory), so that any owner of a loop
/// can use it: the boundary when it closes a strain increment, the measures, the tests.
///
/// Method (Bagi 1996; P 3.1-3.3): the average displacement gradient of the region inside the polygon is
///     G_ij = (1/A) sum_edges (u_i^a + u_i^b)/2 n_j L,
/// n the outward normal and L the length of the edge from a to b. Edges and area are taken at the MID configuration
/// x + u/2. Then exactly, for any polygon and any displacement, trace G = (A_new - A_old) / A_mid; for an affine map
/// x -> F x + c of any polygon G = 2 (F - 1)(F + 1)^-1, which is log F to third order, and a rigid rotation by theta
/// gives the antisymmetric 2 tan(theta/2) alone: no spurious strain.
#ifndef SCREE_MEASURE_POLYGON_H
#define SCREE_MEASURE_POLYGON_H

#include "base/integer_sum.h"

/// Starts from zeros. The edges may come in any order; all of them twice:
/// while (scree_polygon_next(&sum)) for (...) scree_polygon_add_edge(&sum, ...).
typedef struct scree_polygon_sum {
    scree_integer_sum area;        ///< m2, positive counter-clockwise
    scree_integer_sum gradient[4]; ///< m2: xx, xy, yx, yy (d u_row / d x_column)
} scree_polygon_sum;

/// Begins the next pass over the edges; false behind the second (base/integer_sum.h).
static inline bool scree_polygon_next(scree_polygon_sum *sum)
{
    (void)scree_integer_sum_next(&sum->area, 1);
    return scree_integer_sum_next(sum->gradient, 4);
}

/// Adds the edge from a to b [m] whose ends are displaced by ua, ub [m].
void scree_polygon_add_edge(scree_polygon_sum *sum, const double a[2], const double ua[2], const double b[2],
                            const double ub[2]);

/// Divides by the area; zeros when the area is zero.
void scree_polygon_finish(const scree_polygon_sum *sum, double gradient[4]);

#endif
