/// Energies and the residual of their balance.
///
/// The schemes conserve the discrete kinetic energy T(n) = sum 1/2 m v(n-1/2) . v(n+1/2) + 1/2 J w(n-1/2) w(n+1/2):
/// from v(n+1/2) - v(n-1/2) = F(n)/m dt follows, without error,
///     T(n+1) - T(n) = sum 1/2 (F(n) + F(n+1)) . v(n+1/2) dt,
/// the trapezoidal work of the forces over the very displacement x(n+1) - x(n) = v(n+1/2) dt. The ledger books every
/// force by the same rule, so the residual
///     (kinetic + elastic - initial) - (plates + pressure + boundary + cell + gravity) + damping + friction - stiffness
/// holds no error of the integrator, only that of the trapezoidal rule along the elastic force laws: third order in the
/// step. Work done on the bodies is positive, dissipation is positive; `stiffness` is what the change of the tangential
/// stiffness puts into (positive) or takes out of the tangential springs.
/// J = m R^2 / 2 (disc), 2 m R^2 / 5 (sphere). Cost: O(bodies + contacts).
#include "measure/measure.h"

#include "integrate/integrate.h"

#include <math.h>

/// v(n-1/2) . v(n+1/2) of a body, translation and rotation.
static void add_kinetic(const scree_model *model, const scree_state *state, size_t index, scree_energy *energy)
{
    double mass = state->row[index].mass, inertia = scree_body_inertia(state, index), dt = state->step_size;
    scree_vector velocity, spin, force, torque;
    scree_body_half_velocity(model, state, index, velocity, spin);
    scree_body_force(model, state, index, force, torque);
    for (int k = 0; k < 3; k++) {
        energy->kinetic += 0.5 * mass * velocity[k] * (velocity[k] + dt * force[k] / mass);
        energy->kinetic_rotation += 0.5 * inertia * spin[k] * (spin[k] + dt * torque[k] / inertia);
    }
}

void scree_energy_measure(const scree_model *model, const scree_state *state, const scree_contact_table *table,
                          scree_energy *energy)
{
    const scree_ledger *ledger = &state->ledger;
    *energy = (scree_energy){0};
    double potential = 0;
    for (size_t id = 0; id < state->count; id++) {
        size_t row = state->row_of_id[id];
        add_kinetic(model, state, row, energy);
        scree_vector place;
        scree_body_place(state, row, place);
        for (int k = 0; k < state->dimension; k++) potential += state->row[row].mass * model->gravity[k] * place[k];
    }
    for (size_t c = 0; c < table->count; c++) {
        energy->elastic_normal += table->contact[c].elastic_normal;
        energy->elastic_tangential += table->contact[c].elastic_tangential;
    }
    energy->gravity = potential - ledger->gravity;
    double stored = energy->kinetic + energy->kinetic_rotation + energy->elastic_normal + energy->elastic_tangential;
    energy->residual = (stored - ledger->initial) -
                       (ledger->plates + ledger->pressure + ledger->boundary + ledger->cell + energy->gravity) +
                       ledger->damping + ledger->friction - ledger->stiffness;
    energy->relative = ledger->turnover > 0 ? fabs(energy->residual) / ledger->turnover : 0;
}
