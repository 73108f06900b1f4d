/// What stages ask of boundaries with a bottom and a top plate.
#ifndef SCREE_BOUNDARY_AXIAL_PLATES_H
#define SCREE_BOUNDARY_AXIAL_PLATES_H

#include "boundary/boundary.h"

double scree_axial_wave_time(const scree_context *context, double pressure);
double scree_axial_height(const scree_context *context);
void scree_axial_fit(const scree_context *context, double pressure);
void scree_axial_rest(const scree_context *context);
void scree_axial_hold(const scree_context *context, double pressure);
void scree_axial_compress(const scree_context *context, const scree_compression *compression);
double scree_axial_stress_error(const scree_context *context, double pressure, const char **what);

/// The members of a boundary with such plates.
#define SCREE_AXIAL_PLATES                                                                                             \
    .wave_time = scree_axial_wave_time, .height = scree_axial_height, .fit = scree_axial_fit,                          \
    .rest = scree_axial_rest, .hold = scree_axial_hold, .compress = scree_axial_compress,                              \
    .stress_error = scree_axial_stress_error, .stress_tolerance = 0.05, .patience = 400

#endif
