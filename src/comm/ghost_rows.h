/// Elements about ghosts of bodies of other processes that no field declares, for whoever measures a part now and then:
/// from bodies to their ghosts, and from what has been found of ghosts to the processes that have the bodies. All
/// processes call each function, as often. Nothing is sent of a whole state.
#ifndef SCREE_COMM_GHOST_ROWS_H
#define SCREE_COMM_GHOST_ROWS_H

#include "state/work.h"

/// Ghosts that other processes have of the bodies here.
size_t scree_ghost_rows_shown(const scree_work *work);

/// The body of number `k` of them: its row.
uint32_t scree_ghost_rows_body(const scree_work *work, size_t k);

/// Ghosts that are here of bodies of other processes; number k of them is in row scree_ghost_rows_first + k.
size_t scree_ghost_rows_seen(const scree_state *state, const scree_work *work);
size_t scree_ghost_rows_first(const scree_state *state, const scree_work *work);

/// shown: an element of `size` bytes for each ghost that others have; seen: gets those of the ghosts here.
void scree_ghost_rows_tell(const scree_state *state, const scree_work *work, const void *shown, void *seen,
                           size_t size);

/// Notes about bodies of other processes on their way to these. They are planned once, and sent as often as there is
/// something new in them.
typedef struct scree_ghost_notes {
    uint32_t *note; ///< those that leave, in the order in which they are sent: their numbers
    uint32_t *row;  ///< of those that arrive: the body that each is about
    size_t *send, *receive;
    size_t leaving, arriving;
} scree_ghost_notes;

/// Note k is about the ghost in row about[k]. Errors: memory.
scree_status scree_ghost_notes_open(const scree_state *state, const scree_work *work, const uint32_t *about,
                                    size_t count, scree_ghost_notes *notes, scree_error *error) SCREE_MUST_USE;

/// note: one element of `size` bytes for each note; arrived: gets those of the others. Errors: memory.
scree_status scree_ghost_notes_send(const scree_ghost_notes *notes, const void *note, void *arrived, size_t size,
                                    scree_error *error) SCREE_MUST_USE;

void scree_ghost_notes_close(scree_ghost_notes *notes);

#endif
