/// Descriptor of law hertz_brilliantov (hertz_brilliantov.h).
///
/// Tangent: c_n = T A sqrt(R_eff d), A the normal stiffness; no tangential spring. The friction, mu f (s/v_R)^(1/c), is
/// bounded and cannot make a run unstable. But slip slower than s = 3 mu f dt/m (equal discs) is not resolved: it turns
/// its sign every step with about that size, which is of the order of v_R at P's large step of 1e-5 s (P figure 2.4,
/// scheme I).
///
/// Bounds, for an overlap d and a relative velocity u: f_n <= k_n d + T k_n u with k_n = A sqrt(R d), f <= f_n (1 + mu
/// max(1, (u / v_R)^(1/c))); energies of one contact and step: damping 2 (T k_n u) (u dt), friction f (u dt).
#include "contact/hertz_brilliantov.h"

/// The slip that an implicit friction sees holds what one step may change: so many times the largest now.
static const double FORESEEN = 64;

static unsigned options(const scree_config_contact *contact, const scree_config_material *material)
{
    (void)material;
    return contact->friction_update == SCREE_FRICTION_IMPLICIT ? BRILLIANTOV_IMPLICIT : 0;
}

static void resolve(const scree_config_contact *contact, double reference_velocity, scree_law_use *use)
{
    double inverse_exponent = 1 / contact->friction_exponent;
    use->number[BRILLIANTOV_TIME] = contact->damping_time;
    use->number[BRILLIANTOV_INVERSE_EXPONENT] = inverse_exponent;
    use->number[BRILLIANTOV_BINARY_EXPONENT] = inverse_exponent * M_LOG2E;
    use->number[BRILLIANTOV_EXPONENT] = 1.0 / inverse_exponent;
    use->number[BRILLIANTOV_VELOCITY] = reference_velocity;
    use->number[BRILLIANTOV_INVERSE_VELOCITY] = 1.0 / reference_velocity;
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
    return scree_impact_viscoelastic(speed, pair->value[HERTZ_NORMAL] * sqrt(effective_radius), effective_mass,
                                     use->number[BRILLIANTOV_TIME], impact_, error);
}

const scree_law scree_law_hertz_brilliantov = {
    .name = "hertz_brilliantov",
    .traits = hertz_brilliantov_traits,
    .elastic = &scree_elastic_hertz,
    .constant_count = HERTZ_TWISTING + 1,
    .resistances = 1U << SCREE_FRICTION,
    .needs_slip_scale = true,
    .options = options,
    .resolve = resolve,
    .constants = scree_hertz_constants,
    .bound = bound,
    .tangent = tangent,
    .impact = impact,
    .impact_duration = true,
    .confine_grains = 900,
};
