/// Other files in the language of cases: YAML with positions, units, suggestions, all problems at once, along a schema
/// table of their own (a sweep, a table of statements).
#ifndef SCREE_CASE_DOCUMENT_H
#define SCREE_CASE_DOCUMENT_H

#include "case/check.h"

typedef struct scree_document {
    const scree_section *section;                    ///< schema of the whole file
    void (*rules)(scree_reader *reader, void *user); ///< ties several keys together; may note problems; may be NULL
    void *user;
    const char *name; ///< stands for the file in messages
    const char *text;
    size_t length;
} scree_document;

/// Reads the text into the struct at `base`, which is zeroed. Its texts, lists and nodes live in `arena`. Errors:
/// SCREE_ERROR_INPUT with *problems, SCREE_ERROR_IO when memory ran out; the arena has to be released either way.
scree_status scree_document_read(const scree_document *document, scree_arena *arena, void *base, size_t size,
                                 scree_problems **problems) SCREE_MUST_USE;

/// Closes a list of problems that were noted through `reader`: sorts them, and says whether there are any.
scree_status scree_reader_conclude(scree_reader *reader);

#endif
