/// Comparison figures of a sweep: each mean curve with a band, one line a point of the grid; and each measure against
/// each dimension, with error bars, and over other measures. Bands and bars are confidence intervals of the mean; of
/// fewer than FEW realisations, whose intervals say little, they are the range. The title tells which, and how many
/// members there are. Where a measure NAME has a companion NAME_theory, that is the curve and the measure the points on
/// it. A chart has at most the seven colours of the palette: where there are more points, there is one chart for each
/// setting of the first dimension.
#include "io/result_names.h"
#include "sweep/results.h"

#include "base/memory.h"
#include "io/run_directory.h"
#include "view/chart.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_LINES = 7, LABEL = 128, TITLE = 400, FEW = 4 };

/// Title of the sweep, with `detail` (may be empty), what bands and bars are, and how many members there are not.
static void write_title(char title[TITLE], const scree_sweep_results *results, const char *detail)
{
    const scree_sweep *sweep = results->sweep;
    const char *name = sweep->config.title && sweep->config.title[0] ? sweep->config.title : sweep->config.name;
    char bars[80] = "", lost[60] = "";
    if (sweep->realisations >= FEW)
        (void)snprintf(bars, sizeof bars, " (mean and %g %% confidence, %zu realisations)",
                       100 * sweep->config.confidence, (size_t)sweep->realisations);
    else if (sweep->realisations > 1)
        (void)snprintf(bars, sizeof bars, " (mean and range of %zu realisations)", (size_t)sweep->realisations);
    if (results->done < sweep->member_count)
        (void)snprintf(lost, sizeof lost, "; %zu of %zu members", results->done, sweep->member_count);
    (void)snprintf(title, TITLE, "%s%s%s%s%s", name, detail[0] ? ": " : "", detail, bars, lost);
}

/// "stress_ratio" with unit "1" is "stress ratio", "limit_step" with unit "s" "limit step (s)".
static void name_label(char label[LABEL], const char *name, const char *unit)
{
    const bool told = unit && strcmp(unit, "1") != 0;
    (void)snprintf(label, LABEL, "%s%s%s%s", name, told ? " (" : "", told ? unit : "", told ? ")" : "");
    for (char *c = label; *c; c++)
        if (*c == '_') *c = ' ';
}

/// The same of a column; a strain is shown in percent, which the factor returns.
static double column_label(char label[LABEL], const char *name, const char *unit)
{
    const char *tail = strstr(name, "strain");
    const bool percent = unit && strcmp(unit, "1") == 0 && tail && strcmp(tail, "strain") == 0;
    name_label(label, name, percent ? "%" : unit);
    return percent ? 100 : 1;
}

/// Unit of a named result; NULL: there is none of this name.
static const char *unit_of(const char *name)
{
    const scree_result *row = scree_result_name_find(name, NULL);
    return row ? row->unit : NULL;
}

/// Labels are plain text: words of keys are apart, and what gnuplot's enhanced text would interpret is escaped.
static void plain(char label[LABEL], const char *text)
{
    size_t used = 0;
    for (const char *c = text; *c && used + 3 < LABEL; c++) {
        if (strchr("^{}@&~\\", *c)) label[used++] = '\\';
        label[used++] = *c == '_' ? ' ' : *c;
    }
    label[used] = 0;
}

static void draw(const scree_sweep_results *results, const char *name, const scree_chart *chart)
{
    char path[PATH_MAX], file[400];
    scree_error error;
    (void)snprintf(file, sizeof file, "figures/%s", name);
    scree_status status = scree_path_join(path, sizeof path, results->options->output, file, &error);
    if (!status) status = scree_chart_draw(path, chart, &error);
    if (status && status != SCREE_ERROR_INPUT)
        scree_sweep_tell(results->options, 1, "figure %s: %s", name, error.message);
}

/// Arrays of one line: x, y, low, high.
typedef struct sheet {
    double *x, *y, *low, *high;
} sheet;

static scree_status take_sheet(sheet *s, size_t count, scree_error *error)
{
    scree_status status = scree_allocate(&s->x, 4 * count, sizeof(double), error);
    if (status) return status;
    s->y = s->x + count;
    s->low = s->y + count;
    s->high = s->low + count;
    return SCREE_OK;
}

/// A line at [place] with its band.
static void put_estimate(sheet *s, size_t place, double x, const scree_estimate *e, double factor)
{
    s->x[place] = x;
    s->y[place] = factor * e->mean;
    s->low[place] = factor * (e->count < FEW ? e->range[0] : e->mean - e->half);
    s->high[place] = factor * (e->count < FEW ? e->range[1] : e->mean + e->half);
}

// ---- mean curves -------------------------------------------------------------------------------------------------

/// One chart of the points [from, to).
static void draw_points(const scree_sweep_results *results, const scree_mean_curve *curve, size_t from, size_t to,
                        size_t left_out, const char *name, const char *title)
{
    scree_chart_line line[MOST_LINES];
    char label[MOST_LINES][LABEL], x_label[LABEL], y_label[LABEL], text[LABEL];
    sheet s[MOST_LINES] = {0};
    scree_error error;
    double x_factor = column_label(x_label, curve->name_x, curve->unit_x);
    double y_factor = column_label(y_label, curve->name_y, curve->unit_y);
    size_t count = 0;
    for (size_t point = from; point < to && count < MOST_LINES; point++) {
        if (!curve->there[point] || take_sheet(&s[count], SCREE_CURVE_PLACES, &error)) continue;
        for (size_t k = 0; k < SCREE_CURVE_PLACES; k++)
            put_estimate(&s[count], k, x_factor * curve->x[point * SCREE_CURVE_PLACES + k],
                         &curve->estimate[point * SCREE_CURVE_PLACES + k], y_factor);
        scree_point_label(results->sweep, point, left_out, text, sizeof text);
        plain(label[count], text);
        bool band = results->sweep->realisations > 1;
        line[count] = (scree_chart_line){.x = s[count].x,
                                         .y = s[count].y,
                                         .low = band ? s[count].low : NULL,
                                         .high = band ? s[count].high : NULL,
                                         .count = SCREE_CURVE_PLACES,
                                         .label = text[0] ? label[count] : NULL};
        count++;
    }
    scree_chart chart = {.title = title,
                         .x_label = x_label,
                         .y_label = y_label,
                         .line = line,
                         .line_count = count,
                         .log_y = curve->log_y};
    if (count > 0) draw(results, name, &chart);
    for (size_t i = 0; i < count; i++) scree_release(&s[i].x);
}

void scree_sweep_draw_curve(const scree_sweep_results *results, const scree_mean_curve *curve)
{
    const scree_sweep *sweep = results->sweep;
    char name[320], detail[200], title[TITLE];
    if (sweep->point_count <= MOST_LINES || sweep->dimension_count < 2) {
        (void)snprintf(name, sizeof name, "%s-over-%s", curve->name_y, curve->name_x);
        write_title(title, results, "");
        draw_points(results, curve, 0, sweep->point_count, SIZE_MAX, name, title);
        return;
    }
    const scree_sweep_dimension *first = &sweep->dimension[0];
    size_t each = sweep->point_count / first->count;
    for (size_t i = 0; i < first->count; i++) {
        (void)snprintf(name, sizeof name, "%s-over-%s-%s", curve->name_y, curve->name_x, first->setting[i].slug);
        (void)snprintf(detail, sizeof detail, "%s%s%s", first->named ? "" : first->name, first->named ? "" : " ",
                       first->setting[i].label);
        write_title(title, results, detail);
        draw_points(results, curve, i * each, (i + 1) * each, 0, name, title);
    }
}

// ---- measures ----------------------------------------------------------------------------------------------------

/// The parameter that says where settings of a dimension stand on an axis: its one key, with a number for each; NULL
/// when several keys vary or when they only have names.
static const scree_sweep_parameter *axis_of(const scree_sweep *sweep, size_t dimension)
{
    if (!sweep->config.vary[dimension].key[0]) return NULL;
    for (size_t k = 0; k < sweep->parameter_count; k++) {
        const scree_sweep_parameter *parameter = &sweep->parameter[k];
        if (parameter->dimension != dimension || !parameter->unit) continue;
        bool all = true;
        for (size_t i = 0; i < sweep->dimension[dimension].count; i++) all &= isfinite(parameter->number[i]);
        if (all) return parameter;
    }
    return NULL;
}

/// Values over more than a factor of 30 are spread on a logarithmic axis, where zero has no place and is left out.
static bool is_wide(const scree_sweep_parameter *axis, size_t count)
{
    double least = INFINITY, most = 0;
    for (size_t i = 0; i < count; i++) {
        if (axis->number[i] < 0) return false;
        if (axis->number[i] > 0) least = fmin(least, axis->number[i]);
        most = fmax(most, axis->number[i]);
    }
    return most / least > 30;
}

static size_t measure_named(const scree_sweep *sweep, const char *name, const char *tail)
{
    size_t length = strlen(name), k = 0;
    for (; k < sweep->measure_count; k++)
        if (strncmp(sweep->measure[k], name, length) == 0 && strcmp(sweep->measure[k] + length, tail) == 0) break;
    return k;
}

/// The measure that is the closed form of measure `k`; measure_count when there is none.
static size_t theory_of(const scree_sweep *sweep, size_t k)
{
    return measure_named(sweep, sweep->measure[k], "_theory");
}

static bool is_theory(const scree_sweep *sweep, size_t k)
{
    for (size_t other = 0; other < sweep->measure_count; other++)
        if (theory_of(sweep, other) == k) return true;
    return false;
}

/// Names by which a chart of simulation and theory tells them apart.
static void contrast(scree_chart_line *simulation, scree_chart_line *theory)
{
    simulation->points = simulation->bare = true;
    simulation->colour = 1;
    simulation->label = "simulation";
    theory->label = "closed form";
    theory->points = theory->bare = false;
    theory->low = theory->high = NULL;
    theory->colour = 2;
}

/// The line of measure `k` through all settings of `dimension`, beginning at `point` (where its setting is 0). Settings
/// that only have names stand at 1, 2, ...; several lines stand beside one another there, `shift` apart.
static void trace(const scree_sweep_results *results, size_t k, size_t dimension, size_t point, double shift, sheet *s)
{
    const scree_sweep *sweep = results->sweep;
    const scree_sweep_parameter *axis = axis_of(sweep, dimension);
    size_t stride = 1;
    for (size_t j = dimension + 1; j < sweep->dimension_count; j++) stride *= sweep->dimension[j].count;
    for (size_t i = 0; i < sweep->dimension[dimension].count; i++)
        put_estimate(s, i, axis ? axis->number[i] : (double)i + 1 + shift,
                     &results->estimate[(point + i * stride) * sweep->measure_count + k], 1);
}

static void draw_measure(const scree_sweep_results *results, size_t k, size_t dimension)
{
    const scree_sweep *sweep = results->sweep;
    const scree_sweep_dimension *d = &sweep->dimension[dimension];
    const scree_sweep_parameter *axis = axis_of(sweep, dimension);
    scree_chart_line line[MOST_LINES];
    char label[MOST_LINES][LABEL], x_label[LABEL], y_label[LABEL], text[LABEL], name[320], title[TITLE];
    const char *names[1000];
    sheet s[MOST_LINES] = {0};
    scree_error error;
    size_t count = 0, lines = sweep->point_count / d->count;
    bool several = sweep->realisations > 1;
    if (lines > MOST_LINES) lines = MOST_LINES;
    for (size_t point = 0; point < sweep->point_count && count < MOST_LINES; point++) {
        if (scree_point_setting(sweep, point, dimension) != 0 || take_sheet(&s[count], d->count, &error)) continue;
        trace(results, k, dimension, point, 0.08 * ((double)count - 0.5 * (double)(lines - 1)), &s[count]);
        scree_point_label(sweep, point, dimension, text, sizeof text);
        plain(label[count], text);
        line[count] = (scree_chart_line){.x = s[count].x,
                                         .y = s[count].y,
                                         .low = several ? s[count].low : NULL,
                                         .high = several ? s[count].high : NULL,
                                         .count = d->count,
                                         .label = text[0] ? label[count] : NULL,
                                         .points = true,
                                         .bare = !axis};
        count++;
    }
    size_t theory = theory_of(sweep, k);
    if (count == 1 && theory < sweep->measure_count && !take_sheet(&s[1], d->count, &error)) {
        trace(results, theory, dimension, 0, 0, &s[1]);
        // The curve first: the points lie on it.
        line[1] = line[0];
        line[0].x = s[1].x;
        line[0].y = s[1].y;
        contrast(&line[1], &line[0]);
        count++;
    }
    for (size_t i = 0; i < d->count && i < 1000; i++) names[i] = d->setting[i].label;
    name_label(x_label, d->name, axis ? axis->unit : NULL);
    name_label(y_label, sweep->measure[k], unit_of(sweep->measure[k]));
    write_title(title, results, "");
    scree_chart chart = {.title = title,
                         .x_label = x_label,
                         .y_label = y_label,
                         .line = line,
                         .line_count = count,
                         .log_x = axis && is_wide(axis, d->count),
                         .x_name = axis ? NULL : names,
                         .x_name_count = d->count};
    (void)snprintf(name, sizeof name, "%s-over-%s", sweep->measure[k], d->name);
    if (count > 0) draw(results, name, &chart);
    for (size_t i = 0; i < count; i++) scree_release(&s[i].x);
}

// ---- relations ---------------------------------------------------------------------------------------------------

/// Means of measure y over those of measure x at points [first, first + count) of the grid, in the order of x.
static void relate(const scree_sweep_results *results, size_t x, size_t y, size_t first, size_t count, sheet *s)
{
    const scree_sweep *sweep = results->sweep;
    for (size_t point = 0; point < count; point++) {
        const scree_estimate *at = &results->estimate[(first + point) * sweep->measure_count];
        size_t place = point;
        for (; place > 0 && s->x[place - 1] > at[x].mean; place--) {
            s->x[place] = s->x[place - 1];
            s->y[place] = s->y[place - 1];
            s->low[place] = s->low[place - 1];
            s->high[place] = s->high[place - 1];
        }
        put_estimate(s, place, at[x].mean, &at[y], 1);
    }
}

/// Points of the grid that are one line of a relation: where several dimensions vary those of the last one, if the
/// lines are not too many.
static size_t points_of_line(const scree_sweep *sweep)
{
    if (sweep->dimension_count < 2) return sweep->point_count;
    const size_t each = sweep->dimension[sweep->dimension_count - 1].count;
    return sweep->point_count / each <= MOST_LINES ? each : sweep->point_count;
}

/// What a relation is between; the closed forms are those of y over those of x, or over x itself where it has none.
typedef struct related {
    size_t x, y, closed_x, closed_y;
    size_t each; ///< points a line
} related;

/// A line of simulations, and its closed form.
static bool draw_line(const scree_sweep_results *results, const related *r, size_t first, sheet s[2],
                      scree_chart_line *points, scree_chart_line *closed)
{
    scree_error error;
    const bool several = results->sweep->realisations > 1;
    if (take_sheet(&s[0], r->each, &error)) return false;
    relate(results, r->x, r->y, first, r->each, &s[0]);
    *points = (scree_chart_line){.x = s[0].x,
                                 .y = s[0].y,
                                 .low = several ? s[0].low : NULL,
                                 .high = several ? s[0].high : NULL,
                                 .count = r->each,
                                 .points = true};
    if (r->closed_y == results->sweep->measure_count || take_sheet(&s[1], r->each, &error)) return true;
    relate(results, r->closed_x, r->closed_y, first, r->each, &s[1]);
    *closed = (scree_chart_line){.x = s[1].x, .y = s[1].y, .count = r->each};
    return true;
}

static void draw_relation(const scree_sweep_results *results, const scree_sweep_relation *relation)
{
    const char *name_x = relation->x, *name_y = relation->y;
    const scree_sweep *sweep = results->sweep;
    related r = {.x = measure_named(sweep, name_x, ""), .y = measure_named(sweep, name_y, "")};
    r.closed_x = theory_of(sweep, r.x);
    r.closed_y = theory_of(sweep, r.y);
    r.each = points_of_line(sweep);
    if (r.closed_x == sweep->measure_count) r.closed_x = r.x;
    const bool theory = r.closed_y < sweep->measure_count;
    const size_t lines = sweep->point_count / r.each;
    char x_label[LABEL], y_label[LABEL], label[MOST_LINES][LABEL], text[LABEL], name[320], title[TITLE];
    sheet s[2 * MOST_LINES] = {0};
    scree_chart_line line[2 * MOST_LINES] = {0};
    size_t count = 0;
    // Closed forms first: the points lie on them.
    for (size_t k = 0; k < lines; k++) {
        scree_chart_line *closed = &line[k], *points = &line[theory ? lines + k : k];
        if (!draw_line(results, &r, k * r.each, &s[2 * k], points, closed)) break;
        count += theory ? 2 : 1;
        if (theory) contrast(points, closed);
        if (lines == 1) continue;
        scree_point_label(sweep, k * r.each, sweep->dimension_count - 1, text, sizeof text);
        plain(label[k], text);
        closed->label = NULL; // where there are none, the points themselves
        points->label = label[k];
        points->colour = closed->colour = (int)k + 1;
    }
    name_label(x_label, name_x, unit_of(name_x));
    name_label(y_label, name_y, unit_of(name_y));
    write_title(title, results, lines > 1 && theory ? "closed forms as lines" : "");
    scree_chart chart = {.title = title,
                         .x_label = x_label,
                         .y_label = y_label,
                         .line = line,
                         .line_count = count,
                         .log_y = relation->log_y};
    (void)snprintf(name, sizeof name, "%s-over-%s", name_y, name_x);
    if (count == (theory ? 2 : 1) * lines) draw(results, name, &chart);
    for (size_t i = 0; i < 2 * MOST_LINES; i++) scree_release(&s[i].x);
}

void scree_sweep_draw_measures(const scree_sweep_results *results)
{
    const scree_sweep *sweep = results->sweep;
    for (size_t dimension = 0; dimension < sweep->dimension_count; dimension++)
        for (size_t k = 0; k < sweep->measure_count && sweep->dimension[dimension].count > 1; k++)
            if (!is_theory(sweep, k)) draw_measure(results, k, dimension);
    for (int64_t i = 0; i < sweep->config.relation_count; i++) draw_relation(results, &sweep->config.relations[i]);
}
