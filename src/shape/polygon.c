/// Measures of convex polygons, and what is wrong with a list of corners.
#include "shape/polygon.h"

#include "shape/side.h"

static double cross(const double a[2], const double b[2])
{
    return a[0] * b[1] - a[1] * b[0];
}

static double distance(const double a[2], const double b[2])
{
    return hypot(a[0] - b[0], a[1] - b[1]);
}

// ---- measures -----------------------------------------------------------------------------------------------------

/// Edge k as seen from `origin`.
static double edge_from(int count, const double (*corner)[2], const double origin[2], int k, double a[2], double b[2])
{
    int next = k + 1 < count ? k + 1 : 0;
    for (int i = 0; i < 2; i++) {
        a[i] = corner[k][i] - origin[i];
        b[i] = corner[next][i] - origin[i];
    }
    return cross(a, b);
}

double scree_polygon_area(int count, const double (*corner)[2])
{
    double twice = 0, a[2], b[2];
    for (int k = 1; k + 1 < count; k++) twice += edge_from(count, corner, corner[0], k, a, b);
    return twice / 2;
}

double scree_polygon_width(int count, const double (*corner)[2])
{
    double width = INFINITY;
    for (int k = 0; k < count; k++) {
        const double *a = corner[k], *b = corner[(k + 1) % count];
        const double x = b[0] - a[0], y = b[1] - a[1];
        double most = 0;
        for (int c = 0; c < count; c++) most = fmax(most, x * (corner[c][1] - a[1]) - y * (corner[c][0] - a[0]));
        width = fmin(width, most / hypot(x, y));
    }
    return width;
}

scree_polygon_measures scree_polygon_measure(int count, const double (*corner)[2])
{
    scree_polygon_measures m = {.area = scree_polygon_area(count, corner)};
    double a[2], b[2], sum[2] = {0, 0};
    for (int k = 1; k + 1 < count; k++) {
        double z = edge_from(count, corner, corner[0], k, a, b);
        for (int i = 0; i < 2; i++) sum[i] += (a[i] + b[i]) * z;
    }
    for (int i = 0; i < 2; i++) m.centroid[i] = corner[0][i] + sum[i] / (6 * m.area);
    // Moments about the centroid itself: those about the first corner would have to be shifted, with a difference.
    for (int k = 0; k < count; k++) {
        double z = edge_from(count, corner, m.centroid, k, a, b);
        m.moment[0] += z * (a[1] * a[1] + a[1] * b[1] + b[1] * b[1]) / 12;
        m.moment[1] += z * (a[0] * a[0] + a[0] * b[0] + b[0] * b[0]) / 12;
        m.moment[2] += z * (a[0] * a[1] + b[0] * b[1] + (a[0] + b[0]) * (a[1] + b[1])) / 24;
        m.bound = fmax(m.bound, hypot(a[0], a[1]));
    }
    m.radius = sqrt(fabs(m.area) / M_PI);
    return m;
}

void scree_polygon_place(int count, const double (*corner)[2], const double position[2], double angle,
                         double (*placed)[2])
{
    scree_polygon_turn(count, corner, cos(angle), sin(angle), placed);
    for (int k = 0; k < count; k++)
        for (int i = 0; i < 2; i++) placed[k][i] += position[i];
}

// ---- check --------------------------------------------------------------------------------------------------------

/// Two edges that share no corner and cross; false: none do.
static bool find_crossing(int count, const double (*corner)[2], int edge[2])
{
    for (int k = 0; k < count; k++)
        for (int l = k + 2; l < count - (k == 0); l++) {
            const double *a = corner[k], *b = corner[k + 1], *c = corner[l], *d = corner[(l + 1) % count];
            bool parted = (scree_side(a, b, c) > 0) != (scree_side(a, b, d) > 0);
            if (!parted || (scree_side(c, d, a) > 0) == (scree_side(c, d, b) > 0)) continue;
            edge[0] = k;
            edge[1] = l;
            return true;
        }
    return false;
}

/// Two corners nearer to each other than `least`.
static bool find_repeated(int count, const double (*corner)[2], double least, int pair[2])
{
    for (int k = 0; k < count; k++)
        for (int l = k + 1; l < count; l++)
            if (!(distance(corner[k], corner[l]) > least)) {
                pair[0] = k;
                pair[1] = l;
                return true;
            }
    return false;
}

/// Height of corner k over the line through its neighbours [m]: positive where the outline turns left.
static double height(int count, const double (*corner)[2], int k)
{
    const double *before = corner[(k + count - 1) % count], *after = corner[(k + 1) % count];
    return scree_side(before, corner[k], after) / distance(before, after);
}

static scree_status check_turns(int count, const double (*corner)[2], double least, scree_error *error)
{
    bool clockwise = scree_polygon_area(count, corner) < 0;
    for (int k = 0; k < count; k++) {
        double out = height(count, corner, k);
        if (!(fabs(out) > least))
            return scree_error_set(error, SCREE_ERROR_INPUT,
                                   "corner %d (from 0) lies on the line through its neighbours, or within %g m of it: "
                                   "leave it out, or move it by more than %g of the polygon's extent",
                                   k, fabs(out), SCREE_POLYGON_FLAT);
        if ((out < 0) != clockwise)
            return scree_error_set(error, SCREE_ERROR_INPUT,
                                   "the polygon is not convex at corner %d (from 0), which lies %g m inside the line "
                                   "through its neighbours; only convex polygons can be used",
                                   k, fabs(out));
    }
    if (!clockwise) return SCREE_OK;
    return scree_error_set(
        error, SCREE_ERROR_INPUT,
        "the corners go clockwise (area %g m2; from corner 0 on every corner turns right): list them in "
        "the opposite order",
        scree_polygon_area(count, corner));
}

scree_status scree_polygon_check(int count, const double (*corner)[2], scree_error *error)
{
    if (count < 3 || count > SCREE_POLYGON_CORNERS)
        return scree_error_set(error, SCREE_ERROR_INPUT, "a polygon has 3 to %d corners, not %d", SCREE_POLYGON_CORNERS,
                               count);
    double extent = 0;
    for (int k = 0; k < count; k++) {
        if (!isfinite(corner[k][0]) || !isfinite(corner[k][1]))
            return scree_error_set(error, SCREE_ERROR_INPUT, "corner %d (from 0) is (%g, %g): not a position", k,
                                   corner[k][0], corner[k][1]);
        extent = fmax(extent, distance(corner[k], corner[0]));
    }
    int pair[2];
    if (find_repeated(count, corner, SCREE_POLYGON_FLAT * extent, pair))
        return scree_error_set(
            error, SCREE_ERROR_INPUT,
            "corners %d and %d (from 0) are the same, or nearer to each other than %g of the polygon's "
            "extent: leave one out",
            pair[0], pair[1], SCREE_POLYGON_FLAT);
    if (find_crossing(count, corner, pair))
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "the outline crosses itself: the edges that begin at corners %d and %d (from 0) cross",
                               pair[0], pair[1]);
    return check_turns(count, corner, SCREE_POLYGON_FLAT * extent, error);
}
