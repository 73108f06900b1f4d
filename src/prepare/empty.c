/// No particles: all of them are poured later (`sources`).
///
/// The box is what lengths of the sample refer to before there is one; nothing of it stands, since a stage that pours
/// has no plates. Width: as `width`, or that of a pile of all particles, HEIGHT high over half its foot.
#include "case/check.h"
#include "module/key_rows.h"
#include "module/preparation.h"
#include "prepare/prepare.h"

#include <math.h>

/// Slope of an expected pile: tan of some 30 degrees.
static const double SLOPE = 0.577;
/// Solid fractions of an expected pile.
static const double SOLID_2D = 0.8, SOLID_3D = 0.6;

static size_t count(const scree_model *model, const scree_config_stage *stage)
{
    (void)model;
    (void)stage;
    return 0;
}

/// Height [m] of a pile of all particles: a triangle in 2D, area H^2 / SLOPE; a cone in 3D, pi H^3 / (3 SLOPE^2).
static double height(const scree_model *model, const scree_config_stage *stage)
{
    (void)stage;
    const double room = (double)model->count * scree_model_mean_solid(model);
    if (model->dimension == 3) return cbrt(3 * SLOPE * SLOPE * room / (SOLID_3D * M_PI));
    return sqrt(SLOPE * room / SOLID_2D);
}

static scree_status place(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                          scree_error *error)
{
    (void)error;
    scree_box *box = &packing->box;
    box->height = height(model, stage);
    if (isnan(box->width)) box->width = 2 * box->height / SLOPE;
    if (model->dimension == 3 && isnan(box->depth)) box->depth = box->width;
    return SCREE_OK;
}

static void rules(scree_reader *reader, const scree_config *config)
{
    const scree_config_stage *stage = scree_config_prepare(config);
    if (stage && scree_config_prepared(stage)->method == SCREE_SLOT_empty &&
        scree_config_prepared(stage)->outline != SCREE_SAMPLE_BOX)
        scree_rule_refuse(reader, "stages.0.outline", "box", "there is nothing yet that could be round");
}

const scree_module scree_module_empty = {
    .name = "empty",
    .meaning = "no particles: stages pour them from the `sources`",
    .choice_of = CHOICE_OF(IS("stages.prepare.method")),
    .rules = rules,
    .preparation = &(const scree_preparation){.sizes_box = true,
                                              .loose = true,
                                              .empty = true,
                                              .periodic = true,
                                              .count = count,
                                              .height = height,
                                              .place = place},
};
