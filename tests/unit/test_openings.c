/// Openings between walls below a source, against drawn geometries; widths of polygons against closed forms.
#include "run_fixture.h"

#include "case/case.h"
#include "shape/polygon_make.h"
#include "source/room.h"

#define HEAD                                                                                                           \
    "scree: 1\nname: funnel\ngravity: [0, -10]\n"                                                                      \
    "materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.5, restitution: 0.4}]\n"        \
    "contact: {law: hertz_mindlin}\nintegrator: {step_fraction: 0.2}\nmeasure: {cells: no}\n"                          \
    "particles: {shape: disc, material: glass, count: 50, distribution: equal, radius: 2 mm}\n"                        \
    "stages: [{stage: prepare, method: empty}, {stage: pour}]\n"
#define SPOUT(x) "sources: [{source: point, place: [" x ", 1], interval: 20 ms}]\n"
#define SIDES(half)                                                                                                    \
    "walls:\n- {shape: polygon, name: left, corners: [[-20 cm, 50 cm], [-" half ", 50 cm], [-20 cm, 70 cm]]}\n"        \
    "- {shape: polygon, name: right, corners: [[" half ", 50 cm], [20 cm, 50 cm], [20 cm, 70 cm]]}\n"
#define PLATE "- {shape: plane, name: plate, point: [0, 0], normal: [0, 1]}\n"

/// What is found below the source of a case; width 0: nothing.
static scree_source_opening look(const char *text)
{
    const char *const none[] = {"seed=1"};
    scree_case *c = case_read(text, none, 1);
    scree_model model;
    scree_wall_set *walls;
    scree_error error;
    scree_source_opening found;
    check(scree_case_model(c, &model, &error), &error);
    check(scree_wall_set_create(&c->config, &walls, &error), &error);
    const double narrowest = scree_source_grains_of(&model, &model.sources[0]).narrowest;
    assert_true(fabs(narrowest - 4e-3) < 1e-15);
    (void)scree_source_find_opening(&model, walls, 0, narrowest, &found);
    scree_wall_set_destroy(&walls);
    scree_case_free(c);
    return found;
}

static void near(double value, double wanted)
{
    if (!(fabs(value - wanted) < 1e-12)) fail_msg("%.17g, not %.17g", value, wanted);
}

static void a_funnel_has_one(void **unused)
{
    (void)unused;
    // Wide enough, too narrow, with and without something below.
    const scree_source_opening wide = look(HEAD SIDES("5 mm") PLATE SPOUT("0")),
                               narrow = look(HEAD SIDES("1 mm") PLATE SPOUT("5 cm")),
                               alone = look(HEAD SIDES("1 mm") SPOUT("0"));
    near(wide.width, 10e-3);
    near(wide.middle[0], 0);
    near(wide.middle[1], 0.5);
    near(narrow.width, 2e-3);
    near(alone.width, 2e-3);
    assert_true(wide.above && narrow.above && !alone.above);
    assert_true(wide.wall[0] == 0 && wide.wall[1] == 1);
}

static void others_have_none(void **unused)
{
    (void)unused;
    // A source beside the funnel, or below it.
    near(look(HEAD SIDES("1 mm") PLATE SPOUT("30 cm")).width, 0);
    near(look(HEAD SIDES("1 mm") PLATE "sources: [{source: point, place: [0, 40 cm], interval: 20 ms}]\n").width, 0);
    // Joints of a plate on the ground, gaps of a rough base.
    near(look(HEAD "walls:\n- {shape: box, name: a, side: outside, lower: [-1, 0], upper: [-1 mm, 5 cm]}\n"
                   "- {shape: box, name: b, side: outside, lower: [1 mm, 0], upper: [1, 5 cm]}\n" PLATE SPOUT("0"))
             .width,
         0);
    // Two boxes of which one stands above the other.
    near(
        look(HEAD
             "walls:\n- {shape: box, name: a, side: outside, lower: [-10 cm, 20 cm], upper: [10 cm, 25 cm]}\n"
             "- {shape: box, name: b, side: outside, lower: [-10 cm, 26 cm], upper: [10 cm, 30 cm]}\n" PLATE SPOUT("0"))
            .width,
        0);
    // Walls that overlap.
    near(look(HEAD
              "walls:\n- {shape: box, name: a, side: outside, lower: [-10 cm, 20 cm], upper: [1 cm, 25 cm]}\n"
              "- {shape: box, name: b, side: outside, lower: [-1 cm, 20 cm], upper: [10 cm, 25 cm]}\n" PLATE SPOUT("0"))
             .width,
         0);
}

/// A body between the sides leaves two openings of which the wider one counts.
static void the_widest_counts(void **unused)
{
    (void)unused;
    const scree_source_opening found =
        look(HEAD SIDES("3 cm") PLATE
             "- {shape: box, name: peg, side: outside, lower: [-2 cm, 40 cm], upper: [25 mm, 60 cm]}\n" SPOUT("0"));
    near(found.width, 10e-3);
    assert_true(found.wall[0] == 0 && found.wall[1] == 3);
}

/// A regular polygon of an even number of corners is as narrow as twice its inner radius, a triangle as its height.
static void a_polygon_is_narrow(void **unused)
{
    (void)unused;
    double corner[SCREE_POLYGON_CORNERS][2];
    for (int n = 3; n <= 8; n += n == 3 ? 1 : 2) {
        scree_polygon_make_regular(n, 1, corner);
        const double bound = hypot(corner[0][0], corner[0][1]);
        near(scree_polygon_width(n, (const double(*)[2])corner), n == 3 ? 1.5 * bound : 2 * bound * cos(M_PI / n));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_funnel_has_one),
        cmocka_unit_test(others_have_none),
        cmocka_unit_test(the_widest_counts),
        cmocka_unit_test(a_polygon_is_narrow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
