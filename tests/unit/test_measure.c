/// The measures against closed forms: stress of hand-made equilibria, strain of affine maps, counting, energies.
#include "measure/delaunay_boundary.h"
#include "state/plates.h"
#include "testing.h"

#include "base/random.h"
#include "boundary/pressure.h"
#include "integrate/integrate.h"
#include "measure/measure.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

#define RADIUS           0.75e-3
#define THICKNESS        1.5e-3
#define PRESSURE         1e5

#define uniform(counter) scree_random_uniform(11, SCREE_RANDOM_TEST, counter)

/// Equal to a fraction of `scale`; NAN is equal to nothing.
static bool near(double value, double expected, double fraction, double scale)
{
    return fabs(value - expected) <= fraction * scale;
}

typedef struct bench {
    scree_model model;
    scree_state state;
    scree_contact contact[256];
    scree_contact_table table;
} bench;

static void bench_create(bench *b, size_t count)
{
    memset(b, 0, sizeof *b);
    b->model = (scree_model){.upkeep = {.every = 250, .gap_limit = 0.5},
                             .laws = {{.law = SCREE_SLOT_hertz_mindlin}},
                             .scheme = SCREE_SLOT_position_verlet,
                             .thickness = THICKNESS,
                             .mean_radius = RADIUS,
                             .material_count = 1};
    b->model.pairs[0][0].value[SCREE_FRICTION] = 0.5;
    assert_int_equal(scree_state_create(&b->state, 2, count, NULL), SCREE_OK);
    b->state.force_quantum = b->state.torque_quantum = 0x1p-50;
    b->state.step_size = 1e-6;
    const double normals[][2] = {{0, 1}, {0, -1}, {1, 0}, {-1, 0}};
    for (int w = 0; w <= SCREE_WALL_RIGHT; w++)
        memcpy(scree_plates(&b->state)[w].normal, normals[w], sizeof normals[w]);
    for (size_t i = 0; i < count; i++) {
        b->state.row[i].radius = RADIUS;
        b->state.row[i].mass = 1e-3;
    }
    b->table.contact = b->contact;
}

static void place(bench *b, size_t i, double x, double y)
{
    b->state.row[i].x = x * RADIUS;
    b->state.row[i].y = y * RADIUS;
}

static void put_wall(bench *b, int wall, double position)
{
    scree_plates(&b->state)[wall].position = position * RADIUS;
    scree_plates(&b->state)[wall].active = 1;
}

/// A contact of two bodies with the given forces.
static scree_contact *touch(bench *b, uint32_t first, uint32_t second, double normal_force, double tangential_force)
{
    const scree_row *i = &b->state.row[first], *j = &b->state.row[second];
    double branch[2] = {i->x - j->x, i->y - j->y}, length = hypot(branch[0], branch[1]);
    scree_contact *contact = &b->contact[b->table.count++];
    *contact = (scree_contact){.first = first,
                               .second = second,
                               .normal = {branch[0] / length, branch[1] / length},
                               .tangent = {-branch[1] / length, branch[0] / length},
                               .branch = {branch[0], branch[1]},
                               .point = {j->x + branch[0] / 2, j->y + branch[1] / 2},
                               .normal_force = normal_force,
                               .tangential_force = tangential_force};
    b->state.sum[first].contacts++;
    b->state.sum[second].contacts++;
    return contact;
}

/// A contact of a body with a wall; the wall's resultants grow by it.
static void touch_wall(bench *b, uint32_t first, uint32_t wall, double normal_force, double tangential_force)
{
    scree_wall *w = &scree_plates(&b->state)[wall];
    const scree_row *i = &b->state.row[first];
    double distance = w->normal[0] * i->x + w->normal[1] * i->y - w->position;
    scree_contact *contact = &b->contact[b->table.count++];
    *contact = (scree_contact){.first = first,
                               .second = wall,
                               .wall = true,
                               .normal = {w->normal[0], w->normal[1]},
                               .tangent = {-w->normal[1], w->normal[0]},
                               .branch = {distance * w->normal[0], distance * w->normal[1]},
                               .point = {i->x - distance * w->normal[0], i->y - distance * w->normal[1]},
                               .normal_force = normal_force,
                               .tangential_force = tangential_force};
    w->force += normal_force;
    w->shear[0] += tangential_force * w->normal[1];
    w->shear[1] -= tangential_force * w->normal[0];
    b->state.sum[first].contacts++;
}

/// Adds the forces of the table to the sums, so that the resultants are known.
static void add_table_forces(bench *b)
{
    for (size_t c = 0; c < b->table.count; c++) {
        const scree_contact *contact = &b->contact[c];
        const double *n = contact->normal;
        double force[2] = {contact->normal_force * n[0] - contact->tangential_force * n[1],
                           contact->normal_force * n[1] + contact->tangential_force * n[0]};
        for (int side = 0; side < (contact->wall ? 1 : 2); side++) {
            scree_sum_row *sum = &b->state.sum[side ? contact->second : contact->first];
            sum->fx += llrint((side ? -1 : 1) * force[0] / b->state.force_quantum);
            sum->fy += llrint((side ? -1 : 1) * force[1] / b->state.force_quantum);
        }
    }
}

static double largest_resultant(const bench *b)
{
    double largest = 0;
    scree_vector force, torque;
    for (size_t i = 0; i < b->state.count; i++) {
        scree_body_force(&b->model, &b->state, i, force, torque);
        largest = fmax(largest, hypot(force[0], force[1]));
    }
    return largest;
}

/// 3 columns x 4 rows between plates, pressed on both sides, in equilibrium.
static void pressed_column(bench *b, double column_force)
{
    bench_create(b, 12);
    for (size_t i = 0; i < 12; i++) place(b, i, 2.0 * (double)(i % 3), 1 + 2.0 * (double)(i / 3));
    put_wall(b, SCREE_WALL_BOTTOM, 0);
    put_wall(b, SCREE_WALL_TOP, -8);
    scree_pressure_set(&b->state, PRESSURE);
    double row_force = PRESSURE * 2 * RADIUS * THICKNESS; // a row takes the pressure on its own height
    for (uint32_t row = 0; row < 4; row++)
        for (uint32_t column = 0; column < 3; column++) {
            uint32_t i = 3 * row + column;
            if (column < 2) touch(b, i, i + 1, row_force, 0);
            if (row < 3) touch(b, i, i + 3, column_force, 0);
        }
    for (uint32_t column = 0; column < 3; column++) {
        touch_wall(b, column, SCREE_WALL_BOTTOM, column_force, 0);
        touch_wall(b, 9 + column, SCREE_WALL_TOP, column_force, 0);
    }
    assert_int_equal(scree_boundary_refresh(&b->model, &b->state, NULL), SCREE_OK);
    scree_pressure_forces(&b->model, &b->state);
    add_table_forces(b);
}

static void stress_between_plates_under_pressure(void **user)
{
    (void)user;
    bench b;
    pressed_column(&b, 0.7);
    assert_true(largest_resultant(&b) < 1e-12 * 0.7); // the hand-made sample is in equilibrium
    double area = 4 * RADIUS * 8 * RADIUS, contacts[9], boundary[9], plates[9];
    assert_true(near(scree_sample_area(&b.state), area, 1e-14, area));
    assert_true(near(scree_loop_area(&b.state), 4 * 6 * RADIUS * RADIUS, 1e-14, area));
    scree_stress_from_contacts(&b.state, &b.table, area * THICKNESS, contacts);
    scree_stress_from_boundary(&b.model, &b.state, &b.table, boundary);
    scree_stress_from_plates(&b.model, &b.state, plates);
    double axial = -3 * 0.7 / (4 * RADIUS * THICKNESS);
    const double expected[9] = {-PRESSURE, 0, 0, 0, axial};
    for (int i = 0; i < 9; i++) {
        // Round-off of some thirty products.
        assert_true(near(contacts[i], expected[i], 1e-13, PRESSURE));
        assert_true(near(boundary[i], expected[i], 1e-13, PRESSURE));
        assert_true(near(plates[i], expected[i], 1e-13, PRESSURE));
    }
    scree_state_destroy(&b.state);
}

static void stress_without_pressure_is_not_a_number_where_nothing_acts(void **user)
{
    (void)user;
    bench b;
    pressed_column(&b, 0.7);
    double plates[9];
    scree_pressure_set(&b.state, 0);
    scree_stress_from_plates(&b.model, &b.state, plates);
    assert_true(isnan(plates[0]));
    assert_true(near(plates[4], -3 * 0.7 / (4 * RADIUS * THICKNESS), 1e-13, PRESSURE));
    scree_state_destroy(&b.state);
}

/// Three discs in a scalene triangle under pressure on all sides: by hand, the bars carry an isotropic stress.
static void stress_of_a_free_triangle(void **user)
{
    (void)user;
    bench b;
    bench_create(&b, 3);
    const double corner[3][2] = {{3, 4}, {5.1, 4.2}, {3.9, 5.9}};
    for (size_t i = 0; i < 3; i++) place(&b, i, corner[i][0], corner[i][1]);
    scree_pressure_set(&b.state, PRESSURE);
    assert_int_equal(scree_boundary_refresh(&b.model, &b.state, NULL), SCREE_OK);
    scree_pressure_forces(&b.model, &b.state);
    // Disc 0: bars to 1 and 2 balance the pressure force; disc 1 gives the third bar (2 equations, 2 unknowns each).
    double force[3][2];
    for (size_t i = 0; i < 3; i++) {
        scree_vector f, torque;
        scree_body_force(&b.model, &b.state, i, f, torque);
        force[i][0] = f[0];
        force[i][1] = f[1];
    }
    double bar[3]; // opposite to the disc of the same number
    for (uint32_t i = 0; i < 2; i++) {
        uint32_t j = (i + 1) % 3, k = (i + 2) % 3;
        double to_j[2] = {corner[i][0] - corner[j][0], corner[i][1] - corner[j][1]};
        double to_k[2] = {corner[i][0] - corner[k][0], corner[i][1] - corner[k][1]};
        double det = to_j[0] * to_k[1] - to_j[1] * to_k[0];
        bar[k] = -(force[i][0] * to_k[1] - force[i][1] * to_k[0]) / det * hypot(to_j[0], to_j[1]);
        bar[j] = -(to_j[0] * force[i][1] - to_j[1] * force[i][0]) / det * hypot(to_k[0], to_k[1]);
    }
    touch(&b, 0, 1, bar[2], 0);
    touch(&b, 0, 2, bar[1], 0);
    touch(&b, 1, 2, bar[0], 0);
    add_table_forces(&b);
    assert_true(largest_resultant(&b) < 1e-12 * PRESSURE * RADIUS * THICKNESS * 10);
    double stress[9], boundary[9], plates[9];
    scree_stress_from_contacts(&b.state, &b.table, scree_sample_area(&b.state) * THICKNESS, stress);
    scree_stress_from_boundary(&b.model, &b.state, &b.table, boundary);
    scree_stress_from_plates(&b.model, &b.state, plates);
    for (int i = 0; i < 9; i++) {
        double expected = i == 0 || i == 4 ? -PRESSURE : 0;
        assert_true(near(stress[i], expected, 1e-12, PRESSURE));
        assert_true(near(boundary[i], expected, 1e-12, PRESSURE));
        assert_true(near(plates[i], expected, 1e-12, PRESSURE));
    }
    scree_state_destroy(&b.state);
}

/// Any forces at all, out of equilibrium: contact stress = boundary stress - residual, an identity.
static void stress_differs_by_the_residual(void **user)
{
    (void)user;
    bench b;
    bench_create(&b, 40);
    for (size_t i = 0; i < 40; i++)
        place(&b, i, 2.0 * (double)(i % 5) + 0.4 * uniform(2 * i),
              1.2 + 2.0 * (double)(i / 5) + 0.4 * uniform(2 * i + 1));
    put_wall(&b, SCREE_WALL_BOTTOM, 0.2);
    put_wall(&b, SCREE_WALL_TOP, -16.5);
    scree_pressure_set(&b.state, PRESSURE);
    assert_int_equal(scree_boundary_refresh(&b.model, &b.state, NULL), SCREE_OK);
    scree_pressure_forces(&b.model, &b.state);
    for (uint32_t i = 0; i < 35; i++) touch(&b, i, i + 5, uniform(100 + i), uniform(200 + i) - 0.5);
    for (uint32_t i = 0; i < 39; i++) touch(&b, i, i + 1, uniform(300 + i), uniform(400 + i) - 0.5);
    for (uint32_t i = 0; i < 5; i++) touch_wall(&b, i, SCREE_WALL_BOTTOM, uniform(500 + i), uniform(600 + i) - 0.5);
    for (uint32_t i = 35; i < 40; i++) touch_wall(&b, i, SCREE_WALL_TOP, uniform(500 + i), uniform(600 + i) - 0.5);
    add_table_forces(&b);
    double volume = scree_sample_area(&b.state) * THICKNESS, contacts[9], boundary[9], plates[9], residual[9] = {0};
    double moved[9], total[3] = {0}, scale = 0;
    for (size_t i = 0; i < 40; i++) {
        scree_vector force, torque;
        double x[2] = {b.state.row[i].x, b.state.row[i].y};
        scree_body_force(&b.model, &b.state, i, force, torque);
        for (int k = 0; k < 4; k++) residual[3 * (k / 2) + k % 2] += force[k / 2] * x[k % 2] / volume;
        for (int k = 0; k < 2; k++) total[k] += force[k];
    }
    scree_stress_from_contacts(&b.state, &b.table, volume, contacts);
    scree_stress_from_boundary(&b.model, &b.state, &b.table, boundary);
    scree_stress_from_plates(&b.model, &b.state, plates);
    // The boundary stress is taken about the centre of the sample: found again from two states that differ in nothing
    // else.
    for (size_t i = 0; i < 40; i++) b.state.row[i].x += 3;
    for (size_t c = 0; c < b.table.count; c++) b.contact[c].point[0] += 3;
    scree_stress_from_boundary(&b.model, &b.state, &b.table, moved);
    for (int i = 0; i < 9; i++) scale = fmax(scale, fabs(contacts[i]));
    for (int i = 0; i < 9; i++) assert_true(near(moved[i], boundary[i], 1e-11, scale));
    // The centre from one component of each column; the other component then checks the identity.
    for (int j = 0; j < 2; j++) {
        double centre = (contacts[j] - boundary[j] + residual[j]) * volume / total[0];
        assert_true(
            near(contacts[3 + j], boundary[3 + j] - residual[3 + j] + total[1] * centre / volume, 1e-11, scale));
        assert_true(centre > 0 && centre < 20 * RADIUS);
    }
    // What the plates know: everything that has to do with their height.
    assert_true(near(plates[4], boundary[4], 1e-12, scale));
    assert_true(near(plates[1], boundary[1], 1e-12, scale));
    assert_true(plates[0] == -PRESSURE || near(plates[0], -PRESSURE, 1e-13, PRESSURE));
    scree_state_destroy(&b.state);
}

/// Largest difference of two 2 x 2 matrices; NAN if any.
static double distance(const double a[4], const double b[4])
{
    double largest = 0;
    for (int i = 0; i < 4; i++) largest = fabs(a[i] - b[i]) <= largest ? largest : fabs(a[i] - b[i]);
    return largest;
}

enum { CORNERS = 17 };

/// A star-shaped polygon away from the origin, and its displacement under x -> F x + c.
static void affine_polygon(const double f[4], uint64_t variant, double *x, double *y, double *ux, double *uy)
{
    for (int k = 0; k < CORNERS; k++) {
        double angle = 2 * M_PI * (k + 0.7 * uniform(700 + (uint64_t)k + 40 * variant)) / CORNERS;
        double r = 1 + 1.5 * uniform(900 + (uint64_t)k + 40 * variant);
        x[k] = 5 + r * cos(angle);
        y[k] = -7 + r * sin(angle);
        ux[k] = f[0] * x[k] + f[1] * y[k] + 0.3 - x[k];
        uy[k] = f[2] * x[k] + f[3] * y[k] - 0.2 - y[k];
    }
}

static double polygon_area(const double *x, const double *y)
{
    double area = 0;
    for (int k = 0; k < CORNERS; k++) area += (x[k] * y[(k + 1) % CORNERS] - y[k] * x[(k + 1) % CORNERS]) / 2;
    return area;
}

static void strain_of_affine_maps(void **user)
{
    (void)user;
    double x[CORNERS], y[CORNERS], ux[CORNERS], uy[CORNERS], g[4];
    for (uint64_t variant = 0; variant < 50; variant++) {
        double f[4];
        for (uint64_t i = 0; i < 4; i++)
            f[i] = (i == 0 || i == 3 ? 1 : 0) + 0.8 * (uniform(1500 + 4 * variant + i) - 0.5);
        affine_polygon(f, variant, x, y, ux, uy);
        scree_loop_gradient(x, y, ux, uy, CORNERS, g);
        // 2 (F - 1)(F + 1)^-1
        double p[4] = {f[0] + 1, f[1], f[2], f[3] + 1}, m[4] = {f[0] - 1, f[1], f[2], f[3] - 1};
        double det = p[0] * p[3] - p[1] * p[2];
        double expected[4] = {2 * (m[0] * p[3] - m[1] * p[2]) / det, 2 * (m[1] * p[0] - m[0] * p[1]) / det,
                              2 * (m[2] * p[3] - m[3] * p[2]) / det, 2 * (m[3] * p[0] - m[2] * p[1]) / det};
        assert_true(distance(g, expected) < 1e-12);
        // Trace: the area change over the area half way.
        double half_x[CORNERS], half_y[CORNERS], new_x[CORNERS], new_y[CORNERS];
        for (int k = 0; k < CORNERS; k++) {
            half_x[k] = x[k] + ux[k] / 2;
            half_y[k] = y[k] + uy[k] / 2;
            new_x[k] = x[k] + ux[k];
            new_y[k] = y[k] + uy[k];
        }
        double change = (polygon_area(new_x, new_y) - polygon_area(x, y)) / polygon_area(half_x, half_y);
        assert_true(fabs(g[0] + g[3] - change) < 1e-12);
    }
}

static void strain_of_rotations_and_sequences(void **user)
{
    (void)user;
    double x[CORNERS], y[CORNERS], ux[CORNERS], uy[CORNERS], g[4];
    double angle = 0.3, turn[4] = {cos(angle), -sin(angle), sin(angle), cos(angle)};
    affine_polygon(turn, 0, x, y, ux, uy);
    scree_loop_gradient(x, y, ux, uy, CORNERS, g);
    assert_true(distance(g, (double[4]){0, -2 * tan(angle / 2), 2 * tan(angle / 2), 0}) < 1e-13);

    // Two steps of the same stretch against both at once: equal to third order, both near the logarithm.
    double step = 0.01, once[4] = {1 + step, 0, 0, 1 - step}, g_once[4], g_twice[4];
    double twice[4] = {once[0] * once[0], 0, 0, once[3] * once[3]};
    affine_polygon(once, 1, x, y, ux, uy);
    scree_loop_gradient(x, y, ux, uy, CORNERS, g_once);
    affine_polygon(twice, 1, x, y, ux, uy);
    scree_loop_gradient(x, y, ux, uy, CORNERS, g_twice);
    assert_true(fabs(2 * g_once[0] - g_twice[0]) < pow(2 * step, 3) / 12 && fabs(2 * g_once[0] - g_twice[0]) > 0);
    assert_true(fabs(2 * g_once[0] - 2 * log(1 + step)) < 2.1 * pow(step, 3) / 12);
    assert_true(fabs(2 * g_once[3] - 2 * log(1 - step)) < 2.1 * pow(step, 3) / 12);

    // Small ones superpose.
    double a[4] = {1 + 1e-6, 2e-6, -1e-6, 1 + 3e-6}, b[4] = {1 - 2e-6, 1e-6, 4e-6, 1 + 1e-6}, ga[4], gb[4], gab[4],
           sum[4];
    double ab[4] = {a[0] + b[0] - 1, a[1] + b[1], a[2] + b[2], a[3] + b[3] - 1};
    affine_polygon(a, 2, x, y, ux, uy);
    scree_loop_gradient(x, y, ux, uy, CORNERS, ga);
    affine_polygon(b, 2, x, y, ux, uy);
    scree_loop_gradient(x, y, ux, uy, CORNERS, gb);
    affine_polygon(ab, 2, x, y, ux, uy);
    scree_loop_gradient(x, y, ux, uy, CORNERS, gab);
    for (int i = 0; i < 4; i++) sum[i] = ga[i] + gb[i];
    assert_true(distance(sum, gab) < 1e-10); // second order: a few times (4e-6)^2
}

static void coordination_and_rattlers(void **user)
{
    (void)user;
    // A square of four, a chain of two hanging on it, a loner, and a body on the plate only.
    bench b;
    bench_create(&b, 8);
    for (size_t i = 0; i < 8; i++) place(&b, i, 2.0 * (double)(i % 4), 2.0 * (double)(i / 4));
    touch(&b, 0, 1, 1, 0);
    touch(&b, 0, 4, 1, 0);
    touch(&b, 1, 5, 1, 0);
    touch(&b, 4, 5, 1, 0);
    touch(&b, 1, 2, 1, 0);
    touch(&b, 2, 3, 1, 0);
    touch_wall(&b, 6, SCREE_WALL_BOTTOM, 1, 0);
    touch_wall(&b, 0, SCREE_WALL_BOTTOM, 1, 0);
    scree_coordination c;
    assert_int_equal(scree_coordination_measure(&b.model, &b.state, NULL, &b.table, &c, NULL), SCREE_OK);
    assert_true(near(c.mean, 14.0 / 8, 1e-15, 1));
    assert_true(near(c.rattler_fraction, 0.5, 1e-15, 1));
    assert_true(near(c.mean_without_rattlers, 9.0 / 4, 1e-15, 1));
    // Without friction three supports are needed, and nothing holds.
    b.model.pairs[0][0].value[SCREE_FRICTION] = 0;
    assert_int_equal(scree_coordination_measure(&b.model, &b.state, NULL, &b.table, &c, NULL), SCREE_OK);
    assert_true(c.rattler_fraction == 1 && c.mean_without_rattlers == 0);
    // The pressure supports the loner and the end of the chain, not more.
    b.model.pairs[0][0].value[SCREE_FRICTION] = 0.5;
    uint32_t id[3] = {3, 6, 7};
    uint8_t loaded[3] = {1, 0, 1};
    scree_loop_of(&b.state)->id = id;
    scree_loop_of(&b.state)->loaded = loaded;
    scree_loop_of(&b.state)->count = 3;
    scree_pressure_set(&b.state, PRESSURE);
    assert_int_equal(scree_coordination_measure(&b.model, &b.state, NULL, &b.table, &c, NULL), SCREE_OK);
    assert_true(near(c.rattler_fraction, 1.0 / 8, 1e-15, 1));
    for (uint64_t n = 1; n <= 3; n++) {
        scree_allocation_fail_after(n);
        assert_int_equal(scree_coordination_measure(&b.model, &b.state, NULL, &b.table, &c, NULL), SCREE_ERROR_IO);
    }
    scree_allocation_fail_after(0);
    *scree_loop_of(&b.state) = (scree_loop){0};
    scree_state_destroy(&b.state);
}

static void slip_and_unbalanced_force(void **user)
{
    (void)user;
    bench b;
    bench_create(&b, 4);
    for (size_t i = 0; i < 4; i++) place(&b, i, 2.0 * (double)i, 0);
    double slip, sliding;
    scree_slip_measure(&b.state, &b.table, &slip, &sliding);
    assert_true(slip == 0 && sliding == 0);
    assert_true(isnan(scree_unbalanced_ratio(&b.model, &b.state, &b.table)));
    touch(&b, 0, 1, 3, 4)->slip = -2e-6;
    touch(&b, 1, 2, 5, 0)->slip = 1e-6;
    b.contact[0].sliding = true;
    touch_wall(&b, 0, SCREE_WALL_LEFT, 8, 6);
    b.contact[2].slip = 100;
    scree_slip_measure(&b.state, &b.table, &slip, &sliding);
    assert_true(near(slip, 1.5e-6, 1e-15, 1e-6));
    assert_true(near(sliding, 0.5, 1e-15, 1));
    // Resultants of 3, 4 and 0 on the three bodies that touch, a falling rattler left out; contact forces 5, 5 and 10.
    b.state.sum[0].fx = llrint(3 / b.state.force_quantum);
    b.state.sum[1].fy = llrint(-4 / b.state.force_quantum);
    b.state.sum[3].fy = llrint(-50 / b.state.force_quantum);
    assert_true(near(scree_unbalanced_ratio(&b.model, &b.state, &b.table), (7.0 / 3) / (20.0 / 3), 1e-14, 1));
    scree_state_destroy(&b.state);
}

static double solid_fraction(const scree_state *state)
{
    double fraction;
    assert_int_equal(scree_solid_fraction(state, &fraction, NULL), SCREE_OK);
    return fraction;
}

static void solid_fraction_of_lattices(void **user)
{
    (void)user;
    bench b;
    bench_create(&b, 30);
    assert_true(isnan(solid_fraction(&b.state)));
    for (size_t i = 0; i < 30; i++) place(&b, i, 2.0 * (double)(i % 5), 2.0 * (double)(i / 5));
    assert_int_equal(scree_boundary_refresh(&b.model, &b.state, NULL), SCREE_OK);
    assert_true(near(solid_fraction(&b.state), M_PI / 4, 1e-14, 1));
    scree_state_destroy(&b.state);
    bench_create(&b, 30);
    b.model.upkeep.gap_limit = 2; // straight sides would do as well: partial discs only at the vertices
    for (size_t i = 0; i < 30; i++) place(&b, i, 2.0 * (double)(i % 5) + (double)(i / 5), sqrt(3.0) * (double)(i / 5));
    assert_int_equal(scree_boundary_refresh(&b.model, &b.state, NULL), SCREE_OK);
    assert_true(near(solid_fraction(&b.state), M_PI / sqrt(12.0), 1e-14, 1));
    scree_state_destroy(&b.state);
}

static void areas_and_boxes(void **user)
{
    (void)user;
    bench b;
    bench_create(&b, 12);
    for (size_t i = 0; i < 12; i++) place(&b, i, 2.0 * (double)(i % 3), 2.0 * (double)(i / 3));
    put_wall(&b, SCREE_WALL_BOTTOM, -1);
    put_wall(&b, SCREE_WALL_TOP, -7);
    put_wall(&b, SCREE_WALL_LEFT, -1.5);
    put_wall(&b, SCREE_WALL_RIGHT, -5.5);
    double unit = RADIUS * RADIUS;
    assert_true(near(scree_sample_area(&b.state), 7 * 8 * unit, 1e-14, unit * 56)); // no loop yet: the box
    assert_int_equal(scree_boundary_refresh(&b.model, &b.state, NULL), SCREE_OK);
    assert_true(near(scree_sample_area(&b.state), 7 * 8 * unit, 1e-14, unit * 56));
    scree_plates(&b.state)[SCREE_WALL_LEFT].active = scree_plates(&b.state)[SCREE_WALL_RIGHT].active = 0;
    scree_loop_of(&b.state)->count = 0;
    assert_int_equal(scree_boundary_refresh(&b.model, &b.state, NULL), SCREE_OK);
    assert_true(near(scree_sample_area(&b.state), 4 * 8 * unit, 1e-14, unit * 56));
    scree_plates(&b.state)[SCREE_WALL_TOP].active = 0;
    scree_loop_of(&b.state)->count = 0;
    assert_int_equal(scree_boundary_refresh(&b.model, &b.state, NULL), SCREE_OK);
    assert_true(near(scree_sample_area(&b.state), 4 * 7 * unit, 1e-14, unit * 56));
    scree_state_destroy(&b.state);
}

/// An oscillator: two discs on a linear spring of the test's own. The discrete energy is that of the trapezoid.
static void kinetic_energy_is_the_discrete_one(void **user)
{
    (void)user;
    for (int scheme = SCREE_SLOT_position_verlet; scheme <= SCREE_SLOT_velocity_verlet; scheme++) {
        bench b;
        bench_create(&b, 1);
        b.model.scheme = scheme;
        b.model.gravity[1] = -9.81;
        scree_row *row = &b.state.row[0];
        *row = (scree_row){.radius = 0.5, .mass = 2, .vx = 3, .vy = 1, .spin = 4, .y = 10};
        b.state.step_size = 0.1;
        b.state.sum[0].fx = llrint(5 / b.state.force_quantum);
        b.state.sum[0].torque = llrint(0.5 / b.state.torque_quantum);
        scree_energy energy;
        scree_energy_measure(&b.model, &b.state, &b.table, &energy);
        // v(n-1/2) and v(n+1/2) = v(n-1/2) + 0.1 a, a = (2.5, -9.81), angular 0.5 / 0.25 = 2.
        double lead = scheme == SCREE_SLOT_position_verlet ? 0 : 0.05;
        double u = 3 - lead * 2.5, v = 1 + lead * 9.81, w = 4 - lead * 2;
        assert_true(near(energy.kinetic, u * (u + 0.25) + v * (v - 0.981), 1e-13, 10));
        assert_true(near(energy.kinetic_rotation, 0.5 * 0.25 * w * (w + 0.2), 1e-13, 10));
        assert_true(near(energy.gravity, -2 * 9.81 * 10, 1e-14, 200));
        scree_state_destroy(&b.state);
    }
}

static void every_term_of_the_balance_has_its_sign(void **user)
{
    (void)user;
    bench b;
    bench_create(&b, 2);
    b.model.gravity[1] = -10;
    place(&b, 1, 2, 0);
    b.state.row[0].vx = 1;  // 0.5 mJ
    b.state.row[1].y = 0.2; // potential energy 2 mJ less than when the ledger was opened
    scree_contact *contact = touch(&b, 0, 1, 0, 0);
    contact->elastic_normal = 3e-3;
    contact->elastic_tangential = 1e-3;
    b.state.step_size = 0;
    b.state.ledger = (scree_ledger){.initial = 1e-3,
                                    .plates = 5e-3,
                                    .pressure = 1e-3,
                                    .damping = 2e-3,
                                    .friction = 4e-3,
                                    .stiffness = 0.5e-3,
                                    .gravity = -4e-3,
                                    .turnover = 0.1};
    scree_energy energy;
    scree_energy_measure(&b.model, &b.state, &b.table, &energy);
    assert_true(near(energy.gravity, 2e-3, 1e-13, 1e-3));
    // Stored 4.5 - 1 = 3.5; put in 5 + 1 + 2 = 8; lost 6; given by the stiffness 0.5: 3.5 - 8 + 6 - 0.5 = 1.
    assert_true(near(energy.residual, 1e-3, 1e-12, 1e-3));
    // Over the energy at the begin, what was turned over, the work of gravity, and what is stored.
    assert_true(near(energy.scale, 1e-3 + 0.1 + 2e-3 + 4.5e-3, 1e-12, 0.1));
    assert_true(near(energy.relative, 1e-3 / energy.scale, 1e-12, 1e-2));
    scree_state_destroy(&b.state);
}

static void fluctuations_about_an_affine_field(void **user)
{
    (void)user;
    enum { COUNT = 200 };
    double x0[COUNT], y0[COUNT], x1[COUNT], y1[COUNT], fx[COUNT], fy[COUNT], g[4];
    const double f[4] = {0.02, -0.01, 0.03, -0.05}, *const from[2] = {x0, y0}, *const to[2] = {x1, y1};
    double *const fluctuation[2] = {fx, fy};
    for (uint64_t i = 0; i < COUNT; i++) {
        x0[i] = 4 + uniform(3000 + 2 * i);
        y0[i] = -2 + 2 * uniform(3001 + 2 * i);
        x1[i] = x0[i] + 0.1 + f[0] * x0[i] + f[1] * y0[i];
        y1[i] = y0[i] - 0.3 + f[2] * x0[i] + f[3] * y0[i];
    }
    assert_true(scree_fluctuations(2, from, to, COUNT, fluctuation, g) < 1e-14);
    assert_true(distance(g, f) < 1e-13);
    // One body out of step: the fit hardly notices, the body does.
    x1[7] += 0.5;
    double rms = scree_fluctuations(2, from, to, COUNT, fluctuation, g);
    assert_true(fabs(fx[7] - 0.5) < 0.02 && fabs(fy[7]) < 1e-12);
    assert_true(fabs(rms - 0.5 / sqrt(COUNT)) < 0.02 / sqrt(COUNT));
    // The residual of a least-squares fit is orthogonal to what it fits.
    double normal[6] = {0};
    for (int i = 0; i < COUNT; i++) {
        normal[0] += fx[i];
        normal[1] += fx[i] * x0[i];
        normal[2] += fx[i] * y0[i];
        normal[3] += fy[i];
        normal[4] += fy[i] * x0[i];
        normal[5] += fy[i] * y0[i];
    }
    for (int i = 0; i < 6; i++) assert_true(fabs(normal[i]) < 1e-11);
    // On a line: no gradient, the mean displacement goes.
    for (int i = 0; i < COUNT; i++) y0[i] = 2 * x0[i];
    (void)scree_fluctuations(2, from, to, COUNT, fluctuation, g);
    for (int i = 0; i < 4; i++) assert_true(g[i] == 0);
    assert_true(scree_fluctuations(2, from, to, 0, fluctuation, g) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stress_between_plates_under_pressure),
        cmocka_unit_test(stress_without_pressure_is_not_a_number_where_nothing_acts),
        cmocka_unit_test(stress_of_a_free_triangle),
        cmocka_unit_test(stress_differs_by_the_residual),
        cmocka_unit_test(strain_of_affine_maps),
        cmocka_unit_test(strain_of_rotations_and_sequences),
        cmocka_unit_test(coordination_and_rattlers),
        cmocka_unit_test(slip_and_unbalanced_force),
        cmocka_unit_test(solid_fraction_of_lattices),
        cmocka_unit_test(areas_and_boxes),
        cmocka_unit_test(kinetic_energy_is_the_discrete_one),
        cmocka_unit_test(every_term_of_the_balance_has_its_sign),
        cmocka_unit_test(fluctuations_about_an_affine_field),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
