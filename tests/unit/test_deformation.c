/// Particles that deform, against closed forms: a row that is held, neighbours across, loads on the surface; energy,
/// momentum and bits of gases.
#include "io_scratch.h"
#include "run_fixture.h"

#include "contact/deformation.h"
#include "contact/stretch.h"
#include "measure/removal.h"
#include "state/deformation.h"
#include "state/persistent.h"

#define STEEL(poisson)                                                                                                 \
    "materials:\n  - {name: steel, young_modulus: 200 GPa, poisson_ratio: " poisson ", density: 2000 kg/m3,\n"         \
    "     friction: 0, normal_stiffness: 7e10 N/m, stiffness_ratio: 0, damping_ratio: 0}\n"
#define EQUAL(count)                                                                                                   \
    "particles: {shape: disc, material: steel, count: " count ", distribution: equal, radius: 1 mm, thickness: 1 m}\n"
#define QUIET "measure: {cells: no, samples: 10}\noutput: {figures: no, paraview: no}\n"
#define HELD                                                                                                           \
    "selections: [{select: all, name: all}]\n"                                                                         \
    "loads: [{load: prescribed, selection: all, velocity_x: 0, velocity_y: 0, spin_z: 0}]\n"
#define ROW                                                                                                            \
    "scree: 1\nname: row\n" STEEL("0.35")                                                                              \
        EQUAL("4") "contact: {law: linear, deformation: explicit}\n" HELD                                              \
                   "integrator: {step: 1e-7 s}\nboundary: {periodic: x}\n" QUIET "stages:\n"                           \
                   "  - {stage: prepare, method: bodies, width: 7.96 mm, bodies: [{position: [0.5 mm, 1 mm]},\n"       \
                   "     {position: [2.49 mm, 1 mm]}, {position: [4.48 mm, 1 mm]}, {position: [6.47 mm, 1 mm]}]}\n"    \
                   "  - {stage: relax, duration: 200 us, boundary: none}\n"

static const double NORMAL = 7e10, THICKNESS = 1;

/// Stiffness of a disc that is pressed along its diameter, M 2.72 (2.67 has 1 / k = 1 / k_n + 2 / k_p).
static double disc_stiffness(double modulus, double poisson)
{
    return M_PI * modulus * THICKNESS / (2 * (1 - poisson * poisson));
}

/// Normal force of the first contact between bodies with these ids; 0: there is none.
static double force_between(const scree_simulation *s, uint32_t a, uint32_t b)
{
    scree_contact_table table = {0};
    scree_error error;
    double force = 0;
    check(scree_contact_table_build(&s->stage_model, &s->state, &s->work, &table, &error), &error);
    for (size_t k = 0; k < table.count; k++)
        if (!table.contact[k].wall && s->state.id[table.contact[k].first] == a &&
            s->state.id[table.contact[k].second] == b)
            force = table.contact[k].normal_force;
    scree_contact_table_destroy(&table);
    return force;
}

// ---- a row that is held ------------------------------------------------------------------------------------------

/// The forces of `count` steps of the row.
static void row_forces(const char *modulus, const char *scheme, int count, double *force)
{
    char young[64], how[64];
    (void)snprintf(young, sizeof young, "materials.steel.young_modulus=%s", modulus);
    (void)snprintf(how, sizeof how, "contact.deformation=%s", scheme);
    const char *const overrides[] = {young, how};
    scree_case *c = case_read(ROW, overrides, 2);
    scree_simulation s;
    simulation_open(c, 1, &s);
    for (int k = 0; k < count; k++) {
        simulation_step(&s);
        force[k] = force_between(&s, 0, 1);
        assert_true(fabs(force_between(&s, 1, 2) / force[k] - 1) < 1e-6);
    }
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// f = k h with 1 / k = 1 / k_n + 2 / k_p; from step to step the difference to it is multiplied by -2 k_n / k_p.
static void a_held_row_has_the_closed_force(void **unused)
{
    static const struct {
        const char *text;
        double modulus;
    } cases[] = {{"5e11", 5e11}, {"2e11", 2e11}, {"1e11", 1e11}, {"8e10", 8e10}, {"6e10", 6e10}, {"1e10", 1e10}};
    enum { STEPS = 1000 };
    static double force[STEPS];
    (void)unused;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const double disc = disc_stiffness(cases[k].modulus, 0.35), factor = 2 * NORMAL / disc;
        const double expected = NORMAL / (1 + factor) * 1e-5;
        if (factor < 1) {
            row_forces(cases[k].text, "explicit", STEPS, force);
            print_message("E %s: factor %.4f, force %.5g N, departure %.2g\n", cases[k].text,
                          (force[6] - force[5]) / (force[5] - force[4]), force[STEPS - 1],
                          force[STEPS - 1] / expected - 1);
            assert_true(fabs((force[6] - force[5]) / (force[5] - force[4]) + factor) < 1e-6);
            assert_true(fabs(force[STEPS - 1] / expected - 1) < fmax(1e-10, 2 * pow(factor, STEPS - 3)));
        }
        row_forces(cases[k].text, "relaxed", STEPS, force);
        assert_true(fabs(force[STEPS - 1] / expected - 1) < 1e-9);
        // The first one is that of rigid discs, with which the run begins.
        row_forces(cases[k].text, "implicit", 6, force);
        for (int step = 4; step < 6; step++) assert_true(fabs(force[step] / expected - 1) < 1e-8);
    }
}

// ---- neighbours across -------------------------------------------------------------------------------------------

#define CROSS                                                                                                          \
    "scree: 1\nname: cross\n" STEEL("0.35") EQUAL(                                                                     \
        "5") "contact: {law: linear, deformation: explicit}\n" HELD "integrator: {step: 1e-7 s}\n" QUIET "stages:\n"   \
             "  - {stage: prepare, method: bodies, bodies: [{position: [5 mm, 5 mm]}, {position: [3 mm, 5 mm]},\n"     \
             "     {position: [7.0000001 mm, 5 mm]}, {position: [5 mm, 3.01 mm]}, {position: [5 mm, 6.99 mm]}]}\n"     \
             "  - {stage: relax, duration: 20 us, boundary: none}\n"

/// M figure 2.4: a disc that is pressed from two sides touches those that lie beside it. The static state is that of
/// all schemes, though contacts open and close.
static void a_pressed_disc_touches_its_neighbours(void **unused)
{
    static const char *const schemes[] = {"none", "explicit", "relaxed", "implicit"};
    double first = 0;
    (void)unused;
    for (int deforms = 0; deforms < 4; deforms++) {
        char how[64];
        (void)snprintf(how, sizeof how, "contact.deformation=%s", schemes[deforms]);
        const char *const overrides[] = {how};
        scree_case *c = case_read(CROSS, overrides, 1);
        scree_simulation s;
        simulation_open(c, 1, &s);
        for (int k = 0; k < 100; k++) simulation_step(&s);
        double along = force_between(&s, 0, 3), left = force_between(&s, 0, 1), right = force_between(&s, 0, 2);
        print_message("deforms %d: %.4g N along, %.4g and %.4g N across\n", deforms, along, left, right);
        assert_true(along > 4e5);
        if (deforms == 1) first = along;
        if (deforms)
            assert_true(left > 0.01 * along && right > 0.01 * along && right < left && fabs(along / first - 1) < 1e-6);
        else
            assert_true(left == 0 && right == 0);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

// ---- loads on the surface ----------------------------------------------------------------------------------------

#define PRESSED                                                                                                        \
    "scree: 1\nname: pressed\n" STEEL("0.35") EQUAL(                                                                   \
        "3") "contact: {law: linear, deformation: explicit}\n"                                                         \
             "selections: [{select: ids, name: low, ids: [0]}, {select: ids, name: high, ids: [2]}]\n"                 \
             "loads:\n  - {load: prescribed, selection: low, attack: surface, force_y: {from: 0 N, to: 10 kN, begin: " \
             "0 s,\n"                                                                                                  \
             "     end: 0.1 ms}}\n"                                                                                    \
             "  - {load: prescribed, selection: high, attack: surface, force_y: {from: 0 N, to: -10 kN, begin: 0 s,\n" \
             "     end: 0.1 ms}}\n"                                                                                    \
             "integrator: {step: 2e-8 s}\n" QUIET "stages:\n"                                                          \
             "  - {stage: prepare, method: bodies, bodies: [{position: [5 mm, 5 mm]}, {position: [5 mm, 7 mm]},\n"     \
             "     {position: [5 mm, 9 mm]}]}\n"                                                                       \
             "  - {stage: relax, duration: 0.3 ms, boundary: none}\n"

/// Energy of the strains as they stand [J]: what the bodies have taken up where nothing lags.
static double energy_of_strains(const scree_simulation *s)
{
    const scree_compliance by = scree_deformation_compliance(&s->model, 0);
    const double back = by.trace / (by.shear + 2 * by.trace), volume = M_PI * THICKNESS;
    double sum = 0;
    for (size_t row = 0; row < s->state.count; row++) {
        const double *w = scree_stretch_row(&s->state, row), trace = w[0] + w[1];
        sum += 0.5 * volume / by.shear * (w[0] * w[0] + w[1] * w[1] + 2 * w[2] * w[2] - back * trace * trace);
    }
    return sum;
}

/// A column under 10 kN: f^2 / (2 k_n) a contact, f^2 / k_p a disc, each strained from both sides, the loaded ones too.
/// The work of the loads is theirs, that on the surfaces counted: the balance closes while it vibrates.
static void loads_on_the_surface_strain_it(void **unused)
{
    (void)unused;
    // Dashpots that strain discs would jump where contacts close.
    const char *const overrides[] = {"contact.deformation=implicit", "contact.dashpots=loose",
                                     "materials.steel.damping_ratio=1", "materials.steel.tangential_damping_ratio=0"};
    const double disc = disc_stiffness(2e11, 0.35);
    for (int kind = 0; kind < 4; kind++) {
        const bool damped = kind & 1, implicit = kind & 2;
        const size_t count = (damped ? 2U : 0U) + (implicit ? 2U : 0U);
        scree_case *c = case_read(PRESSED, implicit ? overrides : overrides + 2, count);
        scree_simulation s;
        scree_error error;
        simulation_open(c, 1, &s);
        double worst = 0;
        scree_energy energy = {0};
        while (simulation_goes_on(&s)) {
            simulation_step(&s);
            if (simulation_last_steps(&s) > 0) worst = simulation_residual(&s, worst);
            if (!simulation_goes_on(&s)) break;
            scree_contact_table table = {0};
            check(scree_contact_table_build(&s.stage_model, &s.state, &s.work, &table, &error), &error);
            scree_energy_measure(&s.stage_model, &s.state, &table, &energy);
            scree_contact_table_destroy(&table);
        }
        const double contacts = 2 * 1e4 * 1e4 / (2 * NORMAL), discs = 3 * 1e4 * 1e4 / disc;
        print_message(
            "residual %.2g of all energy, at worst %.2g; contacts %.6g of %.6g J, discs took %.6g of %.6g J\n",
            energy.relative, worst, energy.elastic_normal, contacts, scree_deformation_of(&s.state)->given, discs);
        // Dashpots are second order in the step; while next to nothing has been done yet, so is nearly all.
        assert_true(worst < (damped ? 1e-3 : implicit ? 1e-8 : 1e-9) && energy.relative < (damped ? 1e-6 : 1e-9));
        const double given = scree_deformation_of(&s.state)->given;
        // 15,000 steps with strains to 1e-9.
        if (implicit) assert_true(fabs(given / energy_of_strains(&s) - 1) < 1e-7);
        if (damped) assert_true(fabs(energy.elastic_normal / contacts - 1) < 1e-3 && fabs(given / discs - 1) < 1e-3);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

#define SQUEEZED(count, more)                                                                                          \
    "scree: 1\nname: squeezed\n" STEEL("0.35") EQUAL(count) "contact: {law: linear, deformation: implicit}\n" HELD     \
                                                            "integrator: {step: 1e-7 s}\n" QUIET more

/// A disc that walls press from both sides: each is a spring K as a disc of its like, and W the way that the
/// surface goes back by, W = -2 f (shear + trace) / (pi t). f = K (h + W), so f = K h / (1 + 2 K (1 - nu2) / (pi E t)).
/// Across, the surface moves out by 2 f nu (1 + nu) / (pi E t).
static void a_disc_between_walls_has_the_closed_stress(void **unused)
{
    static const char *const cases[] = {
        SQUEEZED("1", "walls: [{shape: plane, name: floor, point: [0, 4.01 mm], normal: [0, 1]},\n"
                      "  {shape: plane, name: roof, point: [0, 5.99 mm], normal: [0, -1]}]\n"
                      "stages:\n  - {stage: prepare, method: bodies, bodies: [{position: [5 mm, 5 mm]}]}\n"
                      "  - {stage: relax, duration: 10 us, boundary: none}\n"),
        SQUEEZED("3", "boundary: {periodic: x}\nstages:\n"
                      "  - {stage: prepare, method: bodies, width: 20 mm, height: 1.98 mm, bodies: [{position: [5 mm, "
                      "0.99 mm]},\n"
                      "     {position: [10 mm, 0.99 mm]}, {position: [15 mm, 0.99 mm]}]}\n"
                      "  - {stage: relax, duration: 10 us, boundary: plates}\n")};
    const double K = NORMAL, modulus = 2e11, poisson = 0.35;
    const double expected = K * 1e-5 / (1 + 2 * K * (1 - poisson * poisson) / (M_PI * modulus * THICKNESS));
    (void)unused;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        for (int relaxed = 0; relaxed < 2; relaxed++) {
            const char *const overrides[] = {"contact.deformation=relaxed"};
            scree_case *c = case_read(cases[k], overrides, (size_t)relaxed);
            scree_simulation s;
            scree_error error;
            scree_contact_table table = {0};
            simulation_open(c, 1, &s);
            for (int step = 0; step < 90; step++) simulation_step(&s);
            check(scree_contact_table_build(&s.stage_model, &s.state, &s.work, &table, &error), &error);
            assert_int_equal(table.count, 2 * s.state.count);
            const double *stretch = scree_stretch_row(&s.state, 0), across = 2 * expected * poisson * (1 + poisson);
            print_message("%zu: %.10g N of %.10g, across %.6g m\n", k, table.contact[0].normal_force, expected,
                          stretch[0]);
            for (size_t i = 0; i < table.count; i++)
                assert_true(fabs(table.contact[i].normal_force / expected - 1) < 1e-8);
            assert_true(fabs(stretch[0] * M_PI * modulus * THICKNESS / across - 1) < 1e-8);
            scree_contact_table_destroy(&table);
            scree_simulation_close(&s);
            scree_case_free(c);
        }
}

// ---- gases -------------------------------------------------------------------------------------------------------

#define GAS                                                                                                            \
    "scree: 1\nname: gas\nseed: 3\n"                                                                                   \
    "materials: [{name: rubber, young_modulus: 0.3 GPa, poisson_ratio: 0.3, density: 2650 kg/m3, friction: 0.4,\n"     \
    "   normal_stiffness: 1e5 N/m, stiffness_ratio: 0.5, damping_ratio: 0.02}]\n"                                      \
    "contact: {law: linear, deformation: explicit}\nintegrator: {step_fraction: 0.05}\n" QUIET "stages:\n"             \
    "  - {stage: prepare, method: gas, velocity: 2 m/s, solid_fraction: 40 %}\n"
#define PLANE_GAS                                                                                                      \
    GAS "  - {stage: relax, duration: 3 ms}\nboundary: {periodic: xy}\n"                                               \
        "particles: {shape: disc, material: rubber, count: 80, radius_min: 0.8 mm, radius_max: 1.2 mm,\n"              \
        "  thickness: 1 mm}\n"
#define SPACE_GAS                                                                                                      \
    GAS "  - {stage: relax, duration: 3 ms}\nboundary: {periodic: xyz}\ndimension: 3\n"                                \
        "particles: {shape: sphere, material: rubber, count: 100, radius_min: 0.8 mm, radius_max: 1.2 mm}\n"
#define BOXED_GAS                                                                                                      \
    GAS "  - {stage: relax, duration: 3 ms, boundary: plates}\n"                                                       \
        "particles: {shape: disc, material: rubber, count: 80, radius_min: 0.8 mm, radius_max: 1.2 mm,\n"              \
        "  thickness: 1 mm}\n"
#define WALLED_GAS                                                                                                     \
    GAS "  - {stage: relax, duration: 3 ms, boundary: none}\n"                                                         \
        "walls: [{shape: box, name: box, lower: [0 mm, 0 mm], upper: [40 mm, 40 mm]}]\n"                               \
        "particles: {shape: disc, material: rubber, count: 80, radius_min: 0.8 mm, radius_max: 1.2 mm,\n"              \
        "  thickness: 1 mm}\n"
static const char *const gases[] = {PLANE_GAS, SPACE_GAS, BOXED_GAS, WALLED_GAS};

static void momentum_of(const scree_state *state, double momentum[3], double *scale)
{
    momentum[0] = momentum[1] = momentum[2] = *scale = 0;
    for (size_t row = 0; row < state->count; row++) {
        scree_vector velocity, spin;
        scree_body_motion(state, row, velocity, spin);
        for (int k = 0; k < 3; k++) momentum[k] += scree_body_mass(state, row) * velocity[k];
        *scale += scree_body_mass(state, row) * scree_length(velocity);
    }
}

/// What the bodies take up with their strains closes the balance, at the order of the scheme; nothing else moves them.
static void books_of_energy_are_closed(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < sizeof gases / sizeof *gases; k++)
        for (int scheme = 0; scheme < 3; scheme++) {
            static const char *const schemes[] = {"contact.deformation=explicit", "contact.deformation=relaxed",
                                                  "contact.deformation=implicit"};
            double worst[2] = {0, 0}, given = 0, before[3], after[3], scale;
            for (int fine = 0; fine < 2; fine++) {
                const char *const overrides[] = {
                    schemes[scheme], scheme == 2 ? "materials.rubber.damping_ratio=0" : "contact.dashpots=strain",
                    fine ? "integrator.step_fraction=0.025" : "integrator.step_fraction=0.05"};
                scree_case *c = case_read(gases[k], overrides, 3);
                scree_simulation s;
                simulation_open(c, 1, &s);
                simulation_load(&s);
                momentum_of(&s.state, before, &scale);
                while (simulation_goes_on(&s)) {
                    simulation_step(&s);
                    if (simulation_last_steps(&s) > 0) worst[fine] = simulation_residual(&s, worst[fine]);
                }
                momentum_of(&s.state, after, &scale);
                given = scree_deformation_of(&s.state)->given / s.state.ledger.initial;
                for (int i = 0; i < 3 && k < 2; i++) assert_true(fabs(after[i] - before[i]) < 1e-12 * scale);
                scree_simulation_close(&s);
                scree_case_free(c);
            }
            print_message("gas %zu, %s: residual %.2g, %.2g at half the step; bodies took %.3g\n", k, schemes[scheme],
                          worst[0], worst[1], given);
            // Gases without dashpots collide in another way at each step.
            assert_true(worst[0] < 1e-4 && worst[1] < (scheme == 2 ? 0.8 : 0.6) * worst[0] && given > 1e-5);
        }
}

/// Bits of a gas after its stage: number of threads, instruction set (0: the best; -1: the scalar reference), and
/// whether it loses its work on the way.
static uint64_t end_of_gas(const char *text, bool implicit, int threads, int set, bool loses)
{
    static const char *const overrides[] = {"contact.deformation=implicit", "contact.dashpots=loose"};
    scree_case *c = case_read(text, overrides, implicit ? 2 : 0);
    scree_simulation s;
    scree_error error;
    simulation_open(c, threads, &s);
    s.work.keep_threads = true;
    s.work.instruction_set = set > 0 ? set : 0;
    s.work.reference_kernel = set < 0;
    for (int k = 0; simulation_goes_on(&s) && k < (implicit ? 400 : 1500); k++) {
        simulation_step(&s);
        if (loses && k % 40 == 7) scree_neighbours_invalidate(&s.work);
    }
    check(scree_contacts_save(&s.state, &s.work, &error), &error);
    uint64_t checksum = scree_state_checksum(&s.stage_model, &s.state);
    scree_simulation_close(&s);
    scree_case_free(c);
    return checksum;
}

static void nothing_but_the_state_decides(void **unused)
{
    (void)unused;
    for (size_t k = 0; k < sizeof gases / sizeof *gases; k++)
        for (int implicit = 0; implicit < 2; implicit++) {
            const uint64_t expected = end_of_gas(gases[k], implicit, 1, -1, false);
            for (int set = 2; set <= scree_contact_instruction_set(0); set++)
                assert_true(end_of_gas(gases[k], implicit, 1, set, false) == expected);
            for (int threads = 2; threads <= 7; threads += threads == 3 ? 4 : 1)
                assert_true(end_of_gas(gases[k], implicit, threads, 0, false) == expected);
            assert_true(end_of_gas(gases[k], implicit, 2, 0, true) == expected);
        }
}

/// In the middle of collisions: what goes on from a checkpoint ends with the same bits.
static void restarts_change_nothing(void **unused)
{
    static const char *const schemes[] = {"contact.deformation=explicit", "contact.deformation=relaxed",
                                          "contact.deformation=implicit"};
    (void)unused;
    for (size_t k = 0; k < sizeof gases / sizeof *gases; k++)
        for (int scheme = 0; scheme < 3; scheme++) {
            const char *const overrides[] = {schemes[scheme], "contact.dashpots=loose"};
            scree_case *c = case_read(gases[k], overrides, 2);
            scree_simulation s, other;
            simulation_open(c, 1, &s);
            simulation_load(&s);
            for (int step = 0; step < 300; step++) simulation_step(&s);
            assert_true(s.state.largest_overlap > 0);
            simulation_reopen(&s, 2, scratch, &other);
            for (int step = 0; step < 100; step++) {
                simulation_step(&s);
                simulation_step(&other);
            }
            assert_true(simulation_close(&s) == simulation_close(&other));
            scree_case_free(c);
        }
}

// ---- lists, bonds, removal ---------------------------------------------------------------------------------------

/// Nothing moves but surfaces: a list whose skin is thinner than the gap that they close has to be made anew.
static void surfaces_use_up_the_list(void **unused)
{
    static const char *const schemes[] = {"contact.deformation=relaxed", "contact.deformation=implicit"};
    (void)unused;
    for (int scheme = 0; scheme < 2; scheme++) {
        const char *const overrides[] = {
            schemes[scheme], "materials.steel.young_modulus=1e10",
            "stages.prepare.bodies=[{position: [5 mm, 5 mm]}, {position: [2.998 mm, 5 mm]}, "
            "{position: [7.002 mm, 5 mm]}, {position: [5 mm, 3.02 mm]}, {position: [5 mm, "
            "6.98 mm]}]"};
        scree_case *c = case_read(CROSS, overrides, 3);
        scree_simulation s;
        simulation_open(c, 1, &s);
        s.work.skin = 1e-6;
        for (int k = 0; k < 100; k++) simulation_step(&s);
        const double left = force_between(&s, 0, 1);
        print_message("%s: %.3g N across, %llu lists\n", schemes[scheme], left, (unsigned long long)s.work.rebuilds);
        assert_true(left > 0);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

/// No surface has moved out by more than the row of its body says, and none by much less.
static void rows_know_how_far_surfaces_reach(void **unused)
{
    const char *const override = "contact.deformation=explicit";
    (void)unused;
    for (size_t k = 0; k < sizeof gases / sizeof *gases; k++) {
        scree_case *c = case_read(gases[k], &override, 1);
        scree_simulation s;
        double strained = 0;
        simulation_open(c, 1, &s);
        simulation_load(&s);
        for (int step = 0; step < 300; step++) simulation_step(&s);
        for (size_t row = 0; row < s.state.count; row++) {
            double stretch[6], negative[6];
            const double *own = scree_stretch_row(&s.state, row);
            scree_tensor_get(s.state.dimension, own, stretch);
            for (int i = 0; i < 6; i++) negative[i] = -stretch[i];
            const double most = scree_tensor_largest(s.state.dimension, stretch);
            const double spread = most + scree_tensor_largest(s.state.dimension, negative); // twice the deviator
            assert_true(own[3] >= most - 1e-15 * spread && own[3] <= fmax(most, 0) + 0.042 * spread);
            strained = fmax(strained, spread);
        }
        assert_true(strained > 0);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

#define GLUED                                                                                                          \
    PRESSED "  - {stage: bond}\n"                                                                                      \
            "  - {stage: relax, name: rest, boundary: none, duration: 0.01 ms}\n"

/// Bonds between discs that are strained are at rest as they are made: without force.
static void bonds_of_strained_bodies_are_at_rest(void **unused)
{
    (void)unused;
    scree_case *c = case_read(GLUED, NULL, 0);
    scree_simulation s;
    scree_error error;
    simulation_open(c, 1, &s);
    double before = 0, after = INFINITY;
    while (simulation_goes_on(&s) && scree_persistent(&s.state)->count == 0) {
        simulation_step(&s);
        if (scree_persistent(&s.state)->count == 0) before = fmax(before, fabs(force_between(&s, 0, 1)));
    }
    check(scree_neighbours_refresh(&s.stage_model, &s.state, &s.work, &error), &error);
    after = fabs(force_between(&s, 0, 1));
    print_message("%.4g N before, %.4g N as bonded\n", before, after);
    assert_int_equal(scree_persistent(&s.state)->count, 2);
    assert_true(before > 1e3 && after < 1e-6 * before);
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// Bodies that go in the middle of collisions: the balance of energies stays closed, and the others go on.
static void bodies_are_taken_out(void **unused)
{
    (void)unused;
    for (int implicit = 0; implicit < 2; implicit++) {
        const char *const overrides[] = {implicit ? "contact.deformation=implicit" : "contact.deformation=explicit",
                                         "contact.dashpots=loose"};
        scree_case *c = case_read(PLANE_GAS, overrides, 2);
        scree_simulation s;
        scree_error error;
        simulation_open(c, 1, &s);
        simulation_load(&s);
        uint32_t gone[1] = {0};
        for (bool found = false; !found;) {
            simulation_step(&s);
            for (uint32_t id = 0; id < s.state.count && !found; id++) {
                const uint32_t row = scree_state_row_of(&s.state, id);
                found = s.state.sum[row].contacts > 0 && scree_stretch_row(&s.state, row)[0] != 0 && s.state.step > 200;
                if (found) gone[0] = id;
            }
        }
        const double taken = s.state.ledger.removed;
        check(scree_bodies_remove(&s.stage_model, &s.state, &s.work, gone, 1, &error), &error);
        double worst = 0;
        while (simulation_goes_on(&s)) {
            simulation_step(&s);
            worst = simulation_residual(&s, worst);
        }
        print_message("implicit %d: removed %.3g J, residual %.2g\n", implicit, s.state.ledger.removed - taken, worst);
        assert_int_equal(s.state.count, 79);
        assert_true(s.state.ledger.removed > taken && worst < 1e-4);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

// ---- what is refused ---------------------------------------------------------------------------------------------

static void expect_refusal(const char *text, const char *override, const char *message)
{
    scree_case *c;
    scree_problems *problems;
    assert_int_equal(case_parse(text, &override, 1, &c, &problems), SCREE_ERROR_INPUT);
    assert_non_null(strstr(scree_problems_get(problems, 0)->message, message));
    scree_problems_free(problems);
}

static void what_cannot_deform_is_refused(void **unused)
{
    (void)unused;
    expect_refusal(BOXED_GAS, "materials.rubber.poisson_ratio=0.5", "between -1 and 0.5");
    expect_refusal(BOXED_GAS,
                   "stages=[{stage: prepare, method: gas}, {stage: confine, pressure: 1 kPa, boundary: membrane}]",
                   "membrane");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_held_row_has_the_closed_force),
        cmocka_unit_test(a_pressed_disc_touches_its_neighbours),
        cmocka_unit_test(loads_on_the_surface_strain_it),
        cmocka_unit_test(a_disc_between_walls_has_the_closed_stress),
        cmocka_unit_test(books_of_energy_are_closed),
        cmocka_unit_test(nothing_but_the_state_decides),
        cmocka_unit_test_setup_teardown(restarts_change_nothing, make_scratch, remove_scratch),
        cmocka_unit_test(surfaces_use_up_the_list),
        cmocka_unit_test(rows_know_how_far_surfaces_reach),
        cmocka_unit_test(bonds_of_strained_bodies_are_at_rest),
        cmocka_unit_test(bodies_are_taken_out),
        cmocka_unit_test(what_cannot_deform_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
