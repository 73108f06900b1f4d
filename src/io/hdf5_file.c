/// HDF5 files: opening, arrays, attributes. See the header for the method.
#include "io/hdf5_file.h"

#include "base/memory.h"
#include "comm/comm.h"
#include "io/file_checksum.h"
#include "io/run_directory.h"

#include <errno.h>
#include <limits.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/// Debian's HDF5 is not for several threads at once: whoever has a file open holds this, from begin to close. The
/// thread that holds it may open another one.
static pthread_mutex_t in_use = PTHREAD_RECURSIVE_MUTEX_INITIALIZER_NP;

/// Growth of a file in memory.
enum { MEMORY_STEP = 1 << 20 };
/// Bytes: datasets up to SCREE_ARRAY_SMALL lie in their object header (which holds 64 KiB); of larger ones what a
/// process writes lies in one chunk, up to this size.
enum { CHUNK_SIZE = 1 << 30 };
enum { MOST_COMPACT = 65535 };
/// What HDF5 1.10 takes for itself in a file, with room to spare (2 MB were seen).
enum { LIBRARY_BYTES = 4 << 20 };

// ---- errors ------------------------------------------------------------------------------------------------------

/// Keeps the first message of HDF5's stack, which is the innermost.
static herr_t keep_first(unsigned n, const H5E_error2_t *entry, void *text)
{
    if (n == 0 && entry->desc) (void)snprintf(text, 256, ": %s", entry->desc);
    return 0;
}

void scree_hdf5_fail(scree_hdf5 *hdf5, const char *action, const char *name)
{
    if (hdf5->status) return;
    char reason[256] = "";
    const char *quote = name ? "'" : "", *of = name ? " of " : "";
    (void)H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, reason);
    if (errno == ENOMEM) (void)snprintf(reason, sizeof reason, ": out of memory");
    hdf5->damaged = errno != ENOMEM;
    hdf5->status = scree_error_set(hdf5->error, SCREE_ERROR_IO, "cannot %s %s%s%s%s'%s'%s", action, quote,
                                   name ? name : "", quote, of, hdf5->path, reason);
}

void scree_hdf5_damaged(scree_hdf5 *hdf5, const char *reason)
{
    if (hdf5->status) return;
    hdf5->damaged = true;
    hdf5->status = scree_error_set(hdf5->error, SCREE_ERROR_IO, "'%s' is damaged: %s", hdf5->path, reason);
}

void scree_hdf5_refuse(scree_hdf5 *hdf5, const char *format, ...)
{
    char reason[256];
    va_list values;
    va_start(values, format);
    (void)vsnprintf(reason, sizeof reason, format, values);
    va_end(values);
    scree_hdf5_damaged(hdf5, reason);
}

// ---- opening and closing -----------------------------------------------------------------------------------------

static void begin(scree_hdf5 *hdf5, const char *path, scree_error *error)
{
    *hdf5 = (scree_hdf5){.file = H5I_INVALID_HID, .group = H5I_INVALID_HID, .path = path, .error = error};
    (void)pthread_mutex_lock(&in_use);
    // Every file is closed here; at exit HDF5 (1.10) would complain of what it lost in damaged ones itself.
    (void)H5dont_atexit();
    (void)H5Eget_auto2(H5E_DEFAULT, &hdf5->printing, &hdf5->printing_data);
    (void)H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    hdf5->status = scree_memory_check(LIBRARY_BYTES, error);
    errno = 0;
}

// The memory of a file that is built there. HDF5 marks a file as open in its head and takes the mark away when it
// closes it, so the bytes that leave are those that it hands back then. (The copy that H5Fget_file_image makes has a
// wrong checksum in HDF5 1.10.8.)

static void *image_make(size_t size, H5FD_file_image_op_t why, void *hdf5)
{
    (void)why, (void)hdf5;
    return malloc(size);
}

static void *image_copy(void *to, const void *from, size_t size, H5FD_file_image_op_t why, void *hdf5)
{
    (void)why, (void)hdf5;
    return memcpy(to, from, size);
}

static void *image_grow(void *image, size_t size, H5FD_file_image_op_t why, void *hdf5)
{
    (void)why, (void)hdf5;
    return realloc(image, size);
}

static herr_t image_end(void *image, H5FD_file_image_op_t why, void *hdf5)
{
    scree_hdf5 *file = hdf5;
    if (why == H5FD_FILE_IMAGE_OP_FILE_CLOSE && file->keep)
        file->image = image;
    else
        free(image);
    return 0;
}

static void *same(void *hdf5)
{
    return hdf5;
}

static herr_t nothing(void *hdf5)
{
    (void)hdf5;
    return 0;
}

static bool in_memory(hid_t access, scree_hdf5 *hdf5)
{
    H5FD_file_image_callbacks_t calls = {image_make, image_copy, image_grow, image_end, same, nothing, hdf5};
    return H5Pset_fapl_core(access, MEMORY_STEP, false) >= 0 && H5Pset_file_image_callbacks(access, &calls) >= 0;
}

/// No locks: a file on disk is never changed, only replaced, and locks fail on some network file systems.
static hid_t access_properties(void)
{
    hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    bool good = access >= 0 && H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_LATEST) >= 0 &&
                H5Pset_fclose_degree(access, H5F_CLOSE_STRONG) >= 0 && H5Pset_file_locking(access, false, true) >= 0;
    if (good) return access;
    if (access >= 0) H5Pclose(access);
    return H5I_INVALID_HID;
}

/// Links and attributes lie in the header of their group or file, which has a checksum, however many there are: HDF5
/// (1.10) crashes on damage in the heaps that it would put many of them into.
static bool set_compact(hid_t made)
{
    return H5Pset_link_phase_change(made, MOST_COMPACT, MOST_COMPACT) >= 0 &&
           H5Pset_attr_phase_change(made, MOST_COMPACT, MOST_COMPACT) >= 0;
}

static hid_t creation_properties(void)
{
    hid_t made = H5Pcreate(H5P_FILE_CREATE);
    if (made < 0 || set_compact(made)) return made;
    H5Pclose(made);
    return H5I_INVALID_HID;
}

/// A file in memory, or one that all processes write.
static void make_file(scree_hdf5 *hdf5, const char *name)
{
    hid_t access = access_properties(), made = creation_properties();
    bool good = access >= 0 && made >= 0;
    if (good) good = hdf5->together.path ? scree_comm_open_together(access) : in_memory(access, hdf5);
    if (good) hdf5->file = H5Fcreate(name, H5F_ACC_TRUNC, made, access);
    if (hdf5->file < 0) scree_hdf5_fail(hdf5, "prepare", NULL);
    if (made >= 0) H5Pclose(made);
    if (access >= 0) H5Pclose(access);
}

void scree_hdf5_create(scree_hdf5 *hdf5, const char *path, scree_error *error)
{
    begin(hdf5, path, error);
    if (!hdf5->status) make_file(hdf5, path);
}

void scree_hdf5_create_together(scree_hdf5 *hdf5, const char *path, scree_error *error)
{
    char name[PATH_MAX];
    begin(hdf5, path, error);
    if (!hdf5->status && scree_comm_size() > 1) hdf5->status = scree_together_begin(&hdf5->together, path, name, error);
    if (!hdf5->status) make_file(hdf5, hdf5->together.path ? name : path);
}

static void open_existing(scree_hdf5 *hdf5, unsigned mode)
{
    if (hdf5->status) return;
    // HDF5 says it in its own words.
    if (access(hdf5->path, F_OK) != 0) {
        hdf5->damaged = true;
        hdf5->status = scree_error_set_errno(hdf5->error, SCREE_ERROR_IO, "cannot open '%s'", hdf5->path);
        return;
    }
    hid_t access = access_properties();
    if (access >= 0) hdf5->file = H5Fopen(hdf5->path, mode, access);
    if (hdf5->file < 0) scree_hdf5_fail(hdf5, "open", NULL);
    if (access >= 0) H5Pclose(access);
}

void scree_hdf5_open(scree_hdf5 *hdf5, const char *path, scree_error *error)
{
    begin(hdf5, path, error);
    open_existing(hdf5, H5F_ACC_RDONLY);
}

void scree_hdf5_open_checked(scree_hdf5 *hdf5, const char *path, scree_error *error)
{
    begin(hdf5, path, error);
    if (hdf5->status) return;
    hdf5->status = scree_file_checksum_check(path, error);
    hdf5->damaged = hdf5->status != SCREE_OK;
    if (!hdf5->status) open_existing(hdf5, H5F_ACC_RDONLY);
}

void scree_hdf5_extend(scree_hdf5 *hdf5, const char *path, scree_error *error)
{
    begin(hdf5, path, error);
    open_existing(hdf5, H5F_ACC_RDWR);
}

static void leave_group(scree_hdf5 *hdf5)
{
    if (hdf5->group >= 0) H5Gclose(hdf5->group);
    hdf5->group = H5I_INVALID_HID;
}

scree_status scree_hdf5_close(scree_hdf5 *hdf5)
{
    leave_group(hdf5);
    if (hdf5->file >= 0 && H5Fclose(hdf5->file) < 0) scree_hdf5_fail(hdf5, "close", NULL);
    hdf5->file = H5I_INVALID_HID;
    (void)H5Eclear2(H5E_DEFAULT);
    (void)H5Eset_auto2(H5E_DEFAULT, hdf5->printing, hdf5->printing_data);
    (void)pthread_mutex_unlock(&in_use);
    return hdf5->status;
}

/// Closes a file in memory and keeps its bytes in hdf5->image; the core driver holds more of them than the file needs.
static size_t take_ghost(scree_hdf5 *hdf5)
{
    ssize_t size = 0;
    if (H5Fflush(hdf5->file, H5F_SCOPE_GLOBAL) < 0 || (size = H5Fget_file_image(hdf5->file, NULL, 0)) < 0)
        scree_hdf5_fail(hdf5, "prepare", NULL);
    hdf5->keep = hdf5->status == SCREE_OK;
    if (H5Fclose(hdf5->file) < 0 || (hdf5->keep && !hdf5->image)) scree_hdf5_fail(hdf5, "close", NULL);
    hdf5->file = H5I_INVALID_HID;
    return size < 0 ? 0 : (size_t)size;
}

static void save_image(scree_hdf5 *hdf5)
{
    FILE *file;
    size_t size = hdf5->status ? 0 : take_ghost(hdf5);
    if (!hdf5->status) hdf5->status = scree_replace_begin(hdf5->path, &file, hdf5->error);
    if (!hdf5->status) {
        unsigned char ending[SCREE_FILE_CHECKSUM_SIZE];
        scree_file_checksum_make(hdf5->image, size, ending);
        bool whole =
            fwrite(hdf5->image, 1, size, file) == size && fwrite(ending, 1, sizeof ending, file) == sizeof ending;
        if (!whole) hdf5->status = scree_error_set_errno(hdf5->error, SCREE_ERROR_IO, "cannot write '%s'", hdf5->path);
        scree_status finished = scree_replace_finish(hdf5->path, file, whole, whole ? hdf5->error : NULL);
        if (whole) hdf5->status = finished;
    }
    free(hdf5->image);
    hdf5->image = NULL;
}

static void save_together(scree_hdf5 *hdf5)
{
    if (!hdf5->status) hdf5->status = scree_together_take_room(&hdf5->together, hdf5->error);
    if (!hdf5->status && (H5Fflush(hdf5->file, H5F_SCOPE_GLOBAL) < 0 || H5Fclose(hdf5->file) < 0))
        scree_hdf5_fail(hdf5, "write", NULL);
    // What has failed is not closed, since all would have to take part.
    hdf5->file = H5I_INVALID_HID;
    hdf5->status = scree_together_end(&hdf5->together, hdf5->status, hdf5->error);
}

scree_status scree_hdf5_save(scree_hdf5 *hdf5)
{
    leave_group(hdf5);
    if (hdf5->together.path)
        save_together(hdf5);
    else
        save_image(hdf5);
    return scree_hdf5_close(hdf5);
}

// ---- arrays ------------------------------------------------------------------------------------------------------

static hid_t memory_type(scree_field_type type)
{
    switch (type) {
    case SCREE_FIELD_DOUBLE:
        return H5T_NATIVE_DOUBLE;
    case SCREE_FIELD_INT64:
        return H5T_NATIVE_INT64;
    case SCREE_FIELD_UINT64:
        return H5T_NATIVE_UINT64;
    case SCREE_FIELD_FLOAT:
        return H5T_NATIVE_FLOAT;
    case SCREE_FIELD_INT32:
        return H5T_NATIVE_INT32;
    case SCREE_FIELD_UINT32:
        return H5T_NATIVE_UINT32;
    case SCREE_FIELD_UINT8:
        break;
    }
    return H5T_NATIVE_UINT8;
}

/// Dimensions of the dataset of an array; returns the rank. A single value has rank 0, a single vector rank 1.
static int dimensions_of(const scree_array *array, hsize_t dimensions[2])
{
    int rank = 0;
    if (!array->single) dimensions[rank++] = array->rows;
    if (array->components > 1) dimensions[rank++] = (hsize_t)array->components;
    return rank;
}

static void path_in_file(char *path, size_t size, const char *group, const char *name)
{
    (void)snprintf(path, size, "%s/%s", group ? group : "", name);
}

static void make_group(scree_hdf5 *hdf5, const char *name)
{
    hid_t made = H5Pcreate(H5P_GROUP_CREATE), group = H5I_INVALID_HID;
    if (made >= 0 && set_compact(made)) group = H5Gcreate2(hdf5->file, name, H5P_DEFAULT, made, H5P_DEFAULT);
    if (group < 0) scree_hdf5_fail(hdf5, "make group", name);
    if (group >= 0) H5Gclose(group);
    if (made >= 0) H5Pclose(made);
}

/// Makes the groups above the object `name` that are not there.
static void make_groups_above(scree_hdf5 *hdf5, const char *name)
{
    char above[160];
    for (const char *end = strchr(name + 1, '/'); end && !hdf5->status; end = strchr(end + 1, '/')) {
        (void)snprintf(above, sizeof above, "%.*s", (int)(end - name), name);
        if (H5Lexists(hdf5->file, above, H5P_DEFAULT) <= 0) make_group(hdf5, above);
    }
}

void scree_hdf5_group(scree_hdf5 *hdf5, const char *name)
{
    if (hdf5->status) return;
    make_groups_above(hdf5, name);
    if (!hdf5->status && H5Lexists(hdf5->file, name, H5P_DEFAULT) <= 0) make_group(hdf5, name);
}

/// Where the dataset `name` is, and *leaf, what it is called there: in its group, which stays open for the next one
/// (finding a group by its name, and asking whether it is there, takes as long as making a small dataset); in a file of
/// all processes by its whole name. With `make` groups that are not there are made. Negative on failure.
static hid_t enter_group(scree_hdf5 *hdf5, const char *name, bool make, const char **leaf)
{
    const char *end = strrchr(name, '/');
    const size_t length = (size_t)(end - name);
    *leaf = hdf5->together.path || length == 0 ? name : end + 1;
    const bool entered = hdf5->group >= 0 && strncmp(hdf5->group_name, name, length) == 0 &&
                         hdf5->group_name[length] == 0 && *leaf != name;
    if (entered) return hdf5->group;
    if (make) make_groups_above(hdf5, name);
    if (*leaf == name) return hdf5->file;
    leave_group(hdf5);
    (void)snprintf(hdf5->group_name, sizeof hdf5->group_name, "%.*s", (int)length, name);
    if (!hdf5->status) hdf5->group = H5Gopen2(hdf5->file, hdf5->group_name, H5P_DEFAULT);
    return hdf5->group;
}

/// Creation properties of a dataset, so that its values have a checksum: small ones lie in the object header, which has
/// one, others in chunks with Fletcher's: one of each process that writes. Negative on failure.
static hid_t with_checksum(const scree_hdf5 *hdf5, const scree_array *all, int rank, const hsize_t dimensions[2])
{
    hid_t made = H5Pcreate(H5P_DATASET_CREATE);
    bool good = made >= 0;
    if (good && scree_array_is_small(all)) {
        good = H5Pset_layout(made, H5D_COMPACT) >= 0;
    } else if (good) {
        size_t rows = hdf5->together.path ? scree_range_rows(all->rows) : all->rows;
        size_t chunks = (rows * scree_array_row_size(all) + CHUNK_SIZE - 1) / CHUNK_SIZE;
        const hsize_t chunk[2] = {(rows + chunks - 1) / chunks, rank > 1 ? dimensions[1] : 1};
        good = H5Pset_chunk(made, rank, chunk) >= 0 && H5Pset_fletcher32(made) >= 0;
    }
    if (good) return made;
    if (made >= 0) H5Pclose(made);
    return H5I_INVALID_HID;
}

/// Room in memory and on the disk for an array, which as the file has it is `all`.
static scree_status prepare(scree_hdf5 *hdf5, const scree_array *array, scree_array *all)
{
    const bool together = hdf5->together.path != NULL;
    // The file in memory grows by being copied.
    hdf5->written = array->rows * scree_array_row_size(array) + (together ? 0 : hdf5->written);
    if (array->rows == 0 && !together) return SCREE_OK;
    scree_status status = scree_memory_check(2 * hdf5->written + LIBRARY_BYTES, hdf5->error);
    return status || !together ? status : scree_together_prepare(&hdf5->together, array, all, hdf5->error);
}

static bool write_rows(const scree_hdf5 *hdf5, hid_t dataset, const scree_array *array, const scree_array *all)
{
    const hid_t type = memory_type(array->type);
    if (all->rows == 0) return true;
    if (hdf5->together.path && !scree_array_is_small(all)) return scree_together_write(dataset, type, array, all);
    return H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all->data) >= 0;
}

/// A text of fixed length, filled with zeros; negative on failure.
static hid_t text_type(size_t size)
{
    hid_t type = H5Tcopy(H5T_C_S1);
    if (type >= 0 && H5Tset_size(type, size) >= 0 && H5Tset_cset(type, H5T_CSET_UTF8) >= 0) return type;
    if (type >= 0) H5Tclose(type);
    return H5I_INVALID_HID;
}

static void make_attribute(scree_hdf5 *hdf5, hid_t object, const char *attribute, hid_t type, const void *value)
{
    if (hdf5->status) return;
    hid_t space = H5Screate(H5S_SCALAR), made = H5I_INVALID_HID;
    if (space >= 0 && type >= 0 && object >= 0)
        made = H5Acreate2(object, attribute, type, space, H5P_DEFAULT, H5P_DEFAULT);
    if (made < 0 || H5Awrite(made, type, value) < 0) scree_hdf5_fail(hdf5, "write attribute", attribute);
    if (made >= 0) H5Aclose(made);
    if (space >= 0) H5Sclose(space);
}

static void describe(scree_hdf5 *hdf5, hid_t object, const char *attribute, const char *text)
{
    if (hdf5->status) return;
    hid_t type = text_type(strlen(text) + 1);
    make_attribute(hdf5, object, attribute, type, text);
    if (type >= 0) H5Tclose(type);
}

void scree_hdf5_write(scree_hdf5 *hdf5, const char *group, const scree_array *array)
{
    if (hdf5->status) return;
    char name[160];
    scree_array all = *array;
    all.rows = scree_array_total(array);
    path_in_file(name, sizeof name, group, array->name);
    if ((hdf5->status = prepare(hdf5, array, &all))) return;
    hsize_t dimensions[2];
    int rank = dimensions_of(&all, dimensions);
    hid_t space = rank ? H5Screate_simple(rank, dimensions, NULL) : H5Screate(H5S_SCALAR);
    const char *leaf;
    hid_t dataset = H5I_INVALID_HID, layout = with_checksum(hdf5, &all, rank, dimensions);
    const hid_t there = enter_group(hdf5, name, true, &leaf);
    if (space >= 0 && layout >= 0 && there >= 0)
        dataset = H5Dcreate2(there, leaf, memory_type(array->type), space, H5P_DEFAULT, layout, H5P_DEFAULT);
    if (dataset < 0 || !write_rows(hdf5, dataset, array, &all)) scree_hdf5_fail(hdf5, "write", name);
    describe(hdf5, dataset, "unit", array->unit);
    describe(hdf5, dataset, "description", array->meaning);
    if (dataset >= 0) H5Dclose(dataset);
    if (layout >= 0) H5Pclose(layout);
    if (space >= 0) H5Sclose(space);
    if (all.data != array->data) scree_array_destroy(&all);
}

/// True when the dataset has the type and shape of `array`; sets array->rows.
static bool agrees(hid_t dataset, scree_array *array)
{
    hid_t space = H5Dget_space(dataset), type = H5Dget_type(dataset);
    hsize_t expected[2] = {0, 0}, found[H5S_MAX_RANK] = {0};
    int rank = dimensions_of(array, expected);
    bool same = space >= 0 && type >= 0 && H5Tequal(type, memory_type(array->type)) > 0 &&
                H5Sget_simple_extent_ndims(space) == rank && H5Sget_simple_extent_dims(space, found, NULL) == rank;
    if (same && array->components > 1) same = found[rank - 1] == (hsize_t)array->components;
    if (same) array->rows = array->single ? 1 : (size_t)found[0];
    if (type >= 0) H5Tclose(type);
    if (space >= 0) H5Sclose(space);
    return same;
}

/// The range of this process of all rows.
static void take_range(scree_array *array)
{
    array->total = array->rows;
    array->begin = scree_range_begin(array->total, scree_comm_rank());
    array->rows = scree_range_begin(array->total, scree_comm_rank() + 1) - array->begin;
}

static bool read_rows(hid_t dataset, const scree_array *array)
{
    const hid_t type = memory_type(array->type);
    if (array->rows == 0) return true;
    if (array->total == 0) return H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, array->data) >= 0;
    hsize_t rows[2];
    const hsize_t begin[2] = {array->begin, 0};
    const int rank = dimensions_of(array, rows);
    const hid_t in_file = H5Dget_space(dataset), in_memory = H5Screate_simple(rank, rows, NULL);
    const bool good = in_file >= 0 && in_memory >= 0 &&
                      H5Sselect_hyperslab(in_file, H5S_SELECT_SET, begin, NULL, rows, NULL) >= 0 &&
                      H5Dread(dataset, type, in_memory, in_file, H5P_DEFAULT, array->data) >= 0;
    if (in_memory >= 0) H5Sclose(in_memory);
    if (in_file >= 0) H5Sclose(in_file);
    return good;
}

static void read_array(scree_hdf5 *hdf5, const char *group, scree_array *array, bool range)
{
    array->data = NULL;
    array->rows = 0;
    if (hdf5->status) return;
    char name[160];
    path_in_file(name, sizeof name, group, array->name);
    const char *leaf;
    const hid_t there = enter_group(hdf5, name, false, &leaf);
    hid_t dataset = there >= 0 ? H5Dopen2(there, leaf, H5P_DEFAULT) : H5I_INVALID_HID;
    const bool agreed = dataset >= 0 && agrees(dataset, array);
    if (agreed && range) take_range(array);
    if (dataset < 0)
        scree_hdf5_fail(hdf5, "read", name);
    else if (!agreed)
        scree_hdf5_damaged(hdf5, "a dataset has another type or shape");
    else if (!(hdf5->status = scree_array_allocate(array, hdf5->error)) && !read_rows(dataset, array))
        scree_hdf5_fail(hdf5, "read", name);
    if (dataset >= 0) H5Dclose(dataset);
    if (hdf5->status) scree_array_destroy(array);
}

void scree_hdf5_read(scree_hdf5 *hdf5, const char *group, scree_array *array)
{
    read_array(hdf5, group, array, false);
}

void scree_hdf5_read_range(scree_hdf5 *hdf5, const char *group, scree_array *array)
{
    read_array(hdf5, group, array, true);
}

// ---- attributes --------------------------------------------------------------------------------------------------

static void set_attribute(scree_hdf5 *hdf5, const char *name, const char *attribute, hid_t type, const void *value)
{
    if (hdf5->status) return;
    const hid_t object = H5Oopen(hdf5->file, name, H5P_DEFAULT);
    make_attribute(hdf5, object, attribute, type, value);
    if (object >= 0) H5Oclose(object);
}

static void get_attribute(scree_hdf5 *hdf5, const char *name, const char *attribute, hid_t type, void *value)
{
    if (hdf5->status) return;
    hid_t found = H5Aopen_by_name(hdf5->file, name, attribute, H5P_DEFAULT, H5P_DEFAULT);
    hid_t space = found >= 0 ? H5Aget_space(found) : H5I_INVALID_HID;
    bool scalar = space >= 0 && H5Sget_simple_extent_npoints(space) == 1;
    if (!scalar || H5Aread(found, type, value) < 0) scree_hdf5_fail(hdf5, "read attribute", attribute);
    if (space >= 0) H5Sclose(space);
    if (found >= 0) H5Aclose(found);
}

void scree_hdf5_set_text(scree_hdf5 *hdf5, const char *name, const char *attribute, const char *text)
{
    hid_t type = text_type(strlen(text) + 1);
    set_attribute(hdf5, name, attribute, type, text);
    if (type >= 0) H5Tclose(type);
}

void scree_hdf5_set_number(scree_hdf5 *hdf5, const char *name, const char *attribute, double value)
{
    set_attribute(hdf5, name, attribute, H5T_NATIVE_DOUBLE, &value);
}

void scree_hdf5_set_integer(scree_hdf5 *hdf5, const char *name, const char *attribute, uint64_t value)
{
    set_attribute(hdf5, name, attribute, H5T_NATIVE_UINT64, &value);
}

void scree_hdf5_get_text(scree_hdf5 *hdf5, const char *name, const char *attribute, char *text, size_t size)
{
    text[0] = 0;
    hid_t type = text_type(size);
    get_attribute(hdf5, name, attribute, type, text);
    text[size - 1] = 0;
    if (type >= 0) H5Tclose(type);
}

void scree_hdf5_get_number(scree_hdf5 *hdf5, const char *name, const char *attribute, double *value)
{
    get_attribute(hdf5, name, attribute, H5T_NATIVE_DOUBLE, value);
}

void scree_hdf5_get_integer(scree_hdf5 *hdf5, const char *name, const char *attribute, uint64_t *value)
{
    get_attribute(hdf5, name, attribute, H5T_NATIVE_UINT64, value);
}
