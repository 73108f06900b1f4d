/// What is whole in the folder of a run, what is damaged or left over, and from where the run can go on.
#include "io/file_checksum.h"
#include "io/run_directory.h"
#include "io/run_file.h"
#include "io/series.h"
#include "run/restart.h"

#include <dirent.h>
#include <inttypes.h>
#include <limits.h>
#include <string.h>
#include <unistd.h>

enum { TEXT = 1200 };

typedef struct inspection {
    const char *directory;
    void (*visit)(void *user, const scree_folder_item *item);
    void *user;
    size_t damaged, restarts;
} inspection;

static void tell(inspection *all, const scree_folder_item *item)
{
    all->damaged += strcmp(item->state, "damaged") == 0;
    all->restarts += item->restart;
    if (all->visit) all->visit(all->user, item);
}

/// Tells of a file: whole with `text`, or damaged for the reason of the error.
static void tell_file(inspection *all, const char *name, scree_status status, const char *text,
                      const scree_error *error)
{
    tell(all, &(scree_folder_item){
                  .name = name, .state = status ? "damaged" : "whole", .text = status ? error->message : text});
}

static scree_status inspect_series(inspection *all, const char *name, scree_error *error)
{
    char path[PATH_MAX], text[TEXT];
    scree_series series;
    scree_error reason = {0};
    scree_status status = scree_path_join(path, sizeof path, all->directory, name, error);
    if (status) return status;
    status = scree_series_read(&series, path, &reason);
    (void)snprintf(text, sizeof text, "%zu rows", status ? 0 : series.row_count);
    scree_series_destroy(&series);
    tell_file(all, name, status, text, &reason);
    return SCREE_OK;
}

/// summary.json is written at the end of a run: that there is none says nothing.
static scree_status inspect_summary(inspection *all, scree_error *error)
{
    char path[PATH_MAX], text[TEXT], value[64] = "";
    scree_error reason = {0};
    scree_status status = scree_path_join(path, sizeof path, all->directory, SCREE_FILE_SUMMARY, error);
    if (status || access(path, F_OK) != 0) return status;
    status = scree_result_get(all->directory, "status", value, sizeof value, &reason);
    (void)snprintf(text, sizeof text, "status %s", value);
    tell_file(all, SCREE_FILE_SUMMARY, status, text, &reason);
    return SCREE_OK;
}

static scree_status inspect_run_file(inspection *all, const scree_restart_points *points, scree_error *error)
{
    char path[PATH_MAX];
    scree_error reason = {0};
    size_t own = 0;
    scree_status status = scree_run_file_path(all->directory, path, sizeof path, error);
    if (status || access(path, F_OK) != 0) return status;
    for (size_t k = 0; k < points->count; k++) own += !points->point[k].part;
    status = scree_file_checksum_check(path, &reason);
    if (status && own == 0 && points->count > 0)
        (void)scree_error_set(&reason, status, "it holds nothing that is not in parts/: a restart writes it anew");
    tell_file(all, SCREE_FILE_RUN, status, own > 0 ? "snapshots and checkpoints" : "links into parts/", &reason);
    return SCREE_OK;
}

/// One checkpoint or snapshot: whether it is whole, and whether the run can go on from it.
static void inspect_point(inspection *all, const scree_restart_point *point, scree_simulation *s, uint64_t checksum)
{
    char name[64], text[TEXT];
    scree_error reason = {0};
    (void)snprintf(name, sizeof name, "%s %" PRId64, point->snapshot ? "snapshot" : "checkpoint", point->index);
    scree_folder_item item = {
        .name = name, .state = "whole", .text = text, .snapshot = point->snapshot, .index = point->index};
    scree_status status = scree_restart_point_check(all->directory, point, &reason);
    if (status) {
        item.state = "damaged";
        (void)snprintf(text, sizeof text, "%s; it can be dropped", reason.message);
    } else if (!s || scree_restart_try(s, all->directory, checksum, point, &reason)) {
        (void)snprintf(text, sizeof text, "nothing can go on from it: %s", s ? reason.message : "there is no case");
    } else {
        int64_t stage = s->state.stage.index;
        item.restart = true;
        (void)snprintf(text, sizeof text, "step %" PRIu64 ", time %.6g s, stage %" PRId64 ", %" PRId64 " rows",
                       s->state.step, scree_state_time(&s->state), stage, s->state.stage.samples);
    }
    if (s) scree_state_destroy(&s->state);
    tell(all, &item);
}

/// Files that a restart has set aside.
static scree_status inspect_set_aside(inspection *all, const char *folder, scree_error *error)
{
    char path[PATH_MAX];
    scree_status status = scree_path_join(path, sizeof path, all->directory, folder, error);
    if (status) return status;
    DIR *open = opendir(path);
    for (struct dirent *entry; open && (entry = readdir(open));) {
        const char *ending = strrchr(entry->d_name, '.');
        if (!ending || strcmp(ending, ".damaged") != 0) continue;
        tell(all, &(scree_folder_item){.name = entry->d_name,
                                       .state = "left over",
                                       .text = "damaged, set aside by a restart; it can be dropped"});
    }
    if (open) closedir(open);
    return SCREE_OK;
}

static scree_status inspect_points(inspection *all, const scree_case *c, scree_error *error)
{
    scree_restart_points points;
    scree_simulation s = {0};
    uint64_t checksum = 0;
    scree_status status = scree_restart_points_list(all->directory, &points, error);
    if (!status) status = inspect_run_file(all, &points, error);
    if (!status && c) status = scree_simulation_open(c, 1, &s, error);
    if (!status && c) status = scree_case_checksum(c, &checksum, error);
    for (size_t k = points.count; !status && k-- > 0;) inspect_point(all, &points.point[k], c ? &s : NULL, checksum);
    if (c) scree_simulation_close(&s);
    scree_restart_points_destroy(&points);
    return status;
}

scree_status scree_folder_check(const char *directory, void (*visit)(void *user, const scree_folder_item *item),
                                void *user, scree_error *error)
{
    char path[PATH_MAX];
    scree_case *c = NULL;
    scree_error reason = {0};
    inspection all = {.directory = directory, .visit = visit, .user = user};
    scree_status status = scree_path_join(path, sizeof path, directory, SCREE_FILE_CASE, error);
    if (status) return status;
    if (access(path, F_OK) != 0)
        return scree_error_set(error, SCREE_ERROR_INPUT, "there is no run in '%s': it has no %s", directory,
                               SCREE_FILE_CASE);
    scree_status readable = scree_restart_case(directory, &c, &reason);
    tell_file(&all, SCREE_FILE_CASE, readable, readable ? "" : c->config.name ? c->config.name : "", &reason);
    status = inspect_summary(&all, error);
    if (!status) status = inspect_series(&all, SCREE_FILE_SERIES, error);
    if (!status) status = inspect_points(&all, readable ? NULL : c, error);
    if (!status) status = inspect_set_aside(&all, "", error);
    if (!status) status = inspect_set_aside(&all, SCREE_FOLDER_PARTS, error);
    scree_case_free(c);
    if (status || all.damaged == 0) return status;
    return scree_error_set(error, SCREE_ERROR_IO, "%zu of what '%s' holds is damaged", all.damaged, directory);
}
