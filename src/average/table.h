/// Tables of averages: rows of numbers under named columns, and the mean of several tables of one form with bands.
///
/// Several tables of one form are those of the samples of an ensemble. Of each number the mean over the samples that
/// have it is taken, and an interval of 95 % between quantiles of the means of BOOTSTRAP resamples (B. Efron, Ann.
/// Statist. 7, 1, 1979): whole samples are drawn with replacement, since places within one are not independent. Means
/// of resamples scatter by less than the mean of few samples does: the quantiles are those at which Student's interval
/// of n normal numbers would end (T. Hesterberg, Am. Stat. 69, 371, 2015, expanded percentile interval), not 2.5 and
/// 97.5 %. They cannot leave the range of the samples, so that fewer than five have too narrow ones. n are the samples
/// that have the number: one alone has no interval. Random numbers are counter-based: the same bands in every call.
#ifndef SCREE_AVERAGE_TABLE_H
#define SCREE_AVERAGE_TABLE_H

#include "base/memory.h"

enum { SCREE_AVERAGE_BOOTSTRAP = 2000 };

typedef struct scree_average_column {
    char name[48], unit[16];
} scree_average_column;

typedef struct scree_average_table {
    scree_average_column *column;
    size_t columns, column_room;
    double *value; ///< row by row
    size_t rows, row_room;
    size_t filled; ///< values of the row that is being told
} scree_average_table;

void scree_average_table_destroy(scree_average_table *table);

/// Begins a row; its values follow by scree_average_table_take, which as a sink (`user` is the table) also makes the
/// columns while the first row is told. Errors: memory.
scree_status scree_average_table_begin_row(scree_average_table *table, scree_error *error) SCREE_MUST_USE;
/// A value that has no room is counted in `filled` alone: scree_average_table_end_row then says so.
void scree_average_table_take(void *user, const char *name, const char *unit, double value);
scree_status scree_average_table_end_row(scree_average_table *table, scree_error *error) SCREE_MUST_USE;

/// Number of a column; SIZE_MAX: there is none of the name.
size_t scree_average_table_find(const scree_average_table *table, const char *name);

static inline double scree_average_table_get(const scree_average_table *table, size_t row, size_t column)
{
    return table->value[row * table->columns + column];
}

/// Mean, and both ends of its band (NULL: without bands), of `count` tables of one form; bands are NAN of what fewer
/// than two tables have. Errors: tables of different form (SCREE_ERROR_INPUT); memory.
scree_status scree_average_table_mean(const scree_average_table *table, size_t count, scree_average_table *mean,
                                      scree_average_table *low, scree_average_table *high,
                                      scree_error *error) SCREE_MUST_USE;

/// Place (0 to count - 1) of draw `draw` of resample `resample` of an ensemble.
size_t scree_average_drawn(size_t resample, size_t draw, size_t count);

/// Share of resamples below the interval of an ensemble of `count` samples, as many as above it: Phi(-t (n / (n -
/// 1))^(1/2)) with Student's t of 97.5 % and n - 1 degrees of freedom.
double scree_average_tail(size_t count);

/// The quantile (0 to 1) of the finite ones of some values, which are sorted; NAN without one.
double scree_average_quantile(double *value, size_t count, double share);

#endif
