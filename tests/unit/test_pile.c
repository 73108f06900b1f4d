/// The measure of a pile of grains that are not round, against piles put together by hand, and the extents of outlines
/// that it is made of.
#include "run_fixture.h"

#include "measure/pile.h"
#include "shape/outline_extent.h"
#include "shape/rounding.h"
#include "source/lowest_wall.h"

/// Rectangles 1.25 times as high as wide, of the area of a disc of RADIUS, laid on their long side: CLOSE is the share
/// of their height by which they overlap. (What a case lists is looked through as if all were discs: hence the guard.)
#define RADIUS 2e-3
#define LONG   1.25
#define CLOSE  1e-4
#define TEXT                                                                                                           \
    "scree: 1\nname: laid\ngravity: [0, -9.81]\n"                                                                      \
    "materials: [{name: stone, young_modulus: 1e7 Pa, density: 2500 kg/m3, friction: 0.5}]\n"                          \
    "particles: {shape: polygon, outline: given, corners: [[0, 0], [1, 0], [1, 1.25], [0, 1.25]], thickness: 1 m,\n"   \
    "            material: stone, count: %d, distribution: equal, radius: 2 mm%s}\n"                                   \
    "contact: {law: %s}\nintegrator: {scheme: velocity_verlet, step: 1e-6 s}\n"                                        \
    "walls: [{shape: plane, name: plate, point: [0, 0], normal: [0, 1]}]\n"                                            \
    "guard: {overlap: 50 %%}\nmeasure: {samples: 50, cells: no}\noutput: {figures: no, paraview: no}\n"                \
    "stages:\n  - {stage: prepare, method: bodies, bodies: [%s]}\n  - {stage: relax, duration: 1 s}\n"

/// What the hand-made pile is, as it lies when its stage begins.
typedef struct laid {
    scree_case *c;
    scree_simulation s;
} laid;

static void lay(laid *l, int count, const char *rounding, const char *law, const char *bodies)
{
    static char text[8192];
    scree_error error;
    assert_true((size_t)snprintf(text, sizeof text, TEXT, count, rounding, law, bodies) < sizeof text);
    l->c = case_read(text, NULL, 0);
    simulation_open(l->c, 1, &l->s);
    while (!l->s.stage || !l->s.stage->loading) simulation_step(&l->s);
    check(scree_neighbours_refresh(&l->s.stage_model, &l->s.state, &l->s.work, &error), &error);
    check(scree_contact_table_build(&l->s.stage_model, &l->s.state, &l->s.work, &l->s.table, &error), &error);
}

static void clear(laid *l)
{
    scree_simulation_close(&l->s);
    scree_case_free(l->c);
}

static void measure(laid *l, bool circles, scree_pile *pile)
{
    const scree_simulation *s = &l->s;
    scree_error error;
    check(circles ? scree_pile_measure_circles(&s->stage_model, &s->state, &s->work, &s->table, pile, &error)
                  : scree_pile_measure(&s->stage_model, &s->state, &s->work, &s->table, 0, pile, &error),
          &error);
}

// ---- a stepped pile ----------------------------------------------------------------------------------------------

/// Rows of 7, 5, 3 and 1 grains, each grain above another one.
enum { ROWS = 4, COUNT = 16 };

/// Height and width of a grain.
static double high(void)
{
    return RADIUS * sqrt(M_PI / LONG);
}

static double wide(void)
{
    return LONG * high();
}

static void lay_steps(laid *l)
{
    char text[4096];
    size_t length = 0;
    for (int row = 0; row < ROWS; row++)
        for (int k = row; k < 2 * ROWS - 1 - row; k++)
            length +=
                (size_t)snprintf(text + length, sizeof text - length, "{position: [%.15g, %.15g], angle: 90 degrees}, ",
                                 (1 - CLOSE) * wide() * (k - ROWS + 1), (1 - CLOSE) * high() * (row + 0.5));
    lay(l, COUNT, "", "polygon_overlap", text);
}

/// Height of the stairs within an interval: of the highest step that reaches into it.
static double step_between(double from, double to)
{
    double height = 0;
    for (int row = 0; row < ROWS; row++) {
        const double half = (1 - CLOSE) * wide() * (ROWS - 1 - row) + 0.5 * wide();
        if (from <= half && to >= -half) height = (1 - CLOSE) * high() * (row + 0.5) + 0.5 * high();
    }
    return height;
}

/// Height, width, angles, surface and solid fraction are those of the stairs. The lowest contact lies within the
/// overlap with the plate; the foot ends with the outermost grains. The top is as wide as a grain, so its left or right
/// end is the highest point.
static void stairs_are_measured(void **unused)
{
    (void)unused;
    laid l;
    scree_pile pile;
    lay_steps(&l);
    measure(&l, false, &pile);
    const double sunk = 0.5 * CLOSE * high(), height = step_between(0, 0);
    const double half = (1 - CLOSE) * wide() * (ROWS - 1) + 0.5 * wide(), columns = ceil(2 * half / RADIUS),
                 width = 2 * half / columns;
    double area = 0;
    assert_int_equal(pile.grains, COUNT);
    assert_true(pile.base <= 1e-15 && pile.base >= -sunk - 1e-15);
    assert_true(fabs(pile.top - height) < 1e-15);
    assert_true(fabs(fabs(pile.apex) - 0.5 * wide()) < 1e-15);
    assert_int_equal(pile.columns, columns);
    assert_true(fabs(pile.left + half) < 1e-15 && fabs(pile.right - half) < 1e-14);
    assert_true(fabs(tan(pile.angle[0]) - (height - pile.base) / (pile.apex + half)) < 1e-12);
    assert_true(fabs(tan(pile.angle[1]) - (height - pile.base) / (pile.right - pile.apex)) < 1e-12);
    for (size_t k = 0; k < pile.columns; k++) {
        const double x = -half + ((double)k + 0.5) * width, wanted = step_between(x - 0.5 * width, x + 0.5 * width);
        assert_true(fabs(pile.column[k].x - x) < 1e-14);
        assert_true(fabs(pile.column[k].height - (wanted - pile.base)) < 1e-14);
        area += width * (wanted - pile.base);
    }
    assert_true(fabs(pile.solid_fraction - COUNT * M_PI * RADIUS * RADIUS / area) < 1e-12);
    scree_pile_destroy(&pile);
    clear(&l);
}

/// What decides births has the bounding circles of the same grains, whose radius is half their diagonal.
static void circles_are_larger(void **unused)
{
    (void)unused;
    laid l;
    scree_pile pile;
    lay_steps(&l);
    measure(&l, true, &pile);
    const double bound = 0.5 * hypot(high(), wide()), middle = (1 - CLOSE) * high() * (ROWS - 0.5);
    assert_true(fabs(pile.top - (middle + bound)) < 1e-15 && fabs(pile.apex) < 1e-15);
    assert_true(fabs(pile.left + (1 - CLOSE) * wide() * (ROWS - 1) + bound) < 1e-15);
    scree_pile_destroy(&pile);
    clear(&l);
}

/// A single grain with rounded corners is as high as its core and its rounding on both sides; the area of all is that
/// of the disc: LONG b^2 + 2 (1 + LONG) b r + pi r^2 = pi RADIUS^2 of a core b high, r a fifth of RADIUS.
static void rounding_counts(void **unused)
{
    (void)unused;
    laid l;
    scree_pile pile;
    const double r = 0.2 * RADIUS, edges = (1 + LONG) * r;
    const double b = (sqrt(edges * edges + LONG * M_PI * (RADIUS * RADIUS - r * r)) - edges) / LONG, half = 0.5 * b + r;
    char text[200];
    (void)snprintf(text, sizeof text, "{position: [0, %.15g], angle: 90 degrees}", (1 - CLOSE) * half);
    lay(&l, 1, ", rounding: 0.2", "linear", text);
    measure(&l, false, &pile);
    assert_int_equal(pile.grains, 1);
    assert_true(fabs(pile.top - (2 - CLOSE) * half) < 1e-15);
    assert_true(fabs(fabs(pile.apex) - 0.5 * LONG * b) < 1e-15);
    assert_true(fabs(pile.left + 0.5 * LONG * b + r) < 1e-15);
    scree_pile_destroy(&pile);
    clear(&l);
}

// ---- outlines ----------------------------------------------------------------------------------------------------

/// Numbers in [0, 1), the same in every run.
static double draw(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005U + 1442695040888963407U;
    return (double)(*seed >> 11) * 0x1p-53;
}

/// Points that the corners of a rounded outline are traced by: between two of them it is straight, which at most
/// cuts off r (1 - cos (a / 2)) where it turns by a.
enum { ARC = 1000, TRACED = 8 * ARC };

/// Lowest and highest place of a closed line between two places along x, where it is; INFINITY: nowhere.
static void walk(int count, const double (*line)[2], double from, double to, double range[2])
{
    range[0] = INFINITY, range[1] = -INFINITY;
    for (int k = 0; k < count; k++) {
        const double *a = line[k], *b = line[(k + 1) % count];
        const double low = fmax(from, fmin(a[0], b[0])), end = fmin(to, fmax(a[0], b[0]));
        if (low > end) continue;
        for (int side = 0; side < 2; side++) {
            const double x = side ? end : low,
                         y = a[0] == b[0] ? a[1] : a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
            range[0] = fmin(range[0], y);
            range[1] = fmax(range[1], y);
        }
    }
}

/// Chords, highest points over intervals and boxes of polygons inscribed in ellipses, sharp and rounded, against a walk
/// along their outlines.
static void extents_are_those_of_the_outline(void **unused)
{
    (void)unused;
    static double line[TRACED][2];
    uint64_t seed = 1;
    for (int trial = 0; trial < 400; trial++) {
        double corner[8][2], turned[8][2], all[2], wanted[2], found[2], height;
        const int count = 3 + trial % 6;
        const double rounding = trial % 2 ? 0.1 + 0.4 * draw(&seed) : 0, phase = draw(&seed), turn = 7 * draw(&seed);
        for (int k = 0; k < count; k++) {
            const double at = 2 * M_PI * (k + 0.9 * draw(&seed) + phase) / count;
            corner[k][0] = 2 * cos(at), corner[k][1] = sin(at);
        }
        scree_polygon_turn(count, (const double(*)[2])corner, cos(turn), sin(turn), turned);
        const scree_core outline = {.corner = (const double(*)[2])turned, .count = count, .rounding = rounding};
        const int points = rounding > 0 ? count * ARC : count;
        if (rounding > 0) scree_rounding_trace(count, (const double(*)[2])turned, rounding, ARC, line);
        if (rounding == 0) memcpy(line, turned, sizeof turned);
        const double cut = rounding * (1 - cos(M_PI / 2 / (ARC - 1))) + 1e-13;
        const scree_outline_extent extent = scree_outline_extent_of(&outline);
        walk(points, (const double(*)[2])line, -INFINITY, INFINITY, all);
        assert_true(fabs(extent.low[1] - all[0]) < cut && fabs(extent.high[1] - all[1]) < cut);
        assert_true(scree_outline_chord(&outline, extent.top, found) && fabs(found[1] - extent.high[1]) < 1e-14);
        for (int k = 0; k < 40; k++) {
            // Within the ends of the outline, where it is not upright and a cut along x is no larger one along y.
            const double size = extent.high[0] - extent.low[0];
            const double x = extent.low[0] + (0.1 + 0.8 * draw(&seed)) * size, half = draw(&seed) * size;
            walk(points, (const double(*)[2])line, x, x, wanted);
            assert_true(scree_outline_chord(&outline, x, found));
            assert_true(fabs(found[0] - wanted[0]) < 10 * cut && fabs(found[1] - wanted[1]) < 10 * cut);
            walk(points, (const double(*)[2])line, x - half, x + half, wanted);
            assert_true(scree_outline_highest(&outline, x, half, &height));
            assert_true(fabs(height - wanted[1]) < 10 * cut);
        }
        assert_true(!scree_outline_chord(&outline, extent.high[0] + 1e-9, found));
        assert_true(!scree_outline_highest(&outline, extent.low[0] - 0.2, 0.1, &height));
        assert_true(scree_outline_highest(&outline, extent.low[0] - 0.2, 0.21, &height));
    }
}

static void discs_have_chords(void **unused)
{
    (void)unused;
    const scree_core disc = {.rounding = 5};
    const scree_outline_extent extent = scree_outline_extent_of(&disc);
    double chord[2], height;
    assert_true(extent.low[0] == -5 && extent.high[1] == 5 && extent.top == 0);
    assert_true(scree_outline_chord(&disc, 3, chord) && chord[0] == -4 && chord[1] == 4);
    assert_true(!scree_outline_chord(&disc, 5.1, chord));
    assert_true(scree_outline_highest(&disc, -4, 1, &height) && height == 4);
    assert_true(scree_outline_highest(&disc, 4, 4.5, &height) && height == 5);
}

// ---- the lowest wall ---------------------------------------------------------------------------------------------

#define WALLS_3D                                                                                                       \
    "scree: 1\nname: below\ndimension: 3\ngravity: [0, 0, -9.81]\n"                                                    \
    "materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.5}]\n"                          \
    "particles: {shape: sphere, material: glass, count: 4, distribution: equal, radius: 1 mm}\n"                       \
    "contact: {law: hertz_mindlin}\nmeasure: {cells: no}\noutput: {figures: no, paraview: no}\n"                       \
    "walls:\n  - {shape: plane, name: slope, point: [0, 0, 0], normal: [-1, 0, 1]}\n"                                  \
    "  - {shape: plane, name: lid, point: [0, 0, 5 m], normal: [0, 0, -1]}\n"                                          \
    "  - {shape: box, name: table, lower: [0, 0, 1 m], upper: [1 m, 1 m, 1.1 m]}\n"                                    \
    "  - {shape: box, name: pit, lower: [2 m, 0, 1 m], upper: [3 m, 1 m, 1.1 m]}\n"                                    \
    "sources: [%s]\nstages: [{stage: prepare, method: empty}, {stage: pour}]\n"

/// Walls that plumb lines meet last: a plane that rises with x, at its place there, or the box on whose side the plane
/// has passed above it; lids and what lies above the source or beside the line are none. Two sources have to agree.
static void the_lowest_wall_is_found(void **unused)
{
    (void)unused;
    static const struct {
        const char *sources;
        int wall;
    } cases[] = {
        {"{source: point, place: [0.5 m, 0.5 m, 3 m], interval: 1 s}", 0},
        {"{source: point, place: [2.5 m, 0.5 m, 3 m], interval: 1 s}", 3},
        {"{source: point, place: [2.5 m, 1.5 m, 3 m], interval: 1 s}", 0},
        {"{source: line, start: [1.5 m, 0.5 m, 3 m], end: [3.3 m, 0.5 m, 3 m], interval: 1 s}", 3},
        {"{source: point, name: a, place: [0.5 m, 0.5 m, 3 m], interval: 1 s}, "
         "{source: point, name: b, place: [2.5 m, 1.5 m, 3 m], interval: 1 s}",
         0},
        {"{source: point, name: a, place: [0.5 m, 0.5 m, 3 m], interval: 1 s}, "
         "{source: point, name: b, place: [2.5 m, 0.5 m, 3 m], interval: 1 s}",
         -1},
        {"{source: point, place: [3.5 m, 0.5 m, 3 m], interval: 1 s}", -1}, // below the slope
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char text[2048];
        scree_error error;
        scree_simulation s;
        int wall;
        (void)snprintf(text, sizeof text, WALLS_3D, cases[k].sources);
        scree_case *c = case_read(text, NULL, 0);
        simulation_open(c, 1, &s);
        check(scree_source_lowest_wall(&s.model, s.work.wall_set, &wall, &error), &error);
        if (wall != cases[k].wall) fail_msg("case %zu: wall %d", k, wall);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stairs_are_measured), cmocka_unit_test(circles_are_larger),
        cmocka_unit_test(rounding_counts),     cmocka_unit_test(extents_are_those_of_the_outline),
        cmocka_unit_test(discs_have_chords),   cmocka_unit_test(the_lowest_wall_is_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
