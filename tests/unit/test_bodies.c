/// Prepare method `bodies`: the state is what the case says, an impact is the one of method `pair` to the bit, a
/// restart goes on, the written case reads back, and what cannot be is refused where it stands.
#include "run_fixture.h"
#include "state/periodic.h"
#include "state/plates.h"

#include "case/case.h"
#include "io/summary.h"
#include "io_scratch.h"
#include "run/conclusion.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Discs of two materials in a box, under gravity. Positions in messages count its lines.
static const char discs[] = "materials:\n"
                            "  - {name: quartz, young_modulus: 30 MPa, density: 2650 kg/m3, friction: 0.45}\n"
                            "  - {name: steel, young_modulus: 20 MPa, density: 7850 kg/m3, friction: 0.3}\n"
                            "particles: {material: quartz, count: 3, radius_min: 0.5 mm, radius_max: 1 mm}\n"
                            "gravity: [0, -9.81 m/s2]\n"
                            "stages:\n"
                            "  - stage: prepare\n"
                            "    method: bodies\n"
                            "    width: 10 mm\n"
                            "    bodies:\n"
                            "      - {position: [1 mm, 0.5 mm], radius: 0.5 mm}\n"
                            "      - {position: [4 mm, 3 mm], velocity: [0.1 m/s, -2 mm/s], spin: [0, 0, 3 rad/s],\n"
                            "         radius: 1 mm, material: steel}\n"
                            "      - position: [4.1 mm, 1.2 mm]\n"
                            "        radius: 0.7 mm\n"
                            "  - {stage: relax, duration: 30 ms, boundary: plates}\n";

static const char spheres[] =
    "dimension: 3\n"
    "materials: [{name: quartz, young_modulus: 30 MPa, density: 2650 kg/m3, friction: 0.45}]\n"
    "particles: {shape: sphere, material: quartz, count: 2, distribution: equal, radius: 1 mm}\n"
    "boundary: {periodic: xyz}\n"
    "stages:\n"
    "  - stage: prepare\n"
    "    method: bodies\n"
    "    width: 12 mm\n"
    "    depth: 11 mm\n"
    "    height: 10 mm\n"
    "    bodies:\n"
    "      - {position: [1 mm, 2 mm, 3 mm], velocity: [4 m/s, 5 m/s, 6 m/s], spin: [7 rad/s, 8 rad/s, 9 rad/s]}\n"
    "      - {position: [5 mm, 5 mm, 5 mm]}\n"
    "  - {stage: confine, pressure: 1 kPa}\n";

static void prepare(const char *text, const char *const *overrides, size_t count, scree_case **c, scree_simulation *s)
{
    *c = case_read(text, overrides, count);
    simulation_open(*c, 1, s);
    simulation_step(s);
}

static void discs_are_what_the_case_says(void **unused)
{
    (void)unused;
    scree_case *c;
    scree_simulation s;
    prepare(discs, NULL, 0, &c, &s);
    assert_int_equal(s.state.count, 3);
    // Rows are in the order of a curve.
    scree_row row[3];
    for (size_t id = 0; id < 3; id++) row[id] = s.state.row[s.state.row_of_id[id]];
    assert_true(row[0].x == 1e-3 && row[0].y == 0.5e-3 && row[0].radius == 0.5e-3 && row[0].vx == 0);
    assert_true(row[1].x == 4e-3 && row[1].vx == 0.1 && row[1].vy == -2e-3 && row[1].spin == 3 &&
                row[1].radius == 1e-3);
    assert_true(row[0].material == 0 && row[1].material == 1 && row[2].material == 0);
    // Discs of a length of twice the mean radius, which is 0.75 mm; a few roundings.
    assert_true(fabs(row[1].mass / (7850 * M_PI * 1e-6 * 1.5e-3) - 1) < 1e-14);
    assert_true(fabs(row[2].mass / (2650 * M_PI * 0.49e-6 * 1.5e-3) - 1) < 1e-14);
    assert_true(scree_plates(&s.state)[SCREE_WALL_RIGHT].position == -10e-3 &&
                scree_plates(&s.state)[SCREE_WALL_TOP].position == -4e-3);
    scree_simulation_close(&s);
    scree_case_free(c);
}

static void spheres_are_what_the_case_says(void **unused)
{
    (void)unused;
    scree_case *c;
    scree_simulation s;
    prepare(spheres, NULL, 0, &c, &s);
    scree_vector place, velocity, spin;
    scree_body_position(&s.state, 0, place);
    scree_body_motion(&s.state, 0, velocity, spin);
    assert_true(place[0] == 1e-3 && place[1] == 2e-3 && place[2] == 3e-3);
    assert_true(velocity[0] == 4 && velocity[1] == 5 && velocity[2] == 6);
    assert_true(spin[0] == 7 && spin[1] == 8 && spin[2] == 9);
    assert_true(s.state.row[1].radius == 1e-3);
    const double *cell = scree_cell(&s.state)->lattice;
    assert_true(cell[0] == 12e-3 && cell[4] == 11e-3 && cell[8] == 10e-3);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// The box of one sphere a side: what is not given reaches as far as the bodies.
static void sides_that_are_left_out_follow_the_bodies(void **unused)
{
    (void)unused;
    static const char *const overrides[] = {"stages.0.width=auto", "stages.0.depth=auto", "stages.0.height=auto",
                                            "boundary.periodic=no", "boundary.lateral=plates"};
    scree_case *c;
    scree_simulation s;
    prepare(spheres, overrides, 5, &c, &s);
    const int far[3] = {SCREE_WALL_RIGHT, SCREE_WALL_BACK, SCREE_WALL_TOP};
    // The sum of a position and a radius.
    for (int k = 0; k < 3; k++) assert_true(fabs(scree_plates(&s.state)[far[k]].position + 6e-3) < 1e-18);
    scree_simulation_close(&s);
    scree_case_free(c);
}

#define PAIR_CASE                                                                                                      \
    "materials: [{name: quartz, young_modulus: 30 GPa, density: 2.675e8 kg/m3, friction: 0.45}]\n"                     \
    "particles: {material: quartz, count: 2, radius_min: 0.5 mm, radius_max: 1 mm}\n"                                  \
    "contact: {reference_velocity: 7.5e-6 m/s}\n"                                                                      \
    "integrator: {step: 8e-6 s}\n"                                                                                     \
    "measure: {cells: no}\n"

/// The state that method pair prepares, as a list of bodies.
static void write_bodies(const scree_state *state, char *text, size_t size)
{
    bool in_3d = state->dimension == 3;
    int length = snprintf(text, size, PAIR_CASE "stages:\n  - stage: prepare\n    method: bodies\n    width: %.17g\n",
                          -scree_plates(state)[SCREE_WALL_RIGHT].position);
    length += snprintf(text + length, size - (size_t)length, "    height: %.17g\n",
                       -scree_plates(state)[SCREE_WALL_TOP].position);
    if (in_3d)
        length += snprintf(text + length, size - (size_t)length, "    depth: %.17g\n",
                           -scree_plates(state)[SCREE_WALL_BACK].position);
    length += snprintf(text + length, size - (size_t)length, "    bodies:\n");
    for (size_t i = 0; i < 2; i++) {
        scree_vector place, velocity, spin;
        scree_body_position(state, i, place);
        scree_body_motion(state, i, velocity, spin);
        char third[40] = "";
        if (in_3d) (void)snprintf(third, sizeof third, ", %.17g", place[2]);
        length += snprintf(text + length, size - (size_t)length,
                           "      - {position: [%.17g, %.17g%s], velocity: [%.17g, 0%s], radius: %.17g}\n", place[0],
                           place[1], third, velocity[0], in_3d ? ", 0" : "", state->row[i].radius);
    }
    (void)snprintf(text + length, size - (size_t)length, "  - {stage: collide, duration: 100 ms}\n");
}

static void a_pair_of_bodies_is_a_pair(void **unused)
{
    (void)unused;
    static const char pair[] = PAIR_CASE "stages:\n  - {stage: prepare, method: pair}\n"
                                         "  - {stage: collide, duration: 100 ms}\n";
    static const char *const in_3d[] = {"dimension=3", "particles.shape=sphere"};
    for (size_t overrides = 0; overrides <= 2; overrides += 2) {
        char text[2048];
        scree_case *c[2];
        scree_simulation s[2];
        prepare(pair, in_3d, overrides, &c[0], &s[0]);
        write_bodies(&s[0].state, text, sizeof text);
        prepare(text, in_3d, overrides, &c[1], &s[1]);
        assert_true(scree_state_checksum(&s[0].model, &s[0].state) == scree_state_checksum(&s[1].model, &s[1].state));
        for (int k = 0; k < 2; k++) (void)simulation_finish(&s[k]);
        assert_true(s[0].state.row[s[0].state.row_of_id[0]].vx < 0); // they have met
        assert_true(simulation_close(&s[0]) == simulation_close(&s[1]));
        for (int k = 0; k < 2; k++) scree_case_free(c[k]);
    }
}

/// Restitution that the results of an impact in this case name.
static double restitution_of(scree_simulation *s)
{
    char folder[64], path[96], text[2048] = "";
    scree_error error;
    scree_summary *summary;
    assert_true(scratch_create(folder));
    (void)snprintf(path, sizeof path, "%s/summary.json", folder);
    check(scree_summary_create(&summary, &error), &error);
    check(scree_modules[SCREE_SLOT_collide]->conclude(&(scree_conclusion){.s = s, .summary = summary}, &error), &error);
    check(scree_summary_write(summary, path, &error), &error);
    scree_summary_destroy(summary);
    FILE *file = fopen(path, "r");
    assert_true(file && fread(text, 1, sizeof text - 1, file) > 0);
    fclose(file);
    scratch_destroy(folder);
    const char *found = strstr(text, "\"restitution\":");
    return found ? strtod(found + strlen("\"restitution\":"), NULL) : NAN;
}

/// A smooth impact has the restitution of its material in any direction, off the centres too.
static void an_impact_in_any_direction(void **unused)
{
    (void)unused;
    static const char text[] =
        "materials: [{name: quartz, young_modulus: 30 GPa, density: 2650 kg/m3, friction: 0, restitution: 0.6}]\n"
        "particles: {material: quartz, count: 2, distribution: equal, radius: 1 mm}\n"
        "contact: {reference_velocity: 1 m/s}\n"
        "integrator: {step_fraction: 0.02}\n"
        "measure: {cells: no}\n"
        "stages:\n"
        "  - {stage: prepare, method: bodies, bodies: [{position: [5 mm, 5 mm], velocity: [30 mm/s, 40 mm/s]},\n"
        "                                              {position: [6.3 mm, 6.7 mm]}]}\n"
        "  - {stage: collide}\n";
    static const char *const off_centre = "stages.0.bodies.1.position=[5.2 mm, 7.1 mm]";
    for (size_t overrides = 0; overrides < 2; overrides++) {
        scree_case *c;
        scree_simulation s;
        prepare(text, &off_centre, overrides, &c, &s);
        (void)simulation_finish(&s);
        // The step is a fiftieth of the critical one, and the pair turns by less than the duration of the impact times
        // speed over distance while it touches and until a sample sees it part: 1e-3.
        assert_true(fabs(restitution_of(&s) / 0.6 - 1) < 5e-3);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
    static const char *const apart[] = {"stages.0.bodies.0.velocity=[-1 mm/s, 0]", "do not approach",
                                        "stages.0.bodies.1.position=[5 mm, 9 mm]", "pass each other"};
    for (int k = 0; k < 4; k += 2) {
        scree_case *c;
        scree_simulation s;
        scree_error error = {0};
        prepare(text, &apart[k], 1, &c, &s);
        assert_int_equal(scree_simulation_step(&s, &error), SCREE_ERROR_INPUT);
        if (!strstr(error.message, apart[k + 1])) fail_msg("%s", error.message);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

static void a_restart_goes_on(void **unused)
{
    (void)unused;
    char folder[64];
    assert_true(scratch_create(folder));
    scree_case *c;
    scree_simulation s, other;
    prepare(discs, NULL, 0, &c, &s);
    while (simulation_last_steps(&s) < 500) simulation_step(&s);
    simulation_reopen(&s, 1, folder, &other);
    (void)simulation_finish(&s);
    (void)simulation_finish(&other);
    assert_true(s.state.step > 1000);
    assert_true(simulation_close(&s) == simulation_close(&other));
    scree_case_free(c);
    scratch_destroy(folder);
}

/// What a --set of one body's key does to it alone, in the state.
static void set_reaches_one_body(void **unused)
{
    (void)unused;
    static const char *const set[] = {"stages.prepare.bodies.2.velocity=[7 mm/s, 0]"};
    scree_case *c;
    scree_simulation s;
    prepare(discs, set, 1, &c, &s);
    const double velocity[] = {0, 0.1, 7e-3};
    for (size_t id = 0; id < 3; id++) assert_true(s.state.row[s.state.row_of_id[id]].vx == velocity[id]);
    scree_simulation_close(&s);
    scree_case_free(c);
}

typedef struct refusal {
    const char *set, *field, *message;
    const char *also; ///< set too
} refusal;

static void check_refusal(const char *text, const refusal *r)
{
    scree_case *c;
    scree_problems *problems;
    assert_int_equal(case_parse(text, (const char *const[]){r->set, r->also}, r->also ? 2 : 1, &c, &problems),
                     SCREE_ERROR_INPUT);
    for (size_t k = 0; k < scree_problems_count(problems); k++) {
        const scree_error *error = scree_problems_get(problems, k);
        if (strcmp(error->field, r->field) == 0 && strstr(error->message, r->message)) {
            scree_problems_free(problems);
            return;
        }
        print_message("%s: %s\n", error->field, error->message);
    }
    fail_msg("%s is not refused with '%s' at %s", r->set, r->message, r->field);
}

static void what_cannot_be_is_refused(void **unused)
{
    (void)unused;
    static const refusal flat[] = {
        {"particles.count=4", "particles.count", "stages.0 gives 3 bodies", NULL},
        {"stages.0.bodies.2.position=[4.1 mm, 1.7 mm]", "stages.0.bodies.2.position",
         "bodies 1 and 2 overlap by 0.000396", NULL},
        {"stages.0.bodies.0.position=[0.2 mm, 5 mm]", "stages.0.bodies.0.position", "outside of the box: x is 0.0002 m",
         NULL},
        {"stages.0.bodies.0.position=[9.9 mm, 5 mm]", "stages.0.bodies.0.position", "the width of the box 0.01 m",
         NULL},
        {"stages.0.height=2 mm", "stages.0.bodies.1.position", "the height of the box 0.002 m", NULL},
        {"stages.0.bodies.0.position=[1 mm, 2 mm, 3 mm]", "stages.0.bodies.0.position", "a position has 2", NULL},
        {"stages.0.bodies.0.velocity=[0, 0, 1]", "stages.0.bodies.0.velocity", "a velocity has 2", NULL},
        {"stages.0.bodies.0.spin=[1 rad/s, 0]", "stages.0.bodies.0.spin", "a spin has 3", NULL},
        {"stages.0.bodies.0.spin=[1 rad/s, 0, 0]", "stages.0.bodies.0.spin", "turns about z only", NULL},
        {"stages.0.bodies.0.radius=0 m", "stages.0.bodies.0.radius", "'0 m' is too small", NULL},
        {"stages.0.bodies.0.radius=2 mm", "stages.0.bodies.0.radius", "is not between particles.radius_min", NULL},
        {"stages.0.bodies.0.radius=auto", "stages.0.bodies.0.radius", "no radius in common", NULL},
        {"stages.0.bodies.1.material=stel", "stages.0.bodies.1.material", "did you mean 'steel'", NULL},
        {"stages.0.bodies.3.radius=1 mm", "stages.0.bodies.3.radius", "there is no bodies.3: the case has 3", NULL},
        {"stages.0.outline=circle", "stages.0.outline", "are not cut out", NULL},
        {"stages.0.aspect_ratio=2", "stages.0.aspect_ratio", "not used with width", NULL},
        {"stages.0.aspect_ratio=2", "stages.0.aspect_ratio", "not used with method: bodies", "stages.0.width=auto"},
        {"stages.0.gap=1 mm", "stages.0.gap", "not used with method: bodies", NULL},
    };
    static const refusal in_3d[] = {
        {"stages.0.bodies.1.position=[5 mm, 5 mm]", "stages.0.bodies.1.position", "a position has 3", NULL},
        {"stages.0.bodies.0.velocity=[1 m/s, 0]", "stages.0.bodies.0.velocity", "a velocity has 3", NULL},
        {"stages.0.bodies.1.position=[12.5 mm, 2 mm, 3 mm]", "stages.0.bodies.1.position", "the width of the box",
         NULL},
        {"stages.0.bodies.1.position=[11.5 mm, 2 mm, 3 mm]", "stages.0.bodies.1.position", "bodies 0 and 1 overlap",
         NULL},
        {"stages.0.bodies.1.radius=2 mm", "stages.0.bodies.1.radius", "is not the radius of the particles", NULL},
    };
    for (size_t k = 0; k < sizeof flat / sizeof *flat; k++) check_refusal(discs, &flat[k]);
    for (size_t k = 0; k < sizeof in_3d / sizeof *in_3d; k++) check_refusal(spheres, &in_3d[k]);
}

/// Bricks of 2 mm x 1 mm, one lying on the bottom, the other on it. The disc of equal area has 1.6 mm.
static const char bricks[] =
    "materials: [{name: stone, young_modulus: 1e7 Pa, density: 5000 kg/m3, friction: 0.5}]\n"
    "particles: {shape: polygon, outline: given, corners: [[0, 0], [2, 0], [2, 1], [0, 1]], material: stone, "
    "thickness: 1 m, count: 2, distribution: equal, radius: 0.7978845608028654 mm}\n"
    "contact: {law: polygon_overlap}\n"
    "gravity: [0, -9.81 m/s2]\n"
    "stages:\n"
    "  - stage: prepare\n"
    "    method: bodies\n"
    "    width: 10 mm\n"
    "    height: 10 mm\n"
    "    bodies:\n"
    "      - {position: [3 mm, 0.5 mm]}\n"
    "      - {position: [3.1 mm, 1.5 mm]}\n"
    "  - {stage: relax, duration: 1 ms, boundary: plates}\n";

/// What stands on each other touches no more than its outlines say, turned, rounded, with a ghost, at a wall.
static void bricks_may_lie_on_each_other(void **unused)
{
    (void)unused;
    static const char *const sets[][2] = {
        {"stages.0.bodies.1.position=[3 mm, 1.5 mm]", NULL},
        {"stages.0.bodies.1.position=[3 mm, 1.8 mm]", NULL},
        {"stages.0.bodies=[{position: [3 mm, 1 mm], angle: 90 degrees}, {position: [4 mm, 1 mm], angle: 90 degrees}]",
         NULL},
        {"stages.0.bodies=[{position: [3 mm, 9.5 mm]}, {position: [1 mm, 9.5 mm]}]", NULL},
        // Of a rounded brick of the same area the sides are a little shorter.
        {"particles.rounding=0.1", "contact={law: linear}"},
    };
    for (size_t k = 0; k < sizeof sets / sizeof *sets; k++) {
        scree_case *c;
        scree_simulation s;
        prepare(bricks, sets[k], sets[k][1] ? 2 : 1, &c, &s);
        assert_int_equal(s.state.count, 2);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

static void bricks_that_overlap_are_refused(void **unused)
{
    (void)unused;
    static const refusal wrong[] = {
        // A = 0.4 mm2 over l = 0.2 mm, half of an arm; the bounding circle has 1.118 mm.
        {"stages.0.bodies.1.position=[3 mm, 1.3 mm]", "stages.0.bodies.1.position",
         "bodies 0 and 1 lie 0.0002 m deep in each other, which is an overlap of 0.002 m to their law; "
         "guard.overlap allows 0.000223607 m",
         NULL},
        // Discs of equal area would leave 0.2 mm between them: the corners meet.
        {"stages.0.bodies.1.position=[4.8 mm, 0.5 mm]", "stages.0.bodies.1.position",
         "bodies 0 and 1 lie 0.0002 m deep in each other", NULL},
        {"stages.0.bodies.1.position=[4.2 mm, 1 mm]", "stages.0.bodies.1.position", "lie 0.0005 m deep in each other",
         NULL},
        {"stages.0.bodies=[{position: [3 mm, 0.5 mm]}, {position: [3 mm, 1.3 mm], angle: 90 degrees}]",
         "stages.0.bodies.1.position", "lie 0.0007 m deep in each other", NULL},
        {"stages.0.bodies.1.position=[3 mm, 0.5 mm]", "stages.0.bodies.1.position",
         "lie 0.001 m deep in each other, where no law has a force", NULL},
        {"stages.0.bodies.1.position=[9.5 mm, 1.5 mm]", "stages.0.bodies.1.position",
         "outside of the box: x is 0.0095 m, its outline reaches 0.001 m, and the width of the box 0.01 m", NULL},
        {"stages.0.bodies=[{position: [3 mm, 0.6 mm], angle: 90 degrees}, {position: [7 mm, 5 mm]}]",
         "stages.0.bodies.0.position", "outside of the box: y is 0.0006 m, its outline reaches 0.001 m", NULL},
        {"particles.rounding=0.2", "stages.0.bodies.1.position", "where no law has a force", "contact={law: linear}"},
    };
    for (size_t k = 0; k + 1 < sizeof wrong / sizeof *wrong; k++) check_refusal(bricks, &wrong[k]);
    // Rounded ones have overlaps of features; cores that meet have none.
    char text[sizeof bricks];
    memcpy(text, bricks, sizeof bricks);
    memcpy(strstr(text, "1.5 mm"), "0.9 mm", strlen("0.9 mm"));
    check_refusal(text, &wrong[sizeof wrong / sizeof *wrong - 1]);
}

/// A problem says line and column of what is wrong.
static void problems_point_at_the_body(void **unused)
{
    (void)unused;
    char text[sizeof discs];
    memcpy(text, discs, sizeof discs);
    memcpy(strstr(text, "4.1 mm, 1.2"), "4.1 mm, 1.7", strlen("4.1 mm, 1.7"));
    scree_case *c;
    scree_problems *problems;
    assert_int_equal(case_parse(text, NULL, 0, &c, &problems), SCREE_ERROR_INPUT);
    assert_int_equal(scree_problems_count(problems), 1);
    const scree_error *error = scree_problems_get(problems, 0);
    assert_int_equal(error->line, 14);
    assert_int_equal(error->column, 19);
    scree_problems_free(problems);
}

/// The step follows the fastest impact and the material that needs the smallest.
static void the_step_follows_the_bodies(void **unused)
{
    (void)unused;
    static const char *const faster[] = {"stages.0.bodies.1.velocity=[3 m/s, 0]"};
    static const char *const lighter[] = {"materials.steel.density=100 kg/m3"};
    const char *const *const sets[] = {faster, faster, lighter};
    double step[3];
    for (int k = 0; k < 3; k++) {
        scree_case *c = case_read(discs, sets[k], k > 0);
        scree_model model;
        scree_error error;
        check(scree_model_build(&c->config, &model, &error), &error);
        step[k] = model.step;
        scree_case_free(c);
    }
    // A stiffness that goes as the fifth root of the speed and its square: a factor of 30^(1/5) in the step.
    assert_true(step[1] < 0.7 * step[0] && step[2] < 0.5 * step[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(discs_are_what_the_case_says),
        cmocka_unit_test(spheres_are_what_the_case_says),
        cmocka_unit_test(sides_that_are_left_out_follow_the_bodies),
        cmocka_unit_test(a_pair_of_bodies_is_a_pair),
        cmocka_unit_test(an_impact_in_any_direction),
        cmocka_unit_test(a_restart_goes_on),
        cmocka_unit_test(set_reaches_one_body),
        cmocka_unit_test(what_cannot_be_is_refused),
        cmocka_unit_test(bricks_may_lie_on_each_other),
        cmocka_unit_test(bricks_that_overlap_are_refused),
        cmocka_unit_test(problems_point_at_the_body),
        cmocka_unit_test(the_step_follows_the_bodies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
