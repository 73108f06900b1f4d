/// The charts of a run: columns of series.csv over the axial strain of the loading stage.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "io/run_directory.h"
#include "view/chart.h"
#include "view/scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define CURVES 12

enum { AUTOMATIC, BLUE, VERMILLION, GREEN, PINK, SKY, ORANGE, BLACK };

typedef struct curve {
    const char *column, *label;
    double factor; ///< from the unit of the column to that of the axis
    int colour;
    bool dashed;
} curve;

// clang-format off
static const struct chart_entry {
    const char *name, *title;
    const char *y_label; ///< "@" stands for the SI prefix that suits the values
    bool log_y;
    curve curve[CURVES]; ///< ended by a column that is NULL
} charts[] = {
    {"volumetric-strain", "Volumetric strain", "dilation −ε_v (%), positive: volume grows", false, {
        {"volumetric_strain", "sum of increments", -100, BLUE, false},
        {"volumetric_strain_enclosed", "enclosed volume", -100, SKY, true},
        {"volumetric_strain_solid", "solid fraction", -100, VERMILLION, false}}},
    {"stress-ratio", "Stress ratio", "axial over lateral stress (1)", false, {
        {"stress_ratio", "applied", 1, BLUE, false},
        {"stress_ratio_contacts", "from contacts", 1, VERMILLION, true}}},
    {"shear-ratio", "Shear stress over normal stress", "shear over axial stress (1)", false, {
        {"shear_ratio", NULL, 1, BLUE, false}}},
    {"slip", "Slip at contacts", "mean slip speed / v_R (1)", false, {
        {"slip_ratio", NULL, 1, BLUE, false}}},
    {"stress", "Stress, applied and from contacts", "stress (@Pa), compression positive", false, {
        {"stress_axial_plates", "axial, applied", 1, BLUE, false},
        {"stress_axial_contacts", "axial, contacts", 1, SKY, true},
        {"stress_lateral_applied", "lateral, applied", 1, VERMILLION, false},
        {"stress_lateral_contacts", "lateral, contacts", 1, ORANGE, true}}},
    {"energy", "Energy ledger", "energy (@J)", false, {
        {"work_plates", "work of plates", 1, BLUE, false},
        {"work_pressure", "work of pressure", 1, SKY, false},
        {"work_periodic", "work of the cell", 1, BLUE, true},
        {"work_gravity", "work of gravity", 1, GREEN, false},
        {"dissipated_friction", "lost to friction", 1, VERMILLION, false},
        {"dissipated_damping", "lost to damping", 1, ORANGE, false},
        {"elastic_normal", "elastic, normal", 1, PINK, false},
        {"elastic_tangential", "elastic, tangential", 1, PINK, true},
        {"kinetic", "kinetic", 1, BLACK, true},
        {"stiffness_work", "change of stiffness", 1, GREEN, true},
        {"energy_residual", "residual", 1, BLACK, false}}},
    {"energy-stored", "Stored energy and residual", "energy (@J)", false, {
        {"elastic_normal", "elastic, normal", 1, PINK, false},
        {"elastic_tangential", "elastic, tangential", 1, PINK, true},
        {"kinetic", "kinetic", 1, BLACK, true},
        {"stiffness_work", "change of stiffness", 1, GREEN, true},
        {"energy_residual", "residual", 1, BLACK, false}}},
    {"coordination", "Coordination", "contacts per particle (1)", false, {
        {"coordination", "all particles", 1, BLUE, false},
        {"coordination_without_rattlers", "without rattlers", 1, VERMILLION, true}}},
    {"solid-fraction", "Solid fraction", "solid fraction (1)", false, {
        {"solid_fraction", NULL, 1, BLUE, false}}},
    {"unbalanced-force", "Unbalanced force", "mean unbalanced over mean contact force (1)", true, {
        {"unbalanced_ratio", NULL, 1, BLUE, false}}},
};
// clang-format on

/// The loading rows of `column`, times `factor`, into `value`. False: there is no such column.
static bool gather(const scree_plot_run *run, const char *column, double factor, double *value)
{
    const double *all = scree_series_get(&run->series, column);
    for (size_t k = 0; all && k < run->row_count; k++) value[k] = factor * all[run->first_row + k];
    return all != NULL;
}

/// Writes the label of an axis with the SI prefix for values up to `largest`. Returns the factor that goes with it.
static double write_label(char *label, size_t size, const char *pattern, double largest)
{
    static const struct {
        double unit;
        const char *text;
    } prefix[] = {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}, {1e-3, "m"}, {1e-6, "µ"}, {1e-9, "n"}};
    const char *place = strchr(pattern, '@');
    size_t k = place ? 0 : 3;
    while (place && k < 6 && !(largest >= prefix[k].unit)) k++;
    (void)snprintf(label, size, "%.*s%s%s", place ? (int)(place - pattern) : 0, pattern, place ? prefix[k].text : "",
                   place ? place + 1 : pattern);
    return 1 / prefix[k].unit;
}

static double largest_magnitude(const double *value, size_t count)
{
    double largest = 0;
    for (size_t k = 0; k < count; k++)
        if (isfinite(value[k])) largest = fmax(largest, fabs(value[k]));
    return largest > 0 ? largest : 1;
}

static bool is_nothing(const double *value, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (value[k] != 0 && !isnan(value[k])) return false;
    return true;
}

static scree_status draw_chart(const scree_plot_run *run, const struct chart_entry *entry, double *value,
                               scree_error *error)
{
    char path[PATH_MAX], label[128], strain[48];
    scree_chart_line line[CURVES];
    scree_status status = scree_path_join(path, sizeof path, run->figures, entry->name, error);
    if (status) return status;
    if (run->row_count == 0)
        return scree_error_set(error, SCREE_ERROR_INPUT, "%s has no rows of a loading stage", SCREE_FILE_SERIES);
    size_t count = 0;
    (void)snprintf(strain, sizeof strain, "%s (%%)", scree_strain_name(run->of_cell));
    (void)gather(run, "axial_strain", 100, value);
    for (const curve *c = entry->curve; c->column; c++) {
        double *y = value + (count + 1) * run->row_count;
        bool there = gather(run, c->column, c->factor, y);
        // The first curve makes the chart; others may be missing in runs of earlier versions.
        if (!there && c == entry->curve)
            return scree_error_set(error, SCREE_ERROR_INPUT, "%s has no column '%s'", SCREE_FILE_SERIES, c->column);
        // Of many curves those that are nothing throughout, such as the work of gravity where there is none, are left
        // out.
        if (!there || (entry->curve[2].column && is_nothing(y, run->row_count))) continue;
        line[count++] = (scree_chart_line){
            .x = value, .y = y, .count = run->row_count, .label = c->label, .dashed = c->dashed, .colour = c->colour};
    }
    double *first = value + run->row_count;
    double scale = write_label(label, sizeof label, entry->y_label, largest_magnitude(first, count * run->row_count));
    for (size_t k = 0; k < count * run->row_count; k++) first[k] *= scale;
    scree_chart chart = {.title = entry->title,
                         .x_label = strain,
                         .y_label = label,
                         .line = line,
                         .line_count = count,
                         .log_y = entry->log_y};
    return scree_chart_draw(path, &chart, error);
}

void scree_plot_charts(scree_plot_run *run)
{
    double *value;
    scree_error error = {0};
    scree_status status = scree_allocate(&value, (CURVES + 1) * run->row_count, sizeof *value, &error);
    if (status) {
        scree_plot_report(run, "charts", status, &error);
        return;
    }
    for (size_t k = 0; k < sizeof charts / sizeof charts[0]; k++) {
        bool of_cell = strcmp(charts[k].curve[0].column, "shear_ratio") == 0;
        if (of_cell && !run->of_cell) continue;
        status = draw_chart(run, &charts[k], value, &error);
        scree_plot_report(run, charts[k].name, status, &error);
    }
    scree_release(&value);
}
