/// Closest points on a mesh and the search in its tree. The construction is in mesh_build.c.
/// Closest point of a triangle: by the signs of its barycentric regions (Ericson 2005, Real-Time Collision Detection,
/// 5.1.5).
#include "shape/mesh.h"

#include "base/vectors.h"

#include <string.h>

/// Relative, of squared distances: feet closer to an edge than 1e-6 of their height may be claimed by both.
#define MINIMUM_TOLERANCE 1e-12
enum { DEEPEST = 64 };

void scree_mesh_destroy(scree_mesh *mesh)
{
    void *const arrays[] = {&mesh->vertex,      &mesh->edge,       &mesh->triangle,  &mesh->triangle_edge,
                            &mesh->normal,      &mesh->edge_begin, &mesh->edge_list, &mesh->vertex_begin,
                            &mesh->vertex_list, &mesh->node,       &mesh->order};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) scree_release(arrays[k]);
    *mesh = (scree_mesh){0};
}

/// Squared distance to the segment from a to b, and the fraction of the way at which the closest point lies.
static double segment_distance(const double a[3], const double b[3], const double place[3], double *fraction)
{
    double side[3], from[3], closest[3];
    scree_subtract(b, a, side);
    scree_subtract(place, a, from);
    double t = scree_dot(from, side) / scree_dot(side, side);
    *fraction = t < 0 ? 0 : t > 1 ? 1 : t;
    scree_along(a, *fraction, side, closest);
    scree_subtract(place, closest, from);
    return scree_dot(from, from);
}

/// Squared distance to a triangle; *inside: the foot of the centre lies in it.
static double triangle_distance(const scree_mesh *mesh, size_t t, const double place[3], bool *inside)
{
    const uint32_t *corner = mesh->triangle[t];
    const double *normal = mesh->normal[t];
    double least = INFINITY, fraction, from[3];
    *inside = true;
    for (int k = 0; k < 3; k++) {
        const double *a = mesh->vertex[corner[k]], *b = mesh->vertex[corner[(k + 1) % 3]];
        double side[3], outward[3];
        scree_subtract(b, a, side);
        scree_cross(side, normal, outward);
        scree_subtract(place, a, from);
        if (scree_dot(from, outward) <= 0) continue;
        // Outside this side: the closest point lies on one of the sides that the foot is outside of.
        *inside = false;
        least = fmin(least, segment_distance(a, b, place, &fraction));
    }
    if (!*inside) return least;
    scree_subtract(place, mesh->vertex[corner[0]], from);
    double height = scree_dot(from, normal);
    return height * height;
}

/// No triangle of list[begin .. end) comes closer than the squared distance.
static bool is_minimum(const scree_mesh *mesh, const uint32_t *list, uint32_t begin, uint32_t end,
                       const double place[3], double square)
{
    bool inside;
    for (uint32_t k = begin; k < end; k++)
        if (triangle_distance(mesh, list[k], place, &inside) < square * (1 - MINIMUM_TOLERANCE)) return false;
    return true;
}

static void closest_on_face(const scree_mesh *mesh, size_t t, const double place[3], scree_closest_point *closest)
{
    double from[3];
    scree_subtract(place, mesh->vertex[mesh->triangle[t][0]], from);
    double height = scree_dot(from, mesh->normal[t]), sign = height < 0 ? -1 : 1;
    (void)triangle_distance(mesh, t, place, &closest->minimum);
    closest->distance = sign * height;
    for (int k = 0; k < 3; k++) closest->normal[k] = sign * mesh->normal[t][k];
}

/// From a point of the mesh to the centre; `triangle` has it in its plane.
static void closest_on_point(const scree_mesh *mesh, const double point[3], size_t triangle, const double place[3],
                             scree_closest_point *closest)
{
    scree_subtract(place, point, closest->normal);
    closest->distance = scree_normalise(closest->normal);
    if (!(closest->distance > 0)) memcpy(closest->normal, mesh->normal[triangle], sizeof closest->normal);
}

static void closest_on_edge(const scree_mesh *mesh, size_t e, const double place[3], scree_closest_point *closest)
{
    const double *a = mesh->vertex[mesh->edge[e][0]], *b = mesh->vertex[mesh->edge[e][1]];
    double fraction, side[3], point[3], square = segment_distance(a, b, place, &fraction);
    scree_subtract(b, a, side);
    scree_along(a, fraction, side, point);
    closest_on_point(mesh, point, mesh->edge_list[mesh->edge_begin[e]], place, closest);
    closest->minimum = fraction > 0 && fraction < 1 &&
                       is_minimum(mesh, mesh->edge_list, mesh->edge_begin[e], mesh->edge_begin[e + 1], place, square);
}

static void closest_on_vertex(const scree_mesh *mesh, size_t v, const double place[3], scree_closest_point *closest)
{
    closest_on_point(mesh, mesh->vertex[v], mesh->vertex_list[mesh->vertex_begin[v]], place, closest);
    closest->minimum = is_minimum(mesh, mesh->vertex_list, mesh->vertex_begin[v], mesh->vertex_begin[v + 1], place,
                                  closest->distance * closest->distance);
}

void scree_mesh_closest_point(const scree_mesh *mesh, size_t primitive, const scree_vector place,
                              scree_closest_point *closest)
{
    size_t edge = primitive - mesh->triangle_count, vertex = edge - mesh->edge_count;
    if (primitive < mesh->triangle_count)
        closest_on_face(mesh, primitive, place, closest);
    else if (edge < mesh->edge_count)
        closest_on_edge(mesh, edge, place, closest);
    else
        closest_on_vertex(mesh, vertex, place, closest);
}

double scree_mesh_distance(const scree_mesh *mesh, size_t primitive, const scree_vector place)
{
    size_t edge = primitive - mesh->triangle_count, vertex = edge - mesh->edge_count;
    bool inside;
    double fraction, from[3];
    if (primitive < mesh->triangle_count) return sqrt(triangle_distance(mesh, primitive, place, &inside));
    if (edge < mesh->edge_count)
        return sqrt(
            segment_distance(mesh->vertex[mesh->edge[edge][0]], mesh->vertex[mesh->edge[edge][1]], place, &fraction));
    scree_subtract(place, mesh->vertex[vertex], from);
    return sqrt(scree_dot(from, from));
}

/// The triangle, and the edges and vertices that it owns.
static scree_status report(const scree_mesh *mesh, size_t t, const double place[3], double reach,
                           scree_status (*found)(void *context, size_t primitive), void *context)
{
    size_t primitive[7] = {t}, count = 1;
    for (int k = 0; k < 3; k++) {
        uint32_t e = mesh->triangle_edge[t][k], v = mesh->triangle[t][k];
        if (mesh->edge_list[mesh->edge_begin[e]] == t) primitive[count++] = mesh->triangle_count + e;
        if (mesh->vertex_list[mesh->vertex_begin[v]] == t)
            primitive[count++] = mesh->triangle_count + mesh->edge_count + v;
    }
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < count && !status; k++)
        if (!(scree_mesh_distance(mesh, primitive[k], place) >= reach)) status = found(context, primitive[k]);
    return status;
}

scree_status scree_mesh_near(const scree_mesh *mesh, const scree_vector place, double reach,
                             scree_status (*found)(void *context, size_t primitive), void *context)
{
    uint32_t stack[DEEPEST] = {0};
    int depth = 1;
    scree_status status = SCREE_OK;
    while (depth > 0 && !status) {
        const scree_mesh_node *node = &mesh->node[stack[--depth]];
        bool apart = false;
        for (int k = 0; k < 3; k++)
            apart = apart || place[k] + reach < node->low[k] || place[k] - reach > node->high[k];
        if (apart) continue;
        if (node->left) {
            stack[depth++] = node->left;
            stack[depth++] = node->left + 1;
            continue;
        }
        for (uint32_t k = node->begin; k < node->end && !status; k++)
            status = report(mesh, mesh->order[k], place, reach, found, context);
    }
    return status;
}
