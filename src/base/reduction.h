/// Numbers that are due at the same point of a step, out of all processes, for one message.
///
/// Whoever has found one among its own bodies or contacts says where it lies and how those of all are joined; then the
/// message is sent (comm/comm.h), and behind it the joined numbers lie where the own ones were. Until then they stay
/// where they are. With one process they are joined as they are.
#ifndef SCREE_BASE_REDUCTION_H
#define SCREE_BASE_REDUCTION_H

#include "base/wide_sum.h"

#include <assert.h>
#include <stddef.h>
#include <stdint.h>

typedef enum scree_reduction_kind {
    SCREE_REDUCTION_MAXIMUM, ///< double; NaN is the largest
    SCREE_REDUCTION_SUM,     ///< int64_t, modulo 2^64
    SCREE_REDUCTION_WIDE,    ///< scree_wide_integer, modulo 2^128
} scree_reduction_kind;

/// Lists of numbers in one message.
enum { SCREE_REDUCTION_PARTS = 16 };

/// Begins with zeros.
typedef struct scree_reduction {
    struct {
        scree_reduction_kind kind;
        void *first;
        size_t count;
    } part[SCREE_REDUCTION_PARTS];
    size_t parts;
} scree_reduction;

static inline void scree_reduction_list(scree_reduction *reduction, scree_reduction_kind kind, void *first,
                                        size_t count)
{
    assert(reduction->parts < SCREE_REDUCTION_PARTS);
    reduction->part[reduction->parts].kind = kind;
    reduction->part[reduction->parts].first = first;
    reduction->part[reduction->parts++].count = count;
}

/// The largest of each.
static inline void scree_reduction_maximum(scree_reduction *reduction, double *first, size_t count)
{
    scree_reduction_list(reduction, SCREE_REDUCTION_MAXIMUM, first, count);
}

/// The sum of each.
static inline void scree_reduction_add(scree_reduction *reduction, int64_t *first, size_t count)
{
    scree_reduction_list(reduction, SCREE_REDUCTION_SUM, first, count);
}

static inline void scree_reduction_add_wide(scree_reduction *reduction, scree_wide_integer *first, size_t count)
{
    scree_reduction_list(reduction, SCREE_REDUCTION_WIDE, first, count);
}

#endif
