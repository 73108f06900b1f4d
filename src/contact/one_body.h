/// One body out of the state, as the scalar law and the geometries take it.
#ifndef SCREE_CONTACT_ONE_BODY_H
#define SCREE_CONTACT_ONE_BODY_H

#include "contact/scalar.h"
#include "state/state.h"

/// A body with v(n - 1/2).
typedef struct contact_body {
    scree_row row;
    scree_turn_row turn;         ///< 3D
    const double *stretch;       ///< its row; NULL: it is rigid
    const scree_predicted *lead; ///< its row; NULL: the scheme does not know it
    const scree_state *state;
    size_t number; ///< row of the state that geometry finds more of it in
} contact_body;

/// The body in `row`, with the velocities that the state holds.
static inline contact_body contact_body_get(const scree_state *state, size_t row)
{
    contact_body body = {
        .row = state->row[row], .stretch = scree_stretch_row(state, row), .state = state, .number = row};
    if (state->turn) body.turn = state->turn[row];
    if (state->lead) body.lead = &state->lead[row];
    return body;
}

static inline bodies contact_body_lane(int dimension, const contact_body *body)
{
    bodies lane = body_get(dimension, &body->row, &body->turn);
    lane.stretch = body->stretch;
    lane.lead = body->lead;
    lane.state = body->state;
    lane.row = body->number;
    return lane;
}

#endif
