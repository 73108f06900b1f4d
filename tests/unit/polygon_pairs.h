/// Pairs of convex polygons of all kinds, as functions of a number, and what has to hold for each: the exact area, the
/// same bits when exchanged and whatever the hint says.
#ifndef SCREE_TESTS_POLYGON_PAIRS_H
#define SCREE_TESTS_POLYGON_PAIRS_H

#include "base/random.h"
#include "exact_polygon.h"
#include "shape/polygon_make.h"
#include "shape/polygon_pair.h"

typedef enum pair_kind {
    PAIR_ROUNDISH, ///< 3 to 12 corners, axes to 3 : 1, anywhere near each other
    PAIR_MANY,     ///< 16 to 32 corners
    PAIR_BARS,     ///< crossed: four crossings
    PAIR_GRID,     ///< rectangles on a grid of eighths: edges and corners on one another
    PAIR_CORNERS,  ///< a corner on a corner, or some last bits beside it
    PAIR_ON_EDGE,  ///< a corner on an edge, or some last bits beside it
    PAIR_PARALLEL, ///< edges parallel to 1e-1 .. 1e-17, overlapping by as little
    PAIR_LIKE,     ///< the same polygon, shifted and turned by 1e-1 .. 1e-17
    PAIR_WITHIN,   ///< one inside the other, or nearly
    PAIR_NEEDLES,  ///< axes of 100 : 1
    PAIR_UNLIKE,   ///< sizes of 100 : 1
    PAIR_SHALLOW,  ///< corner and edge, depth 1e-1 .. 1e-17
    PAIR_KINDS
} pair_kind;

static const char *const pair_names[PAIR_KINDS] = {
    "roundish", "many corners", "crossed bars",   "on a grid", "corner on corner", "corner on edge",
    "parallel", "like",         "one in another", "needles",   "sizes of 100 : 1", "shallow"};

typedef struct pair_sample {
    pair_kind kind;
    double corner[2][SCREE_POLYGON_CORNERS][2], apart[2];
    scree_polygon polygon[2];
} pair_sample;

/// Numbers of one pair.
typedef struct pair_random {
    uint64_t id, used;
} pair_random;

static inline double draw(pair_random *r, double low, double high)
{
    return low + (high - low) * scree_random_uniform(2009, SCREE_RANDOM_TEST, r->id << 8 | r->used++);
}

static inline int draw_whole(pair_random *r, int low, int high)
{
    return low + (int)draw(r, 0, high - low + 1);
}

/// 1e-1 .. 1e-17, either sign or zero.
static inline double draw_small(pair_random *r)
{
    int sign = draw_whole(r, -1, 1);
    return sign * pow(10, -draw(r, 1, 17));
}

/// A few last bits more or less.
static inline double draw_beside(pair_random *r, double value)
{
    for (int k = draw_whole(r, -3, 3); k != 0; k += k < 0 ? 1 : -1) value = nextafter(value, k < 0 ? -9 : 9);
    return value;
}

static inline void pair_shape(pair_random *r, pair_sample *s, int body, int count, double axes, double radius)
{
    double own[SCREE_POLYGON_CORNERS][2], angle = draw(r, 0, 2 * M_PI);
    scree_polygon_scatter scatter = draw_whole(r, 0, 3) == 0 ? SCREE_POLYGON_FREE : SCREE_POLYGON_SECTORS;
    if (scree_polygon_make_on_ellipse(7, 2 * r->id + (uint64_t)body, count, axes, scatter, radius, own, NULL))
        scree_polygon_make_regular(count, radius, own);
    scree_polygon_turn(count, (const double(*)[2])own, cos(angle), sin(angle), s->corner[body]);
    s->polygon[body].count = count;
}

static inline void pair_box(pair_sample *s, int body, double width, double height)
{
    const double corner[4][2] = {{-width, -height}, {width, -height}, {width, height}, {-width, height}};
    memcpy(s->corner[body], corner, sizeof corner);
    s->polygon[body].count = 4;
}

/// Turns body 1 so that its edge `j` runs against edge `i` of body 0, up to `off`.
static inline void pair_align(pair_sample *s, int i, int j, double off)
{
    const double(*p)[2] = (const double(*)[2])s->corner[0];
    double(*q)[2] = s->corner[1];
    int n = s->polygon[0].count, m = s->polygon[1].count, k = (i + 1) % n, l = (j + 1) % m;
    double angle = atan2(p[i][1] - p[k][1], p[i][0] - p[k][0]) - atan2(q[l][1] - q[j][1], q[l][0] - q[j][0]) + off;
    double turned[SCREE_POLYGON_CORNERS][2];
    scree_polygon_turn(m, (const double(*)[2])q, cos(angle), sin(angle), turned);
    memcpy(q, turned, sizeof turned);
}

/// Puts corner j of body 1 at the place `share` along edge i of body 0, `depth` inside.
static inline void pair_put(pair_sample *s, int i, int j, double share, double depth)
{
    int k = (i + 1) % s->polygon[0].count;
    const double *a = s->corner[0][i], *b = s->corner[0][k], u[2] = {b[0] - a[0], b[1] - a[1]};
    double length = hypot(u[0], u[1]), inward[2] = {-u[1] / length, u[0] / length};
    for (int c = 0; c < 2; c++) s->apart[c] = a[c] + share * u[c] + depth * inward[c] - s->corner[1][j][c];
}

static inline void pair_special(pair_random *r, pair_sample *s)
{
    int i = draw_whole(r, 0, s->polygon[0].count - 1), j = draw_whole(r, 0, s->polygon[1].count - 1);
    if (s->kind == PAIR_CORNERS) pair_put(s, i, j, 0, 0);
    if (s->kind == PAIR_ON_EDGE) pair_put(s, i, j, draw(r, 0, 1), 0);
    if (s->kind == PAIR_CORNERS || s->kind == PAIR_ON_EDGE)
        for (int c = 0; c < 2; c++) s->apart[c] = draw_beside(r, s->apart[c]);
    if (s->kind == PAIR_PARALLEL) {
        pair_align(s, i, j, draw_small(r));
        double depth = draw_small(r);
        pair_put(s, i, j, draw(r, -0.2, 1.2), depth);
    }
    if (s->kind == PAIR_SHALLOW) {
        double depth = draw_small(r);
        pair_put(s, i, j, draw(r, 0, 1), depth);
    }
}

static inline void pair_finish(pair_sample *s)
{
    for (int b = 0; b < 2; b++) {
        scree_polygon *p = &s->polygon[b];
        scree_polygon_measures m = scree_polygon_measure(p->count, (const double(*)[2])s->corner[b]);
        p->radius = m.radius;
        p->bound = 0;
        for (int k = 0; k < p->count; k++) p->bound = fmax(p->bound, hypot(s->corner[b][k][0], s->corner[b][k][1]));
    }
    // The exact area is that of the corners as the code shifts them, so the second body is the one that it shifts.
    if (s->apart[0] < 0 || (s->apart[0] == 0 && s->apart[1] < 0)) {
        pair_sample old = *s;
        for (int b = 0; b < 2; b++) {
            memcpy(s->corner[b], old.corner[1 - b], sizeof s->corner[b]);
            s->polygon[b] = old.polygon[1 - b];
            s->apart[b] = -old.apart[b];
        }
    }
    for (int b = 0; b < 2; b++) s->polygon[b].corner = (const double(*)[2])s->corner[b];
}

static inline void pair_make(uint64_t id, pair_sample *s)
{
    pair_random r = {.id = id};
    *s = (pair_sample){.kind = (pair_kind)(id % PAIR_KINDS)};
    bool many = s->kind == PAIR_MANY, needles = s->kind == PAIR_NEEDLES;
    double far = s->kind == PAIR_WITHIN ? 0.3 : 2;
    for (int b = 0; b < 2; b++) {
        double radius = b == 1 && s->kind == PAIR_UNLIKE ? 0.01 : b == 1 && s->kind == PAIR_WITHIN ? 0.3 : 1;
        double axes = needles ? 100 : draw(&r, 1, 3);
        int count = many ? draw_whole(&r, 16, 32) : draw_whole(&r, 3, 12);
        pair_shape(&r, s, b, count, axes, radius);
    }
    for (int c = 0; c < 2; c++) s->apart[c] = draw(&r, -far, far);
    if (s->kind == PAIR_BARS) {
        double turn = draw(&r, 0.2, M_PI - 0.2), turned[SCREE_POLYGON_CORNERS][2];
        for (int b = 0; b < 2; b++) {
            double height = draw(&r, 0.05, 0.5);
            pair_box(s, b, draw(&r, 1, 3), height);
        }
        scree_polygon_turn(4, (const double(*)[2])s->corner[1], cos(turn), sin(turn), turned);
        memcpy(s->corner[1], turned, 4 * sizeof *turned);
        for (int c = 0; c < 2; c++) s->apart[c] = draw(&r, -0.5, 0.5);
    }
    if (s->kind == PAIR_GRID) {
        for (int b = 0; b < 2; b++) {
            double height = draw_whole(&r, 1, 8) / 8.0;
            pair_box(s, b, draw_whole(&r, 1, 8) / 8.0, height);
        }
        for (int c = 0; c < 2; c++) s->apart[c] = draw_whole(&r, -16, 16) / 8.0;
    }
    if (s->kind == PAIR_LIKE) {
        double turn = draw_small(&r);
        s->polygon[1].count = s->polygon[0].count;
        scree_polygon_turn(s->polygon[0].count, (const double(*)[2])s->corner[0], cos(turn), sin(turn), s->corner[1]);
        for (int c = 0; c < 2; c++) s->apart[c] = draw_small(&r);
    }
    pair_special(&r, s);
    pair_finish(s);
}

// ---- what has to hold ---------------------------------------------------------------------------------------------

/// The error of an area is at most e (L + e/sin(angle)): L the outline of the exact overlap, e = 8 u S, u = 2^-53, S
/// the sum of the bounding radii, the least angle of two edges that cross. A place where edges cross lies off both
/// lines by at most 6 u S (the error of a side over the length of its edge, and the rounding of the place), which moves
/// the sides of the overlap by as much, and makes them longer by as much over the sine; the sum over the outline
/// adds 2. Nearly always the sine may be left out.
enum { AREA_ERROR = 8 };

typedef struct pair_tally {
    uint64_t pairs, apart, two, more, inside, touching, thin, flat, wrong, unequal;
    double worst; ///< largest error of the area in units of u S (L + e)
} pair_tally;

/// How much longer than the exact one the outline may be: e over the least sine, up to the edges themselves.
static inline double pair_stretch(const pair_sample *s, const double (*second)[2], double e)
{
    const double(*p)[2] = s->polygon[0].corner, size = s->polygon[0].bound + s->polygon[1].bound;
    double most = e;
    for (int i = 0; i < s->polygon[0].count; i++)
        for (int j = 0; j < s->polygon[1].count; j++) {
            const double *a = p[i], *b = p[(i + 1) % s->polygon[0].count];
            const double *c = second[j], *d = second[(j + 1) % s->polygon[1].count];
            if (scree_side(a, b, c) * scree_side(a, b, d) > 0 || scree_side(c, d, a) * scree_side(c, d, b) > 0)
                continue;
            double u[2] = {b[0] - a[0], b[1] - a[1]}, v[2] = {d[0] - c[0], d[1] - c[1]};
            double sine = fabs(u[0] * v[1] - u[1] * v[0]) / (hypot(u[0], u[1]) * hypot(v[0], v[1]));
            most = fmax(most, fmin(e / sine, 2 * size));
        }
    return most;
}

static inline bool same_bits(const scree_overlap *a, const scree_overlap *b)
{
    return memcmp(&a->area, &b->area, sizeof a->area) == 0 && memcmp(a->arm, b->arm, sizeof a->arm) == 0 &&
           a->chord[0] == b->chord[0] && a->chord[1] == b->chord[1] && a->flags == b->flags &&
           a->crossings == b->crossings;
}

/// The pair exchanged, and under a hint that was true of another pose or never.
static inline bool pair_is_pure(const pair_sample *s, bool met, const scree_overlap *overlap)
{
    const double back[2] = {-s->apart[0], -s->apart[1]};
    scree_overlap other = {0}, hinted = {0};
    int none = 0, hint = s->polygon[0].count - (int)(s->polygon[1].count * (s->corner[0][0][0] > 0));
    if (hint < -s->polygon[1].count) hint = 0;
    if (scree_polygon_pair_overlap(&s->polygon[1], &s->polygon[0], back, &none, &other) != met) return false;
    if (scree_polygon_pair_overlap(&s->polygon[0], &s->polygon[1], s->apart, &hint, &hinted) != met) return false;
    if (!met) return true;
    scree_overlap_exchange(&other);
    return same_bits(&other, overlap) && same_bits(&hinted, overlap);
}

/// Counts one pair; false: something does not hold.
static inline bool pair_check(exact_clip *clip, const pair_sample *s, pair_tally *tally)
{
    scree_overlap overlap = {0};
    double shifted[SCREE_POLYGON_CORNERS][2], length;
    int n = s->polygon[0].count, m = s->polygon[1].count, hint = 0;
    for (int k = 0; k < m; k++)
        for (int c = 0; c < 2; c++) shifted[k][c] = s->corner[1][k][c] + s->apart[c];
    double exact =
        exact_overlap_area(clip, n, (const double(*)[2])s->corner[0], m, (const double(*)[2])shifted, &length);
    bool met = scree_polygon_pair_overlap(&s->polygon[0], &s->polygon[1], s->apart, &hint, &overlap);
    double unit = 0x1p-53 * (s->polygon[0].bound + s->polygon[1].bound), scale = unit * (length + AREA_ERROR * unit);
    double error = fabs((met ? overlap.area : 0) - exact);
    tally->pairs++;
    tally->apart += !met && exact == 0;
    tally->touching += met && exact == 0;
    tally->thin += !met && exact > 0;
    tally->two += met && overlap.crossings == 2;
    tally->more += met && overlap.crossings > 2;
    tally->inside += met && overlap.flags & SCREE_OVERLAP_INSIDE;
    tally->worst = fmax(tally->worst, error / scale);
    bool right = error <= AREA_ERROR * scale, pure = pair_is_pure(s, met, &overlap);
    if (!right) {
        double e = AREA_ERROR * unit;
        right = error <= e * (length + pair_stretch(s, (const double(*)[2])shifted, e));
        tally->flat += right;
    }
    tally->wrong += !right;
    tally->unequal += !pure;
    return right && pure;
}

#endif
