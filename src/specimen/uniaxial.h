/// A specimen that fills a box between two smooth plates: Young's modulus and Poisson's ratios as a uniaxial test has
/// them, by a static solution.
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
/// the bodies of a side across. Errors: SCREE_ERROR_INPUT when it is periodic in some direction, or no box;
/// SCREE_ERROR_GUARD without convergence; memory.
scree_status scree_specimen_press(const scree_specimen *specimen, const scree_box_faces *faces, int axis,
                                  scree_uniaxial *out, scree_error *error) __attribute__((warn_unused_result));

#endif
