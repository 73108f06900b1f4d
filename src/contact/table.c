/// The contact table, and the contact memory of checkpoints. Both are in the order of ids.
///
/// Of a part the table has the contacts that this process evaluates, each contact of the sample in one process. Rows of
/// ghosts of other processes hold the velocities with which the last forces were found, in a cell that deforms with the
/// motion of the lattice in them: those of the middle of the step are told by their processes, with the places of the
/// bodies themselves, 72 bytes a ghost.
#include "base/fixed.h"
#include "comm/ghost_rows.h"
#include "comm/parts.h"
#include "contact/contact.h"
#include "contact/order.h"
#include "contact/single.h"
#include "module/integrator.h"
#include "search/held.h"
#include "state/periodic.h"
#include "state/plates.h"
#include "state/sleep.h"

#include <string.h>

/// A body with its velocity at n - 1/2; a scheme may keep v(n), half a step of acceleration later.
static contact_body stored_body_at_half_step(const scree_model *model, const scree_state *state, size_t k)
{
    contact_body body = contact_body_get(state, k);
    if (scree_integrator_get(model->scheme)->velocity_lead == 0 || scree_body_sleeps(state, k)) return body;
    scree_row *row = &body.row;
    const scree_sum_row *sum = &state->sum[k];
    double half = 0.5 * state->step_size, inertia = scree_body_inertia(state, k);
    row->vx -= half * (scree_fixed_to(sum->fx, state->force_quantum) / row->mass + model->gravity[0]);
    row->vy -= half * (scree_fixed_to(sum->fy, state->force_quantum) / row->mass + model->gravity[1]);
    if (state->dimension == 2) {
        row->spin -= half * scree_fixed_to(sum->torque, state->torque_quantum) / inertia;
        return body;
    }
    const scree_torque_row *torque = &state->torque[k];
    row->vz -= half * (scree_fixed_to(sum->fz, state->force_quantum) / row->mass + model->gravity[2]);
    body.turn.wx -= half * scree_fixed_to(torque->x, state->torque_quantum) / inertia;
    body.turn.wy -= half * scree_fixed_to(torque->y, state->torque_quantum) / inertia;
    body.turn.wz -= half * scree_fixed_to(torque->z, state->torque_quantum) / inertia;
    return body;
}

/// What is told of a body: velocity and spin, six numbers at most, then its place.
enum { PLACE = 6 };
_Static_assert(sizeof *((scree_parts *)0)->half == (PLACE + 3) * sizeof(double), "so many numbers");

/// Velocity and spin of a body as six numbers, and back.
static void get_motion(const scree_state *state, const contact_body *body, double motion[PLACE])
{
    const bool in_3d = state->dimension == 3;
    const double all[6] = {body->row.vx, body->row.vy, body->row.vz, body->turn.wx, body->turn.wy, body->turn.wz};
    memcpy(motion, all, (in_3d ? 6 : 3) * sizeof *all);
}

static void set_motion(const scree_state *state, contact_body *body, const double motion[PLACE])
{
    body->row.vx = motion[0];
    body->row.vy = motion[1];
    body->row.vz = motion[2]; // in 2D this is the spin
    if (state->dimension == 2) return;
    body->turn.wx = motion[3];
    body->turn.wy = motion[4];
    body->turn.wz = motion[5];
}

/// Processes tell each other the motion of bodies that others have ghosts of.
static scree_status tell_motion(const scree_model *model, const scree_state *state, const scree_work *work,
                                scree_error *error)
{
    double(*shown)[PLACE + 3];
    const size_t count = scree_ghost_rows_shown(work);
    scree_status status = scree_allocate(&shown, count + 1, sizeof *shown, error);
    if (!status) status = scree_allocate(&work->parts->half, work->ghosts.away + 1, sizeof *work->parts->half, error);
    for (size_t k = 0; k < count && !status; k++) {
        const uint32_t row = scree_ghost_rows_body(work, k);
        const contact_body body = stored_body_at_half_step(model, state, row);
        get_motion(state, &body, shown[k]);
        scree_body_position(state, row, shown[k] + PLACE);
    }
    if (!status) scree_ghost_rows_tell(state, work, shown, work->parts->half, sizeof *shown);
    scree_release(&shown);
    return status;
}

/// The body in a row, or that of the ghost in it: a ghost of another process with the motion that this has told.
static contact_body body_of_row(const scree_model *model, const scree_state *state, const scree_work *work, uint32_t k)
{
    const uint32_t parent = scree_parent_row(state, work, k);
    if (parent < state->count || !work->parts->half) return stored_body_at_half_step(model, state, parent);
    contact_body body = contact_body_get(state, parent);
    set_motion(state, &body, work->parts->half[parent - scree_ghost_rows_first(state, work)]);
    return body;
}

contact_body contact_body_at_half_step(const scree_model *model, const scree_state *state, const scree_work *work,
                                       uint32_t k)
{
    contact_body body = body_of_row(model, state, work, k);
    if (!scree_cell(state)->directions) return body;
    scree_row *row = &body.row;
    bool in_3d = state->dimension == 3;
    scree_vector position, relative = {row->vx, row->vy, in_3d ? row->vz : 0}, velocity;
    scree_body_position(state, k, position);
    scree_periodic_full_velocity(state, position, relative, velocity);
    row->x = position[0];
    row->y = position[1];
    row->vx = velocity[0];
    row->vy = velocity[1];
    if (!in_3d) return body;
    row->z = position[2];
    row->vz = velocity[2];
    return body;
}

static scree_status reserve(scree_contact_table *table, size_t count, scree_error *error)
{
    if (count <= table->capacity) return SCREE_OK;
    size_t capacity = count + count / 4;
    scree_status status = scree_reallocate(&table->contact, table->count, capacity, sizeof *table->contact, error);
    if (!status) table->capacity = capacity;
    return status;
}

/// Whether a row is of an image across a face of the cell, of a body that is here or of one of another process.
static bool is_image(const scree_state *state, const scree_work *work, uint32_t row)
{
    if (row < state->count) return false;
    const int32_t *shift = work->ghosts.ghost[row - state->count].shift;
    return shift[0] != 0 || shift[1] != 0 || shift[2] != 0;
}

/// The first body is the image: its contact is told where the body itself is.
static void move_point(const scree_state *state, const scree_work *work, uint32_t ghost, scree_contact *contact)
{
    scree_vector there, here;
    const size_t first = scree_ghost_rows_first(state, work);
    scree_body_position(state, ghost, there);
    if (contact->first < state->count)
        scree_body_position(state, contact->first, here);
    else
        memcpy(here, work->parts->half[contact->first - first] + PLACE, sizeof here);
    for (int k = 0; k < 3; k++) contact->point[k] += here[k] - there[k];
}

/// The contact of `reference`; false when it is none: a pair that is held, broken and apart.
static bool fill(const scree_model *model, const scree_state *state, const scree_work *work,
                 const contact_reference *reference, scree_contact *contact)
{
    size_t p = reference->pair;
    contact_list list = contact_reference_list(reference);
    const scree_wall_pair_list *walls = list == CONTACT_PLATE ? &work->wall_pairs : &work->primitive_pairs;
    memory_rows memory = contact_memory_of(work, list, p);
    uint32_t one = list == CONTACT_PAIR ? work->pairs.first[p] : walls->body[p];
    uint32_t other = list == CONTACT_PAIR ? work->pairs.second[p] : walls->wall[p];
    contact->first = scree_parent_row(state, work, one);
    contact->second = list == CONTACT_PAIR ? scree_parent_row(state, work, other) : other;
    contact->ghost = is_image(state, work, one) || (list == CONTACT_PAIR && is_image(state, work, other));
    contact->membrane = !scree_body_is_grain(state, contact->first);
    contact_body first = contact_body_at_half_step(model, state, work, one);
    if (list == CONTACT_PLATE) {
        contact_of_wall(model, state, &first, &scree_plates(state)[other], &memory, contact);
        return true;
    }
    if (list == CONTACT_ELEMENT) {
        contact_of_primitive(model, state, work, &first, other, &memory, contact);
        contact->second += SCREE_PRIMITIVE_ID;
        return true;
    }
    contact_body second = contact_body_at_half_step(model, state, work, other);
    const scree_member_row *own = contact_own_of(work, p);
    const bool in_contact = contact_of_pair(model, state, &first, &second, own, &memory, contact);
    if (is_image(state, work, one)) move_point(state, work, one, contact);
    contact->membrane = contact->membrane || !scree_body_is_grain(state, contact->second);
    return in_contact || !own;
}

scree_status scree_contact_table_build(const scree_model *model, const scree_state *state, const scree_work *work,
                                       scree_contact_table *table, scree_error *error)
{
    contact_reference *order;
    size_t count;
    scree_status status = contact_order(state, work, &order, &count, error);
    if (!status) status = reserve(table, count, error);
    if (!status && state->part) status = tell_motion(model, state, work, error);
    table->count = 0;
    for (size_t k = 0; k < count && !status; k++)
        table->count += fill(model, state, work, &order[k], &table->contact[table->count]);
    if (state->part) scree_release(&work->parts->half);
    scree_release(&order);
    return status;
}

void scree_contact_table_destroy(scree_contact_table *table)
{
    scree_release(&table->contact);
    table->count = table->capacity = 0;
}

/// Whether its law remembers an energy, and where.
static int energy_at(const scree_model *model, const scree_work *work, const contact_reference *r)
{
    const contact_list list = contact_reference_list(r);
    if (list == CONTACT_PAIR && r->pair < scree_pairs_held(&work->pairs)) return 0;
    return scree_law_use_traits(&model->laws[contact_law_number(work, list, r->pair)])->energy_at;
}

scree_status scree_contacts_were_placed(const scree_model *model, const scree_state *state, scree_work *work,
                                        scree_error *error)
{
    contact_reference *order;
    size_t count;
    scree_status status = contact_order(state, work, &order, &count, error);
    for (size_t k = 0; k < count && !status; k++) {
        const int at = energy_at(model, work, &order[k]);
        scree_contact contact;
        if (at == 0 || !fill(model, state, work, &order[k], &contact)) continue;
        contact_memory_of(work, contact_reference_list(&order[k]), order[k].pair).history->value[at] =
            contact.elastic_normal;
    }
    scree_release(&order);
    return status;
}

scree_status scree_contacts_save(scree_state *state, const scree_work *work, scree_error *error)
{
    contact_reference *order;
    size_t count;
    scree_status status = contact_order(state, work, &order, &count, error);
    if (!status) status = scree_state_reserve_contacts(state, count, error);
    if (!status && work->pairs.last_force) status = scree_state_add_last_force(state, error);
    if (!status && work->pairs.rolling) status = scree_state_add_rolling(state, error);
    if (!status && state->pair_laws > 0) status = scree_state_add_contact_law(state, error);
    size_t saved = 0;
    for (size_t k = 0; k < count && !status; k++) {
        const contact_reference *r = &order[k];
        contact_list list = contact_reference_list(r);
        if (list == CONTACT_PAIR && r->pair < scree_pairs_held(&work->pairs)) continue;
        memory_rows memory = contact_memory_of(work, list, r->pair);
        state->contact[saved] = (scree_contact_memory){r->first, r->second, *memory.history};
        if (memory.last_force) state->last_force[saved] = *memory.last_force;
        if (memory.rolling) state->rolling[saved] = *memory.rolling;
        if (state->contact_law) state->contact_law[saved] = (uint8_t)contact_law_number(work, list, r->pair);
        saved++;
    }
    state->contact_count = saved;
    if (!status) scree_held_collect(state, work);
    scree_release(&order);
    return status;
}
