/// A single contact as a measure sees it, from rows and memory: the scalar law without advancing anything.
#ifndef SCREE_CONTACT_SINGLE_H
#define SCREE_CONTACT_SINGLE_H

#include "contact/contact.h"
#include "contact/one_body.h"
#include "state/plates.h"

/// The list that a contact is in.
typedef enum contact_list { CONTACT_PAIR, CONTACT_PLATE, CONTACT_ELEMENT } contact_list;

/// Whether pair `p` of the list touches at the present positions, or is held; whether pair `p` with plates does.
bool contact_pair_is_there(const scree_state *state, const scree_work *work, size_t p);
bool contact_plate_is_there(const scree_state *state, const scree_work *work, size_t p);

/// A body or a ghost with v(n - 1/2), with which the forces at n were evaluated; in a periodic cell with the affine
/// field, and a ghost where it is.
contact_body contact_body_at_half_step(const scree_model *model, const scree_state *state, const scree_work *work,
                                       uint32_t k);

/// Memory of number `k` of a list.
static inline memory_rows contact_memory_of(const scree_work *work, contact_list list, size_t k)
{
    const scree_pair_list *pairs = &work->pairs;
    const scree_wall_pair_list *walls = list == CONTACT_PLATE ? &work->wall_pairs : &work->primitive_pairs;
    return list == CONTACT_PAIR ? memory_rows_at(pairs->history, pairs->last_force, pairs->rolling, k)
                                : memory_rows_at(walls->history, walls->last_force, walls->rolling, k);
}

/// Number of the law of number `k` of a list; not of a pair that is held.
static inline int contact_law_number(const scree_work *work, contact_list list, size_t k)
{
    return list == CONTACT_PAIR    ? scree_pairs_section(&work->pairs, k)->law
           : list == CONTACT_PLATE ? scree_wall_pair_law(&work->wall_pairs, k)
                                   : scree_wall_pair_law(&work->primitive_pairs, k);
}

/// Constants of its own of pair `p` of the list; NULL where it is not held.
static inline const scree_member_row *contact_own_of(const scree_work *work, size_t p)
{
    return p < scree_pairs_held(&work->pairs) ? &work->pairs.own[p] : NULL;
}

/// Two bodies; false when they are not in contact. own: of a pair that is held, which needs no touch while its bond
/// stands; else NULL. Leaves `first` and `second` of the contact alone.
bool contact_of_pair(const scree_model *model, const scree_state *state, const contact_body *first,
                     const contact_body *second, const scree_member_row *own, const memory_rows *memory,
                     scree_contact *contact);

/// What the moment of the force on a body is made with (contact_moments).
typedef struct contact_moment {
    vector along;
    lanes factor;
} contact_moment;

/// What a pair of bodies exerts on each other at n, evaluated again.
typedef struct contact_evaluation {
    variant variant;
    bodies first, second;
    kinematics kinematics;                      ///< rates of the middle of the step before n
    contact_moment moment_first, moment_second; ///< of both bodies
    contact_quanta quanta;                      ///< in the quanta of the state
    law_force force;
    law_memory memory; ///< what the contact remembers then
} contact_evaluation;

/// Evaluates the law of a pair that is taken to touch, or is held, with a step of zero. Of one without a bond, or whose
/// bond has just broken, springs come out as long as its friction allows.
contact_evaluation contact_evaluate_again(const scree_model *model, const scree_state *state, const contact_body *first,
                                          const contact_body *second, const scree_member_row *own,
                                          const memory_rows *memory);

/// Its part in the energy of the springs [J].
static inline double contact_elastic_energy(const contact_evaluation *e)
{
    return e->force.elastic_normal + e->force.elastic_tangential;
}

/// A body and a wall.
bool contact_of_wall(const scree_model *model, const scree_state *state, const contact_body *body,
                     const scree_wall *wall, const memory_rows *memory, scree_contact *contact);

/// A body and an element of the walls of the case that it touches, as the state has them now.
void contact_of_primitive(const scree_model *model, const scree_state *state, const scree_work *work,
                          const contact_body *body, uint32_t primitive, const memory_rows *memory,
                          scree_contact *contact);

#endif
