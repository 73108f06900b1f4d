/// Arena and tree of a case file. Lists are linked: a case file has at most a few thousand values (yaml.c).
#include "case/tree.h"

#include "base/memory.h"

#include <string.h>

enum { BLOCK_BYTES = 8192, GRAIN = 16 };

typedef struct scree_arena_block {
    struct scree_arena_block *older;
    size_t used, size;
    _Alignas(GRAIN) unsigned char bytes[];
} block;

void *scree_arena_take(scree_arena *arena, size_t bytes)
{
    size_t wanted = (bytes + GRAIN - 1) / GRAIN * GRAIN;
    if (wanted < bytes) return NULL;
    block *top = arena->newest;
    if (!top || top->size - top->used < wanted) {
        size_t size = wanted > BLOCK_BYTES ? wanted : BLOCK_BYTES;
        if (scree_allocate(&top, 1, sizeof *top + size, NULL)) return NULL;
        top->older = arena->newest;
        top->size = size;
        arena->newest = top;
    }
    void *taken = top->bytes + top->used;
    top->used += wanted;
    return taken;
}

char *scree_arena_copy(scree_arena *arena, const char *text, size_t length)
{
    char *copy = scree_arena_take(arena, length + 1);
    if (copy && length > 0) memcpy(copy, text, length);
    return copy;
}

void scree_arena_release(scree_arena *arena)
{
    block *top = arena->newest;
    arena->newest = NULL;
    while (top) {
        block *older = top->older;
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
