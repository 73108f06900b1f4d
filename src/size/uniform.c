/// Radii between a and b, each equally likely: R = a + u (b - a), <R^2> = (a^2 + a b + b^2) / 3,
/// <R^3> = (a + b) (a^2 + b^2) / 4.
#include "size/limits.h"

typedef scree_size_limits config;
static const scree_key keys[] = {SIZE_LIMITS(config, "uniform")};

static scree_size_moments moments(const void *own, int dimension)
{
    (void)dimension;
    const config *c = own;
    double a = c->radius_min, b = c->radius_max;
    return (scree_size_moments){.least = a,
                                .most = b,
                                .mean = (a + b) / 2,
                                .square = (a * a + a * b + b * b) / 3,
                                .cube = (a + b) * (a * a + b * b) / 4};
}

static double radius(const void *own, int dimension, double uniform)
{
    (void)dimension;
    const config *c = own;
    return c->radius_min + (c->radius_max - c->radius_min) * uniform;
}

const scree_module scree_module_uniform = {
    .name = "uniform",
    .meaning = "every radius between the smallest and the largest is equally likely",
    .choice_of = SIZE_CHOICE,
    .keys = SIZE_KEYS(keys, config),
    .keys_count = 2,
    .sizes = &(const scree_size_distribution){.moments = moments, .radius = radius, .wrong = scree_size_limits_wrong},
};
