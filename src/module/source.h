/// The face of a kind of source: one file a kind (src/source/). Its keys are those of its section of `sources`, behind
/// the name. It says where a grain may be born; when, which one and how fast is the same for all kinds.
#ifndef SCREE_MODULE_SOURCE_H
#define SCREE_MODULE_SOURCE_H

#include "module/module.h"

/// Where the centres of grains are born: origin + sum of u_k edge_k, with all u_k between 0 and 1.
typedef struct scree_source_place {
    double origin[3];  ///< m
    double edge[3][3]; ///< m
    int edges;         ///< so many; 0: a point
} scree_source_place;

/// How a source follows the flat top of a pile.
typedef struct scree_source_plateau {
    double depth;  ///< m, it ends where the surface is so far below its mean level; NAN: a mean diameter
    double margin; ///< m, the source ends so far inside of it; NAN: a mean radius
    bool stops;    ///< the source has no more grains when it is used up
} scree_source_plateau;

/// `keys`: the module's struct.
typedef struct scree_source_kind {
    bool wide;  ///< has more than one point, so that there are layers
    bool rains; ///< it is there to spread grains: one in which no two lie side by side is wrong
    /// What is wrong with its keys, and under which; NULL: nothing. NULL: never anything.
    const char *(*wrong)(const void *keys, int dimension, const char **key);
    /// Its place as it is given.
    void (*place)(const void *keys, scree_source_place *place);
    /// Whether it follows the plateau of the pile, and how. NULL: never.
    bool (*follows)(const void *keys, scree_source_plateau *plateau);
} scree_source_kind;

#endif
