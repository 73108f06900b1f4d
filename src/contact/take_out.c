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
    vector normal;         ///< of the contact
    double arm;            ///< m, of this body
} exerted;

/// Force and torques of pair `p` [quanta], and its kinematics.
static contact_quanta evaluate(const scree_model *model, const scree_state *state, const scree_work *work, size_t p,
                               kinematics *kinematics_of)
{
    const int dimension = state->dimension;
    contact_body first = contact_body_at_half_step(model, state, work, work->pairs.first[p]);
    contact_body second = contact_body_at_half_step(model, state, work, work->pairs.second[p]);
    bodies one = contact_body_lane(dimension, &first), other = contact_body_lane(dimension, &second);
    kinematics m = kinematics_of_pair(dimension, &one, &other, state->step_size);
    if (state->strain) kinematics_expand(dimension, &m, &one, &other, state->step_size);
    kinematics_hold(&m);
    *kinematics_of = m;
    const scree_member_row *own = contact_own_of(work, p);
    const scree_law_use *law = own ? &model->persistent.law : &model->law;
    const variant v = {.dimension = dimension, .law = law->law, .option = law->option, .many_materials = true};
    const contact_scale scale = {.inverse_force = 1 / state->force_quantum,
                                 .inverse_torque = 1 / state->torque_quantum,
                                 .force_limit = INFINITY};
    const scree_pair_constants(*pairs)[SCREE_MAX_MATERIALS] = own ? model->persistent.pairs : model->pairs;
    law_constants constants = constants_get(&pairs[(int)one.material][(int)other.material], own);
    law_settings settings = law_settings_get(law, 0);
    memory_rows rows = contact_memory_of(work, CONTACT_PAIR, p);
    law_memory before = memory_get(v, &rows), after;
    return contact_evaluate(v, &constants, &settings, &scale, &m, ~UINT64_C(0), &before, &after);
}

/// Pair `p` is a contact, and one of its bodies goes.
static bool is_cut(const scree_state *state, const scree_work *work, const uint8_t *going, size_t p)
{
    uint32_t first = work->pairs.first[p], second = work->pairs.second[p];
    const double *const strains[2] = {scree_strain_row(state, first), scree_strain_row(state, second)};
    return going[scree_parent_row(state, work, first)] != going[scree_parent_row(state, work, second)] &&
           (p < work->pairs.held_count ||
            pair_touches(state->dimension, &state->row[first], &state->row[second], strains));
}

static void take_out_moment(scree_state *state, const exerted *e)
{
    uint64_t moment[9];
    const int dimension = state->dimension;
    const contact_scale scale = {.inverse_torque = 1 / state->torque_quantum};
    int64_t *sum = state->moment + e->row * scree_moment_size(dimension);
    contact_moments(dimension, &scale, e->normal, e->arm, e->quanta.straining, moment);
    for (int k = 0; k < dimension * dimension; k++) sum[k] = (int64_t)((uint64_t)sum[k] - moment[k]);
}

static void take_out(scree_state *state, const exerted *e)
{
    if (state->moment) take_out_moment(state, e);
    const quanta force = quanta_opposite(e->quanta.force), torque = quanta_opposite(e->quanta.torque_first);
    scree_sum_row *sum = &state->sum[e->row];
    if (state->dimension == 2) {
        sum_row_add(sum, force.x, force.y, torque.x, -UINT64_C(1));
        return;
    }
    sum_row_add(sum, force.x, force.y, force.z, -UINT64_C(1));
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
        kinematics m;
        exerted e = {.row = scree_parent_row(state, work, work->pairs.first[p]),
                     .quanta = evaluate(model, state, work, p, &m)};
        e.normal = m.normal;
        e.arm = state->strain ? state->row[e.row].radius : m.arm_first;
        if (going[e.row]) {
            e.row = scree_parent_row(state, work, work->pairs.second[p]);
            e.quanta.force = quanta_opposite(e.quanta.force);
            e.quanta.torque_first = e.quanta.torque_second;
            e.arm = state->strain ? state->row[e.row].radius : m.arm_second;
        }
        list[found++] = e;
    }
    for (size_t k = 0; k < found; k++) take_out(state, &list[k]);
    scree_release(&list);
    return SCREE_OK;
}
