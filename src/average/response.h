/// Response of a sample to a load: what it is like loaded less what it was like before, in stresses and in contacts.
///
/// Stress. What a contact transmits is spread along the branch between its two centres (for a wall: from the centre to
/// the point of contact), so that the mean pressure over an element e of volume V is
///     p_ij = sum f_i l_j share / V
/// with f the force on the first grain, l the branch from the second one to it, and `share` the part of the branch that
/// lies in e: the coarse-grained stress with the element as kernel (Goldhirsch, Granul. Matter 12, 239, 2010). Unlike
/// means over whole grains (fields.h) its vertical forces over elements side by side add up, with what goes into walls
/// above them and the weight that sinks past them, to the load on what lies above, to round-off. Compression positive.
/// The response is p of the loaded sample less p of the other (R 5.1), each with its own places.
///
/// Profiles. At a depth y below the top of the loaded grain, elements of side a along x, as hats; a layer and its
/// mirror image about the load are one sample, so peaks are those of the mean of both sides. The height of an element
/// is a, too; where it would reach below the base it stands on it.
///
/// Contacts. They are the same in both samples when both ends are; walls are told apart by their normals. A contact is
/// brought to sliding where it slides in the loaded sample and did not before.
///
/// Source: R = P. Roul, PhD thesis, Magdeburg 2009, 5. In 2D. Cost: linear in the contacts for each element; sorting
/// of the contacts.
#ifndef SCREE_AVERAGE_RESPONSE_H
#define SCREE_AVERAGE_RESPONSE_H

#include "average/element.h"

// ---- contacts ----------------------------------------------------------------------------------------------------

typedef enum scree_response_kind {
    SCREE_RESPONSE_MADE,
    SCREE_RESPONSE_LOST,
    SCREE_RESPONSE_SLIDING
} scree_response_kind;

typedef struct scree_response_change {
    scree_response_kind kind;
    uint32_t first, second; ///< ids; SCREE_AVERAGE_OUTSIDE: what is no body
    scree_vector point;     ///< m
    double before, after;   ///< N, normal force; 0 where there is no contact
} scree_response_change;

typedef struct scree_response_changes {
    scree_response_change *list;
    size_t count, made, lost, sliding;
} scree_response_changes;

/// What became of the contacts of grains that are counted. Free with scree_release(&changes->list). Errors: memory.
scree_status scree_response_compare(const scree_average_sample *before, const scree_average_sample *after,
                                    scree_response_changes *changes, scree_error *error) SCREE_MUST_USE;

/// Re sum |f| exp(6 i angle) / sum |f| over the contacts of two grains: 1 where all forces point along multiples of 60
/// degrees, 0 without an order. normals: of normal forces alone, the order of the contacts.
double scree_response_order(const scree_average_sample *sample, bool normals);

// ---- stress ------------------------------------------------------------------------------------------------------

/// Pressures xx, yy, xy [Pa] over an element, x to the right and y downwards. hat: weights along x fall linearly from 1
/// in its middle to 0 at a side from there, so that what stands upright at the edge of an element makes no jump.
void scree_response_pressure(const scree_average_sample *sample, const scree_average_element *element, bool hat,
                             double pressure[3]);

/// Two samples and where the load is.
typedef struct scree_response {
    const scree_average_sample *before, *after;
    double force;       ///< N, of the load, downwards
    double x, y;        ///< m, where it acts: x of the unloaded, y of the loaded grain
    double top, base;   ///< m, of the layer: of the loaded grain, and of the lowest one
    double left, right; ///< m, ends of the layer
    double side;        ///< m, of the elements
} scree_response;

/// Places the response of a load on the body `id`; side 0: two mean diameters. Errors: SCREE_ERROR_INPUT: there is no
/// such body in both.
scree_status scree_response_open(const scree_average_sample *before, const scree_average_sample *after, uint32_t id,
                                 double side, scree_response *response, scree_error *error) SCREE_MUST_USE;

/// The element at a depth, at x from the load [m].
scree_average_element scree_response_element(const scree_response *response, double depth, double x);

/// Response xx, yy, xy [Pa] over it, as a hat.
void scree_response_at(const scree_response *response, double depth, double x, double pressure[3]);

/// What is missing of the load in what a row of elements and the walls above bear, over the load.
double scree_response_missing(const scree_response *response, double depth);

/// Of the mean of both sides of a profile.
typedef struct scree_response_peak {
    double centre, most; ///< value at the load's x, and the largest
    double place;        ///< m, distance of the largest from the load
    double dip;          ///< 1 - centre / most
    double width;        ///< m, distance from the load beyond which less than half of the largest is found
} scree_response_peak;

/// value: of `count` places x = k gap, k = 0 to count - 1, the mean of both sides. NAN of a value that is none.
scree_response_peak scree_response_find_peak(const double *value, size_t count, double gap);

#endif
