#include "theory/fit_theories.h"

#include "theory/incipient.h"
#include "theory/layer.h"
#include "theory/oriented.h"
#include "theory/wedge.h"

#include <math.h>
#include <stdio.h>

/// Places of the parameters that piles have in common.
enum { WEIGHT, APEX_X, APEX_Y, SLOPE, FIRST_OWN, SLOPE_RIGHT = FIRST_OWN, CORE };
/// Those of layers.
enum { FORCE, LOAD_X, ELEMENT, THICKNESS, POISSON };

typedef enum pile_kind { IFE, BCC, FPA, OSL, ORIENTED } pile_kind;

static scree_status no_solution(const char *field, scree_error *error)
{
    return scree_error_refuse(error, field, NULL, "this theory has no solution with these parameters: begin elsewhere");
}

static void look_up(const scree_ideal_pile *pile, const scree_fit_parameter *p, size_t count,
                    const scree_fit_point *points, scree_stress_2d *stress)
{
    for (size_t k = 0; k < count; k++)
        stress[k] = scree_pile_stress(pile, points[k].x - p[APEX_X].value, points[k].y - p[APEX_Y].value);
}

static bool is_angle(double angle)
{
    return angle > 0 && angle < M_PI_2;
}

static scree_oriented oriented_of(const scree_fit_theory *theory, const scree_fit_parameter *p)
{
    const double slope = p[SLOPE].value;
    if (theory->kind == BCC) return scree_oriented_bcc(slope);
    if (theory->kind == FPA) return scree_oriented_fpa(slope);
    if (theory->kind == OSL) return scree_oriented_of_eta(slope, p[FIRST_OWN].value);
    return (scree_oriented){p[FIRST_OWN].value, p[FIRST_OWN + 1].value};
}

/// One slope on both sides.
static scree_status find_one_slope(const scree_fit_theory *theory, const scree_fit_parameter *p, scree_ideal_pile *pile,
                                   scree_error *error)
{
    const double slope = p[SLOPE].value, weight = p[WEIGHT].value;
    if (!is_angle(slope)) return no_solution("slope", error);
    return theory->kind == IFE ? scree_incipient_pile(slope, weight, pile, error)
                               : scree_oriented_pile(slope, weight, oriented_of(theory, p), pile, error);
}

static scree_status one_slope(const scree_fit_theory *theory, const scree_fit_parameter *p, size_t count,
                              const scree_fit_point *points, scree_stress_2d *stress, scree_error *error)
{
    scree_ideal_pile pile;
    scree_status status = find_one_slope(theory, p, &pile, error);
    if (!status) look_up(&pile, p, count, points, stress);
    return status;
}

static scree_status find_wedge(const scree_fit_theory *theory, const scree_fit_parameter *p, scree_wedge *found,
                               scree_error *error)
{
    const scree_wedge_of of = {.slope = {p[SLOPE].value, p[SLOPE_RIGHT].value}, .weight = p[WEIGHT].value};
    const double upright = 0;
    bool there = false;
    scree_status status = theory->kind == SCREE_WEDGES
                              ? scree_wedge_of_core(&of, p[CORE].value, upright, &there, found, error)
                              : scree_wedge_solve(&of, (scree_wedge_kind)theory->kind, &upright, &there, found, error);
    return status || there ? status : no_solution("core", error);
}

static scree_status wedge(const scree_fit_theory *theory, const scree_fit_parameter *p, size_t count,
                          const scree_fit_point *points, scree_stress_2d *stress, scree_error *error)
{
    scree_wedge found;
    scree_status status = find_wedge(theory, p, &found, error);
    if (!status) look_up(&found.pile, p, count, points, stress);
    return status;
}

// ---- what follows ------------------------------------------------------------------------------------------------

static void put(scree_fit_derived *derived, size_t *count, const char *name, const char *unit, double value)
{
    derived[(*count)++] = (scree_fit_derived){name, unit, value};
}

static size_t derive_dip(const scree_fit_theory *theory, const scree_fit_parameter *p,
                         scree_fit_derived derived[SCREE_FIT_DERIVED])
{
    scree_ideal_pile pile;
    scree_error ignored = {0};
    double ray;
    size_t count = 0;
    const bool there = find_one_slope(theory, p, &pile, &ignored) == SCREE_OK;
    put(derived, &count, "dip", "1", there ? scree_pile_dip(&pile, &ray) : NAN);
    return count;
}

/// mu of R 4.22, K and tau of R 4.18.
static size_t derive_oriented(const scree_fit_theory *theory, const scree_fit_parameter *p,
                              scree_fit_derived derived[SCREE_FIT_DERIVED])
{
    size_t count = derive_dip(theory, p, derived);
    const scree_oriented of = oriented_of(theory, p);
    const scree_oriented_axes axes = scree_oriented_axes_of(of);
    if (theory->kind != ORIENTED) put(derived, &count, "mu", "1", of.mu);
    put(derived, &count, "ratio", "1", axes.ratio);
    put(derived, &count, "tau", "rad", axes.tau);
    return count;
}

/// The coefficients of R 4.8 (a11, a22, a12) where the pile yields, on the right, and of R 4.11 (a1, a2, b1) in the
/// core, which two slopes do not have.
static size_t derive_wedge(const scree_fit_theory *theory, const scree_fit_parameter *p,
                           scree_fit_derived derived[SCREE_FIT_DERIVED])
{
    scree_wedge found;
    scree_error ignored = {0};
    double ray, dip = NAN, a1 = NAN, a2 = NAN, b1 = NAN, core = NAN;
    size_t count = 0;
    const bool equal = p[SLOPE].value == p[SLOPE_RIGHT].value;
    const double c = sin(p[SLOPE_RIGHT].value), s = cos(p[SLOPE_RIGHT].value); // of beta = 90 degrees - slope
    if (find_wedge(theory, p, &found, &ignored) == SCREE_OK) {
        dip = scree_pile_dip(&found.pile, &ray);
        core = found.core[1];
        if (equal) scree_wedge_coefficients(&found, &a1, &a2, &b1);
    }
    put(derived, &count, "dip", "1", dip);
    put(derived, &count, "a1", "1", a1);
    put(derived, &count, "a2", "1", a2);
    put(derived, &count, "b1", "1", b1);
    put(derived, &count, "a11", "1", 1 + c * c);
    put(derived, &count, "a22", "1", s * s);
    put(derived, &count, "a12", "1", c * s);
    if (theory->kind != SCREE_WEDGES) put(derived, &count, "core", "rad", core);
    return count;
}

static scree_status layer(const scree_fit_theory *theory, const scree_fit_parameter *p, size_t count,
                          const scree_fit_point *points, scree_stress_2d *stress, scree_error *error)
{
    const scree_layer of = {.force = p[FORCE].value,
                            .base = (scree_layer_base)theory->kind,
                            .thickness = theory->kind == SCREE_LAYER_NONE ? 1 : p[THICKNESS].value,
                            .poisson = theory->kind == SCREE_LAYER_BONDED ? p[POISSON].value : 0};
    if (!(of.thickness > 0)) return no_solution("thickness", error);
    if (!(of.poisson > -1 && of.poisson <= 0.5)) return no_solution("poisson_ratio", error);
    scree_status status = SCREE_OK;
    for (size_t k = 0; k < count && !status; k++) {
        const double x = points[k].x - p[LOAD_X].value, side = p[ELEMENT].value;
        status = side > 0 ? scree_layer_mean(&of, x, points[k].y, side, &stress[k], error)
                          : scree_layer_stress(&of, x, points[k].y, &stress[k], error);
    }
    return status;
}

#define HELD(name_, unit_, meaning_, start)                                                                            \
    {                                                                                                                  \
        .name = (name_), .unit = (unit_), .meaning = (meaning_), .value = (start)                                      \
    }
#define FREE(name_, unit_, meaning_, start)                                                                            \
    {                                                                                                                  \
        .name = (name_), .unit = (unit_), .meaning = (meaning_), .value = (start), .free = true                        \
    }
#define PILE                                                                                                           \
    FREE("weight", "N/m3", "density times gravity", 1), HELD("apex_x", "m", "position of the apex", 0),                \
        HELD("apex_y", "m", "position of the apex", 0)
#define ONE_SLOPE HELD("slope", "rad", "of both sides, also the angle of internal friction", 0.5)
#define TWO_SLOPES                                                                                                     \
    HELD("slope_left", "rad", "also the angle of internal friction", 0.5),                                             \
        HELD("slope_right", "rad", "also the angle of internal friction", 0.5)
#define LOAD                                                                                                           \
    FREE("force", "N/m", "load a length", 1), HELD("load_x", "m", "position of the load", 0),                          \
        HELD("element", "m", "side of the elements that stresses are means over (scree_layer_mean); 0: at points", 0)
#define THICK HELD("thickness", "m", "of the layer", 1)

const scree_fit_theory scree_fit_theories[] = {
    {"ife", {PILE, ONE_SLOPE}, one_slope, IFE, derive_dip},
    {"bcc", {PILE, ONE_SLOPE}, one_slope, BCC, derive_oriented},
    {"fpa", {PILE, ONE_SLOPE}, one_slope, FPA, derive_dip},
    {"osl", {PILE, ONE_SLOPE, FREE("eta", "1", "mu follows by R 4.24", 0.7)}, one_slope, OSL, derive_oriented},
    {"oriented",
     {PILE, ONE_SLOPE, FREE("eta", "1", "of R 4.22", 0.7), FREE("mu", "1", "of R 4.22", -0.2)},
     one_slope,
     ORIENTED,
     derive_oriented},
    {"wedge_dip", {PILE, TWO_SLOPES}, wedge, SCREE_WEDGE_DIP, derive_wedge},
    {"wedge_smooth", {PILE, TWO_SLOPES}, wedge, SCREE_WEDGE_SMOOTH, derive_wedge},
    {"wedge_peak", {PILE, TWO_SLOPES}, wedge, SCREE_WEDGE_PEAK, derive_wedge},
    {"wedge_core",
     {PILE, TWO_SLOPES, FREE("core", "rad", "right boundary of the core from the vertical", 0.6)},
     wedge,
     SCREE_WEDGES,
     derive_wedge},
    {"flamant", {LOAD}, layer, SCREE_LAYER_NONE, NULL},
    {"layer_smooth", {LOAD, THICK}, layer, SCREE_LAYER_SMOOTH, NULL},
    {"layer_bonded",
     {LOAD, THICK, FREE("poisson_ratio", "1", "of plane strain", 0.3)},
     layer,
     SCREE_LAYER_BONDED,
     NULL},
    {.name = NULL},
};
