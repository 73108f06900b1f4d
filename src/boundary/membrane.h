/// Membrane of discs around the sides of a sample; the descriptor is scree_boundary_membrane.
#ifndef SCREE_BOUNDARY_MEMBRANE_H
#define SCREE_BOUNDARY_MEMBRANE_H

#include "state/state.h"

/// Places the chain around the grains between the bottom and the top plate (membrane_place.c): the bodies are appended
/// to the state, unstressed, touching the grains without indentation. Errors: memory; SCREE_ERROR_GUARD when the plates
/// are too close for two discs.
scree_status scree_membrane_place(const scree_model *model, scree_state *state, scree_error *error) SCREE_MUST_USE;

/// Energy [J] stored in the chain.
double scree_membrane_energy(const scree_model *model, const scree_state *state);

/// Row of the k-th body of the membrane.
static inline size_t scree_membrane_row(const scree_state *state, size_t k)
{
    return state->row_of_id[state->grains + k];
}

#endif
