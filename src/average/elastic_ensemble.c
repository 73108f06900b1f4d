/// Constants of mean fields.
#include "average/elastic_ensemble.h"

#include "average/elastic.h"

#include <math.h>
#include <stdio.h>

enum { CONSTANTS = 8, USUAL = 5 }; ///< those by the usual strain, and of them those of whole elements

/// Where the numbers of one definition of the strain stand in a table; SIZE_MAX: it has none.
typedef struct columns {
    int dimension;
    size_t stress[9], strain[9], inside;
    size_t constant[CONSTANTS];
    uint8_t *whole; ///< a sample: it has all numbers that the constants of the row are made of
    size_t count;   ///< so many have
} columns;

static void find_tensor(const scree_average_table *table, int dimension, const char *name, size_t column[9])
{
    char text[48];
    for (int k = 0; k < 9; k++) {
        column[k] = SIZE_MAX;
        if (k / 3 >= dimension || k % 3 >= dimension) continue;
        (void)snprintf(text, sizeof text, "%s_%c%c", name, "xyz"[k / 3], "xyz"[k % 3]);
        column[k] = scree_average_table_find(table, text);
    }
}

/// suffix: behind the names of K and G; NULL: of the usual definition, which has all constants.
static bool find_columns(const scree_average_table *table, const char *strain, const char *suffix, columns *c)
{
    static const char *const names[CONSTANTS] = {"bulk_modulus",         "shear_modulus",       "young_modulus",
                                                 "poisson_ratio",        "elastic_misfit",      "bulk_modulus_inside",
                                                 "shear_modulus_inside", "young_modulus_inside"};
    char text[64];
    c->dimension = scree_average_table_find(table, "stress_change_zz") != SIZE_MAX ? 3 : 2;
    find_tensor(table, c->dimension, "stress_change", c->stress);
    find_tensor(table, c->dimension, strain, c->strain);
    c->inside = scree_average_table_find(table, "inside");
    for (int k = 0; k < CONSTANTS; k++) {
        (void)snprintf(text, sizeof text, "%s%s%s", names[k], suffix ? "_" : "", suffix ? suffix : "");
        c->constant[k] = suffix && k > 1 ? SIZE_MAX : scree_average_table_find(table, text);
    }
    return c->stress[0] != SIZE_MAX && c->strain[0] != SIZE_MAX && c->constant[0] != SIZE_MAX;
}

static void find_whole(const scree_average_table *table, size_t count, size_t row, columns *c)
{
    c->count = 0;
    for (size_t k = 0; k < count; k++) {
        c->whole[k] = 1;
        for (int i = 0; i < 9; i++) {
            const size_t column[2] = {c->stress[i], c->strain[i]};
            for (int j = 0; j < 2; j++)
                if (column[j] != SIZE_MAX && !isfinite(scree_average_table_get(&table[k], row, column[j])))
                    c->whole[k] = 0;
        }
        c->count += c->whole[k];
    }
}

/// Mean of a number of a row over the samples of a resample (SIZE_MAX: over each once) that have all: stress and strain
/// are those of the same samples.
static double mean_of(const scree_average_table *table, size_t count, const columns *c, size_t row, size_t column,
                      size_t resample)
{
    double sum = 0, number = 0;
    if (column == SIZE_MAX) return 0;
    for (size_t k = 0; k < count; k++) {
        const size_t of = resample == SIZE_MAX ? k : scree_average_drawn(resample, k, count);
        if (!c->whole[of]) continue;
        sum += scree_average_table_get(&table[of], row, column);
        number++;
    }
    return number > 0 ? sum / number : NAN;
}

static void find_constants(const scree_average_table *table, size_t count, const columns *c, size_t row,
                           size_t resample, double value[CONSTANTS])
{
    double stress[9], strain[9];
    for (int k = 0; k < 9; k++) {
        stress[k] = mean_of(table, count, c, row, c->stress[k], resample);
        strain[k] = mean_of(table, count, c, row, c->strain[k], resample);
    }
    const double inside = mean_of(table, count, c, row, c->inside, resample);
    const scree_average_elastic found = scree_average_elastic_find(c->dimension, stress, strain);
    const double whole[USUAL] = {found.bulk, found.shear, found.young, found.poisson, found.misfit};
    for (int k = 0; k < CONSTANTS; k++) value[k] = k < USUAL ? whole[k] : whole[k - USUAL] / inside;
}

static void set(scree_average_table *table, size_t row, size_t column, double value)
{
    table->value[row * table->columns + column] = value;
}

static void fill_row(const scree_average_table *table, size_t count, columns *c, size_t row, scree_average_table *mean,
                     scree_average_table *low, scree_average_table *high, double (*draws)[SCREE_AVERAGE_BOOTSTRAP])
{
    double value[CONSTANTS];
    find_whole(table, count, row, c);
    find_constants(table, count, c, row, SIZE_MAX, value);
    for (int k = 0; k < CONSTANTS; k++)
        if (c->constant[k] != SIZE_MAX) set(mean, row, c->constant[k], value[k]);
    if (!low) return;
    for (int k = 0; k < CONSTANTS && c->count < 2; k++)
        if (c->constant[k] != SIZE_MAX) {
            set(low, row, c->constant[k], NAN);
            set(high, row, c->constant[k], NAN);
        }
    if (c->count < 2) return;
    const double tail = scree_average_tail(c->count);
    for (size_t b = 0; b < SCREE_AVERAGE_BOOTSTRAP; b++) {
        find_constants(table, count, c, row, b, value);
        for (int k = 0; k < CONSTANTS; k++) draws[k][b] = value[k];
    }
    for (int k = 0; k < CONSTANTS; k++) {
        if (c->constant[k] == SIZE_MAX) continue;
        set(low, row, c->constant[k], scree_average_quantile(draws[k], SCREE_AVERAGE_BOOTSTRAP, tail));
        set(high, row, c->constant[k], scree_average_quantile(draws[k], SCREE_AVERAGE_BOOTSTRAP, 1 - tail));
    }
}

scree_status scree_average_elastic_ensemble(const scree_average_table *table, size_t count, scree_average_table *mean,
                                            scree_average_table *low, scree_average_table *high, scree_error *error)
{
    double(*draws)[SCREE_AVERAGE_BOOTSTRAP] = NULL;
    columns c = {0};
    scree_status status = scree_allocate(&draws, CONSTANTS, sizeof *draws, error);
    if (!status) status = scree_allocate(&c.whole, count, sizeof *c.whole, error);
    for (int k = -1; k < SCREE_AVERAGE_STRAINS && !status; k++) {
        // Smooth fields have one strain, called gradient.
        const char *strain = k < 0 ? "gradient" : scree_average_strain_names[k];
        if (!find_columns(table, strain, k < 0 || k == SCREE_AVERAGE_CUNDALL ? NULL : strain, &c)) continue;
        for (size_t row = 0; row < mean->rows; row++) fill_row(table, count, &c, row, mean, low, high, draws);
    }
    scree_release(&draws);
    scree_release(&c.whole);
    return status;
}
