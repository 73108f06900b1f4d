/// Delaunay tetrahedra against brute force; the outer surface of violently deformed samples of spheres.
#include "testing.h"

#include "base/random.h"
#include "search/band.h"
#include "search/delaunay.h"
#include "search/tetrahedra.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define SEED 11

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
    assert_int_equal(scree_allocate(&c.points, 3 * count, sizeof *c.points, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&c.radius, count, sizeof *c.radius, NULL), SCREE_OK);
    for (size_t i = 0; i < count; i++) c.radius[i] = 0.5;
    return c;
}

static void cloud_destroy(cloud *c)
{
    scree_release(&c->points);
    scree_release(&c->radius);
}

/// side x side x 2 side spheres of diameter 1, densely packed (hexagonal layers) or cubic, each moved by up to `noise`.
static cloud packing(size_t side, bool dense, double noise, uint64_t variant)
{
    cloud c = cloud_create(2 * side * side * side);
    for (size_t i = 0; i < c.count; i++) {
        double place[3] = {(double)(i % side), (double)(i / side % side), (double)(i / side / side)};
        if (dense) {
            bool odd = i / side / side % 2;
            place[0] += 0.5 * (double)(i / side % 2) + (odd ? 0.5 : 0);
            place[1] = sqrt(0.75) * place[1] + (odd ? sqrt(0.75) / 3 : 0);
            place[2] *= sqrt(2.0 / 3);
        }
        for (size_t k = 0; k < 3; k++)
            c.points[3 * i + k] = place[k] + noise * (2 * uniform(4 * (variant * 100000 + i) + k) - 1);
    }
    return c;
}

static double volume_of(const double *o, const double *a, const double *b, const double *c)
{
    double u[3], v[3], w[3];
    for (int k = 0; k < 3; k++) {
        u[k] = a[k] - o[k];
        v[k] = b[k] - o[k];
        w[k] = c[k] - o[k];
    }
    return (u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
            u[2] * (v[0] * w[1] - v[1] * w[0])) /
           6;
}

static const double *at(const cloud *c, uint32_t point)
{
    return c->points + 3 * (size_t)point;
}

/// Solid angle of a triangle seen from p (van Oosterom and Strackee 1983).
static double solid_angle(const double *p, const double *a, const double *b, const double *c)
{
    double r[3][3], length[3];
    const double *corner[3] = {a, b, c};
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) r[i][k] = corner[i][k] - p[k];
        length[i] = sqrt(r[i][0] * r[i][0] + r[i][1] * r[i][1] + r[i][2] * r[i][2]);
    }
    double dots[3];
    for (int i = 0; i < 3; i++) {
        const double *u = r[(i + 1) % 3], *v = r[(i + 2) % 3];
        dots[i] = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    }
    double below = length[0] * length[1] * length[2] + dots[0] * length[0] + dots[1] * length[1] + dots[2] * length[2];
    return 2 * atan2(6 * volume_of(p, a, b, c), below);
}

/// Place of the directed edge a-b among the triangles: 3 t + k; SIZE_MAX when there is none. Asserts that there is one
/// at most.
static size_t find_edge(const scree_triangle_surface *s, const size_t *first, const size_t *next, uint32_t a,
                        uint32_t b)
{
    size_t found = SIZE_MAX;
    for (size_t e = first[a]; e != SIZE_MAX; e = next[e]) {
        if (s->triangle[e / 3][(e % 3 + 1) % 3] != b) continue;
        assert_true(found == SIZE_MAX);
        found = e;
    }
    return found;
}

/// Closed, every edge shared by two triangles, one disc of triangles round each point, connected, Euler characteristic
/// 2, from the lowest index and ascending. Returns the number of points on it, marked in `on`.
static size_t check_sphere(const scree_triangle_surface *s, size_t count, uint8_t *on)
{
    size_t *first, *next, *degree, edges = 3 * s->count, nodes = 0;
    assert_int_equal(scree_allocate(&first, count, sizeof *first, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&degree, count, sizeof *degree, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&next, edges, sizeof *next, NULL), SCREE_OK);
    for (size_t i = 0; i < count; i++) first[i] = SIZE_MAX;
    for (size_t e = 0; e < edges; e++) {
        uint32_t v = s->triangle[e / 3][e % 3];
        next[e] = first[v];
        first[v] = e;
        degree[v]++;
        nodes += !on[v];
        on[v] = 1;
    }
    for (size_t e = 0; e < edges; e++) {
        uint32_t a = s->triangle[e / 3][e % 3], b = s->triangle[e / 3][(e % 3 + 1) % 3];
        assert_true(find_edge(s, first, next, a, b) == e);
        assert_true(find_edge(s, first, next, b, a) != SIZE_MAX);
        // Once round a: across a-c into the triangle on the other side, until the first one comes again.
        size_t turned = 0, here = e;
        do {
            uint32_t c = s->triangle[here / 3][(here % 3 + 2) % 3];
            here = find_edge(s, first, next, a, c);
            turned++;
        } while (here != e && turned <= degree[a]);
        assert_int_equal(turned, degree[a]);
    }
    for (size_t t = 0; t < s->count; t++) {
        assert_true(s->triangle[t][0] < s->triangle[t][1] && s->triangle[t][0] < s->triangle[t][2]);
        if (t > 0) assert_true(memcmp(s->triangle[t], s->triangle[t - 1], sizeof *s->triangle) != 0);
        if (t > 0) assert_true(s->triangle[t][0] >= s->triangle[t - 1][0]);
    }
    // V - E + F with E = 3 F / 2. Two separate spheres would have 4.
    assert_int_equal((long)nodes - (long)edges / 2 + (long)s->count, 2);
    scree_release(&first);
    scree_release(&next);
    scree_release(&degree);
    return nodes;
}

/// The surface is a sphere, encloses all points, and is filled by the tetrahedra that were not cut.
static void check_surface(const cloud *c, const scree_tetrahedra *t, const scree_triangle_surface *s,
                          const uint8_t *marks)
{
    uint8_t *on;
    assert_int_equal(scree_allocate(&on, c->count, 1, NULL), SCREE_OK);
    check_sphere(s, c->count, on);
    double enclosed = 0, remaining = 0, extent = 0;
    const double *o = at(c, s->triangle[0][0]);
    for (size_t n = 0; n < s->count; n++) {
        const uint32_t *v = s->triangle[n];
        enclosed += volume_of(o, at(c, v[0]), at(c, v[1]), at(c, v[2]));
    }
    for (size_t n = 0; n < t->count; n++) {
        const uint32_t *v = t->vertex[n];
        double volume = volume_of(at(c, v[0]), at(c, v[1]), at(c, v[2]), at(c, v[3]));
        extent += fabs(volume);
        if (marks[n] != SCREE_TRIANGLE_CUT) remaining += volume;
        for (int k = 0; k < 4; k++) {
            int32_t behind = t->neighbour[n][k];
            bool outer = marks[n] != SCREE_TRIANGLE_CUT && (behind < 0 || marks[behind] == SCREE_TRIANGLE_CUT);
            if (outer) assert_int_equal(marks[n], SCREE_TRIANGLE_OUTER);
        }
    }
    assert_true(enclosed > 0);
    // Sums of at most 1e4 products of round-off 1e-16 each.
    assert_true(fabs(remaining - enclosed) <= 1e-11 * extent);
    for (size_t i = 0; i < c->count; i++) {
        double angle = 0;
        if (on[i]) continue;
        for (size_t n = 0; n < s->count; n++) {
            const uint32_t *v = s->triangle[n];
            angle += solid_angle(at(c, (uint32_t)i), at(c, v[0]), at(c, v[1]), at(c, v[2]));
        }
        // Once round: an integer multiple of 4 pi, up to round-off.
        assert_true(fabs(angle / (4 * M_PI) - 1) < 1e-6);
    }
    scree_release(&on);
}

static size_t check_cloud(const cloud *c, double gap_limit)
{
    scree_error error;
    scree_tetrahedra t;
    scree_triangle_surface s;
    uint8_t *marks;
    assert_int_equal(scree_tetrahedra_build(c->points, c->count, &t, &error), SCREE_OK);
    assert_int_equal(scree_allocate(&marks, t.count, 1, &error), SCREE_OK);
    assert_int_equal(
        scree_boundary_surface(&t, c->points, c->radius, c->count, SCREE_PEEL_RULE(gap_limit), &s, marks, &error),
        SCREE_OK);
    check_surface(c, &t, &s, marks);
    size_t triangles = s.count;
    scree_triangle_surface_destroy(&s);
    scree_tetrahedra_destroy(&t);
    scree_release(&marks);
    return triangles;
}

/// Circumsphere of a tetrahedron by solving 2 (x_k - x_0) . c = |x_k - x_0|^2.
static double circumsphere(const cloud *c, const uint32_t *v, double centre[3])
{
    const double *o = at(c, v[0]), *p[3] = {at(c, v[1]), at(c, v[2]), at(c, v[3])};
    double square[3], six = 6 * volume_of(o, p[0], p[1], p[2]), radius = 0;
    for (int i = 0; i < 3; i++) {
        square[i] = 0;
        for (int k = 0; k < 3; k++) square[i] += (p[i][k] - o[k]) * (p[i][k] - o[k]);
    }
    for (int k = 0; k < 3; k++) {
        double sum = 0;
        for (int i = 0; i < 3; i++) {
            double u[3], w[3];
            for (int j = 0; j < 3; j++) {
                u[j] = p[(i + 1) % 3][j] - o[j];
                w[j] = p[(i + 2) % 3][j] - o[j];
            }
            sum += square[i] * (u[(k + 1) % 3] * w[(k + 2) % 3] - u[(k + 2) % 3] * w[(k + 1) % 3]);
        }
        centre[k] = o[k] + sum / (2 * six);
        radius += sum / (2 * six) * sum / (2 * six);
    }
    return sqrt(radius);
}

/// Neighbours are mutual and share the three points of the face; no point lies outside of a face without one: the
/// volume above it is at most `above`.
static void check_neighbours(const cloud *c, const scree_tetrahedra *t, double above)
{
    for (size_t face = 0; face < 4 * t->count; face++) {
        size_t n = face / 4, k = face % 4;
        const uint32_t *v = t->vertex[n];
        int32_t behind = t->neighbour[n][k];
        if (behind < 0) {
            for (size_t i = 0; i < c->count; i++) {
                const uint8_t *f = scree_tetrahedron_face[k];
                assert_true(volume_of(at(c, v[f[0]]), at(c, v[f[1]]), at(c, v[f[2]]), at(c, (uint32_t)i)) <= above);
            }
            continue;
        }
        size_t shared = 0, back = 0;
        for (size_t i = 0; i < 4; i++) {
            back += t->neighbour[behind][i] == (int32_t)n;
            for (size_t j = 0; j < 4; j++) shared += t->vertex[behind][i] == v[j] && j != k;
        }
        assert_int_equal(back, 1);
        assert_int_equal(shared, 3);
    }
}

/// Ascending order of tetrahedra, and within one, but for the last two corners.
static void check_order(const scree_tetrahedra *t)
{
    for (size_t n = 0; n < t->count; n++) {
        const uint32_t *v = t->vertex[n], *before = n > 0 ? t->vertex[n - 1] : NULL;
        assert_true(v[0] < v[1] && v[1] < v[2] && v[1] < v[3]);
        size_t k = 0;
        while (before && k < 3 && v[k] == before[k]) k++;
        if (before) assert_true(before[k] < v[k]);
    }
}

static void tetrahedra_are_delaunay(void **user)
{
    (void)user;
    cloud c = cloud_create(150);
    for (size_t i = 0; i < 3 * c.count; i++) c.points[i] = 1e-3 * uniform(i);
    scree_tetrahedra t;
    assert_int_equal(scree_tetrahedra_build(c.points, c.count, &t, NULL), SCREE_OK);
    for (size_t n = 0; n < t.count; n++) {
        const uint32_t *v = t.vertex[n];
        assert_true(volume_of(at(&c, v[0]), at(&c, v[1]), at(&c, v[2]), at(&c, v[3])) > 0);
        double centre[3], radius = circumsphere(&c, v, centre);
        for (size_t i = 0; i < c.count; i++) {
            double square = 0;
            for (size_t k = 0; k < 3; k++)
                square += (c.points[3 * i + k] - centre[k]) * (c.points[3 * i + k] - centre[k]);
            // Corners lie on the sphere; its centre is known to 1e-16 over the flatness of the tetrahedron.
            assert_true(sqrt(square) > radius * (1 - 1e-7));
        }
    }
    check_neighbours(&c, &t, 1e-22); // volumes are about 1e-11
    check_order(&t);
    scree_tetrahedra_destroy(&t);
    cloud_destroy(&c);
}

static void lattices_have_one_surface(void **user)
{
    (void)user;
    // Cospherical and coplanar points; nothing is open, so the box of the centres remains.
    for (int dense = 0; dense < 2; dense++)
        for (size_t side = 2; side < 6; side++) {
            cloud c = packing(side, dense, 0, 0);
            size_t triangles = check_cloud(&c, 0.5);
            size_t n = side - 1;
            scree_tetrahedra t;
            assert_int_equal(scree_tetrahedra_build(c.points, c.count, &t, NULL), SCREE_OK);
            check_neighbours(&c, &t, 1e-12); // volumes are about 0.2, flat ones 1e-16
            check_order(&t);
            scree_tetrahedra_destroy(&t);
            if (!dense) assert_int_equal(triangles, 2 * (2 * n * n + 4 * n * (2 * side - 1)));
            cloud_destroy(&c);
        }
}

/// The deformations; `amount` grows from 0 to 1.
static void deform(cloud *c, int kind, double side, double amount)
{
    for (size_t i = 0; i < c->count; i++) {
        double *x = c->points + 3 * i, middle = x[2] / side - 0.8, reach = exp(-middle * middle * 8);
        double scale = 1;
        // A band inclined by 45 degrees: what is above it slides along it.
        if (kind == 0 && x[2] > 0.8 * side + x[0] - side / 2) {
            x[0] += amount * 0.7 * side;
            x[2] += amount * 0.7 * side;
        }
        if (kind == 1) scale = 1 - 0.85 * amount * reach;
        if (kind == 2) scale = 1 + 0.8 * amount * reach;
        // Stretched apart in the middle: a gap opens.
        if (kind == 3 && middle > 0) x[2] += 3 * amount;
        // Twisted by up to half a turn.
        double angle = kind == 4 ? M_PI * amount * x[2] / (2 * side) : 0;
        double p = x[0] - side / 2, q = x[1] - side / 2;
        x[0] = side / 2 + scale * (cos(angle) * p - sin(angle) * q);
        x[1] = side / 2 + scale * (sin(angle) * p + cos(angle) * q);
    }
}

static void deformed_samples_have_one_surface(void **user)
{
    (void)user;
    for (int kind = 0; kind < 5; kind++)
        for (int stage = 1; stage <= 2; stage++) {
            cloud c = packing(5, true, 0.15, (uint64_t)kind);
            deform(&c, kind, 5, 0.5 * stage);
            size_t coarse = check_cloud(&c, 0.5), fine = check_cloud(&c, 0.1);
            assert_true(fine >= coarse);
            cloud_destroy(&c);
        }
}

static void loose_clouds_have_one_surface(void **user)
{
    (void)user;
    for (uint64_t variant = 0; variant < 12; variant++) {
        cloud c = cloud_create(20 + 20 * variant);
        for (size_t i = 0; i < 3 * c.count; i++) c.points[i] = 8 * uniform(1000 * (variant + 50) + i);
        for (size_t i = 0; i < c.count; i++) c.radius[i] = 0.2 + 0.4 * uniform(1000 * (variant + 90) + i);
        // Nothing is too open, everything is, and in between.
        size_t hull = check_cloud(&c, 100), all = check_cloud(&c, -100);
        check_cloud(&c, 0.5);
        assert_true(all >= hull);
        cloud_destroy(&c);
    }
}

static void rings_and_dumbbells_have_one_surface(void **user)
{
    (void)user;
    // A ring, whose hole stays closed by a skin.
    cloud ring = cloud_create(600);
    for (size_t i = 0; i < ring.count; i++) {
        double turn = 2 * M_PI * (double)(i / 6) / 100, round = 2 * M_PI * (double)(i % 6) / 6 + 0.3 * uniform(i);
        double reach = 10 + (0.5 + 0.5 * uniform(i + 7000)) * cos(round);
        ring.points[3 * i] = reach * cos(turn);
        ring.points[3 * i + 1] = reach * sin(turn);
        ring.points[3 * i + 2] = (0.5 + 0.5 * uniform(i + 7000)) * sin(round);
    }
    check_cloud(&ring, 0.5);
    cloud_destroy(&ring);
    // Two balls far apart.
    cloud pair = cloud_create(400);
    for (size_t i = 0; i < pair.count; i++) {
        for (size_t k = 0; k < 3; k++) pair.points[3 * i + k] = 4 * uniform(9000 + 3 * i + k);
        pair.points[3 * i] += i % 2 ? 20 : 0;
    }
    check_cloud(&pair, 0.5);
    cloud_destroy(&pair);
}

static void a_lone_sphere_stays_on_the_surface(void **user)
{
    (void)user;
    for (int distance = 1; distance < 40; distance += 6) {
        cloud c = packing(5, true, 0.1, 3);
        double *lone = c.points + 3 * 17;
        lone[0] = 5 + distance;
        lone[1] = 2.2;
        lone[2] = 4.1;
        check_cloud(&c, 0.5);
        scree_triangle_surface s;
        assert_int_equal(scree_outer_surface(c.points, c.radius, c.count, 1, SCREE_PEEL_RULE(0.5), &s, NULL), SCREE_OK);
        size_t triangles = 0;
        for (size_t t = 0; t < s.count; t++)
            for (int k = 0; k < 3; k++) triangles += s.triangle[t][k] == 17;
        assert_true(triangles >= 3);
        if (distance > 6) assert_true(triangles < 6); // a spike
        scree_triangle_surface_destroy(&s);
        cloud_destroy(&c);
    }
}

static void expect_same(const scree_triangle_surface *a, const scree_triangle_surface *b)
{
    assert_int_equal(a->count, b->count);
    assert_memory_equal(a->triangle, b->triangle, a->count * sizeof *a->triangle);
}

/// The surface from the band against that of all tetrahedra.
static void compare_with_all(const cloud *c, const scree_tetrahedra *t, double gap_limit)
{
    scree_triangle_surface band, all;
    assert_int_equal(scree_outer_surface(c->points, c->radius, c->count, 1, SCREE_PEEL_RULE(gap_limit), &band, NULL),
                     SCREE_OK);
    assert_int_equal(
        scree_boundary_surface(t, c->points, c->radius, c->count, SCREE_PEEL_RULE(gap_limit), &all, NULL, NULL),
        SCREE_OK);
    expect_same(&band, &all);
    scree_triangle_surface_destroy(&band);
    scree_triangle_surface_destroy(&all);
}

static void the_band_gives_the_surface_of_all(void **user)
{
    (void)user;
    // Undeformed the band suffices at once, sheared and widened after one extension; cut deeper, or with a body so far
    // away that the grid would be too large, all points are needed.
    const int kinds[] = {3, 0, 2};
    for (size_t n = 0; n < 3; n++) {
        cloud c = packing(19, true, 0.15, 21 + (uint64_t)kinds[n]);
        deform(&c, kinds[n], 19, kinds[n] == 3 ? 0 : 0.3);
        scree_tetrahedra t;
        assert_int_equal(scree_tetrahedra_build(c.points, c.count, &t, NULL), SCREE_OK);
        compare_with_all(&c, &t, 0.5);
        if (n == 0) compare_with_all(&c, &t, 0.1);
        scree_tetrahedra_destroy(&t);
        cloud_destroy(&c);
    }
    cloud c = packing(14, true, 0.15, 20);
    c.points[3] = 300;
    scree_tetrahedra t;
    assert_int_equal(scree_tetrahedra_build(c.points, c.count, &t, NULL), SCREE_OK);
    compare_with_all(&c, &t, 0.5);
    scree_tetrahedra_destroy(&t);
    cloud_destroy(&c);
}

static bool is_in_band(const scree_band *b, size_t point)
{
    for (size_t k = 0; k < b->count; k++)
        if (b->index[k] == point) return true;
    return false;
}

/// A sphere with a left-out point in it makes the band grow by what it holds, and is then content; after a few rounds
/// the band gives up.
static void the_band_grows_where_it_is_wanted(void **user)
{
    (void)user;
    cloud c = packing(19, true, 0.1, 70);
    scree_band b;
    assert_int_equal(scree_band_build(c.points, c.radius, c.count, 3, 1, &b, NULL), SCREE_OK);
    size_t before = b.count;
    assert_true(before > 0);
    const double *o = c.points;
    const double *near_top[4] = {o, o + 3 * 18, o + 3 * (19 * 18), o + 3 * (c.count - 1)};
    double middle[3] = {9.5, 8.2, 15.4}, outside[3] = {9.5, 8.2, -6};
    assert_false(scree_band_wants(&b, near_top, outside, 5));
    assert_true(scree_band_wants(&b, near_top, middle, 2));
    assert_true(scree_band_wants(&b, near_top, middle, 2)); // not yet in the band
    assert_int_equal(scree_band_extend(&b, NULL), SCREE_OK);
    assert_false(scree_band_wants(&b, near_top, middle, 2));
    assert_true(b.count > before && b.count < c.count);
    for (size_t i = 0; i < c.count; i++) {
        double square = 0;
        for (size_t k = 0; k < 3; k++) square += (c.points[3 * i + k] - middle[k]) * (c.points[3 * i + k] - middle[k]);
        if (square < 4) assert_true(is_in_band(&b, i));
    }
    for (size_t k = 0; k < b.count; k++) {
        if (k > 0) assert_true(b.index[k] > b.index[k - 1]);
        assert_memory_equal(b.points + 3 * k, c.points + 3 * (size_t)b.index[k], 3 * sizeof(double));
    }
    for (int round = 0; round < 20; round++) assert_int_equal(scree_band_extend(&b, NULL), SCREE_OK);
    assert_int_equal(b.count, 0);
    scree_band_destroy(&b);
    cloud_destroy(&c);
}

/// Points in general position, in another order: the same surface in other names.
static void the_order_does_not_show(void **user)
{
    (void)user;
    cloud c = packing(6, true, 0.2, 40), d = packing(6, true, 0.2, 40);
    for (size_t i = 0; i < c.count; i++) {
        size_t to = 35 * i % c.count; // 35 and 432 have no common factor
        for (size_t k = 0; k < 3; k++) d.points[3 * to + k] = c.points[3 * i + k];
    }
    scree_triangle_surface a, b;
    assert_int_equal(scree_outer_surface(c.points, c.radius, c.count, 1, SCREE_PEEL_RULE(0.3), &a, NULL), SCREE_OK);
    assert_int_equal(scree_outer_surface(d.points, d.radius, d.count, 1, SCREE_PEEL_RULE(0.3), &b, NULL), SCREE_OK);
    assert_int_equal(a.count, b.count);
    for (size_t t = 0; t < a.count; t++) {
        uint32_t v[3];
        for (int k = 0; k < 3; k++) v[k] = 35 * a.triangle[t][k] % (uint32_t)c.count;
        while (v[0] > v[1] || v[0] > v[2]) {
            uint32_t first = v[0];
            v[0] = v[1];
            v[1] = v[2];
            v[2] = first;
        }
        size_t found = 0;
        for (size_t n = 0; n < b.count; n++) found += memcmp(b.triangle[n], v, sizeof v) == 0;
        assert_int_equal(found, 1);
    }
    scree_triangle_surface_destroy(&a);
    scree_triangle_surface_destroy(&b);
    cloud_destroy(&c);
    cloud_destroy(&d);
}

static void bad_points_give_errors(void **user)
{
    (void)user;
    scree_error error;
    scree_tetrahedra t;
    scree_triangle_surface s;
    cloud c = packing(3, true, 0.1, 0);
    assert_int_equal(scree_tetrahedra_build(c.points, 3, &t, &error), SCREE_ERROR_GUARD);
    assert_non_null(strstr(error.message, "at least 4 points"));
    double kept = c.points[10];
    c.points[10] = NAN;
    assert_int_equal(scree_outer_surface(c.points, c.radius, c.count, 1, SCREE_PEEL_RULE(0.5), &s, &error),
                     SCREE_ERROR_GUARD);
    assert_non_null(strstr(error.message, "not finite"));
    c.points[10] = kept;
    memcpy(c.points, c.points + 30, 3 * sizeof(double));
    assert_int_equal(scree_outer_surface(c.points, c.radius, c.count, 1, SCREE_PEEL_RULE(0.5), &s, &error),
                     SCREE_ERROR_GUARD);
    assert_non_null(strstr(error.message, "coincides"));
    for (size_t i = 0; i < c.count; i++) c.points[3 * i + 2] = 1;
    assert_int_equal(scree_outer_surface(c.points, c.radius, c.count, 1, SCREE_PEEL_RULE(0.5), &s, &error),
                     SCREE_ERROR_GUARD);
    assert_non_null(strstr(error.message, "in a plane"));
    cloud_destroy(&c);
}

static void failed_allocations_are_reported(void **user)
{
    (void)user;
    cloud c = packing(8, true, 0.1, 5);
    scree_error error;
    bool failed = true;
    for (uint64_t n = 1; failed; n++) {
        size_t before, after;
        scree_triangle_surface s;
        scree_allocation_statistics(&before, NULL);
        scree_allocation_fail_after(n);
        scree_status status = scree_outer_surface(c.points, c.radius, c.count, 1, SCREE_PEEL_RULE(0.2), &s, &error);
        scree_allocation_fail_after(0);
        failed = status != SCREE_OK;
        if (failed) assert_int_equal(status, SCREE_ERROR_IO);
        scree_triangle_surface_destroy(&s);
        scree_allocation_statistics(&after, NULL);
        assert_int_equal(before, after);
        assert_true(n < 100);
    }
    cloud_destroy(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tetrahedra_are_delaunay),
        cmocka_unit_test(lattices_have_one_surface),
        cmocka_unit_test(deformed_samples_have_one_surface),
        cmocka_unit_test(loose_clouds_have_one_surface),
        cmocka_unit_test(rings_and_dumbbells_have_one_surface),
        cmocka_unit_test(a_lone_sphere_stays_on_the_surface),
        cmocka_unit_test(the_band_gives_the_surface_of_all),
        cmocka_unit_test(the_band_grows_where_it_is_wanted),
        cmocka_unit_test(the_order_does_not_show),
        cmocka_unit_test(bad_points_give_errors),
        cmocka_unit_test(failed_allocations_are_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
