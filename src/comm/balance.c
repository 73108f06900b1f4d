/// Costs of parts, in one pass over their pairs.
#include "comm/balance.h"

#include "base/clock.h"
#include "base/memory.h"
#include "comm/comm.h"
#include "comm/traffic.h"
#include "state/sleep.h"

#include <math.h>

enum { BODY = 4, SLEEPER = 1, TOUCHING = 4, NEAR = 1 };
enum { WINDOW = 400 }; ///< steps
#define NANOSECONDS 1e9
#define SHORTEST    0.1 /* s, of a time by which processes are compared */

// ---- time --------------------------------------------------------------------------------------------------------

static double waited(void)
{
    double seconds = 0;
    for (scree_traffic_purpose p = 0; p < SCREE_TRAFFIC_PURPOSES; p++) seconds += scree_traffic_of(p).seconds;
    return seconds;
}

void scree_balance_begin(scree_balance *balance, bool by_costs)
{
    *balance = (scree_balance){.left = by_costs ? INFINITY : 0, .begun = balance->begun};
}

void scree_balance_begin_step(scree_balance *balance)
{
    balance->begun = scree_clock() - waited();
}

void scree_balance_end_step(scree_balance *balance, bool by_time)
{
    if (by_time) balance->worked += scree_clock() - waited() - balance->begun;
    balance->steps++;
}

// ---- what a part costs -------------------------------------------------------------------------------------------

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

/// The costs of all parts: the largest, and the mean.
typedef struct costs {
    double largest, mean;
} costs;

static costs compare(const scree_state *state, int64_t own)
{
    int64_t sum = own;
    costs c = {.largest = (double)own};
    scree_comm_maximum(state, &c.largest, 1);
    scree_comm_add(state, &sum, 1);
    c.mean = (double)sum / scree_comm_size();
    return c;
}

// ---- whether a cut pays ------------------------------------------------------------------------------------------

/// By counts, of the steps since the last list; two bodies are no reason.
static bool pays_by_counts(scree_balance *balance, const costs *c)
{
    const double excess = fmax(0, (c->largest - 2 * BODY) / c->mean - 1);
    balance->left = fmin(balance->left, excess);
    balance->lost += (double)(balance->steps - balance->seen) * (excess - balance->left);
    balance->seen = balance->steps;
    return balance->lost > SCREE_BALANCE_CUT_STEPS;
}

/// By times, of all steps of the window.
static bool pays_by_time(scree_balance *balance, const costs *c)
{
    if (c->mean < SHORTEST * NANOSECONDS) return false;
    const bool pays = (double)balance->steps * (c->largest / c->mean - 1) > SCREE_BALANCE_CUT_STEPS;
    if (!pays && balance->steps > WINDOW) scree_balance_begin(balance, true);
    return pays;
}

bool scree_balance_pays(scree_balance *balance, const scree_state *state, const scree_work *work, double *worst)
{
    const bool by_time = work->parts_by_time;
    const costs c = compare(state, by_time ? (int64_t)(balance->worked * NANOSECONDS) : count_cost(state, work));
    if (!(c.mean > 0)) return false;
    *worst = fmax(*worst, c.largest / c.mean);
    return by_time ? pays_by_time(balance, &c) : pays_by_counts(balance, &c);
}

// ---- by what space is cut ----------------------------------------------------------------------------------------

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
        const float rate = cost > 0 ? (float)(balance->worked * NANOSECONDS / (double)cost) : 1;
        for (size_t row = 0; row < state->count; row++) (*weight)[row] *= rate;
    }
    return SCREE_OK;
}
