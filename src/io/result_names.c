/// The table of results.
#include "io/result_names.h"

#include <scree/scree.h>

#include <string.h>

/// A value with the ends of its confidence interval of 95 %.
#define INTERVAL(name, unit, meaning)                                                                                  \
    {name, unit, meaning}, {name "_low", unit, "lower end of its interval"},                                           \
    {                                                                                                                  \
        name "_high", unit, "upper end of its interval"                                                                \
    }

const scree_result_name scree_result_names[] = {
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
    {"particle_steps_per_second", "1/s", "speed"},
    {"neighbour_rebuilds", "1", "how often the pair list was made"},
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
    {"unbalanced_ratio", "1", "unbalanced force ratio at the end"},
    // walls of the case
    {"_work", "J", "work of the wall (or of a prescribed motion or force) on the bodies"},
    {"_force", "N", "magnitude of the last force on the wall"},
    {"_torque", "N m", "magnitude of the last torque on the wall"},
    // the last loading stage
    {"axial_strain", "1", "axial strain reached"},
    {"shear_strain_reached", "1", "engineering shear strain reached"},
    {"peak_stress_ratio", "1", "largest running mean of the stress ratio"},
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
    {"coordination_at_start", "1", "coordination number at the begin"},
    {"loading_force_evaluations", "1", "force evaluations of the stage"},
    {"loading_wall_time", "s", "wall time of the stage"},
    {"loading_processor_time", "s", "processor time of the stage"},
    {"corner_distortion", "1", "non-affine displacement at the corners over the width"},
    {"boundary_roughness", "1", "roughness of a round sample's outline in mean diameters"},
    // cells
    {"cell_stress_disagreement", "1", "stress of the cells against that of the contacts"},
    {"cell_strain_disagreement", "1", "strain of the cells against that of the boundary"},
    {"circle_pressure_spread", "1", "spread of the pressure over circles"},
    {"circle_pressure_diameter", "1", "diameter from which on circles have the mean pressure, in mean diameters"},
    {"plate_distortion_ratio", "1", "distortion rate near the plates over that of the core"},
    {"plate_pressure_ratio", "1", "pressure near the plates over that of the core"},
    {"side_pressure_ratio", "1", "pressure near the sides over that of the core"},
    // shear bands
    {"bands", NULL, "kind of localisation"},
    {"band_persistence", "1", "persistence of the bands"},
    {"localisation_index_last", "1", "localisation index of the last window"},
    {"band_angle", "degree", "angle of the band"},
    {"band_thickness_diameters", "1", "thickness of the band in mean diameters"},
    {"band_share", "1", "share of the band in the distortion"},
    {"band_contrast", "1", "distortion within the band over that outside"},
    {"band_percolation", "1", "how far the band goes through the sample"},
    // an impact
    {"restitution", "1", "coefficient of restitution"},
    {"restitution_theory", "1", "closed form of it"},
    {"relaxation_time", "s", "duration of the contact"},
    {"relaxation_time_theory", "s", "closed form of it"},
    // a rotated particle
    {"forced_particle", "1", "number of the particle"},
    {"rotation_reach", "1", "how far rotations are felt, in mean diameters"},
    INTERVAL("rotation_decay_length", "1", "decay length of the rotations in mean diameters"),
    {"rotation_at_contact", "1", "rotation of the neighbours over that of the particle"},
    {"rotation_background", "1", "rotation without the forced one"},
    {"rotation_felt", "1", "rotation that counts as felt"},
    INTERVAL("rotation_chain_correlation", "1", "correlation of rotations with force chains"),
    INTERVAL("rotation_chain_alignment", "1", "alignment of rotations with force chains"),
    INTERVAL("rotation_across_chains", "1", "the same across the chains"),
    {"rose_eigenvector_angle", "degree", "angle between the peak of the rose and the first axis of T"},
    {"rotation_tensor_angle", "degree", "angle of the first axis of T"},
    {"rotation_tensor_first", "1", "largest eigenvalue of T"},
    {"rotation_tensor_last", "1", "least eigenvalue of T"},
    {"rotation_tensor_off_diagonal", "1", "off-diagonal part of T over its diagonal"},
    {"rigid_rotation_ratio", "1", "rotation of the boundary over that of the particle"},
};
const size_t scree_result_names_count = sizeof scree_result_names / sizeof *scree_result_names;

/// The row among `count` whose name is that of what has a result, without it.
static const scree_result_name *find_ending(const scree_result_name *row, size_t count, const char *name, size_t *wall)
{
    for (size_t i = 0; i < count; i++) {
        size_t length = strlen(name), tail = strlen(row[i].name);
        if (row[i].name[0] != '_' || length <= tail || strcmp(name + length - tail, row[i].name) != 0) continue;
        *wall = length - tail;
        return &row[i];
    }
    return NULL;
}

const scree_result_name *scree_result_name_find(const char *name, size_t *wall)
{
    size_t none;
    if (!wall) wall = &none;
    *wall = 0;
    for (size_t i = 0; i < scree_result_names_count; i++)
        if (scree_result_names[i].name[0] != '_' && strcmp(scree_result_names[i].name, name) == 0)
            return &scree_result_names[i];
    const scree_result_name *found = find_ending(scree_result_names, scree_result_names_count, name, wall);
    for (int m = 0; m < SCREE_MODULE_COUNT && !found; m++)
        if (scree_modules[m]->columns)
            found = find_ending(scree_modules[m]->columns->column, scree_modules[m]->columns->count, name, wall);
    return found;
}

const char *scree_result_name_nearest(const char *name)
{
    const char *names[sizeof scree_result_names / sizeof *scree_result_names];
    size_t count = 0;
    for (size_t i = 0; i < scree_result_names_count; i++)
        if (scree_result_names[i].name[0] != '_') names[count++] = scree_result_names[i].name;
    return scree_nearest(name, names, count);
}
