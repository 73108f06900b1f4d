/// A run of a net of held pairs must end in the same bits whatever runs it: number of threads, instruction set, the
/// scalar reference, lists that are made anew or thrown away (disturbances, counted from 1, which the run knows).
#ifndef SCREE_TESTS_NET_VARIATIONS_H
#define SCREE_TESTS_NET_VARIATIONS_H

#include "contact/contact.h"
#include "testing.h"

typedef uint64_t net_run(int dimension, unsigned directions, int threads, int set, bool reference, int disturbance);

static inline void assert_nothing_but_the_state_decides(net_run *run, int disturbances)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (unsigned directions = 0; directions < 8; directions += dimension == 3 ? 7 : 3) {
            if (directions >> dimension) break;
            const uint64_t expected = run(dimension, directions, 1, 0, true, 0);
            const int sets = scree_contact_instruction_set(0);
            for (int set = 2; set <= sets; set++) assert_true(run(dimension, directions, 1, set, false, 0) == expected);
            for (int threads = 2; threads <= 7; threads += threads == 3 ? 4 : 1)
                assert_true(run(dimension, directions, threads, 0, false, 0) == expected);
            for (int disturbance = 1; disturbance <= disturbances; disturbance++)
                assert_true(run(dimension, directions, 2, 0, false, disturbance) == expected);
        }
}

#endif
