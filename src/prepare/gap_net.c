/// Edges from simplices (search/simplices.h) of the bodies and of the images of those near a face: mirrored at walls,
/// shifted across periodic faces, and both in edges and corners.
#include "prepare/gap_net.h"

#include "search/simplices.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum { MOST_COPIES = 27 };
/// Images reach as far from the box as this many mean radii, or two of the largest.
static const double REACH = 5;

/// Bodies, then images.
typedef struct cloud {
    double *point, *radius;
    uint32_t *parent;
    uint8_t *copy; ///< of 3^dimension: one less than -1, 0, 1 along each axis in base 3
    size_t count, capacity;
} cloud;

static void destroy_cloud(cloud *c)
{
    scree_release(&c->point);
    scree_release(&c->radius);
    scree_release(&c->parent);
    scree_release(&c->copy);
}

static scree_status grow_cloud(cloud *c, int dimension, size_t capacity, scree_error *error)
{
    const size_t d = (size_t)dimension;
    scree_status status = scree_reallocate(&c->point, d * c->count, d * capacity, sizeof *c->point, error);
    if (!status) status = scree_reallocate(&c->radius, c->count, capacity, sizeof *c->radius, error);
    if (!status) status = scree_reallocate(&c->parent, c->count, capacity, sizeof *c->parent, error);
    if (!status) status = scree_reallocate(&c->copy, c->count, capacity, sizeof *c->copy, error);
    if (!status) c->capacity = capacity;
    return status;
}

/// -1, 0 or 1: below, in, or above the box along an axis.
static int cell_of(int copy, int axis)
{
    for (int k = 0; k < axis; k++) copy /= 3;
    return copy % 3 - 1;
}

/// Where the image of a body lies; false: too far from the box to matter.
static bool place_image(const scree_gap_bodies *b, size_t body, int copy, double reach, double place[3])
{
    const double *at = b->at + body * (size_t)(b->dimension + 1);
    for (int k = 0; k < b->dimension; k++) {
        const int cell = cell_of(copy, k);
        place[k] = at[k];
        if (b->periodic >> k & 1)
            place[k] += cell * b->side[k];
        else if (cell)
            place[k] = (cell > 0 ? 2 * b->side[k] : 0) - at[k];
        if (cell && (place[k] < -reach || place[k] > b->side[k] + reach)) return false;
    }
    return true;
}

static scree_status append(cloud *c, int dimension, size_t parent, int copy, double radius, const double place[3],
                           scree_error *error)
{
    if (c->count == c->capacity) {
        scree_status status = grow_cloud(c, dimension, c->capacity + c->capacity / 2 + 64, error);
        if (status) return status;
    }
    for (int k = 0; k < dimension; k++) c->point[c->count * (size_t)dimension + (size_t)k] = place[k];
    c->radius[c->count] = radius;
    c->parent[c->count] = (uint32_t)parent;
    c->copy[c->count++] = (uint8_t)copy;
    return SCREE_OK;
}

static scree_status fill_cloud(const scree_gap_bodies *b, cloud *c, scree_error *error)
{
    const size_t width = (size_t)b->dimension + 1;
    const int copies = b->dimension == 3 ? MOST_COPIES : MOST_COPIES / 3, own = copies / 2;
    double mean = 0, largest = 0, place[3];
    scree_status status = grow_cloud(c, b->dimension, 2 * b->count, error);
    for (size_t i = 0; i < b->count; i++) {
        const double radius = b->at[i * width + width - 1];
        mean += radius / (double)b->count;
        largest = fmax(largest, radius);
        if (!status) status = append(c, b->dimension, i, own, radius, b->at + i * width, error);
    }
    const double reach = fmax(REACH * mean, 2 * largest);
    for (size_t i = 0; i < b->count && !status; i++)
        for (int copy = 0; copy < copies && !status; copy++)
            if (copy != own && place_image(b, i, copy, reach, place))
                status = append(c, b->dimension, i, copy, c->radius[i], place, error);
    return status;
}

/// An edge of the triangulation of bodies and images; first is a body.
typedef struct raw_edge {
    uint32_t first, second;
} raw_edge;

static int compare(const void *a, const void *b)
{
    const raw_edge *p = a, *q = b;
    if (p->first != q->first) return p->first < q->first ? -1 : 1;
    return p->second < q->second ? -1 : p->second > q->second;
}

/// Edges of which one end is a body, ordered, each once.
static scree_status list_edges(const scree_simplices *simplices, size_t corners, size_t bodies, raw_edge **edge,
                               size_t *count, scree_error *error)
{
    size_t found = 0;
    scree_status status = scree_allocate(edge, simplices->count * corners * (corners - 1) / 2, sizeof **edge, error);
    if (status) return status;
    for (size_t s = 0; s < simplices->count; s++)
        for (size_t i = 0; i < corners; i++)
            for (size_t k = i + 1; k < corners; k++) {
                const uint32_t u = simplices->vertex[corners * s + i], v = simplices->vertex[corners * s + k];
                const raw_edge pair = {u < v ? u : v, u < v ? v : u};
                if (pair.first < bodies) (*edge)[found++] = pair;
            }
    qsort(*edge, found, sizeof **edge, compare);
    *count = 0;
    for (size_t k = 0; k < found; k++)
        if (k == 0 || compare(&(*edge)[k], &(*edge)[k - 1]) != 0) (*edge)[(*count)++] = (*edge)[k];
    return SCREE_OK;
}

/// The wall in which this image is the mirror image of a body; -1: it is none, or one of several walls. *mirrored: it
/// is one at all.
static int mirror_of(const scree_gap_bodies *b, int copy, bool *mirrored)
{
    int wall = -1, cells = 0;
    *mirrored = false;
    for (int k = 0; k < b->dimension; k++) {
        const int cell = cell_of(copy, k);
        if (!cell) continue;
        cells++;
        *mirrored = *mirrored || !(b->periodic >> k & 1);
        wall = 2 * k + (cell > 0);
    }
    return *mirrored && cells == 1 ? wall : -1;
}

/// beside: bit w of each body: it is beside the wall w.
static void add_edge(const scree_gap_bodies *b, const cloud *c, const raw_edge *raw, scree_gap_net *net,
                     uint8_t *beside)
{
    const uint32_t parent = c->parent[raw->second];
    bool mirrored;
    const int wall = mirror_of(b, c->copy[raw->second], &mirrored);
    if (mirrored) {
        if (parent == raw->first && wall >= 0) beside[parent] |= (uint8_t)(1U << wall);
        return;
    }
    // The image of an edge that is there across the opposite face.
    if (parent <= raw->first) return;
    scree_gap_edge *edge = &net->edge[net->edge_count++];
    *edge = (scree_gap_edge){.first = raw->first, .second = parent};
    for (int k = 0; k < b->dimension; k++) edge->shift[k] = cell_of(c->copy[raw->second], k) * b->side[k];
}

/// Those that reach into a wall are beside it, too, also where others hide their mirror images.
static scree_status list_touches(const scree_gap_bodies *b, const uint8_t *beside, scree_gap_net *net,
                                 scree_error *error)
{
    const int d = b->dimension;
    scree_status status = scree_allocate(&net->touch, b->count * 2 * (size_t)d, sizeof *net->touch, error);
    for (uint32_t i = 0; i < b->count && !status; i++)
        for (int k = 0; k < 2 * d; k++) {
            const scree_gap_touch touch = {i,
                                           k < d ? 2 * (d - 1 - k) : 2 * (k - d) + 1}; // in the order of their images
            if (b->periodic >> touch.wall / 2 & 1) continue;
            if (beside[i] >> touch.wall & 1 || scree_gap_of_touch(b, &touch) < 0)
                net->touch[net->touch_count++] = touch;
        }
    return status;
}

scree_status scree_gap_net_build(const scree_gap_bodies *bodies, scree_gap_net *net, scree_error *error)
{
    cloud c = {0};
    scree_simplices simplices = {0};
    raw_edge *edge = NULL;
    uint8_t *beside = NULL;
    size_t count = 0;
    const size_t corners = (size_t)bodies->dimension + 1;
    *net = (scree_gap_net){0};
    scree_status status = fill_cloud(bodies, &c, error);
    if (!status)
        status = scree_simplices_build_weighted(c.point, c.radius, c.count, bodies->dimension, &simplices, error);
    if (!status) status = list_edges(&simplices, corners, bodies->count, &edge, &count, error);
    if (!status) status = scree_allocate(&net->edge, count, sizeof *net->edge, error);
    if (!status) status = scree_allocate(&beside, bodies->count, sizeof *beside, error);
    for (size_t k = 0; k < count && !status; k++) add_edge(bodies, &c, &edge[k], net, beside);
    if (!status) status = list_touches(bodies, beside, net, error);
    if (!status) net->hole = scree_gap_hole_find(&simplices, c.point, c.radius, bodies->dimension, bodies->side);
    scree_release(&edge);
    scree_release(&beside);
    scree_release(&simplices.vertex);
    scree_release(&simplices.neighbour);
    destroy_cloud(&c);
    if (status) scree_gap_net_destroy(net);
    return status;
}

void scree_gap_net_destroy(scree_gap_net *net)
{
    scree_release(&net->edge);
    scree_release(&net->touch);
    *net = (scree_gap_net){0};
}

double scree_gap_of_edge(const scree_gap_bodies *bodies, const scree_gap_edge *edge, double normal[3])
{
    const size_t width = (size_t)bodies->dimension + 1;
    const double *a = bodies->at + edge->first * width, *b = bodies->at + edge->second * width;
    double square = 0;
    for (int k = 0; k < bodies->dimension; k++) {
        normal[k] = a[k] - b[k] - edge->shift[k];
        square += normal[k] * normal[k];
    }
    const double distance = sqrt(square);
    for (int k = 0; k < bodies->dimension; k++) normal[k] = distance > 0 ? normal[k] / distance : k == 0;
    return distance - a[bodies->dimension] - b[bodies->dimension];
}

double scree_gap_of_touch(const scree_gap_bodies *bodies, const scree_gap_touch *touch)
{
    const double *at = bodies->at + touch->body * (size_t)(bodies->dimension + 1);
    const int axis = touch->wall / 2;
    return (touch->wall % 2 ? bodies->side[axis] - at[axis] : at[axis]) - at[bodies->dimension];
}
