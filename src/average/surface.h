/// Where a sample is: its lower and upper surface in columns of half a mean radius, so that the part of an element that
/// lies inside the sample is known, and of a pile its foot and its top.
///
/// The upper surface of a column is the highest point of the outlines of the grains at its middle; the lower one the
/// lowest point of those within a mean diameter of it (what stands below has no voids), and the base where it is not a
/// mean diameter above that. The base is the lowest point where a grain touches what is no body, or the lowest grain.
/// Columns without a grain are outside. The heap is what lies around the highest grain without a gap of more than a
/// mean diameter, as in measure/pile.h. Grains that touch nothing count where they are not above all that do. Up is the
/// last axis.
///
/// Along a direction in which the sample repeats itself the columns fill the cell and go round; all of it is the heap.
/// Where it repeats itself upwards there is no surface: it reaches from face to face of the cell, and all is inside.
///
/// Limits: columns go round along the axes, also in a cell that is sheared in the horizontal plane. Cost: linear in
/// the corners.
#ifndef SCREE_AVERAGE_SURFACE_H
#define SCREE_AVERAGE_SURFACE_H

#include "average/element.h"

typedef struct scree_average_surface {
    int dimension;
    double origin[2], width[2]; ///< m, of the columns
    size_t columns[2];          ///< along x and y; one along y in 2D
    bool round[2];              ///< they go round
    double *bottom, *top;       ///< m, y fastest; NAN: no grain
    double base, highest;       ///< m
    double left, right;         ///< m, ends of the heap along x
    double apex;                ///< m, x of the highest point
    double volume;              ///< m2, m3, of all of it
} scree_average_surface;

/// Of a finished sample. Errors: memory.
scree_status scree_average_surface_find(const scree_average_sample *sample, scree_average_surface *surface,
                                        scree_error *error) SCREE_MUST_USE;
void scree_average_surface_destroy(scree_average_surface *surface);

/// The part of the volume of an element that lies inside, 0 to 1.
double scree_average_surface_part(const scree_average_surface *surface, const scree_average_element *element);

#endif
