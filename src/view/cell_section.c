/// A plane cuts a tetrahedron in a triangle, when one corner is alone on its side, or in a quadrangle, which is drawn
/// as two triangles. Each corner of the cut lies on an edge of the tetrahedron, each side of the cut on a face.
#include "view/cell_section.h"

#include <math.h>
#include <string.h>

enum { MOST_CORNERS = 4 };

/// A cut: its corners in order, and the tetrahedron's node opposite to the face that side k, k + 1 lies on.
typedef struct cut_polygon {
    int count; ///< 0: the plane misses the tetrahedron
    double corner[MOST_CORNERS][3];
    int opposite[MOST_CORNERS];
} cut_polygon;

/// Where the plane meets the edge of two corners on different sides of it.
static void meet(const double *const corner[4], const double height[4], int a, int b, double out[3])
{
    double weight = height[a] / (height[a] - height[b]);
    out[0] = corner[a][0] + weight * (corner[b][0] - corner[a][0]);
    out[1] = corner[a][2] + weight * (corner[b][2] - corner[a][2]);
    out[2] = 0;
}

static cut_polygon cut_tetrahedron(const scree_cells *solid, const double *place, size_t k, double cut)
{
    const double *corner[4];
    double height[4];
    int side[2][4], count[2] = {0};
    for (int n = 0; n < 4; n++) {
        corner[n] = place + 3 * (size_t)solid->node[k][n];
        height[n] = corner[n][1] - cut;
        int above = height[n] >= 0;
        side[above][count[above]++] = n;
    }
    cut_polygon polygon = {.count = count[0] == 0 || count[1] == 0 ? 0 : count[0] == 2 ? 4 : 3};
    const int *few = side[count[1] < count[0]], *many = side[count[1] >= count[0]];
    for (int c = 0; c < polygon.count; c++) {
        // The lone corner to each of the others, or a-c, a-d, b-d, b-c.
        int from = polygon.count == 3 ? few[0] : few[c / 2], to = polygon.count == 3 ? many[c] : many[(c + 1) / 2 % 2];
        meet(corner, height, from, to, polygon.corner[c]);
        int next = (c + 1) % polygon.count;
        polygon.opposite[c] = polygon.count == 3 ? many[3 - c - next] : c % 2 == 0 ? few[1 - c / 2] : many[c / 2];
    }
    return polygon;
}

/// The triangle of corners 0, second, second + 1. Its sides inside the cut have a neighbour, the other triangle.
static void add_triangle(const scree_cells *solid, size_t k, const cut_polygon *polygon, int second, uint32_t first,
                         scree_cells *flat)
{
    const int third = second + 1, last = polygon->count - 1;
    const double *p = polygon->corner[0], *q = polygon->corner[second], *r = polygon->corner[third];
    const size_t t = flat->count++;
    flat->node[t][0] = first;
    flat->node[t][1] = first + (uint32_t)second;
    flat->node[t][2] = first + (uint32_t)third;
    flat->node[t][3] = UINT32_MAX;
    flat->neighbour[t][0] = solid->neighbour[k][polygon->opposite[second]];
    flat->neighbour[t][1] = third == last ? solid->neighbour[k][polygon->opposite[third]] : 0;
    flat->neighbour[t][2] = second == 1 ? solid->neighbour[k][polygon->opposite[0]] : 0;
    flat->neighbour[t][3] = 0;
    flat->volume[t] = fabs((q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1])) / 2;
}

static scree_status make_room(const scree_cells *solid, const double *place, double cut, scree_cell_section *section,
                              scree_error *error)
{
    size_t corners = 0, triangles = 0;
    for (size_t k = 0; k < solid->count; k++) {
        int count = cut_tetrahedron(solid, place, k, cut).count;
        corners += (size_t)count;
        triangles += count > 0 ? (size_t)count - 2 : 0;
    }
    scree_cells *flat = &section->cells;
    flat->dimension = 2;
    flat->bodies = corners;
    scree_status status = scree_allocate(&section->place, 3 * corners, sizeof *section->place, error);
    if (!status) status = scree_allocate(&section->field, triangles, sizeof *section->field, error);
    if (!status) status = scree_allocate(&flat->node, triangles, sizeof *flat->node, error);
    if (!status) status = scree_allocate(&flat->neighbour, triangles, sizeof *flat->neighbour, error);
    if (!status) status = scree_allocate(&flat->volume, triangles, sizeof *flat->volume, error);
    return status;
}

scree_status scree_cell_section_create(const scree_cells *solid, const double *place, const double *field, double cut,
                                       scree_cell_section *section, scree_error *error)
{
    *section = (scree_cell_section){0};
    scree_status status = make_room(solid, place, cut, section, error);
    if (status) {
        scree_cell_section_destroy(section);
        return status;
    }
    uint32_t first = 0;
    for (size_t k = 0; k < solid->count; k++) {
        cut_polygon polygon = cut_tetrahedron(solid, place, k, cut);
        for (int second = 1; second + 1 < polygon.count; second++) {
            section->field[section->cells.count] = field[k];
            add_triangle(solid, k, &polygon, second, first, &section->cells);
        }
        for (int c = 0; c < polygon.count; c++)
            memcpy(section->place + 3 * (size_t)first++, polygon.corner[c], sizeof polygon.corner[c]);
    }
    return SCREE_OK;
}

void scree_cell_section_destroy(scree_cell_section *section)
{
    scree_cells_destroy(&section->cells);
    scree_release(&section->place);
    scree_release(&section->field);
}
