/// Pressure on the Delaunay boundary: which edges carry it, what it adds up to, its work, its strain.
#include "boundary_fixture.h"
#include "measure/delaunay_boundary.h"
#include "state/plates.h"

#include "integrate/integrate.h"
#include "measure/outline.h"
#include "state/pressure.h"
#include "state_bits.h"

#include <stdlib.h>

/// columns x rows discs.
static void bench_create(bench *b, size_t columns, size_t rows, bool plates)
{
    bench_begin(b, 2, columns * rows, 1e-6);
    bench_fill(b, columns, plates);
}

static void add_sums(const scree_state *state, int64_t total[2], double sides[2])
{
    double middle = 0;
    total[0] = total[1] = 0;
    sides[0] = sides[1] = 0;
    for (size_t i = 0; i < state->count; i++) middle += state->row[i].x / (double)state->count;
    for (size_t i = 0; i < state->count; i++) {
        total[0] += state->sum[i].fx;
        total[1] += state->sum[i].fy;
        sides[state->row[i].x > middle] += (double)state->sum[i].fx * state->force_quantum;
    }
}

static void a_closed_loop_has_no_net_force(void **user)
{
    (void)user;
    bench b;
    bench_create(&b, 9, 17, false);
    assert_int_equal(scree_boundary_refresh(&b.model, &b.state, NULL), SCREE_OK);
    for (size_t k = 0; k < scree_loop_of(&b.state)->count; k++) assert_int_equal(scree_loop_of(&b.state)->loaded[k], 1);
    scree_pressure_forces(&b.model, &b.state);
    int64_t total[2];
    double sides[2], kept = 0, largest = 0;
    add_sums(&b.state, total, sides);
    assert_int_equal(total[0], 0); // as integers
    assert_int_equal(total[1], 0);
    assert_true(sides[0] > 0 && sides[1] < 0); // inwards
    // What the loop keeps is what the bodies got, exactly: integers of less than 53 bits times a power of two.
    for (size_t k = 0; k < scree_loop_of(&b.state)->count; k++) {
        scree_sum_row *sum = &b.state.sum[b.state.row_of_id[scree_loop_of(&b.state)->id[k]]];
        assert_true(scree_loop_of(&b.state)->fx[k] == (double)sum->fx * QUANTUM &&
                    scree_loop_of(&b.state)->fy[k] == (double)sum->fy * QUANTUM);
        kept += fabs(scree_loop_of(&b.state)->fx[k]);
        largest = fmax(largest, hypot(scree_loop_of(&b.state)->fx[k], scree_loop_of(&b.state)->fy[k]));
    }
    assert_true(kept > 0);
    assert_true(largest <= scree_pressure_bound(&b.model, &b.state));
    scree_state_destroy(&b.state);
}

static void plates_take_the_ends(void **user)
{
    (void)user;
    bench b;
    bench_create(&b, 9, 17, true);
    assert_int_equal(scree_boundary_refresh(&b.model, &b.state, NULL), SCREE_OK);
    scree_state *state = &b.state;
    double height = -(scree_plates(state)[SCREE_WALL_BOTTOM].position + scree_plates(state)[SCREE_WALL_TOP].position);
    // Unloaded edges lie along a plate, loaded ones join bodies of which one at most is near it (a corner).
    size_t runs = 0;
    for (size_t k = 0; k < scree_loop_of(state)->count; k++) {
        double a[2], c[2];
        scree_loop_position(state, k, a);
        scree_loop_position(state, (k + 1) % scree_loop_of(state)->count, c);
        if (scree_loop_of(state)->loaded[k]) continue;
        bool bottom = a[1] < 3.2 * RADIUS && c[1] < 3.2 * RADIUS && c[0] > a[0];
        bool top = a[1] > height - 5 * RADIUS && c[1] > height - 5 * RADIUS && c[0] < a[0];
        assert_true(bottom || top);
        runs += scree_loop_of(state)->loaded[(k + 1) % scree_loop_of(state)->count];
    }
    assert_int_equal(runs, 2);
    scree_pressure_forces(&b.model, state);
    int64_t total[2];
    double sides[2];
    add_sums(state, total, sides);
    double expected = PRESSURE * height * THICKNESS;
    assert_int_equal(total[0], 0); // both sides alike, as integers
    // Rounding of some 40 forces to 2^-50 N each, and of the products that they come from.
    assert_true(fabs(sides[0] - expected) < 1e-12 * expected);
    assert_true(fabs(sides[1] + expected) < 1e-12 * expected);
    scree_state_destroy(state);
}

static void plates_all_round_leave_nothing_to_press(void **user)
{
    (void)user;
    bench b;
    bench_create(&b, 6, 8, true);
    scree_plates(&b.state)[SCREE_WALL_LEFT].active = scree_plates(&b.state)[SCREE_WALL_RIGHT].active = 1;
    assert_int_equal(scree_boundary_refresh(&b.model, &b.state, NULL), SCREE_OK);
    for (size_t k = 0; k < scree_loop_of(&b.state)->count; k++) assert_int_equal(scree_loop_of(&b.state)->loaded[k], 0);
    scree_pressure_forces(&b.model, &b.state);
    for (size_t i = 0; i < b.state.count; i++) assert_true(b.state.sum[i].fx == 0 && b.state.sum[i].fy == 0);
    assert_true(scree_pressure_bound(&b.model, &b.state) == 0);
    scree_state_destroy(&b.state);
}

static void few_discs_between_plates(void **user)
{
    (void)user;
    // Two discs below, one above: each plate has its corners, one plate only a single one.
    bench b;
    bench_create(&b, 3, 1, true);
    scree_state *state = &b.state;
    const double place[3][2] = {{0, 1}, {2, 1}, {1, 1 + sqrt(3.0)}};
    for (size_t i = 0; i < 3; i++) {
        state->row[i].radius = RADIUS;
        state->row[i].x = RADIUS * place[i][0];
        state->row[i].y = RADIUS * place[i][1];
    }
    scree_plates(state)[SCREE_WALL_BOTTOM].position = 0;
    scree_plates(state)[SCREE_WALL_TOP].position = -RADIUS * (2 + sqrt(3.0));
    assert_int_equal(scree_boundary_refresh(&b.model, state, NULL), SCREE_OK);
    scree_pressure_forces(&b.model, state);
    assert_int_equal(scree_loop_of(state)->loaded[0], 0);
    assert_int_equal(scree_loop_of(state)->loaded[1] + scree_loop_of(state)->loaded[2], 2);
    int64_t total = state->sum[0].fx + state->sum[1].fx + state->sum[2].fx;
    assert_int_equal(total, 0);
    // The left disc has half its edge and the gap below it; the gaps beside the upper disc cancel.
    double expected = PRESSURE * THICKNESS * RADIUS * (sqrt(3.0) / 2 + 1);
    assert_true(fabs((double)state->sum[0].fx * QUANTUM - expected) < 1e-12 * expected);
    assert_true(llabs(state->sum[2].fx) <= 2);
    // The outline is the triangle between the plates: the trapezium below, and nothing beside the upper disc.
    double area = RADIUS * RADIUS * (sqrt(3.0) + 2);
    assert_true(fabs(scree_sample_area(state) - area) < 1e-13 * area);
    scree_state_destroy(state);
}

/// The same bodies in rows of another order.
static void rows_and_threads_do_not_show(void **user)
{
    (void)user;
    bench a, b;
    bench_create(&a, 9, 17, true);
    bench_create(&b, 9, 17, true);
    uint32_t order[9 * 17];
    for (uint32_t k = 0; k < 9 * 17; k++) order[k] = 40 * k % (9 * 17); // 40 and 153 have no common factor
    assert_int_equal(scree_state_permute(&b.state, order, NULL), SCREE_OK);
    assert_int_equal(scree_boundary_refresh(&a.model, &a.state, NULL), SCREE_OK);
    assert_int_equal(scree_boundary_refresh(&b.model, &b.state, NULL), SCREE_OK);
    scree_pressure_forces(&a.model, &a.state);
    scree_pressure_forces(&b.model, &b.state);
    assert_true(state_bits(&a.state) == state_bits(&b.state));
    scree_state_destroy(&a.state);
    scree_state_destroy(&b.state);
}

/// Free bodies under pressure alone, without contacts: the ledger must equal the change of the kinetic energy.
static void work_is_the_kinetic_energy(void **user)
{
    (void)user;
    for (int scheme = SCREE_SLOT_position_verlet; scheme <= SCREE_SLOT_velocity_verlet; scheme++) {
        bench b;
        bench_create(&b, 5, 7, true);
        scree_state *state = &b.state;
        scree_work work = {.threads = 1};
        b.model.scheme = scheme;
        b.model.upkeep.every = 7; // the loop changes meanwhile
        const scree_integrator *integrator = scree_integrator_get(b.model.scheme);
        scree_contact_table empty = {0};
        scree_energy energy;
        state->step_size = 2e-5;
        assert_int_equal(scree_boundary_refresh(&b.model, state, NULL), SCREE_OK);
        scree_pressure_forces(&b.model, state);
        state->ledger = (scree_ledger){0};
        scree_energy_measure(&b.model, state, &empty, &energy);
        state->ledger.initial = energy.kinetic + energy.kinetic_rotation;
        for (int step = 0; step < 100; step++) {
            scree_pressure_set(state, PRESSURE * (1 + 0.01 * step));
            integrator->first(&b.model, state, &work);
            scree_pressure_work(state);
            state->step++;
            assert_int_equal(scree_boundary_refresh(&b.model, state, NULL), SCREE_OK);
            memset(state->sum, 0, state->count * sizeof *state->sum);
            scree_pressure_forces(&b.model, state);
            if (integrator->second) integrator->second(&b.model, state, &work);
        }
        scree_energy_measure(&b.model, state, &empty, &energy);
        assert_true(energy.kinetic > 0);
        // An identity: only round-off of some 1e4 additions is left.
        assert_true(fabs(energy.residual) < 1e-12 * state->ledger.turnover);
        assert_true(energy.relative < 1e-12);
        scree_state_destroy(state);
    }
}

static void refresh_is_due_and_closes_the_strain(void **user)
{
    (void)user;
    bench b;
    bench_create(&b, 9, 17, true);
    scree_state *state = &b.state;
    assert_int_equal(scree_boundary_refresh(&b.model, state, NULL), SCREE_OK);
    double total[9], area = scree_loop_area(state);
    uint64_t updated = scree_loop_of(state)->updated;
    for (int k = 0; k < 40; k++) {
        // Compression by 1 % in y, extension by 0.5 % in x, and a growing disturbance that changes the loop.
        for (size_t i = 0; i < state->count; i++) {
            state->row[i].x *= 1.005;
            state->row[i].y *= 0.99;
        }
        state->step += 249;
        assert_int_equal(scree_boundary_refresh(&b.model, state, NULL), SCREE_OK);
        assert_int_equal(scree_loop_of(state)->updated, updated);
        state->step++;
        assert_int_equal(scree_boundary_refresh(&b.model, state, NULL), SCREE_OK);
        assert_int_equal(scree_loop_of(state)->updated, state->step);
        updated = state->step;
    }
    scree_strain_measure(state, total);
    // Each increment is the logarithm up to e^3 / 12.
    assert_true(fabs(total[0] - 40 * log(1.005)) < 40 * 1.3e-7 / 12);
    assert_true(fabs(total[4] - 40 * log(0.99)) < 40 * 1.1e-6 / 12);
    assert_true(fabs(total[1]) < 1e-12 && fabs(total[3]) < 1e-12);
    assert_true(area > scree_loop_area(state));
    scree_state_destroy(state);
}

static void failures_leave_the_state(void **user)
{
    (void)user;
    bench b;
    bench_create(&b, 6, 8, true);
    scree_error error;
    bool failed = true;
    uint64_t before = state_bits(&b.state);
    for (uint64_t n = 1; failed; n++) {
        scree_allocation_fail_after(n);
        scree_status status = scree_boundary_refresh(&b.model, &b.state, &error);
        scree_allocation_fail_after(0);
        failed = status != SCREE_OK;
        if (failed) assert_int_equal(status, SCREE_ERROR_IO);
        if (failed) assert_true(state_bits(&b.state) == before);
        assert_true(n < 100);
    }
    // Later: bodies on a line cannot be triangulated, the old loop stays.
    before = state_bits(&b.state);
    for (size_t i = 0; i < b.state.count; i++) b.state.row[i].y = b.state.row[i].x;
    uint64_t moved = state_bits(&b.state);
    assert_true(moved != before);
    b.state.step = 1000;
    moved = state_bits(&b.state);
    assert_int_equal(scree_boundary_refresh(&b.model, &b.state, &error), SCREE_ERROR_GUARD);
    assert_true(state_bits(&b.state) == moved);
    scree_state_destroy(&b.state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_closed_loop_has_no_net_force),
        cmocka_unit_test(plates_take_the_ends),
        cmocka_unit_test(plates_all_round_leave_nothing_to_press),
        cmocka_unit_test(few_discs_between_plates),
        cmocka_unit_test(rows_and_threads_do_not_show),
        cmocka_unit_test(work_is_the_kinetic_energy),
        cmocka_unit_test(refresh_is_due_and_closes_the_strain),
        cmocka_unit_test(failures_leave_the_state),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
