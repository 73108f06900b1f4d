/// Averages over one element, each by the centres of the grains (R: a grain counts where its centre lies inside) and by
/// their exact parts inside it, and over the whole element as well as over its part inside the sample.
///
/// With the sum over the grains p of the element, V its volume, w_p = 1 or the part of the grain inside:
///     volume_fraction   sum w V_p / V                                                      R 3.4
///     coordination      sum w C_p / sum w, C_p the contacts of p (with walls, too)
///     stress            sum w moment_p / V                tension positive                 R 2.51
///     fabric            sum w V_p sum_c n (x) n / V       n along the levers               R 2.96
///     normals           the same with the normals of the contacts
///     inertia           sum w V_p theta_p / V                                              R 2.92
///     axes              sum e (x) e / number, e the long axis of each grain that has one
///     velocity          sum w m v / sum w m
///     kinetic           - sum w m v' (x) v' / V, v' = v - the mean velocity of the element: the stress of the motion,
///                       which is no part of `stress` (I. Goldhirsch, Granular Matter 12, 239, 2010)
///     fabric_anisotropy largest less smallest principal value of F over tr F
///     fabric_factor     tr F / (volume_fraction coordination), g_2 of R 3.4
/// The trace of the fabric tensor of equal grains is volume_fraction times coordination. theta grows with the fourth
/// power of the size (fifth in 3D) and is weighted by another volume: a few large grains rule it, which is why the mean
/// of e (x) e stands beside it. The printed tensor of inertia has its MINOR axis along the LONG axis of a grain: what
/// is told as `long_axis_angle` is the direction of its smallest principal value. Cost: linear in the grains near the
/// element.
#ifndef SCREE_AVERAGE_FIELDS_H
#define SCREE_AVERAGE_FIELDS_H

#include "average/bins.h"
#include "average/surface.h"

/// Sums over the grains of an element, each by its weight.
typedef struct scree_average_sums {
    double grains, solid, contacts, mass, momentum[3];
    double motion[9]; ///< J, of m v (x) v
    double moment[9], branches[9], normals[9], inertia[9];
    double change[9];     ///< N m, of the moments since an earlier instant, where it is known
    double axes, axis[9]; ///< grains that have a long axis
} scree_average_sums;

typedef struct scree_average_value {
    double volume; ///< m2, m3, of the element
    double inside; ///< 1, the part of it that lies inside the sample
    scree_average_sums centres, parts;
} scree_average_value;

void scree_average_measure(const scree_average_sample *sample, const scree_average_bins *bins,
                           const scree_average_surface *surface, const scree_average_element *element,
                           scree_average_value *value);

/// Which averages are told.
enum {
    SCREE_AVERAGE_DENSITY = 1,
    SCREE_AVERAGE_COORDINATION = 2,
    SCREE_AVERAGE_STRESS = 4,
    SCREE_AVERAGE_FABRIC = 8,
    SCREE_AVERAGE_INERTIA = 16,
    SCREE_AVERAGE_VELOCITY = 32,
    SCREE_AVERAGE_ELASTIC = 64, ///< average/elastic.h
    SCREE_AVERAGE_KINETIC = 128,
    SCREE_AVERAGE_FIELDS = 8
};

/// Names of the fields by bit.
extern const char *const scree_average_field_names[SCREE_AVERAGE_FIELDS + 1];

/// Takes the columns of a table one by one.
typedef void scree_average_sink(void *user, const char *name, const char *unit, double value);

/// Tells all numbers of the fields in the mask but the elastic ones, in an order that depends on dimension and fields
/// alone.
void scree_average_tell(const scree_average_sample *sample, const scree_average_value *value, unsigned fields,
                        scree_average_sink *sink, void *user);

#endif
