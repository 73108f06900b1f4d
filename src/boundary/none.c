/// No boundary: nothing stands around the bodies, which may part. In directions in which the sample repeats itself it
/// goes on; in the others its edges are free.
#include "boundary/boundary.h"
#include "case/config.h"
#include "module/key_rows.h"

static bool forced(const scree_config *config, int64_t index)
{
    int stage = config->stages[index].kind;
    return stage >= 0 && scree_modules[stage]->numbers->collides;
}

static const scree_boundary face = {
    .open = true,
    .round = true,
    .forced = forced,
    .kept = "plates cannot come back among grains that have moved freely",
};

const scree_module scree_module_none = {
    .name = "none",
    .meaning = "nothing stands around the bodies",
    .choice_of = CHOICE_OF(IS("stages.boundary")),
    .boundary = &face,
    .spreads = true,
    .begins_whole = scree_begins_in_parts,
};
