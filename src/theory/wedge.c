#include "theory/wedge.h"

#include <math.h>
#include <stdio.h>

enum {
    SCAN = 400,   ///< places at which roots are looked for
    AXES = 120,   ///< rays that are tried
    HALVINGS = 90 ///< of an interval with a root: to the last bit
};

/// What a pile has beside the ray.
typedef struct sides {
    const scree_wedge_of *of;
    double end[2];     ///< rays of the surface
    double plastic[2]; ///< s of the surface sectors
    double sine;       ///< of the friction of the ray
    double axis;       ///< ray
} sides;

/// A core: rays of its boundaries, and the stress on the ray over rho g y.
typedef struct core {
    double left, right;
    scree_stress_2d inside;
} core;

static scree_stress_2d on_ray(const scree_pile_sector *s, double u)
{
    return (scree_stress_2d){s->x.xx * u + s->y.xx, s->x.yy * u + s->y.yy, s->x.xy * u + s->y.xy};
}

/// Stress of the yielding side on a ray.
static scree_stress_2d boundary_stress(const sides *w, int side, double u)
{
    const scree_pile_sector s = scree_pile_surface(w->of->slope[side], w->plastic[side], side);
    return on_ray(&s, u);
}

/// The balance of forces in the half between the ray and the boundary u is
///     sigma_xx = a + u sigma_xy,    u sigma_yy = b + sigma_xy    on the ray.
static void half_balance(const sides *w, int side, double u, double *a, double *b)
{
    const scree_stress_2d s = boundary_stress(w, side, u);
    *a = s.xx - w->axis * s.xy;
    *b = w->axis * s.yy - s.xy + u - w->axis;
}

/// What is left of the two balances when the shear on the ray has been eliminated; linear in `left`.
static double mismatch(const sides *w, double left, double right)
{
    double a[2], b[2];
    half_balance(w, 0, left, &a[0], &b[0]);
    half_balance(w, 1, right, &a[1], &b[1]);
    return a[0] - a[1] + right * b[0] - left * b[1];
}

static core core_of(const sides *w, double right)
{
    // Two values of a linear function.
    const double near = w->axis - 1, far = w->axis - 2;
    const double one = mismatch(w, near, right), two = mismatch(w, far, right);
    const double left = near - one * (far - near) / (two - one);
    double a[2], b[2];
    half_balance(w, 0, left, &a[0], &b[0]);
    half_balance(w, 1, right, &a[1], &b[1]);
    const double shear = (a[0] - a[1]) / (right - left);
    return (core){left, right, {a[1] + right * shear, (b[1] + shear) / right, shear}};
}

static bool is_between(const sides *w, const core *c)
{
    return c->left > w->end[0] && c->left < w->axis && c->right > w->axis && c->right < w->end[1] && c->left < 0;
}

static bool is_inside(const sides *w, const core *c)
{
    return is_between(w, c) && c->inside.xx + c->inside.yy > 0;
}

static double jump_of(const sides *w, const core *c)
{
    const double left = (c->inside.yy - boundary_stress(w, 0, c->left).yy) / (w->axis - c->left),
                 right = (boundary_stress(w, 1, c->right).yy - c->inside.yy) / (c->right - w->axis);
    return right - left;
}

/// Zero where the ray yields, or where nothing jumps.
static double condition(const sides *w, scree_wedge_kind kind, const core *c)
{
    const scree_stress_2d s = c->inside;
    if (kind == SCREE_WEDGE_SMOOTH) return jump_of(w, c);
    return hypot(s.xx - s.yy, 2 * s.xy) - w->sine * (s.xx + s.yy);
}

/// The right boundary between two with different signs of the condition.
static core refine(const sides *w, scree_wedge_kind kind, double low, double high)
{
    const core start = core_of(w, low);
    const bool positive = condition(w, kind, &start) > 0;
    for (int k = 0; k < HALVINGS; k++) {
        const double middle = 0.5 * (low + high);
        const core c = core_of(w, middle);
        *((condition(w, kind, &c) > 0) == positive ? &low : &high) = middle;
    }
    return core_of(w, 0.5 * (low + high));
}

static bool is_of_kind(const sides *w, scree_wedge_kind kind, const core *c)
{
    const double jump = jump_of(w, c);
    return is_inside(w, c) && (kind == SCREE_WEDGE_SMOOTH || (kind == SCREE_WEDGE_DIP) == (jump > 0));
}

static bool find_core(const sides *w, scree_wedge_kind kind, core *found)
{
    // By angles: a flat slope is far off, and a steep one near.
    const double from = fmax(w->axis, 0), angle = atan(from), width = atan(w->end[1]) - angle;
    double before = NAN, place = from;
    for (int k = 1; k < SCAN; k++) {
        const double right = tan(angle + width * k / SCAN);
        const core c = core_of(w, right);
        // Where the ray would be drawn apart the condition is positive: what is pressed there may be narrower than a
        // step.
        const double here = is_between(w, &c) ? condition(w, kind, &c) : NAN;
        if ((here > 0 && before <= 0) || (here <= 0 && before > 0)) {
            *found = refine(w, kind, place, right);
            if (is_of_kind(w, kind, found)) return true;
        }
        before = here;
        place = right;
    }
    return false;
}

/// Shear force on the ray, over rho g y.
static double shear_on(double axis, scree_stress_2d s)
{
    return ((s.xx - s.yy) * axis + s.xy * (1 - axis * axis)) / (1 + axis * axis);
}

/// The ray without shear that is nearest to the vertical.
static bool find_axis(sides *w, scree_wedge_kind kind, core *found)
{
    const double reach = 0.5 * fmin(-w->end[0], w->end[1]), step = 2 * reach / AXES;
    double before = NAN, best = NAN;
    for (int k = 0; k <= AXES; k++) {
        w->axis = -reach + step * k;
        const double here = find_core(w, kind, found) ? shear_on(w->axis, found->inside) : NAN;
        if ((here > 0) != (before > 0) && !isnan(here) && !isnan(before)) {
            double low = w->axis - step, high = w->axis;
            for (int i = 0; i < HALVINGS; i++) {
                w->axis = 0.5 * (low + high);
                const bool there = find_core(w, kind, found);
                *(there && (shear_on(w->axis, found->inside) > 0) == (before > 0) ? &low : &high) = w->axis;
            }
            if (isnan(best) || fabs(low) < fabs(best)) best = 0.5 * (low + high);
            w->axis = -reach + step * k;
        }
        before = here;
    }
    w->axis = best;
    return !isnan(best) && find_core(w, kind, found);
}

// ---- the pile ----------------------------------------------------------------------------------------------------

/// Linear between two rays with their stresses.
static scree_pile_sector between(double from, scree_stress_2d first, double to, scree_stress_2d last)
{
    const double d = to - from;
    return (scree_pile_sector){.from = from,
                               .to = to,
                               .closure = SCREE_PILE_ELASTIC,
                               .x = {(last.xx - first.xx) / d, (last.yy - first.yy) / d, (last.xy - first.xy) / d},
                               .y = {(to * first.xx - from * last.xx) / d, (to * first.yy - from * last.yy) / d,
                                     (to * first.xy - from * last.xy) / d}};
}

static void make_pile(const sides *w, const core *c, scree_wedge *wedge)
{
    const double boundary[2] = {c->left, c->right};
    scree_ideal_pile *p = &wedge->pile;
    *p = (scree_ideal_pile){.weight = w->of->weight, .slope = {w->of->slope[0], w->of->slope[1]}, .sectors = 4};
    for (int side = 0; side < 2; side++) {
        scree_pile_sector s = scree_pile_surface(w->of->slope[side], w->plastic[side], side);
        *(side ? &s.from : &s.to) = boundary[side];
        s.closure = SCREE_PILE_YIELDS;
        s.friction = w->of->friction > 0 ? w->of->friction : w->of->slope[side];
        p->sector[side ? 3 : 0] = s;
        wedge->core[side] = atan(fabs(boundary[side]));
    }
    p->sector[1] = between(c->left, boundary_stress(w, 0, c->left), w->axis, c->inside);
    p->sector[2] = between(w->axis, c->inside, c->right, boundary_stress(w, 1, c->right));
    wedge->axis = atan(w->axis);
    wedge->inside = c->inside;
    wedge->jump = jump_of(w, c);
}

static scree_status begin(const scree_wedge_of *of, sides *w, scree_error *error)
{
    for (int side = 0; side < 2; side++) {
        const double slope = of->slope[side];
        if (!(slope > 0 && slope < M_PI_2))
            return scree_error_refuse(error, "slope", "above 0 and below 90 degrees", "a pile has no such slope");
        if (of->friction != 0 && !(of->friction >= slope && of->friction < M_PI_2))
            return scree_error_refuse(error, "friction", "from the larger slope to 90 degrees",
                                      "a slope above the angle of internal friction does not stand");
        const double friction = of->friction > 0 ? of->friction : slope;
        w->plastic[side] = scree_pile_plastic(slope, friction, of->passive);
        w->end[side] = (side ? 1 : -1) / tan(slope);
    }
    w->of = of;
    w->sine = sin(of->friction > 0 ? of->friction : fmin(of->slope[0], of->slope[1]));
    w->axis = 0;
    return SCREE_OK;
}

scree_status scree_wedge_solve(const scree_wedge_of *of, scree_wedge_kind kind, const double *axis, bool *found,
                               scree_wedge *wedge, scree_error *error)
{
    sides w;
    core c;
    *found = false;
    scree_status status = begin(of, &w, error);
    if (status) return status;
    if (axis) w.axis = tan(*axis);
    // A smooth core has no ray, and equal slopes have an upright one.
    const bool fixed = axis || kind == SCREE_WEDGE_SMOOTH || of->slope[0] == of->slope[1];
    *found = fixed ? find_core(&w, kind, &c) : find_axis(&w, kind, &c);
    if (*found) make_pile(&w, &c, wedge);
    return SCREE_OK;
}

scree_status scree_wedge_of_core(const scree_wedge_of *of, double angle, double axis, bool *found, scree_wedge *wedge,
                                 scree_error *error)
{
    sides w;
    *found = false;
    scree_status status = begin(of, &w, error);
    if (status) return status;
    w.axis = tan(axis);
    const core c = core_of(&w, tan(angle));
    *found = is_inside(&w, &c);
    if (*found) make_pile(&w, &c, wedge);
    return SCREE_OK;
}

double scree_wedge_excess(const scree_wedge *w)
{
    double most = -M_PI_2;
    for (int side = 0; side < 2; side++) {
        const scree_pile_sector *half = &w->pile.sector[1 + side];
        const double friction = w->pile.sector[side ? 3 : 0].friction;
        for (int k = 0; k <= SCAN; k++) {
            const scree_stress_2d s = on_ray(half, half->from + (half->to - half->from) * k / SCAN);
            most = fmax(most, asin(fmin(scree_mobilised_friction(s), 1)) - friction);
        }
    }
    return most;
}

void scree_wedge_coefficients(const scree_wedge *w, double *a1, double *a2, double *b1)
{
    const scree_pile_sector *right = &w->pile.sector[2];
    *a1 = right->x.xy;
    *a2 = 1 - right->y.xx;
    *b1 = -right->x.yy;
}
