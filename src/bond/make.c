/// From candidates to members of the persistent list, with the forces at n that belong to them.
///
/// All forces are found before any is changed, since velocities at n - 1/2 may follow from the sums
/// (contact/take_out.c). What the balance of energies loses is measured, before and after, as for bodies that are taken
/// out (measure/removal.c): it is the energy of the contacts that were there and the part of the kinetic energy of the
/// ledger that goes with their forces. Before the first step there are no forces, and the ledger is opened afterwards.
#include "bond/make.h"

#include "bond/bond.h"
#include "contact/settle.h"
#include "measure/measure.h"
#include "search/neighbours.h"
#include "state/persistent.h"

#include <math.h>
#include <stdlib.h>

/// What a pair exerts before it is bonded, by the number of the candidate.
typedef struct swap {
    contact_evaluation before;
    bool touches;
} swap;

static int compare(const void *key, const void *element)
{
    const scree_bond_candidate *p = key, *q = element;
    if (p->first != q->first) return p->first < q->first ? -1 : 1;
    return p->second < q->second ? -1 : p->second > q->second;
}

/// The candidate that two rows are; NULL: none.
static scree_bond_candidate *candidate_of(const scree_bond_candidates *all, const scree_state *state, uint32_t a,
                                          uint32_t b)
{
    const scree_bond_candidate key = {state->id[a], state->id[b], 0};
    return bsearch(&key, all->pair, all->count, sizeof key, compare);
}

static contact_evaluation evaluate(const scree_model *model, const scree_state *state, const scree_work *work, size_t p)
{
    const contact_body first = contact_body_at_half_step(model, state, work, work->pairs.first[p]);
    const contact_body second = contact_body_at_half_step(model, state, work, work->pairs.second[p]);
    const memory_rows memory = contact_memory_of(work, CONTACT_PAIR, p);
    return contact_evaluate_again(model, state, &first, &second, contact_own_of(work, p), &memory);
}

static void find_forces(const scree_model *model, const scree_state *state, const scree_work *work,
                        const scree_bond_candidates *all, swap *of)
{
    const scree_pair_list *pairs = &work->pairs;
    for (size_t p = scree_pairs_held(pairs); p < pairs->count; p++) {
        const uint32_t a = pairs->first[p], b = pairs->second[p];
        const scree_bond_candidate *candidate = candidate_of(all, state, a, b);
        if (!candidate || !contact_pair_is_there(state, work, p)) continue;
        of[candidate - all->pair] = (swap){evaluate(model, state, work, p), true};
    }
}

/// The forces of the contacts go, those of the bonds come, with what the bonds remember of them.
static void swap_forces(const scree_model *model, scree_state *state, scree_work *work,
                        const scree_bond_candidates *all, const swap *of, contact_evaluation *after)
{
    const scree_pair_list *pairs = &work->pairs;
    for (size_t p = 0; p < scree_pairs_held(pairs); p++)
        if (candidate_of(all, state, pairs->first[p], pairs->second[p])) after[p] = evaluate(model, state, work, p);
    for (size_t p = 0; p < scree_pairs_held(pairs); p++) {
        const scree_bond_candidate *candidate = candidate_of(all, state, pairs->first[p], pairs->second[p]);
        if (!candidate) continue;
        const swap *s = &of[candidate - all->pair];
        const memory_rows memory = contact_memory_of(work, CONTACT_PAIR, p);
        memory_set(after[p].variant, &memory, &after[p].memory);
        double virial[2][9];
        contact_exchange(state, scree_parent_row(state, work, pairs->first[p]),
                         scree_parent_row(state, work, pairs->second[p]), s->touches ? &s->before : NULL, &after[p],
                         virial);
        contact_add_virial(state, (const double(*)[9])virial);
    }
}

/// By which the strains of both bodies have moved their surfaces towards each other [m].
static double expansion_of(const scree_state *state, const scree_persistent_member *member)
{
    const uint32_t a = scree_state_row_of(state, member->first), b = scree_state_row_of(state, member->second);
    scree_vector n;
    if (!state->stretch) return 0;
    scree_persistent_branch(state, member, n);
    scree_normalise(n);
    const vector normal = {n[0], n[1], n[2]};
    const stretch both = stretch_get(state->dimension, scree_stretch_row(state, a), scree_stretch_row(state, b));
    return vector_dot(state->dimension, normal, stretch_along(state->dimension, both.now, normal));
}

static scree_status add_members(const scree_model *model, scree_state *state, const scree_bond_order *order,
                                const scree_bond_candidates *all, scree_error *error)
{
    scree_persistent_member *member;
    scree_status status = scree_allocate(&member, all->count, sizeof *member, error);
    if (status) return status;
    for (size_t k = 0; k < all->count; k++) {
        const scree_bond_candidate *pair = &all->pair[k];
        const double area = scree_bond_area(model, state->row[scree_state_row_of(state, pair->first)].radius,
                                            state->row[scree_state_row_of(state, pair->second)].radius);
        member[k] = (scree_persistent_member){.first = pair->first, .second = pair->second};
        member[k].constant[SCREE_MEMBER_REST] =
            order->rest == SCREE_REST_AS_MADE ? expansion_of(state, &member[k]) - pair->gap : 0;
        scree_bond_strengths(&order->strength, pair->first, pair->second, area, member[k].constant);
    }
    status = scree_persistent_merge(state, member, all->count, error);
    scree_release(&member);
    return status;
}

static scree_status measure(const scree_model *model, const scree_state *state, const scree_work *work,
                            double *residual, scree_error *error)
{
    scree_contact_table table = {0};
    scree_energy energy;
    scree_status status = scree_contact_table_build(model, state, work, &table, error);
    if (status) return status;
    scree_energy_measure(model, state, &table, &energy);
    *residual = energy.residual;
    scree_contact_table_destroy(&table);
    return SCREE_OK;
}

/// Where forces have been evaluated.
static scree_status replace(const scree_model *model, scree_state *state, scree_work *work,
                            const scree_bond_order *order, const scree_bond_candidates *all, scree_error *error)
{
    scree_bonds *bonds = scree_bonds_of(state);
    const size_t held = scree_persistent(state)->count + all->count;
    contact_evaluation *after = NULL;
    swap *of = NULL;
    double before, left;
    scree_status status = scree_neighbours_refresh(model, state, work, error);
    if (!status) status = measure(model, state, work, &before, error);
    if (!status) status = scree_allocate(&of, all->count, sizeof *of, error);
    if (!status) status = scree_allocate(&after, held, sizeof *after, error);
    if (!status) find_forces(model, state, work, all, of);
    if (!status) status = add_members(model, state, order, all, error);
    if (!status) status = scree_neighbours_refresh(model, state, work, error);
    if (!status) {
        swap_forces(model, state, work, all, of, after);
        status = measure(model, state, work, &left, error);
    }
    if (!status) {
        bonds->bonding += before - left;
        state->ledger.turnover += fabs(before - left);
    }
    scree_release(&of);
    scree_release(&after);
    return status;
}

scree_status scree_bonds_make(const scree_model *model, scree_state *state, scree_work *work,
                              const scree_bond_order *order, size_t *made, scree_error *error)
{
    scree_bond_candidates all;
    scree_status status = scree_bond_candidates_find(model, state, work, order, &all, error);
    if (!status && state->evaluations > 0) {
        status = replace(model, state, work, order, &all, error);
    } else if (!status) {
        status = add_members(model, state, order, &all, error);
        if (!status) status = scree_neighbours_refresh(model, state, work, error);
    }
    *made = status ? 0 : all.count;
    scree_bonds_of(state)->made += *made;
    scree_release(&all.pair);
    return status;
}
