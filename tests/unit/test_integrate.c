/// Integrators on an oscillator whose force the test writes into the sums: order, energy, equivalence, threads.

#include "testing.h"

#include "base/fixed.h"
#include "integrate/integrate.h"
#include "measure/measure.h"
#include "state_bits.h"

#include <math.h>
#include <string.h>

#define MASS      2.0
#define RADIUS    0.5
#define STIFFNESS 8.0 /* omega = 2 for x and, with the torque below, for the angle */
#define OMEGA     2.0

static scree_model make_model(int scheme)
{
    scree_model model;
    memset(&model, 0, sizeof model);
    model.scheme = scheme;
    model.laws[0].law = SCREE_SLOT_hertz_mindlin;
    return model;
}

/// Springs to the origin for position and angle.
static void spring_forces(scree_state *state)
{
    double inertia = 0.5 * MASS * RADIUS * RADIUS;
    for (size_t k = 0; k < state->count; k++) {
        state->sum[k].fx = scree_fixed_from(-STIFFNESS * state->row[k].x, 1 / state->force_quantum);
        state->sum[k].fy = scree_fixed_from(-STIFFNESS * state->row[k].y, 1 / state->force_quantum);
        state->sum[k].torque = scree_fixed_from(-OMEGA * OMEGA * inertia * state->angle[k], 1 / state->torque_quantum);
    }
}

static void make_state(scree_state *state, size_t count, double dt)
{
    scree_error error;
    assert_int_equal(scree_state_create(state, 2, count, &error), SCREE_OK);
    state->tick = state->step_size = state->kick_size = dt;
    state->force_quantum = scree_fixed_quantum(1000);
    state->torque_quantum = scree_fixed_quantum(1000);
    for (size_t k = 0; k < count; k++) {
        state->row[k] = (scree_row){.x = 1 + (double)k, .y = -0.5, .radius = RADIUS, .mass = MASS};
        state->angle[k] = 0.3;
    }
}

/// Largest error of x, y, angle and vx after `time` with `steps` steps.
static double oscillator_error(int scheme, double time, int steps)
{
    scree_model model = make_model(scheme);
    scree_state state;
    scree_work work = {.threads = 1};
    double dt = time / steps;
    make_state(&state, 1, dt);
    spring_forces(&state);
    const scree_integrator *integrator = scree_integrator_get(scheme);
    // position Verlet starts from v(-1/2), to second order.
    if (scheme == SCREE_SLOT_position_verlet) {
        state.row[0].vx = 0.5 * dt * OMEGA * OMEGA * 1.0;
        state.row[0].vy = -0.5 * dt * OMEGA * OMEGA * 0.5;
        state.row[0].spin = 0.5 * dt * OMEGA * OMEGA * 0.3;
    }
    for (int k = 0; k < steps; k++) {
        integrator->first(&model, &state, &work);
        spring_forces(&state);
        if (integrator->second) integrator->second(&model, &state, &work);
    }
    double c = cos(OMEGA * time), s = sin(OMEGA * time);
    scree_vector velocity, spin;
    scree_body_velocity(&model, &state, 0, velocity, spin);
    double worst = fabs(state.row[0].x - c);
    worst = fmax(worst, fabs(state.row[0].y + 0.5 * c));
    worst = fmax(worst, fabs(state.angle[0] - 0.3 * c));
    worst = fmax(worst, fabs(velocity[0] + OMEGA * s));
    worst = fmax(worst, fabs(spin[2] + 0.3 * OMEGA * s));
    scree_state_destroy(&state);
    return worst;
}

static void both_schemes_are_of_second_order(void **unused)
{
    (void)unused;
    for (int scheme = SCREE_SLOT_position_verlet; scheme <= SCREE_SLOT_velocity_verlet; scheme++) {
        double coarse = oscillator_error(scheme, 3.0, 300);
        double fine = oscillator_error(scheme, 3.0, 600);
        // Leading error (omega dt)^2 / 24 * omega t; the ratio of a second-order scheme is 4.
        assert_true(coarse < 2 * pow(OMEGA * 0.01, 2) / 24 * OMEGA * 3.0 * OMEGA);
        assert_true(fabs(coarse / fine - 4) < 0.1);
    }
}

/// Springs to the origin in space, and a torque that turns the spin as if it were a position's velocity.
static void spring_forces_in_space(scree_state *state, double time)
{
    double inertia = 0.4 * MASS * RADIUS * RADIUS, turning = inertia * OMEGA * cos(OMEGA * time);
    double force = 1 / state->force_quantum, torque = 1 / state->torque_quantum;
    for (size_t k = 0; k < state->count; k++) {
        const scree_row *row = &state->row[k];
        state->sum[k].fx = scree_fixed_from(-STIFFNESS * row->x, force);
        state->sum[k].fy = scree_fixed_from(-STIFFNESS * row->y, force);
        state->sum[k].fz = scree_fixed_from(-STIFFNESS * row->z, force);
        state->torque[k].x = scree_fixed_from(turning, torque);
        state->torque[k].y = scree_fixed_from(-2 * turning, torque);
        state->torque[k].z = scree_fixed_from(3 * turning, torque);
    }
}

/// Largest error of positions, velocity and spin of a sphere after `time`.
static double error_in_space(int scheme, double time, int steps)
{
    scree_model model = make_model(scheme);
    scree_state state;
    scree_error error;
    scree_work work = {.threads = 1};
    double dt = time / steps;
    assert_int_equal(scree_state_create(&state, 3, 1, &error), SCREE_OK);
    state.step_size = dt;
    state.force_quantum = state.torque_quantum = scree_fixed_quantum(1000);
    state.row[0] = (scree_row){.x = 1, .y = -0.5, .radius = RADIUS, .mass = MASS};
    state.row[0].z = 0.25;
    if (scheme == SCREE_SLOT_position_verlet) {
        double back = 0.5 * dt * OMEGA;
        state.row[0].vx = back * OMEGA, state.row[0].vy = -0.5 * back * OMEGA, state.row[0].vz = 0.25 * back * OMEGA;
        state.turn[0] = (scree_turn_row){-back, 2 * back, -3 * back, 0};
    }
    const scree_integrator *integrator = scree_integrator_get(scheme);
    spring_forces_in_space(&state, 0);
    for (int k = 0; k < steps; k++) {
        integrator->first(&model, &state, &work);
        spring_forces_in_space(&state, dt * (k + 1));
        if (integrator->second) integrator->second(&model, &state, &work);
    }
    double c = cos(OMEGA * time), s = sin(OMEGA * time), worst = 0;
    scree_vector place, velocity, spin;
    scree_body_position(&state, 0, place);
    scree_body_velocity(&model, &state, 0, velocity, spin);
    const double start[3] = {1, -0.5, 0.25}, rate[3] = {1, -2, 3};
    for (int k = 0; k < 3; k++) {
        worst = fmax(worst, fabs(place[k] - start[k] * c));
        worst = fmax(worst, fabs(velocity[k] + start[k] * OMEGA * s));
        worst = fmax(worst, fabs(spin[k] - rate[k] * s));
    }
    scree_state_destroy(&state);
    return worst;
}

/// Largest error of x, angle and their velocities at `time` of `sequences` sequences of one step of n ticks and q of
/// one.
static double sequences_error(uint64_t n, uint64_t q, double time, int sequences)
{
    scree_model model = make_model(SCREE_SLOT_two_timescales);
    model.large_multiple = n;
    model.small_steps = q;
    model.largest_step = n + q;
    scree_state state;
    scree_work work = {.threads = 1};
    double dt = time / (double)(n + q) / sequences;
    make_state(&state, 1, dt);
    // The step before the first one is as large: v(-1/2) belongs to it.
    state.step_size = (double)n * dt;
    state.row[0].vx = 0.5 * state.step_size * OMEGA * OMEGA * 1.0;
    state.row[0].spin = 0.5 * state.step_size * OMEGA * OMEGA * 0.3;
    spring_forces(&state);
    const scree_integrator *integrator = scree_integrator_get(SCREE_SLOT_two_timescales);
    while (state.step < (uint64_t)sequences * (n + q)) {
        state.step += scree_integrator_choose_step(integrator, &model, &state, true);
        integrator->first(&model, &state, &work);
        spring_forces(&state);
    }
    assert_true(scree_state_time(&state) == (double)state.step * dt);
    double c = cos(OMEGA * time), s = sin(OMEGA * time);
    scree_vector velocity, spin;
    scree_body_velocity(&model, &state, 0, velocity, spin);
    double worst = fmax(fabs(state.row[0].x - c), fabs(state.angle[0] - 0.3 * c));
    worst = fmax(worst, fmax(fabs(velocity[0] + OMEGA * s), fabs(spin[2] + 0.3 * OMEGA * s)));
    scree_state_destroy(&state);
    return worst;
}

static void both_schemes_are_of_second_order_in_space(void **unused)
{
    (void)unused;
    for (int scheme = SCREE_SLOT_position_verlet; scheme <= SCREE_SLOT_velocity_verlet; scheme++) {
        double coarse = error_in_space(scheme, 3.0, 300);
        double fine = error_in_space(scheme, 3.0, 600);
        // As in two dimensions.
        assert_true(coarse < 2 * pow(OMEGA * 0.01, 2) / 24 * OMEGA * 3.0 * OMEGA);
        assert_true(fabs(coarse / fine - 4) < 0.1);
    }
}

/// Steps of two sizes: kicks by the mean of neighbouring steps keep the second order.
static void two_timescales_are_of_second_order(void **unused)
{
    (void)unused;
    const uint64_t combinations[][2] = {{20, 5}, {5, 5}, {10, 15}, {3, 1}};
    for (size_t k = 0; k < sizeof combinations / sizeof *combinations; k++) {
        double coarse = sequences_error(combinations[k][0], combinations[k][1], 3.0, 60);
        double fine = sequences_error(combinations[k][0], combinations[k][1], 3.0, 120);
        // 4 up to the next order in omega times a sequence, 0.1.
        assert_true(coarse < 0.1 && fabs(coarse / fine - 4) < 0.15);
    }
}

/// What a change of the step does to the scheme's kinetic energy is accumulated: the balance over the work of the
/// springs.
static void changes_of_the_step_are_booked(void **unused)
{
    (void)unused;
    scree_model model = make_model(SCREE_SLOT_two_timescales);
    model.large_multiple = 7, model.small_steps = 3, model.largest_step = 10;
    scree_state state;
    scree_work work = {.threads = 1};
    scree_contact_table none = {0};
    scree_energy energy;
    make_state(&state, 3, 0.01);
    spring_forces(&state);
    scree_integrator_choose_step(scree_integrator_get(model.scheme), &model, &state, true);
    double initial = NAN, worst = 0, last = 0;
    for (int k = 0; k < 400; k++) {
        scree_energy_measure(&model, &state, &none, &energy);
        double potential = 0;
        for (size_t i = 0; i < 3; i++)
            potential += 0.5 * STIFFNESS *
                         (state.row[i].x * state.row[i].x + state.row[i].y * state.row[i].y +
                          0.5 * RADIUS * RADIUS * state.angle[i] * state.angle[i]);
        double sum = energy.kinetic + energy.kinetic_rotation + potential - state.ledger.scheme;
        initial = k > 0 ? initial : sum;
        worst = fmax(worst, fabs(sum - initial));
        last = fmax(last, fabs(state.ledger.scheme));
        double before = state.step_size;
        state.step += scree_integrator_choose_step(scree_integrator_get(model.scheme), &model, &state, true);
        scree_energy_change_step(&model, &state, before, state.step_size);
        scree_integrator_get(model.scheme)->first(&model, &state, &work);
        spring_forces(&state);
    }
    // Linear forces: the trapezoid is exact, so only round-off and the quantum of the force are left of some 70 J.
    assert_true(worst < 1e-11 && last > 1e-3);
    scree_state_destroy(&state);
}

static void schemes_share_their_trajectory(void **unused)
{
    (void)unused;
    scree_model position = make_model(SCREE_SLOT_position_verlet), velocity = make_model(SCREE_SLOT_velocity_verlet);
    scree_state a, b;
    scree_work work = {.threads = 1};
    make_state(&a, 1, 0.01);
    make_state(&b, 1, 0.01);
    spring_forces(&a);
    spring_forces(&b);
    a.row[0].vx = 0.5 * 0.01 * OMEGA * OMEGA;
    a.row[0].vy = -0.5 * 0.01 * OMEGA * OMEGA * 0.5;
    const scree_integrator *p = scree_integrator_get(SCREE_SLOT_position_verlet);
    const scree_integrator *v = scree_integrator_get(SCREE_SLOT_velocity_verlet);
    for (int k = 0; k < 1000; k++) {
        p->first(&position, &a, &work);
        spring_forces(&a);
        v->first(&velocity, &b, &work);
        spring_forces(&b);
        v->second(&velocity, &b, &work);
        // Round-off of 1000 steps and the quantum of the force.
        assert_true(fabs(a.row[0].x - b.row[0].x) < 1e-11);
    }
    scree_vector va, vb, wa, wb;
    scree_body_velocity(&position, &a, 0, va, wa);
    scree_body_velocity(&velocity, &b, 0, vb, wb);
    assert_true(fabs(va[0] - vb[0]) < 1e-11);
    scree_body_half_velocity(&position, &a, 0, va, wa);
    scree_body_half_velocity(&velocity, &b, 0, vb, wb);
    assert_true(fabs(va[0] - vb[0]) < 1e-11);
    scree_state_destroy(&a);
    scree_state_destroy(&b);
}

static void gravity_is_a_parabola(void **unused)
{
    (void)unused;
    scree_model model = make_model(SCREE_SLOT_velocity_verlet);
    model.gravity[1] = -9.81;
    scree_state state;
    scree_work work = {.threads = 1, .budget = 1.0};
    make_state(&state, 1, 0.01);
    const scree_integrator *integrator = scree_integrator_get(model.scheme);
    for (int k = 0; k < 100; k++) {
        integrator->first(&model, &state, &work);
        integrator->second(&model, &state, &work);
    }
    // Exact for a constant acceleration, up to round-off of 100 steps.
    assert_true(fabs(state.row[0].y - (-0.5 - 0.5 * 9.81)) < 1e-12);
    assert_true(fabs(state.row[0].vy + 9.81) < 1e-12);
    assert_true(fabs(state.largest_speed - 9.81 * 0.995) < 1e-9);
    assert_true(work.budget < 1.0 - 0.5 * 9.81 + 1e-9);
    scree_state_destroy(&state);
}

static void threads_give_the_same_bits(void **unused)
{
    (void)unused;
    scree_model model = make_model(SCREE_SLOT_velocity_verlet);
    uint64_t checksum[3];
    for (int threads = 1; threads <= 3; threads++) {
        scree_state state;
        scree_work work = {.threads = threads};
        make_state(&state, 97, 0.01);
        const scree_integrator *integrator = scree_integrator_get(model.scheme);
        for (int k = 0; k < 20; k++) {
            spring_forces(&state);
            integrator->first(&model, &state, &work);
            integrator->second(&model, &state, &work);
        }
        checksum[threads - 1] = state_bits(&state);
        scree_thread_pool_destroy(&work.pool);
        scree_state_destroy(&state);
    }
    assert_true(checksum[0] == checksum[1] && checksum[0] == checksum[2]);
}

static void a_speed_that_is_not_a_number_raises_the_flag(void **unused)
{
    (void)unused;
    scree_model model = make_model(SCREE_SLOT_position_verlet);
    scree_state state;
    scree_work work = {.threads = 2};
    make_state(&state, 5, 0.01);
    scree_integrator_get(model.scheme)->first(&model, &state, &work);
    assert_int_equal(work.flags, 0);
    state.row[3].spin = NAN;
    scree_integrator_get(model.scheme)->first(&model, &state, &work);
    assert_int_equal(work.flags, SCREE_FLAG_NAN);
    scree_state_destroy(&state);
}

/// The kick before a drift clears what it has read; the one after it leaves the sums for the next step.
static void a_kick_before_a_drift_leaves_the_sums_clear(void **unused)
{
    (void)unused;
    const int schemes[] = {SCREE_SLOT_position_verlet, SCREE_SLOT_velocity_verlet, SCREE_SLOT_two_timescales};
    for (size_t k = 0; k < sizeof schemes / sizeof *schemes; k++)
        for (int dimension = 2; dimension <= 3; dimension++) {
            scree_model model = make_model(schemes[k]);
            scree_state state;
            scree_work work = {.threads = 2};
            scree_error error;
            make_state(&state, 5, 0.01);
            if (dimension == 3) {
                scree_state_destroy(&state);
                assert_int_equal(scree_state_create(&state, 3, 5, &error), SCREE_OK);
                state.step_size = state.kick_size = 0.01;
                for (size_t i = 0; i < 5; i++)
                    state.row[i] = (scree_row){.x = (double)i, .radius = RADIUS, .mass = MASS};
            }
            const scree_sum_row full = {1, 2, {3}, 4};
            for (size_t i = 0; i < 5; i++) state.sum[i] = full;
            for (size_t i = 0; i < 5 && dimension == 3; i++)
                state.torque[i] = (scree_torque_row){.x = 1, .y = 2, .z = 3};
            const scree_integrator *integrator = scree_integrator_get(schemes[k]);
            integrator->first(&model, &state, &work);
            assert_int_equal(work.clear_rows, 5);
            for (size_t i = 0; i < 5; i++) {
                const scree_sum_row *sum = &state.sum[i];
                assert_true(sum->fx == 0 && sum->fy == 0 && sum->torque == 0 && sum->contacts == 0);
                const scree_torque_row *torque = dimension == 3 ? &state.torque[i] : NULL;
                if (torque) assert_true(torque->x == 0 && torque->y == 0 && torque->z == 0);
                state.sum[i] = full;
            }
            if (integrator->second) integrator->second(&model, &state, &work);
            for (size_t i = 0; i < 5; i++) assert_true(state.sum[i].fx == 1 && state.sum[i].contacts == 4);
            scree_thread_pool_destroy(&work.pool);
            scree_state_destroy(&state);
        }
}

static void order_and_checksum(void **unused)
{
    (void)unused;
    scree_state state;
    scree_error error;
    make_state(&state, 4, 0.01);
    uint64_t before = state_bits(&state);
    const uint32_t order[4] = {2, 0, 3, 1};
    assert_int_equal(scree_state_permute(&state, order, &error), SCREE_OK);
    assert_int_equal(state.id[0], 2);
    assert_int_equal(state.row_of_id[2], 0);
    assert_true(state.row[0].x == 3);
    assert_true(state_bits(&state) == before);
    state.row[1].spin = nextafter(state.row[1].spin, 1);
    assert_true(state_bits(&state) != before);
    scree_state_destroy(&state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_schemes_are_of_second_order),
        cmocka_unit_test(both_schemes_are_of_second_order_in_space),
        cmocka_unit_test(two_timescales_are_of_second_order),
        cmocka_unit_test(changes_of_the_step_are_booked),
        cmocka_unit_test(schemes_share_their_trajectory),
        cmocka_unit_test(gravity_is_a_parabola),
        cmocka_unit_test(threads_give_the_same_bits),
        cmocka_unit_test(a_speed_that_is_not_a_number_raises_the_flag),
        cmocka_unit_test(a_kick_before_a_drift_leaves_the_sums_clear),
        cmocka_unit_test(order_and_checksum),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
