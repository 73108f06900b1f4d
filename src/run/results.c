/// The named scalars of summary.json, computed from the whole series.
///
/// Over the last loading stage: peak of the stress ratio, as a running mean over SMOOTHING of axial strain, and its
/// strain; mean stress ratio over the last fifth of the strain; largest compaction and dilation relative to the begin
/// of loading (dilation positive), and their strains; mean slip, and that of the begin, up to a strain of INITIAL
/// without the sample at rest (`initial_slip_ratio`); disagreement of the axial stress of plates and contacts, of the
/// means over the stage
/// (`stress_disagreement`) and as the mean of the instantaneous differences, which holds the inertia of the waves
/// (`stress_disagreement_instant`); `shear_strain_reached`, the engineering shear strain of the first and the last
/// axis; with imposed rates, mean, least and largest ratio of actual and imposed rate (`rate_ratio_...`, of the
/// intervals between two samples) from STARTED of the strain on. Over the loading, from the bodies:
/// `corner_distortion`, `boundary_roughness` (files of these names in measure/); and what it
/// cost. Over the whole run: largest residual of the energy balance over the energy at the begin and the work turned
/// over by the end
/// (`energy_residual`). Of each wall of the case `NAME_work`, `NAME_force`, `NAME_torque`.
#include "run/results.h"

#include "io/run_directory.h"
#include "io/summary.h"
#include "measure/measure.h"
#include "run/cell_results.h"
#include "run/rotation_results.h"
#include "run/sample.h"
#include "run/stage_collide.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#define SMOOTHING 0.01
#define STARTED   0.05
#define INITIAL   0.01

/// The rows of the last loading stage.
typedef struct loading {
    const double *time, *strain, *ratio, *volumetric, *plates, *contacts, *slip, *coordination, *rate, *shear;
    size_t first, last; ///< rows [first, last)
} loading;

/// The rows of the last stage; false when there are less than two.
static bool find_rows(const scree_series *series, loading *l)
{
    const double *stage = scree_series_get(series, "stage");
    *l = (loading){.time = scree_series_get(series, "time"),
                   .strain = scree_series_get(series, "axial_strain"),
                   .ratio = scree_series_get(series, "stress_ratio"),
                   .volumetric = scree_series_get(series, "volumetric_strain"),
                   .plates = scree_series_get(series, "stress_axial_plates"),
                   .contacts = scree_series_get(series, "stress_axial_contacts"),
                   .slip = scree_series_get(series, "slip_ratio"),
                   .coordination = scree_series_get(series, "coordination"),
                   .rate = scree_series_get(series, "rate_ratio"),
                   .shear = scree_series_get(series, "boundary_shear_strain"),
                   .last = series->row_count};
    for (l->first = l->last; l->first > 0 && stage[l->first - 1] == stage[l->last - 1]; l->first--) continue;
    return l->last - l->first > 1;
}

static bool find_loading(const scree_series *series, loading *l)
{
    return find_rows(series, l) && !isnan(l->strain[l->last - 1]);
}

/// Mean of the stress ratio over the rows whose strain lies within half of SMOOTHING of row k.
static double smoothed_ratio(const loading *l, size_t k)
{
    double sum = l->ratio[k], count = 1, half = 0.5 * SMOOTHING;
    for (size_t j = k; j > l->first && l->strain[k] - l->strain[j - 1] <= half; j--, count++) sum += l->ratio[j - 1];
    for (size_t j = k + 1; j < l->last && l->strain[j] - l->strain[k] <= half; j++, count++) sum += l->ratio[j];
    return sum / count;
}

static void summarise_peak(const loading *l, scree_summary *summary)
{
    double peak = -INFINITY, strain_at_peak = NAN, final_ratio = 0, end = l->strain[l->last - 1];
    size_t final_count = 0;
    for (size_t k = l->first; k < l->last; k++) {
        double ratio = smoothed_ratio(l, k);
        if (ratio > peak) {
            peak = ratio;
            strain_at_peak = l->strain[k];
        }
        if (l->strain[k] < 0.8 * end) continue;
        final_ratio += l->ratio[k];
        final_count++;
    }
    scree_summary_set_number(summary, "peak_stress_ratio", peak);
    scree_summary_set_number(summary, "strain_at_peak", strain_at_peak);
    scree_summary_set_number(summary, "final_stress_ratio", final_ratio / (double)final_count);
}

/// Ratio of actual and imposed rate once the rate is up; nothing without minimal conditions.
static void summarise_rate(const loading *l, scree_summary *summary)
{
    double least = INFINITY, most = -INFINITY, sum = 0;
    size_t rows = 0;
    for (size_t k = l->first; k < l->last; k++) {
        if (isnan(l->rate[k]) || l->strain[k] < STARTED * l->strain[l->last - 1]) continue;
        least = fmin(least, l->rate[k]);
        most = fmax(most, l->rate[k]);
        sum += l->rate[k];
        rows++;
    }
    if (rows == 0) return;
    scree_summary_set_number(summary, "rate_ratio_mean", sum / (double)rows);
    scree_summary_set_number(summary, "rate_ratio_min", least);
    scree_summary_set_number(summary, "rate_ratio_max", most);
}

/// Mean over the begin of loading: strains up to INITIAL, the sample at rest left out.
static double initial_slip(const loading *l)
{
    double sum = 0, rows = 0;
    for (size_t k = l->first + 1; k < l->last && (rows == 0 || l->strain[k] <= INITIAL); k++, rows++) sum += l->slip[k];
    return sum / rows;
}

static void summarise_loading(const loading *l, scree_summary *summary)
{
    double compaction = 0, dilation = 0, strain_at_compaction = NAN, strain_at_dilation = NAN;
    double slip = 0, plates = 0, contacts = 0, apart = 0;
    double rows = (double)(l->last - l->first);
    for (size_t k = l->first; k < l->last; k++) {
        if (l->volumetric[k] > compaction) {
            compaction = l->volumetric[k];
            strain_at_compaction = l->strain[k];
        }
        if (-l->volumetric[k] > dilation) {
            dilation = -l->volumetric[k];
            strain_at_dilation = l->strain[k];
        }
        slip += l->slip[k] / rows;
        plates += l->plates[k];
        contacts += l->contacts[k];
        apart += fabs(l->contacts[k] - l->plates[k]);
    }
    scree_summary_set_number(summary, "axial_strain", l->strain[l->last - 1]);
    scree_summary_set_number(summary, "shear_strain_reached", fabs(l->shear[l->last - 1]));
    summarise_peak(l, summary);
    summarise_rate(l, summary);
    scree_summary_set_number(summary, "max_volumetric_compaction", compaction);
    scree_summary_set_number(summary, "max_volumetric_dilation", dilation);
    scree_summary_set_number(summary, "strain_at_max_compaction", strain_at_compaction);
    scree_summary_set_number(summary, "strain_at_max_dilation", strain_at_dilation);
    scree_summary_set_number(summary, "stress_disagreement", fabs(contacts / plates - 1));
    scree_summary_set_number(summary, "stress_disagreement_instant", apart / plates);
    scree_summary_set_number(summary, "mean_slip_ratio", slip);
    scree_summary_set_number(summary, "initial_slip_ratio", initial_slip(l));
    scree_summary_set_number(summary, "coordination_at_start", l->coordination[l->first]);
}

static void summarise_series(const scree_series *series, double turnover, scree_summary *summary)
{
    loading l;
    if (find_loading(series, &l)) summarise_loading(&l, summary);
    const double *residual = scree_series_get(series, "energy_residual");
    double largest = 0;
    for (size_t k = 0; k < series->row_count; k++) largest = fmax(largest, fabs(residual[k]));
    if (turnover > 0) scree_summary_set_number(summary, "energy_residual", largest / turnover);
    if (series->row_count == 0) return;
    static const char *const finals[] = {"coordination", "coordination_without_rattlers", "rattler_fraction",
                                         "solid_fraction", "unbalanced_ratio"};
    for (size_t k = 0; k < sizeof finals / sizeof *finals; k++)
        scree_summary_set_number(summary, finals[k], scree_series_get(series, finals[k])[series->row_count - 1]);
}

static void summarise_run(const scree_recorder *recorder, scree_simulation *s, scree_status status,
                          scree_summary *summary)
{
    const scree_config *config = s->model.config;
    char checksum[32];
    (void)snprintf(checksum, sizeof checksum, "%016" PRIx64, scree_state_checksum(&s->model, &s->state));
    double steps = (double)(s->state.evaluations - recorder->first_evaluations);
    scree_summary_set_text(summary, "case", config->name);
    scree_summary_set_text(summary, "status",
                           status == SCREE_OK            ? "done"
                           : status == SCREE_INTERRUPTED ? "interrupted"
                                                         : "stopped");
    scree_summary_set_text(summary, "version", scree_version());
    scree_summary_set_integer(summary, "seed", config->seed);
    scree_summary_set_integer(summary, "particles", (int64_t)s->state.grains);
    scree_summary_set_integer(summary, "steps", (int64_t)s->state.step);
    scree_summary_set_integer(summary, "force_evaluations", (int64_t)s->state.evaluations);
    scree_summary_set_integer(summary, "n_s", (int64_t)s->model.largest_step);
    scree_summary_set_number(summary, "step_size", s->state.tick);
    scree_summary_set_number(summary, "critical_step", s->model.critical_step);
    scree_summary_set_number(summary, "time", scree_state_time(&s->state));
    scree_summary_set_number(summary, "phi", s->model.phi);
    scree_summary_set_number(summary, "psi", s->model.psi);
    scree_summary_set_number(summary, "reference_velocity", s->model.reference_velocity);
    scree_summary_set_number(summary, "thickness", s->model.thickness);
    scree_summary_set_text(summary, "state_checksum", checksum);
    scree_summary_set_integer(summary, "threads", s->work.threads);
    scree_summary_set_number(summary, "wall_time", s->state.spent.run);
    scree_summary_set_number(summary, "particle_steps_per_second", steps * (double)s->state.count / recorder->stepping);
    scree_summary_set_integer(summary, "neighbour_rebuilds", (int64_t)s->work.rebuilds);
}

/// Work and last force and torque, in magnitude, of each wall of the case.
static void summarise_walls(const scree_simulation *s, scree_summary *summary)
{
    const scree_config *config = s->model.config;
    for (int64_t w = 0; w < config->wall_count; w++) {
        const scree_surface_load *load = &s->state.surface[w];
        char name[96];
        (void)snprintf(name, sizeof name, "%s_work", config->walls[w].name);
        scree_summary_set_number(summary, name, load->work);
        (void)snprintf(name, sizeof name, "%s_force", config->walls[w].name);
        scree_summary_set_number(summary, name, scree_length(load->force));
        (void)snprintf(name, sizeof name, "%s_torque", config->walls[w].name);
        scree_summary_set_number(summary, name, scree_length(load->torque));
    }
}

/// What the last stage cost.
static void summarise_cost(const scree_simulation *s, scree_summary *summary)
{
    const scree_state *state = &s->state;
    scree_summary_set_integer(summary, "loading_force_evaluations",
                              (int64_t)(state->evaluations - state->stage.first_evaluations));
    scree_summary_set_number(summary, "loading_wall_time", state->spent.stage);
    scree_summary_set_number(summary, "loading_processor_time", state->spent.processor);
}

/// What the shape of the sample has become under a stage that loaded it without plates.
static scree_status summarise_shape(const scree_simulation *s, scree_summary *summary, scree_error *error)
{
    double value;
    scree_status status = SCREE_OK;
    if (s->model.config->stages[0].outline == SCREE_SAMPLE_BOX) {
        status = scree_corner_distortion(&s->model, &s->state, &value, error);
        if (!status) scree_summary_set_number(summary, "corner_distortion", value);
    } else if (s->state.dimension == 2) {
        status = scree_boundary_roughness(&s->model, &s->state, &value, error);
        if (!status) scree_summary_set_number(summary, "boundary_roughness", value);
    }
    return status;
}

/// The last stage, when it is one of loading.
static scree_status summarise_stage(const scree_simulation *s, scree_summary *summary, scree_error *error)
{
    const scree_config *config = s->model.config;
    int64_t last = config->stage_count - 1;
    const scree_stage *stage =
        scree_stage_get((scree_stage_kind)config->stages[last].kind, scree_model_is_wholly_periodic(&s->model));
    if (s->state.stage.index < last || s->state.count == 0 || !stage->loading) return SCREE_OK;
    summarise_cost(s, summary);
    bool plates = scree_boundary_has_plates(scree_boundary_get(scree_config_boundary_of(config, last)));
    bool strained = !isnan(scree_model_loading_rate(&config->stages[last]));
    bool cornered = strained && !plates && !s->state.periodic.directions;
    return cornered ? summarise_shape(s, summary, error) : SCREE_OK;
}

scree_status scree_results_write(const scree_recorder *recorder, scree_simulation *s, scree_status status,
                                 scree_error *error)
{
    char path[4096];
    scree_series series = {0};
    scree_summary *summary = NULL;
    scree_status result = scree_path_join(path, sizeof path, recorder->directory, SCREE_FILE_SERIES, error);
    if (!result) result = scree_series_read(&series, path, error);
    if (!result) result = scree_contacts_save(&s->state, &s->work, error); // for the checksum
    if (!result) result = scree_summary_create(&summary, error);
    if (!result) {
        summarise_run(recorder, s, status, summary);
        summarise_series(&series, s->state.ledger.turnover + s->state.ledger.initial, summary);
        summarise_walls(s, summary);
        result = summarise_stage(s, summary, error);
    }
    if (!result && s->model.config->measure.cells && !s->state.periodic.directions)
        result = scree_cell_results_write(recorder->directory, s->model.config, &series, summary, error);
    if (!result) result = scree_collide_results(s, summary, error);
    if (!result) result = scree_rotation_results(recorder->directory, s, summary, error);
    if (!result) result = scree_path_join(path, sizeof path, recorder->directory, SCREE_FILE_SUMMARY, error);
    if (!result) result = scree_summary_write(summary, path, error);
    scree_summary_destroy(summary);
    scree_series_destroy(&series);
    return result;
}
