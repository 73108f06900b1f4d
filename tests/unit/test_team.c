/// The team of spinning threads: every share of every task is done once, by as many threads as there are shares, also
/// after members have gone to sleep and when the number of shares changes.
#include "testing.h"

#include "base/memory.h"
#include "base/team.h"

#include <stdatomic.h>
#include <string.h>
#include <time.h>

typedef struct tally {
    atomic_int done[SCREE_TEAM_MOST];
    int count;
} tally;

static void count_share(void *argument, int index, int count)
{
    tally *t = argument;
    assert_true(count == t->count && index >= 0 && index < count);
    atomic_fetch_add(&t->done[index], 1);
}

static void run_many(scree_team **team, int count, int tasks)
{
    tally t = {.count = count};
    for (int k = 0; k < tasks; k++) {
        scree_team_run(team, count, count_share, &t);
        for (int i = 0; i < SCREE_TEAM_MOST; i++) assert_int_equal(t.done[i], i < count ? k + 1 : 0);
    }
}

static void every_share_is_done_once(void **unused)
{
    (void)unused;
    static const int counts[] = {1, 2, 3, 7, 2, 1};
    scree_team *team = NULL;
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) run_many(&team, counts[k], 500);
    scree_team_destroy(&team);
    assert_null(team);
    scree_team_destroy(&team);
}

static void sleeping_members_wake_up(void **unused)
{
    (void)unused;
    scree_team *team = NULL;
    for (int k = 0; k < 5; k++) {
        run_many(&team, 3, 10);
        // Long enough for a member to spin out and sleep on any machine; if it does not, the test is only weaker.
        nanosleep(&(struct timespec){.tv_nsec = 20000000}, NULL);
    }
    scree_team_destroy(&team);
}

static void without_memory_the_caller_does_all(void **unused)
{
    (void)unused;
    scree_team *team = NULL;
    tally t = {.count = 4};
    scree_allocation_fail_after(1);
    scree_team_run(&team, 4, count_share, &t);
    scree_allocation_fail_after(0);
    assert_null(team);
    for (int i = 0; i < 4; i++) assert_int_equal(t.done[i], 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_share_is_done_once),
        cmocka_unit_test(sleeping_members_wake_up),
        cmocka_unit_test(without_memory_the_caller_does_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
