/// The driver behind `scree run`: a case into a run directory, from the begin or from a checkpoint.
#include "io/disk.h"
#include "io/run_directory.h"
#include "io/snapshot.h"
#include "run/recorder.h"
#include "run/restart.h"
#include "run/results.h"
#include "search/neighbours.h"
#include "shape/container.h"

#include <string.h>

static scree_status save_case(const char *directory, const scree_case *c, scree_error *error)
{
    char path[4096];
    FILE *file;
    scree_status status = scree_path_join(path, sizeof path, directory, SCREE_FILE_CASE, error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (status) return status;
    status = scree_case_write(c, file, error);
    scree_status finished = scree_replace_finish(path, file, !status, status ? NULL : error);
    if (!status) status = finished;
    // The name of the folder itself.
    if (!status) status = scree_path_join(path, sizeof path, directory, "..", error);
    return status ? status : scree_folder_sync(path, error);
}

/// Steps until the case ends, somebody asks to stop, or something fails.
static scree_status drive(scree_recorder *recorder, scree_simulation *s, scree_error *error)
{
    double begin = scree_clock();
    scree_status status = SCREE_OK;
    const volatile int *stop = recorder->options->stop;
    while (!status && s->state.stage.index < s->model.config->stage_count) {
        if (stop && *stop) {
            status = scree_recorder_checkpoint(recorder, s, error);
            if (!status)
                status = scree_error_set(error, SCREE_INTERRUPTED,
                                         "interrupted at step %llu; continue with "
                                         "`scree run --restart %s`",
                                         (unsigned long long)s->state.step, recorder->directory);
            break;
        }
        status = scree_simulation_step(s, error);
        if (!status) status = scree_recorder_follow(recorder, s, error);
    }
    recorder->stepping = scree_clock() - begin;
    return status;
}

/// A guard has stopped the run: what it had is kept for inspection, as a snapshot. There is no checkpoint: what goes on
/// from the last one, which all guards have passed, stops here again, unless the limit is another one.
static void save_after_failure(scree_recorder *recorder, scree_simulation *s, const scree_error *error)
{
    scree_error second;
    scree_log_write(&recorder->log, SCREE_LOG_ERROR, "%s", error->message);
    if (error->status != SCREE_ERROR_GUARD || s->state.count == 0 || !s->stage) return;
    if (scree_recorder_last_look(recorder, s, &second))
        scree_log_write(&recorder->log, SCREE_LOG_ERROR, "no snapshot of what the guard stopped: %s", second.message);
}

static void log_note(void *log, const char *line)
{
    scree_log_write(log, SCREE_LOG_WARNING, "%s", line);
}

static scree_status finish(scree_recorder *recorder, scree_simulation *s, scree_status status, scree_error *error)
{
    scree_error second;
    if (status && status != SCREE_INTERRUPTED) save_after_failure(recorder, s, error);
    if (status == SCREE_ERROR_IO) return status;
    scree_status written = scree_results_write(recorder, s, status, status ? &second : error);
    scree_notes notes = {0};
    if (!written && !status) written = scree_run_file_finish(recorder->directory, &notes, error);
    scree_notes_visit(&notes, log_note, &recorder->log);
    if (!status) status = written;
    if (!status)
        scree_log_write(&recorder->log, SCREE_LOG_INFO, "done: %llu steps in %.1f s", (unsigned long long)s->state.step,
                        scree_clock() - recorder->started);
    return status;
}

/// Figures are drawn from the files, after everything else is safe; a run is not lost because of a figure.
static void draw_figures(const scree_recorder *recorder, const scree_simulation *s)
{
    scree_error error;
    scree_log log = recorder->log;
    if (!recorder->options->figures || !s->model.config->output.figures) return;
    if (scree_plot(recorder->directory, NULL, NULL, &error))
        scree_log_write(&log, SCREE_LOG_WARNING, "figures: %s", error.message);
}

/// What the files of meshes held.
static void log_meshes(const scree_recorder *recorder, const scree_container *container)
{
    scree_log log = recorder->log;
    for (int k = 0; container && k < container->count; k++) {
        const scree_surface *surface = &container->surface[k];
        const scree_mesh *mesh = &surface->mesh;
        if (mesh->triangle_count == 0) continue;
        scree_log_write(
            &log, SCREE_LOG_INFO, "wall %s: %zu triangles, %zu edges, %zu vertices; dropped %zu triangles without area",
            surface->config->name, mesh->triangle_count, mesh->edge_count, mesh->vertex_count, mesh->degenerate);
    }
}

/// Common part of a new and a restarted run: `s` is open and at the point where stepping begins. `restarted` is NULL
/// for a new run, else what was found before it went on.
static scree_status record(scree_simulation *s, const scree_run_options *options, const char *directory,
                           uint64_t checksum, const scree_notes *restarted, scree_error *error)
{
    scree_recorder recorder;
    scree_status status = scree_recorder_open(&recorder, s, options, directory, restarted, error);
    recorder.case_checksum = checksum;
    if (!status) {
        scree_log_write(&recorder.log, SCREE_LOG_INFO, "%s; case %s, %d thread%s%s", scree_version(),
                        s->model.config->name, s->work.threads, s->work.threads == 1 ? "" : "s",
                        restarted ? ", restarted" : "");
        if (restarted) scree_notes_visit(restarted, log_note, &recorder.log);
        if (restarted)
            scree_log_write(&recorder.log, SCREE_LOG_INFO, "goes on from step %llu, time %.6g s",
                            (unsigned long long)s->state.step, scree_state_time(&s->state));
        scree_log_write(&recorder.log, SCREE_LOG_INFO, "step %.4g s (N_S %llu, critical %.4g s), phi %.4g, psi %.4g",
                        s->model.step, (unsigned long long)s->model.largest_step, s->model.critical_step, s->model.phi,
                        s->model.psi);
        log_meshes(&recorder, s->work.container);
        status = drive(&recorder, s, error);
        status = finish(&recorder, s, status, error);
        if (!status) draw_figures(&recorder, s);
    }
    scree_recorder_close(&recorder);
    return status;
}

scree_status scree_run(const scree_case *c, const scree_run_options *options, scree_error *error)
{
    uint64_t checksum;
    scree_simulation s;
    // Everything that can be wrong with the case is found before anything is written.
    scree_status status = scree_simulation_open(c, options->threads, &s, error);
    if (!status) status = scree_case_checksum(c, &checksum, error);
    if (!status) status = scree_run_directory_create(options->output, options->force, error);
    if (!status) status = save_case(options->output, c, error);
    if (!status) status = record(&s, options, options->output, checksum, NULL, error);
    scree_simulation_close(&s);
    return status;
}

scree_status scree_restart(const char *directory, const scree_run_options *options, scree_error *error)
{
    uint64_t checksum;
    scree_case *c = NULL;
    scree_simulation s = {0};
    scree_status status = scree_restart_case(directory, &c, error);
    if (status) return status;
    status = scree_simulation_open(c, options->threads, &s, error);
    if (!status) status = scree_case_checksum(c, &checksum, error);
    scree_notes notes = {0};
    scree_restart_point point;
    if (!status) status = scree_restart_read(&s, directory, options->from, checksum, &point, &notes, error);
    // Samples, checkpoints and the checksum may read the contacts before the first step.
    if (!status && s.state.count > 0) status = scree_neighbours_refresh(&s.model, &s.state, &s.work, error);
    if (!status && s.state.stage.counter >= 0) status = scree_stage_enter(&s, true, error);
    if (!status) status = scree_restart_rewind(&s, directory, checksum, &point, &notes, error);
    if (!status) status = record(&s, options, directory, checksum, &notes, error);
    scree_simulation_close(&s);
    scree_case_free(c);
    return status;
}
