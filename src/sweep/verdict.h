/// What an interval says about a criterion: design rules in docs/sweeps.md.
#ifndef SCREE_SWEEP_VERDICT_H
#define SCREE_SWEEP_VERDICT_H

#include "sweep/interval.h"
#include "sweep/statements.h"

typedef enum scree_verdict {
    SCREE_AGREES,    ///< the whole interval meets the criterion
    SCREE_DIFFERS,   ///< no value of the interval does
    SCREE_UNDECIDED, ///< some do, or there is no interval
    SCREE_NOT_MEASURED,
    SCREE_NOT_RUN,
    SCREE_VERDICTS,
} scree_verdict;

/// Confidence of the interval that a statement is judged by: 95 %; 90 % for `within` and `equivalent within`, whose two
/// sides are a one-sided test of 5 % each.
double scree_statement_confidence(const scree_statement *statement);

/// No agreement of runs that are there: what is said with its explanation.
bool scree_verdict_is_open(scree_verdict verdict);

/// AGREES, DIFFERS or UNDECIDED. An interval with an end that is not a number decides nothing.
scree_verdict scree_verdict_of(const scree_statement *statement, const scree_interval *interval);

#endif
