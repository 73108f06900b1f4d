/// Localisation of the distortion of one strain window: index, significance, and the band.
///
/// Single cells scatter: their distortion has long tails even in a sample that deforms evenly. So the field is smoothed
/// over the Delaunay graph first (PASSES, about one and a half diameters), and what remains is compared with RANDOM
/// fields that have the same values at random cells, smoothed in the same way: a field without any spatial order. The
/// index is significant when it exceeds theirs by SIGNIFICANT standard deviations.
///
/// A band is found when the distortion is localised, the slab that explains most of its variance (band.c) does so well
/// (EXPLAINED) and much better than in any random field (CLEARLY), and holds at least CONTRAST times the distortion
/// outside, as means over the volume. Its active cells are those
/// above the mean of the two means; its percolation is the part of the length of the slab that a connected set of them
/// spans, in 3D in the worse of two directions.
///
/// These limits are decisions; tests/unit/test_localisation.c says what they do to planted bands and to noise.
#include "measure/localisation.h"

#include "base/random.h"

#include <math.h>
#include <string.h>

enum { PASSES = 8, RANDOM = 19 };
#define SIGNIFICANT 4.0
#define LOCALISED   0.2
#define CONTRAST    2.0
#define EXPLAINED   0.2
#define CLEARLY     1.5
/// In mean diameters: the thinnest band that is looked for, and the bins of the search.
#define THINNEST 3.0
#define BIN      0.5

/// Values of the cells to bodies.
static void to_bodies(const scree_cells *cells, const scree_node_cells *list, const double *value, double *body)
{
    for (size_t i = 0; i < cells->bodies; i++) {
        double sum = 0, volume = 0;
        for (uint32_t k = list->begin[i]; k < list->begin[i + 1]; k++) {
            sum += cells->volume[list->cell[k]] * value[list->cell[k]];
            volume += cells->volume[list->cell[k]];
        }
        body[i] = sum / volume;
    }
}

scree_status scree_cells_smooth(const scree_cells *cells, const scree_node_cells *list, int passes, double *value,
                                double *body, scree_error *error)
{
    double *own = NULL;
    scree_status status = body ? SCREE_OK : scree_allocate(&own, cells->bodies, sizeof *own, error);
    if (status) return status;
    if (!body) body = own;
    int nodes = cells->dimension + 1;
    for (int pass = 0; pass < passes; pass++) {
        to_bodies(cells, list, value, body);
        for (size_t k = 0; k < cells->count; k++) {
            double sum = 0;
            for (int n = 0; n < nodes; n++) sum += body[cells->node[k][n]];
            value[k] = sum / nodes;
        }
    }
    scree_release(&own);
    return SCREE_OK;
}

double scree_localisation_index(const scree_cells *cells, const double *value)
{
    double volume = 0, sum = 0, square = 0;
    for (size_t k = 0; k < cells->count; k++) {
        volume += cells->volume[k];
        sum += cells->volume[k] * value[k];
        square += cells->volume[k] * value[k] * value[k];
    }
    return square > 0 ? fmax(0, 1 - sum * sum / (volume * square)) : 0;
}

/// The values at random cells (Fisher and Yates).
static void shuffle(double *value, size_t count, uint64_t round)
{
    for (size_t k = count; k-- > 1;) {
        size_t other = (size_t)(scree_random_uniform(round, SCREE_RANDOM_SHUFFLE, k) * (double)(k + 1));
        double old = value[k];
        value[k] = value[other];
        value[other] = old;
    }
}

/// Index and best band of fields with the same values at random cells.
static scree_status measure_random(const scree_cells *cells, const scree_node_cells *list, const double *position,
                                   const double *distortion, double diameter, double *scratch, scree_localisation *out,
                                   scree_error *error)
{
    double sum = 0, square = 0;
    scree_status status = SCREE_OK;
    out->explained_random = 0;
    memcpy(scratch, distortion, cells->count * sizeof *scratch);
    double *field = scratch + cells->count;
    for (int k = 0; k < RANDOM && !status; k++) {
        scree_band band;
        shuffle(scratch, cells->count, (uint64_t)k);
        memcpy(field, scratch, cells->count * sizeof *field);
        status = scree_cells_smooth(cells, list, PASSES, field, NULL, error);
        if (status) break;
        double index = scree_localisation_index(cells, field);
        sum += index;
        square += index * index;
        status = scree_band_fit(cells, position, field, THINNEST * diameter, BIN * diameter, false, &band, error);
        out->explained_random = fmax(out->explained_random, band.explained);
    }
    double variance = (square - sum * sum / RANDOM) / (RANDOM - 1);
    out->index_random = sum / RANDOM;
    out->significance = variance > 0 ? (out->index - out->index_random) / sqrt(variance) : 0;
    return status;
}

/// Where a place lies in the slab: along the normal from its middle.
static double height_in(const scree_band *band, const scree_vector centre, const double *position)
{
    double along = -band->offset;
    for (int i = 0; i < 3; i++) along += band->normal[i] * (position[i] - centre[i]);
    return along;
}

static void centre_of_volume(const scree_cells *cells, const double *position, scree_vector centre)
{
    double volume = 0;
    centre[0] = centre[1] = centre[2] = 0;
    for (size_t k = 0; k < cells->count; k++) {
        scree_vector at;
        scree_cell_centre(cells, k, position, at);
        volume += cells->volume[k];
        for (int i = 0; i < 3; i++) centre[i] += cells->volume[k] * at[i];
    }
    for (int i = 0; i < 3; i++) centre[i] /= volume;
}

/// Two unit vectors in the plane of the band; in 2D the second is zero.
static void span_of(const scree_band *band, int dimension, scree_vector tangent[2])
{
    const double *n = band->normal;
    memset(tangent, 0, 2 * sizeof(scree_vector));
    if (dimension == 2) {
        tangent[0][0] = -n[1];
        tangent[0][1] = n[0];
        return;
    }
    int axis = fabs(n[0]) < fabs(n[1]) ? 0 : 1;
    if (fabs(n[2]) < fabs(n[axis])) axis = 2;
    double norm = sqrt(1 - n[axis] * n[axis]);
    for (int i = 0; i < 3; i++) tangent[0][i] = ((i == axis) - n[axis] * n[i]) / norm;
    for (int i = 0; i < 3; i++)
        tangent[1][i] = n[(i + 1) % 3] * tangent[0][(i + 2) % 3] - n[(i + 2) % 3] * tangent[0][(i + 1) % 3];
}

/// Extents along the two tangents.
typedef struct reach {
    double low[2], high[2];
} reach;

static const reach nothing = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};

static void reach_extend(reach *r, scree_vector tangent[2], const scree_vector at)
{
    for (int t = 0; t < 2; t++) {
        double along = tangent[t][0] * at[0] + tangent[t][1] * at[1] + tangent[t][2] * at[2];
        r->low[t] = fmin(r->low[t], along);
        r->high[t] = fmax(r->high[t], along);
    }
}

/// Reach of the active cells connected with `first`, which are struck off.
static reach flood(const scree_cells *cells, const double *position, scree_vector tangent[2], uint8_t *active,
                   uint32_t *queue, uint32_t first)
{
    size_t queued = 0;
    reach r = nothing;
    queue[queued++] = first;
    active[first] = 0;
    for (size_t head = 0; head < queued; head++) {
        scree_vector at;
        scree_cell_centre(cells, queue[head], position, at);
        reach_extend(&r, tangent, at);
        for (int n = 0; n <= cells->dimension; n++) {
            int32_t behind = cells->neighbour[queue[head]][n];
            if (behind < 0 || !active[behind]) continue;
            active[behind] = 0;
            queue[queued++] = (uint32_t)behind;
        }
    }
    return r;
}

static scree_status measure_percolation(const scree_cells *cells, const double *position, const double *field,
                                        scree_band *band, scree_error *error)
{
    scree_vector tangent[2], centre, at;
    uint8_t *active = NULL;
    uint32_t *queue = NULL;
    scree_status status = scree_allocate(&active, cells->count, 1, error);
    if (!status) status = scree_allocate(&queue, cells->count, sizeof *queue, error);
    double inside = band->share / band->volume_fraction, outside = (1 - band->share) / (1 - band->volume_fraction);
    double limit = (inside + outside) / 2 * scree_cells_mean(cells, field);
    reach whole = nothing;
    centre_of_volume(cells, position, centre);
    span_of(band, cells->dimension, tangent);
    for (size_t k = 0; k < cells->count && !status; k++) {
        scree_cell_centre(cells, k, position, at);
        if (fabs(height_in(band, centre, at)) > band->thickness / 2) continue;
        reach_extend(&whole, tangent, at);
        active[k] = field[k] > limit;
    }
    band->percolation = 0;
    for (size_t k = 0; k < cells->count && !status; k++) {
        if (!active[k]) continue;
        reach part = flood(cells, position, tangent, active, queue, (uint32_t)k);
        double least = 1;
        for (int t = 0; t < cells->dimension - 1; t++)
            least = fmin(least, (part.high[t] - part.low[t]) / (whole.high[t] - whole.low[t]));
        band->percolation = fmax(band->percolation, least);
    }
    scree_release(&active);
    scree_release(&queue);
    return status;
}

/// Marks the bodies inside a band that is found.
static void mark_bodies(const scree_cells *cells, const double *position, const scree_band *band, uint8_t *in_band)
{
    scree_vector centre;
    centre_of_volume(cells, position, centre);
    for (size_t i = 0; i < cells->bodies; i++)
        in_band[i] = band->found && fabs(height_in(band, centre, position + 3 * i)) <= band->thickness / 2;
}

scree_status scree_localisation_measure(const scree_cells *cells, const double *position, const double *distortion,
                                        double diameter, scree_localisation *out, double *body_field, uint8_t *in_band,
                                        scree_error *error)
{
    scree_node_cells list = {0};
    double *field = NULL, *scratch = NULL;
    *out = (scree_localisation){.mean_distortion = scree_cells_mean(cells, distortion)};
    scree_status status = scree_node_cells_build(cells, &list, error);
    if (!status) status = scree_allocate(&field, cells->count, sizeof *field, error);
    if (!status) status = scree_allocate(&scratch, 2 * cells->count, sizeof *scratch, error);
    if (!status) {
        memcpy(field, distortion, cells->count * sizeof *field);
        status = scree_cells_smooth(cells, &list, PASSES, field, body_field, error);
    }
    if (!status) {
        out->index = scree_localisation_index(cells, field);
        status = measure_random(cells, &list, position, distortion, diameter, scratch, out, error);
    }
    scree_band *band = &out->band;
    if (!status)
        status = scree_band_fit(cells, position, field, THINNEST * diameter, BIN * diameter, true, band, error);
    if (!status) status = measure_percolation(cells, position, field, band, error);
    if (!status) {
        out->localised = out->index >= LOCALISED && out->significance >= SIGNIFICANT;
        band->found = band->explained >= EXPLAINED && band->explained > CLEARLY * out->explained_random &&
                      band->contrast >= CONTRAST;
        mark_bodies(cells, position, band, in_band);
    }
    scree_node_cells_destroy(&list);
    scree_release(&field);
    scree_release(&scratch);
    return status;
}
