/// What a theory has found: values and curves, on disk and as a figure.
#include "library/theory.h"

#include "base/handle.h"
#include "io/run_directory.h"
#include "view/chart.h"

#include <assert.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>

scree_status theory_create(scree_theory **theory, scree_error *error)
{
    scree_status status = scree_allocate(theory, 1, sizeof **theory, error);
    if (!status) scree_handle_made(*theory);
    return status;
}

scree_status theory_begin_figure(scree_theory *t, const char *name, size_t points, size_t curves,
                                 theory_figure **figure, scree_error *error)
{
    assert(t->figure_count < THEORY_FIGURES);
    theory_figure *f = &t->figure[t->figure_count];
    *figure = f;
    f->name = name;
    scree_status status = scree_allocate(&f->x, points, sizeof *f->x, error);
    t->figure_count++;
    if (!status) status = scree_allocate(&f->curve, curves, sizeof *f->curve, error);
    if (status) return status;
    f->points = points;
    f->curve_count = curves;
    for (size_t k = 0; k < curves && !status; k++)
        status = scree_allocate(&f->curve[k].y, points, sizeof *f->curve[k].y, error);
    return status;
}

void theory_add(scree_theory *t, const char *name, double value, const char *unit, const char *meaning)
{
    assert(t->value_count < THEORY_VALUES);
    if (!isnan(value)) t->value[t->value_count++] = (scree_theory_value){name, value, unit, meaning};
}

size_t scree_theory_values(const scree_theory *t, const scree_theory_value **values)
{
    scree_handle_check(t, "a theory");
    *values = t->value;
    return t->value_count;
}

void scree_theory_free(scree_theory *t)
{
    if (!t) return;
    scree_handle_freed(t, "a theory");
    for (size_t i = 0; i < t->figure_count; i++) {
        theory_figure *f = &t->figure[i];
        for (size_t k = 0; k < f->curve_count; k++) scree_release(&f->curve[k].y);
        scree_release(&f->curve);
        scree_release(&f->x);
    }
    scree_release(&t);
}

// ---- files -------------------------------------------------------------------------------------------------------

static void write_values(FILE *file, const void *of)
{
    const scree_theory *t = of;
    fputs("name,value,unit,meaning\n", file);
    for (size_t k = 0; k < t->value_count; k++)
        fprintf(file, "%s,%.17g,%s,\"%s\"\n", t->value[k].name, t->value[k].value, t->value[k].unit,
                t->value[k].meaning);
}

static void write_curves(FILE *file, const void *of)
{
    const theory_figure *f = of;
    fprintf(file, "%s [%s]", f->x_name, f->x_unit);
    for (size_t k = 0; k < f->curve_count; k++) fprintf(file, ",%s [%s]", f->curve[k].name, f->y_unit);
    fputc('\n', file);
    for (size_t row = 0; row < f->points; row++) {
        fprintf(file, "%.9g", f->x[row]);
        for (size_t k = 0; k < f->curve_count; k++) fprintf(file, ",%.9g", f->curve[k].y[row]);
        fputc('\n', file);
    }
}

static scree_status write_table(const char *folder, const char *name, void (*rows)(FILE *, const void *),
                                const void *of, scree_error *error)
{
    char path[PATH_MAX];
    FILE *file;
    scree_status status = scree_path_join(path, sizeof path, folder, name, error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (status) return status;
    rows(file, of);
    return scree_replace_finish(path, file, true, error);
}

static scree_status draw(const char *folder, const theory_figure *f, scree_error *error)
{
    char path[PATH_MAX];
    scree_chart_line *line;
    scree_status status = scree_path_join(path, sizeof path, folder, f->name, error);
    if (!status) status = scree_allocate(&line, f->curve_count, sizeof *line, error);
    if (status) return status;
    for (size_t k = 0; k < f->curve_count; k++)
        line[k] = (scree_chart_line){.x = f->x,
                                     .y = f->curve[k].y,
                                     .count = f->points,
                                     .label = f->curve[k].label,
                                     .colour = f->curve[k].colour,
                                     .dashed = f->curve[k].dashed};
    const scree_chart chart = {.title = f->title,
                               .x_label = f->x_label,
                               .y_label = f->y_label,
                               .line = line,
                               .line_count = f->curve_count,
                               .x_name = f->corner_count > 0 ? f->corner : NULL,
                               .x_name_count = f->corner_count};
    status = scree_chart_draw(path, &chart, error);
    scree_release(&line);
    return status;
}

scree_status scree_theory_write(const scree_theory *t, const char *folder, scree_error *error)
{
    scree_handle_check(t, "a theory");
    char name[NAME_MAX];
    scree_status status = scree_folders_make(folder, error);
    if (!status) status = write_table(folder, "values.csv", write_values, t, error);
    for (size_t k = 0; k < t->figure_count && !status; k++) {
        (void)snprintf(name, sizeof name, "%s-table.csv", t->figure[k].name);
        status = write_table(folder, name, write_curves, &t->figure[k], error);
        if (!status) status = draw(folder, &t->figure[k], error);
    }
    return status;
}
