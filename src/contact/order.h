/// Touching contacts in the order of ids, which does not depend on how rows and pairs lie in memory.
#ifndef SCREE_CONTACT_ORDER_H
#define SCREE_CONTACT_ORDER_H

#include "contact/single.h"

typedef struct contact_reference {
    uint32_t first, second; ///< ids; a wall is SCREE_WALL_ID + its index, an element SCREE_PRIMITIVE_ID + its number
    uint32_t pair;          ///< in work->pairs, work->wall_pairs or work->primitive_pairs
} contact_reference;

static inline contact_list contact_reference_list(const contact_reference *r)
{
    return r->second >= SCREE_WALL_ID        ? CONTACT_PLATE
           : r->second >= SCREE_PRIMITIVE_ID ? CONTACT_ELEMENT
                                             : CONTACT_PAIR;
}

/// All pairs, wall pairs and element pairs that touch at the present positions, ordered by (first, second): walls come
/// last for each first. *list is allocated here and released by the caller. Errors: memory. Cost: linear.
scree_status contact_order(const scree_state *state, const scree_work *work, contact_reference **list, size_t *count,
                           scree_error *error) SCREE_MUST_USE;

#endif
