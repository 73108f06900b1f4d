/// What the bodies of a part cost in a step: by this space is cut, and cut anew (comm/parts.h).
///
/// By counts, which are the same in each repetition of a run, in units of a near pair: a body that is awake 4, one that
/// sleeps 1, a pair of the last list that touches 4, one that is near 1; pairs of two that sleep are not evaluated and
/// cost nothing. The cost of a pair goes to its bodies, half and half, to the one that is here where the other is a
/// ghost. Or by the time that a process has taken since the last cut, without that in calls of the transport, spread
/// over its bodies by these counts: that fits whatever else a process does (unlike machines, walls, files), and no
/// two runs are cut alike. The bits of a run follow neither.
#ifndef SCREE_COMM_BALANCE_H
#define SCREE_COMM_BALANCE_H

#include "state/work.h"

typedef struct scree_balance {
    double begun, waited; ///< s, at the last cut: of the clock, and in calls of the transport until then
} scree_balance;

/// Counts from here on: at the begin, and when space has been cut.
void scree_balance_begin(scree_balance *balance);

/// Cost of the own part, by which all compare: counts, or nanoseconds since the last cut.
int64_t scree_balance_cost(const scree_balance *balance, const scree_state *state, const scree_work *work);

/// More than this beside SCREE_PARTS_IMBALANCE times the mean is worth a cut: two bodies, or a tenth of a second.
double scree_balance_slack(const scree_work *work);

/// Weight of each row, *weight [count], to be released; of a list that holds. Errors: memory.
scree_status scree_balance_weights(const scree_balance *balance, const scree_state *state, const scree_work *work,
                                   float **weight, scree_error *error) SCREE_MUST_USE;

#endif
