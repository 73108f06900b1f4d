/// The named scalars of summary.json, computed from the whole series.
///
/// Over the loading stage (io/loading_stage.h), whatever comes after it: peak of the stress ratio and its strain; mean
/// stress ratio over the last fifth of the strain (both not of a periodic cell that is sheared); largest compaction and
/// dilation relative to the begin of loading (dilation positive), and their strains; mean slip, and that of the begin,
/// up to a strain of INITIAL without the sample at rest (`initial_slip_ratio`); disagreement of the axial stress of
/// plates and contacts, of the means over the stage
/// (`stress_disagreement`) and as the mean of the instantaneous differences, which holds the inertia of the waves
/// (`stress_disagreement_instant`); `shear_strain_reached`, the engineering shear strain of the first and the last
/// axis; with imposed rates, mean, least and largest ratio of actual and imposed rate (`rate_ratio_...`, of the
/// intervals between two samples) from STARTED of the strain on. What it cost, and from the bodies `corner_distortion`
/// and `boundary_roughness` (files of these names in measure/), as long as no other stage has begun; in a case that
/// strains nothing the cost is that of the last stage. Over the whole run: largest residual of the energy balance over
/// the scale of the guard (measure/energy.c) at the end (`energy_residual`).
/// What springs were given by the change of their stiffness, over the energy at the begin and the work turned over, is
/// `stiffness_share`.
#include "run/results.h"
#include "state/periodic.h"

#include "io/loading_stage.h"
#include "io/run_directory.h"
#include "io/summary.h"
#include "measure/measure.h"
#include "run/conclusion.h"
#include "run/quasistatic.h"
#include "run/sample.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#define STARTED 0.05
#define INITIAL 0.01

/// The rows of the loading stage.
typedef struct loading {
    const double *time, *strain, *ratio, *volumetric, *plates, *contacts, *slip, *coordination, *rate, *shear, *axial;
    size_t first, last;      ///< rows [first, last)
    scree_loading_path path; ///< of all loading stages
} loading;

/// False when there are less than two.
static bool find_loading(const scree_series *series, loading *l)
{
    scree_loading_rows rows = scree_loading_rows_find(series);
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
                   .axial = scree_series_get(series, "boundary_axial_strain"),
                   .first = rows.first,
                   .last = rows.last,
                   .path = scree_loading_path_find(series)};
    return l->last - l->first > 1;
}

static void summarise_peak(const loading *l, scree_summary *summary)
{
    double final_ratio = 0, final_count = 0, end = l->strain[l->last - 1];
    scree_peak peak = scree_peak_find(l->ratio, l->path.strain, l->path.rows);
    for (size_t k = l->first; k < l->last; k++) {
        if (l->strain[k] < 0.8 * end) continue;
        final_ratio += l->ratio[k];
        final_count++;
    }
    scree_summary_set_number(summary, "peak_stress_ratio", peak.value);
    scree_summary_set_number(summary, "strain_at_peak", peak.strain);
    scree_summary_set_number(summary, "final_stress_ratio", final_ratio / final_count);
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

/// The volumetric strains beside each other: at the end, and the largest dilation by the solid fraction.
static void summarise_volume(const loading *l, const scree_series *series, scree_summary *summary)
{
    static const char *const names[] = {"volumetric_strain", "volumetric_strain_redetected",
                                        "volumetric_strain_enclosed", "volumetric_strain_solid"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        char name[64];
        (void)snprintf(name, sizeof name, "final_%s", names[k]);
        scree_summary_set_number(summary, name, scree_series_get(series, names[k])[l->last - 1]);
    }
    const double *solid = scree_series_get(series, "volumetric_strain_solid");
    double dilation = 0;
    for (size_t k = l->first; k < l->last; k++) dilation = fmax(dilation, -solid[k]);
    scree_summary_set_number(summary, "max_volumetric_dilation_solid", dilation);
}

/// A periodic cell that is sheared: axial over lateral stress says nothing of it, mu does (run/stress_path.c).
static bool is_sheared_cell(const loading *l, const scree_state *state)
{
    return scree_periodic_is_whole(state) && fabs(l->shear[l->last - 1]) > 2 * fabs(l->axial[l->last - 1]);
}

static void summarise_loading(const loading *l, const scree_state *state, scree_summary *summary)
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
    if (!is_sheared_cell(l, state)) summarise_peak(l, summary);
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

double scree_results_stiffness_share(const scree_state *state)
{
    double scale = state->ledger.turnover + state->ledger.initial;
    return scale > 0 ? state->ledger.stiffness / scale : 0;
}

/// Friction of the last confinement: its own, or that of the material; NAN without one, or with several materials.
static double confine_friction(const scree_model *model)
{
    for (int64_t k = model->stage_count - 1; k >= 0; k--) {
        if (!scree_modules[model->stages[k].kind]->numbers->settles) continue;
        if (!isnan(model->stages[k].friction)) return model->stages[k].friction;
        return model->material_count == 1 ? model->pairs[0][0].value[SCREE_FRICTION] : NAN;
    }
    return NAN;
}

/// The first row of the last stage; the number of rows where it has less than two.
static size_t first_of_last_stage(const scree_series *series)
{
    const double *stage = scree_series_get(series, "stage");
    size_t last = series->row_count, first = last;
    while (first > 0 && stage[first - 1] == stage[last - 1]) first--;
    return last - first < 2 ? last : first;
}

/// What the last stage begins with: two runs of the same seed had the same sample if and only if it is the same to all
/// digits. (The coordination may differ: the boundary of the last stage may have no plates.)
static void summarise_start(const scree_series *series, const scree_model *model, scree_summary *summary)
{
    const size_t first = first_of_last_stage(series);
    scree_summary_set_number(summary, "confine_friction", confine_friction(model));
    if (first == series->row_count) return;
    scree_summary_set_number(summary, "solid_fraction_at_start", scree_series_get(series, "solid_fraction")[first]);
}

/// The coordination that the last stage begins with, of a sample that is loaded without being strained; a heap, which
/// has no boundary and so no solid fraction, is not loaded.
static void summarise_unstrained(const scree_series *series, scree_summary *summary)
{
    const size_t first = first_of_last_stage(series);
    if (first == series->row_count || isnan(scree_series_get(series, "solid_fraction")[first])) return;
    scree_summary_set_number(summary, "coordination_at_start", scree_series_get(series, "coordination")[first]);
}

/// The contacts of now: the last sample may be older than the end, or from before a restart.
static scree_status summarise_energy(const scree_series *series, scree_simulation *s, scree_summary *summary,
                                     scree_error *error)
{
    const double *residual = scree_series_get(series, "energy_residual");
    double largest = 0;
    for (size_t k = 0; k < series->row_count; k++) largest = fmax(largest, fabs(residual[k]));
    scree_energy energy;
    scree_status status = SCREE_OK;
    if (s->work.valid) status = scree_contact_table_build(&s->stage_model, &s->state, &s->work, &s->table, error);
    if (status) return status;
    scree_energy_measure(&s->stage_model, &s->state, &s->table, &energy);
    if (energy.scale > 0) scree_summary_set_number(summary, "energy_residual", largest / energy.scale);
    return SCREE_OK;
}

static void summarise_series(const scree_series *series, const scree_state *state, scree_summary *summary)
{
    loading l;
    if (find_loading(series, &l)) {
        summarise_loading(&l, state, summary);
        summarise_volume(&l, series, summary);
    } else {
        summarise_unstrained(series, summary);
    }
    if (series->row_count == 0) return;
    static const char *const finals[] = {"coordination",
                                         "coordination_without_rattlers",
                                         "rattler_fraction",
                                         "solid_fraction",
                                         "void_ratio",
                                         "unbalanced_ratio",
                                         "kinetic",
                                         "dissipated_damping",
                                         "elastic_normal",
                                         "elastic_tangential",
                                         "stress_axial_contacts",
                                         "stress_lateral_contacts",
                                         "stress_shear_contacts"};
    for (size_t k = 0; k < sizeof finals / sizeof *finals; k++) {
        const double *column = scree_series_get(series, finals[k]);
        if (column) scree_summary_set_number(summary, finals[k], column[series->row_count - 1]);
    }
}

static void summarise_run(const scree_recorder *recorder, scree_simulation *s, scree_summary *summary)
{
    char checksum[32];
    (void)snprintf(checksum, sizeof checksum, "%016" PRIx64, scree_state_checksum(&s->model, &s->state));
    double steps = (double)(s->state.evaluations - recorder->first_evaluations);
    scree_summary_set_text(summary, "case", s->model.name);
    scree_summary_set_text(summary, "status", ""); // its place; scree_results_write sets it
    scree_summary_set_text(summary, "version", scree_version());
    scree_summary_set_text(summary, "commit", scree_commit());
    scree_summary_set_integer(summary, "seed", (int64_t)s->model.seed);
    scree_summary_set_integer(summary, "particles", (int64_t)scree_grain_count(&s->state));
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
    scree_summary_set_number(summary, "particle_steps_per_second", steps * (double)s->state.count / s->in_steps);
    scree_summary_set_integer(summary, "neighbour_rebuilds", (int64_t)s->work.rebuilds);
    scree_rank_counts_results(&recorder->counts, summary);
}

/// What the present or last stage cost.
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
    scree_corner_motion corners;
    scree_status status = SCREE_OK;
    if (scree_config_prepared(s->model.stages)->outline == SCREE_SAMPLE_BOX) {
        status = scree_corner_distortion(&s->model, &s->state, &corners, error);
        if (status) return status;
        scree_summary_set_number(summary, "corner_distortion", corners.largest);
        scree_summary_set_number(summary, "corner_distortion_rms", corners.root_mean_square);
        if (isfinite(corners.rolling)) scree_summary_set_number(summary, "corner_rolling_ratio", corners.rolling);
    } else if (s->state.dimension == 2) {
        status = scree_boundary_roughness(&s->model, &s->state, &value, error);
        if (!status) scree_summary_set_number(summary, "boundary_roughness", value);
    }
    return status;
}

/// Number of the stage `wanted` or of the last one before it that strains the sample; without any that of the last one
/// that takes samples evenly; -1: none.
static int64_t loading_stage(const scree_simulation *s, int64_t wanted)
{
    const scree_config_stage *stage = s->model.stages;
    for (int64_t k = wanted; k >= 0; k--)
        if (!isnan(scree_model_loading_rate(&s->model, &stage[k]))) return k;
    int64_t k = wanted;
    while (k >= 0 && !scree_modules[stage[k].kind]->stage->loading) k--;
    return k;
}

/// What is known of the loading stage until the next one begins.
static scree_status summarise_stage(const scree_simulation *s, scree_summary *summary, scree_error *error)
{
    int64_t last = s->model.stage_count - 1, present = s->state.stage.index < last ? s->state.stage.index : last;
    if (s->state.count == 0 || loading_stage(s, present) != present) return SCREE_OK;
    summarise_cost(s, summary);
    bool plates = scree_boundary_has_plates(scree_model_boundary_of(&s->model, present));
    bool strained = !isnan(scree_model_loading_rate(&s->model, &s->model.stages[present]));
    bool cornered = strained && !plates && !scree_cell(&s->state)->directions;
    return cornered ? summarise_shape(s, summary, error) : SCREE_OK;
}

scree_status scree_results_collect(const scree_recorder *recorder, scree_simulation *s, scree_summary **summary,
                                   scree_error *error)
{
    char path[4096];
    scree_series series = {0};
    *summary = NULL;
    scree_status status = scree_path_join(path, sizeof path, recorder->directory, SCREE_FILE_SERIES, error);
    if (!status) status = scree_series_read(&series, path, error);
    if (!status) status = scree_contacts_save(&s->state, &s->work, error); // for the checksum
    if (!status) status = scree_summary_create(summary, error);
    if (!status) {
        summarise_run(recorder, s, *summary);
        summarise_start(&series, &s->model, *summary);
        summarise_series(&series, &s->state, *summary);
        scree_summary_set_number(*summary, "stiffness_share", scree_results_stiffness_share(&s->state));
        scree_quasistatic_results(&s->model, &series, *summary);
        status = summarise_energy(&series, s, *summary, error);
    }
    if (!status) status = summarise_stage(s, *summary, error);
    scree_log log = recorder->log;
    const scree_conclusion run = {recorder->directory, s, &series, *summary, &log};
    if (!status) status = scree_conclude(&run, error);
    const char *unknown = status ? NULL : scree_summary_unknown(*summary);
    if (unknown)
        status = scree_error_set(error, SCREE_ERROR_IO, "the result '%s' is missing in the table of results", unknown);
    scree_series_destroy(&series);
    return status;
}

scree_status scree_results_write(const scree_recorder *recorder, scree_summary *summary, const char *status,
                                 scree_error *error)
{
    char path[4096];
    scree_status result = scree_path_join(path, sizeof path, recorder->directory, SCREE_FILE_SUMMARY, error);
    scree_summary_set_text(summary, "status", status);
    return result ? result : scree_summary_write(summary, path, error);
}
