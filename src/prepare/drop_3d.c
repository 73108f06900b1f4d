/// Deposition of spheres one by one under gravity without inertia (Jodrey & Tory 1979; Visscher & Bolsterli 1972), in
/// exact geometry: a moving sphere of radius r is a point among spheres of radius R_k + r around those at rest, and
/// planes at the distance r from walls and floor.
///
/// The point falls vertically onto the highest sphere below it, and slides down on it along the meridian; when it meets
/// a second sphere or a wall it slides down along both (about the axis through the two centres), and so on. Each time
/// that it meets a surface, or that a surface no longer holds it back, arc.c says which of those that it touches hold
/// it now: none (it falls), one, two, or three (it rests). On the floor it rests as well. A surface that it touches and
/// that does not hold it is met again only where the arc comes back to it.
///
/// Accuracy: a place of rest is the end of a chain of circles through points that have been rounded to doubles: gaps
/// and overlaps of a few units in the last place of the coordinates, 1e-13 R in a packing of 1000 R.
///
/// Cost: a grid of cells of the largest diameter holds all spheres; a fall looks at nine columns from their tops, a
/// roll at the cells around its arc.
#include "prepare/drop_3d.h"

#include "base/vectors.h"
#include "prepare/arc.h"
#include "prepare/methods.h"
#include "prepare/prepare.h"

#include <math.h>

/// Names of the planes, above all spheres; the floor is the last.
#define PLANE(k) (UINT32_MAX - (uint32_t)(k))
enum { PLANES = 5, FLOOR = 4, MOST_EVENTS = 100000 };
#define NOTHING (UINT32_MAX - PLANES)
static const double TOUCH = 1e-9; // arcs shorter than this (in radians) do not move the point

/// Names of surfaces.
typedef struct contact_set {
    uint32_t name[SCREE_ARC_MOST];
    int count;
} contact_set;

/// The sphere on its way.
typedef struct mover {
    double radius;
    double at[3];
    contact_set touched; ///< surfaces that may hold it
    contact_set left;    ///< surfaces that have let it go where it is
} mover;

/// Next thing on the path.
typedef struct meeting {
    double measure; ///< of the angle along the arc
    double at[3];
    uint32_t name;
    bool parting; ///< `name` no longer holds the point
} meeting;

scree_status scree_drop_3d_create(scree_drop_3d *drop, const double *radius, size_t count, const double floor_sides[2],
                                  double *const place[3], double *level, scree_error *error)
{
    *drop = (scree_drop_3d){.radius = radius,
                            .x = place[0],
                            .y = place[1],
                            .z = place[2],
                            .level = level,
                            .width = floor_sides[0],
                            .depth = floor_sides[1]};
    for (size_t i = 0; i < count; i++) drop->largest = fmax(drop->largest, radius[i]);
    drop->cell = 2 * drop->largest;
    drop->columns = (size_t)(drop->width / drop->cell) + 1;
    drop->rows = (size_t)(drop->depth / drop->cell) + 1;
    drop->layers = 4;
    size_t columns = drop->rows * drop->columns;
    scree_status status = scree_allocate(&drop->head, drop->layers * columns, sizeof *drop->head, error);
    if (!status) status = scree_allocate(&drop->next, count, sizeof *drop->next, error);
    if (!status) status = scree_allocate(&drop->filled, columns, sizeof *drop->filled, error);
    if (status) scree_drop_3d_destroy(drop);
    return status;
}

void scree_drop_3d_destroy(scree_drop_3d *drop)
{
    scree_release(&drop->head);
    scree_release(&drop->next);
    scree_release(&drop->filled);
}

static scree_status insert(scree_drop_3d *drop, size_t index, const double at[3], scree_error *error)
{
    size_t layer = (size_t)(at[2] / drop->cell), columns = drop->rows * drop->columns;
    size_t column = scree_cell_within(at[1], drop->cell, drop->rows) * drop->columns +
                    scree_cell_within(at[0], drop->cell, drop->columns);
    if (layer >= drop->layers) {
        size_t layers = 2 * layer;
        scree_status status =
            scree_reallocate(&drop->head, drop->layers * columns, layers * columns, sizeof *drop->head, error);
        if (status) return status;
        drop->layers = layers;
    }
    drop->x[index] = at[0];
    drop->y[index] = at[1];
    drop->z[index] = at[2];
    uint32_t *head = &drop->head[layer * columns + column];
    drop->next[index] = *head;
    *head = (uint32_t)index + 1;
    if (drop->filled[column] <= layer) drop->filled[column] = layer + 1;
    return SCREE_OK;
}

static bool contains(const contact_set *set, uint32_t name)
{
    for (int k = 0; k < set->count; k++)
        if (set->name[k] == name) return true;
    return false;
}

static void add(contact_set *set, uint32_t name)
{
    if (set->count < SCREE_ARC_MOST && !contains(set, name)) set->name[set->count++] = name;
}

/// Touched, and known not to hold the point once those that hold it are found.
static bool is_released(const mover *sphere, uint32_t name)
{
    return contains(&sphere->touched, name) || contains(&sphere->left, name);
}

/// The surface that the point must not enter.
static scree_arc_surface surface_of(const scree_drop_3d *drop, double radius, uint32_t name)
{
    if (name < NOTHING)
        return (scree_arc_surface){.centre = {drop->x[name], drop->y[name], drop->z[name]},
                                   .reach = drop->radius[name] + radius};
    uint32_t plane = PLANE(0) - name;
    scree_arc_surface surface = {.plane = true};
    if (plane == FLOOR) {
        surface.centre[2] = 1;
        surface.reach = radius;
        return surface;
    }
    double side = plane < 2 ? drop->width : drop->depth;
    surface.centre[plane / 2] = plane % 2 ? -1 : 1;
    surface.reach = plane % 2 ? radius - side : radius;
    return surface;
}

/// Cells of a box, kept within the grid.
typedef struct cell_box {
    size_t first[3], last[3];
} cell_box;

static cell_box cells_around(const scree_drop_3d *drop, const double low[3], const double high[3])
{
    const size_t count[3] = {drop->columns, drop->rows, drop->layers};
    cell_box box;
    for (int c = 0; c < 3; c++) {
        box.first[c] = scree_cell_within(low[c], drop->cell, count[c]);
        box.last[c] = scree_cell_within(high[c], drop->cell, count[c]);
    }
    return box;
}

static uint32_t head_of(const scree_drop_3d *drop, size_t layer, size_t row, size_t column)
{
    return drop->head[(layer * drop->rows + row) * drop->columns + column];
}

/// Height at which a point falling from `disc->at` meets sphere k; -1 if it passes.
static double hit(const scree_drop_3d *drop, const mover *sphere, uint32_t k)
{
    double reach = drop->radius[k] + sphere->radius;
    double dx = sphere->at[0] - drop->x[k], dy = sphere->at[1] - drop->y[k];
    double rise2 = reach * reach - dx * dx - dy * dy;
    double least = SCREE_ARC_EQUATOR * reach;
    if (rise2 <= least * least || drop->z[k] >= sphere->at[2] || is_released(sphere, k)) return -1;
    double z = drop->z[k] + sqrt(rise2);
    return z <= sphere->at[2] + TOUCH * sphere->radius ? z : -1;
}

/// Highest sphere below the point; NOTHING above the floor. `z`: where it is met.
static uint32_t look_down(const scree_drop_3d *drop, const mover *sphere, double *z)
{
    double reach = drop->largest + sphere->radius, low[3], high[3];
    for (int c = 0; c < 3; c++) low[c] = sphere->at[c] - reach;
    for (int c = 0; c < 3; c++) high[c] = sphere->at[c] + reach;
    cell_box box = cells_around(drop, low, high);
    size_t top = 0, below = scree_cell_within(sphere->at[2], drop->cell, drop->layers) + 1;
    for (size_t row = box.first[1]; row <= box.last[1]; row++)
        for (size_t column = box.first[0]; column <= box.last[0]; column++)
            if (drop->filled[row * drop->columns + column] > top) top = drop->filled[row * drop->columns + column];
    uint32_t found = NOTHING;
    *z = sphere->radius;
    // Spheres of lower layers end below (layer + 1) cell + reach.
    for (size_t layer = top < below ? top : below; layer-- > 0 && *z < (double)(layer + 1) * drop->cell + reach;)
        for (size_t row = box.first[1]; row <= box.last[1]; row++)
            for (size_t column = box.first[0]; column <= box.last[0]; column++)
                for (uint32_t k = head_of(drop, layer, row, column); k > 0; k = drop->next[k - 1]) {
                    double height = hit(drop, sphere, k - 1);
                    if (height <= *z) continue;
                    *z = height;
                    found = k - 1;
                }
    return found;
}

bool scree_drop_3d_sees_floor(const scree_drop_3d *drop, size_t index, double x, double y)
{
    mover sphere = {.radius = drop->radius[index], .at = {x, y, INFINITY}};
    double z;
    return look_down(drop, &sphere, &z) == NOTHING;
}

/// Takes surface `name` into account if the arc enters it before the meeting already known.
static void consider(const scree_drop_3d *drop, const mover *sphere, const scree_arc *arc, uint32_t name,
                     meeting *nearest)
{
    scree_arc_surface surface = surface_of(drop, sphere->radius, name);
    meeting met = {.name = name};
    if (!scree_arc_enters(arc, &surface, is_released(sphere, name), &met.measure, met.at) ||
        met.measure >= nearest->measure)
        return;
    *nearest = met;
}

/// The height at which a holder no longer holds is a plane as well.
static void consider_parting(const scree_arc *arc, uint32_t name, double height, meeting *nearest)
{
    scree_arc_surface plane = {.plane = true, .centre = {0, 0, 1}, .reach = height};
    meeting met = {.name = name, .parting = true};
    if (!scree_arc_enters(arc, &plane, false, &met.measure, met.at) || met.measure >= nearest->measure) return;
    *nearest = met;
}

/// First surface that the arc enters, or holder that lets go. `lowest`: height below which the path does not go.
static meeting look_ahead(const scree_drop_3d *drop, const mover *sphere, const scree_arc *arc,
                          const contact_set *holders, double lowest, meeting nearest)
{
    double reach = drop->largest + sphere->radius, low[3], high[3];
    for (int c = 0; c < 3; c++) {
        double extent = arc->radius * sqrt(arc->along[c] * arc->along[c] + arc->ahead[c] * arc->ahead[c]) + reach;
        low[c] = arc->middle[c] - extent;
        high[c] = arc->middle[c] + extent;
    }
    low[2] = fmax(low[2], lowest - reach);
    high[2] = fmin(high[2], sphere->at[2] + reach);
    for (int plane = 0; plane < PLANES; plane++)
        if (!contains(holders, PLANE(plane))) consider(drop, sphere, arc, PLANE(plane), &nearest);
    cell_box box = cells_around(drop, low, high);
    for (size_t layer = box.first[2]; layer <= box.last[2]; layer++)
        for (size_t row = box.first[1]; row <= box.last[1]; row++)
            for (size_t column = box.first[0]; column <= box.last[0]; column++)
                for (uint32_t k = head_of(drop, layer, row, column); k > 0; k = drop->next[k - 1])
                    if (!contains(holders, k - 1)) consider(drop, sphere, arc, k - 1, &nearest);
    return nearest;
}

/// Moves the point along the surfaces that hold it to the next event, which changes the surfaces that it touches.
/// False: there is none.
static bool roll(const scree_drop_3d *drop, mover *sphere, const contact_set *holders, const scree_arc *arc)
{
    const bool both = holders->count == 2;
    const uint32_t name[2] = {holders->name[0], holders->name[holders->count - 1]};
    scree_arc_surface surface[2];
    double normal[2][3];
    for (int k = 0; k < 2; k++) surface[k] = surface_of(drop, sphere->radius, name[k]);
    for (int k = 0; k < 2; k++) scree_arc_surface_normal(&surface[k], sphere->at, normal[k]);
    double cosine = scree_dot(normal[0], normal[1]), lowest = -1;
    meeting next = {.measure = INFINITY};
    for (int k = 0; k < holders->count; k++) {
        double parting = scree_arc_parting(&surface[k], both ? &surface[!k] : NULL, cosine);
        if (parting >= 0) consider_parting(arc, name[k], parting, &next);
        if (!both) lowest = parting;
    }
    next = look_ahead(drop, sphere, arc, holders, lowest, next);
    if (isinf(next.measure)) return false;

    // As long as the point does not move, it touches all that it has touched.
    contact_set before = next.measure < TOUCH ? sphere->touched : *holders;
    if (next.measure >= TOUCH) sphere->left.count = 0;
    sphere->touched.count = 0;
    for (int k = 0; k < before.count; k++)
        if (!next.parting || before.name[k] != next.name) add(&sphere->touched, before.name[k]);
    add(next.parting ? &sphere->left : &sphere->touched, next.name);
    for (int c = 0; c < 3; c++) sphere->at[c] = next.at[c];
    return true;
}

/// Falls to the next support, which is the floor at last.
static void fall(const scree_drop_3d *drop, mover *sphere)
{
    double z;
    uint32_t support = look_down(drop, sphere, &z);
    sphere->at[2] = z;
    sphere->touched.count = sphere->left.count = 0;
    add(&sphere->touched, support == NOTHING ? PLANE(FLOOR) : support);
}

/// Which of the surfaces that the point touches hold it.
static scree_hold held_by(const scree_drop_3d *drop, mover *sphere, contact_set *holders)
{
    scree_arc_surface surface[SCREE_ARC_MOST];
    for (int k = 0; k < sphere->touched.count; k++)
        surface[k] = surface_of(drop, sphere->radius, sphere->touched.name[k]);
    scree_hold hold = scree_hold_find(surface, sphere->touched.count, sphere->at);
    holders->count = 0;
    for (int k = 0; k < hold.count; k++) add(holders, sphere->touched.name[hold.by[k]]);
    return hold;
}

/// Rests sphere `index` at its place on what it touches.
static scree_status rest(scree_drop_3d *drop, size_t index, const mover *sphere, scree_error *error)
{
    double level = sphere->at[2];
    for (int k = 0; k < sphere->touched.count; k++)
        if (sphere->touched.name[k] < NOTHING) level = fmax(level, drop->level[sphere->touched.name[k]]);
    drop->level[index] = level;
    return insert(drop, index, sphere->at, error);
}

scree_status scree_drop_3d_add(scree_drop_3d *drop, size_t index, double x, double y, scree_error *error)
{
    mover sphere = {.radius = drop->radius[index], .at = {x, y, INFINITY}};
    fall(drop, &sphere);
    for (int events = 0; events < MOST_EVENTS; events++) {
        contact_set holders = {.count = 0};
        if (contains(&sphere.touched, PLANE(FLOOR))) return rest(drop, index, &sphere, error);
        scree_hold hold = held_by(drop, &sphere, &holders);
        if (hold.count == 3) return rest(drop, index, &sphere, error);
        if (hold.count == 0)
            fall(drop, &sphere);
        else if (!roll(drop, &sphere, &holders, &hold.path))
            break;
    }
    return scree_error_set(error, SCREE_ERROR_INPUT, "sphere %zu of radius %g m finds no position of rest", index,
                           sphere.radius);
}
