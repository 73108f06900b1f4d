/// What a case says of a normal distribution of radii.
#ifndef SCREE_SIZE_NORMAL_H
#define SCREE_SIZE_NORMAL_H

#include "size/gaussian.h"

typedef struct scree_normal_config {
    double radius_min, radius_max; ///< m
    double mean, deviation;        ///< m, without the limits
} scree_normal_config;

#endif
