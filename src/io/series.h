/// series.csv: the time series of a run. First line: names with units, e.g. `axial_strain [1]`; values with 17 digits.
#ifndef SCREE_IO_SERIES_H
#define SCREE_IO_SERIES_H

#include "base/error.h"

#include <stdint.h>
#include <stdio.h>

typedef struct scree_series_column {
    const char *name;
    const char *unit;
    const char *meaning;
} scree_series_column;

typedef struct scree_series_writer {
    FILE *file;
    size_t column_count;
} scree_series_writer;

/// Starts a new series, or (append_rows >= 0) continues one: the file is cut after that many data rows first.
scree_status scree_series_open(scree_series_writer *writer, const char *path, const scree_series_column *columns,
                               size_t count, int64_t append_rows, scree_error *error) SCREE_MUST_USE;
/// One row, flushed as one write. NAN is written as `nan`.
scree_status scree_series_append(scree_series_writer *writer, const double *values, scree_error *error) SCREE_MUST_USE;
/// Flushes all rows to the disk.
scree_status scree_series_sync(scree_series_writer *writer, scree_error *error) SCREE_MUST_USE;
/// Whether the file holds at least `rows` whole rows behind its header. Errors: SCREE_ERROR_IO with both numbers.
scree_status scree_series_holds(const char *path, int64_t rows, scree_error *error) SCREE_MUST_USE;
scree_status scree_series_close(scree_series_writer *writer, scree_error *error) SCREE_MUST_USE;

/// A series read back, column by column. A torn last line is ignored.
typedef struct scree_series {
    size_t column_count, row_count;
    char **name, **unit;
    double **value; ///< [column][row]
} scree_series;
scree_status scree_series_read(scree_series *series, const char *path, scree_error *error) SCREE_MUST_USE;
/// Column by name, NULL when there is none.
const double *scree_series_get(const scree_series *series, const char *name);
void scree_series_destroy(scree_series *series);

#endif
