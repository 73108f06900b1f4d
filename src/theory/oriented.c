#include "theory/oriented.h"

#include <math.h>
#include <stdio.h>

double scree_oriented_surface_ratio(double slope)
{
    return 1 / (1 + 2 * tan(slope) * tan(slope));
}

scree_oriented scree_oriented_of_eta(double slope, double eta)
{
    return (scree_oriented){eta, (1 - eta / scree_oriented_surface_ratio(slope)) / tan(slope)};
}

scree_oriented scree_oriented_of_mu(double slope, double mu)
{
    return (scree_oriented){scree_oriented_surface_ratio(slope) * (1 - mu * tan(slope)), mu};
}

scree_oriented scree_oriented_bcc(double slope)
{
    return scree_oriented_of_mu(slope, 0);
}

scree_oriented scree_oriented_fpa(double slope)
{
    return (scree_oriented){1, -2 * tan(slope)};
}

/// R 4.19 with its labels put right: nn, mm of a stress on the right side.
static void turn(scree_stress_2d s, double tau, double *nn, double *mm)
{
    const double c = cos(tau), n = sin(tau);
    *nn = c * c * s.xx + n * n * s.yy - 2 * n * c * s.xy;
    *mm = n * n * s.xx + c * c * s.yy + 2 * n * c * s.xy;
}

scree_oriented_axes scree_oriented_of_tau(double slope, double tau)
{
    const scree_pile_sector surface = scree_pile_surface(slope, scree_pile_plastic(slope, slope, false), 1);
    double nn, mm;
    turn(surface.y, tau, &nn, &mm);
    return (scree_oriented_axes){nn / mm, tau};
}

scree_oriented scree_oriented_of_axes(scree_oriented_axes a)
{
    const double c = cos(a.tau), s = sin(a.tau), below = c * c - a.ratio * s * s;
    return (scree_oriented){(a.ratio * c * c - s * s) / below, 2 * (a.ratio + 1) * s * c / below};
}

scree_oriented_axes scree_oriented_axes_of(scree_oriented o)
{
    // sigma_nn - K sigma_mm is, but for a factor, sigma_xx - eta sigma_yy - mu sigma_xy: sums and differences of the
    // terms are (1 - K), (1 + K) cos 2 tau and (1 + K) sin 2 tau.
    const double q = (1 - o.eta) / hypot(1 + o.eta, o.mu);
    return (scree_oriented_axes){(1 + q) / (1 - q), M_PI_2 + 0.5 * atan2(o.mu, 1 + o.eta)};
}

double scree_oriented_consistency(double slope, scree_oriented o)
{
    return o.eta - scree_oriented_of_mu(slope, o.mu).eta;
}

void scree_oriented_characteristics(scree_oriented o, double *outward, double *inward)
{
    const double root = sqrt(o.mu * o.mu + 4 * o.eta);
    *outward = 0.5 * (o.mu + root);
    *inward = 0.5 * (o.mu - root);
}

// ---- the pile ----------------------------------------------------------------------------------------------------

static scree_status check(double slope, scree_oriented o, scree_error *error)
{
    const double c = 1 / tan(slope);
    if (!isfinite(o.eta) || !isfinite(o.mu))
        return scree_error_refuse(error, "eta", "K tan^2(tau) that is not 1",
                                  "this relation does not contain sigma_xx");
    if (!(o.mu * o.mu + 4 * o.eta > 0))
        return scree_error_refuse(
            error, "eta", "mu^2 + 4 eta above 0, which is K above 0",
            "the equations of this relation have no real characteristics, so the surface does not rule the "
            "stress inside: take a larger eta");
    if (!(o.eta > 0))
        return scree_error_refuse(
            error, "eta", "eta above 0",
            "both characteristics run to the same side of the pile, so its two slopes cannot carry it: take "
            "eta above 0");
    if (!(c * c - o.mu * c - o.eta > 0))
        return scree_error_refuse(
            error, "eta", "mu below (cot^2(phi) - eta) / cot(phi)",
            "the outward characteristic is flatter than the slope, so no stress vanishes there: take a "
            "smaller eta or mu, or a smaller phi");
    return SCREE_OK;
}

/// The same sector on the other side.
static scree_pile_sector mirror(scree_pile_sector s)
{
    const scree_pile_sector right = s;
    s.from = -right.to;
    s.to = -right.from;
    s.x.xx = -right.x.xx;
    s.x.yy = -right.x.yy;
    s.y.xy = -right.y.xy;
    return s;
}

scree_status scree_oriented_pile(double slope, double weight, scree_oriented o, scree_ideal_pile *p, scree_error *error)
{
    scree_status status = check(slope, o, error);
    if (status) return status;
    const double c = 1 / tan(slope);
    double outward, inward;
    scree_oriented_characteristics(o, &outward, &inward);
    // R 4.28: s* eta c is sigma_xx; the others follow from the balance of forces.
    const double s = o.eta * c * c / (c * c - o.mu * c - o.eta);
    scree_pile_sector outer = scree_pile_surface(slope, s, 1);
    // R 4.29: linear, sigma_xy zero on the axis, continuous on the characteristic through the apex.
    const double shear = s * (c - outward) / (c * c * outward);
    scree_pile_sector inner = {.to = outward,
                               .x = {.yy = -o.mu * shear / o.eta, .xy = shear},
                               .y = {.xx = o.eta * (1 - shear), .yy = 1 - shear}};
    outer.from = outward;
    outer.closure = inner.closure = SCREE_PILE_LINEAR;
    const double relation[3] = {1, -o.eta, -o.mu};
    for (int k = 0; k < 3; k++) outer.relation[k] = inner.relation[k] = relation[k];
    *p = (scree_ideal_pile){.weight = weight, .slope = {slope, slope}, .sectors = 4};
    p->sector[0] = mirror(outer);
    p->sector[1] = mirror(inner);
    p->sector[2] = inner;
    p->sector[3] = outer;
    return SCREE_OK;
}
