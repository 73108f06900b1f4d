/// Stage `pour`: the sources of the case let grains go (source/births.c), until there are as many as wanted or the pile
/// is as high or wide; then it ends at once, or when the pile has come to rest: the unbalanced force ratio has been
/// below `unbalanced_limit` for CALM samples.
///
/// Nothing but walls of the case, or bodies whose motion is prescribed, may stand around the sample: a Delaunay
/// boundary, a membrane or a periodic cell has no place for grains that come.
#include "case/check.h"
#include "module/key_rows.h"
#include "module/stage.h"
#include "run/loading.h"
#include "run/sample.h"
#include "run/step.h"
#include "shape/wall_set.h"
#include "source/pour.h"
#include "source/room.h"
#include "state/case_walls.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CALM = 5 };

typedef scree_pour_config config;

static const scree_choice pasts[] = {
    {"stop", SCREE_PAST_STOP, "the run stops"},
    {"take_out", SCREE_PAST_TAKE_OUT, "it is taken out of the run, and counted"},
    {0},
};
static const scree_key keys[] = {
    INTEGER(config, count, .standard = "0", FROM("0"), TO("1e8"),
            .meaning = "Particles that the stage pours; 0: all that the case has left (particles.count)."),
    NUMBER(config, height, "m", .standard = "auto", ABOVE("0 m"), TO("100 km"),
           .meaning = "Height of the pile at which the sources stop; auto: at none."),
    NUMBER(config, width, "m", .standard = "auto", ABOVE("0 m"), TO("100 km"),
           .meaning = "Width of its foot at which they stop; auto: at none."),
    NUMBER(config, unbalanced_limit, "1", .standard = "auto", FROM("1e-9"), BELOW("1"),
           .meaning = "When the sources have stopped the stage goes on until the unbalanced force ratio stays below "
                      "this; auto: it ends at once."),
    NUMBER(config, rest_time, "s", .standard = "5 s", ABOVE("0 s"), TO("1e9 s"),
           .meaning = "Time after which it ends in any case, from when the sources have stopped."),
    NUMBER(config, patience, "s", .standard = "auto", ABOVE("0 s"), TO("1e9 s"),
           .meaning = "Time for which a source may be blocked before the run stops; auto: 100 of its intervals, or 50 "
                      "times what a particle needs to fall by its diameter."),
    CHOICE(config, past, pasts, .standard = "stop",
           .meaning = "What happens when a particle has fallen past everything that stands."),
    NUMBER(config, sleep_window, "s", .standard = "auto", ABOVE("0 s"), TO("1e9 s"),
           .meaning = "Time for which a particle must be quiet before it is left out of the steps until it is pushed, "
                      "a step at least; auto: all are in all steps. When the sources have stopped all are awake."),
    NUMBER(config, sleep_force, "1", .standard = "0.01", ABOVE("0"), TO("1"),
           .meaning = "Resultant force over weight below which it is quiet; only with `sleep_window`."),
    NUMBER(config, sleep_motion, "1", .standard = "1e-4", ABOVE("0"), TO("1"),
           .meaning = "Way in that time, at the present speed, over its radius, below which it is quiet; only with "
                      "`sleep_window`."),
    NUMBER(config, wake_force, "1", .standard = "0.1", ABOVE("0"), TO("1e6"),
           .meaning =
               "Mean resultant force of the last `sleep_window`, over weight, above which it wakes; only with that."),
    NUMBER(config, wake_interval, "s", .standard = "1 s", ABOVE("0 s"), TO("1e9 s"),
           .meaning =
               "Time after which all wake, for four of `sleep_window`, so that what they bear in vain reaches the "
               "ground; only with that."),
};

static const config *own_config(const scree_simulation *s)
{
    return scree_stage_config(s)->own;
}

// ---- rules -------------------------------------------------------------------------------------------------------

static const char *wrong(const scree_config *whole, int64_t index, const char **key)
{
    static _Thread_local char text[200];
    const int slot = scree_config_boundary_of(whole, index);
    *key = "stage";
    if (whole->source_count == 0) return "there is nothing that it could pour from: give `sources`";
    *key = "boundary";
    if (whole->boundary.periodic > 0 || slot < 0 || scree_modules[slot]->boundary->open) return NULL;
    (void)snprintf(text, sizeof text,
                   "`sources` and boundary: %s do not go together: sources pour beside walls of the case only; give "
                   "`walls` and boundary: walls",
                   scree_modules[slot]->name);
    return text;
}

/// Limits of sleep where nothing sleeps. A value that they have anyway is let pass: runs write all keys into their
/// case.
static void check_sleep_keys(scree_reader *reader, int64_t index, const config *own)
{
    char path[SCREE_PATH_BYTES], window[SCREE_PATH_BYTES];
    scree_element_path(window, "stages", index, "sleep_window");
    for (size_t k = 0; k < sizeof keys / sizeof *keys; k++) {
        const size_t at = keys[k].offset;
        if (at != offsetof(config, sleep_force) && at != offsetof(config, sleep_motion) &&
            at != offsetof(config, wake_force) && at != offsetof(config, wake_interval))
            continue;
        double value;
        memcpy(&value, (const char *)own + at, sizeof value);
        scree_element_path(path, "stages", index, keys[k].name);
        if (!(fabs(value - strtod(keys[k].standard, NULL)) > 0) || scree_rule_overrules(reader, window, path)) continue;
        scree_rule_refuse(reader, path, NULL, "not used without `sleep_window`: give that, or leave this out");
    }
}

static void rules(scree_reader *reader, const scree_config *whole)
{
    char path[SCREE_PATH_BYTES];
    for (int64_t i = 0; i < whole->stage_count; i++)
        if (whole->stages[i].kind == SCREE_SLOT_pour &&
            !scree_rule_is_said(reader, scree_element_path(path, "stages", i, "sleep_window")))
            check_sleep_keys(reader, i, whole->stages[i].own);
}

/// A body is quiet for a window when it has been for as many steps: for less than one that is nothing. All wake for
/// SCREE_SLEEP_HOLD of them, and none falls asleep before it has been quiet for another.
static scree_status resolve(scree_model *model, scree_error *error)
{
    const double step = model->step * (double)model->largest_step;
    for (int64_t i = 0; i < model->stage_count; i++) {
        const config *own = model->stages[i].own;
        char path[SCREE_PATH_BYTES];
        if (model->stages[i].kind != SCREE_SLOT_pour) continue;
        if (own->sleep_window < step)
            return scree_error_refuse(
                error, scree_element_path(path, "stages", i, "sleep_window"), NULL,
                "%.3g s is less than a step of this case, %.3g s: a particle has to be quiet for many "
                "(built-in cases: 5 ms)",
                own->sleep_window, step);
        const double least = (SCREE_SLEEP_HOLD + 1) * own->sleep_window;
        if (own->wake_interval <= least)
            return scree_error_refuse(error, scree_element_path(path, "stages", i, "wake_interval"), NULL,
                                      "none would ever sleep: within %.3g s all wake for %d of `sleep_window`, %.3g s, "
                                      "and have to be quiet for another: give more than %.3g s",
                                      own->wake_interval, SCREE_SLEEP_HOLD, own->sleep_window, least);
    }
    return SCREE_OK;
}

// ---- while it runs -----------------------------------------------------------------------------------------------

static scree_status check_sources(const scree_simulation *s, scree_error *error)
{
    scree_status status = SCREE_OK;
    for (int64_t k = 0; k < s->model.source_count && !status; k++)
        if (scree_source_pours_in(&s->model, k, s->state.stage.index) && isnan(s->model.sources[k].above))
            status = scree_source_check_room(&s->model, s->work.wall_set, k, error);
    if (status == SCREE_ERROR_INPUT && error) scree_case_locate(s->c, error);
    return status;
}

static scree_status begin(scree_simulation *s, scree_error *error)
{
    scree_state *state = &s->state;
    scree_births *births = scree_births_of(state);
    const scree_context context = scree_step_context(s);
    *scree_loading_of(state) = (scree_loading){.height = 0};
    if (s->boundary->rest) s->boundary->rest(&context);
    for (size_t row = 0; row < state->count; row++) scree_body_refer(state, row);
    scree_case_walls(state)->moving = 1;
    births->in_stage = births->ended = 0;
    births->end = SCREE_POUR_GOES_ON;
    scree_status status = check_sources(s, error);
    return status ? status : scree_births_make_room(state, error);
}

/// Time [s] of the stage, if no source waits.
static double planned(const scree_model *model, const void *own, double wave)
{
    const config *stage = own;
    int64_t index = 0;
    (void)wave;
    while (index < model->stage_count && model->stages[index].own != own) index++;
    double time =
        index < model->stage_count ? scree_pour_time(model, index, (double)scree_pour_wanted(model, stage, 0)) : NAN;
    return time + (isnan(stage->unbalanced_limit) ? 0 : fmin(stage->rest_time, 1));
}

static void plan(scree_simulation *s)
{
    const config *stage = own_config(s);
    double time = planned(&s->model, stage, NAN);
    uint64_t expected = scree_stage_ticks(s, time > 0 ? time : stage->rest_time), largest = s->model.largest_step;
    uint64_t interval = expected / largest / (uint64_t)s->model.measure.samples * largest;
    s->plan = (scree_stage_plan){.interval = interval > 0 ? interval : largest, .expected = expected};
}

/// Says when a source has begun to wait for long: once, at a tenth of the patience.
static void control(scree_simulation *s)
{
    const scree_births *births = scree_births_of(&s->state);
    for (int64_t k = 0; k < s->model.source_count; k++) {
        const scree_source_state *own = &births->source[k];
        if (own->attempts == 0) continue;
        const double waited = (double)(s->state.step - own->since) * s->state.tick;
        const double limit = 0.1 * scree_pour_patience(&s->stage_model, own_config(s), k);
        if (waited < limit || waited - s->state.step_size >= limit) continue;
        (void)snprintf(s->warning, sizeof s->warning,
                       "source '%s' has been blocked for %.3g s; the run stops when it is for %.3g s",
                       s->model.sources[k].name, waited, 10 * limit);
    }
}

static const char *const ends[SCREE_POUR_ENDS] = {[SCREE_POUR_COUNT] = "as many as the stage wants",
                                                  [SCREE_POUR_OUT] = "no more are left",
                                                  [SCREE_POUR_HEIGHT] = "the pile is as high as wanted",
                                                  [SCREE_POUR_WIDTH] = "the pile is as wide as wanted",
                                                  [SCREE_POUR_PLATEAU] = "the plateau of a source is used up"};

static scree_status finished(scree_simulation *s, bool *done, scree_error *error)
{
    (void)error;
    const config *stage = own_config(s);
    const scree_births *births = scree_births_of(&s->state);
    scree_stage_state *state = &s->state.stage;
    const double unbalanced = s->sample[SCREE_SAMPLE_UNBALANCED_RATIO];
    *done = false;
    if (births->end == SCREE_POUR_GOES_ON) return SCREE_OK;
    state->counter = unbalanced < stage->unbalanced_limit ? state->counter + 1 : 0;
    const bool over = (double)(s->state.step - births->ended) * s->state.tick >= stage->rest_time;
    const bool calm = state->counter >= CALM, waits = !isnan(stage->unbalanced_limit);
    *done = !waits || calm || over;
    int length = snprintf(s->reason, sizeof s->reason, "%llu particles poured: %s",
                          (unsigned long long)births->in_stage, ends[births->end]);
    if (waits && length > 0 && length < (int)sizeof s->reason)
        (void)snprintf(s->reason + length, sizeof s->reason - (size_t)length,
                       calm ? "; unbalanced force ratio %.2g, below %.2g for %d samples"
                            : "; unbalanced force ratio %.2g, not below %.2g for %d samples within rest_time",
                       unbalanced, stage->unbalanced_limit, CALM);
    return SCREE_OK;
}

static double fraction(const scree_simulation *s)
{
    const scree_births *births = scree_births_of(&s->state);
    const uint64_t before = s->state.next_id - births->in_stage;
    return (double)births->in_stage / (double)scree_pour_wanted(&s->model, own_config(s), before);
}

static const scree_stage stage_face = {.name = "pour",
                                       .loading = true,
                                       .planned = planned,
                                       .begin = begin,
                                       .plan = plan,
                                       .control = control,
                                       .finished = finished,
                                       .fraction = fraction};

static scree_sleep_limits sleep(const void *own)
{
    const config *stage = own;
    return (scree_sleep_limits){stage->sleep_window, stage->sleep_force, stage->sleep_motion, stage->wake_force,
                                stage->wake_interval};
}

static const scree_stage_numbers numbers = {.held = true,
                                            .sleep = sleep,
                                            .pours = true,
                                            .needs_standing =
                                                "pour needs something that stands: give walls and boundary: walls",
                                            .wrong = wrong};

const scree_module scree_module_pour = {
    .name = "pour",
    .meaning = "Lets the `sources` pour particles, beside the `walls` of the case.",
    .choice_of = CHOICE_OF(IS("stages", .meaning = "pours particles from the `sources`")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .rules = rules,
    .resolve = resolve,
    .spreads = true,
    .begins_whole = scree_begins_in_parts,
    .numbers = &numbers,
    .stage = &stage_face,
};
