/// Geometry of the periodic cell: the lattice in which the sample repeats itself.
///
/// The lattice vectors are the columns of `lattice`; a direction without a bit in `periodic` has its unit vector there
/// and does not repeat. A point x has the fractional coordinates f = H^-1 x; its ghosts are x + H n with integers n (0
/// in directions that are not periodic). Bodies lie in the cell 0 <= f < 1, or a little outside (boundary/periodic.c
/// says when they are put back). Faces k are the two planes f_k = 0 and f_k = 1.
#ifndef SCREE_STATE_PERIODIC_H
#define SCREE_STATE_PERIODIC_H

#include "state/plates.h"

/// The periodic cell; `directions` zero: there is none. Motion in boundary/periodic.c.
/// Velocities of bodies in a deforming cell are relative to the affine field gradient . x. Tensors are 3 x 3 by rows,
/// tension and extension positive.
typedef struct scree_periodic_cell {
    double lattice[9];   ///< m, lattice vectors as columns; the unit vector where a direction is not periodic
    double reference[9]; ///< m, the same lattice vectors at the start of the loading stage
    double gradient[9];  ///< 1/s, velocity gradient of the last step, d v_row / d x_column
    double drift[9];     ///< 1/s, running mean of the gradient, for the servo
    double strain[9];    ///< 1, its integral over time
    double virial[9];    ///< J, at the present step: sum over contacts of force on first (x) branch
    double motion[9];    ///< J, in the last step: sum over bodies of mass velocity (x) velocity
    uint64_t directions; ///< bits 0, 1, 2: x, y, z
    // the servo of components under stress, as it suits the sample at the begin of the stage (boundary/periodic.c)
    double inertia;       ///< Pa s2, of the rate of a component
    double damping;       ///< 1/s, its dashpot over its inertia
    double limit;         ///< 1/s, largest magnitude of such a rate
    double stress_sum[3]; ///< Pa s, sums of the normal stresses times the step since they were last asked for
    double stress_time;   ///< s, of the steps
} scree_periodic_cell;

static inline scree_periodic_cell *scree_cell(const scree_state *state)
{
    return state->own[SCREE_SLOT_periodic_cell];
}

/// All directions of space are periodic: only such a cell deforms.
static inline bool scree_periodic_is_whole(const scree_state *state)
{
    return scree_cell(state)->directions == (1U << state->dimension) - 1;
}

static inline bool scree_periodic_repeats(const scree_periodic_cell *cell, int direction)
{
    return cell->directions >> direction & 1;
}

/// Makes a cell at rest with the given sides [m] along the axes, periodic in the directions of the mask.
void scree_periodic_set(scree_periodic_cell *cell, uint32_t periodic, const double sides[3]);

/// Distances [m] of the two faces of each direction, from the inverse of the lattice.
void scree_periodic_widths(const double inverse[9], double width[3]);

/// Area (2D) or volume (3D) of the sample in the cell: between bottom and top plate (or the other walls) in directions
/// that do not repeat. [m2, m3]
double scree_periodic_extent(const scree_state *state);

/// The plates that a sample has room for, bit w for plate w: those across directions in which it does not repeat
/// itself.
uint32_t scree_periodic_plates(const scree_state *state);

/// Plates stand across all other directions, so that the sample has an extent.
bool scree_periodic_is_closed(const scree_state *state);

/// Plates on both sides of the sample along each axis [m]; 0 in 2D along z.
void scree_periodic_box(int dimension, const scree_wall *plates, scree_vector low, scree_vector high);

/// Ends [m] of an edge of the cell; in directions that do not repeat from `low` to `high`. False: no edge in this
/// dimension.
enum { SCREE_PERIODIC_EDGES = 24 };
bool scree_periodic_edge(const scree_periodic_cell *cell, int dimension, const scree_vector low,
                         const scree_vector high, int edge, scree_vector ends[2]);

/// Velocities [m/s] with which the lattice vectors move, as columns, at the end of a step with the gradient of the
/// cell: a ghost moves as its body plus this times its shift.
void scree_periodic_lattice_velocity(const scree_state *state, double velocity[9]);

/// Stress [Pa, tension positive] of the bodies in a whole cell at the present step: -(virial + motion) / volume.
void scree_periodic_stress(const scree_model *model, const scree_state *state, double stress[9]);

/// Velocity of the body in `row` [m/s] that its contacts saw at the present step: that of the scheme at n - 1/2, which
/// is relative to the affine field, given as `relative`, plus that field.
void scree_periodic_full_velocity(const scree_state *state, const scree_vector position, const scree_vector relative,
                                  scree_vector velocity);

#endif
