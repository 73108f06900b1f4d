/// What a theory has found: values and curves, on disk and as a figure.
#include "library/theory.h"

#include "io/run_directory.h"
#include "view/chart.h"

#include <assert.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>

scree_status theory_create(scree_theory **theory, scree_error *error)
{
    return scree_allocate(theory, 1, sizeof **theory, error);
}

scree_status theory_begin_curves(scree_theory *t, size_t points, size_t curves, scree_error *error)
{
    scree_status status = scree_allocate(&t->x, points, sizeof *t->x, error);
    if (!status) status = scree_allocate(&t->curve, curves, sizeof *t->curve, error);
    if (status) return status;
    t->points = points;
    t->curve_count = curves;
    for (size_t k = 0; k < curves && !status; k++)
        status = scree_allocate(&t->curve[k].y, points, sizeof *t->curve[k].y, error);
    return status;
}

void theory_add(scree_theory *t, const char *name, double value, const char *unit, const char *meaning)
{
    assert(t->value_count < THEORY_VALUES);
    if (!isnan(value)) t->value[t->value_count++] = (scree_theory_value){name, value, unit, meaning};
}

size_t scree_theory_values(const scree_theory *t, const scree_theory_value **values)
{
    *values = t->value;
    return t->value_count;
}

void scree_theory_free(scree_theory *t)
{
    if (!t) return;
    for (size_t k = 0; k < t->curve_count; k++) scree_release(&t->curve[k].y);
    scree_release(&t->curve);
    scree_release(&t->x);
    scree_release(&t);
}

// ---- files -------------------------------------------------------------------------------------------------------

static void write_values(FILE *file, const scree_theory *t)
{
    fputs("name,value,unit,meaning\n", file);
    for (size_t k = 0; k < t->value_count; k++)
        fprintf(file, "%s,%.17g,%s,\"%s\"\n", t->value[k].name, t->value[k].value, t->value[k].unit,
                t->value[k].meaning);
}

static void write_curves(FILE *file, const scree_theory *t)
{
    fprintf(file, "%s [1]", t->x_name);
    for (size_t k = 0; k < t->curve_count; k++) fprintf(file, ",%s [%s]", t->curve[k].name, t->y_unit);
    fputc('\n', file);
    for (size_t row = 0; row < t->points; row++) {
        fprintf(file, "%.9g", t->x[row]);
        for (size_t k = 0; k < t->curve_count; k++) fprintf(file, ",%.9g", t->curve[k].y[row]);
        fputc('\n', file);
    }
}

static scree_status write_table(const char *folder, const char *name, void (*rows)(FILE *, const scree_theory *),
                                const scree_theory *t, scree_error *error)
{
    char path[PATH_MAX];
    FILE *file;
    scree_status status = scree_path_join(path, sizeof path, folder, name, error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (status) return status;
    rows(file, t);
    return scree_replace_finish(path, file, true, error);
}

static scree_status draw(const char *folder, const scree_theory *t, scree_error *error)
{
    char path[PATH_MAX];
    scree_chart_line *line;
    scree_status status = scree_path_join(path, sizeof path, folder, t->figure, error);
    if (!status) status = scree_allocate(&line, t->curve_count, sizeof *line, error);
    if (status) return status;
    for (size_t k = 0; k < t->curve_count; k++)
        line[k] = (scree_chart_line){.x = t->x,
                                     .y = t->curve[k].y,
                                     .count = t->points,
                                     .label = t->curve[k].label,
                                     .colour = t->curve[k].colour,
                                     .dashed = t->curve[k].dashed};
    const scree_chart chart = {.title = t->title,
                               .x_label = t->x_label,
                               .y_label = t->y_label,
                               .line = line,
                               .line_count = t->curve_count,
                               .x_name = t->corner_count > 0 ? t->corner : NULL,
                               .x_name_count = t->corner_count};
    status = scree_chart_draw(path, &chart, error);
    scree_release(&line);
    return status;
}

scree_status scree_theory_write(const scree_theory *t, const char *folder, scree_error *error)
{
    char name[NAME_MAX];
    scree_status status = scree_folders_make(folder, error);
    if (!status) status = write_table(folder, "values.csv", write_values, t, error);
    if (status || t->points == 0) return status;
    (void)snprintf(name, sizeof name, "%s-table.csv", t->figure);
    status = write_table(folder, name, write_curves, t, error);
    return status ? status : draw(folder, t, error);
}
