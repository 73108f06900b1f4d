/// What the modules of the laws of polygons share.
///
/// Closed forms are those of two edges that meet along a chord c: f_e = E (c / l) h at the depth h. c / l depends on
/// the grains; of two equal hexagons that meet along their edges it is 2.2. Estimates of steps and durations take
/// SPREAD for it: what meets at corners is softer. With z = gamma sqrt(c / l) / 2 an impact of edges is that of law
/// linear.
///
/// Bounds. Depths A / l grow faster than bodies approach by c / l, and beside a wall or a small body both lengths may
/// be small: SAFE covers c / l and (l c / l_0^2) for radii of 1 : 3 and points as near to a centre as a guard allows; a
/// force above it would be noticed (the range of the sums), and cost nothing but six bits below the rounding of
/// doubles. Energies have no such factor, which would enter them squared: increments below half a quantum are lost,
/// always in one direction, and added up to 1e-5 of the turnover of a pour. One above the bound is cut (evaluate.h),
/// which the residual would show; those of a pour stay below a hundredth of it.
#include "contact/polygon_module.h"
#include "theory/restitution.h"

static const double SPREAD = 2.5, SAFE = 64;

typedef scree_polygon_material material;

unsigned scree_polygon_options(const void *own, const scree_config_material *of)
{
    (void)own;
    (void)of;
    return 0;
}

/// Halves of springs in series, as of law linear; something rigid leaves the half of the grain.
static double in_series(double a, double b)
{
    return a > 0 && b > 0 ? 2 * a * b / (a + b) : 0;
}

scree_pair_constants scree_polygon_constants(const scree_module *law, const scree_contact_space *space,
                                             const scree_config_material *a, const scree_config_material *b)
{
    const material *one = scree_config_own(law, "materials", a->own),
                   *other = scree_config_own(law, "materials", b ? b->own : a->own);
    const double first = a->young_modulus * space->thickness, second = b ? b->young_modulus * space->thickness : 0;
    const double stiffness = b ? in_series(first, second) : 2 * first;
    const double tangential = b ? in_series(one->tangential_share * first, other->tangential_share * second)
                                : 2 * one->tangential_share * first;
    return (scree_pair_constants){{
        [POLYGON_STIFFNESS] = stiffness,
        [POLYGON_TANGENTIAL] = tangential,
        [SCREE_FRICTION] = b ? fmin(a->friction, b->friction) : a->friction,
        [POLYGON_DAMPING] = fmax(one->damping_constant, other->damping_constant),
        [POLYGON_VISCOSITY] = fmax(one->tangential_viscosity, other->tangential_viscosity),
    }};
}

// ---- closed forms: two edges ---------------------------------------------------------------------------------------

static double force(const scree_pair_constants *pair, double effective_radius, double overlap)
{
    (void)effective_radius;
    return SPREAD * pair->value[POLYGON_STIFFNESS] * overlap;
}

static double overlap(const scree_pair_constants *pair, double effective_radius, double load)
{
    (void)effective_radius;
    return load / (SPREAD * pair->value[POLYGON_STIFFNESS]);
}

static double energy(const scree_pair_constants *pair, double effective_radius, double depth)
{
    return 0.5 * force(pair, effective_radius, depth) * depth;
}

static double stiffness(const scree_pair_constants *pair, double effective_radius, double pressure, double diameter,
                        double depth)
{
    (void)effective_radius, (void)pressure, (void)diameter, (void)depth;
    return SPREAD * pair->value[POLYGON_STIFFNESS];
}

static double impact_force(const scree_pair_constants *pair, double effective_radius, double effective_mass,
                           double speed)
{
    return speed * sqrt(effective_mass * stiffness(pair, effective_radius, 0, 0, 0));
}

static double impact_length(const scree_pair_constants *pair, double effective_radius, double effective_mass,
                            double speed)
{
    return speed * sqrt(effective_mass / stiffness(pair, effective_radius, 0, 0, 0));
}

const scree_elastic scree_polygon_elastic = {
    .force = force,
    .overlap = overlap,
    .energy = energy,
    .stiffness = stiffness,
    .impact_force = impact_force,
    .impact_length = impact_length,
};

scree_law_bounds scree_polygon_bound(const scree_law_use *use, const scree_pair_constants *most,
                                     const scree_law_extent *e)
{
    (void)use;
    const double stiff = most->value[POLYGON_STIFFNESS], along = most->value[POLYGON_TANGENTIAL];
    const double damping = most->value[POLYGON_DAMPING] * sqrt(stiff * e->mass) * e->speed;
    const double viscous = most->value[POLYGON_VISCOSITY] * sqrt(along * e->mass) * e->speed;
    const double elastic = stiff * e->overlap, way = e->speed * e->step;
    const double limit = (elastic + damping) * (1 + most->value[SCREE_FRICTION]);
    const double stored = elastic * e->overlap + (along > 0 ? (limit + viscous) * (limit + viscous) / along : 0);
    return (scree_law_bounds){
        .force = SAFE * limit, .damping = 2 * (damping + viscous) * way, .friction = 2 * (limit * way + stored)};
}

scree_contact_tangent scree_polygon_tangent(const scree_law_use *use, const scree_pair_constants *pair,
                                            double effective_radius, double effective_mass, double static_force)
{
    (void)use, (void)effective_radius, (void)static_force;
    const double stiff = pair->value[POLYGON_STIFFNESS], along = pair->value[POLYGON_TANGENTIAL];
    return (scree_contact_tangent){.normal_stiffness = SPREAD * stiff,
                                   .normal_damping =
                                       SPREAD * pair->value[POLYGON_DAMPING] * sqrt(stiff * effective_mass),
                                   .tangential_stiffness = along,
                                   .tangential_damping = pair->value[POLYGON_VISCOSITY] * sqrt(along * effective_mass)};
}

scree_status scree_polygon_impact(const scree_law_use *use, const scree_pair_constants *pair, double effective_radius,
                                  double effective_mass, double speed, scree_impact *impact, scree_error *error)
{
    (void)use, (void)speed, (void)error;
    const double ratio = 0.5 * pair->value[POLYGON_DAMPING] * sqrt(SPREAD);
    impact->restitution = scree_restitution_from_damping(ratio * sqrt(5.0));
    impact->duration = M_PI * sqrt(effective_mass / stiffness(pair, effective_radius, 0, 0, 0));
    return SCREE_OK;
}

// ---- what it tells -------------------------------------------------------------------------------------------------

scree_status scree_polygon_told(const scree_context *c, size_t index, double *value, scree_error *error)
{
    const scree_ledger *ledger = &c->state->ledger;
    const double lost = ledger->damping + ledger->friction - ledger->stiffness;
    (void)index, (void)error;
    value[0] = -ledger->stiffness;
    value[1] = lost > 0 ? -ledger->stiffness / lost : 0;
    return SCREE_OK;
}
