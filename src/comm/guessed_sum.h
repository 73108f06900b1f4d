/// Sums of doubles as in base/integer_sum.h, of the terms of all processes, which mostly take one pass and one message.
///
/// The quantum follows from the largest term, which is known behind the terms. It is a power of two and seldom another
/// than the last time, so the terms are added with that of the last time while the largest is looked for. Both are
/// joined in one message; where the quantum turns out to be another the terms are added once more. The total has the
/// bits of a sum in two passes whatever was guessed.
///
///     scree_guessed_sum mass = {0};
///     while (scree_guessed_sum_next(state, &mass, 1, &largest))
///         for (size_t row = 0; row < state->count; row++) scree_guessed_sum_add(&mass, state->row[row].mass);
///     return scree_guessed_sum_total(&mass);
///
/// `largest`, one a sum, stays from one time to the next; 0 at first. It must be the same in all processes.
#ifndef SCREE_COMM_GUESSED_SUM_H
#define SCREE_COMM_GUESSED_SUM_H

#include "comm/comm.h"

/// Begins with zeros.
typedef struct scree_guessed_sum {
    scree_integer_sum looks, adds;
} scree_guessed_sum;

enum { SCREE_GUESSED_SUMS = 4 }; ///< in one loop, at most

/// Begins the next pass over the terms of `count` sums that are made in the same loop; false behind the last. All
/// processes call it, as often.
bool scree_guessed_sum_next(const scree_state *state, scree_guessed_sum *sum, size_t count, double *largest);

static inline void scree_guessed_sum_add(scree_guessed_sum *sum, double term)
{
    scree_integer_sum_add(&sum->looks, term);
    scree_integer_sum_add(&sum->adds, term);
}

static inline double scree_guessed_sum_total(const scree_guessed_sum *sum)
{
    return scree_integer_sum_total(&sum->adds);
}

#endif
