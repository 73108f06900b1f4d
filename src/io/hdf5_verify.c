/// Looking for damage in a file whose checksum is broken, object by object.
///
/// Files are in HDF5's newer format, where object headers, groups and chunk indices carry checksums; small datasets lie
/// in their object header, all others have Fletcher's checksum (hdf5_file.c). So whatever can be read is whole.
#include "io/hdf5_file.h"

#include <string.h>

typedef struct verification {
    scree_error *error;
    scree_status status;
} verification;

static herr_t read_attribute(hid_t object, const char *name, const H5A_info_t *information, void *data)
{
    verification *v = data;
    hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
    hid_t type = attribute >= 0 ? H5Aget_type(attribute) : H5I_INVALID_HID;
    void *value = NULL;
    if (type >= 0) v->status = scree_allocate(&value, (size_t)information->data_size + 1, 1, v->error);
    bool good = value && H5Aread(attribute, type, value) >= 0;
    scree_release(&value);
    if (type >= 0) H5Tclose(type);
    if (attribute >= 0) H5Aclose(attribute);
    return good ? 0 : -1;
}

static bool read_dataset(hid_t object, verification *v)
{
    hid_t type = H5Dget_type(object), space = H5Dget_space(object);
    hssize_t points = space >= 0 ? H5Sget_simple_extent_npoints(space) : -1;
    size_t size = type >= 0 ? H5Tget_size(type) : 0;
    void *value = NULL;
    if (points >= 0 && size > 0) v->status = scree_allocate(&value, (size_t)points + 1, size, v->error);
    bool good = value && (points == 0 || H5Dread(object, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0);
    scree_release(&value);
    if (space >= 0) H5Sclose(space);
    if (type >= 0) H5Tclose(type);
    return good;
}

static herr_t read_object(hid_t group, const char *name, const H5O_info_t *information, void *data)
{
    verification *v = data;
    hid_t object = H5Oopen(group, name, H5P_DEFAULT);
    bool good = object >= 0 && (information->type != H5O_TYPE_DATASET || read_dataset(object, v));
    hsize_t at = 0;
    good = good && H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_NATIVE, &at, read_attribute, v) >= 0;
    if (object >= 0) H5Oclose(object);
    if (!good && !v->status) v->status = scree_error_set(v->error, SCREE_ERROR_IO, "'%s' cannot be read", name);
    return good ? 0 : -1;
}

scree_status scree_hdf5_verify(scree_hdf5 *hdf5, const char *group, scree_error *error)
{
    verification v = {.error = error};
    if (hdf5->status) return hdf5->status;
    if (H5Lexists(hdf5->file, group, H5P_DEFAULT) <= 0)
        return scree_error_set(error, SCREE_ERROR_IO, "'%s' has no group '%s'", hdf5->path, group);
    if (H5Ovisit_by_name(hdf5->file, group, H5_INDEX_NAME, H5_ITER_INC, read_object, &v, H5P_DEFAULT) < 0 && !v.status)
        v.status = scree_error_set(error, SCREE_ERROR_IO, "'%s' of '%s' cannot be read", group, hdf5->path);
    (void)H5Eclear2(H5E_DEFAULT);
    return v.status;
}
