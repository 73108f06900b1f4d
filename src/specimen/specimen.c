/// What a specimen is made of: memory, bodies, contacts. The products are in products.c.
#include "specimen/specimen.h"

#include "base/memory.h"
#include "base/vectors.h"

#include <string.h>

scree_status scree_specimen_create(int dimension, size_t bodies, size_t contacts, scree_specimen *s, scree_error *error)
{
    const int components = dimension == 3 ? 6 : 3;
    *s = (scree_specimen){.dimension = dimension,
                          .components = components,
                          .strain_components = components,
                          .body_count = bodies,
                          .contact_count = contacts,
                          .condition = dimension == 3 ? SCREE_SOLID : SCREE_PLANE_STRAIN,
                          .extent = NAN};
    const struct {
        void *array;
        size_t count, size;
    } array[] = {
        {&s->mass, bodies, sizeof *s->mass},
        {&s->inertia, bodies, sizeof *s->inertia},
        {&s->radius, bodies, sizeof *s->radius},
        {&s->position, bodies, sizeof *s->position},
        {&s->volume, bodies, sizeof *s->volume},
        {&s->held, bodies, sizeof *s->held},
        {&s->compliance, bodies, sizeof *s->compliance},
        {&s->contact, contacts, sizeof *s->contact},
        {&s->strain, bodies * (size_t)components, sizeof *s->strain},
        {&s->motion, bodies * (size_t)components, sizeof *s->motion},
        {&s->force, contacts * (size_t)dimension, sizeof *s->force},
    };
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < sizeof array / sizeof *array && !status; k++)
        status = scree_allocate(array[k].array, array[k].count, array[k].size, error);
    if (status) scree_specimen_destroy(s);
    return status;
}

void scree_specimen_destroy(scree_specimen *s)
{
    scree_release(&s->mass);
    scree_release(&s->inertia);
    scree_release(&s->radius);
    scree_release(&s->position);
    scree_release(&s->volume);
    scree_release(&s->held);
    scree_release(&s->compliance);
    scree_release(&s->contact);
    scree_release(&s->strain);
    scree_release(&s->motion);
    scree_release(&s->force);
    s->body_count = s->contact_count = 0;
}

void scree_specimen_set_body(scree_specimen *s, size_t body, double radius, double density, double thickness)
{
    const bool solid = s->dimension == 3;
    const double volume = M_PI * radius * radius * (solid ? 4.0 / 3 * radius : thickness);
    s->radius[body] = radius;
    s->volume[body] = volume;
    s->mass[body] = density * volume;
    s->inertia[body] = (solid ? 0.4 : 0.5) * density * volume * radius * radius;
}

void scree_specimen_set_contact(scree_specimen *s, size_t contact, uint32_t first, uint32_t second,
                                const double branch[3], scree_springs stiffness, scree_springs damping)
{
    scree_specimen_contact *c = &s->contact[contact];
    *c = (scree_specimen_contact){.first = first, .second = second, .stiffness = stiffness, .damping = damping};
    memcpy(c->branch, branch, sizeof c->branch);
    memcpy(c->normal, branch, sizeof c->normal);
    const double distance = scree_normalise(c->normal);
    c->arm_first = distance;
    c->reach_first = s->radius[first];
    if (second == SCREE_SPECIMEN_WALL) return;
    const double half = 0.5 * (s->radius[first] + s->radius[second] - distance);
    c->arm_first = s->radius[first] - half;
    c->arm_second = s->radius[second] - half;
    c->reach_second = s->radius[second];
}

bool scree_specimen_is_deformable(const scree_specimen *s)
{
    for (size_t k = 0; k < s->body_count; k++)
        if (s->compliance[k].shear > 0) return true;
    return false;
}

bool scree_specimen_resists_slip(const scree_specimen *s)
{
    for (size_t k = 0; k < s->contact_count; k++)
        if (s->contact[k].stiffness.tangential > 0) return true;
    return false;
}

bool scree_specimen_is_damped(const scree_specimen *s)
{
    for (size_t k = 0; k < s->contact_count; k++)
        if (s->contact[k].damping.normal > 0 || s->contact[k].damping.tangential > 0) return true;
    return false;
}

bool scree_specimen_has_potential(const scree_specimen *s)
{
    return s->tangential == SCREE_TANGENTIAL_CORRECTED || !scree_specimen_is_deformable(s) ||
           !scree_specimen_resists_slip(s);
}
