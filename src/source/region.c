/// A source in a box with sides along the axes: rain.
#include "module/key_rows.h"
#include "module/source.h"

#include <string.h>

typedef struct config {
    double lower[3], upper[3]; ///< m
} config;

#define PLACE(member, text)                                                                                            \
    KEY(config, member, SCREE_KEY_VECTOR, .unit = "m", FROM("-1e6 m"), TO("1e6 m"), .meaning = text)
static const scree_key keys[] = {
    PLACE(lower, "Corner with the smallest coordinates of the box in which the centres of its particles are born."),
    PLACE(upper, "Corner with the largest coordinates; a side may have no length."),
};

static const char *wrong(const void *own, int dimension, const char **key)
{
    const config *c = own;
    bool wide = false;
    *key = "upper";
    if (dimension == 2 && (c->lower[2] != 0 || c->upper[2] != 0)) return "there is no z in two dimensions";
    for (int k = 0; k < dimension; k++) {
        if (c->upper[k] < c->lower[k]) return "no coordinate of `upper` may be smaller than that of `lower`";
        wide = wide || c->upper[k] > c->lower[k];
    }
    return wide ? NULL : "a region needs a size: give another corner, or a source: point";
}

static void place(const void *own, scree_source_place *place)
{
    const config *c = own;
    *place = (scree_source_place){.edges = 0};
    memcpy(place->origin, c->lower, sizeof place->origin);
    for (int k = 0; k < 3; k++)
        if (c->upper[k] > c->lower[k]) place->edge[place->edges++][k] = c->upper[k] - c->lower[k];
}

const scree_module scree_module_region = {
    .name = "region",
    .meaning = "Particles are born in a box with sides along the axes.",
    .choice_of = CHOICE_OF(IS("sources", .meaning = "a box with sides along the axes: rain")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .spreads = true,
    .source = &(const scree_source_kind){.wide = true, .rains = true, .wrong = wrong, .place = place},
};
