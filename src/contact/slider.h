/// A spring with a slider, and a dashpot beside it: how hertz_mindlin resists slip, rolling and twisting.
///   h <- h + s dt, |k h| <= cap;     f = -(k h + eta s), |f| <= cap
/// The spring alone is kept and capped, then the sum with the dashpot: a spring that slides stretches no further.
/// One component (2D, twisting) or three in the present tangent plane.
///
/// with the rate s of the middle of the step (kinematics.h).
///
/// Ledger of a step, with mean forces <f> = (f(n-1) + f(n))/2:
///   damping    <dashpot> . s dt
///   friction   <k h> . (s dt - (h(n) - h(n-1)))           exactly zero while the spring sticks
///   stiffness  1/2 (k(n) - k(n-1)) h(n) . h(n-1) - 1/2 k(n-1) h(n-1) . (h'(n-1) - h(n-1))
/// where h(n-1) is what the law makes of the displacement h'(n-1) that the last step ended with, when the stiffness
/// changes (slider_rescale); else they are equal. The work done on the spring, <k h> . s dt, minus the change of its
/// energy 1/2 k h^2 is friction - stiffness, exactly. Where a contact has opened, forces and h at n are zero: the same
/// lines take what the spring still held as friction.
#ifndef SCREE_CONTACT_SLIDER_H
#define SCREE_CONTACT_SLIDER_H

#include "contact/vector.h"

/// What a slider remembers of step n - 1, in the directions of step n.
typedef struct slider_memory {
    vector displacement; ///< h
    vector spring;       ///< k h, for the ledger
    vector dashpot;      ///< the dashpot's part of -f, for the ledger
} slider_memory;

/// Shortens the displacement by `factor`, without work. Twice the energy that goes, to be taken from `stiffness`.
SCREE_INLINE lanes slider_rescale(int count, slider_memory *memory, lanes factor)
{
    vector left = vector_times(count, memory->displacement, factor);
    lanes lost = vector_dot(count, memory->spring, vector_minus(count, memory->displacement, left));
    memory->displacement = left;
    return lost;
}

typedef struct slider {
    slider_memory now;                  ///< for the next step
    vector resistance;                  ///< -f
    lanes damping, friction, stiffness; ///< J, twice what is accumulated
    lanes elastic;                      ///< J
} slider;

/// Whether all lanes touch and stick, in space: nothing is to be limited.
SCREE_INLINE bool slider_sticks(const slider *s, lanes cap, lanes_bits touching)
{
    lanes square = cap * cap;
    lanes_bits within = lanes_at_or_below(vector_dot(3, s->now.spring, s->now.spring), square) &
                        lanes_at_or_below(vector_dot(3, s->resistance, s->resistance), square);
    return !lanes_ones(~(within & touching));
}

/// Caps the spring, then its sum with the dashpot, of a tangential displacement that has not been limited yet.
SCREE_INLINE void slider_limit(int count, slider *s, vector viscous, lanes stiffness, lanes cap, lanes_bits touching)
{
    vector trial = s->now.spring, displacement = s->now.displacement;
    if (count == 1) {
        s->now.spring = vector_at_most(1, trial, cap);
        displacement.x =
            lanes_select(lanes_differ(s->now.spring.x, trial.x), s->now.spring.x / stiffness, displacement.x);
    } else {
        lanes factor = vector_limit_factor(trial, cap);
        s->now.spring = vector_times(3, trial, factor);
        displacement = vector_times(3, displacement, factor);
    }
    s->now.displacement = vector_keep(count, touching, displacement);
    s->resistance = vector_at_most(count, vector_plus(count, s->now.spring, viscous), cap);
}

/// rate: moves the spring; dashpot_rate: the dashpot's. step: dt; 0 evaluates without moving.
SCREE_INLINE slider slider_move(int count, const slider_memory *before, vector rate, vector dashpot_rate, double step,
                                lanes stiffness, lanes viscosity, lanes cap, lanes_bits touching)
{
    vector moved = vector_times(count, rate, lanes_all(step));
    vector reached = vector_plus(count, before->displacement, moved);
    vector viscous = vector_times(count, dashpot_rate, viscosity);
    slider s = {.now = {.displacement = reached, .spring = vector_times(count, reached, stiffness)},
                .friction = lanes_all(0)};
    s.resistance = vector_plus(count, s.now.spring, viscous);
    vector springs = vector_plus(count, s.now.spring, before->spring);
    // In space the branch spares more than it costs; in one dimension limits are cheap.
    if (count == 1 || !slider_sticks(&s, cap, touching)) {
        slider_limit(count, &s, viscous, stiffness, cap, touching);
        springs = vector_plus(count, s.now.spring, before->spring);
        s.friction = vector_dot(count, springs, vector_minus(count, reached, s.now.displacement));
    }
    s.now.dashpot = vector_minus(count, s.resistance, s.now.spring);

    vector dashpots = vector_plus(count, s.now.dashpot, before->dashpot);
    s.damping = vector_dot(count, dashpots, moved);
    s.stiffness =
        vector_dot(count, s.now.spring, before->displacement) - vector_dot(count, before->spring, s.now.displacement);
    s.elastic = 0.5 * vector_dot(count, s.now.spring, s.now.displacement);
    return s;
}

#endif
