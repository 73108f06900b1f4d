/// Who is beside whom in a packing: edges of the weighted Delaunay triangulation of the bodies, and which bodies are
/// beside which wall of the box. Walls are mirrors and faces of a periodic cell repeat the bodies: a body that shares
/// an edge with its own mirror image is beside the wall, and one that reaches into it.
#ifndef SCREE_PREPARE_GAP_NET_H
#define SCREE_PREPARE_GAP_NET_H

#include "prepare/gap_hole.h"

/// Bodies in a box from the origin to `side`, in any unit of length.
typedef struct scree_gap_bodies {
    int dimension;
    size_t count;
    unsigned periodic; ///< bit k: the box repeats itself along axis k; else there are walls
    double side[3];
    double *at; ///< count x (dimension + 1): centre, radius
} scree_gap_bodies;

typedef struct scree_gap_edge {
    uint32_t first, second;
    double shift[3]; ///< second stands at its place plus this
} scree_gap_edge;

typedef struct scree_gap_touch {
    uint32_t body;
    int wall; ///< 2 x axis, 1 more for the far one
} scree_gap_touch;

typedef struct scree_gap_net {
    scree_gap_edge *edge; ///< in the order of first, second, and images
    size_t edge_count;
    scree_gap_touch *touch; ///< in the order of bodies
    size_t touch_count;
    scree_gap_hole hole; ///< the widest
} scree_gap_net;

/// Makes `net`. Errors: memory; Qhull. Cost: some 10 microseconds a disc, 60 a sphere.
scree_status scree_gap_net_build(const scree_gap_bodies *bodies, scree_gap_net *net, scree_error *error) SCREE_MUST_USE;
void scree_gap_net_destroy(scree_gap_net *net);

/// Gap of an edge, negative for an overlap, and the unit vector from second to first.
double scree_gap_of_edge(const scree_gap_bodies *bodies, const scree_gap_edge *edge, double normal[3]);

/// Gap between a body and the wall.
double scree_gap_of_touch(const scree_gap_bodies *bodies, const scree_gap_touch *touch);

#endif
