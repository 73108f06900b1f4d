/// Polygons in runs: they slide and topple as closed forms say; momentum and energy are kept, with the
/// order of the scheme; discs run among them; nothing but the state decides.
#include "run_fixture.h"

#include "io_scratch.h"

#include "integrate/integrate.h"
#include "shape/half_plane_overlap.h"
#include "shape/polygon_make.h"
#include "shape/polygons.h"

// ---- cases ---------------------------------------------------------------------------------------------------------

/// One regular polygon on a floor; gravity is turned in place of the floor.
static const char one_text[] = "scree: 1\n"
                               "name: one\n"
                               "dimension: 2\n"
                               "gravity: [0, -10]\n"
                               "materials:\n"
                               "  - {name: stone, young_modulus: 1e8 Pa, density: 2500 kg/m3, friction: 0.5}\n"
                               "particles: {shape: polygon, outline: regular, corners_min: 6, corners_max: 6,\n"
                               "            thickness: 1 m, material: stone, count: 1, distribution: equal,\n"
                               "            radius: 1 cm}\n"
                               "contact: {law: polygon_potential}\n"
                               "integrator: {scheme: velocity_verlet, step: 2e-6 s}\n"
                               "walls:\n"
                               "  - {shape: plane, name: floor, point: [0, 0], normal: [0, 1]}\n"
                               "stages:\n"
                               "  - stage: prepare\n"
                               "    method: bodies\n"
                               "    width: 1 m\n"
                               "    height: 1 m\n"
                               "    bodies: [{position: [0.5 m, 9.523065e-3 m], angle: 0}]\n"
                               "  - {stage: relax, boundary: walls, duration: 0.2 s}\n";

/// A gas between three walls.
#define GAS(particles)                                                                                                 \
    "scree: 1\n"                                                                                                       \
    "name: gas\n"                                                                                                      \
    "dimension: 2\n"                                                                                                   \
    "seed: 3\n"                                                                                                        \
    "gravity: [0, -10]\n"                                                                                              \
    "materials:\n"                                                                                                     \
    "  - {name: stone, young_modulus: 1e7 Pa, density: 5000 kg/m3, friction: 0.5}\n" particles                         \
    "contact: {law: polygon_overlap}\n"                                                                                \
    "integrator: {scheme: velocity_verlet, step: 5e-6 s}\n"                                                            \
    "walls:\n"                                                                                                         \
    "  - {shape: plane, point: [0, 0], normal: [0, 1]}\n"                                                              \
    "  - {shape: plane, point: [0, 0], normal: [1, 0]}\n"                                                              \
    "  - {shape: plane, point: [32 mm, 0], normal: [-1, 0]}\n"                                                         \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, method: gas, width: 32 mm, solid_fraction: 30 %, velocity: 0.5 m/s}\n"                       \
    "  - {stage: relax, boundary: walls, duration: 0.06 s}\n"
static const char gas_text[] = GAS("particles: {shape: polygon, thickness: 1 m, material: stone, count: 24,\n"
                                   "            distribution: uniform, radius_min: 2 mm, radius_max: 3 mm}\n");
static const char mixed_text[] =
    GAS("particles:\n"
        "  thickness: 1 m\n"
        "  count: 24\n"
        "  species:\n"
        "  - {name: grains, shape: polygon, material: stone, share: 0.5, distribution: equal, radius: 2 mm}\n"
        "  - {name: discs, shape: disc, material: stone, share: 0.5, distribution: equal, radius: 2.5 mm}\n");

#define COUNT_OF(list) (sizeof(list) / sizeof *(list))

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

// ---- one polygon on a floor ----------------------------------------------------------------------------------------

/// Runs to the end under gravity turned by `slope` [degrees] against the floor.
static scree_simulation slide(double slope, const char *friction, const char *angle, scree_case **c)
{
    char gravity[96], turned[64];
    const double a = slope * M_PI / 180;
    (void)snprintf(gravity, sizeof gravity, "gravity=[%.17g, %.17g]", 10 * sin(a), -10 * cos(a));
    (void)snprintf(turned, sizeof turned, "stages.0.bodies.0.angle=%s degrees", angle);
    const char *const overrides[] = {gravity, friction, turned};
    scree_simulation s = open_with(one_text, overrides, COUNT_OF(overrides), c);
    (void)simulation_finish(&s);
    return s;
}

/// Of a hexagon that lies on an edge. It starts some way above the floor and takes 0.02 s to come to rest on it.
static void it_slides_as_coulomb_says(void **unused)
{
    (void)unused;
    scree_case *c;
    scree_simulation s = slide(20, "materials.0.friction=0.2", "0", &c);
    scree_vector velocity, spin;
    scree_body_velocity(&s.model, &s.state, 0, velocity, spin);
    const double a = 20 * M_PI / 180, expected = 10 * (sin(a) - 0.2 * cos(a)) * 0.2;
    print_message("velocity %.5f m/s, expected %.5f\n", velocity[0], expected);
    assert_true(fabs(velocity[0] / expected - 1) < 0.01);
    assert_true(fabs(spin[2]) < 1e-3);
    close_both(&s, c);
    s = slide(10, "materials.0.friction=0.2", "0", &c);
    scree_body_velocity(&s.model, &s.state, 0, velocity, spin);
    assert_true(fabs(velocity[0]) < 1e-6);
    close_both(&s, c);
}

/// A hexagon stands on an edge as long as the slope is below 30 degrees, where its centre is above a corner;
/// gravity that is turned at once makes it rock.
static void it_topples_where_its_centre_passes_a_corner(void **unused)
{
    (void)unused;
    scree_case *c;
    scree_vector velocity, spin;
    scree_simulation s = slide(14, "materials.0.friction=2", "0", &c);
    scree_body_velocity(&s.model, &s.state, 0, velocity, spin);
    print_message("below: spin %.3g rad/s, angle %.3g, velocity %.3g m/s\n", spin[2], s.state.angle[0], velocity[0]);
    assert_true(fabs(spin[2]) < 1e-3);
    assert_true(fabs(s.state.angle[0]) < 1e-3);
    close_both(&s, c);
    s = slide(26, "materials.0.friction=2", "0", &c);
    assert_true(fabs(s.state.angle[0]) < 0.02);
    close_both(&s, c);
    s = slide(31, "materials.0.friction=2", "0", &c);
    assert_true(s.state.angle[0] < -0.02);
    close_both(&s, c);
}

/// What the floor bears is the weight, and the contact points are under the grain.
static void the_floor_bears_the_weight(void **unused)
{
    (void)unused;
    scree_case *c;
    const char *const longer[] = {"stages.1.duration=0.5 s"};
    scree_simulation s = open_with(one_text, longer, 1, &c);
    (void)simulation_finish(&s);
    const double weight = 10 * scree_body_mass(&s.state, 0), force = scree_case_walls(&s.state)->load[0].force[1];
    assert_true(fabs(force / weight + 1) < 1e-9);
    const double area = M_PI * 1e-4, inertia = scree_body_inertia(&s.state, 0);
    assert_true(fabs(scree_body_mass(&s.state, 0) / (2500 * area) - 1) < 1e-12);
    // Of a hexagon of side a: 5 sqrt(3) / 16 a^4 times the density, area 3 sqrt(3) / 2 a^2.
    const double side2 = area / (1.5 * sqrt(3.0));
    assert_true(fabs(inertia / (2500 * 5 * sqrt(3.0) / 8 * side2 * side2) - 1) < 1e-12);
    close_both(&s, c);
}

// ---- energy and momentum -------------------------------------------------------------------------------------------

static double residual_of(const char *text, const char *const *overrides, size_t count, double *law_share)
{
    scree_case *c;
    scree_simulation s = open_with(text, overrides, count, &c);
    const double worst = simulation_finish(&s);
    const scree_ledger *ledger = &s.state.ledger;
    *law_share = fabs(ledger->stiffness) / fabs(ledger->initial - ledger->gravity);
    close_both(&s, c);
    return worst;
}

#define LOSSLESS "materials.0.friction=0", "materials.0.damping_constant=0"

/// Under the law with a potential nothing is accumulated, and the energy is kept with the order of the scheme, to
/// better than 1e-6 of the work in steps of 0.5 us.
static void a_potential_keeps_its_energy(void **unused)
{
    (void)unused;
    const char *const steps[] = {"integrator.step=5e-6 s", "integrator.step=1.25e-6 s", "integrator.step=0.5e-6 s"};
    double residual[COUNT_OF(steps)], share;
    for (size_t i = 0; i < COUNT_OF(steps); i++) {
        const char *const overrides[] = {LOSSLESS, "contact.law=polygon_potential", steps[i]};
        residual[i] = residual_of(gas_text, overrides, COUNT_OF(overrides), &share);
        assert_true(share == 0);
    }
    print_message("residual %.3g, with a quarter of the step %.3g, with a tenth %.3g\n", residual[0], residual[1],
                  residual[2]);
    assert_true(residual[0] < 1e-4);
    assert_true(residual[1] < residual[0] / 8);
    assert_true(residual[2] < 1e-6);
}

/// The law without a potential has its row; with it the balance closes to round-off, with dashpots and friction, too,
/// and whatever the step.
static void the_balance_of_the_other_law_has_a_row(void **unused)
{
    (void)unused;
    const char *const coarse[] = {LOSSLESS}, *const fine[] = {LOSSLESS, "integrator.step=1.25e-6 s"};
    const char *const damped[] = {"integrator.step=1.25e-6 s"};
    double share[3];
    const double first = residual_of(gas_text, coarse, 2, &share[0]),
                 second = residual_of(gas_text, fine, 3, &share[1]);
    const double third = residual_of(gas_text, damped, 1, &share[2]);
    print_message("residual %.3g, with a quarter of the step %.3g (law %.2g); damped %.3g (law %.2g)\n", first, second,
                  share[1], third, share[2]);
    assert_true(first < 1e-8 && second < 1e-8 && third < 1e-8);
    assert_true(share[1] > 1e-4);
}

/// A pair in free space: linear and angular momentum, whatever the law does.
static void momentum_is_kept(void **unused)
{
    (void)unused;
    scree_case *c;
    const char *const overrides[] = {
        "gravity=[0, 0]", "particles.count=2", "contact.law=polygon_overlap",
        ("stages.0.bodies=[{position: [0.5 m, 0.5 m], spin: [0, 0, 30]}, {position: [0.52 m, "
         "0.507 m], velocity: [-1, 0.2], angle: 0.3}]"),
        "stages.1.duration=0.01 s"};
    scree_simulation s = open_with(one_text, overrides, COUNT_OF(overrides), &c);
    double before[3] = {0}, after[3] = {0};
    for (int pass = 0; pass < 2; pass++) {
        double *sum = pass ? after : before;
        if (pass) (void)simulation_finish(&s);
        while (!pass && s.state.stage.index < 1) simulation_step(&s);
        for (size_t row = 0; row < s.state.count; row++) {
            const scree_row *body = &s.state.row[row];
            scree_vector velocity, spin;
            scree_body_velocity(&s.model, &s.state, row, velocity, spin);
            sum[0] += body->mass * velocity[0];
            sum[1] += body->mass * velocity[1];
            sum[2] += body->mass * (body->x * velocity[1] - body->y * velocity[0]) +
                      scree_body_inertia(&s.state, row) * spin[2];
        }
    }
    print_message("momentum %.17g %.17g %.17g\n", after[0], after[1], after[2]);
    assert_true(s.state.ledger.damping > 0);
    for (int k = 0; k < 2; k++) assert_true(fabs(after[k] - before[k]) < 1e-12 * fabs(before[0]));
    assert_true(fabs(after[2] - before[2]) < 1e-9 * fabs(before[2]));
    close_both(&s, c);
}

/// Where the two of a pair end, whichever comes first in the case. Exchanged, they are found in the other order.
static void end_of_pair(const char *angle, bool exchanged, double end[2][3])
{
    scree_case *c;
    char bodies[320], one[96], other[128];
    (void)snprintf(one, sizeof one, "{position: [0.5 m, 0.5 m], spin: [0, 0, 30], angle: 0}");
    (void)snprintf(other, sizeof other, "{position: [0.52 m, 0.507 m], velocity: [-1, 0.2], angle: %s}", angle);
    (void)snprintf(bodies, sizeof bodies, "stages.0.bodies=[%s, %s]", exchanged ? other : one, exchanged ? one : other);
    const char *const overrides[] = {"gravity=[0, 0]", "particles.count=2", "contact.law=polygon_overlap", bodies,
                                     "stages.1.duration=0.01 s"};
    scree_simulation s = open_with(one_text, overrides, COUNT_OF(overrides), &c);
    (void)simulation_finish(&s);
    for (size_t row = 0; row < 2; row++) {
        double *of = end[s.state.id[row] ^ exchanged];
        scree_vector velocity, spin;
        scree_body_velocity(&s.model, &s.state, row, velocity, spin);
        of[0] = s.state.row[row].x;
        of[1] = s.state.row[row].y;
        of[2] = spin[2] * 0.01;
    }
    close_both(&s, c);
}

/// Two bodies that are exchanged move as they did, to round-off: no side of a contact is asked alone.
static void exchanged_they_move_alike(void **unused)
{
    (void)unused;
    double worst = 0, turned = 0;
    for (int k = 0; k < 24; k++) {
        char angle[32];
        double end[2][2][3];
        (void)snprintf(angle, sizeof angle, "%.6g", 0.1 + 0.26 * k);
        for (int exchanged = 0; exchanged < 2; exchanged++) end_of_pair(angle, exchanged, end[exchanged]);
        for (int i = 0; i < 6; i++) worst = fmax(worst, fabs(end[1][i / 3][i % 3] - end[0][i / 3][i % 3]));
        turned = fmax(turned, fabs(end[0][1][2]));
    }
    print_message("exchanged: %.2g m apart\n", worst);
    assert_true(turned > 1e-3);
    assert_true(worst < 1e-12);
}

// ---- equations of R that are misprinted
// ------------------------------------------------------------------------------

/// Two squares of equal area, face to face with an overlap of 2 um, without friction, damping and gravity; the second
/// is `right` of the first. Velocities and spins are given.
static scree_simulation two_squares(const char *first, const char *second, const char *friction, double apart,
                                    scree_case **c)
{
    char bodies[320];
    (void)snprintf(bodies, sizeof bodies,
                   "stages.0.bodies=[{position: [0.5 m, 0.5 m], angle: 45 degrees, %s}, {position: [%.17g m, 0.5 m], "
                   "angle: 45 degrees, %s}]",
                   first, 0.5 + apart, second);
    const char *const overrides[] = {"particles.count=2",
                                     "particles.corners_min=4",
                                     "particles.corners_max=4",
                                     "gravity=[0, 0]",
                                     "contact.law=polygon_overlap",
                                     "materials.0.damping_constant=0",
                                     "guard.overlap=0.5",
                                     friction,
                                     bodies};
    return open_with(one_text, overrides, COUNT_OF(overrides), c);
}

static double side_of(double radius)
{
    return radius * sqrt(M_PI);
}

/// R 2.10, a tenth of pi sqrt(m / Y) (R prints sqrt(pi m / Y)): two squares of side a that meet face to face have the
/// depth a d / l with l = a / 4, so a spring of 4 Y between two halves of m: the impact takes pi sqrt(m / (8 Y)). What
/// the law says of an impact has its own spring, 2.5 Y.
static void the_step_of_the_source_is_a_tenth_of_half_a_period(void **unused)
{
    (void)unused;
    scree_case *c;
    const double side = side_of(0.01);
    scree_simulation s = two_squares("velocity: [0.1, 0]", "velocity: [-0.1, 0]", "materials.0.friction=0", side, &c);
    while (s.state.stage.index < 1) simulation_step(&s);
    const double mass = scree_body_mass(&s.state, 0), stiffness = 1e8, half = M_PI * sqrt(mass / stiffness);
    scree_vector velocity, spin;
    double first = 0, last = 0;
    for (bool apart = false; !apart;) {
        simulation_step(&s);
        const double d = side - (s.state.row[1].x - s.state.row[0].x), now = (double)s.state.step * s.model.step;
        scree_body_velocity(&s.model, &s.state, 0, velocity, spin);
        if (d > 0 && first == 0) first = now;
        apart = first > 0 && d <= 0;
        last = now;
    }
    print_message("impact %.6g s, pi sqrt(m/Y) %.6g s, velocity %.6g m/s\n", last - first, half, velocity[0]);
    assert_true(fabs(velocity[0] / 0.1 + 1) < 1e-3);                 // second order in 49 steps
    assert_true(fabs((last - first) * sqrt(8.0) / half - 1) < 0.03); // to a step of 49
    scree_impact impact;
    scree_error error;
    const scree_law_use *law = scree_model_law_between(&s.model, 0, 0);
    check(scree_law_get(law->law)->impact(law, &s.model.pairs[0][0], 0.005, mass / 2, 0.2, &impact, &error), &error);
    assert_true(fabs(impact.duration * sqrt(5.0) / half - 1) < 1e-12);
    close_both(&s, c);
}

/// R 2.36 with the sign of omega x r of each body that a rigid rotation asks for: two squares that turn together about
/// the middle of their contact do not slip; with the opposite spin they slip by twice their way.
static void a_rigid_rotation_gives_no_slip(void **unused)
{
    (void)unused;
    double slip[2];
    for (int k = 0; k < 2; k++) {
        scree_case *c;
        const double apart = side_of(0.01) - 2e-6;
        char first[80], second[80];
        (void)snprintf(first, sizeof first, "velocity: [0, %.17g], spin: [0, 0, %s]", -0.5 * apart, k ? "-1" : "1");
        (void)snprintf(second, sizeof second, "velocity: [0, %.17g], spin: [0, 0, %s]", 0.5 * apart, k ? "-1" : "1");
        scree_simulation s = two_squares(first, second, "materials.0.friction=10", apart, &c);
        while (s.state.stage.index < 1) simulation_step(&s);
        for (int n = 0; n < 3; n++) simulation_step(&s);
        assert_int_equal(s.work.pairs.count, 1);
        slip[k] = fabs(s.work.pairs.history[0].value[0]) / (3 * s.model.step * apart);
        close_both(&s, c);
    }
    print_message("slip over the way: %.3g, %.3g\n", slip[0], slip[1]);
    assert_true(slip[0] < 1e-4 && fabs(slip[1] - 2) < 1);
}

/// A hexagon that rocks on an edge, pressed in and turned, let out and turned back: the work of the force of R round
/// the closed path of its pose is a tenth of what was done on the way; that of the gradient is none.
static void only_one_law_has_a_potential(void **unused)
{
    (void)unused;
    enum { STEPS = 4000 };
    double corner[6][2], work[2] = {0}, done[2] = {0}, last = 0, share[2] = {0};
    scree_polygon_make_regular(6, 1, corner);
    for (int k = 0; k <= STEPS; k++) {
        const double way = 4.0 * k / STEPS, part = way - floor(way), rock = 4e-3;
        const int side = (int)way % 4;
        const double depth = 1e-3 * (side == 0 ? part : side == 1 ? 1 : side == 2 ? 1 - part : 0);
        const double angle = rock * (side == 0 ? 0 : side == 1 ? part : side == 2 ? 1 : 1 - part);
        double posed[6][2], apothem = 0;
        scree_polygon_turn(6, (const double(*)[2])corner, cos(angle), sin(angle), posed);
        for (int i = 0; i < 6; i++) apothem = fmax(apothem, corner[i][1]);
        const scree_polygon polygon = {(const double(*)[2])posed, 6, 1, 1.2};
        scree_overlap o = {.area = 0};
        const bool meet = scree_polygon_half_plane_overlap(&polygon, (const double[2]){0, 1}, apothem - depth, &o);
        const double chord = hypot(o.chord[0], o.chord[1]), length = meet ? hypot(o.arm[0][0], o.arm[0][1]) : 1;
        const double now[2] = {meet ? o.area / (length * chord) : 0, o.area};
        for (int law = 0; law < 2 && k > 0; law++) {
            const double step = 0.5 * (now[law] + share[law]) * (o.area - last);
            work[law] += step;
            done[law] += fabs(step);
        }
        last = o.area;
        memcpy(share, now, sizeof share);
    }
    print_message("closed path: %.3g of the work, %.3g\n", work[0] / done[0], work[1] / done[1]);
    assert_true(fabs(work[0] / done[0]) > 0.03);
    assert_true(fabs(work[1] / done[1]) < 1e-9);
}

// ---- bodies that are placed in contact, or beyond the box -----------------------------------------------------------

static scree_energy energy_now(scree_simulation *s)
{
    scree_contact_table table = {0};
    scree_energy energy;
    scree_error error;
    check(scree_neighbours_refresh(&s->model, &s->state, &s->work, &error), &error);
    check(scree_contact_table_build(&s->model, &s->state, &s->work, &table, &error), &error);
    scree_energy_measure(&s->model, &s->state, &table, &energy);
    scree_contact_table_destroy(&table);
    return energy;
}

/// What contacts hold at the begin is in the ledger's account once: two squares 2 um in each other, and a hexagon as
/// deep in the floor, come apart with that energy, and the balance is closed from the first step on: to the quanta of
/// that step, which are of the largest overlap that the guard lets pass.
static void overlaps_at_the_begin_count_once(void **unused)
{
    (void)unused;
    const char *const pressed[] = {"contact.law=polygon_overlap", "stages.0.bodies.0.position=[0.5 m, 9.521065e-3 m]"};
    for (int k = 0; k < 2; k++) {
        scree_case *c;
        scree_simulation s = k ? open_with(one_text, pressed, COUNT_OF(pressed), &c)
                               : two_squares("velocity: [0.01, 0]", "velocity: [-0.01, 0]", "materials.0.friction=0.5",
                                             side_of(0.01) - 2e-6, &c);
        double worst = 0, first = NAN;
        for (int n = 0; n < 200; n++) {
            simulation_step(&s);
            if (s.state.evaluations == 0) continue;
            const scree_energy energy = energy_now(&s);
            if (isnan(first)) first = energy.elastic_normal;
            worst = fmax(worst, energy.relative);
        }
        print_message("held %.3g J, now %.3g J; residual %.2g\n", first, energy_now(&s).elastic_normal, worst);
        assert_true(first > 1e-6 && s.state.ledger.initial > 0.99 * first);
        assert_true(worst < 1e-7);
        close_both(&s, c);
    }
}

/// Beside walls of the case a body may lie beyond the box that it is placed in: no plate of the box is ever there, and
/// none has held anything.
static void what_is_placed_beyond_the_box_holds_nothing(void **unused)
{
    (void)unused;
    static const char *const places[] = {"-1 mm", "2 mm", "-0.2 m"};
    for (size_t k = 0; k < COUNT_OF(places); k++) {
        char body[96];
        (void)snprintf(body, sizeof body, "stages.0.bodies=[{position: [0.5 m, %s], velocity: [1, 0]}]", places[k]);
        const char *const overrides[] = {"walls.0.point=[0, -0.5 m]", body};
        scree_case *c;
        scree_simulation s = open_with(one_text, overrides, COUNT_OF(overrides), &c);
        for (int n = 0; n < 50; n++) simulation_step(&s);
        const scree_energy energy = energy_now(&s);
        const double kinetic = 0.5 * scree_body_mass(&s.state, 0);
        assert_true(fabs(s.state.ledger.initial / kinetic - 1) < 1e-6);
        assert_true(s.state.ledger.plates == 0);
        assert_true(energy.scale < 4 * kinetic && energy.relative < 1e-12);
        close_both(&s, c);
    }
}

// ---- nothing but the state -----------------------------------------------------------------------------------------

enum { FORGET = 1, LOSE = 2 };

static uint64_t bits_of(const char *text, const char *const *overrides, size_t count, int threads, int disturbance)
{
    scree_case *c;
    scree_simulation s = open_with(text, overrides, count, &c);
    simulation_lose_work(&s, threads);
    s.work.keep_threads = true;
    for (int k = 0; k < 6000 && simulation_goes_on(&s); k++) {
        if (disturbance == FORGET && k % 3 == 0) scree_neighbours_invalidate(&s.work);
        if (disturbance == LOSE && k % 997 == 500) simulation_lose_work(&s, threads);
        simulation_step(&s);
    }
    scree_error error;
    check(scree_contacts_save(&s.state, &s.work, &error), &error);
    const uint64_t checksum = scree_state_checksum(&s.model, &s.state);
    close_both(&s, c);
    return checksum;
}

static void nothing_but_the_state_decides(void **unused)
{
    (void)unused;
    for (int mixed = 0; mixed < 2; mixed++) {
        const char *text = mixed ? mixed_text : gas_text;
        const uint64_t expected = bits_of(text, NULL, 0, 1, 0);
        assert_true(bits_of(text, NULL, 0, 3, 0) == expected);
        assert_true(bits_of(text, NULL, 0, 1, FORGET) == expected);
        assert_true(bits_of(text, NULL, 0, 2, LOSE) == expected);
        const char *const other[] = {"seed=4"};
        assert_true(bits_of(text, other, 1, 1, 0) != expected);
    }
}

/// Half of the bodies are discs.
static void discs_run_among_them(void **unused)
{
    (void)unused;
    const char *const potential[] = {LOSSLESS, "contact.law=polygon_potential", "integrator.step=2.5e-6 s"};
    const char *const fine[] = {LOSSLESS, "contact.law=polygon_potential", "integrator.step=1.25e-6 s"};
    double share;
    const double first = residual_of(mixed_text, potential, 4, &share),
                 second = residual_of(mixed_text, fine, 4, &share);
    print_message("residual %.3g, with half of the step %.3g\n", first, second);
    assert_true(first < 1e-4 && second < first / 2.5);
}

/// All of them are: there are no corners then.
static void discs_run_alone(void **unused)
{
    (void)unused;
#define DISCS "particles={shape: disc, material: stone, thickness: 1 m, count: 24, distribution: equal, radius: 2.5 mm}"
    const char *const potential[] = {DISCS, LOSSLESS, "contact.law=polygon_potential", "integrator.step=2.5e-6 s"};
    const char *const fine[] = {DISCS, LOSSLESS, "contact.law=polygon_potential", "integrator.step=1.25e-6 s"};
    double share;
    const double first = residual_of(gas_text, potential, COUNT_OF(potential), &share),
                 second = residual_of(gas_text, fine, COUNT_OF(fine), &share);
    print_message("residual %.3g, with half of the step %.3g\n", first, second);
    assert_true(first < 1e-4 && second < first / 2.5);
}

/// Outlines that are given, in the case or in a file with its columns in any order, have its angles and the area of the
/// disc of the drawn radius, with the centroid in the middle, whatever the unit.
static void outlines_are_given(void **unused)
{
    (void)unused;
    char folder[64], file[2][100], keys[400];
    assert_true(scratch_create(folder));
    static const char *const held[] = {"x,y\n0,0\n30,0\n0,40\n", "y,x\n0,0\n0,30\n40,0\n"};
    for (int k = 0; k < 2; k++) {
        (void)snprintf(file[k], sizeof file[k], "%s/outline%d.csv", folder, k);
        FILE *csv = fopen(file[k], "w");
        assert_non_null(csv);
        (void)fputs(held[k], csv);
        assert_int_equal(fclose(csv), 0);
    }
    const char *const said[] = {"[[0, 0], [3, 0], [0, 4]]", file[0], file[1]};
    for (int k = 0; k < 3; k++) {
        (void)snprintf(
            keys, sizeof keys,
            "particles={shape: polygon, outline: given, corners: %s, material: stone, thickness: 1 m, count: 9, "
            "radius_min: 2 mm, radius_max: 3 mm}",
            said[k]);
        const char *const override = keys;
        scree_case *c = case_read(gas_text, &override, 1);
        scree_simulation s;
        simulation_open(c, 1, &s);
        simulation_load(&s);
        for (size_t row = 0; row < s.state.count; row++) {
            const scree_corners of = scree_polygons_of(&s.state)->of[row];
            const double(*corner)[2] = (const double(*)[2])scree_polygons_of(&s.state)->corner + of.first;
            const scree_polygon_measures m = scree_polygon_measure(3, corner);
            const double unit = m.radius * sqrt(M_PI / 6); // of the triangle with the sides 3, 4, 5
            assert_int_equal(of.count, 3);
            assert_true(m.radius > 2e-3 && m.radius < 3e-3);
            assert_true(hypot(m.centroid[0], m.centroid[1]) < 1e-12 * unit);
            for (int i = 0; i < 3; i++) {
                const double *a = corner[i], *b = corner[(i + 1) % 3];
                assert_true(fabs(hypot(b[0] - a[0], b[1] - a[1]) / unit - (i == 0 ? 3 : i == 1 ? 5 : 4)) < 1e-9);
            }
        }
        scree_simulation_close(&s);
        scree_case_free(c);
    }
    scratch_destroy(folder);
}

// ---- what does not go together -------------------------------------------------------------------------------------

static void what_does_not_go_together_is_refused(void **unused)
{
    (void)unused;
    static const char *const wrong[][2] = {
        {"contact.law=linear",
         "sharp corners: give particles.rounding (0.1, say), or take one of the laws of areas: polygon_overlap"},
        {"particles.corners_max=5", "less than corners_min"},
        {"particles.corners_min=2", "too small"},
        {"particles.axis_ratio=0.9", "too small"},
        {"dimension=3", "polygons are bodies in the plane"},
        {"particles={shape: polygon, outline: given, corners: [[0, 0], [0, 1], [1, 1]], material: stone, count: 3}",
         "clockwise"},
        {"particles={shape: polygon, outline: given, corners: [[0, 0], [3, 0], [1, 1], [0, 3]], material: stone, "
         "count: 3}",
         "not convex at corner 2"},
        {"particles={shape: polygon, outline: given, material: stone, count: 3}", "required, but not given"},
        {"particles={shape: polygon, outline: given, corners: nowhere.csv, material: stone, count: 3}", "No such file"},
    };
    for (size_t k = 0; k < COUNT_OF(wrong); k++) {
        scree_case *c;
        scree_problems *problems;
        bool told = false;
        if (case_parse(gas_text, &wrong[k][0], 1, &c, &problems) == SCREE_OK) {
            // What only shows when values meet is for the model.
            scree_simulation s;
            scree_error error;
            assert_true(scree_simulation_open(c, 1, &s, &error) != SCREE_OK);
            if (!strstr(error.message, wrong[k][1])) fail_msg("%s: %s", wrong[k][0], error.message);
            scree_case_free(c);
            continue;
        }
        for (size_t i = 0; i < scree_problems_count(problems); i++)
            told = told || strstr(scree_problems_get(problems, i)->message, wrong[k][1]);
        if (!told) fail_msg("%s: %s", wrong[k][0], scree_problems_get(problems, 0)->message);
        scree_problems_free(problems);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_slides_as_coulomb_says),
        cmocka_unit_test(it_topples_where_its_centre_passes_a_corner),
        cmocka_unit_test(the_floor_bears_the_weight),
        cmocka_unit_test(a_potential_keeps_its_energy),
        cmocka_unit_test(the_balance_of_the_other_law_has_a_row),
        cmocka_unit_test(momentum_is_kept),
        cmocka_unit_test(exchanged_they_move_alike),
        cmocka_unit_test(the_step_of_the_source_is_a_tenth_of_half_a_period),
        cmocka_unit_test(a_rigid_rotation_gives_no_slip),
        cmocka_unit_test(only_one_law_has_a_potential),
        cmocka_unit_test(overlaps_at_the_begin_count_once),
        cmocka_unit_test(what_is_placed_beyond_the_box_holds_nothing),
        cmocka_unit_test(nothing_but_the_state_decides),
        cmocka_unit_test(discs_run_among_them),
        cmocka_unit_test(discs_run_alone),
        cmocka_unit_test(outlines_are_given),
        cmocka_unit_test(what_does_not_go_together_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
