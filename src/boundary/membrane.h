/// Membrane around the sides of a sample.
#ifndef SCREE_BOUNDARY_MEMBRANE_H
#define SCREE_BOUNDARY_MEMBRANE_H

#include "base/wrapping.h"
#include "measure/delaunay_boundary.h"
#include "state/plates.h"
#include "state/state.h"

/// What the keys become.
typedef struct scree_membrane_numbers {
    int material;     ///< index of its constants: frictionless, else those of the particles
    double radius;    ///< m
    double stiffness; ///< N/m, of one spring
} scree_membrane_numbers;

typedef struct scree_membrane_config {
    double membrane_stiffness; ///< N/m, 2D: between two neighbours; 3D: of the sheet, tension over strain
    double membrane_radius;    ///< m, of its bodies; auto: 1.25 mean radii of the grains, 3D: 0.75
} scree_membrane_config;

/// State of the module `membrane`. Its bodies have the mark SCREE_MARK_MEMBRANE and ids one after the other from
/// first_id on; none of them can be taken out. count = 0: there is no membrane. 2D: two chains of discs, the right side
/// from bottom to top, then the left side from top to bottom. 3D: a triangulated tube of spheres (boundary/sheet.h),
/// ring by ring from bottom to top.
typedef struct scree_membrane {
    scree_vector *rest; ///< count, m, unstressed lengths of the springs that begin at this body; 0: no spring. 2D: one,
                        ///< to the next body; 3D: to the next of its ring and to two of the ring above
    scree_vector *press;       ///< count, N, force of the pressure at n
    scree_vector *force;       ///< count, N, force of the springs, and of the plates on its ends, at n
    uint32_t *id;              ///< count, derived: of its bodies
    scree_boundary_body *body; ///< count, derived, of a part (measure/delaunay_boundary.h): read through
                               ///< scree_membrane_position and _velocity
    size_t count, capacity;
    uint64_t first_id; ///< of its bodies
    uint64_t right;    ///< 2D: bodies of the right side
    uint64_t around;   ///< 3D: bodies of a ring
    double radius;     ///< m
    double ramp_time;  ///< s, in which the membrane takes the pressure over
} scree_membrane;

extern const scree_group scree_membrane_bodies;

static inline scree_membrane *scree_membrane_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_membrane];
}

/// Fills the numbers of the membrane in the model (membrane_numbers.c). Errors: SCREE_ERROR_INPUT with the key.
scree_status scree_membrane_resolve(scree_model *model, scree_error *error) SCREE_MUST_USE;

/// Places the membrane around the grains between the bottom and the top plate (membrane_place.c, sheet_place.c): the
/// bodies are appended to the state, unstressed, against the grains without overlap. Errors: memory;
/// SCREE_ERROR_GUARD when the plates are too close for two bodies, or (3D) a grain could slip through.
scree_status scree_membrane_place(const scree_model *model, scree_state *state, scree_error *error) SCREE_MUST_USE;

/// Room for a membrane of `count` bodies, which are appended to the state. Errors: memory; the state has no membrane
/// then.
scree_status scree_membrane_make_room(scree_state *state, size_t count, scree_error *error) SCREE_MUST_USE;

/// Forces of a pressure [Pa] on the membrane at the present positions, added to the sums and to membrane.press
/// (membrane_press.c).
void scree_membrane_press(const scree_model *model, scree_state *state, double pressure);

/// Energy [J] stored in the springs.
double scree_membrane_energy(const scree_model *model, const scree_state *state);

/// Volume [m3] between the plates and inside the membrane (through the centres of its bodies).
double scree_membrane_volume(const scree_model *model, const scree_state *state);

static inline const scree_membrane_numbers *scree_membrane_numbers_of(const scree_model *model)
{
    return scree_model_numbers(model, SCREE_SLOT_membrane);
}

/// Row of the k-th body of the membrane; SCREE_NO_ROW where another process has it.
static inline uint32_t scree_membrane_row(const scree_state *state, size_t k)
{
    return scree_state_row_of(state, scree_membrane_of(state)->first_id + k);
}

/// Position [m] and velocity [m/s] of the k-th body of the membrane, wherever it is.
static inline void scree_membrane_position(const scree_state *state, size_t k, scree_vector position)
{
    const scree_membrane *membrane = scree_membrane_of(state);
    scree_boundary_place(state, (uint32_t)(membrane->first_id + k), &membrane->body[k], position);
}

static inline void scree_membrane_velocity(const scree_state *state, size_t k, scree_vector velocity)
{
    const scree_membrane *membrane = scree_membrane_of(state);
    scree_boundary_velocity(state, (uint32_t)(membrane->first_id + k), &membrane->body[k], velocity);
}

/// A force in quanta on the k-th body, where it is, and on its element of membrane.press or .force.
static inline void scree_membrane_add(scree_state *state, size_t k, const int64_t force[3], scree_vector *kept)
{
    const uint32_t row = scree_membrane_row(state, k);
    for (int i = 0; i < 3; i++) kept[k][i] += (double)force[i] * state->force_quantum;
    if (row == SCREE_NO_ROW) return;
    scree_wrapping_add(&state->sum[row].fx, force[0]);
    scree_wrapping_add(&state->sum[row].fy, force[1]);
    if (state->dimension == 3) scree_wrapping_add(&state->sum[row].fz, force[2]);
}

/// The plate of an end; -1 for the bodies between.
static inline int scree_membrane_plate(const scree_state *state, size_t k)
{
    const scree_membrane *membrane = scree_membrane_of(state);
    if (state->dimension == 3)
        return k < membrane->around ? SCREE_WALL_BOTTOM : k + membrane->around >= membrane->count ? SCREE_WALL_TOP : -1;
    if (k == 0 || k + 1 == membrane->count) return SCREE_WALL_BOTTOM;
    return k + 1 == membrane->right || k == membrane->right ? SCREE_WALL_TOP : -1;
}

/// Height of the bottom or top plate [m].
static inline double scree_plate_height(const scree_state *state, int wall)
{
    return scree_plates(state)[wall].position * scree_plates(state)[wall].normal[state->dimension - 1];
}

#endif
