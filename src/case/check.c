/// Reads the tree of a case into the config, section by section, along the schema.
#include "case/check.h"
#include "module/preparation.h"

#include "base/memory.h"
#include "case/csv.h"
#include "case/unknown_key.h"

#include <scree/scree.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void scree_key_join(char out[SCREE_PATH_BYTES], const char *path, const char *name)
{
    size_t length = path[0] ? (size_t)snprintf(out, SCREE_PATH_BYTES, "%s.", path) : 0;
    if (length < SCREE_PATH_BYTES) (void)snprintf(out + length, SCREE_PATH_BYTES - length, "%s", name);
}

const char *scree_element_path(char path[SCREE_PATH_BYTES], const char *list, int64_t index, const char *key)
{
    (void)snprintf(path, SCREE_PATH_BYTES, "%s.%lld.%s", list, (long long)index, key);
    return path;
}

/// A section that is being read.
typedef struct scope {
    scree_reader *reader;
    const scree_section *section;
    const scree_key *list; ///< whose element this is, when it has several kinds of elements; else NULL
    scree_node *mapping;   ///< NULL when the case does not have the section
    scree_place place;     ///< for keys that are missing
    const char *path;
    void *base; ///< the section's struct
} scope;

static void read_section(const scope *s);
static void leave_unread(const scope *s);

/// A key that another kind of element has (a `rate` in a confine stage): left out when an override chose the kind.
static bool is_of_another_kind(const scope *s, scree_node *child, const char *path)
{
    if (!s->list) return false;
    char kinds[200] = "";
    size_t length = 0;
    for (size_t i = 0; i < s->list->section_count && length < sizeof kinds; i++)
        if (scree_section_find(&s->list->sections[i], child->key, strlen(child->key)))
            length += (size_t)snprintf(kinds + length, sizeof kinds - length, "%s%s", length > 0 ? ", " : "",
                                       s->list->sections[i].name);
    if (length == 0) return false;
    const char *chooser = s->section->keys[0].name;
    child->unused = scree_node_find(s->mapping, chooser)->place.origin > child->place.origin;
    char accepted[256];
    (void)snprintf(accepted, sizeof accepted, "only with %s: %s", chooser, kinds);
    if (!child->unused)
        scree_problem_add(s->reader, child->key_place, path, child->text, accepted, "not used with %s: %s", chooser,
                          s->section->name);
    return true;
}

/// Notes an unknown key. Returns the bit of the key that was probably meant, or 0: that one is then not missed too.
static uint64_t refuse_unknown(const scope *s, scree_node *child)
{
    char path[SCREE_PATH_BYTES];
    scree_key_join(path, s->path, child->key);
    if (is_of_another_kind(s, child, path) || scree_problem_omit(s->reader, child->key_place)) return 0;
    const scree_key *meant =
        scree_unknown_key_refuse(s->reader, child->key_place, path, child->key, child->text, s->section);
    return meant ? (uint64_t)1 << (meant - s->section->keys) : 0;
}

static void refuse_unused(const scope *s, scree_node *child, const scree_usage *usage, const char *path)
{
    child->unused = usage->choice && usage->choice->place.origin > child->place.origin;
    if (child->unused) return;
    size_t equals = strcspn(usage->when, "=");
    if (usage->chooser->type == SCREE_KEY_LIST) {
        bool without = usage->choice && usage->choice->count > 0;
        scree_problem_add(s->reader, child->key_place, path, child->text, NULL, "not used with%s %s%s",
                          without ? "" : "out", usage->chooser->name, without ? ": each element says its own" : "");
        return;
    }
    char accepted[256];
    int length = snprintf(accepted, sizeof accepted, "only with %.*s: ", (int)equals, usage->when);
    for (const char *c = usage->when + equals + 1; *c && *c != '&' && (size_t)length + 5 < sizeof accepted; c++)
        length += snprintf(accepted + length, sizeof accepted - (size_t)length, *c == '|' ? " or " : "%c", *c);
    scree_problem_add(s->reader, child->key_place, path, child->text, accepted, "not used with %.*s: %s", (int)equals,
                      usage->when, scree_show(usage->choice ? usage->choice->text : usage->chooser->standard).text);
}

static void refuse_missing(const scope *s, const scree_key *key, const char *path)
{
    char limits[200], accepted[256];
    scree_key_accepts(key, limits, sizeof limits);
    bool choices = key->type == SCREE_KEY_CHOICE;
    scree_place place = s->place;
    place.origin = SCREE_ORIGIN_FILE; // also where the quick section made the section
    (void)snprintf(accepted, sizeof accepted, "%s%s%s", choices ? "" : scree_key_noun(key),
                   limits[0] && !choices ? ", " : "", limits);
    scree_problem_add(s->reader, place, path, NULL, accepted, "required, but not given");
}

static void read_element(const scope *s, const scree_key *list, scree_node *element, const char *path, void *base)
{
    const scree_key *kind = &list->sections[0].keys[0];
    const int unknown = SCREE_CHOICE_WRONG;
    scope inner = {s->reader, scree_element_section(list, element), NULL, element, element->place, path, base};
    if (list->section_count > 1 && !inner.section) memcpy(scree_key_member(kind, base), &unknown, sizeof unknown);
    if (element->kind != SCREE_NODE_MAPPING) {
        scree_problem_add(s->reader, element->place, path, element->text, NULL,
                          "expected keys with values, e.g. '- %s: ...'", list->sections[0].keys[0].name);
        if (inner.section) leave_unread(&inner);
        return;
    }
    if (list->section_count > 1) inner.list = list;
    if (inner.section) {
        read_section(&inner);
        return;
    }
    // Without its kind nothing else of the element can be judged.
    const scree_node *given = scree_node_find(element, kind->name);
    char kind_path[SCREE_PATH_BYTES];
    scree_key_join(kind_path, path, kind->name);
    if (given)
        scree_value_store(s->reader, kind, given, kind_path, base);
    else
        refuse_missing(&inner, kind, kind_path);
    memcpy(scree_key_member(kind, base), &unknown, sizeof unknown);
}

static void read_list(const scope *s, const scree_key *key, scree_node *node, const char *path)
{
    if (!node) return; // a list that may be left out is then empty
    char limits[200];
    scree_limits_text(key, limits, sizeof limits);
    if (node->kind != SCREE_NODE_LIST) {
        scree_problem_add(s->reader, node->place, path, node->text, limits, "expected %s", scree_key_noun(key));
        return;
    }
    const bool few = node->count < strtoull(key->least.text, NULL, 10);
    if (few || node->count > strtoull(key->most.text, NULL, 10)) {
        scree_problem_add(s->reader, node->place, path, NULL, limits, "%zu element%s too %s", node->count,
                          node->count == 1 ? " is" : "s are", few ? "few" : "many");
        return;
    }
    char *elements = scree_arena_take(s->reader->arena, node->count * key->element_size);
    if (!elements) {
        scree_reader_fail(s->reader, node->count * key->element_size);
        return;
    }
    int64_t index = 0;
    for (scree_node *element = node->first; element; element = element->next, index++) {
        char number[24], inner[SCREE_PATH_BYTES];
        (void)snprintf(number, sizeof number, "%lld", (long long)index);
        scree_key_join(inner, path, number);
        char *base = elements + (size_t)index * key->element_size;
        if (key->initial) memcpy(base, key->initial, key->element_size);
        read_element(s, key, element, inner, base);
    }
    memcpy(scree_key_member(key, s->base), &elements, sizeof elements);
    memcpy(scree_key_block(key, s->base) + key->count_offset, &index, sizeof index);
}

/// Gives a section the block in which the structs of modules lie.
static bool make_room(const scope *s)
{
    if (s->section->own_size == 0) return true;
    void *own = scree_arena_take(s->reader->arena, s->section->own_size);
    if (own)
        memcpy((char *)s->base + s->section->own_offset, &own, sizeof own);
    else
        scree_reader_fail(s->reader, s->section->own_size);
    return own != NULL;
}

/// What a key that was not read leaves: choices are wrong, and sections have room for what modules say.
static void leave_key(const scope *s, const scree_key *key)
{
    const int unknown = SCREE_CHOICE_WRONG;
    if (key->type == SCREE_KEY_SECTION) {
        scope inner = {.reader = s->reader, .section = key->sections, .base = scree_key_member(key, s->base)};
        leave_unread(&inner);
    }
    for (; key && key->type == SCREE_KEY_CHOICE; key = key->twin)
        memcpy(scree_key_member(key, s->base), &unknown, sizeof unknown);
}

/// A section that could not be read, which has been noted.
static void leave_unread(const scope *s)
{
    if (!make_room(s)) return;
    for (size_t i = 0; i < s->section->count; i++) leave_key(s, &s->section->keys[i]);
}

/// A section, whether the case has it or not: its defaults count either way.
static void read_inner_section(const scope *s, const scree_key *key, scree_node *node, const char *path)
{
    bool empty = !node || (node->kind == SCREE_NODE_SCALAR && !node->text[0]);
    scope inner = {s->reader,
                   key->sections,
                   NULL,
                   empty ? NULL : node,
                   node ? node->key_place : s->place,
                   path,
                   scree_key_member(key, s->base)};
    if (empty || node->kind == SCREE_NODE_MAPPING) {
        read_section(&inner);
        return;
    }
    scree_problem_add(s->reader, node->place, path, node->text, NULL, "expected %s", scree_key_noun(key));
    leave_unread(&inner);
}

/// Whether its rows may stand in a file.
static bool takes_table(const scree_key *key)
{
    return key->type == SCREE_KEY_SCHEDULE || key->type == SCREE_KEY_PAIRS ||
           (key->type == SCREE_KEY_LIST && key->section_count == 1);
}

static void read_key(const scope *s, const scree_key *key)
{
    char path[SCREE_PATH_BYTES];
    scree_key_join(path, s->path, key->name);
    scree_node *child = scree_node_find(s->mapping, key->name);
    scree_usage usage = scree_key_usage(s->reader->root, s->section, s->mapping, key);
    if (child && usage.use == SCREE_UNUSED) refuse_unused(s, child, &usage, path);
    bool silent = usage.use == SCREE_UNUSED || (usage.use == SCREE_USE_UNKNOWN && !child);
    bool stored = key->type != SCREE_KEY_PATHS || key->element_size > 0;
    if (!stored || silent) return;
    if (key->type == SCREE_KEY_SECTION)
        read_inner_section(s, key, child, path);
    else if (!child && !key->standard)
        refuse_missing(s, key, path);
    else if (takes_table(key) && scree_csv_is_named(child) &&
             !scree_csv_expand(s->reader, child, path, key))
        return;
    else if (key->type == SCREE_KEY_LIST)
        read_list(s, key, child, path);
    else
        scree_value_store(s->reader, key, child, path, s->base);
}

static void read_section(const scope *s)
{
    if (!make_room(s)) return;
    uint64_t meant = 0;
    for (scree_node *child = s->mapping ? s->mapping->first : NULL; child; child = child->next)
        if (!scree_section_find(s->section, child->key, strlen(child->key))) meant |= refuse_unknown(s, child);
    for (size_t i = 0; i < s->section->count; i++) {
        const scree_key *key = &s->section->keys[i];
        bool misspelt = meant >> i & 1 && !scree_node_find(s->mapping, key->name);
        if (misspelt)
            leave_key(s, key);
        else
            read_key(s, key);
    }
}

bool scree_root_read(scree_reader *reader, const scree_section *section, void *base)
{
    if (reader->root->kind != SCREE_NODE_MAPPING) {
        scree_problem_add(reader, reader->root->place, NULL, NULL, NULL,
                          "expected keys with values, e.g. 'name: sample'");
        return false;
    }
    scope whole = {reader, section, NULL, reader->root, reader->root->place, "", base};
    whole.place.line = whole.place.column = 1;
    read_section(&whole);
    return true;
}

/// The method of preparation adds what the case leaves out.
static void supply(scree_reader *reader)
{
    const scree_node *stages = scree_node_find(reader->root, "stages");
    const scree_node *first = stages && stages->kind == SCREE_NODE_LIST ? scree_node_at(stages, 0) : NULL;
    const scree_node *method = first && first->kind == SCREE_NODE_MAPPING ? scree_node_find(first, "method") : NULL;
    if (!method || !method->text) return;
    for (size_t m = 0; m < SCREE_MODULE_COUNT; m++) {
        const scree_preparation *preparation = scree_modules[m]->preparation;
        if (preparation && preparation->supply && strcmp(scree_modules[m]->name, method->text) == 0)
            preparation->supply(reader, first);
    }
}

void scree_config_read(scree_reader *reader, scree_config *config)
{
    if (!scree_schema_is_whole()) {
        scree_problem_add(reader, reader->root->place, NULL, NULL, NULL,
                          "this build of scree cannot read cases: the arrays of its schema are too short "
                          "(src/case/schema_build.c, MOST_KEYS to ALL_TEXT)");
        return;
    }
    if (reader->root->kind == SCREE_NODE_MAPPING) supply(reader);
    // Where memory ran out, what is tied together need not be there.
    if (scree_root_read(reader, scree_schema(), config) && !reader->failure.status) scree_rules_check(reader, config);
}
