/// Mean of a part of a series whose values hang together.
#ifndef SCREE_MEASURE_BLOCKS_H
#define SCREE_MEASURE_BLOCKS_H

#include <stddef.h>

enum { SCREE_BLOCKS = 5 };

/// Mean of `count` values one after the other, and half of its interval of 95 % by the means of SCREE_BLOCKS pieces of
/// equal length (Student; Flyvbjerg and Petersen 1989: pieces much longer than the memory of the series are
/// independent, shorter ones give too small an interval). What is NAN is left out; both are NAN with fewer than 2
/// SCREE_BLOCKS values.
void scree_blocks_mean(const double *value, size_t count, double *mean, double *half);

/// Mean of the values of the pieces, and half of its interval, the same.
void scree_blocks_interval(const double piece[SCREE_BLOCKS], double *mean, double *half);

#endif
