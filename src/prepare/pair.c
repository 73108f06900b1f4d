/// Two bodies on the x axis that approach each other: a binary impact.
///
/// Their surfaces are `gap` apart, on the line through both centres; the centre of mass rests, so body 0 moves with
/// speed m_1 / (m_0 + m_1) to the right and body 1 with the rest to the left. Automatic values: the speed is the
/// characteristic velocity v_R (P 2.3), the gap (m_eff v^2 / K)^(2/5), the length of an elastic impact.
#include "module/key_rows.h"
#include "prepare/methods.h"
#include "prepare/prepare.h"

#include <math.h>

typedef struct config {
    double gap;   ///< m, between the surfaces; auto: see above
    double speed; ///< m/s, at which they approach; auto: v_R
} config;
static const scree_key keys[] = {
    NUMBER(config, gap, "m", .standard = "auto", FROM("0 m"), TO("1 km"), .when = "method=pair",
           .meaning = "Between the surfaces of the two; auto: about their overlap in the impact."),
    NUMBER(config, speed, "m/s", .standard = "auto", ABOVE("0 m/s"), TO("1e5 m/s"), .when = "method=pair",
           .meaning = "Relative speed at which they approach; auto: contact.reference_velocity."),
};

static const config *own_config(const scree_config_stage *stage)
{
    return scree_config_own(&scree_module_pair, "stages.prepare", stage->own);
}

static double speed_of(const scree_model *model, const scree_config_stage *stage)
{
    double given = own_config(stage)->speed;
    return isnan(given) ? model->reference_velocity : given;
}

static scree_status place(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                          scree_error *error)
{
    double speed = speed_of(model, stage), a = packing->radius[0], b = packing->radius[1], largest = fmax(a, b);
    if (!(speed > 0))
        return scree_prepare_error(error, model, stage, "speed",
                                   "without a reference velocity auto is no speed: give one, or "
                                   "contact.reference_velocity");
    const int first = model->species[packing->species[0]].material, last = model->species[packing->species[1]].material;
    double one = scree_model_mass(model, first, a), other = scree_model_mass(model, last, b);
    double mass = one * other / (one + other);
    double gap = own_config(stage)->gap;
    if (isnan(gap))
        gap = scree_law_get(scree_model_law_between(model, first, last)->law)
                  ->elastic->impact_length(&model->pairs[first][last], a * b / (a + b), mass, speed);
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

static double impact_speed(const scree_model *model, const scree_config_stage *stage, double fall)
{
    (void)fall;
    return speed_of(model, stage);
}

static const scree_preparation preparation = {
    .binary = true,
    .approaching = true,
    .impact_speed = impact_speed,
    .place = place,
    .set_moving = set_moving,
};

const scree_module scree_module_pair = {
    .name = "pair",
    .meaning = "two particles on the x axis that approach each other, for the stage collide",
    .choice_of = CHOICE_OF(IS("stages.prepare.method")),
    .keys = (const scree_keys[]){KEYS_OF("stages.prepare", keys, config)},
    .keys_count = 1,
    .preparation = &preparation,
};
