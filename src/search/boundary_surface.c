/// The outer boundary of the tetrahedra of an assembly as ONE closed surface, by peeling tetrahedra off the convex
/// hull: the counterpart of boundary_loop.c in three dimensions.
///
/// A tetrahedron with faces on the surface is cut when
///   - it is a sliver: each face that the cut would leave is turned by less than 30 degrees against each that it takes
///     away, so the surface hardly moves; or
///   - one of its outer faces is open: its free gap is above the limit (and the tetrahedron is not flat to round-off).
///     What can pass between three bodies does so at the point of their triangle that is farthest from the corners: the
///     circumcentre of an acute triangle; in an obtuse one a point of the longest edge, as far from one of its ends as
///     from the third corner. The gap is sqrt(3) times that distance less the mean diameter of the three: that of
///     bodies at the corners of an equilateral triangle with the same passage. (Through a dense random packing a
///     connected way leads where gaps of about 0.2 diameters are open; the default, 0.5, is far from it.)
/// Slivers go first, flattest first; then open faces, widest first; ties by the index of the tetrahedron. Both limits
/// have a hysteresis where the surface before is known (peel_rule.h).
///
/// Allowed are two cuts, which keep the surface what it is, combinatorially a sphere:
///   - ONE outer face a-b-c, the fourth point d not on the surface: a-b-c is divided into three triangles at d;
///   - TWO outer faces a-b-c, b-a-d, and no edge c-d on the surface: the edge a-b is turned into c-d. (Were a left with
///     two triangles only, the face a-c-d would be on the surface too, and there would be three.)
/// A tetrahedron with one outer face whose fourth point is on the surface would pinch it; one with three would let its
/// tip fall out. They stay, until a cut beside them makes them one of the two. So at all times the surface is closed,
/// every edge belongs to two triangles, the triangles round a point are one disc, V - E + F = 2; it bounds whole
/// tetrahedra, and every point is inside or on it. A body outside the assembly stays on it as the tip of a spike; a
/// void is opened only where it is reached through an open face; a hole right through the sample stays closed by a
/// skin.
///
/// Cost: O(n) to find the hull, O(h log h) for h tetrahedra that ever had an outer face.
#include "base/vectors.h"
#include "search/delaunay.h"
#include "search/tetrahedra.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/// Six volumes over the cube of the longest edge of the outer faces, below which a tetrahedron is flat: only round-off
/// says on which side of the face its fourth point lies, and cutting one that does not lie above it would fold the
/// surface onto itself.
#define FLAT 1e-9

typedef struct candidate {
    double key; ///< slivers: cosine of the largest turn; open faces: free gap [m]. Largest first
    uint32_t tetrahedron;
    uint8_t outer; ///< bits of its outer faces when it was queued
    bool sliver;
} candidate;

typedef struct candidates {
    candidate *item;
    size_t count, capacity;
} candidates;

typedef struct peeling {
    const scree_tetrahedra *tetrahedra;
    const double *points, *radius;
    const scree_peel_rule *rule;
    uint8_t *marks;      ///< scree_triangle_mark by tetrahedron
    uint8_t *on_surface; ///< by point
    candidates heap;
    candidates waiting; ///< two outer faces, and the edge between their tips on the surface
} peeling;

static bool before(const candidate *p, const candidate *q)
{
    if (p->sliver != q->sliver) return p->sliver;
    if (p->key > q->key || p->key < q->key) return p->key > q->key;
    return p->tetrahedron < q->tetrahedron;
}

static scree_status append(candidates *list, candidate item, scree_error *error)
{
    if (list->count == list->capacity) {
        size_t capacity = 2 * list->capacity + 64;
        scree_status status = scree_reallocate(&list->item, list->count, capacity, sizeof *list->item, error);
        if (status) return status;
        list->capacity = capacity;
    }
    list->item[list->count++] = item;
    return SCREE_OK;
}

static scree_status heap_push(candidates *heap, candidate item, scree_error *error)
{
    scree_status status = append(heap, item, error);
    if (status) return status;
    size_t position = heap->count - 1;
    while (position > 0 && before(&item, &heap->item[(position - 1) / 2])) {
        heap->item[position] = heap->item[(position - 1) / 2];
        position = (position - 1) / 2;
    }
    heap->item[position] = item;
    return SCREE_OK;
}

static candidate heap_pop(candidates *heap)
{
    candidate top = heap->item[0], last = heap->item[--heap->count];
    size_t position = 0, child;
    while ((child = 2 * position + 1) < heap->count) {
        if (child + 1 < heap->count && before(&heap->item[child + 1], &heap->item[child])) child++;
        if (!before(&heap->item[child], &last)) break;
        heap->item[position] = heap->item[child];
        position = child;
    }
    heap->item[position] = last;
    return top;
}

static bool is_outer(const peeling *peel, size_t tetrahedron, int face)
{
    int32_t behind = peel->tetrahedra->neighbour[tetrahedron][face];
    return behind < 0 || peel->marks[behind] == SCREE_TRIANGLE_CUT;
}

/// One bit for each outer face.
static uint8_t outer_faces(const peeling *peel, size_t tetrahedron)
{
    unsigned bits = 0;
    for (int face = 0; face < 4; face++) bits |= (unsigned)is_outer(peel, tetrahedron, face) << face;
    return (uint8_t)bits;
}

static const double *corner_of(const peeling *peel, size_t tetrahedron, int corner)
{
    return peel->points + 3 * (size_t)peel->tetrahedra->vertex[tetrahedron][corner];
}

static double square_between(const double *a, const double *b)
{
    double x = b[0] - a[0], y = b[1] - a[1], z = b[2] - a[2];
    return x * x + y * y + z * z;
}

/// Twice the area vector of a face, outward.
static void face_normal(const peeling *peel, size_t tetrahedron, int face, double normal[3])
{
    const uint8_t *corner = scree_tetrahedron_face[face];
    const double *a = corner_of(peel, tetrahedron, corner[0]), *b = corner_of(peel, tetrahedron, corner[1]);
    const double *c = corner_of(peel, tetrahedron, corner[2]);
    double u[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    scree_cross(u, v, normal);
}

/// Cosine of the largest turn from a face taken away to one left by the cut; not a number for a degenerate face.
static double turn_cosine(const peeling *peel, size_t tetrahedron, uint8_t outer)
{
    double normal[4][3], least = 1;
    for (int face = 0; face < 4; face++) {
        face_normal(peel, tetrahedron, face, normal[face]);
        double length = sqrt(scree_dot(normal[face], normal[face]));
        for (int k = 0; k < 3; k++) normal[face][k] /= length;
    }
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++) {
            if (!(outer >> i & 1) || (outer >> k & 1)) continue;
            double cosine = -scree_dot(normal[i], normal[k]);
            if (!(cosine >= least)) least = cosine;
        }
    return least;
}

/// Free gap of a face [m], and the square of its longest edge.
static double face_gap(const peeling *peel, size_t tetrahedron, int face, double *longest)
{
    const uint8_t *corner = scree_tetrahedron_face[face];
    double square[3], normal[3], radii = 0, reach;
    int c = 0;
    for (int k = 0; k < 3; k++) {
        square[k] = square_between(corner_of(peel, tetrahedron, corner[(k + 1) % 3]),
                                   corner_of(peel, tetrahedron, corner[(k + 2) % 3]));
        radii += peel->radius[peel->tetrahedra->vertex[tetrahedron][corner[k]]];
        if (square[k] > square[c]) c = k;
    }
    // The longest edge is a-b, opposite to c.
    double ab = square[c], bc = square[(c + 1) % 3], ca = square[(c + 2) % 3];
    *longest = ab;
    if (ab >= bc + ca) {
        // The point of a-b that is as far from a as from c is |ac| / (2 cos a) from both; the same from b.
        reach = sqrt(ab) * fmax(ca / (ab + ca - bc), bc / (ab + bc - ca));
    } else {
        face_normal(peel, tetrahedron, face, normal);
        reach = 0.5 * sqrt(ab * bc * ca / scree_dot(normal, normal));
    }
    return sqrt(3) * reach - radii / 1.5;
}

static double six_volumes(const peeling *peel, size_t tetrahedron)
{
    double normal[3];
    const double *apex = corner_of(peel, tetrahedron, 3), *foot = corner_of(peel, tetrahedron, 0);
    face_normal(peel, tetrahedron, 3, normal);
    double up[3] = {foot[0] - apex[0], foot[1] - apex[1], foot[2] - apex[2]};
    return scree_dot(normal, up);
}

/// What the limits of a face are multiplied by (peel_rule.h).
static double face_share(const peeling *peel, size_t tetrahedron, int face)
{
    uint32_t corner[3];
    for (int k = 0; k < 3; k++) corner[k] = peel->tetrahedra->vertex[tetrahedron][scree_tetrahedron_face[face][k]];
    return scree_peel_rule_share(peel->rule, 3, corner);
}

/// Queues a tetrahedron that has just got an outer face if it is one to be cut. Of two outer faces one that was on the
/// surface before keeps a sliver, as both go with it.
static scree_status consider(peeling *peel, uint32_t tetrahedron, scree_error *error)
{
    peel->marks[tetrahedron] = SCREE_TRIANGLE_OUTER;
    uint8_t outer = outer_faces(peel, tetrahedron);
    if (__builtin_popcount(outer) > 2) return SCREE_OK;
    candidate item = {.tetrahedron = tetrahedron, .outer = outer, .key = turn_cosine(peel, tetrahedron, outer)};
    double longest = 0, gap = -INFINITY, share = 1 - peel->rule->hysteresis, square;
    bool open = false;
    for (int face = 0; face < 4; face++) {
        if (!(outer >> face & 1)) continue;
        double free = face_gap(peel, tetrahedron, face, &square), of_face = face_share(peel, tetrahedron, face);
        open = open || free > peel->rule->gap_limit * of_face;
        gap = fmax(gap, free);
        longest = fmax(longest, square);
        share = fmax(share, of_face);
    }
    item.sliver = item.key > cos(SCREE_SLIVER_TURN * (2 - share));
    if (item.sliver) return heap_push(&peel->heap, item, error);
    item.key = gap;
    bool flat = six_volumes(peel, tetrahedron) < FLAT * longest * sqrt(longest);
    return !flat && open ? heap_push(&peel->heap, item, error) : SCREE_OK;
}

/// Whether the edge between two corners is on the surface: going round it through uncut tetrahedra comes to an end.
static bool edge_on_surface(const peeling *peel, uint32_t tetrahedron, int corner, int other)
{
    const scree_tetrahedra *tetrahedra = peel->tetrahedra;
    uint32_t c = tetrahedra->vertex[tetrahedron][corner], d = tetrahedra->vertex[tetrahedron][other], t = tetrahedron;
    // The face to leave through is the one opposite to `leave`; the corner opposite to the way in is left next.
    int leave = 0;
    while (leave == corner || leave == other) leave++;
    do {
        uint32_t stays = UINT32_MAX;
        for (int k = 0; k < 4; k++) {
            uint32_t v = tetrahedra->vertex[t][k];
            if (k != leave && v != c && v != d) stays = v;
        }
        if (is_outer(peel, t, leave)) return true;
        t = (uint32_t)tetrahedra->neighbour[t][leave];
        leave = 0;
        while (tetrahedra->vertex[t][leave] != stays) leave++;
    } while (t != tetrahedron);
    return false;
}

typedef enum permission { ALLOWED, REFUSED, LATER } permission;

static permission may_cut(const peeling *peel, const candidate *item)
{
    // The corners opposite to the outer faces.
    int tip[2] = {0, 0}, tips = 0;
    for (int k = 0; k < 4; k++)
        if (item->outer >> k & 1) tip[tips++] = k;
    if (tips == 1) return peel->on_surface[peel->tetrahedra->vertex[item->tetrahedron][tip[0]]] ? REFUSED : ALLOWED;
    return edge_on_surface(peel, item->tetrahedron, tip[0], tip[1]) ? LATER : ALLOWED;
}

static scree_status cut(peeling *peel, const candidate *item, scree_error *error)
{
    peel->marks[item->tetrahedron] = SCREE_TRIANGLE_CUT;
    scree_status status = SCREE_OK;
    for (int k = 0; k < 4; k++) {
        peel->on_surface[peel->tetrahedra->vertex[item->tetrahedron][k]] = 1;
        if (item->outer >> k & 1) continue;
        if (!status) status = consider(peel, (uint32_t)peel->tetrahedra->neighbour[item->tetrahedron][k], error);
    }
    return status;
}

/// Whether nothing has changed since this was queued.
static bool is_current(const peeling *peel, const candidate *item)
{
    return peel->marks[item->tetrahedron] != SCREE_TRIANGLE_CUT && outer_faces(peel, item->tetrahedron) == item->outer;
}

/// Cuts what the heap holds and what comes after it.
static scree_status cut_queued(peeling *peel, scree_error *error)
{
    scree_status status = SCREE_OK;
    while (peel->heap.count > 0 && !status) {
        candidate item = heap_pop(&peel->heap);
        if (!is_current(peel, &item)) continue;
        permission may = may_cut(peel, &item);
        if (may == ALLOWED) status = cut(peel, &item, error);
        if (may == LATER) status = append(&peel->waiting, item, error);
    }
    return status;
}

/// The waiting ones whose edge has left the surface meanwhile go back into the heap.
static scree_status queue_waiting(peeling *peel, scree_error *error)
{
    scree_status status = SCREE_OK;
    size_t kept = 0;
    for (size_t k = 0; k < peel->waiting.count && !status; k++) {
        candidate item = peel->waiting.item[k];
        if (!is_current(peel, &item)) continue;
        if (may_cut(peel, &item) == ALLOWED)
            status = heap_push(&peel->heap, item, error);
        else
            peel->waiting.item[kept++] = item;
    }
    peel->waiting.count = kept;
    return status;
}

/// The convex hull as the surface to start from. Errors: it is no sphere.
static scree_status take_hull(peeling *peel, size_t count, scree_error *error)
{
    const scree_tetrahedra *tetrahedra = peel->tetrahedra;
    size_t faces = 0, points = 0;
    scree_status status = SCREE_OK;
    for (size_t t = 0; t < tetrahedra->count; t++)
        for (int face = 0; face < 4; face++) {
            if (tetrahedra->neighbour[t][face] >= 0) continue;
            faces++;
            for (int k = 0; k < 3; k++) peel->on_surface[tetrahedra->vertex[t][scree_tetrahedron_face[face][k]]] = 1;
        }
    for (size_t i = 0; i < count; i++) points += peel->on_surface[i];
    if (faces + 4 != 2 * points)
        return scree_error_set(error, SCREE_ERROR_GUARD, "the boundary of the tetrahedra is not one closed surface");
    for (size_t t = 0; t < tetrahedra->count && !status; t++)
        if (outer_faces(peel, t)) status = consider(peel, (uint32_t)t, error);
    return status;
}

static int compare_triangles(const void *first, const void *second)
{
    const uint32_t *a = first, *b = second;
    for (int i = 0; i < 3; i++)
        if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
    return 0;
}

/// The outer faces of what is left.
static scree_status collect(const peeling *peel, scree_triangle_surface *surface, scree_error *error)
{
    const scree_tetrahedra *tetrahedra = peel->tetrahedra;
    size_t count = 0;
    for (size_t t = 0; t < tetrahedra->count; t++)
        if (peel->marks[t] == SCREE_TRIANGLE_OUTER) count += (size_t)__builtin_popcount(outer_faces(peel, t));
    scree_status status = scree_allocate(&surface->triangle, count, sizeof *surface->triangle, error);
    for (size_t t = 0; t < tetrahedra->count && !status; t++)
        for (int face = 0; face < 4; face++) {
            if (peel->marks[t] != SCREE_TRIANGLE_OUTER || !is_outer(peel, t, face)) continue;
            uint32_t corner[3];
            int lowest = 0;
            for (int k = 0; k < 3; k++) {
                corner[k] = tetrahedra->vertex[t][scree_tetrahedron_face[face][k]];
                if (corner[k] < corner[lowest]) lowest = k;
            }
            for (int k = 0; k < 3; k++) surface->triangle[surface->count][k] = corner[(lowest + k) % 3];
            surface->count++;
        }
    if (!status) qsort(surface->triangle, surface->count, sizeof *surface->triangle, compare_triangles);
    return status;
}

scree_status scree_boundary_surface(const scree_tetrahedra *tetrahedra, const double *points, const double *radius,
                                    size_t count, const scree_peel_rule *rule, scree_triangle_surface *surface,
                                    uint8_t *marks, scree_error *error)
{
    peeling peel = {.tetrahedra = tetrahedra, .points = points, .radius = radius, .rule = rule};
    *surface = (scree_triangle_surface){0};
    scree_status status = scree_allocate(&peel.marks, tetrahedra->count, sizeof *peel.marks, error);
    if (!status) status = scree_allocate(&peel.on_surface, count, sizeof *peel.on_surface, error);
    if (!status) {
        memset(peel.marks, SCREE_TRIANGLE_INSIDE, tetrahedra->count * sizeof *peel.marks);
        status = take_hull(&peel, count, error);
    }
    if (!status) status = cut_queued(&peel, error);
    while (!status && peel.waiting.count > 0) {
        status = queue_waiting(&peel, error);
        if (status || peel.heap.count == 0) break;
        status = cut_queued(&peel, error);
    }
    if (!status) status = collect(&peel, surface, error);
    if (!status && marks) memcpy(marks, peel.marks, tetrahedra->count * sizeof *marks);
    if (status) scree_triangle_surface_destroy(surface);
    scree_release(&peel.marks);
    scree_release(&peel.on_surface);
    scree_release(&peel.heap.item);
    scree_release(&peel.waiting.item);
    return status;
}

void scree_triangle_surface_destroy(scree_triangle_surface *surface)
{
    scree_release(&surface->triangle);
    surface->count = 0;
}
