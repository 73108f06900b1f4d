/// When the peeling of an outer boundary (boundary_loop.c, boundary_surface.c) cuts: limits, and what it remembers of
/// the boundary before, so that a facet near a limit does not come and go.
///
/// With the facets (edges in 2D, triangles in 3D) of the boundary before, one that was on it stays until it is over its
/// limit by the share h, and one that was not is cut from h below it on:
///     gap > limit (1 + h)  or  (1 - h),    turn < 30 degrees (1 - h)  or  (1 + h)
/// (turn: by how much a sliver's cut turns the boundary, 180 degrees less the angle at its tip in 2D). Without, h
/// counts as zero. The boundary then depends on the positions and on the boundary before, which is state: not on
/// threads, and a restart finds the same.
///
/// In 2D the gap of an edge is that between the outlines of its two bodies (shape/core_gap.h), of discs |x_a - x_b| -
/// R_a - R_b. Whoever looks for the boundary of a sample with polygons gives them to the rule (shape/outlines.h).
#ifndef SCREE_SEARCH_PEEL_RULE_H
#define SCREE_SEARCH_PEEL_RULE_H

#include "shape/core_gap.h"

#include <stddef.h>
#include <stdint.h>

#define SCREE_SLIVER_TURN 0.52359877559829887308 /* rad, 30 degrees */

typedef struct scree_peel_rule {
    double gap_limit;      ///< m
    double hysteresis;     ///< 1, h
    const uint32_t *facet; ///< facet_count x dimension point indices, sorted (scree_peel_rule_sort); NULL: none
    size_t facet_count;
    const scree_core *outline; ///< 2D: by the same indices, of the bodies as they lie; NULL: all are round
    const uint32_t *index;     ///< of the points in those indices, ascending; NULL: the same
} scree_peel_rule;

/// A rule without a past, from a limit [m].
#define SCREE_PEEL_RULE(limit) (&(const scree_peel_rule){.gap_limit = (limit)})

/// Brings facets [count x dimension] into the order that a rule needs: triangles each from its lowest index, without
/// change of their sense.
void scree_peel_rule_sort(uint32_t *facet, size_t count, int dimension);

/// 1 + h when the facet with these corners was on the boundary before, 1 - h when it was not; 1 without a past.
double scree_peel_rule_share(const scree_peel_rule *rule, int dimension, const uint32_t *corner);

/// 2D: gap [m] of the edge between these two points, the second `apart` from the first; radius: of the points, of
/// bodies that are round.
double scree_peel_rule_gap(const scree_peel_rule *rule, const uint32_t corner[2], const double apart[2],
                           const double *radius);

#endif
