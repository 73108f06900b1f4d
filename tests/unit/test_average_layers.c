/// Horizontal layers: parts and plans against closed forms, in 2D and 3D, in boxes, cylinders and cells.
#include "average_fixture.h"

#include "average/layers.h"

static double cell_of(const scree_average_table *table, size_t row, const char *name)
{
    const size_t column = scree_average_table_find(table, name);
    assert_true(column != SIZE_MAX);
    return scree_average_table_get(table, row, column);
}

static scree_average_table layers_of(scree_average_sample *s, scree_average_layers layers)
{
    scree_average_table table = {0};
    s->count = s->bodies;
    assert_int_equal(scree_average_layers_table(s, &layers, &table, NULL), SCREE_OK);
    assert_int_equal(table.rows, layers.count);
    return table;
}

/// One disc cut in two unequal layers: segments over the width between its outermost points there.
static void test_disc_cut(void **state)
{
    (void)state;
    scree_average_sample s = average_begin(2);
    average_add(&s, 3, 1, 0, 1);
    s.grain[0].velocity[0] = 5;
    scree_average_table table = layers_of(&s, (scree_average_layers){0, 1.5, 2});
    const double above = acos(0.5) - 0.5 * sqrt(0.75); // y > 1.5 of the disc about (3, 1)
    near(cell_of(&table, 0, "solid_fraction"), (M_PI - above) / (2 * 1.5), 1e-12);
    near(cell_of(&table, 1, "solid_fraction"), above / (2 * sqrt(0.75) * 1.5), 1e-12);
    near(cell_of(&table, 0, "height"), 0.75, 1e-15);
    near(cell_of(&table, 1, "velocity_x"), 5, 1e-12);
    near(cell_of(&table, 1, "velocity_y"), 0, 0);
    scree_average_table_destroy(&table);
    scree_average_sample_destroy(&s);
}

/// Velocities are those of the masses inside; a layer without a grain has none.
static void test_velocity_of_masses(void **state)
{
    (void)state;
    scree_average_sample s = average_begin(2);
    average_add(&s, 0, 0.5, 0, 0.5);
    average_add(&s, 4, 0.5, 0, 0.25);
    s.grain[0].velocity[1] = 1;
    s.grain[1].velocity[1] = -3;
    scree_average_table table = layers_of(&s, (scree_average_layers){0, 1, 2});
    near(cell_of(&table, 0, "velocity_y"), (0.25 * 1 - 0.0625 * 3) / 0.3125, 1e-12);
    near(cell_of(&table, 0, "solid_fraction"), M_PI * 0.3125 / 4.75, 1e-12);
    assert_true(isnan(cell_of(&table, 1, "velocity_y")));
    assert_true(isnan(cell_of(&table, 1, "solid_fraction")));
    scree_average_table_destroy(&table);
    scree_average_sample_destroy(&s);
}

/// In a cell, what sticks out above comes in below, and the plan is the cell's; the mean over the layers is the
/// solid fraction of the cell.
static void test_cell(void **state)
{
    (void)state;
    scree_average_sample s = average_begin(2);
    s.directions = 3;
    s.lattice[0] = 10, s.lattice[1] = 4, s.lattice[4] = 2;
    average_add(&s, 1, 1.9, 0, 0.5);
    average_add(&s, 7, 0.2, 0, 0.4);
    scree_average_table table = layers_of(&s, (scree_average_layers){0, 0.25, 8});
    double mean = 0;
    for (size_t k = 0; k < 8; k++) {
        const double fraction = cell_of(&table, k, "solid_fraction");
        mean += isnan(fraction) ? 0 : fraction / 8;
    }
    near(mean, M_PI * (0.25 + 0.16) / 20, 1e-12);
    assert_true(cell_of(&table, 0, "solid_fraction") > 0.1);
    scree_average_table_destroy(&table);
    scree_average_sample_destroy(&s);
}

/// Spheres round a circle: the plan is the disc that they fill, not its square; with one direction that repeats itself
/// it is a strip.
static void test_plans_in_3d(void **state)
{
    (void)state;
    scree_average_sample s = average_begin(3);
    for (int k = 0; k < 720; k++) average_add(&s, 9 * cos(k * M_PI / 360), 9 * sin(k * M_PI / 360), 1, 1);
    scree_average_layers layers = {0, 2, 1};
    const double solid = 720 * 4.0 / 3 * M_PI / 2;
    scree_average_table table = layers_of(&s, layers);
    near(cell_of(&table, 0, "solid_fraction"), solid / (M_PI * 100), 1e-3 * solid / (M_PI * 100));
    scree_average_table_destroy(&table);
    s.directions = 1, s.lattice[0] = 25, s.lattice[4] = 30;
    table = layers_of(&s, layers);
    near(cell_of(&table, 0, "solid_fraction"), solid / (25 * 20), 1e-12 * solid);
    scree_average_table_destroy(&table);
    s.directions = 3;
    table = layers_of(&s, layers);
    near(cell_of(&table, 0, "solid_fraction"), solid / (25 * 30), 1e-12 * solid);
    scree_average_table_destroy(&table);
    scree_average_sample_destroy(&s);
}

/// A sphere cut by a layer is a cap.
static void test_sphere_cap(void **state)
{
    (void)state;
    scree_average_sample s = average_begin(3);
    average_add(&s, 0, 0, 1, 1);
    scree_average_table table = layers_of(&s, (scree_average_layers){0, 0.5, 4});
    const double cap = M_PI * 0.25 * (3 - 0.5) / 3, plan = M_PI * 0.75;
    near(cell_of(&table, 0, "solid_fraction"), cap / (plan * 0.5), 1e-3 * cap / (plan * 0.5));
    near(cell_of(&table, 0, "solid_fraction"), cell_of(&table, 3, "solid_fraction"), 1e-9);
    scree_average_table_destroy(&table);
    scree_average_sample_destroy(&s);
}

static void test_layers_of(void **state)
{
    (void)state;
    scree_average_sample s = {.dimension = 2, .mean_radius = 0.5, .low = {0, 2}, .high = {9, 12.2}};
    scree_average_layers layers = scree_average_layers_of(&s);
    assert_int_equal(layers.count, 10);
    near(layers.low, 2, 1e-12);
    near(layers.thickness, 1.02, 1e-12);
    s.mean_radius = 1e-4;
    assert_int_equal(scree_average_layers_of(&s).count, 200);
    s.mean_radius = 4;
    assert_int_equal(scree_average_layers_of(&s).count, 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_disc_cut),    cmocka_unit_test(test_velocity_of_masses), cmocka_unit_test(test_cell),
        cmocka_unit_test(test_plans_in_3d), cmocka_unit_test(test_sphere_cap),         cmocka_unit_test(test_layers_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
