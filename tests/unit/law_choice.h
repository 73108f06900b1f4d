/// Laws of contacts as tests choose them: each with its usual option.
#ifndef SCREE_TESTS_LAW_CHOICE_H
#define SCREE_TESTS_LAW_CHOICE_H

#include "contact/laws.h"

typedef enum law_choice {
    HERTZ_BRILLIANTOV,
    HERTZ_MINDLIN,
    HERTZ_BRILLIANTOV_IMPLICIT,
    LINEAR,
    HERTZ_JKR,
    HERTZ_DMT
} law_choice;

/// Slot of its module.
static inline int law_slot(law_choice law)
{
    if (law == LINEAR) return SCREE_SLOT_linear;
    if (law == HERTZ_JKR) return SCREE_SLOT_hertz_jkr;
    if (law == HERTZ_DMT) return SCREE_SLOT_hertz_dmt;
    return law == HERTZ_MINDLIN ? SCREE_SLOT_hertz_mindlin : SCREE_SLOT_hertz_brilliantov;
}

/// Numbers of hertz_brilliantov: T [s], c, and v_R of the model; options stay.
static inline void law_numbers(scree_model *model, double damping_time, double friction_exponent)
{
    brilliantov_numbers(damping_time, friction_exponent, model->reference_velocity, model->laws[0].number);
}

/// For a model that was not built from a case; its v_R is set.
static inline void law_choose(scree_model *model, law_choice law)
{
    model->laws[0] = (scree_law_use){.law = law_slot(law)};
    if (law == HERTZ_BRILLIANTOV_IMPLICIT) model->laws[0].option = BRILLIANTOV_IMPLICIT;
    law_numbers(model, 2e-6, 50);
}

static inline void law_rescale(scree_model *model, bool rescaled)
{
    if (rescaled) model->laws[0].option |= MINDLIN_RESCALED;
}

static inline scree_pair_constants hertz_pair(double normal, double tangential, double friction, double damping)
{
    return (scree_pair_constants){{[HERTZ_NORMAL] = normal,
                                   [HERTZ_TANGENTIAL] = tangential,
                                   [SCREE_FRICTION] = friction,
                                   [HERTZ_DAMPING] = damping,
                                   [HERTZ_RATIO] = normal / tangential}};
}

/// Makes all pairs and walls of a model stick with B [m^(1/2)]; necks reach no further than those of radius [m].
static inline void law_stick(scree_model *model, double root, double radius)
{
    for (int a = 0; a < 2; a++) {
        model->walls[a].value[ADHESIVE_ROOT] = root;
        for (int b = 0; b < 2; b++) model->pairs[a][b].value[ADHESIVE_ROOT] = root;
    }
    if (model->laws[0].law == SCREE_SLOT_hertz_jkr)
        model->laws[0].number[SCREE_LAW_REACH] = 0.75 * root * cbrt(0.25 * root * radius);
}

/// k_n = normal [N/m] + by_radius [N/m2] R_eff, k_t = ratio k_n, damping ratios of both dashpots.
static inline scree_pair_constants linear_pair(double normal, double by_radius, double ratio, double friction,
                                               double damping, double tangential_damping)
{
    return (scree_pair_constants){{[LINEAR_NORMAL] = normal,
                                   [LINEAR_RATIO] = ratio,
                                   [SCREE_FRICTION] = friction,
                                   [LINEAR_DAMPING] = 2 * damping,
                                   [LINEAR_BY_RADIUS] = by_radius,
                                   [LINEAR_TANGENTIAL_DAMPING] = 2 * tangential_damping * sqrt(ratio),
                                   [LINEAR_INVERSE_RATIO] = ratio > 0 ? 1 / ratio : 0}};
}

#endif
