/// Module of law linear (linear.h).
///
/// Two materials: each body is half of the spring, twice as stiff as the contact with its like, and the halves are in
/// series, k = 2 k_1 k_2 / (k_1 + k_2), for k_t as for k_n (and for E where k_n = E A / L). So k_n is M's stiffness of
/// the contact, and something rigid leaves the half of the grain, 2 k. Damping is that of the larger ratio, friction
/// the smaller one.
///
/// Impact of bodies that never attract each other, with z = c_n / (2 sqrt(m k)) = cos a, w = sqrt(k / m): the force is
/// proportional to exp(-z w t) sin(2 a - w t sin a) and vanishes at
///     t = 2 a / (w sin a),    e = exp(-2 a cot a)                    z > 1: a = arcosh z, sinh, coth
/// (Schwager and Poeschel 2007). This is the restitution of hertz_mindlin at damping = z sqrt 5 (theory/restitution.c).
/// Bodies that part at d = 0, pulled back before, would take pi / (w sin a) and keep exp(-pi cot a): z = -ln e /
/// sqrt(pi^2 + ln^2 e).
///
/// Tangent: k_n, k_t, c_n, c_t, whatever the force. Dashpots count: a mode of damping ratio z is stable up to
/// (2 / w) (sqrt(1 + z^2) - z) (model/critical_step.c), and modes of a packing have larger ratios than its pairs: by
/// sqrt 2 in a row, where a ratio of 5 makes the step 14 times shorter. M 2.19 leaves it out.
///
/// Held pairs: f_n <= k_n |d - d_0| + c_n u, f_t <= k_t |h| + c_t u, both lengths below one bound, broken or not; when
/// a broken one opens, friction takes what its tangential spring holds.
///
/// Bounds, for an overlap d and a relative velocity u: f_n <= k_n d + c_n u, f <= f_n (1 + mu). Energies of one contact
/// and step: damping 2 (c_n + c_t) u (u dt); friction f (u dt) plus what a tangential spring may hold, S^2 / k_t with
/// S <= mu f_n + c_t u; (c u)^2 / k does not depend on k.
#include "contact/linear.h"

#include "case/check.h"
#include "module/key_rows.h"
#include "state/memory_fields.h"

typedef scree_linear_material material;
#define WITH_LINEAR .when = "contact.law=linear"
static const scree_key material_keys[] = {
    NUMBER(material, restitution, "1", .standard = "0.2", ABOVE("0"), TO("1"),
           .when = "contact.law=linear&damping_ratio=auto",
           .meaning = "Coefficient of restitution of a normal impact; sets the damping."),
    NUMBER(material, normal_stiffness, "N/m", .standard = "auto", FROM("1e-9 N/m"), TO("1e18 N/m"), WITH_LINEAR,
           .meaning = "Normal stiffness k_n of a contact of two such grains; auto: E A / L, of discs `young_modulus` "
                      "times the thickness, of spheres pi times that times R_eff. Of all materials or of none."),
    NUMBER(material, tangential_stiffness, "N/m", .standard = "auto", FROM("0 N/m"), TO("1e18 N/m"), WITH_LINEAR,
           .meaning = "Tangential stiffness k_t of a contact of two such grains; auto: `stiffness_ratio` times k_n. "
                      "Only beside `normal_stiffness`."),
    NUMBER(material, stiffness_ratio, "1", .standard = "auto", FROM("0"), TO("100"), WITH_LINEAR,
           .meaning = "k_t over k_n, in place of `tangential_stiffness`; 0: no tangential force; auto: 1."),
    NUMBER(material, damping_ratio, "1", .standard = "auto", FROM("0"), TO("1000"), WITH_LINEAR,
           .meaning = "Normal dashpot over the critical damping of the pair; auto: that which gives `restitution`; "
                      "one of the two is given."),
    NUMBER(material, tangential_damping_ratio, "1", .standard = "auto", FROM("0"), TO("1000"), WITH_LINEAR,
           .meaning = "Tangential dashpot over the critical damping of the pair's tangential spring; auto: that of the "
                      "normal one."),
};

static const material *own_material(const scree_config_material *section)
{
    return scree_config_own(&scree_module_linear, "materials", section->own);
}

/// Whether springs between two materials are of this law, of which one follows the radii and the other does not: such
/// springs have no series for all radii.
static bool are_unlike(const scree_config *config, const scree_config_material *one, const scree_config_material *other)
{
    if (!one->name || !other->name) return false;
    const int number = scree_config_law_between(&config->contact, one->name, other->name);
    return scree_config_law(&config->contact, number) == SCREE_SLOT_linear &&
           isnan(own_material(one)->normal_stiffness) != isnan(own_material(other)->normal_stiffness);
}

static void rules(scree_reader *reader, const scree_config *config)
{
    bool refused[SCREE_MAX_MATERIALS] = {false};
    for (int64_t i = 0; i < config->material_count; i++) {
        const scree_config_material *of = &config->materials[i];
        const material *m = own_material(of);
        char path[SCREE_PATH_BYTES];
        (void)snprintf(path, sizeof path, "materials.%lld.normal_stiffness", (long long)i);
        for (int64_t k = 0; k < i && !refused[i]; k++)
            refused[i] = !refused[k] && are_unlike(config, of, &config->materials[k]);
        if (refused[i])
            scree_rule_refuse(reader, path, isnan(m->normal_stiffness) ? "a stiffness" : "auto",
                              "normal_stiffness is given for all materials or for none");
        (void)snprintf(path, sizeof path, "materials.%lld.tangential_stiffness", (long long)i);
        if (isnan(m->normal_stiffness) && !isnan(m->tangential_stiffness))
            scree_rule_refuse(reader, path, "auto",
                              "without normal_stiffness both stiffnesses follow young_modulus and stiffness_ratio");
        (void)snprintf(path, sizeof path, "materials.%lld.stiffness_ratio", (long long)i);
        if (!isnan(m->stiffness_ratio) && !isnan(m->tangential_stiffness))
            scree_rule_refuse(reader, path, "auto", "the tangential stiffness is given: give one of the two");
    }
}

static const char *material_problem(const scree_config_material *section, const char **key)
{
    const material *m = own_material(section);
    *key = "restitution";
    if (!isnan(m->damping_ratio) || m->restitution > 0) return NULL;
    return "linear reaches a restitution of zero only with infinite damping; give a value above 0, such as 0.05, or "
           "a damping_ratio";
}

static unsigned options(const void *own, const scree_config_material *of)
{
    (void)own;
    (void)of;
    return 0;
}

/// Halves of springs, each of twice these stiffnesses, in series; symmetric, and exact for two alike.
static double in_series(double a, double b)
{
    double soft = fmin(a, b), hard = fmax(a, b);
    return soft > 0 ? soft * (2 * hard / (soft + hard)) : 0;
}

/// What a material puts into a spring: k_n and k_t on its like [N/m], or E and ratio E [Pa].
static void put_in(const scree_config_material *of, double *normal, double *tangential)
{
    const material *m = own_material(of);
    *normal = isnan(m->normal_stiffness) ? of->young_modulus : m->normal_stiffness;
    const double ratio = isnan(m->stiffness_ratio) ? 1 : m->stiffness_ratio;
    *tangential = isnan(m->tangential_stiffness) ? ratio * *normal : m->tangential_stiffness;
}

/// E of k_n = E A / L: that of `constants`, the other way round.
static double modulus(const scree_contact_space *space, const scree_config_material *of, double radius)
{
    return own_material(of)->normal_stiffness / (space->dimension == 3 ? M_PI * 0.5 * radius : space->thickness);
}

static double damping_of(const material *m)
{
    return isnan(m->damping_ratio) ? scree_damping_from_restitution(m->restitution) / sqrt(5.0) : m->damping_ratio;
}

static double tangential_damping_of(const material *m)
{
    return isnan(m->tangential_damping_ratio) ? damping_of(m) : m->tangential_damping_ratio;
}

static scree_pair_constants constants(const scree_contact_space *space, const scree_config_material *a,
                                      const scree_config_material *b)
{
    const material *one = own_material(a), *other = own_material(b ? b : a);
    double normal, tangential, normal_b, tangential_b;
    put_in(a, &normal, &tangential);
    put_in(b ? b : a, &normal_b, &tangential_b);
    normal = b ? in_series(normal, normal_b) : 2 * normal;
    tangential = b ? in_series(tangential, tangential_b) : 2 * tangential;
    const double ratio = tangential / normal;
    const bool modulus = isnan(one->normal_stiffness), solid = space->dimension == 3;
    return (scree_pair_constants){{
        [LINEAR_NORMAL] = !modulus ? normal
                          : solid  ? 0
                                   : normal * space->thickness,
        [LINEAR_RATIO] = ratio,
        [SCREE_FRICTION] = b ? fmin(a->friction, b->friction) : a->friction,
        [LINEAR_DAMPING] = 2 * fmax(damping_of(one), damping_of(other)),
        [LINEAR_BY_RADIUS] = modulus && solid ? M_PI * normal : 0,
        [LINEAR_TANGENTIAL_DAMPING] = 2 * sqrt(ratio) * fmax(tangential_damping_of(one), tangential_damping_of(other)),
        [LINEAR_INVERSE_RATIO] = ratio > 0 ? 1 / ratio : 0,
    }};
}

// ---- what a contact remembers --------------------------------------------------------------------------------------

static const scree_field fields[] = {
    SCREE_REMEMBERS(linear, history, 0, SCREE_AXIAL_VECTOR, SCREE_TANGENTIAL_DISPLACEMENT_FIELD, .in_checksum = true),
    SCREE_REMEMBERS(linear, history, 1, 1, SCREE_NORMAL_DAMPING_FIELD, .only_dimension = 2),
    SCREE_REMEMBERS(linear, history, 2, 1, SCREE_TANGENTIAL_DAMPING_FIELD, .only_dimension = 2),
    SCREE_REMEMBERS(linear, history, 3, 1, SCREE_NORMAL_DAMPING_FIELD, .only_dimension = 3),
    SCREE_REMEMBERS(linear, last_force, 0, 3, SCREE_TANGENTIAL_DAMPING_FIELD, .only_dimension = 3),
    SCREE_HELD_REMEMBERS(linear, constant, SCREE_MEMBER_REST, 1, SCREE_REST_FIELD, .in_checksum = true),
    SCREE_HELD_REMEMBERS(linear, constant, SCREE_MEMBER_TENSION, 1, SCREE_TENSILE_STRENGTH_FIELD, .in_checksum = true,
                         SCREE_RANGE(-INFINITY, INFINITY)),
    SCREE_HELD_REMEMBERS(linear, constant, SCREE_MEMBER_SHEAR, 1, SCREE_SHEAR_STRENGTH_FIELD, .in_checksum = true,
                         SCREE_RANGE(-INFINITY, INFINITY)),
    SCREE_HELD_REMEMBERS(linear, constant, SCREE_MEMBER_SLOPE, 1, SCREE_STRENGTH_SLOPE_FIELD, .in_checksum = true),
    SCREE_HELD_REMEMBERS(linear, history, 0, SCREE_AXIAL_VECTOR, SCREE_TANGENTIAL_DISPLACEMENT_FIELD,
                         .in_checksum = true),
    SCREE_HELD_REMEMBERS(linear, history, 1, 1, SCREE_NORMAL_DAMPING_FIELD, .only_dimension = 2),
    SCREE_HELD_REMEMBERS(linear, history, 2, 1, SCREE_TANGENTIAL_DAMPING_FIELD, .only_dimension = 2),
    SCREE_HELD_REMEMBERS(linear, history, 3, 1, SCREE_NORMAL_DAMPING_FIELD, .only_dimension = 3),
    SCREE_HELD_REMEMBERS(linear, last_force, 0, 3, SCREE_TANGENTIAL_DAMPING_FIELD, .only_dimension = 3),
};

// ---- closed forms --------------------------------------------------------------------------------------------------

static double stiffness_of(const scree_pair_constants *pair, double effective_radius)
{
    return pair->value[LINEAR_NORMAL] + pair->value[LINEAR_BY_RADIUS] * effective_radius;
}

static double force(const scree_pair_constants *pair, double effective_radius, double overlap)
{
    return stiffness_of(pair, effective_radius) * overlap;
}

static double overlap(const scree_pair_constants *pair, double effective_radius, double force)
{
    return force / stiffness_of(pair, effective_radius);
}

static double energy(const scree_pair_constants *pair, double effective_radius, double overlap)
{
    return 0.5 * stiffness_of(pair, effective_radius) * overlap * overlap;
}

static double stiffness(const scree_pair_constants *pair, double effective_radius, double pressure, double diameter,
                        double depth)
{
    (void)pressure;
    (void)diameter;
    (void)depth;
    return stiffness_of(pair, effective_radius);
}

static double impact_force(const scree_pair_constants *pair, double effective_radius, double effective_mass,
                           double speed)
{
    return speed * sqrt(effective_mass * stiffness_of(pair, effective_radius));
}

static double impact_length(const scree_pair_constants *pair, double effective_radius, double effective_mass,
                            double speed)
{
    return speed * sqrt(effective_mass / stiffness_of(pair, effective_radius));
}

/// Of a pair that is held: `overlap` bounds the tangential displacement, too.
static scree_law_bounds bound_held(const scree_pair_constants *most, const scree_law_extent *e)
{
    const double ratio = most->value[LINEAR_RATIO];
    double whole = stiffness_of(most, e->radius), root = sqrt(e->mass * whole);
    double viscous = (most->value[LINEAR_DAMPING] + most->value[LINEAR_TANGENTIAL_DAMPING]) * root * e->speed;
    double force = whole * (1 + ratio) * e->overlap + viscous, way = e->speed * e->step;
    return (scree_law_bounds){.force = force, .damping = 2 * viscous * way, .friction = 2 * force * (way + e->overlap)};
}

static scree_law_bounds bound(const scree_law_use *use, const scree_pair_constants *most, const scree_law_extent *e)
{
    if (use->option & LINEAR_HELD) return bound_held(most, e);
    const double friction = most->value[SCREE_FRICTION];
    double whole = stiffness_of(most, e->radius), root = sqrt(e->mass * whole);
    double damping = most->value[LINEAR_DAMPING] * root * e->speed,
           viscous = most->value[LINEAR_TANGENTIAL_DAMPING] * root * e->speed;
    double normal = whole * e->overlap + damping, limit = normal * (1 + friction), way = e->speed * e->step;
    double stretched = friction * normal + viscous;
    double held = most->value[LINEAR_INVERSE_RATIO] * stretched * stretched / whole;
    return (scree_law_bounds){
        .force = limit, .damping = 2 * (damping + viscous) * way, .friction = 2 * (limit * way + held)};
}

static scree_contact_tangent tangent(const scree_law_use *use, const scree_pair_constants *pair,
                                     double effective_radius, double effective_mass, double static_force)
{
    (void)use;
    (void)static_force;
    double normal = stiffness_of(pair, effective_radius), root = sqrt(effective_mass * normal);
    return (scree_contact_tangent){.normal_stiffness = normal,
                                   .normal_damping = pair->value[LINEAR_DAMPING] * root,
                                   .tangential_stiffness = pair->value[LINEAR_RATIO] * normal,
                                   .tangential_damping = pair->value[LINEAR_TANGENTIAL_DAMPING] * root};
}

/// a / sin a, or a / sinh a.
static double angle_over_sine(double ratio)
{
    double angle = ratio < 1 ? acos(ratio) : acosh(ratio);
    return angle > 0 ? angle / (ratio < 1 ? sin(angle) : sinh(angle)) : 1;
}

static scree_status impact(const scree_law_use *use, const scree_pair_constants *pair, double effective_radius,
                           double effective_mass, double speed, scree_impact *impact_, scree_error *error)
{
    (void)use;
    (void)speed;
    (void)error;
    double ratio = 0.5 * pair->value[LINEAR_DAMPING];
    impact_->restitution = scree_restitution_from_damping(ratio * sqrt(5.0));
    impact_->duration = 2 * angle_over_sine(ratio) * sqrt(effective_mass / stiffness_of(pair, effective_radius));
    return SCREE_OK;
}

static const scree_elastic elastic = {
    .force = force,
    .overlap = overlap,
    .energy = energy,
    .stiffness = stiffness,
    .impact_force = impact_force,
    .impact_length = impact_length,
};

static const scree_law law = {
    .traits = linear_traits,
    .option_count = sizeof linear_traits / sizeof *linear_traits,
    .holding = LINEAR_HELD,
    .deforming = LINEAR_DEFORMS,
    .elastic = &elastic,
    .constant_count = LINEAR_TANGENTIAL_DAMPING + 1,
    .resistances = 1U << SCREE_FRICTION,
    .material_problem = material_problem,
    .options = options,
    .constants = constants,
    .modulus = modulus,
    .modulus_key = "normal_stiffness",
    .bound = bound,
    .tangent = tangent,
    .impact = impact,
    .impact_duration = true,
    .confine_falls = 20,
};

const scree_module scree_module_linear = {
    .name = "linear",
    .meaning = "springs of constant stiffness with dashpots along the normal and in the tangent plane, Coulomb limit",
    .choice_of = CHOICE_OF(IS("contact.law"), IS("contact.pairs.law")),
    .keys = (const scree_keys[]){KEYS_OF("materials", material_keys, material)},
    .keys_count = 1,
    .rules = rules,
    .law = &law,
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .spreads = true,
};
