/// What a stage says that pours (run/stage_pour.c), and what sources make of it.
#ifndef SCREE_SOURCE_POUR_H
#define SCREE_SOURCE_POUR_H

#include "state/births.h"
#include "state/work.h"

/// What becomes of a particle that has fallen past everything that stands.
enum { SCREE_PAST_STOP, SCREE_PAST_TAKE_OUT };

typedef struct scree_pour_config {
    int64_t count;           ///< particles that it pours; 0: all that the case has left
    double height;           ///< m, of the pile, at which sources stop; NAN: at none
    double width;            ///< m
    double unbalanced_limit; ///< 1, of the unbalanced ratio behind the last birth, below which it ends; NAN: at once
    double rest_time;        ///< s, behind the last birth, after which it ends in any case
    double patience;         ///< s, that a source may be blocked; NAN: see scree_pour_patience
    int past;                ///< SCREE_PAST_...
    double sleep_window;     ///< s; and the others: of scree_sleep_limits (module/stage.h)
    double sleep_force, sleep_motion, wake_force, wake_interval;
} scree_pour_config;

/// The stage that runs now; NULL: it does not pour.
const scree_pour_config *scree_pour_config_of(const scree_model *model, const scree_state *state);

/// Whether source `index` pours in stage `stage`.
bool scree_source_pours_in(const scree_model *model, int64_t index, int64_t stage);

/// Particles that a stage pours at most, of `born` that the case has had by now.
uint64_t scree_pour_wanted(const scree_model *model, const scree_pour_config *stage, uint64_t born);

/// Time [s] that the sources of a stage need for so many particles, if none waits.
double scree_pour_time(const scree_model *model, int64_t stage, double count);

/// Time [s] that a source may be blocked before the run is stopped: as the stage says; auto: a hundred intervals, or
/// fifty times what a grain needs to fall by its own diameter, whichever is longer.
double scree_pour_patience(const scree_model *model, const scree_pour_config *stage, int64_t source);

/// The pass that lets grains go which are due, at the begin of a step. Errors: memory; SCREE_ERROR_GUARD: a source has
/// been blocked for too long, a grain has fallen past everything.
scree_status scree_pour(const scree_context *context, scree_error *error);

/// Whether the pass needs the whole sample in this step (scree_pass.whole): for a birth, a look at the pile, grains
/// that are taken out, or an error that tells of bodies.
scree_status scree_pour_wants_all(const scree_context *context, bool *wanted, scree_error *error);

/// Whether there are grains, in any process, that have fallen past everything that stands. Errors: memory.
scree_status scree_pour_loses(const scree_context *context, bool *loses, scree_error *error) SCREE_MUST_USE;

/// Looks for grains that have fallen past everything that stands. Errors as above.
scree_status scree_pour_look_for_lost(const scree_context *context, const scree_pour_config *stage,
                                      scree_error *error) SCREE_MUST_USE;

#endif
