/// Whole runs among walls of a case: threads, lost work, restart, power balance, messages.
#include "run_fixture.h"
#include "state/case_walls.h"
#include "wall_fixture.h"

#include "io_scratch.h"

static char folder[64];

/// Spheres fall into a box in which a stirrer turns, a mesh of two crossed plates; a rod stands in their way.
static const char case_text[] =
    "scree: 1\n"
    "name: stirred\n"
    "dimension: 3\n"
    "gravity: [0, 0, -9.81]\n"
    "materials:\n"
    "  - {name: glass, young_modulus: 1 MPa, poisson_ratio: 0.25, density: 2500 kg/m3, friction: 0.5,\n"
    "     restitution: 0.5, rolling_friction: 0.05}\n"
    "particles: {shape: sphere, material: glass, count: 40, distribution: uniform, radius_min: 0.9 mm,\n"
    "            radius_max: 1.2 mm}\n"
    "contact: {law: hertz_mindlin}\n"
    "integrator: {scheme: velocity_verlet, step_fraction: 0.2}\n"
    "walls:\n"
    "  - {shape: box, lower: [0, 0, -4 mm], upper: [11 mm, 11 mm, 50 mm]}\n"
    "  - {shape: mesh, name: stirrer, file: stirrer.stl, scale: 1 mm, at: [5.5 mm, 5.5 mm, -4.5 mm],\n"
    "     spin: [0, 0, 20 rad/s], centre: [5.5 mm, 5.5 mm, 0], friction: 0.2}\n"
    "  - {shape: cylinder, name: rod, start: [2 mm, 0 mm, -1 mm], end: [2 mm, 11 mm, -1 mm], radius: 0.5 mm,\n"
    "     side: outside}\n"
    "stages:\n"
    "  - {stage: prepare, method: gas, width: 11 mm, depth: 11 mm, solid_fraction: 20 %}\n"
    "  - {stage: relax, walls: stand, duration: 12 ms}\n"
    "  - {stage: relax, duration: 15 ms}\n"
    "measure: {samples: 20, cells: no}\n"
    "output: {snapshots: 2, paraview: yes, figures: no}\n";

static scree_status read_case(scree_case **c, char *message, size_t size, const char *override)
{
    char path[96];
    scree_problems *problems = NULL;
    scree_case_options options = {.overrides = &override, .override_count = override ? 1 : 0};
    (void)snprintf(path, sizeof path, "%s/stirred.yaml", folder);
    scree_status status = scree_case_parse(case_text, strlen(case_text), path, &options, c, &problems);
    if (status && problems) scree_error_format(scree_problems_get(problems, 0), message, size);
    scree_problems_free(problems);
    return status;
}

static scree_case *good_case(const char *override)
{
    char message[2048] = "";
    scree_case *c = NULL;
    if (read_case(&c, message, sizeof message, override)) fail_msg("%s", message);
    return c;
}

static int make_folder(void **state)
{
    (void)state;
    char path[96];
    triangle_corners triangle[4];
    for (int t = 0; t < 4; t++) {
        const double across[4][2] = {{-4, 0}, {4, 0}, {4, 4}, {-4, 4}};
        static const int order[2][3] = {{0, 1, 2}, {0, 2, 3}};
        for (int c = 0; c < 3; c++) {
            const double *corner = across[order[t % 2][c]];
            triangle[t][c][0] = t < 2 ? corner[0] : 0;
            triangle[t][c][1] = t < 2 ? 0 : corner[0];
            triangle[t][c][2] = corner[1];
        }
    }
    if (!scratch_create(folder)) return 1;
    (void)snprintf(path, sizeof path, "%s/stirrer.stl", folder);
    write_stl(path, (const triangle_corners *)triangle, 4, 0);
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    scratch_destroy(folder);
    return 0;
}

/// Runs the last stage, of which `begin` has made a step; the work is lost after `discard` steps of it (0: never).
static uint64_t run_some(scree_simulation *begin, int threads, uint64_t discard)
{
    scree_simulation s;
    simulation_reopen(begin, threads, folder, &s);
    while (simulation_goes_on(&s)) {
        simulation_step(&s);
        if (discard > 0 && simulation_last_steps(&s) == discard) simulation_lose_work(&s, threads);
    }
    assert_true(scree_case_walls(&s.state)->load[1].work > 0 && scree_case_walls(&s.state)->load[0].work == 0);
    return simulation_close(&s);
}

static void test_same_bits(void **state)
{
    (void)state;
    static const char *const overrides[] = {NULL, "integrator.scheme=position_verlet"};
    for (int k = 0; k < 2; k++) {
        scree_case *c = good_case(overrides[k]);
        scree_simulation s;
        simulation_open(c, 1, &s);
        while (simulation_last_steps(&s) < 1) simulation_step(&s);
        uint64_t reference = run_some(&s, 1, 0);
        assert_true(run_some(&s, 3, 0) == reference);
        assert_true(run_some(&s, 2, 1001) == reference);
        assert_true(run_some(&s, 1, 11) == reference);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

/// A run that is stopped when the stirrer begins to turn and goes on from its checkpoint; and one whose mesh has
/// changed, which is refused.
static void test_restart(void **state)
{
    (void)state;
    char whole[96], part[96], file[96];
    scree_error error;
    (void)snprintf(whole, sizeof whole, "%s/whole", folder);
    (void)snprintf(part, sizeof part, "%s/part", folder);
    (void)snprintf(file, sizeof file, "%s/stirrer.stl", folder);
    scree_case *c = good_case(NULL);
    scree_run_options options = {.threads = 1};
    run_restart(c, whole, part, 2, "stage relax ended");
    scree_case_free(c);

    FILE *mesh = fopen(file, "a");
    assert_non_null(mesh);
    (void)fputs("\n", mesh);
    (void)fclose(mesh);
    assert_int_equal(scree_restart(part, &options, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "has changed"));
}

/// The ledger closes with the work of the stirrer in it, over falling, impacts, sliding and rolling.
static void test_power(void **state)
{
    (void)state;
    scree_case *c = good_case("integrator.step_fraction=0.05");
    scree_simulation s;
    simulation_open(c, 1, &s);
    double worst = simulation_finish(&s);
    print_message("largest energy residual over work: %.3g\n", worst);
    assert_true(worst < 1e-3);
    // What the walls bear is what the spheres get: sums of the same integers.
    double force[3] = {0}, sum[3] = {0};
    for (size_t k = 0; k < s.state.count; k++) {
        scree_vector all, torque;
        scree_body_force(&s.model, &s.state, k, all, torque);
        for (int i = 0; i < 3; i++) sum[i] += all[i] - s.state.row[k].mass * s.model.gravity[i];
    }
    for (int w = 0; w < 3; w++)
        for (int i = 0; i < 3; i++) force[i] += scree_case_walls(&s.state)->load[w].force[i];
    double scale = fabs(sum[2]) + 1e-3;
    for (int i = 0; i < 3; i++) assert_near(force[i], -sum[i], 1e-12 * scale);
    scree_simulation_close(&s);
    scree_case_free(c);
}

static void expect_problem(const char *override, const char *said)
{
    char message[2048] = "";
    scree_case *c = NULL;
    if (!read_case(&c, message, sizeof message, override)) {
        scree_simulation s;
        scree_error error = {0};
        scree_status status = scree_simulation_open(c, 1, &s, &error);
        for (int k = 0; k < 3 && !status; k++) status = scree_simulation_step(&s, &error);
        (void)snprintf(message, sizeof message, "%s", error.message);
        assert_int_not_equal(status, SCREE_OK);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
    if (!strstr(message, said)) fail_msg("'%s' does not say '%s'", message, said);
}

static void test_messages(void **state)
{
    (void)state;
    expect_problem("walls.box.upper=[10 mm, 11 mm, 50 mm]", "wall 'box'");
    expect_problem("walls.box.upper=[-10 mm, 11 mm, 50 mm]", "`upper`");
    expect_problem("walls.stirrer.file=stirer.stl", "cannot be read");
    expect_problem("walls.stirrer.checksum=x12", "has changed");
    expect_problem("walls.rod.end=[2 mm, 0, -1 mm]", "no axis");
    expect_problem("walls.rod.name=stirrer", "has this name too");
    expect_problem("walls.rod.sidde=outside", "side");
    expect_problem("stages.relax_1.boundary=pressure", "relax needs something that stands");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_bits), cmocka_unit_test(test_power), cmocka_unit_test(test_messages),
        cmocka_unit_test(test_restart), // changes the file of the mesh at its end
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
