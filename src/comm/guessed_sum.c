/// The passes of guessed sums: with the quanta of the last time, then, where one was another, with those that are due.
#include "comm/guessed_sum.h"

static void begin_adding(scree_guessed_sum *sum, double largest)
{
    sum->adds = (scree_integer_sum){.pass = SCREE_INTEGER_SUM_ADDS};
    scree_integer_sum_bound(&sum->adds, largest);
}

/// What the processes have found in the pass that ends. In a second one the largest terms are those of all already.
static void join(const scree_state *state, scree_guessed_sum *sum, size_t count)
{
    scree_reduction together = {.parts = 0};
    int64_t spoiled[SCREE_GUESSED_SUMS];
    for (size_t k = 0; k < count; k++) {
        spoiled[k] = sum[k].adds.spoiled;
        scree_reduction_maximum(&together, &sum[k].looks.largest, 1);
        scree_reduction_add_wide(&together, &sum[k].adds.quanta, 1);
    }
    scree_reduction_add(&together, spoiled, count);
    scree_comm_join_numbers(state, &together);
    for (size_t k = 0; k < count; k++) sum[k].adds.spoiled = spoiled[k] > 0;
}

bool scree_guessed_sum_next(const scree_state *state, scree_guessed_sum *sum, size_t count, double *largest)
{
    if (sum->looks.pass == SCREE_INTEGER_SUM_BEFORE) {
        for (size_t k = 0; k < count; k++) {
            sum[k].looks.pass = SCREE_INTEGER_SUM_LOOKS;
            begin_adding(&sum[k], largest[k]);
        }
        return true;
    }
    bool again = false;
    join(state, sum, count);
    for (size_t k = 0; k < count; k++) {
        scree_integer_sum due = {.pass = SCREE_INTEGER_SUM_ADDS};
        scree_integer_sum_bound(&due, sum[k].looks.largest);
        again = again || due.quantum != sum[k].adds.quantum;
        largest[k] = sum[k].looks.largest;
    }
    for (size_t k = 0; k < count && again; k++) begin_adding(&sum[k], largest[k]);
    return again;
}
