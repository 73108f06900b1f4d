/// A quarter of a disc in quadrilaterals: a square of equal elements at the contact, some layers that make a ring of
/// it, then rings that grow in proportion to their distance, so that all elements have nearly the same shape.
///
/// A ring is an arc that leaves the axis at height h at a right angle and meets the circle of the disc: near the
/// contact a quarter of a circle about it, at h = radius the straight line through the centre. It meets the circle at a
/// distance c(h) from the contact, c = h (1 + (sqrt(2) - 1) (h/radius)^2). Nodes lie on half steps in both directions,
/// so that the middles of sides are nodes like others; those in the middles of elements do not exist.
#include "fem/disc_mesh.h"

#include "base/memory.h"

#include <math.h>
#include <stdbool.h>

enum { LAYERS = 4, TOUCHING_RINGS = 8 };

/// Ring over square: where the layers end.
#define FIRST_RING 2.0

/// Numbers of half steps, and the mesh that is being made.
typedef struct plan {
    double radius, fine;
    int64_t square; ///< half steps over a side of the square
    int64_t turn;   ///< over a ring
    int64_t layers; ///< lines between square and first ring
    int64_t rings;  ///< lines behind
    scree_fem_disc_mesh *mesh;
} plan;

/// Height of the circle at x.
static double circle_at(double radius, double x)
{
    return x * x / (radius + sqrt(radius * radius - x * x));
}

/// The square, its lower side bent along the circle.
static void place_in_square(const plan *p, int64_t i, int64_t j, double out[2])
{
    const double x = p->fine * (double)i / (double)p->square, low = circle_at(p->radius, x);
    out[0] = x;
    out[1] = low + (p->fine - low) * (double)j / (double)p->square;
}

/// Point `k` of `turn` on the ring that begins at `height` on the axis.
static void place_on_ring(const plan *p, double height, int64_t k, double out[2])
{
    const double r = p->radius, chord = height * (1 + (M_SQRT2 - 1) * pow(height / r, 2));
    const double half = asin(fmin(M_SQRT1_2, chord / (2 * r)));
    const double end[2] = {r * sin(2 * half), 2 * r * pow(sin(half), 2)}, drop = height - end[1];
    const double curvature = 2 * drop / (end[0] * end[0] + drop * drop), part = (double)k / (double)p->turn;
    const double angle = asin(fmin(1, end[0] * curvature)) * part;
    if (k == p->turn || fabs(curvature * r) < 1e-9) {
        out[0] = part * end[0];
        out[1] = k == p->turn ? end[1] : height;
        return;
    }
    out[0] = sin(angle) / curvature;
    out[1] = height - 2 * pow(sin(0.5 * angle), 2) / curvature;
}

/// Height on the axis of the line `l` behind the square.
static double height_of(const plan *p, int64_t l)
{
    const double first = FIRST_RING * p->fine;
    if (l == p->layers + p->rings) return p->radius;
    return first * pow(p->radius / first, (double)(l - p->layers) / (double)p->rings);
}

/// Point `k` of line `l`, from the axis to the circle; line 0 is the outside of the square.
static void place_on_line(const plan *p, int64_t l, int64_t k, double out[2])
{
    double square[2], ring[2];
    if (l >= p->layers) {
        place_on_ring(p, height_of(p, l), k, out);
        return;
    }
    place_in_square(p, k < p->square ? k : p->square, k < p->square ? p->square : p->turn - k, square);
    place_on_ring(p, FIRST_RING * p->fine, k, ring);
    const double part = (double)l / (double)p->layers;
    for (int c = 0; c < 2; c++) out[c] = (1 - part) * square[c] + part * ring[c];
    if (k == p->turn) out[1] = circle_at(p->radius, out[0]);
}

// ---- numbers -----------------------------------------------------------------------------------------------------

static int64_t node_in_square(const plan *p, int64_t i, int64_t j)
{
    return j * (p->square + 1) + i + 1;
}

static int64_t node_on_line(const plan *p, int64_t l, int64_t k)
{
    if (l > 0) return (p->square + 1) * (p->square + 1) + (l - 1) * (p->turn + 1) + k + 1;
    return k < p->square ? node_in_square(p, k, p->square) : node_in_square(p, p->square, p->turn - k);
}

static void place_nodes(const plan *p)
{
    scree_fem_disc_mesh *m = p->mesh;
    for (int64_t j = 0; j <= p->square; j++)
        for (int64_t i = 0; i <= p->square; i++) {
            double *place = m->place[node_in_square(p, i, j) - 1];
            place_in_square(p, i, j, place);
            if (i % 2 && j % 2) place[0] = NAN;
        }
    for (int64_t l = 1; l <= p->layers + p->rings; l++)
        for (int64_t k = 0; k <= p->turn; k++) {
            double *place = m->place[node_on_line(p, l, k) - 1];
            place_on_line(p, l, k, place);
            if (l % 2 && k % 2) place[0] = NAN;
        }
}

/// An element from its corner of the lowest half steps; `node` numbers them.
static void add_element(const plan *p, int64_t (*node)(const plan *p, int64_t a, int64_t b), int64_t a, int64_t b)
{
    // Corners, then middles, counter-clockwise: `a` and `b` are the steps to the right and up of the element.
    static const int right[SCREE_FEM_NODES] = {0, 2, 2, 0, 1, 2, 1, 0}, up[SCREE_FEM_NODES] = {0, 0, 2, 2, 0, 1, 2, 1};
    int64_t *element = p->mesh->element[p->mesh->element_count++];
    for (int k = 0; k < SCREE_FEM_NODES; k++) element[k] = node(p, a + right[k], b + up[k]);
}

static int64_t node_by_turn(const plan *p, int64_t k, int64_t l)
{
    return node_on_line(p, l, k);
}

static void make_elements(const plan *p)
{
    scree_fem_disc_mesh *m = p->mesh;
    for (int64_t j = 0; j < p->square; j += 2)
        for (int64_t i = 0; i < p->square; i += 2) {
            add_element(p, node_in_square, i, j);
            if (j == 0) m->rim[m->rim_count++] = (scree_fem_side){(int64_t)m->element_count, 1};
        }
    for (int64_t l = 0; l < p->layers + p->rings; l += 2)
        for (int64_t k = 0; k < p->turn; k += 2) {
            add_element(p, node_by_turn, k, l);
            // The last one of a line lies on the circle with its second side.
            if (k == p->turn - 2 && l < p->layers + 2 * TOUCHING_RINGS)
                m->rim[m->rim_count++] = (scree_fem_side){(int64_t)m->element_count, 2};
        }
}

static void find_sides(const plan *p)
{
    scree_fem_disc_mesh *m = p->mesh;
    const int64_t last = p->layers + p->rings;
    for (int64_t j = 0; j <= p->square; j++) m->axis[m->axis_count++] = node_in_square(p, 0, j);
    for (int64_t l = 1; l <= last; l++) m->axis[m->axis_count++] = node_on_line(p, l, 0);
    for (int64_t k = 0; k <= p->turn; k++) m->flat[m->flat_count++] = node_on_line(p, last, k);
}

void scree_fem_disc_mesh_destroy(scree_fem_disc_mesh *mesh)
{
    scree_release(&mesh->place);
    scree_release(&mesh->element);
    scree_release(&mesh->axis);
    scree_release(&mesh->flat);
    scree_release(&mesh->rim);
    *mesh = (scree_fem_disc_mesh){0};
}

scree_status scree_fem_disc_mesh_make(double radius, double fine, int64_t elements, scree_fem_disc_mesh *mesh,
                                      scree_error *error)
{
    plan p = {.radius = radius,
              .fine = fine,
              .square = 2 * elements,
              .turn = 4 * elements,
              .layers = 2 * LAYERS,
              .mesh = mesh};
    *mesh = (scree_fem_disc_mesh){0};
    if (!(FIRST_RING * fine < 0.25 * radius))
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "the contact of two discs is wider than the finite elements allow for: press with less");
    // Elements as high as they are wide: a ring's height grows by its share of a right angle.
    p.rings = 2 * (int64_t)ceil(log(radius / (FIRST_RING * fine)) / (M_PI_2 / (2 * (double)elements)));
    const size_t lines = (size_t)(p.layers + p.rings), square = (size_t)(p.square + 1), turn = (size_t)(p.turn + 1);
    mesh->node_count = square * square + lines * turn;
    scree_status status = scree_allocate(&mesh->place, mesh->node_count, sizeof *mesh->place, error);
    if (!status) status = scree_allocate(&mesh->element, mesh->node_count, sizeof *mesh->element, error);
    if (!status) status = scree_allocate(&mesh->axis, square + lines, sizeof *mesh->axis, error);
    if (!status) status = scree_allocate(&mesh->flat, turn, sizeof *mesh->flat, error);
    if (!status) status = scree_allocate(&mesh->rim, square + lines, sizeof *mesh->rim, error);
    if (status) {
        scree_fem_disc_mesh_destroy(mesh);
        return status;
    }
    place_nodes(&p);
    make_elements(&p);
    find_sides(&p);
    return SCREE_OK;
}
