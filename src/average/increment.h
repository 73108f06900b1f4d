/// What two states of one sample say together, in a few numbers: largest stresses, strains by several definitions
/// against each other, elastic constants by place and against the fabric, changes of the contacts.
///
/// Both states are looked at along the same cuts, those of the earlier one. Of their elements those count of which at
/// least half lies inside the sample (`inside`). Regions of the lowest cut, by the place along it: the core within 1/4
/// of the half width, the flanks from 1/2 on; the upper core is that of the cuts at relative heights from 1/2 on.
/// Numbers of a region are medians over its elements. A correlation is that of the ranks (Spearman) over all elements
/// of all cuts, since constants of single elements near the surface are wild, once of whole elements (as R) and once of
/// their parts inside the sample (`_inside`): whole elements that reach out of the surface hold less stress and less
/// fabric alike, so that a part of the first is geometry.
///
/// Dips of strains compare the axis with all elements of the lowest cut; that of the difference quotient with its inner
/// half alone (SCREE_INCREMENT_FLANK), since near the surface, where the neighbours of an element reach out of the
/// pile, R calls what it gives artefacts (3.6.1). The distribution of the coordination number is that over the elements
/// of all cuts, each with the mean of the grains whose centres lie in it (R 3.5, figure 3.24).
///
/// Source: P. Roul, PhD thesis, Magdeburg 2009, 2.6.2, 3.6 - 3.10. Units: SI. Cost: that of two tables of cuts.
#ifndef SCREE_AVERAGE_INCREMENT_H
#define SCREE_AVERAGE_INCREMENT_H

#include "average/cuts.h"
#include "average/strain.h"
#include "module/result.h"

enum {
    SCREE_INCREMENT_CUTS = 5,
    SCREE_INCREMENT_POINTS = 41,
    SCREE_INCREMENT_USUAL = 150, ///< grains of an element,
    SCREE_INCREMENT_SHARE = 10   ///< in small samples the whole over this
};

#define SCREE_INCREMENT_FLANK 0.5 /* over the half width: farther from the axis lies the flank */

/// How far from the axis, over the half width, a dip of the vertical strain of this definition (scree_average_strains)
/// looks.
static inline double scree_increment_reach(int definition)
{
    return definition == SCREE_AVERAGE_DIFFERENCE ? SCREE_INCREMENT_FLANK : 1;
}

enum { SCREE_INCREMENT_ROWS = 71 };
extern const scree_result scree_increment_rows[SCREE_INCREMENT_ROWS + 1]; ///< the last one is no number

/// Finds all of them. Both samples are finished, and the grains of `after` have moved from where they were in `before`
/// (scree_average_move). grains: in an element; 0: the usual number. What there is not is NAN. Errors: memory; an
/// element that is larger than the sample (SCREE_ERROR_INPUT).
scree_status scree_average_increment_find(scree_average_sample *before, scree_average_sample *after, double grains,
                                          double value[SCREE_INCREMENT_ROWS], scree_error *error) SCREE_MUST_USE;

#endif
