/// What cuts through a heap say in a few numbers, and where its strong forces are.
///
/// Of the lowest cut, elements by their places, -1 to 1: the core within 1/4, the flanks from 1/2 on as far as at least
/// half of an element lies inside; numbers of a region are means over its elements.
///     density_core, density_flank            volume fraction of whole elements                      R 3.4
///     density_excess                         core over flanks less 1; `_inside`: of exact parts inside the surface
///     pressure_axis                          scaled vertical pressure on the axis
///     pressure_beside                        its mean at distances of 0.25 to 0.45, both sides
///     pressure_fluctuation                   ((s(j) - s(-j))^2 / 2)^(1/2) over s, roots of means over all places: what
///                                            the two sides of a symmetric heap differ by, as one sample of its mean
///     long_axis_tilt                         mean angle between the long axis (inertia, R 2.92) and the horizontal
///     axes_tilt                              the same of the mean of e (x) e; 45 degrees where there is no order
///     axes_order_core                        deviator of the mean of e (x) e in the core
///     pressure_fabric_tilt                   mean angle between the axis of the largest pressure and the major axis of
///                                            the fabric tensor (branches, as R has it), all elements half inside
///     pressure_normals_tilt, pressure_axes_tilt  the same of the fabric of the contact normals, and of the long axes
///     force_core_ratio                       mean normal force of contacts within 0.1 of the half width from the axis
///                                            over that at 0.2 to 0.5, lower half of the height
///
/// Source: R = P. Roul, PhD thesis, Magdeburg 2009, 3.2 - 3.7.
#ifndef SCREE_AVERAGE_PROFILE_H
#define SCREE_AVERAGE_PROFILE_H

#include "average/cuts.h"

/// Tells the numbers of a table of cuts with so many points each; those whose columns are not there are left out.
void scree_average_profile_tell(const scree_average_table *cuts, size_t points, scree_average_sink *sink, void *user);

/// Tells where forces are large.
void scree_average_profile_forces(const scree_average_view *view, scree_average_sink *sink, void *user);

/// Makes of a table of cuts the mean of the sample and its mirror image about the axis: one sample. What changes its
/// sign (components with one x, velocities and displacements along x) is taken with it, angles of axes in the plane as
/// axes, everything else as a number.
void scree_average_profile_mirror(scree_average_table *cuts, size_t points);

#endif
