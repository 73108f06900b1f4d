/// Solid walls in the plane: polygons, boxes from outside, rough bottoms of fixed grains. Grains rest, slide, bounce
/// and flow on them as closed forms and the geometry of the overlap say; energy closes with the order of the scheme
/// beside walls that stand and that move; nothing but the state decides; what is wrong is said.
#include "run_fixture.h"

#include "base/fixed.h"
#include "contact/contact.h"
#include "io_scratch.h"
#include "load/prescribed.h"
#include "run/step.h"
#include "shape/polygon_pair.h"
#include "shape/polygons.h"

// ---- cases ---------------------------------------------------------------------------------------------------------

#define COUNT_OF(list) (sizeof(list) / sizeof *(list))

#define MATTER                                                                                                         \
    "scree: 1\nname: walls\ndimension: 2\ngravity: [0, -10]\n"                                                         \
    "materials:\n  - {name: stone, young_modulus: 1e8 Pa, density: 2500 kg/m3, friction: 0.5}\n"                       \
    "contact: {law: polygon_potential}\nintegrator: {scheme: velocity_verlet, step: 2e-6 s}\n"                         \
    "measure: {samples: 20, cells: no}\noutput: {figures: no, paraview: no}\n"
#define HEXAGONS(count)                                                                                                \
    "particles: {shape: polygon, outline: regular, corners_min: 6, corners_max: 6, thickness: 1 m, material: stone,\n" \
    "            count: " count ", distribution: equal, radius: 1 cm}\n"
#define DISCS(count)                                                                                                   \
    "particles: {shape: disc, thickness: 1 m, material: stone, count: " count ", distribution: equal, radius: 1 cm}\n"
#define STAGES(bodies, duration)                                                                                       \
    "stages:\n  - {stage: prepare, method: bodies, width: 1 m, height: 1 m, bodies: [" bodies "]}\n"                   \
    "  - {stage: relax, boundary: walls, duration: " duration "}\n"
#define APOTHEM 9.523065e-3 /* m, of a hexagon with the area of a disc of 1 cm */

/// Grains among side walls that fall on a wedge, on a paddle and on a floor.
static const char falling_text[] =
    "scree: 1\nname: falling\ndimension: 2\nseed: 3\ngravity: [0, -10]\n"
    "materials:\n  - {name: stone, young_modulus: 1e7 Pa, density: 5000 kg/m3, friction: 0.5}\n"
    "particles:\n  thickness: 1 m\n  count: 24\n  species:\n"
    "  - {name: grains, shape: polygon, material: stone, share: 0.75, distribution: equal, radius: 2 mm}\n"
    "  - {name: discs, shape: disc, material: stone, share: 0.25, distribution: equal, radius: 2 mm}\n"
    "contact: {law: polygon_potential}\nintegrator: {scheme: velocity_verlet, step: 5e-6 s}\n"
    "measure: {samples: 50, cells: no}\noutput: {figures: no, paraview: no}\n"
    "walls:\n"
    "  - {shape: box, name: vessel, lower: [0, -14 mm], upper: [32 mm, 100 mm]}\n"
    "  - {shape: polygon, name: wedge, corners: [[12 mm, -15 mm], [26 mm, -15 mm], [20 mm, -2 mm]]}\n"
    "  - {shape: polygon, name: paddle, corners: [[2 mm, -8 mm], [9 mm, -8 mm], [10 mm, -6 mm], [6 mm, -4 mm], "
    "[2 mm, -5 mm]], spin: [0, 0, 30], centre: [6 mm, -6 mm], motion: vibration, amplitude: [0, 0.5 mm], "
    "frequency: 40 1/s}\n"
    "stages:\n  - {stage: prepare, method: gas, width: 32 mm, solid_fraction: 30 %, velocity: 0.5 m/s}\n"
    "  - {stage: relax, boundary: walls, duration: 0.07 s}\n";
enum { VESSEL, WEDGE, PADDLE };

static scree_simulation open_with(const char *text, const char *const *overrides, size_t count, scree_case **c)
{
    scree_simulation s;
    *c = case_read(text, overrides, count);
    simulation_open(*c, 1, &s);
    return s;
}

static void close_both(scree_simulation *s, scree_case *c)
{
    scree_simulation_close(s);
    scree_case_free(c);
}

static const double *force_on(const scree_simulation *s, int wall)
{
    return scree_case_walls(&s->state)->load[wall].force;
}

static size_t count_contacts(const scree_simulation *s, scree_contact *last)
{
    scree_contact_table table = {0};
    scree_error error;
    check(scree_contact_table_build(&s->model, &s->state, &s->work, &table, &error), &error);
    const size_t count = table.count;
    if (count > 0 && last) *last = table.contact[count - 1];
    scree_contact_table_destroy(&table);
    return count;
}

// ---- at rest -------------------------------------------------------------------------------------------------------

static const char edge_text[] = MATTER
    HEXAGONS("1") "walls:\n  - {shape: polygon, corners: [[0.4, -0.1], [0.6, -0.1], [0.55, 0], [0.45, 0]]}\n" STAGES(
        "{position: [0.51, 9.523065e-3 m], angle: 0}", "0.4 s");

/// On an edge: one contact, the weight, its torque about the centre of the wall.
static void a_grain_rests_on_an_edge(void **unused)
{
    (void)unused;
    scree_case *c;
    scree_simulation s = open_with(edge_text, NULL, 0, &c);
    (void)simulation_finish(&s);
    const double weight = 10 * scree_body_mass(&s.state, 0), *force = force_on(&s, 0);
    const double torque = scree_case_walls(&s.state)->load[0].torque[2];
    print_message("force %.12g, %.12g of the weight, torque %.12g of it\n", force[0] / weight, force[1] / weight,
                  torque / (weight * 0.51));
    assert_true(fabs(force[1] / weight + 1) < 1e-9 && fabs(force[0] / weight) < 1e-9);
    assert_true(fabs(torque / (weight * s.state.row[0].x) + 1) < 1e-9);
    assert_int_equal(count_contacts(&s, NULL), 1);
    close_both(&s, c);
}

#define NOTCH                                                                                                          \
    "walls:\n  - {shape: polygon, corners: [[0.446, -0.1], [0.546, -0.1], [0.496, 0]]}\n"                              \
    "  - {shape: polygon, corners: [[0.454, -0.1], [0.554, -0.1], [0.504, 0]]}\n"

/// On two corners: half of the weight each, in opposite directions across. Of a disc the lever of the forces is known.
static void grains_rest_on_corners(void **unused)
{
    (void)unused;
    static const char *const text[] = {MATTER HEXAGONS("1")
                                           NOTCH STAGES("{position: [0.5, 9.5e-3 m], angle: 0}", "0.4 s"),
                                       MATTER DISCS("1") NOTCH STAGES("{position: [0.5, 9.3e-3 m]}", "0.4 s")};
    for (int k = 0; k < 2; k++) {
        scree_case *c;
        scree_simulation s = open_with(text[k], NULL, 0, &c);
        (void)simulation_finish(&s);
        const double weight = 10 * scree_body_mass(&s.state, 0), *one = force_on(&s, 0), *other = force_on(&s, 1);
        print_message("%s: forces (%.9g, %.9g) and (%.9g, %.9g) of the weight\n", k ? "disc" : "hexagon",
                      one[0] / weight, one[1] / weight, other[0] / weight, other[1] / weight);
        assert_int_equal(count_contacts(&s, NULL), 2);
        assert_true(fabs((one[1] + other[1]) / weight + 1) < 1e-8 && fabs((one[0] + other[0]) / weight) < 1e-8);
        assert_true(fabs(one[1] / weight + 0.5) < 1e-6);
        assert_true(fabs(s.state.row[0].x - 0.5) < 1e-8);
        close_both(&s, c);
    }
}

// ---- the contact ---------------------------------------------------------------------------------------------------

/// A grain over a corner of a wall touches it once, with the gradient of the area that both share, as another body
/// with this outline would; a box from outside is the polygon of its corners.
static void a_corner_counts_once(void **unused)
{
    (void)unused;
    static const char *const walls[] = {
        "walls=[{shape: polygon, corners: [[0.3, 0.2], [0.495, 0.2], [0.495, 0.493], [0.3, 0.493]]}]",
        "walls=[{shape: box, side: outside, lower: [0.3, 0.2], upper: [0.495, 0.493]}]"};
    double sums[2][3];
    for (int k = 0; k < 2; k++) {
        const char *const overrides[] = {walls[k], "gravity=[0, 0]",
                                         "stages.0.bodies=[{position: [0.5, 0.5], angle: 0.2}]",
                                         "integrator.step=1e-9 s", "stages.1.duration=3e-9 s"};
        scree_case *c;
        scree_contact contact;
        scree_simulation s = open_with(edge_text, overrides, COUNT_OF(overrides), &c);
        while (s.state.stage.index < 1 || s.state.evaluations < 1) simulation_step(&s);
        assert_int_equal(count_contacts(&s, &contact), 1);
        static const double corner[4][2] = {{-0.0975, -0.1465}, {0.0975, -0.1465}, {0.0975, 0.1465}, {-0.0975, 0.1465}};
        const scree_polygon grain = scree_polygon_of_row(&s.state, scree_polygons_of(&s.state), 0);
        const scree_polygon wall = {corner, 4, 0, 0.2};
        const double apart[2] = {0.3975 - s.state.row[0].x, 0.3465 - s.state.row[0].y};
        scree_overlap overlap;
        int hint = 0;
        assert_true(scree_polygon_pair_overlap(&grain, &wall, apart, &hint, &overlap));
        const double scale = -1e8 * overlap.area / (grain.radius * grain.radius);
        const scree_sum_row *sum = &s.state.sum[0];
        const double force[2] = {scree_fixed_to(sum->fx, s.state.force_quantum),
                                 scree_fixed_to(sum->fy, s.state.force_quantum)};
        const double torque = scree_fixed_to(sum->torque, s.state.torque_quantum);
        const double size = hypot(force[0], force[1]);
        assert_true(force[0] > 0.1 * size && force[1] > 0.1 * size);
        for (int i = 0; i < 2; i++) assert_true(fabs(force[i] - scale * overlap.chord[i]) < 1e-6 * size);
        assert_true(fabs(torque - (overlap.arm[0][0] * force[1] - overlap.arm[0][1] * force[0])) < 1e-6 * 0.01 * size);
        for (int i = 0; i < 2; i++) assert_true(fabs(force_on(&s, 0)[i] + force[i]) < 1e-12 * size);
        assert_true(fabs(contact.point[0] - s.state.row[0].x - overlap.arm[0][0]) < 1e-12);
        for (int i = 0; i < 3; i++) sums[k][i] = i < 2 ? force[i] : torque;
        close_both(&s, c);
    }
    assert_memory_equal(sums[0], sums[1], sizeof sums[0]);
}

/// Nothing acts before outlines meet, however near the bounding circle is: beside a plane and beside a solid.
static void nothing_acts_before_outlines_meet(void **unused)
{
    (void)unused;
    static const char *const walls[] = {
        "walls=[{shape: plane, point: [0, 0], normal: [0, 1]}]",
        "walls=[{shape: polygon, corners: [[0.4, -0.1], [0.6, -0.1], [0.55, 0], [0.45, 0]]}]",
        "walls=[{shape: box, lower: [0.4, 0], upper: [0.6, 1]}]"};
    for (int k = 0; k < 3; k++) {
        // The circle reaches 10.996 mm, the outline 9.523 mm; it falls 0.4 mm.
        const char *const overrides[] = {walls[k], "stages.0.bodies=[{position: [0.5, 10 mm], velocity: [0, -0.01]}]",
                                         "stages.1.duration=8 ms"};
        scree_case *c;
        scree_simulation s = open_with(edge_text, overrides, COUNT_OF(overrides), &c);
        (void)simulation_finish(&s);
        const double time = scree_state_time(&s.state);
        assert_int_equal(count_contacts(&s, NULL), 0);
        assert_true(fabs(s.state.row[0].vy + 0.01 + 10 * time) < 1e-12);
        close_both(&s, c);
    }
}

/// A hexagon that slides without friction from one wall to the next, which stand side by side: at the joint it shares
/// its area with both, so the contact is softer and it sinks by some of its depth, and comes up again.
static void it_slides_over_a_joint(void **unused)
{
    (void)unused;
    scree_case *c;
    static const char joint[] =
        "walls=[{shape: polygon, corners: [[0.4, -0.1], [0.5, -0.1], [0.5, 0], [0.4, 0]]}, {shape: polygon, corners: "
        "[[0.5, -0.1], [0.6, -0.1], [0.6, 0], [0.5, 0]]}]";
    const char *const overrides[] = {"materials.0.friction=0", joint,
                                     "stages.0.bodies=[{position: [0.48, 9.523e-3 m], velocity: [0.2, 0]}]",
                                     "stages.1.duration=0.2 s"};
    scree_simulation s = open_with(edge_text, overrides, COUNT_OF(overrides), &c);
    const double worst = simulation_finish(&s), weight = 10 * scree_body_mass(&s.state, 0);
    print_message("at %.6f m, velocity %.9f m/s, spin %.3g rad/s, angle %.3g, residual %.2g\n", s.state.row[0].x,
                  s.state.row[0].vx, s.state.row[0].spin, s.state.angle[0], worst);
    assert_true(fabs(s.state.row[0].x - 0.52) < 1e-5 && fabs(s.state.row[0].vx / 0.2 - 1) < 1e-5);
    assert_true(fabs(s.state.angle[0]) < 1e-4);
    assert_true(fabs(force_on(&s, 1)[1] / weight + 1) < 1e-2 && force_on(&s, 0)[1] == 0);
    close_both(&s, c);
}

// ---- energy --------------------------------------------------------------------------------------------------------

#define LOSSLESS "materials.0.friction=0", "materials.0.damping_constant=0"

static double residual_of(const char *const *overrides, size_t count, double *work)
{
    scree_case *c;
    scree_simulation s = open_with(falling_text, overrides, count, &c);
    const double worst = simulation_finish(&s);
    *work = scree_case_walls(&s.state)->load[PADDLE].work;
    assert_true(force_on(&s, WEDGE)[1] <= 0 && scree_case_walls(&s.state)->load[WEDGE].work == 0);
    close_both(&s, c);
    return worst;
}

/// Beside a wedge that stands and a paddle that turns and vibrates the balance closes with the order of the scheme:
/// what the paddle does is in the ledger.
static void the_balance_closes_beside_moving_walls(void **unused)
{
    (void)unused;
    const char *const coarse[] = {LOSSLESS}, *const fine[] = {LOSSLESS, "integrator.step=1.25e-6 s"};
    const char *const rough[] = {"integrator.step=1.25e-6 s"};
    const char *const standing[] = {LOSSLESS, "stages.1.walls=stand"};
    const char *const standing_fine[] = {LOSSLESS, "stages.1.walls=stand", "integrator.step=1.25e-6 s"};
    double work[5];
    const double moving[2] = {residual_of(coarse, COUNT_OF(coarse), &work[0]),
                              residual_of(fine, COUNT_OF(fine), &work[1])};
    const double still[2] = {residual_of(standing, COUNT_OF(standing), &work[2]),
                             residual_of(standing_fine, COUNT_OF(standing_fine), &work[3])};
    const double damped = residual_of(rough, COUNT_OF(rough), &work[4]);
    print_message("moving: %.3g, with a quarter of the step %.3g (work %.3g J); standing %.3g, %.3g; with friction and "
                  "dashpots %.3g (work %.3g J)\n",
                  moving[0], moving[1], work[1], still[0], still[1], damped, work[4]);
    assert_true(moving[0] < 3e-4 && moving[1] < moving[0] / 5 && still[0] < 3e-4 && still[1] < still[0] / 5);
    assert_true(damped < 1e-4 && work[2] == 0 && fabs(work[1]) > 1e-3 && fabs(work[4]) > 1e-3);
    // With the row of the other law what is left is the way of the wall, which is no straight one within a step.
    const char *const rows[] = {"contact.law=polygon_overlap", "stages.1.walls=stand"};
    const double standing_row = residual_of(rows, COUNT_OF(rows), &work[0]);
    const double moving_row = residual_of(rows, 1, &work[0]);
    print_message("with the row of the law: standing %.3g, moving %.3g (work %.3g J)\n", standing_row, moving_row,
                  work[0]);
    assert_true(standing_row < 1e-8 && moving_row < 1e-5 && fabs(work[0]) > 1e-4);
}

/// A grain between a wall and the same wall driven: seen from the wall a push with constant velocity is an impact on a
/// wall at rest.
static void a_moving_wall_is_one_at_rest_from_elsewhere(void **unused)
{
    (void)unused;
    static const char *const walls[] = {
        "walls=[{shape: polygon, corners: [[0.3, 0.4], [0.46, 0.42], [0.47, 0.55], [0.3, 0.6]], velocity: [0.3, 0.1]}]",
        "walls=[{shape: polygon, corners: [[0.3, 0.4], [0.46, 0.42], [0.47, 0.55], [0.3, 0.6]]}]"};
    static const char *const bodies[] = {
        "stages.0.bodies=[{position: [0.482, 0.5], angle: 0.3}]",
        "stages.0.bodies=[{position: [0.482, 0.5], angle: 0.3, velocity: [-0.3, -0.1]}]"};
    double seen[2][3];
    for (int k = 0; k < 2; k++) {
        const char *const overrides[] = {walls[k], bodies[k], "gravity=[0, 0]", "stages.1.duration=20 ms",
                                         "integrator.step=1e-6 s"};
        scree_case *c;
        scree_simulation s = open_with(edge_text, overrides, COUNT_OF(overrides), &c);
        (void)simulation_finish(&s);
        seen[k][0] = s.state.row[0].vx + (k ? 0.3 : 0);
        seen[k][1] = s.state.row[0].vy + (k ? 0.1 : 0);
        seen[k][2] = s.state.row[0].spin;
        close_both(&s, c);
    }
    print_message("velocity (%.9g, %.9g) m/s, spin %.9g rad/s\n", seen[0][0], seen[0][1], seen[0][2]);
    assert_true(seen[0][0] > 0.1 && fabs(seen[0][2]) > 0.1);
    print_message("difference %.2g, %.2g m/s, %.2g rad/s\n", seen[0][0] - seen[1][0], seen[0][1] - seen[1][1],
                  seen[0][2] - seen[1][2]);
    for (int i = 0; i < 3; i++) assert_true(fabs(seen[0][i] - seen[1][i]) < 1e-7);
}

/// A lid that is a polygon, under a servo, presses a hexagon onto the floor with the force that it is told.
static void a_servo_presses(void **unused)
{
    (void)unused;
    const char *const overrides[] = {"walls=[{shape: plane, point: [0, 0], normal: [0, 1]}, {shape: polygon, corners: "
                                     "[[0.47, 19.08 mm], [0.53, 19.08 mm], "
                                     "[0.5, 40 mm]], motion: servo, direction: [0, -1], force: 20 N}]",
                                     "stages.0.bodies=[{position: [0.5, 9.523e-3 m]}]", "stages.1.duration=0.3 s"};
    scree_case *c;
    scree_simulation s = open_with(edge_text, overrides, COUNT_OF(overrides), &c);
    const double worst = simulation_finish(&s), weight = 10 * scree_body_mass(&s.state, 0);
    const double lid = force_on(&s, 1)[1], floor = force_on(&s, 0)[1];
    print_message("lid %.9g N, floor %.9g N of %.9g N, travel %.4g mm, residual %.2g\n", lid, floor, weight + 20,
                  1e3 * scree_case_walls(&s.state)->load[1].travel, worst);
    assert_true(fabs(lid / 20 - 1) < 1e-6 && fabs(floor / (weight + 20) + 1) < 1e-6 && worst < 1e-4);
    close_both(&s, c);
}

// ---- round bodies under other laws
// -----------------------------------------------------------------------------------

/// Discs under a law of overlaps roll over a polygon as over the box of the same corners.
static void discs_under_other_laws_see_a_box(void **unused)
{
    (void)unused;
    static const char text[] =
        "scree: 1\nname: discs\ngravity: [0, -10]\n"
        "materials: [{name: glass, young_modulus: 100 MPa, poisson_ratio: 0.25, density: 2500 kg/m3, friction: 0.3}]\n"
        "particles: {shape: disc, material: glass, count: 1, distribution: equal, radius: 1 mm}\n"
        "contact: {law: hertz_mindlin}\nintegrator: {step_fraction: 0.1}\n"
        "walls: []\nmeasure: {samples: 50, cells: no}\noutput: {figures: no, paraview: no}\nstages:\n"
        "  - {stage: prepare, method: bodies, bodies: [{position: [18 mm, 11 mm], velocity: [0.3, 0]}]}\n"
        "  - {stage: relax, boundary: walls, duration: 40 ms}\n";
    static const char *const walls[] = {
        "walls=[{shape: polygon, corners: [[0, 0], [20 mm, 0], [20 mm, 10 mm], [0, 10 mm]]}]",
        "walls=[{shape: box, side: outside, lower: [0, 0], upper: [20 mm, 10 mm]}]"};
    scree_row end[2];
    for (int k = 0; k < 2; k++) {
        scree_case *c;
        scree_simulation s = open_with(text, &walls[k], 1, &c);
        assert_true(simulation_finish(&s) < 1e-5);
        end[k] = s.state.row[0];
        close_both(&s, c);
    }
    print_message("at (%.9g, %.9g) m, spin %.9g rad/s\n", end[0].x, end[0].y, end[0].spin);
    assert_true(end[0].x > 0.02 && end[0].y < 0.009 && fabs(end[0].spin) > 10);
    assert_true(fabs(end[0].x - end[1].x) < 1e-9 && fabs(end[0].y - end[1].y) < 1e-9);
    assert_true(fabs(end[0].spin - end[1].spin) < 1e-5);
}

// ---- funnel, rough bottom ------------------------------------------------------------------------------------------

/// Grains flow through two polygons that make a funnel, and all of them come out below it.
static void a_funnel_is_emptied(void **unused)
{
    (void)unused;
    const char *const overrides[] = {
        "walls=[{shape: polygon, name: left, corners: [[-1 mm, -22 mm], [8 mm, -22 mm], [-1 mm, -1 mm]]}, {shape: "
        "polygon, name: right, corners: [[24 mm, -22 mm], [33 mm, -22 mm], [33 mm, -1 mm]]}, {shape: box, name: tray, "
        "lower: [0, -60 mm], upper: [32 mm, 120 mm]}]",
        "stages.1.duration=0.3 s", "materials.0.friction=0.3", "particles.count=30"};
    scree_case *c;
    scree_simulation s = open_with(falling_text, overrides, COUNT_OF(overrides), &c);
    const double worst = simulation_finish(&s);
    double highest = -INFINITY, weight = 0;
    for (size_t row = 0; row < s.state.count; row++) {
        highest = fmax(highest, s.state.row[row].y);
        weight += 10 * scree_body_mass(&s.state, row);
        assert_true(s.state.row[row].x > 0 && s.state.row[row].x < 0.032 && s.state.row[row].y > -0.06);
    }
    print_message("highest grain at %.4g m, the tray bears %.4g of the weight, residual %.2g\n", highest,
                  -force_on(&s, 2)[1] / weight, worst);
    assert_true(highest < -0.03 && worst < 1e-3);
    assert_true(force_on(&s, 0)[1] == 0 && force_on(&s, 1)[1] == 0);
    close_both(&s, c);
}

/// A row of fixed polygons bears what lies on it: the force that holds it is the weight of all.
static const char rough_text[] = MATTER
    "particles: {shape: polygon, thickness: 1 m, material: stone, count: 9, distribution: equal, radius: 1 cm}\n"
    "walls: [{shape: plane, name: far, point: [0, -1], normal: [0, 1]}]\n"
    "selections:\n  - {select: box, name: bottom, lower: [0, 0], upper: [1, 2 cm]}\n"
    "loads:\n  - {load: prescribed, selection: bottom, velocity_x: 0, velocity_y: 0, spin_z: 0}\n" STAGES(
        "{position: [0.1, 1.5 cm]}, {position: [0.12, 1.5 cm], angle: 0.4}, {position: [0.14, 1.5 cm], angle: 0.9}, "
        "{position: [0.16, 1.5 cm], angle: 1.3}, {position: [0.18, 1.5 cm], angle: 2}, {position: [0.2, 1.5 cm]}, "
        "{position: [0.13, 4 cm]}, {position: [0.155, 4 cm], angle: 0.5}, {position: [0.15, 6.5 cm], angle: 1}",
        "0.6 s");

static void a_rough_bottom_bears_grains(void **unused)
{
    (void)unused;
    scree_case *c;
    scree_simulation s = open_with(rough_text, NULL, 0, &c);
    const double worst = simulation_finish(&s);
    double reaction[8], weight = 0, fastest = 0;
    scree_error error;
    const scree_context context = scree_step_context(&s);
    check(scree_module_prescribed.columns.measure(&context, 0, reaction, &error), &error);
    for (size_t row = 0; row < s.state.count; row++) {
        weight += 10 * scree_body_mass(&s.state, row);
        if (scree_body_held(&s.state, row)) {
            assert_true(s.state.row[row].y == 0.015 && fabs(s.state.row[row].vy) < 1e-12);
            continue;
        }
        fastest = fmax(fastest, hypot(s.state.row[row].vx, s.state.row[row].vy));
        assert_true(s.state.row[row].y > 0.02);
    }
    print_message("the load holds %.9g of the weight, fastest %.2g m/s, residual %.2g\n", reaction[1] / weight, fastest,
                  worst);
    assert_true(fabs(reaction[1] / weight - 1) < 1e-9 && fastest < 1e-4);
    close_both(&s, c);
}

/// The pour stage takes a bottom of fixed polygons: what is poured beside walls that are polygons comes to rest on it.
static void grains_are_poured_on_a_rough_bottom(void **unused)
{
    (void)unused;
    static const char text[] = MATTER
        "particles: {shape: polygon, thickness: 1 m, material: stone, count: 12, distribution: equal, radius: 1 cm}\n"
        "walls:\n  - {shape: polygon, name: left, corners: [[0, -3 cm], [8 cm, -3 cm], [6 cm, 20 cm], [0, 20 cm]]}\n"
        "  - {shape: box, name: right, side: outside, lower: [22 cm, -3 cm], upper: [30 cm, 20 cm]}\n"
        "selections: [{select: ids, name: bottom, ids: [0, 1, 2, 3, 4, 5]}]\n"
        "loads: [{load: prescribed, selection: bottom, velocity_x: 0, velocity_y: 0, spin_z: 0}]\n"
        "sources: [{source: line, start: [12 cm, 15 cm], end: [18 cm, 15 cm], interval: 0.1 s}]\n"
        "stages:\n  - {stage: prepare, method: bodies, width: 30 cm, height: 20 cm, bodies: [{position: [9.5 cm, 0]}, "
        "{position: [11.5 cm, 0], angle: 0.4}, {position: [13.5 cm, 0], angle: 0.9}, {position: [15.5 cm, 0], angle: "
        "1.3}, {position: [17.5 cm, 0], angle: 2}, {position: [19.5 cm, 0]}]}\n"
        "  - {stage: pour, unbalanced_limit: 1e-4}\n  - {stage: relax, duration: 0.5 s}\n";
    scree_case *c;
    scree_simulation s = open_with(text, NULL, 0, &c);
    (void)simulation_finish(&s);
    double reaction[8], up, weight = 0;
    scree_error error;
    const scree_context context = scree_step_context(&s);
    check(scree_module_prescribed.columns.measure(&context, 0, reaction, &error), &error);
    assert_int_equal(s.state.count, 12);
    for (size_t row = 0; row < s.state.count; row++) {
        weight += 10 * scree_body_mass(&s.state, row);
        assert_true(s.state.id[row] < 6 || s.state.row[row].y > 0);
    }
    up = reaction[1] - force_on(&s, 0)[1] - force_on(&s, 1)[1];
    print_message("bottom and walls hold %.6g of the weight\n", up / weight);
    assert_true(fabs(up / weight - 1) < 1e-3);
    close_both(&s, c);
}

// ---- nothing but the state -----------------------------------------------------------------------------------------

enum { FORGET = 1, LOSE = 2 };

static uint64_t bits_of(const char *const *overrides, size_t count, int threads, int disturbance)
{
    scree_case *c;
    scree_simulation s = open_with(falling_text, overrides, count, &c);
    simulation_lose_work(&s, threads);
    s.work.keep_threads = true;
    for (int k = 0; simulation_goes_on(&s); k++) {
        if (disturbance == FORGET && k % 3 == 0) scree_neighbours_invalidate(&s.work);
        if (disturbance == LOSE && k % 997 == 500) simulation_lose_work(&s, threads);
        simulation_step(&s);
    }
    const uint64_t bits = simulation_bits(&s);
    close_both(&s, c);
    return bits;
}

static void nothing_but_the_state_decides(void **unused)
{
    (void)unused;
    const uint64_t expected = bits_of(NULL, 0, 1, 0);
    assert_true(bits_of(NULL, 0, 3, 0) == expected);
    assert_true(bits_of(NULL, 0, 1, FORGET) == expected);
    assert_true(bits_of(NULL, 0, 2, LOSE) == expected);
    const char *const other[] = {"walls.paddle.frequency=41 1/s"};
    assert_true(bits_of(other, 1, 1, 0) != expected);
}

/// A run that is stopped while grains lie on walls that move, and one that is not, end in the same state.
static void a_restart_goes_on(void **unused)
{
    (void)unused;
    char folder[64], whole[100], part[100];
    assert_true(scratch_create(folder));
    (void)snprintf(whole, sizeof whole, "%s/whole", folder);
    (void)snprintf(part, sizeof part, "%s/part", folder);
    const char *const stages =
        "stages=[{stage: prepare, method: gas, width: 32 mm, solid_fraction: 30 %, velocity: 0.5 m/s}, {stage: relax, "
        "boundary: walls, duration: 50 ms}, {stage: relax, boundary: walls, duration: 20 ms}]";
    scree_case *c = case_read(falling_text, &stages, 1);
    run_restart(c, whole, part, 2, "stage relax ended");
    scree_case_free(c);
    scratch_destroy(folder);
}

// ---- what is wrong -------------------------------------------------------------------------------------------------

static void what_is_wrong_is_said(void **unused)
{
    (void)unused;
    static const char *const wrong[][2] = {
        {"[[0, 0], [0, 1], [1, 1], [1, 0]]", "clockwise"},
        {"[[0, 0], [1, 0], [0.2, 0.2], [0, 1]]", "corner"},
        {"[[0, 0], [1, 0]]", "corner"},
        {"[[0, 0], [1, 0], [1, 0], [0, 1]]", "corner"},
        {"[[0, 0], [1, 0], [2, 0], [0, 1]]", "corner"},
        {"[]", "corner"},
    };
    for (size_t k = 0; k < COUNT_OF(wrong); k++) {
        char walls[160], line[1024];
        scree_case *c;
        scree_problems *problems;
        (void)snprintf(walls, sizeof walls, "walls=[{shape: polygon, corners: %s}]", wrong[k][0]);
        const char *const overrides[] = {walls};
        assert_int_equal(case_parse(edge_text, overrides, 1, &c, &problems), SCREE_ERROR_INPUT);
        scree_error_format(scree_problems_get(problems, 0), line, sizeof line);
        print_message("%s\n", line);
        assert_non_null(strstr(line, "walls"));
        assert_non_null(strstr(line, wrong[k][1]));
        scree_problems_free(problems);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_grain_rests_on_an_edge),
        cmocka_unit_test(grains_rest_on_corners),
        cmocka_unit_test(a_corner_counts_once),
        cmocka_unit_test(nothing_acts_before_outlines_meet),
        cmocka_unit_test(it_slides_over_a_joint),
        cmocka_unit_test(the_balance_closes_beside_moving_walls),
        cmocka_unit_test(a_moving_wall_is_one_at_rest_from_elsewhere),
        cmocka_unit_test(a_servo_presses),
        cmocka_unit_test(discs_under_other_laws_see_a_box),
        cmocka_unit_test(a_funnel_is_emptied),
        cmocka_unit_test(a_rough_bottom_bears_grains),
        cmocka_unit_test(grains_are_poured_on_a_rough_bottom),
        cmocka_unit_test(nothing_but_the_state_decides),
        cmocka_unit_test(a_restart_goes_on),
        cmocka_unit_test(what_is_wrong_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
