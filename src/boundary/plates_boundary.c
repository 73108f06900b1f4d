/// The boundary `plates`: rigid plates on all sides, those beside the sample under servo (axial_plates.c).
#include "boundary/axial_plates.h"
#include "module/key_rows.h"

static const scree_boundary face = {
    .walls = SCREE_AXIAL_WALLS | SCREE_SIDE_WALLS,
    .stands = true,
    .returned = "plates cannot come back to sides that have deformed freely",
    SCREE_AXIAL_PLATES,
};

const scree_module scree_module_plates_boundary = {
    .name = "plates",
    .meaning = "rigid plates on all sides, those beside the sample under servo",
    .choice_of = CHOICE_OF(IS("stages.boundary"),
                           IS("boundary.lateral", .meaning = "rigid side plates that a servo holds at the pressure")),
    .boundary = &face,
};
