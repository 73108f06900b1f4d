/// The piece of a specimen whose moduli are asked for.
#ifndef SCREE_SPECIMEN_PIECE_H
#define SCREE_SPECIMEN_PIECE_H

#include "base/error.h"
#include "specimen/moduli.h"
#include "specimen/uniaxial.h"
#include "state/state.h"

/// The box that a specimen fills which does not repeat itself, by plates where these stand; of one that repeats itself
/// in all directions none is asked for. Errors: SCREE_ERROR_INPUT when it fills no box, or repeats itself in some.
scree_status scree_specimen_find_piece(const scree_state *state, const scree_specimen *specimen, scree_box *box,
                                       scree_error *error) SCREE_MUST_USE;

/// A specimen that does not repeat itself becomes the piece within its outermost bodies (box.h). Errors: memory.
scree_status scree_specimen_take_piece(scree_specimen *specimen, const scree_box *box,
                                       scree_error *error) SCREE_MUST_USE;

/// The specimen between two plates across `axis`, where it ends: uniaxial.h. NAN in all of *out where it repeats
/// itself. Errors: as there.
scree_status scree_specimen_press_piece(const scree_specimen *specimen, const scree_box *box, int axis,
                                        scree_uniaxial *out, scree_error *error) SCREE_MUST_USE;

/// The same between plates all around: its bulk modulus [Pa].
scree_status scree_specimen_press_piece_all(const scree_specimen *specimen, const scree_box *box, double *bulk,
                                            size_t *iterations, scree_error *error) SCREE_MUST_USE;

/// Voigt's moduli from number, mean springs and mean square radius alone (M 4.15-4.18).
scree_isotropic scree_specimen_estimate(const scree_specimen *specimen);

#endif
