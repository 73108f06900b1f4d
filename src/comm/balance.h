/// What the bodies of a part cost in a step: by this space is cut, and cut anew (comm/parts.h).
///
/// By counts, which are the same in each repetition of a run, in units of a near pair: a body that is awake 4, one that
/// sleeps 1, a pair of the last list that touches 4, one that is near 1; pairs of two that sleep are not evaluated and
/// cost nothing. The cost of a pair goes to its bodies, half and half, to the one that is here where the other is a
/// ghost. Or by the time that a process has spent in steps beside calls of the transport, spread over its bodies by
/// these counts: that fits whatever else a process does (unlike machines, walls), and no two runs are cut alike. The
/// bits of a run follow neither.
///
/// A step takes as long as the part that costs most, so in n steps the others lose n (largest / mean - 1) steps. Space
/// is cut anew, when a list is made, as soon as more has been lost since the last cut than a cut costs: at most as much
/// goes into cuts as uneven parts would cost, whatever the sample does. What a cut by costs leaves uneven, as bodies
/// are not split, the next one would leave, too: it is not counted. By time, which scatters, what has been lost in a
/// window of steps is forgotten at its end, so that old times do not hide a process that has become slow.
#ifndef SCREE_COMM_BALANCE_H
#define SCREE_COMM_BALANCE_H

#include "state/work.h"

/// What a cut is reckoned to cost, in steps. Measured: 0.6 of 128,000 spheres a process (8 ms), and what the bodies
/// that move cost beside; more where steps are short.
#define SCREE_BALANCE_CUT_STEPS 4

/// Cost of the part that costs most over the mean that memory and time are expected with (run/divide.c): what is lost
/// in a hundred steps, a long life of a list.
#define SCREE_BALANCE_EXPECTED 1.04

typedef struct scree_balance {
    uint64_t steps; ///< since the last cut, or in this window
    // by counts
    double lost;   ///< of these, as long as those of the mean part: by uneven parts
    double left;   ///< least excess over the mean since a cut by costs, which it has left
    uint64_t seen; ///< of `steps`, when the last list was made
    // by time
    double worked; ///< s in these steps beside calls of the transport
    double begun;  ///< s, while a step lasts: when it began, less what calls of the transport had taken until then
} scree_balance;

/// Space has been cut, by costs or by bodies alone.
void scree_balance_begin(scree_balance *balance, bool by_costs);

/// Around a step; only by time it has a clock, and has to have begun.
void scree_balance_begin_step(scree_balance *balance);
void scree_balance_end_step(scree_balance *balance, bool by_time);

/// When a list is to be made, while the last one holds: whether a cut pays. *worst: grows to the cost of the part that
/// costs most over the mean. All processes call it, and get the same.
bool scree_balance_pays(scree_balance *balance, const scree_state *state, const scree_work *work, double *worst);

/// Weight of each row, *weight [count], to be released; of a list that holds. Errors: memory.
scree_status scree_balance_weights(const scree_balance *balance, const scree_state *state, const scree_work *work,
                                   float **weight, scree_error *error) SCREE_MUST_USE;

#endif
