/// What a case says of two timescales.
#ifndef SCREE_INTEGRATE_TWO_TIMESCALES_H
#define SCREE_INTEGRATE_TWO_TIMESCALES_H

#include <stdint.h>

typedef struct scree_two_timescales_config {
    int64_t repeats;        ///< m of m(n+q) = N_S
    int64_t large_multiple; ///< n
    int64_t small_steps;    ///< q
} scree_two_timescales_config;

#endif
