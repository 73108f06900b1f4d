/// A specimen that fills a box between smooth plates, two or all around: Young's modulus and Poisson's ratios as a
/// uniaxial test has them, the bulk modulus of an isotropic one, by static solutions.
#ifndef SCREE_SPECIMEN_UNIAXIAL_H
#define SCREE_SPECIMEN_UNIAXIAL_H

#include "specimen/box.h"

typedef struct scree_uniaxial {
    double young;      ///< Pa, force on a plate over the area between the outermost surfaces, over the strain
    double poisson[3]; ///< 1, strain across the other axes over that along, with the sign changed; NAN along its own
    size_t iterations;
} scree_uniaxial;

/// Bodies of the two faces across `axis` move along it as two plates do, by the strain of their mean planes, and are
/// free otherwise, as all other bodies are; nothing acts on the sides. Strains go from plane to plane, of the means of
/// the bodies of a side across. box: that it fills. Errors: SCREE_ERROR_GUARD without convergence; memory.
scree_status scree_specimen_press(const scree_specimen *specimen, const scree_box *box, int axis, scree_uniaxial *out,
                                  scree_error *error) __attribute__((warn_unused_result));

/// The bulk modulus [Pa], in the plane that of areas, between plates across all axes: mean of the normal stresses over
/// the sum of the strains. The plates are smooth: bodies of a face move with it along its axis alone. Errors: the same.
scree_status scree_specimen_press_all(const scree_specimen *specimen, const scree_box *box, double *bulk,
                                      size_t *iterations, scree_error *error) __attribute__((warn_unused_result));

#endif
