/// The schema table of walls: what all of them say. The keys of each shape stand in its own file (src/shape/wall_*.c).
#include "case/schema_walls.h"

#include "case/wall_motion.h"
#include "module/key_rows.h"

typedef scree_config_wall wall;
#define PLACE(owner, member, ...)                                                                                      \
    KEY(owner, member, SCREE_KEY_VECTOR, .unit = "m", FROM("-1e6 m"), TO("1e6 m"), __VA_ARGS__)
static const scree_key wall_keys[] = {
    {.name = "shape", .type = SCREE_KEY_CHOICE, .offset = offsetof(wall, shape), .meaning = "Shape of the wall."},
    KEY(wall, name, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),
        .meaning = "Name in tables and for --set; auto: the shape, numbered from 1 if there are several."),
    MODULE_KEYS,
    KEY(wall, material, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),
        .meaning = "Name of its material, or `rigid`; auto: wall_material of the particles that touch it."),
    NUMBER(wall, friction, "1", .standard = "auto", FROM("0"), TO("10"),
           .meaning = "Friction of particles on it; auto: their material's wall_friction."),
    CHOICE(wall, motion, scree_wall_motion_choices, .standard = "velocity",
           .meaning = "How it moves, beside its spin."),
    SCHEDULE(wall, velocity, "m/s", .standard = "[0, 0]", .components = 3, FROM("-1000 m/s"), TO("1000 m/s"),
             .when = "motion=velocity",
             .meaning = "Velocity, or a table of it over the time for which the walls have been moving."),
    SCHEDULE(wall, displacement, "m", .components = 3, FROM("-1e6 m"), TO("1e6 m"), .when = "motion=displacement",
             .meaning = "Table over that time: how far it is from where its shape is given."),
    KEY(wall, amplitude, SCREE_KEY_VECTOR, .unit = "m", FROM("-1 km"), TO("1 km"), .when = "motion=vibration",
        .meaning = "Amplitude in each direction."),
    NUMBER(wall, frequency, "1/s", ABOVE("0 1/s"), TO("1e9 1/s"), .when = "motion=vibration",
           .meaning = "Cycles in a second."),
    NUMBER(wall, phase, "rad", .standard = "0 degrees", FROM("-360 degrees"), TO("360 degrees"),
           .when = "motion=vibration", .meaning = "Phase of its sine when it begins to move."),
    KEY(wall, direction, SCREE_KEY_VECTOR, .unit = "1", FROM("-1e6"), TO("1e6"), .when = "motion=servo",
        .meaning = "In which it moves and presses; any length."),
    SCHEDULE(wall, force, "N", FROM("0 N"), TO("1e12 N"), .when = "motion=servo",
             .meaning = "Force on the particles along `direction`, or a table of it."),
    NUMBER(wall, area, "m2", .standard = "auto", ABOVE("0 m2"), TO("1e12 m2"), .when = "motion=servo",
           .meaning = "Area that it presses with; auto: that of its shape, seen along `direction`."),
    NUMBER(wall, servo_gain, "1", .standard = "1", ABOVE("0"), TO("10"), .when = "motion=servo",
           .meaning = "Admittance of the servo over that of the particles; 1 absorbs waves."),
    NUMBER(wall, servo_velocity, "m/s", .standard = "auto", ABOVE("0 m/s"), TO("1000 m/s"), .when = "motion=servo",
           .meaning = "Its largest speed; auto: a hundredth of the smallest radius in a step."),
    KEY(wall, spin, SCREE_KEY_VECTOR, .unit = "rad/s", .standard = "[0, 0]", FROM("-1e6 rad/s"), TO("1e6 rad/s"),
        .meaning = "Constant angular velocity; none for planes."),
    PLACE(wall, centre, .standard = "[0, 0]", .meaning = "Point that it turns about, at the begin."),
};

const scree_section scree_wall_sections[SCREE_WALL_SECTIONS] = {
    OPEN_TABLE("walls", "A rigid wall.", wall_keys, scree_config_wall)};
