/// What the runs of one form say about a statement.
#ifndef SCREE_SWEEP_ANSWER_H
#define SCREE_SWEEP_ANSWER_H

#include "sweep/findings.h"
#include "sweep/verdict.h"

/// Begins the remark on an answer that is `few`: the page has no other word of it.
#define SCREE_ANSWER_FEW "averages over fewer than"

typedef struct scree_answer {
    scree_verdict verdict;
    scree_interval interval;
    bool few;         ///< an average over too few for an interval, whatever it says
    size_t successes; ///< of `holds`
    size_t planned;   ///< realisations that there should be; interval.count is how many there are
    char remark[400]; ///< what a reader has to know of these runs; "" when all is well
} scree_answer;

/// Evaluates a statement on the runs of one form. Errors: SCREE_ERROR_INPUT of the expression, SCREE_ERROR_IO (memory).
///
/// Runs are paired by seed where all of them had the same sample (or the statement is deterministic): the expression is
/// evaluated for each sample, then averaged. Else a quotient, a sum or a difference whose two sides are each of one
/// sample is taken from the means of both (Welch), and anything else stays undecided. A quotient of results is averaged
/// as logarithms where all values are positive.
scree_status scree_answer_find(const scree_findings *findings, const scree_statement *statement,
                               scree_finding_form form, scree_answer *answer, scree_error *error) SCREE_MUST_USE;

#endif
