/// One radius for all.
#include "size/equal.h"
#include "size/limits.h"

typedef scree_equal_config config;
static const scree_key keys[] = {
    NUMBER(config, radius, "m", FROM("1 nm"), TO("100 m"), .when = "distribution=equal",
           .meaning = "Radius of all particles."),
};

static scree_size_moments moments(const void *own, int dimension)
{
    (void)dimension;
    double r = ((const config *)own)->radius;
    return (scree_size_moments){.least = r, .most = r, .mean = r, .square = r * r, .cube = r * r * r};
}

static double radius(const void *own, int dimension, double uniform)
{
    (void)dimension;
    (void)uniform;
    return ((const config *)own)->radius;
}

static bool wrong(const void *own, scree_size_problem *problem)
{
    (void)own;
    (void)problem;
    return false;
}

const scree_module scree_module_equal = {
    .name = "equal",
    .meaning = "one radius for all",
    .choice_of = SIZE_CHOICE,
    .keys = SIZE_KEYS(keys, config),
    .keys_count = 2,
    .sizes = &(const scree_size_distribution){.moments = moments, .radius = radius, .wrong = wrong, .equal = true},
};
