/// The results of the run itself, and the search among all.
#include "io/result_names.h"

#include <scree/scree.h>

#include <string.h>

const scree_result scree_run_results[] = {
    // the run
    {"case", NULL, "name of the case"},
    {"status", NULL, "how the run ended"},
    {"version", NULL, "version of Scree"},
    {"commit", NULL, "commit that was built"},
    {"seed", "1", "seed of the random numbers"},
    {"particles", "1", "number of particles"},
    {"steps", "1", "small steps since the begin"},
    {"force_evaluations", "1", "force evaluations since the begin"},
    {"n_s", "1", "small steps in a large one"},
    {"step_size", "s", "small step"},
    {"critical_step", "s", "critical step"},
    {"time", "s", "simulated time"},
    {"phi", "1", "quasistatic coefficient"},
    {"psi", "1", "size coefficient"},
    {"reference_velocity", "m/s", "v_R"},
    {"thickness", "m", "thickness of the discs"},
    {"state_checksum", NULL, "checksum of the final state"},
    {"threads", "1", "threads"},
    {"wall_time", "s", "wall time until the end of the last stage"},
    {"particle_steps_per_second", "1/s", "speed of steps: without preparation, samples and files"},
    {"neighbour_rebuilds", "1", "how often the pair list was made"},
    // what several processes did, since the last start
    {"processes", "1", "processes that computed together, where there were several"},
    {"processes_ghosts", "1", "bodies of others that a process has near its own, mean of the steps"},
    {"processes_imbalance", "1", "bodies of the fullest part over the mean of the parts, in the mean of the steps"},
    {"processes_messages", "1", "messages of all processes in a step, those that make lists included"},
    {"processes_bytes", "1", "bytes of these messages"},
    {"processes_bytes_ratio", "1", "bytes of messages and reductions over what declared fields of ghosts need"},
    {"processes_reductions", "1", "reductions over all processes in a step"},
    {"processes_waiting", "1", "share of the wall time that a process spends in messages and reductions"},
    {"processes_files", "1", "snapshots and checkpoints that all processes have written together"},
    {"processes_files_from_parts", "1", "those of them for which no process had the whole state"},
    {"processes_gathers", "1", "times that the whole state was put together in process 0"},
    {"processes_samples_in_parts", "1", "rows of series.csv for which it was not"},
    // its preparation
    {"confine_friction", "1", "friction of the last confine stage"},
    {"solid_fraction_at_start", "1", "solid fraction at the begin of the last stage"},
    // its last sample
    {"energy_residual", "1", "largest residual of the energy balance over the energy turned over"},
    {"stiffness_share", "1",
     "energy put into tangential springs by the stiffening of contacts over all that there was"},
    {"coordination", "1", "coordination number at the end"},
    {"coordination_without_rattlers", "1", "the same without rattlers"},
    {"rattler_fraction", "1", "share of rattlers at the end"},
    {"solid_fraction", "1", "solid fraction at the end"},
    {"void_ratio", "1", "volume of the voids over that of the particles at the end"},
    {"unbalanced_ratio", "1", "unbalanced force ratio at the end"},
    {"kinetic", "J", "kinetic energy at the end"},
    {"dissipated_damping", "J", "energy dissipated by the dashpots of contacts until the end"},
    {"elastic_normal", "J", "elastic energy of the overlaps at the end"},
    {"elastic_tangential", "J", "elastic energy of the tangential springs at the end"},
    {"stress_axial_contacts", "Pa", "axial stress of the contacts at the end, compression positive"},
    {"stress_lateral_contacts", "Pa", "lateral stress of the contacts at the end, in 3D the mean of both"},
    {"stress_shear_contacts", "Pa", "shear stress of the contacts at the end, of the first and the last axis"},
    // the last loading stage
    {"axial_strain", "1", "axial strain reached"},
    {"shear_strain_reached", "1", "engineering shear strain reached"},
    {"peak_stress_ratio", "1", "largest mean of the stress ratio over 1 % of strain, running"},
    {"strain_at_peak", "1", "axial strain there"},
    {"final_stress_ratio", "1", "mean over the last fifth of the strain"},
    {"rate_ratio_mean", "1", "mean of actual over imposed rate"},
    {"rate_ratio_min", "1", "least of it"},
    {"rate_ratio_max", "1", "largest of it"},
    {"max_volumetric_compaction", "1", "largest compaction"},
    {"max_volumetric_dilation", "1", "largest dilation"},
    {"strain_at_max_compaction", "1", "axial strain there"},
    {"strain_at_max_dilation", "1", "axial strain there"},
    {"inertial_number", "1", "largest inertial number of the loading"},
    {"kinetic_over_elastic", "1", "mean kinetic over mean elastic energy of the loading"},
    {"quasistatic", NULL, "whether every stage keeps the limits of quasistatic loading"},
    {"quasistatic_reason", NULL, "why, or why not"},
    {"final_volumetric_strain", "1", "sum of the increments of the boundary at the end"},
    {"final_volumetric_strain_redetected", "1", "what re-detections of the boundary have changed in it"},
    {"final_volumetric_strain_enclosed", "1", "volumetric strain at the end, from the enclosed volume"},
    {"final_volumetric_strain_solid", "1", "volumetric strain at the end, from the solid fraction"},
    {"max_volumetric_dilation_solid", "1", "largest dilation by the solid fraction"},
    {"stress_disagreement", "1", "axial stress of plates against that of contacts, means over the stage"},
    {"stress_disagreement_instant", "1", "the same, mean of the instantaneous differences"},
    {"mean_slip_ratio", "1", "mean slip speed over v_R"},
    {"initial_slip_ratio", "1", "the same at the begin"},
    {"coordination_at_start", "1",
     "coordination number at the begin; of a sample that nothing strains, of its last stage"},
    {"loading_force_evaluations", "1", "force evaluations of the stage"},
    {"loading_wall_time", "s", "wall time of the stage"},
    {"loading_processor_time", "s", "processor time of the stage"},
    {"corner_distortion", "1", "non-affine displacement at the corners over the width"},
    {"corner_distortion_rms", "1", "root mean square of the four corners instead of the largest"},
    {"corner_rolling_ratio", "1", "mean rotation of the grains near the corners over that of all"},
    {"boundary_roughness", "1", "roughness of a round sample's outline in mean diameters"},
    // its averages
    {"warnings", NULL, "what has to be known before averages, or numbers of a pile, are believed; empty: nothing"},
    // a search for a limit
    {"limit", "1", "of a key, between runs that stand and runs that do not, in SI units"},
    {"limit_stands", "1", "nearest value at which a run stands"},
    {"limit_fails", "1", "nearest value at which none does"},
    {"limit_runs", "1", "runs of the search"},
    {"limit_nearest", "1", "number of the run whose result is nearest to the target"},
};
const size_t scree_run_results_count = sizeof scree_run_results / sizeof *scree_run_results;

scree_status scree_result_call(char name[SCREE_RESULT_NAME], const char *about, const scree_result *row,
                               scree_error *error)
{
    int length = snprintf(name, SCREE_RESULT_NAME, "%s%s", about, row->name);
    if (length > 0 && length < SCREE_RESULT_NAME) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_INPUT, "the name '%.40s...' is too long for a result", about);
}

bool scree_result_ends(const char *name, const char *ending)
{
    size_t length = strlen(name), tail = strlen(ending);
    return length > tail && strcmp(name + length - tail, ending) == 0;
}

static bool fits(const scree_result *row, const char *name)
{
    return row->name[0] == '_' ? scree_result_ends(name, row->name) : strcmp(row->name, name) == 0;
}

const scree_result *scree_result_name_find(const char *name, const scree_module **module)
{
    const scree_module *none;
    if (!module) module = &none;
    *module = NULL;
    for (size_t i = 0; i < scree_run_results_count; i++)
        if (fits(&scree_run_results[i], name)) return &scree_run_results[i];
    // Of two endings that fit, `_force_x` and `_exerted_force_x`, the longer one is meant.
    const scree_result *found = NULL;
    for (int m = 0; m < SCREE_MODULE_COUNT; m++)
        for (size_t k = 0; k < scree_modules[m]->results.count; k++) {
            const scree_result *row = &scree_modules[m]->results.row[k];
            if (!fits(row, name) || (found && strlen(row->name) <= strlen(found->name))) continue;
            found = row;
            *module = scree_modules[m];
        }
    return found;
}

const char *scree_result_name_nearest(const char *name)
{
    const char *names[512];
    size_t count = 0;
    for (size_t i = 0; i < scree_run_results_count; i++) names[count++] = scree_run_results[i].name;
    for (int m = 0; m < SCREE_MODULE_COUNT; m++)
        for (size_t k = 0; k < scree_modules[m]->results.count && count < sizeof names / sizeof *names; k++) {
            const char *own = scree_modules[m]->results.row[k].name;
            if (own[0] != '_') names[count++] = own;
        }
    return scree_nearest(name, names, count);
}
