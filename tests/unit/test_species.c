/// Particles of several species: numbers, which body is of which, what preparations make of them, the step, and a
/// periodic shear of two materials.
#include "run_fixture.h"

#include "model/critical_step.h"
#include "reference_cases.h"
#include "small_cases.h"

#include <stdlib.h>

#define TWO_MATERIALS                                                                                                  \
    "scree: 1\nseed: 4\nmaterials:\n" SMALL_QUARTZ                                                                     \
    "  - {name: chalk, young_modulus: 5 GPa, density: 1e8 kg/m3, friction: 0.3, restitution: 0.5}\n"
#define COARSE "name: coarse, material: quartz, radius_min: 0.8 mm, radius_max: 1 mm"
#define FINE   "name: fine, material: chalk, distribution: two_sizes, radius_min: 0.3 mm, radius_max: 0.5 mm"
#define STAGES                                                                                                         \
    "contact: {law: hertz_mindlin, reference_velocity: 1e-4 m/s}\n"                                                    \
    "stages:\n  - {stage: prepare, aspect_ratio: 1}\n  - {stage: confine, pressure: 100 kPa}\n"

static const char by_number[] =
    TWO_MATERIALS "particles: {count: 101, species: [{" COARSE ", share: 30 %}, {" FINE ", share: 70 %}]}\n" STAGES;

static scree_model build(const scree_case *c)
{
    scree_model model;
    scree_error error;
    check(scree_model_build(&c->config, &model, &error), &error);
    return model;
}

/// Numbers of the species among the bodies [first, first + count).
static void count_species(const scree_model *model, uint64_t first, uint64_t count, size_t found[SCREE_MOST_SPECIES])
{
    memset(found, 0, SCREE_MOST_SPECIES * sizeof *found);
    for (uint64_t k = 0; k < count; k++) found[scree_model_drawn_species(model, first + k)]++;
}

static void shares_are_exact(void **unused)
{
    (void)unused;
    size_t found[SCREE_MOST_SPECIES];
    scree_case *c = case_read(by_number, NULL, 0);
    scree_model model = build(c);
    // 30.3 and 70.7: the larger rest gets one more. In every further block of as many too.
    for (uint64_t block = 0; block < 3; block++) {
        count_species(&model, 101 * block, 101, found);
        assert_int_equal(found[0], 30);
        assert_int_equal(found[1], 71);
    }
    scree_case_free(c);
    const char *counted[] = {"particles={count: 101, share_by: count, species: [{" COARSE ", count: 1}, {" FINE
                             ", count: 100}]}"};
    c = case_read(by_number, counted, 1);
    model = build(c);
    count_species(&model, 0, 101, found);
    assert_true(found[0] == 1 && found[1] == 100);
    scree_case_free(c);
}

/// Shares of the mass that stands, within what one body more or less and the draws of 10^4 sizes make (0.2 %).
static void shares_by_mass(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        const char *overrides[] = {"particles.share_by=mass", "particles.count=20000", "dimension=2",
                                   "particles.shape=disc"};
        if (dimension == 3) overrides[2] = "dimension=3", overrides[3] = "particles.shape=sphere";
        scree_case *c = case_read(by_number, overrides, 4);
        scree_model model = build(c);
        double mass[2] = {0}, mean = 0;
        for (uint64_t k = 0; k < 20000; k++) {
            int species = scree_model_drawn_species(&model, k);
            double one = scree_model_mass(&model, model.species[species].material, scree_model_drawn_radius(&model, k));
            mass[species] += one;
            mean += one / 20000;
        }
        assert_true(fabs(mass[0] / (mass[0] + mass[1]) - 0.3) < 0.003);
        assert_true(fabs(scree_model_mean_mass(&model) / mean - 1) < 0.01);
        // Mass over volume: 0.3 / 2.675 + 0.7 / 1 of the volume that the mass 1e8 kg has.
        assert_true(fabs(scree_model_mean_density(&model) / (1e8 / (0.3 / 2.675 + 0.7)) - 1) < 1e-12);
        scree_case_free(c);
    }
}

/// A random order: each species is spread over all numbers, and another seed spreads it otherwise.
static void species_are_mixed(void **unused)
{
    (void)unused;
    const char *overrides[] = {"particles.count=10000", "seed=5"};
    size_t found[SCREE_MOST_SPECIES], same = 0;
    scree_case *c = case_read(by_number, overrides, 1), *other = case_read(by_number, overrides, 2);
    scree_model model = build(c), second = build(other);
    for (uint64_t tenth = 0; tenth < 10; tenth++) {
        count_species(&model, 1000 * tenth, 1000, found);
        // Five standard deviations of a draw without replacement, sqrt(1000 0.3 0.7 0.9).
        assert_true(fabs((double)found[0] - 300) < 5 * 13.7);
    }
    for (uint64_t k = 0; k < 10000; k++)
        same += scree_model_drawn_species(&model, k) == scree_model_drawn_species(&second, k);
    assert_true(fabs((double)same - 5800) < 300); // 0.3^2 + 0.7^2 of all
    scree_case_free(c);
    scree_case_free(other);
}

/// Every body is what its species says, whatever places it.
static void bodies_are_of_their_species(void **unused)
{
    (void)unused;
    const char *const ways[][2] = {
        {"stages.prepare.method=drop_and_roll", "stages.prepare.outline=box"},
        {"stages.prepare.method=gas", "stages.prepare.outline=box"},
        {"stages.prepare.method=growth", "stages.prepare.outline=box"},
        {"stages.prepare.method=growth", "stages.prepare.outline=circle"},
    };
    for (int w = 0; w < 4; w++) {
        size_t found[2] = {0};
        const char *overrides[] = {ways[w][0], ways[w][1], "stages.confine.boundary=minimal"};
        scree_case *c = case_read(by_number, overrides, w == 3 ? 3 : 2);
        scree_simulation s;
        simulation_open(c, 1, &s);
        simulation_step(&s);
        for (size_t row = 0; row < s.state.count; row++) {
            const scree_species *species = &s.model.species[s.state.species[row]];
            double r = s.state.row[row].radius;
            found[s.state.species[row]]++;
            assert_int_equal(scree_body_material(&s.state, row), species->material);
            assert_true(r >= species->radius.least && r <= species->radius.most);
            assert_true(s.state.row[row].mass == scree_model_mass(&s.model, species->material, r));
            if (w == 1 || w == 2)
                assert_int_equal(s.state.species[row], scree_model_drawn_species(&s.model, s.state.id[row]));
        }
        assert_int_equal(found[0] + found[1], 101);
        // Exact where nothing is drawn that does not stay.
        if (w == 1 || w == 2) assert_int_equal(found[0], 30);
        assert_true(found[0] > 15 && found[0] < 45);
        (void)simulation_close(&s);
        scree_case_free(c);
    }
}

static uint64_t checksum_of(const char *text)
{
    scree_case *c = case_read(text, NULL, 0);
    scree_simulation s;
    simulation_open(c, 1, &s);
    simulation_finish(&s);
    uint64_t checksum = simulation_close(&s);
    scree_case_free(c);
    return checksum;
}

/// A list of one species is what a section without a list is, to the last bit.
static void one_species_is_a_list_of_one(void **unused)
{
    (void)unused;
#define ONE_STAGES                                                                                                     \
    "contact: {law: hertz_mindlin, reference_velocity: 1e-4 m/s}\nboundary: {every: 100}\n"                            \
    "stages: [{stage: prepare, aspect_ratio: 1}, {stage: confine, pressure: 100 kPa, unbalanced_limit: 0.2}]\n"
#define ONE "material: quartz, radius_min: 0.5 mm, radius_max: 1 mm"
    uint64_t plain = checksum_of(TWO_MATERIALS "particles: {count: 40, " ONE "}\n" ONE_STAGES);
    assert_true(plain == checksum_of(TWO_MATERIALS "particles: {count: 40, species: [{name: a, share: 100 %, " ONE
                                                   "}]}\n" ONE_STAGES));
    assert_true(plain != checksum_of(TWO_MATERIALS "particles: {count: 40, species: [{name: a, share: 25 %, " ONE
                                                   "}, {name: b, share: 75 %, material: chalk, radius_min: 0.5 mm, "
                                                   "radius_max: 1 mm}]}\n" ONE_STAGES));
}

/// The least over all pairs of materials, of the smallest bodies of each.
static void critical_step_is_of_the_worst_pair(void **unused)
{
    (void)unused;
    scree_case *c = case_read(by_number, NULL, 0);
    scree_model model = build(c);
    double force = 3 * 100e3 * 2 * model.mean_radius * model.thickness, least = INFINITY;
    const double radius[] = {0.8e-3, 0.3e-3};
    double steps[2][2];
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++) {
            double a = scree_model_mass(&model, i, radius[i]), b = scree_model_mass(&model, k, radius[k]);
            scree_contact_tangent tangent = scree_contact_linearise(
                &model.laws[0], &model.pairs[i][k], 1 / (1 / radius[i] + 1 / radius[k]), 1 / (1 / a + 1 / b), force);
            steps[i][k] = scree_critical_step_lattice(2, &tangent, fmin(a, b), NULL);
            least = fmin(least, steps[i][k]);
        }
    assert_true(fabs(model.critical_step / least - 1) < 1e-12);
    // Light and soft bodies between heavy and stiff ones are what moves fastest.
    assert_true(least == steps[0][1] && least < 0.99 * steps[1][1]);
    scree_case_free(c);
}

/// Plates are of the material of what touches them; a membrane is no particle.
static void plates_and_membranes(void **unused)
{
    (void)unused;
    const char *const overrides[] = {"boundary.lateral=membrane", "materials.chalk.wall_friction=0.07",
                                     "stages.confine.unbalanced_limit=0.3"};
    scree_case *c = case_read(by_number, overrides, 3);
    scree_simulation s;
    simulation_open(c, 1, &s);
    simulation_finish(&s);
    assert_true(s.model.walls[0].value[SCREE_FRICTION] == 0.45 && s.model.walls[1].value[SCREE_FRICTION] == 0.07);
    assert_true(s.state.count > scree_grain_count(&s.state));
    for (size_t row = 0; row < s.state.count; row++)
        assert_true(scree_body_is_grain(&s.state, row) == (s.state.species[row] != SCREE_NO_SPECIES));
    (void)simulation_close(&s);
    scree_case_free(c);
}

/// The periodic shear of tests/reference: no net momentum, and an energy ledger that closes.
static void periodic_shear_of_two_materials(void **unused)
{
    (void)unused;
    scree_case *c = NULL;
    assert_int_equal(reference_read(REFERENCE_FOLDER "cases/species_2d.yaml", NULL, &c), SCREE_OK);
    scree_simulation s;
    simulation_open(c, 1, &s);
    double residual = simulation_finish(&s), momentum[2] = {0}, scale = 0;
    size_t of_material[2] = {0};
    for (size_t row = 0; row < s.state.count; row++) {
        const scree_row *body = &s.state.row[row];
        momentum[0] += body->mass * body->vx;
        momentum[1] += body->mass * body->vy;
        scale += body->mass * hypot(body->vx, body->vy);
        of_material[scree_body_material(&s.state, row)]++;
    }
    assert_true(scale > 0 && hypot(momentum[0], momentum[1]) < 1e-9 * scale);
    assert_true(residual < 1e-4);
    assert_true(of_material[0] > 10 && of_material[1] > 10 && of_material[0] + of_material[1] == 70);
    (void)simulation_close(&s);
    scree_case_free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shares_are_exact),
        cmocka_unit_test(shares_by_mass),
        cmocka_unit_test(species_are_mixed),
        cmocka_unit_test(bodies_are_of_their_species),
        cmocka_unit_test(one_species_is_a_list_of_one),
        cmocka_unit_test(critical_step_is_of_the_worst_pair),
        cmocka_unit_test(plates_and_membranes),
        cmocka_unit_test(periodic_shear_of_two_materials),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
