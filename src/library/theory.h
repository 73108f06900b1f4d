/// What a theory has found. Private to src/library/.
#ifndef SCREE_LIBRARY_THEORY_H
#define SCREE_LIBRARY_THEORY_H

#include "base/memory.h"

#include <scree/theory.h>

enum { THEORY_VALUES = 48, THEORY_CORNERS = 12 };

/// One line of the figure.
typedef struct theory_curve {
    const char *name;  ///< of its column
    const char *label; ///< in the legend; NULL: none
    int colour;        ///< of the palette (view/chart.h)
    bool dashed;
    double *y;
} theory_curve;

struct scree_theory {
    scree_theory_value value[THEORY_VALUES];
    size_t value_count;

    // ---- curves over one x; none where there are no points ----
    const char *figure; ///< stem of the files
    char title[96];
    const char *x_name, *x_label, *y_unit, *y_label;
    const char *corner[THEORY_CORNERS]; ///< names that stand at x = 1, 2, ...; none: numbers do
    size_t corner_count, points, curve_count;
    double *x;
    theory_curve *curve;
};

/// Empty. Errors: memory.
scree_status theory_create(scree_theory **theory, scree_error *error);

/// Room for curves. Errors: memory.
scree_status theory_begin_curves(scree_theory *theory, size_t points, size_t curves, scree_error *error);

/// A value that is NAN is left out.
void theory_add(scree_theory *theory, const char *name, double value, const char *unit, const char *meaning);

#endif
