/// Polygons with rounded corners: measures against closed forms and a sum over a grid; overlap, gain and line of action
/// of closest features against closed forms, and against the gradient of the overlap; rates of the middle of the step;
/// exchange, rotation, where features come and go; cores that meet.
#include "testing.h"

#include "contact/rounded.h"
#include "shape/polygon_make.h"
#include "shape/rounding.h"

#include <math.h>
#include <string.h>

/// Numbers in [0, 1), the same in every run.
static double draw(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005U + 1442695040888963407U;
    return (double)(*seed >> 11) * 0x1p-53;
}

// ---- bodies --------------------------------------------------------------------------------------------------------

/// A body that tests pose by hand.
typedef struct shaped {
    double own[SCREE_POLYGON_CORNERS][2], posed[SCREE_POLYGON_CORNERS][2];
    int count;
    double rounding, bound;
    double x, y, angle, vx, vy, spin;
} shaped;

static void regular(shaped *b, int count, double radius, double rounding)
{
    *b = (shaped){.count = count, .rounding = rounding, .bound = radius};
    for (int k = 0; k < count; k++) {
        b->own[k][0] = radius * cos(2 * M_PI * k / count);
        b->own[k][1] = radius * sin(2 * M_PI * k / count);
    }
}

/// A square with horizontal sides.
static void square(shaped *b, double side, double rounding)
{
    regular(b, 4, side * M_SQRT1_2, rounding);
    b->angle = 0.25 * M_PI;
}

static scree_core lie(shaped *b, double time)
{
    const double angle = b->angle + time * b->spin;
    scree_polygon_turn(b->count, (const double(*)[2])b->own, cos(angle), sin(angle), b->posed);
    return (scree_core){
        .corner = (const double(*)[2])b->posed, .count = b->count, .bound = b->bound, .rounding = b->rounding};
}

/// The pair `time` after the pose of the bodies, which got there in `step`; masses are 1.
static kinematics pair_at(shaped *one, shaped *other, double time, double step)
{
    const scree_core core[2] = {lie(one, time), lie(other, time)};
    const double velocity[2] = {other->vx - one->vx, other->vy - one->vy}, spin[2] = {one->spin, other->spin};
    const double apart[2] = {other->x - one->x + time * velocity[0], other->y - one->y + time * velocity[1]};
    const bodies first = {.velocity = {one->vx, one->vy, 0}, .spin = {.x = one->spin}, .mass = 1};
    const bodies second = {.velocity = {other->vx, other->vy, 0}, .spin = {.x = other->spin}, .mass = 1};
    kinematics m = rounded_pair(core, apart, velocity, spin, 1, 0.5, step);
    kinematics_from_levers(2, &m, &first, &second, step);
    kinematics_gain(2, &m);
    return m;
}

static void near(double value, double expected, double within)
{
    if (!(fabs(value - expected) <= within)) fail_msg("%.17g, expected %.17g within %g", value, expected, within);
}

/// A body of the state of a run, as geometries beside walls want it.
typedef struct stage {
    scree_state state;
    scree_polygons polygons;
    scree_corners of;
    scree_row row;
} stage;

static bodies stand(stage *s, shaped *b)
{
    const scree_core core = lie(b, 0);
    *s = (stage){.of = {0, (uint32_t)b->count}};
    s->polygons = (scree_polygons){.posed = b->posed, .of = &s->of, .rounding = &b->rounding};
    s->row.radius = core.bound + core.rounding;
    s->state.own[SCREE_SLOT_polygon] = &s->polygons;
    s->state.row = &s->row;
    return (bodies){.velocity = {b->vx, b->vy, 0}, .spin = {.x = b->spin}, .mass = 1, .state = &s->state};
}

/// Over a floor, the centre at the height y.
static kinematics over_floor(shaped *b, double step)
{
    stage s;
    const bodies body = stand(&s, b);
    const double up[3] = {0, 1, 0};
    kinematics m = rounded_beside(&body, up, b->y, step);
    kinematics_from_levers(2, &m, &body, NULL, step);
    kinematics_gain(2, &m);
    return m;
}

// ---- measures ------------------------------------------------------------------------------------------------------

/// Whether a place is within `r` of a triangle with its corners counter-clockwise.
static bool holds(const double (*corner)[2], double r, const double p[2])
{
    const scree_core core = {.corner = corner, .count = 3, .bound = 1e9, .rounding = r};
    double point[2];
    int edge;
    return scree_core_closest(&core, p, 1e9, point, &edge) <= r * r;
}

/// A square of side a: area a^2 + 4 a r + pi r^2, and its polar moment from the same pieces by hand; a small core is a
/// disc; a triangle against a sum over a grid of 2000 x 2000, whose error is that of its boundary, 1e-3 of a cell.
static void measures_are_those_of_all_pieces(void **unused)
{
    (void)unused;
    const double a = 2, r = 0.3;
    shaped b;
    square(&b, a, r);
    scree_polygon_measures m = scree_rounding_measure(4, (const double(*)[2])b.own, r);
    near(m.area, a * a + 4 * a * r + M_PI * r * r, 1e-14);
    const double strip = a * r * (a * a + r * r) / 12 + a * r * (a / 2 + r / 2) * (a / 2 + r / 2);
    const double to_centre = 4 * r / (3 * M_PI), quarter = 0.25 * M_PI * r * r;
    const double own = 2 * (M_PI / 16) * r * r * r * r - quarter * 2 * to_centre * to_centre;
    const double sector = own + quarter * 2 * (a / 2 + to_centre) * (a / 2 + to_centre);
    near(m.moment[0] + m.moment[1], a * a * a * a / 6 + 4 * strip + 4 * sector, 1e-14);
    near(m.moment[0] - m.moment[1], 0, 1e-14);
    near(m.bound, a * M_SQRT1_2 + r, 1e-15);

    regular(&b, 7, 1e-9, 1);
    m = scree_rounding_measure(7, (const double(*)[2])b.own, 1);
    near(m.moment[0], 0.25 * M_PI, 1e-8);

    const double triangle[3][2] = {{5, 1}, {6.3, 1.2}, {5.1, 1.9}};
    m = scree_rounding_measure(3, triangle, 0.25);
    enum { CELLS = 2000 };
    double sum = 0, first[2] = {0, 0}, second[3] = {0, 0, 0};
    const double cell = 2.2 / CELLS;
    for (int i = 0; i < CELLS; i++)
        for (int j = 0; j < CELLS; j++) {
            const double p[2] = {4.6 + (i + 0.5) * cell, 0.6 + (j + 0.5) * cell};
            if (!holds(triangle, 0.25, p)) continue;
            const double x = p[0] - m.centroid[0], y = p[1] - m.centroid[1];
            sum += cell * cell;
            first[0] += x * cell * cell;
            first[1] += y * cell * cell;
            second[0] += y * y * cell * cell;
            second[1] += x * x * cell * cell;
            second[2] += x * y * cell * cell;
        }
    near(m.area, sum, 2e-4 * sum);
    for (int k = 0; k < 2; k++) near(first[k], 0, 2e-4);
    for (int k = 0; k < 3; k++) near(m.moment[k], second[k], 2e-4);
}

/// Whatever the core, the area with its rounding is that of the disc.
static void rounding_keeps_the_area(void **unused)
{
    (void)unused;
    for (uint64_t id = 0; id < 50; id++) {
        double corner[SCREE_POLYGON_CORNERS][2];
        const int count = 3 + (int)(id % 9);
        const double rounding = 0.01 + 0.017 * (double)id;
        scree_error error;
        check(scree_polygon_make_on_ellipse(3, id, count, 1 + 0.05 * (double)id, SCREE_POLYGON_SECTORS, 1, corner,
                                            &error),
              &error);
        const double scale = scree_rounding_scale(count, (const double(*)[2])corner, rounding);
        for (int k = 0; k < count; k++)
            for (int i = 0; i < 2; i++) corner[k][i] *= scale;
        const scree_polygon_measures m = scree_rounding_measure(count, (const double(*)[2])corner, rounding);
        near(m.radius, 1, 1e-14);
        // No body of an area has less inertia than the disc.
        assert_true(m.moment[0] + m.moment[1] > 0.5 * M_PI);
    }
}

// ---- closed forms --------------------------------------------------------------------------------------------------

/// A corner: depth and point. An edge: two features, sqrt(2) of both. Between them the stiffer spring comes in where
/// the second corner does.
static void a_square_on_a_floor(void **unused)
{
    (void)unused;
    const double a = 2, r = 0.3, d = 1e-3;
    shaped b;
    square(&b, a, r);
    b.y = a / 2 + r - d;
    kinematics m = over_floor(&b, 0);
    near(m.overlap, M_SQRT2 * d, 1e-15);
    near(m.gain, M_SQRT2, 1e-12);
    near(m.reduced_mass, 0.5, 1e-12);
    near(m.normal.x, 0, 0);
    near(m.normal.y, 1, 0);
    near(m.lever_first.x, 0, 1e-12);
    near(m.lever_first.y, -a / 2 - r + d / 2, 1e-15);
    near(m.reduced_radius, r, 0);
    b.angle = 0;
    b.y = a * M_SQRT1_2 + r - d;
    m = over_floor(&b, 0);
    near(m.overlap, d, 1e-15);
    near(m.gain, 1, 1e-15);
    near(m.lever_first.x, 0, 1e-12);
    // Tilted by less than d / a: the resultant lies between the corners, by their depths.
    b.angle = 0.25 * M_PI + 1e-4;
    b.y = a / 2 + r - d;
    m = over_floor(&b, 0);
    const double low = a * M_SQRT1_2 * sin(0.25 * M_PI + 1e-4), high = a * M_SQRT1_2 * cos(0.25 * M_PI + 1e-4);
    const double deep = r + low - b.y, shallow = r + high - b.y; // of the left corner and of the right one
    near(m.overlap, hypot(deep, shallow), 1e-15);
    near(m.gain, (deep + shallow) / m.overlap, 1e-12);
    near(m.lever_first.x, (shallow * low - deep * high) / (deep + shallow), 1e-12);
}

/// Face on face: a feature at either end of what they share, and each of them twice where corners meet. Corner on edge,
/// discs on edges and corners: one.
static void pairs_on_each_other(void **unused)
{
    (void)unused;
    const double a = 2, r = 0.2, d = 1e-3;
    shaped one, other;
    square(&one, a, r);
    square(&other, a, r);
    other.y = a + 2 * r - d;
    kinematics m = pair_at(&one, &other, 0, 0);
    near(m.overlap, 2 * d, 1e-14);
    near(m.gain, 2, 1e-12);
    near(m.normal.y, -1, 1e-15);
    near(m.lever_first.x, 0, 1e-12);
    near(m.lever_first.y - m.lever_second.y, other.y, 1e-14);
    // Shifted along the face.
    other.x = 0.7;
    m = pair_at(&one, &other, 0, 0);
    near(m.overlap, M_SQRT2 * d, 1e-14);
    near(m.lever_first.x, 0.35, 1e-11);
    near(m.lever_second.x, -0.35, 1e-11);
    near(m.lever_first.y, a / 2 + r - d / 2, 1e-14);
    // A corner down on the face.
    other.angle = 0;
    other.x = 0.3;
    other.y = a / 2 + a * M_SQRT1_2 + 2 * r - d;
    m = pair_at(&one, &other, 0, 0);
    near(m.overlap, d, 1e-14);
    near(m.gain, 1, 1e-14);
    near(m.lever_first.x, 0.3, 1e-12);
    near(m.reduced_mass, 0.5, 1e-13);
    // A disc on the face, and on the corner of the square.
    other = (shaped){.rounding = 0.5, .x = 0.9, .y = a / 2 + r + 0.5 - d};
    m = pair_at(&one, &other, 0, 0);
    near(m.overlap, d, 1e-14);
    near(m.gain, 1, 1e-15);
    near(m.lever_second.x, 0, 1e-14);
    near(m.lever_first.y, a / 2 + r - d / 2, 1e-14);
    near(m.lever_second.y, -0.5 + d / 2, 1e-14);
    other.x = a / 2 + (r + 0.5 - d) * M_SQRT1_2;
    other.y = a / 2 + (r + 0.5 - d) * M_SQRT1_2;
    m = pair_at(&one, &other, 0, 0);
    near(m.overlap, d, 1e-14);
    near(m.normal.x, -M_SQRT1_2, 1e-14);
    // Two discs.
    one = (shaped){.rounding = 0.5};
    other.x = 0, other.y = 1 - d;
    m = pair_at(&one, &other, 0, 0);
    near(m.overlap, d, 1e-15);
    near(m.lever_first.y, 0.5 - d / 2, 1e-15);
    near(m.gain, 1, 1e-15);
}

/// Apart by all that counts; cores that meet, at a corner, crossed without a corner near, one in the other.
static void cores_that_meet_are_told(void **unused)
{
    (void)unused;
    shaped bar, other;
    bar = (shaped){.count = 4, .rounding = 0.01, .bound = 1.1, .own = {{-1, -0.1}, {1, -0.1}, {1, 0.1}, {-1, 0.1}}};
    other = bar;
    other.angle = 0.5 * M_PI;
    assert_true(isinf(pair_at(&bar, &other, 0, 0).overlap));
    other.y = 1.05;
    assert_true(isinf(pair_at(&bar, &other, 0, 0).overlap));
    // The end comes out at the far side, its corners in range of the edge that it has passed.
    other.y = -0.895;
    assert_true(isinf(pair_at(&bar, &other, 0, 0).overlap));
    other.y = 1.119;
    near(pair_at(&bar, &other, 0, 0).overlap, M_SQRT2 * 1e-3, 1e-14);
    other.y = 1.1201;
    assert_true(pair_at(&bar, &other, 0, 0).overlap == 0);
    // Diagonal bars whose circles and projections meet and who do not.
    bar.angle = other.angle = 0.25 * M_PI;
    other.x = 0.2, other.y = -0.2;
    assert_true(pair_at(&bar, &other, 0, 0).overlap == 0);
    regular(&other, 5, 0.02, 0.01);
    other.bound = 0.02;
    assert_true(isinf(pair_at(&bar, &other, 0, 0).overlap));
    const shaped inner = other;
    shaped copy = inner;
    assert_true(isinf(pair_at(&copy, &bar, 0, 0).overlap));
    other = (shaped){.rounding = 0.05};
    assert_true(isinf(pair_at(&bar, &other, 0, 0).overlap));
}

// ---- random pairs --------------------------------------------------------------------------------------------------

/// A pair that touches by less than a tenth of its roundings: polygons of 3 to 8 corners, a disc among four.
static kinematics random_pair(uint64_t *seed, shaped *one, shaped *other)
{
    for (;;) {
        shaped *both[2] = {one, other};
        for (int b = 0; b < 2; b++) {
            const double size = 0.5 + draw(seed), rounding = 0.05 + 0.3 * draw(seed);
            regular(both[b], 3 + (int)(6 * draw(seed)), size, rounding);
            if (draw(seed) < 0.25) *both[b] = (shaped){.rounding = size};
            both[b]->angle = 7 * draw(seed);
            both[b]->vx = draw(seed) - 0.5;
            both[b]->vy = draw(seed) - 0.5;
            both[b]->spin = 2 * draw(seed) - 1;
        }
        const double angle = 7 * draw(seed), way = 0.4 + 2 * draw(seed);
        other->x = way * cos(angle);
        other->y = way * sin(angle);
        const kinematics m = pair_at(one, other, 0, 0);
        if (m.overlap > 0 && m.overlap < 0.1 * (one->rounding + other->rounding)) return m;
    }
}

/// Force of a spring on the overlap, f = delta g n at the lever, is minus the gradient of delta^2 / 2 in all six
/// coordinates. Central differences of 1e-6: 1e-9, and 1e-6 where a feature comes or goes within them.
static void the_force_is_a_gradient(void **unused)
{
    (void)unused;
    uint64_t seed = 1;
    size_t several = 0;
    for (int n = 0; n < 4000; n++) {
        shaped one, other;
        const kinematics m = random_pair(&seed, &one, &other);
        const double size = m.overlap * m.gain, f[2] = {size * m.normal.x, size * m.normal.y};
        const double torque[2] = {m.lever_first.x * f[1] - m.lever_first.y * f[0],
                                  m.lever_second.y * f[0] - m.lever_second.x * f[1]};
        const double expected[6] = {f[0], f[1], torque[0], -f[0], -f[1], torque[1]};
        double *const moved[6] = {&one.x, &one.y, &one.angle, &other.x, &other.y, &other.angle};
        several += fabs(m.gain - 1) > 1e-9;
        for (int k = 0; k < 6; k++) {
            const double was = *moved[k], h = 1e-6;
            *moved[k] = was + h;
            const double up = pair_at(&one, &other, 0, 0).overlap;
            *moved[k] = was - h;
            const double down = pair_at(&one, &other, 0, 0).overlap;
            *moved[k] = was;
            near((down * down - up * up) / (4 * h), expected[k], 2e-6);
        }
    }
    assert_true(several > 20);
}

/// Exchanged: the same bits with the opposite sign. Turned by an angle: the same to round-off.
static void exchange_and_rotation(void **unused)
{
    (void)unused;
    uint64_t seed = 2;
    for (int n = 0; n < 2000; n++) {
        shaped one, other;
        (void)random_pair(&seed, &one, &other);
        const kinematics a = pair_at(&one, &other, 0, 1e-3), b = pair_at(&other, &one, 0, 1e-3);
        assert_true(a.overlap == b.overlap && a.gain == b.gain && a.gain_middle == b.gain_middle);
        assert_true(a.normal.x == -b.normal.x && a.normal.y == -b.normal.y);
        assert_true(a.lever_first.x == b.lever_second.x && a.lever_first.y == b.lever_second.y);
        assert_true(a.lever_second.x == b.lever_first.x && a.lever_second.y == b.lever_first.y);
        assert_true(a.approach == b.approach && a.slip.x == b.slip.x && a.reduced_mass == b.reduced_mass);
        const double turn = 1.1, c = cos(turn), s = sin(turn);
        shaped *both[2] = {&one, &other};
        for (int k = 0; k < 2; k++) {
            shaped *t = both[k];
            const double x = t->x, y = t->y, vx = t->vx, vy = t->vy;
            t->x = c * x - s * y, t->y = s * x + c * y;
            t->vx = c * vx - s * vy, t->vy = s * vx + c * vy;
            t->angle += turn;
        }
        const kinematics r = pair_at(&one, &other, 0, 1e-3);
        near(r.overlap, a.overlap, 1e-14);
        near(r.normal.x, c * a.normal.x - s * a.normal.y, 1e-10);
        near(r.approach, a.approach, 1e-9);
        near(r.lever_first.x, c * a.lever_first.x - s * a.lever_first.y, 1e-9);
    }
}

/// The approach of the middle of a step times the step is the growth of the overlap: errors of the third order, so a
/// tenth of the step leaves a thousandth. Where a feature comes or goes in the step it is of second order.
static void rates_are_those_of_the_middle(void **unused)
{
    (void)unused;
    uint64_t seed = 3;
    int third = 0, all = 0;
    for (int n = 0; n < 2000; n++) {
        shaped one, other;
        double error[2];
        (void)random_pair(&seed, &one, &other);
        for (int k = 0; k < 2; k++) {
            const double step = k == 0 ? 1e-2 : 1e-3;
            const kinematics now = pair_at(&one, &other, 0, step), before = pair_at(&one, &other, -step, 0);
            error[k] = fabs(now.approach * step - (now.overlap - before.overlap));
            if (before.overlap == 0) error[k] = NAN;
        }
        if (isnan(error[0]) || isnan(error[1])) continue;
        all++;
        third += error[1] < 3e-3 * error[0] || error[1] < 1e-12;
        if (!(error[1] < 1e-3)) fail_msg("%d: error %.3g of a step of 1e-3", n, error[1]);
    }
    print_message("third order: %d of %d\n", third, all);
    assert_true(all > 1000 && third > 0.9 * all);
}

/// Over a floor the same, where levers move along the face as it rocks.
static void rates_over_a_floor(void **unused)
{
    (void)unused;
    double error[2];
    for (int k = 0; k < 2; k++) {
        const double step = k == 0 ? 1e-3 : 1e-4;
        shaped b;
        square(&b, 2, 0.3);
        b.angle += 2e-3;
        b.y = 1.29;
        b.vx = 0.4, b.vy = -0.3, b.spin = 0.5;
        const kinematics now = over_floor(&b, step);
        b.angle -= step * b.spin;
        b.y -= step * b.vy;
        error[k] = fabs(now.approach * step - (now.overlap - over_floor(&b, 0).overlap));
        near(now.slip.x / now.gain, -(0.4 + 0.5 * 1.295), 0.01);
    }
    print_message("error %.3g, with a tenth of the step %.3g\n", error[0], error[1]);
    assert_true(error[0] > 1e-12 && error[1] < 3e-3 * error[0]);
}

/// Rocked from one corner to the other through parallel, and carried past the end of a face, in steps h: the force and
/// its point change by no more than some h.
static void the_force_is_continuous(void **unused)
{
    (void)unused;
    enum { STEPS = 4000 };
    shaped one, other;
    kinematics last = {0};
    double jump[2] = {0};
    for (int path = 0; path < 2; path++)
        for (int n = 0; n <= STEPS; n++) {
            const double at = 2.0 * n / STEPS - 1;
            square(&one, 2, 0.2);
            square(&other, 1, 0.1);
            other.y = 1.5 + 0.3 - 2e-2;
            if (path == 0) other.angle += 0.05 * at;
            if (path == 1) other.x = 1.5 + 0.4 * at, other.angle += 0.01;
            const kinematics m = pair_at(&one, &other, 0, 0);
            const double was = last.overlap * last.gain, is = m.overlap * m.gain;
            if (n > 0) {
                jump[path] = fmax(jump[path],
                                  hypot(is * m.normal.x - was * last.normal.x, is * m.normal.y - was * last.normal.y));
                jump[path] = fmax(jump[path],
                                  fabs(is * m.lever_first.x * m.normal.y - was * last.lever_first.x * last.normal.y));
            }
            last = m;
        }
    print_message("largest change of the force in %d steps: %.3g, %.3g\n", STEPS, jump[0], jump[1]);
    assert_true(jump[0] < 1e-4 && jump[1] < 3e-4 && jump[0] > 0 && jump[1] > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(measures_are_those_of_all_pieces),
        cmocka_unit_test(rounding_keeps_the_area),
        cmocka_unit_test(a_square_on_a_floor),
        cmocka_unit_test(pairs_on_each_other),
        cmocka_unit_test(cores_that_meet_are_told),
        cmocka_unit_test(the_force_is_a_gradient),
        cmocka_unit_test(exchange_and_rotation),
        cmocka_unit_test(rates_are_those_of_the_middle),
        cmocka_unit_test(rates_over_a_floor),
        cmocka_unit_test(the_force_is_continuous),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
