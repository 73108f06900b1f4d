/// Laws of single pairs of materials (contact.pairs): which one two materials meet under, and the rules of the list.
#include "case/check.h"

#include <stdio.h>
#include <string.h>

enum { MOST_NAMES = 17 };

static const char *other_of(const scree_config_pair_law *pair)
{
    return pair->other ? pair->other : pair->one;
}

static bool is_pair(const scree_config_pair_law *pair, const char *one, const char *other)
{
    return (strcmp(pair->one, one) == 0 && strcmp(other_of(pair), other) == 0) ||
           (strcmp(pair->one, other) == 0 && strcmp(other_of(pair), one) == 0);
}

int scree_config_law_between(const scree_config_contact *contact, const char *one, const char *other)
{
    for (int64_t k = 0; k < contact->pair_count; k++)
        if (contact->pairs[k].one && is_pair(&contact->pairs[k], one, other)) return (int)k + 1;
    return 0;
}

const void *scree_config_law_keys(const scree_config_contact *contact, int number)
{
    const scree_module *module = scree_modules[scree_config_law(contact, number)];
    return number > 0 ? scree_config_own(module, "contact.pairs", contact->pairs[number - 1].own)
                      : scree_config_own(module, "contact", contact->own);
}

/// Whether there is such a material, or it may be one whose name is wrong; else that is noted.
static bool is_material(scree_reader *reader, const scree_config *config, int64_t index, const char *key,
                        const char *name)
{
    const char *names[MOST_NAMES] = {SCREE_RIGID};
    size_t count = 1;
    char path[SCREE_PATH_BYTES];
    if (strcmp(name, SCREE_RIGID) == 0) return true;
    for (int64_t i = 0; i < config->material_count; i++) {
        if (!config->materials[i].name || strcmp(config->materials[i].name, name) == 0) return true;
        names[count++] = config->materials[i].name;
    }
    (void)snprintf(path, sizeof path, "contact.pairs.%lld.%s", (long long)index, key);
    scree_rule_refuse_name(reader, path, "material", name, names, count);
    return false;
}

static void check_pair(scree_reader *reader, const scree_config *config, int64_t index)
{
    const scree_config_pair_law *pair = &config->contact.pairs[index];
    char path[SCREE_PATH_BYTES];
    if (!pair->one) return; // missing or wrong, and noted
    const bool known = is_material(reader, config, index, "between", pair->one);
    if (!is_material(reader, config, index, "and", other_of(pair)) || !known) return;
    (void)snprintf(path, sizeof path, "contact.pairs.%lld.and", (long long)index);
    if (strcmp(pair->one, SCREE_RIGID) == 0 && strcmp(other_of(pair), SCREE_RIGID) == 0)
        scree_rule_refuse(reader, path, "a material", "a wall that is rigid does not touch another: give a material");
    const int first = scree_config_law_between(&config->contact, pair->one, other_of(pair)) - 1;
    (void)snprintf(path, sizeof path, "contact.pairs.%lld.between", (long long)index);
    if (first < index)
        scree_rule_refuse(reader, path, NULL,
                          "contact.pairs.%d is of %s and %s too: a pair of materials has one law, leave one of the two "
                          "out",
                          first, pair->one, other_of(pair));
}

void scree_rules_check_pair_laws(scree_reader *reader, const scree_config *config)
{
    for (int64_t k = 0; k < config->contact.pair_count; k++) check_pair(reader, config, k);
}
