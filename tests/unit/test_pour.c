/// Pouring: what is born, when, where and how fast against closed forms; the balance of energies; sources that wait,
/// are blocked, follow the pile; restarts and threads; what is wrong.
#include "run_fixture.h"

#include "io_scratch.h"
#include "measure/pile.h"
#include "shape/polygons.h"
#include "source/source.h"

#define HEAD                                                                                                           \
    "scree: 1\nname: poured\ngravity: [0, -9.81]\n"                                                                    \
    "materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.5, restitution: 0.4}]\n"        \
    "contact: {law: hertz_mindlin}\nintegrator: {step_fraction: 0.2}\n"                                                \
    "measure: {samples: 50, cells: no}\noutput: {figures: no, paraview: no}\n"
#define DISCS(count)                                                                                                   \
    "particles: {shape: disc, material: glass, count: " count ", radius_min: 1.5 mm, radius_max: 2.5 mm}\n"
#define FLOOR(height) "walls: [{shape: plane, name: plate, point: [0, " height "], normal: [0, 1]}]\n"
#define STAGES(pour)  "stages: [{stage: prepare, method: empty}, {stage: pour" pour "}]\n"
#define SPOUT                                                                                                          \
    "sources: [{source: point, place: [0, 60 mm], interval: 20 ms, velocity: [0, -0.5], spread: [30 mm/s, 0.1]}]\n"

static const char *const schemes[] = {
    "integrator.scheme=position_verlet", "integrator.scheme=velocity_verlet",
    "integrator={scheme: two_timescales, repeats: 2, large_multiple: 2, small_steps: 1}"};

/// Gravity of the stage turns and grows.
#define TURNS "gravity=[[0 s, 0, -5], [20 ms, 4, -9], [50 ms, -8, -20]]"

/// Polygons and discs.
#define POLYGONS                                                                                                       \
    "scree: 1\nname: mixed\ngravity: [0, -9.81]\n"                                                                     \
    "materials: [{name: stone, young_modulus: 1e7 Pa, density: 5000 kg/m3, friction: 0.5}]\n"                          \
    "contact: {law: polygon_overlap}\nintegrator: {step: 5e-6 s}\n"                                                    \
    "measure: {samples: 50, cells: no}\noutput: {figures: no, paraview: no}\n"                                         \
    "particles:\n  thickness: 1 m\n  count: 45\n  species:\n"                                                          \
    "  - {name: grains, shape: polygon, material: stone, share: 0.6, radius_min: 1.5 mm, radius_max: 2.5 mm}\n"        \
    "  - {name: discs, shape: disc, material: stone, share: 0.4, distribution: equal, radius: 2 mm}\n" FLOOR(          \
        "0") "sources: [{source: line, start: [-10 mm, 20 mm], end: [10 mm, 20 mm], interval: 4 ms}]\n"

// ---- births against closed forms ---------------------------------------------------------------------------------

/// Bodies that fall without touching anything: where and how fast each is follows from when it was born, and the
/// momentum of all is what they brought and gravity gave. Velocity Verlet is exact for a constant acceleration: what is
/// left is round-off.
static void what_is_born_falls(void **unused)
{
    (void)unused;
    const char *const override = "integrator.scheme=velocity_verlet";
    scree_case *c = case_read(HEAD DISCS("12") FLOOR("-1") SPOUT STAGES(""), &override, 1);
    scree_simulation s;
    double momentum[2] = {0}, wanted[2] = {0};
    simulation_open(c, 1, &s);
    assert_true(simulation_finish(&s) < 1e-11);
    assert_int_equal(s.state.count, 12);
    const double now = scree_state_time(&s.state);
    for (size_t row = 0; row < s.state.count; row++) {
        const scree_row *body = &s.state.row[row];
        const double born = scree_births_of(&s.state)->time[row], since = now - born;
        scree_vector velocity;
        double angle;
        scree_source_draw_motion(&s.model, &s.model.sources[0], s.state.id[row], velocity, &angle);
        // An interval is rounded up to whole steps.
        assert_true(fabs(born - 20e-3 * s.state.id[row]) < s.state.tick * (1 + s.state.id[row]));
        assert_true(fabs(velocity[0]) <= 0.03 && fabs(velocity[1] + 0.5) <= 0.1 && fabs(angle) <= M_PI);
        assert_true(fabs(body->x - velocity[0] * since) < 1e-12);
        assert_true(fabs(body->y - (0.06 + velocity[1] * since - 9.81 / 2 * since * since)) < 1e-12);
        assert_true(fabs(body->vy - (velocity[1] - 9.81 * since)) < 1e-11);
        assert_true(s.state.angle[row] == angle);
        assert_true(body->radius == scree_model_drawn_radius(&s.model, s.state.id[row]));
        wanted[0] += body->mass * velocity[0];
        wanted[1] += body->mass * (velocity[1] - 9.81 * since);
        momentum[0] += body->mass * body->vx;
        momentum[1] += body->mass * body->vy;
    }
    for (int k = 0; k < 2; k++) assert_true(fabs(momentum[k] - wanted[k]) < 1e-10 * fabs(wanted[1]));
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// What a body brings is work from outside, and its potential the zero of what gravity does: the balance closes to
/// round-off (of some 1e5 steps) where nothing touches, in each scheme, and while gravity changes, too. The work of
/// gravity is that on the bodies since they were born.
static void the_balance_closes(void **unused)
{
    (void)unused;
    for (int k = 0; k < 6; k++) {
        const char *const overrides[] = {schemes[k % 3], TURNS};
        scree_case *c = case_read(HEAD DISCS("12") FLOOR("-1") SPOUT STAGES(""), overrides, k < 3 ? 1 : 2);
        scree_simulation s;
        simulation_open(c, 1, &s);
        double worst = 0, fallen = 0;
        while (simulation_goes_on(&s)) {
            simulation_step(&s);
            worst = simulation_residual(&s, worst);
        }
        for (size_t row = 0; row < s.state.count; row++)
            fallen += s.state.row[row].mass * 9.81 * (0.06 - s.state.row[row].y);
        print_message("%s, gravity %s: residual %.2g\n", schemes[k % 3], k < 3 ? "constant" : "turns", worst);
        assert_true(worst < 1e-10);
        if (k < 3) assert_true(fabs(s.sample[SCREE_SAMPLE_WORK_GRAVITY] - fallen) < 1e-12 * fallen);
        assert_true(s.state.ledger.outside > 0);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

/// With contacts the residual is that of the trapezoidal rule along the force laws: it falls at least with the square
/// of the step (measured: 3e-5 to 3e-6 here), as that of any other run.
static void the_balance_closes_on_a_pile(void **unused)
{
    (void)unused;
    const char *const steps[] = {"integrator.step_fraction=0.2", "integrator.step_fraction=0.05"};
    double worst[2];
    for (int k = 0; k < 2; k++) {
        scree_case *c = case_read(
            HEAD DISCS("25") FLOOR("0") SPOUT STAGES(", rest_time: 0.1 s, unbalanced_limit: 1e-9"), &steps[k], 1);
        scree_simulation s;
        simulation_open(c, 1, &s);
        worst[k] = simulation_finish(&s);
        print_message("%s: residual %.2g\n", steps[k], worst[k]);
        assert_int_equal(s.state.count, 25);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
    assert_true(worst[0] < 1e-3 && worst[1] < worst[0] / 8);
}

/// Polygons are born with the outline and the size of their number, turned as the source says; no two touch.
static void polygons_are_born(void **unused)
{
    (void)unused;
    const char *const override = "walls.plate.point=[0, -1]";
    scree_case *c = case_read(POLYGONS STAGES(""), &override, 1);
    scree_simulation s;
    size_t polygons = 0;
    simulation_open(c, 1, &s);
    assert_true(simulation_finish(&s) < 1e-10);
    for (size_t row = 0; row < s.state.count; row++) {
        const uint32_t id = s.state.id[row], corners = scree_polygons_of(&s.state)->of[row].count;
        scree_vector velocity;
        double angle;
        scree_source_draw_motion(&s.model, &s.model.sources[0], id, velocity, &angle);
        assert_true(s.state.angle[row] == angle);
        assert_true(fabs(scree_body_equivalent_radius(&s.state, row) - scree_model_drawn_radius(&s.model, id)) < 1e-15);
        assert_true(fabs(scree_body_bounding_radius(&s.state, row) - scree_model_drawn_bound(&s.model, id)) < 1e-15);
        assert_int_equal(corners > 0, scree_model_drawn_species(&s.model, id) == 0);
        polygons += corners > 0;
        assert_int_equal(s.state.sum[row].contacts, 0);
    }
    assert_int_equal(polygons, 27);
    scree_simulation_close(&s);
    scree_case_free(c);
}

// ---- restarts, threads -------------------------------------------------------------------------------------------

/// A case that needs all that sources remember: two of them, one follows the plateau and is shifted, one moves and
/// waits; the pile spreads past its plate.
#define TWO                                                                                                            \
    HEAD DISCS(                                                                                                        \
        "60") "walls: [{shape: box, side: outside, name: plate, lower: [-12 mm, -5 mm], upper: [12 mm, 0]}]\n"         \
              "sources:\n  - {source: line, start: [-10 mm, 8 mm], end: [10 mm, 8 mm], width: plateau, above: 4 mm,\n" \
              "     interval: 6 ms, shift: [0.4 mm, 0], count: 35}\n"                                                  \
              "  - {source: point, name: spout, place: [-5 mm, 60 mm], interval: 5 ms, motion: [10 mm/s, 0],\n"        \
              "     spread: [50 mm/s, 0]}\n"
#define SPHERES                                                                                                        \
    "scree: 1\nname: rain\ndimension: 3\ngravity: [0, 0, -9.81]\n"                                                     \
    "materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.5, restitution: 0.4}]\n"        \
    "contact: {law: hertz_mindlin}\nintegrator: {step_fraction: 0.2}\n"                                                \
    "measure: {samples: 50, cells: no}\noutput: {figures: no, paraview: no}\n"                                         \
    "particles: {shape: sphere, material: glass, count: 50, radius_min: 1 mm, radius_max: 2 mm}\n"                     \
    "walls: [{shape: plane, name: plate, point: [0, 0, 0], normal: [0, 0, 1]}]\n"                                      \
    "sources: [{source: region, lower: [0, 0, 8 mm], upper: [12 mm, 9 mm, 8 mm], batch: layer, interval: 40 ms,\n"     \
    "  above: 4 mm, velocity: [0, 0, -0.2], spread: [0.1, 0.1, 0]}]\n"

/// From a checkpoint in mid-pour, at several instants of one run, every other time with other threads.
static void a_restart_changes_nothing(void **unused)
{
    (void)unused;
    static const char *const texts[] = {TWO STAGES(", past: take_out"), SPHERES STAGES(""), POLYGONS STAGES("")};
    enum { INSTANTS = 4 };
    const double instants[INSTANTS] = {0, 0.013, 0.0501, 0.09};
    uint64_t checksum[INSTANTS], bits[INSTANTS];
    char folder[64];
    assert_true(scratch_create(folder));
    for (int t = 0; t < 3; t++) {
        scree_case *c = case_read(texts[t], NULL, 0);
        scree_simulation s, other;
        simulation_open(c, 1, &s);
        for (int k = 0; k < INSTANTS; k++) {
            while (!s.stage || !s.stage->loading || scree_state_time(&s.state) < instants[k]) simulation_step(&s);
            if (k > 0) assert_true(s.state.count > 0 && s.state.next_id < s.model.count);
            simulation_reopen(&s, k % 2 ? 3 : 1, folder, &other);
            other.work.keep_threads = true;
            (void)simulation_finish(&other);
            checksum[k] = scree_simulation_checksum(&other);
            bits[k] = simulation_close(&other);
        }
        (void)simulation_finish(&s);
        assert_true(s.state.next_id > 40);
        for (int k = 0; k < INSTANTS; k++) assert_true(checksum[k] == scree_simulation_checksum(&s));
        const uint64_t whole = simulation_close(&s);
        for (int k = 0; k < INSTANTS; k++) assert_true(bits[k] == whole);
        scree_case_free(c);
    }
    scratch_destroy(folder);
}

/// How often samples are taken does not matter, nor how old lists are.
static void samples_and_lists_change_nothing(void **unused)
{
    (void)unused;
    const char *const samples[] = {"measure.samples=50", "measure.samples=7"};
    uint64_t sums[2];
    for (int k = 0; k < 2; k++) {
        scree_case *c =
            case_read(TWO "stages: [{stage: prepare, method: empty}, {stage: pour, past: take_out}]\n", &samples[k], 1);
        scree_simulation s;
        simulation_open(c, 1, &s);
        while (scree_state_time(&s.state) < 0.15) {
            simulation_step(&s);
            if (k == 1 && s.state.step % 100 == 0) scree_neighbours_invalidate(&s.work);
        }
        simulation_bits(&s);
        sums[k] = scree_state_checksum(&s.model, &s.state);
        assert_true(scree_births_of(&s.state)->lost > 0);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
    assert_true(sums[0] == sums[1]);
}

// ---- sources that wait, and are blocked --------------------------------------------------------------------------

/// A source that is faster than what it lets go waits until each has fallen by the sum of radii: from rest that is
/// t = sqrt(2 (R + R') / g); whole steps are waited.
static void a_blocked_source_waits(void **unused)
{
    (void)unused;
    const char *const overrides[] = {"sources.0.velocity=[0, 0]", "sources.0.spread=[0, 0]", "sources.0.interval=1 ms"};
    scree_case *c = case_read(HEAD DISCS("6") FLOOR("-1") SPOUT STAGES(""), overrides, 3);
    scree_simulation s;
    simulation_open(c, 1, &s);
    (void)simulation_finish(&s);
    const double *time = scree_births_of(&s.state)->time;
    for (uint32_t id = 1; id < 6; id++) {
        uint32_t one = scree_state_row_of(&s.state, id), before = scree_state_row_of(&s.state, id - 1);
        double fall = sqrt(2 * (s.state.row[one].radius + s.state.row[before].radius) / 9.81);
        double waited = time[one] - time[before] - fall;
        assert_true(waited > -1e-9 && waited < 2 * s.state.tick);
    }
    assert_true(scree_births_of(&s.state)->source[0].waits == 5);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// Runs until it is stopped by a guard with this message.
static void stop(const char *text, const char *const *overrides, size_t count, scree_status wanted, const char *message)
{
    scree_case *c = case_read(text, overrides, count);
    scree_simulation s;
    scree_error error;
    scree_status status = SCREE_OK;
    simulation_open(c, 1, &s);
    while (!status && simulation_goes_on(&s)) status = scree_simulation_step(&s, &error);
    assert_int_equal(status, wanted);
    if (!strstr(error.message, message)) fail_msg("%s", error.message);
    scree_simulation_close(&s);
    scree_case_free(c);
}

static void what_goes_wrong_is_said(void **unused)
{
    (void)unused;
    const char *const low[] = {"sources.0.place=[0, 12 mm]", "sources.0.spread=[0, 0]", "stages.1.patience=0.2 s"};
    stop(HEAD DISCS("20") FLOOR("0") SPOUT STAGES(""), low, 3, SCREE_ERROR_GUARD, "the pile has reached the source");
    const char *const still[] = {"gravity=[0, 0]", "sources.0.velocity=[0, 0]", "sources.0.spread=[0, 0]"};
    stop(HEAD DISCS("20") FLOOR("0") SPOUT STAGES(""), still, 3, SCREE_ERROR_GUARD, "has not fallen away");
    stop(TWO STAGES(""), NULL, 0, SCREE_ERROR_GUARD, "has spread past its plate");
    const char *const inside = "sources.0.place=[0, 1 mm]", *const behind = "sources.0.place=[0, -3 mm]";
    stop(HEAD DISCS("20") FLOOR("0") SPOUT STAGES(""), &inside, 1, SCREE_ERROR_INPUT,
         "source 'point' is in wall 'plate'");
    stop(HEAD DISCS("20") FLOOR("0") SPOUT STAGES(""), &behind, 1, SCREE_ERROR_INPUT, "is behind wall 'plate'");
}

static void refuse(const char *text, const char *const *overrides, size_t count, const char *path, const char *message)
{
    scree_case *c;
    scree_problems *problems;
    if (!case_parse(text, overrides, count, &c, &problems)) fail_msg("not refused: %s", message);
    const scree_error *said = scree_problems_get(problems, 0);
    if (!strstr(said->message, message) || strcmp(said->field, path) != 0)
        fail_msg("%s: %s, not %s: %s", said->field, said->message, path, message);
    scree_problems_free(problems);
}

#define ONE(...) ((const char *const[]){__VA_ARGS__}), sizeof((const char *const[]){__VA_ARGS__}) / sizeof(char *)
static void what_is_wrong_is_said(void **unused)
{
    (void)unused;
    static const char whole[] = HEAD DISCS("20") FLOOR("0") SPOUT STAGES("");
    static const char two[] = TWO STAGES("");
    refuse(whole, ONE("boundary.periodic=x"), "sources.0.source", "do not pour into a sample that repeats itself");
    refuse(whole, ONE("stages.1.boundary=membrane"), "stages.1.boundary", "give `walls` and boundary: walls");
    refuse(HEAD DISCS("20") FLOOR("0") STAGES(""), NULL, 0, "stages.1.stage", "give `sources`");
    refuse(HEAD DISCS("20") FLOOR("0") SPOUT "stages: [{stage: prepare}, {stage: relax, duration: 1 s}]\n", NULL, 0,
           "sources.0.source", "no stage pours");
    refuse(HEAD DISCS("20") FLOOR("0") "stages: [{stage: prepare, method: empty}, {stage: relax, duration: 1 s}]\n",
           NULL, 0, "stages.1.stage", "there are no particles yet");
    refuse(whole, ONE("sources.0.interval=0 s"), "sources.0.interval", "");
    refuse(whole, ONE("sources.0.place=[0, 0, 1]"), "sources.0.place", "there is no z");
    refuse(whole, ONE("sources.0.velocity=[0, 0, 1]"), "sources.0.velocity", "there is no z");
    refuse(whole, ONE("sources.0.spread=[0, -1]"), "sources.0.spread", "a spread is not negative");
    refuse(whole, ONE("sources.0.species=sand"), "sources.0.species", "there is no species 'sand'");
    refuse(whole, ONE("sources.0.stage=poor"), "sources.0.stage", "there is no stage 'poor'; did you mean 'pour'?");
    refuse(whole, ONE("sources.0.stage=prepare"), "sources.0.stage", "this stage does not pour");
    refuse(whole, ONE("stages.0.outline=circle"), "stages.0.outline", "");
    refuse(two, ONE("sources.0.end=[-10 mm, 8 mm]"), "sources.0.end", "a line needs a length");
    refuse(two, ONE("sources.0.end=[10 mm, 9 mm]"), "sources.0.end", "a line that follows the plateau is level");
    refuse(two, ONE("measure.plate=plat"), "measure.plate", "there is no wall 'plat'; did you mean 'plate'?");
    refuse(HEAD DISCS("20") FLOOR("0") "sources: [{source: point, place: [0, 60 mm], interval: 1 ms}, {source: point, "
                                       "name: other, place: [1 mm, 62 mm],"
                                       " interval: 1 ms}]\n" STAGES(""),
           NULL, 0, "sources.1.source", "it is in the same place as sources.0");
}

// ---- what ends a stage -------------------------------------------------------------------------------------------

/// Steps to the end of the stage; how many bodies have been born by then.
static uint64_t pour(scree_simulation *s)
{
    do simulation_step(s);
    while (!s->stage_ended);
    return s->state.next_id;
}

/// A stage has its count, a source its own, and the next stage goes on where the last one ended.
static void counts_end_a_stage(void **unused)
{
    (void)unused;
    scree_case *c = case_read(
        HEAD DISCS("20")
            FLOOR("0") "sources:\n  - {source: point, name: a, place: [0, 60 mm], interval: 5 ms, count: 6}\n"
                       "  - {source: point, name: b, place: [20 mm, 60 mm], interval: 5 ms, stage: second}\n"
                       "stages:\n  - {stage: prepare, method: empty}\n  - {stage: pour, name: first, count: 4}\n"
                       "  - {stage: pour, name: second, count: 7}\n  - {stage: pour, name: third}\n"
                       "  - {stage: relax, duration: 1 ms}\n",
        NULL, 0);
    scree_simulation s;
    simulation_open(c, 1, &s);
    assert_int_equal(pour(&s), 0); // prepare
    assert_int_equal(pour(&s), 4);
    assert_int_equal(pour(&s), 11);
    const scree_births *births = scree_births_of(&s.state);
    assert_true(births->source[0].born == 6 && births->source[1].born == 5);
    // Source a has no more, and b does not pour here.
    assert_int_equal(pour(&s), 11);
    assert_int_equal(births->end, SCREE_POUR_OUT);
    assert_int_equal(pour(&s), 11); // relax
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// The pile as it is.
static void measure(scree_simulation *s, scree_pile *pile)
{
    scree_error error;
    check(scree_neighbours_refresh(&s->stage_model, &s->state, &s->work, &error), &error);
    check(scree_contact_table_build(&s->stage_model, &s->state, &s->work, &s->table, &error), &error);
    check(scree_pile_measure(&s->stage_model, &s->state, &s->work, &s->table, 0, pile, &error), &error);
}

static void height_and_width_end_a_stage(void **unused)
{
    (void)unused;
    static const char *const limits[] = {"stages.1.height=9 mm", "stages.1.width=25 mm"};
    for (int k = 0; k < 2; k++) {
        scree_case *c = case_read(HEAD DISCS("200") FLOOR("0") SPOUT STAGES(""), &limits[k], 1);
        scree_simulation s;
        simulation_open(c, 1, &s);
        do simulation_step(&s);
        while (scree_births_of(&s.state)->end == SCREE_POUR_GOES_ON);
        assert_true(s.state.next_id < 150);
        assert_int_equal(scree_births_of(&s.state)->end, k ? SCREE_POUR_WIDTH : SCREE_POUR_HEIGHT);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

// ---- places ------------------------------------------------------------------------------------------------------

/// A layer at once: as many as fit, none touches another, each in its slot; the next one is shifted by the same way.
static void layers_lie_side_by_side(void **unused)
{
    (void)unused;
    scree_case *c =
        case_read(HEAD DISCS("24") FLOOR("-1") "sources: [{source: line, start: [0, 0], end: [40 mm, 0], batch: layer, "
                                               "interval: 0.1 s, shift: [3 mm, 0]}]\n" STAGES(""),
                  NULL, 0);
    scree_simulation s;
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    simulation_open(c, 1, &s);
    while (s.state.next_id < 24) simulation_step(&s);
    // 40 mm over 2.2 largest radii of 2.5 mm, and one.
    assert_true(scree_births_of(&s.state)->source[0].layer == 3);
    for (size_t row = 0; row < s.state.count; row++) {
        const scree_row *one = &s.state.row[row];
        int layer = (int)(s.state.id[row] / 8);
        low[layer] = fmin(low[layer], one->x);
        high[layer] = fmax(high[layer], one->x);
        for (size_t k = 0; k < row; k++)
            assert_true(hypot(one->x - s.state.row[k].x, one->y - s.state.row[k].y) >
                        one->radius + s.state.row[k].radius);
    }
    for (int layer = 0; layer < 3; layer++) {
        assert_true(low[layer] >= 3e-3 * layer && low[layer] < 3e-3 * layer + 1e-3);
        assert_true(high[layer] <= 40e-3 + 3e-3 * layer && high[layer] > 39e-3 + 3e-3 * layer);
    }
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// A source above the pile stays so far above its top, and one that follows the plateau stays inside of it; a moving
/// one is where its time says.
static void sources_follow(void **unused)
{
    (void)unused;
    // A plate that has room for flanks.
    static const char *const overrides[] = {"walls.0.lower=[-30 mm, -5 mm]", "walls.0.upper=[30 mm, 0]"};
    scree_case *c = case_read(TWO STAGES(", past: take_out"), overrides, 2);
    scree_simulation s;
    simulation_open(c, 1, &s);
    uint64_t before = 0, moved = 0;
    int narrower = 0;
    const scree_births *births = scree_births_of(&s.state);
    while (simulation_goes_on(&s) && s.state.next_id < 60) {
        scree_source_state line = births->source[0];
        simulation_step(&s);
        births = scree_births_of(&s.state);
        for (; before < s.state.next_id; before++) {
            const size_t row = scree_state_row_of(&s.state, before);
            const scree_row *body = &s.state.row[row];
            const double time = births->time[row];
            const bool of_line =
                births->source[0].born > line.born && births->source[1].born + births->source[0].born == before + 1;
            const double back = scree_state_time(&s.state) - time; // one step
            if (!of_line || births->source[0].layer == line.layer + 1) continue;
            const scree_source_state *now = &births->source[0];
            if (isnan(now->top)) continue;
            moved++;
            // Born so far above the top of then; it has fallen for a step.
            assert_true(fabs(body->y - body->radius - (now->top + 4e-3)) < 9.81 * back * back + 1e-12);
            if (isnan(now->left)) continue;
            const double shift = 0.4e-3; // against the layer before, wherever that lies
            assert_true(body->x >= now->left + shift - 1e-12 && body->x <= now->right + shift + 1e-12);
            narrower += now->right - now->left < 20e-3;
        }
    }
    assert_true(moved > 5 && narrower > 3);
    // 10 mm/s from -5 mm.
    scree_source_place place;
    scree_source_place_now(&s.model, &s.model.sources[1], &births->source[1], 0.25, 1e-3, &place);
    assert_true(fabs(place.origin[0] - (-5e-3 + 10e-3 * (0.25 - births->source[1].start))) < 1e-15);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// A source above the pile rises with it within a layer, when the pile has grown into its way: 30 discs of one layer in
/// a shaft two diameters wide and 4 mm below it.
static void a_source_is_not_buried(void **unused)
{
    (void)unused;
    scree_case *c = case_read(
        HEAD
        "particles: {shape: disc, material: glass, count: 30, distribution: equal, radius: 2 mm}\n"
        "walls:\n  - {shape: plane, name: floor, point: [0, 0], normal: [0, 1]}\n"
        "  - {shape: plane, point: [0, 0], normal: [1, 0]}\n  - {shape: plane, point: [8.2 mm, 0], normal: [-1, 0]}\n"
        "sources: [{source: line, start: [2.1 mm, 6 mm], end: [6 mm, 6 mm], above: 4 mm, layer: 30, interval: 20 "
        "ms}]\n"
        "stages:\n  - {stage: prepare, method: empty}\n  - {stage: pour, patience: 0.5 s}\n",
        NULL, 0);
    scree_simulation s;
    simulation_open(c, 1, &s);
    while (simulation_goes_on(&s)) simulation_step(&s);
    assert_int_equal(s.state.next_id, 30);
    assert_int_equal(scree_births_of(&s.state)->source[0].layer, 1);
    assert_true(scree_births_of(&s.state)->source[0].waits > 2);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// Rows of fixed discs as a rough bottom: they are of the case, but not of the pile.
static void a_rough_bottom(void **unused)
{
    (void)unused;
    scree_case *c = case_read(
        HEAD "particles: {shape: disc, material: glass, count: 14, distribution: equal, radius: 2 mm}\n" FLOOR(
            "-20 mm") "sources: [{source: line, start: [6 mm, 4.5 mm], end: [14 mm, 4.5 mm], batch: layer, interval: 1 "
                      "s}]\n"
                      "selections: [{select: ids, name: bottom, ids: [0, 1, 2, 3, 4, 5]}]\n"
                      "loads: [{load: prescribed, selection: bottom, velocity_x: 0, velocity_y: 0, spin_z: 0}]\n"
                      "stages:\n  - {stage: prepare, method: bodies, bodies: [{position: [0, 0]}, {position: [4 mm, "
                      "0]},\n"
                      "     {position: [8 mm, 0]}, {position: [12 mm, 0]}, {position: [16 mm, 0]}, {position: [20 mm, "
                      "0]}]}\n"
                      "  - {stage: pour, count: 2}\n  - {stage: relax, duration: 0.4 s}\n",
        NULL, 0);
    scree_simulation s;
    scree_pile pile;
    simulation_open(c, 1, &s);
    (void)simulation_finish(&s);
    assert_int_equal(s.state.count, 8);
    measure(&s, &pile);
    assert_int_equal(pile.grains, 2);
    double weight = 0;
    for (size_t row = 0; row < s.state.count; row++)
        if (s.state.id[row] >= 6) weight += 9.81 * s.state.row[row].mass;
    assert_true(fabs(pile.weight - weight) < 1e-12 * weight);
    // The fixed row bears it; the plate far below nothing.
    assert_true(fabs(pile.support - weight) < 1e-3 * weight && pile.plate == 0);
    assert_true(pile.base > 0 && pile.base < 2.1e-3);
    scree_pile_destroy(&pile);
    scree_simulation_close(&s);
    scree_case_free(c);
}

// ---- the measure of a pile ---------------------------------------------------------------------------------------

/// A triangle of equal discs on a plate, ROWS high; one disc lies apart, one flies. Centres on a triangular lattice,
/// closer by a share CLOSE so that they touch.
enum { ROWS = 9 };
#define RADIUS 2e-3
#define CLOSE  1e-4
static void a_triangle_is_measured(void **unused)
{
    (void)unused;
    static char text[16384];
    size_t length = (size_t)snprintf(
        text, sizeof text,
        HEAD "particles: {shape: disc, material: glass, count: %d, distribution: equal, radius: 2 mm}\n" FLOOR(
            "0") "stages:\n  - {stage: relax, duration: 1 s}\n",
        ROWS * (ROWS + 1) / 2 + 2);
    char *stages = strstr(text, "stages:\n") + strlen("stages:\n");
    length = (size_t)(stages - text);
    const double pitch = 2 * RADIUS * (1 - CLOSE), rise = pitch * sqrt(0.75), low = RADIUS * (1 - CLOSE);
    length += (size_t)snprintf(text + length, sizeof text - length, "  - {stage: prepare, method: bodies, bodies: [");
    for (int row = 0; row < ROWS; row++)
        for (int k = 0; k < ROWS - row; k++)
            length += (size_t)snprintf(text + length, sizeof text - length, "{position: [%.12g, %.12g]}, ",
                                       0.1 + pitch * (k + 0.5 * row), low + rise * row);
    (void)snprintf(text + length, sizeof text - length,
                   "{position: [0.2, %.12g]}, {position: [0.15, 0.1]}]}\n  - {stage: relax, duration: 1 s}\n", low);
    scree_case *c = case_read(text, NULL, 0);
    scree_simulation s;
    scree_pile pile;
    simulation_open(c, 1, &s);
    while (!s.stage || !s.stage->loading) simulation_step(&s);
    measure(&s, &pile);
    const double height = low + rise * (ROWS - 1) + RADIUS, half = 0.5 * pitch * (ROWS - 1) + RADIUS;
    assert_int_equal(pile.grains, ROWS * (ROWS + 1) / 2 + 1);
    assert_true(fabs(pile.top - pile.base - height) < 1e-6);
    assert_true(fabs(pile.apex - (0.1 + 0.5 * pitch * (ROWS - 1))) < 1e-12);
    // Ends lie on the boundaries of columns, a mean radius wide.
    assert_true(fabs(pile.right - pile.apex - half) <= RADIUS && fabs(pile.apex - pile.left - half) <= RADIUS);
    for (int side = 0; side < 2; side++) {
        assert_true(fabs(tan(pile.angle[side]) - height / half) < 0.2 * height / half);
        // The surface of the lattice has the slope of 60 degrees; steps of a radius make it uncertain.
        assert_true(fabs(pile.fitted[side] * 180 / M_PI - 60) < 2);
    }
    assert_true(fabs(pile.weight - 9.81 * 46 * s.state.row[0].mass) < 1e-12 * pile.weight);
    // What lies less than two rows and a half below the top: its second row from above on, three discs wide.
    double left = pile.left, right = pile.right, area = 0;
    for (size_t k = 0; k < pile.columns; k++)
        if (pile.column[k].x > left && pile.column[k].x < right) area += RADIUS * pile.column[k].height;
    scree_pile_plateau(&pile, area / (right - left) - (height - 2.5 * rise), &left, &right);
    assert_true(fabs(right - left - (2 * pitch + 2 * RADIUS)) <= 2 * RADIUS);
    scree_pile_destroy(&pile);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// A plateau of 40 columns with flanks of 45 degrees, grains apart from each other and a heap on it: its ends are those
/// of what lies less than the depth below the mean, wherever the highest grain is.
static void a_rough_plateau_keeps_its_width(void **unused)
{
    (void)unused;
    enum { COLUMNS = 60 };
    scree_pile_column column[COLUMNS];
    const scree_pile pile = {.column = column, .columns = COLUMNS, .base = 0, .top = 16, .apex = 15.5};
    for (int k = 0; k < COLUMNS; k++) column[k] = (scree_pile_column){k + 0.5, fmin(10, fmin(k + 1, COLUMNS - k))};
    for (int k = 10; k < 50; k += 5) column[k].height = column[k + 1].height = column[k + 2].height = NAN;
    for (int k = 13; k < 18; k++) column[k].height = 16;
    double mean = 0, left = 5, right = 55;
    for (int k = 5; k < 55; k++) mean += (isnan(column[k].height) ? 0 : column[k].height) / 50;
    const double depths[] = {mean - 9.5, mean - 6.5, mean - 0.5};
    const double ends[] = {9, 6, 5}; // not beyond what it was
    for (size_t d = 0; d < sizeof depths / sizeof *depths; d++) {
        left = 5, right = 55;
        scree_pile_plateau(&pile, depths[d], &left, &right);
        assert_true(left == ends[d] && right == COLUMNS - ends[d]);
    }
    // Ends need not be those of columns; they stay where the pile is not higher than the depth, or elsewhere.
    left = 20.25, right = 30.75;
    scree_pile_plateau(&pile, 1, &left, &right);
    assert_true(left == 20.25 + 2.75 && right == 30);
    left = -8, right = 3;
    scree_pile_plateau(&pile, 1, &left, &right);
    assert_true(left == -8 && right == 3);
    left = 70, right = 80;
    scree_pile_plateau(&pile, 1, &left, &right);
    assert_true(left == 70 && right == 80);
}

#define RAIN                                                                                                           \
    HEAD "particles: {shape: disc, material: glass, count: 240, distribution: uniform, radius_min: 0.9 mm, "           \
         "radius_max: 1.1 mm}\n" FLOOR(                                                                                \
             "0") "sources: [{source: line, name: rain, start: [-50 mm, 4 mm], end: [50 mm, 4 mm], interval: 2 ms,"    \
                  " width: plateau, above: 2 mm}]\n" STAGES("")

/// A line as wide as the foot rains to the end: it has become narrow when the last grains come, not at once.
static void a_line_narrows_layer_by_layer(void **unused)
{
    (void)unused;
    scree_case *c = case_read(RAIN, NULL, 0);
    scree_simulation s;
    simulation_open(c, 1, &s);
    const scree_births *births = scree_births_of(&s.state);
    const double slope = tan(35 * M_PI / 180);
    uint64_t layer = 0;
    double width = 0.1;
    while (simulation_goes_on(&s) && s.state.next_id < 240) {
        simulation_step(&s);
        births = scree_births_of(&s.state);
        const scree_source_state *rain = &births->source[0];
        if (rain->layer == layer || rain->in_layer == 0) continue;
        layer = rain->layer;
        assert_true(rain->right - rain->left <= width + 1e-12);
        width = rain->right - rain->left;
        // Flanks are no flatter than discs with friction lie anyhow, so no end has gone in farther than by its height.
        assert_true(width > 0.1 - 2 * (rain->top / slope + 4e-3));
    }
    assert_true(layer >= 4);
    scree_simulation_close(&s);
    scree_case_free(c);
    // One that stops has poured what its plateau takes, and the stage says so.
    static const char *const stop[] = {"sources.0.past_plateau=stop", "sources.0.start=[-8 mm, 4 mm]",
                                       "sources.0.end=[8 mm, 4 mm]", "sources.0.interval=10 ms"};
    c = case_read(RAIN, stop, 4);
    simulation_open(c, 1, &s);
    (void)simulation_finish(&s);
    births = scree_births_of(&s.state);
    width = births->source[0].right - births->source[0].left;
    assert_int_equal(births->end, SCREE_POUR_PLATEAU);
    assert_true(s.state.next_id > 40 && s.state.next_id < 240 && width < 6.1e-3 && births->source[0].in_layer == 0);
    scree_simulation_close(&s);
    scree_case_free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rough_plateau_keeps_its_width),
        cmocka_unit_test(a_line_narrows_layer_by_layer),
        cmocka_unit_test(what_is_born_falls),
        cmocka_unit_test(the_balance_closes),
        cmocka_unit_test(the_balance_closes_on_a_pile),
        cmocka_unit_test(polygons_are_born),
        cmocka_unit_test(a_restart_changes_nothing),
        cmocka_unit_test(samples_and_lists_change_nothing),
        cmocka_unit_test(a_blocked_source_waits),
        cmocka_unit_test(what_goes_wrong_is_said),
        cmocka_unit_test(what_is_wrong_is_said),
        cmocka_unit_test(counts_end_a_stage),
        cmocka_unit_test(height_and_width_end_a_stage),
        cmocka_unit_test(layers_lie_side_by_side),
        cmocka_unit_test(sources_follow),
        cmocka_unit_test(a_source_is_not_buried),
        cmocka_unit_test(a_rough_bottom),
        cmocka_unit_test(a_triangle_is_measured),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
