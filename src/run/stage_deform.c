/// Stage `deform`: imposes any components of the mean velocity gradient of the boundary, reached smoothly within
/// `rise_time`, under the pressure of the stage before; the others are free (boundary minimal; affine takes all).
/// Components of `velocity_gradient` are prescribed themselves, those of `strain_rate` for the mean of xy and yx.
///
/// Stop rule: the largest prescribed component, as the Delaunay boundary has been strained since the begin
/// (logarithmic, sum of increments), has reached `strain`. reference: run/stage.h, SCREE_LOADING_...
#include "boundary/minimal.h"
#include "measure/imposed_gradient.h"
#include "measure/measure.h"
#include "run/simulation.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

/// Target at full rate [1/s]. Returns the largest component.
static int find_target(const scree_config_stage *stage, double target[9], int64_t prescribed[9])
{
    int largest = 0;
    for (int c = 0; c < 9; c++) {
        bool full = !isnan(stage->velocity_gradient[c]), symmetric = !isnan(stage->strain_rate[c]);
        prescribed[c] = full ? SCREE_FULL : symmetric ? SCREE_SYMMETRIC : SCREE_FREE;
        target[c] = full ? stage->velocity_gradient[c] : symmetric ? stage->strain_rate[c] : 0;
        if (fabs(target[c]) > fabs(target[largest])) largest = c;
    }
    return largest;
}

static scree_status begin(scree_simulation *s, scree_error *error)
{
    (void)error;
    scree_imposed_gradient *drive = scree_imposed(&s->state);
    double target[9], penalty = s->model.config->boundary.penalty;
    scree_loading_begin(s);
    memset(drive->target, 0, sizeof drive->target);
    (void)find_target(scree_stage_config(s), target, drive->prescribed);
    drive->viscosity = isnan(penalty) ? scree_minimal_viscosity(scree_pressure_now(&s->state), target) : penalty;
    return SCREE_OK;
}

static void plan(scree_simulation *s)
{
    const scree_config_stage *stage = scree_stage_config(s);
    double target[9];
    int64_t prescribed[9];
    int largest = find_target(stage, target, prescribed);
    s->plan = scree_loading_plan(s, stage->strain / fabs(target[largest]));
}

static void control(scree_simulation *s)
{
    scree_imposed_gradient *drive = scree_imposed(&s->state);
    double loaded, rise = scree_loading_rise(s, &loaded);
    int64_t prescribed[9];
    (void)find_target(scree_stage_config(s), drive->target, prescribed);
    for (int c = 0; c < 9; c++) drive->target[c] *= rise;
}

/// The component of the stop rule as measured, in the sense of its target.
static double strain(const scree_simulation *s)
{
    double target[9], gradient[9];
    int64_t prescribed[9];
    int c = find_target(scree_stage_config(s), target, prescribed), mirror = 3 * (c % 3) + c / 3;
    scree_strain_measure(&s->state, gradient);
    for (int i = 0; i < 9; i++) gradient[i] -= s->state.stage.reference[SCREE_LOADING_STRAIN + i];
    double reached = prescribed[c] == SCREE_FULL ? gradient[c] : 0.5 * (gradient[c] + gradient[mirror]);
    return copysign(1, target[c]) * reached;
}

static scree_status finished(scree_simulation *s, bool *done, scree_error *error)
{
    double reached = strain(s);
    *done = reached >= scree_stage_config(s)->strain;
    (void)snprintf(s->reason, sizeof s->reason, "strain %.4g reached", reached);
    return *done ? SCREE_OK : scree_loading_check(s, error);
}

static double fraction(const scree_simulation *s)
{
    return strain(s) / scree_stage_config(s)->strain;
}

const scree_stage scree_stage_deform = {.name = "deform",
                                        .loading = true,
                                        .strain = strain,
                                        .begin = begin,
                                        .plan = plan,
                                        .control = control,
                                        .finished = finished,
                                        .fraction = fraction};
