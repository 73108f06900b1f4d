/// Sums of doubles that do not depend on the order of their terms: for everything that steers a run, or ends up in its
/// state, and is no sum of forces (those: base/fixed.h; tensors summed by several threads: base/wide_sum.h).
///
/// Method. As in fixed.h every term becomes a whole number of quanta and the numbers are added, here in 128 bits. The
/// quantum is a power of two, chosen from a bound of the magnitude of the terms so that no term exceeds 2^62 quanta.
/// The bound is a maximum and so as free of order as the sum. It is the largest magnitude among the terms themselves:
/// the terms are computed twice, first for the bound, then for the sum, by a loop that reads like a plain one,
///
///     scree_integer_sum mass = {0};
///     while (scree_integer_sum_next(&mass, 1))
///         for (size_t row = 0; row < state->count; row++) scree_integer_sum_add(&mass, state->row[row].mass);
///     return scree_integer_sum_total(&mass);
///
/// Sums over parts (threads, ranks) begin as copies of one sum after _next and are joined after their loops, in both
/// passes; the order and the number of parts do not show.
///
/// Error: half a quantum a term, at most 2^-62 of the largest term; terms above 2^-9 of the largest are exact. A double
/// sum loses up to 2^-53 of the whole sum with each term. Room: 2^64 terms. Nothing overflows silently: a term that is
/// not finite, or that the second pass finds beyond the bound, makes the total not a number.
/// Range: terms below 2^-1022 of 1 are lost. Cost: the terms twice, and some ten instructions a term.
#ifndef SCREE_BASE_INTEGER_SUM_H
#define SCREE_BASE_INTEGER_SUM_H

#include "base/wide_sum.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/// Most quanta of a term.
#define SCREE_INTEGER_SUM_MOST 0x1p62
/// The quantum and its inverse must both be normal numbers.
#define SCREE_INTEGER_SUM_LEAST_EXPONENT (-1020)

typedef enum scree_integer_sum_pass {
    SCREE_INTEGER_SUM_BEFORE,
    SCREE_INTEGER_SUM_LOOKS, ///< for the largest term
    SCREE_INTEGER_SUM_ADDS,
    SCREE_INTEGER_SUM_DONE
} scree_integer_sum_pass;

/// Begins with zeros.
typedef struct scree_integer_sum {
    scree_wide_integer quanta;
    double largest; ///< magnitude of the terms
    double quantum, inverse;
    scree_integer_sum_pass pass;
    bool spoiled; ///< a term was not finite or beyond the bound
} scree_integer_sum;

static inline double scree_integer_sum_power_of_two(int exponent)
{
    uint64_t bits = (uint64_t)(exponent + 1023) << 52;
    double power;
    memcpy(&power, &bits, sizeof power);
    return power;
}

/// Chooses the quantum for terms of at most this magnitude, 0 or more. From its bits: it happens some ten times a step.
static inline void scree_integer_sum_bound(scree_integer_sum *sum, double largest)
{
    uint64_t bits;
    memcpy(&bits, &largest, sizeof bits);
    // largest < 2^(exponent + 62)
    int exponent = (int)(bits >> 52) - 1022 - 62;
    if (exponent < SCREE_INTEGER_SUM_LEAST_EXPONENT) exponent = SCREE_INTEGER_SUM_LEAST_EXPONENT;
    sum->quantum = scree_integer_sum_power_of_two(exponent);
    sum->inverse = scree_integer_sum_power_of_two(-exponent);
}

/// Begins the next pass over the terms of `count` sums that are made in the same loop; false after the second.
static inline bool scree_integer_sum_next(scree_integer_sum *sum, int count)
{
    for (int k = 0; k < count; k++) {
        sum[k].pass++;
        if (sum[k].pass == SCREE_INTEGER_SUM_ADDS) scree_integer_sum_bound(&sum[k], sum[k].largest);
    }
    return sum[0].pass < SCREE_INTEGER_SUM_DONE;
}

static inline void scree_integer_sum_add(scree_integer_sum *sum, double term)
{
    if (sum->pass == SCREE_INTEGER_SUM_LOOKS) {
        sum->largest = fabs(term) > sum->largest ? fabs(term) : sum->largest;
        return;
    }
    double quanta = term * sum->inverse;
    if (fabs(quanta) <= SCREE_INTEGER_SUM_MOST)
        sum->quanta += llrint(quanta);
    else
        sum->spoiled = true;
}

/// Puts a part, begun as a copy of `sum` in this pass, into `sum`.
static inline void scree_integer_sum_join(scree_integer_sum *sum, const scree_integer_sum *part)
{
    sum->largest = part->largest > sum->largest ? part->largest : sum->largest;
    sum->quanta += part->quanta;
    sum->spoiled = sum->spoiled || part->spoiled;
}

/// The sum; not a number when a term was not.
static inline double scree_integer_sum_total(const scree_integer_sum *sum)
{
    return sum->spoiled ? (double)NAN : (double)sum->quanta * sum->quantum;
}

/// Adds terms that lie in an array, in the second pass: as scree_integer_sum_add does it, in registers, a third of its
/// time.
static inline void scree_integer_sum_add_all(scree_integer_sum *sum, const double *term, size_t count)
{
    const double inverse = sum->inverse;
    scree_wide_integer total = 0;
    bool within = true;
    for (size_t k = 0; k < count; k++) {
        double quanta = term[k] * inverse;
        within &= fabs(quanta) <= SCREE_INTEGER_SUM_MOST;
        total += llrint(quanta);
    }
    sum->quanta += total;
    sum->spoiled |= !within;
}

/// The sum of terms that lie in an array: the bits of the loop above.
static inline double scree_integer_sum_of(const double *term, size_t count)
{
    scree_integer_sum sum = {0};
    for (size_t k = 0; k < count; k++) sum.largest = fabs(term[k]) > sum.largest ? fabs(term[k]) : sum.largest;
    scree_integer_sum_bound(&sum, sum.largest);
    scree_integer_sum_add_all(&sum, term, count);
    return scree_integer_sum_total(&sum);
}

#endif
