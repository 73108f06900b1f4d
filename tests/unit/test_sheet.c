/// Membrane of spheres around a solid sample: its net, placement, pressure, springs, ends, what it is left out of.
#include "boundary/membrane.h"
#include "boundary_fixture.h"
#include "measure/delaunay_boundary.h"
#include "state/plates.h"

#include "boundary/sheet.h"
#include "measure/hull.h"
#include "search/neighbours.h"
#include "state/pressure.h"
#include "state_bits.h"

#include <stdlib.h>

#define SHEET 0.5625e-3
#define STEP  1e-5

enum { SIDE = 5, LEVELS = 9 };

/// Grains (all zero) that will get a membrane, between plates `height` apart.
static void plates_create(bench *b, size_t count, double height)
{
    bench_begin(b, 3, count, STEP);
    bench_predict_membrane(b, SHEET);
    scree_plates(&b->state)[SCREE_WALL_TOP].position = -height;
    scree_plates(&b->state)[SCREE_WALL_BOTTOM].active = scree_plates(&b->state)[SCREE_WALL_TOP].active = 1;
}

/// An uneven block of grains in its membrane.
static void bench_create(bench *b)
{
    scree_error error;
    plates_create(b, SIDE * SIDE * LEVELS, 0);
    bench_fill(b, SIDE, true);
    check(scree_membrane_place(&b->model, &b->state, &error), &error);
}

/// A regular tube of equilateral triangles of edge `edge` as far as the curvature lets them, without grains; unstressed
/// where it stands.
static void tube_create(bench *b, size_t around, size_t rings, double edge)
{
    double radius = edge / (2 * sin(M_PI / (double)around)), across = 2 * radius * sin(M_PI / (2 * (double)around));
    double rise = sqrt(edge * edge - across * across);
    plates_create(b, 0, 2 * SHEET + rise * (double)(rings - 1));
    scree_state *state = &b->state;
    assert_int_equal(scree_membrane_make_room(state, around * rings, NULL), SCREE_OK);
    scree_membrane_of(state)->radius = SHEET;
    scree_membrane_of(state)->around = around;
    for (size_t k = 0; k < around * rings; k++) {
        double angle = 2 * M_PI / (double)around * ((double)(k % around) + 0.5 * (double)(k / around % 2));
        *member(b, k) = (scree_row){.x = radius * cos(angle),
                                    .y = radius * sin(angle),
                                    .z = SHEET + rise * (double)(k / around),
                                    .radius = SHEET,
                                    .mass = scree_model_mass(&b->model, 1, SHEET)};
        for (int s = 0; s < SCREE_SHEET_SPRINGS; s++)
            if (scree_sheet_neighbour(around, around * rings, k, s) != SIZE_MAX)
                scree_membrane_of(state)->rest[k][s] = edge;
    }
}

static double distance(bench *b, size_t i, size_t j)
{
    const scree_row *p = member(b, i), *q = member(b, j);
    return sqrt((p->x - q->x) * (p->x - q->x) + (p->y - q->y) * (p->y - q->y) + (p->z - q->z) * (p->z - q->z));
}

/// Every edge inside has a triangle on either side, in opposite senses, and one spring; rims have one triangle.
static void the_net_is_a_tube(void **unused)
{
    (void)unused;
    enum { AROUND = 7, COUNT = 5 * AROUND };
    int used[COUNT][COUNT] = {0}, springs[COUNT][COUNT] = {0};
    size_t triangles = scree_sheet_triangle_count(AROUND, COUNT), edges = 0;
    for (size_t t = 0; t < triangles; t++) {
        size_t corner[3];
        scree_sheet_triangle(AROUND, COUNT, t, corner);
        for (int c = 0; c < 3; c++) used[corner[c]][corner[(c + 1) % 3]]++;
    }
    for (size_t k = 0; k < COUNT; k++)
        for (int s = 0; s < SCREE_SHEET_SPRINGS; s++) {
            size_t other = scree_sheet_neighbour(AROUND, COUNT, k, s);
            if (other == SIZE_MAX) continue;
            springs[k][other]++;
            edges++;
        }
    assert_int_equal(COUNT + triangles, edges); // Euler's number of a tube is 0
    for (size_t i = 0; i < COUNT; i++)
        for (size_t j = 0; j < COUNT; j++) {
            assert_true(used[i][j] <= 1);
            bool rim = i / AROUND == j / AROUND && (i / AROUND == 0 || i / AROUND == 4);
            if (used[i][j]) assert_true(used[j][i] || rim);
            if (used[i][j]) assert_int_equal(springs[i][j] + springs[j][i], 1);
        }
}

/// Solid angle of the tube and its two caps about a point, over 4 pi: 1 inside, 0 outside.
static double winding(bench *b, const double point[3])
{
    scree_state *state = &b->state;
    size_t around = scree_membrane_of(state)->around, count = scree_membrane_of(state)->count;
    size_t triangles = scree_sheet_triangle_count(around, count);
    double sum = 0;
    for (size_t t = 0; t < triangles + 2 * (around - 2); t++) {
        size_t corner[3], cap = t - triangles;
        if (t < triangles)
            scree_sheet_triangle(around, count, t, corner);
        else if (cap < around - 2)
            corner[0] = 0, corner[1] = cap + 2, corner[2] = cap + 1;
        else
            cap -= around - 2, corner[0] = count - around, corner[1] = corner[0] + cap + 1, corner[2] = corner[1] + 1;
        double v[3][3], length[3], product[3];
        for (int c = 0; c < 3; c++) {
            const scree_row *m = member(b, corner[c]);
            // Caps at the plates: no grain is below a rim.
            int plate = scree_membrane_plate(state, corner[c]);
            double z = plate < 0 ? m->z : scree_plate_height(state, plate);
            v[c][0] = m->x - point[0], v[c][1] = m->y - point[1], v[c][2] = z - point[2];
            length[c] = scree_length(v[c]);
        }
        for (int k = 0; k < 3; k++)
            product[k] = v[1][(k + 1) % 3] * v[2][(k + 2) % 3] - v[1][(k + 2) % 3] * v[2][(k + 1) % 3];
        double triple = 0, below = length[0] * length[1] * length[2];
        for (int k = 0; k < 3; k++) {
            triple += v[0][k] * product[k];
            below += v[0][k] * v[1][k] * length[2] + v[1][k] * v[2][k] * length[0] + v[2][k] * v[0][k] * length[1];
        }
        sum += 2 * atan2(triple, below);
    }
    return sum / (4 * M_PI);
}

static void it_wraps_the_grains_without_pressing(void **unused)
{
    (void)unused;
    bench b;
    bench_create(&b);
    scree_state *state = &b.state;
    size_t count = scree_membrane_of(state)->count, around = scree_membrane_of(state)->around, touching = 0, inside = 0;
    assert_int_equal(scree_grain_count(state), SIDE * SIDE * LEVELS);
    assert_int_equal(state->count, scree_grain_count(state) + count);
    double low = scree_plates(state)[SCREE_WALL_BOTTOM].position, high = -scree_plates(state)[SCREE_WALL_TOP].position;
    for (size_t k = 0; k < count; k++) {
        const scree_row *m = member(&b, k);
        double gap = INFINITY;
        for (size_t i = 0; i < scree_grain_count(state); i++) {
            const scree_row *g = &state->row[state->row_of_id[i]];
            double apart = hypot(hypot(m->x - g->x, m->y - g->y), m->z - g->z);
            gap = fmin(gap, apart - m->radius - g->radius);
        }
        assert_true(gap > -1e-14); // round-off of 0.02 m and its squares
        touching += gap < 1e-14;
        assert_int_equal(scree_body_material(state, scree_membrane_row(state, k)), 1);
        assert_true(m->radius == SHEET && m->mass > 0);
        if (k < around) assert_true(fabs(m->z - low - SHEET) < 1e-15);
        if (k >= count - around) assert_true(fabs(m->z - high + SHEET) < 1e-15);
        for (int s = 0; s < SCREE_SHEET_SPRINGS; s++) {
            size_t other = scree_sheet_neighbour(around, count, k, s);
            double rest = other == SIZE_MAX ? 0 : distance(&b, k, other);
            assert_true(fabs(scree_membrane_of(state)->rest[k][s] - rest) < 1e-15);
            // On the outline at most two radii apart; pushed in, one more radius a spacing.
            assert_true(rest <= 2.3 * SHEET);
        }
    }
    assert_true(touching > count / 3);
    for (size_t i = 0; i < scree_grain_count(state); i++) {
        const scree_row *g = &state->row[state->row_of_id[i]];
        const double point[3] = {g->x, g->y, g->z};
        inside += fabs(winding(&b, point) - 1) < 1e-9;
    }
    assert_int_equal(inside, scree_grain_count(state));
    assert_true(scree_sheet_hole(state) < 0.5 * SHEET);
    assert_true(scree_membrane_energy(&b.model, state) < 1e-20);
    assert_true(scree_membrane_volume(&b.model, state) > scree_hull_volume(state));
    scree_state_destroy(state);
}

/// Net forces as integers, and forces as the derivative of the volume, of a crumpled tube.
static void pressure_is_the_derivative_of_the_volume(void **unused)
{
    (void)unused;
    bench b;
    tube_create(&b, 12, 6, 2 * SHEET);
    scree_state *state = &b.state;
    size_t count = scree_membrane_of(state)->count, around = 12;
    ((scree_membrane_numbers *)scree_model_reserve_numbers(&b.model, SCREE_SLOT_membrane))->stiffness = 0;
    // A regular tube, by the rule of prismatoids: sections are 12-gons at the rings, 24-gons half way.
    double radius = hypot(member(&b, 0)->x, member(&b, 0)->y), rise = member(&b, around)->z - SHEET;
    double section = 6 * radius * radius * sin(M_PI / 6);
    double middle = 12 * pow(radius * cos(M_PI / 24), 2) * sin(M_PI / 12);
    double volume = 5 * rise / 6 * (2 * section + 4 * middle) + 2 * SHEET * section;
    assert_true(fabs(scree_membrane_volume(&b.model, state) - volume) < 1e-14 * volume);
    double direction[72][3], scale = 1e-4 * SHEET, values[2];
    for (size_t k = 0; k < count; k++) {
        scree_row *m = member(&b, k);
        bool end = scree_membrane_plate(state, k) >= 0;
        m->x += 0.5 * SHEET * uniform(10 * k);
        m->y += 0.5 * SHEET * uniform(10 * k + 1);
        if (!end) m->z += 0.5 * SHEET * uniform(10 * k + 2);
        for (int i = 0; i < 3; i++)
            direction[k][i] = end && i == 2 ? 0 : scale * (uniform(10 * k + 3 + (uint64_t)i) - 0.5);
    }
    membrane_forces(&b);
    int64_t total[3] = {0};
    double work = 0, size = 0, vertical = 0, areas[2] = {0};
    for (size_t k = 0; k < count; k++) {
        const double *press = scree_membrane_of(state)->press[k];
        const scree_sum_row *sum = &state->sum[scree_membrane_row(state, k)];
        total[0] += sum->fx;
        total[1] += sum->fy;
        vertical += press[2];
        for (int i = 0; i < 3; i++) work += press[i] * direction[k][i];
        for (int i = 0; i < 3; i++) size += fabs(press[i] * direction[k][i]);
    }
    assert_int_equal(total[0], 0);
    assert_int_equal(total[1], 0);
    for (int sign = 0; sign < 2; sign++) {
        for (size_t k = 0; k < count; k++) {
            scree_row *m = member(&b, k);
            double step = sign == 0 ? 1 : -2;
            m->x += step * direction[k][0], m->y += step * direction[k][1], m->z += step * direction[k][2];
        }
        values[sign] = scree_membrane_volume(&b.model, state);
    }
    // The volume is a cubic polynomial: third order in steps of 1e-4, and round-off over them.
    double expected = -PRESSURE * (values[0] - values[1]) / 2;
    assert_true(fabs(expected) > 0.01 * size);
    assert_true(fabs(work - expected) < 1e-7 * size);
    // What the plates bear: p times the difference of the areas inside the rims.
    for (size_t k = 0; k < count; k++) {
        scree_row *m = member(&b, k);
        m->x += direction[k][0], m->y += direction[k][1];
    }
    for (size_t j = 0; j < around; j++)
        for (int rim = 0; rim < 2; rim++) {
            const scree_row *p = member(&b, rim ? count - around + j : j);
            const scree_row *q = member(&b, rim ? count - around + (j + 1) % around : (j + 1) % around);
            areas[rim] += 0.5 * (p->x * q->y - p->y * q->x);
        }
    double bearing = PRESSURE * (areas[1] - areas[0]);
    assert_true(fabs(vertical - bearing) < 1e-12 * PRESSURE * areas[0] && fabs(bearing) > 1e-3 * PRESSURE * areas[0]);
    scree_state_destroy(state);
}

/// Uniform stretch of a tube against the continuum of a triangular net of springs, lambda = mu = 3 Y / 8.
static void the_sheet_has_its_stiffness(void **unused)
{
    (void)unused;
    enum { AROUND = 60, RINGS = 9 };
    static const double strain[3][2] = {{1e-4, 1e-4}, {1e-4, 0}, {2e-5, 1e-4}}; // around, along
    for (int n = 0; n < 3; n++) {
        bench b;
        tube_create(&b, AROUND, RINGS, 2 * SHEET);
        double sheet = 2 / sqrt(3) * scree_membrane_numbers_of(&b.model)->stiffness;
        double radius = hypot(member(&b, 0)->x, member(&b, 0)->y);
        double length = member(&b, scree_membrane_of(&b.state)->count - 1)->z - member(&b, 0)->z;
        assert_true(scree_membrane_energy(&b.model, &b.state) < 1e-18);
        for (size_t k = 0; k < scree_membrane_of(&b.state)->count; k++) {
            member(&b, k)->x *= 1 + strain[n][0];
            member(&b, k)->y *= 1 + strain[n][0];
            member(&b, k)->z *= 1 + strain[n][1];
        }
        double lame = 3 * sheet / 8, sum = strain[n][0] + strain[n][1];
        double squares = strain[n][0] * strain[n][0] + strain[n][1] * strain[n][1];
        double expected = 2 * M_PI * radius * length * lame * (0.5 * sum * sum + squares);
        double energy = scree_membrane_energy(&b.model, &b.state);
        print_message("strain %g %g: energy over that of the sheet %.6f\n", strain[n][0], strain[n][1],
                      energy / expected);
        // Curvature: chords and their angles differ by (pi / 60)^2 / 2 = 1.4e-3 at most; strains are 1e-4.
        assert_true(fabs(energy / expected - 1) < 1.6e-3);
        // Without tension nothing is stored.
        for (size_t k = 0; k < scree_membrane_of(&b.state)->count; k++)
            member(&b, k)->x *= 0.99, member(&b, k)->y *= 0.99, member(&b, k)->z *= 0.99;
        assert_true(scree_membrane_energy(&b.model, &b.state) == 0);
        scree_state_destroy(&b.state);
    }
}

/// One step of the tube alone; `keep` of each velocity stays.
static void tube_step(bench *b, double keep)
{
    scree_state *state = &b->state;
    for (size_t k = 0; k < scree_membrane_of(state)->count; k++) {
        scree_row *m = member(b, k);
        const scree_sum_row *sum = &state->sum[scree_membrane_row(state, k)];
        m->vx = keep * m->vx + state->step_size * (double)sum->fx * QUANTUM / m->mass;
        m->vy = keep * m->vy + state->step_size * (double)sum->fy * QUANTUM / m->mass;
        m->vz = keep * m->vz + state->step_size * (double)sum->fz * QUANTUM / m->mass;
        m->x += state->step_size * m->vx;
        m->y += state->step_size * m->vy;
        m->z += state->step_size * m->vz;
    }
    boundary_follow(scree_module_membrane.boundary, &b->model, state);
    membrane_forces(b);
}

/// A tube that has come to rest under its pressure: the force through a section along the axis is p x radius x length.
static void hoop_tension_carries_the_pressure(void **unused)
{
    (void)unused;
    enum { AROUND = 40, RINGS = 7 };
    bench b;
    tube_create(&b, AROUND, RINGS, 2 * SHEET);
    scree_state *state = &b.state;
    scree_pressure_set(state, -1e4); // from inside: the springs only pull
    state->step_size = b.work.next_kick = 1e-3;
    membrane_forces(&b);
    for (int step = 0; step < 4000; step++) tube_step(&b, 0.97);
    double residual = 0, through = 0, radius = 0, angle = 0.3 * 2 * M_PI / AROUND;
    for (size_t k = 0; k < scree_membrane_of(state)->count; k++) {
        const scree_row *m = member(&b, k);
        const scree_sum_row *sum = &state->sum[scree_membrane_row(state, k)];
        residual = fmax(residual, hypot((double)sum->fx, (double)sum->fy) * QUANTUM);
        radius += hypot(m->x, m->y) / (double)scree_membrane_of(state)->count;
        for (int s = 0; s < SCREE_SHEET_SPRINGS; s++) {
            size_t other = scree_sheet_neighbour(AROUND, scree_membrane_of(state)->count, k, s);
            if (other == SIZE_MAX) continue;
            const scree_row *o = member(&b, other);
            double at[2] = {cos(angle) * m->y - sin(angle) * m->x, cos(angle) * o->y - sin(angle) * o->x};
            if (at[0] * at[1] > 0 || m->x * cos(angle) + m->y * sin(angle) < 0) continue;
            bool rim = s == 0 && scree_membrane_plate(state, k) >= 0;
            double force =
                (rim ? 0.5 : 1) * STIFFNESS * (distance(&b, k, other) - scree_membrane_of(state)->rest[k][s]);
            if (force > 0) through += force * fabs(at[1] - at[0]) / distance(&b, k, other);
        }
    }
    double height = -scree_plates(state)[SCREE_WALL_TOP].position, expected = 1e4 * radius * height;
    print_message("hoop tension over p R: %.5f, largest resultant over the load of a body %.2g\n", through / expected,
                  residual / (1e4 * 4 * SHEET * SHEET));
    assert_true(residual < 1e-6 * 1e4 * 4 * SHEET * SHEET);
    // A polygon instead of a circle: (pi / 40)^2 / 2 = 3e-3; and the mean radius instead of that at each height.
    assert_true(fabs(through / expected - 1) < 5e-3);
    scree_state_destroy(state);
}

static void springs_store_what_they_take(void **unused)
{
    (void)unused;
    bench b;
    tube_create(&b, 10, 6, 2 * SHEET);
    scree_state *state = &b.state;
    scree_pressure_set(state, 0);
    for (size_t k = 0; k < scree_membrane_of(state)->count; k++) {
        scree_row *m = member(&b, k);
        m->x += 0.2 * SHEET * (uniform(3 * k) - 0.5);
        m->y += 0.2 * SHEET * (uniform(3 * k + 1) - 0.5);
        m->vx = 0.02 * uniform(2000 + k);
        if (scree_membrane_plate(state, k) < 0) m->z += 0.2 * SHEET * (uniform(3 * k + 2) - 0.5);
    }
    double begin = scree_membrane_energy(&b.model, state), momentum[2][2] = {{0}}, change = 0;
    membrane_forces(&b);
    state->ledger = (scree_ledger){0};
    for (int step = 0; step <= 400; step++) {
        for (size_t k = 0; k < scree_membrane_of(state)->count && step % 400 == 0; k++) {
            momentum[step / 400][0] += member(&b, k)->mass * member(&b, k)->vx;
            momentum[step / 400][1] += member(&b, k)->mass * fabs(member(&b, k)->vx);
        }
        if (step < 400) tube_step(&b, 1);
        change = fmax(change, fabs(scree_membrane_energy(&b.model, state) - begin));
    }
    // Rounding of 400 kicks.
    assert_true(fabs(momentum[1][0] - momentum[0][0]) < 1e-12 * momentum[0][1]);
    // The trapezoidal rule along springs that turn and fall slack: second order in omega dt = 3e-3.
    double stored = scree_membrane_energy(&b.model, state) - begin;
    assert_true(change > 0.1 * begin && begin > 0);
    assert_true(fabs(stored + state->ledger.boundary) < 1e-4 * begin);
    scree_state_destroy(state);
}

static void ends_move_with_the_plates(void **unused)
{
    (void)unused;
    bench b;
    bench_create(&b);
    scree_state *state = &b.state;
    b.model.gravity[2] = -9.81;
    scree_plates(state)[SCREE_WALL_BOTTOM].velocity = 3e-3;
    scree_plates(state)[SCREE_WALL_TOP].velocity = 1e-3;
    membrane_forces(&b);
    size_t ends = 0;
    for (size_t k = 0; k < scree_membrane_of(state)->count; k++) {
        int plate = scree_membrane_plate(state, k);
        if (plate < 0) continue;
        const scree_row *row = member(&b, k);
        const scree_sum_row *sum = &state->sum[scree_membrane_row(state, k)];
        double after = row->vz + STEP * ((double)sum->fz * QUANTUM / row->mass - 9.81);
        assert_true(fabs(after - (plate == SCREE_WALL_BOTTOM ? 3e-3 : -1e-3)) < 1e-15);
        // Free along the plate; the sheet is not stretched but for round-off.
        assert_true(hypot(scree_membrane_of(state)->force[k][0], scree_membrane_of(state)->force[k][1]) < 1e-9);
        ends++;
    }
    assert_int_equal(ends, 2 * scree_membrane_of(state)->around);
    scree_state_destroy(state);
}

/// The farthest point of every triangle from its corners, by trying many.
static void holes_are_found(void **unused)
{
    (void)unused;
    bench b;
    tube_create(&b, 9, 4, 2 * SHEET);
    scree_state *state = &b.state;
    // Two balls that touch each other and the plate leave a quarter of their radius, more than three in a triangle.
    assert_true(fabs(scree_sheet_hole(state) - 0.25 * SHEET) < 1e-12 * SHEET);
    for (size_t k = 0; k < 36; k++) member(&b, k)->z *= 1.5;
    for (uint64_t trial = 0; trial < 20; trial++) {
        double widest = 0;
        for (size_t k = 9; k < 27; k++) {
            member(&b, k)->z += 0.4 * SHEET * (uniform(100 * trial + k) - 0.5);
            member(&b, k)->x += 0.4 * SHEET * (uniform(100 * trial + k + 50) - 0.5);
        }
        for (size_t t = 0; t < scree_sheet_triangle_count(9, 36); t++) {
            size_t c[3];
            scree_sheet_triangle(9, 36, t, c);
            for (int i = 0; i <= 200; i++)
                for (int j = 0; i + j <= 200; j++) {
                    double nearest = INFINITY, w[3] = {i / 200.0, j / 200.0, 1 - (i + j) / 200.0};
                    double p[3] = {0};
                    for (int n = 0; n < 3; n++) {
                        const scree_row *m = member(&b, c[n]);
                        p[0] += w[n] * m->x, p[1] += w[n] * m->y, p[2] += w[n] * m->z;
                    }
                    for (int n = 0; n < 3; n++) {
                        const scree_row *m = member(&b, c[n]);
                        nearest = fmin(nearest, hypot(hypot(m->x - p[0], m->y - p[1]), m->z - p[2]));
                    }
                    widest = fmax(widest, nearest);
                }
        }
        // Half a mesh of the trial points.
        assert_true(fabs(scree_sheet_hole(state) - (widest - SHEET)) < 0.02 * SHEET);
    }
    // At a rim: a ball on the plate between two ends.
    for (size_t k = 0; k < 9; k++) member(&b, k)->x *= 1.6, member(&b, k)->y *= 1.6;
    double apart = distance(&b, 0, 1), ball = apart * apart / (16 * SHEET);
    assert_true(fabs(hypot(apart / 2, SHEET - ball) - SHEET - ball) < 1e-12 * SHEET);
    assert_true(scree_sheet_hole(state) >= ball * (1 - 1e-12));
    scree_state_destroy(state);
}

/// Spheres of the membrane do not touch each other, and measures of the assembly leave them out.
static void it_is_no_part_of_the_assembly(void **unused)
{
    (void)unused;
    bench b;
    bench_create(&b);
    scree_state *state = &b.state;
    scree_error error;
    assert_int_equal(scree_work_create(&b.work, &b.model, 1, &error), SCREE_OK);
    for (size_t k = 0; k < scree_membrane_of(state)->count; k++) {
        member(&b, k)->x += member(&b, k)->x < 4 * RADIUS ? 2e-6 : -2e-6;
        member(&b, k)->y += member(&b, k)->y < 4 * RADIUS ? 2e-6 : -2e-6;
    }
    assert_int_equal(scree_neighbours_refresh(&b.model, state, &b.work, &error), SCREE_OK);
    for (size_t k = 0; k < b.work.pairs.count; k++)
        assert_true(scree_body_is_grain(state, b.work.pairs.first[k]) ||
                    scree_body_is_grain(state, b.work.pairs.second[k]));
    scree_contact_set_quanta(&b.model, state, 1);
    scree_contact_forces(&b.model, state, &b.work);
    scree_contact_table table = {0};
    assert_int_equal(scree_contact_table_build(&b.model, state, &b.work, &table, &error), SCREE_OK);
    scree_coordination coordination;
    assert_int_equal(scree_boundary_refresh(&b.model, state, &error), SCREE_OK);
    scree_pressure_forces(&b.model, state);
    assert_int_equal(scree_coordination_measure(&b.model, state, NULL, &table, &coordination, &error), SCREE_OK);
    double contacts = 0, stress[9], other[9];
    size_t outer = 0;
    for (size_t c = 0; c < table.count; c++) {
        const scree_contact *contact = &table.contact[c];
        if (!scree_body_is_grain(state, contact->first)) continue; // an end and its plate
        if (contact->membrane) assert_true(contact->tangential_force == 0 && contact->normal_force > 0);
        contacts += scree_contact_is_outer(contact) ? 1 : 2;
        outer += contact->membrane;
    }
    assert_true(outer > 50);
    assert_true(fabs(coordination.mean - contacts / (double)scree_grain_count(state)) < 1e-12 * contacts);
    // The identity of stress.c, membrane included: contacts = boundary - (1/V) sum of resultants times places.
    scree_vector centre;
    double volume = scree_hull_sample_volume(state, centre);
    scree_stress_from_contacts(state, &table, volume, stress);
    scree_stress_from_boundary(&b.model, state, &table, other);
    for (size_t k = 0; k < state->count; k++) {
        if (!scree_body_is_grain(state, k)) continue;
        const scree_sum_row *sum = &state->sum[k];
        const double force[3] = {(double)sum->fx, (double)sum->fy, (double)sum->fz};
        scree_vector place;
        scree_body_position(state, k, place);
        for (int i = 0; i < 9; i++)
            other[i] -= force[i / 3] * state->force_quantum * (place[i % 3] - centre[i % 3]) / volume;
    }
    // Round-off of a thousand contacts, and half a quantum of 1e-11 of the largest force each.
    for (int i = 0; i < 9; i++) assert_true(fabs(stress[i] - other[i]) < 1e-9 * fabs(stress[0]));
    assert_true(stress[0] < 0);
    // What an experimenter knows, with the pressure on the membrane as if on the hull itself.
    double wrapped[9], bare[9];
    scree_stress_from_plates(&b.model, state, wrapped);
    scree_delaunay_boundary_of(state)->taken_over = 0;
    scree_pressure_forces(&b.model, state);
    scree_stress_from_plates(&b.model, state, bare);
    for (int i = 0; i < 3; i++) assert_true(fabs(wrapped[4 * i] - bare[4 * i]) < 1e-9 * PRESSURE);
    assert_true(fabs(bare[0] + PRESSURE) < 1e-9 * PRESSURE);
    scree_contact_table_destroy(&table);
    scree_contact_scratch_destroy(&b.work);
    scree_work_destroy(&b.work);
    scree_state_destroy(state);
}

static void failures_are_told(void **unused)
{
    (void)unused;
    bench b;
    plates_create(&b, 2, 0.02);
    scree_state *state = &b.state;
    for (size_t k = 0; k < 2; k++) state->row[k] = (scree_row){.z = 0.01 * (double)k, .radius = 1e-3, .mass = 1};
    uint64_t before = state_bits(state);
    bool failed = true;
    for (uint64_t n = 1; failed; n++) {
        scree_error error;
        scree_allocation_fail_after(n);
        failed = scree_membrane_place(&b.model, state, &error) != SCREE_OK;
        scree_allocation_fail_after(0);
        if (failed) assert_true(state_bits(state) == before && error.status == SCREE_ERROR_IO);
    }
    assert_true(scree_membrane_of(state)->count > 20);
    // Grains so small that they slip through, when it is placed and later.
    scree_error error;
    b.model.radius_min = 0.1 * SHEET;
    scree_hull_of(state)->updated = state->step;
    const scree_boundary *membrane = scree_module_membrane.boundary;
    assert_int_equal(boundary_pass(membrane, SCREE_PHASE_SEARCH, &b.model, state, &b.work, &error), SCREE_ERROR_GUARD);
    assert_non_null(strstr(error.message, "slip through"));
    scree_hull_of(state)->updated = state->step + 1; // not looked at between two updates
    assert_int_equal(boundary_pass(membrane, SCREE_PHASE_SEARCH, &b.model, state, &b.work, &error), SCREE_OK);
    scree_state_destroy(state);
    plates_create(&b, 1, 0.02);
    b.state.row[0] = (scree_row){.z = 0.01, .radius = 1e-3, .mass = 1};
    b.model.radius_min = 0.1 * SHEET;
    assert_int_equal(scree_membrane_place(&b.model, &b.state, &error), SCREE_ERROR_GUARD);
    assert_non_null(strstr(error.message, "slip through"));
    scree_state_destroy(&b.state);
    plates_create(&b, 1, 3 * SHEET);
    assert_int_equal(scree_membrane_place(&b.model, &b.state, &error), SCREE_ERROR_GUARD);
    scree_state_destroy(&b.state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_net_is_a_tube),
        cmocka_unit_test(it_wraps_the_grains_without_pressing),
        cmocka_unit_test(pressure_is_the_derivative_of_the_volume),
        cmocka_unit_test(the_sheet_has_its_stiffness),
        cmocka_unit_test(hoop_tension_carries_the_pressure),
        cmocka_unit_test(springs_store_what_they_take),
        cmocka_unit_test(ends_move_with_the_plates),
        cmocka_unit_test(holes_are_found),
        cmocka_unit_test(it_is_no_part_of_the_assembly),
        cmocka_unit_test(failures_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
