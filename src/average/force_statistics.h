/// Statistics of contact forces: their distribution, mobilised friction, and roses of contacts and forces.
///
/// n is a force over the mean of its kind:
///     contacts   normal forces of all contacts that press
///     bottom     sum, grain by grain, of the vertical forces of what is no grain and lies below it      R 3.2
/// P(n) is a density: counts over their number and the width of the bin, of equal widths and of equal ratios.
/// Decay: P ~ exp(-n / length) above the mean. Given n > 1, n - 1 is exponential, so the likelihood is largest at
///     1 / length = k / sum (n - 1),   k the number of forces above the mean,
/// and 2 sum (n - 1) / length follows chi square with 2 k degrees of freedom, which gives the interval. The mean is that
/// of the same forces, which takes from the scatter of n - 1: 98 to 99 % of samples of independent forces have their
/// length in it and not 95 %. Forces in one sample are not quite independent: intervals over samples are to be preferred.
/// Shares of the bottom forces below half of the mean and from there to the mean: bins of equal width, so that the
/// first is larger where P(n) rises below the mean (R 3.2). Strong contacts bear more than three times the mean.
/// Friction is mobilised by |f_t| / f_n, what R 2.6.2 calls effective friction; a contact slides when the law says so.
/// Roses: directions of normals between bodies, of each contact both ways, in sectors of equal angle in 2D, of equal
/// solid angle by elevation in 3D; density 1 where all directions are alike; beside them the mean normal and tangential
/// force by direction over the mean of all.
#ifndef SCREE_AVERAGE_FORCE_STATISTICS_H
#define SCREE_AVERAGE_FORCE_STATISTICS_H

#include "average/fields.h"
#include "average/table.h"

/// 1 / length of the exponential tail with its 95 % interval, NAN with fewer than two forces above the mean.
typedef struct scree_average_decay {
    double rate, low, high;
    size_t count;
} scree_average_decay;
scree_average_decay scree_average_decay_fit(const double *force, size_t count);

/// Tells the numbers of the sample. Errors: memory.
scree_status scree_average_forces_tell(const scree_average_sample *sample, scree_average_sink *sink, void *user,
                                       scree_error *error) SCREE_MUST_USE;

/// Rows of bins: scale (0 linear, 1 logarithmic), from, to, and P and counts of both kinds. Errors: memory.
scree_status scree_average_forces_table(const scree_average_sample *sample, scree_average_table *table,
                                        scree_error *error) SCREE_MUST_USE;

/// Rows of bins of |f_t| / f_n: from, to, density, and the share of its contacts that slide. Errors: memory.
scree_status scree_average_friction_table(const scree_average_sample *sample, scree_average_table *table,
                                          scree_error *error) SCREE_MUST_USE;

/// Rows of sectors: angle [degree], contacts, normal, tangential. Errors: memory.
scree_status scree_average_rose_table(const scree_average_sample *sample, scree_average_table *table,
                                      scree_error *error) SCREE_MUST_USE;

#endif
