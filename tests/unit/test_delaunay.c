/// Triangulation against brute force; the boundary loop of violently deformed samples.
#include "testing.h"

#include "base/random.h"
#include "search/delaunay.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#define SEED 7

typedef struct cloud {
    double *points, *radius;
    size_t count;
} cloud;

static double uniform(uint64_t counter)
{
    return scree_random_uniform(SEED, SCREE_RANDOM_TEST, counter);
}

static cloud cloud_create(size_t count)
{
    cloud c = {.count = count};
    assert_int_equal(scree_allocate(&c.points, 2 * count, sizeof *c.points, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&c.radius, count, sizeof *c.radius, NULL), SCREE_OK);
    for (size_t i = 0; i < count; i++) c.radius[i] = 0.5;
    return c;
}

static void cloud_destroy(cloud *c)
{
    scree_release(&c->points);
    scree_release(&c->radius);
}

/// Rows of discs of diameter 1, twice as high as wide, hexagonal or square, each moved by up to `noise`.
static cloud packing(size_t columns, bool hexagonal, double noise, uint64_t variant)
{
    size_t rows = 2 * columns;
    cloud c = cloud_create(columns * rows);
    for (size_t i = 0; i < c.count; i++) {
        size_t row = i / columns, column = i % columns;
        double step = hexagonal ? sqrt(0.75) : 1;
        c.points[2 * i] =
            (double)column + (hexagonal && row % 2 ? 0.5 : 0) + noise * (2 * uniform(4 * (variant * 100000 + i)) - 1);
        c.points[2 * i + 1] = (double)row * step + noise * (2 * uniform(4 * (variant * 100000 + i) + 1) - 1);
    }
    return c;
}

static double cross(const double *o, const double *a, const double *b)
{
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

static bool between(const double *a, const double *b, const double *p)
{
    return fmin(a[0], b[0]) <= p[0] && p[0] <= fmax(a[0], b[0]) && fmin(a[1], b[1]) <= p[1] && p[1] <= fmax(a[1], b[1]);
}

/// Closed segments ab and cd have a point in common.
static bool segments_meet(const double *a, const double *b, const double *c, const double *d)
{
    // Segments far apart on one line: the signs below would be round-off.
    for (int i = 0; i < 2; i++)
        if (fmax(a[i], b[i]) < fmin(c[i], d[i]) || fmax(c[i], d[i]) < fmin(a[i], b[i])) return false;
    double abc = cross(a, b, c), abd = cross(a, b, d), cda = cross(c, d, a), cdb = cross(c, d, b);
    if (((abc > 0 && abd < 0) || (abc < 0 && abd > 0)) && ((cda > 0 && cdb < 0) || (cda < 0 && cdb > 0))) return true;
    return (abc == 0 && between(a, b, c)) || (abd == 0 && between(a, b, d)) || (cda == 0 && between(c, d, a)) ||
           (cdb == 0 && between(c, d, b));
}

/// Winding number of the loop about p.
static int winding(const cloud *c, const uint32_t *loop, size_t count, const double *p)
{
    int number = 0;
    for (size_t k = 0; k < count; k++) {
        const double *a = c->points + 2 * (size_t)loop[k], *b = c->points + 2 * (size_t)loop[(k + 1) % count];
        if (a[1] <= p[1] && b[1] > p[1] && cross(a, b, p) > 0) number++;
        if (a[1] > p[1] && b[1] <= p[1] && cross(a, b, p) < 0) number--;
    }
    return number;
}

/// Single, closed, simple, counter-clockwise, with all points inside or on it, from its lowest index, and as tight as
/// the rules allow: an open edge is left only where its triangle's third point is on the loop.
static void check_loop(const cloud *c, const scree_triangulation *t, const uint32_t *loop, size_t count,
                       const uint8_t *marks, double gap_limit)
{
    assert_true(count >= 3);
    uint8_t *on = NULL;
    assert_int_equal(scree_allocate(&on, c->count, 1, NULL), SCREE_OK);
    double area = 0;
    for (size_t k = 0; k < count; k++) {
        assert_true(loop[k] >= loop[0]);
        assert_int_equal(on[loop[k]], 0);
        on[loop[k]] = 1;
        area += cross(c->points + 2 * (size_t)loop[0], c->points + 2 * (size_t)loop[k],
                      c->points + 2 * (size_t)loop[(k + 1) % count]);
    }
    assert_true(area > 0);
    for (size_t j = 0; j < count; j++)
        for (size_t k = j + 2; k < count; k++) {
            if (j == 0 && k == count - 1) continue;
            assert_false(segments_meet(c->points + 2 * (size_t)loop[j], c->points + 2 * (size_t)loop[j + 1],
                                       c->points + 2 * (size_t)loop[k], c->points + 2 * (size_t)loop[(k + 1) % count]));
        }
    for (size_t i = 0; i < c->count; i++)
        if (!on[i]) assert_int_equal(winding(c, loop, count, c->points + 2 * i), 1);

    // What remains of the triangulation fills the loop; its open outer edges could not be cut.
    double remaining = 0;
    for (size_t n = 0; n < t->count; n++) {
        if (marks[n] == SCREE_TRIANGLE_CUT) continue;
        remaining += cross(c->points + 2 * (size_t)t->vertex[n][0], c->points + 2 * (size_t)t->vertex[n][1],
                           c->points + 2 * (size_t)t->vertex[n][2]);
        for (int k = 0; k < 3; k++) {
            int32_t behind = t->neighbour[n][k];
            if (behind >= 0 && marks[behind] != SCREE_TRIANGLE_CUT) continue;
            assert_int_equal(marks[n], SCREE_TRIANGLE_OUTER);
            uint32_t a = t->vertex[n][(k + 1) % 3], b = t->vertex[n][(k + 2) % 3];
            double gap = hypot(c->points[2 * b] - c->points[2 * a], c->points[2 * b + 1] - c->points[2 * a + 1]) -
                         c->radius[a] - c->radius[b];
            if (gap > gap_limit) assert_true(on[t->vertex[n][k]]);
        }
    }
    // Sums of at most 1e4 products of round-off 1e-16 each.
    assert_true(fabs(remaining - area) <= 1e-11 * area);
    scree_release(&on);
}

static void check_cloud(const cloud *c, double gap_limit, size_t *loop_count)
{
    scree_error error;
    scree_triangulation t;
    uint32_t *loop;
    uint8_t *marks;
    size_t count;
    assert_int_equal(scree_triangulation_build(c->points, c->count, &t, &error), SCREE_OK);
    assert_int_equal(scree_allocate(&marks, t.count, 1, &error), SCREE_OK);
    assert_int_equal(scree_boundary_loop(&t, c->points, c->radius, c->count, SCREE_PEEL_RULE(gap_limit), &loop, &count,
                                         marks, &error),
                     SCREE_OK);
    check_loop(c, &t, loop, count, marks, gap_limit);
    if (loop_count) *loop_count = count;
    scree_release(&loop);
    scree_release(&marks);
    scree_triangulation_destroy(&t);
}

static void triangles_are_delaunay(void **user)
{
    (void)user;
    cloud c = cloud_create(300);
    for (size_t i = 0; i < 2 * c.count; i++)
        c.points[i] = 3e-3 + 1e-3 * uniform(i); // millimetres, away from the origin
    scree_triangulation t;
    assert_int_equal(scree_triangulation_build(c.points, c.count, &t, NULL), SCREE_OK);
    size_t hull = 0;
    for (size_t n = 0; n < t.count; n++) {
        const double *a = c.points + 2 * (size_t)t.vertex[n][0], *b = c.points + 2 * (size_t)t.vertex[n][1];
        const double *d = c.points + 2 * (size_t)t.vertex[n][2];
        assert_true(cross(a, b, d) > 0);
        for (size_t i = 0; i < c.count; i++) {
            const double *p = c.points + 2 * i;
            double m[3][3];
            const double *corner[3] = {a, b, d};
            for (int k = 0; k < 3; k++) {
                m[k][0] = corner[k][0] - p[0];
                m[k][1] = corner[k][1] - p[1];
                m[k][2] = m[k][0] * m[k][0] + m[k][1] * m[k][1];
            }
            double inside = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                            m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                            m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
            // Fourth powers of 1e-3 with relative round-off 1e-15 (and Qhull's own tolerance, a few of these).
            assert_true(inside <= 1e-12 * 1e-14);
        }
        for (int k = 0; k < 3; k++) {
            int32_t behind = t.neighbour[n][k];
            hull += behind < 0;
            if (behind < 0) continue;
            int shared = 0;
            for (int i = 0; i < 3; i++)
                shared +=
                    t.vertex[behind][i] == t.vertex[n][(k + 1) % 3] || t.vertex[behind][i] == t.vertex[n][(k + 2) % 3];
            assert_int_equal(shared, 2);
        }
    }
    assert_int_equal(t.count, 2 * c.count - 2 - hull); // Euler
    scree_triangulation_destroy(&t);
    cloud_destroy(&c);
}

static void lattices_keep_their_outline(void **user)
{
    (void)user;
    size_t count;
    cloud square = packing(12, false, 0, 0);
    check_cloud(&square, 0.5, &count);
    // All points of four straight, exactly collinear sides are on the loop, none lost in a sliver.
    assert_int_equal(count, 2 * 11 + 2 * 23);
    cloud_destroy(&square);
    cloud hexagonal = packing(12, true, 0, 0);
    check_cloud(&hexagonal, 0.5, &count);
    // The zigzag sides have gaps of sqrt(3) - 1 = 0.73 between the outer discs: above the limit, so each tooth is
    // followed.
    assert_int_equal(count, 2 * 11 + 2 * 23);
    check_cloud(&hexagonal, 1.0, &count);
    // Above that gap they are not: 12 outer discs on each side, both rows of 12; two corners belong to a side and a
    // row, and the other two rows end half a diameter inwards.
    assert_int_equal(count, 2 * 12 + 2 * 12 - 2);
    cloud_destroy(&hexagonal);
}

/// n points of a circle are the corners of n - 2 triangles; round-off must not take one of them for superfluous.
static void points_of_a_circle_all_stay(void **user)
{
    (void)user;
    const size_t counts[] = {5, 64, 1600, 3249};
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
        cloud c = cloud_create(counts[k]);
        for (size_t i = 0; i < c.count; i++) {
            double angle = 2 * M_PI * (double)i / (double)c.count;
            c.points[2 * i] = cos(angle);
            c.points[2 * i + 1] = sin(angle);
        }
        scree_triangulation t;
        assert_int_equal(scree_triangulation_build(c.points, c.count, &t, NULL), SCREE_OK);
        assert_int_equal(t.count, c.count - 2);
        scree_triangulation_destroy(&t);
        cloud_destroy(&c);
    }
}

static void deformed_samples_have_one_loop(void **user)
{
    (void)user;
    for (uint64_t variant = 0; variant < 60; variant++) {
        cloud c = packing(12, variant % 3 != 0, 0.02 * (double)(variant % 7), variant);
        double f[4];
        for (uint64_t i = 0; i < 4; i++) f[i] = (i % 3 ? 0 : 1) + 0.5 * (2 * uniform(1000000 + 4 * variant + i) - 1);
        for (size_t i = 0; i < c.count; i++) {
            double *p = c.points + 2 * i, x = p[0], y = p[1];
            c.radius[i] = 0.25 + 0.25 * uniform(2000000 + i);
            // A shear band at 45 degrees: the upper half slides off by up to 4 diameters.
            if (variant % 4 == 1 && y > x + 5) {
                p[0] = x + 0.07 * (double)variant;
                p[1] = y + 0.07 * (double)variant;
            }
            // Necking: the middle is pulled in, and out in others.
            if (variant % 4 == 2)
                p[0] = 6 + (x - 6) * (1 - (variant % 8 < 4 ? 0.8 : -0.8) * exp(-pow((y - 11) / 4, 2)));
            if (variant % 4 == 3) {
                x = p[0];
                p[0] = f[0] * x + f[1] * p[1];
                p[1] = f[2] * x + f[3] * p[1];
            }
        }
        for (int limit = 0; limit < 3; limit++) check_cloud(&c, 0.1 + 0.45 * limit, NULL);
        cloud_destroy(&c);
    }
}

static void loose_clouds_have_one_loop(void **user)
{
    (void)user;
    for (uint64_t variant = 0; variant < 40; variant++) {
        cloud c = cloud_create(3 + 4 * variant);
        for (size_t i = 0; i < 2 * c.count; i++) c.points[i] = 20 * uniform(3000000 + 1000 * variant + i);
        check_cloud(&c, 0.0, NULL);
        check_cloud(&c, -10.0, NULL); // everything that may be cut is cut
        cloud_destroy(&c);
    }
}

/// The loop from the band near the outside against that of all points, where no four points are cocircular.
static void the_band_gives_the_loop_of_all(void **user)
{
    (void)user;
    for (uint64_t variant = 0; variant < 24; variant++) {
        cloud c = packing(26, variant % 2, 0.15, 500 + variant);
        for (size_t i = 0; i < c.count; i++) {
            double *p = c.points + 2 * i, x = p[0];
            if (variant % 4 == 1 && p[1] > x + 10) {
                p[0] += 6;
                p[1] += 6;
            }
            // Two lobes; a deep notch; a body far away.
            if (variant % 4 == 2) p[0] = 13 + (x - 13) * (1 - 0.85 * exp(-pow((p[1] - 25) / 7, 2)));
            if (variant % 4 == 3 && p[1] > 20) p[0] += (x > 12 ? 1 : -1) * 0.3 * (p[1] - 20);
            if (variant == 20 && i == 700) p[0] = 400;
        }
        const double spacing[] = {1, 0.6, 2, 1e-6, 100};
        scree_triangulation t;
        uint32_t *whole, *banded;
        size_t whole_count, banded_count;
        for (int limit = 0; limit < 2; limit++) {
            assert_int_equal(scree_triangulation_build(c.points, c.count, &t, NULL), SCREE_OK);
            assert_int_equal(scree_boundary_loop(&t, c.points, c.radius, c.count, SCREE_PEEL_RULE(0.1 + 0.5 * limit),
                                                 &whole, &whole_count, NULL, NULL),
                             SCREE_OK);
            for (size_t k = 0; k < sizeof spacing / sizeof *spacing; k++) {
                assert_int_equal(scree_outer_loop(c.points, c.radius, c.count, spacing[k],
                                                  SCREE_PEEL_RULE(0.1 + 0.5 * limit), &banded, &banded_count, NULL),
                                 SCREE_OK);
                assert_int_equal(banded_count, whole_count);
                assert_memory_equal(banded, whole, whole_count * sizeof *whole);
                scree_release(&banded);
            }
            scree_release(&whole);
            scree_triangulation_destroy(&t);
        }
        cloud_destroy(&c);
    }
}

static void a_lone_disc_stays_on_the_loop(void **user)
{
    (void)user;
    cloud c = packing(8, true, 0.02, 3);
    c.points[2 * 40] = 60; // far to the right
    c.points[2 * 40 + 1] = 7;
    scree_triangulation t;
    uint32_t *loop;
    size_t count, spike = 0;
    assert_int_equal(scree_triangulation_build(c.points, c.count, &t, NULL), SCREE_OK);
    assert_int_equal(
        scree_boundary_loop(&t, c.points, c.radius, c.count, SCREE_PEEL_RULE(0.5), &loop, &count, NULL, NULL),
        SCREE_OK);
    while (spike < count && loop[spike] != 40) spike++;
    assert_true(spike < count);
    // The root of the spike: its two neighbours in the loop are neighbours of each other in the packing.
    uint32_t a = loop[(spike + count - 1) % count], b = loop[(spike + 1) % count];
    assert_true(hypot(c.points[2 * a] - c.points[2 * b], c.points[2 * a + 1] - c.points[2 * b + 1]) < 2.0);
    scree_release(&loop);
    scree_triangulation_destroy(&t);
    check_cloud(&c, 0.5, NULL);
    cloud_destroy(&c);
}

static void the_same_points_give_the_same_loop(void **user)
{
    (void)user;
    // A cocircular lattice, where ties abound; memory laid out anew each time.
    cloud c = packing(10, false, 0, 0);
    uint32_t *first = NULL;
    size_t first_count = 0;
    void *ballast[8] = {0};
    for (int k = 0; k < 8; k++) {
        scree_triangulation t;
        uint32_t *loop;
        size_t count;
        assert_int_equal(scree_triangulation_build(c.points, c.count, &t, NULL), SCREE_OK);
        assert_int_equal(
            scree_boundary_loop(&t, c.points, c.radius, c.count, SCREE_PEEL_RULE(-0.5), &loop, &count, NULL, NULL),
            SCREE_OK);
        if (k == 0) {
            first = loop;
            first_count = count;
        } else {
            assert_int_equal(count, first_count);
            assert_memory_equal(loop, first, count * sizeof *loop);
            scree_release(&loop);
        }
        scree_triangulation_destroy(&t);
        assert_int_equal(scree_allocate(&ballast[k], 1, 1000 + 333 * (size_t)k, NULL), SCREE_OK);
    }
    for (int k = 0; k < 8; k++) scree_release(&ballast[k]);
    scree_release(&first);
    cloud_destroy(&c);
}

static void bad_points_give_errors(void **user)
{
    (void)user;
    scree_error error;
    scree_triangulation t;
    double points[20] = {0};
    assert_int_equal(scree_triangulation_build(points, 2, &t, &error), SCREE_ERROR_GUARD);
    assert_int_equal(scree_triangulation_build(points, 10, &t, &error), SCREE_ERROR_GUARD); // all in one place
    for (int i = 0; i < 10; i++) points[2 * i] = points[2 * i + 1] = 0.1 * i;               // on a line
    assert_int_equal(scree_triangulation_build(points, 10, &t, &error), SCREE_ERROR_GUARD);
    assert_non_null(strstr(error.message, "line"));
    assert_int_equal(scree_triangulation_build(points, 3, &t, &error), SCREE_ERROR_GUARD);
    for (int i = 0; i < 20; i++) points[i] = uniform(5000000 + (uint64_t)i);
    points[18] = points[0];
    points[19] = points[1];
    assert_int_equal(scree_triangulation_build(points, 10, &t, &error), SCREE_ERROR_GUARD);
    assert_non_null(strstr(error.message, "coincides"));
    points[18] = NAN;
    assert_int_equal(scree_triangulation_build(points, 10, &t, &error), SCREE_ERROR_GUARD);
    assert_null(t.vertex);
    assert_null(t.neighbour);
}

static void failed_allocations_are_reported(void **user)
{
    (void)user;
    cloud c = packing(16, true, 0.05, 1);
    size_t before, after;
    scree_allocation_statistics(&before, NULL);
    bool failed = true;
    for (uint64_t n = 1; failed; n++) {
        scree_triangulation t = {0};
        uint32_t *loop = NULL;
        size_t count;
        scree_error error;
        scree_allocation_fail_after(n);
        scree_status status = scree_triangulation_build(c.points, c.count, &t, &error);
        if (!status)
            status =
                scree_boundary_loop(&t, c.points, c.radius, c.count, SCREE_PEEL_RULE(0.2), &loop, &count, NULL, &error);
        scree_release(&loop);
        if (!status)
            status = scree_outer_loop(c.points, c.radius, c.count, 1, SCREE_PEEL_RULE(0.2), &loop, &count, &error);
        scree_allocation_fail_after(0);
        failed = status != SCREE_OK;
        if (failed) assert_int_equal(status, SCREE_ERROR_IO);
        scree_release(&loop);
        scree_triangulation_destroy(&t);
        scree_allocation_statistics(&after, NULL);
        assert_int_equal(before, after);
        assert_true(n < 100);
    }
    cloud_destroy(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_are_delaunay),        cmocka_unit_test(lattices_keep_their_outline),
        cmocka_unit_test(points_of_a_circle_all_stay),   cmocka_unit_test(deformed_samples_have_one_loop),
        cmocka_unit_test(loose_clouds_have_one_loop),    cmocka_unit_test(the_band_gives_the_loop_of_all),
        cmocka_unit_test(a_lone_disc_stays_on_the_loop), cmocka_unit_test(the_same_points_give_the_same_loop),
        cmocka_unit_test(bad_points_give_errors),        cmocka_unit_test(failed_allocations_are_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
