/// Cost: when some fall asleep or wake 2 ns a pair of neighbours, and, if one of them lies beside a wall, linear in the
/// bodies beside walls; 1 ns a wall in a step.
#include "contact/resting.h"

#include "base/fixed.h"
#include "contact/scalar.h"
#include "contact/single.h"
#include "state/case_walls.h"
#include "state/sleep.h"

#include <math.h>
#include <string.h>

/// The contacts of one body with the elements of the walls.
typedef struct wall_group {
    size_t begin, end; ///< in work->primitive_pairs
    uint32_t row;
    bodies body;
    primitive_touches touches;
} wall_group;

/// The body whose pairs begin at `begin`.
static wall_group wall_group_at(const scree_state *state, const scree_work *work, size_t begin)
{
    const scree_wall_pair_list *pairs = &work->primitive_pairs;
    wall_group group = {.begin = begin, .end = contact_group_end(pairs, begin), .row = pairs->body[begin]};
    const contact_body body = contact_body_get(state, group.row);
    group.body = contact_body_lane(state->dimension, &body);
    contact_primitives_touching(work->wall_set, state->dimension, &group.body, pairs, begin, group.end, &group.touches);
    return group;
}

/// What contact `k` of it exerts on the body, evaluated again with a step of zero; false: its wall can move.
static bool evaluate_standing_wall(const scree_model *model, const scree_state *state, const scree_work *work,
                                   const wall_group *group, int k, contact_quanta *exerted)
{
    const primitive_touch *touch = &group->touches.touch[k];
    const scree_surface *surface = &work->wall_set->surface[touch->surface];
    if (!surface->stands) return false;
    const int material = (int)group->body.material;
    const scree_law_use *law = contact_surface_law(model, surface, material);
    const scree_pair_constants pair = contact_surface_constants(model, surface, material);
    const variant v = {.dimension = state->dimension,
                       .law = law->law,
                       .option = law->option,
                       .many_materials = true,
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

// ---- what bodies exert on each other
// ---------------------------------------------------------------------------------

static void add_units(int64_t *units, uint64_t integer, double quantum, double unit, bool minus)
{
    const int64_t more = llrint((double)(int64_t)integer * (quantum / unit));
    *units += minus ? -more : more;
}

/// What a contact exerts on one of its bodies.
static void add_to_one(scree_state *state, uint32_t row, const contact_quanta *q, bool is_first, bool minus)
{
    const scree_sleep *sleep = scree_sleep_of(state);
    scree_resting *resting = &sleep->resting[row];
    const bool in_3d = state->dimension == 3;
    const quanta force = is_first ? q->force : quanta_opposite(q->force);
    const quanta torque = is_first ? q->torque_first : q->torque_second;
    const uint64_t forces[3] = {force.x, force.y, in_3d ? force.z : 0};
    const uint64_t torques[3] = {in_3d ? torque.x : 0, in_3d ? torque.y : 0, in_3d ? torque.z : torque.x};
    for (int k = 0; k < 3; k++) {
        add_units(&resting->force[k], forces[k], state->force_quantum, sleep->force_unit, minus);
        add_units(&resting->torque[k], torques[k], state->torque_quantum, sleep->torque_unit, minus);
    }
    resting->contacts += minus ? -1 : 1;
}

/// Dashpots are at rest among those that sleep. In the plane two numbers are theirs; what others a law remembers of its
/// last force stays.
static void forget_dashpots(int dimension, const memory_rows *memory)
{
    for (int k = 0; k < (dimension == 2 ? 2 : 4) && memory->last_force; k++) memory->last_force->value[k] = 0;
    if (memory->rolling) memset(memory->rolling->last, 0, sizeof memory->rolling->last);
}

/// A pair of which one falls asleep beside one that sleeps, or wakes.
static void move_pair(const scree_model *model, scree_state *state, scree_work *work, size_t p, bool rests)
{
    if (!contact_pair_is_there(state, work, p)) return;
    const uint32_t first = work->pairs.first[p], second = work->pairs.second[p];
    const contact_body one = contact_body_get(state, first), other = contact_body_get(state, second);
    const memory_rows memory = contact_memory_of(work, CONTACT_PAIR, p);
    const contact_evaluation e = contact_evaluate_again(model, state, &one, &other, NULL, &memory);
    add_to_one(state, first, &e.quanta, true, !rests);
    add_to_one(state, second, &e.quanta, false, !rests);
    if (rests) forget_dashpots(state->dimension, &memory);
}

static void move_pairs(const scree_model *model, scree_state *state, scree_work *work)
{
    const scree_pair_list *pairs = &work->pairs;
    const uint8_t *mark = scree_sleep_of(state)->asleep;
    for (size_t p = scree_pairs_held(pairs); p < pairs->count; p++) {
        const uint8_t one = mark[pairs->first[p]], other = mark[pairs->second[p]];
        const bool rested = scree_slept(one) && scree_slept(other),
                   rests = scree_will_sleep(one) && scree_will_sleep(other);
        if (rested != rests) move_pair(model, state, work, p, rests);
    }
}

/// The contacts with walls that stand, of one that falls asleep or wakes.
static void move_group(const scree_model *model, scree_state *state, const scree_work *work, const wall_group *group,
                       bool rests)
{
    contact_quanta exerted;
    for (int k = 0; k < group->touches.count; k++) {
        if (!evaluate_standing_wall(model, state, work, group, k, &exerted)) continue;
        const memory_rows memory = contact_memory_of(work, CONTACT_ELEMENT, group->touches.touch[k].pair);
        add_to_one(state, group->row, &exerted, true, !rests);
        if (rests) forget_dashpots(state->dimension, &memory);
    }
}

/// The contacts of all bodies with walls that stand; returns whether there were any.
static bool move_walls(const scree_model *model, scree_state *state, const scree_work *work)
{
    const scree_wall_pair_list *pairs = &work->primitive_pairs;
    const uint8_t *mark = scree_sleep_of(state)->asleep;
    bool any = false;
    for (size_t begin = 0, end; begin < pairs->count; begin = end) {
        end = contact_group_end(pairs, begin);
        const uint8_t own = mark[pairs->body[begin]];
        if (scree_slept(own) == scree_will_sleep(own)) continue;
        const wall_group group = wall_group_at(state, work, begin);
        move_group(model, state, work, &group, scree_will_sleep(own));
        any = true;
    }
    return any;
}

// ---- loads on walls -----------------------------------------------------------------------------------------------

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

/// For the walls that stand, of all that will sleep.
static void sum_loads(const scree_model *model, scree_state *state, const scree_work *work)
{
    scree_sleep *sleep = scree_sleep_of(state);
    const scree_wall_pair_list *pairs = &work->primitive_pairs;
    memset(sleep->wall, 0, sizeof sleep->wall);
    for (size_t begin = 0, end; begin < pairs->count; begin = end) {
        end = contact_group_end(pairs, begin);
        if (!scree_will_sleep(sleep->asleep[pairs->body[begin]])) continue;
        const wall_group group = wall_group_at(state, work, begin);
        contact_quanta exerted;
        for (int k = 0; k < group.touches.count; k++)
            if (evaluate_standing_wall(model, state, work, &group, k, &exerted)) {
                const int w = group.touches.touch[k].surface;
                add_load(state, &work->wall_set->surface[w], &group.body, &exerted, &sleep->wall[w]);
            }
    }
}

void contact_move_resting(const scree_model *model, scree_state *state, scree_work *work)
{
    move_pairs(model, state, work);
    if (move_walls(model, state, work)) sum_loads(model, state, work);
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
