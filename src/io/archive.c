/// A run in little, to be kept: snapshots from which averages are made, without the state to go on from, and with
/// numbers of single precision (24 bits, 6e-8 of each) but for places and turns, beside its case and its results.
/// Numbers stay doubles, so whatever reads a run reads this too; their last bits are zeros, which packs well: of a pile
/// of 3000 polygons 2.7 MB, 0.5 MB after `xz` (run.h5 with 20 snapshots: 60 MB). It cannot be restarted.
///
/// Cost: linear in the snapshot, which has to fit into memory twice.
#include "io/archive.h"

#include "base/memory.h"
#include "io/disk.h"
#include "io/file_names.h"
#include "io/run_directory.h"
#include "io/run_file.h"
#include "io/snapshot.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// ---- numbers -----------------------------------------------------------------------------------------------------

/// To the nearest of 24 bits; what is not finite stays as it is.
static double rounded(double value)
{
    enum { DROPPED = 29 };
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    if ((bits >> 52 & 0x7ff) == 0x7ff) return value;
    const uint64_t more = bits + ((uint64_t)1 << (DROPPED - 1)), kept = more >> DROPPED << DROPPED;
    // The largest would become infinite.
    if ((kept >> 52 & 0x7ff) == 0x7ff) return value;
    memcpy(&value, &kept, sizeof value);
    return value;
}

static scree_status round_values(hid_t dataset, size_t count, scree_hdf5 *file)
{
    double *value = NULL;
    scree_status status = scree_allocate(&value, count + 1, sizeof *value, file->error);
    if (status) return status;
    bool good = H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0;
    for (size_t k = 0; k < count && good; k++) value[k] = rounded(value[k]);
    good = good && H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0;
    scree_release(&value);
    if (!good) scree_hdf5_fail(file, "round", NULL);
    return file->status;
}

/// Strains are differences of these.
static bool stays_whole(const char *name)
{
    static const char *const whole[] = {"position", "angle", "orientation"};
    for (size_t k = 0; k < sizeof whole / sizeof *whole; k++)
        if (strcmp(name, whole[k]) == 0) return true;
    return false;
}

/// Of the snapshot that is visited.
static herr_t round_object(hid_t group, const char *name, const H5O_info_t *info, void *user)
{
    scree_hdf5 *file = user;
    if (info->type != H5O_TYPE_DATASET || stays_whole(name)) return 0;
    const hid_t dataset = H5Dopen2(group, name, H5P_DEFAULT);
    const hid_t type = dataset >= 0 ? H5Dget_type(dataset) : H5I_INVALID_HID,
                space = dataset >= 0 ? H5Dget_space(dataset) : H5I_INVALID_HID;
    if (type < 0 || space < 0)
        scree_hdf5_fail(file, "read", name);
    else if (H5Tequal(type, H5T_NATIVE_DOUBLE) > 0 && H5Sget_simple_extent_npoints(space) > 0)
        file->status = round_values(dataset, (size_t)H5Sget_simple_extent_npoints(space), file);
    if (space >= 0) H5Sclose(space);
    if (type >= 0) H5Tclose(type);
    if (dataset >= 0) H5Dclose(dataset);
    return file->status ? -1 : 0;
}

// ---- the file ----------------------------------------------------------------------------------------------------

static void copy_group(scree_hdf5 *from, scree_hdf5 *to, const char *group)
{
    const hid_t copying = H5Pcreate(H5P_OBJECT_COPY);
    // While a run lasts its snapshots are files of their own.
    const bool copied = !to->status && copying >= 0 &&
                        H5Pset_copy_object(copying, H5O_COPY_EXPAND_EXT_LINK_FLAG) >= 0 &&
                        H5Ocopy(from->file, group, to->file, group, copying, H5P_DEFAULT) >= 0;
    if (!copied) scree_hdf5_fail(to, "copy", group);
    if (copying >= 0) H5Pclose(copying);
}

/// Drops what a run would go on from, and rounds the rest.
static void reduce(scree_hdf5 *file, const char *group, int64_t index)
{
    char state[80];
    scree_snapshot_state_group(index, state, sizeof state);
    if (file->status) return;
    if (H5Lexists(file->file, state, H5P_DEFAULT) > 0 && H5Ldelete(file->file, state, H5P_DEFAULT) < 0)
        scree_hdf5_fail(file, "drop", state);
    if (!file->status &&
        H5Ovisit_by_name(file->file, group, H5_INDEX_NAME, H5_ITER_NATIVE, round_object, file, H5P_DEFAULT) < 0)
        scree_hdf5_fail(file, "round", group);
}

/// By way of a copy in memory, which keeps the room of what is dropped.
static void copy_snapshot(scree_hdf5 *from, scree_hdf5 *to, int64_t index)
{
    char group[64], name[PATH_MAX];
    scree_hdf5 whole;
    scree_part_group(SCREE_PART_SNAPSHOT, index, group, sizeof group);
    // Two files in memory need two names.
    (void)snprintf(name, sizeof name, "%.*s.all", PATH_MAX - 8, to->path);
    scree_run_file_create(&whole, name, "", to->error);
    copy_group(from, &whole, group);
    reduce(&whole, group, index);
    if (!whole.status) copy_group(&whole, to, group);
    const scree_status status = scree_hdf5_close(&whole);
    if (!to->status) to->status = status;
}

static scree_status archive_file(const char *directory, const char *target, const int64_t *index, size_t count,
                                 scree_error *error)
{
    char path[PATH_MAX], copy[PATH_MAX], name[256];
    scree_hdf5 from, to;
    bool sound;
    scree_status status = scree_run_file_path(directory, path, sizeof path, error);
    if (!status) status = scree_run_file_path(target, copy, sizeof copy, error);
    if (!status) status = scree_run_file_case_name(path, name, sizeof name, error);
    if (status) return status;
    scree_run_file_open(&from, path, &sound, error);
    if (from.status) return scree_hdf5_close(&from);
    scree_run_file_create(&to, copy, name, error);
    for (size_t k = 0; k < count && !to.status; k++) copy_snapshot(&from, &to, index[k]);
    status = to.status ? scree_hdf5_close(&to) : scree_hdf5_save(&to);
    const scree_status closed = scree_hdf5_close(&from);
    return status ? status : closed;
}

/// The case and the results, as they are; only piles have an outline.
static scree_status copy_text(const char *directory, const char *target, const char *name, scree_error *error)
{
    char from[PATH_MAX], to[PATH_MAX];
    scree_status status = scree_path_join(from, sizeof from, directory, name, error);
    if (!status) status = scree_path_join(to, sizeof to, target, name, error);
    if (!status && access(from, F_OK) != 0 && errno == ENOENT) return SCREE_OK;
    return status ? status : scree_file_copy(from, to, error);
}

scree_status scree_run_archive(const char *directory, const char *target, const int64_t *index, size_t count,
                               scree_error *error)
{
    static const char *const text[] = {SCREE_FILE_CASE, SCREE_FILE_SUMMARY, SCREE_FILE_SERIES, SCREE_FILE_OUTLINE};
    scree_status status = SCREE_OK;
    if (mkdir(target, 0777) != 0)
        return errno == EEXIST
                   ? scree_error_set(error, SCREE_ERROR_INPUT, "there is a '%s' already: give another name", target)
                   : scree_error_set_errno(error, SCREE_ERROR_IO, "cannot make '%s'", target);
    for (size_t k = 0; k < sizeof text / sizeof *text && !status; k++)
        status = copy_text(directory, target, text[k], error);
    return status ? status : archive_file(directory, target, index, count, error);
}
