/// Polygons: measures against closed forms, what is refused, generators.
#include "shape/polygon_make.h"
#include "shape/side.h"
#include "testing.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

typedef double corners[SCREE_POLYGON_CORNERS][2];

static const double (*as_const(double (*corner)[2]))[2]
{
    return (const double(*)[2])corner;
}

/// A closed form: sums of some tens of rounded terms of this size.
static void near(double value, double expected, double size)
{
    if (!(fabs(value - expected) <= 64 * 0x1p-53 * size)) fail_msg("%.17g is not %.17g", value, expected);
}

// ---- measures -----------------------------------------------------------------------------------------------------

static void test_closed_forms(void **state)
{
    (void)state;
    // A rectangle of 3 by 2, a million of its sizes from the origin: places are dyadic, so nothing may be lost.
    const double far = 0x1p20, box[4][2] = {{far, far}, {far + 3, far}, {far + 3, far + 2}, {far, far + 2}};
    scree_polygon_measures m = scree_polygon_measure(4, box);
    near(m.area, 6, 6);
    near(m.centroid[0] - far, 1.5, far);
    near(m.centroid[1] - far, 1, far);
    near(m.moment[0], 3 * 8 / 12.0, 2);
    near(m.moment[1], 2 * 27 / 12.0, 4.5);
    near(m.moment[2], 0, 3);
    near(m.radius, sqrt(6 / M_PI), 1.4);
    near(m.bound, sqrt(1.5 * 1.5 + 1), 1.8);
    // The triangle (0, 0), (1, 0), (0, 1): integrals of y^2 and x y about the origin 1/12 and 1/24.
    const double triangle[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    m = scree_polygon_measure(3, triangle);
    near(m.area, 0.5, 1);
    near(m.moment[0], 1 / 12.0 - 0.5 / 9, 1);
    near(m.moment[1], 1 / 12.0 - 0.5 / 9, 1);
    near(m.moment[2], 1 / 24.0 - 0.5 / 9, 1);
    // As R 2.91 prints its bracket, (x_k y_l + x_l y_k) for (x_k y_k + x_l y_l), it would be twice 1/24: the edge from
    // (1, 0) to (0, 1), the only one that counts, gives 1 + 1 instead of 0 + 1.
    const double *a = triangle[1], *b = triangle[2];
    double printed = a[0] * b[1] + b[0] * a[1] + (a[0] + b[0]) * (a[1] + b[1]);
    near(printed / 24, 2 / 24.0, 1);
}

static void test_regular(void **state)
{
    (void)state;
    for (int n = 3; n <= SCREE_POLYGON_CORNERS; n++) {
        corners corner;
        scree_error error = {0};
        scree_polygon_make_regular(n, 0.25, corner);
        check(scree_polygon_check(n, as_const(corner), &error), &error);
        scree_polygon_measures m = scree_polygon_measure(n, as_const(corner));
        double area = M_PI / 16, angle = 2 * M_PI / n, circle = sqrt(2 * area / (n * sin(angle)));
        near(m.area, area, 1);
        near(m.radius, 0.25, 1);
        near(m.bound, circle, 1);
        near(m.centroid[0], 0, 1);
        near(m.centroid[1], 0, 1);
        near(m.moment[0] + m.moment[1], area * circle * circle * (2 + cos(angle)) / 6, 1);
        near(m.moment[2], 0, 1);
    }
}

static void test_pose(void **state)
{
    (void)state;
    const double corner[3][2] = {{2, 1}, {0, 3}, {-1, -1}}, position[2] = {10, 20};
    double turned[3][2], placed[3][2];
    scree_polygon_turn(3, corner, 0, 1, turned);
    assert_true(turned[0][0] == -1 && turned[0][1] == 2);
    scree_polygon_place(3, corner, position, M_PI / 2, placed);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 2; i++) near(placed[k][i], position[i] + turned[k][i], 20);
}

// ---- sides --------------------------------------------------------------------------------------------------------

/// Points some last bits beside the line y = x (Kettner et al. 2008): the side is the sign of y - x, which rounded
/// products miss.
static void test_exact_sides(void **state)
{
    (void)state;
    const double a[2] = {12, 12}, b[2] = {24, 24};
    int missed = 0;
    for (int i = 0; i < 64; i++)
        for (int j = 0; j < 64; j++) {
            const double p[2] = {0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53};
            double expected = (p[1] > p[0]) - (p[1] < p[0]);
            const double *corner[3] = {a, b, p};
            for (int k = 0; k < 3; k++) {
                double side = scree_side(corner[k], corner[(k + 1) % 3], corner[(k + 2) % 3]);
                assert_true((side > 0) - (side < 0) == expected);
                near(scree_side_exact(corner[k], corner[(k + 1) % 3], corner[(k + 2) % 3]), 12 * (p[1] - p[0]),
                     fabs(12 * (p[1] - p[0])));
            }
            double rounded = (a[0] - p[0]) * (b[1] - p[1]) - (a[1] - p[1]) * (b[0] - p[0]);
            missed += (rounded > 0) - (rounded < 0) != expected;
        }
    // Else this would be no test of the exact part.
    assert_true(missed > 100);
    const double c[2] = {0.1, 0.7};
    assert_true(isnan(scree_side((const double[2]){NAN, 0}, b, c)));
    assert_true(scree_is_right(b, a, c) && !scree_is_right(a, b, c) && !scree_is_right(a, a, c));
}

// ---- check --------------------------------------------------------------------------------------------------------

static void refused(int count, const double (*corner)[2], const char *what, const char *where)
{
    scree_error error = {0};
    assert_int_equal(scree_polygon_check(count, corner, &error), SCREE_ERROR_INPUT);
    if (!strstr(error.message, what) || !strstr(error.message, where))
        fail_msg("'%s' does not say '%s' and '%s'", error.message, what, where);
}

static void test_bad_input(void **state)
{
    (void)state;
    const double square[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    scree_error error = {0};
    check(scree_polygon_check(4, square, &error), &error);
    refused(2, square, "3 to 32", "2");
    static const double thousand[1000][2];
    refused(1000, thousand, "3 to 32", "1000");
    refused(4, (const double[4][2]){{0, 0}, {1, 0}, {1, NAN}, {0, 1}}, "corner 2", "not a position");
    refused(4, (const double[4][2]){{0, 0}, {1, 0}, {1, 1}, {-INFINITY, 1}}, "corner 3", "not a position");
    refused(4, (const double[4][2]){{0, 0}, {0, 1}, {1, 1}, {1, 0}}, "clockwise", "opposite order");
    refused(5, (const double[5][2]){{0, 0}, {1, 0}, {0.4, 0.5}, {1, 1}, {0, 1}}, "not convex", "corner 2");
    refused(5, (const double[5][2]){{0, 0}, {1, 0}, {1, 1}, {0.5, 1}, {0, 1}}, "on the line", "corner 3");
    refused(5, (const double[5][2]){{0, 0}, {1, 0}, {1, 1}, {1, 1}, {0, 1}}, "same", "corners 2 and 3");
    refused(4, (const double[4][2]){{0, 0}, {1, 0}, {0, 1}, {1, 1}}, "crosses itself", "corners 1 and 3");
    // A corner that stands out by a little more, and a little less, than the least share of the extent, which is
    // sqrt 2.
    for (int k = 0; k < 2; k++) {
        double out = (k ? 0.9 : 1.1) * sqrt(2) * SCREE_POLYGON_FLAT;
        const double bulge[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0.5, 1 + out}, {0, 1}};
        if (k == 0) check(scree_polygon_check(5, bulge, &error), &error);
        if (k == 1) refused(5, bulge, "within", "corner 3");
    }
    // A star turns left at every corner, twice round.
    double star[5][2];
    for (int k = 0; k < 5; k++) {
        star[k][0] = cos(4 * M_PI * k / 5);
        star[k][1] = sin(4 * M_PI * k / 5);
    }
    refused(5, as_const(star), "crosses itself", "corners 0 and 2");
}

// ---- generators ---------------------------------------------------------------------------------------------------

/// Centre and square of the radius of the circle through three corners, x by 1/sqrt(axes), y by sqrt(axes).
static double circle_through(const double (*corner)[2], double axes, double centre[2])
{
    double p[3][2], u[2], v[2];
    for (int k = 0; k < 3; k++) {
        p[k][0] = corner[k][0] / sqrt(axes);
        p[k][1] = corner[k][1] * sqrt(axes);
    }
    for (int i = 0; i < 2; i++) {
        u[i] = p[1][i] - p[0][i];
        v[i] = p[2][i] - p[0][i];
    }
    double twice = 2 * (u[0] * v[1] - u[1] * v[0]), uu = u[0] * u[0] + u[1] * u[1], vv = v[0] * v[0] + v[1] * v[1];
    double x = (v[1] * uu - u[1] * vv) / twice, y = (u[0] * vv - v[0] * uu) / twice;
    centre[0] = p[0][0] + x;
    centre[1] = p[0][1] + y;
    return x * x + y * y;
}

/// Equal area, centroid in the origin, corners on one ellipse, in sectors one each.
static void test_ellipses(void **state)
{
    (void)state;
    int apart = 0;
    for (uint64_t id = 0; id < 400; id++) {
        int count = scree_polygon_draw_count(1, id, 4, 12);
        double axes = 1 + (double)(id % 5) / 2, centre[2];
        scree_polygon_scatter scatter = id % 2 ? SCREE_POLYGON_FREE : SCREE_POLYGON_SECTORS;
        corners corner;
        scree_error error = {0};
        check(scree_polygon_make_on_ellipse(1, id, count, axes, scatter, 2.5, corner, &error), &error);
        scree_polygon_measures m = scree_polygon_measure(count, as_const(corner));
        near(m.radius, 2.5, m.bound);
        near(m.centroid[0], 0, 16 * m.bound);
        near(m.centroid[1], 0, 16 * m.bound);
        if (m.bound > 6) continue; // slivers, from whose corners no circle is found again
        double square = circle_through(as_const(corner), axes, centre);
        for (int k = 0; k < count; k++) {
            double x = corner[k][0] / sqrt(axes) - centre[0], y = corner[k][1] * sqrt(axes) - centre[1];
            // The circle is found from corners that may lie near each other: round-off over the square of their
            // distance.
            assert_true(fabs(x * x + y * y - square) < 1e-8 * square);
            double sector = atan2(y, x) / (2 * M_PI) * count;
            if (sector < 0) sector += count;
            bool own = sector > k - 1e-6 && sector < k + 1 + 1e-6;
            if (scatter == SCREE_POLYGON_SECTORS) assert_true(own);
            apart += !own;
        }
    }
    // All at random, corners do not keep to sectors.
    assert_true(apart > 100);
}

static void test_pure_functions(void **state)
{
    (void)state;
    corners first, again, other;
    scree_error error = {0};
    check(scree_polygon_make_on_ellipse(5, 77, 8, 2, SCREE_POLYGON_SECTORS, 1, first, &error), &error);
    check(scree_polygon_make_on_ellipse(5, 78, 8, 2, SCREE_POLYGON_SECTORS, 1, other, &error), &error);
    check(scree_polygon_make_on_ellipse(5, 77, 8, 2, SCREE_POLYGON_SECTORS, 1, again, &error), &error);
    assert_memory_equal(first, again, 8 * sizeof *first);
    assert_memory_not_equal(first, other, 8 * sizeof *first);
    check(scree_polygon_make_on_ellipse(6, 77, 8, 2, SCREE_POLYGON_SECTORS, 1, other, &error), &error);
    assert_memory_not_equal(first, other, 8 * sizeof *first);
    assert_int_equal(scree_polygon_make_on_ellipse(5, 1, 8, 1e9, SCREE_POLYGON_SECTORS, 1, other, &error),
                     SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "too long"));
    assert_int_equal(scree_polygon_make_on_ellipse(5, 1, 8, 0.5, SCREE_POLYGON_SECTORS, 1, other, &error),
                     SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "1 or more"));
}

/// Each number equally often, within five standard deviations of 9000 draws of 1 in 3.
static void test_counts(void **state)
{
    (void)state;
    int seen[3] = {0};
    for (uint64_t id = 0; id < 9000; id++) {
        int count = scree_polygon_draw_count(3, id, 6, 8);
        assert_in_range(count, 6, 8);
        seen[count - 6]++;
    }
    for (int k = 0; k < 3; k++) assert_true(fabs(seen[k] - 3000.0) < 5 * sqrt(9000 * 2 / 9.0));
    assert_int_equal(scree_polygon_draw_count(3, 1, 7, 7), 7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_closed_forms),   cmocka_unit_test(test_regular),   cmocka_unit_test(test_pose),
        cmocka_unit_test(test_exact_sides),    cmocka_unit_test(test_bad_input), cmocka_unit_test(test_ellipses),
        cmocka_unit_test(test_pure_functions), cmocka_unit_test(test_counts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
