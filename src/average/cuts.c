/// Cuts and maps.
#include "average/cuts.h"

#include "average/elastic.h"
#include "base/thread_pool.h"

#include <math.h>
#include <stdio.h>

enum { BLOCK = 2048 }; ///< elements that are found before they are told

// ---- the view ----------------------------------------------------------------------------------------------------

/// Upward force [N] on the grains of all that is none.
static double plate_force(const scree_average_sample *sample)
{
    const int up = sample->dimension - 1;
    double force = 0;
    for (size_t c = 0; c < sample->contacts; c++) {
        const scree_average_contact *contact = &sample->contact[c];
        const bool first = sample->grain[contact->first].counted;
        const bool second = contact->second != SCREE_AVERAGE_OUTSIDE && sample->grain[contact->second].counted;
        if (first == second) continue;
        force += (first ? 1 : -1) * contact->force[up];
    }
    return force;
}

/// Along x; where the sample repeats itself there, the middle of its cell.
static double centre_of_mass(const scree_average_sample *sample, const scree_average_surface *surface)
{
    double mass = 0, moment = 0;
    if (scree_average_repeats(sample, 0)) return 0.5 * (surface->left + surface->right);
    for (size_t p = 0; p < sample->bodies; p++) {
        const scree_average_grain *grain = &sample->grain[p];
        const double x = grain->position[0];
        if (!grain->counted || x < surface->left || x > surface->right) continue;
        mass += grain->mass;
        moment += grain->mass * x;
    }
    return moment / mass;
}

static scree_average_frame find_frame(const scree_average_sample *sample, const scree_average_plan *plan,
                                      const scree_average_surface *s)
{
    const double apart = s->volume / (double)sample->counted; // room of a grain
    const int up = sample->dimension - 1;
    scree_average_frame frame = {.side =
                                     plan->grains > 0 ? pow(plan->grains * apart, 1.0 / sample->dimension) : plan->side,
                                 .half = 0.5 * (s->right - s->left),
                                 .base = s->base,
                                 .height = s->highest - s->base,
                                 .middle = 0.5 * (sample->low[1] + sample->high[1]),
                                 .axis = plan->axis == SCREE_AVERAGE_AXIS_MASS   ? centre_of_mass(sample, s)
                                         : plan->axis == SCREE_AVERAGE_AXIS_APEX ? s->apex
                                                                                 : plan->axis_given};
    if (plan->fits) frame.side = fmin(frame.side, fmin(frame.height, 2 * frame.half));
    for (int k = 0; k < 3; k++) {
        frame.low[k] = k == 0 ? s->left : k == up ? s->base : sample->low[k];
        frame.high[k] = k == 0 ? s->right : k == up ? s->highest : sample->high[k];
    }
    return frame;
}

static void place(const scree_average_sample *sample, const scree_average_plan *plan, scree_average_view *view)
{
    view->frame = plan->frame ? *plan->frame : find_frame(sample, plan, &view->surface);
    view->grains = pow(view->frame.side, sample->dimension) * (double)sample->counted / view->surface.volume;
    view->bulk_density = sample->mass / (view->surface.volume * sample->thickness);
    view->weight = -sample->mass * sample->gravity[sample->dimension - 1];
    view->plate = plate_force(sample);
}

static scree_status check_side(const scree_average_view *view, scree_error *error)
{
    const double width = 2 * view->frame.half;
    if (view->frame.side <= view->frame.height && view->frame.side <= width) return SCREE_OK;
    return scree_error_refuse(
        error, "--element", NULL,
        "an element of %.3g m (%.0f grains) is larger than the sample, which is %.3g m wide and %.3g m high with %zu "
        "grains: take a smaller one",
        view->frame.side, view->grains, width, view->frame.height, view->sample->counted);
}

/// How far [m] elements reach out of the box of the sample along directions in which it repeats itself: half a side,
/// those beside them of the difference quotient a whole one more, and as far as a frame of another instant is larger.
static double reach_of(const scree_average_view *view)
{
    double beyond = 0;
    for (int k = 0; k < view->sample->dimension; k++)
        if (scree_average_repeats(view->sample, k)) beyond = fmax(beyond, view->frame.high[k] - view->sample->high[k]);
    return beyond + (view->moved ? 1.5 : 0.5) * view->frame.side;
}

scree_status scree_average_view_open(scree_average_sample *sample, const scree_average_plan *plan,
                                     scree_average_view *view, scree_error *error)
{
    *view = (scree_average_view){.sample = sample};
    scree_status status = scree_average_surface_find(sample, &view->surface, error);
    if (!status) {
        place(sample, plan, view);
        status = check_side(view, error);
    }
    for (size_t p = 0; p < sample->bodies; p++) view->moved = view->moved || sample->grain[p].moved;
    if (!status) status = scree_average_sample_repeat(sample, reach_of(view), error);
    if (!status)
        status =
            scree_average_bins_make(sample, fmax(2 * sample->mean_radius, view->frame.side / 4), &view->bins, error);
    if (!status && view->moved) status = scree_average_strain_open(sample, &view->bins, &view->strain, error);
    if (status) scree_average_view_close(view);
    return status;
}

void scree_average_view_close(scree_average_view *view)
{
    scree_average_surface_destroy(&view->surface);
    scree_average_bins_destroy(&view->bins);
    scree_average_strain_close(&view->strain);
}

bool scree_average_are_few(double grains)
{
    return grains < SCREE_AVERAGE_FEW * (1 - 1e-9);
}

// ---- elements ----------------------------------------------------------------------------------------------------

/// Where an element stands, and what is found of it.
typedef struct place_found {
    scree_vector centre;
    double side;
    scree_average_value value;
    scree_vector displacement;
    double gradient[SCREE_AVERAGE_STRAINS][9];
} place_found;

/// A block of elements that threads find together.
typedef struct block {
    const scree_average_view *view;
    place_found *item;
    size_t count;
} block;

static scree_average_element element_of(const scree_average_view *view, const place_found *at)
{
    return scree_average_element_at(at->centre,
                                    (scree_vector){at->side, at->side, view->sample->dimension == 3 ? at->side : 0});
}

/// Every so many elements: those near the surface cost less than those inside, so shares are spread over the block.
static void find_share(void *argument, int index, int count)
{
    const block *b = argument;
    for (size_t k = (size_t)index; k < b->count; k += (size_t)count) {
        place_found *item = &b->item[k];
        const scree_average_element element = element_of(b->view, item);
        scree_average_measure(b->view->sample, &b->view->bins, &b->view->surface, &element, &item->value);
        if (b->view->moved) scree_average_strain_find(&b->view->strain, &element, item->displacement, item->gradient);
    }
}

/// Minus the vertical normal stress [Pa].
static double vertical_pressure(const scree_average_view *view, const scree_average_value *value)
{
    const int up = view->sample->dimension - 1;
    return -value->centres.moment[4 * up] / (value->volume * view->sample->thickness);
}

static void tell_found(const scree_average_view *view, const scree_average_plan *plan, place_found *found,
                       scree_average_table *table)
{
    const scree_average_sample *sample = view->sample;
    const double g = -sample->gravity[sample->dimension - 1];
    scree_average_tell(sample, &found->value, plan->fields, scree_average_table_take, table);
    if (view->moved)
        scree_average_strain_tell(sample->dimension, found->displacement, found->gradient, scree_average_table_take,
                                  table);
    if (view->moved && plan->fields & SCREE_AVERAGE_ELASTIC)
        scree_average_elastic_tell(sample, &found->value, found->gradient, scree_average_table_take, table);
    if (plan->fields & SCREE_AVERAGE_STRESS)
        scree_average_table_take(
            table, "vertical_pressure_scaled", "1",
            g > 0 ? vertical_pressure(view, &found->value) / (view->bulk_density * g * view->frame.height) : NAN);
}

scree_status scree_average_elements_table(const scree_average_view *view, const scree_average_plan *plan, size_t count,
                                          scree_average_placing *lay, void *user, scree_average_table *table,
                                          scree_error *error)
{
    scree_thread_pool *pool = NULL;
    block b = {.view = view};
    const size_t most = count < BLOCK ? count : BLOCK;
    scree_status status = scree_allocate(&b.item, most, sizeof *b.item, error);
    for (size_t first = 0; first < count && !status; first += b.count) {
        b.count = count - first < most ? count - first : most;
        for (size_t k = 0; k < b.count; k++) lay(user, first + k, b.item[k].centre, &b.item[k].side, NULL);
        scree_thread_pool_run(&pool, plan->threads < 1 ? 1 : plan->threads, find_share, &b);
        for (size_t k = 0; k < b.count && !status; k++) {
            scree_vector centre;
            double side;
            status = scree_average_table_begin_row(table, error);
            if (status) break;
            lay(user, first + k, centre, &side, table);
            tell_found(view, plan, &b.item[k], table);
            status = scree_average_table_end_row(table, error);
        }
    }
    scree_thread_pool_destroy(&pool);
    scree_release(&b.item);
    return status;
}

// ---- tables ------------------------------------------------------------------------------------------------------

/// What places of tables follow from.
typedef struct layout {
    const scree_average_view *view;
    const scree_average_plan *plan;
    size_t number[3]; ///< of the map
} layout;

static void place_on_cut(void *user, size_t k, scree_vector centre, double *side, scree_average_table *table)
{
    const layout *l = user;
    const scree_average_frame *f = &l->view->frame;
    const int up = l->view->sample->dimension - 1;
    const size_t cut = k / l->plan->points, half = l->plan->points / 2;
    const double at = half > 0 ? ((double)(k % l->plan->points) - (double)half) / (double)half : 0;
    *side = f->side;
    centre[0] = f->axis + at * f->half;
    centre[1] = f->middle;
    centre[2] = 0;
    centre[up] = f->base + 0.5 * f->side + l->plan->height[cut] * (f->height - f->side);
    if (!table) return;
    scree_average_table_take(table, "cut", "1", (double)cut);
    scree_average_table_take(table, "height", "1", l->plan->height[cut]);
    scree_average_table_take(table, up == 1 ? "y" : "z", "m", centre[up] - f->base);
    scree_average_table_take(table, "place", "1", at);
    scree_average_table_take(table, "x", "m", centre[0] - f->axis);
}

scree_status scree_average_cuts_table(const scree_average_view *view, const scree_average_plan *plan,
                                      scree_average_table *table, scree_error *error)
{
    layout l = {.view = view, .plan = plan};
    return scree_average_elements_table(view, plan, plan->cuts * plan->points, place_on_cut, &l, table, error);
}

void scree_average_grid(const scree_average_plan *plan, int dimension, size_t number[3])
{
    const bool upright = dimension == 3 && plan->grid[2] == 0;
    number[0] = plan->grid[0];
    number[1] = upright ? 1 : plan->grid[1];
    number[2] = upright ? plan->grid[1] : dimension == 3 ? plan->grid[2] : 1;
}

static void place_on_map(void *user, size_t k, scree_vector centre, double *side, scree_average_table *table)
{
    const layout *l = user;
    const scree_average_frame *f = &l->view->frame;
    const size_t *n = l->number, number[3] = {k % n[0], k / n[0] % n[1], k / n[0] / n[1]};
    *side = f->side;
    for (int i = 0; i < 3; i++) {
        const bool there = i < l->view->sample->dimension;
        centre[i] = there ? f->low[i] + ((double)number[i] + 0.5) / (double)n[i] * (f->high[i] - f->low[i]) : 0;
        if (there && table) scree_average_table_take(table, (const char *[]){"x", "y", "z"}[i], "m", centre[i]);
    }
}

scree_status scree_average_map_table(const scree_average_view *view, const scree_average_plan *plan,
                                     scree_average_table *table, scree_error *error)
{
    layout l = {.view = view, .plan = plan};
    scree_average_grid(plan, view->sample->dimension, l.number);
    return scree_average_elements_table(view, plan, l.number[0] * l.number[1] * l.number[2], place_on_map, &l, table,
                                        error);
}

void scree_average_plate_force(const scree_average_view *view, double *averages, double *weight)
{
    const scree_average_sample *sample = view->sample;
    const int up = sample->dimension - 1;
    // One element that spans the sample is the sum of elements side by side.
    scree_average_element row;
    scree_average_value value;
    for (int k = 0; k < 3; k++) {
        const double beyond = scree_average_repeats(sample, k) ? 0 : view->frame.side; // images are the same grains
        row.low[k] = sample->low[k] - beyond;
        row.high[k] = sample->high[k] + beyond;
    }
    row.low[up] = view->frame.base;
    row.high[up] = view->frame.base + view->frame.side;
    scree_average_measure(sample, &view->bins, &view->surface, &row, &value);
    *averages = -value.parts.moment[4 * up] / view->frame.side;
    *weight = 0;
    for (size_t p = 0; p < sample->bodies; p++) {
        const scree_average_grain *grain = &sample->grain[p];
        const double above = (grain->position[up] - view->frame.base) / view->frame.side;
        if (grain->counted) *weight -= grain->mass * sample->gravity[up] * fmax(0, fmin(1, above));
    }
}
