/// Overlaps of discs with discs and polygons, and of both with half-planes: closed forms, gradients against
/// differences, flags.
#include "base/random.h"
#include "shape/disc_overlap.h"
#include "shape/half_plane_overlap.h"
#include "shape/polygon_make.h"
#include "shape/polygon_pair.h"
#include "testing.h"

#include <string.h>

/// A closed form of some ten operations, of terms of this size.
static void near(double value, double expected, double size)
{
    if (!(fabs(value - expected) <= 32 * 0x1p-53 * size)) fail_msg("%.17g is not %.17g", value, expected);
}

static void near_point(const double value[2], double x, double y)
{
    near(value[0], x, 4);
    near(value[1], y, 4);
}

static scree_polygon polygon_of(int count, const double (*corner)[2])
{
    scree_polygon p = {.corner = corner, .count = count};
    p.radius = scree_polygon_measure(count, corner).radius;
    for (int k = 0; k < count; k++) p.bound = fmax(p.bound, hypot(corner[k][0], corner[k][1]));
    return p;
}

static double draw(uint64_t id, uint64_t k, double low, double high)
{
    return low + (high - low) * scree_random_uniform(11, SCREE_RANDOM_TEST, id << 4 | k);
}

// ---- discs ---------------------------------------------------------------------------------------------------------

static void test_lens(void **state)
{
    (void)state;
    scree_overlap o;
    for (double distance = 0.25; distance < 2; distance += 0.25) {
        const double apart[2] = {0.6 * distance, -0.8 * distance};
        assert_true(scree_disc_overlap((const double[2]){1, 1}, apart, &o));
        double root = sqrt(4 - distance * distance);
        near(o.area, 2 * acos(distance / 2) - distance / 2 * root, 4);
        near_point(o.chord, 0.6 * root, -0.8 * root);
        near_point(o.arm[0], apart[0] / 2, apart[1] / 2);
        near_point(o.arm[1], -apart[0] / 2, -apart[1] / 2);
        assert_int_equal(o.crossings, 2);
    }
    // A thin lens of depth d: A = 4/3 sqrt(R) d^1.5 (1 + O(d/R)), so A/l goes with d^1.5 as R says; the whole of it
    // in relative terms, whatever d.
    for (double depth = 0x1p-10; depth > 1e-15; depth /= 4) {
        const double apart[2] = {2 - depth, 0};
        assert_true(scree_disc_overlap((const double[2]){1, 1}, apart, &o));
        double thin = 4 / 3.0 * depth * sqrt(depth);
        assert_true(fabs(o.area - thin) < (depth + 32 * 0x1p-53) * thin);
    }
    // Half a disc, seen by a very large one: pi/2 up to the sagitta R/1e6 across 2 R.
    assert_true(scree_disc_overlap((const double[2]){1, 1e6}, (const double[2]){1e6, 0}, &o));
    assert_true(fabs(o.area - M_PI / 2) < 1e-6);
    assert_false(scree_disc_overlap((const double[2]){1, 1}, (const double[2]){2, 0}, &o));
    for (int k = 0; k < 2; k++) {
        const double radius[2] = {k ? 1 : 3, k ? 3 : 1};
        assert_true(scree_disc_overlap(radius, (const double[2]){0.5, 0.25}, &o));
        near(o.area, M_PI, 4);
        near_point(o.arm[k], k ? -0.5 : 0.5, k ? -0.25 : 0.25);
        assert_true(o.flags & SCREE_OVERLAP_INSIDE);
    }
    assert_true(scree_disc_overlap((const double[2]){1, 1}, (const double[2]){NAN, 0}, &o));
    assert_true(o.flags & SCREE_OVERLAP_INSIDE);
}

static void test_exchange(void **state)
{
    (void)state;
    int met = 0;
    for (uint64_t id = 0; id < 2000; id++) {
        const double radius[2] = {draw(id, 0, 0.1, 2), draw(id, 1, 0.1, 2)}, other[2] = {radius[1], radius[0]};
        const double apart[2] = {draw(id, 2, -2, 2), draw(id, 3, -2, 2)}, back[2] = {-apart[0], -apart[1]};
        scree_overlap o = {0}, p = {0};
        bool touch = scree_disc_overlap(radius, apart, &o);
        assert_int_equal(scree_disc_overlap(other, back, &p), touch);
        met += touch;
        scree_overlap_exchange(&p);
        assert_true(o.area == p.area && o.chord[0] == p.chord[0] && o.chord[1] == p.chord[1] && o.flags == p.flags);
        assert_memory_equal(o.arm, p.arm, sizeof o.arm);
    }
    assert_true(met > 500);
}

// ---- half-planes
// -----------------------------------------------------------------------------------------------------

/// A half-plane is a polygon so large that its other sides are out of reach.
static void test_half_plane_is_polygon(void **state)
{
    (void)state;
    int met = 0;
    for (uint64_t id = 0; id < 3000; id++) {
        double corner[SCREE_POLYGON_CORNERS][2], wall[4][2];
        const double box[4][2] = {{-8, -8}, {8, -8}, {8, 0}, {-8, 0}};
        assert_int_equal(scree_polygon_make_on_ellipse(4, id, 3 + (int)(id % 9), draw(id, 0, 1, 3),
                                                       SCREE_POLYGON_SECTORS, 1, corner, NULL),
                         0);
        double angle = draw(id, 1, 0, 7), height = draw(id, 2, -1.5, 2.5);
        const double normal[2] = {-sin(angle), cos(angle)};
        scree_polygon_turn(4, box, cos(angle), sin(angle), wall);
        scree_polygon p = polygon_of(3 + (int)(id % 9), (const double(*)[2])corner);
        scree_polygon w = polygon_of(4, (const double(*)[2])wall);
        scree_overlap a = {0}, b = {0};
        int hint = 0;
        const double apart[2] = {-height * normal[0], -height * normal[1]};
        bool touch = scree_polygon_half_plane_overlap(&p, normal, height, &a);
        assert_int_equal(scree_polygon_pair_overlap(&p, &w, apart, &hint, &b), touch);
        if (!touch) continue;
        met++;
        // The corners of the wall are rounded at a distance of 10; what crosses it does so at 0.05 rad or more, but for
        // few.
        near(a.area, b.area, 10 * 10);
        assert_int_equal(a.flags & SCREE_OVERLAP_INSIDE, b.flags & SCREE_OVERLAP_INSIDE);
        if (a.flags & SCREE_OVERLAP_INSIDE) continue;
        assert_int_equal(a.crossings, 2);
        double off = 0;
        for (int i = 0; i < 2; i++) {
            off = fmax(off, fabs(a.chord[i] - b.chord[i]));
            for (int c = 0; c < 2; c++) off = fmax(off, fabs(a.arm[c][i] - b.arm[c][i]));
        }
        assert_true(off < 1e-11);
        assert_true(a.chord[0] * normal[1] - a.chord[1] * normal[0] == 0 ||
                    fabs(a.chord[0] * normal[1] - a.chord[1] * normal[0]) < 1e-15);
    }
    assert_true(met > 1500);
}

static void test_half_plane_closed_forms(void **state)
{
    (void)state;
    const double square[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, up[2] = {0, 1};
    scree_polygon box = polygon_of(4, square);
    scree_overlap o;
    assert_true(scree_polygon_half_plane_overlap(&box, up, 0.75, &o));
    near(o.area, 0.5, 1);
    near_point(o.chord, 0, -2);
    near_point(o.arm[0], 0, -0.75);
    near_point(o.arm[1], 0, 0);
    assert_false(scree_polygon_half_plane_overlap(&box, up, 1, &o));
    assert_true(scree_polygon_half_plane_overlap(&box, up, -1.5, &o));
    assert_true(o.area == 4 && o.flags & SCREE_OVERLAP_INSIDE);
    assert_true(scree_disc_half_plane_overlap(1, up, 0, &o));
    near(o.area, M_PI / 2, 2);
    near_point(o.chord, 0, -2);
    assert_int_equal(o.flags, SCREE_OVERLAP_NEAR_CENTRE);
    assert_true(scree_disc_half_plane_overlap(1, up, 0.5, &o));
    near(o.area, M_PI / 3 - sqrt(3) / 4, 1);
    near_point(o.chord, 0, -sqrt(3));
    near_point(o.arm[0], 0, -0.5);
    assert_true(scree_disc_half_plane_overlap(1, up, -0.5, &o));
    near(o.area, M_PI - M_PI / 3 + sqrt(3) / 4, 4);
    assert_false(scree_disc_half_plane_overlap(1, up, 1, &o));
    assert_true(scree_disc_half_plane_overlap(1, up, -1, &o));
    near(o.area, M_PI, 4);
    assert_true(o.flags & SCREE_OVERLAP_INSIDE);
    assert_true(scree_disc_half_plane_overlap(1, up, NAN, &o) && o.flags & SCREE_OVERLAP_INSIDE);
    assert_true(scree_polygon_half_plane_overlap(&box, up, NAN, &o) && o.flags & SCREE_OVERLAP_INSIDE);
}

// ---- disc and polygon
// ------------------------------------------------------------------------------------------------

static void test_disc_and_square(void **state)
{
    (void)state;
    const double square[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    scree_polygon box = polygon_of(4, square);
    scree_overlap o, p;
    // Against the middle of an edge it is a half-plane.
    for (double depth = 0.5; depth > 1e-9; depth /= 8) {
        assert_true(scree_disc_overlap_polygon(0.5, &box, (const double[2]){0.25, -1.5 + depth}, &o));
        assert_true(scree_disc_half_plane_overlap(0.5, (const double[2]){0, 1}, 0.5 - depth, &p));
        assert_true(fabs(o.area - p.area) <= 32 * 0x1p-53 * hypot(p.chord[0], p.chord[1]));
        // The half chord is a root of a difference: half an error of R over the depth.
        assert_true(fabs(o.chord[1] - p.chord[1]) < 8 * 0x1p-53 / depth);
        assert_true(fabs(o.chord[0]) < 1e-15);
        near_point(o.arm[0], p.arm[0][0], p.arm[0][1]);
    }
    // Its centre on a corner: a quarter, and the chord turned by 45 degrees.
    assert_true(scree_disc_overlap_polygon(0.5, &box, (const double[2]){1, 1}, &o));
    near(o.area, M_PI / 16, 1);
    near_point(o.chord, 0.5, 0.5);
    near_point(o.arm[0], 0.25, 0.25);
    // Across all four edges: four caps less than the disc; nothing pushes.
    assert_true(scree_disc_overlap_polygon(1.25, &box, (const double[2]){0, 0}, &o));
    near(o.area, M_PI * 1.25 * 1.25 - 4 * scree_disc_cap(1.25, 0.75, 1), 5);
    assert_int_equal(o.crossings, 8);
    assert_true(o.flags & SCREE_OVERLAP_NO_POINT);
    // One inside the other, both ways, and beside a corner.
    assert_true(scree_disc_overlap_polygon(0.5, &box, (const double[2]){0.25, 0}, &o));
    near(o.area, M_PI / 4, 1);
    assert_true(o.flags & SCREE_OVERLAP_INSIDE);
    assert_true(scree_disc_overlap_polygon(2, &box, (const double[2]){0.25, 0}, &o));
    assert_true(o.area == 4 && o.flags & SCREE_OVERLAP_INSIDE);
    near_point(o.arm[0], 0.25, 0);
    near_point(o.arm[1], 0, 0);
    assert_false(scree_disc_overlap_polygon(0.5, &box, (const double[2]){1.4, 1.4}, &o));
    assert_false(scree_disc_overlap_polygon(0.5, &box, (const double[2]){1.51, 0}, &o));
    assert_true(scree_disc_overlap_polygon(0.5, &box, (const double[2]){1.35, 1.35}, &o));
    assert_true(scree_disc_overlap_polygon(0.5, &box, (const double[2]){NAN, 0}, &o));
    assert_true(o.flags & SCREE_OVERLAP_INSIDE);
}

typedef struct sample {
    double corner[SCREE_POLYGON_CORNERS][2], radius, apart[2];
    int count;
} sample;

static bool overlap_at(const sample *s, const double motion[3], double size, scree_overlap *o)
{
    double turned[SCREE_POLYGON_CORNERS][2], angle = motion[2] * size;
    scree_polygon_turn(s->count, (const double(*)[2])s->corner, cos(angle), sin(angle), turned);
    scree_polygon p = polygon_of(s->count, (const double(*)[2])turned);
    const double apart[2] = {s->apart[0] + motion[0] * size, s->apart[1] + motion[1] * size};
    return scree_disc_overlap_polygon(s->radius, &p, apart, o);
}

static double area_at(const sample *s, const double motion[3], double size)
{
    scree_overlap o;
    return overlap_at(s, motion, size, &o) ? o.area : 0;
}

/// Chord and arms against differences over h and h/2, whose own difference bounds the error: the area is smooth between
/// the poses where a corner meets the circle; where that lies between, neither means anything. Areas are wrong by some
/// u.
static void test_gradient(void **state)
{
    (void)state;
    const double motions[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, -0.25, 0.75}}, h = 0x1p-14;
    int told = 0, met = 0, more = 0;
    for (uint64_t id = 0; id < 4000; id++) {
        sample s = {.count = 3 + (int)(id % 7), .radius = draw(id, 0, 0.3, 1.5)};
        scree_overlap o = {0};
        for (int i = 0; i < 2; i++) s.apart[i] = draw(id, (uint64_t)i + 1, -1.5, 1.5);
        assert_int_equal(
            scree_polygon_make_on_ellipse(8, id, s.count, draw(id, 3, 1, 3), SCREE_POLYGON_SECTORS, 1, s.corner, NULL),
            0);
        if (!overlap_at(&s, motions[0], 0, &o) || o.flags & (SCREE_OVERLAP_INSIDE | SCREE_OVERLAP_NO_POINT)) continue;
        met++;
        more += o.crossings > 2;
        // Nothing turns a disc.
        assert_true(fabs(o.arm[0][0] * o.chord[1] - o.arm[0][1] * o.chord[0]) < 1e-15);
        for (int m = 0; m < 4; m++) {
            const double velocity[2][2] = {{0, 0}, {motions[m][0], motions[m][1]}}, spin[2] = {5, motions[m][2]};
            double rate = scree_overlap_rate(&o, velocity, spin);
            double far = (area_at(&s, motions[m], h) - area_at(&s, motions[m], -h)) / (2 * h);
            double close = (area_at(&s, motions[m], h / 2) - area_at(&s, motions[m], -h / 2)) / h;
            double error = 4 * fabs(far - close) + 100 * 0x1p-53 / h;
            if (error > 1e-3) continue;
            told++;
            if (!(fabs(close - rate) <= error))
                fail_msg("%d: rate %.15g, differences %.15g +- %g", (int)id, rate, close, error);
        }
    }
    assert_true(met > 1500 && more > 300 && told > 3 * met);
}

/// A corner goes into the disc, then out at the far side; an edge is crossed: nothing jumps.
static void test_continuity(void **state)
{
    (void)state;
    const double spike[3][2] = {{-0.5, -1}, {0.5, -1}, {0, 2}};
    const struct {
        double apart[2], shift[2], turn;
    } paths[] = {
        {{0, -3}, {0.5, 1}, 0.2}, {{0.1, -1.005}, {0, 1}, 0.3}, {{0.75, -1}, {1, 0.2}, 1}, {{1.2, 0}, {-1, 0.1}, 0.5}};
    for (size_t k = 0; k < sizeof paths / sizeof *paths; k++) {
        sample s = {.count = 3, .radius = 1, .apart = {paths[k].apart[0], paths[k].apart[1]}};
        memcpy(s.corner, spike, sizeof spike);
        const double motion[3] = {paths[k].shift[0], paths[k].shift[1], paths[k].turn};
        scree_overlap before = {0};
        // Depths that begin at nothing make the chord grow with the root: from 0.05 on its slope is below 20.
        bool had = false;
        int steps = 0;
        for (double at = -0.2; at < 0.2; at += 0x1p-14) {
            scree_overlap now = {0};
            bool has = overlap_at(&s, motion, at, &now) && now.area > 1e-3;
            double jump = 0;
            for (int i = 0; i < 2 && has && had; i++) {
                jump = fmax(jump, fabs(now.chord[i] - before.chord[i]));
                for (int c = 0; c < 2; c++) jump = fmax(jump, fabs(now.arm[c][i] - before.arm[c][i]));
            }
            if (!(jump < 20 * 0x1p-14)) fail_msg("path %d at %g: %g", (int)k, at, jump);
            steps += has && had;
            before = now;
            had = has;
        }
        assert_true(steps > 1000);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lens),
        cmocka_unit_test(test_exchange),
        cmocka_unit_test(test_half_plane_is_polygon),
        cmocka_unit_test(test_half_plane_closed_forms),
        cmocka_unit_test(test_disc_and_square),
        cmocka_unit_test(test_gradient),
        cmocka_unit_test(test_continuity),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
