/// Elastic moduli of the specimen of a simulation, for programs.
#include "specimen/moduli.h"
#include "library/handle.h"
#include "library/specimen.h"
#include "specimen/piece.h"

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

/// Young's modulus along each axis, Poisson's ratios, and the bulk modulus, of a sample that ends somewhere.
static scree_status press(const scree_specimen *specimen, const scree_box *box, scree_moduli *out, scree_error *error)
{
    scree_status status = SCREE_OK;
    for (int k = 0; k < 3; k++) out->uniaxial_young[k] = NAN;
    for (int k = 0; k < 9; k++) out->uniaxial_poisson[k] = NAN;
    for (int axis = 0; axis < specimen->dimension && !status; axis++) {
        scree_uniaxial found;
        status = scree_specimen_press_piece(specimen, box, axis, &found, error);
        out->uniaxial_young[axis] = found.young;
        out->iterations += found.iterations;
        for (int k = 0; k < 3; k++) out->uniaxial_poisson[3 * axis + k] = found.poisson[k];
    }
    if (status) return status;
    size_t iterations;
    status = scree_specimen_press_piece_all(specimen, box, &out->pressed_bulk, &iterations, error);
    out->iterations += iterations;
    return status;
}

scree_status scree_simulation_moduli(scree_simulation *s, const scree_particle_elasticity *elasticity,
                                     scree_moduli *out, scree_error *error)
{
    scree_specimen specimen;
    scree_specimen_moduli found;
    scree_box box;
    *out = (scree_moduli){.dimension = s->model.dimension};
    scree_status status = library_specimen(s, elasticity, &specimen, error);
    if (status) return status;
    status = scree_specimen_find_piece(&s->state, &specimen, &box, error);
    if (!status) status = press(&specimen, &box, out, error);
    if (!status) status = scree_specimen_take_piece(&specimen, &box, error);
    if (!status) status = scree_specimen_find_moduli(&specimen, &found, error);
    if (!status) {
        out->bodies = specimen.body_count;
        out->contacts = specimen.contact_count;
        out->iterations += found.iterations;
        out->isotropic = public_moduli(found.isotropic);
        out->voigt = public_moduli(found.voigt);
        out->estimate = public_moduli(scree_specimen_estimate(&specimen));
        out->anisotropy = found.anisotropy;
        out->asymmetry = found.asymmetry;
        set_stiffness(specimen.dimension, found.stiffness, out->stiffness);
        for (int k = 0; k < 9; k++) out->fabric[k] = found.fabric[k];
    }
    scree_specimen_destroy(&specimen);
    return status;
}
