/// Measures and outlines of polygons with rounded corners, piece by piece.
#include "shape/rounding.h"

#include <math.h>

/// Integrals over a body: 1, x, x x' (xx, yy, xy).
typedef struct integrals {
    double area, first[2], second[3];
} integrals;

/// Adds a piece with centre of reference v: integrals of 1, y, y y' with y = x - v.
static void add_piece(integrals *to, const double v[2], double area, const double first[2], const double second[3])
{
    to->area += area;
    for (int i = 0; i < 2; i++) {
        to->first[i] += area * v[i] + first[i];
        to->second[i] += area * v[i] * v[i] + 2 * v[i] * first[i] + second[i];
    }
    to->second[2] += area * v[0] * v[1] + v[0] * first[1] + v[1] * first[0] + second[2];
}

/// Outward normal of the edge that begins at corner k; returns its length [m].
static double edge_normal(int count, const double (*corner)[2], int k, double normal[2])
{
    const double *a = corner[k], *b = corner[k + 1 < count ? k + 1 : 0];
    const double length = hypot(b[0] - a[0], b[1] - a[1]);
    normal[0] = (b[1] - a[1]) / length;
    normal[1] = (a[0] - b[0]) / length;
    return length;
}

static void add_strip(integrals *to, int count, const double (*corner)[2], int k, double r)
{
    const double *a = corner[k], *b = corner[k + 1 < count ? k + 1 : 0];
    double n[2];
    const double length = edge_normal(count, corner, k, n), area = length * r;
    const double centre[2] = {0.5 * (a[0] + b[0] + r * n[0]), 0.5 * (a[1] + b[1] + r * n[1])};
    const double along = area * length * length / 12, across = area * r * r / 12, none[2] = {0, 0};
    const double second[3] = {along * n[1] * n[1] + across * n[0] * n[0], along * n[0] * n[0] + across * n[1] * n[1],
                              (across - along) * n[0] * n[1]};
    add_piece(to, centre, area, none, second);
}

/// The direction that halves the sector at corner k, and its angle.
static double sector(int count, const double (*corner)[2], int k, double middle[2])
{
    double before[2], after[2];
    (void)edge_normal(count, corner, k > 0 ? k - 1 : count - 1, before);
    (void)edge_normal(count, corner, k, after);
    const double sum[2] = {before[0] + after[0], before[1] + after[1]}, size = hypot(sum[0], sum[1]);
    middle[0] = sum[0] / size;
    middle[1] = sum[1] / size;
    return atan2(before[0] * after[1] - before[1] * after[0], before[0] * after[0] + before[1] * after[1]);
}

static void add_sector(integrals *to, int count, const double (*corner)[2], int k, double r)
{
    double b[2];
    const double angle = sector(count, corner, k, b), size = 2.0 / 3 * r * r * r * sin(0.5 * angle);
    const double fourth = r * r * r * r / 8, along = fourth * (angle + sin(angle)),
                 across = fourth * (angle - sin(angle));
    const double first[2] = {size * b[0], size * b[1]};
    const double second[3] = {along * b[0] * b[0] + across * b[1] * b[1], along * b[1] * b[1] + across * b[0] * b[0],
                              (along - across) * b[0] * b[1]};
    add_piece(to, corner[k], 0.5 * angle * r * r, first, second);
}

scree_polygon_measures scree_rounding_measure(int count, const double (*corner)[2], double rounding)
{
    const scree_polygon_measures core = scree_polygon_measure(count, corner);
    const double none[2] = {0, 0}, second[3] = {core.moment[1], core.moment[0], core.moment[2]};
    double shifted[SCREE_POLYGON_CORNERS][2];
    integrals all = {0};
    for (int k = 0; k < count; k++)
        for (int i = 0; i < 2; i++) shifted[k][i] = corner[k][i] - core.centroid[i];
    add_piece(&all, none, core.area, none, second);
    for (int k = 0; k < count; k++) {
        add_strip(&all, count, (const double(*)[2])shifted, k, rounding);
        add_sector(&all, count, (const double(*)[2])shifted, k, rounding);
    }
    const double c[2] = {all.first[0] / all.area, all.first[1] / all.area};
    scree_polygon_measures m = {.area = all.area,
                                .centroid = {core.centroid[0] + c[0], core.centroid[1] + c[1]},
                                .moment = {all.second[1] - all.area * c[1] * c[1],
                                           all.second[0] - all.area * c[0] * c[0],
                                           all.second[2] - all.area * c[0] * c[1]},
                                .radius = sqrt(all.area / M_PI)};
    for (int k = 0; k < count; k++) m.bound = fmax(m.bound, hypot(shifted[k][0] - c[0], shifted[k][1] - c[1]));
    m.bound += rounding;
    return m;
}

double scree_rounding_scale(int count, const double (*corner)[2], double rounding)
{
    double length = 0, normal[2];
    for (int k = 0; k < count; k++) length += edge_normal(count, corner, k, normal);
    const double area = scree_polygon_area(count, corner), half = 0.5 * length * rounding;
    const double left = M_PI * (1 - rounding * rounding);
    return left / (half + sqrt(half * half + area * left));
}

void scree_rounding_trace(int count, const double (*corner)[2], double rounding, int arc, double (*outline)[2])
{
    for (int k = 0; k < count; k++) {
        double middle[2];
        const double angle = sector(count, corner, k, middle), begin = atan2(middle[1], middle[0]) - 0.5 * angle;
        for (int i = 0; i < arc; i++) {
            const double turn = begin + angle * i / (arc - 1);
            outline[k * arc + i][0] = corner[k][0] + rounding * cos(turn);
            outline[k * arc + i][1] = corner[k][1] + rounding * sin(turn);
        }
    }
}
