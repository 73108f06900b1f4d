/// The list of laws: the only place that maps a scree_law to its code. With a constant `law` the compiler keeps one
/// branch.
#ifndef SCREE_CONTACT_LAWS_H
#define SCREE_CONTACT_LAWS_H

#include "contact/hertz_brilliantov.h"
#include "contact/hertz_mindlin.h"

SCREE_INLINE law_settings law_settings_get(const scree_model *model, double step)
{
    return (law_settings){
        .step = step,
        .damping_time = model->damping_time,
        .inverse_exponent = model->inverse_exponent,
        .exponent = 1.0 / model->inverse_exponent,
        .inverse_reference_velocity = 1.0 / model->reference_velocity,
    };
}

/// Whether the law reads and writes history rows.
SCREE_INLINE bool law_remembers(scree_law law, bool ledger)
{
    return ledger || law != SCREE_LAW_HERTZ_BRILLIANTOV;
}

/// Whether the law needs motion_foresee.
SCREE_INLINE bool law_foresees(scree_law law)
{
    return law == SCREE_LAW_HERTZ_BRILLIANTOV_IMPLICIT;
}

SCREE_INLINE law_force law_evaluate(scree_law law, const law_constants *constants, const law_settings *settings,
                                    const motion *m, lanes_bits touching, const law_memory *before, law_memory *after)
{
    if (law == SCREE_LAW_HERTZ_MINDLIN) return hertz_mindlin(constants, settings, m, touching, before, after);
    return hertz_brilliantov(law_foresees(law), constants, settings, m, touching, before, after);
}

#endif
