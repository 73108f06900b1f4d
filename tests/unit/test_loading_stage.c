/// The loading stage of a run and its peak: found by rows, and the same one in summary, figures and cells.
#include "io_scratch.h"
#include "run_fixture.h"

#include "io/loading_stage.h"

/// Two loadings of the same kind, the first one further than the second, and a confinement afterwards.
static const char case_text[] =
    "scree: 1\n"
    "seed: 3\n"
    "materials:\n"
    "  - {name: quartz, young_modulus: 30 GPa, density: 2.675e8 kg/m3, friction: 0.45, restitution: 0.2}\n"
    "particles: {material: quartz, count: 40, radius_min: 0.5 mm, radius_max: 1 mm}\n"
    "contact: {law: hertz_mindlin}\n"
    "integrator: {step: 2e-5 s}\n"
    "measure: {samples: 20, band_window: 0.05 %}\n"
    "output: {snapshots: 4, paraview: no}\n"
    "stages:\n"
    "  - {stage: prepare, aspect_ratio: 1.5}\n"
    "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 0.2}\n"
    "  - {stage: compress, strain: 0.5 %, rate: 0.2 1/s}\n"
    "  - {stage: compress, strain: 0.2 %, rate: 0.2 1/s}\n"
    "  - {stage: confine, pressure: 100 kPa, unbalanced_limit: 0.5}\n";

static double value_of(const char *name)
{
    char text[64];
    scree_error error;
    check(scree_result_get(scratch, name, text, sizeof text, &error), &error);
    return strtod(text, NULL);
}

static void read_table(const char *name, scree_series *series)
{
    char path[128];
    scree_error error;
    (void)snprintf(path, sizeof path, "%s/%s", scratch, name);
    check(scree_series_read(series, path, &error), &error);
}

/// Rows of the data of a chart; *last: the strain of the last one.
static size_t chart_rows(const char *name, double *last)
{
    char path[128], line[256];
    size_t rows = 0;
    (void)snprintf(path, sizeof path, "%s/figures/%s.csv", scratch, name);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) rows += sscanf(line, "%lf,", last) == 1;
    fclose(file);
    return rows;
}

/// The peak of the summary is marked on the chart of its curve; nine digits, percent.
static void expect_peak_marked(scree_peak peak)
{
    char path[128], line[256];
    double strain = NAN, value = NAN;
    (void)snprintf(path, sizeof path, "%s/figures/stress-ratio.csv", scratch);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    assert_non_null(strstr(line, "peak of the mean over 1 %: "));
    assert_non_null(strstr(line, "with friction at plates"));
    assert_int_equal(fscanf(file, "%*[^,],%*[^,],%*[^,],%lf,%lf", &strain, &value), 2);
    fclose(file);
    assert_true(fabs(strain - 100 * peak.strain) < 1e-7 && fabs(value - peak.value) < 1e-7);
}

static void expect_bands_of_one_stage_each(void)
{
    scree_series bands = {0};
    read_table(SCREE_FILE_BANDS, &bands);
    const double *from = scree_series_get(&bands, "from_strain"), *to = scree_series_get(&bands, "to_strain");
    size_t begins = 0;
    for (size_t k = 0; k < bands.row_count; k++) begins += from[k] == 0;
    // Both stages have windows, from their begins on.
    assert_int_equal(begins, 2);
    // The last one of the second, which ends at 0.2 %.
    assert_true(to[bands.row_count - 1] > 1e-3 && to[bands.row_count - 1] < 2.01e-3);
    scree_series_destroy(&bands);
}

static void all_results_are_of_one_stage(void **unused)
{
    (void)unused;
    scree_error error;
    scree_series series = {0};
    scree_case *c = case_read(case_text, NULL, 0);
    scree_run_options options = {.output = scratch, .threads = 1, .force = true, .figures = true};
    check(scree_run(c, &options, &error), &error);
    read_table(SCREE_FILE_SERIES, &series);
    scree_loading_rows rows = scree_loading_rows_find(&series);
    const double *stage = scree_series_get(&series, "stage"), *strain = scree_series_get(&series, "axial_strain");
    assert_true(stage[rows.first] == 3 && stage[rows.last - 1] == 3 && stage[series.row_count - 1] == 4);
    assert_true(strain[rows.first] == 0 && rows.last - rows.first > 20);

    // The peak is of all of them.
    const scree_loading_path path = scree_loading_path_find(&series);
    const double *axial = scree_series_get(&series, "strain_yy");
    assert_true(path.label && !path.sheared && path.strain == axial && path.rows.last == rows.last);
    assert_true(stage[path.rows.first] == 2 && axial[path.rows.first] == 0 && path.rows.first < rows.first);
    scree_peak peak = scree_peak_find(scree_series_get(&series, "stress_ratio"), path.strain, path.rows);
    assert_true(value_of("axial_strain") == strain[rows.last - 1]);
    assert_true(value_of("peak_stress_ratio") == peak.value && value_of("strain_at_peak") == peak.strain);
    // The cost of a stage is not kept once another one has begun.
    char none[32];
    assert_int_equal(scree_result_get(scratch, "loading_wall_time", none, sizeof none, &error), SCREE_ERROR_INPUT);

    double last;
    assert_int_equal(chart_rows("stress-ratio", &last), path.rows.last - path.rows.first);
    // Percent, of nine digits.
    assert_true(fabs(last - 100 * axial[rows.last - 1]) < 1e-7);
    expect_peak_marked(peak);
    expect_bands_of_one_stage_each();
    scree_series_destroy(&series);
    scree_case_free(c);
}

/// A series in memory.
static scree_series series_of(double *stage, double *strain, size_t rows)
{
    static char *names[] = {"stage", "axial_strain"};
    static double *values[2];
    values[0] = stage;
    values[1] = strain;
    return (scree_series){.column_count = 2, .row_count = rows, .name = names, .value = values};
}

static void rows_are_those_of_the_last_strain(void **unused)
{
    (void)unused;
    double stage[] = {1, 2, 2, 2, 3, 3, 4, 4}, strain[] = {NAN, 0, 0.1, 0.2, 0, 0.1, NAN, NAN};
    const size_t expected[][3] = {{8, 4, 6}, {6, 4, 6}, {5, 4, 5}, {4, 1, 4}, {1, 0, 0}, {0, 0, 0}};
    for (size_t k = 0; k < sizeof expected / sizeof *expected; k++) {
        scree_series series = series_of(stage, strain, expected[k][0]);
        scree_loading_rows rows = scree_loading_rows_find(&series);
        assert_int_equal(rows.first, expected[k][1]);
        assert_int_equal(rows.last, expected[k][2]);
    }
    assert_true(scree_snapshot_begins_stage("confine", "compress", 0.1));
    assert_true(scree_snapshot_begins_stage("compress", "compress", 0));
    assert_false(scree_snapshot_begins_stage("compress", "compress", 0.1));
}

static void peaks_are_of_the_running_mean(void **unused)
{
    (void)unused;
    // A row every 0.2 %: five in the window. One spike weighs less than a hump of five rows.
    enum { ROWS = 40 };
    double ratio[ROWS], strain[ROWS];
    for (int k = 0; k < ROWS; k++) {
        strain[k] = k / 500.0;
        ratio[k] = k == 30 ? 4 : k >= 10 && k < 15 ? 2 : 1;
    }
    scree_peak peak = scree_peak_find(ratio, strain, (scree_loading_rows){0, ROWS});
    assert_true(peak.value == 2 && peak.strain == strain[12]);
    // Rows outside of the stage do not count, and at its ends the window has fewer rows.
    peak = scree_peak_find(ratio, strain, (scree_loading_rows){14, 25});
    assert_true(peak.value == (2 + 1 + 1) / 3.0 && peak.strain == strain[14]);
    // Extension: the same backwards.
    for (int k = 0; k < ROWS; k++) strain[k] = -strain[k];
    peak = scree_peak_find(ratio, strain, (scree_loading_rows){0, ROWS});
    assert_true(peak.value == 2 && peak.strain == strain[12]);
    for (int k = 0; k < ROWS; k++) ratio[k] = NAN;
    peak = scree_peak_find(ratio, strain, (scree_loading_rows){0, ROWS});
    assert_true(isnan(peak.value) && isnan(peak.strain));
}

static void cycles_have_no_peak(void **unused)
{
    (void)unused;
    // Up by 0.9 %, down, and so on: no branch is as wide as the window.
    enum { ROWS = 40 };
    double ratio[ROWS], strain[ROWS];
    for (int k = 0; k < ROWS; k++) {
        const int step = k % 18;
        strain[k] = (step <= 9 ? step : 18 - step) / 1000.0;
        ratio[k] = 1 + 100 * strain[k];
    }
    scree_peak peak = scree_peak_find(ratio, strain, (scree_loading_rows){0, ROWS});
    assert_true(isnan(peak.value) && isnan(peak.strain));
    // A loop of unloading on the way: rows beyond its turns do not mix with those before.
    for (int k = 0; k < ROWS; k++) {
        strain[k] = (k < 20 ? k : k < 24 ? 38 - k : k - 9) / 500.0;
        ratio[k] = k < 20 ? 2 : k < 23 ? 50 : 1;
    }
    peak = scree_peak_find(ratio, strain, (scree_loading_rows){0, ROWS});
    assert_true(peak.value == 2 && peak.strain == strain[0]);
    // Less than the turn: the strain of a servo goes back and forth by as little.
    for (int k = 0; k < ROWS; k++) {
        strain[k] = k / 500.0 - (k % 2 ? 0.00209 : 0);
        ratio[k] = k == 20 ? 3 : 1;
    }
    peak = scree_peak_find(ratio, strain, (scree_loading_rows){0, ROWS});
    assert_true(peak.value > 1 && peak.value < 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(all_results_are_of_one_stage, make_scratch, remove_scratch),
        cmocka_unit_test(rows_are_those_of_the_last_strain),
        cmocka_unit_test(peaks_are_of_the_running_mean),
        cmocka_unit_test(cycles_have_no_peak),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
