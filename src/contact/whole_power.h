/// Powers with a whole exponent by multiplications, and a first guess of roots without functions of a library: both in
/// the lanes of the kernel, so that nothing is spilled around a call.
///
/// The guess of x^(1/c) is 2^(log2(x) / c). The logarithm is the exponent of x plus a polynomial of its fraction, off
/// by 1.7e-5 at most; the power of two is built from the nearest whole number and a polynomial of the rest, off by 1e-7
/// of it. So the guess is off by 1.2e-5 / c + 1e-7 of the root, and one of Halley's steps (y^c = x, third order, error
/// (c^2 - 1) / 12 times the cube) brings it to round-off for all c up to WHOLE_POWER_MOST. x: a positive normal number.
/// The coefficients interpolate at the nodes of Chebyshev. Each operation is correctly rounded: any number of lanes has
/// the same bits (contact/lanes.h).
/// Cost: guess 22 operations; power about 2 log2(c) multiplications.
#ifndef SCREE_CONTACT_WHOLE_POWER_H
#define SCREE_CONTACT_WHOLE_POWER_H

#include "contact/lanes.h"

enum { WHOLE_POWER_MOST = 1024 };

#define WHOLE_POWER_FRACTION UINT64_C(0x000fffffffffffff) // bits of a double's fraction
#define WHOLE_POWER_ONE      UINT64_C(0x3ff0000000000000) // bits of 1.0
#define WHOLE_POWER_LARGE    0x1p52   // its bits with a whole number added at the end: 2^52 plus that
#define WHOLE_POWER_ROUND    0x1.8p52 // added and taken away: the nearest whole number

/// a^exponent, exponent > 0.
SCREE_INLINE lanes whole_power(lanes a, unsigned exponent)
{
    lanes power = lanes_all(1);
    for (unsigned left = exponent; left > 0; left >>= 1) {
        if (left & 1) power *= a;
        if (left > 1) a *= a;
    }
    return power;
}

/// log2(x), within 1.7e-5.
SCREE_INLINE lanes rough_log2(lanes x)
{
    const lanes_bits bits = lanes_as_bits(x), large = lanes_as_bits(lanes_all(WHOLE_POWER_LARGE));
    const lanes exponent = lanes_as_double((bits >> 52) | large) - (WHOLE_POWER_LARGE + 1023.0);
    const lanes z = lanes_as_double((bits & WHOLE_POWER_FRACTION) | WHOLE_POWER_ONE) - 1.0;
    return exponent + (1.6515e-5 + z * (1.441492412 +
                                        z * (-0.706486449 + z * (0.409470299 + z * (-0.187488605 + z * 0.043004958)))));
}

/// 2^x, within 1e-7 of it; |x| below 1023.
SCREE_INLINE lanes rough_exp2(lanes x)
{
    const lanes shifted = x + WHOLE_POWER_ROUND, rest = x - (shifted - WHOLE_POWER_ROUND);
    const lanes part =
        1.000000075 +
        rest * (0.693147188 + rest * (0.240221075 + rest * (0.055503571 + rest * (0.009676032 + rest * 0.001339086))));
    return lanes_as_double(lanes_as_bits(part) + (lanes_as_bits(shifted) << 52));
}

/// x^inverse, roughly (above).
SCREE_INLINE lanes rough_root(lanes x, double inverse)
{
    return rough_exp2(rough_log2(x) * inverse);
}

#endif
