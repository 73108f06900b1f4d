/// Views of the declared fields (state/fields.h), and copies of what is mostly wanted by id.
#include "library/handle.h"

#include "base/memory_hold.h"
#include "state/fields.h"

#include <string.h>

/// A view copies nothing: what contacts of several laws remember, each in its own place, is no array.
static bool is_seen(const scree_state *state, const scree_field *field)
{
    return scree_field_is_here(state, field) && !scree_field_is_shared(state, field);
}

/// The field of this name that the state has.
static const scree_field *find(const scree_simulation *s, const char *name)
{
    for (size_t k = 0; k < scree_field_total(); k++) {
        const scree_field *field = scree_field_at(k);
        if (is_seen(&s->state, field) && strcmp(field->name, name) == 0) return field;
    }
    return NULL;
}

const char *scree_simulation_view_name(const scree_simulation *s, size_t index)
{
    handle_assert(s);
    for (size_t k = 0; k < scree_field_total(); k++) {
        const scree_field *field = scree_field_at(k);
        if (is_seen(&s->state, field) && index-- == 0) return field->name;
    }
    return NULL;
}

/// A name that ends in `text` behind its last word: "scheme_velocity" for "velocity".
static const char *longer(const scree_simulation *s, const char *text)
{
    size_t length = strlen(text);
    const char *name;
    for (size_t k = 0; length > 0 && (name = scree_simulation_view_name(s, k)); k++) {
        size_t whole = strlen(name);
        if (whole > length && strchr("_/", name[whole - length - 1]) && strcmp(name + whole - length, text) == 0)
            return name;
    }
    return NULL;
}

/// There is no such field; says which is the nearest.
static scree_status refuse(const scree_simulation *s, const char *name, scree_error *error)
{
    enum { MOST = 512 };
    const char *names[MOST];
    size_t count = 0;
    while (count < MOST && (names[count] = scree_simulation_view_name(s, count))) count++;
    for (size_t k = 0; k < scree_field_total(); k++)
        if (strcmp(scree_field_at(k)->name, name) == 0 && scree_field_is_shared(&s->state, scree_field_at(k)))
            return scree_error_set(error, SCREE_ERROR_INPUT,
                                   "'%s' cannot be seen as an array: contacts follow several laws, and each has it in "
                                   "a place of its own; files have it, and without contact.pairs it can be seen",
                                   name);
    const char *nearest = scree_nearest(name, names, count);
    if (!nearest) nearest = longer(s, name);
    scree_status status = scree_error_set(error, SCREE_ERROR_INPUT, "there is no field '%s' in %d dimensions%s%s%s",
                                          name, s->model.dimension, nearest ? "; did you mean '" : "",
                                          nearest ? nearest : "", nearest ? "'?" : "");
    if (error && nearest) (void)snprintf(error->accepted, sizeof error->accepted, "%s", nearest);
    if (error) (void)snprintf(error->value, sizeof error->value, "%s", name);
    return status;
}

/// How far behind the present time the values of a field are [s].
static double lag_of(const scree_simulation *s, const scree_field *field)
{
    if (strcmp(field->name, "scheme_velocity") != 0 && strcmp(field->name, "scheme_spin") != 0) return 0;
    double lead = s->forces.called ? 0 : s->integrator->velocity_lead;
    return (0.5 - lead) * s->state.step_size;
}

static scree_status view_field(scree_simulation *s, const scree_field *field, scree_view *view, scree_error *error)
{
    if (field->rows == SCREE_ROWS_CONTACTS || field->law) {
        scree_status status = scree_contacts_save(&s->state, &s->work, error);
        if (status) return status;
    }
    *view = (scree_view){.count = scree_field_rows_count(&s->state, field),
                         .components = scree_components(field->components, s->model.dimension),
                         .type = field->type,
                         .stride = field->stride,
                         .time = scree_state_time(&s->state) - lag_of(s, field),
                         .unit = field->unit,
                         .meaning = field->meaning};
    if (view->count > 0) view->data = scree_field_get(&s->state, field, 0);
    return SCREE_OK;
}

scree_status scree_simulation_view(scree_simulation *s, const char *name, scree_view *view, scree_error *error)
{
    handle_assert(s);
    *view = (scree_view){0};
    const scree_field *field = find(s, name);
    return field ? view_field(s, field, view, error) : refuse(s, name, error);
}

/// The block of memory that a field lies in: an array, the struct of a module, or the simulation itself.
static void *block_of(scree_simulation *s, const scree_field *field)
{
    unsigned char *array = scree_field_array(&s->state, field), *block = array - field->array_offset;
    if (scree_field_is_array(field)) memcpy(&block, array, sizeof block);
    return block == (unsigned char *)&s->state ? (void *)s : block;
}

scree_status scree_simulation_keep_view(scree_simulation *s, const char *name, scree_view *view, scree_keeper **keeper,
                                        scree_error *error)
{
    *keeper = NULL;
    scree_status status = scree_simulation_view(s, name, view, error);
    if (status || !view->data) return status;
    *keeper = block_of(s, find(s, name));
    scree_memory_hold(*keeper);
    return SCREE_OK;
}

void scree_keeper_free(scree_keeper *keeper)
{
    scree_release(&keeper);
}

void scree_simulation_copy(const scree_simulation *s, double *position, double *velocity, double *spin)
{
    handle_assert(s);
    const scree_state *state = &s->state;
    const size_t components = (size_t)state->dimension, turns = state->dimension == 3 ? 3 : 1;
    size_t next = 0;
    for (size_t k = 0; k < state->count; k++) {
        scree_vector place, speed, turn;
        size_t row = scree_next_by_id(state, &next);
        scree_body_position(state, row, place);
        if (s->forces.called)
            scree_body_velocity_so_far(&s->stage_model, state, row, speed, turn);
        else
            scree_body_velocity(&s->stage_model, state, row, speed, turn);
        if (position) memcpy(position + components * k, place, components * sizeof *place);
        if (velocity) memcpy(velocity + components * k, speed, components * sizeof *speed);
        if (spin) memcpy(spin + turns * k, turn + 3 - turns, turns * sizeof *turn);
    }
}
