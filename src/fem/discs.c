/// Two discs in contact: of each the half on the side of the contact, of that, by symmetry, the half at x >= 0;
/// elements of eight nodes, contact by the solver between the two circles (surface to surface, linear penalty, no
/// friction), small strains. The planes through the centres come closer in equal increments, with equal and opposite
/// displacements; across they are free.
///
/// Plane stress: CalculiX gives plane elements a thickness and elements of a solid; only a thickness far below what the
/// stresses vary over, which is the contact, leaves the stress across at zero, so the discs are that thin and forces
/// are scaled. The penalty is 1000 E over half the width of the contact: discs enter each other by a ten-thousandth of
/// the approach.
///
/// Where they end is told by the closed form (theory/line_contact.h) for a force somewhat larger than the one asked
/// for; results at that force are interpolated between two increments. docs/theory/ddem.md: convergence with the mesh.
#include "base/memory.h"
#include "fem/disc_mesh.h"
#include "fem/solid.h"
#include "fem/solve.h"
#include "theory/line_contact.h"

#include <math.h>
#include <string.h>

/// Side of the fine square over half the width of the contact, approach at the end over that of the closed form,
/// thickness of plane stress over the size of the finest elements, penalty.
#define FINE    2.0
#define BEYOND  1.04
#define SLICE   0.25
#define PENALTY 1000.0

typedef struct pair {
    const scree_fem_discs *discs;
    scree_fem_disc_mesh mesh; ///< of the upper one
    double width;             ///< m, half of the contact
    double thickness;         ///< m
    double end;               ///< m, approach
} pair;

static scree_line_contact closed_form(const scree_fem_discs *d)
{
    return (scree_line_contact){.radius = d->radius,
                                .young_modulus = d->young_modulus,
                                .poisson_ratio = d->poisson_ratio,
                                .plane_stress = d->plane_stress,
                                .force = d->force};
}

// ---- deck --------------------------------------------------------------------------------------------------------

static void write_nodes(FILE *deck, const scree_fem_disc_mesh *m)
{
    fputs("*NODE, NSET=ALL\n", deck);
    for (int lower = 0; lower < 2; lower++)
        for (size_t k = 0; k < m->node_count; k++)
            if (!isnan(m->place[k][0]))
                fprintf(deck, "%zu, %.12e, %.12e, 0\n", k + 1 + (lower ? m->node_count : 0), m->place[k][0],
                        lower ? -m->place[k][1] : m->place[k][1]);
}

/// The lower disc is the mirror image, so its corners go round the other way.
static void write_elements(FILE *deck, const scree_fem_disc_mesh *m, bool plane_stress)
{
    static const int image[SCREE_FEM_NODES] = {0, 3, 2, 1, 7, 6, 5, 4};
    fprintf(deck, "*ELEMENT, TYPE=%s, ELSET=DISCS\n", plane_stress ? "CPS8" : "CPE8");
    for (int lower = 0; lower < 2; lower++)
        for (size_t e = 0; e < m->element_count; e++) {
            fprintf(deck, "%zu", e + 1 + (lower ? m->element_count : 0));
            for (int k = 0; k < SCREE_FEM_NODES; k++)
                fprintf(deck, ", %lld",
                        (long long)(lower ? m->element[e][image[k]] + (int64_t)m->node_count : m->element[e][k]));
            fputs("\n", deck);
        }
}

static void write_surfaces(FILE *deck, const scree_fem_disc_mesh *m)
{
    for (int lower = 0; lower < 2; lower++) {
        fprintf(deck, "*SURFACE, NAME=%s, TYPE=ELEMENT\n", lower ? "LOWER" : "UPPER");
        for (size_t k = 0; k < m->rim_count; k++)
            fprintf(deck, "%lld, S%d\n", (long long)(m->rim[k].element + (lower ? (int64_t)m->element_count : 0)),
                    lower ? 5 - m->rim[k].side : m->rim[k].side);
    }
}

static void write_rest(FILE *deck, const pair *p)
{
    const scree_fem_discs *d = p->discs;
    fprintf(deck, "*MATERIAL, NAME=SOLID\n*ELASTIC\n%.12e, %.12e\n", d->young_modulus, d->poisson_ratio);
    fprintf(deck, "*SOLID SECTION, ELSET=DISCS, MATERIAL=SOLID\n%.12e\n", p->thickness);
    fputs("*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE\nUPPER, LOWER\n*SURFACE INTERACTION, NAME=TOUCH\n",
          deck);
    fprintf(deck, "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n%.12e\n", PENALTY * d->young_modulus / p->width);
    fputs("*BOUNDARY\nAXIS, 1, 1\n", deck);
    fprintf(deck, "*STEP, INC=%lld\n*STATIC, DIRECT\n%.12e, 1\n", (long long)(2 * d->steps), 1 / (double)d->steps);
    fprintf(deck, "*BOUNDARY\nTOP, 2, 2, %.12e\nBOTTOM, 2, 2, %.12e\n", -0.5 * p->end, 0.5 * p->end);
    fputs("*NODE PRINT, NSET=TOP, TOTALS=ONLY\nRF\n*NODE PRINT, NSET=SIDE\nU\n*NODE PRINT, NSET=LINE\nU\n*END STEP\n",
          deck);
}

static void write_deck(FILE *deck, const pair *p)
{
    const scree_fem_disc_mesh *m = &p->mesh;
    const int64_t lower = (int64_t)m->node_count;
    fprintf(deck, "** Halves of two discs in contact: plane %s, SI units, forces of a slice of %.6g m\n",
            p->discs->plane_stress ? "stress" : "strain", p->thickness);
    write_nodes(deck, m);
    write_elements(deck, m, p->discs->plane_stress);
    scree_fem_deck_set(deck, "LINE", m->axis, m->axis_count, 0);
    scree_fem_deck_set(deck, "IMAGE", m->axis, m->axis_count, lower);
    scree_fem_deck_set(deck, "TOP", m->flat, m->flat_count, 0);
    scree_fem_deck_set(deck, "BOTTOM", m->flat, m->flat_count, lower);
    scree_fem_deck_set(deck, "SIDE", &m->flat[m->flat_count - 1], 1, 0);
    fputs("*NSET, NSET=AXIS\nLINE, IMAGE\n", deck);
    write_surfaces(deck, m);
    write_rest(deck, p);
}

// ---- results -----------------------------------------------------------------------------------------------------

/// What the increments print: force, outward displacement of the side, displacements along the line of the centres.
typedef struct reading {
    const pair *p;
    size_t room, count;          ///< increments, the first without force
    double time;                 ///< of the last
    double *force, *side, *line; ///< N/m, m, m: axis_count an increment
} reading;

static void visit(void *user, const scree_fem_row *row)
{
    reading *r = user;
    const scree_fem_disc_mesh *m = &r->p->mesh;
    if (row->time > r->time && r->count < r->room) {
        r->time = row->time;
        r->count++;
    }
    const size_t now = r->count - 1;
    // Half of the discs is there; what holds the plane up there pushes it down.
    if (row->total) r->force[now] = -2 * row->value[1] / r->p->thickness;
    if (strcmp(row->set, "SIDE") == 0) r->side[now] = 2 * row->value[0];
    if (strcmp(row->set, "LINE") != 0) return;
    for (size_t k = 0; k < m->axis_count; k++)
        if (m->axis[k] == row->node) r->line[now * m->axis_count + k] = row->value[1];
}

/// Increment before the force asked for, and the part of the way to the next one. False: it is not between any two.
static bool find_force(const reading *r, double force, size_t *before, double *part)
{
    for (*before = 0; *before + 1 < r->count; ++*before) {
        const double low = r->force[*before], high = r->force[*before + 1];
        *part = (force - low) / (high - low);
        if (low <= force && force <= high && high > low) return true;
    }
    return false;
}

static double between(const double *value, size_t stride, size_t before, double part)
{
    return (1 - part) * value[before * stride] + part * value[(before + 1) * stride];
}

/// Strain in the middles of the elements along the axis: there the difference of the corners is that of the element.
static void find_strains(const reading *r, size_t before, double part, scree_fem_discs_result *out)
{
    const scree_fem_disc_mesh *m = &r->p->mesh;
    for (size_t k = 0; k + 2 < m->axis_count; k += 2) {
        const double low = m->place[m->axis[k] - 1][1], high = m->place[m->axis[k + 2] - 1][1];
        out->depth[out->axis_count] = 0.5 * (low + high);
        out->strain[out->axis_count++] = (between(r->line + k + 2, m->axis_count, before, part) -
                                          between(r->line + k, m->axis_count, before, part)) /
                                         (high - low);
    }
}

static scree_status take_results(const reading *r, scree_fem_discs_result *out, scree_error *error)
{
    size_t before;
    double part;
    const scree_fem_discs *d = r->p->discs;
    scree_status status = scree_allocate(&out->approach, r->count, sizeof(double), error);
    if (!status) status = scree_allocate(&out->force, r->count, sizeof(double), error);
    if (!status) status = scree_allocate(&out->depth, r->p->mesh.axis_count, sizeof(double), error);
    if (!status) status = scree_allocate(&out->strain, r->p->mesh.axis_count, sizeof(double), error);
    if (status) return status;
    for (out->count = 0; out->count < r->count; out->count++) {
        out->approach[out->count] = r->p->end * (double)out->count / (double)d->steps;
        out->force[out->count] = r->force[out->count];
    }
    if (!find_force(r, d->force, &before, &part))
        return scree_error_set(error, SCREE_ERROR_IO,
                               "the finite elements reach %.6g of %.6g N/m at an approach of %.6g m",
                               r->force[r->count - 1], d->force, r->p->end);
    out->at_force = between(out->approach, 1, before, part);
    out->widening = between(r->side, 1, before, part);
    find_strains(r, before, part, out);
    return SCREE_OK;
}

static scree_status read_results(const char *directory, const pair *p, scree_fem_discs_result *out, scree_error *error)
{
    reading r = {.p = p, .room = (size_t)p->discs->steps + 1, .count = 1};
    scree_status status = scree_allocate(&r.force, r.room, sizeof(double), error);
    if (!status) status = scree_allocate(&r.side, r.room, sizeof(double), error);
    if (!status) status = scree_allocate(&r.line, r.room * p->mesh.axis_count, sizeof(double), error);
    if (!status) status = scree_fem_read(directory, visit, &r, error);
    if (!status) status = take_results(&r, out, error);
    scree_release(&r.force);
    scree_release(&r.side);
    scree_release(&r.line);
    return status;
}

void scree_fem_discs_result_destroy(scree_fem_discs_result *result)
{
    scree_release(&result->approach);
    scree_release(&result->force);
    scree_release(&result->depth);
    scree_release(&result->strain);
    *result = (scree_fem_discs_result){0};
}

scree_status scree_fem_discs_solve(const char *directory, const scree_fem_discs *discs, scree_fem_discs_result *result,
                                   scree_error *error)
{
    const scree_line_contact form = closed_form(discs);
    FILE *deck;
    pair p = {.discs = discs,
              .width = scree_line_contact_half_width(&form),
              .end = BEYOND * scree_line_contact_approach(&form)};
    *result = (scree_fem_discs_result){0};
    // Of strains in the plane nothing depends on the depth.
    p.thickness = discs->plane_stress ? SLICE * p.width / (double)discs->elements : discs->radius;
    scree_status status =
        scree_fem_disc_mesh_make(discs->radius, FINE * p.width, (int64_t)FINE * discs->elements, &p.mesh, error);
    if (status) return status;
    status = scree_fem_deck_open(directory, &deck, error);
    if (!status) {
        write_deck(deck, &p);
        status = scree_fem_deck_solve(directory, deck, error);
    }
    if (!status) status = read_results(directory, &p, result, error);
    scree_fem_disc_mesh_destroy(&p.mesh);
    if (status) scree_fem_discs_result_destroy(result);
    return status;
}
