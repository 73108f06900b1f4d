/// The contact table, and the contact memory of checkpoints. Both are in the order of ids.
#include "base/fixed.h"
#include "contact/contact.h"
#include "contact/order.h"
#include "contact/single.h"

/// The row of a body with v(n - 1/2), with which the forces at n were evaluated: velocity_verlet stores v(n), half a
/// step of acceleration later (integrate/velocity_verlet.c).
static scree_row row_at_half_step(const scree_model *model, const scree_state *state, size_t k)
{
    scree_row row = state->row[k];
    if (model->scheme != SCREE_SCHEME_VELOCITY_VERLET) return row;
    const scree_sum_row *sum = &state->sum[k];
    double half = 0.5 * state->step_size;
    double inertia = 0.5 * row.mass * row.radius * row.radius;
    row.vx -= half * (scree_fixed_to(sum->fx, state->force_quantum) / row.mass + model->gravity[0]);
    row.vy -= half * (scree_fixed_to(sum->fy, state->force_quantum) / row.mass + model->gravity[1]);
    row.spin -= half * scree_fixed_to(sum->torque, state->torque_quantum) / inertia;
    return row;
}

static scree_status reserve(scree_contact_table *table, size_t count, scree_error *error)
{
    if (count <= table->capacity) return SCREE_OK;
    size_t capacity = count + count / 4;
    scree_status status = scree_reallocate(&table->contact, table->count, capacity, sizeof *table->contact, error);
    if (!status) table->capacity = capacity;
    return status;
}

/// The contact of `reference`, which touches.
static void fill(const scree_model *model, const scree_state *state, const scree_work *work,
                 const contact_reference *reference, scree_contact *contact)
{
    size_t p = reference->pair;
    if (contact_reference_is_wall(reference)) {
        contact->first = work->wall_pairs.body[p];
        contact->second = work->wall_pairs.wall[p];
        scree_row body = row_at_half_step(model, state, contact->first);
        contact_of_wall(model, &body, &state->wall[contact->second], &work->wall_pairs.history[p], contact);
    } else {
        contact->first = work->pairs.first[p];
        contact->second = work->pairs.second[p];
        scree_row first = row_at_half_step(model, state, contact->first);
        scree_row second = row_at_half_step(model, state, contact->second);
        contact_of_pair(model, &first, &second, &work->pairs.history[p], contact);
    }
    contact->membrane =
        !scree_body_is_grain(state, contact->first) || (!contact->wall && !scree_body_is_grain(state, contact->second));
}

scree_status scree_contact_table_build(const scree_model *model, const scree_state *state, const scree_work *work,
                                       scree_contact_table *table, scree_error *error)
{
    contact_reference *order;
    size_t count;
    scree_status status = contact_order(state, work, &order, &count, error);
    if (!status) status = reserve(table, count, error);
    table->count = status ? 0 : count;
    for (size_t k = 0; k < table->count; k++) fill(model, state, work, &order[k], &table->contact[k]);
    scree_release(&order);
    return status;
}

void scree_contact_table_destroy(scree_contact_table *table)
{
    scree_release(&table->contact);
    table->count = table->capacity = 0;
}

scree_status scree_contacts_save(scree_state *state, const scree_work *work, scree_error *error)
{
    contact_reference *order;
    size_t count;
    scree_status status = contact_order(state, work, &order, &count, error);
    if (!status) status = scree_state_reserve_contacts(state, count, error);
    if (!status) {
        state->contact_count = count;
        for (size_t k = 0; k < count; k++) {
            const contact_reference *r = &order[k];
            const scree_history *history =
                contact_reference_is_wall(r) ? work->wall_pairs.history : work->pairs.history;
            state->contact[k] = (scree_contact_memory){r->first, r->second, history[r->pair]};
        }
    }
    scree_release(&order);
    return status;
}
