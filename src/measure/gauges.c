/// Gauges: the mean distance along an axis between the centres of two selections, and what has become of it since a
/// stage began.
///
///     length = |mean of x over one selection - mean of x over the other|                                       [m]
///     shortening = length when the stage began - length                                                        [m]
///     strain = shortening / length when the stage began, compression positive as everywhere                    [1]
///
/// Of the rows of particles at the ends of a lattice that is the strain centre to centre: M's 9 x 20 square specimen is
/// 38 mm high, not 40 (M 4.20, docs/theory/ddem.md). Lengths of the begin are state; sums are integers. Cost: two
/// passes over the bodies a gauge and sample.
///
/// Limits: along a direction in which the cell repeats itself there is no distance between bodies that may leave it.
#include "measure/gauges.h"
#include "model/measure_keys.h"

#include "base/integer_sum.h"
#include "case/check.h"
#include "comm/comm.h"
#include "model/model.h"
#include "module/key_rows.h"
#include "selection/selection.h"
#include "state/body.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

typedef struct config {
    scree_gauge *gauges;
    int64_t gauge_count;
} config;

static const scree_choice axes[] = {
    {"x", 0, "the first coordinate"}, {"y", 1, "the second coordinate"}, {"z", 2, "the third coordinate, in 3D"}, {0}};

typedef scree_gauge gauge;
static const scree_key gauge_keys[] = {
    KEY(gauge, name, SCREE_KEY_WORD, FROM("1"), TO("63"), .meaning = "Name in columns and results."),
    KEY(gauge, between, SCREE_KEY_WORD, FROM("1"), TO("63"), .meaning = "Name of a selection."),
    {.name = "and",
     .type = SCREE_KEY_WORD,
     .offset = offsetof(gauge, and_other),
     FROM("1"),
     TO("63"),
     .meaning = "Name of another one."},
    CHOICE(gauge, along, axes, .meaning = "Direction of the length."),
    KEY(gauge, from, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),
        .meaning = "Stage at whose begin the strain is zero; auto: at the begin of each."),
};
static const scree_section gauge_table[] = {TABLE("gauges", "A length between two selections.", gauge_keys)};
static const scree_key keys[] = {
    KEY(config, gauges, SCREE_KEY_LIST, .standard = "[]", FROM("0"), TO("16"), .sections = gauge_table,
        .section_count = 1, .count_offset = offsetof(config, gauge_count), .element_size = sizeof(gauge),
        .meaning = "Lengths between selections."),
};

const scree_gauge *scree_gauges_of(const scree_config *whole, int64_t *count)
{
    const config *own = scree_config_own(&scree_module_gauges, "measure", whole->measure.own);
    *count = own ? own->gauge_count : 0;
    return own ? own->gauges : NULL;
}

int64_t scree_gauge_find(const scree_config *whole, const char *name)
{
    int64_t count;
    const scree_gauge *list = scree_gauges_of(whole, &count);
    for (int64_t k = 0; name && k < count; k++)
        if (list[k].name && strcmp(list[k].name, name) == 0) return k;
    return -1;
}

// ---- numbers -----------------------------------------------------------------------------------------------------

static scree_status resolve(scree_model *model, scree_error *error)
{
    (void)error;
    return scree_model_keep_measure_keys(model, SCREE_SLOT_gauges);
}

static const config *own_numbers(const scree_model *model)
{
    static const config none = {0};
    const config *own = scree_model_numbers(model, SCREE_SLOT_gauges);
    return own ? own : &none;
}

int scree_gauge_axis(const scree_model *model, const char *name)
{
    const config *own = own_numbers(model);
    int64_t k = 0;
    while (strcmp(own->gauges[k].name, name) != 0) k++;
    return own->gauges[k].along;
}

// ---- rules -------------------------------------------------------------------------------------------------------

typedef struct judged {
    scree_reader *reader;
    const scree_config *config;
    const scree_gauge *gauge;
    int64_t index;
    char path[SCREE_PATH_BYTES]; ///< that of the key which was asked for last
} judged;

static const char *path_of(judged *j, const char *key)
{
    return scree_element_path(j->path, "measure.gauges", j->index, key);
}

static void check_gauge(judged *j)
{
    const scree_gauge *g = j->gauge;
    const int64_t first = scree_gauge_find(j->config, g->name);
    if (g->name && first < j->index)
        scree_rule_refuse(j->reader, path_of(j, "name"), NULL, "measure.gauges.%lld is called '%s' too",
                          (long long)first, g->name);
    (void)scree_rule_is_selection(j->reader, j->config, path_of(j, "between"), g->between);
    (void)scree_rule_is_selection(j->reader, j->config, path_of(j, "and"), g->and_other);
    if (g->between && g->and_other && strcmp(g->between, g->and_other) == 0)
        scree_rule_refuse(j->reader, path_of(j, "and"), NULL, "a length is between two selections: this is the first");
    if (g->along >= j->config->dimension)
        scree_rule_refuse(j->reader, path_of(j, "along"), "x, y", "there is no z in two dimensions");
    if (g->along >= 0 && (unsigned)j->config->boundary.periodic >> g->along & 1)
        scree_rule_refuse(j->reader, path_of(j, "along"), NULL,
                          "the cell repeats itself in this direction (boundary.periodic): there is no distance");
    (void)scree_rule_is_stage(j->reader, j->config, path_of(j, "from"), j->gauge->from);
}

static void rules(scree_reader *reader, const scree_config *whole)
{
    int64_t count;
    if (!whole->measure.own) return;
    const scree_gauge *list = scree_gauges_of(whole, &count);
    for (int64_t k = 0; k < count; k++) {
        judged j = {.reader = reader, .config = whole, .gauge = &list[k], .index = k};
        check_gauge(&j);
    }
}

// ---- state -------------------------------------------------------------------------------------------------------

typedef struct memory {
    double length[SCREE_GAUGES]; ///< m, when its stage began
} memory;

static const scree_field fields[] = {
    {SCREE_FIELD_OF(gauges, SCREE_ROWS_FIXED, "gauges/length", SCREE_FIELD_DOUBLE, 1, "m",
                    "of each gauge when its stage began"),
     .fixed = SCREE_GAUGES, .array_offset = offsetof(memory, length), .stride = sizeof(double),
     .range = {.least = 0, .limit = SCREE_LIMIT_NUMBER, .most = DBL_MAX, .undefined = true}}};

static memory *memory_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_gauges];
}

/// Mean coordinate of a selection that has been found [m]; NAN of one whose bodies have all been taken out.
static double mean_of(const scree_context *c, const char *selection, int axis)
{
    const int64_t index = scree_config_selection_find(c->model->selections, c->model->selection_count, selection);
    scree_integer_sum sum = {0};
    int64_t count = 0;
    if (!(scree_selections_of(c->state)->resolved >> index & 1)) return NAN;
    while (scree_comm_sum_next(c->state, &sum, 1)) {
        count = 0;
        for (size_t row = 0; row < c->state->count; row++) {
            scree_vector place;
            if (!scree_selection_has(c->state, index, row)) continue;
            scree_body_position(c->state, row, place);
            scree_integer_sum_add(&sum, place[axis]);
            count++;
        }
    }
    scree_comm_add(c->state, &count, 1);
    return scree_integer_sum_total(&sum) / (double)count;
}

static double length_of(const scree_context *c, const scree_gauge *g)
{
    return fabs(mean_of(c, g->between, g->along) - mean_of(c, g->and_other, g->along));
}

static scree_status find_selection(const scree_context *c, const char *name, scree_error *error)
{
    const int64_t index = scree_config_selection_find(c->model->selections, c->model->selection_count, name);
    return scree_selection_resolve(c->model, c->state, index, error);
}

static scree_status begin_gauge(const scree_context *c, const scree_gauge *g, int64_t index, scree_error *error)
{
    const char *stage = c->model->stages[c->state->stage.index].name;
    if (g->from && strcmp(g->from, stage) != 0) return SCREE_OK;
    scree_status status = find_selection(c, g->between, error);
    if (!status) status = find_selection(c, g->and_other, error);
    if (status) return status;
    const double length = length_of(c, g);
    memory_of(c->state)->length[index] = length;
    if (length > 0) return SCREE_OK;
    status =
        scree_error_set(error, SCREE_ERROR_INPUT, "gauge '%s' has no length: '%s' and '%s' are one above the other",
                        g->name, g->between, g->and_other);
    return scree_error_key(error, status, "measure.gauges.%lld", (long long)index);
}

/// Selections are looked for among all bodies.
static bool begins_whole(const scree_context *c)
{
    return own_numbers(c->model)->gauge_count > 0;
}

static scree_status begin(const scree_context *c, scree_error *error)
{
    const config *own = own_numbers(c->model);
    scree_status status = SCREE_OK;
    for (int64_t k = 0; k < own->gauge_count && !status; k++) status = begin_gauge(c, &own->gauges[k], k, error);
    return status;
}

// ---- what they tell ----------------------------------------------------------------------------------------------

static const scree_result rows[] = {
    {"_length", "m", "mean distance between the two selections of the gauge of this name"},
    {"_shortening", "m", "what it has become shorter by since the stage began"},
    {"_strain", "1", "the same over the length then, compression positive"},
};

static scree_status measure(const scree_context *c, size_t index, double *value, scree_error *error)
{
    const scree_gauge *g = &own_numbers(c->model)->gauges[index];
    const double begun = memory_of(c->state)->length[index];
    (void)error;
    value[0] = length_of(c, g);
    // Before its stage has begun there is none.
    value[1] = begun > 0 ? begun - value[0] : NAN;
    value[2] = value[1] / begun;
    return SCREE_OK;
}

static bool told(const scree_config *whole, size_t index, char name[SCREE_RESULT_NAME])
{
    int64_t count;
    const scree_gauge *list = scree_gauges_of(whole, &count);
    if ((int64_t)index >= count) return false;
    (void)snprintf(name, SCREE_RESULT_NAME, "%s", list[index].name);
    return true;
}

const scree_module scree_module_gauges = {
    .name = "gauges",
    .meaning = "lengths between selections",
    .keys = (const scree_keys[]){KEYS_OF("measure", keys, config)},
    .keys_count = 1,
    .rules = rules,
    .numbers_size = sizeof(config),
    .resolve = resolve,
    .state_size = sizeof(memory),
    .fields = fields,
    .field_count = COUNT(fields),
    .begin = begin,
    .begins_whole = begins_whole,
    .columns = SCREE_RESULTS_IN_PARTS(rows, measure),
    .results = SCREE_RESULTS(rows, measure),
    .told = told,
};
