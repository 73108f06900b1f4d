/// Declarations of fields: what is remembered, per body, per contact, per row of an array of a module's own, or once
/// for the run. Allocation, checkpoint, snapshot, checks of range, ParaView files, views and the output reference
/// follow from a declaration; nobody writes them by hand.
///
/// Some fields exist in one dimension only, and vectors have as many components as the dimension.
#ifndef SCREE_MODULE_FIELD_H
#define SCREE_MODULE_FIELD_H

#include <scree/view.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct scree_module scree_module;

typedef enum scree_field_role {
    SCREE_FIELD_STATE,
    SCREE_FIELD_DERIVED ///< can be rebuilt: not stored
} scree_field_role;

/// What a field has one element of.
typedef enum scree_field_rows {
    SCREE_ROWS_ONE,      ///< the run: the value lies in its owner's struct
    SCREE_ROWS_FIXED,    ///< an array of `fixed` elements in its owner's struct
    SCREE_ROWS_GROUP,    ///< an array of its owner's, which as many rows as `group` says
    SCREE_ROWS_BODIES,   ///< bodies: arrays of the state or of a module, which follow the bodies as they come, go and
                         ///< change rows (state/store.h)
    SCREE_ROWS_CONTACTS, ///< contacts: arrays of the state; some are there only where the law needs them
} scree_field_rows;

/// Arrays of a module that have one length: where in its struct their number of rows and their capacity lie (size_t).
/// Rows are the same in all parts of a sample (comm/parts.h), unless they are of pairs of bodies: then they go with
/// these, and in a part `total` of the struct counts those of all processes.
typedef struct scree_group {
    const char *row;    ///< what messages call a row: "node"
    const char *symbol; ///< of their number in docs/output.md: "h"
    size_t count_offset, capacity_offset;
    bool pairs;          ///< one array, each row of which begins with the ids of two bodies, in the order of these
    size_t total_offset; ///< of pairs: where their number in all parts lies (size_t, derived)
} scree_group;

/// Upper ends of a range that are not numbers but follow from the state or the model.
typedef enum scree_field_limit {
    SCREE_LIMIT_ANY,           ///< no range is said: numbers must be finite, integers may be any
    SCREE_LIMIT_NUMBER,        ///< `most`
    SCREE_LIMIT_BODY,          ///< the id of a body that is here
    SCREE_LIMIT_IDS,           ///< as many as there may be ids
    SCREE_LIMIT_LAST_MATERIAL, ///< a whole number
    SCREE_LIMIT_LARGEST_RADIUS,
    SCREE_LIMIT_FARTHEST, ///< far beyond any sample, on both sides of zero
    SCREE_LIMIT_STEP,
    SCREE_LIMIT_EVALUATIONS,
    SCREE_LIMIT_STAGES,
    SCREE_LIMIT_MANY, ///< far more than any run has, and far from the end of the integers
} scree_field_limit;

typedef struct scree_field_range {
    double least;
    scree_field_limit limit;
    double most;    ///< SCREE_LIMIT_NUMBER
    bool open;      ///< `least` itself is outside
    bool undefined; ///< not a number is a value, too
} scree_field_range;

/// What ghosts do with a field of bodies. Ghosts are bodies across a face of a periodic cell, and later those of
/// another process: rows behind the own ones, which messages fill and empty (comm/comm.h).
typedef enum scree_field_ghosts {
    SCREE_GHOSTS_NONE,     ///< they have none of it
    SCREE_GHOSTS_KEEP,     ///< copied to them when they are made: does not change while a neighbour list lives
    SCREE_GHOSTS_FOLLOW,   ///< copied to them in every step
    SCREE_GHOSTS_POSITION, ///< a vector, copied in every step, plus the lattice vectors from the body to the ghost [m]
    SCREE_GHOSTS_VELOCITY, ///< a vector, copied in every step, plus the velocity of these lattice vectors [m/s]
    SCREE_GHOSTS_ADD_BACK  ///< integers that they collect: added to the body modulo 2^64, then zero again. The contact
                           ///< forces end with it; a pass that collects later calls scree_comm_add_back itself
} scree_field_ghosts;

/// Numbers of components that depend on the dimension: d of a vector; 1 in 2D and 3 in 3D of a spin or torque.
enum { SCREE_VECTOR = -1, SCREE_AXIAL_VECTOR = -2 };

typedef struct scree_field {
    const char *name; ///< of a body "radius", of all else with its group: "membrane/rest"
    scree_field_type type;
    int components;   ///< or SCREE_VECTOR, SCREE_AXIAL_VECTOR
    const char *unit; ///< udunits text, "1" for none
    scree_field_role role;
    bool snapshot; ///< written as it is into snapshots and ParaView files
    const char *meaning;
    scree_field_range range;
    const scree_module *owner; ///< whose struct the offsets are of; NULL: scree_state
    scree_field_rows rows;
    size_t array_offset; ///< of the pointer to the array (groups, bodies, contacts), else of the first element itself
    size_t stride;       ///< bytes from one element to the next
    size_t offset;       ///< bytes from the start of an element to the first component
    const scree_group *group;
    size_t fixed;
    int only_dimension;        ///< 2 or 3: exists in this dimension only; 0: in both
    scree_field_ghosts ghosts; ///< of bodies; if not NONE, the array has rows of ghosts behind those of the bodies
    bool optional; ///< of contacts: there where they follow several laws; of bodies: there is no array, and no part of
                   ///< messages, until scree_state_begin_field asks for it, in `begin` of the module; without it every
                   ///< run has the array, used or not; of groups: not in snapshots while it has no rows
    const scree_module *law; ///< of what contacts remember: there where they follow this law; NULL: always
    unsigned options;        ///< and one of these of its options, a bit each; 0: any
    bool in_checksum;        ///< of what contacts remember: enters the state checksum
} scree_field;

/// Ends of ranges, for the rows of declarations.
#define SCREE_RANGE(least_, most_) .range = {.least = least_, .limit = SCREE_LIMIT_NUMBER, .most = most_}
#define SCREE_RANGE_ABOVE(least_, most_)                                                                               \
    .range = {.least = least_, .limit = SCREE_LIMIT_NUMBER, .most = most_, .open = true}
#define SCREE_RANGE_TO(limit_) .range = {.limit = limit_}

/// Rows of a module's declaration: a value of its struct, an element of an array in its struct, an element of a group.
/// `struct_` is the module's struct, `module` its name in the table of modules. What stands behind are designators.
#define SCREE_FIELD_OF(module, rows_, name_, type_, components_, unit_, meaning_)                                      \
    .name = name_, .type = type_, .components = components_, .unit = unit_, .meaning = meaning_,                       \
    .owner = &scree_module_##module, .rows = rows_
#define SCREE_FIELD_ONE(module, struct_, member, name_, type_, components_, unit_, meaning_, ...)                      \
    {                                                                                                                  \
        SCREE_FIELD_OF(module, SCREE_ROWS_ONE, name_, type_, components_, unit_, meaning_),                            \
            .array_offset = offsetof(struct_, member), .stride = sizeof(((struct_ *)0)->member), __VA_ARGS__           \
    }
#define SCREE_FIELD_FIXED(module, struct_, array, count, element, member, name_, type_, components_, unit_, meaning_,  \
                          ...)                                                                                         \
    {                                                                                                                  \
        SCREE_FIELD_OF(module, SCREE_ROWS_FIXED, name_, type_, components_, unit_, meaning_),                          \
            .fixed = count, .array_offset = offsetof(struct_, array), .stride = sizeof(element),                       \
            .offset = offsetof(element, member), __VA_ARGS__                                                           \
    }
#define SCREE_FIELD_GROUP(module, struct_, group_, array, element, name_, type_, components_, unit_, meaning_, ...)    \
    {                                                                                                                  \
        SCREE_FIELD_OF(module, SCREE_ROWS_GROUP, name_, type_, components_, unit_, meaning_),                          \
            .group = &(group_), .array_offset = offsetof(struct_, array), .stride = sizeof(element), __VA_ARGS__       \
    }

/// An element of an array with one element a body, whose pointer lies in the module's struct.
#define SCREE_FIELD_BODY(module, struct_, array, element, name_, type_, components_, unit_, meaning_, ...)             \
    {                                                                                                                  \
        SCREE_FIELD_OF(module, SCREE_ROWS_BODIES, name_, type_, components_, unit_, meaning_),                         \
            .array_offset = offsetof(struct_, array), .stride = sizeof(element), __VA_ARGS__                           \
    }

/// Number of components in a dimension: resolves SCREE_VECTOR and SCREE_AXIAL_VECTOR.
int scree_components(int components, int dimension);

/// Bytes of one component.
size_t scree_field_size(scree_field_type type);

#endif
