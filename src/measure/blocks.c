/// Mean of a part of a series whose values hang together: see blocks.h.
#include "measure/blocks.h"

#include <math.h>

#define STUDENT 2.7764451051977934 // 97.5 %, SCREE_BLOCKS - 1 degrees of freedom

void scree_blocks_interval(const double piece[SCREE_BLOCKS], double *mean, double *half)
{
    double square = 0;
    *mean = 0;
    for (int b = 0; b < SCREE_BLOCKS; b++) *mean += piece[b] / SCREE_BLOCKS;
    for (int b = 0; b < SCREE_BLOCKS; b++) square += (piece[b] - *mean) * (piece[b] - *mean);
    *half = STUDENT * sqrt(square / (SCREE_BLOCKS - 1) / SCREE_BLOCKS);
}

void scree_blocks_mean(const double *value, size_t count, double *mean, double *half)
{
    double piece[SCREE_BLOCKS] = {0};
    size_t number = 0, there[SCREE_BLOCKS] = {0};
    for (size_t k = 0; k < count; k++) number += isnan(value[k]) ? 0 : 1;
    *mean = *half = NAN;
    if (number < 2 * SCREE_BLOCKS) return;
    for (size_t k = 0, i = 0; k < count; k++) {
        if (isnan(value[k])) continue;
        const size_t b = (size_t)SCREE_BLOCKS * i++ / number;
        piece[b] += value[k];
        there[b]++;
    }
    for (int b = 0; b < SCREE_BLOCKS; b++) piece[b] /= (double)there[b];
    scree_blocks_interval(piece, mean, half);
}
