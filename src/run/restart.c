/// Which of the states in a run directory can be gone on from.
#include "run/restart.h"

#include "io/run_directory.h"
#include "io/snapshot.h"
#include "state/check.h"

scree_status scree_restart_case(const char *directory, scree_case **c, scree_error *error)
{
    char path[4096];
    scree_problems *problems = NULL;
    scree_status status = scree_path_join(path, sizeof path, directory, SCREE_FILE_CASE, error);
    if (status) return status;
    status = scree_case_reread(path, scree_former_keys, c, &problems);
    if (status && scree_problems_count(problems) > 0) *error = *scree_problems_get(problems, 0);
    scree_problems_free(problems);
    return status;
}

/// A preparation is over as soon as it has begun.
static scree_status check_stage(const scree_simulation *s, const scree_state *state, scree_error *error)
{
    const scree_stage_state *stage = &state->stage;
    bool left = stage->index < s->model.config->stage_count;
    if (left && stage->counter >= 0 && s->model.config->stages[stage->index].kind == SCREE_STAGE_PREPARE)
        return scree_error_set(error, SCREE_ERROR_IO,
                               "dataset 'stage/counter': %lld (accepted: -1 before the preparation)",
                               (long long)stage->counter);
    return SCREE_OK;
}

scree_status scree_restart_check(const scree_simulation *s, const scree_state *state, scree_error *error)
{
    scree_status status = scree_state_check(state, &s->model, error);
    return status ? status : check_stage(s, state, error);
}

static scree_status usable(void *context, const scree_state *state, scree_error *error)
{
    return scree_restart_check(context, state, error);
}

scree_status scree_restart_read(scree_simulation *s, const char *directory, uint64_t checksum, scree_error *error)
{
    const scree_checkpoint_wanted wanted = {
        .dimension = s->model.dimension, .case_checksum = checksum, .usable = usable, .context = s};
    return scree_checkpoint_find(directory, &wanted, &s->state, error);
}
