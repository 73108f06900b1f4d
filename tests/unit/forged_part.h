/// A checkpoint that says what no run could have written, in a file whose checksum is right.
#ifndef SCREE_TESTS_FORGED_PART_H
#define SCREE_TESTS_FORGED_PART_H

#include "io/file_checksum.h"
#include "io/hdf5_file.h"

#include <stdio.h>

/// Writes a number into a dataset of the checkpoint with this number, in row `at` (negative: counted from the last) and
/// the first column, and checksums the file again. False when it cannot.
static inline bool forge_part(const char *path, long checkpoint, const char *dataset, long at, double value)
{
    char name[128];
    scree_hdf5 file;
    scree_hdf5_extend(&file, path, NULL);
    (void)snprintf(name, sizeof name, "/checkpoints/%06ld/%s", checkpoint, dataset);
    const hid_t set = H5Dopen2(file.file, name, H5P_DEFAULT), space = H5Dget_space(set), one = H5Screate(H5S_SCALAR);
    hsize_t size[2] = {0};
    bool good = set >= 0 && one >= 0;
    if (good && H5Sget_simple_extent_dims(space, size, NULL) > 0) {
        const hsize_t place[2] = {at < 0 ? size[0] - (hsize_t)-at : (hsize_t)at, 0};
        good = H5Sselect_elements(space, H5S_SELECT_SET, 1, place) >= 0;
    }
    good = good && H5Dwrite(set, H5T_NATIVE_DOUBLE, one, space, H5P_DEFAULT, &value) >= 0;
    good = H5Sclose(one) >= 0 && H5Sclose(space) >= 0 && H5Dclose(set) >= 0 && good;
    return scree_hdf5_close(&file) == SCREE_OK && good && scree_file_checksum_append(path, NULL) == SCREE_OK;
}

#endif
