/// The case behind the public handle, and the pieces of the case language that other layers use.
#ifndef SCREE_CASE_CASE_H
#define SCREE_CASE_CASE_H

#include "case/config.h"
#include "case/former.h"

#include <scree/scree.h>

struct scree_case {
    scree_config config;
    /// For the message of an error that shows only later (model_build): position of a key in the file it came from.
    /// Private to src/case/.
    struct scree_case_source *source;
};

/// Text of a file that is a case, or is written like one (at most 1 MiB and not empty); free *bytes with scree_release.
/// Errors: as scree_case_read, also as the only one of *problems (which may be NULL).
scree_status scree_case_text(const char *path, char **bytes, size_t *length, scree_problems **problems);

/// Reads a case that Scree has written, also a version in which keys had other names (scree_former_keys). Errors: as
/// scree_case_read.
scree_status scree_case_reread(const char *path, const scree_former_key *former, scree_case **out,
                               scree_problems **problems);

/// Whether two cases mean the same: equal values of all keys that they use, however they are written.
bool scree_case_same(const scree_case *one, const scree_case *other);
enum { SCREE_CASE_PATH = sizeof((scree_error *)0)->field };
/// How many stages at the begin of two cases are the same, so that a sample is the same when the last of them ends: 0
/// where anything else than stages, name, title, output and guards differs. `where`: path of the first key that
/// differs, of the stages the first behind those; empty: there is none.
int64_t scree_case_common_stages(const scree_case *one, const scree_case *other, char where[SCREE_CASE_PATH]);
/// The first stage in which two cases differ, whatever else does; -1: in none. `where`: path of the key; empty where one
/// case has fewer stages.
int64_t scree_case_stage_apart(const scree_case *one, const scree_case *other, char where[SCREE_CASE_PATH]);
/// Whether two cases are not the same. `where`: path of the first key that differs.
bool scree_case_is_apart(const scree_case *one, const scree_case *other, char where[SCREE_CASE_PATH]);
/// FNV-1a (Fowler, Noll, Vo) of the values of the resolved case: a checkpoint belongs to one case. Limits that only
/// stop a run (guard, time_limit) and comments are left out, so that a run goes on when they have been changed. Errors:
/// memory.
scree_status scree_case_checksum(const scree_case *c, uint64_t *checksum, scree_error *error) SCREE_MUST_USE;

/// Fills file, line, column and value of `error` from its `field` (a key path). A key that the case does not give has
/// its default as value and the position of its section.
void scree_case_locate(const scree_case *c, scree_error *error);

#endif
