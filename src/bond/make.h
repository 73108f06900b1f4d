/// Making bonds between two steps.
#ifndef SCREE_BOND_MAKE_H
#define SCREE_BOND_MAKE_H

#include "bond/candidates.h"

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
