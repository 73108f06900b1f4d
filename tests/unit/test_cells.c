/// Cells: exact identities of gradients and stresses, in the plane and in space.
#include "testing.h"

#include "base/random.h"
#include "measure/cells.h"
#include "measure/measure.h"
#include "search/tetrahedra.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#define assert_near(value, expected, tolerance)                                                                        \
    do {                                                                                                               \
        double value_ = (value), expected_ = (expected), tolerance_ = (tolerance);                                     \
        if (!(fabs(value_ - expected_) <= tolerance_))                                                                 \
            fail_msg("%.17g is not %.17g within %.3g", value_, expected_, tolerance_);                                 \
    } while (0)

/// A packing without mechanics: a lattice with noise, sizes from 0.5 to 1 mm.
typedef struct sample {
    scree_assembly assembly;
    scree_state state;
    scree_cells cells;
    scree_contact_table table;
} sample;

static double noise(uint64_t k)
{
    return scree_random_uniform(7, SCREE_RANDOM_TEST, k) - 0.5;
}

static void place_bodies(sample *s, int dimension, size_t side)
{
    size_t count = dimension == 3 ? side * side * side : side * side;
    s->assembly = (scree_assembly){.dimension = dimension, .thickness = dimension == 3 ? 1 : 1.5e-3, .count = count};
    assert_int_equal(scree_allocate(&s->assembly.position, 3 * count, sizeof(double), NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&s->assembly.radius, count, sizeof(double), NULL), SCREE_OK);
    assert_int_equal(scree_state_create(&s->state, dimension, count, NULL), SCREE_OK);
    for (size_t i = 0; i < count; i++) {
        const size_t at[3] = {i % side, i / side % side, i / side / side};
        for (int d = 0; d < dimension; d++)
            s->assembly.position[3 * i + (size_t)d] = 1.4e-3 * ((double)at[d] + 0.7 * noise(4 * i + (size_t)d));
        // Some bodies reach beyond their neighbours, so that not all contacts are edges.
        s->assembly.radius[i] = (i % 7 == 3 ? 1.6e-3 : 0.75e-3) + 0.5e-3 * noise(4 * i + 3);
        s->state.row[i] = (scree_row){.x = s->assembly.position[3 * i], .y = s->assembly.position[3 * i + 1]};
        if (dimension == 3) s->state.row[i].z = s->assembly.position[3 * i + 2];
        s->state.row[i].radius = s->assembly.radius[i];
    }
}

/// Overlapping bodies touch, with random forces.
static void touch(sample *s)
{
    size_t count = s->assembly.count, capacity = 40 * count;
    assert_int_equal(scree_allocate(&s->table.contact, capacity, sizeof(scree_contact), NULL), SCREE_OK);
    for (size_t i = 0; i < count; i++)
        for (size_t j = i + 1; j < count && s->table.count < capacity; j++) {
            scree_contact c = {.first = (uint32_t)i, .second = (uint32_t)j};
            for (size_t d = 0; d < 3; d++)
                c.branch[d] = s->assembly.position[3 * i + d] - s->assembly.position[3 * j + d];
            double length = scree_length(c.branch);
            if (length > s->assembly.radius[i] + s->assembly.radius[j]) continue;
            for (int d = 0; d < 3; d++) c.normal[d] = c.branch[d] / length;
            c.tangent[0] = -c.normal[1];
            c.tangent[1] = c.normal[0];
            c.normal_force = 10 * (1 + noise(1000000 + i * count + j));
            c.tangential_force = noise(2000000 + i * count + j);
            s->table.contact[s->table.count++] = c;
        }
}

static void sample_create(sample *s, int dimension, size_t side)
{
    memset(s, 0, sizeof *s);
    place_bodies(s, dimension, side);
    touch(s);
    assert_int_equal(scree_cells_build(&s->assembly, SCREE_PEEL_RULE(1e-3), &s->cells, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&s->cells.gradient, s->cells.count, sizeof *s->cells.gradient, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&s->cells.stress, s->cells.count, sizeof *s->cells.stress, NULL), SCREE_OK);
}

static void sample_destroy(sample *s)
{
    scree_cells_destroy(&s->cells);
    scree_assembly_destroy(&s->assembly);
    scree_state_destroy(&s->state);
    scree_contact_table_destroy(&s->table);
}

static double *random_field(size_t count, int dimension)
{
    double *v;
    assert_int_equal(scree_allocate(&v, 3 * count, sizeof *v, NULL), SCREE_OK);
    for (size_t i = 0; i < count; i++)
        for (size_t d = 0; d < (size_t)dimension; d++) v[3 * i + d] = noise(5000000 + 3 * i + d);
    return v;
}

static void weighted_sum(const sample *s, double (*tensor)[9], double sum[9], double *volume)
{
    *volume = 0;
    for (int i = 0; i < 9; i++) sum[i] = 0;
    for (size_t k = 0; k < s->cells.count; k++) {
        *volume += s->cells.volume[k];
        for (int i = 0; i < 9; i++) sum[i] += s->cells.volume[k] * tensor[k][i];
    }
}

static void test_affine_field(void **unused)
{
    (void)unused;
    const double affine[9] = {0.3, -0.7, 0.2, 1.1, 0.4, -0.5, 0.6, 0.1, -0.9};
    for (int dimension = 2; dimension <= 3; dimension++) {
        sample s;
        sample_create(&s, dimension, dimension == 3 ? 8 : 20);
        double *v = random_field(s.assembly.count, dimension);
        for (size_t i = 0; i < s.assembly.count; i++)
            for (int a = 0; a < dimension; a++) {
                v[3 * i + (size_t)a] = 0.01;
                for (int b = 0; b < dimension; b++)
                    v[3 * i + (size_t)a] += affine[3 * a + b] * s.assembly.position[3 * i + (size_t)b];
            }
        scree_cells_gradient(&s.cells, s.assembly.position, v, s.cells.gradient);
        // Round-off of 0.04 m/s (the largest value) over the height of the flattest cell, 1e-3 of an edge of 1.4 mm.
        for (size_t k = 0; k < s.cells.count; k++)
            for (int a = 0; a < 3; a++)
                for (int b = 0; b < 3; b++) {
                    double expected = a < dimension && b < dimension ? affine[3 * a + b] : 0;
                    assert_near(s.cells.gradient[k][3 * a + b], expected, 1e-9);
                }
        scree_release(&v);
        sample_destroy(&s);
    }
}

/// Sum over the outer faces of mean value (x) outward area (Bagi): by the divergence theorem the sum over the cells.
static void boundary_sum(const sample *s, const double *v, double sum[9])
{
    int d = s->cells.dimension;
    for (int i = 0; i < 9; i++) sum[i] = 0;
    for (size_t k = 0; k < s->cells.count; k++)
        for (int n = 0; n <= d; n++) {
            if (s->cells.neighbour[k][n] >= 0) continue;
            const double *x[3], *u[3];
            for (int m = 0, next = 0; m <= d; m++) {
                if (m == n) continue;
                x[next] = s->assembly.position + 3 * (size_t)s->cells.node[k][m];
                u[next++] = v + 3 * (size_t)s->cells.node[k][m];
            }
            const double *inside = s->assembly.position + 3 * (size_t)s->cells.node[k][n];
            double a[3], b[3] = {0, 0, 2 * s->assembly.thickness}, area[3], along = 0;
            for (int i = 0; i < 3; i++) a[i] = x[1][i] - x[0][i];
            for (int i = 0; i < 3 && d == 3; i++) b[i] = x[2][i] - x[0][i];
            for (int i = 0; i < 3; i++)
                area[i] = (a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]) / 2;
            for (int i = 0; i < 3; i++) along += area[i] * (inside[i] - x[0][i]);
            for (int i = 0; i < d; i++)
                for (int j = 0; j < d; j++) {
                    double mean = 0;
                    for (int m = 0; m < d; m++) mean += u[m][i] / d;
                    sum[3 * i + j] += mean * area[j] * (along > 0 ? -1 : 1);
                }
        }
}

static void test_mean_gradient_is_that_of_the_boundary(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        sample s;
        sample_create(&s, dimension, dimension == 3 ? 8 : 20);
        double *v = random_field(s.assembly.count, dimension), cells[9], boundary[9], volume;
        scree_cells_gradient(&s.cells, s.assembly.position, v, s.cells.gradient);
        weighted_sum(&s, s.cells.gradient, cells, &volume);
        boundary_sum(&s, v, boundary);
        // Thousands of terms of face (1e-6 m2) times value (1), each exact to 1e-16 of itself.
        double scale = (dimension == 3 ? 2e-6 : 1.4e-3 * 1.5e-3) * sqrt((double)s.cells.count);
        assert_true(volume > 0);
        for (int i = 0; i < 9; i++) assert_near(cells[i], boundary[i], 1e-13 * scale);
        scree_release(&v);
        sample_destroy(&s);
    }
}

static void test_cells_fill_the_sample(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        sample s;
        size_t side = dimension == 3 ? 8 : 20;
        sample_create(&s, dimension, side);
        double edge = 1.4e-3 * (double)(side - 1), box = pow(edge, dimension) * s.assembly.thickness, volume = 0;
        uint8_t *used;
        assert_int_equal(scree_allocate(&used, s.assembly.count, 1, NULL), SCREE_OK);
        for (size_t k = 0; k < s.cells.count; k++) {
            assert_true(s.cells.volume[k] > 0);
            volume += s.cells.volume[k];
            for (int n = 0; n <= dimension; n++) used[s.cells.node[k][n]] = 1;
            for (int n = 0; n <= dimension; n++) {
                int32_t behind = s.cells.neighbour[k][n];
                bool back = behind < 0;
                for (int m = 0; m <= dimension && !back; m++) back = s.cells.neighbour[behind][m] == (int32_t)k;
                assert_true(back);
            }
        }
        // Every body has a cell; the outermost layer is rough by 0.35 of a spacing on either side.
        for (size_t i = 0; i < s.assembly.count; i++) assert_int_equal(used[i], 1);
        assert_near(volume / box, 1, 0.1);
        scree_release(&used);
        sample_destroy(&s);
    }
}

static void test_mean_stress_is_that_of_the_contacts(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        sample s;
        sample_create(&s, dimension, dimension == 3 ? 8 : 20);
        assert_int_equal(scree_cells_stress(&s.cells, &s.state, &s.table, s.cells.stress, NULL), SCREE_OK);
        double cells[9], contacts[9], volume;
        weighted_sum(&s, s.cells.stress, cells, &volume);
        scree_stress_from_contacts(&s.state, &s.table, volume, contacts);
        // The noise makes the sizes differ enough that some contacts are no edges.
        assert_true(s.table.count > s.assembly.count);
        assert_true(s.cells.crossing > 0);
        // Thousands of terms summed in another order.
        for (int i = 0; i < 9; i++) assert_near(cells[i] / volume, contacts[i], 1e-12 * fabs(contacts[0]));
        sample_destroy(&s);
    }
}

/// Branches that leave the cells have no conjugate velocity gradient: the power of the others is kept exactly.
static void test_power(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        sample s;
        sample_create(&s, dimension, dimension == 3 ? 8 : 20);
        // Contacts near the outside may leave the cells: a convex region well inside has none of these.
        double low = 1.4e-3 * 2, high = 1.4e-3 * ((dimension == 3 ? 8 : 20) - 3);
        size_t kept = 0;
        for (size_t c = 0; c < s.table.count; c++) {
            bool inside = true;
            const uint32_t ends[2] = {s.table.contact[c].first, s.table.contact[c].second};
            for (int e = 0; e < 2; e++)
                for (int i = 0; i < dimension; i++) {
                    double x = s.assembly.position[3 * (size_t)ends[e] + (size_t)i];
                    inside = inside && x > low && x < high;
                }
            if (inside) s.table.contact[kept++] = s.table.contact[c];
        }
        s.table.count = kept;
        double *v = random_field(s.assembly.count, dimension), inner = 0, outer = 0;
        scree_cells_gradient(&s.cells, s.assembly.position, v, s.cells.gradient);
        assert_int_equal(scree_cells_stress(&s.cells, &s.state, &s.table, s.cells.stress, NULL), SCREE_OK);
        assert_true(s.cells.crossing > 0);
        assert_int_equal(s.cells.unassigned, 0);
        for (size_t k = 0; k < s.cells.count; k++)
            for (int i = 0; i < 9; i++) inner += s.cells.volume[k] * s.cells.stress[k][i] * s.cells.gradient[k][i];
        for (size_t c = 0; c < s.table.count; c++) {
            const scree_contact *contact = &s.table.contact[c];
            for (size_t i = 0; i < 3; i++)
                outer +=
                    (contact->normal_force * contact->normal[i] + contact->tangential_force * contact->tangent[i]) *
                    (v[3 * contact->second + i] - v[3 * contact->first + i]);
        }
        // Terms of 10 N x 1 m/s, in flat cells magnified by length over height.
        assert_near(inner, outer, 1e-9 * 10 * sqrt((double)s.table.count));
        scree_release(&v);
        sample_destroy(&s);
    }
}

static void test_distortion(void **unused)
{
    (void)unused;
    const double shear[9] = {0, 2, 0, 0, 0, 0, 0, 0, 0}, swelling[9] = {3, 0, 0, 0, 3, 0, 0, 0, 3};
    const double spin[9] = {0, 2, -1, -2, 0, 3, 1, -3, 0}, flat[9] = {3, 0, 0, 0, 3, 0, 0, 0, 0};
    assert_near(scree_distortion(shear, 2), 1, 1e-15);
    assert_near(scree_distortion(shear, 3), 1, 1e-15);
    assert_near(scree_distortion(swelling, 3), 0, 1e-15);
    assert_near(scree_distortion(flat, 2), 0, 1e-15);
    assert_near(scree_distortion(spin, 3), 0, 1e-15);
}

/// F = R U R': the distortion is that of the diagonal U, whatever the rotations.
static void test_finite_distortion_does_not_see_rotations(void **unused)
{
    (void)unused;
    const double stretch[3] = {1.4, 0.8, 0.9};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int trial = 0; trial < 20; trial++) {
            double f[3][3] = {{0}}, mean = 0, sum = 0, gradient[9];
            for (int i = 0; i < 3; i++) f[i][i] = i < dimension ? stretch[i] : 1;
            for (int turn = 0; turn < (dimension == 3 ? 3 : 1); turn++)
                for (int side = 0; side < 2; side++) {
                    double angle = 6 * noise((uint64_t)(100 * trial + 10 * turn + side)), c = cos(angle),
                           t = sin(angle);
                    int p = dimension == 3 ? turn : 0, q = (p + 1) % 3;
                    for (int k = 0; k < 3; k++) {
                        double *a = side ? &f[k][p] : &f[p][k], *b = side ? &f[k][q] : &f[q][k], old = *a;
                        *a = c * old - t * *b;
                        *b = t * old + c * *b;
                    }
                }
            for (int i = 0; i < dimension; i++) mean += stretch[i] / dimension;
            for (int i = 0; i < dimension; i++) sum += (stretch[i] - mean) * (stretch[i] - mean);
            for (int i = 0; i < 9; i++) gradient[i] = f[i / 3][i % 3] - (i / 3 == i % 3);
            // Square root of a sum of squares of 0.3 with round-off of 1e-16 in F^T F.
            assert_near(scree_finite_distortion(gradient, dimension), sqrt(sum / 2), 1e-14);
        }
}

static void test_circles(void **unused)
{
    (void)unused;
    sample s;
    sample_create(&s, 2, 20);
    assert_int_equal(scree_allocate(&s.cells.pressure, s.cells.count, sizeof(double), NULL), SCREE_OK);
    for (size_t k = 0; k < s.cells.count; k++) {
        scree_vector centre;
        scree_cell_centre(&s.cells, k, s.assembly.position, centre);
        s.cells.pressure[k] = 100 + centre[1];
    }
    const scree_vector middle = {1.4e-3 * 9.5, 1.4e-3 * 9.5, 0};
    double volume[200], pressure[200], all = 0, step = 0.5e-3;
    scree_cells_circles(&s.cells, s.assembly.position, middle, step, 200, pressure, volume);
    for (size_t k = 0; k < s.cells.count; k++) all += s.cells.volume[k];
    // The largest circle holds every cell; one of 10 spacings its area to within a cell along its rim.
    assert_near(volume[199], all, 1e-12 * all);
    assert_near(pressure[199], scree_cells_mean(&s.cells, s.cells.pressure), 1e-12 * 100);
    double circle = M_PI / 4 * 14e-3 * 14e-3 * s.assembly.thickness;
    assert_near(volume[27] / circle, 1, 0.1);
    assert_near(pressure[27], 100 + middle[1], 1e-3);
    for (int c = 1; c < 200; c++) assert_true(volume[c] >= volume[c - 1]);
    scree_cells_circles(&s.cells, s.assembly.position, (const scree_vector){1, 1, 0}, step, 1, pressure, volume);
    assert_true(isnan(pressure[0]) && !(volume[0] > 0));
    sample_destroy(&s);
}

static void test_bad_points(void **unused)
{
    (void)unused;
    double place[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, NAN, 0, 0}, radius[5] = {0.5, 0.5, 0.5, 0.5, 0.5};
    scree_assembly assembly = {.dimension = 3, .thickness = 1, .count = 3, .position = place, .radius = radius};
    scree_cells cells;
    scree_error error;
    assert_int_equal(scree_cells_build(&assembly, SCREE_PEEL_RULE(1), &cells, &error), SCREE_ERROR_GUARD);
    assembly.count = 4;
    assert_int_equal(scree_cells_build(&assembly, SCREE_PEEL_RULE(1), &cells, &error), SCREE_ERROR_GUARD);
    assembly.count = 5;
    assert_int_equal(scree_cells_build(&assembly, SCREE_PEEL_RULE(1), &cells, &error), SCREE_ERROR_GUARD);
}

static double milliseconds(struct timespec from, struct timespec to)
{
    return 1e3 * (double)(to.tv_sec - from.tv_sec) + 1e-6 * (double)(to.tv_nsec - from.tv_nsec);
}

/// Printed, never judged: what the cells of 4000 discs and 8000 spheres cost.
static void test_cost(void **unused)
{
    (void)unused;
    const size_t side[4] = {0, 0, 64, 20};
    for (int dimension = 2; dimension <= 3; dimension++) {
        sample s = {0};
        struct timespec begin, middle, end;
        place_bodies(&s, dimension, side[dimension]);
        double build = INFINITY;
        for (int repeat = 0; repeat < 5; repeat++) {
            scree_cells_destroy(&s.cells);
            clock_gettime(CLOCK_MONOTONIC, &begin);
            assert_int_equal(scree_cells_build(&s.assembly, SCREE_PEEL_RULE(1e-3), &s.cells, NULL), SCREE_OK);
            clock_gettime(CLOCK_MONOTONIC, &end);
            build = fmin(build, milliseconds(begin, end));
        }
        touch(&s);
        double *v = random_field(s.assembly.count, dimension);
        assert_int_equal(scree_allocate(&s.cells.gradient, s.cells.count, sizeof *s.cells.gradient, NULL), SCREE_OK);
        assert_int_equal(scree_allocate(&s.cells.stress, s.cells.count, sizeof *s.cells.stress, NULL), SCREE_OK);
        clock_gettime(CLOCK_MONOTONIC, &begin);
        scree_cells_gradient(&s.cells, s.assembly.position, v, s.cells.gradient);
        clock_gettime(CLOCK_MONOTONIC, &middle);
        assert_int_equal(scree_cells_stress(&s.cells, &s.state, &s.table, s.cells.stress, NULL), SCREE_OK);
        clock_gettime(CLOCK_MONOTONIC, &end);
        printf(
            "%zu bodies in %dD: %zu cells, %zu contacts (%zu no edge, %zu outside); cells %.1f ms, gradients %.1f ms, "
            "stresses %.1f ms\n",
            s.assembly.count, dimension, s.cells.count, s.table.count, s.cells.crossing, s.cells.unassigned, build,
            milliseconds(begin, middle), milliseconds(middle, end));
        scree_release(&v);
        sample_destroy(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_affine_field),
        cmocka_unit_test(test_mean_gradient_is_that_of_the_boundary),
        cmocka_unit_test(test_cells_fill_the_sample),
        cmocka_unit_test(test_mean_stress_is_that_of_the_contacts),
        cmocka_unit_test(test_power),
        cmocka_unit_test(test_distortion),
        cmocka_unit_test(test_finite_distortion_does_not_see_rotations),
        cmocka_unit_test(test_circles),
        cmocka_unit_test(test_bad_points),
        cmocka_unit_test(test_cost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
