/// Coordination number, with and without rattlers.
///
/// A contact of two bodies counts once for each of them, a contact with a wall or a membrane once. A rattler is a body
/// that cannot be in equilibrium with the contacts it has: fewer than two with friction (two contacts hold a disc when
/// the line between them lies in both friction cones), fewer than three without. The pressure on the boundary is one
/// more support of the bodies that carry it. A contact with a rattler bears no load, so rattlers are taken away and the
/// rest is counted again, until nothing changes. Cost: O(contacts) a pass, a few passes.
#include "measure/measure.h"

static uint32_t needed_supports(const scree_model *model)
{
    double friction = 0;
    for (int a = 0; a < model->material_count; a++)
        for (int b = 0; b < model->material_count; b++)
            if (model->pairs[a][b].friction > friction) friction = model->pairs[a][b].friction;
    return friction > 0 ? 2 : 3;
}

/// Contacts between bodies that are not rattlers, by row.
static void count_contacts(const scree_contact_table *table, const uint8_t *rattler, size_t count, uint32_t *contacts)
{
    for (size_t row = 0; row < count; row++) contacts[row] = 0;
    for (size_t c = 0; c < table->count; c++) {
        const scree_contact *contact = &table->contact[c];
        bool outer = scree_contact_is_outer(contact);
        if (rattler[contact->first] || (!outer && rattler[contact->second])) continue;
        contacts[contact->first]++;
        if (!outer) contacts[contact->second]++;
    }
}

static double mean_contacts(const uint32_t *contacts, const uint8_t *rattler, size_t count, size_t *bodies)
{
    double sum = 0;
    *bodies = 0;
    for (size_t row = 0; row < count; row++) {
        if (rattler[row]) continue;
        sum += contacts[row];
        (*bodies)++;
    }
    return *bodies > 0 ? sum / (double)*bodies : 0;
}

/// Marks the bodies with too few supports; true when there were any.
static bool mark_rattlers(const uint32_t *contacts, const uint8_t *pressed, uint32_t needed, size_t count,
                          uint8_t *rattler)
{
    bool found = false;
    for (size_t row = 0; row < count; row++) {
        if (rattler[row] || contacts[row] + pressed[row] >= needed) continue;
        rattler[row] = 1;
        found = true;
    }
    return found;
}

scree_status scree_coordination_measure(const scree_model *model, const scree_state *state,
                                        const scree_contact_table *table, scree_coordination *out, scree_error *error)
{
    uint32_t *contacts = NULL;
    uint8_t *rattler = NULL, *pressed = NULL;
    scree_status status = scree_allocate(&contacts, state->count, sizeof *contacts, error);
    if (!status) status = scree_allocate(&rattler, state->count, sizeof *rattler, error);
    if (!status) status = scree_allocate(&pressed, state->count, sizeof *pressed, error);
    if (!status) {
        const scree_loop *loop = &state->loop;
        for (size_t k = 0; k < loop->count; k++)
            if (scree_direct_pressure(state) > 0 && (loop->loaded[k] || loop->loaded[k > 0 ? k - 1 : loop->count - 1]))
                pressed[state->row_of_id[loop->id[k]]] = 1;
        size_t bodies;
        // Bodies of a membrane are no part of the assembly.
        for (size_t row = 0; row < state->count; row++) rattler[row] = !scree_body_is_grain(state, row);
        count_contacts(table, rattler, state->count, contacts);
        out->mean = mean_contacts(contacts, rattler, state->count, &bodies);
        while (mark_rattlers(contacts, pressed, needed_supports(model), state->count, rattler))
            count_contacts(table, rattler, state->count, contacts);
        out->mean_without_rattlers = mean_contacts(contacts, rattler, state->count, &bodies);
        out->rattler_fraction = state->grains > 0 ? 1 - (double)bodies / (double)state->grains : 0;
    }
    scree_release(&contacts);
    scree_release(&rattler);
    scree_release(&pressed);
    return status;
}
