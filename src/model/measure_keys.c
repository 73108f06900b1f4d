#include "model/measure_keys.h"

#include <string.h>

scree_status scree_model_keep_measure_keys(scree_model *model, int slot)
{
    const void *own = scree_config_own(scree_modules[slot], "measure", model->config->measure.own);
    if (own) memcpy(scree_model_reserve_numbers(model, slot), own, scree_modules[slot]->numbers_size);
    return SCREE_OK;
}
