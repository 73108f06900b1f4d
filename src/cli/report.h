/// The reproduction page into a file.
#ifndef SCREE_CLI_REPORT_H
#define SCREE_CLI_REPORT_H

#include <scree/scree.h>

/// Writes the page; `path` NULL: to standard output. What is wrong is printed in the name of `verb`.
scree_status scree_report_to_file(const char *verb, const scree_report_options *options, const char *path);

#endif
