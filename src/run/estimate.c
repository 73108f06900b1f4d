/// Steps, time and memory of a run before it runs.
///
/// Steps: loading and resting stages are planned by time (run/loading.c), an impact by theory; a confinement is known
/// only by experience (run/stage_confine.c). Time: steps at the probed speed
/// (run/probe.c), which falls with the memory that a step goes through; new neighbour lists and boundaries; samples
/// and cells at their probed times; what is written and drawn by the constants below. Memory: bytes a body, of what
/// a run does, on top of the libraries.
///
/// The constants are of 22 and 23 November 2026, processor times of one thread of a loaded 2-core machine, resident
/// sets by /usr/bin/time: 50,000 discs, 20,000 spheres and 100 discs, with and without each kind of output, and the
/// built-in cases in their quick forms. bench/check_estimates.sh compares estimates with runs.
///
/// Limits: one thread; a stage that ends when the sample is at rest counts in full; times of files assume a local
/// disk.
#include "run/estimate.h"

#include "model/critical_step.h"
#include "module/wall_shape.h"
#include "run/quasistatic.h"

#include <math.h>

/// Of two and three dimensions.
typedef struct expense {
    double file, body;      ///< s: a snapshot, each of its bodies
    double cell_file, cell; ///< s: the same of its cells, without finding them
    double paraview_file, paraview_body;
    double step_bytes, cell_bytes, figure_bytes; ///< a body
    double live_bytes;                           ///< a body, that a step goes through
    double rank_bytes;                           ///< a body of its part, in a process that does not write
} expense;
static const expense expenses[2] = {
    {7e-3, 1e-6, 6e-3, 2e-6, 5e-3, 1.2e-6, 1100, 930, 6200, 319, 720},
    {7e-3, 2e-6, 6e-3, 8e-6, 5e-3, 6e-6, 1560, 3960, 4500, 488, 1280},
};
/// What comes with MPI: libraries and buffers of a process, of the one that writes; a body while arrays are gathered.
/// Of 28 November 2026, 1 and 4 processes with 1700 to 19,900 bodies on lattices with 2 and 3 contacts a body.
#define MPI_BYTES        4e6
#define MPI_WRITER_BYTES 10.5e6
#define GATHERED_BYTES   80.0
#define START            0.07  /* s: libraries, case, folder */
#define ROW              2e-5  /* s: a row of series.csv */
#define CHART            0.13  /* s: gnuplot */
#define SCENE            0.15  /* s: a scene and its pixels */
#define SCENE_BODY       2e-5  /* s: a body in a scene */
#define END_OF_CELLS     2.0   /* snapshots' cells: their results at the end of a run */
#define PROGRAM_BYTES    28e6  /* the libraries that a run needs */
#define SNAPSHOT_BYTES   0.1e6 /* a snapshot while run.h5 is gathered, */
#define GATHER_BYTES     1e6   /* and the most of all of them beside those of their bodies */
#define FIGURE_BYTES     12e6  /* of all figures, and of each scene */
#define SCENE_BYTES      0.5e6
/// s: a contact with a wall that only space has (curved, or a mesh), which the probe does without; bodies that have
/// one: the outermost layers of a sample.
#define CURVED_CONTACT 0.1e-6
#define CURVED_LAYERS  4.0
/// Steps between two neighbour lists: quick forms 300 to 2900 under load, 75 to 160 falling and flowing.
#define LIST_STEPS_LOADED  1000.0
#define LIST_STEPS_FALLING 100.0
/// A particle-step of a million discs costs 1.1 to 1.5 times one in cache (docs/performance.md), 256,000 spheres 1.4.
#define CACHE_BYTES  2e6
#define CACHE_FACTOR 0.08 /* for every e-fold of memory beyond */

// ---- steps -------------------------------------------------------------------------------------------------------

/// Force evaluations a tick while loading.
static double evaluations_a_tick(const scree_model *model)
{
    return (double)(1 + model->small_steps) / (double)(model->large_multiple + model->small_steps);
}

static double wave_time(const scree_model *model, int64_t index)
{
    double pressure = scree_confining_pressure(model, index);
    return pressure > 0 ? scree_expected_wave_time(model, pressure) : 0;
}

/// Time [s] of a stage that is planned; `wave` [s].
static double planned_time(const scree_model *model, const scree_config_stage *config, double wave, double collision)
{
    const scree_stage *stage = scree_modules[config->kind]->stage;
    if (stage->expected && !isnan(collision)) return collision;
    return stage->planned ? stage->planned(model, config->own, wave) : 0;
}

static const scree_stage *face_of(const scree_config_stage *stage)
{
    return scree_modules[stage->kind]->stage;
}

scree_stage_cost scree_stage_expect(const scree_model *model, int64_t index, double collision)
{
    const scree_config_stage *stage = &model->stages[index];
    double wave = wave_time(model, index), time = planned_time(model, stage, wave, collision);
    double share = face_of(stage)->loading ? evaluations_a_tick(model) : 1 / (double)model->largest_step;
    scree_stage_cost cost = {.steps = isnan(time) ? 0 : time / model->step * share, .snapshots = 1};
    if (face_of(stage)->loading) cost.snapshots += 1 + (double)model->output.snapshots;
    if (face_of(stage)->samples_a_wave > 0)
        cost.samples = wave > 0 ? face_of(stage)->samples_a_wave * time / wave : 0;
    else
        cost.samples = fmin(cost.steps, (double)model->measure.samples);
    return cost;
}

int64_t scree_longest_stage(const scree_model *model)
{
    int64_t longest = model->stage_count > 1 ? 1 : 0;
    for (int64_t k = 2; k < model->stage_count; k++)
        if (scree_stage_expect(model, k, NAN).steps > scree_stage_expect(model, longest, NAN).steps) longest = k;
    return longest;
}

// ---- figures -----------------------------------------------------------------------------------------------------

/// Scenes that are drawn (view/figures.c), and charts.
static double scenes_of(const scree_model *model, double *charts)
{
    bool strained = false, cells = model->measure.cells && !model->periodic;
    for (int64_t k = 0; k < model->stage_count; k++)
        strained = strained || (face_of(&model->stages[k])->loading && face_of(&model->stages[k])->quasistatic);
    double windows = model->measure.window_count > 0 ? (double)model->measure.window_count : 2;
    *charts = strained ? 10 : 0;
    if (!model->output.figures) return *charts = 0;
    return 5 + (cells ? 5 : 0) + (strained ? 1 + windows : 0) + (strained && cells ? 4 + windows : 0);
}

// ---- time --------------------------------------------------------------------------------------------------------

/// How much more a particle-step costs with `count` bodies than in the probe.
static double cache_factor(const scree_model *model, double count)
{
    double bytes = count * expenses[model->dimension == 3].live_bytes;
    return 1 + CACHE_FACTOR * log(fmax(1, bytes / CACHE_BYTES));
}

/// s a step: contacts with curved walls and meshes, for which the probe has plates.
static double curved_time(const scree_model *model)
{
    bool curved = false;
    for (int64_t k = 0; k < model->wall_count; k++)
        curved = curved || scree_modules[model->walls_of_case[k].shape]->wall->only_3d;
    double count = (double)model->count;
    return curved ? CURVED_CONTACT * fmin(count, CURVED_LAYERS * pow(count, 1 - 1.0 / model->dimension)) : 0;
}

/// s a step.
static double step_time(const scree_model *model, const scree_probe *probe, double scale)
{
    double count = probe->count * scale, cache = cache_factor(model, count) / cache_factor(model, probe->count);
    bool falls = model->wall_count > 0;
    double list = probe->rebuild * scale / (falls ? LIST_STEPS_FALLING : LIST_STEPS_LOADED);
    double every = (double)model->upkeep.every * evaluations_a_tick(model);
    return probe->step * scale * cache + list + probe->upkeep * scale / every + curved_time(model);
}

/// s: a snapshot, ParaView's files and its share of the gathering included; `cells` out: the part that cells take.
static double snapshot_time(const scree_model *model, const scree_probe *probe, double scale, double *cells)
{
    const expense *e = &expenses[model->dimension == 3];
    double count = probe->count * scale;
    *cells = probe->cells > 0 ? probe->cells * scale + e->cell_file + e->cell * count : 0;
    double paraview = model->output.paraview ? e->paraview_file + e->paraview_body * count : 0;
    return e->file + e->body * count + *cells + paraview;
}

void scree_run_expect(const scree_model *model, const scree_probe *probe, bool looks_at_samples, scree_run_cost *cost)
{
    double count = (double)model->count, scale = count / probe->count, cells, charts;
    const bool at_snapshots = model->output.paraview || (model->measure.cells && !model->periodic);
    double snapshot = snapshot_time(model, probe, scale, &cells);
    *cost = (scree_run_cost){.output = START + END_OF_CELLS * cells, .memory = scree_memory_expect(model)};
    for (int64_t k = 0; k < model->stage_count; k++) {
        scree_stage_cost stage = scree_stage_expect(model, k, probe->collision);
        cost->steps += stage.steps;
        cost->output += stage.samples * (probe->sample * scale + ROW) + stage.snapshots * snapshot;
        cost->lists +=
            ((looks_at_samples ? stage.samples : 0) + (at_snapshots ? stage.snapshots : 0)) * probe->rebuild * scale;
    }
    cost->preparation = probe->preparation * scale;
    cost->stepping = cost->steps * step_time(model, probe, scale) + cost->preparation;
    cost->rate = count / step_time(model, probe, scale);
    double scenes = scenes_of(model, &charts);
    cost->figures = charts * CHART + scenes * (SCENE + SCENE_BODY * count);
}

// ---- memory ------------------------------------------------------------------------------------------------------

double scree_memory_expect(const scree_model *model)
{
    const expense *e = &expenses[model->dimension == 3];
    double charts, scenes = scenes_of(model, &charts), snapshots = 0;
    // Cells are gone when figures are drawn.
    double cells = model->measure.cells && !model->periodic ? e->cell_bytes : 0;
    double body = e->step_bytes + fmax(cells, scenes > 0 ? e->figure_bytes : 0);
    for (int64_t k = 0; k < model->stage_count; k++) snapshots += scree_stage_expect(model, k, NAN).snapshots;
    double figures = model->output.figures ? FIGURE_BYTES + SCENE_BYTES * scenes : 0;
    return PROGRAM_BYTES + fmin(snapshots * SNAPSHOT_BYTES, GATHER_BYTES) + figures + body * (double)model->count;
}

double scree_rank_memory_expect(const scree_model *model, double bodies, double ghosts, bool root)
{
    const expense *e = &expenses[model->dimension == 3];
    const double known = e->step_bytes * ghosts;
    if (root) return scree_memory_expect(model) + MPI_WRITER_BYTES + GATHERED_BYTES * (double)model->count + known;
    return PROGRAM_BYTES + MPI_BYTES + e->rank_bytes * bodies + known;
}
