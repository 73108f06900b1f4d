/// Delaunay tetrahedra: the simplices of simplices.c and who lies beside whom.
///
/// Neighbours are found from the faces, bucketed by their lowest point. Two tetrahedra on one face must see it from
/// opposite sides; anything else (three on a face, two on one side) is refused.
/// Cost: that of simplices.c, and O(n) for the neighbours.
#include "search/tetrahedra.h"

#include "search/simplices.h"

const uint8_t scree_tetrahedron_face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

/// A face by its points.
typedef struct face_key {
    uint32_t low, middle, high;
    bool even; ///< seen from outside of its tetrahedron, low - middle - high is counter-clockwise
} face_key;

static face_key key_of(const scree_tetrahedra *tetrahedra, size_t face)
{
    const uint32_t *vertex = tetrahedra->vertex[face / 4];
    const uint8_t *corner = scree_tetrahedron_face[face % 4];
    uint32_t a = vertex[corner[0]], b = vertex[corner[1]], c = vertex[corner[2]];
    // Turned until the lowest comes first, which keeps the sense.
    while (a > b || a > c) {
        uint32_t first = a;
        a = b;
        b = c;
        c = first;
    }
    return (face_key){.low = a, .middle = b < c ? b : c, .high = b < c ? c : b, .even = b < c};
}

/// Joins the faces of one bucket, which all have the same lowest point.
static scree_status join_faces(scree_tetrahedra *tetrahedra, const uint32_t *face, size_t count, scree_error *error)
{
    for (size_t i = 0; i < count; i++) {
        face_key one = key_of(tetrahedra, face[i]);
        int32_t *mine = &tetrahedra->neighbour[face[i] / 4][face[i] % 4];
        for (size_t k = i + 1; k < count; k++) {
            face_key other = key_of(tetrahedra, face[k]);
            if (one.middle != other.middle || one.high != other.high) continue;
            if (*mine >= 0 || one.even == other.even)
                return scree_error_set(error, SCREE_ERROR_GUARD, "tetrahedra overlap at bodies %u, %u and %u", one.low,
                                       one.middle, one.high);
            *mine = (int32_t)(face[k] / 4);
            tetrahedra->neighbour[face[k] / 4][face[k] % 4] = (int32_t)(face[i] / 4);
        }
    }
    return SCREE_OK;
}

static scree_status find_neighbours(scree_tetrahedra *tetrahedra, size_t count, uint32_t *begin, uint32_t *faces,
                                    scree_error *error)
{
    size_t face_count = 4 * tetrahedra->count;
    for (size_t f = 0; f < face_count; f++) {
        begin[key_of(tetrahedra, f).low + 1]++;
        tetrahedra->neighbour[f / 4][f % 4] = -1;
    }
    for (size_t i = 0; i < count; i++) begin[i + 1] += begin[i];
    // Filling advances the start of each bucket to its end, which is the start of the next one.
    for (size_t f = 0; f < face_count; f++) faces[begin[key_of(tetrahedra, f).low]++] = (uint32_t)f;
    scree_status status = SCREE_OK;
    for (size_t i = 0; i < count && !status; i++) {
        uint32_t start = i > 0 ? begin[i - 1] : 0;
        status = join_faces(tetrahedra, faces + start, begin[i] - start, error);
    }
    return status;
}

/// Every point must be a corner of something; `used` has a byte for each, zero.
static scree_status check_points(const scree_tetrahedra *tetrahedra, size_t count, uint8_t *used, scree_error *error)
{
    for (size_t k = 0; k < 4 * tetrahedra->count; k++) used[tetrahedra->vertex[k / 4][k % 4]] = 1;
    for (size_t i = 0; i < count; i++)
        if (!used[i])
            return scree_error_set(error, SCREE_ERROR_GUARD, "body %zu coincides with another one: no triangulation",
                                   i);
    return SCREE_OK;
}

static scree_status connect_tetrahedra(scree_tetrahedra *tetrahedra, size_t count, scree_error *error)
{
    uint32_t *begin = NULL, *faces = NULL;
    uint8_t *used = NULL;
    scree_status status = scree_allocate(&begin, count + 1, sizeof *begin, error);
    if (!status) status = scree_allocate(&faces, 4 * tetrahedra->count, sizeof *faces, error);
    if (!status) status = scree_allocate(&used, count, sizeof *used, error);
    if (!status)
        status = scree_allocate(&tetrahedra->neighbour, tetrahedra->count, sizeof *tetrahedra->neighbour, error);
    if (!status) status = check_points(tetrahedra, count, used, error);
    if (!status) status = find_neighbours(tetrahedra, count, begin, faces, error);
    scree_release(&begin);
    scree_release(&faces);
    scree_release(&used);
    return status;
}

scree_status scree_tetrahedra_build(const double *points, size_t count, scree_tetrahedra *tetrahedra,
                                    scree_error *error)
{
    *tetrahedra = (scree_tetrahedra){0};
    uint32_t *vertex = NULL;
    scree_status status = scree_simplices_build(points, count, 3, &vertex, &tetrahedra->count, error);
    tetrahedra->vertex = (uint32_t(*)[4])vertex;
    if (!status) status = connect_tetrahedra(tetrahedra, count, error);
    if (status) scree_tetrahedra_destroy(tetrahedra);
    return status;
}

void scree_tetrahedra_destroy(scree_tetrahedra *tetrahedra)
{
    scree_release(&tetrahedra->vertex);
    scree_release(&tetrahedra->neighbour);
    tetrahedra->count = 0;
}
