/// From the motion at a contact to what is summed: forces and torques on both bodies and ledger increments as integers.
/// Shared by the scalar reference, the walls and the vector kernels.
#ifndef SCREE_CONTACT_EVALUATE_H
#define SCREE_CONTACT_EVALUATE_H

#include "contact/job.h"
#include "contact/laws.h"

/// Contributions of one contact a lane, in quanta. The force on second is the opposite of that on first.
typedef struct contact_quanta {
    lanes_bits fx, fy, torque_first, torque_second;
    lanes_bits count;                        ///< 1 where touching
    lanes_bits damping, friction, stiffness; ///< zero without a ledger
    lanes_bits in_range;                     ///< mask: the force is a number below the limit
    lanes_bits normal, tangential;           ///< the same force along n and t
} contact_quanta;

SCREE_INLINE contact_quanta contact_evaluate(scree_law law, bool ledger, const law_constants *constants,
                                             const law_settings *settings, const contact_scale *scale, const motion *m,
                                             lanes_bits touching, const law_memory *before, law_memory *after)
{
    law_force f = law_evaluate(law, constants, settings, m, touching, before, after);
    contact_quanta q = {
        .fx = lanes_fixed(f.normal * m->normal_x - f.tangential * m->normal_y, scale->inverse_force),
        .fy = lanes_fixed(f.normal * m->normal_y + f.tangential * m->normal_x, scale->inverse_force),
        .torque_first = lanes_fixed(-(m->arm_first * f.tangential), scale->inverse_torque),
        .torque_second = lanes_fixed(-(m->arm_second * f.tangential), scale->inverse_torque),
        .count = -touching,
        .normal = lanes_fixed(f.normal, scale->inverse_force),
        .tangential = lanes_fixed(f.tangential, scale->inverse_force),
        .in_range = lanes_at_or_below(f.normal + lanes_abs(f.tangential), lanes_all(scale->force_limit)),
    };
    if (ledger) {
        q.damping = lanes_fixed(f.damping, scale->inverse_damping);
        q.friction = lanes_fixed(f.friction, scale->inverse_friction);
        q.stiffness = lanes_fixed(f.stiffness, scale->inverse_friction);
    }
    return q;
}

#endif
