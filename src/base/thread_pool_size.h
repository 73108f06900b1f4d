/// How many threads of a thread pool are worth while now: fewer than there may be while other programs hold the
/// processors.
///
/// A thread pool of n threads on processors that it shares with others waits for the thread that has just lost its
/// processor, for milliseconds each time, and is soon slower than fewer threads would be. Results have the same bits
/// for any number, so the number may change between any two steps.
///
/// Method. Steps are counted over windows of some 30 ms. Where more than a tenth of a window was lost (the caller
/// waited for others, or had no processor), the next window is done with one thread less, then one as before and one
/// with less again; the faster number goes on. After a rest of 0.5 s one thread more is tried in the same way; the rest
/// doubles, up to 5 s, each time that it did not pay. Cost: two clocks a window, one a step; nothing is tried while
/// nothing is lost.
#ifndef SCREE_BASE_THREAD_POOL_SIZE_H
#define SCREE_BASE_THREAD_POOL_SIZE_H

#include "base/thread_pool.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct scree_thread_pool_size {
    int most;                      ///< threads that there may be
    int now;                       ///< that work in the present window; 0: nothing has been chosen yet
    int kept;                      ///< that work while nothing is tried
    int tried;                     ///< that are compared with `kept`; 0: none
    int windows;                   ///< done with `tried`
    double gain;                   ///< steps a second of `tried` less those of `kept`, summed over the windows
    double begin;                  ///< s, of the window
    double lost;                   ///< s, lost before it
    uint64_t steps;                ///< in it
    double rest_more, rest_less;   ///< s, that pass before one thread more or less is tried again
    double until_more, until_less; ///< s, when that is over
} scree_thread_pool_size;

/// Called between two steps, with the threads that there may be (at least 1). Returns the number for the next step.
int scree_thread_pool_size_follow(scree_thread_pool_size *size, const scree_thread_pool *pool, int most);

/// The same with given clocks, for tests: `now` [s] and a function that returns the time lost so far [s], which is
/// called at the ends of windows only.
int scree_thread_pool_size_choose(scree_thread_pool_size *size, int most, double now, double (*lost)(const void *user),
                                  const void *user);

#endif
