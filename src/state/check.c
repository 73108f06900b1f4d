/// Ranges of the fields. A field without a row in the table below must be finite; integers of such fields may be any.
/// Cost: one pass over the state, some milliseconds for 10^5 bodies.
#include "state/check.h"
#include "state/body.h"
#include "state/plates.h"

#include "base/matrix.h"
#include "state/fields.h"
#include "state/periodic.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FAR 1e9 /* largest radii */

static double most_of(const scree_field_range *range, const scree_state *state, const scree_model *model)
{
    switch (range->limit) {
    case SCREE_LIMIT_BODY:
        return (double)state->next_id - 1;
    case SCREE_LIMIT_IDS:
        return SCREE_PRIMITIVE_ID;
    case SCREE_LIMIT_LAST_MATERIAL:
        return model->material_count + model->added_materials - 1;
    case SCREE_LIMIT_LARGEST_RADIUS:
        return scree_model_largest_radius(model) * (1 + 1e-9); // round-off of a packing that has grown
    case SCREE_LIMIT_FARTHEST:
        return FAR * scree_model_largest_radius(model);
    case SCREE_LIMIT_STEP:
        return (double)state->step;
    case SCREE_LIMIT_EVALUATIONS:
        return (double)state->evaluations;
    case SCREE_LIMIT_STAGES:
        return (double)model->stage_count;
    case SCREE_LIMIT_MANY:
        return 0x1p53;
    case SCREE_LIMIT_NUMBER:
        return range->most;
    case SCREE_LIMIT_ANY:
        break;
    }
    return DBL_MAX;
}

static double number_of(scree_field_type type, const unsigned char *at)
{
    union {
        double number;
        int64_t integer;
        uint64_t natural;
        float single;
        int32_t small_integer;
        uint32_t small_natural;
        uint8_t byte;
    } value;
    memcpy(&value, at, scree_field_size(type));
    switch (type) {
    case SCREE_FIELD_DOUBLE:
        return value.number;
    case SCREE_FIELD_INT64:
        return (double)value.integer;
    case SCREE_FIELD_UINT64:
        return (double)value.natural;
    case SCREE_FIELD_FLOAT:
        return (double)value.single;
    case SCREE_FIELD_INT32:
        return value.small_integer;
    case SCREE_FIELD_UINT32:
        return value.small_natural;
    case SCREE_FIELD_UINT8:
        break;
    }
    return value.byte;
}

/// What a row of the field is called, and its number.
static const char *row_of(const scree_state *state, const scree_field *field, size_t *row)
{
    switch (field->rows) {
    case SCREE_ROWS_BODIES:
        *row = state->id[*row];
        return "body";
    case SCREE_ROWS_CONTACTS:
        return "contact";
    case SCREE_ROWS_FIXED:
        return "wall";
    default:
        return "row";
    }
}

static scree_status refuse(const scree_state *state, const scree_field *field, size_t row, double value,
                           const char *accepted, scree_error *error)
{
    if (field->rows == SCREE_ROWS_ONE)
        return scree_error_set(error, SCREE_ERROR_IO, "dataset '%s': %.9g (accepted: %s)", field->name, value,
                               accepted);
    const char *kind = row_of(state, field, &row);
    return scree_error_set(error, SCREE_ERROR_IO, "dataset '%s', %s %zu: %.9g (accepted: %s)", field->name, kind, row,
                           value, accepted);
}

/// Whether `value` is inside of the range; without one it must be finite.
static bool is_inside(const scree_field_range *range, double most, double value)
{
    if (range->limit == SCREE_LIMIT_ANY) return isfinite(value);
    if (isnan(value)) return range->undefined;
    if (range->limit == SCREE_LIMIT_LAST_MATERIAL && value != floor(value)) return false;
    double least = range->limit == SCREE_LIMIT_FARTHEST ? -most : range->least;
    return value <= most && (range->open ? value > least : value >= least);
}

static void describe(const scree_field_range *range, double most, char *text, size_t size)
{
    const char *least = range->open ? "more than" : "at least";
    if (range->limit == SCREE_LIMIT_ANY || (range->least == -DBL_MAX && most == DBL_MAX))
        (void)snprintf(text, size, "a finite number");
    else if (most == DBL_MAX)
        (void)snprintf(text, size, "finite, %s %.9g", least, range->least);
    else if (range->limit == SCREE_LIMIT_FARTHEST)
        (void)snprintf(text, size, "at least %.9g, at most %.9g", -most, most);
    else
        (void)snprintf(text, size, "%s%s %.9g, at most %.9g",
                       range->limit == SCREE_LIMIT_LAST_MATERIAL ? "a whole number, " : "", least, range->least, most);
}

int scree_known_body_compare(const void *a, const void *b)
{
    const scree_known_body *p = a, *q = b;
    return (p->id > q->id) - (p->id < q->id);
}

/// The material of the body with this id; negative: there is none.
static int material_of(const scree_state *state, const scree_known_bodies *known, uint32_t id)
{
    if (!known) {
        const uint32_t row = scree_state_row_of(state, id);
        return row == SCREE_NO_ROW ? -1 : scree_body_material(state, row);
    }
    const scree_known_body wanted = {.id = id}, *found = NULL;
    if (known->count > 0) found = bsearch(&wanted, known->body, known->count, sizeof wanted, scree_known_body_compare);
    return found ? found->material : -1;
}

static scree_status check_field(const scree_state *state, const scree_model *model, const scree_known_bodies *known,
                                const scree_field *field, scree_error *error)
{
    const scree_field_range *range = &field->range;
    bool real = field->type == SCREE_FIELD_DOUBLE || field->type == SCREE_FIELD_FLOAT;
    if (!real && range->limit == SCREE_LIMIT_ANY) return SCREE_OK;
    double most = most_of(range, state, model);
    int components = scree_components(field->components, state->dimension);
    const size_t rows = scree_field_rows_count(state, field);
    const bool shared = scree_field_is_shared(state, field);
    const unsigned char *first = rows > 0 && !shared ? scree_field_get(state, field, 0) : NULL;
    for (size_t row = 0; row < rows; row++) {
        const scree_field *declared = shared ? scree_field_of_contact(state, field, row) : field;
        if (!declared) continue;
        const unsigned char *at = shared ? scree_field_get(state, declared, row) : first + row * field->stride;
        for (int k = 0; k < components; k++, at += scree_field_size(declared->type)) {
            double value = number_of(declared->type, at);
            const bool gone = range->limit == SCREE_LIMIT_BODY && value >= 0 && value <= most &&
                              material_of(state, known, (uint32_t)value) < 0;
            if (is_inside(range, most, value) && !gone) continue;
            char accepted[96];
            describe(range, most, accepted, sizeof accepted);
            return gone ? refuse(state, field, row, value, "the id of a body that is here", error)
                        : refuse(state, field, row, value, accepted, error);
        }
    }
    return SCREE_OK;
}

static scree_status refuse_contact(const scree_state *state, size_t k, const char *reason, scree_error *error)
{
    return scree_error_set(error, SCREE_ERROR_IO, "dataset 'contacts/second', contact %zu of body %u: %u %s", k,
                           state->contact[k].first, state->contact[k].second, reason);
}

/// The number of the law that a contact has under the model. Materials of other processes have not been checked here.
static int law_of(const scree_state *state, const scree_model *model, const scree_known_bodies *known,
                  const scree_contact_memory *c)
{
    const int materials = model->material_count + model->added_materials;
    const int first = material_of(state, known, c->first);
    if (first >= materials) return -1;
    if (c->second >= SCREE_WALL_ID) return model->law_of_walls[first];
    if (c->second >= SCREE_PRIMITIVE_ID) return -1; // which wall a primitive is of, the walls themselves say
    const int second = material_of(state, known, c->second);
    return second < materials ? model->law_of_pairs[first][second] : -1;
}

/// What a contact remembers is of the law that it has.
static scree_status check_law(const scree_state *state, const scree_model *model, const scree_known_bodies *known,
                              size_t k, scree_error *error)
{
    const int law = state->pair_laws > 0 ? law_of(state, model, known, &state->contact[k]) : -1;
    if (law < 0 || law == state->contact_law[k]) return SCREE_OK;
    return scree_error_set(
        error, SCREE_ERROR_IO,
        "dataset 'contacts/law', contact %zu of bodies %u and %u: %d (accepted: %d, the law of their "
        "materials)",
        k, state->contact[k].first, state->contact[k].second, state->contact_law[k], law);
}

/// Contacts: pairs of bodies by id, or of a body with a plate or an element of a wall, each once.
static scree_status check_contacts(const scree_state *state, const scree_model *model, const scree_known_bodies *known,
                                   scree_error *error)
{
    for (size_t k = 0; k < state->contact_count; k++) {
        const scree_contact_memory *c = &state->contact[k];
        bool plate = c->second >= SCREE_WALL_ID, element = !plate && c->second >= SCREE_PRIMITIVE_ID;
        if (plate && c->second >= SCREE_WALL_ID + SCREE_WALL_COUNT)
            return refuse_contact(state, k, "is no plate", error);
        if (element && model->wall_count == 0)
            return refuse_contact(state, k, "is of a wall that the case does not have", error);
        if (!plate && !element && (c->second < c->first || material_of(state, known, c->second) < 0))
            return refuse_contact(state, k, "is no body, or one with a lower id", error);
        scree_status status = check_law(state, model, known, k, error);
        if (status) return status;
        if (k == 0) continue;
        const scree_contact_memory *before = c - 1;
        // In a small periodic cell a body may touch several ghosts of another.
        bool again = c->second == before->second && !scree_cell(state)->directions;
        if (before->first > c->first || (before->first == c->first && (before->second > c->second || again)))
            return refuse_contact(state, k, "is there twice, or not in the order of ids", error);
    }
    return SCREE_OK;
}

/// What belongs to the case as a whole.
static scree_status check_frame(const scree_state *state, const scree_model *model, scree_error *error)
{
    if (state->tick != model->step)
        return scree_error_set(
            error, SCREE_ERROR_IO,
            "dataset 'scalars/tick': %.17g (the case has the step %.17g s; with integrator.step=auto "
            "it may depend on guard.overlap)",
            state->tick, model->step);
    return SCREE_OK;
}

/// A field of ids of bodies.
static void name_values(const scree_state *state, const scree_field *field, void (*name)(void *context, uint32_t id),
                        void *context)
{
    const size_t rows = scree_field_rows_count(state, field);
    for (size_t row = 0; row < rows; row++) {
        const double value = number_of(field->type, scree_field_get(state, field, row));
        if (value >= 0 && value < SCREE_PRIMITIVE_ID) name(context, (uint32_t)value);
    }
}

void scree_state_each_named(const scree_state *state, void (*name)(void *context, uint32_t id), void *context)
{
    for (size_t k = 0; k < scree_field_total(); k++) {
        const scree_field *field = scree_field_at(k);
        if (field->range.limit == SCREE_LIMIT_BODY && scree_field_is_stored(state, field))
            name_values(state, field, name, context);
    }
    for (size_t k = 0; k < state->contact_count; k++)
        if (state->contact[k].second < SCREE_PRIMITIVE_ID) name(context, state->contact[k].second);
}

scree_status scree_state_check(const scree_state *state, const scree_model *model, const scree_known_bodies *known,
                               scree_error *error)
{
    // Before the first birth there is none.
    if (scree_state_total(state) == 0 && model->source_count == 0)
        return scree_error_set(error, SCREE_ERROR_IO, "dataset 'position': there is no body");
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < scree_field_total() && !status; k++)
        if (scree_field_is_stored(state, scree_field_at(k)))
            status = check_field(state, model, known, scree_field_at(k), error);
    if (!status) status = check_contacts(state, model, known, error);
    for (int m = 0; m < SCREE_MODULE_COUNT && !status; m++)
        if (scree_modules[m]->check) status = scree_modules[m]->check(state, model, error);
    return status ? status : check_frame(state, model, error);
}
