/// Puts the schema together: the sections of the core (schema.c), the keys that modules add to them, and the choices
/// and kinds of elements that modules are. Once a process, into arrays of fixed length, so that it cannot fail; no case
/// is read where a change of the program has made them too short, and a test asks.
///
/// Structs of modules: a section that modules can add keys to has a block beside its struct, in which theirs lie one
/// after the other; a list's element whose kind is a module has the struct of that module first in it.
#include "case/check.h"

#include <pthread.h>
#include <stdio.h>
#include <string.h>

enum { MOST_KEYS = 96, MOST_GROUPS = 8, ALL_KEYS = 1280, ALL_SECTIONS = 192, ALL_CHOICES = 640, ALL_TEXT = 8192 };
enum { ALIGNMENT = 16 };

/// What the schema is made of, and how much of it is taken.
static scree_key all_keys[ALL_KEYS];
static scree_section all_sections[ALL_SECTIONS];
static scree_choice all_choices[ALL_CHOICES];
static char all_text[ALL_TEXT];
static size_t key_count, section_count, choice_count, text_length;
static bool too_long;

static size_t places[SCREE_MODULE_COUNT][MOST_GROUPS]; ///< of the structs of modules in their blocks

/// A section in the making.
typedef struct draft {
    const scree_section *plan;  ///< what the core declares
    const scree_module *module; ///< whose section it is, of those of a list; else NULL
    const char *path;
    scree_key key[MOST_KEYS];
    size_t count;
    size_t own_size;
} draft;

static void build_section(scree_section *section, const scree_section *plan, const scree_module *module,
                          const scree_choice *kinds, const char *path);

/// Room for `wanted` more of `count` of `most`; its first index.
static size_t take(size_t *count, size_t wanted, size_t most)
{
    size_t first = *count;
    if (first + wanted > most) {
        too_long = true;
        return most - wanted;
    }
    *count += wanted;
    return first;
}

static const char *choice_meaning(const scree_module *module, const char *path)
{
    for (const scree_choice_of *choice = module->choice_of; choice && choice->key; choice++)
        if (strcmp(choice->key, path) == 0) return choice->meaning ? choice->meaning : module->meaning;
    return NULL;
}

// ---- keys of modules ---------------------------------------------------------------------------------------------

static void insert_key(draft *d, size_t at, const scree_key *key)
{
    if (d->count == MOST_KEYS) {
        too_long = true;
        return;
    }
    memmove(&d->key[at + 1], &d->key[at], (d->count - at) * sizeof *d->key);
    d->key[at] = *key;
    d->count++;
}

static size_t find_key(const draft *d, const char *name)
{
    for (size_t i = 0; i < d->count; i++)
        if (d->key[i].name && strcmp(d->key[i].name, name) == 0) return i;
    return d->count;
}

/// The first condition of `one`, or with it what stands behind the '=' of `other`, which is of the same chooser;
/// further conditions, of keys that one of the two modules alone has, stand behind.
static const char *join_conditions(const char *one, const char *other)
{
    const char *alternatives = strchr(other, '=') + 1;
    size_t size = strlen(one) + strlen(alternatives) + 2;
    char *text = &all_text[take(&text_length, size, ALL_TEXT)];
    const int first = (int)strcspn(one, "&");
    (void)snprintf(text, size, "%.*s|%s%s", first, one, alternatives, one + first);
    return text;
}

/// A key that another module has declared too is one key, used with both, which fills the structs of both.
static void merge_key(scree_key *first, const scree_key *again)
{
    if (first->when && again->when) first->when = join_conditions(first->when, again->when);
    scree_key *twin = &all_keys[take(&key_count, 1, ALL_KEYS)];
    *twin = *again;
    twin->twin = first->twin;
    first->twin = twin;
}

/// Adds the keys of one group at `*at`, or where it asks to stand. `*at` goes on with what stands there.
static void add_group(draft *d, const scree_keys *group, size_t *place, size_t *at)
{
    *place = d->own_size;
    d->own_size += (group->size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    size_t behind = group->after ? find_key(d, group->after) : d->count, before = d->count;
    size_t to = behind < d->count ? behind + 1 : *at;
    bool shifts = to <= *at;
    for (size_t i = 0; i < group->count; i++) {
        scree_key key = group->keys[i];
        key.own = true;
        key.own_offset = d->plan->own_offset;
        key.offset += *place;
        key.count_offset += *place;
        size_t same = find_key(d, key.name);
        if (same < d->count)
            merge_key(&d->key[same], &key);
        else
            insert_key(d, to++, &key);
    }
    if (shifts) *at += d->count - before;
}

/// Adds what modules declare for this section at index `at`.
static void add_modules(draft *d, size_t at)
{
    for (int pass = d->module ? 0 : 1; pass < 2; pass++)
        for (size_t m = 0; m < SCREE_MODULE_COUNT; m++) {
            const scree_module *module = scree_modules[m];
            if (module->keys_count > MOST_GROUPS) too_long = true;
            for (size_t g = 0; g < module->keys_count && g < MOST_GROUPS; g++) {
                const scree_keys *group = &module->keys[g];
                bool own = !group->section && module == d->module;
                bool added = group->section && strcmp(group->section, d->path) == 0;
                if (pass == 0 ? own : added) add_group(d, group, &places[m][g], &at);
            }
        }
}

// ---- choices and kinds of elements -------------------------------------------------------------------------------

/// Choices of the core, then those that modules are.
static const scree_choice *build_choices(const scree_choice *core, const char *path)
{
    size_t count = 0, modules = 0;
    while (core && core[count].name) count++;
    for (size_t m = 0; m < SCREE_MODULE_COUNT; m++) modules += choice_meaning(scree_modules[m], path) != NULL;
    if (modules == 0) return core;
    scree_choice *choices = &all_choices[take(&choice_count, count + modules + 1, ALL_CHOICES)];
    if (count > 0) memcpy(choices, core, count * sizeof *core);
    for (size_t m = 0; m < SCREE_MODULE_COUNT; m++) {
        const char *meaning = choice_meaning(scree_modules[m], path);
        if (meaning) choices[count++] = (scree_choice){scree_modules[m]->name, (int)m, meaning};
    }
    choices[count] = (scree_choice){0};
    return choices;
}

/// "chooser=a|b|c" with the choices that have the trait, behind `when`.
static const char *write_condition(const draft *d, const scree_key *key)
{
    char text[512];
    size_t length;
    // Of another section: the choices are the modules.
    const bool elsewhere = strchr(key->chooser, '.') != NULL;
    const scree_choice *choices =
        elsewhere ? build_choices(NULL, key->chooser) : d->key[find_key(d, key->chooser)].choices;
    length =
        (size_t)snprintf(text, sizeof text, "%s%s%s=", key->when ? key->when : "", key->when ? "&" : "", key->chooser);
    const char *between = "";
    for (const scree_choice *c = choices; c && c->name && length < sizeof text; c++) {
        if (c->value < 0 || !key->fits(scree_modules[c->value])) continue;
        length += (size_t)snprintf(text + length, sizeof text - length, "%s%s", between, c->name);
        between = "|";
    }
    if (length >= sizeof text) too_long = true;
    size_t size = strlen(text) + 1;
    return memcpy(&all_text[take(&text_length, size, ALL_TEXT)], text, size);
}

/// The sections of a key: of a list whose elements modules are, one for each of these.
static void build_inner(scree_key *key, const char *path)
{
    size_t kinds = 0;
    for (size_t m = 0; m < SCREE_MODULE_COUNT && key->type == SCREE_KEY_LIST; m++)
        kinds += choice_meaning(scree_modules[m], path) != NULL;
    const scree_section *plan = key->sections;
    size_t count = kinds > 0 ? kinds : key->section_count;
    scree_section *built = &all_sections[take(&section_count, count, ALL_SECTIONS)];
    if (kinds == 0) {
        for (size_t i = 0; i < count; i++) {
            char inner[SCREE_PATH_BYTES];
            scree_key_join(inner, path, plan[i].name);
            build_section(&built[i], &plan[i], NULL, NULL, count > 1 ? inner : path);
        }
    } else {
        const scree_choice *names = build_choices(NULL, path);
        count = 0;
        for (size_t m = 0; m < SCREE_MODULE_COUNT; m++) {
            char inner[SCREE_PATH_BYTES];
            if (!choice_meaning(scree_modules[m], path)) continue;
            scree_key_join(inner, path, scree_modules[m]->name);
            build_section(&built[count++], plan, scree_modules[m], names, inner);
        }
    }
    key->sections = built;
    key->section_count = count;
}

/// Path of a key of a section. Keys of the core that all elements of a list have stand once, in the list:
/// "stages.name".
static void key_path(char out[SCREE_PATH_BYTES], const draft *d, const scree_key *key)
{
    char list[SCREE_PATH_BYTES];
    const char *kind = d->module && !key->own ? strrchr(d->path, '.') : NULL;
    size_t length = kind ? (size_t)(kind - d->path) : strlen(d->path);
    (void)snprintf(list, sizeof list, "%.*s", (int)length, d->path);
    scree_key_join(out, list, key->name);
}

/// kinds: choices of the first key, where that says of which module the section is; else NULL.
static void build_section(scree_section *section, const scree_section *plan, const scree_module *module,
                          const scree_choice *kinds, const char *path)
{
    draft d = {.plan = plan, .module = module, .path = path};
    size_t at = plan->count;
    for (size_t i = 0; i < plan->count; i++) {
        const scree_key *key = &plan->keys[i];
        if (key->type == SCREE_KEY_MODULES)
            at = d.count;
        else if (!key->fits || key->chooser || !module || key->fits(module))
            insert_key(&d, d.count, key);
    }
    if (plan->open) add_modules(&d, at < d.count ? at : d.count);
    size_t first = take(&key_count, d.count, ALL_KEYS);
    for (size_t i = 0; i < d.count; i++) {
        scree_key *key = &d.key[i];
        char inner[SCREE_PATH_BYTES];
        key_path(inner, &d, key);
        if (key->type == SCREE_KEY_CHOICE) key->choices = build_choices(key->choices, inner);
        if (key->section_count > 0) build_inner(key, inner);
    }
    if (kinds) d.key[0].choices = kinds;
    for (size_t i = 0; i < d.count; i++)
        if (d.key[i].chooser) d.key[i].when = write_condition(&d, &d.key[i]);
    memcpy(&all_keys[first], d.key, d.count * sizeof *d.key);
    *section = *plan;
    section->keys = &all_keys[first];
    section->count = d.count;
    section->own_size = d.own_size;
    if (!module) return;
    section->name = module->name;
    section->meaning = module->meaning;
}

// ---- the whole ---------------------------------------------------------------------------------------------------

static scree_section whole;

static void build_whole(void)
{
    build_section(&whole, &scree_schema_core, NULL, NULL, "");
}

const scree_section *scree_schema(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    (void)pthread_once(&once, build_whole);
    return &whole;
}

bool scree_schema_is_whole(void)
{
    (void)scree_schema();
    return !too_long;
}

const void *scree_config_own(const scree_module *module, const char *section, const void *own)
{
    (void)scree_schema();
    for (size_t m = 0; m < SCREE_MODULE_COUNT && own; m++)
        for (size_t g = 0; scree_modules[m] == module && g < module->keys_count; g++) {
            const char *name = module->keys[g].section;
            if (name ? section && strcmp(name, section) == 0 : !section) return (const char *)own + places[m][g];
        }
    return NULL;
}
