/// Measures in three dimensions: stress from contacts and boundary, bodies that bear no load, fluctuations.
#include "measure/delaunay_boundary.h"
#include "state/plates.h"
#include "testing.h"

#include "base/random.h"
#include "boundary/pressure.h"
#include "measure/hull.h"
#include "measure/measure.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

#define PRESSURE 1e5
#define RADIUS   0.75e-3

static double uniform(uint64_t counter)
{
    return scree_random_uniform(6, SCREE_RANDOM_TEST, counter);
}

typedef struct bench {
    scree_model model;
    scree_state state;
    scree_contact contact[2000];
    scree_contact_table table;
} bench;

/// 5 x 5 x 9 spheres on a disturbed lattice between two plates, under pressure, with a hull.
static bench *bench_create(void)
{
    bench *b;
    assert_int_equal(scree_allocate(&b, 1, sizeof *b, NULL), SCREE_OK);
    b->model.upkeep = (scree_upkeep){.every = 250, .gap_limit = 0.5};
    b->model.dimension = 3;
    b->model.thickness = 1;
    b->model.mean_radius = RADIUS;
    b->model.material_count = 1;
    b->model.pairs[0][0].value[SCREE_FRICTION] = 0.45;
    b->table.contact = b->contact;
    assert_int_equal(scree_state_create(&b->state, 3, 225, NULL), SCREE_OK);
    scree_pressure_set(&b->state, PRESSURE);
    b->state.force_quantum = 0x1p-50;
    for (size_t i = 0; i < 225; i++) {
        scree_row *row = &b->state.row[i];
        row->radius = RADIUS;
        row->x = 2 * RADIUS * ((double)(i % 5) + 0.2 * uniform(4 * i));
        row->y = 2 * RADIUS * ((double)(i / 5 % 5) + 0.2 * uniform(4 * i + 1));
        row->z = 2 * RADIUS * ((double)(i / 25) + 0.2 * uniform(4 * i + 2));
    }
    static const int axis[SCREE_WALL_COUNT] = {2, 2, 0, 0, 1, 1};
    for (int w = 0; w < SCREE_WALL_COUNT; w++) scree_plates(&b->state)[w].normal[axis[w]] = w % 2 ? -1 : 1;
    scree_plates(&b->state)[SCREE_WALL_BOTTOM].position = -RADIUS;
    scree_plates(&b->state)[SCREE_WALL_TOP].position = -17.4 * RADIUS;
    scree_plates(&b->state)[SCREE_WALL_BOTTOM].active = scree_plates(&b->state)[SCREE_WALL_TOP].active = 1;
    assert_int_equal(scree_boundary_refresh(&b->model, &b->state, NULL), SCREE_OK);
    scree_pressure_forces(&b->model, &b->state);
    return b;
}

static void bench_destroy(bench *b)
{
    scree_state_destroy(&b->state);
    scree_release(&b);
}

/// A contact between two bodies, or of one with a wall (second = wall), with any force.
static void add_contact(bench *b, uint32_t first, uint32_t second, bool wall, uint64_t counter)
{
    scree_contact *contact = &b->contact[b->table.count++];
    scree_vector x, y;
    *contact = (scree_contact){.first = first, .second = second, .wall = wall};
    scree_body_position(&b->state, first, x);
    if (wall) {
        memcpy(y, x, sizeof y);
        y[2] = scree_plates(&b->state)[second].normal[2] * scree_plates(&b->state)[second].position;
    } else {
        scree_body_position(&b->state, second, y);
    }
    for (int k = 0; k < 3; k++) contact->branch[k] = x[k] - y[k];
    for (int k = 0; k < 3; k++) contact->normal[k] = contact->branch[k] / scree_length(contact->branch);
    for (int k = 0; k < 3; k++) contact->point[k] = wall ? y[k] : (x[k] + y[k]) / 2;
    contact->normal_force = 0.2 + uniform(counter);
    contact->tangential_force = 0.3 * uniform(counter + 1);
    // Any direction across the normal.
    scree_vector any = {uniform(counter + 2), uniform(counter + 3), uniform(counter + 4)};
    double along = 0;
    for (int k = 0; k < 3; k++) along += any[k] * contact->normal[k];
    for (int k = 0; k < 3; k++) any[k] -= along * contact->normal[k];
    for (int k = 0; k < 3; k++) contact->tangent[k] = any[k] / scree_length(any);
}

/// Any forces at all, out of equilibrium: contact stress = boundary stress - residual, an identity.
static void contacts_and_boundary_differ_by_the_residual(void **user)
{
    (void)user;
    bench *b = bench_create();
    for (uint32_t i = 0; i < 225; i++) {
        if (i % 5 < 4) add_contact(b, i, i + 1, false, 1000 + 20 * i);
        if (i / 5 % 5 < 4) add_contact(b, i, i + 5, false, 1005 + 20 * i);
        if (i + 25 < 225) add_contact(b, i, i + 25, false, 1010 + 20 * i);
        if (i < 25) add_contact(b, i, SCREE_WALL_BOTTOM, true, 1015 + 20 * i);
        if (i >= 200) add_contact(b, i, SCREE_WALL_TOP, true, 1015 + 20 * i);
    }
    double contacts[9], boundary[9], plates[9], residual[9] = {0}, volume = scree_sample_volume(&b->model, &b->state);
    scree_vector centre;
    assert_true(scree_hull_sample_volume(&b->state, centre) == volume);
    scree_vector *resultant;
    assert_int_equal(scree_allocate(&resultant, 225, sizeof *resultant, NULL), SCREE_OK);
    for (size_t c = 0; c < b->table.count; c++) {
        const scree_contact *contact = &b->contact[c];
        for (int k = 0; k < 3; k++) {
            double f = contact->normal_force * contact->normal[k] + contact->tangential_force * contact->tangent[k];
            resultant[contact->first][k] += f;
            if (!contact->wall) resultant[contact->second][k] -= f;
            if (contact->wall) {
                scree_wall *wall = &scree_plates(&b->state)[contact->second];
                wall->force += f * wall->normal[k];
                if (k < 2) wall->shear[k] -= f;
            }
        }
    }
    for (size_t n = 0; n < scree_hull_of(&b->state)->node_count; n++)
        for (int k = 0; k < 3; k++)
            resultant[scree_hull_of(&b->state)->id[n]][k] += scree_hull_of(&b->state)->force[n][k];
    for (size_t i = 0; i < 225; i++) {
        scree_vector x;
        scree_body_position(&b->state, i, x);
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++) residual[3 * r + c] += resultant[i][r] * (x[c] - centre[c]) / volume;
    }
    scree_stress_from_contacts(&b->state, &b->table, volume, contacts);
    scree_stress_from_boundary(&b->model, &b->state, &b->table, boundary);
    scree_stress_from_plates(&b->model, &b->state, plates);
    double scale = fabs(boundary[0]) + fabs(boundary[4]) + fabs(boundary[8]);
    assert_true(scale > 0);
    // Sums of some 1000 products: round-off.
    for (int i = 0; i < 9; i++) assert_true(fabs(contacts[i] - (boundary[i] - residual[i])) < 1e-12 * scale);
    // What the resultants on the plates know: the axial stress, and the lateral one but for the plates' friction.
    assert_true(fabs(plates[8] - boundary[8]) < 1e-12 * scale);
    assert_true(fabs(plates[2] - boundary[2]) < 1e-12 * scale && fabs(plates[5] - boundary[5]) < 1e-12 * scale);
    assert_true(fabs(plates[0] + PRESSURE) < 1e-11 * PRESSURE);
    scree_release(&resultant);
    bench_destroy(b);
}

/// Fraction of rattlers when body 0 has contacts with these normals (from the others to it) and all others are held.
static bool is_rattler(double friction, const scree_vector *normal, size_t count)
{
    bench *b = bench_create();
    memset(scree_hull_of(&b->state)->force, 0,
           scree_hull_of(&b->state)->node_count * sizeof *scree_hull_of(&b->state)->force);
    b->model.pairs[0][0].value[SCREE_FRICTION] = friction;
    scree_coordination before, after;
    // Bodies 1 .. 6 each rest between three pairs of walls; all the rest are rattlers anyway.
    static const scree_vector axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (uint32_t i = 1; i <= 6; i++)
        for (int k = 0; k < 6; k++) {
            scree_contact *contact = &b->contact[b->table.count++];
            *contact = (scree_contact){.first = i, .second = (uint32_t)k, .wall = true};
            memcpy(contact->normal, axes[k], sizeof axes[k]);
        }
    assert_int_equal(scree_coordination_measure(&b->model, &b->state, NULL, &b->table, &before, NULL), SCREE_OK);
    for (size_t k = 0; k < count; k++) {
        scree_contact *contact = &b->contact[b->table.count++];
        *contact = (scree_contact){.first = 0, .second = (uint32_t)(1 + k)};
        for (int i = 0; i < 3; i++) contact->normal[i] = normal[k][i] / scree_length(normal[k]);
    }
    assert_int_equal(scree_coordination_measure(&b->model, &b->state, NULL, &b->table, &after, NULL), SCREE_OK);
    assert_true(fabs(before.rattler_fraction - 219 / 225.0) < 1e-15);
    bool rattler = after.rattler_fraction > before.rattler_fraction - 0.5 / 225;
    double contacts = rattler ? 36 / 6.0 : (36 + 2 * (double)count) / 7;
    assert_true(fabs(after.mean_without_rattlers - contacts) < 1e-14);
    bench_destroy(b);
    return rattler;
}

/// Two normals at this angle [degrees].
static bool pair_is_rattler(double friction, double degrees)
{
    double angle = degrees * M_PI / 180;
    const scree_vector normal[2] = {{0.6, 0.8, 0},
                                    {0.6 * cos(angle) - 0.8 * sin(angle), 0.6 * sin(angle) + 0.8 * cos(angle)}};
    return is_rattler(friction, normal, 2);
}

static void rattlers_have_all_supports_on_one_side(void **user)
{
    (void)user;
    // The friction angle of 0.45 is 24.2 degrees: two contacts hold a body when they are more than 180 - 48.5 apart.
    assert_true(pair_is_rattler(0.45, 125));
    assert_false(pair_is_rattler(0.45, 138));
    assert_false(pair_is_rattler(0.45, 180));
    assert_true(pair_is_rattler(0.1, 138));
    assert_true(pair_is_rattler(0, 180));
    // One contact, or three below the body.
    const scree_vector below[3] = {{1, 0, 1}, {-0.5, 0.9, 1}, {-0.5, -0.9, 1}};
    assert_true(is_rattler(0.45, below, 1));
    assert_true(is_rattler(0.45, below, 3));
    assert_false(is_rattler(1.2, below, 3)); // within 45 degrees of the vertical, friction angle 50
    // Without friction four round the body, not four on one side.
    const scree_vector round[4] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    const scree_vector side[4] = {{1, 1, 1}, {1, -1, 0.2}, {-1, 1, 0.1}, {-1, -1, 0.5}};
    assert_false(is_rattler(0, round, 4));
    assert_true(is_rattler(0, side, 4));
    assert_true(is_rattler(0, round, 3));
}

static void the_pressure_supports(void **user)
{
    (void)user;
    // A body of the hull held by one contact against the pressure on it.
    bench *b = bench_create();
    scree_coordination before, after;
    uint32_t node = 0;
    while (scree_length(scree_hull_of(&b->state)->force[node]) == 0) node++;
    uint32_t body = scree_hull_of(&b->state)->id[node], other = body == 112 ? 113 : 112;
    for (int k = 0; k < 6; k++) {
        scree_contact *contact = &b->contact[b->table.count++];
        *contact = (scree_contact){.first = other, .second = (uint32_t)k, .wall = true};
        contact->normal[k / 2] = k % 2 ? 1 : -1;
    }
    assert_int_equal(scree_coordination_measure(&b->model, &b->state, NULL, &b->table, &before, NULL), SCREE_OK);
    scree_contact *contact = &b->contact[b->table.count++];
    *contact = (scree_contact){.first = body, .second = other};
    for (int k = 0; k < 3; k++)
        contact->normal[k] =
            -scree_hull_of(&b->state)->force[node][k] / scree_length(scree_hull_of(&b->state)->force[node]);
    assert_int_equal(scree_coordination_measure(&b->model, &b->state, NULL, &b->table, &after, NULL), SCREE_OK);
    assert_true(fabs(before.rattler_fraction - after.rattler_fraction - 1 / 225.0) < 1e-14);
    bench_destroy(b);
}

static void fluctuations_leave_the_affine_part(void **user)
{
    (void)user;
    enum { COUNT = 300 };
    double place[3][COUNT], moved[3][COUNT], rest[3][COUNT], g[9];
    static const double f[9] = {0.01, -0.02, 0.03, 0.005, 0.02, -0.01, 0, 0.015, -0.04};
    const double *const from[] = {place[0], place[1], place[2]}, *const to[] = {moved[0], moved[1], moved[2]};
    double *const fluctuation[] = {rest[0], rest[1], rest[2]};
    for (size_t n = 0; n < COUNT; n++)
        for (size_t i = 0; i < 3; i++) place[i][n] = 3 + 2 * uniform(70000 + 3 * n + i);
    for (size_t n = 0; n < COUNT; n++)
        for (int i = 0; i < 3; i++) {
            moved[i][n] = place[i][n] + 0.1 * i;
            for (int j = 0; j < 3; j++) moved[i][n] += f[3 * i + j] * place[j][n];
        }
    // Round-off of 300 places of size 5.
    assert_true(scree_fluctuations(3, from, to, COUNT, fluctuation, g) < 1e-14);
    for (int i = 0; i < 9; i++) assert_true(fabs(g[i] - f[i]) < 1e-13);
    moved[2][7] += 0.5;
    double rms = scree_fluctuations(3, from, to, COUNT, fluctuation, g);
    assert_true(fabs(rest[2][7] - 0.5) < 0.02 && fabs(rest[0][7]) < 1e-12);
    assert_true(fabs(rms - 0.5 / sqrt(COUNT)) < 0.02 / sqrt(COUNT));
    // In a plane: no gradient across it.
    for (size_t n = 0; n < COUNT; n++) place[2][n] = place[0][n] - 2 * place[1][n];
    (void)scree_fluctuations(3, from, to, COUNT, fluctuation, g);
    for (int i = 0; i < 9; i++) assert_true(g[i] == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contacts_and_boundary_differ_by_the_residual),
        cmocka_unit_test(rattlers_have_all_supports_on_one_side),
        cmocka_unit_test(the_pressure_supports),
        cmocka_unit_test(fluctuations_leave_the_affine_part),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
