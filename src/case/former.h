/// What keys and results were called in earlier versions, so that what those have written can still be read.
///
/// Who renames a key, a choice or a result adds a row here; nothing else knows of former names. A key that a version
/// has dropped has no row: a case that gives it is another case.
#ifndef SCREE_CASE_FORMER_H
#define SCREE_CASE_FORMER_H

#include "case/tree.h"

typedef struct scree_former_key {
    const char *path;       ///< as it was: "contact.law", "stages.*.rate" (all elements of a list); NULL ends a table
    const char *name;       ///< last part of the path as it is now
    const char *value, *to; ///< a choice that has another name too; NULL: the value stays
} scree_former_key;
extern const scree_former_key scree_former_keys[];

typedef struct scree_former_result {
    const char *was, *name; ///< NULL ends a table
} scree_former_result;
extern const scree_former_result scree_former_results[];

/// Gives keys and choices of a tree their present names.
void scree_former_keys_apply(scree_node *root, const scree_former_key *table);

#endif
