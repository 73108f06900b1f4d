/// Decay of spins with the distance from a forced body: bins, fit, reach. See rotation.h. Cost: O(bodies).
#include "measure/rotation.h"

#include "base/integer_sum.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>

#define BIN_WIDTH 1.0
#define FIRST     0.5

double scree_rotation_amount(const scree_state *state, size_t row)
{
    if (state->dimension == 2) return fabs(state->angle[row]);
    scree_vector velocity, spin;
    scree_body_motion(state, row, velocity, spin);
    return scree_length(spin);
}

bool scree_rotation_counts(const scree_state *state, size_t row)
{
    return scree_body_is_grain(state, row) && state->sum[row].contacts >= 2;
}

double scree_rotation_mean_amount(const scree_state *state, size_t forced)
{
    scree_integer_sum sum = {0};
    double count = 0;
    while (scree_integer_sum_next(&sum, 1)) {
        count = 0;
        for (size_t row = 0; row < state->count; row++) {
            if (row == forced || !scree_rotation_counts(state, row)) continue;
            scree_integer_sum_add(&sum, scree_rotation_amount(state, row));
            count++;
        }
    }
    return scree_integer_sum_total(&sum) / fmax(1, count);
}

size_t scree_rotation_bin_at(double distance)
{
    double position = (distance - FIRST) / BIN_WIDTH;
    return position >= 0 && position < SCREE_ROTATION_BINS ? (size_t)position : SCREE_ROTATION_BINS;
}

/// Distance from the forced body [mean diameters].
static double distance_between(const scree_model *model, const scree_state *state, size_t forced, size_t row)
{
    scree_vector here, there;
    scree_body_position(state, row, here);
    scree_body_position(state, forced, there);
    for (int i = 0; i < 3; i++) here[i] -= there[i];
    return scree_length(here) / (2 * model->mean_radius);
}

/// Shells of amounts over `scale`.
static void fill_bins(const scree_model *model, const scree_state *state, size_t forced, double scale,
                      scree_rotation_decay *decay)
{
    double square[SCREE_ROTATION_BINS] = {0};
    size_t id = 0;
    for (uint32_t row; (row = scree_next_by_id(state, &id)) != SCREE_NO_ROW;) {
        if (row == forced || !scree_rotation_counts(state, row)) continue;
        double ratio = scree_rotation_amount(state, row) / scale;
        double distance = distance_between(model, state, forced, row);
        size_t b = scree_rotation_bin_at(distance);
        if (b >= SCREE_ROTATION_BINS) continue;
        decay->bin[b].distance += distance;
        decay->bin[b].mean += ratio;
        square[b] += ratio * ratio;
        decay->bin[b].count++;
        if (b >= decay->bin_count) decay->bin_count = b + 1;
    }
    for (size_t b = 0; b < decay->bin_count; b++) {
        scree_rotation_bin *bin = &decay->bin[b];
        double count = (double)bin->count;
        bin->lower = FIRST + BIN_WIDTH * (double)b;
        bin->distance = bin->count > 0 ? bin->distance / count : NAN;
        bin->mean = bin->count > 0 ? bin->mean / count : NAN;
        double variance = fmax(0, square[b] / count - bin->mean * bin->mean) * count / (count - 1);
        bin->standard_error = bin->count > 1 ? sqrt(variance / count) : NAN;
    }
}

/// Median of the means of the outer half of the bins that have bodies.
static double far_level(const scree_rotation_decay *decay)
{
    double mean[SCREE_ROTATION_BINS];
    size_t count = 0;
    for (size_t b = decay->bin_count / 2; b < decay->bin_count; b++)
        if (decay->bin[b].count > 0) mean[count++] = decay->bin[b].mean;
    gsl_sort(mean, 1, count);
    return count > 0 ? gsl_stats_median_from_sorted_data(mean, 1, count) : 0;
}

/// The run of bins that feel the forced body, from the first one that has bodies.
static void find_run(const scree_rotation_decay *decay, size_t *first, size_t *last)
{
    for (*first = 0; *first < decay->bin_count && decay->bin[*first].count == 0;) (*first)++;
    for (*last = *first; *last < decay->bin_count; (*last)++)
        if (decay->bin[*last].count == 0 || !(decay->bin[*last].mean >= decay->bin[*last].felt)) break;
}

void scree_rotation_background_measure(const scree_model *model, const scree_state *state, size_t forced, double scale,
                                       scree_rotation_background *background)
{
    scree_rotation_decay decay = {.bin_count = 0};
    fill_bins(model, state, forced, scale, &decay);
    background->mean = scree_rotation_mean_amount(state, forced) / scale;
    for (size_t b = 0; b < SCREE_ROTATION_BINS; b++)
        background->shell[b] = b < decay.bin_count ? decay.bin[b].mean : NAN;
}

/// What is felt, from the background and what the outer shells do.
static void set_limits(scree_rotation_decay *decay, const scree_rotation_background *background)
{
    const double far = far_level(decay);
    decay->limit = SCREE_ROTATION_FLOOR_FACTOR * (background ? fmax(background->mean, far) : far);
    for (size_t b = 0; b < decay->bin_count; b++)
        decay->bin[b].felt = SCREE_ROTATION_FLOOR_FACTOR * (background ? fmax(background->shell[b], far) : far);
}

void scree_rotation_decay_measure(const scree_model *model, const scree_state *state, size_t forced,
                                  const scree_rotation_background *background, scree_rotation_decay *decay)
{
    *decay = (scree_rotation_decay){.bin_width = BIN_WIDTH, .first = FIRST, .amplitude = NAN, .length = NAN};
    decay->length_low = decay->length_high = NAN;
    fill_bins(model, state, forced, scree_rotation_amount(state, forced), decay);
    set_limits(decay, background);
    double x[SCREE_ROTATION_BINS], y[SCREE_ROTATION_BINS], weight[SCREE_ROTATION_BINS];
    size_t first, last;
    find_run(decay, &first, &last);
    decay->fitted = last - first;
    decay->reach = last > first ? decay->bin[last - 1].lower + BIN_WIDTH : 0;
    for (size_t b = first; b < last; b++) {
        x[b - first] = decay->bin[b].distance;
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
