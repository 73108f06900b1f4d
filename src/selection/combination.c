/// Selections made of others, in any order in the case; no selection may be made of itself.
#include "case/check.h"
#include "module/key_rows.h"
#include "selection/selection.h"

#include <string.h>

typedef struct combination {
    const scree_node *of; ///< names
} combination;

const scree_node *scree_selection_parts(const scree_config_selection *selection)
{
    bool combined = selection->kind >= 0 && scree_modules[selection->kind]->selection->combine;
    return combined && selection->own ? ((const combination *)selection->own)->of : NULL;
}

static bool in_all(uint32_t member, uint32_t parts)
{
    return (member & parts) == parts;
}

static bool in_some(uint32_t member, uint32_t parts)
{
    return (member & parts) != 0;
}

static bool in_none(uint32_t member, uint32_t parts)
{
    return (member & parts) == 0;
}

/// Selections that those of `bits` are made of, directly or not; with them what they are made of.
static uint32_t find_parts(const scree_config *config, uint32_t bits)
{
    for (uint32_t before = ~bits; bits != before;) {
        before = bits;
        for (int64_t i = 0; i < config->selection_count; i++) {
            const scree_node *parts = bits >> i & 1 ? scree_selection_parts(&config->selections[i]) : NULL;
            for (const scree_node *name = parts ? parts->first : NULL; name; name = name->next) {
                int64_t part = scree_config_selection_find(config->selections, config->selection_count, name->text);
                if (part >= 0) bits |= UINT32_C(1) << part;
            }
        }
    }
    return bits;
}

static bool is_made_of_itself(const scree_config *config, int64_t index)
{
    const scree_node *parts = scree_selection_parts(&config->selections[index]);
    uint32_t bits = 0;
    for (const scree_node *name = parts->first; name; name = name->next) {
        int64_t part = scree_config_selection_find(config->selections, config->selection_count, name->text);
        if (part >= 0) bits |= UINT32_C(1) << part;
    }
    return find_parts(config, bits) >> index & 1;
}

/// Those of one kind; each module of this file checks its own.
static void check_kind(scree_reader *reader, const scree_config *config, int kind)
{
    for (int64_t i = 0; i < config->selection_count; i++) {
        char path[SCREE_PATH_BYTES];
        bool known = true;
        const scree_node *parts =
            config->selections[i].kind == kind ? scree_selection_parts(&config->selections[i]) : NULL;
        size_t at = 0;
        for (const scree_node *name = parts ? parts->first : NULL; name; name = name->next, at++) {
            (void)snprintf(path, sizeof path, "selections.%lld.of.%zu", (long long)i, at);
            known = scree_rule_is_selection(reader, config, path, name->text ? name->text : "") && known;
        }
        (void)snprintf(path, sizeof path, "selections.%lld.of", (long long)i);
        if (parts && known && is_made_of_itself(config, i))
            scree_rule_refuse(reader, path, NULL, "selection '%s' is made of itself",
                              config->selections[i].name ? config->selections[i].name : "");
    }
}

static const scree_key keys[] = {
    KEY(combination, of, SCREE_KEY_VALUES, FROM("1"), TO("32"), .meaning = "Names of other selections."),
};

#define COMBINATION(slot, name_, meaning_, combine_)                                                                   \
    static const scree_selection_kind slot##_kind = {.combine = combine_};                                             \
    static void slot##_rules(scree_reader *reader, const scree_config *config)                                         \
    {                                                                                                                  \
        check_kind(reader, config, SCREE_SLOT_##slot);                                                                 \
    }                                                                                                                  \
    const scree_module scree_module_##slot = {                                                                         \
        .name = name_,                                                                                                 \
        .meaning = meaning_,                                                                                           \
        .choice_of = CHOICE_OF(IS("selections")),                                                                      \
        .keys = (const scree_keys[]){KEYS_OF(NULL, keys, combination)},                                                \
        .keys_count = 1,                                                                                               \
        .rules = slot##_rules,                                                                                         \
        .selection = &slot##_kind,                                                                                     \
    }

COMBINATION(select_and, "and", "Particles that belong to all of some other selections.", in_all);
COMBINATION(select_or, "or", "Particles that belong to at least one of some other selections.", in_some);
COMBINATION(select_not, "not", "Particles that belong to none of some other selections.", in_none);
