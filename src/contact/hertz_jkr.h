/// Law hertz_jkr: Hertz's contact with the adhesion of Johnson, Kendall and Roberts, of which the neck holds until it
/// breaks (adhesive.h has the equations).
#ifndef SCREE_CONTACT_HERTZ_JKR_H
#define SCREE_CONTACT_HERTZ_JKR_H

#include "contact/adhesive.h"

#define hertz_jkr_KERNELS(row) row(hertz_jkr, 0, many) row(hertz_jkr, 1, many) row(hertz_jkr, 2, many)

static const scree_law_traits hertz_jkr_traits[] = {
    [0] = ADHESIVE_TRAITS(.necks = true),
    [ADHESIVE_ROLLING] = ADHESIVE_TRAITS(.necks = true, .rolling = true),
    [ADHESIVE_CONSTANT] = ADHESIVE_TRAITS(.necks = true, .rolling = true),
};

SCREE_INLINE law_force hertz_jkr(variant v, const law_constants *constants, const law_settings *settings,
                                 const kinematics *m, lanes_bits touching, const law_memory *before, law_memory *after)
{
    return adhesive_contact(true, v, constants, settings, m, touching, before, after);
}

#endif
