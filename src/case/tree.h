/// The case file as a tree of lists, mappings and scalars, each with its position; and the memory it lives in.
#ifndef SCREE_CASE_TREE_H
#define SCREE_CASE_TREE_H

#include "base/error.h"

#include <stdbool.h>

/// Memory that is given back all at once: the tree, the texts and arrays of the config, and the case itself.
typedef struct scree_arena {
    struct scree_arena_piece *newest;
} scree_arena;

/// Zeroed bytes for any type, or NULL when memory ran out.
void *scree_arena_take(scree_arena *arena, size_t bytes);
/// NUL-terminated copy, or NULL when memory ran out.
char *scree_arena_copy(scree_arena *arena, const char *text, size_t length);
void scree_arena_release(scree_arena *arena);

typedef enum scree_node_kind { SCREE_NODE_SCALAR, SCREE_NODE_LIST, SCREE_NODE_MAPPING } scree_node_kind;

/// Where a value was said; a later one overrules an earlier one.
typedef enum scree_origin { SCREE_ORIGIN_FILE, SCREE_ORIGIN_QUICK, SCREE_ORIGIN_SET } scree_origin;

typedef struct scree_place {
    const char *source; ///< the file, or "--set key=value"
    int line, column;   ///< 1-based; 0 outside a file
    scree_origin origin;
} scree_place;

typedef struct scree_node {
    scree_node_kind kind;
    const char *key;  ///< in a mapping, else NULL
    const char *text; ///< of a scalar; "" where nothing is written
    scree_place key_place, place;
    bool unused; ///< an override chose something that does not use this key: left out
    struct scree_node *first, *last, *next;
    size_t count; ///< elements or entries
} scree_node;

scree_node *scree_node_find(const scree_node *mapping, const char *key);
scree_node *scree_node_at(const scree_node *list, size_t index);
void scree_node_append(scree_node *parent, scree_node *child);
/// Puts `child` in the place of `old` among the children of `parent`.
void scree_node_replace(scree_node *parent, const scree_node *old, scree_node *child);

#endif
