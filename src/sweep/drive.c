/// Running the members of a sweep: as many processes at the same time as asked for, started in the order of their
/// numbers. A member is a run of a case file that holds everything, so its result depends neither on the order nor on
/// the others. One that crashes, runs out of memory or is stopped by a guard takes nothing else with it.
#include "base/handle.h"
#include "sweep/process.h"
#include "sweep/results.h"
#include "sweep/several.h"
#include "sweep/share.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/processor.h"
#include "base/program.h"
#include "io/run_directory.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST_JOBS = 4096, PAUSE_NANOSECONDS = 20 * 1000 * 1000 };

/// A process that runs a member.
typedef struct job {
    pid_t process;
    size_t member;
    int log;
    double began;
} job;

typedef struct drive {
    const scree_sweep *sweep;
    const scree_sweep_options *options;
    scree_member_state *state; ///< of each member
    size_t *leader;            ///< whose sample each goes on with; itself: its own
    bool *begun;               ///< in this call
    job *job;
    size_t jobs, running;
    size_t done, failed, left; ///< left: to be run in this call, and not begun yet
    double seconds;            ///< of members that ended in this call
    size_t ended;
    size_t killed; ///< died in this call and can be continued
    bool interrupted;
    scree_folder_lock lock; ///< on members/, of a sweep that runs all of them
    scree_status status;    ///< of what keeps the sweep from going on
    scree_error *error;
} drive;

static void tell(const drive *d, int level, const char *format, ...) SCREE_PRINTF(3, 4);
static void tell(const drive *d, int level, const char *format, ...)
{
    char line[2048];
    va_list arguments;
    if (!d->options->message) return;
    va_start(arguments, format);
    (void)vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    d->options->message(d->options->user, level, line);
}

static void report(const drive *d)
{
    if (!d->options->progress) return;
    double mean = d->ended > 0 ? d->seconds / (double)d->ended : NAN;
    scree_sweep_progress progress = {.members = d->sweep->member_count,
                                     .done = d->done,
                                     .failed = d->failed,
                                     .running = d->running,
                                     .seconds_left = mean * ceil((double)d->left / (double)d->jobs + 0.5)};
    d->options->progress(d->options->user, &progress);
}

static void fail(drive *d, scree_status status, const scree_error *error)
{
    if (d->status || !status) return;
    d->status = status;
    if (d->error) *d->error = *error;
}

/// Writes the case of a member, which its process reads.
static scree_status write_case(const char *path, const char *text, scree_error *error)
{
    FILE *file;
    scree_status status = scree_replace_begin(path, &file, error);
    if (status) return status;
    bool whole = fputs(text, file) >= 0;
    return scree_replace_finish(path, file, whole, error);
}

enum { MOST_ARGUMENTS = 32, NUMBER_TEXT = 48 };

/// The process of a member that searches for a limit; it goes on by itself with what is there.
static scree_status start_search(const drive *d, const scree_member_paths *paths, job *j, scree_error *error)
{
    const scree_bisection *what = &d->sweep->bisection;
    char threads[16], tolerance[NUMBER_TEXT], below[NUMBER_TEXT], above[NUMBER_TEXT], target[NUMBER_TEXT];
    (void)snprintf(threads, sizeof threads, "%d", d->options->threads > 0 ? d->options->threads : 1);
    (void)snprintf(tolerance, sizeof tolerance, "%.9g", what->tolerance);
    (void)snprintf(below, sizeof below, "--below=%.17g", what->below);
    (void)snprintf(above, sizeof above, "--above=%.17g", what->above);
    (void)snprintf(target, sizeof target, "--target=%.17g", what->target);
    const char *arguments[MOST_ARGUMENTS] = {
        d->options->program, "bisect",    paths->file,      "--output",  paths->folder,    "--key",
        what->key,           "--from",    what->between[0], "--to",      what->between[1], "--tolerance",
        tolerance,           "--measure", what->measure,    "--threads", threads,          "--force"};
    size_t count = 18;
    if (!isnan(what->below)) arguments[count++] = below;
    if (!isnan(what->above)) arguments[count++] = above;
    if (!isnan(what->target)) arguments[count++] = target;
    if (what->curve[0]) arguments[count++] = "--curve";
    if (what->curve[0]) arguments[count++] = what->curve;
    if (!d->options->figures) arguments[count++] = "--no-figures";
    scree_member_note(j->log, "searches in %s", paths->folder);
    return scree_process_start(arguments, j->log, &j->process, error);
}

/// The process of a member: from the begin, from its checkpoint, or behind what it shares with another one.
static scree_status start_process(const drive *d, const scree_member_paths *paths, scree_member_state state, job *j,
                                  scree_error *error)
{
    char threads[16];
    scree_several several;
    scree_member_paths first;
    const size_t leader = d->leader[j->member];
    const char *arguments[MOST_ARGUMENTS] = {NULL};
    size_t count = scree_several_put(&several, d->options, arguments);
    arguments[count++] = d->options->program;
    arguments[count++] = "run";
    bool restart = scree_member_can_continue(paths, state);
    (void)snprintf(threads, sizeof threads, "%d", d->options->threads > 0 ? d->options->threads : 1);
    arguments[count++] = restart ? "--restart" : paths->file;
    if (!restart) arguments[count++] = "--output";
    arguments[count++] = paths->folder;
    arguments[count++] = "--threads";
    arguments[count++] = threads;
    arguments[count++] = "--quiet";
    if (!d->options->figures || !scree_sweep_asks_for(d->sweep, "output.figures")) arguments[count++] = "--no-figures";
    if (!restart && state != SCREE_MEMBER_MISSING) arguments[count++] = "--force";
    const bool shares = !restart && leader != j->member && d->state[leader] == SCREE_MEMBER_DONE;
    if (shares) {
        scree_status status = scree_member_find(d->sweep, leader, d->options->output, &first, error);
        if (status) return status;
        arguments[count++] = "--after";
        arguments[count++] = first.folder;
    }
    scree_member_note(j->log, "%s %s%s%s", restart ? "continues" : "begins", paths->folder, shares ? " behind " : "",
                      shares ? first.folder : "");
    return scree_process_start(arguments, j->log, &j->process, error);
}

/// Somebody may run a member by hand.
static scree_status check_unused(const scree_member_paths *paths, scree_error *error)
{
    char who[512];
    if (!scree_folder_lock_is_held(paths->folder, who, sizeof who)) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "the folder '%s' is in use by %s: wait until it has ended",
                           paths->folder, who);
}

/// Starts a member under the lock of its log; *running is false when it is done by now.
static scree_status start_member(const drive *d, const scree_member_paths *paths, const scree_case *c, job *j,
                                 bool *running, scree_error *error)
{
    char *text = NULL;
    scree_status status = check_unused(paths, error);
    if (status) return status;
    // Looked at again under the lock: another sweep may have finished it in between.
    scree_member_state state = scree_member_look(paths, c, NULL, 0);
    *running = state != SCREE_MEMBER_DONE;
    if (!*running) return SCREE_OK;
    status = scree_member_text(d->sweep, j->member, &text, error);
    if (!status) status = write_case(paths->file, text, error);
    if (!status && d->sweep->bisects) status = start_search(d, paths, j, error);
    if (!status && !d->sweep->bisects) status = start_process(d, paths, state, j, error);
    free(text);
    return status;
}

static scree_status start(drive *d, size_t member)
{
    scree_case *c = NULL;
    scree_error error;
    scree_member_paths paths;
    bool running = false;
    job j = {.member = member, .began = scree_clock(), .log = -1};
    scree_status status = scree_member_find(d->sweep, member, d->options->output, &paths, &error);
    if (!status) status = scree_member_resolve(d->sweep, member, &c, &error);
    if (!status) status = scree_member_open_log(&paths, &j.log, &error);
    if (!status) status = start_member(d, &paths, c, &j, &running, &error);
    scree_case_free(c);
    fail(d, status, &error);
    if (!status && running) {
        d->job[d->running++] = j;
        return SCREE_OK;
    }
    if (j.log >= 0) close(j.log);
    if (status) return status;
    d->state[member] = SCREE_MEMBER_DONE;
    d->done++;
    return SCREE_OK;
}

/// Signals that say that a program is wrong: it would end there again. Others come from outside.
static bool is_crash(int number)
{
    static const int crashes[] = {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS};
    for (size_t i = 0; i < sizeof crashes / sizeof *crashes; i++)
        if (number == crashes[i]) return true;
    return false;
}

/// How a process ended, in words for the log and the terminal; empty when it was asked to.
static scree_member_state judge(const drive *d, int state, char *text, size_t size)
{
    bool stopping = d->options->stop && *d->options->stop;
    if (WIFEXITED(state) && WEXITSTATUS(state) == SCREE_OK) return SCREE_MEMBER_DONE;
    if (WIFEXITED(state) && WEXITSTATUS(state) == SCREE_INTERRUPTED) return SCREE_MEMBER_INTERRUPTED;
    if (WIFSIGNALED(state) && stopping) return SCREE_MEMBER_INTERRUPTED;
    if (WIFSIGNALED(state))
        (void)snprintf(text, size, SCREE_MEMBER_DEATH "signal %d (%s)", WTERMSIG(state), strsignal(WTERMSIG(state)));
    else
        (void)snprintf(text, size, "exit status %d", WEXITSTATUS(state));
    return WIFSIGNALED(state) && !is_crash(WTERMSIG(state)) ? SCREE_MEMBER_INTERRUPTED : SCREE_MEMBER_FAILED;
}

static void finish(drive *d, const job *j, int wait_status)
{
    char how[128] = "", reason[1024] = "";
    const char *name = d->sweep->folder[j->member];
    scree_member_state state = judge(d, wait_status, how, sizeof how);
    double seconds = scree_clock() - j->began;
    d->state[j->member] = state;
    if (state == SCREE_MEMBER_FAILED)
        scree_member_note(j->log, SCREE_MEMBER_FAILURE "%s", how);
    else if (how[0])
        scree_member_note(j->log, "%s after %.1f s", how, seconds);
    else
        scree_member_note(j->log, "%s after %.1f s", scree_member_state_name(state), seconds);
    close(j->log);
    if (state == SCREE_MEMBER_DONE) {
        d->done++;
        tell(d, 0, "%s: done in %.1f s", name, seconds);
    } else if (state == SCREE_MEMBER_INTERRUPTED && how[0]) {
        d->killed++;
        tell(d, 1, "%s: %s; the same command continues it", name, how);
    } else if (state == SCREE_MEMBER_INTERRUPTED) {
        tell(d, 0, "%s: interrupted, can be continued", name);
    } else {
        scree_member_paths paths;
        scree_error error;
        scree_case *c = NULL;
        d->failed++;
        bool looked = !scree_member_find(d->sweep, j->member, d->options->output, &paths, &error) &&
                      !scree_member_resolve(d->sweep, j->member, &c, &error);
        if (looked) (void)scree_member_look(&paths, c, reason, sizeof reason);
        scree_case_free(c);
        tell(d, 1, "%s: failed (%s): %s", name, how, reason[0] ? reason : "it said nothing");
    }
    d->seconds += seconds;
    d->ended++;
}

/// Waits until one of the processes has ended, or somebody asks to stop.
static void wait_for_jobs(drive *d)
{
    bool stop = d->options->stop && *d->options->stop;
    if (stop && !d->interrupted) {
        for (size_t i = 0; i < d->running; i++) scree_process_interrupt(d->job[i].process, d->options->ranks > 1);
        d->interrupted = true;
    }
    size_t before = d->running;
    for (size_t i = 0; i < d->running;) {
        int state;
        if (!scree_process_ended(d->job[i].process, &state)) {
            i++;
            continue;
        }
        job ended = d->job[i];
        d->running--;
        memmove(&d->job[i], &d->job[i + 1], (d->running - i) * sizeof *d->job);
        finish(d, &ended, state);
        report(d);
    }
    struct timespec pause = {.tv_nsec = PAUSE_NANOSECONDS};
    if (d->running == before) (void)nanosleep(&pause, NULL);
}

/// Whether this call runs a member in that state.
static bool is_wanted(const drive *d, scree_member_state state)
{
    if (state == SCREE_MEMBER_FAILED) return d->options->retry;
    if (state == SCREE_MEMBER_CHANGED) return d->options->force;
    return state != SCREE_MEMBER_DONE;
}

/// Whether a member waits for the sample of another one, which this call runs.
static bool waits(const drive *d, size_t member)
{
    const size_t leader = d->leader[member];
    if (leader == member) return false;
    for (size_t i = 0; i < d->running; i++)
        if (d->job[i].member == leader) return true;
    return !d->begun[leader] && is_wanted(d, d->state[leader]);
}

/// The first of members [from, to) that is to be begun now; `to`: none is.
static size_t next_member(const drive *d, size_t from, size_t to)
{
    for (size_t i = from; i < to; i++)
        if (!d->begun[i] && is_wanted(d, d->state[i]) && !(to - from > 1 && waits(d, i))) return i;
    return to;
}

/// Runs the wanted ones of members [from, to).
static void run_members(drive *d, size_t from, size_t to)
{
    for (;;) {
        const bool stop = d->status || (d->options->stop && *d->options->stop);
        const size_t next = stop || d->running == d->jobs ? to : next_member(d, from, to);
        if (next < to) {
            d->left--;
            d->begun[next] = true;
            (void)start(d, next);
            report(d);
            continue;
        }
        if (d->running == 0) break;
        wait_for_jobs(d);
    }
}

/// What is on disk of one member; a directory with another case is refused before anything is run.
static scree_status look_at(drive *d, size_t member)
{
    scree_case *c;
    scree_member_paths paths;
    scree_status status = scree_member_find(d->sweep, member, d->options->output, &paths, d->error);
    if (!status) status = scree_member_resolve(d->sweep, member, &c, d->error);
    if (status) return status;
    d->state[member] = scree_member_look(&paths, c, NULL, 0);
    scree_case_free(c);
    if (d->state[member] != SCREE_MEMBER_CHANGED || d->options->force) return SCREE_OK;
    return scree_error_set(d->error, SCREE_ERROR_INPUT,
                           "'%s' holds a run of another case: choose another folder, or --force to run it anew",
                           paths.folder);
}

/// State of members [from, to), and of what they share a sample with.
static scree_status look(drive *d, size_t from, size_t to)
{
    scree_status status = scree_share_find(d->sweep, d->leader, d->error);
    for (size_t i = from; i < to && !status; i++) {
        if (d->leader[i] < from) status = look_at(d, d->leader[i]);
        if (!status) status = look_at(d, i);
        const bool wanted = is_wanted(d, d->state[i]);
        d->done += d->state[i] == SCREE_MEMBER_DONE;
        d->failed += d->state[i] == SCREE_MEMBER_FAILED && !wanted;
        d->left += wanted;
    }
    return status;
}

/// Makes members/. One sweep at a time runs all members, and is told from the begin; tasks of a job array run one each.
static scree_status make_folder(drive *d, bool all)
{
    char path[PATH_MAX];
    scree_status status = scree_path_join(path, sizeof path, d->options->output, SCREE_FILE_LOG, d->error);
    if (!status && access(path, F_OK) == 0)
        return scree_error_set(d->error, SCREE_ERROR_INPUT, "the folder '%s' holds a run: a sweep needs its own",
                               d->options->output);
    if (!status) status = scree_path_join(path, sizeof path, d->options->output, "members", d->error);
    if (!status) status = scree_folders_make(path, d->error);
    if (!status && all) status = scree_folder_lock_take(&d->lock, path, "scree sweep", d->error);
    return status;
}

static scree_status open_drive(drive *d, size_t from, size_t to)
{
    int threads = d->options->threads > 0 ? d->options->threads : 1,
        ranks = d->options->ranks > 0 ? d->options->ranks : 1;
    int cores = scree_processor_count() / (threads * ranks);
    int jobs = d->options->jobs > 0 ? d->options->jobs : cores > 0 ? cores : 1;
    d->jobs = (size_t)(jobs < MOST_JOBS ? jobs : MOST_JOBS);
    scree_status status = scree_several_check(d->sweep, d->options, true, d->error);
    if (!status) status = make_folder(d, to - from == d->sweep->member_count);
    if (!status) status = scree_allocate(&d->state, d->sweep->member_count, sizeof *d->state, d->error);
    if (!status) status = scree_allocate(&d->leader, d->sweep->member_count, sizeof *d->leader, d->error);
    if (!status) status = scree_allocate(&d->begun, d->sweep->member_count, sizeof *d->begun, d->error);
    if (!status) status = scree_allocate(&d->job, d->jobs, sizeof *d->job, d->error);
    return status ? status : look(d, from, to);
}

/// What the sweep is, for a report on members that are there before all of them have ended.
static scree_status write_record(drive *d)
{
    const scree_sweep_results results = {.sweep = d->sweep, .options = d->options, .state = d->state};
    return scree_sweep_write_record(&results, d->error);
}

static scree_status conclude(drive *d)
{
    if (d->status) return d->status;
    if (d->options->stop && *d->options->stop)
        return scree_error_set(d->error, SCREE_INTERRUPTED,
                               "interrupted with %zu of %zu members done; the same command goes on", d->done,
                               d->sweep->member_count);
    return SCREE_OK;
}

/// Nothing failed, but not all is there.
static scree_status tell_killed(const drive *d)
{
    if (d->killed == 0) return SCREE_OK;
    return scree_error_set(d->error, SCREE_ERROR_GUARD,
                           "%zu of %zu members were killed; the same command continues them, the means are those of "
                           "the others",
                           d->killed, d->sweep->member_count);
}

static void close_drive(drive *d)
{
    scree_release(&d->state);
    scree_release(&d->leader);
    scree_release(&d->begun);
    scree_release(&d->job);
    scree_folder_lock_release(&d->lock);
}

const char *scree_sweep_lacks(const scree_sweep *sweep)
{
    scree_handle_check(sweep, "a sweep");
    return sweep->config.needs[0] && !scree_program_is_there(sweep->config.needs) ? sweep->config.needs : NULL;
}

/// Results of runs without it would be there, and would lack what the sweep is about.
static scree_status check_program(const scree_sweep *sweep, scree_error *error)
{
    const char *lacking = scree_sweep_lacks(sweep);
    if (!lacking) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT,
                           "the sweep %s needs the program '%s', which is not installed: install it, or run the case "
                           "alone",
                           sweep->config.name, lacking);
}

scree_status scree_sweep_run(const scree_sweep *sweep, const scree_sweep_options *options, scree_error *error)
{
    scree_handle_check(sweep, "a sweep");
    drive d = {.sweep = sweep, .options = options, .error = error};
    scree_status status = check_program(sweep, error);
    if (!status) status = open_drive(&d, 0, sweep->member_count);
    if (!status) status = write_record(&d);
    if (!status) {
        if (sweep->measures_ensembles && sweep->realisations < 2)
            tell(&d, 1, "ensemble: averages over one member have no intervals: give more `realisations`");
        if (d.done + d.failed > 0)
            tell(&d, 0, "%zu of %zu members are done, %zu have failed, %zu to run", d.done, sweep->member_count,
                 d.failed, d.left);
        report(&d);
        run_members(&d, 0, sweep->member_count);
        status = conclude(&d);
    }
    close_drive(&d);
    if (!status) status = scree_sweep_collect(sweep, options, error);
    return status ? status : tell_killed(&d);
}

scree_status scree_sweep_run_member(const scree_sweep *sweep, size_t member, const scree_sweep_options *options,
                                    scree_error *error)
{
    scree_handle_check(sweep, "a sweep");
    drive d = {.sweep = sweep, .options = options, .error = error};
    if (member >= sweep->member_count)
        return scree_error_set(error, SCREE_ERROR_INPUT, "there is no member %zu: the sweep has %zu, numbered from 0",
                               member, sweep->member_count);
    scree_status status = check_program(sweep, error);
    if (!status) status = open_drive(&d, member, member + 1);
    if (!status) {
        if (d.done > 0) tell(&d, 0, "%s: is done", sweep->folder[member]);
        run_members(&d, member, member + 1);
        status = conclude(&d);
        if (!status && d.state[member] == SCREE_MEMBER_INTERRUPTED)
            status = scree_error_set(error, SCREE_INTERRUPTED, "%s was interrupted", sweep->folder[member]);
        if (!status && d.state[member] == SCREE_MEMBER_FAILED)
            status =
                scree_error_set(error, SCREE_ERROR_GUARD, "%s has failed; --retry runs it anew", sweep->folder[member]);
    }
    close_drive(&d);
    return status;
}
