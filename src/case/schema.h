/// The schema of a case file: one table of keys a section. It drives parsing, checks, defaults, --set, the comments of
/// a written case and the case reference; nothing else knows how a case file looks. Other files in the same language
/// (sweeps, tables of statements) have tables of their own, read by case/document.h.
#ifndef SCREE_CASE_SCHEMA_H
#define SCREE_CASE_SCHEMA_H

#include "case/config.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum scree_key_type {
    SCREE_KEY_NUMBER,  ///< double, SI; NAN for `auto`
    SCREE_KEY_INTEGER, ///< int64_t
    SCREE_KEY_TEXT,    ///< char *, any text; limits are numbers of bytes
    SCREE_KEY_WORD,    ///< char *, a name: letters, digits, '_' and '-', a letter first; NULL for `auto`
    SCREE_KEY_FLAG,    ///< bool
    SCREE_KEY_CHOICE,  ///< int, one of `choices`
    SCREE_KEY_VECTOR,  ///< three doubles, one beside the other; the third may be left out in a case, and is zero then
    SCREE_KEY_PAIRS,   ///< array of pairs of doubles, and its count; the limits hold for each number
    SCREE_KEY_TENSOR, ///< nine doubles, 3 x 3 by rows, given as {component: value}: `choices` names the components that
                      ///< may be given; NAN for all others
    SCREE_KEY_SECTION, ///< struct, sections[0] describes it
    SCREE_KEY_LIST,    ///< array of structs, and its count, which the limits are for. With several sections, the first
                       ///< key of each is the choice that selects among them
    SCREE_KEY_VALUES,  ///< a list of single values or lists of them; the member is its const scree_node *
    SCREE_KEY_PATHS,   ///< section of key path -> value; its const scree_node * is stored if element_size is not 0
} scree_key_type;

/// End of a range, as text in the unit that a user would write. NULL: no limit.
typedef struct scree_limit {
    const char *text;
    bool open; ///< the limit itself is outside
} scree_limit;

typedef struct scree_choice {
    const char *name; ///< NULL ends a list of choices
    int value;
    const char *meaning;
} scree_choice;

struct scree_section;

typedef struct scree_key {
    const char *name;
    scree_key_type type;
    const char *unit;     ///< SI unit; NULL when not physical
    const char *standard; ///< default as text, "auto" where the value comes from others; NULL: required. Lists and
                          ///< vectors have "[]" and "[0, 0]", sections none
    scree_limit least, most;
    const scree_choice *choices;
    bool guard;          ///< only stops a run: no part of what makes a case (scree_case_checksum)
    const char *when;    ///< "key=value|value": used only then; key of the same section, or "section.key". Several such
                         ///< conditions are joined by '&'. NULL: always
    const char *meaning; ///< one line, ends with a full stop
    size_t offset;       ///< of the member in its section's struct
    size_t count_offset, element_size; ///< lists and pairs
    const struct scree_section *sections;
    size_t section_count;
} scree_key;

typedef struct scree_section {
    const char *name;
    const char *meaning;
    const scree_key *keys;
    size_t count;
} scree_section;

extern const scree_section scree_schema;

const scree_key *scree_section_find(const scree_section *section, const char *name, size_t length);

/// The choice called `text`, or NULL.
const scree_choice *scree_choice_find(const scree_choice *choices, const char *text);

/// "a length", "a whole number", "yes or no": what a key takes, with its article.
const char *scree_key_noun(const scree_key *key);

/// What a key accepts, for messages and the manual: "more than 0 m, at most 1 m", "yes, no", names of choices. Empty
/// when there is no limit.
void scree_key_accepts(const scree_key *key, char *text, size_t size);

/// The same for the limits alone.
void scree_limits_text(const scree_key *key, char *text, size_t size);

#endif
