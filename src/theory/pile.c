#include "theory/pile.h"

#include <gsl/gsl_integration.h>

#include <math.h>

enum { SAMPLES = 400 }; ///< of a sector that is looked through

static scree_stress_2d combine(double a, scree_stress_2d s, double b, scree_stress_2d t)
{
    return (scree_stress_2d){a * s.xx + b * t.xx, a * s.yy + b * t.yy, a * s.xy + b * t.xy};
}

static double largest(scree_stress_2d s)
{
    return fmax(fmax(fabs(s.xx), fabs(s.yy)), fabs(s.xy));
}

// ---- a series over the rays --------------------------------------------------------------------------------------

/// Clenshaw's sum of Chebyshev terms at v in [-1, 1], and its derivative.
static double series_sum(const double *term, size_t terms, double v, double *derivative)
{
    double value = 0, before = 0, slope = 0, slope_before = 0;
    for (size_t k = terms - 1; k > 0; k--) {
        const double next = 2 * v * value - before + term[k];
        const double slope_next = 2 * v * slope - slope_before + 2 * value;
        before = value, value = next;
        slope_before = slope, slope = slope_next;
    }
    *derivative = v * slope - slope_before + value;
    return v * value - before + term[0];
}

/// Stress over rho g y on the ray u = x / y > 0, and its derivative by u.
static scree_stress_2d series_stress(const scree_ideal_pile *p, double u, scree_stress_2d *derivative)
{
    const double c = 1 / tan(p->slope[1]), s = sin(p->sector[0].friction);
    double by_ray, turn_rate;
    const double over = series_sum(p->mean, p->terms, 2 * u / c - 1, &by_ray);
    const double turn = series_sum(p->turn, p->terms, 2 * u / c - 1, &turn_rate);
    const double mean = (c - u) * over, rate = (c - u) * by_ray * 2 / c - over;
    const double cosine = s * cos(2 * turn), sine = s * sin(2 * turn), turning = 2 * turn_rate * 2 / c;
    *derivative = (scree_stress_2d){.xx = rate * (1 - cosine) + mean * sine * turning,
                                    .yy = rate * (1 + cosine) - mean * sine * turning,
                                    .xy = rate * sine + mean * cosine * turning};
    return (scree_stress_2d){mean * (1 - cosine), mean * (1 + cosine), mean * sine};
}

// ---- stresses ----------------------------------------------------------------------------------------------------

static const scree_pile_sector *sector_of(const scree_ideal_pile *p, double u)
{
    if (!(u >= p->sector[0].from && u <= p->sector[p->sectors - 1].to)) return NULL;
    size_t k = 0;
    while (k + 1 < p->sectors && u > p->sector[k].to) k++;
    return &p->sector[k];
}

scree_stress_2d scree_pile_stress(const scree_ideal_pile *p, double x, double y)
{
    const scree_pile_sector *s = y > 0 ? sector_of(p, x / y) : NULL;
    scree_stress_2d unused, found = {0};
    if (!s) return found;
    if (p->terms == 0) return combine(p->weight * x, s->x, p->weight * y, s->y);
    found = combine(p->weight * y, series_stress(p, fabs(x) / y, &unused), 0, found);
    found.xy = copysign(found.xy, x * found.xy);
    return found;
}

void scree_pile_gradient(const scree_ideal_pile *p, double x, double y, scree_stress_2d *along_x,
                         scree_stress_2d *along_y)
{
    const scree_pile_sector *s = y > 0 ? sector_of(p, x / y) : NULL;
    *along_x = *along_y = (scree_stress_2d){0};
    if (!s) return;
    if (p->terms == 0) {
        *along_x = combine(p->weight, s->x, 0, s->x);
        *along_y = combine(p->weight, s->y, 0, s->y);
        return;
    }
    const double u = fabs(x) / y, sign = x < 0 ? -1 : 1;
    scree_stress_2d rate;
    const scree_stress_2d stress = series_stress(p, u, &rate);
    *along_x = combine(p->weight * sign, rate, 0, rate);
    *along_y = combine(p->weight, stress, -p->weight * u, rate);
    along_x->xy *= sign;
    along_y->xy *= sign;
}

double scree_mobilised_friction(scree_stress_2d s)
{
    return hypot(s.xx - s.yy, 2 * s.xy) / (s.xx + s.yy);
}

// ---- residuals ---------------------------------------------------------------------------------------------------

static double closure_residual(const scree_pile_sector *s, double u, scree_stress_2d stress)
{
    if (s->closure == SCREE_PILE_YIELDS)
        return fabs(hypot(stress.xx - stress.yy, 2 * stress.xy) - sin(s->friction) * (stress.xx + stress.yy));
    if (s->closure == SCREE_PILE_ELASTIC) return 0;
    const double sign = u < 0 ? -1 : 1;
    return fabs(s->relation[0] * stress.xx + s->relation[1] * stress.yy + s->relation[2] * sign * stress.xy);
}

/// Into `check` what one ray inside of a sector shows.
static void examine_ray(const scree_ideal_pile *p, const scree_pile_sector *s, double u, scree_pile_check *check)
{
    scree_stress_2d dx, dy, stress = scree_pile_stress(p, u, 1);
    scree_pile_gradient(p, u, 1, &dx, &dy);
    const double balance = fmax(fabs(dx.xx + dy.xy), fabs(dx.xy + dy.yy - p->weight)) / p->weight;
    stress = combine(1 / p->weight, stress, 0, stress);
    check->equilibrium = fmax(check->equilibrium, balance);
    check->closure = fmax(check->closure, closure_residual(s, u, stress));
    if (s->closure != SCREE_PILE_YIELDS)
        check->mobilised = fmax(check->mobilised, asin(fmin(scree_mobilised_friction(stress), 1)));
}

/// Force on the part of a cut at depth 1 that lies in a sector, over rho g.
static double sector_force(const scree_ideal_pile *p, const scree_pile_sector *s)
{
    gsl_integration_glfixed_table *table = gsl_integration_glfixed_table_alloc(SCREE_PILE_TERMS);
    double sum = 0;
    if (!table) return NAN;
    for (size_t k = 0; k < SCREE_PILE_TERMS; k++) {
        double u, share;
        // A series is one of |x|: its halves are integrated apart.
        (void)gsl_integration_glfixed_point(p->terms > 0 ? 0 : s->from, s->to, k, &u, &share, table);
        sum += share * scree_pile_stress(p, u, 1).yy * (p->terms > 0 ? 2 : 1);
    }
    gsl_integration_glfixed_table_free(table);
    return sum / p->weight;
}

scree_pile_check scree_pile_examine(const scree_ideal_pile *p)
{
    scree_pile_check check = {0};
    double force = 0;
    for (size_t k = 0; k < p->sectors; k++) {
        const scree_pile_sector *s = &p->sector[k], *next = s + 1;
        for (int i = 0; i < SAMPLES; i++) examine_ray(p, s, s->from + (s->to - s->from) * (i + 0.5) / SAMPLES, &check);
        force += sector_force(p, s);
        if (k + 1 == p->sectors) break;
        const scree_stress_2d here = combine(s->to, s->x, 1, s->y), there = combine(s->to, next->x, 1, next->y);
        check.continuity = fmax(check.continuity, largest(combine(1, here, -1, there)));
    }
    const double left = p->sector[0].from, right = p->sector[p->sectors - 1].to;
    check.surface = fmax(largest(scree_pile_stress(p, left, 1)), largest(scree_pile_stress(p, right, 1))) / p->weight;
    check.weight = force / (0.5 * (right - left)) - 1;
    return check;
}

double scree_pile_dip(const scree_ideal_pile *p, double *largest_ray)
{
    double most = 0;
    *largest_ray = 0;
    for (size_t k = 0; k < p->sectors; k++)
        for (int i = 0; i <= SAMPLES; i++) {
            const double u = p->sector[k].from + (p->sector[k].to - p->sector[k].from) * i / SAMPLES;
            const double here = scree_pile_stress(p, u, 1).yy;
            // A plateau is as high as its edge but for round-off: the ray that is nearest to the axis counts.
            if (here > most * (1 + 1e-12) || (here > most * (1 - 1e-12) && fabs(u) < fabs(*largest_ray))) {
                most = fmax(here, most);
                *largest_ray = u;
            }
        }
    return 1 - scree_pile_stress(p, 0, 1).yy / most;
}

// ---- the surface -------------------------------------------------------------------------------------------------

double scree_pile_plastic(double slope, double friction, bool passive)
{
    // (s (1 - t^2) - 1)^2 + 4 t^2 s^2 = sin^2 (s (1 + t^2) + 1)^2, t = tan(slope).
    const double t2 = tan(slope) * tan(slope), c2 = cos(friction) * cos(friction);
    const double half = (1 - t2) + (1 - c2) * (1 + t2), square = (1 + t2) * (1 + t2);
    // Where slope and friction are the same the root vanishes but for round-off.
    const double inside = half * half - square * c2 * c2, root = inside > 1e-14 ? sqrt(inside) : 0;
    return passive ? (half + root) / (square * c2) : c2 / (half + root);
}

scree_pile_sector scree_pile_surface(double slope, double s, int side)
{
    const double sign = side ? 1 : -1, t = tan(slope);
    const scree_stress_2d a = {s, 1 + t * t * s, sign * t * s};
    return (scree_pile_sector){.from = side ? 0 : -1 / t,
                               .to = side ? 1 / t : 0,
                               .x = {-sign * t * a.xx, -sign * t * a.yy, -sign * t * a.xy},
                               .y = a};
}
