/// One value of a case: from its text to a member of the config, with the messages of everything that can be wrong.
#include "base/units.h"
#include "case/case.h"
#include "case/check.h"
#include "case/schedule.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { MOST_CHOICES = 32 };

/// The value that is being stored.
typedef struct value {
    scree_reader *reader;
    const scree_key *key;
    scree_place place;
    const char *path;
    const char *text; ///< of a scalar
} value;

static void reject(const value *v, const char *accepted, const char *message)
{
    scree_problem_add(v->reader, v->place, v->path, v->text, accepted, "%s", message);
}

static void reject_kind(const value *v, const scree_node *node)
{
    static const char *const kinds[] = {"a single value", "a list", "a section"};
    bool empty = node->kind == SCREE_NODE_SCALAR && !node->text[0];
    char limits[200];
    scree_limits_text(v->key, limits, sizeof limits);
    scree_problem_add(v->reader, v->place, v->path, v->text, limits, "%s %s; expected %s",
                      empty ? "nothing" : kinds[node->kind], "is given", scree_key_noun(v->key));
}

/// NAN where there is none, and where memory runs out.
static double limit_value(const value *v, const scree_limit *limit)
{
    double number;
    scree_error error;
    if (!limit->text) return NAN;
    if (!scree_units_parse(limit->text, v->key->unit ? v->key->unit : "1", &number, &error)) return number;
    if (!v->reader->failure.status) v->reader->failure = error;
    return NAN;
}

/// Notes a number outside the limits of its key.
static bool is_within(const value *v, double number)
{
    double least = limit_value(v, &v->key->least), most = limit_value(v, &v->key->most);
    bool small = number < least || (v->key->least.open && number == least);
    bool large = number > most || (v->key->most.open && number == most);
    if (!small && !large) return true;
    char limits[200];
    scree_limits_text(v->key, limits, sizeof limits);
    scree_problem_add(v->reader, v->place, v->path, v->text, limits, "'%s' is too %s", scree_show(v->text).text,
                      small ? "small" : "large");
    return false;
}

static double number_of(const value *v)
{
    double number;
    scree_error error;
    if (v->key->standard && strcmp(v->key->standard, "auto") == 0 && strcmp(v->text, "auto") == 0) return NAN;
    scree_status status = scree_units_parse(v->text, v->key->unit, &number, &error);
    if (status == SCREE_ERROR_IO) {
        if (!v->reader->failure.status) v->reader->failure = error;
        return NAN;
    }
    if (status) {
        char limits[200];
        scree_key_accepts(v->key, limits, sizeof limits);
        reject(v, limits, error.message);
        return NAN;
    }
    return is_within(v, number) ? number : NAN;
}

double scree_value_number(scree_reader *reader, const scree_key *key, scree_place place, const char *path,
                          const char *text)
{
    value v = {reader, key, place, path, text};
    return number_of(&v);
}

/// A whole number: digits, or a decimal form without a fraction ("1e5", "250.0").
static int64_t integer_of(const value *v)
{
    char limits[200], *end;
    scree_limits_text(v->key, limits, sizeof limits);
    double number = strtod(v->text, &end);
    bool decimal = v->text[0] && !*end && strspn(v->text, "0123456789+-.eE") == strlen(v->text);
    if (!decimal || (isfinite(number) && number != rint(number))) {
        scree_problem_add(v->reader, v->place, v->path, v->text, limits, "'%s' is not a whole number",
                          scree_show(v->text).text);
        return 0;
    }
    return is_within(v, number) ? (int64_t)number : 0;
}

static bool flag_of(const value *v)
{
    static const char *const names[] = {"no", "yes", "false", "true"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcasecmp(v->text, names[i]) == 0) return i % 2 == 1;
    scree_problem_add(v->reader, v->place, v->path, v->text, "yes, no", "'%s' is neither yes nor no",
                      scree_show(v->text).text);
    return false;
}

static int choice_of(const value *v)
{
    const scree_choice *found = scree_choice_find(v->key->choices, v->text);
    if (found) return found->value;
    const char *names[MOST_CHOICES];
    size_t count = 0;
    while (count < MOST_CHOICES && v->key->choices[count].name) {
        names[count] = v->key->choices[count].name;
        count++;
    }
    char accepted[256];
    scree_key_accepts(v->key, accepted, sizeof accepted);
    const char *nearest = scree_nearest(v->text, names, count);
    scree_problem_add(v->reader, v->place, v->path, v->text, accepted, "there is no %s '%s'%s%s%s", v->key->name,
                      scree_show(v->text).text, nearest ? "; did you mean '" : "", nearest ? nearest : "",
                      nearest ? "'?" : "");
    return SCREE_CHOICE_WRONG;
}

static char *text_of(const value *v)
{
    const char *text = v->text;
    bool word = v->key->type == SCREE_KEY_WORD;
    if (word && v->key->standard && strcmp(v->key->standard, "auto") == 0 && strcmp(text, "auto") == 0) return NULL;
    size_t length = strlen(text);
    char limits[200];
    scree_limits_text(v->key, limits, sizeof limits);
    if ((double)length < limit_value(v, &v->key->least) || (double)length > limit_value(v, &v->key->most)) {
        scree_problem_add(v->reader, v->place, v->path, text, limits, "%zu characters are too %s", length,
                          length == 0 ? "few" : "many");
        return NULL;
    }
    for (size_t i = 0; i < length; i++) {
        unsigned char c = (unsigned char)text[i];
        bool control = c < 0x20 || c == 0x7F;
        bool fits = word ? c < 0x80 && (isalpha(c) || (i > 0 && (isdigit(c) || c == '_' || c == '-'))) : !control;
        if (fits) continue;
        scree_problem_add(v->reader, v->place, v->path, text, scree_key_noun(v->key), "'%s' is not %s",
                          scree_show(text).text, word ? "a name" : "a single line of text");
        return NULL;
    }
    return (char *)text;
}

/// Two numbers of a list into `out`, or up to `most`.
static void store_numbers(const value *v, const scree_node *node, size_t most, double *out)
{
    out[0] = out[1] = NAN;
    if (node->kind != SCREE_NODE_LIST || node->count < 2 || node->count > most) {
        value whole = *v;
        char message[120];
        whole.place = node->place;
        (void)snprintf(message, sizeof message, "expected %s, e.g. %s",
                       v->key->type == SCREE_KEY_PAIRS ? "a pair of values" : "two or three values",
                       scree_key_pair_example(v->key));
        reject(&whole, NULL, message);
        return;
    }
    for (size_t i = 0; i < node->count; i++) {
        const scree_node *part = scree_node_at(node, i);
        value one = {v->reader, v->key, part->place, v->path, part->text};
        if (part->kind == SCREE_NODE_SCALAR && part->text[0])
            out[i] = number_of(&one);
        else
            reject(&one, NULL, "expected a number in the list");
    }
}

/// {component: value} into the places that the choices of the key name.
static void store_tensor(const value *v, const scree_node *node, double out[9])
{
    for (int i = 0; i < 9; i++) out[i] = NAN;
    if (node && node->kind != SCREE_NODE_MAPPING) {
        reject_kind(v, node);
        return;
    }
    for (const scree_node *part = node ? node->first : NULL; part; part = part->next) {
        value one = {v->reader, v->key, part->place, v->path, part->text};
        const scree_choice *component = scree_choice_find(v->key->choices, part->key);
        char names[64] = "";
        for (const scree_choice *c = v->key->choices; c->name; c++)
            (void)snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", names[0] ? ", " : "", c->name);
        if (!component)
            scree_problem_add(v->reader, part->key_place, v->path, part->key, names, "there is no component '%s'",
                              scree_show(part->key).text);
        else if (part->kind == SCREE_NODE_SCALAR && part->text[0])
            out[component->value] = number_of(&one);
        else
            reject(&one, NULL, "expected a number");
    }
}

static void store_pairs(const value *v, const scree_node *node, char *member, int64_t *count)
{
    if (node->kind != SCREE_NODE_LIST) {
        reject_kind(v, node);
        return;
    }
    double(*pairs)[2] = scree_arena_take(v->reader->arena, node->count * v->key->element_size);
    if (!pairs) {
        scree_reader_fail(v->reader, node->count * v->key->element_size);
        return;
    }
    size_t index = 0;
    for (const scree_node *pair = node->first; pair; pair = pair->next) store_numbers(v, pair, 2, pairs[index++]);
    memcpy(member, &pairs, sizeof pairs);
    *count = (int64_t)node->count;
}

static void store_scalar(const value *v, char *member)
{
    double number;
    int64_t integer;
    int choice;
    bool flag;
    char *text;
    switch (v->key->type) {
    case SCREE_KEY_NUMBER:
        memcpy(member, (number = number_of(v), &number), sizeof number);
        break;
    case SCREE_KEY_INTEGER:
        memcpy(member, (integer = integer_of(v), &integer), sizeof integer);
        break;
    case SCREE_KEY_CHOICE:
        memcpy(member, (choice = choice_of(v), &choice), sizeof choice);
        break;
    case SCREE_KEY_FLAG:
        memcpy(member, (flag = flag_of(v), &flag), sizeof flag);
        break;
    default:
        memcpy(member, (text = text_of(v), &text), sizeof text);
        break;
    }
}

/// A list of values, or the mapping of key paths, as it stands in the file.
static void store_node(const value *v, const scree_node *node, char *member)
{
    if (!node || (node->kind == SCREE_NODE_SCALAR && !node->text[0] && v->key->type == SCREE_KEY_PATHS)) return;
    bool list = v->key->type == SCREE_KEY_VALUES;
    if (node->kind != (list ? SCREE_NODE_LIST : SCREE_NODE_MAPPING)) {
        reject_kind(v, node);
        return;
    }
    double count = (double)node->count;
    char limits[200];
    scree_limits_text(v->key, limits, sizeof limits);
    if (count < limit_value(v, &v->key->least) || count > limit_value(v, &v->key->most))
        scree_problem_add(v->reader, v->place, v->path, NULL, limits, "%zu values are too %s", node->count,
                          node->count == 0 ? "few" : "many");
    for (const scree_node *each = node->first; each; each = each->next)
        if (each->kind == SCREE_NODE_MAPPING || (each->kind == SCREE_NODE_SCALAR && !each->text[0]))
            scree_problem_add(v->reader, each->place, v->path, NULL, NULL, "expected a value here");
    memcpy(member, &node, sizeof node);
}

static void store_member(scree_reader *reader, const scree_key *key, const scree_node *node, const char *path,
                         void *base)
{
    static const scree_place nowhere = {0};
    char *member = scree_key_member(key, base);
    value v = {reader, key, node ? node->place : nowhere, path, node ? node->text : key->standard};
    bool list = key->type == SCREE_KEY_VECTOR || key->type == SCREE_KEY_PAIRS;
    if (key->type == SCREE_KEY_SCHEDULE) {
        scree_schedule_store(reader, key, node, path, (scree_schedule *)(void *)member);
        return;
    }
    if (list && !node) return; // the defaults of lists are zeros, or empty
    if (key->type == SCREE_KEY_VALUES || key->type == SCREE_KEY_PATHS) {
        store_node(&v, node, member);
    } else if (key->type == SCREE_KEY_TENSOR) {
        double nine[9];
        store_tensor(&v, node, nine);
        memcpy(member, nine, sizeof nine);
    } else if (key->type == SCREE_KEY_VECTOR) {
        double vector[3] = {0};
        store_numbers(&v, node, 3, vector);
        memcpy(member, vector, sizeof vector);
    } else if (key->type == SCREE_KEY_PAIRS) {
        store_pairs(&v, node, member, (int64_t *)(void *)(scree_key_block(key, base) + key->count_offset));
    } else if (node && (node->kind != SCREE_NODE_SCALAR || (!node->text[0] && key->type != SCREE_KEY_TEXT))) {
        const int wrong = SCREE_CHOICE_WRONG;
        if (key->type == SCREE_KEY_CHOICE) memcpy(member, &wrong, sizeof wrong);
        reject_kind(&v, node);
    } else {
        store_scalar(&v, member);
    }
}

void scree_value_store(scree_reader *reader, const scree_key *key, const scree_node *node, const char *path, void *base)
{
    static const size_t sizes[] = {
        [SCREE_KEY_NUMBER] = sizeof(double), [SCREE_KEY_INTEGER] = sizeof(int64_t), [SCREE_KEY_TEXT] = sizeof(char *),
        [SCREE_KEY_WORD] = sizeof(char *),   [SCREE_KEY_FLAG] = sizeof(bool),       [SCREE_KEY_CHOICE] = sizeof(int),
    };
    store_member(reader, key, node, path, base);
    // Only single values are shared by modules.
    for (const scree_key *twin = key->twin; twin && key->type <= SCREE_KEY_CHOICE; twin = twin->twin)
        memcpy(scree_key_member(twin, base), scree_key_member(key, base), sizes[key->type]);
}
