/// Two radii, equally frequent.
#include "size/limits.h"

typedef scree_size_limits config;
static const scree_key keys[] = {SIZE_LIMITS(config, "two_sizes")};

static scree_size_moments moments(const void *own, int dimension)
{
    (void)dimension;
    const config *c = own;
    double a = c->radius_min, b = c->radius_max;
    return (scree_size_moments){
        .least = a, .most = b, .mean = (a + b) / 2, .square = (a * a + b * b) / 2, .cube = (a * a * a + b * b * b) / 2};
}

static double radius(const void *own, int dimension, double uniform)
{
    (void)dimension;
    const config *c = own;
    return c->radius_min + (c->radius_max - c->radius_min) * (uniform >= 0.5);
}

const scree_module scree_module_two_sizes = {
    .name = "two_sizes",
    .meaning = "the smallest and the largest radius, in equal numbers",
    .choice_of = SIZE_CHOICE,
    .keys = SIZE_KEYS(keys, config),
    .keys_count = 2,
    .sizes = &(const scree_size_distribution){.moments = moments, .radius = radius, .wrong = scree_size_limits_wrong},
};
