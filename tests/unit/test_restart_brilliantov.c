/// Restart between two stages changes no bit of a small sample, and keeps the times: hertz_brilliantov with each
/// update of friction.
#include "simulation_restart.h"

static void explicit_friction(void **unused)
{
    (void)unused;
    restart_compare(EXPLICIT_FIRST, EXPLICIT_LAST);
}

static void implicit_friction(void **unused)
{
    (void)unused;
    restart_compare(IMPLICIT_FIRST, IMPLICIT_LAST);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(explicit_friction),
        cmocka_unit_test(implicit_friction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
