/// The code of the laws of the table (module/table.h). With a constant `law` the compiler keeps one branch, and traits
/// are constants.
#ifndef SCREE_CONTACT_LAWS_H
#define SCREE_CONTACT_LAWS_H

#include "contact/hertz_brilliantov.h"
#include "contact/hertz_dmt.h"
#include "contact/hertz_jkr.h"
#include "contact/hertz_mindlin.h"
#include "contact/linear.h"
#include "contact/polygon_overlap.h"
#include "contact/polygon_potential.h"

#define LAW_TRAITS(law) [SCREE_SLOT_##law] = law##_traits,
static const scree_law_traits *const all_law_traits[SCREE_MODULE_COUNT] = {SCREE_LAWS(LAW_TRAITS)};

SCREE_INLINE const scree_law_traits *law_traits(variant v)
{
    return &all_law_traits[v.law][v.option];
}

SCREE_INLINE law_settings law_settings_get(const scree_law_use *law, double step)
{
    law_settings settings = {.step = step};
    memcpy(settings.number, law->number, sizeof settings.number);
    return settings;
}

/// Whether it needs kinematics_predict.
SCREE_INLINE bool law_predicts(variant v)
{
    return law_traits(v)->looks_ahead;
}

/// Whether it reads and writes last_force rows.
SCREE_INLINE bool law_keeps_last_force(variant v)
{
    return law_traits(v)->keeps_last_force[v.dimension - 2];
}

/// Whether it reads and writes rolling rows, and gives couples.
SCREE_INLINE bool law_rolls(variant v)
{
    return law_traits(v)->rolling;
}

/// Whether it is of pairs of the persistent list, which are in contact at any distance.
SCREE_INLINE bool law_holds(variant v)
{
    return law_traits(v)->holds;
}

/// Whether contacts may outlast the touch.
SCREE_INLINE bool law_necks(variant v)
{
    return law_traits(v)->necks;
}

/// Whether the overlap follows the strains of the bodies.
SCREE_INLINE bool law_deforms(variant v)
{
    return law_traits(v)->deforms;
}

/// Whether it reads the second half of the constants.
SCREE_INLINE bool law_is_wide(variant v)
{
    return law_traits(v)->wide;
}

#define LAW_EVALUATE(law_)                                                                                             \
    if (v.law == SCREE_SLOT_##law_) return law_(v, constants, settings, m, touching, before, after);

SCREE_INLINE law_force law_evaluate(variant v, const law_constants *constants, const law_settings *settings,
                                    const kinematics *m, lanes_bits touching, const law_memory *before,
                                    law_memory *after)
{
    SCREE_LAWS(LAW_EVALUATE)
    return (law_force){.normal = lanes_all(0)};
}

#endif
