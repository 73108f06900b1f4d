/// What distributions between two limits share.
#ifndef SCREE_SIZE_LIMITS_H
#define SCREE_SIZE_LIMITS_H

#include "module/key_rows.h"
#include "module/size_distribution.h"

typedef struct scree_size_limits {
    double radius_min; ///< m
    double radius_max; ///< m
} scree_size_limits;

/// Rows of the limits, for the distribution of this name, whose struct `owner` begins with them. Keys of one name are
/// one key, whatever the distribution.
#define SIZE_LIMITS(owner, name)                                                                                       \
    NUMBER(owner, radius_min, "m", FROM("1 nm"), TO("100 m"), .when = "distribution=" name,                            \
           .meaning = "Smallest radius."),                                                                             \
        NUMBER(owner, radius_max, "m", FROM("1 nm"), TO("100 m"), .when = "distribution=" name,                        \
               .meaning = "Largest radius.")

/// Where the keys of a distribution stand, and what it is a choice of.
#define SIZE_KEYS(keys, owner)                                                                                         \
    (const scree_keys[])                                                                                               \
    {                                                                                                                  \
        KEYS_OF("particles", keys, owner), KEYS_OF("particles.species", keys, owner)                                   \
    }
#define SIZE_CHOICE CHOICE_OF(IS("particles.distribution"), IS("particles.species.distribution"))

/// The smallest radius is not above the largest.
bool scree_size_limits_wrong(const void *limits, scree_size_problem *problem);

#endif
