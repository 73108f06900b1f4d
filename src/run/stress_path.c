/// What a geotechnician reads off a test: the tensors of stress and strain by component, p, q, mu, void ratio and
/// fabric at every sample; of shear the friction coefficient of the steady part with its confidence.
///
/// Stress: from contacts over the sample (measure/measure.h), so that the friction of plates is in it; of a whole
/// periodic cell contacts and motion. With axial the last axis, lateral the mean of the others:
///     p = mean of the normal stresses, q = axial - lateral (Wood 1990, 1.4), mu = sigma_(first, last) / sigma_axial.
/// Strain: logarithmic, of the cell, between plates of their distance, else of the Delaunay boundary; from the begin of
/// the first loading stage on, over all stages that follow.
/// Fabric (Luding 2004): F = 1/V sum over grains V_p sum over its contacts with grains n (x) n, so its trace is
/// solid fraction times contacts a grain, of equal grains; told are its trace, the difference of its largest and least
/// principal value over the trace, and the direction of the largest one.
///
/// mu of the steady part: the begin of the loading is left out up to the row d <= n / 2 for which the square of the
/// standard error of uncorrelated samples, sum of (x - mean)^2 / (n - d)^2, is least (MSER, White 1997). The error of
/// the mean counts n / tau samples, tau = 1 + 2 sum of the autocorrelation up to its first value that is not positive;
/// mu_error is 1.96 of them. Cost: O(contacts) a sample; rows times the lags of the autocorrelation at the end.
#include "average/tensor.h"
#include "comm/comm.h"
#include "io/loading_stage.h"
#include "measure/measure.h"
#include "model/model.h"
#include "run/conclusion.h"
#include "run/stage_face.h"

#include <math.h>
#include <string.h>

/// Effective samples without which there is no error.
#define LEAST_SAMPLES 4.0
#define CONFIDENCE    1.96

// ---- the zero of strain ------------------------------------------------------------------------------------------

typedef struct origin {
    double strain[9];   ///< 1, accumulated strain at the begin of the first loading stage
    double distance[3]; ///< m, of the plates across each axis then; 0: there were none
    uint64_t begun;     ///< 1: there has been one
} origin;

/// Distance [m] of the plates across an axis; 0 where they do not stand.
static double plate_distance(const scree_state *state, int axis)
{
    const int first = axis == state->dimension - 1 ? SCREE_WALL_BOTTOM : axis == 0 ? SCREE_WALL_LEFT : SCREE_WALL_FRONT;
    const scree_wall *pair = &scree_plates(state)[first];
    return pair[0].active && pair[1].active ? -(pair[0].position + pair[1].position) : 0;
}

static scree_status begin(const scree_context *c, scree_error *error)
{
    origin *from = c->state->own[SCREE_SLOT_stress_path];
    const scree_config_stage *stage = &c->model->stages[c->state->stage.index];
    (void)error;
    if (from->begun || !scree_modules[stage->kind]->stage->loading) return SCREE_OK;
    scree_strain_measure(c->state, from->strain);
    for (int k = 0; k < c->state->dimension; k++) from->distance[k] = plate_distance(c->state, k);
    from->begun = 1;
    return SCREE_OK;
}

static const scree_field fields[] = {
    SCREE_FIELD_ONE(stress_path, origin, strain, "stress_path/strain", SCREE_FIELD_DOUBLE, 9, "1",
                    "strain accumulated before the first loading stage, 3 x 3 by rows"),
    SCREE_FIELD_ONE(stress_path, origin, distance, "stress_path/distance", SCREE_FIELD_DOUBLE, 3, "m",
                    "distance of the plates across each axis at its begin; 0: there were none"),
    SCREE_FIELD_ONE(stress_path, origin, begun, "stress_path/begun", SCREE_FIELD_UINT64, 1, "1",
                    "1: a loading stage has begun", SCREE_RANGE(0, 1)),
};

// ---- a sample ----------------------------------------------------------------------------------------------------

enum {
    STRESS_XX,
    STRESS_YY,
    STRESS_ZZ,
    STRESS_SHEAR,
    STRAIN_XX,
    STRAIN_YY,
    STRAIN_ZZ,
    STRAIN_SHEAR,
    MEAN,
    DEVIATOR,
    MU,
    VOID_RATIO,
    FABRIC_TRACE,
    FABRIC_DEVIATOR,
    FABRIC_DIRECTION,
};

static const scree_result columns[] = {
    [STRESS_XX] = {"stress_xx", "Pa",
                   "stress from contacts, compression positive; of a periodic cell with that of motion"},
    [STRESS_YY] = {"stress_yy", "Pa", "the same along y"},
    [STRESS_ZZ] = {"stress_zz", "Pa", "the same along z; not a number in 2D"},
    [STRESS_SHEAR] = {"stress_shear", "Pa",
                      "the shear stress of the first and the last axis, in the sense of its strain"},
    [STRAIN_XX] = {"strain_xx", "1",
                   "logarithmic strain since the begin of the first loading stage, compression positive; runs on "
                   "through stages, as time does"},
    [STRAIN_YY] = {"strain_yy", "1", "the same along y"},
    [STRAIN_ZZ] = {"strain_zz", "1", "the same along z; not a number in 2D"},
    [STRAIN_SHEAR] = {"strain_shear", "1",
                      "the engineering shear strain of the first and the last axis, in the same way"},
    [MEAN] = {"p", "Pa", "mean of the normal stresses of these columns, in 2D of two"},
    [DEVIATOR] = {"q", "Pa", "axial stress less lateral one: of the last axis less the mean of the others"},
    [MU] = {"mu", "1", "stress_shear over the normal stress of the last axis"},
    [VOID_RATIO] = {"void_ratio", "1",
                    "volume of the voids over that of the particles, by solid_fraction: between plates of the outline, "
                    "whose gaps at the plates may change where `volume` does not"},
    [FABRIC_TRACE] = {"fabric_trace", "1", "trace of the fabric tensor: volume fraction times contacts"},
    [FABRIC_DEVIATOR] = {"fabric_deviator", "1", "its largest less its least principal value, over its trace"},
    [FABRIC_DIRECTION] = {"fabric_direction", "rad",
                          "direction of its largest principal value: angle to x, counter-clockwise; in 3D to z"},
};

static void sample_stress(const scree_context *c, double *value)
{
    const int dimension = c->state->dimension, last = dimension - 1;
    double stress[9], lateral = 0;
    if (scree_periodic_is_whole(c->state))
        scree_periodic_stress(c->model, c->state, stress);
    else
        scree_stress_from_contacts(c->state, c->table, scree_sample_volume(c->model, c->state), stress);
    for (int k = 0; k < 3; k++) value[STRESS_XX + k] = k < dimension ? -stress[4 * k] : NAN;
    for (int k = 0; k < last; k++) lateral -= stress[4 * k] / last;
    const double axial = -stress[4 * last];
    value[STRESS_SHEAR] = 0.5 * (stress[last] + stress[3 * last]);
    value[MEAN] = (axial + last * lateral) / dimension;
    value[DEVIATOR] = axial - lateral;
    value[MU] = value[STRESS_SHEAR] / axial;
}

static void sample_strain(const scree_context *c, double *value)
{
    const origin *from = c->state->own[SCREE_SLOT_stress_path];
    const int dimension = c->state->dimension, last = dimension - 1;
    double strain[9];
    for (int k = STRAIN_XX; k <= STRAIN_SHEAR; k++) value[k] = NAN;
    if (!from->begun) return;
    scree_strain_measure(c->state, strain);
    for (int k = 0; k < 9; k++) strain[k] -= from->strain[k];
    for (int k = 0; k < dimension; k++) {
        const double distance = plate_distance(c->state, k);
        const bool plates = distance > 0 && from->distance[k] > 0;
        value[STRAIN_XX + k] = plates ? log(from->distance[k] / distance) : -strain[4 * k];
    }
    value[STRAIN_SHEAR] = strain[last] + strain[3 * last];
}

static void add_contact(const scree_state *state, const scree_contact *contact, scree_integer_sum tensor[9])
{
    const double volume = scree_body_volume(state, contact->first) + scree_body_volume(state, contact->second);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            scree_integer_sum_add(&tensor[3 * i + j], volume * contact->normal[i] * contact->normal[j]);
}

/// No term is larger than two volumes of the largest grain.
static void bound_terms(const scree_state *state, scree_integer_sum tensor[9])
{
    double largest = 0;
    for (size_t row = 0; row < state->count; row++) largest = fmax(largest, scree_body_volume(state, row));
    for (int k = 0; k < 9; k++) tensor[k].largest = 2.0625 * largest;
}

static void sample_fabric(const scree_context *c, double *value)
{
    const scree_state *state = c->state;
    double tensor[9];
    scree_integer_sum solid = {0}, sum[9] = {0}; // rows have another order after a restart, and in parts
    while (scree_comm_sum_next(state, sum, 9)) {
        if (sum[0].pass == SCREE_INTEGER_SUM_LOOKS) {
            bound_terms(state, sum);
            continue;
        }
        for (size_t k = 0; k < c->table->count; k++)
            if (!scree_contact_is_outer(&c->table->contact[k])) add_contact(state, &c->table->contact[k], sum);
    }
    for (int k = 0; k < 9; k++) tensor[k] = scree_integer_sum_total(&sum[k]);
    while (scree_comm_sum_next(state, &solid, 1))
        for (size_t row = 0; row < state->count; row++)
            if (scree_body_is_grain(state, row)) scree_integer_sum_add(&solid, scree_body_volume(state, row));
    const double trace = tensor[0] + tensor[4] + tensor[8];
    value[FABRIC_TRACE] = trace * value[FABRIC_TRACE] / scree_integer_sum_total(&solid);
    value[FABRIC_DEVIATOR] = value[FABRIC_DIRECTION] = NAN;
    if (!(trace > 0)) return;
    double principal[3], axis[9];
    scree_tensor_principal(tensor, state->dimension, principal, axis);
    value[FABRIC_DEVIATOR] = (principal[0] - principal[state->dimension - 1]) / trace;
    value[FABRIC_DIRECTION] = state->dimension == 2 ? atan(axis[1] / axis[0]) : acos(fmin(1, fabs(axis[2])));
}

static scree_status sample(const scree_context *c, size_t index, double *value, scree_error *error)
{
    double solid;
    (void)index;
    scree_status status = scree_solid_fraction(c->state, &solid, error);
    if (status) return status;
    sample_stress(c, value);
    sample_strain(c, value);
    value[VOID_RATIO] = 1 / solid - 1;
    value[FABRIC_TRACE] = solid;
    sample_fabric(c, value);
    return SCREE_OK;
}

// ---- the steady part ---------------------------------------------------------------------------------------------

typedef struct steady {
    size_t first;       ///< row at which it begins
    double mean, error; ///< 1
} steady;

static double mean_of(const double *x, size_t first, size_t last)
{
    double sum = 0;
    for (size_t k = first; k < last; k++) sum += x[k];
    return sum / (double)(last - first);
}

/// Sum of the products of departures `lag` rows apart.
static double covariance(const double *x, size_t first, size_t last, double mean, size_t lag)
{
    double sum = 0;
    for (size_t k = first; k + lag < last; k++) sum += (x[k] - mean) * (x[k + lag] - mean);
    return sum;
}

/// Sums go from the end on, relative to its value.
static size_t steady_begin(const double *x, size_t first, size_t last)
{
    double least = INFINITY, sum = 0, squares = 0;
    size_t best = first;
    for (size_t d = last; d-- > first;) {
        const double count = (double)(last - d), off = x[d] - x[last - 1];
        sum += off;
        squares += off * off;
        const double error = (squares - sum * sum / count) / (count * count);
        if (d > first + (last - first) / 2 || error > least) continue;
        least = error;
        best = d;
    }
    return best;
}

/// Half of the interval of 95 % of the mean of correlated samples; NAN where too few of them are independent.
static double error_of(const double *x, size_t first, size_t last, double mean)
{
    const double count = (double)(last - first), variance = covariance(x, first, last, mean, 0);
    double tau = 1;
    for (size_t lag = 1; lag < last - first; lag++) {
        const double correlation = covariance(x, first, last, mean, lag) / variance;
        if (!(correlation > 0)) break;
        tau += 2 * correlation;
    }
    return count / tau < LEAST_SAMPLES ? NAN : CONFIDENCE * sqrt(variance / count * tau / count);
}

static steady steady_part(const double *x, scree_loading_rows rows)
{
    steady s = {.first = steady_begin(x, rows.first, rows.last)};
    s.mean = mean_of(x, s.first, rows.last);
    s.error = error_of(x, s.first, rows.last, s.mean);
    return s;
}

static const scree_result results[] = {
    {"mu", "1",
     "of shear: mean of the column over its steady part, which begins at mu_from (MSER, at most the first "
     "half is left out)"},
    {"mu_error", "1", "half of its interval of 95 %, with the autocorrelation of the samples"},
    {"mu_from", "1", "strain at which the steady part begins"},
};

/// The loading stage shears: its shear strain is the larger one.
static bool shears(const scree_series *series, scree_loading_rows rows)
{
    const double *shear = scree_series_get(series, "boundary_shear_strain");
    const double *axial = scree_series_get(series, "boundary_axial_strain");
    return rows.last > rows.first + 1 && fabs(shear[rows.last - 1]) > 2 * fabs(axial[rows.last - 1]) &&
           fabs(shear[rows.last - 1]) > 0.01;
}

static scree_status conclude(const scree_conclusion *run, scree_error *error)
{
    const scree_loading_rows rows = scree_loading_rows_find(run->series);
    (void)error;
    if (!shears(run->series, rows)) return SCREE_OK;
    const double *strain = scree_series_get(run->series, "axial_strain");
    const steady s = steady_part(scree_series_get(run->series, "mu"), rows);
    scree_summary_set_number(run->summary, "mu", s.mean);
    scree_summary_set_number(run->summary, "mu_error", s.error);
    scree_summary_set_number(run->summary, "mu_from", strain[s.first]);
    return SCREE_OK;
}

const scree_module scree_module_stress_path = {
    .name = "stress_path",
    .meaning = "stress, strain and fabric of the sample; friction coefficient of steady shear",
    .state_size = sizeof(origin),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .begin = begin,
    .begins_whole = scree_begins_in_parts,
    .columns = SCREE_RESULTS_IN_PARTS(columns, sample),
    .results = SCREE_RESULTS(results, NULL),
    .conclude = conclude,
};
