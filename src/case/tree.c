/// Arena and tree of a case file. Lists are linked, and each piece of an arena is an allocation of its own, so that a
/// test can make every one of them fail: a case file has at most a few thousand values (yaml.c).
#include "case/tree.h"

#include "base/memory.h"

#include <string.h>

typedef struct scree_arena_piece {
    struct scree_arena_piece *older;
    _Alignas(16) unsigned char bytes[];
} piece;

void *scree_arena_take(scree_arena *arena, size_t bytes)
{
    piece *taken;
    if (scree_allocate(&taken, 1, sizeof *taken + bytes, NULL)) return NULL;
    taken->older = arena->newest;
    arena->newest = taken;
    return taken->bytes;
}

char *scree_arena_copy(scree_arena *arena, const char *text, size_t length)
{
    char *copy = scree_arena_take(arena, length + 1);
    if (copy && length > 0) memcpy(copy, text, length);
    return copy;
}

void scree_arena_release(scree_arena *arena)
{
    piece *top = arena->newest;
    arena->newest = NULL;
    while (top) {
        piece *older = top->older;
        scree_release(&top);
        top = older;
    }
}

scree_node *scree_node_find(const scree_node *mapping, const char *key)
{
    if (!mapping || mapping->kind != SCREE_NODE_MAPPING) return NULL;
    for (scree_node *child = mapping->first; child; child = child->next)
        if (strcmp(child->key, key) == 0) return child;
    return NULL;
}

scree_node *scree_node_at(const scree_node *list, size_t index)
{
    if (!list || list->kind != SCREE_NODE_LIST || index >= list->count) return NULL;
    scree_node *child = list->first;
    while (index-- > 0) child = child->next;
    return child;
}

void scree_node_append(scree_node *parent, scree_node *child)
{
    if (parent->last)
        parent->last->next = child;
    else
        parent->first = child;
    parent->last = child;
    child->next = NULL;
    parent->count++;
}

void scree_node_replace(scree_node *parent, const scree_node *old, scree_node *child)
{
    child->next = old->next;
    if (parent->last == old) parent->last = child;
    if (parent->first == old) {
        parent->first = child;
        return;
    }
    scree_node *before = parent->first;
    while (before->next != old) before = before->next;
    before->next = child;
}
