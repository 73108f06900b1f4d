/// Tables in files become lists in the tree of a case: see csv.h.
#include "case/csv.h"

#include "base/memory.h"
#include "case/schema.h"
#include "case/unknown_key.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum { LARGEST_FILE = 1 << 20, MOST_CELLS = 16, LONGEST_PATH = 4096 };

/// A file that is being read.
typedef struct table {
    scree_reader *reader;
    const char *path; ///< of the key
    scree_place place;
    scree_node *list;              ///< of the rows
    const char *units[MOST_CELLS]; ///< of the columns; NULL: SI
    const char *names[MOST_CELLS]; ///< of the columns
    const scree_section *elements; ///< rows are elements of a list with these keys, or lists (NULL)
    const char *const *columns;    ///< what the two columns of pairs are called; NULL: whatever the file says
    bool timed;                    ///< rows are a time and the values then
    size_t first;                  ///< the cell that comes first in a row of the list, where the names say so
    bool begun;                    ///< the names of the columns, or a first row, have been read
} table;

bool scree_csv_is_named(const scree_node *node)
{
    if (!node || node->kind != SCREE_NODE_SCALAR) return false;
    size_t length = strlen(node->text);
    return length > 4 && strcasecmp(node->text + length - 4, ".csv") == 0;
}

// ---- cells and rows ----------------------------------------------------------------------------------------------

static bool begins_with_number(const char *text)
{
    return strspn(text, "+-.0123456789") > 0;
}

/// Cuts white space off both ends of what lies between `begin` and `end`.
static char *trim(char *begin, char *end)
{
    while (begin < end && strchr(" \t\r", *begin)) begin++;
    while (end > begin && strchr(" \t\r", end[-1])) end--;
    *end = 0;
    return begin;
}

static scree_node *append(table *t, scree_node *parent, const scree_node *child)
{
    scree_node *node = scree_arena_take(t->reader->arena, sizeof *node);
    if (!node) {
        scree_reader_fail(t->reader, sizeof *node);
        return NULL;
    }
    *node = *child;
    scree_node_append(parent, node);
    return node;
}

/// What stands in [ ] in the name of a column; NULL: nothing.
static const char *unit_in(char *name)
{
    char *open = strchr(name, '['), *close = open ? strchr(open, ']') : NULL;
    return close ? trim(open + 1, close) : NULL;
}

/// A plain number has the unit of its column.
static const char *with_unit(table *t, const char *cell, const char *unit)
{
    char text[200];
    if (!unit || !cell[0] || strlen(cell) + strlen(unit) + 2 > sizeof text) return cell;
    if (strspn(cell, "+-.0123456789eE") < strlen(cell)) return cell;
    int length = snprintf(text, sizeof text, "%s %s", cell, unit);
    const char *copy = scree_arena_copy(t->reader->arena, text, (size_t)length);
    if (!copy) scree_reader_fail(t->reader, sizeof text);
    return copy;
}

static bool refuse(const table *t, const char *message)
{
    scree_problem_add(t->reader, t->place, t->path, NULL, NULL, "%s", message);
    return false;
}

/// The k-th cell becomes the first, the others stay in their order.
static void move_to_front(scree_node *row, size_t k)
{
    scree_node *before = row->first;
    for (; k > 1; k--) before = before->next;
    scree_node *cell = before->next;
    before->next = cell->next;
    if (row->last == cell) row->last = before;
    cell->next = row->first;
    row->first = cell;
}

static bool add_row(table *t, char *const cells[], const size_t columns[], size_t count)
{
    if (t->list->count == SCREE_TABLE_ROWS) return refuse(t, "a table has at most 2000 rows");
    const scree_node_kind kind = t->elements ? SCREE_NODE_MAPPING : SCREE_NODE_LIST;
    scree_node *row = append(t, t->list, &(scree_node){.kind = kind, .place = t->place});
    for (size_t k = 0; row && k < count; k++) {
        if (t->elements && !t->names[k]) return refuse(t, "this row has more values than the first has names");
        if (t->elements && !cells[k][0]) continue;
        scree_node cell = {.place = t->place, .text = with_unit(t, cells[k], t->units[k]), .key = t->names[k]};
        cell.place.column = (int)columns[k];
        cell.key_place = cell.place;
        if (!cell.text || !append(t, row, &cell)) return false;
    }
    if (row && t->first > 0 && t->first < row->count) move_to_front(row, t->first);
    return row != NULL;
}

/// What a column is called, without its unit. False: elements have no such key, or memory ran out.
static bool read_name(table *t, char *cell, size_t k, size_t column)
{
    t->units[k] = unit_in(cell);
    char *name = trim(cell, cell + strcspn(cell, "["));
    t->names[k] = scree_arena_copy(t->reader->arena, name, strlen(name));
    if (!t->names[k]) scree_reader_fail(t->reader, strlen(name));
    if (!t->names[k] || !t->elements || scree_section_find(t->elements, name, strlen(name))) return t->names[k] != NULL;
    scree_place place = t->place;
    place.column = (int)column;
    char path[200];
    (void)snprintf(path, sizeof path, "%s.%s", t->path, name);
    (void)scree_unknown_key_refuse(t->reader, place, path, name, NULL, t->elements);
    return false;
}

/// Which of the names that pairs ask for this is; 2: none.
static size_t which_of_pair(const table *t, const char *name)
{
    size_t which = 0;
    while (which < 2 && strcmp(name, t->columns[which]) != 0) which++;
    return which;
}

/// The names of the columns of pairs: both that are asked for, once each, in any order. A wrong one may have meant the
/// one that is missing. False: this has been noted.
static bool match_pair(table *t, const size_t columns[], size_t count)
{
    size_t said[3] = {0};
    for (size_t k = 0; k < count; k++) said[which_of_pair(t, t->names[k])]++;
    const char *missing = said[0] == 0 ? t->columns[0] : said[1] == 0 ? t->columns[1] : NULL;
    scree_place place = t->place;
    for (size_t k = 0, before[3] = {0}; k < count; k++) {
        const size_t which = which_of_pair(t, t->names[k]);
        if (which < 2 && before[which]++ == 0) continue;
        place.column = (int)columns[k];
        scree_problem_add(t->reader, place, t->path, NULL, NULL,
                          "%s column '%s'%s%s%s; expected %s and %s, in any order", which < 2 ? "a second" : "unknown",
                          scree_show(t->names[k]).text, missing ? "; did you mean '" : "", missing ? missing : "",
                          missing ? "'?" : "", t->columns[0], t->columns[1]);
        return false;
    }
    if (missing)
        scree_problem_add(t->reader, place, t->path, NULL, NULL,
                          "the column '%s' is missing; expected %s and %s, in any order", missing, t->columns[0],
                          t->columns[1]);
    t->first = count == 2 && which_of_pair(t, t->names[0]) == 1;
    return !missing;
}

/// The column of times, and whether x, y and z come in this order. False: something is wrong, which has been noted.
static bool find_time(table *t, size_t count)
{
    size_t found = 0;
    for (size_t k = 0; k < count; k++)
        if (strcmp(t->names[k], "time") == 0 && found++ == 0) t->first = k;
    if (found == 0)
        return refuse(t, "no column is named 'time'; expected 'time [s]' and the values then, in any order");
    if (found > 1) return refuse(t, "two columns are named 'time'");
    for (size_t k = 0, component = 0; k < count; k++) {
        const char *name = t->names[k];
        const bool axis = strlen(name) == 1 && name[0] >= 'x' && name[0] <= 'z';
        if (axis && (size_t)(name[0] - 'x') != component) return refuse(t, "x, y and z have to come in this order");
        component += k != t->first;
    }
    return true;
}

/// A line without its end, which may be changed.
static bool read_line(table *t, char *line)
{
    char *cells[MOST_CELLS], *end = line + strcspn(line, "#"), *at = line;
    size_t columns[MOST_CELLS], count = 0;
    *end = 0;
    if (!*trim(line, end)) return true;
    for (bool more = true; more; count++) {
        if (count == MOST_CELLS) return refuse(t, "a row of a table has at most 16 values");
        char *stop = at + strcspn(at, ",;");
        more = *stop != 0;
        cells[count] = trim(at, stop);
        columns[count] = (size_t)(cells[count] - line) + 1;
        at = stop + 1;
    }
    const bool names = !t->begun && !begins_with_number(cells[0]);
    if (t->elements && !t->begun && !names) return refuse(t, "the first row does not name the columns");
    t->begun = true;
    for (size_t k = 0; names && k < count; k++)
        if (!read_name(t, cells[k], k, columns[k])) return false;
    if (names && t->columns && !match_pair(t, columns, count)) return false;
    if (names && t->timed && !find_time(t, count)) return false;
    return names || add_row(t, cells, columns, count);
}

// ---- the file ----------------------------------------------------------------------------------------------------

/// The bytes of the file in the arena, with a NUL behind them; NULL with *reason, or when memory ran out (noted).
static char *read_bytes(scree_reader *reader, const char *name, size_t *length, const char **reason)
{
    struct stat about;
    *reason = strerror(ENOENT);
    FILE *file = NULL;
    if (stat(name, &about) != 0)
        *reason = strerror(errno);
    else if (!S_ISREG(about.st_mode))
        *reason = "it is not a file";
    else if (about.st_size > LARGEST_FILE)
        *reason = "it is larger than 1 MiB";
    else if (!(file = fopen(name, "rbe")))
        *reason = strerror(errno);
    if (!file) return NULL;
    char *bytes = scree_arena_take(reader->arena, LARGEST_FILE + 1);
    if (!bytes) scree_reader_fail(reader, LARGEST_FILE);
    *length = bytes ? fread(bytes, 1, LARGEST_FILE, file) : 0;
    bool whole = !ferror(file);
    (void)fclose(file);
    *reason = whole ? NULL : "it cannot be read to its end";
    return whole ? bytes : NULL;
}

bool scree_csv_expand(scree_reader *reader, scree_node *node, const char *path, const scree_key *key)
{
    char name[LONGEST_PATH];
    const char *reason;
    scree_file_beside(reader, node->text, name, sizeof name);
    size_t length = 0;
    char *bytes = read_bytes(reader, name, &length, &reason);
    if (!bytes && reason)
        scree_problem_add(reader, node->place, path, node->text, NULL, "the file of this table cannot be used: %s",
                          reason);
    if (!bytes) return false;
    scree_node list = {.kind = SCREE_NODE_LIST, .place = node->place, .key = node->key, .key_place = node->key_place};
    table t = {.reader = reader, .path = path, .place = node->place, .list = &list};
    t.elements = key->type == SCREE_KEY_LIST ? key->sections : NULL;
    t.columns = key->columns[0] ? key->columns : NULL;
    t.timed = key->type == SCREE_KEY_SCHEDULE;
    t.place.source = scree_arena_copy(reader->arena, name, strlen(name));
    t.place.line = 0;
    if (!t.place.source) scree_reader_fail(reader, strlen(name));
    if (memchr(bytes, 0, length)) return refuse(&t, "this is not a text file: it has a NUL character");
    for (char *line = bytes, *next; line && !reader->failure.status; line = next) {
        next = strchr(line, '\n');
        if (next) *next++ = 0;
        t.place.line++;
        t.place.column = 1;
        if (!read_line(&t, line)) return false;
    }
    list.next = node->next;
    *node = list;
    return !reader->failure.status;
}
