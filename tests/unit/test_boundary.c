/// Boundaries as forces on facets, in 2D and 3D: area vectors, uniform stress, minimal conditions, affine motion.
#include "boundary_passes.h"
#include "measure/delaunay_boundary.h"
#include "measure/imposed_gradient.h"
#include "state/plates.h"
#include "testing.h"

#include "base/fixed.h"
#include "base/random.h"
#include "boundary/boundary.h"
#include "boundary/imposed_gradient.h"
#include "boundary/minimal.h"
#include "measure/facets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define THICKNESS 1.5e-3
#define QUANTUM   0x1p-36
#define FINE      0x1p-50
#define STEP      1e-4
#define SIZE      0.02

enum { SIDES = 40, RINGS = 5, RING = 8 };

typedef struct bench {
    scree_model model;
    scree_state state;
    scree_work work;
} bench;

static double uniform(uint64_t counter)
{
    return 2 * scree_random_uniform(11, SCREE_RANDOM_TEST, counter) - 1;
}

static void make_loop(scree_state *state)
{
    scree_loop *loop = scree_loop_of(state);
    assert_int_equal(scree_allocate(&loop->id, SIDES, sizeof *loop->id, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&loop->loaded, SIDES, 1, NULL), SCREE_OK);
    double **arrays[] = {&loop->x, &loop->y, &loop->fx, &loop->fy};
    for (int k = 0; k < 4; k++) assert_int_equal(scree_allocate(arrays[k], SIDES, sizeof(double), NULL), SCREE_OK);
    loop->count = loop->capacity = SIDES;
    for (uint32_t k = 0; k < SIDES; k++) {
        double angle = 2 * M_PI * k / SIDES, radius = SIZE * (1 + 0.2 * uniform(k));
        loop->id[k] = (7 * k + 3) % SIDES; // ids out of order
        loop->loaded[k] = 1;
        state->row[loop->id[k]].x = radius * cos(angle) + 0.3;
        state->row[loop->id[k]].y = 2 * radius * sin(angle) - 0.1;
    }
}

/// A lumpy ball: rings of nodes, two poles.
static void make_hull(scree_state *state)
{
    scree_hull *hull = scree_hull_of(state);
    size_t nodes = RINGS * RING + 2, triangles = 2 * RINGS * RING;
    assert_int_equal(scree_allocate(&hull->id, nodes, sizeof *hull->id, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&hull->position, nodes, sizeof *hull->position, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&hull->force, nodes, sizeof *hull->force, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&hull->triangle, triangles, sizeof *hull->triangle, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&hull->loaded, triangles, 1, NULL), SCREE_OK);
    hull->node_count = nodes;
    for (uint32_t k = 0; k < nodes; k++) {
        double polar = k == nodes - 1 ? M_PI : k == nodes - 2 ? 0 : M_PI * (1 + (double)(k / RING)) / (RINGS + 1);
        double around = 2 * M_PI * (k % RING) / RING, radius = SIZE * (1 + 0.2 * uniform(k));
        hull->id[k] = k;
        state->row[k].x = radius * sin(polar) * cos(around) + 0.2;
        state->row[k].y = radius * sin(polar) * sin(around);
        state->row[k].z = 1.5 * radius * cos(polar) - 0.4;
    }
    for (uint32_t r = 0; r <= RINGS; r++)
        for (uint32_t k = 0; k < RING; k++) {
            uint32_t next = (k + 1) % RING, top = (uint32_t)nodes - 2, bottom = top + 1;
            uint32_t a = (r - 1) * RING + k, b = (r - 1) * RING + next, c = r * RING + k, d = r * RING + next;
            const uint32_t two[2][3] = {{r == 0 ? top : a, c, r == RINGS ? bottom : d},
                                        {a, r == RINGS ? bottom : d, r == 0 ? top : b}};
            if (r < RINGS) memcpy(hull->triangle[hull->triangle_count++], two[0], sizeof two[0]);
            if (r == RINGS)
                memcpy(hull->triangle[hull->triangle_count++], (uint32_t[3]){a, bottom, b}, sizeof two[0]);
            else if (r > 0)
                memcpy(hull->triangle[hull->triangle_count++], two[1], sizeof two[1]);
        }
    assert_int_equal(hull->triangle_count, triangles);
}

static void bench_create(bench *b, int dimension)
{
    memset(b, 0, sizeof *b);
    b->model.dimension = dimension;
    b->model.thickness = dimension == 3 ? 1 : THICKNESS;
    size_t count = dimension == 3 ? RINGS * RING + 2 : SIDES;
    assert_int_equal(scree_state_create(&b->state, dimension, count, NULL), SCREE_OK);
    scree_state *state = &b->state;
    state->force_quantum = QUANTUM;
    state->step_size = b->work.next_kick = STEP;
    for (size_t k = 0; k < count; k++) {
        scree_row *row = &state->row[k];
        row->mass = 1 + 0.5 * uniform(100 + k);
        row->vx = uniform(200 + k);
        row->vy = uniform(300 + k);
        if (dimension == 3) row->vz = uniform(400 + k);
    }
    if (dimension == 3)
        make_hull(state);
    else
        make_loop(state);
}

/// v += dt F / m, as the kicks of a whole step do.
static void kick(scree_state *state)
{
    for (size_t k = 0; k < state->count; k++) {
        scree_row *row = &state->row[k];
        row->vx += STEP * (double)state->sum[k].fx * QUANTUM / row->mass;
        row->vy += STEP * (double)state->sum[k].fy * QUANTUM / row->mass;
        if (state->dimension == 3) row->vz += STEP * (double)state->sum[k].fz * QUANTUM / row->mass;
    }
}

static double kinetic(const scree_state *state)
{
    double energy = 0;
    scree_vector velocity, spin;
    for (size_t k = 0; k < state->count; k++) {
        scree_body_motion(state, k, velocity, spin);
        for (int i = 0; i < 3; i++) energy += 0.5 * state->row[k].mass * velocity[i] * velocity[i];
    }
    return energy;
}

/// Returns the volume.
static double measure_rate(bench *b, double rate[9])
{
    scree_vector area[SIDES + RINGS * RING];
    scree_boundary_areas(&b->model, &b->state, area);
    return scree_imposed_measure(&b->state, area, rate);
}

static void area_vectors_integrate_the_normal(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        bench b;
        bench_create(&b, dimension);
        scree_vector area[SIDES + RINGS * RING], place;
        scree_boundary_areas(&b.model, &b.state, area);
        double rate[9], volume = scree_imposed_measure(&b.state, area, rate);
        double sum[3] = {0}, moment[9] = {0}, largest = 0;
        for (size_t k = 0; k < scree_boundary_count(&b.state); k++) {
            scree_body_position(&b.state, scree_boundary_row(&b.state, k), place);
            largest = fmax(largest, scree_length(area[k]));
            for (int i = 0; i < 3; i++) sum[i] += area[k][i];
            for (int i = 0; i < 9; i++) moment[i] += place[i / 3] * area[k][i % 3];
        }
        // Round-off of some hundred terms.
        for (int i = 0; i < 3; i++) assert_true(fabs(sum[i]) < 1e-14 * largest);
        for (int i = 0; i < 9; i++) {
            bool unit = i % 4 == 0 && i / 4 < dimension;
            assert_true(fabs(moment[i] - (unit ? volume : 0)) < 1e-12 * volume);
        }
        assert_true(volume > (dimension == 3 ? 3 * SIZE * SIZE * SIZE : 4 * SIZE * SIZE * THICKNESS));
        scree_state_destroy(&b.state);
    }
}

static void the_power_of_a_stress_is_volume_stress_rate(void **unused)
{
    (void)unused;
    const double stress[9] = {-2e5, 3e4, -1e4, 5e4, -1e5, 2e4, 7e3, -4e4, 6e4};
    for (int dimension = 2; dimension <= 3; dimension++) {
        bench b;
        bench_create(&b, dimension);
        b.state.force_quantum = FINE;
        const scree_context context = {.model = &b.model, .state = &b.state};
        assert_int_equal(scree_imposed_refresh(&context, NULL), SCREE_OK);
        scree_imposed_apply_stress(&b.model, &b.state, stress);
        double rate[9], power = 0, expected = 0, scale = 0, volume;
        int64_t total[3] = {0};
        scree_vector velocity, spin;
        volume = measure_rate(&b, rate);
        for (size_t k = 0; k < b.state.count; k++) {
            const scree_sum_row *sum = &b.state.sum[k];
            const int64_t force[3] = {sum->fx, sum->fy, dimension == 3 ? sum->fz : 0};
            scree_body_motion(&b.state, k, velocity, spin);
            for (int i = 0; i < 3; i++) {
                total[i] += force[i];
                power += (double)force[i] * FINE * velocity[i];
                scale += fabs((double)force[i] * FINE * velocity[i]);
            }
        }
        for (int i = 0; i < 9; i++) expected += volume * stress[i] * rate[i];
        for (int i = 0; i < 3; i++) assert_int_equal(total[i], 0); // as integers
        // Round-off: a few hundred sums of doubles, and half a quantum (4e-16 N) a term of forces of 0.1 N and more.
        assert_true(fabs(power - expected) < 1e-13 * scale);
        assert_true(scale > 0);
        scree_state_destroy(&b.state);
    }
}

/// Minimal conditions with the given components, one step with and without other forces on the bodies.
static void minimal_conditions_meet_their_rates(void **unused)
{
    (void)unused;
    const scree_boundary *minimal = scree_module_minimal.boundary;
    const double target[9] = {0.5, -0.3, 0.1, 0.7, -1, 0, 0.2, 0, 0.4};
    static const int prescribed[4][9] = {
        {0, 0, 0, 0, SCREE_FULL, 0, 0, 0, 0},
        {0, SCREE_SYMMETRIC, 0, 0, 0, 0, 0, 0, 0},
        {SCREE_FULL, SCREE_SYMMETRIC, 0, 0, 0, 0, 0, 0, 0},
        {SCREE_FULL, SCREE_FULL, 0, SCREE_FULL, SCREE_FULL, 0, 0, 0, 0},
    };
    for (int k = 0; k < 8; k++) {
        bench b;
        bench_create(&b, 2 + k / 4);
        scree_state *state = &b.state;
        for (int i = 0; i < 9; i++) scree_imposed(state)->prescribed[i] = prescribed[k % 4][i];
        memcpy(scree_imposed(state)->target, target, sizeof target);
        scree_imposed(state)->viscosity = INFINITY;
        // Other forces, which the solution has to predict.
        for (size_t r = 0; r < state->count; r++) state->sum[r].fx = (int64_t)(1e15 * uniform(500 + r));
        assert_int_equal(boundary_pass(minimal, SCREE_PHASE_SEARCH, &b.model, state, &b.work, NULL), SCREE_OK);
        boundary_load(minimal, &b.model, state, &b.work);
        kick(state);
        double rate[9];
        measure_rate(&b, rate);
        for (int c = 0; c < 9; c++) {
            double actual = prescribed[k % 4][c] == SCREE_FULL ? rate[c] : 0.5 * (rate[c] + rate[3 * (c % 3) + c / 3]);
            // A rate of order one from velocities of order one over SIZE: round-off of the sums, and of the solution.
            if (prescribed[k % 4][c] != SCREE_FREE) assert_true(fabs(actual - target[c]) < 1e-11);
        }
        scree_state_destroy(state);
    }
}

/// The multiplier of a step is not known when its quanta are chosen: where it leaves the room of the integers, nothing
/// is applied, and the run stops.
static void a_multiplier_out_of_range_stops_the_run(void **unused)
{
    (void)unused;
    const scree_boundary *minimal = scree_module_minimal.boundary;
    for (int k = 0; k < 4; k++) {
        bench b;
        bench_create(&b, 2 + k / 2);
        scree_state *state = &b.state;
        scree_imposed(state)->prescribed[4] = SCREE_FULL;
        // A rate whose force is some 1e25 times the largest of the integers, or one that is not a number.
        scree_imposed(state)->target[4] = k % 2 ? NAN : 1e40;
        scree_imposed(state)->viscosity = INFINITY;
        assert_int_equal(boundary_pass(minimal, SCREE_PHASE_SEARCH, &b.model, state, &b.work, NULL), SCREE_OK);
        boundary_load(minimal, &b.model, state, &b.work);
        assert_int_equal(b.work.flags, SCREE_FLAG_FORCE_RANGE);
        for (size_t r = 0; r < state->count; r++) assert_true(state->sum[r].fx == 0 && state->sum[r].fy == 0);
        scree_imposed(state)->target[4] = 1;
        b.work.flags = 0;
        boundary_load(minimal, &b.model, state, &b.work);
        assert_int_equal(b.work.flags, 0);
        scree_state_destroy(state);
    }
}

/// A strain rate is imposed without any moment: a rotating body goes on rotating.
static void a_strain_rate_has_no_moment(void **unused)
{
    (void)unused;
    const scree_boundary *minimal = scree_module_minimal.boundary;
    for (int k = 0; k < 2; k++) {
        bench b;
        bench_create(&b, 2);
        scree_state *state = &b.state;
        scree_imposed(state)->prescribed[1] = SCREE_SYMMETRIC;
        if (k == 1) scree_imposed(state)->prescribed[1] = scree_imposed(state)->prescribed[3] = SCREE_FULL;
        scree_imposed(state)->target[1] = 0.5;
        scree_imposed(state)->viscosity = 1e6;
        assert_int_equal(boundary_pass(minimal, SCREE_PHASE_SEARCH, &b.model, state, &b.work, NULL), SCREE_OK);
        boundary_load(minimal, &b.model, state, &b.work);
        double moment = 0, scale = 0;
        for (size_t r = 0; r < state->count; r++) {
            double x = state->row[r].x, y = state->row[r].y;
            moment += x * (double)state->sum[r].fy - y * (double)state->sum[r].fx;
            scale += fabs(x * (double)state->sum[r].fy) + fabs(y * (double)state->sum[r].fx);
        }
        if (k == 0) assert_true(fabs(moment) < 1e-13 * scale);
        if (k == 1) assert_true(fabs(moment) > 1e-3 * scale);
        scree_state_destroy(state);
    }
}

/// With any viscosity an error decays without overshoot, and the accumulates hold: free bodies gain what the ledger
/// says.
static void penalty_is_stable_and_booked(void **unused)
{
    (void)unused;
    const scree_boundary *minimal = scree_module_minimal.boundary;
    for (int k = 0; k < 12; k++) {
        bench b;
        bench_create(&b, 2 + k / 6);
        scree_state *state = &b.state;
        int axial = state->dimension == 3 ? 8 : 4;
        scree_imposed(state)->prescribed[axial] = SCREE_FULL;
        scree_imposed(state)->target[axial] = -0.5;
        scree_imposed(state)->viscosity = pow(10, 3 * (k % 6));
        double before = INFINITY, begin = kinetic(state), rate[9];
        for (int step = 0; step < 50; step++) {
            memset(state->sum, 0, state->count * sizeof *state->sum);
            assert_int_equal(boundary_pass(minimal, SCREE_PHASE_SEARCH, &b.model, state, &b.work, NULL), SCREE_OK);
            boundary_load(minimal, &b.model, state, &b.work);
            kick(state);
            boundary_follow(minimal, &b.model, state);
            measure_rate(&b, rate);
            double error = fabs(rate[axial] + 0.5);
            assert_true(error <= before || error < 1e-11);
            before = error;
        }
        double gained = kinetic(state) - begin;
        // An identity of the leapfrog; round-off of 50 sums.
        assert_true(fabs(gained - state->ledger.boundary) < 1e-12 * (fabs(gained) + begin));
        assert_true(k % 6 == 0 || before < 1e-6 || k % 6 < 3);
        scree_state_destroy(state);
    }
    double target[9] = {[4] = -5e-3};
    assert_true(fabs(scree_minimal_viscosity(1e5, target) - 2e9) < 1); // 100 kPa / (1 % of 5e-3 / s)
    assert_true(isinf(scree_minimal_viscosity(0, target)));
}

static void affine_bodies_move_with_the_gradient(void **unused)
{
    (void)unused;
    const scree_boundary *affine = scree_module_affine.boundary;
    const double target[9] = {0.5, -0.3, 0.1, 0.7, -1, 0, 0.2, 0, 0.4};
    for (int dimension = 2; dimension <= 3; dimension++) {
        bench b;
        bench_create(&b, dimension);
        scree_state *state = &b.state;
        for (int i = 0; i < 9; i++)
            if (i / 3 < dimension && i % 3 < dimension) scree_imposed(state)->target[i] = target[i];
        for (size_t r = 0; r < state->count; r++) state->sum[r].fy = (int64_t)(1e15 * uniform(500 + r));
        assert_int_equal(boundary_pass(affine, SCREE_PHASE_SEARCH, &b.model, state, &b.work, NULL), SCREE_OK);
        double begin = kinetic(state), bound = affine->bound(&(scree_context){.model = &b.model, .state = state});
        int64_t others[SIDES + RINGS * RING];
        for (size_t r = 0; r < state->count; r++) others[r] = state->sum[r].fy;
        boundary_load(affine, &b.model, state, &b.work);
        kick(state);
        boundary_follow(affine, &b.model, state);
        double rate[9], outer = 0;
        measure_rate(&b, rate);
        for (int i = 0; i < 9; i++) assert_true(fabs(rate[i] - scree_imposed(state)->target[i]) < 1e-11);
        for (size_t k = 0; k < scree_imposed(state)->count; k++) {
            size_t r = scree_boundary_row(state, k);
            double mean = state->row[r].vy - 0.5 * STEP * (double)state->sum[r].fy * QUANTUM / state->row[r].mass;
            outer += STEP * (double)others[r] * QUANTUM * mean;
            // Apart from the others, which it balances, no force is above the bound.
            double own = scree_imposed(state)->force[k][1] + (double)others[r] * QUANTUM;
            assert_true(fabs(own) <= bound * (1 + 1e-12));
        }
        // The work of the boundary and of the other forces is the change of the kinetic energy.
        double gained = kinetic(state) - begin;
        assert_true(fabs(gained - outer - state->ledger.boundary) < 1e-12 * (fabs(gained) + begin + fabs(outer)));
        scree_state_destroy(state);
    }
}

/// Walls that go take the elastic energy of their contacts out of the ledger.
static void walls_come_and_go(void **unused)
{
    (void)unused;
    bench b;
    bench_create(&b, 2);
    scree_state *state = &b.state;
    bool changed;
    b.model.scheme = SCREE_SLOT_position_verlet;
    // Bodies with an extent, at rest: a motion of the whole would take its energy out of the ledger, too.
    for (size_t row = 0; row < state->count; row++) {
        state->row[row].radius = 0.1 * SIZE;
        state->row[row].vx = state->row[row].vy = 0;
    }
    for (int w = 0; w < 4; w++) scree_plates(state)[w].active = 1;
    scree_plates(state)[SCREE_WALL_TOP].velocity = 3;
    scree_contact contact[3] = {{.wall = true, .second = SCREE_WALL_TOP, .elastic_normal = 2, .elastic_tangential = 1},
                                {.wall = true, .second = SCREE_WALL_LEFT, .elastic_normal = 8},
                                {.wall = false, .second = SCREE_WALL_TOP, .elastic_normal = 64}};
    scree_contact_table table = {.contact = contact, .count = 3};
    const scree_boundary *pressure = scree_module_pressure_boundary.boundary;
    assert_int_equal(scree_boundary_begin(pressure, &b.model, state, &table, &changed, NULL), SCREE_OK);
    assert_true(changed && state->ledger.plates == -8);
    assert_true(scree_plates(state)[SCREE_WALL_TOP].active && !scree_plates(state)[SCREE_WALL_LEFT].active);
    assert_int_equal(scree_boundary_begin(pressure, &b.model, state, &table, &changed, NULL), SCREE_OK);
    assert_true(!changed && state->ledger.plates == -8 && scree_plates(state)[SCREE_WALL_TOP].velocity == 3);
    const scree_boundary *minimal = scree_module_minimal.boundary;
    assert_int_equal(scree_boundary_begin(minimal, &b.model, state, &table, &changed, NULL), SCREE_OK);
    assert_true(changed && state->ledger.plates == -11 && scree_plates(state)[SCREE_WALL_TOP].velocity == 0);
    assert_true(scree_boundary_has_plates(pressure) && !scree_boundary_has_plates(minimal));
    scree_state_destroy(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(area_vectors_integrate_the_normal),
        cmocka_unit_test(the_power_of_a_stress_is_volume_stress_rate),
        cmocka_unit_test(minimal_conditions_meet_their_rates),
        cmocka_unit_test(a_multiplier_out_of_range_stops_the_run),
        cmocka_unit_test(a_strain_rate_has_no_moment),
        cmocka_unit_test(penalty_is_stable_and_booked),
        cmocka_unit_test(affine_bodies_move_with_the_gradient),
        cmocka_unit_test(walls_come_and_go),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
