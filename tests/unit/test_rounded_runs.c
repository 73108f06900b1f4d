/// Polygons with rounded corners in runs, under the laws of springs: they slide, stand, topple, rock and bounce as
/// closed forms say; momentum and energy are kept, with the order of the scheme; discs, walls and periodic cells among
/// them; nothing but the state decides; what does not go together is said.
#include "run_fixture.h"

#include "contact/contact.h"
#include "run/step.h"
#include "shape/polygons.h"
#include "shape/rounding.h"

// ---- cases ---------------------------------------------------------------------------------------------------------

#define COUNT_OF(list) (sizeof(list) / sizeof *(list))

#define QUIET          "measure: {samples: 50, cells: no}\noutput: {figures: no, paraview: no}\n"

/// One square on a floor; gravity is turned in place of the floor. Its core has a side of SIDE, its corners 2 mm.
#define SIDE 13.821136179958e-3 /* m: side^2 + 4 side 2 mm + pi (2 mm)^2 = pi (1 cm)^2 */
static const char one_text[] =
    "scree: 1\nname: one\ndimension: 2\ngravity: [0, -10]\n"
    "materials:\n"
    "  - {name: stone, young_modulus: 1e7 Pa, density: 2500 kg/m3, friction: 0.5, restitution: 0.3}\n"
    "particles: {shape: polygon, outline: given, corners: [[0, 0], [1, 0], [1, 1], [0, 1]], rounding: 0.2,\n"
    "            thickness: 1 m, material: stone, count: 1, distribution: equal, radius: 1 cm}\n"
    "contact: {law: linear}\n"
    "integrator: {scheme: velocity_verlet, step: 4e-6 s}\n"
    "walls:\n  - {shape: plane, name: floor, point: [0, 0], normal: [0, 1]}\n" QUIET "stages:\n"
    "  - {stage: prepare, method: bodies, width: 1 m, height: 1 m, bodies: [{position: [0.5 m, 8.911e-3 m]}]}\n"
    "  - {stage: relax, boundary: walls, duration: 0.2 s}\n";

/// A gas between three walls.
#define GAS(particles)                                                                                                 \
    "scree: 1\nname: gas\ndimension: 2\nseed: 3\ngravity: [0, -10]\n"                                                  \
    "materials:\n  - {name: stone, young_modulus: 1e7 Pa, density: 5000 kg/m3, friction: 0.5, restitution: "           \
    "0.5}\n" particles "contact: {law: linear}\nintegrator: {scheme: velocity_verlet, step: 5e-6 s}\n"                 \
    "walls:\n"                                                                                                         \
    "  - {shape: plane, point: [0, 0], normal: [0, 1]}\n"                                                              \
    "  - {shape: plane, point: [0, 0], normal: [1, 0]}\n"                                                              \
    "  - {shape: plane, point: [32 mm, 0], normal: [-1, 0]}\n" QUIET "stages:\n"                                       \
    "  - {stage: prepare, method: gas, width: 32 mm, solid_fraction: 30 %, velocity: 0.5 m/s}\n"                       \
    "  - {stage: relax, boundary: walls, duration: 0.06 s}\n"
static const char gas_text[] =
    GAS("particles: {shape: polygon, rounding: 0.2, thickness: 1 m, material: stone, count: 24,\n"
        "            distribution: uniform, radius_min: 2 mm, radius_max: 3 mm}\n");
static const char mixed_text[] =
    GAS("particles:\n  thickness: 1 m\n  count: 24\n  species:\n"
        "  - {name: grains, shape: polygon, rounding: 0.3, material: stone, share: 0.5, distribution: equal, radius: 2 "
        "mm}\n"
        "  - {name: discs, shape: disc, material: stone, share: 0.5, distribution: equal, radius: 2.5 mm}\n");

static scree_simulation open_with(const char *text, const char *const *overrides, size_t count, scree_case **c)
{
    scree_simulation s;
    *c = case_read(text, overrides, count);
    simulation_open(*c, 1, &s);
    return s;
}

static void close_both(scree_simulation *s, scree_case *c)
{
    scree_simulation_close(s);
    scree_case_free(c);
}

// ---- one square on a floor -----------------------------------------------------------------------------------------

/// Mass and inertia are those of the rounded square, and what the floor bears is the weight.
static void the_floor_bears_the_weight(void **unused)
{
    (void)unused;
    scree_case *c;
    scree_simulation s = open_with(one_text, NULL, 0, &c);
    (void)simulation_finish(&s);
    const double mass = scree_body_mass(&s.state, 0), force = scree_case_walls(&s.state)->load[0].force[1];
    assert_true(fabs(mass / (2500 * M_PI * 1e-4) - 1) < 1e-12);
    const double square[4][2] = {{0, 0}, {SIDE, 0}, {SIDE, SIDE}, {0, SIDE}};
    const scree_polygon_measures m = scree_rounding_measure(4, square, 2e-3);
    assert_true(fabs(m.radius / 1e-2 - 1) < 1e-6);
    assert_true(fabs(scree_body_inertia(&s.state, 0) / (2500 * (m.moment[0] + m.moment[1])) - 1) < 1e-6);
    print_message("floor bears %.12f of the weight, angle %.3g\n", -force / (10 * mass), s.state.angle[0]);
    assert_true(fabs(force / (10 * mass) + 1) < 1e-6);
    // Two springs of k = E thickness share the weight.
    const double depth = SIDE / 2 + 2e-3 - s.state.row[0].y;
    assert_true(fabs(depth / (10 * mass / (2 * 1e7)) - 1) < 1e-4);
    close_both(&s, c);
}

/// Runs to the end under gravity turned by `slope` [degrees] against the floor.
static scree_simulation slide(double slope, const char *friction, scree_case **c)
{
    char gravity[96];
    const double a = slope * M_PI / 180;
    (void)snprintf(gravity, sizeof gravity, "gravity=[%.17g, %.17g]", 10 * sin(a), -10 * cos(a));
    const char *const overrides[] = {gravity, friction};
    scree_simulation s = open_with(one_text, overrides, COUNT_OF(overrides), c);
    (void)simulation_finish(&s);
    return s;
}

/// On a face, whose force is two springs' and whose friction is theirs, too.
static void it_slides_as_coulomb_says(void **unused)
{
    (void)unused;
    scree_case *c;
    scree_vector velocity, spin;
    scree_simulation s = slide(20, "materials.0.friction=0.2", &c);
    const double a = 20 * M_PI / 180, expected = 10 * (sin(a) - 0.2 * cos(a)) * 0.2;
    scree_body_velocity(&s.model, &s.state, 0, velocity, spin);
    print_message("velocity %.6f m/s, expected %.6f; spin %.3g rad/s\n", velocity[0], expected, spin[2]);
    // No dashpot of the normal force damps that it rocks on its face: by 1 um at the ends, here.
    assert_true(fabs(velocity[0] / expected - 1) < 2e-3 && fabs(spin[2]) < 0.05);
    close_both(&s, c);
    s = slide(10, "materials.0.friction=0.2", &c);
    scree_body_velocity(&s.model, &s.state, 0, velocity, spin);
    assert_true(fabs(velocity[0]) < 1e-6);
    close_both(&s, c);
}

/// It stands as long as its centre is above the corner of the core on which it turns: tan = side / (side + 2 r), here
/// 37.80 degrees.
static void it_topples_where_its_centre_passes_a_corner(void **unused)
{
    (void)unused;
    const double limit = atan(SIDE / (SIDE + 4e-3)) * 180 / M_PI;
    scree_case *c;
    // Gravity that is turned at once makes it rock, so that it has to be well below.
    scree_simulation s = slide(0.7 * limit, "materials.0.friction=2", &c);
    print_message("limit %.2f degrees; below: angle %.3g\n", limit, s.state.angle[0]);
    assert_true(fabs(s.state.angle[0]) < 1e-3);
    close_both(&s, c);
    s = slide(limit + 1, "materials.0.friction=2", &c);
    assert_true(s.state.angle[0] < -0.02);
    close_both(&s, c);
}

// ---- energy and momentum -------------------------------------------------------------------------------------------

#define LOSSLESS "materials.0.friction=0", "materials.0.restitution=1"

static double residual_of(const char *text, const char *const *overrides, size_t count)
{
    scree_case *c;
    scree_simulation s = open_with(text, overrides, count, &c);
    const double worst = simulation_finish(&s);
    close_both(&s, c);
    return worst;
}

/// A square let go at a tilt rocks from corner to corner and jumps, undamped and without friction: the residual of the
/// balance is of second order in the step, through every turn of the face through parallel.
static void rocking_keeps_its_energy(void **unused)
{
    (void)unused;
    const char *const coarse[] = {LOSSLESS, "stages.0.bodies=[{position: [0.5 m, 10.5 mm], angle: 0.1}]"};
    const char *const fine[] = {LOSSLESS, "stages.0.bodies=[{position: [0.5 m, 10.5 mm], angle: 0.1}]",
                                "integrator.step=1.25e-6 s"};
    const double first = residual_of(one_text, coarse, COUNT_OF(coarse)),
                 second = residual_of(one_text, fine, COUNT_OF(fine));
    print_message("rocking: residual %.3g, with a quarter of the step %.3g\n", first, second);
    assert_true(first < 1e-3 && second < first / 8);
}

/// A gas of them, and of them and discs, under springs of two laws.
static void a_gas_keeps_its_energy(void **unused)
{
    (void)unused;
    static const char *const laws[] = {"contact.law=linear", "contact.law=hertz_mindlin"};
    static const char *const stiffness[] = {"materials.0.young_modulus=1e7 Pa", "materials.0.young_modulus=1e10 Pa"};
    for (int mixed = 0; mixed < 2; mixed++)
        for (int law = 0; law < 2; law++) {
            const char *const coarse[] = {LOSSLESS, laws[law], stiffness[law]};
            const char *const fine[] = {LOSSLESS, laws[law], stiffness[law], "integrator.step=1.25e-6 s"};
            const char *text = mixed ? mixed_text : gas_text;
            const double first = residual_of(text, coarse, 4), second = residual_of(text, fine, 5);
            print_message("%s, %s: residual %.3g, with a quarter of the step %.3g\n", mixed ? "discs too" : "polygons",
                          laws[law], first, second);
            assert_true(first < 6e-4 && second < first / 5);
        }
}

/// With friction and dashpots, whose forces jump, the balance closes to less than the first order.
static void losses_are_booked(void **unused)
{
    (void)unused;
    const char *const fine[] = {"integrator.step=1.25e-6 s"};
    const char *const mindlin[] = {"integrator.step=1.25e-6 s", "contact.law=hertz_mindlin",
                                   "materials.0.young_modulus=1e10 Pa"};
    const double linear = residual_of(mixed_text, fine, 1), hertz = residual_of(gas_text, mindlin, 3);
    print_message("with friction and damping: residual %.3g, hertz_mindlin %.3g\n", linear, hertz);
    assert_true(linear < 1e-4 && hertz < 1e-4);
}

/// A pair in free space: linear and angular momentum, off the centre, with friction and damping.
static void momentum_is_kept(void **unused)
{
    (void)unused;
    scree_case *c;
    const char *const overrides[] = {
        "gravity=[0, 0]", "particles.count=2",
        ("stages.0.bodies=[{position: [0.5 m, 0.5 m], spin: [0, 0, 30]}, {position: [0.522 m, "
         "0.507 m], velocity: [-1, 0.2], angle: 0.3}]"),
        "stages.1.duration=0.01 s"};
    scree_simulation s = open_with(one_text, overrides, COUNT_OF(overrides), &c);
    double before[3] = {0}, after[3] = {0};
    for (int pass = 0; pass < 2; pass++) {
        double *sum = pass ? after : before;
        if (pass) (void)simulation_finish(&s);
        while (!pass && s.state.stage.index < 1) simulation_step(&s);
        for (size_t row = 0; row < s.state.count; row++) {
            const scree_row *body = &s.state.row[row];
            scree_vector velocity, spin;
            scree_body_velocity(&s.model, &s.state, row, velocity, spin);
            sum[0] += body->mass * velocity[0];
            sum[1] += body->mass * velocity[1];
            sum[2] += body->mass * (body->x * velocity[1] - body->y * velocity[0]) +
                      scree_body_inertia(&s.state, row) * spin[2];
        }
    }
    print_message("momentum %.17g %.17g %.17g\n", after[0], after[1], after[2]);
    assert_true(s.state.ledger.damping > 0 && s.state.ledger.friction > 0);
    for (int k = 0; k < 2; k++) assert_true(fabs(after[k] - before[k]) < 1e-12 * fabs(before[0]));
    assert_true(fabs(after[2] - before[2]) < 1e-9 * fabs(before[2]));
    close_both(&s, c);
}

/// Two squares meet face on face, centred: restitution is that of the law, though four corners share the contact.
static void faces_bounce_as_the_law_says(void **unused)
{
    (void)unused;
    scree_case *c;
    const char *const overrides[] = {"gravity=[0, 0]", "particles.count=2", "integrator.step=1e-6 s",
                                     ("stages.0.bodies=[{position: [0.5 m, 0.5 m]}, {position: [0.524 m, 0.5 m], "
                                      "velocity: [-0.1, 0]}]"),
                                     "stages.1.duration=0.08 s"};
    scree_simulation s = open_with(one_text, overrides, COUNT_OF(overrides), &c);
    (void)simulation_finish(&s);
    const double restitution = (s.state.row[1].vx - s.state.row[0].vx) / 0.1;
    print_message("restitution %.5f, spins %.3g %.3g\n", restitution, s.state.row[0].spin, s.state.row[1].spin);
    assert_true(fabs(restitution - 0.3) < 2e-3);
    assert_true(fabs(s.state.row[0].spin) < 1e-9 && fabs(s.state.row[1].spin) < 1e-9);
    close_both(&s, c);
}

// ---- walls and cells -----------------------------------------------------------------------------------------------

/// On a solid wall with a sharp corner, that moves and turns: the balance closes with its work, with the order of the
/// scheme.
static void solid_walls_do_work(void **unused)
{
    (void)unused;
    static const char walls[] =
        "walls=[{shape: box, lower: [0, -14 mm], upper: [32 mm, 100 mm]}, "
        "{shape: polygon, name: wedge, corners: [[12 mm, -15 mm], [26 mm, -15 mm], [20 mm, -2 mm]]}, "
        "{shape: polygon, name: paddle, corners: [[2 mm, -8 mm], [9 mm, -8 mm], [10 mm, -6 mm], [6 mm, -4 mm], "
        "[2 mm, -5 mm]], spin: [0, 0, 30], centre: [6 mm, -6 mm], motion: vibration, amplitude: [0, 0.5 mm], "
        "frequency: 40 1/s}]";
    const char *const coarse[] = {LOSSLESS, walls}, *const fine[] = {LOSSLESS, walls, "integrator.step=1.25e-6 s"};
    const double first = residual_of(mixed_text, coarse, 3), second = residual_of(mixed_text, fine, 4);
    print_message("beside moving walls: residual %.3g, with a quarter of the step %.3g\n", first, second);
    assert_true(first < 1e-3 && second < first / 5);
}

/// In a periodic cell under pressure: contact forces add up to nothing, to the bit, and the balance closes.
static void a_periodic_cell_holds_them(void **unused)
{
    (void)unused;
    static const char text[] =
        "scree: 1\nname: cell\ndimension: 2\nseed: 3\ngravity: [0, 0]\n"
        "materials:\n  - {name: stone, young_modulus: 1e7 Pa, density: 2500 kg/m3, friction: 0.5}\n"
        "particles: {shape: polygon, rounding: 0.2, thickness: 1 m, material: stone, count: 40, distribution: "
        "uniform,\n"
        "            radius_min: 2 mm, radius_max: 3 mm}\n"
        "contact: {law: linear}\nboundary: {periodic: xy}\n" QUIET
        "stages:\n  - {stage: prepare, method: gas, solid_fraction: 50 %, velocity: 0.1 m/s}\n"
        "  - {stage: confine, pressure: 20 kPa}\n";
    scree_case *c;
    scree_simulation s = open_with(text, NULL, 0, &c);
    uint64_t sum[2] = {0};
    const double worst = simulation_finish(&s);
    size_t contacts = 0;
    for (size_t row = 0; row < s.state.count; row++) {
        sum[0] += (uint64_t)s.state.sum[row].fx;
        sum[1] += (uint64_t)s.state.sum[row].fy;
        contacts += (size_t)s.state.sum[row].contacts;
    }
    print_message("%zu contacts, residual %.3g\n", contacts, worst);
    assert_true(sum[0] == 0 && sum[1] == 0 && contacts > 80);
    assert_true(worst < 1e-3);
    close_both(&s, c);
}

// ---- nothing but the state -----------------------------------------------------------------------------------------

enum { FORGET = 1, LOSE = 2 };

static uint64_t bits_of(const char *text, const char *const *overrides, size_t count, int threads, int disturbance)
{
    scree_case *c;
    scree_simulation s = open_with(text, overrides, count, &c);
    simulation_lose_work(&s, threads);
    s.work.keep_threads = true;
    for (int k = 0; k < 6000 && simulation_goes_on(&s); k++) {
        if (disturbance == FORGET && k % 3 == 0) scree_neighbours_invalidate(&s.work);
        if (disturbance == LOSE && k % 997 == 500) simulation_lose_work(&s, threads);
        simulation_step(&s);
    }
    scree_error error;
    check(scree_contacts_save(&s.state, &s.work, &error), &error);
    const uint64_t checksum = scree_state_checksum(&s.model, &s.state);
    close_both(&s, c);
    return checksum;
}

static void nothing_but_the_state_decides(void **unused)
{
    (void)unused;
    for (int mixed = 0; mixed < 2; mixed++) {
        const char *text = mixed ? mixed_text : gas_text;
        const char *const fine = "integrator.step=4e-6 s";
        const uint64_t expected = bits_of(text, &fine, 1, 1, 0);
        assert_true(bits_of(text, &fine, 1, 3, 0) == expected);
        assert_true(bits_of(text, &fine, 1, 1, FORGET) == expected);
        assert_true(bits_of(text, &fine, 1, 2, LOSE) == expected);
        const char *const other[] = {fine, mixed ? "particles.species.0.rounding=0.31" : "particles.rounding=0.21"};
        assert_true(bits_of(text, other, 2, 1, 0) != expected);
    }
}

// ---- what does not go together -------------------------------------------------------------------------------------

static void what_does_not_go_together_is_refused(void **unused)
{
    (void)unused;
    static const char *const wrong[][2] = {
        {"contact.law=polygon_overlap", "knows sharp corners alone"},
        {"particles.rounding=0", "sharp corners: give particles.rounding"},
        {"particles.rounding=1", "too large"},
        {"particles.rounding=-0.1", "too small"},
    };
    for (size_t k = 0; k < COUNT_OF(wrong); k++) {
        scree_case *c;
        scree_problems *problems;
        bool told = false;
        if (case_parse(gas_text, &wrong[k][0], 1, &c, &problems) == SCREE_OK) {
            scree_simulation s;
            scree_error error;
            assert_true(scree_simulation_open(c, 1, &s, &error) != SCREE_OK);
            if (!strstr(error.message, wrong[k][1])) fail_msg("%s: %s", wrong[k][0], error.message);
            scree_case_free(c);
            continue;
        }
        for (size_t i = 0; i < scree_problems_count(problems); i++)
            told = told || strstr(scree_problems_get(problems, i)->message, wrong[k][1]);
        if (!told) fail_msg("%s: %s", wrong[k][0], scree_problems_get(problems, 0)->message);
        scree_problems_free(problems);
    }
}

/// Bodies that are put into each other stop the run by the guard of the overlap, with a message.
static void cores_that_meet_stop_the_run(void **unused)
{
    (void)unused;
    scree_case *c;
    const char *const overrides[] = {"particles.count=2",
                                     ("stages.0.bodies=[{position: [0.5 m, 0.5 m]}, {position: [0.524 m, 0.507 m], "
                                      "angle: 0.3, velocity: [-100, 0]}]"),
                                     "materials.0.young_modulus=1e4 Pa", "materials.0.restitution=1"};
    scree_simulation s = open_with(one_text, overrides, COUNT_OF(overrides), &c);
    scree_error error = {0};
    scree_status status = SCREE_OK;
    for (int k = 0; k < 1000 && !status; k++) status = scree_simulation_step(&s, &error);
    print_message("%s\n", error.message);
    assert_true(status != SCREE_OK && strstr(error.message, "overlap"));
    close_both(&s, c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_floor_bears_the_weight),
        cmocka_unit_test(it_slides_as_coulomb_says),
        cmocka_unit_test(it_topples_where_its_centre_passes_a_corner),
        cmocka_unit_test(rocking_keeps_its_energy),
        cmocka_unit_test(a_gas_keeps_its_energy),
        cmocka_unit_test(losses_are_booked),
        cmocka_unit_test(momentum_is_kept),
        cmocka_unit_test(faces_bounce_as_the_law_says),
        cmocka_unit_test(solid_walls_do_work),
        cmocka_unit_test(a_periodic_cell_holds_them),
        cmocka_unit_test(nothing_but_the_state_decides),
        cmocka_unit_test(what_does_not_go_together_is_refused),
        cmocka_unit_test(cores_that_meet_stop_the_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
