/// What is read off the curves of a loading: curves by hand whose means, peaks and dips are known.
#include "io_scratch.h"
#include "testing.h"

#include "io/loading_stage.h"
#include "module/module.h"
#include "run/conclusion.h"

#include <math.h>

enum { ROWS = 101 };

static void first_peaks_are_followed_by_a_fall(void **unused)
{
    (void)unused;
    // Rises to 2, falls by 3 % of it, rises to 2.5, falls to 2: the first peak is 2.5, the dip a fifth.
    const double value[] = {-1, 0.01, 0, 1, 2, 1.94, 2.5, 2.4, 2, 2.1, 4},
                 strain[] = {0, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.09, 0.1};
    scree_first_peak peak = scree_first_peak_find(value, strain, (scree_loading_rows){0, 10}, 0.05);
    assert_true(peak.value == 2.5 && peak.strain == 0.06 && fabs(peak.dip - 0.2) < 1e-15);
    // What comes later is higher, but a first peak it is not.
    peak = scree_first_peak_find(value, strain, (scree_loading_rows){2, 11}, 0.05);
    assert_true(peak.value == 2.5 && peak.strain == 0.06);
    // A smaller fall is enough: 2.
    peak = scree_first_peak_find(value, strain, (scree_loading_rows){2, 11}, 0.02);
    assert_true(peak.value == 2 && peak.strain == 0.04 && fabs(peak.dip - 0.03) < 1e-12);
    // No fall: no peak; nothing above zero: none.
    peak = scree_first_peak_find(value, strain, (scree_loading_rows){2, 7}, 0.05);
    assert_true(isnan(peak.value) && isnan(peak.strain) && isnan(peak.dip));
    const double negative[] = {-1, -0.5, -0.7, -2};
    assert_true(isnan(scree_first_peak_find(negative, strain, (scree_loading_rows){0, 4}, 0.05).value));
}

static void maxima_stand_out_on_both_sides(void **unused)
{
    (void)unused;
    // Range 10: of the maxima 2, 9 and 4 the one of 2 has a fall of 0.4 behind it; the ends are none.
    const double value[] = {5, 0, 2, 1.6, 9, 3, 4, -1, 6};
    assert_int_equal(scree_maxima_count(value, (scree_loading_rows){0, 9}, 0.05), 2);
    assert_int_equal(scree_maxima_count(value, (scree_loading_rows){0, 9}, 0.03), 3);
    assert_int_equal(scree_maxima_count(value, (scree_loading_rows){0, 9}, 0.5), 1);
    assert_int_equal(scree_maxima_count(value, (scree_loading_rows){0, 1}, 0.05), 0);
}

static void two_maxima_stand_out_most(void **unused)
{
    (void)unused;
    // 2 has a fall of 0.4 beside it, 9 one of 6, 4 one of 1.
    const double value[] = {5, 0, 2, 1.6, 9, 3, 4, -1, 6};
    size_t row[2];
    assert_true(scree_maxima_most(value, (scree_loading_rows){0, 9}, row));
    assert_int_equal(row[0], 4);
    assert_int_equal(row[1], 6);
    assert_true(scree_maxima_most(value, (scree_loading_rows){0, 6}, row));
    assert_int_equal(row[0], 2);
    assert_int_equal(row[1], 4);
    assert_false(scree_maxima_most(value, (scree_loading_rows){3, 6}, row));
    assert_false(scree_maxima_most(value, (scree_loading_rows){8, 9}, row));
}

static double number(scree_summary *summary, const char *name)
{
    char path[128], text[64];
    scree_error error;
    (void)snprintf(path, sizeof path, "%s/summary.json", scratch);
    assert_int_equal(scree_summary_write(summary, path, NULL), SCREE_OK);
    check(scree_result_get(scratch, name, text, sizeof text, &error), &error);
    return strtod(text, NULL);
}

/// A stress ratio of 1 + strain; a volume that grows as a parabola and falls back, after a compaction.
static void results_are_those_of_the_curves(void **unused)
{
    (void)unused;
    static char *names[] = {"stage", "axial_strain", "stress_ratio", "volumetric_strain"};
    static double stage[ROWS], strain[ROWS], ratio[ROWS], volumetric[ROWS];
    double *values[] = {stage, strain, ratio, volumetric};
    for (int k = 0; k < ROWS; k++) {
        stage[k] = 2;
        strain[k] = k / 1000.0;
        ratio[k] = 1 + strain[k];
        volumetric[k] = pow(strain[k] - 0.06, 2) - 0.0016;
    }
    const scree_series series = {.column_count = 4, .row_count = ROWS, .name = names, .value = values};
    scree_summary *summary;
    assert_int_equal(scree_summary_create(&summary, NULL), SCREE_OK);
    const scree_conclusion run = {.directory = scratch, .series = &series, .summary = summary};
    assert_int_equal(scree_module_loading_curves.conclude(&run, NULL), SCREE_OK);
    assert_true(fabs(number(summary, "stress_ratio_at_begin") - 1.005) < 1e-12);
    assert_true(fabs(number(summary, "stress_ratio_second_half") - 1.075) < 1e-12);
    assert_true(fabs(number(summary, "strain_at_first_dilation_peak") - 0.06) < 1e-12);
    assert_true(fabs(number(summary, "first_dilation_peak") - 0.0016) < 1e-12);
    // (0.1 - 0.06)^2 / 0.0016: it falls back to zero.
    assert_true(fabs(number(summary, "dilation_dip") - 1) < 1e-9);
    assert_true(number(summary, "dilation_maxima") == 1);
    assert_true(isnan(number(summary, "strain_at_earlier_maximum")) &&
                isnan(number(summary, "strain_at_later_maximum")));
    scree_summary_destroy(summary);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(first_peaks_are_followed_by_a_fall),
        cmocka_unit_test(maxima_stand_out_on_both_sides),
        cmocka_unit_test(two_maxima_stand_out_most),
        cmocka_unit_test_setup_teardown(results_are_those_of_the_curves, make_scratch, remove_scratch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
