/// Method. Each member has a word of its own: nothing to do, a share is offered, the member sleeps, the end. The caller
/// writes the task, offers each member its share, does its own, and then takes back every offer that nobody has
/// accepted yet and does that share too: a member that sleeps, or whose processor is busy with another program, holds
/// nobody up. Only shares that were begun are waited for. Whoever accepts or takes back does so by a compare-and-swap,
/// and reads the task after it, so nobody sees a task of another time.
///
/// A member spins SPINS times (some 30 us) for an offer, then sleeps in the kernel (futex(2)) on its word. The caller
/// spins for the last shares, then gives its processor to whoever wants it (the member may be waiting for just that),
/// then sleeps. Time that it waits longer than spinning lasts is counted: the shares of a task are nearly equal, so it
/// says that other programs have taken processors away (thread_pool_size.h).
#include "base/thread_pool.h"

#include "base/clock.h"
#include "base/memory.h"

#include <limits.h>
#include <linux/futex.h>
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { SPINS = 2000, SPINS_BEFORE_YIELD = 1000 };
static const double yield_seconds = 1e-3;

/// What a member's word says.
enum { NOTHING, OFFERED, SLEEPING, ENDED };

typedef struct member {
    _Alignas(64) atomic_int word; // on a cache line of its own
    scree_thread_pool *pool;
    pthread_t thread;
    int index;
} member;

struct scree_thread_pool {
    int count, started; ///< threads with the caller's; those that were started, count - 1 when all could be
    int shares;         ///< of the present task, at most count
    scree_thread_pool_task *task;
    void *argument;
    double stalled;                     ///< s
    _Alignas(64) atomic_int unfinished; ///< shares of others
    _Alignas(64) atomic_int waiting;    ///< 1: the caller sleeps until there are none
    member members[SCREE_THREAD_POOL_MOST];
};

static inline void relax(void)
{
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
}

/// Sleeps while the word has this value; may return early.
static void sleep_on(atomic_int *word, int value)
{
    (void)syscall(SYS_futex, word, FUTEX_WAIT_PRIVATE, value, NULL, NULL, 0);
}

static void wake(atomic_int *word)
{
    (void)syscall(SYS_futex, word, FUTEX_WAKE_PRIVATE, 1, NULL, NULL, 0);
}

/// Accepts an offer, or takes it back.
static bool take_offer(member *m)
{
    int offered = OFFERED;
    return atomic_compare_exchange_strong(&m->word, &offered, NOTHING);
}

/// Puts a word in front of a member and wakes it where it sleeps.
static void tell(member *m, int word)
{
    if (atomic_exchange(&m->word, word) == SLEEPING) wake(&m->word);
}

/// Waits until this member has a share; false at the end.
static bool wait_for_share(member *self)
{
    for (;;) {
        for (int spins = 0; spins < SPINS; spins++) {
            int word = atomic_load_explicit(&self->word, memory_order_acquire);
            if (word == ENDED) return false;
            if (word == OFFERED && take_offer(self)) return true;
            if (word == SLEEPING) break; // woken for nothing
            relax();
        }
        int nothing = NOTHING;
        (void)atomic_compare_exchange_strong(&self->word, &nothing, SLEEPING);
        if (atomic_load(&self->word) == SLEEPING) sleep_on(&self->word, SLEEPING);
    }
}

static void *serve(void *argument)
{
    member *self = argument;
    scree_thread_pool *pool = self->pool;
    while (wait_for_share(self)) {
        pool->task(pool->argument, self->index, pool->shares);
        if (atomic_fetch_sub(&pool->unfinished, 1) == 1 && atomic_load(&pool->waiting)) wake(&pool->unfinished);
    }
    return NULL;
}

static scree_thread_pool *create(int count)
{
    scree_thread_pool *pool;
    if (scree_allocate(&pool, 1, sizeof *pool, NULL)) return NULL;
    pool->count = count;
    for (int k = 1; k < count; k++) {
        pool->members[k].pool = pool;
        pool->members[k].index = k;
        if (pthread_create(&pool->members[k].thread, NULL, serve, &pool->members[k])) break;
        pool->started++;
    }
    return pool;
}

void scree_thread_pool_destroy(scree_thread_pool **pool)
{
    scree_thread_pool *t = *pool;
    if (!t) return;
    for (int k = 1; k <= t->started; k++) tell(&t->members[k], ENDED);
    for (int k = 1; k <= t->started; k++) pthread_join(t->members[k].thread, NULL);
    scree_release(pool);
}

double scree_thread_pool_stalled(const scree_thread_pool *pool)
{
    return pool ? pool->stalled : 0;
}

/// Waits for shares that members have begun.
static void wait_for_others(scree_thread_pool *pool)
{
    for (int spins = 0; spins < SPINS_BEFORE_YIELD; spins++) {
        if (atomic_load_explicit(&pool->unfinished, memory_order_acquire) == 0) return;
        relax();
    }
    double begin = scree_clock(), passed = 0;
    while (atomic_load(&pool->unfinished) > 0 && passed < yield_seconds) {
        sched_yield();
        passed = scree_clock() - begin;
    }
    atomic_store(&pool->waiting, 1);
    for (int left; (left = atomic_load(&pool->unfinished)) > 0;) sleep_on(&pool->unfinished, left);
    atomic_store(&pool->waiting, 0);
    pool->stalled += scree_clock() - begin;
}

void scree_thread_pool_run(scree_thread_pool **pool, int count, scree_thread_pool_task *task, void *argument)
{
    if (*pool && (*pool)->count < count) scree_thread_pool_destroy(pool);
    if (!*pool && count > 1) *pool = create(count);
    scree_thread_pool *t = count > 1 ? *pool : NULL;
    int members = !t ? 0 : t->started < count - 1 ? t->started : count - 1;
    if (t) {
        t->shares = count;
        t->task = task;
        t->argument = argument;
        atomic_store(&t->unfinished, members);
    }
    for (int k = 1; k <= members; k++) tell(&t->members[k], OFFERED);
    task(argument, 0, count);
    int taken_back = 0;
    for (int k = 1; k < count; k++) {
        if (k <= members && !take_offer(&t->members[k])) continue;
        task(argument, k, count);
        taken_back += k <= members;
    }
    if (t && atomic_fetch_sub(&t->unfinished, taken_back) > taken_back) wait_for_others(t);
}
