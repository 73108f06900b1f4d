/// Tables and scalars of the transmission of rotations (measure/rotation.h). Lengths in mean diameters; angles in
/// degrees.
#include "run/rotation_results.h"

#include "io/run_directory.h"
#include "measure/rotation.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>

typedef struct findings {
    size_t forced; ///< row
    scree_rotation_decay decay;
    scree_rotation_network network;
    scree_rotation_alignment alignment;
} findings;

static double fitted(const scree_rotation_decay *decay, double distance)
{
    return decay->amplitude * exp(-distance / decay->length);
}

static void write_decay(FILE *file, const scree_simulation *s, const findings *f)
{
    (void)s;
    const scree_rotation_decay *decay = &f->decay;
    fputs("distance [1],rotation_ratio [1],standard_error [1],count [1],fit [1]\n", file);
    for (size_t b = 0; b < decay->bin_count; b++) {
        const scree_rotation_bin *bin = &decay->bin[b];
        double middle = bin->lower + 0.5 * decay->bin_width;
        if (bin->count > 0)
            fprintf(file, "%.9g,%.9g,%.9g,%zu,%.9g\n", middle, bin->mean, bin->standard_error, bin->count,
                    middle < decay->reach ? fitted(decay, middle) : NAN);
    }
}

static void write_rose(FILE *file, const scree_simulation *s, const findings *f)
{
    const double turn = s->state.dimension == 2 ? 360 : 180, width = turn / SCREE_ROTATION_SECTORS;
    fputs("angle [degree],radial_strength [1/m],rotation_excess [1]\n", file);
    for (int k = 0; k < SCREE_ROTATION_SECTORS; k++) {
        // In 3D sectors have equal solid angles.
        double middle =
            s->state.dimension == 2 ? (k + 0.5) * width : 180 / M_PI * acos(1 - 2 * (k + 0.5) / SCREE_ROTATION_SECTORS);
        fprintf(file, "%.9g,%.9g,%.9g\n", middle, f->network.rose[k], f->network.followed[k]);
    }
}

static void write_bodies(FILE *file, const scree_simulation *s, const findings *f)
{
    const scree_state *state = &s->state;
    scree_vector centre, place;
    scree_body_place(state, f->forced, centre);
    double driven = scree_rotation_amount(state, f->forced), diameter = 2 * s->model.mean_radius;
    fputs("id [1],distance [1],rotation_ratio [1]\n", file);
    for (size_t id = 0; id < state->grains; id++) {
        size_t row = state->row_of_id[id];
        scree_body_place(state, row, place);
        for (int i = 0; i < 3; i++) place[i] -= centre[i];
        fprintf(file, "%zu,%.9g,%.9g\n", id, scree_length(place) / diameter,
                scree_rotation_amount(state, row) / driven);
    }
}

static scree_status write_table(const char *directory, const char *name,
                                void (*rows)(FILE *, const scree_simulation *, const findings *),
                                const scree_simulation *s, const findings *f, scree_error *error)
{
    char path[PATH_MAX];
    FILE *file;
    scree_status status = scree_path_join(path, sizeof path, directory, name, error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (status) return status;
    rows(file, s, f);
    return scree_replace_finish(path, file, true, error);
}

static void summarise(const scree_simulation *s, const findings *f, scree_summary *summary)
{
    const double *axis = f->network.axis[0], *tensor = f->network.tensor;
    double diagonal = fabs(tensor[0]) + fabs(tensor[4]) + fabs(tensor[8]), other = 0;
    for (int c = 0; c < 9; c++) other += c / 3 != c % 3 ? fabs(tensor[c]) : 0;
    scree_summary_set_integer(summary, "forced_particle", s->state.forced.id);
    scree_summary_set_number(summary, "rotation_decay_length", f->decay.length);
    scree_summary_set_number(summary, "rotation_decay_length_low", f->decay.length_low);
    scree_summary_set_number(summary, "rotation_decay_length_high", f->decay.length_high);
    scree_summary_set_number(summary, "rotation_reach", f->decay.reach);
    scree_summary_set_number(summary, "rotation_tensor_ratio",
                             f->network.value[s->state.dimension - 1] / f->network.value[0]);
    scree_summary_set_number(summary, "rotation_tensor_off_diagonal", other / diagonal);
    if (s->state.dimension == 2)
        scree_summary_set_number(summary, "rotation_tensor_angle", 180 / M_PI * atan2(axis[1], axis[0]));
    scree_summary_set_number(summary, "rotation_along_chains", f->alignment.along.value);
    scree_summary_set_number(summary, "rotation_along_chains_low", f->alignment.along.low);
    scree_summary_set_number(summary, "rotation_along_chains_high", f->alignment.along.high);
    scree_summary_set_number(summary, "rotation_by_sectors", f->alignment.sectors.value);
    scree_summary_set_number(summary, "rotation_by_sectors_low", f->alignment.sectors.low);
    scree_summary_set_number(summary, "rotation_by_sectors_high", f->alignment.sectors.high);
}

scree_status scree_rotation_results(const char *directory, scree_simulation *s, scree_summary *summary,
                                    scree_error *error)
{
    const scree_state *state = &s->state;
    if (!state->forced.active || !(scree_length(state->forced.spin) > 0)) return SCREE_OK;
    findings f = {.forced = state->row_of_id[state->forced.id]};
    double cutoff = s->model.config->stages[s->model.config->stage_count - 1].cutoff;
    scree_status status = scree_contact_table_build(&s->stage_model, state, &s->work, &s->table, error);
    if (status) return status;
    scree_rotation_decay_measure(&s->model, state, f.forced, &f.decay);
    scree_rotation_network_measure(&s->model, state, &s->table, f.forced, cutoff, &f.network);
    status = scree_rotation_alignment_measure(&s->model, state, &s->table, f.forced, cutoff, &f.decay, &f.network,
                                              &f.alignment, error);
    if (!status) summarise(s, &f, summary);
    if (!status) status = write_table(directory, SCREE_FILE_ROTATION_DECAY, write_decay, s, &f, error);
    if (!status) status = write_table(directory, SCREE_FILE_ROTATION_ROSE, write_rose, s, &f, error);
    if (!status) status = write_table(directory, SCREE_FILE_ROTATION_BODIES, write_bodies, s, &f, error);
    return status;
}
