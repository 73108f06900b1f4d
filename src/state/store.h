/// Begin and end of the structs that modules keep in a state (module/module.h), and the arrays with one element a body,
/// those of the state and those of modules, as one list: allocation, growth, order, append and remove go through it.
#ifndef SCREE_STATE_STORE_H
#define SCREE_STATE_STORE_H

#include "state/state.h"

/// Zeroed structs for all modules that have one. Errors: memory; close releases what there is.
scree_status scree_store_open(scree_state *state, scree_error *error) SCREE_MUST_USE;

/// Releases them with the arrays of their fields.
void scree_store_close(scree_state *state);

/// An array with one element a body, in which several fields may lie.
typedef struct scree_body_array {
    void *pointer; ///< address of the pointer to it
    size_t size;   ///< bytes of an element
    bool ghosts;   ///< with room for ghosts
    bool optional; ///< there may be none
} scree_body_array;

/// Most arrays that bodies may have, those of all modules together.
enum { SCREE_BODY_ARRAYS = 64 };

/// The arrays that fields of bodies of the state's dimension declare; of the optional ones those that there are.
size_t scree_body_arrays(const scree_state *state, scree_body_array list[SCREE_BODY_ARRAYS]);

/// Makes all of them hold `count` bodies and one more, so that a state without bodies has arrays too; `exactly`, or
/// with room for more. Errors: memory.
scree_status scree_store_reserve_bodies(scree_state *state, size_t count, bool exactly,
                                        scree_error *error) SCREE_MUST_USE;

/// The state has lost most of its bodies: arrays of bodies and contacts become as long as what is in them, and an
/// eighth; those of a group too. Errors: memory; then some are as they were.
scree_status scree_store_shrink(scree_state *state, scree_error *error) SCREE_MUST_USE;
scree_status scree_group_shrink(scree_state *state, const scree_module *module, const scree_group *group,
                                scree_error *error) SCREE_MUST_USE;

#endif
