/// Run directory, replacement of files, series.csv, summary.json and named results.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/memory.h"
#include "io/manifest.h"
#include "io/run_directory.h"
#include "io/series.h"
#include "io/summary.h"
#include "io_scratch.h"

#include <scree/scree.h>

#include <limits.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

static void put(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void assert_text(const char *path, const char *expected)
{
    char text[4096] = "";
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    size_t got = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    text[got] = 0;
    assert_string_equal(text, expected);
}

static bool exists(const char *path)
{
    struct stat information;
    return lstat(path, &information) == 0;
}

/// Makes every write that would grow a file beyond `bytes` fail, as a full disk does. SIGXFSZ would end the process.
static void limit_file_size(rlim_t bytes)
{
    struct rlimit limit;
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    limit.rlim_cur = bytes;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
}

// ---- run directory -------------------------------------------------------------------------------------------------

static void test_directory_is_made_with_its_folders(void **state)
{
    (void)state;
    scree_error error;
    assert_int_equal(scree_run_directory_create("a/b/out", false, &error), SCREE_OK);
    assert_true(exists("a/b/out/figures") && exists("a/b/out/paraview") && exists("a/b/out/parts"));
    assert_int_equal(mkdir("empty", 0777), 0);
    assert_int_equal(scree_run_directory_create("empty/", false, &error), SCREE_OK);
}

static void test_directory_in_use_is_refused(void **state)
{
    (void)state;
    static const char *const marks[] = {"case.yaml", "summary.json", "series.csv", "run.h5", "log.txt"};
    for (size_t i = 0; i < sizeof marks / sizeof marks[0]; i++) {
        scree_error error;
        char folder[64], file[128];
        (void)snprintf(folder, sizeof folder, "run%zu", i);
        (void)snprintf(file, sizeof file, "%s/%s", folder, marks[i]);
        assert_int_equal(mkdir(folder, 0777), 0);
        put(file, "kept");
        assert_int_equal(scree_run_directory_create(folder, false, &error), SCREE_ERROR_INPUT);
        assert_non_null(strstr(error.message, folder));
        assert_non_null(strstr(error.message, "--force"));
        assert_text(file, "kept");
    }
}

static void test_folders_of_others_are_not_emptied(void **state)
{
    (void)state;
    scree_error error;
    // A folder `figures` without a run beside it is the user's.
    assert_int_equal(mkdir("paper", 0777) | mkdir("paper/figures", 0777), 0);
    put("paper/figures/mine.svg", "mine");
    assert_int_equal(scree_run_directory_create("paper", false, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "'figures'"));
    assert_int_equal(scree_run_directory_create("paper", true, &error), SCREE_OK);
    put("paper/case.yaml", "mine");
    assert_int_equal(scree_run_directory_create("paper", true, &error), SCREE_OK);
    assert_text("paper/figures/mine.svg", "mine");
    // A link to a folder in place of figures/ is not followed.
    assert_int_equal(mkdir("elsewhere", 0777) | mkdir("linked", 0777), 0);
    put("elsewhere/mine.svg", "mine");
    put("linked/log.txt", "old");
    assert_int_equal(symlink("../elsewhere", "linked/figures"), 0);
    assert_int_equal(scree_run_directory_create("linked", true, &error), SCREE_OK);
    put("elsewhere/listed.svg", "mine");
    assert_int_equal(scree_manifest_add("linked/figures/listed", &(const char *){".svg"}, 1, &error), SCREE_OK);
    assert_int_equal(scree_run_directory_create("linked", true, &error), SCREE_OK);
    assert_text("elsewhere/mine.svg", "mine");
    assert_text("elsewhere/listed.svg", "mine");
}

static void test_impossible_directories(void **state)
{
    (void)state;
    scree_error error;
    assert_int_equal(scree_run_directory_create("/", true, &error), SCREE_ERROR_INPUT);
    assert_int_equal(scree_run_directory_create("//.", true, &error), SCREE_ERROR_INPUT);
    assert_int_equal(scree_run_directory_create("", true, &error), SCREE_ERROR_INPUT);
    put("file", "mine");
    assert_int_equal(scree_run_directory_create("file", true, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "'file' is a file"));
    assert_int_equal(scree_run_directory_create("file/below", true, &error), SCREE_ERROR_INPUT);
    assert_text("file", "mine");
    assert_int_equal(scree_run_directory_create("/proc/scree/out", false, &error), SCREE_ERROR_IO);
    char name[PATH_MAX + 10];
    memset(name, 'x', sizeof name - 1);
    name[sizeof name - 1] = 0;
    assert_int_equal(scree_run_directory_create(name, false, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "the run's folder has"));
    name[300] = 0; // a component longer than file systems take
    assert_int_equal(scree_run_directory_create(name, false, &error), SCREE_ERROR_IO);
}

static void test_path_join(void **state)
{
    (void)state;
    char path[8];
    scree_error error;
    assert_int_equal(scree_path_join(path, sizeof path, "out", "abc", &error), SCREE_OK);
    assert_string_equal(path, "out/abc");
    assert_int_equal(scree_path_join(path, sizeof path, "out/", "abc", &error), SCREE_OK);
    assert_string_equal(path, "out/abc");
    assert_int_equal(scree_path_join(path, sizeof path, "", "abc", &error), SCREE_OK);
    assert_string_equal(path, "abc");
    assert_int_equal(scree_path_join(path, sizeof path, "out", "abcd", &error), SCREE_ERROR_INPUT);
}

// ---- replacement ---------------------------------------------------------------------------------------------------

static void test_replacement_is_whole(void **state)
{
    (void)state;
    scree_error error;
    FILE *file;
    put("data", "old");
    assert_int_equal(scree_replace_begin("data", &file, &error), SCREE_OK);
    fputs("new", file);
    fflush(file);
    assert_text("data", "old");
    assert_int_equal(scree_replace_finish("data", file, true, &error), SCREE_OK);
    assert_text("data", "new");
    assert_int_equal(scree_replace_begin("data", &file, &error), SCREE_OK);
    fputs("newer", file);
    assert_int_equal(scree_replace_finish("data", file, false, &error), SCREE_OK);
    assert_text("data", "new");
    assert_false(exists("data.new"));
    assert_int_equal(scree_replace_begin("nowhere/data", &file, &error), SCREE_ERROR_IO);
    assert_null(file);
}

static void test_replacement_on_a_full_disk(void **state)
{
    (void)state;
    scree_error error;
    FILE *file;
    put("data", "old");
    assert_int_equal(scree_replace_begin("data", &file, &error), SCREE_OK);
    limit_file_size(8192);
    for (int i = 0; i < 5000; i++) (void)fputs("filler", file);
    scree_status status = scree_replace_finish("data", file, true, &error);
    limit_file_size(RLIM_INFINITY);
    assert_int_equal(status, SCREE_ERROR_IO);
    assert_text("data", "old");
    assert_false(exists("data.new"));
}

// ---- series --------------------------------------------------------------------------------------------------------

static const scree_series_column columns[] = {
    {"time", "s", "time"}, {"axial_strain", "1", "strain"}, {"slip", "m/s", "mean slip speed"}};
enum { COLUMN_COUNT = 3 };

/// Row i of every series below; the second row has a value that does not exist.
static scree_status append_row(scree_series_writer *writer, int i, scree_error *error)
{
    return scree_series_append(writer, (double[]){i * 0.1, -i / 3.0, i == 1 ? -NAN : 1e-300 * i}, error);
}

static void write_series(const char *path, int rows)
{
    scree_series_writer writer;
    scree_error error;
    assert_int_equal(scree_series_open(&writer, path, columns, COLUMN_COUNT, -1, &error), SCREE_OK);
    for (int i = 0; i < rows; i++) assert_int_equal(append_row(&writer, i, &error), SCREE_OK);
    assert_int_equal(scree_series_close(&writer, &error), SCREE_OK);
}

static void test_series_round_trip(void **state)
{
    (void)state;
    scree_error error;
    scree_series series;
    write_series("series.csv", 4);
    assert_int_equal(scree_series_read(&series, "series.csv", &error), SCREE_OK);
    assert_int_equal(series.column_count, COLUMN_COUNT);
    assert_int_equal(series.row_count, 4);
    for (int i = 0; i < COLUMN_COUNT; i++) {
        assert_string_equal(series.name[i], columns[i].name);
        assert_string_equal(series.unit[i], columns[i].unit);
    }
    // 17 significant digits name each double: the comparison is exact.
    for (int i = 0; i < 4; i++) {
        assert_true(scree_series_get(&series, "time")[i] == i * 0.1);
        assert_true(scree_series_get(&series, "axial_strain")[i] == -i / 3.0);
    }
    assert_true(isnan(scree_series_get(&series, "slip")[1]));
    assert_true(scree_series_get(&series, "slip")[3] == 1e-300 * 3);
    assert_null(scree_series_get(&series, "absent"));
    scree_series_destroy(&series);
    write_series("short.csv", 2);
    assert_text("short.csv", "time [s],axial_strain [1],slip [m/s]\n0,0,0\n"
                             "0.10000000000000001,-0.33333333333333331,nan\n");
}

static void test_series_restart_cuts(void **state)
{
    (void)state;
    scree_error error;
    scree_series_writer writer;
    write_series("three.csv", 3);
    write_series("series.csv", 5);
    FILE *torn = fopen("series.csv", "a");
    fputs("0.5,-1.6", torn);
    fclose(torn);
    assert_int_equal(scree_series_open(&writer, "series.csv", columns, COLUMN_COUNT, 2, &error), SCREE_OK);
    assert_int_equal(append_row(&writer, 2, &error), SCREE_OK);
    assert_int_equal(scree_series_close(&writer, &error), SCREE_OK);
    assert_int_equal(system("cmp -s series.csv three.csv"), 0);
    assert_int_equal(scree_series_open(&writer, "series.csv", columns, COLUMN_COUNT, 0, &error), SCREE_OK);
    assert_int_equal(scree_series_close(&writer, &error), SCREE_OK);
    assert_text("series.csv", "time [s],axial_strain [1],slip [m/s]\n");
}

static void test_series_restart_refuses(void **state)
{
    (void)state;
    scree_error error;
    scree_series_writer writer;
    write_series("series.csv", 2);
    FILE *torn = fopen("series.csv", "a");
    fputs("0.5,-1.6,1", torn);
    fclose(torn);
    assert_int_equal(scree_series_open(&writer, "series.csv", columns, COLUMN_COUNT, 3, &error), SCREE_ERROR_IO);
    assert_null(writer.file);
    assert_non_null(strstr(error.message, "holds 2 rows"));
    assert_int_equal(scree_series_open(&writer, "series.csv", columns, 2, 1, &error), SCREE_ERROR_IO);
    assert_non_null(strstr(error.message, "other columns"));
    assert_int_equal(scree_series_open(&writer, "absent.csv", columns, COLUMN_COUNT, 0, &error), SCREE_ERROR_IO);
    assert_int_equal(scree_series_open(&writer, "nowhere/x.csv", columns, COLUMN_COUNT, -1, &error), SCREE_ERROR_IO);
}

static void test_series_reader_on_damaged_files(void **state)
{
    (void)state;
    scree_error error;
    scree_series series;
    put("torn.csv", "a [1],b [1]\n1,2\n3,");
    assert_int_equal(scree_series_read(&series, "torn.csv", &error), SCREE_OK);
    assert_int_equal(series.row_count, 1);
    scree_series_destroy(&series);
    static const char *const damaged[] = {"",
                                          "a [1],b [1]",
                                          "a,b\n1,2\n",
                                          "a [1],b [1]\n1,2,3\n",
                                          "[1]\n1\n",
                                          "a [1]\n\n5\n",
                                          "a [1],b [1]\n1,x\n",
                                          "a [1],b [1]\n1\n2,3\n",
                                          "a [1],\n1,2\n",
                                          "a [1\n5\n"};
    for (size_t i = 0; i < sizeof damaged / sizeof damaged[0]; i++) {
        put("damaged.csv", damaged[i]);
        assert_int_equal(scree_series_read(&series, "damaged.csv", &error), SCREE_ERROR_IO);
        assert_non_null(strstr(error.message, "damaged.csv"));
    }
    assert_int_equal(scree_series_read(&series, "absent.csv", &error), SCREE_ERROR_IO);
    assert_int_equal(scree_series_read(&series, ".", &error), SCREE_ERROR_IO);
}

static void test_series_row_on_a_full_disk(void **state)
{
    (void)state;
    scree_error error;
    scree_series_writer writer;
    write_series("one.csv", 1);
    assert_int_equal(scree_series_open(&writer, "series.csv", columns, COLUMN_COUNT, -1, &error), SCREE_OK);
    assert_int_equal(append_row(&writer, 0, &error), SCREE_OK);
    struct stat whole;
    assert_int_equal(stat("series.csv", &whole), 0);
    limit_file_size((rlim_t)whole.st_size + 3);
    scree_status status = append_row(&writer, 1, &error);
    limit_file_size(RLIM_INFINITY);
    assert_int_equal(status, SCREE_ERROR_IO);
    assert_int_equal(scree_series_close(&writer, &error), SCREE_OK);
    assert_int_equal(system("cmp -s series.csv one.csv"), 0);
}

static scree_status write_one_row(const char *path, scree_error *error)
{
    scree_series_writer writer;
    scree_status status = scree_series_open(&writer, path, columns, COLUMN_COUNT, -1, error);
    if (!status) status = append_row(&writer, 0, error);
    scree_error second;
    scree_status closed = scree_series_close(&writer, &second);
    return status ? status : closed;
}

static scree_status read_and_destroy(const char *path, scree_error *error)
{
    scree_series series;
    scree_status status = scree_series_read(&series, path, error);
    if (!status) scree_series_destroy(&series);
    return status;
}

/// Lets every allocation of `action` fail in turn: an error each time, and nothing is lost.
static void fail_every_allocation(scree_status (*action)(const char *path, scree_error *error), const char *path)
{
    size_t before, after;
    scree_status status = SCREE_ERROR_IO;
    scree_allocation_statistics(&before, NULL);
    for (uint64_t n = 1; status != SCREE_OK; n++) {
        scree_error error;
        scree_allocation_fail_after(n);
        status = action(path, &error);
        scree_allocation_fail_after(0);
        assert_true(status == SCREE_OK || (status == SCREE_ERROR_IO && strstr(error.message, "out of memory")));
        scree_allocation_statistics(&after, NULL);
        assert_int_equal(before, after);
        assert_true(n < 100);
    }
}

static void test_series_allocation_failures(void **state)
{
    (void)state;
    write_series("series.csv", 3);
    fail_every_allocation(read_and_destroy, "series.csv");
    fail_every_allocation(write_one_row, "other.csv");
}

// ---- summary and results -------------------------------------------------------------------------------------------

static void write_summary(const char *path)
{
    scree_summary *summary;
    scree_error error;
    assert_int_equal(scree_summary_create(&summary, &error), SCREE_OK);
    scree_summary_set_number(summary, "phi", 1.0);
    scree_summary_set_number(summary, "peak_stress_ratio", 0.1);
    scree_summary_set_integer(summary, "particles", INT64_C(9007199254740993));
    scree_summary_set_text(summary, "state_checksum", "00ff\"\\\xc3\xa9");
    scree_summary_set_number(summary, "absent", -NAN);
    scree_summary_set_number(summary, "infinite", INFINITY);
    scree_summary_set_text(summary, "path", "old\xe9");
    scree_summary_set_number(summary, "phi", 1.0 / 3.0);
    assert_int_equal(scree_summary_write(summary, path, &error), SCREE_OK);
    scree_summary_destroy(summary);
}

static void test_summary_text(void **state)
{
    (void)state;
    write_summary("summary.json");
    assert_text("summary.json", "{\n  \"phi\": 0.33333333333333331,\n  \"peak_stress_ratio\": 0.10000000000000001,\n"
                                "  \"particles\": 9007199254740993,\n  \"state_checksum\": \"00ff\\\"\\\\\xc3\xa9\",\n"
                                "  \"absent\": null,\n  \"infinite\": null,\n  \"path\": \"old?\"\n}\n");
}

static void test_summary_disk_errors(void **state)
{
    (void)state;
    scree_summary *summary;
    scree_error error;
    put("summary.json", "old");
    assert_int_equal(scree_summary_create(&summary, &error), SCREE_OK);
    for (int i = 0; i < 1000; i++) {
        char name[32];
        (void)snprintf(name, sizeof name, "value_%d", i);
        scree_summary_set_number(summary, name, i);
    }
    limit_file_size(5000);
    scree_status status = scree_summary_write(summary, "summary.json", &error);
    limit_file_size(RLIM_INFINITY);
    assert_int_equal(status, SCREE_ERROR_IO);
    assert_text("summary.json", "old");
    assert_false(exists("summary.json.new"));
    assert_int_equal(scree_summary_write(summary, "nowhere/summary.json", &error), SCREE_ERROR_IO);
    scree_summary_destroy(summary);
    scree_allocation_fail_after(1);
    assert_int_equal(scree_summary_create(&summary, &error), SCREE_ERROR_IO);
    scree_allocation_fail_after(0);
}

static void collect(void *user, const char *name, const char *value)
{
    char *text = user;
    strcat(strcat(strcat(strcat(text, name), "="), value), ";");
}

static void test_results(void **state)
{
    (void)state;
    scree_error error;
    char value[64], all[1024] = "";
    assert_int_equal(mkdir("out", 0777), 0);
    write_summary("out/summary.json");
    assert_int_equal(scree_result_get("out", "phi", value, sizeof value, &error), SCREE_OK);
    assert_true(strtod(value, NULL) == 1.0 / 3.0);
    assert_int_equal(scree_result_get("out", "peak_stress_ratio", value, sizeof value, &error), SCREE_OK);
    assert_string_equal(value, "0.1");
    assert_int_equal(scree_result_visit("out", collect, all, &error), SCREE_OK);
    assert_string_equal(all, "phi=0.3333333333333333;peak_stress_ratio=0.1;particles=9007199254740993;"
                             "state_checksum=00ff\"\\\xc3\xa9;absent=nan;infinite=nan;path=old?;");
    assert_int_equal(scree_result_get("out", "peak_stres_ratio", value, sizeof value, &error), SCREE_ERROR_INPUT);
    assert_string_equal(error.accepted, "peak_stress_ratio");
    assert_int_equal(scree_result_get("out", "wholly_unknown", value, sizeof value, &error), SCREE_ERROR_INPUT);
    assert_string_equal(error.accepted, "");
}

static void test_results_that_cannot_be_read(void **state)
{
    (void)state;
    scree_error error;
    char value[64];
    assert_int_equal(scree_result_get("absent", "phi", value, sizeof value, &error), SCREE_ERROR_IO);
    assert_non_null(strstr(error.message, "no run in 'absent'"));
    assert_int_equal(mkdir("out", 0777), 0);
    put("out/log.txt", "");
    assert_int_equal(scree_result_get("out", "phi", value, sizeof value, &error), SCREE_ERROR_IO);
    assert_non_null(strstr(error.message, "no results yet"));
    put("out/summary.json", "{\n  \"phi\": 0.1,\n  oops");
    assert_int_equal(scree_result_get("out", "phi", value, sizeof value, &error), SCREE_ERROR_IO);
    assert_string_equal(error.file, "out/summary.json");
    assert_int_equal(error.line, 3);
    put("out/summary.json", "[1, 2]");
    assert_int_equal(scree_result_visit("out", collect, NULL, &error), SCREE_ERROR_IO);
    assert_int_equal(scree_result_get("out", "phi", value, sizeof value, NULL), SCREE_ERROR_IO);
}

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, enter_scratch, leave_scratch)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(test_directory_is_made_with_its_folders),
        IN_SCRATCH(test_directory_in_use_is_refused),
        IN_SCRATCH(test_folders_of_others_are_not_emptied),
        IN_SCRATCH(test_impossible_directories),
        IN_SCRATCH(test_path_join),
        IN_SCRATCH(test_replacement_is_whole),
        IN_SCRATCH(test_replacement_on_a_full_disk),
        IN_SCRATCH(test_series_round_trip),
        IN_SCRATCH(test_series_restart_cuts),
        IN_SCRATCH(test_series_restart_refuses),
        IN_SCRATCH(test_series_reader_on_damaged_files),
        IN_SCRATCH(test_series_row_on_a_full_disk),
        IN_SCRATCH(test_series_allocation_failures),
        IN_SCRATCH(test_summary_text),
        IN_SCRATCH(test_summary_disk_errors),
        IN_SCRATCH(test_results),
        IN_SCRATCH(test_results_that_cannot_be_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
