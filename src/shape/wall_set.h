/// The walls of a case beside the six plates: planes, boxes, cylinders, cones, triangle meshes and, in two dimensions,
/// convex polygons, fixed or moving.
///
/// A wall consists of primitives, each of which can touch a sphere at one point at most: a plane is one; a box seen
/// from inside has six planes, a closed cylinder or cone its side and two ends; what is convex seen from outside (box,
/// rod, polygon) is one; a mesh has its triangles, edges and vertices. Elements of all walls are numbered through.
/// Contacts are the local minima of the distance to a wall (shape/mesh.h); walls that meet each other do not know of
/// each other.
///
/// Motion. A wall turns with a constant spin w about a centre that moves by s(t) (case/wall_motion.h): with its time t
/// (scree_case_walls(state)->ticks x tick, never accumulated), x(t) = c + s(t) + R(w t) (x(0) - c), R a rotation by |w|
/// t about w (Rodrigues). Geometry stays in the frame without motion, into which the centre of the sphere is brought. A
/// wall that moves in itself with a constant velocity (a drum about its axis, a plane along itself) is not moved at
/// all: only its points are.
///
/// Outlines. Laws of areas take no closest point but what two outlines share (shape/overlap.h): a polygon, and a box
/// seen from outside in two dimensions, have an outline, which lies as the wall does; planes, and boxes seen from
/// inside, are half-planes. A grain at a corner touches the outline once.
///
/// A surface with an inside counts up to one radius behind it, a plane without limit.
#ifndef SCREE_SHAPE_WALL_SET_H
#define SCREE_SHAPE_WALL_SET_H

#include "shape/mesh.h"
#include "shape/polygon.h"
#include "state/case_walls.h"

/// A line in the half-plane of coordinate `s` along the axis and distance `r` from it, m.
typedef struct scree_profile {
    double s[2], r[2];
    double normal[2]; ///< towards the bodies
    bool free_ends;   ///< its ends are edges of the wall; else another primitive goes on from there
} scree_profile;

/// What a surface is made of: shapes put theirs together from these (module/wall_shape.h).
typedef enum scree_surface_kind {
    SCREE_SURFACE_PLANES,  ///< half-spaces, a primitive each
    SCREE_SURFACE_BOX,     ///< a solid box, one primitive
    SCREE_SURFACE_OUTLINE, ///< a solid convex polygon in the plane, one primitive
    SCREE_SURFACE_PROFILE, ///< lines that turn about an axis
    SCREE_SURFACE_MESH,    ///< triangles, edges and vertices
} scree_surface_kind;

/// One wall.
typedef struct scree_surface {
    const scree_config_wall *config;
    scree_surface_kind kind;
    size_t first, count; ///< its primitives
    // half-spaces normal . x >= offset
    scree_vector normal[6];
    double offset[6];
    bool endless; ///< it is a plane
    // between the corners of a box, seen from inside or outside
    bool cornered;
    scree_vector lower, upper; ///< m
    // solid in the plane; corner_count is 0 of all others
    int corner_count;
    double corner[SCREE_POLYGON_CORNERS][2]; ///< m, from the centroid
    double middle[2], bound;                 ///< m, the centroid; no corner is farther from it
    double posed[SCREE_POLYGON_CORNERS][2];  ///< m, corners as they lie now
    double centre[2];                        ///< m, the centroid now
    // body of revolution
    scree_vector start, axis; ///< m, one end of the axis; unit vector from there to the other
    scree_profile profile[3];
    int profile_count;
    bool solid;  ///< closed, seen from outside: one primitive
    bool convex; ///< closed, seen from inside: its lines go on behind their ends
    scree_mesh mesh;
    double smooth; ///< cosine: contacts whose normals are closer than this are one
    // motion
    bool turns, shifts;    ///< the geometry does
    bool steady;           ///< its velocity is the same at all times
    bool stands;           ///< it never moves
    double reach;          ///< m, no point of it is farther from the centre; 0 of a plane, which cannot spin
    double rotation[9];    ///< now, 3 x 3 by rows
    scree_vector shift;    ///< m, now
    scree_vector hub;      ///< m, the centre now
    scree_vector velocity; ///< m/s, in the last step
    scree_vector listed;   ///< m, its shift when neighbours were last looked for
} scree_surface;

typedef struct scree_wall_set {
    int dimension;
    int count;
    scree_surface surface[SCREE_SURFACES];
    size_t primitives;
    double time; ///< s, of the present poses
} scree_wall_set;

/// Makes the walls of `config`; *wall_set is NULL when it has none. Errors: SCREE_ERROR_INPUT or SCREE_ERROR_IO with
/// the field (walls.N.key), memory.
scree_status scree_wall_set_create(const scree_config *config, scree_wall_set **wall_set,
                                   scree_error *error) SCREE_MUST_USE;
void scree_wall_set_destroy(scree_wall_set **wall_set);

/// Brings all walls to their poses at `time`; step [s]: the last one. walls: what servos have done; NULL: nothing yet.
void scree_wall_set_place(scree_wall_set *wall_set, const scree_case_wall_set *walls, double time, double step);

/// Neighbours have been looked for at the present poses.
void scree_wall_set_list(scree_wall_set *wall_set);

/// Bound of the way that a point of any wall, or of its frame beside a body within `margin`, is from where it was when
/// neighbours were last looked for, `time` [s] ago [m].
double scree_wall_set_way(const scree_wall_set *wall_set, double time, double margin);

/// Bound of the velocity of a point of any wall in the last step [m/s].
double scree_wall_set_speed(const scree_wall_set *wall_set);

/// The wall that a primitive belongs to.
static inline int scree_primitive_surface(const scree_wall_set *wall_set, size_t primitive)
{
    int k = 0;
    while (primitive >= wall_set->surface[k].first + wall_set->surface[k].count) k++;
    return k;
}

/// Whether the normal of every primitive is the same wherever a body touches it: planes, and boxes seen from inside.
static inline bool scree_surface_is_flat(const scree_surface *surface)
{
    return surface->kind == SCREE_SURFACE_PLANES;
}

/// The outline of a solid as it lies, about surface->centre; its radius is that of no grain, which l_0 could come from.
static inline scree_polygon scree_surface_outline(const scree_surface *surface)
{
    return (scree_polygon){.corner = (const double(*)[2])surface->posed,
                           .count = surface->corner_count,
                           .radius = 0,
                           .bound = surface->bound};
}

/// Where a sphere with its centre at `place` may touch a primitive, now.
void scree_primitive_closest_point(const scree_wall_set *wall_set, size_t primitive, const scree_vector place,
                                   scree_closest_point *closest);

/// Whether a sphere of this radius reaches a closest point. NaN counts as touching, so that it is noticed.
bool scree_closest_point_touches(const scree_wall_set *wall_set, size_t primitive, const scree_closest_point *closest,
                                 double radius);

/// Calls `found(context, primitive)` for the primitives of all walls within `reach` of `place`, each once.
scree_status scree_wall_set_near(const scree_wall_set *wall_set, const scree_vector place, double reach,
                                 scree_status (*found)(void *context, size_t primitive), void *context) SCREE_MUST_USE;

/// How far a sphere with its centre at `place` stands inside of what wall `k` bounds now: the distance of the centre
/// from it, negative where it is on the wrong side. A mesh has no sides, and is looked for within `reach` only; an open
/// wall has sides only beside it.
double scree_surface_clearance(const scree_wall_set *wall_set, int k, const scree_vector place, double reach);

/// Walls as triangles, for pictures: three corners each; in 2D lines, whose last two corners are the same.
typedef struct scree_wall_triangles {
    double (*corner)[9]; ///< m
    int32_t *wall;       ///< index of the wall
    size_t count;
} scree_wall_triangles;

/// All walls at their present poses, round ones in facets; planes as far as `low` and `high` (a box that holds all
/// bodies) reach. wall_set may be NULL: nothing. Errors: memory.
scree_status scree_wall_set_triangles(const scree_wall_set *wall_set, const double low[3], const double high[3],
                                      scree_wall_triangles *triangles, scree_error *error) SCREE_MUST_USE;
void scree_wall_triangles_destroy(scree_wall_triangles *triangles);

#endif
