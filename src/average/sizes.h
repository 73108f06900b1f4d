/// How many grains make an average: elements of growing size about one place, R's representative volume element.
///
/// The elements are squares (cubes) about a place on the axis at 0.33 of the height, "in the centre and near the
/// bottom" (R 2.7, fig. 2.8 - 2.10), so that a field that changes linearly has the same mean in all of them. One whose
/// side is more than 0.66 of the height, or of a width, reaches out of the sample or nearly so: its row has no numbers.
///
/// Of one sample, T(n) the stress, the strain (Cundall) or the fabric tensor over n grains, |T|^2 = T : T:
///     rve_T_small   |T(20) - T(10)| / |T(20)|
///     rve_T_large   |T(200) - T(100)| / |T(200)|          R: 100 to 200 grains are enough
///     rve_T_grains  the least size, of a series by factors of 2^(1/2), from which on T stays within 10 % of that of
///     the
///                   largest one
/// Of several samples, var the sum over the components of T of the variance over the samples, at the same place:
///     scatter       (var T(n) / mean T(n) : mean T(n))^(1/2), with the interval of chi square as if it had one degree
///                   of freedom a sample less one
///     exponent      p in var ~ n^-p, least squares in logarithms over sizes up to 200; 1 where grains are independent.
///                   Its interval is that of the jackknife over samples
///
/// Source: P. Roul, PhD thesis, Magdeburg 2009, 2.7. Cost: that of the elements.
#ifndef SCREE_AVERAGE_SIZES_H
#define SCREE_AVERAGE_SIZES_H

#include "average/cuts.h"

/// Tensors that are looked at.
typedef enum scree_average_sized {
    SCREE_AVERAGE_SIZED_STRESS,
    SCREE_AVERAGE_SIZED_STRAIN,
    SCREE_AVERAGE_SIZED_FABRIC,
    SCREE_AVERAGE_SIZED
} scree_average_sized;
extern const char *const scree_average_sized_names[SCREE_AVERAGE_SIZED];

/// Rows of the sizes of the plan: size [grains at the mean density], side [m], and the fields. Errors: memory.
scree_status scree_average_sizes_table(const scree_average_view *view, const scree_average_plan *plan,
                                       scree_average_table *table, scree_error *error) SCREE_MUST_USE;

/// Tells the numbers of one sample.
void scree_average_sizes_tell(const scree_average_view *view, scree_average_sink *sink, void *user);

/// Rows of the sizes of several samples (tables of the first kind): size, and of each tensor the scatter with both ends
/// of its interval; NAN with fewer than three samples. Errors: memory.
scree_status scree_average_sizes_scatter(const scree_average_table *sizes, size_t count, scree_average_table *scatter,
                                         scree_error *error) SCREE_MUST_USE;

/// The exponent of one tensor with its interval; NAN with fewer than three samples or sizes.
void scree_average_sizes_exponent(const scree_average_table *sizes, size_t count, scree_average_sized tensor,
                                  double *exponent, double *low, double *high);

#endif
