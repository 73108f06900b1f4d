/// The charts of a run: columns of series.csv over the axial strain of the loading stage, or over the strain that runs
/// on through all of them where there are several. A number that the summary makes of a curve is marked on it, with how
/// it was found.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "io/run_directory.h"
#include "view/chart.h"
#include "view/scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define CURVES 12
/// Volumetric strain [1] that is rounding: solid fractions are sums over all bodies.
#define SAME_VOLUME 1e-9

enum { AUTOMATIC, BLUE, VERMILLION, GREEN, PINK, SKY, ORANGE, BLACK };

typedef struct curve {
    const char *column, *label;
    double factor; ///< from the unit of the column to that of the axis
    int colour;
    bool dashed;
} curve;

/// What is marked on the first curve: its peak (io/loading_stage.h), or the results `mu` of its steady part.
typedef enum chart_mark { NO_MARK, PEAK, STEADY } chart_mark;

// clang-format off
typedef struct chart_row {
    scree_figure figure;
    const char *title;
    const char *y_label; ///< "@" stands for the SI prefix that suits the values
    bool log_y;
    bool of_cell; ///< of samples that are loaded as a periodic cell alone
    chart_mark mark;
    curve curve[CURVES]; ///< ended by a column that is NULL
} chart_row;

static const chart_row rows[] = {
    {{"volumetric-strain", "volumetric strain, by increments, enclosed volume and solid fraction", SCREE_WITH_LOADING},
     "Volumetric strain", "volumetric strain (%), compression positive", false, false, NO_MARK, {
        {"volumetric_strain", "sum of increments", 100, BLUE, false},
        {"volumetric_strain_enclosed", "enclosed volume", 100, SKY, true},
        {"volumetric_strain_solid", "solid fraction", 100, VERMILLION, false}}},
    {{"stress-ratio", "axial over lateral stress, applied and from contacts", SCREE_WITH_LOADING},
     "Stress ratio", "axial over lateral stress (1)", false, false, PEAK, {
        {"stress_ratio", "applied", 1, BLUE, false},
        {"stress_ratio_contacts", "from contacts", 1, VERMILLION, true}}},
    {{"shear-ratio", "friction of the sample, mu = shear stress over normal stress, and its mean over steady shear",
      SCREE_WITH_LOADING},
     "Shear stress over normal stress", "mu, shear over normal stress (1)", false, true, STEADY, {
        {"mu", "of each sample", 1, BLUE, false}}},
    {{"slip", "mean slip speed at contacts over the reference velocity", SCREE_ON_REQUEST},
     "Slip at contacts", "mean slip speed / v_R (1)", false, false, NO_MARK, {
        {"slip_ratio", NULL, 1, BLUE, false}}},
    {{"stress", "axial and lateral stress, applied and from contacts", SCREE_ON_REQUEST},
     "Stress, applied (lateral: without friction of the plates) and from contacts", "stress (@Pa), compression positive", false, false, NO_MARK, {
        {"stress_axial_plates", "axial, applied", 1, BLUE, false},
        {"stress_axial_contacts", "axial, contacts", 1, SKY, true},
        {"stress_lateral_applied", "lateral, applied", 1, VERMILLION, false},
        {"stress_lateral_contacts", "lateral, contacts", 1, ORANGE, true}}},
    {{"energy", "works, losses, stored energies and the residual of their balance", SCREE_WITH_LOADING},
     "Energy ledger", "energy (@J)", false, false, NO_MARK, {
        {"work_plates", "work of plates", 1, BLUE, false},
        {"work_pressure", "work of pressure", 1, SKY, false},
        {"work_periodic", "work of the cell", 1, BLUE, true},
        {"work_gravity", "work of gravity", 1, GREEN, false},
        {"dissipated_friction", "lost to friction", 1, VERMILLION, false},
        {"dissipated_damping", "lost to damping", 1, ORANGE, false},
        {"elastic_normal", "elastic, normal", 1, PINK, false},
        {"elastic_tangential", "elastic, tangential", 1, PINK, true},
        {"kinetic", "kinetic", 1, SKY, true},
        {"stiffness_work", "change of stiffness", 1, GREEN, true},
        {"energy_residual", "residual", 1, BLACK, false}}},
    {{"energy-stored", "stored energies and the residual of the balance", SCREE_ON_REQUEST},
     "Stored energy and residual", "energy (@J)", false, false, NO_MARK, {
        {"elastic_normal", "elastic, normal", 1, PINK, false},
        {"elastic_tangential", "elastic, tangential", 1, PINK, true},
        {"kinetic", "kinetic", 1, SKY, true},
        {"stiffness_work", "change of stiffness", 1, GREEN, true},
        {"energy_residual", "residual", 1, BLACK, false}}},
    {{"coordination", "contacts per particle, with and without rattlers", SCREE_WITH_LOADING},
     "Coordination", "contacts per particle (1)", false, false, NO_MARK, {
        {"coordination", "all particles", 1, BLUE, false},
        {"coordination_without_rattlers", "without rattlers", 1, VERMILLION, true}}},
    {{"solid-fraction", "solid fraction", SCREE_ON_REQUEST},
     "Solid fraction", "solid fraction (1)", false, false, NO_MARK, {
        {"solid_fraction", NULL, 1, BLUE, false}}},
    {{"unbalanced-force", "mean unbalanced over mean contact force", SCREE_ON_REQUEST},
     "Unbalanced force", "mean unbalanced over mean contact force (1)", true, false, NO_MARK, {
        {"unbalanced_ratio", NULL, 1, BLUE, false}}},
};
// clang-format on

static size_t rows_of(const scree_plot_run *run)
{
    return run->path.rows.last - run->path.rows.first;
}

/// The loading rows of `column`, times `factor`, into `value`; NAN between stages. Volumetric strains begin anew with
/// each stage: each goes on from where the one before it has ended. False: there is no such column.
static bool gather(const scree_plot_run *run, const char *column, double factor, double *value)
{
    const double *all = scree_series_get(&run->series, column), *stage = scree_series_get(&run->series, "stage");
    const bool anew = stage && strncmp(column, "volumetric_strain", strlen("volumetric_strain")) == 0;
    double before = 0, last = 0;
    for (size_t k = 0; all && k < rows_of(run); k++) {
        const size_t row = run->path.rows.first + k;
        if (anew && k > 0 && stage[row] != stage[row - 1]) {
            before += last;
            last = 0;
        }
        value[k] = isfinite(run->path.strain[row]) ? factor * (before + all[row]) : NAN;
        if (isfinite(all[row])) last = all[row];
    }
    return all != NULL;
}

double scree_plot_label(char *label, size_t size, const char *pattern, double largest)
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

double scree_plot_largest(const double *value, size_t count)
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

/// What plates hold back by friction is in the lateral stress of the contacts, and not in that of the sides.
static const char *label_of(const scree_plot_run *run, const curve *c)
{
    return strcmp(c->column, "stress_ratio_contacts") == 0 && run->path.plates ? "contacts, with friction at plates"
                                                                               : c->label;
}

/// Gathers the curves behind `value`, the strain in percent, one behind the other.
static size_t gather_curves(const scree_plot_run *run, const chart_row *row, double *value, scree_chart_line *line)
{
    size_t count = 0;
    for (size_t k = 0; k < rows_of(run); k++) value[k] = 100 * run->path.strain[run->path.rows.first + k];
    for (const curve *c = row->curve; c->column; c++) {
        double *y = value + (count + 1) * rows_of(run);
        // The first curve makes the chart; others may be missing in runs of earlier versions. Of many curves those that
        // are nothing throughout, such as the work of gravity where there is none, are left out.
        if (!gather(run, c->column, c->factor, y)) continue;
        if (row->curve[2].column && is_nothing(y, rows_of(run))) continue;
        line[count++] = (scree_chart_line){.x = value,
                                           .y = y,
                                           .count = rows_of(run),
                                           .label = label_of(run, c),
                                           .dashed = c->dashed,
                                           .colour = c->colour};
    }
    return count;
}

typedef struct mark {
    double x[2], y[2], low[2], high[2];
    char label[80];
} mark;

static bool mark_peak(const scree_plot_run *run, const chart_row *row, mark *m, scree_chart_line *line)
{
    const double *value = scree_series_get(&run->series, row->curve[0].column);
    const scree_peak peak = scree_peak_find(value, run->path.strain, run->path.rows);
    m->x[0] = 100 * peak.strain;
    m->y[0] = peak.value;
    (void)snprintf(m->label, sizeof m->label, "peak of the mean over %g %%: %.3g", 100 * SCREE_PEAK_WINDOW, peak.value);
    *line = (scree_chart_line){
        .x = m->x, .y = m->y, .count = 1, .label = m->label, .points = true, .bare = true, .colour = BLACK};
    return isfinite(peak.value);
}

static bool mark_steady(const scree_plot_run *run, mark *m, scree_chart_line *line)
{
    const double *strain = scree_series_get(&run->series, "axial_strain");
    const double mean = scree_plot_result(run, "mu"), half = scree_plot_result(run, "mu_error");
    m->x[0] = 100 * scree_plot_result(run, "mu_from");
    m->x[1] = strain ? 100 * strain[run->first_row + run->row_count - 1] : NAN;
    if (run->path.label) // `mu_from` counts in the last stage
        for (int k = 0; k < 2; k++) m->x[k] += 100 * run->path.strain[run->first_row];
    for (int k = 0; k < 2; k++) {
        m->y[k] = mean;
        m->low[k] = mean - half;
        m->high[k] = mean + half;
    }
    const int length = snprintf(m->label, sizeof m->label, "steady mean %.3g", mean);
    *line = (scree_chart_line){.x = m->x, .y = m->y, .count = 2, .label = m->label, .colour = VERMILLION};
    if (isfinite(half)) {
        (void)snprintf(m->label + length, sizeof m->label - (size_t)length, " ± %.2g (95 %%)", half);
        line->low = m->low;
        line->high = m->high;
    }
    return isfinite(mean);
}

/// Whether there is something to mark: `line` is that, with its values in *m.
static bool add_mark(const scree_plot_run *run, const chart_row *row, mark *m, scree_chart_line *line)
{
    if (row->mark == PEAK) return mark_peak(run, row, m, line);
    return row->mark == STEADY && mark_steady(run, m, line);
}

/// The volume was kept: all that is left of its strain is rounding.
static bool keeps_volume(const scree_plot_run *run, const chart_row *row)
{
    const double *strain = scree_series_get(&run->series, "volumetric_strain_solid");
    if (strcmp(row->figure.name, "volumetric-strain") != 0 || !strain || run->row_count == 0) return false;
    for (size_t k = run->path.rows.first; k < run->path.rows.last; k++)
        if (isfinite(run->path.strain[k]) && !(fabs(strain[k]) < SAME_VOLUME)) return false;
    return true;
}

/// A sample that was sheared has no ratio of axial to lateral stress that would say something, one that was not has no
/// friction, and one whose volume was kept has no volumetric strain.
static bool is_meant(const scree_plot_run *run, const scree_figure *figure)
{
    const chart_row *row = (const chart_row *)figure;
    if (row->mark == PEAK && run->of_cell && isfinite(scree_plot_result(run, "mu"))) return false;
    if (row->mark == STEADY && run->of_cell && scree_plot_result(run, "shear_strain_reached") == 0) return false;
    if (keeps_volume(run, row)) return false;
    return !run->series_status && (run->of_cell || !row->of_cell);
}

static scree_status has_columns(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    const char *column = ((const chart_row *)job->figure)->curve[0].column;
    if (run->row_count == 0)
        return scree_error_set(error, SCREE_ERROR_INPUT, "%s has no rows of a loading stage", SCREE_FILE_SERIES);
    if (scree_series_get(&run->series, column)) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "%s has no column '%s'", SCREE_FILE_SERIES, column);
}

static scree_status draw(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    const chart_row *row = (const chart_row *)job->figure;
    char label[128], strain[96];
    double *value = NULL;
    scree_chart_line line[CURVES + 1];
    mark marked;
    scree_status status = scree_allocate(&value, (CURVES + 1) * rows_of(run), sizeof *value, error);
    if (status) return status;
    if (run->path.label)
        (void)snprintf(strain, sizeof strain, "%s", run->path.label);
    else
        (void)snprintf(strain, sizeof strain, "%s (%%)", scree_strain_name(run->of_cell));
    size_t count = gather_curves(run, row, value, line);
    double *first = value + rows_of(run);
    double scale = scree_plot_label(label, sizeof label, row->y_label, scree_plot_largest(first, count * rows_of(run)));
    for (size_t k = 0; k < count * rows_of(run); k++) first[k] *= scale;
    count += add_mark(run, row, &marked, &line[count]);
    scree_chart chart = {.title = row->title,
                         .x_label = strain,
                         .y_label = label,
                         .line = line,
                         .line_count = count,
                         .log_y = row->log_y};
    status = scree_chart_draw(job->path, &chart, error);
    scree_release(&value);
    return status;
}

const scree_figure_family scree_figures_charts = {
    SCREE_FIGURE_ROWS(rows),
    .meant = is_meant,
    .applies = has_columns,
    .draw = draw,
};
