/// Taking bodies out, and what the balance of energies says of it.
///
/// With a body go its kinetic and potential energy, m (v^2 / 2 - g . x), and the elastic energy of its contacts. The
/// force of such a contact at n would act on the other body for another half step, and on a moving wall, without an
/// energy that it comes from: it is taken out of what these have of step n. In T(n) = sum 1/2 m v(n-1/2) . v(n+1/2)
/// (measure/energy.c) this shows, too. So the residual of the balance is taken before and after, and the ledger has the
/// difference as energy `removed`: the balance is as closed after as it was before, and from then on holds no force of
/// what is gone. Where one that sleeps goes, all wake first (integrate/sleep.c).
///
/// Limits: between two steps only. What a law that looks ahead predicted at n is evaluated again, see
/// contact/take_out.c.
#include "measure/removal.h"

#include "contact/contact.h"
#include "contact/surfaces.h"
#include "integrate/integrate.h"
#include "measure/measure.h"
#include "search/neighbours.h"
#include "state/case_walls.h"
#include "state/periodic.h"
#include "state/plates.h"
#include "state/sleep.h"

/// Force of a contact on its first body [N].
static void force_of(const scree_contact *contact, scree_vector force)
{
    for (int k = 0; k < 3; k++)
        force[k] = contact->normal_force * contact->normal[k] + contact->tangential_force * contact->tangent[k];
}

/// A wall that the body no longer presses on.
static void relieve_wall(scree_state *state, const scree_work *work, const scree_contact *contact)
{
    scree_vector force, arm;
    force_of(contact, force);
    if (contact->second < SCREE_PRIMITIVE_ID) {
        scree_wall *wall = &scree_plates(state)[contact->second];
        wall->force -= contact->normal_force;
        for (int k = 0; k < 3; k++) wall->shear[k] += contact->tangential_force * contact->tangent[k];
        return;
    }
    const scree_surface *surface = contact_surface_of(work->wall_set, contact->second - SCREE_PRIMITIVE_ID);
    scree_surface_load *load = &scree_case_walls(state)->load[surface - work->wall_set->surface];
    for (int k = 0; k < 3; k++) arm[k] = contact->point[k] - surface->hub[k];
    scree_vector torque;
    scree_cross(arm, force, torque);
    for (int k = 0; k < 3; k++) {
        load->force[k] += force[k];
        load->torque[k] += torque[k];
    }
}

/// Walls and cell without the contacts of bodies that go.
static void relieve(scree_state *state, const scree_work *work, const scree_contact_table *table, const uint8_t *going)
{
    scree_periodic_cell *cell = scree_cell(state);
    for (size_t c = 0; c < table->count; c++) {
        const scree_contact *contact = &table->contact[c];
        if (contact->wall && going[contact->first]) relieve_wall(state, work, contact);
        if (contact->wall || !(going[contact->first] || going[contact->second])) continue;
        scree_vector force;
        force_of(contact, force);
        for (int i = 0; i < 3 && scree_periodic_is_whole(state); i++)
            for (int j = 0; j < 3; j++) cell->virial[3 * i + j] -= force[i] * contact->branch[j];
    }
}

/// Residual of the balance as things are [J]; `table` is built anew.
static scree_status measure_residual(const scree_model *model, scree_state *state, scree_work *work,
                                     scree_contact_table *table, double *residual, scree_error *error)
{
    scree_energy energy;
    scree_status status = scree_neighbours_refresh(model, state, work, error);
    if (!status) status = scree_contact_table_build(model, state, work, table, error);
    if (status) return status;
    scree_energy_measure(model, state, table, &energy);
    *residual = energy.residual;
    return SCREE_OK;
}

/// What a body that sleeps exerts on others that do, and on walls, is no part of the sums of this step, but kept with
/// them (state/sleep.h): it would hold them for ever.
static void wake_what_sleeps(const scree_model *model, scree_state *state, scree_work *work, const uint32_t *ids,
                             size_t count)
{
    const scree_context c = {.model = model, .state = state, .work = work};
    if (scree_some_sleep(state, ids, count)) scree_sleep_wake_all(&c);
}

scree_status scree_bodies_remove(const scree_model *model, scree_state *state, scree_work *work, const uint32_t *ids,
                                 size_t count, scree_error *error)
{
    scree_contact_table table = {0};
    uint8_t *going = NULL;
    double before, after;
    scree_status status = scree_state_check_removal(state, ids, count, error);
    if (!status) wake_what_sleeps(model, state, work, ids, count);
    if (!status) status = measure_residual(model, state, work, &table, &before, error);
    if (!status) status = scree_allocate(&going, state->count, sizeof *going, error);
    for (size_t k = 0; k < count && !status; k++) going[scree_state_row_of(state, ids[k])] = 1;
    if (!status) status = scree_contacts_save(state, work, error);
    if (!status) status = scree_contacts_take_out(model, state, work, going, error);
    if (!status) {
        relieve(state, work, &table, going);
        status = scree_state_remove(state, ids, count, error);
    }
    if (!status) status = measure_residual(model, state, work, &table, &after, error);
    if (!status) state->ledger.removed += before - after;
    scree_contact_table_destroy(&table);
    scree_release(&going);
    return status;
}
