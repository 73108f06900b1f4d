/// Elastic moduli of the specimen as a run leaves it, by static solutions (specimen/moduli.h): what `scree moduli`
/// tells, as results, so that sweeps can ask for them.
#include "case/case.h"
#include "model/measure_keys.h"
#include "model/model.h"
#include "module/key_rows.h"
#include "run/conclusion.h"
#include "search/neighbours.h"
#include "specimen/from_state.h"
#include "specimen/piece.h"

/// Its keys, and its numbers.
typedef struct config {
    bool moduli;
} config;

static const scree_key keys[] = {
    FLAG(config, moduli, .standard = "no",
         .meaning = "Elastic moduli of the specimen at the end, by static solutions, as `scree moduli` has them."),
};

static scree_status resolve(scree_model *model, scree_error *error)
{
    (void)error;
    return scree_model_keep_measure_keys(model, SCREE_SLOT_moduli);
}

#define MODULI(after, of)                                                                                              \
    {"static_young_modulus" after, "Pa", "Young's modulus " of},                                                       \
        {"static_poisson_ratio" after, "1", "Poisson's ratio " of},                                                    \
        {"static_bulk_modulus" after, "Pa", "bulk modulus, of discs that of areas, " of},                              \
    {                                                                                                                  \
        "static_shear_modulus" after, "Pa", "shear modulus " of                                                        \
    }
static const scree_result results[] = {
    MODULI("", "of the specimen, of the nearest isotropic tensor"),
    MODULI("_voigt", "if rigid particles followed the mean strain"),
    MODULI("_theory", "by Voigt from number of contacts and mean square radius alone (M 4.15-4.18)"),
    {"static_anisotropy", "1", "distance of the tensor of elasticity from the nearest isotropic one over its size"},
    {"static_asymmetry", "1", "size of its skew part over its size"},
    {"static_contacts", "1", "contacts between particles"},
    {"static_axial_young_modulus", "Pa", "Young's modulus between smooth plates below and above, sides free"},
    {"static_axial_poisson_ratio", "1", "Poisson's ratio then, in space the mean of both"},
    {"static_pressed_bulk_modulus", "Pa", "bulk modulus, of discs that of areas, between smooth plates all around"},
};

static void set(scree_summary *summary, const scree_specimen *s, const scree_specimen_moduli *found,
                const scree_uniaxial *axial, double bulk)
{
    const scree_isotropic of[3] = {found->isotropic, found->voigt, scree_specimen_estimate(s)};
    const scree_result *row = results;
    double pairs = 0;
    for (size_t c = 0; c < s->contact_count; c++) pairs += s->contact[c].second != SCREE_SPECIMEN_WALL;
    for (int k = 0; k < 3; k++) {
        const double value[4] = {of[k].young, of[k].poisson, of[k].bulk, of[k].shear};
        for (int i = 0; i < 4; i++) scree_summary_set_number(summary, (row++)->name, value[i]);
    }
    scree_summary_set_number(summary, (row++)->name, found->anisotropy);
    scree_summary_set_number(summary, (row++)->name, found->asymmetry);
    scree_summary_set_number(summary, (row++)->name, pairs);
    if (isnan(axial->young)) return;
    scree_summary_set_number(summary, (row++)->name, axial->young);
    scree_summary_set_number(summary, (row++)->name,
                             s->dimension == 3 ? 0.5 * (axial->poisson[0] + axial->poisson[1]) : axial->poisson[0]);
    scree_summary_set_number(summary, row->name, bulk);
}

static scree_status conclude(const scree_conclusion *run, scree_error *error)
{
    scree_simulation *s = run->s;
    const config *own = scree_model_numbers(&s->model, SCREE_SLOT_moduli);
    scree_specimen specimen = {0};
    scree_specimen_moduli found;
    scree_uniaxial axial;
    scree_box box;
    double bulk;
    size_t iterations;
    if (!own || !own->moduli || s->state.count == 0) return SCREE_OK;
    scree_status status = scree_neighbours_refresh(&s->stage_model, &s->state, &s->work, error);
    if (!status) status = scree_specimen_of_state(&s->stage_model, &s->state, &s->work, &specimen, error);
    if (status) return status;
    status = scree_specimen_find_piece(&s->state, &specimen, &box, error);
    if (!status) status = scree_specimen_press_piece(&specimen, &box, s->model.dimension - 1, &axial, error);
    if (!status) status = scree_specimen_press_piece_all(&specimen, &box, &bulk, &iterations, error);
    if (!status) status = scree_specimen_take_piece(&specimen, &box, error);
    if (!status) status = scree_specimen_find_moduli(&specimen, &found, error);
    if (!status) set(run->summary, &specimen, &found, &axial, bulk);
    scree_specimen_destroy(&specimen);
    return status;
}

const scree_module scree_module_moduli = {
    .name = "moduli",
    .meaning = "elastic moduli of the specimen at the end",
    .keys = (const scree_keys[]){KEYS_OF("measure", keys, config)},
    .keys_count = 1,
    .numbers_size = sizeof(config),
    .resolve = resolve,
    .results = SCREE_RESULTS(results, NULL),
    .conclude = conclude,
};
