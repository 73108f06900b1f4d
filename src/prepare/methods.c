/// What the methods share.
#include "prepare/methods.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

scree_status scree_prepare_error(scree_error *error, const scree_model *model, const scree_config_stage *stage,
                                 const char *key, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const scree_status status = scree_error_set_list(error, SCREE_ERROR_INPUT, format, arguments);
    va_end(arguments);
    int64_t number = 0;
    while (number < model->stage_count && stage != &model->stages[number]) number++;
    return number < model->stage_count ? scree_error_key(error, status, "stages.%lld.%s", (long long)number, key)
                                       : status;
}

/// The key of the side along an axis, where the case gives it.
static const char *key_of_side(const scree_model *model, const scree_config_stage *stage, int axis, const char *usual)
{
    const scree_prepare_config *prepare = scree_config_prepared(stage);
    if (axis == 0 && !isnan(prepare->width)) return "width";
    return axis == 1 && model->dimension == 3 && !isnan(prepare->depth) ? "depth" : usual;
}

scree_status scree_prepare_refuse_box(const scree_model *model, const scree_config_stage *stage, double largest,
                                      const double box[3], scree_error *error)
{
    const bool in_3d = model->dimension == 3;
    const int axis = box[0] < 2 * largest ? 0 : in_3d && box[1] < 2 * largest ? 1 : 2;
    char deep[40] = "";
    if (in_3d) (void)snprintf(deep, sizeof deep, ", %g m deep", box[1]);
    return scree_prepare_error(error, model, stage, key_of_side(model, stage, axis, "solid_fraction"),
                               "a particle %s %g m does not fit into a box %g m wide%s and %g m high",
                               largest > model->radius_max ? "with a bounding circle of radius" : "of radius", largest,
                               box[0], deep, box[2]);
}

scree_status scree_prepare_refuse_side(const scree_model *model, const scree_config_stage *stage, int axis,
                                       bool will_be, double side, double needed, scree_error *error)
{
    const char *key = key_of_side(model, stage, axis, NULL);
    return scree_prepare_error(
        error, model, stage, key ? key : "aspect_ratio",
        "the periodic cell %s only %.3g m wide along %c, and must be wider than two of the largest particles side by "
        "side (%.3g m): %s",
        will_be ? "will be" : "is", side, "xyz"[axis], needed,
        key ? "make it wider" : "take more particles or another aspect_ratio");
}
