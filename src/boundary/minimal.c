/// Minimal kinematic conditions (Mesarovic and Padbidri 2005; P 3.1-3.5): pressure on all sides, and some components of
/// the mean velocity gradient of the boundary imposed by a penalty on the error of the RATE; the boundary may deform as
/// it likes otherwise.
///
/// With area vectors a_k of the boundary bodies (measure/facets.h), L = (1/V) sum v_k (x) a_k and one tensor C for
/// every prescribed component (e_i e_j, or its symmetric part for a strain rate), the errors are e_C = C : L -
/// target_C. P's functional Phi = 1/2 K sum e_C^2 gives F_k = - dPhi/dv_k = Lambda a_k with the uniform stress
///     Lambda = sum lambda_C C,     lambda_C = - kappa e_C,     kappa = K / V.
/// So the conditions are a uniform traction that adjusts itself; kappa is a viscosity [Pa s]. The forces add up to zero
/// (to the last bit: imposed_gradient.c), those of symmetric tensors C have no moment, and their power is V Lambda : L
/// exactly.
///
/// Integration. Explicitly the penalty would demand kappa h M < 2 with M_CC' = (1/V) C : (C' B), B = sum a (x) a /
/// m_k: light boundary bodies. Instead lambda is taken at the end of the kick h, e = e_0 + h M lambda, where e_0 is
/// what the velocities v(n-1/2) and all other forces at n would lead to: the small system
///     (1/kappa + h M) lambda = - e_0
/// is symmetric and positive, and stable for any kappa; it leaves of an error the fraction 1 / (1 + kappa h M) in one
/// step. kappa = INFINITY is the constraint itself, nothing left.
///
/// In steady motion the error is e = - lambda / kappa: by default kappa is chosen so that the confining pressure, the
/// scale of the contact forces, answers a relative error of one in a hundred (scree_minimal_viscosity).
///
/// Range. The quanta of a step are chosen before its contact forces are known, and with them lambda: bound() takes that
/// of the step before. That is no strict bound. The integers hold 2^12 times as much; a step whose Lambda leaves even
/// that applies none of it and raises SCREE_FLAG_FORCE_RANGE, which stops the run.
/// Cost: O(boundary) a step.
#include "boundary/minimal.h"
#include "measure/imposed_gradient.h"

#include "base/fixed.h"
#include "base/integer_sum.h"
#include "boundary/boundary.h"
#include "boundary/imposed_gradient.h"
#include "comm/comm.h"
#include "measure/facets.h"
#include "module/key_rows.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

#define RELATIVE_ERROR 0.01

typedef scree_minimal_config config;
static const scree_key keys[] = {
    NUMBER(config, penalty, "Pa s", .standard = "auto", ABOVE("0 Pa s"), TO("1e30 Pa s"),
           .meaning = "Minimal conditions: stress over the error of the rate; auto: the pressure answers an error of "
                      "1 %."),
};

/// What the keys become.
typedef struct numbers {
    double viscosity; ///< Pa s; 0: follows the pressure and the rate of the stage
} numbers;

static scree_status resolve(scree_model *model, scree_error *error)
{
    const config *own = scree_config_own(&scree_module_minimal, "boundary", model->config->boundary.own);
    numbers *found = scree_model_reserve_numbers(model, SCREE_SLOT_minimal);
    (void)error;
    found->viscosity = isnan(own->penalty) ? 0 : own->penalty;
    return SCREE_OK;
}

/// The prescribed components: tensors, and what they shall be [1/s].
typedef struct conditions {
    double tensor[9][9], target[9];
    int count;
} conditions;

static conditions conditions_get(const scree_imposed_gradient *imposed)
{
    conditions all = {0};
    for (int c = 0; c < 9; c++) {
        if (imposed->prescribed[c] == SCREE_FREE) continue;
        all.tensor[all.count][c] += imposed->prescribed[c] == SCREE_FULL ? 1 : 0.5;
        if (imposed->prescribed[c] == SCREE_SYMMETRIC) all.tensor[all.count][3 * (c % 3) + c / 3] += 0.5;
        all.target[all.count++] = imposed->target[c];
    }
    return all;
}

static double double_product(const double a[9], const double b[9])
{
    double sum = 0;
    for (int i = 0; i < 9; i++) sum += a[i] * b[i];
    return sum;
}

/// Adds what a node gives to V times the rate of change of the velocity gradient by all forces but the penalty, and to
/// B, of which the upper half is enough; where it is with another process, that does so.
static void add_node(const scree_state *state, size_t node, const scree_vector area, scree_integer_sum change[9],
                     scree_integer_sum mobility[9])
{
    size_t row = scree_boundary_row(state, node);
    if (row == SCREE_NO_ROW) return;
    const scree_sum_row *sum = &state->sum[row];
    const int64_t force[3] = {sum->fx, sum->fy, state->dimension == 3 ? sum->fz : 0};
    double inverse_mass = 1 / state->row[row].mass;
    for (int i = 0; i < state->dimension; i++) {
        double acceleration = scree_fixed_to(force[i], state->force_quantum) * inverse_mass;
        for (int j = 0; j < state->dimension; j++) scree_integer_sum_add(&change[3 * i + j], acceleration * area[j]);
        for (int j = i; j < state->dimension; j++)
            scree_integer_sum_add(&mobility[3 * i + j], area[i] * area[j] * inverse_mass);
    }
}

/// Velocity gradient that the next kick leads to without the penalty, from that of now, and B / V.
static void predict(const scree_state *state, scree_vector *area, double volume, double kick, const double now[9],
                    double rate[9], double mobility[9])
{
    scree_integer_sum sum[18] = {0}, *change = sum, *products = sum + 9;
    while (scree_comm_sum_next(state, sum, 18))
        for (size_t k = 0; k < scree_imposed(state)->count; k++) add_node(state, k, area[k], change, products);
    for (int c = 0; c < 9; c++) {
        int upper = c / 3 <= c % 3 ? c : 3 * (c % 3) + c / 3;
        rate[c] = now[c] + kick * scree_integer_sum_total(&change[c]) / volume;
        mobility[c] = scree_integer_sum_total(&products[upper]) / volume;
    }
}

/// Solves matrix x = right for a symmetric positive matrix (Cholesky, in place); x replaces `right`.
static void solve(double matrix[9][9], double *right, int count)
{
    for (int i = 0; i < count; i++) {
        for (int j = 0; j <= i; j++) {
            double sum = matrix[i][j];
            for (int k = 0; k < j; k++) sum -= matrix[i][k] * matrix[j][k];
            matrix[i][j] = i == j ? sqrt(sum) : sum / matrix[j][j];
        }
        for (int k = 0; k < i; k++) right[i] -= matrix[i][k] * right[k];
        right[i] /= matrix[i][i];
    }
    for (int i = count - 1; i >= 0; i--) {
        for (int k = i + 1; k < count; k++) right[i] -= matrix[k][i] * right[k];
        right[i] /= matrix[i][i];
    }
}

/// The stress Lambda of this step.
static void find_stress(const scree_imposed_gradient *imposed, const double rate[9], const double mobility[9],
                        double step, double stress[9])
{
    conditions all = conditions_get(imposed);
    double matrix[9][9], lambda[9];
    for (int a = 0; a < all.count; a++) {
        lambda[a] = all.target[a] - double_product(all.tensor[a], rate);
        for (int b = 0; b < all.count; b++) {
            double product[9] = {0};
            for (int i = 0; i < 9; i++)
                for (int k = 0; k < 3; k++) product[i] += all.tensor[b][3 * (i / 3) + k] * mobility[3 * k + i % 3];
            matrix[a][b] = step * double_product(all.tensor[a], product) + (a == b ? 1 / imposed->viscosity : 0);
        }
    }
    solve(matrix, lambda, all.count);
    memset(stress, 0, 9 * sizeof *stress);
    for (int a = 0; a < all.count; a++)
        for (int i = 0; i < 9; i++) stress[i] += lambda[a] * all.tensor[a][i];
}

/// Whether every term of scree_imposed_apply_stress is an integer below 2^60: a term is at most twice
/// the sum of the stress components times a factor and the distance of two nodes to the power d - 1. False for what is
/// not a number.
static bool stress_fits(const scree_model *model, const scree_state *state, const double stress[9])
{
    double largest = 0, reach = 0;
    scree_vector origin, position;
    for (int i = 0; i < 9; i++) largest += fabs(stress[i]);
    scree_boundary_position(state, 0, origin);
    for (size_t k = 1; k < scree_imposed(state)->count; k++) {
        scree_boundary_position(state, k, position);
        for (int i = 0; i < state->dimension; i++) reach = fmax(reach, fabs(position[i] - origin[i]));
    }
    double scale = state->dimension == 3 ? reach / 6 : 0.5 * model->thickness;
    return 2 * largest * scale * reach < ldexp(state->force_quantum, 60);
}

static scree_status add_forces(const scree_context *c, scree_error *error)
{
    const scree_model *model = c->model;
    scree_state *state = c->state;
    scree_imposed_gradient *imposed = scree_imposed(state);
    if (imposed->count == 0) return SCREE_OK;
    double actual[9], predicted[9], mobility[9];
    // The array of the forces holds the area vectors until they are known.
    scree_boundary_areas(model, state, imposed->force);
    double volume = scree_imposed_measure(state, imposed->force, actual);
    scree_imposed_record(state, actual);
    predict(state, imposed->force, volume, c->work->next_kick, actual, predicted, mobility);
    find_stress(imposed, predicted, mobility, c->work->next_kick, imposed->stress);
    const bool fits = stress_fits(model, state, imposed->stress);
    scree_status status = fits ? scree_imposed_strain(state, imposed->force, imposed->stress, error) : SCREE_OK;
    if (status) return status;
    memset(imposed->force, 0, imposed->count * sizeof *imposed->force);
    if (!fits) {
        c->work->flags |= SCREE_FLAG_FORCE_RANGE;
        c->work->flagged_id = scree_boundary_id(state, 0);
        return SCREE_OK;
    }
    scree_imposed_apply_stress(model, state, imposed->stress);
    scree_imposed_add_work(state);
    return SCREE_OK;
}

static double bound(const scree_context *c)
{
    const scree_model *model = c->model;
    const scree_state *state = c->state;
    double stress = scree_pressure_now(state), largest = 0;
    for (int i = 0; i < 9; i++) stress = fmax(stress, fabs(scree_imposed(state)->stress[i]));
    for (size_t f = 0; f < scree_facet_count(state); f++) {
        scree_facet facet = scree_facet_get(state, f);
        for (int k = 1; k < facet.corners; k++) {
            scree_vector edge;
            for (int i = 0; i < 3; i++) edge[i] = facet.position[k][i] - facet.position[0][i];
            largest = fmax(largest, scree_length(edge));
        }
    }
    // A body has about 2 d facets, and each of them gives it at most stress times length to the power d - 1.
    return 2 * state->dimension * stress * largest * (state->dimension == 3 ? largest : model->thickness);
}

double scree_minimal_viscosity(double pressure, const double target[9])
{
    double rate = 0;
    for (int i = 0; i < 9; i++) rate = fmax(rate, fabs(target[i]));
    return pressure > 0 && rate > 0 ? pressure / (RELATIVE_ERROR * rate) : INFINITY;
}

double scree_minimal_viscosity_at(const scree_model *model, double pressure, double rate)
{
    const numbers *own = scree_model_numbers(model, SCREE_SLOT_minimal);
    const double target[9] = {[0] = rate};
    return own && own->viscosity > 0 ? own->viscosity : scree_minimal_viscosity(pressure, target);
}

static const scree_pass passes[] = SCREE_IMPOSED_PASSES(add_forces);

static const scree_boundary face = {
    .full_mirrors = true,
    .needs_lag = "the tractions of minimal conditions are known behind the contacts of a step, too late for implicit "
                 "strains: give contact.deformation: relaxed",
    .resolve = resolve,
    .passes = passes,
    .pass_count = COUNT(passes),
    .bound = bound,
    SCREE_IMPOSED,
};

const scree_module scree_module_minimal = {
    .name = "minimal",
    .meaning = "no plates: pressure on all sides, and minimal kinematic conditions impose the strain rate",
    .choice_of = CHOICE_OF(IS("stages.boundary")),
    .keys = (const scree_keys[]){KEYS_OF("boundary", keys, config, .after = "servo_velocity")},
    .keys_count = 1,
    .numbers_size = sizeof(numbers),
    .boundary = &face,
    .spreads = true,
};
