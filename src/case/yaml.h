/// YAML text to a tree, through libfyaml. Private to src/case/.
#ifndef SCREE_CASE_YAML_H
#define SCREE_CASE_YAML_H

#include "case/problems.h"

/// Tree of `text`, or NULL after an error that left none (noted). `place` gives source and origin of every node; text
/// that is not from a file (line 0 in `place`) has no positions.
/// Errors: bad syntax, anchors, aliases, tags, a second document, keys that are not plain text, more than 16 levels or
/// 5,000 values. A key that is given twice is noted, and its first value counts.
scree_node *scree_yaml_read(scree_reader *reader, const char *text, size_t length, scree_place place);

/// Refuses what cannot be a case file, before any parser sees it: more than 1 MiB, NUL and control characters, invalid
/// UTF-8, lines of more than 4096 bytes. Notes the first such thing and returns false.
bool scree_text_check(scree_reader *reader, const char *text, size_t length, scree_place place);

#endif
