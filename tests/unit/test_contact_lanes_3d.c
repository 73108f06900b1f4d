/// The kernels with eight lanes in space on any machine: compiled here for the basic instruction set, where the
/// compiler makes the wide vectors out of narrow ones. The machinery of AVX-512 kernels is tested by this also where
/// they cannot run.
#pragma GCC diagnostic ignored "-Wpsabi"
#define SCREE_ISA   9 /* no machine has it: only a name */
#define SCREE_LANES 8
#include "contact/pairs_3d_batch.c"

#define LANES_KERNEL scree_pairs_3d_v9
#include "contact_lanes.h"

static void eight_lanes_give_the_bits_of_one(void **unused)
{
    (void)unused;
    compare_laws(3);
    for (unsigned option = MINDLIN_ROLLING; option <= (MINDLIN_ROLLING | MINDLIN_RESCALED); option++)
        compare_many((variant){.dimension = 3, .law = SCREE_SLOT_hertz_mindlin, .option = option});
    for (unsigned option = MINDLIN_CONSTANT; option <= (MINDLIN_CONSTANT | MINDLIN_RESCALED); option++)
        compare_many((variant){.dimension = 3, .law = SCREE_SLOT_hertz_mindlin, .option = option});
    for (unsigned option = 0; option <= ADHESIVE_CONSTANT; option++) {
        compare_many((variant){.dimension = 3, .law = SCREE_SLOT_hertz_jkr, .option = option});
        compare_many((variant){.dimension = 3, .law = SCREE_SLOT_hertz_dmt, .option = option});
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eight_lanes_give_the_bits_of_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
