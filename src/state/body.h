/// What a body is, read through one function each: place and motion, mass and inertia, orientation, size, material,
/// mark. Bodies are discs (cylinders) and polygons (prisms) in 2D, spheres in 3D. Kernels read the rows themselves.
///
/// Size has three names, since a radius is not the same thing for all who ask:
///   bounding radius     of the smallest circle or sphere around the centre that holds the body: what may touch
///   equivalent radius   of the disc or sphere with its area or volume: what a mean size, a diameter of a sample means
///   volume              area [m2] in 2D, volume [m3] in 3D: what is filled
/// They agree for round bodies. Others have a row in state->form, and the bounding radius in their own.
#ifndef SCREE_STATE_BODY_H
#define SCREE_STATE_BODY_H

#include "state/state.h"

/// Position of the body in `row` [m]; z = 0 in 2D.
static inline void scree_body_position(const scree_state *state, size_t row, scree_vector position)
{
    const scree_row *body = &state->row[row];
    position[0] = body->x;
    position[1] = body->y;
    position[2] = state->dimension == 3 ? body->z : 0;
}

/// Velocity [m/s] and spin [rad/s] that the scheme keeps; in 2D vz = 0 and the spin is about z.
static inline void scree_body_motion(const scree_state *state, size_t row, scree_vector velocity, scree_vector spin)
{
    const scree_row *body = &state->row[row];
    bool in_3d = state->dimension == 3;
    velocity[0] = body->vx;
    velocity[1] = body->vy;
    velocity[2] = in_3d ? body->vz : 0;
    spin[0] = in_3d ? state->turn[row].wx : 0;
    spin[1] = in_3d ? state->turn[row].wy : 0;
    spin[2] = in_3d ? state->turn[row].wz : body->spin;
}

/// Index of the material of the body in `row`.
static inline int scree_body_material(const scree_state *state, size_t row)
{
    return (int)(state->dimension == 3 ? state->turn[row].material : state->row[row].material);
}

/// kg
static inline double scree_body_mass(const scree_state *state, size_t row)
{
    return state->row[row].mass;
}

/// What the integers of the moments of a body count [N m]: torque quanta; of a body that deforms the quantum of force
/// times the radius, at which all its forces act.
static inline double scree_moment_unit(const scree_state *state, size_t row)
{
    return state->stretch ? state->force_quantum * state->row[row].radius : state->torque_quantum;
}

/// Sum over the contacts of the body of branch (x) force [N m], from its centre to the point where the force acts, d x
/// d by rows: -stress times volume, of what contacts exert. Zero unless someone has asked
/// (scree_state_ask_for_moments).
static inline void scree_body_contact_moment(const scree_state *state, size_t row, double moment[9])
{
    const size_t size = scree_moment_size(state->dimension), count = (size_t)(state->dimension * state->dimension);
    for (size_t k = 0; k < count; k++)
        moment[k] = state->moment ? (double)state->moment[row * size + k] * scree_moment_unit(state, row) : 0;
}

/// Radius [m] of the disc or sphere with the mass and the moment of inertia of the body.
static inline double scree_body_turning_radius(const scree_state *state, size_t row)
{
    return state->form ? state->form[row].turning : state->row[row].radius;
}

/// Moment of inertia [kg m2] about the centre, of a sphere the same about every axis: m R^2 / 2 in 2D, about the normal
/// of the plane, and 2 m R^2 / 5 in 3D, R the turning radius.
static inline double scree_body_inertia(const scree_state *state, size_t row)
{
    const double radius = scree_body_turning_radius(state, row);
    return (state->dimension == 3 ? 0.4 : 0.5) * state->row[row].mass * radius * radius;
}

/// Angle [rad] by which the body lies turned, 2D: of a disc since the start. In 3D contacts of spheres need no
/// orientation: it is kept where somebody asks for it (integrate/orientation.h).
static inline double scree_body_angle(const scree_state *state, size_t row)
{
    return state->angle[row];
}

/// Its place, and how it lies, become those at the start: displacements are from here.
static inline void scree_body_refer(scree_state *state, size_t row)
{
    scree_body_position(state, row, state->reference[row]);
    if (state->reference_angle) state->reference_angle[row] = scree_body_angle(state, row);
}

/// Radius [m] of the smallest circle or sphere around the centre that holds the body.
static inline double scree_body_bounding_radius(const scree_state *state, size_t row)
{
    return state->row[row].radius;
}

/// Radius [m] of the disc or sphere with the area or volume of the body.
static inline double scree_body_equivalent_radius(const scree_state *state, size_t row)
{
    return state->form ? state->form[row].radius : state->row[row].radius;
}

/// Of a body that has come among others that are not round: it is, with the radius of its row.
static inline void scree_body_make_round(scree_state *state, size_t row)
{
    const double radius = state->row[row].radius;
    if (state->form) state->form[row] = (scree_form){radius, radius};
}

/// Area [m2] in 2D, volume [m3] in 3D.
static inline double scree_body_volume(const scree_state *state, size_t row)
{
    double radius = scree_body_equivalent_radius(state, row);
    return M_PI * (radius * radius) * (state->dimension == 2 ? 1 : 4.0 / 3 * radius);
}

/// What the body is there for. A ghost has the mark of its body.
static inline scree_mark scree_body_mark(const scree_state *state, size_t row)
{
    return (scree_mark)state->mark[row];
}

/// Components of the motion of a body that are prescribed, not found: bits 0 to 2 velocity x, y, z, bits 3 to 5 spin.
static inline unsigned scree_body_held(const scree_state *state, size_t row)
{
    return state->held ? state->held[row] : 0;
}

/// Takes prescribed components out of a velocity or force, and of a spin or torque.
static inline void scree_body_leave_free(const scree_state *state, size_t row, double polar[3], double axial[3])
{
    unsigned held = scree_body_held(state, row);
    for (int k = 0; k < 3 && held; k++) {
        if (held >> k & 1) polar[k] = 0;
        if (held >> (3 + k) & 1) axial[k] = 0;
    }
}

/// The body is of the assembly, not of a membrane or a boundary.
static inline bool scree_body_is_grain(const scree_state *state, size_t row)
{
    return scree_body_mark(state, row) == SCREE_MARK_GRAIN;
}

#endif
