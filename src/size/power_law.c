/// Radii between a and b with a density by number that falls as R^-n.
///
/// With p = 1 - n and L = ln(b/a) the inverse of the distribution is R = a exp(ln(1 + u (e^(p L) - 1)) / p), a e^(u L)
/// at p = 0, and <R^k> = a^k J(k + p) / J(p), J(q) = (e^(q L) - 1) / (q L), 1 at q = 0. Both in forms that keep their
/// digits near p = 0.
#include "size/power_law.h"
#include "size/limits.h"

#include <math.h>

typedef scree_power_law_config config;
static const scree_key keys[] = {
    SIZE_LIMITS(config, "power_law"),
    NUMBER(config, exponent, "1", FROM("-10"), TO("10"), .when = "distribution=power_law",
           .meaning = "n: the number of particles of a radius R falls as R^-n."),
};

static double growth(double exponent, double width)
{
    double x = exponent * width;
    return x == 0 ? 1 : expm1(x) / x;
}

double scree_power_law_moment(const scree_power_law_config *law, double power)
{
    const double a = law->radius_min, width = log(law->radius_max / a), p = 1 - law->exponent;
    return pow(a, power) * growth(power + p, width) / growth(p, width);
}

double scree_power_law_radius(const scree_power_law_config *law, double uniform)
{
    const double a = law->radius_min, width = log(law->radius_max / a), p = 1 - law->exponent;
    const double power = fabs(p) < 1e-12 ? uniform * width : log1p(uniform * expm1(p * width)) / p;
    return fmin(fmax(a * exp(power), a), law->radius_max);
}

static scree_size_moments moments(const void *own, int dimension)
{
    (void)dimension;
    const config *c = own;
    double a = c->radius_min, width = log(c->radius_max / a), p = 1 - c->exponent, whole = growth(p, width);
    return (scree_size_moments){.least = a,
                                .most = c->radius_max,
                                .mean = a * growth(1 + p, width) / whole,
                                .square = a * a * growth(2 + p, width) / whole,
                                .cube = a * a * a * growth(3 + p, width) / whole};
}

static double radius(const void *own, int dimension, double uniform)
{
    (void)dimension;
    return scree_power_law_radius(own, uniform);
}

const scree_module scree_module_power_law = {
    .name = "power_law",
    .meaning = "numbers that fall as a power of the radius, between limits",
    .choice_of = SIZE_CHOICE,
    .keys = SIZE_KEYS(keys, config),
    .keys_count = 2,
    .sizes = &(const scree_size_distribution){.moments = moments, .radius = radius, .wrong = scree_size_limits_wrong},
};
