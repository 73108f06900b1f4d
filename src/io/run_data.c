/// What is in run.h5, for programs: names, datasets and attributes, whatever has been written there. The file is opened
/// and closed in each call, so a run that goes on is not disturbed (run_file.h).
#include "base/memory.h"
#include "io/run_file.h"

#include <scree/run.h>

#include <limits.h>
#include <string.h>

enum { TEXT = 512 };

/// A dataset in memory: one block, which the keeper holds.
typedef struct held_data {
    char unit[64], meaning[TEXT];
    _Alignas(SCREE_ALIGNMENT) unsigned char data[];
} held_data;

/// Runs `look` on the object `path` of run.h5.
typedef struct looking {
    scree_hdf5 hdf5;
    hid_t object;
    void *what, *user;
    scree_error *error;
} looking;

static scree_status look(const char *directory, const char *path, H5I_type_t wanted, void (*see)(looking *l),
                         looking *l)
{
    char file[PATH_MAX];
    bool sound;
    scree_status status = scree_run_file_path(directory, file, sizeof file, l->error);
    if (status) return status;
    scree_run_file_open(&l->hdf5, file, &sound, l->error);
    if (!l->hdf5.status) {
        l->object = H5Oopen(l->hdf5.file, path, H5P_DEFAULT);
        H5I_type_t type = l->object >= 0 ? H5Iget_type(l->object) : H5I_BADID;
        if (type == H5I_BADID || (wanted != H5I_BADID && type != wanted))
            l->hdf5.status = scree_error_set(l->error, SCREE_ERROR_INPUT, "run.h5 in '%s' has no %s '%s'", directory,
                                             wanted == H5I_DATASET ? "dataset" : "group", path);
        else
            see(l);
        if (l->object >= 0) H5Oclose(l->object);
    }
    return scree_hdf5_close(&l->hdf5);
}

// ---- names -------------------------------------------------------------------------------------------------------

typedef void visit_name(void *user, const char *name, bool is_group);

static herr_t tell_name(hid_t group, const char *name, const H5L_info_t *info, void *data)
{
    (void)info;
    looking *l = data;
    hid_t object = H5Oopen(group, name, H5P_DEFAULT);
    if (object < 0) return 0; // a link to a part that is not there any more
    (*(visit_name **)l->what)(l->user, name, H5Iget_type(object) == H5I_GROUP);
    H5Oclose(object);
    return 0;
}

static void see_names(looking *l)
{
    hsize_t index = 0;
    if (H5Literate(l->object, H5_INDEX_NAME, H5_ITER_INC, &index, tell_name, l) < 0)
        scree_hdf5_fail(&l->hdf5, "list", "the groups of run.h5");
}

scree_status scree_run_data_visit(const char *directory, const char *group,
                                  void (*visit)(void *user, const char *name, bool is_group), void *user,
                                  scree_error *error)
{
    looking l = {.what = &visit, .user = user, .error = error};
    return look(directory, group, H5I_GROUP, see_names, &l);
}

// ---- attributes --------------------------------------------------------------------------------------------------

typedef void visit_attribute(void *user, const char *name, double number, const char *text);

/// A text, cut, or a number; what is neither is left out. Returns whether there is one.
static bool get_attribute(hid_t object, const char *name, double *number, char *text, size_t size)
{
    hid_t found = H5Aopen(object, name, H5P_DEFAULT), type = found >= 0 ? H5Aget_type(found) : H5I_INVALID_HID;
    bool is_text = type >= 0 && H5Tget_class(type) == H5T_STRING, there = false;
    size_t length = type >= 0 ? H5Tget_size(type) : 0;
    hid_t space = found >= 0 ? H5Aget_space(found) : H5I_INVALID_HID;
    text[0] = '\0';
    if (space >= 0 && H5Sget_simple_extent_npoints(space) == 1) {
        if (is_text && !H5Tis_variable_str(type) && length < size) {
            there = H5Aread(found, type, text) >= 0;
            text[length] = '\0';
        } else if (!is_text)
            there = H5Aread(found, H5T_NATIVE_DOUBLE, number) >= 0;
    }
    if (space >= 0) H5Sclose(space);
    if (type >= 0) H5Tclose(type);
    if (found >= 0) H5Aclose(found);
    return there;
}

static herr_t tell_attribute(hid_t object, const char *name, const H5A_info_t *info, void *data)
{
    looking *l = data;
    double number = 0;
    char text[TEXT];
    bool is_text = false;
    hid_t found = H5Aopen(object, name, H5P_DEFAULT), type = found >= 0 ? H5Aget_type(found) : H5I_INVALID_HID;
    (void)info;
    if (type >= 0) is_text = H5Tget_class(type) == H5T_STRING;
    if (type >= 0) H5Tclose(type);
    if (found >= 0) H5Aclose(found);
    if (get_attribute(object, name, &number, text, sizeof text))
        (*(visit_attribute **)l->what)(l->user, name, number, is_text ? text : NULL);
    return 0;
}

static void see_attributes(looking *l)
{
    hsize_t index = 0;
    if (H5Aiterate2(l->object, H5_INDEX_NAME, H5_ITER_INC, &index, tell_attribute, l) < 0)
        scree_hdf5_fail(&l->hdf5, "list", "the attributes of run.h5");
}

scree_status scree_run_data_attributes(const char *directory, const char *path,
                                       void (*visit)(void *user, const char *name, double number, const char *text),
                                       void *user, scree_error *error)
{
    looking l = {.what = &visit, .user = user, .error = error};
    return look(directory, path, H5I_BADID, see_attributes, &l);
}

// ---- datasets ----------------------------------------------------------------------------------------------------

/// The type of the interface that a type in a file becomes, and that of HDF5 in memory.
static hid_t type_of(hid_t dataset, scree_field_type *type)
{
    hid_t in_file = H5Dget_type(dataset), memory = H5I_INVALID_HID;
    if (in_file < 0) return memory;
    size_t size = H5Tget_size(in_file);
    if (H5Tget_class(in_file) == H5T_FLOAT) {
        *type = size == 4 ? SCREE_FIELD_FLOAT : SCREE_FIELD_DOUBLE;
        memory = size == 4 ? H5T_NATIVE_FLOAT : H5T_NATIVE_DOUBLE;
    } else if (H5Tget_class(in_file) == H5T_INTEGER && size == 1) {
        *type = SCREE_FIELD_UINT8;
        memory = H5T_NATIVE_UINT8;
    } else if (H5Tget_class(in_file) == H5T_INTEGER) {
        bool with_sign = H5Tget_sign(in_file) == H5T_SGN_2, small = size <= 4;
        *type = small ? (with_sign ? SCREE_FIELD_INT32 : SCREE_FIELD_UINT32)
                      : (with_sign ? SCREE_FIELD_INT64 : SCREE_FIELD_UINT64);
        memory = small ? (with_sign ? H5T_NATIVE_INT32 : H5T_NATIVE_UINT32)
                       : (with_sign ? H5T_NATIVE_INT64 : H5T_NATIVE_UINT64);
    }
    H5Tclose(in_file);
    return memory;
}

/// Rows and components; false: it has more than two dimensions.
static bool get_shape(hid_t dataset, size_t *rows, size_t *components)
{
    hsize_t size[2] = {1, 1};
    hid_t space = H5Dget_space(dataset);
    int dimensions = space >= 0 ? H5Sget_simple_extent_ndims(space) : -1;
    bool fits = dimensions >= 0 && dimensions <= 2 && H5Sget_simple_extent_dims(space, size, NULL) >= 0;
    if (space >= 0) H5Sclose(space);
    *rows = size[0];
    *components = size[1];
    return fits;
}

static void see_data(looking *l)
{
    scree_view *view = l->what;
    scree_keeper **keeper = l->user;
    size_t rows, components;
    held_data *held;
    hid_t memory = type_of(l->object, &view->type);
    if (memory < 0 || !get_shape(l->object, &rows, &components)) {
        scree_hdf5_damaged(&l->hdf5, "a dataset is no array of numbers with one or two dimensions");
        return;
    }
    size_t size = H5Tget_size(memory), bytes = sizeof *held + rows * components * size;
    l->hdf5.status = scree_allocate(&held, 1, bytes, l->error);
    if (l->hdf5.status) return;
    double number;
    char unit[TEXT];
    (void)get_attribute(l->object, "unit", &number, unit, sizeof unit);
    (void)get_attribute(l->object, "description", &number, held->meaning, sizeof held->meaning);
    (void)snprintf(held->unit, sizeof held->unit, "%.63s", unit);
    if (rows * components > 0 && H5Dread(l->object, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, held->data) < 0) {
        scree_hdf5_fail(&l->hdf5, "read", "a dataset");
        scree_release(&held);
        return;
    }
    *view = (scree_view){.data = held->data,
                         .count = rows,
                         .components = (int)components,
                         .type = view->type,
                         .stride = components * size,
                         .unit = held->unit,
                         .meaning = held->meaning};
    *keeper = (scree_keeper *)(void *)held;
}

scree_status scree_run_data_read(const char *directory, const char *path, scree_view *view, scree_keeper **keeper,
                                 scree_error *error)
{
    *view = (scree_view){0};
    *keeper = NULL;
    looking l = {.what = view, .user = keeper, .error = error};
    return look(directory, path, H5I_DATASET, see_data, &l);
}
