/// Walls that move by table, vibrate, or hold a force: closed forms, the energy balance, restarts, errors.
#include "run_fixture.h"

#include "case/wall_motion.h"
#include "contact/hertz.h"
#include "io_scratch.h"

/// Discs of 1 mm on a floor. The stage `settle` lets them come to rest before walls move.
#define BALLS(wall, settled)                                                                                           \
    "scree: 1\nname: balls\ngravity: [0, -10]\n"                                                                       \
    "materials: [{name: glass, young_modulus: 100 MPa, poisson_ratio: 0.25, density: 2500 kg/m3, friction: 0.3,\n"     \
    "  restitution: 0.3}]\n"                                                                                           \
    "particles: {shape: disc, material: glass, count: 2, distribution: equal, radius: 1 mm}\n"                         \
    "contact: {law: hertz_mindlin}\nintegrator: {step_fraction: 0.1}\n"                                                \
    "walls:\n" wall "measure: {samples: 50, cells: no}\noutput: {figures: no, paraview: no}\nstages:\n"                \
    "  - {stage: prepare, method: bodies, bodies: [{position: [0, 1 mm]}, {position: [30 mm, 1 mm]}]}\n"               \
    "  - {stage: relax, name: settle, duration: " settled ", walls: stand}\n"                                          \
    "  - {stage: relax, name: move, duration: 40 ms}\n"

#define FLOOR "  - {shape: plane, name: floor, point: [0, 0], normal: [0, 1]}\n"
/// Its lowest point is at y = 0, where it begins, at rest.
#define SHAKER                                                                                                         \
    "  - {shape: plane, name: shaker, point: [0, 0.2 mm], normal: [0, 1], motion: vibration, amplitude: [0, 0.2 "      \
    "mm],\n"                                                                                                           \
    "     frequency: 30 1/s, phase: -90 degrees}\n"

static scree_simulation *open_case(const char *text, const char *const *overrides, size_t count, scree_case **c)
{
    static scree_simulation s;
    *c = case_read(text, overrides, count);
    simulation_open(*c, 1, &s);
    return &s;
}

static void close_case(scree_simulation *s, scree_case *c)
{
    scree_simulation_close(s);
    scree_case_free(c);
}

static bool moves(const scree_simulation *s)
{
    return s->state.stage.index == 2 && s->state.stage.counter >= 0;
}

/// A ball on a floor at -a cos(w t) leaves it where g + a w^2 cos(w t) = 0, and never where a w^2 < g. The contact is a
/// spring whose own frequency is some 30 times as high, which blurs the angle by about the inverse of that.
static void a_ball_takes_off_where_the_floor_falls_faster(void **unused)
{
    (void)unused;
    const double w = 2 * M_PI * 30, shares[] = {0.9, 1.1, 1.5};
    for (int k = 0; k < 3; k++) {
        char amplitude[80], point[80];
        double a = shares[k] * 10 / (w * w), left = NAN;
        (void)snprintf(amplitude, sizeof amplitude, "walls.shaker.amplitude=[0, %.17g]", a);
        (void)snprintf(point, sizeof point, "walls.shaker.point=[0, %.17g]", a);
        const char *const overrides[] = {amplitude, point};
        scree_case *c;
        scree_simulation *s = open_case(BALLS(SHAKER, "20 ms"), overrides, 2, &c);
        while (simulation_goes_on(s) && isnan(left)) {
            simulation_step(s);
            if (moves(s) && scree_case_walls(&s->state)->load[0].force[1] == 0)
                left = w * scree_case_walls_time(scree_case_walls(&s->state), &s->state);
        }
        double wanted = shares[k] > 1 ? acos(-1 / shares[k]) : NAN;
        print_message("a w^2 = %.2g g: leaves at %.4f rad, %.4f expected\n", shares[k], left, wanted);
        assert_true(shares[k] > 1 ? fabs(left - wanted) < 0.06 : isnan(left));
        close_case(s, c);
    }
}

#define PUSHER(kinematics)                                                                                             \
    FLOOR "  - {shape: box, name: pusher, lower: [-20 mm, 0.1 mm], upper: [-1.5 mm, 3 mm], side: outside, " kinematics \
          "}"                                                                                                          \
          "\n"

/// A table of velocity and the table of its integral lead along the same way, which is the integral of the first; the
/// ball goes where it is pushed, and the ledger has the work.
static void tables_of_velocity_and_displacement_agree(void **unused)
{
    (void)unused;
    const char *const ways[] = {"walls.pusher.velocity=[[5 ms, 0, 0], [15 ms, 0.4 m/s, 0], [25 ms, 0, 0]]",
                                "walls.pusher.displacement=table_of_test.csv"};
    double way[2], ball[2];
    FILE *table = fopen("table_of_test.csv", "w");
    assert_non_null(table);
    for (int k = 0; k <= 400; k++) {
        double t = 0.05 * k + 5, rise = fmin(t - 5, 10), fall = fmax(t - 15, 0);
        double s = 0.04 * rise * rise / 2 + 0.4 * fall - 0.04 * fall * fall / 2;
        fprintf(table, "%s%.17g, %.17g, 0\n", k == 0 ? "time [ms], x [mm], y [mm]\n" : "", t, s);
    }
    assert_int_equal(fclose(table), 0);
    for (int k = 0; k < 2; k++) {
        scree_case *c;
        scree_simulation *s =
            open_case(k == 0 ? BALLS(PUSHER("velocity: [0, 0]"), "1 ms")
                             : BALLS(PUSHER("motion: displacement, displacement: [[0, 0, 0], [1, 0, 0]]"), "1 ms"),
                      &ways[k], 1, &c);
        double worst = 0;
        while (simulation_goes_on(s)) {
            simulation_step(s);
            worst = simulation_residual(s, worst);
            const scree_surface *pusher = &s->work.wall_set->surface[1];
            double time = scree_case_walls_time(scree_case_walls(&s->state), &s->state);
            if (k == 0) assert_true(pusher->shift[0] == scree_schedule_integral(&c->config.walls[1].velocity[0], time));
        }
        way[k] = s->work.wall_set->surface[1].shift[0];
        ball[k] = s->state.row[s->state.row_of_id[0]].x;
        print_message("way %.6g m, ball at %.6g m, work %.4g J, residual %.2g\n", way[k], ball[k],
                      scree_case_walls(&s->state)->load[1].work, worst);
        assert_true(fabs(way[k] - 0.004) < 1e-12 && ball[k] > way[k] - 1.5e-3 + 0.9e-3);
        assert_true(scree_case_walls(&s->state)->load[1].work > 1e-7 && worst < 1e-5);
        close_case(s, c);
    }
    // The steps of the second table are 50 us long.
    assert_true(fabs(ball[0] / ball[1] - 1) < 1e-2);
    assert_int_equal(remove("table_of_test.csv"), 0);
}

#define LID                                                                                                            \
    FLOOR "  - {shape: plane, name: lid, point: [0, 2.02 mm], normal: [0, -1], motion: servo, direction: [0, -3],\n"   \
          "     force: 2 N, area: 8 mm2}\n"

/// Two balls between a floor and a lid that presses with F: each bears half of it, and with gravity off each of its two
/// contacts is indented by d, w = F / 2 = K sqrt(R) d^1.5.
static void a_servo_settles_at_its_force(void **unused)
{
    (void)unused;
    const char *const overrides[] = {"gravity=[0, 0]"};
    scree_case *c;
    scree_simulation *s = open_case(BALLS(LID, "1 ms"), overrides, 1, &c);
    double worst = 0;
    while (simulation_goes_on(s)) {
        simulation_step(s);
        worst = simulation_residual(s, worst);
    }
    const scree_surface_load *lid = &scree_case_walls(&s->state)->load[1];
    double k = s->model.walls[0].value[HERTZ_NORMAL], d = pow(1 / (k * sqrt(1e-3)), 2.0 / 3);
    print_message("force %.9g N, travel %.9g mm, 0.02 + 2 x %.9g mm expected, residual %.2g\n", lid->force[1],
                  1e3 * lid->travel, 1e3 * d, worst);
    assert_true(fabs(lid->force[1] / 2 - 1) < 1e-6);
    assert_true(fabs(lid->travel - 2e-5 - 2 * d) < 1e-6 * d);
    assert_true(worst < 1e-6 && fabs(lid->speed) < 1e-6);
    close_case(s, c);
}

/// Without dissipation the residual is that of the trapezoidal rule alone, third order a step; vibrations and tables
/// leave nothing.
static void the_balance_closes(void **unused)
{
    (void)unused;
    const char *const both = BALLS(SHAKER "  - {shape: plane, name: side, point: [-1.1 mm, 0], normal: [1, 0],\n"
                                          "     velocity: [[0, 0, 0], [10 ms, 0.2, 0], [20 ms, 0, 0]]}\n",
                                   "1 ms");
    const char *const fractions[] = {"integrator.step_fraction=0.02", "integrator.step_fraction=0.01"};
    double worst[2] = {0};
    for (int k = 0; k < 2; k++) {
        const char *const overrides[] = {"materials.0.restitution=1", "materials.0.friction=0", fractions[k]};
        scree_case *c;
        scree_simulation *s = open_case(both, overrides, 3, &c);
        while (simulation_goes_on(s)) {
            simulation_step(s);
            worst[k] = simulation_residual(s, worst[k]);
        }
        assert_true(scree_case_walls(&s->state)->load[0].work != 0 && scree_case_walls(&s->state)->load[1].work > 1e-8);
        close_case(s, c);
    }
    print_message("residual %.2g, %.2g at half the step\n", worst[0], worst[1]);
    assert_true(worst[0] < 1e-5 && worst[1] < worst[0] / 3.5);
}

/// From checkpoints in mid-motion, and with other threads.
static void a_restart_changes_nothing(void **unused)
{
    (void)unused;
    char folder[64];
    const char *const texts[] = {BALLS(SHAKER, "1 ms"), BALLS(LID, "1 ms"),
                                 BALLS(PUSHER("velocity: [[5 ms, 0, 0], [15 ms, 0.4 m/s, 0], [25 ms, 0, 0]]"), "1 ms")};
    assert_true(scratch_create(folder));
    for (int k = 0; k < 3; k++) {
        scree_case *c = case_read(texts[k], NULL, 0);
        for (int part = 1; part < 4; part++) {
            scree_simulation s, other;
            simulation_open(c, 1, &s);
            while (scree_state_time(&s.state) < 0.006 * part) simulation_step(&s);
            simulation_reopen(&s, 3, folder, &other);
            (void)simulation_finish(&s);
            (void)simulation_finish(&other);
            assert_true(scree_simulation_checksum(&s) == scree_simulation_checksum(&other));
            assert_true(simulation_close(&s) == simulation_close(&other));
        }
        scree_case_free(c);
    }
    scratch_destroy(folder);
}

static void refuse(const char *override, const char *message)
{
    scree_case *c;
    scree_problems *problems;
    char line[2048];
    if (case_parse(BALLS(LID SHAKER, "1 ms"), &override, 1, &c, &problems) == SCREE_OK) fail_msg("%s", override);
    scree_error_format(scree_problems_get(problems, 0), line, sizeof line);
    if (!strstr(line, message)) fail_msg("%s: %s", override, line);
    scree_problems_free(problems);
}

static void what_is_wrong_is_said(void **unused)
{
    (void)unused;
    refuse("walls.lid.force=[[0, 1 N], [2 s, 2 N], [1 s, 1 N]]", "time must increase");
    refuse("walls.lid.direction=[0, 0]", "a servo needs a direction");
    refuse("walls.lid.direction=[0, 0, 1]", "there is no z");
    refuse("walls.lid.area=auto", "has no area along `direction`");
    refuse("walls.lid.area=0", "too small");
    refuse("walls.floor.motion=servos", "did you mean 'servo'?");
    refuse("walls.lid.velocity=[0, 1]", "only with motion: velocity");
    refuse("walls.shaker.displacement=[[0, 0, 1], [1, 1, 1]]", "only with motion: displacement");
    refuse("walls.shaker.amplitude=[0, 0]", "needs an amplitude");
    refuse("walls.shaker.frequency=1e8 1/s", "faster than 1000 m/s");
    refuse("walls.floor.velocity=[[0, 0, 0, 1], [1, 0, 0, 1]]", "there is no z");
    refuse("walls.shaker.motion=displacement", "displacement: required, but not given");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ball_takes_off_where_the_floor_falls_faster),
        cmocka_unit_test(tables_of_velocity_and_displacement_agree),
        cmocka_unit_test(a_servo_settles_at_its_force),
        cmocka_unit_test(the_balance_closes),
        cmocka_unit_test(a_restart_changes_nothing),
        cmocka_unit_test(what_is_wrong_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
