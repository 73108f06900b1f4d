/// Contacts of two materials (Hertz 1882, Mindlin 1949; unlike bodies as in Johnson 1985, eqs. 4.3-4.6 and 7.40):
///     1/Ebar = (1 - nu1^2)/E1 + (1 - nu2^2)/E2,     normal stiffness      (4/3) Ebar
///     1/Gbar = (2 - nu1)/G1 + (2 - nu2)/G2,         tangential stiffness  8 Gbar,      G = E / (2 (1 + nu))
/// A rigid wall has no compliance. The weaker rules where materials have no theory of the pair: the smaller friction.
/// With K = normal stiffness sqrt(R_eff): f = K d^1.5, energy (2/5) K d^2.5, and an impact ends its approach where that
/// energy is m v^2 / 2.
#include "contact/hertz.h"

/// Over (4/3) and 8 the inverse of a body's share of the two stiffnesses; none of a rigid one (NULL).
static double compliance_of(const scree_config_material *m)
{
    return m ? (1 - m->poisson_ratio * m->poisson_ratio) / m->young_modulus : 0;
}

static double shear_compliance_of(const scree_config_material *m)
{
    return m ? (2 - m->poisson_ratio) * 2 * (1 + m->poisson_ratio) / m->young_modulus : 0;
}

scree_pair_constants scree_hertz_constants(const scree_config_material *a, const scree_config_material *b)
{
    double compliance = compliance_of(a) + compliance_of(b);
    double shear_compliance = shear_compliance_of(a) + shear_compliance_of(b);
    double normal = 4.0 / 3.0 / compliance, tangential = 8 / shear_compliance;
    return (scree_pair_constants){{
        [HERTZ_NORMAL] = normal,
        [HERTZ_TANGENTIAL] = tangential,
        [SCREE_FRICTION] = b ? fmin(a->friction, b->friction) : a->friction,
        [HERTZ_RATIO] = normal / tangential,
    }};
}

/// K [N/m^1.5].
static double stiffness_of(const scree_pair_constants *pair, double effective_radius)
{
    return pair->value[HERTZ_NORMAL] * sqrt(effective_radius);
}

static double overlap(const scree_pair_constants *pair, double effective_radius, double force)
{
    double root = cbrt(force / stiffness_of(pair, effective_radius));
    return root * root;
}

static double force(const scree_pair_constants *pair, double effective_radius, double overlap)
{
    return stiffness_of(pair, effective_radius) * pow(overlap, 1.5);
}

static double energy(const scree_pair_constants *pair, double effective_radius, double overlap)
{
    return 0.4 * stiffness_of(pair, effective_radius) * pow(overlap, 2.5);
}

static double stiffness(const scree_pair_constants *pair, double effective_radius, double pressure, double diameter,
                        double depth)
{
    double k = stiffness_of(pair, effective_radius);
    return 1.5 * cbrt(k * k * pressure * diameter * depth);
}

static double impact_force(const scree_pair_constants *pair, double effective_radius, double effective_mass,
                           double speed)
{
    double k = stiffness_of(pair, effective_radius);
    return k * pow(1.25 * effective_mass * speed * speed / k, 0.6);
}

static double impact_length(const scree_pair_constants *pair, double effective_radius, double effective_mass,
                            double speed)
{
    return pow(effective_mass * speed * speed / stiffness_of(pair, effective_radius), 0.4);
}

const scree_elastic scree_elastic_hertz = {
    .force = force,
    .overlap = overlap,
    .energy = energy,
    .stiffness = stiffness,
    .impact_force = impact_force,
    .impact_length = impact_length,
};
