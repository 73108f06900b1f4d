/// The persistent list: pairs of bodies that are held together, by ids, however far apart they are. They are contacts
/// without a distance test, under a law of their own (model->persistent), which may pull. A pair that is in it is in no
/// other list. Bonds are made of it.
///
/// What a pair remembers is declared by its law (state/memory_fields.h); while a neighbour list stands it lies in
/// work->pairs, and comes here with scree_contacts_save or when the list is made anew. Members are ordered by ids.
/// Of a part they lie with the process that evaluates them, or while no list stands with those of both bodies.
#ifndef SCREE_STATE_PERSISTENT_H
#define SCREE_STATE_PERSISTENT_H

#include "state/state.h"

typedef struct scree_persistent_member {
    uint32_t first, second;                  ///< ids, the lower one first
    double constant[SCREE_MEMBER_CONSTANTS]; ///< of this pair, given with it; the law says what they are
    scree_history history;                   ///< and these rows as those of other contacts
    scree_last_force last_force;
    scree_rolling rolling;
    uint64_t added; ///< `changes` of the list, when it was added (derived)
} scree_persistent_member;

/// State of the module `persistent`.
typedef struct scree_persistent_list {
    scree_persistent_member *member; ///< count, by (first, second)
    size_t count, capacity;
    size_t total;               ///< of a part: members of all processes (derived)
    double largest_deformation; ///< m, of all members: departure from rest, tangential displacement
    double largest_gap;         ///< m, between the surfaces of a member; 0 where all overlap
    uint64_t changes;           ///< members added and removed in this process (derived)
} scree_persistent_list;

extern const scree_group scree_persistent_group;

static inline scree_persistent_list *scree_persistent(const scree_state *state)
{
    return state->own[SCREE_SLOT_persistent];
}

/// Members, of a part those of all processes.
static inline size_t scree_persistent_total(const scree_state *state)
{
    return state->part ? scree_persistent(state)->total : scree_persistent(state)->count;
}

/// Number of the member of two bodies; SIZE_MAX when they are none. Cost: logarithmic.
size_t scree_persistent_find(const scree_state *state, uint32_t id_a, uint32_t id_b);

/// Holds two bodies together from now on, with clear memory; constant[SCREE_MEMBER_REST] is the overlap [m] at which
/// they are at rest, negative for a gap. Forces act from the next evaluation on; what a contact of the two remembered,
/// and its energy, ends there. Errors: memory; SCREE_ERROR_INPUT: one body twice, none with this id, a pair that is
/// held already. Cost: a shift of the members behind it, none where pairs come in the order of ids.
scree_status scree_persistent_add(scree_state *state, uint32_t id_a, uint32_t id_b,
                                  const double constant[SCREE_MEMBER_CONSTANTS], scree_error *error) SCREE_MUST_USE;

/// Adds many at once, with what they remember. member: count, in the order of ids, the lower id of each first, none of
/// them held already, all bodies there. Errors: memory. Cost: linear in all members.
scree_status scree_persistent_merge(scree_state *state, const scree_persistent_member *member, size_t count,
                                    scree_error *error) SCREE_MUST_USE;

/// Ends those with these numbers, which increase. Cost: linear in all members.
void scree_persistent_drop(scree_state *state, const size_t *number, size_t count);

/// Ends it; from the next evaluation on the two are like all others, and touch anew if they touch. Errors:
/// SCREE_ERROR_INPUT: they are not held.
scree_status scree_persistent_remove(scree_state *state, uint32_t id_a, uint32_t id_b,
                                     scree_error *error) SCREE_MUST_USE;

/// From the first to the second of a member [m]: the shortest way, across faces of a periodic cell too.
void scree_persistent_branch(const scree_state *state, const scree_persistent_member *member, scree_vector branch);

#endif
