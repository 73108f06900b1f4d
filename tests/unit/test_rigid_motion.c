/// Motions that must leave springs as they are or stretch them by a known amount, taken along a whole turn in finite
/// steps: pairs of unequal radii that turn rigidly about an axis neither along nor across the normal, that close at the
/// same time, roll on each other and twist; in 2D and 3D, and on a plate. What is left over falls with the square of
/// the step.
///
/// Motion is prescribed: positions at n, velocities and spins at n - 1/2 (x(n) = x(n-1) + v(n-1/2) dt), as the schemes
/// have them.
#include "state/case_walls.h"
#include "state/plates.h"
#include "wall_fixture.h"

static const double PI2 = 2 * M_PI;
static const double R1 = 1e-3, R2 = 1.3e-3, RATE = 1000;                          // rad/s
static const double AXIS[2][3] = {{0, 0, 1}, {2.0 / 7, 6.0 / 7, 3.0 / 7}};        // of the turn, 2D and 3D
static const double NORMAL[2][3] = {{0.6, 0.8, 0}, {6.0 / 7, 3.0 / 7, -2.0 / 7}}; // at the begin
static const double SPRING[2][3] = {{3e-6, 0, 0}, {2e-6, -6e-6, -3e-6}};          // normal to it; 2D along t

/// What happens in the turning frame, besides closing from an overlap of 2 to 20 um.
typedef struct inner_motion {
    double roll;  ///< m/s, velocity at which both surfaces pass the contact without slip
    double twist; ///< rad/s
} inner_motion;

/// `v` turned by `angle` about the unit vector `axis`.
static void turn(const double axis[3], double angle, const double v[3], double turned[3])
{
    double part[3], c = cos(angle), s = sin(angle), along = 0;
    for (int k = 0; k < 3; k++) along += axis[k] * v[k];
    for (int k = 0; k < 3; k++) part[k] = axis[(k + 1) % 3] * v[(k + 2) % 3] - axis[(k + 2) % 3] * v[(k + 1) % 3];
    for (int k = 0; k < 3; k++) turned[k] = v[k] * c + part[k] * s + axis[k] * along * (1 - c);
}

static void create_pair(fixture *f, int dimension, law_choice law, double dt)
{
    fixture_create_in(f, dimension, law, 2, dt);
    sphere_resist_turning(f);
    f->model.pairs[0][0].value[SCREE_FRICTION] = f->model.pairs[0][0].value[HERTZ_ROLLING] = 1e6; // no cap
    f->model.pairs[0][0].value[HERTZ_TWISTING] = 1e6;
    f->state.row[0].radius = R1;
    f->state.row[1].radius = R2;
    for (int k = 0; k < 2; k++) f->state.row[k].mass = fixture_mass(&f->model, 0, f->state.row[k].radius);
    f->state.row[0].x = R1 + R2; // in reach of each other
    fixture_find_pairs(f, 1e-3);
    f->state.largest_overlap = 2e-6;
}

/// Where the first body is from the second at `time`, and the spins of both.
static void place_at(int dimension, double time, double duration, const inner_motion *inner, double apart[3],
                     double spin[2][3])
{
    const int solid = dimension - 2;
    const double d = 2e-6 + 18e-6 * time / duration, arms[2] = {R1 - d / 2, R2 - d / 2};
    double n[3], across[3], local[3];
    turn(AXIS[solid], RATE * time, NORMAL[solid], n);
    for (int k = 0; k < 3; k++) apart[k] = (R1 + R2 - d) * n[k];
    turn(AXIS[solid], RATE * time, SPRING[solid], across);
    double length = sqrt(across[0] * across[0] + across[1] * across[1] + across[2] * across[2]);
    for (int body = 0; body < 2; body++) {
        const double sign = body ? -1 : 1;
        for (int k = 0; k < 3; k++)
            local[k] =
                sign * ((solid ? across[k] / length : k == 2) * inner->roll / arms[body] + inner->twist * n[k] / 2);
        for (int k = 0; k < 3; k++) spin[body][k] = RATE * AXIS[solid][k] + (solid || k == 2 ? local[k] : 0);
    }
}

/// Moves the pair to its place at the end of step n.
static void set_step(fixture *f, int n, int steps, const inner_motion *inner)
{
    const int dimension = f->state.dimension;
    const double dt = f->state.step_size, duration = steps * dt;
    double before[3], apart[3], middle[3], spin[2][3], unused[2][3];
    place_at(dimension, (n - 1) * dt, duration, inner, before, unused);
    place_at(dimension, n * dt, duration, inner, apart, unused);
    place_at(dimension, (n - 0.5) * dt, duration, inner, middle, spin);
    scree_row *row = f->state.row;
    row[0].x = apart[0], row[0].y = apart[1];
    row[0].vx = (apart[0] - before[0]) / dt;
    row[0].vy = (apart[1] - before[1]) / dt;
    row[1].x = row[1].y = 0;
    if (dimension == 2) {
        row[0].spin = spin[0][2], row[1].spin = spin[1][2];
    } else {
        row[0].z = apart[2];
        row[0].vz = (apart[2] - before[2]) / dt;
        for (int k = 0; k < 2; k++) f->state.turn[k] = (scree_turn_row){spin[k][0], spin[k][1], spin[k][2], 0};
    }
    fixture_measure_speed(f);
}

static double distance(const double a[], const double b[], int count)
{
    double sum = 0;
    for (int k = 0; k < count; k++) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sqrt(sum);
}

/// What a turn of `steps` steps leaves over: of the slip's spring, the rolling one, the twist, each over what it would
/// be after a turn's way, and the torque on the second body over that of the normal force.
typedef struct leftover {
    double slip, roll, twist, torque;
} leftover;

static leftover turn_once(int dimension, int steps, const inner_motion *inner, const double spring[3])
{
    fixture f;
    const int solid = dimension - 2, count = solid ? 3 : 1;
    const double dt = PI2 / RATE / steps, reduced = R1 * R2 / (R1 + R2);
    double rolled = 0, expected[3], torque = 0;
    leftover left = {0};
    create_pair(&f, dimension, HERTZ_MINDLIN, dt);
    memcpy(f.work.pairs.history[0].value, spring, 3 * sizeof *spring);
    for (int n = 1; n <= steps; n++) {
        set_step(&f, n, steps, inner);
        fixture_forces(&f);
        const double d = 2e-6 + 18e-6 * (n - 0.5) / steps;
        rolled += dt * reduced * inner->roll * (1 / (R1 - d / 2) + 1 / (R2 - d / 2));
        double force[3], turning[3];
        if (solid)
            sphere_force(&f, 1, force, turning);
        else
            fixture_force(&f, 1, force), turning[0] = turning[1] = 0, turning[2] = force[2];
        double size = sqrt(force[0] * force[0] + force[1] * force[1] + (solid ? force[2] * force[2] : 0));
        torque = fmax(torque, sqrt(turning[0] * turning[0] + turning[1] * turning[1] + turning[2] * turning[2]) / size);
    }
    assert_int_equal(f.work.flags, 0);
    const double way = PI2 * (R1 + R2);
    left.slip = distance(f.work.pairs.history[0].value, spring, count) / way;
    // Rolling goes along (the direction of the spring) x n, in 2D along t.
    const double *n = NORMAL[1], *h = SPRING[1];
    for (int k = 0; k < 3; k++)
        expected[k] =
            solid ? rolled * (h[(k + 1) % 3] * n[(k + 2) % 3] - h[(k + 2) % 3] * n[(k + 1) % 3]) / 7e-6 : rolled;
    left.roll = distance(f.work.pairs.rolling[0].value, expected, count) / way;
    left.twist = solid ? fabs(f.work.pairs.rolling[0].value[3] - inner->twist * steps * dt) / PI2 : 0;
    left.torque = torque / R2;
    fixture_destroy(&f);
    return left;
}

/// Twice the steps leave a quarter, within the next order, or nothing but round-off.
static void assert_second_order(const char *what, double coarse, double fine, double most)
{
    if (!(fine <= most)) fail_msg("%s: %g is left over, wanted below %g", what, fine, most);
    double order = log2(coarse / fine); // the next order is smaller by the angle of a step, 6e-3
    if (fine > 1e-12 && !(fabs(order - 2) < 0.05)) fail_msg("%s: order %.3f (%g, then %g)", what, order, coarse, fine);
}

/// Largest slip that the contact table shows during a turn [m/s].
static double largest_slip(int dimension, law_choice law, int steps)
{
    static const inner_motion quiet = {0, 0};
    fixture f;
    scree_error error;
    scree_contact_table table = {0};
    double largest = 0;
    create_pair(&f, dimension, law, PI2 / RATE / steps);
    for (int n = 1; n <= steps; n++) {
        set_step(&f, n, steps, &quiet);
        fixture_forces(&f);
        assert_int_equal(scree_contact_table_build(&f.model, &f.state, &f.work, &table, &error), SCREE_OK);
        assert_int_equal(table.count, 1);
        largest = fmax(largest, fabs(table.contact[0].slip));
    }
    scree_contact_table_destroy(&table);
    fixture_destroy(&f);
    return largest;
}

/// Viscous friction and dashpots follow the same rate: it is what the table shows.
static void the_slip_of_a_rigid_turn_is_of_second_order(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int law = HERTZ_BRILLIANTOV; law <= HERTZ_MINDLIN; law++) {
            double coarse = largest_slip(dimension, (law_choice)law, 500);
            double fine = largest_slip(dimension, (law_choice)law, 1000), way = RATE * (R1 + R2);
            assert_second_order("slip of the table", coarse / way, fine / way, PI2 * PI2 / 1000 / 1000);
        }
}

/// A body presses itself ever deeper into a moving plate while it rolls on it: v = a w with the present lever arm.
static double roll_on_plate(int dimension, int steps)
{
    fixture f;
    const double dt = 1e-3 / steps, spin = 400;
    double expected[3] = {0};
    fixture_create_in(&f, dimension, HERTZ_MINDLIN, 1, dt);
    f.model.walls[0].value[SCREE_FRICTION] = 1e6;
    scree_plates(&f.state)[SCREE_WALL_BOTTOM] =
        (scree_wall){.normal = {0, 1, 0}, .tangential_velocity = {0.2, 0, 0}, .active = 1};
    fixture_find_walls(&f);
    scree_row *row = f.state.row;
    for (int n = 1; n <= steps; n++) {
        const double middle = 2e-6 + 100e-6 * (n - 0.5) / steps;
        row->y = R1 - 2e-6 - 100e-6 * n / steps;
        row->vy = -100e-6 / steps / dt;
        row->vx = 0.2 + spin * (R1 - middle / 2);
        if (dimension == 2) row->spin = -spin;
        if (dimension == 3) f.state.turn[0].wz = -spin;
        f.state.largest_overlap = middle;
        fixture_measure_speed(&f);
        fixture_forces(&f);
    }
    assert_int_equal(f.work.flags, 0);
    double left = distance(f.work.wall_pairs.history[0].value, expected, dimension == 3 ? 3 : 1);
    fixture_destroy(&f);
    return left / (spin * R1 * 1e-3);
}

/// Nothing is left over there but the rounding of 1000 slips of 1e-16 of their velocities.
static void rolling_on_a_plate_does_not_slip(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) assert_true(roll_on_plate(dimension, 1000) < 1e-12);
}

/// Against what moves a body is carried, and what it does there.
typedef struct carried {
    int dimension;
    bool inside; ///< of a cylinder that turns about another axis, else on a side of a turning box
} carried;

/// Position of the body in the frame of the wall at `time` of `duration`, with its normal: it presses itself deeper
/// into the side of a box of 1 cm while it stays where it is on it, or rolls round the inside of a cylinder of 2 cm
/// about y, going along it.
static void place_inside(const carried *c, double time, double duration, double place[3], double normal[3])
{
    const double d = 2e-6 + 18e-6 * time / duration, angle = PI2 * time / duration;
    if (!c->inside) {
        const double at[3] = {0.004, 0.01 + R1 - d, c->dimension == 3 ? -0.003 : 0}, up[3] = {0, 1, 0};
        memcpy(place, at, sizeof at);
        memcpy(normal, up, sizeof up);
        return;
    }
    const double away = 0.02 - R1 + d;
    normal[0] = -cos(angle), normal[1] = 0, normal[2] = -sin(angle);
    for (int k = 0; k < 3; k++) place[k] = -away * normal[k];
    place[1] = 0.03 * time / duration;
}

/// Spin in that frame: 500 rad/s about the normal in space, and what rolls without slip.
static void spin_inside(const carried *c, double time, double duration, double spin[3])
{
    const double dt = 1e-4 * duration, d = 2e-6 + 18e-6 * time / duration;
    double before[3], after[3], normal[3], unused[3], velocity[3], rolling[3];
    place_inside(c, time - dt, duration, before, unused);
    place_inside(c, time + dt, duration, after, unused);
    place_inside(c, time, duration, unused, normal);
    for (int k = 0; k < 3; k++) velocity[k] = (after[k] - before[k]) / (2 * dt);
    scree_cross(normal, velocity, rolling);
    for (int k = 0; k < 3; k++) spin[k] = rolling[k] / (R1 - d / 2) + (c->dimension == 3 ? 500 * normal[k] : 0);
}

/// From the frame of the wall at `time` into space; `at` is turned with it, and moved when it is a position.
static void leave(const world_keys *wall, double time, bool position, const double at[3], double out[3])
{
    double rate = scree_length(wall->spin), axis[3], lever[3];
    for (int k = 0; k < 3; k++) axis[k] = wall->spin[k] / rate;
    for (int k = 0; k < 3; k++) lever[k] = at[k] - (position ? wall->centre[k] : 0);
    turn(axis, rate * time, lever, out);
    for (int k = 0; k < 3 && position; k++) out[k] += wall->centre[k] + wall->velocity[k].value * time;
}

static void put_body(world *w, const double place[3], const double velocity[3], const double spin[3])
{
    sphere s = {.radius = R1};
    memcpy(s.place, place, sizeof s.place);
    memcpy(s.velocity, velocity, sizeof s.velocity);
    memcpy(s.spin, spin, sizeof s.spin);
    if (w->f.state.dimension == 3)
        sphere_set(&w->f, 0, &s);
    else
        w->f.state.row[0] = (scree_row){.x = place[0],
                                        .y = place[1],
                                        .radius = R1,
                                        .vx = velocity[0],
                                        .vy = velocity[1],
                                        .spin = spin[2],
                                        .mass = fixture_mass(&w->f.model, 0, R1)};
    fixture_measure_speed(&w->f);
    w->f.work.valid = false;
}

static world_keys *make_wall(world *w, const carried *c)
{
    world_keys *wall = world_wall(w, c->inside ? SCREE_SLOT_cylinder : SCREE_SLOT_box);
    wall->side = c->inside ? SCREE_SIDE_INSIDE : SCREE_SIDE_OUTSIDE;
    wall->ends = SCREE_ENDS_OPEN;
    wall->radius = 0.02;
    wall->start[1] = -0.1, wall->end[1] = 0.1;
    for (int k = 0; k < c->dimension; k++) wall->lower[k] = -0.01, wall->upper[k] = 0.01;
    const double spin[3] = {90, -40, 110}, velocity[3] = {0.1, 0.3, -0.2}, centre[3] = {0.002, -0.001, 0.003};
    for (int k = 0; k < 3; k++) {
        wall->spin[k] = c->dimension == 3 || k == 2 ? spin[k] : 0;
        wall->velocity[k].value = k < c->dimension ? velocity[k] : 0;
        wall->centre[k] = k < c->dimension ? centre[k] : 0;
    }
    return wall;
}

/// What springs and slip have come to after `steps` steps of a body that never slips, over the way that it was carried.
static double carry(const carried *c, int steps)
{
    const double duration = 0.05, dt = duration / steps;
    world w = {0};
    world_keys *wall = make_wall(&w, c);
    world_start(&w, c->dimension, HERTZ_MINDLIN, SCREE_SLOT_position_verlet, 1, dt);
    scree_case_walls(&w.f.state)->moving = 1;
    w.f.model.walls[0].value[SCREE_FRICTION] = 1e6; // no cap
    double largest = 0;
    for (int n = 1; n <= steps; n++) {
        double at[3], normal[3], before[3], now[3], velocity[3], inner[3], spin[3];
        place_inside(c, (n - 1) * dt, duration, at, normal);
        leave(wall, (n - 1) * dt, true, at, before);
        place_inside(c, n * dt, duration, at, normal);
        leave(wall, n * dt, true, at, now);
        for (int k = 0; k < 3; k++) velocity[k] = (now[k] - before[k]) / dt;
        spin_inside(c, (n - 0.5) * dt, duration, inner);
        leave(wall, (n - 0.5) * dt, false, inner, spin);
        for (int k = 0; k < 3; k++) spin[k] += wall->spin[k];
        put_body(&w, now, velocity, spin);
        scree_case_walls(&w.f.state)->ticks = (uint64_t)n;
        world_forces(&w);
        assert_int_equal(w.f.state.sum[0].contacts, 1);
        for (size_t p = 0; p < w.f.work.primitive_pairs.count; p++) {
            const double *h = w.f.work.primitive_pairs.history[p].value;
            largest = fmax(largest, c->dimension == 3 ? scree_length(h) : fabs(h[0]));
        }
    }
    world_close(&w);
    return largest / (0.01 * 150 * duration);
}

/// Boxes that turn about a generic axis (in 2D about z), and a cylinder that does, with a body that winds round inside.
static void turning_and_curved_walls_stretch_no_spring(void **unused)
{
    (void)unused;
    static const carried courses[] = {{2, false}, {3, false}, {3, true}};
    for (int k = 0; k < 3; k++) {
        double coarse = carry(&courses[k], 1000), fine = carry(&courses[k], 2000);
        assert_second_order("spring on a wall", coarse, fine, PI2 * PI2 / 2000 / 2000);
    }
}

static void springs_stay_as_they_are_to_second_order(void **unused)
{
    (void)unused;
    static const inner_motion motions[] = {{0, 0}, {0.3, 0}, {0, 700}, {-0.2, 400}};
    static const double none[3] = {0};
    const double most = PI2 * PI2 / 2000 / 2000;
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int k = 0; k < 4; k++) {
            const inner_motion *inner = &motions[k];
            leftover coarse = turn_once(dimension, 1000, inner, SPRING[dimension - 2]);
            leftover fine = turn_once(dimension, 2000, inner, SPRING[dimension - 2]);
            // The chord of a step of angle a, seen from its end, is sin(a) / a of the arc: a^2 / 6; other terms add to
            // it.
            assert_second_order("slip", coarse.slip, fine.slip, most);
            assert_second_order("rolling", coarse.roll, fine.roll, most);
            assert_second_order("twisting", coarse.twist, fine.twist, most);
            if (k) continue;
            // Neither springs nor dashpots turn a body.
            coarse = turn_once(dimension, 1000, inner, none);
            fine = turn_once(dimension, 2000, inner, none);
            assert_second_order("torque over that of the normal force", coarse.torque, fine.torque, 0.01);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(springs_stay_as_they_are_to_second_order),
        cmocka_unit_test(the_slip_of_a_rigid_turn_is_of_second_order),
        cmocka_unit_test(rolling_on_a_plate_does_not_slip),
        cmocka_unit_test(turning_and_curved_walls_stretch_no_spring),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
