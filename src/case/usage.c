/// Which keys are used, given the choices of a case; which section describes a list's element; what it is called.
#include "case/check.h"

#include <stdio.h>
#include <string.h>

/// Whether `text` is one of the alternatives "a|b|c", which end with the condition.
static bool is_among(const char *text, const char *alternatives)
{
    size_t length = strlen(text);
    for (const char *at = alternatives;; at++) {
        size_t one = strcspn(at, "|&");
        if (one == length && strncmp(at, text, length) == 0) return true;
        at += one;
        if (*at != '|') return false;
    }
}

/// Whether an element of a list of the section has this key with one of the alternatives: contact.pairs choose laws as
/// `contact` does.
static bool element_says(const scree_section *section, const scree_node *mapping, const char *name, size_t length,
                         const char *alternatives)
{
    for (size_t i = 0; i < section->count; i++) {
        const scree_key *list = &section->keys[i];
        const scree_key *key = list->type == SCREE_KEY_LIST ? scree_section_find(list->sections, name, length) : NULL;
        const scree_node *node = key ? scree_node_find(mapping, list->name) : NULL;
        for (const scree_node *element = node ? node->first : NULL; element; element = element->next) {
            const scree_node *said = scree_node_find(element, key->name);
            if (said && said->text && is_among(said->text, alternatives)) return true;
        }
    }
    return false;
}

/// One condition of a key.
static scree_usage condition_usage(const scree_node *root, const scree_section *section, const scree_node *mapping,
                                   const char *when)
{
    scree_usage usage = {SCREE_USED, NULL, NULL, when};
    size_t dot = strcspn(when, ".="), equals = strcspn(when, "=");
    const char *name = when;
    const bool elsewhere = dot < equals;
    if (elsewhere) {
        const scree_key *owner = scree_section_find(scree_schema(), when, dot);
        section = owner->sections;
        mapping = scree_node_find(root, owner->name);
        name += dot + 1;
    }
    usage.chooser = scree_section_find(section, name, (size_t)(when + equals - name));
    // What depends on a choice that is not used is not used; a number that is not used is nothing to depend on.
    scree_usage chooser = scree_key_usage(root, section, mapping, usage.chooser);
    if (chooser.use == SCREE_UNUSED) return usage.chooser->type == SCREE_KEY_NUMBER ? usage : chooser;
    usage.choice = scree_node_find(mapping, usage.chooser->name);
    const char *text = usage.choice ? usage.choice->text : usage.chooser->standard;
    if (usage.chooser->type == SCREE_KEY_LIST) text = usage.choice && usage.choice->count > 0 ? "given" : "[]";
    bool known = text && text[0] &&
                 (!usage.chooser->choices || usage.chooser->type == SCREE_KEY_LIST ||
                  scree_choice_find(usage.chooser->choices, text));
    if (!known)
        usage.use = SCREE_USE_UNKNOWN;
    else if (!is_among(text, when + equals + 1) &&
             !(elsewhere &&
               element_says(section, mapping, usage.chooser->name, strlen(usage.chooser->name), when + equals + 1)))
        usage.use = SCREE_UNUSED;
    return usage;
}

/// A further condition is on a key that is there under some of the alternatives of the first one alone: it says nothing
/// where another of them is chosen, too ("contact.law=a|b&ratio=auto", `ratio` a key of law b).
static bool is_of_another(const scree_node *root, const scree_section *section, const scree_node *mapping,
                          const char *first, const char *when)
{
    const scree_key *key = scree_section_find(section, when, strcspn(when, "="));
    const size_t chooser = strcspn(first, "=") + 1;
    if (when == first || strcspn(first, ".") > chooser || !key || !key->when || key->type != SCREE_KEY_NUMBER ||
        strncmp(key->when, first, chooser) != 0)
        return false;
    for (const char *one = first + chooser; *one && *one != '&'; one += *one == '|') {
        const size_t length = strcspn(one, "|&");
        char only[SCREE_PATH_BYTES], name[64];
        (void)snprintf(only, sizeof only, "%.*s%.*s", (int)chooser, first, (int)length, one);
        (void)snprintf(name, sizeof name, "%.*s", (int)length, one);
        one += length;
        if (!is_among(name, key->when + chooser) && condition_usage(root, section, mapping, only).use == SCREE_USED)
            return true;
    }
    return false;
}

scree_usage scree_key_usage(const scree_node *root, const scree_section *section, const scree_node *mapping,
                            const scree_key *key)
{
    scree_usage usage = {SCREE_USED, NULL, NULL, key->when};
    for (const char *when = key->when; when && usage.use == SCREE_USED; when = scree_next_condition(when))
        if (!is_of_another(root, section, mapping, key->when, when))
            usage = condition_usage(root, section, mapping, when);
    return usage;
}

const char *scree_next_condition(const char *when)
{
    const char *end = strchr(when, '&');
    return end ? end + 1 : NULL;
}

const scree_section *scree_element_section(const scree_key *list, const scree_node *element)
{
    if (list->section_count == 1) return list->sections;
    const scree_node *kind = scree_node_find(element, list->sections[0].keys[0].name);
    for (size_t i = 0; kind && kind->text && i < list->section_count; i++)
        if (strcmp(list->sections[i].name, kind->text) == 0) return &list->sections[i];
    return NULL;
}

/// Text of the scalar `key` of an element, NULL when it is missing, empty, "auto" or not a scalar.
static const char *given_text(const scree_node *element, const char *key)
{
    const scree_node *node = scree_node_find(element, key);
    bool given = node && node->text && node->text[0] && strcmp(node->text, "auto") != 0;
    return given ? node->text : NULL;
}

bool scree_element_name(const scree_key *list, const scree_node *parent, const scree_node *element, char *name,
                        size_t size)
{
    const char *own = given_text(element, "name");
    const char *kind_key = list->sections[0].keys[0].name;
    const char *kind = list->section_count > 1 ? given_text(element, kind_key) : NULL;
    if (!own && !kind) return false;
    size_t before = 0, all = 0;
    for (const scree_node *other = parent->first; !own && other; other = other->next) {
        const char *its_kind = given_text(other, kind_key);
        if (other == element) before = all;
        all += its_kind && strcmp(its_kind, kind) == 0 && !given_text(other, "name");
    }
    if (own || all == 1)
        (void)snprintf(name, size, "%s", own ? own : kind);
    else
        (void)snprintf(name, size, "%s_%zu", kind, before + 1);
    return true;
}
