/// Loads of a case: one file a kind, whose module does its work in passes (module/pass.h).
#ifndef SCREE_LOAD_LOAD_H
#define SCREE_LOAD_LOAD_H

#include "case/check.h"
#include "state/work.h"

/// The struct of the first load of this kind, or of the one after `previous`; NULL: there is none.
const void *scree_load_next(const scree_model *model, const scree_module *module, const void *previous);

/// For `told` of a load that tells of all of its kind together: whether the case has one, and `index` is 0.
bool scree_load_told(const scree_config *config, const scree_module *module, size_t index);

/// First and last stage in which a load acts, by their names; NULL: the first and the last of the case. -1: there is
/// none of this name.
void scree_load_stages(const scree_config_stage *stages, int64_t count, const char *from, const char *until,
                       int64_t range[2]);

/// Whether it acts in the present stage.
bool scree_load_acts(const scree_model *model, const scree_state *state, const char *from, const char *until);

/// Refuses names of load `index` that no stage has, and an end before the begin.
void scree_load_check_stages(scree_reader *reader, const scree_config *config, int64_t index, const char *from,
                             const char *until);

#endif
