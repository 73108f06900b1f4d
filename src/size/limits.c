/// What distributions between two limits share.
#include "size/limits.h"

#include <stdio.h>

bool scree_size_limits_wrong(const void *limits, scree_size_fault *fault)
{
    const scree_size_limits *l = limits;
    if (!(l->radius_min > l->radius_max)) return false;
    *fault = (scree_size_fault){.key = "radius_min", .above = "radius_max"};
    (void)snprintf(fault->text, sizeof fault->text, "radius_min (%g m) is above radius_max (%g m)", l->radius_min,
                   l->radius_max);
    return true;
}
