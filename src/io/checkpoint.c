/// Checkpoints: whole states (state_file.h) as parts of run.h5, the newest two of them.
///
/// The checksum of the file (checksum.h) tells whether it is whole; when it is not, or what it holds cannot be used,
/// the older of the two is read, or else a snapshot, which holds a state, too.
#include "comm/comm.h"
#include "io/disk.h"
#include "io/file_checksum.h"
#include "io/run_file.h"
#include "io/snapshot.h"
#include "io/state_file.h"

#include <scree/scree.h>

#include <inttypes.h>
#include <limits.h>
#include <stdlib.h>
#include <unistd.h>

// ---- where a run can go on from ----------------------------------------------------------------------------------

void scree_restart_points_destroy(scree_restart_points *points)
{
    scree_release(&points->point);
    points->count = 0;
}

static scree_status add_points(scree_restart_points *points, const scree_part_list *list, bool snapshot, bool part,
                               scree_error *error)
{
    size_t count = points->count + list->count;
    scree_status status = scree_reallocate(&points->point, points->count, count + 1, sizeof *points->point, error);
    for (size_t k = 0; k < list->count && !status; k++)
        points->point[points->count++] = (scree_restart_point){snapshot, list->index[k], part};
    return status;
}

/// Checkpoints before snapshots, higher numbers first, parts before what run.h5 holds itself.
static int compare_points(const void *a, const void *b)
{
    const scree_restart_point *p = a, *q = b;
    if (p->snapshot != q->snapshot) return p->snapshot ? 1 : -1;
    if (p->index != q->index) return p->index < q->index ? 1 : -1;
    return (int)q->part - (int)p->part;
}

/// Those that a finished run.h5 holds itself; a file that cannot be opened has none.
static scree_status list_groups(const char *path, scree_restart_points *points, scree_error *error)
{
    scree_hdf5 run;
    bool sound;
    if (access(path, F_OK) != 0) return SCREE_OK;
    scree_run_file_open(&run, path, &sound, &points->run);
    for (scree_part_kind kind = 0; kind < SCREE_PART_KINDS && !run.status; kind++) {
        scree_part_list groups;
        if (scree_run_file_list(&run, kind, true, &groups)) break;
        run.status = add_points(points, &groups, kind == SCREE_PART_SNAPSHOT, false, run.error);
        scree_part_list_destroy(&groups);
    }
    bool damaged = run.damaged;
    scree_status status = scree_hdf5_close(&run);
    if (!status) points->run = (scree_error){0};
    if (!status || damaged) return SCREE_OK;
    if (error) *error = points->run;
    return status;
}

scree_status scree_restart_points_list(const char *directory, scree_restart_points *points, scree_error *error)
{
    char path[PATH_MAX];
    *points = (scree_restart_points){0};
    scree_status status = scree_run_file_path(directory, path, sizeof path, error);
    for (scree_part_kind kind = 0; kind < SCREE_PART_KINDS && !status; kind++) {
        scree_part_list parts;
        if ((status = scree_parts_list(directory, kind, &parts, error))) break;
        status = add_points(points, &parts, kind == SCREE_PART_SNAPSHOT, true, error);
        scree_part_list_destroy(&parts);
    }
    if (!status) status = list_groups(path, points, error);
    if (status)
        scree_restart_points_destroy(points);
    else if (points->count > 0)
        qsort(points->point, points->count, sizeof *points->point, compare_points);
    return status;
}

// ---- writing -----------------------------------------------------------------------------------------------------

static scree_status write_part(const char *path, const char *group, const scree_state *state,
                               const scree_ranges *ranges, uint64_t case_checksum, scree_error *error)
{
    scree_hdf5 part;
    if (ranges)
        scree_hdf5_create_together(&part, path, error);
    else
        scree_hdf5_create(&part, path, error);
    scree_state_write(&part, group, NULL, state, ranges, case_checksum);
    return scree_hdf5_save(&part);
}

/// Removes all but the newest ones, which run.h5 has links to.
static scree_status remove_old(const char *directory, const scree_part_list *parts, scree_error *error)
{
    for (size_t k = 0; k + SCREE_CHECKPOINTS_KEPT < parts->count; k++) {
        scree_status status = scree_part_remove(directory, SCREE_PART_CHECKPOINT, parts->index[k], error);
        if (status) return status;
    }
    return SCREE_OK;
}

/// The number that follows those of all checkpoints there are.
static scree_status next_index(const char *directory, int64_t *index, scree_error *error)
{
    scree_restart_points points;
    *index = 0;
    scree_status status = scree_restart_points_list(directory, &points, error);
    for (size_t k = 0; k < points.count; k++)
        if (!points.point[k].snapshot && points.point[k].index >= *index) *index = points.point[k].index + 1;
    scree_restart_points_destroy(&points);
    return status;
}

/// Everything that a checkpoint counts on is on the disk before it has a name, and its name before older ones lose
/// theirs.
static scree_status finish_checkpoint(const char *directory, scree_error *error)
{
    const scree_kept all = SCREE_KEEP_ALL;
    scree_part_list parts = {0};
    scree_status status = scree_parts_sync(directory, error);
    if (!status) status = scree_run_file_renew(directory, NULL, &all, NULL, error);
    if (!status) status = scree_folder_sync(directory, error);
    if (!status) status = scree_parts_list(directory, SCREE_PART_CHECKPOINT, &parts, error);
    if (!status) status = remove_old(directory, &parts, error);
    scree_part_list_destroy(&parts);
    return status;
}

scree_status scree_checkpoint_write_ranges(const char *directory, const scree_state *state, const scree_ranges *ranges,
                                           uint64_t case_checksum, scree_error *error)
{
    char path[PATH_MAX], group[64];
    int64_t index = 0;
    const bool writes = !ranges || scree_comm_rank() == 0;
    scree_status status = writes ? next_index(directory, &index, error) : SCREE_OK;
    if (!status && writes) status = scree_parts_folder_make(directory, error);
    if (!status && writes) status = scree_parts_sync(directory, error);
    if (status) return status;
    if (ranges) scree_comm_share(&index, sizeof index);
    scree_part_group(SCREE_PART_CHECKPOINT, index, group, sizeof group);
    status = scree_part_path(directory, SCREE_PART_CHECKPOINT, index, path, sizeof path, error);
    if (!status) status = write_part(path, group, state, ranges, case_checksum, error);
    return status || !writes ? status : finish_checkpoint(directory, error);
}

scree_status scree_checkpoint_write(const char *directory, const scree_state *state, uint64_t case_checksum,
                                    scree_error *error)
{
    return scree_checkpoint_write_ranges(directory, state, NULL, case_checksum, error);
}

// ---- reading -----------------------------------------------------------------------------------------------------

/// Why a snapshot has no state. A guard keeps one of what it stopped, and then the results say so, if they were
/// written; an archive of such a run says the same of itself.
static const char *why_without_state(const char *directory)
{
    char status[32];
    const bool known = scree_result_get(directory, "status", status, sizeof status, NULL) == SCREE_OK;
    if (known && strcmp(status, "stopped") != 0) return "was kept without its state (scree export --archive)";
    return "has no state to go on from: it shows what a guard stopped, or was kept so (scree export --archive)";
}

static void read_state(scree_hdf5 *file, const char *directory, const scree_restart_point *point,
                       const scree_restart_wanted *wanted, scree_state *state)
{
    char group[64], inner[80];
    void (*const read)(scree_hdf5 *, const char *, const char *, int, uint64_t, scree_state *) =
        wanted->in_ranges ? scree_state_read_range : scree_state_read;
    scree_part_group(point->snapshot ? SCREE_PART_SNAPSHOT : SCREE_PART_CHECKPOINT, point->index, group, sizeof group);
    if (!point->snapshot) {
        read(file, group, NULL, wanted->dimension, wanted->case_checksum, state);
        return;
    }
    scree_snapshot_state_group(point->index, inner, sizeof inner);
    if (!file->status &&
        (H5Lexists(file->file, group, H5P_DEFAULT) <= 0 || H5Lexists(file->file, inner, H5P_DEFAULT) <= 0)) {
        // Not damaged, but as good as that: another may serve.
        file->damaged = true;
        file->status = scree_error_set(file->error, SCREE_ERROR_IO, "snapshot %" PRId64 " %s", point->index,
                                       why_without_state(directory));
    }
    read(file, inner, group, wanted->dimension, wanted->case_checksum, state);
}

/// What one process has found wrong is wrong for all.
static void agree(scree_hdf5 *file, const scree_restart_wanted *wanted)
{
    double damaged = file->damaged;
    if (!wanted->in_ranges) return;
    file->status = scree_comm_agree(file->status, file->error);
    scree_comm_maximum(NULL, &damaged, 1);
    file->damaged = damaged > 0;
}

scree_status scree_restart_point_read(const char *directory, const scree_restart_point *point,
                                      const scree_restart_wanted *wanted, scree_state *state, bool *another,
                                      scree_error *error)
{
    char path[PATH_MAX];
    scree_hdf5 file;
    scree_error reason;
    bool sound;
    scree_part_kind kind = point->snapshot ? SCREE_PART_SNAPSHOT : SCREE_PART_CHECKPOINT;
    *another = false;
    *state = (scree_state){.dimension = wanted->dimension};
    scree_status status = point->part ? scree_part_path(directory, kind, point->index, path, sizeof path, error)
                                      : scree_run_file_path(directory, path, sizeof path, error);
    if (status) return status;
    // One process looks at the checksum of the file; what the others read has checksums of its own.
    if (point->part && wanted->in_ranges && scree_comm_rank() > 0)
        scree_hdf5_open(&file, path, error);
    else if (point->part)
        scree_hdf5_open_checked(&file, path, error);
    else
        scree_run_file_open(&file, path, &sound, error);
    agree(&file, wanted);
    read_state(&file, directory, point, wanted, state);
    agree(&file, wanted);
    if (!file.status && wanted->usable && wanted->usable(wanted->context, state, &reason))
        scree_hdf5_refuse(&file, "%s", reason.message);
    agree(&file, wanted);
    *another = file.damaged;
    status = scree_hdf5_close(&file);
    if (status) scree_state_destroy(state);
    state->dimension = wanted->dimension;
    return status;
}

scree_status scree_restart_point_check(const char *directory, const scree_restart_point *point, scree_error *error)
{
    char path[PATH_MAX], group[64];
    scree_part_kind kind = point->snapshot ? SCREE_PART_SNAPSHOT : SCREE_PART_CHECKPOINT;
    scree_status status = point->part ? scree_part_path(directory, kind, point->index, path, sizeof path, error)
                                      : scree_run_file_path(directory, path, sizeof path, error);
    if (status) return status;
    if (point->part) return scree_file_checksum_check(path, error);
    scree_hdf5 run;
    bool sound;
    scree_part_group(kind, point->index, group, sizeof group);
    scree_run_file_open(&run, path, &sound, error);
    if (!run.status && !sound) run.status = scree_hdf5_verify(&run, group, error);
    return scree_hdf5_close(&run);
}

static const char *name_of(const scree_restart_point *point)
{
    return point->snapshot ? "snapshot" : "checkpoint";
}

static bool is_wanted(const scree_restart_point *point, int64_t snapshot)
{
    if (snapshot == SCREE_RESTART_NEWEST) return true;
    return point->snapshot && (snapshot == SCREE_RESTART_LATEST_SNAPSHOT || point->index == snapshot);
}

/// Why there is nothing to go on from. `first`: what was wrong with the first point, if there was one.
static scree_status refuse(const char *directory, const scree_restart_wanted *wanted, const scree_restart_points *all,
                           const scree_error *first, scree_error *error)
{
    char number[32] = "";
    bool any = wanted->snapshot == SCREE_RESTART_NEWEST;
    if (wanted->snapshot >= 0) (void)snprintf(number, sizeof number, " %" PRId64, wanted->snapshot);
    const char *kind = any ? "checkpoint" : "snapshot";
    if (first->status)
        return scree_error_set(error, SCREE_ERROR_IO, "no %s%s in '%s' can be used: %s", kind, number, directory,
                               first->message);
    const char *reason = all->run.status ? ": " : "";
    return scree_error_set(error, all->run.status ? SCREE_ERROR_IO : SCREE_ERROR_INPUT, "there is no %s%s in '%s'%s%s",
                           kind, number, directory, reason, all->run.message);
}

scree_status scree_restart_find(const char *directory, const scree_restart_wanted *wanted, scree_restart_point *used,
                                scree_state *state, scree_error *error)
{
    scree_restart_points all;
    scree_error reason = {0}, first = {0};
    *state = (scree_state){.dimension = wanted->dimension};
    scree_status status = scree_restart_points_list(directory, &all, error);
    if (status) return status;
    bool found = false, another = true;
    for (size_t k = 0; k < all.count && !found && another; k++) {
        if (!is_wanted(&all.point[k], wanted->snapshot)) continue;
        *used = all.point[k];
        status = scree_restart_point_read(directory, used, wanted, state, &another, &reason);
        found = status == SCREE_OK;
        // Snapshots are only looked at for want of a checkpoint: that one has no state says nothing new.
        if (!found && another && !first.status && (!used->snapshot || wanted->snapshot != SCREE_RESTART_NEWEST))
            first = reason;
    }
    if (found && first.status)
        (void)scree_error_set(error, SCREE_OK, "%s %" PRId64 " is used: %s", name_of(used), used->index, first.message);
    else if (found && error)
        *error = (scree_error){0};
    else if (!found && another)
        status = refuse(directory, wanted, &all, &first, error);
    else if (error)
        *error = reason;
    scree_restart_points_destroy(&all);
    return status;
}

scree_status scree_checkpoint_read(const char *directory, int dimension, scree_state *state, uint64_t case_checksum,
                                   scree_error *error)
{
    scree_restart_point used;
    const scree_restart_wanted wanted = {
        .dimension = dimension, .case_checksum = case_checksum, .snapshot = SCREE_RESTART_NEWEST};
    return scree_restart_find(directory, &wanted, &used, state, error);
}
