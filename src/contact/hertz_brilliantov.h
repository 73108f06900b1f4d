/// Law hertz_brilliantov: Hertz's normal force with the damping of Brilliantov et al. 1996, and friction regularised by
/// the slip speed (P 2.A1-2.A7, 3.A1-3.A3, corrected as in docs/theory.md).
///   f_n = max(K d^1.5 + T K d^0.5 d', 0), K = normal_stiffness sqrt(R_eff); with attraction f_n without max
///   f_t = -mu |f_n| (|s| / v_R)^(1/c) s / |s|, zero at s = 0
/// With a whole c the power is a rough guess and one of Halley's steps for y^c = |s| / v_R (whole_power.h), to
/// round-off; otherwise 2^(log(|s| / v_R) / (c log 2)) with SLEEF's functions: the error of the logarithm is divided by
/// c. In two dimensions the slip is a signed number, so no root is needed.
///
/// Two updates of friction. Explicit: s is the slip of the velocities that brought the bodies here; a slip slower than
/// about mu f_n dt / m turns its sign in every step. Implicit (docs/friction-update.md): s = s* is the slip after the
/// coming kick. With s~ that slip if all forces stayed as they are, r the resistance -f_t and r' the one before,
///   s* = s~ - A (r - r'),  A = dt mobility,    r = mu f_n (|s*| / v_R)^(1/c) s* / |s*|,
/// the mobility for the share of mass that a body's contacts have each (kinematics.h; mass splitting after Tonge,
/// Benevolenski and Voroshilov 2012): a sweep of Jacobi's iteration in every step, from the forces of the last one,
/// that converges for any step. r has the direction of s~ + A r'. With y = (|s*| / v_R)^(1/c), b = |s~ + A r'| / v_R
/// and g = A mu f_n / v_R its magnitude mu f_n y follows from
///   y^c + g y = b,
/// which increases and is convex in y: min(b / g, b^(1/c)) is above the root, and two of Halley's steps are within 0.1
/// % of it for c = 50 (0.2 % for c = 200) where it is worst, at the corner between sticking and sliding.
///
/// Memory (the fields in hertz_brilliantov.c), at n - 1: tangential force, for the ledger and the implicit update, and
/// normal damping force, for the ledger.
/// Ledger: damping <f_n - K d^1.5> d' dt, friction -<f_t> . s dt (mean forces, rates of the middle of the step:
/// kinematics.h).
/// Cost: 2 roots, 3 divisions (3D: 3 and 4) and a power of c a contact; implicit: 7 divisions and a power of c more.
/// With a c that is not whole one logarithm and one exponential, implicit three.
#ifndef SCREE_CONTACT_HERTZ_BRILLIANTOV_H
#define SCREE_CONTACT_HERTZ_BRILLIANTOV_H

#include "contact/hertz.h"
#include "contact/law.h"
#include "contact/whole_power.h"

/// Option.
enum { BRILLIANTOV_IMPLICIT = 1 };

/// Numbers of the run.
enum {
    BRILLIANTOV_TIME,             ///< s, T
    BRILLIANTOV_EXPONENT,         ///< 1, c
    BRILLIANTOV_INVERSE_EXPONENT, ///< 1, 1 / c
    BRILLIANTOV_BINARY_EXPONENT,  ///< 1 / (c log 2)
    BRILLIANTOV_VELOCITY,         ///< m/s, v_R
    BRILLIANTOV_INVERSE_VELOCITY, ///< s/m
    BRILLIANTOV_LEAST,            ///< N, least normal force: 0, or with attraction that of all numbers
    BRILLIANTOV_WHOLE,            ///< c where it is a whole number up to WHOLE_POWER_MOST, else 0
};

typedef enum scree_friction_update { SCREE_FRICTION_EXPLICIT, SCREE_FRICTION_IMPLICIT } scree_friction_update;

/// What a case says of it under `contact`.
typedef struct scree_brilliantov_config {
    double damping_time;      ///< s, T
    double friction_exponent; ///< 1, c
    int friction_update;      ///< scree_friction_update
    bool attraction;          ///< contacts that part may pull
} scree_brilliantov_config;

/// Numbers of the run from T [s], c and v_R [m/s].
static inline void brilliantov_numbers(double time, double exponent, double velocity, double number[SCREE_LAW_NUMBERS])
{
    double inverse_exponent = 1 / exponent;
    number[BRILLIANTOV_TIME] = time;
    number[BRILLIANTOV_INVERSE_EXPONENT] = inverse_exponent;
    number[BRILLIANTOV_BINARY_EXPONENT] = inverse_exponent * M_LOG2E;
    number[BRILLIANTOV_EXPONENT] = 1.0 / inverse_exponent;
    number[BRILLIANTOV_WHOLE] = exponent <= WHOLE_POWER_MOST && exponent == floor(exponent) ? exponent : 0;
    number[BRILLIANTOV_VELOCITY] = velocity;
    number[BRILLIANTOV_INVERSE_VELOCITY] = 1.0 / velocity;
}

#define hertz_brilliantov_KERNELS(row)                                                                                 \
    row(hertz_brilliantov, 0, one) row(hertz_brilliantov, 0, many) row(hertz_brilliantov, 1, one)                      \
        row(hertz_brilliantov, 1, many)

static const scree_law_traits hertz_brilliantov_traits[] = {
    [0] = {.looks_ahead = false},
    [BRILLIANTOV_IMPLICIT] = {.looks_ahead = true},
};

/// -magnitude along the slip.
SCREE_INLINE vector against_slip(int dimension, lanes magnitude, vector slip, lanes speed)
{
    if (dimension == 2) return (vector){.x = -lanes_with_sign(magnitude, slip.x)};
    lanes_bits slips = ~lanes_at_or_below(speed, lanes_all(0));
    return vector_times(3, slip, -lanes_keep(slips, magnitude / speed));
}

/// a^exponent, binary: exponent / log 2.
SCREE_INLINE lanes power_of(lanes a, double binary)
{
    return lanes_exp2(lanes_log(a) * binary);
}

/// A step of Halley's towards y of y^c + g y = b.
SCREE_INLINE lanes nearer_root(lanes y, lanes b, lanes g, const law_settings *settings)
{
    const double c = settings->number[BRILLIANTOV_EXPONENT], tiny = 1e-300; // against 0 / 0 where nothing slips
    const unsigned whole = (unsigned)settings->number[BRILLIANTOV_WHOLE];
    const lanes power = whole ? whole_power(y, whole) : power_of(y, c * M_LOG2E);
    const lanes excess = power + g * y - b, slope = c * power + g * y, bend = (c * (c - 1.0)) * power;
    return y - y * (2.0 * (excess * slope) / (2.0 * (slope * slope) - excess * bend + tiny));
}

/// About b^(1/c), at most `limit`, which is 0 where b is.
SCREE_INLINE lanes first_root(lanes b, lanes limit, const law_settings *settings)
{
    const bool whole = settings->number[BRILLIANTOV_WHOLE] > 0;
    return lanes_at_most(whole ? rough_root(b, settings->number[BRILLIANTOV_INVERSE_EXPONENT])
                               : power_of(b, settings->number[BRILLIANTOV_BINARY_EXPONENT]),
                         limit);
}

/// y of y^c + g y = b.
SCREE_INLINE lanes mobilised_friction(lanes b, lanes g, const law_settings *settings)
{
    lanes y = first_root(b, b / (g + 1e-300), settings);
    for (int k = 0; k < 2; k++) y = nearer_root(y, b, g, settings);
    return y;
}

/// b^(1/c).
SCREE_INLINE lanes regularised_slip(lanes b, const law_settings *settings)
{
    const lanes y = first_root(b, b * 1e300, settings);
    return settings->number[BRILLIANTOV_WHOLE] > 0 ? nearer_root(y, b, lanes_all(0), settings) : y;
}

/// Tangential force on first. cap: mu f_n; before: the force at n - 1, carried along.
SCREE_INLINE vector regularised_friction(variant v, lanes cap, const law_settings *settings, const kinematics *m,
                                         vector before)
{
    const int count = tangential_count(v.dimension);
    const lanes scale = lanes_all(settings->number[BRILLIANTOV_INVERSE_VELOCITY]);
    const bool implicit = v.option & BRILLIANTOV_IMPLICIT;
    // Nothing advances: the force that the last step ended with.
    if (implicit && settings->step == 0) return before;
    vector slip = m->dashpot_slip;
    lanes mobility = lanes_all(0);
    if (implicit) {
        mobility = settings->step * m->mobility;
        slip = vector_minus(count, m->predicted_slip, vector_times(count, before, mobility));
    }
    lanes speed = v.dimension == 2 ? lanes_abs(slip.x) : lanes_root(vector_dot(3, slip, slip)),
          relative = speed * scale;
    lanes mobilised = implicit ? mobilised_friction(relative, mobility * cap * scale, settings)
                               : regularised_slip(relative, settings);
    return against_slip(v.dimension, cap * mobilised, slip, speed);
}

SCREE_INLINE law_force hertz_brilliantov(variant v, const law_constants *constants, const law_settings *settings,
                                         const kinematics *m, lanes_bits touching, const law_memory *before,
                                         law_memory *after)
{
    const int dimension = v.dimension, count = tangential_count(dimension);
    lanes d = lanes_keep(touching, m->overlap);
    lanes stiffness = constants->value[HERTZ_NORMAL] * lanes_root(m->reduced_radius * d);
    lanes elastic = stiffness * d;
    lanes normal = lanes_at_least(elastic + stiffness * (settings->number[BRILLIANTOV_TIME] * m->dashpot_approach),
                                  lanes_all(settings->number[BRILLIANTOV_LEAST]));

    lanes damping = normal - elastic, none = lanes_all(0), damping_before = before->value[1];
    vector tangential_before = {.x = before->value[0]};
    if (dimension == 3) {
        vector kept = {before->value[0], before->value[1], before->value[2]};
        tangential_before = kinematics_carry(3, m, kept);
        damping_before = before->value[3];
    }
    vector tangential =
        regularised_friction(v, constants->value[SCREE_FRICTION] * lanes_abs(normal), settings, m, tangential_before);
    *after = (law_memory){.value = {tangential.x, damping, none, none}};
    if (dimension == 3) *after = (law_memory){.value = {tangential.x, tangential.y, tangential.z, damping}};
    vector both = vector_plus(count, tangential, tangential_before);
    return (law_force){
        .normal = normal,
        .tangential = tangential,
        .couple = vector_none(),
        .damping = 0.5 * (damping + damping_before) * (m->approach * settings->step),
        .friction = (-0.5 * settings->step) * vector_dot(count, both, m->slip),
        .stiffness = none,
        .elastic_normal = 0.4 * (elastic * d),
        .elastic_tangential = none,
    };
}

#endif
