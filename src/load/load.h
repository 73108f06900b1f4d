/// Loads of a case: one file a kind, whose module does its work in passes (module/pass.h).
#ifndef SCREE_LOAD_LOAD_H
#define SCREE_LOAD_LOAD_H

#include "state/work.h"

/// The struct of the first load of this kind, or of the one after `previous`; NULL: there is none.
const void *scree_load_next(const scree_model *model, const scree_module *module, const void *previous);

/// For `told` of a load that tells of all of its kind together: whether the case has one, and `index` is 0.
bool scree_load_told(const scree_config *config, const scree_module *module, size_t index);

#endif
