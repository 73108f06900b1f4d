/// Law polygon_overlap: a force of the area that two polygons share over a length (Roul 2009, "R", 2.29 - 2.39).
///   f_e = E A / l,   l = r_1 r_2 / (r_1 + r_2), r the distances of the contact point from the centres (R 2.30, 2.31)
/// l is no length of the contact, as R calls it: a grain of twice the size is half as stiff. Everything else:
/// polygon_force.h.
///
/// f_e has no potential: a polygon that rocks on an edge, round a closed path of its pose, loses a tenth of the work
/// done on the way, or gains it when the path is run backwards. The contact is said to hold W = E A^2 / (2 l c), the
/// work of a contact of constant chord c and length l; what the force does beyond it is the ledger's row `stiffness`,
/// and the result law_work. Where the chord jumps (an edge turns through parallel) W jumps with it, and the row has the
/// jump. Cost: two roots, two divisions a contact.
#ifndef SCREE_CONTACT_POLYGON_LAW_OVERLAP_H
#define SCREE_CONTACT_POLYGON_LAW_OVERLAP_H

#include "contact/polygon_force.h"

#define polygon_overlap_KERNELS(row)
static const scree_law_traits polygon_overlap_traits[] = {POLYGON_TRAITS};

SCREE_INLINE law_force polygon_overlap(variant v, const law_constants *constants, const law_settings *settings,
                                       const kinematics *m, lanes_bits touching, const law_memory *before,
                                       law_memory *after)
{
    (void)v;
    const lanes elastic = constants->value[POLYGON_STIFFNESS] * m->overlap;
    const lanes stored = 0.5 * elastic * (m->area / m->chord);
    return polygon_force(constants, settings, m, touching, elastic, stored, before, after);
}

#endif
