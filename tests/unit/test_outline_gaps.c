/// Gaps between outlines: the least distance of two bodies, and the outer boundary of a sample of long grains, which
/// follows them and not bounding circles or discs of equal area, the same wherever it is looked for.
#include "run_fixture.h"

#include "boundary/pressure.h"
#include "measure/cells.h"
#include "measure/delaunay_boundary.h"
#include "search/delaunay.h"
#include "selection/selection.h"
#include "shape/core_gap.h"
#include "shape/outlines.h"
#include "shape/polygon_make.h"

// ---- of two bodies -----------------------------------------------------------------------------------------------

/// The strip between two cores across a direction, which need not be a unit vector.
static double strip_across(const scree_core *a, const scree_core *b, const double apart[2], double x, double y)
{
    const double size = hypot(x, y), u[2] = {x / size, y / size}, back[2] = {-u[0], -u[1]};
    return apart[0] * u[0] + apart[1] * u[1] - scree_core_support(a, u) - scree_core_support(b, back);
}

/// The widest strip between two bodies: the least distance of convex ones. Over directions 2 pi / 40000 apart, and
/// those of edges, at which it has a kink.
static double widest_strip(const scree_core *a, const scree_core *b, const double apart[2])
{
    double widest = -INFINITY;
    for (int k = 0; k < 40000; k++)
        widest = fmax(widest, strip_across(a, b, apart, cos(2 * M_PI * k / 40000), sin(2 * M_PI * k / 40000)));
    for (int n = 0; n < 2; n++) {
        const scree_core *core = n ? b : a;
        for (int k = 0, last = core->count - 1; k < core->count; last = k++) {
            const double *from = core->corner[last], *to = core->corner[k], way = n ? -1 : 1;
            widest = fmax(widest, strip_across(a, b, apart, way * (to[1] - from[1]), way * (from[0] - to[0])));
        }
    }
    return widest - a->rounding - b->rounding;
}

static void a_gap_is_the_least_distance(void **unused)
{
    (void)unused;
    int parted = 0, meeting = 0;
    for (uint64_t n = 0; n < 200; n++) {
        double corner[2][SCREE_POLYGON_CORNERS][2];
        scree_core core[2];
        for (int b = 0; b < 2; b++) {
            const int count = n % 4 == 3 && b ? 0 : 3 + (int)((n + (uint64_t)b) % 7);
            if (count > 0)
                assert_int_equal(scree_polygon_make_on_ellipse(5, 2 * n + (uint64_t)b, count, 1 + 0.02 * (double)n,
                                                               SCREE_POLYGON_SECTORS, 1, corner[b], NULL),
                                 SCREE_OK);
            core[b] = (scree_core){.corner = (const double(*)[2])corner[b],
                                   .count = count,
                                   .bound = SCREE_POLYGON_REACH * 3,
                                   .rounding = count == 0 ? 1
                                               : n % 2    ? 0.2
                                                          : 0};
        }
        const double apart[2] = {1 + 0.02 * (double)n, 2.5 * sin((double)n)}, back[2] = {-apart[0], -apart[1]};
        const double gap = scree_core_gap(&core[0], &core[1], apart), strip = widest_strip(&core[0], &core[1], apart);
        assert_true(gap == scree_core_gap(&core[1], &core[0], back));
        const double cores = strip + core[0].rounding + core[1].rounding;
        // A strip between corners that is 8e-5 rad askew is less by half the square of that of a distance of some 5.
        if (cores > 1e-6)
            assert_true(fabs(gap - strip) < 1e-6);
        else if (cores < -1e-6)
            assert_true(gap == -(core[0].rounding + core[1].rounding));
        // Where cores meet, the directions of their edges are all that it may have, and they are among those looked at.
        const double depth = scree_core_depth(&core[0], &core[1], apart);
        assert_true(fabs(depth + strip) < (cores > 1e-6 ? 1e-6 : 1e-12));
        assert_true(fabs(depth - scree_core_depth(&core[1], &core[0], back)) < 1e-15);
        parted += strip > 0;
        meeting += cores < -1e-6;
    }
    assert_true(parted > 80 && meeting > 20);
}

static void bars_that_cross_leave_no_gap(void **unused)
{
    (void)unused;
    const double lying[4][2] = {{-5, -0.5}, {5, -0.5}, {5, 0.5}, {-5, 0.5}},
                 standing[4][2] = {{-0.5, -5}, {0.5, -5}, {0.5, 5}, {-0.5, 5}};
    const scree_core one = {.corner = lying, .count = 4, .bound = 6},
                     other = {.corner = standing, .count = 4, .bound = 6};
    assert_true(scree_core_gap(&one, &other, (const double[2]){1, 0.25}) == 0);
    // Out over the end of one of them: half a length, half a width, less where they stand already.
    assert_true(scree_core_depth(&one, &other, (const double[2]){1, 0.25}) == 4.5);
    assert_true(scree_core_gap(&one, &other, (const double[2]){7, 0.25}) == 1.5);
    assert_true(scree_core_gap(&one, &one, (const double[2]){3, 1.25}) == 0.25);
}

static void a_gap_of_discs_is_that_of_their_radii(void **unused)
{
    (void)unused;
    for (int n = 0; n < 1000; n++) {
        const scree_core a = {.rounding = 0.1 + 0.001 * n}, b = {.rounding = 0.7 / (n + 1)};
        const double apart[2] = {sin(n), 3 * cos(2 * n)};
        assert_true(scree_core_gap(&a, &b, apart) == hypot(apart[0], apart[1]) - a.rounding - b.rounding);
    }
}

// ---- of a sample -------------------------------------------------------------------------------------------------

enum { COLUMNS = 5, ROWS = 3, GRAINS = COLUMNS * ROWS };

static const char block[] =
    "scree: 1\nname: block\nseed: 5\ngravity: [0, 0]\n"
    "materials: [{name: stone, young_modulus: 1e7 Pa, density: 5000 kg/m3, friction: 0}]\n"
    "particles: {shape: polygon, outline: given, corners: [[0, 0], [1, 0], [1, 4], [0, 4]], material: stone, "
    "thickness: 1 m, count: 15, distribution: equal, radius: 1.1283791670955126 mm}\n"
    "contact: {law: polygon_overlap}\nintegrator: {scheme: velocity_verlet}\n"
    "selections: [{select: side, name: low, side: bottom}, {select: side, name: high, side: top}, "
    "{select: side, name: left, side: left}, {select: side, name: right, side: right}]\n"
    "stages:\n- {stage: prepare, method: bodies, width: 80 mm, height: 80 mm, bodies: [%s]}\n"
    "- {stage: relax, boundary: walls, duration: 1 ms}\n"
    "walls: [{shape: plane, point: [0, -50 mm], normal: [0, 1]}]\n"
    "measure: {samples: 40, cells: no, mean_strain: yes}\noutput: {snapshots: 0, paraview: no, figures: no}\n";

/// Grains of 1 mm x 4 mm side by side and end to end, 0.01 mm between them; those of the columns from 3 on are `gap`
/// [mm] farther to the right, and the whole is turned by `turn`. gap_limit is 1.128 mm, bounding circles are of 2.06
/// mm.
static scree_simulation open_block(double gap, double turn, const char *rounding, scree_case **c)
{
    char text[8000], bodies[5000] = "";
    for (int k = 0; k < GRAINS; k++)
        (void)snprintf(bodies + strlen(bodies), sizeof bodies - strlen(bodies), "%s{position: [%d mm, %d mm]}",
                       k ? ", " : "", 5 * (1 + k % COLUMNS), 5 * (1 + k / COLUMNS));
    (void)snprintf(text, sizeof text, block, bodies);
    const char *const rounded[] = {rounding, "contact={law: linear}"};
    scree_simulation s;
    *c = case_read(text, rounded, rounding ? 2 : 0);
    simulation_open(*c, 1, &s);
    simulation_step(&s);
    for (int k = 0; k < GRAINS; k++) {
        const int column = k % COLUMNS, row = k / COLUMNS;
        // The rows are askew: with centres on a circle diagonals may turn.
        const double x = 1.01 * column + 0.02 * row + (column > 2 ? gap : 0) - 4, y = 4.01 * row + 0.001 * column - 4;
        const uint32_t at = scree_state_row_of(&s.state, (uint32_t)k);
        s.state.row[at].x = 1e-3 * (cos(turn) * x - sin(turn) * y);
        s.state.row[at].y = 1e-3 * (sin(turn) * x + cos(turn) * y);
        s.state.angle[at] = turn;
        scree_body_refer(&s.state, at);
    }
    return s;
}

/// The places of the boundary's bodies, as bits.
static unsigned boundary_of(scree_simulation *s, double *area)
{
    scree_error error;
    unsigned found = 0;
    check(scree_boundary_refresh(&s->model, &s->state, &error), &error);
    const scree_loop *loop = scree_loop_of(&s->state);
    *area = 0;
    for (size_t k = 0; k < loop->count; k++) {
        const size_t next = k + 1 < loop->count ? k + 1 : 0;
        found |= 1U << loop->id[k];
        *area += 0.5 * (loop->x[k] * loop->y[next] - loop->y[k] * loop->x[next]);
    }
    return found;
}

/// Those on any of the four sides.
static unsigned sides_of(scree_simulation *s)
{
    scree_error error;
    unsigned found = 0;
    for (int side = 0; side < 4; side++) {
        check(scree_selection_resolve(&s->model, &s->state, side, &error), &error);
        for (size_t row = 0; row < GRAINS; row++)
            if (scree_selection_has(&s->state, side, row)) found |= 1U << s->state.id[row];
    }
    return found;
}

static double area_of_cells(scree_simulation *s)
{
    scree_error error;
    scree_assembly assembly;
    scree_cells cells;
    double area = 0;
    check(scree_assembly_of_state(&s->model, &s->state, &assembly, &error), &error);
    check(scree_cells_build(&assembly, SCREE_PEEL_RULE(2 * s->model.mean_radius * s->model.upkeep.gap_limit), &cells,
                            &error),
          &error);
    for (size_t k = 0; k < cells.count; k++) area += cells.volume[k] / assembly.thickness;
    scree_cells_destroy(&cells);
    scree_assembly_destroy(&assembly);
    return area;
}

/// Those that the mean strain feels when they alone move.
static unsigned strained_by(scree_simulation *s)
{
    unsigned found = 0;
    for (size_t row = 0; row < GRAINS; row++) {
        scree_error error;
        double value[7], *place[2] = {&s->state.row[row].x, &s->state.row[row].y}, most = 0;
        for (int axis = 0; axis < 2; axis++) {
            const double was = *place[axis];
            const scree_context context = scree_step_context(s);
            *place[axis] += 1e-5;
            check(scree_module_mean_strain.columns.measure(&context, 0, value, &error), &error);
            *place[axis] = was;
            for (int k = 0; k < 7; k++)
                if (isfinite(value[k])) most = fmax(most, fabs(value[k]));
        }
        if (most > 1e-9) found |= 1U << s->state.id[row];
    }
    return found;
}

/// Bodies of the edge of the block: all but those in the middle row that are not at its ends.
static const unsigned rim = 0x7fff & ~(7U << (COLUMNS + 1));

/// The boundary is the rim and these bodies, for all who look for it.
static void check_block(double gap, double turn, const char *rounding, unsigned inner)
{
    scree_case *c;
    scree_simulation s = open_block(gap, turn, rounding, &c);
    double area;
    const unsigned found = boundary_of(&s, &area);
    if (found != (rim | inner)) fail_msg("gap %g, turn %g: %x, not %x", gap, turn, found, rim | inner);
    assert_int_equal(strained_by(&s), found);
    // What they have turned by since then changes nothing of where they began.
    for (size_t row = 0; row < GRAINS; row++) s.state.angle[row] += 0.5 * M_PI;
    assert_int_equal(strained_by(&s), found);
    for (size_t row = 0; row < GRAINS; row++) s.state.angle[row] -= 0.5 * M_PI;
    assert_true(fabs(area_of_cells(&s) / area - 1) < 1e-12);
    if (turn == 0) assert_int_equal(sides_of(&s), found);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// Columns 2 and 3 of the middle row, which lie open once the rows above and below are parted.
static const unsigned opened = 3U << (COLUMNS + 2);

static void the_boundary_follows_outlines(void **unused)
{
    (void)unused;
    static const char rounded[] =
        "particles={shape: polygon, outline: given, corners: [[0, 0], [1, 0], [1, 4], [0, 4]], rounding: 0.1, "
        "material: "
        "stone, thickness: 1 m, count: 15, distribution: equal, radius: 1.1283791670955126 mm}";
    for (int n = 0; n < 4; n++) {
        check_block(0, 0.7 * n, NULL, 0);
        check_block(1.0, 0.7 * n, NULL, 0);
        check_block(1.4, 0.7 * n, NULL, opened);
        check_block(1.0, 0.7 * n, rounded, 0);
        check_block(1.4, 0.7 * n, rounded, opened);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_gap_is_the_least_distance),
        cmocka_unit_test(bars_that_cross_leave_no_gap),
        cmocka_unit_test(a_gap_of_discs_is_that_of_their_radii),
        cmocka_unit_test(the_boundary_follows_outlines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
