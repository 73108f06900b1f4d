/// Closed forms: quasistatic numbers against Padbidri's own, restitution against independent integration and limits.
#include "testing.h"

#include "theory/quasistatic.h"
#include "theory/restitution.h"

#include <math.h>
#include <string.h>

/// Padbidri 2010, appendix B: 983 discs, radii uniform in 0.5 to 1 mm, 100 kPa, 0.005 1/s, density 2.675e8 kg/m3,
/// thickness 2 <R>. With the mean mass (<R^2> = 7/12 mm^2) phi is 1.205e-4, with the mass of the mean radius 1.162e-4;
/// P prints 1.1748e-4: within 3 % of both, which covers what P does not say (thickness, which mean mass). psi =
/// (2N)^(-1/2) = 0.0226. P's 0.021 is 2R/L with the L = 72 mm of P's v0 = 0.18 mm/s (L = 2 v0 / rate), that is, with
/// the height of the actual sample instead of the nominal 2R (2N)^(1/2) = 66.5 mm.
static void test_quasistatic_numbers_of_padbidri(void **unused)
{
    (void)unused;
    const double radius = 0.75e-3, thickness = 1.5e-3, rate = 5e-3, density = 2.675e8;
    double phi, psi, phi_of_mean_radius, mean_mass = density * M_PI * 7.0 / 12.0 * 1e-6 * thickness;
    scree_quasistatic_numbers(2, 983, mean_mass, radius, thickness, rate, 1e5, &phi, &psi);
    scree_quasistatic_numbers(2, 983, density * M_PI * radius * radius * thickness, radius, thickness, rate, 1e5,
                              &phi_of_mean_radius, &psi);
    assert_true(fabs(phi / 1.1748e-4 - 1) < 0.03);
    assert_true(fabs(phi_of_mean_radius / 1.1748e-4 - 1) < 0.03);
    assert_true(fabs(psi - 0.02255) < 1e-5);
    double sample_height = 2 * 0.18e-3 / rate;
    assert_true(fabs(2 * radius / sample_height - 0.021) < 0.0005);
}

/// P 2.13: in 3D phi = m rate^2 N^(2/3) / (4 p R) and psi = N^(-1/3).
static void test_quasistatic_numbers_in_3d(void **unused)
{
    (void)unused;
    double phi, psi;
    scree_quasistatic_numbers(3, 3413, 2e-3, 1e-3, NAN, 0.02, 5e4, &phi, &psi);
    double expected = 2e-3 * 0.02 * 0.02 / (4 * 5e4 * 1e-3) * pow(3413, 2.0 / 3.0);
    assert_true(fabs(phi / expected - 1) < 1e-13);
    assert_true(fabs(psi * cbrt(3413) - 1) < 1e-13);
}

/// da Cruz et al. 2005, eq. 1 and GDR MiDi 2004. A disc of 1 mm and 1 mm length with 2000 kg/m3 has 2 pi/4 mg; at 8 1/s
/// under 100 Pa I = 8 sqrt(pi/2 1e-6 / (100 1e-3)) in 2D and 8 1e-3 sqrt(20) for a sphere: their ratio is (pi/4)^(1/2)
/// whatever the rest. Twice the rate doubles it, four times the pressure halves it.
static void test_inertial_number(void **unused)
{
    (void)unused;
    const double mass = 2000 * M_PI / 4 * 1e-9;
    double disc = scree_inertial_number(2, mass, 0.5e-3, 2000, 1e-3, 8, 100);
    double sphere = scree_inertial_number(3, NAN, 0.5e-3, 2000, NAN, 8, 100);
    assert_true(fabs(sphere / (8e-3 * sqrt(20)) - 1) < 1e-14);
    assert_true(fabs(disc / (8 * sqrt(M_PI / 2 * 1e-5)) - 1) < 1e-14);
    assert_true(fabs(disc / sphere / sqrt(M_PI / 4) - 1) < 1e-14);
    assert_true(fabs(scree_inertial_number(2, mass, 0.5e-3, 2000, 1e-3, 16, 400) / disc - 1) < 1e-14);
    assert_true(isnan(scree_inertial_number(3, NAN, 0.5e-3, 2000, NAN, 8, 0)));
    assert_true(isnan(scree_inertial_number(2, mass, 0.5e-3, 2000, 1e-3, 8, NAN)));
    assert_true(scree_wave_speed(8, 4, 0.5) == 2);
}

/// A number at its limit keeps it, one that does not exist too; the modulus has a least value, the others a largest.
static void test_quasistatic_limits(void **unused)
{
    (void)unused;
    for (int k = 0; k < SCREE_QUASISTATIC_COUNT; k++) {
        scree_quasistatic_criterion criterion = (scree_quasistatic_criterion)k;
        double limit = scree_quasistatic_limits[k].limit;
        bool least = k == SCREE_QUASISTATIC_MODULUS;
        assert_true(scree_quasistatic_keeps(criterion, limit) && scree_quasistatic_keeps(criterion, NAN));
        assert_true(scree_quasistatic_keeps(criterion, 1.01 * limit) == least);
        assert_true(scree_quasistatic_keeps(criterion, 0.99 * limit) == !least);
        assert_true(scree_quasistatic_keeps(criterion, INFINITY) == least);
    }
}

/// Classical Runge-Kutta with a small fixed step on x'' = -(x^1.5 + damping x^power x'); speed at release.
/// `attractive`: release at x = 0, else when the force has fallen to zero. Independent of the code under test.
static double integrate_impact(double damping, double power, int attractive)
{
    double x = 0, v = 1, h = 1e-4;
    for (int step = 0; step < 4000000; step++) {
        double kx[4], kv[4], shift[4] = {0, 0.5, 0.5, 1};
        for (int k = 0; k < 4; k++) {
            double xs = fmax(x + (k ? shift[k] * h * kx[k - 1] : 0), 0), vs = v + (k ? shift[k] * h * kv[k - 1] : 0);
            kx[k] = vs;
            kv[k] = -(xs * sqrt(xs) + damping * pow(xs, power) * vs);
        }
        double x_next = x + h / 6 * (kx[0] + 2 * kx[1] + 2 * kx[2] + kx[3]);
        double v_next = v + h / 6 * (kv[0] + 2 * kv[1] + 2 * kv[2] + kv[3]);
        double force = x_next > 0 ? x_next * sqrt(x_next) + damping * pow(x_next, power) * v_next : -1;
        if (v_next < 0 && (attractive ? x_next <= 0 : force <= 0)) return -v_next;
        x = x_next;
        v = v_next;
    }
    return NAN;
}

/// Release is found to a step h = 1e-4, and the speed changes by less than h in one; the start, where sqrt(x) is not
/// smooth, adds less.
static const double RUNGE_KUTTA_ERROR = 1e-4;

static void test_restitution_from_damping_is_the_impact(void **unused)
{
    (void)unused;
    const double dampings[] = {0.05, 0.5, 1.65, 2.2360679, 2.5, 6};
    for (int i = 0; i < 6; i++) {
        double expected = integrate_impact(dampings[i], 0.25, 0);
        assert_true(fabs(scree_restitution_from_damping(dampings[i]) - expected) < RUNGE_KUTTA_ERROR);
    }
}

static void test_restitution_limits(void **unused)
{
    (void)unused;
    assert_true(scree_restitution_from_damping(0) == 1);
    assert_true(scree_damping_from_restitution(1) == 0);
    assert_true(isinf(scree_damping_from_restitution(0)));
    // Continuous through critical damping, sqrt(5), where it is exp(-2).
    for (int k = -3; k <= 3; k++)
        assert_true(fabs(scree_restitution_from_damping(sqrt(5.0) * (1 + k * 1e-13)) - exp(-2.0)) < 1e-12);
    // Falls as 5 / (4 damping^2) in the end; the next term is smaller by ln(damping) / damping^2.
    assert_true(fabs(scree_restitution_from_damping(1e4) * 4e8 / 5 - 1) < 1e-6);
}

static void test_damping_inverts_restitution(void **unused)
{
    (void)unused;
    for (double e = 1e-6; e < 1 - 1e-6; e = e < 0.8 ? e * 1.2 : 1 - (1 - e) / 3) {
        double damping = scree_damping_from_restitution(e);
        // Round-off of the damping and of acos near critical damping, amplified by d ln e / d ln damping <= 2.
        assert_true(fabs(scree_restitution_from_damping(damping) / e - 1) < 1e-14);
    }
}

/// Antypov & Elliott 2011 (and Tsuji et al. 1992): with attraction allowed, damping = -sqrt(5) ln e / sqrt(ln^2 e +
/// pi^2).
static void test_restitution_with_attractive_release(void **unused)
{
    (void)unused;
    const double restitutions[] = {0.2, 0.5, 0.9};
    for (int i = 0; i < 3; i++) {
        double e = restitutions[i], damping = -sqrt(5.0) * log(e) / hypot(log(e), M_PI);
        assert_true(fabs(integrate_impact(damping, 0.25, 1) - e) < RUNGE_KUTTA_ERROR);
        // The same damping without attraction leaves more speed, so the same restitution needs more damping.
        assert_true(scree_restitution_from_damping(damping) > e);
        assert_true(scree_damping_from_restitution(e) > damping);
    }
    // To first order in the damping ratio z they agree, ln e = -pi z; the next term is 2 z^2.
    double z = 1e-3, e = scree_restitution_from_damping(z * sqrt(5.0));
    assert_true(fabs(-log(e) - M_PI * z + 2 * z * z) < 1e-8);
}

static void test_viscoelastic_impact_without_damping(void **unused)
{
    (void)unused;
    scree_impact impact;
    const double speed = 0.3, stiffness = 4e8, mass = 0.37;
    assert_int_equal(scree_impact_viscoelastic(speed, stiffness, mass, 0, false, &impact, NULL), SCREE_OK);
    // Hertz 1882: duration 2 d_max / v times the integral of dz / sqrt(1 - z^2.5), with d_max^2.5 = 1.25 m v^2 / K.
    double deepest = pow(1.25 * mass * speed * speed / stiffness, 0.4);
    double integral = 0.4 * tgamma(0.4) * tgamma(0.5) / tgamma(0.9);
    assert_true(fabs(impact.restitution - 1) < 1e-8);
    assert_true(fabs(impact.duration * speed / deepest / (2 * integral) - 1) < 1e-8);
}

static void test_viscoelastic_impact_with_damping(void **unused)
{
    (void)unused;
    scree_impact impact, faster;
    const double stiffness = 4e8, mass = 0.37, taus[] = {0.1, 0.8, 3};
    double before = 1;
    for (int i = 0; i < 3; i++) {
        double speed = 7.5e-6, damping_time = taus[i] * pow(mass / stiffness, 0.4) * pow(speed, -0.2);
        assert_int_equal(scree_impact_viscoelastic(speed, stiffness, mass, damping_time, false, &impact, NULL),
                         SCREE_OK);
        assert_true(fabs(impact.restitution - integrate_impact(taus[i], 0.5, 0)) < RUNGE_KUTTA_ERROR);
        assert_true(impact.restitution < before);
        before = impact.restitution;
        double released = impact.duration;
        assert_int_equal(scree_impact_viscoelastic(speed, stiffness, mass, damping_time, true, &impact, NULL),
                         SCREE_OK);
        assert_true(fabs(impact.restitution - integrate_impact(taus[i], 0.5, 1)) < RUNGE_KUTTA_ERROR);
        assert_true(impact.restitution < before && impact.duration > released);
        impact.restitution = before;
        // Only T v^(1/5) matters. 1e-8: twice the accuracy promised.
        assert_int_equal(scree_impact_viscoelastic(32 * speed, stiffness, mass, damping_time / 2, false, &faster, NULL),
                         SCREE_OK);
        assert_true(fabs(faster.restitution / impact.restitution - 1) < 2e-8);
    }
    // Small damping: 1 - e = 1.15344 tau (Schwager & Poeschel 1998), the work of the damping force over the undamped
    // impact.
    double slope = 0.8 * pow(1.25, 0.6) * tgamma(0.6) * tgamma(1.5) / tgamma(2.1), tau = 1e-4;
    assert_true(fabs(slope - 1.15344) < 1e-4);
    assert_int_equal(scree_impact_viscoelastic(1, 1, 1, tau, false, &impact, NULL), SCREE_OK);
    assert_true(fabs((1 - impact.restitution) / tau / slope - 1) < 10 * tau);
}

static void test_viscoelastic_impact_refuses(void **unused)
{
    (void)unused;
    scree_impact impact;
    scree_error error;
    assert_int_equal(scree_impact_viscoelastic(0, 1, 1, 0, false, &impact, &error), SCREE_ERROR_INPUT);
    assert_int_equal(scree_impact_viscoelastic(1, 1, 1, NAN, false, &impact, &error), SCREE_ERROR_INPUT);
    assert_int_equal(scree_impact_viscoelastic(1, 1, 1, 1001, false, &impact, &error), SCREE_ERROR_INPUT);
    assert_int_equal(scree_impact_viscoelastic(1, 1, 1, 1000, false, &impact, &error), SCREE_OK);
    assert_true(impact.restitution > 0 && impact.restitution < 0.01);
    assert_int_equal(scree_impact_viscoelastic(1, 1, 1, 1000, true, &impact, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "attraction"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_quasistatic_numbers_of_padbidri),
        cmocka_unit_test(test_quasistatic_numbers_in_3d),
        cmocka_unit_test(test_inertial_number),
        cmocka_unit_test(test_quasistatic_limits),
        cmocka_unit_test(test_restitution_from_damping_is_the_impact),
        cmocka_unit_test(test_restitution_limits),
        cmocka_unit_test(test_damping_inverts_restitution),
        cmocka_unit_test(test_restitution_with_attractive_release),
        cmocka_unit_test(test_viscoelastic_impact_without_damping),
        cmocka_unit_test(test_viscoelastic_impact_with_damping),
        cmocka_unit_test(test_viscoelastic_impact_refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
