/// A case file from disk.
#include "case/case.h"

#include "base/memory.h"
#include "case/problems.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { LARGEST_FILE = 1 << 20 };

/// Reads at most LARGEST_FILE + 1 bytes. Errors: SCREE_ERROR_IO.
static scree_status read_bytes(int descriptor, char *bytes, size_t *length, scree_error *error)
{
    *length = 0;
    while (*length <= LARGEST_FILE) {
        ssize_t got = read(descriptor, bytes + *length, LARGEST_FILE + 1 - *length);
        if (got == 0) break;
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return scree_error_set_errno(error, SCREE_ERROR_IO, "the case file cannot be read");
        *length += (size_t)got;
    }
    return SCREE_OK;
}

/// Opens the file, unless it is a directory (SCREE_ERROR_IO), too large or not there (SCREE_ERROR_INPUT): judged before
/// it is read.
static scree_status open_case(const char *path, int *descriptor, scree_error *error)
{
    *descriptor = open(path, O_RDONLY | O_CLOEXEC);
    bool missing = *descriptor < 0 && (errno == ENOENT || errno == ENOTDIR);
    if (*descriptor < 0)
        return scree_error_set_errno(error, missing ? SCREE_ERROR_INPUT : SCREE_ERROR_IO,
                                     "the case file cannot be read");
    struct stat about;
    if (fstat(*descriptor, &about) != 0)
        return scree_error_set_errno(error, SCREE_ERROR_IO, "the case file cannot be read");
    if (S_ISDIR(about.st_mode)) return scree_error_set(error, SCREE_ERROR_IO, "this is a directory, not a case file");
    if (S_ISREG(about.st_mode) && about.st_size > LARGEST_FILE)
        return scree_error_set(error, SCREE_ERROR_INPUT, "too large for a case file: %lld bytes; at most 1 MiB",
                               (long long)about.st_size);
    return SCREE_OK;
}

/// Hands `failure` out as the only problem.
static scree_status fail(const char *path, scree_error *failure, scree_problems **problems)
{
    (void)snprintf(failure->file, sizeof failure->file, "%s", path);
    if (problems && scree_problems_create(problems) == SCREE_OK) scree_problems_replace(*problems, failure);
    return failure->status;
}

scree_status scree_case_text(const char *path, char **bytes, size_t *length, scree_problems **problems)
{
    int descriptor;
    scree_error failure;
    *bytes = NULL;
    *length = 0;
    scree_status status = open_case(path, &descriptor, &failure);
    if (!status) status = scree_allocate(bytes, LARGEST_FILE + 1, 1, &failure);
    if (!status) status = read_bytes(descriptor, *bytes, length, &failure);
    if (descriptor >= 0) close(descriptor);
    if (!status && *length == 0) status = scree_error_set(&failure, SCREE_ERROR_INPUT, "the case file is empty");
    return status ? fail(path, &failure, problems) : SCREE_OK;
}

scree_status scree_case_read(const char *path, const scree_case_options *options, scree_case **out,
                             scree_problems **problems)
{
    *out = NULL;
    if (problems) *problems = NULL;
    char *bytes;
    size_t length;
    scree_status status = scree_case_text(path, &bytes, &length, problems);
    if (!status) status = scree_case_parse(bytes, length, path, options, out, problems);
    scree_release(&bytes);
    return status;
}
