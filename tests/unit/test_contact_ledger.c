/// The energy ledger of the contact laws on a few colliding, rolling and sliding bodies between moving walls: kinetic +
/// elastic + dissipated - put in is constant, up to an error that falls as the square of the step.
#include "contact_fixture.h"
#include "state/plates.h"

/// Five unequal bodies that meet in the middle of a box of four walls, two of which move.
static void create(fixture *f, law_choice law, double step)
{
    static const double place[5][2] = {
        {-1.5e-3, 0.1e-3}, {1.4e-3, -0.2e-3}, {0.1e-3, 1.8e-3}, {-0.2e-3, -1.7e-3}, {2.0e-3, 2.2e-3}};
    static const double velocity[5][2] = {{3, 0.5}, {-2, 0.2}, {0.3, -3}, {-0.4, 2}, {-1.5, -2.5}};
    static const double spin[5] = {800, -1500, 300, 0, 2000};
    fixture_create(f, law, 5, step);
    for (size_t k = 0; k < 5; k++) {
        scree_row *row = &f->state.row[k];
        double radius = 1e-3 * (0.8 + 0.1 * (double)k);
        *row = (scree_row){.x = place[k][0],
                           .y = place[k][1],
                           .radius = radius,
                           .vx = velocity[k][0],
                           .vy = velocity[k][1],
                           .spin = spin[k],
                           .mass = fixture_mass(&f->model, 0, radius)};
    }
    scree_wall *wall = scree_plates(&f->state);
    wall[SCREE_WALL_BOTTOM] = (scree_wall){.position = -3e-3, .normal = {0, 1}, .velocity = 0.5, .active = 1};
    wall[SCREE_WALL_TOP] =
        (scree_wall){.position = -3.6e-3, .normal = {0, -1}, .tangential_velocity = {2}, .active = 1};
    wall[SCREE_WALL_LEFT] = (scree_wall){.position = -2.9e-3, .normal = {1, 0}, .velocity = -0.3, .active = 1};
    wall[SCREE_WALL_RIGHT] = (scree_wall){.position = -3.2e-3, .normal = {-1, 0}, .active = 1};
    fixture_find_pairs(f, 1);
    fixture_find_walls(f);
    fixture_measure_speed(f);
}

/// The scheme's own kinetic energy, 1/2 m v(n-1/2) . v(n+1/2), and the same of rotation.
static double kinetic(const fixture *f)
{
    double energy = 0, dt = f->state.step_size;
    for (size_t k = 0; k < f->state.count; k++) {
        const scree_row *row = &f->state.row[k];
        double force[3], inertia = 0.5 * row->mass * row->radius * row->radius;
        fixture_force(f, k, force);
        energy += 0.5 * row->mass *
                  (row->vx * (row->vx + dt * force[0] / row->mass) + row->vy * (row->vy + dt * force[1] / row->mass));
        energy += 0.5 * inertia * row->spin * (row->spin + dt * force[2] / inertia);
    }
    return energy;
}

static double balance(const fixture *f)
{
    const scree_ledger *l = &f->state.ledger;
    return kinetic(f) + fixture_elastic(f) + l->damping + l->friction - l->stiffness - l->plates;
}

/// Largest imbalance over 2 ms, relative to the turnover.
static double worst_residual(law_choice law, bool rescaled, int steps)
{
    fixture f;
    create(&f, law, 2e-3 / steps);
    law_rescale(&f.model, rescaled);
    fixture_forces(&f);
    double initial = balance(&f), worst = 0;
    for (int k = 0; k < steps; k++) {
        fixture_step(&f);
        if (k % (steps / 200) == 0) worst = fmax(worst, fabs(balance(&f) - initial));
    }
    const scree_ledger *l = &f.state.ledger;
    assert_int_equal(f.work.flags, 0);
    // Everything happened: impacts, sliding, springs of changing stiffness, work of the walls.
    double before = 0.04;
    assert_true(l->turnover > 0.5 * before && l->damping > 0.1 * before && fabs(l->friction) > 1e-3 * before);
    assert_true(fabs(l->plates) > 1e-3 * before);
    assert_true((fabs(l->stiffness) > 1e-3 * before) == (law == HERTZ_MINDLIN));
    worst /= l->turnover;
    fixture_destroy(&f);
    return worst;
}

/// Halving the step divides the residual by four, within what the few samples of the worst case leave.
static void ledger_closes_with_the_square_of_the_step(void **unused)
{
    (void)unused;
    for (int k = 0; k < 3; k++) {
        const law_choice law = k == 0 ? HERTZ_BRILLIANTOV : HERTZ_MINDLIN;
        double coarse = worst_residual(law, k == 2, 20000), fine = worst_residual(law, k == 2, 80000);
        assert_true(coarse / fine > 12 && coarse / fine < 20);
        assert_true(worst_residual(law, k == 2, 320000) < 1e-6);
    }
}

/// A contact that opens takes its spring with it: what the spring held is accumulated, and the history is clear.
static void opening_books_the_spring(void **unused)
{
    (void)unused;
    fixture f;
    fixture_create(&f, HERTZ_MINDLIN, 2, 1e-7);
    f.model.pairs[0][0].value[HERTZ_DAMPING] = 0;
    f.state.row[1].x = -2e-3 + 2e-6;
    f.state.row[0].vy = 1e-2;
    f.state.largest_overlap = 2e-6;
    fixture_find_pairs(&f, 1e-4);
    fixture_measure_speed(&f);
    fixture_forces(&f);
    double held = fixture_elastic(&f);
    const scree_history *history = &f.work.pairs.history[0];
    double spring = 0.5 * history->value[1] * history->value[0] * history->value[0];
    assert_true(spring > 0 && held > spring);
    assert_true(f.state.ledger.friction == 0 && f.state.ledger.damping == 0);
    f.state.row[0].x += 1e-5;
    f.state.row[0].vy = 0;
    fixture_forces(&f);
    for (int k = 0; k < SCREE_HISTORY; k++) assert_true(history->value[k] == 0);
    // one rounding to the quantum of the ledger
    assert_true(fabs(f.state.ledger.friction - spring) <= 1e-9 * held);
    fixture_destroy(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ledger_closes_with_the_square_of_the_step),
        cmocka_unit_test(opening_books_the_spring),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
