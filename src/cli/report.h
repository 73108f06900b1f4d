/// The reproduction page into a file.
#ifndef SCREE_CLI_REPORT_H
#define SCREE_CLI_REPORT_H

#include <scree/scree.h>

/// Writes the page about the runs in `directories`; `path` NULL: to standard output.
scree_status scree_report_to_file(const char *const *directories, size_t count, const char *path, scree_error *error);

#endif
