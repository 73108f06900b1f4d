/// Keys that follow time: a value that stays, a table, a ramp or a harmonic.
///
///     5 mm/s                                                   a constant; of a vector [0, -9.81 m/s2]
///     [[0 s, 0 mm/s], [1 s, 5 mm/s]]                           a table; of a vector [[0 s, 0, -9.81 m/s2], ...]
///     gate.csv                                                 a table in a file (case/csv.h)
///     {from: 0 m/s, to: 1 m/s, begin: 0 s, end: 1 s, smooth: yes}      a ramp; not of a vector
///     {amplitude: 1 mm, frequency: 50 1/s, phase: 90 degrees, mean: 0} a harmonic; not of a vector
#include "case/schedule.h"

#include "case/csv.h"

#include <math.h>
#include <string.h>
#include <strings.h>

typedef struct reading {
    scree_reader *reader;
    const scree_key *key;
    const char *path;
    scree_schedule *out;
    size_t components;
} reading;

static const scree_key time_key = {
    .name = "time", .type = SCREE_KEY_NUMBER, .unit = "s", .least = {"-1e9 s", false}, .most = {"1e9 s", false}};

static void refuse(const reading *r, scree_place place, const char *value, const char *message)
{
    scree_problem_add(r->reader, place, r->path, value, NULL, "%s", message);
}

/// One number, of the quantity that `key` says; NAN where it is wrong.
static double read_number(const reading *r, const scree_key *key, const scree_node *node)
{
    if (node->kind == SCREE_NODE_SCALAR && node->text[0])
        return scree_value_number(r->reader, key, node->place, r->path, node->text);
    refuse(r, node->place, NULL, "expected a number here");
    return NAN;
}

// ---- constants ---------------------------------------------------------------------------------------------------

/// [x, y] or [x, y, z].
static void read_vector(const reading *r, const scree_node *list)
{
    if (list->count < 2 || list->count > r->components) {
        refuse(r, list->place, NULL, "expected two or three values, e.g. [0, -9.81 m/s2], or a table of them");
        return;
    }
    size_t k = 0;
    for (const scree_node *each = list->first; each; each = each->next)
        r->out[k++] = (scree_schedule){.value = read_number(r, r->key, each)};
}

// ---- tables ------------------------------------------------------------------------------------------------------

/// A row of a table: as many values as the first one has. False: it is wrong, which has been noted.
static bool read_row(const reading *r, const scree_node *node, size_t count, double *row)
{
    size_t k = 0;
    bool right = node->kind == SCREE_NODE_LIST && node->count == count;
    if (!right) {
        scree_problem_add(r->reader, node->place, r->path, node->text, NULL,
                          "expected a row of %zu values: a time, and the value%s then", count, count > 2 ? "s" : "");
        return false;
    }
    for (const scree_node *each = node->first; each; each = each->next, k++) {
        row[k] = read_number(r, k == 0 ? &time_key : r->key, each);
        right = right && !isnan(row[k]);
    }
    return right;
}

/// Values a row of a table has; 0: that is wrong, and noted.
static size_t columns_of(const reading *r, const scree_node *list)
{
    const scree_node *first = list->first;
    size_t least = r->components == 1 ? 2 : 3, most = r->components + 1;
    if (list->count > SCREE_TABLE_ROWS) {
        refuse(r, list->place, NULL, "a table has at most 2000 rows");
        return 0;
    }
    if (first->kind == SCREE_NODE_LIST && first->count >= least && first->count <= most) return first->count;
    refuse(r, first->place, first->text,
           r->components == 1 ? "expected rows of two values: a time, and the value then"
                              : "expected rows of a time and two or three values");
    return 0;
}

static void read_table(const reading *r, const scree_node *list)
{
    size_t columns = columns_of(r, list), count = 0, values = r->components;
    size_t stride = scree_schedule_stride(values), size = list->count * stride * sizeof(double);
    double *table = columns > 0 ? scree_arena_take(r->reader->arena, size) : NULL;
    if (columns > 0 && !table) scree_reader_fail(r->reader, size);
    bool right = table != NULL;
    for (const scree_node *node = list->first; node && table; node = node->next) {
        double *row = table + count * stride;
        // Of rows behind a wrong one only their own faults are told.
        bool whole = read_row(r, node, columns, row);
        if (whole && right && count > 0 && !(row[0] > row[-(ptrdiff_t)stride])) {
            refuse(r, node->first->place, node->first->text,
                   "time must increase from row to row: it goes back, or stands still, here");
            whole = false;
        }
        right = right && whole;
        if (right) count++;
    }
    if (!right) return;
    scree_schedule_integrate_table(table, count, values);
    for (size_t k = 0; k < values; k++)
        r->out[k] = (scree_schedule){
            .form = SCREE_SCHEDULE_TABLE, .row = table, .count = count, .columns = values, .column = k};
}

// ---- ramps and harmonics -----------------------------------------------------------------------------------------

enum { FROM, TO, BEGIN, END, SMOOTH, AMPLITUDE, FREQUENCY, PHASE, MEAN, WORDS };
static const char *const words[WORDS] = {"from",      "to",        "begin", "end", "smooth",
                                         "amplitude", "frequency", "phase", "mean"};
static const scree_key frequency_key = {
    .name = "frequency", .type = SCREE_KEY_NUMBER, .unit = "1/s", .least = {"0 1/s", true}, .most = {"1e9 1/s", false}};
static const scree_key phase_key = {
    .name = "phase", .type = SCREE_KEY_NUMBER, .unit = "rad", .least = {"-1e6", false}, .most = {"1e6", false}};

/// Which of the two the words are of; a problem where there is a word of none, or one that is needed is missing.
static bool find_words(const reading *r, const scree_node *mapping, const scree_node *given[WORDS])
{
    for (const scree_node *each = mapping->first; each; each = each->next) {
        int word = 0;
        while (word < WORDS && strcmp(words[word], each->key) != 0) word++;
        const char *nearest = scree_nearest(each->key, words, WORDS);
        if (word == WORDS) {
            scree_problem_add(r->reader, each->key_place, r->path, each->key,
                              "from, to, begin, end, smooth; or amplitude, frequency, phase, mean",
                              "there is no '%s' here%s%s%s", scree_show(each->key).text,
                              nearest ? "; did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "");
            return false;
        }
        given[word] = each;
    }
    bool harmonic = given[AMPLITUDE] || given[FREQUENCY] || given[PHASE] || given[MEAN];
    bool ramp = given[FROM] || given[TO] || given[BEGIN] || given[END] || given[SMOOTH];
    bool whole = harmonic ? given[AMPLITUDE] && given[FREQUENCY] : given[FROM] && given[TO] && given[END];
    if (harmonic != ramp && whole) return true;
    refuse(r, mapping->place, NULL,
           "expected a ramp, {from, to, begin, end, smooth}, or a harmonic, {amplitude, frequency, phase, mean}");
    return false;
}

static double number_or(const reading *r, const scree_key *key, const scree_node *node, double otherwise)
{
    return node ? read_number(r, key, node) : otherwise;
}

static void read_ramp(const reading *r, const scree_node *const given[WORDS])
{
    double from = read_number(r, r->key, given[FROM]), to = read_number(r, r->key, given[TO]);
    double begin = number_or(r, &time_key, given[BEGIN], 0), end = read_number(r, &time_key, given[END]);
    bool smooth = given[SMOOTH] && given[SMOOTH]->text && strcasecmp(given[SMOOTH]->text, "yes") == 0;
    if (given[SMOOTH] && !smooth && (!given[SMOOTH]->text || strcasecmp(given[SMOOTH]->text, "no") != 0))
        refuse(r, given[SMOOTH]->place, given[SMOOTH]->text, "`smooth` is yes or no");
    if (end <= begin) refuse(r, given[END]->place, given[END]->text, "a ramp must end after it begins");
    *r->out = (scree_schedule){.form = smooth ? SCREE_SCHEDULE_SMOOTH : SCREE_SCHEDULE_RAMP,
                               .value = from,
                               .change = to - from,
                               .begin = begin,
                               .duration = end - begin};
}

static void read_harmonic(const reading *r, const scree_node *const given[WORDS])
{
    *r->out = (scree_schedule){.form = SCREE_SCHEDULE_HARMONIC,
                               .value = number_or(r, r->key, given[MEAN], 0),
                               .change = read_number(r, r->key, given[AMPLITUDE]),
                               .frequency = read_number(r, &frequency_key, given[FREQUENCY]),
                               .phase = number_or(r, &phase_key, given[PHASE], 0)};
}

static void read_words(const reading *r, const scree_node *mapping)
{
    const scree_node *given[WORDS] = {NULL};
    if (r->components > 1)
        refuse(r, mapping->place, NULL, "expected two or three values, or a table of times with them");
    else if (find_words(r, mapping, given))
        (given[AMPLITUDE] ? read_harmonic : read_ramp)(r, given);
}

// ---- all ---------------------------------------------------------------------------------------------------------

void scree_schedule_store(scree_reader *reader, const scree_key *key, const scree_node *node, const char *path,
                          scree_schedule *out)
{
    static const scree_place nowhere = {0};
    reading r = {reader, key, path, out, key->components > 0 ? key->components : 1};
    // Of a vector `auto` leaves all components open.
    const char *text = node ? node->text : key->standard;
    bool open = r.components > 1 && text && strcmp(text, "auto") == 0 && strcmp(key->standard, "auto") == 0;
    for (size_t k = 0; k < r.components; k++) out[k] = (scree_schedule){.value = open ? NAN : 0};
    if (open) return;
    bool list = node && node->kind == SCREE_NODE_LIST;
    if (list && node->first && (r.components == 1 || node->first->kind == SCREE_NODE_LIST))
        read_table(&r, node);
    else if (list && r.components > 1)
        read_vector(&r, node);
    else if (node && node->kind == SCREE_NODE_MAPPING)
        read_words(&r, node);
    else if (node && (list || r.components > 1 || !node->text[0]))
        scree_problem_add(reader, node->place, path, node->text, NULL, "expected %s", scree_key_noun(key));
    else if (r.components == 1)
        out->value = scree_value_number(reader, key, node ? node->place : nowhere, path, text);
}
