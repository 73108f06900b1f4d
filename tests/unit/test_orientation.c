/// Orientations in 3D: closed forms of rotations about one axis and about one that moves, order, bits, files.
#include "io_scratch.h"
#include "library_fixture.h"

#include "base/fixed.h"
#include "integrate/integrate.h"
#include "integrate/orientation.h"
#include "io/sample_file.h"
#include "run/loading.h"

#include <float.h>

static scree_view orientations(const scree_state *state)
{
    for (size_t k = 0; k < scree_field_total(); k++) {
        const scree_field *field = scree_field_at(k);
        if (strcmp(field->name, "orientation") == 0)
            return (scree_view){.count = scree_field_rows_count(state, field),
                                .data = scree_field_rows_count(state, field) ? scree_field_get(state, field, 0) : NULL};
    }
    fail_msg("there is no field orientation");
    return (scree_view){0};
}

/// That of row 0.
static const double *orientation_of(const scree_state *state)
{
    const scree_view view = orientations(state);
    assert_true(view.count == state->count);
    return view.data;
}

/// Difference of two rotations: of unit quaternions, that is half the angle between them.
static double departure(const double a[4], const double b[4])
{
    double square = 0;
    for (int k = 0; k < 4; k++) square += (a[k] - b[k]) * (a[k] - b[k]);
    return sqrt(square);
}

static double length(const double q[4])
{
    return sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
}

// ---- one axis ----------------------------------------------------------------------------------------------------

#define SPINNING                                                                                                       \
    "scree: 1\nname: spinning\ndimension: 3\n"                                                                         \
    "materials: [{name: quartz, young_modulus: 100 kPa, density: 2650 kg/m3, friction: 0.4}]\n"                        \
    "particles: {shape: sphere, material: quartz, count: 2, distribution: equal, radius: 1 mm}\n"                      \
    "selections: [{select: all, name: all}]\n"                                                                         \
    "loads: [{load: prescribed, selection: all, spin_x: 20 rad/s, spin_y: -30 rad/s, spin_z: 60 rad/s}]\n"             \
    "contact: {reference_velocity: 1e-3 m/s}\nintegrator: {step: 1e-3 s}\nguard: {stability: warn}\n"                  \
    "measure: {cells: no, samples: 10, orientation: yes}\noutput: {figures: no}\n"                                     \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, method: bodies, width: 40 mm, depth: 40 mm, height: 40 mm,\n"                                \
    "     bodies: [{position: [15 mm, 20 mm, 20 mm]}, {position: [25 mm, 20 mm, 20 mm]}]}\n"                           \
    "  - {stage: relax, duration: 1 s, boundary: none}\n"

static const char *const schemes[] = {"integrator.scheme=position_verlet", "integrator.scheme=velocity_verlet"};

/// 70 rad/s for up to 1 s: eleven turns. Each step adds its rounding, some DBL_EPSILON.
static void a_constant_spin_has_the_closed_form(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < sizeof schemes / sizeof *schemes; k++) {
        const double w[3] = {20, -30, 60}, speed = 70;
        scree_case *c = case_read(SPINNING, &schemes[k], 1);
        scree_simulation s;
        simulation_open(c, 1, &s);
        double worst = 0;
        simulation_load(&s);
        const double begin = s.state.stage.first_time;
        while (simulation_goes_on(&s)) {
            simulation_step(&s);
            if (!simulation_goes_on(&s)) break;
            const double half = 0.5 * speed * (scree_state_time(&s.state) - begin);
            const double expected[4] = {cos(half), sin(half) * w[0] / speed, sin(half) * w[1] / speed,
                                        sin(half) * w[2] / speed};
            worst = fmax(worst, departure(orientation_of(&s.state), expected));
            worst = fmax(worst, fabs(length(orientation_of(&s.state)) - 1));
        }
        print_message("%s: departure %.2g\n", schemes[k], worst);
        assert_true(s.state.evaluations > 20 && worst < 1000 * DBL_EPSILON * 4);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

// ---- an axis that moves ------------------------------------------------------------------------------------------

/// q = exp(a t z / 2) exp(b t x / 2), whose spin in space is b (cos a t, sin a t, 0) + a z.
static const double ABOUT_Z = 2, ABOUT_X = 3;

static void spin_at(double t, double w[3])
{
    w[0] = ABOUT_X * cos(ABOUT_Z * t);
    w[1] = ABOUT_X * sin(ABOUT_Z * t);
    w[2] = ABOUT_Z;
}

static void expected_at(double t, double q[4])
{
    const double a = 0.5 * ABOUT_Z * t, b = 0.5 * ABOUT_X * t;
    q[0] = cos(a) * cos(b);
    q[1] = cos(a) * sin(b);
    q[2] = sin(a) * sin(b);
    q[3] = sin(a) * cos(b);
}

/// Inertia times the rate of the spin.
static void set_torque(scree_state *state, double t)
{
    const double inertia = scree_body_inertia(state, 0), inverse = 1 / state->torque_quantum;
    state->torque[0].x = scree_fixed_from(-inertia * ABOUT_X * ABOUT_Z * sin(ABOUT_Z * t), inverse);
    state->torque[0].y = scree_fixed_from(inertia * ABOUT_X * ABOUT_Z * cos(ABOUT_Z * t), inverse);
    state->torque[0].z = 0;
}

/// Error at `time` of a run of `steps` steps.
static double error_of(int scheme, double time, int steps)
{
    scree_model model = {.scheme = scheme, .dimension = 3};
    scree_state state;
    scree_error error;
    scree_work work = {.threads = 1};
    const scree_context context = {.model = &model, .state = &state, .work = &work};
    const double dt = time / steps;
    double q[4], w[3];
    assert_int_equal(scree_state_create(&state, 3, 1, &error), SCREE_OK);
    check(scree_state_begin_field(&state, &scree_module_orientation.fields[0], &error), &error);
    scree_orientation_forget(&state);
    state.step_size = state.kick_size = state.tick = dt;
    state.force_quantum = state.torque_quantum = scree_fixed_quantum(1000);
    state.row[0] = (scree_row){.radius = 0.5, .mass = 2};
    const scree_integrator *integrator = scree_integrator_get(scheme);
    spin_at(-(0.5 - integrator->velocity_lead) * dt, w);
    state.turn[0] = (scree_turn_row){w[0], w[1], w[2], 0};
    set_torque(&state, 0);
    for (int k = 0; k < steps; k++) {
        integrator->first(&model, &state, &work);
        check(scree_module_orientation.passes[0].run(&context, &error), &error);
        set_torque(&state, dt * (k + 1));
        if (integrator->second) integrator->second(&model, &state, &work);
    }
    expected_at(time, q);
    const double worst = departure(orientation_of(&state), q);
    scree_state_destroy(&state);
    return worst;
}

static void a_turning_axis_is_of_second_order(void **unused)
{
    (void)unused;
    for (int scheme = SCREE_SLOT_position_verlet; scheme <= SCREE_SLOT_velocity_verlet; scheme++) {
        const double coarse = error_of(scheme, 3, 300), fine = error_of(scheme, 3, 600);
        print_message("errors %.3g, %.3g: ratio %.4f\n", coarse, fine, coarse / fine);
        // The error of a step of (w dt)^3 / 24 or so adds up; the ratio of the second order is 4.
        assert_true(coarse < pow(5 * 0.01, 2) / 24 * 5 * 3 && fabs(coarse / fine - 4) < 0.05);
    }
}

// ---- runs --------------------------------------------------------------------------------------------------------

#define GAS                                                                                                            \
    "scree: 1\nname: gas\ndimension: 3\nseed: 5\n"                                                                     \
    "materials: [{name: quartz, young_modulus: 100 MPa, density: 2650 kg/m3, friction: 0.5, restitution: 0.8}]\n"      \
    "particles: {shape: sphere, material: quartz, count: 60, radius_min: 0.6 mm, radius_max: 0.9 mm}\n"                \
    "contact: {law: hertz_mindlin, reference_velocity: 1e-3 m/s}\nboundary: {periodic: xyz}\n"                         \
    "integrator: {step: 1e-6 s}\nmeasure: {cells: no, samples: 10, orientation: yes}\n"                                \
    "output: {figures: no, snapshots: 2, paraview: yes}\n"                                                             \
    "stages:\n  - {stage: prepare, method: gas, solid_fraction: 35 %, velocity: 1 m/s}\n"                              \
    "  - {stage: relax, duration: 4 ms}\n"

/// The gas after 800 steps; folder: it goes on from a checkpoint in mid-way.
static uint64_t bits_of(const scree_case *c, int threads, const char *folder, uint64_t *checksum)
{
    scree_simulation s, other;
    simulation_open(c, threads, &s);
    s.work.keep_threads = true;
    simulation_load(&s);
    for (int k = 0; k < 400; k++) simulation_step(&s);
    if (folder) {
        simulation_reopen(&s, threads, folder, &other);
        scree_simulation_close(&s);
        s = other;
    }
    for (int k = 0; k < 400; k++) simulation_step(&s);
    double most = 0;
    const scree_view view = orientations(&s.state);
    for (size_t row = 0; row < view.count; row++) most = fmax(most, 1 - fabs(((const double(*)[4])view.data)[row][0]));
    const uint64_t bits = simulation_bits(&s);
    *checksum = scree_state_checksum(&s.stage_model, &s.state);
    scree_simulation_close(&s);
    // Collisions have turned them: without the switch nothing is kept.
    assert_true((view.count > 0) == (most > 1e-3));
    return bits;
}

static void bits_do_not_depend_on_threads_or_restarts(void **unused)
{
    (void)unused;
    uint64_t checksum[4], without;
    scree_case *c = case_read(GAS, NULL, 0);
    const uint64_t bits = bits_of(c, 1, NULL, &checksum[0]);
    assert_true(bits == bits_of(c, 2, NULL, &checksum[1]) && bits == bits_of(c, 7, NULL, &checksum[2]));
    assert_true(bits == bits_of(c, 2, scratch, &checksum[3]));
    for (int k = 1; k < 4; k++) assert_true(checksum[k] == checksum[0]);
    scree_case_free(c);
    // It is part of the checksum where it is kept.
    const char *const off[] = {"measure.orientation=no"};
    c = case_read(GAS, off, 1);
    (void)bits_of(c, 1, NULL, &without);
    assert_true(without != checksum[0]);
    scree_case_free(c);
}

/// Whether a file holds a text.
static bool holds(const char *folder, const char *name, const char *text)
{
    char path[256], *all = NULL;
    size_t size = 0;
    (void)snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_true(getdelim(&all, &size, EOF, file) >= 0);
    (void)fclose(file);
    const bool found = strstr(all, text) != NULL;
    free(all);
    return found;
}

/// What averages read of the last snapshot: rotations as the bodies have turned, from the begin of the run on.
static void check_sample(const char *folder, bool kept)
{
    scree_average_sample sample;
    scree_error error;
    size_t count;
    double most = 0;
    check(scree_snapshot_count(folder, &count, &error), &error);
    check(scree_sample_read(folder, (int64_t)count - 1, &sample, &error), &error);
    assert_true(sample.bodies == 60 && (sample.orientation != NULL) == kept && sample.turned_since == 0);
    for (size_t p = 0; p < sample.bodies && kept; p++) {
        assert_true(fabs(length(sample.orientation[p]) - 1) < 1e-14);
        most = fmax(most, 1 - fabs(sample.orientation[p][0]));
    }
    assert_true((most > 1e-9) == kept);
    scree_average_sample_destroy(&sample);
}

static void files_have_it_where_it_is_kept(void **unused)
{
    (void)unused;
    for (int kept = 0; kept < 2; kept++) {
        const char *const overrides[] = {kept ? "measure.orientation=yes" : "measure.orientation=no",
                                         "stages.relax.duration=0.4 ms"};
        char folder[96];
        scree_error error;
        scree_case *c = case_read(GAS, overrides, 2);
        (void)snprintf(folder, sizeof folder, "%s/run%d", scratch, kept);
        const scree_run_options options = {.output = folder, .threads = 1, .force = true};
        check(scree_run(c, &options, &error), &error);
        assert_int_equal(holds(folder, "paraview/spheres-000002.vtp", "Name=\"orientation\" NumberOfComponents=\"4\""),
                         kept);
        check_sample(folder, kept);
        scree_case_free(c);
    }
}

static void programs_see_it(void **unused)
{
    (void)unused;
    scree_case *c = case_read(GAS, NULL, 0);
    scree_error error;
    scree_simulation *s = library_create(c);
    while (!s->stage || !s->stage->loading) (void)library_advance(s, 1);
    (void)library_advance(s, 400);
    scree_view view;
    check(scree_simulation_view(s, "orientation", &view, &error), &error);
    assert_true(view.count == 60 && view.components == 4 && view.type == SCREE_FIELD_DOUBLE);
    const double(*q)[4] = (const double(*)[4])view.data;
    for (size_t row = 0; row < view.count; row++) assert_true(fabs(length(q[row]) - 1) < 1e-14);
    scree_simulation_free(s);
    scree_case_free(c);
}

/// A loading that begins sets them to zero and says when; what follows counts from there.
static void rotations_begin_anew(void **unused)
{
    (void)unused;
    scree_case *c = case_read(GAS, NULL, 0);
    scree_simulation s;
    simulation_open(c, 1, &s);
    simulation_load(&s);
    assert_true(s.state.turned_since == 0);
    for (int k = 0; k < 400; k++) simulation_step(&s);
    const double time = scree_state_time(&s.state);
    double most = 0;
    for (size_t row = 0; row < s.state.count; row++)
        most = fmax(most, length(scree_orientations(&s.state)[row]) - fabs(scree_orientations(&s.state)[row][0]));
    assert_true(most > 1e-9 && time > 0);
    scree_rotations_begin(&s.state);
    assert_true(s.state.turned_since == time);
    for (size_t row = 0; row < s.state.count; row++)
        assert_true(departure(scree_orientations(&s.state)[row], (const double[4]){1}) == 0);
    scree_simulation_close(&s);
    scree_case_free(c);
}

static void in_the_plane_there_is_the_angle(void **unused)
{
    (void)unused;
    const char *const overrides[] = {"dimension=2", "particles.shape=disc", "boundary.periodic=xy"};
    scree_case *c;
    scree_problems *problems;
    assert_true(case_parse(GAS, overrides, 3, &c, &problems) != SCREE_OK);
    bool said = false;
    for (size_t k = 0; k < scree_problems_count(problems); k++)
        said = said || strstr(scree_problems_get(problems, k)->message, "quaternions are of spheres");
    assert_true(said);
    scree_problems_free(problems);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_constant_spin_has_the_closed_form),
        cmocka_unit_test(a_turning_axis_is_of_second_order),
        cmocka_unit_test_setup_teardown(bits_do_not_depend_on_threads_or_restarts, make_scratch, remove_scratch),
        cmocka_unit_test_setup_teardown(files_have_it_where_it_is_kept, make_scratch, remove_scratch),
        cmocka_unit_test(programs_see_it),
        cmocka_unit_test(rotations_begin_anew),
        cmocka_unit_test(in_the_plane_there_is_the_angle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
