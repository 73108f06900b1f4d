/// Eight corners of a polygon at once, in lanes (GNU vector extensions), in place of one after the other. Each
/// operation is one correctly rounded IEEE operation (the build forbids contraction), so the bits are the same.
///
/// SCREE_CORNER_LANES is what a vector holds in files that are compiled for AVX-512 (8) or AVX2 (4: two vectors;
/// *_batch.c, CMakeLists.txt). Elsewhere it is 0, and there are none of these functions.
#ifndef SCREE_SHAPE_CORNER_LANES_H
#define SCREE_SHAPE_CORNER_LANES_H

#include "base/inline.h"

#include <math.h>
#include <stdint.h>

#if defined(__AVX512F__) && defined(__AVX512DQ__)
#define SCREE_CORNER_LANES 8
#elif defined(__AVX2__)
#define SCREE_CORNER_LANES 4
#else
#define SCREE_CORNER_LANES 0
#endif

/// Corners that are looked at together.
enum { SCREE_CORNERS_IN_LANES = 8 };

#if SCREE_CORNER_LANES > 0

#include <immintrin.h>

enum { SCREE_CORNER_VECTORS = SCREE_CORNERS_IN_LANES / SCREE_CORNER_LANES };

typedef double corner_lanes __attribute__((vector_size(8 * SCREE_CORNER_LANES)));

/// Coordinates of eight corners, in one or two vectors; lanes of corners that are not there hold anything.
typedef struct polygon_lanes {
    corner_lanes x[SCREE_CORNER_VECTORS], y[SCREE_CORNER_VECTORS];
} polygon_lanes;

#define CORNER_VECTOR_LOOP _Pragma("GCC unroll 2") for (int part = 0; part < SCREE_CORNER_VECTORS; part++)

/// The corners as numbers, of which masks leave out those behind the last: the compiler is not to count them.
SCREE_INLINE const double *corner_lanes_from(const double (*corner)[2])
{
    const double *from = corner[0];
    __asm__("" : "+r"(from));
    return from;
}

#if SCREE_CORNER_LANES == 8

/// Bits of the lanes in which a > b; not of those that are not a number.
SCREE_INLINE uint32_t corner_lanes_above(corner_lanes a, corner_lanes b)
{
    return (uint32_t)_mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_GT_OQ);
}

SCREE_INLINE corner_lanes corner_lanes_magnitude(corner_lanes a)
{
    return (corner_lanes)_mm512_abs_pd((__m512d)a);
}

/// The largest of the lanes whose bit is set; -infinity if none is.
SCREE_INLINE double corner_lanes_largest(uint32_t bits, const corner_lanes a[SCREE_CORNER_VECTORS])
{
    return _mm512_mask_reduce_max_pd((__mmask8)bits, (__m512d)a[0]);
}

/// Corners from memory, shifted by `way`; shifted: where they are kept so, one after the other, with room for eight, or
/// NULL.
SCREE_INLINE polygon_lanes corner_lanes_load(int count, const double (*corner)[2], const double way[2],
                                             double (*shifted)[2])
{
    const uint32_t there = ((uint32_t)1 << 2 * count) - 1;
    const __m512d by = _mm512_broadcast_f64x2(_mm_loadu_pd(way));
    const double *from = corner_lanes_from(corner);
    const __m512d low = _mm512_add_pd(_mm512_maskz_loadu_pd((__mmask8)there, from), by);
    const __m512d high = _mm512_add_pd(_mm512_maskz_loadu_pd((__mmask8)(there >> 8), from + 8), by);
    const __m512i x = _mm512_setr_epi64(0, 2, 4, 6, 8, 10, 12, 14), y = _mm512_setr_epi64(1, 3, 5, 7, 9, 11, 13, 15);
    if (shifted) {
        _mm512_storeu_pd(shifted[0], low);
        _mm512_storeu_pd(shifted[4], high);
    }
    return (polygon_lanes){{(corner_lanes)_mm512_permutex2var_pd(low, x, high)},
                           {(corner_lanes)_mm512_permutex2var_pd(low, y, high)}};
}

#else

SCREE_INLINE uint32_t corner_lanes_above(corner_lanes a, corner_lanes b)
{
    return (uint32_t)_mm256_movemask_pd(_mm256_cmp_pd((__m256d)a, (__m256d)b, _CMP_GT_OQ));
}

SCREE_INLINE corner_lanes corner_lanes_magnitude(corner_lanes a)
{
    return (corner_lanes)_mm256_andnot_pd(_mm256_set1_pd(-0.0), (__m256d)a);
}

/// The first four of bits, as a mask.
SCREE_INLINE __m256i corner_lanes_mask(uint32_t bits)
{
    const __m256i place = _mm256_setr_epi64x(1, 2, 4, 8);
    return _mm256_cmpeq_epi64(_mm256_and_si256(_mm256_set1_epi64x((long long)bits), place), place);
}

SCREE_INLINE double corner_lanes_largest(uint32_t bits, const corner_lanes a[SCREE_CORNER_VECTORS])
{
    const __m256d none = _mm256_set1_pd(-INFINITY);
    const __m256d four =
        _mm256_max_pd(_mm256_blendv_pd(none, (__m256d)a[0], _mm256_castsi256_pd(corner_lanes_mask(bits))),
                      _mm256_blendv_pd(none, (__m256d)a[1], _mm256_castsi256_pd(corner_lanes_mask(bits >> 4))));
    const __m128d two = _mm_max_pd(_mm256_castpd256_pd128(four), _mm256_extractf128_pd(four, 1));
    return _mm_cvtsd_f64(_mm_max_sd(two, _mm_unpackhi_pd(two, two)));
}

SCREE_INLINE polygon_lanes corner_lanes_load(int count, const double (*corner)[2], const double way[2],
                                             double (*shifted)[2])
{
    const __m256d by = _mm256_broadcast_pd((const __m128d *)(const void *)way);
    const uint32_t there = ((uint32_t)1 << 2 * count) - 1;
    polygon_lanes read;
    CORNER_VECTOR_LOOP
    {
        const double *from = corner_lanes_from(corner) + 8 * part;
        const uint32_t bits = there >> 8 * part;
        const __m256d low = _mm256_add_pd(_mm256_maskload_pd(from, corner_lanes_mask(bits)), by);
        const __m256d high = _mm256_add_pd(_mm256_maskload_pd(from + 4, corner_lanes_mask(bits >> 4)), by);
        if (shifted) {
            _mm256_storeu_pd(shifted[4 * part], low);
            _mm256_storeu_pd(shifted[4 * part + 2], high);
        }
        read.x[part] = (corner_lanes)_mm256_permute4x64_pd(_mm256_unpacklo_pd(low, high), 0xd8);
        read.y[part] = (corner_lanes)_mm256_permute4x64_pd(_mm256_unpackhi_pd(low, high), 0xd8);
    }
    return read;
}

#endif

/// Turns a table of eight by eight bits about its diagonal: bit i of byte j becomes bit j of byte i.
SCREE_INLINE uint64_t corner_bits_transposed(uint64_t bits)
{
    uint64_t swap = (bits ^ bits >> 7) & 0x00aa00aa00aa00aa;
    bits ^= swap ^ swap << 7;
    swap = (bits ^ bits >> 14) & 0x0000cccc0000cccc;
    bits ^= swap ^ swap << 14;
    swap = (bits ^ bits >> 28) & 0x00000000f0f0f0f0;
    return bits ^ swap ^ swap << 28;
}

#endif

#endif
