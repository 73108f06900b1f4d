/// Dense packing: particles that fill more of their box than can be packed without overlap, each with as many
/// neighbours as a triangulation gives it: for bonded samples (Madan 2019, 4.5: 4979 discs, 93 % of a square).
///
/// Method (Labra and Onate 2009): from a growth packing below jamming, positions and radii move until the gaps along
/// the edges of the triangulation, and those to the walls, are alike (prepare/fit_gaps.h). What the solid fraction
/// demands beyond a packing without overlap is then the same overlap everywhere, at which bonds are at rest.
///
/// Sizes. The radii asked for are the quantiles (i + 1/2)/n of the distribution of each species, n bodies of it, so
/// their moments, and the box, do not scatter with the seed. Particles of a species may exchange radii, and these may
/// depart from the quantiles as far as `size_penalty` lets them; limits are kept.
///
/// Limits. A mean overlap above MOST_OVERLAP mean radii is refused: a solid fraction of about 98 % in the plane, 71 %
/// in space. Determinism: one thread, sums in the order of the net. Cost: 2 ms a disc, 15 ms a sphere.
#include "prepare/dense.h"
#include "case/check.h"
#include "module/key_rows.h"
#include "prepare/fit_gaps.h"
#include "prepare/growth.h"
#include "prepare/methods.h"

#include <math.h>
#include <string.h>

/// Solid fractions of the growth packing that it begins with, in the plane and in space, and without the key.
static const double BEGIN[2] = {0.75, 0.55}, STANDARD[2] = {0.9, 0.64};
static const double MOST_OVERLAP = 0.1; // mean radii
static const double LEAST_GROWTH = 0.9; // of the solid fraction, where that is low

typedef scree_dense_config config;
static const scree_key keys[] = {
    NUMBER(config, solid_fraction, "1", .standard = "auto", ABOVE("0"), TO("99.9 %"), .when = "method=dense",
           .meaning = SCREE_SOLID_FRACTION_MEANING),
    NUMBER(config, gap_scatter, "1", .standard = "1 %", FROM("0.01 %"), TO("10 %"), .when = "method=dense",
           .meaning = "Root mean square of the gaps between neighbours about their mean, over the mean radius; a "
                      "single one may be off by five times as much."),
    NUMBER(config, size_penalty, "1", .standard = "1", ABOVE("0"), TO("1e6"), .when = "method=dense",
           .meaning = "Weight of the squared departures of radii from the sizes asked for, against those of gaps."),
    INTEGER(config, rounds, .standard = "100", FROM("1"), TO("1e6"), .when = "method=dense",
            .meaning = "Most triangulations until the gaps are alike."),
};

static const config *own_config(const scree_config_stage *stage)
{
    return scree_config_own(&scree_module_dense, "stages.prepare", stage->own);
}

static double solid_fraction_of(const scree_model *model, const scree_config_stage *stage)
{
    const double given = own_config(stage)->solid_fraction;
    return isnan(given) ? STANDARD[model->dimension - 2] : given;
}

// ---- the sizes asked for -----------------------------------------------------------------------------------------

typedef struct wanted {
    double *radius; ///< mean radii: quantiles of each species
    double least[SCREE_MOST_SPECIES], most[SCREE_MOST_SPECIES];
    double solid; ///< area (volume) of all
} wanted;

static double solid_of(int dimension, double radius)
{
    return dimension == 3 ? 4 * M_PI / 3 * radius * radius * radius : M_PI * radius * radius;
}

static void fill_wanted(const scree_model *model, const scree_packing *packing, wanted *w)
{
    size_t filled = 0;
    for (int s = 0; s < model->species_count; s++) {
        const scree_species *species = &model->species[s];
        size_t count = 0;
        w->least[s] = species->radius.least / model->mean_radius;
        w->most[s] = species->radius.most / model->mean_radius;
        for (size_t i = 0; i < packing->count; i++) count += packing->species[i] == s;
        for (size_t k = 0; k < count; k++, filled++) {
            const double share = ((double)k + 0.5) / (double)count;
            const double radius = species->distribution->radius(species->sizes, model->dimension, share);
            w->radius[filled] = radius / model->mean_radius;
            w->solid += solid_of(model->dimension, w->radius[filled]);
        }
    }
}

// ---- to and fro --------------------------------------------------------------------------------------------------

/// Bodies of the packing in mean radii.
static void take(const scree_packing *packing, double unit, scree_gap_bodies *b)
{
    const size_t d = (size_t)packing->dimension;
    const scree_box *box = &packing->box;
    const double side[3] = {box->width, d == 3 ? box->depth : box->height, box->height};
    for (size_t k = 0; k < 3; k++) b->side[k] = side[k] / unit;
    b->periodic = box->periodic;
    for (size_t i = 0; i < packing->count; i++) {
        for (size_t k = 0; k < d; k++) b->at[i * (d + 1) + k] = packing->place[k][i] / unit;
        b->at[i * (d + 1) + d] = packing->radius[i] / unit;
    }
}

static void give(const scree_gap_bodies *b, double unit, scree_packing *packing)
{
    const size_t d = (size_t)packing->dimension;
    for (size_t i = 0; i < packing->count; i++) {
        for (size_t k = 0; k < d; k++) packing->place[k][i] = b->at[i * (d + 1) + k] * unit;
        packing->radius[i] = b->at[i * (d + 1) + d] * unit;
    }
}

/// The packing that it begins with: radii are as drawn afterwards, and overlap.
static scree_status grow(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                         scree_error *error)
{
    const double fraction = solid_fraction_of(model, stage), begin = BEGIN[model->dimension - 2];
    const double scale = pow(fmin(begin / fraction, LEAST_GROWTH), 1.0 / model->dimension);
    double overlap;
    for (size_t i = 0; i < packing->count; i++) packing->radius[i] *= scale;
    scree_status status = scree_packing_grow(model, stage, packing, &overlap, error);
    for (size_t i = 0; i < packing->count; i++) packing->radius[i] /= scale;
    return status;
}

static scree_status check(const scree_model *model, const scree_config_stage *stage, const scree_gap_report *report,
                          scree_error *error)
{
    const config *own = own_config(stage);
    const double fraction = solid_fraction_of(model, stage), beyond = report->overlap - MOST_OVERLAP;
    if (beyond > 0)
        return scree_prepare_error(
            error, model, stage, "solid_fraction",
            "a solid fraction of %.4g demands a mean overlap of %.2g %% of the mean radius, more "
            "than %.2g %%, and cannot be reached with round particles: ask for at most %.3g",
            fraction, 100 * report->overlap, 100 * MOST_OVERLAP, fraction * pow(1 - beyond / 2, model->dimension));
    if (!scree_gap_report_meets(report, own->gap_scatter))
        return scree_prepare_error(error, model, stage, "gap_scatter",
                                   "after %lld rounds the gaps scatter by %.2g %% of the mean radius about their mean, "
                                   "by %.2g %% at most, where %.2g %% and %.2g %% are asked for: allow more rounds, a "
                                   "larger gap_scatter or a smaller size_penalty",
                                   (long long)own->rounds, 100 * report->scatter,
                                   100 * fmax(report->deepest, report->widest), 100 * own->gap_scatter,
                                   100 * SCREE_GAP_FARTHEST * own->gap_scatter);
    return SCREE_OK;
}

static scree_status fit(const scree_model *model, const scree_config_stage *stage, const wanted *w,
                        scree_packing *packing, scree_error *error)
{
    const config *own = own_config(stage);
    const scree_gap_task task = {.sizes = {packing->species, w->radius, w->least, w->most},
                                 .solid = w->solid,
                                 .tolerance = own->gap_scatter,
                                 .penalty = own->size_penalty,
                                 .rounds = own->rounds};
    scree_gap_bodies b = {.dimension = packing->dimension, .count = packing->count};
    scree_gap_report report;
    scree_status status = scree_allocate(&b.at, packing->count * (size_t)(b.dimension + 1), sizeof *b.at, error);
    if (!status) {
        take(packing, model->mean_radius, &b);
        status = scree_gaps_fit(&task, &b, &report, error);
    }
    if (!status) status = check(model, stage, &report, error);
    if (!status) give(&b, model->mean_radius, packing);
    scree_release(&b.at);
    return status;
}

static scree_status place(const scree_model *model, const scree_config_stage *stage, scree_packing *packing,
                          scree_error *error)
{
    wanted w = {0};
    scree_status status = scree_allocate(&w.radius, packing->count, sizeof *w.radius, error);
    if (!status) {
        fill_wanted(model, packing, &w);
        scree_packing_fit_box(packing, w.solid * pow(model->mean_radius, model->dimension),
                              solid_fraction_of(model, stage), 2 * scree_packing_largest(packing));
        status = grow(model, stage, packing, error);
    }
    if (!status) status = fit(model, stage, &w, packing, error);
    scree_release(&w.radius);
    return status;
}

// ---- what is remembered and told ---------------------------------------------------------------------------------

static const scree_result results[] = {
    {"packing_edges", "1", "neighbours by the weighted Delaunay triangulation of the dense packing"},
    {"packing_bonds", "1", "of these, pairs whose gap is not wider than the mean and five times gap_scatter"},
    {"packing_coordination", "1", "such pairs a particle, each counted for both"},
    {"packing_wall_contacts", "1", "particles that touch a wall, counted for each wall"},
    {"packing_overlap", "1", "mean overlap of these pairs over the mean radius; negative: a gap"},
    {"packing_gap_scatter", "1", "root mean square of their gaps about the mean, over the mean radius"},
    {"packing_deepest", "1", "largest overlap beyond the mean, over the mean radius"},
    {"packing_widest", "1", "widest gap beyond the mean, over the mean radius"},
    {"packing_solid_fraction", "1", "area (volume) of the particles over that of the box"},
    {"packing_radius_mean", "m", "mean radius"},
    {"packing_radius_mean_wanted", "m", "that of the distribution asked for"},
    {"packing_radius_square", "m2", "mean square radius"},
    {"packing_radius_square_wanted", "m2", "that of the distribution asked for"},
    {"packing_radius_least", "m", "smallest radius"},
    {"packing_radius_least_wanted", "m", "that of the distribution asked for"},
    {"packing_radius_largest", "m", "largest radius"},
    {"packing_radius_largest_wanted", "m", "that of the distribution asked for"},
    {"packing_fabric_xx", "1", "mean of n n over the pairs"},
    {"packing_fabric_yy", "1", "the same"},
    {"packing_fabric_zz", "1", "the same; 0 in 2D"},
    {"packing_fabric_yz", "1", "the same; 0 in 2D"},
    {"packing_fabric_xz", "1", "the same; 0 in 2D"},
    {"packing_fabric_xy", "1", "the same"},
};
_Static_assert(sizeof results / sizeof *results <= SCREE_DENSE_RECORD, "room in the record");

static void record_gaps(const scree_gap_bodies *b, const scree_gap_report *report, double **next)
{
    const double filled[] = {
        (double)report->edges,   (double)report->bonds, 2 * (double)report->bonds / (double)b->count,
        (double)report->touches, report->overlap,       report->scatter,
        report->deepest,         report->widest};
    memcpy(*next, filled, sizeof filled);
    *next += sizeof filled / sizeof *filled;
}

static void record_sizes(const scree_model *model, const scree_packing *packing, double **next)
{
    const scree_box *box = &packing->box;
    double mean = 0, square = 0, least = INFINITY, largest = 0;
    for (size_t i = 0; i < packing->count; i++) {
        const double r = packing->radius[i];
        mean += r / (double)packing->count;
        square += r * r / (double)packing->count;
        least = fmin(least, r);
        largest = fmax(largest, r);
    }
    const double room = box->width * box->height * (packing->dimension == 3 ? box->depth : 1);
    const double filled[] = {scree_packing_solid(packing) / room,
                             mean,
                             model->mean_radius,
                             square,
                             model->mean_square,
                             least,
                             model->radius_min,
                             largest,
                             model->radius_max};
    memcpy(*next, filled, sizeof filled);
    *next += sizeof filled / sizeof *filled;
}

static scree_status remember(const scree_model *model, const scree_config_stage *stage, const scree_packing *packing,
                             scree_state *state, scree_error *error)
{
    scree_dense_record *record = state->own[SCREE_SLOT_dense];
    scree_gap_bodies b = {.dimension = packing->dimension, .count = packing->count};
    scree_gap_net net = {0};
    scree_gap_report report;
    double *next = record->value;
    scree_status status = scree_allocate(&b.at, packing->count * (size_t)(b.dimension + 1), sizeof *b.at, error);
    if (!status) {
        take(packing, model->mean_radius, &b);
        status = scree_gap_net_build(&b, &net, error);
    }
    if (!status) {
        scree_gap_report_of_net(&b, &net, 0, own_config(stage)->gap_scatter, &report);
        record_gaps(&b, &report, &next);
        record_sizes(model, packing, &next);
        const double *f = report.fabric, fabric[] = {f[0], f[4], f[8], f[5], f[2], f[1]};
        memcpy(next, fabric, sizeof fabric);
    }
    scree_gap_net_destroy(&net);
    scree_release(&b.at);
    return status;
}

static const scree_preparation preparation = {
    .periodic = true, .solid_fraction = solid_fraction_of, .place = place, .remember = remember};

static scree_status tell(const scree_context *context, size_t index, double *value, scree_error *error)
{
    const scree_dense_record *record = context->state->own[SCREE_SLOT_dense];
    (void)index, (void)error;
    for (size_t k = 0; k < COUNT(results); k++) value[k] = record->value[0] > 0 ? record->value[k] : NAN;
    return SCREE_OK;
}

/// In cases that are prepared so.
static bool told(const scree_config *whole, size_t index, char name[SCREE_RESULT_NAME])
{
    name[0] = 0;
    return index == 0 && scree_config_preparation(whole) == &preparation;
}

// ---- rules -------------------------------------------------------------------------------------------------------

/// Without bonds the overlaps would drive the particles apart.
static void rules(scree_reader *reader, const scree_config *whole)
{
    if (scree_config_preparation(whole) != &preparation) return;
    const bool bonded =
        whole->stage_count > 1 && whole->stages[1].kind >= 0 && scree_modules[whole->stages[1].kind]->numbers->bonds;
    if (!bonded && whole->stage_count > 1)
        scree_rule_refuse(reader, "stages.0.method", NULL,
                          "the overlaps of a dense packing are at rest in bonds alone: let a stage that makes bonds "
                          "come next, or prepare with growth");
}

static const scree_field fields[] = {
    SCREE_FIELD_ONE(dense, scree_dense_record, value, "packing/record", SCREE_FIELD_DOUBLE, SCREE_DENSE_RECORD, "1",
                    "what a dense packing was like: the results packing_..., in their order and units; else zeros"),
};

const scree_module scree_module_dense = {
    .name = "dense",
    .meaning = "fills its box beyond jamming, with gaps or overlaps all alike, in which bonds are at rest",
    .choice_of = CHOICE_OF(IS("stages.prepare.method")),
    .keys = (const scree_keys[]){KEYS_OF("stages.prepare", keys, config)},
    .keys_count = 1,
    .rules = rules,
    .preparation = &preparation,
    .state_size = sizeof(scree_dense_record),
    .fields = fields,
    .field_count = COUNT(fields),
    .results = SCREE_RESULTS(results, tell),
    .told = told,
};
