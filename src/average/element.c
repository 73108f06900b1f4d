/// Exact parts of discs, spheres and polygons in rectangles and boxes.
#include "average/element.h"

#include "shape/polygon.h"
#include "shape/rounding.h"

#include <math.h>
#include <string.h>

scree_average_element scree_average_element_at(const scree_vector centre, const scree_vector size)
{
    scree_average_element element;
    for (int k = 0; k < 3; k++) {
        element.low[k] = centre[k] - 0.5 * size[k];
        element.high[k] = centre[k] + 0.5 * size[k];
    }
    return element;
}

double scree_average_element_volume(const scree_average_element *element, int dimension)
{
    double volume = 1;
    for (int k = 0; k < dimension; k++) volume *= element->high[k] - element->low[k];
    return volume;
}

bool scree_average_element_holds(const scree_average_element *element, int dimension, const scree_vector place)
{
    for (int k = 0; k < dimension; k++)
        if (place[k] < element->low[k] || place[k] >= element->high[k]) return false;
    return true;
}

// ---- discs -------------------------------------------------------------------------------------------------------

/// Antiderivative of sqrt(r^2 - t^2), from 0 to x, |x| <= r.
static double under_circle(double r, double x)
{
    return 0.5 * (x * sqrt(fmax(0, r * r - x * x)) + r * r * asin(fmax(-1, fmin(1, x / r))));
}

/// Area of the disc left of x and below y.
static double quadrant(double r, double x, double y)
{
    if (x <= -r || y <= -r) return 0;
    x = fmin(x, r);
    if (y >= r) return 2 * (under_circle(r, x) + 0.25 * M_PI * r * r);
    const double half = sqrt(fmax(0, r * r - y * y)); // the line y cuts the circle at -half and half
    double area = 0;
    if (y >= 0) { // whole chords outside of the cut, from the bottom to y between
        const double left = fmin(x, -half), middle = fmin(x, half);
        area += 2 * (under_circle(r, left) - under_circle(r, -r));
        if (x > -half) area += under_circle(r, middle) - under_circle(r, -half) + y * (middle + half);
        if (x > half) area += 2 * (under_circle(r, x) - under_circle(r, half));
    } else if (x > -half) {
        const double to = fmin(x, half);
        area += under_circle(r, to) - under_circle(r, -half) + y * (to + half);
    }
    return area;
}

double scree_average_disc_part(double radius, double x0, double x1, double y0, double y1)
{
    if (!(x1 > x0) || !(y1 > y0) || !(radius > 0)) return 0;
    const double area =
        quadrant(radius, x1, y1) - quadrant(radius, x0, y1) - quadrant(radius, x1, y0) + quadrant(radius, x0, y0);
    return fmax(0, area);
}

// ---- polygons ----------------------------------------------------------------------------------------------------

/// Keeps what lies on the side of a line along an axis: sign * corner[axis] <= sign * limit. Returns the corners left.
static int clip(int count, double (*corner)[2], int axis, double sign, double limit)
{
    double kept[2 * SCREE_POLYGON_CORNERS][2];
    int left = 0;
    for (int k = 0; k < count; k++) {
        const double *a = corner[k], *b = corner[(k + 1) % count];
        const double da = sign * (a[axis] - limit), db = sign * (b[axis] - limit);
        if (da <= 0) {
            kept[left][0] = a[0];
            kept[left++][1] = a[1];
        }
        if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
            const double t = da / (da - db);
            for (int i = 0; i < 2; i++) kept[left][i] = a[i] + t * (b[i] - a[i]);
            kept[left++][axis] = limit;
        }
    }
    memcpy(corner, kept, (size_t)left * sizeof *kept);
    return left;
}

double scree_average_polygon_part(int count, const double (*corner)[2], double x0, double x1, double y0, double y1)
{
    double left[2 * SCREE_POLYGON_CORNERS][2];
    memcpy(left, corner, (size_t)count * sizeof *left);
    count = clip(count, left, 0, 1, x1);
    count = clip(count, left, 0, -1, x0);
    count = clip(count, left, 1, 1, y1);
    count = clip(count, left, 1, -1, y0);
    return count < 3 ? 0 : fmax(0, scree_polygon_area(count, (const double(*)[2])left));
}

// ---- spheres -----------------------------------------------------------------------------------------------------

/// Gauss and Legendre's rule of 12 points on -1 to 1: the positive half.
static const double node[6] = {0.125233408511468916, 0.367831498998180194, 0.587317954286617447,
                               0.769902674194304687, 0.904117256370474857, 0.981560634246719251};
static const double weight[6] = {0.249147045813402785, 0.233492536538354809, 0.203167426723065922,
                                 0.160078328543346226, 0.106939325995318431, 0.047175336386511827};

/// Integral of the part of the section over z from `from` to `to`. z = from + (to - from)(3 s^2 - 2 s^3): what goes
/// like a root of a distance from an end becomes smooth.
static double piece(double radius, const double low[3], const double high[3], double from, double to)
{
    double sum = 0;
    for (int k = 0; k < 12; k++) {
        const double s = 0.5 * (1 + (k < 6 ? node[k] : -node[k - 6]));
        const double z = from + (to - from) * s * s * (3 - 2 * s);
        const double r = sqrt(fmax(0, (radius - z) * (radius + z)));
        sum += weight[k % 6] * 3 * s * (1 - s) * scree_average_disc_part(r, low[0], high[0], low[1], high[1]);
    }
    return sum * (to - from);
}

/// Adds the heights at which the circle of the section is as wide as `distance`.
static int add_break(double radius, double distance, double from, double to, double *at, int count)
{
    const double z = sqrt(fmax(0, radius * radius - distance * distance));
    if (fabs(distance) >= radius) return count;
    if (z > from && z < to) at[count++] = z;
    if (-z > from && -z < to) at[count++] = -z;
    return count;
}

/// Volume of the sphere below a height.
static double below(double radius, double height)
{
    const double h = fmax(0, fmin(2 * radius, radius + height));
    return M_PI * h * h * (3 * radius - h) / 3;
}

/// The part of a sphere that only sides across one axis cut; false: others do, too.
static bool is_slice(double radius, const double low[3], const double high[3], double *volume)
{
    int cut = -1;
    for (int k = 0; k < 3; k++) {
        if (low[k] <= -radius && high[k] >= radius) continue;
        if (cut >= 0) return false;
        cut = k;
    }
    *volume = cut < 0 ? below(radius, radius) : below(radius, high[cut]) - below(radius, low[cut]);
    return true;
}

double scree_average_sphere_part(double radius, const double low[3], const double high[3])
{
    double slice;
    if (is_slice(radius, low, high, &slice)) return slice;
    const double from = fmax(low[2], -radius), to = fmin(high[2], radius), *side[2] = {low, high};
    double at[24], volume = 0;
    int count = 0;
    if (!(to > from)) return 0;
    at[count++] = from;
    at[count++] = to;
    if (from < 0 && to > 0) at[count++] = 0; // where the section is widest, its radius turns round
    for (int i = 0; i < 2; i++) {
        count = add_break(radius, side[i][0], from, to, at, count);
        count = add_break(radius, side[i][1], from, to, at, count);
        for (int j = 0; j < 2; j++) count = add_break(radius, hypot(side[i][0], side[j][1]), from, to, at, count);
    }
    for (int i = 1; i < count; i++)
        for (int j = i; j > 0 && at[j] < at[j - 1]; j--) {
            const double other = at[j];
            at[j] = at[j - 1];
            at[j - 1] = other;
        }
    // In halves: singular places close behind an end would cost digits.
    for (int k = 1; k < count; k++) {
        const double middle = 0.5 * (at[k - 1] + at[k]);
        if (!(at[k] > at[k - 1])) continue;
        volume += piece(radius, low, high, at[k - 1], middle) + piece(radius, low, high, middle, at[k]);
    }
    return volume;
}

// ---- grains ------------------------------------------------------------------------------------------------------

/// What the rounding of a polygon adds to its core in a rectangle: a strip on each edge, and a sector at each corner,
/// as a fan of triangles with the area of the sector.
static double rounding_part(int count, const double (*corner)[2], double rounding, const double low[2],
                            const double high[2])
{
    enum { ARC = 9 };
    double outline[SCREE_POLYGON_CORNERS * ARC][2], area = 0;
    scree_rounding_trace(count, corner, rounding, ARC, outline);
    for (int k = 0; k < count; k++) {
        const int next = k + 1 < count ? k + 1 : 0;
        const double *v = corner[k], *from = outline[k * ARC], *to = outline[k * ARC + ARC - 1];
        const double *on = outline[next * ARC];
        const double strip[4][2] = {{v[0], v[1]}, {to[0], to[1]}, {on[0], on[1]}, {corner[next][0], corner[next][1]}};
        double fan[ARC + 1][2] = {{v[0], v[1]}};
        const double turn = atan2((from[0] - v[0]) * (to[1] - v[1]) - (from[1] - v[1]) * (to[0] - v[0]),
                                  (from[0] - v[0]) * (to[0] - v[0]) + (from[1] - v[1]) * (to[1] - v[1]));
        const double chord = turn / (ARC - 1), scale = sqrt(chord / sin(chord));
        for (int i = 0; i < ARC; i++)
            for (int j = 0; j < 2; j++) fan[i + 1][j] = v[j] + scale * (outline[k * ARC + i][j] - v[j]);
        area += scree_average_polygon_part(4, strip, low[0], high[0], low[1], high[1]);
        area += scree_average_polygon_part(ARC + 1, (const double(*)[2])fan, low[0], high[0], low[1], high[1]);
    }
    return area;
}

double scree_average_part(const scree_average_sample *sample, const scree_average_grain *grain,
                          const scree_average_element *element)
{
    double low[3], high[3], placed[SCREE_POLYGON_CORNERS][2];
    bool inside = true;
    for (int k = 0; k < sample->dimension; k++) {
        low[k] = element->low[k] - grain->position[k];
        high[k] = element->high[k] - grain->position[k];
        if (low[k] >= grain->radius || high[k] <= -grain->radius) return 0;
        inside = inside && low[k] <= -grain->radius && high[k] >= grain->radius;
    }
    if (inside) return 1;
    if (sample->dimension == 3) return scree_average_sphere_part(grain->radius, low, high) / grain->volume;
    if (grain->corner_count == 0)
        return scree_average_disc_part(grain->radius, low[0], high[0], low[1], high[1]) / grain->volume;
    scree_average_outline(sample, grain, placed);
    const double(*corner)[2] = (const double(*)[2])placed;
    const int count = (int)grain->corner_count;
    double area = scree_average_polygon_part(count, corner, low[0], high[0], low[1], high[1]);
    if (grain->rounding > 0) area += rounding_part(count, corner, grain->rounding, low, high);
    return area / grain->volume;
}
