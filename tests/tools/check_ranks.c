/// check_ranks SEED: terms of very different size, dealt out at random among the processes of mpirun (some get none),
/// give the bits that one process finds in all of them; rows that are dealt out in the same way come to those which
/// write them, in the order of their keys. Prints "ranks N" once; each difference is a line, and status 1.
#include "comm/guessed_sum.h"
#include "comm/ranges.h"
#include "comm/traffic.h"

#include <stdio.h>
#include <stdlib.h>

enum { TERMS = 5000, SUMS = 3 };

static int failures;

static void same(const char *what, double got, double wanted)
{
    if (memcmp(&got, &wanted, sizeof got) == 0 || (got != got && wanted != wanted)) return;
    printf("process %d: %s is %.17g, of one process %.17g\n", scree_comm_rank(), what, got, wanted);
    failures++;
}

/// The numbers of a generator that all processes share.
static uint64_t next(uint64_t *seed)
{
    *seed = *seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return *seed >> 20;
}

static double next_term(uint64_t *seed)
{
    const double sign = next(seed) % 2 ? 1 : -1;
    return sign * ldexp((double)next(seed), (int)(next(seed) % 120) - 100);
}

/// own: the terms of this process, of all terms; the last process is given none. Returns how many.
static size_t deal(uint64_t *seed, const double *all, double *own)
{
    const int most = scree_comm_size() > 2 ? scree_comm_size() - 1 : scree_comm_size();
    size_t count = 0;
    for (size_t k = 0; k < TERMS; k++)
        if ((int)(next(seed) % (uint64_t)most) == scree_comm_rank()) own[count++] = all[k];
    return count;
}

static void check_sums(const double *all, const double *own, size_t count)
{
    scree_integer_sum part[SUMS] = {0}, whole[SUMS] = {0};
    while (scree_comm_sum_next(NULL, part, SUMS))
        for (size_t k = 0; k < count; k++)
            for (int s = 0; s < SUMS; s++) scree_integer_sum_add(&part[s], own[k] * (s - 1.5));
    while (scree_integer_sum_next(whole, SUMS))
        for (size_t k = 0; k < TERMS; k++)
            for (int s = 0; s < SUMS; s++) scree_integer_sum_add(&whole[s], all[k] * (s - 1.5));
    for (int s = 0; s < SUMS; s++)
        same("a sum in two passes", scree_integer_sum_total(&part[s]), scree_integer_sum_total(&whole[s]));
    same("a sum of an array", scree_comm_sum_of(NULL, own, count), scree_integer_sum_of(all, TERMS));
}

/// Tensors, maxima and counts.
static void check_others(const double *all, const double *own, size_t count)
{
    scree_wide_sum part[2] = {0}, whole = {0};
    double got[9], wanted[9], largest = -INFINITY, of_all = -INFINITY;
    int64_t number[40] = {0};
    for (size_t k = 0; k < count; k++) {
        for (int i = 0; i < 9; i++) part[k % 2].value[i] += ((scree_wide_integer)(own[k] * 0x1p20) << 50) * (i - 4);
        largest = fmax(largest, own[k]);
        number[k % 40]++;
    }
    for (size_t k = 0; k < TERMS; k++) {
        for (int i = 0; i < 9; i++) whole.value[i] += ((scree_wide_integer)(all[k] * 0x1p20) << 50) * (i - 4);
        of_all = fmax(of_all, all[k]);
    }
    scree_comm_wide_total(NULL, part, 2, 0x1p-70, got);
    scree_wide_total(&whole, 1, 0x1p-70, wanted);
    for (int i = 0; i < 9; i++) same("a tensor", got[i], wanted[i]);
    scree_comm_add(NULL, number, 40);
    int64_t total = 0;
    for (int k = 0; k < 40; k++) total += number[k];
    same("a count", (double)total, TERMS);
    double values[3] = {largest, -(double)scree_comm_rank(), scree_comm_rank() == 0 ? NAN : 1};
    scree_comm_maximum(NULL, values, 3);
    same("a maximum", values[0], of_all);
    same("a maximum of numbers that are not positive", values[1] + 0.0, 0);
    same("a maximum with NaN", values[2], NAN);
}

/// Maxima, sums and wide sums in one message, at once or while other messages go; the next one is empty.
static void check_reduction(const double *own, size_t count, bool hidden)
{
    scree_reduction reduction = {0};
    double most[3] = {-INFINITY, -1, scree_comm_rank() == 0 ? NAN : 1}, alone[2] = {-INFINITY, -1};
    int64_t number[2] = {(int64_t)count, INT64_MAX}, counted = (int64_t)count;
    scree_wide_sum wide = {{0}};
    double total[9], wanted[9], boxes[SCREE_PROCESSES];
    for (size_t k = 0; k < count; k++) {
        most[0] = alone[0] = fmax(most[0], own[k]);
        for (int i = 0; i < 9; i++) wide.value[i] += ((scree_wide_integer)(own[k] * 0x1p20) << 50) * (i - 4);
    }
    scree_comm_wide_total(NULL, &wide, 1, 0x1p-70, wanted);
    scree_comm_maximum(NULL, alone, 2);
    scree_comm_add(NULL, &counted, 1);
    scree_reduction_add(&reduction, number, 2);
    scree_reduction_maximum(&reduction, most, 2);
    scree_reduction_add_wide(&reduction, wide.value, 9);
    scree_reduction_maximum(&reduction, &most[2], 1);
    if (hidden) {
        size_t counts[SCREE_PROCESSES];
        for (int r = 0; r < scree_comm_size(); r++) counts[r] = 1;
        const double rank = scree_comm_rank();
        scree_comm_join_begin(NULL, &reduction);
        scree_comm_gather(&rank, boxes, counts, sizeof rank);
        scree_comm_join_end(NULL, &reduction);
        for (int r = 0; r < scree_comm_size(); r++) same("a message meanwhile", boxes[r], r);
    } else
        scree_comm_join_numbers(NULL, &reduction);
    same("a maximum in a reduction", most[0], alone[0]);
    same("a negative maximum in a reduction", most[1], -1);
    same("a maximum with NaN in a reduction", most[2], NAN);
    same("a count in a reduction", (double)number[0], (double)counted);
    same("a sum modulo 2^64", (double)number[1], (double)(int64_t)(INT64_MAX * (uint64_t)scree_comm_size()));
    scree_wide_total(&wide, 1, 0x1p-70, total);
    for (int i = 0; i < 9; i++) same("a tensor in a reduction", total[i], wanted[i]);
    same("lists left in a reduction", (double)reduction.parts, 0);
}

/// A sum that is guessed: from nothing, from itself, from another one; how many reductions it takes.
static void check_guess(const double *all, const double *own, size_t count)
{
    double largest[2] = {0};
    const double factor[] = {1, 1, 1e7, 1e7};
    for (int time = 0; time < 4; time++) {
        scree_guessed_sum sum[2] = {{{0}, {0}}};
        scree_integer_sum whole = {0};
        const uint64_t before = scree_traffic_of(SCREE_TRAFFIC_REDUCTIONS).calls;
        while (scree_guessed_sum_next(NULL, sum, 2, largest))
            for (size_t k = 0; k < count; k++) {
                scree_guessed_sum_add(&sum[0], factor[time] * own[k]);
                scree_guessed_sum_add(&sum[1], own[k]);
            }
        while (scree_integer_sum_next(&whole, 1))
            for (size_t k = 0; k < TERMS; k++) scree_integer_sum_add(&whole, factor[time] * all[k]);
        same("a sum that was guessed", scree_guessed_sum_total(&sum[0]), scree_integer_sum_total(&whole));
        same("one beside it", scree_guessed_sum_total(&sum[1]), scree_integer_sum_of(all, TERMS));
        const uint64_t calls = scree_traffic_of(SCREE_TRAFFIC_REDUCTIONS).calls - before;
        same("reductions of a guess", (double)calls, scree_comm_size() > 1 ? 2 - time % 2 : 0);
    }
}

/// Of `count` rows with keys that ascend with holes each process has some, in no order, and one that it does not write.
static void check_route(uint64_t *seed, size_t count)
{
    static uint64_t all[TERMS], own[TERMS + 1], range[TERMS];
    const size_t size = (size_t)scree_comm_size(), ids = 3 * count + 1;
    scree_route route;
    size_t mine = 0;
    for (size_t k = 0; k < count; k++) all[k] = scree_route_key((uint32_t)(3 * (k / 2)), (uint32_t)(7 * k));
    for (size_t k = count; k-- > 0;)
        if (next(seed) % size == (size_t)scree_comm_rank()) own[mine++] = all[k];
    own[mine++] = SCREE_ROUTE_NONE;
    if (scree_route_open(&route, own, mine, ids, NULL) || scree_route_move(&route, own, range, sizeof *own, NULL)) {
        printf("no memory for a route\n");
        failures++;
        return;
    }
    same("the rows of all ranges", (double)route.total, (double)count);
    same("the begin of a range", (double)route.begin, (double)scree_range_begin(count, scree_comm_rank()));
    for (size_t k = 0; k < route.rows; k++) same("a row", (double)range[k], (double)all[route.begin + k]);
    int64_t rows = (int64_t)route.rows;
    scree_comm_add(NULL, &rows, 1);
    same("the sum of all ranges", (double)rows, (double)count);
    scree_route_close(&route);
}

int main(int argc, char **argv)
{
    static double all[TERMS], own[TERMS];
    scree_error error;
    uint64_t seed = argc > 1 ? strtoull(argv[1], NULL, 10) : 1;
    if (scree_comm_join(&error)) return 1;
    for (size_t k = 0; k < TERMS; k++) all[k] = next_term(&seed);
    size_t count = deal(&seed, all, own);
    if (scree_comm_rank() == 0) printf("ranks %d\n", scree_comm_size());
    check_sums(all, own, count);
    check_others(all, own, count);
    check_reduction(own, count, false);
    check_reduction(own, count, true);
    check_guess(all, own, count);
    check_route(&seed, TERMS);
    check_route(&seed, 3);
    check_route(&seed, 0);
    // One term that is not finite, of one process, spoils the sum of all.
    if (count > 0 && scree_comm_rank() == 0) own[0] = NAN;
    same("a sum with NaN", scree_comm_sum_of(NULL, own, count), NAN);
    scree_guessed_sum guessed = {{0}, {0}};
    double largest = 0;
    while (scree_guessed_sum_next(NULL, &guessed, 1, &largest))
        for (size_t k = 0; k < count; k++) scree_guessed_sum_add(&guessed, own[k]);
    same("a guessed sum with NaN", scree_guessed_sum_total(&guessed), NAN);
    scree_comm_leave();
    return failures > 0;
}
