/// A material that nothing is made of changes nothing, wherever it stands in the list.
#include "run_fixture.h"

#include "small_cases.h"

#include <stdlib.h>

#define UNUSED                                                                                                         \
    "  - {name: unused, young_modulus: 3 MPa, poisson_ratio: 0.45, density: 20 kg/m3, friction: 5, wall_friction: "    \
    "3,\n"                                                                                                             \
    "     restitution: 0.01, rolling_friction: 2, twisting_friction: 0}\n"
#define DISCS SMALL_DISCS("40", "0.2")

static const char *const discs[][3] = {
    {"boundary.lateral=pressure"},
    {"boundary.lateral=plates"},
    {"boundary.lateral=membrane"},
    {"boundary.lateral=plates", "contact.law=hertz_brilliantov", "integrator.scheme=position_verlet"},
    {"boundary={periodic: xy}", "stages.prepare.method=gas", "stages.prepare.solid_fraction=60 %"},
};

#define SPHERES                                                                                                        \
    "dimension: 3\n"                                                                                                   \
    "particles: {material: quartz, shape: sphere, count: 64, distribution: equal, radius: 1 mm}\n"                     \
    "measure: {samples: 20, cells: no}\n"                                                                              \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, method: cubic, aspect_ratio: 1}\n"                                                           \
    "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 0.2}\n"                                                 \
    "  - {stage: compress, strain: 0.2 %, rate: 1 1/s}\n"

typedef struct outcome {
    uint64_t checksum;
    double step, critical, phi;
    double sample[SCREE_SAMPLE_COUNT]; ///< the last
} outcome;

static outcome run_case(const char *materials, const char *rest, const char *const *overrides, size_t count)
{
    char text[4096];
    outcome o;
    scree_simulation s;
    (void)snprintf(text, sizeof text, "scree: 1\nseed: 3\nmaterials:\n%s%s", materials, rest);
    scree_case *c = case_read(text, overrides, count);
    simulation_open(c, 1, &s);
    simulation_finish(&s);
    o = (outcome){.step = s.model.step, .critical = s.model.critical_step, .phi = s.model.phi};
    memcpy(o.sample, s.sample, sizeof o.sample);
    o.checksum = simulation_close(&s);
    scree_case_free(c);
    return o;
}

/// The same bits with the other material first and last, and none.
static void expect_no_part(const char *rest, const char *const *overrides, size_t count)
{
    outcome alone = run_case(SMALL_QUARTZ, rest, overrides, count), with;
    const char *const materials[] = {UNUSED SMALL_QUARTZ, SMALL_QUARTZ UNUSED};
    for (int k = 0; k < 2; k++) {
        with = run_case(materials[k], rest, overrides, count);
        assert_true(with.step == alone.step && with.critical == alone.critical);
        assert_memory_equal(&with.phi, &alone.phi, sizeof with.phi);
        assert_memory_equal(&with.sample, &alone.sample, sizeof with.sample);
        assert_true(with.checksum == alone.checksum);
    }
}

static void discs_under_each_boundary(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < sizeof discs / sizeof *discs; k++) {
        size_t count = 0;
        while (count < 3 && discs[k][count]) count++;
        expect_no_part(DISCS, discs[k], count);
    }
}

static void spheres_and_walls(void **unused)
{
    (void)unused;
    expect_no_part(SPHERES, NULL, 0);
    expect_no_part(SMALL_POUR, NULL, 0);
}

/// What `scree check` says of a case comes from the particles' material too.
static void estimates(void **unused)
{
    (void)unused;
    const char *const text[] = {"scree: 1\nmaterials:\n" SMALL_QUARTZ DISCS,
                                "scree: 1\nmaterials:\n" UNUSED SMALL_QUARTZ DISCS};
    scree_case_summary summary[2];
    scree_error error;
    for (int k = 0; k < 2; k++) {
        scree_case *c = case_read(text[k], NULL, 0);
        check(scree_case_summarise(c, &summary[k], &error), &error);
        scree_case_free(c);
    }
    assert_true(summary[0].steps > 0 && summary[0].steps == summary[1].steps);
    assert_true(summary[0].memory == summary[1].memory && summary[0].critical_step == summary[1].critical_step);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(discs_under_each_boundary),
        cmocka_unit_test(spheres_and_walls),
        cmocka_unit_test(estimates),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
