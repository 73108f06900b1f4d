/// The module of waves: keys, recording. Results: wave_results.c.
///
/// A receiver is the body whose centre is nearest to its place when the recording begins. Layers divide the sample
/// along the axis of the wave: between the outermost centres in steps of 1 / (layers - 1), or a periodic cell in steps
/// of 1 / layers beginning with the lowest centre, so that each layer has its centres around its middle; its
/// displacement is the mean of its bodies'. Displacements count from the begin of the recording; in a periodic cell the
/// shortest way.
///
/// Records are state, so a restarted run has the same. Cost: a look at a number a step, and with layers some 10 ns a
/// body and record.
#include "run/waves.h"

#include "base/integer_sum.h"
#include "base/matrix.h"
#include "case/check.h"
#include "comm/comm.h"
#include "comm/parts.h"
#include "module/key_rows.h"
#include "state/body.h"
#include "state/fields.h"
#include "state/periodic.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// ---- keys --------------------------------------------------------------------------------------------------------

typedef scree_wave_numbers numbers;

typedef scree_receiver_place listed;

typedef struct config {
    listed *receivers;
    int64_t receiver_count;
    char *from; ///< auto: the last stage
    int64_t every, layers;
    int axis;
} config;

static const scree_key receiver_keys[] = {
    KEY(listed, name, SCREE_KEY_WORD, FROM("1"), TO("31"), .meaning = "Name in the tables."),
    KEY(listed, place, SCREE_KEY_VECTOR, .unit = "m", FROM("-1e6 m"), TO("1e6 m"),
        .meaning = "The particle whose centre is nearest to this position is listened to."),
};
static const scree_section receiver_table[] = {TABLE("receivers", "A place to listen at.", receiver_keys)};
static const scree_choice axes[] = {
    {"x", 0, "the first axis"}, {"y", 1, "the second axis"}, {"z", 2, "the third axis, in 3D"}, {0}};

#define NAMED(label, member, kind, ...)                                                                                \
    {                                                                                                                  \
        .name = label, .type = kind, .offset = offsetof(config, member), __VA_ARGS__                                   \
    }
static const scree_key keys[] = {
    NAMED("receivers", receivers, SCREE_KEY_LIST, .standard = "[]", FROM("0"), TO("64"), .sections = receiver_table,
          .section_count = 1, .count_offset = offsetof(config, receiver_count), .element_size = sizeof(listed),
          .meaning =
              "Places where waves are recorded; two by two they make a pair, between which a speed is measured."),
    NAMED("wave_layers", layers, SCREE_KEY_INTEGER, .standard = "0", FROM("0"), TO("4096"),
          .meaning = "Layers of the sample whose mean displacements are recorded, for a dispersion relation; 0: none."),
    NAMED("wave_axis", axis, SCREE_KEY_CHOICE, .choices = axes, .standard = "x",
          .meaning = "Direction in which waves go: of distances between receivers, and across layers."),
    NAMED("wave_from", from, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),
          .meaning = "Name of the stage with which the recording begins; auto: the last one."),
    NAMED("wave_every", every, SCREE_KEY_INTEGER, .standard = "10", FROM("1"), TO("1e9"),
          .meaning = "Steps between two records."),
};

/// NULL: of a config made by hand.
static const config *own_config(const scree_config *whole)
{
    return scree_config_own(&scree_module_waves, "measure", whole->measure.own);
}

static bool records(const config *own)
{
    return own && own->receiver_count + own->layers > 0;
}

static int64_t stage_of(const scree_config_stage *stages, int64_t count, const config *own)
{
    for (int64_t i = 0; own->from && i < count; i++)
        if (stages[i].name && strcmp(stages[i].name, own->from) == 0) return i;
    return own->from ? -1 : count - 1;
}

static void check_stage(scree_reader *reader, const scree_config *whole, const config *own)
{
    enum { MOST = 100 };
    const char *names[MOST];
    size_t count = 0;
    const int64_t stage = stage_of(whole->stages, whole->stage_count, own);
    for (int64_t i = 0; i < whole->stage_count && i < MOST; i++)
        if (whole->stages[i].name) names[count++] = whole->stages[i].name;
    if (stage < 0)
        scree_rule_refuse_name(reader, "measure.wave_from", "stage", own->from, names, count);
    else if (whole->stages[stage].kind >= 0 && scree_modules[whole->stages[stage].kind]->numbers->instant)
        scree_rule_refuse(reader, "measure.wave_from", NULL, "stage '%s' takes no steps: nothing moves in it",
                          own->from ? own->from : whole->stages[stage].name);
}

static void rules(scree_reader *reader, const scree_config *whole)
{
    const config *own = own_config(whole);
    char path[SCREE_PATH_BYTES];
    if (!records(own)) return;
    check_stage(reader, whole, own);
    if (own->axis == 2 && whole->dimension == 2)
        scree_rule_refuse(reader, "measure.wave_axis", "x, y", "there is no z in two dimensions");
    if (own->layers > 0 && own->layers < 4)
        scree_rule_refuse(reader, "measure.wave_layers", "0, or 4 and more", "waves need at least 4 layers");
    for (int64_t i = 0; i < own->receiver_count; i++)
        for (int64_t k = 0; k < i; k++) {
            if (!own->receivers[i].name || !own->receivers[k].name) continue;
            if (strcmp(own->receivers[i].name, own->receivers[k].name) != 0) continue;
            (void)snprintf(path, sizeof path, "measure.receivers.%lld.name", (long long)i);
            scree_rule_refuse(reader, path, NULL, "receivers.%lld has the name '%s' too", (long long)k,
                              own->receivers[i].name);
        }
}

static scree_status resolve(scree_model *model, scree_error *error)
{
    const config *own = scree_config_own(&scree_module_waves, "measure", model->config->measure.own);
    const scree_config_stage *first = model->stages;
    (void)error;
    if (!records(own)) return SCREE_OK;
    const scree_preparation *method = scree_modules[scree_config_prepared(first)->method]->preparation;
    *(numbers *)scree_model_reserve_numbers(model, SCREE_SLOT_waves) =
        (numbers){.lattice = method->lattice,
                  .turned = method->turned,
                  .stage = stage_of(model->stages, model->stage_count, own),
                  .every = own->every,
                  .receiver_count = own->receiver_count,
                  .receiver = own->receivers,
                  .layers = own->layers,
                  .axis = own->axis};
    return SCREE_OK;
}

// ---- state -------------------------------------------------------------------------------------------------------

typedef scree_waves memory;
#define GROUP(title, letter, member)                                                                                   \
    {                                                                                                                  \
        .row = title, .symbol = letter, .count_offset = offsetof(memory, member##_count),                              \
        .capacity_offset = offsetof(memory, member##_capacity)                                                         \
    }
static const scree_group receivers = GROUP("receiver", "q", receiver), times = GROUP("record", "v", record),
                         values = GROUP("displacement", "u", value);

static const scree_field fields[] = {
    SCREE_FIELD_GROUP(waves, memory, receivers, receiver, scree_receiver, "waves/receiver", SCREE_FIELD_UINT32, 1, "1",
                      "id of the body that is listened to", .offset = offsetof(scree_receiver, id),
                      SCREE_RANGE_TO(SCREE_LIMIT_IDS)),
    SCREE_FIELD_GROUP(waves, memory, receivers, receiver, scree_receiver, "waves/place", SCREE_FIELD_DOUBLE, 3, "m",
                      "its position when the recording began", .offset = offsetof(scree_receiver, place)),
    SCREE_FIELD_GROUP(waves, memory, times, time, double, "waves/time", SCREE_FIELD_DOUBLE, 1, "s",
                      "time of the record"),
    SCREE_FIELD_GROUP(waves, memory, values, value, double[3], "waves/displacement", SCREE_FIELD_DOUBLE, 3, "m",
                      "of the receivers, then of the layers, record by record"),
    SCREE_FIELD_BODY(waves, memory, reference, scree_vector, "waves/reference", SCREE_FIELD_DOUBLE, 3, "m",
                     "position when the recording of layers began", .optional = true),
    SCREE_FIELD_ONE(waves, memory, first, "waves/first", SCREE_FIELD_DOUBLE, 1, "m", "position of the first layer"),
    SCREE_FIELD_ONE(waves, memory, spacing, "waves/spacing", SCREE_FIELD_DOUBLE, 1, "m", "distance of the layers"),
    SCREE_FIELD_ONE(waves, memory, begun, "waves/begun", SCREE_FIELD_UINT64, 1, "1",
                    "evaluations of forces before the recording", SCREE_RANGE_TO(SCREE_LIMIT_EVALUATIONS)),
};
static const scree_field *const reference_field = &fields[4];

static scree_status check(const scree_state *state, const scree_model *model, scree_error *error)
{
    const numbers *own = scree_wave_numbers_of(model);
    const memory *m = scree_waves_of(state);
    const size_t channels = own ? scree_wave_channels(own) : 0;
    if (m->value_count == channels * m->record_count) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_IO, "dataset 'waves/displacement': %zu rows, not %zu of %zu records",
                           m->value_count, channels, m->record_count);
}

static const char *keeps(const scree_state *state, uint32_t id)
{
    const memory *m = scree_waves_of(state);
    for (size_t k = 0; k < m->receiver_count; k++)
        if (m->receiver[k].id == id) return "it is a receiver of waves";
    return NULL;
}

// ---- begin -------------------------------------------------------------------------------------------------------

/// The shortest way, where the sample repeats itself.
static void shorten(const scree_state *state, double way[3])
{
    const scree_periodic_cell *cell = scree_cell(state);
    double inverse[9], fraction[3];
    if (!cell->directions) return;
    scree_matrix_invert(cell->lattice, inverse);
    scree_matrix_apply(inverse, way, fraction);
    for (int k = 0; k < 3; k++)
        if (scree_periodic_repeats(cell, k)) fraction[k] -= rint(fraction[k]);
    scree_matrix_apply(cell->lattice, fraction, way);
}

static scree_status refuse(scree_error *error, int64_t index, const char *name, const char *why)
{
    const scree_status status = scree_error_set(error, SCREE_ERROR_INPUT, "receiver '%s' %s", name, why);
    return scree_error_key(error, status, "measure.receivers.%lld.place", (long long)index);
}

static scree_status find_receiver(const scree_context *c, const numbers *own, int64_t index, scree_error *error)
{
    const scree_state *state = c->state;
    memory *m = scree_waves_of(state);
    scree_receiver *found = &m->receiver[index];
    char why[200];
    double least = INFINITY;
    for (size_t row = 0; row < state->count; row++) {
        double place[3], way[3];
        scree_body_position(state, row, place);
        for (int k = 0; k < 3; k++) way[k] = k < state->dimension ? place[k] - own->receiver[index].place[k] : 0;
        shorten(state, way);
        const double distance = scree_length(way);
        if (distance > least || (distance == least && state->id[row] > found->id)) continue;
        least = distance;
        found->id = state->id[row];
        memcpy(found->place, place, sizeof found->place);
    }
    // Between particles of a packing no place is farther from all centres than this.
    const double most = 2 * scree_model_largest_radius(c->model);
    (void)snprintf(why, sizeof why, "is outside of the sample: the nearest particle is %g m away, at (%g, %g, %g) m",
                   least, found->place[0], found->place[1], found->place[2]);
    if (least > most) return refuse(error, index, own->receiver[index].name, why);
    for (int64_t k = 0; k < index; k++)
        if (m->receiver[k].id == found->id) {
            (void)snprintf(why, sizeof why, "is nearest to the same particle as '%s': put them farther apart",
                           own->receiver[k].name);
            return refuse(error, index, own->receiver[index].name, why);
        }
    m->receiver_count = (size_t)index + 1;
    return SCREE_OK;
}

/// Number of the layer of a body.
static size_t layer_of(const memory *m, const numbers *own, const double *place)
{
    const double number = rint((place[own->axis] - m->first) / m->spacing);
    return (size_t)fmod(fmax(number, 0), (double)own->layers);
}

static scree_status find_layers(const scree_context *c, const numbers *own, scree_error *error)
{
    const scree_state *state = c->state;
    const scree_periodic_cell *cell = scree_cell(state);
    memory *m = scree_waves_of(state);
    double low = INFINITY, high = -INFINITY;
    unsigned char *filled;
    scree_status status = scree_state_begin_field(c->state, reference_field, error);
    if (!status) status = scree_allocate(&filled, (size_t)own->layers, 1, error);
    if (status) return status;
    for (size_t row = 0; row < state->count; row++) {
        scree_body_position(state, row, m->reference[row]);
        low = fmin(low, m->reference[row][own->axis]);
        high = fmax(high, m->reference[row][own->axis]);
    }
    const bool repeats = scree_periodic_repeats(cell, own->axis);
    m->first = low;
    m->spacing =
        repeats ? cell->lattice[4 * own->axis] / (double)own->layers : (high - low) / (double)(own->layers - 1);
    for (size_t row = 0; row < state->count; row++) filled[layer_of(m, own, m->reference[row])] = 1;
    for (int64_t k = 0; k < own->layers && !status; k++)
        if (!filled[k])
            status = scree_error_refuse(error, "measure.wave_layers", NULL,
                                        "layer %lld of %lld, around %g m, has no particle: take fewer", (long long)k,
                                        (long long)own->layers, m->first + (double)k * m->spacing);
    scree_release(&filled);
    return status;
}

// ---- recording ---------------------------------------------------------------------------------------------------

/// Displacement since the begin of the recording.
static void displacement(const scree_state *state, size_t row, double way[3])
{
    const memory *m = scree_waves_of(state);
    scree_body_position(state, row, way);
    for (int k = 0; k < 3; k++) way[k] -= m->reference[row][k];
    shorten(state, way);
}

/// Mean displacements of the layers, from sums that do not depend on the order of the bodies, nor on who has them.
static scree_status record_layers(const scree_state *state, const numbers *own, double (*to)[3], scree_error *error)
{
    const memory *m = scree_waves_of(state);
    const size_t layers = (size_t)own->layers;
    int64_t *count = NULL;
    scree_integer_sum(*sum)[3] = NULL;
    double way[3];
    scree_status status = scree_allocate(&count, layers, sizeof *count, error);
    if (!status) status = scree_allocate(&sum, layers, sizeof *sum, error);
    for (size_t row = 0; row < state->count && !status; row++) count[layer_of(m, own, m->reference[row])]++;
    while (!status && scree_comm_sum_next(state, sum[0], 3 * (int)layers))
        for (size_t row = 0; row < state->count; row++) {
            displacement(state, row, way);
            const size_t layer = layer_of(m, own, m->reference[row]);
            for (int k = 0; k < 3; k++) scree_integer_sum_add(&sum[layer][k], way[k]);
        }
    if (!status) scree_comm_add(state, count, layers);
    for (size_t layer = 0; layer < layers && !status; layer++)
        for (int k = 0; k < 3; k++) to[layer][k] = scree_integer_sum_total(&sum[layer][k]) / (double)count[layer];
    scree_release(&count);
    scree_release(&sum);
    return status;
}

/// Displacements of the bodies that are listened to, which the processes tell each other.
static void record_receivers(const scree_state *state, const numbers *own, double (*to)[3])
{
    const memory *m = scree_waves_of(state);
    const size_t count = (size_t)own->receiver_count;
    uint32_t id[SCREE_RECEIVERS];
    for (size_t k = 0; k < count; k++) {
        const uint32_t row = scree_state_row_of(state, id[k] = m->receiver[k].id);
        memset(to[k], 0, sizeof to[k]);
        if (row == SCREE_NO_ROW) continue;
        scree_body_position(state, row, to[k]);
        for (int i = 0; i < 3; i++) to[k][i] -= m->receiver[k].place[i];
        shorten(state, to[k]);
    }
    if (count > 0) scree_parts_tell(state, id, count, to[0], 3);
}

static scree_status record(const scree_context *c, scree_error *error)
{
    scree_state *state = c->state;
    const numbers *own = scree_wave_numbers_of(c->model);
    memory *m = scree_waves_of(state);
    const size_t channels = scree_wave_channels(own);
    scree_status status = scree_group_reserve(state, &scree_module_waves, &times, m->record_count + 1, error);
    if (!status) status = scree_group_reserve(state, &scree_module_waves, &values, m->value_count + channels, error);
    if (status) return status;
    double(*to)[3] = m->value + m->value_count;
    record_receivers(state, own, to);
    if (own->layers > 0) status = record_layers(state, own, to + own->receiver_count, error);
    if (status) return status;
    m->time[m->record_count++] = scree_state_time(state);
    m->value_count += channels;
    return SCREE_OK;
}

/// A receiver is the nearest of all bodies, and layers are between the outermost ones.
static bool begins_whole(const scree_context *c)
{
    const numbers *own = scree_wave_numbers_of(c->model);
    return own && c->state->stage.index == own->stage;
}

static scree_status begin(const scree_context *c, scree_error *error)
{
    const numbers *own = scree_wave_numbers_of(c->model);
    memory *m = scree_waves_of(c->state);
    if (!begins_whole(c)) return SCREE_OK;
    m->record_count = m->value_count = m->receiver_count = 0;
    m->begun = c->state->evaluations;
    scree_status status =
        scree_group_reserve(c->state, &scree_module_waves, &receivers, (size_t)own->receiver_count, error);
    for (int64_t k = 0; k < own->receiver_count && !status; k++) status = find_receiver(c, own, k, error);
    if (!status && own->layers > 0) status = find_layers(c, own, error);
    return status ? status : record(c, error);
}

static scree_status listen(const scree_context *c, scree_error *error)
{
    const numbers *own = scree_wave_numbers_of(c->model);
    const uint64_t done = c->state->evaluations - scree_waves_of(c->state)->begun;
    return done % (uint64_t)own->every == 0 ? record(c, error) : SCREE_OK;
}

static bool in_use(const scree_context *c)
{
    return scree_wave_numbers_of(c->model) && scree_waves_of(c->state)->record_count > 0;
}

static const scree_pass passes[] = {{SCREE_PHASE_GUARD, .run = listen}};

static bool told(const scree_config *whole, size_t index, char name[SCREE_RESULT_NAME])
{
    name[0] = 0;
    return index == 0 && records(own_config(whole));
}

const scree_module scree_module_waves = {
    .name = "waves",
    .meaning = "receivers of waves and layers of the sample: speeds, dispersion relation",
    .keys = (const scree_keys[]){KEYS_OF("measure", keys, config)},
    .keys_count = 1,
    .rules = rules,
    .numbers_size = sizeof(numbers),
    .resolve = resolve,
    .state_size = sizeof(memory),
    .fields = fields,
    .field_count = COUNT(fields),
    .check = check,
    .keeps = keeps,
    .begin = begin,
    .begins_whole = begins_whole,
    .passes = passes,
    .pass_count = COUNT(passes),
    .in_use = in_use,
    .spreads = true,
    .results = {.row = scree_wave_rows, .count = SCREE_WAVE_ROWS},
    .told = told,
    .conclude = scree_waves_conclude,
};
