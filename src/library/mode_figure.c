/// The fastest mode of a specimen as a figure: particles where they stand, what they do at the critical step as arrows
/// and how they turn as colours. In space a cut along x and z through the particle that is nearest to the middle: in a
/// lattice through a layer, and not between two.
#include "library/handle.h"
#include "library/specimen.h"
#include "specimen/stability.h"

#include "base/memory.h"
#include "view/scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/// A mode that turns less than this, over the largest movement, is shown by its movement alone.
#define TURNS 1e-3

/// A specimen in its order, flat, as a snapshot that a scene can draw; arrays of one block.
typedef struct picture {
    scree_snapshot snapshot;
    double *block;
    double *arrow[2], *field;
    bool turns, cut;
} picture;

/// y of the particle that is nearest to the mean of all.
static double middle_of(const scree_specimen *s)
{
    double mean = 0, nearest = INFINITY;
    for (size_t k = 0; k < s->body_count; k++) mean += s->position[k][1] / (double)s->body_count;
    for (size_t k = 0; k < s->body_count; k++)
        if (fabs(s->position[k][1] - mean) < fabs(nearest - mean)) nearest = s->position[k][1];
    return nearest;
}

static scree_status open_picture(const scree_specimen *s, picture *p, scree_error *error)
{
    const size_t n = s->body_count;
    *p = (picture){.snapshot = {.dimension = 2, .count = n, .axial_strain = NAN}, .cut = s->dimension == 3};
    scree_status status = scree_allocate(&p->block, 6 * n + 1, sizeof *p->block, error);
    if (status) return status;
    double **array[] = {&p->snapshot.x, &p->snapshot.y, &p->snapshot.radius, &p->arrow[0], &p->arrow[1], &p->field};
    for (size_t k = 0; k < sizeof array / sizeof *array; k++) *array[k] = p->block + k * n;
    const double middle = p->cut ? middle_of(s) : 0;
    for (size_t k = 0; k < n; k++) {
        const double away = p->cut ? s->position[k][1] - middle : 0, square = s->radius[k] * s->radius[k] - away * away;
        p->snapshot.x[k] = s->position[k][0];
        p->snapshot.y[k] = s->position[k][p->cut ? 2 : 1];
        p->snapshot.radius[k] = square > 0 ? sqrt(square) : 0;
    }
    return SCREE_OK;
}

/// Movement and turning of the mode, both over the largest movement of a surface; in space those in the plane x, z.
static void fill_picture(const scree_specimen *s, const double *mode, picture *p)
{
    const size_t width = (size_t)s->components;
    const int up = s->dimension - 1;
    double largest = 0, turned = 0;
    for (size_t k = 0; k < s->body_count; k++) {
        const double *x = mode + k * width;
        p->arrow[0][k] = x[0];
        p->arrow[1][k] = x[up];
        p->field[k] = s->radius[k] * (s->dimension == 3 ? x[4] : x[2]);
        turned = fmax(turned, fabs(p->field[k]));
        largest = fmax(largest, fmax(turned, hypot(x[0], x[up])));
    }
    p->turns = turned > TURNS * largest;
    for (size_t k = 0; k < s->body_count && largest > 0; k++) {
        // As lengths they are of no size: a mean radius is the largest.
        p->arrow[0][k] *= s->radius[0] / largest;
        p->arrow[1][k] *= s->radius[0] / largest;
        p->field[k] = p->turns ? p->field[k] / largest : hypot(p->arrow[0][k], p->arrow[1][k]) / s->radius[0];
    }
}

static scree_status draw_picture(const picture *p, double step, const char *path, scree_error *error)
{
    char title[160];
    (void)snprintf(title, sizeof title, "Fastest mode, critical at a step of %.5g s", step);
    const scree_scene scene = {.title = title,
                               .field = p->field,
                               .field_name = p->turns ? "turning of the surface over the largest movement (1)"
                                                      : "movement over the largest (1)",
                               .map = p->turns ? SCREE_COLOUR_DIVERGING : SCREE_COLOUR_SEQUENTIAL,
                               .arrow_x = p->arrow[0],
                               .arrow_y = p->arrow[1],
                               .arrow_scale = 1,
                               .arrows_have_no_size = true,
                               .section = p->cut};
    return scree_scene_draw(path, &p->snapshot, &scene, error);
}

/// Rigid, or with explicit strains; where no step bears these, the rigid one again.
static scree_status find_mode(const scree_specimen *s, double *step, double *mode, scree_error *error)
{
    double radius;
    scree_status status = scree_spectral_radius(s, &radius, NULL, error);
    const bool lagged = radius > 0 && radius < 1;
    if (!status)
        status =
            scree_critical_step(s, lagged ? scree_strain_explicit(radius) : scree_strain_rigid(), step, mode, error);
    return status;
}

scree_status scree_simulation_draw_mode(scree_simulation *simulation, const scree_particle_elasticity *elasticity,
                                        const char *path, scree_error *error)
{
    scree_specimen s;
    picture p = {.block = NULL};
    double *mode = NULL, step;
    scree_status status = library_specimen(simulation, elasticity, &s, error);
    if (!status) status = scree_allocate(&mode, scree_specimen_motions(&s), sizeof *mode, error);
    if (!status) status = find_mode(&s, &step, mode, error);
    if (!status && !(step > 0 && isfinite(step)))
        status = scree_error_set(error, SCREE_ERROR_INPUT, "nothing vibrates: there is no contact");
    if (!status) status = open_picture(&s, &p, error);
    if (!status) {
        fill_picture(&s, mode, &p);
        status = draw_picture(&p, step, path, error);
    }
    scree_release(&p.block);
    scree_release(&mode);
    scree_specimen_destroy(&s);
    return status;
}
