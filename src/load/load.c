/// The list of loads of a case.
#include "load/load.h"

#include <string.h>

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

static int64_t find_stage(const scree_config_stage *stages, int64_t count, const char *name, int64_t standard)
{
    for (int64_t i = 0; name && i < count; i++)
        if (stages[i].name && strcmp(stages[i].name, name) == 0) return i;
    return name ? -1 : standard;
}

void scree_load_stages(const scree_config_stage *stages, int64_t count, const char *from, const char *until,
                       int64_t range[2])
{
    range[0] = find_stage(stages, count, from, 0);
    range[1] = find_stage(stages, count, until, count - 1);
}

bool scree_load_acts(const scree_model *model, const scree_state *state, const char *from, const char *until)
{
    int64_t range[2];
    scree_load_stages(model->stages, model->stage_count, from, until, range);
    return state->stage.index >= range[0] && state->stage.index <= range[1];
}

void scree_load_check_stages(scree_reader *reader, const scree_config *config, int64_t index, const char *from,
                             const char *until)
{
    char path[SCREE_PATH_BYTES];
    int64_t range[2];
    (void)scree_rule_is_stage(reader, config, scree_element_path(path, "loads", index, "from"), from);
    (void)scree_rule_is_stage(reader, config, scree_element_path(path, "loads", index, "until"), until);
    scree_load_stages(config->stages, config->stage_count, from, until, range);
    if (range[0] >= 0 && range[1] >= 0 && range[1] < range[0])
        scree_rule_refuse(reader, scree_element_path(path, "loads", index, "until"), NULL,
                          "comes before stage '%s', with which it begins", from);
}
