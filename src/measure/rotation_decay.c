/// Decay of spins with the distance from a forced body: bins, fit, reach. See rotation.h. Cost: O(bodies).
#include "measure/rotation.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>
#include <math.h>
#include <stdlib.h>

#define BIN_WIDTH 0.5

/// Distance from the forced body [mean diameters] and |w| / |w_forced| of the body in `row`.
static void observe(const scree_model *model, const scree_state *state, size_t forced, size_t row, double *distance,
                    double *spin)
{
    scree_vector here, there, velocity, own, driving;
    scree_body_place(state, row, here);
    scree_body_place(state, forced, there);
    scree_body_motion(state, row, velocity, own);
    scree_body_motion(state, forced, velocity, driving);
    for (int i = 0; i < 3; i++) here[i] -= there[i];
    *distance = scree_length(here) / (2 * model->mean_radius);
    *spin = scree_length(own) / scree_length(driving);
}

static void fill_bins(const scree_model *model, const scree_state *state, size_t forced, scree_rotation_decay *decay)
{
    double square[SCREE_ROTATION_BINS] = {0}, distance, spin;
    for (size_t id = 0; id < state->count; id++) {
        size_t row = state->row_of_id[id];
        if (row == forced) continue;
        observe(model, state, forced, row, &distance, &spin);
        size_t b = (size_t)(distance / BIN_WIDTH);
        if (b >= SCREE_ROTATION_BINS) continue;
        decay->bin[b].mean += spin;
        square[b] += spin * spin;
        decay->bin[b].count++;
        if (b >= decay->bin_count) decay->bin_count = b + 1;
    }
    for (size_t b = 0; b < decay->bin_count; b++) {
        scree_rotation_bin *bin = &decay->bin[b];
        double count = (double)bin->count;
        bin->lower = BIN_WIDTH * (double)b;
        bin->mean = bin->count > 0 ? bin->mean / count : NAN;
        double variance = fmax(0, square[b] / count - bin->mean * bin->mean) * count / (count - 1);
        bin->standard_error = bin->count > 1 ? sqrt(variance / count) : NAN;
    }
}

static int ascending(const void *one, const void *other)
{
    double a = *(const double *)one, b = *(const double *)other;
    return (a > b) - (a < b);
}

/// Median of the means of the outer half of the bins.
static double floor_of(const scree_rotation_decay *decay)
{
    double mean[SCREE_ROTATION_BINS];
    size_t count = 0;
    for (size_t b = decay->bin_count / 2; b < decay->bin_count; b++)
        if (decay->bin[b].count > 0) mean[count++] = decay->bin[b].mean;
    qsort(mean, count, sizeof *mean, ascending);
    return count > 0 ? mean[count / 2] : 0;
}

/// The run of bins above the floor, from the first one that has bodies.
static void find_run(const scree_rotation_decay *decay, size_t *first, size_t *last)
{
    double limit = SCREE_ROTATION_FLOOR_FACTOR * floor_of(decay);
    for (*first = 0; *first < decay->bin_count && decay->bin[*first].count == 0;) (*first)++;
    for (*last = *first; *last < decay->bin_count; (*last)++)
        if (decay->bin[*last].count == 0 || !(decay->bin[*last].mean > limit)) break;
}

void scree_rotation_decay_measure(const scree_model *model, const scree_state *state, size_t forced,
                                  scree_rotation_decay *decay)
{
    *decay = (scree_rotation_decay){.bin_width = BIN_WIDTH, .amplitude = NAN, .length = NAN};
    decay->length_low = decay->length_high = NAN;
    fill_bins(model, state, forced, decay);
    double x[SCREE_ROTATION_BINS], y[SCREE_ROTATION_BINS], weight[SCREE_ROTATION_BINS];
    size_t first, last;
    find_run(decay, &first, &last);
    decay->fitted = last - first;
    decay->reach = last > first ? decay->bin[last - 1].lower + BIN_WIDTH : 0;
    for (size_t b = first; b < last; b++) {
        x[b - first] = decay->bin[b].lower + 0.5 * BIN_WIDTH;
        y[b - first] = log(decay->bin[b].mean);
        weight[b - first] = (double)decay->bin[b].count;
    }
    if (decay->fitted < 2) return;
    double intercept, slope, c00, c01, c11, squares;
    gsl_fit_wlinear(x, 1, weight, 1, y, 1, decay->fitted, &intercept, &slope, &c00, &c01, &c11, &squares);
    decay->amplitude = exp(intercept);
    decay->length = -1 / slope;
    if (decay->fitted < 3) return;
    // The weights are relative: the spread of the logarithms about the line gives their size.
    double freedom = (double)decay->fitted - 2, error = sqrt(c11 * squares / freedom);
    double half = gsl_cdf_tdist_Pinv(0.975, freedom) * error;
    decay->length_low = -1 / (slope - half);
    decay->length_high = slope + half < 0 ? -1 / (slope + half) : INFINITY;
}
