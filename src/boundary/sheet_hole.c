/// Holes of a sheet. In the plane of a triangle the point farthest from its corners is the centre of the circumscribed
/// circle, or, when the triangle is obtuse, where the bisector of a short side meets the longest one; a ball there
/// touches all bodies when its radius is that distance less theirs. At a rim a ball of radius r on the plate passes
/// between two ends of radius R, which touch the plate, at the distance l when (l / 2)^2 + (R - r)^2 > (R + r)^2, so
/// when r < l^2 / (16 R).
#include "boundary/sheet.h"
#include "state/body.h"

#include "boundary/membrane.h"

#include <math.h>

/// Distance of the point of a triangle that is farthest from its corners, from the squares of its sides.
static double farthest_point(double a, double b, double c)
{
    // c the longest.
    double longest = fmax(a, fmax(b, c)), one = longest == a ? b : a, other = longest == c ? b : c;
    double sixteen_areas = 4 * one * longest - (one + longest - other) * (one + longest - other);
    if (one + other > longest) return sqrt(one * other * longest / sixteen_areas);
    // side / (2 cos of its angle with the longest), for the longer of the two.
    double side = fmax(one, other), rest = fmin(one, other);
    return side * sqrt(longest) / (side + longest - rest);
}

static double square_of_edge(const scree_state *state, size_t one, size_t other)
{
    scree_vector a, b;
    scree_membrane_position(state, one, a);
    scree_membrane_position(state, other, b);
    return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]);
}

double scree_sheet_hole(const scree_state *state)
{
    const scree_membrane *membrane = scree_membrane_of(state);
    double hole = 0, radius = membrane->radius;
    for (size_t t = 0; t < scree_sheet_triangle_count(membrane->around, membrane->count); t++) {
        size_t corner[3];
        double square[3];
        scree_sheet_triangle(membrane->around, membrane->count, t, corner);
        for (int c = 0; c < 3; c++) square[c] = square_of_edge(state, corner[c], corner[(c + 1) % 3]);
        hole = fmax(hole, farthest_point(square[0], square[1], square[2]) - radius);
    }
    for (size_t k = 0; k < membrane->count; k++)
        if (scree_membrane_plate(state, k) >= 0) {
            size_t next = scree_sheet_neighbour(membrane->around, membrane->count, k, 0);
            hole = fmax(hole, square_of_edge(state, k, next) / (16 * radius));
        }
    return hole;
}
