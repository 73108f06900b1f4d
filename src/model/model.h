/// The immutable description of a run, resolved from a config: every `auto` has become a number, materials have become
/// constants per pair of materials. Built once; nothing below the stage driver may change it. The model of a stage that
/// has its own friction is a copy (friction.c).
#ifndef SCREE_MODEL_MODEL_H
#define SCREE_MODEL_MODEL_H

#include "model/law.h"
#include "module/geometry.h"
#include "module/module.h"

#include <math.h>

#define SCREE_MAX_MATERIALS 16

/// Particles of one kind, resolved.
typedef struct scree_species {
    const char *name;                            ///< NULL: all particles are of one kind
    int material;                                ///< number of what they are made of
    const scree_size_distribution *distribution; ///< of their radii
    const void *sizes;                           ///< its keys, in the config
    const scree_shape *shape;
    const void *outline; ///< its keys, in the config
    scree_size_moments radius;
    double fraction; ///< of the number of all particles
    uint64_t end;    ///< this and all species before it are as many of the particles of a case
} scree_species;

/// The law of pairs that are held together (state/persistent.h): that of the contacts, where it can hold.
typedef struct scree_persistent_law {
    scree_law_use law; ///< under an option that holds; else there is none
    scree_pair_constants pairs[SCREE_MAX_MATERIALS][SCREE_MAX_MATERIALS];
} scree_persistent_law;

/// How the Delaunay boundary is kept.
typedef struct scree_upkeep {
    uint64_t every;    ///< ticks between two updates
    double gap_limit;  ///< 1, boundary edges with a free gap above this many mean diameters are cut
    double hysteresis; ///< 1, share of the limits by which a facet stays, or stays away (search/peel_rule.h)
} scree_upkeep;

/// Servos of plates and cells.
typedef struct scree_servo_limits {
    double gain;     ///< 1, admittance over that of the sample (1: absorbs waves)
    double velocity; ///< m/s, largest of a plate or face; INFINITY: none
    double travel;   ///< m, most in a step; INFINITY: none
} scree_servo_limits;

struct scree_model {
    const char *name;         ///< of the case
    const scree_shape *shape; ///< of the first species; NULL: of no case, and round
    int geometry;             ///< number of the geometry of their contacts (contact/geometry.h)
    uint64_t seed;
    uint64_t count;    ///< particles of the case
    unsigned periodic; ///< bit k: the sample repeats itself in direction k
    int dimension;
    double thickness;                             ///< m, length of the discs; 1 in 3D
    scree_law_use laws[1 + SCREE_MOST_PAIR_LAWS]; ///< how contacts resist: as `contact` says, and behind it
    int pair_laws;                                ///< those of single pairs of materials; so many
    double reference_velocity;                    ///< m/s, v_R
    int scheme;                                   ///< slot of the integrator's module
    double step;             ///< s, the tick: the small step of two_timescales, the step of all other schemes
    uint64_t largest_step;   ///< ticks, N_S of two_timescales (the step before loading), else 1
    uint64_t large_multiple; ///< ticks, n of two_timescales, else 1
    uint64_t small_steps;    ///< q of two_timescales, else 0
    double critical_step;    ///< s, estimate at the confining pressure (see model.c)
    double gravity[3];       ///< m/s2; of a stage's copy what acts at the step that its state is at (load/gravity.h)
    const scree_schedule *gravity_of_case; ///< m/s2, three components by time of the run
    scree_species species[SCREE_MOST_SPECIES];
    int species_count;
    double mean_radius;            ///< m, of all particles, by number
    double mean_square, mean_cube; ///< m2, m3, of R^2 and R^3
    double radius_min, radius_max; ///< m
    double bounding_max;           ///< m, largest bounding radius
    double phi, psi; ///< quasistatic and size coefficients (P 2.13, 2.14, B1), NAN without a loading stage
    int listed[SCREE_MAX_MATERIALS]; ///< where each material stands in the list of the case
    int material_count; ///< in use; they are numbered from 0, and what no body is made of has no part in anything
    scree_pair_constants pairs[SCREE_MAX_MATERIALS][SCREE_MAX_MATERIALS]; ///< grain on grain
    scree_pair_constants walls[SCREE_MAX_MATERIALS];                      ///< grain on a plate
    scree_pair_constants surfaces[SCREE_SURFACES][SCREE_MAX_MATERIALS];   ///< on each wall of the case
    uint8_t law_of_pairs[SCREE_MAX_MATERIALS][SCREE_MAX_MATERIALS];       ///< in the same places: numbers in `laws`
    uint8_t law_of_walls[SCREE_MAX_MATERIALS];
    uint8_t law_of_surfaces[SCREE_SURFACES][SCREE_MAX_MATERIALS];
    scree_persistent_law persistent;
    int added_materials;   ///< behind those in use: of bodies that modules add
    double added_radius;   ///< m, largest of such bodies
    uint32_t frictionless; ///< bit m: material m has no friction with anything, in no stage
    double density[SCREE_MAX_MATERIALS];
    scree_upkeep upkeep;
    scree_servo_limits servo;
    double largest_gain;  ///< 1, that the geometry of contacts can have (contact/kinematics.h); 1, or 0: it has none
    double overlap_limit; ///< 1, largest overlap over the smaller radius
    double energy_growth; ///< 1, largest residual of the ledger over all energy that there is and was
    bool stability_warns; ///< above a limit of stability a run goes on with a warning
    scree_config_measure measure;
    scree_config_output output;

    // ---- numbers of modules, in one block without pointers, so that the model can be copied ----
    _Alignas(16) unsigned char numbers[1024];
    size_t numbers_end;
    uint16_t number_at[SCREE_MODULE_COUNT]; ///< place of those of each module, plus 1; 0: none

    // ---- lists of the case; what an element says beside is for the module of its kind ----
    const scree_config_wall *walls_of_case;
    int64_t wall_count;
    const scree_config_source *sources;
    int64_t source_count;
    const scree_config_selection *selections;
    int64_t selection_count;
    const scree_config_load *loads;
    int64_t load_count;
    const scree_config_stage *stages;
    int64_t stage_count;
    const scree_config *config; ///< what the user said; outlives the model; read by what resolves a model alone
};

/// Boundary of stage `index`.
const scree_boundary *scree_model_boundary_of(const scree_model *model, int64_t index);

/// Resolves `config` into `model`. Errors: SCREE_ERROR_INPUT with the field for anything that only shows when values
/// meet: a step above the critical one (names it and offers it), a packing that cannot fit, a material that does not
/// exist.
scree_status scree_model_build(const scree_config *config, scree_model *model, scree_error *error) SCREE_MUST_USE;

/// The sample is periodic in all directions of space.
bool scree_model_is_wholly_periodic(const scree_model *model);

/// What the case says of the material with this number; for what resolves a model alone.
static inline const scree_config_material *scree_model_material_said(const scree_model *model, int material)
{
    return &model->config->materials[model->listed[material]];
}

/// Largest normal stress that a stage holds [Pa, compression positive], NAN when it holds none.
double scree_held_pressure(const scree_config_stage *stage);

/// Laws of contacts, at least one.
static inline int scree_model_law_count(const scree_model *model)
{
    return 1 + model->pair_laws;
}

/// That of all pairs of materials without one of their own.
static inline const scree_law *scree_model_law(const scree_model *model)
{
    return scree_law_get(model->laws[0].law);
}

static inline const scree_law_traits *scree_model_traits(const scree_model *model)
{
    return scree_law_use_traits(&model->laws[0]);
}

/// The law of contacts of two materials; of one on plates; on a wall of the case.
static inline const scree_law_use *scree_model_law_between(const scree_model *model, int one, int other)
{
    return &model->laws[model->law_of_pairs[one][other]];
}

static inline const scree_law_use *scree_model_law_on_plate(const scree_model *model, int material)
{
    return &model->laws[model->law_of_walls[material]];
}

static inline const scree_law_use *scree_model_law_on_wall(const scree_model *model, int64_t wall, int material)
{
    return &model->laws[model->law_of_surfaces[wall][material]];
}

/// Whether pairs may be held together.
static inline bool scree_model_holds(const scree_model *model)
{
    const scree_law *law = scree_law_get(model->persistent.law.law);
    return law && law->traits[model->persistent.law.option].holds;
}

static inline const scree_law_traits *scree_model_held_traits(const scree_model *model)
{
    return &scree_law_get(model->persistent.law.law)->traits[model->persistent.law.option];
}

/// Whether a law looks ahead by a step and needs scree_state_predict.
static inline bool scree_model_predicts(const scree_model *model)
{
    bool ahead = false;
    for (int k = 0; k < scree_model_law_count(model); k++)
        ahead = ahead || scree_law_use_traits(&model->laws[k])->looks_ahead;
    return ahead;
}

/// Gap [m] beyond which no neck of two bodies reaches (the trait `necks` of laws); 0: there are none.
static inline double scree_model_reach(const scree_model *model)
{
    double reach = 0;
    for (int k = 0; k < scree_model_law_count(model); k++) reach = fmax(reach, scree_law_use_reach(&model->laws[k]));
    return reach;
}

/// Normal stiffness [N/m] of a contact of two mean particles under the force pressure x diameter x depth.
double scree_model_stiffness(const scree_model *model, double pressure, double diameter, double depth);

/// Largest bounding radius of all bodies [m], those of a membrane included.
double scree_model_largest_radius(const scree_model *model);

/// Mass [kg] of a body of this equivalent radius: a sphere, or a disc or prism of the model's thickness.
static inline double scree_model_mass(const scree_model *model, int material, double radius)
{
    double length = model->dimension == 3 ? 4.0 / 3.0 * radius : model->thickness;
    return model->density[material] * M_PI * radius * radius * length;
}

/// Shape of the particles; of a model that is of no case a round one.
const scree_shape *scree_model_shape(const scree_model *model);

/// Means over all particles, by number: mass [kg]; area [m2] in 2D, volume [m3] in 3D.
double scree_model_mean_mass(const scree_model *model);
double scree_model_mean_solid(const scree_model *model);

/// Density [kg/m3] of all particles together, mass over volume.
double scree_model_mean_density(const scree_model *model);

/// Contacts of two particles taken at random, those under one of the laws: which share of all they are, and their mean
/// constants.
typedef struct scree_mean_pair {
    double share;
    scree_pair_constants constants;
} scree_mean_pair;
scree_mean_pair scree_model_mean_pair(const scree_model *model, int law);

/// Mean over them of a closed form of their laws: `of` at an effective radius [m] and an argument.
double scree_model_mean_of(const scree_model *model,
                           double (*of)(const scree_elastic *elastic, const scree_pair_constants *pair, double radius,
                                        double argument),
                           double effective_radius, double argument);

/// Young's modulus [Pa] of a particle, mean by number. Where the
/// case gives stiffnesses of springs, the modulus that grains of the mean radius would have with these.
double scree_model_mean_modulus(const scree_model *model);
/// The key of materials that it comes from; NULL: young_modulus.
const char *scree_model_modulus_key(const scree_model *model);

/// Radius [m] that stands for all in estimates of the size of a sample: the mean one where sizes are narrow, else that
/// of the mean area (volume).
double scree_model_filling_radius(const scree_model *model);

/// Species and radius [m] of body `number` as they are drawn: pure functions of the seed and this number, whatever else
/// is drawn and in which order (model/species.c).
int scree_model_drawn_species(const scree_model *model, uint64_t number);
double scree_model_drawn_radius(const scree_model *model, uint64_t number);
/// Bounding radius [m] of it: that of a round body is its radius.
double scree_model_drawn_bound(const scree_model *model, uint64_t number);
/// The same of body `number` as one of this species.
double scree_model_radius_of_species(const scree_model *model, int species, uint64_t number);
double scree_model_bound_of_species(const scree_model *model, int species, uint64_t number);

/// Moments, fractions and numbers of the species, once the materials are numbered. Errors: sizes that are not.
scree_status scree_model_resolve_species(scree_model *model, scree_error *error) SCREE_MUST_USE;

/// Strain rate that a stage imposes [1/s]; of a deform stage the largest component. NAN: it loads nothing.
double scree_model_loading_rate(const scree_model *model, const scree_config_stage *stage);

/// Number of the material of this name, NULL that of the first species; -1: the case has none of that name.
int scree_model_material(const scree_model *model, const char *name);

/// Takes every resistance of a material away, for good.
void scree_model_make_frictionless(scree_model *model, int material);

/// Zeroed room for the numbers of a module (`numbers_size`), which it fills when the model is resolved.
void *scree_model_reserve_numbers(scree_model *model, int slot);

/// They; NULL: the module has not been resolved, as nothing in the case has it.
const void *scree_model_numbers(const scree_model *model, int slot);

/// The model of a stage with this friction; NAN: its own (friction.c).
scree_model scree_model_with_friction(const scree_model *model, double friction);

/// The model of a stage: its friction, and how its laws integrate it.
scree_model scree_model_of_stage(const scree_model *model, const scree_config_stage *stage);

#endif
