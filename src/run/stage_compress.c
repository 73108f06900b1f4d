/// Stage `compress`: the sample is shortened along its axis at a constant rate (referred to the height at the begin),
/// reached smoothly within `rise_time`, under the pressure of the stage before (boundary/boundary.h, `compress`: plates
/// approach each other, or the axial component of the velocity gradient is imposed). Plates may be given their velocity
/// v in place of a rate: it is 2 v over the height at the begin, which before the stage is the one that the model
/// expects.
///
/// Stop rule: the axial strain (engineering; from the plates, the cell or the Delaunay boundary) has reached `strain`.
#include "run/stage_compress.h"

#include "boundary/boundary.h"
#include "case/check.h"
#include "model/critical_step.h"
#include "module/key_rows.h"
#include "run/loading.h"
#include "run/step.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

typedef scree_compress_config config;
static const scree_key keys[] = {
    NUMBER(config, strain, "1", ABOVE("0 %"), TO("90 %"), .meaning = "Axial strain at which the stage ends."),
    NUMBER(config, rate, "1/s", .standard = "auto", ABOVE("0 1/s"), TO("1e6 1/s"),
           .meaning = "Axial strain rate; auto: that of `velocity`."),
    NUMBER(config, velocity, "m/s", .standard = "auto", ABOVE("0 m/s"), TO("1e4 m/s"),
           .meaning = "In place of `rate`: velocity of each plate, bottom and top, towards the other."),
    NUMBER(config, rise_time, "s", .standard = "auto", FROM("0 s"), TO("1e9 s"),
           .meaning = "Time in which the rate is reached; auto: four wave times of the sample."),
};

static const config *own_config(const scree_simulation *s)
{
    return scree_stage_config(s)->own;
}

/// Whether the plates have been given a velocity.
static bool has_velocity(const config *stage)
{
    return stage->velocity > 0;
}

/// 1/s, of a sample of this height.
static double rate_at(const config *stage, double height)
{
    return has_velocity(stage) ? 2 * stage->velocity / height : stage->rate;
}

static double rate_now(const scree_simulation *s)
{
    return rate_at(own_config(s), scree_loading_of(&s->state)->height);
}

static scree_status begin(scree_simulation *s, scree_error *error)
{
    (void)error;
    scree_loading_begin(s, scree_pressure_now(&s->state));
    return SCREE_OK;
}

static void plan(scree_simulation *s)
{
    const config *stage = own_config(s);
    s->plan = scree_loading_plan(s, stage->strain / rate_now(s), stage->rise_time);
}

static void control(scree_simulation *s)
{
    const scree_context context = scree_step_context(s);
    double loaded, rate = rate_now(s), rise = scree_loading_rise(s, &loaded);
    s->boundary->compress(&context, &(scree_compression){.rate = rate,
                                                         .rise = rise,
                                                         .strain = rate * loaded,
                                                         .height = scree_loading_of(&s->state)->height});
}

static scree_status finished(scree_simulation *s, bool *done, scree_error *error)
{
    const config *stage = own_config(s);
    return scree_loading_finished(s, "axial strain", scree_axial_strain(s), stage->strain, rate_now(s), done, error);
}

static double fraction(const scree_simulation *s)
{
    return scree_axial_strain(s) / own_config(s)->strain;
}

static double rate_of(const scree_model *model, const void *own)
{
    const config *stage = own;
    if (!has_velocity(stage)) return stage->rate;
    return rate_at(stage, scree_expected_height(model, scree_expected_solid_fraction(model)));
}

static double strain_of(const void *own)
{
    return ((const config *)own)->strain;
}

static double duration(const scree_model *model, const void *own)
{
    return strain_of(own) / rate_of(model, own);
}

static double planned(const scree_model *model, const void *own, double wave)
{
    return scree_loading_planned(duration(model, own), ((const config *)own)->rise_time, wave);
}

static void rules(scree_reader *reader, const scree_config *whole)
{
    char path[SCREE_PATH_BYTES];
    for (int64_t i = 0; i < whole->stage_count; i++) {
        if (whole->stages[i].kind != SCREE_SLOT_compress) continue;
        if (scree_rule_is_said(reader, scree_element_path(path, "stages", i, "velocity")) ||
            scree_rule_is_said(reader, scree_element_path(path, "stages", i, "rate")))
            continue;
        scree_rule_refuse(reader, path, NULL, "how fast is not said: give rate, or the velocity of the plates");
    }
}

/// What is wrong with the two ways to say how fast, and under which key; NULL: nothing.
static const char *wrong(const scree_config *whole, int64_t index, const char **key)
{
    const config *stage = whole->stages[index].own;
    const bool rate = !isnan(stage->rate), velocity = has_velocity(stage);
    *key = velocity ? "velocity" : "rate";
    if (rate && velocity) return "rate is given: give one of the two";
    if (velocity && !scree_boundary_has_plates(scree_config_held_by(whole, index)))
        return "the boundary of this stage has no plates that could have a velocity: give rate";
    return NULL;
}

static const scree_stage stage_face = {.name = "compress",
                                       .loading = true,
                                       .strain = scree_axial_strain,
                                       .rate = rate_now,
                                       .begin = begin,
                                       .plan = plan,
                                       .control = control,
                                       .finished = finished,
                                       .fraction = fraction,
                                       .quasistatic = true,
                                       .duration = duration,
                                       .planned = planned};

static const scree_stage_numbers numbers = {.held = true,
                                            .needs_pressure =
                                                "a confine stage must come before: compress keeps its pressure",
                                            .rate = rate_of,
                                            .strain = strain_of,
                                            .wrong = wrong};

const scree_module scree_module_compress = {
    .name = "compress",
    .meaning =
        "Shortens the sample along its axis at a constant rate under the pressure reached before: plates approach each "
        "other, or minimal conditions or a periodic cell impose the rate.",
    .choice_of = CHOICE_OF(IS("stages", .meaning = "shortens the sample along its axis to a strain")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .rules = rules,
    .numbers = &numbers,
    .stage = &stage_face,
    .spreads = true,
    .begins_whole = scree_begins_in_parts,
};
