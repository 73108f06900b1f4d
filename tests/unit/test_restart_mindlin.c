/// Restart between two stages changes no bit of a small sample, and keeps the times: hertz_mindlin.
#include "simulation_restart.h"

static void hertz_mindlin(void **unused)
{
    (void)unused;
    restart_compare(MINDLIN_FIRST, MINDLIN_LAST);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hertz_mindlin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
