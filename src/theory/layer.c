#include "theory/layer.h"

#include <gsl/gsl_integration.h>

#include <math.h>

enum { PANEL = 16 }; ///< points of a panel
#define WIDEST  2.   ///< panel in h
#define TURNING 6.   ///< radians of the wave that a panel may hold
#define DECAY   60.  ///< h (2 - y / H) where nothing is left

/// Gauss's rule of three points on -1 to 1, weights of a mean.
static const double gauss_at[3] = {-0.774596669241483377, 0, 0.774596669241483377};
static const double gauss_weight[3] = {5. / 18, 8. / 18, 5. / 18};

scree_stress_2d scree_flamant_stress(double force, double x, double y)
{
    const double square = x * x + y * y;
    if (!(y > 0) || !(square > 0)) return (scree_stress_2d){0};
    const double c = 2 * force * y / (M_PI * square * square);
    return (scree_stress_2d){c * x * x, c * y * y, c * x * y};
}

// ---- transforms --------------------------------------------------------------------------------------------------

/// The potential's four numbers times exp(h).
typedef struct potential {
    double a, b, c, d;
} potential;

static potential potential_of(const scree_layer *layer, double h)
{
    const double small = exp(-2 * h), ch = 0.5 * (1 + small), sh = -0.5 * expm1(-2 * h), nu = layer->poisson;
    if (layer->base == SCREE_LAYER_SMOOTH) {
        const double below = sh * ch + h * small;
        return (potential){.a = -(sh + h * ch) / below, .d = sh / below};
    }
    const double below = h * h * small + (3 - 4 * nu) * ch * ch + (1 - 2 * nu) * (1 - 2 * nu) * small;
    const double d = (2 * (1 - nu) * ch + h * sh) / below, c = -(h * ch - (1 - 2 * nu) * sh) / below;
    return (potential){-2 * (1 - nu) * d, (1 - 2 * nu) * c, c, d};
}

/// Transform of the stress at depth y / H, less that of the half-space.
static scree_stress_2d transform(const scree_layer *layer, double h, double depth)
{
    const potential p = potential_of(layer, h);
    const double z = h * (1 - depth), ky = h * depth, far = exp(-ky);
    const double ch = 0.5 * (far + exp(ky - 2 * h)), sh = 0.5 * (far - exp(ky - 2 * h));
    const double value = p.a * ch + p.b * sh + p.c * z * ch + p.d * z * sh;
    const double first = p.a * sh + p.b * ch + p.c * (ch + z * sh) + p.d * (sh + z * ch);
    const double second = p.a * ch + p.b * sh + p.c * (2 * sh + z * ch) + p.d * (2 * ch + z * sh);
    return (scree_stress_2d){second - (1 - ky) * far, -value - (1 + ky) * far, -first - ky * far};
}

/// What a wave keeps in a mean with the weights of a hat that falls to 0 at `side` / H from its middle.
static double hat_keeps(double h, double side)
{
    const double half = 0.5 * h * side;
    return half > 1e-4 ? pow(sin(half) / half, 2) : 1 - half * half / 3;
}

/// What the base adds to the half-space, times pi H / F, at x / H and y / H; side / H: of a hat along x, 0: at the
/// point. Holds a little below the base, too.
static scree_stress_2d base_adds(const scree_layer *layer, double x, double depth, double side,
                                 const gsl_integration_glfixed_table *table)
{
    const double end = DECAY / (2 - depth), width = fmin(WIDEST, TURNING / (fabs(x) + side));
    const long panels = (long)ceil(end / width);
    scree_stress_2d sum = {0};
    for (long k = 0; k < panels; k++)
        for (size_t i = 0; i < PANEL; i++) {
            double h, share;
            (void)gsl_integration_glfixed_point(end * (double)k / (double)panels,
                                                end * (double)(k + 1) / (double)panels, i, &h, &share, table);
            const scree_stress_2d part = transform(layer, h, depth);
            if (side > 0) share *= hat_keeps(h, side);
            sum.xx += share * cos(h * x) * part.xx;
            sum.yy += share * cos(h * x) * part.yy;
            sum.xy += share * sin(h * x) * part.xy;
        }
    return sum;
}

static scree_stress_2d stress_at(const scree_layer *layer, double x, double y,
                                 const gsl_integration_glfixed_table *table)
{
    scree_stress_2d stress = scree_flamant_stress(layer->force, x, y);
    if (layer->base == SCREE_LAYER_NONE) return stress;
    const scree_stress_2d more = base_adds(layer, x / layer->thickness, y / layer->thickness, 0, table);
    const double unit = layer->force / (M_PI * layer->thickness);
    return (scree_stress_2d){stress.xx + unit * more.xx, stress.yy + unit * more.yy, stress.xy + unit * more.xy};
}

static scree_status begin(gsl_integration_glfixed_table **table, scree_error *error)
{
    *table = gsl_integration_glfixed_table_alloc(PANEL);
    return *table ? SCREE_OK : scree_error_set_memory(error, PANEL * sizeof(double));
}

scree_status scree_layer_stress(const scree_layer *layer, double x, double y, scree_stress_2d *stress,
                                scree_error *error)
{
    gsl_integration_glfixed_table *table;
    *stress = (scree_stress_2d){0};
    if (!(y >= 0) || (layer->base != SCREE_LAYER_NONE && y > layer->thickness)) return SCREE_OK;
    scree_status status = begin(&table, error);
    if (status) return status;
    *stress = stress_at(layer, x, y, table);
    gsl_integration_glfixed_table_free(table);
    return SCREE_OK;
}

/// The part of the half-space.
static scree_stress_2d flamant_mean(const scree_layer *layer, double x, double y, double side)
{
    scree_stress_2d mean = {0};
    for (int k = 0; k < 6; k++) {
        const double across = (k < 3 ? -0.5 : 0.5) + 0.5 * gauss_at[k % 3];
        const scree_stress_2d stress = scree_flamant_stress(layer->force, x + side * across, y);
        const double share = gauss_weight[k % 3] * (1 - fabs(across));
        mean.xx += share * stress.xx;
        mean.yy += share * stress.yy;
        mean.xy += share * stress.xy;
    }
    return mean;
}

scree_status scree_layer_mean(const scree_layer *layer, double x, double y, double side, scree_stress_2d *mean,
                              scree_error *error)
{
    const double thickness = layer->thickness, unit = layer->force / (M_PI * thickness);
    gsl_integration_glfixed_table *table;
    *mean = (scree_stress_2d){0};
    scree_status status = begin(&table, error);
    if (status) return status;
    for (int k = 0; k < 3; k++) {
        const bool based = layer->base != SCREE_LAYER_NONE;
        const double depth = fmin(y + 0.5 * side * gauss_at[k], based ? thickness : INFINITY);
        scree_stress_2d stress = flamant_mean(layer, x, depth, side), more = {0};
        if (based && depth >= 0) more = base_adds(layer, x / thickness, depth / thickness, side / thickness, table);
        mean->xx += gauss_weight[k] * (stress.xx + unit * more.xx);
        mean->yy += gauss_weight[k] * (stress.yy + unit * more.yy);
        mean->xy += gauss_weight[k] * (stress.xy + unit * more.xy);
    }
    gsl_integration_glfixed_table_free(table);
    return SCREE_OK;
}

scree_status scree_layer_half_width(const scree_layer *layer, double y, double *width, scree_error *error)
{
    gsl_integration_glfixed_table *table;
    scree_status status = begin(&table, error);
    if (status) return status;
    const double half = 0.5 * stress_at(layer, 0, y, table).yy;
    double low = 0, high = 4 * y;
    for (int k = 0; k < 60; k++) {
        const double middle = 0.5 * (low + high);
        *(stress_at(layer, middle, y, table).yy > half ? &low : &high) = middle;
    }
    *width = 0.5 * (low + high);
    gsl_integration_glfixed_table_free(table);
    return SCREE_OK;
}

// ---- residuals ---------------------------------------------------------------------------------------------------

/// Central differences of twelfth order over steps of `step` in one direction: first and second derivative. With steps
/// of 1/50 of the depth what they leave out is some 1e-15, and what rounding leaves 1e-14 and 1e-12.
static void differences(const scree_layer *layer, double x, double y, bool along_x, double step,
                        const gsl_integration_glfixed_table *table, scree_stress_2d *first, scree_stress_2d *second)
{
    static const double one[] = {0, 6. / 7, -15. / 56, 5. / 63, -1. / 56, 1. / 385, -1. / 5544};
    static const double two[] = {-5369. / 1800, 12. / 7, -15. / 56, 10. / 189, -1. / 112, 2. / 1925, -1. / 16632};
    const scree_stress_2d here = stress_at(layer, x, y, table);
    *first = (scree_stress_2d){0};
    *second = (scree_stress_2d){two[0] * here.xx, two[0] * here.yy, two[0] * here.xy};
    for (int k = 1; k <= 6; k++)
        for (int sign = -1; sign <= 1; sign += 2) {
            const double by = sign * k * step;
            const scree_stress_2d s = stress_at(layer, along_x ? x + by : x, along_x ? y : y + by, table);
            first->xx += sign * one[k] * s.xx, first->yy += sign * one[k] * s.yy, first->xy += sign * one[k] * s.xy;
            second->xx += two[k] * s.xx, second->yy += two[k] * s.yy, second->xy += two[k] * s.xy;
        }
    first->xx /= step, first->yy /= step, first->xy /= step;
    second->xx /= step * step, second->yy /= step * step, second->xy /= step * step;
}

static void examine_point(const scree_layer *layer, double x, double y, const gsl_integration_glfixed_table *table,
                          scree_layer_check *check)
{
    const double step = 0.02 * y, unit = stress_at(layer, 0, y, table).yy / y;
    scree_stress_2d dx, dy, dxx, dyy;
    differences(layer, x, y, true, step, table, &dx, &dxx);
    differences(layer, x, y, false, step, table, &dy, &dyy);
    const double balance = fmax(fabs(dx.xx + dy.xy), fabs(dx.xy + dy.yy)) / unit;
    const double bent = fabs(dxx.xx + dxx.yy + dyy.xx + dyy.yy) * y / unit;
    check->equilibrium = fmax(check->equilibrium, balance);
    check->compatibility = fmax(check->compatibility, bent);
}

/// Without shear, or without strain along the base; and (1 - nu) d_y sigma_xx - nu d_y sigma_yy = 2 d_x sigma_xy, which
/// is d_x v = 0.
static void examine_base(const scree_layer *layer, double x, const gsl_integration_glfixed_table *table,
                         scree_layer_check *check)
{
    const double height = layer->thickness, nu = layer->poisson, step = 0.02 * height;
    const scree_stress_2d s = stress_at(layer, x, height, table);
    scree_stress_2d dx, dy, unused;
    differences(layer, x, height, true, step, table, &dx, &unused);
    differences(layer, x, height, false, step, table, &dy, &unused);
    const double along = layer->base == SCREE_LAYER_SMOOTH ? s.xy : (1 - nu) * s.xx - nu * s.yy;
    const double up = ((1 - nu) * dy.xx - nu * dy.yy - 2 * dx.xy) * height;
    check->base = fmax(check->base, fmax(fabs(along), fabs(up)) * height / layer->force);
}

/// Trapezoids over x = H tan(angle), which is exact for the half-space; a layer falls exponentially, at the slowest as
/// exp(-0.74 x / H): bonded, with a Poisson's ratio of 1/2.
static double force_on_base(const scree_layer *layer, const gsl_integration_glfixed_table *table)
{
    enum { STEPS = 200 };
    double sum = 0;
    for (int k = -STEPS + 1; k < STEPS; k++) {
        const double angle = M_PI_2 * k / STEPS, x = layer->thickness * tan(angle);
        // Beyond this nothing is left of a layer, and waves would need ever more panels.
        if (layer->base != SCREE_LAYER_NONE && fabs(x) > 50 * layer->thickness) continue;
        sum += stress_at(layer, x, layer->thickness, table).yy / (cos(angle) * cos(angle));
    }
    return sum * M_PI_2 / STEPS * layer->thickness;
}

scree_status scree_layer_examine(const scree_layer *layer, scree_layer_check *check, scree_error *error)
{
    gsl_integration_glfixed_table *table;
    *check = (scree_layer_check){0};
    scree_status status = begin(&table, error);
    if (status) return status;
    const double height = layer->thickness;
    for (int i = -6; i <= 6; i++) {
        for (int j = 1; j <= 5; j++) examine_point(layer, 0.25 * i * height, 0.18 * j * height, table, check);
        if (layer->base != SCREE_LAYER_NONE) examine_base(layer, 0.25 * i * height, table, check);
        if (i == 0) continue;
        const scree_stress_2d top = stress_at(layer, 0.25 * i * height, 0, table);
        check->surface = fmax(check->surface, fmax(fabs(top.yy), fabs(top.xy)) * height / layer->force);
    }
    check->force = force_on_base(layer, table) / layer->force - 1;
    gsl_integration_glfixed_table_free(table);
    return SCREE_OK;
}
