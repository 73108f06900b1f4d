/// Space-filling curve of cells, and the sort that puts bodies or cells into its order.
///
/// The curve is Morton's (1966): the bits of the two or three cell coordinates are interleaved, x in the lowest places.
/// Dropping the last d m bits of a key in d dimensions gives the key of the cell of 2^m cells a side around it, so
/// bodies sorted by the key of the finest cells are sorted by coarser cells too: all bodies of a coarse cell are
/// neighbours in the order. Coordinates have 32 bits in 2D and 21 in 3D.
#ifndef SCREE_SEARCH_SPACE_CURVE_H
#define SCREE_SEARCH_SPACE_CURVE_H

#include "base/error.h"

#include <stdint.h>

/// Every second bit of the result is a bit of `value`.
static inline uint64_t scree_curve_spread(uint32_t value)
{
    uint64_t bits = value;
    bits = (bits | bits << 16) & UINT64_C(0x0000ffff0000ffff);
    bits = (bits | bits << 8) & UINT64_C(0x00ff00ff00ff00ff);
    bits = (bits | bits << 4) & UINT64_C(0x0f0f0f0f0f0f0f0f);
    bits = (bits | bits << 2) & UINT64_C(0x3333333333333333);
    return (bits | bits << 1) & UINT64_C(0x5555555555555555);
}

/// Inverse of scree_curve_spread; bits in odd places are ignored.
static inline uint32_t scree_curve_gather(uint64_t bits)
{
    bits &= UINT64_C(0x5555555555555555);
    bits = (bits | bits >> 1) & UINT64_C(0x3333333333333333);
    bits = (bits | bits >> 2) & UINT64_C(0x0f0f0f0f0f0f0f0f);
    bits = (bits | bits >> 4) & UINT64_C(0x00ff00ff00ff00ff);
    bits = (bits | bits >> 8) & UINT64_C(0x0000ffff0000ffff);
    return (uint32_t)(bits | bits >> 16);
}

static inline uint64_t scree_curve_key(uint32_t x, uint32_t y)
{
    return scree_curve_spread(x) | scree_curve_spread(y) << 1;
}

/// Every third bit of the result is a bit of `value`, which has 21.
static inline uint64_t scree_curve_spread_3d(uint32_t value)
{
    uint64_t bits = value & 0x1fffff;
    bits = (bits | bits << 32) & UINT64_C(0x001f00000000ffff);
    bits = (bits | bits << 16) & UINT64_C(0x001f0000ff0000ff);
    bits = (bits | bits << 8) & UINT64_C(0x100f00f00f00f00f);
    bits = (bits | bits << 4) & UINT64_C(0x10c30c30c30c30c3);
    return (bits | bits << 2) & UINT64_C(0x1249249249249249);
}

/// Inverse of scree_curve_spread_3d; the other bits are ignored.
static inline uint32_t scree_curve_gather_3d(uint64_t bits)
{
    bits &= UINT64_C(0x1249249249249249);
    bits = (bits | bits >> 2) & UINT64_C(0x10c30c30c30c30c3);
    bits = (bits | bits >> 4) & UINT64_C(0x100f00f00f00f00f);
    bits = (bits | bits >> 8) & UINT64_C(0x001f0000ff0000ff);
    bits = (bits | bits >> 16) & UINT64_C(0x001f00000000ffff);
    return (uint32_t)(bits | bits >> 32) & 0x1fffff;
}

static inline uint64_t scree_curve_key_3d(uint32_t x, uint32_t y, uint32_t z)
{
    return scree_curve_spread_3d(x) | scree_curve_spread_3d(y) << 1 | scree_curve_spread_3d(z) << 2;
}

/// Keys with a 32-bit companion each, and room for a second copy that the sort needs.
typedef struct scree_key_list {
    uint64_t *key, *other_key;
    uint32_t *index, *other_index;
    size_t capacity;
} scree_key_list;

/// Makes room for `count` keys; contents are lost when it grows.
scree_status scree_key_list_reserve(scree_key_list *list, size_t count, scree_error *error) SCREE_MUST_USE;
void scree_key_list_destroy(scree_key_list *list);

/// Sorts the first `count` keys in ascending order with their indices; equal keys keep their order (stable). Radix sort
/// by digits of 11 bits from the last, without those that all keys share: linear cost, two passes for up to 4 million
/// cells. `other_key` and `other_index` are overwritten.
void scree_key_list_sort(scree_key_list *list, size_t count);

#endif
