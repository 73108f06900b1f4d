/// Geometries with levers: a force that acts anywhere on a body turns it, along the normal too. Proven by capsules in
/// two dimensions (a disc swept along a segment), a geometry of this file alone, one by one, with angles from the
/// state.
#include "contact/kinematics.h"

#include "model/law.h"
#include "module/geometry.h"
#include "state/state.h"

// ---- the geometry --------------------------------------------------------------------------------------------------

static double half_length = 0.8e-3; ///< m, of the segment of each body

static const scree_geometry_traits capsule_traits = {.levers = true};

/// Where two capsules touch, or would: centres and angles are given.
typedef struct capsule_place {
    vector normal, lever_first, lever_second;
    double distance; ///< m, of the segments
} capsule_place;

/// Nearest point to p of the segment about `centre`.
static vector capsule_nearest(vector centre, double angle, vector p)
{
    const vector axis = {cos(angle), sin(angle), 0}, from = vector_minus(2, p, centre);
    const double along = fmax(-half_length, fmin(half_length, vector_dot(2, from, axis)));
    return vector_plus(2, centre, vector_times(2, axis, along));
}

/// Two segments that do not cross are nearest where an end of one of them is; the order of the two changes no bit.
static capsule_place capsule_find(vector one, double angle, double radius, vector other, double angle_other,
                                  double radius_other)
{
    vector best[2] = {one, other};
    double least = INFINITY;
    for (int k = 0; k < 4; k++) {
        const double sign = k % 2 ? -half_length : half_length, turned = k < 2 ? angle : angle_other;
        const vector end =
            vector_plus(2, k < 2 ? one : other, vector_times(2, (vector){cos(turned), sin(turned), 0}, sign));
        const vector to = k < 2 ? capsule_nearest(other, angle_other, end) : capsule_nearest(one, angle, end);
        const vector apart = vector_minus(2, end, to);
        const double square = vector_dot(2, apart, apart);
        if (!(square < least)) continue;
        least = square;
        best[0] = k < 2 ? end : to;
        best[1] = k < 2 ? to : end;
    }
    capsule_place place = {.distance = sqrt(least)};
    place.normal = vector_times(2, vector_minus(2, best[0], best[1]), 1 / place.distance);
    // The contact point: in the middle between the two surfaces.
    const vector a = vector_minus(2, best[0], vector_times(2, place.normal, radius));
    const vector b = vector_plus(2, best[1], vector_times(2, place.normal, radius_other));
    const vector point = vector_times(2, vector_plus(2, a, b), 0.5);
    place.lever_first = vector_minus(2, point, one);
    place.lever_second = vector_minus(2, point, other);
    return place;
}

static capsule_place capsule_now(const bodies *first, const bodies *second)
{
    return capsule_find(first->position, first->state->angle[first->row], first->radius, second->position,
                        second->state->angle[second->row], second->radius);
}

/// A step before: the velocities are those that brought the bodies here.
static capsule_place capsule_before(const bodies *first, const bodies *second, double step)
{
    const vector one = vector_minus(2, first->position, vector_times(2, first->velocity, step));
    const vector other = vector_minus(2, second->position, vector_times(2, second->velocity, step));
    return capsule_find(one, first->state->angle[first->row] - step * first->spin.x, first->radius, other,
                        second->state->angle[second->row] - step * second->spin.x, second->radius);
}

static lanes_bits capsule_touches(int dimension, const bodies *first, const bodies *second)
{
    (void)dimension;
    return ~lanes_at_or_below(first->radius + second->radius, capsule_now(first, second).distance);
}

static kinematics capsule_kinematics(int dimension, const bodies *first, const bodies *second, double step)
{
    const capsule_place now = capsule_now(first, second), before = capsule_before(first, second, step);
    kinematics m = {.normal = now.normal,
                    .overlap = first->radius + second->radius - now.distance,
                    .lever_first = now.lever_first,
                    .lever_second = now.lever_second,
                    .reduced_radius = first->radius * second->radius / (first->radius + second->radius),
                    .reduced_mass = first->mass * second->mass / (first->mass + second->mass)};
    m.tilted = vector_across(dimension, vector_minus(dimension, now.normal, before.normal), now.normal);
    m.moved_first = vector_minus(dimension, now.lever_first, before.lever_first);
    m.moved_second = vector_minus(dimension, now.lever_second, before.lever_second);
    kinematics_from_levers(dimension, &m, first, second, step);
    return m;
}

/// No walls here.
static kinematics capsule_beside(const bodies *body, const double normal[3], double distance, double step)
{
    (void)body, (void)normal, (void)distance, (void)step;
    return (kinematics){.overlap = 0};
}

static double capsule_reach(const bodies *body)
{
    return body->radius;
}

#define SCREE_MORE_GEOMETRIES(row) row(capsule)
#include "contact/forces.c"
#include "contact/reference.c"

#include "contact_fixture.h"

// ---- bodies --------------------------------------------------------------------------------------------------------

#define STIFFNESS 4e5
#define RATIO     0.8

static double inertia_of(const scree_row *row)
{
    const double width = row->radius + half_length;
    return 0.3 * row->mass * width * width;
}

static void capsules_create(fixture *f, size_t count, double step, double friction, double damping)
{
    fixture_create(f, LINEAR, count, step);
    f->model.geometry = GEOMETRY_capsule;
    f->model.overlap_limit = 1;
    f->model.pairs[0][0] = linear_pair(STIFFNESS, 0, RATIO, friction, damping, damping);
}

static void capsules_list(fixture *f)
{
    fixture_find_pairs(f, 4 * half_length);
    const size_t count = f->work.pairs.count, touching = fixture_touching(&f->work.pairs);
    scree_pairs_clear(&f->work.pairs);
    (void)scree_pairs_add_section(&f->work.pairs, GEOMETRY_capsule, 0, false, touching, count - touching);
}

static void capsules_step(fixture *f)
{
    const double dt = f->state.step_size;
    for (size_t k = 0; k < f->state.count; k++) {
        scree_row *row = &f->state.row[k];
        double force[3];
        fixture_force(f, k, force);
        row->vx += dt * force[0] / row->mass;
        row->vy += dt * force[1] / row->mass;
        row->spin += dt * force[2] / inertia_of(row);
        row->x += dt * row->vx;
        row->y += dt * row->vy;
        f->state.angle[k] += dt * row->spin;
    }
    f->state.step++;
    fixture_measure_speed(f);
    f->state.largest_speed *= 1 + half_length / 0.8e-3; // of the ends
    fixture_forces(f);
}

/// A disturbed net of capsules, along x and y by turns, that run into each other.
static void create_net(fixture *f, double step, double friction, double damping)
{
    enum { SIDE = 5 };
    capsules_create(f, SIDE * SIDE, step, friction, damping);
    for (size_t k = 0; k < f->state.count; k++) {
        scree_row *row = &f->state.row[k];
        const uint64_t c = 10 * k;
        row->radius = 1e-3 * (0.6 + 0.1 * fixture_random(c));
        row->mass = fixture_mass(&f->model, 0, 1e-3);
        row->x = 2.4e-3 * ((double)(k % SIDE) - 2) + 2e-4 * fixture_random(c + 1);
        row->y = 2.4e-3 * ((double)(k / SIDE) - 2) + 2e-4 * fixture_random(c + 2);
        row->vx = 2 * (0.5 - fixture_random(c + 3)) - 1500 * row->x;
        row->vy = 2 * (0.5 - fixture_random(c + 4)) - 1500 * row->y;
        row->spin = 2e3 * (fixture_random(c + 5) - 0.5);
        f->state.angle[k] = 0.5 * M_PI * (double)(k % 2) + 0.3 * fixture_random(c + 6);
    }
    fixture_measure_speed(f);
    f->state.largest_speed *= 2;
    capsules_list(f);
}

// ---- balances ------------------------------------------------------------------------------------------------------

/// Energy that there is and has been dissipated [J]: the kinetic one is that of the leapfrog ledger.
static double energy_of(const fixture *f)
{
    const double dt = f->state.step_size;
    double energy = f->state.ledger.damping + f->state.ledger.friction - f->state.ledger.stiffness;
    for (size_t k = 0; k < f->state.count; k++) {
        const scree_row *row = &f->state.row[k];
        double force[3];
        fixture_force(f, k, force);
        energy += 0.5 * row->vx * (row->mass * row->vx + dt * force[0]) +
                  0.5 * row->vy * (row->mass * row->vy + dt * force[1]) +
                  0.5 * row->spin * (inertia_of(row) * row->spin + dt * force[2]);
    }
    for (size_t p = 0; p < f->work.pairs.count; p++) {
        const size_t a = f->work.pairs.first[p], b = f->work.pairs.second[p];
        const scree_row *one = &f->state.row[a], *other = &f->state.row[b];
        const capsule_place place = capsule_find((vector){one->x, one->y, 0}, f->state.angle[a], one->radius,
                                                 (vector){other->x, other->y, 0}, f->state.angle[b], other->radius);
        const double overlap = fmax(one->radius + other->radius - place.distance, 0);
        const double pressed = f->work.pairs.history[p].value[0];
        energy += 0.5 * STIFFNESS * (overlap * overlap + RATIO * pressed * pressed);
    }
    return energy;
}

/// Torque of all forces about the origin, over what the rounding of each contact makes of it: its force to quanta at a
/// lever up to 2 mm on each body, its two torques to theirs; and the products of this sum in double precision.
static double unbalance(const fixture *f)
{
    double sum = 0, scale = 0;
    int64_t forces[2] = {0}, contacts = 0;
    for (size_t k = 0; k < f->state.count; k++) {
        double force[3];
        fixture_force(f, k, force);
        sum += f->state.row[k].x * force[1] - f->state.row[k].y * force[0] + force[2];
        scale += 15e-3 * hypot(force[0], force[1]);
        forces[0] += f->state.sum[k].fx;
        forces[1] += f->state.sum[k].fy;
        contacts += f->state.sum[k].contacts;
    }
    assert_true(forces[0] == 0 && forces[1] == 0);
    return fabs(sum) / ((double)contacts * (f->state.torque_quantum + 2e-3 * f->state.force_quantum) + 1e-14 * scale);
}

static double residual(double step, int steps, double friction, double damping, double *dissipated)
{
    fixture f;
    create_net(&f, step, friction, damping);
    fixture_forces(&f);
    const double begin = energy_of(&f);
    double worst = 0, torque = 0;
    for (int k = 0; k < steps; k++) {
        capsules_step(&f);
        worst = fmax(worst, fabs(energy_of(&f) / begin - 1));
        if (f.state.largest_overlap > 0) torque = fmax(torque, unbalance(&f));
    }
    assert_int_equal(f.work.flags, 0);
    *dissipated = (f.state.ledger.damping + f.state.ledger.friction) / begin;
    assert_true(torque > 0 && torque < 1);
    fixture_destroy(&f);
    return worst;
}

/// A quarter of the step leaves a sixteenth of the residual, half of it for what opens and closes. With dashpots, whose
/// force jumps at a touch, first order: a quarter.
static void the_balance_closes(void **unused)
{
    (void)unused;
    double spent[2];
    const double smooth[2] = {residual(8e-8, 2000, 0.4, 0, spent), residual(2e-8, 8000, 0.4, 0, spent + 1)};
    print_message("friction: residual %.3g, with a quarter of the step %.3g; %.3g dissipated\n", smooth[0], smooth[1],
                  spent[1]);
    assert_true(smooth[0] < 1e-4 && smooth[1] < smooth[0] / 8 && spent[1] > 0.02);
    const double damped[2] = {residual(8e-8, 2000, 0.4, 0.2, spent), residual(2e-8, 8000, 0.4, 0.2, spent + 1)};
    print_message("with dashpots: residual %.3g, with a quarter of the step %.3g; %.3g dissipated\n", damped[0],
                  damped[1], spent[1]);
    assert_true(damped[0] < 1e-2 && damped[1] < damped[0] / 3 && spent[1] > 0.1);
}

// ---- one contact ---------------------------------------------------------------------------------------------------

static void put(fixture *f, size_t k, double x, double y, double angle, double vx, double vy, double spin)
{
    f->state.row[k] = (scree_row){
        .x = x, .y = y, .radius = 0.6e-3, .vx = vx, .vy = vy, .spin = spin, .mass = fixture_mass(&f->model, 0, 1e-3)};
    f->state.angle[k] = angle;
}

/// The end of one capsule on the side of another, undamped and without friction: an impulse 2 m c along the normal,
/// with 1 / m = 1 / m_1 + 1 / m_2 + (l_1 x n)^2 / J_1 + (l_2 x n)^2 / J_2. Within what the bodies turn during the
/// contact.
static void an_impact_off_the_centre_turns_both(void **unused)
{
    (void)unused;
    const double speed = 0.01;
    fixture f;
    capsules_create(&f, 2, 2e-8, 0, 0);
    put(&f, 0, 0, 0, 0, 0, 0, 0);
    put(&f, 1, 0.5e-3, half_length + 1.2e-3 + 1e-9, (0.5 * M_PI), 0, -speed, 0);
    capsules_list(&f);
    fixture_measure_speed(&f);
    fixture_forces(&f);
    for (int k = 0; k < 4000; k++) capsules_step(&f);
    assert_true(f.state.largest_overlap == 0 && f.state.row[1].vy > -speed);
    const double mass = f.state.row[0].mass, inertia = inertia_of(&f.state.row[0]), lever = 0.5e-3;
    const double reduced = 1 / (2 / mass + lever * lever / inertia), impulse = 2 * reduced * speed;
    print_message("spin %.6g of theory, velocities %.6g, %.6g\n", f.state.row[0].spin / (-impulse * lever / inertia),
                  f.state.row[0].vy / (-impulse / mass), f.state.row[1].vy / (impulse / mass - speed));
    assert_true(fabs(f.state.row[0].spin / (-impulse * lever / inertia) - 1) < 1e-3);
    assert_true(fabs(f.state.row[0].vy / (-impulse / mass) - 1) < 1e-3);
    assert_true(fabs(f.state.row[1].vy / (impulse / mass - speed) - 1) < 1e-3);
    assert_true(fabs(f.state.row[1].spin) < 1e-3 * fabs(f.state.row[0].spin)); // its lever lies along the normal
    fixture_destroy(&f);
}

/// The bodies exchanged: the same bits.
static void exchange_changes_no_bit(void **unused)
{
    (void)unused;
    for (uint64_t n = 0; n < 200; n++) {
        scree_sum_row sum[2][2];
        for (int swapped = 0; swapped < 2; swapped++) {
            const uint64_t c = 20 * n;
            fixture f;
            capsules_create(&f, 2, 1e-7, 0.5, 0.1);
            f.model.overlap_limit = 10; // what explains a larger one does not know the geometry of this file
            put(&f, 0, 0, 0, 3 * fixture_random(c), fixture_random(c + 1), fixture_random(c + 2),
                900 * fixture_random(c + 3));
            put(&f, 1, 1.2e-3 * fixture_random(c + 4), 1.1e-3, 3 * fixture_random(c + 5), fixture_random(c + 6), 0.3,
                -70);
            capsules_list(&f);
            assert_int_equal(f.work.pairs.count, 1);
            if (swapped) f.work.pairs.first[0] = 1, f.work.pairs.second[0] = 0;
            f.work.pairs.history[0].value[0] = 3e-6;
            fixture_measure_speed(&f);
            fixture_forces(&f);
            memcpy(sum[swapped], f.state.sum, sizeof sum[swapped]);
            fixture_destroy(&f);
        }
        assert_memory_equal(sum[0], sum[1], sizeof sum[0]);
    }
}

/// Capsules without a length are discs: rates, arms and torques of the levers are those of the geometry round, up to
/// the second order in what the pair turns by in the step, some 1e-4.
static void without_a_length_they_are_discs(void **unused)
{
    (void)unused;
    const double length = half_length, step = 1e-7;
    scree_state state = {.angle = (double[]){0.3, 1.7}};
    half_length = 0;
    for (uint64_t n = 0; n < 200; n++) {
        const uint64_t c = 20 * n;
        bodies one = {.position = {1e-3 * fixture_random(c), 1e-3, 0},
                      .velocity = {2 * fixture_random(c + 1), fixture_random(c + 2), 0},
                      .spin = {.x = 900 * fixture_random(c + 3)},
                      .radius = 1e-3,
                      .mass = 2e-6,
                      .state = &state};
        bodies other = {.position = {0, 2.5e-3, 0},
                        .velocity = {0.4, -fixture_random(c + 4), 0},
                        .spin = {.x = -300},
                        .radius = 0.9e-3,
                        .mass = 1e-6,
                        .state = &state,
                        .row = 1};
        const kinematics a = round_kinematics(2, &one, &other, step), b = capsule_kinematics(2, &one, &other, step);
        const double turn = fabs(a.tilted.x) + step * 1200, speed = 5;
        assert_true(fabs(a.overlap - b.overlap) < 1e-17 && fabs(a.tilted.x - b.tilted.x) < 2 * turn * turn);
        assert_true(fabs(a.approach - b.approach) < speed * turn * turn);
        assert_true(fabs(a.slip.x - b.slip.x) < speed * turn * turn);
        assert_true(fabs(a.arm_first - b.arm_first) < 1e-15 && fabs(a.arm_second - b.arm_second) < 1e-15);
    }
    half_length = length;
}

/// Threads cut the list of pairs one by one as that of pairs in lanes; moments are of levers, too.
static void threads_and_moments(void **unused)
{
    (void)unused;
    fixture one, many;
    create_net(&one, 8e-8, 0.4, 0.1);
    create_net(&many, 8e-8, 0.4, 0.1);
    scree_error error;
    check(scree_state_ask_for_moments(&one.state, true, &error), &error);
    check(scree_state_ask_for_moments(&many.state, true, &error), &error);
    many.work.threads = 3;
    many.work.keep_threads = true;
    one.work.reference_kernel = true;
    fixture_forces(&one);
    fixture_forces(&many);
    for (int k = 0; k < 600; k++) {
        capsules_step(&one);
        capsules_step(&many);
    }
    assert_memory_equal(one.state.row, many.state.row, one.state.count * sizeof *one.state.row);
    assert_memory_equal(one.state.sum, many.state.sum, one.state.count * sizeof *one.state.sum);
    const size_t size = one.state.count * scree_moment_size(2) * sizeof *one.state.moment;
    assert_memory_equal(one.state.moment, many.state.moment, size);
    // The antisymmetric part of sum l (x) f is the torque, up to the rounding of each contact to a quantum.
    size_t turned = 0;
    for (size_t k = 0; k < one.state.count; k++) {
        const int64_t *moment = one.state.moment + k * scree_moment_size(2);
        assert_true(llabs(moment[1] - moment[2] - one.state.sum[k].torque) <= 2 * one.state.sum[k].contacts);
        turned += one.state.sum[k].torque != 0;
    }
    assert_true(turned > 5);
    fixture_destroy(&one);
    fixture_destroy(&many);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_balance_closes),      cmocka_unit_test(an_impact_off_the_centre_turns_both),
        cmocka_unit_test(exchange_changes_no_bit), cmocka_unit_test(without_a_length_they_are_discs),
        cmocka_unit_test(threads_and_moments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
