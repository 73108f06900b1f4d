/// Running gnuplot as a process of its own.
#ifndef SCREE_VIEW_GNUPLOT_H
#define SCREE_VIEW_GNUPLOT_H

#include "base/error.h"

/// Runs `gnuplot SCRIPT` in `folder`, without a shell and without the user's own gnuplot settings. Errors
/// (SCREE_ERROR_IO): gnuplot is not installed, or it failed, with the first lines that it printed.
scree_status scree_gnuplot_run(const char *folder, const char *script, scree_error *error) SCREE_MUST_USE;

#endif
