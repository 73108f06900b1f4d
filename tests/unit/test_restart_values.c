/// Values of a checkpoint that no run could have written, in files whose checksums are right: they are refused with
/// file, dataset, row and value; and whatever is not refused does no harm.
#include "run_fixture.h"

#include "base/memory.h"
#include "forged_part.h"
#include "io/run_file.h"
#include "io_scratch.h"
#include "restart_cases.h"
#include "run/restart.h"
#include "state/check.h"
#include "state/fields.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

enum { STEPS = 150, SEQUEL = 8 };

/// A checkpoint of case k in the scratch folder, STEPS steps into its last stage.
static scree_case *write_one(int k, uint64_t *checksum)
{
    scree_error error;
    scree_simulation s;
    scree_case *c = case_read(restart_cases[k], NULL, 0);
    check(scree_case_checksum(c, checksum, &error), &error);
    simulation_open(c, 1, &s);
    while (simulation_last_steps(&s) < STEPS) simulation_step(&s);
    check(scree_contacts_save(&s.state, &s.work, &error), &error);
    check(scree_checkpoint_write(scratch, &s.state, *checksum, &error), &error);
    scree_simulation_close(&s);
    return c;
}

/// The run of the state has written nothing else: a series with more rows than it knows of.
static scree_status restart_read(scree_simulation *s, uint64_t checksum, scree_error *error)
{
    scree_restart_point used;
    char path[96];
    (void)snprintf(path, sizeof path, "%s/series.csv", scratch);
    FILE *series = fopen(path, "w");
    assert_non_null(series);
    for (int k = 0; k < 1000; k++) assert_true(fputs("row\n", series) >= 0);
    assert_int_equal(fclose(series), 0);
    return scree_restart_read(s, scratch, NULL, checksum, &used, NULL, error);
}

/// Goes on from the state of `s`, whose values were accepted; any guard may stop it.
static void go_on(scree_simulation *s)
{
    scree_error error;
    if (scree_neighbours_refresh(&s->model, &s->state, &s->work, &error)) return;
    if (scree_stage_enter(s, true, &error)) return;
    for (int k = 0; k < SEQUEL && simulation_goes_on(s); k++)
        if (scree_simulation_step(s, &error)) return;
}

static const double reals[] = {(double)NAN, (double)INFINITY, -(double)INFINITY, -1, 0, 1e300, 7.5};
static const int64_t integers[] = {-1, INT64_MIN, INT64_MAX, INT32_MAX, 30, 2, 0};
enum { REALS = sizeof reals / sizeof *reals, INTEGERS = sizeof integers / sizeof *integers };

static bool is_real(const scree_field *field)
{
    return field->type == SCREE_FIELD_DOUBLE || field->type == SCREE_FIELD_FLOAT;
}

static void spoil(scree_state *state, const scree_field *field, size_t row, int component, int which)
{
    size_t size = scree_field_size(field->type);
    unsigned char *at = (unsigned char *)scree_field_get_mutable(state, field, row) + (size_t)component * size;
    float single = (float)reals[which % REALS];
    if (field->type == SCREE_FIELD_DOUBLE)
        memcpy(at, &reals[which], size);
    else if (field->type == SCREE_FIELD_FLOAT)
        memcpy(at, &single, size);
    else
        memcpy(at, &integers[which], size); // little-endian: the low bytes
}

/// What a process that has tried a value says of it by its exit status.
enum { ACCEPTED = 40, REFUSED, UNNAMED, LEFT };

/// In a process of its own: spoils one value of the state that was read, asks for it, and goes on if it is accepted.
/// Whoever goes on gives back all memory: `taken` is what was taken before the simulation was opened.
static int tell_of_one(scree_simulation *s, const scree_field *field, size_t row, int component, int which,
                       size_t taken)
{
    static const int signals[] = {SIGFPE, SIGILL, SIGSEGV, SIGBUS, SIGSYS}; // those that cmocka goes on after
    for (size_t k = 0; k < sizeof signals / sizeof *signals; k++) (void)signal(signals[k], SIG_DFL);
    scree_error error;
    size_t left;
    spoil(&s->state, field, row, component, which);
    bool accepted = scree_restart_check(s, &s->state, &error) == SCREE_OK;
    if (!accepted && !strstr(error.message, "dataset '")) return UNNAMED;
    if (accepted) go_on(s);
    scree_simulation_close(s);
    scree_allocation_statistics(&left, NULL);
    return left != taken ? LEFT : accepted ? ACCEPTED : REFUSED;
}

/// Spoils one value, of a copy of the process, so that the state need not be read again. Returns whether it was
/// accepted.
static bool try_one(scree_simulation *s, const scree_field *field, size_t row, int component, int which, size_t taken)
{
    if (strcmp(field->name, "id") == 0) return false; // looked at when it is read
    int status;
    (void)fflush(NULL);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) _exit(tell_of_one(s, field, row, component, which, taken));
    assert_int_equal(waitpid(child, &status, 0), child);
    if (!WIFEXITED(status)) fail_msg("%s, value %d: signal %d", field->name, which, WTERMSIG(status));
    if (WEXITSTATUS(status) == UNNAMED) fail_msg("%s, value %d: no dataset is named", field->name, which);
    if (WEXITSTATUS(status) == LEFT) fail_msg("%s, value %d: memory is not given back", field->name, which);
    assert_in_range(WEXITSTATUS(status), ACCEPTED, REFUSED);
    return WEXITSTATUS(status) == ACCEPTED;
}

/// Every kind of value, spoiled in its first, a middle and its last place.
static void no_value_does_harm(void **unused)
{
    (void)unused;
    for (int k = 0; k < RESTART_CASES; k++) {
        uint64_t checksum;
        int tried = 0, passed = 0;
        size_t taken;
        scree_error error;
        scree_simulation s;
        scree_case *c = write_one(k, &checksum);
        scree_allocation_statistics(&taken, NULL);
        simulation_open(c, 1, &s);
        check(restart_read(&s, checksum, &error), &error);
        for (size_t f = 0; f < scree_field_total(); f++) {
            const scree_field *field = scree_field_at(f);
            if (field->role != SCREE_FIELD_STATE || !scree_field_exists(field, s.state.dimension)) continue;
            size_t rows = scree_field_rows_count(&s.state, field);
            int components = scree_components(field->components, s.state.dimension);
            for (int which = 0; rows > 0 && which < (is_real(field) ? REALS : INTEGERS); which++) {
                size_t row = which % 3 == 0 ? 0 : which % 3 == 1 ? rows / 2 : rows - 1;
                bool accepted = try_one(&s, field, row, which % components, which, taken);
                bool number = !is_real(field) || field->range.undefined || which > 2;
                bool infinite = strcmp(field->name, "imposed_gradient/viscosity") == 0 && which == 1;
                if (accepted && !number && !infinite) fail_msg("%s may be %g", field->name, reals[which]);
                tried++;
                passed += accepted;
            }
        }
        print_message("%d of %d values are refused\n", tried - passed, tried);
        assert_true(tried > 500 && tried - passed > tried / 3);
        scree_simulation_close(&s);
        scree_case_free(c);
    }
}

static void a_forged_file_is_refused(void **unused)
{
    (void)unused;
    static const struct {
        const char *dataset;
        double value;
        const char *words;
    } forged[] = {
        {"radius", -0.001, "dataset 'radius', body "},
        {"radius", 0.001, "0.001 (accepted: more than 0, at most 0.0009"},
        {"mass", 0, ": 0 (accepted: finite, more than 0)"},
        {"material", 1, ": 1 (accepted: a whole number, at least 0, at most 0)"},
        {"material", 0.5, ": 0.5 (accepted"},
        {"position", (double)NAN, ": nan (accepted: at least -"},
        {"id", 30, "dataset 'id', row 0: 30 (accepted: ids below 30, each at most once)"},
        {"id", -1, "ids below 30, each at most once"},
        {"scalars/next_id", 29, "29 (accepted: ids below 29, each at most once)"},
        {"mark", 1, "dataset 'membrane/rest'"},
        {"mark", 9, "dataset 'mark', body 1: 9 (accepted: at least 0, at most 1)"},
        {"contacts/first", 4e6, "dataset 'contacts/first', contact 0: 4000000"},
        {"contacts/second", 2e9, "2000000000 is no body"},
        {"boundary/id", 31, "dataset 'boundary/id', row 0: 31"},
        {"walls/material", 3, "dataset 'walls/material', wall 0: 3"},
        {"imposed_gradient/prescribed", 3, "dataset 'imposed_gradient/prescribed': 3"},
        {"scalars/tick", 1e-5, "dataset 'scalars/tick'"},
        {"stage/index", 4, "dataset 'stage/index': 4 (accepted: at least 0, at most 3)"},
        {"stage/samples", -2, "dataset 'stage/samples': -2"},
    };
    char path[128], kept[144];
    uint64_t checksum;
    scree_case *c = write_one(0, &checksum);
    assert_int_equal(scree_part_path(scratch, SCREE_PART_CHECKPOINT, 0, path, sizeof path, NULL), SCREE_OK);
    (void)snprintf(kept, sizeof kept, "%s.kept", path);
    assert_int_equal(rename(path, kept), 0);
    for (size_t k = 0; k < sizeof forged / sizeof *forged; k++) {
        char copy[320];
        (void)snprintf(copy, sizeof copy, "cp %s %s", kept, path);
        assert_int_equal(system(copy), 0);
        assert_true(forge_part(path, 0, forged[k].dataset, 0, forged[k].value));
        scree_error error = {0};
        scree_simulation s;
        simulation_open(c, 1, &s);
        assert_int_equal(restart_read(&s, checksum, &error), SCREE_ERROR_IO);
        if (!strstr(error.message, forged[k].words) || !strstr(error.message, "checkpoint-000000.h5"))
            fail_msg("%s: '%s' does not hold '%s'", forged[k].dataset, error.message, forged[k].words);
        scree_simulation_close(&s);
    }
    scree_case_free(c);
}

#define WITH_SCRATCH(test) cmocka_unit_test_setup_teardown(test, make_scratch, remove_scratch)
int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_SCRATCH(no_value_does_harm),
        WITH_SCRATCH(a_forged_file_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
