/// What the shapes of walls say: the structs that their keys fill, and the keys that several of them have.
#ifndef SCREE_SHAPE_WALL_KEYS_H
#define SCREE_SHAPE_WALL_KEYS_H

#include "module/key_rows.h"
#include "module/wall_shape.h"
#include "shape/wall_set.h"

typedef enum scree_side { SCREE_SIDE_INSIDE, SCREE_SIDE_OUTSIDE } scree_side;
typedef enum scree_ends { SCREE_ENDS_OPEN, SCREE_ENDS_CLOSED } scree_ends;
extern const scree_choice scree_wall_sides[], scree_wall_ends[];

typedef struct scree_plane_keys {
    double point[3], normal[3]; ///< m, 1
} scree_plane_keys;

typedef struct scree_box_keys {
    double lower[3], upper[3]; ///< m
    int side;                  ///< scree_side, where the bodies are
} scree_box_keys;

typedef struct scree_polygon_keys {
    double (*corners)[2]; ///< m, counter-clockwise
    int64_t corner_count;
} scree_polygon_keys;

/// Of a cylinder radius_start alone.
typedef struct scree_round_keys {
    double start[3], end[3];         ///< m: axis
    double radius_start, radius_end; ///< m
    int side;                        ///< scree_side
    int ends;                        ///< scree_ends
} scree_round_keys;

typedef struct scree_mesh_keys {
    char *file;     ///< path of an STL file, relative to the case file until the case is read
    char *checksum; ///< content of that file; auto: whatever it is
    double scale;   ///< m per unit of the file
    double at[3];   ///< m, where the origin of the file lies
    double smooth;  ///< rad, contacts whose normals differ by less are one
} scree_mesh_keys;

#define PLACE(owner, member, ...)                                                                                      \
    KEY(owner, member, SCREE_KEY_VECTOR, .unit = "m", FROM("-1e6 m"), TO("1e6 m"), __VA_ARGS__)
#define WALL_SIDE(owner)                                                                                               \
    CHOICE(owner, side, scree_wall_sides, .standard = "inside", .meaning = "Where the particles are.")
#define WALL_AXIS                                                                                                      \
    PLACE(scree_round_keys, start, .meaning = "One end of the axis."),                                                 \
        PLACE(scree_round_keys, end, .meaning = "The other end of the axis.")
#define WALL_ENDS                                                                                                      \
    CHOICE(scree_round_keys, ends, scree_wall_ends, .standard = "closed",                                              \
           .meaning = "What is at both ends of the axis.")

/// A body of revolution between two radii [m]: its sides and, where it is closed, its ends.
void scree_round_make(const scree_round_keys *keys, double low, double high, scree_surface *surface);
const char *scree_round_wrong(const scree_round_keys *keys, const char **key);

/// Gives a surface the outline of a solid body in the plane, by its corners [m]: the overlap with it is what laws of
/// areas take (contact/outlines.h).
void scree_surface_outline_set(scree_surface *surface, int count, const double (*corner)[2]);

/// Area of the larger end, seen along the axis; 0 from elsewhere.
double scree_round_face(const scree_round_keys *keys, double radius, const double direction[3]);

#endif
