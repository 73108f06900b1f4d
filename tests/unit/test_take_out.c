/// Bodies that are taken out of runs, and put into them: the balance of energy stays closed, the boundary stays whole,
/// and what goes on from a checkpoint does so with the same bits.
#include "run_fixture.h"

#include "base/random.h"
#include "boundary_cases.h"
#include "io_scratch.h"
#include "measure/delaunay_boundary.h"
#include "measure/facets.h"
#include "measure/hull.h"
#include "measure/imposed_gradient.h"
#include "measure/removal.h"

#define COMMON(dimension, shape, more)                                                                                 \
    "scree: 1\n"                                                                                                       \
    "name: small\n"                                                                                                    \
    "dimension: " dimension "\n"                                                                                       \
    "seed: 3\n"                                                                                                        \
    "materials:\n"                                                                                                     \
    "  - {name: quartz, young_modulus: 30 GPa, density: 2.675e8 kg/m3, friction: 0.45, restitution: 0.2" more "}\n"    \
    "particles: {material: quartz, shape: " shape ", count: 60, radius_min: 0.6 mm, radius_max: 0.9 mm}\n"             \
    "contact: {law: hertz_mindlin, reference_velocity: 1e-4 m/s}\n"                                                    \
    "integrator: {scheme: velocity_verlet, step: 2e-6 s}\n"                                                            \
    "measure: {samples: 20, cells: no}\n"                                                                              \
    "output: {snapshots: 0, paraview: no, figures: no}\n"
#define CONFINED                                                                                                       \
    "boundary: {every: 100}\n"                                                                                         \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, aspect_ratio: 1.5}\n"                                                                        \
    "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 5e-2}\n"
#define COMPRESSED "  - {stage: compress, strain: 0.02 %, rate: 5e-2 1/s}\n"
#define GAS                                                                                                            \
    "boundary: {periodic: xy}\n"                                                                                       \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, method: gas, solid_fraction: 10 %, velocity: 2 mm/s}\n"                                      \
    "  - {stage: relax, duration: 10 ms}\n"
#define CELL                                                                                                           \
    "boundary: {periodic: xy}\n"                                                                                       \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, method: gas, solid_fraction: 45 %, velocity: 20 mm/s}\n"                                     \
    "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 0.5, ramp_time: 1 ms}\n"                                \
    "  - {stage: deform, strain: 0.2 %, velocity_gradient: {xy: 0.8 1/s, yx: 0}}\n"

/// `rest` of the stage is done after the removal.
static const struct {
    const char *name, *text, *override;
    bool touches;
} runs[] = {
    {"discs under a pressure", COMMON("2", "disc", "") CONFINED COMPRESSED, "boundary.lateral=pressure", true},
    {"discs between plates", COMMON("2", "disc", "") CONFINED COMPRESSED, "boundary.lateral=plates", true},
    {"discs, position_verlet", COMMON("2", "disc", "") CONFINED COMPRESSED, "integrator.scheme=position_verlet", true},
    {"discs that roll with resistance", COMMON("2", "disc", ", rolling_friction: 0.1") CONFINED COMPRESSED,
     "boundary.lateral=pressure", true},
    {"discs, minimal conditions", COMMON("2", "disc", "") CONFINED COMPRESSED, "stages.compress.boundary=minimal",
     true},
    {"discs in a membrane", COMMON("2", "disc", "") CONFINED COMPRESSED, "stages.compress.boundary=membrane", true},
    {"spheres under a pressure",
     COMMON("3", "sphere", ", rolling_friction: 0.1, twisting_friction: 0.1") CONFINED COMPRESSED,
     "boundary.lateral=pressure", true},
    {"spheres, minimal conditions", COMMON("3", "sphere", "") CONFINED COMPRESSED, "stages.compress.boundary=minimal",
     true},
    {"discs in a periodic cell", COMMON("2", "disc", "") CELL, "seed=4", true},
    {"a gas", COMMON("2", "disc", "") GAS, "seed=5", false},
};
enum { RUNS = sizeof runs / sizeof *runs };

static double residual(scree_simulation *s, double *scale)
{
    scree_error error;
    scree_contact_table table = {0};
    scree_energy energy;
    check(scree_neighbours_refresh(&s->stage_model, &s->state, &s->work, &error), &error);
    check(scree_contact_table_build(&s->stage_model, &s->state, &s->work, &table, &error), &error);
    scree_energy_measure(&s->stage_model, &s->state, &table, &energy);
    scree_contact_table_destroy(&table);
    if (scale) *scale = energy.scale;
    return energy.residual;
}

static double kinetic(scree_simulation *s)
{
    scree_contact_table none = {0};
    scree_energy energy;
    scree_energy_measure(&s->stage_model, &s->state, &none, &energy);
    return energy.kinetic + energy.kinetic_rotation;
}

/// Every edge of the hull belongs to two triangles that run along it in opposite senses; every node has one.
static void assert_closed(const scree_state *state)
{
    const scree_hull *hull = scree_hull_of(state);
    for (size_t t = 0; t < hull->triangle_count; t++)
        for (int c = 0; c < 3; c++) {
            uint32_t a = hull->triangle[t][c], b = hull->triangle[t][(c + 1) % 3];
            int balance = 0;
            assert_true(a < hull->node_count && a != b);
            for (size_t other = 0; other < hull->triangle_count; other++)
                for (int d = 0; d < 3; d++) {
                    uint32_t from = hull->triangle[other][d], to = hull->triangle[other][(d + 1) % 3];
                    balance += (from == a && to == b) - (from == b && to == a);
                }
            assert_int_equal(balance, 0);
        }
}

static void assert_boundary_is_whole(const scree_state *state, size_t before, size_t went)
{
    size_t count = scree_boundary_count(state);
    assert_int_equal(count, before - went);
    assert_true(scree_imposed(state)->count == 0 || scree_imposed(state)->count == count);
    for (size_t k = 0; k < count; k++) {
        const uint32_t *id = state->dimension == 3 ? scree_hull_of(state)->id : scree_loop_of(state)->id;
        assert_true(scree_state_row_of(state, id[k]) != SCREE_NO_ROW);
        if (state->dimension == 3 && k > 0) assert_true(id[k] > id[k - 1]);
    }
    if (state->dimension == 3) assert_closed(state);
}

/// Bodies to be taken out: two of the boundary, if there is one, and `more` others.
static size_t choose(const scree_state *state, size_t more, uint32_t *ids, size_t *of_boundary)
{
    size_t count = 0, nodes = scree_boundary_count(state);
    const uint32_t *boundary = state->dimension == 3 ? scree_hull_of(state)->id : scree_loop_of(state)->id;
    *of_boundary = nodes > 0 ? 2 : 0;
    for (size_t k = 0; k < *of_boundary; k++) ids[count++] = boundary[k * nodes / 2];
    for (uint32_t id = 0; more > 0; id++) {
        uint32_t row = scree_state_row_of(state, id);
        bool taken = row == SCREE_NO_ROW || !scree_body_is_grain(state, row) || state->sum[row].contacts == 1;
        for (size_t k = 0; k < nodes; k++) taken = taken || boundary[k] == id;
        if (taken) continue;
        ids[count++] = id;
        more--;
    }
    return count;
}

static scree_simulation begin(const scree_case *c)
{
    scree_simulation s;
    simulation_open(c, 1, &s);
    while (s.state.stage.index + 1 < s.model.stage_count || s.state.stage.counter < 0) simulation_step(&s);
    for (int k = 0; k < 50; k++) simulation_step(&s);
    return s;
}

static void remove_bodies(scree_simulation *s, const uint32_t *ids, size_t count)
{
    scree_error error;
    check(scree_bodies_remove(&s->stage_model, &s->state, &s->work, ids, count, &error), &error);
}

/// The residual does not move at the removal, nor in what follows.
static void assert_energy_stays_closed(scree_simulation *s, int k, const uint32_t *ids, size_t count,
                                       size_t of_boundary)
{
    const size_t nodes = scree_boundary_count(&s->state), bodies = s->state.count;
    double scale, before = residual(s, NULL), moving = kinetic(s);
    remove_bodies(s, ids, count);
    assert_int_equal(s->state.count, bodies - count);
    assert_int_equal(s->state.next_id, bodies);
    assert_boundary_is_whole(&s->state, nodes, of_boundary);
    double after = residual(s, &scale);
    assert_true(fabs(after - before) < 1e-13 * scale);
    // Without contacts what goes is the motion alone.
    if (!runs[k].touches) assert_true(fabs(moving - kinetic(s) - s->state.ledger.removed) < 1e-12 * moving);
    if (runs[k].touches) assert_true(s->state.ledger.removed != 0);
    // The released contacts let the sample move. Largest of these runs: 9e-10; 1e-8 with the forces of what is gone
    // left in the sums of the others.
    double worst = 0;
    for (int step = 0; step < 300 && simulation_goes_on(s); step++) {
        simulation_step(s);
        worst = fmax(worst, fabs(residual(s, &scale) - before) / scale);
    }
    print_message("%s: %.2g of the energy left, residual over work afterwards %.2g\n", runs[k].name,
                  s->state.ledger.removed / scale, worst);
    assert_true(worst < 2e-9);
    assert_int_equal(scree_delaunay_boundary_of(&s->state)->stale, 0);
}

/// With holes in the ids: the same bits from a checkpoint, and with the work lost.
static void assert_goes_on_bit_for_bit(scree_simulation *s, const uint32_t *ids, size_t count)
{
    scree_simulation other;
    scree_error error;
    remove_bodies(s, ids, count);
    simulation_reopen(s, 2, scratch, &other);
    assert_int_equal(other.state.next_id, s->state.next_id);
    for (int step = 0; step < 200 && simulation_goes_on(s); step++) {
        if (step == 70) simulation_lose_work(s, 1);
        simulation_step(s);
        simulation_step(&other);
    }
    check(scree_contacts_save(&s->state, &s->work, &error), &error);
    check(scree_contacts_save(&other.state, &other.work, &error), &error);
    assert_true(scree_state_checksum(&s->model, &s->state) == scree_state_checksum(&other.model, &other.state));
    assert_true(state_bits(&s->state) == state_bits(&other.state));
    scree_simulation_close(&other);
}

/// Both, from one begin.
static void bodies_are_taken_out(void **unused)
{
    (void)unused;
    for (int k = 0; k < RUNS; k++) {
        scree_case *c = case_read(runs[k].text, &runs[k].override, 1);
        scree_simulation s = begin(c), again;
        uint32_t ids[8];
        size_t of_boundary;
        const size_t count = choose(&s.state, 3, ids, &of_boundary);
        simulation_reopen(&s, 1, scratch, &again);
        assert_energy_stays_closed(&s, k, ids, count, of_boundary);
        assert_goes_on_bit_for_bit(&again, ids, count);
        scree_simulation_close(&again);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

/// A body in the place of one that was there, at rest.
static void put_in(scree_simulation *s, const scree_row *like)
{
    scree_error error;
    check(scree_neighbours_refresh(&s->stage_model, &s->state, &s->work, &error), &error);
    check(scree_contacts_save(&s->state, &s->work, &error), &error);
    size_t row = s->state.count;
    check(scree_state_append(&s->state, SCREE_MARK_GRAIN, 1, &error), &error);
    s->state.row[row] = *like;
    s->state.row[row].vx = s->state.row[row].vy = s->state.row[row].spin = 0;
    scree_body_position(&s->state, row, s->state.reference[row]);
    check(scree_neighbours_refresh(&s->stage_model, &s->state, &s->work, &error), &error);
}

static void shuffle_rows(scree_simulation *s, uint64_t draw)
{
    scree_error error;
    uint32_t order[128];
    size_t n = s->state.count, shift = 1 + (size_t)(draw % (n - 1));
    for (size_t k = 0; k < n; k++) order[k] = (uint32_t)((k + shift) % n);
    check(scree_contacts_save(&s->state, &s->work, &error), &error);
    check(scree_state_permute(&s->state, order, &error), &error);
    scree_contact_scratch_destroy(&s->work);
    scree_work_destroy(&s->work);
    check(scree_work_create(&s->work, &s->model, 1, &error), &error);
}

/// A run in which bodies go and come and rows change: after each move the invariants, and in the end the bits of one
/// that went on from a checkpoint in the middle.
static void any_sequence_keeps_the_invariants(void **unused)
{
    (void)unused;
    for (int k = RUNS - 2; k < RUNS; k++) {
        scree_case *c = case_read(runs[k].text, &runs[k].override, 1);
        scree_simulation s = begin(c);
        double before = residual(&s, NULL), scale;
        for (uint64_t move = 0; move < 60; move++) {
            double u = scree_random_uniform(11, SCREE_RANDOM_TEST, move);
            uint32_t id = s.state.id[(size_t)(u * 1e6) % s.state.count];
            scree_row like = s.state.row[scree_state_row_of(&s.state, id)];
            size_t given = s.state.next_id, count = s.state.count;
            if (move % 3 == 0) remove_bodies(&s, &id, 1);
            if (move % 6 == 0) put_in(&s, &like);
            if (move % 3 == 1) shuffle_rows(&s, (uint64_t)(u * 1e6));
            if (move % 3 == 2)
                for (int step = 0; step < 5; step++) simulation_step(&s);
            assert_int_equal(s.state.next_id, given + (move % 6 == 0));
            assert_int_equal(s.state.count, count - (move % 3 == 0) + (move % 6 == 0));
            assert_int_equal(scree_grain_count(&s.state), s.state.count);
            for (size_t row = 0; row < s.state.count; row++)
                assert_int_equal(scree_state_row_of(&s.state, s.state.id[row]), row);
            if (move % 3 == 0) assert_int_equal(scree_state_row_of(&s.state, id), SCREE_NO_ROW);
            // What was put in touches others in a dense cell, and its springs were loaded by nobody.
            if (move % 6 == 0) before = residual(&s, NULL);
            assert_true(fabs(residual(&s, &scale) - before) < 1e-6 * scale);
            if (move % 20 == 19) {
                scree_simulation other;
                simulation_reopen(&s, 1, scratch, &other); // bits are compared there
                for (int step = 0; step < 3; step++) {
                    simulation_step(&s);
                    simulation_step(&other);
                }
                assert_true(simulation_bits(&s) == simulation_close(&other));
            }
        }
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

/// A body that is kept, and one that is not there.
static void refusals(void **unused)
{
    (void)unused;
    scree_case *c = case_read(runs[5].text, &runs[5].override, 1);
    scree_simulation s = begin(c);
    scree_error error = {0};
    uint32_t last = (uint32_t)s.state.next_id - 1, none = last + 1;
    uint64_t bits = simulation_bits(&s);
    assert_int_equal(scree_bodies_remove(&s.stage_model, &s.state, &s.work, &last, 1, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "it is of the membrane"));
    assert_int_equal(scree_bodies_remove(&s.stage_model, &s.state, &s.work, &none, 1, &error), SCREE_ERROR_INPUT);
    assert_true(simulation_bits(&s) == bits);
    scree_simulation_close(&s);
    scree_case_free(c);
}

#define WITH_SCRATCH(test) cmocka_unit_test_setup_teardown(test, make_scratch, remove_scratch)
int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_SCRATCH(bodies_are_taken_out),
        WITH_SCRATCH(any_sequence_keeps_the_invariants),
        cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
