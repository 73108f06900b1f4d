/// Straight parts of curves: of a polyline whose parts are known, and those that do not exist; mean strain of a sample
/// that is strained by hand; both in a run.
#include "run_fixture.h"

#include "io_scratch.h"
#include "measure/linear_range.h"
#include "state/body.h"

#include <scree/scree.h>

#include <stdlib.h>

enum { ROWS = 401 };

/// A toe of x^2 up to 20 % of the peak, a straight part up to 80 %, then a bend with half the slope, and back after the
/// peak.
static void draw(double x[ROWS], double y[ROWS])
{
    for (int k = 0; k < ROWS; k++) {
        x[k] = k / 300.0;
        if (x[k] < 0.4)
            y[k] = x[k] * x[k] / 0.8;
        else if (x[k] < 1)
            y[k] = 0.2 + (x[k] - 0.4);
        else
            y[k] = 0.8 + 0.5 * (x[k] - 1);
        if (k > 390) y[k] = 1.4 - y[k];
    }
}

static void parts_of_a_polyline(void **unused)
{
    (void)unused;
    double x[ROWS], y[ROWS];
    draw(x, y);
    const scree_curve c = {x, y, y, ROWS};
    scree_linear_range r;
    scree_error error;
    check(scree_linear_range_find(&c, 0.3, 0.6, 1e-6, &r, &error), &error);
    assert_true(fabs(r.slope - 1) < 1e-12 && r.departure < 1e-12);
    assert_true(fabs(r.peak - 0.95) < 1e-12 && fabs(r.at - 1.3) < 1e-12);
    // The peak is 0.8 + 0.5 * 0.3 = 0.95: the straight part lies between 0.21 and 0.84 of it.
    check(scree_linear_range_find(&c, NAN, NAN, 1e-6, &r, &error), &error);
    assert_true(fabs(r.from - 0.25) < 1e-12 && fabs(r.to - 0.8) < 1e-12 && fabs(r.slope - 1) < 1e-12);
    assert_int_equal(scree_linear_range_find(&c, 0.05, 0.5, 0.01, &r, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "not straight"));
}

/// The range is that of another column; what comes after its peak, and rows that are no numbers, do not count.
static void a_range_by_another_column(void **unused)
{
    (void)unused;
    double x[ROWS], load[ROWS], y[ROWS];
    draw(x, load);
    for (int k = 0; k < ROWS; k++) y[k] = k % 7 == 0 ? (double)NAN : -0.25 * x[k] + (load[k] > 0.5 ? 1 : 0);
    const scree_curve c = {x, y, load, ROWS};
    scree_linear_range r;
    scree_error error;
    check(scree_linear_range_find(&c, 0.1, 0.5, 1e-6, &r, &error), &error);
    assert_true(fabs(r.slope + 0.25) < 1e-12);
}

static void what_is_not_straight(void **unused)
{
    (void)unused;
    double x[ROWS], y[ROWS];
    for (int k = 0; k < ROWS; k++) {
        x[k] = k / 400.0;
        y[k] = x[k] * x[k];
    }
    scree_linear_range r;
    scree_error error;
    const scree_curve c = {x, y, y, ROWS}, few = {x, y, y, 5}, none = {x, y, y, 1};
    // In a fifth of the range the parabola departs by 1.3 % and more.
    assert_int_equal(scree_linear_range_find(&c, NAN, NAN, 0.005, &r, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "no straight part"));
    assert_int_equal(scree_linear_range_find(&few, 0.2, 0.5, 0.02, &r, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "more samples"));
    assert_int_equal(scree_linear_range_find(&none, NAN, NAN, 0.02, &r, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "no load"));
}

// ---- in a run ----------------------------------------------------------------------------------------------------

#define ROCK                                                                                                           \
    "materials: [{name: rock, normal_stiffness: 1e8 N/m, stiffness_ratio: 0.5, damping_ratio: 0.5, density: 2000 "     \
    "kg/m3, young_modulus: 1 GPa, friction: 0.5}]\ncontact: {law: linear}\n"
#define PLANE                                                                                                          \
    "scree: 1\nname: plane\n" ROCK                                                                                     \
    "particles: {shape: disc, material: rock, count: 60, distribution: equal, radius: 1 mm, thickness: 1 m}\n"
#define SPACE                                                                                                          \
    "scree: 1\nname: space\ndimension: 3\n" ROCK                                                                       \
    "particles: {shape: sphere, material: rock, count: 64, distribution: equal, radius: 1 mm}\n"
#define STAGES(method)                                                                                                 \
    "stages:\n  - {stage: prepare, method: " method "}\n  - {stage: bond}\n"                                           \
    "  - {stage: relax, name: press, boundary: none, duration: 50 us}\n"

/// All bodies are moved by a gradient; rounding of places a few mm from the origin is some 1e-18 m.
static void gradients_are_found_again(void **unused)
{
    (void)unused;
    static const char *const texts[] = {
        PLANE
        "measure: {cells: no, mean_strain: yes, samples: 10}\nguard: {energy_growth: 1000 %}\n" STAGES("hexagonal"),
        SPACE "measure: {cells: no, mean_strain: yes, samples: 10}\nguard: {energy_growth: 1000 %}\n" STAGES("cubic")};
    static const double gradient[9] = {3e-5, 2e-5, -1e-5, 4e-5, -5e-5, 6e-5, 1e-5, 2e-5, 7e-5};
    static const char *const names[] = {"mean_strain_xx", "mean_strain_yy", "mean_strain_zz",
                                        "mean_strain_yz", "mean_strain_xz", "mean_strain_xy"};
    static const int first[] = {0, 1, 2, 1, 0, 0}, second[] = {0, 1, 2, 2, 2, 1};
    for (int space = 0; space < 2; space++) {
        scree_simulation s;
        scree_error error;
        scree_case *c = case_read(texts[space], NULL, 0);
        simulation_open(c, 1, &s);
        while (s.state.stage.index < 2 || s.state.stage.counter < 0) simulation_step(&s);
        for (size_t row = 0; row < s.state.count; row++) {
            double *const at[3] = {&s.state.row[row].x, &s.state.row[row].y, &s.state.row[row].z};
            for (int i = 0; i < 2 + space; i++) {
                *at[i] = s.state.reference[row][i];
                for (int j = 0; j < 2 + space; j++) *at[i] += gradient[3 * i + j] * s.state.reference[row][j];
            }
        }
        check(scree_sample_take(&s, &error), &error);
        for (int k = 0; k < 6; k++) {
            const double found = scree_sample_get(&s, names[k]);
            const double expected = 0.5 * (gradient[3 * first[k] + second[k]] + gradient[3 * second[k] + first[k]]);
            if (!space && (first[k] == 2 || second[k] == 2))
                assert_true(isnan(found));
            else
                assert_true(fabs(found - expected) < 1e-13);
        }
        simulation_close(&s);
        scree_case_free(c);
    }
}

/// A strip pressed by its lowest and highest rows at a steady rate, against the static solution of the same specimen:
/// stresses are those of the contacts, strains those of the centres, damped waves are some 1 % of the load.
static void a_run_has_its_moduli(void **unused)
{
    (void)unused;
    static const char text[] = PLANE
        "measure:\n  cells: no\n  mean_strain: yes\n  samples: 100\n  slopes:\n"
        "    - {name: young, y: stress_axial_contacts, x: mean_strain_yy}\n"
        "    - {name: poisson, y: mean_strain_xx, x: mean_strain_yy, of: stress_axial_contacts, from: 20 %, to: "
        "90 %, straight: 5 %}\n"
        "    - {name: none, y: mean_strain_xy, x: time, straight: 0.001 %}\n"
        "output: {figures: no, paraview: no, snapshots: 1}\n"
        "selections: [{select: layer, name: low, axis: y, end: low}, {select: layer, name: high, axis: y, end: high}]\n"
        "loads:\n  - {load: background_damping, translation: 0.3}\n"
        "  - {load: prescribed, selection: low, from: press, velocity_y: 5 mm/s}\n"
        "  - {load: prescribed, selection: high, from: press, velocity_y: -5 mm/s}\n" STAGES("hexagonal");
    char place[64], folder[128], value[200];
    scree_error error;
    assert_true(scratch_create(place));
    (void)snprintf(folder, sizeof folder, "%s/run", place);
    const scree_run_options options = {.output = folder, .threads = 1};
    scree_case *c = case_read(text, (const char *const[]){"stages.press.duration=1 ms"}, 1);
    check(scree_run(c, &options, &error), &error);
    scree_case_free(c);
    check(scree_result_get(folder, "young_slope", value, sizeof value, &error), &error);
    const double young = -strtod(value, NULL);
    check(scree_result_get(folder, "poisson_slope", value, sizeof value, &error), &error);
    const double poisson = -strtod(value, NULL);
    // An unbounded hexagonal lattice, 1 m long: E = 4 k_n (k_n + k_t) / (sqrt 3 (3 k_n + k_t)), nu = (k_n - k_t)/(3 k_n
    // + k_t); a strip of 60 discs between its outermost centres has half-cells at its sides.
    const double k = 1e8, t = 0.5 * k;
    assert_true(fabs(young / (4 * k * (k + t) / (sqrt(3) * (3 * k + t))) - 1) < 0.25);
    assert_true(fabs(poisson / ((k - t) / (3 * k + t)) - 1) < 0.25);
    check(scree_result_get(folder, "young_straight", value, sizeof value, &error), &error);
    assert_string_equal(value, "yes");
    check(scree_result_get(folder, "none_straight", value, sizeof value, &error), &error);
    assert_non_null(strstr(value, "straight"));
    assert_int_equal(scree_result_get(folder, "none_slope", value, sizeof value, &error), SCREE_ERROR_INPUT);
    scratch_destroy(place);
}

static void wrong_keys_are_refused(void **unused)
{
    (void)unused;
    static const char text[] = PLANE "measure:\n  cells: no\n  slopes:\n"
                                     "    - {name: a, y: stress_axial_contact, x: time}\n"
                                     "    - {name: a, y: kinetic, x: time, from: 20 %}\n"
                                     "    - {name: b, y: kinetic, x: time, from: 50 %, to: 20 %}\n" STAGES("hexagonal");
    static const char *const parts[] = {"stress_axial_contacts", "has this name", "both ends", "ends before"};
    scree_case *c;
    scree_problems *problems;
    assert_int_equal(case_parse(text, NULL, 0, &c, &problems), SCREE_ERROR_INPUT);
    assert_int_equal(scree_problems_count(problems), 4);
    for (int k = 0; k < 4; k++) {
        bool found = false;
        for (size_t i = 0; i < 4; i++)
            found = found || strstr(scree_problems_get(problems, i)->message, parts[k]) != NULL;
        if (!found) fail_msg("nothing says '%s'", parts[k]);
    }
    scree_problems_free(problems);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_of_a_polyline),  cmocka_unit_test(a_range_by_another_column),
        cmocka_unit_test(what_is_not_straight), cmocka_unit_test(gradients_are_found_again),
        cmocka_unit_test(a_run_has_its_moduli), cmocka_unit_test(wrong_keys_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
