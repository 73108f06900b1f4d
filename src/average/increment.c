/// Numbers of two states of a sample.
#include "average/increment.h"

#include "average/dip.h"
#include "average/elastic.h"
#include "average/relation.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define LEAST_INSIDE 0.5
#define CORE         0.25
#define UPPER        0.5

#define REGIONS(name, unit, of)                                                                                        \
    {name "_core", unit, of ", median over the core of the lowest cut"},                                               \
        {name "_inwards", "1", of ", in the core over that in the flanks, lowest cut"},                                \
    {                                                                                                                  \
        name "_downwards", "1", of ", in the core of the lowest cut over that of the upper ones"                       \
    }
#define AGAINST(name, of)                                                                                              \
    {                                                                                                                  \
        name "_fabric_correlation", "1", "rank correlation of " of " with the trace of the fabric tensor"              \
    }
#define BEND(name, of)                                                                                                 \
    {                                                                                                                  \
        name "_fabric_bend", "1",                                                                                      \
            "of what a parabola in that trace explains of the variance of " of ", the share that a line does not"      \
    }

const scree_result scree_increment_rows[SCREE_INCREMENT_ROWS + 1] = {
    {"gravity_ratio", "1", "gravity at the end over that in the earlier state"},
    {"earlier_unbalanced", "1", "unbalanced ratio of the earlier state"},
    {"vertical_pressure_most", "Pa", "largest vertical pressure along the lowest cut at the end"},
    {"horizontal_pressure_most", "Pa", "largest horizontal pressure along it"},
    {"shear_stress_most", "Pa", "largest size of the shear stress along it"},
    {"vertical_pressure_ratio", "1", "largest vertical pressure over that in the earlier state"},
    {"horizontal_pressure_ratio", "1", "the same of the horizontal pressure"},
    {"shear_stress_ratio", "1", "the same of the shear stress"},
    {"coordination_ratio", "1", "mean coordination number over that in the earlier state"},
    {"coordination_elements_ratio", "1", "mean over the elements of their coordination numbers, likewise"},
    {"coordination_elements_spread", "1", "standard deviation of these over the elements, over their mean"},
    {"coordination_elements_spread_ratio", "1", "the same over that in the earlier state"},
    {"mobilised_ratio", "1", "sum of tangential over sum of normal forces, over that in the earlier state"},
    {"displacement_bottom", "m", "mean displacement of the grains in the lowest third of the height"},
    {"displacement_top", "m", "the same in the highest third"},
    {"strain_mean", "1", "mean vertical strain along the lowest cut (Cundall), extension positive"},
    {"strain_dip", "1", "of the vertical strain along it: 1 - that on the axis over the largest one"},
    {"strain_dip_cambou", "1", "the same of the strain of Cambou"},
    {"strain_dip_liao", "1", "the same of the strain of Liao"},
    {"strain_dip_difference", "1", "the same of the difference quotient, within half of the half width"},
    {"strain_dip_bagi", "1", "the same of the mean of the Delaunay cells"},
    {"strain_cambou_deviation", "1",
     "strain of Cambou less that of Cundall over the latter, root mean squares along it"},
    {"strain_liao_deviation", "1", "the same of the strain of Liao"},
    {"strain_bagi_deviation", "1", "the same of the mean of the Delaunay cells"},
    {"strain_difference_deviation", "1", "the same of the difference quotient, in the core"},
    {"strain_difference_surface", "1", "the same, outside of the core"},
    REGIONS("bulk_modulus", "Pa", "bulk modulus"),
    REGIONS("shear_modulus", "Pa", "shear modulus"),
    REGIONS("young_modulus", "Pa", "Young's modulus"),
    REGIONS("poisson_ratio", "1", "Poisson's ratio"),
    REGIONS("bulk_modulus_inside", "Pa", "bulk modulus of the part inside"),
    REGIONS("shear_modulus_inside", "Pa", "shear modulus of the part inside"),
    REGIONS("young_modulus_inside", "Pa", "Young's modulus of the part inside"),
    AGAINST("bulk_modulus", "the bulk modulus"),
    AGAINST("shear_modulus", "the shear modulus"),
    AGAINST("young_modulus", "Young's modulus"),
    AGAINST("poisson_ratio", "Poisson's ratio"),
    AGAINST("density", "the volume fraction"),
    AGAINST("bulk_modulus_inside", "the bulk modulus, both of the part inside,"),
    AGAINST("density_inside", "the volume fraction, both of the part inside,"),
    BEND("bulk_modulus", "the bulk modulus"),
    BEND("shear_modulus", "the shear modulus"),
    BEND("young_modulus", "Young's modulus"),
    BEND("poisson_ratio", "Poisson's ratio"),
    BEND("density", "the volume fraction"),
    {"elastic_misfit_core", "1", "what an isotropic law leaves of the change of stress, in the core"},
    {"invariant_ratio_small", "Pa",
     "trace of the change of stress over that of the strain, half of the elements whose stress changes least"},
    {"invariant_ratio_large", "Pa", "the same of the other half"},
    {"fabric_factor", "1", "trace of the fabric tensor over volume fraction and coordination number"},
    {"fabric_factor_theory", "1", "the same as Madadi et al. 2004 predict it from the sizes of the grains"},
    {"fabric_anisotropy_core", "1", "deviator over trace of the fabric tensor in the core"},
    {"fabric_anisotropy_flank", "1", "the same in the flanks"},
    {"fabric_angle_left", "degree", "major axis of the fabric tensor in the left flank, with the x axis, mean"},
    {"fabric_angle_right", "degree", "the same in the right flank"},
    {"fabric_stress_offset", "degree", "mean angle between the major axes of fabric and pressure along the lowest cut"},
    {"strain_stress_offset", "degree", "the same between the axes of the strain and of the change of stress"},
    {"increment_element", "1", "grains that an element holds"},
    {"compared_with", NULL, "stage at whose end the earlier state is"},
};

/// What numbers are found from.
typedef struct finding {
    const scree_average_sample *before, *after;
    const scree_average_table *earlier, *cuts; ///< of the same cuts
    double grains;                             ///< in an element
    double *at;                                ///< the next number
} finding;

static void give(finding *f, double value)
{
    *f->at++ = value;
}

// ---- elements ----------------------------------------------------------------------------------------------------

static double get(const scree_average_table *table, size_t row, const char *name)
{
    const size_t column = scree_average_table_find(table, name);
    return column == SIZE_MAX ? NAN : scree_average_table_get(table, row, column);
}

typedef enum region { LOWEST, CORE_OF, FLANK_OF, LEFT, RIGHT, UPPER_CORE, OUTER, ALL } region;

static bool is_of(const scree_average_table *table, size_t row, region where)
{
    const bool lowest = get(table, row, "cut") == 0;
    const double place = get(table, row, "place");
    if (!(get(table, row, "inside") >= LEAST_INSIDE)) return false;
    switch (where) {
    case ALL:
        return true;
    case LOWEST:
        return lowest;
    case CORE_OF:
        return lowest && fabs(place) <= CORE;
    case FLANK_OF:
        return lowest && fabs(place) >= SCREE_INCREMENT_FLANK;
    case LEFT:
        return lowest && place <= -SCREE_INCREMENT_FLANK;
    case RIGHT:
        return lowest && place >= SCREE_INCREMENT_FLANK;
    case OUTER:
        return lowest && fabs(place) > CORE;
    case UPPER_CORE:
        return get(table, row, "height") >= UPPER && fabs(place) <= CORE;
    }
    return false;
}

/// Median of a column in a region.
static double median(const finding *f, region where, const char *name)
{
    double value[SCREE_INCREMENT_CUTS * SCREE_INCREMENT_POINTS];
    size_t count = 0;
    for (size_t row = 0; row < f->cuts->rows; row++)
        if (is_of(f->cuts, row, where)) value[count++] = get(f->cuts, row, name);
    return scree_average_quantile(value, count, 0.5);
}

/// Pairs of two columns of the elements in the sample.
typedef struct pairs {
    double first[SCREE_INCREMENT_CUTS * SCREE_INCREMENT_POINTS], second[SCREE_INCREMENT_CUTS * SCREE_INCREMENT_POINTS];
    size_t count;
} pairs;

static void take_pairs(const finding *f, const char *first, const char *second, double low, double high, pairs *p)
{
    p->count = 0;
    for (size_t row = 0; row < f->cuts->rows; row++) {
        const double a = get(f->cuts, row, first), b = get(f->cuts, row, second);
        if (!is_of(f->cuts, row, ALL) || !isfinite(a) || !isfinite(b) || a < low || a > high) continue;
        p->first[p->count] = a;
        p->second[p->count++] = b;
    }
}

/// Sum of the traces of the change of stress over that of the strains, of elements whose change lies between limits.
static double secant(const finding *f, double low, double high)
{
    pairs p;
    double stress = 0, strain = 0;
    take_pairs(f, "stress_change_trace", "strain_trace", low, high, &p);
    for (size_t k = 0; k < p.count; k++) {
        stress += p.first[k];
        strain += p.second[k];
    }
    return stress / strain;
}

// ---- states ------------------------------------------------------------------------------------------------------

/// The component of the stress along the vertical and the horizontal, and their shear.
static const char *component(const finding *f, const char *of, int which)
{
    static const char *const names[2][2][3] = {{{"stress_yy", "stress_xx", "stress_xy"}, //
                                                {"stress_zz", "stress_xx", "stress_xz"}},
                                               {{"_yy", "_xx", "_xy"}, {"_zz", "_xx", "_xz"}}};
    return names[*of == '_'][f->after->dimension - 2][which];
}

/// Largest pressure (of shear: size) along the lowest cut.
static double most(const finding *f, const scree_average_table *table, int which)
{
    double found = NAN;
    for (size_t row = 0; row < table->rows; row++) {
        if (get(table, row, "cut") != 0) continue;
        const double stress = get(table, row, component(f, "stress", which));
        found = fmax(found, which == 2 ? fabs(stress) : -stress);
    }
    return found;
}

static double coordination_of(const scree_average_sample *sample)
{
    double contacts = 0;
    for (size_t p = 0; p < sample->bodies; p++) contacts += sample->grain[p].counted ? sample->own[p].contacts : 0;
    return contacts / (double)sample->counted;
}

/// Mean of the coordination numbers of the elements; *spread: their standard deviation over it.
static double coordination_of_elements(const scree_average_table *table, double *spread)
{
    double sum = 0, squares = 0, count = 0;
    for (size_t row = 0; row < table->rows; row++) {
        const double value = get(table, row, "coordination");
        if (!is_of(table, row, ALL) || !isfinite(value)) continue;
        sum += value;
        squares += value * value;
        count++;
    }
    const double mean = sum / count;
    *spread = sqrt(fmax(0, squares / count - mean * mean)) / mean;
    return mean;
}

static double mobilised(const scree_average_sample *sample)
{
    double tangential = 0, normal = 0;
    for (size_t c = 0; c < sample->contacts; c++) {
        tangential += fabs(sample->contact[c].tangential_force);
        normal += sample->contact[c].normal_force;
    }
    return tangential / normal;
}

static void find_stresses(finding *f)
{
    double largest[3], spread, earlier;
    give(f, scree_length(f->after->gravity) / scree_length(f->before->gravity));
    give(f, f->before->unbalanced_ratio);
    for (int k = 0; k < 3; k++) give(f, largest[k] = most(f, f->cuts, k));
    for (int k = 0; k < 3; k++) give(f, largest[k] / most(f, f->earlier, k));
    give(f, coordination_of(f->after) / coordination_of(f->before));
    const double now = coordination_of_elements(f->cuts, &spread);
    give(f, now / coordination_of_elements(f->earlier, &earlier));
    give(f, spread);
    give(f, spread / earlier);
    give(f, mobilised(f->after) / mobilised(f->before));
}

// ---- strains -----------------------------------------------------------------------------------------------------

/// Mean displacement of the grains whose relative height lies between two limits.
static double displacement_of(const scree_average_sample *sample, double low, double high)
{
    const int up = sample->dimension - 1;
    const double base = sample->low[up], height = sample->high[up] - base;
    double sum = 0, count = 0;
    for (size_t p = 0; p < sample->bodies; p++) {
        const scree_average_grain *grain = &sample->grain[p];
        const double at = (grain->position[up] - base) / height;
        if (!grain->counted || !grain->moved || at < low || at > high) continue;
        sum += scree_length(grain->displacement);
        count++;
    }
    return sum / count;
}

static double vertical_strain(const finding *f, size_t row, int definition)
{
    char name[48];
    (void)snprintf(name, sizeof name, "%s%s", scree_average_strain_names[definition], component(f, "_", 0));
    return get(f->cuts, row, name);
}

/// Of the vertical strain of a definition that of Cundall is taken, over the latter.
static double deviation(const finding *f, int definition, region where)
{
    double off = 0, size = 0;
    for (size_t row = 0; row < f->cuts->rows; row++) {
        const double usual = vertical_strain(f, row, SCREE_AVERAGE_CUNDALL),
                     other = vertical_strain(f, row, definition);
        if (!is_of(f->cuts, row, where) || !isfinite(usual) || !isfinite(other)) continue;
        off += (other - usual) * (other - usual);
        size += usual * usual;
    }
    return sqrt(off / size);
}

/// The dip of the vertical strain of a definition along the lowest cut, which `sign` makes a pressure.
static scree_status find_strain_dip(finding *f, int definition, double sign, scree_error *error)
{
    const double reach = scree_increment_reach(definition);
    double profile[SCREE_INCREMENT_POINTS];
    scree_average_dip dip;
    for (size_t k = 0; k < SCREE_INCREMENT_POINTS; k++) {
        const bool taken = is_of(f->cuts, k, LOWEST) && fabs(get(f->cuts, k, "place")) <= reach;
        profile[k] = taken ? sign * vertical_strain(f, k, definition) : NAN;
    }
    scree_status status = scree_average_dip_find(profile, 1, SCREE_INCREMENT_POINTS, &dip, error);
    // Of a strain that is not known there is none, and not one that is all of it.
    give(f, status || !isfinite(profile[SCREE_INCREMENT_POINTS / 2]) ? NAN : dip.dip);
    return status;
}

static scree_status find_strains(finding *f, scree_error *error)
{
    static const int order[] = {SCREE_AVERAGE_CUNDALL, SCREE_AVERAGE_CAMBOU, SCREE_AVERAGE_LIAO,
                                SCREE_AVERAGE_DIFFERENCE, SCREE_AVERAGE_BAGI};
    double sum = 0, count = 0;
    for (size_t k = 0; k < SCREE_INCREMENT_POINTS; k++) {
        const double strain = is_of(f->cuts, k, LOWEST) ? vertical_strain(f, k, SCREE_AVERAGE_CUNDALL) : NAN;
        sum += isfinite(strain) ? strain : 0;
        count += isfinite(strain);
    }
    give(f, displacement_of(f->after, 0, 1.0 / 3));
    give(f, displacement_of(f->after, 2.0 / 3, 1));
    give(f, sum / count);
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < sizeof order / sizeof *order && !status; k++)
        status = find_strain_dip(f, order[k], sum < 0 ? -1 : 1, error);
    give(f, deviation(f, SCREE_AVERAGE_CAMBOU, LOWEST));
    give(f, deviation(f, SCREE_AVERAGE_LIAO, LOWEST));
    give(f, deviation(f, SCREE_AVERAGE_BAGI, LOWEST));
    give(f, deviation(f, SCREE_AVERAGE_DIFFERENCE, CORE_OF));
    give(f, deviation(f, SCREE_AVERAGE_DIFFERENCE, OUTER));
    return status;
}

// ---- constants and fabric ----------------------------------------------------------------------------------------

/// The first pairs: of whole elements.
enum { BENDS = 5 };

static void find_constants(finding *f)
{
    static const char *const constant[] = {"bulk_modulus",        "shear_modulus",       "young_modulus",
                                           "poisson_ratio",       "bulk_modulus_inside", "shear_modulus_inside",
                                           "young_modulus_inside"};
    static const char *const pair[][2] = {{"fabric_trace", "bulk_modulus"},
                                          {"fabric_trace", "shear_modulus"},
                                          {"fabric_trace", "young_modulus"},
                                          {"fabric_trace", "poisson_ratio"},
                                          {"fabric_trace", "volume_fraction"},
                                          {"fabric_trace_inside", "bulk_modulus_inside"},
                                          {"fabric_trace_inside", "volume_fraction_inside"}};
    for (size_t k = 0; k < sizeof constant / sizeof *constant; k++) {
        const double core = median(f, CORE_OF, constant[k]);
        give(f, core);
        give(f, core / median(f, FLANK_OF, constant[k]));
        give(f, core / median(f, UPPER_CORE, constant[k]));
    }
    pairs p[sizeof pair / sizeof *pair];
    for (size_t k = 0; k < sizeof pair / sizeof *pair; k++) {
        take_pairs(f, pair[k][0], pair[k][1], -INFINITY, INFINITY, &p[k]);
        give(f, scree_average_rank_correlation(p[k].first, p[k].second, p[k].count));
    }
    for (size_t k = 0; k < BENDS; k++) give(f, scree_average_bend(p[k].first, p[k].second, p[k].count));
    give(f, median(f, CORE_OF, "elastic_misfit"));
    const double middle = median(f, ALL, "stress_change_trace");
    const double below = secant(f, -INFINITY, middle), above = secant(f, middle, INFINITY);
    give(f, middle > 0 ? below : above);
    give(f, middle > 0 ? above : below);
}

/// Mean direction of axes of a region [degree], by their doubled angles.
static double direction(const finding *f, region where, const char *name)
{
    double x = 0, y = 0;
    for (size_t row = 0; row < f->cuts->rows; row++) {
        const double angle = get(f->cuts, row, name) * M_PI / 180;
        if (!is_of(f->cuts, row, where) || !isfinite(angle)) continue;
        x += cos(2 * angle);
        y += sin(2 * angle);
    }
    return x == 0 && y == 0 ? NAN : 0.5 * atan2(y, x) * 180 / M_PI;
}

/// Mean angle between two axes along the lowest cut [degree]: in the plane by their angles, in space by tensors.
static double between(const finding *f, const char *const angle[2], const char *const tensor[2], double sign)
{
    double sum = 0, count = 0;
    for (size_t row = 0; row < f->cuts->rows; row++) {
        const double apart = f->after->dimension == 3
                                 ? scree_average_axes_apart(f->cuts, row, tensor[0], sign, tensor[1])
                                 : fabs(get(f->cuts, row, angle[0]) - get(f->cuts, row, angle[1]));
        if (!is_of(f->cuts, row, LOWEST) || !isfinite(apart)) continue;
        sum += fmin(apart, 180 - apart);
        count++;
    }
    return sum / count;
}

static void find_fabric(finding *f)
{
    const scree_average_sample *sample = f->after;
    double solid = 0, contacts = 0, both = 0;
    for (size_t p = 0; p < sample->bodies; p++) {
        if (!sample->grain[p].counted) continue;
        solid += sample->grain[p].volume;
        contacts += sample->own[p].contacts;
        both += sample->grain[p].volume * sample->own[p].contacts;
    }
    give(f, both * (double)sample->counted / (solid * contacts));
    give(f, scree_average_fabric_factor(sample));
    give(f, median(f, CORE_OF, "fabric_anisotropy"));
    give(f, median(f, FLANK_OF, "fabric_anisotropy"));
    give(f, direction(f, LEFT, "fabric_angle"));
    give(f, direction(f, RIGHT, "fabric_angle"));
    give(f, between(f, (const char *[]){"pressure_angle", "fabric_angle"}, (const char *[]){"stress", "fabric"}, -1));
    give(f, between(f, (const char *[]){"strain_angle", "stress_change_angle"},
                    (const char *[]){"cundall", "stress_change"}, 1));
    give(f, f->grains);
}

// ---- the whole ---------------------------------------------------------------------------------------------------

static scree_average_plan plan_of(const scree_average_sample *sample, double grains)
{
    const double usual = sample->counted < SCREE_INCREMENT_USUAL * SCREE_INCREMENT_SHARE
                             ? fmax(1, (double)(sample->counted / SCREE_INCREMENT_SHARE))
                             : SCREE_INCREMENT_USUAL;
    scree_average_plan plan = {.fields = SCREE_AVERAGE_DENSITY | SCREE_AVERAGE_COORDINATION | SCREE_AVERAGE_STRESS |
                                         SCREE_AVERAGE_FABRIC | SCREE_AVERAGE_ELASTIC,
                               .grains = grains > 0 ? grains : usual,
                               .cuts = SCREE_INCREMENT_CUTS,
                               .points = SCREE_INCREMENT_POINTS};
    for (size_t k = 0; k < plan.cuts; k++) plan.height[k] = (double)k / (double)plan.cuts;
    return plan;
}

static scree_status take_cuts(scree_average_sample *sample, scree_average_plan *plan, scree_average_frame *frame,
                              double *grains, scree_average_table *cuts, scree_error *error)
{
    scree_average_view view;
    scree_status status = scree_average_view_open(sample, plan, &view, error);
    if (status) return status;
    *frame = view.frame;
    *grains = view.grains;
    status = scree_average_cuts_table(&view, plan, cuts, error);
    scree_average_view_close(&view);
    return status;
}

scree_status scree_average_increment_find(scree_average_sample *before, scree_average_sample *after, double grains,
                                          double value[SCREE_INCREMENT_ROWS], scree_error *error)
{
    scree_average_table earlier = {0}, cuts = {0};
    scree_average_frame frame;
    scree_average_plan plan = plan_of(before, grains);
    finding f = {.before = before, .after = after, .earlier = &earlier, .cuts = &cuts, .at = value};
    scree_status status = take_cuts(before, &plan, &frame, &f.grains, &earlier, error);
    const scree_average_frame common = frame;
    plan.frame = &common;
    if (!status) status = take_cuts(after, &plan, &frame, &f.grains, &cuts, error);
    if (!status) {
        find_stresses(&f);
        status = find_strains(&f, error);
    }
    if (!status) {
        find_constants(&f);
        find_fabric(&f);
    }
    scree_average_table_destroy(&earlier);
    scree_average_table_destroy(&cuts);
    return status;
}
