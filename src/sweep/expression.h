/// Arithmetic over named results: numbers, names, + - * / ( ) and one comparison < <= > >=. Nothing else.
///
/// A name is CASE/LABEL.RESULT (or CASE.RESULT): letters, digits and _ / . = - after a letter first. Since `-` and `/`
/// are part of names, they stand between spaces where they are operators. A comparison is 1 or 0. What is not known
/// is NAN, and so is everything made of it, comparisons too.
#ifndef SCREE_SWEEP_EXPRESSION_H
#define SCREE_SWEEP_EXPRESSION_H

#include "base/error.h"

enum { SCREE_EXPRESSION_NAME = 192 }; ///< bytes of a name at most, with its end

/// Value of a name; NAN when it is not known.
typedef double scree_expression_lookup(void *user, const char *name);

/// The operator that is evaluated last, where an expression comes apart into two.
typedef struct scree_expression_split {
    char sign;          ///< + - * / < or >; 0: a number, a name, or all in brackets
    size_t left, right; ///< bytes before the operator; where what follows it begins
} scree_expression_split;

/// Takes an expression apart; sign 0 when it cannot be read.
scree_expression_split scree_expression_take_apart(const char *text);

/// Evaluates `text`. Errors (SCREE_ERROR_INPUT): what is wrong and where; nested more than 32 deep. Every name is
/// looked up exactly once for each time it occurs.
scree_status scree_expression_evaluate(const char *text, scree_expression_lookup *lookup, void *user, double *value,
                                       scree_error *error) SCREE_MUST_USE;

#endif
