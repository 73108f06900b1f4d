/// What a power cut may take. Contents of files and names in folders reach the disk in any order, or not at all, unless
/// they are flushed. Whatever another file relies on is flushed before that file: rows and snapshots, then the content
/// of a checkpoint, then its name; a file that replaces others, then their removal.
#ifndef SCREE_IO_DISK_H
#define SCREE_IO_DISK_H

#include "base/error.h"

/// Flushes the names in a folder. File systems that cannot do so for folders are taken to need it not. Errors:
/// SCREE_ERROR_IO.
scree_status scree_folder_sync(const char *path, scree_error *error) SCREE_MUST_USE;

#endif
