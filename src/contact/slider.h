/// A spring with a slider, and a dashpot beside it: how hertz_mindlin resists slip, rolling and twisting.
///   h <- h + s dt, |k h| <= cap;     f = -(k h + eta s), |f| <= cap
/// The spring alone is kept and capped, then the sum with the dashpot: a spring that slides stretches no further.
/// One component (2D, twisting) or three in the present tangent plane.
///
/// Ledger of a step, with the middle increment sigma (motion.h) and mean forces <f> = (f(n-1) + f(n))/2:
///   damping    <dashpot> . sigma
///   friction   <k h> . (s dt - (h(n) - h(n-1)))           zero while the spring sticks
///   stiffness  1/2 (k(n) - k(n-1)) h(n) . h(n-1) - <k h> . (sigma - s dt)
/// The work done on the spring, <k h> . sigma, minus the change of its energy 1/2 k h^2 is friction - stiffness,
/// exactly. Where a contact has opened, forces and h at n are zero: the same lines book what the spring still held as
/// friction.
#ifndef SCREE_CONTACT_SLIDER_H
#define SCREE_CONTACT_SLIDER_H

#include "contact/vector.h"

/// What a slider remembers of step n - 1, in the directions of step n.
typedef struct slider_memory {
    vector stretch; ///< h
    vector spring;  ///< k h, for the ledger
    vector dashpot; ///< the dashpot's part of -f, for the ledger
} slider_memory;

/// How it moves in this step.
typedef struct slider_motion {
    vector rate;   ///< s, at n
    vector middle; ///< sigma
    double step;   ///< dt; 0 evaluates without moving
} slider_motion;

typedef struct slider {
    slider_memory now;                  ///< for the next step
    vector resistance;                  ///< -f
    lanes damping, friction, stiffness; ///< J
    lanes elastic;                      ///< J
} slider;

SCREE_INLINE slider slider_move(int count, const slider_memory *before, const slider_motion *move, lanes stiffness,
                                lanes viscosity, lanes cap, lanes_bits touching)
{
    slider s;
    vector step = vector_times(count, move->rate, lanes_all(move->step));
    vector stretch = vector_plus(count, before->stretch, step), trial = vector_times(count, stretch, stiffness);
    vector spring = trial;
    if (count == 1) {
        spring = vector_at_most(1, trial, cap);
        stretch.x = lanes_select(lanes_differ(spring.x, trial.x), spring.x / stiffness, stretch.x);
    } else {
        lanes factor = vector_limit_factor(trial, cap);
        spring = vector_times(count, trial, factor);
        stretch = vector_times(count, stretch, factor);
    }
    stretch = vector_keep(count, touching, stretch);
    vector viscous = vector_times(count, move->rate, viscosity);
    s.resistance = vector_at_most(count, vector_plus(count, spring, viscous), cap);
    s.now = (slider_memory){stretch, spring, vector_minus(count, s.resistance, spring)};

    vector mean_spring = vector_times(count, vector_plus(count, spring, before->spring), lanes_all(0.5));
    vector mean_dashpot = vector_times(count, vector_plus(count, s.now.dashpot, before->dashpot), lanes_all(0.5));
    vector stretched = vector_minus(count, stretch, before->stretch);
    s.damping = vector_dot(count, mean_dashpot, move->middle);
    s.friction = vector_dot(count, mean_spring, vector_minus(count, step, stretched));
    s.stiffness = 0.5 * (vector_dot(count, spring, before->stretch) - vector_dot(count, before->spring, stretch)) -
                  vector_dot(count, mean_spring, vector_minus(count, move->middle, step));
    s.elastic = 0.5 * vector_dot(count, spring, stretch);
    return s;
}

#endif
