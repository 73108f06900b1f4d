/// The driver behind `scree run`: a case into a run directory, from the begin or from a checkpoint.
#include "io/run_directory.h"
#include "io/snapshot.h"
#include "run/recorder.h"
#include "run/results.h"
#include "search/neighbours.h"
#include "shape/container.h"

#include <stdlib.h>
#include <string.h>

/// FNV-1a (Fowler, Noll, Vo) of the resolved case text: a checkpoint belongs to one case. Writes the text too.
static scree_status case_text(const scree_case *c, char **text, size_t *length, uint64_t *checksum, scree_error *error)
{
    FILE *memory = open_memstream(text, length);
    if (!memory) return scree_error_set_memory(error, 4096);
    scree_status status = scree_case_write(c, memory, error);
    // Without memory for its buffer the stream closes well, and there is no text.
    bool whole = ferror(memory) == 0;
    whole = fclose(memory) == 0 && whole && *text;
    if (!whole && !status) status = scree_error_set_memory(error, 4096);
    *checksum = UINT64_C(0xcbf29ce484222325);
    for (size_t k = 0; !status && k < *length; k++)
        *checksum = (*checksum ^ (unsigned char)(*text)[k]) * UINT64_C(0x100000001b3);
    return status;
}

static scree_status save_case(const char *directory, const char *text, size_t length, scree_error *error)
{
    char path[4096];
    FILE *file;
    scree_status status = scree_path_join(path, sizeof path, directory, SCREE_FILE_CASE, error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (status) return status;
    bool whole = fwrite(text, 1, length, file) == length;
    return scree_replace_finish(path, file, whole, error);
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

/// A guard has stopped the run: what it had is kept for inspection.
static void save_after_failure(scree_recorder *recorder, scree_simulation *s, const scree_error *error)
{
    scree_error second;
    scree_log_write(&recorder->log, SCREE_LOG_ERROR, "%s", error->message);
    if (error->status != SCREE_ERROR_GUARD || s->state.count == 0) return;
    if (scree_recorder_checkpoint(recorder, s, &second))
        scree_log_write(&recorder->log, SCREE_LOG_ERROR, "no checkpoint: %s", second.message);
}

static scree_status finish(scree_recorder *recorder, scree_simulation *s, scree_status status, scree_error *error)
{
    scree_error second;
    if (status && status != SCREE_INTERRUPTED) save_after_failure(recorder, s, error);
    if (status == SCREE_ERROR_IO) return status;
    scree_status written = scree_results_write(recorder, s, status, status ? &second : error);
    if (!written && !status) written = scree_run_file_finish(recorder->directory, error);
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
/// for a new run, else a warning for the log, empty when there is none.
static scree_status record(scree_simulation *s, const scree_run_options *options, const char *directory,
                           uint64_t checksum, const char *restarted, scree_error *error)
{
    scree_recorder recorder;
    scree_status status = scree_recorder_open(&recorder, s, options, directory, restarted, error);
    recorder.case_checksum = checksum;
    if (!status) {
        scree_log_write(&recorder.log, SCREE_LOG_INFO, "%s; case %s, %d thread%s%s", scree_version(),
                        s->model.config->name, s->work.threads, s->work.threads == 1 ? "" : "s",
                        restarted ? ", restarted" : "");
        if (restarted && restarted[0]) scree_log_write(&recorder.log, SCREE_LOG_WARNING, "%s", restarted);
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
    char *text = NULL;
    size_t length;
    uint64_t checksum;
    scree_simulation s;
    // Everything that can be wrong with the case is found before anything is written.
    scree_status status = scree_simulation_open(c, options->threads, &s, error);
    if (!status) status = case_text(c, &text, &length, &checksum, error);
    if (!status) status = scree_run_directory_create(options->output, options->force, error);
    if (!status) status = save_case(options->output, text, length, error);
    if (!status) status = record(&s, options, options->output, checksum, NULL, error);
    scree_simulation_close(&s);
    free(text);
    return status;
}

/// Reads the case of a run directory; all its problems fit into one error, the first.
static scree_status read_case(const char *directory, scree_case **c, scree_error *error)
{
    char path[4096];
    scree_problems *problems = NULL;
    scree_case_options plain = {0};
    scree_status status = scree_path_join(path, sizeof path, directory, SCREE_FILE_CASE, error);
    if (status) return status;
    status = scree_case_read(path, &plain, c, &problems);
    if (status && scree_problems_count(problems) > 0) *error = *scree_problems_get(problems, 0);
    scree_problems_free(problems);
    return status;
}

scree_status scree_restart(const char *directory, const scree_run_options *options, scree_error *error)
{
    char *text = NULL;
    size_t length;
    uint64_t checksum;
    scree_case *c = NULL;
    scree_simulation s = {0};
    scree_status status = read_case(directory, &c, error);
    if (status) return status;
    status = scree_simulation_open(c, options->threads, &s, error);
    if (!status) status = case_text(c, &text, &length, &checksum, error);
    // A message without a failure tells that an older checkpoint had to serve.
    scree_error note = {0};
    if (!status && (status = scree_checkpoint_read(directory, s.model.dimension, &s.state, checksum, &note)))
        *error = note;
    // Samples, checkpoints and the checksum may read the contacts before the first step.
    if (!status && s.state.count > 0) status = scree_neighbours_refresh(&s.model, &s.state, &s.work, error);
    if (!status && s.state.stage.counter >= 0) status = scree_stage_enter(&s, true, error);
    if (!status) status = scree_snapshots_truncate(directory, s.state.stage.snapshots, error);
    if (!status) status = record(&s, options, directory, checksum, note.message, error);
    scree_simulation_close(&s);
    scree_case_free(c);
    free(text);
    return status;
}
