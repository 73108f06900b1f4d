/// Cost: linear in the bodies beside walls when some fall asleep or wake; 1 ns a wall in a step.
#include "contact/resting.h"

#include "base/fixed.h"
#include "contact/scalar.h"
#include "state/case_walls.h"

#include <math.h>
#include <string.h>

contact_wall_group contact_wall_group_at(const scree_state *state, const scree_work *work, size_t begin)
{
    const scree_wall_pair_list *pairs = &work->primitive_pairs;
    contact_wall_group group = {.begin = begin, .end = contact_group_end(pairs, begin), .row = pairs->body[begin]};
    const contact_body body = contact_body_get(state, group.row);
    group.body = contact_body_lane(state->dimension, &body);
    contact_primitives_touching(work->wall_set, state->dimension, &group.body, pairs, begin, group.end, &group.touches);
    return group;
}

bool contact_standing_wall(const scree_model *model, const scree_state *state, const scree_work *work,
                           const contact_wall_group *group, int k, contact_quanta *exerted)
{
    const primitive_touch *touch = &group->touches.touch[k];
    const scree_surface *surface = &work->wall_set->surface[touch->surface];
    if (!scree_wall_stands(surface->config)) return false;
    const int material = (int)group->body.material;
    const scree_law_use *law = contact_surface_law(model, surface, material);
    const scree_pair_constants pair = contact_surface_constants(model, surface, material);
    const variant v = {.dimension = state->dimension,
                       .law = law->law,
                       .option = law->option,
                       .many_materials = true,
                       .ledger = true,
                       .geometry = model->geometry};
    kinematics m = kinematics_of_surface(work->wall_set, work->primitive_pairs.wall[touch->pair], v, &group->body,
                                         &touch->closest, false, state->step_size);
    kinematics_hold(&m);
    const contact_scale scale = {.inverse_force = 1 / state->force_quantum,
                                 .inverse_torque = 1 / state->torque_quantum,
                                 .force_limit = INFINITY};
    const law_constants constants = constants_get(&pair, NULL);
    const law_settings settings = law_settings_get(law, 0);
    const memory_rows memory = contact_memory_of(work, CONTACT_ELEMENT, touch->pair);
    law_memory before = memory_get(v, &memory), after;
    *exerted = contact_evaluate(v, &constants, &settings, &scale, &m, ~UINT64_C(0), &before, &after);
    return true;
}

static void add(int64_t *units, double value, double unit)
{
    *units -= llrint(value / unit);
}

/// The opposite of what the body gets.
static void add_load(const scree_state *state, const scree_surface *surface, const bodies *body,
                     const contact_quanta *q, scree_resting_load *load)
{
    const scree_sleep *sleep = scree_sleep_of(state);
    const uint64_t force[3] = {q->force.x, q->force.y, state->dimension == 3 ? q->force.z : 0};
    scree_vector torque;
    contact_surface_torque(state, surface->hub, body, q, torque);
    for (int k = 0; k < 3; k++) {
        add(&load->force[k], scree_fixed_to((int64_t)force[k], state->force_quantum), sleep->force_unit);
        add(&load->torque[k], torque[k], sleep->wall_torque_unit);
    }
}

void contact_sum_resting_loads(const scree_model *model, scree_state *state, const scree_work *work)
{
    scree_sleep *sleep = scree_sleep_of(state);
    const scree_wall_pair_list *pairs = &work->primitive_pairs;
    memset(sleep->wall, 0, sizeof sleep->wall);
    for (size_t begin = 0, end; begin < pairs->count; begin = end) {
        end = contact_group_end(pairs, begin);
        if (!scree_body_sleeps(state, pairs->body[begin])) continue;
        const contact_wall_group group = contact_wall_group_at(state, work, begin);
        contact_quanta exerted;
        for (int k = 0; k < group.touches.count; k++)
            if (contact_standing_wall(model, state, work, &group, k, &exerted)) {
                const int w = group.touches.touch[k].surface;
                add_load(state, &work->wall_set->surface[w], &group.body, &exerted, &sleep->wall[w]);
            }
    }
}

void contact_resting_loads(const scree_state *state, const contact_scale *scale, contact_totals *totals)
{
    const scree_sleep *sleep = scree_sleep_of(state);
    for (int w = 0; w < SCREE_SURFACES && sleep->total > 0; w++)
        for (int k = 0; k < 3; k++) {
            const double force = (double)sleep->wall[w].force[k] * sleep->force_unit,
                         torque = (double)sleep->wall[w].torque[k] * sleep->wall_torque_unit;
            totals->surface_force[w][k] += (uint64_t)scree_fixed_from(force, scale->inverse_force);
            totals->surface_torque[w][k] += (uint64_t)scree_fixed_from(torque, scale->inverse_surface_torque);
        }
}
