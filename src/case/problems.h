/// Collects everything that is wrong with a case; private to src/case/.
#ifndef SCREE_CASE_PROBLEMS_H
#define SCREE_CASE_PROBLEMS_H

#include "case/tree.h"

#include <scree/scree.h>

/// What the reading of one case shares.
typedef struct scree_reader {
    scree_arena *arena;
    scree_problems *problems;
    scree_node *root;    ///< of the case, with overrides applied
    bool only_quick;     ///< note only problems of values from the `quick` section
    scree_error failure; ///< what stopped the reading itself (memory, units); status 0 if nothing did
} scree_reader;

scree_status scree_problems_create(scree_problems **out);

/// Notes a problem at `place`. field, value and accepted may be NULL. Control characters become spaces. Beyond 200
/// problems only their number is kept.
void scree_problem_add(scree_reader *reader, scree_place place, const char *field, const char *value,
                       const char *accepted, const char *format, ...) SCREE_PRINTF(6, 7);

/// True when the list is full: the problem at `place` is counted, and its message need not be made.
bool scree_problem_omit(scree_reader *reader, scree_place place);

/// Sorts by position (values of --set last), and says how many more there were.
void scree_problems_finish(scree_problems *problems);

/// Replaces all by one: what stopped the reading.
void scree_problems_replace(scree_problems *problems, const scree_error *failure);

/// Notes that memory ran out.
void scree_reader_fail(scree_reader *reader, size_t bytes);

/// Where a file that a case names lies: beside the case file, unless its path is absolute.
void scree_file_beside(const scree_reader *reader, const char *name, char *path, size_t size);

/// `text` for a message: at most 60 bytes, whole characters, "..." where something is left out.
typedef struct scree_shown {
    char text[72];
} scree_shown;
scree_shown scree_show(const char *text);

#endif
