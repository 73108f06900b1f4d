/// What a case says of bodies that it lists.
#ifndef SCREE_PREPARE_BODIES_H
#define SCREE_PREPARE_BODIES_H

#include "case/config.h"

typedef struct scree_listed_body {
    double position[3]; ///< m, of its centre
    double velocity[3]; ///< m/s
    double spin[3];     ///< rad/s
    double angle;       ///< rad, in two dimensions
    double radius;      ///< m, of equal area; auto: that of all particles
    char *material;     ///< name in `materials`; auto: that of the particles
} scree_listed_body;

typedef struct scree_bodies_config {
    double height; ///< m, of the box; auto: up to the highest of them
    scree_listed_body *bodies;
    int64_t body_count;
} scree_bodies_config;

/// What the stage of a case lists, whose method it is.
static inline const scree_bodies_config *scree_bodies_of(const scree_config_stage *stage)
{
    return scree_config_own(&scree_module_bodies, "stages.prepare", stage->own);
}

/// Sizes of the particles of a case; all zero where the case does not say which.
static inline scree_size_moments scree_listed_sizes(const scree_config *config)
{
    const scree_config_species species = scree_config_species_at(&config->particles, 0);
    const scree_size_distribution *sizes =
        species.distribution >= 0 && species.own ? scree_modules[species.distribution]->sizes : NULL;
    if (!sizes) return (scree_size_moments){0};
    return sizes->moments(scree_config_sizes(&config->particles, 0), (int)config->dimension);
}

/// Whether all particles have one radius.
static inline bool scree_listed_equal(const scree_config *config)
{
    const int distribution = scree_config_species_at(&config->particles, 0).distribution;
    const scree_size_distribution *sizes = distribution >= 0 ? scree_modules[distribution]->sizes : NULL;
    return sizes && sizes->equal;
}

/// Radius [m] of a listed body.
static inline double scree_listed_radius(const scree_config *config, const scree_listed_body *body)
{
    return isnan(body->radius) ? scree_listed_sizes(config).least : body->radius;
}

/// Notes what is wrong with the list: as many bodies as the case says, of its dimension, materials and sizes, inside of
/// their box, and not deeper in each other than the guard allows (bodies_rules.c).
void scree_bodies_rules(scree_reader *reader, const scree_config *config);

#endif
