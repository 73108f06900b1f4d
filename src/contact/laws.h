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
        .binary_exponent = model->inverse_exponent * M_LOG2E,
        .exponent = 1.0 / model->inverse_exponent,
        .inverse_reference_velocity = 1.0 / model->reference_velocity,
    };
}

/// Whether the law reads and writes history rows.
SCREE_INLINE bool law_remembers(variant v)
{
    return v.ledger || v.law != SCREE_LAW_HERTZ_BRILLIANTOV;
}

/// Whether the law needs motion_foresee.
SCREE_INLINE bool law_foresees(variant v)
{
    return v.law == SCREE_LAW_HERTZ_BRILLIANTOV_IMPLICIT;
}

/// Whether it reads and writes booking rows.
SCREE_INLINE bool law_books(variant v)
{
    return v.ledger && v.dimension == 3 && v.law == SCREE_LAW_HERTZ_MINDLIN;
}

/// Without a ledger, what only the ledger needs is not kept, so that histories do not depend on it.
SCREE_INLINE void law_forget(variant v, law_memory *after)
{
    if (v.ledger) return;
    const lanes none = lanes_all(0);
    if (v.dimension == 2) {
        if (!v.rescaled) after->value[1] = none;
        after->value[2] = after->value[3] = none;
    } else if (!v.rescaled) {
        after->value[3] = none;
    }
    for (int k = 0; k < 4 && v.rolling; k++) after->rolling_booked[k] = none;
}

SCREE_INLINE law_force law_evaluate(variant v, const law_constants *constants, const law_settings *settings,
                                    const motion *m, lanes_bits touching, const law_memory *before, law_memory *after)
{
    if (v.law == SCREE_LAW_HERTZ_MINDLIN) return hertz_mindlin(v, constants, settings, m, touching, before, after);
    return hertz_brilliantov(v, constants, settings, m, touching, before, after);
}

#endif
