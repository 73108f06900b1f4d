/// Order-free sums: forces and dissipated energies are added as 64-bit integers, so the result does not depend on the
/// order of addition, on the number of threads, on the age of the neighbour list or (later) on the number of ranks.
///
/// Method. A quantum q = 2^k is chosen once a step so that the largest single contribution stays below 2^50 q. A
/// contribution f becomes the integer round(f / q): adding the constant 1.5 * 2^52 to f / q leaves that integer in the
/// low bits of the double, and subtracting the constant's own bits gives it in two's complement. Integer addition is
/// exact and associative; f and -f give opposite integers, so momentum is conserved exactly.
/// Error: q / 2 per contribution, at most 2^-51 of the bound. Sums of up to 2^12 contributions at the bound fit; a body
/// has far fewer contacts. Cost: one multiplication, one addition and one integer addition per component.
#ifndef SCREE_BASE_FIXED_H
#define SCREE_BASE_FIXED_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#define SCREE_FIXED_MAGIC      6755399441055744.0 /* 1.5 * 2^52 */
#define SCREE_FIXED_MAGIC_BITS INT64_C(0x4338000000000000)
#define SCREE_FIXED_RANGE_BITS 50

/// Smallest power-of-two quantum for which |value| <= bound fits. bound <= 0 gives the smallest useful one, 2^-900.
static inline double scree_fixed_quantum(double bound)
{
    int exponent = -850;
    if (bound > 0) (void)frexp(bound, &exponent);
    if (exponent < -850) exponent = -850;
    return ldexp(1.0, exponent - SCREE_FIXED_RANGE_BITS);
}

/// value / quantum as an integer; `inverse` = 1 / quantum (exact). A value out of range gives a meaningless integer;
/// the caller checks the range.
static inline int64_t scree_fixed_from(double value, double inverse)
{
    double shifted = value * inverse + SCREE_FIXED_MAGIC;
    uint64_t bits;
    memcpy(&bits, &shifted, sizeof bits);
    return (int64_t)(bits - (uint64_t)SCREE_FIXED_MAGIC_BITS);
}

/// Whole quanta of one of several terms of a boundary's force. Beyond 2^58, where only a body can be that has been
/// hurled away, they are cut, so that sums stay inside of the integers until a guard stops the run.
static inline int64_t scree_fixed_round(double quanta)
{
    // Comparisons are two instructions where fmin and fmax are calls. What is not a number becomes -2^58, as there.
    const double above = quanta > -0x1p58 ? quanta : -0x1p58;
    return llrint(above < 0x1p58 ? above : 0x1p58);
}

static inline double scree_fixed_to(int64_t sum, double quantum)
{
    return (double)sum * quantum;
}

#endif
