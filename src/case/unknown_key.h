/// A key that is none. Private to src/case/.
#ifndef SCREE_CASE_UNKNOWN_KEY_H
#define SCREE_CASE_UNKNOWN_KEY_H

#include "case/problems.h"
#include "module/key.h"

/// Notes that `section` has no key `name`, with the nearest of those that it has, which is returned, or else (NULL)
/// all. value: what the case gives it, or NULL.
const scree_key *scree_unknown_key_refuse(scree_reader *reader, scree_place place, const char *path, const char *name,
                                          const char *value, const scree_section *section);

#endif
