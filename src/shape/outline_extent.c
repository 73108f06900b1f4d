/// Extents of outlines.
#include "shape/outline_extent.h"

scree_outline_extent scree_outline_extent_of(const scree_core *outline)
{
    const double r = outline->rounding;
    if (outline->count == 0) return (scree_outline_extent){.low = {-r, -r}, .high = {r, r}};
    scree_outline_extent extent = {.low = {INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY}};
    for (int k = 0; k < outline->count; k++) {
        const double *corner = outline->corner[k];
        if (corner[1] > extent.high[1] || (corner[1] == extent.high[1] && corner[0] < extent.top))
            extent.top = corner[0];
        for (int axis = 0; axis < 2; axis++) {
            extent.low[axis] = fmin(extent.low[axis], corner[axis]);
            extent.high[axis] = fmax(extent.high[axis], corner[axis]);
        }
    }
    for (int axis = 0; axis < 2; axis++) {
        extent.low[axis] -= r;
        extent.high[axis] += r;
    }
    return extent;
}

/// The same with what the rounding of a polygon adds: its outer edges, and discs at its corners.
static void widen_chord(const scree_core *outline, double x, double chord[2])
{
    const double rounding = outline->rounding;
    for (int k = 0; k < outline->count; k++) {
        const double *a = outline->corner[k], *b = outline->corner[k + 1 < outline->count ? k + 1 : 0];
        const double square = rounding * rounding - (x - a[0]) * (x - a[0]), length = hypot(b[0] - a[0], b[1] - a[1]);
        const double out[2] = {rounding * (b[1] - a[1]) / length, rounding * (a[0] - b[0]) / length};
        if (square >= 0) {
            chord[0] = fmin(chord[0], a[1] - sqrt(square));
            chord[1] = fmax(chord[1], a[1] + sqrt(square));
        }
        const double from = a[0] + out[0] - x, to = b[0] + out[0] - x;
        if (from * to > 0 || from == to) continue;
        const double y = a[1] + out[1] - from / (to - from) * (b[1] - a[1]);
        chord[0] = fmin(chord[0], y);
        chord[1] = fmax(chord[1], y);
    }
}

bool scree_outline_chord(const scree_core *outline, double x, double chord[2])
{
    chord[0] = INFINITY, chord[1] = -INFINITY;
    if (outline->count == 0) {
        const double square = outline->rounding * outline->rounding - x * x;
        if (square >= 0) chord[1] = sqrt(square), chord[0] = -chord[1];
        return square >= 0;
    }
    for (int k = 0; k < outline->count; k++) {
        const double *a = outline->corner[k], *b = outline->corner[k + 1 < outline->count ? k + 1 : 0];
        if ((a[0] - x) * (b[0] - x) > 0 || a[0] == b[0]) continue;
        const double y = a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
        chord[0] = fmin(chord[0], y);
        chord[1] = fmax(chord[1], y);
    }
    if (outline->rounding > 0) widen_chord(outline, x, chord);
    return chord[0] <= chord[1];
}

bool scree_outline_highest(const scree_core *outline, double x, double half, double *height)
{
    if (outline->count == 0) {
        const double away = fmax(0, fabs(x) - half), r = outline->rounding;
        *height = sqrt(fmax(0, r * r - away * away));
        return true;
    }
    double chord[2];
    const double top = scree_outline_extent_of(outline).top;
    if (!scree_outline_chord(outline, fmin(fmax(top, x - half), x + half), chord)) return false;
    *height = chord[1];
    return true;
}
