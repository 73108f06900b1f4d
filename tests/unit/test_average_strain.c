/// Strains of elements between two instants: affine motions of any size, rotations, turning grains in the plane and in
/// space, known faults.
#include "average_fixture.h"

#include "average/kernel_strain.h"
#include "average/strain.h"
#include "base/matrix.h"

#include <stdio.h>

#define TURN 0.3

/// Rotation matrix about an axis of any length by its length [rad], by Rodrigues' formula.
static void rotation(const double by[3], double q[9])
{
    const double angle = scree_length(by), c = cos(angle), s = sin(angle);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int k = 3 - i - j;
            const double n[2] = {by[i] / angle, by[j] / angle};
            q[3 * i + j] = (i == j ? c : 0) + (1 - c) * n[0] * n[1];
            if (i != j) q[3 * i + j] += s * by[k] / angle * ((j - i + 3) % 3 == 1 ? -1 : 1);
        }
}

/// Quaternions of such rotations, b after a.
static void after(const double b[3], const double a[3], double q[4])
{
    double one[4], other[4], across[3];
    const double *by[2] = {a, b};
    for (int k = 0; k < 2; k++) {
        double *of = k ? other : one;
        const double angle = scree_length(by[k]);
        of[0] = cos(0.5 * angle);
        for (int i = 0; i < 3; i++) of[i + 1] = angle > 0 ? sin(0.5 * angle) * by[k][i] / angle : 0;
    }
    scree_cross(other + 1, one + 1, across);
    q[0] = other[0] * one[0] - scree_dot(other + 1, one + 1);
    for (int i = 0; i < 3; i++) q[i + 1] = other[0] * one[i + 1] + one[0] * other[i + 1] + across[i];
}

/// Spheres that lie about axes and angles of their own at first, and turn about vectors [rad] from there.
static void lie(scree_average_sample *s, scree_average_sample *before, const double (*turns)[3])
{
    const double none[3] = {0};
    assert_int_equal(scree_allocate(&s->orientation, s->bodies, sizeof *s->orientation, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&before->orientation, s->bodies, sizeof *s->orientation, NULL), SCREE_OK);
    for (size_t p = 0; p < s->bodies; p++) {
        double first[3];
        for (int k = 0; k < 3; k++) first[k] = 5 * (average_random(90000 + 3 * p + (uint64_t)k) - 0.5);
        after(none, first, before->orientation[p]);
        after(turns[p], first, s->orientation[p]);
    }
}

/// A sample of discs that touch at random, hexagonally placed and shaken, moved by u = G X + c; grains turn by `turn`,
/// spheres by `turns` (NULL: how they lie is not known).
static scree_average_sample moved(int dimension, const double gradient[9], double turn, const double (*turns)[3])
{
    scree_average_sample s = average_begin(dimension), before;
    const size_t n = dimension == 2 ? 14 : 8;
    uint64_t at = 5000;
    for (size_t k = 0; k < (dimension == 2 ? n * n : n * n * n); k++) {
        double x[3] = {(double)(k % n), (double)(k / n % n), (double)(k / n / n)};
        for (int i = 0; i < dimension; i++) x[i] += 0.3 * average_random(at++);
        if (dimension == 2) x[2] = 0;
        (void)average_add(&s, x[0], x[1], x[2], 0.5);
    }
    before = s;
    assert_int_equal(scree_allocate(&before.grain, s.bodies, sizeof *before.grain, NULL), SCREE_OK);
    memcpy(before.grain, s.grain, s.bodies * sizeof *s.grain);
    if (turns) lie(&s, &before, turns);
    for (size_t p = 0; p < s.bodies; p++) {
        s.grain[p].angle += turn;
        for (int i = 0; i < dimension; i++) {
            s.grain[p].position[i] += 0.2;
            for (int j = 0; j < dimension; j++)
                s.grain[p].position[i] += gradient[3 * i + j] * before.grain[p].position[j];
        }
    }
    for (uint32_t k = 0; k + n < s.bodies; k++) {
        average_touch(&s, k, k + 1, (double[3]){1, 0, 0});
        average_touch(&s, k, k + (uint32_t)n, (double[3]){0, 1, 0});
        if (dimension == 3 && k + n * n < s.bodies) average_touch(&s, k, k + (uint32_t)(n * n), (double[3]){0, 0, 1});
    }
    scree_error error;
    check(scree_average_move(&s, &before, &error), &error);
    scree_release(&before.grain);
    scree_release(&before.orientation);
    average_finish(&s);
    return s;
}

static void find(scree_average_sample *s, scree_vector displacement, double gradient[SCREE_AVERAGE_STRAINS][9])
{
    scree_average_bins bins;
    scree_average_strain strain;
    scree_error error;
    double middle[3];
    for (int k = 0; k < 3; k++) middle[k] = 0.5 * (s->low[k] + s->high[k]);
    const double side = s->dimension == 2 ? 4.5 : 3;
    scree_average_element element =
        scree_average_element_at(middle, (double[3]){side, side, s->dimension == 3 ? side : 0});
    check(scree_average_bins_make(s, 1, &bins, &error), &error);
    check(scree_average_strain_open(s, &bins, &strain, &error), &error);
    scree_average_strain_find(&strain, &element, displacement, gradient);
    scree_average_strain_close(&strain);
    scree_average_bins_destroy(&bins);
}

/// Every definition but liao's (grains turn by another angle than the whole) finds an affine motion of any size.
static void test_affine(void **state)
{
    (void)state;
    const double g[2][9] = {{0.2, -0.1, 0, 0.05, -0.3, 0, 0, 0, 0},
                            {0.2, -0.1, 0.07, 0.05, -0.3, 0.02, 0.1, -0.06, 0.15}};
    for (int dimension = 2; dimension <= 3; dimension++) {
        scree_vector displacement;
        double gradient[SCREE_AVERAGE_STRAINS][9];
        const double *wanted = g[dimension - 2];
        scree_average_sample s = moved(dimension, wanted, 0, NULL);
        find(&s, displacement, gradient);
        for (int d = 0; d < SCREE_AVERAGE_STRAINS; d++)
            for (int i = 0; i < dimension; i++)
                for (int j = 0; j < dimension; j++) {
                    if (dimension == 3 && d == SCREE_AVERAGE_LIAO)
                        assert_true(isnan(gradient[d][3 * i + j])); // how spheres lie is not kept
                    else
                        near(gradient[d][3 * i + j], wanted[3 * i + j], 1e-12);
                }
        scree_average_sample_destroy(&s);
    }
}

/// A rotation of the whole by any angle: the gradient is Q - 1; liao finds nothing where grains turn along.
static void test_rotation(void **state)
{
    (void)state;
    const double c = cos(TURN), si = sin(TURN), q[9] = {c - 1, -si, 0, si, c - 1, 0, 0, 0, 0};
    scree_vector displacement;
    double gradient[SCREE_AVERAGE_STRAINS][9];
    scree_average_sample s = moved(2, q, TURN, NULL);
    find(&s, displacement, gradient);
    for (int d = 0; d < SCREE_AVERAGE_STRAINS; d++)
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 2; j++) near(gradient[d][3 * i + j], d == SCREE_AVERAGE_LIAO ? 0 : q[3 * i + j], 1e-12);
    // A small one has no strain: the symmetric part is of second order.
    const double small[9] = {cos(1e-4) - 1, -sin(1e-4), 0, sin(1e-4), cos(1e-4) - 1, 0, 0, 0, 0};
    scree_average_sample_destroy(&s);
    s = moved(2, small, 0, NULL);
    find(&s, displacement, gradient);
    for (int d = 0; d < SCREE_AVERAGE_STRAINS; d++) {
        near(gradient[d][1] + gradient[d][3], 0, 1e-11);
        near(gradient[d][0], -5e-9, 1e-11);
    }
    scree_average_sample_destroy(&s);
}

/// Grains that turn on the spot: liao alone sees it, as a rotation the other way (surfaces move past each other).
static void test_turning(void **state)
{
    (void)state;
    const double none[9] = {0};
    const double small = 1e-5;
    scree_vector displacement;
    double gradient[SCREE_AVERAGE_STRAINS][9];
    scree_average_sample s = moved(2, none, small, NULL);
    find(&s, displacement, gradient);
    near(displacement[0], 0.2, 1e-13);
    for (int i = 0; i < 4; i++) near(gradient[SCREE_AVERAGE_CAMBOU][3 * (i / 2) + i % 2], 0, 1e-14);
    // dv = turn x (r_first - r_second) = - turn x branch, whatever the sizes are.
    near(gradient[SCREE_AVERAGE_LIAO][1], small, 1e-9);
    near(gradient[SCREE_AVERAGE_LIAO][3], -small, 1e-9);
    scree_average_sample_destroy(&s);
}

/// Spheres: F = 1 + G = R U about an axis that is none of the frame's. Where they turn with R liao is U - 1, where they
/// turn by any Q it is Q^T F - 1, where they do not it is G; how they lay at first does not matter.
static void test_spheres(void **state)
{
    (void)state;
    const double by[3][3] = {{0.7, -1.1, 0.4}, {-0.2, 0.5, 1.9}, {0, 0, 0}};
    const double stretch[9] = {1.2, -0.1, 0.07, -0.1, 0.7, 0.02, 0.07, 0.02, 1.15};
    double(*turns)[3], r[9], f[9] = {0}, g[9];
    rotation(by[0], r);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++) f[3 * i + j] += r[3 * i + k] * stretch[3 * k + j];
    for (int k = 0; k < 9; k++) g[k] = f[k] - (k % 4 == 0);
    assert_int_equal(scree_allocate(&turns, ROOM, sizeof *turns, NULL), SCREE_OK);
    for (int which = 0; which < 3; which++) {
        double gradient[SCREE_AVERAGE_STRAINS][9], q[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
        scree_vector displacement;
        for (size_t p = 0; p < ROOM; p++) memcpy(turns[p], by[which], sizeof by[which]);
        if (which < 2) rotation(by[which], q);
        scree_average_sample s = moved(3, g, 0, (const double(*)[3])turns);
        find(&s, displacement, gradient);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                double wanted = i == j ? -1 : 0;
                for (int k = 0; k < 3; k++) wanted += q[3 * k + i] * f[3 * k + j];
                near(gradient[SCREE_AVERAGE_LIAO][3 * i + j], wanted, 1e-12);
                near(gradient[SCREE_AVERAGE_CAMBOU][3 * i + j], g[3 * i + j], 1e-12);
                if (which == 0) near(wanted, stretch[3 * i + j] - (i == j), 1e-14);
            }
        scree_average_sample_destroy(&s);
    }
    scree_release(&turns);
}

/// Spheres of two sizes, each with an axis and angle of its own: the points of both surfaces that are at the contact
/// now are followed back by matrices, and the gradient fitted to them has no residual that the contacts could still
/// reduce.
static void test_own_turns(void **state)
{
    (void)state;
    double(*turns)[3], normal[9] = {0}, gradient[SCREE_AVERAGE_STRAINS][9], size = 0;
    const double g[9] = {0.05, -0.02, 0.03, 0.01, -0.04, 0.02, -0.03, 0.06, 0.02};
    scree_vector displacement;
    assert_int_equal(scree_allocate(&turns, ROOM, sizeof *turns, NULL), SCREE_OK);
    for (size_t p = 0; p < ROOM; p++)
        for (int k = 0; k < 3; k++) turns[p][k] = 3 * (average_random(70000 + 3 * p + (uint64_t)k) - 0.5);
    scree_average_sample s = moved(3, g, 0, (const double(*)[3])turns);
    for (size_t c = 0; c < s.contacts; c++) // anywhere between both, so that levers differ
        for (int k = 0; k < 3; k++) s.contact[c].point[k] += 0.2 * s.contact[c].normal[k];
    find(&s, displacement, gradient);
    const double middle[3] = {0.5 * (s.low[0] + s.high[0]), 0.5 * (s.low[1] + s.high[1]), 0.5 * (s.low[2] + s.high[2])};
    const scree_average_element element = scree_average_element_at(middle, (double[3]){3, 3, 3});
    for (size_t c = 0; c < s.contacts; c++) {
        const scree_average_contact *contact = &s.contact[c];
        double apart[3] = {0}, branch[3];
        if (!scree_average_element_holds(&element, 3, contact->point)) continue;
        for (int end = 0; end < 2; end++) {
            const scree_average_grain *grain = &s.grain[end ? contact->second : contact->first];
            double q[9];
            rotation(turns[grain->body], q);
            for (int i = 0; i < 3; i++) {
                double then = grain->position[i] - grain->displacement[i];
                for (int k = 0; k < 3; k++) then += q[3 * k + i] * (contact->point[k] - grain->position[k]);
                apart[i] += (end ? -1 : 1) * (contact->point[i] - then);
            }
        }
        for (int i = 0; i < 3; i++)
            branch[i] =
                contact->branch[i] - s.grain[contact->first].displacement[i] + s.grain[contact->second].displacement[i];
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                double left = apart[i];
                for (int k = 0; k < 3; k++) left -= gradient[SCREE_AVERAGE_LIAO][3 * i + k] * branch[k];
                normal[3 * i + j] += left * branch[j];
                size += left * left;
            }
    }
    assert_true(size > 1); // turns that have nothing to do with each other are no strain
    for (int k = 0; k < 9; k++) near(normal[k], 0, 1e-11);
    scree_average_sample_destroy(&s);
    scree_release(&turns);
}

/// Rotations that were set to zero between the two instants say nothing, at the first of them everything.
static void test_counted_anew(void **state)
{
    (void)state;
    const double none[9] = {0}, turn = 0.2;
    for (int when = 0; when < 4; when++) {
        scree_vector displacement;
        double gradient[SCREE_AVERAGE_STRAINS][9];
        scree_average_sample s = moved(2, none, 0, NULL), before = s;
        scree_error error;
        // 0: counted from before both; 1: from the first instant; 2: from between; 3: nobody knows, other stages.
        assert_int_equal(scree_allocate(&before.grain, s.bodies, sizeof *before.grain, NULL), SCREE_OK);
        memcpy(before.grain, s.grain, s.bodies * sizeof *s.grain);
        before.time = 1;
        s.time = 3;
        s.turned_since = when == 3 ? (double)NAN : (double)when;
        before.turned_since = when == 3 ? (double)NAN : 0;
        (void)snprintf(s.stage, sizeof s.stage, "%s", when == 3 ? "compress" : "");
        for (size_t p = 0; p < s.bodies; p++) {
            before.grain[p].angle = 7;
            s.grain[p].angle = turn + (when == 0 ? 7 : 0);
        }
        scree_release(&s.turn);
        check(scree_average_move(&s, &before, &error), &error);
        find(&s, displacement, gradient);
        if (when >= 2) {
            assert_true(isnan(gradient[SCREE_AVERAGE_LIAO][0]));
        } else {
            near(gradient[SCREE_AVERAGE_LIAO][0], cos(turn) - 1, 1e-13);
            near(gradient[SCREE_AVERAGE_LIAO][1], sin(turn), 1e-13);
        }
        assert_true(isfinite(gradient[SCREE_AVERAGE_CAMBOU][0]));
        scree_release(&before.grain);
        scree_average_sample_destroy(&s);
    }
}

/// How the cell of an earlier instant comes to be another one.
typedef struct cell_of {
    double taken; ///< multiples of the first lattice vector that have been taken from the second one
    bool known;   ///< the lattices at the begin of the loading are: that of the earlier instant, before a gradient
    double begun[9];
} cell_of;

/// A grid of shaken discs in a skewed cell, which is strained and moved, all put back into the cell; contacts go across
/// its faces.
static scree_average_sample moved_cell(const double gradient[9], const cell_of *of)
{
    enum { N = 9 };
    scree_average_sample s = average_begin(2), before;
    scree_error error;
    double inverse[9], fraction[3], way[3];
    s.directions = 3;
    memcpy(s.lattice, (double[9]){N, 2, 0, 0, N, 0, 0, 0, 1}, sizeof s.lattice);
    for (size_t k = 0; k < N * N; k++)
        (void)average_add(&s, (double)(k % N) + 0.3 * average_random(k) + 2.0 / N * (double)(k / N),
                          (double)(k / N) + 0.3 * average_random(k + 500), 0, 0.5);
    before = s;
    assert_int_equal(scree_allocate(&before.grain, s.bodies, sizeof *before.grain, NULL), SCREE_OK);
    memcpy(before.grain, s.grain, s.bodies * sizeof *s.grain);
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            for (int l = 0; l < 2; l++) s.lattice[3 * i + j] += gradient[3 * i + l] * before.lattice[3 * l + j];
    if (of->known) {
        scree_matrix_multiply(of->begun, before.lattice, before.reference);
        memcpy(s.reference, before.reference, sizeof s.reference);
    }
    for (int i = 0; i < 2; i++) {
        s.lattice[3 * i + 1] -= of->taken * s.lattice[3 * i];
        s.reference[3 * i + 1] -= of->taken * s.reference[3 * i];
    }
    scree_matrix_invert(s.lattice, inverse);
    for (size_t p = 0; p < s.bodies; p++) {
        double *x = s.grain[p].position;
        scree_matrix_apply(gradient, before.grain[p].position, way);
        for (int i = 0; i < 2; i++) x[i] += way[i] + 2.5;
        scree_matrix_apply(inverse, x, fraction);
        for (int i = 0; i < 2; i++) fraction[i] -= floor(fraction[i]);
        scree_matrix_apply(s.lattice, fraction, x);
    }
    for (uint32_t k = 0; k < N * N; k++)
        for (int axis = 0; axis < 2; axis++) {
            const uint32_t next = axis == 0 ? (k % N == N - 1 ? k - (N - 1) : k + 1) : (k + N) % (N * N);
            average_touch(&s, k, next, (double[3]){1, 0, 0});
            double *branch = s.contact[s.contacts - 1].branch;
            scree_matrix_apply(inverse, branch, fraction);
            for (int i = 0; i < 2; i++) fraction[i] -= round(fraction[i]);
            scree_matrix_apply(s.lattice, fraction, branch);
            scree_along(s.grain[k].position, -0.5, branch, s.contact[s.contacts - 1].point);
        }
    check(scree_average_move(&s, &before, &error), &error);
    scree_release(&before.grain);
    average_finish(&s);
    check(scree_average_sample_repeat(&s, 5, &error), &error);
    return s;
}

/// The strain of a cell whose bodies go round, also in an element across a corner of the cell.
static void examine_cell(const double gradient[9], const cell_of *of)
{
    enum { CORNER, MIDDLE };
    scree_average_sample s = moved_cell(gradient, of);
    scree_error error;
    scree_average_bins bins;
    scree_average_strain strain;
    check(scree_average_bins_make(&s, 1, &bins, &error), &error);
    check(scree_average_strain_open(&s, &bins, &strain, &error), &error);
    for (int where = CORNER; where <= MIDDLE; where++) {
        double found[SCREE_AVERAGE_STRAINS][9];
        scree_vector displacement, middle = {where * 5.0, where * 4.5, 0};
        const scree_average_element element = scree_average_element_at(middle, (double[3]){4.5, 4.5, 0});
        scree_average_strain_find(&strain, &element, displacement, found);
        for (int d = 0; d < SCREE_AVERAGE_STRAINS; d++)
            for (int i = 0; i < 2 && d != SCREE_AVERAGE_LIAO; i++)
                for (int j = 0; j < 2; j++) near(found[d][3 * i + j], gradient[3 * i + j], 1e-12);
    }
    // Smooth strains at a corner of the cell and in it.
    const scree_average_points points = {.number = {2, 2, 1}, .first = {0, 0, 0}, .gap = {5, 4, 1}};
    double smooth[4][9], displacement[4][2];
    check(scree_average_kernel_strain_find(&s, 2.5, &points, displacement[0], smooth, &error), &error);
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 2; j++) near(smooth[k][3 * i + j], gradient[3 * i + j], 1e-11);
    scree_average_strain_close(&strain);
    scree_average_bins_destroy(&bins);
    scree_average_sample_destroy(&s);
}

static void test_cell(void **state)
{
    (void)state;
    examine_cell((double[9]){0.02, 0.1, 0, -0.01, -0.03}, &(cell_of){0});
}

/// A cell in shear leans over more and more, until a lattice vector is taken from the other: the same lattice by other
/// vectors. Its strain goes on; that of the vectors as they stand would be 0.4 - 1, and 3.3 - 3.
static void test_cell_that_leans_over(void **state)
{
    (void)state;
    examine_cell((double[9]){0.02, 0.4, 0, -0.01, -0.03}, &(cell_of){.taken = 1});
    examine_cell((double[9]){-0.3, 0.4, 0, 0, 0.2}, &(cell_of){.taken = 1});
    // Any strain, where the loading began with the earlier lattice, and where it began before.
    examine_cell((double[9]){0.02, 3.3, 0, 0, -0.03}, &(cell_of){3, true, {1, 0, 0, 0, 1, 0, 0, 0, 1}});
    examine_cell((double[9]){0.02, 3.3, 0, 0, -0.03}, &(cell_of){3, true, {1.1, -0.4, 0, 0.02, 1.3, 0, 0, 0, 1}});
}

/// What cannot be found is NAN and not zero; what cannot be compared is refused.
static void test_refused(void **state)
{
    (void)state;
    const double none[9] = {0};
    scree_error error;
    scree_average_sample s = moved(2, none, 0, NULL), other = average_begin(2);
    assert_int_equal(scree_average_move(&s, &other, &error), SCREE_ERROR_INPUT);
    other.directions = 1;
    assert_int_equal(scree_average_move(&s, &other, &error), SCREE_ERROR_INPUT);
    scree_average_bins bins;
    scree_average_strain strain;
    scree_vector displacement;
    double gradient[SCREE_AVERAGE_STRAINS][9];
    check(scree_average_bins_make(&s, 1, &bins, &error), &error);
    check(scree_average_strain_open(&s, &bins, &strain, &error), &error);
    const scree_average_element away = {{100, 100, 0}, {101, 101, 0}};
    scree_average_strain_find(&strain, &away, displacement, gradient);
    for (int d = 0; d < SCREE_AVERAGE_STRAINS; d++) assert_true(isnan(gradient[d][0]));
    assert_true(isnan(displacement[0]));
    scree_average_strain_close(&strain);
    scree_average_bins_destroy(&bins);
    scree_average_sample_destroy(&s);
    scree_average_sample_destroy(&other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_affine),
        cmocka_unit_test(test_rotation),
        cmocka_unit_test(test_turning),
        cmocka_unit_test(test_cell),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_spheres),
        cmocka_unit_test(test_own_turns),
        cmocka_unit_test(test_counted_anew),
        cmocka_unit_test(test_cell_that_leans_over),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
