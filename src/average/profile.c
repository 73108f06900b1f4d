/// Numbers of cuts, and mirror images.
#include "average/profile.h"

#include "average/relation.h"

#include <math.h>
#include <string.h>

#define CORE         0.25
#define FLANK        0.5
#define BESIDE       0.45
#define LEAST_INSIDE 0.5

// ---- regions -----------------------------------------------------------------------------------------------------

typedef struct reading {
    const scree_average_table *cuts;
    size_t points, place, inside;
} reading;

/// Mean of a column over the elements of the lowest cut whose distance from the axis is from `near` to `far`.
static double mean_between(const reading *r, size_t column, double near, double far, double least)
{
    double sum = 0, n = 0;
    for (size_t row = 0; row < r->points; row++) {
        const double at = fabs(scree_average_table_get(r->cuts, row, r->place));
        const double value = scree_average_table_get(r->cuts, row, column);
        if (at < near || at > far || !isfinite(value)) continue;
        if (scree_average_table_get(r->cuts, row, r->inside) < least) continue;
        sum += value;
        n++;
    }
    return n > 0 ? sum / n : NAN;
}

static void tell_density(const reading *r, scree_average_sink *sink, void *user)
{
    const size_t whole = scree_average_table_find(r->cuts, "volume_fraction");
    const size_t inside = scree_average_table_find(r->cuts, "volume_fraction_parts_inside");
    if (whole == SIZE_MAX) return;
    const double core = mean_between(r, whole, 0, CORE, 0), flank = mean_between(r, whole, FLANK, 1, LEAST_INSIDE);
    sink(user, "density_core", "1", core);
    sink(user, "density_flank", "1", flank);
    sink(user, "density_excess", "1", core / flank - 1);
    sink(user, "density_inside_excess", "1",
         mean_between(r, inside, 0, CORE, 0) / mean_between(r, inside, FLANK, 1, LEAST_INSIDE) - 1);
}

static void tell_pressure(const reading *r, scree_average_sink *sink, void *user)
{
    const size_t column = scree_average_table_find(r->cuts, "vertical_pressure_scaled");
    double apart = 0, whole = 0;
    if (column == SIZE_MAX) return;
    for (size_t j = 0; j < r->points; j++) {
        const double here = scree_average_table_get(r->cuts, j, column);
        const double there = scree_average_table_get(r->cuts, r->points - 1 - j, column);
        apart += 0.5 * (here - there) * (here - there);
        whole += here * here;
    }
    sink(user, "pressure_axis", "1", scree_average_table_get(r->cuts, r->points / 2, column));
    sink(user, "pressure_beside", "1", mean_between(r, column, CORE, BESIDE, 0));
    sink(user, "pressure_fluctuation", "1", sqrt(apart / whole));
}

/// Angle between two axes, 0 to 90 degrees.
static double between(double a, double b)
{
    return fabs(remainder(a - b, 180));
}

/// Mean angle between two axes over the elements that lie half inside; of the second SIZE_MAX: the horizontal, in the
/// core.
static double tilt(const reading *r, const char *first, size_t second)
{
    const size_t column = scree_average_table_find(r->cuts, first);
    double sum = 0, n = 0;
    if (column == SIZE_MAX) return NAN;
    for (size_t row = 0; row < r->points; row++) {
        const double a = scree_average_table_get(r->cuts, row, column);
        const double b = second == SIZE_MAX ? 0 : scree_average_table_get(r->cuts, row, second);
        if (!isfinite(a) || !isfinite(b) || scree_average_table_get(r->cuts, row, r->inside) < LEAST_INSIDE) continue;
        if (second == SIZE_MAX && fabs(scree_average_table_get(r->cuts, row, r->place)) > CORE) continue;
        sum += between(a, b);
        n++;
    }
    return n > 0 ? sum / n : NAN;
}

/// The same between the axis of the largest pressure and that of a tensor in space.
static double tilt_in_space(const reading *r, const char *tensor)
{
    double sum = 0, n = 0;
    for (size_t row = 0; row < r->points; row++) {
        const double apart = scree_average_axes_apart(r->cuts, row, "stress", -1, tensor);
        if (!isfinite(apart) || scree_average_table_get(r->cuts, row, r->inside) < LEAST_INSIDE) continue;
        sum += apart;
        n++;
    }
    return n > 0 ? sum / n : NAN;
}

static void tell_axes(const reading *r, scree_average_sink *sink, void *user)
{
    const size_t order = scree_average_table_find(r->cuts, "axes_order");
    static const char *const beside[][3] = {{"pressure_fabric_tilt", "fabric_angle", "fabric"},
                                            {"pressure_normals_tilt", "normals_angle", "normals"},
                                            {"pressure_axes_tilt", "axes_angle", "axes"}};
    const bool in_space = scree_average_table_find(r->cuts, "z") != SIZE_MAX;
    const bool pressed = scree_average_table_find(r->cuts, "pressure_angle") != SIZE_MAX;
    if (order != SIZE_MAX) {
        sink(user, "long_axis_tilt", "degree", tilt(r, "long_axis_angle", SIZE_MAX));
        sink(user, "axes_tilt", "degree", tilt(r, "axes_angle", SIZE_MAX));
        sink(user, "axes_order_core", "1", mean_between(r, order, 0, CORE, 0));
    }
    for (size_t k = 0; k < sizeof beside / sizeof *beside && pressed; k++) {
        const size_t column = scree_average_table_find(r->cuts, beside[k][1]);
        if (column == SIZE_MAX) continue;
        sink(user, beside[k][0], "degree",
             in_space ? tilt_in_space(r, beside[k][2]) : tilt(r, "pressure_angle", column));
    }
}

void scree_average_profile_tell(const scree_average_table *cuts, size_t points, scree_average_sink *sink, void *user)
{
    const reading r = {cuts, points, scree_average_table_find(cuts, "place"), scree_average_table_find(cuts, "inside")};
    if (cuts->rows < points || r.place == SIZE_MAX || r.inside == SIZE_MAX) return;
    tell_density(&r, sink, user);
    tell_pressure(&r, sink, user);
    tell_axes(&r, sink, user);
}

// ---- forces ------------------------------------------------------------------------------------------------------

void scree_average_profile_forces(const scree_average_view *view, scree_average_sink *sink, void *user)
{
    const scree_average_sample *sample = view->sample;
    const int up = sample->dimension - 1;
    double sum[2] = {0, 0}, count[2] = {0, 0};
    for (size_t c = 0; c < sample->contacts; c++) {
        const scree_average_contact *contact = &sample->contact[c];
        const double away = fabs(contact->point[0] - view->frame.axis) / view->frame.half;
        const int region = away <= 0.1 ? 0 : away >= 0.2 && away <= 0.5 ? 1 : -1;
        if (region < 0 || !(contact->normal_force > 0)) continue;
        if (contact->point[up] - view->frame.base > 0.5 * view->frame.height) continue;
        sum[region] += contact->normal_force;
        count[region]++;
    }
    sink(user, "force_core_ratio", "1", sum[0] / count[0] / (sum[1] / count[1]));
}

// ---- mirror images -----------------------------------------------------------------------------------------------

/// What a mirror does to a column.
typedef enum parity { EVEN, ODD, AXIS } parity;

/// A component with one x: "_xy" at the end of a name or before another "_".
static bool is_mixed(const char *name)
{
    for (const char *at = strchr(name, '_'); at; at = strchr(at + 1, '_')) {
        if (!at[1] || !strchr("xyz", at[1]) || !at[2] || !strchr("xyz", at[2])) continue;
        if (at[3] == 0 || at[3] == '_') return (at[1] == 'x') != (at[2] == 'x');
    }
    return false;
}

static parity parity_of(const scree_average_table *cuts, const char *name)
{
    const size_t length = strlen(name);
    const bool plane = scree_average_table_find(cuts, "z") == SIZE_MAX; // else angles are elevations
    if (length > 6 && strcmp(name + length - 6, "_angle") == 0) return plane ? AXIS : EVEN;
    if (length > 2 && strcmp(name + length - 2, "_x") == 0) return ODD;
    return is_mixed(name) ? ODD : EVEN;
}

static double mean_axis(double a, double b)
{
    const double cosine = cos(a * M_PI / 90) + cos(b * M_PI / 90), sine = sin(a * M_PI / 90) + sin(b * M_PI / 90);
    return atan2(sine, cosine) * 90 / M_PI;
}

void scree_average_profile_mirror(scree_average_table *cuts, size_t points)
{
    for (size_t k = 0; k < cuts->columns; k++) {
        const char *name = cuts->column[k].name;
        const parity p = parity_of(cuts, name);
        if (strcmp(name, "x") == 0 || strcmp(name, "place") == 0) continue;
        for (size_t row = 0; row < cuts->rows; row++) {
            const size_t j = row % points, other = row - j + points - 1 - j;
            if (other < row) continue;
            double *here = &cuts->value[row * cuts->columns + k], *there = &cuts->value[other * cuts->columns + k];
            const double image = p == EVEN ? *there : -*there;
            // What one side alone has is the mean of both.
            const double both = !isfinite(*here)   ? image
                                : !isfinite(image) ? *here
                                : p == AXIS        ? mean_axis(*here, image)
                                                   : 0.5 * (*here + image);
            *here = both;
            *there = p == EVEN ? both : -both;
        }
    }
}
