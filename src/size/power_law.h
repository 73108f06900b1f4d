/// What a case says of a power law of radii.
#ifndef SCREE_SIZE_POWER_LAW_H
#define SCREE_SIZE_POWER_LAW_H

typedef struct scree_power_law_config {
    double radius_min, radius_max; ///< m
    double exponent;               ///< 1
} scree_power_law_config;

#endif
