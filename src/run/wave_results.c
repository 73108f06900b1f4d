/// What receivers and layers tell at the end: receivers.csv (displacements), receiver-places.csv, arrivals.csv (a row
/// a pair), speeds.
///
/// Component: the axis along which receivers move most. The speed of a pair is the distance of the two bodies along the
/// axis of the wave over the time between their peaks, or over the lag of the one pulse behind the other
/// (measure/arrival.h). Means over the pairs with Student's intervals of 95 %. Beside them stand the speeds of long
/// waves in the elastic medium of the static moduli (specimen/moduli.h) of the sample as it is at the end: of a bar
/// sqrt(E / rho), of shear sqrt(G / rho), of a plane wave sqrt(C / rho) with C along the axis.
#include "run/waves.h"

#include "io/file_names.h"
#include "io/run_directory.h"
#include "measure/arrival.h"
#include "specimen/box.h"
#include "specimen/from_state.h"
#include "specimen/piece.h"

#include <gsl/gsl_cdf.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>

const scree_result scree_wave_rows[SCREE_WAVE_ROWS] = {
    {"wave_component", NULL, "axis along which receivers move most"},
    {"wave_pairs", "1", "pairs of receivers that a wave has passed"},
    SCREE_RESULT_INTERVAL("wave_speed", "m/s", "from peak to peak, mean over the pairs"),
    SCREE_RESULT_INTERVAL("wave_speed_correlation", "m/s", "by cross-correlation, mean over the pairs"),
    {"wave_time", "s", "from peak to peak of the first pair"},
    {"wave_time_correlation", "s", "lag of the first pair"},
    {"wave_distance", "m", "distance of the first pair along the wave"},
    {"wave_speed_bar", "m/s", "sqrt(E / rho) of the static moduli"},
    {"wave_speed_shear", "m/s", "sqrt(G / rho) of the static moduli"},
    {"wave_speed_plane", "m/s", "sqrt(C / rho) along the wave, of the static moduli"},
    {"dispersion_deviation", "1", "largest deviation of a frequency of the layers from that of the lattice"},
    {"dispersion_points", "1", "waves of the layers that have a clear frequency"},
};

scree_status scree_wave_signal(const scree_state *state, const scree_wave_numbers *own, size_t channel, int axis,
                               double **signal, scree_error *error)
{
    const scree_waves *m = scree_waves_of(state);
    const size_t channels = scree_wave_channels(own);
    scree_status status = scree_allocate(signal, m->record_count + 1, sizeof **signal, error);
    for (size_t r = 0; r < m->record_count && !status; r++) (*signal)[r] = m->value[r * channels + channel][axis];
    return status;
}

// ---- speeds ------------------------------------------------------------------------------------------------------

/// Mean and half of its interval.
typedef struct mean {
    size_t count;
    double value, half;
} mean;

static mean mean_of(const double *value, size_t count)
{
    mean m = {0};
    double square = 0;
    for (size_t k = 0; k < count; k++)
        if (isfinite(value[k])) m.count++;
    for (size_t k = 0; k < count; k++) m.value += isfinite(value[k]) ? value[k] / (double)m.count : 0;
    for (size_t k = 0; k < count; k++) square += isfinite(value[k]) ? pow(value[k] - m.value, 2) : 0;
    if (m.count == 0) m.value = NAN;
    m.half = m.count > 1 ? gsl_cdf_tdist_Pinv(0.975, (double)m.count - 1) *
                               sqrt(square / (double)(m.count - 1) / (double)m.count)
                         : (double)NAN;
    return m;
}

static void set_mean(scree_summary *summary, const char *name, mean m)
{
    char text[64];
    scree_summary_set_number(summary, name, m.value);
    (void)snprintf(text, sizeof text, "%s_low", name);
    scree_summary_set_number(summary, text, m.value - m.half);
    (void)snprintf(text, sizeof text, "%s_high", name);
    scree_summary_set_number(summary, text, m.value + m.half);
}

static int find_component(const scree_state *state, const scree_wave_numbers *own)
{
    const scree_waves *m = scree_waves_of(state);
    double most[3] = {0};
    int best = 0;
    for (size_t r = 0; r < m->record_count; r++)
        for (int64_t k = 0; k < own->receiver_count; k++)
            for (int i = 0; i < 3; i++)
                most[i] = fmax(most[i], fabs(m->value[r * scree_wave_channels(own) + (size_t)k][i]));
    for (int i = 1; i < state->dimension; i++)
        if (most[i] > most[best]) best = i;
    return best;
}

/// A pair of receivers.
typedef struct pair {
    double distance;     ///< m, along the wave
    double peak[2];      ///< s, of both
    double time, lag;    ///< s, between the peaks, by correlation
    double speed, other; ///< m/s, of both
} pair;

/// Seconds of a place among the records.
static double time_at(const scree_waves *m, double place)
{
    const double first = floor(place);
    const size_t k = (size_t)fmin(fmax(first, 0), (double)m->record_count - 2);
    return m->time[k] + (place - (double)k) * (m->time[k + 1] - m->time[k]);
}

static scree_status find_pair(const scree_state *state, const scree_wave_numbers *own, size_t first, int component,
                              pair *p, scree_error *error)
{
    const scree_waves *m = scree_waves_of(state);
    double *signal[2] = {NULL, NULL};
    scree_pulse pulse[2];
    scree_status status = SCREE_OK;
    for (size_t i = 0; i < 2 && !status; i++) {
        status = scree_wave_signal(state, own, first + i, component, &signal[i], error);
        if (!status) pulse[i] = scree_pulse_find(signal[i], m->record_count);
    }
    if (!status) {
        const double interval = (m->time[m->record_count - 1] - m->time[0]) / (double)(m->record_count - 1);
        p->distance = fabs(m->receiver[first + 1].place[own->axis] - m->receiver[first].place[own->axis]);
        for (int i = 0; i < 2; i++) p->peak[i] = isnan(pulse[i].peak) ? (double)NAN : time_at(m, pulse[i].peak);
        p->time = fabs(p->peak[1] - p->peak[0]);
        p->lag = interval * fabs(scree_pulse_lag(signal[0], &pulse[0], signal[1], &pulse[1]));
        p->speed = p->distance / p->time;
        p->other = p->distance / p->lag;
    }
    scree_release(&signal[0]);
    scree_release(&signal[1]);
    return status;
}

static scree_status find_arrivals(const scree_conclusion *run, const scree_wave_numbers *own, int component,
                                  pair *pairs, scree_error *error)
{
    const size_t count = (size_t)own->receiver_count / 2;
    double speed[SCREE_RECEIVERS / 2], other[SCREE_RECEIVERS / 2];
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < count && !status; k++) {
        status = find_pair(&run->s->state, own, 2 * k, component, &pairs[k], error);
        speed[k] = pairs[k].speed;
        other[k] = pairs[k].other;
    }
    if (status) return status;
    const mean peaks = mean_of(speed, count);
    scree_summary_set_text(run->summary, "wave_component", (const char *[]){"x", "y", "z"}[component]);
    scree_summary_set_integer(run->summary, "wave_pairs", (int64_t)peaks.count);
    set_mean(run->summary, "wave_speed", peaks);
    set_mean(run->summary, "wave_speed_correlation", mean_of(other, count));
    if (count == 0) return SCREE_OK;
    scree_summary_set_number(run->summary, "wave_time", pairs[0].time);
    scree_summary_set_number(run->summary, "wave_time_correlation", pairs[0].lag);
    scree_summary_set_number(run->summary, "wave_distance", pairs[0].distance);
    return SCREE_OK;
}

// ---- tables ------------------------------------------------------------------------------------------------------

static scree_status begin_table(const scree_conclusion *run, const char *name, char path[PATH_MAX], FILE **file,
                                scree_error *error)
{
    scree_status status = scree_path_join(path, PATH_MAX, run->directory, name, error);
    return status ? status : scree_replace_begin(path, file, error);
}

static scree_status write_receivers(const scree_conclusion *run, const scree_wave_numbers *own, scree_error *error)
{
    const scree_state *state = &run->s->state;
    const scree_waves *m = scree_waves_of(state);
    char path[PATH_MAX];
    FILE *file;
    scree_status status = begin_table(run, SCREE_FILE_RECEIVERS, path, &file, error);
    if (status) return status;
    fputs("time [s]", file);
    for (int64_t k = 0; k < own->receiver_count; k++)
        for (int i = 0; i < state->dimension; i++) fprintf(file, ",%s_%c [m]", own->receiver[k].name, "xyz"[i]);
    fputc('\n', file);
    for (size_t r = 0; r < m->record_count; r++) {
        fprintf(file, "%.12g", m->time[r]);
        for (int64_t k = 0; k < own->receiver_count; k++)
            for (int i = 0; i < state->dimension; i++)
                fprintf(file, ",%.9g", m->value[r * scree_wave_channels(own) + (size_t)k][i]);
        fputc('\n', file);
    }
    return scree_replace_finish(path, file, true, error);
}

/// Which bodies were listened to.
static scree_status write_places(const scree_conclusion *run, const scree_wave_numbers *own, scree_error *error)
{
    const int dimension = run->s->state.dimension;
    const scree_waves *m = scree_waves_of(&run->s->state);
    char path[PATH_MAX];
    FILE *file;
    scree_status status = begin_table(run, SCREE_FILE_PLACES, path, &file, error);
    if (status) return status;
    fputs(dimension == 3 ? "name,id,x [m],y [m],z [m]\n" : "name,id,x [m],y [m]\n", file);
    for (int64_t k = 0; k < own->receiver_count; k++) {
        fprintf(file, "%s,%u", own->receiver[k].name, m->receiver[k].id);
        for (int i = 0; i < dimension; i++) fprintf(file, ",%.12g", m->receiver[k].place[i]);
        fputc('\n', file);
    }
    return scree_replace_finish(path, file, true, error);
}

static scree_status write_arrivals(const scree_conclusion *run, const scree_wave_numbers *own, int component,
                                   const pair *pairs, scree_error *error)
{
    char path[PATH_MAX];
    FILE *file;
    scree_status status = begin_table(run, SCREE_FILE_ARRIVALS, path, &file, error);
    if (status) return status;
    fputs("first,second,component,distance [m],first_peak [s],second_peak [s],time [s],speed [m/s],lag [s],"
          "speed_correlation [m/s]\n",
          file);
    for (int64_t k = 0; k < own->receiver_count / 2; k++)
        fprintf(file, "%s,%s,%c,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", own->receiver[2 * k].name,
                own->receiver[2 * k + 1].name, "xyz"[component], pairs[k].distance, pairs[k].peak[0], pairs[k].peak[1],
                pairs[k].time, pairs[k].speed, pairs[k].lag, pairs[k].other);
    return scree_replace_finish(path, file, true, error);
}

// ---- static moduli -----------------------------------------------------------------------------------------------

/// The specimen, or the piece of it within its outermost bodies, and its density [kg/m3]. SCREE_ERROR_INPUT: it is no
/// box.
static scree_status take_specimen(scree_simulation *s, scree_specimen *out, double *density, scree_error *error)
{
    const scree_box_faces faces = {{{NAN, NAN, NAN}, {NAN, NAN, NAN}}};
    scree_status status = scree_specimen_of_state(&s->stage_model, &s->state, &s->work, out, error);
    if (status) return status;
    double mass = 0;
    for (size_t k = 0; k < out->body_count; k++) mass += out->mass[k];
    // What holds bodies in the run is no part of the material.
    for (size_t k = 0; k < out->body_count; k++) out->held[k] = 0;
    const bool repeats = out->periodic == (1U << out->dimension) - 1;
    *density = repeats ? mass / out->extent : scree_specimen_box_density(out, &faces);
    scree_box box;
    status = scree_specimen_find_piece(&s->state, out, &box, error);
    return status ? status : scree_specimen_take_piece(out, &box, error);
}

/// A sample that is no box, or that some strain does not meet with any stress, has no such speeds.
static scree_status compare_moduli(const scree_conclusion *run, const scree_wave_numbers *own, scree_error *error)
{
    scree_specimen specimen = {0};
    scree_specimen_moduli found;
    scree_error why = {0};
    double density;
    scree_status status = take_specimen(run->s, &specimen, &density, &why);
    if (!status) status = scree_specimen_find_moduli(&specimen, &found, &why);
    if (!status) {
        const double along = found.stiffness[own->axis * (specimen.strain_components + 1)];
        scree_summary_set_number(run->summary, "wave_speed_bar", sqrt(found.isotropic.young / density));
        scree_summary_set_number(run->summary, "wave_speed_shear", sqrt(found.isotropic.shear / density));
        scree_summary_set_number(run->summary, "wave_speed_plane", sqrt(along / density));
    }
    scree_specimen_destroy(&specimen);
    if (status != SCREE_ERROR_IO) return SCREE_OK;
    if (error) *error = why;
    return status;
}

scree_status scree_waves_conclude(const scree_conclusion *run, scree_error *error)
{
    const scree_state *state = &run->s->state;
    const scree_wave_numbers *own = scree_wave_numbers_of(&run->s->model);
    pair pairs[SCREE_RECEIVERS / 2];
    if (!own || scree_waves_of(state)->record_count < 3) return SCREE_OK;
    const int component = find_component(state, own);
    scree_status status = SCREE_OK;
    if (own->receiver_count > 0) {
        status = find_arrivals(run, own, component, pairs, error);
        if (!status) status = write_receivers(run, own, error);
        if (!status) status = write_places(run, own, error);
        if (!status) status = write_arrivals(run, own, component, pairs, error);
    }
    if (!status) status = compare_moduli(run, own, error);
    return status || own->layers == 0 ? status : scree_waves_disperse(run, error);
}
