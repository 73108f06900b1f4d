/// Elastic moduli of the specimen of a simulation, for programs.
#include "specimen/moduli.h"
#include "library/handle.h"
#include "library/specimen.h"
#include "specimen/box.h"
#include "state/plates.h"
#include "theory/lattice.h"

static scree_isotropic_moduli public_moduli(scree_isotropic m)
{
    return (scree_isotropic_moduli){m.young, m.poisson, m.bulk, m.shear};
}

/// Components of the tensor: off the diagonal of a strain the matrix of the specimen has them times sqrt 2.
static void set_stiffness(int dimension, const double *matrix, double *stiffness)
{
    const int n = dimension == 3 ? 6 : 3;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            stiffness[i * n + j] =
                matrix[i * n + j] * (i < dimension ? 1 : M_SQRT1_2) * (j < dimension ? 1 : M_SQRT1_2);
}

/// From number, springs and mean square radius alone.
static scree_isotropic_moduli estimate(const scree_specimen *s)
{
    double square = 0, normal = 0, tangential = 0;
    for (size_t k = 0; k < s->body_count; k++) square += s->radius[k] * s->radius[k] / (double)s->body_count;
    for (size_t c = 0; c < s->contact_count; c++) {
        normal += s->contact[c].stiffness.normal / (double)s->contact_count;
        tangential += s->contact[c].stiffness.tangential / (double)s->contact_count;
    }
    const scree_voigt_moduli m =
        scree_voigt_estimate(s->dimension, (double)s->contact_count, square, s->extent, normal, tangential);
    return (scree_isotropic_moduli){m.young, m.poisson, m.bulk, m.shear};
}

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

/// What is strained: the specimen, or the piece of it within its outermost bodies.
static scree_status take_piece(const scree_state *state, scree_specimen *specimen, scree_error *error)
{
    const unsigned all = (1U << specimen->dimension) - 1;
    scree_box_faces faces = {{{NAN, NAN, NAN}, {NAN, NAN, NAN}}};
    if (specimen->periodic == all) return SCREE_OK;
    scree_specimen piece;
    find_faces(state, &faces);
    scree_status status = scree_specimen_cut_box(specimen, &faces, &piece, error);
    if (status) return status;
    scree_specimen_destroy(specimen);
    *specimen = piece;
    return SCREE_OK;
}

scree_status scree_simulation_moduli(scree_simulation *s, const scree_particle_elasticity *elasticity,
                                     scree_moduli *out, scree_error *error)
{
    scree_specimen specimen;
    scree_specimen_moduli found;
    *out = (scree_moduli){.dimension = s->model.dimension};
    scree_status status = library_specimen(s, elasticity, &specimen, error);
    if (status) return status;
    status = take_piece(&s->state, &specimen, error);
    if (!status) status = scree_specimen_find_moduli(&specimen, &found, error);
    if (!status) {
        out->bodies = specimen.body_count;
        out->contacts = specimen.contact_count;
        out->iterations = found.iterations;
        out->isotropic = public_moduli(found.isotropic);
        out->voigt = public_moduli(found.voigt);
        out->estimate = estimate(&specimen);
        out->anisotropy = found.anisotropy;
        out->asymmetry = found.asymmetry;
        set_stiffness(specimen.dimension, found.stiffness, out->stiffness);
        for (int k = 0; k < 9; k++) out->fabric[k] = found.fabric[k];
    }
    scree_specimen_destroy(&specimen);
    return status;
}
