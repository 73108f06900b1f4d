/// The specimen of a simulation: where to find it, and the operator that it is.
#include "library/specimen.h"

#include "library/handle.h"
#include "run/restart.h"
#include "search/neighbours.h"
#include "specimen/from_state.h"

#include <string.h>

// ---- where it stands ---------------------------------------------------------------------------------------------

static scree_status read_newest(const char *directory, scree_simulation *s, scree_error *error)
{
    uint64_t checksum;
    scree_restart_point point;
    scree_notes notes = {0};
    scree_status status = scree_case_checksum(s->c, &checksum, error);
    if (!status) status = scree_restart_read(s, directory, NULL, checksum, &point, &notes, error);
    if (!status && s->state.count > 0) status = scree_neighbours_refresh(&s->model, &s->state, &s->work, error);
    if (!status && s->state.stage.counter >= 0) status = scree_stage_enter(s, true, error);
    return status;
}

scree_status scree_simulation_open_run(const char *directory, scree_case **c, scree_simulation **out,
                                       scree_error *error)
{
    *out = NULL;
    *c = NULL;
    scree_status status = scree_restart_case(directory, c, error);
    if (!status) status = scree_simulation_create(*c, 1, out, error);
    if (!status) status = read_newest(directory, *out, error);
    if (!status) return SCREE_OK;
    scree_simulation_free(*out);
    scree_case_free(*c);
    *out = NULL;
    *c = NULL;
    return status;
}

/// Index of the stage of this name; -1: there is none.
static int64_t find_stage(const scree_model *model, const char *name)
{
    for (int64_t k = 0; k < model->stage_count; k++)
        if (strcmp(model->stages[k].name, name) == 0) return k;
    return -1;
}

static scree_status refuse_stage(const scree_simulation *s, const char *name, scree_error *error)
{
    const char *names[64];
    size_t count = 0;
    for (int64_t k = 0; k < s->model.stage_count && count < sizeof names / sizeof *names; k++)
        names[count++] = s->model.stages[k].name;
    const char *nearest = scree_nearest(name, names, count);
    return scree_error_refuse(error, NULL, nearest, "the case has no stage '%s'%s%s%s", name,
                              nearest ? "; did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "");
}

/// The present stage has begun and is the one that is looked for.
static bool stands(const scree_simulation *s, int64_t wanted)
{
    if (s->state.stage.counter < 0 || !s->stage) return false;
    return wanted < 0 ? !s->stage->instant : s->state.stage.index == wanted;
}

scree_status scree_simulation_begin_stage(scree_simulation *s, const char *name, scree_error *error)
{
    scree_status status = handle_refuse_inside(s, error);
    if (status) return status;
    const int64_t wanted = name ? find_stage(&s->model, name) : -1;
    if (name && wanted < 0) return refuse_stage(s, name, error);
    if (name && (s->state.stage.index > wanted || (s->state.stage.index == wanted && s->state.stage.counter > 0)))
        return scree_error_set(error, SCREE_ERROR_INPUT, "the simulation is past the begin of stage '%s'", name);
    while (!status && !stands(s, wanted) && s->state.stage.index < s->model.stage_count) {
        // A preparation is over as soon as it has begun.
        if (s->stage_ended && s->state.stage.index == wanted) break;
        if (s->stage_ended && s->state.stage.index + 1 >= s->model.stage_count) break;
        status = scree_simulation_step(s, error);
    }
    if (status == SCREE_ERROR_INPUT && error && error->field[0] && error->line == 0) scree_case_locate(s->c, error);
    return status;
}

// ---- the operator ------------------------------------------------------------------------------------------------

scree_status library_specimen(scree_simulation *s, const scree_particle_elasticity *elasticity,
                              scree_specimen *specimen, scree_error *error)
{
    *specimen = (scree_specimen){0};
    scree_status status = handle_need_bodies(s, error);
    if (!status && elasticity && !scree_elasticity_is_stable(elasticity->young_modulus, elasticity->poisson_ratio))
        status = scree_error_set(error, SCREE_ERROR_INPUT,
                                 "particles of Young's modulus %g Pa and Poisson's ratio %g do not exist: give a "
                                 "modulus above 0 and a ratio between -1 and 0.5, both excluded",
                                 elasticity->young_modulus, elasticity->poisson_ratio);
    if (!status) status = scree_neighbours_refresh(&s->stage_model, &s->state, &s->work, error);
    if (!status) status = scree_specimen_of_state(&s->stage_model, &s->state, &s->work, specimen, error);
    if (status || !elasticity) return status;
    specimen->condition = s->model.dimension == 3 ? SCREE_SOLID : SCREE_PLANE_STRAIN;
    scree_specimen_deform(
        specimen, scree_compliance_of(specimen->condition, elasticity->young_modulus, elasticity->poisson_ratio));
    return SCREE_OK;
}
