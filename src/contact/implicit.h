/// Strains that the forces of the same step are made of: contact/implicit.c.
#ifndef SCREE_CONTACT_IMPLICIT_H
#define SCREE_CONTACT_IMPLICIT_H

#include "contact/stretch.h"

/// At the begin of a step: keeps what the state has at n, and goes on as in the last step, to begin with.
void scree_implicit_depart(const scree_context *context);

/// When positions and the list are those of n + 1: finds the stretches and leaves them in the state; half of the work
/// in their change into `term`. compliance: by material. tolerance: largest error of a stretch over the largest one.
/// Errors: memory; no convergence, with the step.
scree_status scree_implicit_solve(const scree_context *context, const scree_compliance *compliance, double tolerance,
                                  scree_stretch_change *change, scree_error *error) __attribute__((warn_unused_result));

#endif
