/// The kernels with eight lanes in the plane on any machine: compiled here for the basic instruction set, where the
/// compiler makes the wide vectors out of narrow ones. The machinery of AVX-512 kernels is tested by this also where
/// they cannot run.
#pragma GCC diagnostic ignored "-Wpsabi"
#define SCREE_ISA   9 /* no machine has it: only a name */
#define SCREE_LANES 8
#include "contact/pairs_2d_batch.c"

#define LANES_KERNEL scree_pairs_2d_v9
#include "contact_lanes.h"

static void eight_lanes_give_the_bits_of_one(void **unused)
{
    (void)unused;
    compare_laws(2);
    compare_all((variant){.dimension = 2, .law = SCREE_SLOT_hertz_mindlin, .option = MINDLIN_RESCALED});
    compare_many((variant){.dimension = 2, .law = SCREE_SLOT_hertz_jkr});
    compare_many((variant){.dimension = 2, .law = SCREE_SLOT_hertz_dmt});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eight_lanes_give_the_bits_of_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
