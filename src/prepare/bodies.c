/// The particles that the case lists, each at its position with its velocity, spin, radius and material.
///
/// The box begins at the origin; sides that are not given reach as far as the bodies do. Nothing is drawn at random.
#include "prepare/methods.h"

#include <math.h>

static scree_status place(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                          scree_error *error)
{
    if (packing->count != (size_t)stage->body_count)
        return scree_prepare_error(error, model, stage, "bodies", "%lld bodies are listed, and the sample has %zu",
                                   (long long)stage->body_count, packing->count);
    double reach[3] = {0};
    for (size_t i = 0; i < packing->count; i++) {
        const scree_config_body *body = &stage->bodies[i];
        packing->radius[i] = scree_config_body_radius(model->config, body);
        for (int c = 0; c < packing->dimension; c++) {
            packing->place[c][i] = body->position[c];
            reach[c] = fmax(reach[c], body->position[c] + packing->radius[i]);
        }
    }
    scree_box *box = &packing->box;
    if (isnan(box->width)) box->width = reach[0];
    if (packing->dimension == 3 && isnan(box->depth)) box->depth = reach[1];
    box->height = isnan(stage->height) ? reach[packing->dimension - 1] : stage->height;
    return SCREE_OK;
}

static int material_of(const scree_model *model, const scree_config_stage *stage, size_t index)
{
    return scree_model_body_material(model, &stage->bodies[index]);
}

static void set_moving(const scree_model *model, const scree_config_stage *stage, scree_state *state)
{
    (void)model;
    for (size_t i = 0; i < state->count; i++) {
        const scree_config_body *body = &stage->bodies[i];
        scree_row *row = &state->row[i];
        row->vx = body->velocity[0];
        row->vy = body->velocity[1];
        if (state->dimension == 2) {
            row->spin = body->spin[2];
            continue;
        }
        row->vz = body->velocity[2];
        state->turn[i].wx = body->spin[0];
        state->turn[i].wy = body->spin[1];
        state->turn[i].wz = body->spin[2];
    }
}

const scree_preparation scree_prepare_bodies = {
    .name = "bodies",
    .meaning = "particles at given positions with given velocities",
    .periodic = true,
    .place = place,
    .material_of = material_of,
    .set_moving = set_moving,
};
