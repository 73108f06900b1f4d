/// Initial assemblies: radii, places by one of the methods, and the state that a run starts from.
///
/// Positions and radii are pure functions of (case, seed), by arithmetic that is exact to the same bit on every
/// machine.
#include "prepare/prepare.h"
#include "prepare/methods.h"
#include "state/body.h"
#include "state/plates.h"

#include "state/periodic.h"

#include <math.h>
#include <stdio.h>

static void fill_rows(const scree_model *model, const scree_config_stage *stage, const scree_preparation *method,
                      const scree_packing *packing, scree_state *state)
{
    for (size_t i = 0; i < state->count; i++) {
        int material =
            method->material_of ? method->material_of(model, stage, i) : model->species[packing->species[i]].material;
        double radius = packing->radius[i];
        state->row[i] = (scree_row){
            .x = packing->place[0][i],
            .y = packing->place[1][i],
            .radius = radius,
            .mass = scree_model_mass(model, material, radius),
        };
        if (state->dimension == 3) {
            state->row[i].z = packing->place[2][i];
            state->turn[i].material = material;
        } else
            state->row[i].material = material;
        state->species[i] = packing->species[i];
    }
}

/// Bodies that are not round get the outline that they were drawn with, within the radius that the packing has.
static scree_status dress_rows(const scree_model *model, const scree_packing *packing, scree_state *state,
                               scree_error *error)
{
    scree_status status = SCREE_OK;
    for (size_t i = 0; i < state->count && !status; i++) {
        const scree_species *species = &model->species[packing->species[i]];
        if (species->shape && !species->shape->round)
            status = species->shape->dress(model, species->outline, packing->number[i], state, i, error);
    }
    return status;
}

/// Walls of the box. Those of a round sample say where it is, but do not exist.
static void stand_walls(const scree_model *model, const scree_box *box, bool active, scree_state *state)
{
    const int axis[SCREE_WALL_COUNT] = {state->dimension - 1, state->dimension - 1, 0, 0, 1, 1};
    const double far[SCREE_WALL_COUNT / 2] = {box->height, box->width, box->depth};
    for (int w = 0; w < 2 * state->dimension; w++) {
        scree_wall *wall = &scree_plates(state)[w];
        *wall =
            (scree_wall){.position = w % 2 ? -far[w / 2] : 0, .active = active, .material = model->species[0].material};
        wall->normal[axis[w]] = w % 2 ? -1 : 1;
        // No walls where the sample repeats itself.
        if (box->periodic >> axis[w] & 1) wall->active = 0;
    }
    const double side[3] = {box->width, state->dimension == 3 ? box->depth : box->height, box->height};
    if (box->periodic) scree_periodic_set(scree_cell(state), box->periodic, side);
}

scree_status scree_prepare(const scree_model *model, const scree_config_stage *stage, scree_state *state,
                           scree_error *error)
{
    const scree_prepare_config *prepare = scree_config_prepared(stage);
    const scree_module *module = scree_modules[prepare->method];
    const scree_preparation *method = module->preparation;
    const bool round = prepare->outline != SCREE_SAMPLE_BOX;
    size_t count = method->count ? method->count(model, stage) : model->count;
    unsigned periodic = model->periodic;
    if (periodic && !method->periodic)
        return scree_prepare_error(
            error, model, stage, "method",
            "%s needs walls and cannot fill a periodic cell: prepare with a method that can, and confine",
            module->name);
    scree_status status = scree_state_create(state, model->dimension, count, error);
    if (status) return status;
    scree_packing packing;
    status = scree_packing_create(&packing, model->dimension, count, error);
    if (!status && round)
        status = scree_packing_cut_round(model, stage, method, &packing, error);
    else if (!status) {
        packing.box = (scree_box){.width = prepare->width, .depth = prepare->depth, .periodic = periodic};
        packing.aspect_ratio = prepare->aspect_ratio;
        scree_packing_draw(model, &packing);
        status = method->place(model, stage, &packing, error);
    }
    if (!status) fill_rows(model, stage, method, &packing, state);
    if (!status) status = dress_rows(model, &packing, state, error);
    if (!status) {
        stand_walls(model, &packing.box, !round, state);
        state->tick = model->step;
        state->step_size = state->kick_size = (double)model->largest_step * model->step;
        if (method->set_moving) method->set_moving(model, stage, state);
        if (method->remember) status = method->remember(model, stage, &packing, state, error);
    }
    for (size_t row = 0; row < state->count && !status; row++) scree_body_refer(state, row);
    scree_packing_destroy(&packing);
    if (status) scree_state_destroy(state);
    return status;
}
