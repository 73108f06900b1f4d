/// Base: order-free sums, random numbers, memory, errors.

#include "testing.h"

#include "base/fixed.h"
#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <string.h>

/// Known answers of Philox 4x32-10, from the test vectors of Salmon et al. 2011 (Random123: kat_vectors).
static void philox_known_answers(void **unused)
{
    (void)unused;
    uint32_t words[4];
    scree_random_words(0, 0, 0, words);
    const uint32_t zero[4] = {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8};
    assert_memory_equal(words, zero, sizeof zero);
}

static void random_is_a_function_of_its_counter(void **unused)
{
    (void)unused;
    double sum = 0, square = 0;
    enum { COUNT = 20000 };
    for (uint64_t k = 0; k < COUNT; k++) {
        double u = scree_random_uniform(7, SCREE_RANDOM_TEST, k);
        assert_true(u >= 0 && u < 1);
        assert_true(u == scree_random_uniform(7, SCREE_RANDOM_TEST, k));
        double normal = scree_random_normal(7, SCREE_RANDOM_TEST, k);
        sum += u;
        square += normal * normal;
    }
    // Four standard errors of the mean of U(0,1) and of the variance of N(0,1).
    assert_true(fabs(sum / COUNT - 0.5) < 4 / sqrt(12.0 * COUNT));
    assert_true(fabs(square / COUNT - 1) < 4 * sqrt(2.0 / COUNT));
    assert_true(scree_random_uniform(7, 1, 0) != scree_random_uniform(8, 1, 0));
    assert_true(scree_random_uniform(7, 1, 0) != scree_random_uniform(7, 2, 0));
}

static void fixed_sum_is_free_of_order(void **unused)
{
    (void)unused;
    enum { COUNT = 1000 };
    double quantum = scree_fixed_quantum(3.0), inverse = 1 / quantum;
    int64_t forward = 0, backward = 0;
    long double exact = 0;
    for (int k = 0; k < COUNT; k++) {
        double f = 6 * scree_random_uniform(1, SCREE_RANDOM_TEST, (uint64_t)k) - 3;
        double b = 6 * scree_random_uniform(1, SCREE_RANDOM_TEST, (uint64_t)(COUNT - 1 - k)) - 3;
        forward += scree_fixed_from(f, inverse);
        backward += scree_fixed_from(b, inverse);
        exact += f;
        assert_int_equal(scree_fixed_from(-f, inverse), -scree_fixed_from(f, inverse));
    }
    assert_int_equal(forward, backward);
    // Half a quantum a term.
    assert_true(fabsl(scree_fixed_to(forward, quantum) - exact) <= 0.5 * COUNT * quantum);
    assert_true(quantum <= ldexp(3.0, -49) && quantum > ldexp(3.0, -51));
}

static void fixed_quantum_of_nothing(void **unused)
{
    (void)unused;
    double quantum = scree_fixed_quantum(0);
    assert_true(quantum > 0 && isfinite(1 / quantum));
    assert_int_equal(scree_fixed_from(0, 1 / quantum), 0);
}

static void memory_is_aligned_counted_and_can_fail(void **unused)
{
    (void)unused;
    scree_error error;
    size_t before, after;
    double *array;
    scree_allocation_statistics(&before, NULL);
    assert_int_equal(scree_allocate(&array, 100, sizeof *array, &error), SCREE_OK);
    assert_int_equal((uintptr_t)array % SCREE_ALIGNMENT, 0);
    for (int k = 0; k < 100; k++) assert_true(array[k] == 0);
    array[99] = 5;
    assert_int_equal(scree_reallocate(&array, 100, 200, sizeof *array, &error), SCREE_OK);
    assert_true(array[99] == 5 && array[199] == 0);
    scree_allocation_statistics(&after, NULL);
    assert_int_equal(after - before, 200 * sizeof *array);
    (void)scree_allocation_fail_after(1);
    assert_int_equal(scree_reallocate(&array, 200, 400, sizeof *array, &error), SCREE_ERROR_IO);
    assert_non_null(strstr(error.message, "3200 bytes"));
    assert_true(array[99] == 5);
    // A pointer that held nothing yet can be released after a failure.
    double *other = &array[7];
    (void)scree_allocation_fail_after(1);
    assert_int_equal(scree_allocate(&other, 1, sizeof *other, &error), SCREE_ERROR_IO);
    assert_null(other);
    (void)scree_allocation_fail_after(1);
    assert_int_equal(scree_memory_check(1000, &error), SCREE_ERROR_IO);
    assert_non_null(strstr(error.message, "1000 bytes"));
    (void)scree_allocation_fail_after(0);
    assert_int_equal(scree_memory_check(1000, &error), SCREE_OK);
    assert_int_equal(scree_allocate(&(void *){NULL}, SIZE_MAX, 8, &error), SCREE_ERROR_IO);
    scree_release(&array);
    assert_null(array);
    scree_allocation_statistics(&after, NULL);
    assert_int_equal(after, before);
}

static void refusals_have_a_key_and_what_is_accepted(void **unused)
{
    (void)unused;
    scree_error error;
    char text[200];
    assert_int_equal(scree_error_refuse(&error, "--at", "end, #N", "'%s' is no time", "now"), SCREE_ERROR_INPUT);
    scree_error_format(&error, text, sizeof text);
    assert_string_equal(text, "--at: 'now' is no time (accepted: end, #N)");
    assert_int_equal(scree_error_refuse(&error, NULL, NULL, "no"), SCREE_ERROR_INPUT);
    scree_error_format(&error, text, sizeof text);
    assert_string_equal(text, "no");
    assert_int_equal(scree_error_key(&error, SCREE_ERROR_INPUT, "walls.%d", 3), SCREE_ERROR_INPUT);
    assert_string_equal(error.field, "walls.3");
    assert_int_equal(scree_error_key(&error, SCREE_OK, "walls.%d", 4), SCREE_OK);
    assert_string_equal(error.field, "walls.3");
    assert_int_equal(scree_error_refuse(NULL, "--at", "end", "no"), SCREE_ERROR_INPUT);
}

static void error_text_has_position_field_and_range(void **unused)
{
    (void)unused;
    scree_error error;
    scree_error_set(&error, SCREE_ERROR_INPUT, "is %s", "negative");
    error.line = 3;
    error.column = 7;
    strcpy(error.file, "a.yaml");
    strcpy(error.field, "particles.radius_min");
    strcpy(error.accepted, "a positive length");
    char text[256];
    scree_error_format(&error, text, sizeof text);
    assert_string_equal(text, "a.yaml:3:7: particles.radius_min: is negative (accepted: a positive length)");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(philox_known_answers),
        cmocka_unit_test(random_is_a_function_of_its_counter),
        cmocka_unit_test(fixed_sum_is_free_of_order),
        cmocka_unit_test(fixed_quantum_of_nothing),
        cmocka_unit_test(memory_is_aligned_counted_and_can_fail),
        cmocka_unit_test(refusals_have_a_key_and_what_is_accepted),
        cmocka_unit_test(error_text_has_position_field_and_range),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
