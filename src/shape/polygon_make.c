/// Polygons on an ellipse and regular ones.
#include "shape/polygon_make.h"

#include "base/random.h"

#include <math.h>
#include <stdlib.h>

/// Draws before an ellipse is given up. Sectors are refused with a probability below 1e-6, three free corners with
/// 1e-3.
enum { DRAWS = 64 };

void scree_polygon_fit(int count, double radius, double (*corner)[2])
{
    scree_polygon_measures m = scree_polygon_measure(count, (const double(*)[2])corner);
    double scale = radius / m.radius;
    for (int k = 0; k < count; k++)
        for (int i = 0; i < 2; i++) corner[k][i] = scale * (corner[k][i] - m.centroid[i]);
}

void scree_polygon_make_regular(int count, double radius, double (*corner)[2])
{
    for (int k = 0; k < count; k++) {
        corner[k][0] = cos(2 * M_PI * k / count);
        corner[k][1] = sin(2 * M_PI * k / count);
    }
    scree_polygon_fit(count, radius, corner);
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

scree_status scree_polygon_make_on_ellipse(uint64_t seed, uint64_t id, int count, double axes,
                                           scree_polygon_scatter scatter, double radius, double (*corner)[2],
                                           scree_error *error)
{
    if (count < 3 || count > SCREE_POLYGON_CORNERS || !(axes >= 1) || !(radius > 0))
        return scree_error_set(
            error, SCREE_ERROR_INPUT,
            "a polygon on an ellipse has 3 to %d corners, a ratio of axes of 1 or more and a radius above "
            "0, not %d, %g and %g m",
            SCREE_POLYGON_CORNERS, count, axes, radius);
    double angle[SCREE_POLYGON_CORNERS];
    scree_status status = SCREE_ERROR_INPUT;
    for (uint64_t draw = 0; draw < DRAWS && status; draw++) {
        for (int k = 0; k < count; k++) {
            uint64_t counter = (id * DRAWS + draw) * SCREE_POLYGON_CORNERS + (uint64_t)k;
            double u = scree_random_uniform(seed, SCREE_RANDOM_CORNER, counter);
            angle[k] = 2 * M_PI * (scatter == SCREE_POLYGON_SECTORS ? (k + u) / count : u);
        }
        qsort(angle, (size_t)count, sizeof *angle, compare);
        for (int k = 0; k < count; k++) {
            corner[k][0] = sqrt(axes) * cos(angle[k]);
            corner[k][1] = sin(angle[k]) / sqrt(axes);
        }
        status = scree_polygon_check(count, (const double(*)[2])corner, NULL);
        const scree_polygon_measures m = scree_polygon_measure(count, (const double(*)[2])corner);
        if (m.bound > SCREE_POLYGON_REACH * sqrt(axes) * m.radius) status = SCREE_ERROR_INPUT;
    }
    if (status)
        return scree_error_set(
            error, SCREE_ERROR_INPUT,
            "an ellipse with axes of %g : 1 is too long for %d corners: none of %d draws gave a polygon "
            "whose corners stand out by %g of its extent",
            axes, count, DRAWS, SCREE_POLYGON_FLAT);
    scree_polygon_fit(count, radius, corner);
    return SCREE_OK;
}

int scree_polygon_draw_count(uint64_t seed, uint64_t id, int low, int high)
{
    return low + (int)(scree_random_uniform(seed, SCREE_RANDOM_CORNER_COUNT, id) * (high - low + 1));
}
