/// Loads of a case: one file a kind, whose module does its work in passes (module/pass.h).
#ifndef SCREE_LOAD_LOAD_H
#define SCREE_LOAD_LOAD_H

#include "state/work.h"

/// The struct of the first load of this kind, or of the one after `previous`; NULL: there is none.
const void *scree_load_next(const scree_model *model, const scree_module *module, const void *previous);

#endif
