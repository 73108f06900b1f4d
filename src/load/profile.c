/// Shapes of profiles, a row each. With s the distance [m] from the origin along the axis:
///     cosine      cos(2 pi s / wavelength + phase) + offset
/// Madan 2019, 5.5, prints A cos(2 pi x / L + 1) for 0 <= x <= L / 2, which is phase 1 rad and offset 0 and ends there
/// with a jump of -0.54 A; phase 0 and offset 1, A (cos(2 pi x / L) + 1), ends with zero and no slope, and is the bell
/// of his figures.
#include "load/profile.h"

#include <math.h>

enum { UNIFORM, COSINE, SHAPES };

static double cosine(const scree_load_profile *p, double s)
{
    return cos(2 * M_PI * s / p->wavelength + p->phase) + p->offset;
}

static double (*const shapes[SHAPES])(const scree_load_profile *profile, double distance) = {[COSINE] = cosine};

const scree_choice scree_load_profile_shapes[] = {
    {"uniform", UNIFORM, "all of the selection alike"},
    {"cosine", COSINE, "times cos(2 pi s / `wavelength` + `phase`) + `offset`, s from `origin` along `axis`"},
    {0},
};
const scree_choice scree_load_profile_axes[] = {
    {"x", 0, "the first axis"}, {"y", 1, "the second axis"}, {"z", 2, "the third axis, in 3D"}, {0}};

bool scree_load_profile_is_uniform(const scree_load_profile *profile)
{
    return !shapes[profile->shape];
}

double scree_load_profile_at(const scree_load_profile *profile, const double place[3], const double origin[3])
{
    return shapes[profile->shape](profile, place[profile->axis] - origin[profile->axis]);
}
