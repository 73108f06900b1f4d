/// Pressure on the triangulated hull in 3D: which triangles carry it, what it adds up to, its work, its strain, the
/// stress that it makes; volume and strain of polyhedra.
#include "boundary_fixture.h"
#include "measure/delaunay_boundary.h"
#include "state/plates.h"

#include "boundary/plates.h"
#include "integrate/integrate.h"
#include "measure/hull.h"
#include "measure/polyhedron.h"
#include "state/pressure.h"
#include "state_bits.h"

#include <stdlib.h>

/// side x side x levels spheres.
static void bench_create(bench *b, size_t side, size_t levels, bool plates)
{
    bench_begin(b, 3, side * side * levels, 1e-6);
    bench_fill(b, side, plates);
}

static void add_sums(const scree_state *state, int64_t total[3])
{
    total[0] = total[1] = total[2] = 0;
    for (size_t i = 0; i < state->count; i++) {
        total[0] += state->sum[i].fx;
        total[1] += state->sum[i].fy;
        total[2] += state->sum[i].fz;
    }
}

static void a_closed_hull_has_no_net_force(void **user)
{
    (void)user;
    bench b;
    bench_create(&b, 5, 11, false);
    scree_state *state = &b.state;
    assert_int_equal(scree_boundary_refresh(&b.model, state, NULL), SCREE_OK);
    const scree_hull *hull = scree_hull_of(state);
    assert_int_equal(hull->triangle_count, 2 * hull->node_count - 4);
    for (size_t k = 1; k < hull->node_count; k++) assert_true(hull->id[k] > hull->id[k - 1]);
    for (size_t t = 0; t < hull->triangle_count; t++) assert_int_equal(hull->loaded[t], SCREE_HULL_LOADED);
    scree_pressure_forces(&b.model, state);
    int64_t total[3];
    add_sums(state, total);
    for (int k = 0; k < 3; k++) assert_int_equal(total[k], 0); // as integers
    // sum f . x = -p times the integral of n . x = -3 p V; about any origin.
    double virial = 0;
    for (size_t k = 0; k < hull->node_count; k++) {
        scree_vector place;
        scree_hull_position(state, k, place);
        const scree_sum_row *sum = &state->sum[state->row_of_id[hull->id[k]]];
        double force[3] = {(double)sum->fx * QUANTUM, (double)sum->fy * QUANTUM, (double)sum->fz * QUANTUM};
        for (int i = 0; i < 3; i++) {
            virial += force[i] * place[i];
            // Sums of a few integers of less than 53 bits times a power of two.
            assert_true(fabs(hull->force[k][i] - force[i]) <= 1e-15 * fabs(force[i]));
        }
        assert_true(scree_length(force) <= scree_pressure_bound(&b.model, state));
    }
    double expected = -3 * PRESSURE * scree_hull_volume(state);
    assert_true(expected < 0);
    assert_true(fabs(virial - expected) < 1e-11 * fabs(expected)); // rounding of 500 forces to 2^-51 N
    scree_state_destroy(state);
}

static void plates_take_the_ends(void **user)
{
    (void)user;
    bench b;
    bench_create(&b, 6, 13, true);
    scree_state *state = &b.state;
    assert_int_equal(scree_boundary_refresh(&b.model, state, NULL), SCREE_OK);
    const scree_hull *hull = scree_hull_of(state);
    scree_pressure_forces(&b.model, state);
    int64_t total[3];
    add_sums(state, total);
    assert_int_equal(total[0], 0); // the sides press against each other, as integers
    assert_int_equal(total[1], 0);
    // Vertically they press with p times the difference of the plates' areas, which the plates must bear.
    double bottom = scree_hull_plate_area(state, SCREE_WALL_BOTTOM), top = scree_hull_plate_area(state, SCREE_WALL_TOP);
    double expected = PRESSURE * (top - bottom), scale = PRESSURE * (top + bottom);
    assert_true(fabs((double)total[2] * QUANTUM - expected) < 1e-12 * scale);
    // The plates see about the section of the sample: the centres of a level fill 5 to 5.2 diameters each way.
    double section = 5.1 * 5.1 * 4 * RADIUS * RADIUS;
    assert_true(bottom > 0.9 * section && bottom < 1.1 * section);
    assert_true(top > 0.9 * section && top < 1.1 * section);
    assert_true(scree_plate_area(&b.model, state, SCREE_WALL_TOP) == top);
    // One connected side, from plate to plate; nothing else is loaded.
    size_t loaded = 0, facing[2] = {0};
    for (size_t t = 0; t < hull->triangle_count; t++) {
        loaded += hull->loaded[t] == SCREE_HULL_LOADED;
        for (int w = 0; w < 2; w++) facing[w] += hull->loaded[t] == SCREE_HULL_ON_WALL + w;
    }
    assert_int_equal(loaded + facing[0] + facing[1], hull->triangle_count);
    assert_true(facing[0] > 30 && facing[1] > 30);
    // The lateral stress of the boundary is -p for any shape of the sides.
    scree_contact_table empty = {0};
    double stress[9], volume = scree_sample_volume(&b.model, state);
    scree_stress_from_boundary(&b.model, state, &empty, stress);
    assert_true(fabs(stress[0] + PRESSURE) < 1e-11 * PRESSURE && fabs(stress[4] + PRESSURE) < 1e-11 * PRESSURE);
    assert_true(fabs(stress[1]) < 1e-11 * PRESSURE && fabs(stress[3]) < 1e-11 * PRESSURE);
    // With plates that bear p on their areas (and the gap walls' vertical part, which there is none of) so is the
    // axial.
    scree_plates(state)[SCREE_WALL_BOTTOM].force = PRESSURE * bottom;
    scree_plates(state)[SCREE_WALL_TOP].force = PRESSURE * top;
    scree_stress_from_plates(&b.model, state, stress);
    assert_true(fabs(stress[8] + PRESSURE) < 1e-11 * PRESSURE);
    assert_true(isnan(stress[1]) && isnan(stress[3])); // where on the plates their friction acts is not known
    assert_true(fabs(stress[2] - stress[6]) == 0 && fabs(stress[5] - stress[7]) == 0);
    // The sample is larger than the hull by what lies between it and the plates.
    assert_true(volume > scree_hull_volume(state));
    double height = -(scree_plates(state)[SCREE_WALL_BOTTOM].position + scree_plates(state)[SCREE_WALL_TOP].position);
    assert_true(volume < 1.2 * section * height && volume > 0.9 * section * height);
    scree_state_destroy(state);
}

static void a_column_of_known_volume(void **user)
{
    (void)user;
    // Eight equal spheres at the corners of a cube of edge 2 R between plates that touch them, and four in its middle
    // plane: the sample is the square column from plate to plate.
    bench b;
    bench_create(&b, 2, 3, true);
    scree_state *state = &b.state;
    for (size_t i = 0; i < state->count; i++) {
        scree_row *row = &state->row[i];
        row->radius = RADIUS;
        row->x = 2 * RADIUS * (double)(i % 2);
        row->y = 2 * RADIUS * (double)(i / 2 % 2);
        row->z = 2 * RADIUS * (double)(i / 4);
    }
    scree_plates(state)[SCREE_WALL_BOTTOM].position = -RADIUS;
    scree_plates(state)[SCREE_WALL_TOP].position = -5 * RADIUS;
    assert_int_equal(scree_boundary_refresh(&b.model, state, NULL), SCREE_OK);
    scree_pressure_forces(&b.model, state);
    double area = 4 * RADIUS * RADIUS;
    assert_int_equal(scree_hull_of(state)->node_count, 12);
    assert_true(fabs(scree_hull_plate_area(state, SCREE_WALL_TOP) - area) < 1e-14 * area);
    assert_true(fabs(scree_hull_plate_area(state, SCREE_WALL_BOTTOM) - area) < 1e-14 * area);
    assert_true(fabs(scree_hull_volume(state) - 4 * RADIUS * area) < 1e-13 * RADIUS * area);
    assert_true(fabs(scree_sample_volume(&b.model, state) - 6 * RADIUS * area) < 1e-13 * RADIUS * area);
    // The face x = 0 is 2 R wide and 6 R high; its four corner bodies and two middle ones share p times that.
    double push = 0;
    for (size_t i = 0; i < state->count; i += 2) push += (double)state->sum[i].fx * QUANTUM;
    assert_true(fabs(push - PRESSURE * 12 * RADIUS * RADIUS) < 1e-13);
    // An eighth, and a quarter, of a sphere at each body.
    double fraction, solid = (8 / 8.0 + 4 / 4.0) * 4 * M_PI / 3 * pow(RADIUS, 3);
    assert_int_equal(scree_solid_fraction(state, &fraction, NULL), SCREE_OK);
    assert_true(fabs(fraction - solid / scree_hull_volume(state)) < 1e-13);
    scree_state_destroy(state);
}

static void plates_all_round_leave_nothing_to_press(void **user)
{
    (void)user;
    bench b;
    bench_create(&b, 4, 6, true);
    for (int w = 0; w < SCREE_WALL_COUNT; w++) {
        scree_plates(&b.state)[w].active = 1;
        scree_plates(&b.state)[w].position = w % 2 ? -(w + 1) * 1e-2 : 0;
    }
    assert_int_equal(scree_boundary_refresh(&b.model, &b.state, NULL), SCREE_OK);
    scree_pressure_forces(&b.model, &b.state);
    for (size_t i = 0; i < b.state.count; i++)
        assert_true(b.state.sum[i].fx == 0 && b.state.sum[i].fy == 0 && b.state.sum[i].fz == 0);
    assert_true(fabs(scree_sample_volume(&b.model, &b.state) - 2e-2 * 4e-2 * 6e-2) < 1e-19);
    assert_true(fabs(scree_plate_area(&b.model, &b.state, SCREE_WALL_TOP) - 4e-2 * 6e-2) < 1e-17);
    assert_true(fabs(scree_plate_area(&b.model, &b.state, SCREE_WALL_LEFT) - 2e-2 * 6e-2) < 1e-17);
    assert_true(fabs(scree_plate_area(&b.model, &b.state, SCREE_WALL_BACK) - 2e-2 * 4e-2) < 1e-17);
    scree_state_destroy(&b.state);
}

static void rows_do_not_show(void **user)
{
    (void)user;
    bench a, b;
    bench_create(&a, 5, 9, true);
    bench_create(&b, 5, 9, true);
    uint32_t order[5 * 5 * 9];
    for (uint32_t k = 0; k < 225; k++) order[k] = 41 * k % 225; // no common factor
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
        bench_create(&b, 4, 7, true);
        scree_state *state = &b.state;
        scree_work work = {.threads = 1};
        b.model.scheme = scheme;
        b.model.upkeep.every = 7; // the hull changes meanwhile
        const scree_integrator *integrator = scree_integrator_get(b.model.scheme);
        scree_contact_table empty = {0};
        scree_energy energy;
        state->step_size = 2e-5;
        assert_int_equal(scree_boundary_refresh(&b.model, state, NULL), SCREE_OK);
        scree_pressure_forces(&b.model, state);
        state->ledger = (scree_ledger){0};
        scree_energy_measure(&b.model, state, &empty, &energy);
        state->ledger.initial = energy.kinetic + energy.kinetic_rotation;
        for (int step = 0; step < 60; step++) {
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
        scree_state_destroy(state);
    }
}

static void refresh_is_due_and_closes_the_strain(void **user)
{
    (void)user;
    bench b;
    bench_create(&b, 4, 9, true);
    scree_state *state = &b.state;
    assert_int_equal(scree_boundary_refresh(&b.model, state, NULL), SCREE_OK);
    uint64_t updated = scree_hull_of(state)->updated;
    for (int k = 0; k < 20; k++) {
        for (size_t i = 0; i < state->count; i++) {
            state->row[i].x *= 1.005;
            state->row[i].y *= 1.002;
            state->row[i].z *= 0.99;
        }
        state->step += 249;
        assert_int_equal(scree_boundary_refresh(&b.model, state, NULL), SCREE_OK);
        assert_int_equal(scree_hull_of(state)->updated, updated);
        state->step++;
        assert_int_equal(scree_boundary_refresh(&b.model, state, NULL), SCREE_OK);
        assert_int_equal(scree_hull_of(state)->updated, state->step);
        updated = state->step;
    }
    double total[9];
    scree_strain_measure(state, total);
    static const double lengthening[3] = {1.005, 1.002, 0.99};
    // Each increment is the logarithm to third order; with the largest strain 1e-2 the coefficient is below one half.
    for (int i = 0; i < 3; i++) assert_true(fabs(total[4 * i] - 20 * log(lengthening[i])) < 20 * 0.5e-6);
    for (int i = 0; i < 9; i++)
        if (i % 4 != 0) assert_true(fabs(total[i]) < 1e-12);
    scree_state_destroy(state);
}

static void failures_leave_the_state(void **user)
{
    (void)user;
    bench b;
    bench_create(&b, 4, 6, true);
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
    for (size_t i = 0; i < b.state.count; i++) b.state.row[i].z = b.state.row[i].x;
    b.state.step = 1000;
    uint64_t moved = state_bits(&b.state);
    assert_int_equal(scree_boundary_refresh(&b.model, &b.state, &error), SCREE_ERROR_GUARD);
    assert_true(state_bits(&b.state) == moved);
    scree_state_destroy(&b.state);
}

/// A random polyhedron like a sphere: the hull of a bench of few bodies.
typedef struct polyhedron {
    bench b;
    double (*u)[3]; ///< by node
} polyhedron;

static void sum_polyhedron(const polyhedron *p, double *volume, double gradient[9])
{
    const scree_hull *hull = scree_hull_of(&p->b.state);
    scree_polyhedron_sum sum = {0};
    while (scree_polyhedron_next(&sum))
        for (size_t t = 0; t < hull->triangle_count; t++) {
            double x[3][3], u[3][3];
            for (int c = 0; c < 3; c++)
                for (int k = 0; k < 3; k++) {
                    x[c][k] = hull->position[hull->triangle[t][c]][k];
                    u[c][k] = p->u ? p->u[hull->triangle[t][c]][k] : 0;
                }
            scree_polyhedron_add(&sum, x, u);
        }
    *volume = scree_integer_sum_total(&sum.volume);
    scree_polyhedron_finish(&sum, gradient);
}

static void polyhedra_keep_their_promises(void **user)
{
    (void)user;
    polyhedron p = {0};
    bench_create(&p.b, 3, 5, false);
    scree_hull *hull = scree_hull_of(&p.b.state);
    assert_int_equal(scree_boundary_refresh(&p.b.model, &p.b.state, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&p.u, hull->node_count, sizeof *p.u, NULL), SCREE_OK);
    double before, after, middle, unused[9], gradient[9], (*u)[3] = p.u;
    // Any motion, a large one: trace = change of volume over the volume in the middle.
    for (size_t k = 0; k < hull->node_count; k++)
        for (size_t i = 0; i < 3; i++) u[k][i] = RADIUS * (2 * uniform(3 * k + i + 50000) - 1);
    sum_polyhedron(&p, &middle, gradient);
    p.u = NULL;
    sum_polyhedron(&p, &before, unused);
    for (size_t k = 0; k < hull->node_count; k++)
        for (int i = 0; i < 3; i++) hull->position[k][i] += u[k][i];
    sum_polyhedron(&p, &after, unused);
    for (size_t k = 0; k < hull->node_count; k++)
        for (int i = 0; i < 3; i++) hull->position[k][i] -= u[k][i];
    double trace = gradient[0] + gradient[4] + gradient[8];
    assert_true(fabs(after - before) > 1e-3 * before);
    assert_true(fabs(trace * middle - (after - before)) < 1e-13 * before);
    // A rotation by half a radian about a skew axis: no symmetric part.
    double axis[3] = {1 / 3.0, 2 / 3.0, -2 / 3.0}, c = cos(0.5), s = sin(0.5);
    for (size_t k = 0; k < hull->node_count; k++) {
        const double *x = hull->position[k];
        double along = axis[0] * x[0] + axis[1] * x[1] + axis[2] * x[2];
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3, l = (i + 2) % 3;
            u[k][i] = c * x[i] + s * (axis[j] * x[l] - axis[l] * x[j]) + (1 - c) * along * axis[i] - x[i];
        }
    }
    p.u = u;
    sum_polyhedron(&p, &middle, gradient);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) assert_true(fabs(gradient[3 * i + j] + gradient[3 * j + i]) < 1e-13);
    assert_true(fabs(gradient[1]) > 0.1);
    // A small affine map: the logarithm to third order.
    double f[9] = {1e-3, 2e-3, -1e-3, 0.5e-3, -2e-3, 1e-3, 1e-3, 0, 1.5e-3};
    for (size_t k = 0; k < hull->node_count; k++)
        for (int i = 0; i < 3; i++) {
            u[k][i] = 0;
            for (int j = 0; j < 3; j++) u[k][i] += f[3 * i + j] * hull->position[k][j];
        }
    sum_polyhedron(&p, &middle, gradient);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double logarithm = f[3 * i + j];
            for (int k = 0; k < 3; k++) logarithm -= f[3 * i + k] * f[3 * k + j] / 2;
            // |f| is about 4e-3; the next terms are of its cube.
            assert_true(fabs(gradient[3 * i + j] - logarithm) < 4e-8);
        }
    scree_release(&p.u);
    scree_state_destroy(&p.b.state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_closed_hull_has_no_net_force),
        cmocka_unit_test(plates_take_the_ends),
        cmocka_unit_test(a_column_of_known_volume),
        cmocka_unit_test(plates_all_round_leave_nothing_to_press),
        cmocka_unit_test(rows_do_not_show),
        cmocka_unit_test(work_is_the_kinetic_energy),
        cmocka_unit_test(refresh_is_due_and_closes_the_strain),
        cmocka_unit_test(failures_leave_the_state),
        cmocka_unit_test(polyhedra_keep_their_promises),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
