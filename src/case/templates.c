/// The built-in cases by name and number; their texts are embedded by the build (cmake/embed.cmake).
#include "case/templates.h"

#include <scree/scree.h>

#include <string.h>

size_t scree_template_count(void)
{
    return scree_templates_count;
}

const char *scree_template_name(size_t index)
{
    return index < scree_templates_count ? scree_templates[index].name : NULL;
}

const char *scree_template_meaning(size_t index)
{
    return index < scree_templates_count ? scree_templates[index].meaning : NULL;
}

const char *scree_template_text(const char *name)
{
    for (size_t i = 0; i < scree_templates_count; i++)
        if (strcmp(scree_templates[i].name, name) == 0) return scree_templates[i].text;
    return NULL;
}
