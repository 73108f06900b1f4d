/// The face of a method of preparation: one file a method (src/prepare/).
#ifndef SCREE_MODULE_PREPARATION_H
#define SCREE_MODULE_PREPARATION_H

#include "module/module.h"

struct scree_config_stage;
struct scree_packing;
struct scree_node;

typedef struct scree_preparation {
    // ---- traits ----
    bool periodic;         ///< can fill a box that repeats itself
    bool needs_walls;      ///< cannot, because walls have a part in it
    bool sizes_box;        ///< the box is made for what is placed, whatever the aspect ratio
    bool dense;            ///< packs particles between walls until they are stable
    bool loose;            ///< there are no contacts at the begin
    bool given;            ///< what stands where is given, whatever the number of particles
    bool binary;           ///< the particles can only collide
    bool approaching;      ///< the particles may be about to collide
    int lattice;           ///< scree_lattice + 1 (theory/lattice.h) that it makes; 0: none
    bool empty;            ///< places nothing: all particles come later
    bool turned;           ///< its horizontal axes are diagonals of the cubic cell
    int only_dimension;    ///< exists in this dimension alone; 0: in both
    const char *elsewhere; ///< method that takes its place in the other dimension

    /// Gives a case what it leaves out and this method knows (scree_case_supply), before it is read; `stage` is the
    /// mapping of its stage in the tree. Notes no problem: what is wrong is found by the reading. NULL: it knows
    /// nothing.
    void (*supply)(scree_reader *reader, const struct scree_node *stage);

    // ---- what the model asks before there is a sample; each may be NULL ----
    /// What is wrong with the stage, besides a box that is too small.
    scree_status (*check)(const scree_model *model, const struct scree_config_stage *stage, scree_error *error);
    /// Some particle is of the material of this name, besides that of all particles.
    bool (*uses)(const struct scree_config_stage *stage, const char *material);
    /// Height [m] of the sample. NULL: from number, sizes, box and solid fraction.
    double (*height)(const scree_model *model, const struct scree_config_stage *stage);
    /// Solid fraction at the begin. NULL: that of a packing.
    double (*solid_fraction)(const scree_model *model, const struct scree_config_stage *stage);
    /// Speed [m/s] of strong impacts, with `fall` what a fall through the sample brings. NULL: none are expected.
    double (*impact_speed)(const scree_model *model, const struct scree_config_stage *stage, double fall);

    /// Particles that it places. NULL: all of the case.
    size_t (*count)(const scree_model *model, const struct scree_config_stage *stage);

    // ---- what it does ----
    /// Places the bodies of `packing` (radii drawn; width and depth of its box given, or NAN for auto) and sets the
    /// box. A method may draw other radii from the same distribution. Errors: does not fit, memory.
    scree_status (*place)(const scree_model *model, const struct scree_config_stage *stage,
                          struct scree_packing *packing, scree_error *error);
    /// Index of the material of body `index`. NULL: that of the particles.
    int (*material_of)(const scree_model *model, const struct scree_config_stage *stage, size_t index);
    /// Fills what the module itself remembers in the state, when the rows are filled. NULL: nothing.
    scree_status (*remember)(const scree_model *model, const struct scree_config_stage *stage,
                             const struct scree_packing *packing, scree_state *state, scree_error *error);
    /// What a reader of the log should know of what has been placed; "": nothing. NULL: nothing.
    const char *(*remark)(const struct scree_config_stage *stage);
    /// Velocities at the start, when the rows are filled. NULL: at rest.
    void (*set_moving)(const scree_model *model, const struct scree_config_stage *stage, scree_state *state);
} scree_preparation;

#endif
