/// Room for grains at their source.
///
/// A grain is born where its bounding circle touches no wall (source/pour.c). Species and size of body N are functions
/// of the seed and N alone, so the largest grain of a run is known before it begins; where several sources share the
/// numbers, each is taken to pour all of them. Cost: linear in the grains looked at.
#include "source/room.h"

#include "base/vectors.h"
#include "prepare/birth.h"
#include "source/source.h"

#include <math.h>

enum {
    GRAINS = 10000, ///< that are looked at
    PARTS = 8       ///< of each edge of a source, at whose ends it is looked for room
};

/// Width [m] of body `number` where it is narrowest.
static double width_of(const scree_model *model, int species, uint64_t number)
{
    const scree_species *drawn = &model->species[species];
    const double radius = scree_model_radius_of_species(model, species, number);
    if (!drawn->shape || !drawn->shape->narrowest) return 2 * radius;
    return radius * drawn->shape->narrowest(drawn->outline, model->seed, number);
}

scree_source_grains scree_source_grains_of(const scree_model *model, const scree_config_source *source)
{
    scree_source_grains grains = {0, INFINITY};
    const int own = scree_source_species(model, source);
    for (uint64_t k = 0; k < model->count && k < GRAINS; k++) {
        const int species = own >= 0 ? own : scree_model_drawn_species(model, k);
        grains.reach = fmax(grains.reach, scree_birth_reach(model, species, k));
        grains.narrowest = fmin(grains.narrowest, width_of(model, species, k));
    }
    return grains;
}

bool scree_source_probe(const scree_source_place *place, size_t parts, size_t k, scree_vector at)
{
    for (int c = 0; c < 3; c++) at[c] = place->origin[c];
    for (int e = 0; e < place->edges; e++) {
        scree_along(at, (double)(k % (parts + 1)) / (double)parts, place->edge[e], at);
        k /= parts + 1;
    }
    return k == 0;
}

/// The wall that a body of this radius would touch at `at`; -1: none.
static int wall_at(const scree_wall_set *wall_set, const scree_vector at, double radius, bool standing)
{
    for (int k = 0; k < wall_set->count; k++)
        if ((!standing || wall_set->surface[k].stands) && scree_surface_clearance(wall_set, k, at, radius) < radius)
            return k;
    return -1;
}

/// Refuses a source in whose place `at` a grain finds no room.
static scree_status refuse(const scree_model *model, const scree_wall_set *wall_set, int64_t index, int wall,
                           const scree_vector at, const char *which, double radius, scree_error *error)
{
    const double clearance = scree_surface_clearance(wall_set, wall, at, radius);
    scree_status status = scree_error_set(
        error, SCREE_ERROR_INPUT,
        "source '%s' is %s wall '%s': (%.4g, %.4g, %.4g) m is %.4g m from it, and the %s particle has the radius %.4g "
        "m; move the source or the wall%s",
        model->sources[index].name,
        clearance < 0   ? "behind"
        : *which == 'l' ? "too near to"
                        : "in",
        wall_set->surface[wall].config->name, at[0], at[1], at[2], fabs(clearance), which, radius,
        *which == 'l' ? ", or take smaller particles" : "");
    return scree_error_key(error, status, "sources.%lld", (long long)index);
}

/// A grain tries other places of its source until it finds room: the largest one waits for ever where there is none.
static scree_status check_largest(const scree_model *model, const scree_wall_set *wall_set, int64_t index,
                                  const scree_source_place *place, scree_error *error)
{
    const scree_config_source *source = &model->sources[index];
    const double reach = scree_source_grains_of(model, source).reach;
    scree_vector at;
    if (scree_dot(source->motion, source->motion) > 0) return SCREE_OK;
    for (size_t k = 0; scree_source_probe(place, PARTS, k, at); k++)
        if (wall_at(wall_set, at, reach, true) < 0) return SCREE_OK;
    (void)scree_source_probe(place, PARTS, 0, at);
    return refuse(model, wall_set, index, wall_at(wall_set, at, reach, true), at, "largest", reach, error);
}

scree_status scree_source_check_room(const scree_model *model, const scree_wall_set *wall_set, int64_t index,
                                     scree_error *error)
{
    const scree_config_source *source = &model->sources[index];
    scree_source_place place;
    scree_vector at;
    if (!wall_set) return SCREE_OK;
    scree_modules[source->kind]->source->place(source->own, &place);
    for (size_t k = 0; scree_source_probe(&place, 1, k, at); k++) {
        const int wall = wall_at(wall_set, at, model->radius_min, false);
        if (wall >= 0) return refuse(model, wall_set, index, wall, at, "smallest", model->radius_min, error);
    }
    return check_largest(model, wall_set, index, &place, error);
}
