/// Friction, and how a stage changes it. There is one way: the model of a stage is a copy of the model of the case in
/// which the coefficient of friction of every pair of materials is that of the stage, on plates and walls of the case
/// too (also where a wall has a friction of its own), and laws have the option of the stage. Kernels, bounds and
/// measures are given that model and know nothing of stages. What resists rolling stays. Materials that are
/// frictionless, whatever the stage says, have no bit of any resistance.
#include "model/model.h"

static bool is_frictionless(const scree_model *model, int material)
{
    return model->frictionless >> material & 1;
}

static void take_friction(const scree_model *model, int law, scree_pair_constants *pair)
{
    for (int k = 0; k < SCREE_PAIR_CONSTANTS; k++)
        if (scree_law_get(model->laws[law].law)->resistances >> k & 1) pair->value[k] = 0;
}

void scree_model_make_frictionless(scree_model *model, int material)
{
    model->frictionless |= 1u << material;
    take_friction(model, model->law_of_walls[material], &model->walls[material]);
    for (int w = 0; w < SCREE_SURFACES; w++)
        take_friction(model, model->law_of_surfaces[w][material], &model->surfaces[w][material]);
    for (int i = 0; i < SCREE_MAX_MATERIALS; i++) {
        take_friction(model, model->law_of_pairs[i][material], &model->pairs[i][material]);
        model->pairs[material][i] = model->pairs[i][material];
        take_friction(model, 0, &model->persistent.pairs[i][material]);
        model->persistent.pairs[material][i] = model->persistent.pairs[i][material];
    }
}

scree_model scree_model_with_friction(const scree_model *model, double friction)
{
    scree_model copy = *model;
    for (int i = 0; i < SCREE_MAX_MATERIALS && !isnan(friction); i++) {
        if (is_frictionless(model, i)) continue;
        copy.walls[i].value[SCREE_FRICTION] = friction;
        for (int w = 0; w < SCREE_SURFACES; w++) copy.surfaces[w][i].value[SCREE_FRICTION] = friction;
        for (int j = 0; j < SCREE_MAX_MATERIALS; j++) {
            if (is_frictionless(model, j)) continue;
            copy.pairs[i][j].value[SCREE_FRICTION] = friction;
            copy.persistent.pairs[i][j].value[SCREE_FRICTION] = friction;
        }
    }
    return copy;
}

scree_model scree_model_of_stage(const scree_model *model, const scree_config_stage *stage)
{
    scree_model copy = scree_model_with_friction(model, stage->friction);
    const scree_config_contact *contact = &model->config->contact;
    for (int k = 0; k < scree_model_law_count(model); k++) {
        scree_law_use *use = &copy.laws[k];
        const scree_law *law = scree_law_get(use->law);
        if (law->stage_options) use->option = law->stage_options(scree_config_law_keys(contact, k), stage, use->option);
    }
    return copy;
}
