/// Key paths: "particles.count", "stages.2.rate", "stages.compress.rate", "materials.quartz.friction",
/// "stages.deform.velocity_gradient.xy". Elements of lists are called by index from 0 or by name. Private to src/case/.
#ifndef SCREE_CASE_PATH_H
#define SCREE_CASE_PATH_H

#include "case/check.h"

/// Where a path leads. `key` is the last key of it; node is NULL where the case does not give that key.
typedef struct scree_target {
    const scree_section *section; ///< that the key belongs to
    const scree_key *key;
    scree_node *parent;    ///< mapping that holds the key, or would hold it; NULL if the case has no such section
    scree_node *node;      ///< value, or the element when the path ends with one
    bool element;          ///< the path ends with an element of a list
    const char *component; ///< of a key with components, the one that the path ends with; NULL: the key as a whole
    bool no_list;          ///< the path leads into a list that the case does not have
    char reason[256];      ///< why the path leads nowhere
} scree_target;

/// Follows `path` through the schema and the tree. With a reader, sections on the way that the case does not have are
/// created, with `place`. False: `target->reason` says why; what was reached is kept.
bool scree_path_follow(scree_node *root, const char *path, scree_reader *creator, scree_place place,
                       scree_target *target);

/// Sets the value at `path` in the reader's tree. `value` is a node of its own. Notes a problem at `place` if the path
/// leads nowhere, with the nearest path that does.
void scree_path_set(scree_reader *reader, const char *path, const scree_node *value, scree_place place);

/// Applies "key.path=value"; `text` is kept by the tree. A value that begins with '[' or '{' is read as YAML.
void scree_override_apply(scree_reader *reader, const char *text);

/// Applies the `quick` section of the reader's tree.
void scree_quick_apply(scree_reader *reader);

#endif
