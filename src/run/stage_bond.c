/// Stage `bond`: joins particles by bonds (bond/make.h). Takes no steps, and may stand anywhere behind the preparation.
#include "bond/make.h"
#include "case/check.h"
#include "model/law.h"
#include "module/key_rows.h"
#include "run/simulation.h"
#include "search/neighbours.h"
#include "selection/selection.h"

#include <math.h>
#include <stdio.h>

/// Share of the mean radius.
#define GAP_TOLERANCE 0.05

typedef struct config {
    double gap_tolerance;     ///< m; auto: 5 % of the mean radius
    double overlap_tolerance; ///< m; auto: 5 % of the smaller radius
    char *between, *other;    ///< names of selections; auto: all particles; those of `between`
    double (*list)[2];        ///< list_count pairs of ids
    int64_t list_count;
    int rest;                                  ///< scree_bond_rest
    double tensile_strength, shear_strength;   ///< N
    double tensile_stress, shear_stress;       ///< Pa
    double internal_friction;                  ///< 1
    int scatter;                               ///< scree_scatter
    double scatter_deviation, weibull_modulus; ///< 1
} config;

static const scree_choice rests[] = {
    {"as_made", SCREE_REST_AS_MADE, "at the distance at which they are made: they begin without stress"},
    {"geometric", SCREE_REST_GEOMETRIC, "where the two particles just touch (Madan 2019, 2.25)"},
    {0},
};
static const scree_choice scatters[] = {
    {"none", SCREE_SCATTER_NONE, "all bonds have the strengths that are given"},
    {"normal", SCREE_SCATTER_NORMAL, "a factor with a normal distribution, never below 0.05"},
    {"weibull", SCREE_SCATTER_WEIBULL, "a factor with a Weibull distribution"},
    {0},
};
static const scree_key keys[] = {
    NUMBER(config, gap_tolerance, "m", .standard = "auto", FROM("0 m"), TO("100 m"),
           .meaning = "Particles with a gap up to this are bonded; auto: 5 % of the mean radius. Not with `list`."),
    NUMBER(config, overlap_tolerance, "m", .standard = "auto", FROM("0 m"), TO("100 m"),
           .meaning = "Largest overlap of two that are bonded; auto: 5 % of the smaller radius."),
    KEY(config, between, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),
        .meaning = "Name of the selection whose particles are bonded; auto: all. Not with `list`."),
    {.name = "and",
     .type = SCREE_KEY_WORD,
     .standard = "auto",
     FROM("1"),
     TO("63"),
     .offset = offsetof(config, other),
     .meaning = "Name of the selection to whose particles they are bonded; auto: among themselves."},
    KEY(config, list, SCREE_KEY_PAIRS, .unit = "1", .standard = "[]", FROM("0"), TO("4e9"),
        .count_offset = offsetof(config, list_count), .element_size = sizeof(double[2]),
        .meaning = "Pairs of particles by their numbers, [[0, 1], [1, 2]] or a .csv file, in place of all within the "
                   "tolerance."),
    CHOICE(config, rest, rests, .standard = "as_made", .meaning = "Where bonds are at rest."),
    NUMBER(config, tensile_strength, "N", .standard = "auto", ABOVE("0 N"), TO("1e30 N"),
           .meaning = "Tensile force at which a bond breaks; auto: none, or by `tensile_stress`."),
    NUMBER(config, shear_strength, "N", .standard = "auto", ABOVE("0 N"), TO("1e30 N"),
           .meaning = "Tangential force at which it breaks without a normal force; auto: none, or by `shear_stress`."),
    NUMBER(config, tensile_stress, "Pa", .standard = "auto", ABOVE("0 Pa"), TO("1e30 Pa"),
           .meaning =
               "In place of `tensile_strength`: times the area of the bond, of discs their thickness times R_1 + "
               "R_2, of spheres pi R_1 R_2."),
    NUMBER(config, shear_stress, "Pa", .standard = "auto", ABOVE("0 Pa"), TO("1e30 Pa"),
           .meaning = "In place of `shear_strength`, in the same way."),
    NUMBER(config, internal_friction, "1", .standard = "0", FROM("0"), TO("10"),
           .meaning =
               "What a compressive normal force adds to the strength in shear, and a tensile one takes from it."),
    CHOICE(config, scatter, scatters, .standard = "none",
           .meaning = "How both strengths scatter, with the same factor of mean 1 for a bond."),
    NUMBER(config, scatter_deviation, "1", .standard = "0.1", ABOVE("0"), TO("0.5"), .when = "scatter=normal",
           .meaning = "Standard deviation of the factor."),
    NUMBER(config, weibull_modulus, "1", .standard = "10", FROM("0.5"), TO("1000"), .when = "scatter=weibull",
           .meaning = "Weibull modulus, the larger the less they scatter."),
};

// ---- rules -------------------------------------------------------------------------------------------------------

/// One stage under judgement.
typedef struct judged {
    scree_reader *reader;
    const scree_config *whole;
    const config *own;
    int64_t index;
    char path[SCREE_PATH_BYTES]; ///< that of the key which was asked for last
} judged;

static void check_law(judged *j)
{
    const int slot = j->whole->contact.law;
    char laws[200] = "";
    if (slot < 0 || scree_law_get(slot)->holding) return;
    for (int m = 0; m < SCREE_MODULE_COUNT; m++)
        if (scree_modules[m]->law && scree_modules[m]->law->holding)
            (void)snprintf(laws + strlen(laws), sizeof laws - strlen(laws), "%scontact.law: %s", laws[0] ? ", " : "",
                           scree_modules[m]->name);
    scree_rule_refuse(j->reader, scree_element_path(j->path, "stages", j->index, "stage"), laws,
                      "contact law %s cannot hold particles together: choose %s", scree_modules[slot]->name, laws);
}

static void check_names(judged *j)
{
    const config *own = j->own;
    if (own->between)
        (void)scree_rule_is_selection(j->reader, j->whole, scree_element_path(j->path, "stages", j->index, "between"),
                                      own->between);
    if (own->other)
        (void)scree_rule_is_selection(j->reader, j->whole, scree_element_path(j->path, "stages", j->index, "and"),
                                      own->other);
    if (own->other && !own->between)
        scree_rule_refuse(j->reader, scree_element_path(j->path, "stages", j->index, "and"), NULL,
                          "not used without `between`");
    if (own->list_count == 0) return;
    if (own->between)
        scree_rule_refuse(j->reader, scree_element_path(j->path, "stages", j->index, "between"), "auto",
                          "not used with a list, which names the particles");
    if (!isnan(own->gap_tolerance))
        scree_rule_refuse(j->reader, scree_element_path(j->path, "stages", j->index, "gap_tolerance"), "auto",
                          "not used with a list, whose pairs are bonded whatever their gap");
}

static bool same_pair(const double a[2], const double b[2])
{
    return fmin(a[0], a[1]) == fmin(b[0], b[1]) && fmax(a[0], a[1]) == fmax(b[0], b[1]);
}

static void check_list(judged *j)
{
    for (int64_t k = 0; k < j->own->list_count; k++) {
        const double *pair = j->own->list[k];
        char path[SCREE_PATH_BYTES];
        (void)snprintf(path, sizeof path, "stages.%lld.list.%lld", (long long)j->index, (long long)k);
        if (isnan(pair[0]) || isnan(pair[1])) continue; // noted
        if (pair[0] != rint(pair[0]) || pair[1] != rint(pair[1]))
            scree_rule_refuse(j->reader, path, "two whole numbers", "expected the numbers of two particles");
        else if (pair[0] == pair[1])
            scree_rule_refuse(j->reader, path, NULL, "names particle %.0f twice: a bond joins two", pair[0]);
        for (int64_t i = 0; i < k; i++)
            if (same_pair(j->own->list[i], pair)) {
                scree_rule_refuse(j->reader, path, NULL, "list.%lld is the same pair: name it once", (long long)i);
                break;
            }
    }
}

static void check_strength(judged *j)
{
    const config *own = j->own;
    const bool tension = !isnan(own->tensile_strength) || !isnan(own->tensile_stress);
    const bool shear = !isnan(own->shear_strength) || !isnan(own->shear_stress);
    if (!isnan(own->tensile_strength) && !isnan(own->tensile_stress))
        scree_rule_refuse(j->reader, scree_element_path(j->path, "stages", j->index, "tensile_stress"), "auto",
                          "tensile_strength is given: give one of the two");
    if (!isnan(own->shear_strength) && !isnan(own->shear_stress))
        scree_rule_refuse(j->reader, scree_element_path(j->path, "stages", j->index, "shear_stress"), "auto",
                          "shear_strength is given: give one of the two");
    if (own->internal_friction > 0 && !shear)
        scree_rule_refuse(j->reader, scree_element_path(j->path, "stages", j->index, "internal_friction"), "0",
                          "not used without a strength in shear: give shear_strength or shear_stress");
    if (own->scatter > SCREE_SCATTER_NONE && !tension && !shear)
        scree_rule_refuse(j->reader, scree_element_path(j->path, "stages", j->index, "scatter"), "none",
                          "no strength is given that could scatter");
}

static void rules(scree_reader *reader, const scree_config *whole)
{
    for (int64_t i = 0; i < whole->stage_count; i++) {
        if (whole->stages[i].kind != SCREE_SLOT_bond || !whole->stages[i].own) continue;
        judged j = {.reader = reader, .whole = whole, .own = whole->stages[i].own, .index = i};
        check_law(&j);
        check_names(&j);
        check_list(&j);
        check_strength(&j);
    }
}

// ---- the stage ---------------------------------------------------------------------------------------------------

static scree_status find_selection(scree_simulation *s, const char *name, int64_t *index, scree_error *error)
{
    *index = -1;
    if (!name) return SCREE_OK;
    *index = scree_config_selection_find(s->model.selections, s->model.selection_count, name);
    return scree_selection_resolve(&s->model, &s->state, *index, error);
}

static scree_bond_order order_of(const scree_simulation *s, const config *own)
{
    return (scree_bond_order){.gap_tolerance =
                                  isnan(own->gap_tolerance) ? GAP_TOLERANCE * s->model.mean_radius : own->gap_tolerance,
                              .overlap_tolerance = own->overlap_tolerance,
                              .list = own->list_count > 0 ? (const double(*)[2])own->list : NULL,
                              .list_count = own->list_count,
                              .rest = own->rest,
                              .strength = {.tensile = own->tensile_strength,
                                           .shear = own->shear_strength,
                                           .tensile_stress = own->tensile_stress,
                                           .shear_stress = own->shear_stress,
                                           .internal_friction = own->internal_friction,
                                           .scatter = own->scatter,
                                           .deviation = own->scatter_deviation,
                                           .modulus = own->weibull_modulus,
                                           .seed = s->model.seed}};
}

static scree_status begin(scree_simulation *s, scree_error *error)
{
    const config *own = scree_stage_config(s)->own;
    scree_bond_order order = order_of(s, own);
    size_t made = 0;
    scree_status status = find_selection(s, own->between, &order.between, error);
    if (!status) status = find_selection(s, own->other, &order.other, error);
    if (!status) {
        status = scree_bonds_make(&s->stage_model, &s->state, &s->work, &order, &made, error);
        if (status == SCREE_ERROR_INPUT && error) {
            char key[sizeof error->field];
            (void)snprintf(key, sizeof key, "%s", error->field[0] ? error->field : "stage");
            (void)snprintf(error->field, sizeof error->field, "stages.%lld.%.40s", (long long)s->state.stage.index,
                           key);
        }
    }
    if (status == SCREE_ERROR_INPUT && error) scree_case_locate(s->c, error);
    (void)snprintf(s->reason, sizeof s->reason, "%zu bonds made", made);
    return status;
}

static const scree_stage stage_face = {.name = "bond", .instant = true, .begin = begin};

static const scree_stage_numbers numbers = {.instant = true, .bonds = true};

const scree_module scree_module_bond = {
    .name = "bond",
    .meaning = "Joins particles by bonds, which pull as well as press until they break; takes no time.",
    .choice_of = CHOICE_OF(IS("stages", .meaning = "joins particles by bonds")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, keys, config)},
    .keys_count = 1,
    .rules = rules,
    .numbers = &numbers,
    .stage = &stage_face,
    .spreads = true,
};
