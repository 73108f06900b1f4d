/// The driver behind `scree run`: a case into a run directory, from the begin or from a checkpoint.
#include "base/clock.h"
#include "base/handle.h"
#include "case/case.h"
#include "comm/comm.h"
#include "io/disk.h"
#include "io/run_directory.h"
#include "io/run_file.h"
#include "io/snapshot.h"
#include "run/after.h"
#include "run/ranks.h"
#include "run/recorder.h"
#include "run/restart.h"
#include "run/results.h"
#include "search/neighbours.h"
#include "shape/wall_set.h"
#include "source/room.h"
#include "view/font.h"
#include "view/plot.h"

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

/// Signal that asks to stop, 0: none. Processes ask each other in every 16th step.
static int asked_to_stop(const scree_run_options *options, const scree_simulation *s)
{
    enum { STEPS = 16 };
    const double own = options->stop ? *options->stop : 0;
    if (scree_comm_size() == 1) return (int)own;
    return s->state.evaluations % STEPS == 0 ? (int)scree_ranks_most(own) : 0;
}

/// A step that is refused has not begun. All processes write, so one that cannot ends the others.
static void save_before_refusal(scree_recorder *recorder, scree_simulation *s)
{
    scree_error second;
    if (scree_recorder_checkpoint(recorder, s, &second))
        scree_ranks_fail(recorder->options, &second);
    else
        scree_log_write(&recorder->log, SCREE_LOG_INFO, "checkpoint before the step that is refused");
}

/// Steps until the case ends, somebody asks to stop, or something fails.
static scree_status imposed(scree_recorder *recorder, scree_simulation *s, scree_error *error)
{
    double begin = scree_clock();
    scree_status status = SCREE_OK;
    scree_error second;
    int stop;
    while (!status && s->state.stage.index < s->model.stage_count) {
        if ((stop = asked_to_stop(recorder->options, s))) {
            status = scree_recorder_checkpoint(recorder, s, error);
            if (!status)
                status = scree_error_set(error, SCREE_INTERRUPTED,
                                         "interrupted at step %llu by signal %d (%s); continue with "
                                         "`scree run --restart %s`",
                                         (unsigned long long)s->state.step, stop, strsignal(stop), recorder->directory);
            break;
        }
        status = scree_simulation_step(s, error);
        if (status && s->whole) save_before_refusal(recorder, s);
        if (!status) status = scree_recorder_follow(recorder, s, error);
    }
    recorder->stepping = scree_clock() - begin;
    // What is left of a run is told of the whole state, by one process.
    if (status != SCREE_ERROR_IO && scree_ranks_gather(s, "results", &second))
        scree_ranks_fail(recorder->options, &second);
    // All other reasons are found by all processes, in the same step.
    if (status == SCREE_ERROR_IO && error) scree_ranks_fail(recorder->options, error);
    if (!status || status == SCREE_INTERRUPTED) scree_rank_counts_join(s, recorder->stepping, &recorder->counts);
    return status;
}

/// A guard has stopped the run: what it had is kept for inspection, as a snapshot. There is no checkpoint of a step
/// that went wrong: what goes on from the last one, which all guards have passed, stops here again, unless the limit is
/// another one.
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

/// A line in log.txt alone: what ends the run comes back as its error, and is printed as that.
static void log_quietly(const scree_recorder *recorder, scree_log_level level, const char *line)
{
    scree_log log = recorder->log;
    log.sink = NULL;
    scree_log_write(&log, level, "%s", line);
}

/// Results of a run that has not reached its end.
static void leave(scree_recorder *recorder, scree_simulation *s, const scree_error *error)
{
    scree_error second;
    scree_summary *summary;
    bool interrupted = error->status == SCREE_INTERRUPTED;
    scree_rank_counts_log(&recorder->counts, &recorder->log);
    if (interrupted)
        log_quietly(recorder, SCREE_LOG_INFO, error->message);
    else
        save_after_failure(recorder, s, error);
    if (error->status == SCREE_ERROR_IO) return;
    scree_status status = scree_results_collect(recorder, s, &summary, &second);
    if (!status) status = scree_results_write(recorder, summary, interrupted ? "interrupted" : "stopped", &second);
    if (status) scree_log_write(&recorder->log, SCREE_LOG_ERROR, "no results: %s", second.message);
    scree_summary_destroy(summary);
}

/// Figures are drawn from the files, after everything else is safe; a run is not lost because of a figure. When
/// somebody asks to stop meanwhile, the run counts as interrupted: a restart draws them anew.
static scree_status draw_figures(scree_recorder *recorder, const scree_simulation *s, scree_error *error)
{
    scree_error problem;
    scree_status status = SCREE_OK;
    char said[300];
    const volatile int *stop = recorder->options->stop;
    if (!recorder->options->figures || !s->model.output.figures) return SCREE_OK;
    if (!stop || !*stop) status = scree_plot_draw(recorder->directory, NULL, NULL, NULL, &problem);
    if (stop && *stop)
        return scree_error_set(error, SCREE_INTERRUPTED,
                               "interrupted while figures were drawn, all else is written; draw them with "
                               "`scree run --restart %s`",
                               recorder->directory);
    if (status) scree_log_write(&recorder->log, SCREE_LOG_WARNING, "figures: %s", problem.message);
    if (scree_font_missing(said, sizeof said)) scree_log_write(&recorder->log, SCREE_LOG_WARNING, "%s", said);
    return SCREE_OK;
}

/// Says when tangential springs were given more than the documented share, and by what: by the stiffening of their
/// contacts, or by strains of the bodies.
static void warn_of_springs(scree_recorder *recorder, const scree_simulation *s)
{
    double share = scree_results_stiffness_share(&s->state);
    // Of laws of areas the row is the work of their normal force, and a result of its own (law_work).
    if (share <= SCREE_STIFFNESS_SHARE || scree_model_traits(&s->model)->areas) return;
    const bool strained = s->state.stretch, corrected = s->model.laws[0].number[SCREE_LAW_CORRECTED] > 0;
    const char *remedy = NULL;
    for (int k = 0; k < scree_model_law_count(&s->model) && !remedy && !strained; k++)
        remedy = scree_law_get(s->model.laws[k].law)->against_stiffening;
    if (strained && !corrected)
        remedy = "`contact.tangential: corrected`, where strains stretch tangential springs, too,";
    scree_log_write(&recorder->log, SCREE_LOG_WARNING,
                    "%.2g %% of the energy turned over was given to tangential springs by %s, which nothing paid for "
                    "(stiffness_share; more than %g %%)%s%s%s",
                    100 * share,
                    !strained   ? "the stiffening of their contacts"
                    : corrected ? "normals that turn past strained bodies"
                                : "strains of the bodies that do not stretch them, as published",
                    100 * SCREE_STIFFNESS_SHARE, remedy ? ": " : "", remedy ? remedy : "",
                    remedy ? " keeps springs from that" : "");
}

/// The end of a run that has reached it. `done` is the last thing that is written: what ends before is gone through
/// again by a restart, without a step.
static scree_status complete(scree_recorder *recorder, scree_simulation *s, scree_error *error)
{
    scree_summary *summary;
    scree_notes notes = {0};
    warn_of_springs(recorder, s);
    scree_ranks_log(s, &recorder->log);
    scree_rank_counts_log(&recorder->counts, &recorder->log);
    scree_status status = scree_results_collect(recorder, s, &summary, error);
    if (!status) status = scree_results_write(recorder, summary, "finishing", error);
    if (!status) status = scree_run_file_finish(recorder->directory, &notes, error);
    scree_notes_visit(&notes, log_note, &recorder->log);
    if (!status) status = draw_figures(recorder, s, error);
    if (!status) status = scree_results_write(recorder, summary, "done", error);
    scree_summary_destroy(summary);
    if (status)
        log_quietly(recorder, status == SCREE_INTERRUPTED ? SCREE_LOG_INFO : SCREE_LOG_ERROR, error->message);
    else
        scree_log_write(&recorder->log, SCREE_LOG_INFO, "done: %llu steps in %.1f s", (unsigned long long)s->state.step,
                        scree_clock() - recorder->started);
    return status;
}

/// What the files of meshes held.
static void log_meshes(const scree_recorder *recorder, const scree_wall_set *wall_set)
{
    scree_log log = recorder->log;
    for (int k = 0; wall_set && k < wall_set->count; k++) {
        const scree_surface *surface = &wall_set->surface[k];
        const scree_mesh *mesh = &surface->mesh;
        if (mesh->triangle_count == 0) continue;
        scree_log_write(
            &log, SCREE_LOG_INFO, "wall %s: %zu triangles, %zu edges, %zu vertices; dropped %zu triangles without area",
            surface->config->name, mesh->triangle_count, mesh->edge_count, mesh->vertex_count, mesh->degenerate);
    }
}

/// Common part of a new and a restarted run: `s` is open and at the point where stepping begins, the folder is locked.
/// restarted: how, for the log; NULL: the run is new. notes: what was found before, for the log.
static scree_status record(scree_simulation *s, const scree_run_options *options, const scree_folder_lock *lock,
                           uint64_t checksum, const char *restarted, const scree_notes *notes, scree_error *error)
{
    scree_recorder recorder;
    scree_status status = scree_ranks_check_folder(options->output, error);
    if (status) return status;
    status = scree_recorder_open(&recorder, s, options, options->output, restarted != NULL, error);
    status = scree_comm_agree(status, error);
    recorder.case_checksum = checksum;
    if (!status) {
        const int processes = scree_comm_size();
        scree_log_write(&recorder.log, SCREE_LOG_INFO, "%s; case %s, %d thread%s%s", scree_version(), s->model.name,
                        s->work.threads, s->work.threads == 1 ? "" : "s", restarted ? restarted : "");
        if (processes > 1)
            scree_log_write(&recorder.log, SCREE_LOG_INFO, "%d processes, %d of them on this machine", processes,
                            scree_comm_neighbours());
        scree_notes_visit(notes, log_note, &recorder.log);
        if (lock->unsupported)
            scree_log_write(&recorder.log, SCREE_LOG_WARNING,
                            "this file system has no locks: see to it that nothing else writes into the folder");
        if (restarted)
            scree_log_write(&recorder.log, SCREE_LOG_INFO, "goes on from step %llu, time %.6g s",
                            (unsigned long long)s->state.step, scree_state_time(&s->state));
        scree_log_write(&recorder.log, SCREE_LOG_INFO, "step %.4g s (N_S %llu, critical %.4g s), phi %.4g, psi %.4g",
                        s->model.step, (unsigned long long)s->model.largest_step, s->model.critical_step, s->model.phi,
                        s->model.psi);
        if (s->model.step * (double)s->model.largest_step > s->model.critical_step)
            scree_log_write(&recorder.log, SCREE_LOG_WARNING,
                            "the step is above the estimated critical one, which guard.stability: warn allows");
        if (!restarted) {
            scree_quasistatic_warn(&s->model, &recorder.log);
            scree_source_warn(&s->model, s->work.wall_set, &recorder.log);
        }
        log_meshes(&recorder, s->work.wall_set);
        status = imposed(&recorder, s, error);
        if (status && recorder.writes) leave(&recorder, s, error);
        if (!status && recorder.writes) status = complete(&recorder, s, error);
    }
    scree_recorder_close(&recorder);
    return scree_comm_agree(status, error);
}

/// Brings an open simulation that has a state to where stepping begins, its folder too. `point`: where the state is.
static scree_status take_up(scree_simulation *s, const char *directory, uint64_t checksum,
                            const scree_restart_point *point, scree_notes *notes, scree_error *error)
{
    scree_status status = s->state.part ? scree_ranks_place(s, error) : SCREE_OK;
    // Samples, checkpoints and the checksum may read the contacts before the first step.
    if (!status && scree_state_total(&s->state) > 0)
        status = scree_neighbours_refresh(&s->model, &s->state, &s->work, error);
    if (!status && s->state.stage.counter >= 0) status = scree_stage_enter(s, true, error);
    status = scree_comm_agree(status, error);
    if (!status) status = scree_restart_rewind(s, directory, checksum, point, notes, error);
    return scree_comm_agree(status, error);
}

static scree_status make_folder(const scree_case *c, const scree_run_options *options, scree_notes *notes,
                                scree_error *error)
{
    scree_error note = {0};
    scree_status status = scree_run_directory_create(options->output, options->force, &note);
    if (status && error) *error = note;
    if (!status) status = save_case(options->output, c, error);
    if (!status && note.message[0]) scree_notes_add(notes, "%s", note.message);
    return status;
}

/// Opens the simulation, in all processes the same one.
static scree_status open_case(const scree_case *c, const scree_run_options *options, scree_simulation *s,
                              uint64_t *checksum, scree_error *error)
{
    scree_status status = scree_simulation_open(c, options->threads, s, error);
    s->work.parts_by_time = options->balance_by_time;
    if (!status) status = scree_ranks_check(s, error);
    if (!status) status = scree_case_checksum(c, checksum, error);
    return scree_ranks_open(*checksum, status, error);
}

scree_status scree_run(const scree_case *c, const scree_run_options *options, scree_error *error)
{
    scree_handle_check(c, "a case");
    uint64_t checksum = 0;
    scree_simulation s;
    scree_folder_lock lock = {0};
    scree_notes notes = {0};
    scree_after after;
    const char *other = options->after;
    // Everything that can be wrong with the case is found before anything is written.
    scree_status status = open_case(c, options, &s, &checksum, error);
    if (!status && other) status = scree_comm_agree(scree_after_read(&s, c, options, &after, error), error);
    const bool writes = scree_ranks_write();
    if (!status && writes) status = scree_run_directory_lock(options->output, &lock, error);
    if (!status && writes) status = make_folder(c, options, &notes, error);
    if (!status && writes && other) status = scree_after_copy(&s, other, options->output, error);
    status = scree_comm_agree(status, error);
    if (!status && other) status = take_up(&s, options->output, checksum, &after.point, &notes, error);
    if (!status) status = record(&s, options, &lock, checksum, other ? after.told : NULL, &notes, error);
    scree_folder_lock_release(&lock);
    scree_simulation_close(&s);
    return status;
}

static scree_status restart(const char *directory, const scree_run_options *options, const scree_folder_lock *lock,
                            scree_error *error)
{
    uint64_t checksum = 0;
    scree_case *c = NULL;
    scree_simulation s = {0};
    scree_status status = scree_comm_agree(scree_restart_case(directory, &c, error), error);
    if (status) return status;
    status = open_case(c, options, &s, &checksum, error);
    scree_notes notes = {0};
    scree_restart_point point;
    if (!status) status = scree_restart_read(&s, directory, options->from, checksum, &point, &notes, error);
    status = scree_comm_agree(status, error);
    if (!status) status = take_up(&s, directory, checksum, &point, &notes, error);
    if (!status) status = record(&s, options, lock, checksum, ", restarted", &notes, error);
    scree_simulation_close(&s);
    scree_case_free(c);
    return status;
}

scree_status scree_restart(const char *directory, const scree_run_options *options, scree_error *error)
{
    scree_folder_lock lock = {0};
    scree_run_options here = *options;
    here.output = directory;
    scree_status status = SCREE_OK;
    if (scree_ranks_write()) status = scree_folder_lock_take(&lock, directory, "scree run --restart", error);
    status = scree_comm_agree(status, error);
    if (!status) status = restart(directory, &here, &lock, error);
    scree_folder_lock_release(&lock);
    return status;
}
