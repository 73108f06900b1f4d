/// Localisation in two windows that adjoin each other: shear planted in slabs that stay, grow sharper, or cross.
#include "testing.h"

#include "base/random.h"
#include "run/window_bands.h"

#include <math.h>
#include <string.h>

#define D 1e-3 ///< spacing of the grains
enum { SIDE = 20 };

static scree_cell_snapshot lattice(void)
{
    scree_cell_snapshot s = {.stage = "compress"};
    scree_assembly *a = &s.assembly;
    *a = (scree_assembly){.dimension = 2, .thickness = 1, .count = 2 * SIDE * SIDE};
    assert_int_equal(scree_allocate(&a->position, 3 * a->count, sizeof(double), NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&a->radius, a->count, sizeof(double), NULL), SCREE_OK);
    for (size_t id = 0; id < a->count; id++) {
        a->position[3 * id] = D * ((double)(id % SIDE) + 0.3 * scree_random_uniform(5, SCREE_RANDOM_TEST, 2 * id));
        a->position[3 * id + 1] =
            D * ((double)(id / SIDE) + 0.3 * scree_random_uniform(5, SCREE_RANDOM_TEST, 2 * id + 1));
        a->radius[id] = D / 2;
    }
    assert_int_equal(scree_cells_build(a, SCREE_PEEL_RULE(D), &s.cells, NULL), SCREE_OK);
    return s;
}

/// Moves the grains by shear in a slab at 45 degrees through the middle, rising for `way` 1 and falling for -1, and by
/// noise.
static scree_cell_snapshot sheared(const scree_cell_snapshot *before, double way, double noise, uint64_t seed)
{
    scree_cell_snapshot s = lattice();
    double *x = s.assembly.position;
    memcpy(x, before->assembly.position, 3 * s.assembly.count * sizeof *x);
    for (size_t id = 0; id < s.assembly.count; id++, x += 3) {
        double across = ((x[1] - D * SIDE) - way * (x[0] - 0.5 * D * SIDE)) * M_SQRT1_2 / (3 * D);
        double slip = 0.3 * D * fmax(-1, fmin(1, across));
        x[0] += slip * M_SQRT1_2 + noise * D * (scree_random_uniform(seed, SCREE_RANDOM_TEST, 2 * id) - 0.5);
        x[1] += way * slip * M_SQRT1_2 + noise * D * (scree_random_uniform(seed, SCREE_RANDOM_TEST, 2 * id + 1) - 0.5);
    }
    return s;
}

static scree_window_bands compare(double next_way, double noise, double next_noise)
{
    scree_window_bands bands;
    scree_cell_snapshot first = lattice(), middle = sheared(&first, 1, noise, 11),
                        last = sheared(&middle, next_way, next_noise, 12);
    assert_int_equal(scree_window_bands_compare(&first, &middle, &last, &bands, NULL), SCREE_OK);
    scree_cell_snapshot_destroy(&first);
    scree_cell_snapshot_destroy(&middle);
    scree_cell_snapshot_destroy(&last);
    return bands;
}

static void bands_that_stay_are_correlated(void **unused)
{
    (void)unused;
    scree_window_bands stays = compare(1, 0.05, 0.05), crosses = compare(-1, 0.05, 0.05);
    assert_true(stays.correlation > 0.9 && stays.overlap > 0.7);
    assert_true(crosses.correlation < 0.3 && crosses.overlap < 0.4);
    assert_true(fabs(stays.index[1] / stays.index[0] - 1) < 0.1);
}

static void bands_that_grow_sharper_have_a_larger_index(void **unused)
{
    (void)unused;
    scree_window_bands sharper = compare(1, 0.2, 0.02), blurs = compare(1, 0.02, 0.2);
    assert_true(sharper.index[1] > 1.1 * sharper.index[0]);
    assert_true(blurs.index[0] > 1.1 * blurs.index[1]);
}

static void a_window_alone_has_its_index(void **unused)
{
    (void)unused;
    scree_window_bands alone;
    scree_cell_snapshot first = lattice(), last = sheared(&first, 1, 0.05, 11);
    assert_int_equal(scree_window_bands_compare(&first, &last, NULL, &alone, NULL), SCREE_OK);
    assert_true(alone.index[0] == compare(1, 0.05, 0.05).index[0]);
    assert_true(isnan(alone.index[1]) && isnan(alone.correlation) && isnan(alone.overlap));
    scree_cell_snapshot_destroy(&first);
    scree_cell_snapshot_destroy(&last);
}

static void windows_adjoin_where_one_ends_as_the_next_begins(void **unused)
{
    (void)unused;
    scree_config_window windows[] = {{0.07, 0.085}, {0.1, 0.12}, {0.12, 0.14}, {0.14, 0.155}};
    scree_config_measure measure = {.windows = windows, .window_count = 4};
    scree_followed at;
    assert_true(scree_windows_followed(&measure, &at));
    assert_true(at.count == 3 && at.strain[0] == 0.1 && at.strain[1] == 0.12 && at.strain[2] == 0.14);
    measure.window_count = 2;
    assert_false(scree_windows_followed(&measure, &at));
    measure.window_count = 1;
    assert_true(scree_windows_followed(&measure, &at));
    assert_true(at.count == 2 && at.strain[0] == 0.07 && at.strain[1] == 0.085);
    measure.window_count = 0;
    assert_false(scree_windows_followed(&measure, &at));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bands_that_stay_are_correlated),
        cmocka_unit_test(bands_that_grow_sharper_have_a_larger_index),
        cmocka_unit_test(a_window_alone_has_its_index),
        cmocka_unit_test(windows_adjoin_where_one_ends_as_the_next_begins),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
