/// Integers that wrap: sums of quanta modulo 2^64, as the kernels make them. Only what acts on a body that has been
/// hurled away, or a place that is no number, leaves the range of base/fixed.h; a guard stops that run, and until then
/// its sums have to be defined.
#ifndef SCREE_BASE_WRAPPING_H
#define SCREE_BASE_WRAPPING_H

#include <stdint.h>

static inline void scree_wrapping_add(int64_t *sum, int64_t quanta)
{
    *sum = (int64_t)((uint64_t)*sum + (uint64_t)quanta);
}

static inline void scree_wrapping_subtract(int64_t *sum, int64_t quanta)
{
    *sum = (int64_t)((uint64_t)*sum - (uint64_t)quanta);
}

#endif
