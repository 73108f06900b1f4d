/// Tables of averages as CSV, and the values as summary.json.
#include "library/measure.h"

#include "io/run_directory.h"
#include "io/summary.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

const char *const measure_files[MEASURE_PRODUCTS] = {"values.csv",  "cuts.csv",     "map.csv",  "kernel.csv",
                                                     "forces.csv",  "friction.csv", "rose.csv", "sizes.csv",
                                                     "scatter.csv", "response.csv"};

/// A header with units, and rows; of an ensemble every number with both ends of its band behind it.
static void write_rows(FILE *file, const scree_average_table *mean, const scree_average_table *low,
                       const scree_average_table *high)
{
    for (size_t k = 0; k < mean->columns; k++) {
        const scree_average_column *c = &mean->column[k];
        fprintf(file, "%s%s [%s]", k > 0 ? "," : "", c->name, c->unit);
        if (low) fprintf(file, ",%s_low [%s],%s_high [%s]", c->name, c->unit, c->name, c->unit);
    }
    fputc('\n', file);
    for (size_t row = 0; row < mean->rows; row++) {
        for (size_t k = 0; k < mean->columns; k++) {
            fprintf(file, "%s%.9g", k > 0 ? "," : "", scree_average_table_get(mean, row, k));
            if (low)
                fprintf(file, ",%.9g,%.9g", scree_average_table_get(low, row, k),
                        scree_average_table_get(high, row, k));
        }
        fputc('\n', file);
    }
}

static scree_status write_table(const char *folder, const measure_found *found, int product, scree_error *error)
{
    char path[PATH_MAX];
    FILE *file;
    const bool bands = found->runs > 1 && found->low.of[product].rows > 0;
    if (found->mean.of[product].rows == 0) return SCREE_OK;
    scree_status status = scree_path_join(path, sizeof path, folder, measure_files[product], error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (status) return status;
    write_rows(file, &found->mean.of[product], bands ? &found->low.of[product] : NULL, &found->high.of[product]);
    return scree_replace_finish(path, file, true, error);
}

static scree_status write_dips(const char *folder, const char *name, const measure_plan *plan,
                               const scree_average_dip *dips, scree_error *error)
{
    char path[PATH_MAX];
    FILE *file;
    if (!dips) return SCREE_OK;
    scree_status status = scree_path_join(path, sizeof path, folder, name, error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (status) return status;
    fputs("height [1],dip [1],dip_low [1],dip_high [1],checked [1],checked_low [1],checked_high [1],p [1],place [1],"
          "centre [1],most [1]\n",
          file);
    for (size_t k = 0; k < plan->average.cuts; k++) {
        const scree_average_dip *d = &dips[k];
        fprintf(file, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", plan->average.height[k], d->dip,
                d->low, d->high, d->checked, d->checked_low, d->checked_high, d->p, d->place, d->centre, d->most);
    }
    return scree_replace_finish(path, file, true, error);
}

/// What has to be known before the averages are believed.
static void set_warnings(scree_summary *summary, const measure_found *found)
{
    const scree_average_table *values = &found->mean.of[MEASURE_VALUES];
    const double grains = values->value[scree_average_table_find(values, "element_grains")];
    const double rest = values->value[scree_average_table_find(values, "unbalanced_ratio")];
    const bool touching = values->value[scree_average_table_find(values, "contacts")] > 0;
    char text[160];
    scree_summary_set_text(summary, "warnings", "");
    if (scree_average_are_few(grains)) {
        (void)snprintf(text, sizeof text, "elements hold %.3g grains, fewer than %d", grains, SCREE_AVERAGE_FEW);
        scree_summary_add_text(summary, "warnings", text);
    }
    if (!touching) scree_summary_add_text(summary, "warnings", "no contacts");
    if (touching && !(rest < MEASURE_AT_REST)) {
        (void)snprintf(text, sizeof text, "not at rest, unbalanced ratio %.3g", rest);
        scree_summary_add_text(summary, "warnings", text);
    }
    const size_t earlier = scree_average_table_find(values, "earlier_unbalanced");
    if (earlier != SIZE_MAX && !(values->value[earlier] < MEASURE_AT_REST)) {
        (void)snprintf(text, sizeof text, "the earlier state not at rest, unbalanced ratio %.3g",
                       values->value[earlier]);
        scree_summary_add_text(summary, "warnings", text);
    }
    if (found->runs > 1 && found->runs < MEASURE_BANDS) {
        (void)snprintf(text, sizeof text, "bands of %zu runs are too narrow", found->runs);
        scree_summary_add_text(summary, "warnings", text);
    }
}

/// A number of a dip.
static void set_part(scree_summary *summary, const char *name, const char *part, double value)
{
    char whole[96];
    (void)snprintf(whole, sizeof whole, "%s%s", name, part);
    scree_summary_set_number(summary, whole, value);
}

/// The dip of the lowest cut (NULL: there is none); not `whole`: itself is told already.
static void set_dip(scree_summary *summary, const char *name, const scree_average_dip *dip, bool whole)
{
    if (!dip) return;
    if (whole) {
        set_part(summary, name, "", dip->dip);
        set_part(summary, name, "_low", dip->low);
        set_part(summary, name, "_high", dip->high);
    }
    set_part(summary, name, "_checked", dip->checked);
    set_part(summary, name, "_checked_low", dip->checked_low);
    set_part(summary, name, "_checked_high", dip->checked_high);
    set_part(summary, name, "_p", dip->p);
    set_part(summary, name, "_place", dip->place);
}

static void set_between(scree_summary *summary, const char *name, const scree_average_between *of, bool interval)
{
    set_part(summary, name, "", of->value);
    if (!interval) return;
    set_part(summary, name, "_low", of->low);
    set_part(summary, name, "_high", of->high);
}

/// That of Cundall has no name behind it: it is the one that constants are made of.
static const char *strain_dip_name(int definition, const char *first, const char *mark, char *name, size_t size)
{
    const bool usual = definition == SCREE_AVERAGE_CUNDALL;
    (void)snprintf(name, size, "%s%s%s", first, usual ? "" : mark, usual ? "" : scree_average_strain_names[definition]);
    return name;
}

static void set_values(scree_summary *summary, const measure_found *found)
{
    const scree_average_table *mean = &found->mean.of[MEASURE_VALUES];
    char name[64];
    scree_summary_set_integer(summary, "runs", (int64_t)found->runs);
    if (found->responses > 0) scree_summary_set_integer(summary, "responses", (int64_t)found->responses);
    set_warnings(summary, found);
    for (size_t k = 0; k < mean->columns; k++) {
        scree_summary_set_number(summary, mean->column[k].name, mean->value[k]);
        if (found->runs < 2) continue;
        (void)snprintf(name, sizeof name, "%s_low", mean->column[k].name);
        scree_summary_set_number(summary, name, found->low.of[MEASURE_VALUES].value[k]);
        (void)snprintf(name, sizeof name, "%s_high", mean->column[k].name);
        scree_summary_set_number(summary, name, found->high.of[MEASURE_VALUES].value[k]);
    }
    for (size_t k = 0; found->fits && k < found->fits->numbers; k++) {
        const measure_fit_number *n = &found->fits->number[k];
        set_part(summary, n->name, "", n->value);
        if (isnan(n->low)) continue;
        set_part(summary, n->name, "_low", n->low);
        set_part(summary, n->name, "_high", n->high);
    }
    for (int k = 0; found->mean.of[MEASURE_SCATTER].rows > 0 && k < SCREE_AVERAGE_SIZED; k++) {
        (void)snprintf(name, sizeof name, "rve_%s_exponent", scree_average_sized_names[k]);
        set_part(summary, name, "", found->exponent[k][0]);
        set_part(summary, name, "_low", found->exponent[k][1]);
        set_part(summary, name, "_high", found->exponent[k][2]);
    }
    // One sample has those of strains among its values.
    for (int k = 0; k < SCREE_AVERAGE_STRAINS; k++)
        set_dip(summary, strain_dip_name(k, "strain_dip", "_", name, sizeof name), found->strain_dip[k],
                found->runs > 1);
    set_dip(summary, "dip", found->dip, true);
    if (!found->dip) return;
    scree_summary_set_number(summary, "dip_height", found->dip_height);
    if (isnan(found->minimum.depth.value)) return;
    set_between(summary, "pressure_minimum_place", &found->minimum.place, found->runs > 1);
    set_between(summary, "pressure_minimum_depth", &found->minimum.depth, found->runs > 1);
    set_between(summary, "pressure_maximum_place", &found->minimum.highest, found->runs > 1);
    if (found->runs > 1) scree_summary_set_number(summary, "pressure_minimum_share", found->minimum.share);
}

static scree_status write_summary(const char *folder, const measure_found *found, scree_error *error)
{
    char path[PATH_MAX];
    scree_summary *summary;
    scree_status status = scree_path_join(path, sizeof path, folder, "summary.json", error);
    if (!status) status = scree_summary_create(&summary, error);
    if (status) return status;
    set_values(summary, found);
    status = scree_summary_write(summary, path, error);
    scree_summary_destroy(summary);
    return status;
}

scree_status measure_write(const char *folder, const measure_plan *plan, const measure_found *found, scree_error *error)
{
    scree_status status = SCREE_OK;
    for (int k = 0; k < MEASURE_PRODUCTS && !status; k++) status = write_table(folder, found, k, error);
    if (!status) status = write_dips(folder, "dips.csv", plan, found->dip, error);
    for (int k = 0; k < SCREE_AVERAGE_STRAINS && !status; k++) {
        char name[48], file[64];
        (void)snprintf(file, sizeof file, "%s.csv", strain_dip_name(k, "strain-dips", "-", name, sizeof name));
        status = write_dips(folder, file, plan, found->strain_dip[k], error);
    }
    if (!status && found->fits) status = measure_fit_write_numbers(folder, found->fits, error);
    if (!status && found->fits)
        status = found->fits->layers ? measure_fit_layers_write(folder, found->fits, error)
                                     : measure_fit_write(folder, plan, found->fits, error);
    return status ? status : write_summary(folder, found, error);
}
