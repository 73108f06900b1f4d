/// The energy ledger on spheres: kinetic + elastic + dissipated - put in is constant, up to an error that falls as the
/// square of the step. Bodies that collide, slide, roll and twist between moving walls; a single oblique impact.
#include "sphere_fixture.h"
#include "state/plates.h"

/// Five unequal spheres that meet in the middle of a box of six walls, three of which move.
static void create(fixture *f, law_choice law, bool rolling, double step)
{
    static const sphere spheres[5] = {
        {{-1.5e-3, 0.1e-3, 0.2e-3}, {3, 0.5, -0.3}, {800, 300, -900}, 0.8e-3, 0},
        {{1.4e-3, -0.2e-3, -0.1e-3}, {-2, 0.2, 0.6}, {-1500, 700, 200}, 0.9e-3, 0},
        {{0.1e-3, 1.8e-3, 0.1e-3}, {0.3, -3, 0.4}, {300, 0, 1200}, 1.0e-3, 0},
        {{-0.2e-3, -1.7e-3, 0.3e-3}, {-0.4, 2, -0.5}, {0, -600, 0}, 1.1e-3, 0},
        {{0.3e-3, 0.2e-3, 2.1e-3}, {-0.5, -0.2, -2.5}, {2000, -400, 500}, 1.2e-3, 0},
    };
    fixture_create_in(f, 3, law, 5, step);
    if (rolling) sphere_resist_turning(f);
    for (size_t k = 0; k < 5; k++) sphere_set(f, k, &spheres[k]);
    scree_wall *wall = scree_plates(&f->state);
    wall[SCREE_WALL_BOTTOM] = (scree_wall){.position = -3e-3, .normal = {0, 0, 1}, .velocity = 0.5, .active = 1};
    wall[SCREE_WALL_TOP] =
        (scree_wall){.position = -3.6e-3, .normal = {0, 0, -1}, .tangential_velocity = {2, -1}, .active = 1};
    wall[SCREE_WALL_LEFT] = (scree_wall){.position = -2.9e-3, .normal = {1}, .velocity = -0.3, .active = 1};
    wall[SCREE_WALL_RIGHT] = (scree_wall){.position = -3.2e-3, .normal = {-1}, .active = 1};
    wall[SCREE_WALL_FRONT] =
        (scree_wall){.position = -3e-3, .normal = {0, 1}, .tangential_velocity = {0, 0, 1.5}, .active = 1};
    wall[SCREE_WALL_BACK] = (scree_wall){.position = -3.1e-3, .normal = {0, -1}, .active = 1};
    fixture_find_pairs(f, 1);
    fixture_find_walls(f);
    fixture_measure_speed(f);
}

/// The scheme's own kinetic energy, 1/2 m v(n-1/2) . v(n+1/2), and the same of rotation.
static double balance(const fixture *f)
{
    const scree_ledger *l = &f->state.ledger;
    return fixture_kinetic(f) + fixture_elastic(f) + l->damping + l->friction - l->stiffness - l->plates;
}

/// Largest imbalance over 2 ms, relative to the turnover.
static double worst_residual(law_choice law, bool rolling, bool rescaled, int steps)
{
    fixture f;
    create(&f, law, rolling, 2e-3 / steps);
    law_rescale(&f.model, rescaled);
    fixture_forces(&f);
    double initial = balance(&f), worst = 0;
    for (int k = 0; k < steps; k++) {
        sphere_step(&f);
        if (k % (steps / 200) == 0) worst = fmax(worst, fabs(balance(&f) - initial));
    }
    const scree_ledger *l = &f.state.ledger;
    assert_int_equal(f.work.flags, 0);
    // Everything happened: impacts, sliding, springs of changing stiffness, work of the walls.
    assert_true(l->turnover > 0.5 * initial && l->damping > 0.1 * initial && fabs(l->friction) > 1e-3 * initial);
    assert_true(fabs(l->plates) > 1e-3 * initial);
    assert_true((fabs(l->stiffness) > 1e-3 * initial) == (law == HERTZ_MINDLIN));
    worst /= l->turnover;
    fixture_destroy(&f);
    return worst;
}

/// Halving the step divides the residual by four, within what the few samples of the worst case leave.
static void check_order(law_choice law, bool rolling, bool rescaled)
{
    double coarse = worst_residual(law, rolling, rescaled, 20000), fine = worst_residual(law, rolling, rescaled, 80000);
    double finest = worst_residual(law, rolling, rescaled, 320000);
    assert_true(coarse / fine > 12 && coarse / fine < 20);
    assert_true(finest < 1e-6);
}

static void ledger_closes_with_the_square_of_the_step(void **unused)
{
    (void)unused;
    check_order(HERTZ_BRILLIANTOV, false, false);
    check_order(HERTZ_MINDLIN, false, false);
    check_order(HERTZ_MINDLIN, false, true);
}

static void ledger_closes_with_rolling_and_twisting(void **unused)
{
    (void)unused;
    check_order(HERTZ_MINDLIN, true, false);
    check_order(HERTZ_MINDLIN, true, true);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ledger_closes_with_the_square_of_the_step),
        cmocka_unit_test(ledger_closes_with_rolling_and_twisting),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
