/// What a module tells: columns of series.csv and results of summary.json. The rows are declared; names, the check of
/// what sweeps ask for, and the reference in docs/output.md follow.
#ifndef SCREE_MODULE_RESULT_H
#define SCREE_MODULE_RESULT_H

#include "module/pass.h"

#include <stddef.h>

typedef struct scree_result {
    const char *name;    ///< with a '_' in front: it follows the name of what it is about (`told` of the module)
    const char *unit;    ///< SI unit; NULL: a text
    const char *meaning; ///< one line
} scree_result;

enum { SCREE_RESULT_NAME = 96 }; ///< bytes of a name, the 0 at its end included

typedef struct scree_results {
    const scree_result *row;
    size_t count;
    /// The values of all rows, in their order. index: of what they are about, 0 where that is the run. Nothing of what
    /// steers the run is changed. NULL: `conclude` of the module sets them.
    scree_status (*measure)(const scree_context *context, size_t index, double *value, scree_error *error);
    /// Of columns: all processes can measure them together, each with its part of the bodies and the contacts that it
    /// evaluates (comm/parts.h), and have the same doubles as one process. Else the whole sample is put together in
    /// each of them at every row of series.csv of a case that has these columns.
    bool in_parts;
} scree_results;

/// Rows of a value and the ends of its confidence interval of 95 %.
#define SCREE_RESULT_INTERVAL(name, unit, meaning)                                                                     \
    {name, unit, meaning}, {name "_low", unit, "lower end of its interval"},                                           \
    {                                                                                                                  \
        name "_high", unit, "upper end of its interval"                                                                \
    }

#define SCREE_RESULTS(rows, function)                                                                                  \
    {                                                                                                                  \
        rows, sizeof(rows) / sizeof *(rows), function, false                                                           \
    }

/// Of columns that are measured in parts.
#define SCREE_RESULTS_IN_PARTS(rows, function)                                                                         \
    {                                                                                                                  \
        rows, sizeof(rows) / sizeof *(rows), function, true                                                            \
    }

#endif
