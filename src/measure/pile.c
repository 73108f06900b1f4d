/// Measuring a pile.
#include "measure/pile.h"

#include "base/integer_sum.h"
#include "comm/comm.h"
#include "shape/outline_extent.h"
#include "shape/polygons.h"
#include "shape/wall_set.h"

#include <math.h>

// ---- which grains ------------------------------------------------------------------------------------------------

/// All of whose velocity is prescribed.
static bool is_fixed(const scree_state *state, size_t row)
{
    const unsigned all = state->dimension == 2 ? 3 : 7;
    return (scree_body_held(state, row) & all) == all;
}

/// The one that stands for all that hang together with this row: the highest number, which is that of what stands.
static uint32_t root_of(uint32_t *parent, uint32_t row)
{
    while (parent[row] != row) row = parent[row] = parent[parent[row]];
    return row;
}

static void join(uint32_t *parent, uint32_t one, uint32_t other)
{
    uint32_t a = root_of(parent, one), b = root_of(parent, other);
    if (a < b)
        parent[a] = b;
    else
        parent[b] = a;
}

/// Whether the contact is with this wall of the case.
static bool is_of_wall(const scree_work *work, const scree_contact *contact, int wall)
{
    return contact->wall && contact->second >= SCREE_PRIMITIVE_ID &&
           scree_primitive_surface(work->wall_set, contact->second - SCREE_PRIMITIVE_ID) == wall;
}

/// What the pile rests on: this wall, or all walls.
static bool is_plate(const scree_work *work, const scree_contact *contact, int plate)
{
    return contact->wall && (plate < 0 || is_of_wall(work, contact, plate));
}

static scree_status find_members(const scree_state *state, const scree_work *work, const scree_contact_table *table,
                                 int plate, scree_pile *pile, scree_error *error)
{
    const uint32_t stands = (uint32_t)state->count;
    uint32_t *parent;
    scree_status status = scree_allocate(&parent, (size_t)stands + 1, sizeof *parent, error);
    if (!status) status = scree_allocate(&pile->member, (size_t)stands + 1, sizeof *pile->member, error);
    for (uint32_t row = 0; row <= stands && !status; row++)
        parent[row] = row < stands && is_fixed(state, row) ? stands : row;
    for (size_t c = 0; c < table->count && !status; c++) {
        const scree_contact *contact = &table->contact[c];
        if (!contact->wall || is_plate(work, contact, plate))
            join(parent, contact->first, contact->wall ? stands : contact->second);
    }
    for (uint32_t row = 0; row < stands && !status; row++) {
        bool in = !is_fixed(state, row) && scree_body_is_grain(state, row) && root_of(parent, row) == stands;
        pile->member[row] = in;
        pile->grains += in;
    }
    for (size_t c = 0; c < table->count && !status; c++)
        pile->hanging += table->contact[c].wall && !pile->member[table->contact[c].first];
    scree_release(&parent);
    return status;
}

// ---- forces and levels -------------------------------------------------------------------------------------------

/// Upward force of the contact on its first body [N].
static double lift_of(const scree_contact *contact, int up)
{
    return contact->normal_force * contact->normal[up] + contact->tangential_force * contact->tangent[up];
}

/// Sums over the contacts of the pile with what stands; and where the lowest of them is.
static void sum_forces(const scree_state *state, const scree_work *work, const scree_contact_table *table, int plate,
                       scree_pile *pile)
{
    const int up = state->dimension - 1;
    scree_integer_sum sum[2] = {0};
    pile->base = INFINITY;
    while (scree_comm_sum_next(state, sum, 2))
        for (size_t c = 0; c < table->count; c++) {
            const scree_contact *contact = &table->contact[c];
            const bool first = pile->member[contact->first], second = !contact->wall && pile->member[contact->second];
            const bool outer = contact->wall ? first
                                             : (first && is_fixed(state, contact->second)) ||
                                                   (second && is_fixed(state, contact->first));
            if (!outer) continue;
            const double lift = first ? lift_of(contact, up) : -lift_of(contact, up);
            scree_integer_sum_add(&sum[0], lift);
            scree_integer_sum_add(&sum[1], plate < 0 || is_of_wall(work, contact, plate) ? lift : 0);
            pile->base = fmin(pile->base, contact->point[up]);
        }
    pile->support = scree_integer_sum_total(&sum[0]);
    pile->plate = scree_integer_sum_total(&sum[1]);
}

static void weigh(const scree_model *model, const scree_state *state, scree_pile *pile)
{
    const int up = state->dimension - 1;
    scree_integer_sum sum = {0};
    while (scree_comm_sum_next(state, &sum, 1))
        for (size_t row = 0; row < state->count; row++)
            if (pile->member[row]) scree_integer_sum_add(&sum, scree_body_mass(state, row));
    pile->weight = -model->gravity[up] * scree_integer_sum_total(&sum);
}

// ---- the outline -------------------------------------------------------------------------------------------------

/// The outline of a grain as it lies; `posed` takes its corners. In 3D it is seen along y.
static scree_core outline_of(const scree_state *state, size_t row, const scree_pile *pile, double (*posed)[2])
{
    const scree_polygons *polygons = scree_polygons_of(state);
    const double bound = scree_body_bounding_radius(state, row);
    const scree_corners *of = polygons && polygons->of && !pile->of_circles ? &polygons->of[row] : NULL;
    if (!of || of->count == 0) return (scree_core){.rounding = bound};
    const double angle = scree_body_angle(state, row), rounding = scree_rounding_of_row(polygons, row);
    scree_polygon_turn((int)of->count, (const double(*)[2])polygons->corner + of->first, cos(angle), sin(angle), posed);
    return (scree_core){
        .corner = (const double(*)[2])posed, .count = (int)of->count, .bound = bound - rounding, .rounding = rounding};
}

/// Raises the columns that a grain covers.
static void cover(const scree_state *state, size_t row, double begin, double width, scree_pile *pile)
{
    scree_vector place;
    double posed[SCREE_POLYGON_CORNERS][2], height;
    scree_body_position(state, row, place);
    const scree_core outline = outline_of(state, row, pile, posed);
    const scree_outline_extent extent = scree_outline_extent_of(&outline);
    const size_t from = (size_t)floor((place[0] + extent.low[0] - begin) / width);
    const size_t to = (size_t)floor((place[0] + extent.high[0] - begin) / width);
    for (size_t k = from; k <= to && k < pile->columns; k++) {
        scree_pile_column *column = &pile->column[k];
        if (!scree_outline_highest(&outline, column->x - place[0], 0.5 * width, &height)) continue;
        height = place[state->dimension - 1] + height - pile->base;
        if (!(column->height >= height)) column->height = height;
    }
}

/// Lets the top rise to that of a grain, and the ends of the columns go to its own.
static void stretch(const scree_state *state, size_t row, scree_pile *pile, double *low, double *high)
{
    scree_vector place;
    double posed[SCREE_POLYGON_CORNERS][2];
    scree_body_position(state, row, place);
    const scree_core outline = outline_of(state, row, pile, posed);
    const scree_outline_extent extent = scree_outline_extent_of(&outline);
    const double top = place[state->dimension - 1] + extent.high[1], apex = place[0] + extent.top;
    *low = fmin(*low, place[0] + extent.low[0]);
    *high = fmax(*high, place[0] + extent.high[0]);
    // Of two that are equally high the left one, whatever the order of the rows.
    if (isnan(pile->top) || top > pile->top || (top == pile->top && apex < pile->apex)) {
        pile->top = top;
        pile->apex = apex;
    }
}

static scree_status make_columns(const scree_model *model, const scree_state *state, scree_pile *pile,
                                 scree_error *error)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t row = 0; row < state->count; row++)
        if (pile->member[row]) stretch(state, row, pile, &low, &high);
    pile->columns = (size_t)ceil((high - low) / model->mean_radius);
    const double width = (high - low) / (double)pile->columns;
    scree_status status = scree_allocate(&pile->column, pile->columns, sizeof *pile->column, error);
    for (size_t k = 0; k < pile->columns && !status; k++)
        pile->column[k] = (scree_pile_column){low + ((double)k + 0.5) * width, NAN};
    for (size_t row = 0; row < state->count && !status; row++)
        if (pile->member[row]) cover(state, row, low, width, pile);
    return status;
}

/// m; 0 with a single one.
static double column_width(const scree_pile *pile)
{
    return pile->columns > 1 ? pile->column[1].x - pile->column[0].x : 0;
}

/// The column that a place lies in.
static size_t column_of(const scree_pile *pile, double x)
{
    const double width = pile->columns > 1 ? pile->column[1].x - pile->column[0].x : 1;
    const double at = floor((x - pile->column[0].x) / width + 0.5);
    return at <= 0 ? 0 : at >= (double)pile->columns ? pile->columns - 1 : (size_t)at;
}

/// The last column of the heap from the apex on in the direction of `step` (1, -1): behind it is no grain for two
/// columns, a mean diameter.
static size_t foot(const scree_pile *pile, int step)
{
    size_t last = column_of(pile, pile->apex);
    int gap = 0;
    for (size_t k = last; k < pile->columns && gap < 2; k += (size_t)step) { // below 0 it is large
        gap = isnan(pile->column[k].height) ? gap + 1 : 0;
        if (gap == 0) last = k;
    }
    return last;
}

/// Slope of the line of least squares through the surface of one side, as an angle.
static double fit(const scree_pile *pile, size_t from, size_t to, int step)
{
    const double height = pile->top - pile->base;
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (size_t k = from;; k += (size_t)step) {
        const scree_pile_column *c = &pile->column[k];
        if (c->height > 0.1 * height && c->height < 0.9 * height) {
            const double away = c->x - pile->apex;
            n++, x += away, y += c->height, xx += away * away, xy += away * c->height;
        }
        if (k == to) break;
    }
    const double spread = n * xx - x * x;
    return n >= 3 && spread > 0 ? atan(-step * (n * xy - x * y) / spread) : NAN;
}

static void find_angles(scree_pile *pile)
{
    const double height = pile->top - pile->base, half = 0.5 * column_width(pile);
    const size_t apex = column_of(pile, pile->apex), left = foot(pile, -1), right = foot(pile, 1);
    pile->left = pile->column[left].x - half;
    pile->right = pile->column[right].x + half;
    pile->angle[0] = atan2(height, pile->apex - pile->left);
    pile->angle[1] = atan2(height, pile->right - pile->apex);
    pile->fitted[0] = fit(pile, apex, left, -1);
    pile->fitted[1] = fit(pile, apex, right, 1);
}

// ---- what is in it -----------------------------------------------------------------------------------------------

/// Area under the surface of the heap [m2].
static double area_under(const scree_pile *pile)
{
    const double width = column_width(pile);
    double area = 0;
    for (size_t k = 0; k < pile->columns; k++)
        if (pile->column[k].x > pile->left && pile->column[k].x < pile->right && !isnan(pile->column[k].height))
            area += width * pile->column[k].height;
    return area;
}

/// Solid fraction, in the plane.
static double solid_of(const scree_state *state, const scree_pile *pile)
{
    scree_integer_sum sum = {0};
    while (scree_integer_sum_next(&sum, 1))
        for (size_t row = 0; row < state->count; row++) {
            const double x = state->row[row].x;
            if (!pile->member[row] || x < pile->left || x > pile->right) continue;
            scree_integer_sum_add(&sum, scree_body_volume(state, row));
        }
    return state->dimension == 2 ? scree_integer_sum_total(&sum) / area_under(pile) : NAN;
}

/// Contacts a grain, and the share of the plate's force that acts on the middle third of the foot.
static void count_contacts(const scree_state *state, const scree_work *work, const scree_contact_table *table,
                           int plate, scree_pile *pile)
{
    const int up = state->dimension - 1;
    const double third = (pile->right - pile->left) / 3, from = pile->left + third, to = pile->right - third;
    scree_integer_sum middle = {0};
    size_t ends = 0;
    while (scree_integer_sum_next(&middle, 1)) {
        ends = 0;
        for (size_t c = 0; c < table->count; c++) {
            const scree_contact *contact = &table->contact[c];
            ends += pile->member[contact->first];
            ends += !contact->wall && pile->member[contact->second];
            const bool on = pile->member[contact->first] && is_plate(work, contact, plate) &&
                            contact->point[0] >= from && contact->point[0] <= to;
            scree_integer_sum_add(&middle, on ? lift_of(contact, up) : 0);
        }
    }
    pile->coordination = (double)ends / (double)pile->grains;
    pile->middle = scree_integer_sum_total(&middle) / pile->plate;
}

// ---- the whole ---------------------------------------------------------------------------------------------------

static scree_status measure(const scree_model *model, const scree_state *state, const scree_work *work,
                            const scree_contact_table *table, int plate, bool of_circles, scree_pile *pile,
                            scree_error *error)
{
    *pile = (scree_pile){.of_circles = of_circles, .base = NAN, .top = NAN, .left = NAN, .right = NAN, .apex = NAN};
    pile->solid_fraction = pile->coordination = pile->middle = NAN;
    for (int k = 0; k < 2; k++) pile->angle[k] = pile->fitted[k] = NAN;
    scree_status status = find_members(state, work, table, plate, pile, error);
    if (!status && pile->grains > 0) {
        sum_forces(state, work, table, plate, pile);
        weigh(model, state, pile);
        status = make_columns(model, state, pile, error);
        if (!status) {
            find_angles(pile);
            pile->solid_fraction = solid_of(state, pile);
            count_contacts(state, work, table, plate, pile);
        }
    }
    if (status) scree_pile_destroy(pile);
    return status;
}

scree_status scree_pile_measure(const scree_model *model, const scree_state *state, const scree_work *work,
                                const scree_contact_table *table, int plate, scree_pile *pile, scree_error *error)
{
    return measure(model, state, work, table, plate, false, pile, error);
}

scree_status scree_pile_measure_circles(const scree_model *model, const scree_state *state, const scree_work *work,
                                        const scree_contact_table *table, scree_pile *pile, scree_error *error)
{
    return measure(model, state, work, table, -1, true, pile, error);
}

void scree_pile_destroy(scree_pile *pile)
{
    scree_release(&pile->member);
    scree_release(&pile->column);
    pile->columns = pile->grains = 0;
}

/// Height of the surface in a column, 0 where there is no grain; and the part of it that lies between two places.
static double part_of(const scree_pile *pile, size_t k, double from, double to, double part[2])
{
    const double half = 0.5 * column_width(pile);
    part[0] = fmax(from, pile->column[k].x - half);
    part[1] = fmax(part[0], fmin(to, pile->column[k].x + half));
    return isnan(pile->column[k].height) ? 0 : pile->column[k].height;
}

void scree_pile_plateau(const scree_pile *pile, double depth, double *left, double *right)
{
    const double from = *left, to = *right;
    double area = 0, part[2];
    for (size_t k = 0; k < pile->columns; k++) {
        const double height = part_of(pile, k, from, to, part);
        area += height * (part[1] - part[0]);
    }
    const double lowest = area / (to - from) - depth;
    if (!(lowest > 0)) return; // what stands is not lower than that; a point stays one
    *left = to, *right = from;
    for (size_t k = 0; k < pile->columns; k++) {
        if (part_of(pile, k, from, to, part) < lowest || !(part[1] > part[0])) continue;
        *left = fmin(*left, part[0]);
        *right = fmax(*right, part[1]);
    }
}
