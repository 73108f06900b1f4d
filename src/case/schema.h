/// The schema of a case file: one table of keys a section, those of the core and of the modules. It drives parsing,
/// checks, defaults, --set, the comments of a written case and the case reference; nothing else knows how a case file
/// looks. Other files in the same language (sweeps, tables of statements) have tables of their own, read by
/// case/document.h.
#ifndef SCREE_CASE_SCHEMA_H
#define SCREE_CASE_SCHEMA_H

#include "case/config.h"
#include "module/module.h"

/// The schema of a case file: the sections of the core (schema.c) and what the modules of the table add to them, put
/// together at the first call (schema_build.c). Safe on any thread; cannot fail.
const scree_section *scree_schema(void);

/// What the core declares, to be put together with what modules declare.
extern const scree_section scree_schema_core;

/// Whether all that is declared has found room in the schema.
bool scree_schema_is_whole(void);

const scree_key *scree_section_find(const scree_section *section, const char *name, size_t length);

/// The choice called `text`, or NULL.
const scree_choice *scree_choice_find(const scree_choice *choices, const char *text);

/// "a length", "a whole number", "yes or no": what a key takes, with its article.
const char *scree_key_noun(const scree_key *key);

/// Two values as a key of vectors or of pairs takes them, "[0, 0.5 mm]". Both texts live until the next call of a
/// thread.
const char *scree_key_pair_example(const scree_key *key);

/// What a key accepts, for messages and the manual: "more than 0 m, at most 1 m", "yes, no", names of choices. Empty
/// when there is no limit.
void scree_key_accepts(const scree_key *key, char *text, size_t size);

/// The same for the limits alone.
void scree_limits_text(const scree_key *key, char *text, size_t size);

#endif
