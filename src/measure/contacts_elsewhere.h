/// Contacts of bodies of a part that other processes evaluate. A contact of bodies of two processes is in the table of
/// one of them; the other is told what a measure of single bodies needs of it. All processes call each function, as
/// often; of a whole state there are none.
#ifndef SCREE_MEASURE_CONTACTS_ELSEWHERE_H
#define SCREE_MEASURE_CONTACTS_ELSEWHERE_H

#include "comm/ghost_rows.h"
#include "contact/contact.h"

typedef struct scree_contact_elsewhere {
    scree_vector normal; ///< towards the body that is here
    uint32_t id;         ///< of the other one
} scree_contact_elsewhere;

typedef struct scree_contacts_elsewhere {
    scree_ghost_notes notes; ///< `arriving` contacts, of the bodies in notes.row
    scree_contact_elsewhere *contact;
    uint32_t *other;    ///< of those that this process evaluates for others: row of the body that is not theirs;
                        ///< UINT32_MAX: a wall or of a membrane, whose flag is 0
    size_t rows, flags; ///< of bodies and ghosts; the elements of an array of flags
} scree_contacts_elsewhere;

/// Errors: memory.
scree_status scree_contacts_elsewhere_open(const scree_state *state, const scree_work *work,
                                           const scree_contact_table *table, scree_contacts_elsewhere *elsewhere,
                                           scree_error *error) SCREE_MUST_USE;

/// flag: one a row, known of the bodies here. Fills in those of the ghosts of other processes, and behind all rows
/// those of the other bodies of the contacts elsewhere: flag[rows + k] of contact k. Errors: memory.
scree_status scree_contacts_elsewhere_tell(const scree_state *state, const scree_work *work,
                                           const scree_contacts_elsewhere *elsewhere, uint8_t *flag,
                                           scree_error *error) SCREE_MUST_USE;

void scree_contacts_elsewhere_close(scree_contacts_elsewhere *elsewhere);

#endif
