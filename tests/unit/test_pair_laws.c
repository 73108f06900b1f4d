/// Laws of single pairs of materials: each pair has the impact of its own law, walls go by what they are made of, and
/// nothing but the state decides: order of the materials, threads, instruction sets, age of the lists, restarts.
#include "run_fixture.h"

#include "io_scratch.h"
#include "net_variations.h"
#include "periodic_fixture.h"
#include "reference_cases.h"
#include "state/case_walls.h"
#include "state/check.h"

// ---- a sample of two materials under three laws ---------------------------------------------------------------------

enum { OWN = 0, MIXED = 1, OTHER = 2 }; // numbers of the laws

/// Material `a` of the sample is its first one: of the order of the materials, and of the laws.
static void set_laws(periodic_sample *s, int a)
{
    const int b = 1 - a, mixed = a ? OTHER : MIXED, other = a ? MIXED : OTHER;
    scree_model *m = &s->model;
    m->material_count = 2;
    m->pair_laws = 2;
    m->density[1] = m->density[0];
    m->laws[OWN] = (scree_law_use){.law = SCREE_SLOT_hertz_mindlin};
    m->laws[mixed] = (scree_law_use){.law = SCREE_SLOT_linear};
    m->laws[other] = (scree_law_use){.law = SCREE_SLOT_hertz_brilliantov, .option = BRILLIANTOV_IMPLICIT};
    brilliantov_numbers(2e-6, 50, m->reference_velocity, m->laws[other].number);
    m->pairs[a][a] = hertz_pair(4e9, 5e9, 0.5, 0.3);
    m->pairs[b][b] = hertz_pair(2e9, 3e9, 0.4, 0);
    m->pairs[a][b] = m->pairs[b][a] = linear_pair(4e5, 0, 0.8, 0.3, 0.1, 0.2);
    m->law_of_pairs[a][a] = OWN;
    m->law_of_pairs[b][b] = (uint8_t)other;
    m->law_of_pairs[a][b] = m->law_of_pairs[b][a] = (uint8_t)mixed;
}

static void create(periodic_sample *s, int dimension, int first)
{
    scree_error error;
    periodic_fill(s, dimension, dimension == 3 ? 5 : 9, HERTZ_MINDLIN, 0.5);
    set_laws(s, first);
    for (size_t k = 0; k < s->state.count; k++) {
        const int material = periodic_random(8 * k + 7) < -0.1 ? 1 - first : first;
        if (dimension == 2)
            s->state.row[k].material = material;
        else
            s->state.turn[k].material = material;
    }
    check(scree_state_predict(&s->state, &error), &error);
    scree_state_set_laws(&s->state, &s->model);
}

/// Numbers of touching contacts under each law.
static void count_contacts(periodic_sample *s, size_t count[3])
{
    scree_contact_table table = {0};
    scree_error error;
    check(scree_contact_table_build(&s->model, &s->state, &s->work, &table, &error), &error);
    memset(count, 0, 3 * sizeof *count);
    for (size_t c = 0; c < table.count; c++) {
        const int one = scree_body_material(&s->state, table.contact[c].first);
        count[s->model.law_of_pairs[one][scree_body_material(&s->state, table.contact[c].second)]]++;
    }
    scree_contact_table_destroy(&table);
}

enum { STEPS = 400 };

static uint64_t run(int dimension, unsigned directions, int threads, int set, bool reference, int disturbance)
{
    const double shear[9] = {0, 40, 0, 0, 0, 0, 0, 0, 0};
    periodic_sample s;
    scree_error error;
    size_t count[3];
    (void)directions;
    create(&s, dimension, 0);
    scree_work_destroy(&s.work);
    check(scree_work_create(&s.work, &s.model, threads, &error), &error);
    s.work.keep_threads = true;
    s.work.instruction_set = set;
    s.work.reference_kernel = reference;
    memcpy(scree_cell(&s.state)->gradient, shear, sizeof shear);
    periodic_forces(&s);
    for (int k = 0; k < STEPS; k++) {
        if (disturbance == 1 && k % 7 == 0) scree_neighbours_invalidate(&s.work);
        if (disturbance == 2 && k == STEPS / 2) { // what contacts remember goes through the state into a new list
            check(scree_contacts_save(&s.state, &s.work, &error), &error);
            scree_contact_scratch_destroy(&s.work);
            scree_work_destroy(&s.work);
            check(scree_work_create(&s.work, &s.model, threads, &error), &error);
        }
        periodic_step(&s);
    }
    count_contacts(&s, count);
    for (int law = 0; law < 3; law++) assert_true(count[law] > 5);
    check(scree_contacts_save(&s.state, &s.work, &error), &error);
    const uint64_t checksum = scree_state_checksum(&s.model, &s.state);
    periodic_destroy(&s);
    return checksum;
}

static void nothing_but_the_state_decides(void **unused)
{
    (void)unused;
    assert_nothing_but_the_state_decides(run, 2);
}

/// Which material is the first, and which of the laws, is nothing of the state.
static void the_order_of_materials_does_not_show(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        uint64_t checksum[2];
        for (int first = 0; first < 2; first++) {
            const double shear[9] = {0, 40, 0, 0, 0, 0, 0, 0, 0};
            periodic_sample s;
            scree_error error;
            create(&s, dimension, first);
            periodic_forces(&s);
            periodic_run(&s, shear, STEPS);
            check(scree_contacts_save(&s.state, &s.work, &error), &error);
            checksum[first] = scree_state_checksum(&s.model, &s.state);
            periodic_destroy(&s);
        }
        assert_true(checksum[0] == checksum[1]);
    }
}

/// Of the law of a pair the constants are in the checksum, too.
static void constants_of_pairs_count(void **unused)
{
    (void)unused;
    periodic_sample s;
    create(&s, 2, 0);
    const uint64_t before = scree_state_checksum(&s.model, &s.state);
    s.model.pairs[0][1].value[LINEAR_DAMPING] *= 2;
    s.model.pairs[1][0] = s.model.pairs[0][1];
    assert_true(scree_state_checksum(&s.model, &s.state) != before);
    periodic_destroy(&s);
}

static double residual(int dimension, double step)
{
    const double shear[9] = {0, 40, 0, 0, 0, 0, 0, 0, 0};
    periodic_sample s;
    scree_contact_table table = {0};
    scree_energy begin, end;
    scree_error error;
    create(&s, dimension, 0);
    // Without dashpots along the normal, whose jump at a touch is of first order; friction of a whole slide.
    for (int k = 0; k < 4; k++) {
        scree_pair_constants *pair = &s.model.pairs[k / 2][k % 2];
        const bool linear = s.model.law_of_pairs[k / 2][k % 2] == MIXED;
        pair->value[linear ? (int)LINEAR_DAMPING : (int)HERTZ_DAMPING] = 0;
    }
    s.model.laws[OTHER].number[BRILLIANTOV_TIME] = 0;
    s.model.laws[OTHER].option = 0;
    s.state.tick = s.state.step_size = s.state.kick_size = s.model.step = step;
    periodic_forces(&s);
    check(scree_contact_table_build(&s.model, &s.state, &s.work, &table, &error), &error);
    scree_energy_measure(&s.model, &s.state, &table, &begin);
    s.state.ledger = (scree_ledger){.initial = begin.kinetic + begin.kinetic_rotation + begin.elastic_normal +
                                               begin.elastic_tangential};
    periodic_run(&s, shear, (int)lrint(4e-5 / step));
    check(scree_contact_table_build(&s.model, &s.state, &s.work, &table, &error), &error);
    scree_energy_measure(&s.model, &s.state, &table, &end);
    scree_contact_table_destroy(&table);
    const double relative = fabs(end.residual) / s.state.ledger.turnover;
    periodic_destroy(&s);
    return relative;
}

/// A quarter of the step: a sixteenth of the residual, in second order; half of that is left for what opens and closes.
static void the_balance_closes(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        const double coarse = residual(dimension, 8e-8), fine = residual(dimension, 2e-8);
        print_message("%dD: residual %.3g of the turnover, with a quarter of the step %.3g\n", dimension, coarse, fine);
        assert_true(coarse < 1e-4 && fine < coarse / 8);
    }
}

/// What a contact remembers is read by its own law alone: a state that says it is of another is refused, and a list
/// that is made of it begins with clear memory there.
static void memory_of_another_law_is_not_read(void **unused)
{
    (void)unused;
    periodic_sample s;
    scree_error error;
    create(&s, 2, 0);
    periodic_forces(&s);
    for (int k = 0; k < 50; k++) periodic_step(&s);
    check(scree_contacts_save(&s.state, &s.work, &error), &error);
    assert_non_null(s.state.contact_law);
    size_t spoilt = 0;
    while (s.state.contact_law[spoilt] != MIXED || s.state.contact[spoilt].history.value[0] == 0) spoilt++;
    s.model.count = s.state.count;
    s.state.contact_law[spoilt] = OWN;
    assert_int_equal(scree_state_check(&s.state, &s.model, NULL, &error), SCREE_ERROR_IO);
    assert_non_null(strstr(error.message, "contacts/law"));
    const uint32_t first = s.state.contact[spoilt].first, second = s.state.contact[spoilt].second;
    scree_contact_scratch_destroy(&s.work);
    scree_work_destroy(&s.work);
    check(scree_work_create(&s.work, &s.model, 1, &error), &error);
    check(scree_neighbours_refresh(&s.model, &s.state, &s.work, &error), &error);
    size_t found = 0, clear = 0;
    for (size_t p = 0; p < s.work.pairs.count; p++) {
        const scree_pair_list *list = &s.work.pairs;
        const bool it = s.state.id[list->first[p]] == first && s.state.id[list->second[p]] == second;
        found += it;
        clear += it && list->history[p].value[0] == 0;
    }
    assert_true(found == 1 && clear == 1);
    periodic_destroy(&s);
}

// ---- cases ---------------------------------------------------------------------------------------------------------

#define METALS                                                                                                         \
    "scree: 1\nseed: 5\nmaterials:\n"                                                                                  \
    "  - {name: steel, young_modulus: 2 GPa, density: 7800 kg/m3, friction: 0, restitution: 0.8}\n"                    \
    "  - {name: glass, young_modulus: 1 GPa, density: 2500 kg/m3, friction: 0, restitution: 0.5, damping_ratio: "      \
    "0.1}\n"
#define METAL_LAWS                                                                                                     \
    "contact: {law: hertz_mindlin, reference_velocity: 1 m/s, pairs: [{between: steel, and: glass, law: linear}, "     \
    "{between: glass, law: hertz_brilliantov, damping_time: 1e-6 s}]}\n"
#define METAL_REST "integrator: {step: 2e-8 s}\nmeasure: {samples: 20, cells: no}\n"

/// Speed of the body with this number along x.
static double speed_of(const scree_simulation *s, uint32_t id)
{
    scree_vector velocity, spin;
    scree_body_velocity(&s->stage_model, &s->state, s->state.row_of_id[id], velocity, spin);
    return velocity[0];
}

/// Restitution of an impact under a law, from its closed form.
static double theory_of(const scree_law_use *law, const scree_pair_constants *pair, double radius, double mass,
                        double speed)
{
    scree_impact impact;
    scree_error error;
    check(scree_law_get(law->law)->impact(law, pair, radius, mass, speed, &impact, &error), &error);
    return impact.restitution;
}

/// Three pairs meet in one box, each with its own materials, and part with the restitution of their law. Within what
/// the step makes of it: a hundredth of the duration, and first order where a dashpot jumps (linear).
static void each_pair_has_the_impact_of_its_law(const char *dimension, const char *shape)
{
    // The third component of positions and velocities.
    const char *const third = strcmp(dimension, "3") == 0 ? ", 3 mm" : "", *const still = third[0] ? ", 0" : "";
    char text[2048];
    (void)snprintf(text, sizeof text,
                   METALS METAL_LAWS METAL_REST
                   "dimension: %s\nparticles: {shape: %s, material: steel, count: 6, distribution: equal, radius: 1 "
                   "mm}\n"
                   "stages:\n  - stage: prepare\n    method: bodies\n    width: 20 mm\n    height: 20 mm\n    bodies:\n"
                   "      - {position: [3 mm, 3 mm%s], velocity: [0.5 m/s, 0%s]}\n"
                   "      - {position: [5.01 mm, 3 mm%s]}\n"
                   "      - {position: [3 mm, 8 mm%s], velocity: [0.5 m/s, 0%s]}\n"
                   "      - {position: [5.01 mm, 8 mm%s], material: glass}\n"
                   "      - {position: [3 mm, 13 mm%s], velocity: [0.5 m/s, 0%s], material: glass}\n"
                   "      - {position: [5.01 mm, 13 mm%s], material: glass}\n"
                   "  - {stage: relax, duration: 0.2 ms, boundary: none}\n",
                   dimension, shape, third, still, third, third, still, third, third, still, third);
    scree_case *c = case_read(text, NULL, 0);
    scree_simulation s;
    simulation_open(c, 1, &s);
    (void)simulation_finish(&s);
    const int material[3][2] = {{0, 0}, {0, 1}, {1, 1}};
    double found[3];
    for (uint32_t k = 0; k < 3; k++) {
        const int a = material[k][0], b = material[k][1];
        const double one = scree_model_mass(&s.model, a, 1e-3), other = scree_model_mass(&s.model, b, 1e-3);
        const scree_law_use *law = scree_model_law_between(&s.model, a, b);
        const double theory = theory_of(law, &s.model.pairs[a][b], 0.5e-3, one * other / (one + other), 0.5);
        found[k] = (speed_of(&s, 2 * k + 1) - speed_of(&s, 2 * k)) / 0.5;
        print_message("%sD, %s: restitution %.5f, in theory %.5f\n", dimension, scree_modules[law->law]->name, found[k],
                      theory);
        assert_true(fabs(found[k] - theory) < 2e-3);
    }
    assert_true(fabs(found[0] - found[1]) > 0.02 && fabs(found[1] - found[2]) > 0.02);
    scree_simulation_close(&s);
    scree_case_free(c);
}

static void impacts_of_pairs(void **unused)
{
    (void)unused;
    each_pair_has_the_impact_of_its_law("2", "disc");
    each_pair_has_the_impact_of_its_law("3", "sphere");
}

/// A wall of glass, one that is rigid, and one of their own material: the law is that of what they are made of.
static void walls_go_by_their_material(void **unused)
{
    (void)unused;
    static const char *const walls[] = {"material: glass, ", "material: rigid, ", ""};
    const int slots[] = {SCREE_SLOT_linear, SCREE_SLOT_hertz_brilliantov, SCREE_SLOT_hertz_mindlin};
    for (int k = 0; k < 3; k++) {
        char text[2048];
        (void)snprintf(text, sizeof text,
                       METALS METAL_REST
                       "contact: {law: hertz_mindlin, reference_velocity: 1 m/s, pairs: [{between: glass, and: steel, "
                       "law: linear}, {between: rigid, and: steel, law: hertz_brilliantov, damping_time: 2e-6 s}]}\n"
                       "particles: {material: steel, count: 1, distribution: equal, radius: 1 mm}\n"
                       "walls: [{shape: plane, %spoint: [0, 0], normal: [1, 0]}]\n"
                       "stages:\n  - {stage: prepare, method: bodies, width: 9 mm, height: 9 mm, bodies: [{position: "
                       "[1.01 mm, 4 mm], velocity: [-0.5 m/s, 0]}]}\n"
                       "  - {stage: relax, duration: 0.2 ms}\n",
                       walls[k]);
        scree_case *c = case_read(text, NULL, 0);
        scree_simulation s;
        simulation_open(c, 1, &s);
        (void)simulation_finish(&s);
        const scree_law_use *law = scree_model_law_on_wall(&s.model, 0, 0);
        assert_int_equal(law->law, slots[k]);
        const double theory = theory_of(law, &s.model.surfaces[0][0], 1e-3, scree_model_mass(&s.model, 0, 1e-3), 0.5);
        const double found = speed_of(&s, 0) / 0.5;
        print_message("a wall under %s: restitution %.5f, in theory %.5f\n", scree_modules[law->law]->name, found,
                      theory);
        assert_true(fabs(found - theory) < 2e-3);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

/// To name the law of `contact` once more for grains of one material is the same case, to the last bit.
static void naming_the_law_again_changes_nothing(void **unused)
{
    (void)unused;
    uint64_t stored, found;
    assert_true(reference_stored("plates_2d", &stored));
    scree_status status =
        reference_run(REFERENCE_FOLDER "cases/plates_2d.yaml",
                      "contact.pairs=[{between: quartz, and: quartz, law: hertz_mindlin}]", 1, REFERENCE_END, &found);
    assert_int_equal(status, SCREE_OK);
    assert_true(found == stored);
}

/// In mid-contact, with each of the laws: through a file, and as a run that is stopped.
static void a_restart_changes_no_bit(void **unused)
{
    (void)unused;
    char folder[64], whole[96], part[96];
    assert_true(scratch_create(folder));
    snprintf(whole, sizeof whole, "%s/whole", folder);
    snprintf(part, sizeof part, "%s/part", folder);
    scree_case *c = NULL;
    assert_int_equal(reference_read(REFERENCE_FOLDER "cases/pair_laws_2d.yaml", NULL, &c), SCREE_OK);
    run_restart(c, whole, part, 2, "stage confine ended");
    scree_simulation s, other;
    simulation_open(c, 1, &s);
    simulation_load(&s);
    for (int k = 0; k < 100; k++) simulation_step(&s);
    simulation_reopen(&s, 3, folder, &other);
    assert_true(s.state.pair_laws > 0 && other.state.contact_law);
    for (int k = 0; k < 100; k++) {
        simulation_step(&s);
        simulation_step(&other);
    }
    assert_true(simulation_close(&s) == simulation_close(&other));
    scree_case_free(c);
    scratch_destroy(folder);
}

/// A view cannot show what lies in several places, and says so; what all contacts have alike it shows.
static void views_say_what_they_cannot_show(void **unused)
{
    (void)unused;
    scree_case *c = NULL;
    scree_simulation *s;
    scree_view view;
    scree_error error;
    bool done;
    assert_int_equal(reference_read(REFERENCE_FOLDER "cases/pair_laws_2d.yaml", NULL, &c), SCREE_OK);
    check(scree_simulation_create(c, 1, &s, &error), &error);
    do {
        check(scree_simulation_advance(s, 200, &done, &error), &error);
        check(scree_simulation_view(s, "contacts/law", &view, &error), &error);
    } while (view.count == 0 && !done);
    assert_true(view.count > 0 && view.type == SCREE_FIELD_UINT8);
    assert_int_equal(scree_simulation_view(s, "contacts/tangential_displacement", &view, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "several laws"));
    for (size_t k = 0; scree_simulation_view_name(s, k); k++)
        check(scree_simulation_view(s, scree_simulation_view_name(s, k), &view, &error), &error);
    scree_simulation_free(s);
    scree_case_free(c);
}

// ---- bad input -----------------------------------------------------------------------------------------------------

/// The case is refused at a key, with this in the message.
static void expect_refused(const char *pairs, const char *more, const char *field, const char *message)
{
    char text[2048];
    scree_case *c;
    scree_problems *problems;
    bool found = false;
    (void)snprintf(text, sizeof text,
                   METALS "contact: {law: hertz_mindlin, reference_velocity: 1 m/s%s, pairs: [%s]}\n"
                          "particles: {material: steel, count: 9, distribution: equal, radius: 1 mm}\n"
                          "stages:\n  - {stage: prepare}\n  - {stage: confine, pressure: 1 kPa}\n",
                   more, pairs);
    assert_int_equal(case_parse(text, NULL, 0, &c, &problems), SCREE_ERROR_INPUT);
    for (size_t k = 0; k < scree_problems_count(problems); k++) {
        const scree_error *error = scree_problems_get(problems, k);
        found = found || (strcmp(error->field, field) == 0 && strstr(error->message, message) && error->line > 0);
    }
    if (!found)
        for (size_t k = 0; k < scree_problems_count(problems); k++)
            print_message("%s: %s\n", scree_problems_get(problems, k)->field, scree_problems_get(problems, k)->message);
    assert_true(found);
    scree_problems_free(problems);
}

static void wrong_pairs_are_refused(void **unused)
{
    (void)unused;
#define USED "{between: glass, and: steel, law: linear}" /* or damping_ratio has no use */
    expect_refused(USED ", {between: steel, and: glass, law: hertz_mindlin}", "", "contact.pairs.1.between",
                   "contact.pairs.0 is of steel and glass too");
    expect_refused(USED ", {between: steal, law: linear}", "", "contact.pairs.1.between", "did you mean 'steel'");
    expect_refused(USED ", {between: steel, and: chalk, law: linear}", "", "contact.pairs.1.and",
                   "there is no material 'chalk'");
    expect_refused(USED ", {between: rigid, law: linear}", "", "contact.pairs.1.and", "does not touch another");
    expect_refused(USED ", {between: steel}", "", "contact.pairs.1.law", "required");
    expect_refused(USED ", {between: steel, law: linea}", "", "contact.pairs.1.law", "did you mean 'linear'");
    expect_refused(USED ", {between: steel, law: linear, damping_time: 1 ms}", "", "contact.pairs.1.damping_time",
                   "not used with law: linear");
    expect_refused("{between: steel, law: hertz_brilliantov}", "", "materials.1.damping_ratio",
                   "not used with contact.law: hertz_mindlin");
    expect_refused(USED, ", deformation: explicit", "contact.deformation", "does not carry particles that deform");
}

/// Under linear as the law of all, a pair under another one cannot deform.
static void deformable_bodies_need_it_of_every_pair(void **unused)
{
    (void)unused;
    static const char text[] =
        METALS "contact: {law: linear, deformation: relaxed, pairs: [{between: steel, and: glass, law: "
               "hertz_mindlin}]}\n"
               "particles: {material: steel, count: 9, distribution: equal, radius: 1 mm}\n"
               "boundary: {lateral: plates}\n"
               "stages:\n  - {stage: prepare}\n  - {stage: confine, pressure: 1 kPa}\n";
    scree_case *c;
    scree_problems *problems;
    assert_int_equal(case_parse(text, NULL, 0, &c, &problems), SCREE_ERROR_INPUT);
    assert_int_equal(scree_problems_count(problems), 1);
    assert_string_equal(scree_problems_get(problems, 0)->field, "contact.pairs.0.law");
    scree_problems_free(problems);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_but_the_state_decides),     cmocka_unit_test(the_order_of_materials_does_not_show),
        cmocka_unit_test(constants_of_pairs_count),          cmocka_unit_test(the_balance_closes),
        cmocka_unit_test(memory_of_another_law_is_not_read), cmocka_unit_test(impacts_of_pairs),
        cmocka_unit_test(walls_go_by_their_material),        cmocka_unit_test(naming_the_law_again_changes_nothing),
        cmocka_unit_test(a_restart_changes_no_bit),          cmocka_unit_test(views_say_what_they_cannot_show),
        cmocka_unit_test(wrong_pairs_are_refused),           cmocka_unit_test(deformable_bodies_need_it_of_every_pair),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
