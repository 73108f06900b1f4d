/// The figures of a run.
#ifndef SCREE_VIEW_PLOT_H
#define SCREE_VIEW_PLOT_H

#include "base/error.h"

/// As scree_plot, and with `names` as scree_plot_only, for who holds the lock on the folder.
scree_status scree_plot_draw(const char *directory, const char *names, void (*message)(void *user, const char *path),
                             void *user, scree_error *error) SCREE_MUST_USE;

#endif
