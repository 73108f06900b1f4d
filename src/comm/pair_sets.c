#include "comm/pair_sets.h"

#include "state/fields.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

/// The arrays of contacts, which all processes have alike.
static scree_status list_contacts(scree_state *state, const scree_work *work, scree_pair_set *set, scree_error *error)
{
    scree_status status = scree_state_reserve_contacts(state, state->contact_count + 1, error);
    if (!status && work->pairs.last_force) status = scree_state_add_last_force(state, error);
    if (!status && work->pairs.rolling) status = scree_state_add_rolling(state, error);
    if (!status && state->pair_laws > 0) status = scree_state_add_contact_law(state, error);
    const scree_body_array all[] = {{.pointer = &state->contact, .size = sizeof *state->contact},
                                    {.pointer = &state->last_force, .size = sizeof *state->last_force},
                                    {.pointer = &state->rolling, .size = sizeof *state->rolling},
                                    {.pointer = &state->contact_law, .size = sizeof *state->contact_law}};
    *set = (scree_pair_set){.count = &state->contact_count};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        if (*(void **)all[k].pointer) set->list[set->arrays++] = all[k];
    return status;
}

static scree_pair_set set_of_group(const scree_state *state, int slot, const scree_field *field)
{
    unsigned char *own = state->own[slot];
    return (scree_pair_set){.list = {{.pointer = own + field->array_offset, .size = field->stride}},
                            .arrays = 1,
                            .count = (size_t *)(void *)(own + field->group->count_offset),
                            .total = (size_t *)(void *)(own + field->group->total_offset),
                            .owner = scree_modules[slot],
                            .group = field->group};
}

scree_status scree_pair_sets_list(scree_state *state, const scree_work *work, scree_pair_set set[SCREE_PAIR_SETS],
                                  size_t *sets, scree_error *error)
{
    *sets = 0;
    for (int m = 0; m < SCREE_MODULE_COUNT; m++)
        for (size_t k = 0; k < scree_modules[m]->field_count; k++) {
            const scree_field *field = &scree_modules[m]->fields[k];
            if (!field->group || !field->group->pairs) continue;
            if (*sets > 0 && set[*sets - 1].group == field->group) continue;
            assert(*sets < SCREE_PAIR_SETS - 1);
            set[(*sets)++] = set_of_group(state, m, field);
        }
    return list_contacts(state, work, &set[(*sets)++], error);
}

scree_status scree_pair_set_reserve(scree_state *state, const scree_pair_set *set, size_t count, scree_error *error)
{
    if (set->group) return scree_group_reserve(state, set->owner, set->group, count, error);
    return scree_state_reserve_contacts(state, count, error);
}

void scree_pair_set_ids(const scree_pair_set *set, size_t k, uint32_t id[2])
{
    memcpy(id, *(unsigned char **)set->list[0].pointer + k * set->list[0].size, 2 * sizeof *id);
}

bool scree_pair_set_counts(const scree_state *state, const scree_pair_set *set, size_t k)
{
    uint32_t id[2];
    scree_pair_set_ids(set, k, id);
    return scree_state_row_of(state, id[0]) != SCREE_NO_ROW;
}

static int compare(const void *a, const void *b)
{
    uint32_t p[2], q[2];
    memcpy(p, a, sizeof p);
    memcpy(q, b, sizeof q);
    const int end = p[0] == q[0];
    return (p[end] > q[end]) - (p[end] < q[end]);
}

void scree_pair_set_sort(const scree_pair_set *set)
{
    if (set->group && *set->count > 0) qsort(*(void **)set->list[0].pointer, *set->count, set->list[0].size, compare);
}
