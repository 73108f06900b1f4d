/// A case from its text: YAML, the quick section, --set, schema, rules.
///
/// The tree of the text, with everything that overruled it, is kept with the case: written cases and later messages
/// quote what the user wrote. Numbers are read in the C locale whatever the program's locale is. Cost: about 1 ms for a
/// usual file, and 10 ms once a process for the unit database.
#include "case/case.h"

#include "base/handle.h"
#include "base/memory.h"
#include "case/document.h"
#include "case/former.h"
#include "case/path.h"
#include "case/yaml.h"

#include <locale.h>
#include <stdio.h>
#include <string.h>

struct scree_case_source {
    scree_arena arena; ///< holds this struct and the case too
    scree_node *root;
};

/// What is read: a text under a name, and what overrules it.
typedef struct input {
    const char *text;
    size_t length;
    const char *name;
    const scree_case_options *options; ///< may be NULL
    const scree_former_key *former;    ///< names that keys had; NULL: only the present ones count
} input;

/// Reads the text into reader->root, NULL when it holds no tree.
static void read_tree(scree_reader *reader, const input *in)
{
    scree_place place = {scree_arena_copy(reader->arena, in->name, strlen(in->name)), 1, 1, SCREE_ORIGIN_FILE};
    if (!place.source)
        scree_reader_fail(reader, strlen(in->name));
    else if (scree_text_check(reader, in->text, in->length, place))
        reader->root = scree_yaml_read(reader, in->text, in->length, place);
    if (reader->root) scree_former_keys_apply(reader->root, in->former);
}

/// From the tree to the config, after quick and overrides.
static void read_config(scree_reader *reader, const scree_case_options *options, bool quick, scree_config *config)
{
    if (!reader->root) return;
    if (quick) scree_quick_apply(reader);
    for (size_t i = 0; options && i < options->override_count; i++) scree_override_apply(reader, options->overrides[i]);
    if (!reader->failure.status) scree_config_read(reader, config);
}

/// Notes what is wrong with the quick section of a case that is read without it. A file that is right by itself must be
/// right with --quick too; of another one only the quick section's own values are judged.
static void try_quick(scree_reader *main, const input *in)
{
    bool overridden = in->options && in->options->override_count > 0;
    scree_arena arena = {0};
    scree_config config;
    memset(&config, 0, sizeof config);
    scree_reader trial = {.arena = &arena, .problems = main->problems, .only_quick = true};
    read_tree(&trial, in); // notes nothing: the main reading did
    trial.only_quick = overridden || scree_problems_count(main->problems) > 0;
    read_config(&trial, NULL, true, &config);
    main->failure = trial.failure;
    scree_arena_release(&arena);
}

static scree_status parse(const input *in, scree_problems *problems, scree_case **out)
{
    scree_arena arena = {0};
    scree_case *c = scree_arena_take(&arena, sizeof *c);
    struct scree_case_source *source = c ? scree_arena_take(&arena, sizeof *source) : NULL;
    scree_reader reader = {.arena = &arena, .problems = problems};
    bool quick = in->options && in->options->quick;
    if (source) {
        read_tree(&reader, in);
        read_config(&reader, in->options, quick, &c->config);
    } else {
        scree_reader_fail(&reader, sizeof *c);
    }
    if (reader.root && !quick && !reader.failure.status && scree_node_find(reader.root, "quick"))
        try_quick(&reader, in);
    scree_status status = scree_reader_conclude(&reader);
    if (status) {
        scree_arena_release(&arena);
        return status;
    }
    *source = (struct scree_case_source){arena, reader.root};
    c->source = source;
    scree_handle_made(c);
    *out = c;
    return SCREE_OK;
}

static scree_status parse_locally(const input *in, scree_case **out, scree_problems **problems)
{
    scree_problems *found;
    *out = NULL;
    if (problems) *problems = NULL;
    scree_status status = scree_problems_create(&found);
    if (status) return status;
    locale_t c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    locale_t before = uselocale(c_locale);
    status = parse(in, found, out);
    uselocale(before);
    freelocale(c_locale);
    if (status && problems)
        *problems = found;
    else
        scree_problems_free(found);
    return status;
}

scree_status scree_case_parse(const char *text, size_t length, const char *name, const scree_case_options *options,
                              scree_case **out, scree_problems **problems)
{
    input in = {.text = text, .length = length, .name = name, .options = options};
    return parse_locally(&in, out, problems);
}

scree_status scree_case_reread(const char *path, const scree_former_key *former, scree_case **out,
                               scree_problems **problems)
{
    char *text;
    input in = {.name = path, .former = former};
    *out = NULL;
    if (problems) *problems = NULL;
    scree_status status = scree_case_text(path, &text, &in.length, problems);
    in.text = text;
    if (!status) status = parse_locally(&in, out, problems);
    scree_release(&text);
    return status;
}

void scree_case_free(scree_case *c)
{
    if (!c) return;
    scree_handle_freed(c, "a case");
    scree_arena arena = c->source->arena;
    scree_arena_release(&arena);
}

scree_node *scree_case_root(const scree_case *c)
{
    return c->source->root;
}

void scree_case_locate(const scree_case *c, scree_error *error)
{
    static const scree_place nowhere = {0};
    scree_target target;
    scree_node *root = scree_case_root(c);
    bool found = scree_path_follow(root, error->field, NULL, nowhere, &target);
    const scree_node *shown = target.node ? target.node : target.parent ? target.parent : root;
    (void)snprintf(error->file, sizeof error->file, "%s", shown->place.source);
    error->line = shown->place.line;
    error->column = shown->place.column;
    const char *value = target.node ? target.node->text : found ? target.key->standard : NULL;
    if (value) (void)snprintf(error->value, sizeof error->value, "%s", value);
}
