/// a^exponent of lanes, a >= 0, the same bits for any number of lanes: exp2(exponent log2(a)) in 2^k m, one piece each.
///   log2: k, m = 2^-k a in [sqrt(1/2), sqrt(2)), z = (m - 1) / (m + 1):  k + 2 / ln 2 (z + z^3/3 + ... + z^13/13)
///   exp2: n the nearest integer, f the rest:  2^n (1 + f ln 2 + ... + (f ln 2)^11 / 11!)
/// Error: 6e-13 in the logarithm (times ln 2 and the exponent in the power), 1e-14 in the exponential. Zero gives zero,
/// numbers below 2^-1022 count as about that; infinity and NaN give NaN. Results are cut to 2^-1022 .. 2^1023.
/// Inlined, where a call of a library (SLEEF) spills every register of the kernel and buys digits that the law does not
/// have. Cost: 1 division, about 50 other operations.
#ifndef SCREE_CONTACT_POWER_H
#define SCREE_CONTACT_POWER_H

#include "contact/lanes.h"

#define POWER_ONE          UINT64_C(0x3ff0000000000000) // bits of 1
#define POWER_ROOT_OF_HALF UINT64_C(0x3fe6a09e00000000) // bits of sqrt(1/2), rounded
#define POWER_INTEGER      UINT64_C(0x4330000000000000) // bits of 2^52: with an integer in the low bits, 2^52 + integer

/// log2(m) of m in [sqrt(1/2), sqrt(2)).
SCREE_INLINE lanes power_log2_part(lanes m)
{
    const double scale = 2 * M_LOG2E;
    lanes z = (m - 1.0) / (m + 1.0), w = z * z, w2 = w * w;
    lanes low = scale + (scale / 3) * w, middle = scale / 5 + (scale / 7) * w, high = scale / 9 + (scale / 11) * w;
    return z * ((low + middle * w2) + (high + (scale / 13) * w2) * (w2 * w2));
}

/// 2^f of f in [-1/2, 1/2].
SCREE_INLINE lanes power_exp2_part(lanes f)
{
    lanes x = f * M_LN2, x2 = x * x, x4 = x2 * x2;
    lanes p0 = (1.0 + x) + (1.0 / 2 + x * (1.0 / 6)) * x2;
    lanes p4 = (1.0 / 24 + x * (1.0 / 120)) + (1.0 / 720 + x * (1.0 / 5040)) * x2;
    lanes p8 = (1.0 / 40320 + x * (1.0 / 362880)) + (1.0 / 3628800 + x * (1.0 / 39916800)) * x2;
    return p0 + (p4 + p8 * x4) * x4;
}

SCREE_INLINE lanes lanes_power(lanes a, double exponent)
{
    lanes_bits bits = lanes_as_bits(a);
    lanes_bits shift = (bits + (POWER_ONE - POWER_ROOT_OF_HALF)) >> 52; // k + 1023
    lanes k = lanes_as_double(shift | POWER_INTEGER) - (0x1p52 + 1023);
    lanes m = lanes_as_double(bits - ((shift - 1023) << 52));
    lanes logarithm = (k + power_log2_part(m)) * exponent;

    logarithm = lanes_at_least(lanes_at_most(logarithm, lanes_all(1023)), lanes_all(-1022));
    lanes shifted = logarithm + SCREE_FIXED_MAGIC, n = shifted - SCREE_FIXED_MAGIC;
    lanes_bits whole = lanes_as_bits(shifted) - (uint64_t)SCREE_FIXED_MAGIC_BITS;
    lanes scale = lanes_as_double((whole + 1023) << 52);
    // What is not finite would be lost above.
    lanes power = scale * power_exp2_part(logarithm - n) + 0.0 * a;
    return lanes_keep(lanes_differ(a, lanes_all(0)), power);
}

#endif
