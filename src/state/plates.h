/// The six plates around a sample: rigid planes that may stand or not, and move along their normal.
#ifndef SCREE_STATE_PLATES_H
#define SCREE_STATE_PLATES_H

#include "state/state.h"

/// A rigid plane wall: all bodies lie on the side that its unit normal points to. Plates move along their normal.
typedef struct scree_wall {
    double position;                  ///< m, along the normal: points x with normal . x = position
    scree_vector normal;              ///< 1
    double velocity;                  ///< m/s along the normal, v(n - 1/2): position(n) = position(n-1) + velocity dt
    double force;                     ///< N, normal force by the bodies on the wall at n, compression positive
    scree_vector shear;               ///< N, tangential force by the bodies on the wall at n
    scree_vector tangential_velocity; ///< m/s, in the plane of the wall
    int32_t active;                   ///< 0: does not exist in this stage
    int32_t material;                 ///< material index of the plate
} scree_wall;

/// Bottom and top bound the last axis (y in 2D, z in 3D), left and right x, front and back y in 3D.
enum {
    SCREE_WALL_BOTTOM,
    SCREE_WALL_TOP,
    SCREE_WALL_LEFT,
    SCREE_WALL_RIGHT,
    SCREE_WALL_FRONT,
    SCREE_WALL_BACK,
    SCREE_WALL_COUNT
};

/// A plate under servo: its dashpot and its mass, see boundary/plates.c.
typedef struct scree_servo {
    double impedance; ///< N s/m
    double mass;      ///< kg
} scree_servo;

/// State of the module `plates`.
typedef struct scree_plate_set {
    scree_wall wall[SCREE_WALL_COUNT];
    scree_servo axial, sides; ///< as they suited the sample at the begin of the stage
} scree_plate_set;

static inline scree_plate_set *scree_plate_set_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_plates];
}

/// The plates, SCREE_WALL_COUNT of them.
static inline scree_wall *scree_plates(const scree_state *state)
{
    return ((scree_plate_set *)state->own[SCREE_SLOT_plates])->wall;
}

/// Moves every active wall by velocity * dt.
void scree_plates_move(scree_state *state);

#endif
