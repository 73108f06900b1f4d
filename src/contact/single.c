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

/// A pair of materials: the law that it is under, with its constants.
typedef struct pair_law {
    const scree_law_use *law;
    const scree_pair_constants *constants;
} pair_law;

/// own: constants of a pair that is held; NULL: of no such pair.
static pair_law law_of_pair(const scree_model *model, const scree_member_row *own, const bodies *one,
                            const bodies *other)
{
    const int a = (int)one->material, b = (int)other->material;
    if (own) return (pair_law){&model->persistent.law, &model->persistent.pairs[a][b]};
    return (pair_law){scree_model_law_between(model, a, b), &model->pairs[a][b]};
}

/// How the pair is evaluated.
static variant variant_of(const scree_model *model, int dimension, const scree_law_use *law)
{
    return (variant){.dimension = dimension,
                     .law = law->law,
                     .option = law->option,
                     .many_materials = true,
                     .geometry = model->geometry};
}

/// A neck outlasts the touch: what it remembers tells.
static bool is_neck(double reach, const memory_rows *memory)
{
    return reach > 0 && !memory_is_clear(memory);
}

bool contact_pair_is_there(const scree_state *state, const scree_work *work, size_t p)
{
    const scree_pair_section *section = scree_pairs_section(&work->pairs, p);
    if (section->persistent) return true;
    const contact_body first = contact_body_get(state, work->pairs.first[p]);
    const contact_body second = contact_body_get(state, work->pairs.second[p]);
    const bodies one = contact_body_lane(state->dimension, &first),
                 other = contact_body_lane(state->dimension, &second);
    const memory_rows memory = contact_memory_of(work, CONTACT_PAIR, p);
    return is_neck(work->pairs.reach, &memory) ||
           pair_touches((variant){.dimension = state->dimension, .geometry = section->geometry}, &one, &other);
}

bool contact_plate_is_there(const scree_state *state, const scree_work *work, size_t p)
{
    const scree_wall_pair_list *list = &work->wall_pairs;
    const contact_body body = contact_body_get(state, list->body[p]);
    const bodies one = contact_body_lane(state->dimension, &body);
    const variant v = {.dimension = state->dimension, .geometry = list->geometry};
    const memory_rows memory = contact_memory_of(work, CONTACT_PLATE, p);
    return is_neck(list->reach, &memory) || wall_touches(v, &one, &scree_plates(state)[list->wall[p]]);
}

/// own: constants of a pair that is held; NULL: of no such pair. False when such a pair is broken and apart.
static bool describe(variant v, pair_law of, const scree_member_row *own, kinematics *m, const memory_rows *memory,
                     scree_contact *contact)
{
    kinematics_hold(m);
    law_constants c = constants_get(of.constants, own);
    law_settings settings = law_settings_get(of.law, 0);
    law_memory before = memory_get(v, memory), after;
    law_force f = contact_law(v, &c, &settings, m, ~UINT64_C(0), &before, &after);
    describe_tangent(v.dimension, m, &f, contact);
    double load = f.normal + f.adhesion, cap = of.constants->value[SCREE_FRICTION] * load;
    contact->held = own != NULL;
    contact->bonded = own && own->value[SCREE_MEMBER_TENSION] >= 0;
    contact->sliding = !contact->bonded && load > 0 && fabs(contact->tangential_force) >= (1 - SLIDING_TOLERANCE) * cap;
    set_vector(contact->normal, m->normal);
    contact->overlap = m->overlap;
    contact->normal_force = f.normal;
    contact->elastic_normal = f.elastic_normal;
    contact->elastic_tangential = f.elastic_tangential;
    return !own || f.in_contact;
}

/// The contact point lies at the lever of `first`, of round bodies in the middle of the overlap.
static void place(variant v, const bodies *first, const kinematics *m, scree_contact *contact)
{
    const contact_branch branch = contact_branch_of(v, m, true);
    set_vector(contact->point,
               vector_minus(v.dimension, first->position, vector_times(v.dimension, branch.along, branch.arm)));
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
    bodies one = contact_body_lane(dimension, first), other = contact_body_lane(dimension, second);
    const pair_law of = law_of_pair(model, own, &one, &other);
    const variant v = variant_of(model, dimension, of.law);
    if (!own && !is_neck(scree_law_use_reach(of.law), memory) && !pair_touches(v, &one, &other)) return false;
    kinematics m = geometry_kinematics(v, &one, &other, state->step_size);
    kinematics_lead(v, &m, &one, &other);
    if (state->stretch) expand(state, &m, first, second);
    const bool in_contact = describe(v, of, own, &m, memory, contact);
    place(v, &one, &m, contact);
    contact->wall = false;
    set_vector(contact->branch, vector_minus(dimension, one.position, other.position));
    return in_contact;
}

static contact_moment moment_of_branch(const scree_state *state, const contact_scale *scale, contact_branch branch)
{
    return (contact_moment){branch.along, contact_moment_factor(state->stretch != NULL, scale, branch.arm)};
}

contact_evaluation contact_evaluate_again(const scree_model *model, const scree_state *state, const contact_body *first,
                                          const contact_body *second, const scree_member_row *own,
                                          const memory_rows *memory)
{
    const int dimension = state->dimension;
    contact_evaluation e = {.first = contact_body_lane(dimension, first),
                            .second = contact_body_lane(dimension, second)};
    const pair_law of = law_of_pair(model, own, &e.first, &e.second);
    e.variant = variant_of(model, dimension, of.law);
    e.kinematics = geometry_kinematics(e.variant, &e.first, &e.second, state->step_size);
    kinematics_lead(e.variant, &e.kinematics, &e.first, &e.second);
    if (state->stretch) expand(state, &e.kinematics, first, second);
    kinematics_hold(&e.kinematics);
    const contact_scale scale = {.inverse_force = 1 / state->force_quantum,
                                 .inverse_torque = 1 / state->torque_quantum,
                                 .force_limit = INFINITY};
    e.moment_first = moment_of_branch(state, &scale, contact_branch_of(e.variant, &e.kinematics, true));
    e.moment_second = moment_of_branch(state, &scale, contact_branch_of(e.variant, &e.kinematics, false));
    law_constants constants = constants_get(of.constants, own);
    law_settings settings = law_settings_get(of.law, 0);
    law_memory before = memory_get(e.variant, memory);
    e.force = contact_law(e.variant, &constants, &settings, &e.kinematics, ~UINT64_C(0), &before, &e.memory);
    e.quanta =
        contact_evaluate(e.variant, &constants, &settings, &scale, &e.kinematics, ~UINT64_C(0), &before, &e.memory);
    return e;
}

/// Between a body and anything that is not one.
static void describe_wall(variant v, pair_law of, const bodies *one, kinematics *m, const memory_rows *memory,
                          scree_contact *contact)
{
    (void)describe(v, of, NULL, m, memory, contact);
    place(v, one, m, contact);
    contact->wall = true;
    const double centre[3] = {one->position.x, one->position.y, one->position.z};
    for (int k = 0; k < 3; k++) contact->branch[k] = centre[k] - contact->point[k];
}

bool contact_of_wall(const scree_model *model, const scree_state *state, const contact_body *body,
                     const scree_wall *wall, const memory_rows *memory, scree_contact *contact)
{
    const int dimension = state->dimension;
    bodies one = contact_body_lane(dimension, body);
    const int material = (int)one.material;
    const pair_law of = {scree_model_law_on_plate(model, material), &model->walls[material]};
    const variant v = variant_of(model, dimension, of.law);
    if (!is_neck(scree_law_use_reach(of.law), memory) && !wall_touches(v, &one, wall)) return false;
    kinematics m = kinematics_of_wall(v, &one, wall, state->step_size);
    if (state->stretch) expand(state, &m, body, NULL);
    describe_wall(v, of, &one, &m, memory, contact);
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
    scree_pair_constants constants = contact_surface_constants(model, surface, (int)one.material);
    const pair_law of = {contact_surface_law(model, surface, (int)one.material), &constants};
    const variant v = variant_of(model, dimension, of.law);
    kinematics m = kinematics_of_surface(work->wall_set, primitive, v, &one, &closest,
                                         scree_case_walls(state)->moving != 0, state->step_size);
    if (state->stretch) expand(state, &m, body, NULL);
    describe_wall(v, of, &one, &m, memory, contact);
}
