/// Contacts with the walls of the case (shape/wall_set.h): which primitives a body touches, what passes from one to the
/// next as it moves on, forces on the walls.
///
/// A wall is a body of infinite radius and mass that moves as its points do: R_eff = R, m_eff = m. Curvature of a
/// cylinder, cone or edge does not enter the law, only the turn of the normal as the body moves on. The motion is that
/// in the frame of the wall, which stands still there while it turns.
///
/// Which primitives. Those of one wall that are local minima of the distance and closer than the radius, the closest
/// first; one whose normal differs from that of a closer one by less than the angle `smooth` is the same contact seen
/// twice (round-off between neighbours; facets of a concave round surface) and does not count. So the elastic energy of
/// a body is a continuous function of its place wherever faces meet at a smaller angle than `smooth` or at convex
/// edges.
///
/// For polygons, sharp or rounded, a plane touches where the outline of the body does, and a solid with an outline is
/// one contact, whatever edges and corners of it the body covers: normal, point and depth are those of the overlap
/// (contact/outlines.h, contact/rounded.h), and the closest point of the centre only tells who is near.
///
/// What contacts remember goes with their primitive. When a body touches a primitive anew and has just left another one
/// of the same wall whose normal is nearly the same, it takes the memory along: a spring survives the change of the
/// triangle, and the ledger accumulates what it would have accumulated on one plane. In space a tangential displacement
/// is brought into the plane of its primitive in every step, with its length.
#ifndef SCREE_CONTACT_SURFACES_H
#define SCREE_CONTACT_SURFACES_H

#include "contact/job.h"
#include "contact/scalar.h"
#include "shape/wall_set.h"
#include "state/work.h"

enum { CONTACT_TOUCHES = 64 };

typedef struct primitive_touch {
    size_t pair; ///< in work->primitive_pairs
    int surface;
    scree_closest_point closest;
} primitive_touch;

/// Contacts of one body, by distance; of more than CONTACT_TOUCHES the deepest.
typedef struct primitive_touches {
    int count;
    primitive_touch touch[CONTACT_TOUCHES];
} primitive_touches;

static inline const scree_surface *contact_surface_of(const scree_wall_set *wall_set, size_t primitive)
{
    return &wall_set->surface[scree_primitive_surface(wall_set, primitive)];
}

/// Where the pairs of the body of pair `begin` end.
static inline size_t contact_group_end(const scree_wall_pair_list *pairs, size_t begin)
{
    size_t end = begin + 1;
    while (end < pairs->count && pairs->body[end] == pairs->body[begin]) end++;
    return end;
}

/// Which of the pairs [begin, end) of one body touch.
void contact_primitives_touching(const scree_wall_set *wall_set, int dimension, const bodies *body,
                                 const scree_wall_pair_list *pairs, size_t begin, size_t end,
                                 primitive_touches *touches);

/// Sets touching[k] to 1 for each of work->primitive_pairs that touches, else to 0.
void contact_primitives_mark(const scree_state *state, const scree_work *work, uint8_t *touching);

/// Constants of a body of `material` on a wall: those of its plates, or with the wall's own material and friction.
scree_pair_constants contact_surface_constants(const scree_model *model, const scree_surface *surface, int material);

/// Their law.
const scree_law_use *contact_surface_law(const scree_model *model, const scree_surface *surface, int material);

/// Motion of a body against the primitive of a wall at `closest point`.
kinematics kinematics_of_surface(const scree_wall_set *wall_set, size_t primitive, variant v, const bodies *body,
                                 const scree_closest_point *closest, bool moving, double step);

/// Torque of a contact on its body about the centre of the wall [N m]: F at the centre of the body and its own torque.
void contact_surface_torque(const scree_state *state, const scree_vector hub, const bodies *body,
                            const contact_quanta *q, scree_vector torque);

/// Contacts of bodies in rows [begin, end) with the walls of the case, those under the job's law: memory, sums, totals.
void contact_surfaces(contact_job *job, const scree_state *state, const scree_work *work, size_t begin, size_t end);

/// Quantum of the torques on the walls [N m], a power of two.
double contact_surface_torque_quantum(const scree_model *model, const scree_state *state,
                                      const scree_wall_set *wall_set);

/// Keeps forces, torques and work of the walls in the state; returns their work on the bodies in this step [J], the
/// trapezoid of measure/energy.c.
double contact_surfaces_settle(scree_state *state, const scree_work *work, const contact_totals *totals,
                               const contact_scale *scale);

#endif
