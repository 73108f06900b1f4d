/// fsync(2) of folders.
#include "io/disk.h"

#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

scree_status scree_folder_sync(const char *path, scree_error *error)
{
    int folder = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot open the folder '%s'", path);
    int number = fsync(folder) == 0 || errno == EINVAL || errno == ENOTSUP ? 0 : errno;
    close(folder);
    if (!number) return SCREE_OK;
    errno = number;
    return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot flush the folder '%s' to the disk", path);
}
