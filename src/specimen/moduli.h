/// Elastic moduli of a specimen by static solutions.
#ifndef SCREE_SPECIMEN_MODULI_H
#define SCREE_SPECIMEN_MODULI_H

#include "specimen/specimen.h"

/// Most components of a symmetric tensor.
enum { SCREE_STRAINS = 6 };

/// Isotropic moduli. In the plane `bulk` is that of areas, and `young`, `poisson` are those of a stress along one axis
/// of the plane: K = E / (2 (1 - nu)), G = E / (2 (1 + nu)).
typedef struct scree_isotropic {
    double young, poisson, bulk, shear; ///< Pa, 1, Pa, Pa
} scree_isotropic;

/// Tensors are matrices strain_components x strain_components by rows, for xx, yy(, zz), then xy (yz, xz, xy) times
/// sqrt 2 [Pa], so that they turn and contract like the tensors.
typedef struct scree_specimen_moduli {
    double stiffness[SCREE_STRAINS * SCREE_STRAINS]; ///< stress over strain
    double affine[SCREE_STRAINS * SCREE_STRAINS]; ///< the same if all rigid particles followed the mean strain (Voigt)
    scree_isotropic isotropic, voigt;             ///< nearest isotropic tensors of the two
    double anisotropy; ///< 1, distance of `stiffness` from the nearest isotropic tensor over its own size
    double asymmetry;  ///< 1, size of its skew part over its own size
    double fabric[9];  ///< mean of n n over the contacts
    size_t iterations;
} scree_specimen_moduli;

/// Of a specimen that repeats itself in all directions, or a box that has been cut out (box.h): the mean strain is
/// imposed, bodies and particles find their places. Errors: SCREE_ERROR_INPUT without contacts or a volume;
/// SCREE_ERROR_GUARD without convergence; memory.
scree_status scree_specimen_find_moduli(const scree_specimen *specimen, scree_specimen_moduli *out, scree_error *error)
    __attribute__((warn_unused_result));

#endif
