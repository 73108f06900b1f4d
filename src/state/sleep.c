#include "state/sleep.h"

#include "base/fixed.h"
#include "base/wrapping.h"

#include <math.h>
#include <string.h>

static void add(int64_t *sum, int64_t units, double unit, double quantum)
{
    scree_wrapping_add(sum, llrint((double)units * (unit / quantum)));
}

void scree_sleep_add_resting(scree_state *state, size_t row)
{
    const scree_sleep *sleep = scree_sleep_of(state);
    const scree_resting *resting = &sleep->resting[row];
    scree_sum_row *sum = &state->sum[row];
    add(&sum->fx, resting->force[0], sleep->force_unit, state->force_quantum);
    add(&sum->fy, resting->force[1], sleep->force_unit, state->force_quantum);
    scree_wrapping_add(&sum->contacts, resting->contacts);
    if (state->dimension == 2) {
        add(&sum->torque, resting->torque[2], sleep->torque_unit, state->torque_quantum);
        return;
    }
    add(&sum->fz, resting->force[2], sleep->force_unit, state->force_quantum);
    int64_t *const torque[3] = {&state->torque[row].x, &state->torque[row].y, &state->torque[row].z};
    for (int k = 0; k < 3; k++) add(torque[k], resting->torque[k], sleep->torque_unit, state->torque_quantum);
}

void scree_sleep_list_moving(scree_state *state)
{
    scree_sleep *sleep = scree_sleep_of(state);
    sleep->count = sleep->moving_count = 0;
    for (size_t row = 0; row < state->count && sleep->asleep; row++) {
        sleep->count += sleep->asleep[row] != 0;
        if (!sleep->asleep[row] && sleep->moving) sleep->moving[sleep->moving_count++] = (uint32_t)row;
    }
    if (!state->part) sleep->total = sleep->count;
}

void scree_sleep_list(scree_state *state)
{
    scree_sleep *sleep = scree_sleep_of(state);
    scree_sleep_list_moving(state);
    sleep->pushed_count = SCREE_SLEEP_ALL;
    sleep->listed = sleep->moving != NULL; // behind a checkpoint they are not there before the first step
    sleep->bodies = state->changes;
}

void scree_sleep_clear_sums(scree_state *state)
{
    const scree_sleep *sleep = scree_sleep_of(state);
    const bool known = sleep->pushed_count != SCREE_SLEEP_ALL;
    const size_t count = known ? sleep->pushed_count : state->count;
    for (size_t k = 0; k < count && sleep->count > 0; k++) {
        const size_t row = known ? sleep->pushed[k] : k;
        if (!sleep->asleep[row]) continue;
        state->sum[row] = (scree_sum_row){0};
        if (state->torque) state->torque[row] = (scree_torque_row){0};
    }
}

void scree_sleep_end(scree_state *state)
{
    scree_sleep *sleep = scree_sleep_of(state);
    if (sleep->count == 0) return;
    for (size_t row = 0; row < state->count; row++) {
        if (sleep->asleep[row]) scree_sleep_add_resting(state, row);
        sleep->asleep[row] = 0;
        sleep->quiet[row] = 0;
        sleep->resting[row] = (scree_resting){0};
        memset(sleep->push[row], 0, sizeof sleep->push[row]);
    }
    memset(sleep->wall, 0, sizeof sleep->wall);
    sleep->overlap = 0;
    sleep->count = sleep->total = 0;
    sleep->changes++;
}

bool scree_some_sleep(const scree_state *state, const uint32_t *ids, size_t count)
{
    bool some = false;
    for (size_t k = 0; k < count; k++) some = some || scree_body_sleeps(state, scree_state_row_of(state, ids[k]));
    return some;
}
