/// Bodies that sleep: what rests is what contacts exert, the balance closes, who wakes, and nothing but the state
/// decides.
#include "run_fixture.h"

#include "io_scratch.h"

#include "contact/contact.h"
#include "integrate/integrate.h"
#include "scree/simulation.h"
#include "search/search.h"
#include "state/births.h"
#include "state/case_walls.h"
#include "state/sleep.h"

#define COUNT_OF(list) (sizeof(list) / sizeof *(list))
#define SLEEPS         ", sleep_window: 4 ms, sleep_force: 0.5, sleep_motion: 2e-2, wake_force: 2, wake_interval: 0.25 s"
#define OUT            "measure: {samples: 50, cells: no}\noutput: {figures: no, paraview: no}\n"
#define STAGES         "stages: [{stage: prepare, method: empty}, {stage: pour" SLEEPS "}]\n"

/// A heap of polygons and discs in a trough, which calms down between two births.
static const char polygons[] =
    "scree: 1\nname: heap\ngravity: [0, -9.81]\n"
    "materials: [{name: stone, young_modulus: 1e6 Pa, density: 5000 kg/m3, friction: 0.5, damping_constant: 1}]\n"
    "contact: {law: polygon_overlap}\nintegrator: {step: 2e-5 s}\n" OUT
    "particles:\n  thickness: 1 m\n  count: 24\n  species:\n"
    "  - {name: grains, shape: polygon, material: stone, share: 0.6, radius_min: 1.5 mm, radius_max: 2.5 mm}\n"
    "  - {name: discs, shape: disc, material: stone, share: 0.4, distribution: equal, radius: 2 mm}\n"
    "walls: [{shape: plane, point: [0, 0], normal: [0.3, 1]}, {shape: plane, point: [0, 0], normal: [-0.3, 1]}]\n"
    "sources: [{source: line, start: [-10 mm, 30 mm], end: [10 mm, 30 mm], interval: 60 ms}]\n" STAGES;

static const char discs[] =
    "scree: 1\nname: heap\ngravity: [0, -9.81]\n"
    "materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.5, restitution: 0.3}]\n"
    "contact: {law: hertz_mindlin}\nintegrator: {step_fraction: 0.2}\n" OUT
    "particles: {shape: disc, material: glass, count: 24, radius_min: 1.5 mm, radius_max: 2.5 mm}\n"
    "walls: [{shape: plane, point: [0, 0], normal: [0.3, 1]}, {shape: plane, point: [0, 0], normal: [-0.3, 1]}]\n"
    "sources: [{source: line, start: [-10 mm, 30 mm], end: [10 mm, 30 mm], interval: 60 ms}]\n" STAGES;

static const char spheres[] =
    "scree: 1\nname: heap\ndimension: 3\ngravity: [0, 0, -9.81]\n"
    "materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.5, restitution: 0.3}]\n"
    "contact: {law: hertz_mindlin}\nintegrator: {step_fraction: 0.2}\n" OUT
    "particles: {shape: sphere, material: glass, count: 24, radius_min: 1.5 mm, radius_max: 2.5 mm}\n"
    "walls: [{shape: cone, start: [0, 0, -20 mm], end: [0, 0, 60 mm], radius_start: 0, radius_end: 120 mm}]\n"
    "sources: [{source: point, place: [2 mm, 1 mm, 35 mm], interval: 60 ms}]\n" STAGES;

static const char *const texts[] = {polygons, discs, spheres};

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

/// Steps to the first step from `time` [s] on.
static void step_to(scree_simulation *s, double time)
{
    while (simulation_goes_on(s) && scree_state_time(&s->state) < time) simulation_step(s);
}

static size_t asleep(const scree_simulation *s)
{
    return scree_sleep_of(&s->state)->count;
}

// ---- what rests ----------------------------------------------------------------------------------------------------

/// Force on each body, and on all walls together, by all contacts as measures see them.
static void sum_table(scree_simulation *s, scree_vector *force, scree_vector walls)
{
    scree_contact_table table = {0};
    scree_error error;
    check(scree_neighbours_refresh(&s->model, &s->state, &s->work, &error), &error);
    check(scree_contact_table_build(&s->model, &s->state, &s->work, &table, &error), &error);
    memset(force, 0, s->state.count * sizeof *force);
    memset(walls, 0, 3 * sizeof *walls);
    for (size_t k = 0; k < table.count; k++) {
        const scree_contact *contact = &table.contact[k];
        for (int i = 0; i < 3; i++) {
            const double f =
                contact->normal_force * contact->normal[i] + contact->tangential_force * contact->tangent[i];
            force[contact->first][i] += f;
            *(contact->wall ? &walls[i] : &force[contact->second][i]) -= f;
        }
    }
    scree_contact_table_destroy(&table);
}

/// Largest difference of the forces on all walls from `table`, over the weight of all.
static double beside_walls(const scree_simulation *s, const scree_vector table)
{
    double worst = 0, weight = 0;
    for (size_t row = 0; row < s->state.count; row++) weight += 9.81 * scree_body_mass(&s->state, row);
    for (int i = 0; i < 3 && asleep(s) > 0; i++) {
        double sum = 0;
        for (int w = 0; w < SCREE_SURFACES; w++) sum += scree_case_walls(&s->state)->load[w].force[i];
        worst = fmax(worst, fabs(sum - table[i]) / weight);
    }
    return worst;
}

/// Whether something that sleeps is noted to rest on a wall.
static bool rests_on_walls(const scree_simulation *s)
{
    const scree_sleep *sleep = scree_sleep_of(&s->state);
    int64_t any = 0;
    for (int w = 0; w < SCREE_SURFACES; w++)
        for (int i = 0; i < 3; i++) any |= sleep->wall[w].force[i];
    return any != 0;
}

/// On each that sleeps the sums, what rests, and the weight are the contacts of the table and the weight: nothing is
/// lost and nothing counts twice, through all events.
static void what_rests_is_what_contacts_exert(void **unused)
{
    (void)unused;
    for (size_t t = 0; t < COUNT_OF(texts); t++) {
        scree_case *c;
        scree_simulation s = open_with(texts[t], NULL, 0, &c);
        scree_vector all[32], force, torque, walls;
        size_t seen = 0;
        double worst = 0;
        bool rested = false;
        for (int k = 1; k <= 28; k++) {
            step_to(&s, 0.05 * k);
            sum_table(&s, all, walls);
            worst = fmax(worst, beside_walls(&s, walls));
            rested = rested || rests_on_walls(&s);
            for (size_t row = 0; row < s.state.count; row++) {
                if (!scree_body_sleeps(&s.state, row)) continue;
                const double weight = 9.81 * scree_body_mass(&s.state, row);
                scree_body_force(&s.model, &s.state, row, force, torque);
                for (int i = 0; i < 3; i++) {
                    const double own = scree_body_mass(&s.state, row) * s.stage_model.gravity[i];
                    worst = fmax(worst, fabs(force[i] - own - all[row][i]) / weight);
                }
                seen++;
            }
        }
        print_message("%zu that sleep: largest difference %.2g weights\n", seen, worst);
        assert_true(seen > 50 && worst < 1e-6);
        assert_true(rested);
        scree_sleep_end(&s.state);
        assert_false(rests_on_walls(&s));
        close_both(&s, c);
    }
}

// ---- a heap that grows ---------------------------------------------------------------------------------------------

/// How many of those that sleep have no contact, or are left out of balance by others that sleep, at a look and behind.
static size_t without_hold(const scree_simulation *s, double wake)
{
    const scree_state *state = &s->state;
    size_t found = 0;
    for (size_t row = 0; row < state->count; row++) {
        scree_vector force, torque;
        if (!scree_body_sleeps(state, row) || state->sum[row].contacts > 0) continue;
        scree_body_force(&s->model, state, row, force, torque);
        found += scree_sleep_of(state)->resting[row].contacts == 0 ||
                 scree_length(force) > wake * 9.81 * scree_body_mass(state, row);
    }
    return found;
}

/// What is seen of a heap to its end.
typedef struct watched {
    size_t most, changes; ///< asleep; steps in which some woke
    size_t longest;       ///< steps in a row in which something hangs in the air
    double residual;
} watched;

static watched watch(scree_simulation *s)
{
    watched seen = {0};
    size_t before = 0, hanging = 0;
    while (simulation_goes_on(s)) {
        simulation_step(s);
        const size_t now = asleep(s);
        if (now > seen.most) seen.most = now;
        seen.changes += now < before;
        before = now;
        hanging = without_hold(s, 2) > 0 ? hanging + 1 : 0;
        if (hanging > seen.longest) seen.longest = hanging;
        seen.residual = simulation_residual(s, seen.residual);
        for (size_t row = 0; row < s->state.count && s->state.dimension == 2; row++)
            if (scree_body_sleeps(&s->state, row))
                assert_true(s->state.row[row].vx == 0 && s->state.row[row].vy == 0 && s->state.row[row].spin == 0);
    }
    return seen;
}

/// In mid-pour most sleep between two births, and all are awake when the sources have stopped. Nothing hangs in the air
/// for longer than from one look to the next. What is taken from those that fall asleep is accumulated: the balance
/// closes as with all awake, but for springs that were at the friction limit of a dashpot that is forgotten. That of
/// spheres has single impacts, of grains that are awake, which cost 2.0e-4 in these steps, and 7.8e-5, 4.4e-5
/// and 3.1e-5 in halves, quarters and eighths of them.
static void a_heap_sleeps_wakes_and_keeps_its_balance(void **unused)
{
    (void)unused;
    static const double scheme[COUNT_OF(texts)] = {5e-7, 5e-7, 4e-4}; // of steps, in the work
    for (size_t t = 0; t < COUNT_OF(texts); t++) {
        const char *const awake = "stages.pour.sleep_window=auto";
        scree_case *c;
        scree_simulation s = open_with(texts[t], NULL, 0, &c);
        const watched seen = watch(&s);
        assert_true(scree_sleep_of(&s.state)->taken > 0);
        assert_true(seen.most > 12 && seen.changes > 5);
        assert_int_equal(asleep(&s), 0);
        assert_true(seen.longest <= 2 * 128);
        close_both(&s, c);
        s = open_with(texts[t], &awake, 1, &c);
        const double residual = simulation_finish(&s);
        close_both(&s, c);
        print_message("at most %zu asleep, %zu times some woke, hangs for %zu steps, residual %.2g, all awake %.2g\n",
                      seen.most, seen.changes, seen.longest, seen.residual, residual);
        assert_true(seen.residual < fmax(2 * residual, scheme[t]));
    }
}

/// A scheme with a velocity of its own at n gives one that wakes, under forces that are out of balance, a velocity and
/// with it an energy: of ten grains poured into the trough the balance closes as with all awake.
static void one_that_wakes_under_gear_brings_its_energy(void **unused)
{
    (void)unused;
    const char *const overrides[] = {"integrator.scheme=gear", "integrator.step=4e-6 s", "guard.stability=warn",
                                     "particles.count=10"};
    scree_case *c;
    scree_simulation s = open_with(polygons, overrides, COUNT_OF(overrides), &c);
    const watched seen = watch(&s);
    print_message("at most %zu asleep, %zu times some woke, residual %.2g\n", seen.most, seen.changes, seen.residual);
    assert_true(seen.most > 3 && seen.changes > 3);
    assert_true(seen.residual < 1e-8);
    close_both(&s, c);
}

// ---- who sleeps, and who wakes -------------------------------------------------------------------------------------

/// Bodies that fall never sleep, not even where they turn round with no velocity; nor does one that is prescribed.
static void what_falls_does_not_sleep(void **unused)
{
    (void)unused;
    const char *const overrides[] = {"sources=[{source: point, place: [0, 200 mm], interval: 60 ms, velocity: [0, 1]}]",
                                     "stages.pour.wake_force=1e6", "stages.pour.sleep_motion=1",
                                     "stages.pour.sleep_window=1 ms"};
    scree_case *c;
    scree_simulation s = open_with(polygons, overrides, COUNT_OF(overrides), &c);
    step_to(&s, 0.2);
    assert_true(s.state.count >= 3);
    assert_int_equal(asleep(&s), 0);
    close_both(&s, c);
}

/// All wake in the step in which gravity changes.
static void gravity_wakes(void **unused)
{
    (void)unused;
    const char *const overrides[] = {"gravity=[[0 s, 0, -9.81], [0.999 s, 0, -9.81], [1.001 s, 1, -9.81]]"};
    scree_case *c;
    scree_simulation s = open_with(polygons, overrides, 1, &c);
    size_t before = 0;
    while (scree_state_time(&s.state) < 0.9989) simulation_step(&s);
    before = asleep(&s);
    while (scree_state_time(&s.state) < 0.9994) simulation_step(&s);
    print_message("%zu asleep, then %zu\n", before, asleep(&s));
    assert_true(before > 3);
    assert_int_equal(asleep(&s), 0);
    close_both(&s, c);
}

/// A disc that sleeps on the floor under a force that grows wakes when the mean of its resultant, which fades within
/// the window, has reached wake_force times its weight; here it is pushed up by a load that grows linearly.
static void a_push_wakes_at_its_mean(void **unused)
{
    (void)unused;
    const double weight = 2500 * M_PI * 4e-6 * 9.81, rate = 100, window = 4e-2, wake = 2;
    char push[300];
    (void)snprintf(push, sizeof push,
                   "loads=[{load: prescribed, selection: one, force_x: [[0 s, 0], [0.5 s, 0], [1.5 s, %.17g]]}]",
                   -rate * weight);
    const char *const overrides[] = {
        "particles={shape: disc, material: glass, thickness: 1 m, count: 3, distribution: equal, radius: 2 mm}",
        "walls=[{shape: plane, point: [0, 0], normal: [0, 1]}, {shape: plane, point: [-2 mm, 0], normal: [1, 0]}]",
        "materials.glass.friction=0",
        "materials.glass.young_modulus=10 GPa",
        "selections=[{select: ids, name: one, ids: [0]}]",
        push,
        "stages=[{stage: prepare, method: bodies, width: 1, height: 1, bodies: [{position: [0, 2 mm]}]}, {stage: pour, "
        "sleep_window: 40 ms, sleep_force: 0.5, sleep_motion: 0.2, wake_force: 2}]",
        "sources=[{source: point, place: [0.5, 0.01], interval: 10 s}]"};
    scree_case *c;
    scree_simulation s = open_with(discs, overrides, COUNT_OF(overrides), &c);
    step_to(&s, 0.5);
    const uint32_t row = scree_state_row_of(&s.state, 0);
    assert_true(scree_body_sleeps(&s.state, row));
    while (scree_body_sleeps(&s.state, scree_state_row_of(&s.state, 0))) simulation_step(&s);
    // The wall beside it does not push back before it moves: resultant r = rate s (in weights), and the mean m follows
    // m' = (r - m) / window: m = rate (s - window (1 - exp(-s / window))).
    const double since = scree_state_time(&s.state) - 0.5;
    const double mean = rate * (since - window * (1 - exp(-since / window)));
    print_message("woke after %.6g ms, mean %.6g weights\n", 1e3 * since, mean);
    assert_true(fabs(mean - wake) < 0.02);
    close_both(&s, c);
}

/// Runs with a disc that sleeps, and is pushed to the left by `share` of its weight from 0.5 s on; what it wakes by is
/// a mean of two weights, and `interval`.
static scree_simulation open_pushed(double share, const char *interval, scree_case **c)
{
    const double weight = 2500 * M_PI * 4e-6 * 9.81;
    char push[300], wakes[100];
    (void)snprintf(
        push, sizeof push,
        "loads=[{load: prescribed, selection: one, force_x: [[0 s, 0], [0.5 s, 0], [0.500001 s, %.17g], [2 s, "
        "%.17g]]}]",
        -share * weight, -share * weight);
    (void)snprintf(wakes, sizeof wakes, "stages.pour.wake_interval=%s", interval);
    const char *const overrides[] = {
        "particles={shape: disc, material: glass, thickness: 1 m, count: 3, distribution: equal, radius: 2 mm}",
        "walls=[{shape: plane, point: [0, 0], normal: [0, 1]}]",
        "materials.glass.friction=0",
        "materials.glass.young_modulus=10 GPa",
        "selections=[{select: ids, name: one, ids: [0]}]",
        push,
        "stages=[{stage: prepare, method: bodies, width: 1, height: 1, bodies: [{position: [0, 2 mm]}]}, {stage: pour, "
        "sleep_window: 4 ms, sleep_force: 0.3, sleep_motion: 2e-2, wake_force: 2}]",
        wakes,
        "sources=[{source: point, place: [0.5, 0.01], interval: 10 s}]"};
    scree_simulation s = open_with(discs, overrides, COUNT_OF(overrides), c);
    step_to(&s, 0.5);
    assert_true(scree_body_sleeps(&s.state, scree_state_row_of(&s.state, 0)));
    return s;
}

/// Less than `wake_force` is felt, too, within `wake_interval`: however small it is, the disc goes.
static void a_push_that_does_not_end_wakes(void **unused)
{
    (void)unused;
    static const double shares[] = {0.7, 0.2};
    for (int k = 0; k < 2; k++) {
        scree_case *c;
        scree_simulation s = open_pushed(shares[k], "90 ms", &c); // all wake at 450 ms, and at 540
        step_to(&s, 0.5399);
        assert_true(scree_body_sleeps(&s.state, scree_state_row_of(&s.state, 0)));
        step_to(&s, 0.5402);
        assert_int_equal(asleep(&s), 0);
        step_to(&s, 0.62);
        const scree_row *row = &s.state.row[scree_state_row_of(&s.state, 0)];
        print_message("at %.6g m/s\n", row->vx);
        assert_true(fabs(row->vx / (-shares[k] * 9.81 * 0.08) - 1) < 0.01);
        close_both(&s, c);
        s = open_pushed(shares[k], "10 s", &c);
        step_to(&s, 0.62);
        assert_true(scree_body_sleeps(&s.state, scree_state_row_of(&s.state, 0)));
        close_both(&s, c);
    }
}

/// When all have woken none falls asleep for four windows; what is quiet does a window later.
static void all_stay_awake_for_four_windows(void **unused)
{
    (void)unused;
    scree_case *c;
    scree_simulation s = open_pushed(0, "90 ms", &c);
    const double look = 128 * s.state.step_size, window = 4e-3;
    step_to(&s, 0.5402);
    assert_int_equal(asleep(&s), 0);
    while (asleep(&s) == 0 && scree_state_time(&s.state) < 0.6) simulation_step(&s);
    const double since = scree_state_time(&s.state) - 0.54;
    print_message("asleep again %.6g ms later\n", 1e3 * since);
    assert_true(since >= 5 * window - look && since <= 5 * window + 2 * look + s.state.step_size);
    close_both(&s, c);
}

/// A brick that sleeps on a table with little friction, which begins to move: it goes as it does when none sleep.
static void a_wall_that_begins_to_move_wakes(void **unused)
{
    (void)unused;
    static const char text[] =
        "scree: 1\nname: belt\ngravity: [0, -9.81]\n"
        "materials: [{name: stone, young_modulus: 1e7 Pa, density: 5000 kg/m3, friction: 0.2, damping_constant: "
        "0.75}]\n"
        "contact: {law: polygon_overlap}\nintegrator: {step: 1e-5 s}\nmeasure: {cells: no}\n"
        "output: {figures: no, paraview: no}\n"
        "particles: {shape: polygon, thickness: 1 m, material: stone, count: 3, distribution: equal, radius: 2.75 mm,"
        " outline: regular, corners_min: 4, corners_max: 4}\n"
        "sources: [{source: point, place: [0.4, 0.03], interval: 10 s}]\n"
        "walls:\n"
        "  - {shape: plane, name: ground, point: [0, -50 mm], normal: [0, 1]}\n"
        "  - {shape: box, name: table, side: outside, lower: [-100 mm, -10 mm], upper: [500 mm, 0],"
        " velocity: [[0 s, 0, 0], [0.5 s, 0, 0], [0.51 s, 0.05, 0], [5 s, 0.05, 0]]}\n"
        "stages:\n"
        "  - {stage: prepare, method: bodies, width: 1, height: 1, bodies: [{position: [0, 3.5 mm]}]}\n"
        "  - {stage: pour, sleep_window: 5 ms, sleep_force: 0.3, sleep_motion: 0.01, wake_force: 1}\n";
    double place[2];
    for (int sleeps = 0; sleeps < 2; sleeps++) {
        scree_case *c;
        const char *const awake = "stages.pour.sleep_window=auto";
        scree_simulation s = open_with(text, &awake, sleeps ? 0 : 1, &c);
        step_to(&s, 0.5);
        assert_int_equal(scree_sleep_of(&s.state)->count > 0, sleeps);
        const double from = s.state.row[scree_state_row_of(&s.state, 1)].x;
        step_to(&s, 0.55);
        assert_int_equal(scree_sleep_of(&s.state)->count, 0);
        place[sleeps] = s.state.row[scree_state_row_of(&s.state, 1)].x - from;
        close_both(&s, c);
    }
    print_message("by %.6g and %.6g mm\n", 1e3 * place[0], 1e3 * place[1]);
    assert_true(place[0] > 1e-3 && fabs(place[1] / place[0] - 1) < 1e-3);
}

// ---- nothing but the state -----------------------------------------------------------------------------------------

enum { FORGET = 1, LOSE = 2 };

static uint64_t bits_of(const char *text, const char *override, int threads, int disturbance)
{
    scree_case *c;
    scree_simulation s = open_with(text, &override, override ? 1 : 0, &c);
    simulation_lose_work(&s, threads);
    s.work.keep_threads = true;
    for (int k = 0; simulation_goes_on(&s) && scree_state_time(&s.state) < 0.6; k++) {
        if (disturbance == FORGET && k % 3 == 0) scree_neighbours_invalidate(&s.work);
        if (disturbance == LOSE && k % 997 == 500) simulation_lose_work(&s, threads);
        simulation_step(&s);
    }
    const uint64_t bits = simulation_bits(&s);
    close_both(&s, c);
    return bits;
}

/// One that sleeps and has no skin of its own.
static bool find_sleeper(const scree_simulation *s, size_t *row)
{
    int next = 0;
    for (*row = 0; *row < s->state.count; ++*row)
        if (scree_body_sleeps(&s->state, *row) && scree_fast_number(&s->work.search->fast, *row, &next) < 0)
            return true;
    return false;
}

/// A disc that sleeps on one that is drawn away, or on a table that is lowered, falls, whatever `wake_force` is.
static void a_lost_contact_wakes(void **unused)
{
    (void)unused;
    static const char common[] =
        "scree: 1\nname: support\ngravity: [0, -9.81]\n"
        "materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.5, restitution: 0.3}]\n"
        "contact: {law: hertz_mindlin}\nintegrator: {step: 4e-6 s}\n" OUT
        "particles: {shape: disc, material: glass, count: 4, distribution: equal, radius: 2 mm}\n"
        "sources: [{source: point, place: [0.4, 0.01], interval: 1 s}]\n";
    static const char drawn[] =
        "walls: [{shape: plane, point: [0, 0], normal: [0, 1]}, {shape: plane, point: [-2.01 mm, 0], normal: [1, 0]}]\n"
        "selections: [{select: ids, name: carrier, ids: [0]}]\n"
        "loads: [{load: prescribed, selection: carrier, velocity_y: 0, spin_z: 0, "
        "velocity_x: [[0 s, 0], [0.3 s, 0], [0.301 s, 0.3], [0.5 s, 0.3]]}]\n"
        "stages: [{stage: prepare, method: bodies, width: 1, height: 1, bodies: [{position: [0, 2 mm]}, {position: [0, "
        "5.999 mm]}]}, {stage: pour, sleep_window: 5 ms, sleep_force: 0.3, sleep_motion: 0.01, wake_force: 5}]\n";
    static const char lowered[] =
        "walls: [{shape: plane, point: [0, -50 mm], normal: [0, 1]}, {shape: box, name: table, side: outside, lower: "
        "[-10 mm, -10 mm], upper: [10 mm, 0], velocity: [[0 s, 0, 0], [0.3 s, 0, 0], [0.301 s, 0, -0.3], [0.5 s, 0, "
        "-0.3]]}]\n"
        "stages: [{stage: prepare, method: bodies, width: 1, height: 1, bodies: [{position: [0, 2 mm]}]}, {stage: "
        "pour, "
        "sleep_window: 5 ms, sleep_force: 0.3, sleep_motion: 0.01, wake_force: 5}]\n";
    static const struct {
        const char *text;
        uint32_t id;
    } row[] = {{drawn, 1}, {lowered, 0}};
    for (size_t t = 0; t < COUNT_OF(row); t++) {
        char text[2500];
        scree_vector before, after;
        scree_case *c;
        (void)snprintf(text, sizeof text, "%s%s", common, row[t].text);
        scree_simulation s = open_with(text, NULL, 0, &c);
        step_to(&s, 0.3);
        assert_true(scree_body_sleeps(&s.state, scree_state_row_of(&s.state, row[t].id)));
        scree_body_position(&s.state, scree_state_row_of(&s.state, row[t].id), before);
        step_to(&s, 0.35);
        scree_body_position(&s.state, scree_state_row_of(&s.state, row[t].id), after);
        print_message("fell by %.3g mm\n", 1e3 * (before[1] - after[1]));
        assert_true(before[1] - after[1] > 2e-3);
        close_both(&s, c);
    }
}

/// One that had gone a way since the list was made, fell asleep, and wakes: the list is kept, and knows of that way.
static void a_list_knows_how_far_bodies_had_gone(void **unused)
{
    (void)unused;
    for (size_t t = 0; t < COUNT_OF(texts); t++) {
        scree_case *c;
        scree_error error;
        scree_simulation s = open_with(texts[t], NULL, 0, &c);
        size_t row;
        while (!find_sleeper(&s, &row)) simulation_step(&s);
        check(scree_neighbours_refresh(&s.model, &s.state, &s.work, &error), &error);
        const uint64_t lists = s.work.rebuilds;
        const double skin = s.work.skin;
        s.state.rebuild[row][0] += 0.4 * skin;
        s.work.budget = 0.5 * skin;
        scree_sleep_end(&s.state);
        check(scree_neighbours_refresh(&s.model, &s.state, &s.work, &error), &error);
        assert_int_equal(s.work.rebuilds, lists);
        assert_true(s.work.budget < 0.2 * skin);
        close_both(&s, c);
    }
}

/// A brick that sleeps on another, which is taken out by an outlet while it sleeps, falls, and nothing rests on the
/// floor any more; pushed from outside it moves. The balance stays closed.
static void what_sleeps_wakes_before_it_goes_or_is_changed(void **unused)
{
    (void)unused;
    static const char text[] =
        "scree: 1\nname: bricks\ngravity: [0, -9.81]\n"
        "materials: [{name: stone, young_modulus: 1e6 Pa, density: 5000 kg/m3, friction: 0.5, damping_constant: 1}]\n"
        "contact: {law: polygon_overlap}\nintegrator: {step: 2e-5 s}\n" OUT
        "particles: {shape: polygon, thickness: 1 m, material: stone, count: 9, distribution: equal, radius: 2 mm,"
        " outline: regular, corners_min: 4, corners_max: 4}\n"
        "walls: [{shape: plane, point: [0, 0], normal: [0, 1]}]\n"
        "sources: [{source: point, place: [0.4, 0.3], interval: 10 s}]\n"
        "loads: [{load: outlet, every: 8000, lower: [0, 0], upper: [20 mm, 1.7722 mm]}]\n"
        "stages:\n"
        "  - {stage: prepare, method: bodies, width: 1, height: 1, bodies: [{position: [10 mm, 1.7725 mm], angle: 45 "
        "degrees}, {position: [10 mm, 5.317 mm], angle: 45 degrees}, {position: [30 mm, 1.7725 mm], angle: 45 "
        "degrees}]}\n"
        "  - {stage: pour, sleep_window: 4 ms, sleep_force: 0.3, sleep_motion: 2e-2, wake_force: 2}\n";
    scree_case *c;
    scree_error error;
    scree_vector velocity, spin;
    scree_simulation s = open_with(text, NULL, 0, &c);
    step_to(&s, 0.1599);
    const double weight = 9.81 * scree_body_mass(&s.state, 0), *floor = scree_case_walls(&s.state)->load[0].force;
    assert_int_equal(asleep(&s), 3);
    assert_true(fabs(floor[1] / weight + 3) < 1e-3);
    step_to(&s, 0.165);
    assert_int_equal(s.state.count, 3);
    scree_body_velocity(&s.model, &s.state, scree_state_row_of(&s.state, 1), velocity, spin);
    assert_true(fabs(velocity[1] / (-9.81 * (scree_state_time(&s.state) - 0.16)) - 1) < 0.02);
    assert_true(fabs(floor[1] / weight + 1) < 0.1);
    step_to(&s, 0.3);
    const uint32_t pushed[] = {2};
    const double speed[] = {0.2, 0.3};
    assert_true(scree_body_sleeps(&s.state, scree_state_row_of(&s.state, 2)));
    check(scree_simulation_set(&s, &(scree_body_values){.count = 1, .id = pushed, .velocity = speed}, &error), &error);
    const uint32_t row = scree_state_row_of(&s.state, 2);
    const double from = s.state.row[row].y;
    step_to(&s, 0.31);
    assert_true(s.state.row[scree_state_row_of(&s.state, 2)].y - from > 2e-3);
    while (!s.sampled) simulation_step(&s);
    assert_true(simulation_residual(&s, 0) < 1e-8);
    close_both(&s, c);
}

static void nothing_but_the_state_decides(void **unused)
{
    (void)unused;
    for (size_t t = 0; t < COUNT_OF(texts); t++) {
        const uint64_t expected = bits_of(texts[t], NULL, 1, 0);
        assert_true(bits_of(texts[t], NULL, 3, 0) == expected);
        assert_true(bits_of(texts[t], NULL, 1, FORGET) == expected);
        assert_true(bits_of(texts[t], NULL, 2, LOSE) == expected);
        assert_true(bits_of(texts[t], "stages.pour.wake_force=1.9", 1, 0) != expected);
    }
}

/// From a checkpoint in mid-pour, while some sleep.
static void a_restart_goes_on(void **unused)
{
    (void)unused;
    char folder[64];
    assert_true(scratch_create(folder));
    for (size_t t = 0; t < COUNT_OF(texts); t++) {
        scree_case *c;
        scree_simulation s = open_with(texts[t], NULL, 0, &c), other;
        for (int k = 0; k < 3; k++) {
            step_to(&s, 0.5 + 0.071 * k);
            simulation_reopen(&s, 2, folder, &other);
            for (int step = 0; step < 2000; step++) {
                simulation_step(&other);
                simulation_step(&s);
            }
            assert_true(simulation_bits(&s) == simulation_bits(&other));
            scree_simulation_close(&other);
        }
        print_message("%zu asleep\n", asleep(&s));
        close_both(&s, c);
    }
    scratch_destroy(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_rests_is_what_contacts_exert),
        cmocka_unit_test(a_heap_sleeps_wakes_and_keeps_its_balance),
        cmocka_unit_test(one_that_wakes_under_gear_brings_its_energy),
        cmocka_unit_test(what_falls_does_not_sleep),
        cmocka_unit_test(gravity_wakes),
        cmocka_unit_test(a_push_wakes_at_its_mean),
        cmocka_unit_test(a_push_that_does_not_end_wakes),
        cmocka_unit_test(all_stay_awake_for_four_windows),
        cmocka_unit_test(a_wall_that_begins_to_move_wakes),
        cmocka_unit_test(a_lost_contact_wakes),
        cmocka_unit_test(a_list_knows_how_far_bodies_had_gone),
        cmocka_unit_test(what_sleeps_wakes_before_it_goes_or_is_changed),
        cmocka_unit_test(nothing_but_the_state_decides),
        cmocka_unit_test(a_restart_goes_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
