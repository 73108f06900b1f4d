/// Piles in the plane: theory/oriented.h, incipient.h and wedge.h for programs.
#include "library/theory.h"

#include "theory/incipient.h"
#include "theory/oriented.h"
#include "theory/wedge.h"

#include <scree/scree.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#define DEGREE (M_PI / 180)
enum { POINTS = 801, SOLUTIONS = SCREE_WEDGES + 1 };

typedef enum pile_kind { IFE, BCC, FPA, OSL, WEDGE, KINDS } pile_kind;

static const char *const kind_names[KINDS] = {"ife", "bcc", "fpa", "osl", "wedge"};
static const char *const titles[KINDS] = {"Incipient failure everywhere", "Constant ratio of normal stresses (BCC)",
                                          "Fixed principal axes (FPA)", "Oriented stress linearity (OSL)",
                                          "Elasto-plastic wedge"};

/// One solution, as it is drawn.
typedef struct solution {
    const char *column, *label;
    scree_ideal_pile pile;
} solution;

typedef struct solutions {
    solution of[SOLUTIONS];
    size_t count;
} solutions;

// ---- what is asked -----------------------------------------------------------------------------------------------

static scree_status find_kind(const char *kind, pile_kind *found, scree_error *error)
{
    for (int k = 0; k < KINDS; k++)
        if (kind && strcmp(kind, kind_names[k]) == 0) {
            *found = (pile_kind)k;
            return SCREE_OK;
        }
    const char *nearest = kind ? scree_nearest(kind, kind_names, KINDS) : NULL;
    return scree_error_refuse(error, "kind", nearest ? nearest : "ife, bcc, fpa, osl, wedge",
                              "there is no such theory");
}

static bool is_angle(double degrees)
{
    return degrees > 0 && degrees < 90;
}

static scree_status check(const scree_theory_pile_of *of, pile_kind kind, scree_error *error)
{
    const struct {
        const char *name;
        double value;
    } positive[] = {{"height", of->height}, {"density", of->density}, {"gravity", of->gravity}};
    for (size_t k = 0; k < sizeof positive / sizeof *positive; k++)
        if (!(positive[k].value > 0 && isfinite(positive[k].value)))
            return scree_error_refuse(error, positive[k].name, "a number above 0",
                                      "this has to be a finite number above 0");
    if (!is_angle(of->slope[0]) || !is_angle(of->slope[1]))
        return scree_error_refuse(error, "slope", "above 0 and below 90 degrees",
                                  "no pile has such a slope: give the angle of repose");
    if (kind != WEDGE && of->slope[0] != of->slope[1])
        return scree_error_refuse(error, "slope", "one angle",
                                  "two slopes are for the wedge alone: this theory is symmetric");
    if (!isnan(of->core) && !is_angle(of->core))
        return scree_error_refuse(error, "core", "above 0 and below 90 degrees",
                                  "the boundary of the core lies between the vertical and the slope");
    if (!isnan(of->axis) && !(fabs(of->axis) < 90))
        return scree_error_refuse(error, "axis", "above -90 and below 90 degrees", "the ray runs down into the pile");
    return SCREE_OK;
}

/// A relation that no pile bears is called by what was given of it, with the eta and mu that this is.
static void name_relation(const scree_theory_pile_of *of, scree_oriented o, scree_error *error)
{
    char wanted[sizeof error->accepted];
    if (strcmp(error->field, "eta") != 0 || !isnan(of->eta)) return;
    (void)snprintf(wanted, sizeof wanted, "%s", error->accepted);
    (void)scree_error_key(error, SCREE_ERROR_INPUT, "%s", isnan(of->tau) ? "mu" : "tau");
    (void)snprintf(error->accepted, sizeof error->accepted, "%.150s; this is eta = %.3g, mu = %.3g", wanted, o.eta,
                   o.mu);
}

/// eta and mu of what was given of eta, mu, K, tau.
static scree_status choose_relation(const scree_theory_pile_of *of, pile_kind kind, scree_oriented *o,
                                    scree_error *error)
{
    const double slope = of->slope[1] * DEGREE;
    const bool eta = !isnan(of->eta), mu = !isnan(of->mu), ratio = !isnan(of->ratio), tau = !isnan(of->tau);
    if (kind == BCC || kind == FPA) {
        *o = kind == BCC ? scree_oriented_bcc(slope) : scree_oriented_fpa(slope);
        return SCREE_OK;
    }
    if ((eta || mu) && (ratio || tau))
        return scree_error_refuse(error, eta ? "eta" : "mu", "eta, mu or both; or tau, or K with tau",
                                  "eta and mu say the same as K and tau: give one of these pairs");
    if (ratio && !tau)
        return scree_error_refuse(error, "ratio", "K together with tau", "the angle tau is needed beside the ratio K");
    if (!eta && !mu && !tau)
        return scree_error_refuse(error, "eta", "eta, mu or tau",
                                  "oriented stress linearity needs one number: which relation");
    if (ratio && !(of->ratio > 0))
        return scree_error_refuse(error, "ratio", "above 0",
                                  "the equations have real characteristics for K above 0 alone");
    if (tau) {
        const double angle = of->tau * DEGREE;
        *o = scree_oriented_of_axes(ratio ? (scree_oriented_axes){of->ratio, angle}
                                          : scree_oriented_of_tau(slope, angle));
    } else {
        *o = eta && mu ? (scree_oriented){of->eta, of->mu}
             : eta     ? scree_oriented_of_eta(slope, of->eta)
                       : scree_oriented_of_mu(slope, of->mu);
    }
    return SCREE_OK;
}

// ---- values ------------------------------------------------------------------------------------------------------

static void add_relation(scree_theory *t, const scree_ideal_pile *pile, double slope, scree_oriented o)
{
    const scree_oriented_axes axes = scree_oriented_axes_of(o);
    const scree_stress_2d surface = pile->sector[3].y;
    double outward, inward;
    scree_oriented_characteristics(o, &outward, &inward);
    theory_add(t, "eta", o.eta, "1", "sigma_xx = eta sigma_yy + mu sign(x) sigma_xy (R 4.22)");
    theory_add(t, "mu", o.mu, "1", "");
    theory_add(t, "ratio", axes.ratio, "1", "K of sigma_nn = K sigma_mm (R 4.18)");
    theory_add(t, "tau", axes.tau / DEGREE, "degree", "of n from the horizontal; (1/K, tau - 90) is the same relation");
    theory_add(t, "surface_ratio", scree_oriented_surface_ratio(slope), "1", "eta_0 of a surface that yields (R 4.21)");
    theory_add(t, "consistency", scree_oriented_consistency(slope, o), "1",
               "eta - eta_0 (1 - mu tan phi): 0 where the surface yields (R 4.24)");
    theory_add(t, "surface_mobilised", asin(scree_mobilised_friction(surface)) / DEGREE, "degree",
               "mobilised friction at the surface");
    theory_add(t, "outward", atan(outward) / DEGREE, "degree",
               "characteristic from the apex, boundary of the inner region, from the vertical");
    theory_add(t, "inward", atan(inward) / DEGREE, "degree", "the other characteristic of the right side");
}

/// What a pile does on its base.
static void add_base(scree_theory *t, const char *const name[5], const scree_theory_pile_of *of,
                     const scree_ideal_pile *pile)
{
    double ray;
    const double dip = scree_pile_dip(pile, &ray);
    const scree_stress_2d axis = scree_pile_stress(pile, 0, of->height);
    const scree_stress_2d most = scree_pile_stress(pile, ray * of->height, of->height);
    theory_add(t, name[0], axis.yy, "Pa", "sigma_yy on the base below the apex");
    theory_add(t, name[1], axis.xx, "Pa", "sigma_xx there");
    theory_add(t, name[2], most.yy, "Pa", "largest sigma_yy on the base");
    const bool symmetric = of->slope[0] == of->slope[1];
    theory_add(t, name[3], (symmetric ? fabs(ray) : ray) * of->height, "m",
               symmetric ? "distance of it from below the apex" : "its position, to the right from below the apex");
    theory_add(t, name[4], dip, "1", "1 - sigma_yy below the apex over the largest one");
}

static const char *const base_names[5] = {"axis_vertical", "axis_horizontal", "largest_vertical", "largest_at", "dip"};

static void add_check(scree_theory *t, const solutions *all)
{
    scree_pile_check worst = {0};
    for (size_t k = 0; k < all->count; k++) {
        const scree_pile_check c = scree_pile_examine(&all->of[k].pile);
        worst.equilibrium = fmax(worst.equilibrium, c.equilibrium);
        worst.surface = fmax(worst.surface, c.surface);
        worst.continuity = fmax(worst.continuity, c.continuity);
        worst.closure = fmax(worst.closure, c.closure);
        worst.weight = fmax(worst.weight, fabs(c.weight));
    }
    theory_add(t, "check_equilibrium", worst.equilibrium, "1", "largest div sigma - rho g, over rho g");
    theory_add(t, "check_weight", worst.weight, "1", "vertical force on the base over the weight, less 1");
    theory_add(t, "check_closure", worst.closure, "1", "largest residual of the yield condition or of the relation");
    theory_add(t, "check_surface", worst.surface, "1", "largest stress on the slopes, over rho g H");
    theory_add(t, "check_continuity", worst.continuity, "1", "largest jump of a stress between sectors, over rho g H");
}

// ---- wedge -------------------------------------------------------------------------------------------------------

typedef struct wedge_names {
    const char *column, *label, *found, *left, *right, *axis, *shear, *a1, *a2, *b1, *mobilised, *excess, *base[5];
} wedge_names;

#define NAMES(word, text)                                                                                              \
    {                                                                                                                  \
        .column = (word), .label = (text), .found = word "_solutions", .left = word "_core_left",                      \
        .right = word "_core_right", .axis = word "_axis", .shear = word "_axis_shear", .a1 = word "_a1",              \
        .a2 = word "_a2", .b1 = word "_b1", .mobilised = word "_mobilised", .excess = word "_excess",                  \
        .base = {word "_axis_vertical", word "_axis_horizontal", word "_largest_vertical", word "_largest_at",         \
                 word "_dip"},                                                                                         \
    }
static const wedge_names wedge_rows[SOLUTIONS] = {
    [SCREE_WEDGE_DIP] = NAMES("dip", "yields on the axis, dip"),
    [SCREE_WEDGE_SMOOTH] = NAMES("smooth", "smooth core"),
    [SCREE_WEDGE_PEAK] = NAMES("peak", "yields on the axis, peak"),
    [SCREE_WEDGES] = NAMES("given", "core as given"),
};

static void add_wedge(scree_theory *t, const wedge_names *n, const scree_theory_pile_of *of, const scree_wedge *w)
{
    const bool upright = of->slope[0] == of->slope[1] && w->axis == 0;
    double a1, a2, b1;
    scree_wedge_coefficients(w, &a1, &a2, &b1);
    theory_add(t, n->left, w->core[0] / DEGREE, "degree", "left boundary of the elastic core from the vertical");
    theory_add(t, n->right, w->core[1] / DEGREE, "degree", "right boundary (betahat of R 4.13)");
    theory_add(t, n->a1, upright ? a1 : NAN, "1", "R 4.12 (tension positive there)");
    theory_add(t, n->a2, upright ? a2 : NAN, "1", "");
    theory_add(t, n->b1, upright ? b1 : NAN, "1", "below 0: dip");
    theory_add(t, n->axis, upright ? NAN : w->axis / DEGREE, "degree",
               "ray between the halves of the core, to the right");
    theory_add(t, n->shear, upright ? NAN : w->inside.xy, "1", "sigma_xy on the ray over rho g y");
    theory_add(t, n->mobilised, asin(scree_mobilised_friction(w->inside)) / DEGREE, "degree",
               "mobilised friction on the ray between the halves of the core");
    theory_add(t, n->excess, scree_wedge_excess(w) / DEGREE, "degree",
               "largest mobilised friction in the core over that of its side: above 0 it would yield");
    add_base(t, n->base, of, &w->pile);
}

static void keep(solutions *all, const char *column, const char *label, const scree_ideal_pile *pile)
{
    all->of[all->count++] = (solution){column, label, *pile};
}

/// No kind of core balances.
static scree_status refuse_axis(const scree_theory_pile_of *of, scree_error *error)
{
    if (isnan(of->axis))
        return scree_error_refuse(error, "phi", NULL, "no wedge of these slopes balances, whatever its ray");
    return scree_error_refuse(error, "axis", "a ray nearer to the vertical, or free: one without shear",
                              "no wedge balances about a ray %.4g degrees from the vertical", of->axis);
}

static scree_status solve_wedge(scree_theory *t, const scree_theory_pile_of *of, solutions *all, scree_error *error)
{
    const scree_wedge_of wanted = {.slope = {of->slope[0] * DEGREE, of->slope[1] * DEGREE},
                                   .friction = isnan(of->friction) ? 0 : of->friction * DEGREE,
                                   .passive = of->passive,
                                   .weight = of->density * of->gravity};
    const double axis = of->axis * DEGREE;
    scree_wedge wedge;
    bool found;
    for (int k = 0; k < SCREE_WEDGES; k++) {
        const double *ray = isnan(axis) ? NULL : &axis;
        scree_status status = scree_wedge_solve(&wanted, (scree_wedge_kind)k, ray, &found, &wedge, error);
        if (status) return status;
        theory_add(t, wedge_rows[k].found, found, "1", "1: there is a solution of this kind");
        if (!found) continue;
        add_wedge(t, &wedge_rows[k], of, &wedge);
        keep(all, wedge_rows[k].column, wedge_rows[k].label, &wedge.pile);
    }
    if (isnan(of->core)) return all->count > 0 ? SCREE_OK : refuse_axis(of, error);
    scree_status status =
        scree_wedge_of_core(&wanted, of->core * DEGREE, isnan(axis) ? 0 : axis, &found, &wedge, error);
    if (!status && !found)
        status = scree_error_refuse(error, "core", "between the vertical and the slope",
                                    "there is no pile with this boundary of the core: take it farther from both");
    if (status) return status;
    add_wedge(t, &wedge_rows[SCREE_WEDGES], of, &wedge);
    keep(all, wedge_rows[SCREE_WEDGES].column, wedge_rows[SCREE_WEDGES].label, &wedge.pile);
    return SCREE_OK;
}

// ---- the other kinds ---------------------------------------------------------------------------------------------

static scree_status solve_one(scree_theory *t, const scree_theory_pile_of *of, pile_kind kind, solutions *all,
                              scree_error *error)
{
    const double slope = of->slope[1] * DEGREE, weight = of->density * of->gravity;
    scree_oriented o = {0};
    scree_ideal_pile pile;
    scree_status status = SCREE_OK;
    if (kind == IFE) {
        status = scree_incipient_pile(slope, weight, &pile, error);
    } else {
        status = choose_relation(of, kind, &o, error);
        if (!status) {
            status = scree_oriented_pile(slope, weight, o, &pile, error);
            if (status) name_relation(of, o, error);
        }
        if (!status) add_relation(t, &pile, slope, o);
    }
    if (status) return status;
    add_base(t, base_names, of, &pile);
    keep(all, kind_names[kind], NULL, &pile);
    return SCREE_OK;
}

// ---- figures -----------------------------------------------------------------------------------------------------

typedef enum quantity { VERTICAL, HORIZONTAL, SHEAR, MOBILISED, QUANTITIES } quantity;

static const char *const quantity_names[] = {"vertical", "horizontal", "shear", "mobilised"};
static const char *const quantity_labels[] = {"vertical stress σ_{yy} (Pa)", "horizontal stress σ_{xx} (Pa)",
                                              "shear stress σ_{xy} (Pa)", "mobilised friction (degree)"};

static double value_of(quantity what, scree_stress_2d s)
{
    switch (what) {
    case VERTICAL:
        return s.yy;
    case HORIZONTAL:
        return s.xx;
    case SHEAR:
        return s.xy;
    default:
        return s.xx + s.yy > 0 ? asin(fmin(scree_mobilised_friction(s), 1)) / DEGREE : NAN;
    }
}

/// The base from foot to foot; no curve of the mobilised friction reaches the feet, where there is no stress.
static scree_status add_figure(scree_theory *t, const scree_theory_pile_of *of, pile_kind kind, const solutions *all,
                               quantity what, scree_error *error)
{
    theory_figure *f;
    scree_status status = theory_begin_figure(t, quantity_names[what], POINTS, all->count, &f, error);
    if (status) return status;
    const double left = -of->height / tan(of->slope[0] * DEGREE), right = of->height / tan(of->slope[1] * DEGREE);
    if (of->slope[0] == of->slope[1])
        (void)snprintf(f->title, sizeof f->title, "%s, slope %g degrees", titles[kind], of->slope[0]);
    else
        (void)snprintf(f->title, sizeof f->title, "%s, slopes %g and %g degrees", titles[kind], of->slope[0],
                       of->slope[1]);
    f->x_name = "x";
    f->x_unit = "m";
    f->x_label = "distance from below the apex on the base (m)";
    f->y_unit = what == MOBILISED ? "degree" : "Pa";
    f->y_label = quantity_labels[what];
    for (size_t i = 0; i < POINTS; i++) f->x[i] = left + (right - left) * (double)i / (POINTS - 1);
    // Kinks are drawn where they are.
    for (size_t k = 0; k < all->count; k++)
        for (size_t i = 0; i + 1 < all->of[k].pile.sectors; i++) {
            const double kink = all->of[k].pile.sector[i].to * of->height;
            f->x[lround((kink - left) / (right - left) * (POINTS - 1))] = kink;
        }
    for (size_t k = 0; k < all->count; k++) {
        f->curve[k].name = all->of[k].column;
        f->curve[k].label = all->of[k].label;
        f->curve[k].colour = (int)k + 1;
        for (size_t i = 1; i + 1 < POINTS; i++)
            f->curve[k].y[i] = value_of(what, scree_pile_stress(&all->of[k].pile, f->x[i], of->height));
        // The feet lie on the surface.
        f->curve[k].y[0] = f->curve[k].y[POINTS - 1] = value_of(what, (scree_stress_2d){0});
    }
    return SCREE_OK;
}

static scree_status solve(scree_theory *t, const scree_theory_pile_of *of, pile_kind kind, scree_error *error)
{
    solutions all = {.count = 0};
    scree_status status = kind == WEDGE ? solve_wedge(t, of, &all, error) : solve_one(t, of, kind, &all, error);
    if (status) return status;
    add_check(t, &all);
    for (int what = 0; what < QUANTITIES && !status && all.count > 0; what++)
        status = add_figure(t, of, kind, &all, (quantity)what, error);
    return status;
}

scree_status scree_theory_pile(const scree_theory_pile_of *of, scree_theory **theory, scree_error *error)
{
    pile_kind kind = IFE;
    *theory = NULL;
    scree_status status = find_kind(of->kind, &kind, error);
    if (!status) status = check(of, kind, error);
    if (!status) status = theory_create(theory, error);
    if (!status) status = solve(*theory, of, kind, error);
    if (!status) return SCREE_OK;
    scree_theory_free(*theory);
    *theory = NULL;
    return status;
}
