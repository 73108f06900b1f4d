/// Whether two cases mean the same: the values of all keys that they use, as the schema reads them. How they are
/// written (units, order, comments, defaults left out) does not count.
#include "base/schedule.h"
#include "case/case.h"
#include "case/check.h"

#include <math.h>
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

static bool same_section(const scree_section *section, const part *one, const part *other);

static bool same_lists(const scree_key *key, const part *one, const part *other)
{
    int64_t count = count_of(key, one);
    const scree_node *a = scree_node_find(one->mapping, key->name), *b = scree_node_find(other->mapping, key->name);
    if (count != count_of(key, other)) return false;
    for (int64_t i = 0; i < count; i++) {
        size_t at = (size_t)i * key->element_size;
        part first = {one->root, scree_node_at(a, (size_t)i), array_of(key, one) + at};
        part second = {other->root, scree_node_at(b, (size_t)i), array_of(key, other) + at};
        const scree_section *section = scree_primitive_section(key, first.mapping);
        if (!section || section != scree_primitive_section(key, second.mapping)) return false;
        if (!same_section(section, &first, &second)) return false;
    }
    return true;
}

static bool same_key(const scree_key *key, const part *one, const part *other)
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
        return same_section(key->sections, &first, &second);
    case SCREE_KEY_LIST:
        return same_lists(key, one, other);
    case SCREE_KEY_VALUES:
        return same_nodes(first.mapping, second.mapping);
    case SCREE_KEY_PATHS:
    case SCREE_KEY_MODULES: // never in a schema that is put together
        break;              // the quick section: what it changes has been applied, or does not count
    }
    return true;
}

static bool same_section(const scree_section *section, const part *one, const part *other)
{
    for (size_t i = 0; i < section->count; i++) {
        const scree_key *key = &section->keys[i];
        bool used = scree_key_usage(one->root, section, one->mapping, key).use == SCREE_USED;
        if (used != (scree_key_usage(other->root, section, other->mapping, key).use == SCREE_USED)) return false;
        if (used && !same_key(key, one, other)) return false;
    }
    return true;
}

bool scree_case_same(const scree_case *one, const scree_case *other)
{
    part first = {scree_case_root(one), scree_case_root(one), (const char *)&one->config};
    part second = {scree_case_root(other), scree_case_root(other), (const char *)&other->config};
    return same_section(scree_schema(), &first, &second);
}
