/// One thread's share of a force evaluation: what a kernel reads and what it gives back. Between contact/forces.c,
/// which cuts the work, and the kernels (scree_pairs_2d_vN and scree_pairs_3d_vN for two and three dimensions:
/// one compilation of their files for each instruction set).
#ifndef SCREE_CONTACT_JOB_H
#define SCREE_CONTACT_JOB_H

#include "contact/law.h"
#include "state/plates.h"

/// Inverse quanta (base/fixed.h) of the integer sums, and the largest force they may hold.
typedef struct contact_scale {
    double inverse_force, inverse_torque;     ///< 1/N, 1/(N m)
    double inverse_damping, inverse_friction; ///< 1/J, of the ledger's damping and of its friction and stiffness
    double force_limit;                       ///< N
    double inverse_surface_torque;            ///< 1/(N m), of the torques on the walls of the case
} contact_scale;

typedef struct contact_totals {
    uint64_t damping, friction, stiffness;    ///< energy quanta, two's complement
    double largest_overlap;                   ///< m
    double largest_deformation, largest_gap;  ///< m, of pairs that are held
    bool settle;                              ///< a pair that is held breaks, or is broken and has parted
    bool in_range;                            ///< no force is NaN or above the limit of the quanta
    uint64_t wall_force[SCREE_WALL_COUNT];    ///< force quanta, normal, by the bodies
    uint64_t wall_shear[SCREE_WALL_COUNT][3]; ///< the same in the plane of the wall; 2D: the first, along t
    uint64_t surface_force[SCREE_SURFACES][3], surface_torque[SCREE_SURFACES][3]; ///< quanta, on the walls of the case
} contact_totals;

typedef struct contact_job {
    const scree_model *model;
    variant variant;
    const scree_row *row;
    const scree_turn_row *turn;       ///< 3D
    const scree_predicted *predicted; ///< one a row, with law_predicts
    const double *stretch;            ///< with law_deforms: scree_stretch_size numbers a row
    scree_sum_row *sum;               ///< the sum of row r is sum[r]; this thread's own
    scree_torque_row *torque;         ///< 3D, in the same way
    int64_t *moment;                  ///< in the same way; NULL: not asked for
    const uint32_t *first, *second;   ///< the whole pair list
    scree_history *history;
    scree_last_force *last_force; ///< with law_keeps_last_force
    scree_rolling *rolling;       ///< with law_rolls
    const scree_member_row *own;  ///< with law_holds: constants of the first pairs of the list
    const scree_pair_constants (*pairs)[SCREE_MAX_MATERIALS];
    size_t near;                         ///< number of the first near pair; touching pairs come before it
    size_t held_begin, held_end;         ///< pairs of this job that are held, for contact_job_of_held
    size_t touching_begin, touching_end; ///< pairs of this job
    size_t near_begin, near_end;         ///< near pairs of this job; near_begin - near is a multiple of 8
    uint8_t *near_touched;               ///< one bit a near pair: it touched in the last evaluation
    law_settings settings;
    contact_scale scale;
    contact_totals totals; ///< out
} contact_job;

/// The option of a law that the bodies of a state ask for: without strains they are rigid as yet.
static inline unsigned contact_option(const scree_law_use *law, const scree_state *state)
{
    return state->stretch && state->moment ? law->option : law->option & ~scree_law_get(law->law)->deforming;
}

/// The part of a job that is of pairs that are held: under their law, without near pairs.
static inline contact_job contact_job_of_held(const contact_job *job)
{
    contact_job held = *job;
    const scree_law_use *law = &job->model->persistent.law;
    held.variant.law = law->law;
    held.variant.option = job->stretch ? law->option : law->option & ~scree_law_get(law->law)->deforming;
    held.variant.many_materials = true;
    held.pairs = job->model->persistent.pairs;
    memcpy(held.settings.number, law->number, sizeof law->number);
    held.touching_begin = job->held_begin;
    held.touching_end = job->held_end;
    held.near_begin = held.near_end = job->near;
    return held;
}

typedef void contact_kernel(contact_job *job);
contact_kernel scree_pairs_2d_v0, scree_pairs_2d_v2, scree_pairs_2d_v3, scree_pairs_2d_v4;
contact_kernel scree_pairs_3d_v0, scree_pairs_3d_v2, scree_pairs_3d_v3, scree_pairs_3d_v4;

#endif
