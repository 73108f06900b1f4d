/// The resolved case as YAML: every key that is used, the user's text where there is one, else the default, and the
/// schema's line as comment. Reading it gives the same config, bit for bit, because each number is the same text. The
/// quick section is left out: it has been applied or not, and its paths need not fit what --set made of the case.
#include "base/handle.h"
#include "case/check.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { COMMENT_COLUMN = 40, WRAP_COLUMN = 100, INDENT = 16 };

/// The file, and the column of the line that is being written.
typedef struct writer {
    FILE *file;
    const scree_node *root;
    bool bare;  ///< without comments and guards: what makes the case
    bool wraps; ///< a table may go on in the next line
    int column;
} writer;

static void put(writer *w, const char *text)
{
    // Columns are characters, not bytes.
    for (const char *c = text; *c; c++) w->column += ((unsigned char)*c & 0xC0) != 0x80;
    (void)fputs(text, w->file);
}

static void end_line(writer *w, const char *comment)
{
    if (comment && !w->bare) {
        int gap = w->column < COMMENT_COLUMN ? COMMENT_COLUMN - w->column : 1;
        (void)fprintf(w->file, "%*s# %s", gap, "", comment);
    }
    (void)fputc('\n', w->file);
    w->column = 0;
}

/// Whether YAML takes `text` as it stands, within [ ] too.
static bool is_plain(const char *text)
{
    size_t length = strlen(text);
    if (length == 0 || text[length - 1] == ' ') return false;
    bool number = strchr("+-.", text[0]) && isdigit((unsigned char)text[1]);
    if (!isalnum((unsigned char)text[0]) && !number) return false;
    for (const char *c = text; *c; c++)
        if (!isalnum((unsigned char)*c) && (unsigned char)*c < 0x80 && !strchr(" _%/.*+-^()", *c)) return false;
    return true;
}

static void put_text(writer *w, const char *text)
{
    if (is_plain(text)) {
        put(w, text);
        return;
    }
    put(w, "\"");
    for (const char *c = text; *c; c++) {
        char one[3] = {*c, 0, 0};
        if (*c == '"' || *c == '\\') {
            one[0] = '\\';
            one[1] = *c;
        }
        put(w, one);
    }
    put(w, "\"");
}

/// A value in one line. Its depth is that of the file, which is limited.
static void put_value(writer *w, const scree_node *node)
{
    if (node->kind == SCREE_NODE_SCALAR) {
        put_text(w, node->text);
        return;
    }
    put(w, node->kind == SCREE_NODE_LIST ? "[" : "{");
    for (const scree_node *child = node->first; child; child = child->next) {
        if (node->kind == SCREE_NODE_MAPPING) {
            put_text(w, child->key);
            put(w, ": ");
        }
        put_value(w, child);
        if (!child->next) continue;
        // Rows of a table go on in the next line.
        bool wraps = w->wraps && child->kind == SCREE_NODE_LIST && w->column > WRAP_COLUMN;
        put(w, wraps ? "," : ", ");
        if (!wraps) continue;
        (void)fprintf(w->file, "\n%*s", INDENT, "");
        w->column = INDENT;
    }
    put(w, node->kind == SCREE_NODE_LIST ? "]" : "}");
}

void scree_node_write(FILE *file, const scree_node *node)
{
    writer w = {.file = file};
    // The text of a single value is all of it: quotes are needed within lists only.
    if (node->kind == SCREE_NODE_SCALAR)
        put(&w, node->text);
    else
        put_value(&w, node);
}

static void write_element(writer *w, const scree_section *section, const scree_node *mapping, int depth,
                          bool explained);

/// The elements of a list, indented by `depth`; the first one explains the keys where all have the same.
static void write_primitives(writer *w, const scree_key *list, const scree_node *node, int depth)
{
    for (const scree_node *element = node->first; element; element = element->next)
        write_element(w, scree_element_section(list, element), element, depth,
                      list->section_count > 1 || depth == 0 || element == node->first);
}

/// Keys of a section that hold values. `first`: what stands before the first key, `depth`: spaces before the others.
static void write_values(writer *w, const scree_section *section, const scree_node *mapping, const char *first,
                         int depth, bool explained)
{
    for (size_t i = 0; i < section->count; i++) {
        const scree_key *key = &section->keys[i];
        bool value = key->type != SCREE_KEY_SECTION && key->type != SCREE_KEY_LIST && key->type != SCREE_KEY_PATHS;
        if (w->bare && key->guard) continue;
        if (!value || scree_key_usage(w->root, section, mapping, key).use != SCREE_USED) continue;
        const scree_node *node = scree_node_find(mapping, key->name);
        for (int k = 0; !first && k < depth; k++) put(w, " ");
        if (first) put(w, first);
        first = NULL;
        put(w, key->name);
        put(w, ": ");
        w->wraps = key->type == SCREE_KEY_SCHEDULE;
        if (node)
            put_value(w, node);
        else if (key->standard[0] == '[' || key->type == SCREE_KEY_TENSOR)
            put(w, key->standard);
        else
            put_text(w, key->standard);
        end_line(w, explained ? key->meaning : NULL);
    }
}

/// The lists of a section, behind its values.
static void write_lists(writer *w, const scree_section *section, const scree_node *mapping, int depth)
{
    for (size_t i = 0; i < section->count; i++) {
        const scree_key *key = &section->keys[i];
        const scree_node *node = scree_node_find(mapping, key->name);
        bool used = key->type == SCREE_KEY_LIST && scree_key_usage(w->root, section, mapping, key).use == SCREE_USED;
        if (!used || !node || !node->first) continue;
        for (int k = 0; k < depth; k++) put(w, " ");
        put(w, key->name);
        put(w, ":");
        end_line(w, key->meaning);
        write_primitives(w, key, node, depth);
    }
}

/// An element of a list, with the lists in it after its values.
static void write_element(writer *w, const scree_section *section, const scree_node *mapping, int depth, bool explained)
{
    char first[32];
    (void)snprintf(first, sizeof first, "%*s- ", depth + 2, "");
    write_values(w, section, mapping, first, depth + 4, explained);
    write_lists(w, section, mapping, depth + 4);
}

static void write_key(writer *w, const scree_key *key)
{
    if (key->type != SCREE_KEY_SECTION && key->type != SCREE_KEY_LIST) return;
    const scree_node *node = scree_node_find(w->root, key->name);
    if (key->type == SCREE_KEY_LIST && (!node || !node->first)) return;
    end_line(w, NULL);
    put(w, key->name);
    put(w, ":");
    end_line(w, key->meaning);
    if (key->type == SCREE_KEY_SECTION) {
        write_values(w, key->sections, node, NULL, 2, true);
        write_lists(w, key->sections, node, 2);
    } else
        write_primitives(w, key, node, 0);
}

static scree_status write_case(const scree_case *c, bool bare, FILE *file, scree_error *error)
{
    writer w = {.file = file, .root = scree_case_root(c), .bare = bare};
    if (!bare) (void)fprintf(file, "# The case with every value that it uses, written by Scree %s.\n", SCREE_VERSION);
    write_values(&w, scree_schema(), w.root, NULL, 0, true);
    for (size_t i = 0; i < scree_schema()->count; i++) write_key(&w, &scree_schema()->keys[i]);
    if (fflush(file) != 0 || ferror(file))
        return scree_error_set_errno(error, SCREE_ERROR_IO, "the case cannot be written");
    return SCREE_OK;
}

scree_status scree_case_write(const scree_case *c, FILE *file, scree_error *error)
{
    scree_handle_check(c, "a case");
    return write_case(c, false, file, error);
}

scree_status scree_case_checksum(const scree_case *c, uint64_t *checksum, scree_error *error)
{
    char *text = NULL;
    size_t length = 0;
    FILE *memory = open_memstream(&text, &length);
    if (!memory) return scree_error_set_memory(error, 4096);
    scree_status status = write_case(c, true, memory, error);
    if (fclose(memory) != 0 && !status) status = scree_error_set_memory(error, 4096);
    *checksum = UINT64_C(0xcbf29ce484222325);
    for (size_t k = 0; !status && k < length; k++)
        *checksum = (*checksum ^ (unsigned char)text[k]) * UINT64_C(0x100000001b3);
    free(text);
    return status;
}
