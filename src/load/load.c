/// The list of loads of a case.
#include "load/load.h"

const void *scree_load_next(const scree_model *model, const scree_module *module, const void *previous)
{
    bool found = previous == NULL;
    for (int64_t i = 0; i < model->load_count; i++) {
        const scree_config_load *load = &model->loads[i];
        if (found && load->kind >= 0 && scree_modules[load->kind] == module) return load->own;
        found = found || load->own == previous;
    }
    return NULL;
}

bool scree_load_told(const scree_config *config, const scree_module *module, size_t index)
{
    for (int64_t i = 0; i < config->load_count && index == 0; i++)
        if (config->loads[i].kind >= 0 && scree_modules[config->loads[i].kind] == module) return true;
    return false;
}
