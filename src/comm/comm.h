/// What goes between the parts of a sample, as messages: between a periodic cell and its ghosts, and between processes.
/// serial.c answers it within one process, by copies; what answers it among several has the same functions.
///
/// Ghosts are rows of bodies behind the `count` own ones. What is sent of a body, and what a ghost gives back, is
/// declared with the fields (module/field.h, `ghosts`); a new field of a module needs no line here.
#ifndef SCREE_COMM_COMM_H
#define SCREE_COMM_COMM_H

#include "base/integer_sum.h"
#include "base/wide_sum.h"
#include "comm/message.h"

/// The list of ghosts in `work` is new: makes room for them behind the own rows, tells them what they keep and where
/// they are. Errors: memory, there are no ghosts then.
scree_status scree_comm_begin(scree_state *state, scree_work *work, scree_error *error) SCREE_MUST_USE;

/// Sends what the ghosts follow in, and receives it behind the own rows: position + H s and velocity + H' s of a ghost
/// s lattice vectors from its body, all else as it is. H' is the velocity of the lattice at the end of the step
/// (scree_periodic_lattice_velocity): in a sheared cell a ghost moves with the affine field at its own place. Cost: a
/// few copies a ghost, shared among the threads.
void scree_comm_exchange(scree_state *state, scree_work *work);

/// Adds what the ghosts have collected to their bodies, and leaves the rows of the ghosts clear.
void scree_comm_add_back(scree_state *state, scree_work *work);

// ---- one number out of all parts: what each has found among its own bodies and contacts
// --------------------------------

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

#endif
