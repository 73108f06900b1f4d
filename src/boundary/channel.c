/// The boundary `channel`: a cell that repeats itself in all directions but the last, with plates below and above.
#include "boundary/axial_plates.h"
#include "case/config.h"

static bool forced(const scree_config *config, int64_t index)
{
    (void)index;
    return config->boundary.periodic > 0 && !scree_config_is_wholly_periodic(config);
}

static const scree_boundary face = {
    .walls = SCREE_AXIAL_WALLS,
    .periodic = true,
    .forced = forced,
    SCREE_AXIAL_PLATES,
};

const scree_module scree_module_channel = {
    .name = "channel",
    .meaning = "periodic but for the last direction, with plates below and above",
    .boundary = &face,
};
