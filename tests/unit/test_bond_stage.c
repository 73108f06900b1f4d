/// The stage `bond`: which pairs it joins and how strong, what is lost where contacts become bonds, what it refuses,
/// and runs that are taken up again while bonds break.
#include "run_fixture.h"

#include "io_scratch.h"

#include "bond/bond.h"
#include "bond/strength.h"
#include "run/step.h"
#include "state/persistent.h"

#define ROCK                                                                                                           \
    "  - {name: rock, normal_stiffness: 1e6 N/m, stiffness_ratio: 0.5, damping_ratio: 0.02, density: 2000 kg/m3, "     \
    "young_modulus: 1 GPa, friction: 0.5}\n"

/// A hexagonal strip whose ends are pulled apart.
#define STRIP(bond)                                                                                                    \
    "scree: 1\nname: strip\nmaterials:\n" ROCK "contact: {law: linear}\n"                                              \
    "particles: {shape: disc, material: rock, count: 40, distribution: equal, radius: 1 mm, thickness: 10 mm}\n"       \
    "measure: {cells: no, samples: 20}\n"                                                                              \
    "output: {snapshots: 3}\n"                                                                                         \
    "selections:\n"                                                                                                    \
    "  - {select: band, name: floor, axis: y, measured: low, from: 0 mm, to: 3 mm}\n"                                  \
    "  - {select: band, name: lid, axis: y, measured: high, from: 0 mm, to: 3 mm}\n"                                   \
    "  - {select: not, name: middle, of: [lid]}\n"                                                                     \
    "loads:\n"                                                                                                         \
    "  - {load: prescribed, selection: floor, velocity_x: 0, velocity_y: 0, spin_z: 0}\n"                              \
    "  - {load: prescribed, selection: lid, velocity_x: 0, velocity_y: 1 m/s, spin_z: 0}\n"                            \
    "stages:\n"                                                                                                        \
    "  - {stage: prepare, method: hexagonal, aspect_ratio: 2}\n"                                                       \
    "  - {stage: bond, " bond "}\n"                                                                                    \
    "  - {stage: relax, name: pull, boundary: none, duration: 0.2 ms}\n"                                               \
    "  - {stage: relax, name: on, boundary: none, duration: 0.1 ms}\n"

static const char strip[] = STRIP("tensile_strength: 20 N, shear_strength: 12 N, scatter: weibull, weibull_modulus: 6");

// ---- making ------------------------------------------------------------------------------------------------------

/// Goes to the end of the first bond stage.
static void make(const char *text, scree_simulation *s, scree_case **c)
{
    *c = case_read(text, NULL, 0);
    simulation_open(*c, 1, s);
    while (s->state.stage.index < 1 || s->state.stage.counter != SCREE_STAGE_ENDED) simulation_step(s);
}

/// All neighbours of the lattice, each once; at rest, whatever round-off says of their gaps.
static void neighbours_are_bonded(void **unused)
{
    (void)unused;
    scree_simulation s;
    scree_case *c;
    make(STRIP("tensile_strength: 5 N, shear_stress: 2 kPa, internal_friction: 0.4"), &s, &c);
    const scree_persistent_list *list = scree_persistent(&s.state);
    size_t neighbours = 0;
    for (size_t a = 0; a < s.state.count; a++)
        for (size_t b = a + 1; b < s.state.count; b++) {
            const scree_row *one = &s.state.row[a], *other = &s.state.row[b];
            neighbours += hypot(one->x - other->x, one->y - other->y) < 2.01e-3;
        }
    assert_int_equal(list->count, neighbours);
    assert_int_equal(scree_bonds_of(&s.state)->made, neighbours);
    for (size_t k = 0; k < list->count; k++) {
        const double *constant = list->member[k].constant;
        assert_true(constant[SCREE_MEMBER_TENSION] == 5 && constant[SCREE_MEMBER_SLOPE] == 0.4);
        assert_true(fabs(constant[SCREE_MEMBER_SHEAR] / (2e3 * 10e-3 * 2e-3) - 1) < 1e-12);
        assert_true(fabs(constant[SCREE_MEMBER_REST]) < 1e-12);
    }
    assert_non_null(strstr(s.reason, "bonds made"));
    simulation_close(&s);
    scree_case_free(c);
}

/// Within one selection, between two, and by a list; geometric rest.
static void those_that_are_named_are_bonded(void **unused)
{
    (void)unused;
    static const struct {
        const char *text;
        size_t least, most;
    } row[] = {
        {STRIP("between: lid"), 5, 16},
        {STRIP("between: lid, and: middle"), 5, 14},
        {STRIP("list: [[0, 1], [2, 1]], rest: geometric"), 2, 2},
    };
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        scree_simulation s;
        scree_case *c;
        make(row[i].text, &s, &c);
        const scree_persistent_list *list = scree_persistent(&s.state);
        assert_in_range(list->count, row[i].least, row[i].most);
        const double lid = s.state.row[s.state.row_of_id[s.state.count - 1]].y - 2.2e-3;
        for (size_t k = 0; k < list->count; k++) {
            const scree_persistent_member *m = &list->member[k];
            const bool one = s.state.row[s.state.row_of_id[m->first]].y > lid,
                       other = s.state.row[s.state.row_of_id[m->second]].y > lid;
            if (i < 2) assert_true(i == 0 ? one && other : one != other);
            if (i == 2) assert_true(m->first == k && m->second == k + 1 && m->constant[SCREE_MEMBER_REST] == 0);
            assert_true(isinf(m->constant[SCREE_MEMBER_TENSION]) && isinf(m->constant[SCREE_MEMBER_SHEAR]));
        }
        simulation_close(&s);
        scree_case_free(c);
    }
}

/// Mean and deviation of factors against those of the distributions: 3 standard errors of 20000 draws. The same for
/// both orders of the ids; another seed gives others.
static void strengths_scatter(void **unused)
{
    (void)unused;
    enum { DRAWS = 20000 };
    for (int scatter = SCREE_SCATTER_NORMAL; scatter <= SCREE_SCATTER_WEIBULL; scatter++) {
        const scree_strength s = {.scatter = scatter, .deviation = 0.2, .modulus = 5, .seed = 8};
        scree_strength other = s;
        other.seed = 9;
        const double g = tgamma(1.2),
                     expected = scatter == SCREE_SCATTER_NORMAL ? 0.2 : sqrt(tgamma(1.4) / (g * g) - 1);
        double sum = 0, squares = 0;
        for (uint32_t k = 0; k < DRAWS; k++) {
            const double factor = scree_bond_factor(&s, k, k + 7);
            assert_true(factor > 0 && factor == scree_bond_factor(&s, k + 7, k));
            assert_true(factor != scree_bond_factor(&other, k, k + 7));
            sum += factor;
            squares += factor * factor;
        }
        const double mean = sum / DRAWS, deviation = sqrt(squares / DRAWS - mean * mean);
        print_message("mean %.5f, deviation %.5f (%.5f)\n", mean, deviation, expected);
        assert_true(fabs(mean - 1) < 3 * expected / sqrt(DRAWS));
        assert_true(fabs(deviation / expected - 1) < 0.02);
    }
}

/// Two that press on each other and slide are bonded in the middle of it: their contact is gone with its energy, which
/// is kept, no force is left but that of dashpots, and the balance goes on closed.
static void contacts_become_bonds(void **unused)
{
    (void)unused;
    static const char *const schemes[] = {"velocity_verlet", "position_verlet"};
    for (int scheme = 0; scheme < 2; scheme++)
        for (int periodic = 0; periodic < 2; periodic++) {
            char text[1600];
            scree_simulation s;
            (void)snprintf(text, sizeof text,
                           "scree: 1\nname: two\nmaterials:\n" ROCK
                           "contact: {law: linear}\nintegrator: {scheme: %s, step: 1e-8 s}\n"
                           "particles: {shape: disc, material: rock, count: 2, distribution: equal, radius: 1 mm, "
                           "thickness: 10 mm}\nmeasure: {cells: no, samples: 20}\n%s"
                           "stages:\n"
                           "  - stage: prepare\n    method: bodies\n    width: 10 mm\n    height: 10 mm\n    bodies:\n"
                           "      - {position: [%s mm, 5 mm], velocity: [1 m/s, 0.3 m/s]}\n"
                           "      - {position: [%s mm, 5.4 mm], velocity: [-1 m/s, 0 m/s], spin: [0, 0, 300 rad/s]}\n"
                           "  - {stage: relax, boundary: none, duration: 6e-6 s}\n"
                           "  - {stage: bond, overlap_tolerance: 0.2 mm}\n"
                           "  - {stage: relax, name: after, boundary: none, duration: 60e-6 s}\n",
                           schemes[scheme], periodic ? "boundary: {periodic: x}\n" : "", periodic ? "9.02" : "4.02",
                           periodic ? "0.98" : "5.98");
            scree_case *c = case_read(text, NULL, 0);
            simulation_open(c, 1, &s);
            while (s.state.stage.index < 2 && !(s.state.stage.index == 1 && s.state.stage.counter == SCREE_STAGE_ENDED))
                simulation_step(&s);
            const double elastic = s.sample[SCREE_SAMPLE_ELASTIC_NORMAL] + s.sample[SCREE_SAMPLE_ELASTIC_TANGENTIAL];
            const double before = s.sample[SCREE_SAMPLE_ENERGY_RESIDUAL];
            assert_true(elastic > 0);
            simulation_step(&s); // the bond
            assert_int_equal(s.state.stage.index, 2);
            const scree_bonds *bonds = scree_bonds_of(&s.state);
            scree_error error;
            check(scree_sample_take(&s, &error), &error);
            const double after = s.sample[SCREE_SAMPLE_ENERGY_RESIDUAL];
            const double left = s.sample[SCREE_SAMPLE_ELASTIC_NORMAL] + s.sample[SCREE_SAMPLE_ELASTIC_TANGENTIAL];
            print_message("%s, periodic %d: elastic %.3g J, bonding %.3g J, residual %.2g and %.2g of it\n",
                          schemes[scheme], periodic, elastic, bonds->bonding, before / elastic, after / elastic);
            assert_int_equal(bonds->made, 1);
            assert_true(left < 1e-20 && fabs(bonds->bonding / elastic - 1) < 0.1);
            assert_true(fabs(after - before) < 1e-9 * elastic);
            assert_int_equal(s.state.sum[0].fx + s.state.sum[1].fx, 0);
            const double force = fabs((double)s.state.sum[0].fx * s.state.force_quantum);
            assert_true(force > 0 && force < 0.1 * sqrt(2 * 1e6 * elastic)); // of the dashpots alone
            (void)simulation_finish(&s);
            assert_true(fabs(s.sample[SCREE_SAMPLE_ENERGY_RESIDUAL] - before) < 1e-4 * elastic);
            simulation_close(&s);
            scree_case_free(c);
        }
}

// ---- runs --------------------------------------------------------------------------------------------------------

/// Rows of a file.
static size_t rows_of(const char *folder, const char *name)
{
    char path[200];
    size_t rows = 0;
    (void)snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    for (int c; (c = fgetc(file)) != EOF;) rows += c == '\n';
    fclose(file);
    return rows;
}

static double result_of(const char *folder, const char *name)
{
    char text[64];
    scree_error error;
    check(scree_result_get(folder, name, text, sizeof text, &error), &error);
    return strtod(text, NULL);
}

/// A run that is stopped while bonds break, and one that is not: the same state, the same table.
static void runs_break_and_go_on(void **unused)
{
    (void)unused;
    char folder[64], whole[100], part[100], line[2][400];
    assert_true(scratch_create(folder));
    (void)snprintf(whole, sizeof whole, "%s/whole", folder);
    (void)snprintf(part, sizeof part, "%s/part", folder);
    scree_case *c = case_read(strip, NULL, 0);
    run_restart(c, whole, part, 2, "stage relax (pull) ended");
    const double broken = result_of(whole, "bonds_broken_tension") + result_of(whole, "bonds_broken_shear");
    print_message("%g of %g bonds broke, the first after %g s\n", broken, result_of(whole, "bonds_made"),
                  result_of(whole, "first_break_time"));
    assert_true(result_of(whole, "first_break_time") < 0.2e-3); // the run was stopped behind it
    assert_true(broken > 3 && broken + result_of(whole, "bonds_left") == result_of(whole, "bonds_made"));
    assert_true(rows_of(whole, "breaks.csv") == (size_t)broken + 1);
    FILE *one = fopen(strcat(whole, "/breaks.csv"), "r"), *other = fopen(strcat(part, "/breaks.csv"), "r");
    assert_true(one && other);
    while (fgets(line[0], sizeof line[0], one)) {
        assert_non_null(fgets(line[1], sizeof line[1], other));
        assert_string_equal(line[0], line[1]);
    }
    fclose(one);
    fclose(other);
    scree_case_free(c);
    scratch_destroy(folder);
}

/// Taken up again from a checkpoint with some bonds broken and others to break.
static void a_restart_loses_no_break(void **unused)
{
    (void)unused;
    char folder[64];
    assert_true(scratch_create(folder));
    scree_simulation s, other;
    scree_case *c = case_read(strip, NULL, 0);
    simulation_open(c, 1, &s);
    while (scree_bonds_of(&s.state)->count < 2) simulation_step(&s);
    simulation_reopen(&s, 3, folder, &other);
    (void)simulation_finish(&s);
    (void)simulation_finish(&other);
    assert_true(scree_bonds_of(&s.state)->count > 4);
    assert_int_equal(scree_bonds_of(&s.state)->count, scree_bonds_of(&other.state)->count);
    assert_true(simulation_close(&s) == simulation_close(&other));
    scree_case_free(c);
    scratch_destroy(folder);
}

/// The ledger of the strip through its failure, and the same bits with other threads.
static void the_strip_fails(void **unused)
{
    (void)unused;
    uint64_t bits = 0;
    for (int threads = 1; threads <= 3; threads++) {
        scree_simulation s;
        scree_case *c = case_read(strip, NULL, 0);
        simulation_open(c, threads, &s);
        s.work.keep_threads = true;
        const double worst = simulation_finish(&s);
        if (threads == 1) print_message("%zu bonds broke, residual %.2g\n", scree_bonds_of(&s.state)->count, worst);
        assert_true(scree_bonds_of(&s.state)->count > 3 && worst < 1e-4);
        const uint64_t now = simulation_close(&s);
        if (threads == 1) bits = now;
        assert_true(now == bits);
        scree_case_free(c);
    }
}

// ---- what is refused ---------------------------------------------------------------------------------------------

static void cases_are_refused(void **unused)
{
    (void)unused;
    static const struct {
        const char *text, *path, *message;
    } row[] = {
        {STRIP("tensile_strength: 0 N"), "stages.1.tensile_strength", "0 N"},
        {STRIP("shear_strength: -3 N"), "stages.1.shear_strength", "-3 N"},
        {STRIP("tensile_strength: 1 N, tensile_stress: 1 Pa"), "stages.1.tensile_stress", "one of the two"},
        {STRIP("internal_friction: 0.3"), "stages.1.internal_friction", "without a strength in shear"},
        {STRIP("scatter: normal"), "stages.1.scatter", "no strength"},
        {STRIP("between: lit"), "stages.1.between", "lid"},
        {STRIP("and: lid"), "stages.1.and", "without `between`"},
        {STRIP("list: [[0, 1], [1, 0]]"), "stages.1.list.1", "list.0 is the same pair"},
        {STRIP("list: [[3, 3]]"), "stages.1.list.0", "names particle 3 twice"},
        {STRIP("list: [[0, 1.5]]"), "stages.1.list.0", "numbers of two particles"},
        {STRIP("list: [[0, 1]], gap_tolerance: 1 mm"), "stages.1.gap_tolerance", "not used with a list"},
    };
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        scree_case *c;
        scree_problems *problems;
        assert_int_not_equal(case_parse(row[i].text, NULL, 0, &c, &problems), SCREE_OK);
        const scree_error *error = scree_problems_get(problems, 0);
        char line[2048];
        scree_error_format(error, line, sizeof line);
        if (strcmp(error->field, row[i].path) != 0 || !strstr(line, row[i].message)) fail_msg("%s", line);
        scree_problems_free(problems);
    }
    static const char *const set[] = {"contact.law=hertz_mindlin"};
    scree_case *c;
    scree_problems *problems;
    assert_int_not_equal(case_parse(strip, set, 1, &c, &problems), SCREE_OK);
    bool found = false;
    for (size_t k = 0; k < scree_problems_count(problems); k++)
        found = found || strstr(scree_problems_get(problems, k)->message, "cannot hold particles together");
    assert_true(found);
    scree_problems_free(problems);
}

/// What shows when the stage begins.
static void samples_are_refused(void **unused)
{
    (void)unused;
    static const struct {
        const char *text, *path, *message;
    } row[] = {
        {STRIP("gap_tolerance: 1.6 mm"), "stages.1.gap_tolerance", "second neighbours"},
        {STRIP("list: [[0, 77]]"), "stages.1.list", "names particle 77, which is not there"},
        {STRIP("rest: as_made}\n  - {stage: bond"), "stages.2.gap_tolerance", "nothing is bonded"},
        {STRIP("list: [[0, 1]]}\n  - {stage: bond, list: [[1, 0]]"), "stages.2.list", "are bonded already"},
    };
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        scree_simulation s;
        scree_case *c = case_read(row[i].text, NULL, 0);
        scree_error error = {0};
        simulation_open(c, 1, &s);
        scree_status status = SCREE_OK;
        while (!status && s.state.evaluations == 0) status = scree_simulation_step(&s, &error);
        assert_int_equal(status, SCREE_ERROR_INPUT);
        if (strcmp(error.field, row[i].path) != 0 || !strstr(error.message, row[i].message) || error.line == 0)
            fail_msg("%s at %s, line %d", error.message, error.field, error.line);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(neighbours_are_bonded), cmocka_unit_test(those_that_are_named_are_bonded),
        cmocka_unit_test(strengths_scatter),     cmocka_unit_test(contacts_become_bonds),
        cmocka_unit_test(runs_break_and_go_on),  cmocka_unit_test(a_restart_loses_no_break),
        cmocka_unit_test(the_strip_fails),       cmocka_unit_test(cases_are_refused),
        cmocka_unit_test(samples_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
