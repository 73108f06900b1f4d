/// Declarations of keys: what a case file may say, in which unit and range, and what it means. Parsing, checks,
/// defaults,
/// --set, the comments of a written case and the case reference follow from them. The rows of a table are written with
/// the macros of module/key_rows.h.
#ifndef SCREE_MODULE_KEY_H
#define SCREE_MODULE_KEY_H

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

struct scree_module;

typedef enum scree_key_type {
    SCREE_KEY_NUMBER,   ///< double, SI; NAN for `auto`
    SCREE_KEY_INTEGER,  ///< int64_t
    SCREE_KEY_TEXT,     ///< char *, any text; limits are numbers of bytes
    SCREE_KEY_WORD,     ///< char *, a name: letters, digits, '_' and '-', a letter first; NULL for `auto`
    SCREE_KEY_FLAG,     ///< bool
    SCREE_KEY_CHOICE,   ///< int, one of `choices`: of those that select a module its slot
    SCREE_KEY_VECTOR,   ///< three doubles, one beside the other; the third may be left out in a case, and is zero then
    SCREE_KEY_PAIRS,    ///< array of pairs of doubles, and its count, here or in a .csv file; the limits hold for each
                        ///< number
    SCREE_KEY_SCHEDULE, ///< scree_schedule (base/schedule.h), or `components` of them side by side: a value that stays,
                        ///< a table of times and values, here or in a .csv file, a ramp, a harmonic; the limits hold
                        ///< for each value; the constant NAN for `auto`
    SCREE_KEY_TENSOR, ///< nine doubles, 3 x 3 by rows, given as {component: value}: `choices` names the components that
                      ///< may be given; NAN for all others
    SCREE_KEY_SECTION, ///< struct, sections[0] describes it
    SCREE_KEY_LIST,    ///< array of structs, and its count, which the limits are for. With several sections, the first
                       ///< key of each is the choice that selects among them
    SCREE_KEY_VALUES,  ///< a list of single values or lists of them; the member is its const scree_node *
    SCREE_KEY_PATHS,   ///< section of key path -> value; its const scree_node * is stored if element_size is not 0
    SCREE_KEY_MODULES, ///< no key: here stand those that modules add to the section; without it they stand at its end
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

/// Components of a velocity gradient: ij is the derivative of velocity i by coordinate j; the value is its place in a
/// 3 x 3 tensor by rows.
extern const scree_choice scree_gradient_components[];

/// Values of choices that select a module, where they select none.
enum {
    SCREE_CHOICE_WRONG = -1, ///< there is no such choice, and a problem has been noted
    SCREE_CHOICE_AUTO = -2,
};

struct scree_section;

typedef struct scree_key {
    const char *name;
    scree_key_type type;
    const char *unit;     ///< SI unit; NULL when not physical
    const char *standard; ///< default as text, "auto" where the value comes from others; NULL: required. Lists and
                          ///< vectors have "[]" and "[0, 0]", sections none
    scree_limit least, most;
    const scree_choice *choices; ///< those of modules come behind
    bool guard;                  ///< only stops a run: no part of what makes a case (scree_case_checksum)
    const char *when; ///< "key=value|value": used only then; key of the same section, or "section.key". Several such
                      ///< conditions are joined by '&'. NULL: always
    /// A trait of modules. With `chooser`, a choice of the same section, or "section.key": the key is used only with
    /// those modules that have the trait. Without, in a list: only elements whose module has it have the key. NULL:
    /// all.
    bool (*fits)(const struct scree_module *module);
    const char *chooser;
    const char *meaning;               ///< one line, ends with a full stop
    size_t offset;                     ///< of the member in its section's struct, or in that of its module
    size_t count_offset, element_size; ///< lists and pairs
    const char *columns[2]; ///< pairs: what the columns of a .csv file are called, if it says names; NULL: any
    size_t components;      ///< schedules: 3 of a vector; 0 and 1: of one number
    const void *initial;    ///< lists: what an element is before its keys are read; NULL: zero
    const struct scree_section *sections;
    size_t section_count;

    // ---- set when the schema is put together (case/schema_build.c) ----
    bool own;          ///< the offsets are of the block that the section's struct points to: the key is a module's
    size_t own_offset; ///< of that pointer
    const struct scree_key *twin; ///< the same key of another module, which is given the same value
} scree_key;

typedef struct scree_section {
    const char *name;
    const char *meaning;
    const scree_key *keys;
    size_t count;
    bool open;         ///< modules can add keys: the struct has a pointer `own` to a block for theirs
    size_t own_offset; ///< of that pointer
    size_t own_size;   ///< bytes of the block; 0: none
} scree_section;

/// Keys that a module adds to a section, and the struct of its own that they fill.
typedef struct scree_keys {
    const char *section; ///< path: "integrator", "stages.NAME"; NULL: the section that the module's own choice selects
    const scree_key *keys;
    size_t count;
    size_t size;       ///< bytes of the struct
    const char *after; ///< they stand behind this key of the section; NULL: where its modules' keys stand
} scree_keys;

/// A choice that a module is.
typedef struct scree_choice_of {
    const char *key;     ///< path of the key: "integrator.scheme"; of one that all elements of a list have
                         ///< "stages.boundary"; of a list whose elements it is "stages". NULL ends
    const char *meaning; ///< NULL: that of the module
} scree_choice_of;

/// The block that the offsets of a key are of. base: the struct of its section.
static inline char *scree_key_block(const scree_key *key, const void *base)
{
    char *block = (char *)base;
    if (key->own) memcpy(&block, block + key->own_offset, sizeof block);
    return block;
}

/// The member that a key fills.
static inline char *scree_key_member(const scree_key *key, const void *base)
{
    return scree_key_block(key, base) + key->offset;
}

#endif
