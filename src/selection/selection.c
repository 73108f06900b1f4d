/// Finding selections, and who belongs to them. Cost: one pass over the bodies a selection, once.
#include "selection/selection.h"

#include "base/checksum.h"
#include "case/check.h"
#include "state/body.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef scree_selections own;

/// What acts on a selection must have something to act on. key: of the selection; "": it is none of them.
static scree_status refuse(const scree_model *model, int64_t index, const char *key, const char *why,
                           scree_error *error)
{
    const scree_config_selection *selection = &model->selections[index];
    scree_status status = scree_error_set(error, SCREE_ERROR_INPUT, "selection '%s' (%s) %s", selection->name,
                                          scree_modules[selection->kind]->name, why);
    return scree_error_key(error, status, "selections.%lld%s%.60s", (long long)index, key[0] ? "." : "", key);
}

/// It has no particle: where those of the sample are.
static scree_status refuse_empty(const scree_model *model, const scree_state *state, int64_t index, scree_error *error)
{
    char why[256] = "has no particle: give it some of those that there are now, whose centres lie in";
    scree_vector place, low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t row = 0; row < state->count; row++) {
        if (!scree_body_is_grain(state, row)) continue;
        scree_body_position(state, row, place);
        for (int k = 0; k < state->dimension; k++) {
            low[k] = fmin(low[k], place[k]);
            high[k] = fmax(high[k], place[k]);
        }
    }
    for (int k = 0; k < state->dimension; k++) {
        size_t length = strlen(why);
        (void)snprintf(why + length, sizeof why - length, "%s %c %.4g to %.4g m", k > 0 ? "," : "", "xyz"[k], low[k],
                       high[k]);
    }
    return refuse(model, index, "", why, error);
}

static void enlist(scree_state *state, int64_t index, size_t row, bool belongs)
{
    if (belongs && scree_body_is_grain(state, row)) scree_selections_of(state)->member[row] |= UINT32_C(1) << index;
}

static scree_status find(const scree_model *model, scree_state *state, int64_t index, scree_error *error);

/// From others, which are found first; the rules of the case have seen to it that this ends.
static scree_status find_combination(const scree_model *model, scree_state *state, int64_t index, scree_error *error)
{
    const scree_config_selection *selection = &model->selections[index];
    uint32_t parts = 0;
    for (const scree_node *name = scree_selection_parts(selection)->first; name; name = name->next) {
        int64_t part = scree_config_selection_find(model->selections, model->selection_count, name->text);
        scree_status status = find(model, state, part, error);
        if (status) return status;
        parts |= UINT32_C(1) << part;
    }
    for (size_t row = 0; row < state->count; row++)
        enlist(state, index, row,
               scree_modules[selection->kind]->selection->combine(scree_selections_of(state)->member[row], parts));
    return SCREE_OK;
}

static scree_status find_kind(const scree_model *model, scree_state *state, int64_t index, scree_error *error)
{
    const scree_config_selection *selection = &model->selections[index];
    uint8_t *chosen;
    scree_error reason = {0};
    scree_status status = scree_allocate(&chosen, state->count + 1, sizeof *chosen, error);
    if (status) return status;
    status = scree_modules[selection->kind]->selection->choose(model, state, selection->own, chosen, &reason);
    for (size_t row = 0; row < state->count && !status; row++) enlist(state, index, row, chosen[row]);
    scree_release(&chosen);
    if (status == SCREE_ERROR_IO && error) *error = reason;
    return status == SCREE_OK || status == SCREE_ERROR_IO ? status
                                                          : refuse(model, index, reason.field, reason.message, error);
}

static scree_status find(const scree_model *model, scree_state *state, int64_t index, scree_error *error)
{
    own *selections = scree_selections_of(state);
    if (selections->resolved >> index & 1) return SCREE_OK;
    bool combined = scree_modules[model->selections[index].kind]->selection->combine != NULL;
    scree_status status =
        combined ? find_combination(model, state, index, error) : find_kind(model, state, index, error);
    if (!status) selections->resolved |= UINT64_C(1) << index;
    return status;
}

static const scree_field fields[] = {
    SCREE_FIELD_ONE(selections, own, resolved, "selections/resolved", SCREE_FIELD_UINT64, 1, "1",
                    "bit k: selection k of the case has been found"),
    SCREE_FIELD_BODY(selections, own, member, uint32_t, "selections/member", SCREE_FIELD_UINT32, 1, "1",
                     "bit k: the body belongs to selection k of the case", .optional = true),
};

scree_status scree_selection_resolve(const scree_model *model, scree_state *state, int64_t index, scree_error *error)
{
    if (scree_selections_of(state)->resolved >> index & 1) return SCREE_OK;
    scree_status status = scree_state_begin_field(state, &fields[1], error);
    if (!status) status = find(model, state, index, error);
    for (size_t row = 0; row < state->count && !status; row++)
        if (scree_selection_has(state, index, row)) return SCREE_OK;
    return status ? status : refuse_empty(model, state, index, error);
}

/// Who belongs to what, of the bodies that belong to something.
static uint64_t checksum(const scree_model *model, const scree_state *state, uint64_t c)
{
    const own *selections = scree_selections_of(state);
    size_t next = 0;
    (void)model;
    if (!selections->resolved) return c;
    c = scree_checksum_word(c, selections->resolved);
    for (uint32_t row; (row = scree_next_by_id(state, &next)) != SCREE_NO_ROW;)
        if (selections->member[row])
            c = scree_checksum_word(scree_checksum_word(c, state->id[row]), selections->member[row]);
    return c;
}

const scree_module scree_module_selections = {
    .name = "selections",
    .meaning = "who belongs to the selections of the case",
    .state_size = sizeof(own),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .checksum = checksum,
};
