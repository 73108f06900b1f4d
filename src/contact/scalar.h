/// One contact at a time: rows of the state as lanes of one, and the motion against a wall.
#ifndef SCREE_CONTACT_SCALAR_H
#define SCREE_CONTACT_SCALAR_H

#include "contact/evaluate.h"
#include "contact/memory_rows.h"
#include "state/plates.h"

/// That of two bodies from their rows (state/state.h); second: NULL beside a wall.
SCREE_INLINE stretch stretch_get(int dimension, const double *first, const double *second)
{
    const int half = dimension == 3 ? SCREE_STRETCHES_3D / 2 : SCREE_STRETCHES_2D / 2;
    stretch both;
    for (int k = 0; k < (dimension == 3 ? 6 : 3); k++) {
        const int place = k < 3 ? k : k + 1;
        both.now[k] = first[place] + (second ? second[place] : 0);
        both.change[k] = first[half + place] + (second ? second[half + place] : 0);
    }
    return both;
}

/// `turn` is not read in two dimensions.
SCREE_INLINE bodies body_get(int dimension, const scree_row *row, const scree_turn_row *turn)
{
    bodies body = {.position = {row->x, row->y, 0}, .velocity = {row->vx, row->vy, 0}};
    body.radius = row->radius;
    body.mass = row->mass;
    if (dimension == 2) {
        body.spin.x = row->spin;
        body.material = row->material;
        return body;
    }
    body.position.z = row->z;
    body.velocity.z = row->vz;
    body.spin = (vector){turn->wx, turn->wy, turn->wz};
    body.material = turn->material;
    return body;
}

static inline prediction prediction_get(int dimension, const scree_predicted *f)
{
    if (dimension == 2) return (prediction){.velocity = {f->vx, f->vy, 0}, .spin = {f->spin, 0, 0}, f->contacts};
    return (prediction){.velocity = {f->vx, f->vy, f->vz}, .spin = {f->wx, f->wy, f->wz}, f->contacts};
}

/// Rates of dashpots where the motion of the bodies at n is known. second: NULL beside a wall.
SCREE_INLINE void kinematics_lead(variant v, kinematics *m, const bodies *first, const bodies *second)
{
    if (!first->lead) return;
    const motion_at_n one = motion_at_end(v.dimension, first, prediction_get(v.dimension, first->lead));
    if (!second) {
        kinematics_at_end(v.dimension, geometry_has_levers(v), m, &one, NULL);
    } else {
        const motion_at_n other = motion_at_end(v.dimension, second, prediction_get(v.dimension, second->lead));
        kinematics_at_end(v.dimension, geometry_has_levers(v), m, &one, &other);
    }
    if (geometry_has_gains(v)) kinematics_gain_at_end(v.dimension, m);
}

/// own: constants of the pair's own; NULL: it has none.
static inline law_constants constants_get(const scree_pair_constants *c, const scree_member_row *own)
{
    law_constants constants = {.own = {0}};
    for (int k = 0; k < SCREE_PAIR_CONSTANTS; k++) constants.value[k] = c->value[k];
    for (int k = 0; k < SCREE_MEMBER_CONSTANTS && own; k++) constants.own[k] = own->value[k];
    return constants;
}

/// Adds to a sum, modulo 2^64; the third is the torque in two dimensions and the force along z in three.
static inline void sum_row_add(scree_sum_row *sum, uint64_t fx, uint64_t fy, uint64_t third, uint64_t contacts)
{
    sum->fx = (int64_t)((uint64_t)sum->fx + fx);
    sum->fy = (int64_t)((uint64_t)sum->fy + fy);
    sum->fz = (int64_t)((uint64_t)sum->fz + third);
    sum->contacts = (int64_t)((uint64_t)sum->contacts + contacts);
}

static inline void torque_row_add(scree_torque_row *sum, uint64_t x, uint64_t y, uint64_t z)
{
    sum->x = (int64_t)((uint64_t)sum->x + x);
    sum->y = (int64_t)((uint64_t)sum->y + y);
    sum->z = (int64_t)((uint64_t)sum->z + z);
}

static inline law_memory memory_get(variant v, const memory_rows *rows)
{
    law_memory memory = {0};
    for (int k = 0; k < 4; k++) {
        memory.value[k] = rows->history->value[k];
        if (law_keeps_last_force(v)) memory.last[k] = (double)rows->last_force->value[k];
        if (law_rolls(v)) memory.rolling[k] = rows->rolling->value[k];
        if (law_rolls(v)) memory.rolling_last[k] = (double)rows->rolling->last[k];
    }
    return memory;
}

static inline void memory_set(variant v, const memory_rows *rows, const law_memory *memory)
{
    for (int k = 0; k < 4; k++) {
        rows->history->value[k] = memory->value[k];
        if (law_keeps_last_force(v)) rows->last_force->value[k] = (float)memory->last[k];
        if (law_rolls(v)) rows->rolling->value[k] = memory->rolling[k];
        if (law_rolls(v)) rows->rolling->last[k] = (float)memory->rolling_last[k];
    }
}

/// Two bodies, each with what its geometry reads of it.
static inline bool pair_touches(variant v, const bodies *one, const bodies *other)
{
    if (!one->stretch && !geometry_is_coarse(v)) return geometry_touches(v, one, other) != 0;
    if (!one->stretch && !geometry_touches(v, one, other)) return false;
    kinematics m = geometry_kinematics(v, one, other, 0);
    if (!one->stretch) return expanded_touch(&m) != 0;
    const stretch both = stretch_get(v.dimension, one->stretch, other->stretch);
    kinematics_expand(v.dimension, &m, &both, 0);
    return expanded_touch(&m) != 0;
}

/// The rest of it: `seen` has the velocity and the spin of the body in the frame of the wall, whose normal turns there
/// as m->tilted says.
SCREE_INLINE void kinematics_past(variant v, kinematics *m, const bodies *seen, double step)
{
    const int dimension = v.dimension;
    if (geometry_has_levers(v)) {
        kinematics_from_levers(dimension, m, seen, NULL, step);
        if (geometry_has_gains(v)) kinematics_gain(dimension, m);
    } else {
        vector along = vector_across(dimension, seen->velocity, m->normal);
        vector lever = vector_times(tangential_count(dimension), seen->spin, m->arm_first);
        kinematics_advance(dimension, m, seen->velocity, along, lever, seen->spin, vector_none(), step);
    }
    kinematics_lead(v, m, seen, NULL);
}

/// A plate moves with its normal and tangential velocity.
SCREE_INLINE kinematics kinematics_of_wall(variant v, const bodies *body, const scree_wall *wall, double step)
{
    const int dimension = v.dimension;
    const double *slide = wall->tangential_velocity;
    vector normal = {wall->normal[0], wall->normal[1], wall->normal[2]};
    vector moving = {wall->velocity * normal.x + slide[0], wall->velocity * normal.y + slide[1],
                     wall->velocity * normal.z + slide[2]};
    bodies seen = *body;
    seen.velocity = vector_minus(dimension, body->velocity, moving);
    kinematics m =
        geometry_beside(v, &seen, wall->normal, vector_dot(dimension, normal, body->position) - wall->position, step);
    kinematics_past(v, &m, &seen, step);
    return m;
}

/// Reach [m] of a body where the normal is n, of one that deforms with its stretch `of`; NULL: it is rigid.
SCREE_INLINE double wall_reach(int dimension, double reach, const double n[3], const double *of)
{
    if (!of) return reach;
    const stretch own = stretch_get(dimension, of, NULL);
    const vector normal = {n[0], n[1], n[2]};
    return reach + vector_dot(dimension, normal, stretch_along(dimension, own.now, normal));
}

/// NaN counts as contact, so that it is noticed.
SCREE_INLINE bool wall_touches(variant v, const bodies *body, const scree_wall *wall)
{
    const vector normal = {wall->normal[0], wall->normal[1], wall->normal[2]};
    const double height = vector_dot(v.dimension, normal, body->position);
    const double reach = wall_reach(v.dimension, geometry_reach(v, body), wall->normal, body->stretch);
    if (!wall->active || reach <= height - wall->position) return false;
    if (!geometry_is_coarse(v)) return true;
    const kinematics m = geometry_beside(v, body, wall->normal, height - wall->position, 0);
    return expanded_touch(&m) != 0;
}

#endif
