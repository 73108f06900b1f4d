/// The schema table of walls: keys of each shape. See schema.c.
#include "case/schema_walls.h"

#include "case/wall_motion.h"
#include "module/key_rows.h"

typedef scree_config_wall wall;
static const scree_choice surface_shapes[] = {
    {"plane", SCREE_SHAPE_OF_PLANE, "a half-space"},
    {"box", SCREE_SHAPE_OF_BOX, "with sides along the axes"},
    {"cylinder", SCREE_SHAPE_OF_CYLINDER, "round, with any axis (3D)"},
    {"cone", SCREE_SHAPE_OF_CONE, "a truncated or a pointed cone (3D)"},
    {"mesh", SCREE_SHAPE_OF_MESH, "triangles of an STL file, both sides of them (3D)"},
    {0},
};
static const scree_choice sides[] = {
    {"inside", SCREE_SIDE_INSIDE, "the particles are inside: a container"},
    {"outside", SCREE_SIDE_OUTSIDE, "the particles are outside: a solid body, or a tube"},
    {0},
};
static const scree_choice ends[] = {
    {"open", SCREE_ENDS_OPEN, "particles can pass, and touch the rims"},
    {"closed", SCREE_ENDS_CLOSED, "by planes"},
    {0},
};
#define PLACE(owner, member, ...)                                                                                      \
    KEY(owner, member, SCREE_KEY_VECTOR, .unit = "m", FROM("-1e6 m"), TO("1e6 m"), __VA_ARGS__)
#define WALL_HEAD                                                                                                      \
    {.name = "shape",                                                                                                  \
     .type = SCREE_KEY_CHOICE,                                                                                         \
     .choices = surface_shapes,                                                                                        \
     .offset = offsetof(wall, shape),                                                                                  \
     .meaning = "Shape of the wall."},                                                                                 \
        KEY(wall, name, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),                                       \
            .meaning = "Name in tables and for --set; auto: the shape, numbered from 1 if there are several.")
#define WALL_TAIL                                                                                                      \
    KEY(wall, material, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),                                       \
        .meaning = "Name of its material, or `rigid`; auto: wall_material of the particles that touch it."),           \
        NUMBER(wall, friction, "1", .standard = "auto", FROM("0"), TO("10"),                                           \
               .meaning = "Friction of particles on it; auto: their material's wall_friction."),                       \
        CHOICE(wall, motion, scree_wall_motion_choices, .standard = "velocity",                                        \
               .meaning = "How it moves, beside its spin."),                                                           \
        SCHEDULE(wall, velocity, "m/s", .standard = "[0, 0]", .components = 3, FROM("-1000 m/s"), TO("1000 m/s"),      \
                 .when = "motion=velocity",                                                                            \
                 .meaning = "Velocity, or a table of it over the time for which the walls have been moving."),         \
        SCHEDULE(wall, displacement, "m", .components = 3, FROM("-1e6 m"), TO("1e6 m"), .when = "motion=displacement", \
                 .meaning = "Table over that time: how far it is from where its shape is given."),                     \
        KEY(wall, amplitude, SCREE_KEY_VECTOR, .unit = "m", FROM("-1 km"), TO("1 km"), .when = "motion=vibration",     \
            .meaning = "Amplitude in each direction."),                                                                \
        NUMBER(wall, frequency, "1/s", ABOVE("0 1/s"), TO("1e9 1/s"), .when = "motion=vibration",                      \
               .meaning = "Cycles in a second."),                                                                      \
        NUMBER(wall, phase, "rad", .standard = "0 degrees", FROM("-360 degrees"), TO("360 degrees"),                   \
               .when = "motion=vibration", .meaning = "Phase of its sine when it begins to move."),                    \
        KEY(wall, direction, SCREE_KEY_VECTOR, .unit = "1", FROM("-1e6"), TO("1e6"), .when = "motion=servo",           \
            .meaning = "In which it moves and presses; any length."),                                                  \
        SCHEDULE(wall, force, "N", FROM("0 N"), TO("1e12 N"), .when = "motion=servo",                                  \
                 .meaning = "Force on the particles along `direction`, or a table of it."),                            \
        NUMBER(wall, area, "m2", .standard = "auto", ABOVE("0 m2"), TO("1e12 m2"), .when = "motion=servo",             \
               .meaning = "Area that it presses with; auto: that of its shape, seen along `direction`."),              \
        NUMBER(wall, servo_gain, "1", .standard = "1", ABOVE("0"), TO("10"), .when = "motion=servo",                   \
               .meaning = "Admittance of the servo over that of the particles; 1 absorbs waves."),                     \
        NUMBER(wall, servo_velocity, "m/s", .standard = "auto", ABOVE("0 m/s"), TO("1000 m/s"),                        \
               .when = "motion=servo",                                                                                 \
               .meaning = "Its largest speed; auto: a hundredth of the smallest radius in a step."),                   \
        KEY(wall, spin, SCREE_KEY_VECTOR, .unit = "rad/s", .standard = "[0, 0]", FROM("-1e6 rad/s"), TO("1e6 rad/s"),  \
            .meaning = "Constant angular velocity; none for planes."),                                                 \
        PLACE(wall, centre, .standard = "[0, 0]", .meaning = "Point that it turns about, at the begin.")
#define WALL_SIDE CHOICE(wall, side, sides, .standard = "inside", .meaning = "Where the particles are.")
#define WALL_AXIS                                                                                                      \
    PLACE(wall, start, .meaning = "One end of the axis."), PLACE(wall, end, .meaning = "The other end of the axis.")
#define WALL_ENDS CHOICE(wall, ends, ends, .standard = "closed", .meaning = "What is at both ends of the axis.")
static const scree_key plane_keys[] = {
    WALL_HEAD,
    PLACE(wall, point, .meaning = "A point of the plane."),
    KEY(wall, normal, SCREE_KEY_VECTOR, .unit = "1", FROM("-1e6"), TO("1e6"),
        .meaning = "Normal, towards the particles; any length."),
    WALL_TAIL,
};
static const scree_key box_keys[] = {
    WALL_HEAD,
    PLACE(wall, lower, .meaning = "Corner with the smallest coordinates."),
    PLACE(wall, upper, .meaning = "Corner with the largest coordinates."),
    WALL_SIDE,
    WALL_TAIL,
};
static const scree_key cylinder_keys[] = {
    WALL_HEAD, WALL_AXIS, NUMBER(wall, radius, "m", ABOVE("0 m"), TO("1e6 m"), .meaning = "Radius of the cylinder."),
    WALL_SIDE, WALL_ENDS, WALL_TAIL,
};
static const scree_key cone_keys[] = {
    WALL_HEAD,
    WALL_AXIS,
    NUMBER(wall, radius_start, "m", FROM("0 m"), TO("1e6 m"), .meaning = "Radius at `start`."),
    NUMBER(wall, radius_end, "m", FROM("0 m"), TO("1e6 m"), .meaning = "Radius at `end`."),
    WALL_SIDE,
    WALL_ENDS,
    WALL_TAIL,
};
static const scree_key mesh_keys[] = {
    WALL_HEAD,
    KEY(wall, file, SCREE_KEY_TEXT, FROM("1"), TO("4000"),
        .meaning = "STL file, binary or ASCII, relative to the case file."),
    KEY(wall, checksum, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),
        .meaning = "Of the content of the file: another one is refused; auto: any."),
    NUMBER(wall, scale, "m", .standard = "1 m", ABOVE("0 m"), TO("1e6 m"),
           .meaning = "Length of one unit of the file, e.g. 1 mm."),
    PLACE(wall, at, .standard = "[0, 0]", .meaning = "Where the origin of the file lies."),
    NUMBER(wall, smooth, "rad", .standard = "15 degrees", FROM("0.1 degrees"), TO("60 degrees"),
           .meaning = "Triangles that meet at less than this angle are one smooth surface."),
    WALL_TAIL,
};

const scree_section scree_wall_sections[SCREE_WALL_SECTIONS] = {
    TABLE("plane", "A half-space; in 2D a half-plane.", plane_keys),
    TABLE("box", "A box with sides along the axes; in 2D a rectangle.", box_keys),
    TABLE("cylinder", "A cylinder with any axis.", cylinder_keys),
    TABLE("cone", "A truncated or pointed cone with any axis.", cone_keys),
    TABLE("mesh", "Triangles of an STL file; contacts on both sides.", mesh_keys),
};
