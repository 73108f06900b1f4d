/// Energies and the residual of their balance.
///
/// The schemes conserve the discrete kinetic energy T(n) = sum 1/2 m v(n-1/2) . v(n+1/2) + 1/2 J w(n-1/2) w(n+1/2):
/// from v(n+1/2) - v(n-1/2) = F(n)/m dt follows, without error,
///     T(n+1) - T(n) = sum 1/2 (F(n) + F(n+1)) . v(n+1/2) dt,
/// the trapezoidal work of the forces over the very displacement x(n+1) - x(n) = v(n+1/2) dt. The ledger accumulates
/// every force by the same rule, so the residual
///     (kinetic + elastic - initial) - (plates + pressure + boundary + periodic + forced + outside + gravity) +
///     damping + friction - stiffness - scheme + removed
/// holds no error of the integrator, only that of the trapezoidal rule along the elastic force laws: third order in the
/// step. Work done on the bodies is positive, dissipation is positive; `stiffness` is what the change of the tangential
/// stiffness puts into (positive) or takes out of the tangential springs.
/// Where the step changes from h to h', T(n) is taken with h by the step that ends and with h' by the one that begins
/// (two_timescales.c): with v(n) = v(n-1/2) + h/2 a(n), T = sum 1/2 m (v(n)^2 - h^2/4 a(n)^2), and likewise for spins.
/// The difference, sum m a^2 (h^2 - h'^2) / 8, is accumulated as `scheme`; it goes to zero with the square of the step.
/// A scheme with velocities of its own at n has T = sum 1/2 m v^2 + 1/2 J w^2 of these, and tells `scheme` what it adds
/// to that beside the work of the forces by the same rule (integrate/gear.c). J = m R^2 / 2 (disc), 2 m R^2 / 5
/// (sphere). Cost: O(bodies + contacts).
///
/// The guard stops a run by what is measured here, and `scheme` is part of the state: all sums are in integers, over
/// rows and contacts in any order (base/integer_sum.h).
///
/// The residual is judged against all energy that there is and was: what there was at the begin, what has been turned
/// over (dissipation included), what gravity did on balance, what is stored now. Nothing is ever exactly at rest, so
/// round-off, which has no such energy to be measured by, has its own part of the scale. Positions are known to
/// d = ROUNDING units in the last place of the largest coordinate L, hence
///     a contact force f or a weight m g    to an energy    f d, m g d     (quanta of forces are finer: base/fixed.h),
///     a body that moves by d in a step     to              m (d / step)^2 / 2, slower than which it stands for long,
///     two bodies that should just touch    to              (2/5) K sqrt(R) d^(5/2), which may be felt after they part,
///     ... one a plate that moves by w      to              K sqrt(R) d^(3/2) w, if they part within a step,
///     the sum of N terms m g . x           to              N / 2 units in the last place of the sum of |m g . x|.
/// The sums of kinetic and elastic energy have errors of the same kind, but against themselves, which are in the scale.
#include "measure/measure.h"

#include "base/integer_sum.h"
#include "comm/comm.h"
#include "integrate/integrate.h"
#include "state/plates.h"
#include "state/sleep.h"

#include <float.h>
#include <math.h>

#define ROUNDING 16.0

/// What is summed over bodies.
typedef enum body_sum {
    KINETIC,          ///< J
    KINETIC_ROTATION, ///< J
    MASS,             ///< kg
    POTENTIAL,        ///< J, m g . x
    MAGNITUDES,       ///< J, |m g . x|
    BODY_SUMS
} body_sum;

/// What is summed over contacts.
typedef enum contact_sum {
    ELASTIC_NORMAL,     ///< J
    ELASTIC_TANGENTIAL, ///< J
    NORMAL_FORCE,       ///< N
    CONTACT_SUMS
} contact_sum;

/// The modules that may prescribe rotations.
typedef struct turners {
    bool (*by[SCREE_MODULE_COUNT])(const scree_state *state, size_t row);
    size_t count;
} turners;

static turners find_turners(void)
{
    turners found = {.count = 0};
    for (int m = 0; m < SCREE_MODULE_COUNT; m++)
        if (scree_modules[m]->turns) found.by[found.count++] = scree_modules[m]->turns;
    return found;
}

/// v(n-1/2) . v(n+1/2) of a body, translation and rotation.
static void add_kinetic(const scree_model *model, const scree_state *state, const turners *turned, size_t index,
                        scree_integer_sum *sum)
{
    double kinetic, rotation;
    scree_body_kinetic(model, state, index, &kinetic, &rotation);
    scree_integer_sum_add(&sum[KINETIC], kinetic);
    for (size_t k = 0; k < turned->count; k++)
        if (turned->by[k](state, index)) return;
    scree_integer_sum_add(&sum[KINETIC_ROTATION], rotation);
}

/// F^2 / m + T^2 / J of a body. Called for every body at most steps of two timescales, so without divisions to spare.
static double inertial_power(const scree_model *model, const scree_state *state, size_t index)
{
    const scree_row *row = &state->row[index];
    const scree_sum_row *sum = &state->sum[index];
    const double *gravity = model->gravity, quantum = state->force_quantum;
    const double radius = scree_body_turning_radius(state, index);
    double square = radius * radius, inverse = 1 / (row->mass * square);
    double fx = (double)sum->fx * quantum + row->mass * gravity[0];
    double fy = (double)sum->fy * quantum + row->mass * gravity[1];
    if (state->dimension == 2) {
        double torque = (double)sum->torque * state->torque_quantum;
        return ((fx * fx + fy * fy) * square + 2 * torque * torque) * inverse;
    }
    const scree_torque_row *turning = &state->torque[index];
    double fz = (double)sum->fz * quantum + row->mass * gravity[2], force = fx * fx + fy * fy + fz * fz;
    double tx = (double)turning->x, ty = (double)turning->y, tz = (double)turning->z;
    double torque = (tx * tx + ty * ty + tz * tz) * state->torque_quantum * state->torque_quantum;
    return (force * square + 2.5 * torque) * inverse;
}

void scree_energy_change_step(const scree_model *model, scree_state *state, double before, double after)
{
    scree_integer_sum sum = {0};
    if (scree_integrator_get(model->scheme)->velocity) return;
    while (scree_comm_sum_next(state, &sum, 1))
        for (size_t row = 0; row < state->count; row++)
            if (!scree_body_sleeps(state, row)) scree_integer_sum_add(&sum, inertial_power(model, state, row));
    state->ledger.scheme += 0.125 * (before * before - after * after) * scree_integer_sum_total(&sum);
}

/// What the scale of the residual needs of gravity and coordinates, beside the energies themselves.
static void add_place(const scree_model *model, const scree_state *state, size_t row, scree_integer_sum *sum,
                      double *largest)
{
    double potential = 0, magnitudes = 0;
    scree_vector position;
    double mass = state->row[row].mass;
    scree_body_position(state, row, position);
    for (int k = 0; k < state->dimension; k++) {
        double part = mass * model->gravity[k] * position[k];
        potential += part;
        magnitudes += fabs(part);
        *largest = fmax(*largest, fabs(position[k]));
    }
    scree_integer_sum_add(&sum[MASS], mass);
    scree_integer_sum_add(&sum[POTENTIAL], potential);
    scree_integer_sum_add(&sum[MAGNITUDES], magnitudes);
}

/// largest [m]: coordinate, in magnitude.
static void sum_bodies(const scree_model *model, const scree_state *state, double total[BODY_SUMS], double *largest)
{
    scree_integer_sum sum[BODY_SUMS] = {0};
    const turners turned = find_turners();
    *largest = 0;
    while (scree_comm_sum_next(state, sum, BODY_SUMS))
        for (size_t row = 0; row < state->count; row++) {
            add_kinetic(model, state, &turned, row, sum);
            add_place(model, state, row, sum, largest);
        }
    scree_comm_maximum(state, largest, 1);
    for (int k = 0; k < BODY_SUMS; k++) total[k] = scree_integer_sum_total(&sum[k]);
}

static void sum_contacts(const scree_state *state, const scree_contact_table *table, double total[CONTACT_SUMS])
{
    scree_integer_sum sum[CONTACT_SUMS] = {0};
    while (scree_comm_sum_next(state, sum, CONTACT_SUMS))
        for (size_t c = 0; c < table->count; c++) {
            scree_integer_sum_add(&sum[ELASTIC_NORMAL], table->contact[c].elastic_normal);
            scree_integer_sum_add(&sum[ELASTIC_TANGENTIAL], table->contact[c].elastic_tangential);
            scree_integer_sum_add(&sum[NORMAL_FORCE], table->contact[c].normal_force);
        }
    for (int k = 0; k < CONTACT_SUMS; k++) total[k] = scree_integer_sum_total(&sum[k]);
}

static double spring_energy(const scree_elastic *elastic, const scree_pair_constants *pair, double radius,
                            double overlap)
{
    return elastic->energy(pair, radius, overlap);
}

/// The farthest that a plate moves in a step [m].
static double way_of_plates(const scree_state *state)
{
    double speed = 0;
    for (int w = 0; w < SCREE_WALL_COUNT; w++) {
        const scree_wall *plate = &scree_plates(state)[w];
        if (plate->active) speed = fmax(speed, fabs(plate->velocity) + scree_length(plate->tangential_velocity));
    }
    return speed * state->tick;
}

/// Energy to which round-off lets the balance be known: the head of this file.
static double energy_of_rounding(const scree_model *model, const scree_state *state, const double body[BODY_SUMS],
                                 double largest, double contact_force)
{
    const double distance = ROUNDING * DBL_EPSILON * largest, speed = state->tick > 0 ? distance / state->tick : 0;
    double weight = body[MASS] * scree_length(model->gravity), bodies = (double)scree_state_total(state);
    // The force over the energy of a spring is between 2 / d and 2.5 / d.
    const double parting = distance > 0 ? 1 + 2.5 * way_of_plates(state) / distance : 1;
    return distance * (contact_force + weight) + 0.5 * body[MASS] * speed * speed +
           bodies * scree_model_mean_of(model, spring_energy, model->mean_radius, distance) * parting +
           0.5 * DBL_EPSILON * bodies * body[MAGNITUDES];
}

void scree_energy_measure(const scree_model *model, const scree_state *state, const scree_contact_table *table,
                          scree_energy *energy)
{
    const scree_ledger *ledger = &state->ledger;
    double body[BODY_SUMS], contact[CONTACT_SUMS], largest;
    sum_bodies(model, state, body, &largest);
    sum_contacts(state, table, contact);
    *energy = (scree_energy){.kinetic = body[KINETIC],
                             .kinetic_rotation = body[KINETIC_ROTATION],
                             .elastic_normal = contact[ELASTIC_NORMAL],
                             .elastic_tangential = contact[ELASTIC_TANGENTIAL],
                             .gravity = body[POTENTIAL] - ledger->gravity};
    double stored = energy->kinetic + energy->kinetic_rotation + energy->elastic_normal + energy->elastic_tangential;
    energy->residual = (stored - ledger->initial) -
                       (ledger->plates + ledger->pressure + ledger->boundary + ledger->periodic + ledger->forced +
                        ledger->outside + energy->gravity) +
                       ledger->damping + ledger->friction - ledger->stiffness - ledger->scheme + ledger->removed;
    for (int m = 0; m < SCREE_MODULE_COUNT; m++)
        if (scree_modules[m]->work) energy->residual -= scree_modules[m]->work(state);
    energy->scale = ledger->initial + ledger->turnover + fabs(ledger->removed) + fabs(energy->gravity) + stored +
                    energy_of_rounding(model, state, body, largest, contact[NORMAL_FORCE]);
    energy->relative = energy->scale <= 0 ? 0 : fabs(energy->residual) / energy->scale; // not a number: the guard stops
}
