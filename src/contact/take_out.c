/// Forces of bodies that go, out of the sums of those that stay. The force of a contact at n is evaluated again from
/// the memory that it left, as for the contact table (contact/single.h): a spring gives the same force, to round-off;
/// the part that a law which looks ahead has from its prediction may differ by the change of it in a step. With
/// velocity_verlet v(n - 1/2) follows from v(n) and the sums, so all forces are found before any is taken out.
#include "contact/advance.h"
#include "contact/contact.h"
#include "contact/single.h"
#include "state/plates.h"

/// What a contact does to the body in `row`.
typedef struct exerted {
    uint32_t row;
    contact_quanta quanta; ///< force and torque_first are those on this body
    contact_moment moment; ///< of this body
} exerted;

/// Pair `p` at n.
static contact_evaluation evaluate(const scree_model *model, const scree_state *state, const scree_work *work, size_t p)
{
    const contact_body first = contact_body_at_half_step(model, state, work, work->pairs.first[p]);
    const contact_body second = contact_body_at_half_step(model, state, work, work->pairs.second[p]);
    const memory_rows rows = contact_memory_of(work, CONTACT_PAIR, p);
    return contact_evaluate_again(model, state, &first, &second, contact_own_of(work, p), &rows);
}

/// Pair `p` is a contact, and one of its bodies goes.
static bool is_cut(const scree_state *state, const scree_work *work, const uint8_t *going, size_t p)
{
    uint32_t first = work->pairs.first[p], second = work->pairs.second[p];
    return going[scree_parent_row(state, work, first)] != going[scree_parent_row(state, work, second)] &&
           contact_pair_is_there(state, work, p);
}

static void take_out_moment(scree_state *state, const exerted *e)
{
    uint64_t moment[9];
    const int dimension = state->dimension;
    int64_t *sum = state->moment + e->row * scree_moment_size(dimension);
    contact_moments(dimension, e->moment.along, e->moment.factor, e->quanta.straining, moment);
    for (int k = 0; k < dimension * dimension; k++) sum[k] = (int64_t)((uint64_t)sum[k] - moment[k]);
}

static void take_out(scree_state *state, const exerted *e)
{
    if (state->moment) take_out_moment(state, e);
    const quanta force = quanta_opposite(e->quanta.force), torque = quanta_opposite(e->quanta.torque_first);
    scree_sum_row *sum = &state->sum[e->row];
    if (state->dimension == 2) {
        sum_row_add(sum, force.x, force.y, torque.x, -e->quanta.count);
        return;
    }
    sum_row_add(sum, force.x, force.y, force.z, -e->quanta.count);
    torque_row_add(&state->torque[e->row], torque.x, torque.y, torque.z);
}

scree_status scree_contacts_take_out(const scree_model *model, scree_state *state, const scree_work *work,
                                     const uint8_t *going, scree_error *error)
{
    size_t cut = 0, found = 0;
    exerted *list = NULL;
    for (size_t p = 0; p < work->pairs.count; p++) cut += is_cut(state, work, going, p);
    scree_status status = scree_allocate(&list, cut, sizeof *list, error);
    if (status) return status;
    for (size_t p = 0; p < work->pairs.count; p++) {
        if (!is_cut(state, work, going, p)) continue;
        const contact_evaluation of = evaluate(model, state, work, p);
        exerted e = {
            .row = scree_parent_row(state, work, work->pairs.first[p]), .quanta = of.quanta, .moment = of.moment_first};
        if (going[e.row]) {
            e.row = scree_parent_row(state, work, work->pairs.second[p]);
            e.quanta.force = quanta_opposite(e.quanta.force);
            e.quanta.torque_first = e.quanta.torque_second;
            e.moment = of.moment_second;
        }
        list[found++] = e;
    }
    for (size_t k = 0; k < found; k++) take_out(state, &list[k]);
    scree_release(&list);
    return SCREE_OK;
}
