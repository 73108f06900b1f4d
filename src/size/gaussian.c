/// z with the density exp(-z^2/2) between a and b, else zero; F its normal distribution function without limits.
///
/// Radius of a body: z = F^-1(F(a) + u (F(b) - F(a))), taken on the side of the smaller tail. Goes through the
/// mathematical library, whose last bit may differ between machines.
///
/// Moments: int R^k exp(-z^2/2) dz over the same with k = 0, by Gauss and Legendre's rule of five points on PANELS
/// pieces, between the limits as far as anything lies there: FAR on both sides of 0, beyond which the tails hold 2e-19,
/// above 3 spreads more where R^3 grows as exp(3 spread z). Relative error below 1e-10 (a test compares with closed
/// forms). The rules of GSL are not used: those that end the program when memory or patience does are no library's.
///
/// Limits: between a and b there must be a millionth of all (LEAST), so that what is drawn does not come out of
/// rounding errors of a far tail.
#include "size/gaussian.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdio.h>

enum { PANELS = 60 };
static const double LEAST = 1e-6, FAR = 9;

static double reduced(const scree_gaussian *g, double radius)
{
    return (g->logarithmic ? log(radius / g->middle) : radius - g->middle) / g->spread;
}

static double radius_at(const scree_gaussian *g, double z)
{
    double radius = g->logarithmic ? g->middle * exp(g->spread * z) : g->middle + g->spread * z;
    return fmin(fmax(radius, g->limits.radius_min), g->limits.radius_max);
}

/// Share of all between two limits: by the upper tail where both lie in it.
static double share_between(double a, double b)
{
    return a > 0 ? gsl_cdf_ugaussian_Q(a) - gsl_cdf_ugaussian_Q(b) : gsl_cdf_ugaussian_P(b) - gsl_cdf_ugaussian_P(a);
}

/// Integral of R^power exp(-z^2 / 2).
static double integral(const scree_gaussian *g, int power, double from, double to)
{
    // Nodes and weights of Gauss and Legendre on [-1, 1], of five points.
    static const double node[] = {0, 0.53846931010568309, -0.53846931010568309, 0.90617984593866399,
                                  -0.90617984593866399};
    static const double weight[] = {0.56888888888888889, 0.47862867049936647, 0.47862867049936647, 0.23692688505618909,
                                    0.23692688505618909};
    double sum = 0, half = (to - from) / (2 * PANELS);
    for (int k = 0; k < PANELS; k++)
        for (int i = 0; i < 5; i++) {
            double z = from + half * (2 * k + 1 + node[i]), radius = radius_at(g, z), value = exp(-z * z / 2);
            for (int n = 0; n < power; n++) value *= radius;
            sum += weight[i] * value;
        }
    return sum * half;
}

scree_size_moments scree_gaussian_moments(const scree_gaussian *g)
{
    const scree_size_limits *limits = &g->limits;
    double lowest = reduced(g, limits->radius_min), highest = reduced(g, limits->radius_max);
    double from = fmax(lowest, -FAR), to = fmin(highest, FAR + (g->logarithmic ? 3 * g->spread : 0));
    scree_size_moments m = {.least = limits->radius_min, .most = limits->radius_max};
    if (!(from < to)) { // one radius
        double r = m.mean = limits->radius_min;
        m.square = r * r;
        m.cube = r * r * r;
        return m;
    }
    double whole = integral(g, 0, from, to);
    m.mean = integral(g, 1, from, to) / whole;
    m.square = integral(g, 2, from, to) / whole;
    m.cube = integral(g, 3, from, to) / whole;
    return m;
}

double scree_gaussian_radius(const scree_gaussian *g, double uniform)
{
    double a = reduced(g, g->limits.radius_min), b = reduced(g, g->limits.radius_max), z;
    if (a > 0) {
        double tail = gsl_cdf_ugaussian_Q(a);
        z = gsl_cdf_ugaussian_Qinv(tail - uniform * (tail - gsl_cdf_ugaussian_Q(b)));
    } else {
        double below = gsl_cdf_ugaussian_P(a);
        z = gsl_cdf_ugaussian_Pinv(below + uniform * (gsl_cdf_ugaussian_P(b) - below));
    }
    return radius_at(g, z);
}

bool scree_gaussian_wrong(const scree_gaussian *g, const char *key, scree_size_problem *problem)
{
    const scree_size_limits *limits = &g->limits;
    if (scree_size_limits_wrong(limits, problem)) return true;
    bool one = limits->radius_min == limits->radius_max;
    double share = share_between(reduced(g, limits->radius_min), reduced(g, limits->radius_max));
    if (one || !(share < LEAST)) return false;
    *problem = (scree_size_problem){.key = key};
    (void)snprintf(problem->text, sizeof problem->text,
                   "between radius_min and radius_max lie %.2g of the distribution: bring it and its limits together",
                   share);
    return true;
}
