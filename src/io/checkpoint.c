/// Checkpoints: whole states (state_file.h) as parts of run.h5, the newest two of them.
///
/// The seal of the file (seal.h) tells whether it is whole; when it is not, or what it holds cannot be used, the older
/// of the two is read.
#include "io/run_file.h"
#include "io/snapshot.h"
#include "io/state_file.h"

#include <inttypes.h>
#include <limits.h>
#include <unistd.h>

// ---- writing -----------------------------------------------------------------------------------------------------

static scree_status write_part(const char *path, const char *group, const scree_state *state, uint64_t case_checksum,
                               scree_error *error)
{
    scree_hdf5 part;
    scree_hdf5_create(&part, path, error);
    scree_state_write(&part, group, state, case_checksum);
    return scree_hdf5_save(&part);
}

/// Removes all but the newest ones, which run.h5 has links to.
static scree_status remove_old(const char *directory, const scree_part_list *parts, scree_error *error)
{
    for (size_t k = 0; k + SCREE_CHECKPOINTS_KEPT < parts->count; k++) {
        char path[PATH_MAX];
        scree_status status =
            scree_part_path(directory, SCREE_PART_CHECKPOINT, parts->index[k], path, sizeof path, error);
        if (status) return status;
        if (unlink(path) != 0) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot remove '%s'", path);
    }
    return SCREE_OK;
}

/// Checkpoints in parts/ and, where a finished run.h5 holds some itself, in there.
typedef struct found {
    scree_part_list parts, groups;
} found;

static void found_destroy(found *all)
{
    scree_part_list_destroy(&all->parts);
    scree_part_list_destroy(&all->groups);
}

static scree_status find_all(const char *directory, found *all, scree_error *error)
{
    *all = (found){0};
    char path[PATH_MAX];
    scree_status status = scree_run_file_path(directory, path, sizeof path, error);
    if (!status) status = scree_parts_list(directory, SCREE_PART_CHECKPOINT, &all->parts, error);
    if (!status && access(path, F_OK) == 0) {
        scree_hdf5 run;
        scree_hdf5_open_sealed(&run, path, error);
        (void)scree_run_file_list(&run, SCREE_PART_CHECKPOINT, true, &all->groups);
        status = scree_hdf5_close(&run);
    }
    if (status) found_destroy(all);
    return status;
}

static int64_t newest(const scree_part_list *list)
{
    return list->count > 0 ? list->index[list->count - 1] : -1;
}

scree_status scree_checkpoint_write(const char *directory, const scree_state *state, uint64_t case_checksum,
                                    scree_error *error)
{
    found all;
    char path[PATH_MAX], group[64];
    scree_status status = find_all(directory, &all, error);
    if (status) return status;
    int64_t part = newest(&all.parts), own = newest(&all.groups), index = (part > own ? part : own) + 1;
    found_destroy(&all);
    scree_part_group(SCREE_PART_CHECKPOINT, index, group, sizeof group);
    status = scree_parts_folder_make(directory, error);
    if (!status) status = scree_part_path(directory, SCREE_PART_CHECKPOINT, index, path, sizeof path, error);
    if (!status) status = write_part(path, group, state, case_checksum, error);
    if (!status) status = scree_run_file_renew(directory, NULL, INT64_MAX, error);
    scree_part_list parts = {0};
    if (!status) status = scree_parts_list(directory, SCREE_PART_CHECKPOINT, &parts, error);
    if (!status) status = remove_old(directory, &parts, error);
    scree_part_list_destroy(&parts);
    return status;
}

// ---- reading -----------------------------------------------------------------------------------------------------

/// Reads one checkpoint. *damaged: the file is at fault, another one may be whole.
static scree_status read_one(const char *path, const char *group, const scree_checkpoint_wanted *wanted,
                             scree_state *state, bool *damaged, scree_error *error)
{
    scree_hdf5 file;
    scree_error reason;
    scree_hdf5_open_sealed(&file, path, error);
    scree_state_read(&file, group, wanted->dimension, wanted->case_checksum, state);
    if (!file.status && wanted->usable && wanted->usable(wanted->context, state, &reason))
        scree_hdf5_refuse(&file, "%s", reason.message);
    *damaged = file.damaged;
    scree_status status = scree_hdf5_close(&file);
    if (status) scree_state_destroy(state);
    state->dimension = wanted->dimension;
    return status;
}

/// Takes the newest checkpoint out of the lists; false when there is none left.
static bool take_newest(found *all, const char *directory, char path[PATH_MAX], int64_t *index, scree_status *status,
                        scree_error *error)
{
    if (all->parts.count + all->groups.count == 0) return false;
    bool part = newest(&all->parts) >= newest(&all->groups);
    scree_part_list *list = part ? &all->parts : &all->groups;
    *index = list->index[--list->count];
    *status = part ? scree_part_path(directory, SCREE_PART_CHECKPOINT, *index, path, PATH_MAX, error)
                   : scree_run_file_path(directory, path, PATH_MAX, error);
    return !*status;
}

scree_status scree_checkpoint_read(const char *directory, int dimension, scree_state *state, uint64_t case_checksum,
                                   scree_error *error)
{
    return scree_checkpoint_find(
        directory, &(scree_checkpoint_wanted){.dimension = dimension, .case_checksum = case_checksum}, state, error);
}

scree_status scree_checkpoint_find(const char *directory, const scree_checkpoint_wanted *wanted, scree_state *state,
                                   scree_error *error)
{
    found all;
    char path[PATH_MAX], group[64];
    int64_t index = -1;
    scree_error reason = {0}, first = {0};
    bool damaged = true;
    *state = (scree_state){.dimension = wanted->dimension};
    scree_status status = find_all(directory, &all, error);
    if (status) return status;
    if (all.parts.count + all.groups.count == 0) {
        found_destroy(&all);
        return scree_error_set(error, SCREE_ERROR_INPUT, "there is no checkpoint in '%s'", directory);
    }
    while (damaged && take_newest(&all, directory, path, &index, &status, &reason)) {
        scree_part_group(SCREE_PART_CHECKPOINT, index, group, sizeof group);
        status = read_one(path, group, wanted, state, &damaged, &reason);
        if (damaged && !first.status) first = reason;
    }
    found_destroy(&all);
    if (!status && first.status)
        (void)scree_error_set(error, SCREE_OK, "checkpoint %" PRId64 " is used: %s", index, first.message);
    else if (status && damaged)
        (void)scree_error_set(error, SCREE_ERROR_IO, "no checkpoint in '%s' can be used: %s", directory, first.message);
    else if (error)
        *error = reason;
    return status;
}
