/// Area of the overlap of two convex polygons without any rounding, by GMP: the clipping of Sutherland and Hodgman on
/// whole numbers in homogeneous coordinates. It shares nothing with shape/polygon_pair.h.
#ifndef SCREE_TESTS_EXACT_POLYGON_H
#define SCREE_TESTS_EXACT_POLYGON_H

#include <gmp.h>
#include <math.h>
#include <string.h>

enum { EXACT_POINTS = 80 };

/// (x/w, y/w), w > 0.
typedef struct exact_point {
    mpz_t x, y, w;
} exact_point;

/// Two lists of points, of which one is clipped into the other; numbers that are used again and again.
typedef struct exact_clip {
    exact_point list[2][EXACT_POINTS];
    int count[2];
    mpz_t side[EXACT_POINTS], a, b, u, v;
    mpq_t area, term;
} exact_clip;

static inline void exact_init(exact_clip *c)
{
    for (int l = 0; l < 2; l++)
        for (int k = 0; k < EXACT_POINTS; k++) mpz_inits(c->list[l][k].x, c->list[l][k].y, c->list[l][k].w, NULL);
    for (int k = 0; k < EXACT_POINTS; k++) mpz_init(c->side[k]);
    mpz_inits(c->a, c->b, c->u, c->v, NULL);
    mpq_inits(c->area, c->term, NULL);
}

static inline void exact_clear(exact_clip *c)
{
    for (int l = 0; l < 2; l++)
        for (int k = 0; k < EXACT_POINTS; k++) mpz_clears(c->list[l][k].x, c->list[l][k].y, c->list[l][k].w, NULL);
    for (int k = 0; k < EXACT_POINTS; k++) mpz_clear(c->side[k]);
    mpz_clears(c->a, c->b, c->u, c->v, NULL);
    mpq_clears(c->area, c->term, NULL);
}

/// The power of two that makes all coordinates whole numbers.
static inline int exact_scale(int count, const double (*corner)[2], int scale)
{
    for (int k = 0; k < count; k++)
        for (int i = 0; i < 2; i++) {
            int exponent;
            if (frexp(corner[k][i], &exponent) != 0 && 53 - exponent > scale) scale = 53 - exponent;
        }
    return scale;
}

/// (v - a) x (b - a) with the sign turned: positive to the left, times w > 0.
static inline void exact_side(exact_clip *c, mpz_t line[4], const exact_point *p, mpz_t side)
{
    mpz_mul(c->u, line[1], p->w);
    mpz_sub(c->u, p->y, c->u);
    mpz_mul(side, line[2], c->u);
    mpz_mul(c->u, line[0], p->w);
    mpz_sub(c->u, p->x, c->u);
    mpz_submul(side, line[3], c->u);
}

/// s p' - s' p, reduced.
static inline void exact_crossing(exact_clip *c, const exact_point *p, const exact_point *q, const mpz_t s,
                                  const mpz_t t, exact_point *at)
{
    mpz_mul(at->x, s, q->x);
    mpz_submul(at->x, t, p->x);
    mpz_mul(at->y, s, q->y);
    mpz_submul(at->y, t, p->y);
    mpz_mul(at->w, s, q->w);
    mpz_submul(at->w, t, p->w);
    mpz_gcd(c->u, at->x, at->w);
    mpz_gcd(c->u, c->u, at->y);
    if (mpz_sgn(at->w) < 0) mpz_neg(c->u, c->u);
    mpz_divexact(at->x, at->x, c->u);
    mpz_divexact(at->y, at->y, c->u);
    mpz_divexact(at->w, at->w, c->u);
}

/// Keeps what lies to the left of the line: list `from` into the other.
static inline void exact_cut(exact_clip *c, int from, mpz_t line[4])
{
    int count = c->count[from], kept = 0;
    exact_point *in = c->list[from], *out = c->list[1 - from];
    for (int k = 0; k < count; k++) exact_side(c, line, &in[k], c->side[k]);
    for (int k = 0; k < count; k++) {
        int next = (k + 1) % count, s = mpz_sgn(c->side[k]), t = mpz_sgn(c->side[next]);
        if (s >= 0) {
            mpz_set(out[kept].x, in[k].x);
            mpz_set(out[kept].y, in[k].y);
            mpz_set(out[kept++].w, in[k].w);
        }
        if (s * t < 0) exact_crossing(c, &in[k], &in[next], c->side[k], c->side[next], &out[kept++]);
    }
    c->count[1 - from] = kept;
}

static inline double exact_distance(const exact_point *p, const exact_point *q, int scale)
{
    double w = mpz_get_d(p->w), v = mpz_get_d(q->w);
    double x = mpz_get_d(p->x) / w - mpz_get_d(q->x) / v, y = mpz_get_d(p->y) / w - mpz_get_d(q->y) / v;
    return ldexp(hypot(x, y), -scale);
}

/// Area of the overlap [m2], rounded once at the end; *length: of its outline, in floating point.
static inline double exact_overlap_area(exact_clip *c, int n, const double (*p)[2], int m, const double (*q)[2],
                                        double *length)
{
    int scale = exact_scale(m, q, exact_scale(n, p, 0)), from = 0;
    mpz_t line[4];
    mpz_inits(line[0], line[1], line[2], line[3], NULL);
    for (int k = 0; k < n; k++) {
        mpz_set_d(c->list[0][k].x, ldexp(p[k][0], scale));
        mpz_set_d(c->list[0][k].y, ldexp(p[k][1], scale));
        mpz_set_ui(c->list[0][k].w, 1);
    }
    c->count[0] = n;
    for (int k = 0; k < m && c->count[from] > 0; k++, from = 1 - from) {
        for (int i = 0; i < 2; i++) {
            mpz_set_d(line[i], ldexp(q[k][i], scale));
            mpz_set_d(line[2 + i], ldexp(q[(k + 1) % m][i], scale));
            mpz_sub(line[2 + i], line[2 + i], line[i]);
        }
        exact_cut(c, from, line);
    }
    mpz_clears(line[0], line[1], line[2], line[3], NULL);
    *length = 0;
    mpz_set_ui(c->u, 0);
    mpz_set_ui(c->v, 1);
    const exact_point *list = c->list[from];
    for (int k = 0; k < c->count[from]; k++) {
        const exact_point *s = &list[k], *e = &list[(k + 1) % c->count[from]];
        *length += exact_distance(s, e, scale);
        mpz_mul(c->a, s->x, e->y);
        mpz_submul(c->a, e->x, s->y);
        mpz_mul(c->b, s->w, e->w);
        // u/v + a/b
        mpz_mul(c->u, c->u, c->b);
        mpz_addmul(c->u, c->a, c->v);
        mpz_mul(c->v, c->v, c->b);
    }
    mpq_set_num(c->area, c->u);
    mpq_set_den(c->area, c->v);
    mpq_canonicalize(c->area);
    return ldexp(mpq_get_d(c->area), -2 * scale - 1);
}

#endif
