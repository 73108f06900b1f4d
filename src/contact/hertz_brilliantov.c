/// Module of law hertz_brilliantov (hertz_brilliantov.h).
///
/// Tangent: c_n = T A sqrt(R_eff d), A the normal stiffness; no tangential spring. The friction, mu f (s/v_R)^(1/c), is
/// bounded and cannot make a run unstable. But slip slower than s = 3 mu f dt/m (equal discs) is not resolved: it turns
/// its sign every step with about that size, which is of the order of v_R at P's large step of 1e-5 s (P figure 2.4,
/// scheme I).
///
/// Bounds, for an overlap d and a relative velocity u: |f_n| <= k_n d + T k_n u with k_n = A sqrt(R d), f <= f_n (1 +
/// mu max(1, (u / v_R)^(1/c))); energies of one contact and step: damping 2 (T k_n u) (u dt), friction f (u dt).
#include "contact/hertz_brilliantov.h"

#include "case/check.h"
#include "module/integrator.h"
#include "module/key_rows.h"
#include "state/memory_fields.h"

#include <float.h>
#include <stdio.h>

/// The slip that an implicit friction sees holds what one step may change: so many times the largest now.
static const double FORESEEN = 64;

static const scree_choice friction_updates[] = {
    {"explicit", SCREE_FRICTION_EXPLICIT, "from the slip of the step before; needs small steps"},
    {"implicit", SCREE_FRICTION_IMPLICIT,
     "from the slip that the coming step will have, solved contact by contact; stable at the large step"},
    {0},
};

typedef scree_brilliantov_config contact;
static const scree_key keys[] = {
    NUMBER(contact, damping_time, "s", .standard = "2 ms", FROM("0 s"), TO("1000 s"), .when = "law=hertz_brilliantov",
           .meaning = "Time T of the viscous part T K d^0.5 d'."),
    NUMBER(contact, friction_exponent, "1", .standard = "50", FROM("1"), TO("1e6"), .when = "law=hertz_brilliantov",
           .meaning = "Exponent c of the regularised friction mu f_n (s/v_R)^(1/c)."),
    CHOICE(contact, friction_update, friction_updates, .standard = "explicit", .when = "law=hertz_brilliantov",
           .meaning = "How the stiff friction law is integrated."),
    FLAG(contact, attraction, .standard = "no", .when = "law=hertz_brilliantov",
         .meaning =
             "Whether two bodies that part pull at each other until their overlap is gone (as the law is printed), "
             "or the force ends at zero."),
};

/// What a stage says of the update itself.
typedef struct stage_config {
    int friction_update; ///< scree_friction_update; auto: that of the case
} stage_config;

static const scree_choice stage_updates[] = {
    {"auto", SCREE_CHOICE_AUTO, "`contact.friction_update`"},
    {"explicit", SCREE_FRICTION_EXPLICIT, "as `contact.friction_update: explicit`"},
    {"implicit", SCREE_FRICTION_IMPLICIT, "as `contact.friction_update: implicit`"},
    {0},
};

static const scree_key stage_keys[] = {
    CHOICE(stage_config, friction_update, stage_updates, .standard = "auto", .when = "contact.law=hertz_brilliantov",
           .meaning = "How the stiff friction law is integrated during this stage."),
};

static int update_of(const contact *c, const scree_config_stage *stage)
{
    char section[64];
    (void)snprintf(section, sizeof section, "stages.%s", scree_modules[stage->kind]->name);
    const stage_config *own = scree_config_own(&scree_module_hertz_brilliantov, section, stage->own);
    return own && own->friction_update != SCREE_CHOICE_AUTO ? own->friction_update : c->friction_update;
}

/// Whether one of the laws of the case has the implicit update in a stage, of those that load the sample alone.
static bool has_implicit(const scree_config *config, bool loading)
{
    for (int k = 0; k <= config->contact.pair_count; k++) {
        if (scree_config_law(&config->contact, k) != SCREE_SLOT_hertz_brilliantov) continue;
        const contact *c = scree_config_law_keys(&config->contact, k);
        for (int64_t i = 0; c && i < config->stage_count; i++) {
            const scree_config_stage *stage = &config->stages[i];
            if (stage->kind < 0 || (loading && !scree_modules[stage->kind]->numbers->rate)) continue;
            if (update_of(c, stage) == SCREE_FRICTION_IMPLICIT) return true;
        }
    }
    return false;
}

/// The implicit update reckons with a kick of the size of the last step, and cannot stand steps of two sizes, which
/// stages that load have.
static void rules(scree_reader *reader, const scree_config *config)
{
    const scree_config_integrator *integrator = &config->integrator;
    if (integrator->scheme < 0 || !has_implicit(config, false)) return;
    const char *const path = "integrator.scheme", *const others = scree_rule_choices(reader, path, ", ",
                                                                                     scree_scheme_has_equal_steps);
    if (scree_integrator_get(integrator->scheme)->velocity)
        scree_rule_refuse(reader, path, others,
                          "an implicit contact.friction_update reckons with the kick of a leapfrog: choose another "
                          "scheme, or friction_update: explicit");
    scree_steps (*lengths)(const void *own) = scree_integrator_get(integrator->scheme)->steps;
    if (has_implicit(config, true) && lengths && lengths(integrator->own).small > 0)
        scree_rule_refuse(reader, path, others,
                          "an implicit contact.friction_update needs equal steps, and makes small ones needless: "
                          "choose another scheme, or small_steps: 0");
}

static unsigned options(const void *own, const scree_config_material *material)
{
    (void)material;
    const contact *c = own;
    return c->friction_update == SCREE_FRICTION_IMPLICIT ? BRILLIANTOV_IMPLICIT : 0;
}

static unsigned stage_options(const void *own, const scree_config_stage *stage, unsigned option)
{
    const bool implicit = update_of(own, stage) == SCREE_FRICTION_IMPLICIT;
    return (option & ~(unsigned)BRILLIANTOV_IMPLICIT) | (implicit ? BRILLIANTOV_IMPLICIT : 0);
}

static void resolve(const void *own, double reference_velocity, scree_law_use *use)
{
    const contact *c = own;
    brilliantov_numbers(c->damping_time, c->friction_exponent, reference_velocity, use->number);
    if (c->attraction) use->number[BRILLIANTOV_LEAST] = -DBL_MAX;
}

static scree_pair_constants constants(const scree_contact_space *space, const scree_config_material *a,
                                      const scree_config_material *b)
{
    (void)space;
    return scree_hertz_constants(a, b);
}

static scree_law_bounds bound(const scree_law_use *use, const scree_pair_constants *most, const scree_law_extent *e)
{
    double stiffness = most->value[HERTZ_NORMAL] * sqrt(e->radius * e->overlap);
    double damping = use->number[BRILLIANTOV_TIME] * stiffness * e->speed, normal = stiffness * e->overlap + damping;
    double slip = use->option & BRILLIANTOV_IMPLICIT ? FORESEEN * e->speed : e->speed;
    double mobilised =
        fmax(1.0, pow(slip / use->number[BRILLIANTOV_VELOCITY], use->number[BRILLIANTOV_INVERSE_EXPONENT]));
    double force = normal * (1 + most->value[SCREE_FRICTION] * mobilised);
    return (scree_law_bounds){
        .force = force, .damping = 2 * damping * e->speed * e->step, .friction = force * e->speed * e->step};
}

static scree_contact_tangent tangent(const scree_law_use *use, const scree_pair_constants *pair,
                                     double effective_radius, double effective_mass, double force)
{
    (void)effective_mass;
    double secant = pair->value[HERTZ_NORMAL] * sqrt(effective_radius) *
                    sqrt(scree_elastic_hertz.overlap(pair, effective_radius, force));
    return (scree_contact_tangent){.normal_stiffness = 1.5 * secant,
                                   .normal_damping = use->number[BRILLIANTOV_TIME] * secant};
}

static scree_status impact(const scree_law_use *use, const scree_pair_constants *pair, double effective_radius,
                           double effective_mass, double speed, scree_impact *impact_, scree_error *error)
{
    bool attraction = use->number[BRILLIANTOV_LEAST] < 0;
    return scree_impact_viscoelastic(speed, pair->value[HERTZ_NORMAL] * sqrt(effective_radius), effective_mass,
                                     use->number[BRILLIANTOV_TIME], attraction, impact_, error);
}

#define FORCE "tangential_force", "N", "tangential force of the last step on the first body; along t in 2D"
static const scree_field fields[] = {
    SCREE_REMEMBERS(hertz_brilliantov, history, 0, SCREE_AXIAL_VECTOR, FORCE, .in_checksum = true),
    SCREE_REMEMBERS(hertz_brilliantov, history, 1, 1, SCREE_NORMAL_DAMPING_FIELD, .only_dimension = 2),
    SCREE_REMEMBERS(hertz_brilliantov, history, 3, 1, SCREE_NORMAL_DAMPING_FIELD, .only_dimension = 3),
};

static const scree_law law = {
    .traits = hertz_brilliantov_traits,
    .option_count = sizeof hertz_brilliantov_traits / sizeof *hertz_brilliantov_traits,
    .elastic = &scree_elastic_hertz,
    .constant_count = HERTZ_TWISTING + 1,
    .resistances = 1U << SCREE_FRICTION,
    .needs_slip_scale = true,
    .options = options,
    .stage_options = stage_options,
    .resolve = resolve,
    .constants = constants,
    .bound = bound,
    .tangent = tangent,
    .impact = impact,
    .impact_duration = true,
    .confine_grains = 900,
};

const scree_module scree_module_hertz_brilliantov = {
    .name = "hertz_brilliantov",
    .meaning =
        "Hertz with the viscous damping of Brilliantov et al. (1996) and friction regularised by the slip speed; no "
        "history",
    .choice_of = CHOICE_OF(IS("contact.law"), IS("contact.pairs.law")),
    .keys = (const scree_keys[]){KEYS_OF("contact", keys, contact), KEYS_OF("contact.pairs", keys, contact),
                                 KEYS_OF("stages.confine", stage_keys, stage_config, .after = "friction"),
                                 KEYS_OF("stages.compress", stage_keys, stage_config, .after = "friction"),
                                 KEYS_OF("stages.deform", stage_keys, stage_config, .after = "friction")},
    .keys_count = 5,
    .rules = rules,
    .law = &law,
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .spreads = true,
};
