/// Rules of names: that of each selection is its own, and what refers to one finds it.
#include "case/case.h"
#include "case/check.h"

#include <stdio.h>
#include <string.h>

int64_t scree_config_selection_find(const scree_config_selection *selections, int64_t count, const char *name)
{
    for (int64_t i = 0; name && i < count; i++)
        if (selections[i].name && strcmp(selections[i].name, name) == 0) return i;
    return -1;
}

void scree_rule_refuse_name(scree_reader *reader, const char *path, const char *thing, const char *wanted,
                            const char *const *names, size_t count)
{
    char accepted[256] = "";
    size_t length = 0;
    for (size_t i = 0; i < count && length < sizeof accepted; i++)
        length += (size_t)snprintf(accepted + length, sizeof accepted - length, "%s%s", i > 0 ? ", " : "", names[i]);
    const char *nearest = count > 0 ? scree_nearest(wanted, names, count) : NULL;
    scree_rule_refuse(reader, path, count > 0 ? accepted : NULL, "there is no %s '%s'%s%s%s", thing,
                      scree_show(wanted).text, nearest ? "; did you mean '" : "", nearest ? nearest : "",
                      nearest ? "'?" : "");
}

bool scree_rule_is_selection(scree_reader *reader, const scree_config *config, const char *path, const char *name)
{
    const char *names[SCREE_SELECTIONS];
    size_t count = 0;
    if (!name || scree_config_selection_find(config->selections, config->selection_count, name) >= 0) return true;
    for (int64_t i = 0; i < config->selection_count; i++) {
        if (!config->selections[i].name) return true; // it may be the one that is meant
        names[count++] = config->selections[i].name;
    }
    scree_rule_refuse_name(reader, path, "selection", name, names, count);
    return false;
}

void scree_rules_check_selections(scree_reader *reader, const scree_config *config)
{
    for (int64_t i = 0; i < config->selection_count; i++) {
        const char *name = config->selections[i].name;
        int64_t first = scree_config_selection_find(config->selections, config->selection_count, name);
        char path[SCREE_PATH_BYTES];
        (void)snprintf(path, sizeof path, "selections.%lld.name", (long long)i);
        if (name && first < i)
            scree_rule_refuse(reader, path, NULL, "selections.%lld has the name '%s' too", (long long)first,
                              scree_show(name).text);
    }
}

bool scree_rule_is_stage(scree_reader *reader, const scree_config *config, const char *path, const char *name)
{
    enum { MOST_STAGES = 100 };
    const char *names[MOST_STAGES];
    size_t count = 0;
    if (!name) return true;
    for (int64_t i = 0; i < config->stage_count && i < MOST_STAGES; i++) {
        if (!config->stages[i].name || strcmp(config->stages[i].name, name) == 0) return true;
        names[count++] = config->stages[i].name;
    }
    scree_rule_refuse_name(reader, path, "stage", name, names, count);
    return false;
}
