/// Tensors summed as integers of 128 bits: like base/fixed.h free of order, for sums over all bodies.
#ifndef SCREE_BASE_WIDE_SUM_H
#define SCREE_BASE_WIDE_SUM_H

__extension__ typedef __int128 scree_wide_integer;

/// 3 x 3 by rows.
typedef struct scree_wide_sum {
    scree_wide_integer value[9];
} scree_wide_sum;

/// sum [quanta] of several sums, each times `quantum`.
static inline void scree_wide_total(const scree_wide_sum *part, int count, double quantum, double total[9])
{
    for (int k = 0; k < 9; k++) {
        scree_wide_integer sum = 0;
        for (int p = 0; p < count; p++) sum += part[p].value[k];
        total[k] = (double)sum * quantum;
    }
}

#endif
