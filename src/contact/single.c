/// With a step of zero the laws advance nothing: a spring gives again the force that it gave when it was advanced.
/// A contact slides when its tangential force has reached mu f_n; for hertz_brilliantov that is a slip speed of v_R.
#include "contact/single.h"

#include "contact/scalar.h"

/// Round-off of a tangential force that is computed again from the spring it left.
#define SLIDING_TOLERANCE 1e-9

static void describe(const scree_model *model, const scree_pair_constants *constants, const motion *m,
                     const scree_history *history, scree_contact *contact)
{
    law_constants c = constants_get(constants);
    law_settings settings = law_settings_get(model, 0);
    law_memory before = memory_get(history), after;
    law_force f = law_evaluate(model->law, &c, &settings, m, ~UINT64_C(0), &before, &after);
    double cap = constants->friction * f.normal;
    contact->sliding = f.normal > 0 && fabs(f.tangential) >= (1 - SLIDING_TOLERANCE) * cap;
    contact->normal[0] = m->normal_x;
    contact->normal[1] = m->normal_y;
    contact->normal[2] = 0;
    contact->tangent[0] = -m->normal_y;
    contact->tangent[1] = m->normal_x;
    contact->tangent[2] = 0;
    contact->indentation = m->indentation;
    contact->normal_force = f.normal;
    contact->tangential_force = f.tangential;
    contact->slip = m->slip;
    contact->elastic_normal = f.elastic_normal;
    contact->elastic_tangential = f.elastic_tangential;
}

/// The contact point lies in the middle of the indentation, one lever arm from the centre of `first`.
static void place(const scree_row *first, const motion *m, scree_contact *contact)
{
    contact->point[0] = first->x - m->arm_first * m->normal_x;
    contact->point[1] = first->y - m->arm_first * m->normal_y;
    contact->point[2] = contact->branch[2] = 0;
}

bool contact_of_pair(const scree_model *model, const scree_row *first, const scree_row *second,
                     const scree_history *history, scree_contact *contact)
{
    if (!pair_touches(first, second)) return false;
    bodies one = body_get(first), other = body_get(second);
    motion m = motion_of_pair(&one, &other, 0);
    describe(model, &model->pairs[(int)first->material][(int)second->material], &m, history, contact);
    place(first, &m, contact);
    contact->wall = false;
    contact->branch[0] = first->x - second->x;
    contact->branch[1] = first->y - second->y;
    return true;
}

bool contact_of_wall(const scree_model *model, const scree_row *body, const scree_wall *wall,
                     const scree_history *history, scree_contact *contact)
{
    if (!wall_touches(body, wall)) return false;
    bodies one = body_get(body);
    motion m = motion_of_wall(&one, wall, 0);
    describe(model, &model->walls[(int)body->material], &m, history, contact);
    place(body, &m, contact);
    contact->wall = true;
    contact->branch[0] = body->x - contact->point[0];
    contact->branch[1] = body->y - contact->point[1];
    return true;
}
