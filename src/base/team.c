/// Method. The caller writes the task, sets the number of members that have not finished, and counts up `generation`;
/// each member that sees a new generation does its share and counts itself off; the caller spins until none is left. A
/// member that has spun SPINS times goes to sleep on a condition; the caller looks at `sleeping` after it has counted
/// up the generation, the member at the generation after it has counted itself as sleeping (both sequentially
/// consistent), so no call is missed.
#include "base/team.h"

#include "base/memory.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdbool.h>

enum { SPINS = 2000, SPINS_BEFORE_YIELD = 1000 };

typedef struct member {
    scree_team *team;
    pthread_t thread;
    int index;
} member;

struct scree_team {
    int count, started; ///< threads with the caller's; those that were started, count - 1 when all could be
    int shares;         ///< of the present task, at most count
    member members[SCREE_TEAM_MOST];
    scree_team_task *task; ///< NULL: end
    void *argument;
    pthread_mutex_t mutex;
    pthread_cond_t called;
    // each on a cache line of its own
    _Alignas(64) atomic_uint generation;
    _Alignas(64) atomic_int unfinished;
    _Alignas(64) atomic_int sleeping;
};

static inline void relax(void)
{
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
}

static void sleep_until_called(scree_team *team, unsigned seen)
{
    pthread_mutex_lock(&team->mutex);
    atomic_fetch_add(&team->sleeping, 1);
    while (atomic_load(&team->generation) == seen) pthread_cond_wait(&team->called, &team->mutex);
    atomic_fetch_sub(&team->sleeping, 1);
    pthread_mutex_unlock(&team->mutex);
}

static void *serve(void *argument)
{
    const member *self = argument;
    scree_team *team = self->team;
    for (unsigned seen = 0;; seen++) {
        int spins = 0;
        while (atomic_load_explicit(&team->generation, memory_order_acquire) == seen && spins < SPINS) {
            relax();
            spins++;
        }
        if (spins == SPINS) sleep_until_called(team, seen);
        if (!team->task) return NULL;
        if (self->index < team->shares) team->task(team->argument, self->index, team->shares);
        atomic_fetch_sub_explicit(&team->unfinished, 1, memory_order_release);
    }
}

/// Tells the members that there is something new.
static void call(scree_team *team, int shares, scree_team_task *task, void *argument)
{
    team->shares = shares;
    team->task = task;
    team->argument = argument;
    atomic_store(&team->unfinished, team->started);
    atomic_fetch_add(&team->generation, 1);
    if (atomic_load(&team->sleeping) == 0) return;
    pthread_mutex_lock(&team->mutex);
    pthread_cond_broadcast(&team->called);
    pthread_mutex_unlock(&team->mutex);
}

static scree_team *create(int count)
{
    scree_team *team;
    if (scree_allocate(&team, 1, sizeof *team, NULL)) return NULL;
    team->count = count;
    pthread_mutex_init(&team->mutex, NULL);
    pthread_cond_init(&team->called, NULL);
    for (int k = 1; k < count; k++) {
        team->members[k] = (member){.team = team, .index = k};
        if (pthread_create(&team->members[k].thread, NULL, serve, &team->members[k])) break;
        team->started++;
    }
    return team;
}

void scree_team_destroy(scree_team **team)
{
    scree_team *t = *team;
    if (!t) return;
    call(t, 0, NULL, NULL);
    for (int k = 1; k <= t->started; k++) pthread_join(t->members[k].thread, NULL);
    pthread_cond_destroy(&t->called);
    pthread_mutex_destroy(&t->mutex);
    scree_release(team);
}

void scree_team_run(scree_team **team, int count, scree_team_task *task, void *argument)
{
    if (*team && (*team)->count < count) scree_team_destroy(team);
    if (!*team && count > 1) *team = create(count);
    scree_team *t = count > 1 ? *team : NULL;
    if (t) call(t, count, task, argument);
    task(argument, 0, count);
    for (int k = t ? t->started + 1 : 1; k < count; k++) task(argument, k, count);
    // A member may have lost its processor to another program.
    for (int spins = 0; t && atomic_load_explicit(&t->unfinished, memory_order_acquire) > 0; spins++) {
        relax();
        if (spins > SPINS_BEFORE_YIELD) sched_yield();
    }
}
