/// A run that begins where another one has ended a stage: a confined sample that several tests share, or a finished run
/// with stages added.
///
/// Both cases say the same up to there (scree_case_common_stages), and the model that a case makes of it is the same:
/// step, reference velocity, constants of contacts. So the run has the bits that it would have from its begin on. What
/// it takes over are state, rows of series.csv and snapshots. Cost: reading the state, copying files.
#include "run/after.h"

#include "base/memory.h"
#include "comm/comm.h"
#include "io/run_directory.h"
#include "io/run_file.h"
#include "io/series.h"
#include "run/restart.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

// ---- the state ---------------------------------------------------------------------------------------------------

/// What `auto` and bounds over all stages may have made different of the same keys.
static const struct derived {
    const char *key, *unit;
    size_t at;
} derived[] = {
    {"integrator.step", "s", offsetof(scree_model, step)},
    {"contact.reference_velocity", "m/s", offsetof(scree_model, reference_velocity)},
    {"boundary.servo_velocity", "m/s", offsetof(scree_model, servo.velocity)},
};

static double number_at(const scree_model *model, size_t at)
{
    double value;
    memcpy(&value, (const char *)model + at, sizeof value);
    return value;
}

static scree_status same_models(const scree_model *here, const scree_model *there, scree_error *error)
{
    for (size_t k = 0; k < sizeof derived / sizeof *derived; k++) {
        const double a = number_at(here, derived[k].at), b = number_at(there, derived[k].at);
        if (a == b || isnan(b)) continue; // what that run did not know, no rate of loading for one, it has not used
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "%s comes out as %.17g %s of this case and was %.17g %s in that run: a run goes on with "
                               "what it began with, give %s: %.17g %s",
                               derived[k].key, a, derived[k].unit, b, derived[k].unit, derived[k].key, b,
                               derived[k].unit);
    }
    return SCREE_OK;
}

/// The other run, and what is looked for in it.
typedef struct wanted_end {
    const scree_simulation *s;
    int64_t common; ///< stages that are the same
} wanted_end;

/// Snapshots at the end of one of the stages in common.
static scree_status usable(void *context, const scree_state *state, scree_error *error)
{
    const wanted_end *wanted = context;
    if (state->stage.counter != SCREE_STAGE_ENDED || state->stage.index >= wanted->common)
        return scree_error_set(error, SCREE_ERROR_INPUT, "no stage in common ends there");
    return scree_restart_check(wanted->s, state, error);
}

static scree_status read_end(scree_simulation *s, const scree_case *first, int64_t common, const char *other,
                             scree_restart_point *used, scree_error *error)
{
    uint64_t checksum;
    scree_error reason = {0};
    wanted_end end = {s, common};
    scree_status status = scree_case_checksum(first, &checksum, error);
    const scree_restart_wanted wanted = {.dimension = s->model.dimension,
                                         .case_checksum = checksum,
                                         .snapshot = SCREE_RESTART_LATEST_SNAPSHOT,
                                         .usable = usable,
                                         .context = &end,
                                         .in_ranges = scree_comm_size() > 1};
    if (status) return status;
    scree_state_destroy(&s->state);
    status = scree_restart_find(other, &wanted, used, &s->state, &reason);
    if (status)
        scree_error_set(error, status,
                        "the run in '%s' has ended none of the stages that it has in common with the case, up to '%s': "
                        "%s",
                        other, s->model.stages[common - 1].name, reason.message);
    return status;
}

scree_status scree_after_read(scree_simulation *s, const scree_case *c, const scree_run_options *options,
                              scree_after *after, scree_error *error)
{
    char where[SCREE_CASE_PATH];
    const char *other = options->after;
    scree_case *first = NULL;
    scree_simulation there = {0};
    if (scree_folders_are_same(options->output, other))
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "'%s' holds the run to go on behind: the new one needs a folder of its own", other);
    scree_status status = scree_restart_case(other, &first, error);
    if (status) return status;
    const int64_t common = scree_case_common_stages(c, first, where);
    if (common == 0)
        status = scree_error_set(error, SCREE_ERROR_INPUT,
                                 "the run in '%s' is one of another sample: %s differs; only stages, name, title, "
                                 "output and guards may",
                                 other, where);
    else if (common == s->model.stage_count)
        status =
            scree_error_set(error, SCREE_ERROR_INPUT, "the case has no stage behind those of the run in '%s'", other);
    if (!status) status = scree_simulation_open(first, 1, &there, error);
    if (!status) status = same_models(&s->model, &there.model, error);
    if (!status) status = read_end(s, first, common, other, &after->point, error);
    if (!status)
        (void)snprintf(after->told, sizeof after->told, ", behind stage %s of %s%s%s%s",
                       s->model.stages[s->state.stage.index].name, other, where[0] ? " (" : "", where,
                       where[0] ? " differs)" : "");
    scree_simulation_close(&there);
    scree_case_free(first);
    return status;
}

// ---- the files ---------------------------------------------------------------------------------------------------

/// Errors: reading; what is wrong with `to` shows when it is finished.
static scree_status copy_bytes(FILE *source, FILE *target, const char *from, scree_error *error)
{
    char *piece;
    enum { PIECE = 1 << 20 };
    scree_status status = scree_allocate(&piece, PIECE, 1, error);
    if (status) return status;
    for (size_t length; (length = fread(piece, 1, PIECE, source)) > 0;)
        if (fwrite(piece, 1, length, target) != length) break;
    if (ferror(source)) status = scree_error_set_errno(error, SCREE_ERROR_IO, "cannot read '%s'", from);
    scree_release(&piece);
    return status;
}

static scree_status copy_file(const char *from, const char *to, scree_error *error)
{
    FILE *target, *source = fopen(from, "rbe");
    if (!source) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot read '%s'", from);
    scree_status status = scree_replace_begin(to, &target, error);
    if (!status) {
        status = copy_bytes(source, target, from, error);
        const scree_status finished = scree_replace_finish(to, target, !status, status ? NULL : error);
        if (!status) status = finished;
    }
    (void)fclose(source);
    return status;
}

/// Parts and what run.h5 holds itself; what is not kept goes when the run begins (scree_restart_rewind).
static scree_status copy_snapshots(const char *other, const char *directory, scree_error *error)
{
    char from[4096], to[4096];
    scree_part_list parts = {0};
    scree_status status = scree_run_file_path(other, from, sizeof from, error);
    if (!status) status = scree_run_file_path(directory, to, sizeof to, error);
    if (!status && access(from, F_OK) == 0) status = copy_file(from, to, error);
    if (!status) status = scree_parts_folder_make(directory, error);
    if (!status) status = scree_parts_list(other, SCREE_PART_SNAPSHOT, &parts, error);
    for (size_t k = 0; k < parts.count && !status; k++) {
        status = scree_part_path(other, SCREE_PART_SNAPSHOT, parts.index[k], from, sizeof from, error);
        if (!status) status = scree_part_path(directory, SCREE_PART_SNAPSHOT, parts.index[k], to, sizeof to, error);
        if (!status) status = copy_file(from, to, error);
    }
    scree_part_list_destroy(&parts);
    return status;
}

static scree_status write_rows(const scree_simulation *s, const scree_series *rows, scree_series_writer *writer,
                               scree_error *error)
{
    double *value;
    scree_status status = scree_allocate(&value, s->columns.count, sizeof *value, error);
    for (size_t row = 0; row < (size_t)s->state.stage.samples && !status; row++) {
        for (size_t k = 0; k < s->columns.count; k++) {
            const double *column = scree_series_get(rows, s->columns.column[k].name);
            value[k] = column ? column[row] : NAN;
        }
        status = scree_series_append(writer, value, error);
    }
    scree_release(&value);
    return status;
}

static scree_status copy_series(const scree_simulation *s, const char *other, const char *directory, scree_error *error)
{
    char path[4096];
    scree_series rows = {0};
    scree_series_writer writer = {0};
    scree_status status = scree_path_join(path, sizeof path, other, SCREE_FILE_SERIES, error);
    if (!status) status = scree_series_holds(path, s->state.stage.samples, error);
    if (!status) status = scree_series_read(&rows, path, error);
    if (!status) status = scree_path_join(path, sizeof path, directory, SCREE_FILE_SERIES, error);
    if (!status) status = scree_series_open(&writer, path, s->columns.column, s->columns.count, -1, error);
    if (!status) status = write_rows(s, &rows, &writer, error);
    if (writer.file) {
        const scree_status closed = scree_series_close(&writer, status ? NULL : error);
        if (!status) status = closed;
    }
    scree_series_destroy(&rows);
    return status;
}

scree_status scree_after_copy(const scree_simulation *s, const char *other, const char *directory, scree_error *error)
{
    const scree_status status = copy_series(s, other, directory, error);
    return status ? status : copy_snapshots(other, directory, error);
}
