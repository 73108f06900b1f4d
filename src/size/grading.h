/// What a case says of a grading curve.
#ifndef SCREE_SIZE_GRADING_H
#define SCREE_SIZE_GRADING_H

#include <stdint.h>

typedef struct scree_sieve {
    double sieve;   ///< m, opening: the diameter of what just passes
    double passing; ///< 1, share of the mass that passes
} scree_sieve;

typedef enum scree_grading_between { SCREE_GRADING_LOGARITHM, SCREE_GRADING_SIZE } scree_grading_between;

typedef struct scree_grading_config {
    scree_sieve *grading; ///< from fine to coarse
    int64_t sieve_count;
    int between; ///< scree_grading_between
} scree_grading_config;

#endif
