/// The integrator gear: its order where forces are smooth, and what is left of it where contacts open and close; free
/// flight; momentum; the balance of energies; nothing but the state decides; what it refuses.
#include "io_scratch.h"
#include "library_fixture.h"

#include "integrate/integrate.h"
#include "run/stage.h"
#include "state/body.h"

#define COUNT_OF(list) (sizeof(list) / sizeof *(list))
#define GEAR           "integrator.scheme=gear"
#define WARN           "guard.stability=warn"
/// Bodies that meet in twos bear more than the estimate for a lattice.
#define WARNED "guard: {stability: warn}\n"

// ---- smooth forces --------------------------------------------------------------------------------------------------

/// A damped oscillator that is driven so that X(t) = A (1 - cos(v t))^4 solves it: all derivatives of order below 8
/// are zero at the begin, so that the scheme has its terms from the first step on. Whatever differs from X swings
/// and decays by itself.
typedef struct driven {
    double stiffness, damping;    ///< 1/s2, 1/s: both per mass or inertia
    double amplitude, turning, v; ///< m, rad, rad/s
    double centre[3];
    double deaf; ///< 1: follows the velocity of the rows instead of the predicted one
} driven;

/// X, X', X''.
static void motion_at(const driven *d, double amplitude, double time, double x[3])
{
    const double c = cos(d->v * time), s = sin(d->v * time), u = 1 - c, w = d->v;
    x[0] = amplitude * u * u * u * u;
    x[1] = amplitude * 4 * u * u * u * s * w;
    x[2] = amplitude * (12 * u * u * s * s + 4 * u * u * u * c) * w * w;
}

static int drive(void *user, scree_simulation *s, scree_loads *loads)
{
    const driven *d = user;
    const scree_state *state = &s->state;
    double place[2][3] = {{0}}, velocity[2][3] = {{0}}, spin[2][3] = {{0}}, flat[3][6];
    const size_t n = (size_t)state->dimension, turns = n == 3 ? 3 : 1;
    scree_simulation_copy(s, flat[0], flat[1], flat[2]);
    memcpy(place[0], flat[0], n * sizeof(double));
    memcpy(velocity[0], flat[1], n * sizeof(double));
    memcpy(spin[0] + 3 - turns, flat[2], turns * sizeof(double));
    scree_vector row_velocity, row_spin;
    scree_body_motion(state, state->row_of_id[0], row_velocity, row_spin);
    double x[3], angle[3], force[3] = {0}, torque[3] = {0};
    const double time = (double)state->step * state->tick, mass = scree_body_mass(state, state->row_of_id[0]);
    motion_at(d, d->amplitude, time, x);
    motion_at(d, d->turning, time, angle);
    const double along[3] = {0.8, -0.6, n == 3 ? 0.5 : 0};
    for (size_t k = 0; k < n; k++) {
        const double v = d->deaf > 0 ? row_velocity[k] : velocity[0][k];
        force[k] = mass * (along[k] * (x[2] + d->damping * x[1] + d->stiffness * x[0]) - d->damping * v -
                           d->stiffness * (place[0][k] - d->centre[k]));
    }
    const double inertia = scree_body_inertia(state, state->row_of_id[0]);
    const double turned = n == 2 ? state->angle[state->row_of_id[0]] : angle[0];
    torque[2] = inertia * (angle[2] + d->damping * (angle[1] - spin[0][2]) + d->stiffness * (angle[0] - turned));
    scree_loads_add(loads, 0, force, torque);
    return 0;
}

static void add(scree_simulation *s, scree_own_force_function *function, void *user, double force, double torque)
{
    scree_error error;
    const scree_own_force own = {
        .name = "own", .function = function, .user = user, .largest_force = force, .largest_torque = torque};
    check(scree_simulation_add_force(s, &own, &error), &error);
}

#define END 0.016 // s

/// Errors relative to the amplitudes.
typedef struct driven_error {
    double place, velocity, turn;
} driven_error;

static driven_error driven_by(const char *text, double step, double deaf)
{
    char size[64];
    (void)snprintf(size, sizeof size, "integrator.step=%.17g s", step);
    const char *const overrides[] = {GEAR, size, WARN};
    scree_case *c = case_read(text, overrides, 3);
    scree_simulation *s = library_create(c);
    const bool solid = s->state.dimension == 3;
    driven d = {.stiffness = 4e4, .damping = 100, .amplitude = 1e-4, .turning = 0.1, .v = 300, .deaf = deaf};
    library_advance_stage(s);
    scree_body_position(&s->state, s->state.row_of_id[0], d.centre);
    add(s, drive, &d, 1, 1e-3);
    library_advance(s, (uint64_t)llround(END / step));
    double x[3], angle[3];
    motion_at(&d, d.amplitude, END, x);
    motion_at(&d, d.turning, END, angle);
    scree_vector place, velocity, spin;
    const size_t row = s->state.row_of_id[0];
    scree_body_position(&s->state, row, place);
    scree_body_velocity(&s->stage_model, &s->state, row, velocity, spin);
    const double speed = 16 * d.amplitude * d.v;
    driven_error e = {.place = fabs(place[0] - d.centre[0] - 0.8 * x[0]) / d.amplitude,
                      .velocity = fabs(velocity[0] - 0.8 * x[1]) / speed,
                      .turn = solid ? fabs(spin[2] - angle[1]) / (16 * d.turning * d.v)
                                    : fabs(s->state.angle[row] - angle[0]) / d.turning};
    if (solid) e.place = fmax(e.place, fabs(place[2] - d.centre[2] - 0.5 * x[0]) / d.amplitude);
    scree_simulation_free(s);
    scree_case_free(c);
    return e;
}

static double order_of(double coarse, double fine)
{
    return log2(coarse / fine);
}

/// Own forces that depend on place and velocity.
static void it_is_of_fifth_order(void **unused)
{
    (void)unused;
    const char *const texts[] = {LIBRARY_PAIR, LIBRARY_PAIR_3D};
    for (int solid = 0; solid < 2; solid++) {
        driven_error e[5];
        for (int k = 0; k < 5; k++) e[k] = driven_by(texts[solid], 4e-4 / (1 << k), 0);
        for (int k = 0; k < 4; k++)
            print_message("%dD: place %.3g, order %.2f; velocity %.3g, %.2f; turn %.3g, %.2f\n", 2 + solid, e[k].place,
                          order_of(e[k].place, e[k + 1].place), e[k].velocity,
                          order_of(e[k].velocity, e[k + 1].velocity), e[k].turn, order_of(e[k].turn, e[k + 1].turn));
        assert_true(order_of(e[2].place, e[4].place) > 2 * 4.7);
        assert_true(order_of(e[2].velocity, e[4].velocity) > 2 * 4.7);
        assert_true(order_of(e[2].turn, e[4].turn) > 2 * 4.7);
        const driven_error deaf[] = {driven_by(texts[solid], 2e-4, 1), driven_by(texts[solid], 1e-4, 1)};
        print_message("with the velocity of the middle of the step: order %.2f\n",
                      order_of(deaf[0].place, deaf[1].place));
        assert_true(order_of(deaf[0].place, deaf[1].place) < 1.5);
    }
}

// ---- the coefficients ---------------------------------------------------------------------------------------------

/// A force that jumps, as a function of time [N/kg].
static double jumping(double time)
{
    return 3 * sin(900 * time) + (time > 0.004 && time < 0.0071 ? 5 : 0);
}

static int jump(void *user, scree_simulation *s, scree_loads *loads)
{
    const double mass = scree_body_mass(&s->state, s->state.row_of_id[0]);
    const double force[3] = {mass * jumping((double)s->state.step * s->state.tick), 0, 0};
    (void)user;
    scree_loads_add(loads, 0, force, NULL);
    return 0;
}

/// R 2.23 to 2.28 as they stand there, with matrix and vectors and the factor dt^2 / 2 of the error.
static void it_is_the_scheme_of_its_source(void **unused)
{
    (void)unused;
    enum { LAST = 1000 };
    static const double matrix[6][6] = {{1, 1, 1, 1, 1, 1},  {0, 1, 2, 3, 4, 5}, {0, 0, 1, 3, 6, 10},
                                        {0, 0, 0, 1, 4, 10}, {0, 0, 0, 0, 1, 5}, {0, 0, 0, 0, 0, 1}};
    static const double c[6] = {
        0.1875, 0.69722222222222222, 1, 0.61111111111111111, 0.16666666666666667, 0.016666666666666667};
    const char *const overrides[] = {GEAR, WARN};
    scree_case *read = case_read(LIBRARY_PAIR, overrides, 2);
    scree_simulation *s = library_create(read);
    library_advance_stage(s);
    add(s, jump, NULL, 1, 0);
    const double dt = 1e-5;
    double x[6] = {15e-3}, places = 0, velocities = 0;
    for (int n = 1; n <= LAST; n++) {
        double predicted[6] = {0};
        for (int i = 0; i < 6; i++)
            for (int k = 0; k < 6; k++) predicted[i] += matrix[i][k] * x[k];
        const double error = 0.5 * dt * dt * jumping((double)n * dt) - predicted[2];
        for (int i = 0; i < 6; i++) x[i] = predicted[i] + c[i] * error;
        library_advance(s, 1);
        scree_vector velocity, spin;
        const size_t row = s->state.row_of_id[0];
        scree_body_velocity(&s->stage_model, &s->state, row, velocity, spin);
        places = fmax(places, fabs(s->state.row[row].x - predicted[0]));
        velocities = fmax(velocities, fabs(velocity[0] - x[1] / dt));
    }
    print_message("off by %.2g m, %.2g m/s\n", places, velocities);
    assert_true(places < 1e-15 && velocities < 1e-12);
    scree_simulation_free(s);
    scree_case_free(read);
}

/// Bounded at nine tenths of the step that the scheme says it bears, not at three times of it.
static void it_bears_the_step_that_it_says(void **unused)
{
    (void)unused;
    const double ratios[] = {0, 0.1, 0.5, 2};
    const scree_integrator *integrator = scree_integrator_get(SCREE_SLOT_gear);
    for (size_t i = 0; i < COUNT_OF(ratios); i++)
        for (int beyond = 0; beyond < 2; beyond++) {
            const double frequency = 200, share = beyond ? 3 : 0.9;
            char size[64];
            (void)snprintf(size, sizeof size, "integrator.step=%.17g s",
                           share * integrator->limit(ratios[i]) / frequency);
            const char *const overrides[] = {GEAR, size, WARN};
            scree_case *c = case_read(LIBRARY_PAIR, overrides, 3);
            scree_simulation *s = library_create(c);
            driven d = {.stiffness = frequency * frequency, .damping = 2 * ratios[i] * frequency, .v = 1};
            library_advance_stage(s);
            scree_body_position(&s->state, s->state.row_of_id[0], d.centre);
            d.centre[0] += 1e-9;
            add(s, drive, &d, 1, 1e-3);
            double off = 0;
            for (int n = 0; n < 3000 && off < 100; n++) {
                library_advance(s, 1);
                off = fabs(s->state.row[s->state.row_of_id[0]].x - d.centre[0]) / 1e-9;
            }
            print_message("damping ratio %g, %g of the limit: %.3g\n", ratios[i], share, off);
            assert_true(beyond ? off >= 100 : off < 1.1);
            scree_simulation_free(s);
            scree_case_free(c);
        }
}

// ---- contacts that stay --------------------------------------------------------------------------------------------

/// Two bodies that are bonded: a spring and a dashpot along the normal, and in the tangent plane.
#define BONDED(head, shape, first, second)                                                                             \
    head "materials: [{name: glass, young_modulus: 1 MPa, density: 2500 kg/m3, friction: 0.4, damping_ratio: 0.2,\n"   \
         "             stiffness_ratio: 0.5}]\n"                                                                       \
         "particles: {" shape "material: glass, count: 2, distribution: equal, radius: 1 mm}\n"                        \
         "contact: {law: linear}\n"                                                                                    \
         "integrator: {scheme: gear, step: 1e-5 s}\n"                                                                  \
         "measure: {cells: no}\n"                                                                                      \
         "walls: [{shape: plane, point: " first "}]\n"                                                                 \
         "stages:\n"                                                                                                   \
         "  - {stage: prepare, method: bodies, width: 40 mm, height: 40 mm" second                                     \
         "  - {stage: bond, gap_tolerance: 1 um}\n"                                                                    \
         "  - {stage: relax, duration: 1 s, boundary: walls}\n"
static const char bonded_discs[] =
    BONDED("", "", "[0, -1 m], normal: [0, 1]",
           ",\n     bodies: [{position: [15 mm, 20 mm]}, {position: [16.2 mm, 21.6 mm]}]}\n");
static const char bonded_spheres[] = BONDED(
    "dimension: 3\n", "shape: sphere, ", "[0, 0, -1 m], normal: [0, 0, 1]",
    ", depth: 40 mm,\n     bodies: [{position: [15 mm, 20 mm, 20 mm]}, {position: [16.2 mm, 21.6 mm, 20 mm]}]}\n");

/// Draws both apart along the line of their centres, and swings the second one across it by `share`.
typedef struct pulled {
    double force, share, w;
} pulled;

static int pull(void *user, scree_simulation *s, scree_loads *loads)
{
    const pulled *p = user;
    const double time = (double)s->state.step * s->state.tick, u = 1 - cos(p->w * time), f = p->force * u * u * u * u;
    const double way[3] = {0.6, 0.8, 0}, side[3] = {-0.8, 0.6, 0};
    double first[3], second[3];
    for (int k = 0; k < 3; k++) {
        first[k] = -f * (way[k] + p->share * side[k]);
        second[k] = -first[k];
    }
    scree_loads_add(loads, 0, first, NULL);
    scree_loads_add(loads, 1, second, NULL);
    return 0;
}

/// The distance of the centres, and the spin of the first, at the end.
static void pull_bonded(const char *text, const char *scheme, double step, double share, double out[2])
{
    char size[64];
    (void)snprintf(size, sizeof size, "integrator.step=%.17g s", step);
    const char *const overrides[] = {scheme, size, WARN};
    scree_case *c = case_read(text, overrides, 3);
    scree_simulation *s = library_create(c);
    pulled p = {.force = 1e-2, .share = share, .w = 3000};
    library_advance_stage(s);
    library_advance_stage(s);
    const uint64_t before = s->state.step;
    assert_true(before == 0);
    add(s, pull, &p, 10, 0);
    library_advance(s, (uint64_t)llround(3.2e-3 / step));
    scree_vector place[2], velocity, spin;
    for (size_t k = 0; k < 2; k++) scree_body_position(&s->state, s->state.row_of_id[k], place[k]);
    scree_subtract(place[1], place[0], place[0]);
    scree_body_velocity(&s->stage_model, &s->state, s->state.row_of_id[0], velocity, spin);
    out[0] = scree_length(place[0]);
    out[1] = spin[2];
    scree_simulation_free(s);
    scree_case_free(c);
}

/// Order from three steps, each half of the last.
static void bonded_order(const char *text, const char *scheme, double share, double step, double order[2])
{
    double at[3][2];
    for (int k = 0; k < 3; k++) pull_bonded(text, scheme, step / (1 << k), share, at[k]);
    for (int k = 0; k < 2; k++) order[k] = order_of(fabs(at[0][k] - at[1][k]), fabs(at[1][k] - at[2][k]));
    print_message("%s, across %g: orders %.2f (changes %.3g, %.3g m), spin %.2f\n", scheme, share, order[0],
                  at[0][0] - at[1][0], at[1][0] - at[2][0], order[1]);
}

/// Along the normal the force of the contact is one of places and velocities; a tangential spring is summed.
static void contacts_that_stay(void **unused)
{
    (void)unused;
    const char *const texts[] = {bonded_discs, bonded_spheres};
    for (int solid = 0; solid < 2; solid++) {
        double order[2];
        bonded_order(texts[solid], GEAR, 0, 1.6e-5, order);
        assert_true(order[0] > 4.5);
        bonded_order(texts[solid], GEAR, 0.5, 4e-6, order);
        assert_true(order[0] > 1.7 && order[1] > 1.7);
        bonded_order(texts[solid], "integrator.scheme=velocity_verlet", 0, 1.6e-5, order);
        assert_true(order[0] < 1.5);
    }
}

// ---- contacts that open and close ----------------------------------------------------------------------------------

static const char pair_text[] =
    "dimension: 2\n"
    "materials: [{name: glass, young_modulus: 1 MPa, density: 2500 kg/m3, friction: 0, damping_ratio: 0}]\n"
    "particles: {material: glass, count: 2, distribution: equal, radius: 1 mm}\n"
    "contact: {law: linear}\n"
    "integrator: {scheme: gear, step: 1e-6 s}\n"
    "guard: {stability: warn}\n"
    "measure: {cells: no}\n"
    "walls: [{shape: plane, point: [0, -1 m], normal: [0, 1]}]\n"
    "stages:\n"
    "  - {stage: prepare, method: bodies, width: 40 mm, height: 40 mm,\n"
    "     bodies: [{position: [15 mm, 20 mm], velocity: [0.1, 0]}, {position: [17.01 mm, 20 mm], velocity: [-0.1, "
    "0]}]}\n"
    "  - {stage: relax, duration: 2 ms, boundary: walls}\n";

/// Largest error of the speed at which both part, relative, over places where the steps may fall.
static double rebound(const char *const *extra, size_t count, double step, double expected)
{
    double worst = 0;
    for (int k = 0; k < 8; k++) {
        char size[64], velocity[96];
        const char *overrides[8] = {size, velocity};
        (void)snprintf(size, sizeof size, "integrator.step=%.17g s", step);
        (void)snprintf(velocity, sizeof velocity, "stages.0.bodies.0.position=[%.17g mm, 20 mm]",
                       15 - 0.2e3 * step * k / 8);
        for (size_t i = 0; i < count; i++) overrides[2 + i] = extra[i];
        scree_case *c = case_read(pair_text, overrides, 2 + count);
        scree_simulation s;
        simulation_open(c, 1, &s);
        (void)simulation_finish(&s);
        scree_vector v[2], spin;
        for (size_t i = 0; i < 2; i++) scree_body_velocity(&s.model, &s.state, s.state.row_of_id[i], v[i], spin);
        assert_true(v[1][0] - v[0][0] > 0);
        worst = fmax(worst, fabs((v[1][0] - v[0][0]) / 0.2 - expected));
        scree_simulation_close(&s);
        scree_case_free(c);
    }
    return worst;
}

/// A linear spring bends at the first touch and at the last one; a dashpot jumps there.
static void contacts_that_open_and_close(void **unused)
{
    (void)unused;
    double error[4];
    for (int k = 0; k < 4; k++) error[k] = rebound(NULL, 0, 1.6e-5 / (1 << k), 1);
    print_message("restitution 1 is off by %.3g, %.3g, %.3g, %.3g: orders %.2f, %.2f, %.2f\n", error[0], error[1],
                  error[2], error[3], order_of(error[0], error[1]), order_of(error[1], error[2]),
                  order_of(error[2], error[3]));
    assert_true(error[3] < 2e-3);
    assert_true(order_of(error[0], error[3]) > 3 * 1.5);
    const char *const damped[] = {"materials.0.damping_ratio=0.3", GEAR, WARN},
                      *const other[] = {"materials.0.damping_ratio=0.3", "integrator.scheme=velocity_verlet"};
    // Until the force is zero (Schwager and Poeschel 2007), with the damping ratio z below 1 / sqrt(2).
    const double z = 0.3, b = sqrt(1 - z * z);
    const double expected = exp(-z / b * (M_PI - atan2(2 * z * b, 1 - 2 * z * z)));
    double off[2][3];
    for (int k = 0; k < 3; k++) {
        off[0][k] = rebound(damped, 3, 1.6e-5 / (1 << 2 * k), expected);
        off[1][k] = rebound(other, 2, 1.6e-5 / (1 << 2 * k), expected);
    }
    print_message("damped, %.4f is off by %.3g, %.3g, %.3g; velocity_verlet %.3g, %.3g, %.3g\n", expected, off[0][0],
                  off[0][1], off[0][2], off[1][0], off[1][1], off[1][2]);
    assert_true(off[0][2] < off[0][0] / 8 && off[0][2] < 5e-3);
}

// ---- nothing acts --------------------------------------------------------------------------------------------------

/// A parabola and a steady spin.
static void free_flight_is_exact(void **unused)
{
    (void)unused;
    const char *const discs[] = {GEAR, "gravity=[1, -10]", "stages.0.bodies.0.velocity=[0.3, 0.2]",
                                 "stages.0.bodies.0.spin=[0, 0, 7]", WARN};
    const char *const spheres[] = {GEAR, "gravity=[1, -10, 3]", "stages.0.bodies.0.velocity=[0.3, 0.2, -0.1]",
                                   "stages.0.bodies.0.spin=[1, 2, 7]", WARN};
    for (int solid = 0; solid < 2; solid++) {
        scree_case *c = case_read(solid ? LIBRARY_PAIR_3D : LIBRARY_PAIR, solid ? spheres : discs, 5);
        scree_simulation *s = library_create(c);
        library_advance_stage(s);
        library_advance(s, 5000);
        const double t = 5000 * 1e-5, g[3] = {1, -10, solid ? 3 : 0}, v[3] = {0.3, 0.2, solid ? -0.1 : 0};
        const double from[3] = {15e-3, 20e-3, solid ? 20e-3 : 0};
        scree_vector place, velocity, spin;
        const size_t row = s->state.row_of_id[0];
        scree_body_position(&s->state, row, place);
        scree_body_velocity(&s->stage_model, &s->state, row, velocity, spin);
        double off = 0, fast = 0;
        for (int k = 0; k < 3; k++) {
            off = fmax(off, fabs(place[k] - from[k] - v[k] * t - 0.5 * g[k] * t * t));
            fast = fmax(fast, fabs(velocity[k] - v[k] - g[k] * t));
        }
        print_message("off by %.2g m, %.2g m/s\n", off, fast);
        assert_true(off < 1e-14 && fast < 1e-13);
        assert_true(fabs(spin[2] - 7) < 1e-12 && fabs(spin[0] - solid) < 1e-12);
        if (!solid) assert_true(fabs(s->state.angle[row] - 7 * t) < 1e-13);
        const scree_energies energies = library_energies(s);
        assert_true(fabs(energies.residual) < 1e-12 * fabs(energies.gravity));
        scree_simulation_free(s);
        scree_case_free(c);
    }
}

/// A velocity that is set is the velocity.
static void a_velocity_that_is_set_is_told(void **unused)
{
    (void)unused;
    const char *const overrides[] = {GEAR, "gravity=[1, -10]", WARN};
    scree_case *c = case_read(LIBRARY_PAIR, overrides, 3);
    scree_simulation *s = library_create(c);
    library_advance_stage(s);
    library_advance(s, 300);
    scree_error error;
    const uint32_t id = 1;
    const double wanted[2] = {0.5, -0.25}, turning = 3;
    const scree_body_values values = {.count = 1, .id = &id, .velocity = wanted, .spin = &turning};
    check(scree_simulation_set(s, &values, &error), &error);
    double place[4], velocity[4], spin[2];
    scree_simulation_copy(s, place, velocity, spin);
    for (int k = 0; k < 2; k++) assert_true(fabs(velocity[2 + k] - wanted[k]) < 1e-15);
    assert_true(fabs(spin[1] - turning) < 1e-14);
    const double from = place[2];
    library_advance(s, 100);
    scree_simulation_copy(s, place, velocity, spin);
    assert_true(fabs(place[2] - from - 0.5 * 1e-3 - 0.5 * 1e-6) < 1e-15);
    const scree_energies energies = library_energies(s);
    assert_true(fabs(energies.residual) < 1e-12 * fabs(energies.gravity));
    scree_simulation_free(s);
    scree_case_free(c);
}

// ---- momentum, energy ----------------------------------------------------------------------------------------------

/// A gas between walls: polygons, or half of them discs.
#define GAS(particles)                                                                                                 \
    "dimension: 2\n"                                                                                                   \
    "seed: 3\n"                                                                                                        \
    "gravity: [0, -10]\n" WARNED "materials:\n"                                                                        \
    "  - {name: stone, young_modulus: 1e7 Pa, density: 5000 kg/m3, friction: 0.5}\n" particles                         \
    "contact: {law: polygon_overlap}\n"                                                                                \
    "integrator: {scheme: gear, step: 5e-6 s}\n"                                                                       \
    "walls:\n"                                                                                                         \
    "  - {shape: plane, point: [0, 0], normal: [0, 1]}\n"                                                              \
    "  - {shape: plane, point: [0, 0], normal: [1, 0]}\n"                                                              \
    "  - {shape: plane, point: [32 mm, 0], normal: [-1, 0]}\n"                                                         \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, method: gas, width: 32 mm, solid_fraction: 30 %, velocity: 0.5 m/s}\n"                       \
    "  - {stage: relax, boundary: walls, duration: 0.02 s}\n"
static const char polygons[] = GAS("particles: {shape: polygon, thickness: 1 m, material: stone, count: 24,\n"
                                   "            distribution: uniform, radius_min: 2 mm, radius_max: 3 mm}\n");
static const char mixed[] =
    GAS("particles:\n"
        "  thickness: 1 m\n"
        "  count: 24\n"
        "  species:\n"
        "  - {name: grains, shape: polygon, material: stone, share: 0.5, distribution: equal, radius: 2 mm}\n"
        "  - {name: discs, shape: disc, material: stone, share: 0.5, distribution: equal, radius: 2.5 mm}\n");
#define ROUND(shape, law, dimension, gravity, side, more)                                                              \
    "dimension: " dimension "\n"                                                                                       \
    "seed: 5\n"                                                                                                        \
    "gravity: " gravity "\n" WARNED "materials:\n"                                                                     \
    "  - {name: stone, young_modulus: 1e7 Pa, poisson_ratio: 0.3, density: 2500 kg/m3, friction: 0.5,\n"               \
    "     restitution: 0.5}\n"                                                                                         \
    "particles: {shape: " shape ", material: stone, count: 40, distribution: uniform, radius_min: 2 mm,\n"             \
    "            radius_max: 3 mm}\n"                                                                                  \
    "contact: {law: " law "}\n"                                                                                        \
    "integrator: {scheme: gear, step: 2e-6 s}\n"                                                                       \
    "walls:\n"                                                                                                         \
    "  - {shape: plane, point: " more "}\n"                                                                            \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, method: gas, " side ", solid_fraction: 30 %, velocity: 1 m/s}\n"                             \
    "  - {stage: relax, boundary: walls, duration: 5 ms}\n"
static const char discs[] = ROUND("disc", "hertz_mindlin", "2", "[0, -10]", "width: 40 mm", "[0, 0], normal: [0, 1]");
static const char spheres[] =
    ROUND("sphere", "hertz_mindlin", "3", "[0, 0, -10]", "width: 25 mm", "[0, 0, 0], normal: [0, 0, 1]");

/// Two bodies in free space.
static void momentum_of_a_pair(const char *shape, const char *law, const char *thickness)
{
    char text[2048];
    (void)snprintf(text, sizeof text,
                   "dimension: 2\n"
                   "materials:\n"
                   "  - {name: stone, young_modulus: 1e7 Pa, density: 2500 kg/m3, friction: 0.5}\n"
                   "particles: {shape: %s, %smaterial: stone, count: 2, distribution: equal, radius: 1 cm}\n"
                   "contact: {law: %s}\n"
                   "integrator: {scheme: gear, step: 2e-6 s}\n"
                   "walls: [{shape: plane, point: [0, -1 m], normal: [0, 1]}]\n"
                   "stages:\n"
                   "  - {stage: prepare, method: bodies, width: 1 m, height: 1 m,\n"
                   "     bodies: [{position: [0.5 m, 0.5 m], spin: [0, 0, 30]}, {position: [0.5205 m, 0.507 m],\n"
                   "               velocity: [-1, 0.2], angle: 0.3}]}\n"
                   "  - {stage: relax, boundary: walls, duration: 0.01 s}\n",
                   shape, thickness, law);
    scree_case *c = case_read(text, NULL, 0);
    scree_simulation s;
    simulation_open(c, 1, &s);
    double sum[2][3] = {{0}};
    for (int pass = 0; pass < 2; pass++) {
        if (pass) (void)simulation_finish(&s);
        while (!pass && s.state.stage.index < 1) simulation_step(&s);
        for (size_t row = 0; row < s.state.count; row++) {
            const scree_row *body = &s.state.row[row];
            scree_vector velocity, spin;
            scree_body_velocity(&s.model, &s.state, row, velocity, spin);
            sum[pass][0] += body->mass * velocity[0];
            sum[pass][1] += body->mass * velocity[1];
            sum[pass][2] += body->mass * (body->x * velocity[1] - body->y * velocity[0]) +
                            scree_body_inertia(&s.state, row) * spin[2];
        }
    }
    const double off[3] = {sum[1][0] / sum[0][0] - 1, sum[1][1] / sum[0][1] - 1, sum[1][2] / sum[0][2] - 1};
    print_message("%s: momentum changes by %.2g, %.2g, angular momentum by %.2g\n", shape, off[0], off[1], off[2]);
    assert_true(s.state.ledger.damping + s.state.ledger.friction > 0);
    assert_true(fabs(off[0]) < 1e-11 && fabs(off[1]) < 1e-11);
    assert_true(fabs(off[2]) < 1e-9);
    scree_simulation_close(&s);
    scree_case_free(c);
}

static void momentum_is_kept(void **unused)
{
    (void)unused;
    momentum_of_a_pair("polygon", "polygon_overlap", "thickness: 1 m, ");
    momentum_of_a_pair("disc", "hertz_mindlin", "");
}

/// The residual, and the row `scheme` over the energy that there was.
static double balance(const char *text, const char *const *overrides, size_t count, double *scheme)
{
    scree_case *c = case_read(text, overrides, count);
    scree_simulation s;
    simulation_open(c, 1, &s);
    const double worst = simulation_finish(&s);
    *scheme = s.state.ledger.scheme / fabs(s.state.ledger.turnover + s.state.ledger.initial);
    assert_true(s.state.ledger.damping > 0);
    scree_simulation_close(&s);
    scree_case_free(c);
    return worst;
}

/// With the row of the scheme the balance closes as with a leapfrog; the row goes to zero with the step.
static void the_balance_closes_with_its_row(void **unused)
{
    (void)unused;
    const struct {
        const char *name, *text, *coarse, *fine;
        double most;
    } runs[] = {{"polygons", polygons, "integrator.step=5e-6 s", "integrator.step=1.25e-6 s", 1e-4},
                {"discs and polygons", mixed, "integrator.step=5e-6 s", "integrator.step=1.25e-6 s", 1e-4},
                {"discs", discs, "integrator.step=4e-6 s", "integrator.step=1e-6 s", 1e-4},
                {"spheres", spheres, "integrator.step=4e-6 s", "integrator.step=1e-6 s", 1e-4}};
    for (size_t k = 0; k < COUNT_OF(runs); k++) {
        double scheme[3];
        const char *const verlet[] = {runs[k].fine, "integrator.scheme=velocity_verlet"};
        const double coarse = balance(runs[k].text, &runs[k].coarse, 1, &scheme[0]);
        const double fine = balance(runs[k].text, &runs[k].fine, 1, &scheme[1]);
        const double other = balance(runs[k].text, verlet, 2, &scheme[2]);
        print_message("%s: residual %.3g, with a quarter of the step %.3g (velocity_verlet %.3g); scheme %.3g, %.3g\n",
                      runs[k].name, coarse, fine, other, scheme[0], scheme[1]);
        assert_true(fine < fmax(coarse / 4, 1e-9) && fine < runs[k].most);
        assert_true(scheme[0] != 0 && fabs(scheme[1]) < fabs(scheme[0]));
    }
}

// ---- nothing but the state -----------------------------------------------------------------------------------------

enum { STEPS = 1500 };
enum { FORGET = 1, LOSE = 2 };

static uint64_t checksum_of(scree_simulation *s)
{
    scree_error error;
    check(scree_contacts_save(&s->state, &s->work, &error), &error);
    return scree_state_checksum(&s->model, &s->state);
}

static uint64_t bits_of(const char *text, int threads, int disturbance)
{
    scree_case *c = case_read(text, NULL, 0);
    scree_simulation s;
    simulation_open(c, 1, &s);
    simulation_lose_work(&s, threads);
    s.work.keep_threads = true;
    for (int k = 0; k < STEPS && simulation_goes_on(&s); k++) {
        if (disturbance == FORGET && k % 3 == 0) scree_neighbours_invalidate(&s.work);
        if (disturbance == LOSE && k % 97 == 50) simulation_lose_work(&s, threads);
        simulation_step(&s);
    }
    const uint64_t checksum = checksum_of(&s);
    scree_simulation_close(&s);
    scree_case_free(c);
    return checksum;
}

static void nothing_but_the_state_decides(void **unused)
{
    (void)unused;
    const char *const texts[] = {polygons, mixed, discs, spheres};
    for (size_t k = 0; k < COUNT_OF(texts); k++) {
        const uint64_t expected = bits_of(texts[k], 1, 0);
        assert_true(bits_of(texts[k], 3, 0) == expected);
        assert_true(bits_of(texts[k], 1, FORGET) == expected);
        assert_true(bits_of(texts[k], 2, LOSE) == expected);
    }
}

/// From checkpoints in the middle, at many steps.
static void a_restart_at_any_step_goes_on(void **unused)
{
    (void)unused;
    const char *const texts[] = {mixed, spheres};
    for (size_t k = 0; k < COUNT_OF(texts); k++) {
        assert_int_equal(make_scratch(NULL), 0);
        const uint64_t expected = bits_of(texts[k], 1, 0);
        scree_case *c = case_read(texts[k], NULL, 0);
        scree_simulation s, other;
        simulation_open(c, 1, &s);
        for (int n = 0; n < STEPS; n++) {
            simulation_step(&s);
            if (n % 61 != 0 && (n < 700 || n > 704)) continue;
            simulation_reopen(&s, 1, scratch, &other);
            scree_simulation_close(&s);
            s = other;
            // It points into itself.
            s.table = other.table;
        }
        assert_true(checksum_of(&s) == expected);
        scree_simulation_close(&s);
        scree_case_free(c);
        (void)remove_scratch(NULL);
    }
}

// ---- what it refuses -----------------------------------------------------------------------------------------------

static const char turned[] =
    "materials: [{name: stone, young_modulus: 1e7 Pa, poisson_ratio: 0.3, density: 2500 kg/m3, friction: 0.5}]\n"
    "particles: {material: stone, count: 60, distribution: uniform, radius_min: 0.8 mm, radius_max: 1 mm}\n"
    "integrator: {scheme: gear}\n"
    "stages:\n"
    "  - {stage: prepare, method: drop_and_roll, aspect_ratio: 1}\n"
    "  - {stage: confine, pressure: 10 kPa}\n"
    "  - {stage: rotate_particle, spin: 0.05 rad/s, ramp_time: 5 ms, hold_time: 5 ms}\n";

static void what_it_cannot_do_is_refused(void **unused)
{
    (void)unused;
    const char *const implicit[] = {"contact={law: hertz_brilliantov, friction_update: implicit, damping_time: 1 us, "
                                    "friction_exponent: 50}",
                                    GEAR};
    const char *const deform[] = {GEAR, "stages.1.boundary=membrane"};
    const char *const affine[] = {GEAR, "stages.2.boundary=affine"};
    case_refused(SIMULATION_SMALL, implicit, 2, "friction_update");
    case_refused(SIMULATION_SMALL, deform, 2, "gear does not");
    case_refused(SIMULATION_SMALL, affine, 2, "gear does not");
    const char *const held[] = {GEAR, "selections=[{select: all, name: some}]",
                                "loads=[{load: prescribed, selection: some, velocity_x: 0}]"};
    case_refused(LIBRARY_PAIR, held, 3, "prescribes motions");
    case_refused(turned, NULL, 0, "prescribes a spin");
    const char *const cell[] = {GEAR, "boundary.periodic=x"};
    case_refused(SIMULATION_SMALL, cell, 2, "periodic");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_of_fifth_order),
        cmocka_unit_test(it_is_the_scheme_of_its_source),
        cmocka_unit_test(it_bears_the_step_that_it_says),
        cmocka_unit_test(contacts_that_stay),
        cmocka_unit_test(contacts_that_open_and_close),
        cmocka_unit_test(free_flight_is_exact),
        cmocka_unit_test(a_velocity_that_is_set_is_told),
        cmocka_unit_test(momentum_is_kept),
        cmocka_unit_test(the_balance_closes_with_its_row),
        cmocka_unit_test(nothing_but_the_state_decides),
        cmocka_unit_test(a_restart_at_any_step_goes_on),
        cmocka_unit_test(what_it_cannot_do_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
