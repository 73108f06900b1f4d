/// The fields of the state itself; those of modules stand in their own files, what contacts remember in those of the
/// laws. Every member of `scree_state` is in the
/// table except the counts (they are the lengths of the arrays) and row_of_id (the inverse of `id`).
#include "state/fields.h"

#include <assert.h>
#include <float.h>
#include <stddef.h>
#include <string.h>

// Offsets of component 0 and strides, for arrays of structures, plain arrays, walls and single values.
#define IN_ARRAY(array, type, member)                                                                                  \
    .array_offset = offsetof(scree_state, array), .stride = sizeof(type), .offset = offsetof(type, member)
#define PLAIN_ARRAY(array, type) .array_offset = offsetof(scree_state, array), .stride = sizeof(type), .offset = 0

#define CONTACT(name_, type_, components_, unit_, member, meaning_, ...)                                               \
    {                                                                                                                  \
        "contacts/" name_, type_, components_, unit_, SCREE_FIELD_STATE, false, meaning_,                              \
            IN_ARRAY(contact, scree_contact_memory, member), .rows = SCREE_ROWS_CONTACTS, __VA_ARGS__                  \
    }
#define ONE(name_, type_, components_, unit_, member, meaning_, ...)                                                   \
    {                                                                                                                  \
        name_, type_, components_, unit_, SCREE_FIELD_STATE, false, meaning_,                                          \
            .array_offset = offsetof(scree_state, member), .stride = sizeof(((scree_state *)0)->member),               \
            .rows = SCREE_ROWS_ONE, __VA_ARGS__                                                                        \
    }

#define SUM 0x1p62 /* sums of a step stay below (base/fixed.h), with room for the next one */

static const scree_field fields[] = {
    {"id", SCREE_FIELD_UINT32, 1, "1", SCREE_FIELD_STATE, true, "number of the body, never changes",
     PLAIN_ARRAY(id, uint32_t), .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_KEEP},
    {"mark", SCREE_FIELD_UINT8, 1, "1", SCREE_FIELD_STATE, true, "0: grain, 1: of a membrane",
     PLAIN_ARRAY(mark, uint8_t), .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_KEEP,
     SCREE_RANGE(0, SCREE_MARKS - 1)},
    {"position", SCREE_FIELD_DOUBLE, SCREE_VECTOR, "m", SCREE_FIELD_STATE, true, "centre", IN_ARRAY(row, scree_row, x),
     .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_POSITION, SCREE_RANGE_TO(SCREE_LIMIT_FARTHEST)},
    {"radius", SCREE_FIELD_DOUBLE, 1, "m", SCREE_FIELD_STATE, true, "radius", IN_ARRAY(row, scree_row, radius),
     .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_KEEP,
     .range = {.limit = SCREE_LIMIT_LARGEST_RADIUS, .open = true}},
    {"mass", SCREE_FIELD_DOUBLE, 1, "kg", SCREE_FIELD_STATE, true, "mass", IN_ARRAY(row, scree_row, mass),
     .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_KEEP, SCREE_RANGE_ABOVE(0, DBL_MAX)},
    {"material", SCREE_FIELD_DOUBLE, 1, "1", SCREE_FIELD_STATE, true,
     "number of the material; 0 is that of the particles, or of the first species", IN_ARRAY(row, scree_row, material),
     .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_KEEP, .only_dimension = 2,
     SCREE_RANGE_TO(SCREE_LIMIT_LAST_MATERIAL)},
    {"material", SCREE_FIELD_DOUBLE, 1, "1", SCREE_FIELD_STATE, true,
     "number of the material; 0 is that of the particles, or of the first species",
     IN_ARRAY(turn, scree_turn_row, material), .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_KEEP,
     .only_dimension = 3, SCREE_RANGE_TO(SCREE_LIMIT_LAST_MATERIAL)},
    {"species", SCREE_FIELD_UINT8, 1, "1", SCREE_FIELD_STATE, true,
     "number of the species among those of the case; 255: a body of a membrane", PLAIN_ARRAY(species, uint8_t),
     .rows = SCREE_ROWS_BODIES, SCREE_RANGE(0, 255)},
    {"held", SCREE_FIELD_UINT8, 1, "1", SCREE_FIELD_STATE, false,
     "bits 0 to 2: velocity x, y, z, bits 3 to 5: spin about x, y, z is prescribed", PLAIN_ARRAY(held, uint8_t),
     .rows = SCREE_ROWS_BODIES, .optional = true, SCREE_RANGE(0, 63)},
    {"angle", SCREE_FIELD_DOUBLE, 1, "rad", SCREE_FIELD_STATE, true,
     "rotation since the start of the loading, counter-clockwise; of bodies that are not round how they lie turned",
     PLAIN_ARRAY(angle, double), .rows = SCREE_ROWS_BODIES, .only_dimension = 2},
    {"scheme_velocity", SCREE_FIELD_DOUBLE, SCREE_VECTOR, "m/s", SCREE_FIELD_STATE, false,
     "velocity that the integrator keeps: of some schemes half a step behind the position",
     IN_ARRAY(row, scree_row, vx), .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_VELOCITY},
    {"scheme_spin", SCREE_FIELD_DOUBLE, 1, "rad/s", SCREE_FIELD_STATE, false,
     "angular velocity that the integrator keeps, counter-clockwise", IN_ARRAY(row, scree_row, spin),
     .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_FOLLOW, .only_dimension = 2},
    {"scheme_spin", SCREE_FIELD_DOUBLE, 3, "rad/s", SCREE_FIELD_STATE, false,
     "angular velocity that the integrator keeps", IN_ARRAY(turn, scree_turn_row, wx), .rows = SCREE_ROWS_BODIES,
     .ghosts = SCREE_GHOSTS_FOLLOW, .only_dimension = 3},
    {"reference", SCREE_FIELD_DOUBLE, SCREE_VECTOR, "m", SCREE_FIELD_STATE, false,
     "centre at the start of the loading stage", PLAIN_ARRAY(reference, scree_vector), .rows = SCREE_ROWS_BODIES,
     SCREE_RANGE_TO(SCREE_LIMIT_FARTHEST)},
    {"reference_angle", SCREE_FIELD_DOUBLE, 1, "rad", SCREE_FIELD_STATE, false,
     "where there are bodies that are not round: how they lay turned at the start of the loading stage",
     PLAIN_ARRAY(reference_angle, double), .rows = SCREE_ROWS_BODIES, .only_dimension = 2, .optional = true},
    {"sampled_velocity", SCREE_FIELD_DOUBLE, SCREE_VECTOR, "m/s", SCREE_FIELD_STATE, false,
     "velocity at the last sample", PLAIN_ARRAY(sampled_velocity, scree_vector), .rows = SCREE_ROWS_BODIES},
    {"force_sum", SCREE_FIELD_INT64, SCREE_VECTOR, "1", SCREE_FIELD_STATE, false,
     "sum of the contact and boundary forces, in units of scalars/force_quantum", IN_ARRAY(sum, scree_sum_row, fx),
     .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_ADD_BACK, SCREE_RANGE(-SUM, SUM)},
    {"torque_sum", SCREE_FIELD_INT64, 1, "1", SCREE_FIELD_STATE, false,
     "sum of the contact torques, in units of scalars/torque_quantum", IN_ARRAY(sum, scree_sum_row, torque),
     .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_ADD_BACK, .only_dimension = 2, SCREE_RANGE(-SUM, SUM)},
    {"torque_sum", SCREE_FIELD_INT64, 3, "1", SCREE_FIELD_STATE, false,
     "sum of the contact torques, in units of scalars/torque_quantum", IN_ARRAY(torque, scree_torque_row, x),
     .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_ADD_BACK, .only_dimension = 3, SCREE_RANGE(-SUM, SUM)},
    {"contact_moment", SCREE_FIELD_INT64, 4, "1", SCREE_FIELD_STATE, false,
     "sum over the contacts of branch (x) force, from the centre to the point, by rows, in units of "
     "scalars/torque_quantum; where bodies deform, of scalars/force_quantum times the radius",
     .array_offset = offsetof(scree_state, moment), .stride = SCREE_MOMENTS_2D * sizeof(int64_t),
     .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_ADD_BACK, .optional = true, .only_dimension = 2,
     SCREE_RANGE(-SUM, SUM)},
    {"contact_moment", SCREE_FIELD_INT64, 9, "1", SCREE_FIELD_STATE, false,
     "sum over the contacts of branch (x) force, from the centre to the point, by rows, in units of "
     "scalars/torque_quantum; where bodies deform, of scalars/force_quantum times the radius",
     .array_offset = offsetof(scree_state, moment), .stride = SCREE_MOMENTS_3D * sizeof(int64_t),
     .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_ADD_BACK, .optional = true, .only_dimension = 3,
     SCREE_RANGE(-SUM, SUM)},
    {"particle_stretch", SCREE_FIELD_DOUBLE, 8, "m", SCREE_FIELD_STATE, false,
     "radius times the strain of the body that the contact forces are made with: xx, yy, xy, the largest way of its "
     "surface; behind them the changes in the last step",
     .array_offset = offsetof(scree_state, stretch), .stride = SCREE_STRETCHES_2D * sizeof(double),
     .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_FOLLOW, .optional = true, .only_dimension = 2,
     SCREE_RANGE_TO(SCREE_LIMIT_FARTHEST)},
    {"particle_stretch", SCREE_FIELD_DOUBLE, 16, "m", SCREE_FIELD_STATE, false,
     "radius times the strain of the body that the contact forces are made with: xx, yy, zz, the largest way of its "
     "surface, yz, xz, xy, 0; behind them the changes in the last step",
     .array_offset = offsetof(scree_state, stretch), .stride = SCREE_STRETCHES_3D * sizeof(double),
     .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_FOLLOW, .optional = true, .only_dimension = 3,
     SCREE_RANGE_TO(SCREE_LIMIT_FARTHEST)},
    {"equivalent_radius", SCREE_FIELD_DOUBLE, 1, "m", SCREE_FIELD_STATE, true,
     "radius of the disc of equal area, where bodies are not round; `radius` bounds them then",
     IN_ARRAY(form, scree_form, radius), .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_KEEP, .optional = true,
     .only_dimension = 2, .range = {.limit = SCREE_LIMIT_LARGEST_RADIUS, .open = true}},
    {"turning_radius", SCREE_FIELD_DOUBLE, 1, "m", SCREE_FIELD_STATE, false,
     "radius of the disc of equal mass and equal moment of inertia, where bodies are not round",
     IN_ARRAY(form, scree_form, turning), .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_KEEP, .optional = true,
     .only_dimension = 2, .range = {.limit = SCREE_LIMIT_LARGEST_RADIUS, .open = true}},
    {"coordination", SCREE_FIELD_INT64, 1, "1", SCREE_FIELD_STATE, true,
     "number of touching neighbours and walls; of one that sleeps, of those that may move",
     IN_ARRAY(sum, scree_sum_row, contacts), .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_ADD_BACK,
     SCREE_RANGE_TO(SCREE_LIMIT_MANY)},
    {"rebuild", SCREE_FIELD_DOUBLE, SCREE_VECTOR, "m", SCREE_FIELD_DERIVED, false,
     "centre at the last rebuild of the neighbour list", PLAIN_ARRAY(rebuild, scree_vector), .rows = SCREE_ROWS_BODIES},
    {"predicted", SCREE_FIELD_DOUBLE, 8, "1", SCREE_FIELD_DERIVED, false,
     "increments of velocity and spin by the forces of the last step", PLAIN_ARRAY(predicted, scree_predicted),
     .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_FOLLOW, .optional = true},
    {"lead", SCREE_FIELD_DOUBLE, 8, "1", SCREE_FIELD_STATE, false,
     "where the scheme predicts: predicted velocity [m/s] and spin [rad/s] less those that it keeps; 2D: x, y, spin; "
     "3D: "
     "x, y, z, 0, spin x, y, z",
     PLAIN_ARRAY(lead, scree_predicted), .rows = SCREE_ROWS_BODIES, .ghosts = SCREE_GHOSTS_FOLLOW, .optional = true},

    CONTACT("first", SCREE_FIELD_UINT32, 1, "1", first, "id of the first body", SCREE_RANGE_TO(SCREE_LIMIT_BODY)),
    CONTACT("second", SCREE_FIELD_UINT32, 1, "1", second,
            "id of the second body, larger than the first; 4294967280 + index for a plate, 2147483648 + primitive for "
            "a wall "
            "of the case"),
    {"contacts/law", SCREE_FIELD_UINT8, 1, "1", SCREE_FIELD_STATE, false,
     "number of its law, where a case has several: 0 that of `contact`, 1 and more those of contact.pairs",
     PLAIN_ARRAY(contact_law, uint8_t), .rows = SCREE_ROWS_CONTACTS, .optional = true,
     SCREE_RANGE(0, SCREE_MOST_PAIR_LAWS)},
    ONE("scalars/next_id", SCREE_FIELD_UINT64, 1, "1", next_id, "id of the next body that comes; none is given again",
        SCREE_RANGE_TO(SCREE_LIMIT_IDS)),
    ONE("scalars/step", SCREE_FIELD_UINT64, 1, "1", step, "time since the start of the run, in ticks",
        SCREE_RANGE_TO(SCREE_LIMIT_MANY)),
    ONE("scalars/evaluations", SCREE_FIELD_UINT64, 1, "1", evaluations,
        "steps taken since the start of the run, one force evaluation each", SCREE_RANGE_TO(SCREE_LIMIT_MANY)),
    ONE("scalars/sampled_step", SCREE_FIELD_UINT64, 1, "1", sampled_step, "step of the last sample",
        SCREE_RANGE_TO(SCREE_LIMIT_STEP)),
    ONE("scalars/tick", SCREE_FIELD_DOUBLE, 1, "s", tick, "unit of step: the smallest time step of the scheme",
        SCREE_RANGE_ABOVE(0, DBL_MAX)),
    ONE("scalars/step_size", SCREE_FIELD_DOUBLE, 1, "s", step_size, "the last time step", SCREE_RANGE(0, DBL_MAX)),
    ONE("scalars/kick_size", SCREE_FIELD_DOUBLE, 1, "s", kick_size, "mean of the last two time steps",
        SCREE_RANGE(0, DBL_MAX)),
    ONE("scalars/force_quantum", SCREE_FIELD_DOUBLE, 1, "N", force_quantum, "unit of force_sum",
        SCREE_RANGE_ABOVE(0, DBL_MAX)),
    ONE("scalars/torque_quantum", SCREE_FIELD_DOUBLE, 1, "N m", torque_quantum, "unit of torque_sum",
        SCREE_RANGE_ABOVE(0, DBL_MAX)),
    ONE("scalars/largest_overlap", SCREE_FIELD_DOUBLE, 1, "m", largest_overlap, "largest overlap of all contacts",
        SCREE_RANGE(0, DBL_MAX)),
    ONE("scalars/largest_speed", SCREE_FIELD_DOUBLE, 1, "m/s", largest_speed,
        "bound of the surface speed of all bodies", SCREE_RANGE(0, DBL_MAX)),
    ONE("scalars/turned_since", SCREE_FIELD_DOUBLE, 1, "s", turned_since,
        "time from which angles of round bodies, and orientations, count", SCREE_RANGE(0, DBL_MAX)),
    ONE("ledger/damping", SCREE_FIELD_DOUBLE, 1, "J", ledger.damping, "energy dissipated by contact damping"),
    ONE("ledger/friction", SCREE_FIELD_DOUBLE, 1, "J", ledger.friction, "energy dissipated by sliding"),
    ONE("ledger/stiffness", SCREE_FIELD_DOUBLE, 1, "J", ledger.stiffness,
        "energy put into tangential springs by the change of their stiffness"),
    ONE("ledger/plates", SCREE_FIELD_DOUBLE, 1, "J", ledger.plates, "work of the walls on the bodies"),
    ONE("ledger/pressure", SCREE_FIELD_DOUBLE, 1, "J", ledger.pressure, "work of the pressure on the bodies"),
    ONE("ledger/periodic", SCREE_FIELD_DOUBLE, 1, "J", ledger.periodic,
        "work of the deforming periodic cell on the bodies"),
    ONE("ledger/boundary", SCREE_FIELD_DOUBLE, 1, "J", ledger.boundary,
        "work of the other forces of the boundary on the bodies"),
    ONE("ledger/forced", SCREE_FIELD_DOUBLE, 1, "J", ledger.forced,
        "work of the torque that keeps a body at its prescribed spin"),
    ONE("ledger/outside", SCREE_FIELD_DOUBLE, 1, "J", ledger.outside,
        "work of own forces of a program that uses the library, and of its changes of bodies"),
    ONE("ledger/gravity", SCREE_FIELD_DOUBLE, 1, "J", ledger.gravity, "work of gravity on the bodies"),
    ONE("ledger/initial", SCREE_FIELD_DOUBLE, 1, "J", ledger.initial, "energy when the ledger was opened"),
    ONE("ledger/scheme", SCREE_FIELD_DOUBLE, 1, "J", ledger.scheme,
        "put into the kinetic energy by the scheme: changes of the step, errors of a corrector"),
    ONE("ledger/turnover", SCREE_FIELD_DOUBLE, 1, "J", ledger.turnover, "sum of the magnitudes of all work increments",
        SCREE_RANGE(0, DBL_MAX)),
    ONE("ledger/removed", SCREE_FIELD_DOUBLE, 1, "J", ledger.removed,
        "energy that left with bodies that were taken out"),
    ONE("stage/index", SCREE_FIELD_INT64, 1, "1", stage.index, "number of the stage in the case",
        SCREE_RANGE_TO(SCREE_LIMIT_STAGES)),
    ONE("stage/first_step", SCREE_FIELD_UINT64, 1, "1", stage.first_step, "step at which the stage began",
        SCREE_RANGE_TO(SCREE_LIMIT_STEP)),
    ONE("stage/first_time", SCREE_FIELD_DOUBLE, 1, "s", stage.first_time, "time at which the stage began",
        SCREE_RANGE(0, DBL_MAX)),
    ONE("stage/first_evaluations", SCREE_FIELD_UINT64, 1, "1", stage.first_evaluations,
        "scalars/evaluations when the stage began", SCREE_RANGE_TO(SCREE_LIMIT_EVALUATIONS)),
    ONE("stage/samples", SCREE_FIELD_INT64, 1, "1", stage.samples, "rows of series.csv written in this run",
        SCREE_RANGE_TO(SCREE_LIMIT_MANY)),
    ONE("stage/snapshots", SCREE_FIELD_INT64, 1, "1", stage.snapshots, "snapshots written in this run",
        SCREE_RANGE_TO(SCREE_LIMIT_MANY)),
    ONE("stage/counter", SCREE_FIELD_INT64, 1, "1", stage.counter, "counter of the stage",
        .range = {.least = -2, .limit = SCREE_LIMIT_MANY}),
};
enum { OWN_FIELDS = sizeof fields / sizeof *fields };

const scree_field *scree_own_fields(size_t *count)
{
    *count = OWN_FIELDS;
    return fields;
}

size_t scree_field_total(void)
{
    size_t total = OWN_FIELDS;
    for (int m = 0; m < SCREE_MODULE_COUNT; m++) total += scree_modules[m]->field_count;
    return total;
}

const scree_field *scree_field_at(size_t index)
{
    if (index < OWN_FIELDS) return &fields[index];
    index -= OWN_FIELDS;
    int m = 0;
    while (index >= scree_modules[m]->field_count) index -= scree_modules[m++]->field_count;
    return &scree_modules[m]->fields[index];
}

bool scree_field_exists(const scree_field *field, int dimension)
{
    return field->only_dimension == 0 || field->only_dimension == dimension;
}

/// The law with this number of those that contacts follow.
static const scree_remembered_law *law_of_contacts(const scree_state *state, int number)
{
    return number > 0 ? &state->pair_law[number - 1] : &state->law[SCREE_LIST_CONTACTS];
}

static bool is_declared_by(const scree_field *field, const scree_remembered_law *law)
{
    return field->law == law->law && (field->options == 0 || field->options >> law->option & 1);
}

/// What a law declares under a name for contacts; NULL: nothing.
static const scree_field *find_remembered(const scree_state *state, const scree_remembered_law *law, const char *name)
{
    for (size_t k = 0; law->law && k < law->law->field_count; k++) {
        const scree_field *field = &law->law->fields[k];
        if (field->rows == SCREE_ROWS_CONTACTS && scree_field_exists(field, state->dimension) &&
            is_declared_by(field, law) && strcmp(field->name, name) == 0)
            return field;
    }
    return NULL;
}

bool scree_field_is_shared(const scree_state *state, const scree_field *field)
{
    return field->law && field->rows == SCREE_ROWS_CONTACTS && state->pair_laws > 0;
}

/// Of several laws the first one that declares it.
static const scree_field *first_of_name(const scree_state *state, const char *name)
{
    const scree_field *found = NULL;
    for (int k = 0; k <= state->pair_laws && !found; k++)
        found = find_remembered(state, law_of_contacts(state, k), name);
    return found;
}

bool scree_field_is_here(const scree_state *state, const scree_field *field)
{
    if (!scree_field_exists(field, state->dimension)) return false;
    if (scree_field_is_shared(state, field)) return first_of_name(state, field->name) == field;
    if (!field->law) return field->rows != SCREE_ROWS_CONTACTS || !field->optional || state->pair_laws > 0;
    return is_declared_by(field, &state->law[scree_field_list(field)]);
}

const scree_field *scree_field_of_contact(const scree_state *state, const scree_field *field, size_t row)
{
    const int law = state->contact_law[row];
    return law <= state->pair_laws ? find_remembered(state, law_of_contacts(state, law), field->name) : NULL;
}

const scree_field *scree_field_of_law(const scree_state *state, const scree_field *field, int number)
{
    return number <= state->pair_laws ? find_remembered(state, law_of_contacts(state, number), field->name) : NULL;
}

scree_field_type scree_field_stored_type(const scree_state *state, const scree_field *field)
{
    if (!scree_field_is_shared(state, field)) return field->type;
    for (int k = 0; k <= state->pair_laws; k++) {
        const scree_field *other = scree_field_of_law(state, field, k);
        if (other && other->type != field->type) return SCREE_FIELD_DOUBLE;
    }
    return field->type;
}

bool scree_field_is_stored(const scree_state *state, const scree_field *field)
{
    return field->role == SCREE_FIELD_STATE && scree_field_is_here(state, field);
}

/// The struct that the offsets of a field are of.
static unsigned char *owner_of(const scree_state *state, const scree_field *field)
{
    if (!field->owner) return (unsigned char *)(uintptr_t)state;
    int slot = 0;
    while (scree_modules[slot] != field->owner) slot++;
    return state->own[slot];
}

/// The array that a field of bodies or contacts lies in; NULL: there is none.
static const void *array_of(const scree_state *state, const scree_field *field)
{
    const void *array;
    memcpy(&array, owner_of(state, field) + field->array_offset, sizeof array);
    return array;
}

bool scree_field_is_made(const scree_state *state, const scree_field *field)
{
    return array_of(state, field) != NULL;
}

size_t scree_field_rows_count(const scree_state *state, const scree_field *field)
{
    size_t count = 1;
    if (field->law && !scree_field_is_here(state, field)) return 0;
    switch (field->rows) {
    case SCREE_ROWS_ONE:
        break;
    case SCREE_ROWS_FIXED:
        return field->fixed;
    case SCREE_ROWS_GROUP:
        memcpy(&count, owner_of(state, field) + field->group->count_offset, sizeof count);
        break;
    case SCREE_ROWS_BODIES:
        return field->optional && !array_of(state, field) ? 0 : state->count;
    case SCREE_ROWS_CONTACTS:
        return scree_field_is_shared(state, field) || array_of(state, field) ? state->contact_count : 0;
    }
    return count;
}

void *scree_field_array(const scree_state *state, const scree_field *field)
{
    return owner_of(state, field) + field->array_offset;
}

const void *scree_field_get(const scree_state *state, const scree_field *field, size_t row)
{
    const unsigned char *first = scree_field_array(state, field);
    if (scree_field_is_array(field)) memcpy(&first, first, sizeof(void *));
    return first + row * field->stride + field->offset;
}

void *scree_field_get_mutable(scree_state *state, const scree_field *field, size_t row)
{
    return (void *)(uintptr_t)scree_field_get(state, field, row);
}

size_t scree_remembered_values(const scree_state *state, scree_list list, size_t row,
                               double value[SCREE_CHECKSUM_VALUES])
{
    const bool several = list == SCREE_LIST_CONTACTS && state->pair_laws > 0;
    const scree_remembered_law *of = several ? law_of_contacts(state, state->contact_law[row]) : &state->law[list];
    const scree_module *law = of->law;
    size_t count = 0;
    for (size_t k = 0; law && k < law->field_count; k++) {
        const scree_field *field = &law->fields[k];
        if (!field->in_checksum || scree_field_list(field) != list || !scree_field_exists(field, state->dimension) ||
            !is_declared_by(field, of))
            continue;
        size_t components = (size_t)scree_components(field->components, state->dimension);
        assert(field->type == SCREE_FIELD_DOUBLE && count + components <= SCREE_CHECKSUM_VALUES);
        memcpy(value + count, scree_field_get(state, field, row), components * sizeof *value);
        count += components;
    }
    return count;
}
