/// Slopes of the straight part of curves of the series: elastic constants from runs. Which part that is follows from
/// the curve, or is said (M 4.5: 20 to 50 % of the largest stress).
///
/// Of the stage with the largest load, up to it. Where there is no straight part, NAME_straight says why, and the
/// numbers are left out. Cost: a pass over the series.
#include "case/case.h"
#include "case/check.h"
#include "measure/linear_range.h"
#include "model/measure_keys.h"
#include "model/model.h"
#include "module/key_rows.h"
#include "run/columns.h"
#include "run/conclusion.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct slope {
    char *name, *y, *x, *of;
    double from, to, straight; ///< 1
} slope;

/// Its keys, and its numbers.
typedef struct config {
    slope *slopes;
    int64_t slope_count;
} config;

#define COLUMN(member, ...) KEY(slope, member, SCREE_KEY_WORD, FROM("1"), TO("90"), __VA_ARGS__)
static const scree_key slope_keys[] = {
    KEY(slope, name, SCREE_KEY_WORD, FROM("1"), TO("63"), .meaning = "Name in results."),
    COLUMN(y, .meaning = "Column of series.csv."),
    COLUMN(x, .meaning = "Column over which it is drawn."),
    COLUMN(of, .standard = "auto", .meaning = "Column whose shares bound the range; auto: y."),
    NUMBER(slope, from, "1", .standard = "auto", FROM("0 %"), BELOW("100 %"),
           .meaning = "Share of the largest magnitude at which the range begins; auto: with `to`, the widest straight "
                      "part."),
    NUMBER(slope, to, "1", .standard = "auto", ABOVE("0 %"), TO("100 %"), .meaning = "Share at which it ends."),
    NUMBER(slope, straight, "1", .standard = "2 %", ABOVE("0 %"), TO("100 %"),
           .meaning = "Largest distance from the line of least squares, over what y changes by."),
};
static const scree_section slope_table[] = {TABLE("slopes", "The slope of a straight part of a curve.", slope_keys)};
static const scree_key keys[] = {
    KEY(config, slopes, SCREE_KEY_LIST, .standard = "[]", FROM("0"), TO("16"), .sections = slope_table,
        .section_count = 1, .count_offset = offsetof(config, slope_count), .element_size = sizeof(slope),
        .meaning = "Slopes of the straight parts of curves, for elastic constants from runs."),
};

static const config *own_config(const scree_config *whole)
{
    return whole->measure.own ? scree_config_own(&scree_module_slopes, "measure", whole->measure.own) : NULL;
}

// ---- rules -------------------------------------------------------------------------------------------------------

static void check_column(scree_reader *reader, const scree_columns *columns, int64_t index, const char *key,
                         const char *name)
{
    enum { MOST = 512 };
    const char *names[MOST];
    char path[SCREE_PATH_BYTES];
    if (!name || scree_columns_find(columns, name) < columns->count) return;
    for (size_t k = 0; k < columns->count && k < MOST; k++) names[k] = columns->column[k].name;
    scree_rule_refuse_name(reader, scree_element_path(path, "measure.slopes", index, key), "column", name, names,
                           columns->count < MOST ? columns->count : MOST);
}

static void check_range(scree_reader *reader, int64_t index, const slope *s)
{
    char path[SCREE_PATH_BYTES];
    (void)scree_element_path(path, "measure.slopes", index, "to");
    if (isnan(s->from) != isnan(s->to))
        scree_rule_refuse(reader, path, NULL, "give both ends of the range, or none");
    else if (s->from >= s->to)
        scree_rule_refuse(reader, path, NULL, "the range ends before it begins, at %g %%", 100 * s->from);
}

static void rules(scree_reader *reader, const scree_config *whole)
{
    const config *own = own_config(whole);
    scree_columns columns;
    scree_error error;
    if (!own || own->slope_count == 0 || scree_columns_create(whole, &columns, &error)) return;
    for (int64_t k = 0; k < own->slope_count; k++) {
        const slope *s = &own->slopes[k];
        check_column(reader, &columns, k, "y", s->y);
        check_column(reader, &columns, k, "x", s->x);
        check_column(reader, &columns, k, "of", s->of);
        check_range(reader, k, s);
        for (int64_t i = 0; i < k && s->name; i++)
            if (own->slopes[i].name && strcmp(own->slopes[i].name, s->name) == 0) {
                char path[SCREE_PATH_BYTES];
                scree_rule_refuse(reader, scree_element_path(path, "measure.slopes", k, "name"), NULL,
                                  "measure.slopes.%lld has this name, too", (long long)i);
            }
    }
    scree_columns_destroy(&columns);
}

// ---- results -----------------------------------------------------------------------------------------------------

static scree_status resolve(scree_model *model, scree_error *error)
{
    (void)error;
    return scree_model_keep_measure_keys(model, SCREE_SLOT_slopes);
}

static const scree_result results[] = {
    {"_slope", "1", "slope of the straight part, in SI units of y over those of x"},
    {"_slope_from", "1", "share of the peak at which this part begins"},
    {"_slope_to", "1", "share of the peak at which it ends"},
    {"_slope_departure", "1", "largest distance from the line over what y changes by"},
    {"_peak", "1", "largest magnitude of the column that bounds the range, in its SI unit"},
    {"_peak_at", "1", "x there, in its SI unit"},
    {"_straight", NULL, "yes, or why there is no straight part"},
};

static bool told(const scree_config *whole, size_t index, char name[SCREE_RESULT_NAME])
{
    const config *own = own_config(whole);
    if (!own || index >= (size_t)own->slope_count || !own->slopes[index].name) return false;
    (void)snprintf(name, SCREE_RESULT_NAME, "%s", own->slopes[index].name);
    return true;
}

/// Rows of the stage with the largest load.
static scree_curve curve_of(const scree_series *series, const slope *s)
{
    const double *stage = scree_series_get(series, "stage"), *load = scree_series_get(series, s->of ? s->of : s->y);
    size_t peak = 0, first, last;
    for (size_t k = 0; k < series->row_count; k++)
        if (fabs(load[k]) > fabs(load[peak]) || isnan(load[peak])) peak = k;
    for (first = peak; first > 0 && stage[first - 1] == stage[peak];) first--;
    for (last = peak; last < series->row_count && stage[last] == stage[peak];) last++;
    return (scree_curve){.x = scree_series_get(series, s->x) + first,
                         .y = scree_series_get(series, s->y) + first,
                         .load = load + first,
                         .count = last - first};
}

static void set(scree_summary *summary, const char *name, const char *ending, double value)
{
    char full[SCREE_RESULT_NAME];
    (void)snprintf(full, sizeof full, "%s%s", name, ending);
    scree_summary_set_number(summary, full, value);
}

static void tell(const scree_conclusion *run, const slope *s)
{
    scree_linear_range range;
    scree_error error = {0};
    char full[SCREE_RESULT_NAME];
    const scree_curve curve = curve_of(run->series, s);
    const scree_status status = scree_linear_range_find(&curve, s->from, s->to, s->straight, &range, &error);
    (void)snprintf(full, sizeof full, "%s_straight", s->name);
    scree_summary_set_text(run->summary, full, status ? error.message : "yes");
    set(run->summary, s->name, "_peak", range.peak);
    set(run->summary, s->name, "_peak_at", range.at);
    if (status) return;
    set(run->summary, s->name, "_slope", range.slope);
    set(run->summary, s->name, "_slope_from", range.from);
    set(run->summary, s->name, "_slope_to", range.to);
    set(run->summary, s->name, "_slope_departure", range.departure);
}

static scree_status conclude(const scree_conclusion *run, scree_error *error)
{
    const config *own = scree_model_numbers(&run->s->model, SCREE_SLOT_slopes);
    (void)error;
    for (int64_t k = 0; own && run->series->row_count > 0 && k < own->slope_count; k++) tell(run, &own->slopes[k]);
    return SCREE_OK;
}

const scree_module scree_module_slopes = {
    .name = "slopes",
    .meaning = "slopes of the straight parts of curves",
    .keys = (const scree_keys[]){KEYS_OF("measure", keys, config)},
    .keys_count = 1,
    .rules = rules,
    .numbers_size = sizeof(config),
    .resolve = resolve,
    .results = SCREE_RESULTS(results, NULL),
    .told = told,
    .conclude = conclude,
};
