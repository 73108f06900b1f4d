/// Own forces: a spring and a torque against their closed forms, the ledger, any order of registration, bounds.
#include "library_fixture.h"

#include "base/matrix.h"
#include "run/stage.h"
#include "state/periodic.h"

typedef struct spring {
    double stiffness, length;
    double position[2][3]; ///< of the last call, by id
} spring;

static int pull(void *user, scree_simulation *s, scree_loads *loads)
{
    spring *p = user;
    scree_error error;
    scree_view id, position;
    if (scree_simulation_view(s, "id", &id, &error) || scree_simulation_view(s, "position", &position, &error))
        return 1;
    for (size_t row = 0; row < 2; row++) {
        uint32_t which;
        memcpy(&which, (const char *)id.data + row * id.stride, sizeof which);
        memcpy(p->position[which], (const char *)position.data + row * position.stride,
               (size_t)position.components * sizeof(double));
    }
    double branch[3], force[3], back[3];
    scree_subtract(p->position[1], p->position[0], branch);
    double distance = scree_length(branch);
    for (int k = 0; k < 3; k++) {
        force[k] = p->stiffness * (distance - p->length) * branch[k] / distance;
        back[k] = -force[k];
    }
    const double both[6] = {force[0], force[1], force[2], back[0], back[1], back[2]};
    scree_loads_add_many(loads, 2, (const uint32_t[]){0, 1}, both, NULL);
    return 0;
}

static void add(scree_simulation *s, const char *name, scree_own_force_function *function, void *user, double force,
                double torque)
{
    scree_error error;
    const scree_own_force own = {
        .name = name, .function = function, .user = user, .largest_force = force, .largest_torque = torque};
    check(scree_simulation_add_force(s, &own, &error), &error);
}

/// Two bodies and a spring between them. The scheme is
/// x(n+1) - 2 x(n) + x(n-1) = a(n) dt^2, with a(0) = 0 since no force was there before the first step, hence
/// q(n) = q(0) cos((n - 1/2) t) / cos(t / 2) with sin(t / 2) = w dt / 2, w^2 = 2 k / m. The balance has no error of the
/// scheme (measure/energy.c).
static void oscillates(const char *text, const char *scheme)
{
    enum { STEPS = 3000 };
    scree_case *c = case_read(text, &scheme, 1);
    scree_simulation *s = library_create(c);
    spring p = {.stiffness = 20, .length = 8e-3};
    add(s, "spring", pull, &p, 0.1, 0);
    library_advance_stage(s);
    double mass = s->state.row[0].mass, dt = scree_simulation_step_size(s), stretch = 2e-3, worst = 0, open = 0;
    double angle = 2 * asin(0.5 * dt * sqrt(2 * p.stiffness / mass));
    assert_true(angle * STEPS > 6 * M_PI);
    for (int n = 1; n <= STEPS; n++) {
        library_advance(s, 1);
        double expected = stretch * cos((n - 0.5) * angle) / cos(0.5 * angle);
        double now = p.position[1][0] - p.position[0][0] - p.length;
        double energy = p.stiffness * stretch * stretch;
        worst = fmax(worst, fabs(now - expected) / stretch);
        scree_energies energies = library_energies(s);
        open = fmax(open, fabs(energies.residual) / energy);
    }
    print_message("%s: off by %.2g, residual %.2g\n", scheme, worst, open);
    // Round-off of positions (2e-2 m against 2e-3 m), which the recurrence adds up, and of the quanta (1e-15).
    assert_true(worst < 1e-9);
    assert_true(open < 1e-11);
    scree_simulation_free(s);
    scree_case_free(c);
}

static void a_spring_oscillates(void **unused)
{
    (void)unused;
    oscillates(LIBRARY_PAIR, "integrator.scheme=velocity_verlet");
    oscillates(LIBRARY_PAIR, "integrator.scheme=position_verlet");
    oscillates(LIBRARY_PAIR_3D, "integrator.scheme=position_verlet");
}

/// A torque on the second body, about z.
static int turn(void *user, scree_simulation *s, scree_loads *loads)
{
    const double *torque = user;
    (void)s;
    scree_loads_add(loads, 1, NULL, (const double[]){0, 0, *torque});
    return 0;
}

static void a_torque_turns(void **unused)
{
    (void)unused;
    const char *const texts[] = {LIBRARY_PAIR, LIBRARY_PAIR_3D};
    for (int solid = 0; solid < 2; solid++) {
        scree_case *c = case_read(texts[solid], NULL, 0);
        scree_simulation *s = library_create(c);
        double torque = 3e-7, spin[2][3];
        library_advance_stage(s);
        add(s, "motor", turn, &torque, 0, 1e-6);
        library_advance(s, 500);
        scree_simulation_copy(s, NULL, NULL, spin[0]);
        double inertia = scree_body_inertia(&s->state, 0), now = solid ? spin[1][2] : spin[0][1];
        // Forces act from the end of the first step on, and until now.
        double expected = torque / inertia * 1e-5 * 499.5;
        assert_true(fabs(now / expected - 1) < 1e-10);
        scree_energies energies = library_energies(s);
        assert_true(fabs(energies.residual) < 1e-12 * energies.kinetic_rotation && energies.outside > 0);
        scree_simulation_free(s);
        scree_case_free(c);
    }
}

/// Drags and pushes of all bodies of a sample, that depend on id and position.
static int push(void *user, scree_simulation *s, scree_loads *loads)
{
    const double *strength = user;
    const scree_view id = library_view(s, "id"), position = library_view(s, "position");
    for (size_t row = 0; row < id.count; row++) {
        uint32_t which;
        double place[2];
        memcpy(&which, (const char *)id.data + row * id.stride, sizeof which);
        memcpy(place, (const char *)position.data + row * position.stride, sizeof place);
        double force[3] = {*strength * sin(which + 1e3 * place[0]), *strength * cos(1e3 * place[1]), 0};
        scree_loads_add(loads, which, force, (const double[]){0, 0, 1e-4 * *strength});
    }
    return 0;
}

static uint64_t pushed(const scree_case *c, bool other_way, double *residual)
{
    double strength[] = {3, 0.7, 11};
    const char *const name[] = {"a", "b", "c"};
    scree_simulation *s = library_create(c);
    for (int k = 0; k < 3; k++) {
        int which = other_way ? 2 - k : k;
        add(s, name[which], push, &strength[which], 20, 1e-2);
    }
    library_advance(s, 3000);
    assert_true(fabs(library_energies(s).outside) > 1e-6 * s->state.ledger.turnover);
    *residual = library_energies(s).relative_residual;
    uint64_t bits = simulation_bits(s);
    scree_simulation_free(s);
    return bits;
}

static void the_order_of_registration_does_not_matter(void **unused)
{
    (void)unused;
    double residual[2];
    const char *const small_step[] = {"integrator.step=2e-6 s"};
    scree_case *c = case_read(SIMULATION_SMALL, small_step, 1);
    assert_true(pushed(c, false, &residual[0]) == pushed(c, true, &residual[1]));
    print_message("residual among contacts: %.2g\n", residual[0]);
    // What test_simulation_balance promises without own forces.
    assert_true(residual[0] < 1e-6);
    scree_case_free(c);
}

#define SHEARED(dimension, shape, place, other)                                                                        \
    "dimension: " dimension "\n"                                                                                       \
    "materials: [{name: quartz, young_modulus: 100 kPa, density: 2650 kg/m3, friction: 0.4}]\n"                        \
    "particles: {shape: " shape ", material: quartz, count: 2, distribution: equal, radius: 1 mm}\n"                   \
    "integrator: {step: 1e-5 s}\n"                                                                                     \
    "measure: {cells: no}\n"                                                                                           \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, method: bodies, width: 40 mm, height: 40 mm, bodies: [" place ", " other "]}\n"              \
    "  - {stage: confine, pressure: 1 Pa}\n"                                                                           \
    "  - {stage: deform, velocity_gradient: {xy: 30 1/s}, strain: 1000 %, rise_time: 0 s}\n"

/// Lifts body 0, across the planes of shear.
static int lift(void *user, scree_simulation *s, scree_loads *loads)
{
    (void)s;
    scree_loads_add(loads, 0, (const double[]){0, *(const double *)user, 0}, NULL);
    return 0;
}

/// A body that a force lifts through a sheared cell keeps the velocity along x of the place that it comes from: forces
/// act on bodies, not on the flow. Its own velocity, relative to the flow, is taken along: the ledger has the work of
/// the force on it and that of the cell. It goes through the upper face and through ghosts beside it.
static void lifted_in_a_sheared_cell(const char *text, const char *periodic)
{
    enum { STEPS = 4000 };
    scree_error error;
    scree_case *c = case_read(text, &periodic, 1);
    scree_simulation *s = library_create(c);
    const double rate = 30, acceleration = 60;
    library_advance_stage(s);
    // Straight to the deform stage: nothing presses these bodies.
    s->state.stage.index = 2;
    s->state.stage.counter = -1;
    check(scree_stage_enter(s, false, &error), &error);
    double force = acceleration * s->state.row[0].mass, dt = scree_simulation_step_size(s);
    const uint32_t row = scree_state_row_of(&s->state, 0);
    const double x0 = s->state.row[row].x, y0 = s->state.row[row].y;
    // Both drift with the flow from the start.
    add(s, "lift", lift, &force, 2 * force, 0);
    library_advance(s, STEPS);
    const scree_row *body = &s->state.row[scree_state_row_of(&s->state, 0)];
    const double t = STEPS * dt;
    // As in a spring (above), no force was there before the first step.
    const double y = y0 + acceleration * dt * dt * STEPS * (STEPS - 1) / 2, x = x0 + rate * y0 * t;
    // From the body to where it should be: whole lattice vectors, of a lattice that has been reduced.
    double inverse[9], fraction[3], away[3], way[3] = {x - body->x, y - body->y, 0};
    scree_matrix_invert(scree_cell(&s->state)->lattice, inverse);
    scree_matrix_apply(inverse, way, fraction);
    assert_true(scree_length(fraction) > 0.9);
    for (int k = 0; k < 3; k++) fraction[k] -= rint(fraction[k]);
    scree_matrix_apply(scree_cell(&s->state)->lattice, fraction, away);
    // Second order of the scheme along x: (1 / STEPS)^2 of the path that the flow would have added.
    assert_true(fabs(away[0]) < 1e-5 * rate * (y - y0) * t && fabs(away[1]) < 1e-12);
    scree_energies energies = library_energies(s);
    print_message("off by %.2g m of %.2g m, residual %.2g of %.2g J\n", away[0], rate * (y - y0) * t, energies.residual,
                  energies.kinetic);
    assert_true(fabs(s->state.ledger.periodic) > 0.01 * energies.kinetic && energies.outside > energies.kinetic / 2);
    assert_true(fabs(energies.residual) < 1e-10 * energies.kinetic);
    scree_simulation_free(s);
    scree_case_free(c);
}

static void own_forces_act_in_a_deforming_cell(void **unused)
{
    (void)unused;
    lifted_in_a_sheared_cell(SHEARED("2", "disc", "{position: [15 mm, 20 mm]}", "{position: [25 mm, 5 mm]}"),
                             "boundary.periodic=xy");
    lifted_in_a_sheared_cell(
        SHEARED("3", "sphere", "{position: [15 mm, 20 mm, 20 mm]}", "{position: [25 mm, 5 mm, 5 mm]}"),
        "boundary.periodic=xyz");
}

static void own_forces_come_and_go(void **unused)
{
    (void)unused;
    scree_error error;
    scree_case *c = case_read(LIBRARY_PAIR, NULL, 0);
    scree_simulation *s = library_create(c);
    spring p = {.stiffness = 2, .length = 8e-3};
    add(s, "spring", pull, &p, 0.1, 0);
    library_advance(s, 100);
    check(scree_simulation_remove_force(s, "spring", &error), &error);
    assert_int_equal(scree_simulation_remove_force(s, "spring", &error), SCREE_ERROR_INPUT);
    library_advance(s, 1);
    double kinetic = library_energies(s).kinetic, outside = s->state.ledger.outside;
    library_advance(s, 100);
    assert_true(s->state.ledger.outside == outside && kinetic > 0);
    assert_true(fabs(library_energies(s).kinetic / kinetic - 1) < 1e-12);
    assert_true(fabs(library_energies(s).residual) < 1e-12 * kinetic);
    scree_simulation_free(s);
    scree_case_free(c);
}

static int nothing(void *user, scree_simulation *s, scree_loads *loads)
{
    (void)s;
    (void)loads;
    return *(int *)user;
}

/// The next step fails with this, and so does the one after it.
static void expect_stop(scree_simulation *s, scree_status status, const char *text)
{
    for (int again = 0; again < 2; again++) {
        bool done;
        scree_error error = {0};
        assert_int_equal(scree_simulation_advance(s, 1, &done, &error), status);
        if (!strstr(error.message, text)) fail_msg("'%s' is not in '%s'", text, error.message);
    }
}

static void bounds_are_kept(void **unused)
{
    (void)unused;
    scree_error error;
    scree_case *c = case_read(LIBRARY_PAIR, NULL, 0);
    scree_simulation *s = library_create(c);
    spring p = {.stiffness = 2, .length = 8e-3};
    double torque = 3e-7;
    int answer = 7;
    library_advance(s, 5);
    add(s, "spring", pull, &p, 1e-3, 0); // 4e-3 N at the begin
    expect_stop(s, SCREE_ERROR_GUARD, "own force 'spring' puts a force of 0.004 on particle 0");
    assert_true(s->work.flags & SCREE_FLAG_FORCE_RANGE);
    scree_simulation_free(s);
    s = library_create(c);
    add(s, "motor", turn, &torque, 0, 1e-7);
    expect_stop(s, SCREE_ERROR_GUARD, "own force 'motor' puts a torque of 3e-07 on particle 1");
    scree_simulation_free(s);
    s = library_create(c);
    torque = NAN;
    add(s, "motor", turn, &torque, 0, 1e-7);
    expect_stop(s, SCREE_ERROR_GUARD, "nan");
    scree_simulation_free(s);
    s = library_create(c);
    add(s, "nothing", nothing, &answer, 1, 0);
    expect_stop(s, SCREE_ERROR_INPUT, "own force 'nothing' has failed (7)");
    const scree_own_force wrong[] = {{"nothing", nothing, NULL, 1, 0},  {"x", NULL, NULL, 1, 0},
                                     {"", nothing, NULL, 1, 0},         {"x", nothing, NULL, 0, 0},
                                     {"x", nothing, NULL, INFINITY, 0}, {"x", nothing, NULL, 1, -1}};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++)
        assert_int_equal(scree_simulation_add_force(s, &wrong[k], &error), SCREE_ERROR_INPUT);
    scree_simulation_free(s);
    scree_case_free(c);
}

/// Puts a force on a body that is not there, after it has tried what an own force may not do.
static int meddle(void *user, scree_simulation *s, scree_loads *loads)
{
    bool done;
    scree_error error;
    const scree_contact_point *contact;
    size_t count;
    (void)user;
    if (!scree_simulation_advance(s, 1, &done, &error) || !scree_simulation_remove_force(s, "meddle", &error) ||
        !scree_simulation_contacts(s, &contact, &count, &error) || !scree_simulation_save(s, "/nowhere", &error))
        return 1;
    scree_loads_add(loads, 2, (const double[3]){0}, NULL);
    return 0;
}

static void own_forces_may_not_meddle(void **unused)
{
    (void)unused;
    scree_case *c = case_read(LIBRARY_PAIR, NULL, 0);
    scree_simulation *s = library_create(c);
    add(s, "meddle", meddle, NULL, 1, 0);
    expect_stop(s, SCREE_ERROR_INPUT, "own force 'meddle': there is no body 2");
    scree_simulation_free(s);
    scree_case_free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_spring_oscillates),
        cmocka_unit_test(a_torque_turns),
        cmocka_unit_test(the_order_of_registration_does_not_matter),
        cmocka_unit_test(own_forces_act_in_a_deforming_cell),
        cmocka_unit_test(own_forces_come_and_go),
        cmocka_unit_test(bounds_are_kept),
        cmocka_unit_test(own_forces_may_not_meddle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
