/// Angle of the free surface of a flow or heap: a number with its fit, at every sample and over the end of a run.
///
///   slope  a plane surface seen along y (in 2D as it is): a drum, a chute. The straight line of least squares through
///          the outline (measure/pile.h) in the middle half of its width; positive where it rises with x.
///   cone   a heap of spheres about a vertical axis, through the centre of mass of the pile. The surface is the highest
///          sphere in each column, a mean diameter wide, over the ground; the line of least squares goes through their
///          tops over their distances from the axis, between a tenth and nine tenths of the height. Positive where it
///          falls outwards.
///
/// Both look at particles that hang together by contacts with what stands: what flies above is left out. The result is
/// the mean over the second half of the last stage's samples, its error half the interval of 95 % by blocks of time
/// (measure/blocks.h). Limits: the surface of spheres lies some 0.1 d above their outermost layer's mean; neither angle
/// is moved by that. Cost: linear in contacts and bodies, at each sample.
#include "case/check.h"
#include "comm/comm.h"
#include "measure/blocks.h"
#include "measure/pile.h"
#include "model/measure_keys.h"
#include "module/key_rows.h"
#include "run/conclusion.h"

#include <math.h>
#include <stdio.h>

enum { SURFACE_NONE, SURFACE_SLOPE, SURFACE_CONE };
enum { MOST_COLUMNS = 4096, FEWEST_POINTS = 3 };

typedef struct config {
    int surface;
} config;

static const scree_choice surfaces[] = {
    {"no", SURFACE_NONE, "its angle is not measured"},
    {"slope", SURFACE_SLOPE, "a plane, seen along y: a drum, a chute"},
    {"cone", SURFACE_CONE, "a heap about a vertical axis, 3D"},
    {0},
};
static const scree_key keys[] = {
    CHOICE(config, surface, surfaces, .standard = "no", .meaning = "The free surface whose angle is measured."),
};

static const config *own_config(const scree_config *whole)
{
    return whole->measure.own ? scree_config_own(&scree_module_surface, "measure", whole->measure.own) : NULL;
}

static void rules(scree_reader *reader, const scree_config *whole)
{
    const config *own = own_config(whole);
    if (own && own->surface == SURFACE_CONE && whole->dimension == 2)
        scree_rule_refuse(
            reader, "measure.surface", "slope",
            "a cone has three dimensions: a heap in two has a slope on each side, which `sources` measure");
}

static scree_status resolve(scree_model *model, scree_error *error)
{
    (void)error;
    return scree_model_keep_measure_keys(model, SCREE_SLOT_surface);
}

static int kind_of(const scree_model *model)
{
    const config *own = scree_model_numbers(model, SCREE_SLOT_surface);
    return own ? own->surface : SURFACE_NONE;
}

// ---- the line ------------------------------------------------------------------------------------------------------

typedef struct line {
    double n, x, y, xx, xy;
} line;

static void add(line *l, double x, double y)
{
    l->n++;
    l->x += x;
    l->y += y;
    l->xx += x * x;
    l->xy += x * y;
}

/// In degrees; NAN with too few points.
static double angle_of(const line *l)
{
    const double spread = l->n * l->xx - l->x * l->x;
    if (l->n < FEWEST_POINTS || !(spread > 0)) return NAN;
    return atan((l->n * l->xy - l->x * l->y) / spread) * 180 / M_PI;
}

static double slope_of(const scree_pile *pile)
{
    line l = {0};
    const double quarter = 0.25 * (pile->right - pile->left);
    for (size_t k = 0; k < pile->columns; k++) {
        const scree_pile_column *column = &pile->column[k];
        const bool middle = column->x > pile->left + quarter && column->x < pile->right - quarter;
        if (middle && !isnan(column->height)) add(&l, column->x, column->height);
    }
    return angle_of(&l);
}

/// The axis: centre of mass of the pile.
static void find_axis(const scree_state *state, const scree_pile *pile, double axis[2])
{
    scree_integer_sum sum[3] = {0}; // mass, its moments
    while (scree_comm_sum_next(state, sum, 3))
        for (size_t row = 0; row < state->count; row++) {
            scree_vector place;
            if (!pile->member[row]) continue;
            scree_body_position(state, row, place);
            scree_integer_sum_add(&sum[0], state->row[row].mass);
            for (int k = 0; k < 2; k++) scree_integer_sum_add(&sum[1 + k], state->row[row].mass * place[k]);
        }
    const double mass = scree_integer_sum_total(&sum[0]);
    for (int k = 0; k < 2; k++) axis[k] = scree_integer_sum_total(&sum[1 + k]) / mass;
}

/// Columns over the ground, a mean diameter wide, and the highest grain in each.
typedef struct ground {
    double low[2], width; ///< m
    size_t size[2];
    uint32_t *highest; ///< its row, plus 1; 0: none
} ground;

static size_t place_on(const ground *g, const scree_vector place)
{
    return (size_t)((place[0] - g->low[0]) / g->width) + g->size[0] * (size_t)((place[1] - g->low[1]) / g->width);
}

static double top_of(const scree_state *state, size_t row)
{
    scree_vector place;
    scree_body_position(state, row, place);
    return place[2] + scree_body_bounding_radius(state, row);
}

static scree_status make_ground(const scree_model *model, const scree_state *state, const scree_pile *pile, ground *g,
                                scree_error *error)
{
    double high[2] = {-INFINITY, -INFINITY};
    *g = (ground){.low = {INFINITY, INFINITY}, .width = 2 * model->mean_radius};
    for (size_t row = 0; row < state->count; row++) {
        scree_vector place;
        if (!pile->member[row]) continue;
        scree_body_position(state, row, place);
        for (int k = 0; k < 2; k++) {
            g->low[k] = fmin(g->low[k], place[k]);
            high[k] = fmax(high[k], place[k]);
        }
    }
    for (int k = 0; k < 2; k++) g->size[k] = (size_t)fmin((high[k] - g->low[k]) / g->width, MOST_COLUMNS - 1) + 1;
    return scree_allocate(&g->highest, g->size[0] * g->size[1], sizeof *g->highest, error);
}

/// Far single grains lie outside where there would be too many columns.
static bool is_on(const ground *g, const scree_vector place)
{
    for (int k = 0; k < 2; k++)
        if ((place[k] - g->low[k]) / g->width >= (double)g->size[k]) return false;
    return true;
}

static scree_status cone_of(const scree_model *model, const scree_state *state, const scree_pile *pile, double *angle,
                            scree_error *error)
{
    line l = {0};
    ground g;
    double axis[2];
    const double height = pile->top - pile->base;
    scree_status status = make_ground(model, state, pile, &g, error);
    if (status) return status;
    for (size_t row = 0; row < state->count; row++) {
        scree_vector place;
        scree_body_position(state, row, place);
        if (!pile->member[row] || !is_on(&g, place)) continue;
        uint32_t *highest = &g.highest[place_on(&g, place)];
        if (*highest == 0 || top_of(state, row) > top_of(state, *highest - 1)) *highest = (uint32_t)row + 1;
    }
    find_axis(state, pile, axis);
    for (size_t k = 0; k < g.size[0] * g.size[1]; k++) {
        scree_vector place;
        if (g.highest[k] == 0) continue;
        scree_body_position(state, g.highest[k] - 1, place);
        const double top = top_of(state, g.highest[k] - 1) - pile->base;
        if (top > 0.1 * height && top < 0.9 * height) add(&l, hypot(place[0] - axis[0], place[1] - axis[1]), top);
    }
    scree_release(&g.highest);
    *angle = -angle_of(&l);
    return SCREE_OK;
}

// ---- what is told --------------------------------------------------------------------------------------------------

static bool told(const scree_config *whole, size_t index, char name[SCREE_RESULT_NAME])
{
    const config *own = own_config(whole);
    name[0] = 0;
    return index == 0 && own && own->surface > SURFACE_NONE;
}

static const scree_result columns[] = {
    {"surface_angle", "degree",
     "of the free surface (measure.surface) with the horizontal, by a fit; positive where it rises along x, of a cone "
     "where it falls outwards"},
};

static scree_status sample(const scree_context *c, size_t index, double *value, scree_error *error)
{
    scree_pile pile;
    (void)index;
    scree_status status = scree_pile_measure(c->model, c->state, c->work, c->table, -1, &pile, error);
    if (status) return status;
    const bool cone = kind_of(c->model) == SURFACE_CONE;
    value[0] = pile.grains == 0 || cone ? NAN : slope_of(&pile);
    if (pile.grains > 0 && cone) status = cone_of(c->model, c->state, &pile, &value[0], error);
    scree_pile_destroy(&pile);
    return status;
}

static const scree_result results[] = {
    {"surface_angle", "degree", "mean angle of the free surface over the second half of the last stage"},
    {"surface_angle_error", "degree", "half its interval of 95 %, by blocks of time"},
};

static scree_status conclude(const scree_conclusion *run, scree_error *error)
{
    const double *angle = scree_series_get(run->series, "surface_angle"),
                 *stage = scree_series_get(run->series, "stage");
    const size_t rows = run->series->row_count;
    double mean, half;
    (void)error;
    if (kind_of(&run->s->model) == SURFACE_NONE || !angle || !stage || rows == 0) return SCREE_OK;
    size_t first = rows - 1;
    while (first > 0 && stage[first - 1] == stage[rows - 1]) first--;
    first += (rows - first) / 2;
    scree_blocks_mean(angle + first, rows - first, &mean, &half);
    scree_summary_set_number(run->summary, "surface_angle", mean);
    scree_summary_set_number(run->summary, "surface_angle_error", half);
    return SCREE_OK;
}

const scree_module scree_module_surface = {
    .name = "surface",
    .meaning = "angle of the free surface of heaps, drums and chutes",
    .keys = (const scree_keys[]){KEYS_OF("measure", keys, config)},
    .keys_count = 1,
    .rules = rules,
    .numbers_size = sizeof(config),
    .resolve = resolve,
    .columns = SCREE_RESULTS(columns, sample),
    .results = SCREE_RESULTS(results, NULL),
    .told = told,
    .conclude = conclude,
};
