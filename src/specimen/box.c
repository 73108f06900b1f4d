/// Faces of a box. A body is of a face when its surface comes nearer to it than 0.9 mean radii (less
/// than the second row of a hexagonal lattice). The planes through
/// the mean centres of these bodies bound the piece whose strain is imposed; in a square lattice the sums over its
/// contacts, with half of those within a face and a quarter of those within an edge, are those of the unbounded
/// lattice.
#include "specimen/box.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

/// Of a mean radius.
#define NEAR 0.9
/// Least share of a face that is covered by its bodies, each of them a square of one mean diameter.
#define COVERED 0.5

static void find_faces(const scree_specimen *s, const scree_box_faces *faces, scree_box *b)
{
    *b = (scree_box){.dimension = s->dimension};
    for (int k = 0; k < s->dimension; k++) {
        b->face[0][k] = INFINITY;
        b->face[1][k] = -INFINITY;
    }
    for (size_t body = 0; body < s->body_count; body++) {
        b->radius += s->radius[body] / (double)s->body_count;
        for (int k = 0; k < s->dimension; k++) {
            b->face[0][k] = fmin(b->face[0][k], s->position[body][k] - s->radius[body]);
            b->face[1][k] = fmax(b->face[1][k], s->position[body][k] + s->radius[body]);
        }
    }
    for (int end = 0; end < 2; end++)
        for (int k = 0; k < s->dimension; k++)
            if (!isnan(faces->end[end][k])) b->face[end][k] = faces->end[end][k];
}

bool scree_box_has(const scree_specimen *s, const scree_box *b, size_t body, int end, int k)
{
    const double distance = fabs(s->position[body][k] - b->face[end][k]) - s->radius[body];
    return distance < NEAR * b->radius;
}

static void find_planes(const scree_specimen *s, scree_box *b)
{
    for (int end = 0; end < 2; end++)
        for (int k = 0; k < s->dimension; k++) {
            double sum = 0;
            for (size_t body = 0; body < s->body_count; body++) {
                if (!scree_box_has(s, b, body, end, k)) continue;
                sum += s->position[body][k];
                b->count[end][k]++;
            }
            b->plane[end][k] = sum / (double)b->count[end][k];
        }
}

static scree_status check_faces(const scree_box *b, scree_error *error)
{
    for (int end = 0; end < 2; end++)
        for (int k = 0; k < b->dimension; k++) {
            double places = 1;
            for (int i = 0; i < b->dimension; i++)
                if (i != k) places *= fmax((b->face[1][i] - b->face[0][i]) / (2 * b->radius), 1);
            if ((double)b->count[end][k] >= COVERED * places && b->plane[1][k] > b->plane[0][k]) continue;
            return scree_error_set(
                error, SCREE_ERROR_INPUT,
                "moduli are those of a sample that is periodic in all directions, or fills a box: at "
                "the %s end along %c there are %zu particles, where some %.0f have room",
                end ? "upper" : "lower", "xyz"[k], b -> count[end][k], places);
        }
    return SCREE_OK;
}

scree_status scree_specimen_find_box(const scree_specimen *s, const scree_box_faces *faces, scree_box *b,
                                     scree_error *error)
{
    if (s->periodic)
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "moduli are those of a sample that is periodic in all directions, or in none");
    find_faces(s, faces, b);
    find_planes(s, b);
    return check_faces(b, error);
}

/// Faces that both bodies are of; with one body twice, its own.
static int common_faces(const scree_specimen *s, const scree_box *b, size_t body, size_t other)
{
    int count = 0;
    for (int end = 0; end < 2; end++)
        for (int k = 0; k < s->dimension; k++)
            count += scree_box_has(s, b, body, end, k) && scree_box_has(s, b, other, end, k);
    return count;
}

scree_status scree_specimen_copy(const scree_specimen *s, scree_specimen *out, scree_error *error)
{
    scree_status status = scree_specimen_create(s->dimension, s->body_count, s->contact_count, out, error);
    if (status) return status;
    memcpy(out->mass, s->mass, s->body_count * sizeof *s->mass);
    memcpy(out->inertia, s->inertia, s->body_count * sizeof *s->inertia);
    memcpy(out->radius, s->radius, s->body_count * sizeof *s->radius);
    memcpy(out->position, s->position, s->body_count * sizeof *s->position);
    memcpy(out->volume, s->volume, s->body_count * sizeof *s->volume);
    memcpy(out->compliance, s->compliance, s->body_count * sizeof *s->compliance);
    memcpy(out->contact, s->contact, s->contact_count * sizeof *s->contact);
    out->tangential = s->tangential;
    out->condition = s->condition;
    out->dashpots_strain = s->dashpots_strain;
    return SCREE_OK;
}

static void weaken(scree_specimen_contact *contact, double share)
{
    contact->stiffness.normal *= share;
    contact->stiffness.tangential *= share;
}

scree_status scree_specimen_cut_box(const scree_specimen *s, const scree_box *b, scree_specimen *out,
                                    scree_error *error)
{
    *out = (scree_specimen){0};
    scree_status status = scree_specimen_copy(s, out, error);
    if (status) return status;
    for (size_t body = 0; body < s->body_count; body++)
        if (common_faces(s, b, body, body) > 0) out->held[body] = 1 | 2 | 4;
    for (size_t c = 0; c < s->contact_count; c++) {
        scree_specimen_contact *contact = &out->contact[c];
        const bool wall = contact->second == SCREE_SPECIMEN_WALL;
        weaken(contact, wall ? 0 : ldexp(1, -common_faces(s, b, contact->first, contact->second)));
    }
    // Discs are volume over area long.
    out->extent = s->dimension == 2 ? s->volume[0] / (M_PI * s->radius[0] * s->radius[0]) : 1;
    for (int k = 0; k < s->dimension; k++) out->extent *= b->plane[1][k] - b->plane[0][k];
    return SCREE_OK;
}

double scree_specimen_box_density(const scree_specimen *s, const scree_box_faces *faces)
{
    scree_box b;
    scree_error ignored;
    double mass = 0, extent = s->dimension == 2 ? s->volume[0] / (M_PI * s->radius[0] * s->radius[0]) : 1;
    if (scree_specimen_find_box(s, faces, &b, &ignored)) return NAN;
    for (size_t body = 0; body < s->body_count; body++) mass += ldexp(s->mass[body], -common_faces(s, &b, body, body));
    for (int k = 0; k < s->dimension; k++) extent *= b.plane[1][k] - b.plane[0][k];
    return mass / extent;
}
