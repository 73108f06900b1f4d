/// Bodies of revolution: what cylinders and cones share.
#include "shape/wall_keys.h"

#include "base/vectors.h"

const scree_choice scree_wall_sides[] = {
    {"inside", SCREE_SIDE_INSIDE, "the particles are inside of it"},
    {"outside", SCREE_SIDE_OUTSIDE, "the particles are outside: a solid body, or a tube"},
    {0},
};
const scree_choice scree_wall_ends[] = {
    {"open", SCREE_ENDS_OPEN, "particles can pass, and touch the rims"},
    {"closed", SCREE_ENDS_CLOSED, "by planes"},
    {0},
};

/// A line from (s0, r0) to (s1, r1); the bodies are on its right for `sign` = 1.
static scree_profile make_line(double s0, double r0, double s1, double r1, double sign)
{
    double length = hypot(s1 - s0, r1 - r0);
    return (scree_profile){
        .s = {s0, s1}, .r = {r0, r1}, .normal = {sign * (r1 - r0) / length, -sign * (s1 - s0) / length}};
}

void scree_round_make(const scree_round_keys *keys, double low, double high, scree_surface *surface)
{
    bool inside = keys->side == SCREE_SIDE_INSIDE, open = keys->ends == SCREE_ENDS_OPEN;
    double sign = inside ? 1 : -1;
    for (int k = 0; k < 3; k++) surface->start[k] = keys->start[k];
    scree_subtract(keys->end, keys->start, surface->axis);
    double length = scree_normalise(surface->axis);
    surface->kind = SCREE_SURFACE_PROFILE;
    surface->solid = !inside && !open;
    surface->convex = inside && !open;
    surface->profile[0] = make_line(0, low, length, high, sign);
    surface->profile_count = 1;
    surface->profile[0].free_ends = open;
    surface->count = 1;
    if (open) return;
    if (low > 0) surface->profile[surface->profile_count++] = make_line(0, 0, 0, low, sign);
    if (high > 0) surface->profile[surface->profile_count++] = make_line(length, high, length, 0, sign);
    if (inside) surface->count = (size_t)surface->profile_count;
}

const char *scree_round_wrong(const scree_round_keys *keys, const char **key)
{
    double axis[3];
    scree_subtract(keys->end, keys->start, axis);
    *key = "end";
    return scree_length(axis) > 0 ? NULL : "`start` and `end` are the same point: there is no axis";
}

double scree_round_face(const scree_round_keys *keys, double radius, const double direction[3])
{
    double axis[3], across[3];
    scree_subtract(keys->end, keys->start, axis);
    (void)scree_normalise(axis);
    scree_cross(axis, direction, across);
    return keys->ends == SCREE_ENDS_CLOSED && scree_length(across) < 1e-9 ? M_PI * radius * radius : 0;
}
