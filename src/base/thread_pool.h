/// A thread pool of threads that wait for the next task by spinning, for work that lasts some microseconds. All threads
/// of a run are this one thread pool: two of them (OpenMP's beside it) would spin on each other's processors.
///
/// A step of a small sample takes 20 to 50 us and is cut three times; starting and joining threads with OpenMP cost 3
/// to 10 us each time on the machine of docs/performance.md, a task of this thread pool about 1. A member that has
/// found nothing to do for some 30 us sleeps, so that a thread pool does not hold processors between its runs, and what
/// it has not begun the caller does, so that a processor that is busy with another program holds nobody up for long.
#ifndef SCREE_BASE_THREAD_POOL_H
#define SCREE_BASE_THREAD_POOL_H

#include <stddef.h>

enum { SCREE_THREAD_POOL_MOST = 64 };

typedef struct scree_thread_pool scree_thread_pool;

/// One member's share of a task: `index` of `count`.
typedef void scree_thread_pool_task(void *argument, int index, int count);

/// Calls task(argument, k, count) for every k < count, at most one in each thread besides the caller's (k = 0 is the
/// caller's), and returns when all have. *thread pool is NULL at first and made when it is needed, anew for a larger
/// count; without memory or threads for it the caller does all shares itself, one after the other. count: 1 to
/// SCREE_THREAD_POOL_MOST. One caller at a time.
void scree_thread_pool_run(scree_thread_pool **pool, int count, scree_thread_pool_task *task, void *argument);

/// Where the share `index` of `count` begins among `items` things; it ends where the next one begins.
static inline size_t scree_thread_pool_begin(size_t items, int index, int count)
{
    return items * (size_t)index / (size_t)count;
}

/// s, in which the caller has waited for shares of others longer than their differences explain, since the thread pool
/// was made.
double scree_thread_pool_stalled(const scree_thread_pool *pool);

/// Ends the threads; *thread pool becomes NULL.
void scree_thread_pool_destroy(scree_thread_pool **pool);

#endif
