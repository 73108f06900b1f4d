/// What a theory has found. Private to src/library/.
#ifndef SCREE_LIBRARY_THEORY_H
#define SCREE_LIBRARY_THEORY_H

#include "base/memory.h"

#include <scree/theory.h>

enum { THEORY_VALUES = 96, THEORY_CORNERS = 12, THEORY_FIGURES = 4 };

/// One line of the figure.
typedef struct theory_curve {
    const char *name;  ///< of its column
    const char *label; ///< in the legend; NULL: none
    int colour;        ///< of the palette (view/chart.h)
    bool dashed;
    double *y;
} theory_curve;

/// Curves over one x.
typedef struct theory_figure {
    const char *name; ///< stem of the files
    char title[96];
    const char *x_name, *x_unit, *x_label, *y_unit, *y_label;
    const char *corner[THEORY_CORNERS]; ///< names that stand at x = 1, 2, ...; none: numbers do
    size_t corner_count, points, curve_count;
    double *x;
    theory_curve *curve;
} theory_figure;

struct scree_theory {
    scree_theory_value value[THEORY_VALUES];
    size_t value_count;
    theory_figure figure[THEORY_FIGURES];
    size_t figure_count;
};

/// Empty. Errors: memory.
scree_status theory_create(scree_theory **theory, scree_error *error);

/// A further figure with room for curves. Errors: memory.
scree_status theory_begin_figure(scree_theory *theory, const char *name, size_t points, size_t curves,
                                 theory_figure **figure, scree_error *error);

/// A value that is NAN is left out.
void theory_add(scree_theory *theory, const char *name, double value, const char *unit, const char *meaning);

#endif
