/// Membrane around a plane sample: placement, pressure, chain, ends, what it is left out of.
#include "boundary/membrane.h"
#include "boundary_fixture.h"
#include "state/plates.h"

#include "measure/delaunay_boundary.h"
#include "measure/outline.h"
#include "search/neighbours.h"
#include "state/pressure.h"
#include "state_bits.h"

#define STEP 1e-5

enum { COLUMNS = 8, ROWS = 14 };

/// A block of discs in its membrane.
static void bench_create(bench *b)
{
    bench_begin(b, 2, COLUMNS * ROWS, STEP);
    bench_predict_membrane(b, 1.25 * RADIUS);
    bench_fill(b, COLUMNS, true);
    assert_int_equal(scree_membrane_place(&b->model, &b->state, NULL), SCREE_OK);
}

static void it_touches_and_does_not_press(void **unused)
{
    (void)unused;
    bench b;
    bench_create(&b);
    scree_state *state = &b.state;
    size_t count = scree_membrane_of(state)->count, side = scree_membrane_of(state)->right;
    assert_int_equal(scree_grain_count(state), COLUMNS * ROWS);
    assert_int_equal(state->count, scree_grain_count(state) + count);
    assert_int_equal(count, 2 * side);
    size_t touching = 0;
    for (size_t k = 0; k < count; k++) {
        const scree_row *m = member(&b, k);
        double gap = INFINITY;
        for (size_t i = 0; i < state->count; i++) {
            const scree_row *g = &state->row[i];
            if (!scree_body_is_grain(state, i)) continue;
            gap = fmin(gap, hypot(m->x - g->x, m->y - g->y) - m->radius - g->radius);
            // Every grain lies inside of the discs at its height.
            if (fabs(g->y - m->y) < g->radius) assert_true(k < side ? g->x < m->x : g->x > m->x);
        }
        assert_true(gap > -1e-15); // round-off of 0.02 m
        touching += gap < 1e-15;
        assert_true(m->material == 1 && m->mass > 0 && m->radius == 1.25 * RADIUS);
        bool last = k + 1 == side || k + 1 == count;
        double rest = last ? 0 : hypot(member(&b, k + 1)->x - m->x, member(&b, k + 1)->y - m->y);
        assert_true(fabs(scree_membrane_of(state)->rest[k][0] - rest) < 1e-15);
    }
    assert_true(touching > count * 3 / 4);
    double bottom = scree_plates(state)[SCREE_WALL_BOTTOM].position,
           top = -scree_plates(state)[SCREE_WALL_TOP].position;
    for (size_t k = 0; k < count; k += side) {
        bool right = k == 0;
        assert_true(fabs(member(&b, k)->y - (right ? bottom + 1.25 * RADIUS : top - 1.25 * RADIUS)) < 1e-15);
        assert_true(fabs(member(&b, k + side - 1)->y - (right ? top - 1.25 * RADIUS : bottom + 1.25 * RADIUS)) < 1e-15);
    }
    assert_true(scree_membrane_energy(&b.model, state) < 1e-20);
    scree_state_destroy(state);
}

static void both_sides_press_alike(void **unused)
{
    (void)unused;
    bench b;
    bench_create(&b);
    scree_state *state = &b.state;
    for (size_t k = 0; k < scree_membrane_of(state)->count; k++) member(&b, k)->x += 1e-4 * uniform(1000 + k);
    membrane_forces(&b);
    double height = -(scree_plates(state)[SCREE_WALL_BOTTOM].position + scree_plates(state)[SCREE_WALL_TOP].position);
    int64_t side[2] = {0};
    double pressure = 0, chain_x = 0;
    for (size_t k = 0; k < scree_membrane_of(state)->count; k++) {
        side[k >= scree_membrane_of(state)->right] += state->sum[scree_membrane_row(state, k)].fx;
        pressure += k < scree_membrane_of(state)->right ? scree_membrane_of(state)->press[k][0] : 0;
        chain_x += scree_membrane_of(state)->force[k][0];
    }
    assert_true(side[0] < 0 && side[0] + side[1] == 0);
    // Rounding of some ten forces to a quantum, and of the products.
    double expected = PRESSURE * height * THICKNESS;
    assert_true(fabs((double)side[0] * QUANTUM + expected) < 1e-12 * expected);
    assert_true(fabs(pressure + expected) < 1e-12 * expected);
    assert_true(fabs(chain_x) < 1e-12 * expected);
    scree_delaunay_boundary_of(state)->taken_over = 0.5;
    assert_true(fabs(scree_direct_pressure(state) - 0.5 * PRESSURE) < 1e-9);
    scree_state_destroy(state);
}

/// Free discs of a chain that is pulled: the work is what the energy loses, and momentum along the plates is constant.
static void the_chain_stores_what_it_takes(void **unused)
{
    (void)unused;
    bench b;
    bench_create(&b);
    scree_state *state = &b.state;
    const scree_boundary *membrane = scree_module_membrane.boundary;
    scree_pressure_set(state, 0);
    for (size_t k = 0; k < scree_membrane_of(state)->count; k++) {
        member(&b, k)->x += 2e-4 * uniform(1000 + k);
        member(&b, k)->vx = 0.02 * uniform(2000 + k);
    }
    double begin = scree_membrane_energy(&b.model, state), momentum = 0, after = 0, scale = 0, change = 0;
    for (size_t k = 0; k < scree_membrane_of(state)->count; k++) momentum += member(&b, k)->mass * member(&b, k)->vx;
    membrane_forces(&b);
    state->ledger = (scree_ledger){0};
    for (int step = 0; step < 400; step++) {
        for (size_t k = 0; k < scree_membrane_of(state)->count; k++) {
            scree_row *row = member(&b, k);
            const scree_sum_row *sum = &state->sum[scree_membrane_row(state, k)];
            row->vx += STEP * (double)sum->fx * QUANTUM / row->mass;
            row->vy += STEP * (double)sum->fy * QUANTUM / row->mass;
            row->x += STEP * row->vx;
            row->y += STEP * row->vy;
        }
        boundary_follow(membrane, &b.model, state);
        membrane_forces(&b);
        change = fmax(change, fabs(scree_membrane_energy(&b.model, state) - begin));
    }
    for (size_t k = 0; k < scree_membrane_of(state)->count; k++) {
        after += member(&b, k)->mass * member(&b, k)->vx;
        scale += fabs(member(&b, k)->mass * member(&b, k)->vx);
    }
    // Rounding of 400 kicks.
    assert_true(fabs(after - momentum) < 1e-12 * scale);
    // The trapezoidal rule along straight segments that turn and fall slack: second order in omega dt = 2e-3.
    double stored = scree_membrane_energy(&b.model, state) - begin;
    assert_true(change > 0.1 * begin && begin > 0);
    assert_true(fabs(stored + state->ledger.boundary) < 1e-4 * begin);
    // Slack: all on one point along the plates.
    for (size_t k = 0; k < scree_membrane_of(state)->count; k++) {
        member(&b, k)->x = k < scree_membrane_of(state)->right ? 1 : 0;
        member(&b, k)->y *= 0.5;
    }
    assert_true(scree_membrane_energy(&b.model, state) < 1e-20);
    scree_state_destroy(state);
}

static void ends_move_with_the_plates(void **unused)
{
    (void)unused;
    bench b;
    bench_create(&b);
    scree_state *state = &b.state;
    scree_plates(state)[SCREE_WALL_BOTTOM].velocity = 3e-3;
    scree_plates(state)[SCREE_WALL_TOP].velocity = 1e-3;
    membrane_forces(&b);
    size_t side = scree_membrane_of(state)->right, end[4] = {0, side - 1, side, 2 * side - 1};
    for (int e = 0; e < 4; e++) {
        const scree_row *row = member(&b, end[e]);
        const scree_sum_row *sum = &state->sum[scree_membrane_row(state, end[e])];
        double after = row->vy + STEP * (double)sum->fy * QUANTUM / row->mass;
        double wanted = e == 0 || e == 3 ? 3e-3 : -1e-3;
        assert_true(fabs(after - wanted) < 1e-15);
        // Free along the plate; the chain is not stretched but for round-off.
        assert_true(fabs(scree_membrane_of(state)->force[end[e]][0]) < 1e-12);
    }
    scree_state_destroy(state);
}

/// Discs of the membrane do not touch each other, and measures of the assembly leave them out.
static void it_is_no_part_of_the_assembly(void **unused)
{
    (void)unused;
    bench b;
    bench_create(&b);
    scree_state *state = &b.state;
    scree_error error;
    assert_int_equal(scree_work_create(&b.work, &b.model, 1, &error), SCREE_OK);
    // Pushed together and inwards: they overlap each other and the grains.
    for (size_t k = 0; k < scree_membrane_of(state)->count; k++) {
        member(&b, k)->x += k < scree_membrane_of(state)->right ? -2e-6 : 2e-6;
        member(&b, k)->y *= 0.9999;
    }
    assert_int_equal(scree_neighbours_refresh(&b.model, state, &b.work, &error), SCREE_OK);
    size_t mixed = 0;
    for (size_t k = 0; k < b.work.pairs.count; k++) {
        bool first = scree_body_is_grain(state, b.work.pairs.first[k]);
        bool second = scree_body_is_grain(state, b.work.pairs.second[k]);
        assert_true(first || second);
        mixed += first != second;
    }
    assert_true(mixed > 0);
    scree_contact_set_quanta(&b.model, state, 1);
    scree_contact_forces(&b.model, state, &b.work);
    scree_contact_table table = {0};
    assert_int_equal(scree_contact_table_build(&b.model, state, &b.work, &table, &error), SCREE_OK);
    scree_coordination coordination;
    assert_int_equal(scree_coordination_measure(&b.model, state, NULL, &table, &coordination, &error), SCREE_OK);
    double contacts = 0, slip, sliding, stress[9], other[9];
    size_t outer = 0, inner = 0;
    double inner_slip = 0;
    for (size_t c = 0; c < table.count; c++) {
        const scree_contact *contact = &table.contact[c];
        if (!scree_body_is_grain(state, contact->first)) continue; // an end and its plate
        assert_true(contact->membrane == (!contact->wall && !scree_body_is_grain(state, contact->second)));
        if (contact->membrane) assert_true(contact->tangential_force == 0 && contact->normal_force > 0);
        contacts += scree_contact_is_outer(contact) ? 1 : 2;
        outer += contact->membrane;
        if (scree_contact_is_outer(contact)) continue;
        inner++;
        inner_slip += fabs(contact->slip);
    }
    assert_true(outer > 5);
    assert_true(fabs(coordination.mean - contacts / (COLUMNS * ROWS)) < 1e-12);
    assert_true(coordination.rattler_fraction >= 0 && coordination.rattler_fraction <= 1);
    scree_slip_measure(state, &table, &slip, &sliding);
    assert_true(inner > 0 && fabs(slip - inner_slip / (double)inner) <= 1e-12 * slip);
    // The identity of stress.c, membrane included: contacts = boundary - (1/V) sum of resultants times places.
    assert_int_equal(scree_boundary_refresh(&b.model, state, &error), SCREE_OK);
    double centre[2], volume = scree_outline_area(state, centre) * THICKNESS;
    scree_stress_from_contacts(state, &table, volume, stress);
    scree_stress_from_boundary(&b.model, state, &table, other);
    for (size_t k = 0; k < state->count; k++) {
        if (!scree_body_is_grain(state, k)) continue;
        const double force[2] = {(double)state->sum[k].fx, (double)state->sum[k].fy};
        const double place[2] = {state->row[k].x - centre[0], state->row[k].y - centre[1]};
        for (int i = 0; i < 4; i++)
            other[3 * (i / 2) + i % 2] -= force[i / 2] * state->force_quantum * place[i % 2] / volume;
    }
    // Round-off of a few hundred contacts of 1e5 Pa and more, and half a quantum of 1e-11 of the largest force each.
    for (int i = 0; i < 9; i++) assert_true(fabs(stress[i] - other[i]) < 1e-9 * fabs(stress[0]));
    assert_true(stress[0] < 0);
    scree_contact_table_destroy(&table);
    scree_contact_scratch_destroy(&b.work);
    scree_work_destroy(&b.work);
    scree_state_destroy(state);
}

static void failures_leave_the_state(void **unused)
{
    (void)unused;
    bench b;
    bench_create(&b);
    scree_state state;
    assert_int_equal(scree_state_create(&state, 2, 4, NULL), SCREE_OK);
    scree_plates(&state)[SCREE_WALL_TOP] = (scree_wall){.position = -0.05, .normal = {0, -1}, .active = 1};
    scree_plates(&state)[SCREE_WALL_BOTTOM] = (scree_wall){.normal = {0, 1}, .active = 1};
    for (size_t k = 0; k < 4; k++) state.row[k] = (scree_row){.y = 0.01 * (double)(k + 1), .radius = 1e-3, .mass = 1};
    uint64_t before = state_bits(&state);
    bool failed = true;
    for (uint64_t n = 1; failed; n++) {
        scree_error error;
        scree_allocation_fail_after(n);
        failed = scree_membrane_place(&b.model, &state, &error) != SCREE_OK;
        scree_allocation_fail_after(0);
        if (failed) assert_true(state_bits(&state) == before && error.status == SCREE_ERROR_IO);
    }
    assert_true(scree_membrane_of(&state)->count > 20);
    scree_state_destroy(&state);
    // Plates too close.
    scree_plates(&b.state)[SCREE_WALL_TOP].position = -scree_plates(&b.state)[SCREE_WALL_BOTTOM].position - 3 * RADIUS;
    scree_error error;
    assert_int_equal(scree_membrane_place(&b.model, &b.state, &error), SCREE_ERROR_GUARD);
    scree_state_destroy(&b.state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_touches_and_does_not_press),  cmocka_unit_test(both_sides_press_alike),
        cmocka_unit_test(the_chain_stores_what_it_takes), cmocka_unit_test(ends_move_with_the_plates),
        cmocka_unit_test(it_is_no_part_of_the_assembly),  cmocka_unit_test(failures_leave_the_state),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
