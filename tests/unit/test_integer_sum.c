/// Sums in integers: free of the order of their terms and of how they are cut into parts, as exact as they say, and
/// never wrong in silence. Then everything that steers a run: the same bits for any order of rows, contacts and facets.
#include "boundary/pressure.h"
#include "boundary_passes.h"
#include "testing.h"

#include "base/integer_sum.h"
#include "base/random.h"
#include "boundary/boundary.h"
#include "boundary/hull.h"
#include "boundary/imposed_gradient.h"
#include "boundary/periodic.h"
#include "boundary/plates.h"
#include "measure/facets.h"
#include "measure/hull.h"
#include "measure/outline.h"
#include "measure/rotation.h"
#include "restart_cases.h"
#include "run_fixture.h"

#include <float.h>

enum { TERMS = 1000 };

/// Terms of both signs over many magnitudes.
static void draw(double term[TERMS], double scale)
{
    for (uint64_t k = 0; k < TERMS; k++) {
        double u = scree_random_uniform(3, SCREE_RANDOM_TEST, 2 * k);
        double size = ldexp(scale, (int)(30 * scree_random_uniform(3, SCREE_RANDOM_TEST, 2 * k + 1)) - 30);
        term[k] = (2 * u - 1) * size;
    }
}

/// Place k of the terms in one of several orders.
static size_t place(int order, size_t k)
{
    return order == 0 ? k : order == 1 ? TERMS - 1 - k : 387 * k % TERMS; // 387 and 1000 have no common factor
}

static double sum_in_order(const double term[TERMS], int order)
{
    scree_integer_sum sum = {0};
    while (scree_integer_sum_next(&sum, 1))
        for (size_t k = 0; k < TERMS; k++) scree_integer_sum_add(&sum, term[place(order, k)]);
    return scree_integer_sum_total(&sum);
}

/// The same by `parts` that know nothing of each other, joined from the last to the first.
static double sum_in_parts(const double term[TERMS], size_t parts)
{
    scree_integer_sum sum = {0};
    while (scree_integer_sum_next(&sum, 1)) {
        scree_integer_sum part[TERMS];
        for (size_t p = 0; p < parts; p++) {
            part[p] = sum;
            for (size_t k = p; k < TERMS; k += parts) scree_integer_sum_add(&part[p], term[k]);
        }
        for (size_t p = parts; p-- > 0;) scree_integer_sum_join(&sum, &part[p]);
    }
    return scree_integer_sum_total(&sum);
}

static void order_and_parts_do_not_show(void **unused)
{
    (void)unused;
    static const double scales[] = {1, 1e-200, 3e250};
    for (size_t s = 0; s < sizeof scales / sizeof *scales; s++) {
        double term[TERMS], plain[2] = {0};
        draw(term, scales[s]);
        double sum = sum_in_order(term, 0);
        for (int order = 1; order < 3; order++) assert_true(sum_in_order(term, order) == sum);
        assert_true(scree_integer_sum_of(term, TERMS) == sum);
        for (size_t parts = 1; parts <= TERMS; parts = 3 * parts + 1) assert_true(sum_in_parts(term, parts) == sum);
        // The terms are such that a sum of doubles shows their order.
        for (size_t k = 0; k < TERMS; k++) {
            plain[0] += term[k];
            plain[1] += term[place(2, k)];
        }
        assert_true(plain[0] != plain[1]);
        assert_true(fabs(plain[0] - sum) < TERMS * DBL_EPSILON * scales[s]);
    }
}

/// A large term and its opposite leave the small ones, each to half a quantum.
static void cancelling_terms_leave_the_rest(void **unused)
{
    (void)unused;
    double term[TERMS];
    long double exact = 0;
    draw(term, 1);
    for (size_t k = 0; k < TERMS; k++) term[k] *= 1e-6;
    term[17] = 1;
    term[700] = -1;
    for (size_t k = 0; k < TERMS; k++) exact += k == 17 || k == 700 ? 0 : term[k];
    assert_true(fabsl(sum_in_order(term, 0) - exact) <= TERMS * 0x1p-62);
}

static void few_terms_are_exact(void **unused)
{
    (void)unused;
    scree_integer_sum none = {0}, one = {0}, zero = {0};
    while (scree_integer_sum_next(&none, 1)) continue;
    assert_true(scree_integer_sum_total(&none) == 0);
    while (scree_integer_sum_next(&zero, 1)) scree_integer_sum_add(&zero, 0);
    assert_true(scree_integer_sum_total(&zero) == 0);
    static const double values[] = {0.1, -DBL_MAX, 1e-300, 0x1p-1022, 3};
    for (size_t k = 0; k < sizeof values / sizeof *values; k++) {
        one = (scree_integer_sum){0};
        while (scree_integer_sum_next(&one, 1)) scree_integer_sum_add(&one, values[k]);
        // Half a quantum: 2^-1021 is the least.
        assert_true(fabs(scree_integer_sum_total(&one) - values[k]) <= (values[k] < 1e-299 ? 0x1p-1021 : 0));
    }
}

/// What cannot be summed is not a number, never a wrong one.
static void no_term_overflows_in_silence(void **unused)
{
    (void)unused;
    static const double bad[] = {NAN, INFINITY, -INFINITY};
    double term[TERMS];
    for (size_t k = 0; k < 3; k++) {
        draw(term, 1);
        term[500] = bad[k];
        assert_true(isnan(sum_in_order(term, 0)));
        assert_true(isnan(sum_in_parts(term, 7)));
        assert_true(isnan(scree_integer_sum_of(term, TERMS)));
    }
    // A loop whose second pass finds a larger term than its first.
    scree_integer_sum sum = {0};
    for (double value = 1; scree_integer_sum_next(&sum, 1); value = 5) scree_integer_sum_add(&sum, value);
    assert_true(isnan(scree_integer_sum_total(&sum)));
}

// ---- what steers a run -------------------------------------------------------------------------------------------

enum { MOST = 256 };
typedef struct numbers {
    double value[MOST];
    size_t count;
} numbers;

static void keep(numbers *n, const double *value, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        assert_true(n->count < MOST);
        // One pattern of bits for every NaN.
        n->value[n->count++] = isnan(value[k]) ? -12345 : value[k];
    }
}

static void keep_boundary(numbers *n, const scree_model *model, scree_state *state)
{
    scree_vector area[512];
    double rate[10];
    size_t count = scree_boundary_count(state);
    assert_true(count <= 512);
    if (count == 0) return;
    scree_boundary_areas(model, state, area);
    rate[9] = scree_imposed_measure(state, area, rate);
    keep(n, rate, 10);
    for (size_t k = 0; k < count; k += 1 + count / 8) keep(n, area[k], 3);
    double others[] = {scree_sample_volume(model, state), scree_enclosed_logarithm(state),
                       scree_plate_area(model, state, SCREE_WALL_TOP),
                       state->dimension == 3 ? scree_hull_power(state) : 0};
    keep(n, others, sizeof others / sizeof *others);
}

static void keep_servos(numbers *n, const scree_model *model, scree_state *state)
{
    if (scree_cell(state)->directions) {
        const scree_periodic_cell *cell = scree_cell(state);
        scree_periodic_fit(model, state, 1e5);
        keep(n, (double[]){cell->inertia, cell->damping, scree_periodic_wave_time(model, state, 1e5)}, 3);
        return;
    }
    for (int w = 0; w < 2 * state->dimension; w++) {
        scree_servo servo = scree_servo_for(model, state, w, 1e5);
        keep(n, (double[]){servo.impedance, servo.mass}, 2);
    }
    keep(n, (double[]){scree_sample_wave_time(model, state, 1e5)}, 1);
}

/// All that ends stages, moves plates and cells, imposes rates, stops runs, or is added to the ledger.
static void measure_all(const scree_simulation *s, const scree_state *from, const scree_contact_table *table,
                        numbers *n)
{
    const scree_model *model = &s->stage_model;
    scree_state state = *from;
    scree_energy energy;
    double gradient[9], solid;
    *n = (numbers){.count = 0};
    scree_energy_measure(model, &state, table, &energy);
    keep(n, (const double *)&energy, sizeof energy / sizeof(double));
    keep(n,
         (double[]){scree_unbalanced_ratio(model, &state, table), scree_mean_unbalanced_ratio(model, &state, table),
                    scree_rotation_mean_amount(&state, state.row_of_id[3])},
         3);
    state.ledger = (scree_ledger){0};
    scree_energy_change_step(model, &state, 1e-5, 2e-5);
    scree_pressure_work(&state);
    boundary_follow(s->boundary, model, &state);
    keep(n, (const double *)&state.ledger, sizeof state.ledger / sizeof(double));
    scree_strain_measure(&state, gradient);
    keep(n, gradient, 9);
    assert_int_equal(scree_solid_fraction(&state, &solid, NULL), SCREE_OK);
    keep(n, &solid, 1);
    keep_servos(n, model, &state);
    keep_boundary(n, model, &state);
}

/// Rows in another order, contacts and triangles of the hull from the last to the first.
static void shuffle(scree_state *state, scree_contact_table *table)
{
    uint32_t order[256], old_id[256];
    size_t count = state->count, step = 1;
    assert_true(count <= 256);
    // A step that has no common factor with the number of rows.
    while (count % step == 0 || step == 1) step = step == 1 ? 7 : step == 7 ? 11 : 13;
    for (uint32_t k = 0; k < count; k++) {
        order[k] = (uint32_t)((3 + step * k) % count);
        old_id[k] = state->id[k];
    }
    assert_int_equal(scree_state_permute(state, order, NULL), SCREE_OK);
    for (size_t c = 0; c < table->count; c++) {
        table->contact[c].first = state->row_of_id[old_id[table->contact[c].first]];
        if (!table->contact[c].wall) table->contact[c].second = state->row_of_id[old_id[table->contact[c].second]];
    }
    for (size_t c = 0; 2 * c + 1 < table->count; c++) {
        scree_contact held = table->contact[c];
        table->contact[c] = table->contact[table->count - 1 - c];
        table->contact[table->count - 1 - c] = held;
    }
    scree_hull *hull = scree_hull_of(state);
    for (size_t t = 0; 2 * t + 1 < hull->triangle_count; t++) {
        size_t other = hull->triangle_count - 1 - t;
        uint32_t held[3];
        uint8_t load = hull->loaded[t];
        memcpy(held, hull->triangle[t], sizeof held);
        memcpy(hull->triangle[t], hull->triangle[other], sizeof held);
        memcpy(hull->triangle[other], held, sizeof held);
        hull->loaded[t] = hull->loaded[other];
        hull->loaded[other] = load;
    }
}

static void nothing_that_steers_depends_on_order(void **unused)
{
    (void)unused;
    static const uint64_t steps[] = {40, 40, 40, 300};
    for (int k = 0; k < RESTART_CASES; k++) {
        scree_case *c = case_read(restart_cases[k], NULL, 0);
        scree_simulation s;
        scree_error error;
        simulation_open(c, 1, &s);
        simulation_load(&s);
        for (uint64_t step = 0; step < steps[k]; step++) simulation_step(&s);
        check(scree_contact_table_build(&s.stage_model, &s.state, &s.work, &s.table, &error), &error);
        numbers before, after;
        measure_all(&s, &s.state, &s.table, &before);
        shuffle(&s.state, &s.table);
        measure_all(&s, &s.state, &s.table, &after);
        assert_int_equal(before.count, after.count);
        for (size_t i = 0; i < before.count; i++)
            if (before.value[i] != after.value[i])
                fail_msg("case %d, number %zu: %.17g became %.17g", k, i, before.value[i], after.value[i]);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(order_and_parts_do_not_show),
        cmocka_unit_test(cancelling_terms_leave_the_rest),
        cmocka_unit_test(few_terms_are_exact),
        cmocka_unit_test(no_term_overflows_in_silence),
        cmocka_unit_test(nothing_that_steers_depends_on_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
