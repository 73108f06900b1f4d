/// Forces of a uniform pressure on triangles, and on the upright walls between their edges and a plate, as integers
/// that cancel: what hull.c and the sheet of a membrane load.
///
/// A triangle a, b, c gives each of its bodies a third of -p A, A = (a x b + b x c + c x a) / 2 its outward area
/// vector. The wall between its edge a - b and a plate has the horizontal area
///     W = (h_a + h_b) / 2 (a_y - b_y, b_x - a_x),
/// h the heights above the plate (below it negative), and its force goes to a and b as 2 h_a + h_b to h_a + 2 h_b, by
/// the moment of the uniform pressure.
///
/// Conservation. All is built from integers that belong to directed edges and change sign with them: E(a, b) =
/// round(p / 6 a x b / quantum), and for walls 3 E(a, b) + U(a) - U(b) with U(a) = round(p / 2 (a_z - 2 z_plate) a_y
/// / quantum) (and the same with a_x), which is W without remainder. Over a closed surface the E cancel edge by edge
/// and the U corner by corner, to the last bit.
#ifndef SCREE_BOUNDARY_PRESSED_FACET_H
#define SCREE_BOUNDARY_PRESSED_FACET_H

#include "state/state.h"

/// Force [quanta] on each corner of a triangle; `scale` is p / 6 / quantum.
void scree_triangle_press(double scale, scree_vector corner[3], int64_t force[3]);

/// Forces [quanta] on the bodies at a and b of the wall below (above) the edge from a to b, up to the plate at height
/// `plate`; a_first: a is the one of the two that comes first in an order of all bodies, so that what is rounded does
/// not depend on the sense of the edge.
void scree_wall_press(double scale, double plate, const scree_vector a, const scree_vector b, bool a_first,
                      int64_t at_a[3], int64_t at_b[3]);

#endif
