/// Runs beside the built-in sweep of their name as it is now: a page may tell of runs that were made before a seed, a
/// preparation or another part of its case was changed.
#ifndef SCREE_SWEEP_ORIGIN_H
#define SCREE_SWEEP_ORIGIN_H

#include "sweep/findings.h"
#include "sweep/sweep.h"

/// How it is told of runs with other_seed.
#define SCREE_ORIGIN_SEEDS "seeds are not those of the sweep now"

/// Fills other_seed, other_sample and other_case of all runs. The seed is not part of the case here;
/// of a run without `case.yaml` only the seed is known. Sweeps that cannot be read are passed over.
void scree_origin_compare(scree_findings *findings);

/// The built-in sweep of that name in a form, to be freed; NULL: there is none.
scree_sweep *scree_origin_sweep(const char *name, scree_finding_form form);

/// Whether a seed is one of the sweep, or would be with `planned` realisations.
bool scree_origin_has_seed(const scree_sweep *sweep, long long seed, size_t planned);

#endif
