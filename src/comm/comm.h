/// What goes between the parts of a sample, as messages: between a periodic cell and its ghosts, and between processes.
/// serial.c exchanges messages within one process, by copies; parts.c those with other processes. What these two and
/// the numbers out of all parts need of a transport is in alone.c (one process) or mpi.c and mpi_numbers.c (several,
/// the preset mpi), the parts themselves in zoltan.c.
///
/// Ghosts are rows of bodies behind the `count` own ones. What is sent of a body, and what a ghost gives back, is
/// declared with the fields (module/field.h, `ghosts`); a new field of a module needs no line here.
#ifndef SCREE_COMM_COMM_H
#define SCREE_COMM_COMM_H

#include "base/integer_sum.h"
#include "base/reduction.h"
#include "base/wide_sum.h"
#include "comm/message.h"

/// The list of ghosts in `work` is new: makes room for them behind the own rows, tells them what they keep and where
/// they are. Errors: memory, there are no ghosts then.
scree_status scree_comm_begin(scree_state *state, scree_work *work, scree_error *error) SCREE_MUST_USE;

/// Sends what the ghosts follow in, and receives it behind the own rows: position + H s and velocity + H' s of a ghost
/// s lattice vectors from its body, all else as it is. H' is the velocity of the lattice at the end of the step
/// (scree_periodic_lattice_velocity): in a sheared cell a ghost moves with the affine field at its own place. Cost: a
/// few copies a ghost, shared among the threads. Errors: memory for messages, which grow with what bodies have.
scree_status scree_comm_exchange(scree_state *state, scree_work *work, scree_error *error) SCREE_MUST_USE;

/// Adds what the ghosts have collected to their bodies, and leaves the rows of the ghosts clear.
void scree_comm_add_back(scree_state *state, scree_work *work);

// ---- the processes that take part -------------------------------------------------------------------------------

/// Whether the program is built with MPI.
bool scree_comm_has_transport(void);

/// This process takes part with the others that its launcher has started, if the program is built with MPI; all of
/// them call it, once, before anything else here. Without it a process is alone. Errors: the launcher has none of MPI.
scree_status scree_comm_join(scree_error *error) SCREE_MUST_USE;
/// All of them call it at the end.
void scree_comm_leave(void);

enum { SCREE_PROCESSES = 4096 }; ///< at most

int scree_comm_size(void); ///< processes that take part
int scree_comm_rank(void); ///< number of this one, 0 .. size - 1

int scree_comm_neighbours(void); ///< processes on this machine, this one too

/// All have come this far; if one of them has failed, all return its status and have its error, that of the lowest
/// number. All of them call it.
scree_status scree_comm_agree(scree_status status, scree_error *error) SCREE_MUST_USE;

/// Ends all processes at once with this status, when one has failed where the others cannot know.
void scree_comm_stop(scree_status status);

// ---- one number out of all parts: what each has found among its own bodies and contacts -------------------------
// Where `state` is a part of a sample; where it is the whole (not state->part), the answer is that of the state alone.
// NULL: of all processes.

/// scree_integer_sum_next over the terms of all processes: between the passes their parts are joined, so that all have
/// the same quantum and the same total. All of them call it, as often.
bool scree_comm_sum_next(const scree_state *state, scree_integer_sum *sum, int count);

/// scree_integer_sum_of over the terms of all processes.
double scree_comm_sum_of(const scree_state *state, const double *term, size_t count);

/// scree_wide_total over the parts of all processes, which have the same quantum.
void scree_comm_wide_total(const scree_state *state, const scree_wide_sum *part, int count, double quantum,
                           double total[9]);

/// Replaces each value by the largest one of all processes.
void scree_comm_maximum(const scree_state *state, double *values, size_t count);

/// Replaces each value by the sum over all processes.
void scree_comm_add(const scree_state *state, int64_t *values, size_t count);

/// Joins all that the reduction lists, in one message, and empties the list. All processes call it, with lists alike.
void scree_comm_join_numbers(const scree_state *state, scree_reduction *reduction);

/// The same in two halves: messages of ghosts and other work may be done between them, but no other reduction. The
/// numbers must not be read or written meanwhile.
void scree_comm_join_begin(const scree_state *state, scree_reduction *reduction);
void scree_comm_join_end(const scree_state *state, scree_reduction *reduction);

// ---- bytes between processes, for parts.c; all of them call each function, and ask for what the others send ------

/// theirs[r * each + k]: what process r has in mine[own number * each + k].
void scree_comm_trade(const uint64_t *mine, uint64_t *theirs, size_t each);

/// Elements of `size` bytes: send[r] of them to process r, those of all one after the other in `out`; receive[r] from
/// it, in the same way into `in`. What would go to the own process is left out. Returns the bytes that were sent.
size_t scree_comm_deliver(const void *out, const size_t *send, void *in, const size_t *receive, size_t size);

/// `count` elements of `size` bytes of each process, by the numbers of processes, into `all` of each; counts[r]: of
/// process r.
void scree_comm_gather(const void *mine, void *all, const size_t *counts, size_t size);

/// All have `size` bytes as process 0 has them.
void scree_comm_share(void *bytes, size_t size);

// ---- files that all write together -------------------------------------------------------------------------------

/// Sets up a file of HDF5 (`access`: a property list of access) or its arrays (`transfer`: one of transfers) for all
/// processes at once; false on failure. Alone there is nothing to set up.
bool scree_comm_open_together(int64_t access);
bool scree_comm_write_together(int64_t transfer);

// ---- parts of space ----------------------------------------------------------------------------------------------

/// Cuts space anew, so that each part holds about as much of the weights of all places [m] (NULL: all weigh alike). All
/// of them call it, each with its own. Errors: memory, or what the library says.
scree_status scree_comm_cut(const scree_vector *place, const float *weight, size_t count, int dimension,
                            scree_error *error) SCREE_MUST_USE;

/// The process in whose part the place lies, after the last cut.
int scree_comm_part_of(const scree_vector place);

#endif
