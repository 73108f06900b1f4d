/// What all processes have to know of the first half of a step before they look at their lists: how fast bodies are,
/// which bounds forces and says how far they have moved, and whether one of them has to make its list anew. One
/// message.
#ifndef SCREE_SEARCH_MOVED_H
#define SCREE_SEARCH_MOVED_H

#include "state/work.h"

/// A scheme has moved the bodies. Where the state is a part, state->largest_speed and work->budget wait for the
/// message.
void scree_moved_tell(scree_state *state, scree_work *work, const scree_speeds *speeds);

/// After that: bodies have been driven with |v| + R |w| up to `speed`.
void scree_moved_drive(scree_state *state, scree_work *work, double speed);

/// The message goes, with all that work->moved.together lists; due: this process has to make its list anew. What is
/// told to the ghosts may go beside it. All processes call it.
void scree_moved_begin(scree_state *state, scree_work *work, bool due);

/// The message has come: work->moved.due, and the speed in the state, the budget and flags of `work`.
void scree_moved_end(scree_state *state, scree_work *work);

/// Both at once, before the search, where the speeds are needed for what moves.
void scree_moved_join(scree_state *state, scree_work *work, bool due);

#endif
