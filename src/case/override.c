/// What overrules the file: its `quick` section, then the values of --set.
#include "case/path.h"
#include "case/yaml.h"

#include <stdio.h>
#include <string.h>

/// Marks a value and everything in it as said in the quick section.
static void mark_quick(scree_node *node)
{
    node->place.origin = node->key_place.origin = SCREE_ORIGIN_QUICK;
    for (scree_node *child = node->first; child; child = child->next) mark_quick(child);
}

void scree_quick_apply(scree_reader *reader)
{
    const scree_node *quick = scree_node_find(reader->root, "quick");
    if (!quick && reader->root->kind == SCREE_NODE_MAPPING)
        scree_problem_add(reader, reader->root->place, "quick", NULL, NULL,
                          "--quick was asked for, but the case does not say what it changes; add e.g. 'quick: "
                          "{particles.count: 600}'");
    if (!quick || (quick->kind == SCREE_NODE_SCALAR && !quick->text[0])) return;
    if (quick->kind != SCREE_NODE_MAPPING) {
        scree_place place = quick->place;
        place.origin = SCREE_ORIGIN_QUICK;
        scree_problem_add(reader, place, "quick", quick->text, NULL,
                          "expected key paths with values, e.g. 'particles.count: 600'");
        return;
    }
    for (scree_node *entry = quick->first; entry; entry = entry->next) {
        mark_quick(entry);
        scree_path_set(reader, entry->key, entry, entry->key_place);
    }
}

void scree_case_supply(scree_reader *reader, const char *path, const char *text)
{
    const scree_place place = reader->root->place;
    const scree_node scalar = {
        .kind = SCREE_NODE_SCALAR, .text = scree_arena_copy(reader->arena, text, strlen(text)), .place = place};
    if (scalar.text)
        scree_path_set(reader, path, &scalar, place);
    else
        scree_reader_fail(reader, strlen(text));
}

void scree_override_apply(scree_reader *reader, const char *text)
{
    char source[256];
    (void)snprintf(source, sizeof source, "--set %s", scree_show(text).text);
    scree_place place = {scree_arena_copy(reader->arena, source, strlen(source)), 0, 0, SCREE_ORIGIN_SET};
    const char *equals = strchr(text, '=');
    size_t length = strlen(text);
    if (!place.source) {
        scree_reader_fail(reader, length);
        return;
    }
    if (!scree_text_check(reader, text, length, place)) return;
    if (!equals || equals == text || !equals[1]) {
        scree_problem_add(reader, place, NULL, text, "key.path=value", "a %s is missing",
                          equals == text ? "key path" : "value");
        return;
    }
    char *path = scree_arena_copy(reader->arena, text, (size_t)(equals - text));
    char *value = scree_arena_copy(reader->arena, equals + 1, strlen(equals + 1));
    if (!path || !value) {
        scree_reader_fail(reader, length);
        return;
    }
    scree_node scalar = {.kind = SCREE_NODE_SCALAR, .text = value, .place = place};
    const scree_node *node = &scalar;
    if (value[0] == '[' || value[0] == '{') node = scree_yaml_read(reader, value, strlen(value), place);
    if (node) scree_path_set(reader, path, node, place);
}
