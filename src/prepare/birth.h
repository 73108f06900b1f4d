/// Bodies that come in mid-run: all that a new body gets, in one place.
///
/// Species and size of body `number` are drawn as a preparation draws them: pure functions of the seed and the number,
/// which is the id that it will have.
#ifndef SCREE_PREPARE_BIRTH_H
#define SCREE_PREPARE_BIRTH_H

#include "state/work.h"

/// What is known of a body before it is there.
typedef struct scree_birth {
    int species;           ///< -1: drawn
    scree_vector position; ///< m, of its centre
    scree_vector velocity; ///< m/s, at the present step
    scree_vector spin;     ///< rad/s, in 2D about z
    double angle;          ///< rad, 2D
} scree_birth;

/// Radius [m] of the smallest circle or sphere around the centre that will hold body `number`.
double scree_birth_reach(const scree_model *model, int species, uint64_t number);

/// No body will reach farther [m].
double scree_birth_largest_reach(const scree_model *model);

/// Adds one body with the next id, whose number that is, at the begin of a step that has been chosen (phase decide);
/// `row` is where it is. Its energy goes into the ledger: what it moves with is `outside`, and where it is is the zero
/// of the work that gravity will do on it. The contacts of the others must have been saved (scree_contacts_save); the
/// list is made anew at its next refresh. It must touch nothing. Errors: memory, with which the
/// run ends.
scree_status scree_birth_append(const scree_model *model, scree_state *state, const scree_work *work,
                                const scree_birth *birth, uint32_t *row, scree_error *error) SCREE_MUST_USE;

/// Time [s] at which the body in `row` was born; 0 of those that were there at the begin.
double scree_birth_time(const scree_state *state, size_t row);

#endif
