/// Polygons that stand, slide, topple, roll over their corners and rock, stacks and an arch, against closed forms of
/// rigid bodies. Bodies here sink into each other by 1e-5 of their size; what stands is 0.03 rad, or 4 % of a side,
/// from falling.
#include "run_fixture.h"

#include "shape/polygon_make.h"
#include "shape/polygons.h"

#define COUNT_OF(list) (sizeof(list) / sizeof *(list))

static const char *const laws[] = {"contact.law=polygon_overlap", "contact.law=polygon_potential"};

/// One case of everything here. `outline`: keys of the shape; bodies: of the preparation.
static scree_simulation open_bodies(const char *outline, const char *bodies, int count, double friction,
                                    const double gravity[2], const char *law, bool stiff, double duration,
                                    scree_case **c)
{
    static char text[8000], word[1][400];
    (void)snprintf(text, sizeof text,
                   "scree: 1\nname: statics\n"
                   "materials: [{name: stone, young_modulus: 1e10 Pa, density: 5000 kg/m3, friction: %.17g, "
                   "damping_constant: 1}]\n"
                   "particles: {shape: polygon, %s, material: stone, thickness: 1 m, count: %d}\n"
                   "contact: {law: polygon_overlap}\nintegrator: {scheme: velocity_verlet, step_fraction: 0.3}\n"
                   "walls: [{shape: plane, point: [0, 0], normal: [0, 1]}]\n"
                   "stages:\n  - {stage: prepare, method: bodies, width: 4 m, height: 4 m, bodies: [%s]}\n"
                   "  - {stage: relax, boundary: walls, duration: %.17g s}\n"
                   "measure: {samples: 100, cells: no}\noutput: {figures: no, paraview: no}\n",
                   friction, outline, count, bodies, duration);
    (void)snprintf(word[0], sizeof word[0], "gravity=[%.17g, %.17g]", gravity[0], gravity[1]);
    const char *const overrides[] = {word[0], law, "materials.stone.young_modulus=1e11 Pa"};
    scree_simulation s;
    *c = case_read(text, overrides, stiff ? 3 : 2);
    simulation_open(*c, 1, &s);
    simulation_load(&s);
    return s;
}

static void close_both(scree_simulation *s, scree_case *c)
{
    scree_simulation_close(s);
    scree_case_free(c);
}

static const scree_row *body(const scree_simulation *s, uint32_t id)
{
    return &s->state.row[scree_state_row_of(&s->state, id)];
}

static double angle(const scree_simulation *s, uint32_t id)
{
    return s->state.angle[scree_state_row_of(&s->state, id)];
}

static void step_for(scree_simulation *s, double time)
{
    const double end = scree_state_time(&s->state) + time;
    while (simulation_goes_on(s) && scree_state_time(&s->state) < end) simulation_step(s);
}

/// Keys and the place of one regular polygon of n corners that lies flat on the floor; radius of equal area 1 cm.
static double flat(int n, char keys[200], char place[200])
{
    double corner[SCREE_POLYGON_CORNERS][2];
    scree_polygon_make_regular(n, 0.01, corner);
    const double bound = hypot(corner[0][0], corner[0][1]), inner = bound * cos(M_PI / n);
    // The first corner lies on the x axis: turned so that the middle of an edge points down.
    (void)snprintf(keys, 200, "outline: regular, corners_min: %d, corners_max: %d, distribution: equal, radius: 1 cm",
                   n, n);
    (void)snprintf(place, 200, "{position: [1, %.17g], angle: %.17g}", inner, -M_PI / 2 + M_PI / n);
    return bound;
}

/// On a slope of less than the angle of friction it stands; on a steeper one it slides with g (sin a - mu cos a).
static void it_slides(void **unused)
{
    (void)unused;
    const double mu = 0.3, slope[] = {atan(mu) - 0.02, atan(mu) + 0.1};
    for (size_t l = 0; l < COUNT_OF(laws); l++)
        for (int k = 0; k < 2; k++) {
            char keys[200], place[200];
            const double gravity[] = {9.81 * sin(slope[k]), -9.81 * cos(slope[k])};
            const double wanted = k == 0 ? 0 : 9.81 * (sin(slope[k]) - mu * cos(slope[k]));
            scree_case *c;
            (void)flat(4, keys, place);
            scree_simulation s = open_bodies(keys, place, 1, mu, gravity, laws[l], false, 1, &c);
            step_for(&s, 0.1);
            const double before = body(&s, 0)->vx;
            step_for(&s, 0.1);
            const double acceleration = (body(&s, 0)->vx - before) / 0.1;
            print_message("%s, slope %.4f: acceleration %.6g, %.6g m/s2\n", laws[l], slope[k], acceleration, wanted);
            assert_true(fabs(acceleration - wanted) < 2e-3);
            assert_true(k == 1 || fabs(body(&s, 0)->x - 1) < 1e-5);
            close_both(&s, c);
        }
}

/// With friction enough a regular polygon of n corners topples where its weight leaves the edge: at a slope of pi / n.
static void it_topples(void **unused)
{
    (void)unused;
    for (int n = 4; n <= 8; n += 2)
        for (int k = 0; k < 2; k++) {
            char keys[200], place[200];
            const double slope = M_PI / n + (k == 0 ? -0.03 : 0.03);
            const double gravity[] = {9.81 * sin(slope), -9.81 * cos(slope)};
            scree_case *c;
            (void)flat(n, keys, place);
            scree_simulation s = open_bodies(keys, place, 1, 3, gravity, laws[n == 6], false, 1, &c);
            const double begin = angle(&s, 0);
            step_for(&s, 0.4);
            print_message("%d corners, slope pi / n %+.2f: turned by %.4f\n", n, slope - M_PI / n,
                          angle(&s, 0) - begin);
            if (k == 0)
                assert_true(fabs(angle(&s, 0) - begin) < 2e-3);
            else
                assert_true(angle(&s, 0) - begin < -M_PI / n);
            close_both(&s, c);
        }
}

/// A regular polygon on level ground that turns about its leading corner rolls over it when its energy lifts its centre
/// from r (over an edge) to R (over a corner): w0^2 (J + m R^2) / 2 = m g (R - r), J = m R^2 (2 + cos(2 pi / n)) / 6.
/// Over the corner w^2 is less by the square of this speed. The corner sinks into the ground by a depth d, some 1e-3 of
/// R: of the energy m g (R - r) that much less is needed, d / (R - r), and no more than this is stored in the ground.
static void it_rolls_over_a_corner(void **unused)
{
    (void)unused;
    static const double over[] = {0.98, 1.02, 1.5};
    const double gravity[] = {0, -9.81};
    for (size_t l = 0; l < COUNT_OF(laws); l++)
        for (int k = 0; k < 3; k++) {
            const int n = l == 0 ? 6 : 4;
            char keys[200], place[400];
            const double bound = flat(n, keys, place), inner = bound * cos(M_PI / n), half = bound * sin(M_PI / n);
            const double inertia = bound * bound * (1 + (2 + cos(2 * M_PI / n)) / 6);
            const double least = sqrt(2 * 9.81 * (bound - inner) / inertia), spin = over[k] * least;
            (void)snprintf(place, sizeof place,
                           "{position: [1, %.17g], angle: %.17g, velocity: [%.17g, %.17g], spin: [0, 0, %.17g]}", inner,
                           -M_PI / 2 + M_PI / n, spin * inner, spin * half, -spin);
            scree_case *c;
            scree_simulation s = open_bodies(keys, place, 1, 3, gravity, laws[l], true, 2, &c);
            const double begin = angle(&s, 0);
            double top = NAN, depth = 0;
            while (simulation_goes_on(&s) && body(&s, 0)->spin < 0 && angle(&s, 0) - begin > -1.9 * M_PI / n) {
                simulation_step(&s);
                if (!isnan(top) || angle(&s, 0) - begin > -M_PI / n) continue;
                top = -body(&s, 0)->spin;
                depth = bound - body(&s, 0)->y;
            }
            const double wanted = sqrt(fmax(0, over[k] * over[k] - 1)) * least;
            print_message("%d corners, %.2f of the least spin: over the corner %.4g, %.4g rad/s, depth %.2g R\n", n,
                          over[k], top, wanted, depth / bound);
            assert_true(k == 0 ? isnan(top)
                               : fabs(top * top - wanted * wanted) < (depth / (bound - inner) + 5e-4) * least * least);
            assert_true(depth < 2e-3 * bound);
            close_both(&s, c);
        }
}

/// A slender block that is let go at a tilt rocks back: quarter of a period acosh(1 / (1 - tilt / a)) / p, p^2 = 3 g /
/// 4 R (Housner 1963; sides b, h, a = atan(b / h), R half of the diagonal), for slender blocks to some per cent.
static void a_slender_block_rocks(void **unused)
{
    (void)unused;
    const double b = 0.02, h = 0.2, a = atan(b / h), diagonal = 0.5 * hypot(b, h), tilt = 0.4 * a;
    const double p = sqrt(3 * 9.81 / (4 * diagonal)), wanted = acosh(1 / (1 - tilt / a)) / p;
    const double gravity[] = {0, -9.81};
    for (size_t l = 0; l < COUNT_OF(laws); l++) {
        char keys[200], place[200];
        scree_case *c;
        (void)snprintf(
            keys, sizeof keys,
            "outline: given, corners: [[0, 0], [1, 0], [1, 10], [0, 10]], distribution: equal, radius: %.17g",
            sqrt(b * h / M_PI));
        // It stands on its lower right corner.
        (void)snprintf(place, sizeof place, "{position: [1, %.17g], angle: %.17g}", diagonal * cos(a - tilt), -tilt);
        scree_simulation s = open_bodies(keys, place, 1, 2, gravity, laws[l], true, 1, &c);
        while (angle(&s, 0) < 0 && simulation_goes_on(&s)) simulation_step(&s);
        const double time = scree_state_time(&s.state);
        print_message("%s: upright after %.5g s, %.5g s\n", laws[l], time, wanted);
        assert_true(fabs(time / wanted - 1) < 0.03);
        close_both(&s, c);
    }
}

/// A block on another stands while its centre is above it, and falls off when it is not.
static void a_stack_stands(void **unused)
{
    (void)unused;
    const double side = 0.01 * sqrt(M_PI), gravity[] = {0, -9.81};
    for (int n = 0; n < 4; n++) {
        const int k = n / 2, law = n % 2;
        char keys[200], place[400], other[200];
        const double shift = 0.5 * side * (k == 0 ? 0.96 : 1.04);
        scree_case *c;
        (void)flat(4, keys, other);
        (void)snprintf(place, sizeof place,
                       "{position: [1, %.17g], angle: %.17g}, {position: [%.17g, %.17g], angle: %.17g}", 0.5 * side,
                       -M_PI / 4, 1 + shift, 1.5 * side, -M_PI / 4);
        scree_simulation s = open_bodies(keys, place, 2, 0.5, gravity, laws[law], false, 1, &c);
        // One that has fallen need not be watched any longer.
        for (int part = 0; part < 10 && body(&s, 1)->y >= 1.2 * side; part++) step_for(&s, 0.05);
        print_message("%s, shift %.2f of the half side: turned by %.4f, height %.4f sides\n", laws[law],
                      2 * shift / side, angle(&s, 1) + M_PI / 4, body(&s, 1)->y / side);
        if (k == 0)
            assert_true(fabs(angle(&s, 1) + M_PI / 4) < 5e-3 && fabs(body(&s, 1)->y / side - 1.5) < 5e-3);
        else
            assert_true(body(&s, 1)->y < 1.2 * side);
        close_both(&s, c);
    }
}

/// A semicircular arch of wedges, thick t and of mean radius R, stands above t / R = 0.1075 (Milankovitch 1907) and
/// falls below, whatever its material, with friction enough.
static void an_arch_stands(void **unused)
{
    (void)unused;
    enum { BLOCKS = 11 };
    const double share[] = {0.16, 0.07}, gravity[] = {0, -9.81};
    for (int n = 0; n < 4; n++) {
        const int k = n / 2, law = n % 2;
        const double mean = 0.1, inner = mean * (1 - 0.5 * share[k]), outer = mean * (1 + 0.5 * share[k]);
        const double half = M_PI / (2 * BLOCKS);
        const double wedge[4][2] = {{inner * sin(half), inner * cos(half)},
                                    {outer * sin(half), outer * cos(half)},
                                    {-outer * sin(half), outer * cos(half)},
                                    {-inner * sin(half), inner * cos(half)}};
        const scree_polygon_measures m = scree_polygon_measure(4, wedge);
        char keys[400], place[3000] = "";
        (void)snprintf(keys, sizeof keys,
                       "outline: given, corners: [[%.17g, %.17g], [%.17g, %.17g], [%.17g, %.17g], [%.17g, %.17g]], "
                       "distribution: equal, radius: %.17g",
                       wedge[0][0], wedge[0][1], wedge[1][0], wedge[1][1], wedge[2][0], wedge[2][1], wedge[3][0],
                       wedge[3][1], m.radius);
        for (int i = 0; i < BLOCKS; i++) {
            const double turn = (i - BLOCKS / 2) * 2 * half; // clockwise from the top
            const size_t used = strlen(place);
            (void)snprintf(place + used, sizeof place - used, "%s{position: [%.17g, %.17g], angle: %.17g}",
                           i > 0 ? ", " : "", 1 + m.centroid[1] * sin(turn), m.centroid[1] * cos(turn), -turn);
        }
        scree_case *c;
        scree_simulation s = open_bodies(keys, place, BLOCKS, 2, gravity, laws[law], false, 1, &c);
        for (int part = 0; part < 8 && body(&s, BLOCKS / 2)->y >= 0.5 * m.centroid[1]; part++) step_for(&s, 0.05);
        const double crown = body(&s, BLOCKS / 2)->y / m.centroid[1];
        print_message("%s, t / R %.2f: height of the crown over the first %.4f\n", laws[law], share[k], crown);
        assert_true(k == 0 ? fabs(crown - 1) < 5e-3 : crown < 0.5);
        close_both(&s, c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_slides),
        cmocka_unit_test(it_topples),
        cmocka_unit_test(it_rolls_over_a_corner),
        cmocka_unit_test(a_slender_block_rocks),
        cmocka_unit_test(a_stack_stands),
        cmocka_unit_test(an_arch_stands),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
