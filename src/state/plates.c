/// The plates as a module: what is stored of them, and how they move.
#include "state/plates.h"

#include "base/checksum.h"

#include <float.h>

typedef scree_plate_set own;

#define PLATE(member, name, type, components, unit, meaning, ...)                                                      \
    SCREE_FIELD_FIXED(plates, own, wall, SCREE_WALL_COUNT, scree_wall, member, "walls/" name, type, components, unit,  \
                      meaning, .snapshot = true, __VA_ARGS__)
#define SERVO(member, name, unit, meaning)                                                                             \
    SCREE_FIELD_ONE(plates, own, member, "servo/" name, SCREE_FIELD_DOUBLE, 1, unit, meaning, SCREE_RANGE(0, DBL_MAX))
static const scree_field fields[] = {
    PLATE(position, "position", SCREE_FIELD_DOUBLE, 1, "m", "position along the normal: normal . x = position",
          SCREE_RANGE_TO(SCREE_LIMIT_FARTHEST)),
    PLATE(normal, "normal", SCREE_FIELD_DOUBLE, 3, "1", "unit normal, towards the bodies", SCREE_RANGE(-1, 1)),
    PLATE(velocity, "velocity", SCREE_FIELD_DOUBLE, 1, "m/s", "velocity along the normal"),
    PLATE(tangential_velocity, "tangential_velocity", SCREE_FIELD_DOUBLE, 3, "m/s", "velocity in its own plane"),
    PLATE(force, "force", SCREE_FIELD_DOUBLE, 1, "N", "normal force of the bodies on the wall, compression positive"),
    PLATE(shear, "shear", SCREE_FIELD_DOUBLE, 3, "N", "tangential force of the bodies on the wall"),
    PLATE(active, "active", SCREE_FIELD_INT32, 1, "1", "1: the wall exists in this stage", SCREE_RANGE(0, 1)),
    PLATE(material, "material", SCREE_FIELD_INT32, 1, "1", "number of the material; 0 is that of the particles",
          SCREE_RANGE_TO(SCREE_LIMIT_LAST_MATERIAL)),
    SERVO(axial.impedance, "axial_impedance", "N s/m", "dashpot of the bottom and top plate under servo"),
    SERVO(axial.mass, "axial_mass", "kg", "mass of the bottom and top plate under servo"),
    SERVO(sides.impedance, "sides_impedance", "N s/m", "dashpot of the side plates under servo"),
    SERVO(sides.mass, "sides_mass", "kg", "mass of the side plates under servo"),
};

/// Normals are exact, or rounded once.
static scree_status check(const scree_state *state, const scree_model *model, scree_error *error)
{
    (void)model;
    for (int w = 0; w < SCREE_WALL_COUNT; w++) {
        const double *n = scree_plates(state)[w].normal, length = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        if (scree_plates(state)[w].active && fabs(length - 1) > 1e-12)
            return scree_error_set(error, SCREE_ERROR_IO, "dataset 'walls/normal', wall %d: length %.9g (accepted: 1)",
                                   w, sqrt(length));
    }
    return SCREE_OK;
}

/// The plates that stand now.
static uint64_t checksum(const scree_model *model, const scree_state *state, uint64_t c)
{
    (void)model;
    for (uint64_t w = 0; w < SCREE_WALL_COUNT; w++) {
        const scree_wall *wall = &scree_plates(state)[w];
        if (!wall->active) continue;
        c = scree_checksum_word(c, w);
        c = scree_checksum_number(c, wall->position);
        c = scree_checksum_number(c, wall->velocity);
        c = scree_checksum_numbers(c, wall->tangential_velocity, 3);
    }
    return c;
}

void scree_plates_move(scree_state *state)
{
    for (int w = 0; w < SCREE_WALL_COUNT; w++) {
        scree_wall *wall = &scree_plates(state)[w];
        if (wall->active) wall->position += wall->velocity * state->step_size;
    }
}

static scree_status follow(const scree_context *c, scree_error *error)
{
    (void)error;
    scree_plates_move(c->state);
    return SCREE_OK;
}

static const scree_pass passes[] = {{SCREE_PHASE_FOLLOW, .run = follow}};

const scree_module scree_module_plates = {
    .name = "plates",
    .meaning = "rigid planes around the sample, which stand or move along their normals",
    .state_size = sizeof(own),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .check = check,
    .checksum = checksum,
    .passes = passes,
    .pass_count = 1,
    .spreads = true,
};
