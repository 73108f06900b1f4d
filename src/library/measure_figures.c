/// Figures of averages: cuts by height with bands, maps, distributions of forces and friction, roses.
#include "library/measure.h"

#include "io/run_directory.h"
#include "view/chart.h"
#include "view/displacements.h"
#include "view/force_figures.h"
#include "view/links.h"
#include "view/map.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define LEAST_INSIDE 0.2 /* elements of which less lies in the sample are left white */

/// A figure that has nothing to show is left out.
static scree_status forgive(scree_status status)
{
    return status == SCREE_ERROR_INPUT ? SCREE_OK : status;
}

size_t measure_spread(size_t count, size_t k)
{
    if (count <= MEASURE_LINES) return k;
    const size_t gaps = MEASURE_LINES - 1;
    return (2 * k * (count - 1) + gaps) / (2 * gaps); // the nearest one
}

void measure_title(char *title, size_t size, const char *text, size_t count)
{
    if (count > MEASURE_LINES)
        (void)snprintf(title, size, "%s (%d of %zu cuts)", text, MEASURE_LINES, count);
    else
        (void)snprintf(title, size, "%s", text);
}

// ---- cuts --------------------------------------------------------------------------------------------------------

/// A quantity of the cuts: its column in 2D (where a component ends in y, that of z in 3D), and sign for pressures,
/// which are tension positive in tables.
typedef struct cut_figure {
    const char *file, *column, *title, *label;
    double factor;
    double least; ///< of an element inside the sample, else it is left out
} cut_figure;

static const cut_figure cut_figures[] = {
    {"cuts-pressure-scaled", "vertical_pressure_scaled", "Vertical pressure by height",
     "vertical pressure / (bulk density g height)", 1, 0},
    {"cuts-stress-vertical", "stress_yy", "Vertical pressure by height", "vertical pressure (kPa)", -1e-3, 0},
    {"cuts-stress-horizontal", "stress_xx", "Horizontal pressure by height", "horizontal pressure (kPa)", -1e-3, 0},
    {"cuts-stress-shear", "stress_xy", "Shear stress by height", "shear stress (kPa)", 1e-3, 0},
    {"cuts-stress-change", "stress_change_yy", "Change of the vertical pressure by height",
     "change of the vertical pressure (kPa)", -1e-3, 0},
    {"cuts-density", "volume_fraction", "Volume fraction by height", "volume fraction of whole elements", 1, 0},
    {"cuts-density-inside", "volume_fraction_parts_inside", "Volume fraction by height, inside the surface",
     "volume fraction of the part inside", 1, 0},
    {"cuts-coordination", "coordination", "Contacts by height", "contacts per grain", 1, 0},
    {"cuts-fabric", "fabric_trace", "Trace of the fabric tensor by height", "tr F", 1, 0},
    {"cuts-fabric-anisotropy", "fabric_anisotropy", "Anisotropy of the fabric tensor by height", "deviator / trace", 1,
     0},
    {"cuts-fabric-angle", "fabric_angle", "Major axis of the fabric tensor by height", "angle (degrees)", 1, 0},
    {"cuts-long-axis", "long_axis_angle", "Long axis of the mean inertia tensor by height", "angle (degrees)", 1, 0},
    {"cuts-velocity", "velocity_x", "Horizontal velocity by height", "velocity x (m/s)", 1, 0},
    {"cuts-kinetic", "kinetic_yy", "Stress of the motion by height", "vertical pressure of the motion (Pa)", -1, 0},
    {"cuts-strain", "cambou_yy", "Vertical strain by height (Cambou)", "vertical strain, compression positive", -1, 0},
    {"cuts-bulk-modulus", "bulk_modulus", "Bulk modulus by height, elements more than half inside", "K (MPa)", 1e-6,
     0.5},
    {"cuts-shear-modulus", "shear_modulus", "Shear modulus by height, elements more than half inside", "G (MPa)", 1e-6,
     0.5},
    {"cuts-young-modulus", "young_modulus", "Young's modulus by height, elements more than half inside", "E (MPa)",
     1e-6, 0.5},
    {"cuts-poisson-ratio", "poisson_ratio", "Poisson's ratio by height, elements more than half inside", "nu", 1, 0.5},
};

/// The column of a figure; up is y in 2D and z in 3D.
static size_t find_column(const scree_average_table *table, const char *name)
{
    char upright[64];
    const size_t length = strlen(name);
    (void)snprintf(upright, sizeof upright, "%s", name);
    if (scree_average_table_find(table, "z") != SIZE_MAX && length > 3 && length < sizeof upright) {
        for (size_t k = length - 2; k < length; k++)
            if (upright[length - 3] == '_' && upright[k] == 'y') upright[k] = 'z';
    }
    return scree_average_table_find(table, upright);
}

/// Values of a column over the rows of a cut, times a factor; NULL when memory ran out.
static double *take(const scree_average_table *table, size_t column, size_t first, size_t count, double factor,
                    scree_error *error)
{
    double *value = NULL;
    if (scree_allocate(&value, count, sizeof *value, error)) return NULL;
    for (size_t k = 0; k < count; k++) value[k] = factor * scree_average_table_get(table, first + k, column);
    return value;
}

/// Makes values NAN whose elements lie in the sample by less than a part.
static void leave_out(const scree_average_table *cuts, size_t first, size_t count, double least, double *value)
{
    const size_t inside = scree_average_table_find(cuts, "inside");
    for (size_t k = 0; k < count && value && least > 0; k++)
        if (!(scree_average_table_get(cuts, first + k, inside) >= least)) value[k] = NAN;
}

/// Axes have no order: a line would run from one end of the scale to the other.
static bool is_angle(const cut_figure *figure)
{
    return strstr(figure->column, "_angle") != NULL;
}

/// x, value and the ends of the band along a cut; what is not there is NULL.
typedef struct cut_line {
    double *part[4];
    char label[32];
} cut_line;

static scree_status take_cut(const measure_plan *plan, const measure_found *found, const cut_figure *figure, size_t cut,
                             bool bands, cut_line *of, scree_error *error)
{
    const scree_average_table *cuts = &found->mean.of[MEASURE_CUTS];
    // A factor below zero exchanges the ends of the band.
    const measure_tables *ends[2] = {&found->low, &found->high}, *low = ends[figure->factor < 0],
                         *high = ends[figure->factor > 0];
    const size_t column = find_column(cuts, figure->column), n = plan->average.points, first = cut * n;
    of->part[0] = take(cuts, scree_average_table_find(cuts, "x"), first, n, 1e3, error);
    of->part[1] = take(cuts, column, first, n, figure->factor, error);
    if (bands) {
        of->part[2] = take(&low->of[MEASURE_CUTS], column, first, n, figure->factor, error);
        of->part[3] = take(&high->of[MEASURE_CUTS], column, first, n, figure->factor, error);
    }
    for (int i = 1; i < 4; i++) leave_out(cuts, first, n, figure->least, of->part[i]);
    (void)snprintf(of->label, sizeof of->label, "height %.2g", plan->average.height[cut]);
    const bool taken = of->part[0] && of->part[1] && (!bands || (of->part[2] && of->part[3]));
    return taken ? SCREE_OK : SCREE_ERROR_IO;
}

static scree_status draw_cuts(const char *folder, const measure_plan *plan, const measure_found *found,
                              const cut_figure *figure, scree_error *error)
{
    const scree_average_table *cuts = &found->mean.of[MEASURE_CUTS];
    const size_t all = plan->average.cuts, count = all < MEASURE_LINES ? all : MEASURE_LINES, n = plan->average.points;
    const bool bands = found->runs > 1 && found->low.of[MEASURE_CUTS].rows > 0 && !is_angle(figure);
    scree_chart_line line[MEASURE_LINES] = {{0}};
    cut_line of[MEASURE_LINES] = {{{NULL}, ""}};
    char path[PATH_MAX], title[160];
    if (find_column(cuts, figure->column) == SIZE_MAX || scree_average_table_find(cuts, "x") == SIZE_MAX)
        return SCREE_OK;
    scree_status status = scree_path_join(path, sizeof path, folder, figure->file, error);
    for (size_t k = 0; k < count && !status; k++) {
        status = take_cut(plan, found, figure, measure_spread(all, k), bands, &of[k], error);
        line[k] = (scree_chart_line){.x = of[k].part[0],
                                     .y = of[k].part[1],
                                     .low = of[k].part[2],
                                     .high = of[k].part[3],
                                     .count = n,
                                     .label = of[k].label,
                                     .points = n < 3 || is_angle(figure),
                                     .bare = is_angle(figure)};
    }
    measure_title(title, sizeof title, figure->title, all);
    const scree_chart chart = {
        .title = title, .x_label = "x from the axis (mm)", .y_label = figure->label, .line = line, .line_count = count};
    if (!status) status = forgive(scree_chart_draw(path, &chart, error));
    for (size_t k = 0; k < count; k++)
        for (int i = 0; i < 4; i++) scree_release(&of[k].part[i]);
    return status;
}

// ---- maps --------------------------------------------------------------------------------------------------------

typedef struct map_figure {
    int product;
    const char *file, *column, *title, *label;
    double factor;
    scree_colour_map colours;
    const char *axis;  ///< column of an angle [degree]; NULL: no lines
    const char *lines; ///< behind the title where they are drawn
} map_figure;

#define SEQUENTIAL SCREE_COLOUR_SEQUENTIAL
#define NO_LINES   NULL, NULL
static const map_figure map_figures[] = {
    {MEASURE_MAP, "map-density", "volume_fraction_parts_inside", "Volume fraction, exact parts inside the surface",
     "volume fraction", 1, SEQUENTIAL, NO_LINES},
    {MEASURE_MAP, "map-stress-vertical", "stress_yy_inside", "Vertical pressure inside", "vertical pressure (kPa)",
     -1e-3, SEQUENTIAL, "pressure_angle", ", and the axis of the largest one"},
    {MEASURE_MAP, "map-stress-horizontal", "stress_xx_inside", "Horizontal pressure inside",
     "horizontal pressure (kPa)", -1e-3, SEQUENTIAL, NO_LINES},
    {MEASURE_MAP, "map-stress-change", "stress_change_yy", "Change of the vertical pressure",
     "change of the vertical pressure (kPa)", -1e-3, SCREE_COLOUR_DIVERGING, NO_LINES},
    {MEASURE_MAP, "map-fabric", "fabric_trace_inside", "Trace of the fabric tensor inside", "tr F", 1, SEQUENTIAL,
     "fabric_angle", ", and its major axis"},
    {MEASURE_MAP, "map-long-axis", "axes_order", "Order of the long axes", "order (0 none, 1 all alike)", 1, SEQUENTIAL,
     "axes_angle", ", and their mean direction"},
    {MEASURE_MAP, "map-velocity", "velocity_x", "Horizontal velocity", "velocity x (m/s)", 1, SCREE_COLOUR_DIVERGING,
     NO_LINES},
    {MEASURE_MAP, "map-strain-vertical", "bagi_yy", "Vertical strain (cells), compression positive", "strain", -1,
     SCREE_COLOUR_DIVERGING, NO_LINES},
    {MEASURE_MAP, "map-displacement", "displacement_y", "Displacement in y since the earlier state",
     "displacement (um)", 1e6, SCREE_COLOUR_DIVERGING, NO_LINES},
    {MEASURE_MAP, "map-bulk-modulus", "bulk_modulus_inside", "Bulk modulus inside", "K (MPa)", 1e-6, SEQUENTIAL,
     NO_LINES},
    {MEASURE_KERNEL, "kernel-density", "volume_fraction", "Volume fraction, smooth", "volume fraction", 1, SEQUENTIAL,
     NO_LINES},
    {MEASURE_KERNEL, "kernel-stress-vertical", "stress_yy", "Vertical pressure, smooth", "vertical pressure (kPa)",
     -1e-3, SEQUENTIAL, NO_LINES},
    {MEASURE_KERNEL, "kernel-stress-horizontal", "stress_xx", "Horizontal pressure, smooth",
     "horizontal pressure (kPa)", -1e-3, SEQUENTIAL, NO_LINES},
    {MEASURE_KERNEL, "kernel-residual", "residual", "What is left of the balance of forces: round-off",
     "residual over the largest density g", 1, SEQUENTIAL, NO_LINES},
    {MEASURE_KERNEL, "kernel-bulk-modulus", "bulk_modulus", "Bulk modulus, smooth", "K (MPa)", 1e-6, SEQUENTIAL,
     NO_LINES},
    {MEASURE_KERNEL, "kernel-stress-shear", "stress_xy", "Shear stress, smooth", "shear stress (kPa)", 1e-3,
     SCREE_COLOUR_DIVERGING, NO_LINES},
};

/// Empty places are white: no grain counts there.
static void blank(const scree_average_table *table, double *value)
{
    const size_t inside = scree_average_table_find(table, "inside"), full = scree_average_table_find(table, "density");
    for (size_t k = 0; k < table->rows; k++) {
        const bool empty = inside != SIZE_MAX ? !(scree_average_table_get(table, k, inside) > LEAST_INSIDE)
                                              : !(scree_average_table_get(table, k, full) > 0);
        if (empty) value[k] = NAN;
    }
}

static scree_status draw_map(const char *folder, const measure_found *found, const map_figure *figure,
                             scree_error *error)
{
    const scree_average_table *table = &found->mean.of[figure->product];
    const size_t column = find_column(table, figure->column), n = table->rows;
    const size_t angle = figure->axis ? scree_average_table_find(table, figure->axis) : SIZE_MAX;
    char path[PATH_MAX], title[160];
    const size_t up = scree_average_table_find(table, "z") != SIZE_MAX ? 2 : 1;
    // Of spheres a section is drawn, and no block.
    if (n == 0 || column == SIZE_MAX ||
        (up == 2 && scree_average_table_get(table, 0, 1) != scree_average_table_get(table, n - 1, 1)))
        return SCREE_OK;
    size_t columns = 1;
    while (columns < n && scree_average_table_get(table, columns, up) == scree_average_table_get(table, 0, up))
        columns++;
    scree_map map = {
        .title = title, .name = figure->label, .columns = columns, .rows = n / columns, .colours = figure->colours};
    if (map.columns < 2 || map.rows < 2) return SCREE_OK;
    for (size_t i = 0; i < 2; i++) {
        const size_t along = i == 0 ? 0 : up;
        const double first = scree_average_table_get(table, 0, along);
        const double last = scree_average_table_get(table, n - 1, along);
        const double gap = (last - first) / (double)((i == 0 ? map.columns : map.rows) - 1);
        map.low[i] = first - 0.5 * gap;
        map.high[i] = last + 0.5 * gap;
    }
    double *value = take(table, column, 0, n, figure->factor, error);
    double *axis = angle == SIZE_MAX || up == 2 ? NULL : take(table, angle, 0, n, M_PI / 180, error);
    scree_status status = value ? scree_path_join(path, sizeof path, folder, figure->file, error) : SCREE_ERROR_IO;
    map.value = value;
    map.axis = axis;
    (void)snprintf(title, sizeof title, "%s%s", figure->title, axis ? figure->lines : "");
    if (!status) {
        blank(table, value);
        status = forgive(scree_map_draw(path, &map, error));
    }
    scree_release(&value);
    scree_release(&axis);
    return status;
}

// ---- forces ------------------------------------------------------------------------------------------------------

static scree_status draw_forces(const char *folder, const measure_found *found, scree_error *error)
{
    static const struct {
        const char *file;
        measure_product product;
        scree_status (*draw)(const char *path, const scree_average_table *table, scree_error *error);
    } figure[] = {{"force-distribution", MEASURE_FORCES, scree_draw_force_distribution},
                  {"friction-distribution", MEASURE_FRICTION, scree_draw_friction_distribution},
                  {"rose", MEASURE_ROSE, scree_draw_contact_rose}};
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < sizeof figure / sizeof *figure && !status; k++) {
        char path[PATH_MAX];
        status = scree_path_join(path, sizeof path, folder, figure[k].file, error);
        if (!status) status = forgive(figure[k].draw(path, &found->mean.of[figure[k].product], error));
    }
    return status;
}

/// From centre to centre, or to the point of contact with what is no body.
static scree_link link_of(const scree_average_sample *sample, const scree_average_contact *contact, bool marked)
{
    const double *x = sample->grain[contact->first].position;
    scree_link link = {.force = scree_length(contact->force) / sample->mean_force, .marked = marked};
    for (int k = 0; k < 2; k++) {
        link.from[k] = x[k];
        link.to[k] = x[k] - contact->branch[k];
    }
    return link;
}

scree_status measure_draw_network(const char *folder, const scree_average_sample *sample, const uint8_t *linked,
                                  scree_error *error)
{
    scree_link *link;
    char path[PATH_MAX];
    if (sample->dimension == 3 || sample->contacts == 0) return SCREE_OK;
    scree_status status = scree_folders_make(folder, error);
    if (!status) status = scree_path_join(path, sizeof path, folder, "chains", error);
    if (!status) status = scree_allocate(&link, sample->contacts, sizeof *link, error);
    if (status) return status;
    for (size_t c = 0; c < sample->contacts; c++) link[c] = link_of(sample, &sample->contact[c], linked[c]);
    const scree_links links = {.title = "Force network and its chains",
                               .marked_name = "in a chain of three grains or more",
                               .other_name = "other contacts; widths as forces",
                               .link = link,
                               .count = sample->contacts,
                               .width = 0.22 * sample->mean_radius};
    status = forgive(scree_links_draw(path, &links, error));
    scree_release(&link);
    return status;
}

scree_status measure_draw_displacements(const char *folder, const char *directory, size_t place,
                                        const scree_average_sample *sample, const scree_average_table *values,
                                        scree_error *error)
{
    char path[PATH_MAX];
    scree_snapshot from;
    const double axis = values->value[scree_average_table_find(values, "axis")];
    // As far beside the foot of a pile as its other figures show; grains may have rolled farther.
    const double half = 1.2 * values->value[scree_average_table_find(values, "half_width")];
    const double shown[2] = {axis - half, axis + half};
    scree_status status = scree_folders_make(folder, error);
    if (!status) status = scree_path_join(path, sizeof path, folder, "displacements", error);
    if (!status) status = scree_snapshot_read(directory, place, &from, error);
    if (status) return status;
    status = scree_displacements_draw(path, &from, sample, shown, error);
    scree_snapshot_destroy(&from);
    return status;
}

scree_status measure_draw(const char *folder, const measure_plan *plan, const measure_found *found, scree_error *error)
{
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < sizeof cut_figures / sizeof *cut_figures && !status; k++)
        status = draw_cuts(folder, plan, found, &cut_figures[k], error);
    for (size_t k = 0; k < sizeof map_figures / sizeof *map_figures && !status; k++)
        status = draw_map(folder, found, &map_figures[k], error);
    if (!status) status = draw_forces(folder, found, error);
    if (!status) status = measure_draw_sizes(folder, found, error);
    if (!status) status = measure_draw_response(folder, found, error);
    if (!status && found->fits)
        status = found->fits->layers ? measure_fit_layers_draw(folder, found->fits, error)
                                     : measure_fit_draw(folder, plan, found->fits, error);
    return status ? status : measure_draw_clouds(folder, plan, found, error);
}
