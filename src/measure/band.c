/// The slab that fits a field best: least squares with one mean inside and another outside.
///
/// With total volume V, mean m and variance s^2 (over the volume), a slab with volume v and sum q = int g dV explains
///     R^2 = (q - v m)^2 / (v (V - v)) V / (V^2 s^2 / V) = V (q - v m)^2 / (v (V - v)) / (V^2 s^2)
/// of the variance, and is a band when q > v m. For a direction n the cells are sorted into bins of n . x; prefix sums
/// then give R^2 of every interval of bins. Directions are scanned every DEGREES, and around the best one more finely.
/// Edges of the slab lie at bin edges: the thickness is exact to one bin. Sides of a real band are not sharp; the edges
/// of the best slab lie where the field passes half its height. Cost: directions x (cells + bins^2 / 2).
#include "measure/localisation.h"

#include <math.h>
#include <string.h>

#define DEGREES 4.0
/// The same where only the size of the best fit is asked for.
#define COARSE 10.0
/// A slab holds at least this part of the volume, so that a corner of the sample is no band.
#define LEAST_VOLUME 0.02
/// The thickest slab, as a part of the extent of the sample along its normal: 1 / THICKEST.
#define THICKEST 3
#define RADIAN   (M_PI / 180)

typedef struct fit {
    const scree_cells *cells;
    double *at; ///< cells x 3, m, centres from the centre of volume
    const double *value;
    double volume, sum, variance;  ///< V, V m, V s^2
    double thinnest, step, radius; ///< m
    double *bin_volume, *bin_sum;  ///< prefix sums
    size_t bins;
    scree_band best;
} fit;

static void use_direction(fit *f, const scree_vector n)
{
    const double *at = f->at;
    memset(f->bin_volume, 0, (f->bins + 1) * sizeof *f->bin_volume);
    memset(f->bin_sum, 0, (f->bins + 1) * sizeof *f->bin_sum);
    for (size_t k = 0; k < f->cells->count; k++, at += 3) {
        size_t bin = (size_t)((n[0] * at[0] + n[1] * at[1] + n[2] * at[2] + f->radius) / f->step);
        f->bin_volume[bin + 1] += f->cells->volume[k];
        f->bin_sum[bin + 1] += f->cells->volume[k] * f->value[k];
    }
    size_t first = f->bins, last = 0;
    for (size_t b = 0; b < f->bins; b++) {
        if (f->bin_volume[b + 1] > 0) last = b + 1;
        if (f->bin_volume[b + 1] > 0 && first == f->bins) first = b;
        f->bin_volume[b + 1] += f->bin_volume[b];
        f->bin_sum[b + 1] += f->bin_sum[b];
    }
    size_t thinnest = (size_t)ceil(f->thinnest / f->step), thickest = (last - first) / THICKEST;
    for (size_t from = first; from < last; from++)
        for (size_t to = from + thinnest; to <= last && to - from <= thickest; to++) {
            double v = f->bin_volume[to] - f->bin_volume[from], q = f->bin_sum[to] - f->bin_sum[from];
            double excess = q - v * f->sum / f->volume, rest = f->volume - v;
            if (!(excess > 0) || v < LEAST_VOLUME * f->volume || !(rest > 0)) continue;
            double explained = f->volume * excess * excess / (v * rest) / f->variance;
            if (!(explained > f->best.explained)) continue;
            f->best = (scree_band){.offset = 0.5 * f->step * (double)(from + to) - f->radius,
                                   .thickness = f->step * (double)(to - from),
                                   .volume_fraction = v / f->volume,
                                   .share = q / f->sum,
                                   .contrast = q / v / ((f->sum - q) / rest),
                                   .explained = explained};
            memcpy(f->best.normal, n, sizeof f->best.normal);
        }
}

/// Directions over half a turn, or half a sphere (rings of equal steps).
static void scan_all(fit *f, double degrees)
{
    if (f->cells->dimension == 2) {
        for (double a = 0; a < 180; a += degrees)
            use_direction(f, (const scree_vector){cos(a * RADIAN), sin(a * RADIAN), 0});
        return;
    }
    for (double polar = 0; polar <= 90; polar += degrees) {
        int count = (int)fmax(1, round(360 * sin(polar * RADIAN) / degrees));
        for (int k = 0; k < count; k++) {
            double around = 2 * M_PI * k / count, side = sin(polar * RADIAN);
            use_direction(f, (const scree_vector){side * cos(around), side * sin(around), cos(polar * RADIAN)});
        }
    }
}

/// Directions around the best one so far, a step of `degrees` to every side.
static void scan_around(fit *f, double degrees)
{
    scree_vector n, tangent[2] = {{0}};
    memcpy(n, f->best.normal, sizeof n);
    int axis = fabs(n[2]) < 0.9 ? 2 : 0;
    for (int i = 0; i < 3; i++) tangent[0][i] = (i == axis) - n[axis] * n[i];
    for (int i = 0; i < 3; i++)
        tangent[1][i] = n[(i + 1) % 3] * tangent[0][(i + 2) % 3] - n[(i + 2) % 3] * tangent[0][(i + 1) % 3];
    int solid = f->cells->dimension == 3;
    for (int a = -solid; a <= solid; a++)
        for (int b = -1; b <= 1; b++) {
            scree_vector turned;
            for (int i = 0; i < 3; i++)
                turned[i] =
                    n[i] + degrees * RADIAN * (a * tangent[0][i] + b * tangent[1][i]) / scree_length(tangent[0]);
            double length = scree_length(turned);
            for (int i = 0; i < 3; i++) turned[i] /= length;
            if (a != 0 || b != 0) use_direction(f, turned);
        }
}

/// Centres, moments of the field, and room for the bins.
static scree_status prepare(fit *f, const double *position, scree_error *error)
{
    const scree_cells *cells = f->cells;
    scree_vector centre = {0};
    scree_status status = scree_allocate(&f->at, 3 * cells->count, sizeof *f->at, error);
    if (status) return status;
    for (size_t k = 0; k < cells->count; k++) {
        scree_cell_centre(cells, k, position, f->at + 3 * k);
        f->volume += cells->volume[k];
        f->sum += cells->volume[k] * f->value[k];
        for (size_t i = 0; i < 3; i++) centre[i] += cells->volume[k] * f->at[3 * k + i];
    }
    for (size_t k = 0; k < cells->count; k++) {
        double apart = f->value[k] - f->sum / f->volume;
        f->variance += cells->volume[k] * apart * apart;
        for (size_t i = 0; i < 3; i++) f->at[3 * k + i] -= centre[i] / f->volume;
        f->radius = fmax(f->radius, scree_length(f->at + 3 * k));
    }
    // A sample of extreme slenderness gets wider bins rather than more than a thousand.
    f->step = fmax(f->step, 2 * f->radius / 1000);
    f->radius += f->step / 2;
    f->bins = (size_t)(2 * f->radius / f->step) + 1;
    status = scree_allocate(&f->bin_volume, f->bins + 1, sizeof *f->bin_volume, error);
    return status ? status : scree_allocate(&f->bin_sum, f->bins + 1, sizeof *f->bin_sum, error);
}

/// Turns the normal so that its last component is positive, and says the angle to the axial direction.
static void finish(scree_band *band, int dimension)
{
    int last = dimension - 1;
    while (last > 0 && !(fabs(band->normal[last]) > 1e-12)) last--;
    if (band->normal[last] < 0) {
        for (int i = 0; i < 3; i++) band->normal[i] = -band->normal[i];
        band->offset = -band->offset;
    }
    band->angle = asin(fmin(1, fabs(band->normal[dimension - 1]))) / RADIAN;
}

scree_status scree_band_fit(const scree_cells *cells, const double *position, const double *value, double thinnest,
                            double step, bool fine, scree_band *band, scree_error *error)
{
    fit f = {.cells = cells, .value = value, .thinnest = thinnest, .step = step};
    *band = (scree_band){.normal = {1}};
    scree_status status = prepare(&f, position, error);
    if (!status && f.variance > 0) {
        scan_all(&f, fine ? DEGREES : COARSE);
        for (double degrees = DEGREES / 2; fine && degrees >= 0.25; degrees /= 2) {
            scan_around(&f, degrees);
            scan_around(&f, degrees);
        }
        if (f.best.explained > 0) *band = f.best;
    }
    finish(band, cells->dimension);
    scree_release(&f.at);
    scree_release(&f.bin_volume);
    scree_release(&f.bin_sum);
    return status;
}
