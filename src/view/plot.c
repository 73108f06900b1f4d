/// The figures of a run directory, a loop over the table of figures. A figure that cannot be drawn does not keep the
/// others from being drawn: the first failure is what scree_plot returns at the end.
#include "view/plot.h"

#include "view/font.h"
#include "view/plot_parts.h"

#include "base/memory.h"
#include "io/run_directory.h"

#include <scree/scree.h>

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// ---- the figures of a run ----------------------------------------------------------------------------------------

typedef void figure_visitor(const scree_plot_run *run, const scree_figure_job *job, void *user);

/// Files are named after the window that was asked for.
static void name_job(const scree_plot_run *run, scree_figure_job *job)
{
    char begin[16], end[16];
    (void)snprintf(job->name, sizeof job->name, "%s", job->figure->name);
    if (job->window) {
        scree_plot_percent(begin, sizeof begin, job->window->from, true);
        scree_plot_percent(end, sizeof end, job->window->to, true);
        (void)snprintf(job->name, sizeof job->name, "%.24s-%s-%s", job->figure->name, begin, end);
    }
    // scree_plot_open_folder leaves room for the name.
    (void)snprintf(job->path, sizeof job->path, "%.*s/%s", PATH_MAX - SCREE_FIGURE_NAME - 2, run->figures, job->name);
}

/// Calls `visit` for all figures that runs of this kind have, in the order of the table.
static void visit_figures(const scree_plot_run *run, figure_visitor *visit, void *user)
{
    for (const scree_figure_family *const *each = scree_figure_families; *each; each++) {
        scree_figure_job job = {.family = *each};
        for (size_t k = 0; k < job.family->count; k++) {
            job.figure = (const scree_figure *)((const char *)job.family->row + k * job.family->size);
            if (job.family->meant && !job.family->meant(run, job.figure)) continue;
            for (size_t w = 0; w < (job.family->of_windows ? run->window_count : 1); w++) {
                job.window = job.family->of_windows ? &run->window[w] : NULL;
                name_job(run, &job);
                visit(run, &job, user);
            }
        }
    }
}

// ---- names that were asked for -----------------------------------------------------------------------------------

/// Whether a figure is one of those that are drawn unless others are asked for.
static bool is_usual(const scree_plot_run *run, const scree_figure_job *job)
{
    if (job->window && job->window != &run->window[run->window_count - 1]) return false;
    switch (job->figure->use) {
    case SCREE_USUAL:
        return true;
    case SCREE_WITH_LOADING:
        return run->row_count > 0 || run->series.row_count < 2; // the latter says why
    case SCREE_WITHOUT_LOADING:
        return run->row_count == 0;
    case SCREE_OF_PATHS:
        return run->winding;
    default:
        return false;
    }
}

/// `names` is the word for all figures.
static bool are_all(const char *names)
{
    return names && strcmp(names, SCREE_ALL_FIGURES) == 0;
}

/// Whether `name` stands in a list with commas.
static bool is_named(const char *names, const char *name)
{
    size_t length = strlen(name);
    for (const char *at = names; at; at = strchr(at, ',')) {
        at += *at == ',';
        if (strncmp(at, name, length) == 0 && (at[length] == 0 || at[length] == ',')) return true;
    }
    return false;
}

typedef struct name_list {
    char (*text)[SCREE_FIGURE_NAME]; ///< NULL: only counted
    const char **name;
    size_t count;
} name_list;

static void take_name(const scree_plot_run *run, const scree_figure_job *job, void *user)
{
    name_list *list = user;
    (void)run;
    if (list->text) {
        memcpy(list->text[list->count], job->name, sizeof job->name);
        list->name[list->count] = list->text[list->count];
    }
    list->count++;
}

/// The first name of `names` that no figure of the run has, with the nearest that one has.
static scree_status refuse_unknown(const scree_plot_run *run, const name_list *list, const char *names,
                                   scree_error *error)
{
    char name[SCREE_FIGURE_NAME];
    for (const char *at = names; at; at = strchr(at, ',')) {
        at += *at == ',';
        (void)snprintf(name, sizeof name, "%.*s", (int)strcspn(at, ","), at);
        size_t k = 0;
        while (k < list->count && strcmp(list->name[k], name) != 0) k++;
        if (k < list->count) continue;
        // What could not be read may be what the figure is of.
        if (run->series_status || run->snapshot_status) {
            if (error) *error = run->series_status ? run->series_error : run->snapshot_error;
            return run->series_status ? run->series_status : run->snapshot_status;
        }
        const char *nearest = scree_nearest(name, list->name, list->count);
        return scree_error_refuse(error, name, nearest ? nearest : "scree plot DIR --list",
                                  "the run in '%s' has no figure of this name", run->directory);
    }
    return SCREE_OK;
}

static scree_status check_names(const scree_plot_run *run, const char *names, scree_error *error)
{
    name_list list = {0};
    if (!names || are_all(names)) return SCREE_OK;
    visit_figures(run, take_name, &list);
    size_t count = list.count;
    list.count = 0;
    scree_status status = scree_allocate(&list.text, count, sizeof *list.text, error);
    if (!status) status = scree_allocate(&list.name, count, sizeof *list.name, error);
    if (!status) {
        visit_figures(run, take_name, &list);
        status = refuse_unknown(run, &list, names, error);
    }
    scree_release(&list.text);
    scree_release(&list.name);
    return status;
}

// ---- drawing -----------------------------------------------------------------------------------------------------

typedef struct drawing {
    const char *names; ///< NULL: the usual figures, or all
    bool all;
    void (*message)(void *user, const char *line);
    void *user;
    scree_status status; ///< of the first figure that failed; the others are drawn all the same
    scree_error error;
} drawing;

/// Tells that `name` was drawn, was left out (SCREE_ERROR_INPUT: the run does not have what it shows), or failed.
static void report(drawing *d, const char *name, const char *path, scree_status status, const scree_error *error)
{
    char line[PATH_MAX + 300];
    if (status == SCREE_OK)
        (void)snprintf(line, sizeof line, "%s.svg", path);
    else
        (void)snprintf(line, sizeof line, "%s %s: %.900s", name, status == SCREE_ERROR_INPUT ? "left out" : "failed",
                       error->message);
    if (d->message) d->message(d->user, line);
    // To leave out what was asked for by its name is a failure.
    if (status == SCREE_OK || (status == SCREE_ERROR_INPUT && !d->names) || d->status) return;
    d->status = status;
    d->error = *error;
    if (d->names) (void)snprintf(d->error.field, sizeof d->error.field, "%s", name);
}

static void draw_figure(const scree_plot_run *run, const scree_figure_job *job, void *user)
{
    drawing *d = user;
    scree_error error = {0};
    if (!d->all && !(d->names ? is_named(d->names, job->name) : is_usual(run, job))) return;
    scree_status status = job->family->applies(run, job, &error);
    if (!status) status = job->family->draw(run, job, &error);
    report(d, job->name, job->path, status, &error);
}

void scree_plot_warn(void (*message)(void *user, const char *line), void *user)
{
    char line[300] = "warning: ";
    const size_t head = strlen(line);
    if (message && scree_font_missing(line + head, sizeof line - head)) message(user, line);
}

scree_status scree_plot_make_folder(scree_plot_run *run, scree_error *error)
{
    scree_status status = scree_path_join(run->figures, sizeof run->figures - SCREE_FIGURE_NAME - 2, run->directory,
                                          SCREE_FOLDER_FIGURES, error);
    if (!status && mkdir(run->figures, 0777) != 0 && errno != EEXIST)
        status = scree_error_set_errno(error, SCREE_ERROR_IO, "cannot create the folder '%s'", run->figures);
    return status;
}

scree_status scree_plot_draw(const char *directory, const char *names, void (*message)(void *user, const char *path),
                             void *user, scree_error *error)
{
    scree_plot_run run;
    const bool all = are_all(names);
    drawing d = {.names = all ? NULL : names, .all = all, .message = message, .user = user};
    scree_status status = scree_plot_run_open(&run, directory, error);
    if (!status) status = check_names(&run, names, error);
    if (!status) status = scree_plot_make_folder(&run, error);
    if (!status) {
        if (run.series_status) report(&d, SCREE_FILE_SERIES, NULL, run.series_status, &run.series_error);
        if (run.snapshot_status) report(&d, SCREE_FILE_RUN, NULL, run.snapshot_status, &run.snapshot_error);
        scree_plot_warn(message, user);
        visit_figures(&run, draw_figure, &d);
        status = d.status;
        if (status && error) *error = d.error;
    }
    scree_plot_run_close(&run);
    return status;
}

scree_status scree_plot_lock(scree_folder_lock *taken, const char *directory, scree_error *error)
{
    *taken = (scree_folder_lock){0};
    if (access(directory, F_OK) != 0) return SCREE_OK;
    return scree_folder_lock_take(taken, directory, "scree plot", error);
}

scree_status scree_plot_only(const char *directory, const char *names, void (*message)(void *user, const char *path),
                             void *user, scree_error *error)
{
    scree_folder_lock taken;
    scree_status status = scree_plot_lock(&taken, directory, error);
    if (!status) status = scree_plot_draw(directory, names, message, user, error);
    scree_folder_lock_release(&taken);
    return status;
}

scree_status scree_plot(const char *directory, void (*message)(void *user, const char *path), void *user,
                        scree_error *error)
{
    return scree_plot_only(directory, NULL, message, user, error);
}

// ---- listing -----------------------------------------------------------------------------------------------------

typedef struct listing {
    void (*visit)(void *user, const char *name, const char *meaning, bool usual);
    void *user;
} listing;

static void list_figure(const scree_plot_run *run, const scree_figure_job *job, void *user)
{
    const listing *l = user;
    scree_error error = {0};
    if (!job->family->applies(run, job, &error)) l->visit(l->user, job->name, job->figure->meaning, is_usual(run, job));
}

scree_status scree_figure_visit(const char *directory,
                                void (*visit)(void *user, const char *name, const char *meaning, bool usual),
                                void *user, scree_error *error)
{
    scree_folder_lock taken;
    scree_plot_run run = {0};
    listing l = {visit, user};
    scree_status status = scree_plot_lock(&taken, directory, error);
    if (!status) status = scree_plot_run_open(&run, directory, error);
    if (!status) {
        visit_figures(&run, list_figure, &l);
        status = run.series_status ? run.series_status : run.snapshot_status;
        if (status && error) *error = run.series_status ? run.series_error : run.snapshot_error;
    }
    scree_plot_run_close(&run);
    scree_folder_lock_release(&taken);
    return status;
}
