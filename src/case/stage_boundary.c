/// Which boundary a stage has.
#include "case/config.h"

int scree_config_boundary_of(const scree_config *config, int64_t index)
{
    for (int m = 0; m < SCREE_MODULE_COUNT; m++) {
        const scree_boundary *boundary = scree_modules[m]->boundary;
        if (boundary && boundary->forced && boundary->forced(config, index)) return m;
    }
    while (index >= 0 && config->stages[index].boundary == SCREE_CHOICE_AUTO) index--;
    if (index >= 0) return config->stages[index].boundary;
    for (int m = 0; m < SCREE_MODULE_COUNT; m++) {
        const scree_boundary *boundary = scree_modules[m]->boundary;
        if (boundary && boundary->standard && boundary->standard(config)) return m;
    }
    return config->boundary.lateral;
}
