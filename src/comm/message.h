/// What a message says of a body: the values that declarations of fields (module/field.h) want with ghosts, one after
/// the other. Layout, packing and unpacking follow from the declarations of the state and of all modules; nobody writes
/// a list of them.
///
/// A message of n bodies holds its pieces one after the other, each for all n. A field whose array there is not (it is
/// optional) is left out; all who take part have the same ones.
#ifndef SCREE_COMM_MESSAGE_H
#define SCREE_COMM_MESSAGE_H

#include "state/work.h"

typedef enum scree_message_kind {
    SCREE_MESSAGE_MAKE, ///< what ghosts keep
    SCREE_MESSAGE_STEP, ///< what they follow in, with position and velocity
    SCREE_MESSAGE_BACK, ///< what they have collected
    SCREE_MESSAGE_KINDS
} scree_message_kind;

/// Motion of the lattice, which takes a body to its ghosts.
typedef struct scree_message_shift {
    double lattice[9];  ///< m, lattice vectors as columns
    double velocity[9]; ///< m/s, with which they move
} scree_message_shift;

/// Bytes that a message has of each body.
size_t scree_message_bytes(const scree_state *state, scree_message_kind kind);

/// MAKE, STEP: writes what `count` ghosts are to know of their bodies. shift: of the lattice, now.
void scree_message_pack(const scree_state *state, scree_message_kind kind, const scree_ghost *ghost, size_t count,
                        const scree_message_shift *shift, unsigned char *message);

/// MAKE, STEP: puts it into the `count` rows from `row` on.
void scree_message_unpack(scree_state *state, scree_message_kind kind, size_t row, size_t count,
                          const unsigned char *message);

/// BACK: writes what the `count` rows from `row` on have collected, and clears them.
void scree_message_collect(scree_state *state, size_t row, size_t count, unsigned char *message);

/// BACK: adds it to the bodies of the ghosts, modulo 2^64.
void scree_message_add(scree_state *state, const scree_ghost *ghost, size_t count, const unsigned char *message);

#endif
