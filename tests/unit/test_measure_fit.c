/// Fits to ensembles of made-up piles: tables as those of measured piles with the stress of a theory give its
/// parameters back, in the frame and with the signs of measured stresses; with noise within their intervals; an
/// asymmetric part is that of the mirror image and goes. The figures have all theories, with their kinks where these
/// are, and of many cuts some from bottom to top.
#include "fit_fixture.h"
#include "view_testing.h"

#include "base/random.h"

#include <limits.h>
#include <math.h>
#include <string.h>

enum { PILES = 6, CUTS = 4, POINTS = 41 };

#define SLOPE  (28 * M_PI / 180)
#define HEIGHT 0.1
#define WEIGHT 4e4
#define SIDE   0.01

static double noise_of(uint64_t number)
{
    return scree_random_normal(5, SCREE_RANDOM_TEST, number);
}

static void take_values(scree_average_table *values)
{
    scree_error error;
    check(scree_average_table_begin_row(values, &error), &error);
    scree_average_table_take(values, "element_side", "m", SIDE);
    scree_average_table_take(values, "triangle_height", "m", HEIGHT);
    scree_average_table_take(values, "triangle_slope", "degree", 28);
    scree_average_table_take(values, "weight_density", "N/m3", WEIGHT);
    check(scree_average_table_end_row(values, &error), &error);
}

/// A place of a cut; y is up and stresses are tension positive, as in measured tables.
static void take_place(scree_average_table *cuts, const scree_fit *truth, double x, double y, double noise, double lean,
                       uint64_t number)
{
    scree_error error;
    scree_stress_2d s;
    const scree_fit_point point = {.x = x, .y = HEIGHT - y};
    const double scale = noise * WEIGHT * HEIGHT;
    check(scree_fit_stress(truth, 1, &point, &s, &error), &error);
    check(scree_average_table_begin_row(cuts, &error), &error);
    scree_average_table_take(cuts, "x", "m", x);
    scree_average_table_take(cuts, "y", "m", y);
    scree_average_table_take(cuts, "inside", "1", fabs(x) + 0.5 * SIDE < (HEIGHT - y - 0.5 * SIDE) / tan(SLOPE));
    scree_average_table_take(cuts, "stress_xx", "Pa", -s.xx + scale * noise_of(3 * number) + lean * x);
    scree_average_table_take(cuts, "stress_yy", "Pa", -s.yy + scale * noise_of(3 * number + 1) + lean * x);
    scree_average_table_take(cuts, "stress_xy", "Pa", s.xy + scale * noise_of(3 * number + 2) + lean * fabs(x));
    check(scree_average_table_end_row(cuts, &error), &error);
}

/// An ensemble with the stress of OSL of this eta, and its fits.
static void make(double eta, double noise, uint64_t seed, measure_tables *each, measure_found *found,
                 measure_plan *plan)
{
    scree_error error;
    scree_fit truth;
    *plan = (measure_plan){.average = {.cuts = CUTS, .points = POINTS}, .fit = {"osl", "bcc", "wedge_core"}, .fits = 3};
    check(scree_fit_begin("osl", &truth, &error), &error);
    check(scree_fit_set(&truth, "weight", WEIGHT, true, &error), &error);
    check(scree_fit_set(&truth, "slope", SLOPE, false, &error), &error);
    check(scree_fit_set(&truth, "eta", eta, true, &error), &error);
    for (uint64_t i = 0; i < PILES; i++) {
        each[i] = (measure_tables){0};
        take_values(&each[i].of[MEASURE_VALUES]);
        for (uint64_t k = 0; k < CUTS * POINTS; k++)
            take_place(&each[i].of[MEASURE_CUTS], &truth,
                       ((double)(k % POINTS) / (POINTS / 2) - 1) * HEIGHT / tan(SLOPE),
                       0.5 * SIDE + 0.2 * HEIGHT * (double)(k / POINTS), noise, noise > 0 ? 3e3 : 0,
                       (seed * PILES + i) * CUTS * POINTS + k);
    }
    *found = (measure_found){.runs = PILES};
    for (int product = MEASURE_VALUES; product <= MEASURE_CUTS; product++) {
        scree_average_table same[PILES];
        for (int i = 0; i < PILES; i++) same[i] = each[i].of[product];
        check(scree_average_table_mean(same, PILES, &found->mean.of[product], NULL, NULL, &error), &error);
    }
    check(measure_fit(each, PILES, plan, found, &error), &error);
}

/// Without noise: the numbers of the theory; where its surface yields the expression of Mohr and Coulomb is 0, and on
/// the axis xx / yy is eta. Search and differences leave 1e-6; errors of 0 would leave no value, so there is a little.
static void test_exact(void **state)
{
    (void)state;
    measure_tables each[PILES];
    measure_found found;
    measure_plan plan;
    make(0.74, 1e-7, 1, each, &found, &plan);
    assert_near(number_of(&found, "fit_osl_eta").value, 0.74, 1e-5);
    assert_near(number_of(&found, "fit_osl_weight_ratio").value, 1, 1e-5);
    assert_near(number_of(&found, "fit_osl_misfit").value, 0, 1e-5);
    // The boundary of the core at 28 degrees, docs/theory/piles.md.
    assert_near(number_of(&found, "fit_wedge_core_core").value, 35.9, 0.05);
    // What follows from the parameters: `scree theory osl --phi 28 --eta 0.74` (R: mu -0.31, K 1.345, tau 85), and R's
    // parameters of the core at 35.9 degrees by R 4.12.
    assert_near(number_of(&found, "fit_osl_mu").value, -0.29794, 1e-4);
    assert_near(number_of(&found, "fit_osl_ratio").value, 1.34544, 1e-4);
    assert_near(number_of(&found, "fit_osl_tau").value, 85.1417, 2e-3);
    assert_near(number_of(&found, "fit_osl_dip").value, 0.13675, 1e-4);
    assert_near(number_of(&found, "fit_bcc_dip").value, 0, 1e-9);
    const double core = number_of(&found, "fit_wedge_core_core").value * M_PI / 180;
    const double c = sin(SLOPE), s = cos(SLOPE), less = c / s - 1 / tan(core);
    assert_near(number_of(&found, "fit_wedge_core_a1").value, -c * s * less, 1e-9);
    assert_near(number_of(&found, "fit_wedge_core_a2").value, 1 + s * s * (tan(core) * c / s - 1), 1e-9);
    assert_near(number_of(&found, "fit_wedge_core_b1").value, c / s + (c * c + c * s / tan(core)) * less, 1e-9);
    assert_near(number_of(&found, "fit_wedge_core_a11").value, 1 + c * c, 1e-12);
    assert_near(number_of(&found, "fit_wedge_core_a22").value, s * s, 1e-12);
    assert_near(number_of(&found, "fit_wedge_core_a12").value, c * s, 1e-12);
    const measure_fit_number dip = number_of(&found, "fit_wedge_core_dip");
    assert_true(dip.value > 0.05 && dip.value < 0.25 && dip.low <= dip.value && dip.high >= dip.value);
    assert_true(number_of(&found, "fit_bcc_misfit").value > 0.02);
    assert_true(number_of(&found, "fit_bcc_information").value > number_of(&found, "fit_osl_information").value);
    assert_near(number_of(&found, "mohr_coulomb_flank").value, 0, 1e-4);
    assert_true(number_of(&found, "mohr_coulomb_axis").value < -0.5);
    assert_near(number_of(&found, "mohr_coulomb_flank_above").value, 0, 1e-4);
    assert_true(number_of(&found, "mohr_coulomb_axis_above").value < -0.5);
    // Of the OSL closure mu sigma_xy is left beside the axis, whose share goes with x.
    assert_near(number_of(&found, "stress_ratio_axis").value, 0.74, 0.02);
    forget(each, PILES, &found);
}

/// What is told of the cuts above the lowest one is the mean of their rows, by the half width at their height.
static void check_above(const measure_found *found)
{
    static const struct {
        const char *name, *lowest;
        double from, to;
    } of[] = {{"mohr_coulomb_axis_above", "mohr_coulomb_axis", 0, 0.1},
              {"mohr_coulomb_flank_above", "mohr_coulomb_flank", 0.5, 0.8}};
    for (int k = 0; k < 2; k++) {
        double sum = 0, count = 0;
        for (size_t i = 0; i < found->fits->rows; i++) {
            const measure_fit_row *row = &found->fits->row[i];
            const scree_stress_2d *s = &row->point.stress;
            const double place = row->point.x / (row->point.y / tan(SLOPE));
            if (row->cut == 0 || place < of[k].from || place > of[k].to) continue;
            sum += (pow(s->xx - s->yy, 2) + pow(2 * s->xy, 2)) / pow(sin(SLOPE) * (s->xx + s->yy), 2) - 1;
            count++;
        }
        assert_true(count > 3);
        assert_near(number_of(found, of[k].name).value, sum / count, 1e-9);
        assert_true(fabs(number_of(found, of[k].lowest).value - sum / count) > 1e-6);
    }
}

/// With noise the interval of the jackknife has eta in about 95 % of ensembles: 19 of 20, 15 or fewer in 0.03 %.
static void test_noise(void **state)
{
    (void)state;
    int covered = 0, honest = 0;
    for (uint64_t seed = 2; seed < 22; seed++) {
        measure_tables each[PILES];
        measure_found found;
        measure_plan plan;
        make(0.74, 0.03, seed, each, &found, &plan);
        const measure_fit_number eta = number_of(&found, "fit_osl_eta");
        covered += eta.low < 0.74 && eta.high > 0.74;
        check_above(&found);
        honest += eta.high - eta.low < 0.5;
        forget(each, PILES, &found);
    }
    assert_true(covered >= 16);
    assert_true(honest >= 18);
}

/// Piles with two slopes, 28 degrees left and 21 right, and the stress of the wedge with a dip about an apex that is
/// not the axis of the cuts: the wedge with the dip is found to have it, that with the peak is not; theories with one
/// slope are refused.
static void test_two_slopes(void **state)
{
    (void)state;
    const double left = 28 * M_PI / 180, right = 21 * M_PI / 180, apex = 0.01;
    measure_tables each[PILES];
    measure_found found = {.runs = PILES};
    measure_plan plan = {
        .average = {.cuts = CUTS, .points = POINTS}, .fit = {"wedge_dip", "wedge_peak"}, .fits = 2, .two_slopes = true};
    scree_error error;
    scree_fit truth;
    check(scree_fit_begin("wedge_dip", &truth, &error), &error);
    check(scree_fit_set(&truth, "weight", WEIGHT, true, &error), &error);
    check(scree_fit_set(&truth, "slope_left", left, false, &error), &error);
    check(scree_fit_set(&truth, "slope_right", right, false, &error), &error);
    for (uint64_t i = 0; i < PILES; i++) {
        each[i] = (measure_tables){0};
        scree_average_table *values = &each[i].of[MEASURE_VALUES], *cuts = &each[i].of[MEASURE_CUTS];
        check(scree_average_table_begin_row(values, &error), &error);
        scree_average_table_take(values, "element_side", "m", SIDE);
        scree_average_table_take(values, "triangle_height", "m", HEIGHT);
        scree_average_table_take(values, "triangle_slope", "degree", 24);
        scree_average_table_take(values, "triangle_slope_left", "degree", 28);
        scree_average_table_take(values, "triangle_slope_right", "degree", 21);
        scree_average_table_take(values, "triangle_apex", "m", apex);
        scree_average_table_take(values, "weight_density", "N/m3", WEIGHT);
        check(scree_average_table_end_row(values, &error), &error);
        for (uint64_t k = 0; k < CUTS * POINTS; k++) {
            const double x = ((double)(k % POINTS) / (POINTS / 2) - 1) * 0.25;
            const double y = 0.5 * SIDE + 0.2 * HEIGHT * (double)(k / POINTS);
            const double room = (HEIGHT - y - 0.5 * SIDE) / tan(x < apex ? left : right);
            const scree_fit_point point = {.x = x - apex, .y = HEIGHT - y};
            scree_stress_2d s;
            check(scree_fit_stress(&truth, 1, &point, &s, &error), &error);
            check(scree_average_table_begin_row(cuts, &error), &error);
            scree_average_table_take(cuts, "x", "m", x);
            scree_average_table_take(cuts, "y", "m", y);
            scree_average_table_take(cuts, "inside", "1", fabs(x - apex) + 0.5 * SIDE < room);
            const double noise = 1e-6 * WEIGHT * HEIGHT;
            const uint64_t number = 3 * (i * CUTS * POINTS + k);
            scree_average_table_take(cuts, "stress_xx", "Pa", -s.xx + noise * noise_of(number));
            scree_average_table_take(cuts, "stress_yy", "Pa", -s.yy + noise * noise_of(number + 1));
            scree_average_table_take(cuts, "stress_xy", "Pa", s.xy + noise * noise_of(number + 2));
            check(scree_average_table_end_row(cuts, &error), &error);
        }
    }
    for (int product = MEASURE_VALUES; product <= MEASURE_CUTS; product++) {
        scree_average_table same[PILES];
        for (int i = 0; i < PILES; i++) same[i] = each[i].of[product];
        check(scree_average_table_mean(same, PILES, &found.mean.of[product], NULL, NULL, &error), &error);
    }
    check(measure_fit(each, PILES, &plan, &found, &error), &error);
    assert_near(number_of(&found, "fit_wedge_dip_weight_ratio").value, 1, 1e-5);
    assert_near(number_of(&found, "fit_wedge_dip_core").value, 27.7, 0.1); // right side at 28 and 21 degrees
    assert_true(isnan(number_of(&found, "fit_wedge_dip_a1").value));
    assert_true(number_of(&found, "fit_wedge_dip_misfit").value < 1e-5);
    assert_true(number_of(&found, "fit_wedge_peak_misfit").value > 0.1);
    scree_release(&found.fits->row);
    scree_release(&found.fits);
    plan.fit[1] = "osl";
    assert_int_equal(measure_fit(each, PILES, &plan, &found, &error), SCREE_ERROR_INPUT);
    for (int i = 0; i < PILES; i++) measure_tables_destroy(&each[i]);
    measure_tables_destroy(&found.mean);
}

/// Place of the largest bend of a curve, from a column of the data of a chart, and the distance of its places.
static double find_bend(const char *text, int column, double *gap)
{
    enum { MOST = 1000 };
    double x[MOST], y[MOST], bend = 0, place = NAN;
    int rows = 0;
    for (const char *line = strchr(text, '\n') + 1; *line && rows < MOST; line = strchr(line, '\n') + 1) {
        const char *at = line;
        x[rows] = strtod(at, NULL);
        for (int k = 0; k < column; k++) at = strchr(at, ',') + 1;
        y[rows++] = strtod(at, NULL);
    }
    for (int k = 1; k + 1 < rows; k++) {
        const double here = fabs(y[k + 1] - 2 * y[k] + y[k - 1]);
        if (here > bend) bend = here, place = x[k];
    }
    *gap = x[1] - x[0];
    return place;
}

/// Seven theories are seven lines, the piles one more; the wedge bends where the boundary of its core, at its
/// angle to the axis, meets the cut.
static void test_figure(void **state)
{
    (void)state;
    scree_error error;
    measure_tables each[PILES];
    measure_found found;
    measure_plan plan;
    char name[PATH_MAX + 32];
    double gap;
    make(0.74, 1e-7, 1, each, &found, &plan);
    scree_release(&found.fits->row);
    scree_release(&found.fits);
    plan = (measure_plan){
        .average = plan.average,
        .fit = {"ife", "bcc", "osl", "wedge_dip", "wedge_smooth", "wedge_peak", "wedge_core"},
        .fits = 7,
    };
    check(measure_fit(each, PILES, &plan, &found, &error), &error);
    check(measure_fit_draw(scratch, &plan, found.fits, &error), &error);
    (void)snprintf(name, sizeof name, "%s/fits-vertical.csv", scratch);
    char *text = read_whole(name);
    assert_non_null(strstr(text, "\"ife\",\"bcc\",\"osl\",\"wedge dip\",\"wedge smooth\",\"wedge peak\",\"wedge core\","
                                 "\"distance from the axis (mm)\",\"piles, standard error\",low,high\n"));
    const double core = number_of(&found, "fit_wedge_core_core").value * M_PI / 180;
    const double place = 1e3 * (HEIGHT - 0.5 * SIDE) * tan(core), bend = find_bend(text, 7, &gap);
    // Chords from one measured place to the next would bend at these, 9 mm from one to the next.
    assert_true(gap > 0 && gap < 0.5);
    assert_near(bend, place, gap);
    free(text);
    forget(each, PILES, &found);
}

/// All cuts where they are few; of many seven, at distances that differ by one at most, from the first to the last.
static void test_spread(void **state)
{
    (void)state;
    for (size_t count = 1; count <= SCREE_AVERAGE_CUTS; count++) {
        const size_t lines = count < MEASURE_LINES ? count : MEASURE_LINES;
        size_t least = SIZE_MAX, most = 0;
        assert_int_equal(measure_spread(count, 0), 0);
        assert_int_equal(measure_spread(count, lines - 1), count - 1);
        for (size_t k = 1; k < lines; k++) {
            const size_t gap = measure_spread(count, k) - measure_spread(count, k - 1);
            least = gap < least ? gap : least;
            most = gap > most ? gap : most;
        }
        assert_true(lines < 2 || (least >= 1 && most - least <= 1));
    }
}

/// Where piles yield, of 13 cuts of which the last has no place within them.
static void test_yielding(void **state)
{
    (void)state;
    enum { ROWS = 36 };
    scree_error error;
    char name[PATH_MAX + 32];
    measure_fit_row row[ROWS];
    measure_fits fits = {.row = row, .rows = ROWS, .slope = {SLOPE, SLOPE}};
    measure_plan plan = {.average = {.cuts = 13, .points = POINTS}};
    for (size_t k = 0; k < 13; k++) plan.average.height[k] = 0.05 * (double)k;
    for (size_t k = 0; k < ROWS; k++)
        row[k] = (measure_fit_row){
            .cut = k / 3, .point = {.x = 0.01 * (double)(k % 3), .y = 0.1, .stress = {.xx = 1, .yy = 2, .xy = 0}}};
    check(measure_fit_draw(scratch, &plan, &fits, &error), &error);
    (void)snprintf(name, sizeof name, "%s/mohr-coulomb.csv", scratch);
    char *text = read_whole(name), heads[512] = "";
    for (const char *at = strstr(text, "\"height"); at; at = strstr(at + 1, "\"height"))
        (void)snprintf(heads + strlen(heads), sizeof heads - strlen(heads), "%.*s ", (int)strcspn(at + 8, "\""),
                       at + 8);
    // Of 12 the numbers 0, 2, 4, 6, 7, 9, 11.
    assert_string_equal(heads, "0 0.1 0.2 0.3 0.35 0.45 0.55 ");
    free(text);
    (void)snprintf(name, sizeof name, "%s/mohr-coulomb.gp", scratch);
    text = read_whole(name);
    assert_non_null(strstr(text, "(7 of 12 cuts)"));
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_exact),      cmocka_unit_test(test_noise),
                                       cmocka_unit_test(test_two_slopes), cmocka_unit_test(test_figure),
                                       cmocka_unit_test(test_spread),     cmocka_unit_test(test_yielding)};
    return cmocka_run_group_tests(tests, enter_scratch, leave_scratch);
}
