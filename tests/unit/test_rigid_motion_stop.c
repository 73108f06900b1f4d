/// The rigid motion of a sample whose plates go: nothing would take it away later, since pressure, symmetric tractions
/// and contacts have neither a resultant nor a moment.
#include "run_fixture.h"

#include "base/random.h"
#include "boundary/rigid_motion.h"
#include "state/body.h"
#include "state/plates.h"

enum { BODIES = 40 };

/// A value from -1 to 1.
static double any(int dimension, size_t row, uint64_t k)
{
    return 2 * scree_random_uniform(11, SCREE_RANDOM_TEST, 100 * row + 10 * (uint64_t)dimension + k) - 1;
}

/// Scattered bodies of unlike masses that move as one rigid body, and `own` beside that; they feel no forces.
static void make_bodies(scree_state *state, int dimension, const double velocity[3], const double spin[3], double own)
{
    assert_int_equal(scree_state_create(state, dimension, BODIES, NULL), SCREE_OK);
    state->count = BODIES;
    state->step_size = 1e-5;
    state->force_quantum = state->torque_quantum = 1e-12;
    for (size_t row = 0; row < BODIES; row++) {
        scree_row *body = &state->row[row];
        const double x[3] = {any(dimension, row, 0), 3 * any(dimension, row, 1) + 5,
                             dimension == 3 ? any(dimension, row, 2) : 0};
        double turned[3];
        scree_cross(spin, x, turned);
        *body = (scree_row){.x = x[0], .y = x[1], .radius = 0.2 + 0.1 * any(dimension, row, 3)};
        body->mass = 2 + any(dimension, row, 4);
        body->vx = velocity[0] + turned[0] + own * any(dimension, row, 5);
        body->vy = velocity[1] + turned[1] + own * any(dimension, row, 6);
        if (dimension == 2) {
            body->spin = spin[2] + own * any(dimension, row, 7);
            continue;
        }
        body->z = x[2];
        body->vz = velocity[2] + turned[2] + own * any(dimension, row, 7);
        state->turn[row] = (scree_turn_row){.wx = spin[0] + own * any(dimension, row, 8), .wy = spin[1], .wz = spin[2]};
    }
}

static double kinetic(const scree_state *state)
{
    double sum = 0;
    for (size_t row = 0; row < state->count; row++) {
        scree_vector velocity, spin;
        scree_body_motion(state, row, velocity, spin);
        sum += 0.5 * scree_body_mass(state, row) * scree_dot(velocity, velocity) +
               0.5 * scree_body_inertia(state, row) * scree_dot(spin, spin);
    }
    return sum;
}

/// Of bodies that are one rigid body nothing is left; of others what is no rigid motion, with its energy (Koenig).
static void the_rigid_motion_goes_and_nothing_else(void **unused)
{
    (void)unused;
    for (int d = 2; d <= 3; d++) {
        const double velocity[3] = {0.3, -0.2, d == 3 ? 0.1 : 0}, spin[3] = {d == 3 ? 0.4 : 0, d == 3 ? -0.7 : 0, 0.9};
        const scree_model model = {.dimension = d, .scheme = SCREE_SLOT_position_verlet};
        scree_state rigid, state, still;
        scree_vector centre, left, turning;
        make_bodies(&rigid, d, velocity, spin, 0);
        scree_rigid_motion_measure(&rigid, centre, left, turning);
        for (int i = 0; i < 3; i++) assert_true(fabs(turning[i] - spin[i]) < 1e-13);
        const double all = kinetic(&rigid), gone = scree_rigid_motion_stop(&model, &rigid);
        assert_true(fabs(gone / all - 1) < 1e-13 && kinetic(&rigid) < 1e-26 * all);

        make_bodies(&state, d, velocity, spin, 0.5);
        make_bodies(&still, d, (double[3]){0}, (double[3]){0}, 0.5);
        const double before = kinetic(&state), taken = scree_rigid_motion_stop(&model, &state);
        (void)scree_rigid_motion_stop(&model, &still);
        assert_true(taken > 0.1 * before && fabs(before - taken - kinetic(&state)) < 1e-13 * before);
        scree_rigid_motion_measure(&state, centre, left, turning);
        for (int i = 0; i < 3; i++) assert_true(fabs(left[i]) < 1e-14 && fabs(turning[i]) < 1e-14);
        for (size_t row = 0; row < BODIES; row++) {
            scree_vector v[2], w[2];
            scree_body_motion(&state, row, v[0], w[0]);
            scree_body_motion(&still, row, v[1], w[1]);
            for (int i = 0; i < 3; i++) assert_true(fabs(v[0][i] - v[1][i]) < 1e-13 && fabs(w[0][i] - w[1][i]) < 1e-13);
        }
        scree_state_destroy(&rigid);
        scree_state_destroy(&state);
        scree_state_destroy(&still);
    }
}

static double turning_of(const scree_simulation *s)
{
    scree_vector centre, velocity, spin;
    scree_rigid_motion_measure(&s->state, centre, velocity, spin);
    return fabs(spin[2]);
}

/// Polygons between smooth plates lean to and fro a little. Under minimal conditions they do not turn on: what is left
/// is what the forces of the plates do in the one kick that still has them. The energy is accounted for.
static void a_sample_without_plates_does_not_turn(void **unused)
{
    (void)unused;
    scree_case *c = case_read(
        "scree: 1\nname: free\nseed: 5\ngravity: [0, 0]\n"
        "materials: [{name: stone, young_modulus: 1e7 Pa, density: 5000 kg/m3, friction: 0.54, wall_friction: 0, "
        "damping_constant: 0.75}]\n"
        "particles: {shape: polygon, material: stone, thickness: 1 m, count: 50, distribution: uniform, "
        "radius_min: 2 mm, radius_max: 3.5 mm}\n"
        "contact: {law: polygon_overlap}\nintegrator: {step: 1e-5 s}\n"
        "measure: {samples: 40, cells: no}\noutput: {snapshots: 0, paraview: no, figures: no}\n"
        "stages:\n- {stage: prepare, method: growth}\n- {stage: confine, pressure: 10 kPa}\n"
        "- {stage: compress, boundary: minimal, rate: 0.3 1/s, strain: 2 %}\n",
        NULL, 0);
    scree_simulation s;
    double before = 0, after = 0;
    simulation_open(c, 1, &s);
    while (simulation_goes_on(&s)) {
        const bool held = scree_plates(&s.state)[SCREE_WALL_TOP].active;
        if (held) before = turning_of(&s);
        simulation_step(&s);
        if (!held) after = fmax(after, turning_of(&s));
    }
    const double residual = s.sample[SCREE_SAMPLE_ENERGY_RESIDUAL_RELATIVE];
    print_message("turns with %.3g rad/s between plates, with %.3g without; residual %.2g\n", before, after, residual);
    assert_true(before > 0.03); // a tenth of the rate of strain
    assert_true(after < 0.01 * before);
    assert_true(residual < 1e-9); // without the last half of the work of the plates 2e-8
    scree_simulation_close(&s);
    scree_case_free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_rigid_motion_goes_and_nothing_else),
        cmocka_unit_test(a_sample_without_plates_does_not_turn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
