/// Integrators on an oscillator whose force the test writes into the sums: order, energy, equivalence, threads.

#include "testing.h"

#include "base/fixed.h"
#include "integrate/integrate.h"

#include <math.h>
#include <string.h>

#define MASS      2.0
#define RADIUS    0.5
#define STIFFNESS 8.0 /* omega = 2 for x and, with the torque below, for the angle */
#define OMEGA     2.0

static scree_model make_model(scree_scheme scheme)
{
    scree_model model;
    memset(&model, 0, sizeof model);
    model.scheme = scheme;
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
    state->step_size = dt;
    state->force_quantum = scree_fixed_quantum(1000);
    state->torque_quantum = scree_fixed_quantum(1000);
    for (size_t k = 0; k < count; k++) {
        state->row[k] = (scree_row){.x = 1 + (double)k, .y = -0.5, .radius = RADIUS, .mass = MASS};
        state->angle[k] = 0.3;
    }
}

/// Largest error of x, y, angle and vx after `time` with `steps` steps.
static double oscillator_error(scree_scheme scheme, double time, int steps)
{
    scree_model model = make_model(scheme);
    scree_state state;
    scree_work work = {.threads = 1};
    double dt = time / steps;
    make_state(&state, 1, dt);
    spring_forces(&state);
    const scree_integrator *integrator = scree_integrator_get(scheme);
    // position Verlet starts from v(-1/2), to second order.
    if (scheme == SCREE_SCHEME_POSITION_VERLET) {
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
    for (int scheme = SCREE_SCHEME_POSITION_VERLET; scheme <= SCREE_SCHEME_VELOCITY_VERLET; scheme++) {
        double coarse = oscillator_error((scree_scheme)scheme, 3.0, 300);
        double fine = oscillator_error((scree_scheme)scheme, 3.0, 600);
        // Leading error (omega dt)^2 / 24 * omega t; the ratio of a second-order scheme is 4.
        assert_true(coarse < 2 * pow(OMEGA * 0.01, 2) / 24 * OMEGA * 3.0 * OMEGA);
        assert_true(fabs(coarse / fine - 4) < 0.1);
    }
}

static void schemes_share_their_trajectory(void **unused)
{
    (void)unused;
    scree_model position = make_model(SCREE_SCHEME_POSITION_VERLET),
                velocity = make_model(SCREE_SCHEME_VELOCITY_VERLET);
    scree_state a, b;
    scree_work work = {.threads = 1};
    make_state(&a, 1, 0.01);
    make_state(&b, 1, 0.01);
    spring_forces(&a);
    spring_forces(&b);
    a.row[0].vx = 0.5 * 0.01 * OMEGA * OMEGA;
    a.row[0].vy = -0.5 * 0.01 * OMEGA * OMEGA * 0.5;
    const scree_integrator *p = scree_integrator_get(SCREE_SCHEME_POSITION_VERLET);
    const scree_integrator *v = scree_integrator_get(SCREE_SCHEME_VELOCITY_VERLET);
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
    scree_model model = make_model(SCREE_SCHEME_VELOCITY_VERLET);
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
    scree_model model = make_model(SCREE_SCHEME_VELOCITY_VERLET);
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
        checksum[threads - 1] = scree_state_checksum(&state);
        scree_state_destroy(&state);
    }
    assert_true(checksum[0] == checksum[1] && checksum[0] == checksum[2]);
}

static void a_speed_that_is_not_a_number_raises_the_flag(void **unused)
{
    (void)unused;
    scree_model model = make_model(SCREE_SCHEME_POSITION_VERLET);
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

static void order_and_checksum(void **unused)
{
    (void)unused;
    scree_state state;
    scree_error error;
    make_state(&state, 4, 0.01);
    uint64_t before = scree_state_checksum(&state);
    const uint32_t order[4] = {2, 0, 3, 1};
    assert_int_equal(scree_state_permute(&state, order, &error), SCREE_OK);
    assert_int_equal(state.id[0], 2);
    assert_int_equal(state.row_of_id[2], 0);
    assert_true(state.row[0].x == 3);
    assert_true(scree_state_checksum(&state) == before);
    state.row[1].spin = nextafter(state.row[1].spin, 1);
    assert_true(scree_state_checksum(&state) != before);
    scree_state_destroy(&state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_schemes_are_of_second_order),
        cmocka_unit_test(schemes_share_their_trajectory),
        cmocka_unit_test(gravity_is_a_parabola),
        cmocka_unit_test(threads_give_the_same_bits),
        cmocka_unit_test(a_speed_that_is_not_a_number_raises_the_flag),
        cmocka_unit_test(order_and_checksum),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
