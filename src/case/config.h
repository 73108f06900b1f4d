/// What the user said, in SI units, after the schema (`case/schema.c`) has checked it. One struct a section of the case
/// file; the schema table holds the offset of every member, so nothing else knows how a case file looks.
/// A member whose default is `auto` is NAN (numbers) or 0 (counts) until `model_build` resolves it.
#ifndef SCREE_CASE_CONFIG_H
#define SCREE_CASE_CONFIG_H

#include "base/schedule.h"
#include "module/boundary.h"
#include "module/preparation.h"
#include "module/shape.h"
#include "module/size_distribution.h"
#include "module/source.h"
#include "module/stage.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

/// In the place of a material: a wall that does not deform.
#define SCREE_RIGID "rigid"

typedef struct scree_config_material {
    char *name;
    double young_modulus; ///< Pa
    double poisson_ratio; ///< 1
    double density;       ///< kg/m3
    double friction;      ///< 1, grain on grain
    double wall_friction; ///< 1, grain on plate; auto: friction
    char *wall_material;  ///< what plates and walls are made of for it: a name, or SCREE_RIGID; auto (NULL): like it
    void *own;            ///< structs of modules (scree_config_own)
} scree_config_material;

/// What shares of species are of.
typedef enum scree_share_by { SCREE_SHARE_BY_NUMBER, SCREE_SHARE_BY_MASS, SCREE_SHARE_BY_COUNT } scree_share_by;

enum { SCREE_MOST_SPECIES = 16 };

/// Particles of one kind.
typedef struct scree_config_species {
    char *name;
    char *material;   ///< name in `materials`
    double share;     ///< 1, of the number or of the mass of all particles
    int64_t count;    ///< with SCREE_SHARE_BY_COUNT
    int shape;        ///< slot of a module that is a shape; SCREE_CHOICE_AUTO: that of all particles
    int distribution; ///< slot of a module with sizes (module/size_distribution.h)
    void *own;        ///< structs of modules (scree_config_own)
} scree_config_species;

/// Either one kind of particles, which material, distribution and own describe, or several species.
typedef struct scree_config_particles {
    int shape;      ///< slot of a module that is a shape
    char *material; ///< name in `materials`
    int64_t count;
    int distribution; ///< slot of a module with sizes
    double thickness; ///< m, length of a disc (a cylinder), not used by spheres; auto: twice the mean radius
    int share_by;     ///< scree_share_by
    scree_config_species *species;
    int64_t species_count; ///< 0: one kind
    void *own;             ///< structs of modules
} scree_config_particles;

enum { SCREE_MOST_PAIR_LAWS = 16 };

/// The law of contacts of two materials, where it is not that of `contact`.
typedef struct scree_config_pair_law {
    char *one, *other; ///< names in `materials`, or SCREE_RIGID; other: NULL: the same
    int law;           ///< slot of a module with a law
    void *own;         ///< structs of modules (scree_config_own)
} scree_config_pair_law;

typedef struct scree_config_contact {
    int law;                   ///< slot of a module with a law
    double reference_velocity; ///< m/s, v_R; auto: 2 * rate * mean radius of the first compress stage
    scree_config_pair_law *pairs;
    int64_t pair_count;
    void *own; ///< structs of modules
} scree_config_contact;

typedef struct scree_config_integrator {
    int scheme;           ///< slot of a module with an integrator
    double step;          ///< s, the small one of a scheme that has two; auto: step_fraction * critical step, over N_S
    double step_fraction; ///< 1, of the critical step, when step is auto
    void *own;            ///< structs of modules (scree_config_own)
} scree_config_integrator;

/// Mask of periodic directions.
enum {
    SCREE_PERIODIC_NONE = 0,
    SCREE_PERIODIC_X = 1,
    SCREE_PERIODIC_Y = 2,
    SCREE_PERIODIC_XY = 3,
    SCREE_PERIODIC_Z = 4,
    SCREE_PERIODIC_XZ = 5,
    SCREE_PERIODIC_YZ = 6,
    SCREE_PERIODIC_XYZ = 7
};

typedef struct scree_config_boundary {
    int periodic;          ///< SCREE_PERIODIC_...
    int lateral;           ///< slot of what holds the sides until a stage chooses its own boundary
    int64_t every;         ///< steps between two updates of the Delaunay boundary
    double gap_limit;      ///< 1, boundary edges with a free gap above this many mean diameters are cut
    double gap_hysteresis; ///< 1, share of the limits by which a facet stays, or stays away (search/peel_rule.h)
    double servo_gain;     ///< 1, admittance of a plate under servo over that of the sample (1: absorbs waves)
    double servo_velocity; ///< m/s, largest plate velocity under servo; auto
    void *own;             ///< structs of modules (scree_config_own)
} scree_config_boundary;

/// What the sample looks like: it fills its box, or has been cut out of a larger packing.
typedef enum scree_sample_outline { SCREE_SAMPLE_BOX, SCREE_SAMPLE_CIRCLE, SCREE_SAMPLE_BALL } scree_sample_outline;

/// What the stage says that places the particles. Behind it lie the structs of methods.
typedef struct scree_prepare_config {
    int method;          ///< slot of a module with a preparation
    double aspect_ratio; ///< 1, height over width of the box
    int outline;         ///< scree_sample_outline
    double width;        ///< m; auto: from count, sizes and aspect ratio
    double depth;        ///< m, 3D only; auto: the width
} scree_prepare_config;

/// What acts on the bodies beside contacts and the boundary. What stands in `own` is said by the module of its kind.
typedef struct scree_config_load {
    int kind;  ///< slot of a module that is a load
    void *own; ///< its struct
} scree_config_load;

enum { SCREE_SOURCES = 16 }; ///< most of a case

/// How many grains a source lets go at once.
typedef enum scree_source_batch { SCREE_SOURCE_ONE, SCREE_SOURCE_LAYER } scree_source_batch;

/// Where grains come from while a stage pours. What stands in `own` is said by the module of its kind.
typedef struct scree_config_source {
    int kind;           ///< slot of a module that is a source (module/source.h)
    char *name;         ///< unique among the sources: the kind, numbered if there are several
    char *stage;        ///< name of the only stage that it pours in; auto (NULL): all that pour
    char *species;      ///< name of the only species that it pours; auto (NULL): as `particles` says
    int64_t count;      ///< at most; 0: as many as there are
    double interval;    ///< s, between two births or layers
    int batch;          ///< scree_source_batch
    int64_t layer;      ///< grains of a layer; 0: as many as lie side by side
    double velocity[3]; ///< m/s, of a grain that is born
    double spread[3];   ///< m/s, by how much each component may differ at most
    double turn;        ///< rad, a grain is turned by a random angle up to this, either way
    double above;       ///< m, from the top of the pile to the lowest point of a grain; auto (NAN): the place stays
    double motion[3];   ///< m/s, of the source itself
    double shift[3];    ///< m, of each layer against the one before
    void *own;          ///< its struct
} scree_config_source;

enum { SCREE_SELECTIONS = 32 }; ///< most of a case

/// Some of the grains, under a name. What stands in `own` is said by the module of its kind.
typedef struct scree_config_selection {
    int kind;   ///< slot of a module that selects
    char *name; ///< unique among the selections
    void *own;  ///< its struct
} scree_config_selection;

/// One stage. What stands in `own` is said by the module of its kind.
typedef struct scree_config_stage {
    int kind;        ///< slot of a module with a stage
    char *name;      ///< unique among the stages: the kind, numbered (compress_1, compress_2) if there are several
    int boundary;    ///< slot of a module with a boundary; SCREE_CHOICE_AUTO: as in the stage before
    double friction; ///< 1, friction during this stage; auto: the material's
    scree_schedule gravity[3]; ///< m/s2, by time since its begin; auto: that of the case
    void *own;                 ///< struct of its kind, and of what else adds keys to it (scree_config_own)
} scree_config_stage;

/// A wall beside the six plates (shape/wall_set.h). What stands in `own` is said by the module of its shape.
typedef struct scree_config_wall {
    int shape;                      ///< slot of a module with a shape of walls (module/wall_shape.h)
    char *name;                     ///< unique among the walls
    char *material;                 ///< name, or SCREE_RIGID; auto (NULL): wall_material of the grain's material
    double friction;                ///< 1; auto: the material's friction on plates
    int motion;                     ///< scree_wall_motion_kind (case/wall_motion.h)
    scree_schedule velocity[3];     ///< m/s, by time of the walls
    scree_schedule displacement[3]; ///< m, from where its shape is given
    double amplitude[3];            ///< m: vibration
    double frequency, phase;        ///< 1/s, rad: vibration
    double direction[3];            ///< servo: in which it presses, any length
    scree_schedule force;           ///< N: servo, along its direction
    double area;                    ///< m2, that it presses with; auto: `face`
    double face;                    ///< m2, in 2D m: its shape seen along `direction`; 0: it has no end (the rules)
    double servo_gain;              ///< 1, admittance of the servo over that of the grains
    double servo_velocity;          ///< m/s, of a wall under servo at most; auto
    double spin[3];                 ///< rad/s
    double centre[3];               ///< m, about which it turns, at the begin
    void *own;                      ///< struct of its shape
} scree_config_wall;

enum { SCREE_SURFACES = 16 }; ///< walls of a case

typedef struct scree_config_window {
    double from; ///< axial strain
    double to;
} scree_config_window;

typedef struct scree_config_measure {
    int64_t samples;              ///< rows of series.csv per loading stage
    scree_config_window *windows; ///< strain windows of the displacement fluctuations
    int64_t window_count;
    bool cells; ///< Delaunay cells in snapshots, their averages and shear bands
    void *own;  ///< structs of modules (scree_config_own)
} scree_config_measure;

typedef struct scree_config_output {
    int64_t snapshots;          ///< per loading stage, evenly in strain
    double checkpoint_interval; ///< s of wall time between two checkpoints
    int64_t checkpoint_steps;   ///< and/or steps between two checkpoints; 0: wall time only
    bool figures;
    bool paraview;
} scree_config_output;

typedef struct scree_config_guard {
    double overlap;       ///< 1, largest overlap over the smaller radius
    double energy_growth; ///< 1, largest energy-ledger residual over all energy that there is and was
    int stability;        ///< scree_guard_stability
} scree_config_guard;

/// What happens to a run that is above a limit of stability.
typedef enum scree_guard_stability { SCREE_STABILITY_STOPS, SCREE_STABILITY_WARNS } scree_guard_stability;

struct scree_config {
    int64_t language; ///< version of the case language
    char *name;
    char *title;
    int64_t dimension; ///< 2 or 3
    int64_t seed;
    scree_schedule gravity[3]; ///< m/s2, by time of the run
    scree_config_material *materials;
    int64_t material_count;
    scree_config_particles particles;
    scree_config_contact contact;
    scree_config_integrator integrator;
    scree_config_boundary boundary;
    scree_config_wall *walls;
    int64_t wall_count;
    scree_config_source *sources;
    int64_t source_count;
    scree_config_selection *selections;
    int64_t selection_count;
    scree_config_load *loads;
    int64_t load_count;
    scree_config_stage *stages;
    int64_t stage_count;
    scree_config_measure measure;
    scree_config_output output;
    scree_config_guard guard;
};

/// A copy of the stages whose own structs may be changed, as one piece of memory. Errors: memory.
scree_status scree_config_copy_stages(const scree_config *config, scree_config_stage **stages,
                                      scree_error *error) SCREE_MUST_USE;

/// Whether a vector that a schedule may give was left open: `auto`.
static inline bool scree_config_is_open(const scree_schedule *given)
{
    return isnan(given[0].value);
}

/// A bound of each component of gravity in all stages, at all times [m/s2].
static inline void scree_config_largest_gravity(const scree_config *config, double largest[3])
{
    for (int k = 0; k < 3; k++) {
        largest[k] = scree_schedule_largest(&config->gravity[k]);
        for (int64_t i = 0; i < config->stage_count; i++)
            if (!scree_config_is_open(config->stages[i].gravity))
                largest[k] = fmax(largest[k], scree_schedule_largest(&config->stages[i].gravity[k]));
    }
}

/// Whether there is gravity at any time.
static inline bool scree_config_has_gravity(const scree_config *config)
{
    double largest[3];
    scree_config_largest_gravity(config, largest);
    return largest[0] > 0 || largest[1] > 0 || largest[2] > 0;
}

/// The struct of `module` among those of modules that a section's `own` points to. section: its path ("integrator"), as
/// the module's `keys` have it. NULL: there are none.
const void *scree_config_own(const scree_module *module, const char *section, const void *own);

/// Number of the law of contacts between two materials, or of a material and SCREE_RIGID, by name: that of an element
/// of contact.pairs, plus 1; 0: that of `contact`.
int scree_config_law_between(const scree_config_contact *contact, const char *one, const char *other);

/// Slot of the law with this number; SCREE_CHOICE_WRONG: that was wrong, and noted.
static inline int scree_config_law(const scree_config_contact *contact, int number)
{
    return number > 0 ? contact->pairs[number - 1].law : contact->law;
}

/// What the case says to it: the struct that the law's module fills from its keys under `contact`, or in the element of
/// contact.pairs.
const void *scree_config_law_keys(const scree_config_contact *contact, int number);

/// Index of the selection of this name among `count`; -1: there is none.
int64_t scree_config_selection_find(const scree_config_selection *selections, int64_t count, const char *name);

/// Particles of one kind, by number: the species, or all of them where none are listed.
static inline scree_config_species scree_config_species_at(const scree_config_particles *particles, int64_t index)
{
    if (particles->species_count > 0) return particles->species[index];
    return (scree_config_species){.material = particles->material,
                                  .share = 1,
                                  .count = particles->count,
                                  .shape = particles->shape,
                                  .distribution = particles->distribution,
                                  .own = particles->own};
}

/// How many there are, at least one.
static inline int64_t scree_config_species_count(const scree_config_particles *particles)
{
    return particles->species_count > 0 ? particles->species_count : 1;
}

/// What the distribution of sizes of species `index` reads: the struct of its module.
static inline const void *scree_config_sizes(const scree_config_particles *particles, int64_t index)
{
    scree_config_species species = scree_config_species_at(particles, index);
    return scree_config_own(scree_modules[species.distribution],
                            particles->species_count > 0 ? "particles.species" : "particles", species.own);
}

/// Shape of species `index`, and what it reads: the struct of its module.
static inline int scree_config_shape(const scree_config_particles *particles, int64_t index)
{
    const int shape = scree_config_species_at(particles, index).shape;
    return shape >= 0 && scree_modules[shape]->shape ? shape : particles->shape;
}

static inline const void *scree_config_shape_keys(const scree_config_particles *particles, int64_t index)
{
    const bool own = particles->species_count > 0 &&
                     scree_config_shape(particles, index) == scree_config_species_at(particles, index).shape;
    return scree_config_own(scree_modules[scree_config_shape(particles, index)],
                            own ? "particles.species" : "particles",
                            own ? particles->species[index].own : particles->own);
}

/// What a stage says that places the particles.
static inline const scree_prepare_config *scree_config_prepared(const scree_config_stage *stage)
{
    return stage->own;
}

/// The stage that places the particles, with which a case begins; NULL: there is none, or its method is wrong.
static inline const scree_config_stage *scree_config_prepare(const scree_config *config)
{
    const scree_config_stage *first = config->stages;
    bool places = config->stage_count > 0 && first->kind >= 0 && scree_modules[first->kind]->numbers->places;
    return places && scree_config_prepared(first)->method >= 0 ? first : NULL;
}

/// Its method; NULL: there is none.
static inline const scree_preparation *scree_config_preparation(const scree_config *config)
{
    const scree_config_stage *stage = scree_config_prepare(config);
    return stage ? scree_modules[scree_config_prepared(stage)->method]->preparation : NULL;
}

/// Slot of the boundary of stage `index`: the one that the case leaves it, else its own choice, or that of the last
/// stage before it that made one, or the walls of the case, or `lateral`. SCREE_CHOICE_WRONG: that was wrong, and
/// noted.
int scree_config_boundary_of(const scree_config *config, int64_t index);

/// Its face; NULL: it was wrong.
static inline const scree_boundary *scree_config_held_by(const scree_config *config, int64_t index)
{
    int slot = scree_config_boundary_of(config, index);
    return slot >= 0 ? scree_modules[slot]->boundary : NULL;
}

/// The sample is periodic in all directions of space.
static inline bool scree_config_is_wholly_periodic(const scree_config *config)
{
    return config->boundary.periodic > 0 && config->boundary.periodic == (1 << config->dimension) - 1;
}

/// The sample is periodic along its axis: nothing stands below and above it.
static inline bool scree_config_axis_repeats(const scree_config *config)
{
    return config->boundary.periodic > 0 && config->boundary.periodic >> (config->dimension - 1) & 1;
}

#endif
