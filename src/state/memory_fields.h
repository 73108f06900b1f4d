/// Declarations of what contacts remember, for the files of laws: a law's module lists one field a value (or vector).
/// Checkpoint, state of a snapshot, views, checks, state checksum and docs/output.md follow from the list; kernels read
/// whole rows of four.
///   SCREE_REMEMBERS(law, row, at, components, name, unit, meaning, ...)
/// row: history, last_force, rolling or rolling_last, those that the traits of the law ask for; at: number of the value
/// in this row, from 0. Behind the meaning stand designators: .only_dimension, .options (bits of the options of the law
/// under which it exists), .in_checksum (physics depends on it).
#ifndef SCREE_STATE_MEMORY_FIELDS_H
#define SCREE_STATE_MEMORY_FIELDS_H

#include "state/persistent.h"

#define SCREE_MEMORY_ROW(array, element, member, at, number, c_type)                                                   \
    .type = number, .array_offset = offsetof(scree_state, array), .stride = sizeof(element),                           \
    .offset = offsetof(element, member) + (at) * sizeof(c_type)
#define SCREE_MEMORY_history(at)                                                                                       \
    SCREE_MEMORY_ROW(contact, scree_contact_memory, history.value, at, SCREE_FIELD_DOUBLE, double)
#define SCREE_MEMORY_last_force(at)                    SCREE_MEMORY_ROW(last_force, scree_last_force, value, at, SCREE_FIELD_FLOAT, float)
#define SCREE_MEMORY_rolling(at)                       SCREE_MEMORY_ROW(rolling, scree_rolling, value, at, SCREE_FIELD_DOUBLE, double)
#define SCREE_MEMORY_rolling_last(at)                  SCREE_MEMORY_ROW(rolling, scree_rolling, last, at, SCREE_FIELD_FLOAT, float)

#define SCREE_REMEMBERS(law, row, at, components, ...) SCREE_REMEMBERS_(law, row, at, components, __VA_ARGS__)
#define SCREE_REMEMBERS_(law_, row_, at, components_, name_, unit_, meaning_, ...)                                     \
    {                                                                                                                  \
        .name = "contacts/" name_, SCREE_MEMORY_##row_(at), .components = components_, .unit = unit_,                  \
        .rows = SCREE_ROWS_CONTACTS, .meaning = meaning_, .law = &scree_module_##law_, __VA_ARGS__                     \
    }

/// The same of a pair of the persistent list; a row more: constant, the numbers that are given with the pair.
#define SCREE_HELD_ROW(member_, at, number, c_type)                                                                    \
    .type = number, .array_offset = offsetof(scree_persistent_list, member),                                           \
    .stride = sizeof(scree_persistent_member),                                                                         \
    .offset = offsetof(scree_persistent_member, member_) + (at) * sizeof(c_type)
#define SCREE_HELD_constant(at)                             SCREE_HELD_ROW(constant, at, SCREE_FIELD_DOUBLE, double)
#define SCREE_HELD_history(at)                              SCREE_HELD_ROW(history.value, at, SCREE_FIELD_DOUBLE, double)
#define SCREE_HELD_last_force(at)                           SCREE_HELD_ROW(last_force.value, at, SCREE_FIELD_FLOAT, float)
#define SCREE_HELD_rolling(at)                              SCREE_HELD_ROW(rolling.value, at, SCREE_FIELD_DOUBLE, double)
#define SCREE_HELD_rolling_last(at)                         SCREE_HELD_ROW(rolling.last, at, SCREE_FIELD_FLOAT, float)

#define SCREE_HELD_REMEMBERS(law, row, at, components, ...) SCREE_HELD_REMEMBERS_(law, row, at, components, __VA_ARGS__)
#define SCREE_HELD_REMEMBERS_(law_, row_, at, components_, name_, unit_, meaning_, ...)                                \
    {                                                                                                                  \
        .name = "persistent/" name_, SCREE_HELD_##row_(at), .components = components_, .unit = unit_,                  \
        .rows = SCREE_ROWS_GROUP, .group = &scree_persistent_group, .owner = &scree_module_persistent,                 \
        .meaning = meaning_, .law = &scree_module_##law_, __VA_ARGS__                                                  \
    }

/// Name, unit and meaning of what several laws remember.
#define SCREE_REST_FIELD "rest_overlap", "m", "overlap at which the pair is at rest; negative: a gap"
#define SCREE_TENSILE_STRENGTH_FIELD                                                                                   \
    "tensile_strength", "N", "strength of the bond in tension, infinite: it does not break so; negative: it is broken"
#define SCREE_SHEAR_STRENGTH_FIELD "shear_strength", "N", "strength of the bond in shear, without a normal force"
#define SCREE_STRENGTH_SLOPE_FIELD                                                                                     \
    "strength_slope", "1", "strength in shear that the bond gains with a compressive normal force"
#define SCREE_TANGENTIAL_DISPLACEMENT_FIELD "tangential_displacement", "m", "tangential displacement; along t in 2D"
#define SCREE_TANGENTIAL_STIFFNESS_FIELD                                                                               \
    "tangential_stiffness", "N/m", "stiffness of the tangential spring in the last step"
#define SCREE_ROLLED_FIELD "rolling_displacement", "m", "displacement of rolling"
#define SCREE_ROLLING_DAMPING_FIELD                                                                                    \
    "rolling_damping_force", "N", "what the dashpot added to the rolling spring in the last step"
#define SCREE_TWISTED_FIELD "twist", "rad", "angle of twist about the normal"
#define SCREE_TWISTING_DAMPING_FIELD                                                                                   \
    "twisting_damping_torque", "N m", "what the dashpot added to the twisting spring in the last step"
#define SCREE_ROLLING_FORCE_FIELD                                                                                      \
    "rolling_force", "N", "constant torque against rolling over R_eff in the last step, along the rolling"
#define SCREE_TWISTING_TORQUE_FIELD                                                                                    \
    "twisting_torque", "N m", "constant torque against twisting in the last step, along the spin"
#define SCREE_NORMAL_DAMPING_FIELD "normal_damping_force", "N", "damping part of the normal force of the last step"
#define SCREE_TANGENTIAL_DAMPING_FIELD                                                                                 \
    "tangential_damping_force", "N",                                                                                   \
        "what the dashpot added to the tangential spring in the last step, positive along the displacement"

#endif
