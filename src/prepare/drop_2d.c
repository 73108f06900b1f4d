/// Deposition of discs one by one under gravity without inertia (Jodrey & Tory 1979; Visscher & Bolsterli 1972), in
/// exact geometry: a moving disc of radius r is a point among circles of radius R_k + r around the discs at rest.
///
/// The point falls vertically onto the highest circle below it, then slides down along that circle, away from the top.
/// On its way down it meets, whichever comes first,
///
///   - another circle: it rests if the two supports lie on either side of its centre, else it slides on along the new
///     one (the old one then is behind; the path only ever becomes flatter, so this ends);
///   - a side wall or the floor: it rests;
///   - the height of its support's centre: it falls again.
///
/// A point that slides clockwise around circle i enters circle k at the one of their two intersections that lies
/// counter-clockwise of the line of centres, and the other way round: the meeting point needs no search and no angle.
/// Nothing but the four operations and square roots is used, so the packing is the same to the last bit on any machine.
///
/// Accuracy: a place of rest is the intersection of two circles rounded to doubles: gaps and overlaps of a few units in
/// the last place of the coordinates, 1e-13 R in a packing of 1000 R.
///
/// Cost: a grid of cells of the largest diameter holds all discs; a fall looks at three columns from their tops, a roll
/// at the cells around the support: 0.8 s for a million discs of 1:2, as much for 1:5. Equal numbers of discs of very
/// different sizes crowd the cells of the larger: 1.0 s at 1:20.
#include "prepare/drop_2d.h"

#include "prepare/methods.h"
#include "prepare/prepare.h"

#include <math.h>

#define NOTHING UINT32_MAX
enum { MOST_EVENTS = 100000 };
static const double TOUCH = 1e-9; // of the radius: contacts met this little behind the present point count as met here

typedef struct point {
    double x, y;
} point;

/// The disc on its way.
typedef struct mover {
    double radius;
    point at;
    uint32_t support;
    double side; ///< +1 rolls to the right and clockwise, -1 to the left
} mover;

typedef enum meeting_kind { MEET_EQUATOR, MEET_DISC, MEET_REST } meeting_kind;

/// Next thing on the path along the support.
typedef struct meeting {
    meeting_kind kind;
    point at;
    double distance; ///< sum of the advances in x and downwards
    uint32_t disc;
} meeting;

scree_status scree_drop_2d_create(scree_drop_2d *drop, const double *radius, size_t count, double width, double *x,
                                  double *y, double *level, scree_error *error)
{
    *drop = (scree_drop_2d){.radius = radius, .x = x, .y = y, .level = level, .width = width};
    for (size_t i = 0; i < count; i++) drop->largest = fmax(drop->largest, radius[i]);
    drop->cell = 2 * drop->largest;
    drop->columns = (size_t)(width / drop->cell) + 1;
    drop->rows = 4;
    scree_status status = scree_allocate(&drop->head, drop->rows * drop->columns, sizeof *drop->head, error);
    if (!status) status = scree_allocate(&drop->next, count, sizeof *drop->next, error);
    if (!status) status = scree_allocate(&drop->filled, drop->columns, sizeof *drop->filled, error);
    if (status) scree_drop_2d_destroy(drop);
    return status;
}

void scree_drop_2d_destroy(scree_drop_2d *drop)
{
    scree_release(&drop->head);
    scree_release(&drop->next);
    scree_release(&drop->filled);
}

static scree_status insert(scree_drop_2d *drop, size_t index, point at, scree_error *error)
{
    size_t row = (size_t)(at.y / drop->cell), column = scree_cell_within(at.x, drop->cell, drop->columns);
    if (row >= drop->rows) {
        size_t rows = 2 * row;
        scree_status status =
            scree_reallocate(&drop->head, drop->rows * drop->columns, rows * drop->columns, sizeof *drop->head, error);
        if (status) return status;
        drop->rows = rows;
    }
    drop->x[index] = at.x;
    drop->y[index] = at.y;
    uint32_t *head = &drop->head[row * drop->columns + column];
    drop->next[index] = *head;
    *head = (uint32_t)index + 1;
    if (drop->filled[column] <= row) drop->filled[column] = row + 1;
    return SCREE_OK;
}

/// Height at which a point falling from `from` at its abscissa meets circle k; -1 if it passes. A support that is left
/// at the height of its centre is passed.
static double hit(const scree_drop_2d *drop, const mover *disc, point from, uint32_t k)
{
    double reach = drop->radius[k] + disc->radius, dx = from.x - drop->x[k];
    double rise2 = (reach - dx) * (reach + dx);
    if (rise2 <= 0) return -1;
    double y = drop->y[k] + sqrt(rise2);
    return y <= from.y + TOUCH * disc->radius && drop->y[k] < from.y ? y : -1;
}

/// Highest circle below `from`, other than that of the support just left; NOTHING above the floor. `y`: where it is
/// met.
static uint32_t look_down(const scree_drop_2d *drop, const mover *disc, point from, double *y)
{
    double reach = drop->largest + disc->radius;
    size_t first = scree_cell_within(from.x - reach, drop->cell, drop->columns);
    size_t last = scree_cell_within(from.x + reach, drop->cell, drop->columns);
    size_t top = 0;
    for (size_t column = first; column <= last; column++)
        if (drop->filled[column] > top) top = drop->filled[column];
    size_t below = scree_cell_within(from.y, drop->cell, drop->rows) + 1;
    uint32_t found = NOTHING;
    *y = disc->radius;
    // Circles of lower rows end below (row + 1) cell + reach.
    for (size_t row = top < below ? top : below; row-- > 0 && *y < (double)(row + 1) * drop->cell + reach;)
        for (size_t column = first; column <= last; column++)
            for (uint32_t k = drop->head[row * drop->columns + column]; k > 0; k = drop->next[k - 1]) {
                double height = hit(drop, disc, from, k - 1);
                if (height <= *y) continue;
                *y = height;
                found = k - 1;
            }
    return found;
}

bool scree_drop_2d_sees_floor(const scree_drop_2d *drop, size_t index, double x)
{
    mover disc = {.radius = drop->radius[index], .support = NOTHING};
    double y;
    return look_down(drop, &disc, (point){x, INFINITY}, &y) == NOTHING;
}

/// Takes a meeting at `at` into account if it lies ahead on the quarter circle and before the one already known.
static void consider(const scree_drop_2d *drop, const mover *disc, point at, meeting_kind kind, uint32_t k,
                     meeting *nearest)
{
    point centre = {drop->x[disc->support], drop->y[disc->support]};
    double touch = TOUCH * disc->radius;
    if (at.y < centre.y || disc->side * (at.x - centre.x) < -touch) return;
    double distance = disc->side * (at.x - disc->at.x) + (disc->at.y - at.y);
    if (distance < -touch || distance >= nearest->distance) return;
    *nearest = (meeting){kind, at, distance, k};
}

/// Walls, floor and the height of the support's centre.
static void meet_box(const scree_drop_2d *drop, const mover *disc, meeting *nearest)
{
    double x = drop->x[disc->support], y = drop->y[disc->support];
    double reach = drop->radius[disc->support] + disc->radius;
    *nearest = (meeting){.kind = MEET_EQUATOR, .at = {x + disc->side * reach, y}, .distance = INFINITY};
    double wall = disc->side > 0 ? drop->width - disc->radius : disc->radius;
    double across = wall - x, up = disc->radius - y;
    if (fabs(across) < reach)
        consider(drop, disc, (point){wall, y + sqrt((reach - across) * (reach + across))}, MEET_REST, NOTHING, nearest);
    if (up > 0)
        consider(drop, disc, (point){x + disc->side * sqrt((reach - up) * (reach + up)), disc->radius}, MEET_REST,
                 NOTHING, nearest);
}

/// Where the path around the support enters circle k.
static void meet_disc(const scree_drop_2d *drop, const mover *disc, uint32_t k, meeting *nearest)
{
    uint32_t i = disc->support;
    double reach = drop->radius[i] + disc->radius, other = drop->radius[k] + disc->radius;
    double dx = drop->x[k] - drop->x[i], dy = drop->y[k] - drop->y[i];
    double distance2 = dx * dx + dy * dy;
    if (k == i || distance2 >= (reach + other) * (reach + other)) return;
    double distance = sqrt(distance2), ex = dx / distance, ey = dy / distance;
    double along = (distance2 + (reach - other) * (reach + other)) / (2 * distance);
    double height2 = (reach - along) * (reach + along);
    double aside = disc->side * sqrt(fmax(height2, 0));
    point at = {drop->x[i] + along * ex - aside * ey, drop->y[i] + along * ey + aside * ex};
    consider(drop, disc, at, MEET_DISC, k, nearest);
}

static meeting look_ahead(const scree_drop_2d *drop, const mover *disc)
{
    meeting nearest;
    meet_box(drop, disc, &nearest);
    // The path ahead lies between the present point and the equator of the support; touched discs within `reach` of it.
    double reach = drop->largest + disc->radius;
    double equator = drop->x[disc->support] + disc->side * (drop->radius[disc->support] + disc->radius);
    double left = fmin(disc->at.x, equator), right = fmax(disc->at.x, equator);
    size_t first = scree_cell_within(left - reach, drop->cell, drop->columns);
    size_t last = scree_cell_within(right + reach, drop->cell, drop->columns);
    size_t bottom = scree_cell_within(drop->y[disc->support] - reach, drop->cell, drop->rows);
    size_t top = scree_cell_within(disc->at.y + reach, drop->cell, drop->rows);
    for (size_t row = bottom; row <= top; row++)
        for (size_t column = first; column <= last; column++)
            for (uint32_t k = drop->head[row * drop->columns + column]; k > 0; k = drop->next[k - 1])
                meet_disc(drop, disc, k - 1, &nearest);
    return nearest;
}

/// Falls to the next support, which is NOTHING on the floor.
static void fall(const scree_drop_2d *drop, mover *disc)
{
    double y;
    disc->support = look_down(drop, disc, disc->at, &y);
    disc->at.y = y;
    if (disc->support != NOTHING) disc->side = disc->at.x < drop->x[disc->support] ? -1 : 1;
}

/// Rests disc `index` at its place on one or two supports (NOTHING: floor or wall).
static scree_status rest(scree_drop_2d *drop, size_t index, const mover *disc, uint32_t other, scree_error *error)
{
    double level = disc->at.y;
    if (disc->support != NOTHING) level = fmax(level, drop->level[disc->support]);
    if (other != NOTHING) level = fmax(level, drop->level[other]);
    drop->level[index] = level;
    return insert(drop, index, disc->at, error);
}

scree_status scree_drop_2d_add(scree_drop_2d *drop, size_t index, double x, scree_error *error)
{
    mover disc = {.radius = drop->radius[index], .at = {x, INFINITY}, .support = NOTHING};
    fall(drop, &disc);
    for (int events = 0; events < MOST_EVENTS; events++) {
        if (disc.support == NOTHING) return rest(drop, index, &disc, NOTHING, error);
        meeting next = look_ahead(drop, &disc);
        disc.at = next.at;
        if (next.kind == MEET_EQUATOR) {
            fall(drop, &disc);
            continue;
        }
        bool straddled = next.kind == MEET_DISC && disc.side * (drop->x[next.disc] - disc.at.x) >= 0;
        if (next.kind == MEET_REST || straddled) return rest(drop, index, &disc, next.disc, error);
        disc.support = next.disc;
    }
    return scree_error_set(error, SCREE_ERROR_INPUT, "disc %zu of radius %g m finds no position of rest", index,
                           disc.radius);
}
