/// One contact at a time: rows of the state as lanes of one, and the motion against a wall.
#ifndef SCREE_CONTACT_SCALAR_H
#define SCREE_CONTACT_SCALAR_H

#include "contact/evaluate.h"

static inline bodies body_get(const scree_row *row)
{
    return (bodies){row->x, row->y, row->material, row->radius, row->vx, row->vy, row->spin, row->mass};
}

static inline foresight foresight_get(const scree_foreseen *f)
{
    return (foresight){f->vx, f->vy, f->spin, f->contacts};
}

static inline law_constants constants_get(const scree_pair_constants *c)
{
    return (law_constants){c->normal_stiffness, c->tangential_stiffness, c->friction, c->damping};
}

/// Adds to a sum, modulo 2^64.
static inline void sum_row_add(scree_sum_row *sum, uint64_t fx, uint64_t fy, uint64_t torque, uint64_t contacts)
{
    sum->fx = (int64_t)((uint64_t)sum->fx + fx);
    sum->fy = (int64_t)((uint64_t)sum->fy + fy);
    sum->torque = (int64_t)((uint64_t)sum->torque + torque);
    sum->contacts = (int64_t)((uint64_t)sum->contacts + contacts);
}

static inline law_memory memory_get(const scree_history *history)
{
    law_memory memory;
    memcpy(memory.value, history->value, sizeof memory.value);
    return memory;
}

static inline bool history_is_clear(const scree_history *history)
{
    const double *value = history->value;
    return value[0] == 0 && value[1] == 0 && value[2] == 0 && value[3] == 0;
}

static inline bool pair_touches(const scree_row *first, const scree_row *second)
{
    return bodies_touch(first->x - second->x, first->y - second->y, first->radius + second->radius) != 0;
}

/// A wall is a body of infinite radius and mass that moves with its normal and tangential velocity: R_eff = R, m_eff =
/// m.
static inline motion motion_of_wall(const bodies *body, const scree_wall *wall, double step)
{
    motion m = {.normal_x = wall->normal[0], .normal_y = wall->normal[1]};
    m.indentation = body->radius - (m.normal_x * body->x + m.normal_y * body->y - wall->position);
    double u = body->vx - (wall->velocity * m.normal_x + wall->tangential_velocity[0]);
    double v = body->vy - (wall->velocity * m.normal_y + wall->tangential_velocity[1]);
    double along_tangent = v * m.normal_x - u * m.normal_y;
    m.approach = -(u * m.normal_x + v * m.normal_y);
    m.arm_first = body->radius - 0.5 * m.indentation;
    m.slip = along_tangent - m.arm_first * body->spin;
    m.reduced_radius = body->radius;
    m.reduced_mass = body->mass;
    motion_advance(&m, along_tangent * step, 0, body->spin * step, step);
    return m;
}

/// NaN counts as contact, so that it is noticed.
static inline bool wall_touches(const scree_row *body, const scree_wall *wall)
{
    double gap = wall->normal[0] * body->x + wall->normal[1] * body->y - wall->position;
    return wall->active && !(body->radius <= gap);
}

#endif
