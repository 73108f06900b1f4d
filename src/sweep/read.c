/// Reading a sweep: its file, the case it is about, the grid, and the case of every point, with all problems at once.
#include "base/handle.h"
#include "case/case.h"
#include "case/templates.h"
#include "sweep/bisect.h"
#include "sweep/ensemble.h"
#include "sweep/share.h"
#include "sweep/sweep.h"
#include "sweep/templates.h"

#include "base/memory.h"
#include "io/result_names.h"
#include "run/columns.h"

#include <scree/scree.h>

#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/// Path of a file beside the sweep file.
static void path_beside(char path[PATH_MAX], const char *source, const char *name)
{
    const char *slash = strrchr(source, '/');
    int folder = slash && name[0] != '/' ? (int)(slash + 1 - source) : 0;
    (void)snprintf(path, PATH_MAX, "%.*s%s", folder, source, name);
}

static void keep_case(scree_reader *reader, scree_sweep *sweep, const char *name, const char *text, size_t length)
{
    sweep->case_name = scree_arena_copy(reader->arena, name, strlen(name));
    sweep->case_text = scree_arena_copy(reader->arena, text, length);
    sweep->case_length = length;
    if (!sweep->case_name || !sweep->case_text) scree_reader_fail(reader, length);
}

/// No such case: the nearest built-in one is suggested.
static void refuse_case(scree_reader *reader, const scree_node *node)
{
    const char *names[256];
    char accepted[256] = "";
    size_t count = 0, length = 0;
    for (; count < scree_templates_count && count < 256; count++) {
        names[count] = scree_templates[count].name;
        if (length < sizeof accepted)
            length += (size_t)snprintf(accepted + length, sizeof accepted - length, "%s%s", count > 0 ? ", " : "",
                                       names[count]);
    }
    const char *nearest = scree_nearest(node->text, names, count);
    scree_problem_add(reader, node->place, "case", node->text, nearest ? nearest : accepted,
                      "there is no built-in case '%s'%s%s%s, and no file of this name beside the sweep",
                      scree_show(node->text).text, nearest ? "; did you mean '" : "", nearest ? nearest : "",
                      nearest ? "'?" : "");
}

/// Finds the text of the case: a built-in one of that name, or else a file beside the sweep.
static void find_case(scree_reader *reader, scree_sweep *sweep, bool embedded)
{
    const scree_node *node = scree_node_find(reader->root, "case");
    const char *name = sweep->config.base, *text = name ? scree_template_text(name) : NULL;
    char path[PATH_MAX];
    if (!name || !node) return; // noted
    path_beside(path, embedded ? "" : sweep->source, name);
    bool file = !embedded && !text && access(path, F_OK) == 0;
    if (!file && text) {
        keep_case(reader, sweep, name, text, strlen(text));
    } else if (!file) {
        refuse_case(reader, node);
    } else {
        char *bytes;
        size_t length;
        scree_problems *problems = NULL;
        if (scree_case_text(path, &bytes, &length, &problems))
            scree_problem_add(reader, node->place, "case", path, NULL, "%s", scree_problems_get(problems, 0)->message);
        else
            keep_case(reader, sweep, path, bytes, length);
        scree_problems_free(problems);
        scree_release(&bytes);
    }
}

static void check_column(scree_reader *reader, int64_t index, const char *key, const char *name)
{
    const char *nearest = NULL;
    char path[48];
    if (!name || scree_column_is_known(name, &nearest)) return; // noted
    const scree_node *element = scree_node_at(scree_node_find(reader->root, "curves"), (size_t)index);
    const scree_node *value = scree_node_find(element, key);
    (void)snprintf(path, sizeof path, "curves.%lld.%s", (long long)index, key);
    scree_problem_add(reader, value ? value->place : element->place, path, name, nearest ? nearest : "",
                      "series.csv has no column '%s'%s%s%s", scree_show(name).text, nearest ? "; did you mean '" : "",
                      nearest ? nearest : "", nearest ? "'?" : "");
}

/// A relation is between two of the measures.
static void check_relation(scree_reader *reader, const scree_sweep *sweep, int64_t index, const char *key,
                           const char *name)
{
    char path[48];
    for (const scree_node *m = sweep->config.measures ? sweep->config.measures->first : NULL; m && name; m = m->next)
        if (m->text && strcmp(m->text, name) == 0) return;
    if (!name) return; // noted
    const scree_node *element = scree_node_at(scree_node_find(reader->root, "relations"), (size_t)index);
    const scree_node *value = scree_node_find(element, key);
    (void)snprintf(path, sizeof path, "relations.%lld.%s", (long long)index, key);
    scree_problem_add(reader, value ? value->place : element->place, path, name, NULL, "'%s' is none of the measures",
                      scree_show(name).text);
}

static void refuse_measure(scree_reader *reader, size_t index, const scree_node *node, const char *nearest,
                           const char *what)
{
    char path[48];
    (void)snprintf(path, sizeof path, "measures.%zu", index);
    scree_problem_add(reader, node->place, path, node->text, nearest, "%s '%s'%s%s%s", what,
                      scree_show(node->text).text, nearest ? "; did you mean '" : "", nearest ? nearest : "",
                      nearest ? "'?" : "");
}

/// A measure is a number that runs have.
static void check_measures(scree_reader *reader, const scree_sweep *sweep)
{
    size_t index = 0;
    for (const scree_node *m = sweep->config.measures ? sweep->config.measures->first : NULL; m; m = m->next, index++) {
        if (!m->text) continue; // noted when the list is read
        const scree_result *row = scree_result_name_find(m->text, NULL);
        if (!row)
            refuse_measure(reader, index, m, scree_result_name_nearest(m->text), "no run has a result");
        else if (!row->unit)
            refuse_measure(reader, index, m, NULL, "a text has no mean:");
    }
}

/// Whether a case has what the result of a module is about: a wall of this name.
static bool is_told(const scree_config *config, const scree_module *module, const char *result)
{
    char about[SCREE_RESULT_NAME], name[SCREE_RESULT_NAME];
    for (size_t index = 0; module->told(config, index, about); index++)
        for (size_t k = 0; k < module->results.count; k++)
            if (!scree_result_call(name, about, &module->results.row[k], NULL) && strcmp(name, result) == 0)
                return true;
    return false;
}

/// Measures of a wall and the like are of one that a case of the sweep has.
static void check_told(scree_reader *reader, const scree_sweep *sweep)
{
    size_t index = 0;
    for (const scree_node *m = sweep->config.measures ? sweep->config.measures->first : NULL; m; m = m->next, index++) {
        const scree_module *module;
        const scree_result *row = m->text ? scree_result_name_find(m->text, &module) : NULL;
        bool found = !row || row->name[0] != '_';
        for (size_t point = 0; point < sweep->point_count && !found; point++) {
            scree_case *c;
            if (scree_member_case(sweep, point, &c, NULL)) return;
            found = is_told(&c->config, module, m->text);
            scree_case_free(c);
        }
        if (!found)
            refuse_measure(reader, index, m, scree_result_name_nearest(m->text),
                           "nothing in the cases is called so, and no run has a result");
    }
}

/// The part of a search that is wrong, at its place.
static void refuse_bisect(scree_reader *reader, const char *key, const char *accepted, const char *message)
{
    char path[48];
    const scree_node *section = scree_node_find(reader->root, "bisect");
    const scree_node *node = section ? scree_node_find(section, key) : NULL;
    (void)snprintf(path, sizeof path, "bisect.%s", key);
    scree_problem_add(reader, node ? node->place : section->place, path, node ? node->text : NULL, accepted, "%s",
                      message);
}

/// What members search for, where they do.
static void keep_bisect(scree_reader *reader, scree_sweep *sweep)
{
    const scree_sweep_bisect *b = &sweep->config.bisect;
    if (!scree_node_find(reader->root, "bisect")) return;
    sweep->bisects = true;
    sweep->bisection = (scree_bisection){.key = b->key,
                                         .tolerance = b->tolerance,
                                         .measure = b->measure,
                                         .below = b->below,
                                         .above = b->above,
                                         .target = b->target,
                                         .curve = b->curve};
    const scree_node *first = b->between ? b->between->first : NULL;
    if (!b->key || !b->key[0]) refuse_bisect(reader, "key", NULL, "says nothing about what is searched for");
    if (sweep->config.share[0]) refuse_bisect(reader, "key", NULL, "a search shares no stage: leave `share` out");
    if (!first || b->between->count != 2 || !first->text || !first->next->text) {
        refuse_bisect(reader, "between", "two values", "expected two values, of which one stands");
        return;
    }
    sweep->bisection.between[0] = first->text;
    sweep->bisection.between[1] = first->next->text;
}

/// Whether the case of every point has what is searched for.
static void check_bisect(scree_reader *reader, const scree_sweep *sweep)
{
    for (size_t point = 0; point < sweep->point_count && sweep->bisects; point++) {
        scree_case *c;
        double ends[2];
        scree_error error = {0};
        if (scree_member_case(sweep, point, &c, NULL)) return;
        scree_status status = scree_bisection_check(c, &sweep->bisection, ends, &error);
        scree_case_free(c);
        if (!status) continue;
        refuse_bisect(reader, error.field, error.accepted[0] ? error.accepted : NULL, error.message);
        return;
    }
}

/// Options of the averages over members, which have to be those of `scree measure`.
static void check_ensemble(scree_reader *reader, scree_sweep *sweep)
{
    const scree_node *section = scree_node_find(reader->root, "ensemble");
    const scree_measure_options options = scree_ensemble_options(&sweep->config.ensemble);
    scree_error error = {0};
    sweep->measures_ensembles = section != NULL;
    if (!section || !scree_measure_check(&options, &error)) return;
    const char *key = strncmp(error.field, "--", 2) == 0 ? error.field + 2 : error.field;
    const scree_node *node = scree_node_find(section, key);
    char path[80];
    (void)snprintf(path, sizeof path, "ensemble.%.60s", key);
    scree_problem_add(reader, node ? node->place : section->place, path, node ? node->text : NULL, error.accepted, "%s",
                      error.message);
}

/// --set of the command line, for all members and after everything else.
static void keep_overrides(scree_reader *reader, scree_sweep *sweep, const scree_sweep_read_options *options)
{
    size_t count = options ? options->override_count : 0;
    sweep->last = scree_arena_take(reader->arena, count * sizeof *sweep->last);
    if (!sweep->last) {
        scree_reader_fail(reader, count);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        const char *text = scree_arena_copy(reader->arena, options->overrides[i], strlen(options->overrides[i]));
        if (!text) scree_reader_fail(reader, 1);
        sweep->last[sweep->last_count++] = (scree_sweep_assignment){.text = text};
    }
}

typedef struct input {
    const char *name, *text;
    size_t length;
    bool embedded;
    const scree_sweep_read_options *options;
} input;

/// What the rules need: the sweep that is being read, and from what.
typedef struct reading {
    scree_sweep *sweep;
    const input *in;
} reading;

/// What the schema cannot check, after it has been applied.
static void apply_rules(scree_reader *reader, void *user)
{
    const reading *r = user;
    scree_sweep *sweep = r->sweep;
    find_case(reader, sweep, r->in->embedded);
    for (int64_t i = 0; i < sweep->config.curve_count; i++) {
        check_column(reader, i, "x", sweep->config.curves[i].x);
        check_column(reader, i, "y", sweep->config.curves[i].y);
    }
    for (int64_t i = 0; i < sweep->config.relation_count; i++) {
        check_relation(reader, sweep, i, "x", sweep->config.relations[i].x);
        check_relation(reader, sweep, i, "y", sweep->config.relations[i].y);
    }
    check_measures(reader, sweep);
    keep_overrides(reader, sweep, r->in->options);
    keep_bisect(reader, sweep);
    check_ensemble(reader, sweep);
    if (!scree_sweep_expand(reader, sweep) || !sweep->case_text) return;
    scree_sweep_check_cases(reader, sweep);
    if (scree_problems_count(reader->problems) == 0) check_told(reader, sweep);
    if (scree_problems_count(reader->problems) == 0) check_bisect(reader, sweep);
    if (scree_problems_count(reader->problems) == 0) scree_share_check(reader, sweep);
}

static scree_status read_text(const input *in, scree_sweep **out, scree_problems **problems)
{
    scree_arena arena = {0};
    scree_sweep *sweep = scree_arena_take(&arena, sizeof *sweep);
    if (sweep) sweep->source = scree_arena_copy(&arena, in->name, strlen(in->name));
    if (!sweep || !sweep->source) {
        scree_arena_release(&arena);
        return SCREE_ERROR_IO;
    }
    if (in->options) {
        sweep->quick = in->options->quick;
        sweep->realisations = in->options->realisations;
    }
    reading r = {sweep, in};
    scree_document document = {&scree_sweep_schema, apply_rules, &r, in->name, in->text, in->length};
    scree_status status = scree_document_read(&document, &arena, &sweep->config, sizeof sweep->config, problems);
    if (status) {
        scree_arena_release(&arena);
        return status;
    }
    sweep->arena = arena;
    scree_handle_made(sweep);
    *out = sweep;
    return SCREE_OK;
}

/// Whether a text begins a line with this key.
static bool has_key(const char *text, const char *key)
{
    const size_t length = strlen(key);
    for (const char *line = text; line; line = strchr(line, '\n')) {
        if (*line == '\n') line++;
        if (strncmp(line, key, length) == 0 && line[length] == ':') return true;
    }
    return false;
}

/// A case says its stages, if not its version; a sweep has neither.
static bool is_case(const char *text)
{
    return !has_key(text, "sweep") && (has_key(text, "scree") || has_key(text, "stages"));
}

static bool is_built_in_case(const char *name)
{
    for (size_t k = 0; k < scree_templates_count; k++)
        if (strcmp(scree_templates[k].name, name) == 0) return true;
    return false;
}

/// What is a case, or nothing that is known, is told as such, in place of the keys that it lacks.
static scree_status refuse(const char *name, bool of_case, scree_problems **problems)
{
    scree_error error = {.status = SCREE_ERROR_INPUT};
    const char *names[256];
    size_t count = 0;
    (void)snprintf(error.file, sizeof error.file, "%s", name);
    if (of_case)
        (void)snprintf(error.message, sizeof error.message,
                       "this is a case, not a sweep: `scree run` runs it; a sweep names it as its `case`");
    else {
        while (count < scree_sweep_templates_count && count < sizeof names / sizeof *names) {
            names[count] = scree_sweep_templates[count].name;
            count++;
        }
        const char *nearest = scree_nearest(name, names, count);
        (void)snprintf(error.message, sizeof error.message, "there is no file and no built-in sweep of this name");
        (void)snprintf(error.accepted, sizeof error.accepted, "%s",
                       nearest ? nearest : "scree list --sweeps names all");
    }
    if (problems && scree_problems_create(problems) == SCREE_OK) scree_problems_replace(*problems, &error);
    return SCREE_ERROR_INPUT;
}

scree_status scree_sweep_read(const char *name, const scree_sweep_read_options *options, scree_sweep **out,
                              scree_problems **problems)
{
    const scree_template *built_in = scree_sweep_template(name);
    input in = {.name = name, .options = options};
    char *bytes = NULL;
    *out = NULL;
    struct stat about;
    const bool there = stat(name, &about) == 0;
    // A folder of that name, of the sweep itself, hides no built-in sweep.
    if (built_in && (!there || S_ISDIR(about.st_mode))) {
        in.text = built_in->text;
        in.length = built_in->length;
        in.embedded = true;
        return read_text(&in, out, problems);
    }
    if (!there) return refuse(name, is_built_in_case(name), problems);
    scree_status status = scree_case_text(name, &bytes, &in.length, problems);
    in.text = bytes;
    if (!status) status = is_case(bytes) ? refuse(name, true, problems) : read_text(&in, out, problems);
    scree_release(&bytes);
    return status;
}

void scree_sweep_free(scree_sweep *sweep)
{
    if (!sweep) return;
    scree_handle_freed(sweep, "a sweep");
    scree_arena arena = sweep->arena;
    scree_arena_release(&arena);
}
