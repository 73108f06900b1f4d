/// The boundary `pressure`: plates below and above, the pressure on the Delaunay boundary of the sides (pressure.c).
#include "boundary/axial_plates.h"
#include "module/key_rows.h"

static const scree_boundary face = {
    .walls = SCREE_AXIAL_WALLS,
    .unpressed = true,
    .needs_ends = "the Delaunay boundary goes around a sample that does not repeat itself: give boundary: plates",
    SCREE_AXIAL_PLATES,
};

const scree_module scree_module_pressure_boundary = {
    .name = "pressure",
    .meaning = "plates below and above, pressure on the Delaunay boundary of the sides",
    .choice_of = CHOICE_OF(IS("stages.boundary"),
                           IS("boundary.lateral", .meaning = "traction on the Delaunay boundary of the assembly")),
    .boundary = &face,
    .spreads = true,
};
