/// A sample of spheres in its membrane, run: bits for threads, lost work and restart; energy; what holds the grains.
#include "testing.h"

#include "boundary/membrane.h"
#include "boundary/sheet.h"
#include "io/snapshot.h"
#include "io_scratch.h"
#include "run/sample.h"
#include "run/simulation.h"
#include "run/step.h"
#include "search/neighbours.h"

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

static scree_case *read_case(const char *const *overrides, size_t count)
{
    scree_case *c = NULL;
    scree_problems *problems = NULL;
    scree_case_options options = {.overrides = overrides, .override_count = count};
    if (scree_case_parse(CASE, strlen(CASE), "wrapped.yaml", &options, &c, &problems)) {
        char line[2048];
        for (size_t k = 0; k < scree_problems_count(problems); k++) {
            scree_error_format(scree_problems_get(problems, k), line, sizeof line);
            print_message("%s\n", line);
        }
        fail_msg("the case of this test is not valid");
    }
    return c;
}

static void check(scree_status status, const scree_error *error)
{
    if (status) fail_msg("status %d: %s", (int)status, error->message);
}

static void step(scree_simulation *s)
{
    scree_error error;
    check(scree_simulation_step(s, &error), &error);
}

/// A new neighbour list, as after a restart.
static void lose_work(scree_simulation *s, int threads)
{
    scree_error error;
    check(scree_contacts_save(&s->state, &s->work, &error), &error);
    scree_contact_scratch_destroy(&s->work);
    scree_work_destroy(&s->work);
    check(scree_work_create(&s->work, &s->model, threads, &error), &error);
}

/// Steps into the last stage.
static uint64_t loaded_steps(const scree_simulation *s)
{
    bool last = s->state.stage.index == 2 && s->state.stage.counter >= 0;
    return last ? s->state.step - s->state.stage.first_step : 0;
}

static uint64_t run_some(int threads, uint64_t steps, uint64_t discard)
{
    scree_case *c = read_case(NULL, 0);
    scree_simulation s;
    scree_error error;
    check(scree_simulation_open(c, threads, &s, &error), &error);
    while (loaded_steps(&s) < steps) {
        step(&s);
        if (discard > 0 && loaded_steps(&s) == discard) lose_work(&s, threads);
    }
    uint64_t checksum = scree_simulation_checksum(&s);
    assert_true(s.state.membrane.count > 100 && s.state.membrane.share > 0);
    scree_simulation_close(&s);
    scree_case_free(c);
    return checksum;
}

static void threads_and_lost_work_give_the_same_bits(void **unused)
{
    (void)unused;
    uint64_t reference = run_some(1, 400, 0);
    assert_true(run_some(2, 400, 0) == reference);
    assert_true(run_some(1, 400, 221) == reference);
}

/// From a state written in the middle of the last stage and read back: everything that contacts remember is in it.
static void check_restart(const char *const *overrides, size_t count, int dimension, bool rolling)
{
    char folder[64];
    assert_true(scratch_create(folder));
    scree_case *c = read_case(overrides, count);
    scree_simulation s[2];
    scree_error error;
    for (int i = 0; i < 2; i++) check(scree_simulation_open(c, 1, &s[i], &error), &error);
    while (loaded_steps(&s[0]) < 400) step(&s[0]);
    scree_state *state = &s[0].state;
    check(scree_contacts_save(state, &s[0].work, &error), &error);
    double stretch = 0, booked = 0;
    for (size_t k = 0; k < state->contact_count; k++) {
        int twist = dimension == 3 ? 3 : 0;
        if (rolling) stretch = fmax(stretch, fabs(state->rolling[k].value[twist]));
        if (dimension == 3) booked = fmax(booked, fabs((double)state->booking[k].value[0]));
    }
    assert_true(state->membrane.count > 0 && (stretch > 0) == rolling && (booked > 0) == (dimension == 3));
    check(scree_checkpoint_write(folder, state, 1, &error), &error);
    check(scree_checkpoint_read(folder, dimension, &s[1].state, 1, &error), &error);
    assert_true(scree_state_checksum(state) == scree_state_checksum(&s[1].state));
    check(scree_neighbours_refresh(&s[1].model, &s[1].state, &s[1].work, &error), &error);
    check(scree_stage_enter(&s[1], true, &error), &error);
    for (int n = 0; n < 300; n++)
        for (int i = 0; i < 2; i++) check(scree_step(&s[i], &error), &error);
    assert_true(scree_simulation_checksum(&s[0]) == scree_simulation_checksum(&s[1]));
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
    const char *const fine[] = {"integrator.step=1e-5 s"};
    scree_case *c = read_case(fine, 1);
    scree_simulation s;
    scree_error error;
    double worst = 0, begin = 0, turnover = 0;
    check(scree_simulation_open(c, 1, &s, &error), &error);
    while (s.state.stage.index < 3) {
        step(&s);
        if (!s.sampled) continue;
        double residual = s.sample.value[SCREE_SAMPLE_ENERGY_RESIDUAL];
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
    assert_true(stored > 0 && work != 0 && s.state.membrane.share > 0.5);
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
    const scree_membrane *membrane = &state->membrane;
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
            scree_body_place(state, scree_membrane_row(state, k), from);
            scree_body_place(state, scree_membrane_row(state, other), edge);
            for (int i = 0; i < 3; i++) edge[i] -= from[i];
            double length = scree_length(edge), stretch = fmax(0, length - membrane->rest[k][n]);
            bool rim = n == 0 && scree_membrane_plate(state, k) >= 0;
            double tension = (rim ? 0.5 : 1) * s->stage_model.membrane_stiffness * stretch;
            add_product(stress, edge, edge, tension / length / volume);
        }
    for (size_t row = 0; row < state->count; row++) {
        const scree_sum_row *sum = &state->sum[row];
        const double force[3] = {(double)sum->fx * quantum, (double)sum->fy * quantum, (double)sum->fz * quantum};
        scree_vector place;
        scree_body_place(state, row, place);
        add_product(inertia, force, place, 1 / volume);
    }
}

/// 150 spheres are shortened by 2 % in their membrane.
static void a_sample_is_held_by_its_membrane(void **unused)
{
    (void)unused;
    const char *const large[] = {"particles.count=150", "stages.compress.strain=2 %"};
    scree_case *c = read_case(large, 2);
    scree_simulation s;
    scree_error error;
    check(scree_simulation_open(c, 1, &s, &error), &error);
    double axial = 0, plates = 0, lateral = 0;
    int samples = 0;
    while (s.state.stage.index < 3) {
        step(&s);
        if (!s.sampled || !(s.sample.value[SCREE_SAMPLE_AXIAL_STRAIN] > 0.01)) continue;
        const double *v = s.sample.value;
        axial += v[SCREE_SAMPLE_AXIAL_CONTACTS];
        plates += v[SCREE_SAMPLE_AXIAL_PLATES];
        lateral += v[SCREE_SAMPLE_LATERAL_CONTACTS];
        samples++;
    }
    check(scree_contact_table_build(&s.model, &s.state, &s.work, &s.table, &error), &error);
    double stress[9], inertia[9], rubbing[9], pressure = s.state.pressure;
    stress_with_membrane(&s, stress, inertia, rubbing);
    double sides = -0.5 * (stress[0] + stress[4]), moving = 0.5 * (inertia[0] + inertia[4]);
    double shear = 0.5 * (rubbing[0] + rubbing[4]);
    print_message("%zu bodies of the membrane; axial stress %.0f Pa from contacts, %.0f Pa from plates; lateral in the "
                  "grains %.0f Pa; on the sides, springs included, %.0f Pa (inertia %.0f, friction of plates %.0f)\n",
                  s.state.membrane.count, axial / samples, plates / samples, lateral / samples, sides, moving, shear);
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
    for (size_t id = 0; id < s.state.grains; id++) {
        scree_vector place;
        scree_body_place(&s.state, s.state.row_of_id[id], place);
        double turns = 0;
        // Winding number of the rings about the axis through the grain: those next to it in height go around it.
        size_t around = s.state.membrane.around, best = 0;
        double nearest = INFINITY;
        for (size_t k = 0; k < s.state.membrane.count; k++) {
            scree_vector member;
            scree_body_place(&s.state, scree_membrane_row(&s.state, k), member);
            if (fabs(member[2] - place[2]) < nearest) nearest = fabs(member[2] - place[2]), best = k / around;
        }
        for (size_t j = 0; j < around; j++) {
            scree_vector a, b;
            scree_body_place(&s.state, scree_membrane_row(&s.state, best * around + j), a);
            scree_body_place(&s.state, scree_membrane_row(&s.state, best * around + (j + 1) % around), b);
            double ax = a[0] - place[0], ay = a[1] - place[1], bx = b[0] - place[0], by = b[1] - place[1];
            turns += atan2(ax * by - ay * bx, ax * bx + ay * by) / (2 * M_PI);
        }
        inside += fabs(turns - 1) < 1e-9;
    }
    assert_int_equal(inside, s.state.grains);
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
