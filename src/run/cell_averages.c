/// Circles and regions are averaged over the snapshots in the first strain window of measure.windows (P: 7 - 8.5 %);
/// cells and sample are compared over the whole stage.
///
/// Strain: between two consecutive snapshots, at x and x + u, the mean gradient of the cells on the middle
/// configuration x + u/2, weighted with their volumes there. Sums over them are logarithmic strains up to the square of
/// their distance, as those of the boundary in series.csv are. The boundary is renewed between snapshots while the
/// cells stay, or stays while they are others, and this is what makes them differ (400 spheres, 10 % of strain, a hull
/// renewed 230 times, 15, 120 and 500 snapshots: 2.6, 0.09, 0.80 %; between two renewals round-off). At each snapshot
/// the cells are others, which is no strain: with V of a snapshot's own cells and V' of those of the one before, as
/// they have come there,
///     log V(last) / V(first) = trace of the sum + sum of log (V / V'),
/// to third order in the increments, as of the boundary (measure/strain.c); the left side depends on two instants
/// alone. Stress: means over the same instants.
#include "run/cell_averages.h"

#include <math.h>

/// P shades cells of more than so many mean pressures (fig. 3.11).
#define STRONG 1.75
/// And of more than so many mean distortions (fig. 3.10).
#define DEFORMED 2.0
/// A circle has the pressure of the sample when it differs from it by less.
#define CONVERGED 0.1
/// Instants in series.csv and run.h5 are the same bits but for the printed digits.
#define SAME_TIME 1e-9

void scree_cell_averages_begin(scree_cell_averages *averages, const scree_config_measure *config,
                               const scree_series *series)
{
    bool window = config->window_count > 0;
    *averages = (scree_cell_averages){.series = series,
                                      .from = window ? config->windows[0].from : 0,
                                      .to = window ? config->windows[0].to : INFINITY,
                                      .begin = NAN,
                                      .end = NAN};
}

// ---- the sample in series.csv ------------------------------------------------------------------------------------

static double column_at(const scree_series *series, const char *name, double time)
{
    const double *times = scree_series_get(series, "time"), *values = scree_series_get(series, name);
    double found = NAN;
    // At the border of two stages there are two rows with the same time: the later one belongs to the later stage.
    for (size_t k = 0; times && values && k < series->row_count; k++)
        if (fabs(times[k] - time) <= SAME_TIME * fabs(time)) found = values[k];
    return found;
}

/// Normal components, compression positive, of x, y, z from those of the series.
static void normal_components(const scree_series *series, int dimension, double time, const char *const name[3],
                              double normal[3])
{
    double lateral = column_at(series, name[0], time), second = lateral;
    if (dimension == 3 && name[1]) second = column_at(series, name[1], time);
    normal[0] = 2 * lateral - second;
    normal[1] = dimension == 3 ? second : column_at(series, name[2], time);
    normal[2] = dimension == 3 ? column_at(series, name[2], time) : 0;
}

// ---- adding ------------------------------------------------------------------------------------------------------

/// How far the circles of one size are from the pressure of the sample; those without cells do not count.
static double departure(const double *ratio, size_t count, size_t size, double *square, double *used)
{
    double largest = 0;
    for (size_t p = 0; p < SCREE_CIRCLES; p++) {
        double away = ratio[p * count + size] - 1;
        if (isnan(away)) continue;
        *square += away * away;
        *used += 1;
        largest = fmax(largest, fabs(away));
    }
    return largest;
}

/// Root mean square of ratio - 1, and the least diameter from which on no circle leaves CONVERGED: the largest one when
/// there is none.
static void follow_circles(scree_cell_averages *averages, const double *ratio, size_t count)
{
    double square = 0, used = 0;
    bool inside = true;
    size_t converged = count;
    for (size_t size = count; size-- > 0;) {
        inside = departure(ratio, count, size, &square, &used) < CONVERGED && inside;
        if (inside) converged = size + 1;
        if (size + 1 != SCREE_CIRCLE_WIDE || !(used > 0)) continue;
        averages->wide += sqrt(square / used);
        averages->wide_instants++;
    }
    averages->spread += sqrt(square / used);
    averages->diameter += (double)converged;
}

static void add_stress(scree_cell_averages *averages, const scree_cell_snapshot *snapshot)
{
    static const char *const name[3] = {"stress_lateral_contacts", NULL, "stress_axial_contacts"};
    const scree_cells *cells = &snapshot->cells;
    double volume = 0, normal[3];
    for (size_t k = 0; k < cells->count; k++) volume += cells->volume[k];
    for (size_t k = 0; k < cells->count; k++)
        for (int c = 0; c < 9; c++) averages->cell_stress[c] += cells->volume[k] / volume * cells->stress[k][c];
    if (!averages->series) return;
    normal_components(averages->series, cells->dimension, snapshot->time, name, normal);
    for (int i = 0; i < 3; i++) averages->sample_stress[4 * i] -= normal[i];
}

/// Adds the share of the volume of each region that has more than `factor` times the mean of a field.
static scree_status add_shares(const scree_cells *cells, const double *position, const double *field, double factor,
                               double sum[SCREE_REGION_COUNT], scree_error *error)
{
    double *above = NULL, share[SCREE_REGION_COUNT], mean = scree_cells_mean(cells, field);
    scree_status status = scree_allocate(&above, cells->count, sizeof *above, error);
    if (status) return status;
    for (size_t k = 0; k < cells->count; k++) above[k] = field[k] > factor * mean;
    scree_cells_region_means(cells, position, above, share);
    for (int r = 0; r < SCREE_REGION_COUNT; r++) sum[r] += share[r];
    scree_release(&above);
    return SCREE_OK;
}

scree_status scree_cell_averages_add(scree_cell_averages *averages, const scree_cell_snapshot *snapshot,
                                     const double *ratio, size_t count, scree_error *error)
{
    const scree_cells *cells = &snapshot->cells;
    add_stress(averages, snapshot);
    if (!(snapshot->axial_strain >= averages->from && snapshot->axial_strain <= averages->to)) return SCREE_OK;
    double distortion[SCREE_REGION_COUNT], pressure[SCREE_REGION_COUNT];
    scree_cells_region_means(cells, snapshot->assembly.position, cells->distortion, distortion);
    scree_cells_region_means(cells, snapshot->assembly.position, cells->pressure, pressure);
    for (int r = 0; r < SCREE_REGION_COUNT; r++) {
        averages->distortion[r] += distortion[r];
        averages->pressure[r] += pressure[r];
    }
    follow_circles(averages, ratio, count);
    averages->instants++;
    const double *position = snapshot->assembly.position;
    scree_status status = add_shares(cells, position, cells->pressure, STRONG, averages->strong, error);
    if (!status) status = add_shares(cells, position, cells->distortion, DEFORMED, averages->deformed, error);
    return status;
}

/// Volume of all cells with their nodes at `position`, without a thickness.
static double volume_at(const scree_cells *cells, const double *position)
{
    double volume = 0;
    for (size_t k = 0; k < cells->count; k++) volume += scree_cell_volume_at(cells, k, position);
    return volume;
}

/// What the new cells of the second snapshot change in the volume.
static void add_renewal(scree_cell_averages *averages, const scree_cell_snapshot *first,
                        const scree_cell_snapshot *second)
{
    const double come = volume_at(&first->cells, second->assembly.position);
    averages->last_volume = volume_at(&second->cells, second->assembly.position);
    averages->renewed += log(averages->last_volume / come);
}

scree_status scree_cell_averages_strain(scree_cell_averages *averages, const scree_cell_snapshot *first,
                                        const scree_cell_snapshot *second, scree_error *error)
{
    const scree_cells *cells = &first->cells;
    size_t n = 3 * first->assembly.count;
    double *middle = NULL, (*gradient)[9] = NULL, volume = 0, sum[9] = {0};
    scree_status status = scree_allocate(&middle, 2 * n, sizeof *middle, error);
    if (!status) status = scree_allocate(&gradient, cells->count, sizeof *gradient, error);
    if (!status) {
        double *moved = middle + n;
        for (size_t i = 0; i < n; i++) {
            moved[i] = second->assembly.position[i] - first->assembly.position[i];
            middle[i] = first->assembly.position[i] + 0.5 * moved[i];
        }
        scree_cells_gradient(cells, middle, moved, gradient);
        for (size_t k = 0; k < cells->count; k++) {
            double part = scree_cell_volume_at(cells, k, middle);
            volume += part;
            for (int c = 0; c < 9; c++) sum[c] += part * gradient[k][c];
        }
        for (int c = 0; c < 9; c++) averages->cell_strain[c] += sum[c] / volume;
        if (isnan(averages->begin)) {
            averages->begin = first->time;
            averages->first_volume = volume_at(cells, first->assembly.position);
        }
        add_renewal(averages, first, second);
        averages->end = second->time;
    }
    scree_release(&gradient);
    scree_release(&middle);
    return status;
}

// ---- summary -----------------------------------------------------------------------------------------------------

/// Difference of the normal components over the size of the second.
static double disagreement(const double first[9], const double second[9])
{
    double apart = 0, size = 0;
    for (int i = 0; i < 3; i++) {
        apart = hypot(apart, first[4 * i] - second[4 * i]);
        size = hypot(size, second[4 * i]);
    }
    return apart / size;
}

static void compare_with_sample(const scree_cell_averages *averages, int dimension, scree_summary *summary)
{
    static const char *const name[3] = {"boundary_lateral_strain", "boundary_lateral_strain_y",
                                        "boundary_axial_strain"};
    double begin[3], end[3], strain[9] = {0}, stress[9];
    for (int c = 0; c < 9; c++) stress[c] = averages->cell_stress[c];
    // The sample knows one lateral stress in 3D.
    if (dimension == 3) stress[0] = stress[4] = 0.5 * (stress[0] + stress[4]);
    double apart = disagreement(stress, averages->sample_stress);
    if (isfinite(apart)) scree_summary_set_number(summary, "cell_stress_disagreement", apart);
    if (isnan(averages->begin)) return;
    normal_components(averages->series, dimension, averages->begin, name, begin);
    normal_components(averages->series, dimension, averages->end, name, end);
    for (int i = 0; i < 3; i++) strain[4 * i] = begin[i] - end[i];
    apart = disagreement(averages->cell_strain, strain);
    if (isfinite(apart)) scree_summary_set_number(summary, "cell_strain_disagreement", apart);
}

/// Compression positive, as the volumetric strains of the boundary.
static void tell_volume(const scree_cell_averages *averages, scree_summary *summary)
{
    if (isnan(averages->begin)) return;
    const double *strain = averages->cell_strain;
    const double enclosed = -log(averages->last_volume / averages->first_volume);
    scree_summary_set_number(summary, "cell_volumetric_strain", -(strain[0] + strain[4] + strain[8]));
    scree_summary_set_number(summary, "cell_volumetric_strain_renewed", -averages->renewed);
    scree_summary_set_number(summary, "cell_volumetric_strain_enclosed", enclosed);
}

void scree_cell_averages_summarise(const scree_cell_averages *averages, int dimension, scree_summary *summary)
{
    tell_volume(averages, summary);
    if (averages->series) compare_with_sample(averages, dimension, summary);
    if (!(averages->instants > 0)) return;
    double instants = averages->instants, core = averages->pressure[SCREE_REGION_CORE];
    scree_summary_set_number(summary, "circle_pressure_spread", averages->spread / instants);
    scree_summary_set_number(summary, "circle_pressure_diameter", averages->diameter / instants);
    scree_summary_set_number(summary, "plate_distortion_ratio",
                             averages->distortion[SCREE_REGION_PLATES] / averages->distortion[SCREE_REGION_CORE]);
    scree_summary_set_number(summary, "plate_pressure_ratio", averages->pressure[SCREE_REGION_PLATES] / core);
    scree_summary_set_number(summary, "side_pressure_ratio", averages->pressure[SCREE_REGION_SIDES] / core);
    scree_summary_set_number(summary, "plate_strong_share", averages->strong[SCREE_REGION_PLATES] / instants);
    scree_summary_set_number(summary, "side_strong_share", averages->strong[SCREE_REGION_SIDES] / instants);
    scree_summary_set_number(summary, "core_strong_share", averages->strong[SCREE_REGION_CORE] / instants);
    scree_summary_set_number(summary, "plate_deformed_share", averages->deformed[SCREE_REGION_PLATES] / instants);
    scree_summary_set_number(summary, "core_deformed_share", averages->deformed[SCREE_REGION_CORE] / instants);
    if (averages->wide_instants > 0)
        scree_summary_set_number(summary, "circle_pressure_spread_wide", averages->wide / averages->wide_instants);
}
