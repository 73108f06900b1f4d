/// Two elastic bodies that stick: closed forms of Johnson, Kendall and Roberts (1971; JKR) and of Derjaguin, Muller and
/// Toporov (1975; DMT), the equations of contact/adhesive.h. Units: SI. All functions are for stiffness, root and
/// radius above zero; root may be zero: Hertz.
#ifndef SCREE_THEORY_ADHESION_H
#define SCREE_THEORY_ADHESION_H

#include "theory/restitution.h"

#include <stdbool.h>

typedef struct scree_adhesion {
    bool jkr;         ///< else DMT
    double stiffness; ///< Pa, N = 4/3 Ebar
    double root;      ///< m^(1/2), B = sqrt(2 pi w / Ebar)
    double radius;    ///< m, R_eff
} scree_adhesion;

/// B of a work of adhesion [J/m2], and the other way round.
double scree_adhesion_root(double stiffness, double work);
double scree_adhesion_work(double stiffness, double root);

/// (R_eff w^2 / (Ebar^2 z_0^3))^(1/3), z_0 = 0.3 nm: JKR above about 5, DMT below about 0.1 (Tabor 1977).
double scree_adhesion_tabor(const scree_adhesion *of);

/// F_c [N], the largest pull; gap at which the contact ends [m].
double scree_adhesion_pull_off(const scree_adhesion *of);
double scree_adhesion_neck(const scree_adhesion *of);

/// Radius a of the contact area [m], of an overlap [m] (zero beyond the neck) and of a force [N] of at least -F_c.
double scree_adhesion_area_of_overlap(const scree_adhesion *of, double overlap);
double scree_adhesion_area_of_force(const scree_adhesion *of, double force);

/// Overlap [m], force [N], energy [J] and stiffness df/dd [N/m] of a radius a [m].
double scree_adhesion_overlap(const scree_adhesion *of, double a);
double scree_adhesion_force(const scree_adhesion *of, double a);
double scree_adhesion_energy(const scree_adhesion *of, double a);
double scree_adhesion_stiffness(const scree_adhesion *of, double a);

/// Energy [J] that a cycle of touch and break loses: JKR from U at the touch to U at the break; DMT nothing.
double scree_adhesion_loss(const scree_adhesion *of);

/// Speed [m/s] of the effective mass [kg] below which the bodies stick: its energy is that loss (Thornton and Ning
/// 1998). Without dashpots e^2 = 1 - (v_s / v)^2.
double scree_adhesion_sticking_speed(const scree_adhesion *of, double mass);

/// Radius a [m] at the turning point of an impact without dashpots.
double scree_adhesion_deepest(const scree_adhesion *of, double mass, double speed);

/// Impact with a dashpot damping sqrt(m N a); what pulls harder than F_c is cut. Without dashpots the restitution is
/// the closed form; else the motion is integrated (fourth order of Runge and Kutta, 2000 steps in the shortest time),
/// to some 1e-6. Bodies that stick: restitution 0, and the time in which they come to be held. Cost: some ms. Errors:
/// an argument out of range.
scree_status scree_impact_adhesive(const scree_adhesion *of, double damping, double mass, double speed,
                                   scree_impact *impact, scree_error *error) SCREE_MUST_USE;

#endif
