/// Exact signed area of a triangle by expansions (Shewchuk 1997): each product is two doubles, which are added to the
/// expansion one after the other without a rounding.
#include "shape/side.h"

/// Six products of two doubles each.
enum { TERMS = 12 };

typedef struct expansion {
    double term[TERMS]; ///< from the smallest to the largest; zeros may stand between
    int count;
} expansion;

/// a + b as a double and what its rounding leaves (Knuth).
static double two_sum(double a, double b, double *rest)
{
    double sum = a + b, part = sum - a;
    *rest = (a - (sum - part)) + (b - part);
    return sum;
}

static void add(expansion *e, double value)
{
    for (int k = 0; k < e->count; k++) value = two_sum(value, e->term[k], &e->term[k]);
    e->term[e->count++] = value;
}

static void add_product(expansion *e, double a, double b)
{
    double product = a * b;
    add(e, fma(a, b, -product));
    add(e, product);
}

double scree_side_exact(const double a[2], const double b[2], const double c[2])
{
    expansion e = {.count = 0};
    double u[2], v[2], rest[4];
    for (int k = 0; k < 2; k++) {
        u[k] = two_sum(b[k], -a[k], &rest[k]);
        v[k] = two_sum(c[k], -a[k], &rest[2 + k]);
    }
    // Where the differences are exact, two products are enough: bodies on a grid, edges along the axes.
    if (rest[0] == 0 && rest[1] == 0 && rest[2] == 0 && rest[3] == 0) {
        add_product(&e, u[0], v[1]);
        add_product(&e, -u[1], v[0]);
    } else {
        add_product(&e, a[0], b[1]);
        add_product(&e, -a[1], b[0]);
        add_product(&e, b[0], c[1]);
        add_product(&e, -b[1], c[0]);
        add_product(&e, c[0], a[1]);
        add_product(&e, -c[1], a[0]);
    }
    // From the largest down: a partial sum is exact, or so large that what follows cannot change its sign.
    double side = 0;
    for (int k = e.count - 1; k >= 0; k--) side += e.term[k];
    return side;
}
