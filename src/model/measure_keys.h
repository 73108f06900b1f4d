/// Modules whose numbers are their keys in the section `measure`, as they were said.
#ifndef SCREE_MODEL_MEASURE_KEYS_H
#define SCREE_MODEL_MEASURE_KEYS_H

#include "model/model.h"

/// Copies the keys of a module into its numbers, which are of the same struct. Nothing where there are none: a config
/// made by hand, which no run is of. For `resolve` of the module. Errors: none.
scree_status scree_model_keep_measure_keys(scree_model *model, int slot);

#endif
