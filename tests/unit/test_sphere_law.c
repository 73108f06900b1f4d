/// The contact laws on spheres against closed forms, and their symmetries.
///
/// Tolerances: ROUND_OFF is that of forces in quanta, 2^-51 of the bound of the step, which in these tests is at most
/// 2^8 times the force itself, and a few roundings of 2^-53 (the overlap, a difference of lengths a thousand times
/// as large, is computed here in the same way). Others say where they come from.
#include "sphere_fixture.h"
#include "state/plates.h"

#include "theory/restitution.h"

#define ROUND_OFF 1e-12

static const double direction[3] = {2.0 / 7, -3.0 / 7, 6.0 / 7}; // of the contact, from second to first

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static void assert_vector(const double value[3], const double expected[3], double tolerance)
{
    double scale = sqrt(dot(expected, expected));
    for (int k = 0; k < 3; k++)
        if (!(fabs(value[k] - expected[k]) <= tolerance * scale))
            fail_msg("component %d: %.17g is not %.17g within %g", k, value[k], expected[k], tolerance * scale);
}

/// Two spheres of 1 and 1.3 mm that touch along `direction` with overlap d.
static void create_pair(fixture *f, law_choice law, double d)
{
    fixture_create_in(f, 3, law, 2, 1e-7);
    sphere first = {.radius = 1e-3}, second = {.radius = 1.3e-3};
    for (int k = 0; k < 3; k++) first.place[k] = 0.01 * (k + 1);
    for (int k = 0; k < 3; k++) second.place[k] = first.place[k] - (2.3e-3 - d) * direction[k];
    sphere_set(f, 0, &first);
    sphere_set(f, 1, &second);
    f->state.largest_overlap = d;
    fixture_find_pairs(f, 1e-4);
}

static void set_motion(fixture *f, size_t k, const double velocity[3], const double spin[3])
{
    scree_row *row = &f->state.row[k];
    row->vx = velocity[0], row->vy = velocity[1], row->vz = velocity[2];
    f->state.turn[k].wx = spin[0], f->state.turn[k].wy = spin[1], f->state.turn[k].wz = spin[2];
    fixture_measure_speed(f);
}

/// Lets the first sphere slip by `slip` at a constant overlap: it came along the chord of an arc.
static void set_slip(fixture *f, const double slip[3])
{
    double velocity[3], spin[3] = {0},
                        rise = 0.5 * dot(slip, slip) * f->state.step_size / (2.3e-3 + fixture_gap(f, 0, 1));
    for (int k = 0; k < 3; k++) velocity[k] = slip[k] + rise * direction[k];
    set_motion(f, 0, velocity, spin);
}

static const double none[3] = {0};

/// Overlap as the state has it, contact radius and dashpot of the pair of first materials.
typedef struct geometry {
    double d, radius, eta;
} geometry;

static geometry geometry_of(const fixture *f)
{
    geometry g = {.d = -fixture_gap(f, 0, 1)};
    double m1 = f->state.row[0].mass, m2 = f->state.row[1].mass;
    g.radius = sqrt(1e-3 * 1.3e-3 / 2.3e-3 * g.d);
    g.eta = 0.3 * sqrt(m1 * m2 / (m1 + m2) * 4e9 * g.radius);
    return g;
}

static void normal_force_is_hertz(void **unused)
{
    (void)unused;
    for (int law = HERTZ_BRILLIANTOV; law <= HERTZ_MINDLIN; law++) {
        fixture f;
        double force[3], torque[3], expected[3];
        create_pair(&f, (law_choice)law, 2e-6);
        fixture_forces(&f);
        sphere_force(&f, 0, force, torque);
        geometry g = geometry_of(&f);
        for (int k = 0; k < 3; k++) expected[k] = 4e9 * g.radius * g.d * direction[k];
        // the direction is that of positions rounded to 1e-18 m over 2.3e-3 m, the overlap its length to 1e-12
        assert_vector(force, expected, 1e-11);
        assert_true(torque[0] == 0 && torque[1] == 0 && torque[2] == 0);
        assert_int_equal(f.state.sum[0].contacts, 1);
        fixture_destroy(&f);
    }
}

/// A slip s along a tangent: f_t = -(k_t n s dt + eta s), torque -a n x f_t on both spheres.
static void tangential_spring_is_mindlin(void **unused)
{
    (void)unused;
    fixture f;
    double force[3], torque[3], slip[3], expected[3], turning[3];
    const double axis[3] = {3.0 / 7, 6.0 / 7, 2.0 / 7}; // normal to `direction`
    create_pair(&f, HERTZ_MINDLIN, 2e-6);
    for (int k = 0; k < 3; k++) slip[k] = 1e-2 * axis[k];
    set_slip(&f, slip);
    geometry g = geometry_of(&f);
    for (int n = 1; n <= 3; n++) {
        fixture_forces(&f);
        for (int body = 0; body < 2; body++) {
            double sign = body ? -1 : 1, arm = (body ? 1.3e-3 : 1e-3) - g.d / 2;
            sphere_force(&f, (size_t)body, force, torque);
            for (int k = 0; k < 3; k++)
                expected[k] =
                    sign * (4e9 * g.radius * g.d * direction[k] - (5e9 * g.radius * n * 1e-7 + g.eta) * slip[k]);
            assert_vector(force, expected, 1e-11);
            cross(direction, slip, turning);
            for (int k = 0; k < 3; k++) turning[k] *= arm * (5e9 * g.radius * n * 1e-7 + g.eta);
            assert_vector(torque, turning, 1e-11);
        }
    }
    fixture_destroy(&f);
}

/// In whatever direction it slides, the force is mu f_n against the slip and the spring is at the cap.
static void friction_is_capped(void **unused)
{
    (void)unused;
    for (int law = HERTZ_BRILLIANTOV; law <= HERTZ_MINDLIN; law++) {
        fixture f;
        double force[3], torque[3], velocity[3] = {0.06, 0.12, 0.04}, expected[3];
        create_pair(&f, (law_choice)law, 2e-6);
        law_numbers(&f.model, 2e-6, INFINITY);
        set_slip(&f, velocity);
        for (int n = 0; n < 200; n++) fixture_forces(&f);
        sphere_force(&f, 0, force, torque);
        geometry g = geometry_of(&f);
        double normal = 4e9 * g.radius * g.d; // the slip is normal to the direction
        for (int k = 0; k < 3; k++) expected[k] = normal * (direction[k] - 0.5 * velocity[k] / 0.14);
        assert_vector(force, expected, 1e-11);
        const double *h = f.work.pairs.history[0].value;
        if (law == HERTZ_MINDLIN) assert_true(fabs(5e9 * g.radius * sqrt(dot(h, h)) - 0.5 * normal) < 1e-11 * normal);
        fixture_destroy(&f);
    }
}

/// Spheres that roll on each other about any axis, and a pair that turns rigidly, do not slip: no torque arises.
static void rolling_and_rigid_rotation_do_not_slip(void **unused)
{
    (void)unused;
    fixture f;
    double force[3], torque[3], velocity[3], relative[3];
    const double first[3] = {31, -52, 17}, rigid[3] = {120, 45, -80};
    double second[3];
    create_pair(&f, HERTZ_MINDLIN, 2e-6);
    f.state.step_size = 0; // finite steps: test_rigid_motion.c
    geometry g = geometry_of(&f);
    // rolling: a1 w1 = -a2 w2
    for (int k = 0; k < 3; k++) second[k] = -first[k] * (1e-3 - g.d / 2) / (1.3e-3 - g.d / 2);
    set_motion(&f, 0, none, first);
    set_motion(&f, 1, none, second);
    fixture_forces(&f);
    sphere_force(&f, 0, force, torque);
    double lateral = sqrt(dot(torque, torque)) / 1e-3;
    // a slip of 1e-17 m/s of velocities of 0.05 m/s
    assert_true(lateral < 1e-12 * g.eta * 0.05 + 4 * f.state.torque_quantum / 1e-3);

    for (int k = 0; k < 3; k++) relative[k] = (2.3e-3 - g.d) * direction[k];
    cross(rigid, relative, velocity);
    set_motion(&f, 0, velocity, rigid);
    set_motion(&f, 1, none, rigid);
    fixture_forces(&f);
    sphere_force(&f, 0, force, torque);
    assert_true(sqrt(dot(torque, torque)) / 1e-3 < 1e-12 * g.eta * 0.3 + 4 * f.state.torque_quantum / 1e-3);
    fixture_destroy(&f);
}

/// `v` turned by `angle` about the unit vector `axis`.
static void rotate(const double axis[3], double angle, const double v[3], double turned[3])
{
    double part[3], c = cos(angle);
    cross(axis, v, part);
    for (int k = 0; k < 3; k++) turned[k] = v[k] * c + part[k] * sin(angle) + axis[k] * dot(axis, v) * (1 - c);
}

/// A pair turns rigidly by one radian about `axis` in `steps` steps; its spring, free of the cap, turns with it.
static void turn_pair(const double axis[3], int steps)
{
    fixture f;
    create_pair(&f, HERTZ_MINDLIN, 2e-6);
    f.model.pairs[0][0].value[SCREE_FRICTION] = 1e6;
    const double rate = 1000, dt = 1 / rate / steps, h[3] = {3e-6, 6e-6, 2e-6};
    double spin[3], expected[3];
    scree_vector start, centre;
    f.state.step_size = dt;
    memcpy(f.work.pairs.history[0].value, h, sizeof h);
    scree_body_position(&f.state, 0, start);
    scree_body_position(&f.state, 1, centre);
    for (int k = 0; k < 3; k++) start[k] -= centre[k], spin[k] = rate * axis[k];
    for (int n = 1; n <= steps; n++) {
        double now[3];
        scree_row *row = &f.state.row[0];
        rotate(axis, (double)n / steps, start, now);
        for (int k = 0; k < 3; k++) now[k] += centre[k];
        const double velocity[3] = {(now[0] - row->x) / dt, (now[1] - row->y) / dt, (now[2] - row->z) / dt};
        row->x = now[0], row->y = now[1], row->z = now[2];
        set_motion(&f, 0, velocity, spin);
        set_motion(&f, 1, none, spin);
        fixture_forces(&f);
    }
    rotate(axis, 1, h, expected);
    // The chord of a step is shorter than its arc, and not tangent to its end: a slip of L / (6 steps^2) over all, here
    // 2e-3 mm / steps^2 against a spring of 7e-6 m; the projection misses half a step squared, 1 / (2 steps), over all.
    assert_vector(f.work.pairs.history[0].value, expected, 0.5 / steps + 60.0 / steps / steps);
    fixture_destroy(&f);
}

static void the_spring_turns_with_the_pair(void **unused)
{
    (void)unused;
    const double across[3] = {3.0 / 7, 6.0 / 7, 2.0 / 7}, aslant[3] = {6.0 / 7, -2.0 / 7, -3.0 / 7};
    for (int steps = 1000; steps <= 10000; steps *= 10) {
        turn_pair(direction, steps); // about the normal
        turn_pair(across, steps);    // with the spring along the axis
        turn_pair(aslant, steps);    // with the spring across
    }
}

/// Couple of rolling resistance k_t R_eff^2 theta + dashpot, and its cap; opposite on the two spheres.
static void rolling_is_resisted(void **unused)
{
    (void)unused;
    fixture f;
    double force[3], torque[3], other[3], axis[3] = {3.0 / 7, 6.0 / 7, 2.0 / 7}, spin[3], second[3], expected[3];
    create_pair(&f, HERTZ_MINDLIN, 2e-6);
    fixture_destroy(&f);
    for (int capped = 0; capped <= 1; capped++) {
        create_pair(&f, HERTZ_MINDLIN, 2e-6);
        sphere_resist_turning(&f);
        scree_error error;
        assert_int_equal(scree_allocate(&f.work.pairs.rolling, f.work.pairs.capacity, sizeof(scree_rolling), &error),
                         SCREE_OK);
        geometry g = geometry_of(&f);
        double reduced = 1e-3 * 1.3e-3 / 2.3e-3, normal = 4e9 * g.radius * g.d, rate = capped ? 400 : 3;
        for (int k = 0; k < 3; k++) spin[k] = rate * axis[k] / (1e-3 - g.d / 2);
        for (int k = 0; k < 3; k++) second[k] = -rate * axis[k] / (1.3e-3 - g.d / 2);
        for (int k = 0; k < 3; k++) spin[k] *= 1e-3, second[k] *= 1e-3;
        set_motion(&f, 0, none, spin);
        set_motion(&f, 1, none, second);
        fixture_forces(&f);
        fixture_forces(&f);
        double relative = sqrt(dot(spin, spin)) + sqrt(dot(second, second));
        double roll = reduced * relative, resistance = 5e9 * g.radius * 2e-7 * roll + g.eta * roll;
        if (resistance > 0.1 * normal) resistance = 0.1 * normal;
        assert_true((resistance < 0.1 * normal) == !capped);
        for (int k = 0; k < 3; k++) expected[k] = -reduced * resistance * axis[k];
        sphere_force(&f, 0, force, torque);
        sphere_force(&f, 1, force, other);
        assert_vector(torque, expected, 1e-11);
        for (int k = 0; k < 3; k++) expected[k] = -expected[k];
        assert_vector(other, expected, 1e-11);
        fixture_destroy(&f);
    }
}

/// Torque of twisting (k_t theta + eta theta') a^2 / 2 along n, capped at mu_tw R_eff f_n.
static void twisting_is_resisted(void **unused)
{
    (void)unused;
    fixture f;
    double force[3], torque[3], spin[3], expected[3];
    for (int capped = 0; capped <= 1; capped++) {
        create_pair(&f, HERTZ_MINDLIN, 2e-6);
        sphere_resist_turning(&f);
        scree_error error;
        assert_int_equal(scree_allocate(&f.work.pairs.rolling, f.work.pairs.capacity, sizeof(scree_rolling), &error),
                         SCREE_OK);
        geometry g = geometry_of(&f);
        double reduced = 1e-3 * 1.3e-3 / 2.3e-3, normal = 4e9 * g.radius * g.d, rate = capped ? 1e6 : 30;
        for (int k = 0; k < 3; k++) spin[k] = rate * direction[k];
        set_motion(&f, 0, none, spin);
        fixture_forces(&f);
        fixture_forces(&f);
        double half = g.radius * g.radius / 2, resistance = half * (5e9 * g.radius * 2e-7 + g.eta) * rate;
        double cap = 0.2 * reduced * normal;
        assert_true((resistance < cap) == !capped);
        if (capped) resistance = cap;
        for (int k = 0; k < 3; k++) expected[k] = -resistance * direction[k];
        sphere_force(&f, 0, force, torque);
        // a torque of 1e-9 N m in quanta of some 1e-18 N m; capped, the quanta are those of a spin of 1e6 rad/s
        assert_vector(torque, expected, capped ? 1e-8 : 2e-9);
        fixture_destroy(&f);
    }
}

/// Two spheres of two materials that touch obliquely, approach, slide, roll and twist. Velocities are multiples of
/// 2^-3.
static void create_oblique(fixture *f, law_choice law)
{
    fixture_create_in(f, 3, law, 2, 2e-6);
    f->model.material_count = 2;
    if (law == HERTZ_MINDLIN) sphere_resist_turning(f);
    sphere first = {{0.0009765625, 0.00123, 0.00142}, {0.25, -0.5, -0.125}, {50, -30, 80}, 1e-3, 0};
    sphere second = {{-0.000732421875, 0.0004, 0.00027}, {0.75, 0.375, 0.25}, {-20, 10, 40}, 1.3e-3, 1};
    sphere_set(f, 0, &first);
    sphere_set(f, 1, &second);
    f->state.largest_overlap = 1e-4;
    fixture_measure_speed(f);
    f->state.largest_speed = 10;
    fixture_find_pairs(f, 1e-4);
    assert_int_equal(fixture_touching(&f->work.pairs), 1);
}

/// Forces and torques on the first sphere after five evaluations.
typedef struct result {
    double force[3], torque[3];
} result;

static result evaluate(fixture *f)
{
    result r;
    for (int n = 0; n < 5; n++) fixture_forces(f);
    sphere_force(f, 0, r.force, r.torque);
    fixture_destroy(f);
    return r;
}

static void exchanging_the_spheres_changes_nothing(void **unused)
{
    (void)unused;
    for (int law = HERTZ_BRILLIANTOV; law <= HERTZ_MINDLIN; law++) {
        fixture f;
        create_oblique(&f, (law_choice)law);
        result one = evaluate(&f);
        create_oblique(&f, (law_choice)law);
        f.work.pairs.first[0] = 1, f.work.pairs.second[0] = 0;
        result other = evaluate(&f);
        assert_memory_equal(&one, &other, sizeof one);
        for (int k = 0; k < 3; k++) assert_true(one.force[k] != 0 && one.torque[k] != 0);
    }
}

/// x <- m x for every vector of the state; `axial` for spins (m is a rotation).
static void turn_everything(fixture *f, double m[3][3])
{
    for (size_t k = 0; k < f->state.count; k++) {
        scree_row *row = &f->state.row[k];
        scree_turn_row *turn = &f->state.turn[k];
        const double x[3] = {row->x, row->y, row->z}, v[3] = {row->vx, row->vy, row->vz};
        const double w[3] = {turn->wx, turn->wy, turn->wz};
        row->x = dot(m[0], x), row->y = dot(m[1], x), row->z = dot(m[2], x);
        row->vx = dot(m[0], v), row->vy = dot(m[1], v), row->vz = dot(m[2], v);
        turn->wx = dot(m[0], w), turn->wy = dot(m[1], w), turn->wz = dot(m[2], w);
    }
}

static void compare_turned(law_choice law, double m[3][3], double tolerance)
{
    fixture f;
    double expected[3];
    create_oblique(&f, law);
    result upright = evaluate(&f);
    create_oblique(&f, law);
    turn_everything(&f, m);
    result turned = evaluate(&f);
    for (int k = 0; k < 3; k++) expected[k] = dot(m[k], upright.force);
    assert_vector(turned.force, expected, tolerance);
    for (int k = 0; k < 3; k++) expected[k] = dot(m[k], upright.torque);
    // Of two couples that partly cancel: at most 1.8e-12 in 40 random turns.
    assert_vector(turned.torque, expected, 2 * tolerance);
}

/// A half turn about an axis and a quarter turn about z leave every sum as it is, so they are exact; a permutation of
/// all axes adds in another order, any rotation rounds the positions: 1e-19 m of an overlap of 6e-5 m.
static void turning_the_axes_turns_the_forces(void **unused)
{
    (void)unused;
    double half[3][3] = {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, quarter[3][3] = {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    double cyclic[3][3] = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
    double any[3][3] = {{2.0 / 7, 3.0 / 7, 6.0 / 7}, {3.0 / 7, -6.0 / 7, 2.0 / 7}, {6.0 / 7, 2.0 / 7, -3.0 / 7}};
    for (int law = HERTZ_BRILLIANTOV; law <= HERTZ_MINDLIN; law++) {
        compare_turned((law_choice)law, half, 0);
        compare_turned((law_choice)law, quarter, 0);
        compare_turned((law_choice)law, cyclic, ROUND_OFF);
        compare_turned((law_choice)law, any, ROUND_OFF);
    }
}

/// Velocities are multiples of 2^-3 and so is the boost: their differences are exact.
static void a_boost_changes_nothing(void **unused)
{
    (void)unused;
    fixture f;
    create_oblique(&f, HERTZ_MINDLIN);
    result rest = evaluate(&f);
    create_oblique(&f, HERTZ_MINDLIN);
    for (int k = 0; k < 2; k++) f.state.row[k].vx += 4, f.state.row[k].vy -= 2, f.state.row[k].vz += 1;
    result moving = evaluate(&f);
    assert_memory_equal(&rest, &moving, sizeof rest);
}

/// R_eff = R, m_eff = m; the wall moves along its normal and in its plane; no direction is special.
static void wall_is_a_body_of_infinite_radius_and_mass(void **unused)
{
    (void)unused;
    for (int axis = 0; axis < 6; axis++) {
        fixture f;
        double force[3], torque[3], expected[3], normal[3] = {0}, slip[3] = {0}, turning[3];
        normal[axis / 2] = axis % 2 ? -1 : 1;
        slip[(axis / 2 + 1) % 3] = 3e-3, slip[(axis / 2 + 2) % 3] = -4e-3;
        fixture_create_in(&f, 3, HERTZ_MINDLIN, 1, 1e-7);
        scree_wall *wall = &scree_plates(&f.state)[SCREE_WALL_BOTTOM];
        *wall = (scree_wall){.position = 0.1, .velocity = 0.01, .active = 1};
        sphere s = {.radius = 1e-3};
        for (int k = 0; k < 3; k++) {
            wall->normal[k] = normal[k];
            wall->tangential_velocity[k] = -slip[k];
            s.place[k] = (0.1 + 1e-3 - 2e-6) * normal[k];
        }
        sphere_set(&f, 0, &s);
        f.state.largest_overlap = 2e-6;
        fixture_find_walls(&f);
        fixture_forces(&f);
        sphere_force(&f, 0, force, torque);
        double place[3] = {f.state.row[0].x, f.state.row[0].y, f.state.row[0].z};
        double d = 1e-3 - (dot(normal, place) - 0.1), radius = sqrt(1e-3 * d);
        double eta = 0.3 * sqrt(f.state.row[0].mass * 4e9 * radius), tangential = 5e9 * radius * 1e-7 + eta;
        for (int k = 0; k < 3; k++) expected[k] = (4e9 * radius * d + eta * 0.01) * normal[k] - tangential * slip[k];
        assert_vector(force, expected, ROUND_OFF);
        cross(normal, slip, turning);
        for (int k = 0; k < 3; k++) turning[k] *= (1e-3 - d / 2) * tangential;
        assert_vector(torque, turning, ROUND_OFF);
        for (int k = 0; k < 3; k++) expected[k] = tangential * slip[k];
        assert_vector(wall->shear, expected, ROUND_OFF);
        assert_true(fabs(wall->force - (4e9 * radius * d + eta * 0.01)) < ROUND_OFF * wall->force);
        fixture_destroy(&f);
    }
}

/// Head-on impact of two spheres at an angle to all axes: the restitution is the one that the damping is for.
static void restitution_is_that_of_theory(void **unused)
{
    (void)unused;
    fixture f;
    create_pair(&f, HERTZ_MINDLIN, -1e-9);
    f.model.pairs[0][0].value[HERTZ_DAMPING] = scree_damping_from_restitution(0.6);
    double velocity[3];
    for (int k = 0; k < 3; k++) velocity[k] = -1.0 * direction[k];
    set_motion(&f, 0, velocity, none);
    f.state.step_size = 2e-10;
    fixture_forces(&f);
    for (int n = 0; n < 200000 && fixture_gap(&f, 0, 1) < 2e-9; n++) sphere_step(&f);
    const scree_row *row = f.state.row;
    const double parting[3] = {row[0].vx - row[1].vx, row[0].vy - row[1].vy, row[0].vz - row[1].vz};
    // a step is 1e-4 of the duration
    assert_true(fabs(dot(parting, direction) - 0.6) < 1e-3);
    fixture_destroy(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normal_force_is_hertz),
        cmocka_unit_test(tangential_spring_is_mindlin),
        cmocka_unit_test(friction_is_capped),
        cmocka_unit_test(rolling_and_rigid_rotation_do_not_slip),
        cmocka_unit_test(the_spring_turns_with_the_pair),
        cmocka_unit_test(rolling_is_resisted),
        cmocka_unit_test(twisting_is_resisted),
        cmocka_unit_test(exchanging_the_spheres_changes_nothing),
        cmocka_unit_test(turning_the_axes_turns_the_forces),
        cmocka_unit_test(a_boost_changes_nothing),
        cmocka_unit_test(wall_is_a_body_of_infinite_radius_and_mass),
        cmocka_unit_test(restitution_is_that_of_theory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
