/// The interval against the range of values that meet the criterion. An end on the bound of "greater than" and "less
/// than" does not meet it, an end on a bound of the others does.
#include "sweep/verdict.h"

double scree_statement_confidence(const scree_statement *statement)
{
    return statement->kind == SCREE_CRITERION_WITHIN || statement->kind == SCREE_CRITERION_EQUIVALENT ? 0.90 : 0.95;
}

bool scree_verdict_is_open(scree_verdict verdict)
{
    return verdict == SCREE_DIFFERS || verdict == SCREE_UNDECIDED || verdict == SCREE_NOT_MEASURED;
}

scree_verdict scree_verdict_of(const scree_statement *statement, const scree_interval *interval)
{
    scree_statement_range range = scree_statement_accepts(statement);
    double low = interval->low, high = interval->high;
    // Comparisons with what is not a number are false.
    if (!(low <= high)) return SCREE_UNDECIDED;
    if (range.closed ? low >= range.low && high <= range.high : low > range.low && high < range.high)
        return SCREE_AGREES;
    if (range.closed ? high < range.low || low > range.high : high <= range.low || low >= range.high)
        return SCREE_DIFFERS;
    return SCREE_UNDECIDED;
}
