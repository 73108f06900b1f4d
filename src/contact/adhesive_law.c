/// Work of adhesion of two materials: 2 sqrt(gamma_1 gamma_2), of surface energies gamma (Berthelot's mean; of a
/// material and its like 2 gamma), or what `contact` or an element of contact.pairs says. Damping and caps of rolling
/// and twisting are the smaller ones of the two, as in hertz_mindlin.c.
///
/// Tangent: with the radius a under the force, k_n <= 1.5 N a (adhesion makes a larger, and df/dd smaller than that),
/// k_t = 8 Gbar a, eta = damping sqrt(m N a).
///
/// Bounds, for an overlap d and a relative velocity u: f lies between -F_c and the force of Hertz; a <= (sqrt(a_H) +
/// (B R)^(1/3))^2, since with b = sqrt(a): b^4 = R d + B R b. Load f_n + 2 F_c, force <= load (1 + mu + mu_r + mu_tw).
/// A tangential spring holds S^2 / k_t, S <= mu load + eta u: the part of Hertz grows with the overlap, that of F_c is
/// largest at the smallest radius, a_c (DMT: it is part of Hertz's), the viscous one does not depend on it. Damping:
/// 2 (eta u) (u dt) and what a contact loses that begins or ends: less than W = 3/4 N B^2 (B R)^(4/3), and F u dt.
#include "contact/adhesive_law.h"

static scree_adhesion contact_of(bool jkr, const scree_pair_constants *pair, double effective_radius)
{
    return (scree_adhesion){.jkr = jkr,
                            .stiffness = pair->value[HERTZ_NORMAL],
                            .root = pair->value[ADHESIVE_ROOT],
                            .radius = effective_radius};
}

scree_pair_constants scree_adhesive_constants(const scree_config_material *a, const scree_config_material *b,
                                              const scree_adhesive_material *one, const scree_adhesive_material *other)
{
    scree_pair_constants pair = scree_hertz_constants(a, b);
    if (!other) other = one;
    const double work = 2 * sqrt(one->surface_energy * other->surface_energy);
    pair.value[HERTZ_DAMPING] = scree_damping_from_restitution(fmin(one->restitution, other->restitution));
    pair.value[HERTZ_ROLLING] = fmin(one->rolling_friction, other->rolling_friction);
    pair.value[HERTZ_TWISTING] = fmin(one->twisting_friction, other->twisting_friction);
    pair.value[ADHESIVE_ROOT] = scree_adhesion_root(pair.value[HERTZ_NORMAL], work);
    return pair;
}

void scree_adhesive_amend(const void *own, scree_pair_constants *pair)
{
    const scree_adhesive_config *contact = own;
    if (contact && contact->work_of_adhesion > 0)
        pair->value[ADHESIVE_ROOT] = scree_adhesion_root(pair->value[HERTZ_NORMAL], contact->work_of_adhesion);
}

unsigned scree_adhesive_options(const scree_adhesive_config *own, const scree_adhesive_material *material)
{
    if (!(material->rolling_friction > 0 || material->twisting_friction > 0)) return 0;
    return own->rolling_resistance == SCREE_ROLLING_CONSTANT ? ADHESIVE_CONSTANT : ADHESIVE_ROLLING;
}

const char *scree_adhesive_problem(const scree_adhesive_material *material, const char **key)
{
    *key = "restitution";
    if (material->restitution > 0) return NULL;
    return "a restitution of zero is only reached with infinite damping; give a value above 0, such as 0.05";
}

scree_law_bounds scree_adhesive_bound(bool jkr, const scree_law_use *use, const scree_pair_constants *most,
                                      const scree_law_extent *e)
{
    (void)use;
    const double friction = most->value[SCREE_FRICTION], rolling = most->value[HERTZ_ROLLING],
                 twisting = most->value[HERTZ_TWISTING], ratio = most->value[HERTZ_RATIO];
    const scree_adhesion of = contact_of(jkr, most, e->radius);
    const double pull = scree_adhesion_pull_off(&of), first = cbrt(of.root * of.radius), way = e->speed * e->step;
    const double hertz = sqrt(e->radius * e->overlap), whole = (sqrt(hertz) + first) * (sqrt(hertz) + first);
    const double damping = most->value[HERTZ_DAMPING] * sqrt(e->mass * of.stiffness * whole) * e->speed;
    const double stiffness = of.stiffness * hertz, normal = stiffness * e->overlap + damping;
    const double load = normal + 2 * pull, force = load * (1 + friction + rolling + twisting);
    const double viscous = most->value[HERTZ_DAMPING] * most->value[HERTZ_DAMPING] * e->mass * e->speed * e->speed;
    double slide = (friction + rolling) * (normal + damping), least = first * first * cbrt(1.0 / 16);
    double work = 2 * force * way + 3 * ratio * (slide * slide / stiffness + viscous);
    work += 6 * ratio * twisting * twisting * e->radius * normal;
    if (jkr && pull > 0) {
        const double held = (friction + rolling) * 2 * pull, turned = twisting * 2 * pull * e->radius / least;
        work += 3 * ratio * (held * held + 4 * turned * turned) / (of.stiffness * least);
    }
    const double surface = 0.75 * of.stiffness * of.root * of.root * pow(first, 4);
    return (scree_law_bounds){
        .force = force, .damping = 2 * damping * way + surface + 2 * force * way, .friction = work};
}

scree_contact_tangent scree_adhesive_tangent(bool jkr, const scree_pair_constants *pair, double effective_radius,
                                             double effective_mass, double force)
{
    const scree_adhesion of = contact_of(jkr, pair, effective_radius);
    const double a = scree_adhesion_area_of_force(&of, force);
    const double damping = pair->value[HERTZ_DAMPING] * sqrt(effective_mass * of.stiffness * a);
    return (scree_contact_tangent){.normal_stiffness = 1.5 * of.stiffness * a,
                                   .normal_damping = damping,
                                   .tangential_stiffness = pair->value[HERTZ_TANGENTIAL] * a,
                                   .tangential_damping = damping};
}

scree_status scree_adhesive_impact(bool jkr, const scree_pair_constants *pair, double effective_radius,
                                   double effective_mass, double speed, scree_impact *impact, scree_error *error)
{
    const scree_adhesion of = contact_of(jkr, pair, effective_radius);
    return scree_impact_adhesive(&of, pair->value[HERTZ_DAMPING], effective_mass, speed, impact, error);
}

double scree_adhesive_tabor(const scree_pair_constants *pair, double effective_radius)
{
    const scree_adhesion of = contact_of(true, pair, effective_radius);
    return scree_adhesion_tabor(&of);
}

double scree_adhesive_neck(const scree_pair_constants *pair, double effective_radius)
{
    const scree_adhesion of = contact_of(true, pair, effective_radius);
    return scree_adhesion_neck(&of);
}

// ---- the elastic part ----------------------------------------------------------------------------------------------

static double force_of(bool jkr, const scree_pair_constants *pair, double radius, double overlap)
{
    const scree_adhesion of = contact_of(jkr, pair, radius);
    return scree_adhesion_force(&of, scree_adhesion_area_of_overlap(&of, overlap));
}

static double overlap_of(bool jkr, const scree_pair_constants *pair, double radius, double force)
{
    const scree_adhesion of = contact_of(jkr, pair, radius);
    return scree_adhesion_overlap(&of, scree_adhesion_area_of_force(&of, force));
}

static double energy_of(bool jkr, const scree_pair_constants *pair, double radius, double overlap)
{
    const scree_adhesion of = contact_of(jkr, pair, radius);
    return scree_adhesion_energy(&of, scree_adhesion_area_of_overlap(&of, overlap));
}

static double stiffness_of(bool jkr, const scree_pair_constants *pair, double radius, double force)
{
    const scree_adhesion of = contact_of(jkr, pair, radius);
    return scree_adhesion_stiffness(&of, scree_adhesion_area_of_force(&of, force));
}

static double impact_force_of(bool jkr, const scree_pair_constants *pair, double radius, double mass, double speed)
{
    const scree_adhesion of = contact_of(jkr, pair, radius);
    return scree_adhesion_force(&of, scree_adhesion_deepest(&of, mass, speed));
}

#define ELASTIC(name, jkr)                                                                                             \
    static double name##_force(const scree_pair_constants *pair, double radius, double overlap)                        \
    {                                                                                                                  \
        return force_of(jkr, pair, radius, overlap);                                                                   \
    }                                                                                                                  \
    static double name##_overlap(const scree_pair_constants *pair, double radius, double force)                        \
    {                                                                                                                  \
        return overlap_of(jkr, pair, radius, force);                                                                   \
    }                                                                                                                  \
    static double name##_energy(const scree_pair_constants *pair, double radius, double overlap)                       \
    {                                                                                                                  \
        return energy_of(jkr, pair, radius, overlap);                                                                  \
    }                                                                                                                  \
    static double name##_stiffness(const scree_pair_constants *pair, double radius, double pressure, double diameter,  \
                                   double depth)                                                                       \
    {                                                                                                                  \
        return stiffness_of(jkr, pair, radius, pressure * diameter * depth);                                           \
    }                                                                                                                  \
    static double name##_impact_force(const scree_pair_constants *pair, double radius, double mass, double speed)      \
    {                                                                                                                  \
        return impact_force_of(jkr, pair, radius, mass, speed);                                                        \
    }

/// Lengths of an impact are scaled by Hertz's.
static double impact_length(const scree_pair_constants *pair, double radius, double mass, double speed)
{
    return scree_elastic_hertz.impact_length(pair, radius, mass, speed);
}

#define ELASTIC_FUNCTIONS(name)                                                                                        \
    {                                                                                                                  \
        .force = name##_force, .overlap = name##_overlap, .energy = name##_energy, .stiffness = name##_stiffness,      \
        .impact_force = name##_impact_force, .impact_length = impact_length                                            \
    }

ELASTIC(jkr, true)
ELASTIC(dmt, false)

const scree_elastic scree_elastic_jkr = ELASTIC_FUNCTIONS(jkr);
const scree_elastic scree_elastic_dmt = ELASTIC_FUNCTIONS(dmt);
