/// Restarts between stages with different boundaries, and in the middle of each, change no bit.
#include "run_fixture.h"

#include "boundary_cases.h"
#include "io_scratch.h"
#include "run/step.h"

/// Uninterrupted run against one that is stopped between two stages with different boundaries.
static void restart_gives_the_same_bits(void **unused)
{
    (void)unused;
    char folder[64], whole[96], part[96];
    assert_true(scratch_create(folder));
    snprintf(whole, sizeof whole, "%s/whole", folder);
    snprintf(part, sizeof part, "%s/part", folder);
    for (int k = 0; k < 2; k++) {
        scree_case *c = case_read(boundary_variants[k].text, &boundary_variants[k].override, 1);
        run_restart(c, whole, part, 2, "stage confine ended");
        scree_case_free(c);
    }
    scratch_destroy(folder);
}

/// From a state written in the middle of the last stage and read back.
static void a_checkpoint_in_the_middle_gives_the_same_bits(void **unused)
{
    (void)unused;
    char folder[64];
    assert_true(scratch_create(folder));
    for (int k = 0; k < BOUNDARY_VARIANTS; k++) {
        scree_case *c = case_read(boundary_variants[k].text, &boundary_variants[k].override, 1);
        scree_simulation s[2];
        scree_error error;
        simulation_open(c, 1, &s[0]);
        while (simulation_last_steps(&s[0]) < 700) simulation_step(&s[0]);
        simulation_reopen(&s[0], 1, folder, &s[1]);
        for (int step = 0; step < 300; step++)
            for (int i = 0; i < 2; i++) check(scree_step(&s[i], &error), &error);
        assert_true(simulation_bits(&s[0]) == simulation_bits(&s[1]));
        for (int i = 0; i < 2; i++) scree_simulation_close(&s[i]);
        scree_case_free(c);
    }
    scratch_destroy(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(restart_gives_the_same_bits),
        cmocka_unit_test(a_checkpoint_in_the_middle_gives_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
