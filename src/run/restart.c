/// Which of the states in a run directory can be gone on from.
#include "run/restart.h"

#include "comm/comm.h"
#include "comm/known.h"
#include "io/run_directory.h"
#include "io/run_file.h"
#include "io/series.h"
#include "run/ranks.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

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
    bool left = stage->index < s->model.stage_count;
    if (left && stage->counter >= 0 && scree_modules[s->model.stages[stage->index].kind]->numbers->places)
        return scree_error_set(error, SCREE_ERROR_IO,
                               "dataset 'stage/counter': %lld (accepted: -1 before the preparation)",
                               (long long)stage->counter);
    return SCREE_OK;
}

scree_status scree_restart_check(const scree_simulation *s, const scree_state *state, scree_error *error)
{
    scree_known_bodies known = {0};
    scree_status status = state->part ? scree_known_bodies_ask(state, &known, error) : SCREE_OK;
    if (!status) status = scree_state_check(state, &s->model, state->part ? &known : NULL, error);
    scree_known_bodies_destroy(&known);
    return status ? status : check_stage(s, state, error);
}

typedef struct wanted_run {
    const scree_simulation *s;
    const char *directory;
} wanted_run;

/// Values, and the rows that it counts on.
static scree_status usable(void *context, const scree_state *state, scree_error *error)
{
    const wanted_run *run = context;
    char path[4096];
    scree_status status = scree_restart_check(run->s, state, error);
    if (!status) status = scree_path_join(path, sizeof path, run->directory, SCREE_FILE_SERIES, error);
    return status ? status : scree_series_holds(path, state->stage.samples, error);
}

scree_status scree_restart_try(scree_simulation *s, const char *directory, uint64_t checksum,
                               const scree_restart_point *point, scree_error *error)
{
    bool another;
    wanted_run run = {s, directory};
    const scree_restart_wanted wanted = {
        .dimension = s->model.dimension, .case_checksum = checksum, .usable = usable, .context = &run};
    scree_state_destroy(&s->state);
    return scree_restart_point_read(directory, point, &wanted, &s->state, &another, error);
}

static scree_status parse_from(const char *from, int64_t *snapshot, scree_error *error)
{
    *snapshot = SCREE_RESTART_NEWEST;
    if (!from) return SCREE_OK;
    *snapshot = SCREE_RESTART_LATEST_SNAPSHOT;
    if (strcmp(from, "latest") == 0) return SCREE_OK;
    char *end;
    errno = 0;
    *snapshot = strtoll(from, &end, 10);
    if (end != from && *end == 0 && errno == 0 && *snapshot >= 0) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT,
                           "--from '%s' is no snapshot: give its number, or latest (`scree check DIR` lists them)",
                           from);
}

scree_status scree_restart_read(scree_simulation *s, const char *directory, const char *from, uint64_t checksum,
                                scree_restart_point *used, scree_notes *notes, scree_error *error)
{
    wanted_run run = {s, directory};
    scree_restart_wanted wanted = {.dimension = s->model.dimension,
                                   .case_checksum = checksum,
                                   .usable = usable,
                                   .context = &run,
                                   .in_ranges = scree_comm_size() > 1};
    scree_status status = parse_from(from, &wanted.snapshot, error);
    if (status) return status;
    scree_error note = {0};
    scree_state_destroy(&s->state);
    status = scree_restart_find(directory, &wanted, used, &s->state, &note);
    if (status && error) *error = note;
    if (!status && note.message[0]) scree_notes_add(notes, "%s", note.message);
    if (!status && used->snapshot && !from)
        scree_notes_add(notes,
                        "the run goes on from snapshot %" PRId64 ", step %" PRIu64 "; what came after it is dropped",
                        used->index, s->state.step);
    return status;
}

/// Number of the newest checkpoint in parts/.
static scree_status newest_checkpoint(const char *directory, int64_t *index, scree_error *error)
{
    scree_part_list parts;
    scree_status status = scree_parts_list(directory, SCREE_PART_CHECKPOINT, &parts, error);
    *index = !status && parts.count > 0 ? parts.index[parts.count - 1] : 0;
    scree_part_list_destroy(&parts);
    return status;
}

scree_status scree_restart_rewind(scree_simulation *s, const char *directory, uint64_t checksum,
                                  const scree_restart_point *used, scree_notes *notes, scree_error *error)
{
    scree_kept kept = {.snapshots = s->state.stage.snapshots, .last_checkpoint = used->index};
    scree_status status = SCREE_OK;
    // From now on a restart without --from begins here, too; checkpoints of what is dropped go.
    if (used->snapshot) status = scree_ranks_checkpoint(s, directory, checksum, error);
    if (status || !scree_ranks_write()) return status;
    if (used->snapshot) {
        status = newest_checkpoint(directory, &kept.first_checkpoint, error);
        kept.last_checkpoint = kept.first_checkpoint;
    }
    return status ? status : scree_run_file_rewind(directory, s->model.name, &kept, notes, error);
}
