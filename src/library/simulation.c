/// The public handle of a simulation: its life, its time, what it is saved to and restored from.
#include "library/handle.h"

#include "io/state_file.h"
#include "run/loading.h"
#include "run/own_force.h"
#include "run/restart.h"
#include "search/neighbours.h"

scree_status scree_simulation_create(const scree_case *c, int threads, scree_simulation **out, scree_error *error)
{
    scree_handle_check(c, "a case");
    scree_status status = scree_allocate(out, 1, sizeof **out, error);
    if (status) return status;
    status = scree_simulation_open(c, threads, *out, error);
    if (status) {
        scree_simulation_close(*out);
        scree_release(out);
        return status;
    }
    scree_handle_made(*out);
    return SCREE_OK;
}

void scree_simulation_free(scree_simulation *s)
{
    if (!s) return;
    scree_handle_freed(s, "a simulation");
    scree_simulation_close(s);
    scree_release(&s);
}

// ---- time --------------------------------------------------------------------------------------------------------

static bool has_ended(const scree_simulation *s)
{
    return s->state.stage.index >= s->model.stage_count;
}

/// The same, or its last stage has.
static bool is_at_end(const scree_simulation *s)
{
    bool last = s->state.stage.index + 1 == s->model.stage_count;
    return has_ended(s) || (last && s->state.stage.counter == SCREE_STAGE_ENDED);
}

/// What has stopped a simulation stops it again.
static scree_status may_step(const scree_simulation *s, scree_error *error)
{
    scree_status status = handle_refuse_inside(s, error);
    if (!status && s->stopped.status && error) *error = s->stopped;
    return status ? status : s->stopped.status;
}

static scree_status step(scree_simulation *s, scree_error *error)
{
    scree_status status = scree_simulation_step(s, &s->stopped);
    s->stopped.status = status;
    if (status && error) *error = s->stopped;
    return status;
}

scree_status scree_simulation_advance(scree_simulation *s, uint64_t steps, bool *done, scree_error *error)
{
    scree_status status = may_step(s, error);
    uint64_t target = s->state.evaluations + steps;
    *done = has_ended(s);
    // What follows a stage that has ended is no step.
    while (!status && !*done && (s->state.evaluations < target || s->stage_ended)) {
        status = step(s, error);
        *done = has_ended(s);
    }
    return status;
}

scree_status scree_simulation_advance_stage(scree_simulation *s, bool *done, scree_error *error)
{
    scree_status status = may_step(s, error);
    bool ended = *done = is_at_end(s);
    while (!status && !ended) {
        status = step(s, error);
        ended = s->stage_ended || has_ended(s);
    }
    *done = is_at_end(s);
    return status;
}

scree_status scree_simulation_advance_within_stage(scree_simulation *s, uint64_t steps, bool *ended, scree_error *error)
{
    scree_status status = may_step(s, error);
    uint64_t target = s->state.evaluations + steps;
    *ended = is_at_end(s);
    while (!status && !*ended && s->state.evaluations < target) {
        status = step(s, error);
        *ended = s->stage_ended || has_ended(s);
    }
    return status;
}

int scree_simulation_dimension(const scree_simulation *s)
{
    handle_assert(s);
    return s->model.dimension;
}

double scree_simulation_time(const scree_simulation *s)
{
    handle_assert(s);
    return scree_state_time(&s->state);
}

uint64_t scree_simulation_steps(const scree_simulation *s)
{
    handle_assert(s);
    return s->state.evaluations;
}

double scree_simulation_step_size(const scree_simulation *s)
{
    handle_assert(s);
    return s->state.step_size > 0 ? s->state.step_size : s->model.step * (double)s->model.largest_step;
}

size_t scree_simulation_bodies(const scree_simulation *s)
{
    handle_assert(s);
    return s->state.count;
}

int64_t scree_simulation_stage(const scree_simulation *s, const char **name)
{
    handle_assert(s);
    if (name) *name = NULL;
    if (has_ended(s)) return s->model.stage_count;
    if (name) *name = scree_stage_config(s)->name;
    return s->state.stage.index;
}

double scree_simulation_loading_strain(const scree_simulation *s)
{
    handle_assert(s);
    return s->stage && s->state.count > 0 ? scree_loading_strain(s) : NAN;
}

uint64_t scree_simulation_checksum(scree_simulation *s)
{
    handle_assert(s);
    if (scree_contacts_save(&s->state, &s->work, NULL)) return 0;
    return scree_state_checksum(&s->model, &s->state);
}

// ---- save and restore --------------------------------------------------------------------------------------------

#define GROUP "/state"

scree_status scree_simulation_save(scree_simulation *s, const char *path, scree_error *error)
{
    uint64_t checksum;
    scree_hdf5 file;
    scree_status status = handle_need_bodies(s, error);
    if (!status) status = scree_case_checksum(s->c, &checksum, error);
    if (!status) status = scree_contacts_save(&s->state, &s->work, error);
    if (status) return status;
    scree_own_loads_of(&s->state)->registered = (int64_t)s->forces.count;
    scree_hdf5_create(&file, path, error);
    scree_state_write(&file, GROUP, NULL, &s->state, NULL, checksum);
    return scree_hdf5_save(&file);
}

/// What was saved, into the state of `fresh`, which has none.
static scree_status read_state(scree_simulation *fresh, const char *path, scree_error *error)
{
    uint64_t checksum;
    scree_hdf5 file;
    scree_status status = scree_case_checksum(fresh->c, &checksum, error);
    if (status) return status;
    scree_hdf5_open_checked(&file, path, error);
    scree_state_read(&file, GROUP, NULL, fresh->model.dimension, checksum, &fresh->state);
    status = scree_hdf5_close(&file);
    if (!status) status = scree_restart_check(fresh, &fresh->state, error);
    if (status && error) (void)snprintf(error->file, sizeof error->file, "%s", path);
    const scree_own_loads *loads = status ? NULL : scree_own_loads_of(&fresh->state);
    if (status || loads->registered == (int64_t)fresh->forces.count) return status;
    return scree_error_set(error, SCREE_ERROR_INPUT, "'%s' was saved with %lld own forces, and %zu are registered",
                           path, (long long)loads->registered, fresh->forces.count);
}

/// Makes everything that is not saved.
static scree_status take_up(scree_simulation *fresh, scree_error *error)
{
    bool begun = fresh->state.stage.counter != SCREE_STAGE_NOT_BEGUN;
    scree_status status = scree_neighbours_refresh(&fresh->model, &fresh->state, &fresh->work, error);
    if (!status && begun) status = scree_stage_enter(fresh, true, error);
    fresh->stage_ended = fresh->state.stage.counter == SCREE_STAGE_ENDED;
    return status;
}

scree_status scree_simulation_restore(scree_simulation *s, const char *path, scree_error *error)
{
    scree_simulation fresh, *old = &fresh;
    scree_status status = handle_refuse_inside(s, error);
    if (status) return status;
    status = scree_simulation_open(s->c, s->work.threads, &fresh, error);
    fresh.forces = s->forces;
    if (!status) {
        scree_state_destroy(&fresh.state);
        status = read_state(&fresh, path, error);
    }
    if (!status) status = take_up(&fresh, error);
    if (!status) {
        scree_simulation swapped = *s;
        *s = fresh;
        fresh = swapped;
    }
    old->forces = (scree_own_force_list){0};
    scree_simulation_close(old);
    return status;
}
