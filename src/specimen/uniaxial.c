/// Compression between plates on the operator. With x0 the motion of the plates continued to all bodies (along each
/// driven axis to the place of each, those of a face to the plane of their centres) contacts are given G x0
/// (specimen/static.h), and the bodies of the faces keep it along that axis. The force on a plate is what the contacts
/// exert on its bodies, f along the axis; its mean over both plates counts (they differ by what the solution leaves
/// open). Cost: one static solution.
#include "specimen/uniaxial.h"

#include "base/memory.h"
#include "specimen/static.h"

#include <math.h>

typedef struct press {
    const scree_specimen *s; ///< as it is given
    scree_specimen between;  ///< the same between the plates
    const scree_box *box;
    unsigned axes; ///< 1 << axis: plates stand across it
    double *imposed, *motion, *offset, *force;
} press;

static void destroy(press *p)
{
    scree_specimen_destroy(&p->between);
    scree_release(&p->imposed);
    scree_release(&p->motion);
    scree_release(&p->offset);
    scree_release(&p->force);
}

static scree_status create(press *p, const scree_specimen *s, const scree_box *box, unsigned axes, scree_error *error)
{
    *p = (press){.s = s, .box = box, .axes = axes};
    scree_status status = scree_specimen_copy(s, &p->between, error);
    if (!status) status = scree_allocate(&p->imposed, scree_specimen_motions(s), sizeof(double), error);
    if (!status) status = scree_allocate(&p->motion, scree_specimen_motions(s), sizeof(double), error);
    if (!status) status = scree_allocate(&p->offset, scree_specimen_contact_forces(s), sizeof(double), error);
    return status ? status : scree_allocate(&p->force, scree_specimen_contact_forces(s), sizeof(double), error);
}

static bool drives(const press *p, int axis)
{
    return p->axes >> axis & 1U;
}

/// A unit strain along one of the axes.
static void impose_along(press *p, int axis)
{
    scree_specimen *s = &p->between;
    for (size_t body = 0; body < s->body_count; body++) {
        double *along = p->imposed + body * (size_t)s->components + axis;
        *along = s->position[body][axis];
        for (int end = 0; end < 2; end++) {
            if (!scree_box_has(p->s, p->box, body, end, axis)) continue;
            s->held[body] |= (uint8_t)(1U << axis);
            *along = p->box->plane[end][axis];
        }
    }
}

/// A unit strain along all of them; walls do not touch.
static void impose(press *p)
{
    scree_specimen *s = &p->between;
    for (int axis = 0; axis < s->dimension; axis++)
        if (drives(p, axis)) impose_along(p, axis);
    for (size_t c = 0; c < s->contact_count; c++)
        if (s->contact[c].second == SCREE_SPECIMEN_WALL) s->contact[c].stiffness = (scree_springs){0, 0};
    scree_specimen_relative(s, p->imposed, p->offset);
}

/// Sum of the components k of a motion over the bodies of a face, over their number.
static double mean_of_face(const press *p, const double *x, int end, int face, int k)
{
    double sum = 0;
    for (size_t body = 0; body < p->s->body_count; body++)
        if (scree_box_has(p->s, p->box, body, end, face)) sum += x[body * (size_t)p->s->components + (size_t)k];
    return sum / (double)p->box->count[end][face];
}

static double length(const press *p, int k)
{
    return p->box->plane[1][k] - p->box->plane[0][k];
}

/// Tension of the plates across an axis over their area: contacts pull the bodies of a face with G^T f, which
/// `imposed` takes.
static double stress(const press *p, int axis)
{
    const scree_specimen *s = p->s;
    double area = s->dimension == 2 ? s->volume[0] / (M_PI * s->radius[0] * s->radius[0]) : 1, pull = 0;
    for (int k = 0; k < s->dimension; k++)
        if (k != axis) area *= p->box->face[1][k] - p->box->face[0][k];
    for (int end = 0; end < 2; end++)
        pull +=
            (end == 0 ? 0.5 : -0.5) * (double)p->box->count[end][axis] * mean_of_face(p, p->imposed, end, axis, axis);
    return pull / area;
}

static scree_status solve(press *p, size_t *iterations, scree_error *error)
{
    impose(p);
    const scree_static_load load = {.offset = p->offset};
    scree_status status = scree_static_solve(&p->between, &load, p->motion, p->force, iterations, error);
    if (!status) scree_specimen_gather(&p->between, p->force, p->imposed);
    return status;
}

static void measure(const press *p, int axis, scree_uniaxial *out)
{
    for (int k = 0; k < p->s->dimension; k++)
        if (k != axis)
            out->poisson[k] =
                -(mean_of_face(p, p->motion, 1, k, k) - mean_of_face(p, p->motion, 0, k, k)) / length(p, k);
    out->young = stress(p, axis);
}

scree_status scree_specimen_press(const scree_specimen *s, const scree_box *box, int axis, scree_uniaxial *out,
                                  scree_error *error)
{
    press p;
    *out = (scree_uniaxial){NAN, {NAN, NAN, NAN}, 0};
    scree_status status = create(&p, s, box, 1U << axis, error);
    if (!status) status = solve(&p, &out->iterations, error);
    if (!status) measure(&p, axis, out);
    destroy(&p);
    return status;
}

scree_status scree_specimen_press_all(const scree_specimen *s, const scree_box *box, double *bulk, size_t *iterations,
                                      scree_error *error)
{
    press p;
    double sum = 0;
    *bulk = NAN;
    scree_status status = create(&p, s, box, (1U << s->dimension) - 1, error);
    if (!status) status = solve(&p, iterations, error);
    for (int axis = 0; axis < s->dimension && !status; axis++) sum += stress(&p, axis);
    if (!status) *bulk = sum / (s->dimension * s->dimension);
    destroy(&p);
    return status;
}
