/// The boundary `plates`: rigid plates on all sides, those beside the sample under servo (axial_plates.c). In
/// directions in which the sample repeats itself there are none.
#include "boundary/axial_plates.h"
#include "case/config.h"
#include "module/key_rows.h"

/// What a periodic sample has in its other directions.
static bool standard(const scree_config *config)
{
    return config->boundary.periodic > 0 && config->wall_count == 0;
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
};

const scree_module scree_module_plates_boundary = {
    .name = "plates",
    .meaning = "rigid plates on all sides where the sample ends, those beside it under servo",
    .choice_of = CHOICE_OF(IS("stages.boundary"),
                           IS("boundary.lateral", .meaning = "rigid side plates that a servo holds at the pressure")),
    .boundary = &face,
};
