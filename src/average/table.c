/// Tables, their mean and bands.
#include "average/table.h"

#include "base/random.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { MOST_COLUMNS = 256 };

void scree_average_table_destroy(scree_average_table *table)
{
    scree_release(&table->column);
    scree_release(&table->value);
    *table = (scree_average_table){0};
}

scree_status scree_average_table_begin_row(scree_average_table *table, scree_error *error)
{
    scree_status status = SCREE_OK;
    table->filled = 0;
    if (!table->column) {
        status = scree_allocate(&table->column, MOST_COLUMNS, sizeof *table->column, error);
        if (!status) status = scree_allocate(&table->value, MOST_COLUMNS, sizeof *table->value, error);
        table->column_room = MOST_COLUMNS;
        table->row_room = 1;
        return status;
    }
    if (table->rows < table->row_room) return SCREE_OK;
    const size_t room = 2 * table->row_room + 16;
    status = scree_reallocate(&table->value, table->rows * table->columns, room * table->columns, sizeof *table->value,
                              error);
    if (!status) table->row_room = room;
    return status;
}

void scree_average_table_take(void *user, const char *name, const char *unit, double value)
{
    scree_average_table *table = user;
    if (table->rows == 0 && table->filled < table->column_room) {
        scree_average_column *column = &table->column[table->columns++];
        (void)snprintf(column->name, sizeof column->name, "%s", name);
        (void)snprintf(column->unit, sizeof column->unit, "%s", unit);
    }
    if (table->filled < table->columns) table->value[table->rows * table->columns + table->filled] = value;
    table->filled++;
}

scree_status scree_average_table_end_row(scree_average_table *table, scree_error *error)
{
    if (table->filled != table->columns)
        return scree_error_set(error, SCREE_ERROR_INPUT, "a row of averages has %zu numbers and the table %zu columns",
                               table->filled, table->columns);
    if (table->rows == 0) table->row_room = MOST_COLUMNS / (table->columns ? table->columns : 1);
    table->rows++;
    return SCREE_OK;
}

size_t scree_average_table_find(const scree_average_table *table, const char *name)
{
    for (size_t k = 0; k < table->columns; k++)
        if (strcmp(table->column[k].name, name) == 0) return k;
    return SIZE_MAX;
}

// ---- ensembles ---------------------------------------------------------------------------------------------------

size_t scree_average_drawn(size_t resample, size_t draw, size_t count)
{
    const double uniform = scree_random_uniform(0, SCREE_RANDOM_BOOTSTRAP, (uint64_t)resample << 24 | (uint64_t)draw);
    return (size_t)(uniform * (double)count);
}

double scree_average_tail(size_t count)
{
    const double n = (double)count;
    if (count < 2) return NAN;
    return gsl_cdf_ugaussian_P(-gsl_cdf_tdist_Pinv(0.975, n - 1) * sqrt(n / (n - 1)));
}

double scree_average_quantile(double *value, size_t count, double share)
{
    size_t kept = 0;
    for (size_t k = 0; k < count; k++)
        if (isfinite(value[k])) value[kept++] = value[k];
    if (kept == 0) return NAN;
    gsl_sort(value, 1, kept);
    const double at = share * (double)(kept - 1);
    const size_t low = (size_t)at, high = low + 1 < kept ? low + 1 : low;
    return value[low] + (at - (double)low) * (value[high] - value[low]);
}

static scree_status make_like(const scree_average_table *form, scree_average_table *table, scree_error *error)
{
    *table = (scree_average_table){.columns = form->columns, .rows = form->rows, .row_room = form->rows};
    scree_status status = scree_allocate(&table->column, form->columns, sizeof *table->column, error);
    if (!status) status = scree_allocate(&table->value, form->rows * form->columns, sizeof *table->value, error);
    if (!status) memcpy(table->column, form->column, form->columns * sizeof *table->column);
    return status;
}

/// An angle of an axis in the plane [degree], for which 180 degrees are none: its mean is that of the doubled angles.
/// Those of a table in space, which has places along z, are elevations from 0 to 90: numbers like others.
static bool is_axis(const scree_average_table *table, size_t at)
{
    const char *name = table->column[at % table->columns].name;
    const size_t length = strlen(name);
    return length > 6 && strcmp(name + length - 6, "_angle") == 0 && scree_average_table_find(table, "z") == SIZE_MAX;
}

static double mean_axis(const scree_average_table *table, size_t count, size_t at, const uint32_t *drawn)
{
    double cosine = 0, sine = 0;
    for (size_t k = 0; k < count; k++) {
        const double angle = table[drawn ? drawn[k] : k].value[at] * M_PI / 90;
        if (!isfinite(angle)) continue;
        cosine += cos(angle);
        sine += sin(angle);
    }
    return cosine != 0 || sine != 0 ? atan2(sine, cosine) * 90 / M_PI : NAN;
}

/// Mean of the finite ones of value `at` of the tables; of those that were drawn, NULL: of each once.
static double mean_of(const scree_average_table *table, size_t count, size_t at, bool axis, const uint32_t *drawn)
{
    double sum = 0, number = 0;
    if (axis) return mean_axis(table, count, at, drawn);
    for (size_t k = 0; k < count; k++) {
        const double value = table[drawn ? drawn[k] : k].value[at];
        if (!isfinite(value)) continue;
        sum += value;
        number++;
    }
    return number > 0 ? sum / number : NAN;
}

/// Means of the samples that were drawn; of axes within a right angle of their mean.
static void resample(const scree_average_table *table, size_t count, size_t at, bool axis, const uint32_t *drawn,
                     double mean, double *draws)
{
    for (size_t b = 0; b < SCREE_AVERAGE_BOOTSTRAP; b++) {
        draws[b] = mean_of(table, count, at, axis, drawn + b * count);
        if (axis) draws[b] = mean + remainder(draws[b] - mean, 180);
    }
}

/// So many samples have a finite value `at`.
static size_t count_finite(const scree_average_table *table, size_t count, size_t at)
{
    size_t finite = 0;
    for (size_t k = 0; k < count; k++) finite += isfinite(table[k].value[at]) != 0;
    return finite;
}

scree_status scree_average_table_mean(const scree_average_table *table, size_t count, scree_average_table *mean,
                                      scree_average_table *low, scree_average_table *high, scree_error *error)
{
    double *draws = NULL;
    uint32_t *drawn = NULL;
    *mean = (scree_average_table){0};
    if (low) *low = *high = (scree_average_table){0};
    for (size_t k = 1; k < count; k++)
        if (table[k].rows != table->rows || table[k].columns != table->columns)
            return scree_error_set(error, SCREE_ERROR_INPUT,
                                   "samples of an ensemble have different tables: are they all 2D or all 3D?");
    scree_status status = scree_allocate(&draws, SCREE_AVERAGE_BOOTSTRAP, sizeof *draws, error);
    if (!status) status = scree_allocate(&drawn, SCREE_AVERAGE_BOOTSTRAP * count, sizeof *drawn, error);
    for (size_t b = 0; b < SCREE_AVERAGE_BOOTSTRAP * count && !status; b++)
        drawn[b] = (uint32_t)scree_average_drawn(b / count, b % count, count);
    if (!status) status = make_like(table, mean, error);
    if (!status && low) status = make_like(table, low, error);
    if (!status && low) status = make_like(table, high, error);
    for (size_t at = 0; at < table->rows * table->columns && !status; at++) {
        const bool axis = is_axis(table, at);
        const size_t finite = count_finite(table, count, at);
        mean->value[at] = mean_of(table, count, at, axis, NULL);
        if (low) low->value[at] = high->value[at] = NAN;
        if (finite < 2 || !low) continue;
        const double tail = scree_average_tail(finite);
        resample(table, count, at, axis, drawn, mean->value[at], draws);
        low->value[at] = scree_average_quantile(draws, SCREE_AVERAGE_BOOTSTRAP, tail);
        high->value[at] = scree_average_quantile(draws, SCREE_AVERAGE_BOOTSTRAP, 1 - tail);
    }
    scree_release(&draws);
    scree_release(&drawn);
    return status;
}
