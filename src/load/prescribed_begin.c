/// Who is prescribed what: settled when a stage begins. Selections are found here, when they are needed first.
#include "integrate/forced_spin.h"
#include "load/prescribed.h"
#include "selection/selection.h"
#include "state/fields.h"

#include <stdio.h>
#include <string.h>

/// Of a component, as a motion and as a push.
static const char *const motions[] = {"velocity x", "velocity y", "velocity z", "spin x", "spin y", "spin z"};
static const char *const pushes[] = {
    "force x", "force y", "force z", "torque x", "torque y", "torque z", "point that forces act on"};

bool scree_prescribed_drives(const scree_prescribed_config *own, int component)
{
    const double *row = &own->gradient[3 * (component % 3)];
    bool linear = component < 3 && !(isnan(row[0]) && isnan(row[1]) && isnan(row[2]));
    return linear || !isnan(scree_schedule_at(&own->motion[component], 0));
}

bool scree_prescribed_pushes(const scree_prescribed_config *own, int component)
{
    return !isnan(scree_schedule_at(&own->push[component], 0));
}

static bool acts_now(const scree_context *c, int64_t load)
{
    const scree_prescribed_config *own = scree_prescribed_config_of(c->model->loads, load);
    return own && scree_load_acts(c->model, c->state, own->from, own->until);
}

bool scree_prescribed_begins_whole(const scree_context *c)
{
    for (int64_t i = 0; i < c->model->load_count; i++)
        if (scree_prescribed_config_of(c->model->loads, i)) return true;
    return false;
}

/// Where an error that has been set stands in the case.
static scree_status refuse(int64_t load, scree_error *error, scree_status status)
{
    return scree_error_key(error, status, "loads.%lld", (long long)load);
}

/// Two loads meet in a component of a body. held: the first one prescribes its motion; drives: the second one does.
static scree_status refuse_both(const scree_context *c, int64_t first, int64_t second, size_t row, int component,
                                bool held, bool drives, scree_error *error)
{
    const char *one = scree_prescribed_name(scree_prescribed_config_of(c->model->loads, first));
    const char *other = scree_prescribed_name(scree_prescribed_config_of(c->model->loads, second));
    const unsigned id = c->state->id[row];
    scree_status status =
        held == drives
            ? scree_error_set(error, SCREE_ERROR_INPUT,
                              "'%s' and '%s' both prescribe the %s of particle %u: leave it to one of them", one, other,
                              held ? motions[component] : pushes[component], id)
            : scree_error_set(error, SCREE_ERROR_INPUT,
                              "'%s' prescribes the %s of particle %u, so the %s of '%s' would change nothing: leave "
                              "the particle to one of them",
                              held ? one : other, motions[component], id, pushes[component], held ? other : one);
    return refuse(second, error, status);
}

/// A component of a body becomes that of a load.
static scree_status own_component(const scree_context *c, int64_t load, size_t row, int component, bool drives,
                                  scree_error *error)
{
    scree_state *state = c->state;
    uint8_t *owner = &scree_prescribed_of(state)->owner[row][component];
    const bool held = component < SCREE_COMPONENTS && (state->held[row] >> component & 1);
    if (*owner) return refuse_both(c, *owner - 1, load, row, component, held, drives, error);
    *owner = (uint8_t)(load + 1);
    if (drives) state->held[row] |= (uint8_t)(1 << component);
    return SCREE_OK;
}

/// All components of a body that a load says something of.
static scree_status own_body(const scree_context *c, int64_t load, size_t row, scree_error *error)
{
    const scree_prescribed_config *own = scree_prescribed_config_of(c->model->loads, load);
    scree_state *state = c->state;
    scree_status status = SCREE_OK;
    for (int d = 0; d < SCREE_COMPONENTS && !status; d++) {
        const bool ended = d < 3 && scree_prescribed_of(state)->given[load][d] != 0;
        bool drives = scree_prescribed_drives(own, d) && !ended;
        if (!scree_component_exists(state->dimension, d) || !(drives || ended || scree_prescribed_pushes(own, d)))
            continue;
        status = own_component(c, load, row, d, drives, error);
    }
    if (!status && own->attack == SCREE_ATTACK_SURFACE) status = own_component(c, load, row, SCREE_LEVER, false, error);
    bool forced = scree_forced(state)->active && scree_forced(state)->id == state->id[row];
    if (!status && forced && state->held[row] >> 3)
        status = refuse(load, error,
                        scree_error_set(error, SCREE_ERROR_INPUT,
                                        "'%s' prescribes the spin of particle %u, which this stage turns",
                                        scree_prescribed_name(own), state->id[row]));
    return status;
}

static scree_status own_selection(const scree_context *c, int64_t load, scree_error *error)
{
    const scree_prescribed_config *own = scree_prescribed_config_of(c->model->loads, load);
    int64_t selection = scree_config_selection_find(c->model->selections, c->model->selection_count, own->selection);
    scree_status status = scree_selection_resolve(c->model, c->state, selection, error);
    for (size_t row = 0; row < c->state->count && !status; row++)
        if (scree_selection_has(c->state, selection, row)) status = own_body(c, load, row, error);
    return status;
}

/// Room for what there is of each body.
static scree_status begin_fields(scree_state *state, scree_error *error)
{
    size_t count;
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < scree_module_prescribed.field_count && !status; k++)
        if (scree_module_prescribed.fields[k].rows == SCREE_ROWS_BODIES)
            status = scree_state_begin_field(state, &scree_module_prescribed.fields[k], error);
    const scree_field *own = scree_own_fields(&count);
    for (size_t k = 0; k < count && !status; k++)
        if (strcmp(own[k].name, "held") == 0) status = scree_state_begin_field(state, &own[k], error);
    return status;
}

/// Bodies that come to be driven now have their place as reference.
static void refer(scree_state *state, size_t row, uint8_t before)
{
    if (state->held[row] && !before) scree_body_position(state, row, scree_prescribed_of(state)->reference[row]);
}

scree_status scree_prescribed_begin(const scree_context *c, scree_error *error)
{
    scree_state *state = c->state;
    scree_prescribed *all = scree_prescribed_of(state);
    uint8_t *before = NULL;
    if (!scree_prescribed_begins_whole(c)) return SCREE_OK;
    scree_status status = begin_fields(state, error);
    if (!status) status = scree_allocate(&before, state->count + 1, sizeof *before, error);
    if (status) return status;
    memcpy(before, state->held, state->count);
    memset(state->held, 0, state->count);
    memset(all->owner, 0, state->count * sizeof *all->owner);
    for (int64_t load = 0; load < c->model->load_count && !status; load++) {
        bool acts = acts_now(c, load);
        if (acts && !all->acts[load]) {
            all->begun[load] = scree_state_time(state);
            memset(all->given[load], 0, sizeof all->given[load]);
        }
        all->acts[load] = acts;
        if (acts) status = own_selection(c, load, error);
    }
    for (size_t row = 0; row < state->count; row++) refer(state, row, before[row]);
    scree_release(&before);
    return status;
}
