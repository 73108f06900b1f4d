/// Log-normal distribution of radii, cut at two limits: the logarithm of the radius over the median is normal, with the
/// logarithm of the geometric deviation as its standard deviation.
#include "size/log_normal.h"

#include <math.h>

typedef scree_log_normal_config config;
static const scree_key keys[] = {
    SIZE_LIMITS(config, "log_normal"),
    NUMBER(config, median, "m", FROM("1 nm"), TO("100 m"), .when = "distribution=log_normal",
           .meaning = "Median radius before the limits cut the distribution."),
    NUMBER(config, geometric_deviation, "1", FROM("1.001"), TO("10"), .when = "distribution=log_normal",
           .meaning = "Geometric standard deviation: 68 % of the radii lie within this factor of the median."),
};

static scree_gaussian gaussian(const void *own)
{
    const config *c = own;
    return (scree_gaussian){{c->radius_min, c->radius_max}, c->median, log(c->geometric_deviation), true};
}

SIZE_GAUSSIAN(gaussian, "median");

const scree_module scree_module_log_normal = {
    .name = "log_normal",
    .meaning = "log-normal distribution between limits: median and geometric standard deviation",
    .choice_of = SIZE_CHOICE,
    .keys = SIZE_KEYS(keys, config),
    .keys_count = 2,
    .sizes = &face,
};
