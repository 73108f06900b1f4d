/// From the plates of a state to the faces of a box.
#include "specimen/piece.h"

#include "specimen/box.h"
#include "state/plates.h"
#include "theory/lattice.h"

/// Where plates stand the sample ends there, elsewhere with its bodies.
static void find_faces(const scree_state *state, scree_box_faces *faces)
{
    for (int w = 0; w < SCREE_WALL_COUNT; w++) {
        const int axis = w / 2 == 0 ? state->dimension - 1 : w / 2 - 1;
        const scree_wall *plate = &scree_plates(state)[w];
        if (axis < state->dimension)
            faces->end[w % 2][axis] = plate->active ? plate->position * plate->normal[axis] : NAN;
    }
}

scree_status scree_specimen_find_piece(const scree_state *state, const scree_specimen *specimen, scree_box *box,
                                       scree_error *error)
{
    const unsigned all = (1U << specimen->dimension) - 1;
    scree_box_faces faces = {{{NAN, NAN, NAN}, {NAN, NAN, NAN}}};
    *box = (scree_box){0};
    if (specimen->periodic == all) return SCREE_OK;
    find_faces(state, &faces);
    return scree_specimen_find_box(specimen, &faces, box, error);
}

scree_status scree_specimen_take_piece(scree_specimen *specimen, const scree_box *box, scree_error *error)
{
    scree_specimen piece;
    if (specimen->periodic) return SCREE_OK;
    scree_status status = scree_specimen_cut_box(specimen, box, &piece, error);
    if (status) return status;
    scree_specimen_destroy(specimen);
    *specimen = piece;
    return SCREE_OK;
}

scree_status scree_specimen_press_piece(const scree_specimen *specimen, const scree_box *box, int axis,
                                        scree_uniaxial *out, scree_error *error)
{
    *out = (scree_uniaxial){NAN, {NAN, NAN, NAN}, 0};
    return specimen->periodic ? SCREE_OK : scree_specimen_press(specimen, box, axis, out, error);
}

scree_status scree_specimen_press_piece_all(const scree_specimen *specimen, const scree_box *box, double *bulk,
                                            size_t *iterations, scree_error *error)
{
    *bulk = NAN;
    *iterations = 0;
    return specimen->periodic ? SCREE_OK : scree_specimen_press_all(specimen, box, bulk, iterations, error);
}

scree_isotropic scree_specimen_estimate(const scree_specimen *s)
{
    double square = 0, normal = 0, tangential = 0;
    for (size_t k = 0; k < s->body_count; k++) square += s->radius[k] * s->radius[k] / (double)s->body_count;
    for (size_t c = 0; c < s->contact_count; c++) {
        normal += s->contact[c].stiffness.normal / (double)s->contact_count;
        tangential += s->contact[c].stiffness.tangential / (double)s->contact_count;
    }
    const scree_voigt_moduli m =
        scree_voigt_estimate(s->dimension, (double)s->contact_count, square, s->extent, normal, tangential);
    return (scree_isotropic){m.young, m.poisson, m.bulk, m.shear};
}
