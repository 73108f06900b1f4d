/// The face of a contact law. A law is a header with its always-inline function (contact/law.h), a file with its module
/// and this descriptor, and a row in module/table.h (its header is included by contact/laws.h); nothing else knows its
/// name. The model asks it for the constants of two materials and for closed forms, the kernels are specialised by its
/// traits as constants, and the search keeps the rows that it remembers.
#ifndef SCREE_MODEL_LAW_H
#define SCREE_MODEL_LAW_H

#include "case/config.h"
#include "theory/restitution.h"

enum {
    SCREE_PAIR_CONSTANTS = 8,
    SCREE_LAW_NUMBERS = 8,
    SCREE_LAW_REACH = 5,     ///< which of its numbers: m, beyond which no neck reaches; 0 without the trait `necks`
    SCREE_LAW_LOOSE = 6,     ///< which of its numbers, where bodies deform: 1 if dashpots do not strain them, else 0
    SCREE_LAW_CORRECTED = 7, ///< the same: 1 if their strains move contact points along the surfaces, too
    SCREE_FRICTION = 2,      ///< which of the constants of a pair is Coulomb's coefficient, in every law
};

/// Constants of a contact between two materials (or a grain and a wall), symmetric in the two. What they mean is the
/// law's affair, but for SCREE_FRICTION, which walls, stages and membranes may replace. Kernels load them in halves,
/// the second one where the law's traits say so (`wide`).
typedef struct scree_pair_constants {
    double value[SCREE_PAIR_CONSTANTS];
} scree_pair_constants;

/// What bodies have in common beside their materials and radii, where a law makes stiffnesses of them.
typedef struct scree_contact_space {
    int dimension;
    double thickness; ///< m, of discs; 1 in space
} scree_contact_space;

/// A law as a case uses it.
typedef struct scree_law_use {
    int law;                          ///< slot of its module
    unsigned option;                  ///< bits whose meaning the law declares; kernels are specialised by them
    double number[SCREE_LAW_NUMBERS]; ///< of the whole run; their meaning is the law's affair, too
} scree_law_use;

/// What the rest of the program must know of a law under one of its options. All of it is constant in the kernels.
typedef struct scree_law_traits {
    bool keeps_last_force[2]; ///< in 2D, 3D: last_force rows beside the history, for the ledger
    bool displacement;        ///< the history begins with a displacement in the tangent plane, which walls turn
    bool rolling;             ///< passes couples on: rolling rows
    bool looks_ahead;         ///< needs kinematics_predict
    bool pulls;               ///< the normal force may be negative
    bool necks;               ///< a contact may outlast the touch (law_force.in_contact); it remembers that it does
    bool holds;               ///< of pairs of the persistent list: no distance test, constants of the pair's own
    bool wide;                ///< reads the second half of the constants
    bool areas;               ///< forces follow from the area that bodies share: of polygons, in 2D
    uint8_t energy_at;        ///< where the history has the energy that the contact held in the last step; 0: nowhere
    bool deforms;             ///< overlaps follow the strains of the bodies (state->stretch), whose moments are summed
} scree_law_traits;

/// The elastic part of the normal force of two bodies of an effective radius [m]: closed forms of a static or undamped
/// contact.
typedef struct scree_elastic {
    double (*force)(const scree_pair_constants *pair, double effective_radius, double overlap);     ///< N, of m
    double (*overlap)(const scree_pair_constants *pair, double effective_radius, double force);     ///< m, of N
    double (*energy)(const scree_pair_constants *pair, double effective_radius, double overlap);    ///< J, of m
    double (*stiffness)(const scree_pair_constants *pair, double effective_radius, double pressure, ///< N/m, under the
                        double diameter, double depth); ///< force of all three
    double (*impact_force)(const scree_pair_constants *pair, double effective_radius, double effective_mass,
                           double speed); ///< N, the largest
    double (*impact_length)(const scree_pair_constants *pair, double effective_radius, double effective_mass,
                            double speed); ///< m, by which lengths of the impact can be scaled
} scree_elastic;

/// Stiffness [N/m] and viscosity [N s/m] of a contact under small changes of its overlap and its slip.
typedef struct scree_contact_tangent {
    double normal_stiffness, normal_damping;
    double tangential_stiffness, tangential_damping;
} scree_contact_tangent;

/// Extremes of what may meet in the next evaluation.
typedef struct scree_law_extent {
    double speed;   ///< m/s, relative
    double overlap; ///< m
    double radius;  ///< m
    double mass;    ///< kg
    double step;    ///< s
} scree_law_extent;

/// Bounds of what one contact can contribute in one evaluation.
typedef struct scree_law_bounds {
    double force;    ///< N
    double damping;  ///< J, dissipated by damping
    double friction; ///< J, the same for friction and for the stiffness channel
} scree_law_bounds;

typedef struct scree_law {
    const scree_law_traits *traits; ///< one for each value of `option`
    unsigned option_count;          ///< values of `option`
    unsigned holding;               ///< the option under which it holds pairs of the persistent list; 0: it cannot
    unsigned deforming;             ///< that under which bodies deform (`deforms`); 0: it cannot
    const scree_elastic *elastic;
    int constant_count;    ///< constants of a pair that enter the state checksum
    unsigned resistances;  ///< bits of the constants that vanish with the friction of a body
    bool needs_slip_scale; ///< does not work without model->reference_velocity
    /// What is wrong with a material under this law: a message, and in `key` which; NULL: nothing.
    const char *(*material_problem)(const scree_config_material *material, const char **key);
    /// Options that the case, or one of the materials in use, asks for. own: the struct of the law's keys under
    /// `contact`, or in an element of contact.pairs.
    unsigned (*options)(const void *own, const scree_config_material *material);
    /// The option during a stage; option: that of the case. NULL: stages do not choose.
    unsigned (*stage_options)(const void *own, const scree_config_stage *stage, unsigned option);
    /// Numbers of the whole run. reference_velocity [m/s]: v_R. NULL: none.
    void (*resolve)(const void *own, double reference_velocity, scree_law_use *use);
    /// Constants of two materials; b is NULL for something rigid.
    scree_pair_constants (*constants)(const scree_contact_space *space, const scree_config_material *a,
                                      const scree_config_material *b);
    /// What an element of contact.pairs, or `contact`, says of these constants itself. NULL: nothing.
    void (*amend)(const void *own, scree_pair_constants *pair);
    /// Gap [m] at which the neck of two bodies of an effective radius [m] breaks. NULL: without the trait `necks`.
    double (*neck)(const scree_pair_constants *pair, double effective_radius);
    /// Tabor parameter of adhesion [1] of two bodies of an effective radius [m]; 0: they do not stick. NULL: none does.
    double (*tabor)(const scree_pair_constants *pair, double effective_radius);
    /// Young's modulus [Pa] that would make grains of a material and radius [m] as stiff as they are, where its springs
    /// do not follow young_modulus; NAN where they do. NULL: they always do.
    double (*modulus)(const scree_contact_space *space, const scree_config_material *material, double radius);
    const char *modulus_key; ///< the key that sets it then
    /// Strict bounds; most: the largest of each constant over all pairs.
    scree_law_bounds (*bound)(const scree_law_use *use, const scree_pair_constants *most,
                              const scree_law_extent *extent);
    /// Tangent at a static normal force [N].
    scree_contact_tangent (*tangent)(const scree_law_use *use, const scree_pair_constants *pair,
                                     double effective_radius, double effective_mass, double force);
    /// Theory of a central impact.
    scree_status (*impact)(const scree_law_use *use, const scree_pair_constants *pair, double effective_radius,
                           double effective_mass, double speed, scree_impact *impact, scree_error *error);
    bool impact_duration;           ///< its duration is this law's; else that of the same impact without damping
    double confine_grains;          ///< duration of a confinement, see run/stage_confine.c
    double confine_falls;           ///< the same where springs do not stiffen under pressure; 0: confine_grains counts
    const char *against_stiffening; ///< key=value that keeps springs from energy that nobody spent; NULL: none does
} scree_law;

/// That of a module's slot.
static inline const scree_law *scree_law_get(int slot)
{
    return scree_modules[slot]->law;
}

/// Its traits as it is used.
static inline const scree_law_traits *scree_law_use_traits(const scree_law_use *use)
{
    return &scree_law_get(use->law)->traits[use->option];
}

/// Gap [m] beyond which no neck under it reaches; 0: it has none.
static inline double scree_law_use_reach(const scree_law_use *use)
{
    return scree_law_use_traits(use)->necks ? use->number[SCREE_LAW_REACH] : 0;
}

#endif
