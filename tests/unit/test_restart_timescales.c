/// Restart between two stages changes no bit of a small sample, and keeps the times: two_timescales.
#include "simulation_restart.h"

static void two_timescales(void **unused)
{
    (void)unused;
    restart_compare(TIMESCALES, TIMESCALES);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_timescales),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
