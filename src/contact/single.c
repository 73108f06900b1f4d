/// With a step of zero the laws advance nothing: a spring gives again the force that it gave when it was advanced. The
/// motion is that of the last step, with the rates that the force was evaluated with.
/// A contact slides when its tangential force has reached mu f_n; where friction follows the slip speed, that is at
/// v_R.
#include "contact/single.h"
#include "state/case_walls.h"

#include "contact/surfaces.h"
#include "state/plates.h"

/// Round-off of a tangential force that is computed again from the spring it left.
#define SLIDING_TOLERANCE 1e-9

static void set_vector(double to[3], vector from)
{
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

/// Tangent, tangential force and slip: signed along t in two dimensions, magnitudes along the force in three.
static void describe_tangent(int dimension, const kinematics *m, const law_force *f, scree_contact *contact)
{
    if (dimension == 2) {
        set_vector(contact->tangent, (vector){-m->normal.y, m->normal.x, 0});
        contact->tangential_force = f->tangential.x;
        contact->slip = m->slip.x;
        return;
    }
    double force = sqrt(vector_dot(3, f->tangential, f->tangential));
    set_vector(contact->tangent, vector_times(3, f->tangential, force > 0 ? 1 / force : 0));
    contact->tangential_force = force;
    contact->slip = sqrt(vector_dot(3, m->slip, m->slip));
}

/// own: constants of a pair that is held; NULL: of no such pair. False when such a pair is broken and apart.
static bool describe(const scree_model *model, int dimension, const scree_pair_constants *constants,
                     const scree_member_row *own, kinematics *m, const memory_rows *memory, scree_contact *contact)
{
    kinematics_hold(m);
    const scree_law_use *law = own ? &model->persistent.law : &model->law;
    variant v = {.dimension = dimension, .law = law->law, .option = law->option, .many_materials = true};
    law_constants c = constants_get(constants, own);
    law_settings settings = law_settings_get(law, 0);
    law_memory before = memory_get(v, memory), after;
    law_force f = law_evaluate(v, &c, &settings, m, ~UINT64_C(0), &before, &after);
    describe_tangent(dimension, m, &f, contact);
    double cap = constants->value[SCREE_FRICTION] * f.normal;
    contact->held = own != NULL;
    contact->bonded = own && own->value[SCREE_MEMBER_TENSION] >= 0;
    contact->sliding =
        !contact->bonded && f.normal > 0 && fabs(contact->tangential_force) >= (1 - SLIDING_TOLERANCE) * cap;
    set_vector(contact->normal, m->normal);
    contact->overlap = m->overlap;
    contact->normal_force = f.normal;
    contact->elastic_normal = f.elastic_normal;
    contact->elastic_tangential = f.elastic_tangential;
    return !own || f.in_contact;
}

/// The contact point lies in the middle of the overlap, one lever arm from the centre of `first`.
static void place(int dimension, const bodies *first, const kinematics *m, scree_contact *contact)
{
    vector arm = vector_times(dimension, m->normal, m->arm_first);
    set_vector(contact->point, vector_minus(dimension, first->position, arm));
}

static void expand(const scree_state *state, kinematics *m, const contact_body *first, const contact_body *second)
{
    const stretch both = stretch_get(state->dimension, first->stretch, second ? second->stretch : NULL);
    kinematics_expand(state->dimension, m, &both, state->step_size);
}

bool contact_of_pair(const scree_model *model, const scree_state *state, const contact_body *first,
                     const contact_body *second, const scree_member_row *own, const memory_rows *memory,
                     scree_contact *contact)
{
    const int dimension = state->dimension;
    const double *const stretches[2] = {first->stretch, second->stretch};
    if (!own && !pair_touches(dimension, &first->row, &second->row, stretches)) return false;
    bodies one = contact_body_lane(dimension, first), other = contact_body_lane(dimension, second);
    kinematics m = kinematics_of_pair(dimension, &one, &other, state->step_size);
    if (state->stretch) expand(state, &m, first, second);
    const scree_pair_constants(*pairs)[SCREE_MAX_MATERIALS] = own ? model->persistent.pairs : model->pairs;
    const scree_pair_constants *constants = &pairs[(int)one.material][(int)other.material];
    const bool in_contact = describe(model, dimension, constants, own, &m, memory, contact);
    place(dimension, &one, &m, contact);
    contact->wall = false;
    set_vector(contact->branch, vector_minus(dimension, one.position, other.position));
    return in_contact;
}

contact_evaluation contact_evaluate_again(const scree_model *model, const scree_state *state, bool ledger,
                                          const contact_body *first, const contact_body *second,
                                          const scree_member_row *own, const memory_rows *memory)
{
    const int dimension = state->dimension;
    const scree_law_use *law = own ? &model->persistent.law : &model->law;
    contact_evaluation e = {.variant = {.dimension = dimension,
                                        .law = law->law,
                                        .option = law->option,
                                        .many_materials = true,
                                        .ledger = ledger},
                            .first = contact_body_lane(dimension, first),
                            .second = contact_body_lane(dimension, second)};
    e.kinematics = kinematics_of_pair(dimension, &e.first, &e.second, state->step_size);
    if (state->stretch) expand(state, &e.kinematics, first, second);
    kinematics_hold(&e.kinematics);
    const contact_scale scale = {.inverse_force = 1 / state->force_quantum,
                                 .inverse_torque = 1 / state->torque_quantum,
                                 .force_limit = INFINITY};
    e.moment_first = contact_moment_factor(state->stretch != NULL, &scale, e.kinematics.arm_first);
    e.moment_second = contact_moment_factor(state->stretch != NULL, &scale, e.kinematics.arm_second);
    const scree_pair_constants(*pairs)[SCREE_MAX_MATERIALS] = own ? model->persistent.pairs : model->pairs;
    law_constants constants = constants_get(&pairs[(int)e.first.material][(int)e.second.material], own);
    law_settings settings = law_settings_get(law, 0);
    law_memory before = memory_get(e.variant, memory);
    e.force = law_evaluate(e.variant, &constants, &settings, &e.kinematics, ~UINT64_C(0), &before, &e.memory);
    e.quanta =
        contact_evaluate(e.variant, &constants, &settings, &scale, &e.kinematics, ~UINT64_C(0), &before, &e.memory);
    return e;
}

/// Between a body and anything that is not one.
static void describe_wall(const scree_model *model, int dimension, const scree_pair_constants *constants,
                          const bodies *one, kinematics *m, const memory_rows *memory, scree_contact *contact)
{
    (void)describe(model, dimension, constants, NULL, m, memory, contact);
    place(dimension, one, m, contact);
    contact->wall = true;
    const double centre[3] = {one->position.x, one->position.y, one->position.z};
    for (int k = 0; k < 3; k++) contact->branch[k] = centre[k] - contact->point[k];
}

bool contact_of_wall(const scree_model *model, const scree_state *state, const contact_body *body,
                     const scree_wall *wall, const memory_rows *memory, scree_contact *contact)
{
    const int dimension = state->dimension;
    if (!wall_touches(dimension, &body->row, wall, body->stretch)) return false;
    bodies one = contact_body_lane(dimension, body);
    kinematics m = kinematics_of_wall(dimension, &one, wall, state->step_size);
    if (state->stretch) expand(state, &m, body, NULL);
    describe_wall(model, dimension, &model->walls[(int)one.material], &one, &m, memory, contact);
    return true;
}

void contact_of_primitive(const scree_model *model, const scree_state *state, const scree_work *work,
                          const contact_body *body, uint32_t primitive, const memory_rows *memory,
                          scree_contact *contact)
{
    const int dimension = state->dimension;
    bodies one = contact_body_lane(dimension, body);
    scree_closest_point closest;
    scree_primitive_closest_point(work->wall_set, primitive,
                                  (const double[3]){one.position.x, one.position.y, one.position.z}, &closest);
    const scree_surface *surface = contact_surface_of(work->wall_set, primitive);
    kinematics m = kinematics_of_surface(work->wall_set, primitive, dimension, &one, &closest,
                                         scree_case_walls(state)->moving != 0, state->step_size);
    if (state->stretch) expand(state, &m, body, NULL);
    scree_pair_constants constants = contact_surface_constants(model, surface, (int)one.material);
    describe_wall(model, dimension, &constants, &one, &m, memory, contact);
}
