/// Normal distribution of radii, cut at two limits.
#include "size/normal.h"

typedef scree_normal_config config;
static const scree_key keys[] = {
    SIZE_LIMITS(config, "normal"),
    NUMBER(config, mean, "m", FROM("1 nm"), TO("100 m"), .when = "distribution=normal",
           .meaning = "Mean radius before the limits cut the distribution."),
    NUMBER(config, deviation, "m", FROM("1e-3 nm"), TO("100 m"), .when = "distribution=normal",
           .meaning = "Standard deviation of the radius before the limits cut the distribution."),
};

static scree_gaussian gaussian(const void *own)
{
    const config *c = own;
    return (scree_gaussian){{c->radius_min, c->radius_max}, c->mean, c->deviation, false};
}

SIZE_GAUSSIAN(gaussian, "mean");

const scree_module scree_module_normal = {
    .name = "normal",
    .meaning = "normal distribution between limits: mean and standard deviation",
    .choice_of = SIZE_CHOICE,
    .keys = SIZE_KEYS(keys, config),
    .keys_count = 2,
    .sizes = &face,
};
