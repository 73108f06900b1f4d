/// Exact parts of grains in elements: against closed forms, against tilings, and against counting.
#include "average_fixture.h"

#include "average/element.h"

#define R 1.7

/// Area of a disc left of x.
static double segment(double r, double x)
{
    return r * r * (M_PI / 2 + asin(x / r)) + x * sqrt(r * r - x * x);
}

static void test_disc_closed_forms(void **state)
{
    (void)state;
    const double all = M_PI * R * R, far = 5;
    near(scree_average_disc_part(R, -far, far, -far, far), all, 1e-14 * all);
    near(scree_average_disc_part(R, 0, far, -far, far), all / 2, 1e-14 * all);
    near(scree_average_disc_part(R, 0, far, 0, far), all / 4, 1e-14 * all);
    for (double x = -1.6; x < 1.7; x += 0.4) {
        near(scree_average_disc_part(R, -far, x, -far, far), segment(R, x), 1e-14 * all);
        near(scree_average_disc_part(R, -far, far, -far, x), segment(R, x), 1e-14 * all);
    }
    // A square inside; one outside of a corner.
    near(scree_average_disc_part(R, -0.5, 0.3, -0.2, 0.6), 0.64, 1e-14);
    near(scree_average_disc_part(R, 1.3, far, 1.3, far), 0, 1e-14);
    near(scree_average_disc_part(R, 2, far, -1, 1), 0, 0);
}

/// Parts in rectangles that fill the plane add up, whatever the cuts are.
static void test_disc_tiles(void **state)
{
    (void)state;
    uint64_t at = 0;
    for (int trial = 0; trial < 200; trial++) {
        const double x[4] = {-9, 4 * average_random(at) - 2, 4 * average_random(at + 1) - 2, 9};
        const double y[4] = {-9, 4 * average_random(at + 2) - 2, 4 * average_random(at + 3) - 2, 9};
        double sum = 0;
        at += 4;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                const double dx = x[i + 1] - x[i], dy = y[j + 1] - y[j];
                // A cut behind the next one is taken off again.
                const double part = scree_average_disc_part(R, fmin(x[i], x[i + 1]), fmax(x[i], x[i + 1]),
                                                            fmin(y[j], y[j + 1]), fmax(y[j], y[j + 1]));
                sum += (dx < 0 ? -1 : 1) * (dy < 0 ? -1 : 1) * part;
            }
        near(sum, M_PI * R * R, 1e-13);
    }
}

/// Against a count of points on a fine grid: the error is that of the border, half a cell along it.
static void test_disc_counted(void **state)
{
    (void)state;
    enum { N = 1000 };
    const double x0 = -0.4, x1 = 1.5, y0 = 0.3, y1 = 1.6, cell = (x1 - x0) * (y1 - y0) / N / N;
    double count = 0;
    for (int i = 0; i < N * N; i++) {
        const double x = x0 + (i % N + 0.5) / N * (x1 - x0), y = y0 + (i / N + 0.5) / N * (y1 - y0);
        count += x * x + y * y < R * R;
    }
    near(scree_average_disc_part(R, x0, x1, y0, y1), count * cell, 1e-4);
}

static void test_sphere_closed_forms(void **state)
{
    (void)state;
    const double all = 4.0 / 3 * M_PI * R * R * R, far = 5;
    const double whole[2][3] = {{-far, -far, -far}, {far, far, far}};
    near(scree_average_sphere_part(R, whole[0], whole[1]), all, 1e-8 * all);
    near(scree_average_sphere_part(R, (double[3]){0, 0, 0}, whole[1]), all / 8, 1e-8 * all);
    for (int axis = 0; axis < 3; axis++)
        for (double h = 0.1; h < 2 * R; h += 0.3) {
            double low[3] = {-far, -far, -far};
            low[axis] = R - h;
            const double cap = M_PI * h * h * (3 * R - h) / 3;
            near(scree_average_sphere_part(R, low, whole[1]), cap, 1e-8 * all);
        }
    const double box[2][3] = {{-0.4, -0.3, -0.2}, {0.5, 0.6, 0.9}};
    near(scree_average_sphere_part(R, box[0], box[1]), 0.9 * 0.9 * 1.1, 1e-8);
}

/// Parts in boxes add up to the whole, and do not depend on which axis is integrated along.
static void test_sphere_tiles(void **state)
{
    (void)state;
    uint64_t at = 1000;
    for (int trial = 0; trial < 40; trial++) {
        double cut[3], sum = 0, one = 0, other = 0;
        for (int k = 0; k < 3; k++) cut[k] = 3.4 * average_random(at++) - 1.7;
        for (int corner = 0; corner < 8; corner++) {
            double low[3], high[3];
            for (int k = 0; k < 3; k++) {
                low[k] = corner >> k & 1 ? cut[k] : -9;
                high[k] = corner >> k & 1 ? 9 : cut[k];
            }
            const double part = scree_average_sphere_part(R, low, high);
            const double turned = scree_average_sphere_part(R, (double[3]){low[1], low[2], low[0]},
                                                            (double[3]){high[1], high[2], high[0]});
            one = fmax(one, fabs(part - turned));
            other = fmax(other, part);
            sum += part;
        }
        near(sum, 4.0 / 3 * M_PI * R * R * R, 1e-8 * 20);
        near(one, 0, 1e-8 * 20); // what element.h says
    }
}

static void test_polygon(void **state)
{
    (void)state;
    const double triangle[3][2] = {{0, 0}, {2, 0}, {0, 2}};
    near(scree_average_polygon_part(3, triangle, -5, 5, -5, 5), 2, 1e-15);
    near(scree_average_polygon_part(3, triangle, 0, 1, 0, 1), 1, 1e-15);
    near(scree_average_polygon_part(3, triangle, 1, 5, -5, 5), 0.5, 1e-15);
    near(scree_average_polygon_part(3, triangle, 1.5, 5, 1.5, 5), 0, 0);
    // Many corners on a circle: a disc but for the segments between them.
    double many[32][2];
    for (int k = 0; k < 32; k++) many[k][0] = R * cos(k * M_PI / 16), many[k][1] = R * sin(k * M_PI / 16);
    const double disc = scree_average_disc_part(R, -0.3, 1.2, 0.2, 5);
    near(scree_average_polygon_part(32, (const double(*)[2])many, -0.3, 1.2, 0.2, 5), disc, 0.01 * disc);
    assert_true(scree_average_polygon_part(32, (const double(*)[2])many, -0.3, 1.2, 0.2, 5) < disc);
    double sum = 0;
    const double x[4] = {-9, -0.33, 0.71, 9};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            sum += scree_average_polygon_part(32, (const double(*)[2])many, x[i], x[i + 1], x[j], x[j + 1]);
    near(sum, 16 * R * R * sin(M_PI / 16), 1e-13);
}

/// A grain in its sample: its place and its turn count.
static void test_grain(void **state)
{
    (void)state;
    scree_average_sample s = average_begin(2);
    const uint32_t disc = average_add(&s, 3, 4, 0, 1), square = average_add(&s, 10, 0, 0, sqrt(2));
    const double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    memcpy(s.corner, corner, sizeof corner);
    s.grain[square].corner_count = 4;
    s.grain[square].volume = 4;
    const scree_average_element half = scree_average_element_at((double[3]){2, 4, 0}, (double[3]){2, 9, 0});
    near(scree_average_part(&s, &s.grain[disc], &half), 0.5, 1e-14);
    const scree_average_element right = {{11, -5, 0}, {15, 5, 0}};
    near(scree_average_part(&s, &s.grain[square], &right), 0, 0);
    s.grain[square].angle = M_PI / 4; // it stands on a corner: a triangle of height sqrt(2) - 1 sticks out
    near(scree_average_part(&s, &s.grain[square], &right), pow(sqrt(2) - 1, 2) / 4, 1e-14);
    scree_average_sample_destroy(&s);
}

/// Rounded corners: exact where sectors are cut nowhere; where they are, their fans of triangles are off by 1e-3 of
/// what they add.
static void test_rounded_grain(void **state)
{
    (void)state;
    const double r = 0.5, all = 4 + 8 * r + M_PI * r * r;
    scree_average_sample s = average_begin(2);
    const uint32_t square = average_add(&s, 10, 0, 0, sqrt(2) + r);
    const double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    memcpy(s.corner, corner, sizeof corner);
    s.grain[square].corner_count = 4;
    s.grain[square].rounding = r;
    s.grain[square].volume = all;
    const scree_average_element right = {{11, -5, 0}, {15, 5, 0}}, far = {{11.25, -5, 0}, {15, 5, 0}};
    near(scree_average_part(&s, &s.grain[square], &right), (2 * r + M_PI * r * r / 2) / all, 1e-14);
    const double cut = 2 * r * 0.5 + r * r * (M_PI / 3 - sqrt(3) / 4);
    near(scree_average_part(&s, &s.grain[square], &far), cut / all, 1e-3 * cut / all);
    double sum = 0;
    for (int k = 0; k < 8; k++) {
        const scree_average_element strip = {{7 + k, -5, 0}, {8 + k, 5, 0}};
        sum += scree_average_part(&s, &s.grain[square], &strip);
    }
    near(sum, 1, 1e-14);
    scree_average_sample_destroy(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_disc_closed_forms),
        cmocka_unit_test(test_disc_tiles),
        cmocka_unit_test(test_disc_counted),
        cmocka_unit_test(test_sphere_closed_forms),
        cmocka_unit_test(test_sphere_tiles),
        cmocka_unit_test(test_polygon),
        cmocka_unit_test(test_grain),
        cmocka_unit_test(test_rounded_grain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
