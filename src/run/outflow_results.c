/// How fast particles come out of outlets, and Beverloo's law beside it.
///
/// Rate: of the mass that has come out (column outflow_mass) over the time in which it grows from a fifth to seven
/// tenths of its last value, the steady part of a silo that empties. The time is cut into equal pieces
/// (measure/blocks.h); the rate is the mean of theirs, its error half the interval of 95 % of that mean, so that
/// fluctuations and a rate that falls show in it.
///
/// Law: W = C rho_b sqrt(g) (D - k d)^(5/2) of a circular orifice, C 0.58, k 1.5 for spheres (Beverloo, Leniger, van de
/// Velde 1961; k of spheres after Nedderman 1992); of a slit, for each length of it, W = C rho_b sqrt(g)
/// (D - k d)^(3/2), C 1.03 (Nedderman 1992). d: mean diameter of the particles. The law is fitted to fine materials:
/// below D = 6 d orifices clog, and it says nothing. Cost: a pass over the series.
#include "load/outlet.h"
#include "measure/blocks.h"
#include "run/conclusion.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define FIRST_SHARE   0.2
#define LAST_SHARE    0.7
#define FEWEST_GRAINS 20 // below these a rate says nothing

#define RATES(name)                                                                                                    \
    {name "outflow_rate", "kg/s", "mass that comes out in a second, while a fifth to seven tenths of it do"},          \
        {name "outflow_rate_error", "kg/s", "half its interval of 95 %, from five pieces of that time"},               \
        {name "outflow_begin", "s", "time at which a fifth has come out"},                                             \
        {name "outflow_end", "s", "time at which seven tenths have"},                                                  \
        {name "beverloo_rate", "kg/s", "rate by Beverloo's law for the orifice that the outlet names"},                \
    {                                                                                                                  \
        name "beverloo_ratio", "1", "outflow_rate over beverloo_rate"                                                  \
    }
static const scree_result columns[] = {
    {"outflow", "1", "particles that have come into the regions of all outlets, or were taken out there"},
    {"outflow_mass", "kg", "their mass"},
};
static const scree_result results[] = {
    {"outflow", "1", "particles that have come into the regions of all outlets, or were taken out there"},
    {"outflow_mass", "kg", "their mass"},
    RATES(""),
    RATES("_"),
};

static bool told(const scree_config *whole, size_t index, char name[SCREE_RESULT_NAME])
{
    name[0] = 0;
    return index == 0 && scree_outlet_of(whole->loads, whole->load_count, 0);
}

static scree_status sample(const scree_context *c, size_t index, double *value, scree_error *error)
{
    (void)index, (void)error;
    value[0] = value[1] = 0;
    for (size_t k = 0; scree_outlet_of(c->model->loads, c->model->load_count, k); k++) {
        double own[2];
        scree_outlet_sample(c->model, c->state, k, own);
        value[0] += own[0];
        value[1] += own[1];
    }
    return SCREE_OK;
}

/// A column that grows.
typedef struct growth {
    const double *time, *mass;
    size_t count;
} growth;

/// When it first has a mass.
static double time_of(const growth *g, double mass)
{
    for (size_t k = 1; k < g->count; k++)
        if (g->mass[k] >= mass)
            return g->time[k - 1] +
                   (g->time[k] - g->time[k - 1]) * (mass - g->mass[k - 1]) / (g->mass[k] - g->mass[k - 1]);
    return NAN;
}

static double mass_at(const growth *g, double time)
{
    for (size_t k = 1; k < g->count; k++)
        if (g->time[k] >= time && g->time[k] > g->time[k - 1])
            return g->mass[k - 1] +
                   (g->mass[k] - g->mass[k - 1]) * (time - g->time[k - 1]) / (g->time[k] - g->time[k - 1]);
    return g->mass[g->count - 1];
}

/// Mean of the rates of the pieces, and half of its interval.
static void find_rate(const growth *g, double begin, double end, double *rate, double *half)
{
    double piece[SCREE_BLOCKS];
    for (int k = 0; k < SCREE_BLOCKS; k++) {
        const double from = begin + (end - begin) * k / SCREE_BLOCKS,
                     to = begin + (end - begin) * (k + 1) / SCREE_BLOCKS;
        piece[k] = (mass_at(g, to) - mass_at(g, from)) / (to - from);
    }
    scree_blocks_interval(piece, rate, half);
}

/// Rate [kg/s] by Beverloo's law; NAN: no orifice is said, or one that nothing comes through.
static double beverloo(const scree_model *model, const scree_outlet *outlet)
{
    const bool in_3d = model->dimension == 3;
    const double wide = outlet->orifice - 1.5 * 2 * model->mean_radius, g = scree_length(model->gravity);
    const double bulk = isnan(outlet->bulk_density) ? (in_3d ? 0.6 : 0.82) * model->density[0] : outlet->bulk_density;
    if (!(wide > 0)) return NAN;
    return in_3d ? 0.58 * bulk * sqrt(g) * pow(wide, 2.5) : 1.03 * bulk * sqrt(g) * pow(wide, 1.5) * model->thickness;
}

static const double *column_of(const scree_conclusion *run, const char *prefix, const char *name)
{
    char full[2 * SCREE_RESULT_NAME];
    (void)snprintf(full, sizeof full, "%s%s", prefix, name);
    return scree_series_get(run->series, full);
}

static void set(const scree_conclusion *run, const char *prefix, const char *name, double value)
{
    char full[2 * SCREE_RESULT_NAME];
    (void)snprintf(full, sizeof full, "%s%s", prefix, name);
    if (!isnan(value)) scree_summary_set_number(run->summary, full, value);
}

/// Of the columns behind `prefix`; law: rate [kg/s] by Beverloo's.
static void tell(const scree_conclusion *run, const char *prefix, double law)
{
    double rate, half;
    const growth g = {column_of(run, "", "time"), column_of(run, prefix, "outflow_mass"), run->series->row_count};
    const double *number = column_of(run, prefix, "outflow");
    set(run, prefix, "beverloo_rate", law);
    if (!g.time || !g.mass || !number || g.count < 2 || !(number[g.count - 1] >= FEWEST_GRAINS)) return;
    const double last = g.mass[g.count - 1], begin = time_of(&g, FIRST_SHARE * last),
                 end = time_of(&g, LAST_SHARE * last);
    if (!(end > begin)) return;
    find_rate(&g, begin, end, &rate, &half);
    set(run, prefix, "outflow_rate", rate);
    set(run, prefix, "outflow_rate_error", half);
    set(run, prefix, "outflow_begin", begin);
    set(run, prefix, "outflow_end", end);
    set(run, prefix, "beverloo_ratio", rate / law);
}

/// Each outlet, and all together: an outlet without an orifice leaves the whole without a law.
static scree_status conclude(const scree_conclusion *run, scree_error *error)
{
    const scree_outlet *outlet;
    const scree_model *model = &run->s->model;
    double law = 0;
    size_t k = 0;
    (void)error;
    for (; (outlet = scree_outlet_of(model->loads, model->load_count, k)); k++) {
        char prefix[SCREE_RESULT_NAME];
        scree_outlet_name(outlet, k, prefix);
        (void)snprintf(prefix + strlen(prefix), 2, "_");
        tell(run, prefix, beverloo(model, outlet));
        law += beverloo(model, outlet);
    }
    const double *number = column_of(run, "", "outflow"), *mass = column_of(run, "", "outflow_mass");
    if (k == 0 || !number || !mass || run->series->row_count == 0) return SCREE_OK;
    set(run, "", "outflow", number[run->series->row_count - 1]);
    set(run, "", "outflow_mass", mass[run->series->row_count - 1]);
    tell(run, "", law);
    return SCREE_OK;
}

const scree_module scree_module_outflow = {
    .name = "outflow",
    .meaning = "how fast particles come out of outlets",
    .columns = SCREE_RESULTS_IN_PARTS(columns, sample),
    .results = SCREE_RESULTS(results, NULL),
    .told = told,
    .conclude = conclude,
};
