/// The outer boundary of a triangulated assembly as ONE simple closed loop, by peeling triangles off the convex hull.
///
/// A triangle with an edge a-b on the loop and its third point c inside is cut (a-b is replaced by a-c, c-b) when
///   - it is a sliver: the angle at c is above 150 degrees, so c lies all but on the edge; or
///   - its edge is open: the free gap between the outlines of a and b (peel_rule.h; of discs |x_a - x_b| - R_a - R_b)
///     is above the limit (and it is not flat to round-off).
/// Both limits have a hysteresis where the loop before is known (peel_rule.h).
/// Slivers go first, flattest first; then open edges, widest gap first; ties by the indices of the points. Only the
/// third point matters for what is allowed: if c is already on the loop, the cut would pinch the loop in c or drop a
/// point out of it, so the triangle stays. Hence after every cut the loop is still one simple polygon made of whole
/// triangles, every point is inside or on it, and nothing has to be repaired afterwards. What follows for loose bodies:
/// a body outside the assembly (or a strand of them) stays on the loop as the tip of a spike, a triangle whose other
/// two corners are its neighbours in the loop; pressure on the two sides of a spike pushes it back with p times the
/// width of its root. A void is opened to the outside only where it is reached through an open edge. The loop starts at
/// its lowest index: the same polygon gives the same array. Cost: O(h log h) for h edges that were ever on the loop,
/// plus O(n).
#include "search/delaunay.h"

#include <math.h>
#include <stdbool.h>

#define OUTSIDE UINT32_MAX
/// Twice the area over the square of the outer edge, below which a triangle is flat: only round-off says on which side
/// of the edge its third point lies, and cutting one that does not lie between the ends would fold the loop onto
/// itself.
#define FLAT 1e-9

typedef struct peel_edge {
    double key;        ///< slivers: - cosine of the angle at the third point; open edges: gap [m]. Largest first
    uint32_t a, b;     ///< on the loop, in this order
    uint32_t triangle; ///< inside
    uint32_t third;
    bool sliver;
} peel_edge;

typedef struct peeling {
    const scree_triangulation *triangulation;
    const double *points, *radius;
    const scree_peel_rule *rule;
    uint8_t *marks; ///< scree_triangle_mark by triangle, or NULL
    uint32_t *next; ///< next point along the loop, OUTSIDE for points that are not on it
    peel_edge *heap;
    size_t heap_count, heap_capacity;
} peeling;

static bool before(const peel_edge *p, const peel_edge *q)
{
    if (p->sliver != q->sliver) return p->sliver;
    if (p->key > q->key || p->key < q->key) return p->key > q->key;
    if (p->a != q->a) return p->a < q->a;
    return p->b < q->b;
}

static scree_status heap_push(peeling *peel, peel_edge edge, scree_error *error)
{
    if (peel->heap_count == peel->heap_capacity) {
        size_t capacity = 2 * peel->heap_capacity + 64;
        scree_status status = scree_reallocate(&peel->heap, peel->heap_count, capacity, sizeof *peel->heap, error);
        if (status) return status;
        peel->heap_capacity = capacity;
    }
    size_t position = peel->heap_count++;
    while (position > 0 && before(&edge, &peel->heap[(position - 1) / 2])) {
        peel->heap[position] = peel->heap[(position - 1) / 2];
        position = (position - 1) / 2;
    }
    peel->heap[position] = edge;
    return SCREE_OK;
}

static peel_edge heap_pop(peeling *peel)
{
    peel_edge top = peel->heap[0], last = peel->heap[--peel->heap_count];
    size_t position = 0, child;
    while ((child = 2 * position + 1) < peel->heap_count) {
        if (child + 1 < peel->heap_count && before(&peel->heap[child + 1], &peel->heap[child])) child++;
        if (!before(&peel->heap[child], &last)) break;
        peel->heap[position] = peel->heap[child];
        position = child;
    }
    peel->heap[position] = last;
    return top;
}

/// Queues the edge opposite to corner `corner` of a triangle if the triangle is one to be cut.
static scree_status consider(peeling *peel, uint32_t triangle, int corner, scree_error *error)
{
    const uint32_t *vertex = peel->triangulation->vertex[triangle];
    if (peel->marks) peel->marks[triangle] = SCREE_TRIANGLE_OUTER;
    peel_edge edge = {
        .a = vertex[(corner + 1) % 3], .b = vertex[(corner + 2) % 3], .third = vertex[corner], .triangle = triangle};
    const double *a = peel->points + 2 * (size_t)edge.a, *b = peel->points + 2 * (size_t)edge.b;
    const double *c = peel->points + 2 * (size_t)edge.third;
    double ca[2] = {a[0] - c[0], a[1] - c[1]}, cb[2] = {b[0] - c[0], b[1] - c[1]}, ab[2] = {b[0] - a[0], b[1] - a[1]};
    double cosine = (ca[0] * cb[0] + ca[1] * cb[1]) / (hypot(ca[0], ca[1]) * hypot(cb[0], cb[1]));
    const uint32_t ends[2] = {edge.a, edge.b};
    double length = hypot(ab[0], ab[1]), gap = scree_peel_rule_gap(peel->rule, ends, ab, peel->radius);
    bool flat = ca[0] * cb[1] - ca[1] * cb[0] < FLAT * length * length;
    double share = scree_peel_rule_share(peel->rule, 2, ends);
    edge.sliver = -cosine > cos(SCREE_SLIVER_TURN * (2 - share));
    edge.key = edge.sliver ? -cosine : gap;
    bool open = !flat && gap > peel->rule->gap_limit * share;
    return edge.sliver || open ? heap_push(peel, edge, error) : SCREE_OK;
}

/// Links the edges without a neighbour into the loop to start from. Errors: they are not one simple loop.
static scree_status link_hull(peeling *peel, size_t count, size_t *loop_count, uint32_t *lowest, scree_error *error)
{
    const scree_triangulation *triangulation = peel->triangulation;
    for (size_t i = 0; i < count; i++) peel->next[i] = OUTSIDE;
    *loop_count = 0;
    *lowest = OUTSIDE;
    for (size_t t = 0; t < triangulation->count; t++)
        for (int corner = 0; corner < 3; corner++) {
            if (triangulation->neighbour[t][corner] >= 0) continue;
            uint32_t a = triangulation->vertex[t][(corner + 1) % 3], b = triangulation->vertex[t][(corner + 2) % 3];
            if (peel->next[a] != OUTSIDE)
                return scree_error_set(error, SCREE_ERROR_GUARD, "the triangulation is pinched at body %u", a);
            peel->next[a] = b;
            (*loop_count)++;
            if (a < *lowest) *lowest = a;
            scree_status status = consider(peel, (uint32_t)t, corner, error);
            if (status) return status;
        }
    size_t length = 0;
    for (uint32_t v = *lowest; v != OUTSIDE && length < *loop_count && (length == 0 || v != *lowest); v = peel->next[v])
        length++;
    if (length != *loop_count || length < 3)
        return scree_error_set(error, SCREE_ERROR_GUARD, "the triangulation has more than one boundary");
    return SCREE_OK;
}

/// Cuts what has to be cut.
static scree_status cut_triangles(peeling *peel, size_t *loop_count, uint32_t *lowest, scree_error *error)
{
    while (peel->heap_count > 0) {
        peel_edge edge = heap_pop(peel);
        if (peel->next[edge.third] != OUTSIDE) continue;
        peel->next[edge.a] = edge.third;
        peel->next[edge.third] = edge.b;
        (*loop_count)++;
        if (edge.third < *lowest) *lowest = edge.third;
        if (peel->marks) peel->marks[edge.triangle] = SCREE_TRIANGLE_CUT;
        // The triangles behind the other two edges now have an edge on the loop.
        for (int corner = 0; corner < 3; corner++) {
            int32_t behind = peel->triangulation->neighbour[edge.triangle][corner];
            if (peel->triangulation->vertex[edge.triangle][corner] == edge.third || behind < 0) continue;
            int facing = 0;
            while (facing < 2 && peel->triangulation->neighbour[behind][facing] != (int32_t)edge.triangle) facing++;
            scree_status status = consider(peel, (uint32_t)behind, facing, error);
            if (status) return status;
        }
    }
    return SCREE_OK;
}

scree_status scree_boundary_loop(const scree_triangulation *triangulation, const double *points, const double *radius,
                                 size_t count, const scree_peel_rule *rule, uint32_t **loop, size_t *loop_count,
                                 uint8_t *marks, scree_error *error)
{
    peeling peel = {.triangulation = triangulation, .points = points, .radius = radius, .rule = rule, .marks = marks};
    uint32_t lowest = OUTSIDE;
    *loop = NULL;
    *loop_count = 0;
    if (marks)
        for (size_t t = 0; t < triangulation->count; t++) marks[t] = SCREE_TRIANGLE_INSIDE;
    scree_status status = scree_allocate(&peel.next, count, sizeof *peel.next, error);
    if (!status) status = link_hull(&peel, count, loop_count, &lowest, error);
    if (!status) status = cut_triangles(&peel, loop_count, &lowest, error);
    if (!status) status = scree_allocate(loop, *loop_count, sizeof **loop, error);
    if (!status) {
        uint32_t v = lowest;
        for (size_t k = 0; k < *loop_count; k++, v = peel.next[v]) (*loop)[k] = v;
    } else {
        *loop_count = 0;
    }
    scree_release(&peel.next);
    scree_release(&peel.heap);
    return status;
}
