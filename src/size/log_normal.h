/// What a case says of a log-normal distribution of radii.
#ifndef SCREE_SIZE_LOG_NORMAL_H
#define SCREE_SIZE_LOG_NORMAL_H

#include "size/gaussian.h"

typedef struct scree_log_normal_config {
    double radius_min, radius_max; ///< m
    double median;                 ///< m, without the limits
    double geometric_deviation;    ///< 1
} scree_log_normal_config;

#endif
