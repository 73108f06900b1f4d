/// What a case says of a dense packing, and what is remembered of one.
#ifndef SCREE_PREPARE_DENSE_H
#define SCREE_PREPARE_DENSE_H

#include <stdint.h>

typedef struct scree_dense_config {
    double solid_fraction; ///< 1; auto: 90 % of discs, 64 % of spheres
    double gap_scatter;    ///< 1, rms of the gaps of bonds about their mean, over the mean radius
    double size_penalty;   ///< 1
    int64_t rounds;
} scree_dense_config;

/// Numbers of the record, in the order of the results (dense.c).
enum { SCREE_DENSE_RECORD = 24 };

typedef struct scree_dense_record {
    double value[SCREE_DENSE_RECORD]; ///< all zero: the sample was prepared in another way
} scree_dense_record;

#endif
