/// What a run writes. Order after a step: series row, snapshot, checkpoint, so that a checkpoint knows how many rows
/// and snapshots there are and a restart cuts what came later.
#include "run/recorder.h"

#include "base/clock.h"
#include "comm/comm.h"
#include "comm/ranges.h"
#include "state/periodic.h"

#include "io/disk.h"
#include "io/paraview.h"
#include "io/run_directory.h"
#include "io/snapshot.h"
#include "run/loading.h"
#include "run/ranks.h"
#include "run/sample.h"

#include <math.h>
#include <string.h>

/// Wall time between two progress reports, and between two lines about threads, and steps between two looks at the
/// clock.
#define PROGRESS_SECONDS 0.5
#define THREADS_SECONDS  60.0
enum { CLOCK_STEPS = 16 };

static void forward_line(void *user, scree_log_level level, const char *line)
{
    const scree_run_options *options = user;
    if (options->message) options->message(options->user, (int)level, line);
}

static scree_status open_files(scree_recorder *recorder, const scree_simulation *s, bool restart, scree_error *error)
{
    char path[4096];
    const char *directory = recorder->directory;
    const scree_run_options *options = recorder->options;
    scree_status status = scree_path_join(path, sizeof path, directory, SCREE_FILE_LOG, error);
    if (status) return status;
    recorder->log = (scree_log){.file = fopen(path, "a"), .sink = forward_line};
    memcpy(&recorder->log.user, &options, sizeof options);
    if (!recorder->log.file) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot open '%s'", path);
    if ((status = scree_path_join(path, sizeof path, directory, SCREE_FILE_SERIES, error))) return status;
    status = scree_series_open(&recorder->series, path, s->columns.column, s->columns.count,
                               restart ? s->state.stage.samples : -1, error);
    // Names of files that checkpoints count on.
    return status ? status : scree_folder_sync(directory, error);
}

scree_status scree_recorder_open(scree_recorder *recorder, const scree_simulation *s, const scree_run_options *options,
                                 const char *directory, bool restart, scree_error *error)
{
    *recorder = (scree_recorder){.options = options, .directory = directory, .writes = scree_ranks_write()};
    scree_status status = recorder->writes ? open_files(recorder, s, restart, error) : SCREE_OK;
    recorder->clocked[1] = scree_clock_read(CLOCK_PROCESS_CPUTIME_ID);
    recorder->started = recorder->clocked[0] = recorder->last_checkpoint = recorder->last_progress = scree_clock();
    recorder->last_threads = -INFINITY;
    recorder->threads = s->work.threads;
    recorder->progress_step = s->state.step;
    recorder->first_evaluations = recorder->progress_evaluations = recorder->checkpoint_evaluations =
        s->state.evaluations;
    return status;
}

void scree_recorder_close(scree_recorder *recorder)
{
    scree_error ignored;
    if (recorder->series.file) (void)!scree_series_close(&recorder->series, &ignored);
    if (recorder->log.file) fclose(recorder->log.file);
    recorder->log.file = NULL;
}

void scree_recorder_clock(scree_recorder *recorder, scree_simulation *s)
{
    double now = scree_clock(), processor = scree_clock_read(CLOCK_PROCESS_CPUTIME_ID);
    s->state.spent.run += now - recorder->clocked[0];
    s->state.spent.stage += now - recorder->clocked[0];
    s->state.spent.processor += processor - recorder->clocked[1];
    recorder->clocked[0] = now;
    recorder->clocked[1] = processor;
}

scree_status scree_recorder_checkpoint(scree_recorder *recorder, scree_simulation *s, scree_error *error)
{
    scree_recorder_clock(recorder, s);
    // A checkpoint counts rows, so they are on the disk before it is.
    scree_status status = recorder->writes ? scree_series_sync(&recorder->series, error) : SCREE_OK;
    if (!status) status = scree_ranks_checkpoint(s, recorder->directory, recorder->case_checksum, error);
    recorder->last_checkpoint = scree_clock();
    recorder->checkpoint_evaluations = s->state.evaluations;
    return status;
}

/// A snapshot is due at the begin and end of a stage and whenever a loading stage passes another 1/snapshots of its
/// strain.
static bool snapshot_due(const scree_simulation *s)
{
    uint64_t done = s->state.step - s->state.stage.first_step;
    if (s->stage_ended) return true;
    if (!s->sampled || !s->stage->loading) return false;
    if (done == 0) return true;
    uint64_t wanted = (uint64_t)s->model.output.snapshots;
    uint64_t before = done > s->plan.interval ? done - s->plan.interval : 0;
    return done * wanted / s->plan.expected != before * wanted / s->plan.expected;
}

/// The walls of the case as triangles, planes as far as the bodies reach. Where the state is a part all processes call
/// it.
static scree_status picture_walls(const scree_simulation *s, scree_wall_triangles *walls, scree_error *error)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY}, ends[6];
    for (size_t row = 0; row < s->state.count; row++) {
        scree_vector place;
        scree_body_position(&s->state, row, place);
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], place[k] - s->state.row[row].radius);
            high[k] = fmax(high[k], place[k] + s->state.row[row].radius);
        }
    }
    for (int k = 0; k < 6; k++) ends[k] = k < 3 ? -low[k] : high[k - 3];
    scree_comm_maximum(&s->state, ends, 6);
    for (int k = 0; k < 3; k++) low[k] = -ends[k];
    return scree_wall_set_triangles(s->work.wall_set, low, ends + 3, walls, error);
}

/// Whether the Delaunay cells go into the snapshot: process 0 finds them in the whole state.
static bool wants_cells(const scree_simulation *s, bool sound)
{
    return sound && s->model.measure.cells && !scree_cell(&s->state)->directions;
}

/// The files of a snapshot, by this process alone or, with ranges in `info`, by all of them.
static scree_status write_picture(scree_recorder *recorder, scree_simulation *s, scree_snapshot_info *info,
                                  scree_error *error)
{
    const scree_model *model = &s->stage_model;
    scree_cells cells = {0};
    scree_wall_triangles walls = {0};
    scree_status status = picture_walls(s, &walls, error);
    info->walls = &walls;
    if (!status && wants_cells(s, info->restartable)) {
        status = scree_cells_measure(model, &s->state, &s->table, &cells, error);
        // A few bodies, or bodies on a line, have no triangulation and so no cells.
        if (!status) info->cells = &cells;
        if (status == SCREE_ERROR_GUARD) status = SCREE_OK;
    }
    // What goes on from a snapshot has written it.
    scree_recorder_clock(recorder, s);
    s->state.stage.snapshots++;
    if (!status) status = scree_snapshot_write(recorder->directory, model, &s->state, &s->table, info, error);
    if (!status && s->model.output.paraview) status = scree_ranks_gather_contacts(s, "ParaView files", error);
    if (!status && s->model.output.paraview && scree_ranks_acts(s))
        status = scree_paraview_write(recorder->directory, model, &s->state, &s->table, info, error);
    scree_cells_destroy(&cells);
    scree_wall_triangles_destroy(&walls);
    return status;
}

/// `sound`: the guards have passed the state; else it is only shown, by the process that writes.
static scree_status write_snapshot(scree_recorder *recorder, scree_simulation *s, bool sound, scree_error *error)
{
    scree_ranges ranges = {0};
    scree_snapshot_info info = {.index = s->state.stage.snapshots,
                                .time = scree_state_time(&s->state),
                                .axial_strain = scree_loading_strain(s),
                                .stage = s->stage->name,
                                .stage_name = s->model.stages[s->state.stage.index].name,
                                .restartable = sound,
                                .case_checksum = recorder->case_checksum};
    const bool together = sound && !wants_cells(s, sound);
    scree_status status = sound && !together ? scree_ranks_gather_contacts(s, "cells of snapshots", error) : SCREE_OK;
    if (!status && sound) status = scree_ranks_save_contacts(s, error);
    if (!status && together) status = scree_ranges_open(&s->state, &s->work, &ranges, error);
    if (together) info.ranges = &ranges;
    if (!status && (together || recorder->writes))
        status = write_picture(recorder, s, &info, error);
    else
        s->state.stage.snapshots++;
    scree_ranges_close(&ranges);
    return status || !sound ? status : scree_ranks_return(s, error);
}

scree_status scree_recorder_last_look(scree_recorder *recorder, scree_simulation *s, scree_error *error)
{
    int64_t index = s->state.stage.snapshots;
    scree_status status = scree_contact_table_build(&s->stage_model, &s->state, &s->work, &s->table, error);
    if (!status) status = write_snapshot(recorder, s, false, error);
    if (!status)
        scree_log_write(&recorder->log, SCREE_LOG_INFO, "snapshot %lld shows what the guard stopped", (long long)index);
    return status;
}

/// Ticks of this and the following loading stages that are still to come; NAN when a stage has no planned end.
static double ticks_left(const scree_simulation *s)
{
    if (!s->plan.expected) return NAN;
    double left = (double)s->plan.expected - (double)(s->state.step - s->state.stage.first_step);
    if (left < 0) return NAN; // stresses end it
    for (int64_t k = s->state.stage.index + 1; k < s->model.stage_count; k++) {
        const scree_config_stage *stage = &s->model.stages[k];
        double (*duration)(const scree_model *model, const void *own) = scree_modules[stage->kind]->stage->duration;
        left += duration ? duration(&s->model, stage->own) / s->state.tick : NAN;
    }
    return left;
}

static void report_progress(scree_recorder *recorder, const scree_simulation *s, double now)
{
    double passed = now - recorder->last_progress;
    double steps = (double)(s->state.evaluations - recorder->progress_evaluations);
    double ticks = (double)(s->state.step - recorder->progress_step);
    recorder->last_progress = now;
    recorder->progress_step = s->state.step;
    recorder->progress_evaluations = s->state.evaluations;
    if (!recorder->options->progress || !s->stage || s->stage_ended) return;
    scree_progress progress = {.stage = s->stage->name,
                               .fraction = s->stage->fraction ? s->stage->fraction(s) : NAN,
                               .time = scree_state_time(&s->state),
                               .strain = scree_loading_strain(s),
                               .particle_steps_per_second = (double)scree_state_total(&s->state) * steps / passed,
                               .seconds_left = ticks_left(s) * passed / ticks};
    recorder->options->progress(recorder->options->user, &progress);
}

/// Says when other programs leave room for fewer threads, or for more again.
static void report_threads(scree_recorder *recorder, const scree_simulation *s, double now)
{
    int kept = s->work.size.kept;
    if (kept == 0 || kept == recorder->threads || now - recorder->last_threads < THREADS_SECONDS) return;
    scree_log_write(&recorder->log, SCREE_LOG_INFO, "%s: %d of %d threads from here on",
                    kept < recorder->threads ? "other programs keep the processors busy" : "processors are free again",
                    kept, s->work.threads);
    recorder->threads = kept;
    recorder->last_threads = now;
}

static bool checkpoint_due(const scree_recorder *recorder, const scree_simulation *s, double now)
{
    const scree_config_output *output = &s->model.output;
    uint64_t every = (uint64_t)output->checkpoint_steps;
    return (every > 0 && s->state.evaluations - recorder->checkpoint_evaluations >= every) ||
           now - recorder->last_checkpoint > output->checkpoint_interval;
}

/// By its kind, and by the name that the case gives it, if any.
static void log_end(scree_recorder *recorder, const scree_simulation *s)
{
    const char *kind = s->stage->name, *name = scree_stage_config(s)->name;
    const bool named = strncmp(name, kind, strlen(kind)) != 0;
    scree_log_write(&recorder->log, SCREE_LOG_INFO, "stage %s%s%s%s ended at step %llu, time %.6g s: %s", kind,
                    named ? " (" : "", named ? name : "", named ? ")" : "", (unsigned long long)s->state.step,
                    scree_state_time(&s->state), s->reason);
}

scree_status scree_recorder_follow(scree_recorder *recorder, scree_simulation *s, scree_error *error)
{
    scree_status status = SCREE_OK;
    if (s->warning[0]) scree_log_write(&recorder->log, SCREE_LOG_WARNING, "%s", s->warning);
    s->warning[0] = 0;
    if (s->sampled) {
        if (recorder->writes) status = scree_series_append(&recorder->series, s->sample, error);
        if (status) return status;
        s->state.stage.samples++;
        scree_quasistatic_follow(&recorder->watch, s, &recorder->log);
    }
    if (snapshot_due(s) && (status = write_snapshot(recorder, s, true, error))) return status;
    if (s->stage_ended) log_end(recorder, s);
    if (s->state.evaluations % CLOCK_STEPS != 0 && !s->stage_ended) return SCREE_OK;
    double now = scree_clock();
    // Clocks differ: that of the process which writes counts.
    const double due = scree_ranks_most(recorder->writes && checkpoint_due(recorder, s, now));
    if (s->stage_ended || due > 0) status = scree_recorder_checkpoint(recorder, s, error);
    if (recorder->writes && now - recorder->last_progress > PROGRESS_SECONDS) {
        report_progress(recorder, s, now);
        report_threads(recorder, s, now);
    }
    return status;
}
