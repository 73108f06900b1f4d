/// The schema table of sources: what all of them say. The keys of each kind stand in its own file (src/source/).
#include "case/schema_sources.h"

#include "module/key_rows.h"

typedef scree_config_source source;

const scree_config_source scree_source_before_reading = {.batch = SCREE_SOURCE_ONE, .above = NAN};

static bool is_wide(const scree_module *module)
{
    return module->source->wide;
}

static bool is_flat(const scree_module *module)
{
    return module->shape && module->shape->dimension == 2;
}

static const scree_choice batches[] = {
    {"one", SCREE_SOURCE_ONE, "one particle at a time, at a random position"},
    {"layer", SCREE_SOURCE_LAYER, "a whole layer at once, its particles side by side"},
    {0},
};

#define VECTOR(member, si, most, ...)                                                                                  \
    KEY(source, member, SCREE_KEY_VECTOR, .unit = si, .standard = "[0, 0]", FROM("-" most), TO(most), __VA_ARGS__)
static const scree_key source_keys[] = {
    {.name = "source", .type = SCREE_KEY_CHOICE, .offset = offsetof(source, kind), .meaning = "Kind of the source."},
    KEY(source, name, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),
        .meaning = "Name in results and for --set; auto: the kind, numbered from 1 if there are several."),
    MODULE_KEYS,
    KEY(source, stage, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),
        .meaning = "Name of the only stage that it pours in; auto: all that pour."),
    KEY(source, species, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),
        .meaning = "Name of the only species that it pours; auto: all, by their shares."),
    INTEGER(source, count, .standard = "0", FROM("0"), TO("1e8"),
            .meaning = "Particles that it pours at most; 0: as many as there are."),
    NUMBER(source, interval, "s", ABOVE("0 s"), TO("1e6 s"),
           .meaning = "Time between two particles, or two layers. A source that is blocked waits."),
    CHOICE(source, batch, batches, .standard = "one", .fits = is_wide, .meaning = "What it lets go at once."),
    INTEGER(source, layer, .standard = "0", FROM("0"), TO("1e6"), .fits = is_wide, .when = "batch=one",
            .meaning = "Particles of a layer, after which it is shifted, and follows the pile; 0: as many of the "
                       "mean size as lie side by side in it."),
    VECTOR(velocity, "m/s", "1e4 m/s", .meaning = "Velocity of a particle that is born."),
    VECTOR(spread, "m/s", "1e4 m/s",
           .meaning = "Each component of the velocity differs from this at random, by at most so much."),
    NUMBER(source, turn, "rad", .standard = "180 degrees", FROM("0 degrees"), TO("180 degrees"),
           .chooser = "particles.shape", .fits = is_flat,
           .meaning = "A particle is turned at random by at most this angle, either way."),
    NUMBER(source, above, "m", .standard = "auto", ABOVE("0 m"), TO("1 km"),
           .meaning = "Distance of the lowest point of a particle that is born from the top of the pile when its layer "
                      "began (of a point source: now); auto: the source stays at its height."),
    VECTOR(motion, "m/s", "1000 m/s", .meaning = "Velocity of the source itself, from its first stage on."),
    VECTOR(shift, "m", "1 km", .fits = is_wide, .meaning = "Way by which each layer is shifted against the last one."),
};

const scree_section scree_source_sections[SCREE_SOURCE_SECTIONS] = {
    OPEN_TABLE("sources", "Where particles come from.", source_keys, scree_config_source)};
