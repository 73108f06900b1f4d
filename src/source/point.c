/// A source at a point.
#include "module/key_rows.h"
#include "module/source.h"

#include <string.h>

typedef struct config {
    double place[3]; ///< m
} config;

static const scree_key keys[] = {
    KEY(config, place, SCREE_KEY_VECTOR, .unit = "m", FROM("-1e6 m"), TO("1e6 m"),
        .meaning = "Where the centres of its particles are born."),
};

static const char *wrong(const void *own, int dimension, const char **key)
{
    const config *c = own;
    *key = "place";
    return dimension == 2 && c->place[2] != 0 ? "there is no z in two dimensions" : NULL;
}

static void place(const void *own, scree_source_place *place)
{
    const config *c = own;
    *place = (scree_source_place){.edges = 0};
    memcpy(place->origin, c->place, sizeof place->origin);
}

const scree_module scree_module_point = {
    .name = "point",
    .meaning = "All particles are born at one position.",
    .choice_of = CHOICE_OF(IS("sources", .meaning = "one place")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .spreads = true,
    .source = &(const scree_source_kind){.wrong = wrong, .place = place},
};
