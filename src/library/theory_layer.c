/// Response to a line load: theory/layer.h for programs.
#include "library/theory.h"

#include "theory/layer.h"

#include <scree/scree.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { POINTS = 401, DEPTHS = 4, BASES = SCREE_LAYER_NONE + 1 };

static const char *const base_words[BASES] = {"smooth", "bonded", "none"};
static const char *const base_titles[BASES] = {"layer on a smooth base", "layer bonded to its base", "half-space"};

// ---- what is asked -----------------------------------------------------------------------------------------------

static scree_status find_base(const char *base, scree_layer_base *found, scree_error *error)
{
    for (int k = 0; k < BASES; k++)
        if (base && strcmp(base, base_words[k]) == 0) {
            *found = (scree_layer_base)k;
            return SCREE_OK;
        }
    const char *nearest = base ? scree_nearest(base, base_words, BASES) : NULL;
    return scree_error_refuse(error, "base", nearest ? nearest : "smooth, bonded, none", "there is no such base");
}

static scree_status check(const scree_theory_layer_of *of, scree_error *error)
{
    if (!(of->force > 0 && isfinite(of->force)))
        return scree_error_refuse(error, "force", "a number above 0", "the load has to be a finite number above 0");
    if (!(of->thickness > 0 && isfinite(of->thickness)))
        return scree_error_refuse(error, "thickness", "a number above 0", "this has to be a finite number above 0");
    if (!(of->poisson_ratio > -1 && of->poisson_ratio <= 0.5))
        return scree_error_refuse(
            error, "poisson_ratio", "above -1, at most 0.5",
            "no isotropic material has this Poisson's ratio (give that in space, and the plane apart)");
    return SCREE_OK;
}

// ---- values ------------------------------------------------------------------------------------------------------

typedef struct base_names {
    const char *peak, *over, *width, *along;
} base_names;
static const base_names rows[BASES] = {
    {"smooth_peak", "smooth_peak_over", "smooth_half_width", "smooth_horizontal"},
    {"bonded_peak", "bonded_peak_over", "bonded_half_width", "bonded_horizontal"},
    {"half_space_peak", "half_space_peak_over", "half_space_half_width", "half_space_horizontal"},
};

/// At the depth of the base, under the load.
static scree_status add_base(scree_theory *t, const scree_layer *layer, scree_error *error)
{
    const base_names *n = &rows[layer->base];
    const double depth = layer->thickness, unit = scree_flamant_stress(layer->force, 0, depth).yy;
    scree_stress_2d stress;
    double width;
    scree_status status = scree_layer_stress(layer, 0, depth, &stress, error);
    if (!status) status = scree_layer_half_width(layer, depth, &width, error);
    if (status) return status;
    theory_add(t, n->peak, stress.yy, "Pa", "sigma_yy at the base under the load");
    theory_add(t, n->over, layer->base == SCREE_LAYER_NONE ? NAN : stress.yy / unit, "1",
               "over that of the half-space");
    theory_add(t, n->width, width, "m", "distance from there to half of it");
    theory_add(t, n->along, stress.xx, "Pa", "sigma_xx at the base under the load");
    return SCREE_OK;
}

static scree_status add_values(scree_theory *t, const scree_layer *layer, scree_error *error)
{
    scree_layer_check c;
    scree_status status = SCREE_OK;
    for (int k = 0; k < BASES && !status; k++) {
        scree_layer other = *layer;
        other.base = (scree_layer_base)k;
        if (layer->base != SCREE_LAYER_NONE || other.base == SCREE_LAYER_NONE) status = add_base(t, &other, error);
    }
    if (!status) status = scree_layer_examine(layer, &c, error);
    if (status) return status;
    const bool based = layer->base != SCREE_LAYER_NONE;
    theory_add(t, "check_equilibrium", c.equilibrium, "1", "largest div sigma, by differences, over stress and depth");
    theory_add(t, "check_compatibility", c.compatibility, "1", "Laplacian of sigma_xx + sigma_yy, likewise");
    theory_add(t, "check_surface", c.surface, "1", "stress on top beside the load, over F / H");
    theory_add(t, "check_base", based ? c.base : NAN, "1", "conditions at the base, over F / H");
    theory_add(t, "check_force", c.force, "1", "vertical force on a cut at the base over the load, less 1");
    return SCREE_OK;
}

// ---- figures -----------------------------------------------------------------------------------------------------

typedef enum quantity { VERTICAL, HORIZONTAL, SHEAR, QUANTITIES } quantity;

static const char *const quantity_names[] = {"vertical", "horizontal", "shear"};
static const char *const quantity_labels[] = {"vertical stress σ_{yy} (Pa)", "horizontal stress σ_{xx} (Pa)",
                                              "shear stress σ_{xy} (Pa)"};
static const char *const columns[2][DEPTHS] = {
    {"quarter", "half", "three_quarters", "whole"},
    {"half_space_quarter", "half_space_half", "half_space_three_quarters", "half_space_whole"}};
static const char *const labels[DEPTHS] = {"1/4 of the depth", "1/2", "3/4", "at the base"};

static scree_status fill(theory_figure *f, size_t curve, const scree_layer *layer, double depth, quantity what,
                         scree_error *error)
{
    scree_status status = SCREE_OK;
    for (size_t i = 0; i < f->points && !status; i++) {
        scree_stress_2d s;
        status = scree_layer_stress(layer, f->x[i], depth, &s, error);
        f->curve[curve].y[i] = what == VERTICAL ? s.yy : what == HORIZONTAL ? s.xx : s.xy;
    }
    return status;
}

static scree_status begin(scree_theory *t, const scree_layer *layer, const char *name, quantity what, size_t curves,
                          theory_figure **figure, scree_error *error)
{
    scree_status status = theory_begin_figure(t, name, POINTS, curves, figure, error);
    if (status) return status;
    theory_figure *f = *figure;
    const double reach = 2 * layer->thickness;
    f->x_name = "x";
    f->x_unit = "m";
    f->x_label = "distance from the load (m)";
    f->y_unit = "Pa";
    f->y_label = quantity_labels[what];
    for (size_t i = 0; i < POINTS; i++) f->x[i] = reach * (2 * (double)i / (POINTS - 1) - 1);
    return SCREE_OK;
}

/// Cuts at four depths, beside them dashed those of the half-space.
static scree_status add_depths(scree_theory *t, const scree_layer *layer, quantity what, scree_error *error)
{
    const bool based = layer->base != SCREE_LAYER_NONE;
    scree_layer beside = *layer;
    theory_figure *f;
    beside.base = SCREE_LAYER_NONE;
    scree_status status = begin(t, layer, quantity_names[what], what, based ? 2 * DEPTHS : DEPTHS, &f, error);
    if (status) return status;
    (void)snprintf(f->title, sizeof f->title, "Line load on a %s%s", base_titles[layer->base],
                   based ? ", dashed: half-space" : "");
    for (size_t k = 0; k < f->curve_count && !status; k++) {
        const size_t depth = k % DEPTHS;
        const bool second = k >= DEPTHS;
        f->curve[k].name = columns[second][depth];
        f->curve[k].label = second ? NULL : labels[depth];
        f->curve[k].colour = (int)depth + 1;
        f->curve[k].dashed = second;
        status = fill(f, k, second ? &beside : layer, layer->thickness * (double)(depth + 1) / DEPTHS, what, error);
    }
    return status;
}

static scree_status add_bases(scree_theory *t, const scree_layer *layer, scree_error *error)
{
    static const char *const names[BASES] = {"smooth", "bonded", "half_space"};
    theory_figure *f;
    scree_status status = begin(t, layer, "base", VERTICAL, BASES, &f, error);
    if (status) return status;
    (void)snprintf(f->title, sizeof f->title, "Line load: stress on the base");
    for (size_t k = 0; k < BASES && !status; k++) {
        scree_layer other = *layer;
        other.base = (scree_layer_base)k;
        f->curve[k].name = names[k];
        f->curve[k].label = base_titles[k];
        f->curve[k].colour = (int)k + 1;
        f->curve[k].dashed = other.base == SCREE_LAYER_NONE;
        status = fill(f, k, &other, layer->thickness, VERTICAL, error);
    }
    return status;
}

static scree_status solve(scree_theory *t, const scree_layer *layer, scree_error *error)
{
    scree_status status = add_values(t, layer, error);
    for (int what = 0; what < QUANTITIES && !status; what++) status = add_depths(t, layer, (quantity)what, error);
    if (!status && layer->base != SCREE_LAYER_NONE) status = add_bases(t, layer, error);
    return status;
}

scree_status scree_theory_layer(const scree_theory_layer_of *of, scree_theory **theory, scree_error *error)
{
    scree_layer layer = {.force = of->force, .thickness = of->thickness};
    *theory = NULL;
    scree_status status = find_base(of->base, &layer.base, error);
    if (!status) status = check(of, error);
    if (!status) status = theory_create(theory, error);
    if (status) return status;
    layer.poisson = of->plane_stress ? of->poisson_ratio / (1 + of->poisson_ratio) : of->poisson_ratio;
    status = solve(*theory, &layer, error);
    if (!status) return SCREE_OK;
    scree_theory_free(*theory);
    *theory = NULL;
    return status;
}
