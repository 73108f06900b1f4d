/// What a case says of a compression.
#ifndef SCREE_RUN_STAGE_COMPRESS_H
#define SCREE_RUN_STAGE_COMPRESS_H

typedef struct scree_compress_config {
    double strain;    ///< 1, axial strain (engineering) at which to stop, compression positive
    double rate;      ///< 1/s, axial strain rate referred to the height at the start of the stage; auto: by `velocity`
    double velocity;  ///< m/s, of each plate; auto: by `rate`
    double rise_time; ///< s, in which the plates reach their velocity; auto: four wave times of the sample
} scree_compress_config;

#endif
