/// Smooth fields: the whole of everything, the balance of momentum to round-off, threads, images.
#include "average_fixture.h"

#include "average/fields.h"
#include "average/kernel.h"
#include "base/matrix.h"

#include <string.h>

static scree_average_points grid(int dimension, size_t n, double low, double high)
{
    scree_average_points points = {.number = {n, n, dimension == 3 ? n : 1}, .gap = {1, 1, 1}};
    for (int k = 0; k < dimension; k++) {
        points.gap[k] = (high - low) / (double)n;
        points.first[k] = low + 0.5 * points.gap[k];
    }
    return points;
}

static scree_average_kernel find(const scree_average_sample *s, double width, const scree_average_points *points,
                                 int threads)
{
    scree_average_kernel kernel;
    scree_error error;
    check(scree_average_kernel_find(s, width, points, true, threads, &kernel, &error), &error);
    return kernel;
}

/// Integrals over space: all of the mass, of the moments of the branches, of the forces of the outside. Sums over a
/// grid are exact up to the smoothness of the kernel (C^2): (gap / width)^4 and less.
static void test_integrals(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; dimension++) {
        scree_average_sample s = average_cloud(dimension, dimension == 2 ? 100 : 25);
        average_finish(&s);
        const scree_average_points points = grid(dimension, dimension == 2 ? 160 : 60, -0.5, 1.5);
        scree_average_kernel k = find(&s, 0.3, &points, 1);
        const double cell = pow(points.gap[0], dimension) * s.thickness;
        const size_t d = (size_t)dimension;
        double mass = 0, moment[9] = {0}, whole[9] = {0}, outside = 0, all = 0;
        for (size_t p = 0; p < k.count; p++) {
            mass += k.density[p] * cell;
            outside += k.boundary[d * p + 1] * cell;
            for (size_t a = 0; a < d * d; a++) moment[a] += k.stress[d * d * p + a] * cell;
        }
        // Minus force times branch, of all contacts: the sum of all moments of grains.
        for (size_t p = 0; p < s.bodies; p++)
            for (size_t a = 0; a < d * d; a++) whole[a] += s.own[p].moment[3 * (a / d) + a % d];
        for (size_t c = 0; c < s.contacts; c++)
            if (s.contact[c].second == SCREE_AVERAGE_OUTSIDE) all += s.contact[c].force[1];
        near(mass, s.mass, 1e-4 * s.mass);
        near(outside, all, 1e-3);
        for (size_t a = 0; a < d * d; a++) near(moment[a], whole[a], 1e-3);
        scree_average_kernel_destroy(&k);
        scree_average_sample_destroy(&s);
    }
}

/// div stress + boundary + density g = resultants, in a sample that is far from rest, near its walls too.
static void test_balance(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; dimension++) {
        scree_average_sample s = average_cloud(dimension, 120);
        s.grain[7].counted = false; // what is prescribed or a membrane is outside
        average_finish(&s);
        const scree_average_points points = grid(dimension, dimension == 2 ? 40 : 14, -0.2, 1.2);
        scree_average_kernel k = find(&s, 0.25, &points, 1);
        const scree_average_balance balance = scree_average_kernel_balance(&s, &k);
        assert_true(balance.rest > 0.01 * balance.scale);
        assert_true(balance.residual < 1e-12 * balance.scale + 1e-10);
        scree_average_kernel_destroy(&k);
        scree_average_sample_destroy(&s);
    }
}

/// The divergence that is told is that of the stress that is told: central differences converge to it with the square
/// of their distance.
static void test_divergence(void **state)
{
    (void)state;
    scree_average_sample s = average_cloud(2, 60);
    average_finish(&s);
    double error[2];
    for (int level = 0; level < 2; level++) {
        const double h = level == 0 ? 2e-3 : 1e-3;
        const scree_average_points points = {.number = {3, 3, 1}, .first = {0.45 - h, 0.55 - h, 0}, .gap = {h, h, 1}};
        scree_average_kernel k = find(&s, 0.4, &points, 1);
        error[level] = 0;
        for (size_t a = 0; a < 2; a++) {
            // Points are numbered along x first: 4 is the middle, 3 and 5 beside, 1 and 7 below and above it.
            const double across = (k.stress[4 * 5 + 2 * a] - k.stress[4 * 3 + 2 * a]) / (2 * h);
            const double up = (k.stress[4 * 7 + 2 * a + 1] - k.stress[4 * 1 + 2 * a + 1]) / (2 * h);
            error[level] = fmax(error[level], fabs(across + up - k.divergence[2 * 4 + a]));
        }
        assert_true(fabs(k.divergence[8]) > 1);
        scree_average_kernel_destroy(&k);
    }
    assert_true(error[0] < 0.5);
    near(error[0] / error[1], 4, 0.4);
    scree_average_sample_destroy(&s);
}

/// Uniform stress of a lattice, a kernel's width away from its ends; turned by a right angle the components change
/// places.
static void test_lattice(void **state)
{
    (void)state;
    const double r = 0.5;
    scree_average_sample s = average_lattice(16, r, 3, 7);
    average_finish(&s);
    const scree_average_points points = grid(2, 8, 6, 10);
    scree_average_kernel k = find(&s, 5, &points, 1);
    for (size_t p = 0; p < k.count; p++) {
        // Wide kernels see no grains: what is left of them falls with the smoothness of the kernel.
        near(k.stress[4 * p], -3 / (2 * r * s.thickness), 0.01);
        near(k.stress[4 * p + 3], -7 / (2 * r * s.thickness), 0.02);
        near(k.stress[4 * p + 1], 0, 1e-12);
        near(k.fraction[p], M_PI / 4, 1e-3);
    }
    scree_average_kernel_destroy(&k);
    scree_average_sample_destroy(&s);
}

/// A kernel has the value of its formula, is symmetric, and has no slope at its rim.
static void test_kernel(void **state)
{
    (void)state;
    near(scree_average_kernel_value(2, 2, (double[3]){0, 0, 0}), 1 / M_PI, 1e-15);
    near(scree_average_kernel_value(3, 1, (double[3]){0, 0, 0}), 315 / (64 * M_PI), 1e-15);
    near(scree_average_kernel_value(2, 2, (double[3]){1, 0, 0}), 27.0 / 64 / M_PI, 1e-15);
    near(scree_average_kernel_value(2, 2, (double[3]){0, 2, 0}), 0, 0);
    near(scree_average_kernel_value(2, 2, (double[3]){0, 1.999, 0}), 0, 1e-8);
}

static void test_threads(void **state)
{
    (void)state;
    scree_average_sample s = average_cloud(2, 100);
    average_finish(&s);
    const scree_average_points points = grid(2, 30, 0, 1);
    scree_average_kernel one = find(&s, 0.2, &points, 1), three = find(&s, 0.2, &points, 3);
    assert_memory_equal(one.stress, three.stress, 4 * one.count * sizeof(double));
    assert_memory_equal(one.density, three.density, one.count * sizeof(double));
    assert_memory_equal(one.divergence, three.divergence, 2 * one.count * sizeof(double));
    scree_average_kernel_destroy(&one);
    scree_average_kernel_destroy(&three);
    scree_average_sample_destroy(&s);
}

/// A cell that repeats itself: fields do too, and the balance holds at its faces.
static void test_images(void **state)
{
    (void)state;
    scree_average_sample s = average_begin(2);
    scree_error error;
    s.directions = 3;
    s.lattice[0] = s.lattice[4] = 4;
    s.lattice[1] = 0.6; // a skewed one
    s.lattice[8] = 1;
    for (size_t k = 0; k < 16; k++)
        (void)average_add(&s, (double)(k % 4) + 0.5 + 0.15 * (double)(k / 4), (double)(k / 4) + 0.5, 0, 0.5);
    for (uint32_t k = 0; k < 16; k++) {
        const double along[3] = {average_random(k), 0.1, 0}, up[3] = {0.2, average_random(k + 16), 0};
        const uint32_t right = k % 4 == 3 ? k - 3 : k + 1, above = k < 12 ? k + 4 : k - 12;
        average_touch(&s, k, right, along);
        average_touch(&s, k, above, up);
        // Branches to the images.
        memcpy(s.contact[s.contacts - 2].branch, (double[3]){-1, 0, 0}, 24);
        memcpy(s.contact[s.contacts - 1].branch, (double[3]){-0.15, -1, 0}, 24);
    }
    average_finish(&s);
    check(scree_average_sample_repeat(&s, 4, &error), &error);
    assert_true(s.count > 2 * s.bodies);
    const scree_average_points points = {.number = {5, 5, 1}, .first = {0, 0, 0}, .gap = {1, 1, 1}};
    scree_average_kernel k = find(&s, 1.7, &points, 1);
    const scree_average_balance balance = scree_average_kernel_balance(&s, &k);
    assert_true(balance.scale > 0.1);
    assert_true(balance.residual < 1e-13 * balance.scale);
    for (size_t row = 0; row < 5; row++)
        for (size_t a = 0; a < 4; a++) near(k.stress[4 * (5 * row) + a], k.stress[4 * (5 * row + 4) + a], 1e-12);
    scree_average_kernel_destroy(&k);
    scree_average_sample_destroy(&s);
}

/// Grains of two sizes, one in 30 fifteen times larger, that touch across the faces of a cell that leans by `lean`.
static scree_average_sample leaning_cell(double lean)
{
    enum { N = 60 };
    scree_average_sample s = average_begin(2);
    const double lattice[9] = {1, lean, 0, 0, 1.2, 0, 0, 0, 1};
    uint64_t at = 700;
    s.directions = 3;
    s.gravity[1] = -1;
    memcpy(s.lattice, lattice, sizeof s.lattice);
    for (uint32_t k = 0; k < 2 * N; k++) {
        double fraction[3] = {average_random(at), average_random(at + 1), 0}, x[3], y[3];
        const double angle = 2 * M_PI * average_random(at + 2),
                     force[3] = {average_random(at + 3), average_random(at + 4), 0};
        at += 5;
        scree_matrix_apply(lattice, fraction, x);
        const uint32_t one = average_add(&s, x[0], x[1], 0, k % 30 == 3 ? 0.3 : 0.02);
        const double apart = s.grain[one].radius + 0.02, way[3] = {apart * cos(angle), apart * sin(angle), 0};
        double inverse[9];
        scree_matrix_invert(lattice, inverse);
        scree_along(x, 1, way, y);
        scree_matrix_apply(inverse, y, fraction);
        for (int i = 0; i < 2; i++) fraction[i] -= floor(fraction[i]);
        scree_matrix_apply(lattice, fraction, y);
        const uint32_t other = average_add(&s, y[0], y[1], 0, 0.02);
        average_touch(&s, k % 2 ? one : other, k % 2 ? other : one, force);
        scree_average_contact *c = &s.contact[s.contacts - 1];
        for (int i = 0; i < 2; i++) c->branch[i] = k % 2 ? -way[i] : way[i];
        memcpy(c->normal, c->branch, sizeof c->normal);
        (void)scree_normalise(c->normal);
        scree_along(s.grain[c->first].position, -s.grain[c->first].radius, c->normal, c->point);
    }
    average_finish(&s);
    return s;
}

/// Elements and points lie in a box along the axes, which a cell that leans does not fill: everything is in it once all
/// the same, with images within the width of the kernel, also where grains are far larger than the mean. Sums over a
/// grid are exact up to (gap / width)^4.
static void test_leaning_cells(void **state)
{
    (void)state;
    const double lean[] = {0, 0.51, -0.7, 2.4};
    for (size_t l = 0; l < sizeof lean / sizeof *lean; l++) {
        enum { N = 40, TILES = 5 };
        scree_average_sample s = leaning_cell(lean[l]);
        scree_error error;
        check(scree_average_sample_repeat(&s, 0.1, &error),
              &error); // too few, as those of a narrow kernel for elements
        check(scree_average_sample_repeat(&s, 0.25, &error), &error);
        const scree_average_points points = {
            .number = {N, N, 1}, .first = {0.5 / N, 0.6 / N, 0}, .gap = {1.0 / N, 1.2 / N, 1}};
        scree_average_kernel k = find(&s, 0.25, &points, 1);
        const scree_average_balance balance = scree_average_kernel_balance(&s, &k);
        assert_true(balance.residual < 1e-13 * balance.scale);
        double mass = 0, stress[4] = {0}, branches[4] = {0};
        for (size_t p = 0; p < k.count; p++) {
            mass += k.density[p] * 1.2 / (N * N) * s.thickness;
            for (size_t a = 0; a < 4; a++) stress[a] += k.stress[4 * p + a] * 1.2 / (N * N) * s.thickness;
        }
        for (size_t c = 0; c < s.contacts; c++)
            for (int a = 0; a < 4; a++) branches[a] -= s.contact[c].force[a / 2] * s.contact[c].branch[a % 2];
        near(mass / s.mass, 1, 1e-5);
        for (int a = 0; a < 4; a++) near(stress[a], branches[a], 1e-4 * fabs(branches[0]));
        scree_average_kernel_destroy(&k);
        // The same of elements that fill the box.
        scree_average_bins bins;
        scree_average_surface surface;
        double grains = 0, solid = 0;
        check(scree_average_bins_make(&s, 0.1, &bins, &error), &error);
        check(scree_average_surface_find(&s, &surface, &error), &error);
        for (int i = 0; i < TILES * TILES; i++) {
            const double x = i % TILES, y = 1.2 * (double)(i / TILES);
            const scree_average_element element = {{x / TILES, y / TILES, 0}, {(x + 1) / TILES, (y + 1.2) / TILES, 0}};
            scree_average_value value;
            scree_average_measure(&s, &bins, &surface, &element, &value);
            grains += value.centres.grains;
            solid += value.parts.solid;
        }
        near(grains, (double)s.counted, 0);
        near(solid / s.solid, 1, 1e-12);
        scree_average_surface_destroy(&surface);
        scree_average_bins_destroy(&bins);
        scree_average_sample_destroy(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_kernel),     cmocka_unit_test(test_integrals),     cmocka_unit_test(test_balance),
        cmocka_unit_test(test_divergence), cmocka_unit_test(test_lattice),       cmocka_unit_test(test_threads),
        cmocka_unit_test(test_images),     cmocka_unit_test(test_leaning_cells),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
