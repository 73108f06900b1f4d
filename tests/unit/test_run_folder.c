/// The list of a run folder's files, what --force removes by it, and the lock on the folder.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "io/manifest.h"
#include "io/run_directory.h"
#include "io/summary.h"
#include "io_scratch.h"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

static void put(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static bool exists(const char *path)
{
    struct stat information;
    return lstat(path, &information) == 0;
}

/// A file that Scree replaces as a whole.
static void write_file(const char *path)
{
    FILE *file;
    scree_error error;
    assert_int_equal(scree_replace_begin(path, &file, &error), SCREE_OK);
    assert_int_equal(scree_replace_finish(path, file, true, &error), SCREE_OK);
}

static void test_force_removes_what_is_listed(void **state)
{
    (void)state;
    scree_error error;
    assert_int_equal(scree_run_directory_create("out", false, &error), SCREE_OK);
    static const char *const own[] = {"out/case.yaml",         "out/run.h5",          "out/rotation-rose.csv",
                                      "out/figures/chart.csv", "out/figures/map.svg", "out/paraview/a.vtp",
                                      "out/anything at all"};
    // Beside them: halves of a replacement, a chart's figures (made by gnuplot), parts with their numbers.
    static const char *const made[] = {"out/log.txt",       "out/run.h5.new",
                                       "out/figures/c.png", "out/figures/map.svg.new",
                                       "out/figures/c.gp",  "out/parts/snapshot-000001.h5",
                                       "out/series.csv",    "out/parts/checkpoint-1234567.h5.new"};
    static const char *const foreign[] = {"out/series.csv.backup",   "out/run.h5.mycopy",
                                          "out/figures/mine.png",    "out/figures/map.svg.old",
                                          "out/paraview/b.vtp",      "out/parts/snapshot-000001.h5.copy",
                                          "out/parts/snapshot-x.h5", "out/walls.csv"};
    for (size_t i = 0; i < sizeof own / sizeof *own; i++) write_file(own[i]);
    static const char *const endings[] = {".csv", ".gp", ".svg", ".png"};
    assert_int_equal(scree_manifest_add("out/figures/c", endings, 4, &error), SCREE_OK);
    for (size_t i = 0; i < sizeof made / sizeof *made; i++) put(made[i], "old");
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++) put(foreign[i], "mine");
    assert_int_equal(symlink("/etc/hostname", "out/figures/link.svg"), 0);
    assert_int_equal(scree_run_directory_create("out", true, &error), SCREE_OK);
    for (size_t i = 0; i < sizeof own / sizeof *own; i++) assert_false(exists(own[i]));
    for (size_t i = 0; i < sizeof made / sizeof *made; i++) assert_false(exists(made[i]));
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++) assert_true(exists(foreign[i]));
    assert_true(exists("out/figures/link.svg") && exists("out/parts") && exists("out/paraview"));
}

/// Without a list, a folder of an older version: its fixed names.
static void test_without_a_list_fixed_names_go(void **state)
{
    (void)state;
    scree_error error;
    assert_int_equal(mkdir("old", 0777) | mkdir("old/figures", 0777) | mkdir("old/parts", 0777), 0);
    static const char *const own[] = {"old/case.yaml", "old/summary.json",      "old/series.csv",
                                      "old/walls.csv", "old/run.h5.new",        "old/run.h5.whole",
                                      "old/log.txt",   "old/rotation-rose.csv", "old/parts/checkpoint-000003.h5"};
    static const char *const foreign[] = {"old/figures/stress_ratio.svg", "old/files.csv", "old/series.csv.backup"};
    for (size_t i = 0; i < sizeof own / sizeof *own; i++) put(own[i], "old");
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++) put(foreign[i], "mine");
    assert_int_equal(scree_run_directory_create("old", true, &error), SCREE_OK);
    assert_non_null(strstr(error.message, "1 in 'old/figures' and 0 in 'paraview' are left alone"));
    for (size_t i = 0; i < sizeof own / sizeof *own; i++) assert_false(exists(own[i]));
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++) assert_true(exists(foreign[i]));
}

/// A line that a full disk or a power cut has torn does not count and is not completed to another name.
static void test_torn_lists(void **state)
{
    (void)state;
    scree_error error;
    scree_manifest list;
    assert_int_equal(scree_run_directory_create("out", false, &error), SCREE_OK);
    FILE *file = fopen("out/files.txt", "a");
    assert_non_null(file);
    fputs("figures/mine.sv", file);
    fclose(file);
    write_file("out/figures/first.svg");
    write_file("out/figures/first.svg");
    int folder = open(".", O_RDONLY), out = open("out", O_RDONLY);
    assert_int_equal(scree_manifest_read(out, &list, &error), SCREE_OK);
    assert_true(scree_manifest_has(&list, "figures/first.svg") && scree_manifest_has(&list, "log.txt.new"));
    assert_false(scree_manifest_has(&list, "figures/mine.sv") || scree_manifest_has(&list, "log") ||
                 scree_manifest_has(&list, "first.svg"));
    const char *first = strstr(list.text, "figures/first.svg");
    assert_non_null(first);
    assert_null(strstr(first + 1, "figures/first.svg"));
    scree_manifest_destroy(&list);
    assert_int_equal(scree_manifest_read(folder, &list, &error), SCREE_OK);
    assert_false(list.there);
    close(out);
    close(folder);
}

/// No file before its name is on the disk.
static void test_no_name_no_file(void **state)
{
    (void)state;
    FILE *file;
    scree_error error;
    assert_int_equal(scree_run_directory_create("out", false, &error), SCREE_OK);
    assert_true(disk_limit((rlim_t)file_size("out/files.txt")));
    assert_int_equal(scree_replace_begin("out/figures/chart.svg", &file, &error), SCREE_ERROR_IO);
    assert_non_null(strstr(error.message, "out/files.txt"));
    assert_true(disk_limit(RLIM_INFINITY));
    assert_false(exists("out/figures/chart.svg.new"));
}

/// Names that lead out of the folder are nobody's.
static void test_strange_lists(void **state)
{
    (void)state;
    scree_error error;
    assert_int_equal(mkdir("elsewhere", 0777), 0);
    put("elsewhere/x", "mine");
    assert_int_equal(scree_run_directory_create("out", false, &error), SCREE_OK);
    assert_int_equal(mkdir("out/notes", 0777), 0);
    put("out/notes/x", "mine");
    put("out/files.txt", "# head\n../elsewhere/x\n\n.\n..\n/\nnotes/x\nfigures/../../elsewhere/x\nfigures/\nfigures\n");
    assert_int_equal(scree_run_directory_create("out", true, &error), SCREE_OK);
    assert_true(exists("elsewhere/x") && exists("out/notes/x"));
}

/// A run without a checkpoint has nothing to lose; one with a checkpoint, gathered or not, has.
static void test_what_has_begun_is_kept(void **state)
{
    (void)state;
    scree_error error;
    scree_summary *summary;
    assert_int_equal(scree_run_directory_create("out", false, &error), SCREE_OK);
    write_file("out/case.yaml");
    put("out/log.txt", "failed");
    assert_int_equal(scree_run_directory_create("out", false, &error), SCREE_OK);
    assert_non_null(strstr(error.message, "before its first checkpoint"));
    assert_false(exists("out/case.yaml"));
    put("out/parts/snapshot-000000.h5", "");
    put("out/run.h5", "");
    assert_int_equal(scree_summary_create(&summary, &error), SCREE_OK);
    scree_summary_set_text(summary, "status", "finishing");
    assert_int_equal(scree_summary_write(summary, "out/summary.json", &error), SCREE_OK);
    assert_int_equal(scree_run_directory_create("out", false, &error), SCREE_ERROR_INPUT);
    scree_summary_set_text(summary, "status", "stopped");
    assert_int_equal(scree_summary_write(summary, "out/summary.json", &error), SCREE_OK);
    scree_summary_destroy(summary);
    put("out/parts/checkpoint-000000.h5", "");
    assert_int_equal(scree_run_directory_create("out", false, &error), SCREE_ERROR_INPUT);
    assert_int_equal(unlink("out/parts/checkpoint-000000.h5"), 0);
    assert_int_equal(scree_run_directory_create("out", false, &error), SCREE_OK);
    put("out/run.h5", "gathered");
    assert_int_equal(scree_run_directory_create("out", false, &error), SCREE_ERROR_INPUT);
}

static void test_lock(void **state)
{
    (void)state;
    char who[400];
    scree_error error;
    scree_folder_lock lock, other;
    assert_int_equal(mkdir("out", 0777), 0);
    assert_false(scree_folder_lock_is_held("out", who, sizeof who));
    assert_int_equal(scree_folder_lock_take(&lock, "out", "the test", &error), SCREE_OK);
    assert_int_equal(scree_folder_lock_take(&other, "out", "another", &error), SCREE_ERROR_INPUT);
    char holder[64];
    (void)snprintf(holder, sizeof holder, "in use by the test, process %ld on host", (long)getpid());
    assert_non_null(strstr(error.message, holder));
    scree_folder_lock_release(&other);
    assert_true(scree_folder_lock_is_held("out", who, sizeof who));
    assert_memory_equal(who, "the test, process", 17);
    scree_folder_lock_release(&lock);
    scree_folder_lock_release(&lock);
    assert_false(exists("out/" SCREE_FILE_LOCK));
    assert_int_equal(scree_folder_lock_take(&lock, "nowhere", "the test", &error), SCREE_ERROR_INPUT);
}

/// The file of a killed process stays and locks nobody out. A program that is started does not inherit the lock.
static void test_lock_dies_with_its_process(void **state)
{
    (void)state;
    scree_error error;
    scree_folder_lock lock;
    int ready[2];
    assert_int_equal(mkdir("out", 0777) | pipe(ready), 0);
    pid_t child = fork();
    if (child == 0) {
        bool good = scree_folder_lock_take(&lock, "out", "the child", &error) == SCREE_OK;
        // Has the lock's descriptor gone with the exec? This one outlives its parent.
        if (good && fork() == 0) {
            close(ready[0]);
            if (write(ready[1], "x", 1) != 1) _exit(1);
            close(ready[1]);
            execlp("sleep", "sleep", "3", (char *)NULL);
            _exit(1);
        }
        for (;;) pause();
    }
    char byte;
    assert_int_equal(read(ready[0], &byte, 1), 1);
    assert_int_equal(scree_folder_lock_take(&lock, "out", "the test", &error), SCREE_ERROR_INPUT);
    assert_int_equal(kill(child, SIGKILL), 0);
    assert_int_equal(waitpid(child, NULL, 0), child);
    assert_true(exists("out/" SCREE_FILE_LOCK));
    scree_status status = SCREE_ERROR_INPUT;
    // The grandchild may still be between fork and exec.
    for (int k = 0; k < 100 && status; k++) status = scree_folder_lock_take(&lock, "out", "the test", &error);
    assert_int_equal(status, SCREE_OK);
    scree_folder_lock_release(&lock);
    close(ready[0]);
    close(ready[1]);
}

/// Many come and go: never two at the same time.
static void test_lock_under_contention(void **state)
{
    (void)state;
    enum { PROCESSES = 6, ROUNDS = 60 };
    assert_int_equal(mkdir("out", 0777), 0);
    for (int k = 0; k < PROCESSES; k++) {
        if (fork() != 0) continue;
        int bad = 0;
        for (int round = 0; round < ROUNDS && !bad; round++) {
            scree_folder_lock lock;
            if (scree_folder_lock_take(&lock, "out", "a child", NULL) == SCREE_OK) {
                bad = mkdir("out/alone", 0777) != 0 || rmdir("out/alone") != 0;
                scree_folder_lock_release(&lock);
            }
        }
        _exit(bad);
    }
    for (int k = 0; k < PROCESSES; k++) {
        int how;
        assert_true(wait(&how) > 0);
        assert_int_equal(how, 0);
    }
}

#define IN_SCRATCH(test) cmocka_unit_test_setup_teardown(test, enter_scratch, leave_scratch)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_SCRATCH(test_force_removes_what_is_listed),
        IN_SCRATCH(test_without_a_list_fixed_names_go),
        IN_SCRATCH(test_torn_lists),
        IN_SCRATCH(test_no_name_no_file),
        IN_SCRATCH(test_strange_lists),
        IN_SCRATCH(test_what_has_begun_is_kept),
        IN_SCRATCH(test_lock),
        IN_SCRATCH(test_lock_dies_with_its_process),
        IN_SCRATCH(test_lock_under_contention),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
