/// Copies of what modules keep in a config.
#include "base/memory.h"
#include "case/schema.h"

#include <string.h>

enum { ALIGNMENT = 16 };

/// Bytes of the block of a stage.
static size_t own_size(const scree_config_stage *stage)
{
    const scree_key *key = scree_section_find(scree_schema(), "stages", strlen("stages"));
    for (size_t i = 0; i < key->section_count; i++)
        if (strcmp(key->sections[i].name, scree_modules[stage->kind]->name) == 0) return key->sections[i].own_size;
    return 0;
}

scree_status scree_config_copy_stages(const scree_config *config, scree_config_stage **stages, scree_error *error)
{
    size_t count = (size_t)config->stage_count, first = count * sizeof **stages;
    first = (first + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    size_t size = first;
    for (size_t i = 0; i < count; i++) size += own_size(&config->stages[i]);
    char *bytes = NULL;
    scree_status status = scree_allocate(&bytes, size, 1, error);
    if (status) return status;
    *stages = (scree_config_stage *)(void *)bytes;
    memcpy(*stages, config->stages, count * sizeof **stages);
    char *at = bytes + first;
    for (size_t i = 0; i < count; i++) {
        size_t bytes_of = own_size(&config->stages[i]);
        if (bytes_of > 0) memcpy(at, config->stages[i].own, bytes_of);
        (*stages)[i].own = at;
        at += bytes_of;
    }
    return SCREE_OK;
}
