/// The tables of everything in a state: where it lies, its unit, what it means. Every member of `scree_state` is in one
/// of them except the counts (they are the lengths of the arrays) and row_of_id (the inverse of `id`).
#include "state/fields.h"

#include <stddef.h>
#include <string.h>

// Offsets of component 0 and strides, for arrays of structures, plain arrays, walls and single values.
#define IN_ARRAY(array, type, member)                                                                                  \
    .array_offset = offsetof(scree_state, array), .stride = sizeof(type), .offset = offsetof(type, member)
#define PLAIN_ARRAY(array, type) .array_offset = offsetof(scree_state, array), .stride = sizeof(type), .offset = 0

const scree_field scree_fields[] = {
    {"id", SCREE_FIELD_UINT32, 1, "1", SCREE_FIELD_STATE, true, "number of the body, never changes",
     PLAIN_ARRAY(id, uint32_t), .rows = SCREE_ROWS_BODIES},
    {"position", SCREE_FIELD_DOUBLE, SCREE_VECTOR, "m", SCREE_FIELD_STATE, true, "centre", IN_ARRAY(row, scree_row, x),
     .rows = SCREE_ROWS_BODIES},
    {"radius", SCREE_FIELD_DOUBLE, 1, "m", SCREE_FIELD_STATE, true, "radius", IN_ARRAY(row, scree_row, radius),
     .rows = SCREE_ROWS_BODIES},
    {"mass", SCREE_FIELD_DOUBLE, 1, "kg", SCREE_FIELD_STATE, true, "mass", IN_ARRAY(row, scree_row, mass),
     .rows = SCREE_ROWS_BODIES},
    {"material", SCREE_FIELD_DOUBLE, 1, "1", SCREE_FIELD_STATE, true, "number of the material; 0 is that of the particles",
     IN_ARRAY(row, scree_row, material), .rows = SCREE_ROWS_BODIES, .only_dimension = 2},
    {"material", SCREE_FIELD_DOUBLE, 1, "1", SCREE_FIELD_STATE, true, "number of the material; 0 is that of the particles",
     IN_ARRAY(turn, scree_turn_row, material), .rows = SCREE_ROWS_BODIES, .only_dimension = 3},
    {"angle", SCREE_FIELD_DOUBLE, 1, "rad", SCREE_FIELD_STATE, true, "rotation since the start, counter-clockwise",
     PLAIN_ARRAY(angle, double), .rows = SCREE_ROWS_BODIES, .only_dimension = 2},
    {"scheme_velocity", SCREE_FIELD_DOUBLE, SCREE_VECTOR, "m/s", SCREE_FIELD_STATE, false,
     "velocity that the integrator keeps: half a step behind the position in position_verlet",
     IN_ARRAY(row, scree_row, vx), .rows = SCREE_ROWS_BODIES},
    {"scheme_spin", SCREE_FIELD_DOUBLE, 1, "rad/s", SCREE_FIELD_STATE, false,
     "angular velocity that the integrator keeps, counter-clockwise", IN_ARRAY(row, scree_row, spin),
     .rows = SCREE_ROWS_BODIES, .only_dimension = 2},
    {"scheme_spin", SCREE_FIELD_DOUBLE, 3, "rad/s", SCREE_FIELD_STATE, false,
     "angular velocity that the integrator keeps", IN_ARRAY(turn, scree_turn_row, wx), .rows = SCREE_ROWS_BODIES,
     .only_dimension = 3},
    {"reference", SCREE_FIELD_DOUBLE, SCREE_VECTOR, "m", SCREE_FIELD_STATE, false,
     "centre at the start of the loading stage", PLAIN_ARRAY(reference, scree_vector), .rows = SCREE_ROWS_BODIES},
    {"sampled_velocity", SCREE_FIELD_DOUBLE, SCREE_VECTOR, "m/s", SCREE_FIELD_STATE, false,
     "velocity at the last sample", PLAIN_ARRAY(sampled_velocity, scree_vector), .rows = SCREE_ROWS_BODIES},
    {"force_sum", SCREE_FIELD_INT64, SCREE_VECTOR, "1", SCREE_FIELD_STATE, false,
     "sum of the contact and boundary forces, in units of scalars/force_quantum", IN_ARRAY(sum, scree_sum_row, fx),
     .rows = SCREE_ROWS_BODIES},
    {"torque_sum", SCREE_FIELD_INT64, 1, "1", SCREE_FIELD_STATE, false,
     "sum of the contact torques, in units of scalars/torque_quantum", IN_ARRAY(sum, scree_sum_row, torque),
     .rows = SCREE_ROWS_BODIES, .only_dimension = 2},
    {"torque_sum", SCREE_FIELD_INT64, 3, "1", SCREE_FIELD_STATE, false,
     "sum of the contact torques, in units of scalars/torque_quantum", IN_ARRAY(torque, scree_torque_row, x),
     .rows = SCREE_ROWS_BODIES, .only_dimension = 3},
    {"coordination", SCREE_FIELD_INT64, 1, "1", SCREE_FIELD_STATE, true, "number of touching neighbours and walls",
     IN_ARRAY(sum, scree_sum_row, contacts), .rows = SCREE_ROWS_BODIES},
    {"rebuild", SCREE_FIELD_DOUBLE, SCREE_VECTOR, "m", SCREE_FIELD_DERIVED, false,
     "centre at the last rebuild of the neighbour list", PLAIN_ARRAY(rebuild, scree_vector), .rows = SCREE_ROWS_BODIES},
};
const size_t scree_field_count = sizeof scree_fields / sizeof *scree_fields;

#define CONTACT(name_, type_, components_, unit_, member, meaning_)                                                    \
    {                                                                                                                  \
        "contacts/" name_, type_, components_, unit_, SCREE_FIELD_STATE, false, meaning_,                              \
            IN_ARRAY(contact, scree_contact_memory, member), .rows = SCREE_ROWS_CONTACTS                               \
    }
#define BESIDE_CONTACT(name_, type_, array_, c_type, unit_, member, meaning_, rows_)                                   \
    {                                                                                                                  \
        "contacts/" name_, type_, 4, unit_, SCREE_FIELD_STATE, false, meaning_, IN_ARRAY(array_, c_type, member),      \
            .rows = rows_                                                                                              \
    }
#define LOOP(name_, type_, c_type, unit_, member, meaning_)                                                            \
    {                                                                                                                  \
        "boundary/" name_, type_, 1, unit_, SCREE_FIELD_STATE, true, meaning_, PLAIN_ARRAY(loop.member, c_type),       \
            .rows = SCREE_ROWS_LOOP, .only_dimension = 2                                                               \
    }
#define HULL(name_, type_, components_, c_type, unit_, member, meaning_, rows_)                                        \
    {                                                                                                                  \
        "hull/" name_, type_, components_, unit_, SCREE_FIELD_STATE, true, meaning_, PLAIN_ARRAY(hull.member, c_type), \
            .rows = rows_, .only_dimension = 3                                                                         \
    }
#define DRIVE(name_, type_, components_, unit_, member, meaning_)                                                      \
    ONE("drive/" name_, type_, components_, unit_, drive.member, meaning_)
#define MEMBRANE(name_, components_, c_type, unit_, member, meaning_)                                                  \
    {                                                                                                                  \
        "membrane/" name_, SCREE_FIELD_DOUBLE, components_, unit_, SCREE_FIELD_STATE, false, meaning_,                 \
            PLAIN_ARRAY(membrane.member, c_type), .rows = SCREE_ROWS_MEMBRANE                                          \
    }
#define WALL(name_, type_, components_, unit_, member, meaning_)                                                       \
    {                                                                                                                  \
        "walls/" name_, type_, components_, unit_, SCREE_FIELD_STATE, true, meaning_,                                  \
            .array_offset = offsetof(scree_state, wall), .stride = sizeof(scree_wall),                                 \
            .offset = offsetof(scree_wall, member), .rows = SCREE_ROWS_WALLS                                           \
    }
#define SURFACE(name_, components_, unit_, member, meaning_)                                                           \
    {                                                                                                                  \
        "case_walls/" name_, SCREE_FIELD_DOUBLE, components_, unit_, SCREE_FIELD_STATE, true, meaning_,                \
            .array_offset = offsetof(scree_state, surface), .stride = sizeof(scree_surface_load),                      \
            .offset = offsetof(scree_surface_load, member), .rows = SCREE_ROWS_SURFACES                                \
    }
#define ONE(name_, type_, components_, unit_, member, meaning_)                                                        \
    {                                                                                                                  \
        name_, type_, components_, unit_, SCREE_FIELD_STATE, false, meaning_,                                          \
            .array_offset = offsetof(scree_state, member), .stride = sizeof(((scree_state *)0)->member), .offset = 0,  \
            .rows = SCREE_ROWS_ONE                                                                                     \
    }
#define PERIODIC(name_, type_, components_, unit_, member, meaning_)                                                       \
    {                                                                                                                  \
        "periodic/" name_, type_, components_, unit_, SCREE_FIELD_STATE, true, meaning_,                                   \
            .array_offset = offsetof(scree_state, periodic.member), .stride = sizeof(((scree_state *)0)->periodic.member),     \
            .offset = 0, .rows = SCREE_ROWS_ONE                                                                        \
    }

const scree_field scree_members[] = {
    CONTACT("first", SCREE_FIELD_UINT32, 1, "1", first, "id of the first body"),
    CONTACT("second", SCREE_FIELD_UINT32, 1, "1", second,
            "id of the second body, larger than the first; 4294967280 + index for a plate, 2147483648 + element for a wall "
            "of the case"),
    CONTACT("history", SCREE_FIELD_DOUBLE, SCREE_HISTORY, "1", history, "memory of the contact law, in its own units"),
    BESIDE_CONTACT("booking", SCREE_FIELD_FLOAT, booking, scree_booking, "N", value,
                   "damping force and dashpot x, y, z that the ledger needs again, where the history row has no room",
                   SCREE_ROWS_BOOKING),
    BESIDE_CONTACT("rolling", SCREE_FIELD_DOUBLE, rolling, scree_rolling, "1", value,
                   "stretch of rolling and angle of twist: x, y, z [m] and [rad]; 2D: stretch [m]",
                   SCREE_ROWS_ROLLING),
    BESIDE_CONTACT("rolling_booked", SCREE_FIELD_FLOAT, rolling, scree_rolling, "1", booked,
                   "dashpots of rolling [N] and twisting [N m] that the ledger needs again", SCREE_ROWS_ROLLING),

    LOOP("id", SCREE_FIELD_UINT32, uint32_t, "1", id, "bodies along the closed boundary, counter-clockwise, by id"),
    LOOP("loaded", SCREE_FIELD_UINT8, uint8_t, "1", loaded,
         "1: the edge from this body to the next carries the lateral pressure"),
    LOOP("x", SCREE_FIELD_DOUBLE, double, "m", x, "x when the boundary was last found"),
    LOOP("y", SCREE_FIELD_DOUBLE, double, "m", y, "y when the boundary was last found"),
    LOOP("force_x", SCREE_FIELD_DOUBLE, double, "N", fx, "x component of the force of the pressure on this body"),
    LOOP("force_y", SCREE_FIELD_DOUBLE, double, "N", fy, "y component of the force of the pressure on this body"),

    HULL("id", SCREE_FIELD_UINT32, 1, uint32_t, "1", id, "bodies on the hull, by id, ascending", SCREE_ROWS_HULL_NODES),
    HULL("place", SCREE_FIELD_DOUBLE, 3, scree_vector, "m", place, "centre when the hull was last found",
         SCREE_ROWS_HULL_NODES),
    HULL("force", SCREE_FIELD_DOUBLE, 3, scree_vector, "N", force, "force of the boundary on this body",
         SCREE_ROWS_HULL_NODES),
    HULL("triangle", SCREE_FIELD_UINT32, 3, uint32_t[3], "1", triangle,
         "places in hull/id of the corners, counter-clockwise seen from outside", SCREE_ROWS_HULL_TRIANGLES),
    HULL("loaded", SCREE_FIELD_UINT8, 1, uint8_t, "1", loaded,
         "1: the triangle carries the pressure; 2, 3: it faces the bottom, top plate", SCREE_ROWS_HULL_TRIANGLES),

    {"drive/force", SCREE_FIELD_DOUBLE, 3, "N", SCREE_FIELD_STATE, false,
     "force of the imposed rates on each body of the boundary", PLAIN_ARRAY(drive.force, scree_vector),
     .rows = SCREE_ROWS_DRIVE},
    DRIVE("target", SCREE_FIELD_DOUBLE, 9, "1/s", target, "wanted velocity gradient, 3 x 3 by rows"),
    DRIVE("prescribed", SCREE_FIELD_INT64, 9, "1", prescribed,
          "of each component of target: 0 free, 1 prescribed, 2 prescribed for the mean of it and its mirror"),
    DRIVE("viscosity", SCREE_FIELD_DOUBLE, 1, "Pa s", viscosity, "stress over the error of the rate"),
    DRIVE("rate", SCREE_FIELD_DOUBLE, 9, "1/s", rate, "velocity gradient of the boundary, 3 x 3 by rows"),
    DRIVE("stress", SCREE_FIELD_DOUBLE, 9, "Pa", stress,
          "stress that the boundary applies besides the pressure, 3 x 3 by rows, tension positive"),
    DRIVE("achieved", SCREE_FIELD_DOUBLE, 1, "1/s", achieved,
          "integral of target : rate over time since the last sample"),
    DRIVE("wanted", SCREE_FIELD_DOUBLE, 1, "1/s", wanted,
          "integral of target : target over time since the last sample"),

    MEMBRANE("rest", 3, scree_vector, "m", rest,
             "unstressed lengths of the springs to the next body of the chain, in 3D of the ring and to two of the ring "
             "above; 0: none"),
    MEMBRANE("pressure_force", 3, scree_vector, "N", press, "force of the pressure on this body of the membrane"),
    MEMBRANE("chain_force", 3, scree_vector, "N", force,
             "force of the springs on this body of the membrane, and of the plate on an end"),
    ONE("scalars/grains", SCREE_FIELD_UINT64, 1, "1", grains, "number of grains: ids from it on are of the membrane"),
    ONE("scalars/membrane_right", SCREE_FIELD_UINT64, 1, "1", membrane.right, "2D: bodies of the membrane's right side"),
    ONE("scalars/membrane_around", SCREE_FIELD_UINT64, 1, "1", membrane.around, "3D: bodies of a ring of the membrane"),
    ONE("scalars/membrane_radius", SCREE_FIELD_DOUBLE, 1, "m", membrane.radius, "radius of the membrane's bodies"),
    ONE("scalars/membrane_ramp_time", SCREE_FIELD_DOUBLE, 1, "s", membrane.ramp_time,
        "time in which the membrane takes the pressure over"),
    ONE("scalars/membrane_share", SCREE_FIELD_DOUBLE, 1, "1", membrane.share, "fraction of that time passed"),

    WALL("position", SCREE_FIELD_DOUBLE, 1, "m", position, "position along the normal: normal . x = position"),
    WALL("normal", SCREE_FIELD_DOUBLE, 3, "1", normal, "unit normal, towards the bodies"),
    WALL("velocity", SCREE_FIELD_DOUBLE, 1, "m/s", velocity, "velocity along the normal"),
    WALL("tangential_velocity", SCREE_FIELD_DOUBLE, 3, "m/s", tangential_velocity, "velocity in its own plane"),
    WALL("force", SCREE_FIELD_DOUBLE, 1, "N", force, "normal force of the bodies on the wall, compression positive"),
    WALL("shear", SCREE_FIELD_DOUBLE, 3, "N", shear, "tangential force of the bodies on the wall"),
    WALL("active", SCREE_FIELD_INT32, 1, "1", active, "1: the wall exists in this stage"),
    WALL("material", SCREE_FIELD_INT32, 1, "1", material, "number of the material; 0 is that of the particles"),

    SURFACE("force", 3, "N", force, "force of the bodies on each wall of the case"),
    SURFACE("torque", 3, "N m", torque, "torque of the bodies on each wall of the case, about its centre"),
    SURFACE("work", 1, "J", work, "work of each wall of the case on the bodies"),
    ONE("scalars/surface_ticks", SCREE_FIELD_UINT64, 1, "1", surface_ticks,
        "ticks for which the walls of the case have been moving"),
    ONE("scalars/surface_moving", SCREE_FIELD_UINT64, 1, "1", surface_moving, "1: the walls of the case move now"),
    ONE("scalars/surface_speed", SCREE_FIELD_DOUBLE, 1, "m/s", surface_speed,
        "bound of the velocity of the walls of the case"),

    ONE("scalars/step", SCREE_FIELD_UINT64, 1, "1", step, "time since the start of the run, in ticks"),
    ONE("scalars/evaluations", SCREE_FIELD_UINT64, 1, "1", evaluations,
        "steps taken since the start of the run, one force evaluation each"),
    ONE("scalars/sampled_step", SCREE_FIELD_UINT64, 1, "1", sampled_step, "step of the last sample"),
    ONE("scalars/tick", SCREE_FIELD_DOUBLE, 1, "s", tick, "unit of step: the smallest time step of the scheme"),
    ONE("scalars/step_size", SCREE_FIELD_DOUBLE, 1, "s", step_size, "the last time step"),
    ONE("scalars/kick_size", SCREE_FIELD_DOUBLE, 1, "s", kick_size, "mean of the last two time steps"),
    ONE("scalars/force_quantum", SCREE_FIELD_DOUBLE, 1, "N", force_quantum, "unit of force_sum"),
    ONE("scalars/torque_quantum", SCREE_FIELD_DOUBLE, 1, "N m", torque_quantum, "unit of torque_sum"),
    ONE("scalars/largest_overlap", SCREE_FIELD_DOUBLE, 1, "m", largest_overlap, "largest indentation of all contacts"),
    ONE("scalars/largest_speed", SCREE_FIELD_DOUBLE, 1, "m/s", largest_speed,
        "bound of the surface speed of all bodies"),
    ONE("scalars/pressure", SCREE_FIELD_DOUBLE, 1, "Pa", pressure, "confining pressure applied now"),
    ONE("scalars/boundary_updated", SCREE_FIELD_UINT64, 1, "1", loop.updated,
        "step at which the boundary was last found"),

    ONE("scalars/hull_updated", SCREE_FIELD_UINT64, 1, "1", hull.updated, "step at which the hull was last found"),

    PERIODIC("lattice", SCREE_FIELD_DOUBLE, 9, "m", lattice,
         "lattice vectors of the periodic cell as columns, 3 x 3 by rows; unit vectors where it is not periodic"),
    PERIODIC("reference", SCREE_FIELD_DOUBLE, 9, "m", reference,
         "the same lattice vectors at the start of the loading stage"),
    PERIODIC("gradient", SCREE_FIELD_DOUBLE, 9, "1/s", gradient,
         "velocity gradient of the last step, 3 x 3 by rows, extension positive"),
    PERIODIC("drift", SCREE_FIELD_DOUBLE, 9, "1/s", drift, "running mean of the velocity gradient, for the servo"),
    PERIODIC("strain", SCREE_FIELD_DOUBLE, 9, "1", strain, "integral of the velocity gradient over time"),
    PERIODIC("virial", SCREE_FIELD_DOUBLE, 9, "J", virial, "sum over contacts of force on the first (x) branch"),
    PERIODIC("motion", SCREE_FIELD_DOUBLE, 9, "J", motion,
         "sum over bodies of mass velocity (x) velocity, relative to the affine field"),
    PERIODIC("directions", SCREE_FIELD_UINT64, 1, "1", directions, "periodic directions: 1 x, 2 y, 4 z, added up"),

    ONE("strain/gradient", SCREE_FIELD_DOUBLE, 9, "1", strain.gradient,
        "displacement gradient accumulated from the boundary, 3 x 3 by rows, extension positive"),
    ONE("strain/redetected", SCREE_FIELD_DOUBLE, 1, "1", strain.redetected,
        "sum of log (enclosed volume after / before) over the re-detections of the boundary"),

    ONE("forced/id", SCREE_FIELD_INT64, 1, "1", forced.id, "body whose spin is prescribed"),
    ONE("forced/active", SCREE_FIELD_INT64, 1, "1", forced.active, "0: there is none"),
    ONE("forced/spin", SCREE_FIELD_DOUBLE, 3, "rad/s", forced.spin, "its spin"),
    ONE("forced/torque", SCREE_FIELD_DOUBLE, 3, "N m", forced.torque, "torque of its contacts on it"),

    ONE("ledger/damping", SCREE_FIELD_DOUBLE, 1, "J", ledger.damping, "energy dissipated by contact damping"),
    ONE("ledger/friction", SCREE_FIELD_DOUBLE, 1, "J", ledger.friction, "energy dissipated by sliding"),
    ONE("ledger/stiffness", SCREE_FIELD_DOUBLE, 1, "J", ledger.stiffness,
        "energy put into tangential springs by the change of their stiffness"),
    ONE("ledger/plates", SCREE_FIELD_DOUBLE, 1, "J", ledger.plates, "work of the walls on the bodies"),
    ONE("ledger/pressure", SCREE_FIELD_DOUBLE, 1, "J", ledger.pressure, "work of the pressure on the bodies"),
    ONE("ledger/periodic", SCREE_FIELD_DOUBLE, 1, "J", ledger.periodic, "work of the deforming periodic cell on the bodies"),
    ONE("ledger/boundary", SCREE_FIELD_DOUBLE, 1, "J", ledger.boundary,
        "work of the other forces of the boundary on the bodies"),
    ONE("ledger/forced", SCREE_FIELD_DOUBLE, 1, "J", ledger.forced,
        "work of the torque that keeps a body at its prescribed spin"),
    ONE("ledger/gravity", SCREE_FIELD_DOUBLE, 1, "J", ledger.gravity, "work of gravity on the bodies"),
    ONE("ledger/initial", SCREE_FIELD_DOUBLE, 1, "J", ledger.initial, "energy when the ledger was opened"),
    ONE("ledger/scheme", SCREE_FIELD_DOUBLE, 1, "J", ledger.scheme,
        "put into the kinetic energy of the scheme by changes of its step"),
    ONE("ledger/turnover", SCREE_FIELD_DOUBLE, 1, "J", ledger.turnover, "sum of the magnitudes of all work increments"),

    ONE("stage/index", SCREE_FIELD_INT64, 1, "1", stage.index, "number of the stage in the case"),
    ONE("stage/first_step", SCREE_FIELD_UINT64, 1, "1", stage.first_step, "step at which the stage began"),
    ONE("stage/first_time", SCREE_FIELD_DOUBLE, 1, "s", stage.first_time, "time at which the stage began"),
    ONE("stage/first_evaluations", SCREE_FIELD_UINT64, 1, "1", stage.first_evaluations,
        "scalars/evaluations when the stage began"),
    ONE("stage/reference", SCREE_FIELD_DOUBLE, SCREE_STAGE_REFERENCES, "1", stage.reference,
        "numbers of the stage, in its own SI units"),
    ONE("stage/samples", SCREE_FIELD_INT64, 1, "1", stage.samples, "rows of series.csv written in this run"),
    ONE("stage/snapshots", SCREE_FIELD_INT64, 1, "1", stage.snapshots, "snapshots written in this run"),
    ONE("stage/counter", SCREE_FIELD_INT64, 1, "1", stage.counter, "counter of the stage"),
};
const size_t scree_member_count = sizeof scree_members / sizeof *scree_members;

bool scree_field_exists(const scree_field *field, int dimension)
{
    return field->only_dimension == 0 || field->only_dimension == dimension;
}

int scree_components(int components, int dimension)
{
    if (components == SCREE_VECTOR) return dimension;
    if (components == SCREE_AXIAL_VECTOR) return dimension == 3 ? 3 : 1;
    return components;
}

size_t scree_field_size(scree_field_type type)
{
    switch (type) {
    case SCREE_FIELD_DOUBLE:
    case SCREE_FIELD_INT64:
    case SCREE_FIELD_UINT64:
        return 8;
    case SCREE_FIELD_FLOAT:
    case SCREE_FIELD_INT32:
    case SCREE_FIELD_UINT32:
        return 4;
    case SCREE_FIELD_UINT8:
        break;
    }
    return 1;
}

size_t scree_field_rows_count(const scree_state *state, const scree_field *field)
{
    switch (field->rows) {
    case SCREE_ROWS_BODIES:
        return state->count;
    case SCREE_ROWS_CONTACTS:
        return state->contact_count;
    case SCREE_ROWS_BOOKING:
        return state->booking ? state->contact_count : 0;
    case SCREE_ROWS_ROLLING:
        return state->rolling ? state->contact_count : 0;
    case SCREE_ROWS_LOOP:
        return state->loop.count;
    case SCREE_ROWS_HULL_NODES:
        return state->hull.node_count;
    case SCREE_ROWS_HULL_TRIANGLES:
        return state->hull.triangle_count;
    case SCREE_ROWS_DRIVE:
        return state->drive.count;
    case SCREE_ROWS_MEMBRANE:
        return state->membrane.count;
    case SCREE_ROWS_WALLS:
        return SCREE_WALL_COUNT;
    case SCREE_ROWS_SURFACES:
        return SCREE_SURFACES;
    case SCREE_ROWS_ONE:
        break;
    }
    return 1;
}

const void *scree_field_get(const scree_state *state, const scree_field *field, size_t row)
{
    const unsigned char *place = (const unsigned char *)state + field->array_offset, *first = place;
    // Arrays are behind a pointer; walls and single values are in the state itself.
    if (field->rows <= SCREE_ROWS_MEMBRANE) memcpy(&first, place, sizeof(void *));
    return first + row * field->stride + field->offset;
}

void *scree_field_get_mutable(scree_state *state, const scree_field *field, size_t row)
{
    return (void *)(uintptr_t)scree_field_get(state, field, row);
}
