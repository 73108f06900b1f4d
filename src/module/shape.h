/// The face of a shape of particles: one file a family of shapes (src/shape/). A shape says what a body of it is; how
/// two bodies touch is the affair of a geometry (module/geometry.h).
#ifndef SCREE_MODULE_SHAPE_H
#define SCREE_MODULE_SHAPE_H

#include "module/module.h"

typedef struct scree_shape {
    int dimension;         ///< of the space that such bodies are in
    const char *elsewhere; ///< shape that takes its place in the other dimension,
    const char *only_here; ///< and the message that says so
    bool round;            ///< looks the same from all sides: no orientation matters, and its radius is all that it has
    /// Area [m2] of bodies in two dimensions from their <R^2>, volume [m3] in three from <R^3>, R the equivalent
    /// radius.
    double (*volume)(double power);
} scree_shape;

#endif
