/// Rules of polygons and laws, told as the case is read, beside whatever else is wrong with it.
#include "shape/polygon_rules.h"

#include "model/law.h"
#include "module/shape.h"

#include <math.h>

/// The law of the case with this number; NULL: it was wrong, and noted.
static const scree_module *law_of(const scree_config *config, int number)
{
    const int slot = scree_config_law(&config->contact, number);
    return slot >= 0 && scree_modules[slot]->law ? scree_modules[slot] : NULL;
}

static bool sticks(const scree_module *law)
{
    return law->law->traits[0].pulls || law->law->traits[0].necks;
}

static bool is_of_areas(const scree_module *law)
{
    return law->law && law->law->traits[0].areas;
}

static bool is_of_springs(const scree_module *law)
{
    return law->law && !law->law->traits[0].areas && !sticks(law);
}

/// Laws for outlines of this rounding.
static const char *laws_for(scree_reader *reader, bool rounded)
{
    const char *laws = scree_rule_choices(reader, "contact.law", ", ", rounded ? is_of_springs : is_of_areas);
    return laws ? laws : "another";
}

/// Whether some law sticks, which is noted.
static bool refuse_sticking(scree_reader *reader, const scree_config *config, bool rounded)
{
    bool some = false;
    for (int k = 0; k <= (int)config->contact.pair_count; k++) {
        const scree_module *law = law_of(config, k);
        char path[SCREE_PATH_BYTES] = "contact.law";
        if (!law || !sticks(law)) continue;
        if (k > 0) scree_element_path(path, "contact.pairs", k - 1, "law");
        scree_rule_refuse(reader, path, NULL, "law %s sticks: %s polygons need one that only pushes: %s", law->name,
                          rounded ? "rounded" : "sharp", laws_for(reader, rounded));
        some = true;
    }
    return some;
}

void scree_polygon_rules(scree_reader *reader, const scree_config *config)
{
    const scree_module *law = law_of(config, 0);
    for (int64_t s = 0; s < scree_config_species_count(&config->particles); s++) {
        const int slot = scree_config_shape(&config->particles, s);
        const scree_shape *shape = slot >= 0 ? scree_modules[slot]->shape : NULL;
        if (!shape || !shape->rounding || shape->dimension != config->dimension) continue;
        const double rounding = shape->rounding(scree_config_shape_keys(&config->particles, s));
        const bool rounded = rounding > 0;
        if (isnan(rounding)) continue; // noted
        if (refuse_sticking(reader, config, rounded) || !law) return;
        if (is_of_areas(law) == !rounded) continue;
        if (rounded)
            scree_rule_refuse(reader, "particles.rounding", NULL,
                              "law %s takes the area that two outlines share, and knows sharp corners alone: leave "
                              "rounding out, or take contact.law %s",
                              law->name, laws_for(reader, true));
        else
            scree_rule_refuse(reader, "contact.law", NULL,
                              "law %s has no meaning for polygons with sharp corners: give particles.rounding (0.1, "
                              "say), or take one of the laws of areas: %s",
                              law->name, laws_for(reader, false));
        return;
    }
}
