/// What is asked of a model.
#include "model/model.h"

#include <assert.h>
#include <math.h>
#include <string.h>

int scree_model_material(const scree_model *model, const char *name)
{
    if (!name) return model->species[0].material;
    for (int i = 0; i < model->material_count; i++)
        if (strcmp(model->config->materials[model->listed[i]].name, name) == 0) return i;
    return -1;
}

bool scree_model_is_wholly_periodic(const scree_model *model)
{
    return model->periodic > 0 && model->periodic == (1u << model->dimension) - 1;
}

double scree_model_stiffness(const scree_model *model, double pressure, double diameter, double depth)
{
    double sum = 0;
    for (int k = 0; k < scree_model_law_count(model); k++) {
        const scree_mean_pair pair = scree_model_mean_pair(model, k);
        if (pair.share > 0)
            sum += pair.share *
                   scree_law_get(model->laws[k].law)
                       ->elastic->stiffness(&pair.constants, 0.5 * model->mean_radius, pressure, diameter, depth);
    }
    return sum;
}

double scree_model_largest_radius(const scree_model *model)
{
    return fmax(fmax(model->radius_max, model->bounding_max), model->added_radius);
}

void *scree_model_reserve_numbers(scree_model *model, int slot)
{
    enum { ALIGNMENT = 16 };
    size_t size = (scree_modules[slot]->numbers_size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    if (model->number_at[slot] == 0) {
        assert(model->numbers_end + size <= sizeof model->numbers);
        // 0 says that there are none.
        model->number_at[slot] = (uint16_t)(model->numbers_end + 1);
        model->numbers_end += size;
    }
    return &model->numbers[model->number_at[slot] - 1];
}

const void *scree_model_numbers(const scree_model *model, int slot)
{
    return model->number_at[slot] ? &model->numbers[model->number_at[slot] - 1] : NULL;
}

double scree_held_pressure(const scree_config_stage *stage)
{
    const scree_stage_numbers *numbers = scree_modules[stage->kind]->numbers;
    return numbers->pressure ? numbers->pressure(stage->own) : NAN;
}

double scree_model_loading_rate(const scree_model *model, const scree_config_stage *stage)
{
    const scree_stage_numbers *numbers = scree_modules[stage->kind]->numbers;
    return numbers->rate ? numbers->rate(model, stage->own) : NAN;
}

const scree_boundary *scree_model_boundary_of(const scree_model *model, int64_t index)
{
    return scree_config_held_by(model->config, index);
}
