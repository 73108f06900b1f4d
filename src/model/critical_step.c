/// Critical time step of the explicit schemes, from what a case says before there is a packing.
///
/// Scheme. Both Verlet schemes evaluate forces at x(n+1) with v(n+1/2). For small motions M a + C v + K x = 0 this is
///     (M - dt/2 C) (x+ - 2x + x-)/dt^2 + C (x+ - x-)/(2 dt) + K x = 0,
/// a central difference with the mass M - dt/2 C, stable exactly as long as M - dt/2 C - dt^2/4 K is positive definite.
/// For one oscillator that is dt = (2/omega) (sqrt(1 + z^2) - z), z its damping ratio; without damping 2/omega
/// (M 2.15). Another scheme says its own limit for one oscillator (module/integrator.h).
///
/// Assembly. The reference is the hexagonal lattice of the smallest discs (mass m, inertia m R^2/2), every contact at
/// the force of a strong one. Its fastest modes are known: all discs turning alike, so that every contact slides, and
/// rows moving against each other (the corner M of the Brillouin zone):
///     K: max(24 k_t, 6 k_n + 2 k_t) / m,     and the same for C.
/// In space it is the face-centred cubic lattice of the smallest spheres (2 m R^2 / 5): all turning alike, slip 2 R w x
/// n at twelve contacts, and the layers (100) moving against each other along their normal (the corner X):
///     K: max(40 k_t, 8 k_n + 8 k_t) / m.
/// Resistance to rolling adds nothing to the first, and too little to matter elsewhere.
/// M 2.16-2.19 has the second of 2D alone, without damping and tangential spring, with its user's alpha for the
/// coordination. Nothing that occurs in a real packing is faster: no disc has more than six neighbours of its own size;
/// larger neighbours are fewer and heavier (R^2) while their contacts are stiffer only by R_eff^(1/3), a plate's by
/// 2^(1/3), a rigid one's, of twice the modulus, by 2: as much as a neighbour that moves the other way, since the plate
/// does not move. On a drop-and-roll packing with all contacts equally stiff the true critical step is 1.3 to 2.2 times
/// this one (tests/unit/test_model.c assembles both).
///
/// Force. f_s = STRONG times the mean f0 = p 2<R> thickness, in space p (2<R>)^2. Forces of a static packing fall off
/// exponentially above the mean; the strongest of 10^4 contacts carries about six times it, the contacts of one disc
/// together less. Hertz stiffness goes as f^(1/3): a factor of two in f_s is 12 % in the step, 26 % in strong damping.
/// Measured on 300 discs of 1:2, compressed to 100 kPa between four plates: the limit of the linearised sample
/// (eigenvalue with the stiffness of each of its contacts) is 2.1 times the estimate for hertz_mindlin at restitution
/// 0.2, 1.8 times at 0.9, 2.4 times for hertz_brilliantov at P's parameters (these two rescaled from a run with STRONG
/// = 6). Past the limit of its linearised sample hertz_mindlin at 0.2 still ran at twice of it, at 0.9 it did not, nor
/// hertz_brilliantov at 1.4 times. Not measured under shear, whose higher forces, two- to threefold, would scale to
/// another 10 to 30 %.
///
/// The tangents at a force are those of the law (its descriptor's file): elastic ones, and the dashpots that act while
/// bodies touch. What a law limits, such as friction, cannot make a run unstable and does not count.
///
/// Loads: the largest confining pressure; gravity as the weight of a column of the whole sample; velocities of a gas
/// and falls through its box as the force of an elastic impact of two smallest discs at six times the root-mean-square
/// velocity component; listed bodies as that of an impact at their largest relative velocity, with the fall from the
/// highest; what is poured as that of an impact at the speed of its fall (pour_speed). None of them counts above the
/// force at the overlap where the guard would stop the run; a case without any load gets that force.
///
/// Several materials: the least over all pairs of them. Contacts of two materials stand between the smallest bodies of
/// each, and all bodies of the lattice have the smaller of the two masses: lighter than they are, so that the step is
/// too small rather than too large. In a mixture the row of a body in M^-1 K has contacts of several pairs; the
/// stiffest of them all around bound it (Gershgorin). The weight is that of the denser one.
///
/// Limits: an estimate. Stresses far above the confining pressure and collapses at high speed are not seen; the guard
/// on the energy ledger is.
#include "model/critical_step.h"

#include "case/wall_motion.h"
#include "module/geometry.h"
#include "module/integrator.h"

#include "base/vectors.h"

#include <math.h>
#include <stdio.h>

static const double STRONG = 3;
static const double FAST = 6; // in root-mean-square velocity components

double scree_expected_solid_fraction(const scree_model *model)
{
    return model->dimension == 3 ? 0.64 : 0.8;
}

scree_contact_tangent scree_contact_linearise(const scree_law_use *law, const scree_pair_constants *pair,
                                              double effective_radius, double effective_mass, double force)
{
    return scree_law_get(law->law)->tangent(law, pair, effective_radius, effective_mass, force);
}

/// Step at which one mode of given stiffness and damping, both per mass, becomes unstable.
static double critical_step_of_mode(double stiffness, double damping, double (*limit)(double ratio))
{
    if (!(stiffness > 0)) return INFINITY;
    double frequency = sqrt(stiffness), ratio = damping / (2 * frequency);
    if (limit) return limit(ratio) / frequency;
    // sqrt(1 + z^2) - z without cancellation.
    return 2 / frequency / (sqrt(1 + ratio * ratio) + ratio);
}

double scree_critical_step_lattice(int dimension, const scree_contact_tangent *t, double mass,
                                   double (*limit)(double ratio))
{
    const double turn = dimension == 3 ? 40 : 24, normal = dimension == 3 ? 8 : 6, across = dimension == 3 ? 8 : 2;
    double turning =
        critical_step_of_mode(turn * t->tangential_stiffness / mass, turn * t->tangential_damping / mass, limit);
    double shifting =
        critical_step_of_mode((normal * t->normal_stiffness + across * t->tangential_stiffness) / mass,
                              (normal * t->normal_damping + across * t->tangential_damping) / mass, limit);
    return fmin(turning, shifting);
}

double scree_expected_height(const scree_model *model, double phi)
{
    const scree_config *config = model->config;
    const scree_config_stage *stage = scree_config_prepare(config);
    const scree_preparation *method = scree_config_preparation(config);
    double radius = scree_model_filling_radius(model);
    if (method && method->height) return method->height(model, stage);
    const scree_prepare_config *prepare = stage ? scree_config_prepared(stage) : NULL;
    bool box = prepare && prepare->outline == SCREE_SAMPLE_BOX;
    double aspect = box ? prepare->aspect_ratio : 1, count = (double)config->particles.count;
    if (model->dimension == 3) {
        double volume = count * 4.0 / 3.0 * M_PI * radius * radius * radius / phi;
        double width = box ? prepare->width : NAN, depth = box ? prepare->depth : NAN;
        if (isnan(width) && !isnan(depth)) return sqrt(volume * aspect / depth);
        if (isnan(width)) return cbrt(volume * aspect * aspect);
        return volume / (width * (isnan(depth) ? width : depth));
    }
    double area = count * M_PI * radius * radius / phi;
    if (box && !isnan(prepare->width)) return area / prepare->width;
    return sqrt(area * aspect);
}

double scree_model_gravity(const scree_model *model)
{
    double largest[3];
    scree_config_largest_gravity(model->config, largest);
    return hypot(hypot(largest[0], largest[1]), largest[2]);
}

/// Speed [m/s] at which neighbours pass each other in the fastest loading.
static double shear_speed(const scree_model *model)
{
    double fastest = 0;
    for (int64_t i = 0; i < model->config->stage_count; i++)
        fastest = fmax(fastest, scree_model_loading_rate(model, &model->config->stages[i]));
    return 2 * model->mean_radius * fastest;
}

double scree_expected_fast_speed(const scree_model *model, double velocity)
{
    return FAST * fmax(velocity, shear_speed(model));
}

/// Force of a strong contact under pressure and weight.
static double strong_static_force(const scree_model *model, double height, double density)
{
    const scree_config *config = model->config;
    double pressure = scree_model_gravity(model) * density * scree_expected_solid_fraction(model) * height;
    for (int64_t i = 0; i < config->stage_count; i++)
        pressure = fmax(pressure, scree_held_pressure(&config->stages[i]));
    double diameter = 2 * model->mean_radius;
    return STRONG * pressure * diameter * (model->dimension == 3 ? diameter : model->thickness);
}

/// Speed [m/s] at which the fastest wall of the case meets a body. Of a servo it is not known: it does not strike.
static double wall_speed(const scree_model *model)
{
    double fastest = 0;
    for (int64_t w = 0; w < model->config->wall_count; w++) {
        double speed = scree_wall_largest_speed(&model->config->walls[w]);
        if (!scree_wall_motions[model->config->walls[w].motion].servo) fastest = fmax(fastest, speed);
    }
    return fastest;
}

/// Speed [m/s] at which grains that are poured meet the pile: those of a source that stays above its top fall by that
/// distance, others from their place to the origin, where the box of the preparation begins.
static double pour_speed(const scree_model *model)
{
    double fastest = 0, gravity = scree_model_gravity(model);
    const int up = model->dimension - 1;
    for (int64_t k = 0; k < model->config->source_count; k++) {
        const scree_config_source *source = &model->config->sources[k];
        scree_source_place place;
        scree_modules[source->kind]->source->place(source->own, &place);
        double height = place.origin[up];
        for (int e = 0; e < place.edges; e++) height += fmax(0, place.edge[e][up]);
        if (!isnan(source->above)) height = source->above + 2 * model->radius_max;
        double speed = scree_length(source->velocity) + scree_length(source->spread);
        fastest = fmax(fastest, hypot(speed, sqrt(2 * gravity * fmax(0, height))));
    }
    return fastest;
}

/// Smallest body that there may be of a material. Of those that are not listed as a species' own, any may be.
static double least_radius(const scree_model *model, int material)
{
    double least = INFINITY;
    for (int s = 0; s < model->species_count; s++)
        if (model->species[s].material == material) least = fmin(least, model->species[s].radius.least);
    return isinf(least) ? model->radius_min : least;
}

/// Of contacts whose overlap has a gain g a law is g^2 times as stiff: that of two equal faces.
static void stiffen(scree_contact_tangent *t)
{
    t->normal_stiffness *= SCREE_FACE_GAIN_SQUARE;
    t->normal_damping *= SCREE_FACE_GAIN_SQUARE;
    t->tangential_stiffness *= SCREE_FACE_GAIN_SQUARE;
    t->tangential_damping *= SCREE_FACE_GAIN_SQUARE;
}

/// The estimate for contacts of two materials. dashpots: 1; 0 leaves them out.
static double estimate_of(const scree_model *model, int one, int other, double dashpots)
{
    const scree_pair_constants *pair = &model->pairs[one][other];
    double a = least_radius(model, one), b = least_radius(model, other);
    double mass = scree_model_mass(model, one, a), second = scree_model_mass(model, other, b);
    double effective_radius = a == b ? a / 2 : a * b / (a + b);
    double effective_mass = one == other ? mass / 2 : mass * second / (mass + second);
    const scree_law_use *law = scree_model_law_between(model, one, other);
    const scree_elastic *elastic = scree_law_get(law->law)->elastic;

    const scree_config_stage *stage = scree_config_prepare(model->config);
    const scree_preparation *method = scree_config_preparation(model->config);
    double phi =
        method && method->solid_fraction ? method->solid_fraction(model, stage) : scree_expected_solid_fraction(model);
    double height = scree_expected_height(model, phi);
    double force = strong_static_force(model, height, fmax(model->density[one], model->density[other]));
    double fall = sqrt(2 * scree_model_gravity(model) * height);
    if (method && method->impact_speed)
        force = fmax(force, elastic->impact_force(pair, effective_radius, effective_mass,
                                                  method->impact_speed(model, stage, fall)));
    const double striking = fmax(wall_speed(model), pour_speed(model));
    if (striking > 0) force = fmax(force, elastic->impact_force(pair, effective_radius, effective_mass, striking));
    double guard = elastic->force(pair, effective_radius, model->config->guard.overlap * fmin(a, b));
    if (!(force > 0 && force < guard)) force = guard;

    scree_contact_tangent tangent = scree_contact_linearise(law, pair, effective_radius, effective_mass, force);
    if (model->largest_gain > 1) stiffen(&tangent);
    tangent.normal_damping *= dashpots;
    tangent.tangential_damping *= dashpots;
    return scree_critical_step_lattice(model->dimension, &tangent, fmin(mass, second),
                                       scree_integrator_get(model->scheme)->limit);
}

static double estimate(const scree_model *model, double dashpots)
{
    double least = INFINITY;
    for (int one = 0; one < model->material_count; one++)
        for (int other = 0; other <= one; other++) least = fmin(least, estimate_of(model, one, other, dashpots));
    return least;
}

double scree_critical_step_estimate(const scree_model *model)
{
    return estimate(model, 1);
}

const char *scree_critical_step_advice(const scree_model *model, char text[96])
{
    const double undamped = estimate(model, 0);
    text[0] = 0;
    if (undamped > 1.5 * model->critical_step)
        (void)snprintf(text, 96, ", or less damping (%.3g s without dashpots)", undamped);
    return text;
}
