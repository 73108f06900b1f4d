/// Bounds of contact forces and energies, and the quanta.
///
/// With v the largest of |v| + R |w| over bodies and walls, no relative velocity exceeds 2 v, no indentation grows by
/// more than 2 v dt in a step, and with d_0 the largest indentation of the last evaluation
///   d = d_0 + 2 v dt + 2^-32 R_max                                     (the last term: round-off of positions at rest)
///   f_n <= k_n d + eta 2 v, k_n = normal_stiffness sqrt(R_max d), eta = damping sqrt(m_max k_n) or T k_n
///   f   <= f_n (1 + mu), for hertz_brilliantov (1 + mu max(1, (2 v / v_R)^(1/c)))
/// and torques below R_max f, with mu + mu_r + mu_tw where there is resistance to rolling and twisting.
/// With no contact in the last evaluation, which may be the first of the run, d_0 is the guard's limit instead.
/// Energies of one contact and step: damping 2 (eta 2 v) (2 v dt); friction f (2 v dt) plus what a tangential spring
/// may hold, S^2 / k_t with S <= mu f_n + eta 2 v, and for rolling alike. A twisting spring slides at an angle of
/// 2 mu_tw k_n / k_t or so (its cap over its stiffness), so it holds no more than twice that times mu_tw R_max f_n.
/// Each bound is doubled, so round-off cannot matter.
///
/// Cost: materials (materials + walls), a few powers.
#include "contact/bounds.h"
#include "state/case_walls.h"
#include "state/plates.h"

#include "base/fixed.h"
#include "contact/contact.h"

/// The slip that an implicit friction sees holds what one step may change: so many times the largest now.
static const double FORESEEN = 64;

/// Largest constants over all pairs of materials and walls.
typedef struct extremes {
    double stiffness, compliance_ratio, friction, damping;
    double rolling, twisting; ///< friction
} extremes;

static void extend(extremes *e, const scree_pair_constants *c)
{
    e->stiffness = fmax(e->stiffness, c->normal_stiffness);
    e->friction = fmax(e->friction, c->friction);
    e->damping = fmax(e->damping, c->damping);
    e->rolling = fmax(e->rolling, c->rolling_friction);
    e->twisting = fmax(e->twisting, c->twisting_friction);
    if (c->tangential_stiffness > 0)
        e->compliance_ratio = fmax(e->compliance_ratio, c->normal_stiffness / c->tangential_stiffness);
}

static extremes extremes_get(const scree_model *model)
{
    extremes e = {0};
    for (int a = 0; a < model->material_count; a++) {
        extend(&e, &model->walls[a]);
        for (int b = 0; b <= a; b++) extend(&e, &model->pairs[a][b]);
    }
    for (int w = 0; model->config && w < model->config->wall_count; w++) {
        e.friction = fmax(e.friction, model->config->walls[w].friction);
        for (int a = 0; a < model->material_count; a++) extend(&e, &model->surfaces[w][a]);
    }
    return e;
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

contact_bounds contact_bounds_get(const scree_model *model, const scree_state *state)
{
    extremes e = extremes_get(model);
    double relative = 2 * largest_speed(state), radius = scree_model_largest_radius(model);
    double before = state->largest_overlap > 0 ? state->largest_overlap : contact_overlap_limit(model) * radius;
    double d = before + relative * state->step_size + ldexp(radius, -32);
    double stiffness = e.stiffness * sqrt(radius * d);
    bool mindlin = model->law == SCREE_LAW_HERTZ_MINDLIN;
    double eta = mindlin ? e.damping * sqrt(largest_mass(model) * stiffness) : model->damping_time * stiffness;

    double damping = eta * relative, normal = stiffness * d + damping;
    double slip = scree_model_foresees(model) ? FORESEEN * relative : relative;
    double mobilised = mindlin ? 1.0 : fmax(1.0, pow(slip / model->reference_velocity, model->inverse_exponent));
    double force = normal * (1 + e.friction * mobilised + e.rolling + e.twisting);
    double friction = force * relative * state->step_size;
    if (mindlin) {
        // S^2 / k_t is largest at the largest indentation for its frictional part, and does not depend on it for the
        // viscous part: (eta 2 v)^2 / k_n = damping^2 m (2 v)^2.
        double slide = (e.friction + e.rolling) * (normal + damping);
        friction += 2 * e.compliance_ratio * (slide * slide / stiffness + damping * damping / stiffness);
        friction += 4 * e.compliance_ratio * e.twisting * e.twisting * radius * normal;
        friction += force * relative * state->step_size;
    }
    return (contact_bounds){
        .force = 2 * force, .damping = 4 * damping * relative * state->step_size, .friction = 2 * friction};
}

int contact_energy_bits(int dimension, size_t count)
{
    int bits = 0;
    const uint64_t most = (uint64_t)count * (dimension == 3 ? 16 : 4);
    while (bits < 60 && (most >> bits) > 0) bits++;
    return 62 - bits < SCREE_FIXED_RANGE_BITS ? 62 - bits : SCREE_FIXED_RANGE_BITS;
}

void scree_contact_set_quanta(const scree_model *model, scree_state *state, double extra)
{
    double force = fmax(contact_bounds_get(model, state).force, extra);
    int lever;
    (void)frexp(scree_model_largest_radius(model), &lever);
    state->force_quantum = scree_fixed_quantum(force);
    state->torque_quantum = ldexp(state->force_quantum, lever);
}
