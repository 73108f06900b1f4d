/// Scratch folders, small disks and damage, for the tests of files.
#ifndef SCREE_TESTS_IO_SCRATCH_H
#define SCREE_TESTS_IO_SCRATCH_H

#include <ftw.h>
#include <hdf5.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

/// A new empty folder; `path` has room for 64 bytes.
static inline bool scratch_create(char *path)
{
    (void)snprintf(path, 64, "/tmp/scree-test-XXXXXX");
    return mkdtemp(path) != NULL;
}

static inline int scratch_remove_one(const char *path, const struct stat *information, int type, struct FTW *place)
{
    (void)information, (void)type, (void)place;
    return remove(path);
}

static inline void scratch_destroy(const char *path)
{
    (void)nftw(path, scratch_remove_one, 16, FTW_DEPTH | FTW_PHYS);
}

/// A folder for one test, as cmocka's setup and teardown.
static char scratch[64];

static inline int make_scratch(void **unused)
{
    (void)unused;
    return scratch_create(scratch) ? 0 : -1;
}

/// Fails when the test has left an HDF5 file open.
static inline int remove_scratch(void **unused)
{
    (void)unused;
    bool closed = H5Fget_obj_count((hid_t)H5F_OBJ_ALL, H5F_OBJ_ALL) == 0;
    scratch_destroy(scratch);
    return closed ? 0 : -1;
}

/// The same, and the test runs in it.
static inline int enter_scratch(void **unused)
{
    return make_scratch(unused) == 0 && chdir(scratch) == 0 ? 0 : -1;
}

static inline int leave_scratch(void **unused)
{
    return chdir("/") == 0 ? remove_scratch(unused) : -1;
}

/// No file may become longer than `bytes` from now on (RLIM_INFINITY: no limit): writes fail with EFBIG as they fail
/// with ENOSPC on a full disk.
static inline bool disk_limit(rlim_t bytes)
{
    struct rlimit limit;
    (void)signal(SIGXFSZ, SIG_IGN);
    if (getrlimit(RLIMIT_FSIZE, &limit) != 0) return false;
    limit.rlim_cur = bytes < limit.rlim_max ? bytes : limit.rlim_max;
    return setrlimit(RLIMIT_FSIZE, &limit) == 0;
}

static inline long file_size(const char *path)
{
    struct stat information;
    return stat(path, &information) == 0 ? (long)information.st_size : -1;
}

/// Inverts bit `bit` of byte `place`.
static inline bool file_flip(const char *path, long place, int bit)
{
    FILE *file = fopen(path, "r+b");
    if (!file) return false;
    int byte = fseek(file, place, SEEK_SET) == 0 ? fgetc(file) : EOF;
    bool good = byte != EOF && fseek(file, place, SEEK_SET) == 0 && fputc(byte ^ (1 << bit), file) != EOF;
    return fclose(file) == 0 && good;
}

#endif
