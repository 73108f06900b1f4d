/// Law polygon_potential: the gradient of an energy of the area that two polygons share.
///   W = E A^2 / (2 l_0^2),   f_e = E A c / l_0^2,   l_0 = R_1 R_2 / (R_1 + R_2)
/// R the radii of the discs of equal area, c the chord. The force acts along the gradient of A as the first body moves,
/// on the line that the gradient as it turns demands (shape/overlap.h), so the work round every closed path of the
/// poses is zero; f_e is continuous but where the chord jumps, the energy everywhere. Beside a wall l_0 is R. Dashpots
/// and friction: polygon_force.h. Cost: two roots, three divisions a contact.
#ifndef SCREE_CONTACT_POLYGON_LAW_POTENTIAL_H
#define SCREE_CONTACT_POLYGON_LAW_POTENTIAL_H

#include "contact/polygon_force.h"

#define polygon_potential_KERNELS(row)
static const scree_law_traits polygon_potential_traits[] = {POLYGON_TRAITS};

SCREE_INLINE law_force polygon_potential(variant v, const law_constants *constants, const law_settings *settings,
                                         const kinematics *m, lanes_bits touching, const law_memory *before,
                                         law_memory *after)
{
    (void)v;
    const lanes share = m->area / (m->rest_length * m->rest_length) * constants->value[POLYGON_STIFFNESS];
    law_force force =
        polygon_force(constants, settings, m, touching, share * m->chord, 0.5 * share * m->area, before, after);
    force.stiffness = lanes_all(0); // what is left is the error of the trapezoid, which the balance shows
    return force;
}

#endif
