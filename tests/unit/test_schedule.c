/// Numbers that follow time: values, rates and integrals against closed forms and quadrature; keys that take them, with
/// what is wrong about them.
#include "testing.h"

#include "base/memory.h"
#include "base/schedule.h"
#include "case/document.h"
#include "module/key_rows.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// ---- functions of time -------------------------------------------------------------------------------------------

/// Rows of time, two values, and room for their integrals.
static double rows[3][5] = {{-1, 2, 0}, {1, 6, 0}, {4, 0, 9}};

static scree_schedule schedule_of(int form)
{
    scree_schedule_integrate_table(&rows[0][0], 3, 2);
    return (scree_schedule){.form = form,
                            .value = 2,
                            .change = -3,
                            .begin = 0.5,
                            .duration = 2,
                            .frequency = form == SCREE_SCHEDULE_HARMONIC ? 0.7 : 0,
                            .phase = 0.4,
                            .row = &rows[0][0],
                            .count = 3,
                            .columns = 2};
}

static void values_are_those_of_the_closed_forms(void **state)
{
    (void)state;
    scree_schedule s = schedule_of(SCREE_SCHEDULE_RAMP);
    assert_true(scree_schedule_at(&s, 0) == 2 && scree_schedule_at(&s, 1.5) == 0.5 && scree_schedule_at(&s, 9) == -1);
    s.form = SCREE_SCHEDULE_SMOOTH;
    assert_true(scree_schedule_at(&s, 0) == 2 && scree_schedule_at(&s, 1.5) == 0.5 && scree_schedule_at(&s, 9) == -1);
    assert_true(scree_schedule_rate(&s, 0.5) == 0 && scree_schedule_rate(&s, 2.5) == 0);
    s = schedule_of(SCREE_SCHEDULE_HARMONIC);
    assert_true(scree_schedule_at(&s, 0) == 2 - 3 * sin(0.4));
    s = schedule_of(SCREE_SCHEDULE_TABLE);
    assert_true(scree_schedule_at(&s, -5) == 2 && scree_schedule_at(&s, 0) == 4 && scree_schedule_at(&s, 1) == 6 &&
                scree_schedule_at(&s, 2.5) == 3 && scree_schedule_at(&s, 99) == 0);
    assert_true(scree_schedule_rate(&s, -2) == 0 && scree_schedule_rate(&s, 1) == -2 &&
                scree_schedule_rate(&s, 4) == 0);
    s.column = 1;
    assert_true(scree_schedule_at(&s, 2.5) == 4.5);
    s = (scree_schedule){0};
    assert_true(scree_schedule_at(&s, 3) == 0 && scree_schedule_is_constant(&s));
}

/// Differences of the integral are integrals of the value, those of the value integrals of the rate: Simpson's rule
/// over pieces of 2^-10 s whose ends meet all bends errs by the fourth derivative, below 1e-12 here. Bounds hold.
static void integrals_and_rates_belong_to_the_values(void **state)
{
    (void)state;
    const double h = 0x1p-10;
    for (int form = SCREE_SCHEDULE_CONSTANT; form <= SCREE_SCHEDULE_TABLE; form++) {
        scree_schedule s = schedule_of(form);
        assert_true(scree_schedule_integral(&s, 0) == 0);
        assert_int_equal(scree_schedule_is_constant(&s), form == SCREE_SCHEDULE_CONSTANT);
        for (double t = -2; t < 6; t += h) {
            double a = scree_schedule_at(&s, t), m = scree_schedule_at(&s, t + h / 2), b = scree_schedule_at(&s, t + h);
            double sum = h / 6 * (a + 4 * m + b);
            double whole = scree_schedule_integral(&s, t + h) - scree_schedule_integral(&s, t);
            if (!(fabs(sum - whole) < 1e-13)) fail_msg("form %d: integral at %g s: %g, %g", form, t, whole, sum);
            // The rate of the middle of a piece: a central difference errs by h^2 / 24 times the third derivative.
            double rate = scree_schedule_rate(&s, t + h / 2);
            if (!(fabs((b - a) / h - rate) < 2e-5)) fail_msg("form %d: rate at %g s", form, t);
            assert_true(fabs(a) <= scree_schedule_largest(&s) && fabs(rate) <= scree_schedule_largest_rate(&s));
        }
    }
}

// ---- keys --------------------------------------------------------------------------------------------------------

typedef struct values {
    scree_schedule speed, gravity[3];
} values;
static const scree_key keys[] = {
    SCHEDULE(values, speed, "m/s", .standard = "0 m/s", FROM("-10 m/s"), TO("10 m/s"), .meaning = "A velocity."),
    SCHEDULE(values, gravity, "m/s2", .standard = "[0, 0]", .components = 3, FROM("-100 m/s2"), TO("100 m/s2"),
             .meaning = "A vector."),
};
static const scree_section section = TABLE("values", "Values.", keys);

/// Where the table that a test writes lies.
static const char *folder(void)
{
    static char path[64];
    if (!path[0]) (void)snprintf(path, sizeof path, "schedule.%ld", (long)getpid());
    return path;
}

static scree_status read_values(const char *text, scree_arena *arena, values *v, scree_problems **problems)
{
    const scree_document document = {.section = &section, .name = "values.yaml", .text = text, .length = strlen(text)};
    return scree_document_read(&document, arena, v, sizeof *v, problems);
}

static values right(const char *text, scree_arena *arena)
{
    values v;
    scree_problems *problems;
    if (read_values(text, arena, &v, &problems)) fail_msg("%s: %s", text, scree_problems_get(problems, 0)->message);
    return v;
}

/// Refused with one problem, whose text holds `message`.
static void wrong(const char *text, const char *message)
{
    values v;
    char line[2048];
    scree_arena arena = {0};
    scree_problems *problems;
    assert_int_equal(read_values(text, &arena, &v, &problems), SCREE_ERROR_INPUT);
    scree_error_format(scree_problems_get(problems, 0), line, sizeof line);
    if (!strstr(line, message)) fail_msg("%s: expected \"%s\", got \"%s\"", text, message, line);
    if (scree_problems_count(problems) != 1) fail_msg("%s: more than one problem", text);
    scree_problems_free(problems);
    scree_arena_release(&arena);
}

static void every_form_of_a_key_is_read(void **state)
{
    (void)state;
    scree_arena arena = {0};
    values v = right("speed: 5 mm/s\n", &arena);
    assert_true(v.speed.form == SCREE_SCHEDULE_CONSTANT && v.speed.value == 5e-3 && v.gravity[2].value == 0);
    v = right("gravity: [1, -9810 mm/s2]\n", &arena);
    assert_true(v.gravity[0].value == 1 && v.gravity[1].value == -9.81 && v.gravity[2].value == 0);
    v = right("speed: [[0 s, 0 mm/s], [100 ms, 5 mm/s]]\ngravity: [[0, 0, -1], [2 s, 0, -3 m/s2]]\n", &arena);
    assert_true(fabs(scree_schedule_at(&v.speed, 0.05) - 2.5e-3) < 1e-18);
    assert_true(scree_schedule_at(&v.gravity[1], 1) == -2 && scree_schedule_at(&v.gravity[2], 1) == 0);
    assert_true(scree_schedule_integral(&v.gravity[1], 2) == -4);
    v = right("speed: {from: 1, to: 2 m/s, end: 4 s, smooth: yes}\n", &arena);
    assert_true(v.speed.form == SCREE_SCHEDULE_SMOOTH && scree_schedule_at(&v.speed, 2) == 1.5);
    v = right("speed: {amplitude: 1 mm/s, frequency: 50 1/s, phase: 90 degrees}\n", &arena);
    assert_true(fabs(scree_schedule_at(&v.speed, 0.01) + 1e-3) < 1e-15);
    scree_arena_release(&arena);
}

static void what_is_wrong_is_said_with_its_place(void **state)
{
    (void)state;
    wrong("speed: [[0, 0], [1 s, 1], [500 ms, 2]]\n", "values.yaml:1:28: speed: time must increase");
    wrong("speed: [[0, 0], [0 s, 1]]\n", "values.yaml:1:18: speed: time must increase");
    wrong("speed: [[0, 0], [1 s]]\n", "values.yaml:1:17: speed: expected a row of 2 values");
    wrong("speed: [[0], [1 s]]\n", "values.yaml:1:9: speed: expected rows of two values");
    wrong("speed: [[0, 0], [1 s, 20]]\n", "values.yaml:1:23: speed: '20' is too large");
    wrong("speed: [[0, 0], [1 m, 2]]\n", "values.yaml:1:18: speed");
    wrong("speed: [[0, 0], [1, nan]]\n", "values.yaml:1:21: speed");
    wrong("speed: [[0, 0], [1, [2]]]\n", "expected a number here");
    wrong("speed: []\n", "expected a value, or a table");
    wrong("speed:\n", "expected a value, or a table");
    wrong("gravity: 3\n", "expected a list of two values");
    wrong("gravity: [3]\n", "expected two or three values");
    wrong("gravity: [[0, 1]]\n", "expected rows of a time and two or three values");
    wrong("gravity: {from: 0, to: 1, end: 1}\n", "expected two or three values");
    wrong("speed: {from: 0, to: 1}\n", "expected a ramp");
    wrong("speed: {from: 0, to: 1, end: 1 s, mean: 0}\n", "expected a ramp");
    wrong("speed: {from: 0, to: 1, begin: 2 s, end: 1 s}\n", "must end after it begins");
    wrong("speed: {from: 0, to: 1, end: 1 s, smooth: maybe}\n", "`smooth` is yes or no");
    wrong("speed: {amplitud: 1, frequency: 1}\n", "did you mean 'amplitude'?");
    wrong("speed: {amplitude: 1, frequency: 0}\n", "too small");
}

/// A table in a file, which is removed again.
static void with_file(const char *bytes, size_t length, const char *message)
{
    char name[96], text[128];
    (void)snprintf(name, sizeof name, "%s.csv", folder());
    (void)snprintf(text, sizeof text, "speed: %s\n", name);
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
    scree_arena arena = {0};
    if (message) {
        wrong(text, message);
    } else {
        values v = right(text, &arena);
        assert_true(scree_schedule_at(&v.speed, 1) == 5e-3 && scree_schedule_at(&v.speed, 0.5) == 2.5e-3);
        assert_int_equal(v.speed.count, 3);
    }
    scree_arena_release(&arena);
    assert_int_equal(unlink(name), 0);
}

static void tables_may_lie_in_files(void **state)
{
    (void)state;
#define FILE_OF(text, message) with_file(text, sizeof(text) - 1, message)
    FILE_OF("0,0\n1,5e-3\n2,0\n", NULL);
    FILE_OF("# a gate\r\n\r\ntime [ms]; velocity [mm/s]\r\n0; 0\r\n1000; 5 # open\r\n2 s; 0 m/s", NULL);
    FILE_OF("velocity [mm/s], time [ms]\n0, 0\n5, 1000\n0, 2000\n", NULL);
    FILE_OF("velocity, t\n0,0\n", ".csv:1:1: speed: no column is named 'time'");
    FILE_OF("time, time\n0,0\n", ".csv:1:1: speed: two columns are named 'time'");
    FILE_OF("time, y, x\n0,0,0\n", ".csv:1:1: speed: x, y and z have to come in this order");
    FILE_OF("0,0\n# twice\n1,5\n1,6\n", ".csv:4:1: speed: time must increase");
    FILE_OF("0,0\n1,  x\n", ".csv:2:5: speed");
    FILE_OF("0,0\n1\n", ".csv:2:1: speed: expected a row of 2 values");
    FILE_OF("0\n1\n", ".csv:1:1: speed: expected rows of two values");
    FILE_OF("time [m],v\n0,0\n", ".csv:2:1: speed");
    FILE_OF("0,\n", ".csv:1:3: speed: expected a number");
    FILE_OF("0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16\n", "at most 16 values");
    FILE_OF("0,\0\n", "not a text file");
    FILE_OF("", "expected a value, or a table");
    wrong("speed: nowhere.csv\n", "values.yaml:1:8: speed: the file of this table cannot be used: No such file");
}

static void a_long_table_is_refused(void **state)
{
    (void)state;
    enum { ROWS = 2001, WIDTH = 8 };
    char *text = calloc(ROWS, WIDTH);
    size_t length = 0;
    for (int k = 0; k < ROWS; k++) length += (size_t)sprintf(text + length, "%d,1\n", k);
    with_file(text, length, "at most 2000 rows");
    free(text);
}

/// Every allocation fails once: an IO error, no crash, nothing leaked.
static void lost_memory_is_survived(void **state)
{
    (void)state;
    char name[96], text[160];
    (void)snprintf(name, sizeof name, "%s.csv", folder());
    (void)snprintf(text, sizeof text, "speed: %s\ngravity: [[0, 1, 2], [1, 2, 3]]\n", name);
    FILE *file = fopen(name, "w");
    assert_true(fputs("time [ms],v [mm/s]\n0,1\n1000,2\n", file) >= 0 && fclose(file) == 0);
    scree_status status = SCREE_ERROR_IO;
    for (uint64_t n = 1; status == SCREE_ERROR_IO; n++) {
        values v;
        scree_arena arena = {0};
        scree_problems *problems;
        assert_true(n < 1000);
        scree_allocation_fail_after(n);
        status = read_values(text, &arena, &v, &problems);
        uint64_t made = scree_allocation_fail_after(0);
        assert_int_equal(status == SCREE_ERROR_IO, made >= n);
        scree_problems_free(problems);
        scree_arena_release(&arena);
    }
    assert_int_equal(status, SCREE_OK);
    assert_int_equal(unlink(name), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_those_of_the_closed_forms),
        cmocka_unit_test(integrals_and_rates_belong_to_the_values),
        cmocka_unit_test(every_form_of_a_key_is_read),
        cmocka_unit_test(what_is_wrong_is_said_with_its_place),
        cmocka_unit_test(tables_may_lie_in_files),
        cmocka_unit_test(a_long_table_is_refused),
        cmocka_unit_test(lost_memory_is_survived),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
