/// From what a sweep file says to dimensions, points and members. The grid is the Cartesian product of the dimensions;
/// its points and members are numbered by the mixed-radix number of their settings.
#include "sweep/sweep.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_MEMBERS = 100000, NAME_SIZE = 200, PATH_SIZE = 200 };

/// Memory of the sweep; on failure the reader knows.
static void *take(scree_reader *reader, size_t count, size_t size)
{
    void *memory = scree_arena_take(reader->arena, count * size);
    if (!memory) scree_reader_fail(reader, count * size);
    return memory;
}

static const char *copy(scree_reader *reader, const char *text)
{
    const char *result = scree_arena_copy(reader->arena, text, strlen(text));
    if (!result) scree_reader_fail(reader, strlen(text));
    return result;
}

void scree_slug(char *slug, size_t size, const char *text)
{
    size_t used = 0;
    bool gap = false;
    for (const char *c = text; *c && used + 2 < size; c++) {
        bool fits = isalnum((unsigned char)*c) || *c == '_' || *c == '.' || *c == '=' || *c == '-';
        if (fits && gap && used > 0) slug[used++] = '-';
        if (fits) slug[used++] = *c;
        gap = !fits;
    }
    slug[used] = 0;
}

static bool says(const scree_sweep_assignment *assignment, size_t count, const char *path)
{
    const size_t length = strlen(path);
    for (size_t k = 0; k < count; k++)
        if (strncmp(assignment[k].text, path, length) == 0 && assignment[k].text[length] == '=') return true;
    return false;
}

bool scree_sweep_asks_for(const scree_sweep *sweep, const char *path)
{
    bool found = says(sweep->fixed, sweep->fixed_count, path) || says(sweep->last, sweep->last_count, path);
    for (size_t d = 0; d < sweep->dimension_count; d++)
        for (size_t k = 0; k < sweep->dimension[d].count; k++) {
            const scree_sweep_setting *setting = &sweep->dimension[d].setting[k];
            found = found || says(setting->assignment, setting->assignment_count, path);
        }
    return found;
}

size_t scree_point_setting(const scree_sweep *sweep, size_t point, size_t dimension)
{
    for (size_t k = sweep->dimension_count; k > dimension + 1; k--) point /= sweep->dimension[k - 1].count;
    return point % sweep->dimension[dimension].count;
}

void scree_point_label(const scree_sweep *sweep, size_t point, size_t leave_out, char *text, size_t size)
{
    size_t used = 0;
    text[0] = 0;
    for (size_t k = 0; k < sweep->dimension_count && used < size; k++) {
        const scree_sweep_dimension *dimension = &sweep->dimension[k];
        const char *label = dimension->setting[scree_point_setting(sweep, point, k)].label;
        if (k == leave_out) continue;
        used += (size_t)snprintf(text + used, size - used, "%s%s%s%s", used > 0 ? ", " : "",
                                 dimension->named ? "" : dimension->name, dimension->named ? "" : " ", label);
    }
}

/// A value as --set takes it.
static const char *value_text(scree_reader *reader, const scree_node *node)
{
    char *text = NULL;
    size_t length;
    FILE *memory = open_memstream(&text, &length);
    if (!memory) {
        scree_reader_fail(reader, length = 1);
        return NULL;
    }
    scree_node_write(memory, node);
    const char *result = fclose(memory) == 0 ? copy(reader, text) : NULL;
    free(text);
    return result;
}

static void assign(scree_reader *reader, scree_sweep_assignment *assignment, const char *path, const scree_node *value)
{
    char *text;
    const char *shown = value_text(reader, value);
    size_t length = strlen(path) + (shown ? strlen(shown) : 0) + 2;
    if (!shown || !(text = take(reader, length, 1))) return;
    (void)snprintf(text, length, "%s=%s", path, shown);
    *assignment = (scree_sweep_assignment){path, text, shown, value->place};
}

static size_t assign_mapping(scree_reader *reader, scree_sweep_assignment *list, const scree_node *mapping)
{
    size_t index = 0;
    for (const scree_node *entry = mapping ? mapping->first : NULL; entry; entry = entry->next) {
        if (strcmp(entry->key, "seed") == 0)
            scree_problem_add(reader, entry->key_place, "seed", entry->text, NULL,
                              "is set by `seed` and `realisations` of the sweep");
        assign(reader, &list[index++], entry->key, entry);
    }
    return index;
}

/// The assignments of two mappings of key paths, one after the other; each may be NULL.
static size_t assign_all(scree_reader *reader, scree_sweep_assignment **list, const scree_node *first,
                         const scree_node *second)
{
    *list = take(reader, (first ? first->count : 0) + (second ? second->count : 0), sizeof **list);
    if (!*list) return 0;
    size_t count = assign_mapping(reader, *list, first);
    return count + assign_mapping(reader, *list + count, second);
}

static void refuse_key(scree_reader *reader, scree_place place, const char *path)
{
    if (strcmp(path, "seed") == 0)
        scree_problem_add(reader, place, "seed", NULL, NULL, "is varied by `realisations` of the sweep");
}

static void name_setting(scree_reader *reader, scree_sweep_setting *setting, const char *label)
{
    char slug[NAME_SIZE];
    scree_slug(slug, sizeof slug, label);
    setting->label = label;
    setting->slug = copy(reader, slug);
}

/// A dimension of keys with values: one, or several in step.
static void expand_values(scree_reader *reader, const scree_sweep_vary *vary, const scree_sweep_together *key,
                          size_t keys, scree_sweep_dimension *dimension)
{
    dimension->count = key[0].values->count;
    dimension->named = vary->names != NULL;
    dimension->setting = take(reader, dimension->count, sizeof *dimension->setting);
    for (size_t i = 0; dimension->setting && i < dimension->count; i++) {
        scree_sweep_setting *setting = &dimension->setting[i];
        setting->assignment = take(reader, keys, sizeof *setting->assignment);
        if (!setting->assignment) return;
        setting->assignment_count = keys;
        for (size_t k = 0; k < keys; k++)
            assign(reader, &setting->assignment[k], key[k].key, scree_node_at(key[k].values, i));
        const scree_node *name = vary->names ? scree_node_at(vary->names, i) : NULL;
        if (reader->failure.status) return;
        name_setting(reader, setting, name && name->text ? name->text : setting->assignment[0].value);
    }
}

static void expand_alternatives(scree_reader *reader, const scree_sweep_vary *vary, scree_sweep_dimension *dimension)
{
    dimension->count = (size_t)vary->alternative_count;
    dimension->named = true;
    dimension->setting = take(reader, dimension->count, sizeof *dimension->setting);
    for (size_t i = 0; dimension->setting && i < dimension->count; i++) {
        scree_sweep_setting *setting = &dimension->setting[i];
        name_setting(reader, setting, vary->alternatives[i].name);
        setting->assignment_count = assign_all(reader, &setting->assignment, vary->alternatives[i].set, NULL);
    }
}

/// The dimension's own name, or the last part of its first key path.
static const char *dimension_name(const scree_sweep_vary *vary)
{
    const char *key = vary->together_count > 0 ? vary->together[0].key : vary->key;
    const char *dot = strrchr(key, '.');
    if (vary->name) return vary->name;
    if (vary->alternative_count > 0) return "variant";
    return dot ? dot + 1 : key;
}

static bool lengths_agree(scree_reader *reader, const scree_node *list, size_t count, const char *path)
{
    if (!list || list->count == count) return true;
    scree_problem_add(reader, list->place, path, NULL, NULL, "%zu values beside %zu of the others", list->count, count);
    return false;
}

/// Whether one, and only one, way is used to say what varies, and all lists have one length.
static bool is_consistent(scree_reader *reader, const scree_sweep_vary *vary, const scree_node *element,
                          const char *path)
{
    int ways = (vary->key && vary->key[0]) + (vary->together_count > 0) + (vary->alternative_count > 0);
    if (ways != 1) {
        scree_problem_add(reader, element->place, path, NULL, "key with values, together, or alternatives",
                          "says %s what varies", ways == 0 ? "nothing about" : "in more than one way");
        return false;
    }
    bool key = vary->key && vary->key[0];
    if (key != (vary->values != NULL)) {
        scree_problem_add(reader, element->place, path, NULL, NULL,
                          key ? "'key' needs 'values'" : "'values' go with 'key' only");
        return false;
    }
    if (vary->alternative_count > 0 && vary->names) {
        scree_problem_add(reader, vary->names->place, path, NULL, NULL, "'alternatives' have names of their own");
        return false;
    }
    for (int64_t k = 0; k < vary->together_count; k++)
        if (!vary->together[k].values || !vary->together[k].key || !vary->together[k].key[0]) return false;
    const scree_node *first = key ? vary->values : vary->together_count > 0 ? vary->together[0].values : NULL;
    if (vary->quick_values && (!key || !vary->names)) {
        scree_problem_add(reader, vary->quick_values->place, path, NULL, NULL,
                          "'quick_values' need a 'key', and 'names' that are the same in both forms");
        return false;
    }
    bool good = !first || lengths_agree(reader, vary->names, first->count, path);
    good &= !first || lengths_agree(reader, vary->quick_values, first->count, path);
    for (int64_t k = 1; k < vary->together_count; k++)
        good &= lengths_agree(reader, vary->together[k].values, first->count, path);
    return good;
}

/// Settings of one dimension have different names.
static void check_slugs(scree_reader *reader, const scree_sweep_dimension *dimension, const scree_node *element,
                        const char *path)
{
    for (size_t i = 0; i < dimension->count; i++) {
        const char *slug = dimension->setting[i].slug;
        if (!slug) return;
        if (!slug[0])
            scree_problem_add(reader, element->place, path, dimension->setting[i].label, NULL,
                              "'%s' gives no name for a folder: add 'names'", dimension->setting[i].label);
        for (size_t k = 0; k < i; k++)
            if (strcmp(slug, dimension->setting[k].slug) == 0)
                scree_problem_add(reader, element->place, path, slug, NULL,
                                  "two of its settings would be called '%s': leave one out, or add 'names'", slug);
    }
}

static void expand_dimensions(scree_reader *reader, scree_sweep *sweep)
{
    const scree_sweep_config *config = &sweep->config;
    const scree_node *list = scree_node_find(reader->root, "vary");
    sweep->dimension = take(reader, (size_t)config->vary_count, sizeof *sweep->dimension);
    for (int64_t i = 0; sweep->dimension && i < config->vary_count; i++) {
        const scree_sweep_vary *vary = &config->vary[i];
        const scree_node *element = scree_node_at(list, (size_t)i);
        char path[48];
        (void)snprintf(path, sizeof path, "vary.%lld", (long long)i);
        if (element->kind != SCREE_NODE_MAPPING || !is_consistent(reader, vary, element, path)) continue;
        bool smaller = sweep->quick && vary->quick_values;
        scree_sweep_together single = {vary->key, smaller ? vary->quick_values : vary->values};
        bool together = vary->together_count > 0;
        const scree_sweep_together *key = together ? vary->together : &single;
        size_t keys = together ? (size_t)vary->together_count : 1;
        scree_sweep_dimension *dimension = &sweep->dimension[sweep->dimension_count];
        dimension->name = dimension_name(vary);
        for (size_t k = 0; k < keys && vary->alternative_count == 0; k++)
            refuse_key(reader, element->place, key[k].key);
        if (vary->alternative_count > 0)
            expand_alternatives(reader, vary, dimension);
        else
            expand_values(reader, vary, key, keys, dimension);
        if (reader->failure.status) return;
        check_slugs(reader, dimension, element, path);
        sweep->dimension_count++;
    }
}

/// Names of points and folders of members.
static void name_members(scree_reader *reader, scree_sweep *sweep)
{
    sweep->point = take(reader, sweep->point_count, sizeof *sweep->point);
    sweep->folder = take(reader, sweep->member_count, sizeof *sweep->folder);
    if (!sweep->point || !sweep->folder) return;
    for (size_t i = 0; i < sweep->point_count; i++) {
        char name[NAME_SIZE] = "";
        size_t used = 0;
        for (size_t k = 0; k < sweep->dimension_count && used < sizeof name; k++) {
            const scree_sweep_dimension *dimension = &sweep->dimension[k];
            used += (size_t)snprintf(name + used, sizeof name - used, "%s%s%s%s", k > 0 ? "_" : "",
                                     dimension->named ? "" : dimension->name, dimension->named ? "" : "=",
                                     dimension->setting[scree_point_setting(sweep, i, k)].slug);
        }
        sweep->point[i] = copy(reader, name);
    }
    for (size_t i = 0; i < sweep->member_count && !reader->failure.status; i++) {
        char folder[NAME_SIZE + 64];
        const char *point = sweep->point[scree_member_point(sweep, i)];
        (void)snprintf(folder, sizeof folder, "%03zu-%s%sseed=%lld", i, point, point[0] ? "-" : "",
                       (long long)scree_member_seed(sweep, i));
        sweep->folder[i] = copy(reader, folder);
    }
}

static void list_measures(scree_reader *reader, scree_sweep *sweep)
{
    const scree_node *list = sweep->config.measures;
    sweep->measure = take(reader, list ? list->count : 0, sizeof *sweep->measure);
    if (!sweep->measure) return;
    for (const scree_node *each = list ? list->first : NULL; each; each = each->next)
        if (each->kind == SCREE_NODE_SCALAR)
            sweep->measure[sweep->measure_count++] = each->text;
        else
            scree_problem_add(reader, each->place, "measures", NULL, NULL, "expected the name of a result");
}

bool scree_sweep_expand(scree_reader *reader, scree_sweep *sweep)
{
    sweep->quick = sweep->quick || sweep->config.quick;
    int64_t realisations = sweep->config.realisations;
    if (sweep->quick && sweep->config.quick_realisations > 0) realisations = sweep->config.quick_realisations;
    if (sweep->realisations == 0) sweep->realisations = (size_t)realisations;
    const scree_node *of_form = sweep->quick ? sweep->config.quick_set : sweep->config.full_set;
    sweep->fixed_count = assign_all(reader, &sweep->fixed, sweep->config.set, of_form);
    list_measures(reader, sweep);
    expand_dimensions(reader, sweep);
    sweep->point_count = 1;
    for (size_t k = 0; k < sweep->dimension_count && sweep->point_count <= MOST_MEMBERS; k++)
        sweep->point_count *= sweep->dimension[k].count;
    sweep->member_count = sweep->point_count * sweep->realisations;
    if (sweep->point_count > MOST_MEMBERS || sweep->member_count > MOST_MEMBERS)
        scree_problem_add(reader, reader->root->place, NULL, NULL, "at most 100000", "the sweep has too many members");
    bool good = scree_problems_count(reader->problems) == 0 && !reader->failure.status;
    if (good) name_members(reader, sweep);
    return good && !reader->failure.status;
}
