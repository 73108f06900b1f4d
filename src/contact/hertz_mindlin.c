/// Module of law hertz_mindlin (hertz_mindlin.h).
///
/// Damping is that of the smaller restitution of two materials (Tsuji et al. 1992; theory/restitution.h); caps of
/// rolling and twisting are the smaller ones, as of friction.
///
/// Tangent: k_t = 8 Gbar sqrt(R_eff d), c_n = c_t = damping sqrt(m_eff k), k = A sqrt(R_eff d) without the 1.5, A the
/// normal stiffness. Resistance to rolling adds too little to matter.
///
/// Bounds, for an overlap d and a relative velocity u: f_n <= k_n d + eta u, f <= f_n (1 + mu + mu_r + mu_tw), with k_n
/// = A sqrt(R d), eta = damping sqrt(m k_n). Energies of one contact and step: damping 2 (eta u) (u dt); friction f (u
/// dt) plus what a tangential spring may hold, S^2 / k_t with S <= mu f_n + eta u, and for rolling alike. A twisting
/// spring slides at an angle of 2 mu_tw k_n / k_t or so (its cap over its stiffness), so it holds no more than twice
/// that times mu_tw R_max f_n.
#include "contact/hertz_mindlin.h"

#include "case/check.h"
#include "module/key_rows.h"
#include "state/memory_fields.h"

static const scree_choice tangential_histories[] = {
    {"displacement", SCREE_TANGENTIAL_DISPLACEMENT,
     "the tangential displacement stays as it is; cycles of overlap and slip may deliver energy"},
    {"rescaled", SCREE_TANGENTIAL_RESCALED,
     "the tangential force stays as it is while the contact stiffens, the displacement while it softens (Thornton et "
     "al. 2013); no cycle delivers energy"},
    {0},
};

static const scree_choice rolling_resistances[] = {
    {"springs", SCREE_ROLLING_SPRINGS, "springs with sliders, of the stiffness of the tangential one"},
    {"constant", SCREE_ROLLING_CONSTANT,
     "a torque of constant size against the motion, however slow (Zhou et al. 1999); it holds nothing at rest"},
    {0},
};

typedef scree_mindlin_config contact;
static const scree_key contact_keys[] = {
    CHOICE(contact, tangential_history, tangential_histories, .standard = "displacement", .when = "law=hertz_mindlin",
           .meaning = "What a tangential spring keeps when its stiffness changes with the overlap."),
    CHOICE(contact, rolling_resistance, rolling_resistances, .standard = "springs", .when = "law=hertz_mindlin",
           .meaning = "How contacts resist rolling and twisting, where materials do."),
};

typedef scree_mindlin_material material;
static const scree_key material_keys[] = {
    NUMBER(material, restitution, "1", .standard = "0.2", ABOVE("0"), TO("1"), .when = "contact.law=hertz_mindlin",
           .meaning = "Coefficient of restitution of a normal impact; sets the damping."),
    NUMBER(material, rolling_friction, "1", .standard = "0", FROM("0"), TO("10"), .when = "contact.law=hertz_mindlin",
           .meaning = "Limit of the rolling resistance over the normal force; its torque is that times R_eff."),
    NUMBER(material, twisting_friction, "1", .standard = "0", FROM("0"), TO("10"), .when = "contact.law=hertz_mindlin",
           .meaning = "Limit of the torque about the normal over R_eff times the normal force; spheres only."),
};

static const material *own_material(const scree_config_material *section)
{
    return scree_config_own(&scree_module_hertz_mindlin, "materials", section->own);
}

/// Discs turn about one axis, which no contact twists.
static void rules(scree_reader *reader, const scree_config *config)
{
    for (int64_t i = 0; i < config->material_count && config->dimension == 2; i++) {
        if (!(own_material(&config->materials[i])->twisting_friction > 0)) continue;
        char path[SCREE_PATH_BYTES];
        (void)snprintf(path, sizeof path, "materials.%lld.twisting_friction", (long long)i);
        scree_rule_refuse(reader, path, "0", "discs do not twist: twisting_friction is for spheres");
    }
}

static const char *material_problem(const scree_config_material *section, const char **key)
{
    *key = "restitution";
    if (own_material(section)->restitution > 0) return NULL;
    return "hertz_mindlin reaches a restitution of zero only with infinite damping; give a value above 0, such as 0.05";
}

static unsigned options(const void *own, const scree_config_material *of)
{
    const contact *c = own;
    const material *m = own_material(of);
    bool rolls = m->rolling_friction > 0 || m->twisting_friction > 0;
    const unsigned how = c->rolling_resistance == SCREE_ROLLING_CONSTANT ? MINDLIN_CONSTANT : MINDLIN_ROLLING;
    return (c->tangential_history == SCREE_TANGENTIAL_RESCALED ? MINDLIN_RESCALED : 0) | (rolls ? how : 0);
}

static scree_pair_constants constants(const scree_contact_space *space, const scree_config_material *a,
                                      const scree_config_material *b)
{
    (void)space;
    scree_pair_constants pair = scree_hertz_constants(a, b);
    const material *one = own_material(a), *other = own_material(b ? b : a);
    pair.value[HERTZ_DAMPING] = scree_damping_from_restitution(fmin(one->restitution, other->restitution));
    pair.value[HERTZ_ROLLING] = fmin(one->rolling_friction, other->rolling_friction);
    pair.value[HERTZ_TWISTING] = fmin(one->twisting_friction, other->twisting_friction);
    return pair;
}

static scree_law_bounds bound(const scree_law_use *use, const scree_pair_constants *most, const scree_law_extent *e)
{
    (void)use;
    const double friction = most->value[SCREE_FRICTION], rolling = most->value[HERTZ_ROLLING],
                 twisting = most->value[HERTZ_TWISTING], ratio = most->value[HERTZ_RATIO];
    double stiffness = most->value[HERTZ_NORMAL] * sqrt(e->radius * e->overlap);
    double damping = most->value[HERTZ_DAMPING] * sqrt(e->mass * stiffness) * e->speed;
    double normal = stiffness * e->overlap + damping, force = normal * (1 + friction + rolling + twisting);
    // S^2 / k_t is largest at the largest overlap for its frictional part, and does not depend on it for the viscous
    // part: (eta u)^2 / k_n = damping^2 m u^2.
    double slide = (friction + rolling) * (normal + damping), work = force * e->speed * e->step;
    work += 2 * ratio * (slide * slide / stiffness + damping * damping / stiffness);
    work += 4 * ratio * twisting * twisting * e->radius * normal;
    work += force * e->speed * e->step;
    return (scree_law_bounds){.force = force, .damping = 2 * damping * e->speed * e->step, .friction = work};
}

static scree_contact_tangent tangent(const scree_law_use *use, const scree_pair_constants *pair,
                                     double effective_radius, double effective_mass, double force)
{
    (void)use;
    double root = sqrt(effective_radius), depth = sqrt(scree_elastic_hertz.overlap(pair, effective_radius, force));
    double secant = pair->value[HERTZ_NORMAL] * root * depth,
           damping = pair->value[HERTZ_DAMPING] * sqrt(effective_mass * secant);
    return (scree_contact_tangent){.normal_stiffness = 1.5 * secant,
                                   .normal_damping = damping,
                                   .tangential_stiffness = pair->value[HERTZ_TANGENTIAL] * root * depth,
                                   .tangential_damping = damping};
}

/// The restitution is exact, the duration that of an elastic impact.
static scree_status impact(const scree_law_use *use, const scree_pair_constants *pair, double effective_radius,
                           double effective_mass, double speed, scree_impact *impact_, scree_error *error)
{
    (void)use;
    scree_status status = scree_impact_viscoelastic(speed, pair->value[HERTZ_NORMAL] * sqrt(effective_radius),
                                                    effective_mass, 0, false, impact_, error);
    impact_->restitution = scree_restitution_from_damping(pair->value[HERTZ_DAMPING]);
    return status;
}

// ---- what a contact remembers --------------------------------------------------------------------------------------

#define ROLLS  .options = 1U << MINDLIN_ROLLING | 1U << (MINDLIN_ROLLING | MINDLIN_RESCALED)
#define TURNED .options = 1U << MINDLIN_CONSTANT | 1U << (MINDLIN_CONSTANT | MINDLIN_RESCALED)
static const scree_field fields[] = {
    SCREE_REMEMBERS(hertz_mindlin, history, 0, SCREE_AXIAL_VECTOR, SCREE_TANGENTIAL_DISPLACEMENT_FIELD,
                    .in_checksum = true),
    SCREE_REMEMBERS(hertz_mindlin, history, 1, 1, SCREE_TANGENTIAL_STIFFNESS_FIELD, .only_dimension = 2),
    SCREE_REMEMBERS(hertz_mindlin, history, 2, 1, SCREE_NORMAL_DAMPING_FIELD, .only_dimension = 2),
    SCREE_REMEMBERS(hertz_mindlin, history, 3, 1, SCREE_TANGENTIAL_DAMPING_FIELD, .only_dimension = 2),
    SCREE_REMEMBERS(hertz_mindlin, history, 3, 1, SCREE_TANGENTIAL_STIFFNESS_FIELD, .only_dimension = 3),
    SCREE_REMEMBERS(hertz_mindlin, last_force, 0, 1, SCREE_NORMAL_DAMPING_FIELD, .only_dimension = 3),
    SCREE_REMEMBERS(hertz_mindlin, last_force, 1, 3, SCREE_TANGENTIAL_DAMPING_FIELD, .only_dimension = 3),
    SCREE_REMEMBERS(hertz_mindlin, rolling, 0, SCREE_AXIAL_VECTOR, SCREE_ROLLED_FIELD, ROLLS, .in_checksum = true),
    SCREE_REMEMBERS(hertz_mindlin, rolling, 3, 1, SCREE_TWISTED_FIELD, ROLLS, .only_dimension = 3, .in_checksum = true),
    SCREE_REMEMBERS(hertz_mindlin, rolling_last, 0, SCREE_AXIAL_VECTOR, SCREE_ROLLING_DAMPING_FIELD, ROLLS),
    SCREE_REMEMBERS(hertz_mindlin, rolling_last, 3, 1, SCREE_TWISTING_DAMPING_FIELD, ROLLS, .only_dimension = 3),
    SCREE_REMEMBERS(hertz_mindlin, rolling, 0, SCREE_AXIAL_VECTOR, SCREE_ROLLING_FORCE_FIELD, TURNED),
    SCREE_REMEMBERS(hertz_mindlin, rolling, 3, 1, SCREE_TWISTING_TORQUE_FIELD, TURNED, .only_dimension = 3),
};

static const scree_law law = {
    .traits = hertz_mindlin_traits,
    .option_count = sizeof hertz_mindlin_traits / sizeof *hertz_mindlin_traits,
    .elastic = &scree_elastic_hertz,
    .constant_count = HERTZ_TWISTING + 1,
    .resistances = 1U << SCREE_FRICTION | 1U << HERTZ_ROLLING | 1U << HERTZ_TWISTING,
    .material_problem = material_problem,
    .options = options,
    .constants = constants,
    .bound = bound,
    .tangent = tangent,
    .impact = impact,
    .confine_grains = 700,
    .against_stiffening = "contact.tangential_history=rescaled",
};

const scree_module scree_module_hertz_mindlin = {
    .name = "hertz_mindlin",
    .meaning =
        "Hertz with the tangential spring of Mindlin (with history), Coulomb limit, damping from the restitution",
    .choice_of = CHOICE_OF(IS("contact.law"), IS("contact.pairs.law")),
    .keys = (const scree_keys[]){KEYS_OF("contact", contact_keys, contact, .after = "law"),
                                 KEYS_OF("contact.pairs", contact_keys, contact, .after = "law"),
                                 KEYS_OF("materials", material_keys, material)},
    .keys_count = 3,
    .rules = rules,
    .law = &law,
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .spreads = true,
};
