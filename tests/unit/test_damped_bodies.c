/// Dashpots of bonds between bodies that deform, in both tangential forms and all schemes: they feel the bodies alone,
/// not the rates of strains that they cause themselves, so that no step is too small. And implicit strains under loads
/// that begin at nothing, where overlaps are rounded more coarsely than the tolerance of the largest strain.
#include "run_fixture.h"

#define NET                                                                                                            \
    "scree: 1\nname: net\nmaterials: [{name: steel, young_modulus: 200 GPa, poisson_ratio: 0.35, density: 2000 "       \
    "kg/m3,\n   friction: 0, normal_stiffness: 7e10 N/m, stiffness_ratio: 0.5, damping_ratio: 0.3}]\n"                 \
    "particles: {shape: disc, material: steel, count: 23, distribution: equal, radius: 1 mm, thickness: 1 m}\n"        \
    "contact: {law: linear, deformation: explicit}\n"                                                                  \
    "selections: [{select: layer, name: low, axis: y, end: low}, {select: layer, name: high, axis: y, end: high}]\n"   \
    "loads:\n  - {load: prescribed, selection: low, velocity_x: 0, velocity_y: 0}\n"                                   \
    "  - {load: prescribed, selection: high, force_x: {from: 0 N, to: 1 kN, begin: 0 s, end: 5 us}}\n"                 \
    "integrator: {step: 10 ns}\nmeasure: {cells: no, samples: 20}\noutput: {figures: no, paraview: no}\n"              \
    "guard: {stability: warn, energy_growth: 10000 %}\nstages:\n  - {stage: prepare, method: hexagonal, width: 10 "    \
    "mm}\n"                                                                                                            \
    "  - {stage: bond, gap_tolerance: 1 um}\n  - {stage: relax, duration: 10 us, boundary: none}\n"

static const char *const schemes[] = {"contact.deformation=explicit", "contact.deformation=relaxed",
                                      "contact.deformation=implicit"};
static const char *const forms[] = {"contact.tangential=as_published", "contact.tangential=corrected"};
enum { SCHEMES = 3, FORMS = 2 };

/// Runs with this step [s]; the energy that is left open over all energy, or INFINITY where the run stops.
static double open_energy(int scheme, int form, double step)
{
    char length[64];
    (void)snprintf(length, sizeof length, "integrator.step=%.6e s", step);
    const char *const overrides[] = {schemes[scheme], forms[form], length};
    scree_case *c = case_read(NET, overrides, 3);
    scree_simulation s;
    scree_error error;
    bool stands = true;
    double worst = 0;
    simulation_open(c, 1, &s);
    while (stands && simulation_goes_on(&s)) {
        stands = scree_simulation_step(&s, &error) == SCREE_OK;
        if (stands) worst = simulation_residual(&s, worst);
    }
    scree_simulation_close(&s);
    scree_case_free(c);
    return stands ? worst : INFINITY;
}

static void no_step_is_too_small(void **unused)
{
    (void)unused;
    for (int scheme = 0; scheme < SCHEMES; scheme++)
        for (int form = 0; form < FORMS; form++)
            for (int k = 0; k < 2; k++) {
                const double step = k == 0 ? 2e-9 : 2e-8, left = open_energy(scheme, form, step);
                print_message("%s, %s, %g s: energy open by %.2g\n", schemes[scheme], forms[form], step, left);
                assert_true(left < 1e-8); // some 1e-10 as it is; where dashpots feel strains the runs stop
            }
}

/// Without bonds or dashpots: 64 discs that just touch, pressed and pushed sideways from nothing.
#define BLOCK                                                                                                          \
    "scree: 1\nname: block\nmaterials: [{name: steel, young_modulus: 200 GPa, poisson_ratio: 0.35, density: 2000 "     \
    "kg/m3,\n"                                                                                                         \
    "   friction: 0.3, normal_stiffness: 7e10 N/m, stiffness_ratio: 0.5, damping_ratio: 0}]\n"                         \
    "particles: {shape: disc, material: steel, count: 64, distribution: equal, radius: 1 mm, thickness: 1 m}\n"        \
    "contact: {law: linear, deformation: implicit}\n"                                                                  \
    "selections: [{select: layer, name: low, axis: y, end: low}, {select: layer, name: high, axis: y, end: high}]\n"   \
    "loads:\n  - {load: prescribed, selection: low, velocity_x: 0, velocity_y: 0}\n"                                   \
    "  - {load: prescribed, selection: high, force_y: {from: 0 N, to: -1 kN, begin: 0 s, end: 50 us},\n"               \
    "     force_x: {from: 0 N, to: 0.2 kN, begin: 0 s, end: 50 us}}\n"                                                 \
    "integrator: {step: 20 ns}\nmeasure: {cells: no, samples: 20}\noutput: {figures: no, paraview: no}\n"              \
    "stages:\n  - {stage: prepare, method: hexagonal, width: 16 mm}\n"                                                 \
    "  - {stage: relax, duration: 50 us, boundary: none}\n"

static void no_load_is_too_small(void **unused)
{
    (void)unused;
    for (int form = 0; form < FORMS; form++) {
        scree_case *c = case_read(BLOCK, &forms[form], 1);
        scree_simulation s;
        simulation_open(c, 1, &s);
        const double worst = simulation_finish(&s);
        print_message("%s: energy open by %.2g\n", forms[form], worst);
        assert_true(worst < 1e-5); // contacts open, close and slide: second order in the step
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_step_is_too_small), cmocka_unit_test(no_load_is_too_small)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
