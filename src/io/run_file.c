/// run.h5: links to the parts while a run lasts, one self-contained file afterwards, and the way back for a restart.
#include "io/run_file.h"

#include "io/disk.h"
#include "io/file_checksum.h"
#include "io/manifest.h"
#include "io/run_directory.h"

#include <scree/scree.h>

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define CONVENTIONS                                                                                                    \
    "SI units. Stress and strain tensors: tension positive; forces and pressures of loading: compression positive. "   \
    "Arrays of bodies are in the order of their ids, 0 to n - 1. Contacts: normal n from the second to the first, "    \
    "t = (-n_y, n_x), forces act on the first. Walls: bottom, top, left, right; as the second of a contact they have " \
    "the ids 4294967280 and up."

/// HDF5 rounds the layout of each copied group up; found by tests to be far below this.
enum { ROOM_PER_GROUP = 16384 };

static const struct part_name {
    const char *group, *file;
} part_names[SCREE_PART_KINDS] = {{"snapshots", "snapshot"}, {"checkpoints", "checkpoint"}};

// ---- names and lists ---------------------------------------------------------------------------------------------

void scree_part_list_destroy(scree_part_list *list)
{
    scree_release(&list->index);
    list->count = list->capacity = 0;
}

static scree_status part_list_add(scree_part_list *list, int64_t index, scree_error *error)
{
    if (list->count == list->capacity) {
        size_t capacity = 2 * list->capacity + 16;
        scree_status status = scree_reallocate(&list->index, list->count, capacity, sizeof *list->index, error);
        if (status) return status;
        list->capacity = capacity;
    }
    list->index[list->count++] = index;
    return SCREE_OK;
}

static int ascending(const void *a, const void *b)
{
    int64_t x, y;
    memcpy(&x, a, sizeof x);
    memcpy(&y, b, sizeof y);
    return (x > y) - (x < y);
}

static void part_list_sort(scree_part_list *list)
{
    if (list->count > 1) qsort(list->index, list->count, sizeof *list->index, ascending);
}

static bool part_list_has(const scree_part_list *list, int64_t index)
{
    return list->count > 0 && bsearch(&index, list->index, list->count, sizeof *list->index, ascending);
}

void scree_part_group(scree_part_kind kind, int64_t index, char *name, size_t size)
{
    (void)snprintf(name, size, "/%s/%06" PRId64, part_names[kind].group, index);
}

/// "parts/snapshot-000012.h5", as it stands in links.
static void part_file(scree_part_kind kind, int64_t index, char *name, size_t size)
{
    (void)snprintf(name, size, SCREE_FOLDER_PARTS "/%s-%06" PRId64 ".h5", part_names[kind].file, index);
}

scree_status scree_part_path(const char *directory, scree_part_kind kind, int64_t index, char *path, size_t size,
                             scree_error *error)
{
    char name[64];
    part_file(kind, index, name, sizeof name);
    return scree_path_join(path, size, directory, name, error);
}

scree_status scree_run_file_path(const char *directory, char *path, size_t size, scree_error *error)
{
    return scree_path_join(path, size, directory, SCREE_FILE_RUN, error);
}

/// Number in a text that must be exactly "prefix-NNN.h5"; -1 when it is something else.
static int64_t number_of_part(const char *name, const char *prefix)
{
    size_t length = strlen(prefix);
    if (strncmp(name, prefix, length) != 0 || name[length] != '-') return -1;
    char *end;
    long long value = strtoll(name + length + 1, &end, 10);
    return end != name + length + 1 && strcmp(end, ".h5") == 0 ? value : -1;
}

/// What stands behind the name of a file that a restart has set aside.
#define ASIDE ".damaged"

/// A part, or what a replacement left beside it.
static bool is_part(const char *name, const char *prefix)
{
    char part[64];
    size_t length = strlen(name), ending = strlen(SCREE_REPLACEMENT);
    bool half = length > ending && strcmp(name + length - ending, SCREE_REPLACEMENT) == 0;
    (void)snprintf(part, sizeof part, "%.*s", (int)(length - (half ? ending : 0)), name);
    return number_of_part(part, prefix) >= 0;
}

scree_status scree_parts_list(const char *directory, scree_part_kind kind, scree_part_list *list, scree_error *error)
{
    *list = (scree_part_list){0};
    char path[PATH_MAX];
    scree_status status = scree_path_join(path, sizeof path, directory, SCREE_FOLDER_PARTS, error);
    if (status) return status;
    DIR *folder = opendir(path);
    if (!folder && errno == ENOENT) return SCREE_OK;
    if (!folder) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot read the folder '%s'", path);
    for (struct dirent *entry; !status && (entry = readdir(folder));) {
        int64_t index = number_of_part(entry->d_name, part_names[kind].file);
        if (index >= 0) status = part_list_add(list, index, error);
    }
    closedir(folder);
    if (status) scree_part_list_destroy(list);
    part_list_sort(list);
    return status;
}

/// What a pass over the groups of run.h5 fills.
typedef struct listing {
    scree_hdf5 *run;
    scree_part_list *list;
    bool own_only;
} listing;

static herr_t list_link(hid_t group, const char *name, const H5L_info_t *link, void *argument)
{
    listing *into = argument;
    (void)group;
    if (!into->own_only || link->type == H5L_TYPE_HARD)
        into->run->status = part_list_add(into->list, strtoll(name, NULL, 10), into->run->error);
    return into->run->status ? 1 : 0;
}

scree_status scree_run_file_list(scree_hdf5 *run, scree_part_kind kind, bool own_only, scree_part_list *list)
{
    *list = (scree_part_list){0};
    if (run->status) return run->status;
    const char *group = part_names[kind].group;
    listing into = {run, list, own_only};
    // One pass: links by their index are sorted anew for each, since the file keeps no index of them.
    if (H5Literate_by_name(run->file, group, H5_INDEX_NAME, H5_ITER_NATIVE, NULL, list_link, &into, H5P_DEFAULT) < 0)
        scree_hdf5_fail(run, "list", group);
    if (run->status) scree_part_list_destroy(list);
    part_list_sort(list);
    return run->status;
}

void scree_run_file_open_snapshot(scree_hdf5 *run, const char *path, size_t which, int64_t *index, char *group,
                                  size_t size, scree_error *error)
{
    scree_part_list list;
    scree_hdf5_open(run, path, error);
    if (!scree_run_file_list(run, SCREE_PART_SNAPSHOT, false, &list)) {
        if (which < list.count)
            *index = list.index[which];
        else
            run->status = scree_error_set(error, SCREE_ERROR_INPUT, "'%s' holds %zu snapshots: there is no number %zu",
                                          path, list.count, which);
    }
    scree_part_list_destroy(&list);
    scree_part_group(SCREE_PART_SNAPSHOT, *index, group, size);
}

// ---- links -------------------------------------------------------------------------------------------------------

void scree_run_file_create(scree_hdf5 *run, const char *path, const char *case_name, scree_error *error)
{
    scree_hdf5_create(run, path, error);
    scree_hdf5_set_text(run, "/", "program", "Scree " SCREE_VERSION);
    scree_hdf5_set_text(run, "/", "case", case_name);
    scree_hdf5_set_text(run, "/", "conventions", CONVENTIONS);
    for (scree_part_kind kind = 0; kind < SCREE_PART_KINDS; kind++) scree_hdf5_group(run, part_names[kind].group);
}

void scree_run_file_open(scree_hdf5 *run, const char *path, bool *sound, scree_error *error)
{
    scree_hdf5_open_checked(run, path, error);
    *sound = run->status == SCREE_OK;
    if (*sound || !run->damaged) return;
    (void)scree_hdf5_close(run);
    scree_hdf5_open(run, path, error);
}

scree_status scree_run_file_case_name(const char *path, char *name, size_t size, scree_error *error)
{
    scree_hdf5 run;
    scree_error reason;
    bool sound;
    name[0] = 0;
    if (access(path, F_OK) != 0) return SCREE_OK;
    scree_run_file_open(&run, path, &sound, &reason);
    scree_hdf5_get_text(&run, "/", "case", name, size);
    if (!scree_hdf5_close(&run) || run.damaged) return SCREE_OK;
    if (error) *error = reason;
    return reason.status;
}

/// Copies group `index` of the open run.h5 into a part of its own.
static void split_group(scree_hdf5 *run, const char *directory, scree_part_kind kind, int64_t index)
{
    char path[PATH_MAX], group[64];
    run->status = scree_part_path(directory, kind, index, path, sizeof path, run->error);
    if (run->status) return;
    scree_part_group(kind, index, group, sizeof group);
    scree_hdf5 part;
    scree_hdf5_create(&part, path, run->error);
    scree_hdf5_group(&part, part_names[kind].group);
    if (!part.status && H5Ocopy(run->file, group, part.file, group, H5P_DEFAULT, H5P_DEFAULT) < 0)
        scree_hdf5_fail(&part, "copy", group);
    run->status = scree_hdf5_save(&part);
}

static bool is_kept(const scree_kept *kept, scree_part_kind kind, int64_t index)
{
    if (kind == SCREE_PART_SNAPSHOT) return index < kept->snapshots;
    return index >= kept->first_checkpoint && index <= kept->last_checkpoint;
}

/// A run.h5 that is being taken apart.
typedef struct splitting {
    scree_hdf5 *run;
    const char *directory;
    const scree_kept *kept;
    scree_notes *notes;
    bool sound;           ///< its checksum is whole
    size_t written, lost; ///< groups put into parts, and left out
} splitting;

/// Puts one group into a part, when it is whole.
static void split_one(splitting *split, scree_part_kind kind, int64_t index)
{
    scree_hdf5 *run = split->run;
    char group[64];
    scree_error reason = {0};
    scree_part_group(kind, index, group, sizeof group);
    if (!split->sound && scree_hdf5_verify(run, group, &reason)) {
        scree_notes_add(split->notes, "%s %" PRId64 " is damaged and left out: %s", part_names[kind].file, index,
                        reason.message);
        split->lost++;
        return;
    }
    split_group(run, split->directory, kind, index);
    split->written++;
}

/// Puts what an open run.h5 holds itself back into parts, but those that are there or not kept.
static void split_all(splitting *split)
{
    scree_hdf5 *run = split->run;
    for (scree_part_kind kind = 0; kind < SCREE_PART_KINDS && !run->status; kind++) {
        scree_part_list groups, parts;
        if (scree_run_file_list(run, kind, true, &groups)) break;
        run->status = scree_parts_list(split->directory, kind, &parts, run->error);
        for (size_t k = 0; k < groups.count && !run->status; k++) {
            int64_t index = groups.index[k];
            if (is_kept(split->kept, kind, index) && !part_list_has(&parts, index)) split_one(split, kind, index);
        }
        scree_part_list_destroy(&groups);
        scree_part_list_destroy(&parts);
    }
}

/// What run.h5 holds itself is put into parts, which are on the disk before run.h5 is replaced. A damaged file that
/// something is lost with is kept under another name.
static scree_status split_file(const char *directory, const char *path, const scree_kept *kept, scree_notes *notes,
                               scree_error *error)
{
    if (access(path, F_OK) != 0) return SCREE_OK;
    scree_hdf5 run;
    scree_error reason = {0};
    char aside[PATH_MAX];
    splitting split = {.run = &run, .directory = directory, .kept = kept, .notes = notes};
    scree_run_file_open(&run, path, &split.sound, &reason);
    split_all(&split);
    bool unreadable = run.damaged;
    scree_status status = scree_hdf5_close(&run);
    if (status && !unreadable) {
        if (error) *error = reason;
        return status;
    }
    if (unreadable || split.lost > 0) {
        scree_notes_add(notes, "'%s' is damaged%s%s; it is written anew", path, unreadable ? ": " : "",
                        unreadable ? reason.message : "");
        int length = snprintf(aside, sizeof aside, "%s" ASIDE, path);
        // A second name: run.h5 itself stays until it is replaced.
        bool fits = length > 0 && (size_t)length < sizeof aside;
        if (fits) (void)unlink(aside);
        if (!fits || scree_manifest_add(path, &(const char *){ASIDE}, 1, &reason) || link(path, aside) != 0)
            scree_notes_add(notes, "it cannot be kept as '%s'", aside);
    } else if (!split.sound)
        scree_notes_add(notes, "'%s' is damaged, but nothing in it is lost; it is written anew", path);
    return split.written > 0 ? scree_parts_sync(directory, error) : SCREE_OK;
}

static void link_parts(scree_hdf5 *run, const char *directory, scree_part_kind kind, const scree_kept *kept)
{
    scree_part_list parts;
    if (run->status || (run->status = scree_parts_list(directory, kind, &parts, run->error))) return;
    size_t first = 0, count = 0;
    for (size_t k = 0; k < parts.count; k++)
        if (is_kept(kept, kind, parts.index[k])) parts.index[count++] = parts.index[k];
    if (kind == SCREE_PART_CHECKPOINT && count > SCREE_CHECKPOINTS_KEPT) first = count - SCREE_CHECKPOINTS_KEPT;
    for (size_t k = first; k < count && !run->status; k++) {
        char file[64], group[64];
        part_file(kind, parts.index[k], file, sizeof file);
        scree_part_group(kind, parts.index[k], group, sizeof group);
        if (H5Lcreate_external(file, group, run->file, group, H5P_DEFAULT, H5P_DEFAULT) < 0)
            scree_hdf5_fail(run, "link", group);
    }
    scree_part_list_destroy(&parts);
}

scree_status scree_parts_folder_make(const char *directory, scree_error *error)
{
    char path[PATH_MAX];
    scree_status status = scree_path_join(path, sizeof path, directory, SCREE_FOLDER_PARTS, error);
    if (!status && mkdir(path, 0777) != 0 && errno != EEXIST)
        status = scree_error_set_errno(error, SCREE_ERROR_IO, "cannot make the folder '%s'", path);
    return status;
}

scree_status scree_parts_sync(const char *directory, scree_error *error)
{
    char path[PATH_MAX];
    scree_status status = scree_path_join(path, sizeof path, directory, SCREE_FOLDER_PARTS, error);
    if (status || access(path, F_OK) != 0) return status;
    return scree_folder_sync(path, error);
}

scree_status scree_run_file_renew(const char *directory, const char *case_name, const scree_kept *kept,
                                  scree_notes *notes, scree_error *error)
{
    char path[PATH_MAX], name[256];
    scree_status status = scree_run_file_path(directory, path, sizeof path, error);
    if (!status) status = scree_parts_folder_make(directory, error);
    if (!status && !case_name) status = scree_run_file_case_name(path, name, sizeof name, error);
    if (!status) status = split_file(directory, path, kept, notes, error);
    if (status) return status;
    scree_hdf5 run;
    scree_run_file_create(&run, path, case_name ? case_name : name, error);
    for (scree_part_kind kind = 0; kind < SCREE_PART_KINDS; kind++) link_parts(&run, directory, kind, kept);
    return scree_hdf5_save(&run);
}

// ---- before a run goes on ----------------------------------------------------------------------------------------

scree_status scree_part_set_aside(const char *directory, scree_part_kind kind, int64_t index, const char *reason,
                                  scree_notes *notes, scree_error *error)
{
    char path[PATH_MAX], aside[PATH_MAX + 16];
    scree_status status = scree_part_path(directory, kind, index, path, sizeof path, error);
    if (status) return status;
    (void)snprintf(aside, sizeof aside, "%s" ASIDE, path);
    if (rename(path, aside) != 0) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot rename '%s'", path);
    scree_notes_add(notes, "%s %" PRId64 " is damaged and left out (kept as '%s'): %s", part_names[kind].file, index,
                    aside, reason);
    return SCREE_OK;
}

scree_status scree_part_remove(const char *directory, scree_part_kind kind, int64_t index, scree_error *error)
{
    char path[PATH_MAX];
    scree_status status = scree_part_path(directory, kind, index, path, sizeof path, error);
    if (!status && unlink(path) != 0) status = scree_error_set_errno(error, SCREE_ERROR_IO, "cannot remove '%s'", path);
    return status;
}

/// Does `action` to every part.
static scree_status for_each_part(const char *directory, const scree_kept *kept, scree_notes *notes,
                                  scree_status (*action)(const char *directory, scree_part_kind kind, int64_t index,
                                                         const scree_kept *kept, scree_notes *notes,
                                                         scree_error *error),
                                  scree_error *error)
{
    scree_status status = SCREE_OK;
    for (scree_part_kind kind = 0; kind < SCREE_PART_KINDS && !status; kind++) {
        scree_part_list parts;
        if ((status = scree_parts_list(directory, kind, &parts, error))) return status;
        for (size_t k = 0; k < parts.count && !status; k++)
            status = action(directory, kind, parts.index[k], kept, notes, error);
        scree_part_list_destroy(&parts);
    }
    return status;
}

static scree_status set_aside_damaged(const char *directory, scree_part_kind kind, int64_t index,
                                      const scree_kept *kept, scree_notes *notes, scree_error *error)
{
    char path[PATH_MAX];
    scree_error reason;
    scree_status status = scree_part_path(directory, kind, index, path, sizeof path, error);
    if (status || !is_kept(kept, kind, index) || !scree_file_checksum_check(path, &reason)) return status;
    return scree_part_set_aside(directory, kind, index, reason.message, notes, error);
}

static scree_status remove_not_kept(const char *directory, scree_part_kind kind, int64_t index, const scree_kept *kept,
                                    scree_notes *notes, scree_error *error)
{
    (void)notes;
    return is_kept(kept, kind, index) ? SCREE_OK : scree_part_remove(directory, kind, index, error);
}

scree_status scree_run_file_rewind(const char *directory, const char *case_name, const scree_kept *kept,
                                   scree_notes *notes, scree_error *error)
{
    scree_status status = for_each_part(directory, kept, notes, set_aside_damaged, error);
    if (!status) status = scree_run_file_renew(directory, case_name, kept, notes, error);
    return status ? status : for_each_part(directory, kept, notes, remove_not_kept, error);
}

// ---- the end of a run --------------------------------------------------------------------------------------------

/// Bytes of all parts in the lists, with room for what their groups cost in one file.
static scree_status room_for(const char *directory, const scree_part_list lists[SCREE_PART_KINDS], off_t *bytes,
                             scree_error *error)
{
    *bytes = ROOM_PER_GROUP;
    for (scree_part_kind kind = 0; kind < SCREE_PART_KINDS; kind++)
        for (size_t k = 0; k < lists[kind].count; k++) {
            char path[PATH_MAX];
            struct stat information;
            scree_status status = scree_part_path(directory, kind, lists[kind].index[k], path, sizeof path, error);
            if (status) return status;
            if (stat(path, &information) != 0)
                return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot read '%s'", path);
            *bytes += information.st_size + ROOM_PER_GROUP;
        }
    return SCREE_OK;
}

/// What HDF5 keeps of a file that is open grows up to 32 MB by itself, and parts are copied once: some of it will do.
static void keep_little(scree_hdf5 *run)
{
    enum { CACHE_BYTES = 1 << 16 };
    H5AC_cache_config_t config = {.version = H5AC__CURR_CACHE_CONFIG_VERSION};
    if (run->status || H5Fget_mdc_config(run->file, &config) < 0) return;
    config.set_initial_size = true;
    config.initial_size = config.max_size = CACHE_BYTES;
    config.min_size = CACHE_BYTES / 2;
    config.incr_mode = H5C_incr__off;
    config.flash_incr_mode = H5C_flash_incr__off;
    config.decr_mode = H5C_decr__off;
    (void)H5Fset_mdc_config(run->file, &config);
}

static void gather_part(scree_hdf5 *run, const char *directory, scree_part_kind kind, int64_t index)
{
    char path[PATH_MAX], group[64];
    if (run->status || (run->status = scree_part_path(directory, kind, index, path, sizeof path, run->error))) return;
    scree_part_group(kind, index, group, sizeof group);
    scree_hdf5 part;
    scree_hdf5_open_checked(&part, path, run->error);
    keep_little(&part);
    if (!part.status && H5Ocopy(part.file, group, run->file, group, H5P_DEFAULT, H5P_DEFAULT) < 0)
        scree_hdf5_fail(&part, "copy", group);
    run->status = scree_hdf5_close(&part);
    (void)H5garbage_collect();
}

/// Builds the self-contained file under the name `temporary`.
static scree_status gather(const char *directory, const char *temporary, const char *case_name,
                           const scree_part_list lists[SCREE_PART_KINDS], scree_error *error)
{
    off_t bytes;
    scree_hdf5 run;
    scree_run_file_create(&run, temporary, case_name, error);
    scree_status status = scree_hdf5_save(&run);
    if (!status) status = room_for(directory, lists, &bytes, error);
    if (!status) status = scree_file_reserve(temporary, 0, bytes, error);
    if (status) return status;
    scree_hdf5_extend(&run, temporary, error);
    keep_little(&run);
    for (scree_part_kind kind = 0; kind < SCREE_PART_KINDS; kind++)
        for (size_t k = 0; k < lists[kind].count; k++) gather_part(&run, directory, kind, lists[kind].index[k]);
    status = scree_hdf5_close(&run);
    (void)H5garbage_collect();
    scree_memory_trim();
    return status;
}

/// Removes every part, what a kill left beside them, and the folder when nothing else is in it.
static scree_status remove_parts(const char *directory, scree_error *error)
{
    char path[PATH_MAX];
    scree_status status = scree_path_join(path, sizeof path, directory, SCREE_FOLDER_PARTS, error);
    if (status) return status;
    DIR *folder = opendir(path);
    if (!folder) return SCREE_OK;
    for (struct dirent *entry; !status && (entry = readdir(folder));)
        for (scree_part_kind kind = 0; kind < SCREE_PART_KINDS; kind++) {
            bool own = is_part(entry->d_name, part_names[kind].file);
            if (own && unlinkat(dirfd(folder), entry->d_name, 0) != 0)
                status = scree_error_set_errno(error, SCREE_ERROR_IO, "cannot remove '%s/%s'", path, entry->d_name);
        }
    closedir(folder);
    (void)rmdir(path);
    return status;
}

/// True when run.h5 is there and no part is: the run has been finished before.
static scree_status is_finished(const char *directory, const char *path, bool *finished, scree_error *error)
{
    size_t parts = 0;
    for (scree_part_kind kind = 0; kind < SCREE_PART_KINDS; kind++) {
        scree_part_list list;
        scree_status status = scree_parts_list(directory, kind, &list, error);
        if (status) return status;
        parts += list.count;
        scree_part_list_destroy(&list);
    }
    *finished = parts == 0 && access(path, F_OK) == 0;
    return SCREE_OK;
}

/// From parts to a self-contained run.h5; parts are left alone.
static scree_status gather_all(const char *directory, const char *path, scree_error *error)
{
    char temporary[PATH_MAX], case_name[256];
    scree_part_list lists[SCREE_PART_KINDS] = {{0}, {0}};
    scree_status status = scree_path_join(temporary, sizeof temporary, directory, SCREE_FILE_RUN_WHOLE, error);
    if (!status) status = scree_run_file_case_name(path, case_name, sizeof case_name, error);
    for (scree_part_kind kind = 0; kind < SCREE_PART_KINDS && !status; kind++)
        status = scree_parts_list(directory, kind, &lists[kind], error);
    if (!status) {
        status = gather(directory, temporary, case_name, lists, error);
        if (!status) status = scree_replacement_put(temporary, path, error);
        if (status) unlink(temporary);
    }
    for (scree_part_kind kind = 0; kind < SCREE_PART_KINDS; kind++) scree_part_list_destroy(&lists[kind]);
    return status;
}

scree_status scree_run_file_finish(const char *directory, scree_notes *notes, scree_error *error)
{
    char path[PATH_MAX];
    bool finished = false;
    const scree_kept all = SCREE_KEEP_ALL;
    scree_status status = scree_run_file_path(directory, path, sizeof path, error);
    if (!status) status = is_finished(directory, path, &finished, error);
    // A finish that was killed left groups in run.h5 whose parts may be gone: renewing the links brings them back.
    if (!status && !finished) status = scree_run_file_rewind(directory, NULL, &all, notes, error);
    if (!status && !finished) status = gather_all(directory, path, error);
    // The parts go when the new name is on the disk.
    if (!status && !finished) status = scree_folder_sync(directory, error);
    return status ? status : remove_parts(directory, error);
}
