/// Line load on a half-space and on a layer: balance of forces, compatibility, surface, base, force, limits. These
/// decide an elastic plane field, so a field that fulfils them is the solution.
#include "testing.h"

#include "theory/layer.h"

#include <gsl/gsl_integration.h>
#include <math.h>

#define assert_near(value, expected, tolerance)                                                                        \
    do {                                                                                                               \
        const double value_ = (value), expected_ = (expected);                                                         \
        if (!(fabs(value_ - expected_) <= (tolerance))) fail_msg("%s = %.15g, not %.15g", #value, value_, expected_);  \
    } while (0)

static scree_stress_2d stress(scree_layer layer, double x, double y)
{
    scree_error error = {0};
    scree_stress_2d s;
    check(scree_layer_stress(&layer, x, y, &s, &error), &error);
    return s;
}

static const double poissons[] = {-0.5, 0, 0.2, 0.3, 0.45, 0.5};
enum { POISSONS = sizeof poissons / sizeof poissons[0] };

/// R 5.2 - 5.4: a radial field, 2 F cos(angle) / (pi r), whose force through any circle is F.
static void flamant_is_radial(void **unused)
{
    (void)unused;
    double force = 0, side = 0;
    enum { STEPS = 100 };
    for (int k = 0; k < STEPS; k++) {
        const double angle = M_PI * ((k + 0.5) / STEPS - 0.5), r = 0.7, e[2] = {sin(angle), cos(angle)};
        const scree_stress_2d s = scree_flamant_stress(300, r * e[0], r * e[1]);
        const double traction[2] = {s.xx * e[0] + s.xy * e[1], s.xy * e[0] + s.yy * e[1]};
        const double radial = 2 * 300 * cos(angle) / (M_PI * r);
        assert_near(traction[0], radial * e[0], 1e-10);
        assert_near(traction[1], radial * e[1], 1e-10);
        assert_near(s.xx + s.yy, radial, 1e-10);
        force += traction[1] * r * M_PI / STEPS;
        side += traction[0] * r * M_PI / STEPS;
    }
    // Trapezoids over a period are exact.
    assert_near(force, 300, 1e-10);
    assert_near(side, 0, 1e-10);
}

static void residuals_vanish(void **unused)
{
    (void)unused;
    for (int base = SCREE_LAYER_SMOOTH; base <= SCREE_LAYER_NONE; base++)
        for (int k = 0; k < POISSONS; k++) {
            const scree_layer layer = {
                .force = 300, .thickness = 0.15, .poisson = poissons[k], .base = (scree_layer_base)base};
            scree_error error = {0};
            scree_layer_check c;
            check(scree_layer_examine(&layer, &c, &error), &error);
            // Differences of twelfth order over steps of 0.02 of the depth; second ones keep fewer digits.
            assert_near(c.equilibrium, 0, 1e-11);
            assert_near(c.compatibility, 0, 1e-9);
            assert_near(c.surface, 0, 1e-11);
            assert_near(c.base, 0, 1e-11);
            // Trapezoids over the far ends, which fall slowest (exp(-0.74 x / H)) where nothing can change its volume.
            assert_near(c.force, 0, 1e-11);
        }
}

/// A base without friction and the free surface are planes of the mirror: two opposite loads on a layer of twice the
/// thickness. Its stress on the middle plane has a closed transform, taken here by another quadrature.
static double middle_plane(double h, void *unused)
{
    (void)unused;
    return h > 0 ? 2 * (sinh(h) + h * cosh(h)) / (sinh(2 * h) + 2 * h) / M_PI : 1 / M_PI;
}

static void smooth_base_by_the_mirror(void **unused)
{
    (void)unused;
    gsl_integration_workspace *room = gsl_integration_workspace_alloc(1000);
    gsl_function f = {middle_plane, NULL};
    for (double x = 0; x < 4; x += 0.4) {
        double value, error;
        gsl_integration_qawo_table *wave = gsl_integration_qawo_table_alloc(x, 40, GSL_INTEG_COSINE, 20);
        assert_int_equal(gsl_integration_qawo(&f, 0, 1e-12, 1e-10, 1000, room, wave, &value, &error), 0);
        assert_near(stress((scree_layer){1, 1, 0.3, SCREE_LAYER_SMOOTH}, x, 1).yy, value, 1e-10);
        gsl_integration_qawo_table_free(wave);
    }
    gsl_integration_workspace_free(room);
}

/// Of great thickness a layer is a half-space: what the base changes falls as (y / H)^3, of sigma_xx as y / H, which is
/// that of a beam.
static void thick_layers_are_half_spaces(void **unused)
{
    (void)unused;
    for (int base = SCREE_LAYER_SMOOTH; base <= SCREE_LAYER_BONDED; base++) {
        double last[2] = {INFINITY, INFINITY};
        for (double thickness = 4; thickness < 3000; thickness *= 4) {
            double most[2] = {0};
            for (double x = -2; x < 2.1; x += 0.25) {
                const scree_stress_2d s = stress((scree_layer){1, thickness, 0.3, (scree_layer_base)base}, x, 1);
                const scree_stress_2d flamant = scree_flamant_stress(1, x, 1);
                most[0] = fmax(most[0], fabs(s.xx - flamant.xx));
                most[1] = fmax(most[1], fmax(fabs(s.yy - flamant.yy), fabs(s.xy - flamant.xy)));
            }
            assert_true(most[0] < last[0] / 2.5 && most[1] < last[1] / 30);
            last[0] = most[0], last[1] = most[1];
        }
        assert_true(last[0] < 1e-3 && last[1] < 1e-8);
    }
}

/// By the base sigma_yy grows by more than a quarter, without friction by 44 %; Poisson's ratio is felt by a bonded one
/// alone.
static void bases_raise_the_peak(void **unused)
{
    (void)unused;
    const double half_space = stress((scree_layer){1, 1, 0, SCREE_LAYER_NONE}, 0, 1).yy;
    const double smooth = stress((scree_layer){1, 1, 0, SCREE_LAYER_SMOOTH}, 0, 1).yy;
    assert_near(half_space, 2 / M_PI, 1e-15);
    assert_near(smooth / half_space, 1.444, 1e-3);
    double last = 0;
    for (int k = 0; k < POISSONS; k++) {
        const scree_layer bonded = {1, 1, poissons[k], SCREE_LAYER_BONDED};
        const scree_stress_2d s = stress(bonded, 0, 1);
        if (poissons[k] >= 0) {
            assert_true(s.yy / half_space > 1.25 && s.yy / half_space < 1.32);
            assert_true(s.yy < 0.92 * smooth);
        }
        assert_near(stress((scree_layer){1, 1, poissons[k], SCREE_LAYER_SMOOTH}, 0.3, 0.8).xy,
                    stress((scree_layer){1, 1, 0.1, SCREE_LAYER_SMOOTH}, 0.3, 0.8).xy, 1e-14);
        // No strain along a bonded base: sigma_xx = nu / (1 - nu) sigma_yy.
        assert_near(s.xx, poissons[k] / (1 - poissons[k]) * s.yy, 1e-12);
        assert_true(fabs(s.yy - last) > 1e-5);
        last = s.yy;
    }
}

/// Stress scales with the load over the thickness; it is even, the shear odd; nothing above and below; far away it is
/// gone.
static void scales_and_ends(void **unused)
{
    (void)unused;
    for (int base = SCREE_LAYER_SMOOTH; base <= SCREE_LAYER_BONDED; base++) {
        const scree_layer one = {1, 1, 0.3, (scree_layer_base)base}, other = {50, 0.2, 0.3, (scree_layer_base)base};
        for (double x = 0.1; x < 3; x += 0.3) {
            const scree_stress_2d a = stress(one, x, 0.6), b = stress(other, 0.2 * x, 0.12), c = stress(one, -x, 0.6);
            assert_near(a.yy * 250, b.yy, 1e-10);
            assert_near(a.xx * 250, b.xx, 1e-10);
            assert_near(a.xx, c.xx, 1e-14);
            assert_near(a.xy, -c.xy, 1e-14);
        }
        assert_true(stress(one, 0.1, 1.001).yy == 0 && stress(one, 0.1, -0.001).yy == 0);
        // A half-space has (2/pi) y^3 / x^4 there, 1.5e-4.
        assert_true(fabs(stress(one, 8, 1).yy) < 4e-5);
    }
}

/// Nothing pulls along a smooth base, so no upright cut beside the load carries a horizontal force.
static void cuts_of_a_smooth_layer_carry_nothing(void **unused)
{
    (void)unused;
    gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(60);
    for (double x = 0.3; x < 3; x += 0.3) {
        double along = 0;
        for (size_t k = 0; k < 60; k++) {
            double y, share;
            (void)gsl_integration_glfixed_point(0, 1, k, &y, &share, table);
            along += share * stress((scree_layer){1, 1, 0.3, SCREE_LAYER_SMOOTH}, x, y).xx;
        }
        assert_near(along, 0, 1e-10);
    }
    gsl_integration_glfixed_table_free(table);
}

/// Means over elements against sums over many points of them; three points of Gauss leave some 1e-4 of the half-space
/// at two sides from the load, and the waves of the layer nothing along x.
static void means_over_elements(void **unused)
{
    (void)unused;
    enum { N = 400 };
    const double side = 0.2;
    for (int base = SCREE_LAYER_SMOOTH; base <= SCREE_LAYER_NONE; base++)
        for (int place = 0; place < 3; place++) {
            const scree_layer layer = {.force = 1, .thickness = 1, .poisson = 0.3, .base = (scree_layer_base)base};
            const double x = 0.4 * place, y = place == 2 ? 0.9 : 0.5;
            scree_stress_2d mean, sum = {0};
            scree_error error = {0};
            double weights = 0;
            check(scree_layer_mean(&layer, x, y, side, &mean, &error), &error);
            for (int i = 0; i < N; i++)
                for (int j = 0; j < 8; j++) {
                    const double across = 2 * (i + 0.5) / N - 1, weight = 1 - fabs(across);
                    const scree_stress_2d s = stress(layer, x + side * across, y + side * ((j + 0.5) / 8 - 0.5));
                    sum.xx += weight * s.xx, sum.yy += weight * s.yy, sum.xy += weight * s.xy;
                    weights += weight;
                }
            // Eight rows of midpoints along y leave 1e-3 themselves.
            assert_near(mean.xx, sum.xx / weights, 2e-3);
            assert_near(mean.yy, sum.yy / weights, 2e-3);
            assert_near(mean.xy, sum.xy / weights, 2e-3);
        }
}

static void half_widths(void **unused)
{
    (void)unused;
    scree_error error = {0};
    double width;
    for (int base = SCREE_LAYER_SMOOTH; base <= SCREE_LAYER_NONE; base++)
        for (double y = 0.25; y < 1.1; y += 0.25) {
            const scree_layer layer = {2, 1, 0.3, (scree_layer_base)base};
            check(scree_layer_half_width(&layer, y, &width, &error), &error);
            assert_near(stress(layer, width, y).yy, 0.5 * stress(layer, 0, y).yy, 1e-12);
            // Flamant: (1 + x^2 / y^2)^2 = 2.
            if (base == SCREE_LAYER_NONE) assert_near(width, y * sqrt(sqrt(2) - 1), 1e-12);
            // Narrower at a base, a little wider half-way.
            if (base != SCREE_LAYER_NONE && y == 1) assert_true(width < 0.9 * sqrt(sqrt(2) - 1));
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flamant_is_radial),
        cmocka_unit_test(residuals_vanish),
        cmocka_unit_test(smooth_base_by_the_mirror),
        cmocka_unit_test(thick_layers_are_half_spaces),
        cmocka_unit_test(bases_raise_the_peak),
        cmocka_unit_test(scales_and_ends),
        cmocka_unit_test(cuts_of_a_smooth_layer_carry_nothing),
        cmocka_unit_test(half_widths),
        cmocka_unit_test(means_over_elements),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
