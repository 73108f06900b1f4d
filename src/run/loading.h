/// What loading stages share: the numbers that they begin with, a rate that rises smoothly, the plan of samples.
#ifndef SCREE_RUN_LOADING_H
#define SCREE_RUN_LOADING_H

#include "run/stage.h"

/// State of the module `loading`: the sample at the begin of the loading stage.
typedef struct scree_loading {
    double height;     ///< m
    double wave_time;  ///< s
    double strain[9];  ///< 1, accumulated strain, 3 x 3 by rows (measure/measure.h)
    double enclosed;   ///< 1, scree_enclosed_logarithm at the first sample
    double redetected; ///< 1, of scree_strain at the first sample
    double solid;      ///< 1, solid fraction at the first sample
} scree_loading;

static inline scree_loading *scree_loading_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_loading];
}

/// Distance between bottom and top plate or the faces of the periodic cell [m]; without either the height that the
/// loading began with, changed as the Delaunay boundary was strained.
double scree_sample_height(const scree_simulation *s);

/// Axial strain [1, compression positive], engineering, since the begin of the loading stage: from the plates or the
/// periodic cell, or without them from the Delaunay boundary.
double scree_axial_strain(const scree_simulation *s);

/// Strain that the loading stage imposes, as far as it has come: NAN in other stages.
double scree_loading_strain(const scree_simulation *s);

/// Angles of round bodies, and orientations in 3D, count from here.
void scree_rotations_begin(scree_state *state);

/// Begins a loading stage under `pressure` [Pa]: measures the sample, and lets displacements, rotations and strains
/// count from here.
void scree_loading_begin(scree_simulation *s, double pressure);

/// A stage has reached its strain when so many ticks of it are left at its rate: the sum of rates over the rise, taken
/// from the left, is half a tick short of its integral; the rest is for round-off. Less would end it a whole sample
/// later, at a time that depends on the number of samples.
#define SCREE_LOADING_SHORT 0.51

/// Time [s] that a loading is planned to last that takes `time` at its full rate, where a wave goes through the sample
/// in `wave` [s]. rise_time [s]: NAN where it follows from the wave.
double scree_loading_planned(double time, double rise_time, double wave);

/// Plan of a loading stage that lasts `time` [s] at its full rate: samples, rise of the rate, steps. rise_time: as
/// above.
scree_stage_plan scree_loading_plan(const scree_simulation *s, double time, double rise_time);

/// Fraction of the full rate that is reached now; *loaded [s]: time at the full rate that would have led as far.
double scree_loading_rise(const scree_simulation *s, double *loaded);

/// Whether a stage that loads at `rate` [1/s] has come from `strain` to `end`; then writes the reason. The error when
/// it falls too far behind its rate.
scree_status scree_loading_finished(scree_simulation *s, const char *what, double strain, double end, double rate,
                                    bool *done, scree_error *error) SCREE_MUST_USE;

#endif
