/// Stage `prepare`: places the particles. Takes no steps.
#include "module/key_rows.h"
#include "prepare/prepare.h"
#include "run/simulation.h"

#include "search/neighbours.h"

typedef scree_prepare_config config;
static const scree_choice outlines[] = {
    {"box", SCREE_SAMPLE_BOX, "the packing fills its box"},
    {"circle", SCREE_SAMPLE_CIRCLE, "in two dimensions: the middle of a larger packing, without plates around it"},
    {"ball", SCREE_SAMPLE_BALL, "in three dimensions: the middle of a larger packing, without plates around it"},
    {0},
};
/// Whether the box of the sample follows from number, sizes and solid fraction of the particles.
static bool has_aspect_ratio(const scree_module *module)
{
    return module->preparation && !module->preparation->sizes_box;
}

static bool is_solid(const scree_module *module)
{
    return module->shape && module->shape->dimension == 3;
}

static const scree_key keys[] = {
    CHOICE(config, method, NULL, .standard = "drop_and_roll", .meaning = "How the particles are placed."),
    NUMBER(config, aspect_ratio, "1", .standard = "2", FROM("0.01"), TO("100"), .when = "outline=box&width=auto",
           .chooser = "method", .fits = has_aspect_ratio, .meaning = "Height over width of the sample."),
    CHOICE(config, outline, outlines, .standard = "box", .meaning = "Outline of the sample."),
    NUMBER(config, width, "m", .standard = "auto", FROM("1 nm"), TO("100 km"), .when = "outline=box",
           .meaning = "Width of the sample; auto: from `aspect_ratio`, and number and sizes of the particles; with "
                      "`bodies` as far as they reach."),
    NUMBER(config, depth, "m", .standard = "auto", FROM("1 nm"), TO("100 km"), .chooser = "particles.shape",
           .fits = is_solid,
           .meaning = "Depth of the sample, along y in three dimensions; auto: its width; with `bodies` as far as they "
                      "reach."),
};

static void give_reason(scree_simulation *s)
{
    const scree_preparation *method = scree_modules[scree_config_prepared(scree_stage_config(s))->method]->preparation;
    const char *remark = method->remark ? method->remark(scree_stage_config(s)) : "";
    (void)snprintf(s->reason, sizeof s->reason, "%zu particles placed%s%s", s->state.count, remark[0] ? "; " : "",
                   remark);
}

static scree_status begin(scree_simulation *s, scree_error *error)
{
    scree_state prepared;
    scree_status status = scree_prepare(&s->model, scree_stage_config(s), &prepared, error);
    if (status) return status;
    prepared.stage = s->state.stage;
    prepared.spent = s->state.spent;
    scree_state_destroy(&s->state);
    s->state = prepared;
    scree_neighbours_invalidate(&s->work);
    give_reason(s);
    return SCREE_OK;
}

static const scree_stage stage_face = {.name = "prepare", .instant = true, .begin = begin};

static const scree_stage_numbers numbers = {.places = true};

const scree_module scree_module_prepare = {
    .name = "prepare",
    .meaning = "Places the particles; the first stage of every case.",
    .choice_of = CHOICE_OF(IS("stages", .meaning = "places the particles")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .numbers = &numbers,
    .stage = &stage_face,
    .spreads = true,
};
