#include "theory/incipient.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#define TOLERANCE 1e-13
#define FIRST     1e-3 ///< step
#define LOOK      0.1  ///< ln d between looks at where a solution goes
#define LAST      30.  ///< ln (c / d) at which nothing can be told any more
#define TOO_MUCH  1.05 ///< of the mean stress at the surface
#define TOO_FAR   0.02 ///< rad beyond the angle at the surface

typedef struct incipient {
    double slope, sine, cotangent;
    gsl_odeiv2_driver *driver;
} incipient;

/// state = {P / d, psi} over t = ln(c / d). Fails where a ray is a characteristic.
static int rates(double t, const double state[], double rate[], void *data)
{
    const incipient *of = data;
    const double c = of->cotangent, s = of->sine, distance = c * exp(-t), u = c - distance;
    const double mean = state[0] * distance, cosine = s * cos(2 * state[1]), sine = s * sin(2 * state[1]);
    // d/du of P (1 - cosine) - u d/du of P sine = -P sine, d/du of P sine - u d/du of P (1 + cosine) = 1 - P (1 +
    // cosine).
    const double a = (1 - cosine) - u * sine, b = 2 * mean * (sine - u * cosine);
    const double e = sine - u * (1 + cosine), f = 2 * mean * (cosine + u * sine);
    const double first = -mean * sine, second = 1 - mean * (1 + cosine), determinant = a * f - b * e;
    if (!(determinant > 0)) return GSL_EDOM;
    rate[0] = (first * f - second * b) / determinant + state[0];
    rate[1] = (a * second - e * first) / determinant * distance;
    return GSL_SUCCESS;
}

/// From the axis, where sigma_yy is `on_axis` times rho g y; back to t = 0.
static void start(const incipient *of, double on_axis, double state[2])
{
    state[0] = on_axis / (1 + of->sine) / of->cotangent;
    state[1] = 0;
    (void)gsl_odeiv2_driver_reset_hstart(of->driver, FIRST);
}

/// Whether a solution misses the surface because the stress on the axis is too large.
static bool is_too_much(const incipient *of, double on_axis)
{
    const double end = M_PI_4 - 0.5 * of->slope;
    double state[2], t = 0;
    start(of, on_axis, state);
    for (double to = LOOK; to < LAST; to += LOOK) {
        // What fails has met a characteristic: before the surface with too much stress, behind it with too little.
        if (gsl_odeiv2_driver_apply(of->driver, &t, to, state) != GSL_SUCCESS) return state[1] < end;
        if (!(state[0] > 0) || state[1] > end + TOO_FAR) return false;
        if (state[0] > TOO_MUCH * tan(of->slope)) return true;
    }
    return true;
}

static scree_status refuse(scree_error *error)
{
    return scree_error_refuse(error, "slope", "0.5 to 85.5 degrees", "the pile at the limit of failure was not found");
}

static scree_status fill_series(const incipient *of, double on_axis, scree_ideal_pile *p, scree_error *error)
{
    enum { N = SCREE_PILE_TERMS };
    double state[2], t = 0, mean[N], turn[N];
    start(of, on_axis, state);
    // Zeros of the Nth polynomial in v = 2 u / c - 1, from the axis to the surface.
    for (int k = N - 1; k >= 0; k--) {
        const double v = cos(M_PI * (k + 0.5) / N), to = -log(0.5 * (1 - v));
        if (gsl_odeiv2_driver_apply(of->driver, &t, to, state) != GSL_SUCCESS) return refuse(error);
        mean[k] = state[0];
        turn[k] = state[1];
    }
    for (int j = 0; j < N; j++) {
        p->mean[j] = p->turn[j] = 0;
        for (int k = 0; k < N; k++) {
            const double share = cos(M_PI * j * (k + 0.5) / N) * (j == 0 ? 1 : 2) / N;
            p->mean[j] += share * mean[k];
            p->turn[j] += share * turn[k];
        }
    }
    p->terms = N;
    return SCREE_OK;
}

static scree_status solve(const incipient *of, scree_ideal_pile *p, scree_error *error)
{
    double low = 0, high = 1;
    (void)gsl_odeiv2_driver_set_nmax(of->driver, 2000);
    for (int k = 0; k < 60; k++) {
        const double middle = 0.5 * (low + high);
        *(is_too_much(of, middle) ? &high : &low) = middle;
    }
    return fill_series(of, 0.5 * (low + high), p, error);
}

scree_status scree_incipient_pile(double slope, double weight, scree_ideal_pile *p, scree_error *error)
{
    incipient of = {.slope = slope, .sine = sin(slope), .cotangent = 1 / tan(slope)};
    gsl_odeiv2_system system = {rates, NULL, 2, &of};
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    memset(p, 0, sizeof *p);
    p->weight = weight;
    p->slope[0] = p->slope[1] = slope;
    p->sectors = 1;
    p->sector[0] =
        (scree_pile_sector){.from = -of.cotangent, .to = of.cotangent, .closure = SCREE_PILE_YIELDS, .friction = slope};
    of.driver = gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, FIRST, TOLERANCE, TOLERANCE);
    scree_status status = of.driver ? solve(&of, p, error) : scree_error_set_memory(error, sizeof of);
    if (of.driver) gsl_odeiv2_driver_free(of.driver);
    gsl_set_error_handler(handler);
    return status;
}
