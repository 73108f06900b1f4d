/// Which pairs of bodies a bond is to join.
#ifndef SCREE_BOND_CANDIDATES_H
#define SCREE_BOND_CANDIDATES_H

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

typedef struct scree_bond_candidate {
    uint32_t first, second; ///< ids, the lower one first
    double gap;             ///< m, negative: they overlap
} scree_bond_candidate;

typedef struct scree_bond_candidates {
    scree_bond_candidate *pair; ///< count, by ids; each is allowed, and none is held
    size_t count, capacity;
} scree_bond_candidates;

/// Finds them; release candidates->pair in any case. Errors: those of scree_bonds_make.
scree_status scree_bond_candidates_find(const scree_model *model, scree_state *state, scree_work *work,
                                        const scree_bond_order *order, scree_bond_candidates *candidates,
                                        scree_error *error) SCREE_MUST_USE;

#endif
