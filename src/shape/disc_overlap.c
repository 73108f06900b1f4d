/// Discs against discs and polygons.
#include "shape/disc_overlap.h"

#include <string.h>

// ---- caps ---------------------------------------------------------------------------------------------------------

/// x - sin x. Below 1 the series up to x^19, whose next term is 1e-19 of it; above, the difference loses a digit at
/// most.
static double angle_less_sine(double x)
{
    if (!(x < 1)) return x - sin(x);
    double square = x * x, sum = 1;
    for (int k = 18; k >= 4; k -= 2) sum = 1 - square / (k * (k + 1)) * sum;
    return x * square / 6 * sum;
}

double scree_disc_cap(double radius, double half, double away)
{
    return radius * radius / 2 * angle_less_sine(2 * atan2(half, away));
}

/// Directions of the outline of a disc about `centre` at both ends of the chord, seen from the first centre.
static void set_tangents(scree_overlap *overlap, int body, const double centre[2])
{
    for (int k = 0; k < 2; k++) {
        const double half = k == 0 ? -0.5 : 0.5;
        const double x[2] = {overlap->arm[0][0] - half * overlap->chord[1] - centre[0],
                             overlap->arm[0][1] + half * overlap->chord[0] - centre[1]};
        overlap->edge[k][body][0] = -x[1];
        overlap->edge[k][body][1] = x[0];
    }
}

static const double ORIGIN[2] = {0, 0};

// ---- two discs ----------------------------------------------------------------------------------------------------

/// One disc wholly inside the other. In one place and of one size, the second counts as the inner one.
static bool disc_inside(int inner, double radius, const double apart[2], scree_overlap *overlap)
{
    *overlap = (scree_overlap){.area = M_PI * radius * radius, .flags = SCREE_OVERLAP_INSIDE};
    if (inner == 1) memcpy(overlap->arm[0], apart, sizeof overlap->arm[0]);
    return true;
}

bool scree_disc_overlap(const double radius[2], const double apart[2], scree_overlap *overlap)
{
    double sum = radius[0] + radius[1], difference = radius[0] - radius[1], distance = hypot(apart[0], apart[1]);
    if (distance >= sum) return false;
    if (!(distance > fabs(difference))) {
        int inner = difference < 0 ? 0 : 1;
        disc_inside(inner, radius[inner], apart, overlap);
        scree_overlap_finish(overlap, apart, radius, radius);
        return true;
    }
    // Products and sums of two commute, so exchange of the discs changes no bit.
    double product = (sum - distance) * (sum + distance) * ((distance - difference) * (distance + difference));
    double half = sqrt(product) / (2 * distance), away[2];
    *overlap = (scree_overlap){.crossings = 2};
    for (int b = 0; b < 2; b++) away[b] = distance / 2 + (b == 0 ? difference : -difference) * sum / (2 * distance);
    overlap->area = scree_disc_cap(radius[0], half, away[0]) + scree_disc_cap(radius[1], half, away[1]);
    for (int i = 0; i < 2; i++) {
        overlap->chord[i] = 2 * half * (apart[i] / distance);
        overlap->arm[0][i] = away[0] * (apart[i] / distance);
        overlap->arm[1][i] = -away[1] * (apart[i] / distance);
    }
    double arm[2];
    memcpy(arm, overlap->arm[1], sizeof arm);
    scree_overlap_finish(overlap, apart, radius, radius);
    memcpy(overlap->arm[1], arm, sizeof arm);
    set_tangents(overlap, 0, ORIGIN);
    set_tangents(overlap, 1, apart);
    return true;
}

// ---- disc and polygon ---------------------------------------------------------------------------------------------

/// What is gathered on the way round the polygon: its pieces inside the disc, from where they go in to where they come
/// out, and the area swept by them, seen from the first point.
typedef struct outline {
    double in[SCREE_POLYGON_CORNERS][2], out[SCREE_POLYGON_CORNERS][2];
    int ins, outs;
    double origin[2], last[2], twice;
    double edge_in[2], edge_out[2]; ///< directions of the edges of the last of both
} outline;

static void go_to(outline *way, const double place[2])
{
    way->twice += (way->last[0] - way->origin[0]) * (place[1] - way->origin[1]) -
                  (way->last[1] - way->origin[1]) * (place[0] - way->origin[0]);
    memcpy(way->last, place, sizeof way->last);
}

static void enter(outline *way, const double place[2])
{
    if (way->ins == 0) {
        memcpy(way->origin, place, sizeof way->origin);
        memcpy(way->last, place, sizeof way->last);
    }
    // Along the chord of the arc from where it came out before; its cap is added at the end.
    go_to(way, place);
    memcpy(way->in[way->ins++], place, sizeof way->in[0]);
}

static void leave(outline *way, const double place[2])
{
    go_to(way, place);
    memcpy(way->out[way->outs++], place, sizeof way->out[0]);
}

/// Follows the edge from a to b: b itself if it lies inside, and where the edge meets the circle.
static void follow_edge(outline *way, double radius, const double a[2], const double b[2], bool from, bool to)
{
    double u[2] = {b[0] - a[0], b[1] - a[1]}, square = u[0] * u[0] + u[1] * u[1], length = sqrt(square);
    double moment = a[0] * u[1] - a[1] * u[0], foot = -(a[0] * u[0] + a[1] * u[1]) / square;
    double part = (radius * length - fabs(moment)) * (radius * length + fabs(moment));
    bool through = !from && !to && foot > 0 && foot < 1 && part > 0;
    double half = sqrt(fmax(part, 0)) / square;
    double share[2] = {fmin(fmax(foot - half, 0), 1), fmin(fmax(foot + half, 0), 1)}, place[2][2];
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 2; i++) place[k][i] = a[i] + share[k] * u[i];
    if ((!from && to) || through) {
        enter(way, place[0]);
        memcpy(way->edge_in, u, sizeof u);
    }
    if ((from && !to) || through) {
        leave(way, place[1]);
        memcpy(way->edge_out, u, sizeof u);
    }
    if (to) go_to(way, b);
}

/// No edge meets the circle: all corners inside, or the disc, or neither.
static bool uncrossed(double radius, const scree_polygon *polygon, const double (*corner)[2], bool all_inside,
                      const double apart[2], scree_overlap *overlap)
{
    if (all_inside) {
        *overlap = (scree_overlap){.area = scree_polygon_area(polygon->count, corner), .flags = SCREE_OVERLAP_INSIDE};
        memcpy(overlap->arm[0], apart, sizeof overlap->arm[0]);
        return true;
    }
    for (int k = 0; k < polygon->count; k++) {
        const double *a = corner[k], *b = corner[k + 1 < polygon->count ? k + 1 : 0];
        if (a[0] * b[1] - a[1] * b[0] < 0) return false;
    }
    return disc_inside(0, radius, apart, overlap);
}

bool scree_disc_overlap_polygon(double radius, const scree_polygon *polygon, const double apart[2],
                                scree_overlap *overlap)
{
    double reach = radius + polygon->bound, corner[SCREE_POLYGON_CORNERS][2], end[2 * SCREE_POLYGON_CORNERS][2];
    int count = polygon->count, first = -1;
    if (apart[0] * apart[0] + apart[1] * apart[1] > reach * reach * (1 + 0x1p-40)) return false;
    bool inside[SCREE_POLYGON_CORNERS], all_inside = true;
    for (int k = 0; k < count; k++) {
        for (int i = 0; i < 2; i++) corner[k][i] = polygon->corner[k][i] + apart[i];
        double square = corner[k][0] * corner[k][0] + corner[k][1] * corner[k][1];
        inside[k] = !(square >= radius * radius);
        all_inside = all_inside && inside[k];
        if (!inside[k]) first = k;
    }
    // From a corner outside, so that the way begins with going in.
    outline way = {.ins = 0};
    for (int k = 0; k < count && first >= 0; k++) {
        int a = (first + k) % count, b = (a + 1) % count;
        follow_edge(&way, radius, corner[a], corner[b], inside[a], inside[b]);
    }
    const double radii[2] = {radius, polygon->radius}, bounds[2] = {radius, polygon->bound};
    if (way.ins == 0) {
        if (!uncrossed(radius, polygon, (const double(*)[2])corner, all_inside, apart, overlap)) return false;
        scree_overlap_finish(overlap, apart, radii, bounds);
        return true;
    }
    go_to(&way, way.in[0]);
    overlap->area = way.twice / 2;
    for (int k = 0; k < way.ins; k++) {
        const double *s = way.out[k], *e = way.in[k + 1 < way.ins ? k + 1 : 0];
        double u[2] = {e[0] - s[0], e[1] - s[1]}, length = sqrt(u[0] * u[0] + u[1] * u[1]);
        overlap->area += length > 0 ? scree_disc_cap(radius, length / 2, (s[0] * e[1] - s[1] * e[0]) / length) : 0;
        memcpy(end[2 * k], s, sizeof end[0]);
        memcpy(end[2 * k + 1], e, sizeof end[0]);
    }
    overlap->flags = 0;
    scree_overlap_find_line(overlap, way.ins, (const double(*)[2])end, true);
    set_tangents(overlap, 0, ORIGIN);
    memcpy(overlap->edge[0][1], way.edge_out, sizeof way.edge_out);
    memcpy(overlap->edge[1][1], way.edge_in, sizeof way.edge_in);
    if (overlap->area <= 0) return false;
    scree_overlap_finish(overlap, apart, radii, bounds);
    return true;
}
