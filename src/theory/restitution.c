/// Restitution of a binary impact.
///
/// Viscoelastic Hertz (Brilliantov et al. 1996; P 2.16, figure 2.1). With lengths in (m v^2 / K)^(2/5) and velocities
/// in the impact speed v the equation of motion is
///     x'' = -sqrt(x) (x + tau x'),   x(0) = 0,  x'(0) = 1,   tau = T v^(1/5) (K / m)^(2/5),
/// until x + tau x' = 0, or with attraction until x = 0. There x'' + tau sqrt(x) x' = -x^1.5 < 0: bodies always part,
/// but the slower the stronger the damping; longer than LONGEST is not waited for. It is integrated by GSL's
/// Prince-Dormand pair of order 8 with a tolerance of 1e-12; the last step is bisected to the moment of release.
/// Restitution falls with tau, hence with the speed. Cost: about 0.1 ms.
///
/// Hertz with damping sqrt(m k) (Tsuji et al. 1992). In the same units x'' = -(x^1.5 + damping x^0.25 x'). With
/// ds = x^(1/4) dt and y = x^(5/4) this is the linear oscillator (Antypov & Elliott 2011)
///     dy/ds = (5/4) v,   dv/ds = -y - damping v,    damping ratio  z = damping / sqrt(5).
/// The force y + damping v is -dv/ds, so bodies that do not attract each other part at the minimum of v, as for the
/// linear spring and dashpot of Schwager & Poeschel 2007. With z = cos(a) the phase at release is 2a and the speed
/// there
///     e = exp(-2 a cot a),   z < 1;       e = exp(-2 a coth a),  z = cosh(a) > 1;       e = exp(-2),  z = 1.
/// If attraction were allowed (release at y = 0) it would be e = exp(-pi z / sqrt(1 - z^2)); the two agree to first
/// order in z, and never attracting bodies keep more of their speed.
#include "theory/restitution.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>

static const double STRONGEST_DAMPING = 1000;
static const double TOLERANCE = 1e-12;
static const double LONGEST = 1e4; ///< of the time scale

/// An impact in its own units.
typedef struct impact_equation {
    double tau;
    bool attraction;
} impact_equation;

/// state: overlap and its rate; parameter: the equation.
static int impact_rates(double time, const double state[2], double rates[2], void *parameter)
{
    (void)time;
    double tau = ((const impact_equation *)parameter)->tau;
    rates[0] = state[1];
    rates[1] = -sqrt(fmax(state[0], 0)) * (state[0] + tau * state[1]);
    return GSL_SUCCESS;
}

/// Above zero as long as the bodies are together.
static double hold(const double state[2], const impact_equation *e)
{
    return e->attraction ? state[0] : state[0] + e->tau * state[1];
}

/// Shortens the step that passed the release until it ends there. `state` and `time` enter as before that step.
static scree_status find_release(gsl_odeiv2_step *stepper, const gsl_odeiv2_system *system, double longest,
                                 double *time, double state[2], scree_error *error)
{
    double low = 0, high = longest, tried[2];
    for (int halving = 0; halving < 60; halving++) {
        double middle = (low + high) / 2, errors[2];
        tried[0] = state[0];
        tried[1] = state[1];
        if (gsl_odeiv2_step_apply(stepper, *time, middle, tried, errors, NULL, NULL, system) != GSL_SUCCESS)
            return scree_error_set(error, SCREE_ERROR_INPUT, "the impact could not be integrated");
        if (hold(tried, system->params) > 0)
            low = middle;
        else
            high = middle;
    }
    state[0] = tried[0];
    state[1] = tried[1];
    *time += (low + high) / 2;
    return SCREE_OK;
}

/// Integrates the dimensionless impact to its release: speed and time there.
static scree_status integrate_impact(impact_equation *e, gsl_odeiv2_step *stepper, gsl_odeiv2_control *control,
                                     gsl_odeiv2_evolve *evolution, double *speed, double *time, scree_error *error)
{
    const gsl_odeiv2_system system = {impact_rates, NULL, 2, e};
    double state[2] = {0, 1}, step = 1e-6;
    *time = 0;
    for (int steps = 0; steps < 1000000 && *time < LONGEST; steps++) {
        double before[2] = {state[0], state[1]}, start = *time;
        if (gsl_odeiv2_evolve_apply(evolution, control, stepper, &system, time, 1e300, &step, state) != GSL_SUCCESS)
            break;
        if (hold(state, e) > 0 || state[1] > 0) continue;
        double length = *time - start;
        *time = start;
        gsl_odeiv2_step_reset(stepper);
        scree_status status = find_release(stepper, &system, length, time, before, error);
        *speed = -before[1];
        return status;
    }
    return scree_error_set(error, SCREE_ERROR_INPUT, "the impact could not be integrated (scaled damping %g%s)", e->tau,
                           e->attraction ? "; with attraction bodies may hardly part" : "");
}

scree_status scree_impact_viscoelastic(double speed, double stiffness, double mass, double damping_time,
                                       bool attraction, scree_impact *impact, scree_error *error)
{
    if (!(speed > 0) || !(stiffness > 0) || !(mass > 0) || !(damping_time >= 0))
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "an impact needs speed, stiffness and mass above zero and damping of zero or more");
    double time_scale = pow(mass / stiffness, 0.4) * pow(speed, -0.2);
    double tau = damping_time / time_scale;
    if (!(tau <= STRONGEST_DAMPING))
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "damping %g s is %g times the time of the impact; at most %g times can be computed",
                               damping_time, tau, STRONGEST_DAMPING);
    // GSL's default handler would end the process when memory runs out.
    gsl_error_handler_t *handler = gsl_set_error_handler_off();
    gsl_odeiv2_step *stepper = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, 2);
    gsl_odeiv2_control *control = gsl_odeiv2_control_y_new(TOLERANCE, TOLERANCE);
    gsl_odeiv2_evolve *evolution = gsl_odeiv2_evolve_alloc(2);
    impact_equation equation = {tau, attraction};
    double time = 0;
    scree_status status = stepper && control && evolution ? integrate_impact(&equation, stepper, control, evolution,
                                                                             &impact->restitution, &time, error)
                                                          : scree_error_set_memory(error, sizeof(double[64]));
    impact->duration = time * time_scale;
    if (evolution) gsl_odeiv2_evolve_free(evolution);
    if (control) gsl_odeiv2_control_free(control);
    if (stepper) gsl_odeiv2_step_free(stepper);
    gsl_set_error_handler(handler);
    return status;
}

double scree_restitution_from_damping(double damping)
{
    double ratio = damping / sqrt(5.0);
    if (ratio < 1) {
        double angle = acos(ratio);
        return angle > 0 ? exp(-2 * angle * ratio / sqrt((1 - ratio) * (1 + ratio))) : exp(-2.0);
    }
    double angle = acosh(ratio);
    return angle > 0 ? exp(-2 * angle * ratio / sqrt((ratio - 1) * (ratio + 1))) : exp(-2.0);
}

double scree_damping_from_restitution(double restitution)
{
    if (restitution >= 1) return 0;
    if (!(restitution > 0)) return INFINITY;
    // Restitution falls monotonically with damping, as 5 / (4 damping^2) in the end: bisect between zero and that.
    double low = 0, high = 2 + 2 / sqrt(restitution);
    for (;;) {
        double middle = (low + high) / 2;
        if (middle <= low || middle >= high) return middle;
        if (scree_restitution_from_damping(middle) > restitution)
            low = middle;
        else
            high = middle;
    }
}
