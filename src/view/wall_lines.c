/// Lines of walls: bends and outlines by the topology of their triangles, cuts triangle by triangle.
#include "view/wall_lines.h"

#include "shape/mesh.h"

#include <math.h>
#include <string.h>

/// Facets of round walls meet at 4 degrees.
#define SHARP 0.9 /* cosine */

static bool is_sharp(const scree_mesh *mesh, size_t e)
{
    const uint32_t *list = &mesh->edge_list[mesh->edge_begin[e]];
    if (mesh->edge_begin[e + 1] - mesh->edge_begin[e] != 2) return true;
    const double *a = mesh->normal[list[0]], *b = mesh->normal[list[1]];
    return fabs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) < SHARP;
}

static double along(const double axis[3], const double place[3])
{
    return axis[0] * place[0] + axis[1] * place[1] + axis[2] * place[2];
}

/// A page: two directions in space.
typedef struct page_axes {
    const double *right, *up;
} page_axes;

/// On which side of edge e, as it lies on the page, triangle t of it lies.
static double side_of(const scree_mesh *mesh, const page_axes *page, size_t e, uint32_t t)
{
    const double *a = mesh->vertex[mesh->edge[e][0]], *b = mesh->vertex[mesh->edge[e][1]], *c = NULL;
    for (int k = 0; k < 3; k++)
        if (mesh->triangle[t][k] != mesh->edge[e][0] && mesh->triangle[t][k] != mesh->edge[e][1])
            c = mesh->vertex[mesh->triangle[t][k]];
    if (!c) return 0;
    const double x = along(page->right, b) - along(page->right, a), y = along(page->up, b) - along(page->up, a);
    return x * (along(page->up, c) - along(page->up, a)) - y * (along(page->right, c) - along(page->right, a));
}

/// The surface turns back there as it is seen: the outline of a round wall.
static bool is_outline(const scree_mesh *mesh, const page_axes *page, size_t e)
{
    const uint32_t *list = &mesh->edge_list[mesh->edge_begin[e]];
    return side_of(mesh, page, e, list[0]) * side_of(mesh, page, e, list[1]) > 0;
}

scree_status scree_wall_edges(const scree_snapshot *solid, const double right[3], const double up[3],
                              scree_snapshot *plane, scree_error *error)
{
    scree_mesh mesh;
    if (solid->wall_triangle_count == 0) return SCREE_OK;
    scree_status status = scree_mesh_build(&mesh, solid->wall_triangle_count,
                                           (const double(*)[3])(const void *)solid->wall_triangle, error);
    if (status == SCREE_ERROR_INPUT) return SCREE_OK; // nothing that has an area
    if (status) return status;
    status = scree_allocate(&plane->wall_line, 4 * mesh.edge_count, sizeof *plane->wall_line, error);
    const page_axes page = {right, up};
    for (size_t e = 0; e < mesh.edge_count && !status; e++) {
        if (!is_sharp(&mesh, e) && !is_outline(&mesh, &page, e)) continue;
        double *line = &plane->wall_line[4 * plane->wall_line_count++];
        for (int end = 0; end < 2; end++) {
            const double *place = mesh.vertex[mesh.edge[e][end]];
            line[2 * end] = along(right, place);
            line[2 * end + 1] = along(up, place);
        }
    }
    scree_mesh_destroy(&mesh);
    return status;
}

scree_status scree_wall_cuts(const scree_snapshot *solid, double cut, scree_snapshot *plane, scree_error *error)
{
    scree_status status =
        scree_allocate(&plane->wall_line, 4 * solid->wall_triangle_count, sizeof *plane->wall_line, error);
    for (size_t t = 0; t < solid->wall_triangle_count && !status; t++) {
        const double *corner = &solid->wall_triangle[9 * t];
        double *line = &plane->wall_line[4 * plane->wall_line_count];
        int ends = 0;
        // Of the three sides none or two cross the plane.
        for (int c = 0; c < 3 && ends < 2; c++) {
            const double *a = corner + 3 * c, *b = corner + 3 * ((c + 1) % 3);
            if ((a[1] < cut) == (b[1] < cut)) continue;
            double part = (cut - a[1]) / (b[1] - a[1]);
            line[2 * ends] = a[0] + part * (b[0] - a[0]);
            line[2 * ends++ + 1] = a[2] + part * (b[2] - a[2]);
        }
        plane->wall_line_count += ends == 2;
    }
    return status;
}
