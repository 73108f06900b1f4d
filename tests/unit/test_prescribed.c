/// Prescribed bodies against closed forms: reactions, motion, forces and torques, the balance of energy, restarts,
/// threads, and what is said of prescriptions that cannot be.
#include "run_fixture.h"

#include "io_scratch.h"
#include "load/prescribed.h"
#include "run/step.h"

#define FROM_BODIES(dimension, shape)                                                                                  \
    "scree: 1\nname: pair\ndimension: " dimension "\n"                                                                 \
    "materials: [{name: glass, young_modulus: 10 MPa, poisson_ratio: 0.2, density: 2500 kg/m3, friction: 0, "          \
    "restitution: 1}]\n"                                                                                               \
    "particles: {shape: " shape ", material: glass, count: 2, distribution: equal, radius: 1 mm}\n"                    \
    "walls: [{shape: box, name: far, lower: [0, 0, 0], upper: [40 mm, 40 mm, 40 mm]}]\n"                               \
    "measure: {samples: 20, cells: no}\noutput: {figures: no, paraview: no}\n"
#define SPHERES                                                                                                        \
    FROM_BODIES("3", "sphere")                                                                                         \
    "stages:\n  - {stage: prepare, method: bodies, width: 40 mm, depth: 40 mm, height: 40 mm,\n"                       \
    "     bodies: [{position: [5 mm, 5 mm, 5 mm]}, {position: [7 mm, 5 mm, 5 mm]}]}\n"                                 \
    "  - {stage: relax, name: first, duration: 100 us}\n"                                                              \
    "  - {stage: relax, name: second, duration: 100 us}\n"
#define DISCS                                                                                                          \
    FROM_BODIES("2", "disc")                                                                                           \
    "stages:\n  - {stage: prepare, method: bodies, width: 40 mm, height: 40 mm,\n"                                     \
    "     bodies: [{position: [10 mm, 10 mm]}, {position: [20 mm, 10 mm]}]}\n"                                         \
    "  - {stage: relax, name: first, duration: 2 ms}\n"                                                                \
    "  - {stage: relax, name: second, duration: 2 ms}\n"
#define EACH "selections:\n  - {select: ids, name: one, ids: [0]}\n  - {select: ids, name: other, ids: [1]}\n"

static const char *const schemes[] = {
    "integrator.scheme=position_verlet", "integrator.scheme=velocity_verlet",
    "integrator={scheme: two_timescales, repeats: 2, large_multiple: 2, small_steps: 1}"};

static void enter(scree_simulation *s, int64_t stage)
{
    while (s->state.stage.index < stage || s->state.stage.counter == SCREE_STAGE_NOT_BEGUN) simulation_step(s);
}

static const scree_row *body(const scree_simulation *s, size_t id)
{
    return &s->state.row[scree_state_row_of(&s->state, id)];
}

/// A column of a load, in the order of prescribed.c.
static double column(scree_simulation *s, size_t load, int which)
{
    double value[8];
    scree_error error;
    const scree_context context = scree_step_context(s);
    check(scree_module_prescribed.columns.measure(&context, load, value, &error), &error);
    return value[which];
}
enum { FORCE_X, FORCE_Y, FORCE_Z, TORQUE_X, TORQUE_Y, TORQUE_Z, WORK, BODIES };

// ---- motion ------------------------------------------------------------------------------------------------------

/// Two spheres that are driven onto each other: the reactions are Hertz's force, the work on them is his energy, and
/// they are where they should be, to the last bits, with each scheme.
static void a_driven_pair_meets_hertz(void **unused)
{
    (void)unused;
    const double modulus = 10e6 / (2 * (1 - 0.04)), radius = 0.5e-3;
    const char *text = SPHERES EACH "loads:\n"
                                    "  - {load: prescribed, selection: one, velocity_x: 0.1 m/s, velocity_y: 0, "
                                    "velocity_z: 0, spin_x: 0}\n"
                                    "  - {load: prescribed, selection: other, velocity_x: -0.1 m/s, velocity_z: 0}\n";
    for (size_t k = 0; k < sizeof schemes / sizeof *schemes; k++) {
        const char *const overrides[] = {schemes[k], "gravity=[0, 0, -10]", "integrator.step_fraction=0.02"};
        scree_case *c = case_read(text, overrides, 3);
        scree_simulation s;
        simulation_open(c, 1, &s);
        double worst = 0, far = 0;
        enter(&s, 1);
        while (simulation_goes_on(&s)) {
            simulation_step(&s);
            double time = scree_state_time(&s.state), overlap = 0.2 * time;
            double force = 4.0 / 3 * modulus * sqrt(radius) * pow(overlap, 1.5);
            far = fmax(far, fabs(body(&s, 0)->x - (5e-3 + 0.1 * time)) / 5e-3);
            assert_true(body(&s, 0)->y == 5e-3 && body(&s, 0)->z == 5e-3 && body(&s, 1)->z == 5e-3);
            if (s.state.evaluations < 20) continue;
            worst = fmax(worst, fabs(column(&s, 0, FORCE_X) / force - 1));
            assert_true(fabs(column(&s, 1, FORCE_X) / force + 1) < 1e-9);
            assert_true(fabs(column(&s, 0, FORCE_Z) / (10 * body(&s, 0)->mass) - 1) < 1e-9);
        }
        double overlap = 0.2 * scree_state_time(&s.state);
        double energy = 8.0 / 15 * modulus * sqrt(radius) * pow(overlap, 2.5);
        double kinetic = 2 * 0.5 * body(&s, 0)->mass * 0.01;
        double work = column(&s, 0, WORK) + column(&s, 1, WORK);
        print_message("%s: force %.1g from Hertz, place %.1g, work %.6f of the energy\n", schemes[k], worst, far,
                      work / (energy + kinetic));
        // Round-off: some 1e3 additions to a coordinate, of which the overlap is a difference.
        assert_true(worst < 1e-9 && far < 1e-12);
        assert_true(fabs(work / (energy + kinetic) - 1) < 1e-5); // the trapezoidal rule along Hertz's law
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

/// Held discs stay where they are, to the bit, whatever pushes them; the reaction is the opposite of it.
static void a_held_body_stays(void **unused)
{
    (void)unused;
    const char *text =
        DISCS EACH "loads:\n"
                   "  - {load: prescribed, selection: one, velocity_x: 0, velocity_y: 0, spin_z: 0}\n"
                   "  - {load: prescribed, selection: other, velocity_y: 0, force_x: -1 mN, spin_z: 3 rad/s}\n";
    for (size_t k = 0; k < sizeof schemes / sizeof *schemes; k++) {
        const char *const overrides[] = {schemes[k],
                                         "gravity=[0, -10]",
                                         "stages.0.bodies=[{position: [10 mm, 10 mm]}, {position: [11.999 mm, 10 mm]}]",
                                         "materials.0.restitution=0.3",
                                         "materials.0.friction=0.5",
                                         "stages.2.duration=200 ms"};
        scree_case *c = case_read(text, overrides, 6);
        scree_simulation s;
        simulation_open(c, 1, &s);
        while (simulation_goes_on(&s)) {
            simulation_step(&s);
            if (s.state.stage.index == 0) continue;
            assert_true(body(&s, 0)->x == 10e-3 && body(&s, 0)->y == 10e-3);
            assert_true(s.state.angle[scree_state_row_of(&s.state, 0)] == 0 && body(&s, 1)->y == 10e-3);
        }
        double turned = s.state.angle[scree_state_row_of(&s.state, 1)], time = scree_state_time(&s.state);
        assert_true(fabs(turned / (3 * time) - 1) < 1e-10); // round-off of some 1e5 additions
        print_message("%s: reaction %.9g mN to 1 mN; turned %.3f rad\n", schemes[k], 1e3 * column(&s, 0, FORCE_X),
                      turned);
        // What is left of the motion is damped away.
        assert_true(fabs(column(&s, 0, FORCE_X) / 1e-3 - 1) < 1e-3);
        // Friction at its limit turns both the same way: each needs the torque mu F R.
        assert_true(fabs(column(&s, 1, TORQUE_Z) / 0.5e-6 - 1) < 1e-2);
        assert_true(fabs(column(&s, 0, TORQUE_Z) / 0.5e-6 - 1) < 1e-2);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

#define LATTICE(dimension, shape, method, count)                                                                       \
    "scree: 1\nname: lattice\ndimension: " dimension "\n"                                                              \
    "materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.3, restitution: 0.5}]\n"        \
    "particles: {shape: " shape ", material: glass, count: " count ", distribution: equal, radius: 1 mm}\n"            \
    "measure: {samples: 20, cells: no}\noutput: {figures: no, paraview: no}\n"                                         \
    "stages:\n  - {stage: prepare, method: " method ", aspect_ratio: 1}\n"                                             \
    "  - {stage: relax, boundary: plates, duration: 1 ms}\n"

/// All bodies driven linearly in their places keep an affine ghost of where they were.
static void a_gradient_moves_affinely(void **unused)
{
    (void)unused;
    const char *const texts[] = {
        LATTICE("2", "disc", "hexagonal",
                "60") "selections: [{select: all, name: all}]\n"
                      "loads: [{load: prescribed, selection: all, velocity_x: 1 mm/s,\n"
                      "  gradient: {xx: -0.5, xy: 0.7, yx: 0.2, yy: -0.3}, origin: [1 mm, 2 mm],\n"
                      "  gradient_factor: {from: 0, to: 1, begin: 0 s, end: 0.4 ms}}]\n",
        LATTICE("3", "sphere", "cubic", "64") "selections: [{select: all, name: all}]\n"
                                              "loads: [{load: prescribed, selection: all, velocity_x: 1 mm/s,\n"
                                              "  gradient: {xx: -0.5, xy: 0.7, yx: 0.2, yy: -0.3, zx: 0.4, zz: 0.1}, \n"
                                              "  origin: [1 mm, 2 mm, 0],\n"
                                              "  gradient_factor: {from: 0, to: 1, begin: 0 s, end: 0.4 ms}}]\n"};
    for (int k = 0; k < 6; k++) {
        scree_case *c = case_read(texts[k / 3], &schemes[k % 3], 1);
        scree_simulation s;
        simulation_open(c, 1, &s);
        enter(&s, 1);
        scree_vector *begin, place;
        assert_int_equal(scree_allocate(&begin, s.state.count, sizeof *begin, NULL), SCREE_OK);
        for (size_t id = 0; id < s.state.count; id++)
            scree_body_position(&s.state, scree_state_row_of(&s.state, id), begin[id]);
        (void)simulation_finish(&s);
        const double gradient[9] = {-0.5, 0.7, 0, 0.2, -0.3, 0, k / 3 ? 0.4 : 0, 0, k / 3 ? 0.1 : 0};
        const double origin[3] = {1e-3, 2e-3, 0};
        // Integral of the factor: a ramp of 0.4 ms, then 1; where a step bridges its end the midpoint is off by h^2/8.
        double time = scree_state_time(&s.state), factor = time - 0.2e-3, worst = 0;
        double step = (double)s.model.largest_step * s.state.tick, bend = step * step / 8 / 0.4e-3;
        for (size_t id = 0; id < s.state.count; id++) {
            scree_body_position(&s.state, scree_state_row_of(&s.state, id), place);
            for (int i = 0; i < s.state.dimension; i++) {
                double wanted = begin[id][i] + (i == 0 ? 1e-3 * time : 0), slope = 0;
                for (int j = 0; j < s.state.dimension; j++) slope += gradient[3 * i + j] * (begin[id][j] - origin[j]);
                double difference = fabs(place[i] - wanted - slope * factor) - fabs(slope) * bend;
                worst = fmax(worst, difference / 10e-3);
            }
        }
        print_message("%dD %s: affine to %.1g of the sample\n", s.state.dimension, schemes[k % 3], worst);
        assert_true(worst < 1e-14);
        scree_release(&begin);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

// ---- forces ------------------------------------------------------------------------------------------------------

/// A force that grows with time moves a free disc by F t^3 / (6 m T); one that is constant by F t^2 / 2m; on the
/// surface it turns it, and the work is what the body has.
static void forces_move_and_turn(void **unused)
{
    (void)unused;
    const char *text =
        DISCS EACH "loads:\n"
                   "  - {load: prescribed, selection: one, force_x: {from: 0 N, to: 4 mN, begin: 0 s, end: 4 ms}}\n"
                   "  - {load: prescribed, selection: other, force_x: 2 mN, attack: surface, direction: [0, 2]}\n";
    for (size_t k = 0; k < sizeof schemes / sizeof *schemes; k++) {
        scree_case *c = case_read(text, &schemes[k], 1);
        scree_simulation s;
        simulation_open(c, 1, &s);
        double worst = simulation_finish(&s);
        double time = scree_state_time(&s.state), steps = (double)s.state.evaluations, mass = body(&s, 0)->mass;
        double moved = body(&s, 0)->x - 10e-3, wanted = 1.0 * time * time * time / (6 * mass);
        double pushed = body(&s, 1)->x - 20e-3, far = 2e-3 * time * time / (2 * mass);
        double spin = -2e-3 * 1e-3 * time / (0.5 * mass * 1e-6), turned = body(&s, 1)->spin;
        print_message("%s: ramp %.6f, constant %.6f, spin %.6f of the closed forms, residual %.1g\n", schemes[k],
                      moved / wanted, pushed / far, turned / spin, worst);
        assert_true(fabs(moved / wanted - 1) < 3 / steps);
        assert_true(fabs(pushed / far - 1) < 4 / steps &&
                    fabs(turned / spin - 1) < 2 / steps); // no force before step 1
        assert_true(worst < 1e-12);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

/// Shared among a selection, in three dimensions, with the lever of a force and a spin that is held against it.
static void forces_are_shared(void **unused)
{
    (void)unused;
    const char *text =
        SPHERES EACH "  - {select: or, name: both, of: [one, other]}\n"
                     "loads:\n"
                     "  - {load: prescribed, selection: both, force_y: 3 mN, per: selection, attack: surface, "
                     "direction: [1, 0, 0]}\n"
                     "  - {load: prescribed, selection: one, spin_z: 0}\n";
    const char *apart = "stages.0.bodies=[{position: [5 mm, 5 mm, 5 mm]}, {position: [9 mm, 5 mm, 5 mm]}]";
    scree_case *c = case_read(text, &apart, 1);
    scree_simulation s;
    simulation_open(c, 1, &s);
    double worst = simulation_finish(&s);
    double mass = body(&s, 0)->mass, time = scree_state_time(&s.state);
    assert_true(fabs(column(&s, 0, FORCE_Y) / 3e-3 - 1) < 1e-10 && column(&s, 0, BODIES) == 2); // quanta
    assert_true(fabs(column(&s, 0, TORQUE_Z) / 3e-6 - 1) < 1e-10);
    assert_true(fabs(column(&s, 1, TORQUE_Z) / -1.5e-6 - 1) < 1e-10 && column(&s, 1, WORK) == 0);
    const scree_turn_row *turn = s.state.turn;
    assert_true(turn[scree_state_row_of(&s.state, 0)].wz == 0);
    double spin = turn[scree_state_row_of(&s.state, 1)].wz, wanted = 1.5e-6 * time / (0.4 * mass * 1e-6);
    assert_true(fabs(spin / wanted - 1) < 3 / (double)s.state.evaluations && worst < 1e-12);
    scree_simulation_close(&s);
    scree_case_free(c);
}

// ---- energy ------------------------------------------------------------------------------------------------------

/// A square of discs whose lowest row is held and whose highest one is driven to and fro.
#define SHEARED(dimension, shape, method, count)                                                                       \
    LATTICE(dimension, shape, method, count)                                                                           \
    "selections:\n  - {select: side, name: low, side: bottom}\n  - {select: side, name: high, side: top}\n"            \
    "loads:\n  - {load: prescribed, selection: low, velocity_x: 0, velocity_y: 0, spin_z: 0}\n"                        \
    "  - {load: prescribed, selection: high, velocity_x: {amplitude: 0.1 m/s, frequency: 700 1/s}, velocity_y: 0,\n"   \
    "     gradient: {yx: 0.5}}\n"

/// Largest residual of the balance, at `fraction` of the critical step.
static double residual_of(const char *text, const char *scheme, const char *fraction)
{
    const char *const overrides[] = {scheme, fraction, "materials.0.restitution=1", "materials.0.friction=0",
                                     "stages.1.duration=0.2 ms"};
    scree_case *c = case_read(text, overrides, 5);
    scree_simulation s;
    simulation_open(c, 1, &s);
    double worst = simulation_finish(&s);
    assert_true(fabs(column(&s, 1, WORK)) > 1e-9);
    scree_simulation_close(&s);
    scree_case_free(c);
    return worst;
}

static void the_balance_closes(void **unused)
{
    (void)unused;
    const char *const texts[] = {SHEARED("2", "disc", "hexagonal", "60"), SHEARED("3", "sphere", "cubic", "64")};
    for (int k = 0; k < 6; k++) {
        double coarse = residual_of(texts[k / 3], schemes[k % 3], "integrator.step_fraction=0.002");
        double fine = residual_of(texts[k / 3], schemes[k % 3], "integrator.step_fraction=0.001");
        print_message("%dD %s: residual %.2g, %.2g at half the step\n", 2 + k / 3, schemes[k % 3], coarse, fine);
        // Samples of two timescales, at whole sequences, are at other phases of the motion with another step.
        assert_true(fine < 1e-9 && (k % 3 == 2 || fine < 0.3 * coarse));
    }
}

/// A body that is let go keeps its velocity, one that is caught in full flight stops: the balance knows of both, also
/// of what they fall meanwhile.
static void begin_and_end_are_in_the_balance(void **unused)
{
    (void)unused;
    const char *text =
        DISCS EACH "loads:\n"
                   "  - {load: prescribed, selection: one, until: first, velocity_x: {from: 0 m/s, to: 0.3 m/s, begin: "
                   "0 s, end: 1 ms, smooth: yes}}\n"
                   "  - {load: prescribed, name: stop, selection: one, from: second, velocity_y: 0}\n"
                   "  - {load: prescribed, selection: other, from: second, velocity_x: 0.2 m/s, spin_z: 5 rad/s}\n";
    for (size_t k = 0; k < 6; k++) {
        const char *const overrides[] = {schemes[k % 3],
                                         "stages.0.bodies=[{position: [10 mm, 10 mm], velocity: [0, 0.5 m/s]}, "
                                         "{position: [30 mm, 10 mm], velocity: [-1 m/s, 0.1 m/s]}]",
                                         k < 3 ? "gravity=[0, 0]" : "gravity=[20, -30]"};
        scree_case *c = case_read(text, overrides, 3);
        scree_simulation s;
        simulation_open(c, 1, &s);
        double worst = simulation_finish(&s), mass = body(&s, 0)->mass;
        double driven = column(&s, 0, WORK) / (0.5 * mass * 0.09), stopped = column(&s, 1, WORK) / (0.5 * mass * 0.25);
        double caught = column(&s, 2, WORK) / (0.5 * mass * (0.04 - 1 + 0.5 * 25e-6));
        print_message("%s: residual %.1g; work %.9f, %.9f, %.9f of the change of energy\n", schemes[k % 3], worst,
                      driven, -stopped, caught);
        assert_true(worst < 1e-11 && fabs(body(&s, 0)->vy) < 1e-12 && fabs(body(&s, 1)->vx - 0.2) < 1e-12);
        if (k < 3) { // the closed forms are those of free flight
            assert_true(fabs(driven - 1) < 1e-3 && fabs(stopped + 1) < 1e-9 && fabs(caught - 1) < 1e-9);
            assert_true(fabs(body(&s, 0)->vx - 0.3) < 1e-12);
        }
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

/// Damping of the background leaves driven components alone.
static void damping_does_not_fight_the_drive(void **unused)
{
    (void)unused;
    const char *text = SHEARED("2", "disc", "hexagonal", "60") "  - {load: background_damping, translation: 0.3}\n";
    const char *const overrides[] = {"materials.0.restitution=1", "integrator.step_fraction=0.02"};
    scree_case *c = case_read(text, overrides, 2);
    scree_simulation s;
    simulation_open(c, 1, &s);
    double worst = simulation_finish(&s);
    print_message("with background damping: residual %.2g\n", worst);
    assert_true(worst < 1e-5);
    for (size_t row = 0; row < s.state.count; row++)
        if (scree_prescribed_of(&s.state)->owner[row][0] == 1) assert_true(s.state.row[row].vx == 0);
    scree_simulation_close(&s);
    scree_case_free(c);
}

// ---- same bits ---------------------------------------------------------------------------------------------------

static uint64_t bits_of(const scree_case *c, int threads, const char *folder)
{
    scree_simulation s, other;
    simulation_open(c, threads, &s);
    enter(&s, 1);
    while (simulation_goes_on(&s) && s.state.evaluations < 100) simulation_step(&s);
    if (folder) {
        simulation_reopen(&s, threads, folder, &other);
        scree_simulation_close(&s);
        s = other;
    }
    while (simulation_goes_on(&s) && s.state.evaluations < 200) simulation_step(&s);
    assert_true(s.state.evaluations == 200);
    return simulation_close(&s);
}

static void bits_do_not_depend_on_threads_or_restarts(void **unused)
{
    (void)unused;
    const char *const texts[] = {
        SHEARED("2", "disc", "hexagonal", "600") "  - {load: prescribed, name: own, selection: inner, force_y: 1 mN, "
                                                 "attack: surface, direction: [1, 0], per: selection}\n"
                                                 "gravity: [0, -9.81]\n",
        SHEARED("3", "sphere", "cubic", "600") "  - {load: prescribed, name: own, selection: inner, force_y: 1 mN, "
                                               "attack: surface, direction: [1, 0, 0], per: selection}\n"};
    for (int k = 0; k < 6; k++) {
        const char *const overrides[] = {schemes[k % 3],
                                         "selections=[{select: side, name: low, side: bottom}, {select: side, name: "
                                         "high, side: top}, {select: not, name: inner, of: [low, high]}]"};
        scree_case *c = case_read(texts[k / 3], overrides, 2);
        uint64_t bits = bits_of(c, 1, NULL);
        assert_true(bits == bits_of(c, 2, NULL) && bits == bits_of(c, 7, NULL));
        assert_true(bits == bits_of(c, 2, scratch));
        scree_case_free(c);
    }
}

// ---- files -------------------------------------------------------------------------------------------------------

static double number(const char *directory, const char *name)
{
    char text[64];
    scree_error error;
    check(scree_result_get(directory, name, text, sizeof text, &error), &error);
    return strtod(text, NULL);
}

static void results_are_written(void **unused)
{
    (void)unused;
    char path[128];
    scree_case *c = case_read(SHEARED("2", "disc", "hexagonal", "60"), NULL, 0);
    scree_error error;
    scree_run_options options = {.output = scratch, .threads = 1, .force = true};
    check(scree_run(c, &options, &error), &error);
    scree_series series;
    (void)snprintf(path, sizeof path, "%s/series.csv", scratch);
    check(scree_series_read(&series, path, &error), &error);
    const double *work = scree_series_get(&series, "high_exerted_work"), *low = scree_series_get(&series, "low_bodies");
    assert_true(work && low && series.row_count > 10);
    assert_true(number(scratch, "high_exerted_work") == work[series.row_count - 1]);
    assert_true(low[0] >= 7 && number(scratch, "low_bodies") == low[0] &&
                fabs(number(scratch, "low_exerted_force_x")) > 0);
    scree_series_destroy(&series);
    scree_case_free(c);
}

// ---- what cannot be ----------------------------------------------------------------------------------------------

static void expect_problem(const char *loads, const char *message)
{
    scree_case *c;
    scree_problems *problems;
    bool found = false;
    char line[2048] = "";
    assert_int_equal(case_parse(DISCS EACH, &loads, 1, &c, &problems), SCREE_ERROR_INPUT);
    for (size_t k = 0; k < scree_problems_count(problems); k++)
        found = found || strstr(scree_problems_get(problems, k)->message, message);
    scree_error_format(scree_problems_get(problems, 0), line, sizeof line);
    if (!found) fail_msg("%s: '%s' is not said, but: %s", loads, message, line);
    scree_problems_free(problems);
}

static void bad_prescriptions_are_refused(void **unused)
{
    (void)unused;
#define ONE "loads=[{load: prescribed, selection: one, "
    expect_problem("loads=[{load: prescribed, selection: otter, velocity_x: 0}]", "did you mean 'other'");
    expect_problem(ONE "velocity_x: 0, force_x: 1 N}]", "a force on it would change nothing");
    expect_problem(ONE "gradient: {xy: 1}, force_x: 1 N}]", "a force on it would change nothing");
    expect_problem(ONE "velocity_z: 0}]", "two dimensions have velocities");
    expect_problem(ONE "per: body}]", "nothing is prescribed");
    expect_problem(ONE "velocity_x: 0, from: frist}]", "did you mean 'first'");
    expect_problem(ONE "velocity_x: 0, from: second, until: first}]", "comes before stage 'second'");
    expect_problem(ONE "velocity_x: 0, gradient_factor: 2}]", "not used without gradient");
    expect_problem(ONE "velocity_x: 0, attack: surface}]", "no force that acts on the surface");
    expect_problem(ONE "velocity_x: [[0 s, 0], [2 s, 1], [1 s, 3]]}]", "time");
    expect_problem(ONE "velocity_x: 0}, {load: prescribed, selection: one, velocity_y: 0}]", "is called 'one' too");
    expect_problem(ONE "velocity_x: 0}, {load: prescribed, name: b, selection: one, force_x: 1 N}]",
                   "loads.0 prescribes velocity_x of the same particles");
}

static void expect_refusal(const char *const *overrides, size_t count, const char *message, int line)
{
    scree_case *c = case_read(DISCS EACH "loads: []\n", overrides, count);
    scree_simulation s;
    scree_error error = {0};
    scree_status status = SCREE_OK;
    simulation_open(c, 1, &s);
    while (simulation_goes_on(&s) && !status) status = scree_simulation_step(&s, &error);
    assert_int_equal(status, SCREE_ERROR_INPUT);
    if (!strstr(error.message, message) || error.line != line) fail_msg("%d: %s", error.line, error.message);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// What shows when a stage begins has its place in the case, too.
static void what_meets_in_a_body_is_refused(void **unused)
{
    (void)unused;
    const char *both = "loads=[{load: prescribed, selection: one, velocity_x: 0}, "
                       "{load: prescribed, selection: other, force_x: 1 N}]";
    const char *const same[] = {both, "selections.other.ids=[0, 1]"};
    expect_refusal(same, 2, "'one' prescribes the velocity x of particle 0, so the force x of 'other' would", 0);
    const char *const turned[] = {"loads=[{load: prescribed, selection: one, force_x: 1 N}, "
                                  "{load: prescribed, selection: other, velocity_x: 0}]",
                                  "selections.other.ids=[0, 1]"};
    expect_refusal(turned, 2, "'other' prescribes the velocity x of particle 0, so the force x of 'one' would", 0);
    const char *const driven[] = {"loads=[{load: prescribed, selection: one, velocity_x: 0}, "
                                  "{load: prescribed, selection: other, velocity_x: 1 m/s}]",
                                  "selections.other.ids=[0, 1]"};
    expect_refusal(driven, 2, "'one' and 'other' both prescribe the velocity x of particle 0: leave it", 0);
    const char *const pushed[] = {"loads=[{load: prescribed, selection: one, force_x: 0.5 N}, "
                                  "{load: prescribed, selection: other, force_x: 1 N}]",
                                  "selections.other.ids=[0, 1]"};
    expect_refusal(pushed, 2, "'one' and 'other' both prescribe the force x of particle 0: leave it", 0);
    const char *const missing[] = {both, "selections.other.ids=[1, 2]"};
    expect_refusal(missing, 2, "names particle 2, which is not there", 16);
    const char *const empty[] = {both, "selections=[{select: ids, name: one, ids: [0]}, {select: box, name: other, "
                                       "lower: [0, 0], upper: [1 mm, 1 mm]}]"};
    expect_refusal(empty, 2, "selection 'other' (box) has no particle", 0);
}

#define WITH_SCRATCH(test) cmocka_unit_test_setup_teardown(test, make_scratch, remove_scratch)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_driven_pair_meets_hertz),
        cmocka_unit_test(a_held_body_stays),
        cmocka_unit_test(a_gradient_moves_affinely),
        cmocka_unit_test(forces_move_and_turn),
        cmocka_unit_test(forces_are_shared),
        cmocka_unit_test(the_balance_closes),
        cmocka_unit_test(begin_and_end_are_in_the_balance),
        cmocka_unit_test(damping_does_not_fight_the_drive),
        WITH_SCRATCH(bits_do_not_depend_on_threads_or_restarts),
        WITH_SCRATCH(results_are_written),
        cmocka_unit_test(bad_prescriptions_are_refused),
        cmocka_unit_test(what_meets_in_a_body_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
