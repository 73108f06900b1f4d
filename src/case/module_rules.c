/// Rules that modules declare, for those that a case uses: that it has chosen, by a key that counts.
#include "case/check.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// A section of a case: what is written, and what it was read into.
typedef struct part {
    const scree_node *root, *mapping;
    const char *base;
} part;

static void mark_section(const scree_section *section, const part *p, bool used[SCREE_MODULE_COUNT]);

static void mark_list(const scree_key *key, const part *p, bool used[SCREE_MODULE_COUNT])
{
    const scree_node *list = scree_node_find(p->mapping, key->name);
    int64_t count;
    const char *array;
    memcpy(&count, scree_key_block(key, p->base) + key->count_offset, sizeof count);
    memcpy(&array, scree_key_member(key, p->base), sizeof array);
    for (int64_t i = 0; i < count; i++) {
        part element = {p->root, scree_node_at(list, (size_t)i), array + (size_t)i * key->element_size};
        const scree_section *section = scree_element_section(key, element.mapping);
        if (section) mark_section(section, &element, used);
    }
}

/// The module that a key chooses; NULL: none.
static const scree_module *chosen_module(const scree_key *key, const part *p)
{
    int slot;
    memcpy(&slot, scree_key_member(key, p->base), sizeof slot);
    bool module = slot >= 0 && slot < SCREE_MODULE_COUNT;
    for (const scree_choice *c = key->choices; module && c->name; c++)
        if (c->value == slot && c->name == scree_modules[slot]->name) return scree_modules[slot];
    return NULL;
}

static void mark_section(const scree_section *section, const part *p, bool used[SCREE_MODULE_COUNT])
{
    for (size_t i = 0; i < section->count; i++) {
        const scree_key *key = &section->keys[i];
        if (scree_key_usage(p->root, section, p->mapping, key).use != SCREE_USED) continue;
        if (!scree_key_block(key, p->base)) continue; // the section could not be read, and that has been noted
        part inner = {p->root, scree_node_find(p->mapping, key->name), scree_key_member(key, p->base)};
        const scree_module *module = key->type == SCREE_KEY_CHOICE ? chosen_module(key, p) : NULL;
        for (size_t m = 0; module && m < SCREE_MODULE_COUNT; m++) used[m] = used[m] || scree_modules[m] == module;
        if (key->type == SCREE_KEY_SECTION) mark_section(key->sections, &inner, used);
        if (key->type == SCREE_KEY_LIST) mark_list(key, p, used);
    }
}

void scree_rules_check_modules(scree_reader *reader, scree_config *config)
{
    bool used[SCREE_MODULE_COUNT] = {0};
    part whole = {reader->root, reader->root, (const char *)config};
    mark_section(scree_schema(), &whole, used);
    for (size_t m = 0; m < SCREE_MODULE_COUNT; m++)
        if ((used[m] || !scree_modules[m]->choice_of) && scree_modules[m]->rules)
            scree_modules[m]->rules(reader, config);
}

/// The key at a path; NULL where the case does not have it. *found: that, or the last section of its path that it has.
static scree_node *find_node(const scree_reader *reader, const char *path, scree_node **found)
{
    scree_node *node = *found = reader->root;
    for (const char *at = path; node && *at;) {
        char name[SCREE_PATH_BYTES];
        size_t length = strcspn(at, ".");
        (void)snprintf(name, sizeof name, "%.*s", (int)length, at);
        at += length + (at[length] == '.');
        node =
            node->kind == SCREE_NODE_LIST ? scree_node_at(node, strtoul(name, NULL, 10)) : scree_node_find(node, name);
        if (node) *found = node;
    }
    return node;
}

void scree_rule_refuse(scree_reader *reader, const char *path, const char *accepted, const char *format, ...)
{
    char message[320];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    scree_node *found, *node = find_node(reader, path, &found);
    scree_problem_add(reader, found->place, path, node ? node->text : NULL, accepted, "%s", message);
}

const char *scree_rule_choices(scree_reader *reader, const char *key, const char *between,
                               bool (*suits)(const scree_module *module))
{
    char text[400];
    size_t length = 0;
    for (int m = 0; m < SCREE_MODULE_COUNT; m++) {
        const scree_choice_of *choice = scree_modules[m]->choice_of;
        while (choice && choice->key && strcmp(choice->key, key) != 0) choice++;
        if (!choice || !choice->key || !suits(scree_modules[m]) || length >= sizeof text) continue;
        length += (size_t)snprintf(text + length, sizeof text - length, "%s%s", length > 0 ? between : "",
                                   scree_modules[m]->name);
    }
    if (length >= sizeof text) length = sizeof text - 1;
    return length > 0 ? scree_arena_copy(reader->arena, text, length) : NULL;
}

bool scree_rule_is_said(scree_reader *reader, const char *path)
{
    scree_node *found, *node = find_node(reader, path, &found);
    return node && !(node->text && strcmp(node->text, "auto") == 0);
}

bool scree_rule_overrules(scree_reader *reader, const char *path, const char *other)
{
    scree_node *found, *node = find_node(reader, path, &found), *below = find_node(reader, other, &found);
    return node && below && node->place.origin > below->place.origin;
}

void scree_rule_set_text(scree_reader *reader, const char *path, const char *text, char **member)
{
    scree_node *section, *node = find_node(reader, path, &section);
    char *name = node ? NULL : scree_arena_copy(reader->arena, strrchr(path, '.') + 1, strlen(strrchr(path, '.') + 1));
    *member = scree_arena_copy(reader->arena, text, strlen(text));
    if (name && *member && (node = scree_arena_take(reader->arena, sizeof *node))) {
        *node = (scree_node){.key = name, .key_place = section->place, .place = section->place};
        scree_node_append(section, node);
    }
    if (!*member || !node)
        scree_reader_fail(reader, sizeof *node);
    else
        node->text = *member;
}
