/// Figures of ensembles on the reproduction page.
#ifndef SCREE_SWEEP_ENSEMBLE_FIGURES_H
#define SCREE_SWEEP_ENSEMBLE_FIGURES_H

#include "sweep/findings.h"

#include <stdio.h>

/// Copies the mean vertical pressure by height, with its bands, of every point of the runs called `name` into `folder`
/// (NULL: nothing is done) and puts a link to each, below `link`, into the page. Points without averages have none.
/// Errors: SCREE_ERROR_IO.
scree_status scree_ensemble_figures_write(const scree_findings *findings, const char *name, const char *folder,
                                          const char *link, FILE *page, scree_error *error) SCREE_MUST_USE;

#endif
