/// One thread's share of a section of the pair list, in a force evaluation: what a kernel reads and what it gives back.
/// Between contact/forces.c, which cuts the work, and the kernels (scree_pairs_2d_vN and scree_pairs_3d_vN for two and
/// three dimensions, scree_outlines_vN for outlines: one compilation of their files for each instruction set).
#ifndef SCREE_CONTACT_JOB_H
#define SCREE_CONTACT_JOB_H

#include "contact/law.h"
#include "state/plates.h"
#include "state/work.h"

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

/// Pairs of a section: those that touched when the list was made, or are held, and the near ones.
typedef struct contact_range {
    size_t touching_begin, touching_end;
    size_t near_begin, near_end; ///< near_begin less the begin of the section's near pairs is a multiple of 8
} contact_range;

typedef struct contact_job {
    const scree_model *model;
    const scree_state *state; ///< for geometries that read more of a body than its rows
    variant variant;
    const scree_row *row;
    const scree_turn_row *turn;       ///< 3D
    const scree_predicted *predicted; ///< one a row, with law_predicts
    const scree_predicted *lead;      ///< one a row; NULL: none (state/state.h); kernels of round bodies know none
    const double *stretch;            ///< with law_deforms: scree_stretch_size numbers a row
    scree_sum_row *sum;               ///< the sum of row r is sum[r]; this thread's own
    scree_torque_row *torque;         ///< 3D, in the same way
    int64_t *moment;                  ///< in the same way; NULL: not asked for
    const uint32_t *first, *second;   ///< the whole pair list
    scree_pair_hint *hint;            ///< one a pair; NULL: none
    scree_history *history;
    scree_last_force *last_force; ///< with law_keeps_last_force
    scree_rolling *rolling;       ///< with law_rolls
    const scree_member_row *own;  ///< with law_holds: constants of the held pairs
    const scree_pair_constants (*pairs)[SCREE_MAX_MATERIALS];
    contact_range range;   ///< pairs of this job
    size_t near;           ///< first near pair of the section
    uint8_t *near_touched; ///< one bit a near pair of the section: it touched in the last evaluation
    int law;               ///< number of the law in the model, of contacts with walls
    law_settings settings;
    contact_scale scale;
    contact_totals totals; ///< out
} contact_job;

/// Puts a job under a law.
static inline void contact_job_use(contact_job *job, const scree_law_use *law)
{
    job->variant.law = law->law;
    job->variant.option = job->stretch ? law->option : law->option & ~scree_law_get(law->law)->deforming;
    memcpy(job->settings.number, law->number, sizeof law->number);
}

/// Puts it under the law with this number, for contacts with walls.
static inline void contact_job_use_number(contact_job *job, int number)
{
    job->law = number;
    contact_job_use(job, &job->model->laws[number]);
}

/// Turns a job to pairs of a section; its totals are those of these pairs then. near_touched: of the section.
static inline void contact_job_enter(contact_job *job, const scree_pair_section *section, const contact_range *range,
                                     uint8_t *near_touched)
{
    const scree_model *model = job->model;
    job->range = *range;
    job->near = section->touching_end;
    job->near_touched = near_touched;
    job->variant.geometry = section->geometry;
    job->variant.many_materials = model->material_count + model->added_materials > 1;
    job->pairs = section->persistent ? model->persistent.pairs : model->pairs;
    contact_job_use(job, section->persistent ? &model->persistent.law : &model->laws[section->law]);
}

typedef void contact_kernel(contact_job *job);
contact_kernel scree_pairs_2d_v0, scree_pairs_2d_v2, scree_pairs_2d_v3, scree_pairs_2d_v4;
contact_kernel scree_pairs_3d_v0, scree_pairs_3d_v2, scree_pairs_3d_v3, scree_pairs_3d_v4;
contact_kernel scree_outlines_v0, scree_outlines_v2, scree_outlines_v3, scree_outlines_v4;

/// Those of an evaluation.
typedef struct contact_kernels {
    contact_kernel *in_lanes, *outlines;
} contact_kernels;

#endif
