/// A file as it lies on the disk.
#include "base/file_bytes.h"

#include "base/memory.h"

#include <stdint.h>
#include <stdio.h>

#define MOST_BYTES (SIZE_MAX / 4 < 4000000000U ? SIZE_MAX / 4 : 4000000000U)

scree_status scree_file_load(const char *path, char **bytes, size_t *length, scree_error *error)
{
    *bytes = NULL;
    *length = 0;
    FILE *file = fopen(path, "rbe");
    if (!file) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot read '%s'", path);
    scree_status status = SCREE_OK;
    long size = -1;
    if (fseek(file, 0, SEEK_END) == 0) size = ftell(file);
    rewind(file);
    if (size < 0 || (unsigned long)size > MOST_BYTES)
        status = scree_error_set(error, SCREE_ERROR_IO, "'%s' is no file that can be read, or larger than 4 GB", path);
    if (!status) status = scree_allocate(bytes, (size_t)size + 1, 1, error);
    if (!status) *length = fread(*bytes, 1, (size_t)size, file);
    if (!status && *length != (size_t)size)
        status = scree_error_set_errno(error, SCREE_ERROR_IO, "cannot read '%s'", path);
    if (fclose(file) != 0 && !status) status = scree_error_set_errno(error, SCREE_ERROR_IO, "cannot read '%s'", path);
    if (status) scree_release(bytes);
    return status;
}
