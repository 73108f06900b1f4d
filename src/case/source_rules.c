/// Rules of the sources of a case: what their kinds say, names, what they can be combined with, places of their own.
#include "base/vectors.h"
#include "case/check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const scree_node *source_node(const scree_reader *reader, int64_t index)
{
    return scree_node_at(scree_node_find(reader->root, "sources"), (size_t)index);
}

static void refuse(scree_reader *reader, int64_t index, const char *key, const char *accepted, const char *message)
{
    char path[SCREE_PATH_BYTES];
    scree_rule_refuse(reader, scree_element_path(path, "sources", index, key), accepted, "%s", message);
}

// ---- names -------------------------------------------------------------------------------------------------------

static void name_sources(scree_reader *reader, scree_config *config)
{
    const scree_node *list = scree_node_find(reader->root, "sources");
    const scree_key *key = scree_section_find(scree_schema(), "sources", strlen("sources"));
    for (int64_t i = 0; i < config->source_count; i++) {
        char name[80];
        if (!scree_element_name(key, list, source_node(reader, i), name, sizeof name)) continue;
        config->sources[i].name = scree_arena_copy(reader->arena, name, strlen(name));
        if (!config->sources[i].name) {
            scree_reader_fail(reader, sizeof name);
            return;
        }
        for (int64_t k = 0; k < i; k++)
            if (config->sources[k].name && strcmp(config->sources[k].name, name) == 0)
                refuse(reader, i, "name", NULL, "another source has this name too");
    }
}

static void check_species(scree_reader *reader, const scree_config *config, int64_t index)
{
    const scree_config_particles *particles = &config->particles;
    const char *names[SCREE_MOST_SPECIES], *wanted = config->sources[index].species;
    char path[SCREE_PATH_BYTES];
    size_t count = 0;
    for (int64_t s = 0; s < particles->species_count && s < SCREE_MOST_SPECIES; s++) {
        if (!particles->species[s].name || !wanted || strcmp(particles->species[s].name, wanted) == 0) return;
        names[count++] = particles->species[s].name;
    }
    if (!wanted) return;
    scree_rule_refuse_name(reader, scree_element_path(path, "sources", index, "species"), "species", wanted, names,
                           count);
}

/// The stage that a source names is one that pours.
static void check_stage(scree_reader *reader, const scree_config *config, int64_t index)
{
    char path[SCREE_PATH_BYTES];
    const char *name = config->sources[index].stage;
    scree_element_path(path, "sources", index, "stage");
    if (!name || !scree_rule_is_stage(reader, config, path, name)) return;
    for (int64_t i = 0; i < config->stage_count; i++) {
        const scree_config_stage *stage = &config->stages[i];
        if (!stage->name || strcmp(stage->name, name) != 0 || stage->kind < 0) continue;
        if (!scree_modules[stage->kind]->numbers->pours)
            scree_rule_refuse(reader, path, NULL, "this stage does not pour: name a stage: pour");
    }
}

// ---- places ------------------------------------------------------------------------------------------------------

/// What is wrong with vectors of the source in this dimension, and under which key; NULL: nothing.
static const char *wrong_vector(const scree_config_source *source, int dimension, const char **key)
{
    const double *const vectors[] = {source->velocity, source->spread, source->motion, source->shift};
    static const char *const keys[] = {"velocity", "spread", "motion", "shift"};
    for (int k = 0; k < 4; k++) {
        *key = keys[k];
        if (dimension == 2 && vectors[k][2] != 0) return "there is no z in two dimensions";
        for (int c = 0; c < 3; c++)
            if (k == 1 && vectors[k][c] < 0) return "a spread is not negative";
    }
    return NULL;
}

/// Least and largest radius of all particles [m]; NAN: they are wrong, and that has been noted.
static void find_radii(const scree_config *config, double radius[2])
{
    radius[0] = INFINITY, radius[1] = 0;
    for (int64_t s = 0; s < scree_config_species_count(&config->particles); s++) {
        const scree_config_species species = scree_config_species_at(&config->particles, s);
        const scree_size_distribution *sizes =
            species.distribution >= 0 && species.own ? scree_modules[species.distribution]->sizes : NULL;
        scree_size_problem problem;
        if (!sizes || sizes->wrong(scree_config_sizes(&config->particles, s), &problem)) {
            radius[0] = radius[1] = NAN;
            return;
        }
        const scree_size_moments m = sizes->moments(scree_config_sizes(&config->particles, s), (int)config->dimension);
        radius[0] = fmin(radius[0], m.least);
        radius[1] = fmax(radius[1], m.most);
    }
}

static void place_of(const scree_config *config, int64_t index, scree_source_place *place)
{
    const scree_config_source *source = &config->sources[index];
    scree_modules[source->kind]->source->place(source->own, place);
}

/// Distance [m] of a point from a place whose edges are normal to each other.
static double distance(const double at[3], const scree_source_place *place)
{
    double rest[3];
    scree_subtract(at, place->origin, rest);
    for (int e = 0; e < place->edges; e++) {
        const double *edge = place->edge[e];
        const double along = fmin(1, fmax(0, scree_dot(rest, edge) / scree_dot(edge, edge)));
        scree_along(rest, -along, edge, rest);
    }
    return scree_length(rest);
}

/// Whether all of one place is nearer to the other one than `least` [m].
static bool lies_in(const scree_source_place *one, const scree_source_place *other, double least)
{
    for (int corner = 0; corner < 1 << one->edges; corner++) {
        double at[3] = {one->origin[0], one->origin[1], one->origin[2]};
        for (int e = 0; e < one->edges; e++)
            if (corner >> e & 1) scree_along(at, 1, one->edge[e], at);
        if (!(distance(at, other) < least)) return false;
    }
    return true;
}

/// Whether two sources pour in one stage.
static bool pour_together(const scree_config_source *one, const scree_config_source *other)
{
    return !one->stage || !other->stage || strcmp(one->stage, other->stage) == 0;
}

/// Two sources in one place, or one within the other, would block each other.
static void check_places(scree_reader *reader, const scree_config *config, int64_t index)
{
    scree_source_place place, other;
    double radius[2];
    find_radii(config, radius);
    place_of(config, index, &place);
    const double diameter = 2 * radius[1];
    for (int64_t k = 0; k < index; k++) {
        place_of(config, k, &other);
        if (!pour_together(&config->sources[index], &config->sources[k]) ||
            (!lies_in(&place, &other, diameter) && !lies_in(&other, &place, diameter)))
            continue;
        char path[SCREE_PATH_BYTES];
        scree_rule_refuse(reader, scree_element_path(path, "sources", index, "source"), NULL,
                          "it is in the same place as sources.%lld, less than a diameter, %.3g m, away: give it "
                          "another place, or its own `stage`, or one of them a shorter interval",
                          (long long)k, diameter);
        return;
    }
}

/// A region in which all are born at one place, but for a part of a grain, is meant to be another one.
static void check_size(scree_reader *reader, const scree_config *config, int64_t index)
{
    scree_source_place place;
    double radius[2], length = 0;
    if (!scree_modules[config->sources[index].kind]->source->rains) return;
    place_of(config, index, &place);
    find_radii(config, radius);
    for (int e = 0; e < place.edges; e++) length = fmax(length, scree_length(place.edge[e]));
    if (!(length < 2 * radius[0])) return;
    char path[SCREE_PATH_BYTES];
    scree_rule_refuse(
        reader, scree_element_path(path, "sources", index, "upper"), NULL,
        "the region is smaller, %.3g m, than the smallest particle, %.3g m: give corners that are farther "
        "apart, or a source: point",
        length, 2 * radius[0]);
}

// ---- the whole ---------------------------------------------------------------------------------------------------

/// What goes together with sources at all.
static bool goes_together(scree_reader *reader, const scree_config *config)
{
    bool pours = false;
    for (int64_t i = 0; i < config->stage_count; i++) {
        if (config->stages[i].kind < 0) return false; // wrong, and noted
        pours = pours || scree_modules[config->stages[i].kind]->numbers->pours;
    }
    if (config->boundary.periodic > 0)
        refuse(reader, 0, "source", NULL,
               "sources do not pour into a sample that repeats itself: leave boundary.periodic out, and give `walls` "
               "and boundary: walls");
    else if (!pours)
        refuse(reader, 0, "source", NULL, "no stage pours: give a stage: pour, or leave `sources` out");
    return pours;
}

void scree_rules_check_sources(scree_reader *reader, scree_config *config)
{
    for (int64_t i = 0; i < config->source_count; i++)
        if (config->sources[i].kind < 0 || !config->sources[i].own) return; // wrong, and noted
    if (config->source_count == 0) return;
    name_sources(reader, config);
    if (!goes_together(reader, config)) return;
    for (int64_t i = 0; i < config->source_count; i++) {
        const scree_config_source *source = &config->sources[i];
        const scree_source_kind *kind = scree_modules[source->kind]->source;
        const char *key, *wrong = kind->wrong ? kind->wrong(source->own, (int)config->dimension, &key) : NULL;
        if (!wrong) wrong = wrong_vector(source, (int)config->dimension, &key);
        if (wrong) refuse(reader, i, key, NULL, wrong);
        check_species(reader, config, i);
        check_stage(reader, config, i);
        if (!wrong) check_size(reader, config, i);
        if (!wrong) check_places(reader, config, i);
    }
}
