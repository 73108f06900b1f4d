/// What a case says of a confinement.
#ifndef SCREE_RUN_STAGE_CONFINE_H
#define SCREE_RUN_STAGE_CONFINE_H

typedef struct scree_confine_config {
    double pressure;         ///< Pa, compression positive
    double ramp_time;        ///< s; auto
    double unbalanced_limit; ///< 1, stop when the unbalanced force ratio stays below it
    double stress_tolerance; ///< 1, of the pressure: stop when the stress is within it; auto
    double time_limit;       ///< s; auto; reaching it is an error of the case, not a silent stop
} scree_confine_config;

#endif
