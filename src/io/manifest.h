/// The list of what Scree has written into a run folder: `files.txt`, a name a line, e.g. "figures/stress_ratio.svg".
///
/// A name is in the list, and the list on the disk, before the file of that name is made; so what --force removes is
/// Scree's, and all of it. Where there is no list (a sweep's folder, a file of the user) nothing is listed.
/// Files in parts/ come and go with each checkpoint; they are known by their numbered names and not listed.
#ifndef SCREE_IO_MANIFEST_H
#define SCREE_IO_MANIFEST_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

#define SCREE_FILE_MANIFEST "files.txt"

/// Begins the list of a folder anew with `names`. Errors: SCREE_ERROR_IO.
scree_status scree_manifest_create(const char *directory, const char *const *names, size_t count,
                                   scree_error *error) SCREE_MUST_USE;

/// Lists the files PATH + each of `endings` that are about to be made, when the folder of PATH, or the run folder
/// that figures/ or paraview/ belongs to, has a list. Errors: SCREE_ERROR_IO.
scree_status scree_manifest_add(const char *path, const char *const *endings, size_t count,
                                scree_error *error) SCREE_MUST_USE;

/// A list in memory.
typedef struct scree_manifest {
    bool there; ///< the folder has one
    char *text;
} scree_manifest;

/// Reads the list of the folder open as `directory`. Errors: SCREE_ERROR_IO.
scree_status scree_manifest_read(int directory, scree_manifest *manifest, scree_error *error) SCREE_MUST_USE;
void scree_manifest_destroy(scree_manifest *manifest);

/// Whether `name` is in the list, or is what a replacement of such a file left behind (NAME.new).
bool scree_manifest_has(const scree_manifest *manifest, const char *name);

/// The next name of the list into `name`; *at is 0 at first. False at the end. Names that no version of Scree writes
/// (with a folder other than figures/ and paraview/) are passed over.
bool scree_manifest_next(const scree_manifest *manifest, size_t *at, char *name, size_t size);

#endif
