/// The boundary `plates`: rigid plates on all sides, those beside the sample under servo (axial_plates.c). In
/// directions in which the sample repeats itself there are none.
///
/// Along a path (`deform`, without shear) both plates of a pair have half of the rate times their distance, so rates
/// are logarithmic; under a stress both are under servo, but the bottom plate, which stands.
#include "boundary/axial_plates.h"
#include "boundary/plates.h"
#include "case/config.h"
#include "measure/measure.h"
#include "module/key_rows.h"

#include <math.h>

/// What a periodic sample has in its other directions.
static bool standard(const scree_config *config)
{
    return config->boundary.periodic > 0 && config->wall_count == 0;
}

/// The two plates across an axis, the one that a servo leaves at rest first.
static void pair(int dimension, int axis, int plate[2])
{
    const int first = axis == dimension - 1 ? SCREE_WALL_BOTTOM : axis == 0 ? SCREE_WALL_LEFT : SCREE_WALL_FRONT;
    plate[0] = first;
    plate[1] = first + 1;
}

static void deform(const scree_context *c, const scree_demand *demand, double rise)
{
    scree_plate_set *plates = scree_plate_set_of(c->state);
    for (int axis = 0; axis < c->state->dimension; axis++) {
        const bool last = axis == c->state->dimension - 1;
        int plate[2];
        pair(c->state->dimension, axis, plate);
        scree_wall *one = &plates->wall[plate[0]], *other = &plates->wall[plate[1]];
        const double pressure = -demand->stress[4 * axis], distance = -(one->position + other->position);
        if (isnan(pressure)) {
            one->velocity = other->velocity = -0.5 * demand->rate[4 * axis] * rise * distance;
            continue;
        }
        if (last) one->velocity = 0;
        for (int k = last; k < 2; k++)
            scree_plate_servo(c->model, c->state, plate[k], last ? plates->axial : plates->sides, pressure);
    }
}

static void stress(const scree_context *c, double tensor[9])
{
    scree_stress_from_plates(c->model, c->state, tensor);
}

static const scree_boundary face = {
    .walls = SCREE_AXIAL_WALLS | SCREE_SIDE_WALLS,
    .stands = true,
    .standard = standard,
    .needs_axis =
        "the sample has no plates below and above where it repeats itself along its last direction: leave that "
        "out of boundary.periodic, or make the sample periodic in all directions",
    .returned = "plates cannot come back to sides that have deformed freely",
    SCREE_AXIAL_PLATES,
    .deform = deform,
    .stress = stress,
};

const scree_module scree_module_plates_boundary = {
    .name = "plates",
    .meaning = "rigid plates on all sides where the sample ends, those beside it under servo",
    .choice_of = CHOICE_OF(IS("stages.boundary"),
                           IS("boundary.lateral", .meaning = "rigid side plates that a servo holds at the pressure")),
    .boundary = &face,
    .spreads = true,
};
