/// Padbidri's biaxial case as a config, for tests that start below the case language.
#ifndef SCREE_TEST_BIAXIAL_CONFIG_H
#define SCREE_TEST_BIAXIAL_CONFIG_H

#include "law_choice.h"
#include "own_config.h"
#include "prepare/gas.h"
#include "prepare/growth.h"
#include "run/stage_compress.h"
#include "run/stage_confine.h"
#include "size/equal.h"
#include "size/limits.h"

#include <math.h>

typedef struct biaxial_config {
    scree_config config;
    scree_config_material material[2];
    scree_config_stage stage[3];
    own_block own[3]; ///< of the stages
    own_block sizes;  ///< of the particles
    char quartz[8], steel[8];
    own_block contact, of_material[2];
} biaxial_config;

/// What law hertz_mindlin reads of a material.
static inline scree_mindlin_material *biaxial_material(biaxial_config *c, int material)
{
    return OWN(c->of_material[material].bytes, scree_mindlin_material, hertz_mindlin, "materials");
}

static inline scree_prepare_config *biaxial_prepare(biaxial_config *c)
{
    return c->stage[0].own;
}

static inline scree_confine_config *biaxial_confine(biaxial_config *c)
{
    return c->stage[1].own;
}

static inline scree_compress_config *biaxial_compress(biaxial_config *c)
{
    return c->stage[2].own;
}

static inline scree_gas_config *biaxial_gas(biaxial_config *c)
{
    return OWN(&c->own[0], scree_gas_config, gas, "stages.prepare");
}

static inline scree_growth_config *biaxial_growth(biaxial_config *c)
{
    return OWN(&c->own[0], scree_growth_config, growth, "stages.prepare");
}

/// Radii of the particles: slot of the distribution, least and largest; equal ones have the mean of both.
static inline void biaxial_sizes(biaxial_config *c, int distribution, double least, double most)
{
    const scree_size_limits limits = {least, most};
    c->config.particles.distribution = distribution;
    c->config.particles.own = &c->sizes;
    *OWN(&c->sizes, scree_size_limits, uniform, "particles") = limits;
    *OWN(&c->sizes, scree_size_limits, two_sizes, "particles") = limits;
    OWN(&c->sizes, scree_equal_config, equal, "particles")->radius = (least + most) / 2;
}

/// 30 GPa, 0.3, 2.675e8 kg/m3, friction 0.45; radii uniform in 0.5 to 1 mm; 100 kPa, 0.005 1/s; every `auto` left open.
static inline void biaxial_config_set(biaxial_config *c, int64_t count)
{
    *c = (biaxial_config){.quartz = "quartz", .steel = "steel"};
    c->material[0] = (scree_config_material){.name = c->quartz,
                                             .young_modulus = 30e9,
                                             .poisson_ratio = 0.3,
                                             .density = 2.675e8,
                                             .friction = 0.45,
                                             .wall_friction = NAN,
                                             .own = c->of_material[0].bytes};
    c->material[1] = (scree_config_material){.name = c->steel,
                                             .young_modulus = 200e9,
                                             .poisson_ratio = 0.25,
                                             .density = 8e3,
                                             .friction = 0.3,
                                             .wall_friction = 0.1,
                                             .own = c->of_material[1].bytes};
    biaxial_material(c, 0)->restitution = 0.2;
    biaxial_material(c, 1)->restitution = 0.6;
    *OWN(c->contact.bytes, scree_brilliantov_config, hertz_brilliantov, "contact") =
        (scree_brilliantov_config){.damping_time = 0.002, .friction_exponent = 50};
    c->stage[0] = (scree_config_stage){.kind = SCREE_SLOT_prepare, .boundary = SCREE_CHOICE_AUTO, .own = &c->own[0]};
    *biaxial_prepare(c) =
        (scree_prepare_config){.method = SCREE_SLOT_drop_and_roll, .aspect_ratio = 2, .width = NAN, .depth = NAN};
    *biaxial_gas(c) = (scree_gas_config){.solid_fraction = 0.4, .velocity = 0.1};
    *biaxial_growth(c) = (scree_growth_config){.solid_fraction = 0.4};
    c->stage[1] = (scree_config_stage){.kind = SCREE_SLOT_confine, .boundary = SCREE_CHOICE_AUTO, .own = &c->own[1]};
    *biaxial_confine(c) = (scree_confine_config){.pressure = 100e3};
    c->stage[2] = (scree_config_stage){.kind = SCREE_SLOT_compress, .boundary = SCREE_CHOICE_AUTO, .own = &c->own[2]};
    *biaxial_compress(c) = (scree_compress_config){.strain = 0.1, .rate = 5e-3};
    c->config = (scree_config){
        .dimension = 2,
        .seed = 1,
        .materials = c->material,
        .material_count = 2,
        .particles = {.shape = SCREE_SLOT_disc, .material = c->quartz, .count = count, .thickness = NAN},
        .contact = {.law = SCREE_SLOT_hertz_brilliantov, .reference_velocity = NAN, .own = c->contact.bytes},
        .integrator = {.scheme = SCREE_SLOT_position_verlet, .step = NAN, .step_fraction = 0.5},
        .boundary = {.lateral = SCREE_SLOT_pressure_boundary},
        .stages = c->stage,
        .stage_count = 3,
        .guard = {.overlap = 0.1, .energy_growth = 1e-3},
    };
    biaxial_sizes(c, SCREE_SLOT_uniform, 0.5e-3, 1e-3);
}

#endif
