/// The state checksum, by the definition in docs/architecture.md ("The state checksum"): a change here is a change
/// there, and of every number under tests/reference/. Every value goes in by itself as one 64-bit word, none as the
/// bytes of a struct, so that structs may change.
#include "state/body.h"
#include "state/case_walls.h"
#include "state/fields.h"
#include "state/periodic.h"
#include "state/plates.h"

#include "base/checksum.h"
#include "base/fixed.h"

/// Continues with the constants of a pair of materials, those that their law says.
static uint64_t checksum_pair(const scree_model *model, int one, int other, uint64_t c)
{
    const scree_law *law = scree_law_get(scree_model_law_between(model, one, other)->law);
    return scree_checksum_numbers(c, model->pairs[one][other].value, (size_t)law->constant_count);
}

/// A material by its constants, as one word; not by its index, which depends on materials that nothing is made of. With
/// it go the others that it meets under a law of the pair's own, in no order.
static uint64_t material_word(const scree_model *model, int material)
{
    uint64_t word = checksum_pair(model, material, material, scree_checksum_number(0, model->density[material]));
    uint64_t others = 0;
    bool alone = true;
    for (int m = 0; m < model->material_count && material < model->material_count; m++) {
        if (m == material || model->law_of_pairs[material][m] == 0) continue;
        others += checksum_pair(model, material, m, scree_checksum_number(0, model->density[m]));
        alone = false;
    }
    return alone ? word : scree_checksum_word(word, others);
}

/// Force and torque [N, N m] on a body.
static uint64_t checksum_forces(const scree_state *state, size_t row, uint64_t c)
{
    const scree_sum_row *sum = &state->sum[row];
    const int64_t force[] = {sum->fx, sum->fy, sum->fz};
    for (int k = 0; k < state->dimension; k++)
        c = scree_checksum_number(c, scree_fixed_to(force[k], state->force_quantum));
    if (state->dimension == 2) return scree_checksum_number(c, scree_fixed_to(sum->torque, state->torque_quantum));
    const int64_t torque[] = {state->torque[row].x, state->torque[row].y, state->torque[row].z};
    for (int k = 0; k < 3; k++) c = scree_checksum_number(c, scree_fixed_to(torque[k], state->torque_quantum));
    return c;
}

static uint64_t checksum_bodies(const scree_model *model, const scree_state *state, uint64_t c)
{
    const size_t dimension = (size_t)state->dimension, turns = dimension == 3 ? 3 : 1;
    uint64_t material[SCREE_MAX_MATERIALS];
    for (int m = 0; m < SCREE_MAX_MATERIALS; m++) material[m] = material_word(model, m);
    const bool holes = state->count < state->next_id;
    c = scree_checksum_word(c, state->count);
    if (holes) c = scree_checksum_word(c, state->next_id);
    size_t id = 0;
    for (uint32_t row; (row = scree_next_by_id(state, &id)) != SCREE_NO_ROW;) {
        scree_vector position, velocity, spin;
        if (holes) c = scree_checksum_word(c, state->id[row]);
        scree_body_position(state, row, position);
        scree_body_motion(state, row, velocity, spin);
        c = scree_checksum_numbers(c, position, dimension);
        c = scree_checksum_numbers(c, velocity, dimension);
        c = scree_checksum_numbers(c, spin + 3 - turns, turns);
        c = scree_checksum_number(c, state->row[row].radius);
        c = scree_checksum_number(c, state->row[row].mass);
        c = scree_checksum_word(c, material[scree_body_material(state, row)]);
        c = checksum_forces(state, row, c);
    }
    return c;
}

static bool is_zero(const double *numbers, size_t count)
{
    size_t zeros = 0;
    while (zeros < count && numbers[zeros] == 0) zeros++;
    return zeros == count;
}

/// What the second partner of a contact is, and its number among its like.
static uint64_t checksum_partner(uint32_t second, uint64_t c)
{
    enum { BODY, ELEMENT, PLATE };
    if (second >= SCREE_WALL_ID) return scree_checksum_word(scree_checksum_word(c, PLATE), second - SCREE_WALL_ID);
    if (second >= SCREE_PRIMITIVE_ID)
        return scree_checksum_word(scree_checksum_word(c, ELEMENT), second - SCREE_PRIMITIVE_ID);
    return scree_checksum_word(scree_checksum_word(c, BODY), second);
}

/// The contacts that remember something; they lie by pairs of ids, bodies before elements of walls before plates.
static uint64_t checksum_contacts(const scree_state *state, uint64_t c)
{
    uint64_t count = 0;
    for (size_t k = 0; k < state->contact_count; k++) {
        double value[SCREE_CHECKSUM_VALUES];
        size_t values = scree_remembered_values(state, SCREE_LIST_CONTACTS, k, value);
        if (is_zero(value, values)) continue;
        c = checksum_partner(state->contact[k].second, scree_checksum_word(c, state->contact[k].first));
        c = scree_checksum_numbers(c, value, values);
        count++;
    }
    return scree_checksum_word(c, count);
}

static uint64_t checksum_ledger(const scree_state *state, uint64_t c)
{
    const scree_ledger *ledger = &state->ledger;
    const double energies[] = {ledger->damping,  ledger->friction, ledger->stiffness, ledger->plates,
                               ledger->pressure, ledger->boundary, ledger->periodic,  ledger->forced,
                               ledger->gravity,  ledger->initial,  ledger->scheme,    ledger->turnover};
    c = scree_checksum_numbers(c, energies, sizeof energies / sizeof *energies);
    // Without work from outside, and without bodies taken out, no word: the numbers of all other runs stay.
    if (ledger->outside != 0) c = scree_checksum_number(c, ledger->outside);
    return state->count < state->next_id ? scree_checksum_number(c, ledger->removed) : c;
}

uint64_t scree_state_checksum(const scree_model *model, const scree_state *state)
{
    uint64_t c = scree_checksum_word(0, (uint64_t)state->dimension);
    c = scree_checksum_word(c, state->step);
    c = scree_checksum_number(c, state->tick);
    c = checksum_bodies(model, state, c);
    c = checksum_contacts(state, c);
    for (int m = 0; m < SCREE_MODULE_COUNT; m++)
        if (scree_modules[m]->checksum) c = scree_modules[m]->checksum(model, state, c);
    return checksum_ledger(state, c);
}
