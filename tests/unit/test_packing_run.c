/// A run of a dense packing: what is told of the packing and of its moduli, also when it is taken up again, against
/// what the library says of the specimen that was left.
#include "run_fixture.h"

#include "io_scratch.h"

#include <scree/scree.h>

#include <stdlib.h>

static const char text[] =
    "scree: 1\nname: dense\n"
    "materials: [{name: rock, normal_stiffness: 1e8 N/m, stiffness_ratio: 0.4, damping_ratio: 0, density: 2000 kg/m3, "
    "young_modulus: 1 GPa, friction: 0.5}]\n"
    "contact: {law: linear}\nmeasure: {cells: no, moduli: yes, samples: 2}\n"
    "output: {figures: no, paraview: no, snapshots: 2}\n"
    "particles: {shape: disc, material: rock, count: 60, radius_min: 0.5 mm, radius_max: 1 mm}\n"
    "stages:\n  - {stage: prepare, method: dense, aspect_ratio: 1}\n"
    "  - {stage: bond, gap_tolerance: 10 um, overlap_tolerance: 1 mm}\n"
    "  - {stage: relax, boundary: none, duration: 10 us}\n";

static double result(const char *folder, const char *name)
{
    char value[100];
    scree_error error;
    check(scree_result_get(folder, name, value, sizeof value, &error), &error);
    return strtod(value, NULL);
}

static void expect_moduli(const char *folder)
{
    scree_case *c;
    scree_simulation *s;
    scree_moduli m;
    scree_error error;
    check(scree_simulation_open_run(folder, &c, &s, &error), &error);
    check(scree_simulation_moduli(s, NULL, &m, &error), &error);
    // Printed with 17 digits; the last snapshot is the end.
    assert_true(fabs(result(folder, "static_young_modulus") / m.isotropic.young - 1) < 1e-9);
    assert_true(fabs(result(folder, "static_poisson_ratio") / m.isotropic.poisson - 1) < 1e-9);
    assert_true(fabs(result(folder, "static_bulk_modulus") / m.isotropic.bulk - 1) < 1e-9);
    assert_true(fabs(result(folder, "static_shear_modulus") / m.isotropic.shear - 1) < 1e-9);
    assert_true(fabs(result(folder, "static_shear_modulus_voigt") / m.voigt.shear - 1) < 1e-9);
    assert_true(fabs(result(folder, "static_shear_modulus_theory") / m.estimate.shear - 1) < 1e-9);
    assert_true(fabs(result(folder, "static_anisotropy") / m.anisotropy - 1) < 1e-9);
    assert_true(result(folder, "static_contacts") == result(folder, "bonds_made"));
    scree_simulation_free(s);
    scree_case_free(c);
}

static void run(const char *folder, const char *const *overrides, size_t count)
{
    scree_error error;
    const scree_run_options options = {.output = folder, .threads = 1};
    scree_case *c = case_read(text, overrides, count);
    check(scree_run(c, &options, &error), &error);
    scree_case_free(c);
}

/// From a snapshot between preparation and end: the record of the packing has gone through the file.
static void what_is_told_outlasts_a_restart(void **unused)
{
    (void)unused;
    char place[64], whole[128];
    scree_error error;
    const char *const names[] = {"packing_bonds", "packing_overlap", "packing_radius_square", "packing_fabric_xy"};
    double before[4];
    assert_true(scratch_create(place));
    (void)snprintf(whole, sizeof whole, "%s/whole", place);
    run(whole, NULL, 0);
    assert_true(result(whole, "packing_bonds") == result(whole, "bonds_made"));
    expect_moduli(whole);
    for (int k = 0; k < 4; k++) before[k] = result(whole, names[k]);
    const scree_run_options options = {.threads = 1, .from = "1"};
    check(scree_restart(whole, &options, &error), &error);
    for (int k = 0; k < 4; k++) assert_true(result(whole, names[k]) == before[k] && before[k] != 0);
    expect_moduli(whole);
    scratch_destroy(place);
}

/// Neither asked for nor prepared so: nothing is told.
static void others_say_nothing(void **unused)
{
    (void)unused;
    char place[64], folder[128], value[100];
    scree_error error;
    const char *const other[] = {"stages.0.method=growth", "measure.moduli=no", "stages.1.gap_tolerance=0.1 mm"};
    assert_true(scratch_create(place));
    (void)snprintf(folder, sizeof folder, "%s/other", place);
    run(folder, other, 3);
    assert_int_equal(scree_result_get(folder, "packing_bonds", value, sizeof value, &error), SCREE_ERROR_INPUT);
    assert_int_equal(scree_result_get(folder, "static_young_modulus", value, sizeof value, &error), SCREE_ERROR_INPUT);
    scratch_destroy(place);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_told_outlasts_a_restart),
        cmocka_unit_test(others_say_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
