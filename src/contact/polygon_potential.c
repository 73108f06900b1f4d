/// Module of law polygon_potential (polygon_potential.h).
#include "contact/polygon_potential.h"

#include "contact/polygon_module.h"

static scree_pair_constants constants(const scree_contact_space *space, const scree_config_material *a,
                                      const scree_config_material *b)
{
    return scree_polygon_constants(&scree_module_polygon_potential, space, a, b);
}

static const scree_key keys[] = {POLYGON_KEYS("polygon_potential")};

static const scree_field fields[] = {POLYGON_FIELDS(polygon_potential)};

static const scree_law law = {POLYGON_LAW(polygon_potential_traits), .constants = constants};

const scree_module scree_module_polygon_potential = {
    .name = "polygon_potential",
    .meaning = "gradient of an energy of the area that two polygons share",
    .choice_of = CHOICE_OF(IS("contact.law"), IS("contact.pairs.law")),
    .keys = (const scree_keys[]){KEYS_OF("materials", keys, scree_polygon_material)},
    .keys_count = 1,
    .law = &law,
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .spreads = true,
};
