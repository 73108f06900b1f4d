/// Averages over horizontal layers.
#include "average/layers.h"

#include "average/element.h"

#include <math.h>

enum { LINES = SCREE_AVERAGE_LAYER_LINES, LEAST = 5, MOST = 200 };

/// What lies in a layer.
typedef struct layer {
    double solid, mass, momentum[3];
    double reach[LINES]; ///< m, of its grains in directions all round; in 2D the first is right, LINES / 2 left
} layer;

static bool repeats(const scree_average_sample *sample, int direction)
{
    return sample->directions >> direction & 1;
}

scree_average_layers scree_average_layers_of(const scree_average_sample *sample)
{
    const int up = sample->dimension - 1;
    const bool cell = repeats(sample, up);
    const double height = cell ? sample->lattice[4 * up] : sample->high[up] - sample->low[up];
    const double middle = 0.5 * (sample->high[up] + sample->low[up]);
    const double wanted = round(height / (2 * sample->mean_radius));
    const size_t count = (size_t)fmax(LEAST, fmin(MOST, wanted));
    return (scree_average_layers){middle - 0.5 * height, height / (double)count, count};
}

/// Radius of the section of a grain nearest to its centre in a layer that begins `from` above its centre and ends at
/// `to`.
static double section(const scree_average_grain *grain, double from, double to)
{
    const double radius = grain->corner_count ? sqrt(grain->volume / M_PI) : grain->radius;
    const double away = from > 0 ? from : to < 0 ? -to : 0;
    return sqrt(fmax(0, radius * radius - away * away));
}

/// A box that holds the grain.
static scree_average_element element_around(const scree_average_grain *grain)
{
    scree_average_element box;
    for (int k = 0; k < 3; k++) {
        box.low[k] = grain->position[k] - 2 * grain->radius;
        box.high[k] = grain->position[k] + 2 * grain->radius;
    }
    return box;
}

static void reach_out(const scree_average_sample *sample, const scree_average_grain *grain, double radius, layer *l)
{
    const int step = sample->dimension == 3 ? 1 : LINES / 2;
    for (int k = 0; k < LINES; k += step) {
        const double angle = 2 * M_PI * k / LINES;
        const double along = grain->position[0] * cos(angle) + (step == 1 ? grain->position[1] * sin(angle) : 0);
        l->reach[k] = fmax(l->reach[k], along + radius);
    }
}

/// Adds a grain, `shift` above its own place, to the layers that it reaches into.
static void add(const scree_average_sample *sample, const scree_average_layers *layers,
                const scree_average_grain *grain, double shift, layer *of)
{
    const int up = sample->dimension - 1;
    const double height = grain->position[up] + shift;
    const double first = floor((height - grain->radius - layers->low) / layers->thickness);
    const double last = floor((height + grain->radius - layers->low) / layers->thickness);
    for (double k = fmax(0, first); k <= last && k < (double)layers->count; k++) {
        const double from = layers->low + k * layers->thickness - shift, to = from + layers->thickness;
        layer *l = &of[(size_t)k];
        scree_average_element slab = element_around(grain);
        slab.low[up] = from, slab.high[up] = to;
        const double part = scree_average_part(sample, grain, &slab);
        if (!(part > 0)) continue;
        l->solid += part * grain->volume;
        reach_out(sample, grain, section(grain, from - grain->position[up], to - grain->position[up]), l);
        if (shift != 0) continue; // the motion of images is that of a cell, not of grains
        l->mass += part * grain->mass;
        for (int i = 0; i < 3; i++) l->momentum[i] += part * grain->mass * grain->velocity[i];
    }
}

/// Area within the lines that touch the grains all round [m2]: each is as long as its neighbours leave it.
static double outlined(const layer *l)
{
    const double turn = 2 * M_PI / LINES;
    double area = 0;
    for (int k = 0; k < LINES; k++) {
        const double before = l->reach[(k + LINES - 1) % LINES], after = l->reach[(k + 1) % LINES];
        area += 0.5 * l->reach[k] * (before + after - 2 * l->reach[k] * cos(turn)) / sin(turn);
    }
    return area;
}

/// Plan of a layer: length [m] in 2D, area [m2].
static double plan_of(const scree_average_sample *sample, const layer *l)
{
    const double *h = sample->lattice;
    const double wide = repeats(sample, 0) ? h[0] : l->reach[0] + l->reach[LINES / 2];
    if (sample->dimension == 2) return wide;
    if (repeats(sample, 0) && repeats(sample, 1)) return fabs(h[0] * h[4] - h[1] * h[3]);
    if (!repeats(sample, 0) && !repeats(sample, 1)) return outlined(l);
    return wide * (repeats(sample, 1) ? h[4] : l->reach[LINES / 4] + l->reach[3 * LINES / 4]);
}

static scree_status tell(const scree_average_sample *sample, const scree_average_layers *layers, size_t k,
                         const layer *l, scree_average_table *table, scree_error *error)
{
    static const char *const velocity[3] = {"velocity_x", "velocity_y", "velocity_z"};
    scree_status status = scree_average_table_begin_row(table, error);
    if (status) return status;
    scree_average_table_take(table, "height", "m", layers->low + ((double)k + 0.5) * layers->thickness);
    scree_average_table_take(table, "solid_fraction", "1",
                             l->solid > 0 ? l->solid / (plan_of(sample, l) * layers->thickness) : NAN);
    for (int i = 0; i < sample->dimension; i++)
        scree_average_table_take(table, velocity[i], "m/s", l->mass > 0 ? l->momentum[i] / l->mass : NAN);
    return scree_average_table_end_row(table, error);
}

scree_status scree_average_layers_table(const scree_average_sample *sample, const scree_average_layers *layers,
                                        scree_average_table *table, scree_error *error)
{
    const int up = sample->dimension - 1;
    const double rise = repeats(sample, up) ? sample->lattice[4 * up] : 0;
    layer *of;
    scree_status status = scree_allocate(&of, layers->count, sizeof *of, error);
    if (status) return status;
    for (size_t k = 0; k < layers->count; k++)
        for (int i = 0; i < LINES; i++) of[k].reach[i] = -INFINITY;
    for (size_t p = 0; p < sample->bodies; p++) {
        if (!sample->grain[p].counted) continue;
        for (int image = rise > 0 ? -1 : 0; image <= (rise > 0 ? 1 : 0); image++)
            add(sample, layers, &sample->grain[p], image * rise, of);
    }
    for (size_t k = 0; k < layers->count && !status; k++) status = tell(sample, layers, k, &of[k], table, error);
    scree_release(&of);
    return status;
}
