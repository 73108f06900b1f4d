/// What the grains of a file are to a case: of which of its materials, in the plane or in space.
#include "grains/grains.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int64_t scree_grains_find_material(const scree_grains *grains, size_t kind, const char *const *names, size_t count)
{
    const char *wanted = grains->kind_name[kind];
    char *end;
    if (grains->kinds == 1 && count == 1) return 0; // it can only be that
    for (size_t k = 0; k < count; k++)
        if (names[k] && strcmp(names[k], wanted) == 0) return (int64_t)k;
    const int64_t number = strtoll(wanted, &end, 10) + (strcmp(grains->format, "yade") == 0);
    return *end == 0 && number >= 1 && number <= (int64_t)count ? number - 1 : -1;
}

bool scree_grains_are_2d(const scree_grains *grains, double *lower, double *upper)
{
    const double *z = grains->column[SCREE_GRAIN_Z];
    *lower = *upper = z ? z[0] : 0;
    for (size_t i = 0; i < grains->count && z; i++) {
        *lower = fmin(*lower, z[i]);
        *upper = fmax(*upper, z[i]);
    }
    return *upper - *lower <= 1e-6 * grains->column[SCREE_GRAIN_RADIUS][0];
}

bool scree_grains_are_flat(const scree_grains *grains)
{
    const double *z = grains->column[SCREE_GRAIN_Z];
    size_t zeros = 0;
    while (z && zeros < grains->count && z[zeros] == 0) zeros++;
    return grains->count > 2 && zeros == grains->count;
}
