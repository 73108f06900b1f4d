/// Lanes: one arithmetic type for several contacts at once, so that the physics of a law is written once and serves the
/// scalar reference (one lane, a plain double) and the vector kernels (2, 4 or 8 lanes, GNU vector extensions).
///
/// Every operation here is one correctly rounded IEEE operation, or a SLEEF function that gives the same bits in all
/// its instruction sets; the build forbids contraction (-ffp-contract=off). So any number of lanes gives the same bits.
/// `SCREE_LANES` follows `SCREE_ISA` (kernel files, see CMakeLists.txt) and is 1 in all other files.
///
/// Comparisons give masks: 64-bit integers with all bits set or clear. Integers are unsigned, so that sums of what is
/// out of range (and flagged) wrap instead of being undefined. A NaN passes through at_least and at_most when it is the
/// value, and is dropped when it is the limit.
#ifndef SCREE_CONTACT_LANES_H
#define SCREE_CONTACT_LANES_H

#include "base/fixed.h"
#include "base/inline.h"

#include <sleef.h>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#ifndef SCREE_LANES
#if !defined(SCREE_ISA)
#define SCREE_LANES 1
#elif SCREE_ISA == 4
#define SCREE_LANES 8
#elif SCREE_ISA == 3
#define SCREE_LANES 4
#else
#define SCREE_LANES 2
#endif
#endif

#if SCREE_LANES == 1

typedef double lanes;
typedef uint64_t lanes_bits;

SCREE_INLINE lanes lanes_all(double value)
{
    return value;
}

SCREE_INLINE lanes_bits lanes_at_or_below(lanes a, lanes b)
{
    return -(lanes_bits)(a <= b);
}

SCREE_INLINE lanes_bits lanes_below(lanes a, lanes b)
{
    return -(lanes_bits)(a < b);
}

SCREE_INLINE lanes_bits lanes_differ(lanes a, lanes b)
{
    return -(lanes_bits)(a != b);
}

SCREE_INLINE unsigned lanes_ones(lanes_bits mask)
{
    return (unsigned)(mask & 1);
}

SCREE_INLINE lanes lanes_root(lanes a)
{
    return sqrt(a);
}

SCREE_INLINE lanes lanes_log(lanes a)
{
    return Sleef_cinz_logd1_u35purec(a);
}

SCREE_INLINE lanes lanes_exp2(lanes a)
{
    return Sleef_cinz_exp2d1_u35purec(a);
}

SCREE_INLINE lanes_bits lanes_as_bits(lanes a)
{
    lanes_bits bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}

SCREE_INLINE lanes lanes_as_double(lanes_bits bits)
{
    lanes a;
    memcpy(&a, &bits, sizeof a);
    return a;
}

SCREE_INLINE lanes lanes_at_least(lanes value, lanes limit)
{
    return limit > value ? limit : value;
}

SCREE_INLINE lanes lanes_at_most(lanes value, lanes limit)
{
    return limit < value ? limit : value;
}

#else

#define SCREE_LANES_BYTES (8 * SCREE_LANES)
typedef double lanes __attribute__((vector_size(SCREE_LANES_BYTES)));
typedef uint64_t lanes_bits __attribute__((vector_size(SCREE_LANES_BYTES)));

SCREE_INLINE lanes lanes_all(double value)
{
    return value - (lanes){0};
}

SCREE_INLINE lanes_bits lanes_at_or_below(lanes a, lanes b)
{
    return (lanes_bits)(a <= b);
}

SCREE_INLINE lanes_bits lanes_below(lanes a, lanes b)
{
    return (lanes_bits)(a < b);
}

SCREE_INLINE lanes_bits lanes_differ(lanes a, lanes b)
{
    return (lanes_bits)(a != b);
}

SCREE_INLINE lanes_bits lanes_as_bits(lanes a)
{
    return (lanes_bits)a;
}

SCREE_INLINE lanes lanes_as_double(lanes_bits bits)
{
    return (lanes)bits;
}

#if SCREE_LANES == 8 && defined(__AVX512DQ__)
#define LANES_MACHINE(name)         _mm512_##name
#define LANES_SLEEF(name, accuracy) Sleef_cinz_##name##d8_##accuracy##avx512fnofma
SCREE_INLINE unsigned lanes_ones(lanes_bits mask)
{
    return _mm512_movepi64_mask((__m512i)mask);
}
#elif SCREE_LANES == 4 && defined(__AVX__)
#define LANES_MACHINE(name)         _mm256_##name
#define LANES_SLEEF(name, accuracy) Sleef_cinz_##name##d4_##accuracy##avx
SCREE_INLINE unsigned lanes_ones(lanes_bits mask)
{
    return (unsigned)_mm256_movemask_pd((__m256d)mask);
}
#elif SCREE_LANES == 2 && defined(__SSE4_1__)
#define LANES_MACHINE(name)         _mm_##name
#define LANES_SLEEF(name, accuracy) Sleef_cinz_##name##d2_##accuracy##sse4
SCREE_INLINE unsigned lanes_ones(lanes_bits mask)
{
    return (unsigned)_mm_movemask_pd((__m128d)mask);
}
#endif

#ifdef LANES_MACHINE
SCREE_INLINE lanes lanes_at_least(lanes value, lanes limit)
{
    return (lanes)LANES_MACHINE(max_pd)(limit, value);
}

SCREE_INLINE lanes lanes_at_most(lanes value, lanes limit)
{
    return (lanes)LANES_MACHINE(min_pd)(limit, value);
}

SCREE_INLINE lanes lanes_root(lanes a)
{
    return (lanes)LANES_MACHINE(sqrt_pd)(a);
}

SCREE_INLINE lanes lanes_log(lanes a)
{
    return (lanes)LANES_SLEEF(log, u35)(a);
}

SCREE_INLINE lanes lanes_exp2(lanes a)
{
    return (lanes)LANES_SLEEF(exp2, u35)(a);
}
#else // a machine without these instructions: lane by lane
#define LANES_ONE_BY_ONE(name, expression)                                                                             \
    SCREE_INLINE lanes lanes_##name(lanes a)                                                                           \
    {                                                                                                                  \
        for (int k = 0; k < SCREE_LANES; k++) a[k] = expression(a[k]);                                                 \
        return a;                                                                                                      \
    }

LANES_ONE_BY_ONE(root, sqrt)
LANES_ONE_BY_ONE(log, Sleef_cinz_logd1_u35purec)
LANES_ONE_BY_ONE(exp2, Sleef_cinz_exp2d1_u35purec)

SCREE_INLINE unsigned lanes_ones(lanes_bits mask)
{
    unsigned bits = 0;
    for (int k = 0; k < SCREE_LANES; k++) bits |= (unsigned)(mask[k] & 1) << k;
    return bits;
}

SCREE_INLINE lanes lanes_at_least(lanes value, lanes limit)
{
    lanes_bits above = limit > value;
    return (lanes)(((lanes_bits)limit & above) | ((lanes_bits)value & ~above));
}

SCREE_INLINE lanes lanes_at_most(lanes value, lanes limit)
{
    lanes_bits below = limit < value;
    return (lanes)(((lanes_bits)limit & below) | ((lanes_bits)value & ~below));
}
#endif
#endif

#define LANES_MAGNITUDE UINT64_C(0x7fffffffffffffff) // all bits of a double but its sign

/// `a` where the mask is set, zero elsewhere.
SCREE_INLINE lanes lanes_keep(lanes_bits mask, lanes a)
{
    return lanes_as_double(mask & lanes_as_bits(a));
}

/// `a` where the mask is set, `b` elsewhere.
SCREE_INLINE lanes lanes_select(lanes_bits mask, lanes a, lanes b)
{
    return lanes_as_double((mask & lanes_as_bits(a)) | (~mask & lanes_as_bits(b)));
}

SCREE_INLINE lanes lanes_abs(lanes a)
{
    return lanes_as_double(lanes_as_bits(a) & LANES_MAGNITUDE);
}

/// |magnitude| with the sign of `sign`.
SCREE_INLINE lanes lanes_with_sign(lanes magnitude, lanes sign)
{
    return lanes_as_double((lanes_as_bits(magnitude) & LANES_MAGNITUDE) | (lanes_as_bits(sign) & ~LANES_MAGNITUDE));
}

/// value / quantum as an integer, see base/fixed.h.
SCREE_INLINE lanes_bits lanes_fixed(lanes value, double inverse_quantum)
{
    return lanes_as_bits(value * inverse_quantum + SCREE_FIXED_MAGIC) - (uint64_t)SCREE_FIXED_MAGIC_BITS;
}

#endif
