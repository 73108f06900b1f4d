/// The built-in sweeps by name and number.
#include "sweep/templates.h"

#include <scree/scree.h>

#include <string.h>

const scree_template *scree_sweep_template(const char *name)
{
    for (size_t i = 0; i < scree_sweep_templates_count; i++)
        if (strcmp(scree_sweep_templates[i].name, name) == 0) return &scree_sweep_templates[i];
    return NULL;
}

size_t scree_sweep_builtin_count(void)
{
    return scree_sweep_templates_count;
}

const char *scree_sweep_builtin_name(size_t index)
{
    return index < scree_sweep_templates_count ? scree_sweep_templates[index].name : NULL;
}

const char *scree_sweep_builtin_meaning(size_t index)
{
    return index < scree_sweep_templates_count ? scree_sweep_templates[index].meaning : NULL;
}
