/// Breaking in the middle of a step: settle.h.
// Their names come before those of the kernels, which are short.
#include "comm/comm.h"
#include "comm/parts.h"

#include "contact/settle.h"

#include "state/periodic.h"
#include "state/persistent.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- exchange of forces ------------------------------------------------------------------------------------------

/// One body of a contact: its part of an evaluation, `sign` times.
static void add_sums(scree_state *state, uint32_t row, const contact_evaluation *e, bool is_first, bool minus)
{
    const contact_quanta *q = &e->quanta;
    quanta force = is_first == minus ? quanta_opposite(q->force) : q->force;
    quanta torque = is_first ? q->torque_first : q->torque_second;
    if (minus) torque = quanta_opposite(torque);
    const uint64_t count = minus ? -q->count : q->count;
    if (state->dimension == 2) {
        sum_row_add(&state->sum[row], force.x, force.y, torque.x, count);
        return;
    }
    sum_row_add(&state->sum[row], force.x, force.y, force.z, count);
    torque_row_add(&state->torque[row], torque.x, torque.y, torque.z);
}

static void add_moments(scree_state *state, uint32_t row, const contact_evaluation *e, contact_moment of, bool minus)
{
    const int dimension = state->dimension;
    uint64_t moment[9];
    contact_moments(dimension, of.along, of.factor, e->quanta.straining, moment);
    int64_t *sum = state->moment + row * scree_moment_size(dimension);
    for (int k = 0; k < dimension * dimension; k++)
        sum[k] = (int64_t)((uint64_t)sum[k] + (minus ? -moment[k] : moment[k]));
}

static void find_virial(const scree_state *state, const contact_evaluation *e, bool minus, double virial[9])
{
    const int dimension = state->dimension;
    const vector apart = vector_minus(dimension, e->first.position, e->second.position);
    const double branch[3] = {apart.x, apart.y, dimension == 3 ? apart.z : 0};
    const uint64_t force[3] = {e->quanta.force.x, e->quanta.force.y, dimension == 3 ? e->quanta.force.z : 0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            virial[3 * i + j] =
                (minus ? -1 : 1) * (scree_fixed_to((int64_t)force[i], state->force_quantum) * branch[j]);
}

static void add(scree_state *state, uint32_t first, uint32_t second, const contact_evaluation *e, bool minus,
                double virial[9])
{
    memset(virial, 0, 9 * sizeof *virial);
    if (!e) return;
    add_sums(state, first, e, true, minus);
    add_sums(state, second, e, false, minus);
    if (state->moment) {
        add_moments(state, first, e, e->moment_first, minus);
        add_moments(state, second, e, e->moment_second, minus);
    }
    find_virial(state, e, minus, virial);
}

void contact_exchange(scree_state *state, uint32_t first, uint32_t second, const contact_evaluation *before,
                      const contact_evaluation *after, double virial[2][9])
{
    add(state, first, second, before, true, virial[0]);
    add(state, first, second, after, false, virial[1]);
}

void contact_add_virial(scree_state *state, const double virial[2][9])
{
    if (!scree_periodic_is_whole(state)) return;
    for (int k = 0; k < 9; k++) {
        scree_cell(state)->virial[k] += virial[0][k];
        scree_cell(state)->virial[k] += virial[1][k];
    }
}

// ---- breaking ----------------------------------------------------------------------------------------------------

/// Pair `p` as the forces of this step were evaluated: rows, ghosts among them, hold the motion in the step before.
static contact_evaluation evaluate(const scree_model *model, const scree_state *state, const scree_work *work, size_t p)
{
    const contact_body first = contact_body_get(state, work->pairs.first[p]);
    const contact_body second = contact_body_get(state, work->pairs.second[p]);
    const memory_rows memory = contact_memory_of(work, CONTACT_PAIR, p);
    return contact_evaluate_again(model, state, &first, &second, &work->pairs.own[p], &memory);
}

static void describe(const scree_state *state, const scree_work *work, const contact_evaluation *e,
                     contact_settled *settled)
{
    const int dimension = state->dimension, count = tangential_count(dimension);
    const kinematics *m = &e->kinematics;
    const scree_member_row *own = &work->pairs.own[settled->pair];
    settled->normal_force = e->force.normal;
    settled->tangential_force = sqrt(vector_dot(count, e->force.tangential, e->force.tangential));
    settled->in_tension = -e->force.normal >= own->value[SCREE_MEMBER_TENSION];
    const double normal[3] = {m->normal.x, m->normal.y, dimension == 3 ? m->normal.z : 0};
    const contact_branch point = contact_branch_of(e->variant, m, true);
    const double along[3] = {point.along.x, point.along.y, dimension == 3 ? point.along.z : 0};
    for (int k = 0; k < 3; k++) {
        settled->normal[k] = normal[k];
        settled->place[k] = point.arm * along[k];
    }
}

/// What the strains of the bodies no longer get of the force [W]; zero of rigid ones.
static double straining_power(int count, const contact_evaluation *before, const contact_evaluation *after)
{
    const law_force *a = &before->force, *b = &after->force;
    const double normal = (a->normal - a->loose_normal) - (b->normal - b->loose_normal);
    const vector tangential =
        vector_minus(count, vector_minus(count, a->tangential, a->loose), vector_minus(count, b->tangential, b->loose));
    return normal * before->kinematics.expanding - vector_dot(count, tangential, before->kinematics.spreading);
}

/// From the bond to the contact that is left of it; `before`: the bond.
static void fracture(const scree_model *model, scree_state *state, scree_work *work, const contact_evaluation *before,
                     contact_settled *settled)
{
    const size_t p = settled->pair;
    const int count = tangential_count(state->dimension);
    const size_t member = scree_persistent_find(state, settled->first, settled->second);
    work->pairs.own[p].value[SCREE_MEMBER_TENSION] = SCREE_MEMBER_BROKEN;
    scree_persistent(state)->member[member].constant[SCREE_MEMBER_TENSION] = SCREE_MEMBER_BROKEN;
    const contact_evaluation after = evaluate(model, state, work, p);
    const memory_rows memory = contact_memory_of(work, CONTACT_PAIR, p);
    memory_set(after.variant, &memory, &after.memory);
    const double normal = before->force.normal - after.force.normal;
    const vector tangential = vector_minus(count, before->force.tangential, after.force.tangential);
    const double power = normal * before->kinematics.approach - vector_dot(count, tangential, before->kinematics.slip) +
                         straining_power(count, before, &after);
    settled->energy = contact_elastic_energy(before) - contact_elastic_energy(&after) - 0.5 * power * state->step_size;
    contact_exchange(state, scree_parent_row(state, work, work->pairs.first[p]),
                     scree_parent_row(state, work, work->pairs.second[p]), before, &after, settled->virial);
}

static int compare(const void *a, const void *b)
{
    const contact_settled *p = a, *q = b;
    if (p->first != q->first) return p->first < q->first ? -1 : 1;
    return p->second < q->second ? -1 : p->second > q->second;
}

static void sort(contact_settled *settled, size_t count)
{
    if (count > 0) qsort(settled, count, sizeof *settled, compare);
}

/// What breaks or has parted in this process.
static scree_status find(const scree_model *model, const scree_state *state, const scree_work *work,
                         contact_settled **settled, size_t *count, scree_error *error)
{
    const scree_pair_list *pairs = &work->pairs;
    size_t most = 0;
    *count = 0;
    for (size_t p = 0; p < scree_pairs_held(pairs); p++) most += evaluate(model, state, work, p).force.settle != 0;
    scree_status status = scree_allocate(settled, most, sizeof **settled, error);
    for (size_t p = 0; p < scree_pairs_held(pairs) && *count < most && !status; p++)
        if (evaluate(model, state, work, p).force.settle)
            (*settled)[(*count)++] = (contact_settled){.pair = p,
                                                       .first = state->id[pairs->first[p]],
                                                       .second = state->id[pairs->second[p]],
                                                       .parted = pairs->own[p].value[SCREE_MEMBER_TENSION] < 0};
    if (!status) sort(*settled, *count);
    return status;
}

/// Places of the contacts, from where their first bodies are; a ghost of one may be elsewhere.
static scree_status place(const scree_state *state, contact_settled *settled, size_t count, scree_error *error)
{
    scree_vector *body = NULL;
    uint32_t *id = NULL;
    scree_status status = scree_allocate(&body, count, sizeof *body, error);
    if (!status) status = scree_allocate(&id, count, sizeof *id, error);
    for (size_t k = 0; k < count && !status; k++) {
        const uint32_t row = scree_state_row_of(state, id[k] = settled[k].first);
        if (row != SCREE_NO_ROW) scree_body_position(state, row, body[k]);
    }
    if (!status) scree_parts_tell(state, id, count, (double *)body, 3);
    for (size_t k = 0; k < count && !status; k++)
        if (!settled[k].parted) scree_subtract(body[k], settled[k].place, settled[k].place);
    scree_release(&body);
    scree_release(&id);
    return status;
}

scree_status contact_settle(const scree_model *model, scree_state *state, scree_work *work, contact_settled **settled,
                            size_t *count, scree_error *error)
{
    *settled = NULL;
    scree_status status = find(model, state, work, settled, count, error);
    if (status) return status;
    for (size_t k = 0; k < *count; k++) {
        if ((*settled)[k].parted) continue;
        const contact_evaluation before = evaluate(model, state, work, (*settled)[k].pair);
        describe(state, work, &before, &(*settled)[k]);
        fracture(model, state, work, &before, &(*settled)[k]);
    }
    // What bodies of other processes get lies with their ghosts.
    if (state->part) scree_comm_add_back(state, work);
    if ((status = scree_parts_collect(state, settled, count, sizeof **settled, error))) return status;
    sort(*settled, *count);
    for (size_t k = 0; k < *count; k++)
        if (!(*settled)[k].parted) contact_add_virial(state, (const double(*)[9])(*settled)[k].virial);
    return *count > 0 ? place(state, *settled, *count, error) : SCREE_OK;
}
