/// Elements of growing size, numbers of profiles, mirror images, the stress of the motion, elements on threads.
#include "average_fixture.h"

#include "average/kernel.h"
#include "average/profile.h"
#include "average/sizes.h"

#include <stdio.h>

typedef struct wanted {
    const char *name;
    double value;
} wanted;

static void pick(void *user, const char *name, const char *unit, double value)
{
    wanted *w = user;
    (void)unit;
    if (strcmp(name, w->name) == 0) w->value = value;
}

static double cell(const scree_average_table *table, size_t row, const char *column)
{
    const size_t k = scree_average_table_find(table, column);
    assert_true(k != SIZE_MAX);
    return scree_average_table_get(table, row, k);
}

/// A square of grains under one stress: every size has it, sides go with the root of the size, what is too large has no
/// numbers, and nothing has to settle.
static void test_sizes(void **state)
{
    (void)state;
    scree_average_sample s = average_lattice(20, 0.5, 3, 7);
    scree_error error;
    scree_average_view view;
    scree_average_table table = {0};
    const scree_average_plan plan = {
        .side = 4, .fields = SCREE_AVERAGE_STRESS | SCREE_AVERAGE_FABRIC, .sizes = 3, .size = {16, 36, 400}};
    average_finish(&s);
    check(scree_average_view_open(&s, &plan, &view, &error), &error);
    check(scree_average_sizes_table(&view, &plan, &table, &error), &error);
    assert_int_equal(table.rows, 3);
    for (size_t row = 0; row < 2; row++) {
        const double side = sqrt(plan.size[row] * view.surface.volume / 400);
        near(side, 4 + 2 * (double)row, 0.02);
        near(cell(&table, row, "side"), side, 1e-12);
        near(cell(&table, row, "stress_yy"), -7 / s.thickness * cell(&table, row, "grains") / (side * side), 1e-12);
        near(cell(&table, row, "inside"), 1, 1e-12);
    }
    near(cell(&table, 2, "side"), 20, 0.06);
    assert_true(isnan(cell(&table, 2, "stress_yy"))); // higher than 0.66 of the sample
    wanted w = {"rve_stress_small", NAN};
    scree_average_sizes_tell(&view, pick, &w);
    near(w.value, 0.2, 1e-12); // 12 centres lie in a square of 10 grains, 20 in one of 20
    w = (wanted){"rve_stress_large", 1};
    scree_average_sizes_tell(&view, pick, &w);
    assert_true(isnan(w.value)); // 200 grains do not fit
    w = (wanted){"rve_strain_small", 1};
    scree_average_sizes_tell(&view, pick, &w);
    assert_true(isnan(w.value)); // nothing has moved
    scree_average_table_destroy(&table);
    scree_average_view_close(&view);
    scree_average_sample_destroy(&s);
}

/// Samples whose variance falls exactly as 1/n, or n^-1/2: scatter and exponent are found, without error.
static void test_scatter(void **state)
{
    (void)state;
    const double deviate[4] = {-1.5, -0.5, 0.5, 1.5}, size[3] = {5, 20, 80};
    for (int power = 1; power <= 2; power++) {
        scree_average_table sample[4] = {{0}}, scatter = {0};
        scree_error error;
        double exponent, low, high;
        for (int i = 0; i < 4; i++)
            for (int row = 0; row < 3; row++) {
                check(scree_average_table_begin_row(&sample[i], &error), &error);
                scree_average_table_take(&sample[i], "size", "1", size[row]);
                scree_average_table_take(&sample[i], "side", "m", sqrt(size[row]));
                scree_average_table_take(&sample[i], "stress_xx", "Pa",
                                         100 + deviate[i] * pow(size[row], -0.25 * power));
                check(scree_average_table_end_row(&sample[i], &error), &error);
            }
        check(scree_average_sizes_scatter(sample, 4, &scatter, &error), &error);
        // The variance of the deviates is 5/3.
        near(cell(&scatter, 1, "stress_scatter"), sqrt(5.0 / 3 * pow(20, -0.5 * power)) / 100, 1e-12);
        assert_true(isnan(cell(&scatter, 1, "fabric_scatter")));
        scree_average_sizes_exponent(sample, 4, SCREE_AVERAGE_SIZED_STRESS, &exponent, &low, &high);
        near(exponent, 0.5 * power, 1e-9);
        assert_true(low <= exponent && exponent <= high && high - low < 0.05);
        scree_average_sizes_exponent(sample, 2, SCREE_AVERAGE_SIZED_STRESS, &exponent, &low, &high);
        assert_true(isnan(exponent));
        for (int i = 0; i < 4; i++) scree_average_table_destroy(&sample[i]);
        scree_average_table_destroy(&scatter);
    }
}

/// The mean of a table and its image is that of the image and its own; signs change where they have to.
static void test_mirror(void **state)
{
    (void)state;
    scree_average_table table = {0};
    scree_error error;
    const double xy[3] = {1, 5, 4}, yy[3] = {2, 7, 6}, angle[3] = {80, 30, 85}, velocity[3] = {3, NAN, NAN};
    for (int j = 0; j < 3; j++) {
        check(scree_average_table_begin_row(&table, &error), &error);
        scree_average_table_take(&table, "place", "1", j - 1);
        scree_average_table_take(&table, "x", "m", 2 * (j - 1));
        scree_average_table_take(&table, "stress_xy_inside", "Pa", xy[j]);
        scree_average_table_take(&table, "stress_yy", "Pa", yy[j]);
        scree_average_table_take(&table, "fabric_angle", "degree", angle[j]);
        scree_average_table_take(&table, "velocity_x", "m/s", velocity[j]);
        check(scree_average_table_end_row(&table, &error), &error);
    }
    scree_average_profile_mirror(&table, 3);
    near(cell(&table, 0, "x"), -2, 0);
    near(cell(&table, 0, "stress_yy"), 4, 1e-14);
    near(cell(&table, 2, "stress_yy"), 4, 1e-14);
    near(cell(&table, 1, "stress_yy"), 7, 1e-14);
    near(cell(&table, 0, "stress_xy_inside"), -1.5, 1e-14);
    near(cell(&table, 2, "stress_xy_inside"), 1.5, 1e-14);
    near(cell(&table, 1, "stress_xy_inside"), 0, 1e-14);
    near(cell(&table, 0, "fabric_angle"), 87.5, 1e-12); // between 80 and -85, which is 95
    near(cell(&table, 2, "fabric_angle"), -87.5, 1e-12);
    near(cell(&table, 0, "velocity_x"), 3, 0); // what one side alone has
    near(cell(&table, 2, "velocity_x"), -3, 0);
    scree_average_table_destroy(&table);
}

/// Densities, pressures and axes by region.
static void test_profile(void **state)
{
    (void)state;
    enum { POINTS = 41 };
    scree_average_table table = {0};
    scree_error error;
    const struct {
        const char *name;
        double value;
    } expected[] = {{"density_core", 0.9},      {"density_excess", 0.125},   {"pressure_axis", 0.5},
                    {"pressure_beside", 0.65},  {"axes_tilt", 20},           {"pressure_fabric_tilt", 30},
                    {"pressure_axes_tilt", 60}, {"pressure_fluctuation", 0}, {"pressure_normals_tilt", 15}};
    for (int j = 0; j < POINTS; j++) {
        const double at = (j - 20) / 20.0;
        check(scree_average_table_begin_row(&table, &error), &error);
        scree_average_table_take(&table, "place", "1", at);
        scree_average_table_take(&table, "inside", "1", fabs(at) > 0.85 ? 0.3 : 1);
        scree_average_table_take(&table, "volume_fraction", "1", fabs(at) > 0.85 ? 0.2 : fabs(at) < 0.3 ? 0.9 : 0.8);
        scree_average_table_take(&table, "volume_fraction_parts_inside", "1", 0.8);
        scree_average_table_take(&table, "vertical_pressure_scaled", "1", fabs(at) < 0.2 ? 0.5 : 0.65);
        scree_average_table_take(&table, "pressure_angle", "degree", 80);
        scree_average_table_take(&table, "fabric_angle", "degree", -70);
        scree_average_table_take(&table, "normals_angle", "degree", -85);
        scree_average_table_take(&table, "axes_angle", "degree", fabs(at) > 0.85 ? 0 : 20);
        scree_average_table_take(&table, "axes_order", "1", 0.5);
        scree_average_table_take(&table, "long_axis_angle", "degree", -10);
        check(scree_average_table_end_row(&table, &error), &error);
    }
    for (size_t k = 0; k < sizeof expected / sizeof *expected; k++) {
        wanted w = {expected[k].name, NAN};
        scree_average_profile_tell(&table, POINTS, pick, &w);
        near(w.value, expected[k].value, 1e-12);
    }
    // Two sides that differ by 2 a everywhere are one sample of a deviation of a 2^(1/2).
    const size_t column = scree_average_table_find(&table, "vertical_pressure_scaled");
    for (int j = 0; j < POINTS; j++) table.value[(size_t)j * table.columns + column] = j < 20 ? 0.9 : j > 20 ? 1.1 : 1;
    wanted w = {"pressure_fluctuation", NAN};
    scree_average_profile_tell(&table, POINTS, pick, &w);
    near(w.value, sqrt(40 * 0.02 / (20 * 0.81 + 20 * 1.21 + 1)), 1e-12); // the axis is its own image
    scree_average_table_destroy(&table);
}

/// In space elevations do not say how far two axes are apart: that of the largest pressure lies along x, that of the
/// fabric along y or at 35 degrees from x, which is told although both elevations are 0; of normals that are alike in
/// all directions none is.
static void test_profile_in_space(void **state)
{
    (void)state;
    const double angle[] = {M_PI / 2, 35 * M_PI / 180};
    for (int k = 0; k < 2; k++) {
        enum { POINTS = 3 };
        const double c = cos(angle[k]), s = sin(angle[k]);
        const double stress[9] = {-5, 0, 0, 0, -2, 0, 0, 0, -1}, round[9] = {2, 1e-16, 0, 0, 2, 0, 0, 0, 2};
        const double fabric[9] = {1 + c * c, c * s, 0, c * s, 1 + s * s, 0, 0, 0, 0.5};
        const double *const tensor[3] = {stress, fabric, round};
        static const char *const name[3] = {"stress", "fabric", "normals"};
        scree_average_table table = {0};
        scree_error error;
        for (int j = 0; j < POINTS; j++) {
            char text[32];
            check(scree_average_table_begin_row(&table, &error), &error);
            scree_average_table_take(&table, "z", "m", 1);
            scree_average_table_take(&table, "place", "1", j - 1);
            scree_average_table_take(&table, "inside", "1", 1);
            for (int t = 0; t < 3; t++)
                for (int i = 0; i < 9; i++) {
                    (void)snprintf(text, sizeof text, "%s_%c%c", name[t], "xyz"[i / 3], "xyz"[i % 3]);
                    scree_average_table_take(&table, text, "1", tensor[t][i]);
                }
            scree_average_table_take(&table, "pressure_angle", "degree", 0);
            scree_average_table_take(&table, "fabric_angle", "degree", 0);
            scree_average_table_take(&table, "normals_angle", "degree", 0);
            check(scree_average_table_end_row(&table, &error), &error);
        }
        wanted w = {"pressure_fabric_tilt", NAN}, none = {"pressure_normals_tilt", 1};
        scree_average_profile_tell(&table, POINTS, pick, &w);
        near(w.value, angle[k] * 180 / M_PI, 1e-9);
        scree_average_profile_tell(&table, POINTS, pick, &none);
        assert_true(isnan(none.value));
        scree_average_table_destroy(&table);
    }
}

/// Forces that are twice as large about the axis as beside it; what lies between does not count.
static void test_core(void **state)
{
    (void)state;
    scree_average_sample s = average_lattice(20, 0.5, 3, 3);
    scree_error error;
    scree_average_view view;
    wanted w = {"force_core_ratio", NAN};
    average_finish(&s);
    check(scree_average_view_open(&s, &(scree_average_plan){.side = 4}, &view, &error), &error);
    for (size_t c = 0; c < s.contacts; c++) {
        const double away = fabs(s.contact[c].point[0] - 10) / view.frame.half;
        const bool high = s.contact[c].point[1] - view.frame.base > 0.5 * view.frame.height;
        s.contact[c].normal_force = high ? 100 : away <= 0.1 ? 6 : away < 0.2 ? 50 : away <= 0.5 ? 3 : 70;
    }
    scree_average_profile_forces(&view, pick, &w);
    near(w.value, 2, 1e-12);
    scree_average_view_close(&view);
    scree_average_sample_destroy(&s);
}

/// Elements and points see the motion about their mean velocity alone, whatever the whole does.
static void test_kinetic(void **state)
{
    (void)state;
    const scree_average_points points = {.number = {3, 3, 1}, .first = {0.3, 0.3, 0}, .gap = {0.2, 0.2, 1}};
    scree_error error;
    double element_stress[2], point_stress[2][9];
    for (int drift = 0; drift < 2; drift++) {
        scree_average_sample s = average_cloud(2, 200);
        scree_average_kernel kernel;
        scree_average_view view;
        scree_average_value value;
        double mass = 0, momentum[2] = {0}, direct = 0;
        for (size_t p = 0; p < s.bodies; p++)
            for (size_t i = 0; i < 2; i++)
                s.grain[p].velocity[i] = average_random(9000 + 2 * p + i) + (i == 0 ? 50.0 * drift : 0);
        average_finish(&s);
        check(scree_average_view_open(&s, &(scree_average_plan){.side = 0.3}, &view, &error), &error);
        const scree_average_element element = {{0.2, 0.1, 0}, {0.8, 0.9, 0}};
        scree_average_measure(&s, &view.bins, &view.surface, &element, &value);
        wanted w = {"kinetic_xy", NAN};
        scree_average_tell(&s, &value, SCREE_AVERAGE_KINETIC, pick, &w);
        for (int pass = 0; pass < 2; pass++)
            for (size_t p = 0; p < s.bodies; p++) {
                const scree_average_grain *g = &s.grain[p];
                if (!scree_average_element_holds(&element, 2, g->position)) continue;
                if (pass == 0) {
                    mass += g->mass;
                    for (int i = 0; i < 2; i++) momentum[i] += g->mass * g->velocity[i];
                } else {
                    direct -= g->mass * (g->velocity[0] - momentum[0] / mass) * (g->velocity[1] - momentum[1] / mass);
                }
            }
        near(w.value, direct / (0.6 * 0.8 * s.thickness), 1e-9 * fabs(w.value) * (1 + 1e4 * drift));
        element_stress[drift] = w.value;
        check(scree_average_kernel_find(&s, 0.3, &points, false, 1, &kernel, &error), &error);
        scree_average_kernel_kinetic(&kernel, 4, point_stress[drift]);
        assert_true(point_stress[drift][0] < 0 && point_stress[drift][3] < 0); // a pressure
        scree_average_kernel_destroy(&kernel);
        scree_average_view_close(&view);
        scree_average_sample_destroy(&s);
    }
    near(element_stress[1], element_stress[0], 1e-7 * fabs(element_stress[0]));
    for (int k = 0; k < 4; k++) near(point_stress[1][k], point_stress[0][k], 1e-7 * fabs(point_stress[0][0]));
}

/// The same bits for any number of threads.
static void test_threads(void **state)
{
    (void)state;
    scree_average_table table[3] = {{0}};
    scree_error error;
    for (int t = 0; t < 3; t++) {
        scree_average_sample s = average_cloud(2, 300);
        scree_average_view view;
        const scree_average_plan plan = {.side = 0.2,
                                         .fields = (1U << SCREE_AVERAGE_FIELDS) - 1,
                                         .cuts = 2,
                                         .height = {0, 0.5},
                                         .points = 11,
                                         .grid = {60, 50, 0}, // more than a block
                                         .threads = (int[]){1, 2, 5}[t]};
        for (size_t p = 0; p < s.bodies; p++) {
            s.grain[p].moved = true;
            s.grain[p].displacement[0] = average_random(p);
        }
        average_finish(&s);
        check(scree_average_view_open(&s, &plan, &view, &error), &error);
        check(scree_average_map_table(&view, &plan, &table[t], &error), &error);
        assert_int_equal(table[t].rows, 3000);
        scree_average_view_close(&view);
        scree_average_sample_destroy(&s);
    }
    for (int t = 1; t < 3; t++)
        assert_memory_equal(table[0].value, table[t].value, table[0].rows * table[0].columns * sizeof(double));
    for (int t = 0; t < 3; t++) scree_average_table_destroy(&table[t]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sizes),   cmocka_unit_test(test_scatter),          cmocka_unit_test(test_mirror),
        cmocka_unit_test(test_profile), cmocka_unit_test(test_profile_in_space), cmocka_unit_test(test_kinetic),
        cmocka_unit_test(test_core),    cmocka_unit_test(test_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
