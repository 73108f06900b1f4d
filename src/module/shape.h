/// The face of a shape of particles: one file a family of shapes (src/shape/). A shape says what a body of it is; how
/// two bodies touch is the affair of a geometry (module/geometry.h).
#ifndef SCREE_MODULE_SHAPE_H
#define SCREE_MODULE_SHAPE_H

#include "module/module.h"

#include <stdint.h>

typedef struct scree_shape {
    int dimension;         ///< of the space that such bodies are in
    const char *elsewhere; ///< shape that takes its place in the other dimension,
    const char *only_here; ///< and the message that says so
    bool round;            ///< looks the same from all sides: no orientation matters, and its radius is all that it has
    /// Area [m2] of bodies in two dimensions from their <R^2>, volume [m3] in three from <R^3>, R the equivalent
    /// radius.
    double (*volume)(double power);
    // ---- of a shape that is not round; keys: its struct of the section of the particles ----
    /// What is wrong with the keys, and in `key` under which; NULL: nothing.
    const char *(*wrong)(const void *keys, const char **key);
    /// Bounding radius over equivalent radius: no body has more; that of body `number` as drawn.
    double (*largest_reach)(const void *keys);
    double (*reach)(const void *keys, uint64_t seed, uint64_t number);
    /// Width of body `number` as drawn where it is narrowest, over the equivalent radius. NULL: twice that.
    double (*narrowest)(const void *keys, uint64_t seed, uint64_t number);
    /// Radius of the corners over the equivalent radius; 0: they are sharp.
    double (*rounding)(const void *keys);
    /// Corners of body `number` as drawn, relative to the centre of the body, for an equivalent radius of 1; of its
    /// core where they are rounded. corner: room for SCREE_POLYGON_CORNERS (shape/polygon.h). Returns their number; 0:
    /// the keys are wrong, and noted.
    int (*corners)(const void *keys, uint64_t seed, uint64_t number, double (*corner)[2]);
    /// Gives the body in `row` the outline of body `number` as drawn, within the radius that its row has, with mass,
    /// inertia and sizes that follow. Errors: memory.
    scree_status (*dress)(const scree_model *model, const void *keys, uint64_t number, scree_state *state, size_t row,
                          scree_error *error);
} scree_shape;

#endif
