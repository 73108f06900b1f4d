/// Constant torques against rolling and twisting (contact/constant_torque.h), in 2D and 3D: a body that rolls on a
/// plate slows down as the closed form says and comes to rest without being turned back; a spinning sphere; energies;
/// exchange of the bodies; cohesive grains on the same.
///
/// Rolling without slip, of mass m, inertia J = m R^2 / kappa, under the torque mu_r R f_n: a = mu_r f_n / (m (1 + 1 /
/// kappa)), the way v_0^2 / (2 a). Zhou et al. 1999.
#include "sphere_fixture.h"

#define assert_near(value, expected, tolerance)                                                                        \
    do {                                                                                                               \
        const double value_ = (value), expected_ = (expected);                                                         \
        if (!(fabs(value_ - expected_) <= (tolerance)))                                                                \
            fail_msg("%s is %.17g, not %.17g within %g", #value, value_, expected_, (double)(tolerance));              \
    } while (0)

static const double STEP = 1e-6, RADIUS = 1e-3, WEIGHT = 9.81, RESISTS = 0.02, SPEED = 0.02;

/// One body on the bottom plate, at its rest.
static void create(fixture *f, int dimension, law_choice law, double root)
{
    fixture_create_in(f, dimension, law, 1, STEP);
    f->model.scheme = SCREE_SLOT_velocity_verlet;
    f->model.laws[0].option = law == HERTZ_MINDLIN ? MINDLIN_CONSTANT : ADHESIVE_CONSTANT;
    f->model.walls[0] = f->model.pairs[0][0] = hertz_pair(4e6, 5e6, 0.5, 0.3);
    f->model.walls[0].value[HERTZ_ROLLING] = RESISTS;
    f->model.walls[0].value[HERTZ_TWISTING] = RESISTS;
    f->model.walls[0].value[ADHESIVE_ROOT] = root;
    f->model.gravity[1] = -WEIGHT;
    const scree_row *row = &f->state.row[0];
    f->state.row[0].mass = fixture_mass(&f->model, 0, RADIUS);
    const double weight = row->mass * WEIGHT;
    f->state.row[0].y = RADIUS - pow(weight / (4e6 * sqrt(RADIUS)), 2.0 / 3);
    scree_plates(&f->state)[SCREE_WALL_BOTTOM] = (scree_wall){.normal = {0, 1, 0}, .active = true};
    fixture_find_walls(f);
    f->state.largest_overlap = 1e-5;
}

static double spin_of(const fixture *f)
{
    return f->state.dimension == 3 ? f->state.turn[0].wz : f->state.row[0].spin;
}

static void turn(fixture *f, double about_z, double about_y)
{
    if (f->state.dimension == 3)
        f->state.turn[0] = (scree_turn_row){0, about_y, about_z, 0};
    else
        f->state.row[0].spin = about_z;
    fixture_measure_speed(f);
}

static void a_rolling_body_slows_down_and_rests(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        const double kappa = dimension == 3 ? 2.5 : 2, slowing = RESISTS * WEIGHT / (1 + 1 / kappa);
        const double arrival = SPEED / slowing, way = 0.5 * SPEED * SPEED / slowing;
        fixture f;
        create(&f, dimension, HERTZ_MINDLIN, 0);
        f.state.row[0].vx = SPEED;
        turn(&f, -SPEED / RADIUS, 0);
        const int half = (int)(0.5 * arrival / STEP);
        sphere_run(&f, half);
        assert_near(f.state.row[0].vx / SPEED, 0.5, 2e-3);
        assert_near(-spin_of(&f) * RADIUS / SPEED, 0.5, 2e-3);
        // Past the arrival it never rolls back faster than the spring of friction swings, and rests in the end.
        for (int k = half; k < (int)(1.5 * arrival / STEP); k++) sphere_step(&f);
        assert_near(f.state.row[0].x / way, 1, 2e-3);
        double fastest = 0;
        for (int k = 0; k < 2000; k++) {
            sphere_step(&f);
            fastest = fmax(fastest, fmax(fabs(f.state.row[0].vx), RADIUS * fabs(spin_of(&f))));
        }
        assert_true(fastest < 1e-6 * SPEED);
        fixture_destroy(&f);
    }
}

/// m R^2 / kappa w' = -mu_tw R f_n about the normal of the plate.
static void a_spinning_sphere_slows_down(void **unused)
{
    (void)unused;
    const double spin = 20, slowing = RESISTS * WEIGHT * 2.5 / RADIUS;
    fixture f;
    create(&f, 3, HERTZ_MINDLIN, 0);
    turn(&f, 0, spin);
    sphere_run(&f, (int)(0.5 * spin / slowing / STEP));
    assert_near(f.state.turn[0].wy / spin, 0.5, 1e-3);
    for (int k = 0; k < (int)(spin / slowing / STEP); k++) sphere_step(&f);
    assert_true(fabs(f.state.turn[0].wy) < 1e-9 * spin);
    fixture_destroy(&f);
}

/// All that rolling has goes into friction: the ledger at the end, and its order: the trapezoids of a torque that does
/// not change are exact.
static void the_books_close(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int law = 0; law < 2; law++) {
            fixture f;
            create(&f, dimension, law ? HERTZ_JKR : HERTZ_MINDLIN, law ? 1e-4 : 0);
            f.state.row[0].vx = SPEED;
            turn(&f, -SPEED / RADIUS, 5);
            fixture_forces(&f);
            const double height = f.state.row[0].y, mass = f.state.row[0].mass;
            const double before = fixture_kinetic(&f) + fixture_elastic(&f);
            f.state.ledger = (scree_ledger){0};
            double last = 0;
            for (int k = 0; k < 200000; k++) {
                sphere_step(&f);
                assert_true(f.state.ledger.friction >= last - 1e-9 * before);
                last = f.state.ledger.friction;
            }
            const double after =
                fixture_kinetic(&f) + fixture_elastic(&f) + mass * WEIGHT * (f.state.row[0].y - height);
            const double residual =
                after + f.state.ledger.damping + f.state.ledger.friction - f.state.ledger.stiffness - before;
            assert_true(f.state.ledger.friction > 0.5 * before || law);
            assert_near(residual / before, 0, 1e-5);
            fixture_destroy(&f);
        }
}

/// The cap counts the adhesion: mu_r (m g + 2 F_c) R.
static void sticky_bodies_roll_less(void **unused)
{
    (void)unused;
    const double root = 2e-4, pull = 9.0 / 16 * root * root * 4e6 * RADIUS;
    fixture f;
    create(&f, 3, HERTZ_JKR, root);
    const double weight = f.state.row[0].mass * WEIGHT;
    const double slowing = RESISTS * (weight + 2 * pull) / f.state.row[0].mass / 1.4;
    assert_true(pull > 0.2 * weight);
    sphere_run(&f, 100000); // to its rest
    f.state.row[0].vx = SPEED;
    turn(&f, -SPEED / RADIUS, 0);
    for (int k = 0; k < (int)(0.5 * SPEED / slowing / STEP); k++) sphere_step(&f);
    assert_near(f.state.row[0].vx / SPEED, 0.5, 5e-3);
    fixture_destroy(&f);
}

/// Two bodies that turn against each other get opposite torques, and the same when they are exchanged.
static void torques_are_opposite(void **unused)
{
    (void)unused;
    for (int exchanged = 0; exchanged < 2; exchanged++) {
        double force[3], one[3], other[3];
        fixture f;
        fixture_create_in(&f, 3, HERTZ_MINDLIN, 2, 1e-8);
        f.model.laws[0].option = MINDLIN_CONSTANT;
        f.model.pairs[0][0].value[SCREE_FRICTION] = 0;
        f.model.pairs[0][0].value[HERTZ_DAMPING] = 0;
        f.model.pairs[0][0].value[HERTZ_ROLLING] = 0.1;
        f.model.pairs[0][0].value[HERTZ_TWISTING] = 0.2;
        const size_t first = exchanged ? 1 : 0;
        f.state.row[first].x = 1.99e-3;
        f.state.turn[first] = (scree_turn_row){700, 0, 800, 0};
        f.state.turn[1 - first] = (scree_turn_row){0, -300, 0, 0};
        fixture_measure_speed(&f);
        fixture_find_pairs(&f, 1e-4);
        f.state.largest_overlap = 1e-5;
        fixture_forces(&f);
        sphere_force(&f, first, force, one);
        sphere_force(&f, 1 - first, force, other);
        const double normal = fabs(force[0]), cap = 0.1 * 0.5e-3 * normal, turned = hypot(300, 800);
        assert_near(one[0], -0.2 * 0.5e-3 * normal, 1e-9 * cap);
        assert_near(one[1], -cap * 300 / turned, 1e-3 * cap);
        assert_near(one[2], -cap * 800 / turned, 1e-3 * cap);
        for (int k = 0; k < 3; k++) assert_true(one[k] == -other[k]);
        fixture_destroy(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rolling_body_slows_down_and_rests),
        cmocka_unit_test(a_spinning_sphere_slows_down),
        cmocka_unit_test(the_books_close),
        cmocka_unit_test(sticky_bodies_roll_less),
        cmocka_unit_test(torques_are_opposite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
