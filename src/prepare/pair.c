/// Two bodies on the x axis that approach each other: a binary impact.
///
/// Their surfaces are `gap` apart, on the line through both centres; the centre of mass rests, so body 0 moves with
/// speed m_1 / (m_0 + m_1) to the right and body 1 with the rest to the left. Automatic values: the speed is the
/// characteristic velocity v_R (P 2.3), the gap (m_eff v^2 / K)^(2/5), the length of an elastic impact.
#include "prepare/methods.h"

#include <math.h>

static double speed_of(const scree_model *model, const scree_config_stage *stage)
{
    return isnan(stage->speed) ? model->reference_velocity : stage->speed;
}

static scree_status place(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                          scree_error *error)
{
    double speed = speed_of(model, stage), a = packing->radius[0], b = packing->radius[1], largest = fmax(a, b);
    if (!(speed > 0))
        return scree_prepare_error(error, model, stage, "speed",
                                   "without a reference velocity auto is no speed: give one, or "
                                   "contact.reference_velocity");
    const int material = SCREE_PARTICLE_MATERIAL;
    double one = scree_model_mass(model, material, a), other = scree_model_mass(model, material, b);
    double mass = one * other / (one + other);
    double gap = stage->gap;
    if (isnan(gap))
        gap = scree_model_law(model)->elastic->impact_length(&model->pairs[material][material], a * b / (a + b), mass,
                                                             speed);
    packing->box.width = 3 * (a + b) + gap;
    packing->box.height = packing->box.depth = 4 * largest;
    for (int i = 0; i < packing->dimension; i++) packing->place[i][0] = packing->place[i][1] = 2 * largest;
    packing->place[0][0] = 1.5 * a + 0.5 * b;
    packing->place[0][1] = packing->place[0][0] + a + b + gap;
    return SCREE_OK;
}

static void set_moving(const scree_model *model, const scree_config_stage *stage, scree_state *state)
{
    double speed = speed_of(model, stage), mass = state->row[0].mass + state->row[1].mass;
    state->row[0].vx = speed * state->row[1].mass / mass;
    state->row[1].vx = -speed * state->row[0].mass / mass;
}

const scree_preparation scree_prepare_pair = {
    .name = "pair",
    .meaning = "two particles that approach each other",
    .place = place,
    .set_moving = set_moving,
};
