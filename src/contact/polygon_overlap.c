/// Module of law polygon_overlap (polygon_overlap.h).
#include "contact/polygon_overlap.h"

#include "contact/polygon_module.h"

static scree_pair_constants constants(const scree_contact_space *space, const scree_config_material *a,
                                      const scree_config_material *b)
{
    return scree_polygon_constants(&scree_module_polygon_overlap, space, a, b);
}

static const scree_key keys[] = {POLYGON_KEYS("polygon_overlap")};

static const scree_field fields[] = {POLYGON_FIELDS(polygon_overlap)};

static const scree_law law = {POLYGON_LAW(polygon_overlap_traits), .constants = constants};

static const scree_result rows[] = {
    {"law_work", "J", "energy that the normal force of law polygon_overlap, which has no potential, has taken up"},
    {"law_work_share", "1", "the same over all that contacts have taken up: dashpots, friction and this"},
};

const scree_module scree_module_polygon_overlap = {
    .name = "polygon_overlap",
    .meaning = "area that two polygons share over a length between their centres (Roul 2009); has no potential",
    .choice_of = CHOICE_OF(IS("contact.law"), IS("contact.pairs.law")),
    .keys = (const scree_keys[]){KEYS_OF("materials", keys, scree_polygon_material)},
    .keys_count = 1,
    .law = &law,
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .spreads = true,
    .results = {.row = rows, .count = sizeof rows / sizeof *rows, .measure = scree_polygon_told},
};
