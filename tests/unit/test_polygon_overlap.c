/// Overlaps of polygons with polygons: closed forms, exact areas, chord and line against differences of the area, the
/// way through degenerate poses, flags.
#include "contact/outlines.h"
#include "polygon_pairs.h"
#include "testing.h"

static scree_polygon polygon_of(int count, const double (*corner)[2])
{
    scree_polygon p = {.corner = corner, .count = count};
    p.radius = scree_polygon_measure(count, corner).radius;
    for (int k = 0; k < count; k++) p.bound = fmax(p.bound, hypot(corner[k][0], corner[k][1]));
    return p;
}

static bool meet(const scree_polygon *first, const scree_polygon *second, double x, double y, scree_overlap *overlap)
{
    int hint = 0;
    return scree_polygon_pair_overlap(first, second, (const double[2]){x, y}, &hint, overlap);
}

/// A closed form of sizes of order one, some ten operations.
static void near(double value, double expected)
{
    if (!(fabs(value - expected) <= 32 * 0x1p-53)) fail_msg("%.17g is not %.17g", value, expected);
}

static void near_point(const double value[2], double x, double y)
{
    near(value[0], x);
    near(value[1], y);
}

static const double square[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

// ---- closed forms -------------------------------------------------------------------------------------------------

static void test_rectangles(void **state)
{
    (void)state;
    scree_polygon box = polygon_of(4, square);
    scree_overlap o;
    // Corner in corner, 0.5 by 0.25: the chord goes from corner to corner of the overlap.
    assert_true(meet(&box, &box, 1.5, 1.75, &o));
    near(o.area, 0.125);
    near_point(o.chord, 0.25, 0.5);
    near_point(o.arm[0], 0.75, 0.875);
    near_point(o.arm[1], -0.75, -0.875);
    outlines_share share;
    outlines_share_put(&share, 0, &o);
    near(outlines_length(&share), hypot(0.75, 0.875) / 2);
    assert_int_equal(o.crossings, 2);
    assert_int_equal(o.flags, 0);
    // Face on face, from each side; the smaller one's sides both lie within the larger.
    const double small[4][2] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
    scree_polygon inner = polygon_of(4, small);
    const double way[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    for (int k = 0; k < 4; k++) {
        assert_true(meet(&box, &inner, 1.25 * way[k][0], 1.25 * way[k][1], &o));
        near(o.area, 0.25);
        near_point(o.chord, way[k][0], way[k][1]);
        near_point(o.arm[0], way[k][0], way[k][1]);
        assert_true(meet(&inner, &box, 1.25 * way[k][0], 1.25 * way[k][1], &o));
        near_point(o.chord, way[k][0], way[k][1]);
        near_point(o.arm[1], -way[k][0], -way[k][1]);
    }
    // Faces and corners that touch have no area.
    assert_false(meet(&box, &inner, 1.5, 0.25, &o));
    assert_false(meet(&box, &inner, 1.5, 1.5, &o));
    assert_false(meet(&box, &inner, 3, 1.5, &o));
}

/// A corner of 90 degrees, depth h, in an edge: area h^2, chord 2 h along the edge's normal, in the middle above the
/// corner.
static void test_corner_in_edge(void **state)
{
    (void)state;
    const double diamond[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    scree_polygon box = polygon_of(4, square), tip = polygon_of(4, diamond);
    for (double depth = 0.5; depth > 1e-7; depth /= 4) {
        scree_overlap o;
        assert_true(meet(&box, &tip, 0.25, 2 - depth, &o));
        near(o.area, depth * depth);
        near_point(o.chord, 0, 2 * depth);
        near_point(o.arm[0], 0.25, 1);
        near_point(o.arm[1], 0, depth - 1);
        // Approach along x does nothing; the spin of the first pushes with the arm 0.25.
        near(scree_overlap_rate(&o, (const double[2][2]){{3, 2}, {1, 1}}, (const double[2]){0, 0}), 2 * depth);
        near(scree_overlap_rate(&o, (const double[2][2]){{0, 0}, {0, 0}}, (const double[2]){1, 5}), 0.5 * depth);
    }
}

/// Bars that cross at an angle share a rhomb, 4 b b' / sin(angle), and nothing drives them apart.
static void test_crossed_bars(void **state)
{
    (void)state;
    const double bar[4][2] = {{-2, -0.25}, {2, -0.25}, {2, 0.25}, {-2, 0.25}};
    double turned[4][2];
    for (double angle = 0.5; angle < 2.7; angle += 0.25) {
        scree_polygon_turn(4, bar, cos(angle), sin(angle), turned);
        scree_polygon a = polygon_of(4, bar), b = polygon_of(4, (const double(*)[2])turned);
        scree_overlap o;
        assert_true(meet(&a, &b, 0.125, 0.0625, &o));
        near(o.area, 0.25 / sin(angle));
        assert_true(hypot(o.chord[0], o.chord[1]) < 32 * 0x1p-53 * 4);
        assert_int_equal(o.crossings, 4);
        assert_int_equal(o.flags, SCREE_OVERLAP_NO_POINT | (hypot(o.arm[0][0], o.arm[0][1]) < 0.05 * a.radius ? 2 : 0));
    }
    // A bar across a wedge is pushed to where the wedge is thin: the width of the overlap is d/2 at distance d of its
    // tip.
    const double wedge[3][2] = {{0, 0}, {4, -1}, {4, 1}},
                 across[4][2] = {{-0.25, -3}, {0.25, -3}, {0.25, 3}, {-0.25, 3}};
    scree_polygon a = polygon_of(3, wedge), b = polygon_of(4, across);
    scree_overlap o;
    assert_true(meet(&a, &b, 2, 0.125, &o));
    near(o.area, 0.5 * 1);
    near_point(o.chord, -0.25, 0);
    near(o.arm[0][1], 0);
    near(o.arm[1][1], -0.125);
    assert_int_equal(o.crossings, 4);
}

// ---- random pairs -------------------------------------------------------------------------------------------------

static void test_exact_areas(void **state)
{
    (void)state;
    static exact_clip clip;
    pair_tally tally = {0};
    exact_init(&clip);
    for (uint64_t id = 0; id < 50000; id++) {
        pair_sample sample;
        pair_make(id, &sample);
        if (!pair_check(&clip, &sample, &tally)) fail_msg("pair %d (%s)", (int)id, pair_names[sample.kind]);
    }
    // Edges that cross at 1e-16 rad: the place is off by 0.01, the area by less than the bound with that sine.
    pair_sample flat = {.kind = PAIR_PARALLEL,
                        .corner = {{{-1.7014370920494941, 0.12477852388394495},
                                    {-0.24607706341493873, -0.69725135778345038},
                                    {0.027912490510998367, -0.74033934430717085},
                                    {1.658799099424112, -0.40009788880977903},
                                    {1.6435910117032055, -0.071373298056141121},
                                    {1.0741118143302646, 0.37311502159805748},
                                    {-0.62397706281764176, 0.70919657849531736},
                                    {-1.4587891823366468, 0.53029594491579624}},
                                   {{1.8563296094654753, 0.54795294915132153},
                                    {1.9144225074732535, 1.2471103593974486},
                                    {0.83664531431603117, 2.5332119228670642},
                                    {-0.043330029237343859, 2.5510116104986214},
                                    {-0.19484013390304833, 2.3705160558492597},
                                    {0.03240684502740887, 1.162394965117032},
                                    {0.9026593049845717, 0.40704847882181827},
                                    {1.4270901248269505, 0.30325442611383324}}}};
    for (int b = 0; b < 2; b++) flat.polygon[b] = polygon_of(8, (const double(*)[2])flat.corner[b]);
    assert_true(pair_check(&clip, &flat, &tally));
    assert_int_equal(tally.flat, 1);
    exact_clear(&clip);
    // Every sort of answer was among them.
    assert_true(tally.apart > 5000 && tally.two > 5000 && tally.more > 5000 && tally.inside > 3000 && tally.thin > 100);
}

static void place(const pair_sample *s, const double shift[2], const double turn[2], pair_sample *moved)
{
    *moved = *s;
    for (int b = 0; b < 2; b++) {
        scree_polygon_turn(s->polygon[b].count, s->polygon[b].corner, cos(turn[b]), sin(turn[b]), moved->corner[b]);
        moved->polygon[b].corner = (const double(*)[2])moved->corner[b];
        moved->apart[b] = s->apart[b] + shift[b];
    }
}

static double area_at(const pair_sample *s, const double motion[4], double size)
{
    pair_sample moved;
    scree_overlap o = {0};
    const double shift[2] = {motion[0] * size, motion[1] * size}, turn[2] = {motion[2] * size, motion[3] * size};
    place(s, shift, turn, &moved);
    return meet(&moved.polygon[0], &moved.polygon[1], moved.apart[0], moved.apart[1], &o) ? o.area : 0;
}

/// The derivative of the area along a motion by differences over h and h/2. Their own difference says how far
/// the area is from a parabola there: the error of the better one is at most four times that unless the area has a
/// corner between, where neither means anything, plus what the error of the areas leaves.
static void compare_rate(const pair_sample *s, const double motion[4], double rate, uint64_t *told)
{
    const double h = 0x1p-16;
    double wide = (area_at(s, motion, h) - area_at(s, motion, -h)) / (2 * h);
    double narrow = (area_at(s, motion, h / 2) - area_at(s, motion, -h / 2)) / h;
    double error = 4 * fabs(wide - narrow) + 2 * AREA_ERROR * 0x1p-53 * 10 * 10 / h;
    if (error > 1e-3) return;
    (*told)++;
    if (!(fabs(narrow - rate) <= error)) fail_msg("rate %.15g, differences %.15g +- %g", rate, narrow, error);
}

/// Chord, wrench and rate: of motions along x and y, of turns of each body, and of everything at once.
static void test_gradient(void **state)
{
    (void)state;
    const double motions[5][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}, {0.5, -0.25, 0.75, -0.375}};
    uint64_t told = 0, met = 0, more = 0;
    for (uint64_t id = 100000; id < 124000; id++) {
        pair_sample s;
        scree_overlap o = {0};
        pair_make(id, &s);
        bool generic = s.kind == PAIR_ROUNDISH || s.kind == PAIR_MANY || s.kind == PAIR_BARS || s.kind == PAIR_NEEDLES;
        if (!generic || !meet(&s.polygon[0], &s.polygon[1], s.apart[0], s.apart[1], &o)) continue;
        if (o.flags & SCREE_OVERLAP_NO_POINT) continue;
        met++;
        more += o.crossings > 2;
        for (int m = 0; m < 5; m++) {
            const double velocity[2][2] = {{0, 0}, {motions[m][0], motions[m][1]}}, *spin = &motions[m][2];
            compare_rate(&s, motions[m], scree_overlap_rate(&o, velocity, spin), &told);
        }
    }
    assert_true(met > 3000 && more > 800 && told > 4 * met);
}

/// The least sine of the angle between an edge of one and an edge of the other.
static double least_angle(const pair_sample *s)
{
    double least = 1;
    for (int i = 0; i < s->polygon[0].count; i++)
        for (int j = 0; j < s->polygon[1].count; j++) {
            const double *a = s->corner[0][i], *b = s->corner[0][(i + 1) % s->polygon[0].count];
            const double *c = s->corner[1][j], *d = s->corner[1][(j + 1) % s->polygon[1].count];
            double u[2] = {b[0] - a[0], b[1] - a[1]}, v[2] = {d[0] - c[0], d[1] - c[1]};
            least = fmin(least, fabs(u[0] * v[1] - u[1] * v[0]) / (hypot(u[0], u[1]) * hypot(v[0], v[1])));
        }
    return least;
}

/// The pair turned as a whole. Turning moves corners by 3 u S, the method adds AREA_ERROR u S; crossings move by that
/// over the sine of the least angle, twice (before and after), and there are two to a piece.
static void test_rotation(void **state)
{
    (void)state;
    int met = 0;
    for (uint64_t id = 200000; id < 224000; id++) {
        pair_sample s, turned;
        scree_overlap o = {0}, p = {0};
        pair_make(id, &s);
        if (!meet(&s.polygon[0], &s.polygon[1], s.apart[0], s.apart[1], &o)) continue;
        double angle = 0.7 + (double)id, c = cos(angle), sine = sin(angle), sinus = least_angle(&s);
        const double none[2] = {0, 0}, both[2] = {angle, angle};
        place(&s, none, both, &turned);
        turned.apart[0] = c * s.apart[0] - sine * s.apart[1];
        turned.apart[1] = sine * s.apart[0] + c * s.apart[1];
        if (o.crossings != 2 || sinus < 1e-6 || o.area < 1e-6) continue;
        met++;
        assert_true(meet(&turned.polygon[0], &turned.polygon[1], turned.apart[0], turned.apart[1], &p));
        double size = s.polygon[0].bound + s.polygon[1].bound, error = 2 * (AREA_ERROR + 3) * 0x1p-53 * size;
        assert_true(fabs(o.area - p.area) <= error * 2 * M_PI * size);
        const double *value[3][2] = {{o.chord, p.chord}, {o.arm[0], p.arm[0]}, {o.arm[1], p.arm[1]}};
        for (int k = 0; k < 3; k++) {
            const double *x = value[k][0], *y = value[k][1];
            double off = hypot(c * x[0] - sine * x[1] - y[0], sine * x[0] + c * x[1] - y[1]);
            if (!(off <= 2 * error / sinus)) fail_msg("pair %d: off by %g, sine %g", (int)id, off, sinus);
        }
    }
    assert_true(met > 5000);
}

// ---- through degenerate poses -------------------------------------------------------------------------------------

/// A way of the pose through something degenerate at 0: `shift` of the second body and its turn, from a place.
typedef struct path {
    const char *name;
    int counts[2];
    const double (*corner[2])[2];
    double apart[2], shift[2], turn;
} path;

static bool on_path(const path *p, double s, scree_overlap *o)
{
    double turned[SCREE_POLYGON_CORNERS][2];
    scree_polygon_turn(p->counts[1], p->corner[1], cos(p->turn * s), sin(p->turn * s), turned);
    scree_polygon a = polygon_of(p->counts[0], p->corner[0]), b = polygon_of(p->counts[1], (const double(*)[2])turned);
    return meet(&a, &b, p->apart[0] + s * p->shift[0], p->apart[1] + s * p->shift[1], o);
}

static const double diamond[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
static const double wide[4][2] = {{-3, -0.5}, {3, -0.5}, {3, 0.5}, {-3, 0.5}};
static const double spike[3][2] = {{-0.5, -1}, {0.5, -1}, {0, 2}};

/// Slopes of all of these are below 20: edges are 1 to 6 long, angles 0.3 or more, no overlap is thinner than 0.1.
static void test_continuity(void **state)
{
    (void)state;
    const path paths[] = {
        {"a corner passes an end of an edge", {4, 4}, {square, diamond}, {1, 1.5}, {1, 0}, 0},
        {"a corner passes the other end, turning", {4, 4}, {square, diamond}, {-1, 1.5}, {-0.5, 0.25}, 1},
        {"an edge turns through parallel", {4, 4}, {square, wide}, {0.25, 1.25}, {0, 0}, 1},
        {"both edges stand out, turning through parallel", {4, 4}, {square, wide}, {3.25, 1.25}, {0, 0.1}, 1},
        {"a corner meets a corner", {4, 4}, {square, diamond}, {1, 0}, {0.3, 1}, 0.5},
        {"a corner goes through the far side: four crossings", {4, 3}, {wide, spike}, {0, -1.5}, {0, 1}, 0},
        {"the same, the other first", {3, 4}, {spike, wide}, {0.1, 1.5}, {0, -1}, 0},
        {"the far side, turning and shifting", {4, 3}, {wide, spike}, {1, -1.5}, {0.5, 1}, 0.3},
    };
    for (size_t k = 0; k < sizeof paths / sizeof *paths; k++)
        for (double s = 1e-2; s > 1e-11; s /= 10) {
            scree_overlap o, p, q;
            assert_true(on_path(&paths[k], -s, &o) && on_path(&paths[k], 0, &p) && on_path(&paths[k], s, &q));
            const scree_overlap *pair[2][2] = {{&o, &p}, {&p, &q}};
            for (int side = 0; side < 2; side++) {
                const scree_overlap *a = pair[side][0], *b = pair[side][1];
                double jump = fabs(a->area - b->area);
                for (int i = 0; i < 2; i++) {
                    jump = fmax(jump, fabs(a->chord[i] - b->chord[i]));
                    for (int c = 0; c < 2; c++) jump = fmax(jump, fabs(a->arm[c][i] - b->arm[c][i]));
                }
                if (!(jump <= 20 * s + 1e-14)) fail_msg("%s: %g over %g", paths[k].name, jump, s);
            }
        }
}

/// Where the chord has to jump. Faces that come to touch: its length begins with that of the shared face, the area with
/// 0. Flush sides: the area has a kink, and the chord turns by twice the shared length, up to the shift.
static void test_jumps(void **state)
{
    (void)state;
    scree_polygon box = polygon_of(4, square);
    for (double s = 1e-2; s > 1e-11; s /= 10) {
        scree_overlap o, p;
        assert_true(meet(&box, &box, 0.5, 2 - s, &o));
        near(o.area, 1.5 * s);
        near_point(o.chord, s, 1.5);
        assert_false(meet(&box, &box, 0.5, 2 + s, &p));
        assert_true(meet(&box, &box, s, 1.5, &o) && meet(&box, &box, -s, 1.5, &p));
        near(o.area, (2 - s) * 0.5);
        near(p.area, o.area);
        near_point(o.chord, 0.5, 2 - s);
        near_point(p.chord, -0.5, 2 - s);
    }
}

// ---- flags --------------------------------------------------------------------------------------------------------

static void test_flags(void **state)
{
    (void)state;
    const double small[4][2] = {{-0.25, -0.25}, {0.25, -0.25}, {0.25, 0.25}, {-0.25, 0.25}};
    scree_polygon box = polygon_of(4, square), inner = polygon_of(4, small);
    scree_overlap o;
    for (int k = 0; k < 2; k++) {
        assert_true(meet(k ? &inner : &box, k ? &box : &inner, 0.5, 0.25, &o));
        near(o.area, 0.25);
        near_point(o.chord, 0, 0);
        near_point(o.arm[k], k ? -0.5 : 0.5, k ? -0.25 : 0.25);
        near_point(o.arm[1 - k], 0, 0);
        assert_int_equal(o.flags, SCREE_OVERLAP_INSIDE | SCREE_OVERLAP_NEAR_CENTRE);
    }
    assert_true(meet(&box, &box, 0, 0, &o));
    near(o.area, 4);
    assert_true(o.flags & SCREE_OVERLAP_INSIDE);
    // The top of a slab 0.02 and 0.06 below the centre of the square, whose radius is 1.13.
    const double slab[4][2] = {{-2, -3}, {2, -3}, {2, -1}, {-2, -1}};
    scree_polygon wall = polygon_of(4, slab);
    for (int k = 0; k < 2; k++) {
        assert_true(meet(&box, &wall, 0, 1 - (k ? 0.06 : 0.02), &o));
        assert_int_equal(o.flags & SCREE_OVERLAP_NEAR_CENTRE, k ? 0 : SCREE_OVERLAP_NEAR_CENTRE);
    }
    // A pose that is not a number is noticed: a place, an angle of either.
    double broken[4][2];
    scree_polygon_turn(4, square, NAN, NAN, broken);
    scree_polygon bad = {.corner = (const double(*)[2])broken, .count = 4, .radius = 1, .bound = 2};
    const scree_polygon *pair[4][2] = {{&box, &bad}, {&bad, &box}, {&bad, &bad}, {&box, &box}};
    for (int k = 0; k < 8; k++) {
        assert_true(meet(pair[k / 2][0], pair[k / 2][1], k < 6 ? k * 0.25 : NAN, k < 7 ? 0.5 : NAN, &o));
        assert_true(o.flags & SCREE_OVERLAP_INSIDE);
    }
}

/// An edge that separates is found, and found to separate nothing any more when the pose says so.
static void test_hint(void **state)
{
    (void)state;
    scree_polygon box = polygon_of(4, square), tip = polygon_of(4, diamond);
    scree_overlap o;
    int hint = 0;
    const double apart[2] = {1.6, 1.5};
    assert_false(scree_polygon_pair_overlap(&tip, &tip, apart, &hint, &o));
    // The line of the centres separates these: no edge is looked for.
    assert_int_equal(hint, 0);
    const double beside[2] = {1.9, 0.5}, near_by[2] = {1.2, 0.5};
    const double blade[4][2] = {{-0.1, -2}, {0.1, -2}, {0.1, 2}, {-0.1, 2}};
    scree_polygon thin = polygon_of(4, blade);
    assert_false(scree_polygon_pair_overlap(&box, &thin, (const double[2]){1.2, 1.5}, &hint, &o));
    assert_int_equal(hint, 2);
    int other = 0;
    assert_false(scree_polygon_pair_overlap(&thin, &box, (const double[2]){-1.2, -1.5}, &other, &o));
    assert_int_equal(other, -2);
    // Another edge that separates them, in either order, is kept; one that does not is not.
    hint = -4;
    other = 4;
    assert_false(scree_polygon_pair_overlap(&box, &thin, (const double[2]){1.2, 1.5}, &hint, &o));
    assert_false(scree_polygon_pair_overlap(&thin, &box, (const double[2]){-1.2, -1.5}, &other, &o));
    assert_int_equal(hint, -4);
    assert_int_equal(other, 4);
    hint = 1;
    assert_false(scree_polygon_pair_overlap(&box, &thin, (const double[2]){1.2, 1.5}, &hint, &o));
    assert_int_equal(hint, 2);
    assert_false(scree_polygon_pair_overlap(&box, &thin, beside, &hint, &o));
    assert_int_equal(hint, 2);
    assert_false(scree_polygon_pair_overlap(&box, &thin, near_by, &hint, &o));
    assert_true(scree_polygon_pair_overlap(&box, &thin, (const double[2]){1.05, 0.5}, &hint, &o));
    near(o.area, 0.05 * 2);
    assert_int_equal(hint, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_rectangles),
                                       cmocka_unit_test(test_corner_in_edge),
                                       cmocka_unit_test(test_crossed_bars),
                                       cmocka_unit_test(test_exact_areas),
                                       cmocka_unit_test(test_gradient),
                                       cmocka_unit_test(test_rotation),
                                       cmocka_unit_test(test_continuity),
                                       cmocka_unit_test(test_jumps),
                                       cmocka_unit_test(test_flags),
                                       cmocka_unit_test(test_hint)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
