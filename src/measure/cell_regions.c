/// Where in a sample a cell lies: near the plates, near the sides, or in the core (P figs. 3.10, 3.11 compare these).
///
/// With h the height of a cell's centre, from 0 at the lowest grain to 1 at the highest: near the plates are h < 1/8
/// and h > 7/8. Between them the sample is cut into SLICES slices, and u is the distance of a centre from the middle of
/// its slice over half of the extent of the slice's centres (the larger of both directions in 3D), so that sides may
/// bulge: near the sides are u > 3/4, the core is u < 1/2 with 1/4 < h < 3/4. Cost: O(cells).
#include "measure/cells.h"

#include <math.h>

#define END 0.125

enum { SLICES = 12 };

/// Extent of the centres of each slice.
typedef struct slices {
    double low[SLICES][3], high[SLICES][3];
    double bottom, height;
} slices;

static void find_height(const scree_cells *cells, const double *position, slices *s)
{
    double low = INFINITY, high = -INFINITY;
    int nodes = cells->dimension + 1;
    for (size_t k = 0; k < cells->count * (size_t)nodes; k++) {
        double at = position[3 * cells->node[k / (size_t)nodes][k % (size_t)nodes] + (size_t)cells->dimension - 1];
        low = fmin(low, at);
        high = fmax(high, at);
    }
    s->bottom = low;
    s->height = high - low;
}

static size_t slice_of(double h)
{
    return (size_t)fmax(0, fmin(SLICES - 1, floor(SLICES * (h - END) / (1 - 2 * END))));
}

static void find_slices(const scree_cells *cells, const double *position, slices *s)
{
    scree_vector at;
    find_height(cells, position, s);
    for (int i = 0; i < 3 * SLICES; i++) {
        s->low[i / 3][i % 3] = INFINITY;
        s->high[i / 3][i % 3] = -INFINITY;
    }
    for (size_t k = 0; k < cells->count; k++) {
        scree_cell_centre(cells, k, position, at);
        size_t slice = slice_of((at[cells->dimension - 1] - s->bottom) / s->height);
        for (int i = 0; i < 3; i++) {
            s->low[slice][i] = fmin(s->low[slice][i], at[i]);
            s->high[slice][i] = fmax(s->high[slice][i], at[i]);
        }
    }
}

static scree_cell_region region_of(const slices *s, int dimension, const scree_vector at)
{
    double h = (at[dimension - 1] - s->bottom) / s->height, u = 0;
    if (h < END || h > 1 - END) return SCREE_REGION_PLATES;
    size_t slice = slice_of(h);
    for (int i = 0; i < dimension - 1; i++) {
        double low = s->low[slice][i], high = s->high[slice][i];
        u = fmax(u, fabs(2 * at[i] - low - high) / (high - low));
    }
    if (u > 0.75) return SCREE_REGION_SIDES;
    return u < 0.5 && h > 0.25 && h < 0.75 ? SCREE_REGION_CORE : SCREE_REGION_ELSEWHERE;
}

void scree_cells_region_means(const scree_cells *cells, const double *position, const double *value,
                              double mean[SCREE_REGION_COUNT])
{
    slices s;
    scree_vector at;
    double volume[SCREE_REGION_COUNT] = {0};
    find_slices(cells, position, &s);
    for (int r = 0; r < SCREE_REGION_COUNT; r++) mean[r] = 0;
    for (size_t k = 0; k < cells->count; k++) {
        scree_cell_centre(cells, k, position, at);
        scree_cell_region region = region_of(&s, cells->dimension, at);
        volume[region] += cells->volume[k];
        mean[region] += cells->volume[k] * value[k];
    }
    for (int r = 0; r < SCREE_REGION_COUNT; r++) mean[r] /= volume[r];
}
