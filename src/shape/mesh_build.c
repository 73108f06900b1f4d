/// Construction of a mesh: corners that coincide become one vertex, triangles without area go, edges are found, and a
/// tree of boxes is built by halving along the longest side. Everything is in the order of the file, so the same file
/// gives the same mesh.
#include "shape/mesh.h"

#include "base/vectors.h"

#include <stdlib.h>
#include <string.h>

#define WELD_TOLERANCE 1e-6  /* of the diagonal of the mesh */
#define FLAT_TOLERANCE 1e-12 /* twice the area over the square of the longest side */
enum { LEAF = 4 };

// ---- welding -----------------------------------------------------------------------------------------------------

/// Vertices by the cells of a grid as wide as the tolerance, chained: those within reach lie in 27 cells.
typedef struct welder {
    scree_mesh *mesh;
    double low[3], tolerance;
    uint32_t *head, *next; ///< vertex + 1; 0 ends a chain
    size_t mask;
} welder;

static void find_extent(size_t count, const double (*corner)[3], double low[3], double *diagonal)
{
    double high[3], side[3];
    memcpy(low, corner[0], 3 * sizeof *low);
    memcpy(high, corner[0], sizeof high);
    for (size_t c = 0; c < count; c++)
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], corner[c][k]);
            high[k] = fmax(high[k], corner[c][k]);
        }
    scree_subtract(high, low, side);
    *diagonal = sqrt(scree_dot(side, side));
}

static size_t slot_of(const welder *w, const int64_t cell[3])
{
    uint64_t hash = 0;
    for (int k = 0; k < 3; k++) hash = (hash ^ (uint64_t)cell[k]) * UINT64_C(0x9e3779b97f4a7c15);
    return (size_t)(hash >> 20) & w->mask;
}

static void cell_of(const welder *w, const double place[3], int64_t cell[3])
{
    for (int k = 0; k < 3; k++) cell[k] = (int64_t)floor((place[k] - w->low[k]) / w->tolerance);
}

/// The first vertex within the tolerance; SIZE_MAX: none.
static size_t find_vertex(const welder *w, const double place[3])
{
    int64_t middle[3];
    size_t best = SIZE_MAX;
    cell_of(w, place, middle);
    for (int n = 0; n < 27; n++) {
        const int64_t cell[3] = {middle[0] + n % 3 - 1, middle[1] + n / 3 % 3 - 1, middle[2] + n / 9 - 1};
        for (uint32_t at = w->head[slot_of(w, cell)]; at; at = w->next[at - 1]) {
            double apart[3];
            scree_subtract(place, w->mesh->vertex[at - 1], apart);
            if (scree_dot(apart, apart) <= w->tolerance * w->tolerance && at - 1 < best) best = at - 1;
        }
    }
    return best;
}

static uint32_t weld_corner(welder *w, const double place[3])
{
    size_t known = find_vertex(w, place);
    if (known != SIZE_MAX) return (uint32_t)known;
    int64_t cell[3];
    uint32_t vertex = (uint32_t)w->mesh->vertex_count++;
    memcpy(w->mesh->vertex[vertex], place, sizeof(scree_vector));
    cell_of(w, place, cell);
    size_t slot = slot_of(w, cell);
    w->next[vertex] = w->head[slot];
    w->head[slot] = vertex + 1;
    return vertex;
}

static bool has_area(const scree_mesh *mesh, const uint32_t corner[3], double normal[3])
{
    double side[3][3], longest = 0;
    for (int k = 0; k < 3; k++) {
        scree_subtract(mesh->vertex[corner[(k + 1) % 3]], mesh->vertex[corner[k]], side[k]);
        longest = fmax(longest, scree_dot(side[k], side[k]));
    }
    scree_cross(side[0], side[1], normal);
    return scree_normalise(normal) > FLAT_TOLERANCE * longest;
}

static scree_status weld(scree_mesh *mesh, size_t count, const double (*corner)[3], scree_error *error)
{
    welder w = {.mesh = mesh};
    double diagonal;
    size_t slots = 64;
    while (slots < 6 * count) slots *= 2;
    w.mask = slots - 1;
    find_extent(3 * count, corner, w.low, &diagonal);
    if (!(diagonal > 0)) return scree_error_set(error, SCREE_ERROR_INPUT, "no triangle has an area");
    w.tolerance = WELD_TOLERANCE * diagonal;
    scree_status status = scree_allocate(&mesh->vertex, 3 * count, sizeof *mesh->vertex, error);
    if (!status) status = scree_allocate(&mesh->triangle, count, sizeof *mesh->triangle, error);
    if (!status) status = scree_allocate(&mesh->normal, count, sizeof *mesh->normal, error);
    if (!status) status = scree_allocate(&w.head, slots, sizeof *w.head, error);
    if (!status) status = scree_allocate(&w.next, 3 * count, sizeof *w.next, error);
    for (size_t t = 0; t < count && !status; t++) {
        uint32_t index[3];
        for (int k = 0; k < 3; k++) index[k] = weld_corner(&w, corner[3 * t + (size_t)k]);
        if (has_area(mesh, index, mesh->normal[mesh->triangle_count]))
            memcpy(mesh->triangle[mesh->triangle_count++], index, sizeof index);
    }
    scree_release(&w.head);
    scree_release(&w.next);
    mesh->degenerate = count - mesh->triangle_count;
    mesh->welded = 3 * count - mesh->vertex_count;
    if (!status && mesh->triangle_count == 0)
        status = scree_error_set(error, SCREE_ERROR_INPUT, "no triangle has an area");
    return status;
}

// ---- topology ----------------------------------------------------------------------------------------------------

/// A side of a triangle, to be sorted by its vertices.
typedef struct half_edge {
    uint32_t low, high, triangle, side;
} half_edge;

static int compare_half_edges(const void *one, const void *other)
{
    const half_edge *a = one, *b = other;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    if (a->high != b->high) return a->high < b->high ? -1 : 1;
    if (a->triangle != b->triangle) return a->triangle < b->triangle ? -1 : 1;
    return (a->side > b->side) - (a->side < b->side);
}

static scree_status find_edges(scree_mesh *mesh, scree_error *error)
{
    size_t count = 3 * mesh->triangle_count;
    half_edge *half;
    scree_status status = scree_allocate(&half, count, sizeof *half, error);
    if (!status) status = scree_allocate(&mesh->edge, count, sizeof *mesh->edge, error);
    if (!status) status = scree_allocate(&mesh->edge_begin, count + 1, sizeof *mesh->edge_begin, error);
    if (!status) status = scree_allocate(&mesh->edge_list, count, sizeof *mesh->edge_list, error);
    if (!status)
        status = scree_allocate(&mesh->triangle_edge, mesh->triangle_count, sizeof *mesh->triangle_edge, error);
    for (size_t h = 0; h < count && !status; h++) {
        const uint32_t *corner = mesh->triangle[h / 3];
        uint32_t a = corner[h % 3], b = corner[(h + 1) % 3];
        half[h] = (half_edge){a < b ? a : b, a < b ? b : a, (uint32_t)(h / 3), (uint32_t)(h % 3)};
    }
    if (!status) qsort(half, count, sizeof *half, compare_half_edges);
    for (size_t h = 0; h < count && !status; h++) {
        if (h == 0 || half[h].low != half[h - 1].low || half[h].high != half[h - 1].high) {
            mesh->edge_begin[mesh->edge_count] = (uint32_t)h;
            mesh->edge[mesh->edge_count][0] = half[h].low;
            mesh->edge[mesh->edge_count++][1] = half[h].high;
        }
        mesh->edge_list[h] = half[h].triangle;
        mesh->triangle_edge[half[h].triangle][half[h].side] = (uint32_t)mesh->edge_count - 1;
    }
    if (!status) mesh->edge_begin[mesh->edge_count] = (uint32_t)count;
    scree_release(&half);
    return status;
}

/// Triangles around each vertex, by a counting sort. Vertices that only dropped triangles had stay, without any.
static scree_status find_fans(scree_mesh *mesh, scree_error *error)
{
    size_t count = mesh->vertex_count;
    scree_status status = scree_allocate(&mesh->vertex_begin, count + 2, sizeof *mesh->vertex_begin, error);
    if (!status)
        status = scree_allocate(&mesh->vertex_list, 3 * mesh->triangle_count, sizeof *mesh->vertex_list, error);
    if (status) return status;
    // begin[v + 2] counts, begin[v + 1] is where the next one is put, and in the end the end of v.
    for (size_t c = 0; c < 3 * mesh->triangle_count; c++) mesh->vertex_begin[mesh->triangle[c / 3][c % 3] + 2]++;
    for (size_t v = 0; v < count; v++) mesh->vertex_begin[v + 2] += mesh->vertex_begin[v + 1];
    for (size_t c = 0; c < 3 * mesh->triangle_count; c++)
        mesh->vertex_list[mesh->vertex_begin[mesh->triangle[c / 3][c % 3] + 1]++] = (uint32_t)(c / 3);
    return status;
}

// ---- tree --------------------------------------------------------------------------------------------------------

/// The middle of a triangle along the axis by which a node is halved.
typedef struct sort_key {
    double middle;
    uint32_t triangle;
} sort_key;

static int compare_keys(const void *one, const void *other)
{
    const sort_key *a = one, *b = other;
    if (a->middle != b->middle) return a->middle < b->middle ? -1 : 1;
    return (a->triangle > b->triangle) - (a->triangle < b->triangle);
}

static void fit_box(const scree_mesh *mesh, scree_mesh_node *node)
{
    for (int i = 0; i < 3; i++) {
        node->low[i] = INFINITY;
        node->high[i] = -INFINITY;
    }
    for (uint32_t k = node->begin; k < node->end; k++)
        for (int c = 0; c < 3; c++)
            for (int i = 0; i < 3; i++) {
                double x = mesh->vertex[mesh->triangle[mesh->order[k]][c]][i];
                node->low[i] = fmin(node->low[i], x);
                node->high[i] = fmax(node->high[i], x);
            }
}

static void halve(const scree_mesh *mesh, const scree_mesh_node *node, sort_key *key)
{
    int axis = 0;
    for (int i = 1; i < 3; i++)
        if (node->high[i] - node->low[i] > node->high[axis] - node->low[axis]) axis = i;
    size_t count = node->end - node->begin;
    for (size_t k = 0; k < count; k++) {
        uint32_t t = mesh->order[node->begin + k];
        key[k] = (sort_key){0, t};
        for (int c = 0; c < 3; c++) key[k].middle += mesh->vertex[mesh->triangle[t][c]][axis];
    }
    qsort(key, count, sizeof *key, compare_keys);
    for (size_t k = 0; k < count; k++) mesh->order[node->begin + k] = key[k].triangle;
}

/// Nodes in the order in which they are made; a node is halved when its turn comes.
static scree_status build_tree(scree_mesh *mesh, scree_error *error)
{
    sort_key *key;
    size_t count = mesh->triangle_count;
    scree_status status = scree_allocate(&key, count, sizeof *key, error);
    if (!status) status = scree_allocate(&mesh->order, count, sizeof *mesh->order, error);
    if (!status) status = scree_allocate(&mesh->node, 2 * count, sizeof *mesh->node, error);
    if (!status) {
        for (size_t t = 0; t < count; t++) mesh->order[t] = (uint32_t)t;
        mesh->node[mesh->node_count++] = (scree_mesh_node){.end = (uint32_t)count};
    }
    for (size_t n = 0; n < mesh->node_count; n++) {
        scree_mesh_node *node = &mesh->node[n];
        fit_box(mesh, node);
        if (node->end - node->begin <= LEAF) continue;
        halve(mesh, node, key);
        uint32_t middle = node->begin + (node->end - node->begin) / 2;
        node->left = (uint32_t)mesh->node_count;
        mesh->node[mesh->node_count++] = (scree_mesh_node){.begin = node->begin, .end = middle};
        mesh->node[mesh->node_count++] = (scree_mesh_node){.begin = middle, .end = node->end};
    }
    scree_release(&key);
    return status;
}

scree_status scree_mesh_build(scree_mesh *mesh, size_t count, const double (*corner)[3], scree_error *error)
{
    *mesh = (scree_mesh){0};
    if (count == 0) return scree_error_set(error, SCREE_ERROR_INPUT, "there is no triangle");
    scree_status status = weld(mesh, count, corner, error);
    if (!status) status = find_edges(mesh, error);
    if (!status) status = find_fans(mesh, error);
    if (!status) status = build_tree(mesh, error);
    if (status) scree_mesh_destroy(mesh);
    return status;
}
