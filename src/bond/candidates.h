/// Which pairs of bodies a bond is to join.
#ifndef SCREE_BOND_CANDIDATES_H
#define SCREE_BOND_CANDIDATES_H

#include "bond/make.h"

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
