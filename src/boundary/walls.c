/// The boundary `walls`: no plates, only the walls of the case (state/case_walls.h).
#include "boundary/boundary.h"
#include "case/config.h"
#include "module/key_rows.h"

static bool standard(const scree_config *config)
{
    return config->wall_count > 0;
}

static const scree_boundary face = {
    .open = true,
    .stands = true,
    .round = true,
    .standard = standard,
    .needs_walls = "this case has no walls",
    .kept = "plates cannot come back among grains that have moved freely",
};

const scree_module scree_module_walls = {
    .name = "walls",
    .meaning = "no plates: only the `walls` of the case",
    .choice_of = CHOICE_OF(IS("stages.boundary")),
    .boundary = &face,
    .spreads = true,
    .begins_whole = scree_begins_in_parts,
};
