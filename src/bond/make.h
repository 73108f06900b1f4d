/// Making bonds between two steps.
#ifndef SCREE_BOND_MAKE_H
#define SCREE_BOND_MAKE_H

#include "bond/strength.h"
#include "state/work.h"

/// Where a bond is at rest.
typedef enum scree_bond_rest {
    SCREE_REST_AS_MADE,  ///< at the distance at which it is made: it begins without a force of its springs
    SCREE_REST_GEOMETRIC ///< where the two just touch (Madan 2019, 2.25)
} scree_bond_rest;

/// Which pairs are to be bonded, and how.
typedef struct scree_bond_order {
    double gap_tolerance;     ///< m, largest gap
    double overlap_tolerance; ///< m, largest overlap; NAN: 5 % of the smaller radius of each pair
    int64_t between, other;   ///< selections, which have been found; -1: all grains; `other` -1: within `between`
    const double (*list)[2];  ///< pairs of ids instead of all within the tolerance; NULL: none
    int64_t list_count;
    int rest; ///< scree_bond_rest
    scree_strength strength;
} scree_bond_order;

/// Bonds them. Of a contact that a bond takes the place of, forces at n are taken out of the sums of the two bodies and
/// what the bond exerts, the dashpots of its springs at rest, is put in; the energy that is lost is kept as `bonding`,
/// so that the balance stays closed. The neighbour list is made anew. made: how many. Errors: SCREE_ERROR_INPUT with
/// `field` as the name of a key alone: nothing to bond, second neighbours within the tolerance, overlaps beyond it, ids
/// that are not there, a pair that is bonded already or meets itself twice across a periodic cell, a body of a
/// membrane; SCREE_ERROR_GUARD: longer than half of the cell; memory. Nothing has been bonded then, but for the last.
/// Cost: a rebuild of the list, two contact tables, linear in the bonds.
scree_status scree_bonds_make(const scree_model *model, scree_state *state, scree_work *work,
                              const scree_bond_order *order, size_t *made, scree_error *error) SCREE_MUST_USE;

#endif
