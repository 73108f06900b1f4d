#include "io/replacement.h"

#include "io/file_checksum.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <limits.h>
#include <string.h>
#include <sys/statvfs.h>
#include <unistd.h>

scree_status scree_path_join(char *path, size_t size, const char *directory, const char *name, scree_error *error)
{
    size_t length = strlen(directory);
    const char *separator = length > 0 && directory[length - 1] != '/' ? "/" : "";
    int written = snprintf(path, size, "%s%s%s", directory, separator, name);
    if (written < 0 || (size_t)written >= size)
        return scree_error_set(error, SCREE_ERROR_INPUT, "the path '%.100s...' is too long: %zu bytes at most",
                               directory, size - 1);
    return SCREE_OK;
}

scree_status scree_replacement_name(char *name, size_t size, const char *path, scree_error *error)
{
    int length = snprintf(name, size, "%s" SCREE_REPLACEMENT, path);
    if (length < 0 || (size_t)length >= size)
        return scree_error_set(error, SCREE_ERROR_INPUT, "the path '%.100s...' is too long", path);
    return SCREE_OK;
}

scree_status scree_replacement_open(const char *path, FILE **file, scree_error *error)
{
    char name[PATH_MAX];
    *file = NULL;
    scree_status status = scree_replacement_name(name, sizeof name, path, error);
    if (status) return status;
    *file = fopen(name, "wbe");
    return *file ? SCREE_OK : scree_error_set_errno(error, SCREE_ERROR_IO, "cannot write '%s'", name);
}

scree_status scree_replacement_close(const char *path, FILE *file, bool keep, scree_error *error)
{
    char name[PATH_MAX];
    scree_status status = scree_replacement_name(name, sizeof name, path, error);
    if (status) {
        fclose(file);
        return status;
    }
    // A write that failed earlier left the stream's error flag, but not always errno.
    errno = 0;
    bool good = fflush(file) == 0 && !ferror(file) && fsync(fileno(file)) == 0;
    int number = errno ? errno : EIO;
    if (fclose(file) != 0 && good) {
        good = false;
        number = errno;
    }
    if (keep && good && rename(name, path) != 0) {
        good = false;
        number = errno;
    }
    if (!keep || !good) unlink(name);
    if (!keep || good) return SCREE_OK;
    errno = number;
    return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot write '%s'", path);
}

/// 0, or the error number.
static int allocate(int file, off_t begin, off_t bytes)
{
    return posix_fallocate(file, begin, bytes);
}

/// The same; posix_fallocate would write into each block where the file system knows no better.
static int allocate_or_look(int file, off_t begin, off_t bytes)
{
    struct statvfs system;
    if (fallocate(file, 0, begin, bytes) == 0) return 0;
    if (errno != EOPNOTSUPP && errno != ENOSYS) return errno;
    if (fstatvfs(file, &system) != 0) return errno;
    return (uintmax_t)system.f_bavail * system.f_frsize < (uintmax_t)bytes ? ENOSPC : 0;
}

static scree_status take_room(const char *path, int (*take)(int file, off_t begin, off_t bytes), off_t begin,
                              off_t bytes, scree_error *error)
{
    int file = open(path, O_RDWR | O_CLOEXEC);
    if (file < 0) return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot open '%s'", path);
    int number = take(file, begin, bytes);
    close(file);
    if (!number) return SCREE_OK;
    errno = number;
    return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot write %jd bytes to '%s'", (intmax_t)bytes, path);
}

scree_status scree_file_reserve(const char *path, off_t begin, off_t bytes, scree_error *error)
{
    return take_room(path, allocate, begin, bytes, error);
}

scree_status scree_file_claim(const char *path, off_t begin, off_t bytes, scree_error *error)
{
    return take_room(path, allocate_or_look, begin, bytes, error);
}

scree_status scree_replacement_put(const char *temporary, const char *path, scree_error *error)
{
    scree_status status = scree_file_checksum_append(temporary, error);
    if (status) return status;
    int file = open(temporary, O_RDWR | O_CLOEXEC);
    bool good = file >= 0 && fsync(file) == 0;
    if (file >= 0) close(file);
    if (good && rename(temporary, path) == 0) return SCREE_OK;
    return scree_error_set_errno(error, SCREE_ERROR_IO, "cannot write '%s'", path);
}
