/// What materials are called.
#include "model/material_name.h"

const char *scree_model_material_name(const scree_model *model, int material)
{
    const char *name = model->config ? scree_model_material_said(model, material)->name : NULL;
    return name ? name : "";
}
