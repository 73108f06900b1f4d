/// Bounds of contact forces and energies, and the quanta.
///
/// With v the largest of |v| + R |w| over bodies and walls, no relative velocity exceeds 2 v, no overlap grows by
/// more than 2 v dt in a step, and with d_0 the largest overlap of the last evaluation
///   d = d_0 + 2 v dt + 2^-32 R_max                                     (the last term: round-off of positions at rest)
/// from which each law bounds its forces and energies (its descriptor's file); torques stay below R_max f.
/// With no contact in the last evaluation, which may be the first of the run, d_0 is the guard's limit instead.
/// Each bound is doubled, so round-off cannot matter. Where overlaps have a gain (kinematics.h), they grow by that many
/// times the way, and forces are that many times those of the law.
///
/// Cost: materials (materials + walls), a few powers.
#include "contact/bounds.h"
#include "state/case_walls.h"
#include "state/deformation.h"
#include "state/persistent.h"
#include "state/plates.h"

#include "base/fixed.h"
#include "contact/contact.h"

static void extend(scree_pair_constants *most, const scree_pair_constants *pair)
{
    for (int k = 0; k < SCREE_PAIR_CONSTANTS; k++) most->value[k] = fmax(most->value[k], pair->value[k]);
}

/// Largest constants over all pairs of materials and walls under a law.
static scree_pair_constants largest_constants(const scree_model *model, int law)
{
    scree_pair_constants most = {{0}};
    for (int a = 0; a < model->material_count; a++) {
        if (model->law_of_walls[a] == law) extend(&most, &model->walls[a]);
        for (int b = 0; b <= a; b++)
            if (model->law_of_pairs[a][b] == law) extend(&most, &model->pairs[a][b]);
    }
    for (int w = 0; w < model->wall_count; w++)
        for (int a = 0; a < model->material_count; a++)
            if (model->law_of_surfaces[w][a] == law) extend(&most, &model->surfaces[w][a]);
    return most;
}

static scree_law_bounds larger(scree_law_bounds a, scree_law_bounds b)
{
    return (scree_law_bounds){.force = fmax(a.force, b.force),
                              .damping = fmax(a.damping, b.damping),
                              .friction = fmax(a.friction, b.friction)};
}

static scree_law_bounds bounds_under(const scree_model *model, int law, const scree_law_extent *extent)
{
    const scree_pair_constants most = largest_constants(model, law);
    return scree_law_get(model->laws[law].law)->bound(&model->laws[law], &most, extent);
}

static double largest_mass(const scree_model *model)
{
    double mass = 0, radius = scree_model_largest_radius(model);
    for (int k = 0; k < model->material_count; k++) mass = fmax(mass, scree_model_mass(model, k, radius));
    return mass;
}

static double largest_speed(const scree_state *state)
{
    double speed = fmax(state->largest_speed, scree_case_walls(state)->speed);
    for (int k = 0; k < SCREE_WALL_COUNT; k++) {
        const scree_wall *wall = &scree_plates(state)[k];
        if (wall->active) speed = fmax(speed, fabs(wall->velocity) + scree_length(wall->tangential_velocity));
    }
    return speed;
}

/// By which the overlap of two bodies that deform may grow with their strains [m].
static double growth_of(const scree_state *state)
{
    return 2 * scree_deformation_of(state)->growth;
}

/// The same for pairs that are held, whose law bounds its forces by the largest deformation. Levers of a pair with a
/// gap g are longer by g / 2, and the tangential velocity with them.
static scree_law_bounds bounds_of_held(const scree_model *model, const scree_state *state)
{
    const scree_persistent_list *list = scree_persistent(state);
    const scree_persistent_law *held = &model->persistent;
    scree_pair_constants most = {{0}};
    for (int a = 0; a < model->material_count; a++)
        for (int b = 0; b <= a; b++) extend(&most, &held->pairs[a][b]);
    double radius = scree_model_largest_radius(model);
    double relative = 2 * largest_speed(state) * (1 + 0.5 * list->largest_gap / model->radius_min);
    const scree_law_extent extent = {.speed = relative,
                                     .overlap = list->largest_deformation + relative * state->step_size +
                                                growth_of(state) + ldexp(radius + list->largest_gap, -32),
                                     .radius = radius,
                                     .mass = largest_mass(model),
                                     .step = state->step_size};
    return scree_law_get(held->law.law)->bound(&held->law, &most, &extent);
}

scree_law_bounds contact_bounds_get(const scree_model *model, const scree_state *state)
{
    const double gain = fmax(1, model->largest_gain);
    double relative = 2 * gain * largest_speed(state), radius = scree_model_largest_radius(model);
    double before = state->largest_overlap > 0 ? state->largest_overlap : contact_overlap_limit(model) * radius;
    const scree_law_extent extent = {.speed = relative,
                                     .overlap =
                                         before + relative * state->step_size + growth_of(state) + ldexp(radius, -32),
                                     .radius = radius,
                                     .mass = largest_mass(model),
                                     .step = state->step_size};
    scree_law_bounds once = bounds_under(model, 0, &extent);
    for (int k = 1; k < scree_model_law_count(model); k++) once = larger(once, bounds_under(model, k, &extent));
    if (scree_persistent_total(state) > 0) once = larger(once, bounds_of_held(model, state));
    return (scree_law_bounds){
        .force = 2 * gain * once.force, .damping = 2 * once.damping, .friction = 2 * once.friction};
}

int contact_energy_bits(int dimension, size_t count, size_t held)
{
    int bits = 0;
    const uint64_t most = (uint64_t)count * (dimension == 3 ? 16 : 4) + held;
    while (bits < 60 && (most >> bits) > 0) bits++;
    return 62 - bits < SCREE_FIXED_RANGE_BITS ? 62 - bits : SCREE_FIXED_RANGE_BITS;
}

void scree_contact_set_quanta(const scree_model *model, scree_state *state, double extra)
{
    double force = fmax(contact_bounds_get(model, state).force, extra);
    int lever;
    (void)frexp(scree_model_largest_radius(model) + 0.5 * scree_persistent(state)->largest_gap, &lever);
    state->force_quantum = scree_fixed_quantum(force);
    state->torque_quantum = ldexp(state->force_quantum, lever);
}
