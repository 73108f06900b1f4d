/// A power law of radii: what a case says of it, and its closed forms.
#ifndef SCREE_SIZE_POWER_LAW_H
#define SCREE_SIZE_POWER_LAW_H

typedef struct scree_power_law_config {
    double radius_min, radius_max; ///< m
    double exponent;               ///< 1
} scree_power_law_config;

/// Mean of R^power [m^power], by number.
double scree_power_law_moment(const scree_power_law_config *law, double power);

/// Radius [m] below which the share `uniform` of all lies, in [0, 1).
double scree_power_law_radius(const scree_power_law_config *law, double uniform);

#endif
