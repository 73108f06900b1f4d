/// Two ways to a sum that does not depend on the order of contacts, on synthetic forces of a triangular lattice:
/// integer rows (base/fixed.h: convert, add to both bodies) against one slot of doubles a contact and a gather in the
/// order of the neighbours. Prints nanoseconds a contact; best of five. Why the engine sums integers:
/// docs/performance.md.
#include "bench.h"

#include "base/fixed.h"
#include "base/memory.h"
#include "base/random.h"
#include "state/state.h"

#include <stdio.h>

enum { RUNS = 5 };

typedef struct lattice {
    size_t bodies, pairs;
    uint32_t *first, *second;
    double (*force)[4], (*slot)[4], (*total)[4]; ///< fx, fy, torque, 1
    scree_sum_row *sum;
    uint32_t *begin, *entry; ///< of each body: 2 x pair, + 1 when it is the second
} lattice;

static void add_pair(lattice *l, size_t a, size_t b)
{
    l->first[l->pairs] = (uint32_t)a;
    l->second[l->pairs] = (uint32_t)b;
    for (int k = 0; k < 4; k++)
        l->force[l->pairs][k] = scree_random_uniform(1, SCREE_RANDOM_TEST, 4 * l->pairs + (size_t)k) - 0.5;
    l->pairs++;
    l->begin[a + 1]++;
    l->begin[b + 1]++;
}

static scree_status create(lattice *l, size_t side, scree_error *error)
{
    *l = (lattice){.bodies = side * side};
    size_t most = 3 * l->bodies;
    scree_status status = scree_allocate(&l->first, most, sizeof *l->first, error);
    if (!status) status = scree_allocate(&l->second, most, sizeof *l->second, error);
    if (!status) status = scree_allocate(&l->force, most, sizeof *l->force, error);
    if (!status) status = scree_allocate(&l->slot, most, sizeof *l->slot, error);
    if (!status) status = scree_allocate(&l->total, l->bodies, sizeof *l->total, error);
    if (!status) status = scree_allocate(&l->sum, l->bodies, sizeof *l->sum, error);
    if (!status) status = scree_allocate(&l->begin, l->bodies + 2, sizeof *l->begin, error);
    if (!status) status = scree_allocate(&l->entry, 2 * most, sizeof *l->entry, error);
    if (status) return status;
    for (size_t j = 0; j < side; j++)
        for (size_t i = 0; i < side; i++) {
            size_t body = j * side + i, above = body + side, other = j % 2 ? i + 1 : i - 1;
            if (i + 1 < side) add_pair(l, body, body + 1);
            if (j + 1 < side) add_pair(l, body, above);
            if (j + 1 < side && other < side) add_pair(l, body, above - i + other);
        }
    // Entries of each body, in the order of the pairs.
    for (size_t k = 0; k < l->bodies; k++) l->begin[k + 1] += l->begin[k];
    for (size_t k = l->bodies + 1; k > 0; k--) l->begin[k] = l->begin[k - 1];
    for (size_t p = 0; p < l->pairs; p++) {
        l->entry[l->begin[l->first[p] + 1]++] = (uint32_t)(2 * p);
        l->entry[l->begin[l->second[p] + 1]++] = (uint32_t)(2 * p + 1);
    }
    return SCREE_OK;
}

static void destroy(lattice *l)
{
    void *const arrays[] = {&l->first, &l->second, &l->force, &l->slot, &l->total, &l->sum, &l->begin, &l->entry};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) scree_release(arrays[k]);
}

static void sum_integers(lattice *l, double inverse)
{
    memset(l->sum, 0, l->bodies * sizeof *l->sum);
    for (size_t p = 0; p < l->pairs; p++) {
        scree_sum_row *a = &l->sum[l->first[p]], *b = &l->sum[l->second[p]];
        int64_t x = scree_fixed_from(l->force[p][0], inverse), y = scree_fixed_from(l->force[p][1], inverse);
        int64_t t = scree_fixed_from(l->force[p][2], inverse);
        a->fx += x;
        a->fy += y;
        a->torque += t;
        a->contacts++;
        b->fx -= x;
        b->fy -= y;
        b->torque += t;
        b->contacts++;
    }
}

static void gather_slots(lattice *l, double inverse)
{
    for (size_t p = 0; p < l->pairs; p++)
        for (int k = 0; k < 4; k++) l->slot[p][k] = l->force[p][k] * inverse;
    for (size_t body = 0; body < l->bodies; body++) {
        double total[4] = {0};
        for (uint32_t e = l->begin[body]; e < l->begin[body + 1]; e++) {
            const double *slot = l->slot[l->entry[e] / 2];
            double sign = l->entry[e] % 2 ? -1 : 1;
            total[0] += sign * slot[0];
            total[1] += sign * slot[1];
            total[2] += slot[2];
            total[3] += 1;
        }
        memcpy(l->total[body], total, sizeof total);
    }
}

/// Largest difference of the two sums [quanta], a test that both ways do their work.
static double disagreement(const lattice *l)
{
    double largest = 0;
    for (size_t k = 0; k < l->bodies; k++) largest = fmax(largest, fabs(l->total[k][0] - (double)l->sum[k].fx));
    return largest;
}

/// Nanoseconds a contact, best of RUNS.
static double measure(lattice *l, void (*way)(lattice *, double inverse))
{
    double best = 1e9, inverse = 1 / scree_fixed_quantum(1.0);
    size_t rounds = 20000000 / l->pairs + 3;
    for (int run = 0; run < RUNS; run++) {
        double start = seconds(1);
        for (size_t r = 0; r < rounds; r++) way(l, inverse);
        double spent = 1e9 * (seconds(1) - start) / (double)(rounds * l->pairs);
        best = spent < best ? spent : best;
    }
    return best;
}

int main(void)
{
    const size_t sides[] = {63, 316, 1000};
    for (int k = 0; k < 3; k++) {
        lattice l;
        scree_error error;
        if (create(&l, sides[k], &error)) {
            fprintf(stderr, "%s\n", error.message);
            return 1;
        }
        double integers = measure(&l, sum_integers), slots = measure(&l, gather_slots);
        printf(
            "%8zu bodies, %.2f contacts each: integer rows %.2f ns a contact, slots and ordered gather %.2f ns (sums "
            "differ by %.2g quanta)\n",
            l.bodies, (double)l.pairs / (double)l.bodies, integers, slots, disagreement(&l));
        destroy(&l);
    }
    return 0;
}
