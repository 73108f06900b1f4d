/// Speed of a case before it runs, by a few hundred of its own steps.
///
/// The probe is the case with at most MOST_DISCS or MOST_SPHERES bodies, everything else as it is: law, rolling,
/// boundary, cell. It has to stand as it will under load, since what touches is what costs:
/// - a packing that is made by dropping or on a lattice touches already, and is pressed together by the overlap that
///   the pressure will make;
/// - a gas that will be confined stands as a dropped packing between walls, which are then taken away, or become the
///   faces of the periodic cell: two bodies that touch opposite walls do not overlap across the face;
/// - a gas that falls among walls of the case stands as a pile between plates: what curved walls cost more, a sample
///   that falls and flows for a part of the time saves in contacts (runs take 1.1 and 0.8 of the estimate in the quick
///   forms of rotating-drum and hopper).
/// Times are processor times of this thread, the least of several blocks, so that other programs disturb little.
///
/// Limits: the cost of a body in a larger sample is scaled by run/estimate.c; a flow is seen at rest. Cost: some tenths
/// of a second.
#include "run/probe.h"
#include "state/plates.h"

#include "measure/cells.h"
#include "run/quasistatic.h"
#include "run/sample.h"
#include "run/step.h"
#include "search/neighbours.h"
#include "state/periodic.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>
#include <time.h>

enum {
    MOST_DISCS = 1500,
    MOST_SPHERES = 1000,
    BLOCKS = 8,        ///< repeats, of which the fastest counts
    REPEATS = 3,       ///< the same of what is not a step
    BLOCK_WORK = 60000 ///< steps of a block times bodies
};
/// Of the critical step.
#define STEP_FRACTION 0.2
/// Overlap that the probe may reach, in radii: it is pressed at once.
#define DEEP 0.9

static double processor_time(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

// ---- the smaller case --------------------------------------------------------------------------------------------

typedef struct probe_case {
    scree_case c;
    scree_simulation s;
    bool dropped; ///< in the place of a method without contacts, or of more bodies than it takes
    unsigned periodic;
} probe_case;

/// The box of the preparation shrinks with the number of bodies.
static void shrink_box(scree_config *config, scree_prepare_config *prepare, double count)
{
    double scale = pow(count / (double)config->particles.count, 1.0 / (double)config->dimension);
    config->particles.count = (int64_t)count;
    prepare->width *= scale;
    prepare->depth *= scale;
}

/// The boundary that stands on all sides without walls of the case.
static int box_boundary(void)
{
    int m = 0;
    while (!scree_modules[m]->boundary || !scree_modules[m]->boundary->stands ||
           scree_modules[m]->boundary->needs_walls)
        m++;
    return m;
}

/// Limits that belong to the true case do not stop the probe, and what is measured apart does not happen in its steps.
static scree_status make_case(const scree_case *c, probe_case *probe, scree_error *error)
{
    *probe = (probe_case){.c = *c};
    scree_config *config = &probe->c.config;
    scree_status status = scree_config_copy_stages(&c->config, &config->stages, error);
    if (status) return status;
    scree_prepare_config *prepare = config->stages[0].own;
    const scree_preparation *method = scree_modules[prepare->method]->preparation;
    double most = config->dimension == 3 ? MOST_SPHERES : MOST_DISCS;
    probe->dropped = method->loose || (method->given && (double)config->particles.count > most);
    if ((double)config->particles.count > most) shrink_box(config, prepare, most);
    for (int64_t k = 0; k < config->stage_count; k++) {
        void (*fit)(void *own, int64_t count) = scree_modules[config->stages[k].kind]->stage->shrink;
        if (fit) fit(config->stages[k].own, config->particles.count);
        if (config->wall_count > 0) config->stages[k].boundary = box_boundary();
    }
    config->wall_count = 0;
    config->guard.overlap = fmax(config->guard.overlap, DEEP);
    config->guard.energy_growth = INFINITY;
    config->guard.stability = SCREE_STABILITY_WARNS;
    // The smaller case is stable at another step.
    config->integrator.step = NAN;
    config->integrator.step_fraction = STEP_FRACTION;
    config->boundary.every = INT64_MAX / (INT64_C(1) << 32);
    return SCREE_OK;
}

// ---- as it will stand --------------------------------------------------------------------------------------------

/// The method that packs particles between walls.
static int dense_method(void)
{
    int m = 0;
    while (!scree_modules[m]->preparation || !scree_modules[m]->preparation->dense) m++;
    return m;
}

static scree_status prepare(probe_case *probe, scree_error *error)
{
    scree_simulation *s = &probe->s;
    scree_config *config = &probe->c.config;
    scree_prepare_config *stage = config->stages[0].own;
    scree_status status = scree_simulation_open(&probe->c, 1, s, error);
    probe->periodic = s->model.periodic;
    if (probe->dropped) {
        stage->method = dense_method();
        if (!(stage->aspect_ratio > 0)) stage->aspect_ratio = 1; // the method that it takes the place of has none
        s->model.periodic = 0;
    }
    if (!status) status = scree_simulation_step(s, error);
    s->model.periodic = probe->periodic;
    return status;
}

/// The box of a packing that was dropped between walls becomes the cell.
static void close_cell(const scree_model *model, unsigned periodic, scree_state *state)
{
    scree_vector low, high;
    scree_periodic_box(state->dimension, scree_plates(state), low, high);
    double side[3] = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
    scree_periodic_set(scree_cell(state), periodic, side);
    for (int w = 0; w < SCREE_WALL_COUNT; w++) {
        int axis = w / 2 == 0 ? model->dimension - 1 : w / 2 - 1;
        if (periodic >> axis & 1) scree_plates(state)[w].active = 0;
    }
}

static double overlap_of(const scree_elastic *elastic, const scree_pair_constants *pair, double radius, double force)
{
    return elastic->overlap(pair, radius, force);
}

/// Everything comes closer by the overlap [mean diameters] of a contact under `pressure`.
static void press(const scree_model *model, scree_state *state, double pressure)
{
    double diameter = 2 * model->mean_radius, width = model->dimension == 3 ? diameter : model->thickness;
    double overlap = scree_model_mean_of(model, overlap_of, 0.5 * model->mean_radius, pressure * diameter * width);
    double scale = 1 - fmin(overlap / diameter, 0.05);
    for (size_t row = 0; row < state->count; row++) {
        state->row[row].x *= scale;
        state->row[row].y *= scale;
        if (model->dimension == 3) state->row[row].z *= scale;
        scree_body_refer(state, row);
    }
    for (int w = 0; w < SCREE_WALL_COUNT; w++) scree_plates(state)[w].position *= scale;
    for (int k = 0; k < 9; k++)
        if (scree_cell(state)->directions >> (k % 3) & 1) scree_cell(state)->lattice[k] *= scale;
    memcpy(scree_cell(state)->reference, scree_cell(state)->lattice, sizeof scree_cell(state)->reference);
}

/// Bodies placed and pressed, in the stage that is to be measured.
static scree_status stand(probe_case *probe, int64_t stage, scree_error *error)
{
    scree_simulation *s = &probe->s;
    scree_status status = prepare(probe, error);
    if (status) return status;
    double pressure = scree_confining_pressure(&s->model, stage);
    if (probe->dropped && probe->periodic) close_cell(&s->model, probe->periodic, &s->state);
    if (pressure > 0 && s->state.count > 2) press(&s->model, &s->state, pressure);
    scree_pressure_set(&s->state, pressure > 0 ? pressure : 0);
    s->state.stage.index = stage;
    s->state.stage.counter = -1;
    scree_neighbours_invalidate(&s->work);
    return scree_stage_enter(s, false, error);
}

// ---- times -------------------------------------------------------------------------------------------------------

typedef scree_status probe_task(probe_case *probe, scree_error *error);

static scree_status renew_list(probe_case *probe, scree_error *error)
{
    scree_simulation *s = &probe->s;
    scree_neighbours_invalidate(&s->work);
    return scree_neighbours_refresh(&s->stage_model, &s->state, &s->work, error);
}

static scree_status renew_boundary(probe_case *probe, scree_error *error)
{
    scree_simulation *s = &probe->s;
    int64_t *every = &probe->c.config.boundary.every, kept = *every;
    *every = 0;
    scree_status status = scree_step_phase(s, SCREE_PHASE_SEARCH, error);
    *every = kept;
    return status;
}

static scree_status take_sample(probe_case *probe, scree_error *error)
{
    return scree_sample_take(&probe->s, error);
}

static scree_status measure_cells(probe_case *probe, scree_error *error)
{
    scree_simulation *s = &probe->s;
    scree_cells cells = {0};
    scree_status status = scree_cells_measure(&s->stage_model, &s->state, &s->table, &cells, error);
    scree_cells_destroy(&cells);
    return status;
}

static scree_status time_task(probe_case *probe, probe_task *task, double *seconds, scree_error *error)
{
    scree_status status = SCREE_OK;
    *seconds = INFINITY;
    for (int k = 0; k < REPEATS && !status; k++) {
        double begin = processor_time();
        status = task(probe, error);
        *seconds = fmin(*seconds, processor_time() - begin);
    }
    return status;
}

/// The least time [s] of a step in some blocks of them.
static scree_status time_steps(scree_simulation *s, double *seconds, scree_error *error)
{
    int steps = 1 + BLOCK_WORK / (int)(s->state.count + 100);
    scree_status status = SCREE_OK;
    *seconds = INFINITY;
    for (int block = 0; block < BLOCKS && !status; block++) {
        double begin = processor_time();
        for (int k = 0; k < steps && !status; k++) status = scree_step(s, error);
        *seconds = fmin(*seconds, (processor_time() - begin) / steps);
    }
    return status;
}

static scree_status time_all(probe_case *small, scree_probe *probe, scree_error *error)
{
    scree_simulation *s = &small->s;
    scree_status status = time_steps(s, &probe->step, error);
    if (!status) status = time_task(small, renew_list, &probe->rebuild, error);
    if (!status) status = time_task(small, renew_boundary, &probe->upkeep, error);
    if (!status) status = time_task(small, take_sample, &probe->sample, error);
    if (status || !small->c.config.measure.cells || scree_cell(&s->state)->directions) return status;
    status = time_task(small, measure_cells, &probe->cells, error);
    // A few bodies have no cells.
    if (status) probe->cells = 0;
    return status == SCREE_ERROR_GUARD ? SCREE_OK : status;
}

scree_status scree_probe_measure(const scree_case *c, int64_t stage, scree_probe *probe, scree_error *error)
{
    probe_case small;
    *probe = (scree_probe){.collision = NAN};
    scree_status status = make_case(c, &small, error);
    if (status) return status;
    double begin = processor_time();
    status = stand(&small, stage, error);
    probe->preparation = processor_time() - begin;
    probe->count = (double)scree_grain_count(&small.s.state);
    double (*expected)(const scree_simulation *s) = scree_modules[c->config.stages[stage].kind]->stage->expected;
    if (!status && expected) probe->collision = expected(&small.s);
    if (!status) status = time_all(&small, probe, error);
    scree_simulation_close(&small.s);
    scree_release(&small.c.config.stages);
    return status;
}
