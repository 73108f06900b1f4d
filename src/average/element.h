/// Averaging elements: rectangles with sides along the axes, in 3D boxes, and the exact part of each grain inside one.
///
/// Parts are those of areas in 2D and volumes in 3D:
///   disc      sum over the corners of the rectangle of the area left of and below them: exact to round-off
///   polygon   clipped at the four sides (Sutherland and Hodgman 1974), by its corners: exact
///   sphere    cut by sides across one axis: by caps, exact. Else the integral over z of the part of a disc, in pieces
///             between the heights at which the circle of the section begins to meet another side or corner;
///             substituted so that the roots at the ends of the pieces vanish, 12 points of Gauss a half: below 1e-8 of
///             the volume
/// A grain whose circle lies inside or outside costs a comparison.
#ifndef SCREE_AVERAGE_ELEMENT_H
#define SCREE_AVERAGE_ELEMENT_H

#include "average/sample.h"

typedef struct scree_average_element {
    scree_vector low, high; ///< m; in 2D both z are 0
} scree_average_element;

/// The element around a place with these sides [m].
scree_average_element scree_average_element_at(const scree_vector centre, const scree_vector size);

/// m2 in 2D, m3.
double scree_average_element_volume(const scree_average_element *element, int dimension);

/// Whether a place lies inside; a place on a side belongs to the element above it, so that elements that fill space
/// count every grain once.
bool scree_average_element_holds(const scree_average_element *element, int dimension, const scree_vector place);

/// Area of the part of a disc about the origin that lies in x0 < x < x1, y0 < y < y1 [m2].
double scree_average_disc_part(double radius, double x0, double x1, double y0, double y1);

/// Volume of the part of a sphere about the origin that lies between low and high [m3].
double scree_average_sphere_part(double radius, const double low[3], const double high[3]);

/// Area of the part of a convex polygon (counter-clockwise) that lies in the rectangle [m2].
double scree_average_polygon_part(int count, const double (*corner)[2], double x0, double x1, double y0, double y1);

/// The part of a grain that lies in the element, 0 to 1.
double scree_average_part(const scree_average_sample *sample, const scree_average_grain *grain,
                          const scree_average_element *element);

#endif
