/// Spheres that move in a plane are discs: the same assembly in two and in three dimensions. Spheres get the masses of
/// the discs, which the laws read from the rows; their moment of inertia belongs to the integrator (2/5 against 1/2),
/// so a leapfrog of this test, with that of discs, moves both.
#include "sphere_fixture.h"
#include "state/plates.h"

enum { SIDE = 15, STEPS = 400 };

/// The discs of `plane` as spheres on the plane z = 0.
static void create_solid(fixture *solid, const fixture *plane, law_choice law)
{
    fixture_create_in(solid, 3, law, plane->state.count, plane->state.step_size);
    solid->model.material_count = plane->model.material_count;
    for (size_t k = 0; k < plane->state.count; k++) {
        const scree_row *disc = &plane->state.row[k];
        sphere s = {.place = {disc->x, disc->y},
                    .velocity = {disc->vx, disc->vy},
                    .spin = {0, 0, disc->spin},
                    .radius = disc->radius,
                    .material = (int)disc->material};
        sphere_set(solid, k, &s);
        solid->state.row[k].mass = disc->mass;
    }
    fixture_measure_speed(solid);
    fixture_find_pairs(solid, 3e-4);
}

static void put_walls(fixture *f)
{
    scree_plates(&f->state)[SCREE_WALL_LEFT] = (scree_wall){
        .position = -0.96e-3, .normal = {1}, .velocity = 0.3, .tangential_velocity = {0, 0.2}, .active = 1};
    fixture_find_walls(f);
}

/// Leapfrog of spheres with the inertia of discs.
static void step_as_discs(fixture *f)
{
    double dt = f->state.step_size, force[3], torque[3];
    for (size_t k = 0; k < f->state.count; k++) {
        scree_row *row = &f->state.row[k];
        scree_turn_row *turn = &f->state.turn[k];
        double inertia = 0.5 * row->mass * row->radius * row->radius;
        sphere_force(f, k, force, torque);
        row->vx += dt * (force[0] / row->mass), row->vy += dt * (force[1] / row->mass);
        row->vz += dt * (force[2] / row->mass);
        turn->wx += dt * torque[0] / inertia, turn->wy += dt * torque[1] / inertia;
        turn->wz += dt * torque[2] / inertia;
        row->x += dt * row->vx, row->y += dt * row->vy, row->z += dt * row->vz;
    }
    for (int w = 0; w < SCREE_WALL_COUNT; w++)
        scree_plates(&f->state)[w].position += dt * scree_plates(&f->state)[w].velocity;
    f->state.step++;
    fixture_measure_speed(f);
    fixture_forces(f);
}

static void compare(const fixture *plane, const fixture *solid)
{
    // Round-off of 1e-16 of the sample's 3 cm a step and contact, which collisions of a few time units enlarge by less
    // than a thousand; speeds are of 1 m/s, spins of 1000 rad/s.
    for (size_t k = 0; k < plane->state.count; k++) {
        const scree_row *disc = &plane->state.row[k], *ball = &solid->state.row[k];
        const scree_turn_row *turn = &solid->state.turn[k];
        assert_true(fabs(disc->x - ball->x) < 1e-14 && fabs(disc->y - ball->y) < 1e-14);
        assert_true(fabs(disc->vx - ball->vx) < 1e-9 && fabs(disc->vy - ball->vy) < 1e-9);
        assert_true(fabs(disc->spin - turn->wz) < 1e-6);
        assert_true(ball->z == 0 && ball->vz == 0 && turn->wx == 0 && turn->wy == 0);
        assert_int_equal(plane->state.sum[k].contacts, solid->state.sum[k].contacts);
    }
    const scree_ledger *a = &plane->state.ledger, *b = &solid->state.ledger;
    // accumulated dashpots have 24 bits
    assert_true(a->damping > 0 && fabs(a->damping - b->damping) < 1e-7 * a->turnover);
    assert_true(a->friction > 0 && fabs(a->friction - b->friction) < 1e-7 * a->turnover);
    assert_true(fabs(a->plates - b->plates) < 1e-9 * a->turnover);
    const scree_wall *one = &scree_plates(&plane->state)[SCREE_WALL_LEFT],
                     *other = &scree_plates(&solid->state)[SCREE_WALL_LEFT];
    assert_true(one->force > 0 && fabs(one->force - other->force) < 1e-8 * one->force);
    assert_true(fabs(one->shear[1] - other->shear[1]) < 1e-8 * one->force && other->shear[2] == 0);
}

static void spheres_in_a_plane_are_discs(void **unused)
{
    (void)unused;
    for (int law = HERTZ_BRILLIANTOV; law <= HERTZ_MINDLIN; law++) {
        fixture plane, solid;
        fixture_create_assembly(&plane, (law_choice)law, SIDE, 2);
        create_solid(&solid, &plane, (law_choice)law);
        put_walls(&plane);
        put_walls(&solid);
        fixture_forces(&plane);
        fixture_forces(&solid);
        for (int k = 0; k < STEPS; k++) fixture_step(&plane);
        for (int k = 0; k < STEPS; k++) step_as_discs(&solid);
        compare(&plane, &solid);
        fixture_destroy(&solid);
        fixture_destroy(&plane);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spheres_in_a_plane_are_discs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
