/// A chart that the user asks for: columns of series.csv over another one, of all rows or of some stages.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "case/case.h"
#include "io/run_directory.h"
#include "module/table.h"
#include "view/chart.h"

#include <scree/scree.h>

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LINES     12
#define NAME_SIZE 200 ///< of the stem of the files

typedef struct asked_chart {
    const scree_plot_columns *columns;
    scree_plot_run run; ///< only series and folder are there
    scree_case *c;      ///< NULL: case.yaml cannot be read, stages have numbers only
    size_t x, y[LINES], lines;
    size_t rows; ///< of each line, gaps among them
    bool *taken; ///< rows of the series that belong to a stage that was asked for
    double *value;
} asked_chart;

/// The next name of a list with commas, without blanks around it. False: there is none.
static bool next_name(const char **at, char *name, size_t size)
{
    if (!*at) return false;
    size_t length = strcspn(*at, ",");
    const char *begin = *at + strspn(*at, " ");
    size_t end = length;
    while (end > 0 && (*at)[end - 1] == ' ') end--;
    (void)snprintf(name, size, "%.*s", *at + end > begin ? (int)(*at + end - begin) : 0, begin);
    *at = (*at)[length] == ',' ? *at + length + 1 : NULL;
    return true;
}

// ---- columns -----------------------------------------------------------------------------------------------------

/// Whether all words of `name`, parted by '_', are in `column`.
static bool has_words(const char *column, const char *name)
{
    char word[64];
    for (; *name; name += strspn(name, "_")) {
        const size_t length = strcspn(name, "_");
        if (length >= sizeof word) return false;
        (void)snprintf(word, sizeof word, "%.*s", (int)length, name);
        if (!strstr(column, word)) return false;
        name += length;
    }
    return true;
}

/// Columns of the same words, the one that is spelled nearly so, and where all stand.
static void list_alike(const scree_series *series, const char *name, char *list, size_t size)
{
    const char *nearest = scree_nearest(name, (const char *const *)series->name, series->column_count);
    size_t used = 0;
    *list = 0;
    for (size_t c = 0; c < series->column_count && used < size / 2; c++)
        if (series->name[c] == nearest || has_words(series->name[c], name))
            used += (size_t)snprintf(list + used, size - used, "%s, ", series->name[c]);
    (void)snprintf(list + used, size - used, "%s",
                   used > 0 ? "and others of the first line of series.csv" : "a name of the first line of series.csv");
}

static scree_status find_column(const asked_chart *chart, const char *option, const char *name, size_t *column,
                                scree_error *error)
{
    const scree_series *series = &chart->run.series;
    for (*column = 0; *column < series->column_count; ++*column)
        if (strcmp(series->name[*column], name) == 0) return SCREE_OK;
    char list[sizeof error->accepted];
    list_alike(series, name, list, sizeof list);
    return scree_error_refuse(error, option, list, "series.csv has no column '%s'", name);
}

static scree_status find_columns(asked_chart *chart, scree_error *error)
{
    char name[128];
    const char *at = chart->columns->y;
    scree_status status = find_column(chart, "--x", chart->columns->x ? chart->columns->x : "time", &chart->x, error);
    while (!status && next_name(&at, name, sizeof name)) {
        if (chart->lines == LINES) return scree_error_refuse(error, "--y", "at most 12", "too many columns");
        status = find_column(chart, "--y", name, &chart->y[chart->lines], error);
        if (status) break;
        char **unit = chart->run.series.unit;
        const char *first = unit[chart->y[0]], *now = unit[chart->y[chart->lines++]];
        if (strcmp(first, now) != 0)
            status = scree_error_refuse(error, "--y", first,
                                        "one chart has one unit, and this column has another: '%s'", name);
    }
    return status;
}

// ---- stages ------------------------------------------------------------------------------------------------------

/// Whether stage `number` is called `name`, or is of this kind, or has this number.
static bool stage_is(const asked_chart *chart, int64_t number, const char *name)
{
    char *end;
    errno = 0;
    long long wanted = strtoll(name, &end, 10);
    if (end != name && *end == '\0' && errno == 0 && wanted == number) return true;
    if (!chart->c || number < 0 || number >= chart->c->config.stage_count) return false;
    const scree_config_stage *stage = &chart->c->config.stages[number];
    return (stage->name && strcmp(stage->name, name) == 0) ||
           (stage->kind >= 0 && strcmp(scree_modules[stage->kind]->name, name) == 0);
}

static scree_status refuse_stage(const asked_chart *chart, const char *name, scree_error *error)
{
    char list[sizeof error->accepted];
    size_t used = (size_t)snprintf(list, sizeof list, "a number");
    for (int64_t k = 0; chart->c && k < chart->c->config.stage_count && used < sizeof list; k++)
        if (chart->c->config.stages[k].name)
            used += (size_t)snprintf(list + used, sizeof list - used, ", %s", chart->c->config.stages[k].name);
    return scree_error_refuse(error, "--stage", list, "series.csv has no row of a stage '%s'", name);
}

/// Marks the rows of the stages that were asked for; of each there has to be one.
static scree_status take_rows(asked_chart *chart, scree_error *error)
{
    const scree_series *series = &chart->run.series;
    const double *stage = scree_series_get(series, "stage");
    const char *at = chart->columns->stage;
    char name[128];
    scree_status status = scree_allocate(&chart->taken, series->row_count, sizeof *chart->taken, error);
    for (size_t row = 0; !status && !at && row < series->row_count; row++) chart->taken[row] = true;
    while (!status && next_name(&at, name, sizeof name)) {
        bool found = false;
        for (size_t row = 0; stage && row < series->row_count; row++)
            if (stage_is(chart, (int64_t)stage[row], name)) chart->taken[row] = found = true;
        if (!found) status = refuse_stage(chart, name, error);
    }
    return status;
}

/// Copies the rows: x, then each line, with a gap where a stage in between is left out.
static scree_status gather(asked_chart *chart, scree_error *error)
{
    const scree_series *series = &chart->run.series;
    const size_t room = 2 * series->row_count + 1;
    scree_status status = scree_allocate(&chart->value, (chart->lines + 1) * room, sizeof *chart->value, error);
    for (size_t line = 0; !status && line <= chart->lines; line++) {
        const double *from = series->value[line == 0 ? chart->x : chart->y[line - 1]];
        double *to = chart->value + line * room;
        chart->rows = 0;
        for (size_t row = 0; row < series->row_count; row++) {
            if (!chart->taken[row]) continue;
            if (chart->rows > 0 && !chart->taken[row - 1]) to[chart->rows++] = NAN;
            to[chart->rows++] = from[row];
        }
    }
    return status;
}

// ---- texts -------------------------------------------------------------------------------------------------------

/// "stress_axial_plates" becomes "stress axial plates": underscores would lower what follows.
static void write_words(char *text, size_t size, const char *name, size_t length)
{
    (void)snprintf(text, size, "%.*s", (int)length, name);
    for (char *c = text; *c; c++)
        if (*c == '_') *c = ' ';
}

/// Letters of whole words with which the names of all lines begin; 0: none.
static size_t common_words(const asked_chart *chart)
{
    const char *first = chart->run.series.name[chart->y[0]];
    size_t length = strlen(first);
    for (size_t k = 1; k < chart->lines; k++) {
        const char *other = chart->run.series.name[chart->y[k]];
        size_t same = 0, word = 0;
        for (; same < length && first[same] == other[same]; same++)
            if (first[same] == '_') word = same;
        const bool whole = same == length && (other[same] == '_' || other[same] == '\0');
        length = whole ? same : word;
    }
    return length;
}

/// What columns of a unit are of, when their names have no word in common.
static const char *quantity_of(const char *unit)
{
    static const struct {
        const char *unit, *word;
    } known[] = {{"Pa", "stress"}, {"J", "energy"}, {"N", "force"},
                 {"m", "length"},  {"s", "time"},   {"m/s", "velocity"}};
    for (size_t k = 0; k < sizeof known / sizeof *known; k++)
        if (strcmp(known[k].unit, unit) == 0) return known[k].word;
    return "value";
}

/// "stress (kPa)" with the prefix that suits the values, which are scaled with it; strains are in percent. Ratios and
/// steps keep their numbers.
static void label_axis(char *label, size_t size, const char *words, const char *unit, double *value, size_t count)
{
    static const char *const prefixed[] = {"Pa", "J", "N", "m", "s", "m/s", "W"};
    const bool percent = strcmp(unit, "1") == 0 && strstr(words, "strain");
    char pattern[200];
    bool has_prefix = false;
    for (size_t k = 0; k < sizeof prefixed / sizeof *prefixed; k++) has_prefix |= strcmp(prefixed[k], unit) == 0;
    (void)snprintf(pattern, sizeof pattern, "%s (%s%s)", words, has_prefix ? "@" : "", percent ? "%" : unit);
    double factor = scree_plot_label(label, size, pattern, scree_plot_largest(value, count));
    for (size_t k = 0; k < count; k++) value[k] *= percent ? 100 : factor;
}

/// Stem of the files: the columns, and the stages.
static scree_status name_files(const asked_chart *chart, char *name, scree_error *error)
{
    size_t used = 0;
    for (size_t k = 0; k < chart->lines && used < NAME_SIZE; k++)
        used += (size_t)snprintf(name + used, NAME_SIZE - used, "%s%s", k > 0 ? "-" : "",
                                 chart->run.series.name[chart->y[k]]);
    if (used < NAME_SIZE)
        used += (size_t)snprintf(name + used, NAME_SIZE - used, "-over-%s", chart->run.series.name[chart->x]);
    if (used < NAME_SIZE && chart->columns->stage)
        used += (size_t)snprintf(name + used, NAME_SIZE - used, "-%s", chart->columns->stage);
    if (used >= NAME_SIZE)
        return scree_error_refuse(error, "--y", "fewer columns", "the name of the figure becomes too long");
    for (char *c = name; *c; c++)
        if (!isalnum((unsigned char)*c) && *c != '_') *c = '-';
    return SCREE_OK;
}

static scree_status draw(asked_chart *chart, char *path, scree_error *error)
{
    const scree_series *series = &chart->run.series;
    const size_t room = 2 * series->row_count + 1, common = common_words(chart);
    char name[NAME_SIZE], x_label[160], y_label[200], words[128], title[300], label[LINES][128];
    scree_chart_line line[LINES];
    scree_status status = name_files(chart, name, error);
    if (status) return status;
    (void)snprintf(path, PATH_MAX, "%.*s/%s", PATH_MAX - NAME_SIZE - 2, chart->run.figures, name);
    write_words(words, sizeof words, series->name[chart->x], strlen(series->name[chart->x]));
    label_axis(x_label, sizeof x_label, words, series->unit[chart->x], chart->value, chart->rows);
    const char *first = series->name[chart->y[0]], *unit = series->unit[chart->y[0]];
    write_words(words, sizeof words, common > 0 ? first : quantity_of(unit), common > 0 ? common : strlen(unit) + 8);
    (void)snprintf(title, sizeof title, "%s over %.100s", words, series->name[chart->x]);
    for (char *c = title; *c; c++) *c = (char)(*c == '_' ? ' ' : c == title ? toupper((unsigned char)*c) : *c);
    // All lines are scaled as one.
    for (size_t k = 1; k < chart->lines; k++)
        memmove(chart->value + room + k * chart->rows, chart->value + (k + 1) * room, chart->rows * sizeof(double));
    label_axis(y_label, sizeof y_label, words, unit, chart->value + room, chart->lines * chart->rows);
    for (size_t k = 0; k < chart->lines; k++) {
        write_words(label[k], sizeof label[k], series->name[chart->y[k]], strlen(series->name[chart->y[k]]));
        line[k] = (scree_chart_line){.x = chart->value,
                                     .y = chart->value + room + k * chart->rows,
                                     .count = chart->rows,
                                     .label = chart->lines > 1 ? label[k] : NULL};
    }
    const scree_chart drawn = {
        .title = title, .x_label = x_label, .y_label = y_label, .line = line, .line_count = chart->lines};
    return scree_chart_draw(path, &drawn, error);
}

// ---- the whole ---------------------------------------------------------------------------------------------------

static scree_status open_run(asked_chart *chart, const char *directory, scree_error *error)
{
    char path[PATH_MAX];
    scree_problems *problems = NULL;
    chart->run.directory = directory;
    scree_status status = scree_path_join(path, sizeof path, directory, SCREE_FILE_SERIES, error);
    if (!status) status = scree_series_read(&chart->run.series, path, error);
    if (!status) status = scree_path_join(path, sizeof path, directory, SCREE_FILE_CASE, error);
    if (!status && scree_case_reread(path, scree_former_keys, &chart->c, &problems)) {
        scree_problems_free(problems);
        chart->c = NULL;
    }
    return status;
}

scree_status scree_plot_chart(const char *directory, const scree_plot_columns *columns,
                              void (*message)(void *user, const char *path), void *user, scree_error *error)
{
    scree_folder_lock taken;
    asked_chart chart = {.columns = columns};
    char path[PATH_MAX], said[PATH_MAX + 8];
    scree_status status = scree_plot_lock(&taken, directory, error);
    if (!status) status = open_run(&chart, directory, error);
    if (!status) status = find_columns(&chart, error);
    if (!status) status = take_rows(&chart, error);
    if (!status) status = gather(&chart, error);
    if (!status) status = scree_plot_make_folder(&chart.run, error);
    if (!status) status = draw(&chart, path, error);
    if (!status && message) {
        (void)snprintf(said, sizeof said, "%s.svg", path);
        scree_plot_warn(message, user);
        message(user, said);
    }
    if (chart.c) scree_case_free(chart.c);
    scree_series_destroy(&chart.run.series);
    scree_release(&chart.taken);
    scree_release(&chart.value);
    scree_folder_lock_release(&taken);
    return status;
}
