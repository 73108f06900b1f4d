/// Births and sources as a module: what is stored of them, and what each source tells. What they do is in pour.c.
#include "base/checksum.h"
#include "base/vectors.h"
#include "source/pour.h"
#include "source/source.h"

#include <float.h>
#include <stdio.h>

static bool in_use(const scree_context *c)
{
    return scree_pour_config_of(c->model, c->state) != NULL;
}

static uint64_t checksum(const scree_model *model, const scree_state *state, uint64_t c)
{
    const scree_births *all = scree_births_of(state);
    for (int64_t k = 0; k < model->source_count; k++) {
        const scree_source_state *own = &all->source[k];
        const uint64_t words[] = {own->born, own->due, own->attempts, own->layer, own->in_layer};
        for (size_t w = 0; w < sizeof words / sizeof *words; w++) c = scree_checksum_word(c, words[w]);
    }
    return c;
}

typedef scree_births births;
#define ONE(member, meaning, ...)                                                                                      \
    SCREE_FIELD_ONE(births, births, member, "births/" #member, SCREE_FIELD_UINT64, 1, "1", meaning, __VA_ARGS__)
#define SOURCE(member, type, unit, meaning, ...)                                                                       \
    SCREE_FIELD_FIXED(births, births, source, SCREE_SOURCES, scree_source_state, member, "sources/" #member, type, 1,  \
                      unit, meaning, __VA_ARGS__)
#define NUMBER(member, meaning, ...) SOURCE(member, SCREE_FIELD_UINT64, "1", meaning, __VA_ARGS__)
#define LENGTH(member, meaning)                                                                                        \
    SOURCE(member, SCREE_FIELD_DOUBLE, "m", meaning,                                                                   \
           .range = {.least = -DBL_MAX, .limit = SCREE_LIMIT_NUMBER, .most = DBL_MAX, .undefined = true})
static const scree_field fields[] = {
    SCREE_FIELD_BODY(births, births, time, double, "birth", SCREE_FIELD_DOUBLE, 1, "s",
                     "when the particle was born; 0 of those that were there at the begin", .optional = true,
                     .snapshot = true, SCREE_RANGE(0, DBL_MAX)),
    ONE(in_stage, "particles born in the present stage", SCREE_RANGE_TO(SCREE_LIMIT_IDS)),
    ONE(end,
        "0: sources pour; else why they have stopped in this stage: 1 its count, 2 no particles left, 3 height, 4 "
        "width of the pile, 5 the plateau of a source is used up",
        SCREE_RANGE(0, SCREE_POUR_ENDS - 1)),
    ONE(ended, "step at which they stopped", SCREE_RANGE_TO(SCREE_LIMIT_STEP)),
    ONE(lost, "particles taken out because they had fallen past everything that stands",
        SCREE_RANGE_TO(SCREE_LIMIT_IDS)),
    NUMBER(begun, "1: the source has poured", SCREE_RANGE(0, 1)),
    SOURCE(start, SCREE_FIELD_DOUBLE, "s", "when it began", SCREE_RANGE(0, DBL_MAX)),
    NUMBER(due, "step from which on its next birth may be", SCREE_RANGE_TO(SCREE_LIMIT_MANY)),
    NUMBER(born, "particles that it has poured", SCREE_RANGE_TO(SCREE_LIMIT_IDS)),
    NUMBER(attempts, "attempts of the birth that waits; 0: none does", SCREE_RANGE_TO(SCREE_LIMIT_MANY)),
    NUMBER(since, "step since which it has waited", SCREE_RANGE_TO(SCREE_LIMIT_STEP)),
    NUMBER(waits, "births that had to wait", SCREE_RANGE_TO(SCREE_LIMIT_MANY)),
    NUMBER(waited, "ticks that they waited together", SCREE_RANGE_TO(SCREE_LIMIT_STEP)),
    NUMBER(layer, "its present layer, from 0", SCREE_RANGE_TO(SCREE_LIMIT_MANY)),
    NUMBER(in_layer, "particles of this layer that are born", SCREE_RANGE_TO(SCREE_LIMIT_MANY)),
    LENGTH(top, "top of the pile when the layer began"),
    LENGTH(left, "left end of the source, where it follows the plateau"),
    LENGTH(right, "right end of it"),
};

static const scree_pass passes[] = {{SCREE_PHASE_DECIDE, .run = scree_pour, .whole = scree_pour_wants_all}};

// ---- what each source tells --------------------------------------------------------------------------------------

static bool told(const scree_config *config, size_t index, char name[SCREE_RESULT_NAME])
{
    if (index >= (size_t)config->source_count || !config->sources[index].name) return false;
    (void)snprintf(name, SCREE_RESULT_NAME, "%s", config->sources[index].name);
    return true;
}

static const scree_result results[] = {
    {"_born", "1", "particles that the source of this name has poured"},
    {"_layers", "1", "layers that it has filled"},
    {"_width", "m", "how long the line is, or the first edge of the region, in its present layer; 0 of a point"},
    {"_waits", "1", "births that had to wait because something was in the way"},
    {"_waited", "s", "time that they waited together"},
};

static scree_status tell(const scree_context *c, size_t index, double *value, scree_error *error)
{
    const scree_source_state *own = &scree_births_of(c->state)->source[index];
    scree_source_place place;
    (void)error;
    scree_source_place_now(c->model, &c->model->sources[index], own, scree_state_time(c->state), 0, &place);
    value[0] = (double)own->born;
    value[1] = (double)own->layer;
    value[2] = place.edges > 0 ? scree_length(place.edge[0]) : 0;
    value[3] = (double)own->waits;
    value[4] = (double)own->waited * c->state->tick;
    return SCREE_OK;
}

const scree_module scree_module_births = {
    .name = "births",
    .meaning = "the sources of the case, and when bodies were born",
    .state_size = sizeof(births),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .checksum = checksum,
    .passes = passes,
    .pass_count = sizeof passes / sizeof *passes,
    .in_use = in_use,
    .spreads = true,
    .columns = SCREE_RESULTS_IN_PARTS(results, tell),
    .results = SCREE_RESULTS(results, tell),
    .told = told,
};
