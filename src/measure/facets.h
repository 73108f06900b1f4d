/// The boundary of the assembly as a closed surface of facets with linear interpolation (P 3.1-3.3): edges of the
/// Delaunay loop in 2D, triangles of the hull in 3D. Its nodes are bodies; one description for both dimensions.
///
/// Each node has an area vector a = integral of its interpolation function times the outward normal. Then, for any
/// velocities v of the nodes,
///     mean velocity gradient L = (1/V) sum v (x) a,     sum a = 0,     sum x (x) a = V times the unit tensor,
/// and forces f = S a of a uniform stress S have the power sum f . v = V S : L, exactly.
#ifndef SCREE_MEASURE_FACETS_H
#define SCREE_MEASURE_FACETS_H

#include "measure/delaunay_boundary.h"
#include "measure/grain_places.h"
#include "search/peel_rule.h"
#include "state/state.h"

/// Number of nodes, and of one of them its id, its body for other processes, its row. Loop and hull list them in an
/// order that does not depend on rows.
size_t scree_boundary_count(const scree_state *state);
static inline uint32_t scree_boundary_id(const scree_state *state, size_t node)
{
    return state->dimension == 3 ? scree_hull_of(state)->id[node] : scree_loop_of(state)->id[node];
}
static inline const scree_boundary_body *scree_boundary_body_of(const scree_state *state, size_t node)
{
    return state->dimension == 3 ? &scree_hull_of(state)->body[node] : &scree_loop_of(state)->body[node];
}
/// SCREE_NO_ROW: with another process.
static inline size_t scree_boundary_row(const scree_state *state, size_t node)
{
    return scree_state_row_of(state, scree_boundary_id(state, node));
}

/// Position [m] of a node.
static inline void scree_boundary_position(const scree_state *state, size_t node, scree_vector position)
{
    scree_boundary_place(state, scree_boundary_id(state, node), scree_boundary_body_of(state, node), position);
}

/// Velocity [m/s] of a node.
static inline void scree_boundary_motion(const scree_state *state, size_t node, scree_vector velocity)
{
    scree_boundary_velocity(state, scree_boundary_id(state, node), scree_boundary_body_of(state, node), velocity);
}

/// One facet: its nodes, in 2D counter-clockwise with the sample on the left, in 3D counter-clockwise from outside.
typedef struct scree_facet {
    size_t node[3];
    scree_vector position[3]; ///< m, relative to the first node of the boundary
    int corners;              ///< 2 in 2D, 3 in 3D
} scree_facet;

size_t scree_facet_count(const scree_state *state);
scree_facet scree_facet_get(const scree_state *state, size_t index);

/// By what rule the boundary that follows the present one is found among `grains` grains. *positions: the memory of the
/// rule's facets, in places of that order, which the caller releases; NULL where there is no boundary yet. Errors:
/// memory.
scree_status scree_facet_rule(const scree_model *model, const scree_state *state, const scree_grain_place *grain,
                              size_t grains, scree_peel_rule *rule, uint32_t **positions,
                              scree_error *error) SCREE_MUST_USE;

/// Area vectors of all nodes [m2] (in 2D length times thickness); `area` has one element a node.
void scree_boundary_areas(const scree_model *model, const scree_state *state, scree_vector *area);

#endif
