/// Costs of parts, in one pass over their pairs.
#include "comm/balance.h"

#include "base/clock.h"
#include "base/memory.h"
#include "comm/traffic.h"
#include "state/sleep.h"

enum { BODY = 4, SLEEPER = 1, TOUCHING = 4, NEAR = 1 };
#define NANOSECONDS 1e9
#define SHORTEST    0.1 /* s, of a time by which processes are compared */

static double waited(void)
{
    double seconds = 0;
    for (scree_traffic_purpose p = 0; p < SCREE_TRAFFIC_PURPOSES; p++) seconds += scree_traffic_of(p).seconds;
    return seconds;
}

void scree_balance_begin(scree_balance *balance)
{
    balance->begun = scree_clock();
    balance->waited = waited();
}

/// Seconds of work since the last cut.
static double worked(const scree_balance *balance)
{
    return scree_clock() - balance->begun - (waited() - balance->waited);
}

static int64_t count_cost(const scree_state *state, const scree_work *work)
{
    const scree_pair_list *pairs = &work->pairs;
    const int64_t sleepers = (int64_t)scree_sleep_of(state)->count;
    int64_t cost = BODY * ((int64_t)state->count - sleepers) + SLEEPER * sleepers;
    for (int k = 0; k < pairs->section_count; k++) {
        const scree_pair_section *section = &pairs->section[k];
        if (section->asleep) continue;
        cost += TOUCHING * (int64_t)(section->touching_end - section->begin);
        cost += NEAR * (int64_t)(section->end - section->touching_end);
    }
    return cost;
}

int64_t scree_balance_cost(const scree_balance *balance, const scree_state *state, const scree_work *work)
{
    return work->parts_by_time ? (int64_t)(worked(balance) * NANOSECONDS) : count_cost(state, work);
}

double scree_balance_slack(const scree_work *work)
{
    return work->parts_by_time ? SHORTEST * NANOSECONDS : 2 * BODY;
}

/// Half of the cost to each of the two, all of it to one whose partner is not here.
static void weigh_pairs(const scree_state *state, const scree_pair_list *pairs, size_t begin, size_t end, float cost,
                        float *weight)
{
    for (size_t p = begin; p < end; p++) {
        const uint32_t row[2] = {pairs->first[p], pairs->second[p]};
        const bool here[2] = {row[0] < state->count, row[1] < state->count};
        for (int k = 0; k < 2; k++)
            if (here[k]) weight[row[k]] += here[!k] ? 0.5f * cost : cost;
    }
}

scree_status scree_balance_weights(const scree_balance *balance, const scree_state *state, const scree_work *work,
                                   float **weight, scree_error *error)
{
    const scree_pair_list *pairs = &work->pairs;
    scree_status status = scree_allocate(weight, state->count + 1, sizeof **weight, error);
    if (status) return status;
    for (size_t row = 0; row < state->count; row++) (*weight)[row] = scree_body_sleeps(state, row) ? SLEEPER : BODY;
    for (int k = 0; k < pairs->section_count; k++) {
        const scree_pair_section *section = &pairs->section[k];
        if (section->asleep) continue;
        weigh_pairs(state, pairs, section->begin, section->touching_end, TOUCHING, *weight);
        weigh_pairs(state, pairs, section->touching_end, section->end, NEAR, *weight);
    }
    if (work->parts_by_time) {
        const int64_t cost = count_cost(state, work);
        const float rate = cost > 0 ? (float)(worked(balance) * NANOSECONDS / (double)cost) : 1;
        for (size_t row = 0; row < state->count; row++) (*weight)[row] *= rate;
    }
    return SCREE_OK;
}
