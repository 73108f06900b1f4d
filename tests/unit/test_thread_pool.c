/// The thread pool of spinning threads: every share of every task is done once, also after members have gone to sleep,
/// when the number of shares changes and when there are more threads than processors. The choice of how many work, on
/// machines that are made up.
#include "testing.h"

#include "base/memory.h"
#include "base/thread_pool_size.h"

#include <stdatomic.h>
#include <string.h>
#include <time.h>

typedef struct tally {
    atomic_int done[SCREE_THREAD_POOL_MOST];
    int count;
} tally;

static void count_share(void *argument, int index, int count)
{
    tally *t = argument;
    assert_true(count == t->count && index >= 0 && index < count);
    atomic_fetch_add(&t->done[index], 1);
}

static void run_many(scree_thread_pool **pool, int count, int tasks)
{
    tally t = {.count = count};
    for (int k = 0; k < tasks; k++) {
        scree_thread_pool_run(pool, count, count_share, &t);
        for (int i = 0; i < SCREE_THREAD_POOL_MOST; i++) assert_int_equal(t.done[i], i < count ? k + 1 : 0);
    }
}

static void every_share_is_done_once(void **unused)
{
    (void)unused;
    static const int counts[] = {1, 2, 3, 7, 2, 1};
    scree_thread_pool *pool = NULL;
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) run_many(&pool, counts[k], 500);
    scree_thread_pool_destroy(&pool);
    assert_null(pool);
    scree_thread_pool_destroy(&pool);
}

static void sleeping_members_wake_up(void **unused)
{
    (void)unused;
    scree_thread_pool *pool = NULL;
    for (int k = 0; k < 5; k++) {
        run_many(&pool, 3, 10);
        // Long enough for a member to spin out and sleep on any machine; if it does not, the test is only weaker.
        nanosleep(&(struct timespec){.tv_nsec = 20000000}, NULL);
    }
    scree_thread_pool_destroy(&pool);
}

static void without_memory_the_caller_does_all(void **unused)
{
    (void)unused;
    scree_thread_pool *pool = NULL;
    tally t = {.count = 4};
    scree_allocation_fail_after(1);
    scree_thread_pool_run(&pool, 4, count_share, &t);
    scree_allocation_fail_after(0);
    assert_null(pool);
    for (int i = 0; i < 4; i++) assert_int_equal(t.done[i], 1);
}

/// What a share has written is there when the task returns, and what the caller writes between two tasks is seen.
typedef struct relay {
    int value[SCREE_THREAD_POOL_MOST]; // plain: the thread pool orders them
} relay;

static void count_up(void *argument, int index, int count)
{
    relay *r = argument;
    (void)count;
    r->value[index]++;
}

static void tasks_are_ordered(void **unused)
{
    (void)unused;
    enum { COUNT = 7, TASKS = 3000 };
    scree_thread_pool *pool = NULL;
    relay r = {{0}};
    for (int task = 0; task < TASKS; task++) {
        scree_thread_pool_run(&pool, COUNT, count_up, &r);
        for (int k = 0; k < COUNT; k++) {
            assert_int_equal(r.value[k], 2 * task + 1);
            r.value[k]++;
        }
    }
    scree_thread_pool_destroy(&pool);
}

/// A machine with some free processors: a step of one thread takes 1 ms, n threads on free processors are 0.9 n times
/// as fast; with more threads than free processors half of the time is lost.
typedef struct machine {
    double now, lost;
    int free;
} machine;

static double lost_on(const void *user)
{
    const machine *m = user;
    return m->lost;
}

/// `seconds` of steps; returns steps a second.
static double work_on(machine *m, scree_thread_pool_size *size, int most, double seconds)
{
    double end = m->now + seconds, begin = m->now, steps = 0;
    for (; m->now < end; steps++) {
        int n = scree_thread_pool_size_choose(size, most, m->now, lost_on, m);
        assert_true(n >= 1 && n <= most);
        double step = n == 1 ? 1e-3 : 1e-3 / (0.9 * n);
        if (n > m->free) {
            m->lost += step;
            step *= 2;
        }
        m->now += step;
    }
    return steps / (m->now - begin);
}

/// On an idle machine nothing is given up; beside one other program two threads become one, and lose at most a tenth to
/// what is tried (two windows of 30 ms every 0.5 s and more); afterwards they come back.
static void two_threads_give_way(void **unused)
{
    (void)unused;
    machine m = {.now = 1, .free = 2};
    scree_thread_pool_size size = {0};
    assert_true(work_on(&m, &size, 2, 10) > 1799);
    m.free = 1;
    assert_true(work_on(&m, &size, 2, 1) > 900);
    assert_true(work_on(&m, &size, 2, 60) > 980);
    assert_int_equal(size.kept, 1);
    m.free = 2;
    (void)work_on(&m, &size, 2, 5.1);
    assert_int_equal(size.now, 2);
    assert_true(work_on(&m, &size, 2, 10) > 1799);
}

static void many_threads_find_the_free_processors(void **unused)
{
    (void)unused;
    machine m = {.now = 1, .free = 5};
    scree_thread_pool_size size = {0};
    (void)work_on(&m, &size, 16, 2);
    assert_true(work_on(&m, &size, 16, 60) > 0.95 * 4500);
    m.free = 16;
    (void)work_on(&m, &size, 16, 6);
    assert_true(work_on(&m, &size, 16, 10) > 0.99 * 14400);
}

/// Losses now and then that fewer threads do not mend (a slow disk, say) cost little: here 6 % of the time, and what is
/// tried because of them.
static void losses_alone_take_no_thread(void **unused)
{
    (void)unused;
    machine m = {.now = 1, .free = 2};
    scree_thread_pool_size size = {0};
    double steps = 0;
    for (int k = 0; k < 1000; k++) {
        steps += 0.5 * work_on(&m, &size, 2, 0.5);
        m.lost += 0.03;
        m.now += 0.03;
    }
    assert_true(steps > 0.95 * 1000 * 0.5 * 1800);
}

static void one_thread_stays_alone(void **unused)
{
    (void)unused;
    machine m = {.now = 1, .free = 1};
    scree_thread_pool_size size = {0};
    assert_true(work_on(&m, &size, 1, 1) > 999);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tasks_are_ordered),
        cmocka_unit_test(two_threads_give_way),
        cmocka_unit_test(many_threads_find_the_free_processors),
        cmocka_unit_test(losses_alone_take_no_thread),
        cmocka_unit_test(one_thread_stays_alone),
        cmocka_unit_test(every_share_is_done_once),
        cmocka_unit_test(sleeping_members_wake_up),
        cmocka_unit_test(without_memory_the_caller_does_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
