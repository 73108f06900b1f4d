/// What distributions between two limits share.
#include "size/limits.h"

#include <stdio.h>

bool scree_size_limits_wrong(const void *limits, scree_size_problem *problem)
{
    const scree_size_limits *l = limits;
    if (!(l->radius_min > l->radius_max)) return false;
    *problem = (scree_size_problem){.key = "radius_min", .above = "radius_max"};
    (void)snprintf(problem->text, sizeof problem->text, "radius_min (%g m) is above radius_max (%g m)", l->radius_min,
                   l->radius_max);
    return true;
}
