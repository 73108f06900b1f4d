/// Tables and scalars of the transmission of rotations (measure/rotation.h). Lengths in mean diameters; angles in
/// degrees.
#include "run/rotation_results.h"
#include "integrate/forced_spin.h"
#include "run/stage_rotate_config.h"

#include "io/run_directory.h"
#include "measure/measure.h"
#include "measure/rotation.h"
#include "run/loading.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>

typedef struct findings {
    size_t forced; ///< row
    scree_rotation_decay decay;
    scree_rotation_network network;
    scree_rotation_alignment alignment;
    scree_rotation_transmission transmission;
} findings;

static double fitted(const scree_rotation_decay *decay, double distance)
{
    return decay->amplitude * exp(-distance / decay->length);
}

static void write_decay(FILE *file, const scree_simulation *s, const findings *f)
{
    (void)s;
    const scree_rotation_decay *decay = &f->decay;
    fputs("distance [1],rotation_ratio [1],standard_error [1],count [1],fit [1],felt [1]\n", file);
    for (size_t b = 0; b < decay->bin_count; b++) {
        const scree_rotation_bin *bin = &decay->bin[b];
        if (bin->count > 0)
            fprintf(file, "%.9g,%.9g,%.9g,%zu,%.9g,%.9g\n", bin->distance, bin->mean, bin->standard_error, bin->count,
                    bin->distance < decay->reach ? fitted(decay, bin->distance) : NAN, bin->felt);
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

/// One bin of the transmission per contact, between two forces and two angles [degrees].
static void write_bin(FILE *file, const double force[2], double low, double high, const scree_rotation_handed *bin)
{
    fprintf(file, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%zu\n", force[0], force[1], low, high, bin->force,
            180 / M_PI * bin->angle, bin->value, bin->low, bin->high, bin->count);
}

static void write_handed(FILE *file, const scree_simulation *s, const findings *f)
{
    (void)s;
    const double width = 90.0 / SCREE_ROTATION_ANGLES, all[2] = {0, INFINITY};
    fputs("force_low [1],force_high [1],angle_low [degree],angle_high [degree],force [1],angle [degree],"
          "rotation_ratio [1],ratio_low [1],ratio_high [1],count [1]\n",
          file);
    for (int k = 0; k < SCREE_ROTATION_FORCES; k++)
        write_bin(file, &scree_rotation_force_edges[k], 0, 90, &f->transmission.by_force[k]);
    for (int k = 0; k < SCREE_ROTATION_ANGLES; k++)
        write_bin(file, all, k * width, (k + 1) * width, &f->transmission.by_angle[k]);
}

/// Rotation of the body in `row` about the axis of the forced one, over its: counter-clockwise like it is positive.
static double turned_with(const scree_state *state, size_t row, size_t forced)
{
    if (state->dimension == 2) return state->angle[row] / state->angle[forced];
    scree_vector velocity, spin, driven;
    scree_body_motion(state, row, velocity, spin);
    scree_body_motion(state, forced, velocity, driven);
    double product = 0;
    for (int i = 0; i < 3; i++) product += spin[i] * driven[i];
    return product / pow(scree_length(driven), 2);
}

static void write_bodies(FILE *file, const scree_simulation *s, const findings *f)
{
    const scree_state *state = &s->state;
    scree_vector centre, place;
    scree_body_position(state, f->forced, centre);
    double driven = scree_rotation_amount(state, f->forced), diameter = 2 * s->model.mean_radius;
    fputs("id [1],distance [1],rotation_ratio [1],rotation_with [1],counts [1]\n", file);
    size_t next = 0;
    for (uint32_t row; (row = scree_next_by_id(state, &next)) != SCREE_NO_ROW;) {
        if (!scree_body_is_grain(state, row)) continue;
        scree_body_position(state, row, place);
        for (int i = 0; i < 3; i++) place[i] -= centre[i];
        fprintf(file, "%u,%.9g,%.9g,%.9g,%d\n", state->id[row], scree_length(place) / diameter,
                scree_rotation_amount(state, row) / driven, turned_with(state, row, f->forced),
                scree_rotation_counts(state, row));
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

/// A value and its interval of 95 %.
static void set_interval(scree_summary *summary, const char *name, double value, double low, double high)
{
    char text[64];
    scree_summary_set_number(summary, name, value);
    (void)snprintf(text, sizeof text, "%s_low", name);
    scree_summary_set_number(summary, text, low);
    (void)snprintf(text, sizeof text, "%s_high", name);
    scree_summary_set_number(summary, text, high);
}

static const scree_rotate_config *last_stage(const scree_simulation *s)
{
    return s->model.stages[s->model.stage_count - 1].own;
}

/// Rotation of the boundary about the axis of the forced particle in the whole stage, over that of the particle.
static double rigid_rotation(const scree_simulation *s)
{
    int axis = last_stage(s)->axis, i = (axis + 1) % 3, j = (axis + 2) % 3;
    double gradient[9];
    scree_strain_measure(&s->state, gradient);
    for (int c = 0; c < 9; c++) gradient[c] -= scree_loading_of(&s->state)->strain[c];
    return 0.5 * (gradient[3 * j + i] - gradient[3 * i + j]) / scree_rotation_of(&s->state)->turn;
}

/// Angle between two axes in the plane, 0 to 90 degrees.
static double between_axes(double one, double other)
{
    return 180 / M_PI * asin(fabs(sin(one - other)));
}

static void summarise(const scree_simulation *s, const findings *f, scree_summary *summary)
{
    const double *axis = f->network.axis[0], *tensor = f->network.tensor;
    double diagonal = fabs(tensor[0]) + fabs(tensor[4]) + fabs(tensor[8]), other = 0;
    for (int c = 0; c < 9; c++) other += c / 3 != c % 3 ? fabs(tensor[c]) : 0;
    const scree_rotation_alignment *a = &f->alignment;
    scree_summary_set_integer(summary, "forced_particle", scree_forced(&s->state)->id);
    scree_summary_set_number(summary, "rotation_reach", f->decay.reach);
    set_interval(summary, "rotation_decay_length", f->decay.length, f->decay.length_low, f->decay.length_high);
    scree_summary_set_number(summary, "rotation_at_contact", f->decay.amplitude * exp(-1 / f->decay.length));
    scree_summary_set_number(summary, "rotation_background", scree_rotation_of(&s->state)->background.mean);
    scree_summary_set_number(summary, "rotation_felt", f->decay.limit);
    set_interval(summary, "rotation_chain_correlation", a->chains.value, a->chains.low, a->chains.high);
    set_interval(summary, "rotation_chain_alignment", a->alignment.value, a->alignment.low, a->alignment.high);
    const scree_rotation_transmission *t = &f->transmission;
    scree_summary_set_number(summary, "rotation_handed_strong", t->strong.value);
    scree_summary_set_number(summary, "rotation_handed_weak", t->weak.value);
    scree_summary_set_number(summary, "rotation_handed_aside", t->aside.value);
    scree_summary_set_number(summary, "rotation_handed_crossed", t->crossed.value);
    scree_summary_set_number(summary, "rotation_handed_open", t->open.value);
    if (s->state.dimension == 2) {
        double direction = atan2(axis[1], axis[0]);
        set_interval(summary, "rotation_across_chains", a->across.value, a->across.low, a->across.high);
        scree_summary_set_number(summary, "rose_eigenvector_angle", between_axes(direction, f->network.peak));
        scree_summary_set_number(summary, "rotation_tensor_angle", 180 / M_PI * direction);
    }
    scree_summary_set_number(summary, "rotation_tensor_first", f->network.value[0]);
    scree_summary_set_number(summary, "rotation_tensor_last", f->network.value[s->state.dimension - 1]);
    scree_summary_set_number(summary, "rotation_tensor_off_diagonal", other / diagonal);
    scree_summary_set_number(summary, "rigid_rotation_ratio", rigid_rotation(s));
}

scree_status scree_rotation_conclude(const scree_conclusion *run, scree_error *error)
{
    const char *directory = run->directory;
    scree_simulation *s = run->s;
    const scree_state *state = &s->state;
    // Before the end of the stage the angles are not those of the hold.
    if (!scree_forced(state)->active || state->stage.index < s->model.stage_count) return SCREE_OK;
    findings f = {.forced = state->row_of_id[scree_forced(state)->id]};
    double cutoff = last_stage(s)->cutoff;
    scree_status status = scree_contact_table_build(&s->stage_model, state, &s->work, &s->table, error);
    if (status) return status;
    scree_rotation_decay_measure(&s->model, state, f.forced, &scree_rotation_of(state)->background, &f.decay);
    scree_rotation_network_measure(&s->model, state, &s->table, f.forced, cutoff, &f.network);
    status = scree_rotation_alignment_measure(&s->model, state, &s->table, f.forced, cutoff, &f.decay, &f.network,
                                              &f.alignment, error);
    scree_rotation_transmission_measure(&s->model, state, &s->table, f.forced, cutoff, f.decay.limit, &f.transmission);
    if (!status) summarise(s, &f, run->summary);
    if (!status) status = write_table(directory, SCREE_FILE_ROTATION_DECAY, write_decay, s, &f, error);
    if (!status) status = write_table(directory, SCREE_FILE_ROTATION_ROSE, write_rose, s, &f, error);
    if (!status) status = write_table(directory, SCREE_FILE_ROTATION_HANDED, write_handed, s, &f, error);
    if (!status) status = write_table(directory, SCREE_FILE_ROTATION_BODIES, write_bodies, s, &f, error);
    return status;
}
