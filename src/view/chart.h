/// Charts through gnuplot: the script and its data are kept beside the figure (NAME.gp, NAME.csv -> NAME.svg,
/// NAME.png).
#ifndef SCREE_VIEW_CHART_H
#define SCREE_VIEW_CHART_H

#include "base/error.h"

#include <stdbool.h>

/// Labels (not titles) may use gnuplot's enhanced text, e.g. `v_R` or `10^{-3}`.
typedef struct scree_chart_line {
    const double *x, *y;
    const double *low, *high; ///< NULL, or a band around a line, error bars of points
    size_t count;
    const char *label; ///< NULL: no legend entry
    bool dashed, points;
    bool bare;  ///< points without a line
    bool faint; ///< small points, of a cloud that other lines are drawn upon
    int colour; ///< 1 to 7: of the palette, e.g. the same for two lines that belong together; 0: the next one
} scree_chart_line;

typedef struct scree_chart {
    const char *title;
    const char *x_label, *y_label; ///< with units
    const scree_chart_line *line;
    size_t line_count;
    bool log_x, log_y;
    double highest_y; ///< end of an axis that begins at zero, e.g. 100 of shares in percent; 0: what the values need
    const char *const *x_name; ///< NULL, or what stands at x = 1, 2, ... in place of numbers
    size_t x_name_count;
} scree_chart;

/// path without extension. Values that are not finite are gaps, and so are those not above zero on a logarithmic axis.
/// Errors: no value to draw (SCREE_ERROR_INPUT); gnuplot missing or failed (SCREE_ERROR_IO with its message), disk.
scree_status scree_chart_draw(const char *path, const scree_chart *chart, scree_error *error) SCREE_MUST_USE;

#endif
