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
