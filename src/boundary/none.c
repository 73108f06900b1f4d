/// No boundary: nothing stands around bodies that meet and part.
#include "boundary/boundary.h"
#include "case/config.h"

static bool forced(const scree_config *config, int64_t index)
{
    int stage = config->stages[index].kind;
    return stage >= 0 && scree_modules[stage]->numbers->collides;
}

static const scree_boundary face = {.open = true, .forced = forced};

const scree_module scree_module_none = {
    .name = "none",
    .meaning = "nothing stands around the bodies",
    .boundary = &face,
};
