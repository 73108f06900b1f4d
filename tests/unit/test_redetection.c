/// What finding the boundary again does: facets near a limit, and the change of what is enclosed.
#include "boundary_fixture.h"
#include "measure/delaunay_boundary.h"

#include "measure/facets.h"
#include "measure/hull.h"
#include "search/delaunay.h"
#include "search/tetrahedra.h"

#define LIMIT 0.3
#define SHARE 0.2

enum { SIDE = 5, MOST = SIDE * SIDE * SIDE };

/// A cubic (square) lattice of bodies of diameter 1, disturbed a little, cut through the middle of x and drawn apart.
typedef struct block {
    int dimension;
    size_t count;
    double points[3 * MOST], radius[MOST];
} block;

static block parted_block(int dimension, double gap)
{
    block b = {.dimension = dimension, .count = dimension == 3 ? MOST : SIDE * SIDE};
    for (size_t i = 0; i < b.count; i++) {
        size_t place[3] = {i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE};
        b.radius[i] = 0.5;
        for (int k = 0; k < dimension; k++)
            b.points[(size_t)dimension * i + (size_t)k] = (double)place[k] + 0.004 * uniform(3 * i + (size_t)k);
        if (place[0] > 2) b.points[(size_t)dimension * i] += gap;
    }
    return b;
}

/// The facets found by a rule, sorted.
static size_t find_facets(const block *b, const scree_peel_rule *rule, uint32_t *facet)
{
    if (b->dimension == 2) {
        uint32_t *loop;
        size_t count;
        assert_int_equal(scree_outer_loop(b->points, b->radius, b->count, 1, rule, &loop, &count, NULL), SCREE_OK);
        for (size_t k = 0; k < count; k++) {
            facet[2 * k] = loop[k];
            facet[2 * k + 1] = loop[(k + 1) % count];
        }
        scree_release(&loop);
        scree_peel_rule_sort(facet, count, 2);
        return count;
    }
    scree_triangle_surface surface;
    assert_int_equal(scree_outer_surface(b->points, b->radius, b->count, 1, rule, &surface, NULL), SCREE_OK);
    size_t count = surface.count;
    memcpy(facet, surface.triangle, count * sizeof *surface.triangle);
    scree_triangle_surface_destroy(&surface);
    scree_peel_rule_sort(facet, count, 3);
    return count;
}

static bool has_body(const uint32_t *facet, size_t corners, uint32_t id)
{
    for (size_t k = 0; k < corners; k++)
        if (facet[k] == id) return true;
    return false;
}

static void check_memory(int dimension)
{
    static uint32_t narrow[6 * MOST], wide[6 * MOST], past[6 * MOST], found[6 * MOST];
    // Free gap of the parted edges; in 3D of the parted faces, right triangles with legs 1 and 1 + gap: a passage of
    // sqrt(3)/2 sqrt(1 + (1 + gap)^2) - 1 = 0.525, 0.598 (boundary_surface.c).
    const double gap[2] = {dimension == 3 ? 0.45 : 0.27, dimension == 3 ? 0.55 : 0.33};
    const scree_peel_rule fresh = {.gap_limit = dimension == 3 ? 0.56 : LIMIT};
    block b[2] = {parted_block(dimension, gap[0]), parted_block(dimension, gap[1])};
    size_t small = find_facets(&b[0], &fresh, narrow), large = find_facets(&b[1], &fresh, wide);
    // Without a past the boundary goes into the gap and out again.
    assert_true(large > small);
    // With one it stays as it began, on either side of the limit.
    for (int begin = 0; begin < 2; begin++) {
        size_t count = begin ? large : small, d = (size_t)dimension;
        const uint32_t *first = begin ? wide : narrow;
        memcpy(past, first, count * d * sizeof *past);
        for (int turn = 0; turn < 4; turn++) {
            scree_peel_rule rule = fresh;
            rule.hysteresis = SHARE;
            rule.facet = past;
            rule.facet_count = count;
            assert_int_equal(find_facets(&b[(begin + turn) % 2], &rule, found), count);
            // The diagonals of a cell that is drawn apart may turn; the bodies stay.
            size_t held = 0, same = 0;
            for (uint32_t id = 0; id < b[0].count; id++) {
                bool now = has_body(found, count * d, id);
                held += now;
                same += now == has_body(first, count * d, id);
            }
            assert_true(held > 0);
            assert_int_equal(same, b[0].count);
        }
    }
}

static void a_facet_near_its_limit_does_not_come_and_go(void **user)
{
    (void)user;
    check_memory(2);
    check_memory(3);
}

static void a_facet_well_beyond_its_limit_goes(void **user)
{
    (void)user;
    static uint32_t past[6 * MOST], found[6 * MOST];
    block closed = parted_block(2, 0), open = parted_block(2, 1.3 * LIMIT);
    scree_peel_rule rule = {.gap_limit = LIMIT, .hysteresis = SHARE};
    rule.facet_count = find_facets(&closed, &rule, past);
    rule.facet = past;
    size_t count = find_facets(&open, &rule, found);
    assert_true(count > rule.facet_count);
    // And comes back well below it.
    memcpy(past, found, 2 * count * sizeof *past);
    rule.facet_count = count;
    assert_true(find_facets(&closed, &rule, found) < count);
}

static double trace_of(const scree_state *state)
{
    double gradient[9];
    scree_strain_measure(state, gradient);
    return gradient[0] + gradient[4] + gradient[8];
}

/// Bodies wander at random while the sample grows; the boundary is found again in every step. The increments of the
/// strain are of order e = 0.006 a step, so the sum of their third orders over N steps is below N e^3 = 5e-6.
static void check_ledger(int dimension)
{
    enum { STEPS = 25 };
    const double move = 0.04;
    bench b;
    bench_begin(&b, dimension, dimension == 3 ? 216 : 144, 1e-5);
    b.model.upkeep.every = 1;
    b.model.upkeep.hysteresis = 0.2;
    b.model.upkeep.gap_limit = 0.3;
    bench_fill(&b, dimension == 3 ? 6 : 12, false);
    scree_state *state = &b.state;
    assert_int_equal(scree_boundary_refresh(&b.model, state, NULL), SCREE_OK);
    assert_true(scree_strain_of(state)->redetected == 0);
    const double begin = scree_enclosed_logarithm(state), before = trace_of(state);
    for (int step = 0; step < STEPS; step++) {
        for (size_t i = 0; i < state->count; i++) {
            double *x[3] = {&state->row[i].x, &state->row[i].y, &state->row[i].z};
            for (int k = 0; k < dimension; k++) {
                double random = 2 * uniform((uint64_t)(1000 * step + 500) * 1000 + 3 * i + (uint64_t)k) - 1;
                *x[k] += 0.002 * *x[k] + move * 2 * RADIUS * random;
            }
        }
        state->step++;
        assert_int_equal(scree_boundary_refresh(&b.model, state, NULL), SCREE_OK);
    }
    const double change = scree_enclosed_logarithm(state) - begin, sum = trace_of(state) - before;
    assert_true(fabs(scree_strain_of(state)->redetected) > 0.01);
    assert_true(fabs(sum + scree_strain_of(state)->redetected - change) < 1e-5);
    scree_state_destroy(state);
}

static void increments_and_redetections_make_the_enclosed_volume(void **user)
{
    (void)user;
    check_ledger(2);
    check_ledger(3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_facet_near_its_limit_does_not_come_and_go),
        cmocka_unit_test(a_facet_well_beyond_its_limit_goes),
        cmocka_unit_test(increments_and_redetections_make_the_enclosed_volume),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
