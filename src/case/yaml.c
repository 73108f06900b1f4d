/// YAML to a tree, from libfyaml's events (its own documents would resolve aliases and recurse). libfyaml's messages
/// are collected, never printed; the common ones are put into plainer words.
#include "case/yaml.h"

#include <libfyaml.h>

#include <errno.h>
#include <stdio.h>
#include <string.h>

enum { DEEPEST = 16, MOST_VALUES = 30000, LONGEST_PATH = 160 };

typedef struct builder {
    scree_reader *reader;
    scree_place base;
    scree_node *open[DEEPEST]; ///< lists and mappings that are not closed yet, outermost first
    size_t depth;
    const char *key; ///< of the value that comes next in a mapping, or NULL
    scree_place key_place;
    scree_node *root;
    size_t values, documents;
} builder;

/// Plainer words for libfyaml's messages.
static const struct {
    const char *theirs, *ours;
} words[] = {
    {"invalid multiline plain key", "a ':' is missing here, or the next line is indented wrongly"},
    {"nested block mapping on the same line",
     "two ':' in one line; put the text into quotes if the second belongs to it"},
    {"without a closing bracket", "a '[' is never closed with ']'"},
    {"without a closing brace", "a '{' is never closed with '}'"},
    {"without closing quote", "a quotation mark is never closed"},
    {"did not find expected '-'", "indentation does not fit the lines above"},
    {"invalid scalar at the end of block", "indentation does not fit the lines above"},
    {"wrongly indented", "indentation does not fit the lines above"},
    {"invalid indentation", "indentation does not fit the lines above"},
    {"cannot start with", "a value cannot begin with this character; put it into quotes"},
};

static const char *in_plain_words(const char *message)
{
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strstr(message, words[i].theirs)) return words[i].ours;
    return message;
}

static void ignore_output(struct fy_diag *diag, void *user, const char *text, size_t length)
{
    (void)diag;
    (void)user;
    (void)text;
    (void)length;
}

static scree_place place_at(const builder *b, const struct fy_mark *mark)
{
    scree_place place = b->base;
    if (place.line == 0) return place;
    place.line = mark ? mark->line + 1 : b->key_place.line;
    place.column = mark ? mark->column + 1 : b->key_place.column;
    return place;
}

/// Key path of the value that comes next.
static void path_here(const builder *b, char path[LONGEST_PATH])
{
    size_t length = 0;
    path[0] = 0;
    for (size_t i = 0; i < b->depth && length < LONGEST_PATH; i++) {
        bool last = i + 1 == b->depth;
        const char *dot = i > 0 ? "." : "";
        const char *key = last ? b->key : b->open[i + 1]->key;
        int written;
        if (b->open[i]->kind == SCREE_NODE_LIST)
            written = snprintf(path + length, LONGEST_PATH - length, "%s%zu", dot, b->open[i]->count - !last);
        else
            written = snprintf(path + length, LONGEST_PATH - length, "%s%s", dot, key ? key : "");
        length += (size_t)written;
    }
}

static bool refuse(builder *b, const struct fy_mark *mark, const char *message)
{
    char path[LONGEST_PATH];
    path_here(b, path);
    scree_problem_add(b->reader, place_at(b, mark), path, NULL, NULL, "%s", message);
    return false;
}

/// Puts a new node under the innermost open one, or makes it the root.
static void place_node(builder *b, scree_node *node)
{
    if (b->depth == 0) {
        b->root = node;
        return;
    }
    scree_node *parent = b->open[b->depth - 1];
    node->key = b->key;
    node->key_place = b->key_place;
    const scree_node *first = b->key ? scree_node_find(parent, b->key) : NULL;
    if (first) {
        char path[LONGEST_PATH];
        path_here(b, path);
        scree_problem_add(b->reader, b->key_place, path, NULL, NULL, "given twice; the first is in line %d",
                          first->key_place.line);
    } else {
        scree_node_append(parent, node);
    }
    b->key = NULL;
}

/// Text of a scalar in the arena, or NULL after a problem.
static const char *scalar_text(builder *b, struct fy_event *event, const struct fy_mark *mark)
{
    size_t length = 0;
    const char *text = fy_token_get_text(event->scalar.value, &length);
    if (text && memchr(text, 0, length)) {
        refuse(b, mark, "a text cannot hold a NUL character");
        return NULL;
    }
    char *copy = scree_arena_copy(b->reader->arena, text ? text : "", text ? length : 0);
    if (!copy) scree_reader_fail(b->reader, length);
    return copy;
}

static bool build_value(builder *b, struct fy_event *event, const struct fy_mark *mark)
{
    bool scalar = event->type == FYET_SCALAR;
    bool wants_key = b->depth > 0 && b->open[b->depth - 1]->kind == SCREE_NODE_MAPPING && !b->key;
    if (++b->values > MOST_VALUES) return refuse(b, mark, "more than 30000 keys and values: not a case file");
    if (wants_key && !scalar) return refuse(b, mark, "a key must be plain text");
    if (!scalar && b->depth == DEEPEST) return refuse(b, mark, "nested more than 16 levels deep: not a case file");
    const char *text = scalar ? scalar_text(b, event, mark) : NULL;
    if (scalar && !text) return false;
    if (wants_key) {
        b->key_place = place_at(b, mark);
        b->key = text;
        return true;
    }
    scree_node *node = scree_arena_take(b->reader->arena, sizeof *node);
    if (!node) {
        scree_reader_fail(b->reader, sizeof *node);
        return false;
    }
    node->kind = scalar ? SCREE_NODE_SCALAR : event->type == FYET_SEQUENCE_START ? SCREE_NODE_LIST : SCREE_NODE_MAPPING;
    node->text = text;
    node->place = place_at(b, mark);
    place_node(b, node);
    if (!scalar) b->open[b->depth++] = node;
    return true;
}

/// One event. False: stop, a problem has been noted.
static bool build(builder *b, struct fy_event *event)
{
    const struct fy_mark *mark = fy_event_start_mark(event);
    switch (event->type) {
    case FYET_DOCUMENT_START:
        return ++b->documents == 1 || refuse(b, mark, "a case file holds one document only");
    case FYET_ALIAS:
        return refuse(b, mark, "aliases ('*name') are not part of the case language");
    case FYET_SCALAR:
        if (event->scalar.anchor) return refuse(b, mark, "anchors ('&name') are not part of the case language");
        if (event->scalar.tag) return refuse(b, mark, "tags ('!name') are not part of the case language");
        return build_value(b, event, mark);
    case FYET_SEQUENCE_START:
        if (event->sequence_start.anchor) return refuse(b, mark, "anchors ('&name') are not part of the case language");
        if (event->sequence_start.tag) return refuse(b, mark, "tags ('!name') are not part of the case language");
        return build_value(b, event, mark);
    case FYET_MAPPING_START:
        if (event->mapping_start.anchor) return refuse(b, mark, "anchors ('&name') are not part of the case language");
        if (event->mapping_start.tag) return refuse(b, mark, "tags ('!name') are not part of the case language");
        return build_value(b, event, mark);
    case FYET_SEQUENCE_END:
    case FYET_MAPPING_END:
        b->depth--;
        return true;
    default:
        return true;
    }
}

/// The first line at or before `line` that is indented with a tab, or 0: the usual cause of odd syntax errors.
static int line_with_tab(const char *text, size_t length, int line)
{
    const char *end = text + length;
    int found = 0;
    for (int n = 1; n <= line && text < end && !found; n++) {
        const char *c = text;
        while (c < end && *c == ' ') c++;
        if (c < end && *c == '\t') found = n;
        const char *line_end = memchr(text, '\n', (size_t)(end - text));
        text = line_end ? line_end + 1 : end;
    }
    return found;
}

static void note_syntax_error(builder *b, struct fy_diag *diag, const char *text, size_t length)
{
    void *iterator = NULL;
    const struct fy_diag_error *error = fy_diag_errors_iterate(diag, &iterator);
    scree_place place = b->base;
    if (place.line > 0 && error) {
        int tab = line_with_tab(text, length, error->line + 1);
        place.line = tab > 0 ? tab : error->line;
        place.column = tab > 0 ? 1 : error->column;
        if (tab > 0) {
            scree_problem_add(b->reader, place, NULL, NULL, NULL,
                              "this line is indented with a tab; YAML wants spaces");
            return;
        }
    }
    scree_problem_add(b->reader, place, NULL, NULL, NULL, "this is not valid YAML: %s",
                      error && error->msg ? in_plain_words(error->msg) : "it cannot be read");
}

scree_node *scree_yaml_read(scree_reader *reader, const char *text, size_t length, scree_place place)
{
    struct fy_diag_cfg quiet;
    fy_diag_cfg_default(&quiet);
    quiet.fp = NULL;
    quiet.output_fn = ignore_output;
    quiet.level = FYET_ERROR;
    struct fy_diag *diag = fy_diag_create(&quiet);
    if (diag) fy_diag_set_collect_errors(diag, true);
    struct fy_parse_cfg settings = {.flags = FYPCF_QUIET | FYPCF_DEFAULT_VERSION_1_2 | FYPCF_JSON_NONE, .diag = diag};
    struct fy_parser *parser = diag ? fy_parser_create(&settings) : NULL;
    builder b = {.reader = reader, .base = place, .key_place = place};
    errno = 0;
    bool going = parser && fy_parser_set_string(parser, text, length) == 0;
    if (!going) scree_reader_fail(reader, length);
    struct fy_event *event;
    while (going && (event = fy_parser_parse(parser))) {
        going = build(&b, event);
        fy_parser_event_free(parser, event);
    }
    // Where memory runs out libfyaml reports a syntax error, or the end of the file.
    if (going && errno == ENOMEM) {
        scree_reader_fail(reader, length);
        going = false;
    }
    if (going && fy_parser_get_stream_error(parser)) {
        note_syntax_error(&b, diag, text, length);
        going = false;
    }
    if (parser) fy_parser_destroy(parser);
    if (diag) fy_diag_destroy(diag);
    if (going && !b.root)
        scree_problem_add(reader, place, NULL, NULL, NULL, "there is no case in it; 'scree new biaxial' prints one");
    return going ? b.root : NULL;
}
