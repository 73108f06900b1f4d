/// Following and setting key paths; the path that was probably meant.
#include "case/path.h"

#include "case/nearest.h"

#include <stdio.h>
#include <string.h>

/// A part of a path between two dots.
typedef struct part {
    const char *text;
    size_t length;
} part;

static part next_part(const char **path)
{
    part p = {*path, strcspn(*path, ".")};
    *path += p.length + ((*path)[p.length] == '.');
    return p;
}

static bool is_index(part p)
{
    return p.length > 0 && p.length < 8 && strspn(p.text, "0123456789") >= p.length;
}

/// The element that `p` calls, by index or by name; NULL with a reason.
static scree_node *find_element(const scree_key *list, const scree_node *parent, part p, char *reason, size_t size)
{
    if (is_index(p)) {
        size_t index = 0;
        for (size_t i = 0; i < p.length; i++) index = 10 * index + (size_t)(p.text[i] - '0');
        scree_node *element = scree_node_at(parent, index);
        if (!element)
            (void)snprintf(reason, size, "there is no %s.%zu: the case has %zu, numbered from 0", list->name, index,
                           parent->count);
        return element;
    }
    for (scree_node *element = parent->first; element; element = element->next) {
        char name[64];
        bool same = scree_element_name(list, parent, element, name, sizeof name) && strlen(name) == p.length &&
                    strncmp(name, p.text, p.length) == 0;
        if (same) return element;
    }
    (void)snprintf(reason, size, "nothing in %s is called '%.*s'", list->name, (int)(p.length < 60 ? p.length : 60),
                   p.text);
    return NULL;
}

static scree_node *create_section(scree_reader *creator, scree_node *parent, const scree_key *key, scree_place place)
{
    scree_node *node = scree_arena_take(creator->arena, sizeof *node);
    if (!node) {
        scree_reader_fail(creator, sizeof *node);
        return NULL;
    }
    *node = (scree_node){.kind = SCREE_NODE_MAPPING, .key = key->name, .key_place = place, .place = place};
    const scree_node *old = scree_node_find(parent, key->name);
    if (old)
        scree_node_replace(parent, old, node);
    else
        scree_node_append(parent, node);
    return node;
}

/// Steps from the list at `target` into the element that the path goes on with. False: a reason is set.
static bool enter_element(scree_target *target, const char **path)
{
    const scree_key *list = target->key;
    target->no_list = !target->node || target->node->kind != SCREE_NODE_LIST;
    if (target->no_list) {
        (void)snprintf(target->reason, sizeof target->reason, "the case has no list of %s", list->name);
        return false;
    }
    scree_node *element = find_element(list, target->node, next_part(path), target->reason, sizeof target->reason);
    if (!element) return false;
    target->node = target->parent = element;
    target->element = true;
    target->section = scree_element_section(list, element);
    if (**path && !target->section) {
        // Its kind is missing or wrong, which is a problem of its own; only the kind can be set.
        target->section = &list->sections[0];
        bool kind = strcmp(*path, list->sections[0].keys[0].name) == 0;
        if (!kind)
            (void)snprintf(target->reason, sizeof target->reason, "the %s of this element is not known",
                           list->sections[0].keys[0].name);
        return kind;
    }
    return true;
}

/// Steps into the component that the path ends with, of a key whose value is {component: value}. False: a reason is
/// set.
static bool enter_component(scree_target *target, const char *path, scree_reader *creator, scree_place place)
{
    const scree_key *key = target->key;
    const part p = next_part(&path);
    const scree_choice *choice = key->choices;
    while (choice->name && (strlen(choice->name) != p.length || strncmp(choice->name, p.text, p.length) != 0)) choice++;
    if (!choice->name || *path) {
        (void)snprintf(target->reason, sizeof target->reason, "%s has no component '%.*s'", key->name,
                       (int)(p.length < 60 ? p.length : 60), p.text);
        return false;
    }
    const bool empty = !target->node || (target->node->kind == SCREE_NODE_SCALAR && !target->node->text[0]);
    if (empty && creator && target->parent) target->node = create_section(creator, target->parent, key, place);
    const bool mapping = target->node && target->node->kind == SCREE_NODE_MAPPING;
    target->parent = mapping ? target->node : NULL;
    target->node = mapping ? scree_node_find(target->parent, choice->name) : NULL;
    target->component = choice->name;
    return true;
}

bool scree_path_follow(scree_node *root, const char *path, scree_reader *creator, scree_place place,
                       scree_target *target)
{
    *target = (scree_target){.section = scree_schema(), .parent = root};
    while (true) {
        part p = next_part(&path);
        const scree_key *key = scree_section_find(target->section, p.text, p.length);
        if (!key || key->type == SCREE_KEY_PATHS) {
            (void)snprintf(target->reason, sizeof target->reason, "there is no key '%.*s' here",
                           (int)(p.length < 60 ? p.length : 60), p.text);
            return false;
        }
        target->key = key;
        target->element = false;
        target->node = scree_node_find(target->parent, key->name);
        if (!*path) return true;
        if (key->type == SCREE_KEY_LIST) {
            if (!enter_element(target, &path)) return false;
            if (!*path) return true;
            continue;
        }
        if (key->type == SCREE_KEY_TENSOR) return enter_component(target, path, creator, place);
        if (key->type != SCREE_KEY_SECTION) {
            (void)snprintf(target->reason, sizeof target->reason, "'%s' is a value without keys of its own", key->name);
            return false;
        }
        bool empty = !target->node || (target->node->kind == SCREE_NODE_SCALAR && !target->node->text[0]);
        if (empty && creator && target->parent) target->node = create_section(creator, target->parent, key, place);
        bool mapping = target->node && target->node->kind == SCREE_NODE_MAPPING;
        target->parent = mapping ? target->node : NULL;
        target->section = key->sections;
    }
}

/// The valid path that is nearest to a wrong one: few letters wrong in the whole, else the same last part, else few
/// letters wrong in the last part.
typedef struct search {
    const char *wanted, *wanted_tail;
    bool by_index;
    size_t score;
    char best[SCREE_PATH_BYTES];
} search;

static void consider(search *s, const char *path, const char *tail)
{
    enum { SAME_TAIL = 1000, NEAR_TAIL = 2000 };
    size_t wrong, score = SIZE_MAX;
    if (scree_letters_near(s->wanted, path, &wrong))
        score = wrong;
    else if (scree_letters_near(s->wanted_tail, tail, &wrong))
        score = wrong == 0 ? SAME_TAIL : NEAR_TAIL + wrong;
    if (score >= s->score) return;
    s->score = score;
    (void)snprintf(s->best, sizeof s->best, "%s", path);
}

static void consider_section(search *s, const scree_section *section, const scree_node *mapping, const char *path)
{
    for (size_t i = 0; i < section->count; i++) {
        const scree_key *key = &section->keys[i];
        char inner[SCREE_PATH_BYTES];
        scree_key_join(inner, path, key->name);
        const scree_node *node = scree_node_find(mapping, key->name);
        if (key->type == SCREE_KEY_SECTION) {
            consider_section(s, key->sections, node, inner);
        } else if (key->type != SCREE_KEY_LIST) {
            if (key->type != SCREE_KEY_PATHS) consider(s, inner, key->name);
            continue;
        }
        size_t index = 0;
        bool list = key->type == SCREE_KEY_LIST && node && node->kind == SCREE_NODE_LIST;
        for (const scree_node *element = list ? node->first : NULL; element; element = element->next, index++) {
            char name[64], deeper[SCREE_PATH_BYTES];
            if (s->by_index || !scree_element_name(key, node, element, name, sizeof name))
                (void)snprintf(name, sizeof name, "%zu", index);
            scree_key_join(deeper, inner, name);
            const scree_section *kind = scree_element_section(key, element);
            if (kind) consider_section(s, kind, element, deeper);
        }
    }
}

/// In a list that the case does not have nothing is near.
static void refuse_path(scree_reader *reader, const char *path, const scree_node *value, scree_place place,
                        const scree_target *target)
{
    if (scree_problem_omit(reader, place)) return;
    search s = {.wanted = path, .score = SIZE_MAX};
    const char *dot = strrchr(path, '.');
    s.wanted_tail = dot ? dot + 1 : path;
    for (const char *rest = path; *rest && !s.by_index;) s.by_index = is_index(next_part(&rest));
    if (!target->no_list) consider_section(&s, scree_schema(), reader->root, "");
    scree_problem_add(reader, place, path, value->text, s.best, "%s%s%s%s", target->reason,
                      s.best[0] ? "; did you mean '" : "", s.best, s.best[0] ? "'?" : "");
}

void scree_path_set(scree_reader *reader, const char *path, const scree_node *value, scree_place place)
{
    if (reader->root->kind != SCREE_NODE_MAPPING) return; // noted when the whole is read
    scree_target target;
    bool found = scree_path_follow(reader->root, path, reader, place, &target);
    if (reader->failure.status) return;
    if (found && target.element) {
        (void)snprintf(target.reason, sizeof target.reason, "a whole element cannot be set; name one of its keys");
        found = false;
    }
    if (!found) {
        refuse_path(reader, path, value, place, &target);
        return;
    }
    if (!target.parent) return; // what should be a section is not: noted when the whole is read
    scree_node *node = scree_arena_take(reader->arena, sizeof *node);
    if (!node) {
        scree_reader_fail(reader, sizeof *node);
        return;
    }
    *node = *value;
    node->key = target.component ? target.component : target.key->name;
    node->key_place = place;
    node->place.origin = place.origin;
    if (target.node)
        scree_node_replace(target.parent, target.node, node);
    else
        scree_node_append(target.parent, node);
}
