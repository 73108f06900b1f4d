/// Surfaces of samples by columns.
#include "average/surface.h"

#include "base/matrix.h"
#include "shape/outline_extent.h"

#include <math.h>

enum { OF_DIAMETER = 4 }; ///< columns of a mean diameter

void scree_average_surface_destroy(scree_average_surface *surface)
{
    scree_release(&surface->bottom);
    scree_release(&surface->top);
}

/// Number of the column at a place; of those that go round also beyond the last and below 0.
static int64_t column_at(const scree_average_surface *s, int axis, double place)
{
    const double at = floor((place - s->origin[axis]) / s->width[axis]), last = (double)s->columns[axis] - 1;
    return (int64_t)(s->round[axis] ? at : fmax(0, fmin(at, last)));
}

/// Where the values of columns (i, j) are; their numbers may lie outside where they go round.
static size_t place_of(const scree_average_surface *s, int64_t i, int64_t j)
{
    const int64_t m = (int64_t)s->columns[0], n = (int64_t)s->columns[1];
    return (size_t)(((i % m + m) % m) * n + (j % n + n) % n);
}

/// Lower side of a column [m].
static double begin_of(const scree_average_surface *s, int axis, int64_t k)
{
    return s->origin[axis] + (double)k * s->width[axis];
}

/// Distance of a place from the middle of column k along an axis.
static double away(const scree_average_surface *s, int axis, int64_t k, double place)
{
    return begin_of(s, axis, k) + 0.5 * s->width[axis] - place;
}

/// The outline of a polygon as it lies; `placed`: room for its corners.
static scree_core outline_of(const scree_average_sample *sample, const scree_average_grain *grain, double (*placed)[2])
{
    scree_average_outline(sample, grain, placed);
    return (scree_core){
        .corner = (const double(*)[2])placed, .count = (int)grain->corner_count, .rounding = grain->rounding};
}

/// The vertical extent of a grain at (dx, dy) from its centre, relative to that; false: it does not reach there.
static bool find_chord(const scree_average_sample *sample, const scree_average_grain *grain, double dx, double dy,
                       double chord[2])
{
    const double square = grain->radius * grain->radius - dx * dx - dy * dy;
    if (square < 0) return false;
    chord[1] = sqrt(square);
    chord[0] = -chord[1];
    if (grain->corner_count == 0) return true;
    double placed[SCREE_POLYGON_CORNERS][2];
    const scree_core outline = outline_of(sample, grain, placed);
    return scree_outline_chord(&outline, dx, chord);
}

/// Lets a grain raise and lower the columns that it covers.
static void cover(const scree_average_sample *sample, scree_average_surface *s, const scree_average_grain *grain)
{
    const double r = grain->radius, *x = grain->position, height = x[s->dimension - 1];
    int64_t from[2] = {0, 0}, to[2] = {0, 0};
    for (int k = 0; k < s->dimension - 1; k++) {
        from[k] = column_at(s, k, x[k] - r);
        to[k] = column_at(s, k, x[k] + r);
    }
    for (int64_t i = from[0]; i <= to[0]; i++)
        for (int64_t j = from[1]; j <= to[1]; j++) {
            double chord[2];
            const double dy = s->dimension == 3 ? away(s, 1, j, x[1]) : 0;
            if (!find_chord(sample, grain, away(s, 0, i, x[0]), dy, chord)) continue;
            double *top = &s->top[place_of(s, i, j)], *bottom = &s->bottom[place_of(s, i, j)];
            if (!(*top >= height + chord[1])) *top = height + chord[1];
            if (!(*bottom <= height + chord[0])) *bottom = height + chord[0];
        }
}

/// The lowest point where a grain touches what is no grain.
static double find_base(const scree_average_sample *sample)
{
    const int up = sample->dimension - 1;
    double base = INFINITY;
    for (size_t c = 0; c < sample->contacts; c++) {
        const scree_average_contact *contact = &sample->contact[c];
        const bool outer = contact->second == SCREE_AVERAGE_OUTSIDE || !sample->grain[contact->second].counted ||
                           !sample->grain[contact->first].counted;
        if (outer) base = fmin(base, contact->point[up]);
    }
    return isfinite(base) ? base : sample->low[up];
}

/// Numbers of the columns within a mean diameter of column k.
static void find_near(const scree_average_surface *s, int axis, int64_t k, int64_t near[2])
{
    const int64_t last = (int64_t)s->columns[axis] - 1;
    near[0] = s->round[axis] || k > OF_DIAMETER ? k - OF_DIAMETER : 0;
    near[1] = s->round[axis] || k + OF_DIAMETER < last ? k + OF_DIAMETER : last;
}

/// The lower surface of what has no voids below it.
static scree_status smooth_bottom(const scree_average_sample *sample, scree_average_surface *s, scree_error *error)
{
    const size_t count = s->columns[0] * s->columns[1];
    double *least;
    scree_status status = scree_allocate(&least, count, sizeof *least, error);
    for (int64_t i = 0; i < (int64_t)s->columns[0] && !status; i++)
        for (int64_t j = 0; j < (int64_t)s->columns[1]; j++) {
            const size_t here = place_of(s, i, j);
            int64_t near[2][2];
            double low = NAN;
            find_near(s, 0, i, near[0]);
            find_near(s, 1, j, near[1]);
            for (int64_t a = near[0][0]; a <= near[0][1]; a++)
                for (int64_t b = near[1][0]; b <= near[1][1]; b++) low = fmin(low, s->bottom[place_of(s, a, b)]);
            const bool at_base = low < s->base + 2 * sample->mean_radius;
            least[here] = isnan(s->bottom[here]) ? NAN : at_base ? s->base : low;
        }
    for (size_t k = 0; k < count && !status; k++) s->bottom[k] = least[k];
    scree_release(&least);
    return status;
}

/// Whether some column at this x has a grain.
static bool is_covered(const scree_average_surface *s, int64_t i)
{
    for (int64_t j = 0; j < (int64_t)s->columns[1]; j++)
        if (!isnan(s->top[place_of(s, i, j)])) return true;
    return false;
}

/// The last covered column from the apex on in the direction of `step`, before a gap of a mean diameter.
static int64_t foot(const scree_average_surface *s, int step)
{
    int64_t last = column_at(s, 0, s->apex);
    int gap = 0;
    if (s->round[0]) return step < 0 ? 0 : (int64_t)s->columns[0] - 1;
    for (int64_t k = last; k >= 0 && k < (int64_t)s->columns[0] && gap < OF_DIAMETER; k += step) {
        gap = is_covered(s, k) ? 0 : gap + 1;
        if (gap == 0) last = k;
    }
    return last;
}

/// The highest point of a grain, relative to its centre; of several the left one.
static double top_of(const scree_average_sample *sample, const scree_average_grain *grain, double *beside)
{
    double placed[SCREE_POLYGON_CORNERS][2];
    *beside = 0;
    if (grain->corner_count == 0) return grain->radius;
    const scree_core outline = outline_of(sample, grain, placed);
    const scree_outline_extent extent = scree_outline_extent_of(&outline);
    *beside = extent.top;
    return extent.high[1];
}

static void find_ends(const scree_average_sample *sample, scree_average_surface *s)
{
    const int up = s->dimension - 1;
    s->highest = -INFINITY;
    for (size_t p = 0; p < sample->bodies; p++) {
        const scree_average_grain *grain = &sample->grain[p];
        double beside;
        if (!grain->counted || !scree_average_bounds(sample, p)) continue;
        const double top = grain->position[up] + top_of(sample, grain, &beside);
        if (top <= s->highest) continue;
        s->highest = top;
        s->apex = grain->position[0] + beside;
    }
    s->left = begin_of(s, 0, foot(s, -1));
    s->right = begin_of(s, 0, foot(s, 1) + 1);
}

/// Of a sample that repeats itself upwards.
static void open_columns(const scree_average_sample *sample, scree_average_surface *s)
{
    const int up = s->dimension - 1;
    if (!scree_average_repeats(sample, up)) return;
    s->base = sample->low[up];
    s->highest = sample->high[up];
    for (size_t k = 0; k < s->columns[0] * s->columns[1]; k++) s->bottom[k] = -INFINITY, s->top[k] = INFINITY;
}

/// Of the columns; a cell that repeats itself in all directions has its own, which is less where it leans both ways.
static void find_volume(const scree_average_sample *sample, scree_average_surface *s)
{
    if (sample->directions == (1U << s->dimension) - 1) {
        s->volume = fabs(scree_matrix_determinant(sample->lattice));
        return;
    }
    for (size_t k = 0; k < s->columns[0] * s->columns[1]; k++) {
        if (isnan(s->top[k])) continue;
        const double height = isinf(s->top[k]) ? s->highest - s->base : s->top[k] - s->bottom[k];
        s->volume += fmax(0, height) * s->width[0] * s->width[1];
    }
}

/// Columns over the box that holds the sample; along a direction in which it repeats itself they fill it.
static void lay_columns(const scree_average_sample *sample, scree_average_surface *s)
{
    for (int k = 0; k < sample->dimension - 1; k++) {
        const double size = sample->high[k] - sample->low[k], width = 2 * sample->mean_radius / OF_DIAMETER;
        s->round[k] = scree_average_repeats(sample, k);
        s->origin[k] = sample->low[k];
        s->columns[k] = (size_t)fmax(1, ceil(size / width));
        s->width[k] = s->round[k] ? size / (double)s->columns[k] : width;
    }
}

scree_status scree_average_surface_find(const scree_average_sample *sample, scree_average_surface *s,
                                        scree_error *error)
{
    *s = (scree_average_surface){
        .dimension = sample->dimension, .width = {1, 1}, .columns = {1, 1}, .base = find_base(sample)};
    lay_columns(sample, s);
    const size_t count = s->columns[0] * s->columns[1];
    double reach = -INFINITY;
    scree_status status = scree_allocate(&s->top, count, sizeof *s->top, error);
    if (!status) status = scree_allocate(&s->bottom, count, sizeof *s->bottom, error);
    for (size_t k = 0; k < count && !status; k++) s->top[k] = s->bottom[k] = NAN;
    for (size_t p = 0; p < sample->bodies && !status; p++)
        if (scree_average_bounds(sample, p)) reach = fmax(reach, sample->grain[p].position[sample->dimension - 1]);
    for (size_t p = 0; p < sample->bodies && !status; p++) {
        const scree_average_grain *grain = &sample->grain[p];
        if (grain->counted && grain->position[sample->dimension - 1] <= reach) cover(sample, s, grain);
    }
    if (!status) status = smooth_bottom(sample, s, error);
    if (!status) {
        find_ends(sample, s);
        open_columns(sample, s);
        find_volume(sample, s);
    }
    if (status) scree_average_surface_destroy(s);
    return status;
}

double scree_average_surface_part(const scree_average_surface *s, const scree_average_element *e)
{
    const int up = s->dimension - 1;
    const double low = e->low[up], high = e->high[up];
    double inside = 0;
    int64_t from[2] = {0, 0}, to[2] = {0, 0};
    for (int k = 0; k < up; k++) {
        from[k] = column_at(s, k, e->low[k]);
        to[k] = column_at(s, k, e->high[k]);
    }
    for (int64_t i = from[0]; i <= to[0]; i++)
        for (int64_t j = from[1]; j <= to[1]; j++) {
            const size_t k = place_of(s, i, j);
            const int64_t number[2] = {i, j};
            if (isnan(s->top[k])) continue;
            double area = fmax(0, fmin(high, s->top[k]) - fmax(low, s->bottom[k]));
            for (int a = 0; a < up; a++) {
                const double begin = begin_of(s, a, number[a]);
                area *= fmax(0, fmin(e->high[a], begin + s->width[a]) - fmax(e->low[a], begin));
            }
            inside += area;
        }
    return inside / scree_average_element_volume(e, s->dimension);
}
