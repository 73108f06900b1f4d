/// A triangle mesh as a wall: topology, closest points, a tree of boxes.
///
/// Contacts of a sphere with a mesh are the local minima of the distance from its centre to the surface. A triangle is
/// convex, so a point of it is a local minimum on that triangle exactly if it is its closest point; hence a point
/// inside a face is a minimum when it is the foot of the centre, a point of an edge when it is the closest point of
/// both triangles beside it, a vertex when it is that of all triangles around it. So an edge between two faces of which
/// one is touched does not count, a sphere on a convex edge has one contact and one in a concave corner two, whatever
/// the order in which triangles are looked at. Distances are compared with a tolerance (MINIMUM_TOLERANCE in mesh.c),
/// so that no contact is lost to round-off where regions meet; two features that claim the same contact there have the
/// same normal, and the contact code keeps one of them (contact/surfaces.h). Both sides of a triangle are wall. Meshes
/// may be open.
#ifndef SCREE_SHAPE_MESH_H
#define SCREE_SHAPE_MESH_H

#include "state/state.h"

/// A node of the tree: a box around triangles order[begin .. end); its children are nodes `left` and left + 1.
typedef struct scree_mesh_node {
    double low[3], high[3];
    uint32_t begin, end;
    uint32_t left; ///< 0: a leaf
} scree_mesh_node;

typedef struct scree_mesh {
    size_t vertex_count, edge_count, triangle_count;
    scree_vector *vertex; ///< m
    uint32_t (*edge)[2];  ///< vertices, the lower first
    uint32_t (*triangle)[3];
    uint32_t (*triangle_edge)[3]; ///< edge opposite to no vertex in particular: k joins corners k and k + 1
    scree_vector *normal;         ///< of each triangle, right-handed
    // Triangles beside each edge and around each vertex: list[begin[k] .. begin[k + 1]); the first owns it.
    uint32_t *edge_begin, *edge_list;
    uint32_t *vertex_begin, *vertex_list;
    scree_mesh_node *node;
    uint32_t *order;
    size_t node_count;
    size_t degenerate; ///< triangles without area that were dropped
    size_t welded;     ///< corners of the file that became one vertex with an earlier one
} scree_mesh;

/// Where a sphere may touch: the closest point of a feature.
typedef struct scree_closest_point {
    scree_vector normal; ///< unit vector from the wall to the centre
    double distance;     ///< m, of the centre; negative behind the surface of a wall that has an inside
    bool minimum;        ///< a local minimum of the distance: a contact if the sphere reaches it
} scree_closest_point;

/// Builds topology and tree from `count` triangles of three corners each [m]; corners closer than 1e-6 of the extent
/// are one vertex. Errors: no triangle with an area, memory. Cost: n log n.
scree_status scree_mesh_build(scree_mesh *mesh, size_t count, const double (*corner)[3],
                              scree_error *error) SCREE_MUST_USE;
void scree_mesh_destroy(scree_mesh *mesh);

/// Number of features: triangles, then edges, then vertices.
static inline size_t scree_mesh_primitives(const scree_mesh *mesh)
{
    return mesh->triangle_count + mesh->edge_count + mesh->vertex_count;
}

/// The closest point of feature `primitive` for a centre at `place`.
void scree_mesh_closest_point(const scree_mesh *mesh, size_t primitive, const scree_vector place,
                              scree_closest_point *closest);

/// Distance from `place` to feature `primitive`.
double scree_mesh_distance(const scree_mesh *mesh, size_t primitive, const scree_vector place);

/// Calls `found(context, primitive)` for every feature within `reach` of `place`, each once; stops at the first status
/// that is not SCREE_OK. Cost: logarithmic, and linear in what is found.
scree_status scree_mesh_near(const scree_mesh *mesh, const scree_vector place, double reach,
                             scree_status (*found)(void *context, size_t primitive), void *context) SCREE_MUST_USE;

#endif
