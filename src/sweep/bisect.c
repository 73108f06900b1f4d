/// Bisection over a number of a case: the limit between values at which a run stands and those at which it does not.
///
/// A run stands if it comes to its end and a result of it keeps a limit; one that a guard has stopped does not. Nothing
/// is predicted: `guard.stability: warn` is set in all of them, so that none is refused before it has run. Both ends
/// are run first, one has to stand and the other not; then the middle (geometric where both have one sign) takes the
/// place of the end that it is like, until the two are within the tolerance of each other. Near a limit growth is slow:
/// what is found is the limit of runs of this length. With a target, runs are on the side of the first of them or on
/// the other, and the search is also over when a result is within the tolerance of it.
///
/// Each run is a process of its own with a folder below `runs`, begun anew only where it is missing: a search that was
/// interrupted goes on. summary.json has the results of the last run that stood, and what the search has found.
/// Cost: 2 + log2(distance of the ends over tolerance) runs, one after the other.
#include "sweep/bisect.h"

#include "base/handle.h"
#include "base/units.h"
#include "case/case.h"
#include "case/path.h"
#include "io/result_names.h"
#include "io/run_directory.h"
#include "io/summary.h"
#include "run/columns.h"
#include "sweep/member.h"
#include "sweep/process.h"
#include "sweep/results.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { MOST_RUNS = 100, PAUSE_NANOSECONDS = 5 * 1000 * 1000 };

typedef struct tried {
    double value;
    double measure; ///< NAN: a guard has stopped the run
    bool stands;
} tried;

typedef struct search {
    const scree_case *c;
    const scree_bisection *what;
    const scree_sweep_options *options;
    tried run[MOST_RUNS];
    int count;
    int end[2]; ///< numbers of the runs at the ends: one stands, the other does not
} search;

// ---- what it is about --------------------------------------------------------------------------------------------

static scree_status check_key(const scree_case *c, const scree_bisection *what, double ends[2], scree_error *error)
{
    scree_target target;
    if (!scree_path_follow(scree_case_root(c), what->key, NULL, (scree_place){.source = NULL}, &target))
        return scree_error_refuse(error, "key", NULL, "%s", target.reason);
    if (target.element || (!target.component && target.key->type != SCREE_KEY_NUMBER))
        return scree_error_refuse(error, "key", NULL, "'%s' is no number: only between numbers there is a middle",
                                  what->key);
    for (int k = 0; k < 2; k++) {
        scree_error problem = {0};
        if (!scree_units_parse(what->between[k], target.key->unit, &ends[k], &problem)) continue;
        return scree_error_refuse(error, "between", target.key->unit, "'%s': %s", what->between[k], problem.message);
    }
    if (ends[0] == ends[1])
        return scree_error_refuse(error, "between", NULL, "there is nothing between a value and itself");
    return SCREE_OK;
}

scree_status scree_bisection_check(const scree_case *c, const scree_bisection *what, double ends[2], scree_error *error)
{
    const scree_result *row = scree_result_name_find(what->measure, NULL);
    if (!row || !row->unit)
        return scree_error_refuse(error, "measure", scree_result_name_nearest(what->measure),
                                  "no run has a number '%s'", what->measure);
    const bool bounds = !isnan(what->below) || !isnan(what->above);
    if (!bounds && isnan(what->target))
        return scree_error_refuse(error, "below", "below, above, or target",
                                  "say below what, or above what, '%s' has to be, or what", what->measure);
    if (bounds && !isnan(what->target))
        return scree_error_refuse(error, "target", "bounds, or a target", "a target goes without bounds");
    if (!(what->tolerance > 0 && what->tolerance < 1))
        return scree_error_refuse(error, "tolerance", "above 0, below 1", "%g is no tolerance", what->tolerance);
    const char *nearest = NULL;
    if (what->curve && what->curve[0] && !scree_column_is_known(what->curve, &nearest))
        return scree_error_refuse(error, "curve", nearest, "series.csv has no column '%s'", what->curve);
    return check_key(c, what, ends, error);
}

// ---- one run -----------------------------------------------------------------------------------------------------

/// The case of a run.
static scree_status make_case(const search *s, double value, scree_case **out, scree_error *error)
{
    char *text = NULL;
    size_t length = 0;
    scree_draft *draft = NULL;
    scree_problems *problems = NULL;
    FILE *memory = open_memstream(&text, &length);
    if (!memory) return scree_error_set_memory(error, 4096);
    scree_status status = scree_case_write(s->c, memory, error);
    if (fclose(memory) != 0 && !status) status = scree_error_set_memory(error, 4096);
    if (!status) status = scree_draft_parse(text, length, "the case", &draft, error);
    if (!status) status = scree_draft_set_number(draft, s->what->key, value, error);
    if (!status) status = scree_draft_set(draft, "guard.stability", "warn", error);
    if (!status && (status = scree_draft_check(draft, out, &problems))) {
        if (scree_problems_count(problems) > 0)
            *error = *scree_problems_get(problems, 0);
        else
            scree_error_set_memory(error, length);
    }
    scree_problems_free(problems);
    scree_draft_free(draft);
    free(text);
    return status;
}

static scree_status find_paths(const search *s, int number, scree_member_paths *paths, scree_error *error)
{
    char name[64];
    static const char *const endings[] = {"", ".yaml", ".txt"};
    char *const path[] = {paths->folder, paths->file, paths->log};
    scree_status status = SCREE_OK;
    for (int k = 0; k < 3 && !status; k++) {
        (void)snprintf(name, sizeof name, "runs/%02d%s", number, endings[k]);
        status = scree_path_join(path[k], PATH_MAX, s->options->output, name, error);
    }
    return status;
}

static scree_status write_case(const char *path, const scree_case *c, scree_error *error)
{
    FILE *file;
    scree_status status = scree_replace_begin(path, &file, error);
    if (status) return status;
    status = scree_case_write(c, file, error);
    scree_status finished = scree_replace_finish(path, file, !status, status ? NULL : error);
    return status ? status : finished;
}

/// Until the process has ended; passes a request to stop on, once.
static int wait_for(const search *s, pid_t process)
{
    int state;
    bool asked = false;
    const struct timespec pause = {0, PAUSE_NANOSECONDS};
    while (!scree_process_ended(process, &state)) {
        if (s->options->stop && *s->options->stop && !asked) {
            scree_process_interrupt(process, false);
            asked = true;
        }
        (void)nanosleep(&pause, NULL);
    }
    return state;
}

static scree_status run_process(const search *s, const scree_member_paths *paths, scree_member_state state, int log,
                                scree_error *error)
{
    char threads[16];
    pid_t process;
    const bool restart = scree_member_can_continue(paths, state);
    (void)snprintf(threads, sizeof threads, "%d", s->options->threads > 0 ? s->options->threads : 1);
    const char *const begin[] = {s->options->program, "run",       paths->file, "--output",
                                 paths->folder,       "--threads", threads,     "--quiet",
                                 "--no-figures",      "--force",   NULL};
    const char *const again[] = {s->options->program, "run",          "--restart", paths->folder, "--threads", threads,
                                 "--quiet",           "--no-figures", NULL};
    scree_status status = scree_process_start(restart ? again : begin, log, &process, error);
    if (status) return status;
    const int ended = wait_for(s, process);
    // What a guard has stopped is a result, too.
    if (WIFEXITED(ended) && (WEXITSTATUS(ended) == SCREE_OK || WEXITSTATUS(ended) == SCREE_ERROR_GUARD))
        return SCREE_OK;
    if ((WIFEXITED(ended) && WEXITSTATUS(ended) == SCREE_INTERRUPTED) || (s->options->stop && *s->options->stop))
        return scree_error_set(error, SCREE_INTERRUPTED, "interrupted after %d runs; the same command goes on",
                               s->count);
    return scree_error_set(error, SCREE_ERROR_IO, "a run of the search has failed: see '%s'", paths->log);
}

/// Reads what has become of a run that is over.
static scree_status judge(const search *s, const scree_member_paths *paths, tried *t, scree_error *error)
{
    char text[64];
    t->measure = NAN;
    t->stands = false;
    scree_status status = scree_result_get(paths->folder, "status", text, sizeof text, error);
    if (status || strcmp(text, "done") != 0) return status;
    status = scree_result_get(paths->folder, s->what->measure, text, sizeof text, error);
    if (status) return status;
    t->measure = strtod(text, NULL);
    t->stands = (isnan(s->what->below) || t->measure < s->what->below) &&
                (isnan(s->what->above) || t->measure > s->what->above);
    if (isnan(s->what->target)) return SCREE_OK;
    const bool more = t->measure > s->what->target;
    t->stands = s->count == 0 || more == (s->run[0].measure > s->what->target);
    return SCREE_OK;
}

static scree_status begin_run(const search *s, const scree_member_paths *paths, const scree_case *c, scree_error *error)
{
    int log = -1;
    const scree_member_state state = scree_member_look(paths, c, NULL, 0);
    if (state == SCREE_MEMBER_DONE || state == SCREE_MEMBER_FAILED) return SCREE_OK;
    scree_status status = write_case(paths->file, c, error);
    if (!status) status = scree_member_open_log(paths, &log, error);
    if (!status) status = run_process(s, paths, state, log, error);
    if (log >= 0) close(log);
    return status;
}

/// Runs the case with a value, and appends what has become of it.
static scree_status try_value(search *s, double value, scree_error *error)
{
    scree_case *c = NULL;
    scree_member_paths paths;
    tried *t = &s->run[s->count];
    t->value = value;
    scree_status status = find_paths(s, s->count, &paths, error);
    if (!status) status = make_case(s, value, &c, error);
    if (!status) status = begin_run(s, &paths, c, error);
    if (!status) status = judge(s, &paths, t, error);
    scree_case_free(c);
    if (status) return status;
    s->count++;
    if (isnan(s->what->target))
        scree_sweep_tell(s->options, 0, "%s = %.6g: %s (%s %.4g)", s->what->key, value,
                         t->stands ? "stands" : "does not stand", s->what->measure, t->measure);
    else
        scree_sweep_tell(s->options, 0, "%s = %.6g: %s %.6g", s->what->key, value, s->what->measure, t->measure);
    return SCREE_OK;
}

// ---- the search --------------------------------------------------------------------------------------------------

static double middle(double a, double b)
{
    return a * b > 0 ? copysign(sqrt(a * b), a) : 0.5 * (a + b);
}

/// Number of the run whose result is nearest to the target; 0 without one.
static int nearest_run(const search *s)
{
    int nearest = 0;
    for (int k = 1; k < s->count; k++)
        if (fabs(s->run[k].measure - s->what->target) < fabs(s->run[nearest].measure - s->what->target)) nearest = k;
    return nearest;
}

static bool is_found(const search *s)
{
    const double target = s->what->target;
    return !isnan(target) && fabs(s->run[nearest_run(s)].measure - target) <= s->what->tolerance * fabs(target);
}

/// Why both ends are alike.
static scree_status refuse_ends(const search *s, const double ends[2], scree_error *error)
{
    for (int k = 0; k < 2 && !isnan(s->what->target); k++)
        if (isnan(s->run[k].measure))
            return scree_error_set(error, SCREE_ERROR_INPUT,
                                   "the run with %s = %.6g has no %s: runs/%02d.txt in the folder says why",
                                   s->what->key, ends[k], s->what->measure, k);
    if (!isnan(s->what->target))
        return scree_error_set(
            error, SCREE_ERROR_INPUT, "%s is %.6g and %.6g at the ends, %s = %.6g and %.6g: %.6g is not between them",
            s->what->measure, s->run[0].measure, s->run[1].measure, s->what->key, ends[0], ends[1], s->what->target);
    return scree_error_set(error, SCREE_ERROR_INPUT,
                           "runs %s at both ends, %s = %.6g and %.6g: the limit is not between them",
                           s->run[0].stands ? "stand" : "do not stand", s->what->key, ends[0], ends[1]);
}

static scree_status find_limit(search *s, const double ends[2], scree_error *error)
{
    scree_status status = try_value(s, ends[0], error);
    if (!status) status = try_value(s, ends[1], error);
    if (status) return status;
    s->end[1] = 1;
    if (is_found(s)) return SCREE_OK;
    if (s->run[0].stands == s->run[1].stands) return refuse_ends(s, ends, error);
    while (!status && s->count < MOST_RUNS && !is_found(s)) {
        const double a = s->run[s->end[0]].value, b = s->run[s->end[1]].value, between = middle(a, b);
        if (fabs(a - b) <= s->what->tolerance * fabs(between)) break;
        status = try_value(s, between, error);
        if (status) break;
        const int last = s->count - 1, like = s->run[last].stands == s->run[s->end[0]].stands ? 0 : 1;
        s->end[like] = last;
    }
    return status;
}

/// Takes over a result of the last run that stood.
static void copy_result(void *summary, const char *name, const char *value)
{
    char *rest;
    const scree_result *row = scree_result_name_find(name, NULL);
    const double number = strtod(value, &rest);
    if (row && row->unit && !*rest)
        scree_summary_set_number(summary, name, number);
    else
        scree_summary_set_text(summary, name, value);
}

static scree_status write_summary(const search *s, scree_error *error)
{
    char path[PATH_MAX];
    scree_member_paths paths;
    scree_summary *summary = NULL;
    const int stands = s->run[s->end[0]].stands ? 0 : 1, nearest = nearest_run(s);
    const double last = s->run[s->end[stands]].value, first = s->run[s->end[1 - stands]].value;
    const bool targeted = !isnan(s->what->target);
    scree_status status = find_paths(s, targeted ? nearest : s->end[stands], &paths, error);
    if (!status) status = scree_summary_create(&summary, error);
    if (!status) status = scree_result_visit(paths.folder, copy_result, summary, error);
    if (!status) {
        scree_summary_set_number(summary, "limit", targeted ? s->run[nearest].value : middle(last, first));
        scree_summary_set_number(summary, "limit_stands", last);
        scree_summary_set_number(summary, "limit_fails", first);
        scree_summary_set_integer(summary, "limit_runs", s->count);
        if (targeted) scree_summary_set_integer(summary, "limit_nearest", nearest);
        status = scree_path_join(path, sizeof path, s->options->output, SCREE_FILE_SUMMARY, error);
    }
    if (!status) status = scree_summary_write(summary, path, error);
    scree_summary_destroy(summary);
    return status;
}

static scree_status write_table(const search *s, scree_error *error)
{
    char path[PATH_MAX];
    FILE *file;
    scree_status status = scree_path_join(path, sizeof path, s->options->output, "bisection.csv", error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (status) return status;
    fprintf(file, "run,%s,stands,%s\n", s->what->key, s->what->measure);
    for (int k = 0; k < s->count; k++)
        fprintf(file, "%02d,%.9g,%d,%.9g\n", k, s->run[k].value, s->run[k].stands, s->run[k].measure);
    return scree_replace_finish(path, file, true, error);
}

/// The two runs on each side that are nearest to the limit, those that stand first.
static scree_status draw_runs(const search *s, scree_error *error)
{
    scree_bisection_curve curve[SCREE_BISECTION_CURVES];
    const double limit = middle(s->run[s->end[0]].value, s->run[s->end[1]].value);
    char title[256];
    size_t count = 0;
    scree_status status = SCREE_OK;
    for (int stands = 1; stands >= 0; stands--) {
        int last = -1;
        for (int k = 0; k < SCREE_BISECTION_CURVES / 2 && !status; k++) {
            int nearest = -1;
            for (int i = 0; i < s->count; i++)
                if (s->run[i].stands == (stands == 1) && i != last &&
                    (nearest < 0 || fabs(s->run[i].value - limit) < fabs(s->run[nearest].value - limit)))
                    nearest = i;
            scree_member_paths paths;
            if ((last = nearest) < 0 || (status = find_paths(s, nearest, &paths, error))) break;
            scree_bisection_curve *c = &curve[count++];
            (void)snprintf(c->folder, sizeof c->folder, "%s", paths.folder);
            (void)snprintf(c->label, sizeof c->label, "%.5g %s", s->run[nearest].value, stands ? "stands" : "fails");
            c->stands = stands == 1;
        }
    }
    (void)snprintf(title, sizeof title, "Runs near the limit of %s, %.5g", s->what->key, limit);
    return status ? status : scree_bisection_figure(s->options->output, title, s->what->curve, curve, count, error);
}

/// A search is not lost because of a figure.
static void draw_if_wanted(const search *s)
{
    scree_error problem;
    if (!s->options->figures || !s->what->curve || !s->what->curve[0]) return;
    if (draw_runs(s, &problem)) scree_sweep_tell(s->options, 1, "figures/runs: %s", problem.message);
}

/// The folder, with the case that the search began with.
static scree_status open_folder(const search *s, scree_folder_lock *lock, scree_error *error)
{
    char path[PATH_MAX];
    scree_case *stored = NULL;
    scree_status status = scree_path_join(path, sizeof path, s->options->output, "runs", error);
    if (!status) status = scree_folders_make(path, error);
    if (!status) status = scree_folder_lock_take(lock, s->options->output, "scree bisect", error);
    if (!status) status = scree_path_join(path, sizeof path, s->options->output, SCREE_FILE_CASE, error);
    if (status) return status;
    const bool there = access(path, F_OK) == 0;
    const bool same =
        there && !scree_case_reread(path, scree_former_keys, &stored, NULL) && scree_case_same(stored, s->c);
    scree_case_free(stored);
    if (there && !same && !s->options->force)
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "the folder '%s' holds another case: choose another one, or --force",
                               s->options->output);
    return write_case(path, s->c, error);
}

scree_status scree_bisect(const scree_case *c, const scree_bisection *what, const scree_sweep_options *options,
                          scree_bisection_result *result, scree_error *error)
{
    scree_handle_check(c, "a case");
    double ends[2];
    search s = {.c = c, .what = what, .options = options};
    scree_folder_lock lock = {0};
    scree_status status = scree_bisection_check(c, what, ends, error);
    if (!status) status = open_folder(&s, &lock, error);
    if (!status) status = find_limit(&s, ends, error);
    if (!status) status = write_table(&s, error);
    if (!status) draw_if_wanted(&s);
    if (!status) status = write_summary(&s, error);
    scree_folder_lock_release(&lock);
    if (status) return status;
    const int stands = s.run[s.end[0]].stands ? 0 : 1;
    *result = (scree_bisection_result){
        .stands = s.run[s.end[stands]].value, .fails = s.run[s.end[1 - stands]].value, .runs = s.count};
    result->limit = middle(result->stands, result->fails);
    if (isnan(what->target)) return SCREE_OK;
    result->nearest = nearest_run(&s);
    result->limit = result->found = s.run[result->nearest].value;
    result->measured = s.run[result->nearest].measure;
    return SCREE_OK;
}
