/// Rules of the particles: each species has its own name, a material of the case and sizes that exist, and their shares
/// are all.
#include "case/case.h"
#include "case/check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_MATERIALS = 16 };

/// Where the keys of species `index` stand: "particles", "particles.species.2".
static void path_of(const scree_config_particles *particles, int64_t index, char path[SCREE_PATH_BYTES])
{
    if (particles->species_count > 0)
        (void)snprintf(path, SCREE_PATH_BYTES, "particles.species.%lld", (long long)index);
    else
        (void)snprintf(path, SCREE_PATH_BYTES, "particles");
}

static const scree_node *node_of(const scree_reader *reader, const scree_config_particles *particles, int64_t index)
{
    const scree_node *section = scree_node_find(reader->root, "particles");
    bool several = particles->species_count > 0;
    return several ? scree_node_at(scree_node_find(section, "species"), (size_t)index) : section;
}

/// A problem at a key of species `index`, or at the species where the key is not given.
static void refuse(scree_reader *reader, const scree_config_particles *particles, int64_t index, const char *key,
                   const char *accepted, const char *message)
{
    char path[SCREE_PATH_BYTES], full[SCREE_PATH_BYTES];
    path_of(particles, index, path);
    scree_key_join(full, path, key);
    scree_rule_refuse(reader, full, accepted, "%s", message);
}

static void check_material(scree_reader *reader, const scree_config *config, int64_t index)
{
    const char *names[MOST_MATERIALS], *wanted = scree_config_species_at(&config->particles, index).material;
    char accepted[256] = "", message[200];
    size_t length = 0, count = 0;
    if (!wanted) return; // missing or wrong, and noted
    for (int64_t i = 0; i < config->material_count && i < MOST_MATERIALS; i++) {
        const char *name = config->materials[i].name;
        if (!name || strcmp(name, wanted) == 0) return;
        if (length < sizeof accepted)
            length += (size_t)snprintf(accepted + length, sizeof accepted - length, "%s%s", i > 0 ? ", " : "", name);
        names[count++] = name;
    }
    if (count == 0) return;
    const char *nearest = scree_nearest(wanted, names, count);
    (void)snprintf(message, sizeof message, "there is no material '%s'%s%s%s", scree_show(wanted).text,
                   nearest ? "; did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "");
    refuse(reader, &config->particles, index, "material", accepted, message);
}

/// Whether all that a distribution needs is written: what is missing has been noted.
static bool has_all_keys(const scree_node *section, const scree_module *distribution)
{
    for (size_t i = 0; i < distribution->keys[0].count; i++) {
        const scree_key *key = &distribution->keys[0].keys[i];
        if (!key->standard && !scree_node_find(section, key->name)) return false;
    }
    return true;
}

static void check_sizes(scree_reader *reader, const scree_config *config, int64_t index)
{
    const scree_config_particles *particles = &config->particles;
    int distribution = scree_config_species_at(particles, index).distribution;
    if (distribution < 0 || !scree_modules[distribution]->sizes) return; // wrong, and noted
    if (!scree_config_species_at(particles, index).own) return;
    const scree_node *section = node_of(reader, particles, index);
    const scree_module *module = scree_modules[distribution];
    scree_size_problem problem = {0};
    if (!has_all_keys(section, module) || !module->sizes->wrong(scree_config_sizes(particles, index), &problem)) return;
    char message[320];
    const scree_node *key = scree_node_find(section, problem.key);
    const scree_node *above = problem.above ? scree_node_find(section, problem.above) : NULL;
    if (key && above)
        (void)snprintf(message, sizeof message, "'%s' is larger than %s, '%s'", scree_show(key->text).text,
                       problem.above, scree_show(above->text).text);
    else
        (void)snprintf(message, sizeof message, "%s", problem.text);
    refuse(reader, particles, index, problem.key, NULL, message);
}

static void check_names(scree_reader *reader, const scree_config_particles *particles)
{
    for (int64_t i = 0; i < particles->species_count; i++)
        for (int64_t k = 0; k < i; k++) {
            const char *name = particles->species[i].name, *other = particles->species[k].name;
            char message[160];
            if (!name || !other || strcmp(name, other) != 0) continue;
            (void)snprintf(message, sizeof message, "particles.species.%lld has the name '%s' too", (long long)k,
                           scree_show(name).text);
            refuse(reader, particles, i, "name", NULL, message);
            break;
        }
}

/// Shares, or numbers, are all of the particles.
static void check_shares(scree_reader *reader, const scree_config_particles *particles)
{
    double sum = 0;
    int64_t count = 0;
    bool counted = particles->share_by == SCREE_SHARE_BY_COUNT;
    const scree_node *section = scree_node_find(reader->root, "particles");
    if (particles->species_count == 0 || particles->share_by < 0 || !scree_node_find(section, "count")) return;
    for (int64_t i = 0; i < particles->species_count; i++) {
        if (!scree_node_find(node_of(reader, particles, i), counted ? "count" : "share")) return; // noted
        sum += particles->species[i].share;
        count += particles->species[i].count;
    }
    if (!counted && fabs(sum - 1) > 1e-6)
        scree_rule_refuse(reader, "particles.species", "100 %", "the shares of the species add up to %.6g %%",
                          100 * sum);
    if (counted && count != particles->count) {
        char accepted[32];
        (void)snprintf(accepted, sizeof accepted, "%lld", (long long)count);
        scree_rule_refuse(reader, "particles.count", accepted, "the species are %lld particles together",
                          (long long)count);
    }
}

static void check_shape(scree_reader *reader, const scree_config *config, int64_t index)
{
    const scree_config_particles *particles = &config->particles;
    const int slot = scree_config_species_at(particles, index).shape, common = particles->shape;
    if (slot == SCREE_CHOICE_WRONG || common < 0 || !scree_modules[common]->shape) return; // noted
    const scree_shape *shape = scree_modules[scree_config_shape(particles, index)]->shape;
    const char *key;
    if (shape->dimension != config->dimension && slot != common && slot != SCREE_CHOICE_AUTO)
        refuse(reader, particles, index, "shape", shape->elsewhere, shape->only_here);
    else if (shape->wrong && (shape->wrong)(scree_config_shape_keys(particles, index), &key))
        refuse(reader, particles, index, key, NULL, shape->wrong(scree_config_shape_keys(particles, index), &key));
}

void scree_rules_check_particles(scree_reader *reader, const scree_config *config)
{
    for (int64_t i = 0; i < scree_config_species_count(&config->particles); i++) {
        check_material(reader, config, i);
        check_sizes(reader, config, i);
        check_shape(reader, config, i);
    }
    check_names(reader, &config->particles);
    check_shares(reader, &config->particles);
}
