/// Stages: one file a kind (stage_*.c), whose module has this face.
#ifndef SCREE_RUN_STAGE_H
#define SCREE_RUN_STAGE_H

#include "boundary/periodic.h"
#include "boundary/plates.h"
#include "measure/delaunay_boundary.h"
#include "state/work.h"

typedef struct scree_simulation scree_simulation;

/// What a stage needs at every step and can be derived from the state at its begin (so it is not stored).
typedef struct scree_stage_plan {
    uint64_t interval;  ///< ticks between two samples, whole largest steps
    uint64_t expected;  ///< ticks of the whole stage, whole largest steps; 0: not known in advance
    double ramp_time;   ///< s
    scree_servo plates; ///< bottom and top
    scree_servo sides;  ///< left and right, front and back
    double time_limit;  ///< s
    scree_periodic_drive periodic;
} scree_stage_plan;

typedef struct scree_stage {
    const char *name;
    bool instant;       ///< ends as soon as it has begun (no steps)
    bool loading;       ///< samples of this stage have a strain, and snapshots are evenly spaced in it
    bool quasistatic;   ///< means to be
    int samples_a_wave; ///< samples in a wave time of the sample; 0: evenly over the stage
    /// The same stage in a cell that is periodic in all directions; NULL: it is the same.
    const struct scree_stage *cell;

    // ---- asked before the stage begins; `config` is its own struct. Each may be NULL ----
    /// Time [s] at its full rate. NULL: not known.
    double (*duration)(const void *config);
    /// Time [s] that it is planned to last, where a wave goes through the sample in `wave` [s]. NULL: none.
    double (*planned)(const scree_model *model, const void *config, double wave);
    /// Makes it fit a case of `count` particles only.
    void (*shrink)(void *config, int64_t count);
    /// Time [s] that it takes, which is known when it has begun. NULL: as planned.
    double (*expected)(const scree_simulation *s);

    // ---- while a simulation is in it ----
    /// Strain that the stage imposes, as far as it has come. NULL: none.
    double (*strain)(const scree_simulation *s);
    /// Once, when the stage begins: walls, pressure, reference numbers in state.stage.reference.
    scree_status (*begin)(scree_simulation *s, scree_error *error);
    /// Derives the plan from the state; at begin and after a restart.
    void (*plan)(scree_simulation *s);
    /// Every step, before the plates move: velocities of plates, pressure. NULL: nothing to do.
    void (*control)(scree_simulation *s);
    /// At every sample: has the stage ended? Then writes the reason. May fail: time limit.
    scree_status (*finished)(scree_simulation *s, bool *done, scree_error *error);
    /// Fraction done, NAN when not known.
    double (*fraction)(const scree_simulation *s);
} scree_stage;

/// That of a kind, the slot of its module. wholly_periodic: the sample is periodic in all directions
/// (stage_periodic.c).
const scree_stage *scree_stage_get(int kind, bool wholly_periodic);
extern const scree_stage scree_stage_prepare;
extern const scree_stage scree_stage_confine;
extern const scree_stage scree_stage_compress;
extern const scree_stage scree_stage_confine_periodic;
extern const scree_stage scree_stage_compress_periodic;
extern const scree_stage scree_stage_deform_periodic;
extern const scree_stage scree_stage_deform;
extern const scree_stage scree_stage_rotate;
extern const scree_stage scree_stage_relax;
extern const scree_stage scree_stage_collide;

/// s since the begin of the stage.
double scree_stage_elapsed(const scree_simulation *s);

/// Ticks of `time` [s], rounded up to whole largest steps, where every sequence of steps ends; at least one of them.
uint64_t scree_stage_ticks(const scree_simulation *s, double time);

/// Stop rule of the confine stages (stage_confine.c): the stress called `what` is off the pressure by `off` of it.
/// NULL: none is asked for.
scree_status scree_confine_finished(scree_simulation *s, const char *what, double off, double tolerance, bool *done,
                                    scree_error *error) SCREE_MUST_USE;

/// The config of the stage that runs now; what its kind says is in `own`.
const scree_config_stage *scree_stage_config(const scree_simulation *s);

/// Strain that the loading stage imposes, as far as it has come: NAN in other stages.
double scree_loading_strain(const scree_simulation *s);

/// Axial strain [1, compression positive], engineering, since the begin of the loading stage: from the plates or the
/// periodic cell, or without them from the Delaunay boundary.
double scree_axial_strain(const scree_simulation *s);

/// Begins a loading stage: SCREE_LOADING_... of state.stage.reference and the reference positions.
void scree_loading_begin(scree_simulation *s);
enum {
    SCREE_LOADING_HEIGHT,      ///< m, at the begin
    SCREE_LOADING_WAVE,        ///< s, wave time at the begin
    SCREE_LOADING_SIDES,       ///< 2: impedance and mass of the side plates
    SCREE_LOADING_STRAIN = 4,  ///< 9: accumulated boundary strain at the begin
    SCREE_LOADING_OTHERS = 13, ///< free for the stage
    // all loading stages, periodic ones too; set by the first sample (run/sample.c)
    SCREE_LOADING_ENCLOSED = 20, ///< 1, scree_enclosed_logarithm
    SCREE_LOADING_REDETECTED,    ///< 1, scree_strain_of(&state)->redetected
    SCREE_LOADING_SOLID,         ///< 1, solid fraction
};

/// state.stage.reference of rotate_particle.
enum {
    SCREE_ROTATE_BACKGROUND = SCREE_LOADING_OTHERS, ///< 1, spins at rest over the prescribed one; NAN: no rest
    SCREE_ROTATE_TURN,                              ///< rad, that the particle turns by in the whole stage
};

/// A stage has reached its strain when so many ticks of it are left at its last step: the sum of rates over the rise,
/// taken from the left, is half a tick short of its integral; the rest is for round-off. Less would end it a whole
/// sample later, at a time that depends on the number of samples.
#define SCREE_LOADING_SHORT 0.51

/// Plan of a loading stage that lasts `time` [s] at its full rate: samples, rise of the rate, steps.
/// rise_time [s]: until its full rate; NAN: some wave times.
scree_stage_plan scree_loading_plan(const scree_simulation *s, double time, double rise_time);

/// Time [s] that such a stage takes, where a wave goes through the sample in `wave` [s].
double scree_loading_planned(double time, double rise_time, double wave);

/// Fraction of the full rate that is reached now; *loaded [s]: time at the full rate that would have led as far.
double scree_loading_rise(const scree_simulation *s, double *loaded);

/// A stage without plates ends when its strain is reached; the error when it falls too far behind its rate.
scree_status scree_loading_check(const scree_simulation *s, scree_error *error) SCREE_MUST_USE;

/// Smooth step from 0 to 1 (cubic), for pressures and velocities that must not shock the sample.
double scree_smooth_ramp(double fraction);

/// Side plates under servo to `pressure`, where they are active.
void scree_servo_sides(scree_simulation *s, double pressure);

/// Distance between bottom and top plate or the faces of the periodic cell [m]; without either the height that the
/// loading began with, changed as the Delaunay boundary was strained.
double scree_sample_height(const scree_simulation *s);

#endif
