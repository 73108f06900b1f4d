/// What a case says of a deformation.
#ifndef SCREE_RUN_STAGE_DEFORM_H
#define SCREE_RUN_STAGE_DEFORM_H

/// Extension positive, row the direction of the velocity, NAN where free.
typedef struct scree_deform_config {
    double velocity_gradient[9]; ///< 1/s
    double strain_rate[9];       ///< 1/s, symmetric: only components on and above the diagonal are given
    double stress[9];            ///< Pa, held by a periodic cell, given like strain_rate; compression positive, shear
                                 ///< stress in the sense of the shear rate
    double strain;               ///< 1, of the largest component, at which to stop
    double rise_time;            ///< s, in which the rates are reached; auto: four wave times of the sample
} scree_deform_config;

#endif
