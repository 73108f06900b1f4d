/// Who evaluates a contact knows both of its bodies, one of them as a ghost, and writes to the process of the ghost.
/// Cost: 32 bytes a contact across the border of two parts, then a byte for each flag.
#include "measure/contacts_elsewhere.h"

/// The ends of a contact that are ghosts of other processes; of one from outside of the assembly the first alone.
static bool is_away(const scree_state *state, const scree_contact *contact, int end)
{
    if (end == 1 && scree_contact_is_outer(contact)) return false;
    return (end == 0 ? contact->first : contact->second) >= state->count;
}

static size_t count_away(const scree_state *state, const scree_contact_table *table)
{
    size_t count = 0;
    for (size_t c = 0; c < table->count; c++)
        for (int end = 0; end < 2; end++) count += is_away(state, &table->contact[c], end);
    return count;
}

/// What is written of the contacts with ghosts, about which rows.
static void write_notes(const scree_state *state, const scree_contact_table *table, uint32_t *about, uint32_t *other,
                        scree_contact_elsewhere *note)
{
    size_t k = 0;
    for (size_t c = 0; c < table->count; c++) {
        const scree_contact *contact = &table->contact[c];
        for (int end = 0; end < 2; end++) {
            if (!is_away(state, contact, end)) continue;
            about[k] = end == 0 ? contact->first : contact->second;
            other[k] = scree_contact_is_outer(contact) ? UINT32_MAX : end == 0 ? contact->second : contact->first;
            note[k].id = end == 0 ? scree_contact_second_id(state, contact) : state->id[contact->first];
            for (int i = 0; i < 3; i++) note[k].normal[i] = (end == 0 ? 1 : -1) * contact->normal[i];
            k++;
        }
    }
}

scree_status scree_contacts_elsewhere_open(const scree_state *state, const scree_work *work,
                                           const scree_contact_table *table, scree_contacts_elsewhere *elsewhere,
                                           scree_error *error)
{
    *elsewhere = (scree_contacts_elsewhere){.rows = state->count, .flags = state->count};
    if (!state->part) return SCREE_OK;
    const size_t count = count_away(state, table);
    uint32_t *about = NULL;
    scree_contact_elsewhere *note = NULL;
    scree_status status = scree_allocate(&about, count + 1, sizeof *about, error);
    if (!status) status = scree_allocate(&elsewhere->other, count + 1, sizeof *elsewhere->other, error);
    if (!status) status = scree_allocate(&note, count + 1, sizeof *note, error);
    if (!status) write_notes(state, table, about, elsewhere->other, note);
    if (!status) status = scree_ghost_notes_open(state, work, about, count, &elsewhere->notes, error);
    const size_t arriving = elsewhere->notes.arriving;
    if (!status) status = scree_allocate(&elsewhere->contact, arriving + 1, sizeof *elsewhere->contact, error);
    if (!status) status = scree_ghost_notes_send(&elsewhere->notes, note, elsewhere->contact, sizeof *note, error);
    elsewhere->rows = scree_row_count(state, work);
    elsewhere->flags = elsewhere->rows + arriving;
    scree_release(&about);
    scree_release(&note);
    return status;
}

scree_status scree_contacts_elsewhere_tell(const scree_state *state, const scree_work *work,
                                           const scree_contacts_elsewhere *elsewhere, uint8_t *flag, scree_error *error)
{
    if (!state->part) return SCREE_OK;
    const size_t shown = scree_ghost_rows_shown(work), leaving = elsewhere->notes.leaving;
    uint8_t *out;
    scree_status status = scree_allocate(&out, (shown > leaving ? shown : leaving) + 1, sizeof *out, error);
    if (status) return status;
    for (size_t k = 0; k < shown; k++) out[k] = flag[scree_ghost_rows_body(work, k)];
    scree_ghost_rows_tell(state, work, out, flag + scree_ghost_rows_first(state, work), sizeof *out);
    for (size_t k = 0; k < leaving; k++) out[k] = elsewhere->other[k] == UINT32_MAX ? 0 : flag[elsewhere->other[k]];
    status = scree_ghost_notes_send(&elsewhere->notes, out, flag + elsewhere->rows, sizeof *out, error);
    scree_release(&out);
    return status;
}

void scree_contacts_elsewhere_close(scree_contacts_elsewhere *elsewhere)
{
    scree_ghost_notes_close(&elsewhere->notes);
    scree_release(&elsewhere->contact);
    scree_release(&elsewhere->other);
}
