/// Profiles: what a prescribed velocity is multiplied by, as a function of the place of a body when it came to be
/// driven. So a selection is brought into the shape of a wave, or struck like one, and let go.
#ifndef SCREE_LOAD_PROFILE_H
#define SCREE_LOAD_PROFILE_H

#include "module/key.h"

/// Its keys stand in the struct of the load.
typedef struct scree_load_profile {
    int shape;         ///< a row of the table in profile.c
    int axis;          ///< 0 to 2
    double wavelength; ///< m
    double phase;      ///< rad
    double offset;     ///< 1
} scree_load_profile;

extern const scree_choice scree_load_profile_shapes[];
extern const scree_choice scree_load_profile_axes[];

/// Whether it is 1 everywhere.
bool scree_load_profile_is_uniform(const scree_load_profile *profile);

/// Factor at a place; both in m.
double scree_load_profile_at(const scree_load_profile *profile, const double place[3], const double origin[3]);

#endif
