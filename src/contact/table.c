/// The contact table, and the contact memory of checkpoints. Both are in the order of ids.
#include "base/fixed.h"
#include "contact/contact.h"
#include "contact/order.h"
#include "contact/single.h"
#include "state/cell.h"

/// The row of a body with the velocity that the scheme keeps, at n - 1/2: velocity_verlet stores v(n), half a step of
/// acceleration later (integrate/velocity_verlet.c).
static scree_row stored_row_at_half_step(const scree_model *model, const scree_state *state, size_t k)
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

/// The row of a body or an image with v(n - 1/2), with which the forces at n were evaluated; in a periodic cell with
/// the affine field, and an image where it is.
static scree_row row_at_half_step(const scree_model *model, const scree_state *state, const scree_work *work,
                                  uint32_t k)
{
    uint32_t parent = scree_parent_row(state, work, k);
    scree_row row = stored_row_at_half_step(model, state, parent);
    if (!state->cell.periodic) return row;
    scree_vector place, relative = {row.vx, row.vy, state->dimension == 3 ? row.vz : 0}, velocity;
    scree_body_place(state, k, place);
    scree_cell_full_velocity(state, place, relative, velocity);
    row.x = place[0];
    row.y = place[1];
    row.vx = velocity[0];
    row.vy = velocity[1];
    if (state->dimension == 2) return row;
    row.z = place[2];
    row.vz = velocity[2];
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

/// The first body is the image: its contact is told where the body itself is.
static void move_point(const scree_state *state, uint32_t image, scree_contact *contact)
{
    scree_vector there, here;
    scree_body_place(state, image, there);
    scree_body_place(state, contact->first, here);
    for (int k = 0; k < 3; k++) contact->point[k] += here[k] - there[k];
}

static void fill(const scree_model *model, const scree_state *state, const scree_work *work,
                 const contact_reference *reference, scree_contact *contact)
{
    size_t p = reference->pair;
    if (contact_reference_is_wall(reference)) {
        contact->first = work->wall_pairs.body[p];
        contact->second = work->wall_pairs.wall[p];
        scree_row body = row_at_half_step(model, state, work, contact->first);
        contact_of_wall(model, &body, &state->wall[contact->second], &work->wall_pairs.history[p], contact);
    } else {
        scree_row first = row_at_half_step(model, state, work, work->pairs.first[p]);
        scree_row second = row_at_half_step(model, state, work, work->pairs.second[p]);
        contact->first = scree_parent_row(state, work, work->pairs.first[p]);
        contact->second = scree_parent_row(state, work, work->pairs.second[p]);
        contact->image = work->pairs.first[p] >= state->count || work->pairs.second[p] >= state->count;
        contact_of_pair(model, &first, &second, &work->pairs.history[p], contact);
        if (work->pairs.first[p] != contact->first) move_point(state, work->pairs.first[p], contact);
    }
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
