/// Compliance of a particle against the matrices of M 2.48, 2.49, and their inverse, Hooke's law in space.
#include "testing.h"

#include "model/compliance.h"

#include <math.h>

static const double YOUNG = 2e11, POISSON = 0.35;

/// Rounding of a handful of products.
static void assert_close(double value, double wanted, double scale)
{
    if (!(fabs(value - wanted) <= 1e-14 * scale)) fail_msg("%.17g is not %.17g", value, wanted);
}

/// Hooke's law in space, written with Lame's constants.
static void stress_in_space(const double strain[9], double stress[9])
{
    double lambda = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON)), shear = YOUNG / (2 * (1 + POISSON));
    for (int k = 0; k < 9; k++) stress[k] = 2 * shear * strain[k];
    for (int i = 0; i < 3; i++) stress[4 * i] += lambda * (strain[0] + strain[4] + strain[8]);
}

static void inverts_hooke_in_space(void **state)
{
    (void)state;
    const double strain[9] = {1e-3, 2e-4, -3e-4, 2e-4, -5e-4, 7e-4, -3e-4, 7e-4, 2e-3};
    double stress[9], back[9];
    stress_in_space(strain, stress);
    scree_compliance compliance = scree_compliance_of(SCREE_SOLID, YOUNG, POISSON);
    scree_compliance_strain(&compliance, 3, stress, back);
    for (int k = 0; k < 9; k++) assert_close(back[k], strain[k], 2e-3);
}

static void plane_strain_keeps_the_length(void **state)
{
    (void)state;
    const double strain[9] = {1e-3, 2e-4, 0, 2e-4, -5e-4, 0, 0, 0, 0};
    double stress[9], back[4];
    stress_in_space(strain, stress);
    const double plane[4] = {stress[0], stress[1], stress[3], stress[4]};
    scree_compliance compliance = scree_compliance_of(SCREE_PLANE_STRAIN, YOUNG, POISSON);
    scree_compliance_strain(&compliance, 2, plane, back);
    assert_close(back[0], strain[0], 1e-3);
    assert_close(back[1], strain[1], 1e-3);
    assert_close(back[3], strain[4], 1e-3);
}

static void plane_stress_is_free_along_the_axis(void **state)
{
    (void)state;
    double along = -POISSON / (1 - POISSON) * (1e-3 - 5e-4);
    const double strain[9] = {1e-3, 2e-4, 0, 2e-4, -5e-4, 0, 0, 0, along};
    double stress[9], back[4];
    stress_in_space(strain, stress);
    assert_close(stress[8], 0, fabs(stress[0]));
    const double plane[4] = {stress[0], stress[1], stress[3], stress[4]};
    scree_compliance compliance = scree_compliance_of(SCREE_PLANE_STRESS, YOUNG, POISSON);
    scree_compliance_strain(&compliance, 2, plane, back);
    assert_close(back[0], strain[0], 1e-3);
    assert_close(back[3], strain[4], 1e-3);
}

static void gives_the_modulus_back(void **unused)
{
    (void)unused;
    for (int condition = SCREE_PLANE_STRAIN; condition <= SCREE_SOLID; condition++)
        for (int k = -9; k < 5; k++) {
            const scree_plane_condition c = (scree_plane_condition)condition;
            assert_close(scree_compliance_modulus(c, scree_compliance_of(c, YOUNG, 0.1 * k)), YOUNG, 10 * YOUNG);
        }
    assert_true(isinf(scree_compliance_modulus(SCREE_SOLID, (scree_compliance){0})));
}

static void limits_of_constants(void **state)
{
    (void)state;
    assert_true(scree_elasticity_is_stable(YOUNG, 0.499));
    assert_true(scree_elasticity_is_stable(YOUNG, -0.99));
    assert_false(scree_elasticity_is_stable(YOUNG, 0.5));
    assert_false(scree_elasticity_is_stable(YOUNG, -1));
    assert_false(scree_elasticity_is_stable(0, 0.3));
    assert_false(scree_elasticity_is_stable(INFINITY, 0.3));
    assert_false(scree_elasticity_is_stable(YOUNG, (double)NAN));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inverts_hooke_in_space),
        cmocka_unit_test(plane_strain_keeps_the_length),
        cmocka_unit_test(plane_stress_is_free_along_the_axis),
        cmocka_unit_test(gives_the_modulus_back),
        cmocka_unit_test(limits_of_constants),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
