/// A sample of spheres in its membrane, run: bits for threads, lost work and restart; energy; what holds the grains.
#include "run_fixture.h"

#include "boundary/membrane.h"
#include "boundary/sheet.h"
#include "io_scratch.h"
#include "measure/delaunay_boundary.h"
#include "run/step.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

#define CASE                                                                                                           \
    "scree: 1\n"                                                                                                       \
    "name: wrapped\n"                                                                                                  \
    "dimension: 3\n"                                                                                                   \
    "seed: 3\n"                                                                                                        \
    "gravity: [0, 0, 0]\n"                                                                                             \
    "materials:\n"                                                                                                     \
    "  - {name: quartz, young_modulus: 30 GPa, density: 2.675e8 kg/m3, friction: 0.45, restitution: 0.2}\n"            \
    "particles: {shape: sphere, material: quartz, count: 60, radius_min: 0.6 mm, radius_max: 0.9 mm}\n"                \
    "contact: {law: hertz_mindlin, reference_velocity: 1e-4 m/s}\n"                                                    \
    "integrator: {scheme: velocity_verlet, step: 2e-5 s}\n"                                                            \
    "boundary: {every: 100}\n"                                                                                         \
    "measure: {samples: 20}\n"                                                                                         \
    "output: {snapshots: 2, paraview: no, figures: no, checkpoint_steps: 0}\n"                                         \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, aspect_ratio: 1.5}\n"                                                                        \
    "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 2e-1, ramp_time: 0.1 s}\n"                              \
    "  - {stage: compress, strain: 0.5 %, rate: 0.2 1/s, boundary: membrane}\n"

/// Checksum after `steps` steps of the last stage from its begin; the work is lost after `discard` of them.
static uint64_t run_some(scree_simulation *begin, const char *folder, int threads, uint64_t steps, uint64_t discard)
{
    scree_simulation s;
    simulation_reopen(begin, threads, folder, &s);
    while (simulation_last_steps(&s) < steps) {
        simulation_step(&s);
        if (discard > 0 && simulation_last_steps(&s) == discard) simulation_lose_work(&s, threads);
    }
    assert_true(scree_membrane_of(&s.state)->count > 100 && scree_delaunay_boundary_of(&s.state)->taken_over > 0);
    return simulation_close(&s);
}

static void threads_and_lost_work_give_the_same_bits(void **unused)
{
    (void)unused;
    char folder[64];
    assert_true(scratch_create(folder));
    scree_case *c = case_read(CASE, NULL, 0);
    scree_simulation s;
    simulation_open(c, 1, &s);
    simulation_load(&s);
    uint64_t reference = run_some(&s, folder, 1, 400, 0);
    assert_true(run_some(&s, folder, 2, 400, 0) == reference);
    assert_true(run_some(&s, folder, 1, 400, 221) == reference);
    scree_simulation_close(&s);
    scree_case_free(c);
    scratch_destroy(folder);
}

/// From a state written in the middle of the last stage and read back: everything that contacts remember is in it.
static void check_restart(const char *const *overrides, size_t count, int dimension, bool rolling)
{
    char folder[64];
    assert_true(scratch_create(folder));
    scree_case *c = case_read(CASE, overrides, count);
    scree_simulation s[2];
    scree_error error;
    simulation_open(c, 1, &s[0]);
    while (simulation_last_steps(&s[0]) < 400) simulation_step(&s[0]);
    simulation_reopen(&s[0], 1, folder, &s[1]);
    const scree_state *state = &s[0].state;
    double stretch = 0, last = 0;
    for (size_t k = 0; k < state->contact_count; k++) {
        int twist = dimension == 3 ? 3 : 0;
        if (rolling) stretch = fmax(stretch, fabs(state->rolling[k].value[twist]));
        if (dimension == 3) last = fmax(last, fabs((double)state->last_force[k].value[0]));
    }
    assert_true(scree_membrane_of(state)->count > 0 && (stretch > 0) == rolling && (last > 0) == (dimension == 3));
    for (int n = 0; n < 300; n++)
        for (int i = 0; i < 2; i++) check(scree_step(&s[i], &error), &error);
    assert_true(simulation_bits(&s[0]) == simulation_bits(&s[1]));
    for (int i = 0; i < 2; i++) scree_simulation_close(&s[i]);
    scree_case_free(c);
    scratch_destroy(folder);
}

static void a_checkpoint_in_the_middle_gives_the_same_bits(void **unused)
{
    (void)unused;
    check_restart(NULL, 0, 3, false);
}

static void a_checkpoint_keeps_rolling_and_booking(void **unused)
{
    (void)unused;
    static const char *const turning[] = {"materials.quartz.rolling_friction=0.1",
                                          "materials.quartz.twisting_friction=0.1"};
    check_restart(turning, 2, 3, true);
    static const char *const plane[] = {"materials.quartz.rolling_friction=0.1", "dimension=2", "particles.shape=disc"};
    check_restart(plane, 3, 2, true);
}

static void the_energy_balance_closes(void **unused)
{
    (void)unused;
    // At 1e-5 s the residual of this short stage is anything from 0.5e-6 to 8e-6 as the step is varied by a few
    // percent.
    const char *const fine[] = {"integrator.step=5e-6 s"};
    scree_case *c = case_read(CASE, fine, 1);
    scree_simulation s;
    double worst = 0, begin = 0, turnover = 0;
    simulation_open(c, 1, &s);
    while (s.state.stage.index < 3) {
        simulation_step(&s);
        if (!s.sampled) continue;
        double residual = s.sample[SCREE_SAMPLE_ENERGY_RESIDUAL];
        if (s.state.stage.index < 2) begin = residual, turnover = s.state.ledger.turnover;
        if (s.state.stage.index == 2) worst = fmax(worst, fabs(residual - begin));
    }
    worst /= s.state.ledger.turnover - turnover;
    double stored = scree_membrane_energy(&s.stage_model, &s.state), work = s.state.ledger.boundary;
    print_message(
        "energy residual over work of the last stage %.3g; springs hold %.3g J, the boundary's work is %.3g J\n", worst,
        stored, work);
    // The bound that the program promises for history laws.
    assert_true(worst < 1e-6);
    assert_true(stored > 0 && work != 0 && scree_delaunay_boundary_of(&s.state)->taken_over > 0.5);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// sum_ij += a_i b_j
static void add_product(double sum[9], const double a[3], const double b[3], double factor)
{
    for (int i = 0; i < 9; i++) sum[i] += factor * a[i / 3] * b[i % 3];
}

/// Stress of the sample with its membrane, tension positive, in the volume that the membrane encloses: contacts of all
/// bodies and tension of the springs. `inertia`: sum of resultants times places over the volume; `rubbing`: friction of
/// the plates times places.
static void stress_with_membrane(scree_simulation *s, double stress[9], double inertia[9], double rubbing[9])
{
    const scree_state *state = &s->state;
    const scree_membrane *membrane = scree_membrane_of(state);
    double volume = scree_membrane_volume(&s->stage_model, state), quantum = state->force_quantum;
    for (int i = 0; i < 9; i++) stress[i] = inertia[i] = rubbing[i] = 0;
    for (size_t k = 0; k < s->table.count; k++) {
        const scree_contact *contact = &s->table.contact[k];
        double force[3];
        for (int i = 0; i < 3; i++)
            force[i] = contact->normal_force * contact->normal[i] + contact->tangential_force * contact->tangent[i];
        add_product(stress, force, contact->branch, -1 / volume);
        if (contact->wall) add_product(rubbing, force, contact->point, 1 / volume);
    }
    for (size_t k = 0; k < membrane->count; k++)
        for (int n = 0; n < SCREE_SHEET_SPRINGS; n++) {
            size_t other = scree_sheet_neighbour(membrane->around, membrane->count, k, n);
            if (other == SIZE_MAX) continue;
            scree_vector from, edge;
            scree_body_position(state, scree_membrane_row(state, k), from);
            scree_body_position(state, scree_membrane_row(state, other), edge);
            for (int i = 0; i < 3; i++) edge[i] -= from[i];
            double length = scree_length(edge), stretch = fmax(0, length - membrane->rest[k][n]);
            bool rim = n == 0 && scree_membrane_plate(state, k) >= 0;
            double tension = (rim ? 0.5 : 1) * scree_membrane_numbers_of(&s->stage_model)->stiffness * stretch;
            add_product(stress, edge, edge, tension / length / volume);
        }
    for (size_t row = 0; row < state->count; row++) {
        const scree_sum_row *sum = &state->sum[row];
        const double force[3] = {(double)sum->fx * quantum, (double)sum->fy * quantum, (double)sum->fz * quantum};
        scree_vector place;
        scree_body_position(state, row, place);
        add_product(inertia, force, place, 1 / volume);
    }
}

/// 150 spheres are shortened by 2 % in their membrane.
static void a_sample_is_held_by_its_membrane(void **unused)
{
    (void)unused;
    const char *const large[] = {"particles.count=150", "stages.compress.strain=2 %"};
    scree_case *c = case_read(CASE, large, 2);
    scree_simulation s;
    scree_error error;
    simulation_open(c, 1, &s);
    double axial = 0, plates = 0, lateral = 0;
    int samples = 0;
    while (s.state.stage.index < 3) {
        simulation_step(&s);
        if (!s.sampled || !(s.sample[SCREE_SAMPLE_AXIAL_STRAIN] > 0.01)) continue;
        const double *v = s.sample;
        axial += v[SCREE_SAMPLE_AXIAL_CONTACTS];
        plates += v[SCREE_SAMPLE_AXIAL_PLATES];
        lateral += v[SCREE_SAMPLE_LATERAL_CONTACTS];
        samples++;
    }
    check(scree_contact_table_build(&s.model, &s.state, &s.work, &s.table, &error), &error);
    double stress[9], inertia[9], rubbing[9], pressure = scree_pressure_now(&s.state);
    stress_with_membrane(&s, stress, inertia, rubbing);
    double sides = -0.5 * (stress[0] + stress[4]), moving = 0.5 * (inertia[0] + inertia[4]);
    double shear = 0.5 * (rubbing[0] + rubbing[4]);
    print_message("%zu bodies of the membrane; axial stress %.0f Pa from contacts, %.0f Pa from plates; lateral in the "
                  "grains %.0f Pa; on the sides, springs included, %.0f Pa (inertia %.0f, friction of plates %.0f)\n",
                  scree_membrane_of(&s.state)->count, axial / samples, plates / samples, lateral / samples, sides,
                  moving, shear);
    // An identity: springs, contacts and pressure are all the forces there are. Round-off of 5000 contacts, and of
    // quanta of 2^-40 of the largest force.
    assert_true(fabs(sides - moving + shear - pressure) < 1e-8 * pressure);
    // What is left is inertia and the friction of the plates, at this rate a few percent.
    assert_true(fabs(sides - pressure) < 0.1 * pressure);
    // The same of the plates: mean over the second half, with the inertia of a fast compression.
    assert_true(fabs(axial / plates - 1) < 0.1);
    // The sheet runs outside the centres of the grains and presses with p on its own, larger surface.
    assert_true(lateral / samples > pressure && lateral / samples < 3 * pressure);
    // No grain is out: none is farther from the axis than the bodies of the membrane nearest to it in height.
    double hole = scree_sheet_hole(&s.state);
    assert_true(hole < s.model.radius_min);
    size_t inside = 0;
    for (size_t id = 0; id < scree_grain_count(&s.state); id++) {
        scree_vector place;
        scree_body_position(&s.state, s.state.row_of_id[id], place);
        double turns = 0;
        // Winding number of the rings about the axis through the grain: those next to it in height go around it.
        size_t around = scree_membrane_of(&s.state)->around, best = 0;
        double nearest = INFINITY;
        for (size_t k = 0; k < scree_membrane_of(&s.state)->count; k++) {
            scree_vector member;
            scree_body_position(&s.state, scree_membrane_row(&s.state, k), member);
            if (fabs(member[2] - place[2]) < nearest) nearest = fabs(member[2] - place[2]), best = k / around;
        }
        for (size_t j = 0; j < around; j++) {
            scree_vector a, b;
            scree_body_position(&s.state, scree_membrane_row(&s.state, best * around + j), a);
            scree_body_position(&s.state, scree_membrane_row(&s.state, best * around + (j + 1) % around), b);
            double ax = a[0] - place[0], ay = a[1] - place[1], bx = b[0] - place[0], by = b[1] - place[1];
            turns += atan2(ax * by - ay * bx, ax * bx + ay * by) / (2 * M_PI);
        }
        inside += fabs(turns - 1) < 1e-9;
    }
    assert_int_equal(inside, scree_grain_count(&s.state));
    scree_simulation_close(&s);
    scree_case_free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_and_lost_work_give_the_same_bits),
        cmocka_unit_test(a_checkpoint_in_the_middle_gives_the_same_bits),
        cmocka_unit_test(a_checkpoint_keeps_rolling_and_booking),
        cmocka_unit_test(the_energy_balance_closes),
        cmocka_unit_test(a_sample_is_held_by_its_membrane),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
