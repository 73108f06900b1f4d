/// Stage `collide`: two bodies, prepared as a `pair` or as `bodies`, meet and part; nothing else acts on them. Speeds
/// are those along the line through their centres.
///
/// Stop rule, at a sample: the force between them has fallen to zero again; or `duration` has passed. P fig. 2.1: the
/// restitution is the relative speed after over that before, the relaxation time lasts from the first touch (the gap
/// over the speed: before it nothing acts) until the force is gone, which is found to half a step. Automatic duration:
/// the approach and twice the relaxation time of the law's theory; ten times that of an elastic impact where the law
/// has none.
#include "run/stage_collide.h"

#include "module/key_rows.h"
#include "run/conclusion.h"

#include "base/vectors.h"

#include <math.h>

typedef struct config {
    double duration; ///< s, after which it ends in any case; auto
} config;
static const scree_key keys[] = {
    NUMBER(config, duration, "s", .standard = "auto", ABOVE("0 s"), TO("1e9 s"),
           .meaning = "The stage ends when the two have parted, or after this; auto: twice as long as it should take."),
};

/// State of the module; times are those since the begin of the stage.
typedef struct collision {
    double speed;      ///< m/s, of approach at the first touch
    double touch;      ///< s, of the first touch
    double last_force; ///< s, last time with a force; 0: none yet
    double duration;   ///< s, of the stage
} collision;

static collision *own_state(const scree_simulation *s)
{
    return s->state.own[SCREE_SLOT_collide];
}

/// From the first centre to the second, and the velocity of the first relative to the second.
static void relative_motion(const scree_state *state, double way[3], double velocity[3])
{
    scree_vector place[2], moving[2], spin;
    for (int k = 0; k < 2; k++) {
        scree_body_position(state, state->row_of_id[k], place[k]);
        scree_body_motion(state, state->row_of_id[k], moving[k], spin);
    }
    for (int c = 0; c < 3; c++) way[c] = place[1][c] - place[0][c];
    for (int c = 0; c < 3; c++) velocity[c] = moving[0][c] - moving[1][c];
}

/// Speed at which the bodies approach along the line through their centres, negative when they part.
static double approach(const scree_state *state)
{
    double way[3], velocity[3];
    relative_motion(state, way, velocity);
    return scree_dot(velocity, way) / scree_length(way);
}

/// Speed of approach at the first touch, and the time until then: nothing acts before.
static scree_status predict_touch(const scree_state *state, double *speed, double *time, scree_error *error)
{
    double way[3], velocity[3], aside = 0;
    double one = state->row[state->row_of_id[0]].radius, other = state->row[state->row_of_id[1]].radius;
    relative_motion(state, way, velocity);
    double fast = scree_length(velocity), reach = one + other;
    for (int c = 0; c < 3; c++) velocity[c] /= fast;
    double along = scree_dot(way, velocity);
    for (int c = 0; c < 3; c++) {
        double part = way[c] - along * velocity[c];
        aside += part * part;
    }
    if (!(along > 0)) return scree_error_set(error, SCREE_ERROR_INPUT, "the two particles do not approach each other");
    if (!(aside < reach * reach))
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "the two particles pass each other: their centres keep %.4g m apart, and their radii "
                               "add up to %.4g m",
                               sqrt(aside), reach);
    double depth = sqrt(reach * reach - aside);
    *time = (along - one - other + (reach - depth)) / fast;
    *speed = fast * (depth / reach);
    return SCREE_OK;
}

static bool is_pushed(const scree_state *state)
{
    const scree_sum_row *sum = &state->sum[state->row_of_id[0]];
    return sum->fx != 0 || sum->fy != 0 || (state->dimension == 3 && sum->fz != 0);
}

/// Their law.
static const scree_law_use *law_of(const scree_simulation *s)
{
    const scree_state *state = &s->state;
    return scree_model_law_between(&s->model, scree_body_material(state, state->row_of_id[0]),
                                   scree_body_material(state, state->row_of_id[1]));
}

/// The impact as the law's theory has it.
static scree_status theory_of(const scree_simulation *s, double speed, scree_impact *impact, scree_error *error)
{
    const scree_state *state = &s->state;
    const scree_row *first = &state->row[state->row_of_id[0]], *second = &state->row[state->row_of_id[1]];
    int material = scree_body_material(state, state->row_of_id[0]);
    const scree_pair_constants *pair = &s->model.pairs[material][scree_body_material(state, state->row_of_id[1])];
    double mass = first->mass * second->mass / (first->mass + second->mass);
    double radius = first->radius * second->radius / (first->radius + second->radius);
    return scree_law_get(law_of(s)->law)->impact(law_of(s), pair, radius, mass, speed, impact, error);
}

/// The automatic duration in those of the closed form.
static double patience(const scree_simulation *s)
{
    return scree_law_get(law_of(s)->law)->impact_duration ? 2 : 10;
}

static scree_status begin(scree_simulation *s, scree_error *error)
{
    collision *own = own_state(s);
    scree_impact impact;
    own->last_force = 0;
    scree_status status = predict_touch(&s->state, &own->speed, &own->touch, error);
    if (!status) status = theory_of(s, own->speed, &impact, error);
    if (status) return status;
    double after = patience(s) * impact.duration;
    double given = ((const config *)scree_stage_config(s)->own)->duration;
    own->duration = isnan(given) ? own->touch + after : given;
    return status;
}

static void plan(scree_simulation *s)
{
    uint64_t largest = s->model.largest_step;
    uint64_t expected = scree_stage_ticks(s, own_state(s)->duration);
    uint64_t interval = expected / largest / (uint64_t)s->model.measure.samples * largest;
    s->plan = (scree_stage_plan){.interval = interval > 0 ? interval : largest, .expected = expected};
}

/// Forces are those at the present step.
static void control(scree_simulation *s)
{
    const scree_state *state = &s->state;
    if (is_pushed(state)) own_state(s)->last_force = scree_stage_elapsed(s);
}

static bool has_parted(const scree_state *state)
{
    return ((const collision *)state->own[SCREE_SLOT_collide])->last_force > 0 && !is_pushed(state);
}

static scree_status finished(scree_simulation *s, bool *done, scree_error *error)
{
    (void)error;
    double speed = approach(&s->state);
    bool parted = has_parted(&s->state);
    *done = parted || s->state.step - s->state.stage.first_step >= s->plan.expected;
    (void)snprintf(s->reason, sizeof s->reason, parted ? "parted at %.6g of the speed" : "still together (%.6g)",
                   -speed / own_state(s)->speed);
    return SCREE_OK;
}

static double fraction(const scree_simulation *s)
{
    return (double)(s->state.step - s->state.stage.first_step) / (double)s->plan.expected;
}

static scree_status conclude(const scree_conclusion *run, scree_error *error)
{
    const scree_simulation *s = run->s;
    scree_summary *summary = run->summary;
    const scree_model *model = &s->model;
    const collision *own = own_state(s);
    if (s->state.stage.index < model->stage_count || !has_parted(&s->state) ||
        model->stages[model->stage_count - 1].kind != SCREE_SLOT_collide)
        return SCREE_OK;
    double half = 0.5 * (double)s->model.largest_step * s->state.tick;
    scree_impact impact;
    scree_status status = theory_of(s, own->speed, &impact, error);
    if (status) return status;
    scree_summary_set_number(summary, "restitution", -approach(&s->state) / own->speed);
    scree_summary_set_number(summary, "restitution_theory", impact.restitution);
    scree_summary_set_number(summary, "relaxation_time", own->last_force + half - own->touch);
    if (scree_law_get(law_of(s)->law)->impact_duration)
        scree_summary_set_number(summary, "relaxation_time_theory", impact.duration);
    return SCREE_OK;
}

double scree_collide_expected(const scree_simulation *s)
{
    const collision *own = own_state(s);
    return own->touch + (own->duration - own->touch) / patience(s);
}

static double planned(const scree_model *model, const void *own, double wave)
{
    (void)model;
    (void)wave;
    return ((const config *)own)->duration;
}

static const scree_stage stage_face = {.name = "collide",
                                       .begin = begin,
                                       .plan = plan,
                                       .control = control,
                                       .finished = finished,
                                       .fraction = fraction,
                                       .planned = planned,
                                       .expected = scree_collide_expected};

static const scree_stage_numbers numbers = {
    .collides = true, .needs_approach = "collide needs two particles that approach: prepare method pair or bodies"};

#define ONE(member, unit, meaning)                                                                                     \
    SCREE_FIELD_ONE(collide, collision, member, "collide/" #member, SCREE_FIELD_DOUBLE, 1, unit, meaning)
static const scree_field fields[] = {
    ONE(speed, "m/s", "speed of approach at the first touch"),
    ONE(touch, "s", "time from the begin of the stage to the first touch"),
    ONE(last_force, "s", "last time with a force; 0: none yet"),
    ONE(duration, "s", "after which the stage ends in any case"),
};

static const scree_result results[] = {
    {"restitution", "1", "coefficient of restitution"},
    {"restitution_theory", "1", "closed form of it"},
    {"relaxation_time", "s", "duration of the contact"},
    {"relaxation_time_theory", "s", "closed form of it"},
};

const scree_module scree_module_collide = {
    .name = "collide",
    .meaning = "Two particles, prepared as a `pair` or as `bodies`, meet and part; nothing else acts on them.",
    .choice_of = CHOICE_OF(IS("stages", .meaning = "lets two particles meet and part")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .numbers = &numbers,
    .stage = &stage_face,
    .state_size = sizeof(collision),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .results = SCREE_RESULTS(results, NULL),
    .conclude = conclude,
};
