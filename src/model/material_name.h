/// What materials are called.
#ifndef SCREE_MODEL_MATERIAL_NAME_H
#define SCREE_MODEL_MATERIAL_NAME_H

#include "model/model.h"

/// Name of the material with this number in the case; "" where the model has none (one that is made without a case).
const char *scree_model_material_name(const scree_model *model, int material);

#endif
