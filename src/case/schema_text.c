/// Searching the schema table, and its words for people.
#include "base/units.h"
#include "case/schema.h"

#include <stdio.h>
#include <string.h>

const scree_key *scree_section_find(const scree_section *section, const char *name, size_t length)
{
    for (size_t i = 0; i < section->count; i++)
        if (strlen(section->keys[i].name) == length && strncmp(section->keys[i].name, name, length) == 0)
            return &section->keys[i];
    return NULL;
}

const scree_choice *scree_choice_find(const scree_choice *choices, const char *text)
{
    for (; choices->name; choices++)
        if (strcmp(choices->name, text) == 0) return choices;
    return NULL;
}

/// In the unit of the key; shares are told in %, if its limits are.
const char *scree_key_pair_example(const scree_key *key)
{
    static _Thread_local char text[64];
    const bool shares = key->least.text && strchr(key->least.text, '%'), plain = strcmp(key->unit, "1") == 0;
    if (shares) return "[1 %, 3 %]";
    if (plain) return "[0, 1]";
    (void)snprintf(text, sizeof text, "[0, %s]", scree_units_example(key->unit));
    return text;
}

static const char *pairs_noun(const scree_key *key)
{
    static _Thread_local char text[160];
    const bool shares = key->least.text && strchr(key->least.text, '%');
    (void)snprintf(text, sizeof text, "a list of pairs, e.g. [%s, %s], or the name of a .csv file of them",
                   scree_key_pair_example(key), shares ? "[10 %, 15 %]" : "...");
    return text;
}

static const char *vector_noun(const scree_key *key)
{
    static _Thread_local char text[100];
    (void)snprintf(text, sizeof text, "a list of two values, e.g. %s", scree_key_pair_example(key));
    return text;
}

const char *scree_key_noun(const scree_key *key)
{
    switch (key->type) {
    case SCREE_KEY_NUMBER:
        return scree_units_quantity(key->unit);
    case SCREE_KEY_INTEGER:
        return "a whole number";
    case SCREE_KEY_TEXT:
        return "text";
    case SCREE_KEY_WORD:
        return "a name of letters, digits, _ and -, a letter first";
    case SCREE_KEY_FLAG:
        return "yes or no";
    case SCREE_KEY_CHOICE:
        return "one of the choices";
    case SCREE_KEY_VECTOR:
        return vector_noun(key);
    case SCREE_KEY_PAIRS:
        return pairs_noun(key);
    case SCREE_KEY_SCHEDULE:
        return key->components > 1 ? "a list of two values, or a table of times and values, [[0 s, 0, 0], ...]"
                                   : "a value, or a table of times and values, e.g. [[0 s, 0], [1 s, 5]]";
    case SCREE_KEY_TENSOR:
        return "components with values, e.g. {xy: 5e-3 1/s}";
    case SCREE_KEY_SECTION:
        return "a section: keys with values, indented below";
    case SCREE_KEY_LIST:
        return "a list: each element starts with '- '";
    case SCREE_KEY_VALUES:
        return "a list of values, e.g. [0.2, 0.4]";
    case SCREE_KEY_PATHS:
        return "a section: key paths with values, indented below";
    case SCREE_KEY_MODULES:
        break; // never in a schema that is put together
    }
    return "";
}

void scree_limits_text(const scree_key *key, char *text, size_t size)
{
    const scree_limit *least = &key->least, *most = &key->most;
    const char *things = key->type == SCREE_KEY_LIST || key->type == SCREE_KEY_VALUES ? " elements"
                         : key->type == SCREE_KEY_TEXT || key->type == SCREE_KEY_WORD ? " characters"
                                                                                      : "";
    text[0] = 0;
    if (!least->text || !most->text) return;
    if (strcmp(least->text, most->text) == 0)
        (void)snprintf(text, size, "only %s", least->text);
    else if (!least->open && !most->open)
        (void)snprintf(text, size, "%s to %s%s", least->text, most->text, things);
    else
        (void)snprintf(text, size, "%s %s, %s %s", least->open ? "more than" : "at least", least->text,
                       most->open ? "less than" : "at most", most->text);
}

void scree_key_accepts(const scree_key *key, char *text, size_t size)
{
    scree_limits_text(key, text, size);
    if (key->type == SCREE_KEY_FLAG) (void)snprintf(text, size, "yes, no");
    const scree_choice *names = key->type == SCREE_KEY_CHOICE ? key->choices : NULL;
    for (size_t i = 0, length = 0; names && names[i].name && length < size; i++)
        length += (size_t)snprintf(text + length, size - length, "%s%s", i > 0 ? ", " : "", names[i].name);
    size_t length = strlen(text);
    // A choice names its auto itself.
    if (!names && key->standard && strcmp(key->standard, "auto") == 0)
        (void)snprintf(text + length, size - length, "%sauto", length > 0 ? "; or " : "");
}
