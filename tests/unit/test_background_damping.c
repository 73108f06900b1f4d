/// Background damping against closed forms: free fall, a ball that bounces, accumulates of energy.
#include "run_fixture.h"

#define BALL                                                                                                           \
    "scree: 1\nname: ball\ngravity: [0, -9.81]\n"                                                                      \
    "materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0, restitution: 1}]\n"            \
    "particles: {shape: disc, material: glass, count: 2, distribution: equal, radius: 1 mm}\n"                         \
    "contact: {law: hertz_mindlin}\nintegrator: {step_fraction: 0.02}\n"                                               \
    "walls: [{shape: plane, name: floor, point: [0, 0], normal: [0, 1]}]\n"                                            \
    "loads: [{load: background_damping}]\nmeasure: {samples: 20, cells: no}\n"                                         \
    "output: {figures: no, paraview: no}\nstages:\n"                                                                   \
    "  - {stage: prepare, method: bodies, bodies: [{position: [10 mm, 11 mm]}, {position: [30 mm, 31 mm]}]}\n"         \
    "  - {stage: relax, duration: 60 ms}\n"

static const scree_row *ball(const scree_simulation *s)
{
    return &s->state.row[s->state.row_of_id[0]];
}

/// A body that falls from rest has the acceleration g (1 - a), whatever the direction of the damping.
static void free_fall_is_slowed(void **unused)
{
    (void)unused;
    const char *const overrides[][2] = {{"loads.0.translation=0.3", "loads.0.direction=vector"},
                                        {"loads.0.translation=0.3", "loads.0.direction=components"}};
    for (int k = 0; k < 2; k++) {
        scree_case *c = case_read(BALL, overrides[k], 2);
        scree_simulation s;
        simulation_open(c, 1, &s);
        simulation_load(&s);
        while (s.state.evaluations < 200) simulation_step(&s);
        double step = s.state.step_size, steps = (double)s.state.evaluations;
        // The first kick begins at rest, where there is nothing to act against: it is not slowed.
        double expected = -9.81 * step * (1 + (steps - 1) * (1 - 0.3));
        assert_true(fabs(ball(&s)->vy / expected - 1) < 2 / steps);
        assert_true(ball(&s)->vx == 0);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

/// Between two turning points of a motion to and fro the force is weakened by 1 - a on the way to equilibrium, and
/// strengthened by 1 + a on the way from it, so that whatever the potential U(high) (1 - a) = U(low) (1 + a) over that
/// of equilibrium. After a bounce of an elastic ball: height over height = ((1 - a) / (1 + a))^2, but for the weight's
/// own overlap.
static void a_ball_bounces_lower(void **unused)
{
    (void)unused;
    const double share = 0.1, wanted = 0.9 / 1.1 * (0.9 / 1.1);
    const char *const overrides[] = {"loads.0.translation=0.1", "stages.1.duration=120 ms"};
    scree_case *c = case_read(BALL, overrides, 2);
    scree_simulation s;
    simulation_open(c, 1, &s);
    simulation_load(&s);
    double highest = 0;
    bool down = false, up = false;
    while (simulation_goes_on(&s) && !(up && ball(&s)->vy < 0)) {
        simulation_step(&s);
        down = down || ball(&s)->y < 1e-3;
        up = up || (down && ball(&s)->y > 2e-3);
        if (up) highest = fmax(highest, ball(&s)->y);
    }
    // 10 mm above the floor at first; the overlap under its weight is 4e-4 of that.
    print_message("share %g: height after the bounce %.5f of that before, %.5f expected\n", share,
                  (highest - 1e-3) / 10e-3, wanted);
    assert_true(up && fabs((highest - 1e-3) / 10e-3 - wanted) < 1e-4);
    scree_simulation_close(&s);
    scree_case_free(c);
}

#define GAS                                                                                                            \
    "scree: 1\nname: gas\nseed: 4\n"                                                                                   \
    "materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.4, restitution: 0.9}]\n"        \
    "contact: {law: hertz_mindlin}\nintegrator: {step_fraction: 0.05}\n"                                               \
    "loads: [{load: background_damping, translation: 0.2, rotation: 0.4}]\nmeasure: {samples: 50, cells: no}\n"        \
    "output: {figures: no, paraview: no}\nstages:\n"                                                                   \
    "  - {stage: prepare, method: gas, velocity: 0.5 m/s}\n  - {stage: relax, boundary: plates, duration: 20 ms}\n"

/// The energy that a gas loses is what the contacts and the damping have taken; the residual falls with the step
/// squared.
static double lose_energy(int dimension, const char *const *overrides, size_t count, double *taken)
{
    const char *text =
        dimension == 3
            ? GAS "particles: {shape: sphere, material: glass, count: 60, radius_min: 0.8 mm, radius_max: 1.2 mm}\n"
                  "dimension: 3\n"
            : GAS "particles: {shape: disc, material: glass, count: 60, radius_min: 0.8 mm, radius_max: 1.2 mm}\n";
    scree_case *c = case_read(text, overrides, count);
    scree_simulation s;
    simulation_open(c, 1, &s);
    double worst = 0;
    while (simulation_goes_on(&s)) {
        simulation_step(&s);
        if (simulation_last_steps(&s) > 0) worst = simulation_residual(&s, worst);
    }
    *taken = -scree_module_background_damping.work(&s.state) / s.state.ledger.initial;
    scree_simulation_close(&s);
    scree_case_free(c);
    return worst;
}

static void books_of_energy_are_closed(void **unused)
{
    (void)unused;
    const char *const schemes[] = {"integrator.scheme=position_verlet", "integrator.scheme=velocity_verlet"};
    const char *const directions[] = {"loads.0.direction=vector", "loads.0.direction=components"};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int k = 0; k < 2; k++) {
            const char *const overrides[] = {schemes[k], directions[k], "integrator.step_fraction=0.025"};
            double taken, fine_taken, worst = lose_energy(dimension, overrides, 2, &taken);
            double fine = lose_energy(dimension, overrides, 3, &fine_taken);
            print_message("%dD %s: damping took %.3f of the energy, residual %.2g, %.2g at half the step\n", dimension,
                          schemes[k], taken, worst, fine);
            assert_true(taken > 0.05 && taken < 1 && fabs(fine_taken / taken - 1) < 0.2);
            assert_true(worst < 3e-5 && fine < worst / 3);
        }
}

static void one_is_enough(void **unused)
{
    (void)unused;
    scree_case *c;
    scree_problems *problems;
    const char *const overrides[] = {"loads=[{load: background_damping}, {load: background_damping}]"};
    assert_int_equal(case_parse(BALL, overrides, 1, &c, &problems), SCREE_ERROR_INPUT);
    assert_non_null(strstr(scree_problems_get(problems, 0)->message, "damps the same bodies"));
    scree_problems_free(problems);
}

/// Bodies that a boundary moves are not to be braked: the rule names the stage; plates and a pressure are free of it.
static void no_boundary_that_moves_its_bodies(void **unused)
{
    (void)unused;
    const char *const stages[] = {
        "stages=[{stage: prepare, method: gas}, {stage: confine, pressure: 1 kPa}, {stage: deform, boundary: affine, "
        "velocity_gradient: {xx: 0 1/s, xy: 0 1/s, yx: 0 1/s, yy: -0.1 1/s}, strain: 1 %}]",
        "stages=[{stage: prepare, method: gas}, {stage: confine, pressure: 1 kPa}, {stage: compress, strain: 1 %, "
        "rate: "
        "0.1 1/s}]"};
    for (int k = 0; k < 2; k++) {
        scree_case *c = NULL;
        scree_problems *problems = NULL;
        const char *const overrides[] = {"loads=[{load: background_damping}]", "particles.count=50", "gravity=[0, 0]",
                                         "walls=[]", stages[k]};
        scree_status status = case_parse(BALL, overrides, 5, &c, &problems);
        assert_int_equal(status, k == 0 ? SCREE_ERROR_INPUT : SCREE_OK);
        if (k == 0) {
            const scree_error *problem = scree_problems_get(problems, 0);
            assert_string_equal(problem->field, "loads.0.load");
            assert_non_null(strstr(problem->message, "the boundary of stages.2 imposes velocities"));
        }
        scree_problems_free(problems);
        scree_case_free(c);
    }
}

/// A body falls with g in the stages in which the load does not act, and with g (1 - a) in the one that it names; the
/// balance closes over all of them.
static void it_acts_in_the_stages_that_it_names(void **unused)
{
    (void)unused;
    const char *const overrides[] = {
        "loads=[{load: background_damping, translation: 0.5, from: second, until: second}]",
        "stages=[{stage: prepare, method: bodies, bodies: [{position: [10 mm, 11 mm]}, {position: [30 mm, 31 mm]}]}, "
        "{stage: "
        "relax, name: first, duration: 10 ms}, {stage: relax, name: second, duration: 10 ms}, {stage: relax, name: "
        "third, "
        "duration: 10 ms}]"};
    scree_case *c = case_read(BALL, overrides, 2);
    scree_simulation s;
    double before = 0, worst = 0;
    int64_t stage = 1;
    simulation_open(c, 1, &s);
    simulation_load(&s);
    for (int k = 0; k < 3; k++) {
        const double from = scree_state_time(&s.state);
        while (simulation_goes_on(&s) && s.state.stage.index == stage) {
            simulation_step(&s);
            worst = simulation_residual(&s, worst);
        }
        const double gained = ball(&s)->vy - before, time = scree_state_time(&s.state) - from;
        print_message("stage %d: acceleration %.6g m/s2\n", k + 1, gained / time);
        assert_true(fabs(gained / time / (k == 1 ? 0.5 * 9.81 : 9.81) + 1) < 2e-3);
        before = ball(&s)->vy;
        stage = s.state.stage.index;
    }
    assert_true(worst < 1e-9);
    scree_simulation_close(&s);
    scree_case_free(c);
}

static void stages_that_are_not_there_are_refused(void **unused)
{
    (void)unused;
    static const char *const wrong[][2] = {
        {"loads=[{load: background_damping, from: settel}]", "settel"},
        {"loads=[{load: background_damping, from: relax, until: prepare}]", "comes before stage"},
    };
    for (size_t k = 0; k < 2; k++) {
        scree_case *c;
        scree_problems *problems;
        char line[1024];
        assert_int_equal(case_parse(BALL, &wrong[k][0], 1, &c, &problems), SCREE_ERROR_INPUT);
        scree_error_format(scree_problems_get(problems, 0), line, sizeof line);
        print_message("%s\n", line);
        assert_non_null(strstr(line, wrong[k][1]));
        scree_problems_free(problems);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(free_fall_is_slowed),
        cmocka_unit_test(a_ball_bounces_lower),
        cmocka_unit_test(books_of_energy_are_closed),
        cmocka_unit_test(one_is_enough),
        cmocka_unit_test(no_boundary_that_moves_its_bodies),
        cmocka_unit_test(it_acts_in_the_stages_that_it_names),
        cmocka_unit_test(stages_that_are_not_there_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
