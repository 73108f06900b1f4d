/// Law hertz_dmt: Hertz's contact with a constant pull while the bodies touch, the limit of adhesion of stiff bodies
/// (Derjaguin, Muller and Toporov 1975; adhesive.h has the equations).
#ifndef SCREE_CONTACT_HERTZ_DMT_H
#define SCREE_CONTACT_HERTZ_DMT_H

#include "contact/adhesive.h"

#define hertz_dmt_KERNELS(row) row(hertz_dmt, 0, many) row(hertz_dmt, 1, many) row(hertz_dmt, 2, many)

static const scree_law_traits hertz_dmt_traits[] = {
    [0] = ADHESIVE_TRAITS(),
    [ADHESIVE_ROLLING] = ADHESIVE_TRAITS(.rolling = true),
    [ADHESIVE_CONSTANT] = ADHESIVE_TRAITS(.rolling = true),
};

SCREE_INLINE law_force hertz_dmt(variant v, const law_constants *constants, const law_settings *settings,
                                 const kinematics *m, lanes_bits touching, const law_memory *before, law_memory *after)
{
    return adhesive_contact(false, v, constants, settings, m, touching, before, after);
}

#endif
