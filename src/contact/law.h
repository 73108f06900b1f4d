/// What a force law is given and what it gives back, in lanes. A law is one always-inline function
///   law_force NAME(variant, constants, settings, motion, touching, before, after)
/// in a header of its own, NAME.h, with its traits (NAME_traits, one for each value of the option) and its kernels
/// (NAME_KERNELS, row(NAME, option, one or many materials)); its module, with its descriptor (model/law.h), is
/// scree_module_NAME in NAME.c. module/table.h lists them. Lanes that do not touch come out zero, in the ledger too
/// (but for what a contact that opens held): one without a pair repeats another pair, overlap and all, without its
/// memory.
#ifndef SCREE_CONTACT_LAW_H
#define SCREE_CONTACT_LAW_H

#include "contact/kinematics.h"
#include "state/state.h"

/// What evaluations are specialised by: constants in the kernels, runtime values in the scalar reference.
typedef struct variant {
    int dimension;
    int law;         ///< slot of its module
    unsigned option; ///< bits whose meaning the law declares
    bool many_materials;
    bool moments; ///< of contact forces are summed
    int geometry; ///< its number (contact/geometry.h)
} variant;

/// Constants of the pair of materials, one value a lane: model/law.h, scree_pair_constants. Those of the second half
/// are there with the trait `wide` only.
typedef struct law_constants {
    lanes value[SCREE_PAIR_CONSTANTS];
    lanes own[SCREE_MEMBER_CONSTANTS]; ///< of the pair alone, with the trait `holds` only
} law_constants;

/// Numbers of the whole run.
typedef struct law_settings {
    double step;                      ///< s; 0 evaluates without advancing histories (contact table)
    double number[SCREE_LAW_NUMBERS]; ///< scree_law_use
} law_settings;

/// The rows that a contact remembers, in lanes: scree_history, scree_last_force, scree_rolling.
typedef struct law_memory {
    lanes value[SCREE_HISTORY];
    lanes last[4];
    lanes rolling[4], rolling_last[4];
} law_memory;

typedef struct law_force {
    lanes normal;                       ///< N, along n, on first
    vector tangential;                  ///< N, on first: along t, or in the tangent plane
    vector couple;                      ///< N m, of rolling and twisting resistance, on first
    lanes damping, friction, stiffness; ///< J, ledger increments of this step
    lanes loose_normal; ///< N, with the trait `deforms`: the part of the normal force that does not strain the bodies
    vector loose;       ///< N, the same of the tangential one
    lanes deformation;  ///< m, with the trait `holds`: from it the law bounds its forces
    lanes_bits in_contact; ///< mask, with `holds` or `necks`: there may be a force
    lanes adhesion;        ///< N, with `necks` or `pulls`: what friction is limited with beside the normal force
    lanes_bits settle;     ///< mask, with `holds`: it breaks, or is broken and has parted
    lanes elastic_normal, elastic_tangential; ///< J; the springs of rolling and twisting count as tangential
} law_force;

#endif
