/// The face of a shape of walls of the case: one file a shape (src/shape/wall_*.c). Its keys are those of its section
/// of `walls`, behind the name. What it makes is put together from a few kinds of surface (shape/wall_set.h), so that
/// search and contacts know no shape.
#ifndef SCREE_MODULE_WALL_SHAPE_H
#define SCREE_MODULE_WALL_SHAPE_H

#include "module/module.h"

struct scree_surface;

/// `keys`: the module's struct. dimension: of space.
typedef struct scree_wall_shape {
    bool only_3d; ///< there is none in two dimensions
    bool only_2d; ///< there is none in space
    bool endless; ///< it has no end, and cannot turn
    /// What is wrong with its keys, and under which; NULL: nothing.
    const char *(*wrong)(const void *keys, int dimension, const char **key);
    /// The same in a sample that repeats itself in the directions of the mask `periodic`: there it has to look the same
    /// from a body and from its ghost. NULL: it does not.
    const char *(*wrong_in_cell)(const void *keys, int periodic, const char **key);
    /// Area seen along a unit vector [m2], in 2D a length [m]; 0: it has none. NULL: never has.
    double (*face)(const void *keys, int dimension, const double direction[3]);
    /// Finds the files that the keys of wall `index` name, and notes what is wrong with them, or with keys whose
    /// message says more than where. NULL: it has none.
    void (*find)(scree_reader *reader, int64_t index, void *keys);
    /// Makes its primitives in a surface that is zero but for its config. Errors: of its files, memory.
    scree_status (*make)(const void *keys, int dimension, struct scree_surface *surface,
                         scree_error *error) SCREE_MUST_USE;
} scree_wall_shape;

#endif
