/// Averages over elements: closed forms, sums over elements that fill space, turned and mirrored samples.
#include "average_fixture.h"

#include "average/cuts.h"
#include "average/tensor.h"
#include "base/matrix.h"

static scree_average_view open_view(scree_average_sample *s, const scree_average_plan *plan)
{
    scree_average_view view;
    scree_error error;
    check(scree_average_view_open(s, plan, &view, &error), &error);
    return view;
}

static scree_average_value value_of(const scree_average_view *view, const scree_average_element *element)
{
    scree_average_value value;
    scree_average_measure(view->sample, &view->bins, &view->surface, element, &value);
    return value;
}

/// What a table is told, by name.
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

static double told(const scree_average_view *view, const scree_average_element *element, unsigned fields,
                   const char *name)
{
    wanted w = {name, NAN};
    const scree_average_value value = value_of(view, element);
    scree_average_tell(view->sample, &value, fields, pick, &w);
    return w.value;
}

/// A loaded lattice has one stress everywhere, by centres and by parts, and tr F = nu c.
static void test_lattice(void **state)
{
    (void)state;
    const double r = 0.5, fx = 3, fy = 7;
    scree_average_sample s = average_lattice(12, r, fx, fy);
    average_finish(&s);
    scree_average_view view = open_view(&s, &(scree_average_plan){.side = 4});
    const scree_average_element element = {{3, 4, 0}, {7, 10, 0}}, shifted = {{3.3, 4.4, 0}, {7.3, 10.4, 0}};
    const unsigned all =
        SCREE_AVERAGE_STRESS | SCREE_AVERAGE_DENSITY | SCREE_AVERAGE_FABRIC | SCREE_AVERAGE_COORDINATION;
    const double xx = -fx / (2 * r * s.thickness), yy = -fy / (2 * r * s.thickness), nu = M_PI / 4;
    near(told(&view, &element, all, "stress_xx"), xx, 1e-13);
    near(told(&view, &element, all, "stress_yy"), yy, 1e-13);
    near(told(&view, &element, all, "stress_xy"), 0, 1e-13);
    near(told(&view, &shifted, all, "stress_yy_parts"), yy, 1e-12); // one period on each side
    near(told(&view, &shifted, all, "volume_fraction_parts"), nu, 1e-13);
    near(told(&view, &element, all, "volume_fraction"), nu, 1e-13);
    near(told(&view, &element, all, "coordination"), 4, 0);
    near(told(&view, &element, all, "fabric_trace"), 4 * nu, 1e-13);
    near(told(&view, &element, all, "fabric_deviator"), 0, 1e-13);
    near(told(&view, &element, all, "normals_trace"), 4 * nu, 1e-13);
    near(told(&view, &element, all, "pressure_angle"), 90, 1e-9);
    near(told(&view, &element, all, "grains"), 24, 0);
    near(told(&view, &element, all, "inside"), 1, 1e-13);
    scree_average_view_close(&view);
    scree_average_sample_destroy(&s);
}

/// Elements side by side have all there is: nothing twice, nothing lost.
static void test_tiles(void **state)
{
    (void)state;
    scree_average_sample s = average_cloud(2, 300);
    average_finish(&s);
    scree_average_view view = open_view(&s, &(scree_average_plan){.side = 0.2});
    double moment[2] = {0}, whole = 0, solid[2] = {0}, count = 0;
    for (size_t p = 0; p < s.bodies; p++) whole += s.own[p].moment[1];
    for (int k = 0; k < 49; k++) {
        const double x = -0.2 + 0.2 * (k % 7), y = -0.2 + 0.2 * (k / 7);
        const scree_average_element element = {{x, y, 0}, {x + 0.2, y + 0.2, 0}};
        const scree_average_value value = value_of(&view, &element);
        moment[0] += value.centres.moment[1];
        moment[1] += value.parts.moment[1];
        solid[0] += value.centres.solid;
        solid[1] += value.parts.solid;
        count += value.centres.grains;
    }
    near(count, 300, 0);
    for (int k = 0; k < 2; k++) {
        near(moment[k], whole, 1e-13);
        near(solid[k], s.solid, 1e-13);
    }
    scree_average_view_close(&view);
    scree_average_sample_destroy(&s);
}

/// The same sample turned by a right angle, or mirrored: tensors turn along.
static void test_turned_and_mirrored(void **state)
{
    (void)state;
    for (int mirrored = 0; mirrored < 2; mirrored++) {
        scree_average_sample s = average_cloud(2, 200), t = average_cloud(2, 200);
        // Row by row what x and y become.
        const double q[2][2] = {{mirrored ? -1 : 0, mirrored ? 0 : -1}, {mirrored ? 0 : 1, mirrored ? 1 : 0}};
        for (size_t p = 0; p < t.bodies; p++)
            for (int i = 0; i < 2; i++)
                t.grain[p].position[i] = q[i][0] * s.grain[p].position[0] + q[i][1] * s.grain[p].position[1];
        for (size_t c = 0; c < t.contacts; c++) {
            double *to[4] = {t.contact[c].branch, t.contact[c].force, t.contact[c].point, t.contact[c].normal};
            const double *from[4] = {s.contact[c].branch, s.contact[c].force, s.contact[c].point, s.contact[c].normal};
            for (int k = 0; k < 4; k++)
                for (int i = 0; i < 2; i++) to[k][i] = q[i][0] * from[k][0] + q[i][1] * from[k][1];
        }
        average_finish(&s);
        average_finish(&t);
        scree_average_view one = open_view(&s, &(scree_average_plan){.side = 0.3});
        scree_average_view other = open_view(&t, &(scree_average_plan){.side = 0.3});
        const scree_average_element a = {{0.2, 0.3, 0}, {0.7, 0.6, 0}};
        const scree_average_element b = mirrored ? (scree_average_element){{-0.7, 0.3, 0}, {-0.2, 0.6, 0}}
                                                 : (scree_average_element){{-0.6, 0.2, 0}, {-0.3, 0.7, 0}};
        const scree_average_value v = value_of(&one, &a), w = value_of(&other, &b);
        const double *sums[2][3] = {{v.centres.moment, v.parts.branches, v.centres.normals},
                                    {w.centres.moment, w.parts.branches, w.centres.normals}};
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 2; i++)
                for (int j = 0; j < 2; j++) {
                    double turned = 0;
                    for (int m = 0; m < 4; m++) turned += q[i][m / 2] * q[j][m % 2] * sums[0][k][3 * (m / 2) + m % 2];
                    near(sums[1][k][3 * i + j], turned, 1e-12);
                }
        scree_average_view_close(&one);
        scree_average_view_close(&other);
        scree_average_sample_destroy(&s);
        scree_average_sample_destroy(&t);
    }
}

/// A single grain under two opposite forces: its moment is force times diameter.
static void test_single_grain(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; dimension++) {
        scree_average_sample s = average_begin(dimension);
        const uint32_t grain = average_add(&s, 1, 2, 0, 0.5);
        average_stand(&s, grain, (double[3]){1, 1.5, 0}, (double[3]){0, 9, 0});
        average_stand(&s, grain, (double[3]){1, 2.5, 0}, (double[3]){0, -9, 0});
        average_finish(&s);
        near(s.own[0].moment[4], -9 * 1.0, 1e-14);
        near(s.own[0].branches[4], 2, 1e-14);
        near(s.own[0].moment[0], 0, 1e-14);
        assert_int_equal(s.own[0].contacts, 2);
        near(s.unbalanced_ratio, 0, 1e-14);
        scree_average_sample_destroy(&s);
    }
}

/// A rectangle a x b: R's tensor has y^2 first; its long axis is the minor one.
static void test_inertia(void **state)
{
    (void)state;
    const double a = 3, b = 1, turn = 0.4;
    scree_average_sample s = average_begin(2);
    const double corner[4][2] = {{-a / 2, -b / 2}, {a / 2, -b / 2}, {a / 2, b / 2}, {-a / 2, b / 2}};
    memcpy(s.corner, corner, sizeof corner);
    const uint32_t one = average_add(&s, 0, 0, 0, 1.6), other = average_add(&s, 9, 0, 0, 1.6);
    s.grain[one].corner_count = s.grain[other].corner_count = 4;
    s.grain[one].volume = s.grain[other].volume = a * b;
    s.grain[other].angle = turn;
    average_touch(&s, one, other, (double[3]){1, 0, 0});
    average_finish(&s);
    near(s.own[0].inertia[0], a * b * b * b / 12, 1e-14);
    near(s.own[0].inertia[4], b * a * a * a / 12, 1e-14);
    near(s.own[0].inertia[1], 0, 1e-14);
    near(s.own[0].axis[0], 1, 1e-14);
    const double c = cos(turn), si = sin(turn), low = a * b * b * b / 12, high = b * a * a * a / 12;
    near(s.own[1].inertia[0], c * c * low + si * si * high, 1e-14);
    near(s.own[1].inertia[1], c * si * (low - high), 1e-14);
    near(s.own[1].axis[1], c * si, 1e-14);
    scree_average_view view = open_view(&s, &(scree_average_plan){.side = 1});
    const scree_average_element element = {{8, -2, 0}, {10, 2, 0}};
    near(told(&view, &element, SCREE_AVERAGE_INERTIA, "long_axis_angle"), turn * 180 / M_PI, 1e-10);
    near(told(&view, &element, SCREE_AVERAGE_INERTIA, "axes_angle"), turn * 180 / M_PI, 1e-10);
    near(told(&view, &element, SCREE_AVERAGE_INERTIA, "axes_order"), 1, 1e-12);
    near(told(&view, &element, SCREE_AVERAGE_INERTIA, "inertia_xx"), s.own[1].inertia[0] * a * b / 8, 1e-14);
    scree_average_view_close(&view);
    scree_average_sample_destroy(&s);
}

/// Half of an element above the surface of a lattice is outside; the density of the part inside is that of the lattice.
static void test_surface(void **state)
{
    (void)state;
    scree_average_sample s = average_lattice(12, 0.5, 1, 1);
    average_finish(&s);
    scree_average_view view = open_view(&s, &(scree_average_plan){.side = 4});
    // Three of its four heights lie in the sample, with the caps of the last row.
    const scree_average_element element = {{4, 9, 0}, {8, 13, 0}};
    const double inside = told(&view, &element, SCREE_AVERAGE_DENSITY, "inside");
    assert_true(inside > 0.70 && inside <= 0.75);
    near(told(&view, &element, SCREE_AVERAGE_DENSITY, "volume_fraction_parts"), 0.75 * M_PI / 4, 1e-13);
    near(told(&view, &element, SCREE_AVERAGE_DENSITY, "volume_fraction_parts_inside"), 0.75 * M_PI / 4 / inside, 1e-13);
    near(view.surface.base, 0, 1e-14);
    near(view.surface.highest, 12, 1e-14);
    near(view.frame.height, 12, 1e-13);
    near(view.frame.axis, 6, 1e-12);
    near(view.frame.half, 6, 0.25);
    scree_average_view_close(&view);
    scree_average_sample_destroy(&s);
}

/// The surface goes over the outline of a polygon and not over its circle: a square that lies flat fills its box.
static void test_surface_of_polygons(void **state)
{
    (void)state;
    scree_average_sample s = average_begin(2);
    const double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    memcpy(s.corner, corner, sizeof corner);
    for (uint32_t k = 0; k < 8; k++) {
        const uint32_t one = average_add(&s, 2 * k + 1, 1, 0, sqrt(2));
        s.grain[one].corner_count = 4;
        s.grain[one].volume = 4;
        average_stand(&s, one, (double[3]){2 * k + 1, 0, 0}, (double[3]){0, 1, 0});
    }
    average_finish(&s);
    scree_average_view view = open_view(&s, &(scree_average_plan){.side = 1});
    const scree_average_element element = {{4, 0, 0}, {8, 4, 0}};
    near(told(&view, &element, SCREE_AVERAGE_DENSITY, "inside"), 0.5, 1e-12);
    near(told(&view, &element, SCREE_AVERAGE_DENSITY, "volume_fraction_parts_inside"), 1, 1e-12);
    // All tops are equally high: the left corner of the first one.
    near(view.surface.highest, 2, 1e-14);
    near(view.surface.apex, 0, 1e-14);
    scree_average_view_close(&view);
    scree_average_sample_destroy(&s);
}

/// A column of so many grains under gravity.
static scree_average_sample stand_column(uint32_t grains)
{
    scree_average_sample s = average_begin(2);
    s.gravity[1] = -10;
    for (uint32_t k = 0; k < grains; k++) {
        const uint32_t grain = average_add(&s, 0, 2.0 * k + 1, 0, 1);
        const double above = 10 * s.grain[grain].mass * (grains - k);
        if (k == 0)
            average_stand(&s, grain, (double[3]){0, 0, 0}, (double[3]){0, above, 0});
        else
            average_touch(&s, grain, k - 1, (double[3]){0, above, 0});
    }
    average_finish(&s);
    return s;
}

/// What the averages of the lowest row say of the force on the floor.
static void test_plate(void **state)
{
    (void)state;
    scree_average_sample s = stand_column(40);
    double averages, weight;
    scree_average_view view = open_view(&s, &(scree_average_plan){.side = 2});
    near(view.plate, view.weight, 1e-9 * view.weight);
    scree_average_plate_force(&view, &averages, &weight);
    near(averages, weight, 1e-9 * weight);
    // A lower element is refused with its option.
    scree_error error = {0};
    scree_average_view_close(&view);
    assert_int_equal(scree_average_view_open(&s, &(scree_average_plan){.side = 90}, &view, &error), SCREE_ERROR_INPUT);
    assert_string_equal(error.field, "--element");
    scree_average_sample_destroy(&s);
}

/// A layer on a floor that repeats itself to the sides: images bear the plate no second time, and elements that reach
/// out of its free surface say so, as in a heap.
static void test_layer(void **state)
{
    (void)state;
    enum { WIDE = 12, HIGH = 8 };
    scree_average_sample s = average_begin(2);
    s.directions = 1;
    s.gravity[1] = -10;
    memcpy(s.lattice, (double[9]){WIDE, 0, 0, 0, 1, 0, 0, 0, 1}, sizeof s.lattice);
    for (uint32_t k = 0; k < WIDE * HIGH; k++) {
        const uint32_t grain = average_add(&s, k % WIDE + 0.5, k / WIDE + 0.5, 0, 0.5);
        const double above[3] = {0, 10 * s.grain[grain].mass * (HIGH - (double)(k / WIDE)), 0};
        if (k < WIDE)
            average_stand(&s, grain, (double[3]){s.grain[grain].position[0], 0, 0}, above);
        else
            average_touch(&s, grain, k - WIDE, above);
    }
    average_finish(&s);
    double averages, weight;
    scree_average_view view = open_view(&s, &(scree_average_plan){.side = 3});
    scree_average_plate_force(&view, &averages, &weight);
    near(averages, weight, 1e-12 * weight);
    // Columns of a quarter of a diameter cut tops by 0.1 of a radius at most.
    for (int over = 0; over < 3; over++) {
        const scree_average_element element = {{10, 5 + over, 0}, {13, 8 + over, 0}};
        near(told(&view, &element, SCREE_AVERAGE_DENSITY, "inside"), 1 - over / 3.0, 0.1 / 3);
    }
    scree_average_view_close(&view);
    scree_average_sample_destroy(&s);
}

/// A cell that leans both ways has less room than the box along the axes: an element that shall hold 16 of its 64
/// grains is a quarter of the cell, and the bulk density is that of the cell.
static void test_room_of_a_cell(void **state)
{
    (void)state;
    enum { N = 8 };
    scree_average_sample s = average_begin(2);
    const double lattice[9] = {N, 0.4 * N, 0, 0.3 * N, N, 0, 0, 0, 1}, room = (1 - 0.3 * 0.4) * N * N;
    s.directions = 3;
    memcpy(s.lattice, lattice, sizeof lattice);
    for (uint32_t k = 0; k < N * N; k++) {
        const double at[3] = {(double)(k % N) / N, (double)(k / N) / N, 0};
        double x[3];
        scree_matrix_apply(lattice, at, x);
        (void)average_add(&s, x[0], x[1], 0, 0.4);
    }
    average_touch(&s, 0, 1, (double[3]){1, 0, 0});
    average_finish(&s);
    scree_average_view view = open_view(&s, &(scree_average_plan){.grains = 16});
    near(view.frame.side * view.frame.side, 0.25 * room, 1e-12 * room);
    near(view.grains, 16, 1e-12);
    near(view.bulk_density, s.mass / (room * s.thickness), 1e-9 * view.bulk_density);
    scree_average_view_close(&view);
    scree_average_sample_destroy(&s);
}

/// R 2.42 with the sign of 2.43, d sigma_il / d x_l = rho g_i with compression positive: the pressure of a column under
/// its weight falls upwards, by the weight of a layer in each layer (R 2.42 would have it grow).
static void test_sign_of_equilibrium(void **state)
{
    (void)state;
    scree_average_sample s = stand_column(30);
    scree_average_view view = open_view(&s, &(scree_average_plan){.side = 2});
    double pressure[2], density[2];
    for (int k = 0; k < 2; k++) {
        const scree_average_element element = {{-1, 10 + 20.0 * k, 0}, {1, 12 + 20.0 * k, 0}};
        pressure[k] = -told(&view, &element, SCREE_AVERAGE_STRESS, "stress_yy");
        density[k] = 1000 * told(&view, &element, SCREE_AVERAGE_DENSITY, "volume_fraction");
    }
    near(density[0], density[1], 1e-9 * density[0]);
    near((pressure[1] - pressure[0]) / 20, density[0] * s.gravity[1], 1e-9 * density[0] * 10);
    scree_average_view_close(&view);
    scree_average_sample_destroy(&s);
}

static void test_bad_samples(void **state)
{
    (void)state;
    scree_error error;
    scree_average_sample s = average_begin(2);
    assert_int_equal(scree_average_sample_finish(&s, &error), SCREE_ERROR_INPUT);
    const uint32_t grain = average_add(&s, 0, 0, 0, 1);
    assert_int_equal(scree_average_sample_finish(&s, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "no contacts"));
    average_stand(&s, grain, (double[3]){0, -1, 0}, (double[3]){0, NAN, 0});
    assert_int_equal(scree_average_sample_finish(&s, &error), SCREE_ERROR_INPUT);
    scree_average_sample_destroy(&s);
}

/// Principal values of known tensors, degenerate ones too.
static void test_principal(void **state)
{
    (void)state;
    double value[3], direction[9];
    const double plain[9] = {2, 1, 0, 1, 2, 0, 0, 0, 0};
    scree_tensor_principal(plain, 2, value, direction);
    near(value[0], 3, 1e-14);
    near(value[1], 1, 1e-14);
    near(fabs(direction[0]), sqrt(0.5), 1e-14);
    const double solid[9] = {2, -1, 0, -1, 2, -1, 0, -1, 2};
    scree_tensor_principal(solid, 3, value, direction);
    near(value[0], 2 + sqrt(2), 1e-14);
    near(value[1], 2, 1e-14);
    near(value[2], 2 - sqrt(2), 1e-14);
    const double unit[9] = {5, 0, 0, 0, 5, 0, 0, 0, 5};
    near(scree_tensor_form_of(unit, 3).deviator, 0, 0);
    near(scree_tensor_form_of(plain, 2).angle, M_PI / 4, 1e-14);
    // What is round has no axis, whatever round-off leaves of it; of a disc-like one no direction is the largest.
    const double round[9] = {3, 2e-15, 0, 2e-15, 3, 0, 0, 0, 0}, flat[9] = {3, 2e-15, 0, 2e-15, 3, 0, 0, 0, 1};
    assert_true(isnan(scree_tensor_form_of(round, 2).angle));
    assert_true(isnan(scree_tensor_form_of(flat, 3).angle));
    near(scree_tensor_form_of(flat, 3).deviator, 2, 1e-14);
}

/// Thirty grains of three hundred are thirty: the side that a tenth of them fill, squared, over the room of a grain
/// falls below by round-off.
static void test_few(void **state)
{
    (void)state;
    assert_false(scree_average_are_few(29.999999999999996));
    assert_false(scree_average_are_few(30));
    assert_true(scree_average_are_few(29.99));
    assert_false(scree_average_are_few(NAN));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lattice),
        cmocka_unit_test(test_tiles),
        cmocka_unit_test(test_turned_and_mirrored),
        cmocka_unit_test(test_single_grain),
        cmocka_unit_test(test_inertia),
        cmocka_unit_test(test_surface),
        cmocka_unit_test(test_surface_of_polygons),
        cmocka_unit_test(test_plate),
        cmocka_unit_test(test_layer),
        cmocka_unit_test(test_room_of_a_cell),
        cmocka_unit_test(test_sign_of_equilibrium),
        cmocka_unit_test(test_bad_samples),
        cmocka_unit_test(test_principal),
        cmocka_unit_test(test_few),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
