#include "io/together.h"

#include "comm/comm.h"
#include "io/manifest.h"
#include "io/replacement.h"

#include <limits.h>
#include <string.h>
#include <unistd.h>

/// Bytes that HDF5 takes for the description of a file, of an array and of a chunk, at most.
enum { FILE_ROOM = 1 << 15, ARRAY_ROOM = 1024, CHUNK_ROOM = 32 };

scree_status scree_together_begin(scree_together *together, const char *path, char *name, scree_error *error)
{
    char ready = 0;
    *together = (scree_together){.path = path, .room = FILE_ROOM};
    scree_status status = scree_replacement_name(name, PATH_MAX, path, error);
    if (!status && scree_comm_rank() == 0) status = scree_manifest_add(path, &(const char *){""}, 1, error);
    // The folder is there when process 0 has come this far.
    if (!status) scree_comm_share(&ready, sizeof ready);
    return status;
}

scree_status scree_together_take_room(scree_together *together, scree_error *error)
{
    char name[PATH_MAX];
    if (scree_comm_rank() > 0 || together->room == together->taken) return SCREE_OK;
    scree_status status = scree_replacement_name(name, sizeof name, together->path, error);
    const off_t begin = (off_t)together->taken, bytes = (off_t)(together->room - together->taken);
    if (!status) status = scree_file_claim(name, begin, bytes, error);
    together->taken = together->room;
    return status;
}

/// All of a small array, from the ranges or from process 0.
static scree_status join(const scree_array *array, scree_array *all, scree_error *error)
{
    const size_t size = scree_array_row_size(all);
    scree_status status = scree_array_allocate(all, error);
    if (status || all->rows == 0) return status;
    if (array->total == 0) {
        memcpy(all->data, array->data, all->rows * size);
        scree_comm_share(all->data, all->rows * size);
        return SCREE_OK;
    }
    size_t counts[SCREE_PROCESSES];
    for (int r = 0; r < scree_comm_size(); r++)
        counts[r] = scree_range_begin(all->rows, r + 1) - scree_range_begin(all->rows, r);
    scree_comm_gather(array->data, all->data, counts, size);
    return SCREE_OK;
}

scree_status scree_together_prepare(scree_together *together, const scree_array *array, scree_array *all,
                                    scree_error *error)
{
    together->room += all->rows * scree_array_row_size(all) + ARRAY_ROOM;
    if (scree_array_is_small(all)) return join(array, all, error);
    together->room += CHUNK_ROOM * (size_t)scree_comm_size();
    return scree_together_take_room(together, error);
}

bool scree_together_write(hid_t dataset, hid_t type, const scree_array *array, const scree_array *all)
{
    const bool whole = array->total == 0;
    const size_t first = whole ? scree_range_begin(all->rows, scree_comm_rank()) : array->begin;
    const size_t rows = whole ? scree_range_begin(all->rows, scree_comm_rank() + 1) - first : array->rows;
    const unsigned char *data = array->data;
    const hsize_t begin[2] = {first, 0}, count[2] = {rows, (hsize_t)array->components};
    if (whole) data += first * scree_array_row_size(array);
    hid_t file = H5Dget_space(dataset), memory = H5Screate_simple(array->components > 1 ? 2 : 1, count, NULL);
    hid_t transfer = H5Pcreate(H5P_DATASET_XFER);
    bool good = file >= 0 && memory >= 0 && transfer >= 0 && scree_comm_write_together(transfer);
    if (good && rows > 0) good = H5Sselect_hyperslab(file, H5S_SELECT_SET, begin, NULL, count, NULL) >= 0;
    if (good && rows == 0) good = H5Sselect_none(file) >= 0 && H5Sselect_none(memory) >= 0;
    good = good && H5Dwrite(dataset, type, memory, file, transfer, data) >= 0;
    if (transfer >= 0) H5Pclose(transfer);
    if (memory >= 0) H5Sclose(memory);
    if (file >= 0) H5Sclose(file);
    return good;
}

scree_status scree_together_end(const scree_together *together, scree_status status, scree_error *error)
{
    char name[PATH_MAX];
    scree_error ignored;
    int64_t closed = 1;
    if (scree_replacement_name(name, sizeof name, together->path, &ignored)) return status;
    // What others have written may come into sight when they have closed it.
    if (!status) scree_comm_add(NULL, &closed, 1);
    if (!status && scree_comm_rank() == 0) status = scree_replacement_put(name, together->path, error);
    if (status) (void)unlink(name);
    return status;
}
