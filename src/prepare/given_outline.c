/// Outlines of given bodies: drawn as the preparation will draw them, turned and scaled.
#include "prepare/given_outline.h"

#include "module/shape.h"
#include "shape/core_gap.h"
#include "shape/polygon_pair.h"

#include <math.h>

static const scree_shape *shape_of(const scree_config *config)
{
    const int slot = scree_config_shape(&config->particles, 0);
    return slot >= 0 ? scree_modules[slot]->shape : NULL;
}

bool scree_given_has_outlines(const scree_config *config)
{
    const scree_shape *shape = shape_of(config);
    double corner[SCREE_POLYGON_CORNERS][2];
    if (!shape || !shape->corners || shape->dimension != config->dimension) return false;
    return shape->corners(scree_config_shape_keys(&config->particles, 0), (uint64_t)config->seed, 0, corner) > 0;
}

scree_given_outline scree_given_outline_of(const scree_config *config, uint64_t number, double radius, double angle)
{
    const scree_shape *shape = shape_of(config);
    const void *keys = scree_config_shape_keys(&config->particles, 0);
    double drawn[SCREE_POLYGON_CORNERS][2], farthest = 0;
    scree_given_outline outline = {.radius = radius, .rounding = fmax(shape->rounding(keys), 0) * radius};
    outline.count = shape->corners(keys, (uint64_t)config->seed, number, drawn);
    scree_polygon_turn(outline.count, (const double(*)[2])drawn, cos(angle), sin(angle), outline.corner);
    for (int k = 0; k < outline.count; k++) {
        for (int i = 0; i < 2; i++) outline.corner[k][i] *= radius;
        farthest = fmax(farthest, hypot(outline.corner[k][0], outline.corner[k][1]));
    }
    outline.bound = farthest + outline.rounding;
    return outline;
}

double scree_given_reach(const scree_config *config, double radius)
{
    const scree_shape *shape = shape_of(config);
    return radius * shape->largest_reach(scree_config_shape_keys(&config->particles, 0));
}

static scree_core core_of(const scree_given_outline *o)
{
    return (scree_core){(const double(*)[2])o->corner, o->count, o->bound - o->rounding, o->rounding};
}

/// Farthest reach along a direction, a unit vector [m].
static double support(const scree_given_outline *outline, const double direction[2])
{
    const scree_core core = core_of(outline);
    return scree_core_support(&core, direction) + outline->rounding;
}

void scree_given_outline_reach(const scree_config *config, uint64_t number, double radius, double angle, int axis,
                               double reach[2])
{
    const scree_given_outline outline = scree_given_outline_of(config, number, radius, angle);
    for (int k = 0; k < 2; k++) {
        const double side = k ? 1 : -1, direction[2] = {axis == 0 ? side : 0, axis == 1 ? side : 0};
        reach[k] = support(&outline, direction);
    }
}

/// A / l; what no law can use: INFINITY.
static double shared(const scree_given_outline *first, const scree_given_outline *second, const double apart[2])
{
    const scree_polygon one = {(const double(*)[2])first->corner, first->count, first->radius, first->bound},
                        other = {(const double(*)[2])second->corner, second->count, second->radius, second->bound};
    scree_overlap overlap;
    int hint = 0;
    if (!scree_polygon_pair_overlap(&one, &other, apart, &hint, &overlap)) return 0;
    if (overlap.flags) return INFINITY;
    return overlap.area *
           (1 / hypot(overlap.arm[0][0], overlap.arm[0][1]) + 1 / hypot(overlap.arm[1][0], overlap.arm[1][1]));
}

/// The root of the sum over the features; INFINITY: cores meet.
static double pressed(const scree_core core[2], const double apart[2])
{
    scree_features features;
    double sum = 0;
    if (!scree_features_find(core, apart, &features)) return 0;
    for (int side = 0; side < 2; side++)
        for (int k = 0; k < features.count[side]; k++) sum += features.of[side][k].depth * features.of[side][k].depth;
    return features.crossed ? INFINITY : sqrt(sum);
}

scree_given_depth scree_given_outline_depth(const scree_given_outline *first, const scree_given_outline *second,
                                            const double apart[2])
{
    const scree_core core[2] = {core_of(first), core_of(second)};
    const bool rounded = first->rounding > 0 || second->rounding > 0;
    return (scree_given_depth){.depth = scree_core_depth(&core[0], &core[1], apart),
                               .overlap = rounded ? pressed(core, apart) : shared(first, second, apart)};
}
