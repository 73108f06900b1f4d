/// Initial assemblies: radii, places by one of the methods, and the state that a run starts from.
///
/// Positions and radii are pure functions of (case, seed), by arithmetic that is exact to the same bit on every
/// machine.
#include "prepare/methods.h"

#include "base/random.h"
#include "state/cell.h"

#include <math.h>
#include <stdio.h>

const scree_preparation *scree_preparation_get(scree_prepare_method method)
{
    switch (method) {
    case SCREE_PREPARE_DROP_AND_ROLL:
        return &scree_prepare_drop_and_roll;
    case SCREE_PREPARE_HEXAGONAL:
        return &scree_prepare_hexagonal;
    case SCREE_PREPARE_SQUARE:
        return &scree_prepare_square;
    case SCREE_PREPARE_GAS:
        return &scree_prepare_gas;
    }
    return NULL;
}

scree_status scree_prepare_error(scree_error *error, const scree_model *model, const scree_config_stage *stage,
                                 const char *key, const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    scree_status status = scree_error_set(error, SCREE_ERROR_INPUT, "%s", text);
    if (!error) return status;
    for (int64_t i = 0; i < model->config->stage_count; i++)
        if (stage == &model->config->stages[i])
            (void)snprintf(error->field, sizeof error->field, "stages.%lld.%s", (long long)i, key);
    return status;
}

void scree_draw_radii(const scree_model *model, double *radius, size_t count)
{
    uint64_t seed = (uint64_t)model->config->seed;
    double least = model->radius_min, span = model->radius_max - model->radius_min;
    bool two_sizes = model->config->particles.distribution == SCREE_SIZE_TWO_SIZES;
    for (size_t i = 0; i < count; i++) {
        double u = scree_random_uniform(seed, SCREE_RANDOM_RADIUS, i);
        radius[i] = least + span * (two_sizes ? u >= 0.5 : u);
    }
}

static void fill_rows(const scree_model *model, const scree_packing *packing, scree_state *state)
{
    int material = scree_model_particle_material(model);
    for (size_t i = 0; i < state->count; i++) {
        double radius = packing->radius[i];
        state->row[i] = (scree_row){
            .x = packing->x[i],
            .y = packing->y[i],
            .material = material,
            .radius = radius,
            .mass = model->density[material] * M_PI * radius * radius * model->thickness,
        };
        scree_body_place(state, i, state->reference[i]);
    }
}

static void stand_walls(const scree_model *model, const scree_box *box, scree_state *state)
{
    int material = scree_model_particle_material(model);
    state->wall[SCREE_WALL_BOTTOM] = (scree_wall){.normal = {0, 1}, .position = 0};
    state->wall[SCREE_WALL_TOP] = (scree_wall){.normal = {0, -1}, .position = -box->height};
    state->wall[SCREE_WALL_LEFT] = (scree_wall){.normal = {1, 0}, .position = 0};
    state->wall[SCREE_WALL_RIGHT] = (scree_wall){.normal = {-1, 0}, .position = -box->width};
    for (int w = 0; w <= SCREE_WALL_RIGHT; w++) {
        state->wall[w].active = 1;
        state->wall[w].material = material;
    }
    // No walls where the sample repeats itself.
    if (box->periodic & 1) state->wall[SCREE_WALL_LEFT].active = state->wall[SCREE_WALL_RIGHT].active = 0;
    if (box->periodic & 2) state->wall[SCREE_WALL_BOTTOM].active = state->wall[SCREE_WALL_TOP].active = 0;
    if (box->periodic) scree_cell_set(&state->cell, box->periodic, (const double[3]){box->width, box->height, 1});
}

scree_status scree_prepare(const scree_model *model, const scree_config_stage *stage, scree_state *state,
                           scree_error *error)
{
    const scree_preparation *method = scree_preparation_get((scree_prepare_method)stage->method);
    size_t count = (size_t)model->config->particles.count;
    unsigned periodic = (unsigned)model->config->boundary.periodic;
    if (periodic && !method->periodic)
        return scree_prepare_error(error, model, stage, "method",
                                   "%s needs side walls and cannot fill a periodic cell: prepare with gas, hexagonal "
                                   "or square, and confine",
                                   method->name);
    scree_status status = scree_state_create(state, model->dimension, count, error);
    if (status) return status;
    scree_packing packing = {.count = count, .box = {.width = stage->width, .periodic = periodic}};
    status = scree_allocate(&packing.radius, count, sizeof(double), error);
    if (!status) status = scree_allocate(&packing.x, count, sizeof(double), error);
    if (!status) status = scree_allocate(&packing.y, count, sizeof(double), error);
    if (!status) {
        scree_draw_radii(model, packing.radius, count);
        status = method->place(model, stage, &packing, error);
    }
    if (!status) {
        fill_rows(model, &packing, state);
        stand_walls(model, &packing.box, state);
        state->step_size = model->step;
        if (method->set_moving) method->set_moving(model, stage, state);
    }
    scree_release(&packing.radius);
    scree_release(&packing.x);
    scree_release(&packing.y);
    if (status) scree_state_destroy(state);
    return status;
}
