/// How far the assembly is from equilibrium: the mean resultant force (contacts, boundary and gravity) on the bodies
/// that touch something, over the mean contact force. Bodies without contact are left out: they are not part of the
/// assembly, and many of them at rest would make it look calmer than it is. So are prescribed components of the motion,
/// and bodies without any other.
///
/// The mean ratio takes the resultant as the change of momentum since the last sample over its time: friction that
/// depends on the sign of a velocity (hertz_brilliantov) turns round at every step in a sample at rest, and its
/// instantaneous resultant says nothing. Cost: O(bodies + contacts).
/// It ends stages, so it is made of sums in integers.
#include "measure/measure.h"

#include "base/integer_sum.h"
#include "comm/comm.h"
#include "integrate/integrate.h"
#include "state/sleep.h"

#include <math.h>

/// Sum of the magnitudes of the contact forces [N].
static double sum_contacts(const scree_state *state, const scree_contact_table *table)
{
    scree_integer_sum sum = {0};
    while (scree_comm_sum_next(state, &sum, 1))
        for (size_t c = 0; c < table->count; c++)
            scree_integer_sum_add(&sum, hypot(table->contact[c].normal_force, table->contact[c].tangential_force));
    return scree_integer_sum_total(&sum);
}

/// Mean over the bodies that touch something of the force that `resultant_on` gives, over the mean contact force.
static double ratio(const scree_model *model, const scree_state *state, const scree_contact_table *table,
                    void (*resultant_on)(const scree_model *, const scree_state *, size_t row, scree_vector force))
{
    scree_integer_sum resultant = {0};
    scree_vector force;
    int64_t number[2] = {0, (int64_t)table->count}; // bodies, contacts
    const unsigned all = state->dimension == 2 ? 3 : 7;
    while (scree_comm_sum_next(state, &resultant, 1)) {
        number[0] = 0;
        for (size_t row = 0; row < state->count; row++) {
            if (!scree_body_is_grain(state, row) || scree_body_contacts(state, row) == 0) continue;
            if ((scree_body_held(state, row) & all) == all) continue;
            resultant_on(model, state, row, force);
            scree_body_leave_free(state, row, force, (scree_vector){0});
            scree_integer_sum_add(&resultant, scree_length(force));
            number[0]++;
        }
    }
    scree_comm_add(state, number, 2);
    double contact_force = sum_contacts(state, table);
    if (number[0] == 0 || !(contact_force > 0)) return NAN;
    return (scree_integer_sum_total(&resultant) / (double)number[0]) / (contact_force / (double)number[1]);
}

static void present_force(const scree_model *model, const scree_state *state, size_t row, scree_vector force)
{
    scree_vector torque;
    scree_body_force(model, state, row, force, torque);
}

double scree_unbalanced_ratio(const scree_model *model, const scree_state *state, const scree_contact_table *table)
{
    return ratio(model, state, table, present_force);
}

static void mean_force(const scree_model *model, const scree_state *state, size_t row, scree_vector force)
{
    double time = (double)(state->step - state->sampled_step) * state->tick, mass = state->row[row].mass;
    scree_vector velocity, spin;
    scree_body_velocity(model, state, row, velocity, spin);
    for (int k = 0; k < 3; k++) force[k] = mass * (velocity[k] - state->sampled_velocity[row][k]) / time;
}

double scree_mean_unbalanced_ratio(const scree_model *model, const scree_state *state, const scree_contact_table *table)
{
    return ratio(model, state, table, state->step > state->sampled_step ? mean_force : present_force);
}
