/// Whether two cases mean the same: the values of all keys that they use, as the schema reads them. How they are
/// written (units, order, comments, defaults left out) does not count. The path of the first key that differs is told.
#include "base/schedule.h"
#include "case/case.h"
#include "case/check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// A section of a case: what is written, and what it was read into.
typedef struct part {
    const scree_node *root, *mapping;
    const char *base;
} part;

static bool same_numbers(const void *one, const void *other, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double a, b;
        memcpy(&a, (const char *)one + i * sizeof a, sizeof a);
        memcpy(&b, (const char *)other + i * sizeof b, sizeof b);
        if (a != b && !(isnan(a) && isnan(b))) return false;
    }
    return true;
}

static bool same_schedules(const scree_key *key, const char *one, const char *other)
{
    for (size_t i = 0; i < (key->components > 0 ? key->components : 1); i++) {
        scree_schedule a, b;
        memcpy(&a, one + i * sizeof a, sizeof a);
        memcpy(&b, other + i * sizeof b, sizeof b);
        if (!scree_schedule_is_same(&a, &b)) return false;
    }
    return true;
}

static bool same_texts(const void *one, const void *other)
{
    const char *a, *b;
    memcpy(&a, one, sizeof a);
    memcpy(&b, other, sizeof b);
    return a && b ? strcmp(a, b) == 0 : a == b;
}

/// Values as they are written.
static bool same_nodes(const scree_node *one, const scree_node *other)
{
    if (!one || !other || one->kind != other->kind || one->count != other->count) return one == other;
    if (one->kind == SCREE_NODE_SCALAR) return strcmp(one->text, other->text) == 0;
    const scree_node *a = one->first, *b = other->first;
    for (; a && same_nodes(a, b); a = a->next) b = b->next;
    return !a;
}

static int64_t count_of(const scree_key *key, const part *p)
{
    int64_t count;
    memcpy(&count, scree_key_block(key, p->base) + key->count_offset, sizeof count);
    return count;
}

static const char *array_of(const scree_key *key, const part *p)
{
    const char *array;
    memcpy(&array, scree_key_member(key, p->base), sizeof array);
    return array;
}

/// Path of what differs, put together from its end. NULL where nobody asks.
typedef char path[SCREE_CASE_PATH];

static bool differs(path *where, const char *name)
{
    path behind;
    if (!where) return false;
    (void)snprintf(behind, sizeof behind, "%s", *where);
    (void)snprintf(*where, sizeof *where, behind[0] ? "%s.%s" : "%s", name, behind);
    return false;
}

static bool same_section(const scree_section *section, const part *one, const part *other, path *where);

static part element(const scree_key *key, const part *p, int64_t i)
{
    const scree_node *list = scree_node_find(p->mapping, key->name);
    return (part){p->root, scree_node_at(list, (size_t)i), array_of(key, p) + (size_t)i * key->element_size};
}

/// How many elements at the begin of two lists are the same; `where` is told how the next one differs.
static int64_t same_elements(const scree_key *key, const part *one, const part *other, path *where)
{
    const int64_t count = count_of(key, one) < count_of(key, other) ? count_of(key, one) : count_of(key, other);
    for (int64_t i = 0; i < count; i++) {
        const part first = element(key, one, i), second = element(key, other, i);
        const scree_section *section = scree_element_section(key, first.mapping);
        if (section && section == scree_element_section(key, second.mapping) &&
            same_section(section, &first, &second, where))
            continue;
        char number[24];
        (void)snprintf(number, sizeof number, "%lld", (long long)i);
        (void)differs(where, number);
        return i;
    }
    return count;
}

static bool same_lists(const scree_key *key, const part *one, const part *other, path *where)
{
    const int64_t count = count_of(key, one);
    return same_elements(key, one, other, where) == count && count == count_of(key, other);
}

static bool same_key(const scree_key *key, const part *one, const part *other, path *where)
{
    const char *a = scree_key_member(key, one->base), *b = scree_key_member(key, other->base);
    part first = {one->root, scree_node_find(one->mapping, key->name), a};
    part second = {other->root, scree_node_find(other->mapping, key->name), b};
    switch (key->type) {
    case SCREE_KEY_NUMBER:
        return same_numbers(a, b, 1);
    case SCREE_KEY_VECTOR:
        return same_numbers(a, b, 3);
    case SCREE_KEY_SCHEDULE:
        return same_schedules(key, a, b);
    case SCREE_KEY_TENSOR:
        return same_numbers(a, b, 9);
    case SCREE_KEY_PAIRS:
        return count_of(key, one) == count_of(key, other) &&
               same_numbers(array_of(key, one), array_of(key, other), 2 * (size_t)count_of(key, one));
    case SCREE_KEY_INTEGER:
        return memcmp(a, b, sizeof(int64_t)) == 0;
    case SCREE_KEY_CHOICE:
        return memcmp(a, b, sizeof(int)) == 0;
    case SCREE_KEY_FLAG:
        return memcmp(a, b, sizeof(bool)) == 0;
    case SCREE_KEY_TEXT:
    case SCREE_KEY_WORD:
        return same_texts(a, b);
    case SCREE_KEY_SECTION:
        return same_section(key->sections, &first, &second, where);
    case SCREE_KEY_LIST:
        return same_lists(key, one, other, where);
    case SCREE_KEY_VALUES:
        return same_nodes(first.mapping, second.mapping);
    case SCREE_KEY_PATHS:
    case SCREE_KEY_MODULES: // never in a schema that is put together
        break;              // the quick section: what it changes has been applied, or does not count
    }
    return true;
}

/// Whether both use a key, with one value, or neither does.
static bool same_use(const scree_section *section, const scree_key *key, const part *one, const part *other,
                     path *where)
{
    const bool used = scree_key_usage(one->root, section, one->mapping, key).use == SCREE_USED;
    if (used != (scree_key_usage(other->root, section, other->mapping, key).use == SCREE_USED)) return false;
    return !used || same_key(key, one, other, where);
}

static bool same_section(const scree_section *section, const part *one, const part *other, path *where)
{
    for (size_t i = 0; i < section->count; i++)
        if (!same_use(section, &section->keys[i], one, other, where)) return differs(where, section->keys[i].name);
    return true;
}

static part whole(const scree_case *c)
{
    return (part){scree_case_root(c), scree_case_root(c), (const char *)&c->config};
}

bool scree_case_same(const scree_case *one, const scree_case *other)
{
    const part first = whole(one), second = whole(other);
    return same_section(scree_schema(), &first, &second, NULL);
}

/// What a sample does not depend on.
static bool is_free(const scree_key *key)
{
    static const char *const names[] = {"name", "title", "output", "guard"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
        if (strcmp(key->name, names[k]) == 0) return true;
    return false;
}

int64_t scree_case_stage_apart(const scree_case *one, const scree_case *other, char where[SCREE_CASE_PATH])
{
    const part first = whole(one), second = whole(other);
    const scree_section *schema = scree_schema();
    path *there = (path *)where;
    where[0] = 0;
    for (size_t i = 0; i < schema->count; i++) {
        const scree_key *key = &schema->keys[i];
        if (strcmp(key->name, "stages") != 0) continue;
        const int64_t same = same_elements(key, &first, &second, there);
        if (where[0]) (void)differs(there, key->name);
        return same == count_of(key, &first) && same == count_of(key, &second) ? -1 : same;
    }
    return -1;
}

bool scree_case_is_apart(const scree_case *one, const scree_case *other, char where[SCREE_CASE_PATH])
{
    const part first = whole(one), second = whole(other);
    where[0] = 0;
    return !same_section(scree_schema(), &first, &second, (path *)where);
}

int64_t scree_case_common_stages(const scree_case *one, const scree_case *other, char where[SCREE_CASE_PATH])
{
    const part first = whole(one), second = whole(other);
    const scree_section *schema = scree_schema();
    path stage = "", *there = (path *)where;
    int64_t common = 0;
    where[0] = 0;
    for (size_t i = 0; i < schema->count; i++) {
        const scree_key *key = &schema->keys[i];
        if (is_free(key)) continue;
        if (strcmp(key->name, "stages") == 0) {
            common = same_elements(key, &first, &second, &stage);
            if (stage[0]) (void)differs(&stage, key->name);
        } else if (!same_use(schema, key, &first, &second, there)) {
            (void)differs(there, key->name);
            return 0;
        }
    }
    memcpy(where, stage, sizeof stage);
    return common;
}
