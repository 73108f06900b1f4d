/// Whether the stages that mean to be quasistatic (confine, compress, deform, rotate_particle) are: what a case says
/// before it runs, what its samples show, and the words for both. Formulas and limits: theory/quasistatic.c.
#ifndef SCREE_RUN_QUASISTATIC_H
#define SCREE_RUN_QUASISTATIC_H

#include "base/log.h"
#include "io/series.h"
#include "io/summary.h"
#include "run/simulation_data.h"
#include "theory/quasistatic.h"

/// The numbers of one stage; NAN where there is none.
typedef struct scree_quasistatic {
    int64_t stage;   ///< index in the case
    double rate;     ///< 1/s, that it imposes
    double pressure; ///< Pa, that it holds, or of the last stage before it that held one
    double value[SCREE_QUASISTATIC_COUNT];
} scree_quasistatic;

/// What the model says of stage `index` before it runs: at the full rate, under the confining pressure, for a sample as
/// wide and high as expected. All NAN when the stage does not mean to be quasistatic.
scree_quasistatic scree_quasistatic_expect(const scree_model *model, int64_t index);

/// "stage 2 (compress): inertial number 0.0023, above 0.001" and, with `advice`, what to change. False, and nothing
/// written, when the number keeps its limit.
bool scree_quasistatic_explain(const scree_model *model, const scree_quasistatic *q,
                               scree_quasistatic_criterion criterion, bool advice, char *text, size_t size);

/// One warning for each limit that the case will not keep.
void scree_quasistatic_warn(const scree_model *model, scree_log *log);

/// Kinetic over elastic energy in the samples of a stage so far.
typedef struct scree_quasistatic_watch {
    int64_t stage;
    double kinetic, elastic; ///< J, sums over the samples
    size_t samples;
    bool warned;
} scree_quasistatic_watch;

/// After every sample: warns once a stage, at its end, or of a loading when a tenth of its samples show twice the
/// limit.
void scree_quasistatic_follow(scree_quasistatic_watch *watch, const scree_simulation *s, scree_log *log);

/// Inertial number now: of the rate imposed now, under the confining pressure or `mean_stress` [Pa] of the contacts,
/// whichever is less. NAN in a stage that imposes no rate.
double scree_quasistatic_inertial_now(const scree_simulation *s, double mean_stress);

/// The pressure [Pa] that stage `index` holds, or the last one before it that held one; NAN: none.
double scree_confining_pressure(const scree_model *model, int64_t index);

/// Time [s] that a wave needs through the longer side of the sample that a case will have under `pressure` [Pa].
double scree_expected_wave_time(const scree_model *model, double pressure);

/// `inertial_number` and `kinetic_over_elastic` of the last stage that means to be quasistatic, `quasistatic` (yes or
/// no) and `quasistatic_reason` of all of them. Nothing when there is none in the series.
void scree_quasistatic_results(const scree_model *model, const scree_series *series, scree_summary *summary);

#endif
