/// What a process that has read a range of a state cannot know alone: whether the bodies that its rows name are there.
#ifndef SCREE_COMM_KNOWN_H
#define SCREE_COMM_KNOWN_H

#include "state/check.h"

/// Asks for all bodies that the fields of a part name, whichever process has them. All processes call it. Errors, the
/// same ones in all: memory; SCREE_ERROR_IO: an id is that of two bodies, or was never given. Cost: 12 bytes are sent
/// for each body and for each name, and 8 kept for each body that is named.
scree_status scree_known_bodies_ask(const scree_state *state, scree_known_bodies *known,
                                    scree_error *error) SCREE_MUST_USE;
void scree_known_bodies_destroy(scree_known_bodies *known);

#endif
