/// Members of the persistent list, sorted by ids: found by bisection, added and removed with a shift.
#include "state/persistent.h"

#include "base/checksum.h"
#include "base/matrix.h"
#include "state/body.h"
#include "state/fields.h"
#include "state/periodic.h"

#include <float.h>
#include <string.h>

typedef scree_persistent_list own;

const scree_group scree_persistent_group = {
    .row = "held pair",
    .symbol = "p",
    .count_offset = offsetof(own, count),
    .capacity_offset = offsetof(own, capacity),
    .pairs = true,
    .total_offset = offsetof(own, total),
};

#define MEMBER(name, type, meaning, member_, ...)                                                                      \
    SCREE_FIELD_GROUP(persistent, own, scree_persistent_group, member, scree_persistent_member, "persistent/" name,    \
                      type, 1, "1", meaning, .offset = offsetof(scree_persistent_member, member_), __VA_ARGS__)
static const scree_field fields[] = {
    MEMBER("first", SCREE_FIELD_UINT32, "id of the first of two bodies that are held together", first,
           SCREE_RANGE_TO(SCREE_LIMIT_BODY)),
    MEMBER("second", SCREE_FIELD_UINT32, "id of the second body, larger than the first", second,
           SCREE_RANGE_TO(SCREE_LIMIT_BODY)),
    MEMBER("added", SCREE_FIELD_UINT64, "persistent/changes when it was added", added, .role = SCREE_FIELD_DERIVED),
    SCREE_FIELD_ONE(persistent, own, largest_deformation, "persistent/largest_deformation", SCREE_FIELD_DOUBLE, 1, "m",
                    "largest departure from rest, or tangential displacement, of all held pairs",
                    SCREE_RANGE(0, DBL_MAX)),
    SCREE_FIELD_ONE(persistent, own, largest_gap, "persistent/largest_gap", SCREE_FIELD_DOUBLE, 1, "m",
                    "largest gap between the surfaces of a held pair", SCREE_RANGE(0, DBL_MAX)),
    SCREE_FIELD_ONE(persistent, own, changes, "persistent/changes", SCREE_FIELD_UINT64, 1, "1",
                    "held pairs that were added or removed", .role = SCREE_FIELD_DERIVED),
    SCREE_FIELD_ONE(persistent, own, total, "persistent/total", SCREE_FIELD_UINT64, 1, "1",
                    "held pairs of all processes", .role = SCREE_FIELD_DERIVED),
};

static bool comes_before(const scree_persistent_member *a, uint32_t first, uint32_t second)
{
    return a->first < first || (a->first == first && a->second < second);
}

/// Number of the first member that does not come before a pair.
static size_t lower_bound(const own *list, uint32_t first, uint32_t second)
{
    size_t low = 0, high = list->count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (comes_before(&list->member[middle], first, second))
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

size_t scree_persistent_find(const scree_state *state, uint32_t id_a, uint32_t id_b)
{
    const own *list = scree_persistent(state);
    uint32_t first = id_a < id_b ? id_a : id_b, second = id_a < id_b ? id_b : id_a;
    size_t k = lower_bound(list, first, second);
    if (k == list->count || list->member[k].first != first || list->member[k].second != second) return SIZE_MAX;
    return k;
}

void scree_persistent_branch(const scree_state *state, const scree_persistent_member *member, scree_vector branch)
{
    const scree_periodic_cell *cell = scree_cell(state);
    scree_vector from, to, shift = {0}, by;
    double inverse[9], fraction[3];
    scree_body_position(state, scree_state_row_of(state, member->first), from);
    scree_body_position(state, scree_state_row_of(state, member->second), to);
    for (int k = 0; k < 3; k++) branch[k] = to[k] - from[k];
    if (!cell->directions) return;
    scree_matrix_invert(cell->lattice, inverse);
    scree_matrix_apply(inverse, branch, fraction);
    for (int k = 0; k < 3; k++)
        if (scree_periodic_repeats(cell, k)) shift[k] = -rint(fraction[k]);
    scree_matrix_apply(cell->lattice, shift, by);
    for (int k = 0; k < 3; k++) branch[k] += by[k];
}

/// Until the next evaluation says better.
static void widen_bounds(const scree_state *state, own *list, const scree_persistent_member *member)
{
    scree_vector branch;
    scree_persistent_branch(state, member, branch);
    double overlap = scree_body_bounding_radius(state, scree_state_row_of(state, member->first)) +
                     scree_body_bounding_radius(state, scree_state_row_of(state, member->second)) -
                     scree_length(branch);
    list->largest_deformation = fmax(list->largest_deformation, fabs(overlap - member->constant[SCREE_MEMBER_REST]));
    list->largest_gap = fmax(list->largest_gap, -overlap);
}

static scree_status refuse(scree_error *error, uint32_t a, uint32_t b, const char *why)
{
    return scree_error_set(error, SCREE_ERROR_INPUT, "bodies %u and %u cannot be held together: %s", a, b, why);
}

scree_status scree_persistent_add(scree_state *state, uint32_t id_a, uint32_t id_b,
                                  const double constant[SCREE_MEMBER_CONSTANTS], scree_error *error)
{
    if (id_a == id_b) return refuse(error, id_a, id_b, "they are one");
    if (scree_state_row_of(state, id_a) == SCREE_NO_ROW || scree_state_row_of(state, id_b) == SCREE_NO_ROW)
        return refuse(error, id_a, id_b, "there is no body with one of these ids");
    if (scree_persistent_find(state, id_a, id_b) != SIZE_MAX) return refuse(error, id_a, id_b, "they are already");
    scree_persistent_member member = {.first = id_a < id_b ? id_a : id_b, .second = id_a < id_b ? id_b : id_a};
    memcpy(member.constant, constant, sizeof member.constant);
    return scree_persistent_merge(state, &member, 1, error);
}

scree_status scree_persistent_merge(scree_state *state, const scree_persistent_member *member, size_t count,
                                    scree_error *error)
{
    own *list = scree_persistent(state);
    scree_status status =
        scree_group_reserve(state, &scree_module_persistent, &scree_persistent_group, list->count + count, error);
    if (status) return status;
    const size_t total = list->count + count;
    size_t left = list->count;
    for (size_t k = count; k-- > 0;) {
        // From behind: those that come after it make their way at once.
        list->count = left;
        const size_t at = lower_bound(list, member[k].first, member[k].second);
        memmove(list->member + at + k + 1, list->member + at, (left - at) * sizeof *list->member);
        list->member[at + k] = member[k];
        list->member[at + k].added = list->changes + 1 + k;
        left = at;
    }
    list->changes += count;
    list->count = total;
    for (size_t k = 0; k < count; k++) widen_bounds(state, list, &member[k]);
    return SCREE_OK;
}

scree_status scree_persistent_remove(scree_state *state, uint32_t id_a, uint32_t id_b, scree_error *error)
{
    size_t k = scree_persistent_find(state, id_a, id_b);
    if (k == SIZE_MAX)
        return scree_error_set(error, SCREE_ERROR_INPUT, "bodies %u and %u are not held together", id_a, id_b);
    scree_persistent_drop(state, &k, 1);
    return SCREE_OK;
}

void scree_persistent_drop(scree_state *state, const size_t *number, size_t count)
{
    own *list = scree_persistent(state);
    if (count == 0) return;
    size_t to = number[0];
    for (size_t k = 0; k < count; k++) {
        const size_t begin = number[k] + 1, end = k + 1 < count ? number[k + 1] : list->count;
        memmove(list->member + to, list->member + begin, (end - begin) * sizeof *list->member);
        to += end - begin;
    }
    list->count = to;
    list->changes += count;
}

/// With a body go the pairs that it is in.
static void forget(scree_state *state, uint32_t id)
{
    own *list = scree_persistent(state);
    size_t kept = 0;
    for (size_t k = 0; k < list->count; k++)
        if (list->member[k].first != id && list->member[k].second != id) list->member[kept++] = list->member[k];
    list->changes += list->count - kept;
    list->count = kept;
}

static scree_status check(const scree_state *state, const scree_model *model, scree_error *error)
{
    const own *list = scree_persistent(state);
    if (list->count > 0 && !scree_model_holds(model))
        return scree_error_set(error, SCREE_ERROR_IO,
                               "dataset 'persistent/first': %zu pairs are held, for which the case has no law",
                               list->count);
    for (size_t k = 0; k < list->count; k++) {
        const scree_persistent_member *member = &list->member[k];
        if (member->second <= member->first || (k > 0 && !comes_before(member - 1, member->first, member->second)))
            return scree_error_set(error, SCREE_ERROR_IO,
                                   "dataset 'persistent/second', held pair %zu of bodies %u and %u: the same body, a "
                                   "pair that is there twice, or not in the order of ids",
                                   k, member->first, member->second);
    }
    return SCREE_OK;
}

/// Of each held pair its ids and what its law declares for it.
static uint64_t checksum(const scree_model *model, const scree_state *state, uint64_t c)
{
    const own *list = scree_persistent(state);
    (void)model;
    if (list->count == 0) return c;
    c = scree_checksum_word(c, list->count);
    for (size_t k = 0; k < list->count; k++) {
        double value[SCREE_CHECKSUM_VALUES];
        size_t count = scree_remembered_values(state, SCREE_LIST_PERSISTENT, k, value);
        c = scree_checksum_word(scree_checksum_word(c, list->member[k].first), list->member[k].second);
        c = scree_checksum_numbers(c, value, count);
    }
    return c;
}

const scree_module scree_module_persistent = {
    .name = "persistent",
    .meaning = "pairs of bodies that are held together, whatever their distance",
    .state_size = sizeof(own),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .check = check,
    .checksum = checksum,
    .forget = forget,
    .spreads = true,
};
