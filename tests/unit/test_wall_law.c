/// The forces of contacts with the walls of a case: against the built-in walls, and against the closed form of law
/// hertz_brilliantov on cones and on boxes, in 2D and 3D; and what 2D refuses.
#include "run_fixture.h"
#include "state/case_walls.h"
#include "state/plates.h"
#include "wall_fixture.h"

static const double R = 1e-3;

/// One body; in 2D it keeps to the plane.
static void put(world *w, const double place[3], const double velocity[3], const double spin[3])
{
    scree_row *row = &w->f.state.row[0];
    sphere s = {.radius = R};
    memcpy(s.place, place, sizeof s.place);
    memcpy(s.velocity, velocity, sizeof s.velocity);
    memcpy(s.spin, spin, sizeof s.spin);
    if (w->f.state.dimension == 3)
        sphere_set(&w->f, 0, &s);
    else
        *row = (scree_row){.x = place[0],
                           .y = place[1],
                           .radius = R,
                           .vx = velocity[0],
                           .vy = velocity[1],
                           .spin = spin[2],
                           .mass = fixture_mass(&w->f.model, 0, R)};
    fixture_measure_speed(&w->f);
    w->f.work.valid = false;
}

// ---- against the built-in walls ----------------------------------------------------------------------------------

enum { STEPS = 400, VALUES = 18 };

/// A body is thrown at a wall that moves and drags. Row, force, and load of the wall after every step.
static void throw(int dimension, law_choice law, bool built_in, double seen[STEPS][VALUES])
{
    const bool in_3d = dimension == 3;
    const double normal[2][3] = {{0.6, 0.8, 0}, {2.0 / 7, 3.0 / 7, 6.0 / 7}}, *n = normal[in_3d];
    const double drag[3] = {0.02 * n[1], -0.02 * n[0], 0}, towards = 0.03, dt = 2e-7;
    const double velocity[3] = {-0.1, -0.2, in_3d ? -0.15 : 0}, spin[3] = {in_3d ? 50 : 0, in_3d ? -80 : 0, 300};
    double place[3];
    world w = {0};
    if (!built_in) {
        world_keys *plane = world_wall(&w, SCREE_SLOT_plane);
        for (int k = 0; k < 3; k++) {
            plane->normal[k] = 3 * n[k];
            plane->point[k] = 0.013 * n[k];
            plane->velocity[k].value = towards * n[k] + drag[k];
        }
    }
    world_start(&w, dimension, law, SCREE_SLOT_velocity_verlet, 1, dt);
    scree_case_walls(&w.f.state)->moving = !built_in;
    scree_wall *wall = &scree_plates(&w.f.state)[SCREE_WALL_BOTTOM];
    *wall = (scree_wall){.position = 0.013, .velocity = towards, .active = built_in};
    memcpy(wall->normal, n, sizeof wall->normal);
    memcpy(wall->tangential_velocity, drag, sizeof drag);
    for (int k = 0; k < 3; k++) place[k] = (0.013 + R + 1.03e-6) * n[k]; // not whole steps away
    put(&w, place, velocity, spin);
    world_begin(&w);
    for (int step = 0; step < STEPS; step++) {
        scree_vector force, torque, at, speed, turning;
        if (built_in) wall->position += dt * towards;
        world_step(&w);
        scree_body_force(&w.f.model, &w.f.state, 0, force, torque);
        scree_body_position(&w.f.state, 0, at);
        scree_body_motion(&w.f.state, 0, speed, turning);
        double *value = seen[step], on_wall[3];
        for (int k = 0; k < 3; k++)
            on_wall[k] =
                built_in ? wall->shear[k] - wall->force * n[k] : scree_case_walls(&w.f.state)->load[0].force[k];
        const double *const all[] = {force, torque, at, speed, turning, on_wall};
        for (int k = 0; k < VALUES; k++) value[k] = all[k / 3][k % 3];
    }
    const scree_ledger *ledger = &w.f.state.ledger;
    assert_true(ledger->damping > 0 && ledger->friction > 0 && ledger->plates > 0);
    assert_near(world_energy(&w, NULL).residual, 0, 1e-3 * ledger->turnover);
    world_close(&w);
}

static void planes_are_built_in_walls(void **unused)
{
    (void)unused;
    static double one[STEPS][VALUES], other[STEPS][VALUES];
    static const law_choice laws[3] = {HERTZ_BRILLIANTOV, HERTZ_MINDLIN, HERTZ_BRILLIANTOV_IMPLICIT};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int law = 0; law < 3; law++) {
            double size[VALUES / 3] = {0};
            throw(dimension, laws[law], true, one);
            throw(dimension, laws[law], false, other);
            for (int step = 0; step < STEPS; step++)
                for (int k = 0; k < VALUES; k++) size[k / 3] = fmax(size[k / 3], fabs(one[step][k]));
            assert_true(size[0] > 0.1);
            // Overlaps of 1e-6 m are differences of numbers of 1e-2 m: 1e-16 x 1e-2 / 1e-6; 400 steps, in which
            // friction that predicts the slip passes through its steepest part.
            for (int step = 0; step < STEPS; step++)
                for (int k = 0; k < VALUES; k++) assert_near(other[step][k], one[step][k], 1e-9 * size[k / 3]);
        }
}

// ---- against the closed form -------------------------------------------------------------------------------------

/// What law hertz_brilliantov gives a body whose centre is `distance` from the wall along `normal`.
static void expected_force(const world *w, const double place[3], const double velocity[3], const double spin[3],
                           const double normal[3], double distance, double force[3], double torque[3])
{
    const scree_pair_constants *pair = &w->f.model.walls[0];
    const world_keys *wall = &w->wall[0];
    const double *number = w->f.model.laws[0].number;
    const double d = R - distance, arm = R - 0.5 * d;
    double lever[3], turning[3], rolling[3], u[3], slip[3], speed = 0;
    double time = (double)scree_case_walls(&w->f.state)->ticks * w->f.state.tick;
    for (int k = 0; k < 3; k++)
        lever[k] = place[k] - arm * normal[k] - wall->centre[k] - wall->velocity[k].value * time;
    scree_cross(wall->spin, lever, turning);
    for (int k = 0; k < 3; k++) lever[k] = -arm * normal[k];
    scree_cross(spin, lever, rolling);
    for (int k = 0; k < 3; k++) u[k] = velocity[k] - wall->velocity[k].value - turning[k];
    double parting = scree_dot(u, normal), stiffness = pair->value[HERTZ_NORMAL] * sqrt(R * d);
    for (int k = 0; k < 3; k++) slip[k] = u[k] - parting * normal[k] + rolling[k];
    speed = sqrt(scree_dot(slip, slip));
    double f = fmax(stiffness * (d - number[BRILLIANTOV_TIME] * parting), 0);
    double mobilised =
        pair->value[SCREE_FRICTION] * pow(speed / number[BRILLIANTOV_VELOCITY], number[BRILLIANTOV_INVERSE_EXPONENT]);
    for (int k = 0; k < 3; k++) slip[k] *= speed > 0 ? -f * mobilised / speed : 0;
    scree_cross(lever, slip, torque);
    for (int k = 0; k < 3; k++) force[k] = f * normal[k] + slip[k];
}

/// One contact, with the force of the law, at rest and in motion; the wall gets the opposite.
static void check_contact(world *w, const double foot[3], const double normal[3])
{
    const bool in_3d = w->f.state.dimension == 3;
    const double speeds[2][3] = {{0}, {0.2, -0.1, in_3d ? 0.15 : 0}};
    const double spins[2][3] = {{0}, {in_3d ? 90 : 0, in_3d ? -60 : 0, 150}};
    for (int moves = 0; moves < 2; moves++) {
        const double distance = 0.99 * R;
        double place[3], force[3], torque[3];
        scree_vector found, turned;
        for (int k = 0; k < 3; k++) place[k] = foot[k] + distance * normal[k];
        put(w, place, speeds[moves], spins[moves]);
        w->f.state.step_size = 0; // rates are those of now
        world_forces(w);
        expected_force(w, place, speeds[moves], spins[moves], normal, distance, force, torque);
        scree_body_force(&w->f.model, &w->f.state, 0, found, turned);
        assert_int_equal(w->f.state.sum[0].contacts, 1);
        // Overlaps are differences of numbers of the size of some centimetres: 1e-16 x 2e-2 / 1e-5, and quanta.
        double size = sqrt(scree_dot(force, force));
        assert_true(size > 1);
        for (int k = 0; k < 3; k++) {
            assert_near(found[k], force[k], 1e-9 * size);
            assert_near(turned[k], torque[k], 1e-9 * size * R);
            assert_near(scree_case_walls(&w->f.state)->load[0].force[k], -force[k], 1e-9 * size);
        }
    }
}

// ---- cones -------------------------------------------------------------------------------------------------------

static const double START[3] = {0.003, -0.002, 0.001}, AXIS[3] = {2.0 / 7, 3.0 / 7, 6.0 / 7};
static const double LENGTH = 0.02;

/// From the half-plane of (along the axis, away from it) at an angle about the axis into space.
static void lift(double angle, double s, double r, double given[3])
{
    const double across[3] = {3 / sqrt(13), -2 / sqrt(13), 0};
    double third[3];
    scree_cross(AXIS, across, third);
    for (int k = 0; k < 3; k++) given[k] = s * AXIS[k] + r * (cos(angle) * across[k] + sin(angle) * third[k]);
}

/// Opens a world with a cone that spins about its axis.
static void make_cone(world *w, double radius_start, double radius_end, scree_side side, scree_ends ends)
{
    world_keys *wall = world_wall(w, SCREE_SLOT_cone);
    wall->side = (int)side;
    wall->ends = (int)ends;
    wall->radius_start = radius_start;
    wall->radius_end = radius_end;
    for (int k = 0; k < 3; k++) {
        wall->start[k] = wall->centre[k] = START[k];
        wall->end[k] = START[k] + LENGTH * AXIS[k];
        wall->spin[k] = 7 * AXIS[k];
    }
    world_start(w, 3, HERTZ_BRILLIANTOV, SCREE_SLOT_velocity_verlet, 1, 1e-7);
    scree_case_walls(&w->f.state)->moving = 1;
}

/// The closest point (s, r) of the cone and the direction from it, in the half-plane.
static void check_cone_at(world *w, double s, double r, double direction_s, double direction_r)
{
    double size = hypot(direction_s, direction_r);
    for (int k = 0; k < 3; k++) {
        double foot[3], normal[3], angle = 0.4 + 2 * k;
        lift(angle, s, r, foot);
        lift(angle, direction_s / size, direction_r / size, normal);
        for (int i = 0; i < 3; i++) foot[i] += START[i];
        check_contact(w, foot, normal);
    }
}

/// On the mantle the closest point lies across it; beyond its ends, on a rim or at an apex, in any direction between.
static void cones_touch_at_the_closest_point(void **unused)
{
    (void)unused;
    const double low = 0.004, high = 0.01, rise = high - low;
    world w = {0};
    make_cone(&w, low, high, SCREE_SIDE_INSIDE, SCREE_ENDS_CLOSED);
    check_cone_at(&w, 0.3 * LENGTH, low + 0.3 * rise, rise, -LENGTH);
    check_cone_at(&w, 0, 0.5 * low, 1, 0);
    check_cone_at(&w, LENGTH, 0.5 * high, -1, 0);
    world_close(&w);
    make_cone(&w, high, low, SCREE_SIDE_INSIDE, SCREE_ENDS_OPEN); // narrows
    check_cone_at(&w, 0.6 * LENGTH, high - 0.6 * rise, -rise, -LENGTH);
    check_cone_at(&w, 0, high, -0.6, -0.3);
    check_cone_at(&w, LENGTH, low, 1, 0.2);
    world_close(&w);
    make_cone(&w, low, high, SCREE_SIDE_OUTSIDE, SCREE_ENDS_CLOSED);
    check_cone_at(&w, 0.6 * LENGTH, low + 0.6 * rise, -rise, LENGTH);
    check_cone_at(&w, 0, 0.5 * low, -1, 0);
    check_cone_at(&w, LENGTH, 0.5 * high, 1, 0);
    check_cone_at(&w, LENGTH, high, 0.6, 0.8);
    check_cone_at(&w, 0, low, -0.8, 0.6);
    world_close(&w);
    // Flat: near the corner the rim is within reach too, but not a place where the distance is least.
    make_cone(&w, low, 10 * LENGTH, SCREE_SIDE_INSIDE, SCREE_ENDS_CLOSED);
    check_cone_at(&w, 0, low - 0.12 * R, 1, 0);
    world_close(&w);
    make_cone(&w, 0, high, SCREE_SIDE_OUTSIDE, SCREE_ENDS_CLOSED);
    check_cone_at(&w, 0.3 * LENGTH, 0.3 * high, -high, LENGTH);
    check_cone_at(&w, 0, 0, -0.8, 0.6);
    world_close(&w);
}

// ---- bounds ------------------------------------------------------------------------------------------------------

/// No point of a wall is faster than the bound that the quanta of forces and the list of neighbours rely on.
static void speeds_are_bounded(void **unused)
{
    (void)unused;
    const double centre[3] = {0.01, -0.03, 0.02}, spin[3] = {3, -4, 12}, velocity[3] = {0.02, 0.01, -0.03};
    for (int shape = SCREE_SLOT_box; shape <= SCREE_SLOT_mesh; shape++) {
        static const triangle_corners triangle[1] = {{{0.01, 0, 0.02}, {0.02, 0.05, 0}, {-0.03, 0, 0.01}}};
        world w = {0};
        world_keys *wall = shape == SCREE_SLOT_mesh ? world_mesh(&w, triangle, 1) : world_wall(&w, shape);
        for (int k = 0; k < 3; k++) {
            wall->lower[k] = wall->start[k] = -0.01 * (k + 1);
            wall->upper[k] = wall->end[k] = 0.02 * (k + 1);
        }
        wall->radius = wall->radius_end = 0.01;
        wall->radius_start = 0.03;
        memcpy(wall->centre, centre, sizeof centre);
        // Round walls are flat, and turn about their own middle: their extent is their radius.
        if (shape == SCREE_SLOT_cylinder || shape == SCREE_SLOT_cone) {
            for (int k = 0; k < 3; k++) wall->start[k] = centre[k] - 1e-5 * (k + 1);
            for (int k = 0; k < 3; k++) wall->end[k] = centre[k] + 1e-5 * (k + 1);
        }
        memcpy(wall->spin, spin, sizeof spin);
        for (int k = 0; k < 3; k++) wall->velocity[k].value = velocity[k];
        world_start(&w, 3, HERTZ_MINDLIN, SCREE_SLOT_velocity_verlet, 1, 1e-6);
        const scree_surface *surface = &w.f.work.wall_set->surface[0];
        double bound = scree_wall_set_speed(w.f.work.wall_set), fastest = 0;
        double time = 1e-4, way = scree_wall_set_way(w.f.work.wall_set, time, 0);
        scree_wall_triangles drawn;
        scree_error error;
        check(scree_wall_set_triangles(w.f.work.wall_set, wall->lower, wall->upper, &drawn, &error), &error);
        for (size_t k = 0; k < 3 * drawn.count; k++) {
            double lever[3], moved[3];
            scree_subtract(&drawn.corner[k / 3][3 * (k % 3)], surface->hub, lever);
            scree_cross(wall->spin, lever, moved);
            scree_along(velocity, 1, moved, moved);
            fastest = fmax(fastest, scree_length(moved));
        }
        assert_true(drawn.count > 0 && fastest > 0.1 && fastest <= bound && fastest * time <= way);
        // Spin times extent, where the motions add up.
        assert_true(bound < 2.5 * fastest);
        scree_wall_triangles_destroy(&drawn);
        world_close(&w);
        if (wall->file) (void)unlink(wall->file);
    }
}

/// Bodies beside a closed wall are told from those in it everywhere, beyond its corners too.
static void clearance_is_negative_outside(void **unused)
{
    (void)unused;
    const double low = 0.004, high = 0.01;
    world w = {0};
    make_cone(&w, low, high, SCREE_SIDE_INSIDE, SCREE_ENDS_CLOSED);
    int inside = 0, corner = 0;
    for (uint64_t k = 0; k < 2000; k++) {
        double s = LENGTH * (1.6 * fixture_random(3 * k) - 0.3), r = 2 * high * fixture_random(3 * k + 1);
        double place[3], mantle = (low + (high - low) * s / LENGTH - r) * LENGTH / hypot(LENGTH, high - low);
        double expected = fmin(mantle, fmin(s, LENGTH - s));
        lift(6 * fixture_random(3 * k + 2), s, r, place);
        for (int i = 0; i < 3; i++) place[i] += START[i];
        double clearance = scree_surface_clearance(w.f.work.wall_set, 0, place, R);
        assert_true((clearance < 0) == (expected < 0));
        if (expected > 0) assert_near(clearance, expected, 1e-15);
        inside += expected > 0;
        corner += mantle < 0 && (s < 0 || s > LENGTH);
    }
    assert_true(inside > 100 && corner > 100);
    world_close(&w);
}

/// A body more than its radius behind a wall with an inside has nothing to do with it; a plane has no other side.
/// The overlap on a wall of its own material and on one without, at the same place; the table says the same.
static void walls_have_their_own_material(void **unused)
{
    (void)unused;
    static char name[] = "rigid";
    for (int own = 0; own < 2; own++) {
        world w = {0};
        world_keys *plane = world_wall(&w, SCREE_SLOT_plane);
        plane->normal[1] = 1;
        plane->material = own ? name : NULL;
        world_start(&w, 2, HERTZ_MINDLIN, SCREE_SLOT_velocity_verlet, 1, 1e-7);
        w.f.model.surfaces[0][0] = w.f.model.walls[0];
        w.f.model.surfaces[0][0].value[HERTZ_NORMAL] *= 2;
        const double place[3] = {0, R - 2e-6, 0}, still[3] = {0};
        put(&w, place, still, still);
        world_forces(&w);
        const double k = w.f.model.walls[0].value[HERTZ_NORMAL] * (own ? 2 : 1);
        const double expected = k * sqrt(R) * pow(2e-6, 1.5);
        scree_vector force, torque;
        scree_body_force(&w.f.model, &w.f.state, 0, force, torque);
        // Quanta are those of an overlap at the guard's limit, of a force 1000 times as large.
        assert_near(force[1], expected, 1e-11 * expected);
        scree_energy energy = world_energy(&w, NULL);
        assert_near(energy.elastic_normal, 0.4 * expected * 2e-6, 1e-12 * expected * 2e-6);
        world_close(&w);
    }
}

static void walls_have_another_side(void **unused)
{
    (void)unused;
    for (int shape = SCREE_SLOT_plane; shape <= SCREE_SLOT_cylinder; shape++)
        for (int k = 0; k < 3; k++) {
            const double behind[3] = {-0.5 * R, 0.99 * R, 1.01 * R};
            const scree_vector place = {0.001, 0.002, 0.02 + behind[k]};
            world w = {0};
            world_keys *wall = world_wall(&w, shape);
            wall->normal[2] = -1;
            for (int i = 0; i < 3; i++) wall->lower[i] = -0.02;
            for (int i = 0; i < 3; i++) wall->upper[i] = 0.02;
            wall->point[2] = wall->end[2] = wall->radius = 0.02;
            world_start(&w, 3, HERTZ_MINDLIN, SCREE_SLOT_velocity_verlet, 1, 1e-6);
            const scree_wall_set *wall_set = w.f.work.wall_set;
            int touching = 0;
            for (size_t e = 0; e < wall_set->primitives; e++) {
                scree_closest_point closest;
                scree_primitive_closest_point(wall_set, e, place, &closest);
                touching += scree_closest_point_touches(wall_set, e, &closest, R);
            }
            assert_int_equal(touching, k < 2 || shape == SCREE_SLOT_plane);
            world_close(&w);
        }
}

/// A body that moves and turns rigidly with a wall feels its normal force alone, with resistance to rolling too; one
/// that does not turn along is resisted.
static void rigid_motion_meets_no_resistance(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int rigid = 0; rigid < 2; rigid++) {
            const double spin[3] = {dimension == 3 ? 9 : 0, dimension == 3 ? -4 : 0, 11}, still[3] = {0};
            const double place[3] = {0.004, 0.01 + 0.99 * R, dimension == 3 ? -0.003 : 0};
            double velocity[3];
            scree_vector force, torque;
            world w = {0};
            world_keys *wall = world_wall(&w, SCREE_SLOT_box);
            wall->side = SCREE_SIDE_OUTSIDE;
            for (int k = 0; k < 3; k++) wall->lower[k] = -0.01;
            for (int k = 0; k < 3; k++) wall->upper[k] = 0.01;
            memcpy(wall->spin, spin, sizeof spin);
            world_start(&w, dimension, HERTZ_MINDLIN, SCREE_SLOT_velocity_verlet, 1, 1e-7);
            sphere_resist_turning(&w.f);
            scree_case_walls(&w.f.state)->moving = 1;
            w.f.state.step_size = 0; // finite steps: test_rigid_motion.c
            scree_cross(spin, place, velocity);
            // The contact point of a body at rest moves with the wall when its centre does, with the lever between.
            double lever[3] = {0, -0.995 * R, 0}, apart[3];
            scree_cross(spin, lever, apart);
            for (int k = 0; k < 3 && !rigid; k++) velocity[k] += apart[k];
            put(&w, place, velocity, rigid ? spin : still);
            world_forces(&w);
            scree_body_force(&w.f.model, &w.f.state, 0, force, torque);
            double normal = force[1], turning = sqrt(scree_dot(torque, torque)) / (normal * R);
            assert_true(normal > 1 && fabs(force[0]) + fabs(force[2]) < 1e-9 * normal);
            // Round-off of velocities of 0.1 m/s over the dashpot's part of the force.
            assert_true(rigid ? turning < 1e-9 : turning > 1e-6);
            world_close(&w);
        }
}

// ---- two dimensions ----------------------------------------------------------------------------------------------

static const double H = 0.01;

static void make_square(world *w, scree_side side)
{
    world_keys *wall = world_wall(w, SCREE_SLOT_box);
    wall->side = (int)side;
    for (int k = 0; k < 2; k++) {
        wall->lower[k] = -H;
        wall->upper[k] = H;
    }
    wall->centre[0] = 0.002;
    wall->spin[2] = 11;
    wall->velocity[1].value = 0.07;
    world_start(w, 2, HERTZ_BRILLIANTOV, SCREE_SLOT_velocity_verlet, 1, 1e-3);
    scree_case_walls(&w->f.state)->moving = 1;
}

/// A point of the square and the direction from it, given in its own frame.
static void check_square_at(world *w, double x, double y, double direction_x, double direction_y)
{
    double time = (double)scree_case_walls(&w->f.state)->ticks * w->f.state.tick,
           size = hypot(direction_x, direction_y);
    double cosine = cos(11 * time), sine = sin(11 * time), lever = x - 0.002;
    const double foot[3] = {0.002 + cosine * lever - sine * y, 0.07 * time + sine * lever + cosine * y, 0};
    const double normal[3] = {(cosine * direction_x - sine * direction_y) / size,
                              (sine * direction_x + cosine * direction_y) / size, 0};
    check_contact(w, foot, normal);
}

/// Discs on the sides and corners of a square, and in it, before and after it has moved and turned.
static void squares_touch_discs(void **unused)
{
    (void)unused;
    world w = {0};
    make_square(&w, SCREE_SIDE_OUTSIDE);
    for (int turned = 0; turned < 2; turned++) {
        scree_case_walls(&w.f.state)->ticks = turned ? 50 : 0;
        check_square_at(&w, 0.3 * H, H, 0, 1);
        check_square_at(&w, 0.3 * H, -H, 0, -1);
        check_square_at(&w, -H, 0.1 * H, -1, 0);
        check_square_at(&w, H, -0.9 * H, 1, 0);
        check_square_at(&w, H, H, 0.6, 0.8);
        check_square_at(&w, -H, H, -1, 0.01);
    }
    world_close(&w);
    make_square(&w, SCREE_SIDE_INSIDE);
    for (int turned = 0; turned < 2; turned++) {
        scree_case_walls(&w.f.state)->ticks = turned ? 50 : 0;
        check_square_at(&w, 0.3 * H, H, 0, -1);
        check_square_at(&w, -H, 0.1 * H, 1, 0);
    }
    // In a corner both sides push.
    const double corner[3] = {0.99 * R - H, 0.99 * R - H, 0}, still[3] = {0};
    scree_case_walls(&w.f.state)->ticks = 0;
    put(&w, corner, still, still);
    world_forces(&w);
    assert_int_equal(w.f.state.sum[0].contacts, 2);
    world_close(&w);
}

/// A disc rolls down a plane with 2/3 g sin(a).
static void discs_roll(void **unused)
{
    (void)unused;
    for (int law = HERTZ_BRILLIANTOV; law <= HERTZ_MINDLIN; law++) {
        const double gravity = 10, angle = 0.3, still[3] = {0};
        const int steps = 20000;
        world w = {0};
        world_wall(&w, SCREE_SLOT_plane)->normal[1] = 1;
        world_start(&w, 2, (law_choice)law, SCREE_SLOT_velocity_verlet, 1, 2e-6);
        w.f.model.gravity[0] = gravity * sin(angle);
        w.f.model.gravity[1] = -gravity * cos(angle);
        const double place[3] = {0, R - world_rest(&w, R, gravity * cos(angle)), 0};
        put(&w, place, still, still);
        world_begin(&w);
        world_run(&w, steps);
        double time = steps * 2e-6, expected = 2.0 / 3 * gravity * sin(angle) * time;
        // The lever is shorter by half the overlap, 1e-3 of the radius; the spring takes a few hundred steps.
        assert_near(w.f.state.row[0].vx, expected, 2e-3 * expected);
        assert_near(-w.f.state.row[0].spin * R, expected, 3e-3 * expected);
        scree_energy energy = world_energy(&w, NULL);
        // The trapezoid along the force law: third order in the step.
        assert_near(energy.residual, 0, 1e-9 * energy.kinetic);
        world_close(&w);
    }
}

static void refuse(const char *wall, const char *message)
{
    static const char before[] = "scree: 1\n"
                                 "materials:\n"
                                 "  - {name: quartz, young_modulus: 30 GPa, poisson_ratio: 0.3, density: 2650 kg/m3}\n"
                                 "particles: {material: quartz, count: 10, radius: 1 mm}\n"
                                 "stages:\n"
                                 "  - {stage: prepare, method: gas}\n"
                                 "walls:\n";
    char text[1024];
    scree_case *c = NULL;
    scree_problems *problems = NULL;
    (void)snprintf(text, sizeof text, "%s  - {%s}\n", before, wall);
    assert_int_equal(case_parse(text, NULL, 0, &c, &problems), SCREE_ERROR_INPUT);
    for (size_t k = 0; k < scree_problems_count(problems); k++)
        if (strstr(scree_problems_get(problems, k)->message, message)) {
            scree_problems_free(problems);
            return;
        }
    fail_msg("%s: expected \"%s\", got \"%s\"", wall, message, scree_problems_get(problems, 0)->message);
}

static void what_has_no_place_in_a_plane_is_refused(void **unused)
{
    (void)unused;
    refuse("shape: cylinder, start: [0, 0], end: [0, 10 mm], radius: 5 mm", "no walls of this shape in two dimensions");
    refuse("shape: cone, start: [0, 0], end: [0, 10 mm], radius_start: 5 mm, radius_end: 1 mm",
           "no walls of this shape");
    refuse("shape: mesh, file: none.stl", "no walls of this shape");
    refuse("shape: plane, normal: [0, 1, 1], point: [0, 0, 0]", "there is no z in two dimensions");
    refuse("shape: box, lower: [0, 0], upper: [1 cm, 1 cm], spin: [1 rad/s, 0, 0]", "turns about z only");
    refuse("shape: box, lower: [0, 0], upper: [1 cm, 1 cm], velocity: [0, 0, 1 m/s]", "there is no z");
    refuse("shape: plane, normal: [0, 1, 0], point: [0, 0, 0], spin: [0, 0, 1 rad/s]", "cannot turn");
    refuse("shape: plane, normal: [0, 0, 0], point: [0, 0, 0]", "a normal needs a length");
    refuse("shape: box, lower: [0, 0], upper: [1 cm, 0]", "must be larger");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_are_built_in_walls),
        cmocka_unit_test(cones_touch_at_the_closest_point),
        cmocka_unit_test(speeds_are_bounded),
        cmocka_unit_test(clearance_is_negative_outside),
        cmocka_unit_test(walls_have_another_side),
        cmocka_unit_test(walls_have_their_own_material),
        cmocka_unit_test(rigid_motion_meets_no_resistance),
        cmocka_unit_test(squares_touch_discs),
        cmocka_unit_test(discs_roll),
        cmocka_unit_test(what_has_no_place_in_a_plane_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
