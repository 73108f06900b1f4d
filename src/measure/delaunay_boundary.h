/// The Delaunay boundary of the sample: the loop of 2D, the hull of 3D, and the strain accumulated from them. Measures
/// read it; boundary/pressure.c and boundary/hull.c find it anew and press on it.
#ifndef SCREE_MEASURE_DELAUNAY_BOUNDARY_H
#define SCREE_MEASURE_DELAUNAY_BOUNDARY_H

#include "state/body.h"
#include "state/pressure.h"
#include "state/state.h"

#include <string.h>

/// A body of the boundary as the others see it: where the state is a part (comm/parts.h), each process has all of them,
/// renewed in each step when positions are those of n + 1 and velocities v(n + 1/2). So loop and hull, what follows
/// from them, and sums over them are the same in all processes, and need no joining; forces go to the bodies that are
/// here.
typedef struct scree_boundary_body {
    scree_vector position, velocity; ///< m, m/s
    double radius;                   ///< m, bounding
} scree_boundary_body;

/// Closed loop of bodies on the outer Delaunay boundary, counter-clockwise, by id; empty when there is none.
typedef struct scree_loop {
    uint32_t *id;
    uint8_t *loaded; ///< 1: the edge from id[k] to id[k+1] carries the lateral pressure
    double *x, *y;   ///< m, positions at `updated`; the strain increment since then is measured from them
    double *fx,
        *fy; ///< N, pressure force on each body of the loop at the present step (first half of the next work increment)
    double *term;              ///< derived: terms of one sum along the loop, at most one an edge
    scree_boundary_body *body; ///< derived, of a part: read through scree_boundary_... below
    size_t count, capacity;
    uint64_t updated; ///< step of the last update
} scree_loop;

/// What a triangle of the hull carries.
typedef enum scree_hull_load {
    SCREE_HULL_BARE = 0,    ///< nothing
    SCREE_HULL_LOADED = 1,  ///< the lateral pressure
    SCREE_HULL_ON_WALL = 2, ///< faces a plate: this value plus the index of the wall
} scree_hull_load;

/// 3D: triangulated hull of the assembly, closed, normals outward; empty when there is none. The counterpart of
/// scree_loop in 2D.
typedef struct scree_hull {
    uint32_t *id;              ///< node_count, ids of the bodies on it, ascending
    scree_vector *position;    ///< node_count, m, positions at `updated`
    scree_vector *force;       ///< node_count, N, force of the boundary at the present step
    scree_boundary_body *body; ///< node_count, derived, as that of the loop
    uint32_t (*triangle)[3];   ///< triangle_count, nodes; counter-clockwise seen from outside
    uint8_t *loaded;           ///< triangle_count, scree_hull_load
    size_t node_count, node_capacity;
    size_t triangle_count, triangle_capacity;
    uint64_t updated; ///< step of the last update
} scree_hull;

/// Strain accumulated from the Delaunay boundary (Bagi), see measure/strain.h; compression is NEGATIVE here (tensor).
typedef struct scree_strain {
    double gradient[9]; ///< accumulated displacement gradient, row-major (d u_row / d x_column)
    double redetected;  ///< 1, sum of log (enclosed volume after / before) over the re-detections of the boundary
} scree_strain;

/// State of the module `delaunay_boundary`.
typedef struct scree_delaunay_boundary {
    scree_loop loop; ///< 2D
    scree_hull hull; ///< 3D
    scree_strain strain;
    uint64_t stale;    ///< 1: a body of the boundary was taken out, so it is found anew at the next search
    double taken_over; ///< 1, fraction of the time passed in which a membrane takes the pressure over; 0 without one
} scree_delaunay_boundary;

extern const scree_group scree_loop_group, scree_hull_nodes, scree_hull_triangles;

static inline scree_delaunay_boundary *scree_delaunay_boundary_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_delaunay_boundary];
}

static inline scree_loop *scree_loop_of(const scree_state *state)
{
    return &scree_delaunay_boundary_of(state)->loop;
}

static inline scree_hull *scree_hull_of(const scree_state *state)
{
    return &scree_delaunay_boundary_of(state)->hull;
}

static inline scree_strain *scree_strain_of(const scree_state *state)
{
    return &scree_delaunay_boundary_of(state)->strain;
}

/// The bodies of the boundary are told to all processes, where the state is a part; all of them call it. Where it is
/// whole and will be spread each process fills them in.
void scree_boundary_tell(const scree_state *state, const uint32_t *id, scree_boundary_body *body, size_t count);

/// Position [m] and velocity [m/s] of a body of the boundary, wherever it is; `body` is its element of loop or hull.
static inline void scree_boundary_place(const scree_state *state, uint32_t id, const scree_boundary_body *body,
                                        scree_vector position)
{
    const uint32_t row = scree_state_row_of(state, id);
    if (row != SCREE_NO_ROW)
        scree_body_position(state, row, position);
    else
        memcpy(position, body->position, sizeof body->position);
}

static inline void scree_boundary_velocity(const scree_state *state, uint32_t id, const scree_boundary_body *body,
                                           scree_vector velocity)
{
    const uint32_t row = scree_state_row_of(state, id);
    scree_vector spin;
    if (row != SCREE_NO_ROW)
        scree_body_motion(state, row, velocity, spin);
    else
        memcpy(velocity, body->velocity, sizeof body->velocity);
}

static inline double scree_boundary_radius(const scree_state *state, uint32_t id, const scree_boundary_body *body)
{
    const uint32_t row = scree_state_row_of(state, id);
    return row != SCREE_NO_ROW ? scree_body_bounding_radius(state, row) : body->radius;
}

/// Pressure [Pa] that acts on the Delaunay boundary itself; a membrane takes it over smoothly.
static inline double scree_direct_pressure(const scree_state *state)
{
    double share = scree_delaunay_boundary_of(state)->taken_over;
    return scree_pressure_now(state) * (1 - share * share * (3 - 2 * share));
}

#endif
