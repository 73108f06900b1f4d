/// Former names of keys and results. Both tables are empty: nothing that version 0.1.0 writes has been renamed since.
#include "case/former.h"

#include <string.h>

const scree_former_key scree_former_keys[] = {{NULL, NULL, NULL, NULL}};
const scree_former_result scree_former_results[] = {{NULL, NULL}};

static void rename_key(const scree_node *mapping, const char *name, const scree_former_key *row)
{
    scree_node *node = scree_node_find(mapping, name);
    if (!node || (strcmp(name, row->name) != 0 && scree_node_find(mapping, row->name))) return;
    node->key = row->name;
    if (row->value && node->text && strcmp(node->text, row->value) == 0) node->text = row->to;
}

static void descend(const scree_node *node, const char *path, const scree_former_key *row)
{
    char part[64];
    size_t length = strcspn(path, ".");
    if (!node || length >= sizeof part) return;
    memcpy(part, path, length);
    part[length] = 0;
    if (!path[length] && node->kind == SCREE_NODE_MAPPING)
        rename_key(node, part, row);
    else if (path[length] && strcmp(part, "*") == 0)
        for (const scree_node *each = node->first; each; each = each->next) descend(each, path + length + 1, row);
    else if (path[length])
        descend(scree_node_find(node, part), path + length + 1, row);
}

void scree_former_keys_apply(scree_node *root, const scree_former_key *table)
{
    for (const scree_former_key *row = table; row && row->path; row++) descend(root, row->path, row);
}
